"""A train that rolls, slips, slides, climbs and stands, on a wheel that is trusted and on one that is not (P1, P7)."""

from __future__ import annotations

from kernel.onboard import odometry as machine
from kernel.onboard.odometry import Loss, Motion
from models.onboard.units import NM_A_MM
from proofs.onboard.witnesses import odometry_nature, odometry_readings
from proofs.onboard.witnesses.rolling_stock import SITE, Train, rolling

# ---- trust


def the_wheel_is_trusted_after_ten_cycles_that_agree() -> None:
    """Nine are not enough, and a cycle that disagrees begins the count anew (P1)."""
    train = Train()
    train.stand(9)
    assert not train.trusted()
    assert train.motion.agreed_cycles == 9
    train.cycle(0, inertial=400, gradient=350)
    assert train.motion.agreed_cycles == 0
    train.stand(9)
    assert not train.trusted()
    train.stand(1)
    assert train.trusted()
    assert train.motion.agreed_cycles == 10


def an_acceleration_below_the_threshold_agrees() -> None:
    """What may come to T_a, 400 mm/s² in the shortest cycle, is a slip: 385 in the longest, and by either sign (P1).

    One less is none, also with the estimated gradient taken out.
    """
    for sign in (1, -1):
        train = rolling(10_000)
        train.cycle(10_000, inertial=sign * 384, gradient=sign * 350)
        assert train.trusted()
        assert train.motion.gradient_mm_s2 == sign * 5
        train.cycle(10_000, inertial=sign * 389, gradient=sign * 350)
        assert train.trusted()
        train.cycle(10_000, inertial=-sign * 375, gradient=-sign * 350)
        assert not train.trusted()
        train = rolling(10_000)
        train.cycle(10_000, inertial=sign * 385, gradient=sign * 350)
        assert not train.trusted()


def a_constant_wheel_of_another_speed_is_not_trusted() -> None:
    """A locked wheel, or one that spins evenly, agrees in acceleration with a train that coasts: not in speed (P1)."""
    for shown in (0, 26_000):
        train = rolling(20_000)
        for _ in range(20):
            train.cycle(20_000, tachometer=shown, slips=True)
            assert not train.trusted()
            assert train.motion.agreed_cycles == 0
        assert train.motion.anchor_way_mm == train.wheel_nm // NM_A_MM


def the_speed_must_be_one_that_the_train_may_have() -> None:
    """Within the range of speeds by inertia, and the wheel's own error, to the mm/s (P1)."""
    for shown, plausible in ((19_481, False), (19_482, True), (20_529, True), (20_530, False)):
        train = rolling(20_000)
        train.cycle(20_000, tachometer=shown, slips=True)
        train.cycle(20_000, tachometer=shown, slips=True)
        assert (train.motion.speed_least_mm_s, train.motion.speed_most_mm_s) == (19_697, 20_303)
        assert (train.motion.agreed_cycles == 1) == plausible


def a_wheel_rolls_again_after_a_slide() -> None:
    """Locked, then rolling again: after ten cycles it is trusted, and counts from there (P1)."""
    train = rolling(20_000)
    for speed in range(19_900, 19_400, -100):
        train.cycle(speed, tachometer=0, slips=True)
        assert train.system.slips
    train.cycle(19_400)
    assert not train.system.slips
    train.run_on(9)
    assert not train.trusted()
    train.run_on(1)
    assert train.trusted()
    here = train.motion
    assert (here.anchor_least_mm, here.anchor_most_mm) == (here.front_least_mm, here.front_most_mm)
    assert train.system.anchor_nm == train.system.front_nm
    train.run_on(10)
    assert train.motion.anchor_way_mm == here.anchor_way_mm
    assert train.motion.speed_most_mm_s == 19_400 + 194 + 21


# ---- rolling


def the_range_grows_with_the_way_and_not_with_time() -> None:
    """An hour at a standstill adds nothing; a kilometre adds creep and diameter, and a pulse (P1, P7)."""
    train = rolling()
    train.stand(1)
    assert train.width_mm() == 2 * 31
    before = train.motion
    train.stand(100)
    assert train.motion == before
    train = rolling(20_000)
    train.run_on(500)
    assert train.motion.front_least_mm == 1_300_000 - 10_000 - 31 - 0
    assert train.motion.front_most_mm == 1_300_000 + 10_000 + 31
    assert (train.motion.speed_least_mm_s, train.motion.speed_most_mm_s) == (20_000 - 221, 20_000 + 221)
    assert machine.rear_least_mm(train.motion, SITE.length_used_mm) == 1_289_969 - 133_000


def a_wheel_off_by_creep_and_diameter_is_contained() -> None:
    """A wheel that shows a hundredth too much, or too little, rolls all the same (P1)."""
    for shown in (20_200, 19_800):
        train = rolling(20_000)
        at_mm = train.motion.front_least_mm
        for speed in range(0, shown - 20_000, 20 if shown > 20_000 else -20):
            train.cycle(20_000, tachometer=20_000 + speed)
        for _ in range(100):
            train.cycle(20_000, tachometer=shown)
        assert train.trusted()
        assert train.system.front_nm // NM_A_MM == at_mm + 220_000
        assert train.motion.front_least_mm < at_mm + 220_000 < train.motion.front_most_mm


