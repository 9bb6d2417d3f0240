"""Running a train along its route: what it does, what its antennas read, and what it reports (T2, T5, T6, T7)."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from itertools import pairwise
from typing import Any

from kernel.layout import Layout
from kernel.machine.centre import NO_ROUTE
from kernel.names import Block, Cab, Car, Cause, Point, Read, Route, Run, Stage, Tag, Train
from kernel.unit import Evidence, Order
from models.simulator.senses import INSIDE, WHOLE
from proofs.witnesses.changes import GONE, Changes, came, went
from proofs.witnesses.scenario import Scenario
from proofs.witnesses.telling import blocks_of


def run_through(scenario: Scenario, run: Run, *blocks: Block) -> None:
    """A whole train runs through the blocks given, the first being where it stands, and comes to rest."""
    roll(scenario, run)
    pass_through(scenario, run, *blocks)
    rest(scenario, run)


def pass_through(scenario: Scenario, run: Run, *blocks: Block) -> None:
    """A whole train passes the boundaries between the blocks given."""
    for block, target in pairwise(blocks):
        pass_boundary(scenario, run, block, target)


def roll(scenario: Scenario, run: Run) -> None:
    """The driver chooses the direction of the run, and the train begins to roll."""
    faces(scenario, run)
    overlap = scenario.site.layout.overlap[run.route]
    leavable = [(run, block) for block, target in _way_on(scenario, run).items() if target not in overlap]
    effect = {"track": {"rolling": came(run), "leavable": came(*leavable)}}
    scenario.does("start_rolling", effect, run=run)


def slip(scenario: Scenario, run: Run) -> None:
    """The train comes into its destination and brakes so late that it will slip: it may leave it for its overlap."""
    layout = scenario.site.layout
    last = layout.destination[run.route]
    effect: dict[str, Any] = {"track": {"slipping": came(run)}}
    if layout.way[run.route].get(last) in layout.overlap[run.route]:
        effect["track"]["leavable"] = came((run, last))
    scenario.does("overrun", effect, run=run)


def _way_on(scenario: Scenario, run: Run) -> dict[Block, Block]:
    """What of the way of a run the tail has not left, block by block."""
    left = scenario.system.units[run.train].orders[run].left
    way = scenario.site.layout.way[run.route]
    return {block: target for block, target in way.items() if block not in left and target not in left}


def faces(scenario: Scenario, run: Run) -> None:
    """The driver of a train at rest chooses the direction of a run, if the unit does not know it (T2)."""
    cab, train = head_cab(scenario, run), run.train
    unit, track = scenario.system.units[train], scenario.system.track
    if unit.leading == cab:
        return
    lists, orders = scenario.site.lists, unit.orders.items()
    anew = {
        other: {"expected": lists.first_tag[order.tag_list], "led_by": None}
        for other, order in orders
        if order.tag_list is not None and not order.begun and order.led_by is not None
    }
    told = {"leading": cab, "head_tag": None, "tail_read": None} | ({"orders": anew} if anew else {})
    effect: dict[str, Any] = {"units": {train: told}}
    if track.facing.get(train) != cab:
        passed = [(other, tag) for other, tag in track.passed if other == train]
        effect["track"] = {"facing": {train: cab}, "last_read": {train: GONE}, "passed": went(*passed)}
    scenario.does("change_ends", effect, train=train, cab=cab)


def rest(scenario: Scenario, run: Run) -> None:
    """The train comes to rest."""
    leavable = [(other, block) for other, block in scenario.system.track.leavable if other == run]
    effect = {"track": {"rolling": went(run), "slipping": went(run), "leavable": went(*leavable)}}
    scenario.does("come_to_rest", effect, run=run)


def pass_boundary(scenario: Scenario, run: Run, block: Block, target: Block) -> None:
    """A whole train passes a boundary: head reads, cars go over one after the other, tail reads."""
    head_passes(scenario, run, block, target)
    for car in in_order(scenario, run):
        crosses(scenario, run, car, block, target)
    tail_passes(scenario, run, block, target)


def crosses(scenario: Scenario, run: Run, car: Car, block: Block, target: Block) -> None:
    """A car passes a boundary from end to end."""
    enters(scenario, run, car, block, target)
    leaves(scenario, car, block)


def enters(scenario: Scenario, run: Run, car: Car, block: Block, target: Block) -> None:
    """The first axle of a car reaches the next block, unless it is there: the front one leads, the others follow."""
    if target in scenario.system.track.at[car]:
        return
    cars = in_order(scenario, run)
    there = [other for other in cars[: cars.index(car)] if target in scenario.system.track.at[other]]
    if there:
        follows(scenario, car, there[0], target)
        return
    effect = {"track": {"at": {car: came(target)}, "under": {car: {target: run}}, "run_into": came(run)}}
    scenario.does("car_moves", effect, run=run, car=car, block=block, target=target)


def follows(scenario: Scenario, car: Car, other: Car, target: Block) -> None:
    """The first axle of a car reaches a block that a car ahead of it is in."""
    effect = {
        "track": {"at": {car: came(target)}, "under": {car: {target: scenario.system.track.under[other][target]}}}
    }
    scenario.does("car_follows", effect, car=car, other=other, target=target)


def leaves(scenario: Scenario, car: Car, block: Block) -> None:
    """The last axle of a car leaves a block."""
    scenario.does("car_leaves", {"track": {"at": {car: went(block)}}}, car=car, block=block)


def in_order(scenario: Scenario, run: Run) -> list[Car]:
    """The cars of a train in the order in which they go."""
    ahead = scenario.site.formation.ahead[run]
    return sorted(ahead, key=lambda car: len(ahead[car]))


def head_passes(scenario: Scenario, run: Run, block: Block, target: Block) -> None:
    """The head reads the first tag of a boundary, comes into the next block, and reads the second there."""
    first, second = pair(scenario.site.layout, block, target, run.route)
    head_reads(scenario, run, first)
    enters(scenario, run, in_order(scenario, run)[0], block, target)
    head_reads(scenario, run, second)


def head_reads(scenario: Scenario, run: Run, tag: Tag) -> None:
    """The head reads the tag it must read next, in every run that is permitted and expects it."""
    layout, cab, train = scenario.site.layout, head_cab(scenario, run), run.train
    block = layout.tag_in[tag]
    orders: dict[Run, dict[str, Any]] = {}
    known_orders = scenario.system.units[train].orders
    begun_runs = [other.serial for other, known in known_orders.items() if known.begun]
    overtaken = {other for other in known_orders if any(serial > other.serial for serial in begun_runs)}
    on_the_way = any(
        expects(known, tag) and known.led_by is not None and other not in overtaken
        for other, known in known_orders.items()
    )
    for other, known in known_orders.items():
        changed: dict[str, Any] = {}
        begun, led_by = known.begun, known.led_by
        if expects(known, tag) and other not in overtaken and (led_by is not None or not on_the_way):
            begun, led_by = begun or tag != layout.first_tag[other.route], cab
            changed |= {"expected": layout.tag_after[other.route].get(tag), "led_by": cab}
            changed |= {"begun": True} if begun else {}
        if led_by == cab and begun and block in _beyond_start(layout, other.route):
            changed["entered"] = came(block)
        if changed:
            orders[other] = changed
    read = {"head_tag": tag, "occupied": came(block), "orders": orders}
    tail_read = scenario.system.units[train].tail_read
    if tail_read is not None and tag in (tail_read.tag, layout.partner[tail_read.tag]):
        read["tail_read"] = None
    beginning = _begin(scenario, train, tag)
    there = [
        (other, block)
        for other in scenario.system.track.begun | beginning
        if other.train == train
        and scenario.site.formation.front[other] == cab
        and block in _beyond_start(layout, other.route)
    ]
    passed = ((train, other) for other in (tag, layout.partner[tag]))
    track = {
        "begun": came(*beginning),
        "entered": came(*there),
        "last_read": {train: tag},
        "passed": went(*passed),
    }
    scenario.does("head_reads", {"units": {train: read}, "track": track}, train=train, cab=cab, tag=tag, in_window=True)


def _begin(scenario: Scenario, train: Train, tag: Tag) -> frozenset[Run]:
    """The runs that begin as the head reads this tag: it has read their first one last, and this one is their next."""
    layout, last_read = scenario.site.layout, scenario.system.track.last_read.get(train)
    if last_read is None:
        return frozenset()
    return frozenset(
        run
        for run in scenario.system.radio.permits
        if run.train == train
        and last_read == layout.first_tag.get(run.route)
        and layout.tag_after.get(run.route, {}).get(last_read) == tag
    )


def expects(order: Order, tag: Tag) -> bool:
    """Whether this is the tag that the head must read next under a run."""
    return order.permitted and not order.given_back and order.expected == tag


def _beyond_start(layout: Layout, route: Route) -> frozenset[Block]:
    """What a route claims beyond its start; nothing of a run that stands."""
    return layout.claims[route] - {layout.start[route]} if route in layout.claims else frozenset()


def tail_passes(scenario: Scenario, run: Run, block: Block, target: Block) -> None:
    """The tail reads both tags of a boundary, in order.

    The block is noted as left in every run under which the train was in it, and out of which its head has gone on or
    the train backs.
    """
    layout = scenario.site.layout
    first, second = pair(layout, block, target, run.route)
    tail_reads_first(scenario, run, first)
    event = tail_read(scenario, run, second)
    evidence = Evidence(genuine(scenario, first), event["read"])
    orders = scenario.system.units[run.train].orders
    noted = [
        other
        for other, order in orders.items()
        if order.begun
        and (block in order.entered or layout.start.get(other.route) == block)
        and (
            other.route not in layout.way
            or _has_gone_on(scenario, other, block, first, second)
            or _is_back(scenario, other, block)
        )
    ]
    front = scenario.site.formation.front
    led_so = [r for r in scenario.system.radio.permits if r.train == run.train and front[r] == front[run]]
    led_on = [
        r
        for r in led_so
        if layout.tag_after[r.route].get(first) == second
        and (r, layout.way[r.route].get(block)) in scenario.system.track.entered
    ]
    gone = [r for r in led_so if any(r.serial <= later.serial for later in led_on)]
    effect: dict[str, Any] = {
        "units": {
            run.train: {
                "tail_read": event["read"],
                "orders": {other: {"left": {block: evidence}} for other in noted},
            }
        },
        "track": {
            **({"behind": came(*((other, block) for other in noted))} if noted else {}),
            **({"gone": came(*((other, block) for other in gone))} if gone else {}),
            "passed": came((run.train, second)),
        },
    }
    if all(
        other in noted or other.route not in layout.way or block not in order.entered for other, order in orders.items()
    ):
        effect["units"][run.train]["occupied"] = went(block)
    scenario.does("tail_reads", effect, **event)


def _has_gone_on(scenario: Scenario, run: Run, block: Block, first: Tag, second: Tag) -> bool:
    """Whether the cab that leads has gone on over those tags on a run's way, or on a later one's."""
    unit, layout = scenario.system.units[run.train], scenario.site.layout
    return any(
        later.serial >= run.serial
        and order.led_by == unit.leading
        and layout.way.get(later.route, {}).get(block) in order.entered
        and layout.tag_after[later.route].get(first) == second
        for later, order in unit.orders.items()
    )


def _is_back(scenario: Scenario, run: Run, block: Block) -> bool:
    """Whether the train backs out of the block, and has backed out of what follows on the run's way."""
    unit, beyond = scenario.system.units[run.train], scenario.site.layout.way[run.route].get(block)
    order = unit.orders[run]
    return order.led_by != unit.leading and (beyond not in order.entered or beyond in order.left)


