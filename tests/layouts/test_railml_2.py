"""railML 2: the same network is the same layout as in railML 3, and what is wrong is said of the element."""

from __future__ import annotations

import json
import random
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import heisoku
from models.exit_codes import BAD_INPUT
from models.layouts import BadInput, check, load_text
from models.layouts.generate import network
from tests.layouts.railml_2_made import railml_2_of
from tests.layouts.railml_made import railml_of
from tests.layouts.stations import plain_station, railjson_of
from tests.layouts.test_railml import outcome, spoilt

DATA = railjson_of(plain_station())
RAILML_2 = railml_2_of(DATA)


def same_in_both(data: Any) -> None:
    newer, older = (load_text("file", text) for text in (railml_of(data, routes=False), railml_2_of(data)))
    assert older.layout == newer.layout
    assert older.ground == newer.ground
    assert check(older).verdict == check(newer).verdict


@pytest.mark.parametrize("version", ["2.0", "2.2", "2.5"])
def test_the_same_network_in_railml_2_and_3_is_the_same_layout(version: str) -> None:
    same_in_both(DATA)
    assert check(load_text("file", railml_2_of(DATA, version))).verdict == "holds"


@settings(max_examples=15, deadline=None)
@given(st.integers(1, 30), st.integers(0, 10**6))
def test_a_generated_network_in_railml_2_and_3_is_the_same_layout(routes: int, seed: int) -> None:
    same_in_both(railjson_of(network(routes, seed)))


def crossing(kind: str, halves: bool = False) -> str:
    """Two tracks that cross: told on one of them, the other in two; or told on both."""
    told = f"""<crossing id="X" pos="100" type="{kind}">
      <connection id="x1" ref="{"y1" if halves else "w1"}" orientation="incoming"/>
      <connection id="x2" ref="{"y2" if halves else "e1"}" orientation="outgoing"/></crossing>"""
    other = """<crossing id="Y" pos="100">
      <connection id="y1" ref="x1" orientation="incoming"/>
      <connection id="y2" ref="x2" orientation="outgoing"/></crossing>"""
    tracks = [_track("main", "<openEnd id='ma'/>", "<openEnd id='mb'/>", told, ("m1", 40))]
    if halves:
        tracks += [_track("side", "<openEnd id='sa'/>", "<openEnd id='sb'/>", other, ("s1", 40))]
    else:
        tracks += [
            _track("west", "<openEnd id='sa'/>", "<connection id='w1' ref='x1'/>", "", ("s1", 40)),
            _track("east", "<connection id='e1' ref='x2'/>", "<openEnd id='sb'/>", ""),
        ]
    return f'<railml version="2.4"><infrastructure><tracks>{"".join(tracks)}</tracks></infrastructure></railml>'


def _track(name: str, begin: str, end: str, connections: str, *signals: tuple[str, int]) -> str:
    told = "".join(f'<signal id="{signal}" pos="{pos}" dir="up"/>' for signal, pos in signals)
    return f"""<track id="{name}"><trackTopology><trackBegin id="{name}-b" pos="0">{begin}</trackBegin>
      <trackEnd id="{name}-e" pos="200">{end}</trackEnd><connections>{connections}</connections></trackTopology>
      <ocsElements><signals>{told}</signals></ocsElements></track>"""


@pytest.mark.parametrize("halves", [False, True])
def test_a_crossing_is_one_block(halves: bool) -> None:
    straight = load_text("file", crossing("simpleCrossing", halves))
    assert {"m1 - mb", "s1 - sb"} <= straight.layout.routes
    assert straight.layout.claims["m1 - mb"] & straight.layout.claims["s1 - sb"]  # type: ignore[index]


def test_a_double_slip_leads_four_ways_and_is_told_on_one_track() -> None:
    slip = load_text("file", crossing("doubleSwitchCrossing"))
    assert {"m1 - mb", "m1 - sb", "s1 - mb", "s1 - sb"} <= slip.layout.routes
    assert check(slip).verdict == "holds"
    with pytest.raises(BadInput, match="crossing 'X': is told on its other track as 'Y'"):
        load_text("file", crossing("doubleSwitchCrossing", halves=True))


