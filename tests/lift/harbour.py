"""A made-up harbour, with one function for each construct of an expression.

Statements are in ``harbour_steps``.  Each function is plain Python; the suite runs it in CPython
and through the lifter, on the same drawn states, and the two must agree exactly.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from enum import Enum
from types import MappingProxyType
from typing import NamedTuple, NewType

from kernel.maps import Map

Berth = NewType("Berth", str)
Ship = NewType("Ship", str)
Tide = NewType("Tide", int)


class Visit(NamedTuple):
    """One ship on one tide."""

    tide: Tide
    ship: Ship


class Flag(Enum):
    """What a berth shows."""

    RED = "red"
    GREEN = "green"
    WHITE = "white"


@dataclass(frozen=True)
class Slot:
    """A berth's own state, with the nested kinds a field may have."""

    holder: Ship | None
    flag: Flag
    is_open: bool
    seen: frozenset[Ship]
    depth: int


@dataclass(frozen=True)
class Harbour:
    """Every kind that a field may be."""

    tide: Tide
    last: Visit | None
    level: int
    quiet: bool
    closed: frozenset[Berth]
    stays: frozenset[tuple[Visit, Berth]]
    moored: Map[Visit, frozenset[Berth]]
    flags: Mapping[tuple[Ship, Berth], Flag]
    marks: Map[Visit, Map[Berth, Flag]]
    home: Mapping[Ship, Berth | None]
    weight: Mapping[Ship, int]
    slots: Map[Berth, Slot]
    route: Mapping[Ship, tuple[Berth, Flag]]


@dataclass(frozen=True)
class Port:
    """A record of records."""

    harbour: Harbour
    log: frozenset[Ship]
    alarm: bool = False


@dataclass(frozen=True)
class Report:
    """A small record, made new."""

    port: Port
    moved: frozenset[Berth]
    flag: Flag = Flag.WHITE


NONE_MOORED: frozenset[Berth] = frozenset()
NO_MARKS: Map[Berth, Flag] = MappingProxyType({})
BRIGHT = frozenset({Flag.RED, Flag.WHITE})
DEEP_MM = 2

UNIVERSE: Mapping[object, list[object]] = {
    Berth: [Berth("b0"), Berth("b1"), Berth("b2")],
    Ship: [Ship("s0"), Ship("s1")],
    Tide: [Tide(0), Tide(1), Tide(2)],
    Visit: [Visit(Tide(0), Ship("s0")), Visit(Tide(1), Ship("s0")), Visit(Tide(1), Ship("s1"))],
}


# Logic ---------------------------------------------------------------------------------------


def either(harbour: Harbour, berth: Berth) -> bool:
    return harbour.quiet or berth in harbour.closed


def both(harbour: Harbour, berth: Berth) -> bool:
    return harbour.quiet and berth in harbour.closed


def neither(harbour: Harbour, berth: Berth) -> bool:
    return not (harbour.quiet or berth in harbour.closed)


def three_parts(harbour: Harbour, berth: Berth, ship: Ship) -> bool:
    return (harbour.quiet and berth not in harbour.closed) or (ship, berth) in harbour.flags


def chosen(harbour: Harbour, berth: Berth, other: Berth) -> Berth:
    return berth if berth in harbour.closed else other


def guarded_by_and(harbour: Harbour, ship: Ship) -> bool:
    return ship in harbour.weight and harbour.weight[ship] > 0


def guarded_by_or(harbour: Harbour, ship: Ship) -> bool:
    return ship not in harbour.weight or harbour.weight[ship] > 0


# Comparison ----------------------------------------------------------------------------------


def no_last(harbour: Harbour) -> bool:
    return harbour.last is None


def some_last(harbour: Harbour) -> bool:
    return harbour.last is not None


def earlier(tide: Tide, other: Tide) -> bool:
    return tide < other


def not_later(tide: Tide, other: Tide) -> bool:
    return tide <= other


def later(tide: Tide, other: Tide) -> bool:
    return tide > other


def not_earlier(tide: Tide, other: Tide) -> bool:
    return tide >= other


def between(harbour: Harbour, tide: Tide, other: Tide) -> bool:
    return tide <= harbour.tide < other


def newer_than_last(harbour: Harbour, visit: Visit) -> bool:
    return harbour.last is None or harbour.last.tide < visit.tide


def same_holder(harbour: Harbour, one: Ship, other: Ship) -> bool:
    return harbour.home.get(one) == harbour.home.get(other)


def holder_is(harbour: Harbour, ship: Ship, berth: Berth) -> bool:
    return harbour.home.get(ship) == berth


def holder_is_not(harbour: Harbour, ship: Ship, berth: Berth) -> bool:
    return berth != harbour.home.get(ship)


def same_flag_and_place(harbour: Harbour, ship: Ship, berth: Berth) -> bool:
    return ship in harbour.route and harbour.route[ship] == (berth, Flag.GREEN)


def flag_is(harbour: Harbour, berth: Berth) -> bool:
    return berth in harbour.slots and harbour.slots[berth].flag is Flag.GREEN


