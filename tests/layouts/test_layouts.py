"""Samples, generated networks and real layouts: what is imported and what the check says."""

from __future__ import annotations

import json
import tomllib
import xml.etree.ElementTree as Xml
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from kernel.names import Block, Point, Route, Tag
from models.diagram import draw_svg
from models.layouts import BadInput, Imported, as_json, check, load, load_text
from models.layouts.generate import as_toml, generate, network
from models.layouts.native_schema import SCHEMA
from models.layouts.railjson import import_railjson
from models.layouts.table import import_table
from tests.layouts.stations import (
    REAL_FILES,
    ROOT,
    SAMPLES,
    SHARED,
    needs_shared,
    plain_station,
    railjson_of,
    table_rows,
)

PLAIN = import_railjson("plain", railjson_of(plain_station()), ("T1", "T2"))


@pytest.mark.parametrize("path", SAMPLES, ids=lambda path: path.stem)
def test_sample_holds(path: Path) -> None:
    result = check(load(path))
    assert (result.verdict, result.violations, result.remarks) == ("holds", (), ())


@pytest.mark.parametrize("path", SAMPLES, ids=lambda path: path.stem)
def test_sample_written_out_and_read_again_is_the_same(path: Path) -> None:
    data = tomllib.loads(path.read_text("utf-8"))
    assert load_text(str(path), as_toml(data)) == load(path)


def test_schema_file_is_the_schema() -> None:
    assert json.loads((ROOT / "layouts" / "layout.schema.json").read_text("utf-8")) == SCHEMA


def test_example_of_the_description_holds() -> None:
    text = (ROOT / "layouts" / "README.md").read_text("utf-8")
    example = text.split("```toml\n")[1].split("```")[0]
    assert check(load_text("README.md", example)).verdict == "holds"


@settings(max_examples=25, deadline=None)
@given(st.integers(1, 60), st.integers(0, 10**6))
def test_generated_network_holds(routes: int, seed: int) -> None:
    imported = generate(routes, seed)
    assert len(imported.layout.routes) == routes
    assert check(imported).verdict == "holds"
    assert tomllib.loads(as_toml(network(routes, seed))) == network(routes, seed)


def test_claims_are_in_running_order_and_released_in_parts() -> None:
    layout, route = PLAIN.layout, Route("a-d")
    way = layout.way[route]
    assert layout.start[route] == "B:a+west"
    assert way == {"B:a+west": "B:a+b", "B:a+b": "B:b+c+e", "B:b+c+e": "B:c+d"}
    assert layout.destination[route] == "B:c+d"
    assert layout.released_after[route] == {block: block for block in layout.claims[route]}
    assert layout.needs[route] == {"P": "A_B1"}
    without = Route("e-a")
    assert layout.released_after[without][Block("B:b+c+e")] == "B:b+c+e"
    assert layout.released_after[Route("f-h")][Block("B:d+f+g")] == "B:d+f+g"
    assert layout.released_after[Route("a-f")][Block("B:a+b")] == "B:a+b"


def test_everything_is_released_on_arrival_without_release_detectors() -> None:
    native = plain_station()
    native["routes"]["a-d"]["release_at"] = []
    layout = import_railjson("plain", railjson_of(native), ("T1",)).layout
    released = layout.released_after[Route("a-d")]
    assert released == {"B:a+west": "B:a+west", "B:a+b": "B:b+c+e", "B:b+c+e": "B:b+c+e", "B:c+d": "B:c+d"}


def test_tags_lie_in_pairs_and_are_read_in_order() -> None:
    layout, route = PLAIN.layout, Route("a-d")
    read = [layout.first_tag[route]]
    while read[-1] in layout.tag_after[route]:
        read.append(layout.tag_after[route][read[-1]])
    assert read == ["a@B:a+west", "a@B:a+b", "b@B:a+b", "b@B:b+c+e", "c@B:b+c+e", "c@B:c+d"]
    assert len(layout.tag_in) == 2 * 8
    assert PLAIN.records.record[Tag("a@B:a+b")].endswith(":500000")


def test_route_from_a_buffer_stop_starts_in_its_first_block() -> None:
    layout, route = PLAIN.layout, Route("east-h")
    assert layout.start[route] == "B:east+h"
    assert layout.covers[route] == {"B:g+h"}
    assert layout.first_tag[route] == "h@B:east+h"


def test_route_that_grants_nothing_is_left_out_with_a_remark() -> None:
    native = plain_station()
    native["routes"]["stub"] = {"from": "west", "direction": "forward", "to": "a"}
    imported = import_railjson("plain", railjson_of(native), ("T1",))
    assert "stub" not in imported.layout.routes
    assert [remark.elements for remark in imported.remarks] == [("stub",)]


def test_point_in_the_start_block_is_needed_as_the_way_out_lies() -> None:
    native = plain_station()
    del native["tracks"]["z"]["boundaries"]["h"], native["tracks"]["x"]["boundaries"]["g"]
    for track in ("t1", "t2"):
        marks = native["tracks"][track]["boundaries"]
        for mark in {"d", "f"} & set(marks):
            del marks[mark]
    routes = {"out": {"from": "c", "direction": "backward", "to": "a", "points": {"P": "normal"}}}
    imported = import_railjson("plain", railjson_of(native | {"routes": routes}), ("T1",))
    route = Route("out")
    assert imported.layout.start[route] == "B:c+e+east"
    assert imported.layout.needs[route] == {"P": "A_B1", "Q": "A_B1"}
    assert imported.layout.released_with[route][Point("Q")] == "B:c+e+east"
    assert check(imported).verdict == "holds"


