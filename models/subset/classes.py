"""Whether a class means what its fields or members say, and nothing beside."""

from __future__ import annotations

import dataclasses
from collections.abc import Iterator
from enum import Enum, EnumType, Flag
from functools import cache
from types import FunctionType, MemberDescriptorType
from typing import Any, NamedTuple

COMPARING = ("__eq__", "__ne__", "__hash__")
READING = ("__getattribute__", "__getattr__")
MAKING = ("__new__", "__post_init__")


class Unfit(NamedTuple):
    """Why a class or a function cannot be read, and what to write instead."""

    what: str
    hint: str


@cache
def unfit_class(cls: Any) -> Unfit | None:
    """Say why a class does not mean what its fields or members say; None if it does.

    A frozen dataclass, a NamedTuple or an Enum: of any other class nothing is said.
    """
    if issubclass(cls, Enum):
        return next(_enum(cls), None)
    if issubclass(cls, tuple) and hasattr(cls, "_fields"):
        return next(_named_tuple(cls), None)
    if dataclasses.is_dataclass(cls):
        return next(_dataclass(cls), None)
    return None


def _own(cls: type, names: tuple[str, ...]) -> list[str]:
    """The methods of these names that a class has in its own body."""
    return [name for name in names if name in vars(cls)]


# Enumerations ----------------------------------------------------------------------------------


def _enum(cls: type[Enum]) -> Iterator[Unfit]:
    name = cls.__name__
    if issubclass(cls, Flag) or cls._member_type_ is not object:  # type: ignore[attr-defined]
        yield Unfit(
            f"the members of {name} are something else beside: flags, numbers or texts", f"class {name}(Enum), plain"
        )
    if type(cls) is not EnumType:
        yield Unfit(f"{name} has a metaclass of its own", f"class {name}(Enum), plain")
    aliases = [alias for alias, member in cls.__members__.items() if member.name != alias]
    if aliases:
        yield Unfit(f"{name}.{aliases[0]} is a second name of another member", "give every member a value of its own")
    for base in cls.__mro__[: cls.__mro__.index(Enum)]:
        for method in _own(base, COMPARING + READING):
            yield Unfit(f"{name} has its own {method}", "members are equal if they are the same: leave it out")


# Named tuples ----------------------------------------------------------------------------------


class _Probe(NamedTuple):
    only: int


_GETTER = type(vars(_Probe)["only"])


def _named_tuple(cls: Any) -> Iterator[Unfit]:
    name = cls.__name__
    if cls.__bases__ != (tuple,) or type(cls) is not type:
        yield Unfit(
            f"{name} is made of another class than NamedTuple", f"class {name}(NamedTuple), with all its fields"
        )
    for method in _own(cls, (*COMPARING, *READING, "__getitem__", "__iter__", "__len__", "__contains__", "__lt__")):
        yield Unfit(f"{name} has its own {method}", "a NamedTuple is equal if its fields are: leave it out")
    for field in cls._fields:
        if type(vars(cls)[field]) is not _GETTER:
            yield Unfit(f"{name}.{field} is a field and something else beside", "give it another name")


# Records ---------------------------------------------------------------------------------------


def _dataclass(cls: Any) -> Iterator[Unfit]:
    name, plain = cls.__name__, "@dataclass(frozen=True), with fields alone"
    if "__dataclass_params__" not in vars(cls):
        yield Unfit(f"{name} is made of a dataclass and is none itself", plain)
        return
    parameters = vars(cls)["__dataclass_params__"]
    for parameter in ("frozen", "eq", "init"):
        if not getattr(parameters, parameter):
            yield Unfit(f"{name} is a dataclass with {parameter}=False", plain)
    if cls.__bases__ != (object,):
        yield Unfit(f"{name} is made of another class", "write out all its fields: a dataclass of no other class")
    if type(cls) is not type:
        yield Unfit(f"{name} has a metaclass of its own", plain)
    for method in _own(cls, (*MAKING, *READING, "__ne__")):
        yield Unfit(f"{name} has its own {method}", plain)
    for method in ("__init__", "__eq__", "__hash__"):
        if not _is_made_by_dataclass(vars(cls).get(method)):
            yield Unfit(f"{name} has its own {method}", plain)
    for field in cls.__dataclass_fields__.values():
        yield from _field(cls, field)


def _is_made_by_dataclass(method: object) -> bool:
    """What ``dataclass`` writes stands in no file."""
    return isinstance(method, FunctionType) and method.__code__.co_filename == "<string>"


def _field(cls: Any, field: Any) -> Iterator[Unfit]:
    place, hint = f"{cls.__name__}.{field.name}", "a plain field: name, type and perhaps a default"
    kind = field._field_type.name
    if kind == "_FIELD_CLASSVAR":
        return
    if kind != "_FIELD":
        yield Unfit(f"{place} is an argument and no field", hint)
    for parameter in ("compare", "init"):
        if not getattr(field, parameter):
            yield Unfit(f"{place} is a field with {parameter}=False", hint)
    if field.hash is not None:
        yield Unfit(f"{place} is a field with hash={field.hash}", hint)
    if field.kw_only:
        yield Unfit(f"{place} is given by name only", "fields in the order in which they are given, none kw_only")
    standing = vars(cls).get(field.name)
    if not isinstance(standing, MemberDescriptorType) and any(
        hasattr(type(standing), method) for method in ("__get__", "__set__")
    ):
        yield Unfit(f"{place} is read by code of its own", "a plain field, no property and no descriptor")
