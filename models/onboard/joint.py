"""The joint between the interlocking, which knows blocks, and the brake, which knows millimetres (T4, T12).

Each side is taken as the other's proof leaves it after its previous step: the unit may change in any way
at any moment, as the interlocking's world lets it; the head runs anywhere up to the end that the brake
control holds.  What comes out are the interlocking's own assumptions: that a train obeys its authority, and that
it keeps out of a run while its brake holds an end before it.

Each train has one kilometrage, in which its head runs forward, until it is located anew at a standstill.  Of
the interlocking's ``rolling`` and ``leavable`` this world makes the least that it may: a run rolls from the moment
when the brake takes an end beyond the block that it starts in until it takes one before it, or has brought the train
to rest, withheld; and a block is leavable if it might be left when the brake was last asked for an end.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

from kernel import first_loop
from kernel.authority import may_leave, may_proceed
from kernel.maps import Map
from kernel.names import Block, Car, Run, Train
from kernel.onboard import authority_end, braking
from kernel.onboard.braking import Brake, BrakeBounds
from kernel.onboard.odometry import Loss, Motion
from kernel.standstill import Standstill
from kernel.unit import Unit
from models.world.state import Site, System
from models.world.truth import goes_by_the_centres_list


@dataclass(frozen=True)
class Survey:
    """What does not change: the site of the interlocking (T1)."""

    site: Site


@dataclass(frozen=True)
class Joint:
    """The interlocking, and of each train its head, its brake, and the lists of its runs.

    ``head_mm``: where the head is; ``block``, ``block_end_mm``: the block it is in, and where that ends ahead.
    ``brake``: what the brake control knows.
    ``standing``: trains at rest whose brake has not been free since they were located, or came to rest, withheld.
    ``begins_mm``, ``block_ends_mm``: for each listed run where its start block begins, and where its blocks end.
    ``asked``: history: the runs whose lists were there when the brake was last asked for an end.
    ``does_as_assumed``: history: of each train whether its brake control, asked for an end, did what is assumed of one.
    ``brakes_at_a_stop``: history: and whether it applied the brake then, if no run lets the train move.
    ``is_told_without_an_end``: history: and whether the brake was told anything, if there was no end for it.
    """

    system: System
    head_mm: Map[Train, int]
    block: Map[Train, Block]
    block_end_mm: Map[Train, int]
    brake: Map[Train, Brake]
    standing: frozenset[Train]
    begins_mm: Map[Run, int]
    block_ends_mm: Map[Run, Map[Block, int]]
    asked: frozenset[Run]
    does_as_assumed: Map[Train, bool]
    brakes_at_a_stop: Map[Train, bool]
    is_told_without_an_end: Map[Train, bool]


# ---- premises


def every_route_has_an_overlap(site: Survey) -> bool:
    """What a way leads through has its overlap described, be it empty: `every_map_has_its_keys` (T9)."""
    return all(route in site.site.layout.overlap for route in site.site.layout.way)


def a_centres_list_says_what_its_layout_does(site: Survey) -> bool:
    """The list that the centre sends for a route has the way and the overlap of its layout (T4)."""
    return all(
        route in site.site.layout.tag_list
        and site.site.lists.way.get(site.site.layout.tag_list[route]) == site.site.layout.way[route]
        and site.site.lists.overlap.get(site.site.layout.tag_list[route]) == site.site.layout.overlap[route]
        for route in site.site.layout.way
        if route in site.site.layout.overlap
    )


# ---- assumptions: of the track and its survey


def a_list_follows_the_way(site: Survey, run: Run, block_ends_mm: Map[Block, int]) -> bool:
    """A list has the start block first, and beyond each block but the last the one that the way leads into (T1)."""
    return (
        run.route in site.site.layout.start
        and site.site.layout.start[run.route] in block_ends_mm
        and all(block_ends_mm[site.site.layout.start[run.route]] <= block_ends_mm[block] for block in block_ends_mm)
        and all(
            run.route not in site.site.layout.way
            or block not in site.site.layout.way[run.route]
            or site.site.layout.way[run.route][block] in site.site.layout.overlap[run.route]
            or (
                site.site.layout.way[run.route][block] in block_ends_mm
                and block_ends_mm[block] < block_ends_mm[site.site.layout.way[run.route][block]]
            )
            for block in block_ends_mm
        )
    )


def a_list_tells_the_track(
    begins_mm: int, block_ends_mm: Map[Block, int], head_mm: int, block: Block, block_end_mm: int
) -> bool:
    """A head within what a list covers is in a block of that list, which ends where the list says (T1)."""
    return (
        head_mm < begins_mm
        or all(end_mm < head_mm for _, end_mm in block_ends_mm.items())
        or (block in block_ends_mm and block_ends_mm[block] == block_end_mm)
    )


def the_track_goes_on_as_listed(site: Survey, system: Joint, train: Train, block: Block, block_end_mm: int) -> bool:
    """Beyond the head's block comes a block that the lists have, and it ends where they say (T1, T10).

    Points lie for every run that is listed: `points_lie_for_the_set_route`.
    """
    return all(
        run.train != train
        or run not in system.block_ends_mm
        or run.route not in site.site.layout.way
        or system.block_ends_mm[run].get(system.block[train]) != system.block_end_mm[train]
        or system.block[train] not in site.site.layout.way[run.route]
        or site.site.layout.way[run.route][system.block[train]] in site.site.layout.overlap[run.route]
        or system.block_ends_mm[run].get(block) == block_end_mm
        for run in system.asked
    )


def no_car_is_ahead_of_the_head(
    site: Survey,
    head_mm: int,
    run: Run,
    block_ends_mm: Map[Block, int],
    at: Map[Car, frozenset[Block]],
    under: Map[Car, Map[Block, Run]],
) -> bool:
    """Where a car is that came there under a run, beyond its start block, the head is beyond that block too (T2)."""
    return run.route in site.site.layout.start and all(
        other != run
        or block not in at.get(car, frozenset())
        or block_ends_mm[site.site.layout.start[run.route]] < head_mm
        for car in under
        for block, other in under[car].items()
    )


# ---- assumptions: what each side's proof gives the other


def the_unit_goes_by_the_centres_list(site: Survey, unit: Unit) -> bool:
    """What a unit keeps of a route that it is permitted to enter is the centre's list of it (T4)."""
    return goes_by_the_centres_list(site.site, unit)


