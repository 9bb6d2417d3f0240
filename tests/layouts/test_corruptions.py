"""Single-edit corruptions of good layouts are all found, and found by element."""

from __future__ import annotations

import copy
import json
import random
import tomllib
from typing import Any

import pytest

from models.layouts import BadInput, check
from models.layouts.generate import network
from models.layouts.native import import_native
from models.layouts.railjson import import_railjson
from models.layouts.table import import_table
from tests.layouts.corruptions import Corruption, corruptions, drop_conflict
from tests.layouts.stations import SAMPLES, plain_station, railjson_of, table_rows

Data = dict[str, Any]
BASES: dict[str, Data] = {path.stem: tomllib.loads(path.read_text("utf-8")) for path in SAMPLES}
BASES |= {"generated": network(60, seed=3), "plain": plain_station()}
NATIVE = [(name, c) for n, (name, base) in enumerate(sorted(BASES.items())) for c in corruptions(base, 60, seed=n)]


def found(imported_or_error: Any) -> tuple[set[str], str]:
    """The elements named and all that is said."""
    if isinstance(imported_or_error, BadInput):
        return set(), str(imported_or_error)
    result = check(imported_or_error)
    assert result.exit_code == (1 if result.violations else 0)
    elements = {element for violation in result.violations for element in violation.elements}
    return elements, "\n".join(violation.text for violation in result.violations)


def attempt(importer: Any, data: Any) -> Any:
    try:
        return importer("file", data, ("T1",))
    except BadInput as error:
        return error


def assert_found(corruption: Corruption, outcome: Any) -> None:
    elements, said = found(outcome)
    assert said, f"{corruption.edit} is not found, but {corruption.why}"
    named = [name for name in corruption.named if name in elements or f"'{name}'" in said or name in said]
    assert named, f"{corruption.edit}: none of {corruption.named} is named in {said}"


@pytest.mark.parametrize("name", sorted(BASES))
def test_base_is_good(name: str) -> None:
    result = check(import_native(name, copy.deepcopy(BASES[name]), ("T1",)))
    assert result.verdict == "holds", result.violations


@pytest.mark.parametrize(("base", "corruption"), NATIVE, ids=[f"{base}: {c.edit}" for base, c in NATIVE])
def test_native_corruption_is_found(base: str, corruption: Corruption) -> None:
    assert_found(corruption, attempt(import_native, corruption.data))


RAILJSON_EDITS = [
    c for c in corruptions(plain_station(), 60, seed=11) if "off" not in c.edit and "sideways" not in c.edit
]


@pytest.mark.parametrize("corruption", RAILJSON_EDITS, ids=[c.edit for c in RAILJSON_EDITS])
def test_railjson_corruption_is_found(corruption: Corruption) -> None:
    assert_found(corruption, attempt(import_railjson, railjson_of(corruption.data)))


def test_railjson_base_is_good_in_both_dialects() -> None:
    results = [check(import_railjson("file", railjson_of(plain_station(), later), ("T1",))) for later in (False, True)]
    assert [result.verdict for result in results] == ["holds", "holds"]
    assert results[0] == results[1]


@pytest.mark.parametrize("seed", range(40))
def test_missing_conflict_is_found_with_both_routes(seed: int) -> None:
    rows, routes = drop_conflict(table_rows(), random.Random(seed), both=seed % 2 == 0)
    result = check(import_table("file", {"interlocking-table": rows}, ("T1",)))
    assert [v.axiom for v in result.violations] == ["conflicts are declared"]
    assert set(routes) <= set(result.violations[0].elements)


def test_table_base_is_good() -> None:
    result = check(import_table("file", {"interlocking-table": table_rows()}, ("T1",)))
    assert result.verdict == "holds", result.violations


@pytest.mark.parametrize("index", range(8))
def test_flipped_position_in_a_table_is_found(index: int) -> None:
    rows = json.loads(json.dumps(table_rows()))
    row = [row for row in rows if row["points"]][index]
    point = row["points"][0]
    point["position"] = {"normal": "reverse", "reverse": "normal"}[point["position"]]
    elements, said = found(attempt(import_table, {"interlocking-table": rows}))
    assert {row["id"], point["id"]} <= elements, said
