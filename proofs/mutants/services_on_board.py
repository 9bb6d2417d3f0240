"""What else is lost if a guard goes: witnesses for drops that break no invariant, on board and in the world.

As in :mod:`proofs.mutants.services`, each docstring says what service, or which second check, goes.
"""

from __future__ import annotations

from dataclasses import replace

from kernel.names import Read, Record, Route, Run, Serial, Tag, UnitLife
from kernel.refusal import Refusal
from kernel.unit import Order
from models.simulator.senses import BROKEN, INSIDE
from proofs.mutants.services import standing
from proofs.witnesses import restarts, running, setting, telling
from proofs.witnesses.changes import came
from proofs.witnesses.scenario import Scenario, Steps
from proofs.witnesses.stations import (
    A1,
    A2,
    B1,
    EAST,
    EAST_TO_ONE,
    HERE,
    MIDDLE,
    MIDDLE_TO_NORTH,
    NORTH,
    NORTH_TO_MIDDLE,
    ONE,
    ONE_TO_EAST,
    ONE_TO_WEST,
    OUTLET,
    P1,
    P2,
    PASSED_IN_PARTS,
    PLAIN_LINE,
    T1,
    T2,
    THROAT,
    TWO,
    WEST,
    WEST_TO_EAST,
    WEST_TO_ONE,
    WEST_TO_TWO,
    YARD_EAST,
)


def a_tag_read_before_the_permit_opens_the_loop(steps: Steps) -> Scenario:
    """A train that sets off with the list but without the permit brakes at the first tag (T5)."""
    scenario, runs = telling.recovered(steps, standing(WEST))
    run = setting.reserve(scenario, T1, WEST_TO_ONE, runs[T1])
    setting.prove_all(scenario, run)
    setting.offer(scenario, run)
    tag, cab = scenario.site.layout.first_tag[WEST_TO_ONE], running.head_cab(scenario, run)
    running.faces(scenario, run)
    astray = {"astray": came((T1, run.life)), "last_read": {T1: tag}}
    opened = {"units": {T1: {"loop_open": True}}, "track": astray}
    scenario.does("head_reads", opened, train=T1, cab=cab, tag=tag, in_window=True)
    return scenario


def a_run_not_begun_is_read_from_its_first_tag_after_a_turn(steps: Steps) -> Scenario:
    """A driver who stops on the first tag, turns and turns back reads that tag again, and his run begins (T5)."""
    scenario, runs = telling.recovered(steps, standing(WEST))
    run = setting.set_route(scenario, T1, WEST_TO_ONE, runs[T1])
    running.roll(scenario, run)
    running.head_reads(scenario, run, scenario.site.layout.first_tag[WEST_TO_ONE])
    running.rest(scenario, run)
    running.faces(scenario, telling.next_run(scenario, T1, ONE_TO_WEST))
    running.roll(scenario, run)
    running.head_passes(scenario, run, WEST, THROAT)
    scenario.must(scenario.system.units[T1].orders[run].begun, "the run has begun")
    return scenario


def a_run_back_does_not_begin_with_the_way_in(steps: Steps) -> Scenario:
    """The tag at which a way in ends begins the way back: it is read for the way in alone, and no loop opens (T5).

    The centre sets no way back so early; a unit that was permitted one would keep its loop.
    """
    at = {**standing(NORTH), B1: frozenset({HERE})}
    scenario, runs = telling.recovered(steps, at, station=PLAIN_LINE)
    run = setting.set_route(scenario, T1, NORTH_TO_MIDDLE, runs[T1])
    running.roll(scenario, run)
    ends, begins = running.pair(scenario.site.layout, NORTH, MIDDLE)
    running.head_reads(scenario, run, ends)
    running.enters(scenario, run, A1, NORTH, MIDDLE)
    back = _reads_beside(scenario, run, MIDDLE_TO_NORTH, begins)
    scenario.must(back.expected == begins and back.led_by is None, "the way back has yet to begin")
    return scenario


def an_overtaken_run_does_not_go_on_with_its_successor(steps: Steps) -> Scenario:
    """Of two runs that lead over one boundary the one that a later one has overtaken stays behind (T2, T5)."""
    scenario, runs = telling.recovered(steps, standing(WEST))
    later = setting.set_route(scenario, T1, WEST_TO_ONE, runs[T1])
    running.roll(scenario, later)
    running.head_passes(scenario, later, WEST, THROAT)
    tag = running.pair(scenario.site.layout, THROAT, ONE)[0]
    overtaken = _reads_beside(scenario, later, WEST_TO_EAST, tag, begun=True, earlier=True)
    scenario.must(overtaken.expected == tag, "only the newer run goes on")
    return scenario


