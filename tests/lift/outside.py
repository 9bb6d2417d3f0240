"""Functions that the lifter must refuse, each with the line it must name (marked by ``# here``)."""

from __future__ import annotations

import functools
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any

from tests.lift.harbour import Berth, Flag, Harbour, Ship, Slot, Tide, Visit


@dataclass
class Thawed:
    """Not frozen."""

    berth: Berth


@dataclass(frozen=True)
class Floating:
    """Has a field outside the subset."""

    depth: float


@dataclass(frozen=True)
class Counted:
    """Keys must be scalars."""

    count: Mapping[frozenset[Berth], int]


@dataclass(frozen=True)
class Checked:
    """Runs code when it is made."""

    berth: Berth
    others: frozenset[Berth] = field(default_factory=frozenset)

    def __post_init__(self) -> None:
        assert self.berth not in self.others


def loop_while(harbour: Harbour) -> int:
    amount = 0
    while amount < harbour.level:  # here
        amount = amount + 1
    return amount


def loop_for(harbour: Harbour) -> int:
    amount = 0
    for _ in harbour.closed:  # here
        amount = amount + 1
    return amount


def handled(harbour: Harbour, ship: Ship) -> int:
    try:  # here
        return harbour.weight[ship]
    except KeyError:
        return 0


def raising(harbour: Harbour) -> int:
    if harbour.quiet:
        raise ValueError  # here
    return 0


def with_lambda(harbour: Harbour) -> int:
    add = lambda amount: amount + 1  # here  # noqa: E731
    return int(add(harbour.level))  # type: ignore[no-untyped-call]


def unknown_call(harbour: Harbour) -> int:
    return len(harbour.closed)  # here


def method_call(harbour: Harbour) -> bool:
    return harbour.closed.isdisjoint(frozenset())  # here


def mutable_default(harbour: Harbour, found: list[Berth] = []) -> bool:  # here  # noqa: B006
    return harbour.quiet


def floating(harbour: Harbour) -> bool:
    return harbour.level > 0.5  # here


def text(harbour: Harbour, berth: Berth) -> bool:
    return berth == "b0"  # here


def falls_off(harbour: Harbour) -> int:  # type: ignore[return]  # noqa: RET503  # here
    if harbour.quiet:
        return 1


def augmented(harbour: Harbour) -> int:
    amount = harbour.level
    amount += 1  # here
    return amount


def truthy(harbour: Harbour) -> bool:
    return True if harbour.closed else False  # here  # noqa: SIM210


def identifier_made(harbour: Harbour) -> Tide:
    return Tide(3)  # here


def visit_made(harbour: Harbour, ship: Ship) -> Visit:
    return Visit(tide=harbour.tide, ship=ship)  # here


def calculates_with_tide(tide: Tide) -> int:
    return tide + 1  # here


def orders_ships(one: Ship, other: Ship) -> bool:
    return one < other  # here


def different_types(harbour: Harbour, ship: Ship, berth: Berth) -> bool:
    return ship == berth  # type: ignore[comparison-overlap]  # here


def wrong_key(harbour: Harbour, ship: Ship) -> bool:
    return ship in harbour.closed  # type: ignore[comparison-overlap]  # here


def open_key(harbour: Harbour) -> Mapping[Ship, Berth]:
    return {ship: berth for ship in harbour.weight for berth in harbour.closed}  # here


def repeated_variable(harbour: Harbour) -> bool:
    return any(berth in harbour.slots for berth in harbour.closed for berth in harbour.closed)  # here


def list_built(harbour: Harbour) -> bool:
    return Flag.RED in [slot.flag for _, slot in harbour.slots.items()]  # here


def walrus(harbour: Harbour, ship: Ship) -> bool:
    return (berth := harbour.home.get(ship)) is not None and berth in harbour.closed  # here


def starred(harbour: Harbour, *berths: Berth) -> bool:  # here
    return harbour.quiet


def sliced(harbour: Harbour, ship: Ship) -> Any:
    return harbour.route[ship][0:1]  # here


def recursive(harbour: Harbour) -> bool:  # here
    return recursive(harbour)


def unknown_field(harbour: Harbour) -> bool:
    return harbour.nowhere  # type: ignore[attr-defined, no-any-return]  # here


def compared_by_is(harbour: Harbour, ship: Ship, other: Ship) -> bool:
    return ship is other  # here


def only_on_one_path(harbour: Harbour) -> int:
    if harbour.quiet:
        amount = 1
    return amount  # type: ignore[possibly-undefined]  # here


def slot_without_field(ship: Ship) -> Slot:
    return Slot(holder=ship)  # type: ignore[call-arg]  # here


def written_nowhere(harbour: Harbour) -> bool:
    print(harbour)  # here
    return True


def _cached(function: Callable[..., Any]) -> Callable[..., Any]:
    @functools.wraps(function)
    def wrapper(*arguments: Any) -> Any:
        return function(*arguments)

    return wrapper


@_cached
def wrapped(harbour: Harbour) -> bool:
    return harbour.quiet


REFUSED = [
    value
    for name, value in list(globals().items())
    if callable(value)
    and getattr(value, "__module__", "") == __name__
    and not isinstance(value, type)
    and not name.startswith("_")
    and name != "wrapped"
]
