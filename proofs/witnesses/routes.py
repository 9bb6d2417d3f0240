"""Witnesses of route setting: reserve, prove, first loop, conflicts, cancellation (T4, T9, T10)."""

from __future__ import annotations

from kernel.names import Cause, Run, Stage
from kernel.refusal import Refusal
from models.simulator.senses import AT_REST
from proofs.witnesses.running import (
    enters,
    everything_is_free,
    head_passes,
    leaves,
    pass_through,
    report,
    rest,
    roll,
    run_through,
    stands_in,
    tail_passes,
)
from proofs.witnesses.scenario import Scenario, Steps
from proofs.witnesses.setting import (
    ask_back,
    at_stage,
    close_first_loop,
    echo,
    freed,
    holds,
    lay,
    locks,
    note_proved,
    offer,
    open_first_loop,
    order,
    permit,
    prove,
    prove_all,
    recall,
    reserve,
    retire,
    return_it,
    send_list,
    send_order,
    set_route,
    want_back,
)
from proofs.witnesses.stations import (
    A1,
    A2,
    B1,
    EAST,
    EAST_TO_ONE,
    EAST_TO_TWO,
    FACING_EAST,
    NORMAL,
    ONE,
    ONE_TO_EAST,
    OUTLET,
    P1,
    P2,
    REVERSE,
    T1,
    T2,
    THROAT,
    TWO,
    WEST,
    WEST_TO_ONE,
    WEST_TO_TWO,
    WEST_TO_TWO_SHIELDED,
    YARD_OUT,
    YARD_WEST,
)
from proofs.witnesses.telling import confirm, next_run, recovered

OPPOSITE = {**FACING_EAST, B1: frozenset({EAST})}
AWRY = {P1: REVERSE, P2: NORMAL}


def a_route_is_set_step_by_step(steps: Steps) -> Scenario:
    """From the request to the permit: no step before the one it needs (T4, T9, T10)."""
    scenario, runs = recovered(steps, FACING_EAST, AWRY)
    run = reserve(scenario, T1, WEST_TO_ONE, runs[T1])
    for block in (THROAT, ONE, OUTLET):
        holds(scenario, block, run)
    holds(scenario, WEST, runs[T1], run)
    scenario.refuses("open_first_loop", Refusal.POINTS_NOT_PROVED, run=run)
    scenario.refuses("send_confirmation", run=run, point=P1, position=NORMAL, detected=NORMAL, is_detected=True)
    order(scenario, run, P1)
    scenario.refuses("send_confirmation", run=run, point=P1, position=REVERSE, detected=REVERSE, is_detected=True)
    scenario.refuses("lock", point=P1, detected=REVERSE, is_detected=True)
    lay(scenario, run, P1)
    scenario.refuses("drift", point=P1, position=REVERSE)
    confirm(scenario, run, P1)
    note_proved(scenario, run, P1)
    scenario.refuses("open_first_loop", Refusal.POINTS_NOT_PROVED, run=run)
    prove(scenario, run, P2)
    scenario.refuses("send_offer", run=run)
    offer(scenario, run)
    scenario.refuses("send_permit", run=run)
    echo(scenario, run)
    scenario.refuses("start_rolling", run=run)
    permit(scenario, run)
    scenario.refuses("take_offer", run=run, tag_list=scenario.site.layout.tag_list[run.route])
    at_stage(scenario, run, Stage.SET)
    return scenario


def a_point_that_lies_right_is_only_relabelled(steps: Steps) -> Scenario:
    """A newer order for a point that lies right takes the lock id over and unlocks nothing (T10)."""
    scenario, runs = recovered(steps, OPPOSITE)
    first = reserve(scenario, T1, WEST_TO_TWO_SHIELDED, runs[T1])
    prove_all(scenario, first)
    scenario.does("withdraw", freed(scenario, first, Cause.WITHDRAWN), run=first)
    second = reserve(scenario, T1, WEST_TO_TWO, runs[T1])
    order(scenario, second, P1)
    scenario.must(not scenario.system.terminals[P1].unlocked, "the point stays locked")
    stale = {
        "run": first,
        "point": P1,
        "life": scenario.system.terminals[P1].life,
        "detected": REVERSE,
        "is_detected": True,
    }
    scenario.refuses("obey_order", **stale)
    confirm(scenario, second, P1)
    note_proved(scenario, second, P1)
    close_first_loop(scenario, second)
    return scenario


