"""The cycle of 7 s in which a station asks up to four trams and the centre, and how long an answer counts (G3, G6).

The station begins both links.  Each tram answers in its own slot, by the clock of the request (002, 2.3.4).
An answer that is missing, damaged, outside its slot or from another tram than was asked is no answer.
After one cycle without, or when what was told last is older than 11 s, whichever is first, nothing is known
of that tram (ours: 7 s until the next answer, and 4 s that an answer may be old when it comes).
"""

from __future__ import annotations

from dataclasses import dataclass, replace

CYCLE_MS = 7_000
"""002, 2.3.4: about 4 s with the trams and about 3 s with the centre."""
SLOTS = 4
"""Two trams up, two down (002, table 1)."""
STALE_MS = 11_000
"""Ours."""


@dataclass(frozen=True)
class CycleLimits:
    """How a cycle is divided, in ms, each above 0 (002, figure 2).

    ``request_ms``: the request takes as long.  ``slot_ms``: each slot; ``answer_ms``: the answer in it, with
    what clocks differ by on either side.
    """

    request_ms: int
    slot_ms: int
    answer_ms: int


@dataclass(frozen=True)
class Answer:
    """What was received while one slot was open (G3).

    ``is_sound``: a frame that passes its checks.  ``is_asked``: of this station, and of the tram asked in this slot.
    ``at_ms``: when it began, from the beginning of the cycle.  ``age_ms``: how old it says that its data are.
    """

    is_sound: bool
    is_asked: bool
    at_ms: int
    age_ms: int


@dataclass(frozen=True)
class Heard:
    """What the station has of one tram: how old it is, and whether this cycle brought an answer (G3).

    ``slot``: the one in which that tram is asked, from 0.
    ``is_known``: there was one, and no cycle without since.
    """

    slot: int
    is_known: bool
    age_ms: int
    in_this_cycle: bool


def nothing_heard(slot: int) -> Heard:
    """Give what there is before the first answer (G3)."""
    return Heard(slot=slot, is_known=False, age_ms=0, in_this_cycle=False)


def slot_begins_ms(limits: CycleLimits, slot: int) -> int:
    """Give when a slot begins, from the beginning of the cycle; slots count from 0 (G3)."""
    return limits.request_ms + slot * limits.slot_ms


def is_in_slot(limits: CycleLimits, slot: int, at_ms: int) -> bool:
    """Tell whether an answer that begins then is over before the next slot begins (G3)."""
    begins_ms = slot_begins_ms(limits, slot)
    return begins_ms <= at_ms and at_ms + limits.answer_ms <= begins_ms + limits.slot_ms


def note_answer(limits: CycleLimits, heard: Heard, answer: Answer) -> Heard:
    """Take what was received in a slot, if it is the answer that was asked for (G3, G6)."""
    if not (answer.is_sound and answer.is_asked and is_in_slot(limits, heard.slot, answer.at_ms)):
        return heard
    return replace(heard, is_known=True, age_ms=answer.age_ms, in_this_cycle=True)


def older(heard: Heard, elapsed_ms: int) -> Heard:
    """Let time pass (G3)."""
    return replace(heard, age_ms=heard.age_ms + elapsed_ms)


def note_cycle(heard: Heard) -> Heard:
    """End a cycle: what it brought no answer to is not known (G3, ours)."""
    return replace(heard, is_known=heard.in_this_cycle, in_this_cycle=False)


def is_fresh(heard: Heard) -> bool:
    """Tell whether what was heard still counts (G3)."""
    return heard.is_known and heard.age_ms <= STALE_MS
