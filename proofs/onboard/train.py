"""What is claimed of a train from its sensors to its brake: it stops before its end, and knows where it is (P7, T12).

Each claim of odometry, brake control and brake watch is claimed again of the one train that all three see.
"""

from __future__ import annotations

from kernel.onboard.odometry import Loss
from models.onboard.train import (
    await_none,
    await_tag,
    find_whole,
    locate_anew,
    put_into_service,
    read_a_tag,
    run_a_cycle,
    sense_the_cycle,
    take_end,
    withhold_end,
)
from models.onboard.train_nature import (
    Train,
    Whole,
    approach,
    before,
    braked,
    line,
    running,
    the_brakes_bounds_fit,
    the_odometrys_bounds_fit,
    the_tags_bounds_fit,
    watched,
    watched_over,
)
from models.onboard.units import NM_A_MM, UM_A_MM
from proofs.onboard import brake_watch, braking, odometry
from proofs.theory import Theory, by_name

# ---- the start


def the_train_stands_held_by_its_brake(site: Train, system: Whole) -> bool:
    """At the start the train is located at rest, and its brake has been on for as long as it takes to respond (T8)."""
    return (
        not system.runs
        and there_is_one_train(site, system)
        and odometry.the_train_stands_where_it_is_located(line(site), system.running)
        and braking.the_train_stands_inside_its_authority(braked(site), system.approach)
        and system.watched.cycles == site.limits.train.brake.response_cycles
        and system.watched.allowed_mm_s == 0
        and system.watched.watch.limit_mm_s == 0
        and 0 <= system.watched.watch.cycles <= system.watched.cycles
        and not system.watched.watch.broken
        and not system.watched.too_fast
        and system.watched.kept
        and system.computer.known.motion == system.running.motion
        and system.computer.known.watch == system.watched.watch
        and system.computer.before.loss == Loss.LOCATED_ANEW
        and system.computer.brake == system.approach.brake
    )


# ---- safety


def the_front_stays_before_the_end(site: Train, system: Whole) -> bool:
    """The front is not beyond the end of authority that the computer's brake holds, lost or not (T12)."""
    return system.front_nm <= NM_A_MM * system.computer.brake.end_mm


def the_front_is_where_the_computer_says(site: Train, system: Whole) -> bool:
    """Once a cycle is sensed the front is in the range that the computer claims, if it claims one (P7)."""
    motion = system.computer.known.motion
    return (
        system.runs
        or motion.loss != Loss.NONE
        or NM_A_MM * motion.front_least_mm <= system.front_nm <= NM_A_MM * motion.front_most_mm
    )


def the_rear_is_where_the_computer_says(site: Train, system: Whole) -> bool:
    """And the rear is no farther back than by the length that the computer reckons with (P4, P7)."""
    motion = system.computer.known.motion
    return (
        system.runs
        or motion.loss != Loss.NONE
        or NM_A_MM * (motion.front_least_mm - site.limits.train.length_mm) <= system.front_nm - NM_A_MM * site.length_mm
    )


def the_speed_is_what_the_computer_says(site: Train, system: Whole) -> bool:
    """And the speed is in its range (P1)."""
    motion = system.computer.known.motion
    return (
        system.runs
        or motion.loss != Loss.NONE
        or UM_A_MM * motion.speed_least_mm_s <= system.speed_um_s <= UM_A_MM * motion.speed_most_mm_s
    )


def no_fix_contradicts(site: Train, system: Whole) -> bool:
    """Of a train whose sensors keep their bounds no tag that lies where it is listed contradicts the range (P7)."""
    return system.computer.known.motion.loss != Loss.CONTRADICTED


def a_sound_brake_is_not_accused(site: Train, system: Whole) -> bool:
    """What the computer calls a broken bound of motors or brake was one (T12)."""
    return not system.computer.known.watch.broken or not system.watched.kept


# ---- one train


