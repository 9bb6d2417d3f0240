"""What is on record of orders to recover, and that their way stays clear as long as one may be taken (G5)."""

from __future__ import annotations

from kernel.tram.centre import Command
from models.tram.dispatching import Traffic, Way, mark, may_still_come, place


def may_be_taken(system: Traffic, command: Command) -> bool:
    """Tell whether a command is newer than all that its tram, on the way, was shown, and the tram may be there yet."""
    return (
        command.tram in system.bodies
        and command.recovers
        and command.made_ms > system.bodies[command.tram].display.made_ms
        and place(system.bodies[command.tram]) < mark(command.stop + 1, False)
    )


def recoveries_are_ordered_one_stop_on(site: Way, system: Traffic) -> bool:
    """A tram is ordered to recover no farther than to the stop after the one reached (G5)."""
    return all(known.recovery_to <= known.stop + 1 for _tram, known in system.centre.trams.items())


def recoveries_sent_are_on_record(site: Way, system: Traffic) -> bool:
    """The centre has it on record as long as one may still be taken; none is from where a tram leaves (G5)."""
    return all(
        not may_be_taken(system, command)
        or command.tram not in system.centre.trams
        or mark(system.centre.trams[command.tram].stop, system.centre.trams[command.tram].left)
        >= mark(command.stop + 1, False)
        or (
            system.centre.trams[command.tram].recovery_to == command.stop + 1
            and system.centre.trams[command.tram].leaves_at > command.stop
        )
        for command in system.sent
    )


def recoveries_shown_are_on_record(site: Way, system: Traffic) -> bool:
    """And as long as one is shown (G5)."""
    return all(
        not body.display.recovers
        or tram not in system.centre.trams
        or system.centre.trams[tram].recovery_to == body.stop + 1
        for tram, body in system.bodies.items()
    )


def recoveries_sent_have_a_clear_way(site: Way, system: Traffic) -> bool:
    """As long as one may still be taken, every tram ahead on the way has left the next stop (G5)."""
    return all(
        not may_be_taken(system, command)
        or other == command.tram
        or ahead.rank > system.bodies[command.tram].rank
        or place(ahead) > mark(command.stop + 1, False)
        for command in system.sent
        if command.tram in system.bodies
        for other, ahead in system.bodies.items()
    )


def nor_will_one_come_before_one_sent(site: Way, system: Traffic) -> bool:
    """Nor is one confirmed that could come there (G5)."""
    return all(
        not may_be_taken(system, command)
        or not may_still_come(site, system, other)
        or run.stop == 0
        or system.bodies[command.tram].stop > run.stop
        or run.stop > command.stop + 1
        for command in system.sent
        if command.tram in system.bodies
        for other, run in system.runs.items()
    )


def nor_will_one_come_before_one_shown(site: Way, system: Traffic) -> bool:
    """Nor before a tram that recovers already (G5)."""
    return all(
        not body.display.recovers
        or not may_still_come(site, system, other)
        or run.stop == 0
        or body.stop > run.stop
        or run.stop > body.stop + 1
        for _tram, body in system.bodies.items()
        for other, run in system.runs.items()
    )


def who_is_to_come_is_not_ordered_to_recover(site: Way, system: Traffic) -> bool:
    """No order to recover was made for a tram since it was confirmed, before it came (G5, ours)."""
    return all(
        not command.recovers or command.tram not in system.runs or command.made_ms <= system.runs[command.tram].at_ms
        for command in system.sent
    )
