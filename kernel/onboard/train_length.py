"""Train length: how far the head runs from passing a point itself until the tail passes it (P4, T3, P8).

L = p(t_t) - p(t_h) + L_c (paper 001, 3.3): p is the front's place, t_h and t_t when head and tail pass,
L_c the last vehicle's length.  Raw L can be short (109 m was measured for 120 m), so the length used is
the most that it can be: from the least place at t_h to the most at t_t, and the errors E(v) of paper
001, table 2, on top.  At 130 km/h E is 13.0 m:

- sampling: one cycle, 3.61 m; what happens within a cycle is noted at its end;
- start skew: one cycle, 3.61 m; head and tail count their cycles from different moments;
- averaging: 0.78 m.  The paper does not derive it.  Our assumption: the moving average of 1.5 s puts a
  pass off by what the speed changes meanwhile, a·t²/2 with 2.5 km/h/s and 1.5 s, which is 0.78125 m;
- sensor: 5 m.

A tag read by head and tail antenna does the same where lengths are preset (T3): both overhangs in the
place of L_c, and the reader's window for the sensor; one unit reads both, so no skew and no average.

Until both have passed one point, the line's greatest length is used; so it is after any change of the
formation.  Due before the main line (3.3); ours: a length measured later is as good.  Ours: what is
measured above the line's greatest length is used as it is, and shown as a contradiction where it is more with
all errors taken off.

Ours: at every later point the length is measured again, and held against the one in use.  If no length
is within the errors of both, a bound was broken, or vehicles were coupled untold: the line's greatest
length is used, or what was measured if that is more, until staff tells the formation.

Ours: places are compared by one kilometrage.  After a change of ends, or when the train is located anew,
the head's pass counts no more; and no train is shorter than its last vehicle.

Ranges of readings: places to 10,000 km, speeds to 200 m/s; what is beyond, or a front known less well
than the written width, is no pass.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from enum import Enum

from kernel.onboard.arithmetic import CYCLE_MS, GREATEST_SPEED_MM_S, divided_up, larger

GREATEST_PLACE_MM = 10_000_000_000
GREATEST_MEASURE_MM = 1_000_000
AVERAGING_MM = 782
"""Paper 001, table 2, says 0.78 m; here 2.5 km/h/s · (1.5 s)² / 2, rounded up (P8)."""
SENSOR_MM = 5_000
"""Paper 001, table 2 (P8)."""


class PointKind(Enum):
    """What both ends pass (P4, T3)."""

    FEATURE = 0
    """A curve or change of gradient, by inertial sensors (paper 001, 3.3)."""
    TAG = 1
    """A tag at a system boundary, by antennas (paper 000, 3.2)."""


@dataclass(frozen=True)
class LengthBounds:
    """The written measures and bounds, each from 0 to a kilometre (P4, T3).

    ``line_maximum_mm``: no train of the line is longer, nor this one, if its own length is written: the operator's
    duty; it may be more.
    ``last_vehicle_mm``: L_c.
    ``front_overhang_mm``, ``rear_overhang_mm``: from the antennas to the train's ends, the same at both.
    ``window_mm``: how far apart one tag's reads by the two antennas may be from where the tag lies.
    ``width_mm``: the widest range of the front, by odometry, in which a pass still counts.
    """

    line_maximum_mm: int
    last_vehicle_mm: int
    front_overhang_mm: int
    rear_overhang_mm: int
    window_mm: int
    width_mm: int


@dataclass(frozen=True)
class Passing:
    """An end of the train has passed a point (P4, T3).

    ``point``: the feature's or the tag's number, the only one of its kind on the line.
    ``time_ms``: GPS time of the pass.
    ``known``: odometry claims its ranges of front and speed; if not, the rest says nothing.
    ``front_least_mm``, ``front_most_mm``: the range of the train's front at that time, by odometry.
    ``speed_most_mm_s``: the most that the speed was then.
    """

    kind: PointKind
    point: int
    time_ms: int
    known: bool
    front_least_mm: int
    front_most_mm: int
    speed_most_mm_s: int


@dataclass(frozen=True)
class Length:
    """What is known of the length of this formation (P4).

    ``head_passed``: the head has passed a point, ``head``, and the tail is awaited.
    ``measured``: the tail has passed the same; ``least_mm``, ``most_mm``: the length is between them then.
    ``contradicted``: latched; measured again, the length could not be the same.
    """

    head_passed: bool
    head: Passing
    measured: bool
    least_mm: int
    most_mm: int
    contradicted: bool


NOWHERE = Passing(PointKind.FEATURE, 0, 0, False, 0, 0, 0)
UNMEASURED = Length(head_passed=False, head=NOWHERE, measured=False, least_mm=0, most_mm=0, contradicted=False)
"""At power-on and after every change of the formation: the line's greatest length is used (P4)."""


