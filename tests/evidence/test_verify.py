"""What records say is made again, drawn from a seed; a record that says otherwise is named."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import asdict
from hashlib import sha256
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import typer

import heisoku
from evidence.catalogue import catalogue
from evidence.manifest import command, expected_commands, expected_proofs, laying_out
from evidence.manifest.again import Figure, drawn, figures, made_again
from evidence.manifest.hashes import made
from evidence.manifest.making import Result
from evidence.records.reading import read
from models.days.campaign import outcome as days_outcome
from models.days.kept import KeptDays
from models.days.report import record as days_record
from models.days.system import System
from models.layouts import as_json, check, load
from models.reproduce import PAPERS
from models.rides import report
from models.rides.campaign import ride_all
from models.rides.tally import outcome
from proofs.certificates.checking import certified
from proofs.records import write_json
from proofs.run import prove_all
from proofs.theories import columns
from tests.evidence import genuine

ROOT = Path(__file__).resolve().parent.parent.parent
KINDS = ("obligation", "certificate", "witness", "layout", "ride", "day", "days", "paper", "mutant")
TRAM = System(
    "tram", {"late": "late"}, {}, {}, {}, {}, {"departures": "departures"}, 16.0,
    lambda seed, day: np.array([0, 100 * seed + day], np.int64),
)  # fmt: skip
"""Days whose rows are their numbers."""
CLAIM = "broken_means_a_bound_was_broken"


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Records that were really made: a few obligations, a layout, a few rides, a mutant."""
    here = tmp_path_factory.mktemp("out")
    proved = prove_all(solver="both", jobs=1, only=r"^brake_watch\.run_a_cycle ")
    write_json(here / "prove.json", proved.record())
    path = ROOT / "layouts" / "terminus.toml"
    imported = load(path)
    entry = {"file": "layouts/terminus.toml", **as_json(imported, check(imported))}
    write_json(here / "check.json", {"verdict": "holds", "layouts": [entry]})
    rows = ride_all(3, 2, 1)
    write_json(here / "ride.json", report.record(3, {"": outcome(rows[""])}))
    mutant = {"mutant": "kernel.onboard.split.is_intact: and-operand not state.split", "outcome": "counterexample"}
    write_json(here / "mutate.json", {"mutants": [mutant]})
    write_json(here / "certificates.json", {"obligations": [asdict(certified(("brake_watch.init", CLAIM)))]})
    write_json(here / "000.json", {**PAPERS["000"].reproduce(4, 1, lambda *_: None).record(), "runs": 1})
    lived = TRAM.simulate(5, range(3))
    KeptDays(here / "tram.days", TRAM, 5).keep(range(3), lived)
    write_json(here / "days-tram.json", days_record(5, days_outcome(TRAM, lived)))
    return here


@pytest.fixture(autouse=True)
def _days_that_take_no_time(monkeypatch: pytest.MonkeyPatch) -> None:
    """The system's own would have to be compiled first."""
    monkeypatch.setattr("evidence.manifest.making.system_of", lambda name: {"tram": TRAM}[name])


@pytest.fixture(autouse=True)
def _nothing_laid_out_anew(monkeypatch: pytest.MonkeyPatch) -> None:
    """These records are of a part; test_forgeries.py compares whole ones with the sources."""
    monkeypatch.setattr(command, "_against_the_sources", lambda folder, records, commit, jobs: [])


def test_command_lines_are_read_as_the_program_reads_them() -> None:
    commands: Any = typer.main.get_command(heisoku.app)
    written = {each.command for each in expected_commands.WRITERS.values()} & {*commands.commands} | {"days"}
    options = [each for name in written for each in commands.commands[name].params if each.opts[0].startswith("--")]
    assert len(written) == 8
    assert {each.opts[0] for each in options if each.is_flag} <= expected_commands.FLAGS
    defaults = {"--rides": "RIDES", "--days": "DAYS", "--seed": "SEED", "--seeds": "SEEDS"}
    for option, name in defaults.items():
        said = {each.default for each in options if each.opts[0] == option} - {None}
        assert said == {getattr(expected_commands, name)}, option


def pool(folder: Path) -> list[Figure]:
    return list(figures(folder, read(folder, frozenset(each.record for each in catalogue().values()))))


def of_kind(folder: Path, kind: str) -> Figure:
    return next(each for each in pool(folder) if each.kind == kind)


def test_there_is_something_of_each_kind_and_a_draw_takes_of_each(folder: Path) -> None:
    found = pool(folder)
    kinds = {each.kind for each in found}
    assert kinds == set(KINDS)
    assert {each.kind for each in drawn(found, 1, 12)} == kinds
    assert [each.what for each in drawn(found, 1, 12)] == [each.what for each in drawn(found, 1, 12)]
    draws = {tuple(each.what for each in drawn(found, seed, 12)) for seed in range(6)}
    assert len(draws) > 1, "another seed draws others"
    assert len(drawn(found, 1, 30)) == 30
    assert drawn(found, 1, 0) == []


@pytest.mark.parametrize("kind", KINDS)
def test_what_was_made_comes_to_the_same_again(kind: str, folder: Path) -> None:
    result = made_again(of_kind(folder, kind))
    assert result.same, result.says


def spoiled(folder: Path, to: Path, name: str, at: tuple[Any, ...], values: Mapping[str, Any]) -> Path:
    """Copy the records with one of them edited."""
    for path in [*folder.glob("*.json"), *folder.glob("*.days")]:
        (to / path.name).write_bytes(path.read_bytes())
    record = json.loads((to / name).read_text("utf-8"))
    place = record
    for step in at:
        place = place[step]
    place |= values
    (to / name).write_text(json.dumps(record), "utf-8")
    return to


