"""What is mutated, and which transitions each function takes part in."""

from __future__ import annotations

import importlib.util
import pkgutil
from collections.abc import Mapping
from functools import cache
from types import ModuleType

import kernel
import models.alarm
import models.crossing
import models.onboard
import models.tram
import models.world
from proofs.catalogue import INTERLOCKING
from proofs.lift.sources import Code
from proofs.mutants.constants import constants_of
from proofs.mutants.edits import Mutant, functions_of, mutants_of
from proofs.reach import called_by, transitions_of
from proofs.theories import THEORIES, theory_of
from proofs.theory import Theory

__all__ = [
    "called_by",
    "modules",
    "mutants",
    "of_interlocking",
    "rows_of",
    "theories_of",
    "theories_with",
    "transitions_of",
]

NOT_STEPS = frozenset(
    {
        "kernel.alarm.limits",
        "kernel.error_correction",
        "kernel.machine.centre",
        "kernel.machine.messages",
        "kernel.machine.point_terminal",
        "kernel.machine.unit",
        "kernel.maps",
        "kernel.onboard.frames",
        "kernel.onboard.limits",
        "kernel.persistence",
        "kernel.tag_list_text",
        "kernel.tags",
        "kernel.telegram",
        "kernel.tram.frames",
        "kernel.tram.limits",
        "models.world.formations",
        "models.world.premises",
        "models.world.start",
    }
)
"""Modules that no transition is made of: what a state is kept in, tables, codes, limits, premises, the start.

The machines of `kernel.machine` only choose among steps; `proofs/lints_machines.py` holds them to that.
"""
BESIDE = (models.onboard, models.crossing, models.alarm, models.tram)
"""Worlds of theories beside the interlocking."""
SINGLE = ("models.link",)
"""Worlds that are one file."""


def modules() -> list[ModuleType]:
    """The modules that transitions are made of."""
    names = [name for room in (kernel, models.world, *BESIDE) for name in _inside(room)]
    names += [name for name in SINGLE if importlib.util.find_spec(name) is not None]
    return [importlib.import_module(name) for name in names if name not in NOT_STEPS]


def _inside(room: ModuleType) -> list[str]:
    return [found.name for found in pkgutil.walk_packages(room.__path__, f"{room.__name__}.") if not found.ispkg]


@cache
def mutants() -> Mapping[str, Mutant]:
    """Every mutant by name: of functions, and of the kernel's constants."""
    functions = [function for function in functions_of(*modules()) if not is_said_only(function)]
    found = [mutant for function in functions for mutant in mutants_of(function)]
    reading = [function for function in functions if theories_of(function)]
    for module in modules():
        if module.__name__.startswith("kernel."):
            found += constants_of(module, reading)
    return {mutant.name: mutant for mutant in found}


def rows_of(mutant: Mutant) -> tuple[str, ...]:
    """The rows of the transitions that a mutant takes part in."""
    return tuple(dict.fromkeys(row for function in mutant.functions for row in transitions_of(function)))


def theories_with(mutant: Mutant) -> list[Theory]:
    """The theories that a mutant takes part in."""
    return list(dict.fromkeys(theory for function in mutant.functions for theory in theories_of(function)))


def is_said_only(function: Code) -> bool:
    """Tell whether a function of a world is no part of a step: a premise, the start, or a word of a claim."""
    return function.__module__.startswith((*(f"{room.__name__}." for room in BESIDE), *SINGLE)) and not transitions_of(
        function
    )


def of_interlocking(row: str) -> bool:
    """Tell whether a row is the interlocking's."""
    return theory_of(row)[0] is INTERLOCKING


def said(theory: Theory) -> list[Code]:
    """What is said of a theory's states, at the start and ever after."""
    return [*theory.initial.values(), *theory.invariants.values()]


@cache
def theories_of(function: Code) -> list[Theory]:
    """The theories that a function takes part in: in steps, or else in what is said of a machine."""
    stepping = [theory_of(row)[0] for row in transitions_of(function)]
    claiming = [
        theory
        for theory in THEORIES.values()
        if theory is not INTERLOCKING and any(function in called_by(claim) for claim in said(theory))
    ]
    return list(dict.fromkeys(stepping or claiming))
