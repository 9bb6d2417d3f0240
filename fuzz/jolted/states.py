"""Jolts: a state is changed in a few places, and stands if every invariant still holds."""

from __future__ import annotations

from typing import Any

from fuzz.jolted.compiling import compiled
from fuzz.jolted.leaves import (
    EPOCH,
    RECORD,
    ROUTE,
    RUN,
    SERIAL,
    TERMINAL_LIFE,
    UNIT_LIFE,
)
from fuzz.jolted.words import (
    JOURNAL_COUNT,
    REPORT,
    REPORT_WORDS,
    SAID_COUNT,
    address,
    any_fact,
    below,
    clear_below,
    is_there,
    is_under_keys,
    judged,
    let_stand,
    load_index,
    put,
    say_fact,
    take_back,
)

MOST_REPORTS = 64
"""A state with so many reports gets no more of them by a jolt."""
FEW_LIVES = 4
FACTS_OF_A_CAST = 3
RUN_WORDS = 4
(JOLTS, LANDED, EVENTS, CHANGED, ROUNDS, WALKED) = range(6)
"""What is counted."""


@compiled
def any_of(t: Any, w: Any, m: Any, kind: Any) -> Any:
    """Some value of a type; numbers are small ones, or near the state's own."""
    if kind == RUN:
        return below(w, max(1, m[t.runs_count]))
    if kind == SERIAL:
        if below(w, 32) == 0:
            return t.last_serial - below(w, 2)
        return max(0, m[t.newest] + 1 - below(w, 4)) if below(w, 2) == 0 else below(w, 8)
    if kind == EPOCH:
        return min(t.sizes[EPOCH] - 1, max(0, m[t.epoch] + 1 - below(w, 3)))
    if kind in (UNIT_LIFE, TERMINAL_LIFE):
        return below(w, FEW_LIVES)
    return below(w, t.sizes[kind])


@compiled
def draw_cast(t: Any, w: Any, m: Any) -> None:
    """Two values of each type, some of them those of facts: who takes part in what happens next."""
    for kind in range(len(t.sizes)):
        w.cast[kind, 0], w.cast[kind, 1] = any_of(t, w, m, kind), any_of(t, w, m, kind)
    for _ in range(FACTS_OF_A_CAST):
        if say_fact(t, w, m, below(w, len(t.base) + 1)):
            for at in range(w.numbers[SAID_COUNT]):
                w.cast[w.said[at, 0], below(w, 2)] = w.said[at, 1]


@compiled
def value(t: Any, w: Any, m: Any, kind: Any) -> Any:
    """A value of a type, of the cast mostly."""
    word = w.cast[kind, below(w, 2)]
    if below(w, 6) == 0 or (kind == RUN and word >= m[t.runs_count]):
        return any_of(t, w, m, kind)
    return word


@compiled
def jolt(t: Any, w: Any, m: Any) -> Any:
    """Change a few things; tell whether that was let stand."""
    draw_cast(t, w, m)
    w.counts[JOLTS] += 1
    for _ in range(1 + below(w, 1 << below(w, 4))):
        _edit(t, w, m)
    if w.numbers[JOURNAL_COUNT] == 0:
        return False
    if judged(t, w, m) >= 0:
        take_back(t, w, m)
        return False
    let_stand(t, w, m)
    w.counts[LANDED] += 1
    return True


@compiled
def _edit(t: Any, w: Any, m: Any) -> None:
    """Change one thing."""
    what = below(w, 24)
    if what == 0:
        _edit_run(t, w, m)
    elif what == 1:
        _edit_reports(t, w, m)
    else:
        leaf = below(w, len(t.base))
        if t.value[leaf] >= 0:
            _edit_scalar(t, w, m, leaf)
        else:
            _edit_set(t, w, m, leaf)


@compiled
def _edit_scalar(t: Any, w: Any, m: Any, leaf: Any) -> None:
    above = t.above[leaf]
    if above >= 0:
        fact = any_fact(w, above)
        if fact < 0:
            return
        load_index(w, fact)
        if not is_under_keys(t, w, m, leaf, w.index):
            return
    put_scalar(t, w, m, leaf)


@compiled
def put_scalar(t: Any, w: Any, m: Any, leaf: Any) -> None:
    """Write some value, or none, at the index."""
    at, part = address(t, leaf, w.index), t.part[leaf]
    nothing = t.none[leaf] >= 0 and below(w, 4) == 0
    put(t, w, m, at, t.none[leaf] if nothing else value(t, w, m, t.value[leaf]), part)
    if t.other[leaf] >= 0:
        word = t.own_record[m[at]] if below(w, 4) != 0 else value(t, w, m, t.other_value[leaf])
        put(t, w, m, at - t.base[leaf] + t.other[leaf], 0 if nothing else word, part)


