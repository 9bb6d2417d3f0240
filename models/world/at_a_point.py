"""What happens at a point: an order arrives, the point drifts while unlocked, the terminal restarts."""

from __future__ import annotations

from dataclasses import replace

from kernel import terminal as machine
from kernel.names import Point, Position, Run, TerminalLife
from kernel.restarts import restart_terminal as restarted_terminal
from kernel.terminal import Terminal
from models.world.assumptions import detection_is_true
from models.world.state import Site, System


def with_terminal(system: System, point: Point, terminal: Terminal) -> System:
    """Put a terminal's next state in its place."""
    return replace(system, terminals=system.terminals | {point: terminal})


def obey_order(
    site: Site, system: System, run: Run, point: Point, life: TerminalLife, detected: Position, is_detected: bool
) -> System:
    """An order arrives from a train; its position is the one the route needs (T10).

    The contacts show how the point lies, or nothing: a contact bounces under a train, and none is made in between.
    """
    if (run, point, life) not in system.radio.relayed_orders or point not in system.terminals:
        return system
    if run.route not in site.layout.needs or point not in site.layout.needs[run.route]:
        return system
    if is_detected and not detection_is_true(system, point, detected):
        return system
    wanted = site.layout.needs[run.route][point]
    terminal = machine.obey(system.terminals[point], run, wanted, life, detected, is_detected)
    return with_terminal(system, point, terminal)


def answer_enquiry(site: Site, system: System, run: Run, point: Point, life: TerminalLife) -> System:
    """An enquiry how the point lies arrives from the train over it (T8, T10)."""
    if (run, point, life) not in system.radio.relayed_enquiries or point not in system.terminals:
        return system
    return with_terminal(system, point, machine.relabel(system.terminals[point], run, life))


def drift(site: Site, system: System, point: Point, position: Position) -> System:
    """An unlocked point moves: thrown by its motor, by hand, by a vehicle (T10)."""
    if point not in system.terminals or not system.terminals[point].unlocked:
        return system
    return replace(system, track=replace(system.track, lies=system.track.lies | {point: position}))


def lock(site: Site, system: System, point: Point, detected: Position, is_detected: bool) -> System:
    """The terminal finds the point as wanted and locks it (T10)."""
    if point not in system.terminals or (is_detected and not detection_is_true(system, point, detected)):
        return system
    return with_terminal(system, point, machine.lock(system.terminals[point], detected, is_detected))


def restart_terminal(site: Site, system: System, point: Point, life: TerminalLife) -> System:
    """A terminal restarts; its lock stays as it is, its lock id is lost (T8, T10)."""
    if point not in system.terminals or life <= system.terminals[point].life:
        return system
    return with_terminal(system, point, restarted_terminal(system.terminals[point], life))
