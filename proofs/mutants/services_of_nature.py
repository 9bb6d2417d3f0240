"""What else is lost if a guard goes: witnesses for drops that break no invariant, in what nature does and remembers.

As in :mod:`proofs.mutants.services`, each docstring says what goes.  No theorem can notice where nature is
allowed less than it does, or where history forgets: these say that it is allowed, and remembered.
"""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise

from kernel.names import Block, Cab, Car, Read, Record, Run, Serial, Tag, UnitLife
from models.simulator.senses import AT_REST, BEYOND, BROKEN, INSIDE, NOT_HELD, ON_THE_WAY, WHOLE
from proofs.mutants.services import standing
from proofs.witnesses import running, setting, telling
from proofs.witnesses.changes import GONE, came, went
from proofs.witnesses.lines import boundaries, line_on
from proofs.witnesses.on_lines import ready
from proofs.witnesses.scenario import Scenario, Steps
from proofs.witnesses.stations import (
    A1,
    A2,
    B1,
    EAST,
    EAST_TO_ONE,
    ONE,
    ONE_TO_EAST,
    ONE_TO_WEST,
    OUTLET,
    PASSING_PLACE,
    T1,
    T2,
    THROAT,
    TWO,
    TWO_TO_EAST,
    TWO_TO_WEST,
    WEST,
    WEST_TO_EAST,
    WEST_TO_ONE,
    WEST_TO_TWO,
    site_of,
    standing_at,
)

STRAY = Tag("stray")


def a_boundary_that_the_head_passes_is_passed_anew(steps: Steps) -> Scenario:
    """Nature binds no tail by what it read before its head came to a boundary again, and read it or not (T2)."""
    scenario, runs = telling.recovered(steps, standing(WEST))
    run = setting.set_route(scenario, T1, WEST_TO_ONE, runs[T1])
    running.roll(scenario, run)
    running.pass_boundary(scenario, run, WEST, THROAT)
    first, second = running.pair(scenario.site.layout, WEST, THROAT)
    before = scenario.system
    anew = went((T1, first), (T1, second))
    scenario.does("head_misses", {"track": {"passed": anew, "unread": came((T1, second))}}, train=T1, tag=second)
    scenario.system = before
    event = {"train": T1, "cab": running.head_cab(scenario, run), "tag": second, "in_window": True}
    scenario.does("head_reads", {"units": {T1: {"tail_read": None}}, "track": {"passed": anew}}, **event)
    return scenario


def what_has_gone_astray_stays_astray(steps: Steps) -> Scenario:
    """Who goes astray later takes nothing back of it: by an overdue tag, a foreign one, or what a tail reads (T5)."""
    scenario, runs = telling.recovered(steps, standing(WEST, TWO))
    life, cab = runs[T1].life, scenario.site.formation.cab
    scenario.does("change_ends", train=T2, cab=cab[B1])
    scenario.does("head_reads", train=T2, cab=cab[B1], tag=STRAY, in_window=True)
    scenario.does("change_ends", train=T1, cab=cab[A1])
    scenario.does(
        "window_passes", {"units": {T1: {"loop_open": True}}, "track": {"astray": came((T1, life))}}, train=T1
    )
    _begins_anew(scenario)
    event = {"train": T1, "cab": cab[A1], "tag": STRAY, "in_window": True}
    astray = {"astray": came((T1, life + 1)), "last_read": {T1: STRAY}}
    scenario.does("head_reads", {"units": {T1: {"loop_open": True}}, "track": astray}, **event)
    _begins_anew(scenario)
    second = running.pair(scenario.site.layout, OUTLET, EAST)[1]
    running.tail_reads_first(scenario, runs[T1], running.pair(scenario.site.layout, WEST, THROAT)[0])
    elsewhere = running.tail_read(scenario, runs[T1], second)
    astray = {"astray": came((T1, life + 2)), "passed": came((T1, second))}
    opened = {"units": {T1: {"loop_open": True, "tail_read": None}}, "track": astray}
    scenario.does("tail_reads", opened, **elsewhere)
    return scenario


