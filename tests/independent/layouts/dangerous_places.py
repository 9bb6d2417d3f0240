"""railML 3 files with a danger each in what their track is, and where things lie on it (:mod:`dangerous`)."""

from __future__ import annotations

import re

from tests.independent.layouts.danger import danger_of
from tests.independent.layouts.dangerous_interlocking import BESIDE, MEET, PARALLEL
from tests.independent.layouts.dangerous_railml import (
    BACK,
    BORDER,
    BOTH,
    FOULED,
    LINES_END,
    LONG_TRACK,
    ON_LEGS,
    SPOTS,
    SWITCHES,
    TURNOUT,
    TURNS,
    level,
    railml,
    relation,
    spot,
)

APART_A = '<signalIS id="A">{}</signalIS><trainDetectionElement id="A tags">{}</trainDetectionElement>'
NO_LENGTH = LONG_TRACK.format("", "500", "physical").replace('"T"', '"T1"').replace("<length", "<name")
COLLECTS = '<netElement id="whole"><elementPart ref="w"/><elementPart ref="e"/></netElement>'
ON_WHOLE = '<spotLocation netElementRef="whole" intrinsicCoord="0.6"/>'
AS_LONG_AS_BOTH = COLLECTS.replace('"whole">', '"whole" length="1000">')
ON_BOTH = spot("A", "w", "0.4") + spot("B", "e", "0.8") + spot("C", "whole", "0.2") + spot("D", "whole", "0.9")
ON_MESO = '<level descriptionLevel="Meso"><networkResource ref="w"/><networkResource ref="e"/></level><level '
NAMELESS = '<bufferStop><spotLocation netElementRef="e" intrinsicCoord="0.1"/></bufferStop>'
WHOLE = ' intrinsicCoordBegin="0" intrinsicCoordEnd="1"'
TENTH = ' intrinsicCoordBegin="0" intrinsicCoordEnd="0.1"'
OVER_BOTH = LONG_TRACK.format("", "1000", "physical").replace('"e"/>', '"e"/><associatedNetElement netElementRef="w"/>')
STOP_ON_S = '<bufferStop id="wall"><spotLocation netElementRef="s" intrinsicCoord="1.0"/></bufferStop>'
DATED = '<operationalPoint id="town"><isValid from="2020-01-01"/></operationalPoint>'
HALF = """<track id="{}"><linearLocation><associatedNetElement netElementRef="e" posBegin="{}" posEnd="{}"/>
</linearLocation></track>"""
NONE = relation("{}", "{}", "{}", "None")
AGAIN = relation("we2", "w", "e", "None")
BY_METRES = SPOTS.replace('netElementRef="e" intrinsicCoord="0.2"', 'netElementRef="e" pos="100"')
A_METRE_OFF = SPOTS.replace(
    'netElementRef="e" intrinsicCoord="0.2"', 'netElementRef="e" intrinsicCoord="0.2" pos="101"'
)
DRAWN = '<netElement id="e">{}</netElement>'
TOLD_AND_DRAWN = DRAWN.replace(">{}", ' length="500">{}')
POINT = '<geometricCoordinate x="{}" y="0"/>'
SHORT_AND_LONG = "".join(
    DRAWN.replace('"e"', f'"{name}"').format(POINT.format(0) + POINT.format(long_m))
    for name, long_m in (("x", "0.001"), ("y", "268435.455"))
)
FOUR = (
    relation("we", "w", "e")
    + relation("wn", "w", "n")
    + relation("ws", "w", "s", "None")
    + relation("es", "e", "s", "None").replace('positionOnA="1"', 'positionOnA="0"')
)
SPREAD = FOUR.replace("None", "Both")
FAN = "".join(relation(f"w{end}", "w", end) for end in "ensx")
SLIP = "".join(relation(one + other, one, other) for one in "wn" for other in "es")
WHOLE_SLIP = """<switchIS id="X" type="doubleSwitchCrossing"><straightBranch netRelationRef="we"/>
<straightBranch netRelationRef="ns"/><turningBranch netRelationRef="ws"/><turningBranch netRelationRef="ne"/>
</switchIS>"""
PARTS = "".join(
    f'<switchIS id="X{at}" type="switchCrossingPart" belongsToParent="X"><leftBranch netRelationRef="{left}"/>'
    f'<rightBranch netRelationRef="{right}"/></switchIS>'
    for at, (left, right) in enumerate((("we", "ws"), ("ne", "ns"), ("we", "ne"), ("ws", "ns")), start=1)
)
PART_LIES = TURNS.format("facingSwitchInPosition", "left").replace('"P"', '"X1"')
CLOSE_TO_X = SPOTS.replace('"w" intrinsicCoord="0.8"', '"w" intrinsicCoord="0.98"')
OF_X1 = '<switchIL id="il"><refersTo ref="X1"/><hasFoulingTrainDetectors ref="A tags"/></switchIL>'
LIMIT = '<border id="limit" type="station"{}>' + BACK.format("w", "{}", "both") + "</border>"
NO_END = ' isOpenEnd="false"'
WITHIN = LIMIT.format(NO_END, "0.9")
TWO_TRACKS = WITHIN.replace("</border>", BACK.format("n", "0.9", "both") + "</border>")
TURNED_ENDS = '<border id="edge">' + BACK.format("n", "0.1", "both") + BACK.format("w", "0.0", "both") + "</border>"
FROM_LIMIT = '<routeEntry id="Ae"><refersTo ref="limit"/>'
TO_THE_LIMIT = """<tvdSection id="AL"><hasDemarcatingTraindetector ref="A tags"/><hasDemarcatingBorder ref="limit"/>
</tvdSection>"""


