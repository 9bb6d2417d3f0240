"""What a verdict rests on beside the axioms is told with it, and a strict one rests on nothing that nobody declared."""

from __future__ import annotations

import json
import tomllib
from pathlib import Path

import pytest

from heisoku import run
from models.layouts import BadInput, CheckResult, Imported, as_json, check, load, load_text
from models.layouts.native import import_native
from models.layouts.railjson import import_railjson
from models.layouts.table import import_table
from tests.independent.layouts.dangerous_routes import HALF_TOLD
from tests.layouts.stations import SAMPLES, SHARED, needs_shared, plain_station, railjson_of, table_rows

STATION = next(path for path in SAMPLES if path.stem == "passing_station")
STOPS = """
format = "heisoku-layout-1"
held_by_authority = "rest"
tracks.line = { from = "west", to = "P.tip", length_mm = 900_000, boundaries = { W0 = 300_000, W = 800_000 } }
tracks.a = { from = "P.normal", to = "stop a", length_mm = 300_000 }
tracks.b = { from = "P.reverse", to = "stop b", length_mm = 300_000 }
points.P = {}
routes."a out" = { from = "W", direction = "backward", to = "W0", points = { P = "normal" } }
"""
RING = """
format = "heisoku-layout-1"
held_by_authority = "rest"
tracks.ring = { from = "n", to = "n", length_mm = 1_000_000, boundaries = { A = 100_000, B = 600_000 } }
routes.r = { from = "A", direction = "forward", to = "B" }
routes.s = { from = "B", direction = "forward", to = "A" }
"""
STRICT = "nothing rests on a default"


def native(**more: object) -> Imported:
    return import_native("plain", {**plain_station(), **more}, ("T1",))


def rests(result: CheckResult, declared: bool = False) -> dict[str, int]:
    return {rest.kind: len(rest.instances) for rest in result.rests if rest.declared == declared}


def test_pairs_kept_apart_by_authority_are_counted_and_told_whoever_named_them() -> None:
    rest, listed = native(), native(held_by_authority=[])
    pairs = {(block, target) for block, others in rest.ground.held_by_authority.items() for target in others}
    assert rests(check(rest))["authority"] == len(pairs) > 0
    assert "authority" not in rests(check(listed))
    named = native(held_by_authority=sorted(map(list, pairs)))
    assert rests(check(named), declared=True)["authority"] == len(pairs)
    assert check(named).verdict == "holds"


def test_legs_of_unknown_clearance_are_counted_and_declared_ones_are_not() -> None:
    plain = check(native())
    points = {name: {"clear_mm": {"normal": 40_000, "reverse": 40_000}} for name in plain_station()["points"]}
    told = check(native(points=points))
    assert rests(plain)["clearance"] == 2 * len(points)
    assert "clearance" not in rests(told)
    assert rests(told, declared=True)["clearance"] == 2 * len(points)


def test_a_table_knows_the_clearance_of_no_point() -> None:
    result = check(import_table("table", {"interlocking-table": table_rows()}, ("T1",)))
    assert rests(result)["clearance"] == 2


def test_a_point_in_a_claimed_block_without_a_stated_position_is_told_with_its_route() -> None:
    result = check(load(next(path for path in SAMPLES if path.stem == "terminus")))
    (rest,) = (rest for rest in result.rests if rest.kind == "position")
    assert rest.instances == (("K2", "arrive 1"), ("K2", "depart 1"))


def test_routes_that_are_left_out_are_told() -> None:
    data = plain_station()
    data["routes"]["stub"] = {"from": "west", "direction": "forward", "to": "a"}
    for imported in (import_native("x", data, ("T1",)), import_railjson("x", railjson_of(data), ("T1",))):
        assert rests(check(imported))["left out"] == 1


def test_joints_by_name_alone_are_told_until_the_file_lists_them() -> None:
    assert [rest.instances for rest in check(native()).rests if rest.kind == "joint"] == [(("y", "x", "z"),)]
    assert "joint" not in rests(check(native(joints=["y"])))
    assert "joint" not in rests(check(import_railjson("x", railjson_of(plain_station()), ("T1",))))


def test_ends_of_track_that_nothing_closes_are_told() -> None:
    data = railjson_of(plain_station())
    assert "end" not in rests(check(import_railjson("x", data, ("T1",))))
    lengths = {track["id"]: f"{track['length'] * 1_000:.0f} mm" for track in data["track_sections"]}
    stops = [stop for stop in data["buffer_stops"] if stop["id"] != "east"]
    (gone,) = (stop for stop in data["buffer_stops"] if stop["id"] == "east")
    data["routes"] = [
        each for each in data["routes"] if "east" not in (each["entry_point"]["id"], each["exit_point"]["id"])
    ]
    open_end = check(import_railjson("x", {**data, "buffer_stops": stops}, ("T1",)))
    assert [rest.instances for rest in open_end.rests if rest.kind == "end"] == [
        ((gone["track"], lengths[gone["track"]]),)
    ]
    detector = {"id": "far", "track": gone["track"], "position": gone["position"]}
    detected = {**data, "buffer_stops": stops, "detectors": [*data["detectors"], detector]}
    assert rests(check(import_railjson("x", detected, ("T1",))))["end"] == 1
    assert check(import_railjson("x", {**data, "buffer_stops": stops}, ("T1",)), strict=True).verdict == "does not hold"


