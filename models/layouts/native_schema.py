"""The JSON Schema of the native layout format; ``layouts/layout.schema.json`` is this, written out."""

from __future__ import annotations

from typing import Any

from jsonschema import Draft202012Validator

from models.layouts.numbers import LONGEST_DISTANCE_MM

FORMAT = "heisoku-layout-1"


def _table(description: str, item: dict[str, Any]) -> dict[str, Any]:
    return {"type": "object", "description": description, "additionalProperties": item}


def _entries(required: list[str], properties: dict[str, Any]) -> dict[str, Any]:
    return {"type": "object", "required": required, "additionalProperties": False, "properties": properties}


def _text(description: str, **more: Any) -> dict[str, Any]:
    return {"type": "string", "minLength": 1, "description": description, **more}


def _pairs(description: str) -> dict[str, Any]:
    pair = {"type": "array", "items": {"type": "string"}, "minItems": 2, "maxItems": 2}
    return {"type": "array", "description": description, "items": pair}


def _position_mm(description: str, least: int = 0) -> dict[str, Any]:
    return {"type": "integer", "minimum": least, "maximum": LONGEST_DISTANCE_MM, "description": description}


TRACK = _entries(
    ["from", "to", "length_mm"],
    {
        "from": _text("Node the track begins at: a leg such as 'P1.tip', or any other name for a joint or an end."),
        "to": _text("Node the track ends at."),
        "length_mm": _position_mm("Length in mm.", 1),
        "boundaries": _table("Tag boundaries on the track: name and mm from its beginning.", _position_mm("mm")),
    },
)
POINT = _entries(
    [],
    {
        "kind": {
            "enum": ["turnout", "crossing", "single slip", "double slip"],
            "description": "Turnout if not given; a crossing does not move.",
        },
        "clear_mm": _table(
            "For each leg, how far from the point it is clear of the other leg, in mm.", _position_mm("mm", 1)
        ),
    },
)
BLOCK = _entries(
    ["track", "at_mm"], {"track": _text("Track."), "at_mm": _position_mm("Any place in the block, in mm.")}
)
ROUTE = _entries(
    ["from", "direction", "to"],
    {
        "from": _text("Boundary the route is entered at, or the end of track it starts from."),
        "direction": {
            "enum": ["forward", "backward"],
            "description": "Along the track that 'from' lies on: from its beginning to its end, or against.",
        },
        "to": _text("Boundary or end of track the route ends at."),
        "points": _table("Position of every point on the path and in the overlap.", _text("Position.")),
        "overlap_to": _text("Boundary or end of track at which the overlap ends."),
        "flank": _table("Position of points held beside the path.", _text("Position.")),
        "release_at": {
            "type": "array",
            "description": "Boundaries on the path up to which the route is released in parts.",
            "items": {"type": "string"},
        },
    },
)

SCHEMA: dict[str, Any] = {
    "$schema": "https://json-schema.org/draft/2020-12/schema",
    "title": "heisoku layout",
    **_entries(
        ["format", "tracks", "routes"],
        {
            "format": {"const": FORMAT, "description": "Names this format."},
            "name": _text("What the layout is called."),
            "trains": {
                "type": "array",
                "description": "The fleet: every train that may be on the line.",
                "items": {"type": "string", "minLength": 1},
                "minItems": 1,
                "uniqueItems": True,
            },
            "tracks": _table("Stretches of track between nodes.", TRACK),
            "points": _table("Points and crossings; their legs are nodes.", POINT),
            "blocks": _table("Names for blocks; a block without one is named after its ends.", BLOCK),
            "routes": _table("Routes.", ROUTE),
            "joints": {
                "type": "array",
                "description": "Every name at which two ends of track are joined, so that no others are.",
                "items": {"type": "string", "minLength": 1},
                "uniqueItems": True,
            },
            "laid_at_start": {
                "type": "array",
                "description": "Points that staff lay and lock for where a train stands, before the first start.",
                "items": {"type": "string", "minLength": 1},
                "uniqueItems": True,
            },
            "longest_train_mm": _position_mm("No train of the fleet is longer, in mm.", 1),
            "fouling": _pairs("Pairs of blocks, a train in either of which obstructs the other."),
            "held_by_authority": {
                "description": "Pairs (from, into) kept apart by train protection alone; 'rest': all such pairs.",
                "anyOf": [{"const": "rest"}, _pairs("Pairs of blocks.")],
            },
        },
    ),
}
VALIDATOR = Draft202012Validator(SCHEMA)
