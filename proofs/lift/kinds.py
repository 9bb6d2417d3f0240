"""Kinds: the types of the subset, read from Python annotations.

A kind says how values of a type are spread over functions of logic.  A *scalar* becomes a
sort; everything else is built of scalars.
"""

from __future__ import annotations

import dataclasses
import inspect
import re
import types
import typing
from collections.abc import Mapping
from dataclasses import dataclass
from enum import Enum
from functools import cache
from typing import Any, NewType, TypeAlias

from kernel.maps import Map, Members
from models.subset import unfit_class
from proofs.lift.errors import OutsideSubset


@dataclass(frozen=True)
class Scalar:
    """One sort: an identifier, a NamedTuple, an enumeration, ``int`` or ``bool``."""

    source: Any

    @property
    def name(self) -> str:
        """The name of the type, as it is written in the source."""
        return str(self.source.__name__)

    @property
    def is_ordered(self) -> bool:
        """Whether it is a numbered identifier: ``NewType(..., int)``."""
        return isinstance(self.source, NewType) and self.source.__supertype__ is int

    @property
    def is_identifier(self) -> bool:
        """Whether its values are opaque: a NewType or a NamedTuple."""
        return isinstance(self.source, NewType) or self.is_named_tuple

    @property
    def is_named_tuple(self) -> bool:
        """Whether it is a NamedTuple class."""
        return isinstance(self.source, type) and issubclass(self.source, tuple)

    @property
    def is_enum(self) -> bool:
        """Whether it is an enumeration."""
        return isinstance(self.source, type) and issubclass(self.source, Enum)


@dataclass(frozen=True)
class OptionKind:
    """``X | None``."""

    inner: Kind


@dataclass(frozen=True)
class TupleKind:
    """``tuple[A, B]``."""

    items: tuple[Kind, ...]


@dataclass(frozen=True)
class SetKind:
    """``frozenset[T]``, or whatever set the host keeps state in."""

    element: Kind


@dataclass(frozen=True)
class MapKind:
    """``Mapping[K, V]``."""

    key: Kind
    value: Kind


@dataclass(frozen=True)
class RecordKind:
    """A frozen dataclass."""

    cls: type


Kind: TypeAlias = Scalar | OptionKind | TupleKind | SetKind | MapKind | RecordKind

BOOL = Scalar(bool)
INT = Scalar(int)


@cache
def kind_of_type(annotation: Any, owner: Any = None) -> Kind:
    """Return the kind of an annotation; ``owner`` is the class or function it stands in."""
    origin, arguments = typing.get_origin(annotation), typing.get_args(annotation)
    if annotation is int or annotation is bool:
        return Scalar(annotation)
    if isinstance(annotation, NewType):
        if annotation.__supertype__ in (str, int):
            return Scalar(annotation)
    elif origin in (typing.Union, types.UnionType):
        rest = [argument for argument in arguments if argument is not type(None)]
        if len(rest) == 1 and len(arguments) == 2:
            return OptionKind(kind_of_type(rest[0], owner))
    elif origin is tuple and arguments and Ellipsis not in arguments:
        return TupleKind(tuple(kind_of_type(argument, owner) for argument in arguments))
    elif origin in (frozenset, Members):
        return SetKind(_key(arguments[0], owner))
    elif origin in (Mapping, Map):
        return MapKind(_key(arguments[0], owner), kind_of_type(arguments[1], owner))
    elif isinstance(annotation, type):
        is_scalar = issubclass(annotation, Enum) or (issubclass(annotation, tuple) and hasattr(annotation, "_fields"))
        if is_scalar or dataclasses.is_dataclass(annotation):
            check_class(annotation)
            return Scalar(annotation) if is_scalar else RecordKind(annotation)
    raise _outside(annotation, owner)


def check_class(cls: Any) -> None:
    """Refuse a class that means something else than its fields or members say."""
    unfit = unfit_class(cls)
    if unfit is not None:
        raise OutsideSubset(*_place(cls), f"class outside the subset: {unfit.what}", unfit.hint)


RESERVED = re.compile(r"is_none|has\d*")
"""What ``components`` calls the parts of an optional value and of a map, beside its fields' own names."""


@cache
def fields_of(cls: Any) -> Mapping[str, Kind]:
    """Return the kinds of the fields of a frozen dataclass or a NamedTuple, in order."""
    hints = typing.get_type_hints(cls)
    names = cls._fields if issubclass(cls, tuple) else [field.name for field in dataclasses.fields(cls)]
    kinds = {name: kind_of_type(hints[name], cls) for name in names}
    taken = next((name for name in names if RESERVED.fullmatch(name)), None)
    if taken is not None:
        what = f"the field {cls.__name__}.{taken} has the name of a part of an optional value or a map"
        raise OutsideSubset(*_place(cls), what, "give it another name than is_none and has")
    if issubclass(cls, tuple) and not all(isinstance(kind, Scalar) for kind in kinds.values()):
        raise OutsideSubset(*_place(cls), f"NamedTuple {cls.__name__} has a field that is no scalar", "use a dataclass")
    return kinds


@cache
def scalars_of(kind: Kind) -> tuple[Scalar, ...]:
    """Return the scalars that a set element or a map key consists of."""
    match kind:
        case Scalar():
            return (kind,)
        case TupleKind(items):
            return tuple(scalar for item in items for scalar in scalars_of(item))
        case RecordKind(cls):
            return tuple(scalar for field in fields_of(cls).values() for scalar in scalars_of(field))
        case _:
            raise TypeError(f"{kind} cannot be a key")


def _key(annotation: Any, owner: Any) -> Kind:
    """Return the kind of a set element or a map key: scalars, and tuples and records of scalars."""
    kind = kind_of_type(annotation, owner)
    try:
        scalars_of(kind)
    except TypeError:
        raise _outside(annotation, owner) from None
    return kind


def _is_map_protocol(origin: Any) -> bool:
    """Whether a generic type is a protocol that says what a map can do."""
    return getattr(origin, "_is_protocol", False) and {"__getitem__", "get", "items"} <= set(dir(origin))


def _outside(annotation: Any, owner: Any) -> OutsideSubset:
    hint = (
        "use NewType(str or int), NamedTuple, Enum, int, bool, X | None, tuple[A, B], "
        "frozenset[K], Mapping[K, V] or a frozen dataclass; keys are scalars or tuples of them"
    )
    name = annotation.__name__ if isinstance(annotation, type) else str(annotation)
    return OutsideSubset(*_place(owner), f"type {name} is outside the subset", hint)


def _place(owner: Any) -> tuple[str, int]:
    """Return file and line of a class or function, or as much as is known."""
    try:
        return inspect.getsourcefile(owner) or "?", inspect.getsourcelines(owner)[1]
    except (OSError, TypeError):
        return "?", 0
