"""Longer moves of a scenario, each in the steps it takes: telling where a train stands, setting a route, running it."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from itertools import pairwise

from kernel.layout import Layout
from kernel.names import Antenna, Block, Car, Point, Position, Read, Route, Run, Serial, Stage, Tag, Train, UnitLife
from proofs.witnesses.scenario import Scenario, Steps
from proofs.witnesses.stations import NO_ROUTE, PASSING_PLACE, site_of, standing_at


def opened(
    steps: Steps,
    at: Mapping[Car, frozenset[Block]],
    lies: Mapping[Point, Position] | None = None,
    station: str = PASSING_PLACE,
) -> Scenario:
    """A scenario at its start: trains where they are, nothing known."""
    site = site_of(station)
    return Scenario(steps, site, standing_at(site, at, lies or {}))


def recovered(
    steps: Steps,
    at: Mapping[Car, frozenset[Block]],
    lies: Mapping[Point, Position] | None = None,
    station: str = PASSING_PLACE,
) -> tuple[Scenario, Mapping[Train, Run]]:
    """A scenario in which every train has told where it stands, and nothing is lost but points below trains."""
    scenario = opened(steps, at, lies, station)
    runs = all_tell(scenario)
    hear_terminals(scenario)
    recover(scenario)
    return scenario, runs


def blocks_of(scenario: Scenario, train: Train) -> frozenset[Block]:
    """The blocks that the cars of a train are in."""
    at, train_of = scenario.system.track.at, scenario.site.formation.train_of
    return frozenset(block for car in at if train_of[car] == train for block in at[car])


def next_run(scenario: Scenario, train: Train, route: Route, life: UnitLife | None = None) -> Run:
    """A run with the next serial, for the life the train's unit is in."""
    lives = scenario.system.units[train].life if life is None else life
    return Run(Serial(scenario.system.centre.newest + 1), train, lives, route)


# ---- telling where everything is


def all_tell(scenario: Scenario) -> Mapping[Train, Run]:
    """The centre asks, every train answers; the runs that stand for them."""
    return {train: tell(scenario, train) for train in sorted(scenario.site.layout.fleet)}


def tell(scenario: Scenario, train: Train) -> Run:
    """A train at rest begins a new life, tells where it stands, is taken at its word and told so (T8)."""
    told = answer(scenario, train)
    run = next_run(scenario, train, NO_ROUTE)
    scenario.does("note_standing", train=train, life=told, epoch=scenario.system.centre.epoch, run=run)
    scenario.does("send_standing_run", run=run)
    scenario.does("take_standing", run=run)
    return run


def answer(scenario: Scenario, train: Train) -> UnitLife:
    """A train at rest answers this epoch's challenge in a new life; the answer is on its way."""
    epoch = scenario.system.centre.epoch
    if epoch not in scenario.system.radio.challenges:
        scenario.does("send_challenge", epoch=epoch)
    life = UnitLife(scenario.system.units[train].life + 1)
    blocks = blocks_of(scenario, train)
    scenario.does("answer", train=train, epoch=epoch, life=life, blocks=blocks, at_rest=True, healthy=True)
    scenario.does("send_standing", train=train, epoch=epoch)
    return life


def hear_terminals(scenario: Scenario) -> None:
    """Every terminal tells which life it is in (T10)."""
    for point in sorted(scenario.site.layout.points):
        hear_terminal(scenario, point)


def hear_terminal(scenario: Scenario, point: Point) -> None:
    """A terminal tells which life it is in (T10)."""
    life = scenario.system.terminals[point].life
    if (point, life) not in scenario.system.radio.terminal_lives:
        scenario.does("send_terminal_life", point=point)
    scenario.does("note_terminal_life", point=point, life=life)


