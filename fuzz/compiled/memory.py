"""One flat memory of words: header, runs, event, state, site, and the log of what a step will write.

Python values are packed into it and read back; :meth:`Memory.view` gives every array by name.
"""

from __future__ import annotations

from collections import namedtuple
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, fields
from typing import Any

import numpy as np
import numpy.typing as npt

from fuzz.compiled.domains import RUN_SLOTS, Domains, bits_of, domains
from fuzz.compiled.places import (
    Array,
    Bits,
    Fields,
    Place,
    Planner,
    Rows,
    Table,
    Words,
    arrays_of,
    lists_of,
    spread,
)
from kernel.centre import Centre, Grant
from kernel.names import Cab, Car, Route, Run, Serial, Train
from kernel.terminal import Terminal
from kernel.unit import Order, Unit
from models.world.state import Formation, Radio, Site, System, Track
from proofs.lift.kinds import Kind, MapKind, RecordKind, Scalar, TupleKind, fields_of, kind_of_type

Ints = npt.NDArray[np.int64]
HEADER = ("broken", "grown", "shrunk", "state_hash", "log_count", "accepted")
"""Words at the beginning: assumptions broken by the last step; parts of the state that have got something, and that
have lost something, since they were last judged (what is no set does both); the hash of the state; how many entries
the log has; how many steps changed something."""
ALL_PARTS = -1
HEADER_WORDS = 16
WORD_BITS = 64
EVENT_WORDS = 64
SELDOM_SENT = frozenset(
    (
        *("relayed_orders", "enquiries", "relayed_enquiries", "confirmed", "challenges", "terminal_lives"),
        *("statements", "confirmed_statements", "echoes", "recalls", "returns", "stops"),
    )
)
"""Messages that are one part together."""
SELDOM_WRITTEN = frozenset(("begun", "slipping", "stood", "first_erred", "second_erred", "parted"))
"""What of the track seldom changes, which is one part together."""
PARTS: tuple[str, ...] = (
    *(f"centre_{field.name}" for field in fields(Centre)),
    *(f"centre_runs_{field.name}" for field in fields(Grant)),
    *("units", *(f"units_{field.name}" for field in fields(Unit))),
    *(f"units_orders_{field.name}" for field in fields(Order)),
    *("terminals", *(f"terminals_{field.name}" for field in fields(Terminal))),
    *("radio", *(f"radio_{field.name}" for field in fields(Radio) if field.name not in SELDOM_SENT)),
    *("track", *(f"track_{field.name}" for field in fields(Track) if field.name not in SELDOM_WRITTEN)),
)
"""The parts of a state; a set of them is one word."""
assert len(PARTS) <= WORD_BITS
RUN_FIELDS = tuple((name, kind) for name, kind in fields_of(Run).items() if isinstance(kind, Scalar))
BY_ROUTE = TupleKind((kind_of_type(Route), kind_of_type(Train)))
FORMATION: Mapping[str, Kind] = {
    "train_of": fields_of(Formation)["train_of"],
    "cab": fields_of(Formation)["cab"],
    "carried_by": fields_of(Formation)["carried_by"],
    "front": MapKind(BY_ROUTE, kind_of_type(Cab)),
    "last": MapKind(BY_ROUTE, kind_of_type(Car)),
    "ahead": MapKind(BY_ROUTE, MapKind(kind_of_type(Car), kind_of_type(frozenset[Car]))),
}
"""What a formation says of a run follows from its route and its train."""
OF_A_RUN = ("front", "last", "ahead")
"""The same as names: looked up by a run."""
KEYS = np.array([-7046029254386353131, -4417276706812531889, -8796714831421723037], dtype=np.int64)
"""Odd numbers that spread a word and its address over the hash (splitmix64)."""


