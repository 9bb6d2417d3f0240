"""Integer arithmetic for the machines on board, every rounding said by its name.

Units go by their products: mm/s times ms is µm, mm/s² times ms is µm/s.
"""

from __future__ import annotations

CYCLE_MS = 100
"""How long one cycle of the unit lasts (paper 001, table 2: sampled every 100 ms); P1, P8."""
SHORTEST_CYCLE_MS = 98
LONGEST_CYCLE_MS = 102
"""So long it lasts, with the declared jitter of 2 ms; one of another length is unlawful.

The clock tells whole milliseconds, so what a cycle is told to have lasted says whether it was lawful, and no more.
"""

NM_A_MM = 1_000_000
GREATEST_SPEED_MM_S = 200_000
"""Readings and claims of a speed end at 200 m/s; what is beyond is none (P1)."""


def smaller(one: int, other: int) -> int:
    """Give the smaller of two (P1)."""
    return one if one < other else other


def larger(one: int, other: int) -> int:
    """Give the larger of two (P1)."""
    return one if one > other else other


def magnitude(value: int) -> int:
    """Give a value without its sign (P1)."""
    return value if value >= 0 else -value


def limited(value: int, least: int, most: int) -> int:
    """Give the value, or the limit that it is beyond; ``least`` where the limits are crossed (P1)."""
    return larger(least, smaller(value, most))


def least_in_a_cycle(rate: int) -> int:
    """Give what a rate comes to in a lawful cycle at the least, for each ms of the rate's unit (P1)."""
    return smaller(SHORTEST_CYCLE_MS * rate, LONGEST_CYCLE_MS * rate)


def most_in_a_cycle(rate: int) -> int:
    """Give what it comes to at the most (P1)."""
    return larger(SHORTEST_CYCLE_MS * rate, LONGEST_CYCLE_MS * rate)


def divided_up(value: int, by: int) -> int:
    """Divide and round up; ``by`` is more than 0 (P1)."""
    assert by > 0
    return -(-value // by)
