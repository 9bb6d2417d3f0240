"""The table of survivors: why each drop that breaks no invariant may, or must not, be made.

Three classes, each of them checked: *implied* (what is dropped follows from the rest, proved on
every layout), *service* (a named witness fails), *second line* (killed together with another drop).
"""

from __future__ import annotations

import tomllib
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache
from pathlib import Path

from proofs import canaries
from proofs.catalogue import INTERLOCKING
from proofs.lift.sources import Code
from proofs.mutants.edits import Mutant
from proofs.mutants.onlookers import failures
from proofs.mutants.sameness import of_the_function, proved, sameness
from proofs.mutants.targets import called_by, mutants, rows_of
from proofs.mutants.trial import ready_for, tried_with
from proofs.reach import calls
from proofs.theories import THEORIES, theory_of
from proofs.workbench import Workbench

FILES = tuple(sorted(Path(__file__).parent.glob("classes*.toml")))
"""Of the interlocking, and of the theories beside it."""

IMPLIED, SERVICE, SECOND_LINE = "implied", "service", "second_line"


@dataclass(frozen=True)
class Entry:
    """The class of a mutant: ``why`` in the field's words.

    ``because``: for *implied*, the axioms and invariants it follows from.
    ``witness``: for *service*, the witness that fails.
    ``pair``: for *second line*, the mutant that it is killed together with.
    """

    mutant: str
    kind: str
    why: str
    because: tuple[str, ...] = ()
    witness: str = ""
    pair: str = ""


@cache
def table() -> dict[str, Entry]:
    """Every entry by mutant."""
    found: dict[str, Entry] = {}
    for file in FILES:
        for entry in _entries(file):
            if entry.mutant in found:
                raise ValueError(f"{file.name}: {entry.mutant} stands twice")
            found[entry.mutant] = entry
    return found


def _entries(file: Path) -> Iterator[Entry]:
    for kind, groups in tomllib.loads(file.read_text(encoding="utf-8")).items():
        for group in groups:
            for name in group["mutants"]:
                yield Entry(
                    name,
                    kind,
                    group["why"],
                    tuple(group.get("because", ())),
                    group.get("witness", ""),
                    group.get("pair", ""),
                )


@cache
def bench(theory: str = INTERLOCKING.name) -> Workbench:
    """The workbench of a theory in this process, for proofs on every layout."""
    return Workbench(THEORIES[theory])


def objection(entry: Entry) -> str:
    """Check an entry; say what is wrong with it, or nothing."""
    mutant = mutants().get(entry.mutant)
    if mutant is None:
        return "there is no such mutant any more"
    if entry.kind == IMPLIED:
        return not_implied(mutant, list(entry.because))
    if entry.kind == SERVICE:
        ready_for(mutant)
        with mutant.planted():
            failing = [failure.witness for failure in failures(mutant, mutant.sources, first_only=False)]
        return "" if entry.witness in failing else f"{entry.witness} does not fail; these do: {failing}"
    if entry.kind == SECOND_LINE:
        return not_second(mutant, entry.pair)
    return f"no class {entry.kind}"


def not_implied(mutant: Mutant, because: list[str]) -> str:
    """Say in which transition the drop could make a difference, as far as is proved.

    A machine that is proved alone is asked where it is: what puts it together with others rests on that.
    """
    told = [name for theory in THEORIES.values() for name, claim in theory.read.items() if asks(claim, mutant)]
    if mutant.is_of_a_module and told:
        return f"{told[0]} reads it, and so becomes another with it"
    rows = rows_of(mutant)
    alone = [row for row in rows if not theory_of(row)[0].parts]
    for transition in alone or rows:
        home, name = theory_of(transition)
        theory = home.name
        missed = [each["canary"] for each in canaries.seen(("z3", "cvc5"), theory) if not each["noticed"]]
        if missed:
            return f"a solver does not notice {missed[0]}: nothing that it proves is believed"
        mine = bench(theory)
        known = [name for name in because if name in {**mine.assumed, **mine.invariants}]
        if proved(mine, sameness(mine, transition, mutant.sources, mutant.planted()), known):
            continue
        if not same_above(mine, mutant, mutant.function, home.steps[name]):
            return f"not proved to make no difference in {transition}"
    return ""


def same_above(mine: Workbench, mutant: Mutant, function: Code, step: Code) -> bool:
    """Tell whether it is proved that the function, or else each that calls it on the way from the step, is the same.

    What is the same whatever it is handed makes no difference to what calls it.
    """
    if mutant.is_of_a_module or function is step:
        return False
    if proved(mine, of_the_function(mine, function, mutant.sources), []):
        return True
    callers = [each for each in (step, *called_by(step)) if function in calls(each)]
    return all(same_above(mine, mutant, caller, step) for caller in callers)


def asks(claim: Code, mutant: Mutant) -> bool:
    """Tell whether a predicate reads what a mutant changes."""
    return any(map(mutant.touches, (claim, *called_by(claim))))


def not_second(mutant: Mutant, pair: str) -> str:
    """Say why a pair of drops is not one that only together is killed."""
    other = mutants().get(pair)
    if other is None:
        return f"there is no mutant {pair}"
    ready_for(mutant)
    with other.planted():
        verdict = tried_with(mutant, {**mutant.sources, **other.sources})
    return "" if verdict.outcome == "counterexample" else "no counterexample to both drops together"
