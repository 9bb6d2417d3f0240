"""Proves the suite: every row of the matrix, by the solvers asked for, on as many processes as wanted."""

from __future__ import annotations

import gzip
import hashlib
import inspect
import re
import time
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cache
from itertools import groupby
from operator import itemgetter
from pathlib import Path

from models.processes import Workers, spread
from models.streams import write_whole
from proofs import canaries, lints_apart, lookups, promised, scripts, smtlib, solvers
from proofs.kept import Answered, Keeping, Laid, opened
from proofs.records import CanarySeen, Obligation, Report, Source, Verdict
from proofs.theories import ROWS, THEORIES, columns, theory_of
from proofs.theory import EVERY_LOOKUP_IS_DEFINED, READING
from proofs.workbench import Part, Workbench

ROOT = Path(__file__).resolve().parent.parent
NOTHING_TO_ASK = "nothing is asked: nothing is looked up there"


@dataclass(frozen=True)
class Task:
    """A few obligations of one row, for one process.

    ``keep``: the folder in which their texts are kept; ``answers``: the file of answers from earlier runs, where the
    process can read it.
    """

    row: str
    columns: tuple[str, ...]
    solvers: tuple[str, ...]
    seeds: int
    keep: Path | None = None
    answers: Path | None = None


@cache
def bench(theory: str = "interlocking") -> Workbench:
    """The workbench of a theory in this process; lifted once."""
    return Workbench(THEORIES[theory], named=THEORIES[theory].quantified)


def laid_out(row: str, column: str, names: list[str] | None, on: Workbench | None = None) -> list[Part]:
    """Lay out one obligation with these hypotheses; ``None`` means every one there is.

    ``on``: the workbench of its theory to lay it out on, if not this process's.
    """
    theory, name = theory_of(row)
    here = bench(theory.name) if on is None else on
    if name == READING:
        return lookups.parts(here, column, names)
    if column == EVERY_LOOKUP_IS_DEFINED:
        return lookups.parts(here, name, names)
    if column in theory.promises:
        return promised.parts(here, name, column, names)
    return here.parts(name, column, names)


def parts(row: str, column: str) -> list[Part]:
    """Lay out one obligation with the hypotheses of its script."""
    return laid_out(row, column, scripts.hypotheses(row, column))


@cache
def source(row: str, column: str) -> Source:
    """Tell where the claim of an obligation stands: the predicate's lines, or the transition's."""
    theory, name = theory_of(row)
    function = theory.steps[name] if column == EVERY_LOOKUP_IS_DEFINED else theory.said(column)
    return place_of(function)


@cache
def place_of(function: Callable[..., object]) -> Source:
    """Tell where a function stands."""
    lines, first = inspect.getsourcelines(function)
    path = Path(inspect.getfile(function)).resolve().relative_to(ROOT)
    return {"file": str(path), "lines": (first, first + len(lines) - 1)}


def lifting_seconds() -> float:
    """Say how long this process has lifted so far."""
    return sum(bench(theory).seconds for theory in THEORIES)


def text_of(asked: list[Part]) -> bytes:
    """The SMT-LIB text of an obligation: all its parts, one after the other, each with its question."""
    return "".join(smtlib.script(part) for part in asked).encode()


def digest_of(asked: list[Part]) -> str:
    """The hash of that text."""
    return hashlib.sha256(text_of(asked)).hexdigest()


def axioms_of(row: str, column: str, asked: list[Part]) -> list[str]:
    """Name what is assumed beside the hypotheses: what always holds of the symbols in an obligation."""
    named = {name for part in asked for name in part.hypotheses}
    return sorted(named - set(scripts.hypotheses(row, column)))


def settle(row: str, column: str, solver: str, seed: int, asked: list[Part], digest: str) -> Obligation:
    """Ask one solver for every part of one obligation; any answer but ``unsat`` leaves it unproved."""
    replies = [solvers.ask(solver, part, seed) for part in asked]
    answers = {reply.answer for reply in replies}
    verdict: Verdict = "refuted" if "sat" in answers else "proved" if answers <= {"unsat"} else "undecided"
    spent = max((reply.spent for reply in replies), default=0)
    seconds = round(sum(reply.seconds for reply in replies), 4)
    answer: Answered = {"verdict": verdict, "rlimit_spent": spent, "seconds": seconds}
    return recorded((row, column), (solver, seed), Laid(digest, axioms_of(row, column, asked), not asked), answer)


