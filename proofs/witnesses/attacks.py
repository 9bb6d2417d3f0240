"""Witnesses of attacks on one station: what once freed a block around a train ends in a refusal (T2, T4, T5).

:mod:`proofs.witnesses.on_lines` has those that are played on every layout.
"""

from __future__ import annotations

from dataclasses import replace

from kernel.names import Stage, Tag, UnitLife
from kernel.refusal import Refusal
from models.simulator.senses import WHOLE
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
    tail_passes,
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
    ONE,
    PLAIN_LINE,
    T1,
    T2,
    THROAT,
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


def a_tag_missed_by_the_head_is_overdue_before_the_tail_comes(steps: Steps) -> Scenario:
    """A head that reads nothing at a boundary: the tag is overdue, and what the tail reads there frees nothing (T5)."""
    scenario, runs = recovered(steps, IN_THE_NORTH, station=PLAIN_LINE)
    out = set_route(scenario, T1, NORTH_TO_MIDDLE, runs[T1])
    roll(scenario, out)
    first, second = pair(scenario.site.layout, NORTH, MIDDLE)
    scenario.does("head_misses", {"track": {"unread": came((T1, first))}}, train=T1, tag=first)
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


def a_tail_reads_on_while_a_missed_tag_is_not_overdue(steps: Steps) -> Scenario:
    """The head has missed a tag: what the tail reads at the boundary before is evidence as ever (T2, T5, T6)."""
    scenario, runs = recovered(steps, {A1: frozenset({WEST}), A2: frozenset({WEST}), B1: frozenset({EAST})})
    run = set_route(scenario, T1, WEST_TO_ONE, runs[T1])
    roll(scenario, run)
    head_passes(scenario, run, WEST, THROAT)
    for car in (A1, A2):
        enters(scenario, run, car, WEST, THROAT)
        leaves(scenario, car, WEST)
    missed, behind = pair(scenario.site.layout, THROAT, ONE)
    scenario.does("head_misses", {"track": {"unread": came((T1, missed))}}, train=T1, tag=missed)
    enters(scenario, run, A1, THROAT, ONE)
    for tag in (missed, behind):
        scenario.refuses("tail_reads", **tail_read(scenario, run, tag))
    tail_passes(scenario, run, WEST, THROAT)
    report(scenario, run, WEST, THROAT)
    return scenario


def a_tail_reads_the_nearer_tag_where_the_farther_was_missed(steps: Steps) -> Scenario:
    """The head has read the first tag of a boundary and missed the second: the tail comes to the first before (T5)."""
    scenario, runs = recovered(steps, {A1: frozenset({WEST}), A2: frozenset({WEST}), B1: frozenset({EAST})})
    run = set_route(scenario, T1, WEST_TO_ONE, runs[T1])
    roll(scenario, run)
    nearer, farther = pair(scenario.site.layout, WEST, THROAT)
    scenario.does("head_reads", train=T1, cab=head_cab(scenario, run), tag=nearer, in_window=True)
    scenario.does("head_misses", {"track": {"unread": came((T1, farther))}}, train=T1, tag=farther)
    for car in (A1, A2):
        enters(scenario, run, car, WEST, THROAT)
    tail_reads_first(scenario, run, nearer)
    leaves(scenario, A1, WEST)
    leaves(scenario, A2, WEST)
    scenario.refuses("tail_reads", **tail_read(scenario, run, farther))
    return scenario


def what_a_head_has_missed_is_awaited_no_longer(steps: Steps) -> Scenario:
    """A tag passed unread is awaited until another is read, ends are changed or a life begins, by its train (T5)."""
    scenario, runs = recovered(steps, {A1: frozenset({WEST}), A2: frozenset({WEST}), B1: frozenset({EAST})})
    run = set_route(scenario, T1, WEST_TO_ONE, runs[T1])
    roll(scenario, run)
    first, _ = pair(scenario.site.layout, WEST, THROAT)
    scenario.does("head_misses", {"track": {"unread": came((T1, first))}}, train=T1, tag=first)
    missed, life = scenario.system, UnitLife(run.life + 1)
    scenario.system = replace(missed, track=replace(missed.track, unread=frozenset({(T2, first)})))
    scenario.must(
        scenario.steps["tail_reads"](scenario.site, scenario.system, **tail_read(scenario, run, first))
        != scenario.system,
        "the other train's miss is nothing to this one",
    )
    scenario.system = replace(missed, track=replace(missed.track, rolling=frozenset()))
    leads, epoch = head_cab(scenario, run), missed.centre.epoch
    behind = next(cab for car, cab in scenario.site.formation.cab.items() if car in (A1, A2) and cab != leads)
    for step, event in (
        ("head_reads", {"cab": leads, "tag": Tag("from elsewhere"), "in_window": True}),
        ("head_reads", {"cab": leads, "tag": first, "in_window": True}),
        ("change_ends", {"cab": behind}),
        ("restart_unit", {"life": life}),
        ("take_over", {"epoch": epoch, "life": life, "blocks": frozenset({WEST})}),
    ):
        after = scenario.steps[step](scenario.site, scenario.system, train=T1, **event)
        scenario.must(not any(True for _ in after.track.unread), f"nothing is awaited after {step}")
    return scenario


def a_tail_whose_line_does_not_fit_reads_over_a_missed_tag(steps: Steps) -> Scenario:
    """Before a tag that the head missed is overdue the tail reads it, which counts for nothing (T2, T5)."""
    scenario, runs = recovered(steps, IN_THE_NORTH, station=PLAIN_LINE)
    out = set_route(scenario, T1, NORTH_TO_MIDDLE, runs[T1])
    roll(scenario, out)
    first, _ = pair(scenario.site.layout, NORTH, MIDDLE)
    scenario.does("head_misses", {"track": {"unread": came((T1, first))}}, train=T1, tag=first)
    for car in (A1, A2):
        enters(scenario, out, car, NORTH, MIDDLE)
    unit = scenario.system.units[T1]
    wide = {**tail_read(scenario, out, first), "line": replace(WHOLE, fits=False)}
    scenario.does("tail_reads", {"track": {"passed": came((T1, first))}}, **wide)
    scenario.must(scenario.system.units[T1] == unit, "the unit takes nothing from it")
    scenario.does("window_passes", train=T1)
    scenario.must(scenario.system.units[T1].loop_open, "the tag is overdue")
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
