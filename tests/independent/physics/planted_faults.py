"""Wrong kernels: the kernel of today with one function, or one written limit, as a careless hand might leave it."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, replace
from types import ModuleType
from typing import Any
from unittest.mock import patch

from kernel.onboard import antenna_spacing, braking, computer, odometry, tag_fix, tag_window, train_length
from kernel.onboard.antenna_spacing import SpacingLimits
from kernel.onboard.brake_demand import Known
from kernel.onboard.computer import Computer
from kernel.onboard.limits import Limits
from kernel.onboard.odometry import Loss, Motion, Readings, SensorBounds
from kernel.onboard.tag_window import Window, WindowLimits
from kernel.onboard.train_length import LengthBounds, PointKind
from kernel.onboard.way import Way
from tests.independent.physics import ride


@dataclass(frozen=True)
class Wrong:
    """What is wrong, in which function, what stands in its place, and what kinds of hazard may come of it."""

    why: str
    module: ModuleType
    name: str
    instead: Callable[..., Any]
    kinds: frozenset[str]

    @contextmanager
    def planted(self) -> Iterator[None]:
        """Run with it."""
        with patch.object(self.module, self.name, self.instead):
            yield


def _any_reading(bounds: SensorBounds, motion: Motion, readings: Readings) -> bool:
    return odometry.tachometer_is_heard(readings)


def _no_slip(bounds: SensorBounds, motion: Motion, readings: Readings) -> bool:
    return odometry.tachometer_speaks(bounds, motion, readings)


def _no_error(bounds: SensorBounds, shown: int) -> int:
    return 1


_note_cycle, _glide, _note_fix = odometry.note_cycle, odometry.glide, odometry.note_fix


def _trusts_at_once(bounds: SensorBounds, motion: Motion, readings: Readings) -> Motion:
    return replace(_glide(bounds, motion, readings), trusted=odometry.tachometer_is_heard(readings))


def _ignores_the_clock(bounds: SensorBounds, motion: Motion, readings: Readings) -> Motion:
    return _note_cycle(bounds, motion, replace(readings, elapsed_ms=100))


def _keeps_a_range(motion: Motion, least_mm: int, most_mm: int) -> Motion:
    fixed = _note_fix(motion, least_mm, most_mm)
    return motion if fixed.loss == Loss.CONTRADICTED else fixed


def _no_run_since(before: Motion, after: Motion) -> int:
    return 0


def _at_the_end(before: Motion, after: Motion) -> Way:
    return Way(True, after.front_least_mm, after.front_most_mm)


def _anything_fits(limits: SpacingLimits, preset_mm: int, way: Way) -> bool:
    return True


def _never_overdue(limits: WindowLimits, window: Window, way: Way) -> Window:
    return window


def _antennas_at_the_ends(bounds: LengthBounds, kind: PointKind) -> int:
    return 0


def _brakes_at_the_end(bounds: braking.BrakeBounds, front_most_mm: int, speed_most_mm_s: int, end_mm: int) -> bool:
    return front_most_mm <= end_mm


_stops_before = braking.stops_before


def _brakes_well(bounds: braking.BrakeBounds, front_most_mm: int, speed_most_mm_s: int, end_mm: int) -> bool:
    dry = replace(bounds, slows_mm_s2=2 * bounds.slows_mm_s2)
    return _stops_before(dry, front_most_mm, speed_most_mm_s, end_mm)


def _gravity_forgotten(bounds: SensorBounds, readings: Readings) -> int:
    return readings.inertial_mm_s2 - bounds.inertial_mm_s2


def _window_before_the_read(limits: Limits, state: Computer, place_mm: int, kind: int) -> Computer:
    begun = replace(state, from_mm=state.known.motion.front_most_mm)
    away_mm = computer.way_to_tag_mm(limits, begun, place_mm) - 1_500
    known: Known = replace(begun.known, window=tag_window.await_tag(0, max(0, away_mm)))
    return replace(begun, known=known)


RANGES = frozenset({ride.FRONT, ride.SPEED, ride.BEYOND_END})
WRONG: dict[str, Wrong] = {
    "stuck": Wrong("a tachometer that is stuck is heard", odometry, "tachometer_speaks", _any_reading, RANGES),
    "no slip": Wrong("a slip is not seen", odometry, "agrees", _no_slip, RANGES),
    "no creep": Wrong("creep and diameter are forgotten", odometry, "way_error_mm", _no_error, RANGES),
    "exact speed": Wrong("the speed is taken as shown", odometry, "speed_error_mm_s", _no_error, RANGES),
    "trusts at once": Wrong("a wheel is trusted again at once", odometry, "glide", _trusts_at_once, RANGES),
    "gravity": Wrong("the slope is forgotten in a slide", odometry, "least_mm_s2", _gravity_forgotten, RANGES),
    "no run since": Wrong("the train has not run on since the read", tag_fix, "ran_mm", _no_run_since, RANGES),
    "late place": Wrong("the place of the read is the cycle's end", tag_fix, "place_of_read", _at_the_end,
                        frozenset({ride.ACCUSED, ride.OVERDUE})),
    "any tail": Wrong("any tail fits", antenna_spacing, "fits", _anything_fits, frozenset({ride.FALSE_TAIL})),
    "never overdue": Wrong("no tag is overdue", tag_window, "note_cycle", _never_overdue, frozenset({ride.UNNOTICED})),
    "early window": Wrong("the window ends before the tag", computer, "await_tag", _window_before_the_read,
                          frozenset({ride.OVERDUE})),
    "overhangs": Wrong("the train ends at its antennas", train_length, "beyond_the_sensors_mm", _antennas_at_the_ends,
                       frozenset({ride.LENGTH})),
    "brakes at the end": Wrong("it brakes at the end", braking, "stops_before", _brakes_at_the_end, RANGES),
    "brakes well": Wrong("the brake is twice as good", braking, "stops_before", _brakes_well, RANGES),
}  # fmt: skip
