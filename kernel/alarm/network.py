"""How far it is along the track where kilometrage does not run on (A1, A3; ours).

Each line on the register has figures of its own, apart from those of all others: its kilometrage, and as many hundreds
of kilometres more as are written for it.  So a figure says of which line it is, of a train as of the worker.  Where
lines join, and at a break of kilometrage, a place has two figures; which way either counts makes no difference, since
ways along the track are added up from there.

A connection says that from one figure to another it is so far along the track, whatever lines lie between.  The way
from a train to the worker is the least of the difference of their figures and of the ways over each connection: to its
one figure, along it, and on from its other.  Whoever writes the register works the connections out from the places
that have two figures.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import NewType

from kernel.alarm.distance import UM_A_MM, AlarmBounds, TrainFix, WorkerFix, is_fix, train_off_um, worker_off_um
from kernel.maps import Map
from kernel.onboard.arithmetic import larger, magnitude

Opening = NewType("Opening", str)
"""The name of a place where the register ends, and track or trains that it does not have lie beyond (A1)."""
Way = NewType("Way", str)
"""The name of a connection (A1)."""


@dataclass(frozen=True)
class Connection:
    """From one figure to another it is ``between_mm`` along the track: 0 where they are of one place (A1).

    ``to_mm`` is where lines join, or one of the two figures of a break.
    """

    from_mm: int
    to_mm: int
    between_mm: int


def over_um(connection: Connection, from_mm: int, to_mm: int, place_mm: int) -> int:
    """Give how far it is from a stretch to a place over a connection (A1)."""
    ahead_mm = larger(0, larger(from_mm - connection.from_mm, connection.from_mm - to_mm))
    return UM_A_MM * (ahead_mm + connection.between_mm + magnitude(connection.to_mm - place_mm))


def is_over_within(ways: Map[Way, Connection], from_mm: int, to_mm: int, place_mm: int, within_um: int) -> bool:
    """Tell whether a stretch is that near a place over any connection (A1)."""
    return any(over_um(connection, from_mm, to_mm, place_mm) <= within_um for _way, connection in ways.items())


def may_come_over(
    bounds: AlarmBounds, ways: Map[Way, Connection], from_mm: int, to_mm: int, worker: WorkerFix, within_um: int
) -> bool:
    """Tell whether any part of a train may be that near over a connection, if it is in a stretch (A1, A3)."""
    off_um = UM_A_MM * bounds.length_mm + worker_off_um(bounds, worker)
    return is_over_within(ways, from_mm, to_mm, worker.place_mm, within_um + off_um)


def is_at_a_join(ways: Map[Way, Connection], place_mm: int, within_um: int) -> bool:
    """Tell whether a place is that near one where lines join, by figures (A3)."""
    return any(UM_A_MM * magnitude(connection.to_mm - place_mm) <= within_um for _way, connection in ways.items())


def may_have_passed_a_join(bounds: AlarmBounds, ways: Map[Way, Connection], fix: TrainFix) -> bool:
    """Tell whether any part of a train may be where lines join, or have passed there since it was told (A3).

    It may run towards the worker then without having turned, as round a loop; its direction is not believed.
    """
    return is_at_a_join(ways, fix.place_mm, UM_A_MM * bounds.length_mm + train_off_um(bounds, fix))


def may_be_told_across_a_join(bounds: AlarmBounds, ways: Map[Way, Connection], worker: WorkerFix) -> bool:
    """Tell whether the worker may be where lines join, and so be on another line than he is told on (A3)."""
    return is_at_a_join(ways, worker.place_mm, worker_off_um(bounds, worker))


def jumps(bounds: AlarmBounds, ways: Map[Way, Connection], before: TrainFix, fix: TrainFix) -> bool:
    """Tell whether a train cannot have been where both fixes say, when they say it, by any way (A1, ours)."""
    if not is_fix(before.place_mm, before.age_ms):
        return False
    run_um = bounds.train_mm_s * magnitude(fix.age_ms - before.age_ms) + 2 * UM_A_MM * bounds.train_error_mm
    return (
        UM_A_MM * magnitude(fix.place_mm - before.place_mm) > run_um
        and not is_over_within(ways, before.place_mm, before.place_mm, fix.place_mm, run_um)
        and not is_over_within(ways, fix.place_mm, fix.place_mm, before.place_mm, run_um)
    )
