"""From a railML document to a layout."""

from __future__ import annotations

from models.layouts.assemble import assemble
from models.layouts.blocks import find_blocks
from models.layouts.findings import Findings
from models.layouts.following import Follower
from models.layouts.railml.declared import compare_declared
from models.layouts.railml.document import Document, document
from models.layouts.railml.marks import Marks, read_marks
from models.layouts.railml.overlaps import limits_of, with_overlaps
from models.layouts.railml.routes import Ends, follow, route_ends
from models.layouts.railml.sections import compare_sections, note_parts, with_groups
from models.layouts.railml.switches import compare_branches, read_clearance
from models.layouts.railml.topology import Topology, read_topology
from models.layouts.railml.unread import say_what_is_not_read
from models.layouts.railml.version_2 import read_tracks
from models.layouts.results import Imported
from models.layouts.told import Told
from models.layouts.track import Station, cut_into_segments


def import_railml(file: str, text: str, trains: tuple[str, ...]) -> Imported:
    """The layout in a railML document.

    :raises BadInput: it is no layout, refers to what is not there, or a route has no one way over the track.
    """
    source, findings = document(file, text), Findings("switch")
    topology, marks, routes = _read(source, findings)
    say_what_is_not_read(source, findings)
    note_parts(source, marks, findings)
    segments = cut_into_segments(Station(topology.lengths_mm, topology.junctions, marks.marks))
    followed = with_groups(source, marks, follow(source, segments, marks, routes, findings))
    followed = with_overlaps(source, segments, marks, followed, findings)
    compare_sections(source, segments, marks, followed, findings)
    blocks = find_blocks(segments, {})
    follower = Follower(blocks, file, findings)
    paths = [path for each in followed if (path := follower.follow(each.wanted)) is not None]
    compare_branches(source, topology, findings)
    clearance = read_clearance(source, topology, marks, blocks, findings)
    wanted = tuple(each.wanted for each in followed)
    told = Told(file, "railML", trains, wanted, clearance.fouls, clear_mm=clearance.clear_mm)
    return compare_declared(source, assemble(blocks, paths, told, findings))


def _read(source: Document, findings: Findings) -> tuple[Topology, Marks, dict[str, Ends]]:
    """Track, marks and routes of a document; version 2 has no routes."""
    if source.is_version_2:
        return *read_tracks(source, findings), {}
    topology = read_topology(source, findings)
    routes = route_ends(source)
    used = [end for ends in routes.values() for end in ends[1:]] or source.all("signalIS")
    limits = [each for overlap in source.all("overlap") for each in limits_of(source, overlap)]
    signals = {source.attribute(each, "id"): each for each in (*used, *limits)}
    return topology, read_marks(source, topology, signals, findings), routes
