"""What lies too near on the track, what hangs on nothing, and names that nobody can tell apart."""

from __future__ import annotations

from math import sqrt
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from kernel.names import Tag
from models.layouts import BadInput, Imported, Violation, check, load_text
from models.layouts.alike import LOOK_ALIKE, drawn, read
from models.layouts.clearance import RULE as CLEAR
from models.layouts.generate import as_toml
from models.layouts.geometry import HOLDS, OVERLAP, ROOM
from models.layouts.measures import (
    CLEARANCE_MM,
    GAINS_MM_S2,
    RESPONSE_MS,
    SHORTEST_BLOCK_MM,
    SHORTEST_OVERLAP_MM,
    SLOWS_MM_S2,
    STANDS_MM_S,
    TAG_MM,
)
from models.layouts.native import JOINTS, import_native
from models.layouts.numbers import LONGEST_DISTANCE_MM
from models.rides.plan import PLAN
from tests.layouts.stations import Data, plain_station


def station(**tracks: dict[str, Any]) -> Data:
    data = plain_station()
    for name, entries in tracks.items():
        data["tracks"][name] |= entries
    return data


def read_in(data: Data) -> Imported:
    return import_native("x", data, ("T1", "T2"))


def found(imported: Imported, rule: str, **how: Any) -> list[Violation]:
    return [violation for violation in check(imported, **how).violations if violation.axiom == rule]


def with_boundary_at(at_mm: int) -> Data:
    """The station's boundary ``c`` so far behind point P on its normal leg."""
    data = plain_station()
    data["tracks"]["t1"]["boundaries"]["c"] = at_mm
    return data


@pytest.mark.parametrize(("at_mm", "foul"), [(1, True), (CLEARANCE_MM - 1, True), (CLEARANCE_MM, False)])
def test_a_boundary_nearer_than_the_clearance_is_foul_of_the_other_leg(at_mm: int, foul: bool) -> None:
    violations = found(read_in(with_boundary_at(at_mm)), CLEAR)
    assert [violation.elements for violation in violations] == ([("P", "c")] if foul else [])


def test_the_clearance_asked_for_can_be_given() -> None:
    imported = read_in(with_boundary_at(15_000))
    assert found(imported, CLEAR)
    assert not found(imported, CLEAR, clearance_mm=15_000)
    assert len(found(imported, CLEAR, clearance_mm=10**6)) == 4


def test_a_leg_is_held_to_what_the_file_tells_of_it() -> None:
    for at_mm, clear_mm, foul in ((5_000, 5_000, False), (5_000, 5_001, True), (60_000, 60_001, True)):
        data = with_boundary_at(at_mm)
        data["points"]["P"] = {"clear_mm": {"normal": clear_mm}}
        assert bool(found(read_in(data), CLEAR, clearance_mm=1)) == foul


def test_a_train_that_bars_the_point_by_fouling_is_no_danger_and_the_next_boundary_counts() -> None:
    data = with_boundary_at(5_000)
    data["tracks"]["t1"]["boundaries"]["c2"] = 15_000
    data["routes"] = {"a-d": data["routes"]["a-d"]}
    data["blocks"] = {"throat": {"track": "t1", "at_mm": 1_000}, "between": {"track": "t1", "at_mm": 10_000}}
    data["blocks"]["behind"] = {"track": "t1", "at_mm": 20_000}
    data["routes"]["a-d"] |= {"release_at": []}
    assert [v.elements for v in found(read_in(data), CLEAR)] == [("P", "c")]
    data["fouling"] = [["throat", "between"]]
    assert [v.elements for v in found(read_in(data), CLEAR)] == [("P", "c2")]
    data["fouling"] += [["throat", "behind"]]
    assert found(read_in(data), CLEAR) == []


def test_a_boundary_before_the_tips_is_foul_of_nothing() -> None:
    assert found(read_in(station(w={"boundaries": {"a": 400_000, "b": 999_999}})), CLEAR) == []


