"""Witnesses of restarts: centre, unit, terminal, and the ways on from each, with people's help or without (T8, T10)."""

from __future__ import annotations

from typing import Any

from kernel.centre import Statement
from kernel.machine.centre import NO_ROUTE
from kernel.names import Block, Cause, Epoch, Run, Stage, TerminalLife, UnitLife
from kernel.refusal import Refusal
from kernel.restarts import restart_unit
from kernel.standing import isolate
from models.simulator.senses import INSIDE
from proofs.witnesses.changes import GONE, Changes, came, went
from proofs.witnesses.running import (
    crosses,
    enters,
    everything_is_free,
    follows,
    head_passes,
    leaves,
    pass_boundary,
    report,
    rest,
    roll,
    run_through,
    tail_passes,
)
from proofs.witnesses.scenario import Scenario, Steps
from proofs.witnesses.setting import (
    at_stage,
    close_first_loop,
    holds,
    lay,
    locks,
    note_proved,
    order,
    prove,
    reserve,
    retire,
    set_route,
)
from proofs.witnesses.stations import (
    A1,
    A2,
    FACING_EAST,
    NORMAL,
    ONE,
    OUTLET,
    P1,
    P2,
    REVERSE,
    T1,
    T2,
    THROAT,
    WEST,
    WEST_TO_ONE,
    WEST_TO_ONE_ON,
)
from proofs.witnesses.telling import (
    accounted,
    adopt,
    answer,
    blocks_of,
    confirm,
    hear_terminal,
    hear_terminals,
    next_run,
    opened,
    recover,
    recovered,
    take_word,
    tell,
    tell_back,
)


def after_a_start_everything_is_lost(steps: Steps) -> Scenario:
    """Until every train of the register has told where it stands nothing is found again and no route is given (T8)."""
    scenario = opened(steps, FACING_EAST)
    scenario.must(scenario.system.centre.lost_blocks == scenario.site.layout.blocks, "every block is lost")
    first = tell(scenario, T1)
    scenario.refuses("recover_block", block=WEST)
    scenario.refuses("recover_point", Refusal.TRAIN_MISSING, point=P2)
    scenario.refuses("request", Refusal.BLOCK_LOST, run=next_run(scenario, T1, WEST_TO_ONE), base=first)
    tell(scenario, T2)
    hear_terminals(scenario)
    recover(scenario)
    scenario.must(not scenario.system.centre.lost_blocks, "every block is found")
    scenario.must(not scenario.system.centre.lost_points, "every point is found")
    return scenario


def a_point_under_a_standing_train_is_adopted(steps: Steps) -> Scenario:
    """A point under a train that told where it stands stays lost until the terminal tells how it lies (T8, T10)."""
    scenario, runs = recovered(steps, {A1: frozenset({THROAT}), A2: frozenset({WEST})}, {P1: REVERSE})
    scenario.refuses("recover_point", Refusal.BLOCK_HELD, point=P1)
    ahead = next_run(scenario, T1, WEST_TO_ONE_ON)
    scenario.refuses("request", Refusal.POINT_LOST, run=ahead, base=runs[T1])
    scenario.refuses("adopt_point", run=runs[T1], point=P1, position=REVERSE)
    adopt(scenario, runs[T1], P1)
    locks(scenario, P1, runs[T1])
    scenario.refuses("request", Refusal.POINT_LOCKED_OTHERWISE, run=ahead, base=runs[T1])
    scenario.refuses("send_enquiry", run=runs[T1], point=P1, life=scenario.system.terminals[P1].life)
    return scenario


def restart_centre_now(scenario: Scenario) -> None:
    """The centre restarts: but for its counters it has forgotten everything."""
    centre, layout = scenario.system.centre, scenario.site.layout
    epoch = Epoch(centre.epoch + 1)
    effect: Changes = {
        "centre": {
            "epoch": epoch,
            "accounted": dict.fromkeys(centre.accounted, GONE),
            "runs": dict.fromkeys(centre.runs, GONE),
            "claimed": dict.fromkeys(centre.claimed, GONE),
            "locked": dict.fromkeys(centre.locked, GONE),
            "lost_blocks": layout.blocks,
            "lost_points": layout.points,
            "terminal_life": dict.fromkeys(centre.terminal_life, GONE),
            "supervised": frozenset(),
            "statements": dict.fromkeys(centre.statements, GONE),
        }
    }
    scenario.does("restart_centre", effect, epoch=epoch)


