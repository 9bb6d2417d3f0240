"""Replays in CPython: the sound kernel holds, a planted fault is found where it was, what is refused is told."""

from __future__ import annotations

from dataclasses import replace

import pytest

from fuzz.failures.replaying import ASSUMED, UNDEFINED, Bench, replay
from fuzz.failures.trace import Event, Trace
from fuzz.failures.words import otherwise, verdict
from kernel.names import Block, Epoch, Point, Position, Route, Run, Serial, Train, UnitLife
from kernel.refusal import Refusal
from models.layouts import BadInput
from models.simulator.senses import AT_REST, WHOLE
from models.world import nature
from proofs.catalogue import INVARIANTS
from tests.fuzz.failures.samples import LAYOUTS, PLANTED, failing, found, imported, traffic

PLACE = "passing_station"


@pytest.mark.parametrize("place", LAYOUTS)
def test_traffic_of_the_sound_kernel_holds_step_by_step(place: str) -> None:
    trace = traffic(place, 3)
    again = replay(trace, imported(place))
    assert not again.reproduced
    assert again.changed == len(trace.events) > 200
    assert again.violated == ()
    assert verdict(again).startswith("not reproduced")
    assert otherwise(again) == ""


@pytest.mark.parametrize("planted", PLANTED)
def test_a_planted_fault_is_found_at_the_step_where_it_was(planted: str) -> None:
    trace = found(planted)
    again = replay(trace, imported(PLANTED[planted][0]))
    assert again.at_step == len(trace.events)
    assert set(again.violated) <= set(INVARIANTS)
    assert again.violated
    assert replay(again.said(), imported(PLANTED[planted][0])).as_told
    sound = replay(replace(trace, planted=None), imported(PLANTED[planted][0]))
    assert not sound.reproduced
    assert otherwise(replay(replace(again.said(), planted=None), imported(PLANTED[planted][0]))) != ""


def test_a_replay_ends_at_the_first_violation() -> None:
    trace = failing()
    longer = replace(trace, events=(*trace.events, *trace.events))
    again = replay(longer, imported(PLACE))
    assert again.at_step == len(trace.events) == len(again.outcomes)
    assert again.said() == trace


def test_a_mutant_of_the_kernel_runs_by_its_name() -> None:
    guard = "if terminal.holds is not None and run.serial <= terminal.holds.serial: terminal"
    name = f"kernel.terminal.obey: guard {guard}"
    trace = replace(failing(), planted=name)
    again = replay(trace, imported(PLACE))
    assert again.reproduced
    assert otherwise(again) == ""


def test_an_unknown_planted_fault_is_refused() -> None:
    with pytest.raises(BadInput, match=r"no planted fault 'kernel\.nothing: guard x'"):
        replay(replace(failing(), planted="kernel.nothing: guard x"), imported(PLACE))


def test_a_refusal_is_told_in_the_words_of_the_kernel() -> None:
    trace = failing()
    train = min(trace.trains)
    run = Run(Serial(1), train, UnitLife(1), Route("nowhere"))
    events = (
        Event("request", {"run": run, "base": run}),
        Event("retire", {"run": run}),
        Event("recover_point", {"point": Point("P1")}),
        Event("withdraw", {"run": run}),
    )
    again = replay(replace(trace, events=events), imported(PLACE))
    assert [outcome.refusal for outcome in again.outcomes] == [
        Refusal.UNKNOWN_ROUTE,
        Refusal.NO_SUCH_RUN,
        Refusal.TRAIN_MISSING,
        None,
    ]
    assert not any(outcome.changed for outcome in again.outcomes)


# ---- beyond nature


def at_the_start() -> tuple[Trace, Train, frozenset[Block]]:
    trace = failing()
    train = min(trace.trains)
    return trace, train, trace.at[trace.trains[train][0]]


def answers(trace: Trace, train: Train, blocks: frozenset[Block], beyond: bool) -> tuple[Event, ...]:
    """A train tells where it stands."""
    life, epoch = UnitLife(2), Epoch(1)
    told = {"train": train, "epoch": epoch, "life": life, "blocks": blocks, "at": AT_REST, "line": WHOLE}
    run = Run(Serial(1), train, life, Route("standing"))
    return (
        Event("send_challenge", {"epoch": epoch}),
        Event("answer", told, "false standstill", beyond),
        Event("send_standing", {"train": train, "epoch": epoch}),
        Event("note_standing", {"train": train, "life": life, "epoch": epoch, "run": run}),
    )


