"""Functions of the kernel with one thing left out; :mod:`proofs.planted.weakenings` says what."""

from __future__ import annotations

from dataclasses import replace

from kernel.centre import NO_LOCKS, NO_RUNS, Centre
from kernel.claims import end_claims
from kernel.layout import Layout, TagRecords
from kernel.names import Block, Cab, Cause, Epoch, Read, Run, Stage, TagList, TerminalLife, Train, UnitLife
from kernel.recovery import account_for, standing_refusal
from kernel.refusal import Refusal
from kernel.release import release_refusal
from kernel.route_setting import conflict, is_run_through, meets_its_own_train
from kernel.standstill import Standstill, ThroughLine
from kernel.tag_list import TagLists, TagPlan
from kernel.tail_evidence import has_been_in
from kernel.terminal import Terminal
from kernel.unit import NO_BLOCKS, NO_EVIDENCE, Evidence, Order, Unit


def request_by_runs_known(layout: Layout, centre: Centre, run: Run, base: Run) -> Refusal | None:
    """Take a number for new if no run known now has it: after a restart none has."""
    if run.route not in layout.routes:
        return Refusal.UNKNOWN_ROUTE
    if any(run.serial == other.serial for other in centre.runs):
        return Refusal.SERIAL_NOT_NEW
    if run.serial >= layout.last_serial:
        return Refusal.SERIALS_EXHAUSTED
    if centre.accounted.get(run.train) != run.life:
        return Refusal.TRAIN_NOT_ACCOUNTED_FOR
    secured = centre.runs.get(base)
    if secured is None or (secured.stage != Stage.SET and secured.stage != Stage.STANDING):
        return Refusal.START_NOT_SECURED
    if base.train != run.train or base not in centre.claimed.get(layout.start[run.route], NO_RUNS):
        return Refusal.START_NOT_HELD
    against = conflict(layout, centre, run)
    if against is None and is_run_through(layout, centre, run):
        return Refusal.START_IS_RUN_THROUGH
    if against is None and meets_its_own_train(layout, centre, run):
        return Refusal.NOT_CLEAR_OF_ITS_OWN_TRAIN
    return against


def no_run_is_in_the_way(layout: Layout, centre: Centre, run: Run) -> bool:
    """Set a run over tags that an earlier one leads over, or over blocks that the train has not left."""
    return False


def terminal_keeps_its_life(terminal: Terminal, life: TerminalLife) -> Terminal:
    """Restart without a new life."""
    return Terminal(life=terminal.life, holds=None, wanted=None, unlocked=terminal.unlocked)


def unit_keeps_its_life(unit: Unit, life: UnitLife) -> Unit:
    """Restart without a new life."""
    return Unit(
        life=unit.life,
        answered=None,
        standing_in=frozenset(),
        isolated_in=None,
        orders={},
        loop_open=False,
        leading=None,
        head_tag=None,
        tail_read=None,
        occupied=frozenset(),
    )


def offer_to_any_life(lists: TagLists, unit: Unit, run: Run, tag_list: TagList) -> Unit:
    """Store a tag list whatever life it names, so that it is echoed and given back for another."""
    if run in unit.orders:
        return unit
    return replace(
        unit,
        orders=unit.orders
        | {
            run: Order(
                tag_list=tag_list,
                permitted=False,
                recalled=False,
                given_back=False,
                begun=False,
                stopped=False,
                expected=lists.first_tag.get(tag_list),
                entered=NO_BLOCKS,
                led_by=None,
                left=NO_EVIDENCE,
            )
        },
    )


def acknowledges_at_once(unit: Unit, run: Run) -> bool:
    """Acknowledge a recall whatever end the brake holds."""
    order = unit.orders.get(run)
    return order is not None and order.recalled and not order.begun


def any_antenna(plan: TagPlan, lists: TagLists, unit: Unit, cab: Cab, line: ThroughLine, read: Read) -> Unit:
    """Count the reads of every antenna, the head's too, over every line."""
    before = unit.tail_read
    if before is None or unit.loop_open or plan.partner.get(before.tag) != read.tag:
        return replace(unit, tail_read=read)
    block = plan.tag_in.get(before.tag)
    if block is None:
        return replace(unit, tail_read=read)
    return replace(
        unit,
        tail_read=read,
        occupied=unit.occupied - {block},
        orders={
            run: replace(order, left=order.left | {block: Evidence(left=before, entered=read)})
            if has_been_in(lists, order, block)
            else order
            for run, order in unit.orders.items()
        },
    )


