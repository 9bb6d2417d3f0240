"""Proof scripts: for each transition and invariant, the named hypotheses that it follows from.

One TOML file a transition, in ``proofs/scripts/``.  An invariant that is not listed follows
from itself alone (at the start: from what holds at the start).  ``python -m proofs.search``
finds a script; the prover only reads.
"""

from __future__ import annotations

import tomllib
from collections.abc import Mapping
from functools import cache
from pathlib import Path

from proofs.catalogue import INITIAL, INVARIANTS, STEPS

FOLDER = Path(__file__).with_name("scripts")
START = "init"
"""The name of the first row of the matrix."""
ROWS = (START, *STEPS)
"""The rows of the matrix, in order."""


@cache
def script(transition: str) -> Mapping[str, list[str]]:
    """Read the script of one transition."""
    path = FOLDER / f"{transition}.toml"
    if not path.exists():
        return {}
    with path.open("rb") as file:
        return {name: list(hypotheses) for name, hypotheses in tomllib.load(file).items()}


def default(transition: str, invariant: str) -> list[str]:
    """Give the hypotheses of an obligation that the script does not list.

    At the start that is what holds at the start; lookups need nothing unless the script says so.
    """
    if transition == START:
        return list(INITIAL)
    return [invariant] if transition in STEPS and invariant in INVARIANTS else []


def hypotheses(transition: str, invariant: str) -> list[str]:
    """Give the names of the hypotheses of one obligation."""
    return script(transition).get(invariant, default(transition, invariant))


def write(transition: str, found: Mapping[str, list[str]]) -> None:
    """Write the script of one transition, sorted, without what goes without saying."""
    FOLDER.mkdir(exist_ok=True)
    lines = ["# What each invariant follows from, over this transition.  Found by `python -m proofs.search`."]
    for invariant in sorted(found):
        if not set(found[invariant]) <= set(default(transition, invariant)):
            names = "".join(f'\n    "{name}",' for name in found[invariant])
            lines.append(f"{invariant} = [{names}\n]")
    (FOLDER / f"{transition}.toml").write_text("\n".join(lines) + "\n", encoding="utf-8")
