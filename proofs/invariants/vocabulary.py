"""Words that several invariants share."""

from __future__ import annotations

from kernel.names import Block, Epoch, Point, Position, Read, Run, Stage, Train, UnitLife
from models.world.evidence import as_written
from models.world.state import Site, System


def could_proceed(system: System, run: Run) -> bool:
    """The permit is in the air, the life it names is the unit's, and the run was not given back."""
    unit = system.units.get(run.train)
    if unit is None or run not in system.radio.permits or run.life != unit.life:
        return False
    order = unit.orders.get(run)
    return order is None or not order.given_back


def could_overrun(system: System, run: Run) -> bool:
    """As above, and the train has not told that it stopped."""
    unit = system.units.get(run.train)
    if unit is None or not could_proceed(system, run):
        return False
    order = unit.orders.get(run)
    return order is None or not order.stopped


def reaches(site: Site, system: System, run: Run, block: Block) -> bool:
    """The train can be led into, or on from, ``block`` under ``run``: by a permit in the air, or rolling."""
    return (
        run.route in site.layout.routes
        and (run, block) not in system.track.behind
        and (
            (
                (block == site.layout.start[run.route] or block in site.layout.covers[run.route])
                and (could_proceed(system, run) or run in system.track.rolling)
            )
            or (
                block in site.layout.overlap[run.route]
                and (
                    could_overrun(system, run)
                    or run in system.track.slipping
                    or (run in system.track.rolling and run not in system.track.stood)
                )
            )
        )
    )


def is_overlap_of_the_earlier(site: Site, run: Run, other: Run, block: Block) -> bool:
    """Two runs are the same, or the block is the overlap of the one that was granted first."""
    return (
        run == other
        or (run.serial <= other.serial and block in site.layout.overlap.get(run.route, frozenset()))
        or (other.serial <= run.serial and block in site.layout.overlap.get(other.route, frozenset()))
    )


def is_apart_from(site: Site, run: Run, block: Block, other: Run, beside: Block) -> bool:
    """Of two blocks that foul each other the one is the overlap of the run granted first, or the later starts there."""
    return (
        run == other
        or (
            run.serial <= other.serial
            and (
                block in site.layout.overlap.get(run.route, frozenset()) or site.layout.start.get(other.route) == block
            )
        )
        or (
            other.serial <= run.serial
            and (
                beside in site.layout.overlap.get(other.route, frozenset())
                or site.layout.start.get(run.route) == beside
            )
        )
    )


def at_stage(system: System, run: Run, stage: Stage) -> bool:
    """The centre knows the run, and has it at this stage."""
    grant = system.centre.runs.get(run)
    return grant is not None and grant.stage == stage


def frozen(site: Site, system: System, point: Point) -> bool:
    """The point is locked, and every order that its terminal could still obey agrees with how it lies."""
    terminal = system.terminals.get(point)
    return (
        terminal is not None
        and not terminal.unlocked
        and all(
            site.layout.needs[run.route].get(point) == system.track.lies.get(point)
            for run, other, life in system.radio.orders
            if other == point
            and life == terminal.life
            and (terminal.holds is None or terminal.holds.serial < run.serial)
        )
    )


def frozen_at(site: Site, system: System, point: Point, position: Position) -> bool:
    """The point is frozen in this position."""
    return frozen(site, system, point) and system.track.lies.get(point) == position


def track_is_open(site: Site, system: System, block: Block, target: Block) -> bool:
    """Rails lead from one block to the next: every point that all ways there meet facing lies so."""
    return (
        block in site.ground.opens
        and target in site.ground.opens[block]
        and all(
            system.track.lies.get(point) == site.ground.opens[block][target][point]
            for point in site.ground.opens[block][target]
        )
    )


def genuine(site: Site, block: Block, left: Read, entered: Read) -> bool:
    """Both reads carry what is written in the pair of tags at the end of ``block``."""
    return (
        site.layout.tag_in.get(left.tag) == block
        and site.layout.partner.get(left.tag) == entered.tag
        and as_written(site, left, entered)
    )


def told(system: System, train: Train, life: UnitLife, epoch: Epoch) -> bool:
    """The word is in the air that this train stands somewhere in this life, and the centre could still take it."""
    return could_be_taken(system, train, life, epoch) and (
        (train, life, epoch) in system.radio.standings or (train, life, epoch) in system.radio.confirmed_statements
    )


def could_be_taken(system: System, train: Train, life: UnitLife, epoch: Epoch) -> bool:
    """The centre is in this epoch, and has not accounted for the train in this life or a later one."""
    known = system.centre.accounted.get(train)
    return epoch == system.centre.epoch and (known is None or known < life)
