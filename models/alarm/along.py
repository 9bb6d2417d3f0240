"""How far it is along the track from a stretch to a place, as the register has it: by figures, or over a connection.

Stretches and connections are in mm, places on the worker's line and ways in µm.
"""

from __future__ import annotations

from kernel.alarm.network import Connection, Opening
from kernel.alarm.tone import Register
from models.measures import UM_A_MM, apart, greater


def is_by_figures(from_mm: int, to_mm: int, place_um: int, within_um: int) -> bool:
    """Tell whether a stretch is that near a place by the difference of figures (A1)."""
    return greater(UM_A_MM * from_mm - place_um, place_um - UM_A_MM * to_mm) <= within_um


def over_um(connection: Connection, from_mm: int, to_mm: int, place_um: int) -> int:
    """Give how far it is from a stretch to a place over a connection (A1)."""
    ahead_mm = greater(0, greater(from_mm - connection.from_mm, connection.from_mm - to_mm))
    return UM_A_MM * ahead_mm + UM_A_MM * connection.between_mm + apart(UM_A_MM * connection.to_mm, place_um)


def is_over(register: Register, from_mm: int, to_mm: int, place_um: int, within_um: int) -> bool:
    """Tell whether a stretch is that near a place over any connection (A1)."""
    return any(over_um(connection, from_mm, to_mm, place_um) <= within_um for _way, connection in register.ways.items())


def is_along(register: Register, from_mm: int, to_mm: int, place_um: int, within_um: int) -> bool:
    """Tell whether a stretch is that near a place by any way that the register has (A1)."""
    return is_by_figures(from_mm, to_mm, place_um, within_um) or is_over(register, from_mm, to_mm, place_um, within_um)


def is_at_a_join(register: Register, place_mm: int, within_um: int) -> bool:
    """Tell whether a place is that near one where lines join, by figures (A1)."""
    return any(UM_A_MM * apart(connection.to_mm, place_mm) <= within_um for _way, connection in register.ways.items())


def is_beyond_within(register: Register, opening: Opening, beyond_um: int, worker_um: int, limit_mm: int) -> bool:
    """Tell whether a train is that near which is beyond the register's lines, by the opening to which it leads (A3).

    ``beyond_um``: how far its nearest part is from there; below 0 where it stands astride, by no more than its length.
    """
    return (
        opening in register.openings
        and beyond_um >= -UM_A_MM * register.bounds.length_mm
        and is_along(
            register,
            register.openings[opening],
            register.openings[opening],
            worker_um,
            UM_A_MM * limit_mm - beyond_um,
        )
    )


def far_um(register: Register) -> int:
    """Give how long a way may be that is not on the register (A1).

    3000 m, a train's length, and what it runs while what is told of it is fresh.
    """
    fresh = register.fresh
    return UM_A_MM * (3_000_000 + register.bounds.length_mm) + register.bounds.train_mm_s * greater(
        fresh.fix_ms, fresh.display_ms
    )


def told_far_um(register: Register) -> int:
    """Give how long a way may be, between where a train and a worker are told to be, that is not on the register (A1).

    As long as one from where they are, and what either may be told too far.
    """
    bounds = register.bounds
    off_mm = greater(bounds.train_error_mm, register.display_error_mm) + bounds.worker_error_mm
    return far_um(register) + UM_A_MM * off_mm + bounds.worker_mm_s * register.fresh.worker_ms


def beyond_um(register: Register) -> int:
    """Give how far from where something is the figures may lie that are told of it, or agree with what is told (A1)."""
    bounds = register.bounds
    told_mm = greater(greater(bounds.train_error_mm, bounds.worker_error_mm), register.display_error_mm)
    return UM_A_MM * greater(told_mm, register.tolerance_mm)