def _reads_beside(
    scenario: Scenario, run: Run, route: Route, tag: Tag, begun: bool = False, earlier: bool = False
) -> Order:
    """A tag that ``run`` expects is read by a unit that is given another run besides; what becomes of that one."""
    layout, unit = scenario.site.layout, scenario.system.units[T1]
    other = Run(Serial(run.serial - 1 if earlier else run.serial + 1), T1, run.life, route)
    order = replace(
        unit.orders[run],
        tag_list=layout.tag_list[route],
        expected=tag,
        begun=begun,
        led_by=unit.leading if begun else None,
        entered=frozenset(),
    )
    told = replace(unit, orders=unit.orders | {other: order})
    made = replace(scenario.system, units=scenario.system.units | {T1: told})
    cab = running.head_cab(scenario, run)
    after = scenario.steps["head_reads"](scenario.site, made, train=T1, cab=cab, tag=tag, in_window=True)
    scenario.must(after.units[T1].head_tag == tag, "the tag was read")
    read: Order = after.units[T1].orders[other]
    return read


def a_train_that_turned_does_not_go_on_under_an_older_run(steps: Steps) -> Scenario:
    """A run that a later one has overtaken is past, though it had begun; it tells anew where it stands (T2, T9)."""
    at = {**standing(WEST), B1: frozenset({YARD_EAST})}
    scenario, runs = telling.recovered(steps, at, station=PASSED_IN_PARTS)
    run = setting.set_route(scenario, T1, WEST_TO_EAST, runs[T1])
    running.run_through(scenario, run, WEST, THROAT, ONE)
    running.report(scenario, runs[T1], WEST, THROAT)
    for block, target in ((WEST, THROAT), (THROAT, ONE)):
        running.report(scenario, run, block, target)
    back = setting.set_route(scenario, T1, ONE_TO_WEST, run)
    running.roll(scenario, back)
    running.head_passes(scenario, back, ONE, THROAT)
    running.rest(scenario, back)
    running.faces(scenario, run)
    scenario.refuses("start_rolling", run=run)
    onward = telling.next_run(scenario, T1, ONE_TO_EAST)
    scenario.refuses("request", Refusal.START_IS_RUN_THROUGH, run=onward, base=run)
    return scenario


def a_run_given_back_does_not_begin_with_its_successor(steps: Steps) -> Scenario:
    """Tags read under the permitted run are not counted for one given back with the same first tag (T5)."""
    scenario, runs = telling.recovered(steps, standing(WEST))
    older = setting.reserve(scenario, T1, WEST_TO_TWO, runs[T1])
    setting.prove_all(scenario, older)
    setting.offer(scenario, older)
    setting.recall(scenario, older)
    setting.return_it(scenario, older)
    run = setting.set_route(scenario, T1, WEST_TO_ONE, runs[T1])
    running.roll(scenario, run)
    running.head_passes(scenario, run, WEST, THROAT)
    return scenario


def a_run_given_back_expects_no_tag(steps: Steps) -> Scenario:
    """A train that sets off under a run it has given back brakes at the first tag, permit or not (T5, T9)."""
    scenario, runs = telling.recovered(steps, standing(WEST))
    run = setting.set_route(scenario, T1, WEST_TO_ONE, runs[T1])
    setting.recall(scenario, run)
    setting.return_it(scenario, run)
    tag, cab = scenario.site.layout.first_tag[WEST_TO_ONE], running.head_cab(scenario, run)
    running.faces(scenario, run)
    astray = {"astray": came((T1, run.life)), "last_read": {T1: tag}}
    opened = {"units": {T1: {"loop_open": True}}, "track": astray}
    scenario.does("head_reads", opened, train=T1, cab=cab, tag=tag, in_window=True)
    return scenario


def a_train_with_an_open_loop_reports_nothing(steps: Steps) -> Scenario:
    """What a tail reads after the loop was opened is no evidence: all stays occupied (T5, T8)."""
    scenario, runs = telling.recovered(steps, standing(WEST))
    run = setting.set_route(scenario, T1, WEST_TO_ONE, runs[T1])
    running.roll(scenario, run)
    running.head_passes(scenario, run, WEST, THROAT)
    for car in running.in_order(scenario, run):
        running.crosses(scenario, run, car, WEST, THROAT)
    scenario.does("window_passes", train=T1)
    for tag in running.pair(scenario.site.layout, WEST, THROAT):
        scenario.does("tail_reads", **running.tail_read(scenario, run, tag))
    scenario.refuses("send_tail_report", **running.reported(scenario, run, WEST, THROAT))
    return scenario


