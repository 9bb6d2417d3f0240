"""Every theory, and the rows of the matrix that they make together.

A row is named after its transition; those of other theories than the interlocking have the theory's
name in front, ``odometry.run_a_cycle``.
"""

from __future__ import annotations

from collections.abc import Mapping

from proofs.alarm import alarm_distance, alarm_network, alarm_tone
from proofs.catalogue import INTERLOCKING
from proofs.crossing import arrival, crossing, due, end_point, promise, ranging_schedule, start_point
from proofs.onboard import (
    antenna_spacing,
    brake_demand,
    brake_watch,
    braking,
    feature,
    joint,
    link,
    occupancy,
    odometry,
    reverse_movement,
    speed_limit,
    split,
    tag_fix,
    tag_reader,
    tag_window,
    train,
    train_length,
)
from proofs.theory import READING, START, Theory
from proofs.tram import cycle, dispatching, display, map_matching, stopping

IN_ORDER: tuple[Theory, ...] = (
    INTERLOCKING,
    odometry.THEORY,
    braking.THEORY,
    brake_watch.THEORY,
    reverse_movement.THEORY,
    brake_demand.THEORY,
    joint.THEORY,
    occupancy.THEORY,
    speed_limit.THEORY,
    split.THEORY,
    link.THEORY,
    train_length.THEORY,
    tag_reader.THEORY,
    tag_fix.THEORY,
    tag_window.THEORY,
    antenna_spacing.THEORY,
    feature.THEORY,
    train.THEORY,
    alarm_distance.THEORY,
    alarm_network.THEORY,
    alarm_tone.THEORY,
    arrival.THEORY,
    dispatching.THEORY,
    display.THEORY,
    map_matching.THEORY,
    stopping.THEORY,
    cycle.THEORY,
    due.THEORY,
    promise.THEORY,
    ranging_schedule.THEORY,
    start_point.THEORY,
    end_point.THEORY,
    crossing.THEORY,
)
"""The theories, in the order of the matrix."""

THEORIES: Mapping[str, Theory] = {theory.name: theory for theory in IN_ORDER}
"""The theories by name."""


def row_of(theory: Theory, name: str) -> str:
    """Name a row of the whole matrix."""
    return name if theory is INTERLOCKING else f"{theory.name}.{name}"


def theory_of(row: str) -> tuple[Theory, str]:
    """Give the theory of a row, and the name of the row within it."""
    theory, _, name = row.rpartition(".")
    return THEORIES[theory or INTERLOCKING.name], name


ROWS: tuple[str, ...] = tuple(row_of(theory, name) for theory in THEORIES.values() for name in theory.rows)
"""Every row of the matrix, in order."""


def columns(row: str) -> list[str]:
    """Give the columns of a row, in order."""
    theory, name = theory_of(row)
    return theory.columns(name)


def is_transition(row: str) -> bool:
    """Tell whether a row is a transition's: neither a start nor the reading of predicates."""
    return theory_of(row)[1] not in (START, READING)
