"""What compiled code has to know of a site, as tables of numbers in one record: of its leaves, and of events."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterator, Mapping
from typing import Any, get_origin

import numpy as np

from fuzz.compiled.domains import FOREIGN
from fuzz.compiled.memory import HEADER, RUN_FIELDS, Ints, Memory
from fuzz.compiled.native import event_places
from fuzz.compiled.places import Bits, Fields, Place, Rows, Table, Words, spread
from fuzz.jolted.leaves import (
    BLOCKS,
    NOTHING,
    NUMBER,
    REPORT_TYPES,
    ROUTE,
    TYPES,
    Leaf,
    is_below,
    is_beside,
    leaves_of,
    type_of,
)
from fuzz.machines.plausible import MESSAGES
from kernel.machine.centre import NO_ROUTE
from proofs.lift.kinds import Scalar
from proofs.transitions import TRANSITIONS, event_types

HINTS = 256
AS_SENT = 24
"""A message that arrives is one that was sent so many times as often as it would be."""
MOST_AXES, MOST_DIMS, MOST_BELOW, MOST_BESIDE, MOST_WORDS = 5, 6, 24, 12, 16
MOST_NAMES = 1024
SERIALS = 1 << 62
FEW_NUMBERS = 2
"""Numbers of an event are compared with one another only: two of them give every answer."""
"""A type without bound."""
GRANTING = ("request", "note_standing", "note_statement_confirmed")
"""Kinds of events that bring a new run."""


def tables_of(memory: Memory, pool: int, seeds: int, samples: tuple[int, int], found: int) -> dict[str, Any]:
    """Every table of a site that is laid out, by name; there is room for so many states of each sort.

    ``samples``: of each kind so many events that changed nothing, and so many that did, are kept for comparison.
    """
    leaves = leaves_of(memory)
    known = {leaf.array.name: at for at, leaf in enumerate(leaves)}
    arrays, (low, high) = memory.arrays, memory.bounds()
    site, names = memory.site, memory.domains.numbers
    return {
        **_of_leaves(leaves),
        **_events(memory),
        **_room(memory, pool, seeds, found),
        "samples": np.array(samples, np.int64),
        "hints": _hints(memory, leaves),
        "sizes": _sizes(memory),
        "own_record": _numbers(memory, "Tag", "Record", site.records.record, names["Record"][FOREIGN]),
        "train_of": _numbers(memory, "Car", "Train", site.formation.train_of, 0),
        "run_fields": np.array([memory.runs[name].base for name, _ in RUN_FIELDS], np.int64),
        "run_types": np.array([TYPES.index(kind.name) for _, kind in RUN_FIELDS], np.int64),
        "at": known["track_at_value"],
        "occupied": known["units_occupied"],
        "runs_count": memory.runs_count.base,
        "event": memory.event.base,
        "newest": arrays["centre_newest"].base,
        "epoch": arrays["centre_epoch"].base,
        "reports": arrays["radio_tail_reports"].base,
        "reports_count": arrays["radio_tail_reports_count"].base,
        "reports_part": arrays["radio_tail_reports"].part,
        "grown": HEADER.index("grown"),
        "shrunk": HEADER.index("shrunk"),
        "log": memory.log,
        "state_begin": low,
        "state_end": high,
        "no_route": names["Route"][str(NO_ROUTE)],
        "last_serial": int(site.layout.last_serial),
    }


def record_of(tables: Mapping[str, Any]) -> Any:
    """The same as one record, for compiled code: no layout makes its type another."""
    made = np.zeros(1, [(name, np.int64, np.shape(value)) for name, value in tables.items()])
    for name, value in tables.items():
        made[0][name] = value
    return made


def _of_leaves(leaves: list[Leaf]) -> dict[str, Ints]:
    """A row of each table for each leaf."""
    rows = {name: np.zeros((len(leaves), wide), np.int64) for name, wide in _WIDE.items()}
    for at, leaf in enumerate(leaves):
        _fill(rows, at, leaf)
    below, below_count = _related(leaves, MOST_BELOW, is_below)
    beside, beside_count = _related(leaves, MOST_BESIDE, is_beside)
    columns = {
        "base": [leaf.array.base for leaf in leaves],
        "part": [leaf.array.part for leaf in leaves],
        "axes": [len(leaf.types) for leaf in leaves],
        "dims": [len(leaf.array.shape) for leaf in leaves],
        "other": [leaf.other.base if leaf.other else NOTHING for leaf in leaves],
        **{name: [int(getattr(leaf, name)) for leaf in leaves] for name in _COPIED},
    }
    related = {"below": below, "below_count": below_count, "beside": beside, "beside_count": beside_count}
    return rows | related | {name: np.array(column, np.int64) for name, column in columns.items()}


_COPIED = ("bit", "above", "value", "none", "other_value", "is_keys")


_WIDE = {
    "types": MOST_AXES,
    "strides": MOST_AXES,
    "shape": MOST_DIMS,
    "axis_of": MOST_DIMS,
}


def _fill(rows: dict[str, Ints], at: int, leaf: Leaf) -> None:
    shape = leaf.array.shape
    strides = [int(np.prod(shape[dim + 1 :], dtype=np.int64)) for dim in range(len(shape))]
    rows["types"][at, : len(leaf.types)] = leaf.types
    rows["shape"][at, : len(shape)] = shape
    rows["axis_of"][at, : len(leaf.axis_of)] = leaf.axis_of
    for dim, axis in enumerate(leaf.axis_of):
        rows["strides"][at, axis] = strides[dim]


def _related(leaves: list[Leaf], most: int, related: Callable[[list[Leaf], int, int], bool]) -> tuple[Ints, Ints]:
    found = np.zeros((len(leaves), most), np.int64)
    counts = np.zeros(len(leaves), np.int64)
    for keys, leaf in enumerate(leaves):
        these = [at for at in range(len(leaves)) if leaf.is_keys and related(leaves, at, keys)]
        found[keys, : len(these)] = these
        counts[keys] = len(these)
    return found, counts


def _sizes(memory: Memory) -> Ints:
    """How many values each type has."""
    sizes = np.full(len(TYPES), SERIALS, np.int64)
    for scalar in _scalars(memory.state):
        for _, part in spread(scalar):
            if part.name != "Serial":
                sizes[TYPES.index(part.name)] = memory.domains.size(part)
    for transition in range(len(TRANSITIONS)):
        for place in event_places(memory, transition).values():
            for scalar in _scalars(place):
                for _, part in spread(scalar):
                    if part.name != "int":
                        sizes[TYPES.index(part.name)] = memory.domains.size(part)
    sizes[NUMBER] = FEW_NUMBERS
    sizes[ROUTE] = len(memory.domains.names["Route"])
    return sizes


def _scalars(place: Place) -> Iterator[Scalar]:
    match place:
        case Words(kind, _, _):
            yield kind
        case Fields(_, places):
            for each in places.values():
                yield from _scalars(each)
        case Bits(scalars, _, _) | Rows(scalars, _, _):
            yield from scalars
        case Table(keys, value, _):
            yield from keys.scalars
            yield from _scalars(value)


def _numbers(memory: Memory, key: str, value: str, known: Any, other: int) -> Ints:
    numbers = memory.domains.numbers
    assert len(memory.domains.names[key]) < MOST_NAMES, key
    found = np.full(MOST_NAMES, other, np.int64)
    for one, each in known.items():
        found[numbers[key][one]] = numbers[value][each]
    return found


def _events(memory: Memory) -> dict[str, Ints]:
    kinds = len(TRANSITIONS)
    words, types = np.zeros(kinds, np.int64), np.zeros((kinds, MOST_WORDS), np.int64)
    grants = np.zeros(kinds, np.int64)
    for kind, transition in enumerate(TRANSITIONS):
        row: list[int] = []
        for name, place in event_places(memory, kind).items():
            match place:
                case Words(scalar, _, _):
                    row.extend(type_of(part) for _, part in spread(scalar))
                case Bits(_, _, array):
                    assert get_origin(event_types(transition)[name]) is frozenset
                    row.extend([BLOCKS] * array.shape[-1])
                case Fields(_, below):
                    row.extend(type_of(each.kind) for each in below.values() if isinstance(each, Words))
                case _:
                    raise TypeError(f"{transition.__name__}: {name}")
        words[kind], types[kind, : len(row)] = len(row), row
        grants[kind] = transition.__name__ in GRANTING
    return {"event_words": words, "event_types": types, "grants": grants}


def _hints(memory: Memory, leaves: list[Leaf]) -> Ints:
    """For each kind of event the leaves whose facts fill its words, the more words the more often.

    Behind the leaves' numbers is that of the list of reports.
    """
    said = [(*leaf.types, *_said_beside(leaves, at)) if leaf.bit >= 0 else () for at, leaf in enumerate(leaves)]
    said.append(REPORT_TYPES)
    names = [leaf.array.name for leaf in leaves] + ["radio_tail_reports"]
    found = np.zeros((len(TRANSITIONS), HINTS), np.int64)
    words = _events(memory)
    for kind, transition in enumerate(TRANSITIONS):
        event = Counter(int(each) for each in words["event_types"][kind, : words["event_words"][kind]])
        arriving = f"radio_{MESSAGES[transition.__name__][0]}" if transition.__name__ in MESSAGES else ""
        weights = [(event & Counter(types)).total() ** 2 for types in said]
        weights = [weight * (1 + AS_SENT * (names[at] == arriving)) for at, weight in enumerate(weights)]
        ends = np.cumsum(weights) * HINTS / max(1, sum(weights))
        found[kind] = np.minimum(np.searchsorted(ends, np.arange(HINTS), side="right"), len(leaves))
    return found


def _said_beside(leaves: list[Leaf], keys: int) -> tuple[int, ...]:
    """The types of the scalars beside a key."""
    beside = [leaf for at, leaf in enumerate(leaves) if leaves[keys].is_keys and is_beside(leaves, at, keys)]
    return tuple(each for leaf in beside for each in (leaf.value, leaf.other_value) if each != NOTHING)


def _room(memory: Memory, pool: int, seeds: int, found: int) -> dict[str, int]:
    """Where everything is that is kept behind the kernel's memory."""
    end, entries = memory.bounds()[1], memory.words
    sizes = {"before": end, "kept": end, "journal": entries, "trail": entries}
    sizes |= {"pool": pool * end, "seeds": seeds * end, "found": found * end}
    room, at = {"pool_count": pool, "seed_count": seeds}, memory.words
    for name, size in sizes.items():
        room[name] = at
        at += size
    return room | {"words": at}
