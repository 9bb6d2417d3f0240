"""railML 3 files with a danger each in what their routes, overlaps and sections say (:mod:`dangerous`)."""

from __future__ import annotations

import re

from tests.independent.layouts.danger import danger_of
from tests.independent.layouts.dangerous_railml import (
    BACK,
    BOTH,
    LINES_END,
    ON_LEGS,
    ON_RING,
    OVER_P,
    OVERLAP,
    ROUND,
    SPOTS,
    SWITCHES,
    TURNOUT,
    TURNS,
    railml,
    relation,
    spot,
)

PARTS = SPOTS + spot("G", "w", "0.9") + spot("F", "e", "0.6") + spot("H", "e", "0.8")
BEHIND_P = ON_LEGS + spot("S", "s", "0.2") + spot("T", "s", "0.8")
ACTIVE = '<activeForApproachRoute ref="AB"/>'
LIMITED = '<isLimitedBy ref="{}"/>'
RELATED = '<relatedToTrackAsset ref="{}"/>'
NAMES = "and a route's are those that it runs through: route 'AB' names"
P_LEFT = TURNS.format("requiresSwitchInPosition", "left")
DEPARTS = TURNS.format("switchPositionInDepartureTrack", "{}")
REVERSE = '<trainDetectionElement id="Z">' + BACK.format("e", "0.2", "reverse") + "</trainDetectionElement>"
UNUSED = '<signalIS id="Z">' + BACK.format("e", "0.2", "reverse") + "</signalIS>"
PARALLEL = (
    TURNOUT
    + relation("en", "e", "n")
    + relation("sn", "s", "n")
    + relation("se", "e", "s", "None").replace('positionOnB="0"', 'positionOnB="1"')
)
BESIDE = spot("A", "w", "0.8") + spot("B", "n", "0.4") + spot("C", "n", "0.6") + spot("D", "n", "0.8")
MEET = SWITCHES + '<switchIS id="Q"><leftBranch netRelationRef="en"/><rightBranch netRelationRef="sn"/></switchIS>'
RIM = '<border id="rim">' + BACK.format("s", "1.0", "both") + BACK.format("e", "1.0", "both") + "</border>"


def sections(*named: str) -> str:
    """Sections that go by the signals at whose detectors they end."""
    made = (
        f'<tvdSection id="{name} track">'
        + "".join(f'<hasDemarcatingTraindetector ref="{end} tags"/>' for end in name)
        + "</tvdSection>"
        for name in named
    )
    return "".join(made)


def over(*named: str) -> str:
    """The sections that something runs over."""
    return "".join(f'<hasTvdSection ref="{name} track"/>' for name in named)


def of_ab(text: str, inside: str) -> str:
    """The file with more said of the route from A to B."""
    return text.replace('<routeEntry id="Ae">', f'{inside}<routeEntry id="Ae">')


def of_cd(text: str, inside: str) -> str:
    """The file with more said of the route from C to D."""
    return text.replace('<routeEntry id="Ce">', f'{inside}<routeEntry id="Ce">')


def overlap(inside: str, length: str = "") -> str:
    """An overlap of the route from A to B."""
    told = OVERLAP.format(length, ACTIVE + inside)
    return told if length else told.replace(' length=""', "")


def without_routes(text: str) -> str:
    """The file, its routes taken away."""
    return re.sub("<route .*?</route>", "", text)


