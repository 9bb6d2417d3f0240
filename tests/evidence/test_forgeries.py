"""Every forgery is named without a solver, and what only a solver can show is shown for certain."""

from __future__ import annotations

import json
import shutil
from collections.abc import Callable, Iterator, Mapping
from functools import cache
from pathlib import Path

import pytest

from evidence.manifest import again, comparing, expected, expected_pages, expected_runs, making
from evidence.manifest.finding import Finding
from evidence.manifest.hashes import read_manifest
from evidence.manifest.laying_out import Cell, LaidOut, all_laid_out, laid_out
from evidence.records.reading import Kept, read
from models.commands import EVERY_CORE
from proofs import lints_apart, run
from proofs.mutants.targets import mutants
from proofs.records import commit, solvers_altered
from proofs.theories import THEORIES
from proofs.witnesses.registry import WITNESSES
from proofs.workbench import Workbench
from tests.evidence import genuine
from tests.evidence.forgeries import MORE, QUICK, Forgery
from tests.evidence.forgeries_in_detail import AS_A_PART, DETAIL, MANIFESTS
from tests.evidence.forgeries_in_detail import DAYS as DAYS_IN_DETAIL
from tests.evidence.forgeries_later import DAYS, LATER

Laid = Mapping[Cell, LaidOut]
TESTS = ["tests.test_cli::test_one", "tests.test_cli::test_two[a & b]"]
"""What is taken for all tests where only a sample of forgeries is tried."""


@pytest.fixture(scope="module")
def quick(tmp_path_factory: pytest.TempPathFactory) -> Iterator[tuple[Path, Laid]]:
    """Records of two theories, and of all else that takes no time."""
    with pytest.MonkeyPatch.context() as patch:
        asked_once(patch)
        patch.setattr(expected_runs, "collected", lambda: TESTS)
        few = laid_out(genuine.few())
        yield genuine.write(tmp_path_factory.mktemp("quick") / "out", few, whole=False), few


@pytest.fixture(scope="module")
def whole(tmp_path_factory: pytest.TempPathFactory) -> Iterator[tuple[Path, Laid]]:
    """Records of everything."""
    with pytest.MonkeyPatch.context() as patch:
        asked_once(patch)
        every = all_laid_out(EVERY_CORE)
        yield genuine.write(tmp_path_factory.mktemp("whole") / "out", every, whole=True), every


def asked_once(patch: pytest.MonkeyPatch) -> None:
    """What takes seconds, and is the same for every forgery."""
    patch.setattr(expected_runs, "collected", cache(expected_runs.collected))
    patch.setattr(expected, "solvers_altered", cache(solvers_altered))
    patch.setattr(lints_apart, "offences", cache(lints_apart.offences))


def found(folder: Path, every: Laid) -> list[Finding]:
    """All that verify finds before it makes anything again."""
    manifest, records = read_manifest(folder), read(folder, expected.NAMES)
    return [
        *comparing.compared(folder, manifest),
        *expected.told(records, manifest.commit, manifest.made_at),
        *expected.by_proofs(records, every),
        *expected.by_runs(records),
        *expected_pages.written(folder, records, manifest),
    ]


def names(forgery: Forgery, folder: Path, every: Laid, to: Path) -> None:
    """The forgery is named, whoever forges having made the manifest anew."""
    shutil.copytree(folder, to)
    forgery.forge(to)
    if forgery not in MANIFESTS:
        genuine.bind(to)
    told = found(to, every)
    assert (forgery.kind, forgery.where) in {(each.kind, each.where) for each in told}, [each.line for each in told]


def test_genuine_records_have_no_findings(quick: tuple[Path, Laid]) -> None:
    assert [each.line for each in found(*quick)] == []


@pytest.mark.parametrize("forgery", [*QUICK, *LATER, *DETAIL], ids=lambda each: each.name)
def test_a_forgery_is_named(forgery: Forgery, quick: tuple[Path, Laid], tmp_path: Path) -> None:
    names(forgery, *quick, tmp_path / "forged")


