"""What compiled code holds in place of the machines' records: named tuples of the same fields.

An enumeration's member becomes its number in order of definition, from 0.  A map becomes a typed list of pairs of
key and value, in the order of the map; a set, a typed list of its items.
"""

from __future__ import annotations

import dataclasses
import typing
from collections import namedtuple
from collections.abc import Callable, Mapping, Sequence
from enum import Enum
from functools import cache, lru_cache
from importlib import import_module
from operator import itemgetter
from typing import Any

from numba import types as known_types
from numba.typed import List

from kernel.maps import Map

types: Any = known_types
LEAST, MOST = -(2**63), 2**63 - 1
"""The integers that compiled code can hold. A sum or product beyond them wraps round without a word:
that none arises from inputs within the declared ranges is the machine's duty, and tests watch it."""
REMEMBERED = 256
"""Many of a machine's records are the same from one cycle to the next."""
BETWEEN = ":"
"""In place of a point in a named tuple's qualified name, which is one attribute here, and none of an attribute."""


@cache
def tuple_class(cls: type) -> Any:
    """Return the named tuple that stands for a frozen dataclass in compiled code, defaults kept."""
    assert is_record(cls)
    fields = dataclasses.fields(cls)
    given = [packed(field.default) for field in fields if field.default is not dataclasses.MISSING]
    maker: Any = namedtuple
    made = maker(cls.__name__, [field.name for field in fields], defaults=given, module=__name__)
    made.__qualname__ = f"{cls.__module__}.{cls.__qualname__}".replace(".", BETWEEN)
    return made


def __getattr__(name: str) -> Any:
    """Find the named tuple that stands for a dataclass by its qualified name, as unpickling does."""
    module, _, record = name.replace(BETWEEN, ".").rpartition(".")
    if BETWEEN not in name:
        raise AttributeError(name)
    try:
        found = import_module(module)
    except ImportError as error:
        raise AttributeError(name) from error
    if found.__spec__ is None or not is_record(getattr(found, record, None)):
        raise AttributeError(name)
    return tuple_class(getattr(found, record))


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


def is_map(type_: Any) -> bool:
    """Whether a type is that of a map."""
    return typing.get_origin(type_) is Map


def is_set(type_: Any) -> bool:
    """Whether a type is that of a set."""
    return typing.get_origin(type_) is frozenset


def is_name(type_: Any) -> bool:
    """Whether a type is that of names of something, which are numbers in compiled code."""
    return isinstance(type_, typing.NewType) and type_.__supertype__ in (str, int)


@cache
def compiled_type(type_: Any) -> Any:
    """Return what numba calls the type that stands for a machine's type."""
    if type_ is bool:
        return types.boolean
    if type_ is int or is_enumeration(type_) or is_name(type_):
        return types.int64
    items = tuple(compiled_type(item) for item in typing.get_args(type_))
    if is_map(type_):
        return types.ListType(types.Tuple(items))
    if is_set(type_):
        return types.ListType(items[0])
    if is_record(type_):
        fields = [compiled_type(hint) for hint in hints_of(type_).values()]
        return types.BaseTuple.from_types(fields, tuple_class(type_))
    assert typing.get_origin(type_) is tuple, f"{type_} cannot be compiled"
    return types.Tuple(items)


def packed(value: Any, type_: Any = None) -> Any:
    """Return a machine's value as compiled code takes it; a map or a set that stands in no record needs its type.

    Raises:
        OverflowError: an integer in it does not fit 64 bits.
        TypeError: something in it is no record, tuple, map, set, member of an enumeration, int or bool.
    """
    # First what most items are: to ask anything else of each of them takes several times as long.
    if type(value) is bool or (type(value) is int and LEAST <= value <= MOST):
        return value
    if isinstance(value, Enum):
        return number_of(value)
    if isinstance(value, int):
        if not LEAST <= value <= MOST:
            raise OverflowError(f"{value} does not fit 64 bits")
        return int(value)
    if isinstance(value, Mapping | frozenset) and type_ is not None:
        return _listed(value, type_)
    if isinstance(value, tuple):
        return tuple([packed(item) for item in value])
    if is_record(type(value)):
        cls: Any = type(value)
        return tuple_class(cls)(*[packed(getattr(value, name), hint) for name, hint in hints_of(cls).items()])
    raise TypeError(f"{value!r} cannot be handed to compiled code")


def _listed(value: Any, type_: Any) -> Any:
    listed: Any = List.empty_list(compiled_type(type_).item_type)
    if is_set(type_):
        items = [packed(item) for item in sorted(value)]
    else:
        of = typing.get_args(type_)[1]
        items = [(packed(key), packed(item, of)) for key, item in value.items()]
    for item in items:
        listed.append(item)
    return listed


def unpacked(value: Any, type_: Any) -> Any:
    """Return what compiled code gave as the machine's value of a type; the reverse of :func:`packed`."""
    return unpacking(type_)(value)


@cache
def unpacking(type_: Any) -> Callable[[Any], Any]:
    """Return what unpacks values of a type; its type is looked at once, and not with each value."""
    if is_record(type_):
        return _unpacking_record(type_)
    if is_enumeration(type_):
        return list(type_).__getitem__
    if is_name(type_):
        return lambda value: value
    if is_map(type_):
        key, of = map(unpacking, typing.get_args(type_))

        def a_map(value: Any) -> Any:
            found = {key(one): of(other) for one, other in value}
            assert len(found) == len(value), "a key stands twice"
            return found

        return a_map
    if is_set(type_):
        item = unpacking(typing.get_args(type_)[0])
        return lambda value: frozenset(map(item, value))
    if typing.get_origin(type_) is tuple:
        return _unpacking_tuple(typing.get_args(type_))

    def plain(value: Any) -> Any:
        assert type(value) is type_, f"{value!r} is no {type_.__name__}"
        return value

    return plain


def _unpacking_record(cls: Any) -> Callable[[Any], Any]:
    """Return what unpacks a record; of one with nothing but numbers and truth values the newest are remembered."""
    hints = tuple(hints_of(cls).values())
    items, packed_as = _unpacking_tuple(hints), tuple_class(cls)

    def a_record(value: Any) -> Any:
        assert type(value) is packed_as, f"{value!r} is no {cls.__name__}"
        return cls(*items(value))

    return lru_cache(REMEMBERED, typed=True)(a_record) if set(hints) <= {int, bool} else a_record


def _unpacking_tuple(hints: Sequence[Any]) -> Callable[[Any], tuple[Any, ...]]:
    """Return what unpacks items of these types; whole numbers and truth values are only looked at."""
    if not hints:
        return tuple
    others = [(at, unpacking(hint)) for at, hint in enumerate(hints) if hint not in (int, bool)]
    plain = [(at, hint) for at, hint in enumerate(hints) if hint in (int, bool)]
    at_plain, types_of = itemgetter(*(at for at, _ in plain), 0, 0), (*(hint for _, hint in plain),)

    def items(value: Any) -> tuple[Any, ...]:
        assert len(value) == len(hints), f"{value!r} has not {len(hints)} items"
        assert tuple(map(type, at_plain(value)))[:-2] == types_of, f"{value!r} has not items of {hints}"
        if not others:
            return tuple(value)
        found = list(value)
        for at, unpack in others:
            found[at] = unpack(found[at])
        return tuple(found)

    return items
