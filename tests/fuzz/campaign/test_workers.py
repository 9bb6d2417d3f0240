"""A worker that hangs, dies, fails or has something else is said, and the rest of the campaign is as it was."""

from __future__ import annotations

import os
import signal
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest

from fuzz.campaign.campaign import FAILED_IN_A_ROW
from fuzz.campaign.identity import identity_of
from fuzz.campaign.outcome import DONE, Outcome
from fuzz.campaign.pool import Pool
from fuzz.campaign.problems import CampaignError
from fuzz.campaign.session import Options, go_on
from fuzz.campaign.worker import work_on
from fuzz.targets.target import Batch
from models.exit_codes import DOES_NOT_HOLD, HOLDS, UNDECIDED
from tests.fuzz.campaign.quick import FAMILIES, Quick
from tests.fuzz.campaign.totals import everything

BATCHES = 12


@contextmanager
def pool_of(quick: Quick, workers: int = 2, batch_seconds: float = 60.0) -> Iterator[tuple[Pool, list[str]]]:
    said: list[str] = []
    pool = Pool(work_on([quick], identity_of([quick])), workers, batch_seconds, said.append)
    try:
        yield pool, said
    finally:
        pool.close()


def batch(number: int) -> Batch:
    return Batch("quick", number, 1, (1.0,) * len(FAMILIES))


def all_of(pool: Pool, batches: int) -> list[Outcome]:
    found: list[Outcome] = []
    while len(found) < batches:
        found += pool.wait(1.0)
    return sorted(found, key=lambda each: each.batch.number)


def unbroken(folder: Path) -> dict[str, object]:
    assert go_on(Options(folder, batches=BATCHES, workers=2), [Quick()]) == HOLDS
    return everything(folder)


@pytest.mark.parametrize(
    ("quick", "said"),
    [
        (Quick(hangs=(3,)), "batch 3 of quick hung: no result within 1 s, its process was ended; it is tried again"),
        (Quick(dies=(3,)), "batch 3 of quick died: its process ended; it is tried again"),
        (Quick(fails=(3,)), "batch 3 of quick failed: ValueError: batch 3 is no good; it is tried again"),
    ],
    ids=["hangs", "dies", "fails"],
)
def test_a_batch_that_comes_to_nothing_once_is_done_again(
    quick: Quick, said: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    expected = unbroken(tmp_path / "unbroken")
    (tmp_path / "marks").mkdir()
    told = Quick(hangs=quick.hangs, dies=quick.dies, fails=quick.fails, once=tmp_path / "marks")
    options = Options(tmp_path / "broken", batches=BATCHES, workers=2, batch_seconds=1.0)
    assert go_on(options, [told]) == HOLDS
    assert said in capsys.readouterr().err.splitlines()
    assert everything(tmp_path / "broken") == expected


@pytest.mark.parametrize(
    ("quick", "times", "how"),
    [(Quick(hangs=(3,)), 2, "hung"), (Quick(dies=(3,)), 3, "died"), (Quick(fails=(3,)), 2, "failed")],
    ids=["hangs", "dies", "fails"],
)
def test_a_batch_that_never_comes_to_anything_is_left_out(
    quick: Quick, times: int, how: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    options = Options(tmp_path, batches=BATCHES, workers=2, batch_seconds=1.0)
    assert go_on(options, [quick]) == DOES_NOT_HOLD
    told = capsys.readouterr()
    lines = [line for line in told.err.splitlines() if "batch 3 of quick" in line]
    assert len(lines) == times
    assert f"batch 3 of quick {how}" in told.out
    assert f"{times} times; it is left out" in told.out
    assert f"{BATCHES} batches, {8 * (BATCHES - 1)} traces" in told.out
    assert go_on(options, [quick]) == DOES_NOT_HOLD, "it is not tried for ever"


def test_a_process_that_someone_kills_is_replaced_and_its_batch_done() -> None:
    with pool_of(Quick(seconds=0.3)) as (pool, said):
        for number in range(6):
            pool.submit(batch(number))
        outcomes: list[Outcome] = []
        while not outcomes:
            outcomes += pool.wait(1.0)
        first = pool.processes()
        os.kill(first[0], signal.SIGKILL)
        while len(outcomes) < 6:
            outcomes += pool.wait(1.0)
        assert [each.batch.number for each in sorted(outcomes, key=lambda each: each.batch.number)] == list(range(6))
        assert all(each.status == DONE for each in outcomes)
        assert len(said) <= 1
        assert first[0] not in pool.processes()
        assert len(pool.processes()) == 2


def test_what_a_pool_gives_is_what_the_target_gives() -> None:
    quick = Quick()
    with pool_of(quick) as (pool, said):
        for number in range(5):
            pool.submit(batch(number))
        for outcome in all_of(pool, 5):
            here = quick.run(outcome.batch)
            assert outcome.result is not None
            assert (outcome.result.steps, outcome.result.covered) == (here.steps, here.covered)
    assert said == []


def test_processes_are_gone_after_closing() -> None:
    with pool_of(Quick(seconds=60.0)) as (pool, _):
        pool.submit(batch(0))
        pool.wait(0.1)
        processes = pool.processes()
        assert len(processes) == 2
    assert not any(Path(f"/proc/{process}").exists() for process in processes)


def test_a_worker_that_finds_something_else_ends_the_campaign(tmp_path: Path) -> None:
    watched = tmp_path / "watched"
    watched.write_text("as it was", "utf-8")
    quick = Quick(watched=watched)
    work = work_on([quick], identity_of([quick]))
    watched.write_text("changed", "utf-8")
    pool = Pool(work, 1, 60.0, pytest.fail)
    try:
        with pytest.raises(CampaignError, match=r"a worker found something else .*quick/watched was") as error:
            all_of(pool, 1)
        assert len(str(error.value).splitlines()) == 1
    finally:
        pool.close()


def test_a_campaign_in_which_everything_fails_ends(tmp_path: Path) -> None:
    quick = Quick(fails=tuple(range(100)))
    with pytest.raises(CampaignError, match=f"{FAILED_IN_A_ROW} batches in a row came to nothing") as error:
        go_on(Options(tmp_path, batches=100, workers=2), [quick])
    assert error.value.code == UNDECIDED
