"""What cannot be read as a layout is refused with one line that names file and place."""

from __future__ import annotations

import copy
import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
import yaml

from models.layouts import BadInput, load, load_text, reading, yaml_text
from models.layouts.generate import as_toml
from tests.layouts.stations import SHARED, needs_shared, plain_station, railjson_of

Data = dict[str, Any]
GOOD = railjson_of(plain_station())
BOMB = "interlocking-table: &a [lol]\n" + "".join(f"b{n}: &b{n} [*a, *a, *a]\n" for n in range(9))


def edited(edit: Callable[[Data], object]) -> bytes:
    data = copy.deepcopy(GOOD)
    edit(data)
    return json.dumps(data).encode()


def looped(data: Data) -> None:
    """A ring of its own, and a route on it to an exit elsewhere."""
    data["track_sections"].append({"id": "ring", "length": 100.0})
    data["switches"].append(_link("closed", ("ring", "END"), ("ring", "BEGIN")))
    data["detectors"] += [{"id": name, "track": "ring", "position": at} for name, at in (("r", 20.0), ("s", 60.0))]
    data["routes"][0]["entry_point"]["id"] = "r"


def _link(name: str, first: tuple[str, str], second: tuple[str, str]) -> Data:
    ports = {port: {"track": t, "endpoint": e} for port, (t, e) in (("A", first), ("B", second))}
    return {"id": name, "switch_type": "link", "ports": ports}