def flag_is_bright(harbour: Harbour, berth: Berth) -> bool:
    return berth in harbour.slots and harbour.slots[berth].flag in BRIGHT


def flag_is_listed(harbour: Harbour, berth: Berth) -> bool:
    return berth in harbour.slots and harbour.slots[berth].flag in (Flag.GREEN, Flag.RED)


def open_as_quiet(harbour: Harbour, berth: Berth) -> bool:
    return berth in harbour.slots and harbour.slots[berth].is_open == harbour.quiet


def same_sets(harbour: Harbour, visit: Visit) -> bool:
    return harbour.moored.get(visit, frozenset()) == harbour.closed


def included_sets(harbour: Harbour, visit: Visit) -> bool:
    return harbour.moored.get(visit, frozenset()) <= harbour.closed


def same_maps(harbour: Harbour, one: Visit, other: Visit) -> bool:
    return harbour.marks.get(one, NO_MARKS) == harbour.marks.get(other, NO_MARKS)


def same_slot(harbour: Harbour, one: Berth, other: Berth) -> bool:
    return harbour.slots.get(one) == harbour.slots.get(other)


# Arithmetic ----------------------------------------------------------------------------------


def calculated(harbour: Harbour, amount: int) -> int:
    return (harbour.level + amount) * DEEP_MM - -amount


def divided(harbour: Harbour, amount: int) -> int:
    return harbour.level // amount if amount != 0 else 0


def remainder(harbour: Harbour, amount: int) -> int:
    return harbour.level % amount if amount != 0 else 0


def within(harbour: Harbour, amount: int) -> bool:
    return -DEEP_MM <= harbour.level < amount + 1


# Lookup --------------------------------------------------------------------------------------


def holder(harbour: Harbour, ship: Ship) -> Berth | None:
    return harbour.home.get(ship)


def moored_berths(harbour: Harbour, visit: Visit) -> frozenset[Berth]:
    return harbour.moored.get(visit, frozenset())


def moored_berths_of_last(harbour: Harbour) -> frozenset[Berth]:
    return harbour.moored.get(harbour.last, NONE_MOORED) if harbour.last is not None else NONE_MOORED


def flag_or_red(harbour: Harbour, ship: Ship, berth: Berth) -> Flag:
    return harbour.flags.get((ship, berth), Flag.RED)


def weight_or(harbour: Harbour, ship: Ship, amount: int) -> int:
    return harbour.weight.get(ship, amount)


def moored_or_closed(harbour: Harbour, visit: Visit) -> frozenset[Berth]:
    return harbour.moored.get(visit, harbour.closed)


def nested_marks(harbour: Harbour, visit: Visit, berth: Berth) -> Flag | None:
    return harbour.marks.get(visit, NO_MARKS).get(berth)


def marked(harbour: Harbour, visit: Visit, berth: Berth) -> bool:
    return visit in harbour.marks and berth in harbour.marks[visit] and harbour.marks[visit][berth] == Flag.GREEN


def slot_of(harbour: Harbour, berth: Berth) -> Slot | None:
    return harbour.slots.get(berth)


def first_of_route(harbour: Harbour, ship: Ship, berth: Berth) -> Berth:
    return harbour.route[ship][0] if ship in harbour.route else berth


def unguarded_lookup(harbour: Harbour, ship: Ship) -> int:
    return harbour.weight[ship]


def unguarded_option(harbour: Harbour) -> Tide:
    return harbour.last.tide  # type: ignore[union-attr]


def unguarded_in_loop(harbour: Harbour, visit: Visit) -> bool:
    return all(harbour.slots[berth].is_open for berth in harbour.moored.get(visit, frozenset()))


def unguarded_in_comprehension(harbour: Harbour) -> Mapping[Berth, Flag]:
    return {berth: harbour.slots[berth].flag for berth in harbour.closed}


def asserted(harbour: Harbour, ship: Ship) -> int:
    assert ship in harbour.weight
    return harbour.weight[ship]


# Sets and maps -------------------------------------------------------------------------------


def with_berth(harbour: Harbour, berth: Berth, other: Berth) -> frozenset[Berth]:
    return harbour.closed | {berth, other}


def without_berth(harbour: Harbour, berth: Berth) -> frozenset[Berth]:
    return harbour.closed - frozenset({berth})


def common(harbour: Harbour, visit: Visit) -> frozenset[Berth]:
    return harbour.closed & harbour.moored.get(visit, frozenset())


def with_stay(harbour: Harbour, visit: Visit, berth: Berth) -> frozenset[tuple[Visit, Berth]]:
    return harbour.stays | {(visit, berth)}


def has_stay(harbour: Harbour, visit: Visit, berth: Berth) -> bool:
    return (visit, berth) in harbour.stays


def at_home(harbour: Harbour, ship: Ship) -> bool:
    return harbour.home.get(ship) in harbour.closed


def kept_berths(harbour: Harbour, berth: Berth) -> frozenset[Berth]:
    return frozenset(other for other in harbour.closed if other != berth)


