"""What is claimed of the watch over the train's wholeness (P5, P6)."""

from __future__ import annotations

from kernel.onboard import split as machine
from kernel.onboard.split import Window
from models.onboard import split as world
from models.onboard.split import CYCLE_MS, FASTEST_MM_S2, NO_DIFFERENCES, SAMPLES, Coupled, Watched, magnitude
from proofs.theory import Theory, by_name

# ---- the start


def the_train_was_just_made_up(site: Coupled, system: Watched) -> bool:
    """The watch begins with a whole train, or knows that it has forgotten (P5, T8)."""
    return system.state == machine.made_up(site.limits) or system.state == machine.restarted(site.limits)


def nothing_has_happened(site: Coupled, system: Watched) -> bool:
    """History is empty; a restart counts as a reason for an alarm (P5)."""
    return (
        system.truths_mm_s2 == NO_DIFFERENCES
        and all_are(system.noted_ms, system.now_ms)
        and not system.found
        and not system.shocked
        and system.due == system.state.split
        and not system.disagreed
        and system.unheard_ms == 0
    )


def all_are(window: Window, value: int) -> bool:
    """Tell whether a window holds one value only."""
    a, b, c, d, e, f, g, h, i, j, k, m, n, o, p = window
    return a == b == c == d == e == value and f == g == h == i == j == value and k == m == n == o == p == value


# ---- what is claimed


def split_is_latched(site: Coupled, system: Watched) -> bool:
    """Once found, a split demands the brake, and the train is not intact, until it is made up anew (P5)."""
    return not system.found or (
        machine.demands_emergency_brake(system.state) and not machine.is_intact(site.limits, system.state)
    )


def silent_tail_is_not_intact(site: Coupled, system: Watched) -> bool:
    """A train counts as intact only by a tail measured at most age bound, gap and clock error ago (P5)."""
    return not machine.is_intact(site.limits, system.state) or (
        system.now_ms - system.measured_ms <= site.limits.age_ms + site.clock_error_ms + site.limits.gap_ms
    )


def a_long_silence_is_latched(site: Coupled, system: Watched) -> bool:
    """After a silence in which parts may have come apart and to rest, the train is not intact until made up (P5)."""
    return system.unheard_ms <= site.limits.lost_ms or not machine.is_intact(site.limits, system.state)


def a_lasting_difference_is_found(site: Coupled, system: Watched) -> bool:
    """A true mean difference over threshold and errors, of the 15 telegrams that counted last, is a split (P5).

    `the_window_is_recent` says in what time those 15 came.
    """
    return not world.is_far_over(site, system.truths_mm_s2) or system.state.split


def the_window_is_recent(site: Coupled, system: Watched) -> bool:
    """While the train counts as intact, its 15 telegrams came within 1.5 s and the gap tolerated (P5)."""
    oldest_ms = system.noted_ms[14]
    return not machine.is_intact(site.limits, system.state) or (
        system.now_ms - oldest_ms <= (SAMPLES - 1) * CYCLE_MS + site.limits.gap_ms
    )


def a_shock_is_found(site: Coupled, system: Watched) -> bool:
    """A telegram of a true shock, of the tail or of the difference, beyond limit and errors, is a split (P5)."""
    return not system.shocked or system.state.split


def no_false_alarm(site: Coupled, system: Watched) -> bool:
    """A split is found only where the truth was near a limit, or one faulty sensor showed a shock (P5; service)."""
    return not system.state.split or system.due


def disagreeing_sensors_are_not_intact(site: Coupled, system: Watched) -> bool:
    """While left and right of the newest telegram disagree, the train is not intact (P6)."""
    return not system.disagreed or not machine.is_intact(site.limits, system.state)


def the_window_fits_the_processor(site: Coupled, system: Watched) -> bool:
    """No difference is more than four times the range of a reading, so that no sum overflows (P5)."""
    a, b, c, d, e, f, g, h, i, j, k, m, n, o, p = system.state.differences_mm_s2
    return (
        fits(a)
        and fits(b)
        and fits(c)
        and fits(d)
        and fits(e)
        and fits(f)
        and fits(g)
        and fits(h)
        and fits(i)
        and fits(j)
        and fits(k)
        and fits(m)
        and fits(n)
        and fits(o)
        and fits(p)
    )


def fits(difference_mm_s2: int) -> bool:
    """Tell whether a doubled difference is of readings in range."""
    return magnitude(difference_mm_s2) <= 4 * FASTEST_MM_S2


# ---- what it follows from


def a_long_silence_is_remembered(site: Coupled, system: Watched) -> bool:
    """The machine remembers that it heard nothing for long (P5)."""
    return system.unheard_ms <= site.limits.lost_ms or system.state.lost or system.state.split


def a_silence_is_counted(site: Coupled, system: Watched) -> bool:
    """The time since the newest telegram that counted is at most the time counted as missed (P5)."""
    return system.state.missed_ms >= 0 and system.now_ms - system.noted_ms[0] <= system.state.missed_ms


def what_the_window_shows_is_found(site: Coupled, system: Watched) -> bool:
    """A window that shows a split has been taken for one (P5)."""
    return not machine.shows_split(site.limits, system.state.differences_mm_s2) or system.state.split


