"""Who had nothing to say is not asked again until something has changed; that leaves nothing unsaid."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import pytest

from kernel.names import Train
from models.simulation.faults import Setting
from models.simulation.simulation import Simulation
from models.simulation.talking import Talk
from models.world.state import System
from tests.simulation.lines import HARD, SAMPLES, plan

OFTEN_CANCELLED = {**HARD, "route_cancelled": Setting(60.0, 0, 0)}
"""A run that is wanted back waits for its train, and that the train comes to rest is no change of what is looked at."""
Told = tuple[list[tuple[str, Mapping[str, Any]]], list[tuple[int, int]]]


class NeverQuiet(dict[Train, Any]):
    """Forgets at once who had nothing to say."""

    def __setitem__(self, train: Train, looked_at: Any) -> None:
        del train, looked_at


def told(seed: int, place: str) -> Told:
    """Every step of a line, and second by second how many telegrams there were and how many of them were lost."""
    steps: list[tuple[str, Mapping[str, Any]]] = []
    seconds: list[tuple[int, int]] = []

    def step(name: str, event: Mapping[str, Any], system: System) -> None:
        del system
        steps.append((name, dict(event)))

    sim = Simulation(plan(place, seed, trains=2, hours=0.2, chosen=OFTEN_CANCELLED), step)
    sim.run(lambda now: seconds.append((now.air.sent, now.air.lost)))
    return steps, seconds


@pytest.mark.parametrize("place", SAMPLES)
@pytest.mark.parametrize("seed", range(3))
def test_it_leaves_nothing_unsaid(place: str, seed: int, monkeypatch: pytest.MonkeyPatch) -> None:
    began, asked = Talk.__init__, [0, 0]
    look = Talk._to_centre

    def begin(talk: Talk, *given: Any) -> None:
        began(talk, *given)
        if always:
            talk._nothing_said = NeverQuiet()

    def asks(talk: Talk, train: Train) -> Any:
        asked[always] += 1
        return look(talk, train)

    monkeypatch.setattr(Talk, "__init__", begin)
    monkeypatch.setattr(Talk, "_to_centre", asks)
    always = False
    quiet = told(seed, place)
    always = True
    assert told(seed, place) == quiet
    assert quiet[0]
    assert asked[False] < asked[True]