def test_crossing_track_is_one_block() -> None:
    imported = load(next(path for path in SAMPLES if path.stem == "junction"))
    assert imported.places.blocks[
        imported.layout.way[Route("main to 3")][imported.layout.start[Route("main to 3")]]
    ] == (
        "BD2",
        "UE2",
        "UE3",
        "XD",
    )


def test_conflicts_of_a_table_that_follow_from_nothing_or_are_one_sided() -> None:
    rows = table_rows()
    by = {row["id"]: row for row in rows}
    by["in W"]["conflicts"].append({"id": "in E"})
    by["W-t1"]["conflicts"] = [c for c in by["W-t1"]["conflicts"] if c["id"] != "W-t2"]
    result = check(import_table("table", {"interlocking-table": rows}, ("T1",)))
    idle, violation = sorted(result.violations, key=lambda v: v.elements, reverse=True)
    assert (idle.axiom, idle.elements) == ("declared conflicts follow", ("in W", "in E"))
    assert violation.elements == ("W-t1", "W-t2", "p", "sp")
    assert "point 'p' (normal against reverse)" in violation.text
    assert "route 'W-t1' does not declare it" in violation.text
    assert "nothing keeps them apart" in idle.text


def test_of_very_many_missing_conflicts_the_rest_are_counted(monkeypatch: pytest.MonkeyPatch) -> None:
    rows = table_rows()
    for row in rows:
        row["conflicts"] = []
    table = {"interlocking-table": rows}
    every = [v for v in import_table("table", table, ("T1",)).violations if v.axiom == "conflicts are declared"]
    monkeypatch.setattr("models.layouts.conflicts.MOST_TOLD", 3)
    *told, rest = (v for v in import_table("table", table, ("T1",)).violations if v.axiom == "conflicts are declared")
    assert told == every[: len(told)]
    assert 3 <= len(told) < len(every)
    assert rest.text == f"{len(every) - len(told)} more pairs of routes conflict and do not declare it"


def conflicts(imported: Imported, first: Route, second: Route) -> bool:
    """Whether two runs of these routes would conflict: a common block, or a point two ways."""
    layout = imported.layout
    opposite = any(layout.needs[second].get(p, at) != at for p, at in layout.needs[first].items())
    return opposite or bool(layout.claims[first] & layout.claims[second])


def test_every_declared_conflict_of_a_table_follows_from_the_imported_layout() -> None:
    rows = table_rows()
    imported = import_table("table", {"interlocking-table": rows}, ("T1",))
    for row in rows:
        for other in row["conflicts"]:
            assert conflicts(imported, Route(row["id"]), Route(other["id"]))


def test_json_result_is_plain_data() -> None:
    result = check(PLAIN)
    data = json.loads(json.dumps(as_json(PLAIN, result)))
    assert (data["verdict"], data["exit_code"], data["counts"]["routes"]) == ("holds", 0, 10)


DRAWN = [(path, None) for path in SAMPLES] + [(path, "first") for path in SAMPLES]


@pytest.mark.parametrize(("path", "route"), DRAWN)
def test_diagram_names_every_block_end_point_and_the_route(path: Path, route: str | None) -> None:
    imported = load(path)
    chosen = min(imported.layout.routes) if route else None
    svg = draw_svg(imported, chosen)
    texts = " ".join(element.text or "" for element in Xml.fromstring(svg).iter())
    assert imported.station is not None
    for name in [*imported.station.marks, *imported.layout.points, *([chosen] if chosen else [])]:
        assert name in texts
    with pytest.raises(BadInput, match="no such route"):
        draw_svg(imported, "no such route")


def test_diagram_of_a_table_and_of_a_ring() -> None:
    assert "before farW" in draw_svg(import_table("table", {"interlocking-table": table_rows()}, ("T1",)), "W-t1")
    data = railjson_of(plain_station())
    data["track_sections"].append({"id": "ring", "length": 100.0})
    ends = {"A": {"track": "ring", "endpoint": "END"}, "B": {"track": "ring", "endpoint": "BEGIN"}}
    data["switches"].append({"id": "closed", "switch_type": "link", "ports": ends})
    assert draw_svg(import_railjson("ring", data, ("T1",)))


REAL = ["tiny_infra", "three_trains", "overlapping_routes", "one_line", "nested_switches", "small_infra"]


@needs_shared
@pytest.mark.parametrize("name", REAL)
def test_real_layout_is_imported_without_findings_and_drawn(name: str) -> None:
    imported = load(SHARED / f"osrd-{name}.json")
    assert imported.violations == ()
    assert imported.layout.routes
    Xml.fromstring(draw_svg(imported, min(imported.layout.routes)))


@needs_shared
@pytest.mark.parametrize("path", REAL_FILES, ids=lambda path: path.name)
def test_every_real_file_is_imported_or_refused_for_what_is_true_of_it(path: Path) -> None:
    if path.suffix == ".json" and json.loads(path.read_text("utf-8"))["routes"] == []:
        with pytest.raises(BadInput, match="has no routes: nothing to check"):
            load(path)
    else:
        assert load(path).layout.routes


@needs_shared
def test_real_table_holds_and_its_conflicts_follow() -> None:
    imported = load(SHARED / "swtbahn-lite.yml")
    result = check(imported)
    assert (result.verdict, result.violations) == ("holds", ())
    assert [(remark.elements, remark.rests) for remark in result.remarks] == [
        (("signal11",), "derived"),
        (("signal14",), "derived"),
    ]
    starts = {imported.layout.start[Route(name)] for name in ("61", "68")}
    assert starts == {Block("platform2")}
    assert imported.layout.start[Route("71")] == Block("platform1")
    assert conflicts(imported, Route("10"), Route("71"))
