"""What may happen in the made-up harbour: one function for each construct of a statement, and transitions."""

from __future__ import annotations

from dataclasses import replace
from typing import NewType

from tests.lift.harbour import NONE_MOORED, Berth, Flag, Harbour, Port, Report, Ship, Slot, Visit

# Statements ----------------------------------------------------------------------------------


def returned_early(harbour: Harbour, ship: Ship) -> Flag:
    if ship not in harbour.weight:
        return Flag.RED
    if harbour.weight[ship] > harbour.level:
        return Flag.WHITE
    return Flag.GREEN


def fell_through(harbour: Harbour, ship: Ship, berth: Berth) -> frozenset[Berth]:
    found = harbour.closed
    if berth in harbour.slots:
        found = found | {berth}
        wanted = harbour.slots[berth].holder
    else:
        wanted = None
    if wanted == ship:
        return frozenset()
    return found


def returned_inside(harbour: Harbour, berth: Berth) -> int:
    amount = 1
    if berth in harbour.closed:
        if harbour.quiet:
            return 0
        amount = 2
    elif berth in harbour.slots:
        amount = harbour.slots[berth].depth
    else:
        amount = 3
    return amount + 1


def unpacked(harbour: Harbour, ship: Ship, berth: Berth) -> tuple[Flag, Berth]:
    place, flag = harbour.route.get(ship, (berth, Flag.RED))
    return flag, place


def narrowed(harbour: Harbour, ship: Ship) -> frozenset[Ship]:
    berth: Berth | None = harbour.home.get(ship)
    if berth is None:
        return frozenset()
    slot = harbour.slots.get(berth)
    if slot is None or slot.holder is None:
        return frozenset({ship})
    return slot.seen | {slot.holder}


def helper(harbour: Harbour, berth: Berth, *, strict: bool = False, flag: Flag = Flag.GREEN) -> bool:
    if strict and berth in harbour.closed:
        return False
    return berth not in harbour.slots or harbour.slots[berth].flag == flag


def called(harbour: Harbour, berth: Berth) -> bool:
    return helper(harbour, berth, strict=True) or helper(berth=berth, harbour=harbour, flag=Flag.RED)


def made(harbour: Harbour, ship: Ship) -> Slot:
    return Slot(harbour.last.ship if harbour.last is not None else ship, Flag.RED, depth=3, is_open=True, seen={ship})  # type: ignore[arg-type]


# Transitions ---------------------------------------------------------------------------------


def enter(harbour: Harbour, visit: Visit, berth: Berth) -> Harbour:
    """Refused, unchanged; or the berth is the visit's."""
    if berth in harbour.closed or harbour.moored.get(visit, frozenset()) != NONE_MOORED:
        return harbour
    if harbour.last is not None and visit.tide <= harbour.last.tide:
        return harbour
    return replace(
        harbour, last=visit, closed=harbour.closed | {berth}, moored=harbour.moored | {visit: frozenset({berth})}
    )


def leave(harbour: Harbour, visit: Visit) -> Harbour:
    freed = harbour.moored.get(visit, frozenset())
    return replace(
        harbour,
        closed=harbour.closed - freed,
        moored={other: berths for other, berths in harbour.moored.items() if other != visit},
        slots=harbour.slots
        | {berth: replace(harbour.slots[berth], holder=None) for berth in freed if berth in harbour.slots},
    )


def port_enter(port: Port, visit: Visit, berth: Berth) -> Port:
    if port.alarm:
        return port
    return replace(port, harbour=enter(port.harbour, visit, berth))


def port_enter_logged(port: Port, visit: Visit, berth: Berth) -> Port:
    harbour = enter(port.harbour, visit, berth)
    if harbour.quiet:
        return replace(port, alarm=True, harbour=harbour)
    return replace(port, harbour=harbour, log=port.log | {visit.ship})


def attempt(harbour: Harbour, berth: Berth) -> tuple[Harbour, frozenset[Berth]]:
    if berth in harbour.closed:
        return harbour, frozenset()
    return replace(harbour, quiet=False), frozenset({berth})


def port_attempt(port: Port, berth: Berth) -> Report:
    harbour, moved = attempt(port.harbour, berth)
    return Report(port=replace(port, harbour=harbour), moved=moved)


def maybe(harbour: Harbour, ship: Ship) -> Harbour | None:
    return None if ship in harbour.home else replace(harbour, level=harbour.level + 1)


def port_maybe(port: Port, ship: Ship) -> Port:
    harbour = maybe(port.harbour, ship)
    if harbour is None:
        return port
    return replace(port, harbour=harbour)


def overwritten(port: Port, harbour: Harbour) -> Port:
    return replace(replace(port, harbour=harbour), alarm=harbour.quiet)


FUNCTIONS = [
    value
    for name, value in list(globals().items())
    if callable(value) and getattr(value, "__module__", "") == __name__ and not isinstance(value, (type, NewType))
]
