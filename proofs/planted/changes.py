"""``python -m proofs.planted.changes [--only PATTERN] [--jobs N]``: would a proof notice these changes of the kernel?

Each is a change of text in one place, as a careless or a malicious maintainer might make it
(``changes.toml``).  What becomes another with it, functions and constants, is lifted anew, claims that ask the kernel
too, and the obligations of its theories are put to the solvers as ``heisoku prove`` puts them.  Only an
obligation that is refuted notices anything: *unknown* does not.

Exit code 0 if each is refuted, or fails the witness that its entry names, but for those whose entry says why nothing
need notice; else 1.
"""

from __future__ import annotations

import argparse
import ast
import importlib
import re
import time
import tomllib
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any, Protocol

from models.processes import as_they_end
from proofs import canaries, scripts, solvers
from proofs.lift import Mismatch, OutsideSubset
from proofs.lift.sources import Code
from proofs.mutants.constants import everywhere, reads
from proofs.mutants.plays import failing
from proofs.mutated import Sources
from proofs.reach import called_by
from proofs.run import laid_out
from proofs.theories import THEORIES, columns, row_of
from proofs.theory import READING, START, Theory
from proofs.workbench import Part, Workbench

ROOT = Path(__file__).resolve().parent.parent.parent
FILE = Path(__file__).with_name("changes.toml")


@dataclass(frozen=True)
class Change:
    """A change: ``why`` it is one for the worse; ``old`` stands once in ``file``, and ``new`` takes its place.

    ``theories``: those whose obligations are asked.
    ``harmless``: why it lets nothing unsafe happen, if so.
    ``witness``: the witness of its first theory that fails with it, where no theorem speaks of what it spoils;
    ``unproved``: why none does.
    """

    name: str
    group: str
    why: str
    file: str
    old: str
    new: str
    theories: tuple[str, ...]
    harmless: str = ""
    witness: str = ""
    unproved: str = ""

    @property
    def excused(self) -> str:
        """In a word, why no proof need notice it, if one need not."""
        return "harmless" if self.harmless else ""

    @property
    def module(self) -> str:
        """The module that it is made in."""
        return self.file.removesuffix(".py").replace("/", ".")


@cache
def changes() -> Mapping[str, Change]:
    """Every change by name."""
    entries = tomllib.loads(FILE.read_text(encoding="utf-8"))
    return {name: Change(name, **{**entry, "theories": tuple(entry["theories"])}) for name, entry in entries.items()}


# ---- what becomes another


@dataclass(frozen=True)
class Planted:
    """What a change makes of a module: functions with other bodies, constants with other values."""

    module: str
    sources: Sources
    constants: Mapping[str, Any]

    def touches(self, function: Code) -> bool:
        """Tell whether a function, or one that it calls, is another with the change."""
        return any(
            each in self.sources or any(reads(each, self.module, constant) for constant in self.constants)
            for each in (function, *called_by(function))
        )


class Text(Protocol):
    """A text in the place of another that stands once in a file."""

    @property
    def name(self) -> str:
        """What it is told as."""

    @property
    def file(self) -> str:
        """The file, from the root."""

    @property
    def module(self) -> str:
        """The module that the file is."""

    @property
    def old(self) -> str:
        """What goes."""

    @property
    def new(self) -> str:
        """What comes."""


def planted(change: Text) -> Planted:
    """Read a module with a change in it; ``ValueError`` if the text does not stand there once, or more is changed."""
    text = (ROOT / change.file).read_text(encoding="utf-8")
    if text.count(change.old) != 1:
        raise ValueError(f"{change.name}: {change.file} has the text {text.count(change.old)} times")
    module = importlib.import_module(change.module)
    before = {ast.dump(node) for node in ast.parse(text).body}
    sources: dict[Code, ast.FunctionDef] = {}
    constants: dict[str, Any] = {}
    for node in ast.parse(text.replace(change.old, change.new)).body:
        if ast.dump(node) in before:
            continue
        if isinstance(node, ast.FunctionDef):
            sources[getattr(module, node.name)] = node
        elif isinstance(node, ast.Assign) and isinstance(node.targets[0], ast.Name):
            value = eval(compile(ast.Expression(node.value), change.file, "eval"), vars(module))
            constants[node.targets[0].id] = value
        else:
            raise ValueError(f"{change.name}: neither a function nor a constant is changed")
    return Planted(change.module, sources, constants)


@contextmanager
def holding(made: Planted) -> Iterator[None]:
    """Let constants have their other values until the block ends, wherever they are read."""
    with ExitStack() as stack:
        for name, value in made.constants.items():
            stack.enter_context(everywhere(made.module, name, value))
        yield


