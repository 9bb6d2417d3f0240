"""``heisoku replay``: exit codes, the table, the record and the page."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import heisoku
from fuzz.failures.trace import Trace, layout_file, text_of
from fuzz.targets.link import LinkRuns
from fuzz.targets.target import Batch as TargetBatch
from models.rides.campaign import RUNS_A_BATCH, Batch, ridden
from models.rides.tally import COLUMNS, VIOLATIONS
from tests.fuzz.failures.samples import LAYOUTS, failing, traffic

PLACE = "passing_station"


def written(folder: Path, trace: Trace, place: str = PLACE) -> Path:
    """A trace file as a campaign leaves it, its layout beside it."""
    for room in ("layouts", "traces"):
        (folder / room).mkdir(exist_ok=True)
    layout = folder / "layouts" / f"{place}.toml"
    layout.write_bytes(LAYOUTS[place].read_bytes())
    path = folder / "traces" / "t.json"
    path.write_text(text_of(replace(trace, layout=layout_file(layout, path.parent))), "utf-8")
    return path


def test_a_failure_is_reproduced_with_table_record_and_page(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    trace = failing()
    path, html, record = written(tmp_path, trace), tmp_path / "new" / "t.html", tmp_path / "t.r.json"
    assert heisoku.run(["replay", str(path), "--html", str(html), "--json", str(record)]) == 1
    out = capsys.readouterr().out.splitlines()
    assert out[-1] == f"reproduced: {', '.join(trace.violated)} violated after step {trace.at_step}"
    assert len([line for line in out if line.startswith(f"▶ {trace.at_step} ")]) == 1
    assert not [line for line in out if line.startswith("the trace says")]
    assert any(f"{len(trace.events)} of {len(trace.events)} steps replayed" in line for line in out)
    assert html.read_text("utf-8").startswith("<!DOCTYPE html>")
    told: dict[str, Any] = json.loads(record.read_text("utf-8"))
    assert (told["verdict"], told["reproduced"], told["as_told"]) == ("does not hold", True, True)
    assert told["violated"] == list(trace.violated)
    assert [step["step"] for step in told["steps"]] == [event.step for event in trace.events]
    assert told["steps"][-1]["violated"] == list(trace.violated)


def test_what_does_not_fail_holds(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = written(tmp_path, traffic("terminus", 1, seconds=60), "terminus")
    assert heisoku.run(["replay", str(path)]) == 0
    assert capsys.readouterr().out.splitlines()[-1].startswith("not reproduced: nothing is violated in ")


def test_a_failure_of_another_kernel_is_said_to_be_one(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    trace = replace(failing(), planted=None)
    assert heisoku.run(["replay", str(written(tmp_path, trace))]) == 0
    out = capsys.readouterr().out
    assert f"the trace says: {', '.join(trace.violated)} violated after step {trace.at_step}" in out


def test_names_cannot_move_the_cursor(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    trace = failing()
    events = tuple(replace(event, by="\x1b[2J[red]x") for event in trace.events)
    assert heisoku.run(["replay", str(written(tmp_path, replace(trace, events=events)))]) == 1
    out = capsys.readouterr().out
    assert "\x1b" not in out
    assert "[red]x" in out


@pytest.mark.parametrize(
    ("content", "said"),
    [
        (None, "No such file"),
        ("", "is empty"),
        ("{", "is not JSON"),
        ('{"format": "heisoku trace 1", "target": "interlocking"}', "has no 'layout'"),
        ('{"format": "heisoku trace 1", "target": "rides", "seed": -1, "ride": 1, "violated": []}', "seed"),
        (
            '{"format": "heisoku trace 1", "target": "rides", "seed": 1, "ride": 1, "beyond": ["x"], "violated": []}',
            "no fault 'x'",
        ),
    ],
)
def test_bad_input_is_one_line(
    content: str | None, said: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "t.json"
    if content is not None:
        path.write_text(content, "utf-8")
    assert heisoku.run(["replay", str(path)]) == 2
    complaint = capsys.readouterr().err
    assert len(complaint.splitlines()) == 1
    assert said in complaint
    assert str(path) in complaint


def test_a_layout_that_has_changed_is_bad_input(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = written(tmp_path, failing())
    layout = tmp_path / "layouts" / f"{PLACE}.toml"
    layout.write_text(layout.read_text("utf-8") + "\n", "utf-8")
    assert heisoku.run(["replay", str(path)]) == 2
    assert "has changed since" in capsys.readouterr().err


def test_a_page_that_cannot_be_written_is_said_before_the_work(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert heisoku.run(["replay", str(written(tmp_path, failing())), "--html", str(tmp_path)]) == 2
    assert "cannot be written" in capsys.readouterr().err


# ---- rides


def ride_file(folder: Path, ride: int, beyond: list[str], violated: list[str]) -> Path:
    path = folder / "ride.json"
    told = {"format": "heisoku trace 1", "target": "rides", "seed": 5, "ride": ride, "beyond": beyond}
    path.write_text(json.dumps({**told, "violated": violated, "planted": None}), "utf-8")
    return path


@pytest.mark.slow
def test_a_ride_is_ridden_again(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    rows = ridden(Batch(5, 2, 24, ("diameter_ppm",)))
    column = COLUMNS.index("front_outside")
    row = int(np.flatnonzero(rows[:, column] > 0)[0])
    violated = [name for name in VIOLATIONS if rows[row, COLUMNS.index(name)]]
    path, record = ride_file(tmp_path, 2 * RUNS_A_BATCH + row, ["diameter_ppm"], violated), tmp_path / "r.json"
    assert heisoku.run(["replay", str(path), "--json", str(record)]) == 1
    assert capsys.readouterr().out.splitlines()[-1].startswith(f"reproduced: {', '.join(violated)} violated in ride ")
    told = json.loads(record.read_text("utf-8"))
    assert list(told["tally"].values()) == rows[row].tolist()
    assert "wheel_broken" in told["broken_assumptions"]


@pytest.mark.slow
def test_a_sound_ride_holds_and_has_no_page(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = ride_file(tmp_path, 1, [], ["front_outside"])
    assert heisoku.run(["replay", str(path)]) == 0
    out = capsys.readouterr().out
    assert "the trace says: front_outside violated" in out
    assert out.splitlines()[-1].startswith("not reproduced: ")
    assert heisoku.run(["replay", str(path), "--html", str(tmp_path / "x.html")]) == 2
    assert "there is no page" in capsys.readouterr().err


# ---- the radio link


def link_file(folder: Path, **changed: object) -> Path:
    path = folder / "link.json"
    told = {"format": "heisoku trace 1", "target": "link", "seed": 1, "batch": 0, "run": 0, "weights": []}
    path.write_text(json.dumps({**told, "planted": None, "violated": [], "at_step": None, **changed}), "utf-8")
    return path


def test_a_run_of_the_link_is_played_again(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    fault = "kernel.link.after_sending: term link.sent"
    texts = LinkRuns(fault).run(TargetBatch("link", 0, 1, ())).failures
    assert texts
    path, record = tmp_path / "link.json", tmp_path / "r.json"
    path.write_text(texts[0], "utf-8")
    violated, at_step = (json.loads(texts[0])[name] for name in ("violated", "at_step"))
    assert heisoku.run(["replay", str(path), "--json", str(record)]) == 1
    out = capsys.readouterr().out
    assert out.splitlines()[-1] == f"reproduced: {', '.join(violated)} violated after step {at_step}"
    assert "the trace says" not in out
    told = json.loads(record.read_text("utf-8"))
    assert (told["violated"], told["at_step"], told["as_told"]) == (violated, at_step, True)


def test_a_sound_run_of_the_link_holds(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert heisoku.run(["replay", str(link_file(tmp_path))]) == 0
    assert capsys.readouterr().out.splitlines()[-1].startswith("not reproduced: nothing is violated in ")
    for changed, options, said in (
        ({"weights": [1.0]}, [], "threats"),
        ({"planted": {"name": "x"}}, [], "no planted fault 'x'"),
        ({}, ["--html", str(tmp_path / "x.html")], "there is no page"),
    ):
        assert heisoku.run(["replay", str(link_file(tmp_path, **changed)), *options]) == 2
        assert said in capsys.readouterr().err
