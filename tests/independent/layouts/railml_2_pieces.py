"""railML 2 with one piece otherwise each, and documents of both versions that are none."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from models.layouts import Imported
from tests.independent.layouts.railml_pieces import PLAIN, _with
from tests.layouts.railml_2_made import railml_2_of
from tests.layouts.stations import plain_station, railjson_of

TRACKS = railml_2_of(railjson_of(plain_station()))
BRANCH, OTHER = 'course="right" orientation="outgoing"', 'course="right" orientation="incoming"'
SWITCH = f'<switch id="P" pos="1000">\n              <connection id="P-s" ref="P-b" {BRANCH}/>\n            </switch>'
SIGNAL, DETECTOR = 'id="b-up" pos="900.000" dir="up" type="main"', '<trainDetector id="b" pos="900.000"/>'
BEGIN = '<trackBegin id="T0-b" pos="0">\n            <bufferStop id="west"/>'
BETWEEN = """</trackBegin>
          <trackEnd id="T2-e\""""
LAST = """<bufferStop id="east"/>
          </trackEnd>"""
CROSSED = """<crossing id="X" pos="100" type="{kind}">
<connection id="x1" ref="{one}" orientation="incoming"/><connection id="x2" ref="{other}" orientation="outgoing"/>
</crossing>"""
HALF = """<crossing id="Y" pos="70"><connection id="y1" ref="x1" orientation="incoming"/>
<connection id="y2" ref="x2" orientation="outgoing"/></crossing>"""
STANDS_AT_H = (
    '<trainDetector id="h" pos="500.000"/>',
    *(f'<signal id="h-{way}" pos="500.000" dir="{way}" type="main"/>' for way in ("up", "down")),
)
TWO = """<crossing id="Y" pos="70"><connection id="y1" ref="x1" orientation="incoming"/>
<connection id="y2" ref="w1" orientation="outgoing"/></crossing>"""
THIRD = """<crossing id="Z" pos="90"><connection id="z1" ref="x2" orientation="incoming"/>
<connection id="z2" ref="e1" orientation="outgoing"/></crossing>"""
NORTH = """<track id="T3"><trackTopology><trackBegin id="T3-b" pos="0"><connection id="z-B" ref="z-A"/></trackBegin>
<trackEnd id="T3-e" pos="500"><bufferStop id="north"/></trackEnd></trackTopology></track></tracks>"""
LINE = ("</tracks>", NORTH)
"""A third track at an end where two meet, and no switch."""

