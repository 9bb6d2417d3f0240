"""The machines on board, whatever they come to know, and the brake that they demand (T5, T12, P5)."""

from __future__ import annotations

from dataclasses import dataclass

from kernel.onboard import brake_demand
from kernel.onboard.brake_demand import Known, TrainLimits
from kernel.onboard.braking import Brake


@dataclass(frozen=True)
class Train:
    """What does not change: what is written for the train (T12)."""

    limits: TrainLimits


@dataclass(frozen=True)
class Deciding:
    """One moment of the unit.

    ``known``, ``may_proceed``, ``acknowledged``: history: what it last decided by.
    ``was_applied``: history: whether the brake was applied before that.
    ``brake``: what the brake control knows.
    """

    known: Known
    may_proceed: bool
    acknowledged: bool
    was_applied: bool
    brake: Brake


def decide(site: Train, system: Deciding, known: Known, may_proceed: bool, acknowledged: bool) -> Deciding:
    """The machines come to know anything at all, and the unit decides on the brake (T12)."""
    return Deciding(
        known=known,
        may_proceed=may_proceed,
        acknowledged=acknowledged,
        was_applied=system.brake.applied,
        brake=brake_demand.decide(site.limits, system.brake, known, may_proceed, acknowledged),
    )
