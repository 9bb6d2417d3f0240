"""What is exported is what was imported: layouts come back the same, and the tables say what the kernel decides by."""

from __future__ import annotations

import copy
import csv
import json
import random
import tomllib
from io import StringIO
from itertools import pairwise, permutations
from pathlib import Path
from typing import Any

import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

import heisoku
from kernel.centre import Centre
from kernel.names import Epoch, Route, Run, Serial, Train, UnitLife
from kernel.route_setting import conflict
from kernel.tags import TagRecord, decode
from models.exit_codes import BAD_INPUT, DOES_NOT_HOLD, HOLDS
from models.layouts import BadInput, Imported, check, load, load_text
from models.layouts.conflict_pairs import Conflicts
from models.layouts.export import files as export_files
from models.layouts.export.control_table import control_table
from models.layouts.export.files import NAMES, written
from models.layouts.export.kinds import fit
from models.layouts.export.page import ranges
from models.layouts.export.tag_plan import as_bytes, from_bytes, tag_plan
from models.layouts.export.to_native import native_data
from models.layouts.export.to_railjson import left_out, railjson_data
from models.layouts.export.unsayable import Unsayable
from models.layouts.generate import as_toml, generate, network
from models.layouts.native import KINDS as NATIVE
from models.layouts.numbers import LONGEST_DISTANCE_MM
from models.layouts.railjson import KINDS as RAILJSON
from models.layouts.track import Kind
from tests.fuzz.failures.browser import CHROMIUM, browser
from tests.independent.made_up import made_up
from tests.layouts.corruptions import corruptions
from tests.layouts.railml_made import railml_of
from tests.layouts.stations import REAL_FILES, SAMPLES, needs_shared, plain_station, railjson_of, table_rows

STATION = next(path for path in SAMPLES if path.stem == "passing_station")
STATION_PLAN = tag_plan(load(STATION))
RAILJSON_DATA = railjson_of(plain_station())
TABLE = "---\n" + json.dumps({"interlocking-table": table_rows()})


def natively(imported: Imported) -> Imported:
    return load_text(imported.name, as_toml(native_data(imported)))


def in_railjson(imported: Imported) -> Imported:
    return load_text(imported.name, json.dumps(railjson_data(imported)))


# ---- layouts come back


@pytest.mark.parametrize("path", SAMPLES, ids=lambda path: path.stem)
def test_a_sample_comes_back_the_same(path: Path) -> None:
    imported = load(path)
    assert natively(imported) == imported
    told, written_back = tomllib.loads(path.read_text("utf-8")), native_data(imported)
    for what in ("name", "trains", "tracks", "routes"):
        assert written_back[what] == told[what]
    assert written_back.get("points", {}) == told.get("points", {})
    assert set(written_back["blocks"]) == set(told["blocks"])


@settings(max_examples=15, deadline=None)
@given(st.integers(1, 60), st.integers(0, 10**6))
def test_a_generated_network_comes_back_the_same(routes: int, seed: int) -> None:
    imported = generate(routes, seed)
    assert natively(imported) == imported


@pytest.mark.parametrize("path", SAMPLES, ids=lambda path: path.stem)
def test_a_layout_that_does_not_hold_comes_back_with_its_faults(path: Path) -> None:
    read = 0
    for corruption in corruptions(tomllib.loads(path.read_text("utf-8")), 17, seed=5):
        try:
            imported = load_text("file", as_toml(corruption.data))
        except BadInput:
            continue
        read += 1
        assert natively(imported) == imported, corruption.edit
    assert read > 2


@settings(max_examples=40, deadline=None)
@given(st.integers(0, 10**9))
def test_railjson_comes_back_the_same_and_means_the_same_natively(seed: int) -> None:
    data = made_up(random.Random(seed))
    assume(data is not None)
    imported = load_text("file", json.dumps(data))
    assert in_railjson(imported) == imported
    try:
        native = natively(imported)
    except Unsayable:
        return
    assert native.layout.claims == imported.layout.claims
    assert native.layout.way == imported.layout.way
    assert native.layout.released_after == imported.layout.released_after
    assert native.layout.tag_after == imported.layout.tag_after
    assert native.records == imported.records
    for route, needs in imported.layout.needs.items():
        assert native.layout.needs[route].keys() == needs.keys()
    assert in_railjson(native).layout.needs == imported.layout.needs


