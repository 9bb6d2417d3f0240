"""What is claimed of a train from its sensors to its brake: it stops before its end, and knows where it is (P7, T12).

Each claim of odometry, brake control, brake watch, the window for the next tag, the antennas' spacing and the speed
limit is claimed again of the one train that all of them see.
"""

from __future__ import annotations

from dataclasses import replace

from kernel.onboard import computer
from kernel.onboard.odometry import Loss
from kernel.standstill import is_braked, stands
from models.onboard import antenna_spacing as world_of_antennas
from models.onboard import train_tags
from models.onboard.ceiling import AT_REST as KEEPING_AT_REST
from models.onboard.joint import (
    the_brake_takes_the_end_or_stays_applied,
    the_head_stays_inside_authority,
    the_range_contains_the_head,
)
from models.onboard.train import (
    come_apart,
    come_to_rest,
    find_whole,
    inspect_the_brake,
    keep_to,
    locate_anew,
    note_place,
    put_into_service,
    recognise_a_feature,
    run_a_cycle,
    sense_the_cycle,
    take_end,
    withhold_end,
)
from models.onboard.train_nature import (
    Train,
    Whole,
    before,
    braked,
    line,
    one_length_is_written_and_it_covers_the_antennas,
    profile,
    stretch,
    the_antennas_lie_farther_apart_than_the_window_is_long,
    the_brakes_bounds_fit,
    the_lengths_bounds_fit,
    the_odometrys_bounds_fit,
    the_spacings_bounds_fit,
    the_tags_bounds_fit,
    the_windows_bounds_fit,
    track,
    way_nm,
)
from models.onboard.units import NM_A_MM, UM_A_MM, whole_mm
from models.world.truth import is_overdue_first, only_the_last_speaks
from proofs.onboard import (
    antenna_spacing,
    braking,
    odometry,
    speed_limit,
    tag_window,
    train_antennas,
    train_found_sound,
    train_parts,
    train_service,
)
from proofs.onboard.train_parts import (
    a_narrow_range_finds_what_the_head_missed,
    a_tail_over_a_missed_tag_is_known_too_widely,
    a_train_that_keeps_is_no_faster_than_the_limit,
    a_train_that_slows_gets_no_farther,
    a_train_that_slows_gets_no_faster,
    a_trusted_wheel_has_not_slipped,
    a_trusted_wheel_is_known_as_it_was_shown,
    a_wheel_that_agrees_keeps_pace,
    a_whole_train_has_passed_what_its_tail_read,
    a_whole_train_is_near_its_preset,
    a_whole_train_is_preset_as_written,
    anchor_contained_front,
    it_gets_no_farther_before_the_response,
    it_gets_no_faster_before_the_response,
    no_fix_was_false,
    no_listed_restriction_lies_nearer,
    no_restriction_ends_before_the_rear_has_passed,
    range_contains_front,
    speed_range_contains_speed,
    the_brake_holds_the_wanted_end_or_the_one_before,
    the_brake_responds_once_it_was_commanded_for_long_enough,
    the_computer_was_located_a_cycle_ago,
    the_gradient_estimate_is_no_steeper_than_the_line,
    the_response_ends,
    the_watch_counts_no_more_than_the_brake,
    the_way_left_is_enough,
    the_way_left_lies_before_the_end,
    the_way_to_a_restriction_is_enough,
    the_way_to_a_restriction_lies_before_it,
    the_way_to_stop_lies_before_the_end,
    what_no_end_has_freed_stands,
    what_the_head_is_on_is_known,
)
from proofs.promise import by_goal
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
        and not system.watched.too_fast
        and system.watched.kept
        and tag_window.no_tag_is_awaited(stretch(site), system.expecting)
        and system.computer.known.window == system.expecting.window
        and system.computer.known.motion == system.running.motion
        and system.computer.known.watch == system.watched.watch
        and system.computer.before.loss == Loss.LOCATED_ANEW
        and system.computer.brake == system.approach.brake
        and not system.astern
        and system.permitted == KEEPING_AT_REST
        and system.computer.brake == system.asked
        and system.held
        and speed_limit.nothing_is_known_of_the_track(profile(site), system.passing)
        and system.computer.known.limit == system.passing.limit
        and system.computer.known.ahead == system.approach.slowing.ahead
        and system.computer.known.ceiling == system.approach.ceiling
        and train_parts.no_list_has_more_where_the_front_may_be(site, system)
    )