def the_head_stays_inside_authority(held: bool, brake: Brake, from_mm: int, to_mm: int) -> bool:
    """A head gets no farther than the end that its brake holds; and one that no end has freed holds it there (T12).

    ``held``: no end has freed the brake since the train was located at rest, or came to rest with its brake withheld.
    """
    return to_mm <= brake.end_mm and (not held or to_mm <= from_mm)


def the_brake_takes_the_end_or_stays_applied(before: Brake, brake: Brake, head_mm: int, is_wanted: bool) -> bool:
    """The end that the brake holds is never behind the head, and changes only to the one wanted.

    While it holds another one, or none is wanted, the brake stays applied (T12).
    ``is_wanted``: it holds the end that is wanted.
    """
    return head_mm <= brake.end_mm and (brake.end_mm == before.end_mm or is_wanted) and (brake.withheld or is_wanted)


def the_head_runs_forward(system: Joint, train: Train, to_mm: int) -> bool:
    """A train goes forward: the unit brakes on reverse movement (T5)."""
    return train in system.head_mm and system.head_mm[train] <= to_mm


def the_range_contains_the_head(head_mm: int, front_least_mm: int, front_most_mm: int) -> bool:
    """The odometry's theorem, `range_contains_train` (P7)."""
    return front_least_mm <= head_mm <= front_most_mm


def lists_tell_the_track(system: Joint, train: Train, head_mm: int, block: Block, block_end_mm: int) -> bool:
    """Every list of the train is true of the place that its head comes to (T1)."""
    return all(
        run.train != train
        or run not in system.begins_mm
        or a_list_tells_the_track(system.begins_mm[run], system.block_ends_mm[run], head_mm, block, block_end_mm)
        for run in system.block_ends_mm
    )


def a_head_is_located_in_its_block(head_mm: int, block_end_mm: int, front_most_mm: int) -> bool:
    """A train is located where it is: its head is no farther than told, and before the end of its block (P7)."""
    return head_mm <= front_most_mm and head_mm <= block_end_mm


def a_head_is_in_its_block(system: Joint, train: Train, to_mm: int) -> bool:
    """A head that has passed no boundary is no farther than where its block ends (T1)."""
    return to_mm <= system.block_end_mm[train]