def tail_reads_first(scenario: Scenario, run: Run, tag: Tag) -> None:
    """The tail antenna reads a tag that alone proves nothing."""
    event = tail_read(scenario, run, tag)
    effect = {"units": {run.train: {"tail_read": event["read"]}}, "track": {"passed": came((run.train, tag))}}
    scenario.does("tail_reads", effect, **event)


def tail_read(scenario: Scenario, run: Run, tag: Tag) -> dict[str, Any]:
    """The event that the tail antenna, on the last car, reads a tag as it was laid."""
    last = scenario.site.formation.last[run]
    cab, read = scenario.site.formation.cab[last], genuine(scenario, tag)
    return {"run": run, "car": last, "cab": cab, "line": WHOLE, "read": read}


def head_cab(scenario: Scenario, run: Run) -> Cab:
    """The cab that leads in a run."""
    return scenario.site.formation.front[run]


def report(scenario: Scenario, run: Run, block: Block, target: Block) -> None:
    """The third loop: the report that the tail has left a block reaches the centre, which frees it."""
    event = reported(scenario, run, block, target)
    word = (run, block, event["left"], event["entered"])
    scenario.does("send_tail_report", {"radio": {"tail_reports": came(word)}}, **event)
    scenario.does("release_block", released(scenario, run, block), **event)


