"""On a layout that holds no two trains come within the loading gauge, wherever the kernel lets them stand and run.

Trains are driven over the rails of the file itself; the kernel decides from what the importer made of it.
"""

from __future__ import annotations

import json
import random
from collections import Counter
from dataclasses import replace
from typing import Any

import pytest

from kernel.layout import Layout
from models.layouts import check, load, load_text
from tests.independent.files import OTHERS, ROOT, SAMPLES, path_of
from tests.independent.layouts.crafted import CRAFTED, NEAR, TWO_LEGS
from tests.independent.layouts.driving import Driver, Found
from tests.independent.layouts.mutants import RAILML, File
from tests.independent.layouts.stations import station, without
from tests.independent.layouts.survey import of_railjson, survey_file, survey_text
from tests.independent.test_verdicts import needs_folder

RAILS = [name for name in (*OTHERS, *RAILML) if not name.endswith(".yml")]
REAL = [*SAMPLES, *(pytest.param(name, marks=needs_folder) for name in RAILS)]
NEVER = {
    "on the same rails",
    "led elsewhere",
    "led elsewhere from its start",
    "led elsewhere on arrival",
    "led elsewhere at start-up",
    "a point before the entry is not held",
    "the tags of a route are not those that it passes",
    "a route is never granted",
    "a point is free before the train has passed it",
    "no such route on the rails",
    "a declared conflict is not kept",
}
"""What two trains, or one that is led where its route does not lie, must never show."""


def driven(name: str) -> Found:
    survey, imported = survey_file(path_of(name)), load(path_of(name))
    assert survey.faults == []
    return Driver.of(survey, imported).drive()


@pytest.mark.parametrize("name", REAL)
def test_trains_stay_clear_of_each_other(name: str) -> None:
    found = driven(name)
    assert not found.kinds().keys() & NEVER
    assert found.counts["routes"] == len(load(path_of(name)).layout.routes)
    assert found.counts["stands"] >= 20


def stations(numbers: range) -> tuple[Counter[str], Counter[str]]:
    """What trains on stations made up at random show, and how much was driven; routes that are refused are left out."""
    hazards, counts = Counter[str](), Counter[str]()
    for number in numbers:
        data = sound(station(random.Random(number)))
        if not data["routes"]:
            continue
        imported = load_text("station.json", json.dumps(data))
        if check(imported, clearance_mm=0).verdict == "holds":  # detectors lie anywhere, also foul of a point
            found = Driver.of(of_railjson(data), imported).drive()
            hazards += found.kinds()
            counts += found.counts + Counter(layouts=1)
    return hazards, counts


def sound(data: dict[str, Any]) -> dict[str, Any]:
    """A station without the routes that something is wrong with."""
    if not data["routes"]:
        return data
    return without(data, {v.elements[0] for v in check(load_text("station.json", json.dumps(data))).violations})


def test_trains_on_stations_made_up_at_random() -> None:
    hazards, counts = stations(range(24))
    assert not hazards.keys() & NEVER, hazards
    assert counts["layouts"] >= 8, counts
    assert counts["pairs"] >= 2_000, counts
    assert counts["tracks of start blocks"] >= 200, counts


@pytest.mark.slow
def test_trains_on_a_thousand_stations() -> None:
    hazards, counts = stations(range(1_000))
    assert not hazards.keys() & NEVER, hazards
    assert counts["layouts"] >= 300, counts
    assert counts["pairs"] >= 100_000, counts


# ---- the driver notices


def a_block_less(layout: Layout) -> Layout:
    """Routes that claim their destination no more."""
    return replace(layout, claims={name: layout.claims[name] - {layout.destination[name]} for name in layout.routes})


def a_point_less(layout: Layout) -> Layout:
    """Routes that do not need a point of theirs."""
    return replace(layout, needs={name: dict(list(layout.needs[name].items())[1:]) for name in layout.routes})


def points_turned(layout: Layout) -> Layout:
    """Every point wanted in another position."""
    other = {"normal": "reverse", "reverse": "normal"}
    needs = {name: {p: other[at] for p, at in layout.needs[name].items()} for name in layout.routes}
    return replace(layout, needs=needs)  # type: ignore[arg-type]


def no_point_of_its_start(layout: Layout) -> Layout:
    """Routes that need no point of the block that their trains stand in."""
    needs = {
        name: {p: at for p, at in layout.needs[name].items() if layout.stands_in[p] != layout.start[name]}
        for name in layout.routes
    }
    return replace(layout, needs=needs)


def test_a_train_on_the_other_leg_of_its_block_is_refused() -> None:
    imported, survey = load_text("legs.toml", TWO_LEGS), survey_text("legs.toml", TWO_LEGS)
    assert check(imported).verdict == "holds"
    found = Driver.of(survey, imported).drive()
    assert not found.kinds().keys() & NEVER
    wrong = Driver.of(survey, replace(imported, layout=no_point_of_its_start(imported.layout))).drive()
    assert {"led elsewhere from its start", "a point before the entry is not held"} <= wrong.kinds().keys()
    assert wrong.kinds().keys() & {"led elsewhere on arrival", "led elsewhere at start-up"}


def starts_in_its_destination(layout: Layout) -> Layout:
    """Routes that begin elsewhere, so that a train may stand where another one is."""
    return replace(layout, start=layout.destination)


@pytest.mark.parametrize(
    ("planted", "kind"),
    [
        (a_block_less, "on the same rails"),
        (a_point_less, "led elsewhere"),
        (points_turned, "led elsewhere"),
        (starts_in_its_destination, "on the same rails"),
    ],
)
def test_a_planted_fault_is_seen(planted: object, kind: str) -> None:
    path = ROOT / "layouts" / "junction.toml"
    imported = load(path)
    wrong = replace(imported, layout=planted(imported.layout))  # type: ignore[operator]
    assert kind in Driver.of(survey_file(path), wrong).drive().kinds()


SAID = {
    "no track.toml": [("on b", "P")],
    "diamond.json": [("out", "stop", "south")],
    "against.toml": [("main", "T")],
    "names.toml": [("A-1", "A\u20111"), ("A", "\u0410"), ("\u30cb", "\u4e8c"), ("C  1", "C 1"), ("r", "r ")],
    "short.toml": [("A", "w"), ("B", "C"), ("one", "D", "E"), ("stop", "B", "C")],
    "long.toml": [("C", "D"), ("C", "D")],
    "kilometres.toml": [("line",)],
    "no train.toml": [()],
    "shorter.toml": [("A", "B")],
}
"""What is wrong with a crafted layout, by its elements."""


@pytest.mark.parametrize("name", CRAFTED)
def test_a_crafted_layout_is_seen_as_a_plain_walk_sees_it(name: str) -> None:
    file = File(name, CRAFTED[name])
    assert file.before is not None
    assert file.unlike == []
    at_import = [v.elements for v in file.before.violations]
    assert at_import == SAID.get(name, [])


def test_the_nearest_boundary_counts_whichever_way_over_a_point_leads_to_it() -> None:
    found = [v.elements for v in check(load_text("near.toml", NEAR)).violations]
    assert found == [("P", "S")]
