"""The joint between the interlocking, which knows blocks, and the brake, which knows millimetres (T4, T12).

Each side is taken as the other's proof leaves it after its previous step: the unit may change in any way
at any moment, as the interlocking's world lets it; the head runs anywhere up to the end that the brake
control was given.  What comes out is the interlocking's own assumption that a train obeys its authority.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

from kernel.maps import Map
from kernel.names import Block, Route, Run, Train
from kernel.onboard import authority_end
from kernel.unit import Unit
from models.world.state import Site, System


@dataclass(frozen=True)
class Survey:
    """What does not change: the site of the interlocking, and where its blocks end (T1).

    ``block_ends_mm``: for each route where its blocks end, for a head that runs along it.
    """

    site: Site
    block_ends_mm: Mapping[Route, Mapping[Block, int]]


@dataclass(frozen=True)
class Joint:
    """The interlocking, and each train's head under the run that it runs under.

    ``head_mm``: where the head is.  ``end_mm``: the end of authority that the brake control holds.
    ``leavable``: history: the blocks that might be left when an end was taken.
    """

    system: System
    head_mm: Map[Run, int]
    end_mm: Map[Run, int]
    leavable: frozenset[tuple[Run, Block]]


# ---- premises


def blocks_end_one_after_another(site: Survey) -> bool:
    """Along a route each block ends beyond the one before it, and every route's ends are surveyed (T1)."""
    return all(
        route in site.block_ends_mm
        and block in site.block_ends_mm[route]
        and site.site.layout.way[route][block] in site.block_ends_mm[route]
        and site.block_ends_mm[route][block] < site.block_ends_mm[route][site.site.layout.way[route][block]]
        for route in site.site.layout.way
        for block in site.site.layout.way[route]
    )


def every_route_has_an_overlap(site: Survey) -> bool:
    """What a way leads through has its overlap described, be it empty: `every_map_has_its_keys` (T9)."""
    return all(route in site.site.layout.overlap for route in site.site.layout.way)


# ---- assumptions: what each side's proof gives the other


def the_head_stays_inside_authority(system: Joint, run: Run, to_mm: int) -> bool:
    """The brake control's theorem, `head_stays_inside_authority`: no head beyond the end it was given (T12)."""
    return run in system.end_mm and to_mm <= system.end_mm[run]


def the_head_runs_forward(system: Joint, run: Run, to_mm: int) -> bool:
    """A train under a run goes forward: the unit brakes on reverse movement (T5)."""
    return run in system.head_mm and system.head_mm[run] <= to_mm


def the_brake_takes_the_end(system: Joint, run: Run, end_mm: int) -> bool:
    """The brake control takes no end that the head is beyond, or could not stop before (T12)."""
    return system.head_mm[run] <= end_mm


def the_range_contains_the_head(system: Joint, run: Run, front_least_mm: int) -> bool:
    """The odometry's theorem, `range_contains_train` (P7)."""
    return run in system.head_mm and front_least_mm <= system.head_mm[run]


def what_the_tail_left_is_behind_the_head(site: Survey, system: Joint, run: Run, block: Block) -> bool:
    """The interlocking's `a_reported_block_is_left_by_all_cars`: the tail, so the head, is past a block left (T2)."""
    return (
        run in system.head_mm
        and run.route in site.block_ends_mm
        and block in site.block_ends_mm[run.route]
        and site.block_ends_mm[run.route][block] < system.head_mm[run]
    )


# ---- transitions


def begin(site: Survey, system: Joint, run: Run, head_mm: int) -> Joint:
    """A train begins to count along a new run, wherever its head is; no end has been taken for it yet (T4)."""
    if run in system.head_mm:
        return system
    return replace(system, head_mm=system.head_mm | {run: head_mm}, end_mm=system.end_mm | {run: head_mm})


def take_end(site: Survey, system: Joint, run: Run, front_least_mm: int, end_mm: int) -> Joint:
    """The unit works out the end of authority from its orders, and the brake control takes it (T4, T12)."""
    if run.train not in system.system.units or run.route not in site.block_ends_mm:
        return system
    if not the_range_contains_the_head(system, run, front_least_mm):
        return system
    unit, block_ends_mm = system.system.units[run.train], site.block_ends_mm[run.route]
    if end_mm not in authority_end.ends_mm(site.site.layout, unit, run, block_ends_mm, front_least_mm):
        return system
    if not the_brake_takes_the_end(system, run, end_mm):
        return system
    leavable = frozenset(
        (run, block) for block in block_ends_mm if authority_end.may_be_left(site.site.layout, unit, run, block)
    )
    return replace(system, end_mm=system.end_mm | {run: end_mm}, leavable=system.leavable | leavable)


def head_runs(site: Survey, system: Joint, run: Run, to_mm: int) -> Joint:
    """The head runs on, as far as the brake control lets it (T12)."""
    if not the_head_stays_inside_authority(system, run, to_mm) or not the_head_runs_forward(system, run, to_mm):
        return system
    return replace(system, head_mm=system.head_mm | {run: to_mm})


def unit_changes(site: Survey, system: Joint, train: Train, unit: Unit) -> Joint:
    """Messages, reads, restarts: the unit becomes whatever the interlocking's world may make of it (T8)."""
    return replace(system, system=replace(system.system, units=system.system.units | {train: unit}))


def train_rolls(site: Survey, system: Joint, rolling: frozenset[Run]) -> Joint:
    """Trains gather speed and come to rest (T4)."""
    return replace(system, system=replace(system.system, track=replace(system.system.track, rolling=rolling)))


def tail_leaves(site: Survey, system: Joint, run: Run, block: Block) -> Joint:
    """A genuine pair of reads shows that the tail has left a block (T2)."""
    if not what_the_tail_left_is_behind_the_head(site, system, run, block):
        return system
    behind = system.system.track.behind | {(run, block)}
    return replace(system, system=replace(system.system, track=replace(system.system.track, behind=behind)))
