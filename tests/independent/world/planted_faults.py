"""Functions of the kernel as they were when trains could still be led together, kept to be put in again.

:class:`OldKernel` has the old functions with each hole closed by plain means of this world's own; each fault is the
same with one of these closings taken away.  So a fault shows what this world finds, whatever the kernel does today.
"""

from __future__ import annotations

from dataclasses import replace

from kernel import first_loop, supervision
from kernel.centre import Centre
from kernel.layout import Layout
from kernel.names import Block, Cab, Epoch, Read, Run, Train, UnitLife
from kernel.onboard import braking
from kernel.onboard.braking import Brake
from kernel.unit import Evidence, Order, Unit
from tests.independent.world.kernel_calls import BOUNDS, STANDING, Board, Calls, Message, Sight

PAIR_MM = 9_000
"""The two tags of a boundary are read within so much running."""
ALL = frozenset(
    {
        "evidence of a block ahead",
        "evidence across changes of ends",
        "authority given back, brake not held",
        "a run set ahead carries the end",
        "two persons confirm a life",
    }
)


def note_tail_read(layout: Layout, unit: Unit, cab: Cab, read: Read) -> Unit:
    """Note the exit under every run that has begun, from the last two reads of the same cab, whenever they were."""
    before = unit.tail_read
    if before is None or unit.tail_cab != cab or layout.partner.get(before.tag) != read.tag:
        return replace(unit, tail_read=read, tail_cab=cab)
    block = layout.tag_in[before.tag]
    return replace(
        unit,
        tail_read=read,
        tail_cab=cab,
        occupied=unit.occupied - {block},
        orders={
            run: replace(order, left=order.left | {block: Evidence(left=before, entered=read)})
            if order.begun and order.loop_closed
            else order
            for run, order in unit.orders.items()
        },
    )


def take_end(brake: Brake, front_most_mm: int, speed_mm_s: int, end_mm: int) -> Brake:
    """Take a nearer end only if the train can stop before it; else brake, and keep the old end."""
    if end_mm >= brake.end_mm or braking.stops_before(BOUNDS, front_most_mm, speed_mm_s, end_mm):
        return replace(brake, end_mm=end_mm)
    return replace(brake, applied=True)


def may_be_left(layout: Layout, order: Order, run: Run, block: Block) -> bool:
    """Whether the head may run on out of a block, by one run alone."""
    target = layout.way[run.route].get(block)
    return (
        target is not None
        and target not in layout.overlap[run.route]
        and order.permitted
        and not order.given_back
        and order.loop_closed
        and block not in order.left
        and target not in order.left
    )


def still_ahead(layout: Layout, run: Run, order: Order) -> frozenset[Block]:
    """The blocks of a run that the head has not come into by its own tags."""
    found, tag = set[Block](), order.expected
    while tag is not None:
        onward = layout.tag_after[run.route].get(tag)
        # Of the two tags of a boundary the second to be read lies in the block to come into.
        if onward != layout.partner[tag]:
            found.add(layout.tag_in[tag])
        tag = onward
    return frozenset(found) | layout.overlap[run.route]


