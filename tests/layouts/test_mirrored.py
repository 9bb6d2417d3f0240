"""A mirrored and renamed layout gets the mirrored answer: verdict, control table and conflicts."""

from __future__ import annotations

import json
import random
import tomllib

import pytest

from kernel.names import Point, Route
from models.layouts import load_text
from models.layouts.conflict_pairs import Conflicts
from models.layouts.export.control_table import control_table
from models.layouts.generate import as_toml
from tests.independent.files import OTHERS, SAMPLES, path_of
from tests.independent.layouts.crafted import TRAP
from tests.independent.layouts.mutants import RAILML
from tests.independent.layouts.stations import station
from tests.independent.made_up import made_up
from tests.independent.test_verdicts import needs_folder
from tests.layouts.mirrored import differences, mirrored

FILES = [*SAMPLES, *(pytest.param(name, marks=needs_folder) for name in (*OTHERS, *RAILML))]


@pytest.mark.parametrize("name", FILES)
def test_a_layout_in_a_mirror_gets_the_mirrored_answer(name: str) -> None:
    text = path_of(name).read_text(encoding="utf-8")
    for seed in range(3):
        assert differences(name, text, random.Random(seed)) == []


def test_networks_made_up_at_random_get_the_mirrored_answer() -> None:
    seen = 0
    for number in range(60):
        for data in (made_up(random.Random(number)), station(random.Random(number))):
            if data is not None and data["routes"]:
                seen += 1
                assert differences("made_up.json", json.dumps(data), random.Random(number)) == [], number
    assert seen >= 60


def test_a_trap_lies_away_from_the_path_whatever_its_positions_are_called() -> None:
    for text in (TRAP, mirrored("trap.toml", TRAP, random.Random(1)).text):
        imported = load_text("trap.toml", text)
        main = next(row for row in control_table(imported, Conflicts(imported.layout)) if row.traps)
        assert (len(main.points), len(main.traps), len(main.spare), main.flank) == (1, 1, 1, ())
        assert main.traps[0][1] == {"normal": "reverse", "reverse": "normal"}[main.points[0][1]]
    assert differences("trap.toml", TRAP, random.Random(2)) == []


@pytest.mark.parametrize("field", ["points", "flank"])
def test_a_route_may_name_how_a_point_beside_it_lies(field: str) -> None:
    for position, remarks in (("reverse", 0), ("normal", 1)):
        data = tomllib.loads(TRAP)
        data["routes"]["main"].setdefault(field, {})["T"] = position
        imported = load_text("trap.toml", as_toml(data))
        assert imported.violations == ()
        assert imported.layout.needs[Route("main")][Point("T")] == position
        named = [remark for remark in imported.remarks if remark.elements == ("main", "T")]
        assert len(named) == remarks