def test_railjson_of_the_later_dialect_comes_back_in_the_earlier_one() -> None:
    later = load_text("file", json.dumps(railjson_of(plain_station(), later=True)))
    assert in_railjson(later) == later


def test_what_railjson_has_no_words_for_is_named_and_the_rest_holds() -> None:
    imported = load(STATION)
    assert list(left_out(imported)) == [
        "4 overlaps",
        "6 routes' flank points",
        "6 legs' clearances",
        "8 pairs held by authority",
        "4 trains",
        "10 names of blocks",
    ]
    again = in_railjson(imported)
    assert check(again).verdict == "holds"
    assert again.layout.routes == imported.layout.routes
    assert again.layout.points == imported.layout.points
    assert not any(again.layout.overlap.values())


def test_railml_means_the_same_in_railjson() -> None:
    imported = load_text("file", railml_of(RAILJSON_DATA))
    assert in_railjson(imported).layout.way == imported.layout.way
    assert natively(imported).layout.tag_after == imported.layout.tag_after


def test_a_table_has_no_track_to_be_told() -> None:
    imported = load_text("file", TABLE)
    for tell in (native_data, railjson_data):
        with pytest.raises(Unsayable, match="no track plan"):
            tell(imported)


# ---- kinds of junction


@settings(max_examples=100)
@given(st.sampled_from(sorted(RAILJSON)), st.randoms(use_true_random=False))
def test_a_junction_joins_the_same_in_other_words(name: str, chance: random.Random) -> None:
    kind = RAILJSON[name]
    words = [f"w{number}" for number in range(9)]
    chance.shuffle(words)
    port = dict(zip(kind.ports, words, strict=False))
    position = dict(zip(kind.positions, words, strict=False))
    ways = {position[at]: tuple((port[a], port[b]) for a, b in joined) for at, joined in kind.positions.items()}
    found = fit(Kind(tuple(port.values()), ways), RAILJSON)
    assert found is not None
    assert found.name == name
    for at, joined in kind.positions.items():
        told = {frozenset((found.port[port[a]], found.port[port[b]])) for a, b in joined}
        assert told == {frozenset(way) for way in kind.positions[found.position[position[at]]]}


def test_every_native_kind_has_words_in_railjson_that_keep_the_order_of_positions() -> None:
    for kind in NATIVE.values():
        found = fit(kind, RAILJSON)
        assert found is not None
        assert sorted(kind.positions, key=found.position.__getitem__) == sorted(kind.positions)


def test_a_junction_that_a_format_has_not_is_told_so() -> None:
    assert fit(Kind(("a", "b", "c", "d"), {"1": (("a", "b"),), "2": (("a", "c"),), "3": (("a", "d"),)}), NATIVE) is None


# ---- tags


@pytest.mark.parametrize("path", SAMPLES, ids=lambda path: path.stem)
def test_the_kernel_reads_the_plan_out_of_the_bytes(path: Path) -> None:
    imported = load(path)
    plan = tag_plan(imported)
    assert {each.tag for each in plan} == set(imported.layout.tag_in)
    assert all(each.record.uid >> 63 == 0 for each in plan)
    assert [decode(uid, pages) for uid, pages in from_bytes(as_bytes(plan))] == [each.record for each in plan]
    near = [{block, *imported.ground.neighbours[block]} for block in imported.layout.blocks]
    number = {each.block: each.record.block for each in plan}
    for together in [*near, *imported.layout.claims.values()]:
        numbers = [number[block] for block in together if block in number]
        assert len(set(numbers)) == len(numbers)


