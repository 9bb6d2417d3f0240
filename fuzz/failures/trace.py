"""The trace of a failure: where trains stood, what happened step by step, and what was false then.

A trace is a small JSON file; ``trace.schema.json`` beside this file says what stands in it.  The
layout it speaks of lies beside it, so that a campaign's folder can be carried elsewhere.
"""

from __future__ import annotations

import hashlib
import json
import os
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from jsonschema import Draft202012Validator

from fuzz.failures.events import Json, NotSo, decoded, encoded
from kernel.names import Block, Car, Point, Position, Train
from models.layouts import BadInput, Imported, load_text
from models.layouts.reading import parse_json, read_text, validate
from models.simulator.play import site_of
from models.world.state import Site
from proofs.catalogue import STEPS

FORMAT = "heisoku trace 1"
TRAFFIC = "traffic"
"""Who did a step that no fault did."""
SCHEMA_FILE = Path(__file__).with_name("trace.schema.json")
SCHEMA: Mapping[str, Any] = json.loads(SCHEMA_FILE.read_text("utf-8"))
WHAT_TO_DO = "see fuzz/failures/trace.schema.json, or take the trace from the campaign again"


@dataclass(frozen=True)
class Event:
    """One step: the transition, what it is told, and who did it.

    ``by``: the name of a fault, or ``traffic``.
    ``beyond``: taken although an assumption about nature is false.
    """

    step: str
    event: Mapping[str, Any]
    by: str = TRAFFIC
    beyond: bool = False


@dataclass(frozen=True)
class LayoutFile:
    """A layout file by its path, from the folder of the trace, and the hash of its bytes."""

    file: str
    sha256: str


@dataclass(frozen=True)
class Trace:
    """A run of traffic on a layout, from the moment when everything has just started.

    ``seed``, ``batch``, ``number``: where in a campaign it is from.
    ``planted``: the name of the planted fault that ran, if any.
    ``trains``: the cars of each train, in order.  ``at``, ``lies``: where cars stand and how points lie at the start.
    ``faults``: what was drawn for this run.
    ``violated``: the invariants that are the first to be false, ``at_step``: after so many events.
    ``broken_assumptions``: of nature, by the events that are beyond them.
    """

    layout: LayoutFile
    trains: Mapping[Train, tuple[Car, ...]]
    at: Mapping[Car, frozenset[Block]]
    lies: Mapping[Point, Position]
    events: tuple[Event, ...]
    seed: int = 0
    batch: int = 0
    number: int = 0
    planted: str | None = None
    faults: tuple[str, ...] = ()
    violated: tuple[str, ...] = ()
    at_step: int | None = None
    broken_assumptions: tuple[str, ...] = ()


@dataclass(frozen=True)
class RideTrace:
    """A ride of a train with faulty sensors, by its numbers: everything follows from them.

    ``beyond``: the faults drawn from beyond their declared range.  ``violated``: the claims that were broken.
    """

    seed: int
    ride: int
    beyond: tuple[str, ...] = ()
    violated: tuple[str, ...] = ()
    broken_assumptions: tuple[str, ...] = ()


@dataclass(frozen=True)
class LinkTrace:
    """A run of the radio link, by its numbers: everything follows from them, the weights and the planted fault.

    ``weights``: how often each threat was drawn; none: all as declared.  ``violated``: the claims that were false.
    """

    seed: int
    batch: int
    run: int
    weights: tuple[float, ...] = ()
    planted: str | None = None
    violated: tuple[str, ...] = ()
    at_step: int | None = None


@dataclass(frozen=True)
class BatchTrace:
    """A walk, or a batch of jolted states, by its numbers.

    ``theory``, ``walk``: what was walked through, and which walk of the batch.  ``layout``: a jolted state's, from the
    folder of the trace.
    """

    target: str
    seed: int
    batch: int
    violated: tuple[str, ...]
    planted: str | None = None
    theory: str = ""
    walk: int = 0
    layout: str = ""


@dataclass(frozen=True)
class LineTrace:
    """A simulated line: ``told`` is what it follows from, as plain data (``fuzz.simulation.lines``).

    ``violated``: the oracles and invariants that were false, in second ``at_s``.
    """

    layout: LayoutFile
    told: Mapping[str, Any]
    violated: tuple[str, ...]
    at_s: int


AnyTrace = Trace | RideTrace | LinkTrace | BatchTrace | LineTrace
"""What a trace file may hold."""

# ---- writing


