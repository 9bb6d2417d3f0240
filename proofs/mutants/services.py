"""What else is lost if a guard goes: witnesses for drops that break no invariant, at the centre and at points.

Each plays on the stations of the witnesses; its docstring says what service, or which second
check, goes with the guard.
"""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise
from typing import Any

from kernel.machine.centre import NO_ROUTE
from kernel.names import Block, Car, Cause, Stage, TerminalLife, Train, UnitLife
from kernel.refusal import Refusal
from kernel.unit import Evidence
from models.simulator.senses import AT_REST, WHOLE
from proofs.witnesses import restarts, running, setting, telling
from proofs.witnesses.scenario import Scenario, Steps
from proofs.witnesses.stations import (
    A1,
    A2,
    B1,
    EAST,
    NORMAL,
    ONE,
    ONE_TO_EAST,
    ONE_TO_WEST,
    OUTLET,
    P1,
    P2,
    T1,
    T2,
    THROAT,
    TWO,
    TWO_TO_WEST,
    WEST,
    WEST_TO_EAST,
    WEST_TO_ONE,
    WEST_TO_TWO,
    WEST_TO_TWO_SHIELDED,
)

At = dict[Car, frozenset[Block]]


def standing(first: Block, second: Block | None = None) -> At:
    """Both cars of T1 in one block, and T2 in another where it matters."""
    at = {A1: frozenset({first}), A2: frozenset({first})}
    return at if second is None else {**at, B1: frozenset({second})}


# ---- standing


def tells_anew(scenario: Scenario, train: Train, blocks: frozenset[Block]) -> dict[str, Any]:
    """A train at rest tells for its driver that it is in these blocks; the word of it that the centre is to take."""
    epoch, life = scenario.system.centre.epoch, UnitLife(scenario.system.units[train].life + 1)
    event = {"train": train, "epoch": epoch, "life": life, "blocks": blocks, "at": AT_REST, "line": WHOLE}
    scenario.does("answer", **event)
    scenario.does("send_standing", train=train, epoch=epoch)
    run = telling.next_run(scenario, train, NO_ROUTE)
    return {"train": train, "life": life, "epoch": epoch, "run": run}


def a_train_may_name_a_block_with_a_point_proved_for_another(steps: Steps) -> Scenario:
    """A point that another's route needs as its flank keeps still once it is proved; before, it may move (T8, T10)."""
    scenario, runs = telling.recovered(steps, standing(WEST, EAST))
    run = setting.reserve(scenario, T1, WEST_TO_TWO_SHIELDED, runs[T1])
    word = tells_anew(scenario, T2, frozenset({EAST, OUTLET}))
    scenario.refuses("note_standing", Refusal.POINT_BEING_LAID, **word)
    setting.prove_all(scenario, run)
    scenario.does("note_standing", **word)
    return scenario


def a_train_may_name_a_block_with_a_point_that_it_is_laid_for(steps: Steps) -> Scenario:
    """A train that tells anew ends its own runs, and with them what is being laid for it (T8, T10)."""
    scenario, runs = telling.recovered(steps, standing(WEST))
    setting.reserve(scenario, T1, WEST_TO_ONE, runs[T1])
    scenario.does("note_standing", **tells_anew(scenario, T1, frozenset({WEST, THROAT})))
    return scenario


# ---- cancelling


def a_run_is_cancelled_before_its_echo(steps: Steps) -> Scenario:
    """A run whose list is out but not echoed can be wanted back, asked back, given back and freed (T9)."""
    scenario, runs = telling.recovered(steps, standing(WEST))
    run = setting.reserve(scenario, T1, WEST_TO_ONE, runs[T1])
    setting.prove_all(scenario, run)
    setting.offer(scenario, run)
    setting.recall(scenario, run)
    setting.return_it(scenario, run)
    setting.at_stage(scenario, run, Stage.OVER)
    return scenario


def only_what_is_wanted_back_is_asked_back(steps: Steps) -> Scenario:
    """No train is asked for a run that nobody has cancelled: it would stand for nothing (T9)."""
    scenario, runs = telling.recovered(steps, standing(WEST))
    run = setting.set_route(scenario, T1, WEST_TO_ONE, runs[T1])
    scenario.refuses("send_recall", run=run)
    return scenario


