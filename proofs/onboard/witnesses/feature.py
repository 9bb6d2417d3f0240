"""A train runs over a curve of 500 m radius and 100 m length, or over what is not quite that (P2, P3)."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from kernel.onboard import feature as machine
from kernel.onboard.feature import Band, Detection, Feature, Progress, Readings, TurnAxis
from kernel.onboard.odometry import SensorBounds
from models.onboard.feature import NO_RUNS, NONE_MM, Looking, Order, Registered, all_stages_match
from proofs.onboard.feature import THEORY
from proofs.onboard.witnesses.play import Play

BOUNDS = SensorBounds(
    scale_ppm=10_000,
    pulse_mm=50,
    tachometer_mm_s=100,
    inertial_mm_s2=100,
    gradient_mm_s2=350,
    gradient_rate_mm_s2=10,
    slip_mm_s2=500,
    accelerates_mm_s2=1_500,
    brakes_mm_s2=2_000,
    agreement_cycles=10,
    pace_mm_s=5_000,
    locked_mm_s=2_500,
)
CURVE = Feature(
    axis=TurnAxis.YAW,
    begin_mm=100_000,
    end_mm=250_000,
    end_error_mm=5_000,
    straight=Band(-200, 200),
    first=Band(201, 2_500),
    second=Band(1_500, 2_500),
    third=Band(201, 2_400),
    second_from_mm=30_000,
    third_from_mm=70_000,
    entry_least_mm=20_000,
    exit_least_mm=20_000,
    exit_most_mm=22_000,
    length_least_mm=96_000,
    length_most_mm=104_000,
    speed_least_mm_s=5_000,
)
SITE = Registered(BOUNDS, CURVE)
STRAIGHT, EASED, BENT = 0, 1_000, 2_000
SPEED_MM_S = 20_000
A_CYCLE_MM = 2_000


class Train(Play[Registered, Looking]):
    """A train at 20 m/s, its front where the wheel says and 2 m on; at first at the begin of detection."""

    def __init__(self, site: Registered = SITE, at_mm: int = 100_000) -> None:
        """Begin a cycle before ``at_mm``."""
        self.way_mm = at_mm - A_CYCLE_MM
        system = Looking(0, machine.AWAITED, NO_RUNS, Order(0, 0, 0, 0, 0), 0, 0)
        super().__init__(THEORY, site, system)

    def readings(self, curvature: int) -> Readings:
        """What the sensors say at this place."""
        return Readings(
            front_least_mm=self.way_mm,
            rolling=True,
            speed_mm_s=SPEED_MM_S,
            way_mm=self.way_mm,
            yaw_valid=True,
            yaw_urad_s=curvature * SPEED_MM_S // 1_000,
            pitch_valid=False,
            pitch_urad_s=0,
        )

    def cycle(self, curvature: int, way_mm: int = A_CYCLE_MM, **told: int | bool) -> None:
        """A cycle; ``told``: readings that are not what they should be."""
        self.way_mm += way_mm
        readings = replace(self.readings(curvature), **told)  # type: ignore[arg-type]
        before = self.system.cycle
        self.step("run_a_cycle", front_um=(self.way_mm + 2_000) * 1_000, readings=readings)
        assert self.system.cycle == before + 1

    def run(self, curvature: int, way_mm: int) -> None:
        """Cycles over some way."""
        for _ in range(way_mm // A_CYCLE_MM):
            self.cycle(curvature)

    def to_the_end(self) -> None:
        """Entry straight and the curve, eased at both its ends, up to 250 m."""
        self.run(STRAIGHT, 50_000)
        self.run(EASED, 20_000)
        self.run(BENT, 60_000)
        self.run(EASED, 20_000)

    def exit_straight(self) -> None:
        """The exit straight, up to the cycle that decides."""
        self.run(STRAIGHT, 22_000)

    def stage(self) -> Progress:
        """How far the machine has come."""
        return self.system.state.stage


def passes(train: Train) -> bool:
    """Tell whether the train gets its fix from the exit straight; history must say the same."""
    train.exit_straight()
    fixed = machine.has_fix(train.system.state)
    assert fixed == all_stages_match(train.site, train.system.runs)
    return fixed


def a_feature_gives_a_fix() -> None:
    """After the exit straight, for one cycle; the range is the curve's end, the way since, and both errors (P3)."""
    train = Train()
    train.cycle(STRAIGHT)
    assert train.stage() == Progress.ENTRY_STRAIGHT
    train.run(STRAIGHT, 48_000)
    train.cycle(EASED)
    assert train.stage() == Progress.FIRST_PART
    train.run(EASED, 18_000)
    train.run(BENT, 60_000)
    assert train.stage() == Progress.THIRD_PART
    train.run(EASED, 20_000)
    train.cycle(STRAIGHT)
    assert train.stage() == Progress.EXIT_STRAIGHT
    assert train.system.state.from_mm == 250_000
    train.run(STRAIGHT, 18_000)
    assert not machine.has_fix(train.system.state)
    train.cycle(STRAIGHT)
    assert machine.has_fix(train.system.state)
    assert not machine.is_over(train.system.state)
    error_mm = 5_000 + 220 + 1 + 50
    assert train.system.state.fix_least_mm == 250_000 + 20_000 - error_mm
    assert train.system.state.fix_most_mm == 250_000 + 20_000 + error_mm
    train.cycle(STRAIGHT)
    assert not machine.has_fix(train.system.state)
    assert machine.is_over(train.system.state)
    assert train.stage() == Progress.PASSED
    train.to_the_end()
    assert train.stage() == Progress.PASSED
    assert train.system.fixes == 1
    train.step("await_feature")
    assert train.system.fixes == 0


