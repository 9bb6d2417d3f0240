"""The watch over the train's wholeness, at its edges and in drawn worlds (P5, P6)."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from kernel.onboard import split as machine
from kernel.onboard.split import EMPTY, Acceleration, Readings, Split, SplitLimits
from proofs.onboard.split import THEORY
from proofs.onboard.witnesses.play import Play
from proofs.onboard.witnesses.split import JUST_MADE_UP, LIMITS, SITE, WITNESSES, an_old_value_hides_nothing

GREATEST = 2**62
NUMBERS = (
    st.integers(-400, 400) | st.integers(-4_000, 4_000) | st.sampled_from((GREATEST, -GREATEST, 100_000, -100_000))
)
AGES = st.integers(-200, 500) | st.sampled_from((GREATEST, -GREATEST))
SENSORS = st.builds(Acceleration, NUMBERS, st.sampled_from((True, True, True, False)))
WHOLE = machine.made_up(LIMITS)


def near(truth: int, error: int) -> st.SearchStrategy[Acceleration]:
    return st.builds(
        Acceleration,
        st.integers(truth - error, truth + error),
        st.sampled_from((True, True, True, True, False)),
    )


def heard(state: Split, cycles: int, head: int = 0, tail: int = 0) -> Split:
    good = Readings(Acceleration(head, True), True, Acceleration(tail, True), Acceleration(tail, True), 0)
    for _ in range(cycles):
        state = machine.note_cycle(LIMITS, state, good)
    return state


@pytest.mark.parametrize("witness", WITNESSES)
def test_witness(witness: Callable[[], None]) -> None:
    assert witness.__doc__
    witness()


def test_a_part_at_rest_while_the_other_coasts_alike_is_invisible() -> None:
    """What this watch cannot see, said so that nobody relies on it."""
    state = heard(WHOLE, 100, head=-20, tail=0)
    assert machine.is_intact(LIMITS, state)


def test_a_stuck_tail_is_found_by_the_other_sensor() -> None:
    state = heard(WHOLE, 15)
    moving = Readings(Acceleration(700, True), True, Acceleration(0, True), Acceleration(700, True), 0)
    assert not machine.is_intact(LIMITS, machine.note_cycle(LIMITS, state, moving))


@pytest.mark.parametrize("value", [GREATEST, -GREATEST, 100_001, -100_001])
def test_no_number_beyond_the_range_enters_the_window(value: int) -> None:
    wild = Acceleration(value, True)
    good = Acceleration(0, True)
    for readings in (Readings(wild, True, good, good, 0), Readings(good, True, wild, wild, 0)):
        state = machine.note_cycle(LIMITS, heard(WHOLE, 15), readings)
        assert state.differences_mm_s2 == EMPTY
        assert not machine.is_intact(LIMITS, state)


@given(st.integers(-5_000, 5_000), st.integers(-5_000, 5_000))
def test_a_mirrored_train_is_watched_alike(head: int, tail: int) -> None:
    one = heard(WHOLE, 16, head, tail)
    other = heard(WHOLE, 16, -head, -tail)
    assert (one.split, one.missed_ms) == (other.split, other.missed_ms)


@settings(max_examples=60, deadline=None)
@given(st.data())
def test_invariants_hold_in_drawn_worlds(data: st.DataObject) -> None:
    play = Play(THEORY, SITE, JUST_MADE_UP)
    apart = 0
    for _ in range(data.draw(st.integers(1, 60))):
        what = data.draw(st.sampled_from(("run",) * 20 + ("part", "make_up", "restart")))
        if what == "part":
            apart = data.draw(st.integers(-700, 700))
        elif what == "run":
            head = data.draw(st.integers(-1_000, 1_000))
            tail = head + apart
            age_ms = data.draw(st.sampled_from((0, 100, 200, 300, 400, -1)))
            left = data.draw(near(tail, 50))
            right = data.draw(near(tail, 50) | SENSORS)
            readings = Readings(data.draw(near(head, 50)), data.draw(st.integers(0, 9)) > 0, left, right, age_ms)
            play.step(
                "run_a_cycle",
                head_mm_s2=head,
                tail_mm_s2=tail,
                measured_ms=play.system.now_ms + 100 - age_ms,
                readings=readings,
            )
        else:
            play.step(what)
            assert not machine.is_intact(LIMITS, play.system.state)


@settings(max_examples=200, deadline=None)
@given(st.lists(st.builds(Readings, SENSORS, st.booleans(), SENSORS, SENSORS, AGES), max_size=40))
def test_any_readings_whatever_are_answered(history: list[Readings]) -> None:
    state = heard(WHOLE, 15)
    for readings in history:
        after = machine.note_cycle(LIMITS, state, readings)
        assert after.split >= state.split
        assert after.lost >= state.lost
        assert max(map(abs, after.differences_mm_s2)) <= 400_000
        if not readings.arrived:
            assert after.differences_mm_s2 == state.differences_mm_s2
        state = after


def test_a_broken_machine_is_caught(monkeypatch: pytest.MonkeyPatch) -> None:
    """The checks above do find a machine that repeats old values in the place of missing ones."""
    honest = machine.note_cycle

    def repeats(limits: SplitLimits, state: Split, readings: Readings) -> Split:
        after = honest(limits, state, readings)
        if readings.arrived:
            return after
        window = machine.with_newest(state.differences_mm_s2, state.differences_mm_s2[0])
        return replace(after, differences_mm_s2=window)

    monkeypatch.setattr(machine, "note_cycle", repeats)
    with pytest.raises(AssertionError):
        an_old_value_hides_nothing()