NO_PORTS = {"id": "odd", "ports": [], "groups": {"G": []}}
RAILJSON: dict[str, tuple[bytes, str]] = {
    "truncated": (json.dumps(GOOD).encode()[:-200], "line 1"),
    "empty": (b"", "empty"),
    "only blanks": (b"  \n\n", "empty"),
    "wrong encoding": ('{"x": "é"}'.encode("utf-16"), "UTF-8"),
    "latin-1": ('{"x": "é"}'.encode("latin-1"), "UTF-8"),
    "zero bytes": (b'{"x": "\0"}', "zero byte"),
    "not an object": (b'["a"]', "top level"),
    "missing section": (edited(lambda d: d.pop("detectors")), "detectors"),
    "missing port": (edited(lambda d: d["switches"][0]["ports"].pop("A")), "no port A"),
    "needless port": (edited(lambda d: d["switches"][0]["ports"].update(C=d["switches"][0]["ports"]["A"])), "port C"),
    "port joined twice": (
        edited(lambda d: d["switches"][0]["ports"].update(A=d["switches"][1]["ports"]["A"])),
        "already",
    ),
    "unknown switch type": (edited(lambda d: d["switches"][0].update(switch_type="wye")), "wye"),
    "unknown port track": (edited(lambda d: d["switches"][0]["ports"]["A"].update(track="nix")), "nix"),
    "unknown detector track": (edited(lambda d: d["detectors"][0].update(track="nix")), "nix"),
    "duplicate route": (edited(lambda d: d["routes"].append(d["routes"][0])), "'a-d'"),
    "duplicate switch": (edited(lambda d: d["switches"].append(d["switches"][0])), "'P'"),
    "duplicate detector": (edited(lambda d: d["detectors"].append(d["detectors"][0])), "taken by detectors[0]"),
    "duplicate track": (edited(lambda d: d["track_sections"].append(d["track_sections"][0])), "'w'"),
    "detector and stop alike": (edited(lambda d: d["buffer_stops"][0].update(id="a")), "'a'"),
    "NaN": (edited(lambda d: d["detectors"][0].update(position=float("nan"))), "NaN"),
    "infinite": (edited(lambda d: d["track_sections"][0].update(length=float("inf"))), "Infinity"),
    "1e308": (edited(lambda d: d["detectors"][0].update(position=1e308)), "1e+308"),
    "1e309": (json.dumps(GOOD).encode().replace(b"400.0", b"1e309"), "inf"),
    "a huge integer": (json.dumps(GOOD).encode().replace(b"400.0", b"9" * 5000), "number"),
    "negative": (edited(lambda d: d["detectors"][0].update(position=-1)), "-1 m"),
    "length 0": (edited(lambda d: d["track_sections"][0].update(length=0)), "length"),
    "length 1e308": (edited(lambda d: d["track_sections"][0].update(length=1e308)), "length"),
    "beyond the track": (edited(lambda d: d["detectors"][0].update(position=1000.001)), "'a'"),
    "position as text": (edited(lambda d: d["detectors"][0].update(position="400")), "detectors[0].position"),
    "position true": (edited(lambda d: d["detectors"][0].update(position=True)), "detectors[0].position"),
    "unknown entry": (edited(lambda d: d["routes"][0]["entry_point"].update(id="nix")), "'nix'"),
    "unknown exit": (edited(lambda d: d["routes"][0]["exit_point"].update(id="nix")), "'nix'"),
    "unknown release detector": (edited(lambda d: d["routes"][0].update(release_detectors=["nix"])), "'nix'"),
    "unknown switch": (edited(lambda d: d["routes"][0]["switches_directions"].update(nix="A_B1")), "'nix'"),
    "stop called detector": (edited(lambda d: d["routes"][-1]["entry_point"].update(type="Detector")), "'west'"),
    "unknown direction": (edited(lambda d: d["routes"][0].update(entry_point_direction="UP")), "UP"),
    "route through nothing": (
        edited(lambda d: d["routes"][0]["exit_point"].update(type="BufferStop", id="west")),
        "'a-d'",
    ),
    "route off the track": (edited(lambda d: d["routes"][-1].update(entry_point_direction="STOP_TO_START")), "'west'"),
    "route in a loop": (edited(looped), "loop"),
    "no routes": (edited(lambda d: d.update(routes=[])), "has no routes: nothing to check"),
    "key twice": (b'{"routes": [], "routes": []}', "'routes'"),
    "name of two lines": (edited(lambda d: d["detectors"][0].update(id="a\nb")), "detectors[0].id"),
    "half a character": (json.dumps(GOOD).encode().replace(b'"t1"', b'"\\ud800"'), "\\ud800"),
    "half a character in what is not read": (
        edited(lambda d: d.update({"derailers\ud83d": [{"id": "a\ud83d\ude00\\ud800\ud800"}]})),
        "holds \\ud83d",
    ),
    "half a character behind others": (b'{\n"a": "\\\\ud800 \\ud83d\\ude00 \\u00e9 \\udC00"}', "line 2 column 35"),
    "no ports": (edited(lambda d: d.update(extended_switch_types=[NO_PORTS])), "has fewer than two ports"),
    "a name that is not seen": (edited(lambda d: d["detectors"][0].update(id="a\u3164")), "U+3164"),
    "group joins a port twice": (
        edited(
            lambda d: d.update(
                extended_switch_types=[
                    {
                        "id": "odd",
                        "ports": ["A", "B"],
                        "groups": {"X": [{"src": "A", "dst": "B"}, {"src": "A", "dst": "B"}]},
                    }
                ]
            )
        ),
        "odd",
    ),
    "deep nesting": (b'{"routes": ' + b"[" * 100_000 + b"]" * 100_000 + b"}", "nesting"),
    "deep lists": (b"[" * 100_000, "nesting"),
    "deep objects": (b'{"a":' * 100_000, "nesting"),
    "a TOML key of many parts": (b'format = "heisoku-layout-1"\n' + b"a." * 50_000 + b"a = 1", "nesting"),
    "a TOML key of many quoted parts": (b'format = "heisoku-layout-1"\n' + b'"a" . ' * 9_000 + b"a = 1", "nesting"),
    "deep TOML": (b'format = "heisoku-layout-1"\na = ' + b"[" * 100_000, "nesting"),
    "deep YAML": (b"interlocking-table: " + b"[" * 100_000, "nesting"),
    "alias bomb": (BOMB.encode(), "anchor or alias"),
    "truncated YAML": (b"interlocking-table:\n  - id: 1\n    path: [a, ", "line"),
    "YAML tag": (b"interlocking-table: !!python/object/apply:os.system [ls]", "interlocking-table"),
    "two YAML documents": (b"a: 1\n---\nb: 2\n", "second document"),
    "XML": (b"<html/>", "is XML, but html and no railML"),
    "railML of no version": (b"<railML/>", "has no attribute version"),
    "railML 2": (b"<railml version='2.4'/>", "has no track with a trackTopology"),
    "railML 1": (b"<railml version='1.1'/>", "railML 1.1, which is not read"),
    "nonsense": (b"hello world", "line 1"),
    "TOML of another kind": (b"[project]\nname = 'x'\n", "has no 'format'"),
}