def the_most_speed_is_never_less_than_nothing() -> None:
    """Neither of a rolling wheel nor of one that is not trusted; the least may be, as a train may roll back (P1)."""
    train = rolling()
    train.cycle(20)
    assert (train.motion.speed_least_mm_s, train.motion.speed_most_mm_s) == (-1, 41)
    train.cycle(-80)
    assert (train.motion.speed_least_mm_s, train.motion.speed_most_mm_s) == (-101, 0)
    train = rolling(1_000)
    for speed in (820, 640, 460, 280, 100, 0, 0, 0):
        train.cycle(speed, tachometer=0, slips=True)
    assert (train.motion.speed_least_mm_s, train.motion.speed_most_mm_s) == (-176, 370)
    train = rolling()
    for speed in range(-45, -900, -45):
        train.cycle(speed)
    train.cycle(-900, gradient=-350, tachometer_valid=False)
    assert train.motion.speed_most_mm_s == 0


def a_train_that_rolls_back_is_in_its_range() -> None:
    """On a wheel that is trusted, to the millimetre; and by inertia, where the wheel is silent (P1, T5)."""
    train = rolling()
    at_mm = train.motion.front_least_mm
    for speed in (-50, -100, -150, -150, -100, -50, 0):
        train.cycle(speed)
        assert train.trusted()
    assert train.system.front_nm == (at_mm - 60) * NM_A_MM
    assert (train.motion.front_least_mm, train.motion.front_most_mm) == (at_mm - 91, at_mm - 29)
    train = rolling()
    for speed in (-50, -100, -150):
        train.cycle(speed, tachometer_valid=False)
    assert (train.motion.speed_least_mm_s, train.motion.speed_most_mm_s) == (-686, 383)


def the_brakes_of_a_train_that_rolls_back_act_forward() -> None:
    """They are stronger than the motors, and no inertial sensor says otherwise (P1, T5)."""
    for inertial_valid in (True, False):
        train = rolling()
        for speed in range(-100, -1_600, -100):
            train.cycle(speed)
        train.cycle(-1_320, tachometer_valid=False, inertial_valid=inertial_valid)
        assert (train.motion.speed_least_mm_s, train.motion.speed_most_mm_s) == (-1_720, 184)
    train = rolling(1_000)
    train.cycle(1_000, tachometer_valid=False, inertial_valid=False)
    assert train.motion.speed_most_mm_s == 1_000 + 31 + 123
    train = rolling()
    train.stand(1)
    train.cycle(0, tachometer_valid=False, inertial_valid=False)
    assert train.motion.speed_most_mm_s == 21 + 184
    train = Train()
    train.cycle(0, tachometer_valid=False, inertial_valid=False)
    assert train.motion.speed_most_mm_s == 123


def a_wheel_is_not_trusted_again_where_the_speed_is_hardly_known() -> None:
    """After so long a silence that nearly any speed would fit, a wheel that agrees says little (P1)."""
    for silent_cycles, trusted in ((41, True), (42, False)):
        train = rolling(20_000)
        for _ in range(silent_cycles):
            train.cycle(20_000, tachometer_valid=False)
        train.run_on(11)
        assert train.trusted() == trusted


def a_wheel_that_stands_is_not_trusted_again_where_the_train_may_run() -> None:
    """It may be locked: after so long a silence the train is located anew, though it stands (P1)."""
    for silent_cycles, trusted in ((50, True), (51, False)):
        train = rolling(100)
        train.cycle(0)
        for _ in range(silent_cycles):
            train.cycle(0, tachometer_valid=False)
        train.stand(10)
        assert train.trusted() == trusted


# ---- gradient


def the_gradient_is_followed_slowly_and_within_the_line() -> None:
    """5 mm/s² in a cycle, up to what is seen, and never beyond the line's steepest, up or down (P1)."""
    for sign in (1, -1):
        train = rolling(20_000)
        for cycle in range(1, 41):
            train.cycle(20_000, gradient=sign * 200)
            assert train.motion.gradient_mm_s2 == sign * 5 * cycle
        train.cycle(20_000, gradient=sign * 200)
        assert train.motion.gradient_mm_s2 == sign * 200
        train.cycle(20_000, gradient=sign * 198)
        assert train.motion.gradient_mm_s2 == sign * 198
        for _ in range(40):
            train.cycle(20_000, gradient=sign * 350, inertial=sign * 400)
        assert train.motion.gradient_mm_s2 == sign * 350


def the_gradient_is_not_what_the_train_accelerates_by() -> None:
    """On the level the estimate stays zero while the train gains and loses speed (P1)."""
    train = rolling(5_000)
    train.run_to(10_000)
    train.run_to(4_000)
    assert train.motion.gradient_mm_s2 == 0


