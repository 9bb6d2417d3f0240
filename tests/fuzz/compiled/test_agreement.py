"""Compiled and run by CPython, the same source does the same: every step, every refusal, every invariant."""

from __future__ import annotations

import inspect
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import fields, replace
from functools import cache
from random import Random
from typing import Any

import pytest

from fuzz.compiled.memory import ALL_PARTS, HEADER
from fuzz.compiled.native import ASSUMED, REFUSED, Native, native
from fuzz.compiled.places import Array, Bits, Fields, Place, Table, arrays_of
from fuzz.compiled.refusals import REFUSALS
from kernel.names import Position, Read, Run
from models.layouts import load
from models.simulator.journey import Chances
from models.simulator.traffic import Traffic, Troubles, traffic_on
from models.world import assumptions
from models.world.state import System
from proofs.catalogue import INVARIANTS
from proofs.lift.kinds import Kind, MapKind, OptionKind, RecordKind, Scalar, SetKind, TupleKind, fields_of, kind_of_type
from proofs.transitions import TRANSITIONS, event_types
from proofs.witnesses.scenario import WHY_REFUSED
from tests.layouts.stations import ROOT

STATIONS = {"passing_station": 2, "terminus": 2, "junction": 3}
KINDS = {transition.__name__: kind for kind, transition in enumerate(TRANSITIONS)}
CHANCES = Chances(loss=0.2, missed_tag=0.05, cancelled=0.1, withdrawn=0.05, slips=0.1)
TROUBLES = Troubles(0.002, 0.004, 0.004, 0.003, 0.003, 0.05, 0.002)
SLOTS = 56
"""Traffic ends when so many runs have been met: a second more may bring a few."""
ABSURD_EVENTS = 1_200
SPOILT_STATES = 60
FEW = (1, 2)
CHANGED = [HEADER.index(way) for way in ("grown", "shrunk")]


@cache
def compiled(name: str) -> Native:
    """The machine code of a station."""
    return native(traffic(name, 0).play.site)


def traffic(name: str, seed: int) -> Traffic:
    """Traffic with every trouble on a sample layout."""
    imported = load(ROOT / "layouts" / f"{name}.toml")
    return traffic_on(imported, seed, CHANCES, TROUBLES, STATIONS[name])


class Beside:
    """A memory moved on beside CPython: both see every event, and must say and become the same."""

    def __init__(self, code: Native, system: System, runs: Iterable[Run] = ()) -> None:
        self.code, self.memory = code, code.memory.new()
        self.runs = {run: slot for slot, run in enumerate(runs)}
        self.steps = self.changed = 0
        code.memory.pack(self.memory, system, self.runs)

    def know(self, event: Mapping[str, Any]) -> None:
        """Give every run in an event its slot."""
        for value in event.values():
            if isinstance(value, Run):
                self.runs.setdefault(value, len(self.runs))
        self.code.memory.pack_runs(self.memory, list(self.runs))

    def take(self, site: Any, before: System, step: str, event: Mapping[str, Any]) -> System:
        """Take a step in both."""
        kind = KINDS[step]
        after = TRANSITIONS[kind](site, before, **event)
        self.code.put_event(self.memory, kind, event, self.runs)
        if step in REFUSALS:
            why = self.code.call("why", self.memory, kind)
            assert (REFUSED[why] if why >= 0 else None) == REFUSALS[step](site, before, **event), f"{step}({event})"
        changed = self.code.call("step", self.memory, kind)
        assert bool(changed) == (after != before), f"{step}({event}) changed something in one of the two"
        self.steps, self.changed = self.steps + 1, self.changed + changed
        return after

    def compare(self, system: System) -> None:
        """The memory stands for this state, word by word."""
        assert self.code.memory.unpack(self.memory) == system
        assert self.code.memory.hash(self.memory) == self.memory[HEADER.index("state_hash")]
        packed = self.code.memory.new()
        self.code.memory.pack(packed, system, list(self.runs))
        assert self.code.memory.final_hash(packed) == self.code.memory.final_hash(self.memory)


@pytest.mark.sampled(6)
@pytest.mark.parametrize("name", STATIONS)
@pytest.mark.parametrize("seed", FEW)
def test_traffic_goes_the_same_way_compiled(name: str, seed: int) -> None:
    played = traffic(name, seed)
    play, beside = played.play, Beside(compiled(name), played.play.system)
    original = play.take

    def take(step: str, **event: Any) -> bool:
        before = play.system
        beside.know(event)
        original(step, **event)
        assert beside.take(play.site, before, step, event) == play.system
        return bool(play.system != before)

    play.take = take  # type: ignore[method-assign]
    while len(beside.runs) < SLOTS:
        played.run(1)
        beside.compare(play.system)
        assert beside.code.call("judge", beside.memory) == -1
    assert beside.changed > 300
    assert beside.steps > beside.changed


