"""Targets: a batch follows from its numbers, the sound kernel fails nowhere, and a planted fault is found and told."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import pytest

import heisoku
from fuzz.channel.threats import THREATS
from fuzz.failures.causes import cause_of
from fuzz.failures.replaying import replay
from fuzz.failures.trace import Trace, layout_of, load_trace
from fuzz.targets.interlocking import Interlocking
from fuzz.targets.jolted import Jolted
from fuzz.targets.link import LinkRuns
from fuzz.targets.target import Batch, Result, Target
from fuzz.targets.walks import Walks
from fuzz.traffic.faults import FAULTS
from models.exit_codes import BAD_INPUT, DOES_NOT_HOLD, HOLDS
from tests.layouts.stations import ROOT

STATION = ROOT / "layouts" / "passing_station.toml"
TRAFFIC = Interlocking(STATION)
TARGETS: tuple[Target, ...] = (TRAFFIC, Walks(), LinkRuns())
each_target = pytest.mark.parametrize(
    "target", [pytest.param(TRAFFIC, marks=pytest.mark.slow), *TARGETS[1:]], ids=lambda target: target.name
)
"""Traffic is compiled for a minute or more before its first batch."""
FORGETFUL = "kernel.restarts.restart_centre: update claimed={}"
LATE = "kernel.link.judge: guard if telegram.sent_at_ms - now_ms > 2 * limits.offset_ms: Outcome.FROM_THE_FUTURE"


def batch(target: Target, number: int = 0, seed: int = 3, weights: tuple[float, ...] = ()) -> Batch:
    """A batch of a target."""
    return Batch(target.name, number, seed, weights)


@each_target
def test_a_batch_follows_from_its_numbers_and_fails_nowhere(target: Target) -> None:
    once, again = (target.run(batch(target)) for _ in range(2))
    assert replace(once, seconds=0.0) == replace(again, seconds=0.0)
    assert once.failures == ()
    assert once.steps > 1_000
    other = target.run(batch(target, number=1))
    assert other.covered != once.covered
    assert other.failures == ()


@each_target
def test_every_tuple_has_words_and_every_family_a_weight(target: Target) -> None:
    found = target.run(batch(target))
    words = [target.describe(each) for each in found.covered]
    assert len(set(words)) == len(words)
    families = target.families()
    assert len(set(families)) == len(families) > 1
    weighed = target.run(batch(target, weights=tuple(8.0 if at == 0 else 0.125 for at in range(len(families)))))
    assert weighed.covered != found.covered


def test_what_a_target_is_made_of_has_a_digest() -> None:
    for target in TARGETS:
        identity = target.identity()
        assert identity["sources"]
        assert identity == target.identity()


def test_faults_of_a_trace_are_drawn_and_counted() -> None:
    found = TRAFFIC.run(batch(TRAFFIC))
    for fault in FAULTS:
        assert f"traces with {fault.name}" in found.counts
    assert sum(found.counts[f"traces with {fault.name}"] for fault in FAULTS) > found.traces
    assert any(name.startswith("standstill seconds") and seconds for name, seconds in found.counts.items())
    assert found.counts["journeys"] > 100
    link = LinkRuns().run(batch(LinkRuns()))
    assert all(link.counts[threat] for threat in THREATS)


def first_failing(target: Target, most: int = 6) -> Result:
    """The first batch that fails."""
    results = (target.run(batch(target, number)) for number in range(most))
    return next(result for result in results if result.failures)


def test_a_planted_fault_is_found_made_short_and_replays_in_cpython(tmp_path: Path) -> None:
    faulty = TRAFFIC.with_fault("interlocking", FORGETFUL)
    assert faulty is not None
    (tmp_path / "layouts").mkdir()
    (tmp_path / "layouts" / STATION.name).write_bytes(STATION.read_bytes())
    (tmp_path / "traces").mkdir()
    path = tmp_path / "traces" / "trace.json"
    path.write_text(first_failing(replace(faulty, shrinks=True)).failures[0], "utf-8")
    trace = load_trace(path)
    assert isinstance(trace, Trace)
    assert trace.planted == FORGETFUL
    again = replay(trace, layout_of(trace, path))
    assert again.reproduced
    assert again.violated == trace.violated
    assert json.loads(path.read_text("utf-8"))["cause"] == cause_of(trace).digest
    assert TRAFFIC.with_fault("odometry", FORGETFUL) is None


def test_a_fault_in_the_link_is_found_and_named() -> None:
    faulty = LinkRuns().with_fault("link", LATE)
    assert faulty is not None
    found = json.loads(first_failing(faulty).failures[0])
    assert found["planted"]["name"] == LATE
    assert found["violated"]
    assert LinkRuns().with_fault("interlocking", FORGETFUL) is None


def test_a_walk_that_fails_is_walked_again(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    faulty = Walks().with_fault("link", LATE)
    path = tmp_path / "walk.json"
    text = first_failing(faulty).failures[0]
    path.write_text(text, "utf-8")
    assert heisoku.run(["replay", str(path)]) == DOES_NOT_HOLD
    assert "reproduced" in capsys.readouterr().out
    sound = {**json.loads(text), "planted": None}
    path.write_text(json.dumps(sound), "utf-8")
    assert heisoku.run(["replay", str(path)]) == HOLDS
    assert heisoku.run(["replay", str(path), "--html", str(tmp_path / "page.html")]) == BAD_INPUT


@pytest.mark.slow
def test_a_jolted_state_that_fails_is_found_again(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    faulty = Jolted(STATION).with_fault("interlocking", FORGETFUL)
    assert faulty is not None
    (tmp_path / "layouts").mkdir()
    (tmp_path / "traces").mkdir()
    path = tmp_path / "traces" / "jolted.json"
    path.write_text(first_failing(faulty).failures[0], "utf-8")
    assert heisoku.run(["replay", str(path)]) == BAD_INPUT
    assert "is not there" in capsys.readouterr().err
    (tmp_path / "layouts" / STATION.name).write_bytes(STATION.read_bytes())
    assert heisoku.run(["replay", str(path)]) == DOES_NOT_HOLD
    assert "reproduced" in capsys.readouterr().out