def cells(made: Planted, theory: Theory) -> Iterator[tuple[str, str]]:
    """Give row and column of each obligation that a change may make another: of the steps that it touches.

    Where something that is said of states is touched, everything that rests on it is.
    """
    said = any(made.touches(claim) for claim in theory.read.values())
    for name in theory.rows:
        touched = name not in (START, READING) and made.touches(theory.steps[name])
        if said or touched:
            row = row_of(theory, name)
            yield from ((row, column) for column in columns(row))


# ---- whether a proof notices


@dataclass(frozen=True)
class Seen:
    """What the solvers said: ``outcome`` is refuted, undecided, proved, or not lifted.

    ``by``: the obligation that is refuted, or the first that is undecided, and the solver that says so.
    """

    name: str
    outcome: str
    by: str
    seconds: float

    @property
    def objection(self) -> str:
        """What is wrong with that."""
        change = changes()[self.name]
        if self.outcome == "refuted":
            said = change.excused or ("seen by a witness alone" if change.witness else "")
            return f"refuted, and said to be {said}" if said else ""
        if change.witness:
            return "" if self.by == change.witness else f"the witness does not notice: {self.outcome}"
        return "" if change.excused else f"not noticed: {self.outcome}"


def tried(name: str) -> Seen:
    """Make a change and ask what becomes of the proofs of its theories."""
    began = time.perf_counter()
    change = changes()[name]
    made = planted(change)
    open_parts: list[tuple[str, Part]] = []
    outcome, by = "proved", ""
    with holding(made):
        for theory in (THEORIES[each] for each in change.theories):
            try:
                by = _refuted(made, theory, open_parts)
            except (OutsideSubset, Mismatch) as error:
                outcome, by = "not lifted", str(error)
            if by:
                break
        if by and outcome == "proved":
            outcome = "refuted"
        elif not by and open_parts:
            by = _refuted_by_the_other(open_parts)
            outcome, by = ("refuted", by) if by else ("undecided", open_parts[0][0])
        if outcome == "proved" and change.witness in dict(failing(change.theories[0], made.sources, first_only=False)):
            outcome, by = "witnessed", change.witness
    return Seen(name, outcome, by, round(time.perf_counter() - began, 1))


def _refuted(made: Planted, theory: Theory, open_parts: list[tuple[str, Part]]) -> str:
    """Ask Z3 until an obligation of a theory is refuted, and name it; note what it leaves open."""
    bench = Workbench(theory, named=theory.quantified, sources=made.sources)
    for row, column in cells(made, theory):
        for part in laid_out(row, column, scripts.hypotheses(row, column), bench):
            answer = solvers.ask("z3", part, 0).answer
            if answer == "sat":
                return f"{row} × {column} by z3"
            if answer == "unknown":
                open_parts.append((f"{row} × {column}", part))
    return ""


def _refuted_by_the_other(open_parts: Sequence[tuple[str, Part]]) -> str:
    """Ask cvc5 of what Z3 leaves open until it refutes an obligation, by a finite model at last, and name that."""
    for cell, part in open_parts:
        if solvers.ask("cvc5", part, 0).answer == "sat":
            return f"{cell} by cvc5"
        if canaries.answered("cvc5", part) == "sat":
            return f"{cell} by cvc5, in a finite model"
    return ""


def main(arguments: Sequence[str] | None = None) -> int:
    """Try the changes chosen, one line for each, and give the sum of each group."""
    parser = argparse.ArgumentParser(prog="python -m proofs.planted.changes", description=__doc__)
    parser.add_argument("--only", default="", metavar="PATTERN", help="a regular expression on the names of changes")
    parser.add_argument("--jobs", type=int, default=1, metavar="N", help="processes")
    given = parser.parse_args(arguments)
    names = [name for name in changes() if re.search(given.only, name)]
    count: Counter[tuple[str, str]] = Counter()
    objections = 0
    # What Z3 makes of a question may hang on what its process was asked before; so each change has one of its own.
    for seen in as_they_end(tried, names, given.jobs, one_each=True):
        change = changes()[seen.name]
        count[change.group, f"{seen.outcome}, {change.excused}" if change.excused else seen.outcome] += 1
        objections += bool(seen.objection)
        print(f"{seen.outcome:10} {seen.seconds:6.1f} s  {seen.name}: {seen.by}", flush=True)
        if seen.objection:
            print(f"           {seen.objection}: {change.why}", flush=True)
    for (group, outcome), many in sorted(count.items()):
        print(f"{group}: {many} {outcome}")
    return 1 if objections else 0


if __name__ == "__main__":
    raise SystemExit(main())
