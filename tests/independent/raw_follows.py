"""What follows from a layout, counted again over the plain graph: conflicts of routes, and routes on from inside."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from itertools import combinations, pairwise
from typing import Any

from kernel.layout import Layout
from kernel.names import Route as RouteName
from models.ground import Ground
from models.layouts import Imported, check
from models.layouts.conflict_pairs import Conflicts
from models.layouts.continuation import with_continuations
from tests.independent import raw_table
from tests.independent.files import Enumerated, network_of
from tests.independent.raw_graph import Network, Route, common, leads

# ---- conflicts


def differing_conflicts(imported: Imported, found: Enumerated) -> list[str]:
    """Pairs of routes that the importer says conflict otherwise, or by other elements; fouling told is believed."""
    if isinstance(found, raw_table.Enumerated):
        fouls = raw_table.fouling_blocks(found)
    else:
        told = {} if imported.told is None else imported.told.fouls
        fouls = {(str(one), str(other)) for one, others in told.items() for other in others}
    ours = {}
    for one, other in combinations(sorted(found.routes), 2):
        first, second = found.routes[one], found.routes[other]
        blocks = set(first.claims) & set(second.claims)
        beside = {(a, b) for a in first.claims for b in second.claims if (a, b) in fouls}
        points = {point for point, at in first.needs.items() if second.needs.get(point, at) != at}
        if blocks or beside or points:
            ours[one, other] = (blocks, beside, points, "B" * bool(blocks) + "F" * bool(beside) + "P" * bool(points))
    conflicts = Conflicts(imported.layout)
    theirs = {}
    for one, other in conflicts.pairs():
        why = conflicts.why(one, other)
        theirs[str(one), str(other)] = (set(why.blocks), set(why.fouling), set(why.points), why.signs)
    return [
        f"{one} and {other} conflict by {theirs.get((one, other))} and not {ours.get((one, other))}"
        for one, other in sorted({*ours, *theirs})
        if ours.get((one, other)) != theirs.get((one, other))
    ]


# ---- a strict verdict


def differing_strictly(imported: Imported, found: Enumerated) -> list[str]:
    """What a strict verdict refuses beside a plain one: all that it rests on and the file does not declare."""
    plain, strict = check(imported), check(imported, strict=True)
    ours = {
        frozenset(str(element) for instance in rest.instances for element in instance)
        for rest in plain.rests
        if not rest.declared
    }
    more = [violation for violation in strict.violations if violation not in plain.violations]
    theirs = {frozenset(map(str, violation.elements)) for violation in more}
    differing = [] if ours == theirs else [f"strictly: {theirs} is not {ours}"]
    return differing + ([] if (strict.verdict == "holds") == (not ours and plain.verdict == "holds") else ["verdict"])


# ---- routes on from inside others


def differing_rests_of_routes(imported: Imported, found: Enumerated) -> list[str]:
    """What is left of each route in each block that it covers: whether a train may go on from there, and how."""
    network = network_of(found)
    if network is None:
        return []
    wider, ground = with_continuations(imported.layout, imported.ground)
    routes: Mapping[str, Any] = found.routes
    ours = {
        rest["name"]: rest
        for route in routes.values()
        if RouteName(route.name) in imported.layout.routes
        for rest in _rests(network, routes, route, imported)
    }
    theirs = {str(name): _of(wider, ground, name) for name in wider.routes - imported.layout.routes}
    return [
        f"{name}: {theirs.get(name)} is not {ours.get(name)}"
        for name in sorted({*ours, *theirs})
        if ours.get(name) != theirs.get(name)
    ]


def _of(layout: Layout, ground: Ground, name: RouteName) -> dict[str, Any]:
    """The same of a route on that the importer made."""
    tags = [layout.first_tag[name]]
    while tags[-1] in layout.tag_after[name]:
        tags.append(layout.tag_after[name][tags[-1]])
    return {
        "name": name,
        "start": layout.start[name],
        "destination": layout.destination[name],
        "covers": set(layout.covers[name]),
        "overlap": set(layout.overlap[name]),
        "claims": set(layout.claims[name]),
        "way": dict(layout.way[name]),
        "needs": dict(layout.needs[name]),
        "released with": dict(layout.released_with[name]),
        "released after": dict(layout.released_after[name]),
        "tags": tags,
        "more tags": set(layout.tag_after[name]) - set(tags),
        "leads": {
            block: {into: dict(lies) for into, lies in targets.items()} for block, targets in ground.leads[name].items()
        },
        "turns": {block: set(targets) for block, targets in ground.turnout[name].items() if targets},
        "flank": {block: dict(targets) for block, targets in ground.flank_point[name].items() if targets},
    }


def _rests(network: Network, routes: Mapping[str, Route], route: Route, imported: Imported) -> Iterator[dict[str, Any]]:
    """The routes on from inside a route that no train can be led astray by."""
    layout, ground, name = imported.layout, imported.ground, RouteName(route.name)
    claims, tags = route.claims, _tags(layout, name)
    stands = {point: block for block, points in network.points_in.items() for point in points}
    held = {(str(block), str(into)) for block, others in ground.held_by_authority.items() for into in others}
    shields = {
        (str(block), str(into)): str(point)
        for block, targets in ground.flank_point.get(name, {}).items()
        for into, point in targets.items()
    }
    released = {
        point: stands[point] if stands[point] in claims else _last_shielded(network, route, stands[point], point)
        for point in route.needs
    }
    for at, block in enumerate(claims):
        if not 0 < at < len(route.covers):
            continue
        on = claims[at + 1 :]
        needs = {p: lies for p, lies in route.needs.items() if stands[p] == block or released[p] in on}
        led = {each: leads(network, route, each) for each in on[:-1]}
        out = _out_of(network, routes, block, on[0])
        if any(needs.get(point) != lies for point, lies in out[on[0]].items()):
            continue
        if _astray({**led, block: out}, dict(pairwise(claims)), needs, stands):
            continue
        if _from_beside(network, [block, *on], needs, {pair: p for pair, p in shields.items() if pair[1] in on}, held):
            continue
        if _another_track(network, block, (claims[at - 1], on[0]), needs):
            continue
        yield {
            "name": f"{route.name} from {block}",
            "start": block,
            "destination": route.destination,
            "covers": {*route.covers} & {*on},
            "overlap": {*route.overlap},
            "claims": {block, *on},
            "way": dict(pairwise([block, *on])),
            "needs": needs,
            "released with": {point: released[point] for point in needs},
            "released after": {block: block} | {b: a for b, a in _released(route).items() if b in on},
            "tags": tags[2 * at :],
            "more tags": set(),
            "leads": {**led, block: out},
            "turns": _turns({**led, block: out}, dict(pairwise([block, *on])), needs, stands),
            "flank": _flank_of(ground, name, on),
        }


def _tags(layout: Layout, name: RouteName) -> list[str]:
    """The tags of a whole route in order."""
    found = [layout.first_tag[name]]
    while found[-1] in layout.tag_after[name]:
        found.append(layout.tag_after[name][found[-1]])
    return [str(tag) for tag in found]


def _released(route: Route) -> dict[str, str]:
    return {**route.released_after, **{block: block for block in route.overlap}}


def _last_shielded(network: Network, route: Route, beside: str, point: str) -> str:
    """The last block that a point of the flank shields: of those that the route covers, else of its overlap."""
    lies = route.needs[point]
    shielded = [
        block
        for block in route.claims[1:]
        if (demands := network.demands(beside, block)) is not None and demands.get(point, lies) != lies
    ]
    return ([block for block in shielded if block in route.covers] or shielded)[-1]


def _out_of(network: Network, routes: Mapping[str, Route], block: str, onward: str) -> dict[str, dict[str, str]]:
    """Where track leads from a block, for trains of any route that are led onward from there as well."""
    found: dict[str, dict[str, str]] = {}
    for route in routes.values():
        targets = leads(network, route, block) if block in route.claims[:-1] else {}
        for into, lies in targets.items() if onward in targets else ():
            found[into] = common(found.get(into, lies), lies)
    return found


def _astray(
    led: Mapping[str, Mapping[str, Mapping[str, str]]],
    way: Mapping[str, str],
    needs: Mapping[str, str],
    stands: Mapping[str, str],
) -> bool:
    """Whether track leads off the way, and no held point of that block turns a train from it."""
    turns = _turns(led, way, needs, stands)
    return any(
        into != way[block] and into not in turns.get(block, ()) for block, targets in led.items() for into in targets
    )


def _turns(
    led: Mapping[str, Mapping[str, Mapping[str, str]]],
    way: Mapping[str, str],
    needs: Mapping[str, str],
    stands: Mapping[str, str],
) -> dict[str, set[str]]:
    """Block -> the blocks off the way that a held point of it keeps a train from."""
    found = {
        block: {
            into
            for into, lies in targets.items()
            if into != way[block]
            and any(stands[point] == block and needs.get(point, at) != at for point, at in lies.items())
        }
        for block, targets in led.items()
    }
    return {block: targets for block, targets in found.items() if targets}


def _from_beside(
    network: Network,
    claims: list[str],
    needs: Mapping[str, str],
    shields: Mapping[tuple[str, str], str],
    held: set[tuple[str, str]],
) -> bool:
    """Whether track leads into a block behind the start from beside, past no held point and under no authority."""
    for target in claims[1:]:
        for block in network.neighbours[target] - set(claims):
            demands, point = network.demands(block, target), shields.get((block, target))
            closed = point is not None and demands is not None and needs.get(point, "") != demands.get(point)
            if demands is not None and (block, target) not in held and not closed:
                return True
    return False


def _another_track(network: Network, block: str, own: tuple[str, str], needs: Mapping[str, str]) -> bool:
    """Whether track may lead from the block elsewhere than onward and back, since no point that it takes is held.

    Where track leads onward or back over a boundary more, that is another track too, however its points lie.
    """
    over = {(way.out, way.into) for way in network.ways(block)}
    if any(sum(into == each for _, into in over) > own.count(each) for each in own):
        return True
    return any(
        all(needs.get(point, at) == at for point, at in demands.items())
        for into in {into for _, into in over} - {*own}
        if into is not None and (demands := network.demands(block, into)) is not None
    )


def _flank_of(ground: Ground, name: RouteName, on: list[str]) -> dict[str, dict[str, str]]:
    """What shields what is left, of what shields the whole route."""
    found = {
        str(block): {str(into): str(point) for into, point in targets.items() if into in on}
        for block, targets in ground.flank_point.get(name, {}).items()
    }
    return {block: targets for block, targets in found.items() if targets}
