"""A train that may come apart, the accelerations of its head and tail, and the machine that watches (P5, P6).

Accelerations are in mm/s², along the track, as sensors should show them: gravity taken out as far as the
written limits say.  Times are by a clock that is right, GPS time.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

from kernel.onboard import split as machine
from kernel.onboard.split import Acceleration, Readings, Split, SplitLimits, Window

CYCLE_MS = 100
"""Paper 001, table 2: sampled every 100 ms."""
SAMPLES = 15
"""Paper 001, 4.3.3: the moving average of 1.5 s, at a sample in every 100 ms."""
FASTEST_MM_S2 = 100_000
"""Sensors show accelerations to 100 m/s²; what is beyond is no reading (ours)."""
NO_DIFFERENCES: Window = (0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0)


@dataclass(frozen=True)
class Coupled:
    """What does not change (P5).

    ``limits``: as written.
    ``head_error_mm_s2``, ``tail_error_mm_s2``: how far a sound sensor may be from the truth.
    ``clock_error_ms``: how much older a telegram may be than it looks.
    """

    limits: SplitLimits
    head_error_mm_s2: int
    tail_error_mm_s2: int
    clock_error_ms: int


@dataclass(frozen=True)
class Watched:
    """One moment of a train and its watch.

    ``now_ms``: by a right clock.
    ``state``: what the machine knows.
    The rest is history, since the train was made up; windows also begin anew when the unit restarts.
    ``truths_mm_s2``: the true differences, head less tail, behind the 15 telegrams that counted last.
    ``noted_ms``: when each of them counted; ``measured_ms``: when the tail measured the newest.
    ``found``: a split was found.  ``shocked``: the truth showed more than shock limit and errors.
    ``due``: the truth, or one faulty sensor, came near enough a limit for an alarm.
    ``disagreed``: left and right disagreed in the newest telegram.
    ``unheard_ms``: the longest time without a telegram that counted.
    """

    now_ms: int
    state: Split
    truths_mm_s2: Window
    noted_ms: Window
    measured_ms: int
    found: bool
    shocked: bool
    due: bool
    disagreed: bool
    unheard_ms: int


# ---- premises


def limits_are_not_negative(site: Coupled) -> bool:
    """No limit is below zero (P5)."""
    return (
        site.limits.threshold_mm_s2 >= 0
        and site.limits.shock_mm_s2 >= 0
        and site.limits.disagreement_mm_s2 >= 0
        and site.limits.gap_ms >= 0
        and site.limits.lost_ms >= 0
    )


def errors_are_not_negative(site: Coupled) -> bool:
    """No error bound is below zero (P5, P6)."""
    return site.head_error_mm_s2 >= 0 and site.tail_error_mm_s2 >= 0


# ---- arithmetic


def magnitude(value: int) -> int:
    """Give a value without its sign."""
    return value if value >= 0 else -value


def longer(one: int, other: int) -> int:
    """Give the longer of two times."""
    return one if one >= other else other


def moved_up(window: Window, newest: int) -> Window:
    """Put the newest of 15 in front, and leave the oldest out."""
    a, b, c, d, e, f, g, h, i, j, k, m, n, o, _ = window
    return (newest, a, b, c, d, e, f, g, h, i, j, k, m, n, o)


def added_up(window: Window) -> int:
    """Add up all 15."""
    a, b, c, d, e, f, g, h, i, j, k, m, n, o, p = window
    return a + b + c + d + e + f + g + h + i + j + k + m + n + o + p


# ---- what a telegram is worth


def gives_a_number(sensor: Acceleration) -> bool:
    """Tell whether a sensor says that it has a reading, and the reading can be one."""
    return sensor.valid and -FASTEST_MM_S2 <= sensor.mm_s2 <= FASTEST_MM_S2


def can_be_compared(site: Coupled, readings: Readings) -> bool:
    """Tell whether a telegram has come that is not too old, of sensors that all give numbers, left as right (P6)."""
    return (
        readings.arrived
        and 0 <= readings.age_ms <= site.limits.age_ms
        and gives_a_number(readings.head)
        and gives_a_number(readings.left)
        and gives_a_number(readings.right)
        and not left_and_right_disagree(site, readings)
    )


def left_and_right_disagree(site: Coupled, readings: Readings) -> bool:
    """Tell whether the tail's two sensors differ by more than is written (P6)."""
    return magnitude(readings.left.mm_s2 - readings.right.mm_s2) > site.limits.disagreement_mm_s2


