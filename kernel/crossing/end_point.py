"""Which train has left: the terminal of an end point, told by tags whose rear is out of the approach (X4, T14).

Who was warned of asks for the warning until its rear is past.  Beyond the road, out of reach of a train that stands
over it, two tags lie on each track, the inner one nearer to the road; and two beyond each start point, for trains that
turn back.  A train tells which two tags its tail has read last, and after how long; what a tail reads counts only while
its train runs forward (P7), so that a tail comes over the inner tag and then the outer one as it leaves (ours):

| state | event | guard | then |
|---|---|---|---|
| any | a train tells of its tail | the inner tag and then the outer one, within ``apart_cycles`` | it is gone |
| | | it is whole, and that was no longer ago than ``told_cycles`` | |
| any | it tells anything else | | nothing |

A tail that comes in reads the outer tag first.  One that missed a tag on its way out and the other one on its way in
has read both in the order of who leaves, but not within the time that a train takes to change ends; nor is it back
before what it told is too old.  The terminal keeps nothing: there is nothing to lose when it restarts, and what it is
told twice it says twice of a train that has left.
"""

from __future__ import annotations

from dataclasses import dataclass

from kernel.names import Tag


@dataclass(frozen=True)
class EndPointSettings:
    """What is written for an end point, in the crossing's cycles (X4, T14).

    ``inner``, ``outer``: its tags, the first one nearer to the road.
    ``apart_cycles``: from the one to the other a tail that leaves takes no longer; a slower one is not told gone.
    ``told_cycles``: what a train tells is no older than this; older telegrams are refused (T11).
    ``changes_cycles``: a train that has left is not back within so many, nor has one that comes in been at the inner
    tag within so many.
    """

    inner: Tag
    outer: Tag
    apart_cycles: int
    told_cycles: int
    changes_cycles: int


@dataclass(frozen=True)
class TailRead:
    """What a train tells of its tail: the tags that it has read last, in order, and after how many cycles (T2, T13).

    ``is_whole``: the through line reaches that tail, and its reads are as far behind the head's as they should be.
    """

    before: Tag
    last: Tag
    apart_cycles: int
    is_whole: bool


def are_lawful(settings: EndPointSettings) -> bool:
    """Tell whether an end point may be set so: whoever is told gone is not back yet (X4, ours)."""
    return (
        settings.apart_cycles <= settings.changes_cycles
        and settings.told_cycles <= settings.changes_cycles
        and settings.inner != settings.outer
    )


def has_left(settings: EndPointSettings, read: TailRead, age_cycles: int) -> bool:
    """Tell whether a train that tells this has left by this end point, with all that belongs to it (X4, T14).

    No time is below 0: a clock that goes back tells nothing.

    ``age_cycles``: how long ago its tail read the later tag.
    """
    return (
        read.before == settings.inner
        and read.last == settings.outer
        and 0 <= read.apart_cycles <= settings.apart_cycles
        and read.is_whole
        and 0 <= age_cycles <= settings.told_cycles
    )
