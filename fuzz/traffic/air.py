"""The radio: a telegram that was sent gets lost, comes late, comes twice, or comes (T11)."""

from __future__ import annotations

from typing import Any

from fuzz.traffic.compiling import compiled
from fuzz.traffic.entries import both, entry
from fuzz.traffic.faults import number
from fuzz.traffic.places import (
    BY,
    CAUSE,
    CLOCK,
    DUE,
    EVENT,
    LATE,
    LATE_WORDS,
    MOST_LATE,
    NOBODY,
    RUNS_COUNT,
    STANDING,
    TRACK_LIES_VALUE,
    WORDS,
)
from fuzz.traffic.steps import next_run, set_train, take, take_granting
from fuzz.traffic.tables import ANSWER, MOST_WORDS, NOTE_STANDING, NOTE_STATEMENT_CONFIRMED, OBEY_ORDER
from fuzz.traffic.words import between, get, get1, happens, of

LOSS = number("radio loss")
REPETITION = number("radio repetition")
REORDERING = number("radio reordering")
DELAY = number("radio delay")
NEVER = 1 << 40
_DUE, _KIND, _BY, _TRAIN, _WORDS = range(5)


@compiled
def strikes(desk: Any, fault: Any, train: Any) -> Any:
    """Draw whether a fault of this trace hits a train; if it stands still then, this is the cause."""
    if not happens(desk, fault):
        return False
    if train < NOBODY:
        set_train(desk, train, CAUSE, fault)
    return True


@compiled
def hold_up(memory: Any, desk: Any, kind: Any, train: Any, seconds: Any) -> None:
    """The telegram in the buffer comes after so many seconds; with too many under way, and a challenge, it is lost."""
    if kind == ANSWER or of(desk, WORDS, kind) > MOST_WORDS:
        return
    for at in range(MOST_LATE):
        late = LATE + at * LATE_WORDS
        if desk[late + _DUE] == NEVER:
            desk[late + _DUE] = desk[CLOCK] + seconds
            desk[late + _KIND], desk[late + _BY], desk[late + _TRAIN] = kind, desk[BY], train
            for word in range(of(desk, WORDS, kind)):
                desk[late + _WORDS + word] = memory[desk[EVENT] + word]
            desk[DUE] = min(desk[DUE], desk[late + _DUE])
            return


@entry
def comes(memory_at: Any, desk_at: Any, kind: Any, train: Any) -> Any:
    """Whether the telegram in the buffer comes now."""
    memory, desk = both(memory_at, desk_at)
    if strikes(desk, LOSS, train):
        desk[BY] = -1
        return False
    late = 0
    if strikes(desk, DELAY, train):
        late = between(desk, 10, 600)
    elif strikes(desk, REORDERING, train):
        late = between(desk, 1, 5)
    if late > 0:
        hold_up(memory, desk, kind, train, late)
        desk[BY] = -1
        return False
    if happens(desk, REPETITION):
        hold_up(memory, desk, kind, train, between(desk, 1, 120))
        desk[BY] = -1
    return True


@compiled
def arrive(memory: Any, desk: Any, kind: Any, train: Any) -> Any:
    """Let the telegram in the buffer arrive, as far as the air lets it; tell whether anything changed."""
    return take(memory, desk, kind) if comes(memory, desk, kind, train) else False


@entry
def with_run(memory_at: Any, desk_at: Any, kind: Any) -> Any:
    """Take the word of a train or two persons, under the next run; train and life are in the buffer."""
    memory, desk = both(memory_at, desk_at)
    slots = get(memory, desk, RUNS_COUNT)
    event = desk[EVENT]
    memory[event + 3] = next_run(memory, desk, memory[event], memory[event + 1], desk[STANDING])
    return take_granting(memory, desk, kind, slots)


@compiled
def arrive_with_run(memory: Any, desk: Any, kind: Any, train: Any) -> Any:
    """The same for such a word that may get lost on its way."""
    memory[desk[EVENT] + 3] = 0
    return with_run(memory, desk, kind) if comes(memory, desk, kind, train) else False


@entry
def deliver(memory_at: Any, desk_at: Any) -> Any:
    """What is due arrives."""
    memory, desk = both(memory_at, desk_at)
    if desk[DUE] > desk[CLOCK]:
        return 0
    desk[DUE] = NEVER
    for at in range(MOST_LATE):
        late = LATE + at * LATE_WORDS
        if desk[late + _DUE] > desk[CLOCK]:
            desk[DUE] = min(desk[DUE], desk[late + _DUE])
            continue
        kind, event = desk[late + _KIND], desk[EVENT]
        desk[late + _DUE], desk[BY] = NEVER, desk[late + _BY]
        for word in range(of(desk, WORDS, kind)):
            memory[event + word] = desk[late + _WORDS + word]
        if kind in (NOTE_STANDING, NOTE_STATEMENT_CONFIRMED):
            with_run(memory, desk, kind)
            continue
        if kind == OBEY_ORDER:
            memory[event + 3] = get1(memory, desk, TRACK_LIES_VALUE, memory[event + 1])
        take(memory, desk, kind)
    return 0


@compiled
def clear_air(desk: Any) -> None:
    """Nothing is under way."""
    desk[DUE] = NEVER
    for at in range(MOST_LATE):
        desk[LATE + at * LATE_WORDS + _DUE] = NEVER
