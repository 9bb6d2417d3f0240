"""Over a real Dask scheduler and real worker processes a campaign comes to what it comes to here."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
from pathlib import Path

import pytest

from fuzz.campaign.problems import CampaignError
from fuzz.campaign.session import Options, go_on
from models.exit_codes import BAD_INPUT, DOES_NOT_HOLD, HOLDS, UNDECIDED
from tests.fuzz.campaign.quick import Quick
from tests.fuzz.campaign.totals import everything, wait_for_batches
from tests.host.scheduling import needs_dask, scheduled

ROOT = Path(__file__).resolve().parents[3]
BATCHES = 60
PAUSE_S = 0.1


def program(folder: Path, address: str) -> subprocess.Popen[str]:
    words = [sys.executable, "-m", "tests.fuzz.campaign.program", str(folder), str(BATCHES), str(PAUSE_S), address]
    return subprocess.Popen(words, cwd=ROOT, text=True, stdout=subprocess.PIPE, stderr=subprocess.PIPE)


@needs_dask
@pytest.mark.slow
def test_with_a_worker_killed_mid_run_it_comes_to_what_it_comes_to_here(tmp_path: Path) -> None:
    assert go_on(Options(tmp_path / "here", batches=BATCHES, workers=2), [Quick(breaks=7)]) == DOES_NOT_HOLD
    with scheduled(tmp_path) as (address, started):
        campaign = program(tmp_path / "there", address)
        wait_for_batches(tmp_path / "there", 10)
        os.killpg(started[-1].pid, signal.SIGKILL)
        out, error = campaign.communicate(timeout=60)
    assert campaign.returncode == DOES_NOT_HOLD, error
    assert f"{BATCHES} batches" in out
    assert "Traceback" not in out + error
    assert everything(tmp_path / "there") == everything(tmp_path / "here")


@needs_dask
@pytest.mark.slow
def test_a_scheduler_that_is_gone_is_said_and_the_campaign_goes_on_without_it(tmp_path: Path) -> None:
    with scheduled(tmp_path) as (address, started):
        campaign = program(tmp_path / "there", address)
        wait_for_batches(tmp_path / "there", 5)
        os.killpg(started[0].pid, signal.SIGKILL)
        _, error = campaign.communicate(timeout=60)
    assert campaign.returncode == UNDECIDED
    assert error.splitlines()[-1].startswith(f"the scheduler at {address} is gone; start it and then the same command")
    assert "Traceback" not in error
    for folder in ("there", "here"):
        assert go_on(Options(tmp_path / folder, batches=BATCHES, workers=2), [Quick(breaks=7)]) == DOES_NOT_HOLD
    assert everything(tmp_path / "there") == everything(tmp_path / "here")


@needs_dask
@pytest.mark.slow
def test_what_hangs_or_fails_there_is_done_again_by_others(tmp_path: Path) -> None:
    marks = tmp_path / "marks"
    marks.mkdir()
    quick = Quick(hangs=(3,), dies=(5,), fails=(7,), once=marks)
    with scheduled(tmp_path) as (address, _):
        options = Options(tmp_path / "there", batches=20, scheduler=address, batch_seconds=2.0)
        assert go_on(options, [quick]) == HOLDS
    assert len(list(marks.iterdir())) == 3
    assert go_on(Options(tmp_path / "here", batches=20, workers=2), [Quick()]) == HOLDS
    assert everything(tmp_path / "there") == everything(tmp_path / "here")


@needs_dask
@pytest.mark.slow
def test_where_there_is_no_scheduler_it_is_said(tmp_path: Path) -> None:
    with pytest.raises(CampaignError, match="cannot be reached; start one with dask scheduler") as error:
        go_on(Options(tmp_path, batches=1, scheduler="tcp://127.0.0.1:9"), [Quick()])
    assert error.value.code == BAD_INPUT


def test_without_dask_it_is_said(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "distributed", None)
    with pytest.raises(CampaignError, match=r"--scheduler needs Dask, which is not installed; pip install") as error:
        go_on(Options(tmp_path, batches=1, scheduler="tcp://127.0.0.1:9"), [Quick()])
    assert error.value.code == BAD_INPUT
