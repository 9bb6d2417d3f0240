"""Holes that were once in the kernel, put in again one at a time.

Each fault is the kernel of today with the old function in place of the new one.  So it shows that this world finds
the hole, and that nothing else in the kernel hides it; three are hidden, or hardly ever met, behind one
more guard (`SetOverItself`), which is left out with them.
"""

from __future__ import annotations

from dataclasses import replace
from unittest.mock import patch

from kernel import authority, route_setting, standing
from kernel.centre import Centre
from kernel.machine import unit
from kernel.machine.messages import Challenge
from kernel.machine.unit import Place
from kernel.names import Block, Cab, Epoch, Position, Read, Route, Run, Stage, Train, UnitLife
from kernel.onboard import authority_end, braking
from kernel.onboard.braking import Brake
from kernel.tail_evidence import has_been_in
from kernel.terminal import Terminal
from kernel.unit import Evidence
from tests.independent.world.cab import BOUNDS, standstill
from tests.independent.world.kernel_calls import Board, Calls, Message
from tests.independent.world.sight import Sight, line


class SetOverItself(Calls):
    """A run is set over blocks that its own train has not left."""

    def request(self, centre: Centre, train: Train, life: UnitLife, route: Route, base: Run) -> Centre:
        with patch.object(route_setting, "meets_its_own_train", return_value=False):
            return super().request(centre, train, life, route, base)

    def is_refused(self, centre: Centre, train: Train, route: Route, base: Run) -> bool:
        with patch.object(route_setting, "meets_its_own_train", return_value=False):
            return super().is_refused(centre, train, route, base)


class EvidenceAhead(SetOverItself):
    """Hole 1: the tail's exit from a block is noted under every run that has begun; so that there is one ahead."""

    def tail_reads(self, board: Board, cab: Cab, healthy: bool, read: Read, sight: Sight) -> None:
        before = board.unit
        super().tail_reads(board, cab, healthy, read, sight)
        after, was = board.unit, before.tail_read
        if was is None or after.occupied == before.occupied:
            return
        evidence = {self.layout.tag_in[was.tag]: Evidence(left=was, entered=read)}
        orders = {
            run: replace(order, left=order.left | evidence) if order.begun else order
            for run, order in after.orders.items()
        }
        board.unit = replace(after, orders=orders)
        self.follow(board, sight)


class UnlockedUndetected(SetOverItself):
    """A terminal whose contacts show nothing takes the point for lying otherwise, and unlocks it."""

    def terminal_hears(self, machine: Terminal, message: Message, detected: Position, is_detected: bool) -> Terminal:
        seen = detected if is_detected else Position("none")
        return super().terminal_hears(machine, message, seen, True)


class EvidenceAcrossTurns(SetOverItself):
    """Hole 2: two reads of one cab make a pair whatever lies between them, of whichever end led there; and as above."""

    def tail_reads(self, board: Board, cab: Cab, healthy: bool, read: Read, sight: Sight) -> None:
        if board.kept is not None and board.kept[0] == cab:
            board.unit = replace(board.unit, tail_read=board.kept[1])
        before = board.unit
        super().tail_reads(board, cab, healthy, read, sight)
        was = before.tail_read
        if was is not None and healthy and not board.unit.loop_open and self.plan.partner[was.tag] == read.tag:
            self._left_as_once(board, self.layout.tag_in[was.tag], Evidence(left=was, entered=read))
            self.follow(board, sight)
        if board.unit.tail_read is not None:
            board.kept = cab, board.unit.tail_read

    def _left_as_once(self, board: Board, block: Block, evidence: Evidence) -> None:
        """Once a block was left, under runs that the other cab had led too, without a look at where the head is."""
        before = board.unit
        orders = {
            run: replace(order, left=order.left | {block: evidence})
            if has_been_in(self.lists, order, block) and order.led_by != before.leading
            else order
            for run, order in before.orders.items()
        }
        board.unit = replace(before, occupied=before.occupied - {block}, orders=orders)

    def begin_anew(self, board: Board, sight: Sight) -> None:
        if not any(True for _ in board.unit.orders):
            board.kept = None
        super().begin_anew(board, sight)


