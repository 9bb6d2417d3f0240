"""What is claimed of the one train's two antennas: the tag reader's claims of each, and what they rest on (T1, T13)."""

from __future__ import annotations

from models.onboard.antenna_above import Above
from models.onboard.tag_reader import Slot
from models.onboard.train_antennas import (
    a_gap_between_tags_has_a_length,
    mend_the_heads_antenna,
    mend_the_tails_antenna,
    pass_a_frame_time_at_the_head,
    pass_a_frame_time_at_the_tail,
)
from models.onboard.train_nature import (
    Train,
    Whole,
    a_tag_is_below_the_tail_within_its_window,
    a_tag_is_below_within_the_read_window,
    receiver,
    the_rest_of_the_cycle_follows_the_speed,
)
from proofs.onboard import tag_reader

# ---- the start


def no_antenna_has_been_found_sound(site: Train, system: Whole) -> bool:
    """At the start nothing was heard, and both antennas count as failed (T13, T8)."""
    return (
        tag_reader.the_unit_has_just_started(receiver(site), system.head.passing)
        and tag_reader.the_unit_has_just_started(receiver(site), system.tail.passing)
        and the_computer_has_the_proved_readers(site, system)
        and not system.tail.due
    )


# ---- safety


def the_computer_has_the_proved_readers(site: Train, system: Whole) -> bool:
    """What it remembers of its antennas is what the proof of the tag reader does."""
    return system.computer.head == system.head.passing.reader and system.computer.tail == system.tail.passing.reader


def delivered_record_is_of_the_tag_below(site: Train, system: Whole) -> bool:
    """What an antenna delivers is the record of a tag that was below it within the last four frame times (T1)."""
    return tag_reader.delivered_record_is_of_the_tag_below(
        receiver(site), system.head.passing
    ) and tag_reader.delivered_record_is_of_the_tag_below(receiver(site), system.tail.passing)


def one_frame_delivers_nothing(site: Train, system: Whole) -> bool:
    """What an antenna delivers came twice within four frame times (T16)."""
    return tag_reader.one_frame_delivers_nothing(
        receiver(site), system.head.passing
    ) and tag_reader.one_frame_delivers_nothing(receiver(site), system.tail.passing)


def an_unhealthy_antenna_delivers_nothing(site: Train, system: Whole) -> bool:
    """Once an antenna was sick nothing it reads is delivered, until it is mended, whichever end it is at (T13)."""
    return tag_reader.an_unhealthy_antenna_delivers_nothing(
        receiver(site), system.head.passing
    ) and tag_reader.an_unhealthy_antenna_delivers_nothing(receiver(site), system.tail.passing)


def a_passing_is_delivered_once(site: Train, system: Whole) -> bool:
    """Of two records that an antenna delivers the second is another tag's, or a gap lies between (T1)."""
    return tag_reader.a_passing_is_delivered_once(
        receiver(site), system.head.passing
    ) and tag_reader.a_passing_is_delivered_once(receiver(site), system.tail.passing)


def what_is_delivered_was_read_in_its_place(site: Train, system: Whole) -> bool:
    """What an antenna delivers is of the tag that it was over, in its window, within the newest cycle (T1, T2, P7)."""
    head, tail = system.head, system.tail
    return (
        not system.computer.head.fresh
        or (
            _is_told(head, system)
            and system.computer.head.held == head.lay_below
            and a_tag_is_below_within_the_read_window(site, head.lay_below, head.read_at_nm)
        )
    ) and (
        not system.computer.tail.fresh
        or (
            _is_told(tail, system)
            and system.computer.tail.held == tail.lay_below
            and a_tag_is_below_the_tail_within_its_window(site, system, tail.lay_below, tail.read_at_nm)
        )
    )


def _is_told(above: Above, system: Whole) -> bool:
    return above.lay_below.valid and the_rest_of_the_cycle_follows_the_speed(system, above.read_at_nm)


# ---- what they rest on


def what_is_remembered_was_heard(site: Train, system: Whole) -> bool:
    """The last three frames of an antenna are what came in its last three frame times (T16)."""
    return tag_reader.what_is_remembered_was_heard(
        receiver(site), system.head.passing
    ) and tag_reader.what_is_remembered_was_heard(receiver(site), system.tail.passing)