CHANGES: tuple[tuple[str, str, str], ...] = (
    ('pos="3000"', 'pos="-1"', "track 'T0': ends at -1000 mm and begins at 0 mm"),
    ('pos="3000"', 'pos="far"', "trackEnd 'T0-e': pos is 'far', not a number"),
    ('id="P" pos="1000"', 'id="P" pos="9000"', "switch 'P': lies at 9000000 mm, not within its track"),
    ('id="P" pos="1000"', 'id="P" pos="2000"', "switch 'Q': lies at 2000000 mm, where another one does"),
    ('orientation="outgoing"', 'orientation="up"', "connection 'P-s': orientation is 'up'"),
    ('<connection id="P-b" ref="P-s"/>', '<connection id="P-b" ref="none"/>', "'P-b': refers to 'none', which is no"),
    ('<connection id="P-b" ref="P-s"/>', '<connection id="P-b" ref="Q-s"/>', "to 'Q-s', which refers to 'Q-b'"),
    ('ref="y-B"', 'ref="nobody"', "connection 'y-A': refers to 'nobody', which is no connection"),
    ('id="a" pos="400.000"', 'id="a" pos="4000"', "trainDetector 'a': lies at 4000000 mm, not on its track"),
    ('<trackBegin id="T1-b" pos="0">', '<x id="T1-b" pos="0">', "line"),
    ('<connection id="y-A"', '<connection id="y" ref="z"/><connection id="y-A"', "'y-A': is a second connection of"),
    ('id="P"', 'id="Q"', "this id is taken by a switch"),
    (' id="T0"', "", "has no attribute id"),
)


@pytest.mark.parametrize(("old", "new", "said"), CHANGES, ids=[said[:40] for _, _, said in CHANGES])
def test_what_is_wrong_is_said_of_the_element(old: str, new: str, said: str, tmp_path: Path) -> None:
    assert old in RAILML_2
    file = tmp_path / "changed.railml"
    file.write_text(RAILML_2.replace(old, new, 1), "utf-8")
    with pytest.raises(BadInput) as raised:
        load_text("changed", file.read_text("utf-8"))
    assert said in str(raised.value)
    assert heisoku.run(["check", str(file)]) == BAD_INPUT


def test_a_single_slip_is_refused_since_its_legs_are_not_told() -> None:
    with pytest.raises(BadInput, match="crossing 'X': is a simpleSwitchCrossing"):
        load_text("file", crossing("simpleSwitchCrossing"))


def test_signals_that_are_not_main_are_told_and_left_out() -> None:
    text = RAILML_2.replace('id="a-up" pos="400.000" dir="up" type="main"', 'id="a-up" pos="400.000" type="distant"')
    imported = load_text("file", text.replace('id="b-up" pos="900.000" dir="up"', 'id="b-up" pos="900.000"'))
    remarks = {remark.elements: remark.text for remark in imported.remarks}
    assert "no main signals" in remarks["a-up",]
    assert "say of no direction" in remarks["b-up",]
    assert not [route for route in imported.layout.routes if route.startswith(("a - b", "b - c"))]


def test_without_main_signals_there_is_nothing_to_derive_routes_from() -> None:
    with pytest.raises(BadInput, match="has no routes, and no signals"):
        load_text("file", RAILML_2.replace('type="main"', 'type="shunting"'))


@settings(max_examples=150, deadline=None)
@given(st.integers(0, 10**9))
def test_elements_dropped_doubled_and_changed(seed: int) -> None:
    outcome(spoilt(RAILML_2, random.Random(seed)))


def test_the_data_is_what_both_are_written_from() -> None:
    assert check(load_text("file", json.dumps(DATA))).verdict == "holds"


@pytest.mark.parametrize("at", ["<connections>", "<trackTopology>", "<tracks>"])
@pytest.mark.parametrize("entity", ['SYSTEM "file:///dev/zero"', '"<switch/>"'])
def test_an_entity_is_refused_since_what_it_stands_for_would_be_missed(at: str, entity: str) -> None:
    with pytest.raises(BadInput, match="uses the entity &x;"):
        load_text("file", f"<!DOCTYPE railml [<!ENTITY x {entity}>]>" + RAILML_2.replace(at, f"{at}&x;", 1))
