"""The alarm's machines, with their maps, do the same compiled as in CPython; and a wrong compilation is noticed."""

from __future__ import annotations

import ast
import dataclasses
import sys
import typing
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import cache
from pathlib import Path
from random import Random
from types import ModuleType, SimpleNamespace
from typing import Any
from unittest.mock import patch

import numba
import pytest
from numba.core.errors import NumbaError

from kernel.alarm import distance, network, sections, tone, train_list
from models.compiled import NotCompilable, compile_machines, loops, maps, packed, unpacked
from models.compiled import machines as rewriting
from models.compiled.records import is_map, is_name, is_set
from tests.onboard.agree import Draw, functions, types_of

MODULES = (distance, network, sections, tone, train_list)
FUNCTIONS = {f"{each.__name__}.{name}": (each, name) for each in MODULES for name in functions(each)}
SAMPLES = 400


class Drawn(Draw):
    """Draws maps, sets and names as well; numbers are often equal, or apart by one, and never leave 64 bits."""

    def value(self, type_: Any, whole: Callable[[], int] | None = None) -> Any:
        """Draw a value; names are small numbers, so that they are found in maps."""
        if is_name(type_):
            return self._random.randrange(5)
        of = typing.get_args(type_)
        if is_map(type_):
            return {self.value(of[0]): self.value(of[1], whole) for _ in range(self._random.randrange(5))}
        if is_set(type_):
            return frozenset(self.value(of[0], whole) for _ in range(self._random.randrange(5)))
        return super().value(type_, whole)

    def small(self) -> int:
        """Draw an int such that the product of two fits, often near another, often one of a few."""
        kind = self._random.random()
        if kind < 0.4 and self._near:
            found = self._random.choice(self._near) + self._random.choice((-1, 0, 0, 1))
        elif kind < 0.6:
            found = self._random.choice((0, 1, 3_600_000, 3_600_001, 100_000, 1_500_000, 3_000_000, 10**9))
        else:
            found = self._random.getrandbits(self._random.choice((3, 12, 22, 28)))
        found = max(-(2**30), min(2**30, -found if self._random.random() < 0.1 else found))
        self._near.append(found)
        return found


@cache
def compiled(module: ModuleType) -> SimpleNamespace:
    """A module compiled."""
    found: SimpleNamespace = getattr(compile_machines([module]), module.__name__.rpartition(".")[2])
    return found


def disagreements(module: ModuleType, made: SimpleNamespace, name: str, samples: int = SAMPLES) -> list[str]:
    """The drawn arguments for which a compiled function gives another value, or another exception."""
    function, (types, result) = functions(module)[name], types_of(functions(module)[name])
    draw = Drawn(Random(name), module)
    found = []
    for _ in range(samples):
        draw.begin()
        arguments = [draw.value(type_, draw.small) for type_ in types.values()]
        given = [packed(argument, type_) for argument, type_ in zip(arguments, types.values(), strict=True)]
        expected = function(*arguments)
        after = unpacked(getattr(made, name)(*given), result)
        if after != expected:
            found.append(f"{name}{arguments}: {expected}, compiled {after}")
    return found


@pytest.mark.parametrize("name", FUNCTIONS)
def test_cpython_and_compiled_agree(name: str) -> None:
    module, function = FUNCTIONS[name]
    assert disagreements(module, compiled(module), function) == []


def test_every_tone_is_compared() -> None:
    draw, (types, _) = Drawn(Random("tone"), tone), types_of(tone.tone)
    seen = set()
    for _ in range(SAMPLES):
        draw.begin()
        seen.add(tone.tone(*(draw.value(type_, draw.small) for type_ in types.values())))
    assert {tone.Tone.ALARM, tone.Tone.FAULT} <= seen


# ---- a toy with one of every construct


TOY = """
from __future__ import annotations
from dataclasses import dataclass, replace
from typing import NewType
from kernel.maps import Map
Name = NewType("Name", str)

@dataclass(frozen=True)
class Shelf:
    cups: Map[Name, int]
    cracked: frozenset[Name]

def sound(shelf: Shelf, least: int) -> bool:
    return all(size >= least for name, size in shelf.cups.items() if name not in shelf.cracked)

def any_pair(shelf: Shelf, other: Shelf, by: int) -> bool:
    return any(
        any(size + by == one for _name, one in other.cups.items()) for name, size in shelf.cups.items() if name != by
    )

def poured(shelf: Shelf, name: Name, size: int) -> Shelf:
    if name in shelf.cups:
        return replace(shelf, cups=shelf.cups | {name: shelf.cups[name] + size})
    return replace(shelf, cups=shelf.cups | {name: size})

def sorted_out(shelf: Shelf, least: int) -> Shelf:
    return replace(shelf, cups={name: size - least for name, size in shelf.cups.items() if size >= least})

def level(shelf: Shelf, name: Name, place: int) -> int:
    return (1, 10, 100)[place % 3] + (shelf.cups[name] if name in shelf.cups else 0)
"""


@contextmanager
def imported(module: ModuleType) -> Iterator[None]:
    """Let a module be found by its name; what else is imported meanwhile stays."""
    sys.modules[module.__name__] = module
    yield
    sys.modules.pop(module.__name__, None)


def toy(path: Path, source: str = TOY) -> ModuleType:
    path.write_text(source, "utf-8")
    module = ModuleType("tests.toy")
    module.__file__ = str(path)
    with imported(module):
        exec(compile(source, str(path), "exec"), vars(module))
    return module


def compiled_toy(module: ModuleType) -> SimpleNamespace:
    with imported(module):
        found: SimpleNamespace = compile_machines([module]).toy
    return found


