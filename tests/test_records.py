"""The records of a proof run, its JUnit file and its matrix say the same, and never better than it was."""

from __future__ import annotations

import io
import json
import subprocess
from pathlib import Path
from typing import get_args

import pytest
from hypothesis import given
from hypothesis import strategies as st
from lxml import etree
from rich.console import Console

from proofs.junit import clean, junit_xml, write_junit
from proofs.matrix import print_matrix
from proofs.records import Obligation, Report, Verdict, overall, write_json
from proofs.repository import head

VERDICTS: tuple[Verdict, ...] = get_args(Verdict)


def obligation(
    transition: str = "reserve", invariant: str = "no_conflicting_routes", verdict: Verdict = "proved", seed: int = 0
) -> Obligation:
    """One answer, as a solver's would be recorded."""
    return {
        "transition": transition,
        "invariant": invariant,
        "hypotheses": ["no_conflicting_routes", "claims_follow_runs"],
        "axioms": [],
        "verdict": verdict,
        "solver": "z3",
        "solver_version": "5.4.0",
        "seed": seed,
        "rlimit": 4_000_000,
        "rlimit_spent": 12_345,
        "seconds": 0.25,
        "smt2_sha256": "0" * 64,
        "source": {"file": "proofs/centre.py", "lines": (10, 14)},
    }


def big_report(bad: dict[tuple[int, int], Verdict]) -> Report:
    """50 transitions and 40 invariants in four files, all proved but the bad ones."""
    obligations = []
    for row in range(50):
        for column in range(40):
            one = obligation(
                f"transition_with_a_long_name_{row}", f"invariant_{column}", bad.get((row, column), "proved")
            )
            one["source"] = {"file": f"proofs/file_{column // 10}.py", "lines": (column, column + 3)}
            obligations.append(one)
    return Report(obligations, lifting_seconds=1.5, wall_seconds=20.0)


def matrix(report: Report) -> str:
    out = io.StringIO()
    print_matrix(Console(file=out, width=120, color_system=None), report)
    return out.getvalue()


@given(st.lists(st.sampled_from(VERDICTS)))
def test_a_run_is_proved_only_if_something_was_asked_and_all_of_it_proved(verdicts: list[Verdict]) -> None:
    assert (overall(verdicts) == "proved") is (bool(verdicts) and set(verdicts) == {"proved"})
    assert (overall(verdicts) == "refuted") is ("refuted" in verdicts)


@pytest.mark.parametrize(("verdict", "code"), [("proved", 0), ("refuted", 1), ("undecided", 3)])
def test_each_verdict_has_its_exit_code(verdict: Verdict, code: int) -> None:
    assert Report([obligation(verdict=verdict)], 0.0, 0.0).exit_code == code


def test_a_run_that_asked_nothing_is_undecided_everywhere() -> None:
    report = Report([], 0.0, 0.0)
    assert report.exit_code == 3
    assert report.record()["verdict"] == "undecided"
    assert etree.fromstring(junit_xml(report)).get("failures") == "1"
    assert "0 obligations" in matrix(report)


def test_the_record_is_written_as_json_with_everything_in_it(tmp_path: Path) -> None:
    report = Report([obligation(), obligation("enter", verdict="refuted")], 0.5, 2.0)
    write_json(tmp_path / "new" / "prove.json", report.record())
    record = json.loads((tmp_path / "new" / "prove.json").read_text("utf-8"))
    assert record["verdict"] == "refuted"
    assert [entry["transition"] for entry in record["obligations"]] == ["reserve", "enter"]
    assert record["obligations"][0].keys() == {*obligation().keys(), "theory"}
    assert record["versions"].keys() >= {"python", "z3-solver", "cvc5"}
    assert list((tmp_path / "new").iterdir()) == [tmp_path / "new" / "prove.json"]


def test_a_record_that_cannot_be_written_leaves_the_old_one(tmp_path: Path) -> None:
    path = tmp_path / "prove.json"
    write_json(path, {"verdict": "proved"})
    with pytest.raises(TypeError):
        write_json(path, {"verdict": object()})
    assert json.loads(path.read_text("utf-8")) == {"verdict": "proved"}
    assert list(tmp_path.iterdir()) == [path]


