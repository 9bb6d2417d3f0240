"""Approaches to curves and turnouts that a list has ahead, at the worst that motors, descent and brake may do (T12)."""

from __future__ import annotations

from kernel.onboard import braking as machine
from kernel.onboard import restriction_ahead
from kernel.onboard.braking import BrakeBounds
from kernel.onboard.ceiling import NONE as NO_CEILING
from kernel.onboard.restriction_ahead import NONE_LISTED, Ahead
from kernel.onboard.speed_limit import SpeedTable
from kernel.onboard.tag_kind import CURVE, GRADIENT, PLAIN, TURNOUT
from kernel.onboard.tag_kind import UNKNOWN as UNTOLD
from models.onboard.braking import Approach, Vehicle
from models.onboard.ceiling import AT_REST
from models.onboard.slowing import at_rest
from models.onboard.units import NM_A_MM
from proofs.onboard.braking import THEORY
from proofs.onboard.witnesses.play import Play
from proofs.onboard.witnesses.sixty_four_bits import Checked, with_ints

BOUNDS = BrakeBounds(
    gains_mm_s2=1_200, slows_mm_s2=700, response_cycles=15, standstill_mm_s=25, cut_cycles=15, falls_mm_s2=1_200
)
TABLE = SpeedTable(line_mm_s=60_000, curve_mm_s=25_000, turnout_mm_s=12_000)
END_MM, CURVE_MM, TURNOUT_MM = 9_000_000, 3_000_000, 4_000_000


