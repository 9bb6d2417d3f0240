"""A driver who keeps to what the cab shows, and the train that does as he asks, within its powers.

The cab shows how fast the train may be where it is, so that the brake control would not yet come on; the driver stays
a little below it.
"""

from __future__ import annotations

from math import sqrt

from kernel.onboard.arithmetic import CYCLE_MS
from kernel.onboard.braking import BrakeBounds
from kernel.onboard.odometry import Motion
from models.rides.plan import PLAN

LINE_MM_S = 27_800.0
"""100 km/h."""
ACCELERATES_MM_S2, BRAKES_MM_S2, EMERGENCY_MM_S2 = 700.0, 900.0, 1_100.0
COMFORT_MM_S2 = 450.0
"""How the driver brakes towards where he wants to stop."""
JERK_MM_S3 = 1_000.0
EMERGENCY_JERK_MM_S3 = 1_500.0
BELOW_MM_S = 1_500.0
"""So much below what the cab shows."""
CREEPS_MM_S = 1_000.0
"""He stops where the cab lets him go no faster than this: what it shows falls as he nears it, and he would go on ever
more slowly, and come to rest after minutes."""
NEAR_MM = 400.0
CYCLE_S = CYCLE_MS / 1_000


def shown_mm_s(bounds: BrakeBounds, motion: Motion, place_mm: int, to_mm_s: int) -> float:
    """The speed that the cab shows for the sake of a place from which on the train is to be so slow, or to stand.

    Above it the brake control would come on.
    """
    left_mm = max(0, place_mm - motion.front_most_mm)
    lost_mm_s = (bounds.response_cycles + 2) * CYCLE_S * bounds.slows_mm_s2
    worst = sqrt(lost_mm_s * lost_mm_s + 2 * bounds.slows_mm_s2 * left_mm + to_mm_s * to_mm_s) - lost_mm_s
    return max(0.0, max(worst, float(to_mm_s)) - (bounds.response_cycles + 1) * CYCLE_S * bounds.gains_mm_s2)


def is_barred(shown: float) -> bool:
    """Tell whether the cab shows the driver that he is to stop."""
    return shown - BELOW_MM_S <= CREEPS_MM_S


def asked_mm_s2(speed_mm_s: float, to_stop_mm: float, shown: float) -> float:
    """What the driver asks of the train: so far it is to where he wants to stop."""
    curve = sqrt(2 * COMFORT_MM_S2 * max(0.0, to_stop_mm))
    limit = min(LINE_MM_S, shown - BELOW_MM_S, curve)
    if to_stop_mm <= NEAR_MM or shown - BELOW_MM_S <= CREEPS_MM_S:
        return -BRAKES_MM_S2
    falls = COMFORT_MM_S2 if limit < LINE_MM_S and speed_mm_s > limit - 500 else 0.0
    return max(-BRAKES_MM_S2, min(ACCELERATES_MM_S2, limit - speed_mm_s - falls))


def gained_mm_s2(before: float, asked: float, emergency: bool) -> float:
    """What the train does in the next cycle: what is asked, as fast as a jerk allows."""
    if emergency:
        return max(-EMERGENCY_MM_S2, before - EMERGENCY_JERK_MM_S3 * CYCLE_S)
    step = JERK_MM_S3 * CYCLE_S
    return max(before - step, min(before + step, asked))


def margin_mm(motion: Motion) -> float:
    """How far before an end of authority a train comes to rest that its brake control lets run there at all."""
    reserve = (PLAN.brake.response_cycles + 1) * CYCLE_S * PLAN.brake.gains_mm_s2 + BELOW_MM_S
    way = (PLAN.brake.response_cycles + 2) * CYCLE_S * reserve + reserve * reserve / (2 * PLAN.brake.slows_mm_s2)
    return way + (motion.front_most_mm - motion.front_least_mm) / 2
