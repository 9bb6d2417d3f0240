"""A certificate is a proof that was gone through step by step; what is no theorem gets none."""

from __future__ import annotations

import json
import random
from collections.abc import Iterator
from pathlib import Path

import pytest

from heisoku import run
from proofs import canaries
from proofs.certificates import checking
from proofs.certificates.checking import Certified, certified, controls, external, proved
from proofs.certificates.command import exit_code, lines, record
from proofs.run import parts
from proofs.theories import THEORIES, columns, row_of

DRAWN = random.Random(7)


@pytest.mark.parametrize("theory", THEORIES)
def test_an_obligation_of_each_theory_is_gone_through(theory: str) -> None:
    rows = [row_of(THEORIES[theory], name) for name in THEORIES[theory].steps]
    row = DRAWN.choice(rows)
    found = certified((row, DRAWN.choice([column for column in columns(row) if parts(row, column)])))
    assert (found.answer, found.trusted) == ("checked", 0)
    assert found.steps >= found.parts >= 1


def test_what_is_no_theorem_gets_none() -> None:
    assert [name for name, refused in controls() if not refused] == []
    assert len(controls()) == len(canaries.CANARIES) + (external() is not None)
    for canary, part in canaries.laid_out():
        answer, proof = proved(part)
        assert answer != "checked", canary.name
        assert proof == ""


def one(**fields: object) -> Certified:
    return Certified(**{  # type: ignore[arg-type]
        "row": "split.run_a_cycle", "column": "split_is_latched", "parts": 1, "answer": "checked",
        "steps": 3, "trusted": 0, "smt2_sha256": "", **fields,
    })  # fmt: skip


REFUSED = [("a contradiction", True)]


@pytest.mark.parametrize(
    ("found", "refused", "code"),
    [
        ([one()], REFUSED, 0),
        ([one(external="correct")], REFUSED, 0),
        ([one(), one(answer="sat")], REFUSED, 1),
        ([one(), one(answer="unknown")], REFUSED, 3),
        ([one(trusted=1)], REFUSED, 3),
        ([one(external="not correct")], REFUSED, 3),
        ([one()], [("a contradiction", False)], 3),
        ([one()], [], 3),
        ([], REFUSED, 3),
    ],
)
def test_only_what_is_checked_with_every_control_refused_holds(
    found: list[Certified], refused: list[tuple[str, bool]], code: int
) -> None:
    told = record(found, 9, refused, None, 1.0)
    assert exit_code(told) == code
    assert told["verdict"] == {0: "holds", 1: "does not hold", 3: "undecided"}[code]
    assert lines(told)[-1].endswith(told["verdict"])


@pytest.fixture
def stub(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Path]:
    """A program in the external checker's place; what it says is written by the test."""
    checker, rules = tmp_path / checking.CHECKER, tmp_path / "Cpc.eo"
    rules.write_text("")
    checker.write_text("")
    checker.chmod(0o755)
    monkeypatch.setenv("PATH", str(tmp_path), prepend=":")
    monkeypatch.setenv(checking.RULES, str(rules))
    external.cache_clear()
    yield checker
    external.cache_clear()


@pytest.mark.parametrize(
    ("says", "code"),
    [
        ("echo correct", 3),
        ('grep -q heisoku.any "$1" && { echo "not a proof"; exit 1; }; echo correct', 0),
        ("echo incomplete", 3),
        ("exit 1", 3),
    ],
    ids=["to everything", "to proofs alone", "to nothing", "it fails"],
)
def test_an_external_checker_that_passes_what_is_no_proof_is_named(
    stub: Path, tmp_path: Path, says: str, code: int, capsys: pytest.CaptureFixture[str]
) -> None:
    stub.write_text(f"#!/bin/sh\n{says}\n")
    kept = tmp_path / "certificates.json"
    assert run(["certify", "--only", "^split.init split_is_latched$", "--jobs", "1", "--json", str(kept)]) == code
    told = json.loads(kept.read_text())
    assert told["external"] == str(stub)
    named = "control: a proof of what is no theorem: went through" in capsys.readouterr().out
    assert named == (says == "echo correct")


@pytest.mark.parametrize("words", [["--only", "("], ["--only", "no such row"], ["--json", "/"]])
def test_what_cannot_be_asked_is_one_line_and_code_2(words: list[str], capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["certify", *words]) == 2
    assert capsys.readouterr().err.count("\n") == 1