def a_run_is_given_back_only_when_asked_for(steps: Steps) -> Scenario:
    """No unit gives a run back of itself: the train would stand with nobody knowing why (T9)."""
    scenario, runs = telling.recovered(steps, standing(WEST))
    run = setting.set_route(scenario, T1, WEST_TO_ONE, runs[T1])
    scenario.refuses("recall", run=run)
    scenario.refuses("give_back", run=run, at=AT_REST, held_end_mm=0, start_end_mm=0)
    return scenario


def a_run_that_is_over_is_not_asked_back(steps: Steps) -> Scenario:
    """A run that was wanted back and has ended otherwise is asked for no more (T9)."""
    scenario, runs = telling.recovered(steps, standing(WEST))
    run = setting.set_route(scenario, T1, WEST_TO_ONE, runs[T1])
    scenario.does("cancel", run=run)
    scenario.does("restart_unit", train=T1, life=UnitLife(run.life + 1))
    telling.tell(scenario, T1)
    setting.at_stage(scenario, run, Stage.OVER)
    scenario.refuses("send_recall", run=run)
    return scenario


def no_permit_for_a_run_that_is_wanted_back(steps: Steps) -> Scenario:
    """A train that is about to be asked back is not sent off: the cancellation would wait for its whole run (T9)."""
    scenario, runs = telling.recovered(steps, standing(WEST))
    run = setting.reserve(scenario, T1, WEST_TO_ONE, runs[T1])
    setting.prove_all(scenario, run)
    setting.offer(scenario, run)
    setting.echo(scenario, run)
    scenario.does("cancel", run=run)
    scenario.refuses("send_permit", run=run)
    return scenario


def a_run_that_has_begun_is_kept_whatever_the_odometer_says(steps: Steps) -> Scenario:
    """The tags at the end of the start block are a second check: a begun run is not given back (T9).

    The head has passed both and rolled back, so that the brake says that it keeps out of what follows.
    """
    scenario, runs = telling.recovered(steps, standing(WEST))
    run = setting.set_route(scenario, T1, WEST_TO_ONE, runs[T1])
    running.roll(scenario, run)
    setting.recall(scenario, run)
    scenario.does("recall", run=run)
    running.head_passes(scenario, run, WEST, THROAT)
    running.leaves(scenario, running.in_order(scenario, run)[0], THROAT)
    running.rest(scenario, run)
    scenario.refuses("give_back", run=run, at=AT_REST, held_end_mm=0, start_end_mm=0)
    return scenario


def a_run_is_given_back_though_another_way_out_is_set(steps: Steps) -> Scenario:
    """Only what starts in what a run covers leads on from it: the way out at the other end does not (T9)."""
    scenario, runs = telling.recovered(steps, standing(ONE))
    run = setting.set_route(scenario, T1, ONE_TO_EAST, runs[T1])
    setting.set_route(scenario, T1, ONE_TO_WEST, runs[T1])
    setting.recall(scenario, run)
    scenario.does("recall", run=run)
    setting.give_back(scenario, run)
    return scenario


def a_recall_of_a_run_that_has_begun_changes_nothing(steps: Steps) -> Scenario:
    """The train is in it and goes on (T9)."""
    scenario, runs = telling.recovered(steps, standing(WEST))
    run = setting.set_route(scenario, T1, WEST_TO_ONE, runs[T1])
    setting.recall(scenario, run)
    running.roll(scenario, run)
    running.head_passes(scenario, run, WEST, THROAT)
    scenario.refuses("recall", run=run)
    return scenario


def the_first_cause_stays_in_the_journal(steps: Steps) -> Scenario:
    """A claim that has ended by tail evidence keeps that cause, whatever ends the rest of the run later (T8)."""
    scenario, runs = telling.recovered(steps, standing(WEST))
    run = setting.set_route(scenario, T1, WEST_TO_ONE, runs[T1])
    first, second = (running.genuine(scenario, tag) for tag in running.pair(scenario.site.layout, OUTLET, EAST))
    centre, radio, track = scenario.system.centre, scenario.system.radio, scenario.system.track
    unit = scenario.system.units[T1]
    order = replace(unit.orders[run], stopped=True, left={OUTLET: Evidence(first, second)})
    scenario.system = replace(
        scenario.system,
        centre=replace(
            centre,
            runs=centre.runs | {run: replace(centre.runs[run], ended={OUTLET: Cause.TAIL_EVIDENCE})},
            claimed=centre.claimed | {OUTLET: centre.claimed[OUTLET] - {run}},
            locked=centre.locked | {P2: {}},
        ),
        units=scenario.system.units | {T1: replace(unit, orders=unit.orders | {run: order})},
        radio=replace(radio, stops=frozenset({run}), tail_reports=frozenset({(run, OUTLET, first, second)})),
        track=replace(track, behind=frozenset({(run, OUTLET)})),
    )
    scenario.refuses("release_overlap", run=run)
    return scenario


