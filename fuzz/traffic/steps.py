"""Taking a step: the event goes to the compiled kernel, and what came of it is counted and kept."""

from __future__ import annotations

from typing import Any

from fuzz.traffic.compiling import compiled
from fuzz.traffic.entries import both, call, entry
from fuzz.traffic.places import (
    ACCEPTED,
    BASE,
    BROKEN,
    BROKEN_NOW,
    BY,
    CENTRE_NEWEST,
    CENTRE_RUNS,
    CENTRE_RUNS_STAGE,
    ENDED,
    EVENT,
    HITS,
    JUDGE,
    LAYOUT_TAG_LIST_VALUE,
    LOG,
    MEMORY,
    MOST_ACCEPTED,
    MOST_STEPS,
    NOBODY,
    PAIRS,
    REFUSALS,
    RUN_AT,
    RUNS_COUNT,
    RUNS_LIFE,
    RUNS_ROUTE,
    RUNS_SERIAL,
    RUNS_TRAIN,
    SKETCH,
    STATE_HASH,
    STEP,
    STEP_BEYOND,
    STEPS,
    TRAIN,
    TRAIN_AT,
    TRAIN_BY,
    TRAIN_OF,
    TRAIN_WORDS,
    TRAINS,
    TUPLE,
    TYPES,
    VIOLATED,
    WHY,
    WORDS,
)
from fuzz.traffic.tables import IS_CAR, IS_RUN
from fuzz.traffic.words import base, get, get1, has, leading, mixed, of, of2, row

NO_STAGE = 5
"""The event's run is not at the centre, or it has none."""
STAGES = 6
RUN_SLOTS = 64
SPARE_SLOTS = 2
"""So many slots are left when a trace ends: what happens last may need them."""
PAIR_BITS, REGISTER_BITS = 16, 12
LOG_HEAD = 3

(
    GOES_ON,
    STEPS_SPENT,
    LOG_FULL,
    TIME_SPENT,
    NUMBERS_SPENT,
    FALSIFIED,
    TIMETABLE_ENDED,
    NOBODY_ARRIVES,
) = range(8)
"""Why a trace ended."""


@compiled
def end(desk: Any, reason: Any) -> None:
    """End the trace, for the first reason there is."""
    if desk[ENDED] == GOES_ON:
        desk[ENDED] = reason


@compiled
def stage_of(memory: Any, desk: Any, kind: Any) -> Any:
    """How far the centre has come with the event's run."""
    at = of(desk, RUN_AT, kind)
    if at < 0:
        return NO_STAGE
    run = memory[desk[EVENT] + at]
    return get1(memory, desk, CENTRE_RUNS_STAGE, run) if has(memory, desk, CENTRE_RUNS, run) else NO_STAGE


@compiled
def train_of(memory: Any, desk: Any, kind: Any) -> Any:
    """Whose event it is; ``NOBODY`` where it is the centre's, a terminal's or a signaller's."""
    at = of(desk, TRAIN_AT, kind)
    if at < 0:
        return NOBODY
    word, by = memory[desk[EVENT] + at], of(desk, TRAIN_BY, kind)
    if by == IS_RUN:
        word = get1(memory, desk, RUNS_TRAIN, word)
    elif by == IS_CAR:
        word = of(desk, TRAIN_OF, word)
    return word if word < desk[TRAINS] else NOBODY


@compiled
def write_log(memory: Any, desk: Any, kind: Any, beyond: Any) -> None:
    """Keep the event; a run by its four fields, since its slot may be used again."""
    to, event = row(desk, LOG, desk[ACCEPTED]), desk[EVENT]
    desk[to], desk[to + 1], desk[to + 2] = kind, desk[BY], beyond
    to += LOG_HEAD
    for at in range(of(desk, WORDS, kind)):
        word = memory[event + at]
        if of2(desk, TYPES, kind, at) == IS_RUN:
            desk[to] = get1(memory, desk, RUNS_SERIAL, word)
            desk[to + 1] = get1(memory, desk, RUNS_TRAIN, word)
            desk[to + 2] = get1(memory, desk, RUNS_LIFE, word)
            desk[to + 3] = get1(memory, desk, RUNS_ROUTE, word)
            to += 4
        else:
            desk[to] = word
            to += 1


