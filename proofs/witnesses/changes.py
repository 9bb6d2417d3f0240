"""What a step changed, and nothing else: the difference of two states in a form that a witness writes down.

A record or map differs by the fields or keys that changed; a set by what came or went.  An absent
key and an empty value are the same: nobody holds a block that is not listed.
"""

from __future__ import annotations

from collections.abc import Hashable, Mapping
from dataclasses import dataclass, fields, is_dataclass
from typing import Any

Changes = Mapping[Any, Any]
"""For each field or key that changed: what changed in it, or its value now."""


@dataclass(frozen=True)
class Came:
    """These members came into a set."""

    members: frozenset[Any]


@dataclass(frozen=True)
class Went:
    """These members went out of a set."""

    members: frozenset[Any]


@dataclass(frozen=True)
class Gone:
    """A key is no more."""


GONE = Gone()


def came(*members: Hashable) -> Came:
    """Say that exactly these came into a set."""
    return Came(frozenset(members))


def went(*members: Hashable) -> Went:
    """Say that exactly these went out of a set."""
    return Went(frozenset(members))


def changes(before: Any, after: Any) -> Changes:
    """Every difference of two states of one kind."""
    if is_dataclass(before):
        pairs = [(field.name, getattr(before, field.name), getattr(after, field.name)) for field in fields(before)]
    else:
        keys = [*before, *(key for key in after if key not in before)]
        pairs = [(key, before.get(key, GONE), after.get(key, GONE)) for key in keys]
    return {name: difference(old, new) for name, old, new in pairs if not same(old, new)}


def difference(old: Any, new: Any) -> Any:
    """How one value became another, which is not the same."""
    if isinstance(new, frozenset) and (is_empty(old) or old < new):
        return Came(new - old if isinstance(old, frozenset) else new)
    if isinstance(old, frozenset) and (is_empty(new) or new < old):
        return Went(old - new if isinstance(new, frozenset) else old)
    if isinstance(old, Mapping) and (isinstance(new, Mapping) or new is GONE):
        return changes(old, {} if new is GONE else new)
    if old is GONE and isinstance(new, Mapping):
        return changes({}, new)
    if is_dataclass(old) and type(old) is type(new):
        return changes(old, new)
    return new


def still_to_come(before: Any, effect: Changes) -> Changes:
    """What of a stated effect is not so already, in the form of :func:`changes`."""
    found: dict[Any, Any] = {}
    for name, stated in effect.items():
        old = before.get(name, GONE) if isinstance(before, Mapping) else getattr(before, name, GONE)
        if isinstance(stated, Mapping):
            if rest := still_to_come({} if old is GONE else old, stated):
                found[name] = rest
        elif isinstance(stated, Came | Went):
            there = old if isinstance(old, frozenset) else frozenset()
            members = stated.members - there if isinstance(stated, Came) else stated.members & there
            if members:
                found[name] = type(stated)(members)
        elif not same(old, stated):
            found[name] = difference(old, stated)
    return found


def same(old: Any, new: Any) -> bool:
    """Whether nothing changed, an absent value being an empty one."""
    if old is new or old == new:
        return True
    if (isinstance(old, Mapping) and isinstance(new, Mapping)) or (is_dataclass(old) and type(old) is type(new)):
        return not changes(old, new)
    return is_empty(old) and is_empty(new)


def is_empty(value: Any) -> bool:
    """Whether this is no value, or an empty set or map."""
    return value is GONE or (isinstance(value, frozenset | Mapping) and not value)