def recover(scenario: Scenario) -> None:
    """Every lost block is found again, and every lost point that no train is held over (T8)."""
    centre, layout = scenario.system.centre, scenario.site.layout
    for block in sorted(centre.lost_blocks):
        scenario.does("recover_block", block=block)
    for point in sorted(centre.lost_points):
        if not centre.claimed.get(layout.stands_in[point], frozenset()):
            scenario.does("recover_point", point=point)


def adopt(scenario: Scenario, run: Run, point: Point) -> None:
    """The centre learns how a lost point lies, by way of the train that stands over it (T8, T10)."""
    life, lies = scenario.system.terminals[point].life, scenario.system.track.lies[point]
    scenario.does("send_enquiry", run=run, point=point, life=life)
    scenario.does("relay_enquiry", run=run, point=point, life=life)
    scenario.does("answer_enquiry", run=run, point=point, life=life)
    scenario.does("send_confirmation", run=run, point=point, position=lies, detected=lies)
    scenario.does("relay_confirmation", run=run, point=point, position=lies)
    scenario.does("adopt_point", run=run, point=point, position=lies)


# ---- setting a route


def set_route(scenario: Scenario, train: Train, route: Route, base: Run) -> Run:
    """A route is reserved, its points proved, the first loop closed and entry permitted (T4)."""
    run = reserve(scenario, train, route, base)
    for point in sorted(points_to_prove(scenario, run)):
        prove(scenario, run, point)
    close_first_loop(scenario, run)
    return run


def reserve(scenario: Scenario, train: Train, route: Route, base: Run) -> Run:
    """A route is requested and granted (T9)."""
    run = next_run(scenario, train, route)
    scenario.does("request", run=run, base=base)
    return run


def points_to_prove(scenario: Scenario, run: Run) -> frozenset[Point]:
    """The points of a run that are not yet proved for it."""
    return frozenset(scenario.site.layout.needs[run.route]) - scenario.system.centre.runs[run].proved


def prove(scenario: Scenario, run: Run, point: Point) -> None:
    """A point is ordered by way of the train, laid, locked and confirmed the same way back (T10)."""
    order(scenario, run, point)
    lay(scenario, run, point)
    confirm(scenario, run, point)


def order(scenario: Scenario, run: Run, point: Point) -> None:
    """The order for a point goes to its terminal and is obeyed (T10)."""
    life = scenario.system.terminals[point].life
    scenario.does("send_order", run=run, point=point, life=life)
    scenario.does("relay_order", run=run, point=point, life=life)
    lies = scenario.system.track.lies[point]
    scenario.does("obey_order", run=run, point=point, life=life, detected=lies)


def lay(scenario: Scenario, run: Run, point: Point) -> None:
    """A point that was unlocked is thrown as wanted and locked (T10)."""
    wanted = scenario.site.layout.needs[run.route][point]
    if scenario.system.track.lies[point] != wanted:
        scenario.does("drift", point=point, position=wanted)
    if scenario.system.terminals[point].unlocked:
        scenario.does("lock", point=point, detected=wanted)


def confirm(scenario: Scenario, run: Run, point: Point) -> None:
    """The terminal's confirmation reaches the centre by way of the train (T10)."""
    lies = scenario.system.track.lies[point]
    scenario.does("send_confirmation", run=run, point=point, position=lies, detected=lies)
    scenario.does("relay_confirmation", run=run, point=point, position=lies)
    scenario.does("note_confirmation", run=run, point=point, position=lies)


def close_first_loop(scenario: Scenario, run: Run) -> None:
    """List, echo, permit (T4)."""
    offer(scenario, run)
    for step in ("send_echo", "note_echo", "send_permit", "take_permit"):
        scenario.does(step, run=run)


def offer(scenario: Scenario, run: Run) -> None:
    """The list reaches the train (T4)."""
    for step in ("open_first_loop", "send_offer", "take_offer"):
        scenario.does(step, run=run)


# ---- running