def a_head_passes_one_boundary_at_a_time(system: Joint, train: Train, to_mm: int, block_end_mm: int) -> bool:
    """A head that has passed the end of its block is in the next one (T1)."""
    return system.block_end_mm[train] < to_mm <= block_end_mm


def no_car_gets_ahead_of_its_head(
    site: Survey, system: Joint, at: Map[Car, frozenset[Block]], under: Map[Car, Map[Block, Run]]
) -> bool:
    """The same of all cars and every listed run (T2)."""
    return all(
        run.train not in system.head_mm
        or no_car_is_ahead_of_the_head(site, system.head_mm[run.train], run, system.block_ends_mm[run], at, under)
        for run in system.block_ends_mm
    )


def a_list_fits_the_train(
    site: Survey, system: Joint, run: Run, begins_mm: int, block_ends_mm: Map[Block, int]
) -> bool:
    """A list that comes is true of where the train is and of its cars (T1, T2)."""
    return (
        a_list_follows_the_way(site, run, block_ends_mm)
        and a_list_tells_the_track(
            begins_mm,
            block_ends_mm,
            system.head_mm[run.train],
            system.block[run.train],
            system.block_end_mm[run.train],
        )
        and no_car_is_ahead_of_the_head(
            site,
            system.head_mm[run.train],
            run,
            block_ends_mm,
            system.system.track.at,
            system.system.track.under,
        )
    )


# ---- transitions


def locate(
    site: Survey, system: Joint, train: Train, head_mm: int, block: Block, block_end_mm: int, front_most_mm: int
) -> Joint:
    """A train at rest is located, in a new kilometrage: after a restart, a loss of position, a change of ends (P7)."""
    if not a_head_is_located_in_its_block(head_mm, block_end_mm, front_most_mm):
        return system
    return replace(
        at_rest(system, train),
        head_mm=system.head_mm | {train: head_mm},
        block=system.block | {train: block},
        block_end_mm=system.block_end_mm | {train: block_end_mm},
        brake=system.brake | {train: braking.stand_still(front_most_mm)},
        standing=system.standing | {train},
        begins_mm={run: begins_mm for run, begins_mm in system.begins_mm.items() if run.train != train},
        block_ends_mm={run: ends for run, ends in system.block_ends_mm.items() if run.train != train},
    )


def come_to_rest(site: Survey, system: Joint, train: Train) -> Joint:
    """A withheld brake has brought the train to rest: until it takes an end the train rolls under no run (T8, T12)."""
    if train not in system.brake or not system.brake[train].withheld:
        return system
    return replace(at_rest(system, train), standing=system.standing | {train})


def at_rest(system: Joint, train: Train) -> Joint:
    """What a train was let run by counts no more: it rolls under no run, and might leave no block."""
    track = system.system.track
    rolling = frozenset(run for run in track.rolling if run.train != train)
    leavable = frozenset((run, block) for run, block in track.leavable if run.train != train)
    others = replace(system.system, track=replace(track, rolling=rolling, leavable=leavable))
    return replace(system, system=others, asked=frozenset(run for run in system.asked if run.train != train))


def take_list(site: Survey, system: Joint, run: Run, begins_mm: int, block_ends_mm: Map[Block, int]) -> Joint:
    """The list of a run comes, surveyed in the train's kilometrage (T1, T4)."""
    if run.train not in system.head_mm or run in system.block_ends_mm:
        return system
    if not a_list_fits_the_train(site, system, run, begins_mm, block_ends_mm):
        return system
    return replace(
        system,
        begins_mm=system.begins_mm | {run: begins_mm},
        block_ends_mm=system.block_ends_mm | {run: block_ends_mm},
    )


def give_back(site: Survey, system: Joint, run: Run, at: Standstill) -> Joint:
    """A run is given back while the brake holds an end before it, and its list dropped with that (T9, T12).

    Its points may lie for another run from then on, so that the list tells the track no longer.
    """
    if run not in system.block_ends_mm or run.train not in system.system.units:
        return system
    unit, start_end_mm = system.system.units[run.train], system.block_ends_mm[run][site.site.layout.start[run.route]]
    given = first_loop.give_back(site.site.lists, unit, run, at, system.brake[run.train].end_mm, start_end_mm)
    told = replace(system, system=replace(system.system, units=system.system.units | {run.train: given}))
    if first_loop.acknowledges_back(unit, run) or not first_loop.acknowledges_back(given, run):
        return told
    return replace(
        told,
        begins_mm={other: begins_mm for other, begins_mm in system.begins_mm.items() if other != run},
        block_ends_mm={other: ends_mm for other, ends_mm in system.block_ends_mm.items() if other != run},
        asked=system.asked - {run},
    )