def with_element(text: str, element: str) -> str:
    """The file with one more net element."""
    return text.replace("<netElements>", f"<netElements>{element}")


def with_e(text: str, element: str) -> str:
    """The file with another net element ``e``."""
    return text.replace('<netElement id="e" length="500"/>', element)


DANGEROUS_PLACES = {
    "stop of no name.railml": danger_of(
        railml(BOTH, SPOTS, NAMELESS),
        "a buffer stop without an id stands between entry and exit of a route",
        "has no attribute id",
    ),
    "signal nowhere.railml": danger_of(
        railml(BOTH, SPOTS.replace(spot("B", "e", "0.2"), '<signalIS id="B"/>')),
        "a route ends at a signal of which nothing says where it stands",
        "has no place on the track",
    ),
    "detector nowhere.railml": danger_of(
        railml(BOTH, SPOTS, '<trainDetectionElement id="G"/>'),
        "nothing says where a detector lies: the blocks beside it are one",
        "has no place on the track: it is left out",
        "G",
    ),
    "detector on the whole.railml": danger_of(
        with_element(
            railml(BOTH, SPOTS, f'<trainDetectionElement id="G">{ON_WHOLE}</trainDetectionElement>'), COLLECTS
        ),
        "a detector lies on two net elements together: where on either is not told",
        "which is not of the finest level",
    ),
    "border of a taken name.railml": danger_of(
        railml(BOTH, SPOTS, LINES_END.format("0.0") + '<trackGauge id="edge on n" value="1435"/>'),
        "a border lies at two ends of track, and what it would go by at the second is the name of something else",
        "an element lies in one place",
        "edge",
    ),
    "two joints.railml": danger_of(
        railml(BOTH, SPOTS.replace(spot("B", "e", "0.2"), spot("B", "n", "1.0", BACK.format("w", "1.0", "normal")))),
        "a signal and its detector lie at a joint of one line, and at that of another",
        "an element lies in one place",
        "B",
    ),
    "track shorter than its whole.railml": danger_of(
        railml(BOTH, SPOTS, LONG_TRACK.format(WHOLE, "50", "physical")),
        "a net element is told to be 500 m long, and the track that is all of it 50 m",
        "a net element has one length",
        *("e", "T"),
    ),
    "no length.railml": danger_of(
        with_e(railml(BOTH, SPOTS), '<netElement id="e"/>'),
        "how long a net element is stands nowhere",
        "has no length, and no track or coordinates",
    ),
    "one coordinate.railml": danger_of(
        with_e(railml(BOTH, SPOTS), DRAWN.format(POINT.format(0))),
        "of a net element's drawing one end is told, and its length nowhere",
        "has no length, and no track or coordinates",
    ),
    "stop within.railml": danger_of(
        railml(BOTH, SPOTS, STOP_ON_S.replace('"s" intrinsicCoord="1.0"', '"w" intrinsicCoord="0.9"')),
        "between entry and exit of a route stands a buffer stop",
        "no way leads from 'A' to 'B'",
    ),
    "open end within.railml": danger_of(
        railml(BOTH, SPOTS, LIMIT.format(' isOpenEnd="true"', "0.9")),
        "between entry and exit of a route the known network ends",
        "no way leads from 'A' to 'B'",
    ),
    "open end at a joint.railml": danger_of(
        railml(BOTH, SPOTS, LIMIT.format(' isOpenEnd="1"', "1.0")),
        "between entry and exit of a route the known network ends, where two tracks meet",
        "no way leads from 'A' to 'B'",
    ),
    "border within and at an end.railml": danger_of(
        railml(BOTH, SPOTS, TURNED_ENDS),
        "a border lies within one track, and at the end of another one",
        "an element lies in one place",
        "edge",
    ),
    "parts of no slip.railml": danger_of(
        railml(SLIP, SPOTS, PARTS),
        "the parts of a slip are told, and nowhere the slip that they are held with",
        "switchIS 'X1': is a part of 'X', which its relation 'we' is no branch of",
    ),
    "part of another slip.railml": danger_of(
        railml(PARALLEL, BESIDE, MEET.replace('"Q"', '"Q" belongsToParent="P"')),
        "a switch is told as a part of one that lies elsewhere: its own place would have no name",
        "is a part of 'P', which its relation 'en' is no branch of",
    ),
    "part of the other slip.railml": danger_of(
        railml(PARALLEL, BESIDE, MEET + MEET[len(SWITCHES) :].replace('"Q"', '"R" belongsToParent="P"')),
        "a part names the branches of one switch, and is told as a part of another one: its clearance would be that's",
        "is a part of 'P', which its relation 'en' is no branch of",
    ),
    "part that is to lie left.railml": danger_of(
        railml(SLIP, SPOTS, WHOLE_SLIP + PARTS).replace('<route id="AB">', f'<route id="AB">{PART_LIES}'),
        "a route names how a part of a slip lies, which is more than one position of the slip",
        "'X1' is a part of slip 'X': how parts lie",
    ),
    "border at the end of a switch.railml": danger_of(
        railml(TURNOUT, ON_LEGS, SWITCHES + BORDER.replace('"s" intrinsicCoord="0.0"', '"w" intrinsicCoord="1.0"')),
        "a border stands at the tips of a switch, with track behind it: a train there is foul of what runs over it",
        "no track goes on behind a buffer stop at a joint",
        *("edge", "w", "P"),
    ),
    "whole and part.railml": danger_of(
        with_element(railml(BOTH, ON_BOTH, networks=level(*"wens", "whole")), AS_LONG_AS_BOTH),
        "a net element and what it collects are both on the level Micro: one line is there twice, with a train on each",
        "'whole': has the track of 'e', which 'e' of the level Micro has as well",
    ),
    "part of a part.railml": danger_of(
        with_element(
            railml(BOTH, ON_BOTH, networks=level(*"wens", "whole")),
            AS_LONG_AS_BOTH.replace('"w"', '"half"') + '<netElement id="half"><elementPart ref="w"/></netElement>',
        ),
        "the same, where a net element of no level Micro lies between the two",
        "'whole': has the track of 'e', which 'e' of the level Micro has as well",
    ),
    "part of two.railml": danger_of(
        with_element(
            railml(BOTH, ON_BOTH, networks=level(*"ns", "whole", "east")).replace("<level ", ON_MESO, 1),
            AS_LONG_AS_BOTH + '<netElement id="east" length="500"><elementPart ref="e"/></netElement>',
        ),
        "two net elements of the level Micro collect one and the same: its track is there twice",
        "'east': has the track of 'e', which 'whole' of the level Micro has as well",
    ),
    "drawn alone.railml": danger_of(
        with_e(railml(BOTH, SPOTS), DRAWN.format("<geometricCoordinate/>" + POINT.format(0) + POINT.format(500))),
        "how long a net element is stands nowhere; its drawing's length is taken, which may be to no scale",
        "that of its drawing is taken",
        "e",
    ),
    "drawn at both bounds.railml": danger_of(
        with_element(railml(BOTH + relation("ex", "e", "x") + relation("sy", "s", "y"), SPOTS), SHORT_AND_LONG),
        "the same of two net elements, as short and as long as there may be",
        "that of its drawing is taken",
        *"xy",
    ),
    "drawn otherwise.railml": danger_of(
        with_e(railml(BOTH, SPOTS), TOLD_AND_DRAWN.format(POINT.format(0) + POINT.format(506))),
        "a net element is told to be 500 m long, and drawn 506 m long",
        "is 500 m long, and drawn",
        "e",
    ),
    "point of no switch.railml": danger_of(
        railml(TURNOUT, ON_LEGS),
        "no switch names a point: which way left and right are, and which device it is, is not told",
        "is at a point that no switch names",
        "es",
    ),
    "drawn as a dot.railml": danger_of(
        with_e(railml(BOTH, SPOTS), DRAWN.format(POINT.format(7) * 2)),
        "a net element is drawn without any length",
        "its length is 0.0 m",
    ),
    "leg that is closed.railml": danger_of(
        railml(relation("we", "w", "e") + NONE.format("ws", "w", "s"), SPOTS.replace('"n"', '"w"')),
        "three ends of track meet, and no train comes from one of them to another",
        "3 ends of track meet here, and 1 ways lead",
    ),
    "triangle.railml": danger_of(
        railml(TURNOUT.replace("None", "Both"), ON_LEGS),
        "three ends of track meet, and a train comes from each to each of the others",
        "3 ends of track meet here, and 3 ways lead",
    ),
    "four ends and two ways.railml": danger_of(
        railml(FOUR, ON_LEGS),
        "four ends of track meet, and one of them leads nowhere",
        "4 ends of track meet here, and 2 ways lead",
    ),
    "four ends and a circle.railml": danger_of(
        railml(SPREAD, ON_LEGS),
        "four ends of track meet as no slip does: three of them lead to each other",
        "4 ends of track meet here, and",
    ),
    "five ends.railml": danger_of(
        with_element(railml(FAN, ON_LEGS), '<netElement id="x" length="500"/>'),
        "five ends of track meet in one place, where no slip has as many",
        "5 ends of track meet here, and",
    ),
    "branch of another place.railml": danger_of(
        railml(TURNOUT + relation("nn", "n", "n"), ON_LEGS, SWITCHES.replace('"ws"', '"nn"')),
        "the right branch of a switch is at another place: what is right there is not told",
        "its branches are not the ways over this point",
    ),
    "branch of nothing.railml": danger_of(
        railml(TURNOUT, ON_LEGS, SWITCHES.replace('"ws"', '"gone"')),
        "the right branch of a switch is a relation that is not there",
        "which is not there",
    ),
}
"""Every file with what must be said of it."""