@compiled
def accept(memory: Any, desk: Any, kind: Any, beyond: Any) -> None:
    """The state has changed: keep the event, count the state, ask the oracles."""
    write_log(memory, desk, kind, beyond)
    desk[ACCEPTED] += 1
    spread = mixed(memory[desk[STATE_HASH]])
    register = base(desk, SKETCH) + ((spread >> (64 - REGISTER_BITS)) & ((1 << REGISTER_BITS) - 1))
    desk[register] = max(desk[register], min(leading(spread << REGISTER_BITS), 64 - REGISTER_BITS) + 1)
    if desk[JUDGE] != 0:
        violated = call(desk[JUDGE], (desk[MEMORY],))
        if violated >= 0:
            desk[VIOLATED] = violated
            end(desk, FALSIFIED)
    if desk[ACCEPTED] >= desk[MOST_ACCEPTED]:
        end(desk, LOG_FULL)


@compiled
def note(memory: Any, desk: Any, kind: Any, stage: Any, changed: Any, beyond: Any) -> None:
    """Count what came of a step, by itself and after the last one of the same train."""
    desk[STEPS] += 1
    outcome = desk[REFUSALS] + 1
    if not changed:
        outcome = desk[REFUSALS]
        if desk[WHY] != 0:
            refusal = call(desk[WHY], (desk[MEMORY], kind))
            outcome = desk[REFUSALS] if refusal < 0 else refusal
    found = (kind * STAGES + stage) * (desk[REFUSALS] + 2) + outcome
    desk[base(desk, HITS) + found] += 1
    last = TRAIN + train_of(memory, desk, kind) * TRAIN_WORDS + TUPLE
    pair = (mixed((desk[last] << 20) | found) >> 40) & ((1 << PAIR_BITS) - 1)
    desk[base(desk, PAIRS) + pair] += 1
    desk[last] = found
    if changed:
        accept(memory, desk, kind, beyond)
    desk[BY] = -1
    if desk[STEPS] >= desk[MOST_STEPS]:
        end(desk, STEPS_SPENT)


@entry
def take(memory_at: Any, desk_at: Any, kind: Any) -> Any:
    """Take the event in the buffer as a step of this kind; tell whether anything changed."""
    memory, desk = both(memory_at, desk_at)
    if desk[ENDED] != GOES_ON:
        return False
    stage = stage_of(memory, desk, kind)
    changed = call(desk[STEP], (desk[MEMORY], kind)) == 1
    note(memory, desk, kind, stage, changed, 0)
    return changed


@entry
def take_beyond(memory_at: Any, desk_at: Any, kind: Any) -> Any:
    """The same though assumptions of nature are false; they are noted."""
    memory, desk = both(memory_at, desk_at)
    if desk[ENDED] != GOES_ON:
        return False
    stage = stage_of(memory, desk, kind)
    memory[desk[BROKEN_NOW]] = 0
    changed = call(desk[STEP_BEYOND], (desk[MEMORY], kind)) == 1
    if changed:
        desk[BROKEN] |= memory[desk[BROKEN_NOW]]
    note(memory, desk, kind, stage, changed, 1 if memory[desk[BROKEN_NOW]] != 0 else 0)
    return changed


@compiled
def take1(memory: Any, desk: Any, kind: Any, first: Any) -> Any:
    """Take a step whose event is one word."""
    memory[desk[EVENT]] = first
    return take(memory, desk, kind)


@compiled
def put2(memory: Any, desk: Any, first: Any, second: Any) -> None:
    """Write an event of two words."""
    memory[desk[EVENT]], memory[desk[EVENT] + 1] = first, second


@compiled
def put3(memory: Any, desk: Any, first: Any, second: Any, third: Any) -> None:
    """Write an event of three words."""
    put2(memory, desk, first, second)
    memory[desk[EVENT] + 2] = third


