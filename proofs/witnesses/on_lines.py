"""Attacks, each played the same way on every layout that has the track for it: a refusal, or a braked train (T2 to T9).

What an attack tries is said by ``refuses``: the system does not go along.  A kernel that lacks the guard does,
and is played on until a safety claim breaks (:mod:`proofs.planted.attacked`).
"""

from __future__ import annotations

import inspect
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

from kernel.machine.centre import NO_ROUTE
from kernel.names import Block, Epoch, Route, Run, Stage, UnitLife
from kernel.refusal import Refusal
from models.simulator.senses import AT_REST, INSIDE, ROLLING
from models.world.state import System
from proofs.witnesses.changes import came
from proofs.witnesses.lines import LINES, Line, Loop, boundaries, line_on, released
from proofs.witnesses.restarts import state
from proofs.witnesses.running import (
    enters,
    head_passes,
    in_order,
    leaves,
    pair,
    pass_boundary,
    pass_through,
    report,
    reported,
    rest,
    roll,
    tail_passes,
    tail_reads_first,
)
from proofs.witnesses.scenario import Scenario, Steps
from proofs.witnesses.setting import (
    at_stage,
    close_first_loop,
    holds,
    keep,
    open_first_loop,
    prove_all,
    recall,
    reserve,
    return_it,
    set_route,
)
from proofs.witnesses.stations import T1, T2
from proofs.witnesses.telling import all_tell, hear_terminals, next_run, recover

Script = Callable[[Scenario, Line], None]


@dataclass(frozen=True)
class Attack:
    """One attack: its script, and where its trains stand at the start.

    ``on_a_loop``: whether the track must lead round; where it does not, no train comes back to a block from behind.
    """

    script: Script
    stands: Callable[[Line], System]
    on_a_loop: bool = False

    @property
    def name(self) -> str:
        """Its name."""
        return self.script.__name__

    def fits(self, line: Line) -> bool:
        """Tell whether a layout has the track for it."""
        return line.loop is not None or not self.on_a_loop

    def played(self, line: Line, steps: Steps) -> Scenario:
        """Play it on a layout."""
        scenario = Scenario(steps, line.site, self.stands(line))
        self.script(scenario, line)
        return scenario


def ready(scenario: Scenario) -> tuple[Run, Run]:
    """Every train tells where it stands, and what is lost is found again; the runs that stand for both."""
    runs = all_tell(scenario)
    hear_terminals(scenario)
    recover(scenario)
    return runs[T1], runs[T2]


def claims_nothing_of(scenario: Scenario, block: Block, target: Block, *runs: Run) -> None:
    """The unit reports no exit out of a block under these runs, and the centre hears of none."""
    for run in runs:
        scenario.refuses("send_tail_report", **reported(scenario, run, block, target))
        scenario.refuses("release_block", **reported(scenario, run, block, target))


def the_tail_frees_no_block_ahead(scenario: Scenario, line: Line) -> None:
    """A tail that leaves the block in which its own run will end frees it for the run before, not for this one (T6).

    The other train gets no route there, since the first one is still to come.
    """
    loop = _loop_of(line)
    standing, other = ready(scenario)
    way, behind = line.blocks(loop.round), line.blocks(loop.home)
    run = _frees_nothing_under_its_own_run(scenario, line, standing, way[:2])
    if run is None:
        return
    _, rear = in_order(scenario, run)
    for block, target in boundaries(behind[1:]):
        enters(scenario, run, rear, block, target)
        leaves(scenario, rear, block)
        tail_passes(scenario, run, block, target)
        report(scenario, standing, block, target)
    _runs_on(scenario, line, run, standing)
    recover(scenario)
    wanted = next_run(scenario, T2, loop.rival)
    beside = way[-1] not in scenario.site.layout.claims[loop.rival]
    why = Refusal.FOULING_BLOCK_HELD if beside else Refusal.BLOCK_HELD_FOR_ANOTHER
    scenario.refuses("request", why, run=wanted, base=other)
    pass_through(scenario, run, *way[way.index(loop.past) :])
    rest(scenario, run)


