"""`heisoku fuzz`: its exit codes, one line for what is wrong, what it shows while it runs and at its end."""

from __future__ import annotations

import json
import os
import pty
import re
import subprocess
import sys
from pathlib import Path

import pytest

import heisoku
from fuzz.campaign import session, view
from fuzz.campaign.problems import CampaignError
from fuzz.campaign.store import Store
from models.exit_codes import BAD_INPUT, DOES_NOT_HOLD, HOLDS
from tests.fuzz.campaign.quick import Quick

ROOT = Path(__file__).resolve().parents[3]
STATION = str(ROOT / "layouts" / "passing_station.toml")


@pytest.fixture
def quick(monkeypatch: pytest.MonkeyPatch) -> None:
    """Offer targets that take milliseconds beside the others."""
    more = {"quick": lambda layouts: [Quick()], "broken": lambda layouts: [Quick("broken", breaks=4)]}
    monkeypatch.setattr(session, "OFFERED", {**session.OFFERED, **more})


@pytest.mark.parametrize(
    ("words", "says"),
    [
        (["--batches", "1"], "--out is missing; name the campaign's folder"),
        (["--out", "{}"], "how long is not said; give --hours H, or --batches N"),
        (["--out", "{}", "--hours", "0"], "--hours 0: is no time"),
        (["--out", "{}", "--batches", "0"], "--batches"),
        (["--out", "{}", "--batches", "1", "--target", "sheep"], "--target sheep: there is no such target; one of"),
        (["{}/none.toml", "--out", "{}", "--batches", "1", "--target", "rides"], "runs on no layout; leave it out"),
        (
            ["--out", "{}", "--batches", "1", "--target", "rides", "--json", "{}"],
            "cannot be written; name another file",
        ),
        (["--merge", "{}", "--out", "{}/both"], "--merge needs two folders of campaigns or more"),
        (["--merge", "{}/one", "{}/other", "--out", "{}/both"], "one: holds no campaign"),
        (
            ["--out", "/dev/null/campaign", "--batches", "1", "--target", "rides"],
            "/dev/null/campaign: cannot be written",
        ),
    ],
)
def test_what_is_wrong_is_said_in_one_line(
    words: list[str], says: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert heisoku.run(["fuzz", *(word.format(tmp_path) for word in words)]) == BAD_INPUT
    error = capsys.readouterr().err
    assert says in error
    assert len(error.splitlines()) == 1
    assert not (tmp_path / "both").exists()


@pytest.mark.usefixtures("quick")
def test_a_campaign_shows_what_it_came_to_and_writes_its_record(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    record, folder = tmp_path / "new" / "night.json", tmp_path / "night"
    words = ["fuzz", "--target", "quick", "--target", "broken", "--batches", "20", "--seed", "7", "--workers", "2"]
    assert heisoku.run([*words, "--out", str(folder), "--json", str(record)]) == DOES_NOT_HOLD
    out = capsys.readouterr().out
    assert "quick: the last tenth of the steps added" in out
    assert f"heisoku replay {folder}/traces/no_two_trains-" in out
    assert out.splitlines()[-1].startswith("40 batches, 320 traces, ")
    assert out.splitlines()[-1].endswith(" steps with seed 7, 5 failures of 1 causes: does not hold")
    assert (folder / "coverage.png").read_bytes().startswith(b"\x89PNG")
    found = json.loads(record.read_text("utf-8"))
    assert found["verdict"] == "does not hold"
    assert found["seeds"] == [7]
    assert found["identity"]["broken/families"] == "loss, delay, restart"
    assert found["targets"]["quick"]["batches"] == found["targets"]["broken"]["batches"] == 20
    assert found["targets"]["broken"]["failures"] == found["failures"][0]["times"] == 5
    assert Path(found["failures"][0]["trace"]).exists()
    assert "versions" in found["starts"][0]
    with Store(folder) as store:
        assert found["targets"]["quick"]["counts"] == store.counts("quick")


@pytest.mark.usefixtures("quick")
def test_two_targets_of_one_name_are_not_mixed_up(tmp_path: Path) -> None:
    with pytest.raises(CampaignError, match="quick: is to be run twice; name each layout once"):
        session.go_on(session.Options(tmp_path, batches=1), [Quick(), Quick(breaks=2)])


@pytest.mark.usefixtures("quick")
def test_merged_campaigns_show_what_they_come_to(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    for seed in ("1", "2"):
        words = ["fuzz", "--target", "quick", "--batches", "3", "--seed", seed, "--out", str(tmp_path / seed)]
        assert heisoku.run(words) == HOLDS
    capsys.readouterr()
    words = ["fuzz", "--merge", str(tmp_path / "1"), str(tmp_path / "2"), "--out", str(tmp_path / "both")]
    assert heisoku.run(words) == HOLDS
    last = capsys.readouterr().out.splitlines()[-1]
    assert last.startswith("6 batches, 48 traces, ")
    assert last.endswith(" steps with seeds 1, 2, 0 failures of 0 causes: holds")


@pytest.mark.usefixtures("quick")
def test_where_there_is_no_terminal_a_line_now_and_then_says_how_it_stands(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(view, "LINE_EVERY_S", 0.0)
    assert heisoku.run(["fuzz", "--target", "quick", "--hours", "0.001", "--out", str(tmp_path)]) == HOLDS
    lines = capsys.readouterr().err.splitlines()
    assert len(lines) > 1
    assert re.match(r"0:00:0\d of 0:00:03 quick: ", lines[-1])
    for told in (" batches, ", " traces, ", " steps/s, ", " distinct states, ", " tuples, ", " 0 failures"):
        assert told in lines[-1]


def test_on_a_terminal_a_table_stays_in_its_place(tmp_path: Path) -> None:
    ours, theirs = pty.openpty()
    words = [sys.executable, "-m", "tests.fuzz.campaign.program", str(tmp_path), "60", "0.05"]
    environment = {**os.environ, "TERM": "xterm-256color", "COLUMNS": "120", "LINES": "40"}
    process = subprocess.Popen(words, cwd=ROOT, stdout=theirs, stderr=theirs, env=environment)
    os.close(theirs)
    shown = b""
    try:
        while part := os.read(ours, 4096):
            shown += part
    except OSError:
        pass  # the other end is closed
    os.close(ours)
    assert process.wait(30) == DOES_NOT_HOLD
    text = shown.decode("utf-8")
    assert "steps/s" in text
    assert "0:00:0" in text
    assert "\x1b[1A" in text, "it is drawn over itself"
    assert "Traceback" not in text


@pytest.mark.slow
def test_rides_are_a_campaign_too(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    words = ["fuzz", "--target", "rides", "--workers", "1", "--out", str(tmp_path)]
    assert heisoku.run([*words, "--batches", "1"]) == HOLDS
    assert "1 batches, 64 traces" in capsys.readouterr().out
    assert heisoku.run([*words, "--batches", "1"]) == HOLDS
    assert "1 batches, 64 traces" in capsys.readouterr().out