@dataclass(frozen=True)
class Memory:
    """Where everything of one site is."""

    site: Site
    domains: Domains
    runs: Mapping[str, Array]
    runs_count: Array
    event: Array
    state: Place
    fixed: Mapping[str, Place]
    arrays: Mapping[str, Array]
    log: int
    words: int
    image: Ints

    def new(self) -> Ints:
        """A memory with the site in it and an empty state."""
        return self.image.copy()

    def view(self, memory: Ints) -> Any:
        """Every array of a memory, by name."""
        shown = {name: _at(memory, array) for name, array in self.arrays.items()}
        return _view(tuple(shown))(*shown.values())

    def pack(self, memory: Ints, system: System, runs: Iterable[Run]) -> None:
        """Write a state; ``runs``: every run in it, each in its slot, in order."""
        low, high = self.bounds()
        memory[low:high] = 0
        known = list(runs)
        self.pack_runs(memory, known)
        Packing(self, memory, {run: slot for slot, run in enumerate(known)}).put(self.state, (), system)
        memory[HEADER.index("state_hash")] = self.hash(memory)

    def pack_runs(self, memory: Ints, runs: list[Run]) -> None:
        """Write the table of runs."""
        assert len(runs) <= RUN_SLOTS, "too many runs"
        for name, kind in RUN_FIELDS:
            row = _at(memory, self.runs[name])
            row[: len(runs)] = [self.domains.number(kind, getattr(run, name)) for run in runs]
        _at(memory, self.runs_count)[0] = len(runs)

    def runs_in(self, memory: Ints) -> list[Run]:
        """The runs told apart so far, each in its slot."""
        count = int(_at(memory, self.runs_count)[0])
        rows = {name: _at(memory, self.runs[name]) for name, _ in RUN_FIELDS}
        name_of = self.domains.name
        return [Run(*(name_of(kind, int(rows[name][at])) for name, kind in RUN_FIELDS)) for at in range(count)]

    def unpack(self, memory: Ints) -> System:
        """Read a state back."""
        system: System = _Unpacking(self, memory, self.runs_in(memory)).value(RecordKind(System), self.state, ())
        return system

    def bounds(self) -> tuple[int, int]:
        """Where the state begins and ends."""
        arrays = list(arrays_of(self.state))
        return arrays[0].base, arrays[-1].base + arrays[-1].size

    def hash(self, memory: Ints) -> int:
        """The hash of the state: a sum over its words, so that a step can carry it on."""
        low, high = self.bounds()
        at = np.flatnonzero(memory[low:high]) + low
        return int(mixed(at.astype(np.int64), memory[at]).sum(dtype=np.int64))

    def final_hash(self, memory: Ints) -> int:
        """The hash of the state whatever order its lists have grown in: equal states have equal ones."""
        settled = memory[: self.bounds()[1]].copy()
        for place in lists_of(self.state):
            rows = _at(settled, place.array)
            rows[:] = rows[np.lexsort(rows.T)]
        return self.hash(settled)


def mixed(address: Ints, word: Ints) -> Ints:
    """What a word other than zero adds to the hash."""
    with np.errstate(over="ignore"):
        value = word * KEYS[0] + address * KEYS[1]
        value = (value ^ (value.view(np.uint64) >> np.uint64(29)).view(np.int64)) * KEYS[2]
        return np.asarray(value ^ (value.view(np.uint64) >> np.uint64(32)).view(np.int64))


def lay_out(site: Site) -> Memory:
    """Lay out a site."""
    known = domains(site)
    plan = Planner(known, HEADER_WORDS, PARTS)
    header = {name: Array(name, at, (1,), -1) for at, name in enumerate(HEADER)}
    runs = {name: plan.array(f"runs_{name}", (RUN_SLOTS + 1,)) for name, _ in RUN_FIELDS}
    count, event = plan.array("runs_count", (1,)), plan.array("event", (EVENT_WORDS,))
    state = _system(plan)
    state_words = plan.next
    formation = _formation(site, known)
    fixed: dict[str, Place] = {}
    for name, kind, value in _fixed(site, formation):
        fixed[name] = plan.place(kind, name, data=[value])
    log = plan.next
    words = log + 6 * state_words
    image = np.zeros(words, np.int64)
    made = Memory(site, known, runs, count, event, state, fixed, header | plan.arrays, log, words, image)
    packing = Packing(made, image, {})
    for name, _, value in _fixed(site, formation):
        packing.put(fixed[name], (), value)
    return made


def _system(plan: Planner) -> Place:
    """A state: the parts' names have no ``system`` before them."""
    places = {name: plan.place(kind, name) for name, kind in fields_of(System).items()}
    return Fields(System, places)


def _fixed(site: Site, formation: Mapping[str, Any]) -> Iterator[tuple[str, Kind, Any]]:
    for name in ("layout", "lists", "plan", "records", "ground"):
        value = getattr(site, name)
        yield name, RecordKind(type(value)), value
    for name, kind in FORMATION.items():
        yield f"formation_{name}", kind, formation[name]


def _formation(site: Site, known: Domains) -> dict[str, Any]:
    """The formation, what it says of runs by their routes and trains."""
    formation = site.formation
    made: dict[str, Any] = {name: {} if name in OF_A_RUN else getattr(formation, name) for name in FORMATION}
    for route in known.names["Route"]:
        for train in known.names["Train"]:
            run = Run(Serial(0), Train(train), 0, Route(route))  # type: ignore[arg-type]
            for name in OF_A_RUN:
                table = getattr(formation, name)
                if run in table:
                    made[name][route, train] = table[run]
    return made


def _at(memory: Ints, array: Array) -> Ints:
    return memory[array.base : array.base + array.size].reshape(array.shape)


_VIEWS: dict[tuple[str, ...], Any] = {}


def _view(names: tuple[str, ...]) -> Any:
    """One class for the same names, since compiled code tells classes apart."""
    if names not in _VIEWS:
        _VIEWS[names] = namedtuple("View", names)
    return _VIEWS[names]


