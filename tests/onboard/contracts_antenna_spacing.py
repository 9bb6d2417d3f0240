"""Contracts on the antennas' spacing for CrossHair (`make crosshair`): leading asserts assume, later ones claim."""

from __future__ import annotations

from dataclasses import replace

from kernel.onboard.antenna_spacing import (
    SpacingLimits,
    is_healthy,
    note_head_read,
    note_tail_read,
    preset,
    restarted,
)
from kernel.onboard.way import UNKNOWN, Way

LIMITS = SpacingLimits(tolerance_mm=1_013, width_mm=4_000)
FRESH = preset(120_000)


def a_whole_train_is_healthy(place_mm: int, off_mm: int, behind_mm: int, ahead_mm: int) -> None:
    """Up to the width that is written (T13)."""
    assert -(10**8) <= place_mm <= 10**8
    assert -1_013 <= off_mm <= 1_013
    assert 0 <= behind_mm <= 1_000
    assert 0 <= ahead_mm <= 1_000
    head = note_head_read(FRESH, 7, Way(True, place_mm - behind_mm, place_mm + ahead_mm))
    now_mm = place_mm + 120_000 + off_mm
    assert is_healthy(note_tail_read(LIMITS, head, 7, Way(True, now_mm - behind_mm, now_mm + ahead_mm)))


def a_false_tail_is_latched(apart_mm: int) -> None:
    """Nearer or farther than the tolerance; nor does a read that fits help (T13)."""
    assert -(10**8) <= apart_mm <= 10**8
    assert apart_mm < 118_987 or apart_mm > 121_013
    head = note_head_read(note_head_read(FRESH, 7, Way(True, 0, 0)), 8, Way(True, 1_000, 1_000))
    found = note_tail_read(LIMITS, head, 7, Way(True, apart_mm, apart_mm))
    assert found.broken
    assert not is_healthy(note_tail_read(LIMITS, found, 8, Way(True, 121_000, 121_000)))


def a_read_that_the_head_did_not_make_proves_nothing(uid: int, place_mm: int) -> None:
    """And accuses nobody (T13)."""
    assert uid != 7
    after = note_tail_read(LIMITS, note_head_read(FRESH, 7, Way(True, 0, 0)), uid, Way(True, place_mm, place_mm))
    assert not is_healthy(after)
    assert not after.broken


def a_way_known_badly_proves_nothing(width_mm: int, apart_mm: int) -> None:
    """And accuses nobody, wherever the tail is (T13, P7)."""
    assert 4_000 < width_mm <= 10**6
    assert -(10**6) <= apart_mm <= 10**6
    after = note_tail_read(
        LIMITS, note_head_read(FRESH, 7, Way(True, 0, 0)), 7, Way(True, apart_mm, apart_mm + width_mm)
    )
    assert not is_healthy(after)
    assert not after.broken


def a_place_not_known_proves_nothing(uid: int, least_mm: int, most_mm: int) -> None:
    """At the head or at the tail (T13, T8)."""
    assert least_mm > most_mm or least_mm < -(10**9) or most_mm > 10**9
    way = Way(True, least_mm, most_mm)
    assert not is_healthy(note_tail_read(LIMITS, note_head_read(FRESH, uid, Way(True, 0, 0)), uid, way))
    assert not is_healthy(note_tail_read(LIMITS, note_head_read(FRESH, uid, way), uid, Way(True, 0, 0)))
    assert not is_healthy(note_tail_read(LIMITS, note_head_read(FRESH, uid, UNKNOWN), uid, way))


def the_tail_before_the_head_is_latched(uid: int, place_mm: int) -> None:
    """In reversed order: the head had not read the tag, so there was nothing to hold the tail's read against (T13)."""
    assert isinstance(place_mm, int)
    tail = note_tail_read(LIMITS, replace(FRESH, checked=True), uid, Way(True, 0, 0))
    assert note_head_read(tail, uid, Way(True, place_mm, place_mm)).broken


def a_head_that_comes_round_to_what_the_tail_has_read_accuses_nobody(uid: int, place_mm: int) -> None:
    """On a loop no longer than the train, that read was held against the head's of the lap before (T13)."""
    assert isinstance(place_mm, int)
    tail = replace(FRESH, checked=True, tail_read=True, tail_uid=uid)
    assert is_healthy(note_head_read(tail, uid, Way(True, place_mm, place_mm)))


def a_restarted_line_is_not_healthy(uid: int, place_mm: int) -> None:
    """Until the distance is preset (T3, T8)."""
    assert isinstance(place_mm, int)
    way = Way(True, place_mm, place_mm)
    assert not is_healthy(note_tail_read(LIMITS, note_head_read(restarted(), uid, way), uid, way))