def fits(bounds: LengthBounds, passing: Passing) -> bool:
    """Tell whether a pass is within the ranges of readings, and the front known well enough (P4)."""
    return (
        passing.known
        and -GREATEST_PLACE_MM <= passing.front_least_mm <= passing.front_most_mm <= GREATEST_PLACE_MM
        and passing.front_most_mm - passing.front_least_mm <= bounds.width_mm
        and 0 <= passing.speed_most_mm_s <= GREATEST_SPEED_MM_S
    )


def cycle_way_mm(speed_mm_s: int) -> int:
    """Give the way of one cycle, rounded up (P4, P8)."""
    return divided_up(CYCLE_MS * speed_mm_s, 1000)


def error_mm(bounds: LengthBounds, kind: PointKind, speed_mm_s: int) -> int:
    """Give E(v), the most that the way between the passes may come out short, or long (P8; 13.0 m at 130 km/h)."""
    if kind == PointKind.TAG:
        return cycle_way_mm(speed_mm_s) + bounds.window_mm
    return cycle_way_mm(speed_mm_s) + cycle_way_mm(speed_mm_s) + AVERAGING_MM + SENSOR_MM


def beyond_the_sensors_mm(bounds: LengthBounds, kind: PointKind) -> int:
    """Give what the train is longer than its sensors are apart: L_c, or both overhangs (P4, T3)."""
    if kind == PointKind.TAG:
        return bounds.front_overhang_mm + bounds.rear_overhang_mm
    return bounds.last_vehicle_mm


def note_head_pass(bounds: LengthBounds, state: Length, passing: Passing) -> Length:
    """Note that the head has passed a point; the tail is awaited there, and nowhere else (P4, T3)."""
    return replace(state, head_passed=fits(bounds, passing), head=passing)


def is_same_point(state: Length, passing: Passing) -> bool:
    """Tell whether the tail has passed where the head did, after it (P4).

    A telegram of an earlier run over the same point may still come.
    """
    return (
        state.head_passed
        and passing.kind == state.head.kind
        and passing.point == state.head.point
        and passing.time_ms > state.head.time_ms
    )


def note_tail_pass(bounds: LengthBounds, state: Length, passing: Passing) -> Length:
    """Note that the tail has passed a point; if the head did before, the length is measured (P4, T3).

    Once measured, a length stays until the formation changes (paper 001, 3.1), or is contradicted.  Tag
    reads count only over a healthy through line: the caller's duty (T2, T13).
    """
    if not is_same_point(state, passing) or not fits(bounds, passing):
        return state
    error_most_mm = error_mm(bounds, passing.kind, larger(state.head.speed_most_mm_s, passing.speed_most_mm_s))
    beyond_mm = beyond_the_sensors_mm(bounds, passing.kind)
    least_mm = passing.front_least_mm - state.head.front_most_mm + beyond_mm - error_most_mm
    most_mm = passing.front_most_mm - state.head.front_least_mm + beyond_mm + error_most_mm
    if state.measured:
        return note_measured_again(state, least_mm, most_mm)
    if most_mm < bounds.last_vehicle_mm:
        return state
    return replace(state, measured=True, least_mm=least_mm, most_mm=most_mm)


def note_measured_again(state: Length, least_mm: int, most_mm: int) -> Length:
    """Hold a measurement against the one in use: no length within both contradicts it, for good (P4; ours)."""
    if least_mm <= state.most_mm and state.least_mm <= most_mm:
        return state
    return replace(state, most_mm=larger(state.most_mm, most_mm), contradicted=True)


def note_kilometrage_changed(state: Length) -> Length:
    """Forget the head's pass: ends were changed, or the train was located anew; the length stays (P4; ours)."""
    return replace(state, head_passed=False)


def note_formation_changed(state: Length) -> Length:
    """Vehicles were coupled or split, or may have been: nothing measured before holds, no pass counts (P4, T3)."""
    return UNMEASURED


def length_mm(bounds: LengthBounds, state: Length) -> int:
    """Give the length to be used: never less than the true one (P4)."""
    if state.contradicted:
        return larger(state.most_mm, bounds.line_maximum_mm)
    return state.most_mm if state.measured else bounds.line_maximum_mm


def contradicts_itself(state: Length) -> bool:
    """Tell whether a length measured again could not be the one measured before: a monitor (P4; ours)."""
    return state.contradicted


def contradicts_the_line(bounds: LengthBounds, state: Length) -> bool:
    """Tell whether even the least that was measured is more than a train of the line may have: a monitor (P4; ours)."""
    return state.measured and state.least_mm > bounds.line_maximum_mm
