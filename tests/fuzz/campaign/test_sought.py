"""Canaries: one of each kind, found by the campaign's own targets; a campaign that misses one says so."""

from __future__ import annotations

import signal
from dataclasses import replace
from pathlib import Path

import pytest

from fuzz.campaign import session
from fuzz.campaign.problems import CampaignError
from fuzz.campaign.session import Options, go_on, put_together
from fuzz.campaign.sought import Sought, carriers, hunted, in_words
from fuzz.campaign.store import Store
from fuzz.campaign.summary import verdict
from fuzz.planted.canaries import KINDS, NOTHING_SHOWN, canaries, findable
from fuzz.targets.link import LinkRuns
from fuzz.targets.rides import Rides
from fuzz.targets.target import Batch, Result, Target
from fuzz.targets.walks import Walks
from models.exit_codes import HOLDS, UNDECIDED
from tests.fuzz.campaign.quick import Quick

SEED = 1
BATCHES = 12


def test_every_kind_has_faults_to_draw() -> None:
    assert all(names for names in findable().values())
    drawn = canaries(SEED)
    assert [canary.kind for canary in drawn] == [kind.name for kind in KINDS]
    assert drawn == canaries(SEED)
    assert len({canaries(seed) for seed in range(5)}) > 1


@pytest.mark.parametrize("kind", ["first loop", "third loop", "on board"])
def test_walks_find_a_canary_and_the_sound_kernel_has_no_failures(kind: str) -> None:
    canary = next(each for each in canaries(SEED) if each.kind == kind)
    (target,) = carriers([Walks()], canary)
    found = hunted(kind, canary.name, [target], SEED, most=BATCHES)
    assert (found.target, found.kind, found.fault) == ("walks", kind, canary.name)
    assert found.batches <= BATCHES
    sound = replace(target, fault=None)  # type: ignore[type-var]
    assert not sound.run(Batch("walks", 0, SEED, ())).failures


class Blind(Quick):
    """A target that takes a fault and sees nothing of it."""

    def with_fault(self, theory: str, fault: str) -> Target:
        """Itself."""
        return self

    def run(self, batch: Batch) -> Result:
        """As ever."""
        return super().run(replace(batch, weights=batch.weights or tuple(1.0 for _ in self.families())))


def test_a_target_carries_only_what_it_runs() -> None:
    drawn = {canary.kind: canary for canary in canaries(SEED)}
    assert carriers([Rides(), LinkRuns()], drawn["on board"]) == []
    assert [each.name for each in carriers([Rides(), Walks()], drawn["on board"])] == ["walks"]


def test_a_campaign_that_misses_its_canaries_is_worth_nothing(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    missed = hunted("first loop", "some fault", [Blind()], SEED, most=3)
    assert missed == replace(missed, target="", batches=3)
    with Store(tmp_path) as store:
        store.note_canaries(SEED, [missed])
    assert go_on(Options(tmp_path, seed=SEED, batches=2), [Quick()]) == UNDECIDED
    assert NOTHING_SHOWN in " ".join(capsys.readouterr().out.split())
    found = replace(missed, target="walks")
    assert "1 of 2" in in_words([missed, replace(found, kind="points")])
    assert in_words([found]).startswith("all 1 canaries found")
    assert "no canary" in in_words([])


@pytest.fixture
def carrying(monkeypatch: pytest.MonkeyPatch) -> list[Sought]:
    """Campaigns that carry one canary; whoever seeks it appends what becomes of it."""
    came_to: list[Sought] = []
    monkeypatch.setattr(session, "unsought", lambda targets, seed: [Sought("points", "some fault", "", 0, 0.0)])
    monkeypatch.setattr(session, "seek", lambda targets, seed, workers: came_to)
    return came_to


FOUND = Sought("points", "some fault", "walks", 2, 0.1)


def test_a_canary_not_sought_yet_is_not_found_and_is_sought_when_the_campaign_goes_on(
    tmp_path: Path, carrying: list[Sought]
) -> None:
    options = Options(tmp_path, seed=SEED, batches=2)
    assert go_on(options, [Quick()]) == UNDECIDED
    carrying.append(FOUND)
    assert go_on(options, [Quick()]) == HOLDS
    carrying[:] = [replace(FOUND, target="")]
    assert go_on(options, [Quick()]) == HOLDS, "what was found is not sought again"


def test_an_interruption_while_canaries_are_sought_finds_none(
    tmp_path: Path, carrying: list[Sought], monkeypatch: pytest.MonkeyPatch
) -> None:
    def interrupted(targets: list[Target], seed: int, workers: int) -> list[Sought]:
        signal.raise_signal(signal.SIGINT)
        return [FOUND]

    monkeypatch.setattr(session, "seek", interrupted)
    with pytest.raises(CampaignError, match="interrupted") as raised:
        go_on(Options(tmp_path, seed=SEED, batches=2), [Quick()])
    assert raised.value.code == UNDECIDED
    with Store(tmp_path) as store:
        assert not any(each.target for each in store.canaries())
        assert verdict(store) == UNDECIDED


def test_merged_campaigns_have_found_what_each_of_them_found(tmp_path: Path, carrying: list[Sought]) -> None:
    carrying.append(FOUND)
    for name, seed in (("one", 1), ("two", 2)):
        assert go_on(Options(tmp_path / name, seed=seed, batches=2), [Quick()]) == HOLDS
    assert put_together(tmp_path / "both", [tmp_path / "one", tmp_path / "two"], None) == HOLDS
    carrying.clear()
    assert go_on(Options(tmp_path / "broken off", seed=1, batches=2), [Quick()]) == UNDECIDED
    for number, order in enumerate((["broken off", "one"], ["one", "broken off"], ["two", "broken off"])):
        folders = [tmp_path / name for name in order]
        assert put_together(tmp_path / str(number), folders, None) == UNDECIDED


def test_a_canary_lives_no_longer_than_its_time() -> None:
    spent = hunted("points", "some fault", [Blind()], SEED, seconds=0.0)
    assert (spent.target, spent.batches) == ("", 0)
