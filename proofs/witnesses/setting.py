"""Setting a route, in the steps it takes, and taking it back (T4, T9, T10)."""

from __future__ import annotations

from kernel.centre import Grant
from kernel.names import Block, Cause, Point, Route, Run, Stage, TagList, Train
from kernel.unit import Order
from models.simulator.senses import AT_REST
from proofs.witnesses.changes import GONE, Changes, came, went
from proofs.witnesses.scenario import Scenario
from proofs.witnesses.telling import confirm, next_run


def set_route(scenario: Scenario, train: Train, route: Route, base: Run) -> Run:
    """A route is reserved, its points proved, the first loop closed and entry permitted."""
    run = reserve(scenario, train, route, base)
    prove_all(scenario, run)
    close_first_loop(scenario, run)
    return run


def reserve(scenario: Scenario, train: Train, route: Route, base: Run) -> Run:
    """A route is requested and granted: blocks and points are held from now on."""
    centre, layout = scenario.system.centre, scenario.site.layout
    run, needs = next_run(scenario, train, route), layout.needs[route]
    below = frozenset(point for point in needs if base in centre.locked.get(point, {}))
    effect = {
        "centre": {
            "newest": run.serial,
            "runs": {run: Grant(Stage.RESERVED, below, False, {})},
            "claimed": {block: came(run) for block in layout.claims[route]},
            "locked": {point: {run: lies} for point, lies in needs.items()},
        }
    }
    scenario.does("request", effect, run=run, base=base)
    return run


def prove_all(scenario: Scenario, run: Run) -> None:
    """Every point that is not yet proved is."""
    needs, proved = scenario.site.layout.needs[run.route], scenario.system.centre.runs[run].proved
    for point in sorted(frozenset(needs) - proved):
        prove(scenario, run, point)


def prove(scenario: Scenario, run: Run, point: Point) -> None:
    """A point is ordered by way of the train, laid, locked and confirmed the same way back."""
    order(scenario, run, point)
    lay(scenario, run, point)
    confirm(scenario, run, point)
    note_proved(scenario, run, point)


def send_order(scenario: Scenario, run: Run, point: Point) -> None:
    """The order for a point comes to its terminal."""
    life = scenario.system.terminals[point].life
    event = {"run": run, "point": point, "life": life}
    scenario.does("send_order", {"radio": {"orders": came((run, point, life))}}, **event)
    scenario.does("relay_order", {"radio": {"relayed_orders": came((run, point, life))}}, **event)


def order(scenario: Scenario, run: Run, point: Point) -> None:
    """The order for a point comes to its terminal and is obeyed."""
    send_order(scenario, run, point)
    life, lies = scenario.system.terminals[point].life, scenario.system.track.lies[point]
    wanted = scenario.site.layout.needs[run.route][point]
    free = scenario.system.terminals[point].unlocked or lies != wanted
    effect = {"terminals": {point: {"holds": run, "wanted": wanted, "unlocked": free}}}
    scenario.does("obey_order", effect, run=run, point=point, life=life, detected=lies, is_detected=True)


def lay(scenario: Scenario, run: Run, point: Point) -> None:
    """A point that was unlocked is thrown as wanted and locked."""
    wanted = scenario.site.layout.needs[run.route][point]
    if scenario.system.track.lies[point] != wanted:
        scenario.does("drift", {"track": {"lies": {point: wanted}}}, point=point, position=wanted)
    if scenario.system.terminals[point].unlocked:
        scenario.does(
            "lock", {"terminals": {point: {"unlocked": False}}}, point=point, detected=wanted, is_detected=True
        )


def note_proved(scenario: Scenario, run: Run, point: Point) -> None:
    """The confirmation comes to the centre."""
    lies = scenario.system.track.lies[point]
    effect = {"centre": {"runs": {run: {"proved": came(point)}}}}
    scenario.does("note_confirmation", effect, run=run, point=point, position=lies)


def close_first_loop(scenario: Scenario, run: Run) -> None:
    """List, echo, permit."""
    offer(scenario, run)
    echo(scenario, run)
    permit(scenario, run)


