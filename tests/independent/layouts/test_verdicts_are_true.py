"""A layout that ``heisoku check`` says holds leads no train where its route does not lie; else it says what is wrong.

The crafted files have one thing wrong with each.  The verdict names it by its elements; where nothing is wrong any
more, since points lie otherwise than they did, it says how they lie.
"""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from kernel.names import Block, Point, Route
from models.layouts import check, load
from tests.independent.files import ROOT
from tests.independent.layouts.driving import Driver
from tests.independent.layouts.survey import survey_file
from tests.independent.layouts.test_driving import NEVER

CRAFTED = Path(os.environ.get("HEISOKU_CRAFTED_LAYOUTS") or ROOT.parent / "shared" / "attacks" / "layouts")
"""Layouts each with a fault; ``HEISOKU_CRAFTED_LAYOUTS`` names another folder."""
needs_crafted = pytest.mark.skipif(not CRAFTED.is_dir(), reason=f"there are no crafted layouts at {CRAFTED}")

WRONG: dict[str, set[tuple[str, ...]]] = {
    "crossover.toml": {("1on", "e", "f"), ("2on", "a", "c")},
    "eight.toml": {("a", "L4", "M1"), ("d", "L1", "M4"), ("rc", "L4", "M1")},
    "startpoint.toml": {("eo", "Q"), ("bo", "P")},
    "trailstart.toml": {("out", "P")},
    "r_depart.railml": {("rt_sig98_sig116", "swi55")},
    "r_flank.railml": {("rt_sig98_sig116", "swi72")},
    "y_diamond.yml": {("1", "2")},
    "y_merge.yml": {("1", "2", "a", "b", "c")},
}
"""What is wrong with a file: the elements of the violations at import."""
LIES: dict[str, tuple[str, dict[str, str]]] = {
    "trap.toml": ("main", {"P": "normal", "T": "reverse"}),
    "trap_flank.toml": ("main", {"P": "normal", "T": "reverse"}),
    "trap_points.toml": ("main", {"P": "normal", "T": "reverse"}),
    "trap.json": ("main", {"P": "A_B1", "T": "A_B2"}),
    "twostops.toml": ("a out", {"P": "normal"}),
    "flank2.toml": ("main", {"J1": "normal", "J2": "normal", "T": "reverse"}),
}
"""How the points of a route lie, so that its layout holds."""


@needs_crafted
@pytest.mark.parametrize("name", sorted(WRONG))
def test_what_is_wrong_with_a_crafted_layout_is_said(name: str) -> None:
    result = check(load(CRAFTED / name))
    assert result.verdict == "does not hold"
    at_import = {v.elements for v in result.violations if not v.axiom.startswith("track_leads")}
    assert at_import >= WRONG[name]
    assert {elements[0] for elements in at_import} == {elements[0] for elements in WRONG[name]}


@needs_crafted
@pytest.mark.parametrize("name", sorted(LIES))
def test_a_crafted_layout_whose_points_are_laid_right_is_safe(name: str) -> None:
    imported, (route, lies) = load(CRAFTED / name), LIES[name]
    assert imported.layout.needs[Route(route)] == lies
    assert not Driver.of(survey_file(CRAFTED / name), imported).drive().kinds().keys() & NEVER


@needs_crafted
def test_a_trap_is_held_until_the_last_block_that_it_shields_is_free() -> None:
    layout, main = load(CRAFTED / "flank2.toml").layout, Route("main")
    assert layout.way[main][Block("A")] == layout.released_with[main][Point("T")] == "B"
