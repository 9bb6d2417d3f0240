"""From a railML document to a layout."""

from __future__ import annotations

from models.layouts.assemble import Told, assemble
from models.layouts.blocks import find_blocks
from models.layouts.findings import Findings
from models.layouts.following import Follower
from models.layouts.railml.document import document
from models.layouts.railml.marks import read_marks
from models.layouts.railml.routes import follow, route_ends
from models.layouts.railml.sections import compare_sections, note_parts
from models.layouts.railml.topology import read_topology
from models.layouts.results import Imported
from models.layouts.track import Station, cut_into_segments


def import_railml(file: str, text: str, trains: tuple[str, ...]) -> Imported:
    """The layout in a railML document.

    :raises BadInput: it is no layout, refers to what is not there, or a route has no one way over the track.
    """
    source, findings = document(file, text), Findings("switch")
    topology = read_topology(source, findings)
    routes = route_ends(source)
    signals = {source.attribute(end, "id"): end for ends in routes.values() for end in ends[1:]} or {
        source.attribute(each, "id"): each for each in source.all("signalIS")
    }
    marks = read_marks(source, topology, signals, findings)
    note_parts(source, marks)
    segments = cut_into_segments(Station(topology.lengths_mm, topology.junctions, marks.marks))
    followed = follow(source, segments, marks, routes, findings)
    compare_sections(source, segments, marks, followed, findings)
    blocks = find_blocks(segments, {})
    follower = Follower(blocks, file, findings)
    paths = [path for each in followed if (path := follower.follow(each.wanted)) is not None]
    return assemble(blocks, paths, Told(file, "railML", trains), findings)
