"""Trains in small time steps: no claim made on board breaks within the bounds, and wrong kernels are found."""

from __future__ import annotations

import ast
from dataclasses import replace
from pathlib import Path

import pytest

from tests.independent.physics import faults, ride
from tests.independent.physics.campaign import BEGINS, PAGE, campaign, rides, table, written
from tests.independent.physics.planted_faults import WRONG
from tests.independent.physics.ride import Ride

SHORT = (*range(12), 14, 34, 72, 114)
LONG = 10_000
BEYOND_EACH = 200
FOUND_AT = {
    "stuck": 4, "no slip": 5, "no creep": 5, "exact speed": 1, "trusts at once": 5, "gravity": 114, "no run since": 1,
    "late place": 5, "any tail": 14, "never overdue": 72, "early window": 4, "overhangs": 4, "brakes at the end": 5,
    "brakes well": 27,
}  # fmt: skip
"""A ride that shows each; all of them are among the short run's, with the kernel as it is."""
HERE = Path(__file__).parent


def imported(path: Path) -> set[str]:
    found = set()
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            found |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom):
            found.add(str(node.module))
    return found


@pytest.mark.parametrize("path", [HERE / "bodies.py", HERE / "faults.py", HERE / "ride.py"], ids=lambda path: path.name)
def test_the_world_itself_knows_nothing_of_the_kernel(path: Path) -> None:
    assert not {name for name in imported(path) if name.startswith("kernel")}


def test_no_claim_is_broken_within_the_bounds() -> None:
    tally = rides(SHORT)
    assert tally.found == []
    assert tally.ran_mm > 1_000_000
    assert tally.counts["tags read"] > 10
    assert tally.counts["stops"] > 10


@pytest.mark.parametrize("name", WRONG)
def test_every_wrong_kernel_is_found(name: str) -> None:
    seed = FOUND_AT[name]
    found = rides(range(seed, seed + 1), wrong=name).found
    assert {hazard.kind for _, hazard in found} & WRONG[name].kinds, f"{WRONG[name].why}, and nothing is seen"


def test_a_lasting_slide_is_beyond_the_bounds_and_breaks_claims_that_are_named() -> None:
    out = Ride(17, faults.HELD).run()
    assert {ride.SPEED} <= {hazard.kind for hazard in out.hazards}
    assert all("a wheel that slips keeps pace" in hazard.broken for hazard in out.hazards)


@pytest.mark.slow
def test_ten_thousand_rides_break_no_claim_within_the_bounds() -> None:
    tally = campaign(LONG, 2)
    assert tally.found == []
    assert tally.rides == LONG
    assert all(tally.counts[f"rides: {style.name}"] > 20 for style in ride.STYLES)
    assert tally.counts["changes of ends over a tag"] > 20


def test_a_train_rests_runs_and_rests_and_at_rest_its_range_does_not_widen() -> None:
    rests = replace(ride.STYLES[-1], dwell_s=(250, 250), whole_s=450.0, every_mm=(200_000, 200_000))
    out = Ride(3, style=rests).run()
    assert out.hazards == []
    assert 100_000 < out.ran_mm < 300_000
    widths = [width for _, _, width in out.widths]
    assert len(set(widths[:24])) == len(set(widths[-10:])) == 1
    assert widths[-1] > widths[0]


def test_the_table_of_widths_is_written_in_its_place() -> None:
    tally = rides((1,))
    page = written(PAGE.read_text("utf-8"), tally, 1)
    assert table(tally) in page
    assert "--rides 1 --first 1" in page
    assert written(page, tally, 1) == page
    assert page.partition(BEGINS)[0] == PAGE.read_text("utf-8").partition(BEGINS)[0]


@pytest.mark.slow
@pytest.mark.parametrize("kind", faults.BEYOND)
def test_what_breaks_beyond_a_bound_is_named(kind: str) -> None:
    tally = campaign(BEYOND_EACH, 2, kind)
    assert tally.found == []
    assert tally.broken > 0


@pytest.mark.slow
@pytest.mark.parametrize("name", WRONG)
def test_every_wrong_kernel_is_found_from_the_first_seed_on(name: str) -> None:
    assert rides(range(200), wrong=name, enough=1).found
