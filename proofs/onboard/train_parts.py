"""What the claims of the one train rest on: of its parts, as each is proved alone, and of the train itself."""

from __future__ import annotations

from dataclasses import replace

from kernel.onboard import computer
from kernel.onboard.odometry import Loss
from kernel.onboard.train_length import PointKind
from kernel.standstill import is_whole
from models.onboard import antenna_spacing as world_of_antennas
from models.onboard import ceiling
from models.onboard.train_nature import (
    Train,
    Whole,
    approach,
    braked,
    length_nm,
    line,
    passage,
    profile,
    railway,
    running,
    tail_comes_over,
    track,
    watched,
    watched_over,
)
from models.onboard.units import NM_A_MM, UM_A_MM
from proofs.onboard import antenna_spacing, brake_watch, braking, odometry, speed_limit, train_length


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


def it_is_reckoned_with_no_more_than_is_guaranteed(site: Train, system: Whole) -> bool:
    """Neither with more of the brake than it gives, nor with a greater speed than is allowed (T12)."""
    return braking.it_is_reckoned_with_no_more_than_is_guaranteed(braked(site), approach(system))


def no_head_passes_the_end_that_it_was_let_run_to(site: Train, system: Whole) -> bool:
    """Whatever ends are taken since: what is listed beyond it is not reached before the brake is let off anew (T12)."""
    return braking.no_head_passes_the_end_that_it_was_let_run_to(braked(site), approach(system))


def the_way_to_stop_lies_before_the_end(site: Train, system: Whole) -> bool:
    """From that place, the cycle in which the brake takes hold and the way left end before the end of then (T12)."""
    return braking.the_way_to_stop_lies_before_the_end(braked(site), approach(system))


def the_way_to_stop_is_enough(site: Train, system: Whole) -> bool:
    """The guaranteed brake stops the train within the way left to the end of then: u² <= 2 b s (T12)."""
    return braking.the_way_to_stop_is_enough(braked(site), approach(system))


def no_train_enters_a_listed_restriction_faster_than_permitted(site: Train, system: Whole) -> bool:
    """Beyond a listed curve or turnout the front is no faster than it allows, nor in the cycle in which it gets there.

    It was listed before the brake was let off last (T12).
    """
    return braking.no_train_enters_a_listed_restriction_faster_than_permitted(braked(site), approach(system))


def no_train_is_faster_than_permitted_by_more_than_it_gains(site: Train, system: Whole) -> bool:
    """No faster than line, curve or turnout let any part of it run when its brake was off last, but for its gain (T12).

    That is what motors and descent give it in that cycle, and until the brake has responded: it keeps to what is
    permitted as it does to a ceiling, which may be lowered only so far that it still can.
    """
    return system.speed_um_s <= system.permitted.worst_um_s


def until_its_brake_responds_a_train_gains_no_more(site: Train, system: Whole) -> bool:
    """Until the brake has responded the speed stays below that, the motors cut off sooner (T12)."""
    permitted = replace(approach(system), keeping=system.permitted)
    return braking.a_train_that_keeps_to_a_ceiling_gets_no_faster(
        braked(site), permitted
    ) and braking.motors_are_cut_off_before_the_brake_responds(braked(site), permitted)


def no_train_is_faster_than_the_ceiling_that_it_keeps_to(site: Train, system: Whole) -> bool:
    """At the end of each cycle: while the brake responds, lost, and after a restart, too (X2, T12)."""
    return braking.no_train_is_faster_than_the_ceiling_that_it_keeps_to(braked(site), approach(system))


def the_worst_is_no_faster_than_the_ceiling(site: Train, system: Whole) -> bool:
    """What was reckoned with when the brake was last off, or the ceiling taken, is no faster than that (X2, T12)."""
    return braking.the_worst_is_no_faster_than_the_ceiling(braked(site), approach(system))


def a_train_that_keeps_to_a_ceiling_gets_no_faster(site: Train, system: Whole) -> bool:
    """Until the brake has responded the speed stays below what was reckoned with, the motors cut off sooner (T12)."""
    return braking.a_train_that_keeps_to_a_ceiling_gets_no_faster(braked(site), approach(system))


def motors_are_cut_off_before_the_brake_responds(site: Train, system: Whole) -> bool:
    """Neither takes a negative time, and each its full time while the brake is off (T12)."""
    return braking.motors_are_cut_off_before_the_brake_responds(braked(site), approach(system))