def a_sick_antenna_counts_as_unhealthy(site: Train, system: Whole) -> bool:
    """Once an antenna was sick it counts as unhealthy, and delivers nothing now (T13)."""
    return tag_reader.a_sick_antenna_counts_as_unhealthy(
        receiver(site), system.head.passing
    ) and tag_reader.a_sick_antenna_counts_as_unhealthy(receiver(site), system.tail.passing)


def what_was_told_is_held_until_a_gap(site: Train, system: Whole) -> bool:
    """The record that an antenna delivered last is held, unless a gap has passed (T1)."""
    return tag_reader.what_was_told_is_held_until_a_gap(
        receiver(site), system.head.passing
    ) and tag_reader.what_was_told_is_held_until_a_gap(receiver(site), system.tail.passing)


def silence_is_counted(site: Train, system: Whole) -> bool:
    """Frame times without a frame are counted as far as a gap reaches (T16)."""
    return tag_reader.silence_is_counted(receiver(site), system.head.passing) and tag_reader.silence_is_counted(
        receiver(site), system.tail.passing
    )


def what_was_below_the_head_lay_in_its_window(site: Train, system: Whole) -> bool:
    """In each of the last four frame times, of this cycle, the head's antenna was near what was below it (T2, T16)."""
    first, second, third, fourth = system.head.passing.slots
    return (
        _lay_below_the_head(site, system, first, system.head.first_nm)
        and _lay_below_the_head(site, system, second, system.head.second_nm)
        and _lay_below_the_head(site, system, third, system.head.third_nm)
        and _lay_below_the_head(site, system, fourth, system.head.fourth_nm)
    )


def _lay_below_the_head(site: Train, system: Whole, slot: Slot, at_nm: int) -> bool:
    return not slot.below.valid or (
        a_tag_is_below_within_the_read_window(site, slot.below, at_nm)
        and the_rest_of_the_cycle_follows_the_speed(system, at_nm)
    )


def what_was_below_the_tail_lay_in_its_window(site: Train, system: Whole) -> bool:
    """So was the antenna that speaks for the tail (T2, T16)."""
    first, second, third, fourth = system.tail.passing.slots
    return (
        _lay_below_the_tail(site, system, first, system.tail.first_nm)
        and _lay_below_the_tail(site, system, second, system.tail.second_nm)
        and _lay_below_the_tail(site, system, third, system.tail.third_nm)
        and _lay_below_the_tail(site, system, fourth, system.tail.fourth_nm)
    )


def _lay_below_the_tail(site: Train, system: Whole, slot: Slot, at_nm: int) -> bool:
    return not slot.below.valid or (
        a_tag_is_below_the_tail_within_its_window(site, system, slot.below, at_nm)
        and the_rest_of_the_cycle_follows_the_speed(system, at_nm)
    )


def what_the_tail_delivers_is_due(site: Train, system: Whole) -> bool:
    """It is known of each record of the tail whether it has been taken (T2)."""
    return system.tail.due == system.tail.passing.reader.fresh


SAFETY = (
    the_computer_has_the_proved_readers,
    delivered_record_is_of_the_tag_below,
    one_frame_delivers_nothing,
    an_unhealthy_antenna_delivers_nothing,
    a_passing_is_delivered_once,
    what_is_delivered_was_read_in_its_place,
)
BEHIND = (
    what_is_remembered_was_heard,
    a_sick_antenna_counts_as_unhealthy,
    what_was_told_is_held_until_a_gap,
    silence_is_counted,
    what_was_below_the_head_lay_in_its_window,
    what_was_below_the_tail_lay_in_its_window,
    what_the_tail_delivers_is_due,
)
INITIAL = (no_antenna_has_been_found_sound,)
PREMISES = (a_gap_between_tags_has_a_length,)
STEPS = (
    pass_a_frame_time_at_the_head,
    pass_a_frame_time_at_the_tail,
    mend_the_heads_antenna,
    mend_the_tails_antenna,
)
