"""What sensors in order say in a world that knows blocks and no millimetres: each front is at 0."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

from kernel.standstill import Standstill, ThroughLine

AT_REST = Standstill(
    known=True,
    front_least_mm=0,
    front_most_mm=0,
    speed_least_mm_s=0,
    speed_most_mm_s=0,
    standstill_mm_s=0,
    braked_cycles=0,
    response_cycles=0,
    releasable=False,
)
"""A train that stands, held by its brake until an end of authority is taken."""
ROLLING = replace(AT_REST, speed_most_mm_s=1)
"""One that may be under way."""
NOT_HELD = replace(AT_REST, response_cycles=1)
"""One that stands, while its brake still takes hold, or is off."""
RELEASABLE = replace(AT_REST, releasable=True)
"""One that is held, and could run under an end that it has taken."""
INSIDE: Mapping[str, Any] = {"at": AT_REST, "begin_mm": 0, "end_mm": 0}
"""One that stands with its front inside its destination: what `note_stopped` is told."""
ON_THE_WAY: Mapping[str, Any] = {"at": AT_REST, "begin_mm": 1, "end_mm": 1}
BEYOND: Mapping[str, Any] = {"at": AT_REST, "begin_mm": -1, "end_mm": -1}
"""One that stands short of it, and one that stands beyond it."""
WHOLE = ThroughLine(answers=True, is_intact=True, fits=True)
BROKEN = ThroughLine(answers=False, is_intact=True, fits=True)
"""The through line of a whole train, and of one that has lost cars or whose line is broken."""
