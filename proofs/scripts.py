"""Proof scripts: for each transition and invariant, the named hypotheses that it follows from.

One TOML file a transition, in ``proofs/scripts/``, with a folder for each theory beside the
interlocking.  An invariant that is not listed follows from itself alone (at the start: from what
holds at the start).  ``python -m proofs.search`` finds a script; the prover only reads.
"""

from __future__ import annotations

import errno
import tomllib
from collections.abc import Mapping
from functools import cache
from pathlib import Path

from proofs.theories import theory_of
from proofs.theory import START

FOLDER = Path(__file__).with_name("scripts")


def file_of(row: str) -> Path:
    """Say where the script of a row stands."""
    return FOLDER / f"{row.replace('.', '/')}.toml"


@cache
def script(row: str) -> Mapping[str, list[str]]:
    """Read the script of one row.

    Raises:
        FileNotFoundError: there is none.  Taken for a script without hypotheses it would refute what is proved.
    """
    path = file_of(row)
    if not path.is_file():
        line = f"no proof script of {row}, so nothing is asked; install heisoku again, or python -m proofs.search {row}"
        raise FileNotFoundError(errno.ENOENT, line, str(path))
    with path.open("rb") as file:
        return {name: list(hypotheses) for name, hypotheses in tomllib.load(file).items()}


def known(row: str) -> Mapping[str, list[str]]:
    """Give what the search has found for a row so far; nothing for a row that is new."""
    return script(row) if file_of(row).is_file() else {}


def default(row: str, column: str) -> list[str]:
    """Give the hypotheses of an obligation that the script does not list.

    At the start that is what holds at the start; lookups need nothing unless the script says so.
    """
    theory, name = theory_of(row)
    if name == START:
        return list(theory.initial)
    return [column] if name in theory.steps and column in theory.invariants else []


def hypotheses(row: str, column: str) -> list[str]:
    """Give the names of the hypotheses of one obligation."""
    return script(row).get(column, default(row, column))


def write(row: str, found: Mapping[str, list[str]]) -> None:
    """Write the script of one row, sorted, without what goes without saying."""
    path = file_of(row)
    path.parent.mkdir(parents=True, exist_ok=True)
    lines = ["# What each invariant follows from, over this transition.  Found by `python -m proofs.search`."]
    for column in sorted(found):
        if not set(found[column]) <= set(default(row, column)):
            names = "".join(f'\n    "{name}",' for name in found[column])
            lines.append(f"{column} = [{names}\n]")
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")
