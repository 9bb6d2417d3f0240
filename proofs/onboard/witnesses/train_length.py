"""Trains of known length, measured at a curve or a tag, at the edges of every error (P4, T3, P8)."""

from __future__ import annotations

from dataclasses import replace

from kernel.onboard import train_length as machine
from kernel.onboard.train_length import LengthBounds, Passing, PointKind
from models.onboard.train_length import Formation, Railway, can_be_compared, tail_passes
from proofs.onboard.train_length import THEORY
from proofs.onboard.witnesses.play import Play

BOUNDS = LengthBounds(
    line_maximum_mm=250_000,
    last_vehicle_mm=20_000,
    front_overhang_mm=3_000,
    rear_overhang_mm=2_000,
    window_mm=513,
    width_mm=20_000,
)
SITE = Railway(BOUNDS)
LENGTH_MM = 120_000
JUST_STARTED = Formation(
    length_nm=LENGTH_MM * 1_000_000,
    state=machine.UNMEASURED,
    head_passed=False,
    kind=PointKind.FEATURE,
    point=0,
    time_ms=0,
    front_nm=0,
    speed_mm_s=0,
    was_known=False,
    width_mm=0,
    told_mm_s=0,
    tail_passed=False,
    both_passed=False,
    untold=False,
    measured_nm=0,
    open_nm=0,
    differed=False,
)
CURVE = Passing(PointKind.FEATURE, 7, 1_000, True, 0, 0, 36_112)
"""The head at 130 km/h, with the front known to a millimetre."""
TAG = replace(CURVE, kind=PointKind.TAG)


class Train(Play[Railway, Formation]):
    """A train of 120 m, just started, and what its ends pass."""

    def __init__(self) -> None:
        """Begin."""
        super().__init__(THEORY, SITE, JUST_STARTED)

    def head(self, passing: Passing) -> None:
        """The head passes; its front is the least of the range."""
        before = self.system
        self.step(
            "head_passes",
            front_nm=passing.front_least_mm * 1_000_000,
            speed_mm_s=passing.speed_most_mm_s,
            passing=passing,
        )
        assert self.system.head_passed
        assert self.system.point == passing.point
        assert self.system.state.measured == before.state.measured

    def tail(self, passing: Passing, *, sampling: int = 0, skew: int = 0, averaging: int = 0, sensor: int = 0) -> None:
        """The tail passes, noted off by these errors in µm; the front is at ``front_most_mm`` or just above."""
        self.step(
            "tail_passes",
            front_nm=passing.front_most_mm * 1_000_000,
            speed_mm_s=passing.speed_most_mm_s,
            sampling_nm=sampling * 1_000,
            skew_nm=skew * 1_000,
            averaging_nm=averaging * 1_000,
            sensor_nm=sensor * 1_000,
            passing=passing,
        )
        assert self.system.tail_passed

    @staticmethod
    def later(passing: Passing, way_mm: int) -> Passing:
        """The tail's pass of a point that the head has passed ``way_mm`` ago."""
        front_mm = passing.front_least_mm + way_mm
        return replace(passing, time_ms=passing.time_ms + 5_000, front_least_mm=front_mm, front_most_mm=front_mm)

    def used_mm(self) -> int:
        """The length that the unit reckons with."""
        return machine.length_mm(BOUNDS, self.system.state)


def measured() -> Train:
    """A train that was measured at a curve."""
    train = Train()
    train.head(CURVE)
    train.tail(train.later(CURVE, 100_000))
    assert train.system.state.measured
    return train


def the_error_at_130_km_h_is_13_m() -> None:
    """The terms of paper 001, table 2, add up to what it says (P8)."""
    assert machine.error_mm(BOUNDS, PointKind.FEATURE, 36_112) == 3_612 + 3_612 + 782 + 5_000
    assert machine.error_mm(BOUNDS, PointKind.FEATURE, 0) == 5_782


def a_train_is_measured_at_a_curve() -> None:
    """Without errors, what is used is the length and E(v) (P4)."""
    train = Train()
    assert train.used_mm() == 250_000
    train.head(CURVE)
    assert train.used_mm() == 250_000
    train.tail(train.later(CURVE, 100_000))
    assert train.used_mm() == 120_000 + 13_006
    assert not machine.contradicts_the_line(BOUNDS, train.system.state)


def a_train_measured_as_short_as_can_be_is_not_underestimated() -> None:
    """All four errors at their worst leave what is rounded up (P4, P8)."""
    train = Train()
    train.head(CURVE)
    cycle = 3_611_200
    short = Train.later(CURVE, 100_000 - 13_003)
    train.tail(short, sampling=-cycle, skew=-cycle, averaging=-780_600, sensor=-5_000_000)
    assert train.used_mm() == 120_003