def a_point_whose_contacts_show_nothing_stays_locked(steps: Steps) -> Scenario:
    """An order that finds a locked point undetected is obeyed when it comes again; one that moves turns round (T10)."""
    scenario, runs = recovered(steps, OPPOSITE)
    first = reserve(scenario, T1, WEST_TO_TWO_SHIELDED, runs[T1])
    prove_all(scenario, first)
    scenario.does("withdraw", freed(scenario, first, Cause.WITHDRAWN), run=first)
    second = reserve(scenario, T1, WEST_TO_TWO, runs[T1])
    send_order(scenario, second, P1)
    undetected = {"point": P1, "life": scenario.system.terminals[P1].life, "detected": REVERSE, "is_detected": False}
    scenario.refuses("obey_order", run=second, **undetected)
    relabelled = {"terminals": {P1: {"holds": second}}}
    scenario.does("obey_order", relabelled, run=second, **undetected | {"is_detected": True})
    confirm(scenario, second, P1)
    scenario.does("withdraw", freed(scenario, second, Cause.WITHDRAWN), run=second)
    third = reserve(scenario, T1, WEST_TO_ONE, runs[T1])
    order(scenario, third, P1)
    scenario.must(scenario.system.terminals[P1].unlocked, "the point is thrown")
    scenario.does("withdraw", freed(scenario, third, Cause.WITHDRAWN), run=third)
    fourth = reserve(scenario, T1, WEST_TO_TWO, runs[T1])
    send_order(scenario, fourth, P1)
    effect = {"terminals": {P1: {"holds": fourth, "wanted": REVERSE}}}
    scenario.does("obey_order", effect, run=fourth, **undetected | {"detected": NORMAL})
    return scenario


def a_flank_point_is_held(steps: Steps) -> Scenario:
    """A point beside the route keeps others out as long as the block it shields is held (T9)."""
    scenario, runs = recovered(steps, OPPOSITE)
    run = set_route(scenario, T1, WEST_TO_TWO_SHIELDED, runs[T1])
    locks(scenario, P2, run)
    other = next_run(scenario, T2, EAST_TO_TWO)
    scenario.refuses("request", Refusal.BLOCK_HELD_FOR_ANOTHER, run=other, base=runs[T2])
    over = set_route(scenario, T2, EAST_TO_ONE, runs[T2])
    locks(scenario, P2, run, over)
    run_through(scenario, run, WEST, THROAT, TWO)
    report(scenario, run, WEST, THROAT)
    report(scenario, run, THROAT, TWO)
    locks(scenario, P1)
    locks(scenario, P2, run, over)
    return scenario


def a_block_too_close_is_refused(steps: Steps) -> Scenario:
    """A wagon in a block too close to a route obstructs it, and the other way round (T9)."""
    scenario, runs = recovered(steps, {**FACING_EAST, B1: frozenset({YARD_WEST})})
    shunt = set_route(scenario, T2, YARD_OUT, runs[T2])
    run = next_run(scenario, T1, WEST_TO_ONE)
    scenario.refuses("request", Refusal.FOULING_BLOCK_HELD, run=run, base=runs[T1])
    recall(scenario, shunt)
    return_it(scenario, shunt)
    run = reserve(scenario, T1, WEST_TO_ONE, runs[T1])
    again = next_run(scenario, T2, YARD_OUT)
    scenario.refuses("request", Refusal.FOULING_BLOCK_HELD, run=again, base=runs[T2])
    return scenario


def a_route_is_set_ahead(steps: Steps) -> Scenario:
    """The next route is set while the train still runs on the one before, and it runs through without a stop (T9)."""
    scenario, runs = recovered(steps, FACING_EAST)
    first = set_route(scenario, T1, WEST_TO_ONE, runs[T1])
    roll(scenario, first)
    head_passes(scenario, first, WEST, THROAT)
    enters(scenario, first, A1, WEST, THROAT)
    second = reserve(scenario, T1, ONE_TO_EAST, first)
    scenario.must(scenario.system.centre.runs[second].proved == {P2}, "the overlap's point counts as proved")
    close_first_loop(scenario, second)
    roll(scenario, second)
    enters(scenario, first, A2, WEST, THROAT)
    for car in (A1, A2):
        leaves(scenario, car, WEST)
    _through_on_two_runs(scenario, first, second)
    report(scenario, first, WEST, THROAT)
    report(scenario, first, THROAT, ONE)
    report(scenario, first, ONE, OUTLET)
    report(scenario, first, OUTLET, EAST)
    for block, target in ((ONE, OUTLET), (OUTLET, EAST)):
        report(scenario, second, block, target)
    report(scenario, runs[T1], WEST, THROAT)
    retire(scenario, first, runs[T1])
    holds(scenario, EAST, second)
    everything_is_free(scenario)
    return scenario


def _through_on_two_runs(scenario: Scenario, first: Run, second: Run) -> None:
    """The train, in the throat, runs on to the destination of the second run."""
    tail_passes(scenario, first, WEST, THROAT)
    pass_through(scenario, first, THROAT, ONE)
    rest(scenario, first)
    pass_through(scenario, second, ONE, OUTLET, EAST)
    rest(scenario, second)
    stands_in(scenario, T1, EAST)


