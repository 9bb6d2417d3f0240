"""What is assumed can be true, in states where something happens; what is claimed can be false.

A proof from assumptions that nothing satisfies would prove anything.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import cache
from pathlib import Path
from typing import Any

import pytest
import z3

from kernel.names import Block, Car, Cause, Point, Position, Stage
from models.layouts import load
from models.world.formations import directions, formation
from models.world.start import site_as_told, start
from models.world.state import Site, System
from proofs.catalogue import AXIOMS, INITIAL, INVARIANTS, PREMISES
from proofs.finite import LARGER, World
from proofs.lift import Value, concretise
from tests.world.small_site import small_site, small_start

ROOT = Path(__file__).resolve().parent.parent.parent
SAMPLES = sorted((ROOT / "layouts").glob("*.toml"))
TIMEOUT_MS = 120_000
"""For a solver that has gone astray; a question takes a few seconds."""


def broken(site: Site, system: System, claims: Mapping[str, Callable[..., bool]] = INVARIANTS) -> list[str]:
    """Every axiom, premise and claim that does not hold, evaluated in CPython."""
    return [
        *(name for name, axiom in AXIOMS.items() if not axiom(site.layout, site.ground)),
        *(name for name, premise in PREMISES.items() if not premise(site)),
        *(name for name, claim in claims.items() if not claim(site, system)),
    ]


# ---- of real stations


def station(path: Path) -> tuple[Site, System]:
    """A sample layout with each of its trains standing on a block of its own."""
    imported = load(path)
    layout = imported.layout
    along = directions(layout, imported.ground)
    trains = sorted(layout.fleet)
    cars = {train: [Car(f"{train}.1"), Car(f"{train}.2")] for train in trains}
    site = site_as_told(
        layout, imported.records, imported.ground, formation(cars, lambda route: along.get(route, True))
    )
    apart: list[Block] = []
    for block in sorted(layout.blocks):
        if len(apart) < len(trains) and not any(other in layout.fouls.get(block, ()) for other in apart):
            apart.append(block)
    at = {car: frozenset({block}) for train, block in zip(trains, apart, strict=True) for car in cars[train]}
    return site, start(site, at, {Point(point): Position("normal") for point in layout.points})


@pytest.mark.parametrize("path", SAMPLES, ids=lambda path: path.stem)
def test_a_sample_layout_with_its_trains_satisfies_all_that_is_assumed(path: Path) -> None:
    site, system = station(path)
    assert len(system.track.at) >= 4
    assert broken(site, system, {**INITIAL, **INVARIANTS}) == []


def test_the_small_site_satisfies_all_that_is_assumed() -> None:
    site = small_site()
    system = small_start(site)
    assert broken(site, system, {**INITIAL, **INVARIANTS}) == []


def test_what_does_not_hold_is_seen() -> None:
    site = small_site()
    system = start(site, {Car("a1"): frozenset({Block("W")}), Car("b1"): frozenset({Block("W")})}, {})
    assert "no_two_trains_in_a_block" in broken(site, system)
    assert "trains_stand_apart_on_locked_points" in broken(site, system, INITIAL)


# ---- of states in which something happens, found by a solver and looked at in CPython


def a_train_moves_over_a_proved_point(site: Site, system: System) -> bool:
    """A car has come under a permitted run, and rolls on over a point that is locked and proved."""
    return any(
        run in system.track.rolling and point in grant.proved and site.layout.stands_in[point] == target
        for car in system.track.under
        for block, run in system.track.under[car].items()
        if block in system.track.at.get(car, frozenset()) and run.route in site.layout.routes
        for other, grant in system.centre.runs.items()
        if other == run
        for target in site.layout.covers[run.route]
        for point in site.layout.needs[run.route]
    )


def two_trains_run_at_once(site: Site, system: System) -> bool:
    """Two trains roll on routes of their own."""
    return any(run.train != other.train for run in system.track.rolling for other in system.track.rolling)


def a_block_was_released_behind_a_rolling_train(site: Site, system: System) -> bool:
    """A claim ended by tail evidence while the train runs on."""
    return any(
        cause == Cause.TAIL_EVIDENCE and run in system.track.rolling and grant.stage == Stage.SET
        for run, grant in system.centre.runs.items()
        for block, cause in grant.ended.items()
    )


def a_train_slips_into_its_overlap(site: Site, system: System) -> bool:
    """A car is in the overlap of a slipping run."""
    return any(
        run in system.track.slipping and block in site.layout.overlap[run.route] and block in system.track.at[car]
        for car in system.track.at
        for block, run in system.track.under.get(car, {}).items()
        if run.route in site.layout.routes
    )


def an_overlap_was_released_at_a_standstill(site: Site, system: System) -> bool:
    """A claim ended because the train stands in its destination."""
    return any(
        cause == Cause.STANDSTILL and grant.stage == Stage.SET
        for run, grant in system.centre.runs.items()
        for block, cause in grant.ended.items()
    )


def a_run_was_cancelled(site: Site, system: System) -> bool:
    """A claim ended by the train's acknowledgement."""
    return any(
        cause == Cause.CANCELLED for _, grant in system.centre.runs.items() for block, cause in grant.ended.items()
    )


