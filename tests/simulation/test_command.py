"""`heisoku simulate`: exit codes, what is printed, and refusals in one line."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from heisoku import run
from tests.simulation.lines import LAYOUTS

STATION = str(LAYOUTS / "passing_station.toml")
SHORT = ["--trains", "2", "--hours", "0.05"]


def test_it_tells_where_every_train_ended_and_how_fast_it_was(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    record = tmp_path / "line.json"
    assert run(["simulate", STATION, *SHORT, "--json", str(record)]) == 0
    told = capsys.readouterr().out
    assert "T01" in told
    assert "T02" in told
    assert "a second: holds" in told
    assert "54 invariants" in told or "invariants" in told
    found = json.loads(record.read_text())
    assert found["verdict"] == "holds"
    assert len(found["accounts"]) == 2
    assert found["occupation"]
    assert all(oracle["checked"] >= 0 for oracle in found["oracles"].values())


def test_it_tells_how_long_roads_were_closed(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    roads, record = tmp_path / "roads.toml", tmp_path / "line.json"
    roads.write_text('["Mill Road"]\nplaces = [{ track = "west", at_m = 2300 }]\n')
    assert run(["simulate", STATION, *SHORT, "--crossings", str(roads), "--json", str(record)]) == 0
    told = capsys.readouterr().out
    found = json.loads(record.read_text())["crossings"]["Mill Road"]
    assert f"crossing 'Mill Road': closed {len(found['closings'])} times for {found['closed_s']} of 180 s" in told
    assert "telegrams: " in told
    assert "delivered" in told


def test_a_timetable_that_does_not_end_is_1(capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["simulate", STATION, *SHORT, "--trips", "1"]) == 1
    assert "the timetable has not come to its end" in capsys.readouterr().out


@pytest.mark.parametrize(
    "given",
    [
        ["no.toml"],
        [STATION, "--faults", "no.toml"],
        [STATION, "--crossings", "no.toml"],
        [STATION, "--trains", "99"],
        [STATION, "--html", "/dev/null/page.html"],
        [STATION, "--each-fault", "--html", "out.html"],
    ],
)
def test_what_cannot_be_used_is_refused_in_one_line(given: list[str], capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["simulate", *given]) == 2
    told = capsys.readouterr()
    assert told.err.count("\n") == 1
    assert "Traceback" not in told.err
    assert not told.out