# ---- events that nobody would send, and states that cannot be


class Drawing:
    """Draws any value of a kind, of the identifiers that a station has and the runs given."""

    def __init__(self, code: Native, runs: list[Run], random: Random) -> None:
        self.names, self.runs, self.random = code.memory.domains.names, runs, random

    def scalar(self, kind: Scalar) -> Any:
        """Any value."""
        random = self.random
        if kind.source is Run:
            return random.choice(self.runs)
        if kind.source is Read:
            return Read(random.choice(self.names["Tag"]), random.choice(self.names["Record"]))  # type: ignore[arg-type]
        if kind.source is int:
            return random.randint(-2, 2)
        if kind.source is bool:
            return random.random() < 0.5
        if kind.is_enum:
            return random.choice(list(kind.source))
        return random.randint(0, 5) if kind.is_ordered else random.choice(self.names[kind.name])

    def value(self, kind: Kind) -> Any:
        """Any value; sets and maps are small."""
        match kind:
            case Scalar():
                return self.scalar(kind)
            case OptionKind(inner):
                return None if self.random.random() < 0.3 else self.value(inner)
            case TupleKind(items):
                return tuple(self.value(item) for item in items)
            case SetKind(element):
                return frozenset(self.value(element) for _ in range(self.random.randint(0, 3)))
            case MapKind(key, inner):
                return {self.value(key): self.value(inner) for _ in range(self.random.randint(0, 3))}
            case RecordKind(cls):
                return cls(**{name: self.value(part) for name, part in fields_of(cls).items()})

    def spoilt(self, kind: Kind, value: Any) -> Any:
        """The same value with one thing other, somewhere in it."""
        match kind:
            case RecordKind(cls):
                name = self.random.choice([field.name for field in fields(cls)])
                return replace(value, **{name: self.spoilt(fields_of(cls)[name], getattr(value, name))})
            case MapKind(key, inner) if value and self.random.random() < 0.7:
                one = self.random.choice(sorted(value, key=repr))
                if self.random.random() < 0.3:
                    return {other: part for other, part in value.items() if other != one}
                return value | {one: self.spoilt(inner, value[one])}
            case MapKind(key, inner):
                return value | {self.value(key): self.value(inner)}
            case SetKind(element):
                return value ^ {self.value(element)}
            case _:
                return self.value(kind)


def states(name: str, seed: int, count: int) -> Iterator[tuple[Traffic, System, list[Run]]]:
    """States along traffic, with the runs in them."""
    played = traffic(name, seed)
    runs: dict[Run, None] = {}
    played.play.watch = lambda step, event, system: runs.update(
        {value: None for value in event.values() if isinstance(value, Run)}
    )
    while len(runs) < SLOTS and count > 0:
        played.run(15)
        if runs:
            count -= 1
            yield played, played.play.system, list(runs)


