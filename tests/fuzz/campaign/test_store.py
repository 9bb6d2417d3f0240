"""A store's sums are those of its batches, each once, in whatever order and however often they come; merging too."""

from __future__ import annotations

import json
import tempfile
from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import NamedTuple

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from fuzz.campaign.campaign import Plan
from fuzz.campaign.merging import merge
from fuzz.campaign.outcome import DIED, DONE, HUNG, Outcome
from fuzz.campaign.problems import CampaignError
from fuzz.campaign.session import Options, go_on, put_together
from fuzz.campaign.sketch import REGISTERS, estimate
from fuzz.campaign.store import Store
from fuzz.targets.target import Batch, Result
from models.exit_codes import HOLDS
from tests.fuzz.campaign.quick import Quick, failure

IDENTITY = {"quick/watched": "nothing"}
EXAMPLES = settings(max_examples=40)

MEMORY = Path("/dev/shm")
PLACE = MEMORY if MEMORY.is_dir() else None
"""Where a store is written without waiting for a disk."""


class Told(NamedTuple):
    """Which batch, and whether it is done; all that it comes to follows from that."""

    seed: int
    target: str
    number: int
    status: str

    def outcome(self) -> Outcome:
        batch = Batch(self.target, self.number, self.seed, (1.0, 0.5))
        if self.status != DONE:
            return Outcome(batch, None, self.status, f"batch {self.number} is left out")
        source = np.random.default_rng([self.seed, len(self.target), self.number])
        result = Result(
            batch=batch,
            traces=int(source.integers(0, 9)),
            steps=int(source.integers(0, 99)),
            counts={name: int(source.integers(0, 9)) for name in ("accepted", "refused")},
            covered={int(source.integers(-5, 20)): int(source.integers(1, 9)) for _ in range(4)},
            pairs={int(source.integers(-(2**63), 2**63 - 1)): 1 for _ in range(3)},
            sketch=source.integers(0, 5, REGISTERS).astype(np.uint8).tobytes() if self.number % 2 else b"",
            failures=tuple(failure(batch) for _ in range(self.number % 3)),
            seconds=float(source.integers(0, 9)),
        )
        return Outcome(batch, result, DONE)


told = st.builds(
    Told,
    st.integers(1, 2),
    st.sampled_from(["one", "other"]),
    st.integers(0, 5),
    st.sampled_from([DONE, DONE, DONE, HUNG, DIED]),
)


def summed(of: Iterable[Mapping[int, int]] | Iterable[Mapping[str, int]]) -> dict[object, int]:
    """Sum counts by key."""
    found: Counter[object] = Counter()
    for each in of:
        found.update(each)
    return dict(found)


def hold(store: Store, added: Sequence[Told]) -> None:
    """Hold all sums against plain sums over batches, each once."""
    totals = store.totals()
    assert set(totals) == {each.target for each in added}
    for target, found in totals.items():
        mine = {each for each in added if each.target == target}
        results = [each.outcome().result for each in mine]
        done = [result for result in results if result is not None]
        batches = {(each.seed, each.number) for each in mine}
        assert found.batches == len(batches)
        assert found.unfinished == len(batches) - len(done)
        assert found.traces == sum(each.traces for each in done)
        assert found.steps == sum(each.steps for each in done)
        assert found.seconds == sum(each.seconds for each in done)
        assert store.counts(target) == summed(each.counts for each in done)
        covered, pairs = summed(each.covered for each in done), summed(each.pairs for each in done)
        assert dict(store.ask("SELECT id, hits FROM covered WHERE target = ?", target)) == covered
        assert dict(store.ask("SELECT id, hits FROM pairs WHERE target = ?", target)) == pairs
        assert (found.tuples, found.pairs) == (len(covered), len(pairs))
        sketches = [np.frombuffer(each.sketch, np.uint8) for each in done if each.sketch]
        assert found.states == (estimate(np.max(sketches, axis=0).tobytes()) if sketches else 0)
        assert found.failures == sum(len(each.failures) for each in done)
        assert found.causes == len({json.loads(trace)["cause"] for each in done for trace in each.failures})


@given(st.lists(told, max_size=12), st.data())
@EXAMPLES
def test_sums_are_those_of_the_batches_in_any_order(added: list[Told], data: st.DataObject) -> None:
    with tempfile.TemporaryDirectory(dir=PLACE) as place:
        with Store(Path(place) / "one") as store:
            for each in added:
                store.add(each.outcome())
        with Store(Path(place) / "one") as store:
            hold(store, added)
        with Store(Path(place) / "other") as store:
            for each in data.draw(st.permutations(added)):
                store.add(each.outcome())
                assert not store.add(each.outcome())
            hold(store, added)