def recorded(cell: tuple[str, str], by: tuple[str, int], laid: Laid, answer: Answered) -> Obligation:
    """What is recorded of an obligation that was laid out, of a solver at a seed, and of its answer."""
    (row, column), (solver, seed) = cell, by
    told: Obligation = {
        "transition": row,
        "invariant": column,
        "hypotheses": scripts.hypotheses(row, column),
        "axioms": laid.axioms,
        "verdict": answer["verdict"],
        "solver": solver,
        "solver_version": solvers.version(solver),
        "seed": seed,
        "rlimit": solvers.BUDGET[solver],
        "rlimit_spent": answer["rlimit_spent"],
        "seconds": answer["seconds"],
        "smt2_sha256": laid.digest,
        "source": source(row, column),
    }
    if "kept" in answer:
        told["kept"] = answer["kept"]
    if laid.is_empty:
        told["note"] = NOTHING_TO_ASK
        if column != EVERY_LOOKUP_IS_DEFINED and theory_of(row)[1] != READING:
            told["verdict"] = "undecided"
    return told


@dataclass(frozen=True)
class Done:
    """A task settled; ``lifting``: seconds.  ``canaries``: what the solvers noticed in the process that settled it.

    ``altered``: answers that are not as they were kept.
    """

    obligations: list[Obligation]
    lifting: float
    canaries: list[CanarySeen]
    altered: Sequence[str] = ()


def work(task: Task) -> Done:
    """Settle a task, once the solvers of this process have been put to the test; what is kept is not asked."""
    store = opened(task.answers) if task.answers else None
    seen = [] if store else canaries.seen(task.solvers, theory_of(task.row)[0].name)
    before = lifting_seconds()
    found = []
    for column in task.columns:
        asked = parts(task.row, column)
        digest = digest_of(asked)
        if task.keep is not None:
            write_whole(kept(task.keep, task.row, column), gzip.compress(text_of(asked), mtime=0))
        laid = Laid(digest, axioms_of(task.row, column, asked), not asked)
        by = [(solver, seed) for solver in task.solvers for seed in range(task.seeds)]
        answers = store.answers(laid, by) if store else {}
        for each in by:
            if each in answers:
                found.append(recorded((task.row, column), each, laid, answers[each]))
                continue
            seen = seen or canaries.seen(task.solvers, theory_of(task.row)[0].name)
            found.append(settle(task.row, column, *each, asked, digest))
    return Done(found, lifting_seconds() - before, seen, store.altered if store else ())


def kept(folder: Path, row: str, column: str) -> Path:
    """The file that the text of an obligation is kept in."""
    return folder / row / f"{column}.smt2.gz"


def chosen(only: str | None) -> list[tuple[str, str]]:
    """Every obligation whose row and column match, in the order of the matrix."""
    pattern = re.compile(only or "")
    return [(row, column) for row in ROWS for column in columns(row) if pattern.search(f"{row} {column}")]


def tasks(cells: Iterable[tuple[str, str]], like: Task) -> Iterator[Task]:
    """Cut obligations into tasks, whole rows in a few pieces so that every process stays busy."""
    for row, of_row in groupby(cells, itemgetter(0)):
        named = [column for _, column in of_row]
        for start in range(0, len(named), 20):
            yield replace(like, row=row, columns=tuple(named[start : start + 20]))


def prove_all(
    *,
    solver: str = "z3",
    jobs: Workers = 2,
    seeds: int = 1,
    only: str | None = None,
    keep: Path | None = None,
    answers: Path | None = None,
    progress: Callable[[int, int, str], object] = lambda done, total, what: None,
) -> Report:
    """Prove every obligation whose row and column match ``only``; nothing matched gives an empty report.

    ``keep``: a folder for the SMT-LIB text of each; ``answers``: a file of answers, to take from and to add to.
    """
    began = time.perf_counter()
    asked = ("z3", "cvc5") if solver == "both" else (solver,)
    cells = chosen(only)
    keeping = Keeping(answers, [(one, seed) for one in asked for seed in range(seeds)]) if answers else None
    known = keeping.known(cells) if keeping else {}
    found = {
        cell: [recorded(cell, by, laid, answer) for by, answer in of.items()] for cell, (laid, of) in known.items()
    }
    beside = answers if isinstance(jobs, int) else None
    todo = list(tasks((cell for cell in cells if cell not in found), Task("", (), asked, seeds, keep, beside)))
    seen: dict[tuple[int, str, str], CanarySeen] = {}
    lifting = 0.0
    try:
        for done, settled in enumerate(spread(work, todo, jobs), 1):
            for each in settled.obligations:
                found.setdefault((each["transition"], each["invariant"]), []).append(each)
            lifting += settled.lifting
            seen |= {(each["process"], each["solver"], each["canary"]): each for each in settled.canaries}
            if keeping:
                keeping.keep(settled.obligations, settled.canaries, settled.altered)
            progress(done, len(todo), todo[done - 1].row)
        offences = _offences(keeping) if cells else []
    finally:
        if keeping:
            keeping.write()
    obligations = [each for cell in cells for each in found[cell]]
    said = keeping.said if keeping else ()
    return Report(obligations, lifting, time.perf_counter() - began, [*seen.values()], offences, said)


def _offences(keeping: Keeping | None) -> list[str]:
    def found() -> list[str]:
        return lints_apart.unlisted(lints_apart.offences(), lints_apart.listed())

    return keeping.once("offences", found) if keeping else found()
