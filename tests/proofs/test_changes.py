"""Changes that a maintainer might make to the kernel: those that weaken safety are refuted by the proofs alone."""

from __future__ import annotations

import shutil
import subprocess
import sys
from collections import Counter
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from kernel.tram import stopping
from proofs import canaries, solvers
from proofs.lift.sources import definition_of
from proofs.planted import changes as planted_changes
from proofs.planted.changes import ROOT, Change, Planted, Seen, cells, changes, holding, main, planted, tried
from proofs.solvers import Reply
from proofs.theories import THEORIES

SAMPLE = (
    "brake_release_moving",
    "watch_late",
    "restart_healthy",
    "slow_is_fast",
    "silence_is_known",
    "roll_back_tenfold",
    "rear_forgotten",
    "age_sign",
)
"""Quickly refuted, each of another theory; among them a constant, a latch, a sign, a number, a guard."""


@pytest.mark.parametrize("name", changes())
def test_a_change_can_be_made_and_has_obligations(name: str) -> None:
    change = changes()[name]
    made = planted(change)
    assert len(made.sources) + len(made.constants) == 1
    for theory in change.theories:
        assert any(True for _ in cells(made, THEORIES[theory])), theory


def test_each_theory_has_two_new_ones() -> None:
    new = Counter(theory for change in changes().values() if change.group != "first" for theory in change.theories)
    assert set(new) == set(THEORIES)
    assert min(new.values()) >= 2
    assert sum(change.group == "first" for change in changes().values()) == 35


@pytest.mark.parametrize("name", SAMPLE)
def test_a_change_is_refuted(name: str) -> None:
    seen = tried(name)
    assert (seen.outcome, seen.objection) == ("refuted", "")
    assert seen.by.endswith("by z3")


@pytest.mark.sampled(2)
@pytest.mark.parametrize("name", SAMPLE)
def test_without_the_change_the_same_obligations_are_not_refuted(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    made = planted(changes()[name])
    own = {function: definition_of(function) for function in made.sources}
    values = {constant: getattr(sys.modules[made.module], constant) for constant in made.constants}

    def as_it_is(_change: Change) -> Planted:
        return replace(made, sources=own, constants=values)

    monkeypatch.setattr(planted_changes, "planted", as_it_is)
    assert tried(name).outcome == "proved"


def test_a_harmless_change_is_not_refuted() -> None:
    seen = tried("begins_farther")
    assert (seen.outcome, seen.objection) == ("proved", "")


def test_unknown_notices_nothing(monkeypatch: pytest.MonkeyPatch) -> None:
    def at_a_loss(*_asked: Any) -> Reply:
        return Reply("unknown", 0, 0.0)

    monkeypatch.setattr(solvers, "ask", at_a_loss)
    monkeypatch.setattr(canaries, "answered", lambda *_asked: "unknown")
    # A process of its own would know nothing of the two lines above.
    monkeypatch.setattr(planted_changes, "as_they_end", lambda do, todo, *_jobs, **_each: map(do, todo))
    seen = tried("watch_unlatched")
    assert seen.outcome == "undecided"
    assert seen.objection == "not noticed: undecided"
    assert main(["--only", "^watch_unlatched$"]) == 1


@pytest.mark.parametrize(
    ("name", "outcome", "objection"),
    [
        ("watch_unlatched", "refuted", ""),
        ("watch_unlatched", "proved", "not noticed: proved"),
        ("watch_unlatched", "not lifted", "not noticed: not lifted"),
        ("begins_farther", "undecided", ""),
        ("begins_farther", "refuted", "refuted, and said to be harmless"),
    ],
)
def test_what_is_not_as_it_stands_is_told(name: str, outcome: str, objection: str) -> None:
    assert Seen(name, outcome, "", 0.0).objection == objection


def test_a_constant_has_its_other_value_only_for_the_time() -> None:
    made = planted(changes()["slow_is_fast"])
    with holding(made):
        assert stopping.SLOW_MM_S == 13_890
    assert stopping.SLOW_MM_S == 1_389


def edited(**other: Any) -> Change:
    return replace(changes()["watch_unlatched"], **other)


@pytest.mark.parametrize(
    "change",
    [
        lambda: edited(old="no such text"),
        lambda: edited(old="watch"),
        lambda: edited(old="    broken: bool\n", new="    broken: int\n"),
    ],
    ids=["not there", "there more than once", "neither a function nor a constant"],
)
def test_a_change_that_cannot_be_made_is_an_error(change: Callable[[], Change]) -> None:
    with pytest.raises(ValueError, match="watch_unlatched: "):
        planted(change())


@pytest.mark.slow
def test_all_that_weaken_safety_are_refuted() -> None:
    assert main(["--jobs", "2"]) == 0


@pytest.mark.slow
@pytest.mark.parametrize("name", ["roll_back_tenfold", "slow_is_fast", "silence_is_known"])
def test_the_prover_refutes_an_edited_tree(name: str, tmp_path: Path) -> None:
    change = changes()[name]
    for room in ("kernel", "models", "proofs", "evidence", "fuzz"):
        shutil.copytree(ROOT / room, tmp_path / room, ignore=shutil.ignore_patterns("__pycache__"))
    shutil.copy(ROOT / "heisoku.py", tmp_path)
    shutil.copy(ROOT / "heisoku_public.py", tmp_path)
    shutil.copy(ROOT / "heisoku_start.py", tmp_path)
    file = tmp_path / change.file
    file.write_text(file.read_text(encoding="utf-8").replace(change.old, change.new), encoding="utf-8")
    theory = f"^{change.theories[0]}\\."
    proving = [sys.executable, "-B", "heisoku.py", "prove", "--only", theory, "--jobs", "1"]
    there = {"PYTHONPATH": str(tmp_path)}
    done = subprocess.run(proving, cwd=tmp_path, env=there, capture_output=True, text=True, check=False)
    assert done.returncode == 1, done.stderr
    assert "refuted" in done.stdout
