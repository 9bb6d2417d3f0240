"""Units of the physical worlds, and how long a cycle lasts: nature's own, not the kernel's.

Units go by their products: µm/s times ms is nm, mm/s² times ms is µm/s.
"""

from __future__ import annotations

MS_A_CYCLE = 100
"""Sensors are sampled every 100 ms (paper 001, table 2)."""
SHORTEST_MS, LONGEST_MS = 98, 102
"""By the processor's clock, with 2 ms of jitter (ours: its interrupt latency)."""
NM_A_MM = 1_000_000
UM_A_MM = 1_000
PPM = 1_000_000
NO_SPEED_MM_S = 200_000
"""A reading beyond 200 m/s, or of pulses that go on as fast, is a gross fault and no measurement (ours)."""
NO_PLACE_MM = 10**12
"""Nor is a count of pulses beyond a million kilometres (ours)."""


def larger(one: int, other: int) -> int:
    """Give the larger of two."""
    return one if one > other else other


def smaller(one: int, other: int) -> int:
    """Give the smaller of two."""
    return one if one < other else other


def magnitude(value: int) -> int:
    """Give a value without its sign."""
    return value if value >= 0 else -value


def whole_mm(place_nm: int) -> int:
    """Give the nearest whole mm that is no less: where a place in nm counts for those who know millimetres."""
    return -(-place_nm // NM_A_MM)
