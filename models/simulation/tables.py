"""Reading a file of tables: which faults come, where roads cross."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from models.layouts.reading import parse_toml
from models.layouts.results import BadInput

MOST = 1_000_000


def tables_of(path: Path) -> dict[str, Any]:
    """Read the tables of a file; one without any is empty.

    Raises:
        BadInput: the file cannot be read.
    """
    try:
        text = path.read_text("utf-8")
    except OSError as error:
        raise BadInput(str(path), "file", f"cannot be read ({error.strerror})", "name another file") from error
    except UnicodeDecodeError as error:
        raise BadInput(str(path), f"byte {error.start}", "is not UTF-8 text", "save it as UTF-8") from error
    found: dict[str, Any] = parse_toml(str(path), text, "docs/simulation.md")
    return found


def number_of(file: str, place: str, given: Any) -> float:
    """A number as the tables have it, from 0 to a million: chances, seconds, metres.

    Raises:
        BadInput: it is none.
    """
    if isinstance(given, bool) or not isinstance(given, int | float) or not 0 <= given <= MOST:
        raise BadInput(file, place, f"is not a number from 0 to {MOST}", "give one")
    return float(given)