def ask_for_the_end(
    site: Survey,
    system: Joint,
    train: Train,
    front_least_mm: int,
    front_most_mm: int,
    brake: Brake,
) -> Joint:
    """A cycle on board: the unit works out the end from its orders, and the brake takes it or not (T4, T12)."""
    if train not in system.brake or train not in system.system.units:
        return system
    if not the_range_contains_the_head(system.head_mm[train], front_least_mm, front_most_mm):
        return system
    wanted_mm = wanted_ends_mm(site, system, train, front_least_mm, front_most_mm)
    is_wanted = brake.end_mm in wanted_mm
    if not the_brake_takes_the_end_or_stays_applied(system.brake[train], brake, system.head_mm[train], is_wanted):
        return system
    asked = replace(
        system,
        brake=system.brake | {train: brake},
        standing=system.standing if brake.withheld else system.standing - {train},
    )
    return with_end(site, asked, train) if is_wanted else asked


def obey_the_orders(site: Survey, system: Joint, train: Train, bounds: BrakeBounds, motion: Motion) -> Joint:
    """The brake control that there is, with any brake and at any speed: does it do what is assumed of one (T12)?

    What becomes of the train by it is :func:`ask_for_the_end`; here it is only written down.  That there is
    one brake and no more is tested.
    """
    if train not in system.brake or train not in system.system.units:
        return system
    lists, unit, before = site.site.lists, system.system.units[train], system.brake[train]
    begins_mm = list_begins_mm(system.begins_mm, train)
    ends_mm = list_ends_mm(system.block_ends_mm, train)
    made = authority_end.obey(lists, unit, begins_mm, ends_mm, bounds, before, motion)
    if motion.loss != Loss.NONE:
        return written_down(system, train, made, all(keeps_its_end(before, brake) for brake in made), False, False)
    least_mm, most_mm = motion.front_least_mm, motion.front_most_mm
    if not the_range_contains_the_head(system.head_mm[train], least_mm, most_mm):
        return system
    wanted_mm = wanted_ends_mm(site, system, train, least_mm, most_mm)
    does = all(
        the_brake_takes_the_end_or_stays_applied(before, brake, system.head_mm[train], brake.end_mm in wanted_mm)
        for brake in made
    )
    return written_down(system, train, made, does, may_move(system, train), any(True for _ in wanted_mm))


def keeps_its_end(before: Brake, brake: Brake) -> bool:
    """Of a train whose range is lost the brake stays applied, and no end is taken: none is known to be held (P7)."""
    return brake.withheld and brake.end_mm == before.end_mm


def written_down(system: Joint, train: Train, made: frozenset[Brake], does: bool, may_go: bool, has_end: bool) -> Joint:
    """What was made of a train's brake goes into history."""
    brakes = may_go or all(brake.applied for brake in made)
    return replace(
        system,
        does_as_assumed=system.does_as_assumed | {train: does},
        brakes_at_a_stop=system.brakes_at_a_stop | {train: brakes},
        is_told_without_an_end=system.is_told_without_an_end | {train: has_end or any(True for _ in made)},
    )


def may_move(system: Joint, train: Train) -> bool:
    """Tell whether a listed run lets a train move: permitted, neither wanted nor given back, and no loop open (T5).

    One that its head has begun stays the train's, though it is wanted back, until it has told that it stands (T9).
    """
    unit = system.system.units[train]
    return not unit.loop_open and any(
        run.train == train
        and run in unit.orders
        and unit.orders[run].permitted
        and not unit.orders[run].given_back
        and not unit.orders[run].stopped
        and (unit.orders[run].begun or not unit.orders[run].recalled)
        for run in system.block_ends_mm
    )


def list_begins_mm(begins_mm: Map[Run, int], train: Train) -> Map[Run, int]:
    """Where the start blocks of one train's listed runs begin."""
    return {run: begin_mm for run, begin_mm in begins_mm.items() if run.train == train}


