"""Events as JSON: identifiers as texts, numbered ones as integers, the rest by the transitions' annotations."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import fields
from enum import Enum
from functools import cache
from typing import Any, get_args, get_origin, get_type_hints

from kernel.names import Read, Run
from kernel.standstill import Standstill, ThroughLine
from proofs.catalogue import STEPS
from proofs.transitions import event_types

Json = str | int | bool | list[Any]
"""What a value of an event is written as."""


class NotSo(ValueError):
    """A value that is not of its kind: ``place`` inside the event, and what is wrong with it."""

    def __init__(self, place: str, what: str) -> None:
        super().__init__(what)
        self.place = place
        self.what = what


@cache
def kinds_of(step: str) -> Mapping[str, Any]:
    """The names and types of what an event of a transition carries; the transition must exist."""
    return event_types(STEPS[step])


def encoded(step: str, event: Mapping[str, Any]) -> dict[str, Json]:
    """Write an event as plain data, in the order of the transition's parameters."""
    return {name: written(event[name]) for name in kinds_of(step)}


def decoded(step: str, data: Mapping[str, Any]) -> dict[str, Any]:
    """Read an event of a transition.

    Raises:
        NotSo: a value is missing, is there without need, or is of another kind.
    """
    kinds = kinds_of(step)
    for name in data:
        if name not in kinds:
            raise NotSo(name, f"is not told to {step}, which takes {', '.join(kinds)}")
    for name in kinds:
        if name not in data:
            raise NotSo(name, f"is missing; {step} takes {', '.join(kinds)}")
    return {name: read(kind, data[name], name) for name, kind in kinds.items()}


def written(value: Any) -> Json:
    """Write one value."""
    if isinstance(value, Enum):
        return str(value.value)
    if isinstance(value, bool | str | int):
        return value
    if isinstance(value, tuple):
        return [written(item) for item in value]
    if isinstance(value, frozenset):
        return sorted(value)
    if isinstance(value, Standstill | ThroughLine):
        return [written(getattr(value, field.name)) for field in fields(value)]
    raise TypeError(f"an event carries no {type(value).__name__}")


def read(kind: Any, data: Any, place: str) -> Any:
    """Read one value of a kind."""
    if kind in (Run, Read, Standstill, ThroughLine):
        known = get_type_hints(kind)
        items = _list(data, place)
        if len(items) != len(known):
            raise NotSo(place, f"has {len(items)} items; a {kind.__name__.lower()} is {', '.join(known)}")
        typed = enumerate(zip(known.values(), items, strict=True))
        return kind(*(read(each, item, f"{place}[{at}]") for at, (each, item) in typed))
    if get_origin(kind) is frozenset:
        (inner,) = get_args(kind)
        return frozenset(read(inner, item, f"{place}[{at}]") for at, item in enumerate(_list(data, place)))
    if isinstance(kind, type) and issubclass(kind, Enum):
        known = {member.value: member for member in kind}
        if not isinstance(data, str) or data not in known:
            raise NotSo(place, f"is {data!r}, not one of {', '.join(known)}")
        return known[data]
    return _plain(kind, data, place)


def _list(data: Any, place: str) -> list[Any]:
    if not isinstance(data, list):
        raise NotSo(place, f"is {data!r}, not a list")
    return data


def _plain(kind: Any, data: Any, place: str) -> Any:
    """A text, a number or a truth; a truth is no number."""
    wanted = kind if kind in (bool, int) else kind.__supertype__
    if type(data) is not wanted:
        words: Mapping[Any, str] = {bool: "true or false", str: "a text", int: "a whole number"}
        raise NotSo(place, f"is {data!r}, not {words[wanted]}")
    return data