def a_train_is_measured_at_a_tag() -> None:
    """Both overhangs, the window, and one cycle (T3)."""
    train = Train()
    train.head(TAG)
    train.tail(train.later(TAG, 115_000))
    assert train.used_mm() == 120_000 + 3_612 + 513


def the_wider_range_and_the_higher_speed_count() -> None:
    """Least place at the head's pass, most at the tail's, the higher speed of both (P4)."""
    train = Train()
    train.head(replace(CURVE, front_least_mm=-1_000, front_most_mm=2_000, speed_most_mm_s=10_000))
    tail = train.later(replace(CURVE, speed_most_mm_s=20_000), 99_000)
    train.tail(replace(tail, front_least_mm=90_000))
    assert train.used_mm() == 120_000 + 2 * 2_000 + 5_782
    train = Train()
    train.head(replace(CURVE, speed_most_mm_s=20_000))
    train.tail(replace(train.later(CURVE, 100_000), speed_most_mm_s=10_000))
    assert train.used_mm() == 120_000 + 2 * 2_000 + 5_782


def a_pass_is_off_by_a_cycle_at_the_higher_speed() -> None:
    """Sampling at 20 m/s may err by 2 m, whichever end was the faster, and no more than that (P8)."""
    for head_mm_s, tail_mm_s in ((20_000, 10_000), (10_000, 20_000)):
        train = Train()
        train.head(replace(CURVE, speed_most_mm_s=head_mm_s))
        late = replace(train.later(CURVE, 102_000), speed_most_mm_s=tail_mm_s)
        train.tail(late, sampling=2_000_000)
        assert train.used_mm() == 120_000 + 2_000 + 2 * 2_000 + 5_782


def a_measured_length_stays() -> None:
    """Another point measures nothing any more, until the formation changes (paper 001, 3.1; P4)."""
    train = Train()
    train.head(CURVE)
    train.tail(train.later(CURVE, 100_000))
    slower = replace(train.later(CURVE, 500_000), speed_most_mm_s=0)
    train.head(slower)
    train.tail(train.later(slower, 100_000))
    assert train.used_mm() == 133_006
    train.step("change_formation", length_nm=200_000_000_000)
    assert not train.system.tail_passed
    assert not train.system.both_passed
    assert train.used_mm() == 250_000
    train.head(slower)
    train.tail(train.later(slower, 180_000))
    assert train.used_mm() == 205_782


def a_train_measured_again_contradicts_nothing() -> None:
    """As long as can be at one point and as short as can be at the next: the errors of both cover it (P4, P8)."""
    train = Train()
    train.head(CURVE)
    cycle = 3_611_200
    train.tail(train.later(CURVE, 113_003), sampling=cycle, skew=cycle, averaging=780_600, sensor=5_000_000)
    second = train.later(CURVE, 500_000)
    train.head(second)
    train.tail(train.later(second, 86_997), sampling=-cycle, skew=-cycle, averaging=-780_600, sensor=-5_000_000)
    assert train.used_mm() == 120_000 + 13_003 + 13_006
    assert not machine.contradicts_itself(train.system.state)


def vehicles_coupled_untold_are_noticed_at_the_next_point() -> None:
    """Three cars more, and nobody tells: too short until both ends have passed a point, the line's greatest then (P4).

    It stays so, whatever is measured later, until staff tells the formation.
    """
    train = Train()
    train.head(CURVE)
    train.tail(train.later(CURVE, 100_000))
    train.step("change_formation_untold", length_nm=180_000_000_000)
    assert train.system.untold
    assert train.used_mm() == 133_006
    second = train.later(CURVE, 500_000)
    train.head(second)
    train.tail(train.later(second, 160_000))
    assert train.system.differed
    assert machine.contradicts_itself(train.system.state)
    assert train.used_mm() == 250_000
    train.tail(train.later(second, 160_000))
    assert train.used_mm() == 250_000
    train.step("change_formation", length_nm=180_000_000_000)
    train.head(second)
    train.tail(train.later(second, 160_000))
    assert train.used_mm() == 193_006
    assert not machine.contradicts_itself(train.system.state)


def another_length_stays_noted_when_the_first_is_measured_again() -> None:
    """Coupled untold, measured, and set out again: that the train once was longer is not taken back (P4)."""
    train = measured()
    for length_mm in (180_000, 120_000):
        train.step("change_formation_untold", length_nm=length_mm * 1_000_000)
        train.head(CURVE)
        train.tail(train.later(CURVE, length_mm - 20_000))
        assert train.system.differed


