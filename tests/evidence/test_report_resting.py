"""What rests on what in the report: by the record of mutants, and by unsat cores; both ways, in any order."""

from __future__ import annotations

import json
import shutil
from pathlib import Path
from typing import Any

import pytest
from lxml import html

from evidence.report import gathering
from evidence.report.cored import RECORD, cored
from evidence.report.gathering import gathered
from evidence.report.resting import resting
from evidence.report.writing import page_of
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