OTHERWISE: dict[str, list[tuple[str, str]]] = {
    "from 500": [('T0-b" pos="0"', 'T0-b" pos="300"')],
    "from below 0": [('T0-b" pos="0"', 'T0-b" pos="-300"')],
    "branch left": [(BRANCH, 'course="left" orientation="outgoing"')],
    "branch straight": [(BRANCH, 'course="straight" orientation="outgoing"')],
    "branch anywhere": [(BRANCH, 'orientation="outgoing"')],
    "branch left of straight": [
        (BRANCH, 'course="left" orientation="outgoing"'),
        ('<switch id="P"', '<switch id="P" trackContinueCourse="straight"'),
    ],
    "branch up both": [
        (OTHER, 'course="up" orientation="incoming"'),
        ('<switch id="Q"', '<switch id="Q" trackContinueCourse="up"'),
    ],
    "branch up": [(OTHER, 'course="up" orientation="incoming"')],
    "switches turned": [(BRANCH, "_"), (OTHER, BRANCH), ("_", OTHER)],
    "signal of shunting": [(SIGNAL, SIGNAL.replace("main", "shunting"))],
    "signal without type": [(SIGNAL, SIGNAL.replace('type="main"', ""))],
    "signal combined": [(SIGNAL, SIGNAL.replace("main", "combined"))],
    "signal without direction": [(SIGNAL, SIGNAL.replace('dir="up"', ""))],
    "signal both ways": [(SIGNAL, SIGNAL.replace('dir="up"', 'dir="both"'))],
    "border": [(DETECTOR, '<trackCircuitBorder id="b" pos="890.000"/>')],
    "borders first": [(DETECTOR, '<trackCircuitBorder id="b0" pos="400.000"/>' + DETECTOR)],
    "at a point": [('id="c" pos="1100.000"', 'id="c" pos="1000.000"')],
    "no detector": [(DETECTOR, "")],
    "a track of nothing": [("<tracks>", '<tracks><track id="bare"/>')],
    "open end": [("<bufferStop ", "<openEnd ")],
    "unnamed end": [('<bufferStop id="west"/>', "<bufferStop/>")],
    "two ends": [('<bufferStop id="west"/>', '<bufferStop/><bufferStop id="west"/>')],
    "foreign": [("<connections>", '<connections xmlns:o="urn:o"><o:switch id="og" pos="500"/><o:x id="ox"/>')],
    "foreign end": [('<bufferStop id="west"/>', '<o:bufferStop xmlns:o="urn:o" id="og"/>')],
    "another element": [("<connections>", '<connections><note id="note" pos="500"/>')],
    "order": [(SWITCH, ""), ("</switch>", f"</switch>{SWITCH}")],
    "in use": [('<track id="T0">', '<track id="T0"><state disabled="false"/><elementState value="operational"/>')],
    "unread": [("<ocsElements>", '<ocsElements><derailer id="der" pos="500"/><speedChange id="sc" pos="600"/>')],
    "signals of one way": [(f' dir="{way}" type="main"', ' dir="down" type="main"') for way in ("up",) * 8],
    "at an unnamed begin": [('<bufferStop id="west"/>', "<bufferStop/>")] + [('pos="400.000"', 'pos="0.000"')] * 3,
    "at an unnamed end": [('<bufferStop id="east"/>', "<bufferStop/>")] + [('pos="500.000"', 'pos="1000.0"')] * 3,
    "at a begin": [('id="a" pos="400.000"', 'id="a" pos="0.000"')],
    "at an end": [('id="h" pos="500.000"', 'id="h" pos="1000.000"')],
}
"""Files that are as good as before, or better known to be wrong by the tracks that they draw."""

