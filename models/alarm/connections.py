"""The connections of a register, worked out from the places of its lines that have two figures (A1)."""

from __future__ import annotations

from heapq import heappop, heappush

from kernel.alarm.least_ways import Equation, Join, far_um
from kernel.alarm.network import Connection, Way
from kernel.alarm.tone import Register
from kernel.maps import Map
from models.measures import UM_A_MM


def connections(register: Register, joins: Map[Join, Equation]) -> dict[Way, Connection]:
    """Give the least ways from figure to figure, as far as they matter; `kernel.alarm.limits` accepts them.

    Each is found by the shortest first; what is no shorter than another and the way along a line is left out.
    """
    sides = sorted(
        {(one_mm, other_mm) for _join, at in joins.items() for one_mm, other_mm in _both(at.one_mm, at.other_mm)}
    )
    far_mm = far_um(register) // UM_A_MM
    found = [
        Connection(from_mm, to_mm, way_mm)
        for to_mm in sorted({here_mm for here_mm, _there_mm in sides})
        for from_mm, way_mm in _leading_to(to_mm, sides, far_mm)
    ]
    return {Way(f"{number}"): connection for number, connection in enumerate(found)}


def _both(one_mm: int, other_mm: int) -> tuple[tuple[int, int], tuple[int, int]]:
    return (one_mm, other_mm), (other_mm, one_mm)


def _leading_to(to_mm: int, sides: list[tuple[int, int]], far_mm: int) -> list[tuple[int, int]]:
    ahead = sorted((0, there_mm) for here_mm, there_mm in sides if here_mm == to_mm)
    found: list[tuple[int, int]] = []
    while ahead:
        way_mm, from_mm = heappop(ahead)
        if any(abs(other_mm - from_mm) + least_mm <= way_mm for other_mm, least_mm in found):
            continue
        found.append((from_mm, way_mm))
        for here_mm, there_mm in sides:
            on_mm = way_mm + abs(from_mm - here_mm)
            if on_mm <= far_mm and there_mm != to_mm:
                heappush(ahead, (on_mm, there_mm))
    return found
