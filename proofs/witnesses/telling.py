"""Where everything is: openings of scenarios, trains that tell where they stand, terminals, recovery (T8)."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

from kernel.centre import Grant
from kernel.machine.centre import NO_ROUTE
from kernel.names import Block, Car, Cause, Point, Position, Route, Run, Serial, Stage, Train, UnitLife
from kernel.restarts import restart_unit
from kernel.unit import Order
from models.simulator.senses import AT_REST, WHOLE
from proofs.witnesses.changes import GONE, Changes, came, went
from proofs.witnesses.scenario import Scenario, Steps
from proofs.witnesses.stations import B1, PASSING_PLACE, PLATFORM_2, YARD_EAST, site_of, standing_at

At = Mapping[Car, frozenset[Block]]
Lies = Mapping[Point, Position]


def opened(steps: Steps, at: At, lies: Lies | None = None, station: str = PASSING_PLACE) -> Scenario:
    """A scenario at its start: trains where they are, nothing known; the second is out of the way if not placed."""
    site = site_of(station)
    away = {B1: frozenset({YARD_EAST if station == PASSING_PLACE else PLATFORM_2})}
    return Scenario(steps, site, standing_at(site, {**away, **at}, lies or {}))


def recovered(
    steps: Steps, at: At, lies: Lies | None = None, station: str = PASSING_PLACE
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


def all_tell(scenario: Scenario) -> Mapping[Train, Run]:
    """The centre asks, every train answers; the runs that stand for them."""
    return {train: tell(scenario, train) for train in sorted(scenario.site.layout.fleet)}


def tell(scenario: Scenario, train: Train) -> Run:
    """A train at rest begins a new life, tells where it stands, is taken at its word and told so."""
    life = answer(scenario, train)
    run = next_run(scenario, train, NO_ROUTE)
    take_word(scenario, train, life, run)
    tell_back(scenario, run)
    return run


def answer(scenario: Scenario, train: Train, said: frozenset[Block] | None = None) -> UnitLife:
    """A train at rest answers this epoch's challenge in a new life, and truly if not as ``said``; it is on its way."""
    epoch, blocks = scenario.system.centre.epoch, blocks_of(scenario, train) if said is None else said
    if epoch not in scenario.system.radio.challenges:
        scenario.does("send_challenge", {"radio": {"challenges": came(epoch)}}, epoch=epoch)
    life = UnitLife(scenario.system.units[train].life + 1)
    reborn = replace(restart_unit(scenario.system.units[train], life), answered=epoch, standing_in=blocks)
    reborn = replace(reborn, leading=scenario.system.units[train].leading, occupied=blocks)
    event = {"train": train, "epoch": epoch, "life": life, "blocks": blocks, "at": AT_REST, "line": WHOLE}
    scenario.does("answer", {"units": {train: reborn}}, **event)
    told = {"radio": {"standings": {(train, life, epoch): blocks}}}
    scenario.does("send_standing", told, train=train, epoch=epoch)
    return life


def take_word(scenario: Scenario, train: Train, life: UnitLife, run: Run) -> None:
    """The centre takes a train at its word."""
    effect = accounted(scenario, run, blocks_of(scenario, train), Cause.RECOVERED)
    scenario.does("note_standing", effect, train=train, life=life, epoch=scenario.system.centre.epoch, run=run)


