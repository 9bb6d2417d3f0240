"""Every call that this world makes of the kernel, and nothing else: when the kernel changes, this file does.

Messages are tuples: their kind, to whom they go, and what they carry.  What goes on board of one train is a
:class:`Board`, which the world passes in and out without looking into it but through this file.
"""

from __future__ import annotations

from bisect import bisect_left, bisect_right
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

from kernel import (
    authority,
    cancellation,
    change_of_ends,
    first_loop,
    recovery,
    release,
    route_setting,
    second_loop,
    standing,
    tail_evidence,
    terminal,
)
from kernel.centre import NO_RUNS, Centre
from kernel.layout import Layout, TagRecords
from kernel.machine import centre as machine_of_centre
from kernel.machine import messages, point_terminal
from kernel.machine import unit as machine_of_unit
from kernel.machine.point_terminal import Contacts
from kernel.machine.unit import Place
from kernel.maps import Map
from kernel.names import (
    Block,
    Cab,
    Epoch,
    Point,
    Position,
    Read,
    Route,
    Run,
    Stage,
    Tag,
    TagList,
    Train,
    UnitLife,
)
from kernel.onboard import authority_end, braking
from kernel.onboard.braking import Brake
from kernel.tag_list import TagPlan
from kernel.tag_list_text import what_they_say, with_tag_lists
from kernel.terminal import Terminal
from kernel.unit import Unit
from tests.independent.world.cab import BOUNDS, moving, put_on, standstill
from tests.independent.world.sight import Sight, line

Message = tuple[Any, ...]
CENTRE = "centre"
STANDING = machine_of_centre.NO_ROUTE
HEARD: dict[str, Callable[..., messages.ToCentre]] = {
    "echo": messages.Echo,
    "confirmation": messages.Confirmation,
    "tail report": messages.TailReport,
    "stopped": messages.Stopped,
    "given back": messages.GivenBack,
    "life": messages.TerminalTold,
    "standing": messages.Standing,
    "statement": messages.FirstStatement,
    "confirmed statement": messages.SecondStatement,
}
"""What the centre hears, by the kind of the message."""
BEHIND_MM = 2_000
"""So far behind the front a list may end and still count: more than the odometer is ever wrong."""


@dataclass
class Board:
    """What is on board of one train.

    ``begins_mm``, ``ends_mm``: where the blocks of its orders lie, as it runs; ``marks_mm``: all these in a row.
    ``asked``: for which unit the brake was asked last, and between which of the places the front was.
    ``kept``: for kernels that keep what a cab's tail has read.  ``asks_anew``: the driver asks to be located.
    """

    unit: Unit
    brake: Brake
    begins_mm: dict[Run, int] = field(default_factory=dict)
    ends_mm: dict[Run, Map[Block, int]] = field(default_factory=dict)
    marks_mm: list[int] = field(default_factory=list)
    asked: tuple[Unit, tuple[int, int, int]] | None = None
    kept: tuple[Cab, Read] | None = None
    asks_anew: bool = False