def _begins_anew(scenario: Scenario) -> None:
    """The unit of the first train restarts and has a closed loop; its driver chooses, its train is where it was."""
    unit, cab = scenario.system.units[T1], scenario.site.formation.cab[A1]
    scenario.does("restart_unit", train=T1, life=UnitLife(unit.life + 1))
    scenario.must(not scenario.system.units[T1].loop_open, "a new life has a closed loop")
    scenario.does("change_ends", {"units": {T1: {"leading": cab}}}, train=T1, cab=cab)
    located = replace(scenario.system.units[T1], occupied=frozenset({WEST}))
    scenario.system = replace(scenario.system, units=scenario.system.units | {T1: located})


def a_train_whose_loop_is_open_goes_astray_no_more(steps: Steps) -> Scenario:
    """What a head reads after its loop was opened says nothing of the train: history notes the cause, not all after."""
    scenario, _ = telling.recovered(steps, standing(WEST))
    cab = scenario.site.formation.cab[A1]
    scenario.does("change_ends", train=T1, cab=cab)
    opened = replace(scenario.system.units[T1], loop_open=True)
    scenario.system = replace(scenario.system, units=scenario.system.units | {T1: opened})
    read = {"track": {"last_read": {T1: STRAY}}}
    scenario.does("head_reads", read, train=T1, cab=cab, tag=STRAY, in_window=True)
    return scenario


def an_antenna_is_on_its_own_car_of_its_own_train(steps: Steps) -> Scenario:
    """No train hears a tail antenna of another, or one on a car that does not carry it (T2)."""
    scenario, runs = telling.recovered(steps, standing(WEST, TWO))
    run = setting.set_route(scenario, T1, WEST_TO_ONE, runs[T1])
    running.faces(scenario, run)
    cab = scenario.site.formation.cab
    event = running.tail_read(scenario, run, running.pair(scenario.site.layout, WEST, THROAT)[0])
    scenario.refuses("tail_reads", **event | {"cab": cab[B1]})
    scenario.refuses("tail_reads", **event | {"car": B1, "cab": cab[B1], "line": BROKEN, "run": run})
    scenario.does("tail_reads", **event)
    scenario.refuses("tail_reads", **event | {"car": B1, "cab": cab[B1], "line": BROKEN})
    return scenario


def a_head_reads_a_tag_only_where_its_car_is(steps: Steps) -> Scenario:
    """A tag beyond the boundary is not read before the first car is there (T5)."""
    scenario, runs = telling.recovered(steps, standing(WEST))
    run = setting.set_route(scenario, T1, WEST_TO_ONE, runs[T1])
    running.roll(scenario, run)
    first, second = running.pair(scenario.site.layout, WEST, THROAT)
    running.head_reads(scenario, run, first)
    event = {"train": T1, "cab": running.head_cab(scenario, run), "tag": second, "in_window": True}
    scenario.refuses("head_reads", **event)
    return scenario


def a_train_that_faces_the_other_way_may_read_on(steps: Steps) -> Scenario:
    """Nature forbids the other cab only both tags of a run one after the other, not one of them and another (T5)."""
    scenario, runs = telling.recovered(steps, standing(WEST))
    setting.set_route(scenario, T1, WEST_TO_ONE, runs[T1])
    cab = scenario.site.formation.cab[A2]
    scenario.does("change_ends", train=T1, cab=cab)
    for tag in (scenario.site.layout.first_tag[WEST_TO_ONE], STRAY):
        scenario.does("head_reads", train=T1, cab=cab, tag=tag, in_window=True)
    return scenario


