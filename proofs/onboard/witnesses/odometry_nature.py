"""What the odometry's world leaves to nature: sensors that lie where nothing is promised of them (P1, P7).

Each is a motion, or a reading, that a kinder world would refuse.
"""

from __future__ import annotations

from dataclasses import replace

from models.onboard.odometry import Line
from proofs.onboard.witnesses.rolling_stock import AT_POWER_ON, BOUNDS, SITE, Train, rolling

STRONG_MOTORS = replace(SITE, bounds=replace(BOUNDS, accelerates_mm_s2=1_900))


class OnLine(Train):
    """The same train on another line."""

    def __init__(self, site: Line) -> None:
        """Begin."""
        super().__init__(AT_POWER_ON)
        self.site = site


def back_to(speed_mm_s: int) -> Train:
    """A train that rolls back at so much, on a wheel that is trusted."""
    train = rolling()
    train.run_to(speed_mm_s)
    assert train.trusted()
    return train


# ---- motors and sensors


def motors_may_be_stronger_than_brakes() -> None:
    """A train that rolls back may gain by either, whichever is the stronger (P1)."""
    train = OnLine(STRONG_MOTORS)
    train.run_to(-500)
    train.cycle(-500 + 190)
    assert train.motion.speed_most_mm_s >= -310


def an_invalid_inertial_reading_may_be_anything() -> None:
    """It may also be one that the train could have (P1)."""
    train = rolling(20_000)
    train.cycle(20_000, inertial=1_000, inertial_valid=False)
    assert not train.trusted()


def a_wheel_that_turns_back_errs_as_one_that_turns_forward() -> None:
    """Creep and diameter put speed and way off by a share of them, whichever way it turns (P1)."""
    train = back_to(-900)
    train.cycle(-900, tachometer=-872, way_mm=train.wheel_nm // 1_000_000 - 90)
    assert train.trusted()
    train = back_to(-1_000)
    for _ in range(30):
        train.cycle(-1_000)
    way_mm = train.wheel_nm // 1_000_000
    train.cycle(-1_000, way_mm=way_mm - 100 + 55)
    assert train.trusted()


def a_tachometer_may_stick_whichever_way_its_wheel_turns() -> None:
    """It repeats speed and pulses of a train that rolls back, too, and is not read (P1)."""
    train = back_to(-900)
    train.cycle(-910, tachometer=train.motion.tachometer_mm_s, way_mm=train.motion.way_mm, sticks=True)
    assert not train.trusted()


def a_gross_speed_is_no_reading_either_way() -> None:
    """A wheel that rolls may be told to turn back at more than any train can run (P1)."""
    for shown in (200_001, -200_001):
        train = rolling(20_000)
        train.cycle(20_000, tachometer=shown, way_mm=train.motion.way_mm + 2_000)
        assert not train.trusted()


# ---- where counting begins


def what_is_not_read_counts_from_nowhere() -> None:
    """Pulses that are invalid may be any number, and the way since them is not measured (P1)."""
    train = rolling(20_000)
    train.cycle(20_000, tachometer_valid=False, way_mm=train.motion.way_mm + 9_000)
    assert not train.system.counted
    train.cycle(20_000)
    assert train.system.counted


def what_is_counted_over_a_slip_is_off_until_counting_begins_anew() -> None:
    """The pulses of the cycle in which the wheel takes hold again may be off by what it ran away (P1)."""
    train = Train()
    train.cycle(0, tachometer=2_000, way_mm=9_000, slips=True)
    assert not train.system.counted
    train.cycle(0, way_mm=5_000)
    assert train.system.counted


def counting_begins_anew_where_the_train_is_located() -> None:
    """The pulses that it is located with may be another number than the last that was read (T8)."""
    train = rolling(1_000)
    train.run_to(0)
    before = train.motion
    train.step("locate_anew", least_mm=before.front_least_mm, most_mm=before.front_most_mm, way_mm=before.way_mm)
    train.stand(12)
    assert train.trusted()


def a_contradiction_is_remembered_until_the_train_is_located_anew() -> None:
    """A fix that would fit the range again does not take it back (P7)."""
    train = rolling(0)
    front_mm = train.motion.front_least_mm
    train.fix(front_mm + 5_000, front_mm + 6_000)
    train.fix(front_mm, front_mm)
    assert train.system.contradicted


def what_ran_away_once_is_counted_no_more() -> None:
    """Not since an anchor that lies before the slip, as that of a train whose range is lost (P7)."""
    train = rolling(1_000)
    train.fix(0, 0)
    train.cycle(1_000, tachometer=3_000, slips=True)
    train.run_on(3)
    assert not train.system.counted


# ---- where a slip may begin, and how long it may last unseen


def a_slip_may_begin_unheard() -> None:
    """What shows before it was not read: then no jolt need show, though one reading is like the other (P1)."""
    train = rolling(20_000)
    train.cycle(20_000, tachometer=19_000, tachometer_valid=False)
    train.cycle(20_000, tachometer=19_000, slips=True)
    assert train.system.slips
    assert not train.trusted()


def the_first_reading_after_a_silence_shows_no_pace() -> None:
    """It has none before it to compare with: so a slip goes on for one cycle more (P1)."""
    train = rolling(20_000)
    train.cycle(20_000, tachometer_valid=False)
    for _ in range(SITE.pace_cycles):
        train.cycle(20_000, slips=True)
        assert not train.trusted()
    assert train.system.paced_cycles == SITE.pace_cycles - 1


def a_locked_wheel_may_stand_for_long() -> None:
    """Under a train that runs, or rolls back, slowly enough to be within what counts as the same pace (P1)."""
    for speed_mm_s in (4_000, -4_000):
        train = back_to(speed_mm_s)
        for _ in range(2 * SITE.pace_cycles):
            train.cycle(speed_mm_s, tachometer=0, slips=True)
        assert train.system.paced_cycles == 0
        assert not train.trusted()


def a_slow_wheel_keeps_no_pace_with_a_fast_train() -> None:
    """One that is held by the brake turns evenly for as long as it likes, far slower than its train (P1)."""
    train = rolling(20_000)
    for _ in range(2 * SITE.pace_cycles):
        train.cycle(20_000, tachometer=5_000, slips=True)
    assert train.system.paced_cycles == 0
    assert not train.trusted()


WITNESSES = (
    motors_may_be_stronger_than_brakes,
    an_invalid_inertial_reading_may_be_anything,
    a_wheel_that_turns_back_errs_as_one_that_turns_forward,
    a_tachometer_may_stick_whichever_way_its_wheel_turns,
    a_gross_speed_is_no_reading_either_way,
    what_is_not_read_counts_from_nowhere,
    what_is_counted_over_a_slip_is_off_until_counting_begins_anew,
    counting_begins_anew_where_the_train_is_located,
    a_contradiction_is_remembered_until_the_train_is_located_anew,
    what_ran_away_once_is_counted_no_more,
    a_slip_may_begin_unheard,
    the_first_reading_after_a_silence_shows_no_pace,
    a_locked_wheel_may_stand_for_long,
    a_slow_wheel_keeps_no_pace_with_a_fast_train,
)