def test_a_leg_that_a_point_has_not_is_refused() -> None:
    data = plain_station()
    data["points"]["P"] = {"clear_mm": {"left": 1}}
    with pytest.raises(BadInput, match="there is no leg 'left'"):
        read_in(data)


def line(**boundaries: int) -> Data:
    """One track with boundaries, and a route over the first two."""
    first, second, *_ = boundaries
    return {
        "format": "heisoku-layout-1",
        "held_by_authority": "rest",
        "tracks": {"l": {"from": "west", "to": "east", "length_mm": 1_000_000, "boundaries": boundaries}},
        "routes": {"r": {"from": first, "direction": "forward", "to": second}},
    }


@given(st.integers(1, 3 * SHORTEST_BLOCK_MM))
def test_a_block_has_room_for_the_tags_of_both_its_boundaries(long_mm: int) -> None:
    violations = found(read_in(line(a=100_000, b=100_000 + long_mm)), ROOM)
    assert [v.elements for v in violations] == ([("a", "b")] if long_mm < SHORTEST_BLOCK_MM else [])


@given(st.integers(1, 3 * TAG_MM))
def test_a_block_at_an_end_of_track_has_room_for_its_tag(long_mm: int) -> None:
    violations = found(read_in(line(a=long_mm, b=500_000)), ROOM)
    assert [v.elements for v in violations] == ([("a", "west")] if long_mm < TAG_MM else [])


def test_a_distance_that_no_tag_holds_is_a_violation() -> None:
    data = line(a=100_000, b=LONGEST_DISTANCE_MM - 50_000)
    data["tracks"]["l"] |= {"length_mm": LONGEST_DISTANCE_MM, "to": "mid"}
    data["tracks"]["k"] = {"from": "mid", "to": "east", "length_mm": 400_000, "boundaries": {"c": 300_000}}
    assert found(read_in(data), HOLDS) == []
    del data["tracks"]["l"]["boundaries"]["b"]
    data["routes"]["r"]["to"] = "c"
    imported = read_in(data)
    assert {v.elements for v in found(imported, HOLDS)} == {("a", "c")}
    assert ["km long" in remark.text for remark in imported.remarks].count(True) == 1, "once a block, not once a tag"
    assert imported.records.record[Tag("a@B:a+c")].endswith(f":{LONGEST_DISTANCE_MM - 100_000 + 300_000}")


def test_kilometres_given_for_metres_are_found() -> None:
    data = line(a=200, b=900)
    data["tracks"]["l"]["length_mm"] = 1_000
    assert any("were kilometres given for metres" in v.text for v in check(read_in(data)).violations)


@pytest.mark.parametrize("long_mm", [SHORTEST_BLOCK_MM, SHORTEST_OVERLAP_MM - 1, SHORTEST_OVERLAP_MM])
def test_an_overlap_is_longer_than_a_train_slips_by_the_brakes_own_bounds(long_mm: int) -> None:
    data = line(a=100_000, b=200_000, c=200_000 + long_mm)
    data["routes"]["r"]["overlap_to"] = "c"
    violations = found(read_in(data), OVERLAP)
    assert [v.elements for v in violations] == ([("r", "b", "c")] if long_mm < SHORTEST_OVERLAP_MM else [])


def test_the_shortest_overlap_is_reckoned_with_the_brakes_bounds_of_rides() -> None:
    brake = PLAN.brake
    assert (brake.standstill_mm_s, brake.gains_mm_s2, brake.slows_mm_s2) == (STANDS_MM_S, GAINS_MM_S2, SLOWS_MM_S2)
    assert 100 * brake.response_cycles == RESPONSE_MS
    late_s = RESPONSE_MS / 1_000
    fastest = STANDS_MM_S + GAINS_MM_S2 * late_s
    way = STANDS_MM_S * late_s + GAINS_MM_S2 * late_s**2 / 2 + fastest**2 / (2 * SLOWS_MM_S2)
    assert way <= SHORTEST_OVERLAP_MM < way + 2