PLACES_THAT_HOLD = {
    "exit of no direction.railml": railml(
        BOTH, SPOTS.replace('intrinsicCoord="0.2" applicationDirection="normal"', 'intrinsicCoord="0.2"')
    ),
    "detector of both ways.railml": railml(
        BOTH,
        SPOTS.replace(
            '<trainDetectionElement id="B tags"><spotLocation netElementRef="e" intrinsicCoord="0.2"/>',
            '<trainDetectionElement id="B tags">'
            + BACK.format("e", "0.2", "normal")
            + BACK.format("e", "0.2", "reverse"),
        ),
    ),
    "stop that fouls.railml": railml(
        TURNOUT, ON_LEGS, SWITCHES + STOP_ON_S, FOULED.format("wall").replace('ref="X"', 'ref="P"')
    ),
    "dated station.railml": railml(BOTH, SPOTS, DATED),
    "by metres.railml": railml(BOTH, BY_METRES),
    "a metre off.railml": railml(BOTH, A_METRE_OFF),
    "level of more.railml": with_element(
        railml(
            BOTH, SPOTS.replace(spot("B", "e", "0.2"), spot("B", "e", "0.2", ON_WHOLE)), networks=level(*"wens", "we")
        ),
        COLLECTS,
    ).replace("<level ", '<level descriptionLevel="Macro"><networkResource ref="whole"/></level><level ', 1),
    "collected.railml": with_element(railml(BOTH, SPOTS), COLLECTS),
    "tracks over it.railml": railml(
        BOTH,
        SPOTS,
        OVER_BOTH
        + LONG_TRACK.format(TENTH, "50", "physical").replace('"T"', '"T2"')
        + LONG_TRACK.format("", "50", "operational").replace('"T"', '"T3"')
        + LONG_TRACK.format("", "495", "physical").replace('"T"', '"T4"'),
    ),
    "entry at a joint.railml": railml(
        BOTH,
        APART_A.format(BACK.format("e", "0.0", "normal"), BACK.format("w", "1.0", "normal"))
        + SPOTS[len(spot("A", "w", "0.8")) :],
    ),
    "as long as its track.railml": with_e(
        railml(BOTH, SPOTS, OVER_BOTH + NO_LENGTH + LONG_TRACK.format("", "500", "physical").replace('"T"', '"T2"')),
        '<netElement id="e"/>',
    ),
    "drawn within a hundredth.railml": with_e(
        railml(BOTH, SPOTS), TOLD_AND_DRAWN.format(POINT.format(0) + POINT.format(505))
    ),
    "tracks of parts.railml": railml(BOTH, SPOTS, HALF.format("T", 0, 250) + HALF.format("T2", 250, 500)),
    "track of nearly all.railml": railml(BOTH, SPOTS, HALF.format("T", 0, 495)),
    "related again.railml": railml(AGAIN + BOTH + AGAIN.replace("we2", "we4"), SPOTS),
    "slip with its parts.railml": railml(SLIP, SPOTS, WHOLE_SLIP + PARTS),
    "part of a slip that fouls.railml": railml(SLIP, CLOSE_TO_X, WHOLE_SLIP + PARTS, OF_X1),
    "station border within.railml": railml(BOTH, SPOTS, WITHIN),
    "station border of two tracks.railml": railml(BOTH, SPOTS, TWO_TRACKS),
    "station border at a joint.railml": railml(BOTH, SPOTS, LIMIT.format("", "1.0")),
    "station border at a switch.railml": railml(TURNOUT, ON_LEGS, SWITCHES + LIMIT.format(' isOpenEnd="0"', "1.0")),
    "from a station border.railml": re.sub(
        '<routeEntry id="Ae">.*?/>', FROM_LIMIT, railml(BOTH, SPOTS, WITHIN.replace('"both"', '"normal"'))
    ),
    "section to a station border.railml": railml(BOTH, SPOTS, WITHIN, TO_THE_LIMIT),
    "branch without a relation.railml": railml(
        TURNOUT, ON_LEGS, SWITCHES.replace("<leftBranch", "<straightBranch/><leftBranch")
    ),
}
"""Files that look much like these and hold."""
