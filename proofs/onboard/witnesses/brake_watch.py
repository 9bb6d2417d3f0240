"""A train that keeps to the bounds of its brake and motors, and one that does not (T12)."""

from __future__ import annotations

from kernel.onboard import brake_watch as machine
from kernel.onboard.braking import BrakeBounds
from models.onboard.brake_watch import Vehicle, Watched
from proofs.onboard.brake_watch import THEORY
from proofs.onboard.witnesses.play import Play

BOUNDS = BrakeBounds(
    gains_mm_s2=1_000, slows_mm_s2=750, response_cycles=3, standstill_mm_s=25, cut_cycles=1, falls_mm_s2=300
)
"""In a cycle of 102 ms motors gain 102 mm/s at most, and the brake takes 73.5 mm/s at least in one of 98."""
SITE = Vehicle(BOUNDS)


class Train(Play[Vehicle, Watched]):
    """A train at 20 m/s, and how its watch sees it."""

    def __init__(self, mm_s: int = 20_000) -> None:
        """Begin at rest, and be inspected at a speed that is known to a millimetre per second."""
        super().__init__(THEORY, SITE, Watched(0, 0, False, True, 0, False, machine.restarted()))
        self.cycle(1_000 * mm_s, applied=False)
        self.inspect(mm_s)

    def cycle(self, um_s: int, *, applied: bool, off_mm_s: int = 0, known: bool = True) -> None:
        """A cycle, and the speed after it; what odometry gives is rounded and ``off_mm_s`` wide on both sides."""
        self.step(
            "run_a_cycle",
            applied=applied,
            known=known,
            speed_least_mm_s=um_s // 1_000 - off_mm_s,
            speed_most_mm_s=-(-um_s // 1_000) + off_mm_s,
            speed_um_s=um_s,
        )
        assert self.system.speed_um_s == um_s

    def respond(self) -> None:
        """The brake is commanded, and has responded after this."""
        for _ in range(3):
            self.cycle(self.system.speed_um_s, applied=True)

    def inspect(self, mm_s: int) -> None:
        """Staff inspects it at this speed."""
        self.step("inspect", speed_least_mm_s=mm_s, speed_most_mm_s=mm_s)

    def was_inspected(self) -> bool:
        """Whether it was since its unit began."""
        return self.system.inspected

    def has_kept(self) -> bool:
        """Whether it has kept to its bounds."""
        return self.system.kept

    def was_too_fast(self) -> bool:
        """Whether it was certainly too fast once."""
        return self.system.too_fast

    def is_accused(self) -> bool:
        """Whether the watch has found a bound broken."""
        return self.system.watch.broken

    def limit_mm_s(self) -> int:
        """The limit that the watch knows."""
        return self.system.watch.limit_mm_s


def motors_may_gain_as_much_as_written() -> None:
    """For as long as they will, the brake being off: at the bound nobody is accused (T12)."""
    train = Train()
    for cycle in range(1, 50):
        train.cycle(20_000_000 + cycle * 102_000, applied=False)
        assert not train.is_accused()
        assert train.system.kept
        assert train.limit_mm_s() == 20_000 + cycle * 102


def motors_that_gain_more_are_accused() -> None:
    """By a whole mm/s more than is written, in one cycle, with the brake commanded or not (T12)."""
    for applied in (False, True):
        train = Train()
        train.cycle(20_102_001, applied=applied)
        assert not train.system.kept
        assert not train.is_accused()
        train = Train()
        train.cycle(20_103_000, applied=applied)
        assert not train.system.kept
        assert train.is_accused()


def motors_not_cut_are_accused() -> None:
    """What gains speed although the brake should have responded (T12)."""
    train = Train()
    train.respond()
    assert not train.is_accused()
    train.cycle(20_001_000, applied=True)
    assert train.is_accused()


def a_brake_that_slows_as_guaranteed_is_not_accused() -> None:
    """Down to a standstill, and there; a limit is no lower than zero (T12)."""
    train = Train(1_000)
    train.respond()
    for cycle in range(1, 20):
        train.cycle(max(0, 1_000_000 - cycle * 73_500), applied=True)
        assert not train.is_accused()
        assert train.system.kept
    assert train.limit_mm_s() == 0
    assert train.system.speed_um_s == 0


def a_weak_brake_is_accused() -> None:
    """One that slows by less than is guaranteed, as soon as the difference shows in whole mm/s (T12)."""
    train = Train()
    train.respond()
    train.cycle(19_927_000, applied=True)
    assert not train.system.kept
    assert not train.is_accused()
    assert train.limit_mm_s() == 19_927
    train = Train()
    train.respond()
    train.cycle(19_928_000, applied=True)
    assert not train.system.kept
    assert train.is_accused()
    train = Train(50)
    train.respond()
    train.cycle(1_000, applied=True)
    assert not train.system.kept
    assert train.is_accused()


def a_weak_brake_is_found_through_a_wide_range() -> None:
    """The longer it brakes, the more it lags behind; a range of 1 m/s hides 23 mm/s a cycle for 2.2 s (T12)."""
    train = Train()
    train.respond()
    cycles = 0
    while cycles < 100 and not train.is_accused():
        cycles += 1
        train.cycle(20_000_000 - cycles * 50_000, applied=True, off_mm_s=500)
    assert cycles == 22


def the_response_is_waited_for() -> None:
    """Three cycles after the command the brake must have responded, and not before; released, it begins anew (T12)."""
    train = Train()
    for cycle in range(1, 4):
        train.cycle(20_000_000 + cycle * 102_000, applied=True)
        assert train.system.watch.cycles == cycle
        assert not train.is_accused()
    train.cycle(20_232_000, applied=True)
    assert train.system.watch.cycles == 3
    assert train.system.kept
    train.cycle(20_334_000, applied=False)
    assert train.system.watch.cycles == 0
    train.cycle(20_436_000, applied=True)
    assert train.system.watch.cycles == 1
    assert train.system.kept
    assert not train.is_accused()


def a_train_without_a_range_is_not_judged() -> None:
    """Nothing is measured then; what it may have gained meanwhile is allowed it after (T12, P7)."""
    train = Train()
    for _ in range(3):
        train.cycle(20_500_000, applied=False, known=False, off_mm_s=-7_000)
    assert not train.is_accused()
    assert train.limit_mm_s() == 20_306
    train.cycle(20_408_000, applied=False)
    assert not train.is_accused()
    train.cycle(20_511_000, applied=False)
    assert train.is_accused()


def a_train_that_rolls_back_is_not_accused_of_its_brakes() -> None:
    """They act forward, and stop it; what it gains is reckoned from a standstill (T5, T12)."""
    train = Train(0)
    train.cycle(-500_000, applied=True)
    assert train.limit_mm_s() == 0
    train.cycle(-300_000, applied=True)
    train.cycle(0, applied=True)
    assert not train.is_accused()
    assert train.system.kept


def an_accusation_stays() -> None:
    """However well it brakes then, and though the unit is switched off and on: until it is inspected (T8, T12)."""
    train = Train()
    train.cycle(20_200_000, applied=False)
    assert train.is_accused()
    train.cycle(19_000_000, applied=False)
    train.respond()
    train.cycle(18_000_000, applied=True)
    assert train.is_accused()
    assert not train.has_kept()
    train.step("restart")
    assert train.is_accused()
    assert train.was_too_fast()
    train.inspect(18_000)
    assert not train.is_accused()
    assert train.has_kept()
    assert not train.was_too_fast()


def a_unit_that_begins_waits_for_an_inspection() -> None:
    """At rest; whoever begins to watch a train that runs says nothing of it (T8, T12)."""
    train = Train(0)
    train.respond()
    train.step("restart")
    assert train.is_accused()
    assert train.has_kept()
    assert not train.was_inspected()
    assert train.system.watch.cycles == train.system.cycles == 0
    train.respond()
    train.step("inspect", speed_least_mm_s=0, speed_most_mm_s=10)
    assert train.was_inspected()
    assert train.limit_mm_s() == 10
    assert train.system.watch.cycles == train.system.cycles == 3
    train = Train(100)
    train.step("restart")
    assert not train.has_kept()


def whoever_is_inspected_is_watched_from_there() -> None:
    """By the speed that is known then, and by none below 0 (T12)."""
    train = Train(0)
    train.cycle(-500_000, applied=True)
    before = train.system
    assert train.step("inspect", speed_least_mm_s=-600, speed_most_mm_s=-501) == before
    train.inspect(-500)
    assert train.limit_mm_s() == train.system.allowed_mm_s == 0


def a_train_certainly_too_fast_is_noted() -> None:
    """Once is enough, by the lower end of a range that is known; history keeps it (T12)."""
    train = Train()
    for um_s, off_mm_s, known in ((20_102_000, 0, True), (20_205_000, 1, True), (30_000_000, 0, False)):
        train.cycle(um_s, applied=False, off_mm_s=off_mm_s, known=known)
        assert not train.system.too_fast
    train = Train()
    train.cycle(20_103_000, applied=False)
    assert train.system.too_fast
    for um_s in (20_103_000, 15_000_000):
        train.cycle(um_s, applied=False)
        assert train.system.too_fast


def the_limit_is_never_above_what_is_measured() -> None:
    """A train that was slower than it might have been is judged from there (T12)."""
    train = Train()
    train.cycle(15_000_000, applied=False, off_mm_s=10)
    assert train.limit_mm_s() == 15_010
    train.cycle(15_000_000, applied=False, off_mm_s=300)
    assert train.limit_mm_s() == 15_112
    train.cycle(15_216_000, applied=False)
    assert train.is_accused()


def a_train_outside_its_range_is_not_looked_at() -> None:
    """What odometry does not say does not happen; at both ends of the range it does."""
    train = Train()
    before = train.system
    told = {"applied": False, "known": True, "speed_least_mm_s": 19_000, "speed_most_mm_s": 20_000}
    for um_s in (18_999_999, 20_000_001):
        assert train.step("run_a_cycle", **told, speed_um_s=um_s) == before
    for um_s in (19_000_000, 20_000_000):
        assert train.step("run_a_cycle", **told, speed_um_s=um_s).speed_um_s == um_s


def a_brake_that_was_released_is_waited_for_anew() -> None:
    """Though it was put on again before the cycle ended (T12)."""
    train = Train()
    train.respond()
    train.step("release")
    train.cycle(20_102_000, applied=True)
    assert train.system.kept
    assert not train.is_accused()
    assert (train.system.cycles, train.system.watch.cycles) == (1, 1)


WITNESSES = (
    motors_may_gain_as_much_as_written,
    motors_that_gain_more_are_accused,
    motors_not_cut_are_accused,
    a_brake_that_slows_as_guaranteed_is_not_accused,
    a_weak_brake_is_accused,
    a_weak_brake_is_found_through_a_wide_range,
    the_response_is_waited_for,
    a_train_without_a_range_is_not_judged,
    a_train_that_rolls_back_is_not_accused_of_its_brakes,
    a_brake_that_was_released_is_waited_for_anew,
    an_accusation_stays,
    a_unit_that_begins_waits_for_an_inspection,
    whoever_is_inspected_is_watched_from_there,
    a_train_certainly_too_fast_is_noted,
    the_limit_is_never_above_what_is_measured,
    a_train_outside_its_range_is_not_looked_at,
)
