"""Every guard, update and assumption is needed, or stands in the table of survivors with a class that is checked."""

from __future__ import annotations

import ast
from functools import cache

import pytest

from kernel import release, route_setting
from kernel.terminal import confirms
from proofs.lift.sources import definition_of
from proofs.mutants.classes import IMPLIED, SERVICE, Entry, objection, table
from proofs.mutants.edits import Mutant, mutants_of
from proofs.mutants.onlookers import ONLOOKERS
from proofs.mutants.targets import mutants, theories_with
from proofs.mutants.trial import tried
from proofs.witnesses.registry import WITNESSES

KILLED_IN_A_SMALL_WORLD = [
    "kernel.route_setting.conflict: guard",
    "kernel.release.release_refusal: or-operand records.record.get(left.tag) != left.record",
    "kernel.tail_evidence.note_tail_read: guard if unit.leading is None or unit.leading == cab",
    "kernel.terminal.obey: or-operand terminal.unlocked",
    "kernel.restarts.restart_centre: update lost_blocks",
    "kernel.first_loop.take_offer: or-operand run.life != unit.life",
    "models.world.on_board.tail_reads: guard if not a_healthy_line_reaches_the_tail(",
    "models.world.nature.car_leaves: guard",
    "models.world.on_board.take_permit: or-operand run not in system.radio.permits",
]
"""The beginnings of names: the first mutant so named is tried."""


def entries(kind: str) -> list[Entry]:
    return [entry for entry in table().values() if entry.kind == kind]


@cache
def first(beginning: str) -> Mutant:
    return next(mutant for name, mutant in mutants().items() if name.startswith(beginning))


def test_mutant_drops_one_thing_and_is_still_a_function() -> None:
    found = mutants_of(confirms)
    assert {mutant.text for mutant in found if mutant.kind == "and-operand"} == {
        "terminal.holds == run",
        "not terminal.unlocked",
        "is_detected",
        "detected == position",
    }
    for mutant in found:
        assert ast.unparse(mutant.tree) != ast.unparse(definition_of(confirms))


def test_every_guard_of_a_refusal_is_dropped_once() -> None:
    for function in (route_setting.conflict, release.release_refusal):
        guards = [mutant.text for mutant in mutants_of(function) if mutant.kind == "guard"]
        refusals = ast.unparse(definition_of(function))
        assert len(guards) == len(set(guards)) == refusals.count("return Refusal.") + refusals.count("return held")


def test_every_mutant_takes_part_in_a_transition_or_in_what_is_said_of_a_machine() -> None:
    idle = [mutant for mutant in mutants().values() if not theories_with(mutant)]
    assert sorted({mutant.home for mutant in idle}) == []


@pytest.mark.parametrize("beginning", KILLED_IN_A_SMALL_WORLD)
def test_dropped_guard_is_noticed(beginning: str) -> None:
    assert tried(first(beginning)).outcome in ("counterexample", "witness")


def test_a_claim_that_asks_the_kernel_for_its_word_is_broken_by_another_word() -> None:
    verdict = tried(first("kernel.authority.may_proceed: and-operand not unit.loop_open"))
    assert (verdict.outcome, verdict.finding) == ("counterexample", "a_train_astray_has_no_authority")


def test_what_compares_places_is_decided_in_a_small_world() -> None:
    verdict = tried(first("kernel.first_loop.give_back: or-operand held_end_mm > start_end_mm"))
    assert (verdict.outcome, verdict.finding) == ("counterexample", "what_is_given_back_is_not_entered")


def test_no_entry_speaks_of_a_mutant_that_is_no_more() -> None:
    assert [name for name in table() if name not in mutants()] == []
    assert entries(SERVICE)
    assert entries(IMPLIED)


@pytest.mark.parametrize("name", [name for name in ONLOOKERS if name not in WITNESSES])
def test_service_is_there_while_no_guard_is_dropped(name: str) -> None:
    assert ONLOOKERS[name]({}).taken


@pytest.mark.sampled(14)
@pytest.mark.parametrize("entry", entries(SERVICE), ids=lambda entry: entry.mutant[:80])
def test_every_guard_kept_for_service_has_a_witness_that_fails_without_it(entry: Entry) -> None:
    assert objection(entry) == ""


@pytest.mark.sampled(28)
@pytest.mark.parametrize("entry", entries(IMPLIED), ids=lambda entry: entry.mutant[:80])
def test_implied_guard_makes_no_difference_on_any_layout(entry: Entry) -> None:
    assert objection(entry) == ""