def berths_of(harbour: Harbour, ship: Ship) -> frozenset[Berth]:
    return frozenset(berth for visit, berth in harbour.stays if visit.ship == ship)


def ships_seen(harbour: Harbour) -> frozenset[Ship]:
    return frozenset(visit.ship for visit in harbour.moored if harbour.moored[visit] != NONE_MOORED)


def stays_of_moored(harbour: Harbour) -> frozenset[tuple[Visit, Berth]]:
    return frozenset((visit, berth) for visit, berths in harbour.moored.items() for berth in berths)


def swapped_pairs(harbour: Harbour) -> frozenset[tuple[Berth, Ship]]:
    return frozenset((berth, ship) for (ship, berth), flag in harbour.flags.items() if flag == Flag.RED)


def twins(harbour: Harbour) -> frozenset[tuple[Berth, Berth]]:
    return frozenset((berth, berth) for berth in harbour.closed)


def raised(harbour: Harbour, ship: Ship, berth: Berth) -> Mapping[tuple[Ship, Berth], Flag]:
    return {**harbour.flags, (ship, berth): Flag.WHITE}


def raised_twice(harbour: Harbour, ship: Ship, berth: Berth) -> Mapping[tuple[Ship, Berth], Flag]:
    others = {(ship, other): Flag.GREEN for other in harbour.closed}
    return {**harbour.flags, (ship, berth): Flag.WHITE, **others}


def raised_everywhere(harbour: Harbour, ship: Ship) -> Mapping[tuple[Ship, Berth], Flag]:
    return {
        **harbour.flags,
        **{(ship, berth): Flag.GREEN for berth in harbour.closed if berth in harbour.slots},
    }


def listed_twice(berth: Berth, other: Berth) -> Mapping[Berth, Flag]:
    return {berth: Flag.RED, other: Flag.GREEN}


def moved_home(harbour: Harbour, ship: Ship, berth: Berth) -> Mapping[Ship, Berth | None]:
    return {**harbour.home, ship: None if berth in harbour.closed else berth}


def removed(harbour: Harbour, visit: Visit) -> Map[Visit, frozenset[Berth]]:
    return {other: berths for other, berths in harbour.moored.items() if other != visit}


def removed_marks(harbour: Harbour, visit: Visit) -> Map[Visit, Map[Berth, Flag]]:
    return {other: harbour.marks[other] for other in harbour.marks if other != visit}


def removed_then_read(harbour: Harbour, visit: Visit, asked: Visit) -> frozenset[Berth]:
    return removed(harbour, visit).get(asked, frozenset())


def one_entry_read(harbour: Harbour, visit: Visit, asked: Visit) -> frozenset[Berth]:
    return {visit: harbour.closed}.get(asked, frozenset())


def nested_removal(harbour: Harbour, berth: Berth) -> Map[Visit, Map[Berth, Flag]]:
    return harbour.marks | {
        visit: {other: flag for other, flag in harbour.marks.get(visit, {}).items() if other != berth}
        for visit in harbour.moored
    }


def changed_slots(harbour: Harbour, ship: Ship) -> Map[Berth, Slot]:
    return harbour.slots | {
        berth: replace(slot, holder=ship, seen=slot.seen | {ship})
        for berth, slot in harbour.slots.items()
        if slot.is_open and slot.holder is None
    }


def turned_over(harbour: Harbour) -> Mapping[Berth, Flag]:
    return {berth: slot.flag for berth, slot in harbour.slots.items()}


def of_two(berth: Berth, other: Berth) -> Mapping[Berth, bool]:
    return {each: each == other for each in (berth, other)}


# any, all ------------------------------------------------------------------------------------


def any_closed(harbour: Harbour) -> bool:
    return any(True for _ in harbour.closed)


def all_heavy(harbour: Harbour) -> bool:
    return all(amount > 0 for amount in harbour.weight.values())


def any_open_near(harbour: Harbour, ship: Ship) -> bool:
    return any(
        slot.is_open and berth not in harbour.closed
        for berth, slot in harbour.slots.items()
        if slot.holder is None or slot.holder == ship
    )


def all_stays_marked(harbour: Harbour) -> bool:
    return all(
        berth in harbour.marks.get(visit, NO_MARKS) for visit, berth in harbour.stays if berth not in harbour.closed
    )


def some_pair(harbour: Harbour) -> bool:
    return any(
        one.tide < other.tide and berth in harbour.moored[other]
        for one in harbour.moored
        for other in harbour.moored
        if one != other
        for berth in harbour.moored[one]
    )


def each_has_one(harbour: Harbour) -> bool:
    return all(any(other == visit for other, berth in harbour.stays) for visit in harbour.moored)


def all_of_two(harbour: Harbour, berth: Berth, other: Berth) -> bool:
    return all(each in harbour.closed for each in {berth, other})


FUNCTIONS = [
    value
    for name, value in list(globals().items())
    if callable(value) and getattr(value, "__module__", "") == __name__ and not isinstance(value, (type, NewType))
]