def another_train_may_follow_into_a_block_that_was_left(steps: Steps) -> Scenario:
    """A pair that a tail has read binds the cars of its own train, not those that came into the block since (T2)."""
    scenario, runs = telling.recovered(steps, {**standing(ONE), B1: frozenset({WEST})})
    run = setting.set_route(scenario, T1, ONE_TO_EAST, runs[T1])
    running.run_through(scenario, run, ONE, OUTLET, EAST)
    for block, target in pairwise((ONE, OUTLET, EAST)):
        running.report(scenario, run, block, target)
    running.report(scenario, runs[T1], ONE, OUTLET)
    other = setting.set_route(scenario, T2, WEST_TO_ONE, runs[T2])
    running.roll(scenario, other)
    for block, target in pairwise((WEST, THROAT, ONE)):
        running.head_passes(scenario, other, block, target)
    _has_gone_on(
        scenario, Run(Serial(other.serial + 1), T2, other.life, ONE_TO_EAST), scenario.system.track.facing[T2], OUTLET
    )
    again = running.pair(scenario.site.layout, ONE, OUTLET)[1]
    scenario.does("tail_reads", **running.tail_read(scenario, run, again))
    return scenario


def a_car_that_is_yet_to_leave_is_seen(steps: Steps) -> Scenario:
    """No pair is read over a boundary that the last car stands across, though it came there under no run (T2)."""
    at = {A1: frozenset({THROAT}), A2: frozenset({WEST, THROAT})}
    scenario = telling.opened(steps, at)
    nowhere = replace(scenario.system.track, under={A1: {}, A2: {}})
    scenario.system = replace(scenario.system, track=nowhere)
    run = telling.next_run(scenario, T1, WEST_TO_ONE)
    scenario.does("change_ends", train=T1, cab=running.head_cab(scenario, run))
    first, second = running.pair(scenario.site.layout, WEST, THROAT)
    scenario.does("tail_reads", **running.tail_read(scenario, run, first))
    scenario.refuses("tail_reads", **running.tail_read(scenario, run, second))
    return scenario


def a_tag_that_another_train_passed_pairs_with_nothing(steps: Steps) -> Scenario:
    """One train has passed both tags of a boundary, the next one's tail reads the second alone: no pair (T2)."""
    scenario, runs = telling.recovered(steps, {**standing(TWO), B1: frozenset({WEST})})
    east = setting.set_route(scenario, T2, WEST_TO_EAST, runs[T2])
    _goes(scenario, east, runs[T2], WEST, THROAT, ONE, OUTLET, EAST)
    west = setting.set_route(scenario, T1, TWO_TO_WEST, runs[T1])
    _goes(scenario, west, runs[T1], TWO, THROAT, WEST)
    out = setting.set_route(scenario, T1, WEST_TO_ONE, west)
    running.roll(scenario, out)
    running.head_passes(scenario, out, WEST, THROAT)
    running.tail_reads_first(scenario, out, running.pair(scenario.site.layout, WEST, THROAT)[1])
    return scenario


def _with_its_tail_at_the_boundary(steps: Steps) -> tuple[Scenario, Run, Tag]:
    """The head is over the first boundary, and the tail has read the first tag there; the second is to come."""
    scenario, runs = telling.recovered(steps, standing(WEST))
    run = setting.set_route(scenario, T1, WEST_TO_ONE, runs[T1])
    running.roll(scenario, run)
    running.head_passes(scenario, run, WEST, THROAT)
    first, second = running.pair(scenario.site.layout, WEST, THROAT)
    running.tail_reads_first(scenario, run, first)
    return scenario, run, second


def a_false_record_is_no_way_out(steps: Steps) -> Scenario:
    """A tail that reads the second tag with another record has gone out of no block by it (T2, T6)."""
    scenario, run, second = _with_its_tail_at_the_boundary(steps)
    event = running.tail_read(scenario, run, second) | {"read": Read(second, Record("another"))}
    scenario.does("tail_reads", **event)
    scenario.must((run, WEST) not in scenario.system.track.gone, "the train is still there")
    return scenario


