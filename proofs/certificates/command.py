"""`heisoku certify`: every obligation with a proof that is written down and checked step by step."""

from __future__ import annotations

import os
import re
import time
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import asdict
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from models.commands import EVERY_CORE, Jobs, Json, console, keep_apart, pattern, print_line, progress, refuse, writable
from models.exit_codes import DOES_NOT_HOLD, HOLDS, UNDECIDED, WORDS
from proofs.records import about, write_json
from proofs.sampling import sampled

if TYPE_CHECKING:
    from proofs.certificates.checking import Certified
    from proofs.certificates.outside import Checker

Proofs = Annotated[
    Path | None,
    typer.Option("--keep", metavar="DIR", help="Keep the proofs there, as cvc5 writes them.", show_default=False),
]
Ethos = Annotated[
    Path | None,
    typer.Option("--ethos", metavar="F", help="The program of the external checker.", show_default="on the path"),
]
Rules = Annotated[
    Path | None,
    typer.Option("--rules", metavar="F", help="Cpc.eo, which it reads first.", show_default="HEISOKU_CPC"),
]


def certify(
    only: Annotated[
        str | None,
        typer.Option(metavar="PATTERN", help='Only obligations, as "row column", that match.', show_default=False),
    ] = None,
    sample: Annotated[
        int | None, typer.Option(metavar="N", min=1, help="Only N of them, always the same.", show_default=False)
    ] = None,
    jobs: Jobs = EVERY_CORE,
    keep: Proofs = None,
    ethos: Ethos = None,
    rules: Rules = None,
    json: Json = None,
) -> None:
    """Have a proof of each obligation written down, and each step of it checked.

    cvc5 writes it and its own checker goes through it; so does ethos, a checker of others, where --ethos and --rules
    name it, or it is on the path and HEISOKU_CPC names its rules.  What is no theorem is put to them first.

    Examples:
    * `heisoku certify --only '^tag_fix'`
    """
    from models.processes import spread
    from proofs.certificates.checking import certified, controls
    from proofs.theories import ROWS, columns

    pattern(only)
    writable(json)
    keep_apart(json, keep)
    if keep is not None and keep.exists() and not keep.is_dir():
        refuse(f"--keep {keep}: is not a folder; name another")
    outside = checker(ethos, rules)
    every = [(row, column) for row in ROWS for column in columns(row)]
    asked = chosen(every, only, sample)
    if not asked:
        refuse(f"--only {only}: no transition and no invariant is named so; heisoku prove lists them all")
    began, refused, found = time.perf_counter(), controls(outside), list["Certified"]()
    with progress("certified") as step:
        for one in spread(partial(certified, outside=outside, keep=keep), asked, jobs):
            found.append(one)
            step(len(found), len(asked), f"{one.answer}: {one.row} × {one.column}"[:100])
    told = record(found, len(every), refused, outside.program if outside else None, time.perf_counter() - began)
    if json:
        hashed = outside.hashes() if outside else None
        write_json(json, {**told, "external_hashes": hashed, "only": only, "sample": sample, **about()})
    out = console()
    for line in lines(told):
        print_line(out, line)
    raise typer.Exit(exit_code(told))


def chosen(every: Iterable[tuple[str, str]], only: str | None, sample: int | None) -> list[tuple[str, str]]:
    """The obligations to certify, of all that there are by row and column."""
    return sampled([cell for cell in every if re.search(only or "", " ".join(cell))], sample, " ".join)


def checker(ethos: Path | None, rules: Path | None) -> Checker | None:
    """The external checker that is named, else the one that is installed, if any."""
    from proofs.certificates.outside import RULES, Checker, installed

    if ethos is None and rules is None:
        return installed()
    named = rules or Path(os.environ.get(RULES, ""))
    if ethos is None:
        refuse("--rules: of which checker; name it by --ethos")
    if not ethos.is_file() or not os.access(ethos, os.X_OK):
        refuse(f"--ethos {ethos}: is no program that can be run; name the one that was built")
    if not named.is_file():
        refuse(f"--rules {named}: is no file; name Cpc.eo, which is among the sources of cvc5")
    return Checker(str(ethos.resolve()), str(named.resolve()))


def record(
    found: Sequence[Certified], there_are: int, refused: Sequence[tuple[str, bool]], checker: str | None, seconds: float
) -> dict[str, Any]:
    """Give the run as it is written to a file.

    ``there_are``: so many obligations.  ``checker``: the external one, none if there is none.
    """
    told = {
        "obligations": [asdict(each) for each in found],
        "of": there_are,
        "controls": [{"asked": name, "refused": was} for name, was in refused],
        "external": checker,
        "seconds": round(seconds, 1),
    }
    return {"verdict": WORDS[exit_code(told)], **told}


def exit_code(told: Mapping[str, Any]) -> int:
    """0 if each is checked and nothing is taken on trust, 1 if one is refuted, else 3; so too if a control passed."""
    answers = [each["answer"] for each in told["obligations"]]
    if "sat" in answers:
        return DOES_NOT_HOLD
    doubted = not all(each["refused"] for each in told["controls"]) or not told["controls"]
    trusted = any(each["trusted"] for each in told["obligations"])
    outside = any(each["external"] not in ("", "correct") for each in told["obligations"])
    return UNDECIDED if doubted or trusted or outside or not answers or set(answers) != {"checked"} else HOLDS


def lines(told: Mapping[str, Any]) -> list[str]:
    """What to print: each obligation without a certificate, and the sum."""
    found = told["obligations"]
    said = [
        f"{each['row']} × {each['column']}: {each['answer']}, {each['trusted']} steps on trust"
        f"{', outside: ' + each['external'] if each['external'] else ''}"
        for each in found
        if each["answer"] != "checked" or each["trusted"] or each["external"] not in ("", "correct")
    ]
    said += [f"control: {each['asked']}: went through as proved" for each in told["controls"] if not each["refused"]]
    parts, steps, size = (sum(each[what] for each in found) for what in ("parts", "steps", "size"))
    checked = sum(each["answer"] == "checked" for each in found)
    passed = sum(each["external"] == "correct" for each in found)
    outside = f"{passed:,} by {told['external']} too" if told["external"] else "no external checker is installed"
    proofs = f"{parts:,} proofs of {steps:,} steps and {size / 1e6:,.1f} MB"
    came = f"{checked:,} of {len(found):,} obligations with {proofs} checked, {outside}"
    return [*said, f"{came}; {len(told['controls'])} controls: {told['verdict']}"]
