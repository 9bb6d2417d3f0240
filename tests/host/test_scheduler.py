"""Over a real Dask scheduler a proof comes to what it comes to here, or it says in one line why not."""

from __future__ import annotations

import json
import os
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path
from typing import Any

import pytest

from models.exit_codes import BAD_INPUT, HOLDS, UNDECIDED
from models.processes import Workers, as_they_end, number, spread
from models.scheduler import SchedulerError, scheduled
from tests.host import scheduling
from tests.host.scheduling import ROOT, needs_dask
from tests.host.test_processes import square

PATIENCE_S = 300
ASKED = r"^(display|brake_watch)\."
CAMPAIGN = ("--batches", "1", "--out", "out/campaign", "--scheduler")
OF_THE_PROCESS = ("process", "seconds", "rlimit_spent")


def heisoku(*words: str, cwd: Path = ROOT) -> subprocess.CompletedProcess[str]:
    command = [sys.executable, "heisoku_start.py", *words]
    return subprocess.run(command, cwd=cwd, text=True, capture_output=True, check=False, timeout=PATIENCE_S)


def answered(record: Path) -> list[dict[str, Any]]:
    """What a record says of each obligation, but for what differs from process to process."""
    told = json.loads(record.read_text("utf-8"))["obligations"]
    return [{name: value for name, value in each.items() if name not in OF_THE_PROCESS} for each in told]


def alike() -> str:
    return "the same"


def this_process() -> str:
    return str(os.getpid())


def wait_and_square(number: int) -> int:
    time.sleep(1.0)
    return number * number


def wait_and_tell_numbers(_: int) -> tuple[int, int]:
    time.sleep(0.5)
    return os.getpid(), number()


def fail(number: int) -> int:
    raise ValueError(f"{number} cannot be done")


@needs_dask
def test_a_proof_is_the_same_over_a_scheduler(tmp_path: Path) -> None:
    here, there = tmp_path / "here.json", tmp_path / "there.json"
    words = ("prove", "--only", ASKED, "--solver", "both")
    assert heisoku(*words, "--jobs", "2", "--json", str(here)).returncode == HOLDS
    with scheduling.scheduled(tmp_path) as (address, _):
        ended = heisoku(*words, "--scheduler", address, "--json", str(there))
    assert ended.returncode == HOLDS, ended.stderr
    assert len(answered(there)) > 40
    assert answered(there) == answered(here)
    seen = json.loads(there.read_text("utf-8"))["canaries"]
    assert {each["noticed"] for each in seen} == {True}
    assert len({each["process"] for each in seen}) == 2


@needs_dask
@pytest.mark.slow
def test_mutants_become_the_same_over_a_scheduler(tmp_path: Path) -> None:
    here, there = tmp_path / "here.json", tmp_path / "there.json"
    words = ("mutate", "--only", r"^kernel\.onboard\.split\.is_intact")
    copy = copied(tmp_path / "sources")
    assert heisoku(*words, "--json", str(here), cwd=copy).returncode == HOLDS
    shutil.rmtree(copy / "out")
    with scheduling.scheduled(tmp_path, sources=copy) as (address, _):
        ended = heisoku(*words, "--scheduler", address, "--json", str(there), cwd=copy)
    assert ended.returncode == HOLDS, ended.stderr
    one, other = (
        [{**each, "seconds": 0} for each in json.loads(path.read_text("utf-8"))["mutants"]] for path in (here, there)
    )
    assert len(one) > 2
    assert one == other


@needs_dask
@pytest.mark.slow
def test_a_worker_with_other_sources_answers_nothing(tmp_path: Path) -> None:
    copy = copied(tmp_path / "sources")
    changed = copy / "kernel" / "onboard" / "brake_watch.py"
    changed.write_text(changed.read_text("utf-8") + "\n", "utf-8")
    with scheduling.scheduled(tmp_path, sources=copy) as (address, _):
        ended = heisoku("prove", "--only", ASKED, "--scheduler", address, "--json", str(tmp_path / "there.json"))
    assert ended.returncode == BAD_INPUT
    assert ended.stderr.splitlines()[-1].startswith(f"a worker of {address} has other sources or versions than these")
    assert not (tmp_path / "there.json").exists()