@pytest.mark.parametrize("name", sorted(RAILJSON))
def test_bad_file_is_refused_in_one_line(name: str, tmp_path: Path) -> None:
    content, said = RAILJSON[name]
    file = tmp_path / "layout.any"
    file.write_bytes(content)
    with pytest.raises(BadInput) as refused:
        load(file)
    line = str(refused.value)
    assert "\n" not in line
    assert line.isprintable()
    assert line.startswith(f"{file}: ")
    assert said in line


def native(edit: Callable[[Data], object]) -> str:
    data = copy.deepcopy(plain_station())
    edit(data)
    return as_toml(data)


NATIVE: dict[str, tuple[str, str]] = {
    "unknown key": (native(lambda d: d.update(colour="red")), "colour"),
    "unknown key of a route": (native(lambda d: d["routes"]["a-d"].update(speed=3)), "routes.a-d: has an unknown"),
    "length as text": (native(lambda d: d["tracks"]["w"].update(length_mm="1 m")), "tracks.w.length_mm"),
    "length in fractions": (native(lambda d: d["tracks"]["w"].update(length_mm=0.5)), "tracks.w.length_mm"),
    "boundary at the end": (native(lambda d: d["tracks"]["w"]["boundaries"].update(a=0)), "boundaries.a"),
    "boundary twice": (native(lambda d: d["tracks"]["t1"]["boundaries"].update(a=5)), "'a'"),
    "three tracks at a joint": (native(lambda d: d["tracks"]["w"].update({"from": "y"})), "'y' joins 3"),
    "leg that is none": (native(lambda d: d["tracks"]["w"].update(to="P.top")), "no leg 'top'"),
    "leg of no point": (native(lambda d: d["tracks"]["w"].update({"from": "R.tip"})), "no point 'R'"),
    "leg without track": (native(lambda d: d["tracks"]["w"].update(to="elsewhere")), "leg 'tip' meets no track"),
    "two tracks at a leg": (native(lambda d: d["tracks"]["w"].update({"from": "P.tip"})), "leg 'tip'"),
    "position of no point": (native(lambda d: d["routes"]["a-d"]["points"].update(R="normal")), "'R'"),
    "flank of no position": (native(lambda d: d["routes"]["a-d"].update(flank={"Q": "up"})), "'up'"),
    "block off the track": (native(lambda d: d.update(blocks={"b": {"track": "w", "at_mm": 2_000_000}})), "beyond"),
    "block at a boundary": (native(lambda d: d.update(blocks={"b": {"track": "w", "at_mm": 400_000}})), "boundary"),
    "fouling of no block": (native(lambda d: d.update(fouling=[["x", "y"]])), "'x'"),
    "overlap behind the exit": (native(lambda d: d["routes"]["a-d"].update(overlap_to="b")), "'b'"),
    "overlap at a buffer stop": (
        native(lambda d: d["routes"].update(o={"from": "h", "direction": "forward", "to": "east", "overlap_to": "a"})),
        "overlap",
    ),
    "no routes": (native(lambda d: d.update(routes={})), "has no routes"),
}


@pytest.mark.parametrize("name", sorted(NATIVE))
def test_bad_native_file_is_refused_in_one_line(name: str, tmp_path: Path) -> None:
    content, said = NATIVE[name]
    file = tmp_path / "layout.toml"
    file.write_text(content, "utf-8")
    with pytest.raises(BadInput) as refused:
        load(file)
    assert said in str(refused.value)
    assert str(refused.value).isprintable()


def test_absent_file_and_folder_are_refused(tmp_path: Path) -> None:
    for path in (tmp_path / "none.toml", tmp_path):
        with pytest.raises(BadInput, match="file"):
            load(path)


