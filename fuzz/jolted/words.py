"""Reading and writing the packed state by leaf and index; what is written is noted, so that it can be taken back.

Functions have three arguments in common: ``t``, the tables; ``w``, the record of what is written beside states; and
``m``, one array of words.  It begins with the memory of the compiled kernel.  Behind that are copies of the state:
``before`` the event being tried, and ``kept``, gone back to; then the ``journal``, where the memory differs from
``before``, and the ``trail``, where that differs from ``kept``; then pools of states.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from fuzz.compiled.memory import ALL_PARTS
from fuzz.compiled.native import REFUSED
from fuzz.jolted.compiling import compiled
from fuzz.jolted.leaves import REPORT_TYPES, RUN, TYPES
from fuzz.jolted.tables import MOST_AXES, MOST_WORDS
from fuzz.traffic.entries import call
from fuzz.traffic.words import lowest, mixed, plus
from proofs.catalogue import INVARIANTS
from proofs.transitions import TRANSITIONS

REPORT = np.array(REPORT_TYPES)
REPORT_WORDS = len(REPORT_TYPES)
GOLDEN = 0x9E3779B97F4A7C15 - (1 << 64)
LOW_32 = (1 << 32) - 1
NOWHERE = -1
LOG_WORDS = 3
(RANDOM, JOURNAL_COUNT, TRAIL_COUNT, FACT_COUNT, SAID_COUNT, FALSE_COUNT, SHARE) = range(7)
NOT_CHANGED, CHANGED_SOMETHING, REFUSED_FROM = range(3)
"""What came of an event: nothing, and no refusal says why; something; or, from here on, the number of a refusal."""
OUTCOMES = REFUSED_FROM + len(REFUSED)
(MEMORY_AT, STEP, JUDGE, WHY) = range(4)


MOST_FACTS, MOST_SAID, MOST_FOCUS = 4096, 48, 40
MOST_FALSE = 24
"""Of events that make an invariant false so many are kept."""
MOST_FOUND = 512
WORK = np.dtype(
    [
        ("numbers", np.int64, 8),
        ("calls", np.int64, 4),
        ("facts", np.int64, (MOST_FACTS, MOST_AXES + 1)),
        ("first_fact", np.int64, 256),
        ("said", np.int64, (MOST_SAID, 2)),
        ("cast", np.int64, (len(TYPES), 2)),
        ("index", np.int64, MOST_AXES + 1),
        ("filled", np.int64, MOST_WORDS),
        ("focus", np.int64, MOST_FOCUS),
        ("counts", np.int64, 8),
        ("hits", np.int64, (len(TRANSITIONS), OUTCOMES)),
        ("sampled", np.int64, (len(TRANSITIONS), 2)),
        ("seen", np.int64, (len(TRANSITIONS), len(INVARIANTS))),
        ("found", np.int64, (MOST_FOUND + 1, 2)),
    ]
)
"""What is written beside the states, as one record: see the names above."""


# ---- drawing


@compiled
def below(w: Any, bound: Any) -> Any:
    """Draw a number from 0 up to, and without, ``bound``."""
    w.numbers[RANDOM] = plus(w.numbers[RANDOM], GOLDEN)
    return (((mixed(w.numbers[RANDOM]) >> 32) & LOW_32) * bound) >> 32


# ---- places


@compiled
def address(t: Any, leaf: Any, index: Any) -> Any:
    """Where the word of an index is."""
    at = t.base[leaf]
    for axis in range(t.axes[leaf]):
        if axis == t.bit[leaf]:
            at += index[axis] >> 6
        else:
            at += index[axis] * t.strides[leaf, axis]
    return at


@compiled
def is_there(t: Any, w: Any, m: Any, leaf: Any, index: Any) -> Any:
    """Whether a set has an element, or a map a key."""
    return (m[address(t, leaf, index)] >> (index[t.bit[leaf]] & 63)) & 1 == 1


@compiled
def is_under_keys(t: Any, w: Any, m: Any, leaf: Any, index: Any) -> Any:
    """Whether all maps above a leaf have their keys."""
    above = t.above[leaf]
    while above >= 0:
        if not is_there(t, w, m, above, index):
            return False
        above = t.above[above]
    return True


@compiled
def put(t: Any, w: Any, m: Any, at: Any, word: Any, part: Any) -> None:
    """Write a word, and note that; ``part``: of the state, all of it if negative."""
    if m[at] == word:
        return
    m[t.journal + w.numbers[JOURNAL_COUNT]] = at
    w.numbers[JOURNAL_COUNT] += 1
    m[at] = word
    if part < 0:
        m[t.grown] = m[t.shrunk] = ALL_PARTS
    else:
        m[t.grown] |= 1 << part
        m[t.shrunk] |= 1 << part


@compiled
def clear_below(t: Any, w: Any, m: Any, keys: Any, index: Any) -> None:
    """Nothing is left of what a map said of a key: zero throughout."""
    last = t.axes[keys] - 1
    for each in range(t.below_count[keys]):
        leaf = t.below[keys, each]
        begin = t.base[leaf]
        for axis in range(last + 1):
            begin += index[axis] * t.strides[leaf, axis]
        words = t.strides[leaf, last]
        for at in range(begin, begin + words):
            put(t, w, m, at, 0, t.part[leaf])
        if t.other[leaf] >= 0:
            for at in range(begin, begin + words):
                put(t, w, m, at - t.base[leaf] + t.other[leaf], 0, t.part[leaf])


# ---- taking back, and letting stand


@compiled
def note_step(t: Any, w: Any, m: Any) -> None:
    """What the kernel has written belongs into the journal.

    A step leaves its log behind and not how long it is: what is read of it is struck out for the next one.
    """
    log = t.log
    while m[log] != NOWHERE:
        m[t.journal + w.numbers[JOURNAL_COUNT]] = m[log]
        w.numbers[JOURNAL_COUNT] += 1
        m[log] = NOWHERE
        log += LOG_WORDS


@compiled
def take_back(t: Any, w: Any, m: Any) -> None:
    """Everything in the journal is as before."""
    for entry in range(w.numbers[JOURNAL_COUNT]):
        at = m[t.journal + entry]
        m[at] = m[t.before + at]
    w.numbers[JOURNAL_COUNT] = 0
    m[t.grown] = m[t.shrunk] = 0


@compiled
def let_stand(t: Any, w: Any, m: Any) -> None:
    """The next event begins here."""
    for entry in range(w.numbers[JOURNAL_COUNT]):
        at = m[t.journal + entry]
        m[t.before + at] = m[at]
        m[t.trail + w.numbers[TRAIL_COUNT]] = at
        w.numbers[TRAIL_COUNT] += 1
    w.numbers[JOURNAL_COUNT] = 0
    m[t.grown] = m[t.shrunk] = 0


@compiled
def keep(t: Any, w: Any, m: Any) -> None:
    """What stands is gone back to from now on."""
    for entry in range(w.numbers[TRAIL_COUNT]):
        at = m[t.trail + entry]
        m[t.kept + at] = m[t.before + at]
    w.numbers[TRAIL_COUNT] = 0


@compiled
def go_back(t: Any, w: Any, m: Any) -> None:
    """Go back to the state that was kept; nothing is in the journal."""
    for entry in range(w.numbers[TRAIL_COUNT]):
        at = m[t.trail + entry]
        m[t.before + at] = m[t.kept + at]
        m[at] = m[t.kept + at]
    w.numbers[TRAIL_COUNT] = 0


@compiled
def begin(t: Any, w: Any, m: Any, state: Any) -> None:
    """Go to a state of the pool."""
    for at in range(t.state_end):
        word = m[state + at]
        m[at] = word
        m[t.before + at] = word
        m[t.kept + at] = word
    m[t.grown] = m[t.shrunk] = 0
    w.numbers[JOURNAL_COUNT] = 0
    w.numbers[TRAIL_COUNT] = 0


@compiled
def judged(t: Any, w: Any, m: Any) -> Any:
    """The number of an invariant that is false of what has changed, or -1."""
    return call(w.calls[JUDGE], (w.calls[MEMORY_AT],))


# ---- facts: every element of every set, every key of every map, and every report


@compiled
def read_facts(t: Any, w: Any, m: Any) -> None:
    """Write down where everything is that a state has."""
    count = 0
    leaves = len(t.base)
    for leaf in range(leaves):
        w.first_fact[leaf] = count
        if t.bit[leaf] >= 0:
            count = _facts_of(t, w, m, leaf, count)
    w.first_fact[leaves] = count
    for row in range(m[t.reports_count]):
        if count < len(w.facts):
            w.facts[count, 0] = row
            count += 1
    w.first_fact[leaves + 1] = count
    w.numbers[FACT_COUNT] = count


@compiled
def _facts_of(t: Any, w: Any, m: Any, leaf: Any, count: Any) -> Any:
    """Those of one set."""
    dims = t.dims[leaf]
    size = 1
    for dim in range(dims):
        size *= t.shape[leaf, dim]
    for place in range(size):
        word = m[t.base[leaf] + place]
        while word != 0 and count < len(w.facts):
            bit = lowest(word)
            word &= word - 1
            rest = place
            for back in range(dims):
                dim = dims - 1 - back
                number = rest % t.shape[leaf, dim]
                rest //= t.shape[leaf, dim]
                w.facts[count, t.axis_of[leaf, dim]] = number * 64 + bit if dim == dims - 1 else number
            count += 1
    return count


@compiled
def any_fact(w: Any, leaf: Any) -> Any:
    """The number of some fact of a leaf, or -1."""
    first = w.first_fact[leaf]
    many = w.first_fact[leaf + 1] - first
    return NOWHERE if many <= 0 else first + below(w, many)


@compiled
def load_index(w: Any, fact: Any) -> None:
    """Have the index of a fact."""
    for axis in range(MOST_AXES):
        w.index[axis] = w.facts[fact, axis]


@compiled
def _say(t: Any, w: Any, m: Any, kind: Any, value: Any) -> None:
    """Say a value; a run that was gone back from is none any more."""
    if kind == RUN and value >= m[t.runs_count]:
        return
    count = w.numbers[SAID_COUNT]
    w.said[count, 0], w.said[count, 1] = kind, value
    w.numbers[SAID_COUNT] = count + 1


@compiled
def say_fact(t: Any, w: Any, m: Any, leaf: Any) -> Any:
    """Draw a fact of a leaf, if it has any, and say all that belongs to it: types and values."""
    w.numbers[SAID_COUNT] = 0
    leaves = len(t.base)
    fact = any_fact(w, leaf)
    if fact < 0:
        return False
    if leaf == leaves:
        row = w.facts[fact, 0]
        for at in range(REPORT_WORDS):
            _say(t, w, m, REPORT[at], m[t.reports + row * REPORT_WORDS + at])
        return True
    load_index(w, fact)
    for axis in range(t.axes[leaf]):
        _say(t, w, m, t.types[leaf, axis], w.index[axis])
    if is_there(t, w, m, leaf, w.index):
        for each in range(t.beside_count[leaf]):
            _say_scalar(t, w, m, t.beside[leaf, each])
    return True


@compiled
def _say_scalar(t: Any, w: Any, m: Any, leaf: Any) -> None:
    at = address(t, leaf, w.index)
    if m[at] != t.none[leaf]:
        _say(t, w, m, t.value[leaf], m[at])
        if t.other[leaf] >= 0:
            _say(t, w, m, t.other_value[leaf], m[at - t.base[leaf] + t.other[leaf]])
