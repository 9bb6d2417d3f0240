"""Trains that run to the end of their orders in millimetres, and lose the orders on the way (T4, T9, T12)."""

from __future__ import annotations

from dataclasses import replace

from kernel import first_loop
from kernel.names import Route, Run, Serial, Train, UnitLife
from kernel.onboard.braking import Brake
from models.onboard.joint import may_move
from models.simulator.senses import AT_REST
from proofs.onboard.witnesses import joint_nature, on_lines
from proofs.onboard.witnesses.station import (
    A_PAIR,
    BEGINS_MM,
    BOUNDS,
    ENDS_MM,
    GIVEN_BACK,
    ONWARD,
    ONWARD_MM,
    OTHER,
    PERMITTED,
    RECALLED,
    RUN,
    located,
    motion_of,
    permitted,
    released,
    two_runs,
    under_way,
)
from proofs.witnesses.stations import (
    A1,
    EAST,
    ONE,
    OUTLET,
    T1,
    T2,
    THROAT,
    WEST,
)

# ---- the ordinary way


def a_train_that_was_told_nothing_stands() -> None:
    """Without a list no end, without an order none beyond the block, and the brake stays on (T4)."""
    station = located()
    assert not station.ends(399_000, 401_000)
    station.holds(401_000, withheld=True)
    station.refuses("head_runs", train=T1, to_mm=400_001)
    station.listed(RUN, BEGINS_MM, ENDS_MM)
    station.holds(440_000, withheld=True)
    assert station.system.standing == {T1}
    assert not station.rolling()
    assert released(station.system.brake[T1], 401_000).applied


def every_part_of_the_permission_is_needed() -> None:
    """Not permitted, recalled, second loop open: the end is that of the block, and the brake stays on (T4, T5, T9)."""
    for order, opens in ((replace(PERMITTED, permitted=False), False), (RECALLED, False), (PERMITTED, True)):
        station = permitted()
        station.told({RUN: order})
        if opens:
            station.loop_opens()
        assert station.ends(399_000, 401_000) == {440_000}
        assert not may_move(station.system, T1)
        station.holds(440_000, withheld=True)
        assert not station.rolling()
        station.refuses("head_runs", train=T1, to_mm=400_001)


def under_orders_the_authority_ends_with_the_destination() -> None:
    """Through the throat into track one, and never into the overlap behind it (T4, T9, T12)."""
    station = under_way()
    assert station.system.system.track.leavable == {(RUN, WEST), (RUN, THROAT)}
    station.runs(440_000)
    station.passes(441_000, THROAT, 550_000)
    station.passes(700_000, ONE, 750_000)
    station.holds(750_000)
    station.runs(750_000)
    station.refuses("head_passes", train=T1, to_mm=750_001, block=OUTLET, block_end_mm=860_000)


def a_train_brought_to_rest_rolls_under_no_run_until_it_takes_an_end() -> None:
    """Withheld, it is at rest to the interlocking, and no order that is known to it lets it go (T4, T8, T12)."""
    station = under_way(439_000)
    station.refuses("come_to_rest", train=T1)
    station.changes(first_loop.recall(station.unit(), RUN))
    assert station.asks(error_mm=500).withheld
    assert station.rolling() == {RUN}
    station.step("come_to_rest", train=T1)
    assert station.system.standing == {T1}
    assert not station.rolling()
    assert not station.system.system.track.leavable
    assert not station.system.asked
    station.refuses("head_runs", train=T1, to_mm=439_001)
    for opens in (False, True):
        if opens:
            station.loop_opens()
        assert station.asks().withheld
        assert not station.rolling()
    station.changes(replace(station.unit(), loop_open=False))
    station.told({RUN: PERMITTED})
    station.holds(750_000)
    assert station.rolling() == {RUN}
    assert not station.system.standing


def a_range_that_reaches_beyond_the_end_takes_none_away() -> None:
    """Near its end the front may, by its range, be beyond the list: the end stays, and the train draws up (T4, P7)."""
    station = under_way()
    station.passes(441_000, THROAT, 550_000)
    station.passes(745_000, ONE, 750_000)
    brake = station.asks(error_mm=10_000)
    assert (brake.end_mm, brake.withheld) == (750_000, False)