def what_the_other_cab_led_is_no_way_on(steps: Steps) -> Scenario:
    """The head has gone on only under a run that the leading cab led, though a later one was led by the other (T2)."""
    scenario, runs = telling.recovered(steps, standing(WEST))
    run = setting.set_route(scenario, T1, WEST_TO_ONE, runs[T1])
    ahead = setting.set_route(scenario, T1, ONE_TO_EAST, run)
    running.roll(scenario, run)
    running.pass_boundary(scenario, run, WEST, THROAT)
    _has_gone_on(
        scenario, Run(Serial(ahead.serial + 1), T1, ahead.life, WEST_TO_TWO), scenario.site.formation.cab[A2], THROAT
    )
    first, second = running.pair(scenario.site.layout, WEST, THROAT)
    for tag in (first, second):
        scenario.does("tail_reads", **running.tail_read(scenario, run, tag))
    scenario.must((ahead, WEST) not in scenario.system.track.gone, "nobody has led it on from there")
    return scenario


def a_train_comes_home_on_a_ring(steps: Steps) -> Scenario:
    """Home is where it began: it has not been there under the run home before that leads there (T2, T5)."""
    line = line_on("a_ring")
    assert line.loop is not None
    scenario = Scenario(steps, line.site, line.on_the_loop())
    standing, _ = ready(scenario)
    out = setting.set_route(scenario, T1, line.loop.round, standing)
    running.roll(scenario, out)
    way = line.blocks(line.loop.round)
    running.pass_through(scenario, out, *way)
    running.report(scenario, standing, *way[:2])
    for block, target in boundaries(way):
        running.report(scenario, out, block, target)
    home = setting.set_route(scenario, T1, line.loop.home, out)
    running.roll(scenario, home)
    running.pass_through(scenario, home, *line.blocks(line.loop.home))
    running.rest(scenario, home)
    return scenario


def a_pair_is_not_passed_with_a_car_before_it(steps: Steps) -> Scenario:
    """While a car stands where the train began, its last antenna has not passed both tags behind it (T2, T6)."""
    scenario, run, second = _with_its_tail_at_the_boundary(steps)
    scenario.refuses("tail_reads", **running.tail_read(scenario, run, second))
    return scenario


def a_head_that_was_elsewhere_has_not_gone_on(steps: Steps) -> Scenario:
    """A run whose way leads over the boundary counts only once its head has been in what lies beyond it (T2)."""
    scenario, runs = telling.recovered(steps, standing(WEST))
    run = setting.set_route(scenario, T1, WEST_TO_ONE, runs[T1])
    ahead = setting.set_route(scenario, T1, ONE_TO_EAST, run)
    running.roll(scenario, run)
    running.pass_boundary(scenario, run, WEST, THROAT)
    later = Run(Serial(ahead.serial + 1), T1, ahead.life, WEST_TO_TWO)
    _has_gone_on(scenario, later, scenario.site.formation.front[run], ONE)
    for tag in running.pair(scenario.site.layout, WEST, THROAT):
        scenario.does("tail_reads", **running.tail_read(scenario, run, tag))
    scenario.must((ahead, WEST) not in scenario.system.track.gone, "no head went on from there under it")
    return scenario


def a_head_that_went_another_way_has_not_gone_on(steps: Steps) -> Scenario:
    """Blocks that meet twice: a run that led into the next one over the other boundary went on over that one (T2)."""
    scenario, runs = telling.recovered(steps, standing(WEST))
    run = setting.set_route(scenario, T1, WEST_TO_ONE, runs[T1])
    ahead = setting.set_route(scenario, T1, ONE_TO_EAST, run)
    running.roll(scenario, run)
    running.pass_boundary(scenario, run, WEST, THROAT)
    later = Run(Serial(ahead.serial + 1), T1, ahead.life, WEST_TO_TWO)
    _has_gone_on(scenario, later, scenario.site.formation.front[run], THROAT)
    layout = scenario.site.layout
    first, second = running.pair(layout, WEST, THROAT)
    scenario.does("tail_reads", **running.tail_read(scenario, run, first))
    other = replace(scenario.site, layout=replace(layout, tag_after={**layout.tag_after, WEST_TO_TWO: {}}))
    after = scenario.steps["tail_reads"](other, scenario.system, **running.tail_read(scenario, run, second))
    scenario.must((ahead, WEST) not in after.track.gone, "its head went on from there by other tags")
    return scenario