def the_gradient_is_frozen_in_a_slip() -> None:
    """What the sensors show while the wheel is not trusted teaches nothing (P1)."""
    train = rolling(20_000)
    for _ in range(20):
        train.cycle(20_000, gradient=100)
    assert train.motion.gradient_mm_s2 == 100
    train.cycle(20_000, tachometer=0, gradient=100, slips=True)
    for _ in range(9):
        train.cycle(20_000, gradient=-50)
        assert train.motion.gradient_mm_s2 == 100


# ---- slipping


def a_slip_goes_on_by_inertia_from_the_cycle_before() -> None:
    """The cycle in which the wheel runs away is not counted by it: its way is dropped, its anchor goes along (P1)."""
    train = rolling(20_000)
    train.cycle(20_000, tachometer=25_000, slips=True)
    assert train.motion == Motion(
        front_least_mm=301_934,
        front_most_mm=302_067,
        speed_least_mm_s=19_779 - 41,
        speed_most_mm_s=20_221 + 41,
        anchor_least_mm=301_934,
        anchor_most_mm=302_067,
        anchor_way_mm=207_500,
        tachometer_mm_s=25_000,
        way_mm=207_500,
        trusted=False,
        agreed_cycles=0,
        gradient_mm_s2=0,
        loss=Loss.NONE,
    )
    assert train.system.slips
    train.cycle(20_000, tachometer=30_000, slips=True)
    assert (train.motion.front_least_mm, train.motion.front_most_mm) == (303_864, 304_138)
    assert train.system.anchor_nm == 304_000 * NM_A_MM


def motors_and_brakes_limit_what_inertia_leaves_open() -> None:
    """At full brake or power, and without an inertial sensor, the train does no more than it can (P1)."""
    train = rolling(20_000)
    train.cycle(19_820, tachometer=0, slips=True)
    assert train.motion.speed_least_mm_s == 19_779 - 184
    assert train.motion.speed_most_mm_s == 20_221 - 137
    train = rolling(20_000)
    train.cycle(20_120, tachometer=0, slips=True)
    assert train.motion.speed_least_mm_s == 19_779 + 78
    assert train.motion.speed_most_mm_s == 20_221 + 123
    for wild in (0, 100_000, -100_000, 2**62):
        train = rolling(20_000)
        train.cycle(20_000, inertial=wild, inertial_valid=False)
        assert (train.motion.speed_least_mm_s, train.motion.speed_most_mm_s) == (19_779 - 184, 20_221 + 123)
        assert not train.trusted()
    for wild in (100_001, -100_001, 2**62, -(2**62)):
        train = rolling(20_000)
        train.cycle(20_000, inertial=wild)
        assert (train.motion.speed_least_mm_s, train.motion.speed_most_mm_s) == (19_779 - 184, 20_221 + 123)


def the_way_is_between_the_speeds_at_both_ends() -> None:
    """Gaining: no less than at the speed before, no more than at the one after; losing: the other way (P1)."""
    train = rolling(20_000)
    train.cycle(20_120, tachometer=0, slips=True)
    assert train.motion.front_least_mm == 300_000 + 1_938
    assert train.motion.front_most_mm == 300_000 + 2_076
    train = rolling(20_000)
    train.cycle(19_820, tachometer=0, slips=True)
    assert train.motion.front_least_mm == 300_000 + 1_920
    assert train.motion.front_most_mm == 300_000 + 2_063


def a_train_that_stops_in_a_slide_stands_in_the_range() -> None:
    """Where brakes and descent leave nothing it goes no farther; it may have begun to roll back (P1)."""
    train = rolling(300)
    train.cycle(120, tachometer=0, inertial=-2_200, gradient=-350, slips=True)
    train.cycle(0, tachometer=0, inertial=-1_600, gradient=-350)
    for _ in range(5):
        train.cycle(0, inertial=-400, gradient=-350)
    assert (train.motion.speed_least_mm_s, train.motion.speed_most_mm_s) == (-502, 31)
    assert train.motion.front_least_mm < 100_021 < train.motion.front_most_mm


WITNESSES = (
    the_wheel_is_trusted_after_ten_cycles_that_agree,
    an_acceleration_below_the_threshold_agrees,
    a_constant_wheel_of_another_speed_is_not_trusted,
    the_speed_must_be_one_that_the_train_may_have,
    a_wheel_rolls_again_after_a_slide,
    the_range_grows_with_the_way_and_not_with_time,
    a_wheel_off_by_creep_and_diameter_is_contained,
    the_most_speed_is_never_less_than_nothing,
    a_train_that_rolls_back_is_in_its_range,
    the_brakes_of_a_train_that_rolls_back_act_forward,
    a_wheel_is_not_trusted_again_where_the_speed_is_hardly_known,
    a_wheel_that_stands_is_not_trusted_again_where_the_train_may_run,
    the_gradient_is_followed_slowly_and_within_the_line,
    the_gradient_is_not_what_the_train_accelerates_by,
    the_gradient_is_frozen_in_a_slip,
    a_slip_goes_on_by_inertia_from_the_cycle_before,
    motors_and_brakes_limit_what_inertia_leaves_open,
    the_way_is_between_the_speeds_at_both_ends,
    a_train_that_stops_in_a_slide_stands_in_the_range,
    *odometry_readings.WITNESSES,
    *odometry_nature.WITNESSES,
)
