"""A train's promise of a ceiling: how fast it runs at most up to the road, until the crossing lets it go faster.

A crossing that knows nothing of what a train means to do has to hold it to the greatest speed of the line.  So a train
may tell, with its place, a ceiling that its own speed supervision keeps (X2, ours):

- it lowers its ceiling whenever it likes, to what it keeps to already;
- it raises it by the crossing's acknowledgement alone, of just this ask;
- silence revokes nothing: what was promised is kept, and what was not acknowledged is not done.

Each promise has a number of its own.  What is old or comes twice is known by it, at both ends.

A train that promises nothing has the line's ceiling.  One at rest may promise 0: that is to stand.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

from kernel.onboard.arithmetic import GREATEST_SPEED_MM_S

NONE = 0
"""The number of no promise; the first that a train makes is the next one."""


@dataclass(frozen=True)
class Promise:
    """What a train holds to, what it tells of that, and what the crossing has noted (X2, ours).

    ``number``: of this promise or ask; each that a train makes has the next one.
    ``ceiling_mm_s``: the train runs no faster, up to the road.
    ``asked_mm_s``: it asks to run as fast as this; where it asks for nothing that is its ceiling.
    """

    number: int
    ceiling_mm_s: int
    asked_mm_s: int


def nothing_promised(line_mm_s: int) -> Promise:
    """Give what a train holds to, and a crossing of it, before anything is promised: the line's greatest speed (X2)."""
    return Promise(NONE, line_mm_s, line_mm_s)


# ---- on the train


def lower(held: Promise, ceiling_mm_s: int, speed_most_mm_s: int) -> Promise:
    """Promise a lower ceiling, and give up what was asked; the train is no faster than that already (X2, ours).

    ``speed_most_mm_s``: by the upper end of its range (P1).
    """
    if ceiling_mm_s > held.ceiling_mm_s or ceiling_mm_s < speed_most_mm_s:
        return held
    return Promise(held.number + 1, ceiling_mm_s, ceiling_mm_s)


def ask(line_mm_s: int, held: Promise, asked_mm_s: int) -> Promise:
    """Ask to go faster, within the line's speed; until that is acknowledged the ceiling stays (X2, ours)."""
    if not held.ceiling_mm_s < asked_mm_s <= line_mm_s:
        return held
    return Promise(held.number + 1, held.ceiling_mm_s, asked_mm_s)


def note_acknowledged(held: Promise, number: int) -> Promise:
    """Go faster, if it is this ask that the crossing acknowledges, and not one that was given up (X2, ours)."""
    if number != held.number:
        return held
    return replace(held, ceiling_mm_s=held.asked_mm_s)


# ---- at the crossing


def note(noted: Promise, told: Promise) -> Promise:
    """Note what a train tells, if it is newer than what was noted (X2, ours).

    Of the first promise that is heard since the crossing started what it asks for counts: that may have been
    acknowledged before a restart, and the acknowledgement be under way still.
    """
    if told.number <= noted.number or not 0 <= told.ceiling_mm_s <= told.asked_mm_s <= GREATEST_SPEED_MM_S:
        return noted
    if noted.number == NONE:
        return replace(told, ceiling_mm_s=told.asked_mm_s)
    return told


def acknowledged(noted: Promise) -> Promise:
    """Acknowledge what a train asks for; from now on it may run so fast (X2, ours)."""
    return replace(noted, ceiling_mm_s=noted.asked_mm_s)
