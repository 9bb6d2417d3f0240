"""A line with stops, trams and a dispatcher, each step with its effect asserted (G4 to G6)."""

from __future__ import annotations

from typing import Any

from kernel.tram import centre as machine
from kernel.tram.centre import Centre, Command, Tram
from kernel.tram.dispatching import DispatchLimits, Hand, Known, Order, Report, mark
from kernel.tram.display import begun
from models.tram.dispatching import Body, Given, Run, Traffic, Way
from proofs.onboard.witnesses.play import Play
from proofs.tram.dispatching import THEORY

LIMITS = DispatchLimits(
    ahead_hold_ms=120_000,
    behind_hold_ms=600_000,
    longest_hold_ms=60_000,
    recovery_ms=240_000,
    fresh_ms=11_000,
    order_ms=11_000,
    coming_ms=60_000,
)
SITE = Way(LIMITS)
FIRST, SECOND, THIRD, EARLY = Tram("11"), Tram("13"), Tram("15"), Tram("9")
TERMINUS = 20
CLEARED = 6
"""The stop that the first tram of the morning has left: up to there the way is known."""
NEITHER, HELD, RECOVERS = (False, False), (True, False), (False, True)
"""What an order says: whether it holds, and whether it lets recover."""


def command_of(tram: Tram, order: Order) -> Command:
    """An order as it is sent to a tram."""
    return Command(tram, order.stop, order.holds, order.recovers, order.made_ms)