def a_broken_line_forgets_the_half_pair(steps: Steps) -> Scenario:
    """When the through line breaks between two tags the first is forgotten, wherever the antenna is (T2, T3)."""
    scenario, runs = telling.recovered(steps, standing(WEST))
    run = setting.set_route(scenario, T1, WEST_TO_ONE, runs[T1])
    running.faces(scenario, run)
    first, second = running.pair(scenario.site.layout, WEST, THROAT)
    running.tail_reads_first(scenario, run, first)
    scenario.does("part", train=T1)
    event = running.tail_read(scenario, run, second) | {"line": BROKEN}
    scenario.does("tail_reads", {"units": {T1: {"tail_read": None}}}, **event)
    return scenario


def a_direction_chosen_again_forgets_nothing(steps: Steps) -> Scenario:
    """A driver at rest over a boundary who chooses the direction that he has does not halve the tail's pair (T2)."""
    scenario, runs = telling.recovered(steps, standing(WEST))
    run = setting.set_route(scenario, T1, WEST_TO_ONE, runs[T1])
    running.roll(scenario, run)
    running.head_passes(scenario, run, WEST, THROAT)
    for car in running.in_order(scenario, run):
        running.crosses(scenario, run, car, WEST, THROAT)
    running.tail_reads_first(scenario, run, running.pair(scenario.site.layout, WEST, THROAT)[0])
    running.rest(scenario, run)
    scenario.refuses("change_ends", train=T1, cab=running.head_cab(scenario, run))
    scenario.must(scenario.system.units[T1].tail_read is not None, "the first tag of the pair is remembered")
    return scenario


def a_block_before_one_that_was_left_is_left_no_more(steps: Steps) -> Scenario:
    """A tail that missed a boundary has left what came before the next one, and no head is let out of it again (T2)."""
    scenario, runs = telling.recovered(steps, standing(WEST))
    run = setting.set_route(scenario, T1, WEST_TO_ONE, runs[T1])
    running.roll(scenario, run)
    running.head_passes(scenario, run, WEST, THROAT)
    for car in running.in_order(scenario, run):
        running.crosses(scenario, run, car, WEST, THROAT)
    running.pass_boundary(scenario, run, THROAT, ONE)
    running.rest(scenario, run)
    running.roll(scenario, run)
    scenario.must((run, WEST) not in scenario.system.track.leavable, "nobody is let out of the west again")
    return scenario


def an_answer_closes_the_loop(steps: Steps) -> Scenario:
    """A train that went astray and tells anew where it stands begins a life in which it can be led again (T5, T8)."""
    scenario, _ = telling.recovered(steps, standing(WEST))
    scenario.does("window_passes", train=T1)
    restarts.restart_centre_now(scenario)
    telling.tell(scenario, T1)
    scenario.must(not scenario.system.units[T1].loop_open, "the loop is closed")
    return scenario


def a_copied_first_tag_may_be_read_anywhere(steps: Steps) -> Scenario:
    """Nature puts no bounds on a foreign record; a pair that begins with one is refused by the centre (T6)."""
    return _nothing_is_left_by(steps, first=Record("copied"))


def a_copied_second_tag_may_be_read_anywhere(steps: Steps) -> Scenario:
    """Nature puts no bounds on a foreign record; a pair that ends with one is refused by the centre (T6)."""
    return _nothing_is_left_by(steps, second=Record("copied"))


def _nothing_is_left_by(steps: Steps, first: Record | None = None, second: Record | None = None) -> Scenario:
    """The tail reads a pair while it is still in the west, one tag with a record not its own: all stays held."""
    scenario, runs = telling.recovered(steps, standing(WEST))
    run = setting.set_route(scenario, T1, WEST_TO_ONE, runs[T1])
    running.roll(scenario, run)
    running.head_passes(scenario, run, WEST, THROAT)
    report = running.reported(scenario, run, WEST, THROAT)
    for word, record in (("left", first), ("entered", second)):
        read = report[word] if record is None else Read(report[word].tag, record)
        report[word] = read
        scenario.does("tail_reads", **running.tail_read(scenario, run, read.tag) | {"read": read})
    scenario.must((run, WEST) not in scenario.system.track.behind, "nature knows that the tail has left nothing")
    scenario.does("send_tail_report", **report)
    scenario.refuses("release_block", Refusal.RECORD_DIFFERS, **report)
    return scenario


