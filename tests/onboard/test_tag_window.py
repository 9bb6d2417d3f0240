"""The window for the next tag at its edges and in drawn worlds (T5)."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from kernel.onboard import tag_window as machine
from kernel.onboard.tag_window import NONE_AWAITED, Verdict, WindowLimits
from kernel.onboard.way import GREATEST_MM, UNKNOWN, Way, between, is_known
from models.onboard.units import NM_A_MM
from proofs.onboard.tag_window import THEORY
from proofs.onboard.witnesses.play import Play
from proofs.onboard.witnesses.tag_window import AT_REST, PLANNED_MM, SITE, WITNESSES

LIMITS = SITE.limits
EXPECTED = machine.await_tag(PLANNED_MM, PLANNED_MM)
NEAR = (
    st.integers(-20_000, 20_000)
    | st.integers(PLANNED_MM - 20_000, PLANNED_MM + 20_000)
    | st.sampled_from((0, 2**28 - 1, 2**28, -1, GREATEST_MM, GREATEST_MM + 1, -GREATEST_MM, -GREATEST_MM - 1, 2**62))
)


@pytest.mark.parametrize("witness", WITNESSES)
def test_witness(witness: Callable[[], None]) -> None:
    assert witness.__doc__
    witness()


@pytest.mark.parametrize("way", [UNKNOWN, Way(True, 7, 6), Way(True, -GREATEST_MM - 1, 0), Way(True, 0, 2**62)])
def test_a_way_that_cannot_be_opens_the_loop(way: Way) -> None:
    assert not is_known(way)
    assert machine.judge(LIMITS, EXPECTED, way) == Verdict.UNKNOWN
    assert machine.note_cycle(LIMITS, EXPECTED, way).passed
    assert not machine.note_cycle(LIMITS, NONE_AWAITED, way).passed


def test_a_stuck_odometer_finds_a_tag_early_but_no_tag_missing() -> None:
    """An odometer that shows no way while the train runs breaks its contract; the next tag finds it out."""
    stuck = Way(True, 0, 0)
    assert not machine.note_cycle(LIMITS, EXPECTED, stuck).passed
    assert machine.judge(LIMITS, EXPECTED, stuck) == Verdict.EARLY


def test_tags_close_to_each_other_leave_nothing_early() -> None:
    """A distance within the tolerance: the next tag may come at once."""
    assert machine.in_window(LIMITS, machine.await_tag(LIMITS.tolerance_mm, 10**6), Way(True, 0, 0))
    assert not machine.in_window(LIMITS, machine.await_tag(LIMITS.tolerance_mm + 1, 10**6), Way(True, 0, 0))


def test_no_tolerance_is_exact() -> None:
    exact = WindowLimits(tolerance_mm=0, width_mm=0, tail_width_mm=0)
    found = [machine.judge(exact, machine.await_tag(5, 5), Way(True, mm, mm)) for mm in (4, 5, 6)]
    assert found == [Verdict.EARLY, Verdict.IN_WINDOW, Verdict.LATE]


@given(NEAR, NEAR, NEAR, NEAR)
def test_the_way_between_two_places_contains_every_way_between_them(a: int, b: int, c: int, d: int) -> None:
    then, now = Way(True, min(a, b), max(a, b)), Way(True, min(c, d), max(c, d))
    way = between(then, now)
    assert way.least_mm <= now.least_mm - then.least_mm <= way.most_mm
    assert way.least_mm <= now.most_mm - then.most_mm <= way.most_mm
    assert way.known == (is_known(then) and is_known(now))


PLANS = st.booleans().flatmap(lambda near: NEAR if near else st.just(PLANNED_MM))


@st.composite
def events(draw: st.DrawFn) -> tuple[str, dict[str, Any]]:
    """A cycle or a read, mostly near the place planned, with the odometry as it mostly is."""
    name = draw(st.sampled_from((*["run_a_cycle"] * 8, *["read_a_tag"] * 6, "expect_none")))
    if name == "expect_none":
        return name, {}
    in_place = draw(st.integers(0, 2)) < 2
    way_mm = draw(st.integers(PLANNED_MM - 1_600, PLANNED_MM + 1_600) if in_place else NEAR)
    behind, ahead = draw(st.integers(-2, 5_010)), draw(st.integers(-2, 5_010))
    told = {"way_nm": NM_A_MM * way_mm, "way": Way(draw(st.integers(0, 9)) > 0, way_mm - behind, way_mm + ahead)}
    return name, told | ({"lies_nm": NM_A_MM * (way_mm + draw(st.integers(-520, 520)))} if name == "read_a_tag" else {})


def test_drawn_worlds_keep_what_is_claimed() -> None:
    seen = {"in_place": 0, "out_of_place": 0, "taken": 0, "missed": 0, "late": 0, "lost": 0}

    @given(st.lists(st.tuples(PLANS, PLANS, st.lists(events(), min_size=1, max_size=6)), max_size=8))
    @settings(max_examples=200, deadline=None, derandomize=True)
    def drawn_worlds(drawn: list[tuple[int, int, list[tuple[str, dict[str, Any]]]]]) -> None:
        play = Play(THEORY, SITE, AT_REST)
        for least_mm, most_mm, run in drawn:
            play.step("expect_a_tag", way_nm=0, least_mm=least_mm, most_mm=most_mm)
            for name, event in run:
                play.step(name, **event)
                for each in seen:
                    seen[each] += getattr(play.system, each)

    drawn_worlds()
    assert all(count > 30 for count in seen.values()), seen