class Day(Play[Way, Traffic]):
    """A way with twenty stops, at first without trams."""

    def __init__(self, now_ms: int = 1_000_000, *, is_cleared: bool = True) -> None:
        """Begin: nothing is known; then, if it is to be, a first tram has run over the way, and is off it again."""
        nothing = frozenset[Any]()
        given = Given(holds=False, recovers=False, own_unknown=False, way_unknown=False)
        begun_centre = Centre(now_ms, now_ms + LIMITS.coming_ms, -1, {}, {}, nothing, {})
        super().__init__(
            THEORY, SITE, Traffic(now_ms, {}, {}, {}, nothing, begun_centre, nothing, nothing, nothing, nothing, given)
        )
        if is_cleared:
            self.wait(LIMITS.coming_ms + 1)
            self.clear(EARLY)

    def clear(self, tram: Tram) -> None:
        """A tram runs over the way from its first stop, tells so, and leaves it."""
        self.come(tram, 0, 0)
        for _ in range(CLEARED):
            self.step("depart", tram=tram)
            self.step("arrive", tram=tram, noticed=True, told_stop=self.body(tram).stop + 1, stands=False)
        self.step("depart", tram=tram)
        self.see(tram, stands=False)
        self.tell(tram)
        assert self.system.centre.cleared == mark(CLEARED, True)
        self.leave(tram)
        self.wait(1)
        self.off(tram)

    def tell_beside(self, tram: Tram, stop: int, *, stands: bool) -> Report:
        """A tram that is not on the way tells of a stop of it, and the centre hears that."""
        told = Report(stop, False, stands, TERMINUS, self.system.centre.now_ms)
        self.step("tell_beside", tram=tram, report=told)
        assert (tram, told) in self.system.told_beside
        self.step("hear_report", tram=tram, told=told)
        return told

    def leave(self, tram: Tram) -> None:
        """A tram leaves the way, and nobody is told."""
        self.step("leave", tram=tram)
        assert tram not in self.system.bodies

    def off(self, tram: Tram) -> None:
        """A tram that is off the way tells from elsewhere, and is heard."""
        now_ms = self.system.centre.now_ms
        self.step("tell_elsewhere", tram=tram)
        assert (tram, now_ms) in self.system.told_elsewhere
        self.step("hear_elsewhere", tram=tram, is_away=True, made_ms=now_ms)
        assert tram not in self.system.centre.trams
        assert self.system.centre.elsewhere_ms[tram] == now_ms

    def off_in_vain(self, tram: Tram) -> None:
        """A tram tells from elsewhere before anything counts: the centre has started anew too lately."""
        self.step("tell_elsewhere", tram=tram)
        before = self.system
        assert self.step("hear_elsewhere", tram=tram, is_away=True, made_ms=before.now_ms) == before

    def confirm(self, tram: Tram, stop: int, leaves_at: int = TERMINUS) -> bool:
        """The centre is asked for a tram that has told from elsewhere; whether it confirms it."""
        before = self.system
        self.step("take_up", tram=tram, stop=stop, leaves_at=leaves_at)
        if tram in before.centre.trams or tram not in self.system.centre.trams:
            assert self.system == before
            return False
        known, now_ms = self.known(tram), self.system.centre.now_ms
        assert (known.stop, known.leaves_at, known.since_ms) == (stop, leaves_at, now_ms)
        assert (known.left, known.stands, known.recovery_to, known.comes_at) == (False, False, stop, stop)
        assert known.arrived_ms == known.told_ms == now_ms
        assert self.system.runs[tram] == Run(stop, now_ms)
        return True

    def body(self, tram: Tram) -> Body:
        """A tram as it is."""
        return self.system.bodies[tram]

    def known(self, tram: Tram) -> Known:
        """What the centre knows of it."""
        return self.system.centre.trams[tram]

    def wait(self, elapsed_ms: int) -> None:
        """Let time pass."""
        was_ms = self.system.centre.now_ms
        self.step("pass_time", elapsed_ms=elapsed_ms)
        assert self.system.centre.now_ms == was_ms + elapsed_ms

    def come(self, tram: Tram, rank: int, stop: int, leaves_at: int = TERMINUS, *, tells: bool = True) -> None:
        """A tram is taken up, comes, stands at its first stop, and tells that, all in one ms after the other."""
        self.off(tram)
        assert self.confirm(tram, stop, leaves_at)
        self.begin(tram, rank, tells=tells)

    def run_to(self, tram: Tram, rank: int, stop: int, leaves_at: int = TERMINUS, *, tells: bool = True) -> None:
        """A tram comes at the stop before that, tells that it leaves it, and arrives: it is known to be under way."""
        self.come(tram, rank, stop - 1, leaves_at)
        self.depart(tram)
        self.arrive(tram, tells=tells)

    def begin(self, tram: Tram, rank: int, *, tells: bool = True) -> None:
        """A tram that was confirmed comes, stands at its first stop, and tells that."""
        stop, now_ms = self.system.runs[tram].stop, self.system.centre.now_ms
        body = Body(rank, stop, False, display=begun(0), taken_at=stop)
        self.step("come", tram=tram, body=body, now_ms=now_ms, begun_ms=now_ms)
        assert self.body(tram).display == begun(now_ms)
        assert tram not in self.system.runs
        self.wait(1)
        self.see(tram)
        if tells:
            self.tell(tram)

    def see(self, tram: Tram, *, is_located: bool = True, stands: bool = True) -> None:
        """The unit takes its place, and sees whether the tram stands."""
        stop = self.body(tram).stop
        self.step("take_place", tram=tram, is_located=is_located, told_stop=stop, stands=stands)
        display = self.body(tram).display
        assert (display.is_located, display.stop, display.stands) == (is_located, stop, is_located and stands)

    def depart(self, tram: Tram, *, tells: bool = True) -> None:
        """A tram departs; its unit sees that, and tells."""
        stop = self.body(tram).stop
        self.step("depart", tram=tram)
        assert (self.body(tram).stop, self.body(tram).left) == (stop, True)
        self.see(tram, stands=False)
        if tells:
            self.tell(tram)

    def arrive(self, tram: Tram, *, tells: bool = True, stands: bool = True) -> None:
        """A tram arrives at the next stop; its unit sees that, and tells."""
        stop = self.body(tram).stop + 1
        self.step("arrive", tram=tram, noticed=True, told_stop=stop, stands=stands)
        assert (self.body(tram).stop, self.body(tram).left) == (stop, False)
        assert self.body(tram).display.stop == stop
        if tells:
            self.tell(tram)

    def report(self, tram: Tram, leaves_at: int = TERMINUS) -> Report:
        """A tram makes a report of how it is now, which is not heard yet."""
        body = self.body(tram)
        leaves_at = self.known(tram).leaves_at if tram in self.system.centre.trams else leaves_at
        told = Report(body.stop, body.left, body.display.stands, leaves_at, self.system.centre.now_ms)
        self.step("tell", tram=tram, report=told)
        assert (tram, told) in self.system.told
        return told

    def tell(self, tram: Tram) -> None:
        """A tram tells how it is now, later than it told last, and the centre notes it."""
        if tram in self.system.centre.trams and self.known(tram).told_ms == self.system.centre.now_ms:
            self.wait(1)
        body, now_ms = self.body(tram), self.system.centre.now_ms
        told = self.report(tram)
        self.step("hear_report", tram=tram, told=told)
        known = self.known(tram)
        assert (known.stop, known.left, known.stands) == (body.stop, body.left, body.display.stands)
        assert known.told_ms == now_ms

    def run(self, tram: Tram, way_ms: int = 90_000, dwell_ms: int = 20_000) -> None:
        """From one stop to the next, and stand there."""
        self.depart(tram)
        self.wait(way_ms)
        self.arrive(tram)
        self.wait(dwell_ms)
        self.tell(tram)

    def order(self, tram: Tram, hand: Hand = Hand.NOTHING) -> Order:
        """The centre makes an order and sends it; nothing else goes out."""
        order = machine.order(LIMITS, self.system.centre, tram, hand)
        right = command_of(tram, order)
        before = self.system
        for wrong in (right._replace(stop=order.stop + 1), right._replace(tram=Tram("99"))):
            assert self.step("give_order", tram=tram, hand=hand, command=wrong) == before
        self.step("give_order", tram=tram, hand=hand, command=right)
        assert self.system.sent == before.sent | {right}
        assert (self.system.given.holds, self.system.given.recovers) == (order.holds, order.recovers)
        return order

    def says(self, tram: Tram, hand: Hand = Hand.NOTHING) -> tuple[bool, bool]:
        """Whether an order holds, and whether it lets recover."""
        order = self.order(tram, hand)
        return order.holds, order.recovers

    def deliver(self, tram: Tram, order: Order, to: Tram | None = None) -> tuple[bool, bool]:
        """A command comes to a tram; what its driver is shown then."""
        self.step("hear_order", tram=tram, command=command_of(to or tram, order))
        display = self.body(tram).display
        return display.holds, display.recovers


def two_stops_apart(ahead_stops: int = 3, since_ms: int = 240_000) -> Day:
    """Two trams: the first so many stops ahead, having left the stop of the second so long ago."""
    day = Day()
    day.come(FIRST, 1, 1)
    day.depart(FIRST)
    left_ms = day.system.centre.now_ms
    for _ in range(ahead_stops):
        day.wait(10)
        day.arrive(FIRST)
        day.wait(10)
        day.depart(FIRST)
    day.run_to(SECOND, 2, 1, tells=False)
    day.wait(left_ms + since_ms - day.system.centre.now_ms)
    day.tell(SECOND)
    return day