NONE: dict[str, list[tuple[str, str]]] = {
    "length": [('pos="3000"', 'pos="0"')],
    "backward": [('pos="3000"', 'pos="-1"')],
    "far": [('pos="3000"', 'pos="far"')],
    "not a number": [('pos="3000"', 'pos="nan"')],
    "endless": [('pos="3000"', 'pos="inf"')],
    "too long": [('pos="3000"', 'pos="1000001"')],
    "no place": [('id="P" pos="1000"', 'id="P"')],
    "switch beyond": [('id="P" pos="1000"', 'id="P" pos="9000"')],
    "switch before": [('id="P" pos="1000"', 'id="P" pos="-5"')],
    "switch at begin": [('id="P" pos="1000"', 'id="P" pos="0"')],
    "switch at end": [('id="Q" pos="2000"', 'id="Q" pos="3000"')],
    "two at one": [('id="P" pos="1000"', 'id="P" pos="2000"')],
    "orientation": [(BRANCH, 'course="right" orientation="up"')],
    "both to the right": [('<switch id="P"', '<switch id="P" trackContinueCourse="right"')],
    "no orientation": [(BRANCH, 'course="right"')],
    "nowhere": [('ref="P-s"/>', 'ref="none"/>')],
    "joint nowhere": [('ref="y-B"', 'ref="nobody"')],
    "not back": [('ref="P-s"/>', 'ref="Q-s"/>')],
    "joint not back": [('ref="y-B"', 'ref="P-b"')],
    "end joined twice": [('id="y-A" ref="y-B"/>', 'id="y-A" ref="y-B"/><connection id="z-A" ref="z-B"/>'), LINE],
    "itself": [('id="y-A" ref="y-B"', 'id="y-A" ref="y-A"')],
    "itself alone": [('id="y-A" ref="y-B"', 'id="y-A" ref="y-A"'), ('<connection id="y-B" ref="y-A"/>', "")],
    "no track between": [('ref="P-b"', 'ref="Q-s"'), ('ref="Q-b"', 'ref="P-s"')],
    "two branches": [(SWITCH, SWITCH.replace("</switch>", '<connection id="P-t" ref="P-b"/></switch>'))],
    "no branch": [(f'<connection id="P-s" ref="P-b" {BRANCH}/>', "")],
    "off track": [('id="a" pos="400.000"', 'id="a" pos="4000"')],
    "before track": [('id="a" pos="400.000"', 'id="a" pos="-4"')],
    "signal off track": [(SIGNAL, SIGNAL.replace("900.000", "3001"))],
    "no begin": [('<trackBegin id="T2', '<x id="T2'), (BETWEEN, BETWEEN.replace("/trackBegin", "/x"))],
    "no end": [('<trackEnd id="T2', '<x id="T2'), (LAST, LAST.replace("/trackEnd", "/x"))],
    "no way long": [('id="T2-e" pos="1000"', 'id="T2-e" pos="0"'), *((each, "") for each in STANDS_AT_H)],
    "id twice": [('id="P"', 'id="Q"')],
    "id of another kind twice": [('id="a"', 'id="west"')],
    "no id": [(' id="T0"', "")],
    "empty id": [('id="a"', 'id=""')],
    "no id of a detector": [('<trainDetector id="b"', "<trainDetector")],
    "version": [('version="2.4"', 'version="2.6"')],
    "no version": [('version="2.4"', "")],
    "no railML": [("<railml", "<railway"), ("</railml", "</railway")],
    "nothing": [("<track ", "<line "), ("</track>", "</line>")] * 3,
    "no topology": [("trackTopology>", "topology>")] * 6,
    "no signals": [('type="main"', 'type="distant"')] * 16,
    "entity": [("<railml", '<!DOCTYPE r [<!ENTITY x "y">]><railml'), ("<tracks>", "<tracks>&x;")],
    "cut off": [("</infrastructure>", "")],
}
"""Files that are no layout."""

CROSSINGS = {
    "on one": ("simpleCrossing", "w1", "e1", ""),
    "slip on one": ("doubleSwitchCrossing", "w1", "e1", ""),
    "on both": ("simpleCrossing", "y1", "y2", HALF),
    "slip on both": ("doubleSwitchCrossing", "y1", "y2", HALF),
    "single slip": ("simpleSwitchCrossing", "w1", "e1", ""),
    "half": ("simpleCrossing", "y1", "e1", HALF),
    "one way": ("simpleCrossing", "w1", "e1", "incoming"),
    "two others": ("simpleCrossing", "y1", "z1", TWO),
    "itself": ("simpleCrossing", "x2", "x1", ""),
    "one end": ("simpleCrossing", "w1", "w2", ""),
}

NONE_3: dict[str, list[tuple[str, str]]] = {
    "share beyond": [('intrinsicCoord="0.400000000"', 'intrinsicCoord="1.4"')],
    "share below": [('intrinsicCoord="0.400000000"', 'intrinsicCoord="-0.4"')],
    "share of words": [('intrinsicCoord="0.400000000"', 'intrinsicCoord="half"')],
    "length below": [('id="w" length="1000.0"', 'id="w" length="-1"')],
    "no length": [('id="w" length="1000.0"', 'id="w"')],
    "element nowhere": [('<elementA ref="w"/>', '<elementA ref="nobody"/>')],
    "branch nowhere": [('netRelationRef="P_A_B1"', 'netRelationRef="nobody"')],
    "no branch": [(' netRelationRef="P_A_B1"', "")],
    "place nowhere": [('netElementRef="w" intrinsicCoord="0.400000000"', 'netElementRef="v" intrinsicCoord="0.4"')],
    "route nowhere": [('<refersTo ref="a-normal"/>', '<refersTo ref="nobody"/>')],
    "id twice": [('netElement id="w"', 'netElement id="z"')],
    "version": [('version="3.1"', 'version="4.0"')],
}


