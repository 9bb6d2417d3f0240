"""Contracts on stopping, for CrossHair (`make crosshair`): leading asserts assume, later ones claim."""

from __future__ import annotations

from kernel.onboard.arithmetic import smaller
from kernel.tram.dispatching import mark
from kernel.tram.stopping import Fix, StopLimits, Stopping, note_fix

LIMITS = StopLimits(near_mm=20_000, held_mm=50_000)
HERE_MM, SEEN_MM, NEXT_MM = 0, 100_000, 400_000
"""Where the stop is that was reached last, where the tram was seen since it left that one, and the next stop."""


def after(left: bool, stands: bool, place_mm: int, speed_mm_s: int, placed: bool = True) -> Stopping:
    """What the unit tells after a fix, of a tram that was at its stop and is on the way that is set."""
    before = Stopping(5, left, stands, True, HERE_MM, SEEN_MM if left else HERE_MM, True)
    return note_fix(LIMITS, before, HERE_MM, NEXT_MM, Fix(placed, place_mm, True, speed_mm_s))


def nothing_goes_back(left: bool, stands: bool, place_mm: int, speed_mm_s: int, placed: bool) -> None:
    """Whatever is measured of a tram that is where it was said to be, or farther on (G2)."""
    assert place_mm >= (SEEN_MM - 30_000 if left else HERE_MM - 50_000)
    assert isinstance(speed_mm_s, int)
    now = after(left, stands, place_mm, speed_mm_s, placed)
    assert mark(5, left) <= mark(now.stop, now.left)
    assert now.stop <= 6


def who_stands_is_slow_and_near(left: bool, stands: bool, place_mm: int, speed_mm_s: int) -> None:
    """Below 5 km/h, and no farther from its stop than places are held (G2)."""
    assert after(left, stands, place_mm, speed_mm_s).stands
    now = after(left, stands, place_mm, speed_mm_s)
    assert speed_mm_s < 1_389
    assert -50_000 <= place_mm - (HERE_MM if now.stop == 5 else NEXT_MM) <= 50_000


def a_standing_tram_is_held(place_mm: int, speed_mm_s: int) -> None:
    """As long as it is slow and within 50 m (G2)."""
    assert -50_000 <= place_mm <= 50_000
    assert speed_mm_s < 1_389
    least_mm = smaller(place_mm, HERE_MM)
    assert after(False, True, place_mm, speed_mm_s) == Stopping(5, False, True, True, least_mm, place_mm, True)


def without_a_place_none_stands(left: bool, stands: bool, speed_mm_s: int) -> None:
    """And nothing else changes (G6)."""
    assert isinstance(speed_mm_s, int)
    most_mm = SEEN_MM if left else HERE_MM
    assert after(left, stands, 0, speed_mm_s, placed=False) == Stopping(5, left, False, False, HERE_MM, most_mm, False)


def before_its_stop_nobody_was_on_the_way(left: bool, stands: bool, place_mm: int, speed_mm_s: int) -> None:
    """By more than 50 m: the unit was set to another way, and begins anew (G2)."""
    assert place_mm < -50_000
    assert after(left, stands, place_mm, speed_mm_s) == Stopping(0, False, False, True, place_mm, place_mm, False)


def who_has_left_and_runs_back_is_not_on_the_way(stands: bool, place_mm: int, speed_mm_s: int) -> None:
    """By more than 30 m, from where it was farthest since it left: it begins anew, although beyond its stop (G2)."""
    assert place_mm < SEEN_MM - 30_000
    assert after(True, stands, place_mm, speed_mm_s) == Stopping(0, False, False, True, place_mm, place_mm, False)