def test_an_event_beyond_an_assumption_is_taken_and_the_assumption_named() -> None:
    trace, train, _ = at_the_start()
    elsewhere = frozenset({Block("east section")})
    again = replay(replace(trace, planted=None, events=answers(trace, train, elsewhere, True)), imported(PLACE))
    assert again.reproduced
    assert again.broken == ("a_located_train_stands_where_it_says",)
    assert again.outcomes[1].broken == again.broken
    assert again.said().broken_assumptions == again.broken


def test_the_same_event_within_nature_does_nothing() -> None:
    trace, train, _ = at_the_start()
    elsewhere = frozenset({Block("east section")})
    again = replay(replace(trace, planted=None, events=answers(trace, train, elsewhere, False)), imported(PLACE))
    assert not again.reproduced
    assert not again.outcomes[1].changed
    assert again.broken == ()


def test_an_event_said_to_be_beyond_that_is_not_breaks_nothing() -> None:
    trace, train, there = at_the_start()
    again = replay(replace(trace, planted=None, events=answers(trace, train, there, True)), imported(PLACE))
    assert not again.reproduced
    assert again.changed == 4
    assert again.broken == ()


def test_a_car_without_authority_moves_only_beyond_nature() -> None:
    trace, train, there = at_the_start()
    route = next(
        route for route in sorted(imported(PLACE).layout.routes) if imported(PLACE).layout.start[route] in there
    )
    block = imported(PLACE).layout.start[route]
    run = Run(Serial(1), train, UnitLife(1), route)
    target = imported(PLACE).layout.way[route][block]
    event = {"run": run, "car": trace.trains[train][0], "block": block, "target": target}
    for beyond in (False, True):
        again = replay(
            replace(trace, planted=None, events=(Event("car_moves", event, "slips", beyond),)), imported(PLACE)
        )
        assert again.outcomes[0].changed is beyond
        nature = ("a_train_obeys_its_authority", "a_train_runs_forward_along_its_run")
        assert sorted(again.broken) == (list(nature) if beyond else [])


def test_the_world_is_left_as_it_was() -> None:
    before = {name: vars(nature).get(name) for name in ASSUMED}
    test_an_event_beyond_an_assumption_is_taken_and_the_assumption_named()
    assert {name: vars(nature).get(name) for name in ASSUMED} == before


def test_a_step_that_looks_up_what_is_not_there_is_a_violation() -> None:
    trace = failing()
    told = trace.events[: [event.step for event in trace.events].index("recover_point")]
    event = Event("recover_point", {"point": Point("no such point")})
    planted = "kernel.recovery.recover_point_refusal: and-operand point in layout.stands_in"
    again = replay(replace(trace, planted=planted, events=(*told, event)), imported(PLACE))
    assert again.violated == (UNDEFINED,)
    assert again.at_step == len(told) + 1
    assert again.outcomes[-1].raised.startswith("KeyError")
    assert not replay(replace(trace, planted=None, events=(*told, event)), imported(PLACE)).reproduced


def test_a_bench_judges_only_what_is_asked() -> None:
    again = replay(failing(), imported(PLACE))
    bench, last = Bench(again.site), again.outcomes[-1].after
    assert bench.violated(last) == again.violated
    assert bench.violated(last, again.violated[1:]) == again.violated[1:]
    assert bench.violated(last, ()) == ()


def test_trains_that_do_not_start_apart_are_a_violation_before_any_step() -> None:
    trace = replace(found("a terminal that obeys an older run"), planted=None)
    there = frozenset({Block("track 1")})
    together = replace(trace, at=dict.fromkeys(trace.at, there))
    again = replay(together, imported(PLACE))
    assert again.violated
    assert again.at_step == 0
    assert again.outcomes == ()
    assert verdict(again).endswith("violated at the start")


def test_points_that_lie_elsewhere_are_no_violation() -> None:
    trace = replace(failing(), planted=None, events=())
    assert not replay(replace(trace, lies=dict.fromkeys(trace.lies, Position("reverse"))), imported(PLACE)).reproduced
