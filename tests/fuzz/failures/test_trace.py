"""Traces as files: what is written is read again, and what is no trace is refused in one line."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from collections.abc import Callable
from dataclasses import replace
from enum import Enum
from pathlib import Path
from typing import Any, get_args, get_origin, get_type_hints

import pytest
from hypothesis import given
from hypothesis import strategies as st
from jsonschema import Draft202012Validator

from fuzz.failures.causes import cause_of
from fuzz.failures.events import decoded, encoded, kinds_of
from fuzz.failures.trace import (
    SCHEMA,
    Event,
    LayoutFile,
    RideTrace,
    Trace,
    as_json,
    layout_file,
    layout_of,
    load_trace,
    parse,
    text_of,
)
from kernel.names import Block, Car, Point, Position, Read, Run, Train
from kernel.standstill import Standstill, ThroughLine
from models.layouts import BadInput
from proofs.catalogue import STEPS
from tests.fuzz.failures.samples import LAYOUTS, failing, found

TEXTS = st.text(st.characters(codec="utf-8", exclude_characters="\0"), min_size=1, max_size=12)
PLACE = "passing_station"


def values(kind: Any) -> st.SearchStrategy[Any]:
    """Any value of a kind."""
    if kind in (Run, Read, Standstill, ThroughLine):
        return st.builds(kind, *(values(each) for each in get_type_hints(kind).values()))
    if get_origin(kind) is frozenset:
        return st.frozensets(values(get_args(kind)[0]), max_size=4)
    if isinstance(kind, type) and issubclass(kind, Enum):
        return st.sampled_from(list(kind))
    plain = kind if kind in (bool, int) else kind.__supertype__
    return {bool: st.booleans(), int: st.integers(0, 2**70), str: TEXTS}[plain]


def events() -> st.SearchStrategy[Event]:
    """Any event of any transition."""
    return st.sampled_from(sorted(STEPS)).flatmap(
        lambda step: st.builds(
            Event,
            st.just(step),
            st.fixed_dictionaries({n: values(k) for n, k in kinds_of(step).items()}),
            TEXTS,
            st.booleans(),
        )
    )


@given(events())
def test_an_event_is_read_as_it_was_written(event: Event) -> None:
    assert decoded(event.step, json.loads(json.dumps(encoded(event.step, event.event)))) == event.event


@given(
    st.lists(events(), max_size=4),
    st.lists(TEXTS, min_size=1, max_size=3, unique=True),
    st.sampled_from([None, "a fault"]),
    st.sampled_from([None, 0, 7]),
)
def test_a_trace_is_read_as_it_was_written(
    taken: list[Event], names: list[str], planted: str | None, at: int | None
) -> None:
    trace = Trace(
        layout=LayoutFile("../layouts/x.toml", "0" * 64),
        trains={Train(name): (Car(f"{name}a"),) for name in names},
        at={Car(f"{name}a"): frozenset({Block("b"), Block(name)}) for name in names},
        lies={Point(name): Position("normal") for name in names},
        events=tuple(taken),
        seed=3,
        batch=4,
        number=5,
        planted=planted,
        faults=tuple(names),
        violated=tuple(names),
        at_step=at,
        broken_assumptions=tuple(names),
    )
    assert parse("x", text_of(trace)) == trace
    assert text_of(parse_trace(text_of(trace))) == text_of(trace)
    assert json.loads(text_of(trace)) == as_json(trace)


def parse_trace(text: str) -> Trace:
    trace = parse("x", text)
    assert isinstance(trace, Trace)
    return trace


def test_every_kind_of_event_is_covered_by_the_strategy() -> None:
    drawn = {str(kind) for step in STEPS for kind in kinds_of(step).values()}
    assert len(drawn) == 18


def test_the_schema_is_one_and_says_what_each_field_is() -> None:
    Draft202012Validator.check_schema(SCHEMA)
    assert set(SCHEMA["$defs"]["interlocking"]["properties"]) == {*as_json(failing()), "cause"}
    assert set(SCHEMA["properties"]["target"]["enum"]) <= set(SCHEMA["$defs"])


def test_the_cause_that_a_campaign_writes_is_read_over() -> None:
    trace = failing()
    assert parse("x", json.dumps({**as_json(trace), "cause": cause_of(trace).digest})) == trace


def test_a_ride_is_read_with_whatever_else_stands_there() -> None:
    text = '{"format": "heisoku trace 1", "target": "rides", "seed": 2, "ride": 9, "violated": ["x"], "plan": "…"}'
    assert parse("x", text) == RideTrace(2, 9, (), ("x",))


# ---- refused

Change = Callable[[dict[str, Any]], object]


def a_car(data: dict[str, Any]) -> str:
    """A car of the trace, whichever train is left of it."""
    return str(min(data["at"]))


WRONG: dict[str, tuple[Change, str, str]] = {
    "another format": (lambda data: data.update(format="heisoku trace 9"), "format", "heisoku trace 9"),
    "no format": (lambda data: data.pop("format"), "top level", "no 'format'"),
    "an unknown target": (lambda data: data.update(target="trams"), "target", "trams"),
    "no seed": (lambda data: data.pop("seed"), "top level", "no 'seed'"),
    "an unknown entry": (lambda data: data.update(colour=1), "top level", "'colour'"),
    "a bad hash": (lambda data: data["layout"].update(sha256="12"), "layout.sha256", "12"),
    "no trains": (lambda data: data.update(trains={}), "trains", ""),
    "a car of two trains": (lambda data: data["trains"].update(new=[a_car(data)]), "trains", "{car}"),
    "a car nowhere": (lambda data: data["at"].pop(a_car(data)), "at", "{car}"),
    "events that are no list": (lambda data: data.update(events={}), "events", "an object"),
    "an unknown transition": (lambda data: data["events"][2].update(step="fly"), "events[2].step", "fly"),
    "an event without a value": (
        lambda data: data["events"][1]["event"].pop("life"),
        "events[1].event.life",
        "missing",
    ),
    "an event with too much": (lambda data: data["events"][0]["event"].update(x=1), "events[0].event.x", "epoch"),
    "a text for a number": (lambda data: data["events"][0]["event"].update(epoch="1"), "events[0].event.epoch", "'1'"),
    "a truth for a number": (
        lambda data: data["events"][0]["event"].update(epoch=True),
        "events[0].event.epoch",
        "True",
    ),
    "a number for a truth": (lambda data: data["events"][1]["event"].update(at_rest=1), "events[1].event.at_rest", "1"),
    "blocks that are no list": (
        lambda data: data["events"][1]["event"].update(blocks="b"),
        "events[1].event.blocks",
        "b",
    ),
    "a run too short": (lambda data: data["events"][-1]["event"].update(run=[1, "1M"]), "event.run", "serial, train"),
    "a run of wrong kinds": (lambda data: data["events"][-1]["event"]["run"].insert(0, "x"), "event.run", "5 items"),
    "a step that is none": (lambda data: data.update(at_step=-1), "at_step", "-1"),
}


@pytest.mark.parametrize("name", WRONG)
def test_what_is_no_trace_is_refused_with_its_place(name: str) -> None:
    change, place, what = WRONG[name]
    data = json.loads(text_of(failing()))
    told = what.format(car=a_car(data))
    change(data)
    with pytest.raises(BadInput) as refused:
        parse("t.json", json.dumps(data))
    line = str(refused.value)
    assert line.startswith("t.json: ")
    assert place in line
    assert told in line
    assert "; " in line, "says what to do"
    assert len(line.splitlines()) == 1


@pytest.mark.parametrize("content", [b"", b"{", b"[1]", b"\xff\xfe", b'{"format": NaN}', b"null", b"[" * 5000, b"{}"])
def test_what_is_no_json_object_is_refused(content: bytes, tmp_path: Path) -> None:
    path = tmp_path / "t.json"
    path.write_bytes(content)
    with pytest.raises(BadInput, match=r"t\.json"):
        load_trace(path)


def test_a_file_that_is_not_there_is_refused(tmp_path: Path) -> None:
    with pytest.raises(BadInput, match="No such file"):
        load_trace(tmp_path / "none.json")


# ---- the layout of a trace


def test_the_layout_is_found_from_the_folder_of_the_trace(tmp_path: Path) -> None:
    (tmp_path / "layouts").mkdir()
    (tmp_path / "traces").mkdir()
    there = tmp_path / "layouts" / "p.toml"
    there.write_bytes(LAYOUTS[PLACE].read_bytes())
    trace = replace(failing(), layout=layout_file(there, tmp_path / "traces"))
    assert trace.layout.file == "../layouts/p.toml"
    assert layout_of(trace, tmp_path / "traces" / "t.json").layout.blocks
    there.write_text(there.read_text("utf-8") + "# changed\n", "utf-8")
    with pytest.raises(BadInput, match="has changed since"):
        layout_of(trace, tmp_path / "traces" / "t.json")
    there.unlink()
    with pytest.raises(BadInput, match="cannot be read"):
        layout_of(trace, tmp_path / "traces" / "t.json")


@pytest.mark.parametrize(
    ("change", "place"),
    [
        (lambda trace: replace(trace, at={**trace.at, Car("1Ma"): frozenset({Block("nowhere")})}), "at.1Ma"),
        (lambda trace: replace(trace, lies={}), "lies"),
        (lambda trace: replace(trace, lies={**trace.lies, Point("P9"): Position("normal")}), "lies"),
    ],
)
def test_a_start_that_is_not_of_the_layout_is_refused(change: Callable[[Trace], Trace], place: str) -> None:
    with pytest.raises(BadInput, match=place):
        layout_of(change(failing()), LAYOUTS[PLACE])


def test_what_a_play_saw_is_a_trace_of_it() -> None:
    trace = found("a terminal that obeys an older run")
    assert trace.events[0].step == "send_challenge"
    assert {event.by for event in trace.events} == {"traffic"}
    assert parse("x", text_of(trace)) == trace


DIRECTIONS = """
import sys
from models.layouts import load
from models.layouts.continuation import with_continuations
from models.world.formations import directions
for path in sys.argv[1:]:
    imported = load(path)
    print(path, sorted(directions(*with_continuations(imported.layout, imported.ground)).items()))
"""


def test_a_site_is_the_same_in_every_process() -> None:
    """Which car of a train leads must not depend on how texts are hashed, or no trace could be replayed."""
    root = Path(__file__).resolve().parents[3]
    said = {
        subprocess.run(
            [sys.executable, "-c", DIRECTIONS, *map(str, LAYOUTS.values())],
            env={**os.environ, "PYTHONHASHSEED": str(seed), "PYTHONPATH": str(root)},
            capture_output=True,
            text=True,
            check=True,
        ).stdout
        for seed in range(1, 6)
    }
    assert len(said) == 1