@compiled
def _edit_set(t: Any, w: Any, m: Any, leaf: Any) -> None:
    """An element or a key less, or one more."""
    above = t.above[leaf]
    known = 0
    if below(w, 2) == 0:
        fact = any_fact(w, leaf)
        if fact < 0:
            return
        load_index(w, fact)
        known = t.axes[leaf]
        if below(w, 4) != 0:
            # The same but for one axis: equal in all else.
            w.index[t.bit[leaf]] = value(t, w, m, t.types[leaf, t.bit[leaf]])
    elif above >= 0:
        fact = any_fact(w, above)
        if fact < 0:
            return
        load_index(w, fact)
        known = t.axes[above]
    for axis in range(known, t.axes[leaf]):
        w.index[axis] = value(t, w, m, t.types[leaf, axis])
    for axis in range(t.axes[leaf]):
        if t.types[leaf, axis] == RUN and w.index[axis] >= m[t.runs_count]:
            return
    if is_under_keys(t, w, m, leaf, w.index):
        _toggle(t, w, m, leaf)


@compiled
def _toggle(t: Any, w: Any, m: Any, leaf: Any) -> None:
    at, bit = address(t, leaf, w.index), 1 << (w.index[t.bit[leaf]] & 63)
    if is_there(t, w, m, leaf, w.index):
        put(t, w, m, at, m[at] & ~bit, t.part[leaf])
        if t.is_keys[leaf] != 0:
            clear_below(t, w, m, leaf, w.index)
        return
    put(t, w, m, at, m[at] | bit, t.part[leaf])
    for each in range(t.below_count[leaf]):
        inner = t.below[leaf, each]
        if t.above[inner] == leaf and t.value[inner] >= 0:
            put_scalar(t, w, m, inner)
        elif t.above[inner] == leaf and t.is_keys[inner] == 0 and below(w, 2) == 0:
            axis = t.axes[leaf]
            w.index[axis] = value(t, w, m, t.types[inner, axis])
            where = address(t, inner, w.index)
            put(t, w, m, where, m[where] | (1 << (w.index[axis] & 63)), t.part[inner])


@compiled
def _edit_reports(t: Any, w: Any, m: Any) -> None:
    """A report less, or one more."""
    count, wide = m[t.reports_count], REPORT_WORDS
    if count > 0 and (count >= MOST_REPORTS or below(w, 2) == 0):
        row, last = t.reports + below(w, count) * wide, t.reports + (count - 1) * wide
        for at in range(wide):
            put(t, w, m, row + at, m[last + at], t.reports_part)
            put(t, w, m, last + at, 0, t.reports_part)
        put(t, w, m, t.reports_count, count - 1, t.reports_part)
        return
    for at in range(wide):
        word = value(t, w, m, REPORT[at])
        if REPORT[at] == RECORD and below(w, 4) != 0:
            word = t.own_record[m[t.reports + count * wide + at - 1]]
        put(t, w, m, t.reports + count * wide + at, word, t.reports_part)
    for row in range(count):
        same = True
        for at in range(wide):
            same &= m[t.reports + row * wide + at] == m[t.reports + count * wide + at]
        if same:
            for at in range(wide):
                put(t, w, m, t.reports + count * wide + at, 0, t.reports_part)
            return
    put(t, w, m, t.reports_count, count + 1, t.reports_part)


@compiled
def _edit_run(t: Any, w: Any, m: Any) -> None:
    """A run is another one wherever it is named, unless there is that one already."""
    if m[t.runs_count] == 0:
        return
    slot, field = w.cast[RUN, 0], below(w, RUN_WORDS)
    if slot >= m[t.runs_count]:
        return
    at = t.run_fields[field] + slot
    old, new = m[at], value(t, w, m, t.run_types[field])
    if t.run_types[field] == ROUTE and below(w, 3) == 0:
        new = t.no_route
    m[at] = new
    other = slot_of(t, w, m, slot)
    m[at] = old
    if other < 0:
        put(t, w, m, at, new, -1)


@compiled
def slot_of(t: Any, w: Any, m: Any, slot: Any) -> Any:
    """Another slot with the same run as this one's, or -1."""
    for other in range(m[t.runs_count]):
        same = other != slot
        for field in range(RUN_WORDS):
            same &= m[t.run_fields[field] + other] == m[t.run_fields[field] + slot]
        if same:
            return other
    return -1