def as_json(trace: Trace) -> dict[str, Any]:
    """A trace as plain data, in a fixed order."""
    return {
        "format": FORMAT,
        "target": "interlocking",
        "layout": {"file": trace.layout.file, "sha256": trace.layout.sha256},
        "seed": trace.seed,
        "batch": trace.batch,
        "trace": trace.number,
        "planted": None if trace.planted is None else {"name": trace.planted},
        "trains": {train: list(cars) for train, cars in sorted(trace.trains.items())},
        "at": {car: sorted(blocks) for car, blocks in sorted(trace.at.items())},
        "lies": dict(sorted(trace.lies.items())),
        "faults": list(trace.faults),
        "events": [event_as_json(event) for event in trace.events],
        "violated": list(trace.violated),
        "at_step": trace.at_step,
        "broken_assumptions": list(trace.broken_assumptions),
    }


def event_as_json(event: Event) -> dict[str, Json | dict[str, Json]]:
    """One event as plain data; ``beyond`` only where it is."""
    told: dict[str, Json | dict[str, Json]] = {
        "step": event.step,
        "by": event.by,
        "event": encoded(event.step, event.event),
    }
    return {**told, "beyond": True} if event.beyond else told


def text_of(trace: Trace) -> str:
    """A trace as text: the same trace is the same text; a line for each entry and for each event."""
    data = as_json(trace)
    lines = []
    for name, value in data.items():
        if name == "events" and value:
            inner = ",\n".join(f"  {_compact(event)}" for event in value)
            lines.append(f' "events": [\n{inner}\n ]')
        else:
            lines.append(f" {json.dumps(name)}: {_compact(value)}")
    return "{\n" + ",\n".join(lines) + "\n}\n"


def _compact(value: Any) -> str:
    return json.dumps(value, ensure_ascii=False)


# ---- reading


def load_trace(path: Path) -> AnyTrace:
    """Read a trace file.

    Raises:
        BadInput: the file is no trace; one line says where and what.
    """
    try:
        text = read_text(path)
    except BadInput as bad:
        raise BadInput(bad.file, bad.place, bad.what, "give the path of a trace") from bad
    return parse(str(path), text)


def parse(name: str, text: str) -> AnyTrace:
    """Read a trace from a text; ``name`` stands for the file in messages."""
    try:
        data = parse_json(name, text)
        validate(name, data, Draft202012Validator({key: SCHEMA[key] for key in ("type", "required", "properties")}))
        target = data["target"]
        validate(name, data, Draft202012Validator({**SCHEMA["$defs"][target], "$defs": SCHEMA["$defs"]}))
    except BadInput as bad:
        raise BadInput(bad.file, bad.place, bad.what, WHAT_TO_DO) from bad
    if target == "rides":
        return _ride(data)
    if target in ("walks", "jolted"):
        return _batch(data)
    if target == "lines":
        layout = LayoutFile(data["layout"]["file"], data["layout"]["sha256"])
        return LineTrace(layout, data, tuple(data["violated"]), data["at_s"])
    return _link(data) if target == "link" else _interlocking(name, data)


def _batch(data: Mapping[str, Any]) -> BatchTrace:
    planted = data.get("planted")
    return BatchTrace(
        target=data["target"],
        seed=data["seed"],
        batch=data["batch"],
        violated=tuple(data["violated"]),
        planted=None if planted is None else planted["name"],
        theory=data.get("theory", ""),
        walk=data.get("walk", 0),
        layout=data.get("layout", {}).get("file", ""),
    )


def _ride(data: Mapping[str, Any]) -> RideTrace:
    return RideTrace(
        seed=data["seed"],
        ride=data["ride"],
        beyond=tuple(data.get("beyond", ())),
        violated=tuple(data["violated"]),
        broken_assumptions=tuple(data.get("broken_assumptions", ())),
    )


def _link(data: Mapping[str, Any]) -> LinkTrace:
    planted = data.get("planted")
    return LinkTrace(
        seed=data["seed"],
        batch=data["batch"],
        run=data["run"],
        weights=tuple(data.get("weights", ())),
        planted=None if planted is None else planted["name"],
        violated=tuple(data["violated"]),
        at_step=data.get("at_step"),
    )