@given(st.integers(0, 20 * 16 * 8 - 1))
def test_a_bit_that_is_wrong_in_a_record_is_noticed(bit: int) -> None:
    plan = STATION_PLAN
    content = bytearray(as_bytes(plan))
    content[bit // 8] ^= 1 << bit % 8
    read = [decode(uid, pages) for uid, pages in from_bytes(bytes(content))]
    assert [isinstance(each, TagRecord) for each in read].count(False) == 1


def test_distance_is_told_where_there_is_one_next_tag() -> None:
    told = {str(each.tag): (each.kind, each.record.distance_mm) for each in tag_plan(load(STATION))}
    assert told["T1W@track 1"] == ("plain", 380_000)
    assert told["T1W@west throat"] == ("turnout", 260_000)
    assert told["W1@west throat"] == ("turnout", 0)
    assert told["E0@east section"] == ("plain", 0)


def test_half_a_record_is_refused() -> None:
    with pytest.raises(Unsayable):
        from_bytes(bytes(17))


# ---- tables


@pytest.mark.parametrize("which", [*(path.stem for path in SAMPLES), "table"])
def test_routes_conflict_where_the_centre_refuses_one_while_another_train_holds_the_other(which: str) -> None:
    by_name = {path.stem: path for path in SAMPLES}
    imported = load(by_name[which]) if which in by_name else load_text("file", TABLE)
    layout, conflicts = imported.layout, Conflicts(imported.layout)
    pairs = set(conflicts.pairs())
    for one, other in permutations(sorted(layout.routes), 2):
        refused = held_by_another(imported, one, other)
        assert refused == ((min(one, other), max(one, other)) in pairs)
        assert refused == (other in conflicts.of(one))
        assert refused == bool(conflicts.why(one, other).signs)
    assert pairs


def held_by_another(imported: Imported, held: Route, asked: Route) -> bool:
    """Whether the centre refuses a route while another train's run holds one, as it says why."""
    layout = imported.layout
    first, second = (Run(Serial(n), Train(f"T{n}"), UnitLife(1), route) for n, route in ((1, held), (2, asked)))
    centre = Centre(
        epoch=Epoch(1),
        newest=Serial(1),
        accounted={},
        runs={},
        claimed={block: frozenset({first}) for block in layout.claims[held]},
        locked={point: {first: lies} for point, lies in layout.needs[held].items()},
        lost_blocks=frozenset(),
        lost_points=frozenset(),
        terminal_life={},
        supervised=frozenset(),
        statements={},
    )
    return conflict(layout, centre, second) is not None


def test_the_control_table_of_the_sample() -> None:
    imported = load(STATION)
    row = next(row for row in control_table(imported, Conflicts(imported.layout)) if row.route == "W to 2")
    assert (row.entry, row.exit, row.start) == ("W1", "T3E", "west line")
    assert row.covers == ("west throat", "west trap", "track 2")
    assert row.overlap == ("east trap",)
    assert row.points == (("P1", "reverse"), ("D1", "reverse"), ("D2", "normal"))
    assert row.flank == ((("P2", "normal"), "east trap"),)
    assert row.released == (("west line",), ("west throat",), ("west trap",), ("track 2",))
    assert row.tags[:3] == ("W1@west line", "W1@west throat", "T2W@west throat")
    assert "1 to E" not in row.conflicts
    assert "W to 1" in row.conflicts


def test_a_route_released_on_arrival_is_released_in_one() -> None:
    native = plain_station()
    native["routes"]["a-d"]["release_at"] = []
    imported = load_text("file", json.dumps(railjson_of(native)))
    row = next(row for row in control_table(imported, Conflicts(imported.layout)) if row.route == "a-d")
    assert row.released == (("B:a+west",), ("B:a+b", "B:b+c+e"), ("B:c+d",))


def test_a_table_names_its_own_signals() -> None:
    imported = load_text("file", TABLE)
    row = next(row for row in control_table(imported, Conflicts(imported.layout)) if row.route == "W-t1")
    assert (row.entry, row.exit) == ("homeW", "outEt1")


def test_numbers_in_a_row_are_a_range() -> None:
    assert list(ranges([7, 1, 2, 3, 5, 6, 9])) == ["1–3", "5–7", "9"]


# ---- files and command


def rows_of(path: Path) -> list[dict[str, str]]:
    return list(csv.DictReader(StringIO(path.read_text("utf-8"))))


def test_the_command_writes_every_file_and_they_agree(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert heisoku.run(["export", str(STATION), "-o", str(tmp_path)]) == HOLDS
    assert {path.name for path in tmp_path.iterdir()} == set(NAMES)
    assert "9 files written, 0 not; the layout holds" in capsys.readouterr().out
    imported = load(STATION)
    tags = rows_of(tmp_path / "tag_plan.csv")
    read = from_bytes((tmp_path / "tag_records.bin").read_bytes())
    assert [(f"{uid:016x}", f"{pages.first:08x}", f"{pages.second:08x}") for uid, pages in read] == [
        (row["uid"], row["page_0"], row["page_1"]) for row in tags
    ]
    assert all(row["crc"] == row["page_1"][4:] for row in tags)
    pairs = {(row["route"], row["other"]) for row in rows_of(tmp_path / "conflicts.csv")}
    matrix = rows_of(tmp_path / "conflict_matrix.csv")
    crossed = {(row[""], other) for row in matrix for other, sign in row.items() if other and sign}
    assert crossed == pairs | {(other, one) for one, other in pairs}
    assert [row["route"] for row in rows_of(tmp_path / "control_table.csv")] == list(
        tomllib.loads(STATION.read_text("utf-8"))["routes"]
    )
    order = {row["route"]: row["tags_in_order"].split("; ") for row in rows_of(tmp_path / "route_table.csv")}
    for route, tags_read in order.items():
        assert dict(pairwise(tags_read)) == imported.layout.tag_after[Route(route)]


def test_files_of_an_earlier_export_do_not_stay(tmp_path: Path) -> None:
    table = tmp_path / "table.yml"
    table.write_text(TABLE, "utf-8")
    assert heisoku.run(["export", str(STATION), "-o", str(tmp_path / "out")]) == HOLDS
    assert heisoku.run(["export", str(table), "-o", str(tmp_path / "out")]) == DOES_NOT_HOLD
    assert {path.name for path in (tmp_path / "out").iterdir()} == set(NAMES) - {"layout.toml", "layout.json"}


def test_an_export_that_wrote_all_that_was_asked_holds_and_no_other(tmp_path: Path) -> None:
    table, out = tmp_path / "table.yml", tmp_path / "out"
    table.write_text(TABLE, "utf-8")
    asked = ["export", str(table), "-o", str(out), "--file", "conflicts.csv"]
    assert heisoku.run(asked) == HOLDS
    assert {path.name for path in out.iterdir()} == {"conflicts.csv"}
    assert heisoku.run([*asked, "--file", "layout.toml"]) == DOES_NOT_HOLD
    assert heisoku.run([*asked, "--file", "layout.svg"]) == BAD_INPUT


def test_a_tag_plan_that_cannot_be_written_is_no_success(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    data: dict[str, Any] = network(1)
    data["tracks"] = {
        "l1": {"from": "west", "to": "mid", "length_mm": LONGEST_DISTANCE_MM, "boundaries": {"A": 100_000}},
        "l2": {"from": "mid", "to": "east", "length_mm": 900_000, "boundaries": {"B": 500_000}},
    }
    data |= {"points": {}, "blocks": {}, "routes": {"r": {"from": "A", "direction": "forward", "to": "B"}}}
    file = tmp_path / "long.toml"
    file.write_text(as_toml(data), "utf-8")
    assert heisoku.run(["export", str(file), "-o", str(tmp_path / "out"), "--file", "tag_plan.csv"]) == DOES_NOT_HOLD
    assert "tag_plan.csv: not written" in capsys.readouterr().out
    assert heisoku.run(["export", str(file), "-o", str(tmp_path / "out"), "--file", "conflicts.csv"]) == DOES_NOT_HOLD


def test_the_control_table_and_its_page_tell_what_is_kept_apart_by_authority_alone(tmp_path: Path) -> None:
    assert heisoku.run(["export", str(STATION), "-o", str(tmp_path)]) == HOLDS
    told = {row["route"]: row["by_authority"] for row in rows_of(tmp_path / "control_table.csv")}
    assert told["W to 1"] == "east line out of east throat"
    imported = load(STATION)
    pairs = {pair for row in control_table(imported, Conflicts(imported.layout)) for pair in row.authority}
    assert pairs == {(block, to) for block, into in imported.ground.held_by_authority.items() for to in into}
    page = (tmp_path / "control_table.html").read_text("utf-8")
    assert "8 pairs of blocks (from, into) kept apart by train protection alone" in page


def test_a_layout_that_does_not_hold_is_exported_and_says_so(tmp_path: Path) -> None:
    data = copy.deepcopy(tomllib.loads(STATION.read_text("utf-8")))
    data["routes"]["W to 1"]["flank"] = {}
    file = tmp_path / "wrong.toml"
    file.write_text(as_toml(data), "utf-8")
    assert heisoku.run(["export", str(file), "-o", str(tmp_path / "out")]) == DOES_NOT_HOLD
    assert "does not hold" in (tmp_path / "out" / "control_table.html").read_text("utf-8")


def test_what_cannot_be_exported_is_refused_in_one_line(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    nothing = tmp_path / "nothing.toml"
    nothing.write_text("", "utf-8")
    for asked in ([str(nothing), "-o", str(tmp_path / "out")], [str(STATION), "-o", str(nothing)]):
        assert heisoku.run(["export", *asked]) == BAD_INPUT
        assert len(capsys.readouterr().err.splitlines()) == 1
    assert not (tmp_path / "out").exists()


def test_a_large_network_has_its_conflicts_as_pairs(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(export_files, "MOST_ON_A_PAGE", 500)
    imported = generate(510, seed=1)
    files = {each.name: each for each in written(imported, check(imported))}
    assert files["conflict_matrix.csv"].content is None
    assert files["control_table.html"].content is None
    told = files["conflicts.csv"].content
    assert told is not None
    assert len(told.splitlines()) == 1 + sum(1 for _ in Conflicts(imported.layout).pairs())


def test_what_stands_in_names_is_not_markup(tmp_path: Path) -> None:
    data: dict[str, Any] = network(4)
    data["name"] = "<script>alert(1)</script>"
    file = tmp_path / "odd.toml"
    file.write_text(as_toml(data), "utf-8")
    heisoku.run(["export", str(file), "-o", str(tmp_path / "out")])
    page = (tmp_path / "out" / "control_table.html").read_text("utf-8")
    assert "<script>" not in page
    assert "&lt;script&gt;" in page


@pytest.mark.skipif(CHROMIUM is None, reason="there is no Chromium: apt-get install chromium")
def test_the_page_loads_nothing_and_complains_of_nothing(tmp_path: Path) -> None:
    heisoku.run(["export", str(STATION), "-o", str(tmp_path)])
    with browser() as tab:
        tab.open(tmp_path / "control_table.html")
        assert tab.complaints == []
        assert [each for each in tab.asked if not each.startswith(("file:", "data:"))] == []
        assert tab.value("document.querySelectorAll('.control tbody tr').length") == 12
        assert tab.value("document.querySelectorAll('.matrix .on').length") == 84
        assert tab.value("document.documentElement.scrollWidth <= 1400")


@needs_shared
@pytest.mark.parametrize("path", [path for path in REAL_FILES if "circle" not in path.name], ids=lambda path: path.name)
def test_a_real_layout_is_exported(path: Path) -> None:
    imported = load(path)
    files = {each.name: each for each in written(imported, check(imported))}
    unwritten = {name for name, each in files.items() if each.content is None}
    assert unwritten == ({"layout.toml", "layout.json"} if imported.station is None else set())
    content = files["tag_records.bin"].content
    assert content is not None
    assert all(isinstance(decode(uid, pages), TagRecord) for uid, pages in from_bytes(content))


def test_a_junction_of_no_known_kind_comes_back_as_a_type_of_the_file() -> None:
    data = json.loads(json.dumps(RAILJSON_DATA))
    three = {"id": "three", "ports": ["A", "B1", "B2"], "groups": {}}
    three["groups"] = {way: [{"src": "A", "dst": port}] for way, port in (("l", "B1"), ("r", "B2"), ("too", "B2"))}
    data["extended_switch_types"] = [three]
    for switch in data["switches"]:
        if switch["id"] in ("P", "Q"):
            switch["switch_type"] = "three"
    for route in data["routes"]:
        told = route["switches_directions"]
        route["switches_directions"] = {name: {"A_B1": "l", "A_B2": "r"}.get(at, at) for name, at in told.items()}
    imported = load_text("file", json.dumps(data))
    assert in_railjson(imported) == imported
    with pytest.raises(Unsayable, match="'P' joins 3 ends of track in 3 positions"):
        native_data(imported)
