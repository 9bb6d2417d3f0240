"""A layout that ``heisoku check`` says holds leads no train where its route does not lie; else it says what is wrong.

The crafted files have one thing wrong with each.  The verdict names it by its elements; where nothing is wrong any
more, since points lie otherwise than they did, it says how they lie.
"""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from kernel.names import Block, Point, Route
from models.layouts import BadInput, check, load
from tests.independent.files import ROOT
from tests.independent.layouts.driving import Driver
from tests.independent.layouts.survey import survey_file
from tests.independent.layouts.test_driving import NEVER

CRAFTED = Path(os.environ.get("HEISOKU_CRAFTED_LAYOUTS") or ROOT.parent / "shared" / "attacks" / "layouts")
"""Layouts each with a fault; ``HEISOKU_CRAFTED_LAYOUTS`` names another folder."""
needs_crafted = pytest.mark.skipif(not CRAFTED.is_dir(), reason=f"there are no crafted layouts at {CRAFTED}")

ROOM, FOUL = "a block has room for its tags", "a train behind a boundary is clear of the point"
BLADES = "a boundary's tags lie clear of points and crossings"
APART, SAID = "the tracks of a start block are told apart", "a route says where its train stands"
SECTIONS = "sections are pieces of track, and a route's are those that it runs through"
ALIKE, SLIPS = "no two names look the same", "an overlap is longer than a train slips"
Instances = set[tuple[str, ...]]
Wrong = set[tuple[str, tuple[str, ...]]]
WRONG: dict[str, Wrong] = {
    "atswitch.json": {
        *((ROOM, ("D1", "D2", "DA")), (FOUL, ("P", "D1")), (FOUL, ("P", "D2"))),
        *((BLADES, (detector, "P")) for detector in ("D1", "D2", "DA")),
    },
    "crossover.toml": {(APART, ("1on", "e", "f")), (APART, ("2on", "a", "c"))},
    "eight.toml": {(APART, ("a", "L4", "M1")), (APART, ("d", "L1", "M4")), (APART, ("rc", "L4", "M1"))},
    "float.toml": {(SAID, ("out", "P"))},
    "frog.toml": {*((FOUL, ("P", each)) for each in "AB"), *((BLADES, (each, "P")) for each in "AB")},
    "km.json": {
        *((ROOM, ends) for ends in (("BE", "D3"), ("BW", "D0"), ("D0", "D1"), ("D1", "D3"))),
        ("a track is as long as a vehicle", ("T1", "T2")),
    },
    "overflow.toml": {(ROOM, ("A", "west")), ("a distance fits its tag", ("A", "B"))},
    "r_close.railml": {
        *((FOUL, ("swi72", "tde78")), (BLADES, ("tde78", "swi72"))),
        (SECTIONS, ("rt_sig113_sig107_swi72N", "tvd80")),
    },
    "r_depart.railml": {("a route's positions are of its points", ("rt_sig98_sig116", "swi55"))},
    "r_flank.railml": {("a flank point shields its route", ("rt_sig98_sig116", "swi72"))},
    "r_ilswap.railml": {("a switch has one left and one right branch", ("swi9", "il_swi9"))},
    "r_pos.railml": {("an element lies in one place", ("tde78",))},
    "r_section.railml": {(SECTIONS, ("rt_sig105_sig104", "tvd80", "tvd87"))},
    "samejoint.json": {(ROOM, ("D1", "D2"))},
    "startpoint.toml": {(SAID, ("eo", "Q")), (SAID, ("bo", "P"))},
    "tiny.toml": {
        *((ROOM, ends) for ends in (("A", "B"), ("B", "C"))),
        *((SLIPS, ends) for ends in (("r", "B", "C"), ("s", "C", "B"))),
    },
    "trailstart.toml": {(SAID, ("out", "P"))},
    "typojoint.toml": {("two ends of track meet at each joint", ("Joint", "joint"))},
    "uni.toml": {(ALIKE, names) for names in (("B", "\u0412"), ("W", "W "), ("e\u0301", "\u00e9"), ("r", "r "))},
    "y_diamond.yml": {("declared conflicts follow", ("1", "2"))},
    "y_merge.yml": {("tracks merge at a point", ("1", "2", "a", "b", "c"))},
}
"""What is wrong with a file: rule and elements of every violation, but for the axioms that say the same once more."""
REFUSED = {"dup.toml": "is not usable as a name"}
"""No layouts at all, and why."""
RESTS: dict[str, dict[str, Instances]] = {
    "flank2.toml": {"start": {("T", "yard"), ("Q", "yard")}},
    "joined.toml": {
        "joint": {("sand drag", "trap1", "trap2")},
        "loop": {("B:E+M1+M2+W", "700000 mm")},
    },
    "line3.toml": {},
    "r_derailer.railml": {"unread": {("der1",), ("lcr69",), ("lcr74",)}},
    "r_ns.railml": {"unread": {("ghost",), ("lcr69",), ("lcr74",)}},
    "tagcol.toml": {},
    "trap.json": {},
    "trap.toml": {},
    "trap_flank.toml": {},
    "trap_points.toml": {},
    "twostops.toml": {"start": {("P", "B:W+stop a+stop b")}},
}
"""Files that hold, and what their verdicts rest on beside authority, clearance and what a real file rests on too.

Nothing is wrong with most of them any more: points lie otherwise (`LIES`), tags of one name are told apart, and what
``line3.toml`` shows is a fault of an old kernel.
"""
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
def test_every_crafted_layout_has_its_verdict_here() -> None:
    files = {path.name for path in CRAFTED.iterdir()}
    assert {*WRONG, *REFUSED, *RESTS} == files
    assert len(WRONG) + len(REFUSED) + len(RESTS) == len(files)


@needs_crafted
@pytest.mark.parametrize("name", sorted(WRONG))
def test_what_is_wrong_with_a_crafted_layout_is_said(name: str) -> None:
    result = check(load(CRAFTED / name))
    assert result.verdict == "does not hold"
    assert {(v.axiom, v.elements) for v in result.violations if not v.axiom.startswith("track_leads")} == WRONG[name]


@needs_crafted
@pytest.mark.parametrize("name", sorted(REFUSED))
def test_what_is_no_layout_is_refused(name: str) -> None:
    with pytest.raises(BadInput, match=REFUSED[name]):
        load(CRAFTED / name)


@needs_crafted
@pytest.mark.parametrize("name", sorted(RESTS))
def test_what_holds_is_told_with_what_it_rests_on(name: str) -> None:
    result = check(load(CRAFTED / name))
    assert result.verdict == "holds"
    rests: dict[str, Instances] = {rest.kind: set(rest.instances) for rest in result.rests}
    asked = {"joint", "loop", "start", "unread", "left out", "derived"} - (
        {"start"} if name.endswith(".railml") else set()
    )
    assert {kind: rests[kind] for kind in asked & rests.keys()} == RESTS[name]


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
