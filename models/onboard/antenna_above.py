"""An antenna of a train: the tags below it, frame time by frame time, and where the front was then (T1, T16, T13).

The reader's own world takes each step as it is proved there.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

from kernel.onboard import tag_reader as machine
from kernel.onboard.tag_reader import Frame, Level
from models.onboard import tag_reader
from models.onboard.tag_reader import Antenna, Passing, Slot, is_right


@dataclass(frozen=True)
class Above:
    """One moment of one of a train's antennas.

    ``passing``: as the tag reader is proved with it.
    The rest is history.
    ``first_nm`` to ``fourth_nm``: where the front was in each of the last four frame times, the newest first.
    ``lay_below``: the record of the tag below in that of them in which what is delivered came, and was right;
    ``read_at_nm``: where the front was then.  ``due``: in this frame time a record was delivered; nobody has taken it.
    """

    passing: Passing
    first_nm: int
    second_nm: int
    third_nm: int
    fourth_nm: int
    lay_below: Frame
    read_at_nm: int
    due: bool


def pass_a_frame_time(
    site: Antenna, above: Above, frame: Frame, level: Level, below: Frame, sick: bool, at_nm: int
) -> Above:
    """A frame time passes, with the front there (T1, T16, T13)."""
    passing = tag_reader.pass_a_frame_time(site, above.passing, frame, level, below, sick)
    held = passing.reader.held
    first, second, third, fourth = passing.slots
    if brings(first, held):
        slot, read_at_nm = first, at_nm
    elif brings(second, held):
        slot, read_at_nm = second, above.first_nm
    elif brings(third, held):
        slot, read_at_nm = third, above.second_nm
    else:
        slot, read_at_nm = fourth, above.third_nm
    return Above(
        passing=passing,
        first_nm=at_nm,
        second_nm=above.first_nm,
        third_nm=above.second_nm,
        fourth_nm=above.third_nm,
        lay_below=slot.below,
        read_at_nm=read_at_nm,
        due=machine.delivers(passing.reader),
    )


def brings(slot: Slot, held: Frame) -> bool:
    """Tell whether a record came in a frame time, and was right."""
    return slot.heard == held and is_right(slot)


def take(site: Antenna, above: Above) -> Above:
    """The computer takes what is delivered (T1)."""
    return replace(above, passing=tag_reader.take(site, above.passing), due=False)


def begin_a_cycle(site: Antenna, above: Above) -> Above:
    """A cycle of the computer begins (P7)."""
    return replace(above, passing=tag_reader.begin_a_cycle(site, above.passing), due=False)


def mend(site: Antenna, above: Above) -> Above:
    """Staff finds the antenna sound (T13)."""
    return replace(above, passing=tag_reader.mend(site, above.passing), due=False)


def restart(site: Antenna, above: Above) -> Above:
    """The unit restarts (T13, T8)."""
    return replace(above, passing=tag_reader.restart(site, above.passing, above.passing.sick), due=False)


def be_another(site: Antenna, above: Above) -> Above:
    """Another antenna is heard by this reader from now on, or this one elsewhere on the train (T3)."""
    return replace(above, passing=tag_reader.be_another(site, above.passing), due=False)


def turn(site: Antenna, above: Above, other: Above) -> Above:
    """The train has changed ends, or may have: either antenna may be this one from now on (T13, T3)."""
    if above.passing.reader.healthy and other.passing.reader.healthy:
        return replace(above, passing=tag_reader.begin_anew(site, above.passing), due=False)
    sick = above.passing.sick or other.passing.sick
    return replace(above, passing=tag_reader.restart(site, above.passing, sick), due=False)
