"""RailJSON data of tests, written as railML 3: detectors with a signal each way in the same place."""

from __future__ import annotations

from itertools import combinations
from typing import Any

from lxml import etree

Data = dict[str, Any]
PORTS = {"A": "tip", "B1": "left", "B2": "right"}
POSITIONS = {"A_B1": "left", "A_B2": "right"}
ENDS = {"BEGIN": "0", "END": "1"}
WAYS = {"START_TO_STOP": "normal", "STOP_TO_START": "reverse"}
NAMESPACE = "https://www.railml.org/schemas/3.1"


def railml_of(data: Data, version: str = "3.1", routes: bool = True, given: bool = True) -> str:
    """The same network; with ``routes`` or none, and with the positions of all their points ``given`` or none."""
    spaces: Any = {None: NAMESPACE}
    root = etree.Element("railML", nsmap=spaces, version=version)
    infrastructure, interlocking = etree.SubElement(root, "infrastructure"), etree.SubElement(root, "interlocking")
    topology = etree.SubElement(infrastructure, "topology")
    _elements(etree.SubElement(topology, "netElements"), data)
    functional = etree.SubElement(infrastructure, "functionalInfrastructure")
    _switches(etree.SubElement(topology, "netRelations"), etree.SubElement(functional, "switchesIS"), data)
    _spots(functional, data)
    assets = etree.SubElement(interlocking, "assetsForIL")
    if routes:
        _routes(assets, data, given)
    return etree.tostring(root, encoding="unicode", pretty_print=True)


def _elements(into: Any, data: Data) -> None:
    for track in data["track_sections"]:
        etree.SubElement(into, "netElement", id=track["id"], length=str(track["length"]))


def _switches(relations: Any, switches: Any, data: Data) -> None:
    for switch in data["switches"]:
        ports = switch["ports"]
        is_point = switch["switch_type"] == "point_switch"
        made = etree.SubElement(switches, "switchIS", id=switch["id"], type="ordinarySwitch") if is_point else None
        for one, other in combinations(sorted(ports), 2):
            name = f"{switch['id']}_{one}_{other}"
            runs = "A" in (one, other)
            relation = etree.SubElement(
                relations,
                "netRelation",
                id=name,
                positionOnA=ENDS[ports[one]["endpoint"]],
                positionOnB=ENDS[ports[other]["endpoint"]],
                navigability="Both" if runs else "None",
            )
            etree.SubElement(relation, "elementA", ref=ports[one]["track"])
            etree.SubElement(relation, "elementB", ref=ports[other]["track"])
            if made is not None and runs:
                etree.SubElement(made, f"{PORTS[other]}Branch", netRelationRef=name)


def _spots(functional: Any, data: Data) -> None:
    lengths = {track["id"]: track["length"] for track in data["track_sections"]}

    def spot(kind: str, name: str, item: Data, direction: str) -> None:
        element = etree.SubElement(functional, kind, id=name)
        at = item["position"] / lengths[item["track"]]
        where = {"netElementRef": item["track"], "intrinsicCoord": f"{at:.9f}", "applicationDirection": direction}
        etree.SubElement(element, "spotLocation", id=f"{name}_spot", **where)

    for item in data["detectors"]:
        spot("trainDetectionElement", item["id"], item, "both")
        for way in WAYS.values():
            spot("signalIS", f"{item['id']}-{way}", item, way)
    for item in data["buffer_stops"]:
        spot("bufferStop", item["id"], item, "both")


def _routes(assets: Any, data: Data, given: bool) -> None:
    for route in data["routes"]:
        element = etree.SubElement(assets, "route", id=route["id"])
        for switch, position in route["switches_directions"].items() if given else ():
            item = etree.SubElement(element, "facingSwitchInPosition", inPosition=POSITIONS[position])
            etree.SubElement(item, "refersToSwitch", ref=switch)
        for kind, field in (("routeEntry", "entry_point"), ("routeExit", "exit_point")):
            end = etree.SubElement(element, kind)
            name, cuts = route[field]["id"], route[field]["type"] == "Detector"
            way = WAYS[route["entry_point_direction"]]
            etree.SubElement(end, "refersTo", ref=f"{name}-{way}" if cuts else name)
