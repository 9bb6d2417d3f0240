"""Rides hold what the machines claim against the truth, find what is broken, and say whose fault it was."""

from __future__ import annotations

import json
from collections.abc import Sequence
from functools import cache
from pathlib import Path

import numpy as np
import pytest

import heisoku
from kernel.onboard.limits import are_lawful
from models.rides import tally
from models.rides.campaign import RUNS_A_BATCH, Batch, batches, ridden, ride_all
from models.rides.onboard import ON_BOARD
from models.rides.plan import SURVEYED
from models.rides.tally import ASSUMPTIONS, COLUMNS, MONITORS, VIOLATIONS, Numbers, outcome

BEYOND = {
    "diameter_ppm": ("front_outside", "wheel_broken", "contradicted"),
    "approach_slows_m_s2": ("authority_passed", "brake_broken", "brake_accused"),
    "approach_gradient_permille": ("speed_outside", "inertial_broken", ""),
}
"""A fault, the claim that breaks, the assumption that was broken, and the monitor that sees it in some of the rides."""


@cache
def campaign(beyond: tuple[str, ...] = (), rides: int = 24) -> Numbers:
    """A small campaign of this process; compiled once."""
    return ridden(Batch(5, 2, rides, beyond))


def column(rows: Numbers, name: str) -> Sequence[int]:
    values: Sequence[int] = rows[:, COLUMNS.index(name)].tolist()
    return values


def test_what_is_written_of_the_rides_train_may_go_into_service() -> None:
    assert are_lawful(ON_BOARD, SURVEYED)


def test_within_the_declared_ranges_nothing_breaks_and_the_rides_are_rides() -> None:
    found = outcome(campaign())
    assert found.violated == 0
    assert set(found.assumptions.values()) == {0}
    assert found.holds(beyond=False)
    assert found.long > found.rides / 2
    assert found.sums["tags_read"] > 4 * found.rides
    assert found.sums["lengths"] > found.rides / 2
    assert found.sums["approaches"] > found.rides / 2
    assert found.sums["faults"] > found.rides / 2
    assert found.monitors["untrusted"] > 0
    assert found.sums["false_splits"] == 0
    assert found.bound == pytest.approx(3 / found.rides)


@pytest.mark.parametrize("fault", BEYOND)
def test_beyond_a_declared_range_the_broken_assumption_is_named(fault: str) -> None:
    claim, assumption, monitor = BEYOND[fault]
    rows = campaign((fault,))
    found = outcome(rows)
    assert found.violations[claim] > 0
    assert found.assumptions[assumption] > 0
    assert not monitor or found.monitors[monitor] > 0
    assert found.unexplained == 0
    assert not found.holds(beyond=False)
    assert found.holds(beyond=True)


def test_a_claim_broken_under_whole_assumptions_would_be_the_kernels_fault() -> None:
    rows = campaign().copy()
    rows[3, COLUMNS.index("front_outside")] = 1
    found = outcome(rows)
    assert found.unexplained == found.violated == 1
    assert not found.holds(beyond=True)


def test_a_ride_is_the_same_in_whatever_company() -> None:
    few, many = ridden(Batch(5, 2, 3)), campaign()
    assert np.array_equal(few, many[:3])
    assert not np.array_equal(ridden(Batch(6, 2, 3)), few), "another seed, another ride"


def test_a_parted_train_is_found_and_its_ride_ends_with_it() -> None:
    rows = campaign(("split_at_s",))
    parted = [row for row, value in enumerate(column(rows, "parted")) if value]
    assert parted
    assert all(column(rows, "split_found")[row] for row in parted if column(rows, "seen_after_cycles")[row])
    assert outcome(rows).violations["split_unseen"] == 0


def test_batches_make_up_the_campaign() -> None:
    cut = batches(1, 2 * RUNS_A_BATCH + 5)
    assert {batch.beyond for batch in cut} == {()}
    assert {batch.beyond for batch in batches(1, 3, "delay_s")} == {("delay_s",)}
    assert [batch.rides for batch in cut] == [RUNS_A_BATCH, RUNS_A_BATCH, 5]
    assert [batch.number for batch in cut] == [0, 1, 2]


def test_progress_is_told_to_the_end() -> None:
    told: list[tuple[int, int, str]] = []
    rows = ride_all(5, 2, 1, ("", "delay_s"), progress=lambda *what: told.append(what))
    assert [len(each) for each in rows.values()] == [2, 2]
    assert told == [(2, 4, "rides"), (4, 4, "delay_s")]


def test_every_column_is_said_in_words() -> None:
    assert len(set(COLUMNS)) == len(COLUMNS)
    assert all(what for what in (*VIOLATIONS.values(), *ASSUMPTIONS.values(), *MONITORS.values()))


# ---- the command line


def test_the_command_writes_its_record(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    record = tmp_path / "ride.json"
    assert heisoku.run(["ride", "--rides", "2", "--seed", "5", "--jobs", "1", "--json", str(record)]) == 0
    written = json.loads(record.read_text("utf-8"))
    assert written["seed"] == 5
    assert [one["rides"] for one in written["campaigns"]] == [2]
    assert set(written["campaigns"][0]["violations"]) == set(VIOLATIONS)
    assert "diameter_ppm" in written["faults"]
    assert "2 rides with seed 5: holds" in capsys.readouterr().out


def test_the_command_says_whose_fault_it_was(capsys: pytest.CaptureFixture[str]) -> None:
    assert heisoku.run(["ride", "--rides", "4", "--jobs", "1", "--beyond", "approach_gains_m_s2"]) == 0
    assert "approach_gains_m_s2" in capsys.readouterr().out


@pytest.mark.parametrize(
    "arguments",
    [["--beyond", "no_such_fault"], ["--rides", "0"], ["--seed", "-1"], ["--json", "/dev/null/record.json"]],
)
def test_bad_usage_ends_in_one_line(arguments: list[str], capsys: pytest.CaptureFixture[str]) -> None:
    assert heisoku.run(["ride", *arguments]) == 2
    assert len(capsys.readouterr().err.splitlines()) == 1


def test_each_name_for_compiled_code_is_the_place_of_its_column() -> None:
    assert [getattr(tally, name.upper()) for name in tally.COLUMNS] == list(range(len(tally.COLUMNS)))
