"""Whose strike it was: the terminal of a start point, told by tags which train comes to it (X3, T14).

The detector of a start point tells that a train has struck it, and not which.  A train in contact is left to its
rangings, so a strike may be put down to it only if it made it; for any other the crossing warns.  Rangings do not tell
that: trains run side by side on two tracks, and one without radio close to one in contact.  So a tag lies shortly
before each detector, nearer than the shortest train is long.  The train whose head reads it says so (ours):

| state | event | guard | then |
|---|---|---|---|
| any | a train tells of a tag | it is this start point's; nobody has struck for ``told_cycles`` | the read waits |
| a read waits | a strike | | it is of the train that read, and nothing waits |
| none waits | a strike | | it has a name that nobody has had |
| a read waits | a cycle | it has waited for ``waits_cycles`` | it waits no more |
| any | the terminal starts | | nothing waits, a strike may just have been, and any number may have been missed |
| some may have been missed | the terminal is heard | | it tells so first: nobody has accounted for its track |

What a train tells may come late, up to ``told_cycles``, and again.  A strike since then may have been that train's own,
and the read would wait for the next train's: so it does not count.  A train may turn back between tag and detector; it
is ``changes_cycles`` before another one can be there, and until then its read has stopped waiting.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

from kernel.crossing.crossing import Train
from kernel.names import Tag
from kernel.onboard.arithmetic import larger


@dataclass(frozen=True)
class StartPointSettings:
    """What is written for a start point, in the crossing's cycles (X3, T14).

    ``tag``: the one before its detector.
    ``told_cycles``: what a train tells of a read is no older than this; older telegrams are refused (T11).
    ``waits_cycles``: so long a read waits for its strike.
    ``changes_cycles``: for so long after a head has read the tag no other one is at the tag or the detector, unless
    the first has struck.
    """

    tag: Tag
    told_cycles: int
    waits_cycles: int
    changes_cycles: int


@dataclass(frozen=True)
class StartPoint:
    """What the terminal of a start point knows.

    ``reader``: the train whose read waits for its strike.
    ``left_cycles``: for so many more; with 0 none waits.
    ``struck_cycles``: how long ago the last strike was, or the start.
    ``owes``: since its start it has not told that strikes may have been missed.
    """

    reader: Train
    left_cycles: int
    struck_cycles: int
    owes: bool


def are_lawful(settings: StartPointSettings) -> bool:
    """Tell whether a start point may be set so: no read waits when another train can be there (X3, ours)."""
    return settings.told_cycles + settings.waits_cycles <= settings.changes_cycles


def note_read(settings: StartPointSettings, point: StartPoint, train: Train, tag: Tag) -> StartPoint:
    """A train tells that its head has read a tag (T14).

    Another track's tag tells nothing of this start point.  A strike that is no older than what is told may have been
    this train's, and one strike is all that it makes.
    """
    if tag != settings.tag or point.struck_cycles <= settings.told_cycles:
        return point
    return replace(point, reader=train, left_cycles=settings.waits_cycles)


def striker(point: StartPoint, new: Train) -> Train:
    """Give the name by which a strike is told to the crossing; ``new``: one that nobody has had (X3, T14)."""
    return point.reader if point.left_cycles > 0 else new


def note_strike(point: StartPoint) -> StartPoint:
    """The detector has been struck: no read waits any more (X3)."""
    return replace(point, left_cycles=0, struck_cycles=0)


def note_owed(point: StartPoint) -> StartPoint:
    """The crossing has been told that strikes may have been missed; a person is to see the track empty (X3, ours)."""
    return replace(point, owes=False)


def aged(point: StartPoint) -> StartPoint:
    """Let a cycle pass (X3)."""
    return replace(point, left_cycles=larger(0, point.left_cycles - 1), struck_cycles=point.struck_cycles + 1)