def _runs_on(scenario: Scenario, line: Line, run: Run, standing: Run) -> None:
    """The train draws its cars out of its start block and comes as far as the rival's route allows."""
    loop = _loop_of(line)
    way = line.blocks(loop.round)
    for car in in_order(scenario, run):
        enters(scenario, run, car, way[0], way[1])
        leaves(scenario, car, way[0])
    tail_passes(scenario, run, way[0], way[1])
    report(scenario, standing, way[0], way[1])
    come = way.index(loop.past)
    for block, target in boundaries(way[1 : come + 1]):
        pass_boundary(scenario, run, block, target)
    for block in released(scenario.site.layout, run.route, way[:come]):
        report(scenario, run, block, way[way.index(block) + 1])


def a_head_that_has_come_round_keeps_its_block(scenario: Scenario, line: Line) -> None:
    """A train as long as its loop: no run is set round into its tail, and such a tail leaves no block for it (T2, T9).

    It is left for the run before, and stays held for the one under which the head is there.
    """
    standing, _ = ready(scenario)
    way = line.blocks(_loop_of(line).round)
    if _frees_nothing_under_its_own_run(scenario, line, standing, way) is not None:
        scenario.must(way[-1] in scenario.system.units[T1].occupied, "the unit knows that its head is there")


def _set_over_itself(scenario: Scenario, route: Route, base: Run) -> Run | None:
    """No run is set over a block that its own train holds already; without that guard, the run."""
    run = next_run(scenario, T1, route)
    scenario.refuses("request", Refusal.NOT_CLEAR_OF_ITS_OWN_TRAIN, run=run, base=base)
    if run not in scenario.system.centre.runs:
        return None
    prove_all(scenario, run)
    close_first_loop(scenario, run)
    return run


def _frees_nothing_under_its_own_run(
    scenario: Scenario, line: Line, standing: Run, ahead: Sequence[Block]
) -> Run | None:
    """The head goes through the blocks ahead; the tail leaves the last of the way round, for the run before alone."""
    loop = _loop_of(line)
    run = _set_over_itself(scenario, loop.round, standing)
    if run is None:
        return None
    roll(scenario, run)
    end, target = line.blocks(loop.home)[:2]
    _, rear = in_order(scenario, run)
    for block, beyond in boundaries(ahead):
        head_passes(scenario, run, block, beyond)
    enters(scenario, run, rear, end, target)
    leaves(scenario, rear, end)
    tail_passes(scenario, run, end, target)
    claims_nothing_of(scenario, end, target, run)
    report(scenario, standing, end, target)
    holds(scenario, end, run)
    return run


def a_read_from_the_lap_before_pairs_with_nothing(scenario: Scenario, line: Line) -> None:
    """A tail that misses every tag of a lap: no way home is set, no second lap, nor does its first read pair (T2, T9).

    The train would be longer than a block and have its next run by then, its head out of the block already.
    """
    loop = _loop_of(line)
    standing, _ = ready(scenario)
    way, home = line.blocks(loop.round), line.blocks(loop.home)
    end, before = way[-1], way[-2]
    runs = [set_route(scenario, T1, loop.round, standing)]
    roll(scenario, runs[0])
    _passes_unread(scenario, runs[0], *way[:-1])
    pass_boundary(scenario, runs[0], before, end)
    rest(scenario, runs[0])
    homeward = _set_over_itself(scenario, loop.home, runs[-1])
    if homeward is None:
        return
    runs.append(homeward)
    roll(scenario, runs[-1])
    _passes_unread(scenario, runs[-1], *home)
    rest(scenario, runs[-1])
    again = next_run(scenario, T1, loop.round)
    scenario.refuses("request", Refusal.START_IS_RUN_THROUGH, run=again, base=runs[-1])
    if again not in scenario.system.centre.runs:
        return
    prove_all(scenario, again)
    close_first_loop(scenario, again)
    runs.append(again)
    roll(scenario, again)
    _passes_unread(scenario, again, *way[:-1])
    onward = _set_over_itself(scenario, loop.home, runs[-1])
    if onward is None:
        return
    runs.append(onward)
    roll(scenario, runs[-1])
    front, rear = in_order(scenario, runs[-1])
    head_passes(scenario, runs[-2], before, end)
    head_passes(scenario, runs[-1], end, home[1])
    enters(scenario, runs[-2], rear, before, end)
    leaves(scenario, front, before)
    tail_reads_first(scenario, runs[-1], pair(scenario.site.layout, before, end)[0])
    first, second, last, _ = runs
    claims_nothing_of(scenario, end, before, first, second, onward, last)
    holds(scenario, end, *runs)
    leaves(scenario, rear, before)


