"""Answers are kept by what was asked, taken only for the same, and never for evidence."""

from __future__ import annotations

import json
import resource
import sqlite3
import subprocess
import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest

import heisoku
from evidence.records.reading import Kept
from evidence.records.showing import JUDGES
from models import sources
from models.layouts.results import BadInput
from proofs import canaries, contents, kept, run, solvers
from proofs.junit import junit_xml
from proofs.matrix import totals
from proofs.records import Report
from proofs.solvers import Reply

ROOT = Path(__file__).resolve().parents[2]
ONLY = r"^display\.(init|take_place|hear) "
"""A few obligations, of which some ask nothing."""


@pytest.fixture(autouse=True)
def _settled(monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    """However lately these sources were written; no file stays open for the next test."""
    monkeypatch.setattr(kept, "SETTLED_NS", -(10**18))
    kept.opened.cache_clear()
    contents.whole.cache_clear()
    yield
    kept.opened.cache_clear()


@pytest.fixture
def file(tmp_path: Path) -> Path:
    """A file in which a run has kept its answers."""
    path = tmp_path / "proofs.sqlite"
    assert proved(path).kept == 0
    return path


def proved(path: Path | None, only: str = ONLY, seeds: int = 1, solver: str = "z3") -> Report:
    kept.opened.cache_clear()
    return run.prove_all(solver=solver, jobs=1, only=only, seeds=seeds, answers=path)


def asking(report: Report) -> int:
    """How many of the answers somebody was asked for, then or now."""
    return sum("note" not in each for each in report.obligations)


def nobody(*asked: Any) -> Reply:
    raise AssertionError("a solver is asked")


def rows(path: Path) -> dict[str, str]:
    with sqlite3.connect(path) as db:
        return dict(db.execute("SELECT key, content FROM kept"))


def edit(path: Path, what: str, old: str, new: str) -> None:
    """Edit one entry, and leave its digest as it is."""
    key = min(key for key, content in rows(path).items() if key.startswith(what) and old in content)
    with sqlite3.connect(path) as db:
        db.execute("UPDATE kept SET content = replace(content, ?, ?) WHERE key = ?", (old, new, key))


# ---- what is the same is not asked again


def test_a_second_run_asks_nobody_and_says_the_same(file: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    first = proved(None)
    monkeypatch.setattr(solvers, "ask", nobody)
    monkeypatch.setattr(run, "parts", nobody)
    again = proved(file)
    assert again.verdict == first.verdict == "proved"
    assert again.kept == asking(first) > 3
    assert len(again.obligations) > again.kept, "some ask nothing"
    told = ("transition", "invariant", "hypotheses", "axioms", "verdict", "smt2_sha256", "source")
    for one, other in zip(first.obligations, again.obligations, strict=True):
        assert [one.get(name) for name in told] == [other.get(name) for name in told]
    assert not again.said


def test_what_was_not_asked_before_is_asked(file: Path) -> None:
    assert proved(file, seeds=2).kept == asking(proved(None))
    more = proved(file, only=r"^display\.")
    assert 0 < more.kept < asking(more)
    assert proved(file, only=r"^display\.").kept == asking(more)


def test_a_text_that_is_laid_out_anew_finds_its_answer(file: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A change that changes no text: no solver is asked."""
    monkeypatch.setattr(contents, "whole", lambda: "another")
    monkeypatch.setattr(contents, "key_of", lambda row, column: f"{row} {column} another")
    monkeypatch.setattr(solvers, "ask", nobody)
    assert proved(file).kept > 3


@pytest.mark.parametrize(
    "change",
    [
        lambda patch: patch.setitem(solvers.BUDGET, "z3", 3_999_999),
        lambda patch: patch.setattr(kept, "solvers_hashed", lambda: {"z3-solver": "0" * 64}),
        lambda patch: patch.setattr(kept, "ASKING", ("solvers.py",)),
        lambda patch: patch.setattr(kept, "version", lambda solver: "9.9"),
    ],
    ids=["budget", "the solver's files", "how it is asked", "the solver's version"],
)
def test_an_answer_to_another_question_is_not_taken(
    change: Callable[[pytest.MonkeyPatch], None], file: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    kept._asking.cache_clear()
    change(monkeypatch)
    try:
        assert proved(file).kept == 0
    finally:
        kept._asking.cache_clear()


@pytest.mark.parametrize(("answer", "verdict"), [("sat", "refuted"), ("unknown", "undecided")])
def test_what_is_refuted_is_kept_and_what_is_undecided_never(
    answer: Any, verdict: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    seen = canaries.seen(("z3",), "display")
    monkeypatch.setattr(canaries, "seen", lambda *_: seen)
    monkeypatch.setattr(solvers, "ask", lambda *_: Reply(answer, 1, 0.5))
    assert proved(tmp_path / "F").verdict == verdict
    again = proved(tmp_path / "F")
    assert again.verdict == verdict
    assert again.kept == (asking(again) if answer == "sat" else 0)


def test_nothing_of_a_run_that_missed_a_canary_stays(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    seen = canaries.seen(("z3",), "display")
    came = iter([seen, [{**seen[0], "noticed": False}]])
    monkeypatch.setattr(canaries, "seen", lambda *_: next(came))
    report = proved(tmp_path / "F", only=r"^display\.(init|take_place) ")
    assert report.verdict == "undecided"
    assert {each["verdict"] for each in report.obligations} == {"proved"}
    assert not [key for key in rows(tmp_path / "F") if key.startswith("answer")]


def test_texts_are_not_kept_where_a_source_changes_meanwhile(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    before = sources.stamps()
    came = iter([before])
    monkeypatch.setattr(sources, "stamps", lambda: next(came, {**before, "another": (0, 0)}))
    proved(tmp_path / "F")
    assert {key.partition(" ")[0] for key in rows(tmp_path / "F")} == {"answer"}


def test_texts_are_not_kept_of_a_source_that_was_written_just_before(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(kept, "SETTLED_NS", 10**18)
    proved(tmp_path / "F")
    assert {key.partition(" ")[0] for key in rows(tmp_path / "F")} == {"answer"}


# ---- a file that is not as it was written


def test_an_edited_answer_is_named_and_asked_anew(file: Path) -> None:
    edit(file, "answer", "proved", "refuted")
    report = proved(file)
    assert report.verdict == "proved"
    assert report.kept == asking(report) - 1
    assert len(report.said) == 1
    assert "answer" in report.said[0]
    assert "is not as it was kept; it is asked anew" in report.said[0]
    assert str(file) in report.said[0]
    assert proved(file).said == [], "what was asked stands in its place"


def test_an_edited_text_is_named_and_laid_out_anew(file: Path) -> None:
    before = proved(None)
    edit(file, "text", "false", "true")
    report = proved(file)
    assert [each["smt2_sha256"] for each in report.obligations] == [each["smt2_sha256"] for each in before.obligations]
    assert ["note" in each for each in report.obligations] == ["note" in each for each in before.obligations]
    assert len(report.said) == 1
    assert "text" in report.said[0]


def test_an_answer_under_the_key_of_another_is_named(file: Path) -> None:
    first, second = sorted(key for key in rows(file) if key.startswith("answer"))[:2]
    with sqlite3.connect(file) as db:
        db.execute("DELETE FROM kept WHERE key = ?", (first,))
        db.execute("UPDATE kept SET key = ? WHERE key = ?", (first, second))
    report = proved(file)
    assert report.kept == asking(report) - 2
    assert len(report.said) == 1


def exchanged(path: Path, what: str) -> str:
    """Exchange the digests of two entries."""
    first, second = sorted(key for key in rows(path) if key.startswith(what))[:2]
    with sqlite3.connect(path) as db:
        digests = dict(db.execute("SELECT key, digest FROM kept WHERE key IN (?, ?)", (first, second)))
        for key, other in ((first, second), (second, first)):
            db.execute("UPDATE kept SET digest = ? WHERE key = ?", (digests[other], key))
    return f"{what}, {what}"


def copied(path: Path, what: str) -> str:
    """Put an entry's content, with its digest, under the key of another."""
    first, second = sorted(key for key in rows(path) if key.startswith(what))[:2]
    with sqlite3.connect(path) as db:
        whose = "(SELECT {} FROM kept WHERE key = ?)"
        db.execute(
            f"UPDATE kept SET content = {whose.format('content')}, digest = {whose.format('digest')} WHERE key = ?",
            (second, second, first),
        )
    return what


def led_elsewhere(path: Path, what: str) -> str:
    """Lead a cell to the text of another, in the entry that says by what texts are known."""
    key, content = next((key, content) for key, content in rows(path).items() if key.startswith("keys"))
    told = json.loads(content)
    first, second = sorted(told)[:2]
    with sqlite3.connect(path) as db:
        db.execute("UPDATE kept SET content = ? WHERE key = ?", (json.dumps(told | {first: told[second]}), key))
    return "keys"


def retyped(path: Path, what: str) -> str:
    """The same characters as bytes, and no digest."""
    key = min(key for key in rows(path) if key.startswith(what))
    with sqlite3.connect(path) as db:
        db.execute("UPDATE kept SET content = CAST(content AS BLOB), digest = '' WHERE key = ?", (key,))
    return what


def cut_off(path: Path, what: str) -> str:
    """Half of an entry."""
    key = min(key for key in rows(path) if key.startswith(what))
    with sqlite3.connect(path) as db:
        db.execute("UPDATE kept SET content = substr(content, 1, length(content) / 2) WHERE key = ?", (key,))
    return what


@pytest.mark.sampled(3)
@pytest.mark.parametrize("what", ["answer", "text"])
@pytest.mark.parametrize("tamper", [exchanged, copied, led_elsewhere, retyped, cut_off], ids=lambda each: each.__name__)
def test_whatever_is_done_to_an_entry_is_named_and_changes_nothing_that_is_said(
    tamper: Callable[[Path, str], str], what: str, file: Path
) -> None:
    before = proved(None)
    named = tamper(file, what).split(", ")
    report = proved(file)
    assert [line.removeprefix(f"{file}: ").split()[0] for line in report.said] == named
    told = ("transition", "invariant", "verdict", "smt2_sha256", "note", "axioms")
    for one, other in zip(before.obligations, report.obligations, strict=True):
        assert [one.get(name) for name in told] == [other.get(name) for name in told]
    assert proved(file).said == [], "what was found stands in its place"


def test_a_page_of_the_file_that_is_overwritten_is_refused_in_one_line(
    file: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    with sqlite3.connect(file) as db:
        (size,) = db.execute("PRAGMA page_size").fetchone()
        db.execute("PRAGMA wal_checkpoint(TRUNCATE)")
    content = bytearray(file.read_bytes())
    content[size:] = b"\xa5" * (len(content) - size)
    file.write_bytes(content)
    kept.opened.cache_clear()
    assert heisoku.run(["prove", "--jobs", "1", "--only", ONLY, "--kept", str(file)]) == 2
    told = capsys.readouterr()
    assert (told.out, told.err.count("\n")) == ("", 1)
    assert str(file) in told.err


@pytest.mark.parametrize("content", [b"no database", b"SQLite format 3\0" + b"\xff" * 2_000])
def test_a_file_that_holds_something_else_is_refused_in_one_line(
    content: bytes, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = tmp_path / "F"
    file.write_bytes(content)
    assert heisoku.run(["prove", "--jobs", "1", "--only", ONLY, "--kept", str(file)]) == 2
    told = capsys.readouterr()
    assert told.err.count("\n") == 1
    assert str(file) in told.err
    assert file.read_bytes() == content


def test_a_database_of_somebody_else_is_left_alone(tmp_path: Path) -> None:
    with sqlite3.connect(tmp_path / "F") as db:
        db.execute("CREATE TABLE theirs (a)")
    with pytest.raises(BadInput, match="something else"):
        proved(tmp_path / "F")


def test_what_cannot_be_written_loses_no_verdict(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def full(store: kept.KeptProofs, what: str, rows: object) -> None:
        raise OSError(28, "nothing more is kept (database or disk is full)", str(store.path))

    monkeypatch.setattr(kept.KeptProofs, "_write", full)
    report = proved(tmp_path / "F")
    assert report.verdict == "proved"
    assert report.said == [f"{tmp_path / 'F'}: nothing more is kept (database or disk is full)"]


@pytest.mark.parametrize("limit", [0, 600, 40_000])
def test_a_file_that_may_not_grow_is_no_bad_input(limit: int, tmp_path: Path) -> None:
    """Where nothing can be written to it nothing is decided, or what was found is said without it."""
    ended = subprocess.run(
        [sys.executable, str(ROOT / "heisoku_start.py"), "prove", "--jobs", "1", "--only", ONLY, "--kept", "F"],
        cwd=tmp_path,
        text=True,
        capture_output=True,
        timeout=300,
        check=False,
        preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (limit, limit)),
    )
    assert (ended.returncode, "Traceback" in ended.stderr) in ((3, False), (0, False))
    assert "F: " in ended.stdout + ended.stderr


# ---- no evidence


def test_a_run_says_how_many_answers_were_kept(file: Path) -> None:
    again = proved(file)
    line = f"{len(again.obligations):,} answers, {again.kept} of them kept from earlier runs, which are no evidence"
    assert line in totals(again, {})
    assert junit_xml(again).count(b"<system-out>no evidence: answered at") == again.kept
    assert not [line for line in totals(proved(None), {}) if "kept" in line]


def test_a_report_takes_no_kept_answer_for_evidence(file: Path) -> None:
    """Of both solvers, all proved, and every canary noticed: it holds but for that."""
    whole = r"^display\.\w+ what_is_shown_was_taken_lately$"
    column = "display.what_is_shown_was_taken_lately"
    asked = Kept("prove.json", data={**proved(None, only=whole, solver="both").record()})
    assert JUDGES["prove"](asked, column)[0] == "holds"
    proved(file, only=whole, solver="both")
    taken = Kept("prove.json", data={**proved(file, only=whole, solver="both").record(), "canaries": [NOTICED]})
    came, says = JUDGES["prove"](taken, column)
    assert came == "not shown"
    assert "kept from earlier runs" in says


NOTICED = {"canary": "a", "solver": "z3", "solver_version": "1", "process": 1, "answer": "sat", "noticed": True}


@pytest.mark.parametrize("more", [("--whole",), ("--keep", "texts")])
def test_what_is_no_daily_work_takes_nothing_that_is_kept(
    more: tuple[str, ...], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert heisoku.run(["prove", "--kept", str(tmp_path / "F"), *more]) == 2
    assert "--kept" in capsys.readouterr().err