def _interlocking(name: str, data: Mapping[str, Any]) -> Trace:
    trains = {Train(train): tuple(map(Car, cars)) for train, cars in data["trains"].items()}
    cars = [car for each in trains.values() for car in each]
    if len(cars) > len(set(cars)):
        twice = next(car for car in cars if cars.count(car) > 1)
        raise BadInput(name, "trains", f"car '{twice}' is of two trains", "name every car otherwise")
    if set(data["at"]) != set(cars):
        odd = min(set(data["at"]) ^ set(cars))
        raise BadInput(name, "at", f"car '{odd}' stands in only one of 'at' and 'trains'", "say where every car is")
    return Trace(
        layout=LayoutFile(data["layout"]["file"], data["layout"]["sha256"]),
        trains=trains,
        at={Car(car): frozenset(map(Block, blocks)) for car, blocks in data["at"].items()},
        lies={Point(point): Position(lies) for point, lies in data["lies"].items()},
        events=tuple(_event(name, at, event) for at, event in enumerate(data["events"])),
        seed=data["seed"],
        batch=data["batch"],
        number=data["trace"],
        planted=None if data["planted"] is None else data["planted"]["name"],
        faults=tuple(data["faults"]),
        violated=tuple(data["violated"]),
        at_step=data["at_step"],
        broken_assumptions=tuple(data["broken_assumptions"]),
    )


def _event(name: str, at: int, data: Mapping[str, Any]) -> Event:
    step = data["step"]
    if step not in STEPS:
        raise BadInput(
            name, f"events[{at}].step", f"there is no transition '{step}'", "take one of proofs/transitions.py"
        )
    try:
        return Event(step, decoded(step, data["event"]), data["by"], data.get("beyond", False))
    except NotSo as wrong:
        raise BadInput(name, f"events[{at}].event.{wrong.place}", wrong.what, WHAT_TO_DO) from wrong


# ---- the layout of a trace


def layout_of(trace: Trace, path: Path) -> Imported:
    """Read the layout of the trace at ``path``, which must be the one that the trace was made on.

    Raises:
        BadInput: it is not there, is no layout, has changed, or has other blocks and points than the trace.
    """
    imported = layout_at(trace.layout, path)
    _fits(trace, str(path), site(trace, imported))
    return imported


def layout_at(layout: LayoutFile, path: Path) -> Imported:
    """Read the layout that a trace at ``path`` names, which must be the one that the trace was made on.

    Raises:
        BadInput: it is not there, is no layout, or has changed.
    """
    place = path.parent / layout.file
    try:
        content = place.read_bytes()
    except OSError as error:
        what = f"the layout {place} cannot be read ({error.strerror})"
        raise BadInput(str(path), "layout.file", what, "put the layout there, or name where it is") from error
    found = hashlib.sha256(content).hexdigest()
    if found != layout.sha256:
        what = f"the layout {place} has changed since (sha256 {found[:12]}…, not {layout.sha256[:12]}…)"
        raise BadInput(str(path), "layout.sha256", what, "put the layout of the campaign there")
    return load_text(str(place), read_text(place))


def _fits(trace: Trace, name: str, there: Site) -> None:
    """The blocks and points of the start are the layout's."""
    blocks, points = there.layout.blocks, there.layout.points
    for car, stood in trace.at.items():
        for block in sorted(stood - blocks):
            raise BadInput(name, f"at.{car}", f"there is no block '{block}' in the layout", WHAT_TO_DO)
    for point in sorted(points ^ frozenset(trace.lies)):
        what = f"point '{point}' stands in only one of 'lies' and the layout"
        raise BadInput(name, "lies", what, "say how every point lies")


def site(trace: Trace, imported: Imported) -> Site:
    """The site of a trace: the layout with its continuations, and the trains of the trace."""
    return site_of(imported.layout, imported.ground, imported.records, trace.trains)


def layout_file(path: Path, beside: Path) -> LayoutFile:
    """Name a layout file for traces in the folder ``beside``."""
    return LayoutFile(Path(os.path.relpath(path, beside)).as_posix(), hashlib.sha256(path.read_bytes()).hexdigest())


# ---- what a play has seen


def recorded(
    layout: LayoutFile,
    trains: Mapping[Train, Iterable[Car]],
    at: Mapping[Car, frozenset[Block]],
    lies: Mapping[Point, Position],
    taken: Iterable[tuple[str, Mapping[str, Any]]],
) -> Trace:
    """Make a trace of the steps that a ``Play``'s watcher was told: name and event of each that changed something."""
    return Trace(
        layout=layout,
        trains={train: tuple(cars) for train, cars in trains.items()},
        at=dict(at),
        lies=dict(lies),
        events=tuple(Event(step, dict(event)) for step, event in taken),
    )


def found(trace: Trace, violated: tuple[str, ...], at_step: int | None, broken: tuple[str, ...] = ()) -> Trace:
    """Give the trace with what its replay came to, cut after the step at which it came to it."""
    events = trace.events if at_step is None else trace.events[:at_step]
    return replace(trace, events=events, violated=violated, at_step=at_step, broken_assumptions=broken)
