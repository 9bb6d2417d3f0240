"""CPython and the lifted terms agree for every function of kernel, world and invariants.

Random states, mostly unreachable: what is compared is the meaning of the code, not the protocol.
"""

from __future__ import annotations

import importlib
import inspect
import pkgutil
from collections.abc import Callable, Iterator
from typing import Any

import pytest

import kernel
import models.world
from kernel.crossing.crossing import CrossingTrack
from kernel.crossing.crossing import Train as CrossingTrain
from kernel.crossing.ranging_schedule import CrossingName
from kernel.names import (
    Block,
    Cab,
    Car,
    Epoch,
    Point,
    Position,
    Read,
    Record,
    Route,
    Run,
    Serial,
    Tag,
    TagList,
    TerminalLife,
    Train,
    UnitLife,
)
from proofs import invariants
from proofs.catalogue import AXIOMS, PREMISES
from proofs.transitions import TRANSITIONS
from tests.lift.differential import check_function

OUTSIDE = {
    "kernel.tags": "bits and bytes of a tag: integer arithmetic with loops, tested by its own properties",
    "kernel.tag_list_text": "text: loops over lines, tested by its own properties",
    "kernel.error_correction": "bits of a telegram: tested by its own properties",
    "kernel.telegram": "bytes of a telegram, keyed hash: tested by its own properties",
    "kernel.link": "in its own world: tests/onboard/test_agreement_of_link_and_joint.py",
    "models.world.start": "builds the first state for a host; nothing in it is proved",
    "models.world.formations": "a host's map from runs to the order of cars; nothing in it is proved",
}
"""Modules that are not lifted, and why."""

T, U = Train("t"), Train("u")
UNIVERSE: dict[Any, list[Any]] = {
    Block: [Block("a"), Block("b")],
    Route: [Route("r"), Route("q")],
    Point: [Point("p"), Point("w")],
    Position: [Position("n"), Position("r")],
    Train: [T, U],
    Car: [Car("c"), Car("d")],
    Cab: [Cab("f"), Cab("g")],
    Tag: [Tag("1"), Tag("2")],
    TagList: [TagList("out"), TagList("in")],
    Record: [Record("x"), Record("y")],
    Serial: [Serial(0), Serial(1), Serial(2)],
    UnitLife: [UnitLife(0), UnitLife(1)],
    TerminalLife: [TerminalLife(0), TerminalLife(1)],
    Epoch: [Epoch(0), Epoch(1)],
    Run: [
        Run(Serial(1), T, UnitLife(0), Route("r")),
        Run(Serial(2), U, UnitLife(1), Route("q")),
        Run(Serial(2), T, UnitLife(1), Route("q")),
    ],
    Read: [Read(Tag("1"), Record("x")), Read(Tag("2"), Record("y")), Read(Tag("1"), Record("y"))],
}
CROSSING: dict[Any, list[Any]] = {
    CrossingTrack: [CrossingTrack("up"), CrossingTrack("down")],
    CrossingTrain: [CrossingTrain("t"), CrossingTrain("u")],
    CrossingName: [CrossingName("c"), CrossingName("d")],
}
"""Names of the level crossing, whose restarts stand beside the others'."""
AT_A_CROSSING = {f"kernel.restarts.restart_{machine}" for machine in ("crossing", "ranging_schedule", "start_point")}


def functions() -> Iterator[Callable[..., Any]]:
    """Every public function of kernel, world and invariants, and the axioms."""
    for package in (kernel, models.world, invariants):
        for found in pkgutil.iter_modules(package.__path__, f"{package.__name__}."):
            if found.name in OUTSIDE:
                continue
            module = importlib.import_module(found.name)
            yield from (
                value
                for value in vars(module).values()
                if inspect.isfunction(value) and value.__module__ == module.__name__
            )
    yield from AXIOMS.values()


FUNCTIONS = {f"{function.__module__}.{function.__name__}": function for function in functions()}


def test_every_transition_axiom_and_premise_is_compared() -> None:
    assert {*TRANSITIONS, *AXIOMS.values(), *PREMISES.values()} <= set(FUNCTIONS.values())
    assert len(FUNCTIONS) > 200


@pytest.mark.sampled(6)
@pytest.mark.parametrize("name", FUNCTIONS)
def test_cpython_and_lifted_terms_agree(name: str) -> None:
    universe = CROSSING if name in AT_A_CROSSING else UNIVERSE
    check_function(FUNCTIONS[name], universe, examples=10, symbolic=False)
