"""Whether what is written for a line and its handsets may be used: asked before a handset is handed out (A1)."""

from __future__ import annotations

from kernel.alarm.extents import Extent, Line, are_surveyed, has_all_on_lines, has_joins_on_lines
from kernel.alarm.least_ways import Equation, Join, has_least_ways
from kernel.alarm.tone import Register
from kernel.maps import Map

GREATEST_SERVER_MS = 3_600_000
"""A list counts as fresh for an hour at most (ours)."""


def is_lawful(register: Register, joins: Map[Join, Equation], lines: Map[Line, Extent]) -> bool:
    """Tell whether a register may be used; if not, no handset is given out with it (A1).

    Nothing in it is below zero, and the server's list is fresh for an hour at most.

    ``joins``: the places of its lines that have two figures; no way over them is missing or too long.
    ``lines``: from where to where their figures run; no two lines have one, and each end is as written.
    """
    bounds, fresh = register.bounds, register.fresh
    return (
        bounds.train_mm_s >= 0
        and bounds.worker_mm_s >= 0
        and bounds.length_mm >= 0
        and bounds.train_error_mm >= 0
        and bounds.worker_error_mm >= 0
        and bounds.turning_ms >= 0
        and fresh.fix_ms >= 0
        and fresh.display_ms >= 0
        and 0 <= fresh.server_ms <= GREATEST_SERVER_MS
        and fresh.worker_ms >= 0
        and register.display_error_mm >= 0
        and register.tolerance_mm >= 0
        and are_surveyed(register, joins, lines)
        and has_joins_on_lines(joins, lines)
        and has_all_on_lines(register, lines)
        and has_least_ways(register, joins)
    )