@pytest.mark.parametrize(
    ("kind", "name", "at", "values", "says"),
    [
        ("obligation", "prove.json", ("obligations", 0), {"verdict": "refuted"}, "recorded as refuted"),
        ("obligation", "prove.json", ("obligations", 0), {"smt2_sha256": "0" * 64}, "another text"),
        ("obligation", "prove.json", ("obligations", 0), {"hypotheses": ["none"]}, "other hypotheses"),
        ("obligation", "prove.json", ("obligations", 0), {"transition": "brake_watch.fly"}, "cannot be made"),
        ("layout", "check.json", ("layouts", 0, "checked"), {"a_destination_is_covered": 1}, "another checked"),
        ("layout", "check.json", ("layouts", 0), {"file": "layouts/gone.toml"}, "gone.toml"),
        ("ride", "ride.json", ("campaigns", 0, "sums"), {"cycles": 1}, "another sums"),
        ("certificate", "certificates.json", ("obligations", 0), {"steps": 1}, "another steps"),
        ("days", "days-tram.json", ("columns", "counts", "departures"), {"all": 1}, "another columns"),
        ("days", "days-tram.json", (), {"days": 4}, "not each of the days is kept"),
        ("day", "days-tram.json", (), {"seed": 6}, "seed 5, not 6"),
        ("paper", "000.json", ("rows", 0), {"ours": "1 m"}, "another ours"),
        ("mutant", "mutate.json", ("mutants", 0), {"outcome": "survived"}, "recorded as survived"),
        ("mutant", "mutate.json", ("mutants", 0), {"mutant": "kernel.gone: guard"}, "no such mutant"),
    ],
)
def test_a_record_that_says_otherwise_is_not_the_same(
    kind: str, name: str, at: tuple[Any, ...], values: dict[str, Any], says: str, folder: Path, tmp_path: Path
) -> None:
    result = made_again(of_kind(spoiled(folder, tmp_path, name, at, values), kind))
    assert not result.same
    assert says in result.says


def run(*arguments: str) -> int:
    app = typer.Typer()
    app.command()(command.manifest)
    app.command()(command.verify)
    return int(app(list(arguments), standalone_mode=False) or 0)


def test_the_command_names_what_is_wrong_and_prints_its_seed(
    folder: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    here = spoiled(folder, tmp_path, "prove.json", ("obligations", 0), {"seconds": 1.0})
    assert run("manifest", str(here)) == 0
    monkeypatch.setattr("evidence.manifest.again.figures", lambda folder, records: iter(FIGURES))
    capsys.readouterr()
    code = run("verify", str(here), "--sample", "2", "--seed", "7")
    told = capsys.readouterr().out
    assert "again: witness: good: as it was" in told
    assert "DIFFERS: witness: wrong: is not" in told
    assert "with seed 7" in told
    assert code == 1
    (here / "check.json").unlink()
    (here / "foreign.json").write_text("{}", "utf-8")
    code = run("verify", str(here), "--sample", "0")
    told = capsys.readouterr().out
    assert "missing: check.json" in told
    assert "foreign: foreign.json" in told
    assert code == 1


def test_a_folder_without_a_record_shows_nothing(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "manifest.json").write_text(made(tmp_path).text(), "utf-8")
    assert run("verify", str(tmp_path), "--sample", "0") == 3
    told = capsys.readouterr().out.splitlines()
    assert told[-1] == "undecided"
    assert told[-2].startswith("nothing is shown without prove.json and check.json")


FIGURES = (
    Figure("witness", "good", lambda: Result(True, "as it was")),
    Figure("witness", "wrong", lambda: Result(False, "is not")),
)


def test_a_fake_solver_is_named_before_anything_is_asked_of_it(
    folder: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    here = spoiled(folder, tmp_path, "check.json", (), {})
    assert run("manifest", str(here)) == 0
    lie = {"canary": "a claim", "solver": "z3", "solver_version": "1", "answer": "unsat", "noticed": False}
    monkeypatch.setattr("proofs.canaries.seen", lambda asked: [lie])
    monkeypatch.setattr("evidence.manifest.again.figures", lambda folder, records: iter(FIGURES[:1]))
    assert run("verify", str(here), "--sample", "1") == 1
    assert "solver: z3 answers unsat to what does not hold, a claim" in capsys.readouterr().out


@pytest.mark.parametrize("given", [("verify", "nowhere"), ("verify", "."), ("manifest", "nowhere"), ("manifest", ".")])
def test_a_folder_of_no_use_is_one_line_and_code_2(
    given: tuple[str, ...], tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    assert run(*given) == 2
    error = capsys.readouterr().err
    assert len(error.splitlines()) == 1


def test_a_sample_of_certificates_is_the_one_that_its_names_draw() -> None:
    """Those whose names have the least digests; a record of as many others is told as another one."""
    some = laying_out.laid_out([("brake_watch.run_a_cycle", column) for column in columns("brake_watch.run_a_cycle")])
    inside = sorted(some, key=lambda cell: sha256(" ".join(cell).encode()).digest())
    for cells, kinds in ((inside[:4], set()), (inside[-4:], {"missing obligation", "foreign obligation"})):
        told = genuine.certified({cell: some[cell] for cell in cells}) | {"sample": 4, "of": len(some)}
        assert {found.kind for found in expected_proofs.certified(told, some) if "obligation" in found.kind} == kinds