def what_was_untold_before_a_length_is_measured_is_in_it() -> None:
    """The length measured is that of the train with its new cars; until then nothing is noted of it (P4)."""
    train = Train()
    train.head(CURVE)
    train.step("change_formation_untold", length_nm=180_000_000_000)
    train.tail(train.later(replace(CURVE, point=8), 100_000))
    before = train.system
    assert (before.untold, before.measured_nm, before.open_nm) == (True, 0, 0)
    train.tail(train.later(CURVE, 160_000))
    after = train.system
    assert (after.untold, after.measured_nm) == (False, 180_000_000_000)
    assert train.used_mm() == 193_006


def a_first_measurement_differs_from_none() -> None:
    """Whatever differed before belongs to a length that is used no more (P4)."""
    train = Train()
    train.head(CURVE)
    after = tail_passes(
        SITE, replace(train.system, differed=True), front_nm=100_000_000_000, speed_mm_s=0, sampling_nm=0, skew_nm=0,
        averaging_nm=0, sensor_nm=0, passing=train.later(CURVE, 100_000),
    )  # fmt: skip
    assert after.state.measured
    assert not after.differed


def a_new_formation_has_no_history() -> None:
    """Once told, or restarted, it was neither changed untold nor measured (P4, T3)."""
    for what in ({"length_nm": 240_000_000_000}, {}):
        train = measured()
        assert train.system.open_nm > 0
        train.step("change_formation_untold", length_nm=180_000_000_000)
        train.step("change_formation" if what else "restart", **what)
        assert not train.system.untold
        assert (train.system.measured_nm, train.system.open_nm) == (train.system.length_nm, 0)


def cars_set_out_untold_are_noticed_too() -> None:
    """A train that has become shorter was not underestimated; what it leaves behind is another matter (P4, P5)."""
    train = Train()
    train.head(CURVE)
    train.tail(train.later(CURVE, 100_000))
    train.step("change_formation_untold", length_nm=60_000_000_000)
    second = train.later(CURVE, 500_000)
    train.head(second)
    train.tail(train.later(second, 40_000))
    assert machine.contradicts_itself(train.system.state)
    assert train.used_mm() == 250_000


def another_measured_above_the_line_is_kept_the_longer() -> None:
    """Where the second measurement is above the line's greatest length, it is used (P4; ours)."""
    state = machine.note_head_pass(BOUNDS, machine.UNMEASURED, CURVE)
    state = machine.note_tail_pass(BOUNDS, state, Train.later(CURVE, 100_000))
    state = machine.note_tail_pass(BOUNDS, state, Train.later(CURVE, 280_000))
    assert machine.length_mm(BOUNDS, state) == 313_006
    assert machine.contradicts_itself(state)
    assert not machine.contradicts_the_line(BOUNDS, state)


def a_jump_of_kilometrage_measures_nothing() -> None:
    """Ends changed, or located anew, between the two passes: -118,000 mm were measured so, and were used (P4)."""
    train = Train()
    train.head(replace(CURVE, front_least_mm=900_000, front_most_mm=900_000))
    train.step("change_kilometrage")
    assert not train.system.head_passed
    train.tail(train.later(CURVE, 100_000))
    assert train.used_mm() == 250_000
    train.head(CURVE)
    train.tail(train.later(CURVE, 100_000))
    train.step("change_kilometrage")
    assert train.used_mm() == 133_006


def no_train_is_shorter_than_its_last_vehicle() -> None:
    """A jump that nobody has told: what comes out shorter is no measurement (P4; ours)."""
    state = machine.note_head_pass(BOUNDS, machine.UNMEASURED, CURVE)
    assert not machine.note_tail_pass(BOUNDS, state, Train.later(CURVE, -13_007)).measured
    assert machine.note_tail_pass(BOUNDS, state, Train.later(CURVE, -13_006)).measured


def a_front_known_worse_than_is_written_is_no_pass() -> None:
    """A range as wide as is written counts, at the head and at the tail; a wider one is not compared (P4, P7)."""
    for more_mm, used_mm in ((0, 120_000 + 13_006 + 20_000), (1, 250_000)):
        train = Train()
        train.head(CURVE)
        tail = train.later(CURVE, 120_000 + more_mm)
        train.step(
            "tail_passes", front_nm=100_000_000_000, speed_mm_s=0, sampling_nm=0, skew_nm=0, averaging_nm=0,
            sensor_nm=0, passing=replace(tail, front_least_mm=100_000),
        )  # fmt: skip
        assert train.used_mm() == used_mm
        assert machine.note_head_pass(
            BOUNDS, machine.UNMEASURED, replace(CURVE, front_most_mm=20_000 + more_mm)
        ).head_passed == (more_mm == 0)