# ---- assumptions


def is_near(error_mm_s2: int, true_mm_s2: int, sensor: Acceleration) -> bool:
    """Tell whether a sensor is sound: it says that it has no reading, or is within its error (P5)."""
    return not sensor.valid or magnitude(sensor.mm_s2 - true_mm_s2) <= error_mm_s2


def the_head_is_measured_within_its_error(site: Coupled, system: Watched, head_mm_s2: int, readings: Readings) -> bool:
    """The head's acceleration is within its error: fail-safe processor, and two sensors compared there (P1, P5)."""
    return is_near(site.head_error_mm_s2, head_mm_s2, readings.head)


def one_tail_sensor_is_sound(site: Coupled, system: Watched, tail_mm_s2: int, readings: Readings) -> bool:
    """Left or right is within its error: one may fail in any manner, but not both before it is mended (P6).

    A multiple unit's tail processor compares its own sensors and sends one value; it is fail-safe.
    """
    return (
        not readings.arrived
        or is_near(site.tail_error_mm_s2, tail_mm_s2, readings.left)
        or is_near(site.tail_error_mm_s2, tail_mm_s2, readings.right)
    )


def a_telegram_is_hardly_older_than_it_looks(
    site: Coupled, system: Watched, measured_ms: int, readings: Readings
) -> bool:
    """Its age is told by GPS time on both ends, within the clocks' error (paper 001, 3.3 and 4.1; P5)."""
    return not readings.arrived or system.now_ms + CYCLE_MS - measured_ms <= readings.age_ms + site.clock_error_ms


# ---- how far from the truth a difference may be


def doubled_error_mm_s2(site: Coupled) -> int:
    """Give twice the error of a difference that counts: both sensors', and what may hide in a disagreement (P6)."""
    return 2 * site.head_error_mm_s2 + 2 * site.tail_error_mm_s2 + site.limits.disagreement_mm_s2


def is_far_over(site: Coupled, truths_mm_s2: Window) -> bool:
    """Tell whether the mean true difference is over the threshold by more than the errors (P5)."""
    return 2 * magnitude(added_up(truths_mm_s2)) > SAMPLES * (
        2 * site.limits.threshold_mm_s2 + doubled_error_mm_s2(site)
    )


def is_about_over(site: Coupled, truths_mm_s2: Window) -> bool:
    """Tell whether the mean true difference is over the threshold, or below by no more than the errors (P5)."""
    return 2 * magnitude(added_up(truths_mm_s2)) > SAMPLES * (
        2 * site.limits.threshold_mm_s2 - doubled_error_mm_s2(site)
    )


def is_shaken(site: Coupled, tail_mm_s2: int, sensor: Acceleration) -> bool:
    """Tell whether a sound sensor with a reading is shaken by more than shock limit and error (P5)."""
    return (
        sensor.valid
        and is_near(site.tail_error_mm_s2, tail_mm_s2, sensor)
        and magnitude(tail_mm_s2) > site.limits.shock_mm_s2 + site.tail_error_mm_s2
    )


def may_be_shaken(site: Coupled, tail_mm_s2: int, sensor: Acceleration) -> bool:
    """Tell whether a sensor may show a shock: the truth is about one, or it is faulty and shows one (P5)."""
    return sensor.valid and (
        magnitude(tail_mm_s2) > site.limits.shock_mm_s2 - site.tail_error_mm_s2
        or (
            not is_near(site.tail_error_mm_s2, tail_mm_s2, sensor) and magnitude(sensor.mm_s2) > site.limits.shock_mm_s2
        )
    )


