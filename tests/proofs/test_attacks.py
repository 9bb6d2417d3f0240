"""Each attack on ring, figure of eight and real layouts: refused or braked, and without its guard it ends badly.

A real layout is one from a public repository.  ``swtbahn-lite.yml`` has a loop, and every attack is played on it;
on the others track leads from end to end, and no train comes back to a block from behind, so the two attacks that
need a loop cannot be.  ``osrd-circle_infra.json`` is a ring, but without a single route: the importer refuses it.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import cache

import pytest

from models.layouts import load
from models.simulator.play import site_of
from proofs.drawing import fitting
from proofs.mutants.edits import named
from proofs.mutants.steps import stepped
from proofs.mutated import running, table_running
from proofs.onboard.witnesses import on_lines as in_mm
from proofs.planted import carried, kilometrage
from proofs.planted.attacked import UNGUARDED
from proofs.planted.weakenings import GIVEN_BACK_TOO_EARLY, OVER_ITSELF, TURNED_ASTRIDE, WEAKENINGS
from proofs.witnesses.lines import LINES, Line, line_of, line_on
from proofs.witnesses.on_lines import ATTACKS
from proofs.witnesses.registry import WITNESSES
from proofs.witnesses.scenario import STEPS as ALL_STEPS
from proofs.witnesses.scenario import WitnessFailed
from proofs.witnesses.stations import CARS, T1
from tests.layouts.stations import SHARED, needs_shared

WITH_A_LOOP = ("swtbahn-lite.yml",)
WITHOUT = ("osrd-small_infra.json", "gicsafe-5.railml")
REAL = (*WITH_A_LOOP, *WITHOUT)
AUTHORITY = "a_head_that_can_leave_obeys_its_authority"


@cache
def real(name: str) -> Line:
    """Where the attacks are played on a layout that nobody here drew, by way of the importer."""
    imported = load(SHARED / name)
    return line_of(name, site_of(imported.layout, imported.ground, imported.records, CARS))


def place(name: str) -> Line:
    """A station made for the attacks, or a real layout."""
    return line_on(name) if name in LINES else real(name)


def on_every_layout(loop_only: bool) -> list[object]:
    """The stations, and the real layouts where they are present; of these those with a loop, if one is needed."""
    there = WITH_A_LOOP if loop_only else REAL
    return [*LINES, *(pytest.param(name, marks=needs_shared) for name in there)]


def pairs(chosen: list[tuple[str, bool]]) -> list[object]:
    """Each attack with each layout that has the track for it."""
    return [
        pytest.param(name, where.values[0] if hasattr(where, "values") else where, marks=getattr(where, "marks", ()))
        for name, loop_only in chosen
        for where in on_every_layout(loop_only)
    ]


WATCHED = {
    "a_head_that_has_come_round_keeps_its_block": OVER_ITSELF,
    "a_run_that_another_leads_on_from_is_asked_back_last": (
        "kernel.cancellation.cancel_refusal: guard if leads_on(layout, centre, run): Refusal.A_RUN_LEADS_ON"
    ),
    "a_way_back_is_set_once_the_way_in_is_clear": OVER_ITSELF,
}
"""Attacks that end without harm even without the guard: a run is lost, the loop opens, or another run still holds.

