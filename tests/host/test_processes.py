"""Work spread over processes comes back whole, and no process outlives whoever started it."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from models.processes import as_they_end, processes, spread

ROOT = Path(__file__).resolve().parents[2]
LONG_S = 600.0
PATIENCE_S = 60.0
PROGRAM = """
import sys
from pathlib import Path
from models.processes import {way}
from tests.host.test_processes import work_long
if __name__ == "__main__":
    list({way}(work_long, [Path(each) for each in sys.argv[1:]], 2))
"""


def work_long(note: Path) -> None:
    """Tell which process works, then work for long."""
    beside = note.with_suffix(".part")
    beside.write_text(str(os.getpid()))
    beside.replace(note)
    time.sleep(LONG_S)


FIRST = """
from tests.host.test_processes import say_whether_interrupted
from models.processes import Uninterrupted
if __name__ == "__main__":
    for _ in range(2):
        process = Uninterrupted(target=say_whether_interrupted)
        process.start()
        process.join()
"""


def say_whether_interrupted() -> None:
    print(signal.SIGINT in signal.pthread_sigmask(signal.SIG_BLOCK, []), flush=True)


def square(number: int) -> int:
    return number * number


def process_of(_: int) -> int:
    return os.getpid()


def is_there(process: int) -> bool:
    """Whether a process goes on; one that has ended and that nobody has asked for does not."""
    try:
        return Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()[0] != "Z"
    except FileNotFoundError:
        return False


def waited_for(notes: list[Path]) -> list[int]:
    until = time.monotonic() + PATIENCE_S
    while not all(note.exists() for note in notes):
        assert time.monotonic() < until, "the work has not begun"
        time.sleep(0.05)
    return [int(note.read_text()) for note in notes]


def test_not_even_the_first_process_of_a_program_hears_an_interruption(tmp_path: Path) -> None:
    program = tmp_path / "first.py"
    program.write_text(FIRST)
    environment = os.environ | {"PYTHONPATH": str(ROOT)}
    told = subprocess.run(
        [sys.executable, program], env=environment, text=True, capture_output=True, timeout=PATIENCE_S, check=False
    )
    assert (told.stdout.split(), told.stderr) == (["True", "True"], "")


@pytest.mark.parametrize("way", ["spread", "as_they_end"])
def test_killed_whoever_started_them_they_end(way: str, tmp_path: Path) -> None:
    """SIGKILL leaves no time to end them: they notice for themselves, in the midst of their work."""
    notes = [tmp_path / "first", tmp_path / "second"]
    program = tmp_path / "program.py"
    program.write_text(PROGRAM.format(way=way))
    around = dict(os.environ, PYTHONPATH=str(Path(__file__).parents[2]))
    with subprocess.Popen([sys.executable, program, *notes], env=around) as started:
        try:
            workers = waited_for(notes)
            assert all(map(is_there, workers))
        finally:
            started.kill()
    until = time.monotonic() + PATIENCE_S
    while any(map(is_there, workers)):
        assert time.monotonic() < until, f"some of {workers} work on for nobody"
        time.sleep(0.05)


@pytest.mark.parametrize("jobs", [1, 2])
def test_all_is_done_and_in_order_where_that_is_said(jobs: int) -> None:
    numbers = list(range(20))
    assert list(spread(square, numbers, jobs)) == [number * number for number in numbers]
    assert sorted(as_they_end(square, numbers, jobs)) == [number * number for number in numbers]
    assert list(spread(square, [], jobs)) == []


@pytest.mark.parametrize(("jobs", "todo"), [(1, 3), (2, 3), (2, 1)])
def test_one_each_has_a_process_of_its_own_however_few_there_are(jobs: int, todo: int) -> None:
    found = list(as_they_end(process_of, range(todo), jobs, one_each=True))
    assert len({os.getpid(), *found}) == todo + 1


def test_what_has_not_begun_is_not_begun() -> None:
    """Whoever has enough leaves, and does not wait for thousands of pieces of work."""
    with processes(1) as pool:
        going = [pool.submit(time.sleep, 0.1) for _ in range(5_000)]
        going[0].result()
    assert sum(each.cancelled() for each in going) > 4_900


def test_who_asks_for_no_more_ends_it() -> None:
    """What comes of the first is enough: the rest is not done."""
    began = time.monotonic()
    for way in (spread, as_they_end):
        assert next(way(time.sleep, [0.1] * 5_000, 2)) is None
    assert time.monotonic() - began < PATIENCE_S
