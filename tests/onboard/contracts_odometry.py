"""Contracts on the odometry for CrossHair (`make crosshair`): leading asserts assume, later ones claim."""

from __future__ import annotations

from dataclasses import replace

from kernel.onboard.odometry import (
    Loss,
    Readings,
    agrees,
    is_located,
    located,
    most_mm_s2,
    note_cycle,
    note_fix,
    tachometer_speaks,
)
from proofs.onboard.witnesses.rolling_stock import BOUNDS

ROLLING = replace(
    located(0, 0, 1_000), trusted=True, tachometer_mm_s=10_000, speed_least_mm_s=9_879, speed_most_mm_s=10_121
)


def an_irregular_cycle_loses_the_range(elapsed_ms: int) -> None:
    """Anything but a lawful cycle, for ever (P1, P7)."""
    assert not 98 <= elapsed_ms <= 102
    lost = note_cycle(BOUNDS, ROLLING, Readings(elapsed_ms, True, 10_000, 2_000, True, 0))
    assert lost.loss == Loss.CYCLE_IRREGULAR
    assert note_cycle(BOUNDS, lost, Readings(100, True, 10_000, 2_000, True, 0)) == lost
    assert note_fix(lost, -1, 1) == lost


def a_tachometer_out_of_range_does_not_speak(tachometer_mm_s: int, way_mm: int) -> None:
    """Too fast either way, or pulses that jump either way (P1)."""
    assert not -200_000 <= tachometer_mm_s <= 200_000 or not -19_000 <= way_mm <= 21_000
    readings = Readings(100, True, tachometer_mm_s, way_mm, True, 0)
    assert not tachometer_speaks(BOUNDS, ROLLING, readings)
    assert not agrees(BOUNDS, ROLLING, readings)


def an_inertial_sensor_out_of_range_leaves_what_the_motors_can(inertial_mm_s2: int) -> None:
    """Its number is not used (P1)."""
    assert inertial_mm_s2 > 1_600 or inertial_mm_s2 < -2_200
    assert most_mm_s2(BOUNDS, ROLLING, Readings(100, True, 0, 0, True, inertial_mm_s2)) == 1_200


def a_difference_of_the_threshold_is_a_slip(inertial_mm_s2: int) -> None:
    """T_a or more (P1)."""
    assert inertial_mm_s2 >= 400 or inertial_mm_s2 <= -400
    assert not agrees(BOUNDS, ROLLING, Readings(100, True, 10_000, 2_000, True, inertial_mm_s2))


def a_wheel_that_agrees_is_rolled_on(tachometer_mm_s: int) -> None:
    """The range of speeds is around what the wheel shows (P1)."""
    assert 9_980 <= tachometer_mm_s <= 10_020
    after = note_cycle(BOUNDS, ROLLING, Readings(100, True, tachometer_mm_s, 2_000, True, 0))
    assert after.trusted
    assert after.speed_least_mm_s < tachometer_mm_s < after.speed_most_mm_s
    assert after.front_most_mm - after.front_least_mm == 2 * (10 + 1 + 30)


def a_fix_narrows_or_contradicts(least_mm: int, most_mm: int) -> None:
    """Never wider, and within the fix while a range is claimed (P7)."""
    assert least_mm <= most_mm
    wide = replace(ROLLING, front_least_mm=-100, front_most_mm=100)
    after = note_fix(wide, least_mm, most_mm)
    assert is_located(after) == (most_mm >= -100 and least_mm <= 100)
    assert -100 <= after.front_least_mm <= after.front_most_mm <= 100
    assert not is_located(after) or least_mm <= after.front_least_mm <= after.front_most_mm <= most_mm


def trust_takes_ten_cycles(agreed_cycles: int) -> None:
    """And not one less (P1)."""
    assert 0 <= agreed_cycles <= 9
    gliding = replace(ROLLING, trusted=False, agreed_cycles=agreed_cycles)
    after = note_cycle(BOUNDS, gliding, Readings(100, True, 10_000, 2_000, True, 0))
    assert after.trusted == (agreed_cycles == 9)
    assert after.agreed_cycles == agreed_cycles + 1