class Train(Play[Vehicle, Approach]):
    """A train with its brake off, at rest far before its end."""

    def __init__(self, table: SpeedTable = TABLE, bounds: BrakeBounds = BOUNDS) -> None:
        """Begin."""
        brake = machine.Brake(applied=True, end_mm=0, withheld=True)
        begun = Approach(0, 0, 0, 0, 0, 0, False, False, brake, False, 0, at_rest(bounds, 0, 0), NO_CEILING, AT_REST)
        super().__init__(THEORY, Vehicle(bounds, table), begun)
        self.step("take_end", front_most_mm=0, speed_least_mm_s=0, speed_most_mm_s=0, end_mm=END_MM)

    def lists(self, kind: int, from_mm: int, *, curve: bool = False, turnout: bool = False, off_nm: int = 0) -> None:
        """A tag is listed ahead, with what lies from it on."""
        event = {"in_curve": curve, "at_turnout": turnout, "kind": kind, "from_mm": from_mm}
        self.step("list_tag", **event, begins_nm=NM_A_MM * from_mm + off_nm)

    def cycle(self, speed_um_s: int, *, acknowledged: bool = False, front_mm: int | None = None) -> None:
        """Get to a speed in one cycle, as far as can be."""
        before = self.system
        to_nm = before.head_nm + 102 * max(before.speed_um_s, speed_um_s)
        self.step(
            "run_a_cycle",
            front_most_mm=-(-before.head_nm // NM_A_MM) if front_mm is None else front_mm,
            speed_least_mm_s=before.speed_um_s // 1_000,
            speed_most_mm_s=-(-before.speed_um_s // 1_000),
            demanded=False,
            acknowledged=acknowledged,
            to_nm=to_nm,
            speed_um_s=speed_um_s,
        )
        assert (self.system.head_nm, self.system.speed_um_s) == (to_nm, speed_um_s)

    def worst_cycle(self) -> None:
        """As fast as it can: gaining until the brake responds, then slowing by what is guaranteed and no more."""
        responds = self.brakes() and self.system.slowing.response_cycles == 0
        speed_um_s = self.system.speed_um_s
        self.cycle(max(0, speed_um_s - 98 * 700) if responds else speed_um_s + 102 * 1_200)

    def release(self) -> None:
        """The driver acknowledges."""
        self.cycle(0, acknowledged=True)
        assert not self.brakes()

    def brakes(self) -> bool:
        """Whether the brake is commanded."""
        return self.system.brake.applied

    def head_mm(self) -> int:
        """Where the head is."""
        return self.system.head_nm // NM_A_MM


def needed_mm(speed_mm_s: int, to_mm_s: int) -> int:
    """The way that the rule keeps before a restriction, reckoned here anew; none for a train that is slow enough."""
    fast_um_s, slow_um_s = 1_000 * speed_mm_s + 16 * 102 * 1_200, 1_000 * to_mm_s
    way_nm = 17 * 102 * fast_um_s - (-(fast_um_s * fast_um_s - slow_um_s * slow_um_s) // (2 * 672))
    return -(-way_nm // NM_A_MM)


def at_its_worst_a_train_is_slow_enough_a_little_before_the_restriction() -> None:
    """Full power until the brake responds, then no more than is guaranteed: slow enough 20 m before, at most (T12)."""
    for kind, at_mm, to_mm_s in ((CURVE, CURVE_MM, 25_000), (TURNOUT, TURNOUT_MM, 12_000)):
        train = Train()
        train.release()
        train.lists(kind, at_mm, curve=kind == CURVE, turnout=kind == TURNOUT)
        while not train.brakes():
            train.worst_cycle()
        assert train.system.speed_um_s > 1_000 * to_mm_s
        while train.system.speed_um_s > 1_000 * to_mm_s:
            train.worst_cycle()
            assert train.brakes()
        assert at_mm - 20_000 < train.head_mm() < at_mm
        while train.system.speed_um_s > 0:
            train.worst_cycle()
            assert train.brakes(), "it goes off at a standstill only"
        assert train.head_mm() > at_mm
        train.release()


def to_the_millimetre_a_train_is_slowed_or_not() -> None:
    """At any speed down to any; one that stays below it even at its worst is not braked, wherever it is (T12)."""
    for speed_mm_s, to_mm_s in ((36_000, 25_000), (200_000, 0), (10_042, 12_000), (12_000, 12_000), (50_000, 49_000)):
        for front_mm in (0, -5_000_000, 7_000_000):
            at_mm = front_mm + needed_mm(speed_mm_s, to_mm_s)
            assert machine.slows_before(BOUNDS, front_mm, speed_mm_s, at_mm, to_mm_s)
            assert not machine.slows_before(BOUNDS, front_mm, speed_mm_s, at_mm - 1, to_mm_s)
    for at_mm in (-(10**12), 0, 1, 10**12):
        assert machine.slows_before(BOUNDS, 0, 10_041, at_mm, 12_000), "10.041 m/s and 16 cycles' gain: 11.999 m/s"
    assert machine.slows_before(BOUNDS, 0, 200_000, 10**9, 2**62), "no speed is beyond 200 m/s"
    assert not machine.slows_before(BOUNDS, 0, 200_000, 0, 2**62)
    assert not machine.slows_before(BOUNDS, 0, 0, 0, -1)


def a_slow_train_runs_into_a_restriction_unbraked() -> None:
    """However wide the range of its front is (T12)."""
    train = Train()
    train.release()
    train.lists(CURVE, CURVE_MM, curve=True)
    while train.system.speed_um_s < 20_000_000:
        train.cycle(train.system.speed_um_s + 100_000)
    while train.head_mm() < CURVE_MM + 500_000:
        train.cycle(20_000_000, front_mm=train.head_mm() + 400_000)
        assert not train.brakes()


def what_the_lines_speed_allows_restricts_nothing() -> None:
    """A curve that may be run through as fast as the line (T12)."""
    for curve_mm_s in (60_000, 60_001, 59_999):
        train = Train(SpeedTable(line_mm_s=60_000, curve_mm_s=curve_mm_s, turnout_mm_s=60_000))
        train.release()
        train.lists(UNTOLD, 2_000_000, curve=True, turnout=True)
        while train.system.speed_um_s < 59_000_000:
            train.cycle(train.system.speed_um_s + 122_400)
        while train.head_mm() < 2_100_000 and not train.brakes():
            train.cycle(59_000_000)
        assert train.brakes() == (curve_mm_s < 60_000)


def the_nearest_of_each_kind_counts() -> None:
    """In whatever order they are listed; a kind that is not told is the worst, and plain track is free (T12)."""
    ahead = NONE_LISTED
    for kind in (PLAIN, GRADIENT):
        assert restriction_ahead.note_listed(ahead, kind, 5) == NONE_LISTED
    for from_mm in (9, 7, 8):
        ahead = restriction_ahead.note_listed(ahead, CURVE, from_mm)
    assert ahead == Ahead(curve_mm=7, turnout_mm=NONE_LISTED.turnout_mm)
    ahead = restriction_ahead.note_listed(ahead, TURNOUT, 11)
    assert ahead == Ahead(curve_mm=7, turnout_mm=11)
    assert restriction_ahead.note_listed(ahead, UNTOLD, 6) == Ahead(curve_mm=6, turnout_mm=6)
    assert restriction_ahead.note_listed(ahead, UNTOLD, 10) == Ahead(curve_mm=7, turnout_mm=10)
    train = Train()
    for beyond_mm in (200_000, 0, 500_000):
        train.lists(CURVE, CURVE_MM + beyond_mm, curve=True)
        train.lists(TURNOUT, TURNOUT_MM + beyond_mm, turnout=True)
    assert train.system.slowing.ahead == Ahead(CURVE_MM, TURNOUT_MM)
    listed = (train.system.slowing.curve_nm, train.system.slowing.turnout_nm)
    assert listed == (NM_A_MM * CURVE_MM, NM_A_MM * TURNOUT_MM)
    train.step("list_none")
    assert train.system.slowing.ahead == NONE_LISTED
    train.release()
    while train.system.speed_um_s < 50_000_000:
        train.worst_cycle()
    while train.head_mm() < TURNOUT_MM:
        train.cycle(50_000_000)
        assert not train.brakes()


def a_nearer_end_does_not_put_off_what_slows_the_train() -> None:
    """The brake that is on for a restriction has responded, though an end is reckoned with anew (T9, T12)."""
    train = Train()
    train.release()
    train.lists(CURVE, CURVE_MM, curve=True)
    while not train.brakes():
        train.worst_cycle()
    for _ in range(15):
        train.worst_cycle()
    assert train.system.slowing.response_cycles == 0
    here_mm, speed_mm_s = -(-train.system.head_nm // NM_A_MM), -(-train.system.speed_um_s // 1_000)
    event = {"front_most_mm": here_mm, "speed_least_mm_s": 0, "speed_most_mm_s": speed_mm_s}
    train.step("take_end", **event, end_mm=END_MM - 1_000_000)
    assert train.system.response_cycles == 15
    assert train.system.slowing.response_cycles == 0
    held = train.system
    train.step(
        "run_a_cycle", **event, demanded=False, acknowledged=False, to_nm=held.head_nm, speed_um_s=held.speed_um_s
    )
    assert train.system == held, "a brake that has responded slows the train"
    while train.system.speed_um_s > 25_000_000:
        train.worst_cycle()
    assert train.head_mm() < CURVE_MM


def every_number_fits_into_64_bits() -> None:
    """Whatever the place and the speed that is allowed there (T12)."""
    checked = with_ints(Checked, BOUNDS)
    for front_mm, at_mm in ((10**9, -(2**62)), (-(10**9), 2**62), (0, 10**9), (2**62, 0), (-(2**62), 0)):
        for speed_mm_s in (0, 200_000, 2**62, -(2**62)):
            for to_mm_s in (0, 25_000, 200_000, 2**62, -(2**62)):
                told = (front_mm, speed_mm_s, at_mm, to_mm_s)
                answer = machine.slows_before(checked, *(Checked(each) for each in told))
                assert answer == machine.slows_before(BOUNDS, *told)


def no_list_hides_a_restriction() -> None:
    """Nor has it one farther away than it is (T1, T12)."""
    train = Train()
    before = train.system
    train.lists(PLAIN, CURVE_MM, curve=True)
    train.lists(CURVE, CURVE_MM, turnout=True)
    train.lists(CURVE, CURVE_MM, curve=True, off_nm=-1)
    assert train.system == before
    train.lists(CURVE, CURVE_MM, curve=True, off_nm=1)
    assert train.system != before


WITNESSES = (
    at_its_worst_a_train_is_slow_enough_a_little_before_the_restriction,
    to_the_millimetre_a_train_is_slowed_or_not,
    a_slow_train_runs_into_a_restriction_unbraked,
    what_the_lines_speed_allows_restricts_nothing,
    the_nearest_of_each_kind_counts,
    a_nearer_end_does_not_put_off_what_slows_the_train,
    every_number_fits_into_64_bits,
    no_list_hides_a_restriction,
)