def the_antennas_are_not_preset_yet(site: Train, system: Whole) -> bool:
    """Nor is it known what is the train's tail, nor that it is whole (T3, P5, T8)."""
    return (
        system.computer.known.wholeness.split
        and antenna_spacing.the_unit_has_just_started(track(site), system.trailing)
        and system.computer.spacing == system.trailing.spacing
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


def the_end_is_asked_for_with_the_head_in_range(site: Train, system: Whole) -> bool:
    """Whenever an end of authority may be asked for, the head is in the range that it is worked out by (P7, T12)."""
    motion = system.computer.known.motion
    return (
        system.runs
        or motion.loss != Loss.NONE
        or the_range_contains_the_head(whole_mm(system.front_nm), motion.front_least_mm, motion.front_most_mm)
    )


def the_brake_takes_the_wanted_end_or_stays_applied(site: Train, system: Whole) -> bool:
    """The end that the brake holds is the wanted one, or stands as it was with the brake applied (T4, T12)."""
    brake = system.computer.brake
    is_wanted = system.approach.wanted and brake.end_mm == system.approach.wanted_mm
    return the_brake_takes_the_end_or_stays_applied(system.asked, brake, whole_mm(system.front_nm), is_wanted)


def the_head_runs_no_farther_than_its_brake_lets_it(site: Train, system: Whole) -> bool:
    """Within a cycle the head gets no farther than its end, and nowhere while no end has freed the brake (T12)."""
    from_mm, to_mm = whole_mm(system.from_nm), whole_mm(system.front_nm)
    return not system.runs or the_head_stays_inside_authority(system.held, system.computer.brake, from_mm, to_mm)


def no_fix_contradicts(site: Train, system: Whole) -> bool:
    """Of a train whose sensors keep their bounds no tag that lies where it is listed contradicts the range (P7)."""
    return system.computer.known.motion.loss != Loss.CONTRADICTED


def a_sound_brake_is_not_accused(site: Train, system: Whole) -> bool:
    """What the computer calls a broken bound of motors or brake was one, once they were inspected (T12)."""
    return not system.computer.known.watch.broken or not system.watched.kept or not system.watched.inspected


def a_tag_out_of_place_by_more_than_tolerance_and_error_is_refused(site: Train, system: Whole) -> bool:
    """The awaited tag is not taken where it lies elsewhere than listed, by more than tolerance and errors (T5)."""
    return tag_window.a_tag_out_of_place_by_more_than_tolerance_and_error_is_refused(stretch(site), system.expecting)


def a_missing_tag_is_noticed_within_a_bounded_way(site: Train, system: Whole) -> bool:
    """A train that runs beyond the awaited tag by tolerance and width knows it when its next cycle begins (T5)."""
    return tag_window.a_missing_tag_is_noticed_within_a_bounded_way(stretch(site), system.expecting)


def a_tag_in_its_place_is_never_refused(site: Train, system: Whole) -> bool:
    """The awaited tag is taken where it lies as listed, while the odometry knows the way as is written (T5)."""
    return tag_window.a_tag_in_its_place_is_never_refused(stretch(site), system.expecting)


def a_missed_tag_is_overdue_before_the_tail_comes(site: Train, system: Whole) -> bool:
    """What the tail of a whole train reads does not count while a tag that its head missed is not overdue (T2, T5).

    Unless the train runs at more than twice the speed of its line.
    """
    return is_overdue_first(system.astern, computer.through_line(site.limits, system.computer, True))


def no_tag_still_ahead_is_called_missing(site: Train, system: Whole) -> bool:
    """A tag is overdue only of a train that has come past it, or does not know where it is (T5)."""
    return tag_window.no_tag_still_ahead_is_called_missing(stretch(site), system.expecting)


def a_false_tail_is_found(site: Train, system: Whole) -> bool:
    """Healthy: at the tail's newest read it was as far behind as preset, but for tolerance, window and width (T13)."""
    return antenna_spacing.a_false_tail_is_found(track(site), system.trailing)


def healthy_only_after_a_check(site: Train, system: Whole) -> bool:
    """Healthy: the tail has read since the preset, and its newest tag, any one, the head had read before (T13)."""
    return antenna_spacing.healthy_only_after_a_check(track(site), system.trailing)


def healthy_only_after_a_preset(site: Train, system: Whole) -> bool:
    """Healthy: staff has preset the distance since the unit started; a restart forgets that it fitted (T3, T8)."""
    return antenna_spacing.healthy_only_after_a_preset(track(site), system.trailing)


def a_whole_train_is_never_accused(site: Train, system: Whole) -> bool:
    """While the train is as it was preset, and runs forward, every read fits, however bad the odometry (T13)."""
    return antenna_spacing.a_whole_train_is_never_accused(track(site), system.trailing)


def a_tail_that_counts_is_the_trains_last(site: Train, system: Whole) -> bool:
    """The line fits only if the tail's antenna was as far behind as preset, and the train has not rolled back (T2)."""
    line = replace(computer.through_line(site.limits, system.computer, True), is_intact=True)
    off_nm = system.trailing.tail_nm - NM_A_MM * system.computer.spacing.preset_mm
    return only_the_last_speaks(
        line, not system.computer.known.movement.reversed and not world_of_antennas.is_off(track(site), off_nm)
    )


def a_train_too_fast_for_any_of_its_track_brakes(site: Train, system: Whole) -> bool:
    """In a cycle that began faster than line, curve or turnout allows any part of the train the brake is on (T12)."""
    seen = replace(system.passing, front_nm=system.from_nm, speed_um_s=system.from_um_s)
    return not system.runs or system.computer.brake.applied or speed_limit.keeps_to_its_track(profile(site), seen)


def a_standstill_that_is_told_is_one(site: Train, system: Whole) -> bool:
    """What is told of a train at rest is so; told to be held, or withheld, its brake is (P7, T9, T12)."""
    at, slow_um_s = computer.at_rest(site.limits, system.computer), UM_A_MM * site.limits.train.brake.standstill_mm_s
    return (
        (
            not is_braked(at)
            or (system.computer.brake.applied and system.watched.cycles >= site.limits.train.brake.response_cycles)
        )
        and (at.releasable or system.computer.brake.withheld)
        and (
            system.runs
            or not stands(at)
            or (
                NM_A_MM * at.front_least_mm <= system.front_nm <= NM_A_MM * at.front_most_mm
                and -slow_um_s <= system.speed_um_s <= slow_um_s
            )
        )
    )


# ---- one train


def the_awaited_tag_is_counted_to_where_it_is_listed(site: Train, system: Whole) -> bool:
    """The window is for a tag that the antenna reads where the list has it, neither nearer nor farther (T1, T5)."""
    window, away_mm = system.computer.known.window, system.awaited_mm + site.limits.tags.antenna_mm
    return not window.expected or (
        window.least_mm == window.most_mm == away_mm - system.computer.from_mm
        and computer.awaits(site.limits, system.computer, system.awaited_mm)
    )


def there_is_one_train(site: Train, system: Whole) -> bool:
    """The worlds of the machines see the same front, speed and track: none has refused what happened."""
    seen = before(system)
    return (
        system.approach.head_nm == system.front_nm
        and system.approach.speed_um_s == system.speed_um_s
        and system.running.front_nm == seen.front_nm
        and system.running.speed_um_s == seen.speed_um_s
        and system.watched.speed_um_s == seen.speed_um_s
        and (
            not system.runs
            or not system.expecting.window.expected
            or system.expecting.way_nm == way_nm(system, system.from_nm)
        )
        and (not system.runs or system.trailing.front_nm == system.from_nm)
        and (not system.runs or system.passing.front_nm == system.from_nm)
        and (not system.runs or system.passing.speed_um_s == system.from_um_s)
        and system.passing.in_curve == system.in_curve
        and system.passing.at_turnout == system.at_turnout
    )


def the_computer_has_the_proved_brake(site: Train, system: Whole) -> bool:
    """Its brake, what it knows of restrictions ahead, and its ceiling are those of the brake control's proof."""
    brake, ahead = system.computer.brake, system.computer.known.ahead
    return (
        brake == system.approach.brake
        and ahead == system.approach.slowing.ahead
        and system.computer.known.ceiling == system.approach.ceiling
    )


INITIAL = (
    the_train_stands_held_by_its_brake,
    train_found_sound.nobody_has_inspected_its_brake,
    the_antennas_are_not_preset_yet,
    train_parts.nothing_is_measured,
    *train_antennas.INITIAL,
)
SAFETY = (
    the_front_stays_before_the_end,
    the_front_is_where_the_computer_says,
    the_rear_is_where_the_computer_says,
    the_speed_is_what_the_computer_says,
    the_end_is_asked_for_with_the_head_in_range,
    the_brake_takes_the_wanted_end_or_stays_applied,
    the_head_runs_no_farther_than_its_brake_lets_it,
    no_fix_contradicts,
    a_sound_brake_is_not_accused,
    a_tag_out_of_place_by_more_than_tolerance_and_error_is_refused,
    a_missing_tag_is_noticed_within_a_bounded_way,
    a_tag_in_its_place_is_never_refused,
    a_missed_tag_is_overdue_before_the_tail_comes,
    no_tag_still_ahead_is_called_missing,
    a_false_tail_is_found,
    train_parts.unhealthy_is_latched,
    healthy_only_after_a_check,
    healthy_only_after_a_preset,
    a_whole_train_is_never_accused,
    a_tail_that_counts_is_the_trains_last,
    a_train_too_fast_for_any_of_its_track_brakes,
    train_parts.no_train_is_faster_than_permitted_by_more_than_it_gains,
    train_parts.no_train_enters_a_listed_restriction_faster_than_permitted,
    train_parts.no_head_passes_the_end_that_it_was_let_run_to,
    train_parts.no_train_is_faster_than_the_ceiling_that_it_keeps_to,
    a_standstill_that_is_told_is_one,
    the_awaited_tag_is_counted_to_where_it_is_listed,
    there_is_one_train,
    train_parts.the_computer_has_the_proved_odometry,
    the_computer_has_the_proved_brake,
    train_parts.the_computer_has_the_proved_watch,
    train_parts.the_computer_has_the_proved_window,
    train_parts.the_computer_has_the_proved_spacing,
    train_parts.the_computer_has_the_proved_limit,
    *train_parts.OF_THE_LENGTH,
    *train_found_sound.SAFETY,
    *train_antennas.SAFETY,
)
INVARIANTS = (
    *SAFETY,
    what_no_end_has_freed_stands,
    a_narrow_range_finds_what_the_head_missed,
    a_tail_over_a_missed_tag_is_known_too_widely,
    the_brake_holds_the_wanted_end_or_the_one_before,
    a_whole_train_is_preset_as_written,
    the_brake_responds_once_it_was_commanded_for_long_enough,
    no_fix_was_false,
    the_computer_was_located_a_cycle_ago,
    range_contains_front,
    anchor_contained_front,
    a_trusted_wheel_has_not_slipped,
    a_trusted_wheel_is_known_as_it_was_shown,
    train_parts.what_agrees_is_known_as_it_was_shown,
    a_wheel_that_agrees_keeps_pace,
    the_gradient_estimate_is_no_steeper_than_the_line,
    speed_range_contains_speed,
    the_response_ends,
    it_gets_no_faster_before_the_response,
    it_gets_no_farther_before_the_response,
    the_way_left_lies_before_the_end,
    the_way_left_is_enough,
    no_listed_restriction_lies_nearer,
    a_train_that_slows_gets_no_faster,
    a_train_that_slows_gets_no_farther,
    the_way_to_a_restriction_lies_before_it,
    the_way_to_a_restriction_is_enough,
    train_parts.it_is_reckoned_with_no_more_than_is_guaranteed,
    the_way_to_stop_lies_before_the_end,
    train_parts.the_way_to_stop_is_enough,
    train_parts.until_its_brake_responds_a_train_gains_no_more,
    train_parts.the_worst_is_no_faster_than_the_ceiling,
    train_parts.a_train_that_keeps_to_a_ceiling_gets_no_faster,
    train_parts.motors_are_cut_off_before_the_brake_responds,
    a_train_that_keeps_is_no_faster_than_the_limit,
    the_watch_counts_no_more_than_the_brake,
    train_parts.what_is_not_preset_is_broken,
    train_parts.what_is_caught_is_broken,
    a_whole_train_is_near_its_preset,
    a_whole_train_has_passed_what_its_tail_read,
    train_parts.what_is_remembered_was_read,
    train_parts.the_tails_newest_read_is_noted,
    train_parts.the_heads_last_eight_are_remembered,
    no_restriction_ends_before_the_rear_has_passed,
    what_the_head_is_on_is_known,
    train_parts.no_list_has_more_where_the_front_may_be,
    *train_parts.BEHIND_THE_LENGTH,
    *train_antennas.BEHIND,
)
PREMISES = (
    the_odometrys_bounds_fit,
    the_brakes_bounds_fit,
    the_tags_bounds_fit,
    the_windows_bounds_fit,
    the_spacings_bounds_fit,
    the_antennas_lie_farther_apart_than_the_window_is_long,
    the_lengths_bounds_fit,
    one_length_is_written_and_it_covers_the_antennas,
    *train_antennas.PREMISES,
)
STEPS = (
    run_a_cycle,
    sense_the_cycle,
    train_tags.read_a_tag,
    train_tags.miss_a_tag,
    train_tags.read_unlisted,
    train_tags.read_by_the_tail,
    *train_antennas.STEPS,
    come_apart,
    take_end,
    withhold_end,
    keep_to,
    locate_anew,
    come_to_rest,
    note_place,
    recognise_a_feature,
    put_into_service,
    train_tags.await_tag,
    train_tags.await_none,
    train_tags.note_listed,
    find_whole,
    inspect_the_brake,
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
    promises=by_goal(train_service.PROMISES),
    parts=(
        "odometry",
        "braking",
        "brake_watch",
        "tag_fix",
        "tag_window",
        "antenna_spacing",
        "speed_limit",
        "train_length",
        "tag_reader",
    ),
)