def the_centre_restarts_under_a_running_train(steps: Steps) -> Scenario:
    """Nothing from before the restart counts, and the train that runs finds its blocks lost and not given away (T8)."""
    scenario, runs = recovered(steps, FACING_EAST)
    run = set_route(scenario, T1, WEST_TO_ONE, runs[T1])
    roll(scenario, run)
    pass_boundary(scenario, run, WEST, THROAT)
    scenario.does("open_procedure", {"centre": {"supervised": came(T2)}}, train=T2)
    restart_centre_now(scenario)
    scenario.refuses("restart_centre", epoch=scenario.system.centre.epoch)
    old = {"train": T1, "life": UnitLife(2), "epoch": Epoch(1), "run": next_run(scenario, T1, NO_ROUTE, UnitLife(2))}
    scenario.refuses("note_standing", Refusal.WRONG_EPOCH, **old)
    scenario.refuses("request", Refusal.TRAIN_NOT_ACCOUNTED_FOR, run=next_run(scenario, T1, WEST_TO_ONE), base=run)
    tell(scenario, T2)
    scenario.refuses("recover_block", block=ONE)
    pass_boundary(scenario, run, THROAT, ONE)
    rest(scenario, run)
    tell(scenario, T1)
    hear_terminals(scenario)
    recover(scenario)
    everything_is_free(scenario)
    return scenario


def a_unit_restarts_inside_its_run(steps: Steps) -> Scenario:
    """A unit restarts over two blocks, tells where it stands, and is given the rest of its route (T8).

    Nobody releases anything by hand: tail evidence under the run it stands under frees what is behind.
    """
    scenario, runs = recovered(steps, FACING_EAST)
    run = set_route(scenario, T1, WEST_TO_ONE, runs[T1])
    roll(scenario, run)
    head_passes(scenario, run, WEST, THROAT)
    enters(scenario, run, A1, WEST, THROAT)
    leaves(scenario, A1, WEST)
    restart_unit_now(scenario)
    scenario.refuses("start_rolling", run=run)
    scenario.refuses("car_moves", run=run, car=A2, block=THROAT, target=ONE)
    rest(scenario, run)
    stands = tell(scenario, T1)
    for block in (ONE, OUTLET):
        holds(scenario, block)
    at_stage(scenario, run, Stage.OVER)
    retire(scenario, run, runs[T1])
    adopt(scenario, stands, P1)
    _goes_on(scenario, stands)
    return scenario


def restart_unit_now(scenario: Scenario) -> None:
    """The first train's unit restarts."""
    unit = scenario.system.units[T1]
    reborn = restart_unit(unit, UnitLife(unit.life + 1))
    effect = {"units": {T1: {name: getattr(reborn, name) for name in vars(reborn) if name != "orders"}}}
    effect["units"][T1]["orders"] = dict.fromkeys(unit.orders, GONE)
    scenario.does("restart_unit", effect, train=T1, life=reborn.life)
    scenario.refuses("restart_unit", train=T1, life=unit.life)


def _goes_on(scenario: Scenario, stands: Run) -> None:
    """The rest of the route, from where the front stands, the last car drawn after."""
    onward = reserve(scenario, T1, WEST_TO_ONE_ON, stands)
    scenario.must(scenario.system.centre.runs[onward].proved == {P1}, "the point below counts as proved")
    prove(scenario, onward, P2)
    close_first_loop(scenario, onward)
    roll(scenario, onward)
    head_passes(scenario, onward, THROAT, ONE)
    follows(scenario, A2, A1, THROAT)
    leaves(scenario, A2, WEST)
    tail_passes(scenario, onward, WEST, THROAT)
    for car in (A1, A2):
        crosses(scenario, onward, car, THROAT, ONE)
    tail_passes(scenario, onward, THROAT, ONE)
    rest(scenario, onward)
    report(scenario, stands, WEST, THROAT)
    for held in (stands, onward):
        report(scenario, held, THROAT, ONE)
    scenario.does("note_stopped", run=onward, **INSIDE)
    scenario.does("send_stop", run=onward)
    scenario.does("release_overlap", run=onward)
    retire(scenario, stands)
    everything_is_free(scenario)


def a_standing_run_told_late_is_no_order(steps: Steps) -> Scenario:
    """A list that overtakes the word under which run the train stands waits for that word (T6, T8)."""
    scenario = opened(steps, FACING_EAST)
    stands = {}
    for train in (T1, T2):
        life = answer(scenario, train)
        stands[train] = next_run(scenario, train, NO_ROUTE)
        take_word(scenario, train, life, stands[train])
    hear_terminals(scenario)
    recover(scenario)
    run = reserve(scenario, T1, WEST_TO_ONE, stands[T1])
    for point in (P1, P2):
        prove(scenario, run, point)
    scenario.does("open_first_loop", run=run)
    scenario.does("send_offer", run=run)
    tag_list = scenario.site.layout.tag_list[run.route]
    scenario.refuses("take_offer", run=run, tag_list=tag_list)
    scenario.refuses("send_echo", run=run, tag_list=tag_list)
    tell_back(scenario, stands[T1])
    scenario.does("take_offer", run=run, tag_list=tag_list)
    return scenario