def a_train_that_told_it_stopped_draws_up_no_more() -> None:
    """It ends where it did, and is braked: the overlap may be another train's by now (T9)."""
    station = under_way()
    station.passes(441_000, THROAT, 550_000)
    station.passes(700_000, ONE, 750_000)
    station.told({RUN: replace(PERMITTED, stopped=True)})
    station.holds(750_000, withheld=True)
    assert station.system.brake[T1].applied


def two_runs_make_one_end() -> None:
    """The destination of the first is the start of the second: the train runs through (T4, T12)."""
    station = two_runs()
    station.passes(500_000, THROAT, 550_000)
    station.passes(600_000, ONE, 750_000)
    station.holds(1_000_000)
    station.passes(800_000, OUTLET, 860_000)
    station.told({ONWARD: PERMITTED})
    station.holds(1_000_000)


def another_trains_end_is_its_own() -> None:
    """Lists, end and brake are of one train each (T4)."""
    station = under_way()
    station.step("locate", train=T2, head_mm=10_000, block=EAST, block_end_mm=100_000, front_most_mm=10_500)
    station.listed(OTHER, 0, {EAST: 100_000, OUTLET: 200_000, ONE: 300_000})
    station.holds(750_000)
    assert station.system.brake[T2] == Brake(applied=True, end_mm=10_500, withheld=True)
    assert station.system.brake[T1].end_mm == 750_000
    assert station.rolling() == {RUN}
    unit = replace(station.system.system.units[T2], orders={OTHER: station.listed_by_the_centre(OTHER, PERMITTED)})
    station.step("unit_changes", train=T2, unit=unit)
    event = {"train": T2, "front_least_mm": 9_500, "front_most_mm": 10_500}
    station.step("ask_for_the_end", **event, brake=Brake(applied=True, end_mm=300_000))
    assert station.rolling() == {RUN, OTHER}
    assert station.system.standing == frozenset()


def by_these_runs_a_train_may_move() -> None:
    """Its own, listed and permitted; wanted back only once begun, and given back never (T4, T5, T9)."""
    station = permitted()
    for order, moves in (
        (PERMITTED, True),
        (GIVEN_BACK, False),
        (RECALLED, False),
        (replace(PERMITTED, begun=True), True),
        (replace(RECALLED, begun=True), True),
        (replace(PERMITTED, given_back=True), False),
        (replace(PERMITTED, begun=True, stopped=True), False),
    ):
        station.told({RUN: order})
        assert may_move(station.system, T1) == moves
    station.told({})
    assert not may_move(station.system, T1)
    station.step("locate", train=T2, head_mm=10_000, block=EAST, block_end_mm=100_000, front_most_mm=10_500)
    station.listed(OTHER, 0, {EAST: 100_000, OUTLET: 200_000, ONE: 300_000})
    station.told({OTHER: PERMITTED})
    assert not may_move(station.system, T1)


def what_each_brake_did_is_written_down() -> None:
    """Of the one train and of the other, that has no end of authority; none is forgotten for the next (T12)."""
    station = under_way()
    station.step("locate", train=T2, head_mm=0, block=EAST, block_end_mm=100_000, front_most_mm=1_000)
    station.step("obey_the_orders", train=T2, bounds=BOUNDS, motion=motion_of(-1_000, 1_000))
    written = {T1: True, T2: True}
    assert station.system.does_as_assumed == written
    assert station.system.brakes_at_a_stop == written
    assert station.system.is_told_without_an_end == written


def what_ends_behind_the_train_does_not_count() -> None:
    """Of the blocks that the head may not leave, those whose end is no less than the least front (P7, T12)."""
    station = under_way(500_000)
    station.loop_opens()
    assert station.ends(440_000, 440_000) == {440_000}
    assert station.ends(440_001, 440_001) == {550_000}
    assert station.ends(550_001, 551_000) == {750_000}
    assert not station.ends(750_001, 750_001)
    assert not station.ends(BEGINS_MM - 1, 400_000)
    assert station.ends(BEGINS_MM, 400_000) == {440_000}


