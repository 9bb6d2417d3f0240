"""Contracts on the moment to warn for CrossHair (`make crosshair`): leading asserts assume, later ones claim."""

from __future__ import annotations

from kernel.crossing.arrival import ArrivalBounds, Followed, Ranging, aged, counts, follow, must_warn, taken

BOUNDS = ArrivalBounds(
    line_um=3_000_000,
    gain_um=10_000,
    cycle_ms=100,
    warning_cycles=350,
    silence_cycles=20,
    way_spread_mm=1,
    speed_spread_mm_s=1,
)
FAR = Followed(
    way_um=2_000_000_000,
    short_um=1_000_000,
    ceiling_um=3_000_000,
    age_cycles=0,
    told_way_mm=2_000_000,
    told_speed_mm_s=20_000,
    warns=False,
)


def a_warning_is_kept(way_um: int, short_um: int, age_cycles: int) -> None:
    """Whatever is known (X4)."""
    assert 0 <= short_um <= 3_000_000
    assert must_warn(BOUNDS, Followed(way_um, short_um, 3_000_000, age_cycles, 0, 0, True))


def what_is_too_old_warns(way_um: int, age_cycles: int) -> None:
    """However far the train was (X3)."""
    assert age_cycles > 20
    assert must_warn(BOUNDS, Followed(way_um, 3_000_000, 3_000_000, age_cycles, 0, 0, False))


def a_train_at_the_crossing_is_warned_of(way_um: int) -> None:
    """Even one that stands (X2)."""
    assert way_um <= 0
    assert must_warn(BOUNDS, Followed(way_um, 3_000_000, 3_000_000, 0, 0, 0, False))


def at_the_lines_speed_the_way_of_352_cycles_counts(way_um: int) -> None:
    """To the micrometre (X2)."""
    assert 0 <= way_um <= 2_000_000_000
    assert must_warn(BOUNDS, Followed(way_um, 0, 3_000_000, 0, 0, 0, False)) == (way_um <= 352 * 3_000_000)


def what_does_not_count_changes_nothing(way_mm: int, speed_mm_s: int, age_cycles: int) -> None:
    """Out of range, or too old (X1, X3)."""
    assert age_cycles > 20 or age_cycles < 0 or speed_mm_s > 200_000
    ranging = Ranging(True, way_mm, speed_mm_s, age_cycles)
    assert not counts(BOUNDS, ranging)
    assert taken(BOUNDS, FAR, ranging) == FAR


def silence_far_away_waits(age_cycles: int) -> None:
    """As long as the ranging counts (X3)."""
    assert 0 <= age_cycles <= 20
    held = Followed(2_000_000_000, 1_000_000, 3_000_000, age_cycles, 0, 0, False)
    assert follow(BOUNDS, held, Ranging(False, 0, 0, 0)) == held


def a_train_gets_no_farther_by_waiting(way_um: int, short_um: int) -> None:
    """Nor slower (X2)."""
    assert 0 <= short_um <= 3_000_000
    later = aged(BOUNDS, Followed(way_um, short_um, 3_000_000, 0, 0, 0, False))
    assert later.way_um <= way_um
    assert later.short_um <= short_um