def tail_over_a_broken_line(
    plan: TagPlan, lists: TagLists, unit: Unit, cab: Cab, line: ThroughLine, read: Read
) -> Unit:
    """Count the reads of the cabs that do not lead even when the through line does not reach the tail."""
    if unit.leading is None or unit.leading == cab:
        return unit
    before = unit.tail_read
    if before is None or unit.loop_open or plan.partner.get(before.tag) != read.tag:
        return replace(unit, tail_read=read)
    block = plan.tag_in.get(before.tag)
    if block is None:
        return replace(unit, tail_read=read)
    return replace(
        unit,
        tail_read=read,
        occupied=unit.occupied - {block},
        orders={
            run: replace(order, left=order.left | {block: Evidence(left=before, entered=read)})
            if has_been_in(lists, order, block)
            else order
            for run, order in unit.orders.items()
        },
    )


def all_free_again(layout: Layout, centre: Centre, epoch: Epoch) -> Centre:
    """Begin a new epoch with every block unoccupied."""
    return Centre(
        epoch=epoch,
        newest=centre.newest,
        accounted={},
        runs={},
        claimed={},
        locked={},
        lost_blocks=frozenset(),
        lost_points=layout.points,
        terminal_life={},
        supervised=frozenset(),
        statements={},
    )


def nobody_is_missing(layout: Layout, centre: Centre) -> bool:
    """Find everything again without asking for the whole fleet."""
    return False


def all_at_the_first_report(
    layout: Layout, records: TagRecords, centre: Centre, run: Run, block: Block, left: Read, entered: Read
) -> Centre:
    """Free the whole route on the evidence of one block."""
    grant = centre.runs.get(run)
    if grant is None or release_refusal(layout, records, centre, run, block, left, entered) is not None:
        return centre
    if grant.stage == Stage.STANDING:
        return centre
    return end_claims(
        layout,
        centre,
        run,
        grant,
        layout.claims[run.route],
        frozenset(point for point in layout.needs[run.route]),
        grant.stage,
        Cause.TAIL_EVIDENCE,
    )


def stopped_wherever_it_is(lists: TagLists, unit: Unit, run: Run, at: Standstill, begin_mm: int, end_mm: int) -> Unit:
    """Tell that the train has stopped though it can still slip."""
    order = unit.orders.get(run)
    if order is None or not order.permitted or order.given_back:
        return unit
    return replace(unit, orders=unit.orders | {run: replace(order, stopped=True)})


def conflict_without_fouling(layout: Layout, centre: Centre, run: Run) -> Refusal | None:
    """Look at the blocks of the route, not at those beside them."""
    blocks = layout.claims[run.route]
    if any(block in centre.lost_blocks for block in blocks):
        return Refusal.BLOCK_LOST
    if any(other.train != run.train for block in blocks for other in centre.claimed.get(block, NO_RUNS)):
        return Refusal.BLOCK_HELD_FOR_ANOTHER
    needs = layout.needs[run.route]
    if any(point in centre.lost_points for point in needs):
        return Refusal.POINT_LOST
    if any(lies != needs[point] for point in needs for _, lies in centre.locked.get(point, NO_LOCKS).items()):
        return Refusal.POINT_LOCKED_OTHERWISE
    return None


def confirms_a_life(
    layout: Layout,
    centre: Centre,
    train: Train,
    life: UnitLife,
    epoch: Epoch,
    blocks: frozenset[Block],
    run: Run,
) -> Centre:
    """Let the second person confirm that the unit is isolated, and hold what the first has stated."""
    said = centre.statements.get(train)
    if train not in centre.supervised or said is None or said.life != life:
        return centre
    if standing_refusal(layout, centre, train, life, epoch, blocks, run) is not None:
        return centre
    return replace(
        account_for(layout, centre, said.blocks, run, Cause.SUPERVISED),
        supervised=centre.supervised - {train},
        statements={other: words for other, words in centre.statements.items() if other != train},
    )
