"""Closed pipes, full disks, interruptions: no verdict that was not reached, and none lost that was."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import threading
import time
from concurrent.futures import Future
from io import StringIO
from multiprocessing import active_children
from pathlib import Path
from typing import Any

import pytest
import z3
from rich.table import Table

import heisoku
from models import commands
from models.layouts.export import files
from models.processes import processes
from proofs import solvers

ROOT = Path(__file__).resolve().parent.parent
LAYOUT = str(ROOT / "layouts" / "passing_station.toml")
PROGRAM = (sys.executable, str(ROOT / "heisoku_start.py"))
FULL = Path("/dev/full")


@pytest.mark.parametrize("closed", ["stdout", "stderr"])
def test_a_closed_pipe_takes_the_rest_and_the_verdict_is_the_one_reached(closed: str, tmp_path: Path) -> None:
    reads, writes = os.pipe()
    os.close(reads)
    given: dict[str, Any] = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE, closed: writes}
    record = tmp_path / "check.json"
    words = ("check", LAYOUT, str(tmp_path / "absent.toml"), "--json", str(record))
    ended = subprocess.run([*PROGRAM, *words], check=False, **given)
    os.close(writes)
    assert ended.returncode == 2
    assert json.loads(record.read_text("utf-8"))["verdict"] == "bad input"
    assert b"Traceback" not in (ended.stdout or b"") + (ended.stderr or b"")


@pytest.mark.parametrize(("closed", "code"), [(">&-", 3), ("2>&-", 0), ("<&-", 0), (">&- 2>&- <&-", 3)])
def test_a_stream_that_is_closed_from_the_start_makes_no_verdict(closed: str, code: int, tmp_path: Path) -> None:
    record = tmp_path / "check.json"
    words = " ".join(f"'{word}'" for word in (*PROGRAM, "check", LAYOUT, "--json", str(record)))
    ended = subprocess.run(["sh", "-c", f"{words} {closed}"], capture_output=True, check=False)
    assert ended.returncode == code
    assert json.loads(record.read_text("utf-8"))["verdict"] == "holds"
    assert b"Traceback" not in ended.stderr
    assert (b"standard output is closed" in ended.stderr) == (closed == ">&-")


@pytest.mark.parametrize("words", [("-O",), ("-OO",)])
def test_without_assertions_nothing_is_said(words: tuple[str, ...]) -> None:
    ended = subprocess.run([PROGRAM[0], *words, PROGRAM[1], "check", LAYOUT], capture_output=True, check=False)
    assert (ended.returncode, ended.stdout, len(ended.stderr.splitlines())) == (3, b"", 1)


@pytest.mark.parametrize("layout", [LAYOUT, "none.toml"])
def test_where_python_goes_on_afterwards_nothing_is_said(layout: str) -> None:
    """The exit code of the program would be lost: 0 at a terminal, 1 elsewhere."""
    given = {**os.environ, "PYTHONINSPECT": "1"}
    ended = subprocess.run([*PROGRAM, "check", layout], capture_output=True, check=False, env=given, input=b"")
    assert (ended.returncode, ended.stdout, len(ended.stderr.splitlines())) == (3, b"", 1)


@pytest.mark.skipif(not FULL.exists(), reason="no device here that is always full")
def test_a_full_disk_under_standard_output_decides_nothing() -> None:
    with FULL.open("wb") as full:
        ended = subprocess.run([*PROGRAM, "check", LAYOUT], stdout=full, stderr=subprocess.PIPE, check=False)
    assert ended.returncode == 3
    assert len(ended.stderr.splitlines()) == 1
    assert b"standard output" in ended.stderr


@pytest.mark.skipif(not FULL.exists(), reason="no device here that is always full")
def test_a_record_that_cannot_be_written_is_one_line_and_undecided(capsys: pytest.CaptureFixture[str]) -> None:
    assert heisoku.run(["check", LAYOUT, "--json", str(FULL)]) == 3
    assert len(capsys.readouterr().err.splitlines()) == 1
    assert FULL.is_char_device()


def test_a_record_is_written_into_a_pipe_with_a_name(tmp_path: Path) -> None:
    pipe, read = tmp_path / "pipe", []
    os.mkfifo(pipe)
    reader = threading.Thread(target=lambda: read.append(pipe.read_text("utf-8")))
    reader.start()
    assert heisoku.run(["check", LAYOUT, "--json", str(pipe)]) == 0
    reader.join()
    assert pipe.is_fifo()
    assert json.loads(read[0])["verdict"] == "holds"


def test_a_link_stays_and_what_it_names_is_written(tmp_path: Path) -> None:
    (tmp_path / "elsewhere").mkdir()
    link, target = tmp_path / "check.json", tmp_path / "elsewhere" / "kept.json"
    link.symlink_to(target)
    assert heisoku.run(["check", LAYOUT, "--json", str(link)]) == 0
    assert link.is_symlink()
    assert json.loads(target.read_text("utf-8"))["verdict"] == "holds"


def test_a_dash_is_standard_output_and_the_record_stands_alone(capsys: pytest.CaptureFixture[str]) -> None:
    assert heisoku.run(["check", LAYOUT, "--json", "-"]) == 0
    told = capsys.readouterr()
    assert json.loads(told.out)["verdict"] == "holds"
    assert "1 layouts, " in told.err
    assert heisoku.run(["check", LAYOUT]) == 0
    assert "1 layouts, " in capsys.readouterr().out


# ---- interruptions


def hears_interruptions(_: int) -> bool:
    """Whether this process can be interrupted."""
    return signal.SIGINT not in signal.pthread_sigmask(signal.SIG_BLOCK, [])


def test_no_process_that_asks_solvers_hears_an_interruption() -> None:
    with processes(1) as pool:
        assert pool.submit(hears_interruptions, 0).result() is False
    assert hears_interruptions(0)


def begin_and_be_interrupted(begun: list[Future[None]]) -> None:
    with processes(1) as pool:
        begun.append(pool.submit(time.sleep, 86_400))
        while not begun[0].running():
            time.sleep(0.01)
        raise KeyboardInterrupt


def test_what_is_under_way_is_ended_with_the_command() -> None:
    begun: list[Future[None]] = []
    with pytest.raises(KeyboardInterrupt):
        begin_and_be_interrupted(begun)
    assert begun[0].exception() is not None
    assert active_children() == []


def test_a_solver_leaves_an_interruption_to_the_program() -> None:
    """As z3 would have it, it ends its search, answers *unknown*, and nobody else hears of it."""
    heard: list[int] = []
    before = signal.signal(signal.SIGINT, lambda number, _: heard.append(number))
    sender = threading.Timer(0.1, os.kill, (os.getpid(), signal.SIGINT))
    x, y, z = z3.Ints("x y z")
    solver = z3.Solver()
    solver.add(x**3 + y**3 + z**3 == 114, x > 1_000, y < -1_000)
    try:
        sender.start()
        answer, _ = solvers._ask_z3_once(solver, 0)
        sender.join()
        while not heard:
            time.sleep(0.01)
    finally:
        signal.signal(signal.SIGINT, before)
    assert answer == "unknown"
    assert heard == [signal.SIGINT]
    assert "interrupted" not in solver.reason_unknown()


# ---- what is printed is what was meant


def test_nothing_of_ours_is_markup() -> None:
    text = StringIO()
    out = commands.console(text)
    table = Table("days:tram:", title="a [bold]title[/bold]")
    table.add_row(":train: [red]x[/red]")
    out.print(table)
    out.print("route :bell: [1]")
    for words in ("days:tram:", "a [bold]title[/bold]", ":train: [red]x[/red]", "route :bell: [1]"):
        assert words in text.getvalue()


def test_off_a_terminal_progress_is_a_line_now_and_then(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(commands, "SECONDS_A_LINE", 0.01)
    told = ""
    with commands.progress("proving") as step:
        step(3, 1_200, "braking.init")
        while "3 of 1,200 braking.init" not in told:
            time.sleep(0.01)
            told += capsys.readouterr().err
    capsys.readouterr()
    time.sleep(0.05)
    assert capsys.readouterr().err == ""
    assert all(line.startswith("proving: ") for line in told.splitlines())


def test_an_export_that_lacks_a_file_is_not_0(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    assert heisoku.run(["export", LAYOUT, "-o", str(tmp_path)]) == 0
    whole = files.written
    monkeypatch.setattr(files, "written", lambda *given: list(whole(*given))[:-1])
    assert heisoku.run(["export", LAYOUT, "-o", str(tmp_path)]) == 1
    assert "8 files written, 1 not" in capsys.readouterr().out