@pytest.mark.parametrize("forgery", MANIFESTS, ids=lambda each: each.name)
def test_a_forged_manifest_is_named(forgery: Forgery, quick: tuple[Path, Laid], tmp_path: Path) -> None:
    names(forgery, *quick, tmp_path / "forged")


@pytest.mark.parametrize(("name", "forge", "says"), AS_A_PART, ids=[name for name, _, _ in AS_A_PART])
def test_what_is_of_a_part_or_compared_with_nothing_is_told(
    name: str, forge: Callable[[Path], None], says: str, quick: tuple[Path, Laid], tmp_path: Path
) -> None:
    assert not any(says in line for line in untold(quick[0])), name
    shutil.copytree(quick[0], tmp_path / "forged")
    forge(tmp_path / "forged")
    assert any(says in line for line in untold(tmp_path / "forged")), name


def untold(folder: Path) -> list[str]:
    """What verify says that the records do not show."""
    records = read(folder, expected.NAMES)
    return [*expected.lacking(records), *expected_pages.beside(folder, records)]


def test_days_that_contradict_themselves_are_named(tmp_path: Path) -> None:
    (tmp_path / "days-tram.json").write_text(json.dumps(genuine.lived("tram")), "utf-8")
    assert of_days(tmp_path) == set()
    for forgery in (*DAYS, *DAYS_IN_DETAIL):
        (tmp_path / "days-tram.json").write_text(json.dumps(genuine.lived("tram")), "utf-8")
        forgery.forge(tmp_path)
        assert (forgery.kind, forgery.where) in of_days(tmp_path), forgery.name


def of_days(folder: Path) -> set[tuple[str, str]]:
    """What is found of the days of the tram alone."""
    records = read(folder, frozenset({"days-tram.json"}))
    told = [*expected.told(records, commit()), *expected.by_runs(records)]
    return {(each.kind, each.where) for each in told}


@pytest.mark.slow
def test_all_genuine_records_have_no_findings(whole: tuple[Path, Laid]) -> None:
    assert [each.line for each in found(*whole)] == []


@pytest.mark.slow
@pytest.mark.parametrize(
    "forgery", [*QUICK, *MORE, *LATER, *DETAIL, *DAYS, *DAYS_IN_DETAIL], ids=lambda each: each.name
)
def test_every_forgery_is_named(forgery: Forgery, whole: tuple[Path, Laid], tmp_path: Path) -> None:
    names(forgery, *whole, tmp_path / "forged")


def test_sixty_forgeries_are_written_down() -> None:
    assert len({each.name for each in (*QUICK, *MORE, *LATER)}) >= 60


# ---- forgeries of what the verifier runs on


def test_a_manifest_of_another_commit_and_of_other_sources_is_named(quick: tuple[Path, Laid], tmp_path: Path) -> None:
    shutil.copytree(quick[0], tmp_path / "forged")
    path = tmp_path / "forged" / "manifest.json"
    text = path.read_text("utf-8").replace(str(commit()), "0" * 40)
    path.write_text(text, "utf-8")
    told = list(comparing.compared(tmp_path / "forged", read_manifest(tmp_path / "forged")))
    assert ("other commit", "manifest.json") in {(each.kind, each.where) for each in told}


def test_an_edited_witness_is_played_and_named(monkeypatch: pytest.MonkeyPatch) -> None:
    def edited(steps: object) -> None:
        raise AssertionError("the train has not moved")

    name = next(iter(WITNESSES))
    monkeypatch.setitem(WITNESSES, name, edited)
    monkeypatch.setattr(expected, "plays", lambda: [("interlocking", name)])
    assert [each.line for each in expected.played(1)] == [
        f"witness: interlocking: {name}: fails: the train has not moved"
    ]


def test_a_solver_that_is_not_as_its_package_says_is_named(
    monkeypatch: pytest.MonkeyPatch, quick: tuple[Path, Laid]
) -> None:
    monkeypatch.setattr(expected, "solvers_altered", lambda: ["z3/z3.py"])
    assert ("altered solver", "z3/z3.py") in {(each.kind, each.where) for each in found(*quick)}


FAULT = "kernel.onboard.braking."
ROW = "braking.run_a_cycle"


