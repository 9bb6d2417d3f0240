"""`heisoku mutate --joints`: a guarantee between machines, or an assumption, is needed, not needed, or open."""

from __future__ import annotations

import ast
import json
import re
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest
import typer

from proofs import assumptions
from proofs.catalogue import STEPS
from proofs.chain import chain
from proofs.counterexample import Unfaithful
from proofs.lift.sources import definition_of
from proofs.mutants import assumed, built_in, command, guarantees, joints
from proofs.mutants.guarantees import Use
from proofs.mutants.trial import MILLISECONDS, world
from proofs.theories import THEORIES

FEW = "^(joint.(head_passes|unit_changes|cars_move)|braking|tag_window|link)[. ]"
"""What is quickly tried; the whole is `make joints`."""
HEADS_BLOCK = Use("joint.unit_changes", "a_head_that_can_leave_obeys_its_authority", "the_heads_block_is_listed")


def run(*arguments: str) -> int:
    app = typer.Typer()
    app.command()(command.mutate)
    app.command("idle")(lambda: None)
    return int(app(["mutate", "--jobs", "1", "--joints", *arguments], standalone_mode=False) or 0)


def test_a_sample_is_needed_and_right(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    target = tmp_path / "joints.json"
    assert run("--only", FEW, "--sample", "12", "--json", str(target)) == 0
    found = json.loads(target.read_text("utf-8"))
    assert found["verdict"] == "holds"
    assert found["commit"]
    assert len(found["guarantees"]) + len(found["assumptions"]) == 12
    assert found["guarantees"]
    assert found["assumptions"]
    assert found["of"] == {"guarantees": len(guarantees.uses()), "assumptions": len(assumed.names())}
    for each in (*found["guarantees"], *found["assumptions"]):
        assert each["became"] == "needed"
    told = capsys.readouterr().out
    assert f"{len(found['assumptions'])} of {len(assumed.names())} assumptions" in told
    assert "needed and right: holds" in told


def test_a_use_is_of_an_invariant_that_a_script_names_and_that_is_not_its_own_claim() -> None:
    found = guarantees.uses()
    assert {each.row.partition(".")[0] for each in found} == set(guarantees.COMPOSED)
    for each in found:
        invariants = THEORIES[each.row.partition(".")[0]].invariants
        assert each.guarantee in invariants
        assert each.guarantee not in (each.column, *each.base, *each.others)
        assert {each.guarantee, *each.base, *each.others} >= set(invariants)


def test_a_guarantee_without_which_the_claim_is_proved_is_told_as_unneeded() -> None:
    found = guarantees.tried(Use("joint.unit_changes", HEADS_BLOCK.column, "every_list_follows_its_way"))
    assert found.without == "proved"
    assert not found.open_with


def test_another_invariant_that_does_as_well_is_proved_to() -> None:
    found = guarantees.tried(HEADS_BLOCK)
    assert found.without == "refuted"
    assert found.as_well == [HEADS_BLOCK.column]
    assert guarantees.proved(HEADS_BLOCK, [*HEADS_BLOCK.base, HEADS_BLOCK.column])
    assert not guarantees.proved(HEADS_BLOCK, HEADS_BLOCK.base)


def test_what_stands_in_a_guarantees_place_looks_up_nothing_that_is_not_there() -> None:
    """The row `reading` proves so; without that a state in which it only seems to hold would stand against it."""
    use = Use("joint.cars_move", "a_train_keeps_out_of_what_its_brake_holds_it_from", "no_car_came_under_a_run_ahead")
    instead = "every_list_tells_the_track"
    assert instead in guarantees.tried(use).as_well
    assert guarantees.proved(use, [*use.base, instead], instead)
    assert not guarantees.proved(use, [*use.base, instead])


def test_what_is_unknown_refutes_nothing(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(guarantees, "SPENDING", 1)
    monkeypatch.setattr(guarantees, "proved", lambda *_: False)
    monkeypatch.setattr(joints, "uses", lambda: {HEADS_BLOCK.name: HEADS_BLOCK})
    name, told = joints.trial(HEADS_BLOCK.name)
    assert (name, told["became"], told["without"]) == (HEADS_BLOCK.name, "open", "open")
    assert set(told["open_with"]) == set(HEADS_BLOCK.others)


def test_what_is_not_found_in_the_context_of_all_questions_is_found_apart(monkeypatch: pytest.MonkeyPatch) -> None:
    asked, broken = list[bool](), guarantees.Questions.broken

    def apart_alone(self: guarantees.Questions, use: Use, names: list[str], defined: bool, apart: bool) -> Any:
        asked.append(apart)
        return broken(self, use, names, defined, apart) if apart else None

    monkeypatch.setattr(guarantees.Questions, "broken", apart_alone)
    found = guarantees.tried(HEADS_BLOCK)
    assert (found.without, found.as_well, found.open_with) == ("refuted", [HEADS_BLOCK.column], [])
    assert {*asked} == {True, False}


def test_a_step_that_nobody_confirms_in_cpython_refutes_nothing(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(guarantees.Questions, "replayed", lambda *_: None)
    monkeypatch.setattr(guarantees, "proved", lambda *_: False)
    assert guarantees.tried(HEADS_BLOCK).without == "open"


def test_an_assumption_is_dropped_in_the_worlds_of_the_parts_as_well() -> None:
    found = assumed.tried("train.the_train_gains_no_more")
    assert found.became == "falls"
    assert "the_front_stays_before_the_end" in found.finding


def test_what_falls_beside_the_chain_is_no_fall_of_the_theorem(monkeypatch: pytest.MonkeyPatch) -> None:
    assert assumed.tried("link.clocks_agree_within_the_bound").became == "falls"
    monkeypatch.setattr(assumed, "in_the_chain", lambda _: frozenset[str]())
    assert assumed.tried("link.clocks_agree_within_the_bound").became == "open"


def test_what_is_built_into_the_world_is_left_out_of_each_step_that_it_is_said_to_stand_in() -> None:
    said = {each.name: list(each.stands_in) for each in assumptions.read() if each.kind == "built_in"}
    assert {name: list(dict.fromkeys(drop.step for drop in each)) for name, each in built_in.drops().items()} == said
    assert all(drop.sources for each in built_in.drops().values() for drop in each)


def test_every_step_that_goes_on_by_a_message_is_said_to_take_it_for_genuine() -> None:
    """But the second person's word, which is asked for only after the first one's, and is no message then."""
    going_on = set[str]()
    for name, step in STEPS.items():
        for node in ast.walk(definition_of(step)):
            asked = node.test if isinstance(node, ast.If) else node.value if isinstance(node, ast.Assign) else None
            if asked is not None and re.search(r"(in|^) ?system\.radio\.\w+(\.get|\b(?! \|))", ast.unparse(asked)):
                going_on.add(name)
    said = {drop.step for drop in built_in.drops()["messages_are_genuine"]}
    assert {name for name in going_on if not name.startswith("send_")} - {"head_reads", "tail_reads"} == said | {
        "confirm_statement"
    }


@pytest.mark.parametrize("name", ["a_locked_point_stays", "the_register_is_complete", "trains_start_apart"])
def test_what_is_built_into_the_world_makes_a_claim_fall_wherever_it_is_left_out(name: str) -> None:
    found, drops = assumed.tried(f"interlocking.{name}"), built_in.drops()[name]
    assert found.became == "falls"
    assert found.by == ", ".join(each.step for each in drops)
    fallen = [each.split(", ") for each in found.finding.split("; ")]
    assert len(fallen) == len(drops)
    assert {each for some in fallen for each in some} <= assumed.in_the_chain("interlocking")


def test_what_is_left_out_of_a_step_where_nothing_falls_is_not_needed_there(monkeypatch: pytest.MonkeyPatch) -> None:
    small = world("small")
    monkeypatch.setattr(assumed, "world", lambda _: small)
    idle = replace(built_in.drops()["a_locked_point_stays"][0], new="if True:", step="drift")
    needed = built_in.drops()["trains_start_apart"][0]
    monkeypatch.setattr(assumed, "drops", lambda: {"a_locked_point_stays": [needed, idle]})
    found = assumed.tried("interlocking.a_locked_point_stays")
    assert (found.became, found.by) == ("none", "drift")


def test_a_start_said_as_it_is_makes_nothing_fall() -> None:
    assert built_in.fallen_at_the_start(world("small"), {}, MILLISECONDS["small"]) == ("none", "")


def test_a_start_that_cpython_sees_otherwise_makes_nothing_fall(monkeypatch: pytest.MonkeyPatch) -> None:
    drop = built_in.drops()["trains_start_apart"][0]
    monkeypatch.setattr(built_in, "unmet", lambda *_: [])
    with pytest.raises(Unfaithful):
        built_in.fallen_at_the_start(world("small"), drop.sources, MILLISECONDS["small"])


def test_what_is_said_to_stand_beside_the_theorem_is_proved_to(monkeypatch: pytest.MonkeyPatch) -> None:
    """Of one claim, which is quick; of every claim of the chain in `make joints`."""
    name = "interlocking.a_tag_is_read_where_it_lies"
    assert assumed.beside_the_theorem() == [name]
    monkeypatch.setattr(assumed, "in_the_chain", lambda _: frozenset({"a_head_that_read_a_tag_was_there"}))
    assert joints.trial(name)[1]["became"] == "beside"
    monkeypatch.setattr(assumed, "proved_without", lambda _: False)
    assert joints.trial(name)[1]["became"] == "open"


def test_what_a_claim_rests_on_is_not_proved_without_it(monkeypatch: pytest.MonkeyPatch) -> None:
    claim = "a_run_that_has_begun_is_led_by_its_front"
    monkeypatch.setattr(assumed, "in_the_chain", lambda _: frozenset({claim}))
    assert not assumed.proved_without("a_run_is_led_by_its_front")


def test_every_assumption_that_the_chain_rests_on_is_tried() -> None:
    assert set(chain().nature) <= set(assumed.names())
    assert set(chain().idle) & set(assumed.names()) == set(assumed.beside_the_theorem())


def test_an_axiom_that_says_what_can_be_read_falls_where_all_else_can_be(monkeypatch: pytest.MonkeyPatch) -> None:
    small = world("small")
    monkeypatch.setattr(assumed, "world", lambda _: small)
    found = assumed.tried("interlocking.every_map_has_its_keys")
    assert found.became == "falls"


def told(*became: str) -> dict[str, Any]:
    return {"guarantees": [{"became": each} for each in became], "assumptions": []}


@pytest.mark.parametrize(
    ("became", "code"),
    [((), 3), (("needed",), 0), (("needed", "beside"), 0), (("needed", "open"), 3), (("open", "unneeded"), 1)],
)
def test_what_is_not_needed_is_1_and_what_is_open_3(became: tuple[str, ...], code: int) -> None:
    assert joints.exit_code(told(*became)) == code


def test_bad_usage_is_one_line_and_code_2(capsys: pytest.CaptureFixture[str]) -> None:
    assert run("--only", "no such joint") == 2
    assert len(capsys.readouterr().err.splitlines()) == 1