def a_train_slips_on_when_its_unit_restarts(steps: Steps) -> Scenario:
    """Nature does not stop a slipping train because its unit has forgotten it: it still comes into its overlap (T9)."""
    scenario, runs = telling.recovered(steps, standing(WEST))
    run = setting.set_route(scenario, T1, WEST_TO_ONE, runs[T1])
    running.roll(scenario, run)
    for block, target in ((WEST, THROAT), (THROAT, ONE)):
        running.enters(scenario, run, A1, block, target)
    running.slip(scenario, run)
    scenario.does("restart_unit", train=T1, life=UnitLife(run.life + 1))
    running.enters(scenario, run, A1, ONE, OUTLET)
    return scenario


def a_run_that_a_later_one_has_overtaken_does_not_begin(steps: Steps) -> Scenario:
    """Runs are begun in the order of their grant: what the unit holds of the way of two runs rests on it (T2, T9)."""
    scenario, runs = telling.recovered(steps, standing(WEST))
    run = setting.set_route(scenario, T1, WEST_TO_ONE, runs[T1])
    order = scenario.system.units[T1].orders[run]
    begun = {run._replace(serial=Serial(run.serial + 1)): replace(order, begun=True)}
    unit = replace(scenario.system.units[T1], orders=scenario.system.units[T1].orders | begun)
    scenario.system = replace(scenario.system, units=scenario.system.units | {T1: unit})
    scenario.refuses("start_rolling", run=run)
    first = scenario.site.layout.first_tag[WEST_TO_ONE]
    after = scenario.steps["head_reads"](
        scenario.site, scenario.system, train=T1, cab=running.head_cab(scenario, run), tag=first, in_window=True
    )
    scenario.must(not after.units[T1].loop_open, "the tag is the next one of the later run")
    scenario.must(after.units[T1].orders[run] == order, "it is not that of the older one")
    return scenario


def a_run_that_has_begun_stays_begun(steps: Steps) -> Scenario:
    """Where a route meets its own first tag again, the run is not taken for one that has not begun (T5, T9)."""
    scenario, runs = telling.recovered(steps, standing(WEST))
    run = setting.set_route(scenario, T1, WEST_TO_ONE, runs[T1])
    running.roll(scenario, run)
    running.head_passes(scenario, run, WEST, THROAT)
    layout = scenario.site.layout
    first, second = layout.first_tag[WEST_TO_ONE], running.pair(layout, WEST, THROAT)[1]
    again = {**layout.tag_after, WEST_TO_ONE: {**layout.tag_after[WEST_TO_ONE], second: first}}
    order = replace(scenario.system.units[T1].orders[run], expected=first)
    unit = replace(scenario.system.units[T1], orders=scenario.system.units[T1].orders | {run: order})
    kept = {**scenario.site.lists.tag_after, layout.tag_list[WEST_TO_ONE]: again[WEST_TO_ONE]}
    lists = replace(scenario.site.lists, tag_after=kept)
    scenario.site = replace(scenario.site, layout=replace(layout, tag_after=again), lists=lists)
    scenario.system = replace(scenario.system, units=scenario.system.units | {T1: unit})
    scenario.does("head_reads", train=T1, cab=running.head_cab(scenario, run), tag=first, in_window=True)
    scenario.must(scenario.system.units[T1].orders[run].begun, "the run has begun")
    return scenario


def a_tag_outside_the_plan_names_no_block(steps: Steps) -> Scenario:
    """A tag that a list names and the plan does not know adds no block to those the train is in (T2)."""
    scenario, runs = telling.recovered(steps, standing(WEST))
    run = setting.set_route(scenario, T1, WEST_TO_ONE, runs[T1])
    running.roll(scenario, run)
    running.head_passes(scenario, run, WEST, THROAT)
    stray = Tag("stray")
    order = replace(scenario.system.units[T1].orders[run], expected=stray)
    unit = replace(scenario.system.units[T1], orders=scenario.system.units[T1].orders | {run: order})
    scenario.system = replace(scenario.system, units=scenario.system.units | {T1: unit})
    scenario.does("head_reads", train=T1, cab=running.head_cab(scenario, run), tag=stray, in_window=True)
    scenario.must(scenario.system.units[T1].occupied == {WEST, THROAT}, "the train is in the west and in the throat")
    scenario.must(scenario.system.units[T1].orders[run].expected != stray, "the next tag is expected")
    return scenario


