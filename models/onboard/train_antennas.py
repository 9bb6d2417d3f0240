"""One train and its two antennas: what is below them, what they hear, and what staff says of them (T1, T13, T16).

Each step is one of the tag reader's own world, as it is proved there, for the antenna of the head or of the tail.
"""

from __future__ import annotations

from dataclasses import replace

from kernel.onboard import computer
from kernel.onboard.tag_reader import Frame, Level
from kernel.standstill import is_held
from models.onboard import antenna_above, tag_reader
from models.onboard.antenna_above import Above
from models.onboard.train_nature import (
    Train,
    Whole,
    a_cycle_begins_when_the_one_before_was_sensed,
    a_tag_is_below_the_tail_within_its_window,
    a_tag_is_below_within_the_read_window,
    receiver,
    the_rest_of_the_cycle_follows_the_speed,
)

# ---- premises


def a_gap_between_tags_has_a_length(site: Train) -> bool:
    """What the proof of the tag reader asks of its written limits (T16)."""
    return tag_reader.a_gap_has_a_length(receiver(site))


# ---- assumptions


def two_equal_frames_are_not_both_wrong(above: Above, frame: Frame, below: Frame, sick: bool) -> bool:
    """Of two equal frames of a sound antenna within four, both with a right CRC, one at least is right (T1, T16)."""
    return sick or not frame.valid or tag_reader.two_equal_frames_are_not_both_wrong(above.passing, frame, below)


def a_sick_antenna_shows_in_its_loop(site: Train, level: Level, sick: bool) -> bool:
    """An antenna that reads otherwise than it should transmits too weakly or too strongly (T13)."""
    return tag_reader.a_sick_antenna_shows_in_its_loop(receiver(site), level, sick)


# ---- what happens


def pass_a_frame_time_at_the_head(
    site: Train, system: Whole, frame: Frame, level: Level, below: Frame, sick: bool, at_nm: int
) -> Whole:
    """A frame time of the newest cycle passes at the head's antenna, whatever comes in it (T1, T16, T13)."""
    if not a_cycle_begins_when_the_one_before_was_sensed(system):
        return system
    if not the_rest_of_the_cycle_follows_the_speed(system, at_nm):
        return system
    if not a_tag_is_below_within_the_read_window(site, below, at_nm):
        return system
    if not two_equal_frames_are_not_both_wrong(system.head, frame, below, sick):
        return system
    if not a_sick_antenna_shows_in_its_loop(site, level, sick):
        return system
    return replace(
        system,
        head=antenna_above.pass_a_frame_time(receiver(site), system.head, frame, level, below, sick, at_nm),
        computer=computer.note_head_frame(site.limits, system.computer, frame, level),
    )


def pass_a_frame_time_at_the_tail(
    site: Train, system: Whole, frame: Frame, level: Level, below: Frame, sick: bool, at_nm: int
) -> Whole:
    """A frame time of the newest cycle passes at the antenna that speaks for the tail (T1, T16, T13)."""
    if not a_cycle_begins_when_the_one_before_was_sensed(system):
        return system
    if not the_rest_of_the_cycle_follows_the_speed(system, at_nm):
        return system
    if not a_tag_is_below_the_tail_within_its_window(site, system, below, at_nm):
        return system
    if not two_equal_frames_are_not_both_wrong(system.tail, frame, below, sick):
        return system
    if not a_sick_antenna_shows_in_its_loop(site, level, sick):
        return system
    return replace(
        system,
        tail=antenna_above.pass_a_frame_time(receiver(site), system.tail, frame, level, below, sick, at_nm),
        computer=computer.note_tail_frame(site.limits, system.computer, frame, level),
    )


def mend_the_heads_antenna(site: Train, system: Whole) -> Whole:
    """Staff mends the head's antenna, or finds it sound; of a train that is not held it may say so of any (T13)."""
    told = computer.mend_head(site.limits, system.computer)
    return replace(system, head=_mended(site, system, system.head), computer=told)


def mend_the_tails_antenna(site: Train, system: Whole) -> Whole:
    """Staff mends the tail's antenna, or finds it sound; of a train that is not held it may say so of any (T13)."""
    told = computer.mend_tail(site.limits, system.computer)
    return replace(system, tail=_mended(site, system, system.tail), computer=told)


def _mended(site: Train, system: Whole, above: Above) -> Above:
    """What staff says of an antenna is so if the train is known to be held at rest; else nobody has tried it (T13)."""
    if not is_held(computer.at_rest(site.limits, system.computer)):
        return above
    return antenna_above.mend(receiver(site), above)
