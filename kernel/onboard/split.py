"""Split detection: the accelerations of head and tail differ, or a shock, or the tail is not heard (P5, P6).

The vehicles of a train move as one, so head and tail accelerate alike (paper 001, 3.4).  In every cycle
the head's acceleration is compared with the tail's newest telegram; the difference is averaged over
1.5 s, as 15 samples.  Sums are compared instead of means, and everything is doubled, since the tail's
acceleration is the mean of two sensors: nothing is divided, so nothing is rounded.

Two parts that accelerate alike, coasting or standing, are invisible to it: then the tail's tags or
the through line must catch the split.

Ours, since the paper is silent: a cycle without a telegram adds nothing to the window, so that no old
value hides a split, and such cycles are counted: few of them are tolerated, or the 15 samples would
stretch over a long time.  After many, the parts may have come apart and stand still, alike again; so
that is latched too.  Nothing latched ends but by a supervised making up of the train.

Ranges of readings: accelerations to 100 m/s²; what is beyond is no reading (of the tail: a shock).
"""

from __future__ import annotations

from dataclasses import dataclass, replace

from kernel.onboard.arithmetic import CYCLE_MS, magnitude, smaller

SAMPLES = 15
"""The moving average of 1.5 s, in cycles (paper 001, 4.3.3)."""
GREATEST_ACCELERATION_MM_S2 = 100_000

Window = tuple[int, int, int, int, int, int, int, int, int, int, int, int, int, int, int]
"""The last 15 values, the newest first."""

EMPTY: Window = (0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0)


@dataclass(frozen=True)
class SplitLimits:
    """The written limits; each is 0 or more (P5, P6).

    ``threshold_mm_s2``: the most that the mean difference of a whole train's head and tail may be.  It
    covers the sensors' errors, coupler play, other gradients under the head than under the tail, and
    how the acceleration changes while a telegram is under way.
    ``shock_mm_s2``: the most that a whole train's tail, or one single difference, may show.
    ``disagreement_mm_s2``: the most that left and right sensor may differ.
    ``age_ms``: the most that a telegram's measurement may lie back.
    ``gap_ms``: for how long telegrams may be missing while the train counts as intact.
    ``lost_ms``: for how long before it is latched.
    """

    threshold_mm_s2: int
    shock_mm_s2: int
    disagreement_mm_s2: int
    age_ms: int
    gap_ms: int
    lost_ms: int


@dataclass(frozen=True)
class Acceleration:
    """One sensor's acceleration along the track; ``valid``: by its own diagnosis, and it gave a number (P5)."""

    mm_s2: int
    valid: bool


@dataclass(frozen=True)
class Readings:
    """What is known at the end of a cycle (P5, P6).

    ``head``: by inertial sensor or tachometer.
    ``arrived``: a telegram of the tail has come in this cycle, newer than all before; if not, the
    rest says nothing.
    ``left``, ``right``: the tail's sensors; a multiple unit's tail has processed its own: twice the same.
    ``age_ms``: how far the tail's measurement lies back, by GPS time.
    """

    head: Acceleration
    arrived: bool
    left: Acceleration
    right: Acceleration
    age_ms: int


@dataclass(frozen=True)
class Split:
    """What is known of the train's wholeness (P5).

    ``differences_mm_s2``: twice head less tail, for the last 15 telegrams that counted.
    ``in_a_row``: how many cycles up to this one had a telegram that counted, 15 at most.
    ``missed_ms``: how long there was none, together, since there were 15 in a row.
    ``doubtful``: the newest telegram did not count: too old, a sensor without a reading, or
    left and right disagree.
    ``split``: latched; the train has split.  ``lost``: latched; it may have, unseen.
    """

    differences_mm_s2: Window
    in_a_row: int
    missed_ms: int
    doubtful: bool
    split: bool
    lost: bool


def made_up(limits: SplitLimits) -> Split:
    """Begin with a train that staff has made up and found whole: the supervised reset (P5).

    It does not count as intact before the tail was heard 15 times in a row.
    """
    return Split(
        differences_mm_s2=EMPTY,
        in_a_row=0,
        missed_ms=limits.gap_ms + 1,
        doubtful=False,
        split=False,
        lost=False,
    )