@pytest.mark.sampled(3)
@pytest.mark.parametrize("name", STATIONS)
def test_any_event_in_any_state_is_taken_the_same_way(name: str) -> None:
    code, random, changed = compiled(name), Random(3), 0
    for played, system, runs in states(name, 5, 40):
        drawing = Drawing(code, runs, random)
        for _ in range(ABSURD_EVENTS // 40):
            kind = random.randrange(len(TRANSITIONS))
            beside = Beside(code, system, runs)
            step = TRANSITIONS[kind].__name__
            event = {each: drawing.value(kind_of_type(of)) for each, of in event_types(TRANSITIONS[kind]).items()}
            after = beside.take(played.play.site, system, step, event)
            beside.compare(after)
            changed += after != system
    assert changed > 50


@pytest.mark.sampled(3)
@pytest.mark.parametrize("name", STATIONS)
def test_each_invariant_says_the_same_of_states_that_cannot_be(name: str) -> None:
    code, random = compiled(name), Random(4)
    said: dict[str, set[bool]] = {claim: set() for claim in INVARIANTS}
    for played, system, runs in states(name, 6, SPOILT_STATES):
        drawing = Drawing(code, runs, random)
        for _ in range(6):
            spoilt = drawing.spoilt(RecordKind(System), drawing.spoilt(RecordKind(System), system))
            memory = code.memory.new()
            code.memory.pack(memory, spoilt, runs)
            for at, (claim, holds) in enumerate(INVARIANTS.items()):
                try:
                    expected = holds(played.play.site, spoilt)
                except (KeyError, AttributeError):
                    continue  # a lookup that only the other invariants make safe
                assert bool(code.call(f"holds_{at}", memory)) == expected, f"{claim} of {spoilt}"
                said[claim].add(expected)
    both_ways = [claim for claim, answers in said.items() if answers == {True, False}]
    assert len(both_ways) > 0.6 * len(INVARIANTS), sorted(set(said) - set(both_ways))
    assert all(True in answers for answers in said.values())


@pytest.mark.sampled(3)
@pytest.mark.parametrize("name", STATIONS)
def test_whatever_falsifies_an_invariant_has_it_asked(name: str) -> None:
    """Of a set's bits only what has grown, or what has shrunk, has to have an invariant asked that was true before."""
    code, random, falsified = compiled(name), Random(5), Counter[str]()
    sets = {each.name for each in _sets_of(code.memory.state)}
    arrays = [array for array in arrays_of(code.memory.state) if array.part >= 0]
    for _, system, runs in states(name, 9, SPOILT_STATES):
        drawing = Drawing(code, runs, random)
        before, after = code.memory.new(), code.memory.new()
        code.memory.pack(before, system, runs)
        for _ in range(10):
            code.memory.pack(after, drawing.spoilt(RecordKind(System), system), runs)
            done = {"grown": 0, "shrunk": 0}
            for array in arrays:
                old, new = (words[array.base : array.base + array.size] for words in (before, after))
                differs, is_set = bool((old != new).any()), array.name in sets
                done["grown"] |= (bool((new & ~old).any()) if is_set else differs) << array.part
                done["shrunk"] |= (bool((old & ~new).any()) if is_set else differs) << array.part
            for at, claim in enumerate(INVARIANTS):
                if not code.call(f"holds_{at}", after):
                    asked_when = code.asked_when[claim]
                    assert any(done[way] & asked_when[way] for way in done), f"{claim} would not be asked"
                    falsified[claim] += 1
    assert len(falsified) > 0.5 * len(INVARIANTS), falsified


def _sets_of(place: Place) -> Iterator[Array]:
    match place:
        case Bits():
            yield place.array
        case Fields():
            for each in place.places.values():
                yield from _sets_of(each)
        case Table():
            yield place.keys.array
            yield from _sets_of(place.value)


def test_the_judge_names_the_first_invariant_that_a_change_broke() -> None:
    code = compiled("passing_station")
    played, system, runs = list(states("passing_station", 7, 30))[-1]
    memory = code.memory.new()
    code.memory.pack(memory, system, runs)
    memory[CHANGED] = ALL_PARTS
    assert code.call("judge", memory) == -1
    assert not memory[CHANGED].any()
    cars = sorted(system.track.at)
    together = replace(system, track=replace(system.track, at=dict.fromkeys(cars, system.track.at[cars[0]])))
    code.memory.pack(memory, together, runs)
    assert code.call("judge", memory) == -1, "nothing has changed since it was last asked"
    memory[CHANGED] = ALL_PARTS
    broken = [claim for claim, holds in INVARIANTS.items() if not holds(played.play.site, together)]
    assert list(INVARIANTS)[code.call("judge", memory)] == broken[0]


def test_a_step_beyond_nature_names_the_assumption_and_is_taken() -> None:
    code = compiled("passing_station")
    played, system, runs = list(states("passing_station", 8, 30))[-1]
    point = sorted(system.track.lies)[0]
    lies = system.track.lies[point]
    other = next(each for each in code.memory.domains.names["Position"] if each != lies)
    terminal = replace(system.terminals[point], wanted=Position(other), unlocked=True)
    waiting = replace(system, terminals=system.terminals | {point: terminal})
    beside = Beside(code, waiting, runs)
    event = {"point": point, "detected": other, "is_detected": True}
    assert beside.take(played.play.site, waiting, "lock", event) == waiting
    code.put_event(beside.memory, KINDS["lock"], event, beside.runs)
    assert code.call("step_beyond", beside.memory, KINDS["lock"]) == 1
    broken = int(beside.memory[HEADER.index("broken")])
    assert [name for at, name in enumerate(ASSUMED) if broken >> at & 1] == ["detection_is_true"]
    locked = code.memory.unpack(beside.memory)
    assert not locked.terminals[point].unlocked


WORDS = {"is_genuine", "is_last"}
"""What assumptions and history are both said in; no assumptions themselves."""


def test_every_assumption_that_a_transition_asks_is_noted() -> None:
    listed = {name for name in vars(assumptions) if callable(getattr(assumptions, name)) and name in _asked()}
    assert listed - WORDS == set(ASSUMED)


def test_every_transition_that_gives_reasons_is_asked_for_them() -> None:
    assert set(REFUSALS) == set(WHY_REFUSED)


def _asked() -> set[str]:
    """What the world's transitions call of the assumptions."""
    modules = {inspect.getmodule(transition) for transition in TRANSITIONS}
    names = {
        name for name, value in vars(assumptions).items() if getattr(value, "__module__", "") == assumptions.__name__
    }
    return {name for module in modules for name in names if hasattr(module, name)}
