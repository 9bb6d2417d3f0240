"""Events of every kind in states in which every invariant holds, drawn from what the states have."""

from __future__ import annotations

from typing import Any

from fuzz.jolted.compiling import compiled
from fuzz.jolted.leaves import BLOCK, BLOCKS, CAR, RECORD, ROUTE, RUN, SERIAL, TRAIN, UNIT_LIFE
from fuzz.jolted.states import (
    CHANGED,
    EVENTS,
    ROUNDS,
    RUN_WORDS,
    WALKED,
    any_of,
    draw_cast,
    jolt,
    slot_of,
    value,
)
from fuzz.jolted.tables import HINTS
from fuzz.jolted.words import (
    CHANGED_SOMETHING,
    FALSE_COUNT,
    MEMORY_AT,
    MOST_FALSE,
    NOT_CHANGED,
    NOWHERE,
    REFUSED_FROM,
    SAID_COUNT,
    SHARE,
    STEP,
    WHY,
    begin,
    below,
    go_back,
    judged,
    keep,
    let_stand,
    note_step,
    put,
    read_facts,
    say_fact,
    take_back,
)
from fuzz.traffic.entries import call

JOLTS_A_ROUND = 24
BURSTS = 4
EVENTS_A_BURST = 100
FACTS_OF_AN_EVENT = 4
MOST_RUNS = 40
"""A state with so many runs gets no new ones."""
MOST_REPORTED = 400
MOST_STEPS = 3
"""So many events may follow each other before it is gone back."""
WALKS = 12
"""One event in so many that changed something is not gone back from."""
SAME = 2
"""Of events of one kind that make one invariant false so many are kept."""

WHOLE = 1 << 16
"""Samples are spread over a search: so many parts are the whole of it."""


@compiled
def search(tables: Any, works: Any, m: Any, rounds: Any) -> None:
    """Jolt states and try events in them for so many rounds."""
    t, w = tables[0], works[0]
    for at in range(rounds):
        w.counts[ROUNDS] += 1
        w.numbers[SHARE] = at * WHOLE // rounds
        if below(w, 2) == 0:
            begin(t, w, m, t.seeds + below(w, t.seed_count) * t.state_end)
        else:
            begin(t, w, m, t.pool + below(w, t.pool_count) * t.state_end)
        read_facts(t, w, m)
        landed = 0
        for _ in range(JOLTS_A_ROUND):
            if jolt(t, w, m):
                landed += 1
                if landed % 4 == 0:
                    read_facts(t, w, m)
        keep(t, w, m)
        for _ in range(BURSTS):
            read_facts(t, w, m)
            _burst(t, w, m)
        to = t.pool + below(w, t.pool_count) * t.state_end
        for each in range(t.state_end):
            m[to + each] = m[t.kept + each]


@compiled
def _burst(t: Any, w: Any, m: Any) -> None:
    """Events of a few kinds, in one state and a little around it."""
    kinds = len(t.event_words)
    focus = 1 + below(w, 1 << (1 + below(w, 5)))
    for at in range(focus):
        w.focus[at] = below(w, kinds)
    steps = 0
    for _ in range(EVENTS_A_BURST):
        if _try(t, w, m, w.focus[below(w, focus)]):
            if below(w, WALKS) == 0:
                keep(t, w, m)
                w.counts[WALKED] += 1
                steps = 0
                continue
            steps += 1
        if steps >= MOST_STEPS or (steps > 0 and below(w, 8) == 0):
            go_back(t, w, m)
            steps = 0
    go_back(t, w, m)


@compiled
def _try(t: Any, w: Any, m: Any, kind: Any) -> Any:
    """One event; tell whether it changed something and broke nothing."""
    w.counts[EVENTS] += 1
    if below(w, 4) == 0:
        draw_cast(t, w, m)
    if m[t.reports_count] >= MOST_REPORTED:
        return False
    draw_event(t, w, m, kind)
    m[t.grown] = m[t.shrunk] = 0
    changed = call(w.calls[STEP], (w.calls[MEMORY_AT], kind))
    note_step(t, w, m)
    false = NOWHERE
    if changed == 0:
        why = call(w.calls[WHY], (w.calls[MEMORY_AT], kind))
        w.hits[kind, NOT_CHANGED if why < 0 else REFUSED_FROM + why] += 1
    else:
        w.counts[CHANGED] += 1
        w.hits[kind, CHANGED_SOMETHING] += 1
        false = judged(t, w, m)
    if false >= 0 or _is_sample(t, w, kind, changed):
        _find(t, w, m, kind, false)
    if changed == 0 or false >= 0:
        take_back(t, w, m)
        return False
    let_stand(t, w, m)
    return True


@compiled
def _is_sample(t: Any, w: Any, kind: Any, changed: Any) -> Any:
    """Whether an event is kept for comparison: some of each kind, spread over the search."""
    count, most = w.sampled[kind, changed], t.samples[changed]
    if count >= most or count * WHOLE > w.numbers[SHARE] * most:
        return False
    w.sampled[kind, changed] += 1
    return True


@compiled
def _find(t: Any, w: Any, m: Any, kind: Any, false: Any) -> None:
    """Keep the state before an event, with the event and all its runs."""
    if false >= 0:
        w.seen[kind, false] += 1
        if w.seen[kind, false] > SAME:
            return
        if w.numbers[FALSE_COUNT] >= MOST_FALSE:
            return
        w.numbers[FALSE_COUNT] += 1
    row = w.found[0, 0]
    w.found[0, 0] = row + 1
    w.found[row + 1, 0], w.found[row + 1, 1] = kind, false
    to = t.found + row * t.state_end
    for at in range(t.state_end):
        # The event, and a run that it alone names, stand before the state.
        m[to + at] = m[at] if at < t.state_begin else m[t.before + at]


