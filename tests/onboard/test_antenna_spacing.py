"""The spacing of head and tail antenna, at its edges and in drawn worlds (T13, T3)."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from kernel.onboard import antenna_spacing as machine
from kernel.onboard.antenna_spacing import Spacing
from kernel.onboard.way import UNKNOWN, Way
from models.onboard.units import NM_A_MM
from proofs.onboard.antenna_spacing import THEORY
from proofs.onboard.witnesses.antenna_spacing import ANTENNA_MM, APART_MM, JUST_STARTED, SITE, WITNESSES, front_nm
from proofs.onboard.witnesses.play import Play

LIMITS = SITE.limits
TAGS_MM = 50_000


def at(place_mm: int) -> Way:
    return Way(True, place_mm, place_mm)


def over(spacing: Spacing, uid: int, place_mm: int, apart_mm: int) -> Spacing:
    """Head and tail pass a tag, so far apart."""
    spacing = machine.note_head_read(spacing, uid, at(place_mm))
    return machine.note_tail_read(LIMITS, spacing, uid, at(place_mm + apart_mm))


@pytest.mark.parametrize("witness", WITNESSES)
def test_witness(witness: Callable[[], None]) -> None:
    assert witness.__doc__
    witness()


@pytest.mark.parametrize(
    ("off_mm", "healthy"),
    [(0, True), (1_013, True), (-1_013, True), (1_014, False), (-1_014, False), (-APART_MM, False), (-60_000, False)],
)
def test_the_tolerance_is_the_limit(off_mm: int, healthy: bool) -> None:
    spacing = over(machine.preset(APART_MM), 1, 0, APART_MM + off_mm)
    assert machine.is_healthy(spacing) == healthy
    assert spacing.broken == (not healthy)


def test_the_head_read_of_longest_ago_is_forgotten() -> None:
    """A ninth tag within one train: the first cannot be compared any more, and does not count."""
    spacing = machine.preset(APART_MM)
    for uid in range(1, 10):
        spacing = machine.note_head_read(spacing, uid, at(uid))
    forgotten = machine.note_tail_read(LIMITS, spacing, 1, at(1 + APART_MM))
    assert not machine.is_healthy(forgotten)
    assert not forgotten.broken
    assert machine.is_healthy(machine.note_tail_read(LIMITS, forgotten, 2, at(2 + APART_MM)))


def test_the_newest_of_two_head_reads_of_a_tag_counts() -> None:
    spacing = machine.preset(APART_MM)
    for uid, place_mm in ((1, 0), (2, 50), (1, 500)):
        spacing = machine.note_head_read(spacing, uid, at(place_mm))
    assert machine.place_of_read(spacing.reads, 1) == at(500)


def test_number_zero_is_a_number_like_any_other() -> None:
    spacing = machine.preset(APART_MM)
    assert not machine.is_healthy(machine.note_tail_read(LIMITS, spacing, 0, at(APART_MM)))
    assert machine.is_healthy(over(spacing, 0, 0, APART_MM))


def test_an_odometer_that_stands_still_breaks_the_line() -> None:
    assert over(machine.preset(APART_MM), 1, 0, 0).broken


def test_a_restarted_line_is_not_healthy_whatever_it_reads() -> None:
    for apart_mm in (0, APART_MM):
        assert not machine.is_healthy(over(machine.restarted(), 1, 0, apart_mm))


def test_an_odometer_lost_in_between_proves_nothing() -> None:
    spacing = machine.note_head_read(over(machine.preset(APART_MM), 1, 0, APART_MM), 2, at(300_000))
    spacing = machine.note_tail_read(LIMITS, spacing, 2, UNKNOWN)
    assert not machine.is_healthy(spacing)
    assert machine.is_healthy(over(spacing, 3, 500_000, APART_MM))


@st.composite
def events(draw: st.DrawFn) -> tuple[str, dict[str, Any]]:
    name = draw(st.sampled_from((*["read"] * 30, "run", "come_apart", "come_apart", "preset", "turn", "restart")))
    if name == "read":
        off, known = draw(st.integers(-256, 256)), draw(st.integers(0, 19)) > 0
        behind, ahead = draw(st.integers(-2, 1_050)), draw(st.integers(-2, 1_050))
        return name, {"off": off, "known": known, "behind": behind, "ahead": ahead}
    apart = draw(st.sampled_from((APART_MM, APART_MM, 60_000, 121_000, 119_000, 600, 0, -APART_MM)))
    drawn: dict[str, dict[str, Any]] = {
        "run": {"to_nm": front_nm(draw(st.integers(-300_000, 300_000)))},
        "come_apart": {"apart_nm": NM_A_MM * apart},
        "preset": {"preset_mm": draw(st.sampled_from((APART_MM, APART_MM + 500, APART_MM - 500, 60_000, 600)))},
        "turn": {"front_nm": front_nm(draw(st.integers(-300_000, 300_000)))},
        "restart": {},
    }
    return name, drawn[name]


def test_drawn_worlds_keep_what_is_claimed() -> None:
    """Tags lie 50 m apart, history looks at one; whichever antenna comes to its next one first reads it.

    So many worlds, as Hypothesis draws other numbers whenever other modules are loaded: a third catches nearly enough.
    """
    seen = {"healthy": 0, "caught": 0}

    @given(st.sampled_from((-150_000, -100_000, -50_000)), st.lists(events(), min_size=10, max_size=40))
    @settings(max_examples=900, deadline=None, derandomize=True)
    def drawn_worlds(tag: int, drawn: list[tuple[str, dict[str, Any]]]) -> None:
        play = Play(THEORY, replace(SITE, tag=tag), JUST_STARTED)
        play.step("preset", preset_mm=APART_MM)
        for name, event in drawn:
            if name != "read":
                play.step(name, **event)
                continue
            head_mm = play.system.front_nm // NM_A_MM - ANTENNA_MM
            apart_mm = play.system.apart_nm // NM_A_MM
            ways_mm = {
                antenna: TAGS_MM - (head_mm - behind_mm + 300) % TAGS_MM
                for antenna, behind_mm in (("head", 0), ("tail", apart_mm))
            }
            antenna = min(ways_mm, key=lambda name: ways_mm[name])
            behind_mm = apart_mm if antenna == "tail" else 0
            uid = head_mm + 300 + ways_mm[antenna] - behind_mm
            place_mm = uid + event["off"] + behind_mm
            play.step("run", to_nm=front_nm(place_mm))
            front_mm = place_mm + ANTENNA_MM
            told = Way(event["known"], front_mm - event["behind"], front_mm + event["ahead"])
            play.step(f"{antenna}_reads", uid=uid, at=told)
            seen["healthy"] += machine.is_healthy(play.system.spacing)
            seen["caught"] += play.system.caught

    drawn_worlds()
    assert all(count > 100 for count in seen.values()), seen