def reported(scenario: Scenario, run: Run, block: Block, target: Block) -> dict[str, Any]:
    """The event of a genuine tail report."""
    left, entered = (genuine(scenario, tag) for tag in pair(scenario.site.layout, block, target, run.route))
    return {"run": run, "block": block, "left": left, "entered": entered}


def released(scenario: Scenario, run: Run, block: Block) -> Changes:
    """What changes when a block is released on tail evidence: its claim ends, and its points go with it."""
    centre, layout = scenario.system.centre, scenario.site.layout
    points: Iterable[Point] = layout.points_in[block]
    if run.route in layout.routes:
        points = [point for point, place in layout.released_with[run.route].items() if place == block]
    return {
        "centre": {
            "runs": {run: {"ended": {block: Cause.TAIL_EVIDENCE}}},
            "claimed": {block: went(run)},
            "locked": {point: {run: GONE} for point in points if run in centre.locked.get(point, {})},
        }
    }


def stop(scenario: Scenario, run: Run) -> None:
    """The train tells that it stands in its destination, and the overlap is freed (T9)."""
    layout = scenario.site.layout
    effect = {"units": {run.train: {"orders": {run: {"stopped": True}}}}, "track": {"stood": came(run)}}
    scenario.does("note_stopped", effect, run=run, **INSIDE)
    scenario.does("send_stop", {"radio": {"stops": came(run)}}, run=run)
    overlap = layout.overlap[run.route]
    points = [point for point, place in layout.released_with[run.route].items() if place in overlap]
    freed: Mapping[str, Any] = {
        "runs": {run: {"ended": dict.fromkeys(overlap, Cause.STANDSTILL)}},
        "claimed": {block: went(run) for block in overlap},
        "locked": {point: {run: GONE} for point in points},
    }
    scenario.does("release_overlap", {"centre": freed}, run=run)


