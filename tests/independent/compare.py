"""What an importer made of a layout, put beside the enumeration."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator
from typing import Any

from kernel.layout import Layout
from kernel.names import Block
from kernel.names import Route as RouteName
from models.layouts import CheckResult, Imported
from models.layouts.told import Told
from tests.independent import raw_table
from tests.independent.files import Enumerated, facts_of, network_of
from tests.independent.raw_graph import Network, leads
from tests.independent.raw_graph import Route as Walked
from tests.independent.raw_measures import measured
from tests.independent.raw_names import drawn_alike
from tests.independent.raw_records import differing_records
from tests.independent.raw_rests import Loops, rests_again, shortest_loops


def imported_facts(layout: Layout, route: str) -> dict[str, Any]:
    """Of an imported route, what :func:`tests.independent.files.facts_of` gives of an enumerated one."""
    name = RouteName(route)
    return {
        "start": layout.start[name],
        "covers": sorted(layout.covers[name]),
        "overlap": sorted(layout.overlap[name]),
        "claims": sorted(layout.claims[name]),
        "way": dict(layout.way[name]),
        "destination": layout.destination[name],
        "needs": dict(sorted(layout.needs[name].items())),
        "released_after": {
            block: layout.released_after[name][block] for block in sorted({layout.start[name], *layout.covers[name]})
        },
    }


TRAIN_MM = 5_000
"""Nothing that a unit is built into is shorter."""
Listed = tuple[str, tuple[str, ...]]
"""Rule, and elements in order of name."""


def differing_routes(imported: Imported, found: Enumerated) -> dict[str, list[str]]:
    """Route -> what differs, both values beside each other; routes that only one side has are listed too."""
    differing: dict[str, list[str]] = {}
    both = {*imported.layout.routes, *found.routes}
    for name in sorted(both):
        if name not in found.routes or RouteName(name) not in imported.layout.routes:
            differing[name] = ["imported" if name not in found.routes else "enumerated only"]
            continue
        ours, theirs = facts_of(found.routes[name]), imported_facts(imported.layout, name)
        unlike = [f"{fact}: {theirs[fact]} is not {ours[fact]}" for fact in ours if ours[fact] != theirs[fact]]
        if unlike:
            differing[name] = unlike
    return differing


def enumerated_spans(network: Network) -> dict[str, set[tuple[str, int, int]]]:
    """Block -> track, from and to in mm."""
    return {
        block: {(track, *network.sides((track, index))) for track, index in pieces}
        for block, pieces in network.blocks.items()
    }


def imported_spans(imported: Imported) -> dict[str, set[tuple[str, int, int]]]:
    return {str(block): set(spans) for block, spans in imported.places.spans.items()}


def differing_ground(imported: Imported, found: Enumerated) -> list[str]:
    """Neighbours, open track, where a route's track leads, and where points stand, as far as they differ."""
    network, ground, layout = network_of(found), imported.ground, imported.layout
    if network is None:
        assert isinstance(found, raw_table.Enumerated)
        fouls = {(str(one), str(other)) for one, others in layout.fouls.items() for other in others}
        return [] if fouls == raw_table.fouling_blocks(found) else [f"fouling: {sorted(fouls)}"]
    differing: list[str] = []
    for block in sorted(network.blocks):
        name = Block(block)
        near = ground.neighbours.get(name, frozenset()) - {name}
        if near != network.neighbours[block]:
            differing.append(f"neighbours of {block}")
        opens = {into: network.demands(block, into) for into in sorted(network.neighbours[block])}
        ours = {into: demands for into, demands in opens.items() if demands is not None}
        theirs = {into: dict(demands) for into, demands in ground.opens.get(name, {}).items() if into != name}
        if ours != theirs:
            differing.append(f"opens from {block}: {theirs} is not {ours}")
        if layout.points_in.get(name, frozenset()) != set(network.points_in.get(block, ())):
            differing.append(f"points in {block}")
    for route in found.routes.values():
        assert isinstance(route, Walked)
        for block in route.claims[:-1]:
            ours_led = leads(network, route, block)
            led = ground.leads[RouteName(route.name)][Block(block)]
            if {into: dict(demands) for into, demands in led.items()} != ours_led:
                differing.append(f"{route.name} leads from {block}: {led} is not {ours_led}")
    return differing


def listed_violations(result: CheckResult) -> Counter[Listed]:
    """Rule and elements of every violation; the order of elements says nothing."""
    return Counter(
        (violation.axiom, tuple(sorted(set(map(str, violation.elements))))) for violation in result.violations
    )


def enumerated_violations(imported: Imported, found: Enumerated) -> set[Listed]:
    """Rule and elements of all that the enumeration finds; of clearances it believes what the file tells."""
    ours = {(violation.rule, tuple(sorted(set(violation.elements)))) for violation in found.violations}
    network, told = network_of(found), imported.told
    if network is not None and told is not None:
        fouls = {str(block): {str(other) for other in others} for block, others in told.fouls.items()}
        ours |= {(rule, tuple(sorted(set(elements)))) for rule, elements in measured(network, told.clear_mm, fouls)}
    longest_mm = None if told is None else told.longest_train_mm
    loop = None if network is None or told is None or longest_mm is None else _loops(network, told)
    if network is not None and isinstance(loop, tuple) and longest_mm is not None and longest_mm >= loop[0]:
        ours.add(("a train is shorter than its loop", tuple(sorted(set(network.ends(min(loop[1])))))))
    if longest_mm is not None and longest_mm < TRAIN_MM:
        ours.add(("the longest train is a train", ()))
    for names in names_of(imported, found):
        ours |= {("no two names look the same", alike) for alike in drawn_alike(names)}
    return ours


