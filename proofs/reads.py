"""What lifting a claim reads of a state: where another state has the same there, it is lifted to the same.

A transition may change a state in hundreds of ways, and a claim looks at a few of its fields.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

from proofs.lift.terms import address
from proofs.lift.values import ABSENT, Fields, Record, Value, is_term

Path = tuple[str, ...]
"""The names of a field, from the state down."""


def noting(value: Value, read: dict[Path, Value], path: Path = ()) -> Value:
    """Give the same value; whatever is read of it is noted under its path, and that a record is one, too."""
    read[path] = value
    if isinstance(value, Record):
        return Record(value.cls, Fields(value.fields, lambda name: noting(value.fields[name], read, (*path, name))))
    return value


@dataclass
class Seen:
    """What was lifted of states, by what was read of each.

    ``lifted``: by the paths that were read, and by what stood there; ``kept``: those values, so that none makes room
    for another at its address.
    """

    lifted: dict[tuple[Path, ...], dict[tuple[Any, ...], Any]] = field(default_factory=dict)
    kept: list[Value] = field(default_factory=list)

    def of(self, state: Value, lift: Callable[[Value], Any]) -> Any:
        """Give what comes of lifting a state; it is lifted only where something that is read of it is new."""
        found = self.find(state)
        if found is None:
            read = dict[Path, Value]()
            found = lift(noting(state, read))
            self.note(read, found)
        return found

    def find(self, state: Value) -> Any:
        """Give what was lifted of a state with the same values wherever it was read, or None."""
        for paths, found in self.lifted.items():
            here = found.get(tuple(_mark(_at(state, path)) for path in paths))
            if here is not None:
                return here
        return None

    def note(self, read: dict[Path, Value], lifted: Any) -> None:
        """Keep what was lifted of a state of which this was read."""
        self.kept.extend(read.values())
        self.lifted.setdefault(tuple(read), {})[tuple(_mark(value) for value in read.values())] = lifted


def _at(state: Value, path: Path) -> Value:
    for name in path:
        if not isinstance(state, Record):
            return ABSENT  # there is no record here, and its own path says so
        state = state.fields[name]
    return state


def _mark(value: Value) -> Any:
    """Give what is the same for the same value only: Z3 keeps equal terms once.  Of a record the fields have paths."""
    if isinstance(value, bool):
        return value
    if isinstance(value, Record):
        return value.cls
    return (True, address(value)) if is_term(value) else (False, id(value))