def a_run_from_where_the_train_came_from_does_not_lead_on(steps: Steps) -> Scenario:
    """An earlier run that began where a later one ends keeps nobody from giving that one back (T9)."""
    scenario, runs = telling.recovered(steps, standing(ONE))
    out = setting.set_route(scenario, T1, ONE_TO_WEST, runs[T1])
    running.run_through(scenario, out, ONE, THROAT, WEST)
    running.report(scenario, runs[T1], ONE, THROAT)
    for block, target in pairwise((ONE, THROAT, WEST)):
        running.report(scenario, out, block, target)
    back = setting.set_route(scenario, T1, WEST_TO_ONE, out)
    setting.recall(scenario, back)
    setting.return_it(scenario, back)
    return scenario


def _stand_too_close(scenario: Scenario, block: Block, other: Block) -> None:
    """Two blocks of the layout foul each other."""
    layout = scenario.site.layout
    fouls = {**layout.fouls, block: frozenset({other}), other: frozenset({block})}
    scenario.site = replace(scenario.site, layout=replace(layout, fouls=fouls))


def a_run_is_set_on_from_a_block_that_the_one_behind_fouls(steps: Steps) -> Scenario:
    """A block and the one behind it foul each other, as on the leg of a point: the way on is set all the same (T9)."""
    scenario, runs = telling.recovered(steps, standing(WEST))
    _stand_too_close(scenario, THROAT, ONE)
    run = setting.set_route(scenario, T1, WEST_TO_ONE, runs[T1])
    setting.reserve(scenario, T1, ONE_TO_EAST, run)
    return scenario


def a_run_back_is_set_from_a_block_that_fouls_the_next(steps: Steps) -> Scenario:
    """The block that a train stands in and the next foul each other, as on the leg of a point: it runs on (T9)."""
    scenario, runs = telling.recovered(steps, standing(ONE))
    _stand_too_close(scenario, THROAT, ONE)
    setting.reserve(scenario, T1, ONE_TO_WEST, runs[T1])
    return scenario


def a_run_of_another_train_does_not_lead_on(steps: Steps) -> Scenario:
    """A later run of another train, from a block that was released, keeps nobody from wanting this one back (T9)."""
    scenario, runs = telling.recovered(steps, standing(WEST, TWO))
    run = setting.set_route(scenario, T1, WEST_TO_EAST, runs[T1])
    running.run_through(scenario, run, WEST, THROAT, ONE, OUTLET, EAST)
    running.report(scenario, runs[T1], WEST, THROAT)
    for block, target in pairwise((WEST, THROAT, ONE, OUTLET, EAST)):
        running.report(scenario, run, block, target)
    west = setting.set_route(scenario, T2, TWO_TO_WEST, runs[T2])
    running.run_through(scenario, west, TWO, THROAT, WEST)
    running.report(scenario, runs[T2], TWO, THROAT)
    running.report(scenario, west, TWO, THROAT)
    running.report(scenario, west, THROAT, WEST)
    east = setting.set_route(scenario, T2, WEST_TO_ONE, west)
    running.run_through(scenario, east, WEST, THROAT, ONE)
    running.report(scenario, west, WEST, THROAT)
    for block, target in pairwise((WEST, THROAT, ONE)):
        running.report(scenario, east, block, target)
    setting.reserve(scenario, T2, ONE_TO_WEST, east)
    setting.want_back(scenario, run)
    return scenario


def a_run_that_is_unknown_is_not_wanted_back(steps: Steps) -> Scenario:
    """Who wants a run back that was never granted is told so (T9)."""
    scenario, _ = telling.recovered(steps, standing(WEST))
    nobody = telling.next_run(scenario, T1, WEST_TO_ONE)
    scenario.refuses("cancel", Refusal.NO_SUCH_RUN, run=nobody)
    return scenario


def a_statement_of_another_epoch_is_not_noted(steps: Steps) -> Scenario:
    """What was stated to the centre before it restarted is no half of a new procedure (T8)."""
    scenario, _ = telling.recovered(steps, standing(WEST))
    word = {"train": T1, "epoch": scenario.system.centre.epoch, "life": UnitLife(scenario.system.units[T1].life + 1)}
    scenario.does("open_procedure", train=T1)
    scenario.does("take_over", blocks=frozenset({WEST}), **word)
    scenario.does("note_statement", **word)
    restarts.restart_centre_now(scenario)
    scenario.must(not scenario.system.centre.statements, "nothing that was stated is known")
    scenario.does("open_procedure", train=T1)
    scenario.refuses("note_statement", **word)
    return scenario


