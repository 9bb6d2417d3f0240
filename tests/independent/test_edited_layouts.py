"""Importer and enumeration agree on layouts that are wrong, too: edited ones, and networks made up at random.

The layouts of ``test_verdicts.py`` are sound but for a few findings; here nearly every one has some.
"""

from __future__ import annotations

import copy
import json
import random
import tomllib
from collections import Counter
from collections.abc import Sequence
from functools import cache
from typing import Any

import pytest
import yaml

from models.layouts import BadInput, CheckResult, Imported, check, load_text
from models.layouts.generate import as_toml
from tests.independent import raw_native, raw_railjson, raw_table
from tests.independent.compare import (
    disagreements,
    enumerated_spans,
    enumerated_violations,
    imported_spans,
    listed_remarks,
)
from tests.independent.edits import NATIVE, OTHER, RAILJSON, TABLE, Edit
from tests.independent.files import OTHERS, SAMPLES, Enumerated, path_of
from tests.independent.made_up import made_up
from tests.independent.test_verdicts import needs_folder

NEVER = "a route comes to its exit"
OSRD = [name for name in OTHERS if name.startswith("osrd")]
EDITED_EACH = 60
TABLES_EDITED = 16
MADE_UP = 500


@cache
def raw(name: str) -> Any:
    text = path_of(name).read_text(encoding="utf-8")
    if name in SAMPLES:
        return tomllib.loads(text)
    return json.loads(text) if name in OSRD else yaml.safe_load(text)


def edited(name: str, edits: Sequence[Edit], chance: random.Random) -> tuple[str, dict[str, Any]]:
    """What was done, and the data afterwards."""
    while True:
        data: dict[str, Any] = copy.deepcopy(raw(name))
        done: list[str | None] = [chance.choice(edits)(data, chance)]
        if done[0] is not None and chance.random() < 0.3:
            done.append(chance.choice(edits)(data, chance))
        if None not in done:
            return "; ".join(str(one) for one in done), data


def agreed(what: str, name: str, text: str, found: Enumerated) -> CheckResult | None:
    """Import, check and compare; nothing if both say that the file is no layout."""
    rules = {violation.rule for violation in found.violations}
    imported: Imported | None = None
    refusal = ""
    try:
        imported = load_text(name, text)
    except BadInput as bad:
        refusal = str(bad)
    if imported is None:
        assert "never reaches" in refusal, what
        assert rules & {NEVER, "a route is led over its points"}, what
        return None
    assert NEVER not in rules, what
    result = check(imported)
    assert disagreements(imported, result, found) == [], what
    assert (result.verdict == "holds") == (not enumerated_violations(imported, found)), what
    remarks = Counter(tuple(sorted(set(remark.elements))) for remark in found.remarks)
    assert listed_remarks(result, found) == remarks, what
    return result


def shown(results: Sequence[CheckResult | None]) -> Counter[str]:
    """How many layouts have a violation of each rule."""
    return Counter(rule for result in results if result for rule in {v.axiom for v in result.violations})


@needs_folder
@pytest.mark.parametrize("name", OSRD)
def test_edited_railjson_is_seen_alike(name: str) -> None:
    results = []
    for number in range(EDITED_EACH):
        what, data = edited(name, RAILJSON, random.Random(f"{name} {number}"))
        results.append(agreed(f"{number}: {what}", name, json.dumps(data), raw_railjson.enumerate_data(data)))
    assert sum(shown(results).values()) >= EDITED_EACH // 6


@pytest.mark.parametrize("name", SAMPLES)
def test_edited_sample_is_seen_alike(name: str) -> None:
    results = []
    for number in range(EDITED_EACH):
        what, data = edited(name, NATIVE, random.Random(f"{name} {number}"))
        results.append(agreed(f"{number}: {what}", name, as_toml(data), raw_native.enumerate_data(data)))
    assert sum(shown(results).values()) >= EDITED_EACH // 6


