"""The text of an obligation is a function of its cell: whatever was made before, in whatever order, wherever."""

from __future__ import annotations

import json
import os
import random
import subprocess
import sys
from collections.abc import Mapping, Sequence
from pathlib import Path

import pytest

from proofs import run, smtlib
from proofs.lift import UnboundedScope
from proofs.theories import ROWS, columns, theory_of

ROOT = Path(__file__).parents[2]
OF = ("interlocking", "joint", "occupancy", "speed_limit", "display", "tag_fix", "alarm_distance")
"""Theories that are quantified, and some that are not; several rows of each name their events alike."""
Cell = tuple[str, str]


def sample(size: int) -> list[Cell]:
    """So many obligations of these theories, drawn once for all."""
    there = [(row, column) for row in ROWS if theory_of(row)[0].name in OF for column in columns(row)]
    return random.Random(4).sample(there, size)


CELLS = sample(36)

HASHED = """
import json, sys
from proofs import run
for row, column in json.loads(sys.argv[1]):
    print(json.dumps([row, column, run.digest_of(run.parts(row, column))]))
"""


def hashes_elsewhere(cells: Sequence[Cell], hash_seed: str) -> dict[Cell, str]:
    """The hashes that another process gives, asked for in this order."""
    ended = subprocess.run(
        [sys.executable, "-c", HASHED, json.dumps(cells)],
        capture_output=True,
        text=True,
        cwd=ROOT,
        env={**os.environ, "PYTHONHASHSEED": hash_seed, "PYTHONPATH": str(ROOT)},
        check=True,
    )
    return {(row, column): digest for row, column, digest in map(json.loads, ended.stdout.splitlines())}


@pytest.fixture(scope="module")
def alone() -> dict[Cell, bytes]:
    """The text of each, on a workbench that has lifted nothing else."""
    found = {}
    for row, column in CELLS[:12]:
        run.bench.cache_clear()
        found[row, column] = run.text_of(run.parts(row, column))
    run.bench.cache_clear()
    return found


def test_texts_are_the_same_alone_and_after_each_other_in_any_order(alone: dict[Cell, bytes]) -> None:
    assert any(alone.values())
    after: dict[Cell, bytes] = {}
    for seed in range(2):
        for row, column in random.Random(seed).sample(CELLS, len(CELLS)):
            text = run.text_of(run.parts(row, column))
            assert text == after.setdefault((row, column), text), (seed, row, column)
    assert {cell: after[cell] for cell in alone} == alone


@pytest.mark.parametrize("hash_seed", ["1", "20"])
def test_texts_are_the_same_in_other_processes(hash_seed: str) -> None:
    here = {cell: run.digest_of(run.parts(*cell)) for cell in CELLS}
    shuffled = random.Random(int(hash_seed)).sample(CELLS, len(CELLS))
    assert hashes_elsewhere(shuffled, hash_seed) == here


def test_of_what_always_holds_an_obligation_has_what_speaks_of_its_own_symbols() -> None:
    """All of the bench's orders and normal forms are more than any one needs."""
    left_out = 0
    for row, column in CELLS:
        theory = run.bench(theory_of(row)[0].name)
        for part in run.parts(row, column):
            always = {name: formulas for name, formulas in part.hypotheses.items() if name in theory.always()}
            rest = [formula for name, each in part.hypotheses.items() if name not in always for formula in each]
            symbols = smtlib.symbols_of(*rest, *part.given, part.goal)
            for name, formulas in theory.always().items():
                assert (name in always) == (smtlib.symbols_of(*formulas) <= symbols), (row, column, name)
                left_out += name not in always
    assert left_out


def test_the_record_names_everything_that_is_assumed() -> None:
    for row, column in CELLS:
        asked = run.parts(row, column)
        told = run.settle(row, column, "z3", 0, [], "")
        named = {*told["hypotheses"], *run.axioms_of(row, column, asked)}
        assert {name for part in asked for name in part.hypotheses} <= named, (row, column)


def test_two_events_of_one_name_have_each_their_own_normal_form() -> None:
    scope = UnboundedScope()
    scope.constant(Mapping[int, frozenset[bool]], "event.of")
    first = {named.formula.sexpr() for named in scope.axioms()}
    scope.constant(Mapping[bool, frozenset[int]], "event.of")
    assert len({named.formula.sexpr() for named in scope.axioms()}) == 2 * len(first) == 2
