"""Where a function of the sources stands, and what it says of itself."""

from __future__ import annotations

import inspect
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from evidence.manifest.hashes import ROOT
from evidence.report.words import first_sentence


@dataclass(frozen=True)
class Place:
    """A function of the sources: its name, file, lines and what it says of itself."""

    name: str
    file: str
    first: int
    last: int
    says: str
    source: str


def place_of(name: str, function: Callable[..., Any]) -> Place:
    """Where a function stands."""
    lines, first = inspect.getsourcelines(function)
    path = Path(inspect.getfile(function)).resolve().relative_to(ROOT)
    says = first_sentence(inspect.getdoc(function) or "")
    return Place(name, path.as_posix(), first, first + len(lines) - 1, says, "".join(lines))
