"""Contracts on what the tone is made of, for CrossHair (`make crosshair`): leading asserts assume, later ones claim."""

from __future__ import annotations

from kernel.alarm.distance import NO_TRAIN_FIX, Direction, TrainFix, WorkerFix
from kernel.alarm.sections import NoUse, Reason, from_stretch_um, from_way_through_um, is_in_zone_b, is_put_forward
from kernel.alarm.tone import (
    Display,
    Handset,
    Known,
    Listing,
    Register,
    Tone,
    agree,
    has_display,
    has_fix,
    is_matched,
    shown_may_be_near,
    tone,
)
from models.alarm.line import BOUNDS, FRESH

REGISTER = Register(
    BOUNDS,
    FRESH,
    display_error_mm=10_000,
    tolerance_mm=50_000,
    sections={},
    stabled=frozenset(),
    ways={},
    openings={},
    edition=1,
)
WORKER = WorkerFix(place_mm=0, age_ms=0)


def known(place_mm: int, age_ms: int, from_mm: int, to_mm: int, shown_ms: int) -> Known:
    """What both sources say."""
    return Known(
        TrainFix(place_mm, age_ms, Direction.UNKNOWN, False),
        Display(from_mm, to_mm, shown_ms),
        jumped=False,
        newest=NO_TRAIN_FIX,
    )


def a_fix_is_fresh_for_ten_seconds(age_ms: int) -> None:
    """Here; a negative age is none (A1)."""
    assert isinstance(age_ms, int)
    assert has_fix(REGISTER, known(0, age_ms, 0, 0, 0)) == (0 <= age_ms <= 10_000)


def a_display_is_fresh_for_twelve_seconds(shown_ms: int) -> None:
    """Here; a negative age is none (A1)."""
    assert isinstance(shown_ms, int)
    assert has_display(REGISTER, known(0, 0, 0, 0, shown_ms)) == (0 <= shown_ms <= 12_000)


def what_is_far_outside_of_the_stretch_does_not_agree(place_mm: int, from_mm: int, to_mm: int) -> None:
    """By more than the tolerance (A2)."""
    assert place_mm > to_mm + 50_000
    told = known(place_mm, 0, from_mm, to_mm, 0)
    assert not agree(REGISTER, told)
    assert not is_matched(REGISTER, told)


def a_place_in_the_stretch_agrees(place_mm: int, from_mm: int, to_mm: int) -> None:
    """Whatever the stretch (A2)."""
    assert from_mm <= place_mm <= to_mm
    assert agree(REGISTER, known(place_mm, 0, from_mm, to_mm, 0))


def a_stretch_is_as_far_as_its_nearer_end(from_mm: int, way_mm: int) -> None:
    """Less a train's length and the worker's error (A4, A6)."""
    assert from_mm >= 0
    assert way_mm >= 0
    ahead_um = from_stretch_um(BOUNDS, from_mm, from_mm + way_mm, WORKER)
    behind_um = from_stretch_um(BOUNDS, -from_mm - way_mm, -from_mm, WORKER)
    assert ahead_um == 1_000 * (from_mm - 75_000)
    assert behind_um == ahead_um


def a_display_that_grows_old_comes_nearer(from_mm: int, age_ms: int) -> None:
    """By the line's greatest speed (A1, A6)."""
    assert 0 <= age_ms <= 3_600_000
    assert from_mm >= 0
    may_be = shown_may_be_near(REGISTER, Display(from_mm, from_mm, age_ms), WORKER, 0)
    assert may_be == (1_000 * (from_mm - 85_000) <= 27_000 * age_ms)


def with_no_train_on_the_line_all_must_be_well(age_ms: int, own_ms: int, well: bool, battery: bool) -> None:
    """For the normal tone (A8)."""
    assert isinstance(age_ms, int)
    listing = Listing(life_ms=0, taken=0, count=0, is_whole=True, named={})
    heard = tone(REGISTER, Handset(WorkerFix(0, own_ms), age_ms, well, battery, listing, {}))
    normal = well and battery and 0 <= age_ms <= 8_000 and 0 <= own_ms <= 5_000
    assert heard == (Tone.NORMAL if normal else Tone.FAULT)


def a_list_counts_if_it_is_whole_and_all_of_it_was_read(taken: int, count: int, whole: bool) -> None:
    """Else no tone is mild (A1)."""
    assert isinstance(taken, int)
    listing = Listing(life_ms=0, taken=taken, count=count, is_whole=whole, named={})
    heard = tone(REGISTER, Handset(WorkerFix(0, 0), 0, True, True, listing, {}))
    assert heard == (Tone.NORMAL if whole and taken >= count else Tone.FAULT)


def running_down_zone_b_is_the_last_of_a_section(place_mm: int, zone_mm: int) -> None:
    """And running up the first; a train that stands is in none (A4)."""
    assert 0 <= zone_mm <= 1_000_000
    assert 0 <= place_mm <= 3_000_000
    section = NoUse(Reason.WITHOUT_GPS, 0, 3_000_000, zone_mm)
    down, up = (TrainFix(place_mm, 0, way, True) for way in (Direction.DOWN, Direction.UP))
    assert is_in_zone_b(section, down) == (place_mm > 3_000_000 - zone_mm)
    assert is_in_zone_b(section, up) == (place_mm < zone_mm)
    assert is_put_forward(section, down) != is_in_zone_b(section, down)
    assert not is_in_zone_b(section, TrainFix(place_mm, 0, Direction.DOWN, False))


def on_its_way_through_a_train_counts_from_its_fix_to_the_outer_end(place_mm: int, beyond_mm: int) -> None:
    """Less a train's length, and the worker's error (A4)."""
    assert 0 <= place_mm <= 3_000_000
    assert 0 <= beyond_mm <= 5_000_000
    section = NoUse(Reason.WITHOUT_GPS, 0, 3_000_000, 0)
    down = TrainFix(place_mm, 0, Direction.DOWN, True)
    ahead_um = from_way_through_um(BOUNDS, section, down, WorkerFix(3_000_000 + beyond_mm, 0))
    behind_um = from_way_through_um(BOUNDS, section, down, WorkerFix(place_mm - 20_000 - beyond_mm, 0))
    assert ahead_um == behind_um == 1_000 * (beyond_mm - 75_000)