class Packing:
    """Writes Python values."""

    def __init__(self, memory: Memory, words: Ints, slots: Mapping[Run, int]) -> None:
        self.memory, self.words, self.slots, self.nodes = memory, words, slots, dict[str, int]()

    def numbers(self, scalar: Scalar, value: Any) -> list[int]:
        """The words of a scalar."""
        if scalar.source is Run:
            return [self.slots[value]]
        parts = spread(scalar)
        if len(parts) == 1:
            return [self.memory.domains.number(scalar, value)]
        return [self.memory.domains.number(part, getattr(value, name[1:])) for name, part in parts]

    def put(self, place: Place, at: tuple[int, ...], value: Any) -> None:
        """Write a value."""
        match place:
            case Words(kind, arrays, none):
                numbers = [none or 0, *[0] * len(arrays)] if value is None else self.numbers(kind, value)
                for array, number in zip(arrays, numbers, strict=False):
                    _at(self.words, array)[at or (0,)] = number
            case Fields(_, places):
                for name, each in places.items():
                    self.put(each, at, getattr(value, name))
            case Bits():
                for element in value:
                    self.put_bit(place, at, element)
            case Rows(scalars, array, count):
                rows = sorted(_flat(self, scalars, element) for element in value)
                for row, numbers in enumerate(rows):
                    _at(self.words, array)[(*at, row)] = numbers
                _at(self.words, count)[at or (0,)] = len(rows)
            case Table(keys, inner, node):
                for key, each in value.items():
                    self.put_bit(keys, at, key)
                    below = (*at, *self.key(keys, key))
                    if node is not None:
                        self.nodes[node.name] = self.nodes.get(node.name, 0) + 1
                        _at(self.words, node)[below] = self.nodes[node.name]
                        below = (self.nodes[node.name],)
                    self.put(inner, below, each)

    def key(self, keys: Bits, key: Any) -> tuple[int, ...]:
        """The numbers of a key, one for each axis of its values."""
        parts = key if len(keys.scalars) > 1 else (key,)
        return tuple(self.numbers(scalar, part)[0] for scalar, part in zip(keys.scalars, parts, strict=True))

    def put_bit(self, bits: Bits, at: tuple[int, ...], element: Any) -> None:
        """Write an element of a set."""
        numbers = self.key(bits, element)
        *outer, last = (numbers[axis] for axis in bits.order)
        row = _at(self.words, bits.array)
        row[(*at, *outer, last // 64)] |= np.int64(_signed(1 << (last % 64)))


def _flat(packing: Packing, scalars: tuple[Scalar, ...], element: Any) -> list[int]:
    return [word for scalar, part in zip(scalars, element, strict=True) for word in packing.numbers(scalar, part)]


def _signed(word: int) -> int:
    return word - (1 << 64) if word >> 63 else word


class _Unpacking:
    """Reads Python values."""

    def __init__(self, memory: Memory, words: Ints, runs: list[Run]) -> None:
        self.memory, self.words, self.runs = memory, words, runs

    def scalar(self, kind: Scalar, numbers: list[int]) -> Any:
        """The value that some words stand for."""
        if kind.source is Run:
            return self.runs[numbers[0]]
        parts = spread(kind)
        if len(parts) == 1:
            return self.memory.domains.name(kind, numbers[0])
        return kind.source(
            *(self.memory.domains.name(part, number) for (_, part), number in zip(parts, numbers, strict=True))
        )

    def value(self, kind: Kind, place: Place, at: tuple[int, ...]) -> Any:
        """Read a value."""
        match place:
            case Words(scalar, arrays, none):
                numbers = [int(_at(self.words, array)[at or (0,)]) for array in arrays]
                return None if none is not None and numbers[0] == none else self.scalar(scalar, numbers)
            case Fields(cls, places):
                kinds = fields_of(cls)
                return cls(**{name: self.value(kinds[name], each, at) for name, each in places.items()})
            case Bits():
                return frozenset(self.element(place, numbers) for numbers in self.members(place, at))
            case Rows(scalars, array, count):
                rows = _at(self.words, array)[at][: int(_at(self.words, count)[at or (0,)])]
                return frozenset(self.row(scalars, [int(word) for word in row]) for row in rows)
            case Table(keys, inner, _):
                assert isinstance(kind, MapKind)
                return {
                    self.element(keys, numbers): self.value(kind.value, inner, (*at, *numbers))
                    for numbers in self.members(keys, at)
                }

    def members(self, bits: Bits, at: tuple[int, ...]) -> Iterator[tuple[int, ...]]:
        """The numbers of every element of a set."""
        rows = _at(self.words, bits.array)[at]
        for found in np.argwhere(rows):
            *outer, word = (int(each) for each in found)
            for last in bits_of(int(rows[tuple(found)]), 64 * word):
                numbers = dict(zip(bits.order, (*outer, last), strict=True))
                yield tuple(numbers[axis] for axis in range(len(bits.order)))

    def element(self, bits: Bits, numbers: tuple[int, ...]) -> Any:
        """An element, or a key, from its numbers."""
        parts = tuple(self.scalar(kind, [number]) for kind, number in zip(bits.scalars, numbers, strict=True))
        return parts if len(parts) > 1 else parts[0]

    def row(self, scalars: tuple[Scalar, ...], numbers: list[int]) -> Any:
        """An element of a list from its words."""
        parts = []
        for kind in scalars:
            width = len(spread(kind))
            parts.append(self.scalar(kind, numbers[:width]))
            numbers = numbers[width:]
        return tuple(parts)
