"""RailJSON data of tests, written as railML 2: points on a track that runs on, detectors with signals both ways."""

from __future__ import annotations

from typing import Any

from lxml import etree

Data = dict[str, Any]
ON = {"A": "B1", "B1": "A"}
"""A track runs on over a point from its tip to its left leg; its right leg is the branch."""
PLACES = {"BEGIN": "trackBegin", "END": "trackEnd"}


def railml_2_of(data: Data, version: str = "2.4") -> str:
    """The same network.  Tracks that a point joins from tip to left leg become one, on which it stands."""
    spaces: Any = {None: "https://www.railml.org/schemas/2018"}
    root = etree.Element("railml", nsmap=spaces, version=version)
    tracks = etree.SubElement(etree.SubElement(root, "infrastructure", id="is"), "tracks")
    lengths = {track["id"]: track["length"] for track in data["track_sections"]}
    points = {switch["id"]: switch["ports"] for switch in data["switches"] if switch["switch_type"] == "point_switch"}
    joints = {switch["id"]: switch["ports"] for switch in data["switches"] if switch["switch_type"] == "link"}
    for number, chain in enumerate(_chains(list(lengths), points)):
        _track(tracks, f"T{number}", chain, lengths, points, joints, data)
    return etree.tostring(root, encoding="unicode", pretty_print=True)


def _chains(names: list[str], points: Data) -> list[list[tuple[str, bool]]]:
    """Tracks that run on into each other over points, each with whether it is run against its direction."""
    after: dict[tuple[str, str], tuple[str, str]] = {}
    for ports in points.values():
        for port, other in ON.items():
            after[ports[port]["track"], ports[port]["endpoint"]] = (ports[other]["track"], ports[other]["endpoint"])
    found: list[list[tuple[str, bool]]] = []
    left = list(names)
    while left:
        first, end = left[0], "BEGIN"
        while (first, end) in after:  # back to where the chain begins
            first, met = after[first, end]
            end = "END" if met == "BEGIN" else "BEGIN"
        chain = []
        while True:
            left.remove(first)
            chain.append((first, end == "END"))
            leaving = (first, "END" if end == "BEGIN" else "BEGIN")
            if leaving not in after:
                break
            first, end = after[leaving]
        found.append(chain)
    return found


def _track(
    into: Any, name: str, chain: list[tuple[str, bool]], lengths: Data, points: Data, joints: Data, data: Data
) -> None:
    track = etree.SubElement(into, "track", id=name)
    topology = etree.SubElement(track, "trackTopology")
    begin, end = (etree.SubElement(topology, kind) for kind in PLACES.values())
    connections = etree.SubElement(topology, "connections")
    ocs = etree.SubElement(track, "ocsElements")
    signals, detectors = etree.SubElement(ocs, "signals"), etree.SubElement(ocs, "trainDetectionElements")
    at = 0.0
    for number, (section, against) in enumerate(chain):
        _marks(signals, detectors, section, against, at, lengths[section], data)
        leaving = {"track": section, "endpoint": "BEGIN" if against else "END"}
        at += lengths[section]
        for point, ports in points.items() if number < len(chain) - 1 else ():
            if leaving in (ports["A"], ports["B1"]):
                facing = leaving == ports["A"]
                switch = etree.SubElement(connections, "switch", id=point, pos=f"{at:g}")
                orientation = "outgoing" if facing else "incoming"
                made = etree.SubElement(switch, "connection", id=f"{point}-s", ref=f"{point}-b", course="right")
                made.set("orientation", orientation)
    begin.attrib.update({"id": f"{name}-b", "pos": "0"})
    end.attrib.update({"id": f"{name}-e", "pos": f"{at:g}"})
    first, last = chain[0], chain[-1]
    _end(begin, {"track": first[0], "endpoint": "END" if first[1] else "BEGIN"}, points, joints, data)
    _end(end, {"track": last[0], "endpoint": "BEGIN" if last[1] else "END"}, points, joints, data)


def _end(into: Any, here: Data, points: Data, joints: Data, data: Data) -> None:
    """What a track ends with: a connection to a branch or to another track, or the end of all track."""
    for point, ports in points.items():
        if here == ports["B2"]:
            etree.SubElement(into, "connection", id=f"{point}-b", ref=f"{point}-s")
            return
    for joint, ports in joints.items():
        for port, other in (("A", "B"), ("B", "A")):
            if here == ports[port]:
                etree.SubElement(into, "connection", id=f"{joint}-{port}", ref=f"{joint}-{other}")
                return
    stops = {(stop["track"], "BEGIN" if stop["position"] == 0 else "END"): stop["id"] for stop in data["buffer_stops"]}
    etree.SubElement(into, "bufferStop", id=stops[here["track"], here["endpoint"]])


def _marks(signals: Any, detectors: Any, section: str, against: bool, at: float, length: float, data: Data) -> None:
    for item in data["detectors"]:
        if item["track"] == section:
            place = f"{at + (length - item['position'] if against else item['position']):.3f}"
            etree.SubElement(detectors, "trainDetector", id=item["id"], pos=place)
            for way in ("up", "down"):
                etree.SubElement(signals, "signal", id=f"{item['id']}-{way}", pos=place, dir=way, type="main")
