"""A layout file surveyed: rails, boundaries and what each route is to run over, read off the file alone.

Nothing here is of the project's own importer.  RailJSON, the native format, railML and interlocking tables all
come out as the same rails (:class:`Network`); a route is where it is entered, its points and where it ends.
"""

from __future__ import annotations

import json
import tomllib
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import yaml

from tests.independent import raw_native, raw_railjson, raw_railml, raw_railml_2
from tests.independent.layouts import survey_railml, survey_table
from tests.independent.layouts.rails import Line, Survey
from tests.independent.raw_graph import Network, Place

CLEAR_MM = 20_000
"""So far beyond a point or a crossing the legs foul each other, where the file does not say how far."""


def survey_file(path: Path) -> Survey:
    """The rails and routes of a file of any of the formats."""
    return survey_text(path.name, path.read_text(encoding="utf-8"))


def survey_text(name: str, text: str) -> Survey:
    """The same of a text; the end of its name tells the format."""
    match Path(name).suffix:
        case ".json":
            return of_railjson(json.loads(text))
        case ".toml":
            return of_native(tomllib.loads(text))
        case ".yml":
            return survey_table.survey(yaml.safe_load(text))
    return of_railjson(raw_railml_2.data_of(text)) if raw_railml.is_version_2(text) else survey_railml.survey(text)


def of_railjson(data: Mapping[str, Any]) -> Survey:
    """The rails and routes of RailJSON."""
    network = raw_railjson.network_of(_put_off_ends(data))
    lines = {}
    for row in data["routes"]:
        entry, heading = row["entry_point"]["id"], 1 if row["entry_point_direction"] == "START_TO_STOP" else -1
        positions = row.get("switches_directions") or row.get("track_nodes_directions") or {}
        last = row["exit_point"]["id"]
        lines[row["id"]] = Line(row["id"], place_of(network, entry, heading), positions, last, last)
    return Survey(network, lines, marks_of(network), CLEAR_MM)


def _put_off_ends(data: Mapping[str, Any]) -> dict[str, Any]:
    """A detector at the very end of a track is taken to lie a millimetre inside."""
    lengths = {track["id"]: track["length"] for track in data["track_sections"]}
    detectors = [
        {**each, "position": min(max(each["position"], 0.001), lengths[each["track"]] - 0.001)}
        for each in data["detectors"]
    ]
    return {**data, "detectors": detectors}


def of_native(data: Mapping[str, Any]) -> Survey:
    """The rails and routes of the native format."""
    network = raw_native.network_of(dict(data))
    lines = {}
    for name, row in data["routes"].items():
        entry = place_of(network, row["from"], 1 if row["direction"] == "forward" else -1)
        lines[name] = Line(name, entry, row.get("points", {}), row["to"], row.get("overlap_to", row["to"]))
    return Survey(network, lines, marks_of(network), CLEAR_MM)


def place_of(network: Network, name: str, heading: int) -> Place:
    """A boundary or an end of track, looked at in a direction."""
    if name in network.stops.values():
        track, end = network.end(name)
        return Place(track, network.lengths[track] if end else 0, heading)
    return Place(*network.cut(name), heading)


def marks_of(network: Network) -> dict[str, tuple[str, int]]:
    """Where each boundary lies, by name."""
    return {name: (track, mm) for track, cuts in network.cuts.items() for mm, name in cuts}