def a_change_of_ends_begins_a_new_kilometrage() -> None:
    """Located anew the train has no list and no end beyond its front; what it rolled under is over (P7, T8)."""
    station = under_way(500_000)
    event = {"train": T1, "block": THROAT, "block_end_mm": 90_000, "front_most_mm": 51_000}
    station.refuses("locate", **event, head_mm=51_001)
    station.step("locate", **event, head_mm=50_000)
    assert station.system.brake[T1] == Brake(applied=True, end_mm=51_000, withheld=True)
    assert not station.rolling()
    assert not station.system.block_ends_mm
    assert not station.system.system.track.leavable
    station.holds(51_000, withheld=True)


# ---- authority lost on the way


def authority_lost_while_rolling_is_not_taken_back_from_below_the_wheels() -> None:
    """The loop opens, the unit restarts: the train that cannot stop any more runs on, braked, to the old end (T5)."""
    station = under_way(439_000)
    station.loop_opens()
    brake = station.asks(speed_mm_s=20_000)
    assert brake == Brake(applied=True, end_mm=750_000, withheld=True)
    station.passes(500_000, THROAT, 550_000)
    station.told({})
    assert station.asks(speed_mm_s=10_000).end_mm == 750_000
    assert released(station.system.brake[T1], 501_000).applied
    assert station.rolling() == {RUN}
    station.passes(600_000, ONE, 750_000)
    station.refuses("head_passes", train=T1, to_mm=750_001, block=OUTLET, block_end_mm=860_000)


def a_false_pair_does_not_stop_the_train_on_the_spot() -> None:
    """The unit takes a block ahead for left: the authority ends before it, if the train can stop there (T2)."""
    station = under_way(450_000)
    station.told({RUN: replace(PERMITTED, left={THROAT: A_PAIR})})
    assert station.ends(449_000, 451_000) == {550_000}
    station.holds(550_000)
    station.refuses("head_passes", train=T1, to_mm=560_000, block=ONE, block_end_mm=750_000)


def what_the_tail_has_left_is_no_authority() -> None:
    """The block behind is left: the authority still ends in track one (T2)."""
    station = under_way(500_000)
    station.told({RUN: replace(PERMITTED, left={WEST: A_PAIR})})
    station.holds(750_000)
    station.passes(600_000, ONE, 750_000)
    station.refuses("take_list", run=RUN, begins_mm=0, block_ends_mm=ENDS_MM)


# ---- runs given back


def a_run_is_given_back_when_the_brake_holds_the_end_before_it() -> None:
    """Recalled 40 m before the end of its block a train at rest can be held there, and says so (T9, T12)."""
    station = under_way()
    station.changes(first_loop.recall(station.unit(), RUN))
    assert not station.gives_back()
    station.holds(440_000, withheld=True)
    assert not station.rolling()
    assert station.gives_back()
    station.refuses("head_passes", train=T1, to_mm=440_001, block=THROAT, block_end_mm=550_000)
    station.holds(440_000, withheld=True)
    assert released(station.system.brake[T1], 401_000).applied


def a_run_that_is_given_back_takes_its_list_with_it() -> None:
    """Its points may lie for another run then; one that is not given back, or was before, keeps its list (T9)."""
    station = under_way()
    station.refuses("give_back", run=RUN, at=AT_REST)
    station.changes(first_loop.recall(station.unit(), RUN))
    station.refuses("give_back", run=RUN, at=AT_REST)
    station.holds(440_000, withheld=True)
    station.refuses("give_back", run=RUN, at=replace(AT_REST, known=False))
    station.refuses("give_back", run=OTHER, at=AT_REST)
    before = station.system
    station.step("give_back", run=RUN, at=AT_REST)
    assert station.order(RUN).given_back
    assert not station.system.begins_mm
    assert not station.system.block_ends_mm
    assert not station.system.asked
    assert not station.ends(399_000, 401_000)
    assert station.asks().withheld
    station.system = before
    assert station.gives_back()
    station.refuses("give_back", run=RUN, at=AT_REST)


def a_train_too_near_to_be_held_gives_nothing_back() -> None:
    """A metre before the end of its block: the brake keeps the old end, stays on, and nothing is freed (T9, T12).

    The driver acknowledges at a standstill; before, that let the train into what the centre had freed.
    """
    station = under_way(439_000)
    station.changes(first_loop.recall(station.unit(), RUN))
    for _ in range(3):
        brake = station.asks(error_mm=500)
        assert brake == Brake(applied=True, end_mm=750_000, withheld=True)
        assert released(brake, 439_500).applied
        assert not station.gives_back()
    assert station.order(RUN) == RECALLED