def the_newest_is_recent(site: Coupled, system: Watched) -> bool:
    """The newest telegram was measured at most age bound, clock error and missed time ago, once there were 15 (P5)."""
    return system.state.missed_ms > site.limits.gap_ms or (
        system.now_ms - system.measured_ms <= site.limits.age_ms + site.clock_error_ms + system.state.missed_ms
    )


def telegrams_in_a_row_came_in_a_row(site: Coupled, system: Watched) -> bool:
    """The telegrams counted as in a row came one a cycle; the newest of them is not old (P5)."""
    a, b, c, d, e, f, g, h, i, j, k, m, n, o, p = system.noted_ms
    now_ms = system.now_ms
    row = system.state.in_a_row
    return (
        0 <= row <= SAMPLES
        and (row < 1 or now_ms == a)
        and (row < 1 or now_ms - system.measured_ms <= site.limits.age_ms + site.clock_error_ms)
        and (row < 2 or now_ms - b == CYCLE_MS)
        and (row < 3 or now_ms - c == 2 * CYCLE_MS)
        and (row < 4 or now_ms - d == 3 * CYCLE_MS)
        and (row < 5 or now_ms - e == 4 * CYCLE_MS)
        and (row < 6 or now_ms - f == 5 * CYCLE_MS)
        and (row < 7 or now_ms - g == 6 * CYCLE_MS)
        and (row < 8 or now_ms - h == 7 * CYCLE_MS)
        and (row < 9 or now_ms - i == 8 * CYCLE_MS)
        and (row < 10 or now_ms - j == 9 * CYCLE_MS)
        and (row < 11 or now_ms - k == 10 * CYCLE_MS)
        and (row < 12 or now_ms - m == 11 * CYCLE_MS)
        and (row < 13 or now_ms - n == 12 * CYCLE_MS)
        and (row < 14 or now_ms - o == 13 * CYCLE_MS)
        and (row < 15 or now_ms - p == 14 * CYCLE_MS)
    )


def the_window_stretches_by_what_was_missed(site: Coupled, system: Watched) -> bool:
    """Once there were 15 in a row, each telegram of the window is older than its place by missed cycles only (P5)."""
    a, b, c, d, e, f, g, h, i, j, k, m, n, o, p = system.noted_ms
    least_ms = system.now_ms - system.state.missed_ms
    return system.state.missed_ms > site.limits.gap_ms or (
        least_ms <= a
        and least_ms - CYCLE_MS <= b
        and least_ms - 2 * CYCLE_MS <= c
        and least_ms - 3 * CYCLE_MS <= d
        and least_ms - 4 * CYCLE_MS <= e
        and least_ms - 5 * CYCLE_MS <= f
        and least_ms - 6 * CYCLE_MS <= g
        and least_ms - 7 * CYCLE_MS <= h
        and least_ms - 8 * CYCLE_MS <= i
        and least_ms - 9 * CYCLE_MS <= j
        and least_ms - 10 * CYCLE_MS <= k
        and least_ms - 11 * CYCLE_MS <= m
        and least_ms - 12 * CYCLE_MS <= n
        and least_ms - 13 * CYCLE_MS <= o
        and least_ms - 14 * CYCLE_MS <= p
    )


def every_difference_is_near_the_truth(site: Coupled, system: Watched) -> bool:
    """Each difference in the window is within the errors of the truth behind it (P5, P6)."""
    a, b, c, d, e, f, g, h, i, j, k, m, n, o, p = system.state.differences_mm_s2
    aa, bb, cc, dd, ee, ff, gg, hh, ii, jj, kk, mm, nn, oo, pp = system.truths_mm_s2
    error = world.doubled_error_mm_s2(site)
    return (
        -error <= a - 2 * aa <= error
        and -error <= b - 2 * bb <= error
        and -error <= c - 2 * cc <= error
        and -error <= d - 2 * dd <= error
        and -error <= e - 2 * ee <= error
        and -error <= f - 2 * ff <= error
        and -error <= g - 2 * gg <= error
        and -error <= h - 2 * hh <= error
        and -error <= i - 2 * ii <= error
        and -error <= j - 2 * jj <= error
        and -error <= k - 2 * kk <= error
        and -error <= m - 2 * mm <= error
        and -error <= n - 2 * nn <= error
        and -error <= o - 2 * oo <= error
        and -error <= p - 2 * pp <= error
    )


INITIAL = (the_train_was_just_made_up, nothing_has_happened)
PREMISES = (world.limits_are_not_negative, world.errors_are_not_negative)
SAFETY = (
    split_is_latched,
    silent_tail_is_not_intact,
    a_long_silence_is_latched,
    a_lasting_difference_is_found,
    the_window_is_recent,
    a_shock_is_found,
    disagreeing_sensors_are_not_intact,
    no_false_alarm,
    the_window_fits_the_processor,
)
INVARIANTS = (
    *SAFETY,
    a_long_silence_is_remembered,
    a_silence_is_counted,
    what_the_window_shows_is_found,
    the_newest_is_recent,
    telegrams_in_a_row_came_in_a_row,
    the_window_stretches_by_what_was_missed,
    every_difference_is_near_the_truth,
)

THEORY = Theory(
    "split",
    Coupled,
    Watched,
    by_name((world.run_a_cycle, world.make_up, world.restart)),
    by_name(INITIAL),
    by_name(INVARIANTS),
    by_name(SAFETY),
    by_name(PREMISES),
)