def files() -> Iterator[tuple[str, str]]:
    """The name and the text of every file."""
    yield "railML 2.railml", TRACKS
    for name, changes in OTHERWISE.items():
        yield f"railML 2 {name}.railml", changed(TRACKS, changes)
    for name, (kind, one, other, more) in CROSSINGS.items():
        yield f"railML 2 crossing {name}.railml", crossing(kind, one, other, more)
    for name, changes in NONE.items():
        yield f"no railML 2 {name}.railml", changed(TRACKS, changes)
    for name, changes in NONE_3.items():
        yield f"no railML 3 {name}.railml", changed(PLAIN, changes)
    twice = '<netElement xmlns="urn:old" id="w"/>'
    yield "railML 3 foreign id twice.railml", _with(twice, "")


def differing(imported: Imported, data: dict[str, Any]) -> list[str]:
    """Tracks, joints, points and crossings that the importer names or measures otherwise than a plain reader."""
    lengths = {track["id"]: round(track["length"] * 1_000) for track in data["track_sections"]}
    names = sorted(switch["id"] for switch in data["switches"])
    station = imported.station
    if station is None or dict(station.tracks) != lengths or sorted(station.junctions) != names:
        return [f"tracks and junctions: not {lengths}, {names}"]
    return []


def changed(text: str, changes: list[tuple[str, str]]) -> str:
    """A text with each change made once, in order."""
    for old, new in changes:
        assert old in text, old
        text = text.replace(old, new, 1)
    return text


def crossing(kind: str, one: str, other: str, more: str) -> str:
    """Two tracks that cross: told on one of them, the other in two; or told on both."""
    told = CROSSED.format(kind=kind, one=one, other=other)
    if more == "incoming":
        told, more = told.replace("outgoing", "incoming"), ""
    far = ("y2", "z2") if other == "z1" else ("x1", "x2")
    tracks = [_track("main", "<openEnd id='ma'/>", "<openEnd id='mb'/>", told)]
    if more:
        tracks.append(_track("side", "<openEnd id='sa'/>", "<openEnd id='sb'/>", more))
    if other == "z1":
        tracks.append(_track("third", "<openEnd id='ta'/>", "<openEnd id='tb'/>", THIRD))
    if other == "w2":
        both = "<connection id='w1' ref='x1'/><connection id='w2' ref='x2'/>"
        tracks.append(_track("west", "<openEnd id='wa'/>", both, ""))
    elif other in ("e1", "z1"):
        tracks.append(_track("west", "<openEnd id='wa'/>", f"<connection id='w1' ref='{far[0]}'/>", ""))
        tracks.append(_track("east", f"<connection id='e1' ref='{far[1]}'/>", "<openEnd id='eb'/>", ""))
    return f'<railml version="2.4"><infrastructure><tracks>{"".join(tracks)}</tracks></infrastructure></railml>'


def _track(name: str, begin: str, end: str, connections: str) -> str:
    told = "".join(
        f'<signal id="{name}{number}" pos="{pos}" dir="{way}"/>'
        for number, (pos, way) in enumerate(((30, "up"), (40, "down"), (160, "up"), (170, "down")))
    )
    return f"""<track id="{name}"><trackTopology><trackBegin id="{name}-b" pos="0">{begin}</trackBegin>
      <trackEnd id="{name}-e" pos="200">{end}</trackEnd><connections>{connections}</connections></trackTopology>
      <ocsElements><signals>{told}</signals></ocsElements></track>"""