class BrakeNotHeld(Calls):
    """Hole 3: a run is given back while the brake still holds its end."""

    def recall(self, board: Board, run: Run, sight: Sight) -> None:
        order = board.unit.orders.get(run)
        beyond = self.layout.claims[run.route] - {self.layout.start[run.route]}
        if order is None or order.begun or not sight.at_rest or not sight.whole or sight.blocks & beyond:
            return
        board.unit = replace(board.unit, orders=board.unit.orders | {run: replace(order, given_back=True)})

    def obeyed(self, board: Board, least_mm: int, most_mm: int, speed_mm_s: int) -> Brake:
        ends_mm = authority_end.ends_mm(self.lists, board.unit, board.begins_mm, board.ends_mm, least_mm, most_mm)
        brake = board.brake
        for end_mm in ends_mm:
            if end_mm >= brake.end_mm or braking.stops_before(BOUNDS, most_mm, speed_mm_s, end_mm):
                return replace(brake, end_mm=end_mm, withheld=False)
            return replace(brake, applied=True)
        return brake


class RunSetAhead(Calls):
    """Hole 4: a run that begins beyond what is held gives the end of authority."""

    def obeyed(self, board: Board, least_mm: int, most_mm: int, speed_mm_s: int) -> Brake:
        found = [end_mm for run in board.ends_mm for end_mm in self.ends_by(board, run, least_mm)]
        if not found or authority_end.is_stopped(board.unit, board.ends_mm):
            return braking.withhold_end(board.brake)
        return braking.take_end(BOUNDS, board.brake, most_mm, speed_mm_s, max(found))

    def ends_by(self, board: Board, run: Run, least_mm: int) -> list[int]:
        """The nearest end ahead that the head may not run on from, by one run."""
        ahead = [
            end_mm
            for block, end_mm in board.ends_mm[run].items()
            if end_mm >= least_mm and not authority.may_leave(self.lists, board.unit, run, block)
        ]
        return [min(ahead)] if ahead else []


class LifeConfirmed(Calls):
    """Hole 6: the second person confirms a life, and not a place."""

    def centre_hears_of_standing(
        self, centre: Centre, kind: str, train: Train, life: UnitLife, epoch: Epoch, blocks: frozenset[Block]
    ) -> Centre:
        said = centre.statements.get(train) if kind == "confirmed statement" else None
        seen = blocks if said is None else said.blocks
        return super().centre_hears_of_standing(centre, kind, train, life, epoch, seen)


class NothingCompared(Calls):
    """Hole 5: a run is set whatever the train keeps of its route."""

    def centre_hears(self, centre: Centre, message: Message) -> Centre:
        kind, to, run, *_ = message
        if kind == "echo":
            return super().centre_hears(centre, (kind, to, run, self.layout.tag_list[run.route]))
        return super().centre_hears(centre, message)


class AnswersOnce(Calls):
    """A life that has answered once in an epoch does not answer again."""

    def answer(self, board: Board, epoch: Epoch, sight: Sight) -> None:
        if not standing.tells_standing(board.unit, epoch):
            super().answer(board, epoch, sight)


class AnswersUnbraked(Calls):
    """A train that stands answers at once, whether or not its brake holds it."""

    def answer(self, board: Board, epoch: Epoch, sight: Sight) -> None:
        before, at = board.unit, replace(standstill(sight, board.brake), response_cycles=0, releasable=False)
        place = Place(sight.blocks, at, line(sight.whole), board.asks_anew)
        board.unit = unit.answer(self.lists, before, Challenge(epoch), place)
        if board.unit is not before:
            board.asks_anew = False
            self.begin_anew(board, sight)


class KeepsWhatItHeld(Calls):
    """A centre that takes a train's word and goes on holding what it held for it."""

    def centre_hears_of_standing(
        self, centre: Centre, kind: str, train: Train, life: UnitLife, epoch: Epoch, blocks: frozenset[Block]
    ) -> Centre:
        held = {block for block, holders in centre.claimed.items() if any(run.train == train for run in holders)}
        return super().centre_hears_of_standing(centre, kind, train, life, epoch, blocks | held)


class NeverForgets(Calls):
    """A centre that never frees what was given back."""

    def retire(self, centre: Centre, run: Run) -> Centre:
        return centre if centre.runs[run].stage == Stage.OVER else super().retire(centre, run)


FAULTS: tuple[type[Calls], ...] = (
    EvidenceAhead,
    EvidenceAcrossTurns,
    BrakeNotHeld,
    RunSetAhead,
    NothingCompared,
    LifeConfirmed,
    AnswersUnbraked,
    UnlockedUndetected,
)
STANDS_FOR_EVER: tuple[type[Calls], ...] = (AnswersOnce, KeepsWhatItHeld, NeverForgets)
"""Kernels that are safe, and under which something that is held is never free again."""
JUDGED: tuple[type[Calls], ...] = (Calls, *FAULTS)
KERNELS: dict[str, type[Calls]] = {kernel.__name__: kernel for kernel in JUDGED}