def test_no_turnout_of_a_railway_is_clear_within_the_default() -> None:
    assert sqrt(2 * 3.5 * 58) > CLEARANCE_MM / 1_000 > sqrt(2 * 3.5 * 57)
    assert CLEARANCE_MM / 1_000 < 3.5 * 6


def test_track_that_hangs_on_nothing_is_told() -> None:
    data = plain_station()
    data["tracks"]["k"] = {"from": "here", "to": "there", "length_mm": 300_000, "boundaries": {"q": 150_000}}
    assert [remark.elements for remark in read_in(data).remarks] == [("k",)]


def test_an_end_of_track_that_reads_like_another_is_a_severed_joint() -> None:
    data = plain_station()
    data["tracks"]["k"] = {"from": "East", "to": "there", "length_mm": 300_000}
    assert [v.elements for v in found(read_in(data), JOINTS)] == [("East", "east")]


@pytest.mark.parametrize(
    ("listed", "named"), [(["y"], []), ([], ["y"]), (["y", "nowhere"], ["nowhere"]), (["y", "P"], ["P"])]
)
def test_the_joints_that_a_file_lists_are_those_that_it_has(listed: list[str], named: list[str]) -> None:
    imported = read_in(plain_station() | {"joints": listed})
    assert [element for v in found(imported, JOINTS) for element in v.elements] == named


ALIKE = [("é", "e\u0301"), ("W", "W "), (" W", "W"), ("B", "В"), ("a  b", "a b"), ("ﬁn", "fin"), ("A", "Α")]
ALIKE += [("h", "һ"), ("l", "ӏ"), ("c", "ϲ"), ("C", "Ϲ"), ("G", "Ԍ"), ("ë", "ё"), ("J", "Ϳ")]


@pytest.mark.parametrize(("one", "other"), ALIKE)
def test_names_that_look_the_same_are_a_violation(one: str, other: str) -> None:
    assert (drawn(one), one) == (drawn(other), one) != ("", other)
    imported = read_in(line(**{one: 100_000, other: 500_000}))
    assert [sorted(v.elements) for v in found(imported, LOOK_ALIKE)] == [sorted((one, other))]


@pytest.mark.parametrize(("one", "other"), [("W", "w"), ("ВОКЗАЛ", "вокзал"), ("P0", "PO"), ("P1", "Pl"), ("PI", "Pl")])
def test_names_that_read_alike_are_a_remark(one: str, other: str) -> None:
    assert read(one) == read(other)
    imported = read_in(line(**{one: 100_000, other: 500_000}))
    assert check(imported).verdict == "holds"
    assert [sorted(remark.elements) for remark in imported.remarks] == [sorted((one, other))]


def test_names_of_different_kinds_and_different_names_are_let_alone() -> None:
    data = plain_station()
    data["tracks"]["T1"] = data["tracks"].pop("t1")
    data["blocks"] = {"platform": {"track": "T1", "at_mm": 500_000}}
    data["trains"] = ["platform", "t1"]
    assert [r for r in read_in(data).remarks if "alike" in r.text or "differ" in r.text] == []


def test_whole_numbers_written_as_floats_are_read_as_whole() -> None:
    data = plain_station()
    whole = read_in(data)
    for track in data["tracks"].values():
        track["length_mm"] = float(track["length_mm"])
        track["boundaries"] = {name: float(mm) for name, mm in track.get("boundaries", {}).items()}
    assert read_in(data) == whole
    assert load_text("x", as_toml(plain_station()), ("T1", "T2")) == whole


def test_a_train_of_no_printable_name_is_refused() -> None:
    with pytest.raises(BadInput, match="not usable as a name"):
        read_in(plain_station() | {"trains": ["1\n2"]})
