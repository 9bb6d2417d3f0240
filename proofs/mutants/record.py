"""The record of all trials: kept on disk as they end, so that a run can be broken off and gone on with."""

from __future__ import annotations

import hashlib
import json
from pathlib import Path
from typing import Any

from proofs.records import write_json

ROOT = Path(__file__).resolve().parent.parent.parent
FILE = ROOT / "out" / "mutants.json"
ROOMS = ("kernel", "models/world", "proofs/invariants", "proofs/lift", "proofs/mutants", "proofs/witnesses")
"""What a verdict depends on: when any of it changes, the trials begin anew."""


def digest() -> str:
    """A hash of all sources that a verdict depends on."""
    whole = hashlib.sha256()
    files = [path for room in ROOMS for path in sorted((ROOT / room).rglob("*.py"))]
    for path in [*files, *(ROOT / "models").glob("*.py"), *(ROOT / "proofs").glob("*.py")]:
        whole.update(path.read_bytes())
    return whole.hexdigest()


class Trials:
    """Verdicts by mutant, and the file they are kept in."""

    def __init__(self, file: Path = FILE) -> None:
        """Read what is there, unless it is of other sources."""
        self.file = file
        self.digest = digest()
        self.verdicts: dict[str, dict[str, Any]] = {}
        if file.exists():
            known = json.loads(file.read_text(encoding="utf-8"))
            if known.get("digest") == self.digest:
                self.verdicts = known["mutants"]

    def note(self, mutant: str, verdict: dict[str, Any]) -> None:
        """Keep a verdict."""
        self.verdicts[mutant] = verdict
        self.keep()

    def keep(self) -> None:
        """Write the file."""
        write_json(self.file, {"digest": self.digest, "mutants": self.verdicts})