def a_train_that_rolls_in_keeps_its_run() -> None:
    """Recalled at the pattern's limit: it brakes into the throat, has begun by then, and keeps its authority (T9)."""
    station = under_way(439_000)
    station.changes(first_loop.recall(station.unit(), RUN))
    assert station.asks(speed_mm_s=15_000).withheld
    station.passes(480_000, THROAT, 550_000)
    assert not station.gives_back()
    station.told({RUN: replace(RECALLED, begun=True)})
    station.changes(first_loop.recall(station.unit(), RUN))
    station.holds(750_000)
    assert not released(station.system.brake[T1], 481_000).applied


def a_run_that_another_leads_on_from_is_not_given_back() -> None:
    """The farther run first: without the nearer one the end of authority would lie beyond track that is nobody's (T9).

    And were it gone, the end would be that of the block; or none, where no list covers that.
    """
    station = two_runs()
    station.told({RUN: RECALLED, ONWARD: PERMITTED})
    station.holds(440_000)
    assert not station.gives_back(RUN)
    station.told({RUN: RECALLED, ONWARD: RECALLED})
    station.holds(440_000, withheld=True)
    assert station.gives_back(ONWARD)
    assert station.gives_back(RUN)
    station = two_runs()
    for order in (GIVEN_BACK, RECALLED):
        station.told({RUN: order, ONWARD: PERMITTED})
        assert station.ends(399_000, 401_000) == {440_000}
    station.told({ONWARD: PERMITTED})
    station.holds(440_000)
    station.refuses("head_passes", train=T1, to_mm=440_001, block=THROAT, block_end_mm=550_000)
    station = located()
    station.listed(ONWARD, 550_000, ONWARD_MM)
    station.told({ONWARD: PERMITTED})
    assert not station.ends(399_000, 401_000)
    assert not station.ends(549_999, 551_000)
    assert station.ends(550_000, 551_000) == {1_000_000}
    station.holds(401_000, withheld=True)
    assert released(station.system.brake[T1], 401_000).applied


def a_permit_after_the_recall_permits_nothing() -> None:
    """The radio repeats and reorders: what was recalled stays so, and what was given back (T4, T9, T11)."""
    station = permitted()
    station.told({RUN: replace(PERMITTED, permitted=False)})
    station.changes(first_loop.recall(station.unit(), RUN))
    station.changes(first_loop.take_permit(station.unit(), RUN))
    assert station.order(RUN) == RECALLED
    station.holds(440_000, withheld=True)
    assert station.gives_back()
    station.changes(first_loop.take_permit(station.unit(), RUN))
    assert station.order(RUN) == GIVEN_BACK


def a_unit_that_restarts_while_recalled_gives_nothing_back() -> None:
    """Without its orders it wants no end, and acknowledges nothing; the brake stays on (T8, T9)."""
    station = under_way(439_000)
    station.changes(first_loop.recall(station.unit(), RUN))
    station.changes(replace(station.unit(), life=UnitLife(1), orders={}))
    assert not station.gives_back()
    station.holds(750_000, withheld=True)
    assert released(station.system.brake[T1], 440_000).applied


# ---- what does not happen


def the_end_of_a_train_or_route_unknown_is_not_worked_out() -> None:
    """No unit, no place, no list: nothing is taken (T1)."""
    station = permitted()
    stranger = Train("T9")
    station.step("locate", train=stranger, head_mm=0, block=EAST, block_end_mm=1, front_most_mm=0)
    brake = Brake(applied=True, end_mm=0, withheld=True)
    station.refuses("ask_for_the_end", train=stranger, front_least_mm=0, front_most_mm=0, brake=brake)
    station.refuses("ask_for_the_end", train=T2, front_least_mm=0, front_most_mm=0, brake=brake)
    station.refuses("take_list", run=OTHER, begins_mm=0, block_ends_mm=ENDS_MM)
    nowhere = Run(Serial(4), T1, UnitLife(0), Route("nowhere"))
    station.refuses("take_list", run=nowhere, begins_mm=BEGINS_MM, block_ends_mm=ENDS_MM)
    station.refuses("head_runs", train=T2, to_mm=0)