def _has_gone_on(scenario: Scenario, run: Run, leads: Cab, block: Block) -> None:
    """History is given: under such a run, led by that cab, a head has been in a block."""
    formation, track = scenario.site.formation, scenario.system.track
    front = {each: formation.front[each] for each in scenario.system.centre.runs} | {run: leads}
    scenario.site = replace(scenario.site, formation=replace(formation, front=front))
    scenario.system = replace(scenario.system, track=replace(track, entered=track.entered | {(run, block)}))


def a_train_backs_out_of_three_blocks(steps: Steps) -> Scenario:
    """A train that turns astride leaves the blocks of the way in one after the other, the farthest first (T2, T6)."""
    scenario, runs = telling.recovered(steps, standing(ONE))
    out, back = _turned_astride(scenario, runs[T1])
    running.head_passes(scenario, back, ONE, THROAT)
    for block, target in pairwise((EAST, OUTLET, ONE)):
        for car in (A2, A1):
            if block in scenario.system.track.at[car]:
                running.enters(scenario, back, car, block, target)
                running.leaves(scenario, car, block)
        running.tail_passes(scenario, back, block, target)
        running.report(scenario, out, block, target)
    return scenario


def a_farther_block_that_was_not_seen_left_keeps_the_nearer(steps: Steps) -> Scenario:
    """A tail that comes back and misses the tags of the farthest block leaves none before it: it may be there (T2)."""
    scenario, runs = telling.recovered(steps, standing(ONE))
    out, back = _turned_astride(scenario, runs[T1])
    running.head_passes(scenario, back, ONE, THROAT)
    for car in (A2, A1):
        for block, target in pairwise((EAST, OUTLET, ONE)):
            if block in scenario.system.track.at[car]:
                running.enters(scenario, back, car, block, target)
                running.leaves(scenario, car, block)
    running.tail_passes(scenario, back, OUTLET, ONE)
    scenario.refuses("send_tail_report", **running.reported(scenario, out, OUTLET, ONE))
    return scenario


def _turned_astride(scenario: Scenario, stands: Run) -> tuple[Run, Run]:
    """A train over track one, the outlet and the east has turned; the run that it came under, and the way back."""
    out = setting.set_route(scenario, T1, ONE_TO_EAST, stands)
    running.roll(scenario, out)
    for block, target in pairwise((ONE, OUTLET, EAST)):
        running.head_passes(scenario, out, block, target)
    running.leaves(scenario, A1, ONE)
    running.enters(scenario, out, A2, ONE, OUTLET)
    running.rest(scenario, out)
    back = setting.set_route(scenario, T1, ONE_TO_WEST, stands)
    running.roll(scenario, back)
    return out, back


def a_train_runs_where_another_was_let_run(steps: Steps) -> Scenario:
    """Both tags at the end of a block are read by whoever runs there, though another train was permitted to (T5)."""
    scenario, runs = telling.recovered(steps, {**standing(TWO), B1: frozenset({ONE})})
    given_back = setting.set_route(scenario, T2, ONE_TO_EAST, runs[T2])
    setting.recall(scenario, given_back)
    setting.return_it(scenario, given_back)
    _goes(scenario, setting.set_route(scenario, T2, ONE_TO_WEST, runs[T2]), runs[T2], ONE, THROAT, WEST)
    out = setting.set_route(scenario, T1, TWO_TO_EAST, runs[T1])
    _goes(scenario, out, runs[T1], TWO, OUTLET, EAST)
    back = setting.set_route(scenario, T1, EAST_TO_ONE, out)
    _goes(scenario, back, out, EAST, OUTLET, ONE)
    run = setting.set_route(scenario, T1, ONE_TO_EAST, back)
    running.roll(scenario, run)
    running.head_passes(scenario, run, ONE, OUTLET)
    return scenario


