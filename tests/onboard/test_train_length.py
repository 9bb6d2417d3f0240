"""The measured length of a train, at its edges and in drawn worlds (P4, T3, P8)."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from kernel.onboard import train_length as machine
from kernel.onboard.train_length import Passing, PointKind
from proofs.onboard.train_length import THEORY
from proofs.onboard.witnesses.play import Play
from proofs.onboard.witnesses.train_length import BOUNDS, CURVE, JUST_STARTED, SITE, WITNESSES

WILD = st.integers(-(2**62), 2**62)
KINDS = st.sampled_from(PointKind)
PASSINGS = st.builds(Passing, KINDS, st.integers(0, 2), WILD, st.booleans(), WILD, WILD, WILD)


@pytest.mark.parametrize("witness", WITNESSES)
def test_witness(witness: Callable[[], None]) -> None:
    assert witness.__doc__
    witness()


def test_the_averaging_term_is_what_our_reading_of_the_paper_gives() -> None:
    """a·t²/2 with 2.5 km/h/s and 1.5 s, in whole mm upwards; the paper says 0.78 m."""
    assert machine.AVERAGING_MM == -(-2_500_000 * 15 * 15 // (3_600 * 2 * 100))


def test_the_papers_own_train_is_not_underestimated() -> None:
    """120 m came out as 109 to 129 m (paper 001, 4.3.2); with E(v) on top all are long enough."""
    for raw_mm in range(109_000, 129_001, 1_000):
        state = machine.note_head_pass(BOUNDS, machine.UNMEASURED, CURVE)
        way_mm = raw_mm - BOUNDS.last_vehicle_mm
        tail = replace(CURVE, time_ms=CURVE.time_ms + 1, front_least_mm=way_mm, front_most_mm=way_mm)
        assert machine.length_mm(BOUNDS, machine.note_tail_pass(BOUNDS, state, tail)) >= 120_000


def test_a_standing_train_is_measured_with_what_does_not_depend_on_speed() -> None:
    standing = replace(CURVE, speed_most_mm_s=0)
    state = machine.note_head_pass(BOUNDS, machine.UNMEASURED, standing)
    state = machine.note_tail_pass(BOUNDS, state, replace(standing, time_ms=standing.time_ms + 1))
    assert machine.length_mm(BOUNDS, state) == 20_000 + 782 + 5_000


@given(st.lists(st.tuples(st.integers(0, 2), PASSINGS), max_size=20))
def test_any_passes_whatever_are_answered(history: list[tuple[int, Passing]]) -> None:
    state = machine.UNMEASURED
    for what, passing in history:
        if what == 0:
            state = machine.note_head_pass(BOUNDS, state, passing)
        elif what == 1:
            state = machine.note_tail_pass(BOUNDS, state, passing)
        else:
            state = machine.note_formation_changed(state)
        assert abs(machine.length_mm(BOUNDS, state)) < 2**36


@settings(max_examples=300, deadline=None)
@given(st.data())
def test_invariants_hold_in_drawn_worlds(data: st.DataObject) -> None:
    length_nm = data.draw(st.integers(30_000_000_000, 240_000_000_000))
    play = Play(THEORY, SITE, replace(JUST_STARTED, length_nm=length_nm))
    for _ in range(data.draw(st.integers(1, 12))):
        what = data.draw(st.sampled_from(("head", "tail", "tail", "tail", "change", "untold", "jump", "restart")))
        if what == "change":
            play.step("change_formation", length_nm=data.draw(st.integers(30_000_000_000, 240_000_000_000)))
        elif what == "untold":
            play.step("change_formation_untold", length_nm=data.draw(st.integers(30_000_000_000, 240_000_000_000)))
        elif what in ("jump", "restart"):
            play.step("change_kilometrage" if what == "jump" else "restart")
        else:
            pass_somewhere(data, play, what == "head")


def pass_somewhere(data: st.DataObject, play: Play, head: bool) -> None:  # type: ignore[type-arg]
    """An end passes some point; where the tail passes the head's point, the front is where physics puts it."""
    system = play.system
    kind = data.draw(KINDS)
    speed_mm_s = data.draw(st.integers(0, 40_000))
    told = Passing(kind, data.draw(st.integers(0, 1)), data.draw(st.integers(0, 10)), True, 0, 0, speed_mm_s)
    cycle = 100_000 * max(speed_mm_s, system.speed_mm_s)
    is_tag = kind == PointKind.TAG
    off = {
        "sampling_nm": data.draw(st.integers(-cycle, cycle)),
        "skew_nm": 0 if is_tag else data.draw(st.integers(-cycle, cycle)),
        "averaging_nm": 0 if is_tag else data.draw(st.integers(-781_250_000, 781_250_000)),
        "sensor_nm": data.draw(st.integers(-513_000_000, 513_000_000)) * (1 if is_tag else 9),
    }
    beyond_nm = 5_000_000_000 if is_tag else 20_000_000_000
    there_nm = system.front_nm + system.length_nm - beyond_nm + sum(off.values())
    front_nm = data.draw(st.integers(0, 10**12)) if head else there_nm
    least_mm = front_nm // 1_000_000 - data.draw(st.integers(0, 5_000))
    most_mm = front_nm // 1_000_000 + 1 + data.draw(st.integers(0, 5_000))
    passing = replace(told, front_least_mm=least_mm, front_most_mm=most_mm)
    if head:
        after = play.step("head_passes", front_nm=front_nm, speed_mm_s=speed_mm_s, passing=passing)
        assert after.head_passed
    else:
        after = play.step("tail_passes", front_nm=front_nm, speed_mm_s=speed_mm_s, passing=passing, **off)
        assert after.tail_passed