class OldKernel(Calls):
    """The old functions, with every hole closed that is named in ``closed``."""

    closed = ALL

    def tail_reads(self, board: Board, cab: Cab, healthy: bool, read: Read, sight: Sight) -> None:
        far = abs(sight.odometer_mm - board.read_at_mm) > PAIR_MM
        if not healthy or (far and "evidence across changes of ends" in self.closed):
            board.unit = replace(board.unit, tail_read=None)
        board.read_at_mm = sight.odometer_mm
        if healthy:
            before, unit = board.unit, note_tail_read(self.layout, board.unit, cab, read)
            if "evidence of a block ahead" in self.closed:
                unit = self.without_what_is_ahead(before, unit)
            board.unit = unit
        self.follow(board, sight)

    def without_what_is_ahead(self, before: Unit, unit: Unit) -> Unit:
        """Under a run nothing is left that its head has not come into."""
        orders = dict(unit.orders.items())
        for run, order in unit.orders.items():
            was = before.orders[run].left
            if run.route != STANDING and order.left is not was:
                ahead = still_ahead(self.layout, run, order)
                if any(block in ahead and block not in was for block in order.left):
                    orders[run] = replace(order, left=was)
        return replace(unit, orders=orders)

    def change_ends(self, board: Board, sight: Sight) -> None:
        if "evidence across changes of ends" in self.closed:
            board.unit = replace(board.unit, tail_read=None)
        super().change_ends(board, sight)

    def give_back(self, board: Board, run: Run, sight: Sight) -> None:
        order = board.unit.orders.get(run)
        if order is None or order.begun or not self.stands_short(run, sight):
            return
        if "a run set ahead carries the end" in self.closed and self.is_base(board, run):
            return
        board.unit = replace(board.unit, orders=board.unit.orders | {run: replace(order, given_back=True)})

    def is_base(self, board: Board, run: Run) -> bool:
        """Whether a run that is still good begins in a block that this one claims."""
        return any(
            other.serial > run.serial
            and order.permitted
            and not order.given_back
            and self.layout.start[other.route] in self.layout.claims[run.route] - {self.layout.start[run.route]}
            for other, order in board.unit.orders.items()
            if other.route != STANDING
        )

    def given_back(self, board: Board, run: Run) -> Message | None:
        if run.route == STANDING or not first_loop.acknowledges_back(board.unit, run):
            return None
        return ("given back", "centre", run)

    def follow(self, board: Board, sight: Sight) -> None:
        front_mm = sight.front_mm
        told = [(run, order) for run, order in board.unit.orders.items() if order.permitted]
        if "a run set ahead carries the end" in self.closed:
            end_mm: int | None = self.end_where_the_head_is(told, sight)
        else:
            found = [end for run, order in told for end in self.ends_by(run, order, front_mm[0], sight)]
            end_mm = max(found, default=None)
        if end_mm is None:
            return
        board.brake = take_end(board.brake, front_mm[1], sight.speed_mm_s, end_mm)
        if "authority given back, brake not held" in self.closed:
            board.held = board.brake.end_mm > end_mm

    def ends_by(self, run: Run, order: Order, front_least_mm: int, sight: Sight) -> list[int]:
        """The nearest end ahead that the head may not run on from, by one run."""
        found = sight.ends_mm(run.route) if run.route != STANDING else None
        if found is None:
            return []
        ahead = [
            end_mm
            for block, end_mm in found[1].items()
            if end_mm >= front_least_mm and not may_be_left(self.layout, order, run, block)
        ]
        return [min(ahead)] if ahead else []

    def end_where_the_head_is(self, told: list[tuple[Run, Order]], sight: Sight) -> int:
        """From the block that the head is in on: a run counts if it begins no farther than the end so far."""
        end_mm, left = sight.front_block_end_mm, [each for each in told if each[0].route != STANDING]
        grown = True
        while grown:
            grown = False
            for run, order in left:
                found = sight.ends_mm(run.route)
                if found is None or found[0] > end_mm:
                    continue
                onward = max(self.ends_by(run, order, sight.front_mm[0], sight), default=end_mm)
                if onward > end_mm:
                    end_mm, grown = onward, True
        return end_mm

    def statement_confirmed(
        self, centre: Centre, train: Train, life: UnitLife, epoch: Epoch, blocks: frozenset[Block], run: Run
    ) -> Centre:
        said = centre.statements.get(train)
        if "two persons confirm a life" in self.closed and (said is None or said.blocks != blocks):
            return centre
        return supervision.note_statement_confirmed(self.layout, centre, train, life, epoch, run)


class EvidenceAhead(OldKernel):
    """Hole 1: the tail's exit from a block is noted under every run that has begun."""

    closed = ALL - {"evidence of a block ahead"}


class EvidenceAcrossTurns(OldKernel):
    """Hole 2: two reads of one cab make a pair whatever lies between them."""

    closed = ALL - {"evidence across changes of ends"}


class BrakeNotHeld(OldKernel):
    """Hole 3: a run is given back while the brake still holds its end."""

    closed = ALL - {"authority given back, brake not held"}


class RunSetAhead(OldKernel):
    """Hole 4: a run that begins beyond what is held gives the end of authority."""

    closed = ALL - {"a run set ahead carries the end"}


class LifeConfirmed(OldKernel):
    """Hole 6: the second person confirms a life, and not a place."""

    closed = ALL - {"two persons confirm a life"}


FAULTS: tuple[type[OldKernel], ...] = (EvidenceAhead, EvidenceAcrossTurns, BrakeNotHeld, RunSetAhead, LifeConfirmed)
JUDGED: tuple[type[Calls], ...] = (Calls, OldKernel, *FAULTS)
KERNELS: dict[str, type[Calls]] = {kernel.__name__: kernel for kernel in JUDGED}
