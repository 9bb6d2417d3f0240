"""railML 3 files with a danger each in which ways lead from where a route begins to where it ends (:mod:`dangerous`).

Between the two lie more ways, or more track, than anybody could look at one by one.
"""

from __future__ import annotations

import re
from collections.abc import Iterable

from tests.independent.layouts.danger import danger_of
from tests.independent.layouts.dangerous_railml import BOTH, SPOTS, TURNS, railml, relation, spot

DETECTOR = """<trainDetectionElement id="{0} d"><spotLocation netElementRef="{0}" intrinsicCoord="0.5"/>
</trainDetectionElement>"""
LINE_NS = BOTH.replace(relation("we", "w", "e"), "")


def switch(name: str, left: str, right: str) -> str:
    """A switch by the relations of its branches."""
    branches = f'<leftBranch netRelationRef="{left}"/><rightBranch netRelationRef="{right}"/>'
    return f'<switchIS id="{name}">{branches}</switchIS>'


def stations(count: int, first: str, last: str) -> tuple[list[str], str, str]:
    """So many passing stations in a row between two tracks: their tracks, relations, and switches and detectors.

    Of each the tracks are ``l`` and ``r`` between the points ``P`` and ``Q``, and the line on to the next is ``m``.
    """
    tracks, relations, functional = [], "", ""
    for number in range(1, count + 1):
        before, behind = f"m{number - 1}" if number > 1 else first, f"m{number}" if number < count else last
        for side in "lr":
            track = f"{side}{number}"
            tracks.append(track)
            relations += relation(f"P{track}", before, track) + relation(f"Q{track}", track, behind)
            functional += DETECTOR.format(track)
        for point, left, right in (("P", "l", "r"), ("Q", "r", "l")):
            functional += switch(f"{point}{number}", f"{point}{left}{number}", f"{point}{right}{number}")
    return [*tracks, *(f"m{number}" for number in range(1, count))], relations, functional


def with_tracks(text: str, tracks: Iterable[str]) -> str:
    """The file with more net elements of 500 m."""
    elements = "".join(f'<netElement id="{name}" length="500"/>' for name in tracks)
    return text.replace("<netElements>", f"<netElements>{elements}")


def named(*points: str) -> str:
    """A route's facing points, each left."""
    return "".join(TURNS.format("facingSwitchInPosition", "left").replace('"P"', f'"{point}"') for point in points)


def of_ab(text: str, more: str) -> str:
    """The file with more said of its route AB."""
    return text.replace('<route id="AB">', f'<route id="AB">{more}')


def over_stations(count: int, given: str, assets: str = "", spots: str = SPOTS) -> str:
    """From A to B over passing stations."""
    tracks, relations, functional = stations(count, "w", "e")
    return of_ab(with_tracks(railml(LINE_NS + relations, spots, functional, assets), tracks), given)


def beside_stations(
    relations: str, functional: str, more: str, count: int = 12, last: str = "y", spots: str = SPOTS
) -> str:
    """From A to B, where a leg leads off on ``x`` to a line of passing stations."""
    tracks, on, of_stations = stations(count, "x", last)
    made = railml(LINE_NS + relations + on, spots, functional + of_stations)
    return with_tracks(made, [*tracks, "x", *more])


def without_routes(text: str) -> str:
    """The file without its routes."""
    return re.sub(r"<route .*</route>", "", text)


LEADS_OFF = relation("we", "w", "e") + relation("wx", "w", "x")
TO_THE_RIGHT = switch("S", "we", "wx")
EVERY = [f"P{number}" for number in range(1, 8)]
TWO_WAYS = (
    *(relation("wl", "w", "l"), relation("wr", "w", "r"), relation("rx", "r", "x"), relation("rt", "r", "t")),
    *(relation("le", "l", "e"), relation("te", "t", "e")),
)
BALLOON = relation("zb", "z", "b") + relation("bc", "b", "c")
BALLOON += relation("zc", "z", "c").replace('positionOnB="0"', 'positionOnB="1"')
ROUND_BALLOON = switch("V", "zb", "zc") + DETECTOR.format("b") + DETECTOR.format("c")
BEYOND = relation("ez", "e", "z") + relation("yz", "y", "z")
TO_CIRCLE = relation("xc", "x", "c") + relation("cd", "c", "d") + relation("dc", "d", "c")
ROUND_CIRCLE = switch("V", "xc", "dc") + DETECTOR.format("c") + DETECTOR.format("d")
EXIT_BEHIND = SPOTS.replace(spot("B", "e", "0.2"), spot("B", "w", "0.2"))
NOT_ON_RING = spot("A", "w", "0.8") + spot("B", "s", "0.4") + spot("C", "n", "0.8") + spot("D", "s", "0.2")
BEHIND = spot("A", "w", "0.2") + spot("B", "w", "0.8") + spot("C", "n", "0.8") + spot("D", "s", "0.2")
BEHIND += spot("E", "e", "0.2")
LIMITED = '<overlap id="o"><activeForApproachRoute ref="AB"/><isLimitedBy ref="E"/>{}</overlap>'
THREE_POINTS = switch("P", "wl", "wr") + switch("T", "rx", "rt") + switch("Q", "te", "le")

