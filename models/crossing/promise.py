"""A train that promises a ceiling of speed up to the road, the crossing that notes it, and the radio between (X2).

Of the train there is its speed alone, and what it has promised.  The radio may lose, repeat and delay whatever was
sent, either way.  When the crossing acknowledges is no matter here: it may do so at any moment, what is asked for.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

from kernel.crossing import promise as machine
from kernel.crossing.promise import Promise


@dataclass(frozen=True)
class Line:
    """What does not change: the greatest speed of the line, with what a driver may exceed it by (X2)."""

    line_mm_s: int


@dataclass(frozen=True)
class Promising:
    """One moment.

    ``speed_mm_s``: how fast the train runs towards the road.
    ``held``: what it holds to.  ``noted``: what the crossing has noted of it.
    ``told``: history: all that the train has told in answer to orders of the crossing, since that started last.
    ``acknowledged``: history: the numbers of all that was ever acknowledged.
    """

    speed_mm_s: int
    held: Promise
    noted: Promise
    told: frozenset[Promise]
    acknowledged: frozenset[int]


# ---- assumptions


def the_supervision_keeps_the_speed(limit_mm_s: int, speed_mm_s: int) -> bool:
    """The train's own speed supervision keeps it from running faster than what it is given (T12)."""
    return speed_mm_s <= limit_mm_s


def the_range_has_the_speed(system: Promising, speed_most_mm_s: int) -> bool:
    """The train is no faster than the upper end of its odometry's range (P1)."""
    return system.speed_mm_s <= speed_most_mm_s


def only_what_was_told_is_heard(system: Promising, told: Promise) -> bool:
    """What the crossing hears of this train was told by it, in answer to an order since the crossing started (X1)."""
    return told in system.told


def only_what_was_acknowledged_is_heard(system: Promising, number: int) -> bool:
    """What the train hears as the crossing's acknowledgement is one, of this train (T11)."""
    return number in system.acknowledged


# ---- transitions


def run(site: Line, system: Promising, speed_mm_s: int) -> Promising:
    """The train runs as fast as its supervision lets it (T12)."""
    if not the_supervision_keeps_the_speed(system.held.ceiling_mm_s, speed_mm_s):
        return system
    return replace(system, speed_mm_s=speed_mm_s)


def lower(site: Line, system: Promising, ceiling_mm_s: int, speed_most_mm_s: int) -> Promising:
    """The train is to promise a lower ceiling; any, and at any speed (X2)."""
    if not the_range_has_the_speed(system, speed_most_mm_s):
        return system
    return replace(system, held=machine.lower(system.held, ceiling_mm_s, speed_most_mm_s))


def ask(site: Line, system: Promising, asked_mm_s: int) -> Promising:
    """The train is to ask for a higher ceiling, no higher than the line's (X2)."""
    return replace(system, held=machine.ask(site.line_mm_s, system.held, asked_mm_s))


def tell(site: Line, system: Promising) -> Promising:
    """The train tells what it holds to, with its place; whether that is heard is another matter (X1)."""
    return replace(system, told=system.told | {system.held})


def hear_promise(site: Line, system: Promising, told: Promise) -> Promising:
    """The crossing hears something that the train has told, now or before, once or again (X1)."""
    if not only_what_was_told_is_heard(system, told):
        return system
    return replace(system, noted=machine.note(system.noted, told))


def acknowledge(site: Line, system: Promising) -> Promising:
    """The crossing acknowledges what is asked for: its answers would be far even so (X2)."""
    noted = machine.acknowledged(system.noted)
    return replace(system, noted=noted, acknowledged=system.acknowledged | {noted.number})


def hear_acknowledgement(site: Line, system: Promising, number: int) -> Promising:
    """The train hears an acknowledgement, now or later, once or again (X2)."""
    if not only_what_was_acknowledged_is_heard(system, number):
        return system
    return replace(system, held=machine.note_acknowledged(system.held, number))


def restart_crossing(site: Line, system: Promising) -> Promising:
    """The crossing restarts, or takes a new contact: it has noted nothing, and orders from before count no more (X3).

    Acknowledgements from before may be under way still.
    """
    return replace(system, noted=machine.nothing_promised(site.line_mm_s), told=frozenset())