def run_through(scenario: Scenario, run: Run, blocks: Iterable[Block]) -> None:
    """A whole train runs through the blocks given, the first being where it stands, and reports what it left."""
    scenario.does("start_rolling", run=run)
    for block, target in pairwise(blocks):
        pass_boundary(scenario, run, block, target)
    scenario.does("come_to_rest", run=run)


def pass_boundary(scenario: Scenario, run: Run, block: Block, target: Block) -> None:
    """A whole train passes a boundary: head reads, cars go over one after the other, tail reads, the report."""
    cars = in_order(scenario, run)
    head_passes(scenario, run, block, target)
    for car in cars:
        scenario.does("car_moves", run=run, car=car, block=block, target=target)
        scenario.does("car_leaves", car=car, block=block)
    tail_passes(scenario, run, block, target)


def in_order(scenario: Scenario, run: Run) -> list[Car]:
    """The cars of a train in the order in which they go."""
    ahead = scenario.site.formation.ahead[run]
    return sorted(ahead, key=lambda car: len(ahead[car]))


def head_passes(scenario: Scenario, run: Run, block: Block, target: Block) -> None:
    """The head reads both tags of a boundary, in order and in their windows (T5)."""
    for tag in pair(scenario.site.layout, block, target):
        scenario.does("head_reads", train=run.train, tag=tag, in_window=True)


def tail_passes(scenario: Scenario, run: Run, block: Block, target: Block) -> None:
    """The tail reads both tags of a boundary, in order (T2)."""
    for tag in pair(scenario.site.layout, block, target):
        tail_reads(scenario, run, tag)


def tail_reads(scenario: Scenario, run: Run, tag: Tag) -> None:
    """The tail antenna, on the last car, reads a tag (T2)."""
    last = scenario.site.formation.last[run]
    read = genuine(scenario, tag)
    scenario.does("tail_reads", run=run, car=last, antenna=Antenna.TAIL, healthy=True, read=read)


def report(scenario: Scenario, run: Run, block: Block, target: Block) -> None:
    """The third loop: the report that the tail has left a block reaches the centre, which frees it (T6)."""
    left, entered = (genuine(scenario, tag) for tag in pair(scenario.site.layout, block, target))
    event = {"run": run, "block": block, "left": left, "entered": entered}
    scenario.does("send_tail_report", **event)
    scenario.does("release_block", **event)


def genuine(scenario: Scenario, tag: Tag) -> Read:
    """What an antenna gets from a tag as it was laid."""
    return Read(tag, scenario.site.records.record[tag])


def pair(layout: Layout, block: Block, target: Block) -> tuple[Tag, Tag]:
    """Both tags of the boundary between two blocks, in running order."""
    first = next(
        tag for tag, place in layout.tag_in.items() if place == block and layout.tag_in[layout.partner[tag]] == target
    )
    return first, layout.partner[first]


# ---- saying


def holds(scenario: Scenario, block: Block, *runs: Run) -> None:
    """Say that a block is held for just these runs."""
    held = scenario.system.centre.claimed.get(block, frozenset())
    scenario.must(held == frozenset(runs), f"{block} is held for {runs}: {held}")


def locks(scenario: Scenario, point: Point, *runs: Run) -> None:
    """Say that a point is locked for just these runs."""
    held = scenario.system.centre.locked.get(point, {})
    scenario.must(frozenset(held) == frozenset(runs), f"{point} is locked for {runs}: {held}")


def at_stage(scenario: Scenario, run: Run, stage: Stage) -> None:
    """Say how far a run has come."""
    grant = scenario.system.centre.runs.get(run)
    scenario.must(grant is not None and grant.stage == stage, f"{run} is {stage}: {grant}")


def stands_in(scenario: Scenario, train: Train, *blocks: Block) -> None:
    """Say that the cars of a train are in just these blocks."""
    there = blocks_of(scenario, train)
    scenario.must(there == frozenset(blocks), f"{train} is in {blocks}: {there}")