def a_terminal_restarts_while_a_route_is_set(steps: Steps) -> Scenario:
    """The lock id is lost, the point unlocked: orders to the old life move nothing, a new one does (T10)."""
    scenario, runs = recovered(steps, FACING_EAST, {P1: REVERSE})
    run = reserve(scenario, T1, WEST_TO_ONE, runs[T1])
    order(scenario, run, P1)
    old = scenario.system.terminals[P1].life
    new = TerminalLife(old + 1)
    reborn = {"terminals": {P1: {"life": new, "holds": None, "wanted": None}}}
    scenario.does("restart_terminal", reborn, point=P1, life=new)
    scenario.must(scenario.system.terminals[P1].unlocked, "the lock is as it was")
    scenario.refuses("lock", point=P1, detected=REVERSE, is_detected=True)
    scenario.refuses("obey_order", run=run, point=P1, life=old, detected=REVERSE, is_detected=True)
    scenario.refuses("send_confirmation", run=run, point=P1, position=REVERSE, detected=REVERSE, is_detected=True)
    scenario.refuses("send_order", run=run, point=P1, life=new)
    scenario.refuses("restart_terminal", point=P1, life=old)
    hear_terminal(scenario, P1)
    prove(scenario, run, P1)
    prove(scenario, run, P2)
    close_first_loop(scenario, run)
    return scenario


def a_terminal_restarts_after_its_word(steps: Steps) -> Scenario:
    """What a terminal confirmed before it restarted stays true: its lock lasts, and it obeys nothing older (T10)."""
    scenario, runs = recovered(steps, FACING_EAST, {P1: REVERSE})
    run = reserve(scenario, T1, WEST_TO_ONE, runs[T1])
    order(scenario, run, P1)
    lay(scenario, run, P1)
    confirm(scenario, run, P1)
    old = scenario.system.terminals[P1].life
    scenario.does("restart_terminal", point=P1, life=TerminalLife(old + 1))
    note_proved(scenario, run, P1)
    scenario.refuses("drift", point=P1, position=REVERSE)
    scenario.refuses("obey_order", run=run, point=P1, life=old, detected=NORMAL, is_detected=True)
    return scenario


def two_persons_release_a_dead_train(steps: Steps) -> Scenario:
    """A unit that cannot answer is accounted for by two persons; what it held before is freed, nothing else (T8)."""
    scenario, runs = recovered(steps, FACING_EAST)
    run = set_route(scenario, T1, WEST_TO_ONE, runs[T1])
    run_through(scenario, run, WEST, THROAT, ONE)
    scenario.does("open_procedure", {"centre": {"supervised": came(T1)}}, train=T1)
    life, epoch = UnitLife(scenario.system.units[T1].life + 1), scenario.system.centre.epoch
    stands = next_run(scenario, T1, NO_ROUTE, life)
    state(scenario, life, epoch, frozenset({THROAT}))
    scenario.refuses("confirm_statement", train=T1, epoch=epoch, life=life, blocks=frozenset({THROAT}))
    again = UnitLife(life + 1)
    state(scenario, again, epoch, blocks_of(scenario, T1))
    wrong = next_run(scenario, T1, NO_ROUTE, life)
    confirmed = {"radio": {"confirmed_statements": {(T1, again, epoch): blocks_of(scenario, T1)}}}
    scenario.does("confirm_statement", confirmed, train=T1, epoch=epoch, life=again, blocks=blocks_of(scenario, T1))
    word = {"train": T1, "life": again, "epoch": epoch}
    scenario.refuses("note_statement_confirmed", Refusal.WRONG_LIFE, run=wrong, **word)
    stands = next_run(scenario, T1, NO_ROUTE, again)
    effect = accounted(scenario, stands, frozenset({ONE}), Cause.SUPERVISED)
    effect["centre"] |= {"supervised": went(T1), "statements": {T1: GONE}}
    scenario.does("note_statement_confirmed", effect, run=stands, **word)
    scenario.refuses("note_statement_confirmed", Refusal.PROCEDURE_NOT_OPEN, run=stands, **word)
    retire(scenario, run, runs[T1])
    everything_is_free(scenario)
    return scenario


