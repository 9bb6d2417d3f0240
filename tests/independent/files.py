"""Which layouts are enumerated, and what is written down of each.

Layouts that are not ours stand in a folder beside the repository, which need not be there.
"""

from __future__ import annotations

import hashlib
import json
import os
from collections.abc import Mapping
from itertools import pairwise
from pathlib import Path
from typing import Any

from tests.independent import raw_native, raw_railjson, raw_table
from tests.independent.raw_graph import Finding, Network, Route
from tests.independent.raw_table import TableRoute

ROOT = Path(__file__).parents[2]
FOLDER = Path(os.environ.get("HEISOKU_LAYOUTS") or ROOT.parent / "shared" / "layouts")
"""Layouts of others; ``HEISOKU_LAYOUTS`` names another folder."""
EXPECTED = Path(__file__).parent / "expected"

SAMPLES = ("junction.toml", "passing_station.toml", "terminus.toml")
OTHERS = (
    "osrd-nested_switches.json",
    "osrd-one_line.json",
    "osrd-overlapping_routes.json",
    "osrd-small_infra.json",
    "osrd-three_trains.json",
    "osrd-tiny_infra.json",
    "swtbahn-lite.yml",
)
WITHOUT_ROUTES = "osrd-circle_infra.json"

Enumerated = raw_railjson.Enumerated | raw_native.Enumerated | raw_table.Enumerated


def path_of(name: str) -> Path:
    return ROOT / "layouts" / name if name in SAMPLES else FOLDER / name


def enumerated(name: str) -> Enumerated:
    """The enumeration that fits the file."""
    path = path_of(name)
    readers = {".json": raw_railjson, ".toml": raw_native, ".yml": raw_table}
    found: Enumerated = readers[path.suffix].enumerate_file(path)
    return found


def blocks_of(found: Enumerated) -> set[str]:
    if not isinstance(found, raw_table.Enumerated):
        return set(found.network.blocks)
    return {*found.block_of.values(), *(route.start for route in found.routes.values())}


def network_of(found: Enumerated) -> Network | None:
    """The track; a table has none."""
    return None if isinstance(found, raw_table.Enumerated) else found.network


def facts_of(route: Route | TableRoute) -> dict[str, Any]:
    """What the importer must find of a route as well."""
    claims = route.claims
    return {
        "start": route.start,
        "covers": sorted(route.covers),
        "overlap": sorted(route.overlap),
        "claims": sorted(claims),
        "way": dict(pairwise(claims)),
        "destination": route.destination,
        "needs": dict(sorted(route.needs.items())),
        "released_after": {block: route.released_after[block] for block in sorted([route.start, *route.covers])},
    }


def plain(findings: list[Finding]) -> list[dict[str, Any]]:
    """Rule and elements, in order of name."""
    listed = sorted((finding.rule, sorted(set(finding.elements))) for finding in findings)
    return [{"rule": rule, "elements": elements} for rule, elements in listed]


def to_write_down(name: str) -> dict[str, Any]:
    """Verdict, counts and findings; of the routes themselves only a digest, for the files are not ours to copy."""
    found = enumerated(name)
    routes: Mapping[str, Route | TableRoute] = found.routes
    facts = {route: facts_of(of_route) for route, of_route in sorted(routes.items())}
    return {
        "file": name,
        "verdict": "does not hold" if found.violations else "holds",
        "counts": {"blocks": len(blocks_of(found)), "routes": len(found.routes)},
        "violations": plain(found.violations),
        "remarks": plain(found.remarks),
        "routes_sha256": hashlib.sha256(json.dumps(facts, sort_keys=True).encode()).hexdigest(),
    }


def written_down(name: str) -> dict[str, Any]:
    data: dict[str, Any] = json.loads((EXPECTED / f"{Path(name).stem}.json").read_text(encoding="utf-8"))
    return data
