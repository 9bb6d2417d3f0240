"""What is claimed of the tag reader: what it delivers is a tag's, proved by two frames (T1, T16, T13)."""

from __future__ import annotations

from kernel.onboard import tag_reader as machine
from models.onboard.tag_reader import (
    NOTHING,
    Antenna,
    Passing,
    Slot,
    a_gap_has_a_length,
    be_another,
    begin_a_cycle,
    begin_anew,
    is_right,
    mend,
    pass_a_frame_time,
    restart,
    take,
)
from proofs.theory import Theory, by_name

# ---- the start


def the_unit_has_just_started(site: Antenna, system: Passing) -> bool:
    """At the start nothing was heard, and the antenna has yet to be found sound (T13, T8)."""
    return (
        system.reader == machine.restarted()
        and system.slots == (NOTHING, NOTHING, NOTHING, NOTHING)
        and not system.delivered.valid
    )


# ---- safety


def delivered_record_is_of_the_tag_below(site: Antenna, system: Passing) -> bool:
    """What is delivered is the record of a tag below the antenna, now or in the three frame times before (T1)."""
    first, second, third, fourth = system.slots
    return not machine.delivers(system.reader) or (
        brings(system, first) or brings(system, second) or brings(system, third) or brings(system, fourth)
    )


def brings(system: Passing, slot: Slot) -> bool:
    """Tell whether the record delivered came in a frame time, and was right."""
    return slot.heard == system.reader.held and is_right(slot)


def one_frame_delivers_nothing(site: Antenna, system: Passing) -> bool:
    """What is delivered came in this frame time, and once more in the three before: two of four (T16)."""
    first, second, third, fourth = system.slots
    return not machine.delivers(system.reader) or (
        first.heard.valid
        and first.heard == system.reader.held
        and (first.heard == second.heard or first.heard == third.heard or first.heard == fourth.heard)
    )


def an_unhealthy_antenna_delivers_nothing(site: Antenna, system: Passing) -> bool:
    """Once an antenna was sick nothing it reads is delivered, until it is mended (T13)."""
    return not system.sick or not machine.delivers(system.reader)


def a_passing_is_delivered_once(site: Antenna, system: Passing) -> bool:
    """Of two records delivered one after the other the second is another tag's, or a gap lies between (T1)."""
    return not system.delivered.valid or system.delivered != system.delivered_before or system.parted_before


# ---- what they rest on


def what_is_remembered_was_heard(site: Antenna, system: Passing) -> bool:
    """The last three frames are what came in the last three frame times (T16)."""
    first, second, third, _ = system.slots
    return not system.reader.healthy or (
        system.reader.newest == first.heard
        and system.reader.second == second.heard
        and system.reader.third == third.heard
    )


def a_sick_antenna_counts_as_unhealthy(site: Antenna, system: Passing) -> bool:
    """Once an antenna was sick it counts as unhealthy, and delivers nothing now (T13)."""
    return not system.sick or (not system.reader.healthy and not system.reader.fresh)


def what_was_told_is_held_until_a_gap(site: Antenna, system: Passing) -> bool:
    """The record delivered last is held, unless a gap has passed (T1)."""
    return (
        not system.reader.healthy
        or not system.delivered.valid
        or system.parted
        or system.reader.held == system.delivered
    )


def silence_is_counted(site: Antenna, system: Passing) -> bool:
    """Frame times without a frame are counted as far as a gap reaches (T16)."""
    return not system.reader.healthy or system.reader.quiet_frames == (
        system.quiet_frames if system.quiet_frames < site.limits.gap_frames else site.limits.gap_frames
    )


INITIAL = (the_unit_has_just_started,)
SAFETY = (
    delivered_record_is_of_the_tag_below,
    one_frame_delivers_nothing,
    an_unhealthy_antenna_delivers_nothing,
    a_passing_is_delivered_once,
)
INVARIANTS = (
    *SAFETY,
    what_is_remembered_was_heard,
    a_sick_antenna_counts_as_unhealthy,
    what_was_told_is_held_until_a_gap,
    silence_is_counted,
)
PREMISES = (a_gap_has_a_length,)
STEPS = (pass_a_frame_time, take, begin_a_cycle, mend, restart, begin_anew, be_another)

THEORY = Theory(
    "tag_reader",
    Antenna,
    Passing,
    by_name(STEPS),
    by_name(INITIAL),
    by_name(INVARIANTS),
    by_name(SAFETY),
    by_name(PREMISES),
)