def the_brake_responds_once_it_was_commanded_for_long_enough(site: Train, system: Whole) -> bool:
    """The response that the brake control still waits for is over when the command is as old (T12)."""
    response_cycles = site.limits.train.brake.response_cycles
    cycles = system.watched.cycles + 1 if system.runs else system.watched.cycles
    return (
        0 <= system.watched.cycles <= response_cycles
        and cycles + system.approach.response_cycles >= response_cycles
        and cycles + system.approach.slowing.response_cycles >= response_cycles
        and cycles + ceiling.response_cycles(system.approach.keeping) >= response_cycles
        and cycles + system.approach.keeping.cut_cycles >= site.limits.train.brake.cut_cycles
        and cycles + ceiling.response_cycles(system.permitted) >= response_cycles
        and cycles + system.permitted.cut_cycles >= site.limits.train.brake.cut_cycles
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


def unhealthy_is_latched(site: Train, system: Whole) -> bool:
    """Once a false tail was compared, or tail came before head, the line is not healthy until preset anew (T13)."""
    return antenna_spacing.unhealthy_is_latched(track(site), system.trailing)


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
    """The tag that the tail of a train that runs forward has read is behind its head by the antenna distance (T13)."""
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
    """In a curve, or on a turnout, the limit says so; as well where a list has one and the front may be there (T12)."""
    return speed_limit.what_the_head_is_on_is_known(profile(site), passage(system, system.front_nm))


def no_list_has_more_where_the_front_may_be(site: Train, system: Whole) -> bool:
    """What a list has where its computer says that the front may be, it has come to (T12)."""
    motion, ahead = system.computer.known.motion, system.computer.known.ahead
    return system.runs or (
        (system.passing.curve_listed or (motion.loss == Loss.NONE and motion.front_most_mm < ahead.curve_mm))
        and (system.passing.turnout_listed or (motion.loss == Loss.NONE and motion.front_most_mm < ahead.turnout_mm))
    )


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
    """A train whose brake no end has freed since it was at rest is held by it, and runs forward no more (T8, T12)."""
    return not system.held or (
        system.speed_um_s <= 0
        and system.computer.brake.withheld
        and system.computer.brake.applied
        and system.watched.cycles >= site.limits.train.brake.response_cycles
        and (not system.runs or system.front_nm <= system.from_nm)
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


# ---- its computer has the proved machines


def the_computer_has_the_proved_odometry(site: Train, system: Whole) -> bool:
    """What the computer knows of place and speed is what the odometry of its proof does."""
    return system.computer.known.motion == system.running.motion


def the_computer_has_the_proved_watch(site: Train, system: Whole) -> bool:
    """Its watch is the one of the brake watch's proof."""
    return system.computer.known.watch == system.watched.watch


def the_computer_has_the_proved_window(site: Train, system: Whole) -> bool:
    """Its window for the next tag is the one of the window's proof."""
    return system.computer.known.window == system.expecting.window


def the_computer_has_the_proved_spacing(site: Train, system: Whole) -> bool:
    """What it knows of its antennas is what the proof of their spacing does."""
    return system.computer.spacing == system.trailing.spacing


def the_computer_has_the_proved_limit(site: Train, system: Whole) -> bool:
    """What it knows of its track is what the proof of the speed limit does."""
    return system.computer.known.limit == system.passing.limit


# ---- whether the train is whole


# ---- the train's length


def nothing_is_measured(site: Train, system: Whole) -> bool:
    """The length is not measured at the start, and is no longer than is written (P4, T8)."""
    return (
        train_length.nothing_is_measured(railway(site), system.formation)
        and train_length.the_line_allows_the_train(railway(site), system.formation)
        and system.formation.length_nm == length_nm(site, system.trailing.apart_nm)
        and system.computer.length == system.formation.state
    )


def the_computer_has_the_proved_length(site: Train, system: Whole) -> bool:
    """What it knows of the train's length is what the proof of that does."""
    return system.computer.length == system.formation.state


def length_never_underestimated(site: Train, system: Whole) -> bool:
    """The train is never longer than the length used, but for what nobody has told (P4, T3)."""
    return train_length.length_never_underestimated(railway(site), system.formation)


def what_was_measured_was_as_far_apart_as_preset(site: Train, system: Whole) -> bool:
    """No length was measured by another's antenna: it is near what the preset distance makes it (P4, T13)."""
    preset_nm = length_nm(site, NM_A_MM * system.computer.spacing.preset_mm)
    off_nm = system.formation.measured_nm - preset_nm
    return not system.computer.length.measured or not world_of_antennas.is_off(track(site), off_nm)


def a_train_longer_than_is_written_does_not_count(site: Train, system: Whole) -> bool:
    """A train measured longer than written, by more than that leaves open, is not whole: no tail counts (P4, T3)."""
    return (
        not system.computer.length.measured
        or system.formation.measured_nm <= NM_A_MM * site.limits.train.length_mm + system.formation.open_nm
        or not is_whole(computer.through_line(site.limits, system.computer, True))
    )


def a_train_of_another_length_does_not_count(site: Train, system: Whole) -> bool:
    """Nor of one that was another when measured again, by more than both leave open, until staff has seen it (P4)."""
    return not system.formation.differed or not is_whole(computer.through_line(site.limits, system.computer, True))


def a_train_as_it_is_written_is_not_accused_of_its_length(site: Train, system: Whole) -> bool:
    """Of a train that nobody has changed untold, and no longer than is written, no measurement says else (P4)."""
    return (
        system.formation.untold
        or system.formation.length_nm > NM_A_MM * site.limits.train.length_mm
        or computer.is_as_long_as_written(site.limits, system.computer)
    )


def a_train_found_whole_is_no_longer_than_is_written(site: Train, system: Whole) -> bool:
    """While it is as it was found, antennas and overhangs make no longer train than is written (P4, T3)."""
    return not system.trailing.whole or (
        system.formation.length_nm <= NM_A_MM * site.limits.train.length_mm and not system.formation.untold
    )


def it_is_as_long_as_its_antennas_are_apart(site: Train, system: Whole) -> bool:
    """And both overhangs, whichever antenna speaks for the tail (T3)."""
    return system.formation.length_nm == length_nm(site, system.trailing.apart_nm)


def the_head_passed_a_tag_where_it_read_it(site: Train, system: Whole) -> bool:
    """What the tail is awaited at is a tag, and the head's antenna was in the window of it (T3, T16)."""
    off_nm = system.formation.front_nm - NM_A_MM * (system.formation.point + site.limits.tags.antenna_mm)
    return not system.formation.head_passed or (
        -NM_A_MM * site.read_within_mm <= off_nm <= NM_A_MM * site.read_within_mm
        and system.formation.kind == PointKind.TAG
    )


def another_length_is_noticed_when_measured_again(site: Train, system: Whole) -> bool:
    """Measured again, and beyond what both measurements leave open: it is shown (P4)."""
    return train_length.another_length_is_noticed_when_measured_again(railway(site), system.formation)


def the_line_allows_every_train(site: Train, system: Whole) -> bool:
    """A train that is not measured is no longer than is written, but for what nobody has told (P4)."""
    return train_length.the_line_allows_every_train(railway(site), system.formation)


def the_noted_pass_is_the_heads(site: Train, system: Whole) -> bool:
    """The pass awaiting the tail is the head's last one (P4)."""
    return train_length.the_noted_pass_is_the_heads(railway(site), system.formation)


def a_pass_in_range_is_noted(site: Train, system: Whole) -> bool:
    """The head's last pass awaits the tail, unless the front was not well enough known (P4)."""
    return train_length.a_pass_in_range_is_noted(railway(site), system.formation)


def the_length_was_between_its_bounds(site: Train, system: Whole) -> bool:
    """When it was measured, the true length was between least and most (P4)."""
    return train_length.the_length_was_between_its_bounds(railway(site), system.formation)


def what_is_not_measured_is_not_contradicted(site: Train, system: Whole) -> bool:
    """Only what was measured is contradicted, or has differed (P4)."""
    return train_length.what_is_not_measured_is_not_contradicted(railway(site), system.formation)


OF_THE_LENGTH = (
    length_never_underestimated,
    what_was_measured_was_as_far_apart_as_preset,
    a_train_longer_than_is_written_does_not_count,
    a_train_of_another_length_does_not_count,
    a_train_as_it_is_written_is_not_accused_of_its_length,
    a_train_found_whole_is_no_longer_than_is_written,
    the_computer_has_the_proved_length,
)
"""What is claimed of the train's length."""
BEHIND_THE_LENGTH = (
    it_is_as_long_as_its_antennas_are_apart,
    the_head_passed_a_tag_where_it_read_it,
    another_length_is_noticed_when_measured_again,
    the_line_allows_every_train,
    the_noted_pass_is_the_heads,
    a_pass_in_range_is_noted,
    the_length_was_between_its_bounds,
    what_is_not_measured_is_not_contradicted,
)
"""And what that follows from."""
