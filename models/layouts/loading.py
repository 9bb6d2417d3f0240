"""Loading a layout file of any format."""

from __future__ import annotations

import gc
import hashlib
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path

from models.layouts.native import import_native
from models.layouts.railjson import import_railjson
from models.layouts.railml import import_railml
from models.layouts.reading import format_of, parse_json, parse_toml, read_text
from models.layouts.results import BadInput, Imported
from models.layouts.table import import_table
from models.layouts.yaml_text import parse_yaml

TRAINS = tuple(f"T{number}" for number in range(1, 9))
"""The fleet where a file names none."""


def load(path: str | Path, trains: Sequence[str] = TRAINS) -> Imported:
    """The layout in a file; the format is told by what the file holds.

    :raises BadInput: the file cannot be read as a layout; one line names file and place.
    """
    file = Path(path)
    return load_text(str(path), read_text(file), trains)


def load_text(name: str, text: str, trains: Sequence[str] = TRAINS) -> Imported:
    """The layout in a text; ``name`` stands for the file in messages."""
    kind, fleet = format_of(name, text), tuple(trains)
    with _without_collection():
        imported = _of_kind(kind, name, text, fleet)
    return replace(imported, sha256=hashlib.sha256(text.encode("utf-8", "surrogatepass")).hexdigest())


@contextmanager
def _without_collection() -> Iterator[None]:
    """No search for circles of garbage: an import keeps what it makes, and a quarter of its time would go into that."""
    was = gc.isenabled()
    gc.disable()
    try:
        yield
    finally:
        if was:
            gc.enable()


def _of_kind(kind: str, name: str, text: str, fleet: tuple[str, ...]) -> Imported:
    """The layout in a text of a kind."""
    try:
        if kind == "json":
            return import_railjson(name, parse_json(name, text), fleet)
        if kind == "xml":
            return import_railml(name, text, fleet)
        if kind == "yaml":
            return import_table(name, parse_yaml(name, text), fleet)
        return import_native(name, parse_toml(name, text), fleet)
    except RecursionError as error:
        raise BadInput(name, "nesting", "is too deep to be a layout", "check the file") from error
