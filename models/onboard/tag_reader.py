"""Tags below an antenna, frame time by frame time, and the reader that takes their records (T1, T16, T13).

Tags lie farther apart than the antenna's window is long (T2, T16), so that one at most is below it.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

from kernel.onboard import tag_reader as machine
from kernel.onboard.tag_reader import Frame, Level, Reader, ReaderLimits


@dataclass(frozen=True)
class Antenna:
    """What does not change (T16)."""

    limits: ReaderLimits


@dataclass(frozen=True)
class Slot:
    """One frame time: what came, and the record of the tag truly below; not valid where none was (T1)."""

    heard: Frame
    below: Frame


NO_FRAME = Frame(valid=False, uid=0, block=0, distance_mm=0, kind=0)
NOTHING = Slot(heard=NO_FRAME, below=NO_FRAME)


@dataclass(frozen=True)
class Passing:
    """One moment of an antenna above the track.

    ``reader``: what the machine knows.
    The rest is history, since the antenna was mended or the unit restarted.
    ``slots``: the last four frame times, the newest first.
    ``sick``: the antenna has failed, for a time at least.
    ``delivered``: the record delivered last.  ``quiet_frames``: frame times since the last valid frame.
    ``parted``: a whole gap has passed since ``delivered``.
    ``delivered_before``: the record delivered before that; ``parted_before``: a gap lay between the two.
    """

    reader: Reader
    slots: tuple[Slot, Slot, Slot, Slot]
    sick: bool
    delivered: Frame
    quiet_frames: int
    parted: bool
    delivered_before: Frame
    parted_before: bool


# ---- premises


def a_gap_has_a_length(site: Antenna) -> bool:
    """A gap lasts one frame time or more (T16)."""
    return site.limits.gap_frames >= 1


# ---- assumptions


def is_right(slot: Slot) -> bool:
    """Tell whether what came is the record of the tag below (T1)."""
    return slot.heard == slot.below


def two_equal_frames_are_not_both_wrong(system: Passing, frame: Frame, below: Frame) -> bool:
    """Of two equal frames within four, both with a right CRC, one at least is the tag's below (T1, T16).

    A damaged frame passes the CRC once in 65,536; that it happens twice within four frame times, and
    gives the same wrong record, is taken for impossible.  A frame that is another tag's, by an echo in
    the receiver's memory, counts as wrong.
    """
    first, second, third, _ = system.slots
    newest = Slot(heard=frame, below=below)
    return is_right(newest) or (
        (first.heard != frame or is_right(first))
        and (second.heard != frame or is_right(second))
        and (third.heard != frame or is_right(third))
    )


def a_sick_antenna_shows_in_its_loop(site: Antenna, level: Level, sick: bool) -> bool:
    """An antenna that reads otherwise than it should transmits too weakly or too strongly (paper 000, 3.5.2; T13)."""
    return not sick or not level.valid or level.mv < site.limits.least_mv or level.mv > site.limits.most_mv


# ---- what happens


def pass_a_frame_time(site: Antenna, system: Passing, frame: Frame, level: Level, below: Frame, sick: bool) -> Passing:
    """A frame time passes: a frame comes or not, of the tag below or a wrong one (T1, T16, T13).

    What a sick antenna brings is not limited at all.
    """
    if not (sick or not frame.valid or two_equal_frames_are_not_both_wrong(system, frame, below)):
        return system
    if not a_sick_antenna_shows_in_its_loop(site, level, sick):
        return system
    reader = machine.note_frame(site.limits, system.reader, frame, level)
    first, second, third, _ = system.slots
    quiet_frames = 0 if frame.valid else system.quiet_frames + 1
    parted = system.parted or quiet_frames >= site.limits.gap_frames
    after = replace(
        system,
        reader=reader,
        slots=(Slot(heard=frame, below=below), first, second, third),
        sick=system.sick or sick,
        quiet_frames=quiet_frames,
        parted=parted,
    )
    if not machine.delivers(reader):
        return after
    return replace(after, delivered=reader.held, delivered_before=system.delivered, parted_before=parted, parted=False)


def mend(site: Antenna, system: Passing) -> Passing:
    """Staff mends the antenna, finds it sound, and resets the reader; supervised (T13)."""
    return replace(begun(system), reader=machine.mended(), sick=False)


def restart(site: Antenna, system: Passing, sick: bool) -> Passing:
    """The unit restarts; whether this antenna, or the one that is there now, had failed is still to be known (T13, T8).

    ``sick``: it had.
    """
    return replace(begun(system), reader=machine.restarted(), sick=sick)


def begin_anew(site: Antenna, system: Passing) -> Passing:
    """The train begins anew where it stands, and no antenna of it is known to have failed that had not before (P7)."""
    return replace(begun(system), reader=machine.turned(system.reader, system.reader))


def take(site: Antenna, system: Passing) -> Passing:
    """What was delivered in this frame time is taken (T1)."""
    return replace(system, reader=machine.taken(system.reader))


def begin_a_cycle(site: Antenna, system: Passing) -> Passing:
    """A cycle of the computer begins; of frames that came before it none counts any more (T1, P7)."""
    return replace(system, reader=machine.next_cycle(system.reader), slots=(NOTHING, NOTHING, NOTHING, NOTHING))


def be_another(site: Antenna, system: Passing) -> Passing:
    """Another antenna is heard from now on: what the one before was above was not below this one (T3, T13).

    What was delivered before has been taken.
    """
    first, second, third, fourth = system.slots
    return replace(
        system,
        reader=machine.taken(system.reader),
        slots=(
            replace(first, below=NO_FRAME),
            replace(second, below=NO_FRAME),
            replace(third, below=NO_FRAME),
            replace(fourth, below=NO_FRAME),
        ),
    )


def begun(system: Passing) -> Passing:
    """Begin the history of frames anew."""
    return replace(
        system,
        slots=(NOTHING, NOTHING, NOTHING, NOTHING),
        delivered=NO_FRAME,
        quiet_frames=0,
        parted=False,
        delivered_before=NO_FRAME,
        parted_before=False,
    )