def there_is_one_train(site: Train, system: Whole) -> bool:
    """The worlds of the machines see the same front and the same speed: none has refused what happened."""
    seen = before(system)
    return (
        system.approach.head_nm == system.front_nm
        and system.approach.speed_um_s == system.speed_um_s
        and system.running.front_nm == seen.front_nm
        and system.running.speed_um_s == seen.speed_um_s
        and system.watched.speed_um_s == seen.speed_um_s
    )


def the_computer_has_the_proved_odometry(site: Train, system: Whole) -> bool:
    """What the computer knows of place and speed is what the odometry of its proof does."""
    return system.computer.known.motion == system.running.motion


def the_computer_has_the_proved_brake(site: Train, system: Whole) -> bool:
    """Its brake is the one of the brake control's proof."""
    return system.computer.brake == system.approach.brake


def the_computer_has_the_proved_watch(site: Train, system: Whole) -> bool:
    """Its watch is the one of the brake watch's proof."""
    return system.computer.known.watch == system.watched.watch


def the_brake_responds_once_it_was_commanded_for_long_enough(site: Train, system: Whole) -> bool:
    """The response that the brake control still waits for is over when the command is as old (T12)."""
    response_cycles = site.limits.train.brake.response_cycles
    cycles = system.watched.cycles + 1 if system.runs else system.watched.cycles
    return 0 <= system.watched.cycles <= response_cycles and cycles + system.approach.response_cycles >= response_cycles


def no_fix_was_false(site: Train, system: Whole) -> bool:
    """While a range is claimed every fix contained the front (P7)."""
    return system.running.motion.loss != Loss.NONE or (
        system.running.false_by_nm <= 0 and not system.running.contradicted
    )


def the_computer_was_located_a_cycle_ago(site: Train, system: Whole) -> bool:
    """If a range is claimed, and was a cycle ago, the speed was in its range then (P1, P7).

    What was claimed then is claimed no more once the train has been located anew.
    """
    then = system.computer.before
    return (
        system.runs
        or system.computer.known.motion.loss != Loss.NONE
        or then.loss != Loss.NONE
        or UM_A_MM * then.speed_least_mm_s <= system.from_um_s <= UM_A_MM * then.speed_most_mm_s
    )


# ---- what odometry, brake control and brake watch rest on, of the one train


def range_contains_front(site: Train, system: Whole) -> bool:
    """The front is in the range, but for what a fix was false by (P7)."""
    return odometry.range_contains_front(line(site), running(system))


def anchor_contained_front(site: Train, system: Whole) -> bool:
    """At the anchor the front was in the anchor's range, but for what a fix was false by (P1)."""
    return odometry.anchor_contained_front(line(site), running(system))


def a_trusted_wheel_has_not_slipped(site: Train, system: Whole) -> bool:
    """A wheel that is trusted has rolled and been read since the anchor (P1)."""
    return odometry.a_trusted_wheel_has_not_slipped(line(site), running(system))


def a_trusted_wheel_is_known_as_it_was_shown(site: Train, system: Whole) -> bool:
    """Of a wheel that is trusted the last reading is remembered, and the pulses at the anchor (P1)."""
    return odometry.a_trusted_wheel_is_known_as_it_was_shown(line(site), running(system))


def what_agrees_is_known_as_it_was_shown(site: Train, system: Whole) -> bool:
    """After a cycle that agreed the last reading is remembered; after two it was neither stuck nor gross (P1)."""
    return odometry.what_agrees_is_known_as_it_was_shown(line(site), running(system))


def a_wheel_that_agrees_keeps_pace(site: Train, system: Whole) -> bool:
    """While the wheel agrees it keeps pace with the train, but for the first two cycles (P1)."""
    return odometry.a_wheel_that_agrees_keeps_pace(line(site), running(system))


def the_gradient_estimate_is_no_steeper_than_the_line(site: Train, system: Whole) -> bool:
    """The estimate stays within the steepest gradient, so that it hides no jolt (P1)."""
    return odometry.the_gradient_estimate_is_no_steeper_than_the_line(line(site), running(system))


