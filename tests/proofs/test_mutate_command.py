"""`heisoku mutate`: each mutant is killed, classed or a hole, and the record says by what."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest
import typer

from proofs.mutants import command, record, trying
from proofs.mutants.command import exit_code, kills
from proofs.mutants.targets import mutants
from proofs.theories import THEORIES


@pytest.fixture
def trials(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Keep what is tried apart from what others have tried."""
    file = tmp_path / "kept" / "mutants.json"
    monkeypatch.setattr(record.Trials.__init__, "__defaults__", (file,))
    return file


def run(*arguments: str) -> int:
    app = typer.Typer()
    app.command()(command.mutate)
    app.command("idle")(lambda: None)
    return int(app(["mutate", "--jobs", "1", *arguments], standalone_mode=False) or 0)


LATCH = "kernel.onboard.split.is_intact: and-operand not state.split"


def test_a_mutant_that_is_killed_is_told_with_what_kills_it(
    trials: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    target = tmp_path / "mutate.json"
    assert run("--only", f"^{LATCH}$".replace(".", r"\."), "--json", str(target)) == 0
    found = json.loads(target.read_text("utf-8"))
    assert [each["mutant"] for each in found["mutants"]] == [LATCH]
    assert found["of"] == len(mutants())
    assert found["verdict"] == "holds"
    assert found["commit"]
    one = found["mutants"][0]
    assert (one["became"], one["outcome"], one["by"]) == ("killed", "counterexample", "split")
    killing = one["finding"].split(", ")
    assert killing
    assert {name for name, count in found["kills"]["split"].items() if count} == set(killing)
    assert found["kills"]["split"].keys() == THEORIES["split"].invariants.keys()
    assert "1 killed, 0 classed, 0 hole" in capsys.readouterr().out
    assert LATCH in json.loads(trials.read_text("utf-8"))["mutants"]


@pytest.mark.parametrize("forged", ["finding", "sources", "seal", ""])
def test_what_is_kept_of_an_earlier_run_is_believed_only_as_it_was_kept(
    forged: str, trials: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    only = ("--only", f"^{LATCH}$".replace(".", r"\."))
    assert run(*only) == 0
    assert "earlier run" not in capsys.readouterr().out
    if forged:
        kept = json.loads(trials.read_text("utf-8"))
        kept["mutants"][LATCH][forged] = "made by hand"
        trials.write_text(json.dumps(kept), "utf-8")
    assert run(*only) == 0
    assert ("1 of them as an earlier run kept them" in capsys.readouterr().out) == (not forged)
    assert "made by hand" not in trials.read_text("utf-8")


def test_a_mutant_that_nobody_notices_is_a_hole(
    trials: Path, monkeypatch: pytest.MonkeyPatch, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    def nobody(names: list[str], *_: Any) -> dict[str, dict[str, Any]]:
        told = {"outcome": "survived", "by": "", "finding": "", "searched": {"split.run_a_cycle": "unknown"}}
        return {name: {**told, "seconds": 1, "theories": ["split"], "class": "", "objection": "none"} for name in names}

    monkeypatch.setattr(trying, "try_all", nobody)
    target = tmp_path / "mutate.json"
    assert run("--only", "split.is_intact", "--sample", "2", "--json", str(target)) == 1
    found = json.loads(target.read_text("utf-8"))
    assert [each["became"] for each in found["mutants"]] == ["hole", "hole"]
    assert found["verdict"] == "does not hold"
    assert "hole: kernel.onboard.split.is_intact" in capsys.readouterr().out


def test_what_is_killed_by_a_witness_is_no_invariants_kill() -> None:
    row = {"theories": ["split"], "outcome": "witness", "finding": "split_is_latched"}
    assert set(kills([row])["split"].values()) == {0}
    assert kills([{**row, "outcome": "counterexample"}])["split"]["split_is_latched"] == 1
    assert exit_code({"mutants": []}) == 3


@pytest.mark.parametrize("given", [("--only", "("), ("--only", "no such mutant"), ("--json", "/dev/null/mutate.json")])
def test_bad_usage_is_one_line_and_code_2(given: tuple[str, ...], capsys: pytest.CaptureFixture[str]) -> None:
    assert run(*given) == 2
    assert len(capsys.readouterr().err.splitlines()) == 1