def _passes_unread(scenario: Scenario, run: Run, *blocks: Block) -> None:
    """The head reads every tag, and the tail none."""
    for block, target in boundaries(blocks):
        head_passes(scenario, run, block, target)
        for car in in_order(scenario, run):
            enters(scenario, run, car, block, target)
            leaves(scenario, car, block)


def a_read_from_before_two_turns_pairs_with_nothing(scenario: Scenario, line: Line) -> None:
    """A train turns twice astride a boundary: what its tail read before pairs with nothing that it reads after (T2)."""
    standing, _ = ready(scenario)
    there = line.blocks(line.out)
    out = set_route(scenario, T1, line.out, standing)
    roll(scenario, out)
    pass_through(scenario, out, *there)
    rest(scenario, out)
    report(scenario, standing, *there[:2])
    for block, target in boundaries(there):
        report(scenario, out, block, target)
    back = set_route(scenario, T1, line.back, out)
    roll(scenario, back)
    end, before = there[-1], there[-2]
    head_passes(scenario, back, end, before)
    rest(scenario, back)
    on = set_route(scenario, T1, line.on, back)
    roll(scenario, on)
    tail_reads_first(scenario, on, pair(scenario.site.layout, before, end)[0])
    claims_nothing_of(scenario, end, before, back, on, out)
    holds(scenario, end, out, back, on)
    leaves(scenario, in_order(scenario, on)[-1], before)


def a_train_that_rolls_in_gives_nothing_back(scenario: Scenario, line: Line) -> None:
    """Asked for a run that its brake no longer keeps it out of, a train keeps it, and the blocks stay its own (T9).

    It keeps it too while it moves, though its brake holds the end before it, and where it may have overrun that end.
    """
    standing, _ = ready(scenario)
    there = line.blocks(line.out)
    run = set_route(scenario, T1, line.out, standing)
    roll(scenario, run)
    recall(scenario, run)
    scenario.does("recall", {"units": {T1: {"orders": {run: {"recalled": True}}}}}, run=run)
    scenario.refuses("give_back", run=run, at=AT_REST, held_end_mm=1, start_end_mm=0)
    scenario.refuses("give_back", run=run, at=ROLLING, held_end_mm=0, start_end_mm=0)
    scenario.refuses("give_back", run=run, at=AT_REST, held_end_mm=-1, start_end_mm=-1)
    scenario.refuses("send_return", run=run)
    scenario.refuses("note_given_back", run=run)
    holds(scenario, there[1], run)
    head_passes(scenario, run, there[0], there[1])
    rest(scenario, run)
    scenario.refuses("give_back", run=run, at=AT_REST, held_end_mm=0, start_end_mm=0)


