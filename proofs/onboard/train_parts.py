"""What the claims of the one train rest on: of its parts, as each is proved alone, and of the train itself."""

from __future__ import annotations

from kernel.onboard import computer
from kernel.onboard.odometry import Loss
from models.onboard.train_nature import (
    Train,
    Whole,
    approach,
    braked,
    line,
    passage,
    profile,
    running,
    tail_comes_over,
    track,
    watched,
    watched_over,
)
from proofs.onboard import antenna_spacing, brake_watch, braking, odometry, speed_limit


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


def no_listed_restriction_lies_nearer(site: Train, system: Whole) -> bool:
    """Whatever truly restricts the train, and is listed, is known no farther away than it is (T1, T12)."""
    return braking.no_listed_restriction_lies_nearer(braked(site), approach(system))


def a_train_that_slows_gets_no_faster(site: Train, system: Whole) -> bool:
    """Until the brake has responded the speed stays below what was reckoned with when it was last off (T12)."""
    return braking.a_train_that_slows_gets_no_faster(braked(site), approach(system))


def a_train_that_slows_gets_no_farther(site: Train, system: Whole) -> bool:
    """Until then the head stays short of the place that was reckoned with (T12)."""
    return braking.a_train_that_slows_gets_no_farther(braked(site), approach(system))


def the_way_to_a_restriction_lies_before_it(site: Train, system: Whole) -> bool:
    """From that place, the cycle in which the brake takes hold and the way left end before the restriction (T12)."""
    return braking.the_way_to_a_restriction_lies_before_it(braked(site), approach(system))


def the_way_to_a_restriction_is_enough(site: Train, system: Whole) -> bool:
    """The guaranteed brake slows the train within the way left to what is allowed there: u² - v² <= 2 b s (T12)."""
    return braking.the_way_to_a_restriction_is_enough(braked(site), approach(system))


def the_brake_responds_once_it_was_commanded_for_long_enough(site: Train, system: Whole) -> bool:
    """The response that the brake control still waits for is over when the command is as old (T12)."""
    response_cycles = site.limits.train.brake.response_cycles
    cycles = system.watched.cycles + 1 if system.runs else system.watched.cycles
    return (
        0 <= system.watched.cycles <= response_cycles
        and cycles + system.approach.response_cycles >= response_cycles
        and cycles + system.approach.slowing.response_cycles >= response_cycles
    )


def no_fix_was_false(site: Train, system: Whole) -> bool:
    """While a range is claimed every fix contained the front (P7)."""
    return system.running.motion.loss != Loss.NONE or (
        system.running.false_by_nm <= 0 and not system.running.contradicted
    )


def a_train_that_keeps_is_no_faster_than_the_limit(site: Train, system: Whole) -> bool:
    """While the bounds are kept, the train is no faster than the limit; what is faster is found out (T12)."""
    return brake_watch.a_train_that_keeps_is_no_faster_than_the_limit(watched_over(site), watched(system))


def the_watch_counts_no_more_than_the_brake(site: Train, system: Whole) -> bool:
    """The watch counts the brake's response as it is; since a restart it may have counted less (T8, T12)."""
    return 0 <= system.computer.known.watch.cycles <= system.watched.cycles


def what_is_not_preset_is_broken(site: Train, system: Whole) -> bool:
    """Until staff presets the distance no read puts right what a restart has latched (T8, T13)."""
    return antenna_spacing.what_is_not_preset_is_broken(track(site), system.trailing)


def what_is_caught_is_broken(site: Train, system: Whole) -> bool:
    """What was latched is still latched (T13)."""
    return antenna_spacing.what_is_caught_is_broken(track(site), system.trailing)


def a_whole_train_is_near_its_preset(site: Train, system: Whole) -> bool:
    """While the train is as it was preset, its antennas are as far apart as that, and farther than a window (T3)."""
    return antenna_spacing.a_whole_train_is_near_its_preset(track(site), system.trailing)


def a_whole_train_has_passed_what_its_tail_read(site: Train, system: Whole) -> bool:
    """While the train is whole, the tag that its tail has read is behind its head by the antenna distance (T13)."""
    return antenna_spacing.a_whole_train_has_passed_what_its_tail_read(track(site), system.trailing)


def what_is_remembered_was_read(site: Train, system: Whole) -> bool:
    """Every read that is remembered was one, in its place (T13)."""
    return antenna_spacing.what_is_remembered_was_read(track(site), system.trailing)


def the_tails_newest_read_is_noted(site: Train, system: Whole) -> bool:
    """The machine knows whether the tail has read, and which tag last (T13)."""
    return antenna_spacing.the_tails_newest_read_is_noted(track(site), system.trailing)


def the_heads_last_eight_are_remembered(site: Train, system: Whole) -> bool:
    """The one tag, if it is among the head's last eight, is remembered as it was read last (T13)."""
    return antenna_spacing.the_heads_last_eight_are_remembered(track(site), system.trailing)


def no_restriction_ends_before_the_rear_has_passed(site: Train, system: Whole) -> bool:
    """Where a curve or a turnout was left is remembered, no nearer than it was, while it does not go on (T12)."""
    return speed_limit.no_restriction_ends_before_the_rear_has_passed(profile(site), passage(system, system.front_nm))


def what_the_head_is_on_is_known(site: Train, system: Whole) -> bool:
    """In a curve, or on a turnout, the limit says so (T12)."""
    return speed_limit.what_the_head_is_on_is_known(profile(site), passage(system, system.front_nm))


def a_narrow_range_finds_what_the_head_missed(site: Train, system: Whole) -> bool:
    """A cycle that begins with a narrow range calls an awaited tag overdue before the tail comes over it (T2, T5)."""
    motion, window = system.computer.known.motion, system.computer.known.window
    return (
        not system.runs
        or motion.loss != Loss.NONE
        or motion.front_most_mm - motion.front_least_mm > site.limits.window.tail_width_mm
        or not window.expected
        or window.passed
        or not tail_comes_over(site, system)
    )


def a_tail_over_a_missed_tag_is_known_too_widely(site: Train, system: Whole) -> bool:
    """The tail is over a tag that was not overdue only where the range was too wide when the cycle began (T2, T5)."""
    return not system.astern or not computer.finds_a_missed_tag(site.limits, system.computer)


def the_brake_holds_the_wanted_end_or_the_one_before(site: Train, system: Whole) -> bool:
    """Wherever the head is: another end than the wanted one is that of before, with the brake applied (T4, T12)."""
    brake = system.computer.brake
    is_wanted = system.approach.wanted and brake.end_mm == system.approach.wanted_mm
    return is_wanted or (brake.withheld and brake.end_mm == system.asked.end_mm)


def a_whole_train_is_preset_as_written(site: Train, system: Whole) -> bool:
    """Staff presets no other distance of the antennas than is written of the train (T3)."""
    return not system.trailing.whole or system.trailing.spacing.preset_mm == site.limits.antennas_mm


def what_no_end_has_freed_stands(site: Train, system: Whole) -> bool:
    """A train whose brake no end has freed since it was located is held by it, and runs forward no more (T8, T12)."""
    return not system.held or (
        system.speed_um_s <= 0
        and system.computer.brake.withheld
        and system.computer.brake.applied
        and system.watched.cycles >= site.limits.train.brake.response_cycles
        and (not system.runs or system.front_nm <= system.from_nm)
    )
