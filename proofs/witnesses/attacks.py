"""Witnesses of attacks on one station: what once freed a block around a train ends in a refusal (T2, T4, T5).

:mod:`proofs.witnesses.on_lines` has those that are played on every layout.
"""

from __future__ import annotations

from kernel.names import Stage
from kernel.refusal import Refusal
from proofs.witnesses.changes import came
from proofs.witnesses.running import (
    enters,
    head_cab,
    head_passes,
    leaves,
    pair,
    pass_boundary,
    report,
    reported,
    rest,
    roll,
    tail_read,
    tail_reads_first,
)
from proofs.witnesses.scenario import Scenario, Steps
from proofs.witnesses.setting import (
    at_stage,
    holds,
    keep,
    open_first_loop,
    prove_all,
    recall,
    reserve,
    return_it,
    set_route,
)
from proofs.witnesses.stations import (
    A1,
    A2,
    B1,
    EAST,
    HERE,
    MIDDLE,
    MIDDLE_TO_NORTH,
    MIDDLE_TO_SOUTH,
    NORTH,
    NORTH_TO_MIDDLE,
    PLAIN_LINE,
    T1,
    WEST,
    WEST_TO_ONE,
    WEST_TO_TWO,
)
from proofs.witnesses.telling import recovered

IN_THE_NORTH = {A1: frozenset({NORTH}), A2: frozenset({NORTH}), B1: frozenset({HERE})}


def a_read_from_before_two_changes_of_ends_pairs_with_nothing(steps: Steps) -> Scenario:
    """A train turns twice astride a boundary: what its tail read before pairs with nothing that it reads after (T2)."""
    scenario, runs = recovered(steps, IN_THE_NORTH, station=PLAIN_LINE)
    out = set_route(scenario, T1, NORTH_TO_MIDDLE, runs[T1])
    roll(scenario, out)
    pass_boundary(scenario, out, NORTH, MIDDLE)
    rest(scenario, out)
    for run in (runs[T1], out):
        report(scenario, run, NORTH, MIDDLE)
    back = set_route(scenario, T1, MIDDLE_TO_NORTH, out)
    roll(scenario, back)
    head_passes(scenario, back, MIDDLE, NORTH)
    rest(scenario, back)
    on = set_route(scenario, T1, MIDDLE_TO_SOUTH, back)
    roll(scenario, on)
    enters(scenario, on, A2, NORTH, MIDDLE)
    leaves(scenario, A2, NORTH)
    tail_reads_first(scenario, on, pair(scenario.site.layout, NORTH, MIDDLE)[0])
    for run in (out, back, on):
        scenario.refuses("send_tail_report", **reported(scenario, run, MIDDLE, NORTH))
    holds(scenario, MIDDLE, out, back, on)
    return scenario


def a_run_back_permitted_before_the_arrival_keeps_its_loop(steps: Steps) -> Scenario:
    """The tag at which a way in ends begins the way back: read on the way in, it counts for the way in alone (T5)."""
    scenario, runs = recovered(steps, IN_THE_NORTH, station=PLAIN_LINE)
    out = set_route(scenario, T1, NORTH_TO_MIDDLE, runs[T1])
    back = set_route(scenario, T1, MIDDLE_TO_NORTH, out)
    roll(scenario, out)
    pass_boundary(scenario, out, NORTH, MIDDLE)
    rest(scenario, out)
    roll(scenario, back)
    pass_boundary(scenario, back, MIDDLE, NORTH)
    scenario.must(not scenario.system.units[T1].loop_open, "every tag was the expected one")
    report(scenario, back, MIDDLE, NORTH)
    return scenario


def a_tag_missed_by_the_head_is_overdue_before_the_tail_comes(steps: Steps) -> Scenario:
    """A head that reads nothing at a boundary: the tag is overdue, and what the tail reads there frees nothing (T5)."""
    scenario, runs = recovered(steps, IN_THE_NORTH, station=PLAIN_LINE)
    out = set_route(scenario, T1, NORTH_TO_MIDDLE, runs[T1])
    roll(scenario, out)
    first, second = pair(scenario.site.layout, NORTH, MIDDLE)
    scenario.does("head_misses", {"track": {"unread": came(T1)}}, train=T1, tag=first)
    for car in (A1, A2):
        enters(scenario, out, car, NORTH, MIDDLE)
    for car in (A1, A2):
        leaves(scenario, car, NORTH)
    scenario.refuses("tail_reads", **tail_read(scenario, out, first))
    scenario.does("window_passes", train=T1)
    tail_reads_first(scenario, out, first)
    scenario.does("tail_reads", **tail_read(scenario, out, second))
    for run in (runs[T1], out):
        scenario.refuses("send_tail_report", **reported(scenario, run, NORTH, MIDDLE))
    rest(scenario, out)
    scenario.refuses("start_rolling", run=out)
    scenario.must(head_cab(scenario, out) == scenario.system.units[T1].leading, "the unit still knows its ends")
    return scenario


def a_train_that_keeps_another_list_gets_no_permit(steps: Steps) -> Scenario:
    """A unit with the tags of another route sends those back; the run is not set, and can be taken back (T4, T9)."""
    scenario, runs = recovered(steps, {A1: frozenset({WEST}), A2: frozenset({WEST}), B1: frozenset({EAST})})
    run = reserve(scenario, T1, WEST_TO_ONE, runs[T1])
    prove_all(scenario, run)
    open_first_loop(scenario, run)
    meant, other = (scenario.site.layout.tag_list[route] for route in (WEST_TO_ONE, WEST_TO_TWO))
    scenario.does("send_offer", {"radio": {"offers": came(run)}}, run=run)
    keep(scenario, run, other)
    scenario.refuses("take_offer", run=run, tag_list=meant)
    scenario.refuses("send_echo", run=run, tag_list=meant)
    scenario.does("send_echo", {"radio": {"echoes": {run: other}}}, run=run, tag_list=other)
    scenario.refuses("note_echo", Refusal.LISTS_DIFFER, run=run)
    scenario.refuses("send_permit", run=run)
    scenario.refuses("start_rolling", run=run)
    recall(scenario, run)
    return_it(scenario, run)
    at_stage(scenario, run, Stage.OVER)
    return scenario
