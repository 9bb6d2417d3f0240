"""The driver's cab: what its machines know of the train, and the lever of its brake."""

from __future__ import annotations

from kernel.onboard.braking import Brake, BrakeBounds, withhold_end
from kernel.onboard.odometry import Loss, Motion
from kernel.standstill import Standstill
from tests.independent.world.sight import Sight

BOUNDS = BrakeBounds(
    gains_mm_s2=1_000, slows_mm_s2=1_000, response_cycles=8, standstill_mm_s=100, cut_cycles=5, falls_mm_s2=200
)
"""A brake of 1 m/s² within 0.8 s, and motors as strong."""


def standstill(sight: Sight, brake: Brake) -> Standstill:
    """What odometry and brake say of front, speed, for how long the brake has been on, and until when it is."""
    front_least_mm, front_most_mm = sight.front_mm
    return Standstill(
        known=True,
        front_least_mm=front_least_mm,
        front_most_mm=front_most_mm,
        speed_least_mm_s=sight.speed_mm_s,
        speed_most_mm_s=sight.speed_mm_s,
        standstill_mm_s=0,
        braked_cycles=sight.braked_cycles,
        response_cycles=BOUNDS.response_cycles,
        releasable=not brake.withheld,
    )


def moving(least_mm: int, most_mm: int, speed_mm_s: int) -> Motion:
    """What the odometry knows of a train between these places, at this speed."""
    return Motion(least_mm, most_mm, speed_mm_s, speed_mm_s, least_mm, most_mm, 0, 0, 0, False, 0, 0, Loss.NONE)


def put_on(brake: Brake, sight: Sight) -> Brake:
    """The driver of a train at rest puts the brake on, and waits until it holds."""
    if not sight.at_rest:
        return brake
    sight.wait_braked()
    return withhold_end(brake)
