"""Whether a fault of the day is there at some second (A1)."""

from __future__ import annotations

from typing import Any

from models.compiled import compiled


@compiled(forceinline=True)
def is_on(day: Any, kind: int, second: int) -> bool:
    """Tell whether a fault of the handset, the display or the network is there."""
    return bool(0 <= day.begin_s[kind] <= second < day.end_s[kind])


@compiled(forceinline=True)
def is_of(day: Any, kind: int, train: int, second: int) -> bool:
    """Tell whether a fault of this train is there."""
    return day.train[kind] == train and is_on(day, kind, second)