def speed_range_contains_speed(site: Train, system: Whole) -> bool:
    """While a range is claimed, the train's speed is in the range of speeds; the brake reckons with it (P1, T12)."""
    return odometry.speed_range_contains_speed(line(site), running(system))


def the_response_ends(site: Train, system: Whole) -> bool:
    """The brake responds in no negative time, and in its full time if it is off (T12)."""
    return braking.the_response_ends(braked(site), approach(system))


def it_gets_no_faster_before_the_response(site: Train, system: Whole) -> bool:
    """Until the brake has responded the speed stays below the worst that was reckoned with (T12)."""
    return braking.it_gets_no_faster_before_the_response(braked(site), approach(system))


def it_gets_no_farther_before_the_response(site: Train, system: Whole) -> bool:
    """Until the brake has responded the head stays short of the place that was reckoned with (T12)."""
    return braking.it_gets_no_farther_before_the_response(braked(site), approach(system))


def the_way_left_lies_before_the_end(site: Train, system: Whole) -> bool:
    """From that place, the cycle in which the brake takes hold and the way left end before the authority does (T12)."""
    return braking.the_way_left_lies_before_the_end(braked(site), approach(system))


def the_way_left_is_enough(site: Train, system: Whole) -> bool:
    """The guaranteed brake stops the train from the worst speed within the way left: u² <= 2 b s (T12)."""
    return braking.the_way_left_is_enough(braked(site), approach(system))


def a_train_that_keeps_is_no_faster_than_the_limit(site: Train, system: Whole) -> bool:
    """While the bounds are kept, the train is no faster than the limit; what is faster is found out (T12)."""
    return brake_watch.a_train_that_keeps_is_no_faster_than_the_limit(watched_over(site), watched(system))


def the_watch_counts_no_more_than_the_brake(site: Train, system: Whole) -> bool:
    """The watch counts the brake's response as it is; since a restart it may have counted less (T8, T12)."""
    return 0 <= system.computer.known.watch.cycles <= system.watched.cycles


INITIAL = (the_train_stands_held_by_its_brake,)
SAFETY = (
    the_front_stays_before_the_end,
    the_front_is_where_the_computer_says,
    the_rear_is_where_the_computer_says,
    the_speed_is_what_the_computer_says,
    no_fix_contradicts,
    a_sound_brake_is_not_accused,
    there_is_one_train,
    the_computer_has_the_proved_odometry,
    the_computer_has_the_proved_brake,
    the_computer_has_the_proved_watch,
)
INVARIANTS = (
    *SAFETY,
    the_brake_responds_once_it_was_commanded_for_long_enough,
    no_fix_was_false,
    the_computer_was_located_a_cycle_ago,
    range_contains_front,
    anchor_contained_front,
    a_trusted_wheel_has_not_slipped,
    a_trusted_wheel_is_known_as_it_was_shown,
    what_agrees_is_known_as_it_was_shown,
    a_wheel_that_agrees_keeps_pace,
    the_gradient_estimate_is_no_steeper_than_the_line,
    speed_range_contains_speed,
    the_response_ends,
    it_gets_no_faster_before_the_response,
    it_gets_no_farther_before_the_response,
    the_way_left_lies_before_the_end,
    the_way_left_is_enough,
    a_train_that_keeps_is_no_faster_than_the_limit,
    the_watch_counts_no_more_than_the_brake,
)
PREMISES = (the_odometrys_bounds_fit, the_brakes_bounds_fit, the_tags_bounds_fit)
STEPS = (
    run_a_cycle,
    sense_the_cycle,
    read_a_tag,
    take_end,
    withhold_end,
    locate_anew,
    put_into_service,
    await_tag,
    await_none,
    find_whole,
)

THEORY = Theory(
    "train",
    Train,
    Whole,
    by_name(STEPS),
    by_name(INITIAL),
    by_name(INVARIANTS),
    by_name(SAFETY),
    by_name(PREMISES),
    parts=("odometry", "braking", "brake_watch", "tag_fix"),
)
