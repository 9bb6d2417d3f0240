"""The types of functions made by chance, and the head of the module that each of them stands in."""

from __future__ import annotations

from typing import TypeAlias

Type: TypeAlias = tuple["str | Type", ...]
"""``("int",)``, ``("opt", T)``, ``("set", K)``, ``("map", K, V)``, ``("tuple", A, B)``, or a record's name."""

BOOL, INT, FLAG, BERTH, SHIP, TIDE, VISIT = (
    (name,) for name in ("bool", "int", "Flag", "Berth", "Ship", "Tide", "Visit")
)
SLOT, PART, PLACE = ("Slot",), ("Part",), ("Place",)


def opt(inner: Type) -> Type:
    """``T | None``."""
    return ("opt", inner)


def set_of(key: Type) -> Type:
    """``frozenset[K]``."""
    return ("set", key)


def map_of(key: Type, value: Type) -> Type:
    """``Map[K, V]``."""
    return ("map", key, value)


PAIR: Type = ("tuple", SHIP, BERTH)
FIELDS: dict[Type, dict[str, Type]] = {
    VISIT: {"tide": TIDE, "ship": SHIP},
    SLOT: {"holder": opt(SHIP), "flag": FLAG, "is_open": BOOL, "seen": set_of(SHIP), "depth": INT},
    PART: {"count": INT, "berth": opt(BERTH), "marks": map_of(BERTH, FLAG), "flag": FLAG, "on": BOOL},
    PLACE: {"berth": BERTH, "flag": FLAG},
}
DEFAULTS: dict[Type, tuple[str, ...]] = {PART: ("flag", "on"), PLACE: ("flag",)}
RECORDS = (SLOT, PART, PLACE)
KEYS = (BERTH, SHIP, TIDE, VISIT, FLAG, PAIR, PLACE)
TYPES: tuple[Type, ...] = (
    *(BOOL, INT, FLAG, BERTH, SHIP, TIDE, VISIT, SLOT, PART, PLACE, PAIR, ("tuple", INT, opt(FLAG))),
    *(opt(INT), opt(FLAG), opt(BERTH), opt(VISIT), opt(PLACE), opt(SLOT)),
    *(set_of(BERTH), set_of(FLAG), set_of(PAIR), set_of(VISIT), set_of(PLACE)),
    *(map_of(VISIT, set_of(BERTH)), map_of(SHIP, INT), map_of(SHIP, opt(BERTH)), map_of(PAIR, FLAG)),
    *(map_of(BERTH, SLOT), map_of(VISIT, map_of(BERTH, FLAG)), map_of(PLACE, opt(INT)), map_of(FLAG, PAIR)),
)

HEAD = """\
from __future__ import annotations
from dataclasses import dataclass, replace
from kernel.maps import Map
from tests.lift.harbour import Berth, Flag, Ship, Slot, Tide, Visit

MOST = 2
BRIGHT = frozenset({Flag.RED, Flag.WHITE})
ORDER = {Flag.RED: 1, Flag.GREEN: 2}


@dataclass(frozen=True)
class Part:
    count: int
    berth: Berth | None
    marks: Map[Berth, Flag]
    flag: Flag = Flag.GREEN
    on: bool = False


@dataclass(frozen=True)
class Place:
    berth: Berth
    flag: Flag = Flag.RED


def falls(one: int, other: int = MOST, *, strict: bool = False) -> bool:
    return one < other if strict else one <= other


def marked(marks: Map[Berth, Flag], berth: Berth) -> Flag | None:
    if berth not in marks:
        return None
    return marks[berth]


MOST = 3  # what is the default above stays what it was
"""


def annotation(type_: Type) -> str:
    """Write a type as an annotation."""
    match type_:
        case ("opt", tuple(inner)):
            return f"{annotation(inner)} | None"
        case ("set", tuple(key)):
            return f"frozenset[{annotation(key)}]"
        case ("map", tuple(key), tuple(value)):
            return f"Map[{annotation(key)}, {annotation(value)}]"
        case ("tuple", *items):
            return f"tuple[{', '.join(annotation(item) for item in items if isinstance(item, tuple))}]"
    return str(type_[0])


def inner(type_: Type, index: int = 1) -> Type:
    """Return a part of a type."""
    part = type_[index]
    assert isinstance(part, tuple)
    return part


def parts(type_: Type) -> list[Type]:
    """Return the parts of a tuple's type."""
    return [part for part in type_[1:] if isinstance(part, tuple)]
