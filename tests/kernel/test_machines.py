"""Centre, terminal and unit as machines of one function each: whatever order a host tells them things in, it is lawful.

Orders in which a host could go wrong while it called the steps itself, written down before the machines were tried:

1. a machine restarts without a new epoch or life, or with what it remembered of before;
2. a message is handled twice;
3. the clock ticks before a message of the same moment, and not after it;
4. a route is requested before every train has told, after a restart of the centre, where it stands;
5. a machine speaks, or a motor runs, before the counters behind it are in lasting memory;
6. a confirmation is taken for the wrong run: of a route where the train stands, or the other way round;
7. a run is numbered by whoever asks for it.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import fields, replace
from functools import cache
from random import Random
from typing import Any

import pytest

from kernel import persistence
from kernel.centre import Centre
from kernel.machine import centre as machine
from kernel.machine import point_terminal, unit
from kernel.machine.messages import (
    Challenge,
    Confirmation,
    FirstStatement,
    Permit,
    PointOrder,
    Procedure,
    Request,
    Standing,
    Tick,
    ToCentre,
)
from kernel.machine.point_terminal import Contacts
from kernel.machine.unit import Place
from kernel.names import Block, Cause, Epoch, Route, Run, Serial, Stage, TerminalLife, Train, UnitLife
from kernel.persistence import Memory
from kernel.terminal import Terminal
from models.simulator import machines
from models.simulator.journey import Chances
from models.simulator.play import Play, site_of, two_cars_each
from models.simulator.senses import AT_REST, WHOLE
from models.simulator.traffic import Troubles, traffic_at
from models.world.state import System
from tests.world.small_site import PW, T1, T2, E, N, P, Q, R, W, hand_made_layout

LAYOUT, RECORDS, GROUND = hand_made_layout()
FLEET = (T1, T2)
TOLD = (*machines.AT_THE_CENTRE, Tick)


def answered(centre: Centre, *told: ToCentre) -> Centre:
    for each in told:
        centre = machine.answer(LAYOUT, RECORDS, centre, each)
    return centre


def begun() -> Centre:
    return machine.start(LAYOUT, machine.NEVER_STARTED)


def stands(centre: Centre, train: Train, block: Block, life: int = 2) -> Standing:
    return Standing(train, UnitLife(life), centre.epoch, frozenset({block}))


@cache
def heard() -> tuple[tuple[Centre, ToCentre], ...]:
    """All that the centre is told in some hours of traffic with everything going wrong, and what it was before."""
    found: list[tuple[Centre, ToCentre]] = []
    answer = machine.answer

    def noted(layout: Any, records: Any, centre: Centre, told: ToCentre) -> Centre:
        found.append((centre, told))
        return answer(layout, records, centre, told)

    with pytest.MonkeyPatch.context() as patched:
        patched.setattr(machine, "answer", noted)
        for seed in range(8):
            play_traffic(seed)
    return tuple(found)


def play_traffic(seed: int) -> Play:
    site = site_of(LAYOUT, GROUND, RECORDS, two_cars_each(FLEET))
    chances = Chances(loss=0.2, withdrawn=0.1, cancelled=0.1)
    troubles = Troubles(centre_restarts=0.01, unit_restarts=0.01, terminal_restarts=0.01, old_message=0.3, parts=0.003)
    traffic = traffic_at(site, {T1: P, T2: E}, Random(seed), chances, troubles)
    traffic.run(300)
    return traffic.play


def wider(centre: Centre) -> Any:
    """The layout that the traffic runs on, with its continuations."""
    return site_of(LAYOUT, GROUND, RECORDS, two_cars_each(FLEET)).layout


def test_everything_that_a_centre_can_be_told_is_told() -> None:
    kinds = {type(told) for _, told in heard()}
    assert kinds == set(TOLD)
    assert len(heard()) > 2_000


# ---- 1. a restart


def test_a_restart_has_nothing_but_what_lasting_memory_holds() -> None:
    for centre in {id(each): each for each, _ in heard()}.values():
        again = machine.start(LAYOUT, machine.to_write(centre))
        assert (again.epoch, again.newest) == (centre.epoch + 1, centre.newest)
        assert again == replace(begun(), epoch=again.epoch, newest=again.newest)


def test_what_was_said_before_a_restart_accounts_for_nobody_after_it() -> None:
    centre = begun()
    told = stands(centre, T1, P)
    again = machine.start(LAYOUT, machine.to_write(answered(centre, told)))
    assert answered(again, told) == again


def test_a_terminal_that_restarts_obeys_no_order_of_before() -> None:
    terminal = point_terminal.start(point_terminal.NEVER_STARTED)
    order = PointOrder(Run(Serial(1), T1, UnitLife(2), Route("P-W")), PW, R, terminal.life)
    again = point_terminal.start(point_terminal.to_write(terminal))
    assert point_terminal.answer(terminal, order, Contacts(N, True)).unlocked
    assert point_terminal.answer(again, order, Contacts(N, True)) == again


def test_a_unit_that_restarts_begins_a_life_without_authority() -> None:
    first = unit.start(unit.NEVER_STARTED)
    again = unit.start(first.life)
    assert again == replace(first, life=UnitLife(first.life + 1))
    assert len(again.orders) == 0


# ---- 2. a message twice


def test_a_centre_makes_of_a_message_once_what_it_makes_of_it_twice() -> None:
    layout = wider(begun())
    for centre, told in heard():
        once = machine.answer(layout, RECORDS, centre, told)
        assert machine.answer(layout, RECORDS, once, told) == once, told


def test_a_challenge_that_comes_twice_takes_nothing_from_a_train() -> None:
    lists = site_of(LAYOUT, GROUND, RECORDS, two_cars_each(FLEET)).lists
    place = Place(frozenset({P}), AT_REST, WHOLE, asks_anew=False)
    once = unit.answer(lists, unit.start(unit.NEVER_STARTED), Challenge(Epoch(1)), place)
    assert once.answered == Epoch(1)
    assert unit.answer(lists, once, Challenge(Epoch(1)), place) == once
    anew = unit.answer(lists, once, Challenge(Epoch(1)), replace(place, asks_anew=True))
    assert anew.life == once.life + 1


# ---- 3. the clock


def test_it_does_not_matter_whether_the_clock_ticks_before_a_message_too() -> None:
    layout = wider(begun())

    def ticks(centre: Centre) -> Centre:
        return machine.answer(layout, RECORDS, centre, Tick())

    for centre, told in heard():
        if not isinstance(told, Request):
            plain = ticks(machine.answer(layout, RECORDS, centre, told))
            assert ticks(machine.answer(layout, RECORDS, ticks(centre), told)) == plain, told


def test_after_a_tick_nothing_is_due() -> None:
    layout = wider(begun())
    for centre in {id(each): each for each, _ in heard()}.values():
        assert machine.due(layout, machine.answer(layout, RECORDS, centre, Tick())) == machine.Due((), (), (), ())


# ---- 4. a survey that is not complete


@pytest.mark.parametrize("route", sorted(LAYOUT.routes))
def test_no_route_is_granted_before_every_train_has_told_where_it_stands(route: Route) -> None:
    block = LAYOUT.start[route]
    centre = answered(begun(), stands(begun(), T1, block), Tick())
    (base,) = centre.runs
    run = machine.next_run(centre, T1, UnitLife(2), route)
    assert answered(centre, Request(run, base)) == centre
    elsewhere = next(each for each in (W, E, P, Q) if each not in LAYOUT.claims[route])
    told = answered(centre, stands(centre, T2, elsewhere), Tick())
    again = machine.next_run(told, T1, UnitLife(2), route)
    assert again in answered(told, Request(again, base)).runs or told.lost_points


# ---- 5. lasting memory


def test_a_centre_says_nothing_that_it_has_not_written_down() -> None:
    layout = wider(begun())
    spoke = 0
    for centre, told in heard():
        after = machine.answer(layout, RECORDS, centre, told)
        before, now = machine.to_write(centre), machine.to_write(after)
        if before != now:
            assert all(machine.says(layout, after, before, train) == () for train in FLEET)
            spoke += any(machine.says(layout, after, now, train) for train in FLEET)
    assert spoke > 50


def test_what_was_granted_and_not_written_down_is_as_if_it_never_was() -> None:
    layout = wider(begun())
    for centre, told in heard():
        after = machine.answer(layout, RECORDS, centre, told)
        if machine.to_write(after) != machine.to_write(centre):
            lost = machine.start(layout, machine.to_write(centre))
            assert lost.newest == centre.newest
            assert all(run.serial > lost.newest for run in after.runs if run not in centre.runs)


def test_no_motor_runs_before_it_is_written_down_that_its_lock_is_open() -> None:
    locked = point_terminal.start(point_terminal.NEVER_STARTED)
    order = PointOrder(Run(Serial(1), T1, UnitLife(2), Route("Q-W")), PW, R, locked.life)
    free = point_terminal.answer(locked, order, Contacts(N, True))
    assert point_terminal.throws_to(free, point_terminal.to_write(locked)) is None
    assert point_terminal.throws_to(free, point_terminal.to_write(free)) == R
    laid = point_terminal.answer(free, Tick(), Contacts(R, True))
    assert not laid.unlocked
    assert point_terminal.says(laid, point_terminal.to_write(free), PW, Contacts(R, True)) == ()
    assert Confirmation(order.run, PW, R) in point_terminal.says(
        laid, point_terminal.to_write(laid), PW, Contacts(R, True)
    )


def test_a_terminal_confirms_nothing_that_its_contacts_do_not_show() -> None:
    run = Run(Serial(1), T1, UnitLife(2), Route("Q-W"))
    laid = Terminal(life=TerminalLife(1), holds=run, wanted=R, unlocked=False)
    for shown in (Contacts(R, False), Contacts(N, True)):
        said = point_terminal.says(laid, point_terminal.to_write(laid), PW, shown)
        assert [each for each in said if isinstance(each, Confirmation) and each.position == R] == []


@pytest.mark.parametrize(
    ("table", "written"),
    [
        (persistence.CENTRE, machine.Written),
        (persistence.TERMINAL, point_terminal.Written),
    ],
)
def test_what_is_written_down_is_what_survives_a_restart(table: Mapping[str, Any], written: type) -> None:
    survives = {name for name, (memory, _) in table.items() if memory is not Memory.LOST}
    assert {each.name for each in fields(written)} == survives


def test_of_a_unit_its_life_alone_survives() -> None:
    assert [name for name, (memory, _) in persistence.UNIT.items() if memory is not Memory.LOST] == ["life"]


# ---- 6. confirmations


def test_a_confirmation_proves_a_point_of_a_route_or_finds_one_below_a_train() -> None:
    layout = wider(begun())
    proved = found = 0
    for centre, told in heard():
        grant = centre.runs.get(told.run) if isinstance(told, Confirmation) else None
        if not isinstance(told, Confirmation) or grant is None:
            continue
        after = machine.answer(layout, RECORDS, centre, told)
        if after != centre:
            adopted = told.point in centre.lost_points and told.point not in after.lost_points
            assert adopted == (grant.stage == Stage.STANDING)
            proved, found = proved + (not adopted), found + adopted
    assert proved > 20
    assert found > 5


# ---- 7. numbers


def test_a_run_that_is_not_the_next_one_is_not_granted() -> None:
    centre = answered(begun(), stands(begun(), T1, P))
    centre = answered(centre, stands(centre, T2, Q), Tick())
    base = next(run for run in centre.runs if run.train == T1)
    run = machine.next_run(centre, T1, UnitLife(2), Route("P-E"))
    ahead = run._replace(serial=Serial(run.serial + 1))
    assert answered(centre, Request(ahead, base)) == centre
    granted = answered(centre, Request(run, base))
    assert run in granted.runs
    assert answered(granted, Request(run, base)) == granted


# ---- what is said and done is the world's


def test_a_train_is_permitted_what_the_centre_says_alone() -> None:
    play = play_traffic(3)
    system: System = play.system
    for train in FLEET:
        said = machines.centre_says(play, train)
        permitted = {each.run for each in said if isinstance(each, Permit)}
        assert permitted == {
            run
            for run, grant in system.centre.runs.items()
            if run.train == train and grant.stage == Stage.SET and not grant.cancelling
        }


def test_a_supervised_procedure_that_is_opened_again_has_heard_nobody() -> None:
    opened = answered(begun(), Procedure(T1))
    told = answered(opened, FirstStatement(T1, UnitLife(2), opened.epoch, frozenset({P})))
    assert len(told.statements) == 1
    assert answered(told, Procedure(T1)) == opened


def test_causes_are_those_of_the_steps() -> None:
    layout = wider(begun())
    seen = {
        cause
        for centre, told in heard()
        for _, grant in machine.answer(layout, RECORDS, centre, told).runs.items()
        for _, cause in grant.ended.items()
    }
    assert {Cause.TAIL_EVIDENCE, Cause.WITHDRAWN, Cause.CANCELLED, Cause.RECOVERED} <= seen