def both_persons_speak_of_one_life(steps: Steps) -> Scenario:
    """What the second person confirms of another life of the unit than the first has stated does not count (T8)."""
    scenario, _ = telling.recovered(steps, standing(WEST))
    scenario.does("open_procedure", train=T1)
    epoch, life = scenario.system.centre.epoch, UnitLife(scenario.system.units[T1].life + 1)
    again = UnitLife(life + 1)
    for stated in (life, again):
        scenario.does("take_over", train=T1, epoch=epoch, life=stated, blocks=frozenset({WEST}))
    scenario.does("note_statement", train=T1, epoch=epoch, life=life)
    scenario.does("confirm_statement", train=T1, epoch=epoch, life=again, blocks=frozenset({WEST}))
    run = telling.next_run(scenario, T1, NO_ROUTE, again)
    event = {"train": T1, "epoch": epoch, "life": again, "run": run}
    scenario.refuses("note_statement_confirmed", Refusal.NO_STATEMENT, **event)
    return scenario


# ---- points


def an_older_word_of_a_terminal_counts_no_more(steps: Steps) -> Scenario:
    """A terminal's former life, heard late, does not unseat the present one: no order would be obeyed (T10)."""
    scenario, _ = telling.recovered(steps, standing(WEST))
    former = scenario.system.terminals[P1].life
    scenario.does("restart_terminal", point=P1, life=TerminalLife(former + 1))
    telling.hear_terminal(scenario, P1)
    scenario.refuses("note_terminal_life", point=P1, life=former)
    return scenario


def only_a_train_over_a_lost_point_is_asked_how_it_lies(steps: Steps) -> Scenario:
    """No lock id is taken from a terminal by a train that has left, for a point that is known, or in another life."""
    scenario, runs = telling.recovered(steps, {A1: frozenset({ONE}), A2: frozenset({THROAT})})
    life = scenario.system.terminals[P1].life
    newer = TerminalLife(life + 1)
    scenario.refuses("send_enquiry", run=runs[T1], point=P1, life=newer)
    run = setting.set_route(scenario, T1, ONE_TO_EAST, runs[T1])
    running.roll(scenario, run)
    running.head_passes(scenario, run, ONE, OUTLET)
    running.enters(scenario, run, A1, ONE, OUTLET)
    running.follows(scenario, A2, A1, ONE)
    running.leaves(scenario, A2, THROAT)
    running.tail_passes(scenario, run, THROAT, ONE)
    running.report(scenario, runs[T1], THROAT, ONE)
    scenario.refuses("send_enquiry", run=runs[T1], point=P1, life=life)
    return scenario


def a_point_that_is_known_is_not_asked_for_again(steps: Steps) -> Scenario:
    """A point that was adopted is not enquired for again in the terminal's next life (T10)."""
    scenario, runs = telling.recovered(steps, standing(THROAT))
    telling.adopt(scenario, runs[T1], P1)
    newer = TerminalLife(scenario.system.terminals[P1].life + 1)
    scenario.does("restart_terminal", point=P1, life=newer)
    telling.hear_terminal(scenario, P1)
    scenario.refuses("send_enquiry", run=runs[T1], point=P1, life=newer)
    return scenario


def an_enquiry_for_a_former_life_is_not_answered(steps: Steps) -> Scenario:
    """A terminal that has restarted does not take a lock id meant for its former life (T10)."""
    scenario, runs = telling.recovered(steps, standing(THROAT))
    former = scenario.system.terminals[P1].life
    enquiry = {"run": runs[T1], "point": P1, "life": former}
    scenario.does("send_enquiry", **enquiry)
    scenario.does("relay_enquiry", **enquiry)
    scenario.does("restart_terminal", point=P1, life=TerminalLife(former + 1))
    scenario.refuses("answer_enquiry", **enquiry)
    return scenario


