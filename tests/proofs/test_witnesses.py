"""Every transition fires in a witness that says what it changes; every refusal is given; continuations are lawful."""

from __future__ import annotations

import re
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import pytest

from kernel.refusal import Refusal
from models.layouts import load, load_text
from models.layouts.continuation import with_continuations
from models.world.state import Site, System
from proofs.catalogue import AXIOMS
from proofs.catalogue import STEPS as TRANSITIONS
from proofs.witnesses.registry import WITNESSES, Witness, refused_by, replay, shown_by
from proofs.witnesses.scenario import STEPS, Scenario, Steps, WitnessFailed
from tests.independent.layouts.dangerous_routes import TWO_TRACKS_BETWEEN_TWO_BLOCKS
from tests.layouts.stations import SAMPLES, SHARED


@pytest.fixture(scope="module")
def played() -> Mapping[str, Scenario]:
    return replay()


@pytest.mark.parametrize("name", WITNESSES)
def test_a_witness_goes_as_it_says(name: str) -> None:
    scenario = WITNESSES[name](STEPS)
    assert any(taken.accepted for taken in scenario.taken)


@pytest.mark.parametrize("name", WITNESSES)
def test_a_witness_says_what_it_shows_and_which_requirement_it_serves(name: str) -> None:
    says = WITNESSES[name].__doc__ or ""
    assert re.search(r"\([^)]*\bT\d+[^)]*\)", says), says


@pytest.mark.parametrize("transition", TRANSITIONS)
def test_a_transition_has_a_witness_that_says_its_effect(transition: str, played: Mapping[str, Scenario]) -> None:
    assert shown_by(played).get(transition)


@pytest.mark.parametrize("why", Refusal)
def test_a_refusal_is_given_in_a_witness(why: Refusal, played: Mapping[str, Scenario]) -> None:
    assert refused_by(played).get(why)


@pytest.mark.sampled(3)
@pytest.mark.parametrize("transition", TRANSITIONS)
def test_a_transition_that_does_nothing_is_noticed(transition: str) -> None:
    def nothing(site: Site, system: System, **event: Any) -> System:
        return system

    assert any(fails(witness, {**STEPS, transition: nothing}) for witness in WITNESSES.values())


def fails(witness: Witness, steps: Steps) -> bool:
    try:
        witness(steps)
    except WitnessFailed:
        return True
    return False


LAYOUTS = [*SAMPLES, *sorted(path for path in SHARED.glob("*") if path.suffix in {".json", ".yml"})]


@pytest.mark.parametrize("path", [path for path in LAYOUTS if "circle" not in path.name], ids=lambda path: path.name)
def test_continuations_keep_the_axioms(path: Path) -> None:
    imported = load(path)
    layout, ground = with_continuations(imported.layout, imported.ground)
    assert imported.layout.routes <= layout.routes
    assert [name for name, axiom in AXIOMS.items() if not axiom(layout, ground)] == []


def test_no_train_goes_on_from_a_block_of_two_tracks_between_the_same_two_blocks() -> None:
    imported = load_text("two tracks.toml", TWO_TRACKS_BETWEEN_TWO_BLOCKS)
    layout, _ = with_continuations(imported.layout, imported.ground)
    assert layout.routes == imported.layout.routes == {"north", "south"}


TWO_TRACKS = frozenset({"crossing", "diamond"})
"""Blocks of samples with two tracks that cross: it is not known on which of them a train stands there."""


@pytest.mark.parametrize("path", SAMPLES, ids=lambda path: path.name)
def test_a_sample_has_a_way_on_from_every_block_of_one_track_inside_a_route(path: Path) -> None:
    imported = load(path)
    layout, _ = with_continuations(imported.layout, imported.ground)
    inside = {
        (route, block)
        for route in imported.layout.routes
        for block in imported.layout.covers[route]
        if block != imported.layout.destination[route] and block not in TWO_TRACKS
    }
    assert len(layout.routes) == len(imported.layout.routes) + len(inside)
    for route, block in inside:
        onward = next(other for other in layout.routes if other == f"{route} from {block}")
        assert layout.start[onward] == block
        assert layout.destination[onward] == layout.destination[route]
        assert layout.tag_in[layout.first_tag[onward]] == block
