"""Route setting at the centre: reserve, prove the points, close the first loop (T4, T9, T10)."""

from __future__ import annotations

from dataclasses import replace

from kernel.centre import NO_BLOCKS, NO_LOCKS, NO_RUNS, NO_TAGS, NOTHING_ENDED, Centre, Grant
from kernel.claims import held_refusal
from kernel.layout import Layout
from kernel.names import Point, Position, Run, Stage, TagList, TerminalLife
from kernel.refusal import Refusal


def request_refusal(layout: Layout, centre: Centre, run: Run, base: Run) -> Refusal | None:
    """Say why ``run`` cannot be reserved for a train that stands, or will stand, under ``base`` (T4, T9)."""
    if run.route not in layout.routes:
        return Refusal.UNKNOWN_ROUTE
    if run.serial <= centre.newest:
        return Refusal.SERIAL_NOT_NEW
    if run.serial >= layout.last_serial:
        return Refusal.SERIALS_EXHAUSTED
    if centre.accounted.get(run.train) != run.life:
        return Refusal.TRAIN_NOT_ACCOUNTED_FOR
    secured = centre.runs.get(base)
    if secured is None or (secured.stage != Stage.SET and secured.stage != Stage.STANDING):
        return Refusal.START_NOT_SECURED
    if is_wanted_back(layout, centre, base):
        return Refusal.START_WANTED_BACK
    if base.train != run.train or base not in centre.claimed.get(layout.start[run.route], NO_RUNS):
        return Refusal.START_NOT_HELD
    against = conflict(layout, centre, run)
    if against is None and is_run_through(layout, centre, run):
        return Refusal.START_IS_RUN_THROUGH
    if against is None and meets_its_own_train(layout, centre, run):
        return Refusal.NOT_CLEAR_OF_ITS_OWN_TRAIN
    return against


def is_run_through(layout: Layout, centre: Centre, run: Run) -> bool:
    """Tell whether a run that holds the start block of ``run`` leads out of it over the same two tags (T5, T9).

    On a ring that is this lap's run, and ``run`` the next one's.  The tags at the end of the start block are read
    once a lap: with both runs set nobody could say which of them begins there.
    """
    first = layout.first_tag.get(run.route)
    if first is None:
        return True
    return any(
        layout.tag_after.get(other.route, NO_TAGS).get(first) == layout.tag_after.get(run.route, NO_TAGS).get(first)
        for other in centre.claimed.get(layout.start[run.route], NO_RUNS)
    )


def meets_its_own_train(layout: Layout, centre: Centre, run: Run) -> bool:
    """Tell whether cars of the train may stand in a block beyond the start of ``run``, or in one that fouls it (T9).

    Its tail was not told to have left that block, so that cars which parted from it may be there: the train comes back
    to them on a ring, or once it has turned.  Where an earlier run holds a block as its overlap alone, none does.
    """
    start = layout.start[run.route]
    return any(
        other.route not in layout.routes or block not in layout.overlap[other.route]
        for block in layout.claims[run.route]
        if block != start
        for other in centre.claimed.get(block, NO_RUNS)
    ) or any(
        other.route not in layout.routes or beside not in layout.overlap[other.route]
        for block in layout.claims[run.route]
        if block != start
        for beside in layout.fouls.get(block, NO_BLOCKS)
        if beside != start
        for other in centre.claimed.get(beside, NO_RUNS)
    )


def is_wanted_back(layout: Layout, centre: Centre, run: Run) -> bool:
    """Tell whether the centre has asked for ``run`` and may still get it back (T9).

    A run whose start the tail has left has begun, and a run that has begun is not given back.
    """
    grant, start = centre.runs.get(run), layout.start.get(run.route)
    return grant is not None and grant.cancelling and start is not None and run in centre.claimed.get(start, NO_RUNS)


def conflict(layout: Layout, centre: Centre, run: Run) -> Refusal | None:
    """Say what stands against ``run``: a block, a fouling block or a point (競合進路; T9).

    Points of the start block are locked by the run the train stands under, so that a route
    that needs one of them otherwise is refused like any other conflict.
    """
    blocks = layout.claims[run.route]
    if any(block in centre.lost_blocks for block in blocks):
        return Refusal.BLOCK_LOST
    if any(beside in centre.lost_blocks for block in blocks for beside in layout.fouls.get(block, NO_BLOCKS)):
        return Refusal.FOULING_BLOCK_LOST
    held = held_refusal(layout, centre, run.train, blocks)
    if held is not None:
        return held
    needs = layout.needs[run.route]
    if any(point in centre.lost_points for point in needs):
        return Refusal.POINT_LOST
    if any(lies != needs[point] for point in needs for _, lies in centre.locked.get(point, NO_LOCKS).items()):
        return Refusal.POINT_LOCKED_OTHERWISE
    return None


