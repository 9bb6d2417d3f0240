"""A point's control terminal as one machine: orders and enquiries by way of a train, contacts, a tick (T10).

Whatever it is told it takes together with what the contacts show at that moment.
"""

from __future__ import annotations

from dataclasses import dataclass

from kernel import terminal as steps
from kernel.machine.messages import (
    Confirmation,
    FromTerminal,
    PointEnquiry,
    PointOrder,
    TerminalTold,
    Tick,
    ToTerminal,
)
from kernel.names import Point, Position, TerminalLife
from kernel.restarts import restart_terminal
from kernel.terminal import Terminal


@dataclass(frozen=True)
class Contacts:
    """What the detector contacts of a point show: ``position``, if any contact is made (T10)."""

    position: Position
    is_made: bool


@dataclass(frozen=True)
class Written:
    """What the lasting memory of a terminal holds: the count of its lives, and whether the lock is open (T8, T10)."""

    life: TerminalLife
    unlocked: bool


NEVER_STARTED = Written(life=TerminalLife(0), unlocked=False)
"""The lasting memory of a terminal before its first start; the point is locked by hand until then."""


def to_write(terminal: Terminal) -> Written:
    """Give what lasting memory must hold before the terminal acts or speaks (T8, T10)."""
    return Written(terminal.life, terminal.unlocked)


def start(written: Written) -> Terminal:
    """Begin with what lasting memory holds, and nothing else: a new life, the lock as it was (T8, T10)."""
    before = Terminal(life=written.life, holds=None, wanted=None, unlocked=written.unlocked)
    return restart_terminal(before, TerminalLife(written.life + 1))


def answer(terminal: Terminal, told: ToTerminal | Tick, contacts: Contacts) -> Terminal:
    """Take an order, an enquiry, or the tick at which the terminal looks whether the point lies as wanted (T8, T10)."""
    match told:
        case PointOrder(run, _, position, life):
            return steps.obey(terminal, run, position, life, contacts.position, contacts.is_made)
        case PointEnquiry(run, _, life):
            return steps.relabel(terminal, run, life)
        case Tick():
            return steps.lock(terminal, contacts.position, contacts.is_made)


def throws_to(terminal: Terminal, written: Written) -> Position | None:
    """Give where the motor runs to: not before lasting memory has it that the lock is open (T8, T10)."""
    return terminal.wanted if terminal.unlocked and written == to_write(terminal) else None


def says(terminal: Terminal, written: Written, point: Point, contacts: Contacts) -> tuple[FromTerminal, ...]:
    """Give what it tells by way of any train: its life, and how its point is locked and for which run (T10)."""
    if written != to_write(terminal):
        return ()
    run, lies = terminal.holds, contacts.position
    if run is None or not steps.confirms(terminal, run, lies, lies, contacts.is_made):
        return (TerminalTold(point, terminal.life),)
    return (TerminalTold(point, terminal.life), Confirmation(run, point, lies))
