"""Each fault is told once, and names what is at fault and little else."""

from __future__ import annotations

from dataclasses import replace

import pytest

from kernel.names import Block, Route
from models.layouts import Imported, Violation, check, load
from models.layouts.native import import_native
from models.layouts.railjson import import_railjson
from models.layouts.table import import_table
from tests.layouts.stations import SAMPLES, Data, plain_station, railjson_of, table_rows

LED = "a route is led over its points"
TURNED = "track_leads_along_the_way_or_is_turned"
STATION = load(next(path for path in SAMPLES if path.stem == "passing_station"))


def of_rule(imported: Imported, rule: str) -> list[Violation]:
    return [violation for violation in check(imported).violations if violation.axiom == rule]


def with_route(name: str, route: Data) -> Imported:
    native = plain_station()
    native["routes"][name] = route
    return import_native("plain", native, ("T1",))


@pytest.mark.parametrize(
    ("fault", "rule", "named"),
    [
        ({"points": {"P": "normal"}}, "a route's positions are of its points", "P"),
        ({"release_at": ["h"]}, "a release detector lies within its route", "h"),
    ],
)
def test_faults_of_a_route_that_grants_nothing(fault: Data, rule: str, named: str) -> None:
    imported = with_route("stub", {"from": "west", "direction": "forward", "to": "a"} | fault)
    assert Route("stub") not in imported.layout.routes
    assert [violation.elements for violation in of_rule(imported, rule)] == [("stub", named)]


def test_faults_of_a_route_that_passes_a_block_twice() -> None:
    native = plain_station()
    for mark, track in (("c", "t1"), ("d", "t1"), ("e", "t2"), ("f", "t2")):
        del native["tracks"][track]["boundaries"][mark]
    native["tracks"]["t1"]["boundaries"] = {"m": 500_000}
    native["points"]["S"] = {}
    run = {"from": "a", "direction": "forward", "to": "g", "points": {"P": "normal", "Q": "normal", "S": "normal"}}
    native["tracks"] |= {
        "s1": {"from": "in", "to": "S.tip", "length_mm": 1000},
        "s2": {"from": "S.normal", "to": "n", "length_mm": 1000},
        "s3": {"from": "S.reverse", "to": "r", "length_mm": 1000},
    }
    native["routes"] = {"through": run | {"release_at": ["h"]}}
    rules = {violation.axiom: violation.elements for violation in check(import_native("x", native, ())).violations}
    assert "a route passes a block once" in rules
    assert rules["a route's positions are of its points"] == ("through", "S")
    assert rules["a release detector lies within its route"] == ("through", "h")


def route_over(**points: str) -> Data:
    return {"from": "a", "direction": "forward", "to": "h", "points": points}


@pytest.mark.parametrize(
    ("points", "elements"),
    [
        ({"P": "normal"}, ("r", "Q")),
        ({"P": "normal", "Q": "sideways"}, ("r", "Q")),
        ({"P": "normal", "Q": "reverse"}, ("r", "Q", "P")),
        ({"Q": "normal"}, ("r", "P")),
    ],
)
def test_a_route_led_wrongly_names_what_may_be_at_fault(points: dict[str, str], elements: tuple[str, ...]) -> None:
    assert [violation.elements for violation in of_rule(with_route("r", route_over(**points)), LED)] == [elements]


def test_points_passed_rightly_are_not_named() -> None:
    native = plain_station()
    native["tracks"]["z"]["to"] = "R.normal"
    native["tracks"]["side"] = {"from": "east", "to": "R.reverse", "length_mm": 1000}
    native["tracks"]["end"] = {"from": "R.tip", "to": "far", "length_mm": 9000, "boundaries": {"k": 5000}}
    native["points"]["R"] = {}
    run = {"from": "a", "direction": "forward", "to": "k", "points": {"P": "normal", "Q": "normal", "R": "reverse"}}
    native["routes"] = {"r": run}
    (violation,) = of_rule(import_native("x", native, ("T1",)), LED)
    assert violation.elements == ("r", "R")
    assert "'P'" not in violation.text


