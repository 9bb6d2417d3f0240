"""What no railway is like: blocks too short for their tags, distances no tag holds, track that hangs on nothing."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

import networkx

from kernel.names import Block, Tag
from models.layouts.alike import say_what_is_alike
from models.layouts.blocks import Blocks
from models.layouts.distances import Onward
from models.layouts.findings import Findings
from models.layouts.following import Path
from models.layouts.measures import (
    LONGEST_BLOCK_MM,
    SHORTEST_BLOCK_MM,
    SHORTEST_OVERLAP_MM,
    SHORTEST_VEHICLE_MM,
    TAG_MM,
)
from models.layouts.numbers import LONGEST_DISTANCE_MM
from models.layouts.told import Told
from models.layouts.track import HIGH, LOW, Heading, Joint

ROOM = "a block has room for its tags"
HOLDS = "a distance fits its tag"
ENDS = "no track goes on behind a buffer stop at a joint"
BLADES = "a boundary's tags lie clear of points and crossings"
OVERLAP = "an overlap is longer than a train slips"


def say_what_is_no_railway(
    blocks: Blocks, ways: Mapping[Tag, Onward], tag_in: Mapping[Tag, Block], findings: Findings
) -> None:
    """Blocks that are too short or too long, measured from each of their boundaries to what comes next."""
    short: dict[Block, tuple[int, int, str]] = {}
    long: dict[Block, int] = {}
    for tag, way in ways.items():
        block = tag_in[tag]
        if way.next_mm > LONGEST_DISTANCE_MM:
            text = f"from tag '{tag}' it is {way.next_mm:,} mm to the next: a tag holds at most {LONGEST_DISTANCE_MM:,}"
            findings.violation(HOLDS, blocks.bounds[block], text)
        for long_mm, least_mm, between in (
            (way.detector_mm, SHORTEST_BLOCK_MM, "from boundary to boundary"),
            (way.stop_mm, TAG_MM, "from its boundary to the end of track"),
        ):
            if long_mm is not None and long_mm < least_mm:
                short[block] = min(short.get(block, (long_mm, least_mm, between)), (long_mm, least_mm, between))
        if way.next_mm > LONGEST_BLOCK_MM:
            long[block] = max(long.get(block, 0), way.next_mm)
    for block, long_mm in long.items():
        text = f"block '{block}' is {long_mm / 1_000_000:,.0f} km long: is the unit right, a boundary missing?"
        findings.remark(blocks.bounds[block], text)
    _say_what_ends_no_track(blocks, findings)
    _say_what_has_tags_in_points(blocks, findings)
    for block, (long_mm, least_mm, between) in short.items():
        text = f"block '{block}' is {long_mm:,} mm {between}: its tags need {least_mm:,}"
        findings.violation(ROOM, blocks.bounds[block], text)
    station = blocks.segments.station
    longest_mm = max(station.tracks.values(), default=0)
    if ways and longest_mm < SHORTEST_VEHICLE_MM:
        text = f"no track is longer than {longest_mm:,} mm, less than one vehicle: were kilometres given for metres?"
        findings.violation("a track is as long as a vehicle", list(station.tracks), text)


def _say_what_has_tags_in_points(blocks: Blocks, findings: Findings) -> None:
    """Boundaries so near before a point or crossing that the tag on that side comes to lie at it, or behind it."""
    for mark in blocks.segments.station.marks.values():
        for side in sorted(blocks.segments.beside[mark.name]) if mark.cuts else ():
            near = _nearest_point(blocks, blocks.segments.beside[mark.name][side])
            if near is not None and near[0] < TAG_MM:
                text = (
                    f"boundary '{mark.name}' lies {near[0]:,} mm from '{near[1]}', and its tag at least {TAG_MM:,} mm "
                    "behind it, past the tips or where tracks meet: move the boundary away"
                )
                findings.violation(BLADES, (mark.name, near[1]), text)


def _nearest_point(blocks: Blocks, start: Heading) -> tuple[int, str] | None:
    """The first point or crossing that one comes to, and how far it is; none where something else ends the track."""
    segments, long_mm, met = blocks.segments, 0, set[Heading]()
    heading = start
    while heading not in met:
        met.add(heading)
        long_mm += segments.segments[heading[0]].long_mm
        end = segments.at[heading]
        if not isinstance(end, Joint):
            return None
        if len(segments.station.junctions[end.junction].ports) > 2:
            return long_mm, end.junction
        onward = segments.onward(end)
        heading = onward[0][2] if onward else heading
    return None


def _say_what_ends_no_track(blocks: Blocks, findings: Findings) -> None:
    """What ends track, such as a buffer stop, with track behind it: where it is joined there, one of them is wrong."""
    station = blocks.segments.station
    for mark in station.marks.values():
        if mark.cuts or len(blocks.segments.beside[mark.name]) < 2:
            continue
        told = f"'{mark.name}' ends track '{mark.track}' at {mark.at_mm:,} mm"
        if 0 < mark.at_mm < station.tracks[mark.track]:
            findings.remark((mark.name, mark.track), f"{told}, where the file has track go on")
            continue
        junction = station.joined[mark.track, HIGH if mark.at_mm else LOW].junction
        text = f"{told}, where '{junction}' joins it to other track: move '{mark.name}', or take the joint away"
        findings.violation(ENDS, (mark.name, mark.track, junction), text)


def say_what_is_too_short(paths: Iterable[Path], findings: Findings) -> None:
    """Overlaps that a train under the brake's own bounds may run through."""
    for path in paths:
        if path.overlap and path.overlap_mm < SHORTEST_OVERLAP_MM:
            wanted = path.wanted
            text = (
                f"the overlap of route '{wanted.name}', from '{wanted.exit}' to '{wanted.overlap}', is "
                f"{path.overlap_mm:,} mm long: a train whose brake is late slips {SHORTEST_OVERLAP_MM:,}"
            )
            findings.violation(OVERLAP, (wanted.name, wanted.exit, str(wanted.overlap)), text)


def say_what_hangs_on_nothing(blocks: Blocks, paths: Iterable[Path], findings: Findings) -> None:
    """Track that is joined to nothing a route runs over."""
    station = blocks.segments.station
    joined: networkx.Graph[str] = networkx.Graph()
    joined.add_nodes_from(station.tracks)
    for junction in station.junctions.values():
        first, *others = (track for track, _ in junction.ports.values())
        joined.add_edges_from((first, other) for other in others)
    components = list(networkx.connected_components(joined))
    if len(components) < 2:
        return
    run = {blocks.segments.segments[path.entered[0]].track for path in paths}
    for tracks in components:
        if not tracks & run:
            names = sorted(tracks)
            shown = ", ".join(f"'{name}'" for name in names[:5]) + (" …" if len(names) > 5 else "")
            findings.remark(names, f"no route runs over {shown}, joined to no other track: is a joint missing?")


def say_what_looks_alike(blocks: Blocks, told: Told, findings: Findings) -> None:
    """Names of one kind that are taken for one another."""
    station = blocks.segments.station
    given = (block for block in blocks.pieces if not block.startswith("B:"))
    for what, names in (
        ("tracks", station.tracks),
        ("points", [name for name, junction in station.junctions.items() if len(junction.ports) > 2]),
        ("boundaries", station.marks),
        ("blocks", given),
        ("routes", [wanted.name for wanted in told.routes]),
        ("trains", told.trains),
    ):
        say_what_is_alike(what, names, findings)