def two_legs(**more: object) -> Imported:
    """A block in which trains start from either leg of a point that they trail."""
    return import_native("legs", {**tomllib.loads(STOPS), **more}, ("T1",))


def test_points_that_only_staff_lays_before_the_first_start_are_told() -> None:
    (rest,) = (rest for rest in check(two_legs()).rests if rest.kind == "start")
    assert (rest.declared, rest.instances) == (False, (("P", "B:W+stop a+stop b"),))
    declared = check(two_legs(laid_at_start=["P"]))
    assert ("start" in rests(declared), rests(declared, declared=True)["start"]) == (False, 1)
    assert "start" not in rests(check(native()))
    with pytest.raises(BadInput, match="there is no point 'Q'"):
        two_legs(laid_at_start=["Q"])


@needs_shared
@pytest.mark.parametrize(
    ("name", "points"), [("osrd-overlapping_routes.json", {"s.b"}), ("gicsafe-1.railml", {"swi9", "swi55", "swi58"})]
)
def test_real_layouts_in_which_trains_start_on_either_leg_say_so(name: str, points: set[str]) -> None:
    imported = load(SHARED / name)
    assert {each[0] for rest in check(imported).rests if rest.kind == "start" for each in rest.instances} == points
    assert check(imported, strict=True).verdict == "does not hold"


def test_trains_shorter_than_a_loop_between_legs_of_unknown_clearance_rest_on_a_default() -> None:
    half = load_text("half.toml", HALF_TOLD)
    (rest,) = (rest for rest in check(half).rests if rest.kind == "loop")
    assert (rest.declared, rest.instances) == (False, (("B:E+W", "X a2", "X b1", "160000 mm"),))
    assert check(half, strict=True).verdict == "does not hold"
    legs = "a1 = 45_000, b1 = 20_000, a2 = 20_000, b2 = 45_000"
    told = load_text("told.toml", HALF_TOLD.replace("a1 = 45_000, b2 = 45_000", legs))
    (rest,) = (rest for rest in check(told).rests if rest.kind == "loop")
    assert (rest.declared, rest.instances) == (True, (("B:E+W", "160000 mm"),))


def test_the_shortest_loop_is_told_until_the_file_says_that_its_trains_are_shorter() -> None:
    ring = tomllib.loads(RING)
    (rest,) = (rest for rest in check(import_native("ring", ring, ("T1",))).rests if rest.kind == "loop")
    assert (rest.declared, rest.instances) == (False, (("B:A+B", "B:A+B#2", "500000 mm"),))
    for longest_mm, verdict, declared in ((499_999, "holds", 1), (500_000, "does not hold", 0)):
        result = check(import_native("ring", {**ring, "longest_train_mm": longest_mm}, ("T1",)))
        assert (result.verdict, rests(result, declared=True).get("loop", 0)) == (verdict, declared)
        assert [v.elements for v in result.violations] == [("A", "B")] * (1 - declared)


def test_strict_makes_a_violation_of_each_kind_that_nobody_declared() -> None:
    imported = native()
    loose, strict = check(imported), check(imported, strict=True)
    assert (loose.verdict, strict.verdict) == ("holds", "does not hold")
    assert [v.axiom for v in strict.violations] == [STRICT] * len(rests(loose))
    elements = {element for v in strict.violations for element in v.elements}
    assert {"P", "Q", "normal", "reverse"} <= elements


def test_a_file_that_declares_everything_holds_strictly() -> None:
    result = check(load(STATION), strict=True)
    assert (result.verdict, result.defaults) == ("holds", 0)
    assert rests(result, declared=True) == {"authority": 8, "clearance": 6}


def test_the_command_tells_what_it_rests_on_and_records_it(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    ring = str(next(path for path in SAMPLES if path.stem == "ring"))
    record = tmp_path / "check.json"
    assert run(["check", ring, "--json", str(record)]) == 0
    assert "rests on 8 pairs of blocks (from, into) kept apart by train protection alone" in capsys.readouterr().out
    (entry,) = json.loads(record.read_text("utf-8"))["layouts"]
    rest, loop = entry["rests"]
    assert (loop["on"], loop["instances"][0][-1]) == ("loop", "2700000 mm")
    assert (rest["on"], rest["declared"], rest["count"], len(rest["instances"])) == ("authority", False, 8, 8)
    assert run(["check", ring, "--strict"]) == 1
    assert STRICT in capsys.readouterr().out
    assert run(["check", str(STATION), "--strict"]) == 0


def test_the_record_counts_what_the_result_has() -> None:
    imported = native()
    data = as_json(imported, check(imported))
    entries = data["rests"]
    assert isinstance(entries, list)
    assert {entry["on"]: entry["count"] for entry in entries} == rests(check(imported))


@needs_shared
def test_the_largest_real_network_shows_its_76_pairs() -> None:
    result = check(load(SHARED / "osrd-small_infra.json"))
    assert result.verdict == "holds"
    assert rests(result) == {"authority": 76, "clearance": 40, "left out": 6, "unread": 12, "loop": 1}