def test_a_train_led_astray_is_told_once_with_the_point() -> None:
    route = next(r for r in sorted(STATION.layout.routes) if any(STATION.ground.turnout[r].values()))
    block, turning = next((b, t) for b, t in sorted(STATION.ground.turnout[route].items()) if t)
    target, point = next(iter(sorted(turning.items())))
    wanted = STATION.ground.leads[route][block][target][point]
    needs = {**STATION.layout.needs, route: {**STATION.layout.needs[route], point: wanted}}
    wrong = replace(STATION, layout=replace(STATION.layout, needs=needs))
    (violation,) = of_rule(wrong, TURNED)
    assert violation.elements[0] == route
    assert point in violation.elements
    unheld = replace(STATION, ground=replace(STATION.ground, turnout={**STATION.ground.turnout, route: {}}))
    assert len(of_rule(unheld, TURNED)) == sum(map(len, STATION.ground.turnout[route].values()))


def test_two_boundaries_that_part_nothing_are_told_apart() -> None:
    """One block behind ``b``, with two tracks that bend back into it."""

    def track(begin: str, end: str, **marks: int) -> Data:
        return {"from": begin, "to": end, "length_mm": 9000, "boundaries": marks}

    data = {
        "format": "heisoku-layout-1",
        "held_by_authority": "rest",
        "tracks": {
            "line": track("west", "P.tip", a=1000, b=2000),
            "up": track("P.normal", "Q.tip"),
            "down": track("P.reverse", "R.tip"),
            "ring up": track("Q.normal", "Q.reverse", x=4000),
            "ring down": track("R.normal", "R.reverse", y=4000),
        },
        "points": {"P": {}, "Q": {}, "R": {}},
        "routes": {"in": {"from": "a", "direction": "forward", "to": "b"}},
    }
    imported = import_native("x", data, ("T1",))
    assert ("b", "x", "y") in imported.places.blocks.values()
    named = [violation.elements for violation in of_rule(imported, "tags_of_a_boundary_are_partners")]
    assert named == [("x",), ("y",)]


def test_a_route_says_over_which_legs_its_train_comes_to_its_entry() -> None:
    """Over a point that it trails, and a slip whose both legs lead there by either position."""
    ends = {"A1": ("one", "END"), "A2": ("two", "END"), "B1": ("up", "BEGIN"), "B2": ("down", "BEGIN")}
    joined = {"A": ("out", "BEGIN"), "B1": ("up", "END"), "B2": ("down", "END")}

    def switch(name: str, kind: str, at: dict[str, tuple[str, str]]) -> Data:
        ports = {port: {"track": track, "endpoint": end} for port, (track, end) in at.items()}
        return {"id": name, "switch_type": kind, "ports": ports, "group_change_delay": 0.0}

    data = railjson_of(plain_station())
    data["track_sections"] += [{"id": track, "length": 100.0} for track in ("one", "two", "up", "down", "out")]
    data["switches"] += [switch("slip", "double_slip_switch", ends), switch("join", "point_switch", joined)]
    marks = (("m1", "one"), ("m2", "two"), ("entry", "out"), ("beyond", "out"))
    data["detectors"] += [{"id": m, "track": t, "position": 80.0 if m == "beyond" else 50.0} for m, t in marks]
    route = data["routes"][0] | {
        "id": "off",
        "entry_point": {"type": "Detector", "id": "entry"},
        "exit_point": {"type": "Detector", "id": "beyond"},
        "release_detectors": [],
    }
    data["routes"].append(route)
    for said, unsaid in (({}, ["join"]), ({"join": "A_B1"}, ["slip"]), ({"join": "A_B1", "slip": "A2_B1"}, [])):
        route["switches_directions"] = said
        imported = import_railjson("slip", data, ("T1",))
        found = of_rule(imported, "a route says where its train stands")
        assert [violation.elements for violation in found] == [("off", point) for point in unsaid]
        if not unsaid:
            assert imported.layout.needs[Route("off")] == said
    route["switches_directions"] = {"join": "A_B2", "slip": "A1_B1"}
    found = of_rule(import_railjson("slip", data, ("T1",)), "a route says where its train stands")
    assert [violation.elements for violation in found] == [("off", "join", "slip")]


