"""What the joint asks of track and trains, word by word, and what its histories note (T1, T2, T4, T9, T12).

Each is something that a kinder world would refuse, or would forget.
"""

from __future__ import annotations

from dataclasses import replace

from kernel.maps import Map
from kernel.names import Block, Car, Route, Run, TagList
from kernel.onboard.odometry import Loss
from models.onboard.joint import (
    Joint,
    Survey,
    list_begins_mm,
    lists_tell_the_track,
    locate,
    no_car_gets_ahead_of_its_head,
    no_car_is_ahead_of_the_head,
    obey_the_orders,
    the_head_runs_forward,
    the_track_goes_on_as_listed,
    the_unit_goes_by_the_centres_list,
    with_end,
)
from proofs.onboard.joint import (
    a_brake_control_does_what_is_assumed_of_it,
    a_brake_is_told_without_an_end,
    a_train_that_no_run_lets_move_is_braked,
)
from proofs.onboard.witnesses.station import (
    BEGINS_MM,
    BOUNDS,
    ENDS_MM,
    OTHER,
    PERMITTED,
    RECALLED,
    RUN,
    Station,
    motion_of,
    surveyed,
    under_way,
)
from proofs.witnesses.stations import EAST, ONE, OUTLET, T1, T2, THROAT, WEST

SITE = surveyed()
CAR = Car("one of them")
ELSEWHERE = Block("elsewhere")
OLDER = Run(RUN.serial, T1, RUN.life, Route("one that was driven"))


def asked() -> Joint:
    """A train in the west whose brake was asked by the list of its run."""
    system = under_way().system
    assert system.asked == {RUN}
    assert (system.block[T1], system.block_end_mm[T1]) == (WEST, ENDS_MM[WEST])
    return system


def with_the_other(system: Joint) -> Joint:
    """Another train in a block of the same name, at the same number, in a kilometrage of its own."""
    return replace(
        system,
        head_mm=system.head_mm | {T2: 400_000},
        block=system.block | {T2: WEST},
        block_end_mm=system.block_end_mm | {T2: ENDS_MM[WEST]},
        brake=system.brake | {T2: system.brake[T1]},
    )


# ---- the track


def a_list_binds_the_way_of_its_own_train_alone() -> None:
    """And only where the list has the head's block at its place, and is still there (T1)."""
    system = asked()
    assert the_track_goes_on_as_listed(SITE, system, T1, THROAT, ENDS_MM[THROAT])
    assert not the_track_goes_on_as_listed(SITE, system, T1, ELSEWHERE, ENDS_MM[THROAT])
    assert not the_track_goes_on_as_listed(SITE, system, T1, THROAT, ENDS_MM[THROAT] + 1)
    assert the_track_goes_on_as_listed(SITE, with_the_other(system), T2, ELSEWHERE, 999_000)
    assert the_track_goes_on_as_listed(SITE, replace(system, block_ends_mm={}), T1, ELSEWHERE, 999_000)
    beyond = replace(
        system, block={T1: OUTLET}, block_end_mm={T1: 860_000}, block_ends_mm={RUN: {**ENDS_MM, OUTLET: 860_000}}
    )
    assert the_track_goes_on_as_listed(SITE, beyond, T1, ELSEWHERE, 999_000)
    on_another_lap = replace(system, block_end_mm={T1: ENDS_MM[WEST] + 900_000})
    assert the_track_goes_on_as_listed(SITE, on_another_lap, T1, ELSEWHERE, 999_000)
    nowhere = replace(SITE, site=replace(SITE.site, layout=replace(SITE.site.layout, way={})))
    assert the_track_goes_on_as_listed(nowhere, system, T1, ELSEWHERE, 999_000)


def a_list_tells_of_its_own_train_alone() -> None:
    """And says nothing before it is known where it begins (T1)."""
    system = asked()
    assert not lists_tell_the_track(system, T1, 500_000, ELSEWHERE, 600_000)
    assert lists_tell_the_track(with_the_other(system), T2, 500_000, ELSEWHERE, 600_000)
    assert lists_tell_the_track(replace(system, begins_mm={}), T1, 500_000, ELSEWHERE, 600_000)
    assert list_begins_mm({RUN: BEGINS_MM, OTHER: 0}, T1) == {RUN: BEGINS_MM}


# ---- the cars


def a_car_under_a_run_has_its_head_ahead() -> None:
    """One that came under another run, or has left the block again, says nothing of this one's head (T2)."""
    behind_mm, beyond_mm = ENDS_MM[WEST], ENDS_MM[WEST] + 1
    came: Map[Car, Map[Block, Run]] = {CAR: {THROAT: RUN}}
    there: Map[Car, frozenset[Block]] = {CAR: frozenset({THROAT})}
    assert not no_car_is_ahead_of_the_head(SITE, behind_mm, RUN, ENDS_MM, there, came)
    assert no_car_is_ahead_of_the_head(SITE, beyond_mm, RUN, ENDS_MM, there, came)
    assert no_car_is_ahead_of_the_head(SITE, behind_mm, RUN, ENDS_MM, there, {CAR: {THROAT: OTHER}})
    assert no_car_is_ahead_of_the_head(SITE, behind_mm, RUN, ENDS_MM, {CAR: frozenset()}, came)
    assert not no_car_is_ahead_of_the_head(SITE, behind_mm, OLDER, ENDS_MM, {}, {})
    assert no_car_gets_ahead_of_its_head(SITE, replace(asked(), head_mm={}), there, came)


