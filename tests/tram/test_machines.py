"""Stopping, the polling cycle and dispatching: their witnesses, drawn runs beside the truth, edges (G2 to G6)."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from random import Random

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from kernel.tram import centre as dispatcher
from kernel.tram import stopping as on_the_way
from kernel.tram.centre import Command, Tram
from kernel.tram.cycle import CYCLE_MS, SLOTS, STALE_MS, CycleLimits, Heard, is_fresh, is_in_slot, older
from kernel.tram.dispatching import Hand, Known, Order, Report, View, decided, mark
from kernel.tram.display import Display, begun, located, taken
from kernel.tram.display import older as shown_older
from kernel.tram.stopping import Fix, StopLimits, Stopping, note_fix
from models.tram.dispatching import Body
from proofs.tram.witnesses import cycle, dispatching, display, stopping
from proofs.tram.witnesses.cycle import Polling
from proofs.tram.witnesses.line import LIMITS, Day
from proofs.tram.witnesses.stopping import Along

HUGE = 2**61
ANY = st.one_of(st.integers(-HUGE, HUGE), st.integers(-30, 30))
FLAG = st.booleans()


@pytest.mark.parametrize("witness", [*dispatching.WITNESSES, *display.WITNESSES, *stopping.WITNESSES, *cycle.WITNESSES])
def test_witness(witness: Callable[[], None]) -> None:
    assert witness.__doc__
    witness()


# ---- stopping


@given(st.builds(Stopping, ANY, FLAG, FLAG, FLAG, ANY, ANY, FLAG), ANY, ANY, st.builds(Fix, FLAG, ANY, FLAG, ANY))
def test_no_fix_puts_a_tram_back(stopping_: Stopping, here_mm: int, next_mm: int, fix: Fix) -> None:
    """Whatever is measured: it goes on by one stop at most, and who stands has a place and a low speed (G2).

    But one that is before the stop that it had reached, or farther back than it was since it left that one, by more
    than errors make of it, begins anew.
    """
    now = note_fix(StopLimits(20_000, 50_000), stopping_, here_mm, next_mm, fix)
    if fix.is_placed and fix.place_mm < (stopping_.most_mm - 30_000 if stopping_.left else here_mm - 50_000):
        begun_anew = replace(on_the_way.begun(0), least_mm=fix.place_mm, most_mm=fix.place_mm)
        assert now == replace(begun_anew, is_followed=True)
    else:
        assert mark(stopping_.stop, stopping_.left) <= mark(now.stop, now.left) <= mark(stopping_.stop + 1, True)
    assert not now.stands or (fix.is_placed and fix.has_speed and fix.speed_mm_s < 1_389)


@settings(max_examples=60, deadline=None)
@given(st.integers(0, 2**32))
def test_in_drawn_runs_stops_are_reached_when_they_are(seed: int) -> None:
    """Every invariant is looked at after each fix; and a tram that stops at each stop is seen to (G2)."""
    chance, along = Random(seed), Along()
    stood = set()
    for stop in range(1, 6):
        for place_mm in range(400_000 * stop - 350_000, 400_000 * stop, chance.randrange(9_000, 60_000)):
            along.run(max(along.system.at_mm, place_mm))
            along.fix(chance.randint(-15_000, 15_000), chance.choice((0, 1_388, 1_389, 9_000)))
        along.run(400_000 * stop)
        for _ in range(chance.randrange(1, 5)):
            along.fix(0)
            number, _left, stands = along.fix(chance.randint(-15_000, 15_000))
            assert stands
            stood.add(number)
        if chance.random() < 0.3:
            along.fix(is_placed=False)
    assert stood == {1, 2, 3, 4, 5}


# ---- the cycle


@settings(max_examples=60, deadline=None)
@given(st.integers(0, 2**32))
def test_in_drawn_cycles_only_what_answered_is_known(seed: int) -> None:
    chance, polling = Random(seed), Polling()
    for _ in range(40):
        for _ in range(chance.randrange(4)):
            polling.answer(
                age := chance.choice((0, 3_000, 11_000, 11_001)),
                chance.randint(0, age),
                at_ms=chance.randrange(0, 4_000),
                is_sound=chance.random() < 0.8,
                is_asked=chance.random() < 0.8,
            )
            polling.step("pass_time", elapsed_ms=chance.randrange(0, 3_000))
        answered = polling.system.answered
        known = polling.cycle(chance.randrange(0, CYCLE_MS))
        assert answered or not known
        if chance.random() < 0.05:
            polling.step("restart")


@given(st.integers(1, 5_000), st.integers(1, 5_000), st.integers(1, 5_000), st.integers(0, 10**5))
def test_no_answer_is_in_two_slots(request_ms: int, slot_ms: int, answer_ms: int, at_ms: int) -> None:
    """Nor do two that are in theirs ever sound together (002, figure 2; G3)."""
    limits = CycleLimits(request_ms, slot_ms, answer_ms)
    slots = [slot for slot in range(SLOTS) if is_in_slot(limits, slot, at_ms)]
    assert len(slots) <= 1
    for slot in slots:
        for other in range(slot + 1, SLOTS):
            for later_ms in (at_ms, at_ms + answer_ms - 1):
                assert not is_in_slot(limits, other, later_ms)


@given(st.integers(-HUGE, HUGE), FLAG, FLAG, st.integers(0, HUGE))
def test_what_is_older_is_no_fresher(age_ms: int, is_known: bool, answered: bool, elapsed_ms: int) -> None:
    heard = Heard(0, is_known, age_ms, answered)
    assert is_fresh(heard) or not is_fresh(older(heard, elapsed_ms))
    assert is_fresh(heard) == (is_known and age_ms <= STALE_MS)


# ---- one order


KNOWN = st.builds(Known, ANY, ANY, ANY, FLAG, FLAG, ANY, ANY, ANY, FLAG)
VIEWS = st.builds(View, FLAG, FLAG, FLAG, FLAG, FLAG)


@given(ANY, KNOWN, VIEWS, st.sampled_from(Hand))
def test_an_order_follows_the_rules(now_ms: int, own: Known, view: View, hand: Hand) -> None:
    """Reckoned here anew (G4 to G6)."""
    order = decided(LIMITS, now_ms, own, view, hand)
    assert not (order.holds and order.recovers)
    assert (order.stop, order.made_ms) == (own.stop, now_ms)
    if order.holds or order.recovers:
        assert own.stands
        assert now_ms - own.told_ms <= 11_000
        assert own.stop < own.leaves_at
        assert hand != Hand.LIFT
    if order.recovers:
        assert view.is_clear
        assert view.ahead_is_far or hand == Hand.RECOVER
        assert hand != Hand.HOLD
    if order.holds and hand != Hand.HOLD:
        assert view.is_present or view.ahead_is_near or view.behind_is_far
        assert now_ms - own.arrived_ms < 60_000


DISPLAYS = st.builds(Display, ANY, FLAG, ANY, FLAG, FLAG, FLAG, ANY)


@given(DISPLAYS, st.builds(Order, ANY, FLAG, FLAG, ANY), ANY, FLAG, FLAG, st.integers(0, HUGE))
def test_nothing_but_an_order_lets_recover(
    display: Display, order: Order, stop: int, placed: bool, stands: bool, elapsed_ms: int
) -> None:
    """Places and time only take away; an order that is not for this stop changes nothing (G5, G6)."""
    for after in (located(display, placed, stop, stands), shown_older(LIMITS, display, elapsed_ms)):
        assert display.holds or not after.holds
        assert display.recovers or not after.recovers
    is_of_the_future = order.made_ms > display.now_ms
    if order.stop != display.stop or not display.stands or order.made_ms <= display.made_ms or is_of_the_future:
        assert taken(LIMITS, display, order) == display
    lost = located(display, False, stop, stands)
    assert lost == Display(display.now_ms, False, stop, False, False, False, display.made_ms)


# ---- a drawn day


class Drawn:
    """A day with a few trams, some from a depot midway, some that turn off; every invariant is looked at."""

    def __init__(self, seed: int) -> None:
        """Begin without trams."""
        self.chance, self.day = Random(seed), Day()
        self.names = [Tram(str(number)) for number in range(4)]
        self.recovered = self.held = 0

    def act(self) -> None:
        """Let one thing happen, possible or not, each later than the one before."""
        self.day.wait(1)
        chance, day, tram = self.chance, self.day, self.chance.choice(self.names)
        body, now_ms = day.system.bodies.get(tram), day.system.centre.now_ms
        drawn = chance.random()
        if drawn < 0.1:
            day.step("pass_time", elapsed_ms=chance.choice((1, 3_000, 11_000, 40_000, 240_000)))
        elif drawn < 0.2:
            self.come_or_go(tram, body)
        elif drawn < 0.205:
            day.step("restart_centre", now_ms=now_ms)
            day.wait(LIMITS.coming_ms + 1)
            if chance.random() < 0.7:
                for other in self.names:
                    day.step("leave", tram=other)
                day.clear(Tram("first"))
        elif body is None:
            told = Report(9, True, False, 9, now_ms)
            day.step("tell", tram=tram, report=told)
            day.step("hear_report", tram=tram, told=told)
            self.tell_beside(tram, now_ms)
        elif drawn < 0.5:
            self.move(tram, body)
        elif drawn < 0.7:
            stands = not body.left and chance.random() < 0.9
            told = Report(body.stop, body.left, stands, chance.randrange(9), now_ms)
            day.step("tell", tram=tram, report=told)
            day.step("hear_report", tram=tram, told=told)
            late = [report for other, report in day.system.told if other == tram]
            day.step("hear_report", tram=tram, told=chance.choice(late))
        else:
            self.see_and_command(tram)

    def tell_beside(self, tram: Tram, now_ms: int) -> None:
        """Let a tram that is off the way tell of any stop of it, which is heard now or later."""
        told = Report(self.chance.randrange(9), False, self.chance.random() < 0.5, 9, now_ms)
        self.day.step("tell_beside", tram=tram, report=told)
        late = sorted(self.day.system.told_beside, key=str)
        heard, report = self.chance.choice([(tram, told), (tram, told), *late])
        self.day.step("hear_report", tram=heard, told=report)

    def see_and_command(self, tram: Tram) -> None:
        """Let a tram, now and then, find its place and tell it just before the centre orders."""
        if self.chance.random() < 0.6:
            self.day.see(tram, stands=not self.day.body(tram).left)
            self.day.step("hear_report", tram=tram, told=self.day.report(tram))
        self.command(tram)

    def come_or_go(self, tram: Tram, body: Body | None) -> None:
        """Let a tram leave the way, tell from elsewhere, be taken up, and come, anywhere in the order."""
        chance, day = self.chance, self.day
        if body is not None and (body.stop > 5 or chance.random() < 0.1):
            day.step("leave", tram=tram)
            day.wait(1)
        day.step("tell_elsewhere", tram=tram)
        for made_ms in sorted(made_ms for other, made_ms in day.system.told_elsewhere if other == tram)[-2:]:
            day.step("hear_elsewhere", tram=tram, is_away=True, made_ms=made_ms)
        if chance.random() < 0.5:
            day.step("take_off", tram=tram)
        day.step("take_up", tram=tram, stop=chance.choice((0, 0, 1, 2, 3)), leaves_at=chance.randrange(4, 12))
        run = day.system.runs.get(tram)
        if run is not None and chance.random() < 0.8:
            last = max([0, *(other.rank for other in dict(day.system.bodies.items()).values())])
            rank = chance.randrange(-5, 40) if run.stop else 1 + last
            new = Body(rank, run.stop, False, begun(0), 0)
            begun_ms = chance.choice((run.at_ms, day.system.now_ms))
            day.step("come", tram=tram, body=new, now_ms=day.system.now_ms, begun_ms=begun_ms)

    def move(self, tram: Tram, body: Body) -> None:
        """Let a tram move, or find its place, or lose it."""
        chance, day = self.chance, self.day
        noticed = chance.random() < 0.8
        day.step("take_place", tram=tram, is_located=noticed, told_stop=body.stop, stands=not body.left)
        if chance.random() < 0.5:
            day.step("depart", tram=tram)
            day.see(tram, stands=not day.body(tram).left)
            day.step("hear_report", tram=tram, told=day.report(tram))
        stands = chance.random() < 0.9
        day.step("arrive", tram=tram, noticed=noticed, told_stop=body.stop + 1, stands=stands)

    def command(self, tram: Tram) -> None:
        """Let the centre order, and something ordered arrive somewhere."""
        chance, day = self.chance, self.day
        day.order(tram, chance.choice((Hand.NOTHING, Hand.NOTHING, *Hand)))
        old = sorted(day.system.sent, key=lambda each: (each.made_ms, each))
        command: Command = chance.choice([*old[-3:], old[-1], chance.choice(old)])
        day.step("hear_order", tram=chance.choice((tram, command.tram)), command=command)
        self.recovered += any(body.display.recovers for body in day.system.bodies.values())  # type: ignore[attr-defined]
        self.held += any(body.display.holds for body in day.system.bodies.values())  # type: ignore[attr-defined]


@pytest.mark.parametrize("seeds", [range(7, 15), pytest.param(range(25), marks=pytest.mark.slow)])
def test_in_drawn_days_every_invariant_holds_and_orders_are_given(seeds: range) -> None:
    recovered = held = 0
    for seed in seeds:
        drawn = Drawn(seed)
        for _ in range(300):
            drawn.act()
        recovered += drawn.recovered
        held += drawn.held
    assert recovered > len(seeds)
    assert held > len(seeds)


@given(st.integers(0, 2**16), st.integers(0, 3))
def test_one_tram_more_never_clears_a_way(seed: int, place: int) -> None:
    """Not knowing counts as present: whatever is known of one tram more, nobody recovers who did not (G5)."""
    drawn = Drawn(seed)
    for _ in range(60):
        drawn.act()
    centre = drawn.day.system.centre
    known = Known(9, 0, place, True, True, 0, 0, 0, 0)
    more = replace(centre, trams={**dict(centre.trams.items()), Tram("more"): known})
    for tram, own in centre.trams.items():
        assert dispatcher.is_clear(centre, tram, own) or not dispatcher.is_clear(more, tram, own)