DANGEROUS_WAYS = {
    "first of seven not named.railml": danger_of(
        over_stations(7, named(*EVERY[1:])),
        "of 128 ways two have every named point so: which one the route takes nobody said",
        "several ways lead from 'A' to 'B'",
    ),
    "last of seven not named.railml": danger_of(
        over_stations(7, named(*EVERY[:-1])),
        "the same, and the two are the last that are come to",
        "several ways lead from 'A' to 'B'",
    ),
    "two ways beside a line.railml": danger_of(
        beside_stations("".join(TWO_WAYS), THREE_POINTS + DETECTOR.format("l") + DETECTOR.format("t"), "lrty"),
        "two ways lead to the exit; off one of them lies a line of twelve passing stations, which is looked at first",
        "several ways lead from 'A' to 'B'",
    ),
    "round a balloon.railml": danger_of(
        beside_stations(
            relation("wx", "w", "x") + BEYOND + BALLOON, switch("T", "ez", "yz") + ROUND_BALLOON, "ybcz", count=14
        ),
        "the exit lies on a leg that is come to from a balloon alone, and so over track twice",
        "which ways lead on from 'A tags' is not known after 20,000 pieces of track",
    ),
    "behind its entry.railml": danger_of(
        beside_stations(
            relation("wx", "w", "x") + relation("yz", "y", "z") + BALLOON, ROUND_BALLOON, "ybcz", 14, spots=EXIT_BEHIND
        ),
        "a route's exit lies behind its entry, and is come to from a balloon beyond fourteen stations alone",
        "no way leads from 'A' to 'B'",
    ),
    "round a ring.railml": danger_of(
        railml(LINE_NS + LEADS_OFF.replace(relation("wx", "w", "x"), relation("ew", "e", "w")), NOT_ON_RING),
        "a route's exit lies on another line than its entry, which is on a ring",
        "no way leads from 'A' to 'B'",
    ),
    "overlap over seven.railml": danger_of(
        over_stations(7, "", LIMITED.format(named(*EVERY[1:])), BEHIND),
        "an overlap names six of its seven points: which way it takes nobody said",
        "several ways lead from 'B tags'",
    ),
    "routes over seven.railml": danger_of(
        without_routes(over_stations(7, "")),
        "more ways lead from a signal to the next than anybody would derive routes from",
        "has more than 64 ways",
    ),
}
"""Every file with what must be said of it."""

WAYS_THAT_HOLD = {
    "all of seven named.railml": over_stations(7, named(*EVERY)),
    "line to the right.railml": beside_stations(LEADS_OFF, TO_THE_RIGHT, "y"),
    "line to the left.railml": beside_stations(LEADS_OFF, switch("S", "wx", "we"), "y"),
    "ring to the right.railml": of_ab(
        beside_stations(LEADS_OFF, TO_THE_RIGHT, "", count=14, last="w"),
        TURNS.format("switchPositionInDepartureTrack", "left").replace('"P"', '"Q14"'),
    ),
    "circle to the right.railml": with_tracks(
        railml(LINE_NS + LEADS_OFF + TO_CIRCLE, SPOTS, TO_THE_RIGHT + ROUND_CIRCLE), "xcd"
    ),
    "overlap over all of seven.railml": over_stations(7, "", LIMITED.format(named(*EVERY)), BEHIND),
    "routes over six.railml": without_routes(over_stations(6, "")),
}
"""Files that look much like these and hold."""