def a_run_that_another_leads_on_from_is_asked_back_last(scenario: Scenario, line: Line) -> None:
    """With a run set ahead the nearer one is not asked back, so that no authority lies beyond what is nobody's (T9)."""
    standing, _ = ready(scenario)
    run = set_route(scenario, T1, line.out, standing)
    onward = set_route(scenario, T1, line.on, run)
    scenario.refuses("cancel", Refusal.A_RUN_LEADS_ON, run=run)
    scenario.refuses("send_recall", run=run)
    recall(scenario, onward)
    return_it(scenario, onward)
    recall(scenario, run)
    return_it(scenario, run)
    at_stage(scenario, run, Stage.OVER)


def a_train_with_another_list_gets_no_permit(scenario: Scenario, line: Line) -> None:
    """A unit with the tags of another route sends those back; the run is not set, and can be taken back (T4, T9)."""
    standing, _ = ready(scenario)
    run = reserve(scenario, T1, line.out, standing)
    prove_all(scenario, run)
    open_first_loop(scenario, run)
    meant, other = (scenario.site.layout.tag_list[route] for route in (line.out, line.on))
    scenario.does("send_offer", {"radio": {"offers": came(run)}}, run=run)
    keep(scenario, run, other)
    scenario.refuses("take_offer", run=run, tag_list=meant)
    scenario.refuses("send_echo", run=run, tag_list=meant)
    scenario.does("send_echo", {"radio": {"echoes": {run: other}}}, run=run, tag_list=other)
    scenario.refuses("note_echo", Refusal.LISTS_DIFFER, run=run)
    scenario.refuses("send_permit", run=run)
    scenario.refuses("take_permit", run=run)
    scenario.refuses("start_rolling", run=run)
    recall(scenario, run)
    return_it(scenario, run)
    at_stage(scenario, run, Stage.OVER)


def two_persons_who_name_two_places_account_for_nothing(scenario: Scenario, line: Line) -> None:
    """The centre noted what was then corrected: the second person confirms another place, and neither counts (T8)."""
    standing, _ = ready(scenario)
    there = line.blocks(line.out)
    life, epoch = UnitLife(3), scenario.system.centre.epoch
    scenario.does("open_procedure", {"centre": {"supervised": came(T1)}}, train=T1)
    state(scenario, life, epoch, frozenset({there[-1]}))
    event = {"train": T1, "epoch": epoch, "life": life}
    corrected = {"radio": {"statements": {(T1, life, epoch): frozenset({there[0]})}}}
    scenario.does("correct_statement", corrected, blocks=frozenset({there[0]}), **event)
    scenario.does("confirm_statement", **event, blocks=frozenset({there[0]}))
    run = next_run(scenario, T1, NO_ROUTE, life)
    scenario.refuses("note_statement_confirmed", Refusal.STATEMENTS_DIFFER, run=run, **event)
    holds(scenario, there[0], standing)


def a_way_back_is_set_once_the_way_in_is_clear(scenario: Scenario, line: Line) -> None:
    """Until the tail has told that it left the way in, no way back is set: cars may have parted there (T2, T9)."""
    standing, _ = ready(scenario)
    there = line.blocks(line.out)
    out = set_route(scenario, T1, line.out, standing)
    roll(scenario, out)
    if (early := _set_over_itself(scenario, line.back, out)) is not None:
        roll(scenario, early)
    pass_through(scenario, out, *there)
    rest(scenario, out)
    back = next_run(scenario, T1, line.back)
    scenario.refuses("request", Refusal.NOT_CLEAR_OF_ITS_OWN_TRAIN, run=back, base=out)
    report(scenario, standing, *there[:2])
    for block in released(scenario.site.layout, out.route, there[:-1]):
        report(scenario, out, block, there[there.index(block) + 1])
    back = set_route(scenario, T1, line.back, out)
    roll(scenario, back)
    pass_through(scenario, back, *there[::-1])
    scenario.must(not scenario.system.units[T1].loop_open, "every tag was the expected one")


