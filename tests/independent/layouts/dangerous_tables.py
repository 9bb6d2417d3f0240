"""Interlocking tables with a danger each, and some without, which look much like them (:mod:`dangerous`)."""

from __future__ import annotations

from typing import Any

import yaml

from tests.independent.layouts.danger import UNREAD, danger_of


def table(*rows: dict[str, Any], **more: Any) -> str:
    """A table of its rows."""
    return yaml.safe_dump({"interlocking-table": list(rows), **more}, sort_keys=False)


def row(name: str, ends: str, way: str, path: str, conflicts: str = "", **more: Any) -> dict[str, Any]:
    """A row from signal to signal over pieces, each of a section of its own."""
    source, destination = ends[0], ends[1]
    pieces = path.split()
    return {
        "id": name,
        "source": source,
        "destination": destination,
        "orientation": way,
        "path": [{"id": f"piece {piece}"} for piece in pieces],
        "sections": [{"id": f"section {piece}"} for piece in pieces],
        "points": [],
        "conflicts": [{"id": other} for other in conflicts.split()],
        **more,
    }


ROWS = (
    row("1", "AC", "up", "x y", "2 3 4"),
    row("2", "CA", "down", "y x", "1 3 4"),
    row("3", "AB", "up", "x", "1 2"),
    row("4", "BC", "up", "y", "1 2"),
)
SKIPPED = table(
    row("1", "AD", "up", "x z", "2 3"), row("2", "AB", "up", "x y", "1 3"), row("3", "BD", "up", "z", "1 2")
)


def _beside(name: str, passed: tuple[str, str], **more: Any) -> str:
    """Two lines of two sections each, routes over both and over each part, which conflict with what they lie in.

    The long routes pass the signals ``passed``, which stand for a way onto another track.
    """
    up = row("1", "AB", "up", "x y", "2 3 4"), row("3", "AM", "up", "x", "1"), row("4", "MB", "up", "y", "1")
    down = row("2", "CD", "up", "u v", "1 5 6"), row("5", "CN", "up", "u", "2"), row("6", "ND", "up", "v", "2")
    for each, signal in zip((up[0], down[0]), passed, strict=True):
        each["path"].insert(1, {"id": signal})
    return table(*up, *down, row("7", "G" + name, "up", "w"), **more)


def over_point(name: str, ends: str, way: str, beyond: str, conflicts: str) -> dict[str, Any]:
    """A row over a loose piece where point P lies to the left, and over one section before or behind it."""
    told = {"path": [{"id": "loose"}, {"id": f"piece {beyond}"}], "points": [{"id": "P", "position": "left"}]}
    return {**row(name, ends, way, beyond, conflicts), **told}


LEFT_TWICE = table(
    over_point("1", "BA", "up", "a", "2 4"),
    over_point("2", "CA", "up", "a", "1 4"),
    row("4", "ED", "down", "a", "1 2"),
    row("5", "XB", "up", "b"),
    row("6", "YC", "up", "c"),
)
LEFT_AND_RIGHT = table(
    over_point("1", "BA", "up", "a", "2 4"),
    {**over_point("2", "BE", "up", "a", "1 4"), "points": [{"id": "P", "position": "right"}]},
    row("4", "ED", "down", "a", "1 2"),
    row("5", "XB", "up", "b"),
)
MEET_AT_AN_END = table(
    row("1", "BD", "up", "a d", "2"),
    row("2", "CS", "up", "a", "1"),
    row("5", "XB", "up", "b"),
    row("6", "YC", "up", "c"),
)
MEET_THE_OTHER_WAY = table(
    row("2", "CS", "up", "a", "7"),
    row("3", "SD", "up", "d"),
    row("6", "YC", "up", "c"),
    row("7", "EF", "down", "a", "2"),
    row("8", "FG", "down", "b"),
)


def _through(*more: dict[str, Any]) -> str:
    """A row over three pieces that lists the sections of the first two, one that runs over the second, and others."""
    three = {"path": [{"id": f"piece {piece}"} for piece in "xyz"]}
    first = row("R", "AB", "up", "x y", " ".join(("D", *(each["id"] for each in more))))
    return table({**first, **three}, row("D", "NM", "down", "y", "R"), *more)