def _loops(network: Network, told: Told) -> Loops:
    """The shortest loops; of clearances and fouling it believes what the file tells."""
    fouls = {str(block): {str(other) for other in others} for block, others in told.fouls.items()}
    return shortest_loops(network, told.clear_mm, fouls)


def names_of(imported: Imported, found: Enumerated) -> Iterator[Iterable[str]]:
    """The names of a file, kind by kind; those of routes and trains as the importer has them."""
    if isinstance(found, raw_table.Enumerated):
        rows = list(found.rows.values())
        yield [signal for row in rows for signal in (row.source, row.destination)]
        yield [name for row in rows for name in (*row.segments, *row.sections, row.source, row.destination)]
        yield [point for row in rows for point in row.points]
        yield [row.orientation for row in rows]
    else:
        network = found.network
        yield network.lengths
        yield [name for name, junction in network.junctions.items() if len(junction.legs) > 2]
        yield [*network.stops.values(), *(name for cuts in network.cuts.values() for _, name in cuts)]
        yield network.given.values()
    if imported.told is not None:
        yield [wanted.name for wanted in imported.told.routes]
        yield imported.told.trains


def differing_rests(imported: Imported, result: CheckResult, found: Enumerated) -> list[str]:
    """What the verdict rests on, as far as the enumeration counts it otherwise."""
    if isinstance(found, raw_table.Enumerated) or imported.told is None:
        return []
    ours = rests_again(
        found.network, found.routes, imported.told, {(leg.point, leg.leg): leg.boundary for leg in imported.legs}
    )
    theirs: dict[tuple[str, bool], set[tuple[str, ...]]] = {
        (rest.kind, rest.declared): set(rest.instances) for rest in result.rests
    }
    kinds = {"authority", "clearance", "start", "joint", "end", "position", "left out"}
    differing = [
        f"{kind}: {theirs.get(kind)} is not {ours.get(kind)}"
        for kind in sorted({*ours, *(each for each in theirs if each[0] in kinds)})
        if ours.get(kind) != theirs.get(kind)
    ]
    loop = None
    if imported.loop is not None:
        legs = frozenset(map(" ".join, imported.loop.not_told))
        loop = (imported.loop.long_mm, frozenset(map(str, imported.loop.blocks)), legs)
    again = _loops(found.network, imported.told)
    longest_mm = imported.told.longest_train_mm
    declared = isinstance(again, tuple) and longest_mm is not None and longest_mm < again[0] and not again[2]
    told = {(*sorted(again[1]), *sorted(again[2]), f"{again[0]} mm")} if isinstance(again, tuple) else None
    if not isinstance(again, str) and (loop != again or theirs.get(("loop", declared)) != told):
        differing.append(f"loop: {loop} is not {again}")
    return differing


def disagreements(imported: Imported, result: CheckResult, found: Enumerated) -> list[str]:
    """All that the importer and the enumeration see differently; how often a fault is told says nothing."""
    ours = enumerated_violations(imported, found)
    theirs = set(listed_violations(result))
    differing = [
        f"only enumerated: {one}" for one in sorted(ours) if not any(alike(one, other, found) for other in theirs)
    ]
    differing += [
        f"only imported: {other}" for other in sorted(theirs) if not any(alike(one, other, found) for one in ours)
    ]
    for route, facts in differing_routes(imported, found).items():
        differing += [f"{route}: {fact}" for fact in facts]
    if differing:
        return differing
    beside = differing_ground(imported, found) + differing_rests(imported, result, found)
    return [*beside, *differing_records(imported, found)]


def alike(ours: Listed, theirs: Listed, found: Enumerated) -> bool:
    """Whether two violations are of the same rule and elements.

    The importer adds points passed before one that is wrong, where the fault may as well be theirs.  Of a table whose
    train is led astray it names the points that lead it there; the rows name none.
    """
    rule, elements = ours
    if rule != theirs[0]:
        return False
    more, fewer = set(theirs[1]) - set(elements), set(elements) - set(theirs[1])
    if rule == "a route is led over its points":
        return not fewer
    if rule == "track_leads_along_the_way_or_is_turned":
        known = set(getattr(found, "stands_in", ()))
        return not fewer - known and not more - known
    return elements == theirs[1]


def listed_remarks(result: CheckResult, found: Enumerated) -> Counter[tuple[str, ...]]:
    """Elements of every remark about routes or what belongs to them."""
    known = {*(remark.elements[0] for remark in found.remarks), *found.routes}
    return Counter(tuple(sorted(set(remark.elements))) for remark in result.remarks if remark.elements[0] in known)
