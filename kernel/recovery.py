"""After a restart everything is lost until every train has told where it stands (T8, ours)."""

from __future__ import annotations

from dataclasses import replace

from kernel.centre import NO_LOCKS, NO_POINTS, NO_RUNS, NOTHING_ENDED, Centre, Grant
from kernel.claims import held_refusal
from kernel.layout import Layout
from kernel.names import Block, Cause, Epoch, Point, Position, Run, Stage, TerminalLife, Train, UnitLife
from kernel.refusal import Refusal


def challenges(centre: Centre, epoch: Epoch) -> bool:
    """Tell whether the centre asks every train where it stands, in this epoch (T8)."""
    return epoch == centre.epoch


def standing_refusal(
    layout: Layout, centre: Centre, train: Train, life: UnitLife, epoch: Epoch, blocks: frozenset[Block], run: Run
) -> Refusal | None:
    """Say why the word of ``train`` that it stands still is not taken; ``run`` will stand for it (T8)."""
    if train not in layout.fleet:
        return Refusal.UNKNOWN_TRAIN
    if epoch != centre.epoch:
        return Refusal.WRONG_EPOCH
    known = centre.accounted.get(train)
    if known is not None and life <= known:
        return Refusal.WRONG_LIFE
    if run.train != train or run.life != life:
        return Refusal.WRONG_LIFE
    if run.route in layout.routes:
        return Refusal.NAMES_A_ROUTE
    if run.serial <= centre.newest:
        return Refusal.SERIAL_NOT_NEW
    if run.serial >= layout.last_serial:
        return Refusal.SERIALS_EXHAUSTED
    return place_refusal(layout, centre, train, blocks)


def place_refusal(layout: Layout, centre: Centre, train: Train, blocks: frozenset[Block]) -> Refusal | None:
    """Say why ``blocks`` are not held for ``train`` on its word: it may name more than it is in, but none of another's.

    A point in them that is being laid for another train, as its flank, may yet move (T8, T9, T10).
    A unit with an older plan may name blocks that this line does not have, and so not say where its train is.
    """
    if any(block not in layout.blocks for block in blocks):
        return Refusal.UNKNOWN_BLOCK
    if any(
        other.train != train and not is_proved(centre, other, point)
        for block in blocks
        for point in layout.points_in.get(block, NO_POINTS)
        for other in centre.locked.get(point, NO_LOCKS)
    ):
        return Refusal.POINT_BEING_LAID
    return held_refusal(layout, centre, train, blocks)


def is_proved(centre: Centre, run: Run, point: Point) -> bool:
    """Tell whether ``point`` has been proved for ``run`` (T10)."""
    grant = centre.runs.get(run)
    return grant is not None and point in grant.proved


def account_for(layout: Layout, centre: Centre, blocks: frozenset[Block], run: Run, cause: Cause) -> Centre:
    """Hold exactly ``blocks`` for the train of ``run``; whatever it held before ends (T8).

    Points in these blocks are lost, since the centre cannot know how they lie, until the
    terminal tells it (:func:`adopt_point`).
    """
    return replace(
        centre,
        newest=run.serial,
        accounted=centre.accounted | {run.train: run.life},
        runs={
            other: replace(
                grant,
                stage=Stage.OVER,
                ended=grant.ended | {block: cause for block in centre.claimed if other in centre.claimed[block]},
            )
            if other.train == run.train
            else grant
            for other, grant in centre.runs.items()
        }
        | {run: Grant(stage=Stage.STANDING, proved=NO_POINTS, cancelling=False, ended=NOTHING_ENDED)},
        claimed={
            block: frozenset(other for other in holders if other.train != run.train)
            for block, holders in centre.claimed.items()
        }
        | {
            block: frozenset(other for other in centre.claimed.get(block, NO_RUNS) if other.train != run.train) | {run}
            for block in blocks
        },
        locked={
            point: {other: lies for other, lies in holders.items() if other.train != run.train}
            for point, holders in centre.locked.items()
        },
        lost_points=centre.lost_points
        | frozenset(point for block in blocks for point in layout.points_in.get(block, NO_POINTS)),
    )


def note_standing(
    layout: Layout, centre: Centre, train: Train, life: UnitLife, epoch: Epoch, blocks: frozenset[Block], run: Run
) -> Centre:
    """Take a train's word where it stands, given with its old authority dropped (T8)."""
    if standing_refusal(layout, centre, train, life, epoch, blocks, run) is not None:
        return centre
    return account_for(layout, centre, blocks, run, Cause.RECOVERED)


def acknowledges_standing(centre: Centre, run: Run) -> bool:
    """Tell whether the centre tells the train under which run it stands (T8)."""
    grant = centre.runs.get(run)
    return grant is not None and grant.stage == Stage.STANDING


def train_missing(layout: Layout, centre: Centre) -> bool:
    """Tell whether a train of the fleet register has not yet told where it stands (T8)."""
    return any(train not in centre.accounted for train in layout.fleet)


def recover_block(layout: Layout, centre: Centre, block: Block) -> Centre:
    """Find a lost block again once every train is accounted for (T8)."""
    if train_missing(layout, centre):
        return centre
    return replace(centre, lost_blocks=centre.lost_blocks - {block})


def recover_point_refusal(layout: Layout, centre: Centre, point: Point) -> Refusal | None:
    """Say why a lost point stays lost; under a train that stands it does (T8, T10)."""
    if train_missing(layout, centre):
        return Refusal.TRAIN_MISSING
    if point in layout.stands_in and any(True for _ in centre.claimed.get(layout.stands_in[point], NO_RUNS)):
        return Refusal.BLOCK_HELD
    return None


def recover_point(layout: Layout, centre: Centre, point: Point) -> Centre:
    """Find a lost point again once every train is accounted for and none is held over it (T8, T10)."""
    if recover_point_refusal(layout, centre, point) is not None:
        return centre
    return replace(centre, lost_points=centre.lost_points - {point})


def note_terminal_life(centre: Centre, point: Point, life: TerminalLife) -> Centre:
    """Note the life a point terminal is in; orders name it (T10)."""
    known = centre.terminal_life.get(point)
    if known is not None and life <= known:
        return centre
    return replace(centre, terminal_life=centre.terminal_life | {point: life})


def asks_how_it_lies(layout: Layout, centre: Centre, run: Run, point: Point, life: TerminalLife) -> bool:
    """Tell whether the centre asks, by way of the train, how a lost point under a standing train lies (T8, T10)."""
    grant = centre.runs.get(run)
    return (
        grant is not None
        and grant.stage == Stage.STANDING
        and point in layout.stands_in
        and run in centre.claimed.get(layout.stands_in[point], NO_RUNS)
        and point in centre.lost_points
        and centre.terminal_life.get(point) == life
    )


def adopt_point(layout: Layout, centre: Centre, run: Run, point: Point, position: Position) -> Centre:
    """Lock a lost point for the train that stands over it, as its terminal says it lies (T8, T10)."""
    grant = centre.runs.get(run)
    if grant is None or grant.stage != Stage.STANDING:
        return centre
    if point not in centre.lost_points or point not in layout.stands_in:
        return centre
    if run not in centre.claimed.get(layout.stands_in[point], NO_RUNS):
        return centre
    return replace(
        centre,
        lost_points=centre.lost_points - {point},
        locked=centre.locked | {point: centre.locked.get(point, NO_LOCKS) | {run: position}},
    )