@needs_folder
def test_edited_table_is_seen_alike() -> None:
    name = "swtbahn-lite.yml"
    results = []
    for number in range(TABLES_EDITED):
        what, data = edited(name, TABLE, random.Random(f"{name} {number}"))
        text = yaml.safe_dump(data, sort_keys=False)
        results.append(agreed(f"{number}: {what}", name, text, raw_table.enumerate_data(data)))
    assert sum(shown(results).values()) >= TABLES_EDITED // 2


def test_made_up_network_is_seen_alike() -> None:
    results = []
    for number in range(MADE_UP):
        data = made_up(random.Random(number))
        if data is None:
            continue
        found = raw_railjson.enumerate_data(data)
        text = json.dumps(data)
        results.append(agreed(f"network {number}", "made_up.json", text, found))
        if results[-1]:
            ours, theirs = enumerated_spans(found.network), imported_spans(load_text("made_up.json", text))
            assert sorted(map(sorted, ours.values())) == sorted(map(sorted, theirs.values())), number
    seen = shown(results)
    for rule in (
        "a release detector lies within its route",
        "a route passes a block once",
        "a route says where its train stands",
        "the tracks of a start block are told apart",
        "tags_of_a_boundary_are_partners",
        "track_leads_along_the_way_or_is_turned",
    ):
        assert seen[rule] >= 10, seen
    assert sum(1 for result in results if result and result.verdict == "holds") >= 10


@pytest.mark.parametrize("fault", [{"switches_directions": {"P": "A_B1"}}, {"release_detectors": ["far"]}])
def test_faults_of_a_route_left_out_are_told(fault: dict[str, Any]) -> None:
    ends = {"A": ("west", "END"), "B1": ("east", "BEGIN"), "B2": ("loop", "BEGIN")}
    idle: dict[str, Any] = {
        "id": "idle",
        "entry_point": {"type": "BufferStop", "id": "stop"},
        "entry_point_direction": "START_TO_STOP",
        "exit_point": {"type": "Detector", "id": "near"},
        "release_detectors": [],
        "switches_directions": {},
    }
    data = {
        "version": "3.4.12",
        "track_sections": [{"id": name, "length": 100.0} for name in ("west", "east", "loop")],
        "switches": [
            {
                "id": "P",
                "switch_type": "point_switch",
                "group_change_delay": 0.0,
                "ports": {port: {"track": track, "endpoint": end} for port, (track, end) in ends.items()},
            }
        ],
        "detectors": [
            {"id": "near", "track": "west", "position": 50.0},
            {"id": "far", "track": "east", "position": 50.0},
        ],
        "buffer_stops": [{"id": "stop", "track": "west", "position": 0.0}],
        "signals": [],
        "extended_switch_types": [],
        "routes": [
            idle | fault,
            idle
            | {
                "id": "out",
                "entry_point": {"type": "Detector", "id": "near"},
                "exit_point": {"type": "Detector", "id": "far"},
                "switches_directions": {"P": "A_B1"},
            },
        ],
    }
    found = raw_railjson.enumerate_data(data)
    assert [violation.elements[0] for violation in found.violations] == ["idle"]
    violations = check(load_text("idle.json", json.dumps(data))).violations
    assert [violation.elements[0] for violation in violations] == ["idle"]


@pytest.mark.parametrize("number", [3180, 4808])
def test_start_block_with_a_slip_that_no_position_serves(number: int) -> None:
    data = made_up(random.Random(number))
    assert data is not None
    agreed(f"network {number}", "made_up.json", json.dumps(data), raw_railjson.enumerate_data(data))


@needs_folder
def test_odd_position_behind_a_signal_that_no_row_ends_at() -> None:
    data = copy.deepcopy(raw("swtbahn-lite.yml"))
    (row,) = [row for row in data["interlocking-table"] if row["id"] == 62]
    row["points"][0]["position"] = OTHER[row["points"][0]["position"]]
    agreed("62 turned", "table.yml", yaml.safe_dump(data, sort_keys=False), raw_table.enumerate_data(data))