def the_next_curve_is_not_taken_for_one_that_was_passed() -> None:
    """Detection does not begin beyond the curve; at its very end it still would (P3)."""
    train = Train(at_mm=250_000)
    train.cycle(STRAIGHT, speed_mm_s=4_000)
    assert train.stage() == Progress.WAITING
    train.cycle(STRAIGHT)
    assert train.stage() == Progress.FAILED
    at_the_end = Train(at_mm=250_000)
    at_the_end.cycle(STRAIGHT)
    assert at_the_end.stage() == Progress.ENTRY_STRAIGHT


def a_curve_that_ends_beyond_the_place_is_another() -> None:
    """The front is certainly beyond the registered end and its error by then; up to there it is the curve (P3, P7)."""
    for late_mm, stage in ((4_000, Progress.EXIT_STRAIGHT), (6_000, Progress.FAILED)):
        train = Train(at_mm=100_000 + late_mm)
        train.to_the_end()
        train.cycle(STRAIGHT)
        assert train.system.state.stage == stage
    beyond = Train(at_mm=106_000)
    beyond.to_the_end()
    beyond.exit_straight()
    assert beyond.stage() == Progress.FAILED
    assert all_stages_match(beyond.site, beyond.system.runs)


def a_change_of_gradient_gives_a_fix() -> None:
    """By the pitch rate; the yaw rate is not asked for (P2, P3)."""
    train = Train(Registered(BOUNDS, replace(CURVE, axis=TurnAxis.PITCH)))
    for curvature, way_mm in ((STRAIGHT, 50_000), (BENT, 100_000), (STRAIGHT, 22_000)):
        for _ in range(way_mm // A_CYCLE_MM):
            train.cycle(curvature, pitch_valid=True, pitch_urad_s=curvature * 20, yaw_valid=False, yaw_urad_s=77)
    assert machine.has_fix(train.system.state)


def of_a_feature_awaited_nothing_is_known() -> None:
    """No way was noted, and there is no range of a fix (P3)."""
    awaited = Detection(stage=Progress.WAITING, from_mm=0, way_mm=0, fix_least_mm=0, fix_most_mm=0)
    assert awaited == machine.AWAITED
    train = Train()
    train.run(STRAIGHT, 10_000)
    assert train.step("await_feature").state == awaited


def nothing_begins_before_its_begin() -> None:
    """What looks like it before the begin of detection, by the range's least end, is not looked at (P3)."""
    train = Train(at_mm=20_000)
    train.run(BENT, 70_000)
    train.run(STRAIGHT, 10_000)
    assert train.stage() == Progress.WAITING
    train.to_the_end()
    assert passes(train)


def a_failed_detection_stays_failed() -> None:
    """It is over, until the next feature is awaited; then the whole must come anew (P3)."""
    train = Train()
    train.cycle(BENT)
    assert train.stage() == Progress.FAILED
    assert machine.is_over(train.system.state)
    train.to_the_end()
    train.exit_straight()
    assert not machine.has_fix(train.system.state)
    train = Train()
    train.cycle(BENT)
    train.step("await_feature")
    assert train.stage() == Progress.WAITING
    assert not machine.is_over(train.system.state)
    train.to_the_end()
    assert passes(train)


def a_short_straight_fails() -> None:
    """20 m of entry straight are asked for, and of exit straight (P3)."""
    for entry_mm, enough in ((20_000, True), (18_000, False)):
        train = Train(at_mm=150_000 - entry_mm)
        train.run(STRAIGHT, entry_mm)
        train.run(BENT, 100_000)
        assert (train.stage() == Progress.THIRD_PART) == enough
        assert passes(train) == enough
    train = Train()
    train.to_the_end()
    train.run(STRAIGHT, 20_000)
    train.cycle(EASED)
    assert train.stage() == Progress.FAILED


def a_curve_of_another_length_fails() -> None:
    """96 to 104 m; and none that ends before its third part, however short it may be (P3)."""
    for way_mm, right in ((94_000, False), (96_000, True), (104_000, True), (106_000, False)):
        train = Train()
        train.run(STRAIGHT, 150_000 - way_mm)
        train.run(BENT, way_mm)
        assert passes(train) == right
    for way_mm, right in ((70_000, False), (72_000, True)):
        train = Train(Registered(BOUNDS, replace(CURVE, length_least_mm=0)))
        train.run(STRAIGHT, 150_000 - way_mm)
        train.run(BENT, way_mm)
        assert passes(train) == right


def at_the_edges_of_its_bands_it_matches_and_beyond_not() -> None:
    """Once beyond is enough to fail, in each part, on each side; what is straight in the curve ends it (P3)."""
    edges = (
        (0, 201, True),
        (0, 2_500, True),
        (0, 2_501, False),
        (0, -2_000, False),
        (30_000, 1_500, True),
        (30_000, 1_499, False),
        (30_000, 2_500, True),
        (30_000, 2_501, False),
        (68_000, 1_499, False),
        (70_000, 201, True),
        (70_000, 2_400, True),
        (70_000, 2_401, False),
        (50_000, 0, False),
        (-2_000, 200, True),
        (-2_000, -200, True),
        (-2_000, -201, False),
        (100_000, 200, True),
        (100_000, -201, False),
    )
    for since_mm, curvature, right in edges:
        train = Train()
        for way_mm in range(-50_000, 122_000, A_CYCLE_MM):
            train.cycle(curvature if way_mm == since_mm else BENT if 0 <= way_mm < 100_000 else STRAIGHT)
        assert machine.has_fix(train.system.state) == right, (since_mm, curvature)
        assert all_stages_match(train.site, train.system.runs) == right


def a_part_left_out_fails() -> None:
    """A jump of the way from the first part to the third leaves a check point out (P3)."""
    train = Train()
    train.run(STRAIGHT, 50_000)
    train.run(BENT, 30_000)
    train.cycle(BENT, 44_000)
    assert train.stage() == Progress.FAILED
    train.run(BENT, 26_000)
    assert not passes(train)


def parts_met(train: Train) -> tuple[bool, bool]:
    """Whether the last curve met its second part, and its third."""
    return train.system.runs.met_second, train.system.runs.met_third


def history_is_kept_of_the_newest_runs_alone() -> None:
    """A curve first of all has no straight before it; a later one has its own parts, and is no exit straight (P3)."""
    train = Train()
    train.cycle(BENT)
    assert (train.system.runs.before_mm, train.system.runs.first_mm) == (NONE_MM, NONE_MM)
    train.run(BENT, 98_000)
    assert parts_met(train) == (True, True)
    train.run(STRAIGHT, 100_000)
    train.cycle(BENT)
    assert (train.system.runs.before_mm, train.system.runs.first_mm) == (100_000, 100_000)
    assert parts_met(train) == (False, False)
    train.run(BENT, 78_000)
    assert parts_met(train) == (True, True)
    assert not all_stages_match(train.site, train.system.runs)


def history_begins_anew_where_the_wheel_turns_back() -> None:
    """What came before is no run before this one, and no curve that was in band (P3)."""
    train = Train()
    train.run(STRAIGHT, 50_000)
    train.run(BENT, 100_000)
    curve = train.system.runs
    assert (curve.in_band, curve.before_mm) == (True, 50_000)
    train.cycle(STRAIGHT, -1)
    begun = train.system.runs
    assert (begun.in_band, begun.before_mm, begun.first_mm) == (False, NONE_MM, NONE_MM)


def the_first_part_is_met_first() -> None:
    """Wherever the third is registered to begin, it does not begin before the second (P3)."""
    train = Train(Registered(BOUNDS, replace(CURVE, third_from_mm=0)))
    train.run(STRAIGHT, 50_000)
    train.run(BENT, 30_000)
    assert train.stage() == Progress.FIRST_PART
    assert parts_met(train) == (False, False)
    train.cycle(BENT)
    assert parts_met(train) == (False, True)


def a_way_that_jumps_on_the_exit_straight_fails() -> None:
    """Beyond the straight's greatest length the wheel's error is not known (P3)."""
    for jump_mm, right in ((22_000, True), (23_000, False)):
        train = Train()
        train.to_the_end()
        train.cycle(STRAIGHT)
        train.cycle(STRAIGHT, jump_mm)
        assert machine.has_fix(train.system.state) == right


def a_wheel_that_turns_back_fails() -> None:
    """A millimetre less than in the cycle before ends the detection, on either straight and in the curve (P3)."""
    for way_mm in (30_000, 90_000, 160_000):
        train = Train()
        for since_mm in range(0, way_mm, A_CYCLE_MM):
            bent = BENT if 70_000 <= since_mm < 130_000 else EASED
            train.cycle(bent if 50_000 <= since_mm < 150_000 else STRAIGHT)
        assert not machine.is_over(train.system.state)
        train.cycle(STRAIGHT if way_mm != 90_000 else BENT, way_mm=-1)
        assert train.stage() == Progress.FAILED


def an_unusable_cycle_fails_in_every_stage() -> None:
    """Slipping, too slow, without a reading, back before the begin: no fix (P2, P3)."""
    unusable: tuple[dict[str, int | bool], ...] = (
        {"rolling": False},
        {"yaw_valid": False},
        {"front_least_mm": 99_999},
        {"speed_mm_s": 4_999, "yaw_urad_s": 0},
        {"speed_mm_s": 200_001, "yaw_urad_s": 0},
    )
    for told in unusable:
        for at in (3, 26, 40, 70, 80):
            train = Train()
            for number in range(86):
                curvature = BENT if 25 <= number < 75 else STRAIGHT
                train.cycle(curvature, **(told if number == at else {}))
                assert (train.system.runs == NO_RUNS) == (number == at)
            assert train.stage() == Progress.FAILED


def an_unusable_cycle_before_the_straight_does_no_harm() -> None:
    """A train that stands or slips at the begin may still see enough of the straight (P3)."""
    train = Train()
    train.cycle(STRAIGHT, rolling=False)
    assert train.stage() == Progress.WAITING
    train.run(STRAIGHT, 48_000)
    train.run(BENT, 100_000)
    assert passes(train)


def at_the_least_speed_it_still_matches() -> None:
    """5 m/s is enough, and the range of speeds ends at 200 m/s (P2)."""
    for speed_mm_s in (5_000, 200_000):
        train = Train()
        for curvature, way_mm in ((STRAIGHT, 50_000), (BENT, 100_000), (STRAIGHT, 22_000)):
            for _ in range(way_mm // A_CYCLE_MM):
                train.cycle(curvature, speed_mm_s=speed_mm_s, yaw_urad_s=curvature * speed_mm_s // 1_000)
        assert machine.has_fix(train.system.state)


def a_reading_out_of_range_is_none() -> None:
    """A rate or a way that no sensor gives fails, even where bands are wide enough (P2)."""
    wide = Band(-100_000_000, 100_000_000)
    site = Registered(BOUNDS, replace(CURVE, straight=wide))
    wild: tuple[dict[str, Any], ...] = (
        {"yaw_urad_s": 1_000_000_001},
        {"yaw_urad_s": -1_000_000_001},
        {"way_mm": 1_000_000_000_001},
    )
    for told in wild:
        train = Train(site)
        train.cycle(STRAIGHT)
        train.cycle(STRAIGHT, yaw_urad_s=1_000_000_000)
        train.cycle(STRAIGHT, yaw_urad_s=-1_000_000_000)
        assert train.stage() == Progress.ENTRY_STRAIGHT
        train.step("run_a_cycle", front_um=0, readings=replace(train.readings(STRAIGHT), **told))
        assert train.stage() == Progress.FAILED
        assert train.system.runs == NO_RUNS
    train = Train(site)
    below = replace(train.readings(STRAIGHT), front_least_mm=100_000, way_mm=-1)
    train.step("run_a_cycle", front_um=0, readings=below)
    assert train.stage() == Progress.WAITING
    assert train.system.cycle == 1
    assert train.system.runs == NO_RUNS
    assert not machine.is_usable(CURVE, below)
    for way_mm in (0, 1_000_000_000_000):
        train = Train(site)
        edge = replace(train.readings(STRAIGHT), front_least_mm=100_000, way_mm=way_mm)
        train.step("run_a_cycle", front_um=0, readings=edge)
        assert train.stage() == Progress.ENTRY_STRAIGHT
        assert machine.is_usable(CURVE, edge)


def what_nature_does_not_do_does_not_happen() -> None:
    """Another curve that matches, a rolling wheel that miscounts: such events are refused."""
    train = Train()
    train.to_the_end()
    train.run(STRAIGHT, 20_000)
    train.way_mm += A_CYCLE_MM
    before = train.system
    good = train.readings(STRAIGHT)
    for off_um in (-270_001, 270_001):
        assert train.step("run_a_cycle", front_um=272_000_000 + off_um, readings=good) == before
    assert train.step("run_a_cycle", front_um=272_000_000 + 270_000, readings=good) != before
    for shift_mm, refused in ((3_000, False), (3_001, True), (-7_000, False), (-7_001, True)):
        train = Train()
        train.to_the_end()
        for since_mm in range(0, 22_000, A_CYCLE_MM):
            train.way_mm += A_CYCLE_MM
            before = train.system
            front_um = (252_000 + since_mm + shift_mm) * 1_000
            train.step("run_a_cycle", front_um=front_um, readings=train.readings(STRAIGHT))
        assert (train.system == before) == refused


def nature_may_do_all_else() -> None:
    """A wheel errs more over a longer way; where it does not roll, or is not yet looked at, its way goes back (P1)."""
    train = Train()
    train.run(STRAIGHT, 26_000)
    train.way_mm += A_CYCLE_MM
    before = train.system
    told = train.readings(STRAIGHT)
    assert train.step("run_a_cycle", front_um=(train.way_mm + 3_000) * 1_000, readings=told) != before
    train.cycle(STRAIGHT, -2 * A_CYCLE_MM, rolling=False, front_least_mm=100_000)
    assert train.stage() == Progress.FAILED
    train = Train(at_mm=20_000)
    train.cycle(STRAIGHT)
    train.cycle(STRAIGHT, -A_CYCLE_MM)
    assert train.stage() == Progress.WAITING


WITNESSES = (
    the_next_curve_is_not_taken_for_one_that_was_passed,
    a_curve_that_ends_beyond_the_place_is_another,
    a_feature_gives_a_fix,
    a_change_of_gradient_gives_a_fix,
    of_a_feature_awaited_nothing_is_known,
    nothing_begins_before_its_begin,
    a_failed_detection_stays_failed,
    a_short_straight_fails,
    a_curve_of_another_length_fails,
    at_the_edges_of_its_bands_it_matches_and_beyond_not,
    a_part_left_out_fails,
    history_is_kept_of_the_newest_runs_alone,
    history_begins_anew_where_the_wheel_turns_back,
    the_first_part_is_met_first,
    a_way_that_jumps_on_the_exit_straight_fails,
    a_wheel_that_turns_back_fails,
    an_unusable_cycle_fails_in_every_stage,
    an_unusable_cycle_before_the_straight_does_no_harm,
    at_the_least_speed_it_still_matches,
    a_reading_out_of_range_is_none,
    what_nature_does_not_do_does_not_happen,
    nature_may_do_all_else,
)
