"""The search finds, for every axiom, exactly the layouts that break it, and says by what."""

from __future__ import annotations

import importlib.util
import random
import sys
from collections.abc import Callable, Mapping
from dataclasses import fields, replace
from pathlib import Path
from types import ModuleType
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import models.axioms
from kernel.layout import Layout
from kernel.names import Block
from models.ground import Ground
from models.layouts import Imported, check, load
from models.layouts.axiom_code import axioms_of, compile_axiom
from models.layouts.checker import compiled_axioms, explain
from tests.layouts.stations import SAMPLES

BASE = load(next(path for path in SAMPLES if path.stem == "junction"))
NAMES = [axiom.__name__ for axiom in axioms_of(models.axioms)]


def holds(axiom: Callable[[Layout, Ground], bool], imported: Imported) -> bool:
    try:
        return axiom(imported.layout, imported.ground)
    except LookupError:
        return False


def mutated(value: Any, chance: random.Random) -> Any:
    """A value with one thing in it dropped, doubled or exchanged."""
    if isinstance(value, Mapping) and value:
        key = chance.choice(sorted(value))
        changed = dict(value)
        if chance.random() < 0.3:
            del changed[key]
        elif chance.random() < 0.3:
            changed[key] = value[chance.choice(sorted(value))]
        else:
            changed[key] = mutated(value[key], chance)
        return changed
    if isinstance(value, frozenset):
        every = sorted(BASE.layout.blocks | BASE.layout.points)
        return (
            value - {chance.choice(sorted(value))}
            if value and chance.random() < 0.5
            else value | {chance.choice(every)}
        )
    if isinstance(value, str):
        return chance.choice(sorted(BASE.layout.blocks | BASE.layout.points | frozenset(BASE.layout.tag_in)))
    return value


def planted(seed: int) -> Imported:
    """The base with one random change in one field of layout or ground."""
    chance = random.Random(seed)
    whole, name = chance.choice(
        [("layout", f.name) for f in fields(Layout)] + [("ground", f.name) for f in fields(Ground)]
    )
    part: Any = getattr(BASE, whole)
    changed = replace(part, **{name: mutated(getattr(part, name), chance)})
    return replace(BASE, layout=changed) if whole == "layout" else replace(BASE, ground=changed)


@settings(max_examples=300, deadline=None)
@given(st.integers(0, 10**9))
def test_search_agrees_with_the_predicate(seed: int) -> None:
    imported = planted(seed)
    for axiom, compiled in zip(axioms_of(models.axioms), compiled_axioms(), strict=True):
        failures, _ = compiled.failures(imported.layout, imported.ground)
        assert bool(failures) != holds(axiom, imported), compiled.name
        for failure in failures:
            violation = explain(imported, compiled, failure)
            assert violation.text.isprintable()


def test_a_planted_violation_is_found_for_every_axiom() -> None:
    seen: set[str] = set()
    for seed in range(6000):
        seen |= {violation.axiom for violation in check(planted(seed)).violations}
        if seen >= set(NAMES):
            break
    assert set(NAMES) <= seen, f"never violated: {set(NAMES) - seen}"


def test_good_layouts_break_nothing_and_every_axiom_is_looked_at() -> None:
    result = check(BASE)
    assert result.verdict == "holds"
    assert list(result.checked) == NAMES


def test_every_violation_is_told_and_not_only_the_first() -> None:
    layout = BASE.layout
    wrong = replace(layout, destination=dict.fromkeys(layout.destination, next(iter(layout.start.values()))))
    found = [v for v in check(replace(BASE, layout=wrong)).violations if v.axiom == "a_destination_is_covered"]
    start = next(iter(layout.start.values()))
    assert len(found) == sum(start not in layout.covers[route] for route in layout.routes)
    assert {v.elements[0] for v in found} == {route for route in layout.routes if start not in layout.covers[route]}


AXIOMS = '''
def conjunction(layout, ground):
    """Both."""
    return all(b in layout.points_in and layout.points_in[b] == frozenset() for b in layout.blocks)

def nested(layout, ground):
    """Nested loops with conditions."""
    return all(all(b != c for c in layout.fouls if c > b) for b in layout.blocks if b != "x") and len(layout.fouls) < 0

def branches(layout, ground):
    """One side or the other."""
    return all(b in layout.points_in if b == "x" else b in layout.fouls for b in layout.blocks)

def either(layout, ground):
    """A way out, or both."""
    return all(b == "x" or b == "y" or (b in layout.fouls and b in layout.fouls[b]) for b in layout.blocks)

def steps(layout, ground):
    """A name for a part."""
    blocks = layout.blocks
    return all(b in layout.fouls for b in blocks)

def other_form(layout, ground):
    """Not of the known form."""
    for b in layout.blocks:
        if b not in layout.fouls:
            return False
    return True

def helper(one):
    return True

def _private(layout, ground):
    return False
'''


@pytest.fixture(scope="module")
def strange(tmp_path_factory: pytest.TempPathFactory) -> ModuleType:
    """A module of axioms in every form."""
    file: Path = tmp_path_factory.mktemp("axioms") / "strange_axioms.py"
    file.write_text(AXIOMS)
    spec = importlib.util.spec_from_file_location("strange_axioms", file)
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    sys.modules["strange_axioms"] = module
    spec.loader.exec_module(module)
    return module


def test_every_form_of_axiom_is_searched(strange: ModuleType) -> None:
    axioms = axioms_of(strange)
    assert [a.__name__ for a in axioms] == ["conjunction", "nested", "branches", "either", "steps", "other_form"]
    x, y, z = Block("x"), Block("y"), Block("z")
    layout = replace(BASE.layout, blocks=frozenset({x, y, z}), points_in={x: frozenset()}, fouls={})
    counts = {}
    for axiom in axioms:
        failures, _ = compile_axiom(axiom).failures(layout, BASE.ground)
        counts[axiom.__name__] = [(f.part.source, dict(f.bindings), f.missing) for f in failures]
        assert bool(failures) != holds(axiom, replace(BASE, layout=layout))
    assert sorted(b["b"] for _, b, _ in counts["conjunction"]) == ["y", "z"]
    assert counts["nested"] == [("len(layout.fouls) < 0", {}, False)]
    assert sorted(b["b"] for _, b, _ in counts["branches"]) == ["y", "z"]
    assert counts["either"] == [("b in layout.fouls", {"b": "z"}, False)]
    assert len(counts["steps"]) == 3
    assert counts["other_form"] == [("other_form(layout, ground)", {}, False)]
