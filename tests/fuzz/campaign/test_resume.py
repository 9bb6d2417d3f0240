"""A campaign that is killed and gone on with comes to what an unbroken one comes to."""

from __future__ import annotations

import os
import random
import signal
import subprocess
import sys
import time
from multiprocessing import get_context
from multiprocessing.process import BaseProcess
from pathlib import Path

import pytest

from fuzz.campaign.campaign import Plan, run
from fuzz.campaign.identity import BATCHES_A_ROUND, identity_of
from fuzz.campaign.pool import Pool
from fuzz.campaign.problems import CampaignError
from fuzz.campaign.session import Options, go_on
from fuzz.campaign.store import Store
from fuzz.campaign.worker import work_on
from models.exit_codes import UNDECIDED
from tests.fuzz.campaign.program import main
from tests.fuzz.campaign.quick import Quick
from tests.fuzz.campaign.totals import batches_in, everything, wait_for_batches

ROOT = Path(__file__).resolve().parents[3]
BATCHES = 400
KILLED = 20
PAUSE_S = 0.02


def started(folder: Path, batches: int) -> subprocess.Popen[str]:
    words = [sys.executable, "-m", "tests.fuzz.campaign.program", str(folder), str(batches), str(PAUSE_S)]
    return subprocess.Popen(words, cwd=ROOT, text=True, stdout=subprocess.PIPE, stderr=subprocess.PIPE)


def children_of(process: int) -> set[int]:
    return {int(word) for word in Path(f"/proc/{process}/task/{process}/children").read_text("utf-8").split()}


@pytest.mark.slow
def test_killed_at_twenty_random_moments_it_comes_to_the_same(tmp_path: Path) -> None:
    """Some moments are in the starting up, most a while after at least one more batch was finished."""
    context = get_context("forkserver")
    context.set_forkserver_preload(["tests.fuzz.campaign.program"])

    def begun(folder: Path) -> BaseProcess:
        process = context.Process(target=main, args=(str(folder), str(BATCHES), str(PAUSE_S)))
        process.start()
        return process

    moments = random.Random(4)
    grown = [0]
    for number in range(KILLED):
        process = begun(tmp_path / "broken")
        if number % 5 == 0:
            time.sleep(moments.uniform(0.0, 0.5))
        else:
            wait_for_batches(tmp_path / "broken", grown[-1] + 1)
            time.sleep(moments.uniform(0.0, 0.1))
        process.kill()
        process.join()
        grown.append(batches_in(tmp_path / "broken"))
    assert grown == sorted(grown)
    assert len(set(grown)) > KILLED // 2, grown
    assert grown[-1] < BATCHES, "it was killed each time"
    for folder in ("broken", "unbroken"):
        process = begun(tmp_path / folder)
        process.join(60)
    assert everything(tmp_path / "broken") == everything(tmp_path / "unbroken")
    assert batches_in(tmp_path / "broken") == BATCHES


def test_workers_end_with_a_campaign_that_is_killed(tmp_path: Path) -> None:
    process = started(tmp_path, 10_000)
    wait_for_batches(tmp_path)
    workers = children_of(process.pid)
    assert len(workers) >= 2
    process.kill()
    process.communicate()
    until = time.monotonic() + 20
    while any(Path(f"/proc/{worker}").exists() for worker in workers):
        assert time.monotonic() < until
        time.sleep(0.05)


@pytest.mark.sampled(2)
@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_an_interrupted_campaign_says_how_to_go_on_and_keeps_what_is_finished(
    tmp_path: Path, number: signal.Signals
) -> None:
    process = started(tmp_path, 10_000)
    wait_for_batches(tmp_path)
    os.kill(process.pid, number)
    out, error = process.communicate(timeout=20)
    assert process.returncode == UNDECIDED
    assert "undecided" in out
    assert "interrupted, what was finished is kept; the same command goes on with it" in error
    assert "Traceback" not in out + error
    assert batches_in(tmp_path) > 0


def test_more_workers_come_to_the_same(tmp_path: Path) -> None:
    for workers in (1, 3):
        options = Options(tmp_path / str(workers), batches=3 * BATCHES_A_ROUND, workers=workers)
        assert go_on(options, [Quick(seconds=0.001)]) == 0
    assert everything(tmp_path / "1") == everything(tmp_path / "3")


def test_a_campaign_is_gone_on_with_to_more_batches(tmp_path: Path) -> None:
    for batches in (5, 50, 50):
        assert go_on(Options(tmp_path / "grown", batches=batches, workers=1), [Quick()]) == 0
    assert go_on(Options(tmp_path / "whole", batches=50, workers=1), [Quick()]) == 0
    assert everything(tmp_path / "grown") == everything(tmp_path / "whole")


def test_hours_end_a_campaign(tmp_path: Path) -> None:
    quick = Quick(seconds=0.01)
    with Store(tmp_path) as store:
        store.agree(identity_of([quick]))
        pool = Pool(work_on([quick], store.identity()), 1, 60.0, pytest.fail)
        try:
            before = time.monotonic()
            run(store, [quick], Plan(seed=1, seconds=2.0), pool)
            assert 2.0 <= time.monotonic() - before < 10.0
        finally:
            pool.close()
        assert store.totals()["quick"].batches > 1


def test_only_one_campaign_runs_in_a_folder(tmp_path: Path) -> None:
    with Store(tmp_path), pytest.raises(CampaignError, match="another campaign is running there"):
        go_on(Options(tmp_path, batches=1), [Quick()])
