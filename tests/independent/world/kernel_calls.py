"""Every call that this world makes of the kernel, and nothing else: when the kernel changes, this file does.

Messages are tuples: their kind, to whom they go, and what they carry.  What goes on board of one train is a
:class:`Board`, which the world passes in and out without looking into it but through this file.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Protocol

from kernel import (
    authority,
    cancellation,
    first_loop,
    recovery,
    relay,
    release,
    restarts,
    route_setting,
    second_loop,
    standing,
    supervision,
    tail_evidence,
    terminal,
)
from kernel.centre import NO_RUNS, Centre
from kernel.layout import Layout, TagRecords
from kernel.names import (
    Antenna,
    Block,
    Cab,
    Epoch,
    Point,
    Position,
    Read,
    Route,
    Run,
    Serial,
    Stage,
    Tag,
    TerminalLife,
    Train,
    UnitLife,
)
from kernel.onboard import authority_end, braking
from kernel.onboard.braking import Brake, BrakeBounds
from kernel.terminal import Terminal
from kernel.unit import Unit

Message = tuple[Any, ...]
CENTRE = "centre"
STANDING = Route("standing")
BOUNDS = BrakeBounds(gains_mm_s2=1_000, slows_mm_s2=1_000, response_cycles=8, standstill_mm_s=100)
"""A brake of 1 m/s² within 0.8 s, and motors as strong."""


class Sight(Protocol):
    """A train as it truly stands or runs; places count along the direction it runs in."""

    name: Train

    @property
    def at_rest(self) -> bool:
        """Whether it stands."""

    @property
    def whole(self) -> bool:
        """Whether all its cars are coupled."""

    @property
    def blocks(self) -> frozenset[Block]:
        """All the blocks it is in, with what it has left behind."""

    @property
    def front_block(self) -> Block:
        """The block that its front is in."""

    @property
    def front_block_end_mm(self) -> int:
        """Where that block ends ahead of the train."""

    @property
    def front_mm(self) -> tuple[int, int]:
        """Where its front is: no less far, and no farther, by the odometry."""

    @property
    def speed_mm_s(self) -> int:
        """How fast it is."""

    @property
    def odometer_mm(self) -> int:
        """How far its wheels have run in its life, to and fro."""

    def ends_mm(self, route: Route) -> tuple[int, Mapping[Block, int]] | None:
        """Where the start block of a route ends, and all its blocks; nothing if it does not lead there."""


@dataclass
class Board:
    """What is on board of one train.

    ``held``: the brake is to stay on until an end is taken that the train can keep to.
    ``read_at_mm``: the odometer at the last read of the tail.
    """

    unit: Unit
    brake: Brake
    held: bool = False
    read_at_mm: int = 0


class Calls:
    """The kernel, as this world drives it, for one layout."""

    def __init__(self, layout: Layout, records: TagRecords) -> None:
        self.layout = layout
        self.records = records

    # ---- beginnings and restarts: what survives is docs/persistence.md

    def new_centre(self) -> Centre:
        """A centre that has just been switched on."""
        nothing = Centre(Epoch(0), Serial(0), {}, {}, {}, {}, frozenset(), frozenset(), {}, frozenset(), {})
        return self.restart_centre(nothing)

    def restart_centre(self, centre: Centre) -> Centre:
        return restarts.restart_centre(self.layout, centre, Epoch(centre.epoch + 1))

    def new_board(self, front_mm: int) -> Board:
        unit = Unit(UnitLife(0), None, frozenset(), {}, None, None, None, None, frozenset())
        return Board(restarts.restart_unit(unit, UnitLife(1)), Brake(True, front_mm))

    def restart_board(self, board: Board, front_mm: int) -> None:
        board.unit = restarts.restart_unit(board.unit, UnitLife(board.unit.life + 1))
        board.brake, board.held = Brake(True, front_mm), False

    def new_terminal(self) -> Terminal:
        return Terminal(TerminalLife(1), None, None, False)

    def restart_terminal(self, machine: Terminal) -> Terminal:
        return restarts.restart_terminal(machine, TerminalLife(machine.life + 1))

    # ---- what the signaller and the centre do of themselves

    def request(self, centre: Centre, train: Train, life: UnitLife, route: Route, base: Run) -> Centre:
        return route_setting.request(self.layout, centre, self.run_of(centre, train, life, route), base)

    def is_refused(self, centre: Centre, train: Train, route: Route, base: Run) -> bool:
        run = self.run_of(centre, train, base.life, route)
        return route_setting.request_refusal(self.layout, centre, run, base) is not None

    def run_of(self, centre: Centre, train: Train, life: UnitLife, route: Route) -> Run:
        return Run(Serial(centre.newest + 1), train, life, route)

    def withdraw(self, centre: Centre, run: Run) -> Centre:
        return cancellation.withdraw(self.layout, centre, run)

    def cancel(self, centre: Centre, run: Run) -> Centre:
        return cancellation.cancel(centre, run)

    def open_first_loop(self, centre: Centre, run: Run) -> Centre:
        return route_setting.open_first_loop(self.layout, centre, run)

    def retire(self, centre: Centre, run: Run) -> Centre:
        return release.retire(centre, run)

    def recover_block(self, centre: Centre, block: Block) -> Centre:
        return recovery.recover_block(self.layout, centre, block)

    def recover_point(self, centre: Centre, point: Point) -> Centre:
        return recovery.recover_point(self.layout, centre, point)

    def open_procedure(self, centre: Centre, train: Train) -> Centre:
        return supervision.open_procedure(self.layout, centre, train)

    def holders(self, centre: Centre, block: Block) -> frozenset[Train] | None:
        """For whom the centre holds a block; nothing if it is lost, and so closed to everybody."""
        if block in centre.lost_blocks:
            return None
        return frozenset(run.train for run in centre.claimed.get(block, NO_RUNS))

    # ---- what the centre sends

    def challenge(self, centre: Centre, train: Train) -> Message:
        return ("challenge", train, centre.epoch)

    def missing_points(self, centre: Centre, run: Run) -> list[Point]:
        """The points that a run still has to have proved."""
        return sorted(point for point in self.layout.needs[run.route] if point not in centre.runs[run].proved)

    def points_below(self, centre: Centre, run: Run) -> list[Point]:
        """Lost points under a train that stands."""
        return sorted(
            point for point in centre.lost_points if run in centre.claimed.get(self.layout.stands_in[point], NO_RUNS)
        )

    def order(self, centre: Centre, run: Run, point: Point) -> Message | None:
        life = centre.terminal_life.get(point)
        if life is None or not route_setting.orders_point(self.layout, centre, run, point, life):
            return None
        return ("order", run.train, run, point, life)

    def enquiry(self, centre: Centre, run: Run, point: Point) -> Message | None:
        life = centre.terminal_life.get(point)
        if life is None or not recovery.asks_how_it_lies(self.layout, centre, run, point, life):
            return None
        return ("enquiry", run.train, run, point, life)

    def word_on(self, centre: Centre, run: Run) -> Message | None:
        """What the centre has to say of a run."""
        if cancellation.asks_back(centre, run):
            return ("recall", run.train, run)
        if route_setting.offers(centre, run):
            return ("offer", run.train, run)
        if route_setting.permits(centre, run):
            return ("permit", run.train, run)
        if recovery.acknowledges_standing(centre, run):
            return ("standing run", run.train, run)
        return None

    # ---- what the centre receives

    def centre_hears(self, centre: Centre, message: Message) -> Centre:
        kind, _, *told = message
        if kind == "echo":
            return route_setting.note_echo(centre, *told)
        if kind == "confirmation":
            centre = route_setting.note_confirmation(self.layout, centre, *told)
            return recovery.adopt_point(self.layout, centre, *told)
        if kind == "tail report":
            return release.release(self.layout, self.records, centre, *told)
        if kind == "stopped":
            return release.release_overlap(self.layout, centre, *told)
        if kind == "given back":
            return cancellation.note_given_back(self.layout, centre, *told)
        if kind == "life":
            return recovery.note_terminal_life(centre, *told)
        return self.centre_hears_of_standing(centre, kind, *told)

    def centre_hears_of_standing(
        self, centre: Centre, kind: str, train: Train, life: UnitLife, epoch: Epoch, blocks: frozenset[Block]
    ) -> Centre:
        run = self.run_of(centre, train, life, STANDING)
        if kind == "standing":
            return recovery.note_standing(self.layout, centre, train, life, epoch, blocks, run)
        if kind == "statement":
            return supervision.note_statement(centre, train, life, epoch, blocks)
        assert kind == "confirmed statement", kind
        return self.statement_confirmed(centre, train, life, epoch, blocks, run)

    def statement_confirmed(
        self, centre: Centre, train: Train, life: UnitLife, epoch: Epoch, blocks: frozenset[Block], run: Run
    ) -> Centre:
        """The second person confirms; what he saw goes with it, for a kernel that asks."""
        return supervision.note_statement_confirmed(self.layout, centre, train, life, epoch, run)

    # ---- what a train receives

    def board_hears(self, board: Board, message: Message, sight: Sight) -> list[Message]:
        """Take a message on board; what it passes on."""
        kind, _, *told = message
        if kind == "order":
            run, point, life = told
            if not relay.relays_order(self.layout, board.unit, run, point):
                return []
            return [("relayed order", point, run, self.layout.needs[run.route][point], life)]
        if kind == "enquiry":
            run, point, life = told
            return [("relayed enquiry", point, run, life)]
        if kind == "confirmed":
            return [("confirmation", CENTRE, *told)]
        if kind == "challenge":
            self.answer(board, told[0], sight)
        else:
            self.take(board, kind, told[0], sight)
        self.follow(board, sight)
        return []

    def take(self, board: Board, kind: str, run: Run, sight: Sight) -> None:
        if kind == "offer":
            board.unit = first_loop.take_offer(self.layout, board.unit, run)
        elif kind == "permit":
            board.unit = first_loop.take_permit(board.unit, run)
        elif kind == "standing run":
            board.unit = first_loop.take_standing(board.unit, run)
        else:
            assert kind == "recall", kind
            self.give_back(board, run, sight)

    def stands_short(self, run: Run, sight: Sight) -> bool:
        """By odometer and tags: the whole train stands still outside the run's blocks but for its start."""
        beyond = self.layout.claims[run.route] - {self.layout.start[run.route]}
        return sight.at_rest and sight.whole and not sight.blocks & beyond

    def give_back(self, board: Board, run: Run, sight: Sight) -> None:
        board.unit = first_loop.give_back(board.unit, run, self.stands_short(run, sight))

    def answer(self, board: Board, epoch: Epoch, sight: Sight) -> None:
        before, life = board.unit, UnitLife(board.unit.life + 1)
        board.unit = standing.answer(board.unit, epoch, life, sight.blocks, sight.at_rest, sight.whole)
        if board.unit is not before:
            board.brake, board.held = Brake(True, sight.front_mm[0]), False

    # ---- what a train reads and notes

    def head_reads(self, board: Board, cab: Cab, tag: Tag, in_window: bool, sight: Sight) -> None:
        board.unit = second_loop.note_head_read(self.layout, board.unit, cab, tag, in_window)
        self.follow(board, sight)

    def tag_overdue(self, board: Board, sight: Sight) -> None:
        board.unit = second_loop.note_window_passed(board.unit)
        self.follow(board, sight)

    def tail_reads(self, board: Board, cab: Cab, healthy: bool, read: Read, sight: Sight) -> None:
        board.unit = tail_evidence.note_tail_read(self.layout, board.unit, Antenna.TAIL, cab, healthy, read)
        self.follow(board, sight)

    def genuine(self, tag: Tag) -> Read:
        return Read(tag, self.records.record[tag])

    def note_stopped(self, board: Board, run: Run, sight: Sight) -> None:
        """By odometer and tags: it stands still, its front inside the destination."""
        within = (
            sight.at_rest
            and sight.front_block == self.layout.destination[run.route]
            and not sight.blocks & self.layout.overlap[run.route]
        )
        board.unit = authority.note_stopped(board.unit, run, within)
        self.follow(board, sight)

    def change_ends(self, board: Board, sight: Sight) -> None:
        """The driver has gone to the other cab; the brake is on, and reckons along the new direction."""
        board.brake, board.held = Brake(True, sight.front_mm[0]), False
        self.follow(board, sight)

    # ---- what a train sends

    def answered(self, board: Board, train: Train, epoch: Epoch) -> Message | None:
        if not standing.tells_standing(board.unit, epoch):
            return None
        return ("standing", CENTRE, train, board.unit.life, epoch, board.unit.standing_in)

    def echo(self, board: Board, run: Run) -> Message | None:
        return ("echo", CENTRE, run) if first_loop.echoes(board.unit, run) and run.route != STANDING else None

    def given_back(self, board: Board, run: Run) -> Message | None:
        if run.route == STANDING or not first_loop.acknowledges_back(board.unit, run):
            return None
        return ("given back", CENTRE, run)

    def stopped(self, board: Board, run: Run) -> Message | None:
        if run.route == STANDING or not authority.tells_stopped(board.unit, run):
            return None
        return ("stopped", CENTRE, run)

    def tail_reports(self, board: Board, run: Run) -> list[Message]:
        return [
            ("tail report", CENTRE, run, block, seen.left, seen.entered)
            for block, seen in board.unit.orders[run].left.items()
            if tail_evidence.reports_left(self.layout, board.unit, run, block, seen.left, seen.entered)
        ]

    # ---- the brake

    def is_open(self, board: Board) -> bool:
        """Whether a second loop is open."""
        return any(not order.loop_closed for _, order in board.unit.orders.items())

    def follow(self, board: Board, sight: Sight) -> None:
        """From what the unit knows to what the brake must do: the farthest end that any run gives."""
        front_mm = sight.front_mm
        told = (run for run, order in board.unit.orders.items() if order.permitted)
        ends_mm = [end for run in told for end in self.ends_of(board, run, front_mm[0], sight)]
        if ends_mm:
            board.brake = braking.take_end(BOUNDS, board.brake, front_mm[1], sight.speed_mm_s, max(ends_mm))

    def ends_of(self, board: Board, run: Run, front_least_mm: int, sight: Sight) -> frozenset[int]:
        """The end of authority by one run, which need not be where the head is."""
        found = sight.ends_mm(run.route) if run.route != STANDING else None
        if found is None:
            return frozenset()
        return authority_end.ends_mm(self.layout, board.unit, run, found[1], front_least_mm)

    def end_mm(self, board: Board) -> int:
        """The end that the driver is shown."""
        return board.brake.end_mm

    def supervise(self, board: Board, front_most_mm: int, speed_mm_s: int, demanded: bool, acknowledged: bool) -> bool:
        """One cycle of the brake; whether it is on."""
        demanded = demanded or board.held
        board.brake = braking.supervise(BOUNDS, board.brake, front_most_mm, speed_mm_s, demanded, acknowledged)
        return board.brake.applied

    def could_start(self, board: Board, front_most_mm: int, demanded: bool) -> bool:
        """Whether the brake could be released at a standstill."""
        demanded = demanded or board.held
        return not braking.supervise(BOUNDS, board.brake, front_most_mm, 0, demanded, True).applied

    # ---- points

    def terminal_hears(self, machine: Terminal, message: Message, detected: Position) -> Terminal:
        kind, _, *told = message
        if kind == "relayed order":
            run, position, life = told
            return terminal.obey(machine, run, position, life, detected)
        assert kind == "relayed enquiry", kind
        return terminal.relabel(machine, *told)

    def lock(self, machine: Terminal, detected: Position) -> Terminal:
        return terminal.lock(machine, detected)

    def is_unlocked(self, machine: Terminal) -> bool:
        """Whether the point is free to move."""
        return machine.unlocked

    def wanted(self, machine: Terminal) -> Position | None:
        """How its motor drives it."""
        return machine.wanted

    def terminal_life(self, machine: Terminal, point: Point) -> Message:
        return ("life", CENTRE, point, machine.life)

    def confirms(self, machine: Terminal, point: Point, detected: Position) -> Message | None:
        run = machine.holds
        if run is None or not terminal.confirms(machine, run, detected, detected):
            return None
        return ("confirmed", run.train, run, point, detected)

    # ---- what a schedule may look at, to choose what is likely to change something

    def runs(self, centre: Centre) -> list[Run]:
        return list(centre.runs)

    def stage(self, centre: Centre, run: Run) -> Stage:
        return centre.runs[run].stage

    def orders(self, board: Board) -> list[Run]:
        return list(board.unit.orders)

    def may_proceed(self, board: Board, run: Run) -> bool:
        return authority.may_proceed(board.unit, run)

    def unreported(self, board: Board, centre: Centre, run: Run) -> bool:
        """Whether the tail has left a block under this run that the centre still holds for it."""
        left = board.unit.orders[run].left
        return any(run in centre.claimed.get(block, NO_RUNS) for block in left)

    def is_accounted(self, centre: Centre, board: Board, train: Train) -> bool:
        """Whether the centre knows where a train stands or runs in the life that it is in."""
        return centre.accounted.get(train) == board.unit.life

    def recoverable(self, centre: Centre) -> tuple[list[Block], list[Point]]:
        """What can be found again now."""
        if recovery.train_missing(self.layout, centre):
            return [], []
        points = [p for p in centre.lost_points if recovery.recover_point_refusal(self.layout, centre, p) is None]
        return sorted(centre.lost_blocks), sorted(points)

    def unheard(self, centre: Centre) -> list[Point]:
        """The terminals of which no life is known."""
        return sorted(point for point in self.layout.points if point not in centre.terminal_life)

    def word_is_known(self, centre: Centre, board: Board, run: Run) -> bool:
        """Whether the train has already done what the centre has to say of a run."""
        order = board.unit.orders.get(run)
        grant = centre.runs[run]
        if order is None:
            return run.life != board.unit.life
        if grant.cancelling:
            return order.given_back
        return grant.stage != Stage.SET or order.permitted

    def is_ahead(self, centre: Centre, board: Board, run: Run) -> bool:
        """Whether a route is set or wanted that the train has not begun to run by."""
        order = board.unit.orders.get(run)
        over = run.route == STANDING or centre.runs[run].stage == Stage.OVER
        return not over and (order is None or not order.begun)

    def is_proved(self, centre: Centre, machine: Terminal, point: Point) -> bool:
        """Whether the centre needs no more word of a point's lock."""
        grant = None if machine.holds is None else centre.runs.get(machine.holds)
        return grant is None or (
            point not in centre.lost_points if grant.stage == Stage.STANDING else point in grant.proved
        )

    def held_for(self, centre: Centre, run: Run) -> list[Block]:
        """The blocks that the centre holds for a run."""
        return [block for block, runs in centre.claimed.items() if run in runs]

    def life(self, board: Board) -> UnitLife:
        return board.unit.life
