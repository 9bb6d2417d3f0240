"""Who demands the emergency brake: every machine on board that finds the train unsafe, in one place (T5, T12, P5).

A host hands in what the machines know, and nothing that it has judged itself but what the unit's orders
say of its run.
"""

from __future__ import annotations

from dataclasses import dataclass

from kernel.onboard import braking, ceiling
from kernel.onboard.brake_watch import BrakeWatch
from kernel.onboard.braking import Brake, BrakeBounds
from kernel.onboard.ceiling import Ceiling
from kernel.onboard.odometry import Motion, is_located, rear_least_mm
from kernel.onboard.restriction_ahead import Ahead, is_too_fast
from kernel.onboard.reverse_movement import Movement
from kernel.onboard.speed_limit import SpeedLimit, SpeedTable, is_overspeed
from kernel.onboard.split import Split, demands_emergency_brake
from kernel.onboard.tag_window import Window


@dataclass(frozen=True)
class TrainLimits:
    """What is written for the train and its line, and the length that is reckoned with (T12, P4)."""

    brake: BrakeBounds
    speeds: SpeedTable
    length_mm: int


@dataclass(frozen=True)
class Known:
    """What the machines on board know at the end of a cycle.

    ``motion``: the odometry's, and ``watch``, ``movement``, ``limit``, ``wholeness``, ``window``, ``ahead`` others'.
    ``ceiling``: what it has promised to keep to.
    """

    motion: Motion
    watch: BrakeWatch
    movement: Movement
    limit: SpeedLimit
    wholeness: Split
    window: Window
    ahead: Ahead
    ceiling: Ceiling


def is_demanded(limits: TrainLimits, known: Known, may_proceed: bool) -> bool:
    """Tell whether anything wants the emergency brake (T5, T12, P5).

    A broken bound of motors or brake, reverse movement, an overspeed, which a train with a lost position may
    always have, a restriction ahead that is near, a ceiling that is, a split, an overdue tag, or an order that does not
    let the train proceed: ``kernel.authority.may_proceed`` for its run.
    """
    motion = known.motion
    return (
        known.watch.broken
        or known.movement.reversed
        or is_overspeed(
            limits.speeds,
            known.limit,
            is_located(motion),
            rear_least_mm(motion, limits.length_mm),
            motion.speed_most_mm_s,
        )
        or is_too_fast(limits.brake, limits.speeds, known.ahead, motion.front_most_mm, motion.speed_most_mm_s)
        or not ceiling.is_kept(limits.brake, known.ceiling, motion.speed_most_mm_s)
        or demands_emergency_brake(known.wholeness)
        or known.window.passed
        or not may_proceed
    )


def decide(limits: TrainLimits, brake: Brake, known: Known, may_proceed: bool, acknowledged: bool) -> Brake:
    """Decide on the brake for the cycle that begins, by all that is known (T12)."""
    motion = known.motion
    return braking.supervise(
        limits.brake,
        brake,
        motion.front_most_mm,
        motion.speed_least_mm_s,
        motion.speed_most_mm_s,
        is_demanded(limits, known, may_proceed),
        acknowledged,
    )
