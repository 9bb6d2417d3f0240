"""The record of all trials: kept on disk as they end, so that a run can be broken off and gone on with."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Sequence
from functools import cache
from pathlib import Path
from typing import Any

from models.shipped import is_installed
from proofs.records import write_json

ROOT = Path(__file__).resolve().parent.parent.parent
FILE = (Path() if is_installed() else ROOT) / "out" / "mutants.json"
"""In an installed copy the current folder's: nobody looks for it among installed packages, nor may write there."""
COMMON = ("proofs/lift", "proofs/mutants")
INTERLOCKED = ("models/world", "proofs/invariants", "proofs/witnesses")
"""What a verdict depends on, beside the files at the top of kernel, models and proofs: when any of it changes,
the trials begin anew.  Those of a theory beside the interlocking depend on its own files and on the whole kernel."""


@cache
def digest(theory: str = "interlocking") -> str:
    """A hash of all sources that a verdict in a theory depends on."""
    whole = hashlib.sha256()
    own = INTERLOCKED if theory == "interlocking" else ("kernel",)
    files = [path for room in (*COMMON, *own) for path in sorted((ROOT / room).rglob("*.py"))]
    if theory == "interlocking":
        files += [path for room in ("kernel", "models", "proofs") for path in sorted((ROOT / room).glob("*.py"))]
    else:
        files += [path for room in ("models", "proofs") for path in sorted((ROOT / room).rglob(f"{theory}.py"))]
        files.append(ROOT / "proofs" / "onboard" / "witnesses" / "play.py")
    for path in files:
        whole.update(path.read_bytes())
    return whole.hexdigest()


class Trials:
    """Verdicts by mutant, and the file they are kept in."""

    def __init__(self, file: Path = FILE) -> None:
        """Read what is there, but for what is of other sources."""
        self.file = file
        self.verdicts: dict[str, dict[str, Any]] = {}
        if file.exists():
            known = json.loads(file.read_text(encoding="utf-8"))
            self.verdicts = {
                name: verdict
                for name, verdict in known["mutants"].items()
                if verdict.get("digests") == digests(verdict.get("theories", ()))
            }

    def note(self, mutant: str, theories: Sequence[str], verdict: dict[str, Any]) -> None:
        """Keep a verdict, with the theories that it is of."""
        self.verdicts[mutant] = {**verdict, "theories": list(theories), "digests": digests(theories)}
        self.keep()

    def keep(self) -> None:
        """Write the file."""
        write_json(self.file, {"mutants": self.verdicts})


def digests(theories: Sequence[str]) -> list[str]:
    """The hashes of the sources of some theories."""
    return [digest(theory) for theory in theories]
