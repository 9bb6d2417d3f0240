"""Whose turn it is on the radio channel: trains are ranged for crossings one after the other (X1).

The ground unit says when each radio sends, and when which of them range (003, 2.4 (1)).  Two rangings at once on one
channel destroy each other, so it gives out slots:

| state | event | guard | then |
|---|---|---|---|
| a pair is not registered | it registers | there is a place left | it has the last place |
| it is | it registers again | | nothing changes: it has one place |
| it is | it leaves | | those behind it close up; its slot, if it has begun, goes on |
| the channel is taken | a tick | | by so much less |
| the slot is over | a tick | | the next slot begins, of the pair with nobody before it; that pair is the last now |
| any | the ground unit starts | | nobody is registered, and the channel is taken for a whole slot |
| ordered | an answer | it has the number of the pair's last slot | it counts, as old as that slot is |

An order may be lost, and so may its answer: the slot ends all the same, by the clock of the ground unit alone.  An
answer may come as late as it likes: by its number it is of one slot, and so of one pair; once that pair has its next
slot it counts no more.

How long a pair waits grows with the pairs on the channel.  So there are no more than ``most_pairs``, for which the
crossings' reckoning leaves time (:func:`are_in_time`); whoever finds no place has no contact, and the conventional
start points warn for it (003, 2.3; X3).
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import NewType

from kernel.crossing.arrival import ArrivalBounds
from kernel.crossing.crossing import Train
from kernel.maps import Map

NONE = -1
"""The number of no slot: that of a pair that has had none since it registered."""

CrossingName = NewType("CrossingName", str)
"""A crossing for which trains are ranged on this channel (X1)."""


@dataclass(frozen=True)
class Pair:
    """A train, and a crossing for which it is ranged (X1)."""

    train: Train
    crossing: CrossingName


@dataclass(frozen=True)
class ChannelSettings:
    """What is written for a channel (X1, ours).

    ``tick_ms``: from one tick of the ground unit to the next.
    ``slot_ms``: after an order the channel is its ranging's for so long, and free again.
    ``most_pairs``: no more pairs are registered.
    """

    tick_ms: int
    slot_ms: int
    most_pairs: int


@dataclass(frozen=True)
class Turn:
    """Where a pair is in the order of slots (X1).

    ``place``: so many are ranged before it.
    ``number``: of its last slot.
    ``age_cycles``: so many decisions of the crossings have begun since that slot did.
    """

    place: int
    number: int
    age_cycles: int


@dataclass(frozen=True)
class Schedule:
    """What the ground unit knows of a channel (X1).

    ``turns``: the registered pairs, and where each is in the order.
    ``pairs``: how many there are.
    ``number``: of the newest slot; none has the number of another, through all starts.
    ``taken_ms``: for so long the channel is still taken.
    """

    turns: Map[Pair, Turn]
    pairs: int
    number: int
    taken_ms: int


# ---- settings


def longest_apart_ms(settings: ChannelSettings, bounds: ArrivalBounds) -> int:
    """Give how old a pair's last ranging may be when the next one is answered, with every answer heard (X1).

    Every pair has had its slot, each up to a tick longer than written; the answer has its own slot to come in; and a
    decision may have begun just after the order.
    """
    return settings.most_pairs * (settings.slot_ms + settings.tick_ms) + settings.slot_ms + bounds.cycle_ms


def are_in_time(settings: ChannelSettings, bounds: ArrivalBounds) -> bool:
    """Tell whether each pair is ranged often enough for a crossing's reckoning (X1, X3); if not, none is registered."""
    return (
        settings.tick_ms > 0
        and settings.slot_ms > 0
        and longest_apart_ms(settings, bounds) <= bounds.silence_cycles * bounds.cycle_ms
    )


# ---- who is registered


def register(settings: ChannelSettings, schedule: Schedule, pair: Pair) -> Schedule:
    """Give a pair the last place, if there is one left; it keeps the one that it has (X1)."""
    if pair in schedule.turns or schedule.pairs >= settings.most_pairs:
        return schedule
    turn = Turn(schedule.pairs, NONE, 0)
    return replace(schedule, turns=schedule.turns | {pair: turn}, pairs=schedule.pairs + 1)


def leave(schedule: Schedule, gone: Pair) -> Schedule:
    """Take a pair off: its train has passed, or contact is lost; those behind it close up (003, 2.3; X1)."""
    if gone not in schedule.turns:
        return schedule
    place = schedule.turns[gone].place
    turns = {
        pair: replace(turn, place=turn.place - 1) if turn.place > place else turn
        for pair, turn in schedule.turns.items()
        if pair != gone
    }
    return replace(schedule, turns=turns, pairs=schedule.pairs - 1)


# ---- time


def next_tick(settings: ChannelSettings, schedule: Schedule) -> Schedule:
    """Let a tick pass; once the channel is free the next slot begins (X1).

    The pair with nobody before it is ranged, and is the last one from now on.
    """
    taken_ms = schedule.taken_ms - settings.tick_ms
    if taken_ms > 0:
        return replace(schedule, taken_ms=taken_ms)
    number = schedule.number + 1
    turns = {
        pair: Turn(schedule.pairs - 1, number, 0) if turn.place == 0 else replace(turn, place=turn.place - 1)
        for pair, turn in schedule.turns.items()
    }
    return Schedule(turns, schedule.pairs, number, settings.slot_ms)


def next_cycle(schedule: Schedule) -> Schedule:
    """The crossings begin to decide: what was ordered before is older by a cycle (X1, X2)."""
    turns = {pair: replace(turn, age_cycles=turn.age_cycles + 1) for pair, turn in schedule.turns.items()}
    return replace(schedule, turns=turns)


# ---- orders and answers


def is_ordered(settings: ChannelSettings, schedule: Schedule, pair: Pair) -> bool:
    """Tell whether the radios of a pair are ordered to range now, by the number of its slot (X1).

    Only in the tick in which its slot begins.
    """
    if pair not in schedule.turns or schedule.taken_ms < settings.slot_ms:
        return False
    return schedule.turns[pair].number == schedule.number


def counts(schedule: Schedule, pair: Pair, number: int) -> bool:
    """Tell whether an answer counts for a pair: it has the number of its last slot (X1).

    Then it is as old as ``age_cycles`` of its turn says, however late it came.
    """
    if number == NONE:
        return False
    return pair in schedule.turns and schedule.turns[pair].number == number