@given(st.lists(told, max_size=8), st.lists(told, max_size=8))
@EXAMPLES
def test_what_is_merged_counts_once(one: list[Told], other: list[Told]) -> None:
    with tempfile.TemporaryDirectory(dir=PLACE) as place:
        folders = [Path(place) / "one", Path(place) / "other"]
        for folder, added in zip(folders, (one, other), strict=True):
            with Store(folder) as store:
                store.agree(IDENTITY)
                for each in added:
                    store.add(each.outcome())
        both = Path(place) / "both"
        assert merge(both, folders) >= len({each[:3] for each in (*one, *other)})
        merge(Path(place) / "again", [both, *folders[::-1]])
        for folder in (both, Path(place) / "again"):
            with Store(folder) as store:
                hold(store, [*one, *other])
                assert store.identity()["quick/watched"] == "nothing"


def test_campaigns_of_two_seeds_become_one(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    for seed in (1, 2):
        assert go_on(Options(tmp_path / str(seed), seed=seed, batches=20), [Quick()]) == HOLDS
    capsys.readouterr()
    assert put_together(tmp_path / "both", [tmp_path / "1", tmp_path / "2", tmp_path / "1"], None) == HOLDS
    assert "40 batches, 320 traces" in capsys.readouterr().out
    with Store(tmp_path / "both") as store:
        assert store.seeds() == [1, 2]
        assert store.totals()["quick"].batches == 40
    assert go_on(Options(tmp_path / "both", seed=2, batches=30), [Quick()]) == HOLDS
    assert "50 batches" in capsys.readouterr().out


def test_campaigns_of_different_things_are_not_merged(tmp_path: Path) -> None:
    watched = tmp_path / "watched"
    for name in ("one", "other"):
        watched.write_text(name, "utf-8")
        assert go_on(Options(tmp_path / name, batches=2), [Quick(watched=watched)]) == HOLDS
    with pytest.raises(CampaignError, match="other: its campaign was run with something else: quick/watched"):
        merge(tmp_path / "both", [tmp_path / "one", tmp_path / "other"])
    assert not (tmp_path / "both").exists()
    with pytest.raises(CampaignError, match="both: holds no campaign"):
        merge(tmp_path / "third", [tmp_path / "one", tmp_path / "both"])
    with pytest.raises(CampaignError, match="one: holds a campaign already"):
        merge(tmp_path / "one", [tmp_path / "one", tmp_path / "other"])


def test_a_batch_that_comes_to_something_else_is_said(tmp_path: Path) -> None:
    batch = Batch("quick", 0, 1, (1.0,) * 3)
    with Store(tmp_path) as store:
        result = Quick().run(batch)
        assert store.add(Outcome(batch, result, DONE))
        assert not store.add(Outcome(batch, result, DONE))
        other = Result(batch, result.traces, result.steps + 1, {}, {}, {}, b"", (), 0.0)
        with pytest.raises(CampaignError, match="batch 0 of quick with seed 1 came to something else before"):
            store.add(Outcome(batch, other, DONE))
        assert store.totals()["quick"].steps == result.steps


def test_a_cause_has_one_file_of_its_lowest_batch(tmp_path: Path) -> None:
    with Store(tmp_path) as store:
        for number in (6, 4, 7, 2):
            batch = Batch("quick", number, 1, (1.0,) * 3)
            store.add(Outcome(batch, Quick(breaks=1).run(batch), DONE))
        causes = store.failures()
        assert [times for _, _, _, times, _ in causes] in ([3, 1], [1, 3])
        texts = {path: path.read_text("utf-8") for *_, path in causes}
        assert sorted(json.loads(text)["batch"] for text in texts.values()) == [2, 7]
        assert all(path.name.startswith("no_two_trains-") for path in texts)
        gone, stale = texts
        gone.unlink()
        stale.write_text("a trace of a higher batch", "utf-8")
        store.write_traces()
        assert {path: path.read_text("utf-8") for path in texts} == texts


def test_a_round_that_began_with_other_weights_is_damage(tmp_path: Path) -> None:
    with Store(tmp_path) as store:
        store.note_round(1, "quick", 0, (1.0, 2.0))
        store.note_round(1, "quick", 0, (1.0, 2.0))
        with pytest.raises(CampaignError, match="round 0 of quick had other weights"):
            store.note_round(1, "quick", 0, (1.0, 2.5))


def test_another_seed_is_refused(tmp_path: Path) -> None:
    assert go_on(Options(tmp_path, seed=3, batches=2), [Quick()]) == HOLDS
    assert go_on(Options(tmp_path, batches=3), [Quick()]) == HOLDS
    with pytest.raises(CampaignError, match=r"--seed 4: .* has seed 3; leave it out"):
        go_on(Options(tmp_path, seed=4, batches=2), [Quick()])


def test_a_campaign_has_an_end() -> None:
    with pytest.raises(AssertionError, match="without end"):
        Plan(1)