DANGEROUS_INTERLOCKING = {
    "section of two lines.railml": danger_of(
        railml(BOTH, SPOTS, "", sections("AD")),
        "a section is told to lie between detectors of two lines: what it finds free is no track",
        "no piece of track lies between",
        *("AD track", "A tags", "D tags"),
    ),
    "section of the other line.railml": danger_of(
        of_ab(railml(BOTH, PARTS, "", sections("AG", "GB", "CD")), over("AG", "GB", "CD")),
        "a route is told to run through a section of the other line as well",
        NAMES,
        *("AB", "CD track"),
    ),
    "section left out.railml": danger_of(
        of_ab(railml(BOTH, PARTS, "", sections("AG", "GB")), over("AG")),
        "a route runs through a section that it is not told to: a train there would not bar it",
        NAMES,
        *("AB", "GB track"),
    ),
    "section left out before an overlap.railml": danger_of(
        of_ab(
            railml(BOTH, PARTS, "", sections("AG", "GB", "BF") + overlap(LIMITED.format("F"))),
            over("AG", "BF"),
        ),
        "the same of a route whose overlap's section is told",
        NAMES,
        *("AB", "GB track", "BF track"),
    ),
    "overlap over a section of no track.railml": danger_of(
        railml(BOTH, PARTS, "", sections("BF", "AD") + overlap(over("BF", "AD"))),
        "an overlap is told to hold a section that no piece of track is",
        "no piece of track lies between",
        *("AD track", "A tags", "D tags"),
    ),
    "overlap over a section elsewhere.railml": danger_of(
        railml(BOTH, PARTS, "", sections("BF", "CD") + overlap(over("BF", "CD"))),
        "an overlap is told to hold a section of the other line",
        "no ways lead from 'B tags'",
    ),
    "overlap of the other direction.railml": danger_of(
        railml(BOTH, PARTS, REVERSE, OVERLAP.format("30", RELATED.format("Z"))),
        "an overlap is told for a detector that speaks to trains the other way, and claimed by none",
        "an overlap belongs to a route",
        *("o", "Z"),
    ),
    "overlap of a signal that is not used.railml": danger_of(
        railml(BOTH, PARTS, UNUSED, OVERLAP.format("30", RELATED.format("Z"))),
        "an overlap is told for a signal at which no route ends, and claimed by none",
        "an overlap belongs to a route",
        *("o", "Z"),
    ),
    "overlap round a ring.railml": danger_of(
        railml(ROUND, ON_RING + spot("D", "s", "0.2"), "", overlap("", "5000")),
        "an overlap is told to be longer than the ring that it lies on",
        "there is as much track as an overlap is long",
        *("AB", "o"),
    ),
    "overlap to another border.railml": danger_of(
        railml(BOTH, SPOTS, LINES_END.format("0.0") + RIM, overlap(LIMITED.format("edge"))),
        "an overlap is limited by the border that its train has left behind",
        "no ways lead from 'B tags'",
    ),
    "limit that is nothing.railml": danger_of(
        railml(BOTH, SPOTS, "", '<signalIL id="il"/>' + overlap(LIMITED.format("il"))),
        "what limits an overlap stands for nothing on the track",
        "refers to no signal, detector, buffer stop or border",
    ),
    "limit that is itself.railml": danger_of(
        railml(BOTH, SPOTS, "", '<signalIL id="il"><refersTo ref="il"/></signalIL>' + overlap(LIMITED.format("il"))),
        "what limits an overlap refers to itself, and to nothing on the track",
        "refers to no signal, detector, buffer stop or border",
    ),
    "departs against its way.railml": danger_of(
        of_ab(railml(TURNOUT, OVER_P, SWITCHES), DEPARTS.format("right")),
        "a route wants a point of its way otherwise in its departure track",
        "in its departure track, and otherwise as well",
        *("AB", "P"),
    ),
    "departs against its flank.railml": danger_of(
        of_cd(
            railml(TURNOUT, ON_LEGS, SWITCHES),
            DEPARTS.format("left") + TURNS.format("switchInPosition", "right"),
        ),
        "a route wants a point behind its entry left for its own train and right for its flank",
        "in its departure track, and otherwise as well",
        *("CD", "P"),
    ),
    "no such position.railml": danger_of(
        of_ab(railml(TURNOUT, OVER_P, SWITCHES), TURNS.format("switchInPosition", "middle")),
        "a route wants a point in a position that it has not",
        "is no point that can lie 'middle'",
    ),
    "no such point.railml": danger_of(
        of_ab(railml(BOTH, SPOTS), TURNS.format("switchInPosition", "left").replace('"P"', '"A"')),
        "a route wants what is no point in a position",
        "is no point that can lie 'left'",
    ),
}
"""Every file with what must be said of it."""

INTERLOCKING_THAT_HOLDS = {
    "sections.railml": of_ab(railml(BOTH, PARTS, "", sections("AG", "GB", "BF", "CD")), over("AG", "GB")),
    "sections that no route names.railml": railml(BOTH, PARTS, "", sections("CD")),
    "sections of the overlap.railml": of_ab(
        railml(BOTH, PARTS, "", sections("AG", "GB", "BF") + overlap(LIMITED.format("F"))), over("AG", "GB", "BF")
    ),
    "sections without routes.railml": without_routes(railml(BOTH, PARTS, "", sections("AG", "GB", "CD"))),
    "overlap over sections.railml": railml(BOTH, PARTS, "", sections("BF", "FH") + overlap(over("BF", "FH"))),
    "overlap over the farther section.railml": railml(BOTH, PARTS, "", sections("BF", "FH") + overlap(over("FH"))),
    "overlap over sections of a leg.railml": railml(
        TURNOUT, BEHIND_P, SWITCHES, sections("BCS", "CD") + overlap(over("BCS", "CD"))
    ),
    "overlap to one of two limits.railml": railml(
        TURNOUT, BEHIND_P, SWITCHES, overlap(LIMITED.format("C") + LIMITED.format("S") + P_LEFT)
    ),
    "overlap over a point.railml": railml(TURNOUT, BEHIND_P, SWITCHES, overlap(P_LEFT, "250")),
    "overlap a metre short.railml": railml(BOTH, PARTS, "", overlap(LIMITED.format("F"), "201")),
    "overlap a metre short of sections.railml": railml(BOTH, PARTS, "", sections("BF") + overlap(over("BF"), "201")),
    "signal within a section.railml": railml(
        BOTH, re.sub('<trainDetectionElement id="B tags">.*?</trainDetectionElement>', "", PARTS), "", sections("GF")
    ),
    "one of two ways.railml": of_ab(railml(PARALLEL, BESIDE, MEET), TURNS.format("facingSwitchInPosition", "left")),
    "departs as it lies.railml": of_cd(railml(TURNOUT, ON_LEGS, SWITCHES), DEPARTS.format("left")),
    "from a border of two tracks.railml": railml(BOTH, SPOTS, LINES_END.format("0.0")).replace(
        '<routeEntry id="Ae"><refersTo ref="A"/>', '<routeEntry id="Ae"><refersTo ref="edge"/>'
    ),
}
"""Files that look much like these and hold."""
