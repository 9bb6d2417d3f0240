"""The words of what a train's sensors say, within an event."""

from __future__ import annotations

from dataclasses import fields
from typing import Any

from fuzz.traffic.compiling import compiled
from kernel.standstill import Standstill, ThroughLine

STANDSTILL_WORDS, LINE_WORDS = len(fields(Standstill)), len(fields(ThroughLine))
"""The words of `Standstill` and of `ThroughLine`."""


@compiled
def put_standstill(memory: Any, at: Any, known: Any) -> None:
    """Write that the train stands, held, with its front at 0; ``known``: whether the odometry claims a range."""
    memory[at] = known
    for word in range(1, STANDSTILL_WORDS):
        memory[at + word] = 0


@compiled
def put_line(memory: Any, at: Any, healthy: Any) -> None:
    """Write what line, split detection and spacing say of the way to the tail, all the same."""
    for word in range(LINE_WORDS):
        memory[at + word] = healthy


@compiled
def put_standing(memory: Any, desk_event: Any, run: Any, known: Any, first_mm: Any, second_mm: Any) -> None:
    """Write an event of a train that stands, as far as it knows its place, with two places that it is told."""
    memory[desk_event] = run
    put_standstill(memory, desk_event + 1, known)
    memory[desk_event + 1 + STANDSTILL_WORDS] = first_mm
    memory[desk_event + 2 + STANDSTILL_WORDS] = second_mm


@compiled
def put_stopped(memory: Any, desk_event: Any, run: Any, known: Any) -> None:
    """Write the event that a train stands with its front inside its destination, as far as it knows its place."""
    put_standing(memory, desk_event, run, known, 0, 0)
