"""Witnesses of what is refused, and of the reason given (T8, T9)."""

from __future__ import annotations

from dataclasses import replace

from kernel.machine.centre import NO_ROUTE
from kernel.names import Block, Epoch, Route, Serial, Train, UnitLife
from kernel.refusal import Refusal
from models.simulator.senses import AT_REST, BROKEN, NOT_HELD, ROLLING, WHOLE
from proofs.witnesses.running import reported, run_through
from proofs.witnesses.scenario import Scenario, Steps
from proofs.witnesses.setting import prove_all, reserve, set_route
from proofs.witnesses.stations import (
    B1,
    EAST,
    FACING_EAST,
    NORMAL,
    ONE,
    ONE_TO_EAST,
    OUTLET,
    P1,
    P2,
    PASSING_PLACE,
    REVERSE,
    T1,
    T2,
    THROAT,
    WEST,
    WEST_TO_ONE,
    WEST_TO_TWO,
    YARD_EAST,
    YARD_GATE,
    site_of,
    standing_at,
)
from proofs.witnesses.telling import (
    all_tell,
    answer,
    blocks_of,
    hear_terminals,
    next_run,
    opened,
    recover,
    recovered,
    take_word,
    tell,
)


def a_request_is_refused_with_its_reason(steps: Steps) -> Scenario:
    """An unknown route, an old number, a start not secured, not held or run through, a point wanted otherwise (T9)."""
    scenario, runs = recovered(steps, {**FACING_EAST, B1: frozenset({EAST})})
    base, run = runs[T1], next_run(scenario, T1, WEST_TO_ONE)
    unknown = run._replace(route=Route("to nowhere"))
    scenario.refuses("request", Refusal.UNKNOWN_ROUTE, run=unknown, base=base)
    old = run._replace(serial=scenario.system.centre.newest)
    scenario.refuses("request", Refusal.SERIAL_NOT_NEW, run=old, base=base)
    last = run._replace(serial=scenario.site.layout.last_serial)
    scenario.refuses("request", Refusal.SERIALS_EXHAUSTED, run=last, base=base)
    reborn = run._replace(life=UnitLife(run.life + 1))
    scenario.refuses("request", Refusal.TRAIN_NOT_ACCOUNTED_FOR, run=reborn, base=base)
    scenario.refuses("request", Refusal.START_NOT_SECURED, run=run, base=unknown)
    scenario.refuses("request", Refusal.START_NOT_HELD, run=run, base=runs[T2])
    elsewhere = next_run(scenario, T1, ONE_TO_EAST)
    scenario.refuses("request", Refusal.START_NOT_HELD, run=elsewhere, base=base)
    held = reserve(scenario, T1, WEST_TO_ONE, base)
    ahead = next_run(scenario, T1, ONE_TO_EAST)
    scenario.refuses("request", Refusal.START_NOT_SECURED, run=ahead, base=held)
    otherwise = next_run(scenario, T1, WEST_TO_TWO)
    scenario.refuses("request", Refusal.POINT_LOCKED_OTHERWISE, run=otherwise, base=base)
    again = next_run(scenario, T1, WEST_TO_ONE)
    scenario.refuses("request", Refusal.START_IS_RUN_THROUGH, run=again, base=base)
    return scenario


def what_is_still_lost_is_refused(steps: Steps) -> Scenario:
    """A block, a block too close and a point that are lost: each is found again before a route is set (T8)."""
    scenario = opened(steps, FACING_EAST)
    runs = all_tell(scenario)
    hear_terminals(scenario)
    ask = {"run": next_run(scenario, T1, WEST_TO_ONE), "base": runs[T1]}
    scenario.refuses("request", Refusal.BLOCK_LOST, **ask)
    for block in (WEST, THROAT, ONE, OUTLET):
        scenario.does("recover_block", block=block)
    scenario.refuses("request", Refusal.FOULING_BLOCK_LOST, **ask)
    scenario.does("recover_block", block=YARD_GATE)
    scenario.refuses("request", Refusal.POINT_LOST, **ask)
    scenario.does("recover_point", point=P1)
    scenario.refuses("request", Refusal.POINT_LOST, **ask)
    scenario.does("recover_point", point=P2)
    scenario.does("request", **ask)
    return scenario


