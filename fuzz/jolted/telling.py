"""A jolted state in few words: what in it is other than where everything has just started."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import fields, is_dataclass
from enum import Enum
from typing import Any

from kernel.machine.centre import NO_ROUTE
from kernel.names import Run
from models.world.start import start
from models.world.state import Site, System

MISSING = "is missing"


def differing(site: Site, system: System) -> dict[str, str]:
    """Each part that is not as at a start with the same cars and points, by its path; a map's, by its keys."""
    at, lies = dict(system.track.at.items()), dict(system.track.lies.items())
    return dict(_different("", start(site, at, lies), system))


def _different(path: str, first: Any, now: Any) -> Iterator[tuple[str, str]]:
    if first == now:
        return
    if is_dataclass(now) and type(first) is type(now):
        for field in fields(now):
            below = f"{path}.{field.name}" if path else field.name
            yield from _different(below, getattr(first, field.name), getattr(now, field.name))
    elif isinstance(now, Mapping) and isinstance(first, Mapping):
        for key in sorted({*first, *now}, key=repr):
            place = f"{path}[{told(key)}]"
            if key not in now:
                yield place, MISSING
            elif key not in first:
                yield place, told(now[key])
            else:
                yield from _different(place, first[key], now[key])
    else:
        yield path, told(now)


def told(value: Any) -> str:
    """A value in short: a run as its number, train, life and route; a set sorted."""
    if isinstance(value, Run):
        route = "standing" if value.route == NO_ROUTE else value.route
        return f"{value.serial} {value.train} life {value.life} {route}"
    if isinstance(value, Enum):
        return str(value.value)
    if isinstance(value, tuple):
        return f"({', '.join(map(told, value))})"
    if isinstance(value, frozenset):
        return f"{{{', '.join(sorted(map(told, value)))}}}"
    if isinstance(value, Mapping):
        return f"{{{', '.join(f'{told(key)}: {told(each)}' for key, each in sorted(value.items(), key=repr))}}}"
    if is_dataclass(value) and not isinstance(value, type):
        return ", ".join(f"{field.name} {told(getattr(value, field.name))}" for field in fields(value))
    return str(value)