def a_run_is_withdrawn(steps: Steps) -> Scenario:
    """A run is taken back before the train is told; after that it must be asked for (T9)."""
    scenario, runs = recovered(steps, FACING_EAST)
    run = reserve(scenario, T1, WEST_TO_ONE, runs[T1])
    scenario.refuses("cancel", run=run)
    scenario.does("withdraw", freed(scenario, run, Cause.WITHDRAWN), run=run)
    for block in (THROAT, ONE, OUTLET):
        holds(scenario, block)
    holds(scenario, WEST, runs[T1])
    retire(scenario, run)
    told = reserve(scenario, T1, WEST_TO_ONE, runs[T1])
    prove_all(scenario, told)
    offer(scenario, told)
    scenario.refuses("withdraw", run=told)
    at_stage(scenario, told, Stage.OFFERED)
    return scenario


def a_run_is_cancelled_before_its_permit(steps: Steps) -> Scenario:
    """A run that was only offered is given back; its permit, coming late, permits nothing (T9)."""
    scenario, runs = recovered(steps, FACING_EAST)
    run = reserve(scenario, T1, WEST_TO_ONE, runs[T1])
    prove_all(scenario, run)
    offer(scenario, run)
    echo(scenario, run)
    scenario.does("send_permit", run=run)
    recall(scenario, run)
    return_it(scenario, run)
    at_stage(scenario, run, Stage.OVER)
    scenario.refuses("take_permit", run=run)
    scenario.refuses("start_rolling", run=run)
    retire(scenario, run)
    return scenario


def a_run_is_wanted_back_before_its_tags_came(steps: Steps) -> Scenario:
    """A train can give back only what it knows: the list still goes to it, and then the recall (T9)."""
    scenario, runs = recovered(steps, FACING_EAST)
    run = reserve(scenario, T1, WEST_TO_ONE, runs[T1])
    prove_all(scenario, run)
    open_first_loop(scenario, run)
    want_back(scenario, run)
    ask_back(scenario, run)
    scenario.refuses("recall", run=run)
    send_list(scenario, run)
    return_it(scenario, run)
    retire(scenario, run)
    return scenario


def a_run_that_another_leads_on_from_is_kept(steps: Steps) -> Scenario:
    """With a run set ahead the nearer one is not asked back before it, nor a run set ahead from one asked back (T9)."""
    scenario, runs = recovered(steps, FACING_EAST)
    run = set_route(scenario, T1, WEST_TO_ONE, runs[T1])
    onward = set_route(scenario, T1, ONE_TO_EAST, run)
    scenario.refuses("cancel", Refusal.A_RUN_LEADS_ON, run=run)
    recall(scenario, onward)
    return_it(scenario, onward)
    recall(scenario, run)
    wanted = next_run(scenario, T1, ONE_TO_EAST)
    scenario.refuses("request", Refusal.START_WANTED_BACK, run=wanted, base=run)
    return_it(scenario, run)
    at_stage(scenario, run, Stage.OVER)
    return scenario


def a_begun_run_that_was_wanted_back_leads_on(steps: Steps) -> Scenario:
    """Once its tail has left where it stood a train keeps its run, whoever asked for it, and is led on from it (T9)."""
    scenario, runs = recovered(steps, FACING_EAST)
    run = set_route(scenario, T1, WEST_TO_ONE, runs[T1])
    roll(scenario, run)
    recall(scenario, run)
    pass_through(scenario, run, WEST, THROAT, ONE)
    rest(scenario, run)
    onward = next_run(scenario, T1, ONE_TO_EAST)
    scenario.refuses("request", Refusal.START_WANTED_BACK, run=onward, base=run)
    report(scenario, run, WEST, THROAT)
    reserve(scenario, T1, ONE_TO_EAST, run)
    return scenario


def a_train_on_its_way_keeps_its_run(steps: Steps) -> Scenario:
    """Approach locking: asked to give back a run it rolls into, a train does not, and nothing is freed (T9)."""
    scenario, runs = recovered(steps, FACING_EAST)
    run = set_route(scenario, T1, WEST_TO_ONE, runs[T1])
    roll(scenario, run)
    recall(scenario, run)
    scenario.refuses("send_permit", run=next_run(scenario, T1, WEST_TO_ONE))
    scenario.does("recall", {"units": {T1: {"orders": {run: {"recalled": True}}}}}, run=run)
    scenario.refuses("give_back", run=run, at=AT_REST, held_end_mm=1, start_end_mm=0)
    scenario.refuses("give_back", run=run, at=AT_REST, held_end_mm=0, start_end_mm=0)
    scenario.refuses("start_rolling", run=run)
    head_passes(scenario, run, WEST, THROAT)
    rest(scenario, run)
    scenario.refuses("recall", run=run)
    scenario.refuses("give_back", run=run, at=AT_REST, held_end_mm=0, start_end_mm=0)
    scenario.refuses("send_return", run=run)
    scenario.refuses("note_given_back", run=run)
    at_stage(scenario, run, Stage.SET)
    holds(scenario, ONE, run)
    return scenario
