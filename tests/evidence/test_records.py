"""What evidence comes to by the records: a record that is missing, old or short shows nothing, and says so."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from tests.evidence.samples import COMMIT, came_to, change, known, write


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    return write(tmp_path / "out")


def test_everything_holds_by_records_in_which_everything_holds(folder: Path) -> None:
    found = came_to(folder)
    assert {name: each.says for name, each in found.items() if each.verdict != "holds"} == {}
    assert found.keys() == known().keys()


@pytest.mark.parametrize("name", sorted({each.record for each in known().values()}))
def test_a_missing_record_shows_nothing_of_what_it_is_of(name: str, folder: Path) -> None:
    (folder / name).unlink()
    found = came_to(folder)
    for each in found.values():
        assert (each.verdict == "not shown") is (each.evidence.record == name)
        if each.verdict == "not shown":
            assert name in each.says
            assert each.evidence.command in each.says


@pytest.mark.parametrize("name", sorted({each.record for each in known().values()}))
@pytest.mark.parametrize("content", [b"", b"{", b"[]", b"{}", b"<a/>", b"\xff\xfe"])
def test_a_damaged_record_shows_nothing(name: str, content: bytes, folder: Path) -> None:
    (folder / name).write_bytes(content)
    assert {each.verdict for each in came_to(folder).values() if each.evidence.record == name} == {"not shown"}


def test_a_record_of_another_commit_shows_nothing_of_this_one(folder: Path) -> None:
    found = came_to(folder, commit=f"{COMMIT}+")
    assert found["ride"].verdict == "not shown"
    assert "is of commit 0123456789ab" in found["ride"].says
    assert found["check:junction.toml"].verdict == "holds", "its record does not say its commit; the manifest binds it"


def prove(folder: Path, **values: Any) -> None:
    """Change the first answer on one claim."""
    record = json.loads((folder / "prove.json").read_text("utf-8"))
    mine = next(each for each in record["obligations"] if each["invariant"] == "head_stays_inside_authority")
    mine |= values
    (folder / "prove.json").write_text(json.dumps(record), "utf-8")


@pytest.mark.parametrize(
    ("values", "verdict"),
    [
        ({"verdict": "refuted"}, "does not hold"),
        ({"verdict": "undecided"}, "not shown"),
        ({"transition": "braking.another"}, "not shown"),
        ({"solver": "yices"}, "not shown"),
    ],
)
def test_one_answer_too_few_opens_a_column(values: dict[str, Any], verdict: str, folder: Path) -> None:
    prove(folder, **values)
    found = came_to(folder)
    assert found["prove:braking.head_stays_inside_authority"].verdict == verdict
    assert found["prove:split.split_is_latched"].verdict == "holds"


@pytest.mark.parametrize("noticed", [[], [False]])
def test_nothing_is_proved_by_solvers_that_noticed_no_canary(noticed: list[bool], folder: Path) -> None:
    seen = {"canary": "a row × a claim", "solver": "z3", "solver_version": "1", "answer": "unsat"}
    change(folder / "prove.json", canaries=[{**seen, "noticed": each} for each in noticed])
    found = came_to(folder)
    assert {each.verdict for name, each in found.items() if name.startswith("prove:")} == {"not shown"}


@pytest.mark.parametrize(
    ("name", "at", "values", "verdict"),
    [
        ("ride", ("campaigns", 0), {"violated": 1}, "does not hold"),
        ("ride", ("campaigns", 0), {"rides": 0}, "not shown"),
        ("beyond", ("campaigns", 0), {"unexplained": 1}, "does not hold"),
        ("days:tram", (), {"violated": 1}, "does not hold"),
        ("days:tram", (), {"days": 0}, "not shown"),
        ("days:tram", (), {"system": "alarm"}, "not shown"),
        ("reproduce:001", ("rows", 0), {"agrees": False}, "does not hold"),
        ("reproduce:001", ("rows", 0), {"agrees": None}, "not shown"),
        ("fuzz", (), {"verdict": "does not hold"}, "does not hold"),
        ("fuzz", ("canaries", 0), {"target": None}, "not shown"),
        ("mutate", ("mutants", 0), {"became": "hole"}, "does not hold"),
        ("mutate", (), {"of": 3}, "not shown"),
        ("certify", ("obligations", 0), {"answer": "sat"}, "does not hold"),
        ("certify", ("obligations", 0), {"answer": "unknown"}, "not shown"),
        ("certify", ("obligations", 0), {"trusted": 1}, "not shown"),
        ("certify", ("obligations", 0), {"external": "incomplete"}, "not shown"),
        ("certify", ("controls", 0), {"refused": False}, "not shown"),
        ("certify", (), {"controls": []}, "not shown"),
        ("certify", (), {"of": 2}, "not shown"),
        ("check:terminus.toml", ("layouts", 4), {"verdict": "does not hold"}, "does not hold"),
        ("check:terminus.toml", ("layouts", 4), {"checked": {}}, "not shown"),
    ],
)
def test_what_does_not_hold_is_told_from_what_is_not_shown(
    name: str, at: tuple[Any, ...], values: dict[str, Any], verdict: str, folder: Path
) -> None:
    path = folder / known()[name].record
    record = json.loads(path.read_text("utf-8"))
    place = record
    for step in at:
        place = place[step]
    place |= values
    path.write_text(json.dumps(record), "utf-8")
    assert came_to(folder)[name].verdict == verdict


def test_tests_and_contracts_are_counted(folder: Path) -> None:
    xml = (folder / "test.xml").read_text("utf-8")
    (folder / "test.xml").write_text(
        xml.replace('name="test_it[split]"/>', 'name="test_it[split]"><failure/></testcase>')
    )
    (folder / "crosshair.txt").write_text("a.py:1: info: Confirmed over all paths.\na.py:9: info: Not confirmed.\n")
    found = came_to(folder)
    assert {name for name, each in found.items() if each.verdict != "holds"} == {"test", "witness:split", "crosshair"}
    assert found["witness:split"].verdict == "does not hold"
    assert found["crosshair"].verdict == "not shown"
    assert "1 of 2 conditions" in found["crosshair"].says


def test_a_failure_in_whatever_namespace_is_a_failure(folder: Path) -> None:
    xml = (folder / "test.xml").read_text("utf-8")
    failed = 'name="test_it[split]"><f:failure xmlns:f="of:nobody"/></testcase>'
    (folder / "test.xml").write_text(xml.replace('name="test_it[split]"/>', failed), "utf-8")
    assert came_to(folder)["witness:split"].verdict == "does not hold"
    assert came_to(folder)["test"].verdict == "does not hold"
