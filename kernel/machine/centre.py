"""The centre as one machine: :func:`answer` takes whatever it is told, :func:`says` gives whatever it has to say.

Each input is one step of the centre that is proved for every layout, or leaves the centre as it is; a tick does what
is due, step by step.  What the centre says follows from what it knows and has written down, so what got lost is said
again, and nothing is said before the numbers that it rests on are in lasting memory.
"""

from __future__ import annotations

from dataclasses import dataclass

from kernel import cancellation, recovery, release, route_setting, supervision
from kernel.centre import NO_BLOCKS, NO_POINTS, Centre
from kernel.layout import Layout, TagRecords
from kernel.machine.messages import (
    Cancellation,
    Challenge,
    Confirmation,
    Echo,
    FirstStatement,
    FromPeople,
    FromTerminal,
    FromUnit,
    GivenBack,
    Offer,
    Permit,
    PointEnquiry,
    PointOrder,
    Procedure,
    Recall,
    Request,
    SecondStatement,
    Standing,
    StandingRun,
    Stopped,
    TailReport,
    TerminalTold,
    Tick,
    ToCentre,
    ToUnit,
    Withdrawal,
)
from kernel.names import Block, Epoch, Point, Route, Run, Serial, Stage, Train, UnitLife
from kernel.restarts import restart_centre

NO_ROUTE = Route("standing")
"""What the run of a train at rest names instead of a route; no layout has a route of this name (T8)."""


@dataclass(frozen=True)
class Written:
    """What the lasting memory of the centre holds: its two counters (T8, T10)."""

    epoch: Epoch
    newest: Serial


NEVER_STARTED = Written(epoch=Epoch(0), newest=Serial(0))
"""The lasting memory of a centre before its first start."""


def to_write(centre: Centre) -> Written:
    """Give what lasting memory must hold before anything is said (T8, T10)."""
    return Written(centre.epoch, centre.newest)


def start(layout: Layout, written: Written) -> Centre:
    """Begin with what lasting memory holds, and nothing else: a new epoch, everything lost (T8)."""
    before = Centre(
        epoch=written.epoch,
        newest=written.newest,
        accounted={},
        runs={},
        claimed={},
        locked={},
        lost_blocks=NO_BLOCKS,
        lost_points=NO_POINTS,
        terminal_life={},
        supervised=frozenset(),
        statements={},
    )
    return restart_centre(layout, before, Epoch(written.epoch + 1))


def next_run(centre: Centre, train: Train, life: UnitLife, route: Route) -> Run:
    """Number a run as the next one (T9)."""
    return Run(Serial(centre.newest + 1), train, life, route)


# ---- what it is told


def answer(layout: Layout, records: TagRecords, centre: Centre, told: ToCentre) -> Centre:
    """Take what a unit, a terminal, a person or the clock says (T4, T6, T8, T9, T10)."""
    match told:
        case Tick():
            return tick(layout, centre)
        case Request() | Withdrawal() | Cancellation() | Procedure() | FirstStatement() | SecondStatement():
            return asked(layout, centre, told)
        case _:
            return heard(layout, records, centre, told)


def heard(layout: Layout, records: TagRecords, centre: Centre, told: FromUnit | FromTerminal) -> Centre:
    """Take what a unit says, of itself or for a terminal (T4, T6, T8, T9, T10)."""
    match told:
        case Echo(run, tag_list):
            return route_setting.note_echo(layout, centre, run, tag_list)
        case Confirmation(run, point, position):
            if recovery.acknowledges_standing(centre, run):
                return recovery.adopt_point(layout, centre, run, point, position)
            return route_setting.note_confirmation(layout, centre, run, point, position)
        case TailReport(run, block, left, entered):
            return release.release(layout, records, centre, run, block, left, entered)
        case Stopped(run):
            return release.release_overlap(layout, centre, run)
        case GivenBack(run):
            return cancellation.note_given_back(layout, centre, run)
        case Standing(train, life, epoch, blocks):
            run = next_run(centre, train, life, NO_ROUTE)
            return recovery.note_standing(layout, centre, train, life, epoch, blocks, run)
        case TerminalTold(point, terminal_life):
            return recovery.note_terminal_life(centre, point, terminal_life)


