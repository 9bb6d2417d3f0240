"""Traffic with everything going wrong: after every step all invariants hold, and every transition is taken often."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping
from pathlib import Path
from random import Random
from typing import Any

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from kernel.names import Block
from models.layouts import load
from models.layouts.continuation import with_continuations
from models.simulator.journey import Chances
from models.simulator.play import WORLD, site_of, two_cars_each
from models.simulator.traffic import Traffic, Troubles, traffic_at, traffic_on
from models.world.formations import directions
from models.world.state import System
from proofs.catalogue import AXIOMS, INVARIANTS, PREMISES, STEPS
from tests.layouts.stations import SAMPLES
from tests.world.small_site import T1, T2, E, P, hand_made_layout

SMALL = "small site"
PLACES = (SMALL, *(path.stem for path in SAMPLES))
SEEDS = range(12)
SECONDS = 400
CHANCES = Chances(loss=0.2, missed_tag=0.03, withdrawn=0.1, cancelled=0.1, slips=0.3)
TROUBLES = Troubles(
    centre_restarts=0.001,
    unit_restarts=0.002,
    terminal_restarts=0.01,
    foreign_tag=0.001,
    overdue_tag=0.001,
    old_message=0.2,
    parts=0.001,
)


def traffic(place: str, seed: int, troubles: Troubles = TROUBLES) -> Traffic:
    """Two or three trains with every invariant watched."""
    if place == SMALL:
        layout, records, ground = hand_made_layout()
        site = site_of(layout, ground, records, two_cars_each([T1, T2]))
        moving = traffic_at(site, {T1: P, T2: E}, Random(seed), CHANCES, troubles)
    else:
        path = next(path for path in SAMPLES if path.stem == place)
        moving = traffic_on(load(path), seed, CHANCES, troubles, trains=3)
    layout, ground = moving.play.site.layout, moving.play.site.ground
    assert [name for name, axiom in AXIOMS.items() if not axiom(layout, ground)] == []
    assert [name for name, premise in PREMISES.items() if not premise(moving.play.site)] == []
    moving.play.watch = watched(moving)
    return moving


def watched(moving: Traffic) -> Any:
    """Says after which step an invariant is broken."""

    def watch(step: str, event: Mapping[str, Any], after: System) -> None:
        broken = [name for name, claim in INVARIANTS.items() if not claim(moving.play.site, after)]
        assert not broken, f"after {moving.play.accepted.total()} steps {step}({event}) breaks {broken}"

    return watch


@pytest.fixture(scope="module")
def walked() -> Mapping[str, tuple[Counter[str], int]]:
    """For each place the steps accepted and the runs finished over all seeds."""
    found = {}
    for place in PLACES:
        accepted: Counter[str] = Counter()
        finished = 0
        for seed in SEEDS:
            moving = traffic(place, seed)
            moving.run(SECONDS)
            accepted += moving.play.accepted
            finished += moving.finished
        found[place] = (accepted, finished)
    return found


def test_the_world_that_is_walked_is_the_world_that_is_proved() -> None:
    assert dict(WORLD) == dict(STEPS)


@pytest.mark.parametrize("place", PLACES)
def test_traffic_flows(place: str, walked: Mapping[str, tuple[Counter[str], int]]) -> None:
    accepted, finished = walked[place]
    assert finished >= len(SEEDS)
    assert accepted.total() >= 1000


@pytest.mark.parametrize("transition", STEPS)
def test_a_transition_is_taken_often(transition: str, walked: Mapping[str, tuple[Counter[str], int]]) -> None:
    assert sum(accepted[transition] for accepted, _ in walked.values()) >= 10


@pytest.mark.parametrize("path", SAMPLES, ids=lambda path: path.name)
def test_routes_over_a_boundary_agree_on_its_direction(path: Path) -> None:
    imported = load(path)
    layout, ground = with_continuations(imported.layout, imported.ground)
    along = directions(layout, ground)
    over: dict[tuple[Block, Block], set[bool]] = {}
    for route in layout.routes:
        for block, target in layout.way[route].items():
            over.setdefault((block, target), set()).add(along[route])
    for (block, target), senses in over.items():
        assert len(senses) == 1
        assert senses != over.get((target, block))


@settings(max_examples=25, deadline=None, suppress_health_check=[HealthCheck.too_slow])
@given(
    place=st.sampled_from(PLACES),
    seed=st.integers(0, 2**32),
    much=st.builds(
        Troubles,
        centre_restarts=st.sampled_from([0.0, 0.01]),
        unit_restarts=st.sampled_from([0.0, 0.02]),
        terminal_restarts=st.sampled_from([0.0, 0.1]),
        foreign_tag=st.sampled_from([0.0, 0.01]),
        overdue_tag=st.sampled_from([0.0, 0.01]),
        old_message=st.sampled_from([0.0, 1.0]),
        parts=st.sampled_from([0.0, 0.01]),
    ),
)
def test_no_mixture_of_troubles_breaks_an_invariant(place: str, seed: int, much: Troubles) -> None:
    traffic(place, seed, much).run(200)