def genuine(scenario: Scenario, tag: Tag) -> Read:
    """What an antenna gets from a tag as it was laid."""
    return Read(tag, scenario.site.records.record[tag])


def pair(layout: Layout, block: Block, target: Block, route: Route = NO_ROUTE) -> tuple[Tag, Tag]:
    """Both tags of the boundary between two blocks, in running order; where there are two, of the one on the route."""
    firsts = [
        tag for tag, place in layout.tag_in.items() if place == block and layout.tag_in[layout.partner[tag]] == target
    ]
    after = layout.tag_after.get(route, {})
    first = next((tag for tag in firsts if after.get(tag) == layout.partner[tag]), firsts[0])
    return first, layout.partner[first]


def stands_in(scenario: Scenario, train: Train, *blocks: Block) -> None:
    """Say that the cars of a train are in just these blocks."""
    there = blocks_of(scenario, train)
    scenario.must(there == frozenset(blocks), f"{train} is in {blocks}: {there}")


def everything_is_free(scenario: Scenario) -> None:
    """Say that nothing is held but for trains that stand, where they stand, and nothing is lost but points below."""
    centre, layout = scenario.system.centre, scenario.site.layout
    held = {block: holders for block, holders in centre.claimed.items() if holders}
    at = {train: blocks_of(scenario, train) for train in layout.fleet}
    scenario.must(
        all(block in at[run.train] for block, holders in held.items() for run in holders),
        f"blocks are held only where their trains stand: {held}",
    )
    scenario.must(not centre.lost_blocks, f"no block is lost: {centre.lost_blocks}")
    scenario.must(
        all(grant.stage in (Stage.SET, Stage.STANDING) for _, grant in centre.runs.items()),
        "no run is open but those that trains stand under",
    )