def asked(layout: Layout, centre: Centre, told: FromPeople) -> Centre:
    """Take what a signaller asks, and what two persons on the spot state (T8, T9).

    A run that is not numbered as the next one was asked for twice, or by somebody who knows an older state.
    """
    match told:
        case Request(run, base):
            if run != next_run(centre, run.train, run.life, run.route):
                return centre
            return route_setting.request(layout, centre, run, base)
        case Withdrawal(run):
            return cancellation.withdraw(layout, centre, run)
        case Cancellation(run):
            return cancellation.cancel(layout, centre, run)
        case Procedure(train):
            return supervision.open_procedure(layout, centre, train)
        case FirstStatement(train, life, epoch, blocks):
            return supervision.note_statement(centre, train, life, epoch, blocks)
        case SecondStatement(train, life, epoch, blocks):
            run = next_run(centre, train, life, NO_ROUTE)
            return supervision.note_statement_confirmed(layout, centre, train, life, epoch, blocks, run)


# ---- what it does of itself


@dataclass(frozen=True)
class Due:
    """What the centre does of itself at a tick (T4, T8).

    ``complete``: runs of which every point is proved.  ``over``: runs that hold nothing any more.
    ``blocks``, ``points``: what is lost and can be found again.
    """

    complete: tuple[Run, ...]
    over: tuple[Run, ...]
    blocks: tuple[Block, ...]
    points: tuple[Point, ...]


def due(layout: Layout, centre: Centre) -> Due:
    """Give what a tick does now (T4, T8)."""
    held = frozenset(run for _, holders in centre.claimed.items() for run in holders)
    missing = recovery.train_missing(layout, centre)
    return Due(
        complete=tuple(
            run for run in centre.runs if route_setting.open_first_loop_refusal(layout, centre, run) is None
        ),
        over=tuple(run for run in centre.runs if run not in held),
        blocks=() if missing else tuple(sorted(centre.lost_blocks)),
        points=tuple(
            point
            for point in sorted(centre.lost_points)
            if recovery.recover_point_refusal(layout, centre, point) is None
        ),
    )


def tick(layout: Layout, centre: Centre) -> Centre:
    """Do what is due: offer, forget, and find again, each by the step that is proved of it (T4, T8)."""
    now = due(layout, centre)
    for run in now.complete:
        centre = route_setting.open_first_loop(layout, centre, run)
    for run in now.over:
        centre = release.retire(centre, run)
    for block in now.blocks:
        centre = recovery.recover_block(layout, centre, block)
    for point in now.points:
        centre = recovery.recover_point(layout, centre, point)
    return centre


# ---- what it says


def says(layout: Layout, centre: Centre, written: Written, train: Train) -> tuple[ToUnit, ...]:
    """Give all that the centre has to say to the unit of a train; nothing before it is written down (T8, T10, T11).

    It always asks where the train stands: a unit that has restarted is to answer anew, and nobody has told of that.
    """
    if written != to_write(centre):
        return ()
    of_runs = (says_of(layout, centre, run) for run in centre.runs if run.train == train)
    return (Challenge(centre.epoch), *(said for each in of_runs for said in each))


def says_of(layout: Layout, centre: Centre, run: Run) -> tuple[ToUnit, ...]:
    """Give what the centre says of a run, once it is written down: one thing after the other (T4, T8, T9, T10)."""
    if recovery.acknowledges_standing(centre, run):
        return (StandingRun(run), *enquiries(layout, centre, run))
    if route_setting.permits(centre, run):
        return (Permit(run),)
    offer = (Offer(run, layout.tag_list[run.route]),) if route_setting.offers(centre, run) else ()
    recall = (Recall(run),) if cancellation.asks_back(centre, run) else ()
    return (*orders(layout, centre, run), *offer, *recall)


def orders(layout: Layout, centre: Centre, run: Run) -> tuple[PointOrder, ...]:
    """Give the orders for the points of a run that are not proved, to terminals of which the life is known (T10)."""
    grant = centre.runs.get(run)
    if grant is None or grant.stage != Stage.RESERVED:
        return ()
    return tuple(
        PointOrder(run, point, position, centre.terminal_life[point])
        for point, position in sorted(layout.needs[run.route].items())
        if point in centre.terminal_life
        and route_setting.orders_point(layout, centre, run, point, centre.terminal_life[point])
    )


def enquiries(layout: Layout, centre: Centre, run: Run) -> tuple[PointEnquiry, ...]:
    """Give the enquiries for lost points below a train at rest, to terminals of which the life is known (T8, T10)."""
    return tuple(
        PointEnquiry(run, point, centre.terminal_life[point])
        for point in sorted(centre.lost_points)
        if point in centre.terminal_life
        and recovery.asks_how_it_lies(layout, centre, run, point, centre.terminal_life[point])
    )