def what_the_other_proofs_exclude_does_not_happen() -> None:
    """A head that runs back, a front that is elsewhere, a brake that takes what it was not asked (T5, P7, T12)."""
    station = under_way(450_000)
    station.refuses("head_runs", train=T1, to_mm=449_999)
    station.refuses("head_runs", train=T1, to_mm=550_001)
    for place in ({"to_mm": 560_000, "block": ONE, "block_end_mm": 751_000}, {"to_mm": 500_000, "block": ONE}):
        station.refuses("head_passes", train=T1, **{"block_end_mm": 750_000, **place})
    station.refuses("head_passes", train=T1, to_mm=560_000, block=OUTLET, block_end_mm=750_000)
    taken = Brake(applied=False, end_mm=750_000)
    for least_mm, most_mm in ((450_001, 451_000), (448_000, 449_999)):
        station.refuses("ask_for_the_end", train=T1, front_least_mm=least_mm, front_most_mm=most_mm, brake=taken)
    around = {"train": T1, "front_least_mm": 449_000, "front_most_mm": 451_000}
    station.loop_opens()
    for end_mm in (449_999, 750_000, 800_000):
        station.refuses("ask_for_the_end", **around, brake=Brake(applied=False, end_mm=end_mm))


def a_list_that_is_not_true_is_none() -> None:
    """Blocks not in their order, ends elsewhere than they are, cars ahead of the head (T1, T2)."""
    station = located()
    for ends_mm in (
        {},
        {WEST: 440_000},
        {**ENDS_MM, THROAT: 430_000},
        {**ENDS_MM, THROAT: 800_000},
        {**ENDS_MM, WEST: 441_000},
    ):
        station.refuses("take_list", run=RUN, begins_mm=BEGINS_MM, block_ends_mm=ends_mm)
    station.listed(RUN, BEGINS_MM, ENDS_MM)
    station.refuses("take_list", run=RUN, begins_mm=BEGINS_MM, block_ends_mm=ENDS_MM)
    track = station.system.system.track
    there = {"at": {**dict(track.at.items()), A1: frozenset({WEST, THROAT})}, "under": {A1: {THROAT: RUN}}}
    station.refuses("cars_move", **there)
    station = under_way(450_000)
    station.step("cars_move", **there)
    assert station.system.system.track.at[A1] == {WEST, THROAT}
    station.step("locate", train=T1, head_mm=400_000, block=WEST, block_end_mm=440_000, front_most_mm=400_000)
    station.refuses("take_list", run=RUN, begins_mm=BEGINS_MM, block_ends_mm=ENDS_MM)


WITNESSES = (
    a_train_that_was_told_nothing_stands,
    every_part_of_the_permission_is_needed,
    under_orders_the_authority_ends_with_the_destination,
    a_train_brought_to_rest_rolls_under_no_run_until_it_takes_an_end,
    a_range_that_reaches_beyond_the_end_takes_none_away,
    a_train_that_told_it_stopped_draws_up_no_more,
    two_runs_make_one_end,
    another_trains_end_is_its_own,
    by_these_runs_a_train_may_move,
    what_each_brake_did_is_written_down,
    what_ends_behind_the_train_does_not_count,
    a_change_of_ends_begins_a_new_kilometrage,
    authority_lost_while_rolling_is_not_taken_back_from_below_the_wheels,
    a_false_pair_does_not_stop_the_train_on_the_spot,
    what_the_tail_has_left_is_no_authority,
    a_run_is_given_back_when_the_brake_holds_the_end_before_it,
    a_run_that_is_given_back_takes_its_list_with_it,
    a_train_too_near_to_be_held_gives_nothing_back,
    a_train_that_rolls_in_keeps_its_run,
    a_run_that_another_leads_on_from_is_not_given_back,
    a_permit_after_the_recall_permits_nothing,
    a_unit_that_restarts_while_recalled_gives_nothing_back,
    the_end_of_a_train_or_route_unknown_is_not_worked_out,
    what_the_other_proofs_exclude_does_not_happen,
    a_list_that_is_not_true_is_none,
    *joint_nature.WITNESSES,
    *on_lines.WITNESSES,
)
