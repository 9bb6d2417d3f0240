"""What compiled code holds in place of the machines' records: named tuples of the same fields.

An enumeration's member becomes its number in order of definition, from 0.
"""

from __future__ import annotations

import dataclasses
import typing
from collections import namedtuple
from enum import Enum
from functools import cache
from typing import Any

LEAST, MOST = -(2**63), 2**63 - 1
"""The integers that compiled code can hold. A sum or product beyond them wraps round without a word:
that none arises from inputs within the declared ranges is the machine's duty, and tests watch it."""


@cache
def tuple_class(cls: type) -> Any:
    """Return the named tuple that stands for a frozen dataclass in compiled code, defaults kept."""
    assert is_record(cls)
    fields = dataclasses.fields(cls)
    given = [packed(field.default) for field in fields if field.default is not dataclasses.MISSING]
    maker: Any = namedtuple
    return maker(cls.__name__, [field.name for field in fields], defaults=given)


@cache
def hints_of(cls: type) -> dict[str, Any]:
    """Return the types of a record's fields."""
    hints = typing.get_type_hints(cls)
    return {field.name: hints[field.name] for field in dataclasses.fields(cls)}


def is_record(value: Any) -> bool:
    """Whether this is a frozen dataclass."""
    return isinstance(value, type) and _is_frozen(value)


@cache
def _is_frozen(cls: Any) -> bool:
    return dataclasses.is_dataclass(cls) and bool(vars(cls)["__dataclass_params__"].frozen)


def is_enumeration(value: object) -> bool:
    """Whether this is an enumeration."""
    return isinstance(value, type) and issubclass(value, Enum)


def number_of(member: Enum) -> int:
    """Return what stands for a member of an enumeration in compiled code."""
    return list(type(member)).index(member)


def packed(value: Any) -> Any:
    """Return a machine's value as compiled code takes it.

    Raises:
        OverflowError: an integer in it does not fit 64 bits.
        TypeError: something in it is no record, tuple, member of an enumeration, int or bool.
    """
    if isinstance(value, Enum):
        return number_of(value)
    if isinstance(value, bool):
        return value
    if isinstance(value, int):
        if not LEAST <= value <= MOST:
            raise OverflowError(f"{value} does not fit 64 bits")
        return int(value)
    if isinstance(value, tuple):
        return tuple(packed(item) for item in value)
    cls: Any = type(value)
    if is_record(cls):
        return tuple_class(cls)(*(packed(getattr(value, name)) for name in hints_of(cls)))
    raise TypeError(f"{value!r} cannot be handed to compiled code")


def unpacked(value: Any, type_: Any) -> Any:
    """Return what compiled code gave as the machine's value of a type; the reverse of :func:`packed`."""
    if is_record(type_):
        hints = hints_of(type_)
        assert type(value) is tuple_class(type_), f"{value!r} is no {type_.__name__}"
        return type_(*(unpacked(item, hint) for item, hint in zip(value, hints.values(), strict=True)))
    if is_enumeration(type_):
        return list(type_)[value]
    if typing.get_origin(type_) is tuple:
        return tuple(unpacked(item, hint) for item, hint in zip(value, typing.get_args(type_), strict=True))
    assert type(value) is type_, f"{value!r} is no {type_.__name__}"
    return value
