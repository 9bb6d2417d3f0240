"""Tries mutants, as many as wanted at a time, and checks the class of each that survives."""

from __future__ import annotations

import re
from collections.abc import Callable
from typing import Any

from models.processes import Workers, as_they_end
from proofs.mutants.classes import SERVICE, objection, table
from proofs.mutants.record import Trials
from proofs.mutants.targets import mutants, of_interlocking, rows_of, theories_with
from proofs.mutants.trial import tried
from proofs.sampling import sampled

Verdicts = dict[str, dict[str, Any]]
Progress = Callable[[int, int, str, dict[str, Any]], object]
"""Told of each trial as it ends: how many have ended, of how many, the mutant, its verdict."""


def try_all(names: list[str], jobs: Workers, trials: Trials, progress: Progress = lambda *_: None) -> Verdicts:
    """Try those that have no verdict yet, judge all, and keep it."""
    todo = [name for name in names if name not in trials.verdicts]
    for done, (name, verdict) in enumerate(as_they_end(trial, todo, jobs), 1):
        trials.note(name, [theory.name for theory in theories_with(mutants()[name])], verdict)
        progress(done, len(todo), name, verdict)
    dead = {name: killed(name, trials.verdicts[name]["outcome"]) for name in names}
    for name, kind, wrong in as_they_end(judged, list(dead.items()), jobs):
        trials.verdicts[name] |= {"class": kind, "objection": wrong}
    trials.keep()
    return {name: trials.verdicts[name] for name in names}


def trial(name: str) -> tuple[str, dict[str, Any]]:
    """Try one mutant."""
    return name, tried(mutants()[name]).record()


def killed(name: str, outcome: str) -> bool:
    """Tell whether a mutant needs no class.

    In the interlocking what only a witness kills stands in the table, with what is lost; beside it a
    witness is enough, since its docstring says so.
    """
    return outcome == "counterexample" or (
        outcome == "witness" and not any(map(of_interlocking, rows_of(mutants()[name])))
    )


def judged(mutant: tuple[str, bool]) -> tuple[str, str, str]:
    """The class of a mutant, and what is wrong with it if anything is; given its name, and whether it was killed."""
    name, is_killed = mutant
    entry = table().get(name)
    wrong = by_the_table(name, is_killed)
    if is_killed or entry is None:
        return name, "", wrong
    return name, entry.kind, objection(entry)


def by_the_table(name: str, is_killed: bool) -> str:
    """Say what is wrong with a mutant by the table of classes alone, or nothing."""
    entry = table().get(name)
    if is_killed:
        return "killed: it needs no class" if entry is not None and entry.kind != SERVICE else ""
    return "" if entry else "stands in no class"


def chosen(only: str, sample: int | None) -> list[str]:
    """The mutants to try."""
    return sampled([name for name in mutants() if re.search(only, name)], sample)