def a_step_out_of_turn_is_refused(steps: Steps) -> Scenario:
    """What names no run, or a run at another stage, changes nothing (T4, T6, T9)."""
    scenario, runs = recovered(steps, FACING_EAST)
    nobody = next_run(scenario, T1, WEST_TO_ONE)
    for step in ("withdraw", "cancel", "note_given_back", "note_echo", "release_overlap", "send_permit", "send_recall"):
        scenario.refuses(step, run=nobody)
    scenario.refuses("open_first_loop", Refusal.NO_SUCH_RUN, run=nobody)
    scenario.refuses("retire", Refusal.NO_SUCH_RUN, run=nobody)
    scenario.refuses("release_block", Refusal.NO_SUCH_RUN, **reported(scenario, nobody, WEST, THROAT))
    run = reserve(scenario, T1, WEST_TO_ONE, runs[T1])
    scenario.refuses("release_block", Refusal.WRONG_STAGE, **reported(scenario, run, WEST, THROAT))
    scenario.refuses("retire", Refusal.STILL_CLAIMED, run=run)
    for step in ("cancel", "send_recall", "note_echo", "send_standing_run"):
        scenario.refuses(step, run=run)
    scenario.refuses("note_confirmation", run=run, point=P1, position=NORMAL)
    scenario.refuses("open_first_loop", Refusal.WRONG_STAGE, run=runs[T1])
    for step in ("withdraw", "cancel", "note_given_back", "release_overlap", "send_permit", "send_offer"):
        scenario.refuses(step, run=runs[T1])
    prove_all(scenario, run)
    scenario.does("open_first_loop", run=run)
    scenario.refuses("open_first_loop", Refusal.WRONG_STAGE, run=run)
    scenario.refuses("send_order", run=run, point=P1, life=scenario.system.terminals[P1].life)
    return scenario


def a_word_that_cannot_be_taken_is_refused(steps: Steps) -> Scenario:
    """A stranger, another epoch or life, a number that is old or used up, a route where none is: not accounted (T8)."""
    scenario = opened(steps, FACING_EAST)
    life = answer(scenario, T1)
    run, epoch = next_run(scenario, T1, NO_ROUTE), scenario.system.centre.epoch
    word = {"train": T1, "life": life, "epoch": epoch}
    stranger = Train("a stranger")
    scenario.refuses("note_standing", Refusal.UNKNOWN_TRAIN, **word | {"train": stranger}, run=run)
    scenario.refuses("note_standing", Refusal.WRONG_EPOCH, **word | {"epoch": Epoch(epoch + 1)}, run=run)
    scenario.refuses("note_standing", Refusal.WRONG_LIFE, **word, run=run._replace(life=UnitLife(life + 1)))
    scenario.refuses("note_standing", Refusal.WRONG_LIFE, **word, run=run._replace(train=T2))
    scenario.refuses("note_standing", Refusal.NAMES_A_ROUTE, **word, run=run._replace(route=WEST_TO_ONE))
    scenario.refuses("note_standing", Refusal.SERIAL_NOT_NEW, **word, run=run._replace(serial=Serial(0)))
    last = scenario.site.layout.last_serial
    scenario.refuses("note_standing", Refusal.SERIALS_EXHAUSTED, **word, run=run._replace(serial=last))
    scenario.does("note_standing", **word, run=run)
    again = next_run(scenario, T1, NO_ROUTE)
    scenario.refuses("note_standing", Refusal.WRONG_LIFE, **word, run=again)
    scenario.refuses("open_procedure", train=stranger)
    return scenario


def a_word_that_names_an_unknown_block_is_refused(steps: Steps) -> Scenario:
    """A unit that goes by an older plan leaves its train where the centre has it (T8)."""
    scenario = opened(steps, FACING_EAST)
    true = blocks_of(scenario, T1)
    for said in (frozenset({Block("closed line")}), true | {Block("closed line")}):
        life = answer(scenario, T1, said)
        word = {"train": T1, "life": life, "epoch": scenario.system.centre.epoch}
        scenario.refuses("note_standing", Refusal.UNKNOWN_BLOCK, **word, run=next_run(scenario, T1, NO_ROUTE))
    take_word(scenario, T1, answer(scenario, T1, true), next_run(scenario, T1, NO_ROUTE))
    return scenario


