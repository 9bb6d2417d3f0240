"""Each ordinary day of ``docs/ordinary_days.md`` is simulated, tried and guarded, by the names that stand there."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from pathlib import Path

import pytest

from models.alarm.faults import FAULTS as OF_AN_ALARM
from models.crossing.faults import FAULTS as OF_A_CROSSING
from models.tram.faults import FAULTS as OF_TRAMS
from proofs.planted.changes import changes

ROOT = Path(__file__).parent.parent.parent
DAYS = {
    "Crossing": {fault.name for fault in OF_A_CROSSING},
    "Track-worker alarm": {fault.name for fault in OF_AN_ALARM},
    "Trams": set(OF_TRAMS),
}
CELLS = 6


def rows() -> Iterator[tuple[str, list[str]]]:
    """Give each row with the system that it is of."""
    system = ""
    for line in (ROOT / "docs" / "ordinary_days.md").read_text("utf-8").splitlines():
        system = line.removeprefix("## ") if line.startswith("## ") else system
        cells = [cell.strip() for cell in line.strip("|").split("|")]
        if line.startswith("|") and cells[0] != "what happens" and set(line) - set("|-"):
            yield system, cells


ROWS = list(rows())


def names(cell: str) -> list[str]:
    return re.findall(r"`([^`]+)`", cell)


def test_every_system_has_its_days() -> None:
    assert {system for system, _ in ROWS} == set(DAYS)
    assert all(len(cells) == CELLS for _, cells in ROWS)


@pytest.mark.parametrize(("system", "cells"), ROWS, ids=[cells[0][:40] for _, cells in ROWS])
def test_a_day_is_simulated_tried_and_guarded(system: str, cells: list[str]) -> None:
    _happens, _before, _now, day, test, guards = cells
    assert set(names(day)) <= DAYS[system]
    assert names(day) or day.startswith("none: ")
    (path, function), *others = (name.split("::") for name in names(test))
    tree = ast.parse((ROOT / path).read_text("utf-8"))
    assert not others
    assert function in {each.name for each in tree.body if isinstance(each, ast.FunctionDef)}
    assert names(guards) or guards.startswith("none: ")


@pytest.mark.parametrize("name", [name for _, cells in ROWS for name in names(cells[-1])])
def test_a_guard_is_one_that_a_theorem_misses(name: str) -> None:
    change = changes()[name]
    assert (change.witness, change.harmless, change.unproved) == ("", "", "")