def _lying(beyond: str, at_start: str = "") -> str:
    """A route that ends on a point, one that starts there, and those that show both ways over it."""
    first = {"path": [{"id": "piece a"}, {"id": "loose"}], "points": [{"id": "P", "position": "left"}]}
    others = {"": "8", "left": "5 8", "right": "1 4 8"}[at_start]
    third = row("3", "SC", "up", "c", others, points=[{"id": "P", "position": at_start}] if at_start else [])
    against = {each: " 3" if at_start and (each == "5") == (at_start == "left") else "" for each in "145"}
    return table(
        {**row("1", "AS", "up", "a", "4 5 7" + against["1"]), **first},
        third,
        over_point("4", "DE", "down", "a", "1 5 7" + against["4"]),
        {**over_point("5", "FE", "down", "a", "1 4 7" + against["5"]), "points": [{"id": "P", "position": beyond}]},
        row("6", "GD", "down", "b"),
        row("7", "AM", "up", "a", "1 4 5"),
        row("8", "KF", "down", "c", "3"),
    )


def _ending(*words: str) -> str:
    """Routes that end on a point and before it, by the words for the two ways that it lies."""
    lies = [{"points": [{"id": "P", "position": word}]} for word in words]
    to_point = {**row("1", "AS", "up", "a", "5 7"), "path": [{"id": "piece a"}, {"id": "loose"}], **lies[0]}
    from_point = {**over_point("5", "FE", "down", "a", "1 7"), **lies[1]}
    return table(to_point, from_point, row("7", "AM", "up", "a", "1 5"), row("8", "KF", "down", "c"))


def over_points(name: str, ends: str, way: str, path: str, points: str = "") -> dict[str, Any]:
    """A row over pieces, of which ``p`` and ``q`` are of no section, and points, each with the sign of its position."""
    told = {
        "path": [{"id": piece if piece in ("p", "q") else f"piece {piece}"} for piece in path.split()],
        "points": [{"id": point[0], "position": point[1:]} for point in points.split()],
    }
    return {**row(name, ends, way, " ".join(piece for piece in path.split() if piece not in ("p", "q"))), **told}


def compared(*rows: dict[str, Any], **more: Any) -> str:
    """A table in which rows declare the conflicts that follow: they share a piece, or want a point otherwise."""

    def conflict(one: dict[str, Any], other: dict[str, Any]) -> bool:
        lies = [{point["id"]: point["position"] for point in each["points"]} for each in (one, other)]
        shared = {piece["id"] for piece in one["path"]} & {piece["id"] for piece in other["path"]}
        return bool(shared) or any(lies[1].get(point, at) != at for point, at in lies[0].items())

    against = [[{"id": other["id"]} for other in rows if other is not one and conflict(one, other)] for one in rows]
    return table(*({**one, "conflicts": others} for one, others in zip(rows, against, strict=True)), **more)


SWITCHED = (
    over_points("1", "AE", "up", "s p a", "P+"),
    over_points("2", "AF", "up", "s p b", "P-"),
    over_points("3", "GZ", "down", "p s", "P+"),
    over_points("4", "HZ", "down", "p s", "P-"),
    over_points("8", "UG", "down", "a"),
    over_points("9", "VH", "down", "b"),
)
"""Rows over a section, the point behind it and on over either leg, and back; and those that end before the point."""
SLIP = (
    over_points("1", "AC", "up", "a p c", "P+ Q+"),
    over_points("2", "AD", "up", "a p d", "P+ Q-"),
    over_points("3", "BC", "up", "b p c", "P- Q+"),
    over_points("4", "BD", "up", "b p d", "P- Q-"),
)
"""Rows over a slip, whose two points stand on one piece."""
THROUGH_BOTH = over_points("1", "AB", "up", "s p m q e", "P+ Q+")
PARTED = (
    over_points("4", "AD", "up", "s p d", "P-"),
    over_points("5", "JK", "down", "c q", "Q-"),
    over_points("6", "AN", "up", "s"),
)
"""Beside a row over two points, those that tell the track under either from the section before it."""
IN_NO_ORDER = over_points("3", "AC", "up", "s p m q c", "Q- P+")


def _back(points: str) -> dict[str, Any]:
    """The row back over both points, which it lists so."""
    return over_points("2", "FG", "down", "e q m p s", points)


def within(each: dict[str, Any], *sections: str) -> dict[str, Any]:
    """A row with these sections, whatever its pieces are called."""
    return {**each, "sections": [{"id": section} for section in sections]}


