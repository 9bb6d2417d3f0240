"""Components: the functions of logic that a value of a kind is spread over.

``grow`` makes a value of given functions, ``components`` reads the functions off a value.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass

from proofs.lift.kinds import (
    BOOL,
    Kind,
    MapKind,
    OptionKind,
    RecordKind,
    Scalar,
    SetKind,
    TupleKind,
    fields_of,
    scalars_of,
)
from proofs.lift.terms import Term
from proofs.lift.values import ABSENT, Absent, Fields, Map, Option, Record, Set, Tuple, Value, is_none, some

Keys = tuple[Scalar, ...]
Function = Callable[..., Term]
Declare = Callable[[str, Keys, Scalar], Function]
"""Give the function of a component: path, sorts of its keys, sort of its result."""


@dataclass(frozen=True)
class Component:
    """One function of a value: where it is, its sorts, how to read it.

    ``within`` is the path of the domain that a membership is a part of in normal form.
    ``read`` gives ABSENT where the value says nothing (the value proper of ``None``).
    """

    path: str
    keys: Keys
    result: Scalar
    within: tuple[str, int] | None
    read: Callable[..., Value]


def grow(kind: Kind, path: str, keys: Keys, declare: Declare) -> Callable[..., Value]:
    """Return the function from key terms to the value of this kind, made of declared functions."""
    match kind:
        case Scalar():
            return declare(path, keys, kind)
        case OptionKind(inner):
            missing, value = declare(f"{path}.is_none", keys, BOOL), grow(inner, path, keys, declare)
            return lambda *k: Option(missing(*k), value(*k))
        case TupleKind(items):
            parts = [grow(item, f"{path}.{index}", keys, declare) for index, item in enumerate(items)]
            return lambda *k: Tuple(tuple(part(*k) for part in parts))
        case RecordKind(cls):
            fields = {name: grow(field, f"{path}.{name}", keys, declare) for name, field in fields_of(cls).items()}
            return lambda *k: Record(cls, Fields(fields, lambda name: fields[name](*k)))
        case SetKind(element):
            member = declare(path, keys + scalars_of(element), BOOL)
            return lambda *k: Set(element, lambda *q: member(*k, *q))
        case MapKind(key, inner):
            has = declare(domain_name(path, keys, key), keys + scalars_of(key), BOOL)
            get = grow(inner, path, keys + scalars_of(key), declare)
            return lambda *k: Map(key, lambda *q: has(*k, *q), lambda *q: get(*k, *q))


def domain_name(path: str, keys: Keys, key: Kind) -> str:
    """Return the name of a map's domain: ``m.has``, and ``m.has2`` for a map inside it, of two keys."""
    return f"{path}.has{len(keys) + len(scalars_of(key)) if keys else ''}"


def components(kind: Kind, path: str, keys: Keys = (), within: tuple[str, int] | None = None) -> Iterator[Component]:
    """List the components of a kind, in the order and by the names that ``grow`` declares them."""
    match kind:
        case Scalar():
            yield Component(path, keys, kind, None, lambda value: value)
        case OptionKind(inner):
            yield Component(f"{path}.is_none", keys, BOOL, None, _is_none)
            yield from _inside(inner, path, keys, within, some)
        case TupleKind(items):
            for index, item in enumerate(items):
                yield from _inside(item, f"{path}.{index}", keys, within, _item_reader(index))
        case RecordKind(cls):
            for name, field in fields_of(cls).items():
                yield from _inside(field, f"{path}.{name}", keys, within, _field_reader(name))
        case SetKind(element):
            yield Component(path, keys + scalars_of(element), BOOL, within, lambda value, *q: value.member(*q))
        case MapKind(key, inner):
            width, inside, domain = len(scalars_of(key)), keys + scalars_of(key), domain_name(path, keys, key)
            yield Component(domain, inside, BOOL, within, lambda value, *q: value.has(*q))
            for part in components(inner, path, inside, (domain, len(inside))):
                yield _below(part, lambda value, *q: value.get(*q), width)


def _inside(
    kind: Kind, path: str, keys: Keys, within: tuple[str, int] | None, step: Callable[[Value], Value]
) -> Iterator[Component]:
    """List the components of an item of a tuple or a field of a record."""
    for part in components(kind, path, keys, within):
        yield _below(part, step, 0)


def _below(part: Component, step: Callable[..., Value], width: int) -> Component:
    """Read a component one level deeper: ``step`` takes the first ``width`` keys."""

    def read(value: Value, *keys: Term) -> Value:
        inner = step(value, *keys[:width])
        if isinstance(inner, Absent):
            return ABSENT if part.within is None else False
        return part.read(inner, *keys[width:])

    return Component(part.path, part.keys, part.result, part.within, read)


def _is_none(value: Value) -> Value:
    return ABSENT if isinstance(value, Absent) else is_none(value)


def _item_reader(index: int) -> Callable[..., Value]:
    return lambda value: value.items[index]


def _field_reader(name: str) -> Callable[..., Value]:
    return lambda value: value.fields[name]
