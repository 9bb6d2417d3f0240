"""The witnesses as judges: which of them fails if a function is replaced.

Each is played once as it is, and every step it takes is noted.  A mutant that gives the same on
all those steps cannot fail a witness; where it does not, the witness is played with the mutant.
"""

from __future__ import annotations

import functools
import inspect
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Any
from unittest.mock import patch

from proofs.catalogue import INTERLOCKING
from proofs.lift.sources import Code
from proofs.mutants import plays, services, services_of_nature, services_on_board
from proofs.mutants.edits import Mutant
from proofs.mutants.targets import called_by, theories_with
from proofs.mutated import Sources, running, table_running
from proofs.witnesses.registry import WITNESSES, Witness
from proofs.witnesses.scenario import STEPS, Scenario

ONLOOKERS: Mapping[str, Witness] = {
    **WITNESSES,
    **{
        name: value
        for module in (services, services_of_nature, services_on_board)
        for name, value in vars(module).items()
        if inspect.isfunction(value)
        and not name.startswith("_")
        and list(inspect.signature(value).parameters) == ["steps"]
    },
}
"""Every witness by name: those that show what the system does, and those for the guards that safety does not need."""

ERRORS = (AssertionError, KeyError, AttributeError, TypeError)
"""How a witness fails: it says so, or a step looks up what is not there."""


@dataclass(frozen=True)
class Call:
    """One step of a witness, as it was taken."""

    step: str
    values: tuple[Any, ...]
    named: Mapping[str, Any]
    result: Any


@dataclass(frozen=True)
class Failure:
    """A witness that fails with a mutant, and what it says."""

    witness: str
    message: str


@contextmanager
def unwatched() -> Iterator[None]:
    """Play witnesses without looking at invariants: what counts here is what they say themselves."""
    with patch.object(Scenario, "_watch"):
        yield


@functools.cache
def calls() -> Mapping[str, list[Call]]:
    """Every step of every witness."""
    found: dict[str, list[Call]] = {}
    with unwatched():
        for name, witness in ONLOOKERS.items():
            noted = found[name] = []
            witness({step: _noting(step, function, noted) for step, function in STEPS.items()})
    return found


def _noting(step: str, function: Callable[..., Any], noted: list[Call]) -> Callable[..., Any]:
    @functools.wraps(function)
    def run(*values: Any, **named: Any) -> Any:
        result = function(*values, **named)
        noted.append(Call(step, values, named, result))
        return result

    return run


def steps_of(function: Code) -> frozenset[str]:
    """The steps and reasons that a function takes part in."""
    return frozenset(name for name, step in STEPS.items() if step is function or function in called_by(step))


def failures(mutant: Mutant, sources: Sources, first_only: bool = True) -> list[Failure]:
    """The witnesses that fail with a mutant planted, of all theories that it takes part in."""
    found: list[Failure] = []
    for theory in theories_with(mutant):
        if theory is INTERLOCKING:
            found += _failures(mutant, sources, first_only)
        else:
            found += [Failure(*one) for one in plays.failing(theory.name, sources, first_only)]
        if found and first_only:
            break
    return found


def _failures(mutant: Mutant, sources: Sources, first_only: bool) -> list[Failure]:
    steps = frozenset[str]().union(*map(steps_of, mutant.functions))
    found: list[Failure] = []
    for name, noted in calls().items():
        if not any(_differs(call, sources) for call in noted if call.step in steps):
            continue
        try:
            with unwatched():
                ONLOOKERS[name](table_running(STEPS, sources))
        except ERRORS as error:
            found.append(Failure(name, f"{type(error).__name__}: {error}"))
            if first_only:
                break
    return found


def _differs(call: Call, sources: Sources) -> bool:
    try:
        with running(sources):
            return bool(STEPS[call.step](*call.values, **call.named) != call.result)
    except ERRORS:
        return True