def an_order_of_a_former_life_is_not_passed_on(steps: Steps) -> Scenario:
    """A unit that has restarted passes on no order that came to its former life (T10)."""
    scenario, runs = telling.recovered(steps, standing(WEST))
    run = setting.reserve(scenario, T1, WEST_TO_ONE, runs[T1])
    order = {"run": run, "point": P1, "life": scenario.system.terminals[P1].life}
    scenario.does("send_order", **order)
    scenario.does("restart_unit", train=T1, life=UnitLife(run.life + 1))
    scenario.refuses("relay_order", **order)
    return scenario


def an_order_that_would_throw_the_point_below_is_kept_back(steps: Steps) -> Scenario:
    """Over a turnout the unit keeps back a late order for the other leg: the detector locking of T10's second line."""
    scenario, runs = telling.recovered(steps, standing(WEST))
    older = setting.reserve(scenario, T1, WEST_TO_TWO, runs[T1])
    life = scenario.system.terminals[P1].life
    scenario.does("send_order", run=older, point=P1, life=life)
    scenario.does("withdraw", run=older)
    run = setting.set_route(scenario, T1, WEST_TO_ONE, runs[T1])
    running.roll(scenario, run)
    running.head_passes(scenario, run, WEST, THROAT)
    scenario.refuses("relay_order", run=older, point=P1, life=life)
    return scenario


def a_run_that_was_given_back_speaks_for_no_point_below(steps: Steps) -> Scenario:
    """Only a run that the train is on says how the point below must lie, not one that it gave back (T10)."""
    scenario, runs = telling.recovered(steps, standing(WEST))
    older = setting.reserve(scenario, T1, WEST_TO_TWO, runs[T1])
    life = scenario.system.terminals[P1].life
    scenario.does("send_order", run=older, point=P1, life=life)
    scenario.does("relay_order", run=older, point=P1, life=life)
    setting_again = replace(scenario.system.radio, relayed_orders=frozenset())
    scenario.does("obey_order", run=older, point=P1, life=life, detected=NORMAL, is_detected=True)
    setting.lay(scenario, older, P1)
    telling.confirm(scenario, older, P1)
    setting.note_proved(scenario, older, P1)
    setting.prove_all(scenario, older)
    setting.offer(scenario, older)
    setting.recall(scenario, older)
    setting.return_it(scenario, older)
    run = setting.set_route(scenario, T1, WEST_TO_ONE, runs[T1])
    running.roll(scenario, run)
    running.head_passes(scenario, run, WEST, THROAT)
    scenario.system = replace(scenario.system, radio=setting_again)
    scenario.refuses("relay_order", run=older, point=P1, life=life)
    return scenario


def no_order_for_a_point_that_is_proved(steps: Steps) -> Scenario:
    """A point that the run below holds is proved already: no order goes to a point the train may stand on (T10)."""
    scenario, runs = telling.recovered(steps, standing(WEST))
    first = setting.set_route(scenario, T1, WEST_TO_ONE, runs[T1])
    second = setting.reserve(scenario, T1, ONE_TO_EAST, first)
    scenario.must(P2 in scenario.system.centre.runs[second].proved, "the outlet's point is proved")
    scenario.refuses("send_order", run=second, point=P2, life=scenario.system.terminals[P2].life)
    return scenario


def a_word_of_a_point_not_needed_is_not_noted(steps: Steps) -> Scenario:
    """What is noted as proved for a run is a point of its route, whatever a terminal has sent (T10)."""
    scenario, runs = telling.recovered(steps, standing(WEST))
    run = setting.reserve(scenario, T1, WEST_TO_TWO, runs[T1])
    word = (run, P2, NORMAL)
    radio = scenario.system.radio
    radio = replace(radio, confirmed=radio.confirmed | {word}, confirmations=radio.confirmations | {word})
    scenario.system = replace(scenario.system, radio=radio)
    scenario.refuses("note_confirmation", run=run, point=P2, position=NORMAL)
    return scenario


def a_point_that_moves_is_locked_by_locking_only(steps: Steps) -> Scenario:
    """A point that is unlocked and happens to lie right is not confirmed before it has been locked (T10)."""
    scenario, runs = telling.recovered(steps, standing(WEST))
    older = setting.reserve(scenario, T1, WEST_TO_TWO, runs[T1])
    setting.order(scenario, older, P1)
    scenario.does("withdraw", run=older)
    run = setting.reserve(scenario, T1, WEST_TO_ONE, runs[T1])
    setting.order(scenario, run, P1)
    scenario.refuses("send_confirmation", run=run, point=P1, position=NORMAL, detected=NORMAL, is_detected=True)
    setting.lay(scenario, run, P1)
    telling.confirm(scenario, run, P1)
    return scenario