def test_junit_has_a_case_for_every_answer_and_a_failure_for_every_one_not_proved(tmp_path: Path) -> None:
    answers = [obligation("enter", f"claim_{index}", verdict) for index, verdict in enumerate(VERDICTS)]
    write_junit(tmp_path / "prove.xml", Report([*answers, obligation()], 0.1, 1.0))
    root = etree.parse(str(tmp_path / "prove.xml")).getroot()
    assert [suite.get("name") for suite in root] == ["enter", "reserve"]
    assert (root.get("tests"), root.get("failures")) == ("4", "2")
    assert [failure.get("type") for failure in root.iter("failure")] == ["refuted", "undecided"]
    assert "proofs/centre.py:10-14" in (next(root.iter("failure")).text or "")


@given(st.text())
def test_any_text_can_stand_in_junit(text: str) -> None:
    one = obligation(verdict="refuted")
    one["note"] = text
    failure = next(etree.fromstring(junit_xml(Report([one], 0.0, 0.0))).iter("failure"))
    written = clean(text).replace("\r\n", "\n").replace("\r", "\n")
    assert (failure.text or "").replace("\r\n", "\n").replace("\r", "\n").endswith(written)


def test_the_matrix_of_50_by_40_fits_120_columns_and_spells_out_only_what_is_bad() -> None:
    text = matrix(big_report({(3, 7): "refuted", (8, 30): "undecided"}))
    rows = [line for line in text.splitlines() if line.startswith("transition_with") and "×" not in line]
    assert len(rows) == 50
    assert max(len(line) for line in text.splitlines()) <= 120
    assert sum(line.count("X") for line in rows) == 1
    assert rows[3].index("X") - rows[3].index(".") == 7
    assert text.count("transition_with_a_long_name_3 × invariant_7: refuted") == 1
    assert "invariant at proofs/file_3.py:30-33" in text
    assert "2000 obligations, 1998 proved, 1 refuted, 1 undecided" in text
    assert "lifting 1.5 s, wall 20.0 s" in text


def test_one_seed_that_fails_marks_the_whole_cell() -> None:
    text = matrix(Report([obligation(seed=0), obligation(seed=1, verdict="undecided")], 0.0, 0.0))
    assert "1 obligations, 0 proved, 0 refuted, 1 undecided" in text
    assert "1 obligations on which solvers or seeds differ" in text
    assert "2 answers from z3 5.4.0 at 2 seeds" in text


# ---- the commit on record


def told_by_git(root: Path, *words: str) -> None:
    name = ("-c", "user.name=nobody", "-c", "user.email=nobody@example.invalid")
    subprocess.run(["git", "-C", str(root), *name, *words], check=True, capture_output=True)


@pytest.fixture
def committed(tmp_path: Path) -> Path:
    """A repository with one file."""
    root = tmp_path / "source"
    root.mkdir()
    told_by_git(root, "init", "-q")
    (root / "kernel.py").write_text("GUARD = True\n")
    told_by_git(root, "add", ".")
    told_by_git(root, "commit", "-q", "-m", "one")
    return root


def test_a_commit_is_told_as_it_is(committed: Path) -> None:
    commit = head(committed)
    assert commit is not None
    assert len(commit) == 40


def test_another_repository_in_the_environment_is_not_asked(
    committed: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    commit = head(committed)
    told_by_git(tmp_path, "init", "-q", "other")
    told_by_git(tmp_path / "other", "commit", "-q", "--allow-empty", "-m", "other")
    monkeypatch.setenv("GIT_DIR", str(tmp_path / "other" / ".git"))
    assert head(committed) == commit


@pytest.mark.parametrize("how", ["changed", "told unchanged", "skipped", "new", "new and not shown"])
def test_a_source_that_differs_is_marked(how: str, committed: Path) -> None:
    if how == "told unchanged":
        told_by_git(committed, "update-index", "--assume-unchanged", "kernel.py")
    if how == "skipped":
        told_by_git(committed, "update-index", "--skip-worktree", "kernel.py")
    if how == "new and not shown":
        told_by_git(committed, "config", "status.showUntrackedFiles", "no")
    (committed / ("other.py" if how.startswith("new") else "kernel.py")).write_text("GUARD = False\n")
    assert str(head(committed)).endswith("+")