@needs_shared
def test_layout_without_routes_is_refused() -> None:
    with pytest.raises(BadInput, match="has no routes: nothing to check"):
        load(SHARED / "osrd-circle_infra.json")


@needs_shared
@pytest.mark.parametrize("cut", [2, 100, 5_000, 16_000])
def test_truncated_real_file_is_refused(cut: int, tmp_path: Path) -> None:
    file = tmp_path / "cut.json"
    file.write_bytes((SHARED / "osrd-tiny_infra.json").read_bytes()[:-cut])
    with pytest.raises(BadInput, match="is not JSON"):
        load(file)


JOINED_NAMES = """
format = "heisoku-layout-1"
name = "Marks and blocks whose names, joined, are the same"
trains = ["T1"]
held_by_authority = "rest"
[tracks.line]
from = "west end"
to = "east end"
length_mm = 3_000_000
boundaries = { "x@y" = 1_000_000, "b" = 1_300_000, "x" = 2_000_000, "c" = 2_500_000 }
[blocks]
"z" = { track = "line", at_mm = 100_000 }
"w" = { track = "line", at_mm = 1_100_000 }
"y@z" = { track = "line", at_mm = 1_600_000 }
"y@w" = { track = "line", at_mm = 2_100_000 }
[routes."through"]
from = "x@y"
direction = "forward"
to = "c"
"""


def test_tags_of_two_boundaries_are_never_one() -> None:
    layout = load_text("joined.toml", JOINED_NAMES).layout
    assert len(layout.tag_in) == 2 * 4
    assert all(layout.tag_in[tag] != layout.tag_in[layout.partner[tag]] for tag in layout.tag_in)


def test_a_point_does_not_take_the_place_of_a_joint() -> None:
    text = """
format = "heisoku-layout-1"
name = "A point called like a joint"
trains = ["T1"]
held_by_authority = "rest"
[tracks.west]
from = "west end"
to = "joint n.tip"
length_mm = 1_000_000
[tracks.main]
from = "joint n.normal"
to = "east end"
length_mm = 1_000_000
boundaries = { B = 100_000 }
[tracks.branch]
from = "joint n.reverse"
to = "n"
length_mm = 200_000
[tracks.siding]
from = "n"
to = "siding stop"
length_mm = 1_000_000
[points]
"joint n" = {}
[routes."through"]
from = "west end"
direction = "forward"
to = "east end"
points = { "joint n" = "normal" }
"""
    with pytest.raises(BadInput, match="a node where two tracks join has the name 'joint n'"):
        load_text("joint.toml", text)


def test_a_file_without_end_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(reading, "LARGEST_FILE", 10_000)
    with pytest.raises(BadInput, match="holds more than 10,000 bytes"):
        load(Path("/dev/zero"))


@pytest.mark.parametrize("loader", [yaml_text.Loader, yaml.Loader])
def test_half_a_character_in_yaml_is_refused_by_either_parser(loader: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(yaml_text, "Loader", loader)
    with pytest.raises(BadInput, match="line 2"):
        load_text("half.yml", 'interlocking-table: []\nodd: "\\ud800"\n')


def unseen() -> list[str]:
    """Default_Ignorable_Code_Point as Unicode 15 has it, and the Braille cell without dots."""
    ranges = "ad 34f 61c 115f-1160 17b4-17b5 180b-180f 200b-200f 202a-202e 2060-206f 2800 3164 fe00-fe0f feff ffa0"
    ends = [[int(end, 16) for end in each.split("-")] for each in f"{ranges} fff0-fff8 1bca0-1bca3 1d173-1d17a".split()]
    return [
        chr(sign) for first, *last in [*ends, [0xE0000, 0xE0FFF]] for sign in range(first, (last or [first])[0] + 1)
    ]


def test_what_is_drawn_as_nothing_is_no_part_of_a_name() -> None:
    for sign in unseen():
        with pytest.raises(BadInput, match="not usable as a name"):
            reading.identifier("x", "y", f"a{sign}b")
    assert reading.identifier("x", "y", "3番線 Übergabe 1") == "3番線 Übergabe 1"
