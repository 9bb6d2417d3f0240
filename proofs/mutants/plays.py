"""The witnesses of theories beside the interlocking: played, each step noted, and as judges of mutants."""

from __future__ import annotations

import functools
import importlib
import importlib.util
import inspect
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any
from unittest.mock import patch

from proofs.mutated import Sources, running
from proofs.theories import THEORIES

ERRORS = (AssertionError, KeyError, AttributeError, TypeError, ZeroDivisionError, IndexError)
"""How a witness fails: it says so, or a step is not defined."""

Witness = Callable[[], Any]


@dataclass(frozen=True)
class Call:
    """One step of a witness, as it was taken."""

    witness: str
    step: str
    site: Any
    before: Any
    event: Mapping[str, Any]
    after: Any


HOMES = ("proofs.onboard", "proofs.crossing", "proofs.alarm", "proofs.tram")
"""Where theories beside the interlocking live, each with its witnesses."""


@functools.cache
def witnesses(theory: str) -> Mapping[str, Witness]:
    """The witnesses of a theory by name; none, if it has no file of them."""
    for home in HOMES:
        name = f"{home}.witnesses.{theory}"
        if importlib.util.find_spec(name) is not None:
            return {witness.__name__: witness for witness in importlib.import_module(name).WITNESSES}
    return {}


@functools.cache
def calls_of(theory: str) -> list[Call]:
    """Every step of every witness of a theory."""
    noted: list[Call] = []
    for name, witness in witnesses(theory).items():
        steps = {step: _noting(name, step, function, noted) for step, function in THEORIES[theory].steps.items()}
        with patch.dict(THEORIES[theory].steps, steps):
            witness()
    return noted


def _noting(witness: str, step: str, function: Callable[..., Any], noted: list[Call]) -> Callable[..., Any]:
    names = list(inspect.signature(function).parameters)

    @functools.wraps(function)
    def run(*values: Any, **named: Any) -> Any:
        result = function(*values, **named)
        told = {**dict(zip(names, values, strict=False)), **named}
        event = {name: value for name, value in told.items() if name not in ("site", "system")}
        noted.append(Call(witness, step, told["site"], told["system"], event, result))
        return result

    return run


def failing(theory: str, sources: Sources, first_only: bool = True) -> list[tuple[str, str]]:
    """The witnesses of a theory that fail with functions replaced, and what they say."""
    found = []
    for name, witness in witnesses(theory).items():
        try:
            with running(sources):
                witness()
        except ERRORS as error:
            found.append((name, f"{type(error).__name__}: {error}"))
            if first_only:
                break
    return found