def _three_pieces(**more: Any) -> str:
    """Two sections that always come together, over three pieces of which one has the name of a section; and another."""
    path = {"path": [{"id": f"piece {piece}"} for piece in "xy"] + [{"id": "section z"}]}
    others = "2" if more else ""
    return table({**row("1", "AB", "up", "x z", others), **path}, row("2", "CD", "up", "u", others and "1"), **more)


TABLES_THAT_HOLD = {
    "table.yml": table(*ROWS),
    "tracks cross in a section.yml": table(
        row("1", "AB", "up", "a x b", "2 3"),
        row("2", "CD", "up", "c x d", "1 4"),
        row("3", "AM", "up", "a", "1"),
        row("4", "CN", "up", "c", "2"),
    ),
    "starts in a crossing.yml": table(
        row("1", "AB", "up", "x b", "2 3 4"),
        row("2", "CD", "up", "x d", "1 3 4"),
        row("3", "EF", "down", "b x a", "1 2 4"),
        row("4", "GH", "down", "d x c", "1 2 3"),
    ),
    "starts behind a start.yml": table(
        row("1", "AB", "up", "x y", "2 3"), row("2", "CD", "down", "x w", "1"), row("3", "EC", "down", "y", "1")
    ),
    "starts on a point.yml": _lying("right", "right"),
    "ends on a point.yml": _ending("left", "right"),
    "two sections.yml": table(row("1", "AB", "up", "x y", "2"), row("2", "BA", "down", "y x", "1")),
    "three pieces.yml": _three_pieces(),
    "section and piece of one name.yml": _three_pieces(fouling=[["section z", "section u"]]),
    "over the point alone.yml": compared(*SWITCHED, over_points("5", "ME", "up", "p a", "P+")),
    "over the section alone.yml": compared(*SWITCHED, over_points("5", "AM", "up", "s")),
    "over and from the point.yml": compared(
        *(*SWITCHED, over_points("5", "AM", "up", "s"), over_points("7", "AT", "up", "s p", "P+")),
        {**over_points("6", "TE", "up", "a"), "points": [{"id": "P", "position": "+"}]},
    ),
    "a piece left out.yml": compared(
        *(within(over_points(ends, ends, "up", "s t"), "x") for ends in ("AB", "AC")),
        *(within(over_points(ends, ends, "down", "t s"), "x") for ends in ("DY", "DZ")),
        within(over_points("AN", "AN", "up", "t"), "x"),
    ),
    "slip.yml": compared(*SLIP),
    "single slip.yml": compared(*SLIP[:3]),
    "points of one row in no order.yml": compared(THROUGH_BOTH, _back("Q+ P+"), IN_NO_ORDER, *PARTED),
    "points in running order.yml": compared(THROUGH_BOTH, _back("Q+ P+"), *PARTED),
    "two pieces each.yml": compared(
        over_points("3", "NR", "up", "k p", "P-"),
        within(over_points("1", "AB", "up", "s t p u e", "P+"), "x", "y"),
        within(over_points("2", "FG", "down", "e u p t s", "P+"), "y", "x"),
    ),
    "one of two sections fouls.yml": table(
        row("1", "AB", "up", "x y", "2"), row("2", "CD", "up", "u", "1"), fouling=[["piece y", "section u"]]
    ),
    "starts where others run on.yml": table(row("1", "ZB", "up", "w x", "2"), row("2", "AB", "up", "x", "1")),
    "sections foul.yml": table(
        row("1", "AB", "up", "x", "2"), row("2", "CD", "up", "u", "1"), fouling=[["piece x", "section u"]]
    ),
}
"""Tables without a danger, one of each thing that can be right: what is wrong looks much like it."""


