"""A branch on the register: which trains run on to it, and how far along the track from one of its places (A1).

Places are told along a train's or worker's own route: up to the junction that of the line, and from there on either the
line or the branch, whichever he or it is on.  Tunnels lie before the junction, and sections there or on the line.
"""

from __future__ import annotations

from typing import Any

from models.alarm.faults import KIND
from models.alarm.line import REGULAR
from models.compiled import compiled

BRANCHES = KIND["branches"]
NOWHERE_M = 10_000_000.0
"""In the place of what is not there: no way is so long."""


@compiled(forceinline=True)
def junction_m(day: Any) -> float:
    """Give where a branch leaves the line; far beyond everything where none does."""
    return float(abs(day.size[BRANCHES])) if day.begin_s[BRANCHES] >= 0 else NOWHERE_M


@compiled(forceinline=True)
def is_of_the_branch(day: Any, train: int) -> bool:
    """Tell whether a train runs between the branch and the line: every other pair of regular trains."""
    return bool(day.begin_s[BRANCHES] >= 0 and train < REGULAR and train // 2 % 2 == 1)


@compiled(forceinline=True)
def is_apart(day: Any, train: int, worker_m: float) -> bool:
    """Tell whether the worker is beyond the junction, on the other route than a train's."""
    return bool(worker_m > junction_m(day) and is_of_the_branch(day, train) != day.on_branch)


@compiled(forceinline=True)
def is_on_the_branch(day: Any, worker_m: float) -> bool:
    """Tell whether the worker is beyond the junction, and not on the line."""
    return bool(day.on_branch and worker_m > junction_m(day))


@compiled(forceinline=True)
def from_line_m(day: Any, worker_m: float, place_m: float) -> float:
    """Give how far the worker is from a place of the line, along the track."""
    if is_on_the_branch(day, worker_m) and place_m > junction_m(day):
        return float(worker_m + place_m - 2.0 * junction_m(day))
    return float(abs(worker_m - place_m))