def a_train_that_has_turned_frees_no_overlap(scenario: Scenario, line: Line) -> None:
    """Once it has arrived and changed ends its other end may lie in the overlap: its front says nothing of it (T9)."""
    standing, _ = ready(scenario)
    out = set_route(scenario, T1, line.out, standing)
    roll(scenario, out)
    pass_through(scenario, out, *line.blocks(line.out))
    rest(scenario, out)
    led, cabs = scenario.site.formation.front[out], scenario.site.formation.carried_by
    other = next(cab for cab, car in cabs.items() if cab != led and scenario.site.formation.train_of[car] == T1)
    scenario.does("change_ends", train=T1, cab=other)
    scenario.refuses("note_stopped", run=out, **INSIDE)
    scenario.refuses("send_stop", run=out)
    scenario.does("change_ends", train=T1, cab=led)
    scenario.does("note_stopped", run=out, **INSIDE)


def a_life_stated_before_the_centre_restarted_is_stated_no_more(scenario: Scenario, line: Line) -> None:
    """A centre that has restarted has forgotten what it granted that life: the unit must be isolated anew (T8)."""
    ready(scenario)
    there, life, epoch = frozenset(line.blocks(line.out)[:1]), UnitLife(3), scenario.system.centre.epoch
    scenario.does("open_procedure", train=T1)
    state(scenario, life, epoch, there)
    event = {"train": T1, "epoch": epoch, "life": life}
    scenario.does("confirm_statement", **event, blocks=there)
    scenario.does("note_statement_confirmed", run=next_run(scenario, T1, NO_ROUTE, life), **event)
    later = Epoch(epoch + 1)
    scenario.does("restart_centre", epoch=later)
    scenario.does("send_challenge", epoch=later)
    scenario.does("open_procedure", train=T1)
    scenario.refuses("note_statement", **event)
    scenario.refuses("correct_statement", train=T1, epoch=later, life=life, blocks=there)
    scenario.refuses("take_over", train=T1, epoch=later, life=life, blocks=there)
    state(scenario, UnitLife(4), later, there)


def _loop_of(line: Line) -> Loop:
    """The loop of a layout that has one."""
    assert line.loop is not None, f"{line.name} has no loop"
    return line.loop


ATTACKS: Mapping[str, Attack] = {
    attack.name: attack
    for attack in (
        Attack(the_tail_frees_no_block_ahead, Line.astride_the_loop, on_a_loop=True),
        Attack(a_head_that_has_come_round_keeps_its_block, Line.astride_the_loop, on_a_loop=True),
        Attack(a_read_from_the_lap_before_pairs_with_nothing, Line.on_the_loop, on_a_loop=True),
        Attack(a_read_from_before_two_turns_pairs_with_nothing, Line.in_the_open),
        Attack(a_train_that_rolls_in_gives_nothing_back, Line.in_the_open),
        Attack(a_run_that_another_leads_on_from_is_asked_back_last, Line.in_the_open),
        Attack(a_train_with_another_list_gets_no_permit, Line.in_the_open),
        Attack(two_persons_who_name_two_places_account_for_nothing, Line.in_the_open),
        Attack(a_way_back_is_set_once_the_way_in_is_clear, Line.in_the_open),
        Attack(a_train_that_has_turned_frees_no_overlap, Line.in_the_open),
        Attack(a_life_stated_before_the_centre_restarted_is_stated_no_more, Line.in_the_open),
    )
}
"""By name; each docstring says what is tried, and which requirement stops it."""


def _witness(attack: Attack, line: str) -> Callable[[Steps], Scenario]:
    """An attack on a station made for it, as a witness."""

    def witness(steps: Steps) -> Scenario:
        return attack.played(line_on(line), steps)

    witness.__name__ = f"on_{line}_{attack.name}"
    witness.__doc__ = inspect.getdoc(attack.script)
    return witness


WITNESSES: Mapping[str, Callable[[Steps], Scenario]] = {
    witness.__name__: witness for line in LINES for attack in ATTACKS.values() for witness in (_witness(attack, line),)
}
"""Every attack on every station made for it."""
