"""The page of contracts names what is there, and leaves no assumption of a machine out."""

from __future__ import annotations

import re
import tomllib
from pathlib import Path

import pytest

from models.world import assumptions as world
from proofs import assumptions, lints_apart
from proofs.joints import BY_NAME, SAME_FUNCTION, Joint, joints
from proofs.reach import called_by
from proofs.theories import THEORIES

ROOT = Path(__file__).resolve().parent.parent.parent
PAGE = (ROOT / "docs" / "contracts.md").read_text("utf-8")
ASSUMED = {
    theory: entries
    for path in sorted(ROOT.glob("models/*/assumptions.toml"))
    for theory, entries in tomllib.loads(path.read_text("utf-8")).items()
    if path.parent.name != "world"
}
WORLDS = ("models.world.", "models.onboard.")
NAME = re.compile(r"`(\w+)\.(\w+)`")


def rows(heading: str) -> list[list[str]]:
    """The rows of the table under a heading, cell by cell."""
    part = PAGE.split(f"## {heading}", 1)[1].split("\n## ", 1)[0]
    lines = [line for line in part.splitlines() if line.startswith("|")]
    return [line.strip("|").split("|") for line in lines[2:]]


JOINTS = [
    row
    for heading in (
        "The head: no train leaves what is secured for it",
        "The tail: nothing is released that a train is still in",
        "The crossing, the trams and the worker",
    )
    for row in rows(heading)
]
REMAINING = rows("What is still assumed of the machines' world")


def assumptions_of(theory: str) -> set[str]:
    """The names that a theory assumes; the interlocking's are functions of its world."""
    if theory == "interlocking":
        built_in = {each.name for each in assumptions.read() if each.kind == "built_in"}
        return {name for name in vars(world) if not name.startswith("_")} | built_in
    return set(ASSUMED.get(theory, {}))


def test_the_tables_are_read() -> None:
    assert len(JOINTS) > 10
    assert len(REMAINING) > 5


@pytest.mark.parametrize("row", JOINTS, ids=lambda row: row[0].strip())
def test_a_joint_names_a_proved_invariant_and_a_real_assumption(row: list[str]) -> None:
    guaranteed = NAME.findall(row[1])
    assert guaranteed
    assert [(theory, name) for theory, name in guaranteed if name not in THEORIES[theory].invariants] == []
    assumed = NAME.findall(row[2])
    assert assumed or "–" in row[2]
    assert [(theory, name) for theory, name in assumed if name not in assumptions_of(theory)] == []


def test_every_assumption_of_a_machine_is_discharged_or_said_to_remain() -> None:
    discharged = {pair for row in JOINTS for pair in NAME.findall(row[2])}
    remaining = {pair for row in REMAINING for pair in NAME.findall(row[1])}
    there = {(theory, name) for theory, entries in ASSUMED.items() for name in entries}
    assert there - discharged - remaining == set()
    assert remaining - there == set()
    assert discharged & remaining == set()


# ---- how they are tied


TIED = [(joint, name, tie) for joint in joints() for name, tie in joint.tied.items()]


@pytest.mark.parametrize(("joint", "name", "tie"), TIED, ids=lambda value: value if isinstance(value, str) else "")
def test_what_is_tied_more_than_by_name_is(joint: Joint, name: str, tie: str) -> None:
    """By a function of the world that the one assumes and the other proves, or in a theory of which both are parts."""
    assert name in joint.assumed
    assert tie != BY_NAME
    theory, _, assumed = name.partition(".")
    if tie == SAME_FUNCTION:
        function = (
            getattr(world, assumed) if theory == "interlocking" else lints_apart.assumed(THEORIES[theory])[assumed]
        )
        said = {each for each in (function, *called_by(function)) if each.__module__.startswith(WORLDS)}
        proved = [THEORIES[of].invariants[claim] for of, _, claim in (each.partition(".") for each in joint.guaranteed)]
        assert all(any(each in called_by(claim) for each in said) for claim in proved)
        return
    assert {theory, *(each.partition(".")[0] for each in joint.guaranteed)} <= {tie, *THEORIES[tie].parts}
    assert name not in {f"{tie}.{each}" for each in ASSUMED[tie]}, "it is not assumed again"


def test_the_ties_are_those_of_both_kinds() -> None:
    assert {SAME_FUNCTION, "train"} == {tie for _, _, tie in TIED}
