"""What rests on what in the report: by the record of mutants, and by unsat cores; both ways, in any order."""

from __future__ import annotations

import json
import shutil
from itertools import pairwise
from pathlib import Path
from typing import Any

import pytest
from lxml import html

from evidence.report import gathering
from evidence.report.chained import drawn_chain
from evidence.report.cored import RECORD, cored
from evidence.report.gathering import gathered
from evidence.report.resting import resting
from evidence.report.writing import page_of
from proofs.chain import chain
from tests.evidence.samples import COMMIT, OF, mutated, write

GUARD = "kernel.onboard.braking.supervise: not safe"


def core(row: str, invariant: str, *guards: str, updates: tuple[str, ...] = ()) -> dict[str, Any]:
    return {
        "transition": row,
        "invariant": invariant,
        "hypotheses": [invariant],
        "guards": [*guards],
        "updates": [*updates],
        "parts": 1,
        "open": 0,
    }


def cores() -> dict[str, Any]:
    return {
        "obligations": [
            core("braking.run_a_cycle", "head_stays_inside_authority", GUARD, updates=("brake",)),
            core("braking.run_a_cycle", "the_response_ends"),
        ],
        "guards": {"braking.run_a_cycle": [GUARD, "models.onboard.braking.run_a_cycle: 0 <= gain"]},
        "updates": {"braking.run_a_cycle": ["brake", "head_nm"]},
        "unnamed": 0,
        "minimal": False,
        "seconds": 1.0,
        **OF,
    }


def test_a_drop_breaks_what_the_counterexample_says_or_an_invariant_is_not_seen_to_rest_on_it() -> None:
    killed, classed = mutated()["mutants"]
    seen = {
        **killed,
        "mutant": "kernel.a.b: guard c",
        "outcome": "witness",
        "by": "it_brakes",
        "finding": "AssertionError",
    }
    raised = {**killed, "mutant": "kernel.a.b: guard d", "finding": "KeyError 1 in file.py:3"}
    found = resting([killed, classed, seen, raised])
    assert [(each.function, each.breaks) for each in found.drops if each.carries] == [
        ("kernel.a.b", ("braking.every_lookup_is_defined",)),
        ("kernel.onboard.braking.supervise", ("braking.head_stays_inside_authority",)),
    ]
    assert [each.what for each in found.by_invariant["braking.head_stays_inside_authority"]] == ["or-operand not safe"]
    assert [(each.fails, each.kept_as) for each in found.idle] == [("it_brakes", ""), ("", "service")]
    assert resting([raised, seen, classed, killed]).drops == found.drops


def test_cores_are_read_both_ways_in_any_order() -> None:
    found = cored(cores())
    assert found.by_guard == {GUARD: {"braking.head_stays_inside_authority": 1}}
    assert found.by_invariant["braking.head_stays_inside_authority"].guards == {GUARD: ["braking.run_a_cycle"]}
    assert found.by_invariant["braking.the_response_ends"].updates == {}
    assert [*found.idle] == ["models.onboard.braking.run_a_cycle: 0 <= gain"]
    assert found.idle_updates == {"braking.run_a_cycle": ["head_nm"]}
    other = cores()
    other["obligations"].reverse()
    assert cored(other) == found


def test_the_page_has_both_tables_and_only_of_its_own_commit(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(gathering, "commit", lambda: COMMIT)
    folder = write(tmp_path / "out")
    (folder / RECORD).write_text(json.dumps(cores()), "utf-8")
    page: Any = html.fromstring(page_of(gathered(folder)))
    proof = " ".join(page.get_element_by_id("inv-braking.head_stays_inside_authority").text_content().split())
    assert "guards onboard.braking.supervise: not safe over braking.run_a_cycle" in proof
    assert "supervise or-operand not safe over braking.run_a_cycle" in proof
    assert page.get_element_by_id("cores").getnext().text_content().startswith("Z3 is given every hypothesis")
    drop = page.get_element_by_id("drop-kernel.onboard.braking.supervise")
    assert "#inv-braking.head_stays_inside_authority" in [each.get("href") for each in drop.iter("a")]
    other = tmp_path / "other"
    shutil.copytree(folder, other)
    (other / RECORD).write_text(json.dumps({**cores(), "commit": "f" * 40}), "utf-8")
    assert gathered(other).cored is None


def joints() -> dict[str, Any]:
    def guarantee(became: str, *as_well: str) -> dict[str, Any]:
        cell = {"row": "train.run_a_cycle", "column": "there_is_one_train", "guarantee": f"it_is_{became}"}
        return {
            **cell,
            "became": became,
            "by": "there_is_one_train",
            "as_well": [*as_well],
            "open_with": [],
            "asked": 9,
        }

    def assumption(name: str, became: str) -> dict[str, Any]:
        return {"assumption": name, "became": became, "by": "braking.run_a_cycle", "finding": "it_stops"}

    return {
        "verdict": "does not hold",
        "guarantees": [guarantee("needed", "another_says_so"), guarantee("unneeded")],
        "assumptions": [assumption("braking.the_brake_slows", "needed"), assumption("split.idle", "open")],
        "of": {"guarantees": 3, "assumptions": 4},
        "by_name": [],
        "seconds": 1.0,
        **OF,
    }


def test_joints_are_told_with_what_is_not_needed_and_what_is_open(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(gathering, "commit", lambda: COMMIT)
    folder = write(tmp_path / "out")
    (folder / "joints.json").write_text(json.dumps(joints()), "utf-8")
    page: Any = html.fromstring(page_of(gathered(folder)))
    told = " ".join(page.text_content().split())
    assert "split.idle: nothing was seen to fall without it" in told
    assert "it_is_unneeded for there_is_one_train over train.run_a_cycle: proved without it" in told
    assert "another_says_so" in told
    assert "it_stops over braking.run_a_cycle" in told
    (folder / "joints.json").write_text(json.dumps({**joints(), "commit": "f" * 40}), "utf-8")
    assert gathered(folder).joints == {}


def test_the_chain_is_drawn_with_each_theory_once_and_each_link_as_it_is_tied() -> None:
    """But for a link on which nothing rests: what is assumed there stands beside the theorem."""
    found = chain(())
    drawing = drawn_chain(found, {})
    assert sorted(node.title.partition(":")[0] for node in drawing.nodes) == sorted(found.links)
    assert {node.came for node in drawing.nodes} == {"not shown"}
    joints_of = {(link.guaranteed, link.tie) for links in found.links.values() for link in links if link.guaranteed}
    assert len(drawing.ties) >= len(joints_of)
    said = " ".join(line for tie in drawing.ties for _, line in tie.lines)
    for links in found.links.values():
        for link in links:
            if link.guaranteed:
                assert (link.assumption.partition(".")[2] in said) is link.rested_on
    drawn = {tie.kind: " ".join(line for _, line in tie.lines) for tie in drawing.ties}
    assert "tied by name alone" in drawn["name"]
    assert "is the function that is proved" in drawn["function"]
    for one, other in pairwise(sorted(drawing.nodes, key=lambda node: node.y)):
        assert one.y + one.height <= other.y
    assert all(node.x + node.width <= drawing.width for node in drawing.nodes)
    assert drawing.height / drawing.width < 1.45, "it fits a page of A4"
