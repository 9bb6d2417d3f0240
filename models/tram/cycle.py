"""One slot of the polling cycle: a tram that answers or does not, and what is received meanwhile (G3, G6)."""

from __future__ import annotations

from dataclasses import dataclass, replace

from kernel.tram import cycle as machine
from kernel.tram.cycle import Answer, CycleLimits, Heard


@dataclass(frozen=True)
class Station:
    """What does not change: how the cycle is divided (G3)."""

    limits: CycleLimits


@dataclass(frozen=True)
class Air:
    """One moment.

    ``heard``: what the station has.  ``slot``: the one in which the tram is asked, from 0.
    ``age_ms``: how old the data are, truly, that the tram answered with last, in its slot and so that it was
    understood.  ``answered``: it did in this cycle, ``answered_last``: in the one before.
    """

    heard: Heard
    slot: int
    age_ms: int
    answered: bool
    answered_last: bool


def time_runs_forward(elapsed_ms: int) -> bool:
    """The station's clock does not go back (G3)."""
    return elapsed_ms >= 0


def data_are_no_older_than_told(answer: Answer, true_age_ms: int) -> bool:
    """The delay that a tram tells covers what its data are old, and the way through the air (table 1)."""
    return true_age_ms <= answer.age_ms


def is_within_its_slot(site: Station, slot: int, at_ms: int) -> bool:
    """Tell whether an answer that begins then is sent in a slot, all of it (002, figure 2)."""
    begins_ms = site.limits.request_ms + slot * site.limits.slot_ms
    return begins_ms <= at_ms and at_ms + site.limits.answer_ms <= begins_ms + site.limits.slot_ms


def pass_time(site: Station, system: Air, elapsed_ms: int) -> Air:
    """Let time pass."""
    if not time_runs_forward(elapsed_ms):
        return system
    return replace(system, heard=machine.older(system.heard, elapsed_ms), age_ms=system.age_ms + elapsed_ms)


def receive(site: Station, system: Air, answer: Answer, true_age_ms: int) -> Air:
    """Something is received: the tram's answer, or anything (G3).

    What passes the frame's checks, names this station and this tram, and lies in its slot, is the tram's.
    """
    if not data_are_no_older_than_told(answer, true_age_ms):
        return system
    is_answer = answer.is_sound and answer.is_asked and is_within_its_slot(site, system.slot, answer.at_ms)
    return replace(
        system,
        heard=machine.note_answer(site.limits, system.heard, answer),
        age_ms=true_age_ms if is_answer else system.age_ms,
        answered=system.answered or is_answer,
    )


def end_cycle(site: Station, system: Air) -> Air:
    """The cycle ends, the next begins."""
    return replace(system, heard=machine.note_cycle(system.heard), answered=False, answered_last=system.answered)


def restart(site: Station, system: Air) -> Air:
    """The station starts anew, in the midst of a cycle or not: it has heard nothing."""
    return replace(system, heard=machine.nothing_heard(system.heard.slot), answered=False, answered_last=False)
