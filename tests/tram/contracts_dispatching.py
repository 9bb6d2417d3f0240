"""Contracts on orders and displays, for CrossHair (`make crosshair`): leading asserts assume, later ones claim."""

from __future__ import annotations

from kernel.tram.dispatching import DispatchLimits, Hand, Known, Order, Report, View, counts, decided, mark, reported
from kernel.tram.display import Display, located, older, taken

LIMITS = DispatchLimits(120_000, 600_000, 60_000, 240_000, 11_000, 18_000, 180_000)
CLEAR = View(is_clear=True, is_present=False, ahead_is_far=True, ahead_is_near=False, behind_is_far=False)


def known(stop: int, left: bool, stands: bool, told_ms: int) -> Known:
    """A tram of which this is known."""
    return Known(20, 0, stop, left, stands, told_ms, told_ms, 0, 0)


def marks_follow_the_way(stop: int, other: int) -> None:
    """Behind a stop is behind it, before the next (G2)."""
    assert isinstance(stop, int)
    assert isinstance(other, int)
    assert stop < other
    assert mark(stop, False) < mark(stop, True) < mark(other, False)


def nobody_holds_and_recovers(told_ms: int, now_ms: int, clear: bool, present: bool, far: bool, near: bool) -> None:
    """Whatever is seen (G4)."""
    assert isinstance(told_ms, int)
    assert isinstance(now_ms, int)
    order = decided(
        LIMITS, now_ms, known(3, False, True, told_ms), View(clear, present, far, near, False), Hand.NOTHING
    )
    assert not (order.holds and order.recovers)
    assert clear or not order.recovers


def eleven_seconds_are_fresh(told_ms: int, now_ms: int) -> None:
    """With nothing in the way a tram recovers, as long as it is known to stand (G3, G5)."""
    assert isinstance(told_ms, int)
    assert isinstance(now_ms, int)
    order = decided(LIMITS, now_ms, known(3, False, True, told_ms), CLEAR, Hand.NOTHING)
    assert order.recovers == (now_ms - told_ms <= 11_000)


def by_hand_none_recovers_where_it_is_not_clear(now_ms: int, far: bool, near: bool) -> None:
    """Refused (G5)."""
    assert isinstance(now_ms, int)
    view = View(is_clear=False, is_present=False, ahead_is_far=far, ahead_is_near=near, behind_is_far=False)
    assert not decided(LIMITS, now_ms, known(3, False, True, now_ms), view, Hand.RECOVER).recovers


def no_report_puts_a_tram_back(stop: int, left: bool, told: int, gone: bool, made_ms: int, now_ms: int) -> None:
    """What is taken is from farther on, or from there (G2, G6)."""
    assert counts(now_ms, known(stop, left, True, 0), Report(told, gone, not gone, 20, made_ms))
    after = reported(known(stop, left, True, 0), Report(told, gone, not gone, 20, made_ms))
    assert mark(after.stop, after.left) >= mark(stop, left)
    assert after.comes_at == 0


def shown(stop: int, stands: bool, made_ms: int, recovers: bool) -> Display:
    """A display at one second."""
    return Display(1_000, True, stop, stands, False, recovers, made_ms)


def no_order_passes_but_at_its_stop(stop: int, other: int, stands: bool, made_ms: int) -> None:
    """Nor to a tram that moves (G6)."""
    assert stop != other or not stands
    display = shown(stop, stands, 0, False)
    assert taken(LIMITS, display, Order(other, False, True, made_ms)) == display


def no_order_of_the_future_passes(stop: int, made_ms: int) -> None:
    """It would not lapse in time, and every correct one would be older (G3, G6)."""
    assert isinstance(stop, int)
    assert made_ms > 1_000
    display = shown(stop, True, 0, False)
    assert taken(LIMITS, display, Order(stop, True, False, made_ms)) == display


def a_recovery_ends_at_the_next_stop(stop: int, other: int, stands: bool, is_located: bool) -> None:
    """Or where the place is lost (G5)."""
    assert stop != other or not is_located
    assert not located(shown(stop, False, 0, True), is_located, other, stands).recovers


def an_order_lapses_at_a_stop(made_ms: int, elapsed_ms: int) -> None:
    """After its time, and not before (G3)."""
    assert elapsed_ms >= 0
    after = older(LIMITS, shown(3, True, made_ms, True), elapsed_ms)
    assert after.recovers == (1_000 + elapsed_ms - made_ms <= 18_000)