def restarted(limits: SplitLimits) -> Split:
    """Begin after a restart: whether the train had split is forgotten, so it counts as split (P5, T8)."""
    return replace(made_up(limits), split=True)


# ---- one telegram


def speaks(sensor: Acceleration) -> bool:
    """Tell whether a sensor gives a reading: valid and in range (P5)."""
    return sensor.valid and -GREATEST_ACCELERATION_MM_S2 <= sensor.mm_s2 <= GREATEST_ACCELERATION_MM_S2


def counts(limits: SplitLimits, readings: Readings) -> bool:
    """Tell whether a telegram came that can be compared: in time, all sensors speaking, left as right (P5, P6).

    An age below zero is a clock gone wrong.
    """
    return (
        readings.arrived
        and 0 <= readings.age_ms <= limits.age_ms
        and speaks(readings.head)
        and speaks(readings.left)
        and speaks(readings.right)
        and magnitude(readings.left.mm_s2 - readings.right.mm_s2) <= limits.disagreement_mm_s2
    )


def shows_shock(limits: SplitLimits, sensor: Acceleration) -> bool:
    """Tell whether a tail sensor shows more than a whole train's tail ever does (P5).

    One of the two is enough, whatever the other says, and however late: in a shock they may well disagree.
    """
    return sensor.valid and not -limits.shock_mm_s2 <= sensor.mm_s2 <= limits.shock_mm_s2


# ---- the window


def with_newest(window: Window, newest: int) -> Window:
    """Put a value in front and drop the oldest (P5)."""
    a, b, c, d, e, f, g, h, i, j, k, m, n, o, _ = window
    return (newest, a, b, c, d, e, f, g, h, i, j, k, m, n, o)


def total(window: Window) -> int:
    """Add up the window: 15 times the moving average (P5)."""
    a, b, c, d, e, f, g, h, i, j, k, m, n, o, p = window
    return a + b + c + d + e + f + g + h + i + j + k + m + n + o + p


def shows_split(limits: SplitLimits, window: Window) -> bool:
    """Tell whether the mean difference is over the threshold, or the newest one is a shock (P5)."""
    return (
        magnitude(total(window)) > 2 * SAMPLES * limits.threshold_mm_s2 or magnitude(window[0]) > 2 * limits.shock_mm_s2
    )


# ---- one cycle


def note_cycle(limits: SplitLimits, state: Split, readings: Readings) -> Split:
    """Take the readings of one cycle (P5, P6)."""
    counted = counts(limits, readings)
    difference = 2 * readings.head.mm_s2 - readings.left.mm_s2 - readings.right.mm_s2
    window = with_newest(state.differences_mm_s2, difference) if counted else state.differences_mm_s2
    in_a_row = smaller(state.in_a_row + 1, SAMPLES) if counted else 0
    waited_ms = state.missed_ms if counted else state.missed_ms + CYCLE_MS
    shock = readings.arrived and (shows_shock(limits, readings.left) or shows_shock(limits, readings.right))
    return Split(
        differences_mm_s2=window,
        in_a_row=in_a_row,
        missed_ms=0 if in_a_row == SAMPLES else waited_ms,
        doubtful=not counted if readings.arrived else state.doubtful,
        split=state.split or shock or shows_split(limits, window),
        lost=state.lost or waited_ms > limits.lost_ms,
    )


# ---- what follows


def is_intact(limits: SplitLimits, state: Split) -> bool:
    """Tell whether the train is known to be whole: only then are the tail's reads the train's (P5, T2)."""
    return not state.split and not state.lost and not state.doubtful and state.missed_ms <= limits.gap_ms


def demands_emergency_brake(state: Split) -> bool:
    """Tell whether the train must stop at once: it has split (P5).

    A tail not heard asks for no brake (ours): where it is not intact nothing behind it is released.
    """
    return state.split