def a_statement_never_made_does_not_arrive(steps: Steps) -> Scenario:
    """The centre notes nothing of a statement that nobody has made (T8)."""
    scenario, _ = telling.recovered(steps, standing(WEST))
    scenario.does("open_procedure", train=T1)
    life = scenario.system.units[T1].life
    scenario.refuses("note_statement", train=T1, life=life, epoch=scenario.system.centre.epoch)
    return scenario


def a_car_follows_only_a_car_that_ran_there(steps: Steps) -> Scenario:
    """History has no hole: a car follows another only into a block where it is known under which run that one came."""
    scenario, runs = telling.recovered(steps, standing(WEST))
    run = setting.set_route(scenario, T1, WEST_TO_ONE, runs[T1])
    running.roll(scenario, run)
    running.enters(scenario, run, A1, WEST, THROAT)
    scenario.system = replace(scenario.system, track=replace(scenario.system.track, under={}))
    scenario.refuses("car_follows", car=A2, other=A1, target=THROAT)
    return scenario


def another_train_says_nothing_of_where_this_one_stops(steps: Steps) -> Scenario:
    """Nature lets a train stand in its destination whoever is beyond it (T9)."""
    scenario, runs = telling.recovered(steps, standing(WEST, TWO))
    run = setting.set_route(scenario, T1, WEST_TO_ONE, runs[T1])
    running.run_through(scenario, run, WEST, THROAT, ONE)
    track = scenario.system.track
    beyond = replace(scenario.system, track=replace(track, at=track.at | {B1: frozenset({OUTLET})}))
    after = scenario.steps["note_stopped"](scenario.site, beyond, run=run, **INSIDE)
    scenario.must(after.units[T1].orders[run].stopped, "the train has told that it stopped")
    elsewhere = {A1: frozenset({WEST}), A2: frozenset({WEST}), B1: frozenset({ONE})}
    scenario.system = replace(scenario.system, track=replace(track, at=track.at | elsewhere))
    scenario.refuses("note_stopped", run=run, **INSIDE)
    return scenario


# ---- two at a time


def two_procedures_are_open_at_once(steps: Steps) -> Scenario:
    """A second supervised procedure does not close the first, nor its statement unsay the other's (T8)."""
    scenario, _ = telling.recovered(steps, standing(WEST, TWO))
    epoch = scenario.system.centre.epoch
    for train in (T1, T2):
        scenario.does("open_procedure", {"centre": {"supervised": came(train)}}, train=train)
    for train, block in ((T1, WEST), (T2, TWO)):
        life = UnitLife(scenario.system.units[train].life + 1)
        word = {"train": train, "epoch": epoch, "life": life}
        scenario.does("take_over", blocks=frozenset({block}), **word)
        scenario.does("note_statement", **word)
        said = {"radio": {"confirmed_statements": {(train, life, epoch): frozenset({block})}}}
        scenario.does("confirm_statement", said, **word, blocks=frozenset({block}))
    scenario.must(set(scenario.system.centre.statements) == {T1, T2}, "both statements are noted")
    return scenario


def two_trains_at_once(steps: Steps) -> Scenario:
    """What one train sends, or does, takes nothing back of what another did: recall, return, part, slip (T11)."""
    scenario, runs = telling.recovered(steps, standing(WEST, EAST))
    first = setting.set_route(scenario, T1, WEST_TO_TWO, runs[T1])
    second = setting.set_route(scenario, T2, EAST_TO_ONE, runs[T2])
    for run in (first, second):
        setting.recall(scenario, run)
    for run in (first, second):
        setting.return_it(scenario, run)
    third = setting.set_route(scenario, T1, WEST_TO_TWO, runs[T1])
    fourth = setting.set_route(scenario, T2, EAST_TO_ONE, runs[T2])
    for run, through in ((third, (WEST, THROAT, TWO)), (fourth, (EAST, OUTLET, ONE))):
        running.roll(scenario, run)
        running.pass_through(scenario, run, *through)
        running.slip(scenario, run)
        scenario.does("part", {"track": {"parted": came(run.train)}}, train=run.train)
    for run in (third, fourth):
        scenario.does("come_to_rest", run=run)
    for run in (third, fourth):
        scenario.does("note_stopped", run=run, **INSIDE)
        scenario.does("send_stop", {"radio": {"stops": came(run)}}, run=run)
    return scenario


def two_points_are_adopted(steps: Steps) -> Scenario:
    """Enquiries for two points are in the air together (T10, T11)."""
    scenario, runs = telling.recovered(steps, standing(THROAT, OUTLET))
    for run, point in ((runs[T1], P1), (runs[T2], P2)):
        telling.adopt(scenario, run, point)
    return scenario