def a_block_is_kept_from_what_fouls_it(site: Site, system: System) -> bool:
    """A train can be led into a block that another block fouls."""
    return any(
        run in system.centre.claimed.get(block, frozenset())
        for run in system.track.rolling
        for block in site.layout.covers[run.route]
        for _ in site.layout.fouls.get(block, frozenset())
    )


def a_flank_is_held(site: Site, system: System) -> bool:
    """A train rolls towards a block that track leads to from the side, kept out by a point and by nothing else."""
    return any(
        beside not in site.layout.claims[run.route]
        and beside in site.ground.opens
        and block in site.ground.opens[beside]
        and block not in site.ground.held_by_authority.get(beside, frozenset())
        for run in system.track.rolling
        for block in site.layout.covers[run.route]
        if run in system.centre.claimed.get(block, frozenset())
        for beside in site.ground.neighbours.get(block, frozenset())
    )


def one_train_is_missing_after_a_restart(site: Site, system: System) -> bool:
    """One train stands accounted for; another, with cars on the line, has not told where it stands."""
    return any(
        grant.stage == Stage.STANDING
        and site.formation.train_of.get(car) not in system.centre.accounted
        and any(True for _ in system.track.at[car])
        for run, grant in system.centre.runs.items()
        if run.train in system.centre.accounted
        for car in system.track.at
    )


def a_statement_was_confirmed(site: Site, system: System) -> bool:
    """Two persons' word, not yet taken, is in the air for this epoch, of a train that stands somewhere."""
    return any(
        epoch == system.centre.epoch and train not in system.centre.accounted and any(True for _ in blocks)
        for (train, life, epoch), blocks in system.radio.confirmed_statements.items()
    )


def a_parted_train_moves(site: Site, system: System) -> bool:
    """A train that has lost cars rolls on."""
    return any(run.train in system.track.parted for run in system.track.rolling)


HAPPENS = (
    a_train_moves_over_a_proved_point,
    two_trains_run_at_once,
    a_block_was_released_behind_a_rolling_train,
    a_train_slips_into_its_overlap,
    an_overlap_was_released_at_a_standstill,
    a_run_was_cancelled,
    a_block_is_kept_from_what_fouls_it,
    a_flank_is_held,
    one_train_is_missing_after_a_restart,
    a_statement_was_confirmed,
    a_parted_train_moves,
)


@cache
def world() -> World:
    """A few blocks, routes, points, cars and runs; lifted once."""
    return World(LARGER)


def model_of(*formulas: Any) -> tuple[Site, System]:
    """A site and a state in which these hold, as Python objects."""
    solver = world().solver(TIMEOUT_MS)
    solver.add(*formulas)
    assert solver.check() == z3.sat
    return objects(solver.model(), world().site, world().before)


def objects(model: Any, site: Value, system: Value) -> tuple[Site, System]:
    scope = world().scope
    return concretise(model, scope, site, Site), concretise(model, scope, system, System)


@pytest.mark.parametrize("happens", HAPPENS, ids=lambda happens: happens.__name__)
def test_all_that_is_assumed_holds_in_a_state_where_something_happens(happens: Callable[..., bool]) -> None:
    site, system = model_of(world().lifter.formula(happens, world().site, world().before))
    assert happens(site, system)
    assert broken(site, system) == []


def holds(claim: Callable[..., bool], site: Site, system: System) -> bool:
    """Whether a claim is true; one that looks up what is not there is not (where the others hold it never does)."""
    try:
        return claim(site, system)
    except KeyError:
        return False


@pytest.mark.sampled(3)
@pytest.mark.parametrize("name", INVARIANTS)
def test_every_invariant_can_be_false(name: str) -> None:
    """The axioms and premises alone do not imply it: it says something of the system."""
    forms = [named.formula for named in world().scope.axioms()]
    solver = z3.Then("simplify", "elim-term-ite", "dt2bv", "simplify", "solve-eqs", "bit-blast", "sat").solver()
    solver.set("timeout", TIMEOUT_MS)
    solver.add(*world().assumed.values(), *forms, z3.Not(world().invariants[name]))
    assert solver.check() == z3.sat
    site, system = objects(solver.model(), world().site, world().before)
    assert broken(site, system, {}) == []
    assert not holds(INVARIANTS[name], site, system)