def state(scenario: Scenario, life: UnitLife, epoch: Epoch, blocks: frozenset[Block]) -> None:
    """The first person isolates the first train's unit and states where it is; the centre notes it."""
    unit = scenario.system.units[T1]
    reborn = isolate(unit, epoch, life)
    effect: dict[str, Any] = {
        "units": {T1: reborn if not unit.orders else {**_fields(reborn), "orders": dict.fromkeys(unit.orders, GONE)}},
        "radio": {"statements": {(T1, life, epoch): blocks}},
    }
    if not blocks_of(scenario, T1) <= blocks:
        effect |= {"track": {"first_erred": came((T1, life, epoch))}}
    scenario.does("take_over", effect, train=T1, epoch=epoch, life=life, blocks=blocks)
    noted = {"centre": {"statements": {T1: Statement(life, blocks)}}}
    scenario.does("note_statement", noted, train=T1, life=life, epoch=epoch)


def _fields(record: object) -> dict[str, object]:
    """The fields of a record."""
    return dict(vars(record))


def a_statement_waits_for_the_procedure(steps: Steps) -> Scenario:
    """Without the signaller's procedure, or with a new one opened, what the first person said does not count (T8)."""
    scenario, _ = recovered(steps, FACING_EAST)
    life, epoch = UnitLife(3), scenario.system.centre.epoch
    event = {"train": T1, "epoch": epoch, "life": life}
    scenario.does("take_over", blocks=frozenset({WEST}), **event)
    scenario.refuses("note_statement", **event)
    scenario.does("confirm_statement", **event, blocks=frozenset({WEST}))
    run = next_run(scenario, T1, NO_ROUTE, life)
    scenario.refuses("note_statement_confirmed", Refusal.PROCEDURE_NOT_OPEN, run=run, **event)
    scenario.does("open_procedure", {"centre": {"supervised": came(T1)}}, train=T1)
    scenario.refuses("note_statement_confirmed", Refusal.NO_STATEMENT, run=run, **event)
    scenario.does("note_statement", **event)
    scenario.does("open_procedure", {"centre": {"statements": {T1: GONE}}}, train=T1)
    scenario.refuses("note_statement_confirmed", Refusal.NO_STATEMENT, run=run, **event)
    scenario.does("note_statement", **event)
    scenario.does("note_statement_confirmed", run=run, **event)
    holds(scenario, WEST, run)
    return scenario


def two_persons_must_name_the_same_place(steps: Steps) -> Scenario:
    """The centre noted what was then corrected: the second person confirms another place, and neither counts (T8)."""
    scenario, _ = recovered(steps, FACING_EAST)
    life, epoch = UnitLife(3), scenario.system.centre.epoch
    scenario.does("open_procedure", {"centre": {"supervised": came(T1)}}, train=T1)
    state(scenario, life, epoch, frozenset({THROAT}))
    event = {"train": T1, "epoch": epoch, "life": life}
    corrected = {"radio": {"statements": {(T1, life, epoch): frozenset({WEST})}}}
    scenario.does("correct_statement", corrected, blocks=frozenset({WEST}), **event)
    scenario.does("confirm_statement", **event, blocks=frozenset({WEST}))
    run = next_run(scenario, T1, NO_ROUTE, life)
    scenario.refuses("note_statement_confirmed", Refusal.STATEMENTS_DIFFER, run=run, **event)
    scenario.does("note_statement", **event)
    scenario.does("note_statement_confirmed", run=run, **event)
    holds(scenario, WEST, run)
    return scenario


def a_second_person_who_errs_accounts_for_nothing(steps: Steps) -> Scenario:
    """The first person is right, the second names another place: nothing is freed, until he has looked again (T8)."""
    scenario, runs = recovered(steps, FACING_EAST)
    life, epoch, there = UnitLife(3), scenario.system.centre.epoch, frozenset({WEST})
    scenario.does("open_procedure", {"centre": {"supervised": came(T1)}}, train=T1)
    state(scenario, life, epoch, there)
    event = {"train": T1, "epoch": epoch, "life": life}
    wrong, key = frozenset({THROAT}), (T1, life, epoch)
    erred = {"radio": {"confirmed_statements": {key: wrong}}, "track": {"second_erred": came(key)}}
    scenario.does("confirm_statement", erred, blocks=wrong, **event)
    run = next_run(scenario, T1, NO_ROUTE, life)
    scenario.refuses("note_statement_confirmed", Refusal.STATEMENTS_DIFFER, run=run, **event)
    scenario.refuses("correct_statement", blocks=wrong, **event)
    holds(scenario, WEST, runs[T1])
    scenario.does("confirm_statement", {"radio": {"confirmed_statements": {key: there}}}, blocks=there, **event)
    scenario.does("note_statement_confirmed", run=run, **event)
    holds(scenario, WEST, run)
    return scenario