def list_ends_mm(block_ends_mm: Map[Run, Map[Block, int]], train: Train) -> Map[Run, Map[Block, int]]:
    """Where the blocks of one train's listed runs end."""
    return {run: ends_mm for run, ends_mm in block_ends_mm.items() if run.train == train}


def wanted_ends_mm(
    site: Survey, system: Joint, train: Train, front_least_mm: int, front_most_mm: int
) -> frozenset[int]:
    """The end of a train's authority by all that its unit knows: one, or none."""
    return authority_end.ends_mm(
        site.site.lists,
        system.system.units[train],
        list_begins_mm(system.begins_mm, train),
        list_ends_mm(system.block_ends_mm, train),
        front_least_mm,
        front_most_mm,
    )


def with_end(site: Survey, system: Joint, train: Train) -> Joint:
    """The brake holds the end that was asked for: note what it rests on, and by which runs the train may roll."""
    layout, unit, track = site.site.layout, system.system.units[train], system.system.track
    end_mm = system.brake[train].end_mm
    within = frozenset(
        run
        for run in system.block_ends_mm
        if run.train == train
        and train not in system.standing
        and system.block_ends_mm[run][layout.start[run.route]] < end_mm
    )
    rolling = frozenset(run for run in track.rolling if run.train != train or run in within) | frozenset(
        run for run in within if may_proceed(unit, run)
    )
    leavable = frozenset((run, block) for run, block in track.leavable if run.train != train) | frozenset(
        (run, block)
        for run in system.block_ends_mm
        if run.train == train
        for block in system.block_ends_mm[run]
        if may_leave(site.site.lists, unit, run, block)
    )
    return replace(
        system,
        system=replace(system.system, track=replace(track, rolling=rolling, leavable=leavable)),
        asked=frozenset(run for run in system.asked if run.train != train)
        | frozenset(run for run in system.block_ends_mm if run.train == train and train not in system.standing),
    )


def head_runs(site: Survey, system: Joint, train: Train, to_mm: int) -> Joint:
    """The head runs on within its block, as far as the brake control lets it (T12)."""
    if train not in system.brake or not the_head_runs_forward(system, train, to_mm):
        return system
    if not the_head_stays_inside_authority(train in system.standing, system.brake[train], system.head_mm[train], to_mm):
        return system
    block, block_end_mm = system.block[train], system.block_end_mm[train]
    if not a_head_is_in_its_block(system, train, to_mm):
        return system
    if not lists_tell_the_track(system, train, to_mm, block, block_end_mm):
        return system
    return replace(system, head_mm=system.head_mm | {train: to_mm})


def head_passes(site: Survey, system: Joint, train: Train, to_mm: int, block: Block, block_end_mm: int) -> Joint:
    """The head runs over the end of its block into the next, where track and points lead it (T12)."""
    if train not in system.brake or train not in system.head_mm:
        return system
    if not the_head_stays_inside_authority(train in system.standing, system.brake[train], system.head_mm[train], to_mm):
        return system
    if not a_head_passes_one_boundary_at_a_time(system, train, to_mm, block_end_mm):
        return system
    if not the_track_goes_on_as_listed(site, system, train, block, block_end_mm):
        return system
    if not lists_tell_the_track(system, train, to_mm, block, block_end_mm):
        return system
    return replace(
        system,
        head_mm=system.head_mm | {train: to_mm},
        block=system.block | {train: block},
        block_end_mm=system.block_end_mm | {train: block_end_mm},
    )


def cars_move(site: Survey, system: Joint, at: Map[Car, frozenset[Block]], under: Map[Car, Map[Block, Run]]) -> Joint:
    """Cars come into blocks and leave them, none ahead of its train's head (T2)."""
    if not no_car_gets_ahead_of_its_head(site, system, at, under):
        return system
    track = replace(system.system.track, at=at, under=under)
    return replace(system, system=replace(system.system, track=track))


def unit_changes(site: Survey, system: Joint, train: Train, unit: Unit) -> Joint:
    """Messages, reads, restarts: the unit becomes whatever the interlocking's world may make of it (T8)."""
    if not the_unit_goes_by_the_centres_list(site, unit):
        return system
    return replace(system, system=replace(system.system, units=system.system.units | {train: unit}))