class Calls:
    """The kernel, as this world drives it, for one layout."""

    def __init__(self, layout: Layout, records: TagRecords) -> None:
        self.layout = layout = with_tag_lists(layout)
        self.records = records
        self.route_of = {tag_list: route for route, tag_list in layout.tag_list.items()}
        self.lists = what_they_say(layout.tag_list.values())
        self.plan = TagPlan(layout.tag_in, layout.partner, layout.stands_in)

    # ---- beginnings and restarts: what survives is docs/persistence.md

    def new_centre(self) -> Centre:
        return machine_of_centre.start(self.layout, machine_of_centre.NEVER_STARTED)

    def restart_centre(self, centre: Centre) -> Centre:
        return machine_of_centre.start(self.layout, machine_of_centre.to_write(centre))

    def tell(self, centre: Centre, told: messages.ToCentre) -> Centre:
        return machine_of_centre.answer(self.layout, self.records, centre, told)

    def new_board(self, front_mm: int, cab: Cab) -> Board:
        unit = change_of_ends.change_ends(self.lists, machine_of_unit.start(machine_of_unit.NEVER_STARTED), cab)
        return Board(unit, braking.stand_still(front_mm))

    def restart_board(self, board: Board, sight: Sight, isolated_in: Epoch | None = None) -> None:
        """After a restart, or once isolated, the driver chooses his direction anew."""
        board.asks_anew = False
        if isolated_in is None:
            board.unit = machine_of_unit.start(board.unit.life)
        else:
            board.unit = self.told(board, messages.Isolation(isolated_in), sight)
        self.begin_anew(board, sight)

    def begin_anew(self, board: Board, sight: Sight) -> None:
        """The driver sits in the cab at the head; the brake is on, and reckons along the direction it looks in."""
        board.unit = change_of_ends.change_ends(self.lists, board.unit, sight.head_cab)
        board.brake = braking.stand_still(sight.front_mm[1])
        self.follow(board, sight)

    def new_terminal(self) -> Terminal:
        return point_terminal.start(point_terminal.NEVER_STARTED)

    def restart_terminal(self, machine: Terminal) -> Terminal:
        return point_terminal.start(point_terminal.to_write(machine))

    # ---- what the signaller and the centre do of themselves

    def request(self, centre: Centre, train: Train, life: UnitLife, route: Route, base: Run) -> Centre:
        return self.tell(centre, messages.Request(self.run_of(centre, train, life, route), base))

    def is_refused(self, centre: Centre, train: Train, route: Route, base: Run) -> bool:
        run = self.run_of(centre, train, base.life, route)
        return route_setting.request_refusal(self.layout, centre, run, base) is not None

    def run_of(self, centre: Centre, train: Train, life: UnitLife, route: Route) -> Run:
        return machine_of_centre.next_run(centre, train, life, route)

    def withdraw(self, centre: Centre, run: Run) -> Centre:
        return self.tell(centre, messages.Withdrawal(run))

    def cancel(self, centre: Centre, run: Run) -> Centre:
        return self.tell(centre, messages.Cancellation(run))

    def open_first_loop(self, centre: Centre, run: Run) -> Centre:
        return route_setting.open_first_loop(self.layout, centre, run)

    def retire(self, centre: Centre, run: Run) -> Centre:
        return release.retire(centre, run)

    def recover_block(self, centre: Centre, block: Block) -> Centre:
        return recovery.recover_block(self.layout, centre, block)

    def recover_point(self, centre: Centre, point: Point) -> Centre:
        return recovery.recover_point(self.layout, centre, point)

    def open_procedure(self, centre: Centre, train: Train) -> Centre:
        return self.tell(centre, messages.Procedure(train))

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
        return ("order", run.train, run, point, self.layout.needs[run.route][point], life)

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
            return ("offer", run.train, run, self.layout.tag_list[run.route])
        if route_setting.permits(centre, run):
            return ("permit", run.train, run)
        if recovery.acknowledges_standing(centre, run):
            return ("standing run", run.train, run)
        return None

    # ---- what the centre receives

    def centre_hears(self, centre: Centre, message: Message) -> Centre:
        kind, _, *told = message
        if kind in ("standing", "statement", "confirmed statement"):
            return self.centre_hears_of_standing(centre, kind, *told)
        return self.tell(centre, HEARD[kind](*told))

    def centre_hears_of_standing(
        self, centre: Centre, kind: str, train: Train, life: UnitLife, epoch: Epoch, blocks: frozenset[Block]
    ) -> Centre:
        return self.tell(centre, HEARD[kind](train, life, epoch, blocks))

    # ---- what a train receives

    def told(self, board: Board, told: messages.ToUnit | messages.Isolation, sight: Sight) -> Unit:
        """What becomes of a unit by what it is told."""
        place = Place(sight.blocks, standstill(sight, board.brake), line(sight.whole), board.asks_anew)
        return machine_of_unit.answer(self.lists, board.unit, told, place)

    def board_hears(self, board: Board, message: Message, sight: Sight) -> list[Message]:
        """Take a message on board; what it passes on."""
        kind, _, *told = message
        if kind == "order":
            passed = machine_of_unit.passes_on(self.plan, self.lists, board.unit, messages.PointOrder(*told))
            run, point, position, life = told
            return [("relayed order", point, run, position, life) for _ in passed]
        if kind == "enquiry":
            run, point, life = told
            return [("relayed enquiry", point, run, life)]
        if kind == "confirmed":
            return [("confirmation", CENTRE, *told)]
        if kind == "challenge":
            self.answer(board, told[0], sight)
        else:
            self.take(board, kind, sight, *told)
        self.follow(board, sight)
        return []

    def another_list(self, message: Message, number: int) -> Message | None:
        """The same offer, of which a unit keeps the list of another route from there: it has mixed them up."""
        kind, train, run, *_ = message
        start, lists = self.layout.start, self.layout.tag_list
        others = sorted(lists[route] for route in lists if route != run.route and start[route] == start[run.route])
        return (kind, train, run, others[number % len(others)]) if others else None

    def take(self, board: Board, kind: str, sight: Sight, run: Run, *lists: TagList) -> None:
        if kind == "recall":
            self.recall(board, run, sight)
        elif kind == "offer":
            board.unit = self.told(board, messages.Offer(run, *lists), sight)
        else:
            takes = messages.Permit if kind == "permit" else messages.StandingRun
            board.unit = self.told(board, takes(run), sight)

    def recall(self, board: Board, run: Run, sight: Sight) -> None:
        board.unit = self.told(board, messages.Recall(run), sight)

    def give_back(self, board: Board, sight: Sight) -> None:
        """Give back, at rest, what is wanted and what the brake keeps the train out of, the last runs first."""
        orders = board.unit.orders
        wanted = {run for run in orders if orders[run].recalled and not orders[run].begun | orders[run].given_back}
        if wanted:
            board.brake = put_on(board.brake, sight)
            self.obey(board, sight)
        for run in sorted(wanted & set(board.ends_mm), reverse=True):
            held_mm, end_mm = board.brake.end_mm, board.ends_mm[run][self.layout.start[run.route]]
            at = standstill(sight, board.brake)
            board.unit = first_loop.give_back(self.lists, board.unit, run, at, held_mm, end_mm)

    def answer(self, board: Board, epoch: Epoch, sight: Sight) -> None:
        before = board.unit
        if board.asks_anew or not standing.tells_standing(before, epoch):
            board.brake = put_on(board.brake, sight)
            board.unit = self.told(board, messages.Challenge(epoch), sight)
        if board.unit is not before:
            board.asks_anew = False
            self.begin_anew(board, sight)

    # ---- what a train reads and notes

    def head_reads(self, board: Board, cab: Cab, tag: Tag, in_window: bool, sight: Sight) -> None:
        board.unit = second_loop.note_head_read(self.plan, self.lists, board.unit, cab, tag, in_window)
        self.follow(board, sight)

    def tag_overdue(self, board: Board, sight: Sight) -> None:
        board.unit = second_loop.note_window_passed(board.unit)
        self.follow(board, sight)

    def tail_reads(self, board: Board, cab: Cab, healthy: bool, read: Read, sight: Sight) -> None:
        board.unit = tail_evidence.note_tail_read(self.plan, self.lists, board.unit, cab, line(healthy), read)
        self.follow(board, sight)

    def genuine(self, tag: Tag) -> Read:
        return Read(tag, self.records.record[tag])

    def note_stopped(self, board: Board, run: Run, sight: Sight) -> None:
        """By odometer and tags: its driver holds it still, its front inside the destination."""
        ends_mm = board.ends_mm.get(run)
        if ends_mm is None:
            return
        board.brake = put_on(board.brake, sight)
        end_mm = ends_mm[self.layout.destination[run.route]]
        begin_mm = max((each for _, each in ends_mm.items() if each < end_mm), default=board.begins_mm[run])
        at = standstill(sight, board.brake)
        board.unit = authority.note_stopped(self.lists, board.unit, run, at, begin_mm, end_mm)
        self.follow(board, sight)

    def change_ends(self, board: Board, sight: Sight) -> None:
        board.brake = put_on(board.brake, sight)
        self.begin_anew(board, sight)

    # ---- what a train sends

    def answered(self, board: Board, train: Train, epoch: Epoch) -> Message | None:
        told = ("standing", CENTRE, train, board.unit.life, epoch, board.unit.standing_in)
        return told if standing.tells_standing(board.unit, epoch) else None

    def echo(self, board: Board, run: Run) -> Message | None:
        kept = board.unit.orders[run].tag_list
        return ("echo", CENTRE, run, kept) if kept is not None and first_loop.echoes(board.unit, run, kept) else None

    def given_back(self, board: Board, run: Run) -> Message | None:
        gives = run.route != STANDING and first_loop.acknowledges_back(board.unit, run)
        return ("given back", CENTRE, run) if gives else None

    def stopped(self, board: Board, run: Run) -> Message | None:
        tells = run.route != STANDING and authority.tells_stopped(board.unit, run)
        return ("stopped", CENTRE, run) if tells else None

    def tail_reports(self, board: Board, run: Run) -> list[Message]:
        return [
            ("tail report", CENTRE, run, block, seen.left, seen.entered)
            for block, seen in board.unit.orders[run].left.items()
            if tail_evidence.reports_left(self.lists, board.unit, run, block, seen.left, seen.entered)
        ]

    # ---- the brake

    def is_open(self, board: Board) -> bool:
        return board.unit.loop_open

    def follow(self, board: Board, sight: Sight) -> None:
        """From what the unit knows to what the brake must do, and what can be given back by that."""
        self.look_up(board, sight)
        self.obey(board, sight)
        before = board.unit
        self.give_back(board, sight)
        if board.unit is not before:
            self.obey(board, sight)

    def look_up(self, board: Board, sight: Sight) -> None:
        """The lists of all orders that do not lie behind the train."""
        board.begins_mm, board.ends_mm = {}, {}
        least_mm = sight.front_mm[0] - BEHIND_MM
        for run, order in board.unit.orders.items():
            found = None if order.tag_list is None else sight.ends_mm(self.route_of[order.tag_list])
            if found is not None and any(end_mm >= least_mm for _, end_mm in found[1].items()):
                board.begins_mm[run], board.ends_mm[run] = found
        places = {end_mm for ends_mm in board.ends_mm.values() for _, end_mm in ends_mm.items()}
        board.marks_mm, board.asked = sorted(places | set(board.begins_mm.values())), None

    def obey(self, board: Board, sight: Sight) -> None:
        """What the brake becomes in this cycle; asked again only where the answer may be another one."""
        least_mm, most_mm = sight.front_mm
        marks = board.marks_mm
        where = bisect_left(marks, least_mm), bisect_right(marks, least_mm), bisect_left(marks, most_mm)
        before, board.asked = board.asked, (board.unit, where)
        same = before is not None and before[0] is board.unit and before[1] == where
        if same and not board.brake.withheld:
            return
        board.brake = self.obeyed(board, least_mm, most_mm, sight.speed_mm_s)

    def obeyed(self, board: Board, least_mm: int, most_mm: int, speed_mm_s: int) -> Brake:
        asked = (self.lists, board.unit, board.begins_mm, board.ends_mm, BOUNDS, board.brake)
        (brake,) = authority_end.obey(*asked, moving(least_mm, most_mm, speed_mm_s))
        return brake

    def end_mm(self, board: Board) -> int:
        """The end that the driver is shown."""
        return board.brake.end_mm

    def supervise(self, board: Board, sight: Sight, demanded: bool, acknowledged: bool) -> bool:
        """One cycle of the brake; whether it is on."""
        self.obey(board, sight)
        most_mm, speed_mm_s = sight.front_mm[1], sight.speed_mm_s
        board.brake = braking.supervise(BOUNDS, board.brake, most_mm, speed_mm_s, speed_mm_s, demanded, acknowledged)
        return board.brake.applied

    def could_start(self, board: Board, front_most_mm: int, demanded: bool) -> bool:
        """Whether the brake could be released at a standstill."""
        return not braking.supervise(BOUNDS, board.brake, front_most_mm, 0, 0, demanded, True).applied

    # ---- points

    def terminal_hears(self, machine: Terminal, message: Message, detected: Position, is_detected: bool) -> Terminal:
        kind, point, run, *told = message
        heard = messages.PointOrder if kind == "relayed order" else messages.PointEnquiry
        return point_terminal.answer(machine, heard(run, point, *told), Contacts(detected, is_detected))

    def lock(self, machine: Terminal, detected: Position) -> Terminal:
        return point_terminal.answer(machine, messages.Tick(), Contacts(detected, True))

    def is_unlocked(self, machine: Terminal) -> bool:
        return machine.unlocked

    def wanted(self, machine: Terminal) -> Position | None:
        return machine.wanted

    def terminal_life(self, machine: Terminal, point: Point) -> Message:
        return ("life", CENTRE, point, machine.life)

    def confirms(self, machine: Terminal, point: Point, detected: Position) -> Message | None:
        run = machine.holds
        holds = run is not None and terminal.confirms(machine, run, detected, detected, True)
        return ("confirmed", run.train, run, point, detected) if run is not None and holds else None

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
        return order.given_back if grant.cancelling else grant.stage != Stage.SET or order.permitted

    def is_ahead(self, centre: Centre, board: Board, run: Run) -> bool:
        """Whether a route is set or wanted that the train has not begun to run by."""
        order = board.unit.orders.get(run)
        over = run.route == STANDING or centre.runs[run].stage == Stage.OVER
        return not over and (order is None or not order.begun)

    def is_proved(self, centre: Centre, machine: Terminal, point: Point) -> bool:
        """Whether the centre needs no more word of a point's lock."""
        grant = None if machine.holds is None else centre.runs.get(machine.holds)
        stands = grant is not None and grant.stage == Stage.STANDING
        return grant is None or (point not in centre.lost_points if stands else point in grant.proved)

    def held_for(self, centre: Centre, run: Run) -> list[Block]:
        """The blocks that the centre holds for a run."""
        return [block for block, runs in centre.claimed.items() if run in runs]

    def life(self, board: Board) -> UnitLife:
        return board.unit.life
