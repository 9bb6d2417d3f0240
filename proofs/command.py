"""`heisoku prove`: the matrix of transitions and invariants, by one solver or both."""

from __future__ import annotations

from enum import StrEnum
from pathlib import Path
from typing import Annotated

import typer

from models.commands import (
    EVERY_CORE,
    Jobs,
    Json,
    Scheduler,
    bad_input_refused,
    complain,
    console,
    keep_apart,
    pattern,
    progress,
    refuse,
    workers,
    writable,
)
from proofs.records import write_json

JUnit = Annotated[Path | None, typer.Option("--junit", metavar="F", help="Write JUnit XML there.", show_default=False)]


Texts = Annotated[
    Path | None,
    typer.Option("--keep", metavar="DIR", help="Keep the SMT-LIB text of every obligation there.", show_default=False),
]
KeptAnswers = Annotated[
    Path | None,
    typer.Option(
        "--kept",
        metavar="F",
        help="Take answers of earlier runs from there, and add to them; for daily work: no evidence.",
        show_default=False,
    ),
]


class Solvers(StrEnum):
    """Which solvers to ask."""

    z3 = "z3"
    cvc5 = "cvc5"
    both = "both"


def prove(
    json: Json = None,
    junit: JUnit = None,
    solver: Annotated[Solvers, typer.Option(help="Which solver to ask.")] = Solvers.z3,
    jobs: Jobs = EVERY_CORE,
    scheduler: Scheduler = None,
    seeds: Annotated[int, typer.Option(metavar="N", min=1, help="Seeds to repeat every obligation with.")] = 1,
    only: Annotated[
        str | None,
        typer.Option(metavar="PATTERN", help='Only obligations, as "row column", that match.', show_default=False),
    ] = None,
    keep: Texts = None,
    kept: KeptAnswers = None,
    whole: Annotated[
        bool, typer.Option("--whole", help="Print what the theorem rests on, as a tree, and no matrix.")
    ] = False,
) -> None:
    """Prove the kernel: every transition keeps every invariant, on every layout.

    With --kept F only what a change has made another is asked; report and verify take no such record for evidence.
    With --scheduler the processes of other machines are asked, if their sources, solvers and packages are the same.

    Examples:
    * `heisoku prove`
    * `heisoku prove --solver both --json out/prove.json --junit out/prove.xml`
    * `heisoku prove --only "^request " --seeds 10`
    * `heisoku prove --kept out/proofs.sqlite`
    * `heisoku prove --whole`
    """
    from proofs import contents
    from proofs.chain import print_chain
    from proofs.junit import write_junit
    from proofs.matrix import print_matrix
    from proofs.run import prove_all

    writable(json, junit, kept)
    keep_apart(json, junit, kept, keep)
    pattern(only)
    if whole and (only or kept):
        which = "--only" if only else "--kept"
        refuse(f"--whole: what the theorem rests on is all of it, asked now; leave out {which}")
    if keep and kept:
        refuse("--keep: texts are made of what is asked, and --kept leaves most of it out; leave out one of them")
    if keep and scheduler:
        refuse("--keep: processes of other machines write no files here; leave out --scheduler")
    with bad_input_refused(), progress("proving") as step, workers(scheduler, jobs, contents.whole) as crew:
        report = prove_all(
            solver=solver.value, jobs=crew, seeds=seeds, only=only, progress=step, keep=keep, answers=kept
        )
    for line in report.said:
        complain(line)
    if not report.obligations:
        refuse(f"--only {only}: no transition and no invariant is named so; heisoku prove lists them all")
    (print_chain if whole else print_matrix)(console(), report)
    if json:
        write_json(json, report.record())
    if junit:
        write_junit(junit, report)
    raise typer.Exit(report.exit_code)
