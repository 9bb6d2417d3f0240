"""Simulated lines as a target: repeatable, found out by oracles of the truth, made short, and simulated again."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path
from random import Random
from typing import Any

import pytest

import heisoku
from fuzz.campaign.problems import CampaignError
from fuzz.campaign.session import chosen as targets_of
from fuzz.simulation.lines import Line, as_json, from_json, simulated
from fuzz.simulation.shrinking import shrink
from fuzz.targets.lines import DRAWN, NAMES, TIMES, Lines, chosen, imported
from fuzz.targets.target import Batch
from models.exit_codes import BAD_INPUT, DOES_NOT_HOLD, HOLDS
from models.simulation.occurrences import Occurrence
from models.simulation.simulation import Simulation
from models.world.state import System

LAYOUTS = Path(__file__).resolve().parents[3] / "layouts"
STATION = LAYOUTS / "passing_station.toml"
TARGET = Lines(STATION, trains=3, hours=0.1)
TRUSTING = "kernel.onboard.odometry.agrees: and-operand gained_um_s < least_in_a_cycle(measured_mm_s2) + slip_um_s"
"""A wheel that slips is trusted."""
SLIPPERY = Lines(STATION, trains=3, hours=0.1, fault=TRUSTING)
OFTEN = tuple(40.0 if name == "wheel_slip" else 1.0 for name in NAMES)


def batch(number: int, target: Lines = TARGET, weights: tuple[float, ...] = ()) -> Batch:
    return Batch(target.name, number, 7, weights)


def test_a_batch_is_the_same_whenever_it_is_run() -> None:
    one, other = TARGET.run(batch(1)), TARGET.run(batch(1))
    assert replace(one, seconds=0.0) == replace(other, seconds=0.0)
    assert one.traces == 1
    assert one.steps == 3 * 360
    assert one.counts["simulated seconds"] == 360
    assert one.counts["telegrams"] > 100
    assert one.counts["asked: range_contains_the_train"] > 100
    assert one.counts["invariants asked"] > 1_000
    assert one.covered
    assert one.pairs
    assert not one.failures
    assert all(TARGET.describe(each).count(": ") == 1 for each in one.covered)


def test_each_line_has_faults_of_its_own_and_a_weight_of_nothing_takes_one_away() -> None:
    lines = [TARGET.line(batch(number)) for number in range(20)]
    assert len({line.seed for line in lines}) == 20
    assert {name for line in lines for name in line.faults} == set(NAMES)
    assert any(len(line.faults) < len(NAMES) for line in lines)
    weights = tuple(0.0 if name == "radio_loss" else 1.0 for name in NAMES)
    assert not any("radio_loss" in TARGET.line(batch(number, weights=weights)).faults for number in range(20))


def test_a_fault_comes_as_often_as_is_drawn() -> None:
    for seed in range(20):
        for name, setting in chosen(Random(seed), {}).items():
            usual = next(fault for fault in DRAWN if fault.name == name)
            assert TIMES[0] * usual.rate <= setting.rate <= TIMES[1] * usual.rate
            assert (setting.least, setting.most) == (usual.least, usual.most)


def test_compiled_lines_are_those_of_cpython() -> None:
    """Step by step, of a line as a campaign draws it."""

    def told(compiled: bool) -> tuple[Any, ...]:
        steps = []

        def watch(step: str, event: Any, system: System) -> None:
            del system
            steps.append((step, dict(event)))

        came = simulated(TARGET.line(batch(3)), imported(STATION), compiled, watch)
        return steps, came.sim.diary.events, came.sim.oracles.checked, came.judge.asked, came.violated

    assert told(True) == told(False)


def test_a_line_is_told_as_plain_data_and_back() -> None:
    line = TARGET.line(batch(4))
    named = replace(line, occurrences=(Occurrence(5, "wheel_slip", "T01", 100),), planted=TRUSTING)
    for each in (line, named):
        assert from_json(json.loads(json.dumps(as_json(each)))) == each


@pytest.fixture(scope="module")
def failure() -> str:
    """The first failure of lines on which a slipping wheel is trusted, made short."""
    for number in range(10):
        failures = replace(SLIPPERY, shrinks=True).run(batch(number, SLIPPERY, OFTEN)).failures
        if failures:
            return failures[0]
    raise AssertionError("not found")


@pytest.mark.slow
def test_an_odometry_that_trusts_a_slipping_wheel_is_found_out_by_the_truth(failure: str) -> None:
    told = json.loads(failure)
    assert told["violated"][0] == "range_contains_the_train"
    assert told["planted"]["name"] == TRUSTING


def test_what_is_left_of_a_failure_is_one_slip_of_one_train(failure: str) -> None:
    told = json.loads(failure)
    assert [each["fault"] for each in told["occurrences"]] == ["wheel_slip"]
    assert not any(each["rate"] for name, each in told["faults"].items() if name != "wheel_slip")
    assert told["still"], "a train that has nothing to do with it goes nowhere"
    assert told["occurrences"][0]["who"] not in told["still"]


def test_without_its_last_fault_or_its_planted_one_nothing_is_violated(failure: str) -> None:
    line = from_json(json.loads(failure))
    assert simulated(line, imported(STATION)).violated
    assert not simulated(replace(line, occurrences=()), imported(STATION)).violated
    assert not simulated(replace(line, planted=None), imported(STATION)).violated


def test_a_failure_is_simulated_again(failure: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "layouts").mkdir()
    (tmp_path / "traces").mkdir()
    path, page, record = tmp_path / "traces" / "line.json", tmp_path / "line.html", tmp_path / "again.json"
    path.write_text(failure, "utf-8")
    assert heisoku.run(["replay", str(path)]) == BAD_INPUT
    assert "cannot be read" in capsys.readouterr().err
    (tmp_path / "layouts" / STATION.name).write_bytes(STATION.read_bytes())
    assert heisoku.run(["replay", str(path), "--html", str(page), "--json", str(record)]) == DOES_NOT_HOLD
    out = capsys.readouterr().out
    assert "reproduced: range_contains_the_train" in out
    assert "the trace says" not in out
    assert "wheel slips" in out
    assert page.read_text("utf-8").startswith("<!DOCTYPE html>")
    assert json.loads(record.read_text("utf-8"))["as_told"]
    told = json.loads(failure)
    path.write_text(json.dumps({**told, "planted": None}), "utf-8")
    assert heisoku.run(["replay", str(path)]) == HOLDS
    assert "not reproduced" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("change", "says"),
    [
        ({"still": ["T99"]}, "no train 'T99'"),
        ({"faults": {"flood": {"rate": 1, "least": 0, "most": 0}}}, "no fault 'flood'"),
        ({"occurrences": [{"at_ms": 1, "fault": "wheel_slip", "who": "T99", "lasts_ms": 1}]}, "no train and no point"),
        ({"planted": {"name": "kernel.nothing"}}, "no planted fault"),
        ({"hours": 0}, "hours"),
        ({"layout": {"file": "../layouts/passing_station.toml", "sha256": "0" * 64}}, "has changed since"),
    ],
)
def test_a_trace_that_names_what_is_not_there_is_refused(
    failure: str, tmp_path: Path, capsys: pytest.CaptureFixture[str], change: dict[str, Any], says: str
) -> None:
    (tmp_path / "layouts").mkdir()
    (tmp_path / "traces").mkdir()
    (tmp_path / "layouts" / STATION.name).write_bytes(STATION.read_bytes())
    path = tmp_path / "traces" / "line.json"
    path.write_text(json.dumps({**json.loads(failure), **change}), "utf-8")
    assert heisoku.run(["replay", str(path)]) == BAD_INPUT
    said = capsys.readouterr().err
    assert says in said
    assert len(said.strip().splitlines()) == 1


def test_a_search_ends_with_its_budget() -> None:
    """What has been reached by then is given, and fails in the same way."""
    lines = (SLIPPERY.line(batch(number, SLIPPERY, OFTEN)) for number in range(10))
    came = next(came for line in lines if (came := simulated(line, imported(STATION))).violated)
    least = shrink(came, imported(STATION), budget_s=1)
    assert least.runs == 1
    assert least.came.violated[0] == came.violated[0]


def test_a_step_that_cannot_be_taken_is_a_failure_too(monkeypatch: pytest.MonkeyPatch) -> None:
    def fails(now: Simulation) -> None:
        if now.now_s > 20:
            raise KeyError("nothing")
        second(now)

    second = Simulation.second
    monkeypatch.setattr(Simulation, "second", fails)
    came = simulated(Line(1, 2, 0.1, {}), imported(STATION))
    assert came.violated == ("every_step_is_defined",)
    assert "nothing" in came.text


def test_lines_run_on_layouts_with_track(tmp_path: Path) -> None:
    assert [each.name for each in targets_of(["lines"], [STATION])] == ["lines:passing_station.toml"]
    with pytest.raises(CampaignError, match="runs on layouts"):
        targets_of(["lines"], [])
    bad = tmp_path / "bad.toml"
    bad.write_text("x", "utf-8")
    with pytest.raises(CampaignError, match=r"bad\.toml"):
        targets_of(["lines"], [bad])