@needs_dask
@pytest.mark.slow
def test_a_worker_that_is_older_than_its_sources_answers_nothing(tmp_path: Path) -> None:
    """It has loaded the kernel when a bound of it is changed; its files are then the same as those of who asks."""
    copy, asked = copied(tmp_path / "sources"), r"^brake_watch\.run_a_cycle "
    with scheduling.scheduled(tmp_path, workers=1, sources=copy) as (address, _):
        words = ("prove", "--only", asked, "--scheduler", address, "--json", str(tmp_path / "there.json"))
        first = heisoku(*words, cwd=copy)
        assert first.returncode == HOLDS, first.stderr
        bounds = copy / "kernel" / "onboard" / "arithmetic.py"
        text = bounds.read_text("utf-8")
        assert "\nSHORTEST_CYCLE_MS = 98\n" in text
        bounds.write_text(text.replace("\nSHORTEST_CYCLE_MS = 98\n", "\nSHORTEST_CYCLE_MS = 9_800\n"), "utf-8")
        told = [heisoku(*words, cwd=copy), heisoku("fuzz", "--target", "link", *CAMPAIGN, address, cwd=copy)]
    assert [each.returncode for each in told] == [BAD_INPUT, BAD_INPUT], told
    assert ["start it anew" in each.stderr.splitlines()[-1] for each in told] == [True, True], told


def test_a_worker_whose_sources_change_while_it_works_answers_nothing(tmp_path: Path) -> None:
    """What it loads in the middle of a piece of work would be of one age, and what it has loaded of another."""
    copy = copied(tmp_path / "sources")
    script = """
from pathlib import Path
from models.scheduler import done_alike

def work(name):
    if name:
        Path(name).write_text(Path(name).read_text("utf-8") + "\\n", "utf-8")
    return "done"

for name in ("", "kernel/onboard/arithmetic.py", ""):
    print(done_alike(work, name, lambda: "the same", "the same") == "done")
"""
    told = subprocess.run([sys.executable, "-c", script], cwd=copy, text=True, capture_output=True, check=True)
    assert told.stdout.split() == ["True", "False", "False"]


@needs_dask
@pytest.mark.slow
def test_work_comes_back_whole_though_a_worker_is_killed(tmp_path: Path) -> None:
    numbers = list(range(12))
    with scheduling.scheduled(tmp_path) as (address, started), scheduled(address, alike) as crew:
        workers: Workers = crew
        found = spread(wait_and_square, numbers, workers)
        assert next(found) == 0
        os.killpg(started[-1].pid, signal.SIGKILL)
        assert list(found) == [each * each for each in numbers[1:]]
        assert sorted(as_they_end(square, numbers, workers)) == [each * each for each in numbers]
        with pytest.raises(SchedulerError, match="failed: ValueError: 3 cannot be done") as error:
            list(spread(fail, [3], workers))
        assert error.value.code == UNDECIDED


@needs_dask
@pytest.mark.slow
@pytest.mark.parametrize("way", [spread, as_they_end])
def test_a_scheduler_that_is_gone_is_said(way: Any, tmp_path: Path) -> None:
    with scheduling.scheduled(tmp_path) as (address, started), scheduled(address, alike) as crew:
        found = way(wait_and_square, list(range(40)), crew)
        next(found)
        os.killpg(started[0].pid, signal.SIGKILL)
        with pytest.raises(SchedulerError, match="is gone; start it and then the same command") as error:
            list(found)
    assert error.value.code == UNDECIDED


@needs_dask
@pytest.mark.slow
def test_a_process_that_says_otherwise_of_itself_is_not_believed(tmp_path: Path) -> None:
    with (
        scheduling.scheduled(tmp_path) as (address, _),
        scheduled(address, this_process) as crew,
        pytest.raises(SchedulerError, match="has other sources or versions"),
    ):
        list(spread(square, [1], crew))


@needs_dask
@pytest.mark.slow
def test_no_two_processes_of_other_machines_have_one_number(tmp_path: Path) -> None:
    """Numbers of the system may be the same on two of them, so it is none of these."""
    with scheduling.scheduled(tmp_path) as (address, _), scheduled(address, alike) as crew:
        told = set(spread(wait_and_tell_numbers, range(8), crew))
    assert len(told) == len({one for one, _ in told}) == len({other for _, other in told}) == 2
    assert {one for one, _ in told}.isdisjoint(other for _, other in told)


@needs_dask
def test_where_there_is_no_scheduler_a_proof_says_so() -> None:
    ended = heisoku("prove", "--only", ASKED, "--scheduler", "tcp://127.0.0.1:9")
    assert ended.returncode == BAD_INPUT
    assert (
        ended.stderr.splitlines()[-1]
        == "--scheduler tcp://127.0.0.1:9: cannot be reached; start one with dask scheduler, or leave it out"
    )


def test_texts_are_not_kept_by_processes_elsewhere() -> None:
    ended = heisoku("prove", "--scheduler", "tcp://127.0.0.1:9", "--keep", "texts")
    assert (ended.returncode, ended.stdout) == (BAD_INPUT, "")
    assert ended.stderr.startswith("--keep: processes of other machines write no files here")


def copied(to: Path) -> Path:
    """The sources, apart from everything that was made of them."""
    shutil.copytree(ROOT, to, ignore=shutil.ignore_patterns("out", ".git", ".venv", "__pycache__", ".*_cache"))
    return to