That a train as long as its loop frees nothing under its own run is refuted by a step of the proof.
"""

BY_NAME = {each.fault.name: each for each in UNGUARDED}
PLAYED = pairs([(name, attack.on_a_loop) for name, attack in ATTACKS.items()])
DROPPED = pairs([(name, each.attack.on_a_loop) for name, each in BY_NAME.items()])


@pytest.mark.parametrize(("name", "where"), PLAYED)
def test_an_attack_ends_in_a_refusal(name: str, where: str) -> None:
    played = ATTACKS[name].played(place(where), ALL_STEPS)
    assert any(taken.accepted for taken in played.taken)
    assert not all(taken.accepted for taken in played.taken)


@pytest.mark.parametrize(("name", "where"), DROPPED)
def test_without_its_guard_it_ends_badly_and_with_it_not(name: str, where: str) -> None:
    unguarded, line = BY_NAME[name], place(where)
    trace = unguarded.trace(line)
    assert unguarded.broken in trace.broken
    assert all(unguarded.broken not in move.broken for move in trace.moves[:-1])
    assert not any(move.broken for move in unguarded.trace(line, {}).moves)


@pytest.mark.parametrize("where", on_every_layout(False))
@pytest.mark.parametrize("attack", in_mm.ATTACKS, ids=lambda attack: attack.__name__)
def test_an_attack_in_millimetres_ends_in_a_braked_train(attack: Callable[[Line], in_mm.OnLine], where: str) -> None:
    assert attack(place(where)).system.does_as_assumed == {T1: True}


@pytest.mark.parametrize("where", on_every_layout(False))
def test_without_its_guard_a_train_too_near_its_end_gives_the_run_back(where: str) -> None:
    line = place(where)
    with running(GIVEN_BACK_TOO_EARLY.sources), pytest.raises(AssertionError):
        in_mm.a_train_too_near_its_end_gives_nothing_back(line)


@pytest.mark.parametrize(("name", "where"), pairs([(name, ATTACKS[name].on_a_loop) for name in WATCHED]))
def test_without_a_guard_that_frees_nothing_the_witness_fails(name: str, where: str) -> None:
    steps = table_running(ALL_STEPS, named(WATCHED[name]).sources)
    with pytest.raises(WitnessFailed):
        ATTACKS[name].played(place(where), steps)


@pytest.mark.parametrize("where", on_every_layout(False))
def test_without_its_guard_the_end_is_carried_over_what_is_nobodys(where: str) -> None:
    found = carried.asked(place(where))
    assert found is not None
    assert AUTHORITY in found.false
    assert carried.asked(place(where), {}) is None
    with running(carried.CARRIED.sources), pytest.raises(AssertionError, match=AUTHORITY):
        in_mm.a_run_set_ahead_carries_no_end_over_what_is_nobodys(place(where))


def test_the_joint_is_refuted_without_that_guard_and_the_same_step_is_safe_with_it() -> None:
    found = carried.refuted()
    assert found is not None
    assert AUTHORITY in found.false
    assert stepped(found.row, found.site, found.before, found.event, {}) is None


@pytest.mark.parametrize("where", LINES)
def test_a_drawing_in_millimetres_shows_claim_head_and_end(where: str) -> None:
    found = carried.asked(line_on(where))
    assert found is not None
    text = kilometrage.as_text(carried.CARRIED.name, carried.CARRIED.story, found)
    page = kilometrage.as_html(carried.CARRIED.name, carried.CARRIED.story, found)
    for shown in (text, page):
        assert AUTHORITY in shown
        assert "end of authority" in shown
        assert f"{found.before.head_mm['T1']} mm" in shown
        assert f"{found.after.brake['T1'].end_mm} mm" in shown
    assert page.count("<svg") == 2


def test_a_box_says_how_many_notes_it_has_no_room_for() -> None:
    notes = [f"held for run {number}" for number in range(9)]
    assert fitting(notes[:7]) == notes[:7]
    assert fitting(notes) == [*notes[:6], "and 3 more"]


@needs_shared
@pytest.mark.parametrize("name", REAL)
def test_a_real_layout_has_a_loop_or_has_none(name: str) -> None:
    assert (real(name).loop is not None) == (name in WITH_A_LOOP)


@pytest.mark.parametrize("kept", TURNED_ASTRIDE.dropped)
@pytest.mark.parametrize("where", LINES)
def test_each_guard_against_turning_astride_stops_it_alone(kept: str, where: str) -> None:
    sources = {
        name: tree for each in TURNED_ASTRIDE.dropped if each != kept for name, tree in named(each).sources.items()
    }
    assert not BY_NAME[TURNED_ASTRIDE.name].trace(line_on(where), sources).broken


def test_each_attack_stands_among_the_witnesses_on_each_station() -> None:
    expected = {f"on_{where}_{name}" for where in LINES for name in ATTACKS}
    assert {name for name in WITNESSES if name.startswith("on_")} == expected


def test_every_fault_of_an_attack_is_refuted_among_the_planted_ones() -> None:
    assert all(each.fault in [*WEAKENINGS, TURNED_ASTRIDE] for each in UNGUARDED)
