"""Contracts on the brake control for CrossHair (`make crosshair`): leading asserts assume, later ones claim."""

from __future__ import annotations

from kernel.onboard.braking import FARTHEST_MM, Brake, BrakeBounds, slows_before, stops_before, supervise, take_end

BOUNDS = BrakeBounds(
    gains_mm_s2=1_200, slows_mm_s2=700, response_cycles=15, standstill_mm_s=25, cut_cycles=5, falls_mm_s2=200
)
ON, OFF = Brake(applied=True, end_mm=1_000_000), Brake(applied=False, end_mm=1_000_000)


def what_is_no_speed_is_too_fast(speed_mm_s: int) -> None:
    """Negative, or beyond 200 m/s (T12)."""
    assert speed_mm_s < 0 or speed_mm_s > 200_000
    assert not stops_before(BOUNDS, 0, speed_mm_s, FARTHEST_MM)


def an_end_behind_is_never_stopped_before(front_mm: int, speed_mm_s: int) -> None:
    """At any speed (T12)."""
    assert front_mm >= 0
    assert 0 <= speed_mm_s <= 200_000
    assert not stops_before(BOUNDS, front_mm, speed_mm_s, 0)


def a_train_that_stays_slow_is_slow_everywhere(front_mm: int, place_mm: int, speed_mm_s: int) -> None:
    """16 cycles at the most that it gains come to 1.9584 m/s, and 23.041 m/s with them to less than 25 (T12)."""
    assert -(10**9) <= front_mm <= 10**9
    assert 0 <= speed_mm_s <= 23_041
    assert slows_before(BOUNDS, front_mm, speed_mm_s, place_mm, 25_000)


def a_restriction_that_is_passed_is_kept_by_a_slow_train_alone(front_mm: int, speed_mm_s: int) -> None:
    """As far as its front may be (T12)."""
    assert 0 < front_mm <= 10**9
    assert 23_042 <= speed_mm_s <= 200_000
    assert not slows_before(BOUNDS, front_mm, speed_mm_s, 0, 25_000)


def the_way_to_slow_down_is_needed(front_mm: int) -> None:
    """From 36 m/s to 25: 17 cycles at 37.9584 m/s, 65.820 m, and the brake's way, 607.024 m (T12)."""
    assert -(10**9) <= front_mm <= 10**9
    assert slows_before(BOUNDS, front_mm, 36_000, 0, 25_000) == (front_mm <= -672_844)


def a_demand_is_obeyed(applied: bool, acknowledged: bool) -> None:
    """Whatever else is (T5, P5)."""
    assert isinstance(applied, bool)
    assert supervise(BOUNDS, Brake(applied, 1_000_000), 0, 0, 0, True, acknowledged).applied


def a_brake_that_is_on_goes_off_at_an_acknowledged_standstill(back_mm_s: int, speed_mm_s: int, ack: bool) -> None:
    """And not before, nor while the train may roll back (T12)."""
    assert 0 <= speed_mm_s <= 10_000
    assert 0 <= back_mm_s <= 10_000
    after = supervise(BOUNDS, ON, 0, -back_mm_s, speed_mm_s, False, ack)
    assert after.applied == (not ack or speed_mm_s > 25 or back_mm_s > 25)


def with_room_it_stays_off(speed_mm_s: int) -> None:
    """A kilometre before the end, up to 30 m/s (T12)."""
    assert 0 <= speed_mm_s <= 30_000
    assert supervise(BOUNDS, OFF, 0, speed_mm_s, speed_mm_s, False, False) == OFF


def a_farther_end_is_taken(end_mm: int, front_mm: int, speed_mm_s: int) -> None:
    """At any place and speed (T4)."""
    assert end_mm >= 1_000_000
    assert take_end(BOUNDS, OFF, front_mm, speed_mm_s, end_mm) == Brake(False, end_mm)


def a_nearer_end_is_taken_or_brakes(end_mm: int) -> None:
    """From rest: 17 cycles' way at what 16 may gain, 3.396 m, and the brake's from 1.958 m/s, 2.854 m (T9, T12)."""
    assert end_mm < 1_000_000
    after = take_end(BOUNDS, OFF, 0, 0, end_mm)
    assert after == (Brake(False, end_mm) if end_mm >= 6_250 else Brake(True, 1_000_000, withheld=True))