def rows_up(*paths: tuple[str, list[str], list[str]]) -> list[dict[str, object]]:
    """Rows of a table without points, each from its source over a path; all conflict with all."""
    return [
        {
            "id": name,
            "source": name,
            "destination": f"to {path[-1]}",
            "orientation": "up",
            "path": [{"id": piece} for piece in path],
            "sections": [{"id": section} for section in sections],
            "points": [],
            "conflicts": [{"id": other} for other, _, _ in paths if other != name],
        }
        for name, path, sections in paths
    ]


def test_tracks_of_a_table_that_merge_without_a_point_are_found() -> None:
    rows = rows_up(("1", ["a1", "m", "c1"], ["a", "c"]), ("2", ["b1", "m", "c1"], ["b", "c"]))
    found = check(import_table("merge", {"interlocking-table": rows}, ("T1",))).violations
    assert [(v.axiom, v.elements) for v in found] == [("tracks merge at a point", ("1", "2", "a", "b", "c"))]


@pytest.mark.parametrize(
    ("path", "sections", "told"),
    [(["a", "b"], ["x", "y"], []), (["a", "b"], ["x"], []), (["a", "b", "c"], ["x", "y"], [("a", "b", "c")])],
)
def test_pieces_of_several_sections_that_always_come_together_are_told(
    path: list[str], sections: list[str], told: list[tuple[str, ...]]
) -> None:
    imported = import_table("one", {"interlocking-table": rows_up(("1", path, sections))}, ("T1",))
    assert [
        remark.elements for remark in imported.remarks if "nothing tells which lies in which" in remark.text
    ] == told
    assert check(imported).verdict == "holds"


def test_a_row_that_forgets_a_section_is_told_of_and_no_other() -> None:
    rows = rows_up(*((str(number), ["a1", f"b{number}"], ["a", f"b {number}"]) for number in range(6)))
    rows[0]["sections"] = [{"id": "b 0"}]
    found = of_rule(import_table("forgets", {"interlocking-table": rows}, ("T1",)), "sections are those of the path")
    assert [violation.elements for violation in found] == [("0", "a")]


def test_a_crossing_that_a_table_does_not_draw_is_found() -> None:
    rows = rows_up(("1", ["a1"], ["a"]), ("2", ["c1"], ["c"]))
    found = check(import_table("diamond", {"interlocking-table": rows}, ("T1",))).violations
    assert [(v.axiom, v.elements) for v in found] == [("declared conflicts follow", ("1", "2"))]


def test_a_route_of_a_table_starts_in_the_block_behind_the_leg_it_leaves_over() -> None:
    rows = [row for row in table_rows() if row["destination"] != "outWt1"]
    kept = {row["id"] for row in rows}
    for row in rows:
        row["conflicts"] = [entry for entry in row["conflicts"] if entry["id"] in kept]
    imported = import_table("table", {"interlocking-table": rows}, ("T1",))
    starts = {row["id"]: imported.layout.start[Route(row["id"])] for row in rows if row["source"] == "outWt1"}
    assert starts == {"t1-W": Block("t1")}
    assert check(imported).verdict == "holds"


def test_a_start_over_a_point_that_no_row_shows_is_a_violation() -> None:
    rows = [row for row in table_rows() if row["id"] in ("t1-W", "t2-W", "in W")]
    for row in rows:
        row["conflicts"] = [{"id": other["id"]} for other in rows if other is not row]
    imported = import_table("table", {"interlocking-table": rows}, ("T1",))
    found = of_rule(imported, "a route starts in a known block")
    assert [v.elements for v in found] == [("outWt1",), ("outWt2",)]


def test_a_row_from_a_signal_that_no_row_ends_at_is_compared() -> None:
    rows = table_rows()
    arriving = next(row for row in rows if row["id"] == "W-t1")
    rows = [row for row in rows if row["id"] != "in W"]
    for row in rows:
        row["conflicts"] = [entry for entry in row["conflicts"] if entry["id"] != "in W"]
    extra = {**arriving, "id": "odd", "points": [{"id": "p", "position": "reverse"}]}
    again = {**arriving, "id": "again"}
    imported = import_table("table", {"interlocking-table": [*rows, extra, again]}, ("T1",))
    assert imported.layout.start[Route("odd")] == Block("w")
    assert [v.elements for v in of_rule(imported, "a point lies one way between two blocks")] == [("odd", "p")]