@pytest.mark.parametrize("name", ["sound", "any_pair", "poured", "sorted_out", "level"])
def test_every_construct_agrees(name: str, tmp_path: Path) -> None:
    module = toy(tmp_path / "toy.py")
    with imported(module):
        assert disagreements(module, compiled_toy(module), name, 1_000) == []


def test_a_key_that_is_not_there_is_an_error_as_in_cpython(tmp_path: Path) -> None:
    module = toy(tmp_path / "toy.py", TOY + "\ndef at(shelf: Shelf, name: Name) -> int:\n    return shelf.cups[name]\n")
    with imported(module):
        made, shelf = compiled_toy(module), packed(module.Shelf({1: 7}, frozenset()))
    assert made.at(shelf, 1) == 7
    with pytest.raises(KeyError):
        made.at(shelf, 0)


LOOP = loops.Loop.function


def without_condition(self: loops.Loop, name: str, free: Any) -> ast.FunctionDef:
    return LOOP(loops.Loop(self.kind, self.names, [], self.each), name, free)


def any_for_all(self: loops.Loop, name: str, free: Any) -> ast.FunctionDef:
    return LOOP(
        loops.Loop("any" if self.kind == "all" else self.kind, self.names, self.conditions, self.each), name, free
    )


def key_for_value(self: loops.Loop, name: str, free: Any) -> ast.FunctionDef:
    return LOOP(loops.Loop(self.kind, self.names[::-1], self.conditions, self.each), name, free)


COMPARE = rewriting.Rewriting.visit_Compare


def not_lost(self: rewriting.Rewriting, node: ast.Compare) -> ast.expr:
    found = COMPARE(self, node)
    return found.operand if isinstance(found, ast.UnaryOp) else found


@numba.njit
def added(container, key, value):  # type: ignore[no-untyped-def]
    made = container.copy()
    made.append((key, value))
    return made


FAULTS: dict[str, tuple[str, Callable[[], Any]]] = {
    "condition lost": ("sorted_out", lambda: patch.object(loops.Loop, "function", without_condition)),
    "all compiled as any": ("sound", lambda: patch.object(loops.Loop, "function", any_for_all)),
    "key and value mixed up": ("sound", lambda: patch.object(loops.Loop, "function", key_for_value)),
    "not in compiled as in": ("sound", lambda: patch.object(rewriting.Rewriting, "visit_Compare", not_lost)),
    "an entry is added and not put in place": ("poured", lambda: patch.object(maps, "with_entry", added)),
}


@pytest.mark.parametrize("fault", FAULTS)
def test_a_wrong_compilation_is_noticed(fault: str, tmp_path: Path) -> None:
    name, change = FAULTS[fault]
    module = toy(tmp_path / "toy.py")
    with imported(module):
        with change():
            wrong = compiled_toy(module)
        with pytest.raises((AssertionError, NumbaError)):
            assert disagreements(module, wrong, name, 1_000) == []


# ---- values and refusals


def test_maps_sets_and_names_come_back_as_they_went() -> None:
    register = tone.Register(
        distance.AlarmBounds(1, 2, 3, 4, 5, 6),
        tone.Freshness(1, 2, 3, 4),
        7,
        8,
        {},
        frozenset({(tone.Train(9), sections.Section(1)), (tone.Train(2), sections.Section(0))}),  # type: ignore[arg-type]
        {},
        {},
        9,
    )
    assert list(packed(register).sections) == []
    assert list(packed(register).stabled) == [(2, 0), (9, 1)]
    assert unpacked(packed(register), tone.Register) == register
    with pytest.raises(TypeError, match="cannot be handed"):
        packed({1: 2})
    with pytest.raises(TypeError, match="'1D' cannot be handed"):
        packed(dataclasses.replace(tone.switched_on(), trains={tone.Train("1D"): tone.NOTHING_KNOWN}))


REFUSED = {
    "two loops": ("return any(x == y for x, y in m.items() for z, _w in m.items())", "more than one for"),
    "keys": ("return any(x > 1 for x in m)", ".items()"),
    "an entry taken whole": ("return any(x == (1, 2) for x in m.items())", "a key and a value"),
    "a list": ("return any([x > 1 for x, _y in m.items()])", "any of what"),
    "other keys": ("return {y: x for x, y in m.items()} == m", "other keys"),
    "two entries": ("return (m | {k: 1, k: 2}) == m", "one entry"),
    "another map": ("return (m | m) == m", "one entry"),
    "a chain": ("return k in m in (m,)", "chain"),
    "a text as a key": ('return "a" in m', "'a'"),
}


@pytest.mark.parametrize("what", REFUSED)
def test_what_is_not_known_is_refused_with_file_and_line(what: str, tmp_path: Path) -> None:
    line, named = REFUSED[what]
    head = "from typing import NewType\nfrom kernel.maps import Map\nK = NewType('K', str)\n"
    module = toy(tmp_path / "toy.py", f"{head}def f(m: Map[K, int], k: K) -> bool:\n    {line}\n")
    with pytest.raises(NotCompilable) as refusal:
        compiled_toy(module)
    assert str(refusal.value).startswith(f"{tmp_path / 'toy.py'}:5: ")
    assert named in str(refusal.value)


def test_what_is_looked_for_where_it_cannot_be_is_refused(tmp_path: Path) -> None:
    source = "from typing import NewType\nfrom kernel.maps import Map\nK = NewType('K', str)\n"
    source += "def f(m: Map[K, int], k: bool) -> bool:\n    return k in m\n"
    module = toy(tmp_path / "toy.py", source)
    types = typing.get_type_hints(module.f)
    with pytest.raises(NumbaError, match="no map, set or tuple"):
        compiled_toy(module).f(packed({1: 2}, types["m"]), True)