def a_pass_of_the_old_formation_does_not_count() -> None:
    """Coupled, or restarted, between the head's pass and the tail's: nothing is measured (P4, T3)."""
    for what in ({"length_nm": 240_000_000_000}, {}):
        train = Train()
        train.head(CURVE)
        train.tail(train.later(CURVE, 100_000))
        assert train.system.state.measured
        train.head(CURVE)
        train.step("change_formation" if what else "restart", **what)
        assert not train.system.head_passed
        assert not train.system.tail_passed
        assert not train.system.both_passed
        train.tail(train.later(CURVE, 100_000))
        assert train.used_mm() == 250_000


def only_the_heads_point_counts() -> None:
    """Another feature, a tag of the same number, or a pass no later than the head's: nothing (P4)."""
    train = Train()
    train.tail(train.later(CURVE, 10_000))
    train.head(CURVE)
    assert train.used_mm() == 250_000
    near = train.later(CURVE, 10_000)
    for other in (replace(near, point=8), replace(near, kind=PointKind.TAG), replace(near, time_ms=CURVE.time_ms)):
        train = Train()
        train.head(CURVE)
        train.tail(other)
        assert train.used_mm() == 250_000
        assert not train.system.both_passed
        train.tail(train.later(CURVE, 100_000))
        assert train.used_mm() == 133_006
        assert train.system.both_passed


def the_head_waits_at_its_last_point() -> None:
    """A later point of the head takes the place of the one before (P4)."""
    train = Train()
    train.head(CURVE)
    train.head(replace(train.later(CURVE, 50_000), point=8))
    train.tail(train.later(CURVE, 100_000))
    assert train.used_mm() == 250_000


def a_pass_out_of_range_is_none() -> None:
    """What odometry cannot have told measures nothing, at the head or at the tail (P4)."""
    far = machine.GREATEST_PLACE_MM + 1
    wild = (
        replace(CURVE, front_most_mm=far),
        replace(CURVE, front_least_mm=-far),
        replace(CURVE, front_least_mm=1),
        replace(CURVE, speed_most_mm_s=200_001),
        replace(CURVE, speed_most_mm_s=-1),
    )
    good = Train.later(CURVE, 100_000)
    for passing in wild:
        noted = machine.note_head_pass(BOUNDS, machine.UNMEASURED, passing)
        assert not noted.head_passed
        assert not machine.note_tail_pass(BOUNDS, noted, good).measured
        noted = machine.note_head_pass(BOUNDS, machine.UNMEASURED, CURVE)
        late = replace(passing, time_ms=CURVE.time_ms + 1)
        assert not machine.note_tail_pass(BOUNDS, noted, late).measured
        assert machine.note_tail_pass(BOUNDS, noted, good).measured
    edge = replace(good, front_least_mm=far - 1, front_most_mm=far - 1, speed_most_mm_s=200_000)
    begin = replace(CURVE, front_least_mm=1 - far, front_most_mm=1 - far)
    assert machine.note_tail_pass(BOUNDS, machine.note_head_pass(BOUNDS, machine.UNMEASURED, begin), edge).measured


def places_end_at_10_000_km() -> None:
    """On either side of zero: a front there is a place, and a millimetre beyond it is none (P4)."""
    for place_mm, is_one in ((10_000_000_000, True), (10_000_000_001, False)):
        assert machine.fits(BOUNDS, replace(CURVE, front_least_mm=place_mm, front_most_mm=place_mm)) == is_one
        assert machine.fits(BOUNDS, replace(CURVE, front_least_mm=-place_mm, front_most_mm=-place_mm)) == is_one


def a_range_that_reaches_beyond_9_000_km_is_not_compared() -> None:
    """At either of its ends; out there another length need not be noticed (P4)."""
    far_mm = 9_000_000_000
    train = Train()
    train.head(CURVE)
    least = replace(train.later(CURVE, -far_mm), front_most_mm=1_000 - far_mm)
    most = replace(train.later(CURVE, far_mm), front_least_mm=far_mm - 1_000)
    for inside in (least, most):
        assert can_be_compared(SITE, train.system, inside)
    assert not can_be_compared(SITE, train.system, replace(least, front_least_mm=-far_mm - 1))
    assert not can_be_compared(SITE, train.system, replace(most, front_most_mm=far_mm + 1))


