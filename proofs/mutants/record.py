"""The record of all trials: kept on disk as they end, so that a run can be broken off and gone on with.

What is kept saves time and is no evidence: whoever can write the file can write what he likes.  So a run says how many
trials were kept, and what is made for the record begins without them.
"""

from __future__ import annotations

import json
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from models.shipped import is_installed
from proofs import contents
from proofs.kept import sealed
from proofs.records import write_json

ROOT = Path(__file__).resolve().parent.parent.parent
FILE = (Path() if is_installed() else ROOT) / "out" / "mutants.json"
"""In an installed copy the current folder's: nobody looks for it among installed packages, nor may write there."""
SEAL, SOURCES = "seal", "sources"


class Trials:
    """Verdicts by mutant, and the file they are kept in.  ``before``: those that an earlier run has kept there."""

    def __init__(self, file: Path = FILE) -> None:
        """Read what is there, but for what is of other sources, solvers or Python, or not as it was kept."""
        self.file = file
        self.verdicts: dict[str, dict[str, Any]] = {}
        if file.exists():
            known = json.loads(file.read_text(encoding="utf-8"))
            self.verdicts = {name: verdict for name, verdict in known["mutants"].items() if is_kept(name, verdict)}
        self.before = frozenset(self.verdicts)

    def note(self, mutant: str, theories: Sequence[str], verdict: dict[str, Any]) -> None:
        """Keep a verdict, with the theories that it is of."""
        self.verdicts[mutant] = {**verdict, "theories": list(theories), SOURCES: contents.whole()}
        self.keep()

    def keep(self) -> None:
        """Write the file."""
        write_json(self.file, {"mutants": {name: with_seal(name, each) for name, each in self.verdicts.items()}})


def with_seal(mutant: str, verdict: dict[str, Any]) -> dict[str, Any]:
    """A verdict with a digest of all that it says."""
    said = {name: value for name, value in verdict.items() if name != SEAL}
    return {**said, SEAL: sealed(mutant, json.dumps(said, sort_keys=True))}


def is_kept(mutant: str, verdict: dict[str, Any]) -> bool:
    """Tell whether a verdict is of what there is now, and as it was kept: of all sources, solvers and packages."""
    return verdict.get(SOURCES) == contents.whole() and with_seal(mutant, verdict) == verdict