def shock_was_there(site: Coupled, head_mm_s2: int, tail_mm_s2: int, readings: Readings) -> bool:
    """Tell whether a telegram has come of a true shock beyond limit and errors (P5)."""
    return readings.arrived and (
        is_shaken(site, tail_mm_s2, readings.left)
        or is_shaken(site, tail_mm_s2, readings.right)
        or (
            can_be_compared(site, readings)
            and 2 * magnitude(head_mm_s2 - tail_mm_s2) > 2 * site.limits.shock_mm_s2 + doubled_error_mm_s2(site)
        )
    )


def shock_may_be_seen(site: Coupled, head_mm_s2: int, tail_mm_s2: int, readings: Readings) -> bool:
    """Tell whether a telegram may be taken for a shock (P5)."""
    return readings.arrived and (
        may_be_shaken(site, tail_mm_s2, readings.left)
        or may_be_shaken(site, tail_mm_s2, readings.right)
        or (
            can_be_compared(site, readings)
            and 2 * magnitude(head_mm_s2 - tail_mm_s2) > 2 * site.limits.shock_mm_s2 - doubled_error_mm_s2(site)
        )
    )


# ---- what happens


def run_a_cycle(
    site: Coupled, system: Watched, head_mm_s2: int, tail_mm_s2: int, measured_ms: int, readings: Readings
) -> Watched:
    """A cycle passes; a telegram of the tail may have come (P5, P6).

    The head accelerates as it does now, the tail as it did when the telegram was measured: whole or
    apart, at will.  How many telegrams come, how late and with which values is not limited but by the
    three assumptions.
    """
    if not the_head_is_measured_within_its_error(site, system, head_mm_s2, readings):
        return system
    if not one_tail_sensor_is_sound(site, system, tail_mm_s2, readings):
        return system
    if not a_telegram_is_hardly_older_than_it_looks(site, system, measured_ms, readings):
        return system
    counted = can_be_compared(site, readings)
    now_ms = system.now_ms + CYCLE_MS
    state = machine.note_cycle(site.limits, system.state, readings)
    truths_mm_s2 = moved_up(system.truths_mm_s2, head_mm_s2 - tail_mm_s2) if counted else system.truths_mm_s2
    noted_ms = moved_up(system.noted_ms, now_ms) if counted else system.noted_ms
    return Watched(
        now_ms=now_ms,
        state=state,
        truths_mm_s2=truths_mm_s2,
        noted_ms=noted_ms,
        measured_ms=measured_ms if counted else system.measured_ms,
        found=system.found or state.split,
        shocked=system.shocked or shock_was_there(site, head_mm_s2, tail_mm_s2, readings),
        due=system.due
        or is_about_over(site, truths_mm_s2)
        or shock_may_be_seen(site, head_mm_s2, tail_mm_s2, readings),
        disagreed=left_and_right_disagree(site, readings) if readings.arrived else system.disagreed,
        unheard_ms=longer(system.unheard_ms, now_ms - noted_ms[0]),
    )


def make_up(site: Coupled, system: Watched) -> Watched:
    """Staff makes the train up, finds it whole, and resets the watch; supervised (P5)."""
    return replace(
        begun(site, system),
        state=machine.made_up(site.limits),
        found=False,
        shocked=False,
        due=False,
        disagreed=False,
        unheard_ms=0,
    )


def restart(site: Coupled, system: Watched) -> Watched:
    """The unit restarts; what was found before is still to be known (P5, T8)."""
    return replace(begun(site, system), state=machine.restarted(site.limits), due=True)


def begun(site: Coupled, system: Watched) -> Watched:
    """Begin the windows of history anew, now."""
    now_ms = system.now_ms
    return replace(
        system,
        truths_mm_s2=NO_DIFFERENCES,
        noted_ms=(
            now_ms,
            now_ms,
            now_ms,
            now_ms,
            now_ms,
            now_ms,
            now_ms,
            now_ms,
            now_ms,
            now_ms,
            now_ms,
            now_ms,
            now_ms,
            now_ms,
            now_ms,
        ),
    )
