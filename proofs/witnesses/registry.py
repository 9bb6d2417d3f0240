"""Every witness by name, and which of them shows what each transition does."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Mapping
from types import ModuleType

from kernel.refusal import Refusal
from proofs.witnesses import attacks, long_day, on_lines, refusals, restarts, routes, trains
from proofs.witnesses.scenario import STEPS, Scenario, Steps

Witness = Callable[[Steps], Scenario]
"""Plays a scenario with the transitions it is given; raises :class:`WitnessFailed` where it does not go as said."""


def _witnesses(*modules: ModuleType) -> Mapping[str, Witness]:
    """The public functions of the modules that take a table of steps and nothing else."""
    return {
        name: value
        for module in modules
        for name, value in vars(module).items()
        if inspect.isfunction(value)
        and value.__module__ == module.__name__
        and not name.startswith("_")
        and list(inspect.signature(value).parameters) == ["steps"]
    }


WITNESSES: Mapping[str, Witness] = {
    **_witnesses(routes, trains, attacks, restarts, refusals, long_day),
    **on_lines.WITNESSES,
}
"""By name, in order; the docstring of each says what it shows and which requirements that serves."""


def replay(steps: Steps = STEPS) -> Mapping[str, Scenario]:
    """Play every witness."""
    return {name: witness(steps) for name, witness in WITNESSES.items()}


def shown_by(played: Mapping[str, Scenario]) -> Mapping[str, tuple[str, ...]]:
    """For each transition the witnesses in which it fires with all that it changes said beforehand."""
    found: dict[str, list[str]] = {}
    for name, scenario in played.items():
        for step in {taken.step for taken in scenario.taken if taken.accepted and taken.effect_said}:
            found.setdefault(step, []).append(name)
    return {step: tuple(names) for step, names in sorted(found.items())}


def refused_by(played: Mapping[str, Scenario]) -> Mapping[Refusal, tuple[str, ...]]:
    """For each reason of refusal the witnesses in which it is given."""
    found: dict[Refusal, list[str]] = {}
    for name, scenario in played.items():
        for why in {taken.why for taken in scenario.taken if taken.why is not None}:
            found.setdefault(why, []).append(name)
    return {why: tuple(found[why]) for why in Refusal if why in found}