def a_train_that_is_not_located_runs_nowhere() -> None:
    """Nobody can say that it does (T5)."""
    assert the_head_runs_forward(asked(), T1, 400_000)
    assert not the_head_runs_forward(asked(), T1, 399_999)
    assert not the_head_runs_forward(asked(), T2, 400_000)


# ---- the unit


def a_run_that_is_not_permitted_may_have_any_list() -> None:
    """What the unit may enter by it has to be the centre's; and there has to be one (T4)."""
    unit, other = under_way().unit(), TagList("another")
    order = replace(PERMITTED, tag_list=SITE.site.layout.tag_list[RUN.route])
    assert the_unit_goes_by_the_centres_list(SITE, replace(unit, orders={RUN: order}))
    assert not the_unit_goes_by_the_centres_list(SITE, replace(unit, orders={RUN: replace(order, tag_list=other)}))
    not_yet = replace(order, tag_list=other, permitted=False)
    assert the_unit_goes_by_the_centres_list(SITE, replace(unit, orders={RUN: not_yet}))
    no_lists = Survey(replace(SITE.site, layout=replace(SITE.site.layout, tag_list={})))
    assert not the_unit_goes_by_the_centres_list(no_lists, replace(unit, orders={RUN: order}))


# ---- what is noted


def a_train_that_is_located_anew_has_no_list() -> None:
    """Its lists were in the kilometrage of before; another train keeps its own (P7)."""
    station = Station()
    for train in (T1, T2):
        station.step("locate", train=train, head_mm=400_000, block=WEST, block_end_mm=440_000, front_most_mm=401_000)
    system = replace(
        station.system,
        begins_mm={RUN: BEGINS_MM, OTHER: BEGINS_MM},
        block_ends_mm={RUN: ENDS_MM, OTHER: ENDS_MM},
    )
    anew = locate(SITE, system, T1, head_mm=0, block=EAST, block_end_mm=1, front_most_mm=0)
    kept: Map[Run, Map[Block, int]] = {OTHER: ENDS_MM}
    assert anew.begins_mm == {OTHER: BEGINS_MM}
    assert anew.block_ends_mm == kept


def what_rolled_before_its_order_was_lost_rolls_on() -> None:
    """A train is not stopped from below the wheels; one that did not roll does not begin to (T12)."""
    station = under_way()
    station.told({RUN: RECALLED})
    system = station.system
    for rolls in (frozenset({RUN}), frozenset[Run]()):
        track = replace(system.system.track, rolling=rolls)
        noted = with_end(SITE, replace(system, system=replace(system.system, track=track)), T1)
        assert noted.system.track.rolling == rolls


def what_is_noted_of_a_train_leaves_the_other_as_it_was() -> None:
    """What could be left, and by which lists the brake was asked: of the one anew, of the other as before (T12)."""
    station = under_way()
    station.told({RUN: PERMITTED, OTHER: PERMITTED})
    system = station.system
    before = replace(system.system.track, leavable=frozenset({(RUN, ELSEWHERE), (OTHER, ONE)}))
    system = replace(
        system,
        system=replace(system.system, track=before),
        asked=frozenset({OLDER}),
        block_ends_mm=system.block_ends_mm | {OTHER: {EAST: 100_000, OUTLET: 200_000, ONE: 300_000}},
    )
    noted = with_end(SITE, system, T1)
    assert noted.asked == {RUN}
    assert {block for run, block in noted.system.track.leavable if run == OTHER} == {ONE}
    assert {block for run, block in noted.system.track.leavable if run == RUN} == {WEST, THROAT}
    assert with_end(SITE, replace(system, asked=frozenset({OTHER})), T1).asked == {RUN, OTHER}


def what_a_brake_did_without_a_range_is_written_down() -> None:
    """Of that train, and of the other what it did before; nothing of one that is nowhere (P7)."""
    lost, held = motion_of(399_000, 401_000, loss=Loss.CYCLE_IRREGULAR), motion_of(399_000, 401_000)
    wrong = {T1: False, T2: False}
    system = replace(asked(), does_as_assumed=wrong, brakes_at_a_stop=wrong, is_told_without_an_end=wrong)
    for claim in (
        a_brake_control_does_what_is_assumed_of_it,
        a_train_that_no_run_lets_move_is_braked,
        a_brake_is_told_without_an_end,
    ):
        assert claim(SITE, asked())
        assert not claim(SITE, system)
    for anywhere in (lost, motion_of(400_001, 402_000, loss=Loss.CYCLE_IRREGULAR)):
        noted = obey_the_orders(SITE, system, T1, BOUNDS, anywhere)
        for written in (noted.does_as_assumed, noted.brakes_at_a_stop, noted.is_told_without_an_end):
            assert written == {T1: True, T2: False}
    assert obey_the_orders(SITE, system, T1, BOUNDS, held).does_as_assumed == {T1: True, T2: False}
    assert obey_the_orders(SITE, system, T1, BOUNDS, motion_of(400_001, 402_000)) == system
    assert obey_the_orders(SITE, system, T2, BOUNDS, lost) == system
    nobody = replace(system, system=replace(system.system, units={}))
    assert obey_the_orders(SITE, nobody, T1, BOUNDS, lost) == nobody


WITNESSES = (
    a_list_binds_the_way_of_its_own_train_alone,
    a_list_tells_of_its_own_train_alone,
    a_car_under_a_run_has_its_head_ahead,
    a_train_that_is_not_located_runs_nowhere,
    a_run_that_is_not_permitted_may_have_any_list,
    a_train_that_is_located_anew_has_no_list,
    what_rolled_before_its_order_was_lost_rolls_on,
    what_is_noted_of_a_train_leaves_the_other_as_it_was,
    what_a_brake_did_without_a_range_is_written_down,
)