# ---- drawing an event


@compiled
def draw_event(t: Any, w: Any, m: Any, kind: Any) -> None:
    """Write an event of a kind: from a few facts, and the rest from the cast."""
    words = t.event_words[kind]
    for at in range(words):
        w.filled[at] = 0
    for _ in range(1 + below(w, FACTS_OF_AN_EVENT)):
        if say_fact(t, w, m, t.hints[kind, below(w, HINTS)]):
            _fill_from_fact(t, w, m, kind)
    for at in range(words):
        if w.filled[at] == 0 and t.event_types[kind, at] == RUN:
            m[t.event + at] = value(t, w, m, RUN)
            w.filled[at] = 1
    fresh = below(w, 4) != 0 if t.grants[kind] != 0 else below(w, 16) == 0
    _fill_rest(t, w, m, kind, fresh)
    if fresh:
        _bring_a_run(t, w, m, kind)
    _fill_blocks(t, w, m, kind)


@compiled
def _fill_from_fact(t: Any, w: Any, m: Any, kind: Any) -> None:
    for said in range(w.numbers[SAID_COUNT]):
        for at in range(t.event_words[kind]):
            if w.filled[at] == 0 and t.event_types[kind, at] == w.said[said, 0]:
                m[t.event + at] = w.said[said, 1]
                w.filled[at] = 1
                break


@compiled
def _run_in(t: Any, w: Any, m: Any, kind: Any, first: Any) -> Any:
    """The slot of a run of the event, from this word on, or -1."""
    for at in range(first, t.event_words[kind]):
        if t.event_types[kind, at] == RUN:
            return m[t.event + at]
    return -1


@compiled
def _fill_rest(t: Any, w: Any, m: Any, kind: Any, fresh: Any) -> None:
    run = -1 if fresh else _run_in(t, w, m, kind, 0)
    for at in range(t.event_words[kind]):
        of = t.event_types[kind, at]
        if w.filled[at] != 0 or of == BLOCKS:
            continue
        word = value(t, w, m, of)
        if run >= 0 and of in (TRAIN, UNIT_LIFE) and below(w, 4) != 0:
            word = m[t.run_fields[1 if of == TRAIN else 2] + run]
        elif of == RECORD and at > 0 and below(w, 8) != 0:
            word = t.own_record[m[t.event + at - 1]]
        elif of == UNIT_LIFE and below(w, 4) == 0:
            word = min(t.sizes[UNIT_LIFE] - 1, word + 1)
        m[t.event + at] = word


@compiled
def _bring_a_run(t: Any, w: Any, m: Any, kind: Any) -> None:
    """The event's first run is a new one: of the train and life that it names beside, with the next number mostly."""
    slot = m[t.runs_count]
    if slot >= MOST_RUNS:
        return
    first = -1
    train, life = value(t, w, m, TRAIN), value(t, w, m, UNIT_LIFE)
    for at in range(t.event_words[kind]):
        of, word = t.event_types[kind, at], m[t.event + at]
        if of == RUN and first < 0:
            first = at
        elif of == RUN and word < slot:
            train, life = m[t.run_fields[1] + word], m[t.run_fields[2] + word]
        elif of == TRAIN:
            train = word
        elif of == UNIT_LIFE:
            life = word
    if first < 0:
        return
    serial = m[t.newest] + 1 if below(w, 8) != 0 else any_of(t, w, m, SERIAL)
    if below(w, 16) == 0:
        train = any_of(t, w, m, TRAIN)
    if below(w, 16) == 0:
        life = any_of(t, w, m, UNIT_LIFE)
    route = t.no_route if below(w, 2) == 0 else any_of(t, w, m, ROUTE)
    _note(t, w, m, slot, serial, train, life, route)
    known = slot_of(t, w, m, slot)
    m[t.event + first] = slot if known < 0 else known
    if known < 0:
        put(t, w, m, t.runs_count, slot + 1, 0)


@compiled
def _note(t: Any, w: Any, m: Any, slot: Any, serial: Any, train: Any, life: Any, route: Any) -> None:
    """Write a run into its slot."""
    fields = (serial, train, life, route)
    for field in range(RUN_WORDS):
        put(t, w, m, t.run_fields[field] + slot, fields[field], 0)


@compiled
def _fill_blocks(t: Any, w: Any, m: Any, kind: Any) -> None:
    """Sets of blocks: where the train's cars are, or its unit thinks, mostly; or that with one block other."""
    first, train = -1, -1
    for at in range(t.event_words[kind]):
        if t.event_types[kind, at] == BLOCKS and first < 0:
            first = t.event + at
        elif t.event_types[kind, at] == TRAIN:
            train = m[t.event + at]
    if first < 0:
        return
    words = t.shape[t.at, 1]
    for word in range(words):
        m[first + word] = 0
    way = below(w, 8)
    if way == 0:
        for word in range(words):
            m[first + word] = m[t.base[t.occupied] + train * words + word]
    elif way < 7:
        _fill_where_cars_are(t, w, m, first, train)
    if below(w, 2) == 0:
        block = value(t, w, m, BLOCK)
        m[first + (block >> 6)] ^= 1 << (block & 63)


@compiled
def _fill_where_cars_are(t: Any, w: Any, m: Any, first: Any, train: Any) -> None:
    words = t.shape[t.at, 1]
    for car in range(t.sizes[CAR]):
        if t.train_of[car] == train:
            for word in range(words):
                m[first + word] |= m[t.base[t.at] + car * words + word]