def _goes(scenario: Scenario, run: Run, base: Run, start: Block, *blocks: Block) -> None:
    """A train runs through, and all that it leaves is released, also of the run that it began from."""
    running.run_through(scenario, run, start, *blocks)
    running.report(scenario, base, start, blocks[0])
    for block, target in pairwise((start, *blocks)):
        running.report(scenario, run, block, target)


def a_train_that_backs_out_leaves_what_it_came_into(steps: Steps) -> Scenario:
    """A tail that leaves a block with the other cab ahead leaves it also for the run that the train came in by (T2)."""
    scenario, runs = telling.recovered(steps, standing(WEST))
    run = setting.set_route(scenario, T1, WEST_TO_ONE, runs[T1])
    running.run_through(scenario, run, WEST, THROAT, ONE)
    running.report(scenario, runs[T1], WEST, THROAT)
    for block, target in ((WEST, THROAT), (THROAT, ONE)):
        running.report(scenario, run, block, target)
    back = setting.set_route(scenario, T1, ONE_TO_WEST, run)
    running.run_through(scenario, back, ONE, THROAT)
    running.report(scenario, run, ONE, THROAT)
    return scenario


def a_train_has_not_stood_where_its_run_has_yet_to_lead(steps: Steps) -> Scenario:
    """A train that stands in its destination before it has run there, or has turned, may slip when it comes (T9)."""
    scenario, runs = telling.recovered(steps, standing(WEST))
    run = setting.set_route(scenario, T1, WEST_TO_ONE, runs[T1])
    running.roll(scenario, run)
    there = scenario.system.track.at | {A1: frozenset({ONE}), A2: frozenset({ONE})}
    facing = scenario.system.track.facing
    other = next(scenario.site.formation.cab[car] for car in (A1, A2) if scenario.site.formation.cab[car] != facing[T1])
    for leads, entered in (
        (facing[T1], ()),
        (facing[T1], ((runs[T1], ONE),)),
        (facing[T1], ((run, THROAT),)),
        (other, ((run, ONE),)),
    ):
        track = replace(scenario.system.track, at=there, entered=frozenset(entered), facing=facing | {T1: leads})
        made = replace(scenario.system, track=track)
        after = scenario.steps["note_stopped"](scenario.site, made, run=run, **INSIDE)
        scenario.must(run not in after.track.stood, "it has not stood in its destination under this run")
        slips = scenario.steps["overrun"](scenario.site, after, run=run)
        scenario.must(run in slips.track.slipping, "it may slip yet")
    return scenario


def a_train_that_may_still_creep_has_not_stopped(steps: Steps) -> Scenario:
    """A speed that may be above a standstill, either way, or a brake that is not on, holds no train (T9)."""
    scenario, runs = telling.recovered(steps, standing(WEST))
    run = setting.set_route(scenario, T1, WEST_TO_ONE, runs[T1])
    running.run_through(scenario, run, WEST, THROAT, ONE)
    unknown, creeps, rolls_back = (
        replace(AT_REST, **said) for said in ({"known": False}, {"speed_most_mm_s": 1}, {"speed_least_mm_s": -1})
    )
    for at in (unknown, creeps, rolls_back, NOT_HELD):
        scenario.refuses("note_stopped", run=run, **{**INSIDE, "at": at})
    for elsewhere in (ON_THE_WAY, BEYOND):
        scenario.refuses("note_stopped", run=run, **elsewhere)
    before = scenario.system
    scenario.does("window_passes", train=T1)
    scenario.does("note_stopped", {"track": {"stood": came(run)}}, run=run, **INSIDE)
    scenario.system = before
    scenario.does("note_stopped", run=run, **INSIDE)
    return scenario