def accounted(scenario: Scenario, run: Run, blocks: frozenset[Block], cause: Cause) -> dict[str, Any]:
    """What changes when the centre knows that the train of ``run`` stands in ``blocks`` and nowhere else."""
    centre, layout, track = scenario.system.centre, scenario.site.layout, scenario.system.track
    own = frozenset(other for other in centre.runs if other.train == run.train)
    held = {block: holders for block, holders in centre.claimed.items() if holders & own}
    cars = [car for car in track.at if scenario.site.formation.train_of[car] == run.train]
    over: dict[Run, Any] = {
        other: {"stage": Stage.OVER, "ended": {block: cause for block in held if other in held[block]}} for other in own
    }
    return {
        "centre": {
            "newest": run.serial,
            "accounted": {run.train: run.life},
            "runs": over | {run: Grant(Stage.STANDING, frozenset(), False, {})},
            "claimed": {
                block: centre.claimed.get(block, frozenset()) - own | ({run} if block in blocks else frozenset())
                for block in {*held, *blocks}
            },
            "locked": {point: dict.fromkeys(own & frozenset(by), GONE) for point, by in centre.locked.items()},
            "lost_points": came(*(point for point in layout.points if layout.stands_in[point] in blocks)),
        },
        "track": {
            "under": {
                car: dict.fromkeys(track.under.get(car, {}), GONE) | dict.fromkeys(track.at[car], run) for car in cars
            }
        },
    }


def tell_back(scenario: Scenario, run: Run) -> None:
    """The centre tells the train under which run it stands."""
    scenario.does("send_standing_run", {"radio": {"standing_runs": came(run)}}, run=run)
    stands = Order(
        tag_list=None,
        permitted=False,
        recalled=False,
        given_back=True,
        begun=True,
        stopped=True,
        expected=None,
        entered=scenario.system.units[run.train].standing_in,
        led_by=None,
        left={},
    )
    scenario.does("take_standing", {"units": {run.train: {"orders": {run: stands}}}}, run=run)


def hear_terminals(scenario: Scenario) -> None:
    """Every terminal tells which life it is in (T10)."""
    for point in sorted(scenario.site.layout.points):
        hear_terminal(scenario, point)


def hear_terminal(scenario: Scenario, point: Point) -> None:
    """A terminal tells which life it is in (T10)."""
    life = scenario.system.terminals[point].life
    if (point, life) not in scenario.system.radio.terminal_lives:
        scenario.does("send_terminal_life", {"radio": {"terminal_lives": came((point, life))}}, point=point)
    effect = {"centre": {"terminal_life": {point: life}}}
    scenario.does("note_terminal_life", effect, point=point, life=life)


def recover(scenario: Scenario) -> None:
    """Every lost block is found again, and every lost point that no train is held over."""
    centre, layout = scenario.system.centre, scenario.site.layout
    for block in sorted(centre.lost_blocks):
        scenario.does("recover_block", {"centre": {"lost_blocks": went(block)}}, block=block)
    for point in sorted(centre.lost_points):
        if not centre.claimed.get(layout.stands_in[point], frozenset()):
            scenario.does("recover_point", {"centre": {"lost_points": went(point)}}, point=point)


def adopt(scenario: Scenario, run: Run, point: Point) -> None:
    """The centre learns how a lost point lies, by way of the train that stands over it (T8, T10)."""
    life, lies = scenario.system.terminals[point].life, scenario.system.track.lies[point]
    enquiry = {"run": run, "point": point, "life": life}
    scenario.does("send_enquiry", {"radio": {"enquiries": came((run, point, life))}}, **enquiry)
    scenario.does("relay_enquiry", {"radio": {"relayed_enquiries": came((run, point, life))}}, **enquiry)
    scenario.does("answer_enquiry", {"terminals": {point: {"holds": run, "wanted": None}}}, **enquiry)
    confirm(scenario, run, point)
    effect = {"centre": {"lost_points": went(point), "locked": {point: {run: lies}}}}
    scenario.does("adopt_point", effect, run=run, point=point, position=lies)


def confirm(scenario: Scenario, run: Run, point: Point) -> None:
    """The terminal's word that a point is locked for a run goes out, and on by way of the train (T10)."""
    lies = scenario.system.track.lies[point]
    word: Changes = {"confirmed": came((run, point, lies))}
    scenario.does(
        "send_confirmation", {"radio": word}, run=run, point=point, position=lies, detected=lies, is_detected=True
    )
    effect = {"radio": {"confirmations": came((run, point, lies))}}
    scenario.does("relay_confirmation", effect, run=run, point=point, position=lies)