FOULED = [row("1", "AB", "up", "x", "4"), row("2", "BC", "up", "y", "4"), row("4", "GH", "up", "z", "1 2")]
FOULED[0] |= {"path": [{"id": "section y"}]}
DANGEROUS_TABLES = {
    "starts on a point.yml": danger_of(
        _lying("right"),
        "a route starts on a point that lies as the train came over it, and leads the other way",
        "a route is led over its points",
        *("3", "P"),
    ),
    "left twice at a start.yml": danger_of(
        _lying("right", "left"),
        "a route starts on a point, and is told to leave by the leg that the point does not lie for",
        "a point leads one way",
        *("1", "3", "4", "P", "section a", "section b", "section c"),
    ),
    "back and forth.yml": danger_of(
        table(
            row("1", "AB", "up", "a x b", "2 3 4"),
            row("2", "CD", "up", "b x a", "1 3 4"),
            row("3", "AM", "up", "a", "1 2"),
            row("4", "CN", "up", "b", "1 2"),
            row("5", "ZA", "up", "z"),
            row("6", "WC", "up", "w"),
        ),
        "two sections lie at both ends of a third: routes that run the same way meet head-on",
        "tracks merge at a point",
        *("1", "2", "section a", "section b", "section x"),
    ),
    "left and Left.yml": danger_of(
        _lying("Left"),
        "a position is told by two words, and two legs of a point are taken to lie for one train",
        "a point lies one way or the other",
        *("P", "1", "5"),
    ),
    "points in either order.yml": danger_of(
        compared(THROUGH_BOTH, _back("P+ Q+"), IN_NO_ORDER, *PARTED),
        "rows disagree on the order of two points: nobody knows which of them stands first",
        "a route's positions are of its points",
        *("P", "Q", "1", "2", "3", "4", "5"),
    ),
    "always together.yml": danger_of(
        compared(over_points("1", "AE", "up", "s p", "P+"), over_points("2", "GZ", "down", "p s", "P+")),
        "a section and the track under a point always come together: nobody knows on which the point stands",
        "a route's positions are of its points",
        *("P", "1", "2"),
    ),
    "left in two alphabets.yml": danger_of(
        _ending("left", "l\u0435ft"),
        "a position is told twice in letters that look the same, one of another alphabet: two legs lie for one train",
        "a point lies one way or the other",
        *("P", "1", "5"),
    ),
    "capitals of other letters.yml": danger_of(
        _ending("ΚΑΝΟΝΙΚΑ", "κανονικα"),
        "a position is told twice, in capitals and not, of which one is drawn as another letter than the other",
        "a point lies one way or the other",
        *("P", "1", "5"),
    ),
    "left and something unseen.yml": danger_of(
        _ending("left", "left\u200b"),
        "a position is told twice, once with a space of no width: two legs of a point are taken to lie for one train",
        "route '5' points: 'left\\u200b' is not usable as a name",
    ),
    "up and something unseen.yml": danger_of(
        table(row("1", "AB", "up", "x", "2"), row("2", "BA", "up\u200b", "x", "1")),
        "a direction is told twice, once with a space of no width, and is taken for the other",
        "route '2' orientation: 'up\\u200b' is not usable as a name",
    ),
    "fouling of a piece of either.yml": danger_of(
        _three_pieces(fouling=[["piece y", "section u"]]),
        "what fouls is a piece that may lie in either of two sections: the wrong one may be kept free",
        "'piece y' may lie in section section x or section z",
    ),
    "a third position.yml": danger_of(
        table(
            over_point("1", "AB", "up", "b", "2 3"),
            {**over_point("2", "AC", "up", "c", "1 3"), "points": [{"id": "P", "position": "right"}]},
            {**over_point("3", "AD", "up", "d", "1 2"), "points": [{"id": "P", "position": "straight on"}]},
            row("0", "ZA", "up", "a"),
        ),
        "a point has three positions by name",
        "a point lies one way or the other",
        *("P", "1", "2", "3"),
    ),
    "piece and section.yml": danger_of(
        table(*FOULED, fouling=[["section y", "section z"]]),
        "what fouls is told by a name that is one section's, and a piece of another: one of them fouls nothing",
        "'section y' is a section, and a piece of section 'section x'",
    ),
    "faces both ways.yml": danger_of(
        table(
            row("0", "ZA", "up", "w"),
            row("1", "AB", "up", "x"),
            row("2", "BC", "down", "y", "5"),
            row("5", "BD", "up", "y z", "2"),
            row("6", "DE", "up", "u"),
        ),
        "a row says down for up: its route is started at the other end of the track, and led into the train there",
        "a signal stands at one place",
        *("B", "2", "section x", "section y"),
    ),
    "level crossing.yml": danger_of(
        table({**ROWS[0], "crossings": [{"id": "road"}]}, *ROWS[1:], derailers=[{"id": "trap"}]),
        "a row names a level crossing, the table a derailer, and nobody asks whether these are closed and off",
        UNREAD,
        *("1", "derailers"),
    ),
    "three ways.yml": danger_of(
        table(*ROWS[:3], {**ROWS[3], "orientation": "Up"}),
        "'Up' is written once for 'up': the row is taken to run another way than those that it follows",
        "routes run one way or the other",
        *("1", "2", "4"),
    ),
    "up and Up.yml": danger_of(
        table(row("1", "AB", "up", "x"), row("2", "BC", "Up", "y")),
        "'Up' is written once for 'up' where no row runs the other way",
        "differ in case",
        *("up", "Up"),
    ),
    "fouling of signals.yml": danger_of(
        _beside("S", ("S", "G"), fouling=[["S", "G"]]),
        "what fouls is told by the names of signals, which are no track: no block fouls another, and both trains run",
        "no route runs over track 'S'",
    ),
    "one signal passed.yml": danger_of(
        _beside("S", ("S", "S")),
        "two routes are declared to conflict, and share the name of a signal alone: nothing keeps their trains apart",
        "declared conflicts follow",
        *("1", "2"),
    ),
    "left twice.yml": danger_of(
        LEFT_TWICE,
        "a point in one position leads from one track to two: trains are permitted onto the leg that it is not set for",
        "a point leads one way",
        *("1", "2", "P", "section a", "section b", "section c"),
    ),
    "two before.yml": danger_of(
        table(
            row("1", "AB", "up", "x", "2 3"), row("2", "CD", "down", "x w", "1 3"), row("3", "CE", "down", "x v", "1 2")
        ),
        "a route starts in one of two sections, and nobody knows in which",
        "a route starts in a known block",
        *("A", "section v", "section w"),
    ),
    "starts over a point.yml": danger_of(
        table(over_point("1", "AB", "up", "a", "2"), row("2", "CD", "down", "a", "1")),
        "a route starts over a point, and nothing tells what lies before that",
        "a route starts in a known block",
        "A",
    ),
    "left and right.yml": danger_of(
        LEFT_AND_RIGHT,
        "two routes run the same way over a point and want it otherwise: one of them is derailed",
        "a point lies one way between two blocks",
        *("1", "2", "P"),
    ),
    "meet where a route ends.yml": danger_of(
        MEET_AT_AN_END,
        "tracks meet in a section without a point, and the route over one of them ends there",
        "tracks merge at a point",
        *("1", "2", "section a", "section b", "section c"),
    ),
    "meet the other way.yml": danger_of(
        MEET_THE_OTHER_WAY,
        "the same, and the routes run the two ways",
        "tracks merge at a point",
        *("2", "8", "section a", "section b", "section c"),
    ),
    "of no section.yml": danger_of(
        _through(row("E", "AN", "up", "x", "R")),
        "the last piece of a path is of no section and of no point: the train in it is detected by nothing",
        "track lies in a section or at a point",
        *("R", "piece z"),
    ),
    "back into a section.yml": danger_of(
        _through(),
        "a path comes back into a section that it has left: one half of it lies behind the route's end",
        "a route passes a block once",
        *("R", "section x"),
    ),
    "signal and section.yml": danger_of(
        table(*ROWS[:3], {**ROWS[3], "source": "section x"}),
        "one name is a signal and a section",
        "'section x' is the name of a signal too",
    ),
    "signals alone.yml": danger_of(
        table(*ROWS, {**row("5", "AC", "up", "x"), "path": [{"id": "B"}]}),
        "a path is of signals alone: the route runs over no track",
        "holds signals alone",
    ),
    "no sections.yml": danger_of(
        table({**ROWS[0], "sections": []}, *ROWS[1:]),
        "a route lists no section: nothing detects a train on it",
        "sections: is empty",
    ),
    "block by name.yml": danger_of(
        table({**ROWS[0], "path": [{"id": "before A"}, {"id": "piece y"}]}, *ROWS[1:]),
        "a piece has the name of the block that a route is started in where the table begins",
        "'before A' is the name of a block at signal 'A' too",
    ),
    "skips a piece.yml": danger_of(
        SKIPPED,
        "route 1 runs over y, which it does not list and so does not claim",
        "tracks merge at a point",
        *("1", "3", "section x", "section y", "section z"),
    ),
}
"""Every table with what must be said of it."""