@compiled
def put4(memory: Any, desk: Any, first: Any, second: Any, third: Any, fourth: Any) -> None:
    """Write an event of four words."""
    put3(memory, desk, first, second, third)
    memory[desk[EVENT] + 3] = fourth


@compiled
def put5(memory: Any, desk: Any, first: Any, second: Any, third: Any, fourth: Any, fifth: Any) -> None:
    """Write an event of five words."""
    put4(memory, desk, first, second, third, fourth)
    memory[desk[EVENT] + 4] = fifth


@compiled
def take2(memory: Any, desk: Any, kind: Any, first: Any, second: Any) -> Any:
    """Take a step whose event is two words."""
    put2(memory, desk, first, second)
    return take(memory, desk, kind)


@compiled
def take3(memory: Any, desk: Any, kind: Any, first: Any, second: Any, third: Any) -> Any:
    """Take a step whose event is three words."""
    put3(memory, desk, first, second, third)
    return take(memory, desk, kind)


@compiled
def take4(memory: Any, desk: Any, kind: Any, first: Any, second: Any, third: Any, fourth: Any) -> Any:
    """Take a step whose event is four words."""
    put4(memory, desk, first, second, third, fourth)
    return take(memory, desk, kind)


# ---- runs


@entry
def intern(memory_at: Any, desk_at: Any, serial: Any, train: Any, life: Any, route: Any) -> Any:
    """The slot of a run, the next one where it has none yet; the trace ends before they are spent."""
    memory, desk = both(memory_at, desk_at)
    count = get(memory, desk, RUNS_COUNT)
    for slot in range(count):
        if (
            get1(memory, desk, RUNS_SERIAL, slot) == serial
            and get1(memory, desk, RUNS_TRAIN, slot) == train
            and get1(memory, desk, RUNS_LIFE, slot) == life
            and get1(memory, desk, RUNS_ROUTE, slot) == route
        ):
            return slot
    if count >= RUN_SLOTS - SPARE_SLOTS:
        end(desk, NUMBERS_SPENT)
        return count - 1
    memory[row(desk, RUNS_SERIAL, count)] = serial
    memory[row(desk, RUNS_TRAIN, count)] = train
    memory[row(desk, RUNS_LIFE, count)] = life
    memory[row(desk, RUNS_ROUTE, count)] = route
    memory[base(desk, RUNS_COUNT)] = count + 1
    return count


@compiled
def next_run(memory: Any, desk: Any, train: Any, life: Any, route: Any) -> Any:
    """A run with the next number."""
    return intern(memory, desk, get(memory, desk, CENTRE_NEWEST) + 1, train, life, route)


@compiled
def take_granting(memory: Any, desk: Any, kind: Any, slots: Any) -> Any:
    """Take a step that may grant a run; if it does not, and there were so many slots before it, the run's is free."""
    changed = take(memory, desk, kind)
    if not changed:
        memory[base(desk, RUNS_COUNT)] = slots
    return changed


@compiled
def train_word(desk: Any, train: Any, word: Any) -> Any:
    """A word of a train."""
    return desk[TRAIN + train * TRAIN_WORDS + word]


@compiled
def set_train(desk: Any, train: Any, word: Any, value: Any) -> None:
    """Set a word of a train."""
    desk[TRAIN + train * TRAIN_WORDS + word] = value


@compiled
def route_of(memory: Any, desk: Any, run: Any) -> Any:
    """The route of a run."""
    return get1(memory, desk, RUNS_ROUTE, run)


@compiled
def list_of(memory: Any, desk: Any, run: Any) -> Any:
    """The tag list that the centre sends for a run."""
    return get1(memory, desk, LAYOUT_TAG_LIST_VALUE, route_of(memory, desk, run))


@compiled
def base_of(desk: Any, train: Any) -> Any:
    """The run that a train stands or moves under, or -1."""
    return train_word(desk, train, BASE)
