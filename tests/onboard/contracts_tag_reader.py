"""Contracts on the tag reader for CrossHair (`make crosshair`): leading asserts assume, later ones claim."""

from __future__ import annotations

from dataclasses import replace

from kernel.onboard.tag_reader import (
    NO_FRAME,
    Frame,
    Level,
    ReaderLimits,
    delivers,
    mended,
    next_cycle,
    note_frame,
    restarted,
    taken,
    turned,
)

LIMITS = ReaderLimits(least_mv=800, most_mv=1_200, gap_frames=6)
SOUND = Level(mv=1_000, valid=True)
ONE = Frame(valid=True, uid=-7, block=3, distance_mm=400_000, kind=1)


def a_level_out_of_limits_silences(mv: int, valid: bool, uid: int) -> None:
    """Whatever is heard then, and though it agrees (T13)."""
    assert not (valid and 800 <= mv <= 1_200)
    heard = replace(ONE, uid=uid)
    assert note_frame(LIMITS, replace(mended(), newest=heard), heard, Level(mv, valid)) == restarted()


def an_unhealthy_antenna_stays_so(mv: int, valid: bool, uid: int) -> None:
    """Whatever level it shows later (T13)."""
    assert isinstance(uid, int)
    heard = replace(ONE, uid=uid)
    before = replace(restarted(), newest=heard, second=heard)
    assert not delivers(note_frame(LIMITS, before, heard, Level(mv, valid)))


def one_frame_is_not_enough(uid: int, block: int, distance_mm: int, kind: int) -> None:
    """Nor are two that differ in anything (T16)."""
    assert not (uid == -7 and block == 3 and distance_mm == 400_000 and kind == 1)
    heard = Frame(valid=True, uid=uid, block=block, distance_mm=distance_mm, kind=kind)
    before = replace(mended(), newest=ONE, second=ONE, third=ONE)
    assert not delivers(note_frame(LIMITS, before, heard, SOUND))


def two_frames_deliver(uid: int, place: int) -> None:
    """Wherever among the last three the first was (T16)."""
    assert 0 <= place <= 2
    heard = replace(ONE, uid=uid)
    before = replace(
        mended(),
        newest=heard if place == 0 else NO_FRAME,
        second=heard if place == 1 else NO_FRAME,
        third=heard if place == 2 else NO_FRAME,
    )
    after = note_frame(LIMITS, before, heard, SOUND)
    assert delivers(after)
    assert after.held == heard


def silence_is_counted_to_a_gap(quiet_frames: int) -> None:
    """After it the tag may come again (T1)."""
    assert 0 <= quiet_frames <= 6
    after = note_frame(LIMITS, replace(mended(), held=ONE, quiet_frames=quiet_frames), NO_FRAME, SOUND)
    assert after.quiet_frames <= 6
    assert after.held.valid == (quiet_frames < 5)


def an_antenna_that_failed_makes_both_fail(healthy: bool, other: bool, uid: int) -> None:
    """Once ends may have been changed; and nothing that was heard before counts (T13, T3)."""
    assert isinstance(uid, int)
    heard = replace(ONE, uid=uid)
    before = replace(mended(), newest=heard, held=heard, fresh=healthy, healthy=healthy)
    after = turned(before, replace(mended(), healthy=other))
    assert after == (mended() if healthy and other else restarted())


def a_frame_before_a_cycle_is_none_of_two(uid: int, fresh: bool) -> None:
    """Nor is a record taken that was delivered before it (T1, P7)."""
    assert isinstance(uid, int)
    heard = replace(ONE, uid=uid)
    begun = next_cycle(replace(mended(), newest=heard, second=heard, third=heard, held=heard, fresh=fresh))
    assert not delivers(begun)
    assert begun.held == heard
    assert not delivers(note_frame(LIMITS, begun, heard, SOUND))


def what_was_taken_is_delivered_no_more(uid: int, fresh: bool) -> None:
    """And the rest stays (T1)."""
    assert isinstance(uid, int)
    before = replace(mended(), newest=replace(ONE, uid=uid), fresh=fresh)
    assert taken(before) == replace(before, fresh=False)
