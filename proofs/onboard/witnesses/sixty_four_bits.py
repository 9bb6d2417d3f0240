"""Integers of 64 bits, in two makes: one that says so when a result does not fit, and one that wraps around."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import fields, is_dataclass, replace
from enum import Enum
from typing import Any

LEAST, GREATEST = -(2**63), 2**63 - 1
OPERATIONS = ("add", "radd", "sub", "rsub", "mul", "rmul", "floordiv", "rfloordiv", "neg")


class Checked(int):
    """Every result must fit."""

    @classmethod
    def of(cls, value: int) -> int:
        """A result, which must fit."""
        assert LEAST <= value <= GREATEST, f"{value} does not fit into 64 bits"
        return cls(value)


class Wrapped(int):
    """Every result is what is left of it in 64 bits, as in compiled code."""

    @classmethod
    def of(cls, value: int) -> int:
        """A result, wrapped around."""
        return cls((value - LEAST) % 2**64 + LEAST)


def _give(make: type[Checked] | type[Wrapped], name: str) -> Callable[..., Any]:
    plain = getattr(int, name)

    def operation(self: int, *other: int) -> Any:
        result = plain(int(self), *(int(value) for value in other))
        return result if result is NotImplemented else make.of(result)

    return operation


for _make in (Checked, Wrapped):
    for _name in OPERATIONS:
        setattr(_make, f"__{_name}__", _give(_make, f"__{_name}__"))


def with_ints(make: type[Checked] | type[Wrapped], value: Any) -> Any:
    """The same value with its integers of this make."""
    if is_dataclass(value) and not isinstance(value, type):
        return replace(value, **{field.name: with_ints(make, getattr(value, field.name)) for field in fields(value)})
    if isinstance(value, bool | Enum):
        return value
    return make.of(value)
