"""A theory: a machine with its world, what is assumed of them, what can happen, and what is claimed.

The interlocking is one; every machine on board and the radio link is one.  What one theory claims
another may assume; ``docs/contracts.md`` says which.
"""

from __future__ import annotations

import inspect
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field
from types import ModuleType
from typing import Any

from proofs.promise import Predicate, Promise

START = "init"
"""The name of the first row of a theory's matrix."""
READING = "reading"
"""The name of its last row: of the predicates, each to be read without an error."""
EVERY_LOOKUP_IS_DEFINED = "every_lookup_is_defined"
"""The last column of the matrix, for transitions."""


@dataclass(frozen=True, eq=False)
class Theory:
    """One theory.

    ``site``: the type of what does not change; ``system``: the type of the state.
    ``steps``: transitions, functions of site, system and an event, by name.
    ``initial``: what holds at the start; ``invariants``: what is proved of every state;
    ``safety``: those of them that the safety case claims.  All of site and system.
    ``premises``: what is assumed of the site.
    ``axioms``: what is assumed of ``site.layout`` and ``site.ground``.
    ``promises``: what comes about at last, by name.
    ``parts``: the theories whose machines and worlds it puts together.
    ``quantified``: it speaks of any number of things; then a transition is stated by the fields it
    defines anew.  Plain arithmetic is easier where new values stand in place of those fields.
    """

    name: str
    site: type
    system: type
    steps: Mapping[str, Callable[..., Any]]
    initial: Mapping[str, Predicate]
    invariants: Mapping[str, Predicate]
    safety: Mapping[str, Predicate]
    premises: Mapping[str, Predicate] = field(default_factory=dict)
    axioms: Mapping[str, Predicate] = field(default_factory=dict)
    promises: Mapping[str, Promise] = field(default_factory=dict)
    quantified: bool = False
    parts: tuple[str, ...] = ()

    @property
    def read(self) -> dict[str, Predicate]:
        """Every predicate that is read, by name."""
        return {**self.axioms, **self.premises, **self.initial, **self.invariants}

    @property
    def claimed(self) -> tuple[str, ...]:
        """The columns that the safety case names: claims that always hold, and promises."""
        return (*self.safety, *self.promises)

    def said(self, column: str) -> Predicate:
        """Give the predicate that a column is named after."""
        return self.promises[column].goal if column in self.promises else self.read[column]

    @property
    def rows(self) -> tuple[str, ...]:
        """The rows of its matrix, in order."""
        return (START, *self.steps, READING)

    def columns(self, row: str) -> list[str]:
        """Give the columns of one of its rows, in order."""
        if row == READING:
            return [*self.read, *self.promises]
        return [*self.invariants, EVERY_LOOKUP_IS_DEFINED, *self.promises] if row in self.steps else [*self.invariants]


def by_name(functions: Iterable[Callable[..., Any]]) -> dict[str, Callable[..., Any]]:
    """List functions by their names."""
    return {function.__name__: function for function in functions}


def predicates(*modules: ModuleType) -> dict[str, Predicate]:
    """Collect the functions that the modules define, in their order."""
    return {
        name: value
        for module in modules
        for name, value in vars(module).items()
        if inspect.isfunction(value) and value.__module__ == module.__name__
    }