def offer(scenario: Scenario, run: Run) -> None:
    """The points are proved, and the list comes to the train."""
    open_first_loop(scenario, run)
    send_list(scenario, run)


def open_first_loop(scenario: Scenario, run: Run) -> None:
    """The centre finds every point proved."""
    scenario.does("open_first_loop", {"centre": {"runs": {run: {"stage": Stage.OFFERED}}}}, run=run)


def send_list(scenario: Scenario, run: Run) -> None:
    """The list comes to the train."""
    scenario.does("send_offer", {"radio": {"offers": came(run)}}, run=run)
    keep(scenario, run, scenario.site.layout.tag_list[run.route])


def keep(scenario: Scenario, run: Run, tag_list: TagList) -> None:
    """The unit keeps this list of the route."""
    taken = Order(
        tag_list=tag_list,
        permitted=False,
        recalled=False,
        given_back=False,
        begun=False,
        stopped=False,
        expected=scenario.site.lists.first_tag[tag_list],
        entered=frozenset(),
        led_by=None,
        left={},
    )
    scenario.does("take_offer", {"units": {run.train: {"orders": {run: taken}}}}, run=run, tag_list=tag_list)


def echo(scenario: Scenario, run: Run) -> None:
    """The same list comes back, and the run is set."""
    tag_list = scenario.site.layout.tag_list[run.route]
    scenario.does("send_echo", {"radio": {"echoes": {run: tag_list}}}, run=run, tag_list=tag_list)
    scenario.does("note_echo", {"centre": {"runs": {run: {"stage": Stage.SET}}}}, run=run)


def permit(scenario: Scenario, run: Run) -> None:
    """The train is told that the route is complete."""
    scenario.does("send_permit", {"radio": {"permits": came(run)}}, run=run)
    scenario.does("take_permit", {"units": {run.train: {"orders": {run: {"permitted": True}}}}}, run=run)


def recall(scenario: Scenario, run: Run) -> None:
    """The centre asks the train to give a run back."""
    want_back(scenario, run)
    ask_back(scenario, run)


def want_back(scenario: Scenario, run: Run) -> None:
    """The signaller wants a run back."""
    scenario.does("cancel", {"centre": {"runs": {run: {"cancelling": True}}}}, run=run)


def ask_back(scenario: Scenario, run: Run) -> None:
    """The train is asked for it."""
    scenario.does("send_recall", {"radio": {"recalls": came(run)}}, run=run)


def return_it(scenario: Scenario, run: Run) -> None:
    """The recall comes, the brake holds the end before the run, the train gives it back, and the centre frees it."""
    scenario.does("recall", {"units": {run.train: {"orders": {run: {"recalled": True}}}}}, run=run)
    scenario.refuses("send_return", run=run)
    give_back(scenario, run)
    scenario.does("send_return", {"radio": {"returns": came(run)}}, run=run)
    scenario.does("note_given_back", freed(scenario, run, Cause.CANCELLED), run=run)


def give_back(scenario: Scenario, run: Run) -> None:
    """The brake holds the end of the block that the run starts in, and the train gives the run back."""
    scenario.refuses("give_back", run=run, at=AT_REST, held_end_mm=100_001, start_end_mm=100_000)
    given = {"units": {run.train: {"orders": {run: {"given_back": True}}}}}
    scenario.does("give_back", given, run=run, at=AT_REST, held_end_mm=100_000, start_end_mm=100_000)


def freed(scenario: Scenario, run: Run, cause: Cause) -> Changes:
    """What changes when a run of a route ends at once."""
    layout = scenario.site.layout
    held = [block for block in layout.claims[run.route] if run in scenario.system.centre.claimed[block]]
    return {
        "centre": {
            "runs": {run: {"stage": Stage.OVER, "ended": dict.fromkeys(held, cause)}},
            "claimed": {block: went(run) for block in held},
            "locked": {point: {run: GONE} for point in layout.needs[run.route]},
        }
    }


def retire(scenario: Scenario, *runs: Run) -> None:
    """The centre forgets runs that hold nothing."""
    for run in runs:
        scenario.does("retire", {"centre": {"runs": {run: GONE}}}, run=run)


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
