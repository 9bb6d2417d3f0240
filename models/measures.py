"""Arithmetic of the worlds' own.

What a machine reckons is held against what is so, and a world that borrowed the machine's sums would err with it.
"""

from __future__ import annotations

UM_A_MM = 1_000
"""µm in a millimetre."""


def greater(one: int, other: int) -> int:
    """Give the greater of two."""
    return one if one > other else other


def lesser(one: int, other: int) -> int:
    """Give the lesser of two."""
    return one if one <= other else other


def apart(one: int, other: int) -> int:
    """Give how far two are from each other."""
    return one - other if one >= other else other - one
