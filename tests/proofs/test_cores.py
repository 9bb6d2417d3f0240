"""Unsat cores with every guard and update named: what a proof rests on, and what it does not."""

from __future__ import annotations

import pytest
import z3

from proofs import cores, scripts
from proofs.cores import Notes, core_of, guards_of, named_core, noting, updates_of
from proofs.run import bench
from proofs.search import NARROW, core
from proofs.workbench import Part

ROW, COLUMN = "request", "no_conflicting_routes"
CONFLICT = "kernel.claims.held_refusal: any("


@pytest.fixture(scope="module")
def notes() -> Notes:
    lifted = bench("interlocking")
    lifted._ways.pop(ROW, None)
    found = Notes()
    with noting(found):
        lifted.ways(ROW)
    return found


def test_a_proof_names_the_guards_it_rests_on(notes: Notes) -> None:
    found = core_of(ROW, COLUMN, notes)
    assert found["open"] == 0
    assert found["parts"] == 2
    assert found["hypotheses"] == sorted({"fouling_is_mutual", COLUMN})
    assert [guard.startswith(CONFLICT) and "other.train != train" in guard for guard in found["guards"]] == [True] * 2
    assert "centre.claimed" in found["updates"]


def test_what_a_transition_leaves_alone_needs_neither_guard_nor_update(notes: Notes) -> None:
    found = core_of(ROW, "no_two_trains_in_a_block", notes)
    assert (found["guards"], found["updates"]) == ([], [])
    assert found["hypotheses"] == ["no_two_trains_in_a_block"]


def test_without_a_guard_of_its_core_a_proof_is_open(notes: Notes) -> None:
    lifted = bench("interlocking")
    (way,) = lifted.ways(ROW)
    guards, updates = guards_of(way, notes, ROW)[0], updates_of(way)
    part = lifted.parts(ROW, COLUMN, scripts.hypotheses(ROW, COLUMN))[0]
    names = named_core(part, guards, updates)
    assert names is not None
    (needed,) = (name.removeprefix("guard ") for name in names if name.startswith("guard "))
    assert named_core(part, {name: said for name, said in guards.items() if name != needed}, updates) is None
    with_it = {name: said for name, said in guards.items() if name == needed}
    assert named_core(part, with_it, updates) is not None


def test_every_piece_of_a_condition_has_a_text_that_stands_in_the_source(notes: Notes) -> None:
    (way,) = bench("interlocking").ways(ROW)
    guards, unnamed = guards_of(way, notes, ROW)
    assert unnamed == 0
    assert len(guards) > 10
    assert {name.split(": ")[0] for name in guards} >= {"kernel.route_setting.conflict"}
    whole = z3.And(*(piece for pieces in guards.values() for piece in pieces))
    part = Part({"guards": [whole]}, [], way.condition)
    assert core(part, None, NARROW) == ["guards"]


def test_it_tells_how_much_was_asked(capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("sys.argv", ["cores", "--only", "no such row"])
    assert cores.main() == 3
    assert capsys.readouterr().out.startswith("0 obligations, 0 parts")


def test_each_way_of_a_theory_of_arithmetic_has_a_core_of_its_own() -> None:
    """Ways of which one question is asked have their guards apart; what none changes needs no guard."""
    row, column = "train.take_end", "the_brake_takes_the_wanted_end_or_stays_applied"
    lifted, notes = bench("train"), Notes()
    lifted._ways.pop("take_end", None)
    with noting(notes):
        ways = lifted.ways("take_end")
    hypotheses = scripts.hypotheses(row, column)
    (any_part, *_) = lifted.parts("take_end", column, hypotheses)
    supposed = {each.get_id() for formulas in any_part.hypotheses.values() for each in formulas}
    changed = [goal for way in ways for goal in lifted.claim(way.after, column) if goal.get_id() not in supposed]
    assert len({goal.get_id() for goal in changed}) < len(changed), "several ways make the same of it"
    found = core_of(row, column, notes)
    assert found["open"] == 0
    assert found["parts"] >= len(changed)
    assert found["guards"]
    assert set(found["hypotheses"]) <= set(hypotheses)