def a_run_that_a_train_rolled_back_out_of_is_given_back(steps: Steps) -> Scenario:
    """A head that missed both tags and rolled back has not begun its run, and keeps out of it once it is held (T9)."""
    scenario, runs = telling.recovered(steps, standing(WEST))
    run = setting.set_route(scenario, T1, WEST_TO_ONE, runs[T1])
    running.roll(scenario, run)
    first = running.in_order(scenario, run)[0]
    running.enters(scenario, run, first, WEST, THROAT)
    running.leaves(scenario, first, THROAT)
    running.rest(scenario, run)
    setting.recall(scenario, run)
    setting.return_it(scenario, run)
    return scenario


def an_antenna_within_the_train_proves_nothing(steps: Steps) -> Scenario:
    """Only what the last car's antenna reads, behind the cab at the head, binds the cars behind it (T2, T3)."""
    middle = Car("a3")
    site = site_of(PASSING_PLACE, {T1: (A1, middle, A2), T2: (B1,)})
    at = {A1: WEST, middle: WEST, A2: WEST, B1: TWO}
    scenario = Scenario(steps, site, standing_at(site, {car: frozenset({block}) for car, block in at.items()}, {}))
    runs = telling.all_tell(scenario)
    telling.hear_terminals(scenario)
    telling.recover(scenario)
    run = setting.set_route(scenario, T1, WEST_TO_ONE, runs[T1])
    running.roll(scenario, run)
    running.head_passes(scenario, run, WEST, THROAT)
    backward = telling.next_run(scenario, T1, ONE_TO_WEST)
    before = scenario.system
    _reads_a_pair_unbound(scenario, run, middle)
    scenario.system = before
    running.rest(scenario, run)
    scenario.does("change_ends", train=T1, cab=site.formation.cab[middle])
    _reads_a_pair_unbound(scenario, backward, A1)
    return scenario


def _reads_a_pair_unbound(scenario: Scenario, run: Run, car: Car) -> None:
    """A car's antenna reads both tags behind the west over a line that is not healthy, with cars still in the west."""
    event = {"run": run, "car": car, "cab": scenario.site.formation.cab[car]}
    before = scenario.system
    for line in (BROKEN, replace(WHOLE, is_intact=False), replace(WHOLE, fits=False)):
        scenario.system = before
        for tag in running.pair(scenario.site.layout, WEST, THROAT):
            half = replace(scenario.system.units[T1], tail_read=Read(STRAY, Record("foreign")))
            scenario.system = replace(scenario.system, units=scenario.system.units | {T1: half})
            read = running.genuine(scenario, tag)
            scenario.does("tail_reads", {"units": {T1: {"tail_read": None}}}, line=line, read=read, **event)


def an_isolated_unit_has_forgotten_all_but_its_life(steps: Steps) -> Scenario:
    """A unit that restarts or is isolated, astray, begins a new life in which nothing is left of the old one (T8)."""
    scenario, runs = telling.recovered(steps, standing(WEST))
    scenario.does("change_ends", train=T1, cab=scenario.site.formation.cab[A1])
    halved = replace(scenario.system.units[T1], tail_read=Read(STRAY, Record("half a pair")))
    scenario.system = replace(scenario.system, units=scenario.system.units | {T1: halved})
    scenario.does("window_passes", train=T1)
    epoch, life, there = scenario.system.centre.epoch, UnitLife(runs[T1].life + 1), frozenset({WEST})
    nothing: dict[str, object] = {
        "life": life,
        "answered": None,
        "standing_in": frozenset(),
        "isolated_in": epoch,
        "orders": {runs[T1]: GONE},
        "loop_open": False,
        "leading": None,
        "tail_read": None,
        "occupied": frozenset(),
    }
    before = scenario.system
    restarted = {name: value for name, value in nothing.items() if name != "isolated_in"}
    scenario.does("restart_unit", {"units": {T1: restarted}}, train=T1, life=life)
    scenario.system = before
    effect = {"units": {T1: nothing}, "radio": {"statements": {(T1, life, epoch): there}}}
    scenario.does("take_over", effect, train=T1, epoch=epoch, life=life, blocks=there)
    return scenario