def request(layout: Layout, centre: Centre, run: Run, base: Run) -> Centre:
    """Reserve a run: its blocks are claimed and its points locked before any point moves (T4, T9).

    A point that the run below already holds lies right under a lock of the same train: it
    counts as proved, and no order is sent to a point the train may stand on.
    """
    if request_refusal(layout, centre, run, base) is not None:
        return centre
    held_below = frozenset(point for point in layout.needs[run.route] if base in centre.locked.get(point, NO_LOCKS))
    return replace(
        centre,
        newest=run.serial,
        runs=centre.runs | {run: Grant(stage=Stage.RESERVED, proved=held_below, cancelling=False, ended=NOTHING_ENDED)},
        claimed=centre.claimed
        | {block: centre.claimed.get(block, NO_RUNS) | {run} for block in layout.claims[run.route]},
        locked=centre.locked
        | {
            point: centre.locked.get(point, NO_LOCKS) | {run: layout.needs[run.route][point]}
            for point in layout.needs[run.route]
        },
    )


def orders_point(layout: Layout, centre: Centre, run: Run, point: Point, life: TerminalLife) -> bool:
    """Tell whether the centre sends the order to lay and lock ``point`` for ``run``, by way of the train (T10)."""
    grant = centre.runs.get(run)
    return (
        grant is not None
        and grant.stage == Stage.RESERVED
        and point in layout.needs[run.route]
        and point not in grant.proved
        and centre.terminal_life.get(point) == life
    )


def note_confirmation(layout: Layout, centre: Centre, run: Run, point: Point, position: Position) -> Centre:
    """Note that ``point`` lies and is locked for ``run``, as its terminal said by way of the train (T10)."""
    grant = centre.runs.get(run)
    if grant is None or grant.stage != Stage.RESERVED:
        return centre
    if point not in layout.needs[run.route] or layout.needs[run.route][point] != position:
        return centre
    return replace(centre, runs=centre.runs | {run: replace(grant, proved=grant.proved | {point})})


def open_first_loop_refusal(layout: Layout, centre: Centre, run: Run) -> Refusal | None:
    """Say why the tag list of ``run`` cannot be sent yet (T4)."""
    grant = centre.runs.get(run)
    if grant is None:
        return Refusal.NO_SUCH_RUN
    if grant.stage != Stage.RESERVED:
        return Refusal.WRONG_STAGE
    if any(point not in grant.proved for point in layout.needs[run.route]):
        return Refusal.POINTS_NOT_PROVED
    return None


def open_first_loop(layout: Layout, centre: Centre, run: Run) -> Centre:
    """Offer the run to the train once every point is proved (first loop, outward; T4)."""
    grant = centre.runs.get(run)
    if grant is None or open_first_loop_refusal(layout, centre, run) is not None:
        return centre
    return replace(centre, runs=centre.runs | {run: replace(grant, stage=Stage.OFFERED)})


def offers(centre: Centre, run: Run) -> bool:
    """Tell whether the centre sends the tag list of ``run`` (T4)."""
    grant = centre.runs.get(run)
    return grant is not None and grant.stage == Stage.OFFERED


def echo_refusal(layout: Layout, centre: Centre, run: Run, tag_list: TagList) -> Refusal | None:
    """Say why a run is not set though the train has sent ``tag_list`` back: another one than it was sent (T4)."""
    grant = centre.runs.get(run)
    if grant is None:
        return Refusal.NO_SUCH_RUN
    if grant.stage != Stage.OFFERED:
        return Refusal.WRONG_STAGE
    if layout.tag_list.get(run.route) != tag_list:
        return Refusal.LISTS_DIFFER
    return None


def note_echo(layout: Layout, centre: Centre, run: Run, tag_list: TagList) -> Centre:
    """Set the run: what the train keeps of the route is what the centre has sent (first loop, back; T4)."""
    grant = centre.runs.get(run)
    if grant is None or echo_refusal(layout, centre, run, tag_list) is not None:
        return centre
    return replace(centre, runs=centre.runs | {run: replace(grant, stage=Stage.SET)})


def permits(centre: Centre, run: Run) -> bool:
    """Tell whether the centre sends the route-complete message, which alone permits entry (T4)."""
    grant = centre.runs.get(run)
    return grant is not None and grant.stage == Stage.SET and not grant.cancelling