def more_than_the_line_allows_is_kept_and_shown() -> None:
    """Bounds on top of a train near the limit: the larger is used; shown once even the least is more (P4; ours)."""
    train = Train()
    train.step("change_formation", length_nm=236_994_000_000)
    train.head(CURVE)
    train.tail(train.later(CURVE, 216_994))
    assert train.used_mm() == 250_000
    assert not machine.contradicts_the_line(BOUNDS, train.system.state)
    train.step("change_formation", length_nm=250_000_000_000)
    train.head(CURVE)
    train.tail(train.later(CURVE, 230_000))
    assert train.used_mm() == 263_006
    assert not machine.contradicts_the_line(BOUNDS, train.system.state)
    for length_mm, shown in ((263_006, False), (263_007, True)):
        train.step("restart")
        train.step("change_formation_untold", length_nm=length_mm * 1_000_000)
        train.head(CURVE)
        train.tail(train.later(CURVE, length_mm - 20_000))
        assert machine.contradicts_the_line(BOUNDS, train.system.state) == shown


def what_nature_does_not_do_does_not_happen() -> None:
    """A front outside its range, a speed above the one told, an error beyond its bound, a train too long."""
    train = Train()
    train.head(CURVE)
    good = train.later(CURVE, 100_000)
    nothing = {"sampling_nm": 0, "skew_nm": 0, "averaging_nm": 0, "sensor_nm": 0}
    told = {"front_nm": 100_000_000_000, "speed_mm_s": 36_112, "passing": good, **nothing}
    refused: tuple[dict[str, int], ...] = (
        {"front_nm": 100_000_001_000},
        {"speed_mm_s": 36_113},
        {"sampling_nm": -3_611_201_000},
        {"skew_nm": -3_611_201_000},
        {"averaging_nm": -781_251_000},
        {"sensor_nm": -5_000_001_000},
        {"sensor_nm": -1_000},
    )
    before = train.system
    for what in refused:
        assert train.step("tail_passes", **{**told, **what}) == before
    assert train.step("head_passes", front_nm=1_000, speed_mm_s=0, passing=CURVE) == before
    assert train.step("head_passes", front_nm=0, speed_mm_s=36_113, passing=CURVE) == before
    assert train.step("change_formation", length_nm=250_000_001_000) == before
    assert train.step("tail_passes", **told).state.measured


def what_is_passed_with_the_range_lost_measures_nothing() -> None:
    """Neither by the head nor by the tail, whatever was claimed last; of that nothing is promised (P7)."""
    train = Train()
    train.step("head_passes", front_nm=9_000_000_000, speed_mm_s=40_000, passing=replace(CURVE, known=False))
    assert (train.system.was_known, train.system.state.head_passed) == (False, False)
    train.tail(train.later(CURVE, 109_000))
    assert not train.system.state.measured
    train = Train()
    train.head(CURVE)
    stale = replace(train.later(CURVE, 43_000), known=False)
    off = dict.fromkeys(("sampling_nm", "skew_nm", "averaging_nm", "sensor_nm"), 0)
    train.step("tail_passes", front_nm=100_000_000_000, speed_mm_s=40_000, passing=stale, **off)
    assert train.system.tail_passed
    assert not train.system.state.measured


WITNESSES = (
    what_is_passed_with_the_range_lost_measures_nothing,
    the_error_at_130_km_h_is_13_m,
    a_train_is_measured_at_a_curve,
    a_train_measured_as_short_as_can_be_is_not_underestimated,
    a_train_is_measured_at_a_tag,
    the_wider_range_and_the_higher_speed_count,
    a_pass_is_off_by_a_cycle_at_the_higher_speed,
    a_measured_length_stays,
    a_train_measured_again_contradicts_nothing,
    vehicles_coupled_untold_are_noticed_at_the_next_point,
    another_length_stays_noted_when_the_first_is_measured_again,
    what_was_untold_before_a_length_is_measured_is_in_it,
    a_first_measurement_differs_from_none,
    a_new_formation_has_no_history,
    cars_set_out_untold_are_noticed_too,
    another_measured_above_the_line_is_kept_the_longer,
    a_jump_of_kilometrage_measures_nothing,
    no_train_is_shorter_than_its_last_vehicle,
    a_front_known_worse_than_is_written_is_no_pass,
    a_pass_of_the_old_formation_does_not_count,
    only_the_heads_point_counts,
    the_head_waits_at_its_last_point,
    a_pass_out_of_range_is_none,
    places_end_at_10_000_km,
    a_range_that_reaches_beyond_9_000_km_is_not_compared,
    more_than_the_line_allows_is_kept_and_shown,
    what_nature_does_not_do_does_not_happen,
)