def test_a_cell_that_does_not_hold_is_asked_again_for_certain(monkeypatch: pytest.MonkeyPatch) -> None:
    """A kernel with a fault at its own commit, or answers that workers made up: the text is then as recorded.

    Nothing but a solver shows that.  Every obligation is put to Z3 again, so the chance to name it in one run is 1.
    """
    cells = [(ROW, column) for column in THEORIES["braking"].invariants]
    records = {"prove.json": as_recorded(cells)}
    assert all(result.same for result in again.asked_again(records, 1, lambda *_: None))
    for name, mutant in mutants().items():
        if not name.startswith(FAULT):
            continue
        faulty = Workbench(THEORIES["braking"], named=THEORIES["braking"].quantified, sources=mutant.sources)
        monkeypatch.setattr(run, "bench", lambda theory, faulty=faulty: faulty)
        told = list(again.asked_again(records, 1, lambda *_: None))
        assert len(told) == len(cells)
        if not all(result.same for result in told):
            return
    pytest.fail("no fault of the brakes was shown")


def as_recorded(cells: list[Cell]) -> Kept:
    """A record by which each of them is proved, by both solvers."""
    told = [answer(*cell, solver, "proved") for cell in cells for solver in ("z3", "cvc5")]
    return Kept("prove.json", data={"obligations": told})


def answer(row: str, column: str, solver: str, verdict: str) -> dict[str, object]:
    """One answer, as far as it is compared."""
    return {"transition": row, "invariant": column, "solver": solver, "seed": 0, "verdict": verdict}


def test_what_cvc5_leaves_undecided_and_z3_proves_is_asked_again_and_is_the_same() -> None:
    column = next(iter(THEORIES["braking"].invariants))
    for verdicts in ({"z3": "proved", "cvc5": "undecided"}, {"cvc5": "undecided", "z3": "proved"}):
        told = [answer(ROW, column, solver, verdict) for solver, verdict in verdicts.items()]
        records = {"prove.json": Kept("prove.json", data={"obligations": told})}
        assert [result.same for result in again.asked_again(records, 1, lambda *_: None)] == [True]


def test_what_only_cvc5_is_said_to_prove_differs() -> None:
    column = next(iter(THEORIES["braking"].invariants))
    nothing: dict[str, object] = {}
    for told in ([answer(ROW, column, "cvc5", "proved")], [answer(ROW, column, "z3", "undecided")], [nothing]):
        records = {"prove.json": Kept("prove.json", data={"obligations": told})}
        assert [result.same for result in again.asked_again(records, 1, lambda *_: None)] == [False]


def test_what_is_drawn_and_what_is_never_made_again_is_said(tmp_path: Path) -> None:
    pool = [again.Figure("mutant", str(number), lambda: making.Result(True, "")) for number in range(6_000)]
    assert again.rarely(pool, again.drawn(pool, 1, 30)) == "3 of 6,000 mutant"
    assert again.rarely(pool[:2], pool[:2]) == ""
    records = {
        "ride.json": Kept("ride.json", data={"campaigns": [{"rides": 112_000}]}),
        "beyond.json": Kept("beyond.json", data={"campaigns": [{"rides": 1_024}, {"rides": "many"}]}),
        "days-tram.json": Kept("days-tram.json", data={"days": 10_000}),
    }
    assert again.never(tmp_path, records) == ["ride.json: 112,000 rides", "days-tram.json: 10,000 days"]
    (tmp_path / "tram.days").write_bytes(b"")
    assert again.never(tmp_path, records) == ["ride.json: 112,000 rides"]


def test_a_record_of_another_form_has_a_figure_that_cannot_be_made(tmp_path: Path) -> None:
    records = {
        "ride.json": Kept("ride.json", data={"campaigns": [{}]}),
        "days-tram.json": Kept("days-tram.json", data={"days": "many"}),
    }
    told = [each for each in again.figures(tmp_path, records) if each.kind == "unreadable"]
    assert {each.what for each in told} == {"rides", "days of the tram"}
    assert not any(again.made_again(each).same for each in told)