def the_last_number_is_never_granted(steps: Steps) -> Scenario:
    """A centre whose numbers are used up grants nothing more, and says so (T10)."""
    whole = site_of(PASSING_PLACE)
    site = replace(whole, layout=replace(whole.layout, last_serial=Serial(3)))
    at = {**FACING_EAST, B1: frozenset({YARD_EAST})}
    scenario = Scenario(steps, site, standing_at(site, at, {}))
    first = tell(scenario, T1)
    tell(scenario, T2)
    recover(scenario)
    scenario.refuses("request", Refusal.SERIALS_EXHAUSTED, run=next_run(scenario, T1, WEST_TO_ONE), base=first)
    return scenario


def a_train_may_name_more_than_it_is_in(steps: Steps) -> Scenario:
    """A train may name a block that it is not in; it is held for it, unless it is another's or its point moves (T8)."""
    scenario, runs = recovered(steps, {**FACING_EAST, B1: frozenset({EAST})})
    run = reserve(scenario, T1, WEST_TO_ONE, runs[T1])
    epoch, beside = scenario.system.centre.epoch, frozenset({EAST})
    for more, why in ((THROAT, Refusal.POINT_BEING_LAID), (WEST, Refusal.BLOCK_HELD_FOR_ANOTHER), (YARD_EAST, None)):
        life = UnitLife(scenario.system.units[T2].life + 2)
        scenario.does("restart_unit", train=T2, life=UnitLife(life - 1))
        event = {"train": T2, "epoch": epoch, "life": life, "at": AT_REST, "line": WHOLE}
        scenario.does("answer", **event, blocks=beside | {more})
        scenario.does("send_standing", train=T2, epoch=epoch)
        word = {"train": T2, "life": life, "epoch": epoch, "run": next_run(scenario, T2, NO_ROUTE)}
        if why is None:
            scenario.does("note_standing", **word)
        else:
            scenario.refuses("note_standing", why, **word)
    holders = scenario.system.centre.claimed[YARD_EAST]
    scenario.must({each.train for each in holders} == {T2}, "the block that it named is held for it")
    scenario.must(run in scenario.system.centre.claimed[THROAT], "the other's route stands")
    return scenario


def an_answer_is_given_at_rest(steps: Steps) -> Scenario:
    """A unit answers a challenge that was sent, at rest, held, over a healthy line; again, in a new life (T8)."""
    scenario = opened(steps, FACING_EAST)
    epoch, life, there = scenario.system.centre.epoch, UnitLife(2), frozenset({WEST})
    event = {"train": T1, "epoch": epoch, "life": life, "blocks": there, "at": AT_REST, "line": WHOLE}
    scenario.refuses("answer", **event)
    scenario.refuses("send_challenge", epoch=Epoch(epoch + 1))
    scenario.does("send_challenge", epoch=epoch)
    scenario.refuses("send_standing", train=T1, epoch=epoch)
    for wrong in (
        {"at": ROLLING},
        {"at": NOT_HELD},
        {"line": BROKEN},
        {"blocks": frozenset({ONE})},
        {"life": UnitLife(1)},
    ):
        scenario.refuses("answer", **event | wrong)
    scenario.does("answer", **event)
    scenario.refuses("answer", **event)
    scenario.refuses("note_standing", train=T1, life=life, epoch=epoch, run=next_run(scenario, T1, NO_ROUTE))
    return scenario


def a_train_keeps_off_the_points_below(steps: Steps) -> Scenario:
    """A train over a turnout passes no order on that would throw it, and one for as it lies changes nothing (T10)."""
    scenario, runs = recovered(steps, FACING_EAST)
    run = set_route(scenario, T1, WEST_TO_ONE, runs[T1])
    run_through(scenario, run, WEST, THROAT)
    stale = run._replace(serial=Serial(run.serial + 1), route=WEST_TO_TWO)
    life = scenario.system.terminals[P1].life
    scenario.must(THROAT in scenario.system.units[T1].occupied, "the train knows that it is over the points")
    scenario.refuses("relay_order", run=stale, point=P1, life=life)
    scenario.refuses("drift", point=P1, position=REVERSE)
    scenario.refuses("request", Refusal.POINT_LOCKED_OTHERWISE, run=stale, base=runs[T1])
    return scenario
