"""The world: what can happen, one event at a time, and what must never be seen in it.

Every event is a tuple that says all of itself, so that a list of them can be run again.
"""

from __future__ import annotations

from random import Random
from typing import Any

from kernel.names import Block, Cab, Epoch, Point, Position, Read, Record, Route, Run, Tag, Train
from tests.independent.world.cab import BOUNDS
from tests.independent.world.hazards import COLLISION, FREED, POINT, TRACK_ENDS, UNHELD, Hazard
from tests.independent.world.kernel_calls import CENTRE, Calls, Message
from tests.independent.world.rails import Body, Piece, Rails
from tests.independent.world.told import Told
from tests.independent.world.trains import ODOMETER_MM, OVERHANG_MM, WINDOW_MM, OnRails

Event = tuple[Any, ...]
LONGEST_AIR = 60
"""So many messages are in the air at most; the oldest is lost then."""
OVERDUE_MM = 4_000
NO_CAB = Cab("none yet")
LINE_SILENT_CYCLES = 20
MASK = (1 << 64) - 1


class World:
    """One layout with its trains, points, centre and air."""

    def __init__(self, told: Told, kernel: type[Calls], trains: int, seed: int) -> None:
        self.told = told
        self.rails = Rails(told)
        self.calls = kernel(told.layout, told.records)
        self.bits = seed
        self.missed_of_100, self.detection_holds = 0, False
        chance = Random(seed)
        self.lies: dict[Point, Position] = {
            point: Position(chance.choice(sorted(told.network.junctions[point].joins)))
            for point in sorted(told.layout.points)
        }
        self.terminals = {point: self.calls.new_terminal() for point in self.lies}
        self.centre = self.calls.new_centre()
        self.air: list[Message] = []
        self.trains: dict[Train, OnRails] = {}
        self.statements: dict[Train, tuple[Any, ...]] = {}
        self.routes_from: dict[Block, list[Route]] = {block: [] for block in sorted(told.layout.blocks)}
        for route in sorted(told.layout.routes):
            self.routes_from[told.layout.start[route]].append(route)
        for number in range(1, trains + 1):
            self._marshal(Train(f"T{number}"), chance)

    def _marshal(self, name: Train, chance: Random) -> None:
        """Put a train somewhere where it is alone."""
        for _ in range(200):
            track = chance.choice(sorted(self.rails.lengths))
            cars = [chance.choice(self.told.lengths_mm) // 3] * 3
            low = chance.randrange(self.rails.lengths[track])
            body = Body(self.rails, low, low + sum(cars), [Piece(0, self.rails.lengths[track], track, 1)])
            while body.end_mm(1) < body.high and body.lay(1, self.lies):
                pass
            if body.end_mm(1) < body.high:
                continue
            blocks = body.blocks()
            taken = {block for train in self.trains.values() for block in train.blocks}
            taken |= {beside for block in taken for beside in self.told.layout.fouls[block]}
            if blocks & taken or any(len(stretch) < 2 for stretch in body.intervals()):
                continue
            spots = body.intervals()
            if any(a[0] == b[0] and a[1] < b[2] and b[1] < a[2] for a in spots for b in spots if a is not b):
                continue
            body.take_up()
            train = OnRails(name, self.rails, body, cars, self.calls.new_board(0, NO_CAB), self.lies)
            train.way = chance.choice((1, -1))
            train.board = self.calls.new_board(train.place, train.head_cab)
            train.look(self.draw)
            self.trains[name] = train
            return

    def draw(self, below: int) -> int:
        """Small chances of nature, from the number that its event carries."""
        self.bits = (self.bits * 6364136223846793005 + 1442695040888963407) & MASK
        return (self.bits >> 33) % below

    def happen(self, event: Event) -> bool:
        """Let an event happen; whether it changed anything.  Raises :class:`Hazard`."""
        kind, *told = event
        centre, changed = self.centre, getattr(self, kind)(*told)
        if self.centre is not centre:
            for train in self.trains.values():
                self.check_held(train, FREED)
        return bool(changed)

    def starts(self, centre: Any, base: Run) -> list[Block]:
        """The blocks held for a run in which routes begin."""
        held = self.calls.held_for(centre, base)
        return [block for block in self.routes_from if block in held]

    # ---- oracles

    def check_held(self, train: OnRails, kind: str) -> None:
        """Every block that a car is in is held for its train, or lost."""
        for block in train.blocks:
            holders = self.calls.holders(self.centre, block)
            if holders is not None and train.name not in holders:
                whom = ", ".join(sorted(holders)) or "nobody"
                raise Hazard(kind, f"{train.name} is in {block}, held for {whom}")

    def check_apart(self, train: OnRails) -> None:
        """No other train is on the same rails, or within fouling of it."""
        mine = [each for body in (train.body, *train.rest) for each in body.intervals()]
        zones = train.body.zones()
        for other in self.trains.values():
            for body in (other.body, *other.rest) if other is not train else ():
                for track, low, high in body.intervals():
                    if any(track == on and low < to and since < high for on, since, to in mine):
                        raise Hazard(COLLISION, f"{train.name} and {other.name} on {track}")
                if zones and any((pair, 1 - side) in zones for pair, side in body.zones()):
                    raise Hazard(COLLISION, f"{train.name} and {other.name} foul each other")

    # ---- trains

    def move(self, name: Train, cycles: int, short_mm: int | None, bits: int, runs_mm: int | None = None) -> bool:
        """A train runs for some cycles, as far as its brake lets it and its driver wants.

        ``short_mm``: the driver stops so far before the end that he is shown, or ``runs_mm`` from here; none: at once.
        """
        train = self.trains[name]
        self.bits = bits
        if train.isolated or (train.at_rest and short_mm is None):
            return False
        train.errors_mm = self.draw(ODOMETER_MM), self.draw(ODOMETER_MM)
        before, to_mm = train.place, None if runs_mm is None else train.place + runs_mm
        for _ in range(cycles):
            if not self._cycle(train, short_mm, to_mm):
                break
        if train.place == before:
            return False
        self.check_apart(train)
        return True

    def _cycle(self, train: OnRails, short_mm: int | None, to_mm: int | None) -> bool:
        """A tenth of a second; whether it rolls."""
        was, speed = train.speed_mm_s, train.speed_mm_s
        pull = short_mm is not None
        if short_mm:
            end_mm = self.calls.end_mm(train.board) if to_mm is None else to_mm
            pull = train.place + (speed + 100) ** 2 // 2_000 + speed // 5 + short_mm < end_mm
        if not train.whole:
            train.parted_cycles += 1
        demanded = train.demanded or train.parted_cycles > LINE_SILENT_CYCLES
        if self.calls.supervise(train.board, train, demanded, pull and not was):
            train.braked_cycles += 1
            if was == 0 and (train.braked_cycles > BOUNDS.response_cycles or not pull):
                return False
            if train.braked_cycles > BOUNDS.response_cycles:
                speed = max(0, speed - BOUNDS.slows_mm_s2 // 10)
            elif pull:
                speed += BOUNDS.gains_mm_s2 // 10
        else:
            train.braked_cycles = 0
            if pull:
                speed = max(was, min(self.told.speed_mm_s, speed + BOUNDS.gains_mm_s2 // 10))
            else:
                speed = max(0, speed - BOUNDS.slows_mm_s2 // 10)
        if was == speed == 0:
            return False
        train.speed_mm_s = speed
        self._advance(train, max(was, speed) // 10)
        return True

    def _advance(self, train: OnRails, mm: int) -> None:
        """The front gets so much farther; what lies on the way happens in its order."""
        to_mm = train.place + mm
        while train.happenings and train.happenings[-1][0] < to_mm:
            at, _, kind, tag = train.happenings.pop()
            train.go(max(at, train.place))
            if kind == "end":
                self._go_on(train)
            elif kind == "front":
                train.go(train.place + 1)
                self.check_held(train, UNHELD)
                self.calls.follow(train.board, train)
            elif kind == "head":
                assert tag is not None
                self._head(train, tag)
            elif kind == "tail":
                assert tag is not None
                if self.draw(100) >= self.missed_of_100:
                    self.calls.tail_reads(train.board, train.tail_cab, True, self.calls.genuine(tag), train)
                    train.demanded = self.calls.is_open(train.board)
            elif kind == "overdue":
                self.calls.tag_overdue(train.board, train)
                train.demanded = self.calls.is_open(train.board)
        if to_mm > train.place:
            train.go(to_mm)

    def _go_on(self, train: OnRails) -> None:
        """The front comes to where no track is laid on its axis yet."""
        last = train.body.pieces[-1] if train.way > 0 else train.body.pieces[0]
        end = 1 if last.plus == train.way else 0
        point = self.rails.met_at(last.track, end)
        if point is not None and self.calls.is_unlocked(self.terminals[point]):
            raise Hazard(POINT, f"{train.name} comes to {point}, which is free to move")
        if not train.body.lay(train.way, self.lies):
            if point is None:
                raise Hazard(TRACK_ENDS, f"{train.name} at the end of {last.track}")
            raise Hazard(POINT, f"{train.name} comes to {point}, which lies {self.lies[point]}")
        train.body.take_up_behind(train.way)
        train.look(self.draw)

    def _head(self, train: OnRails, tag: Tag) -> None:
        if self.draw(100) < self.missed_of_100:
            train.await_overdue(OVERDUE_MM)
            return
        self.calls.head_reads(train.board, train.head_cab, tag, True, train)
        train.demanded = self.calls.is_open(train.board)

    def turn(self, name: Train, bits: int) -> bool:
        """The driver of a train at rest goes to the other cab."""
        train = self.trains[name]
        if not train.at_rest or not train.whole:
            return False
        self.bits = bits
        train.way = -train.way
        train.body.take_up()
        train.look(self.draw)
        self.calls.change_ends(train.board, train)
        return True

    def read_again(self, name: Train, at_head: bool) -> bool:
        """A train stands with an antenna over a tag and reads it once more."""
        train = self.trains[name]
        near = self.reads_below(train, at_head)
        if near is None:
            return False
        before = train.board.unit
        if at_head:
            self.calls.head_reads(train.board, train.head_cab, near, True, train)
        else:
            self.calls.tail_reads(train.board, train.tail_cab, True, self.calls.genuine(near), train)
        train.demanded = self.calls.is_open(train.board)
        return train.board.unit != before

    def reads_below(self, train: OnRails, at_head: bool) -> Tag | None:
        """The tag below an antenna of a train at rest."""
        if not train.at_rest or not train.whole:
            return None
        at = train.place - (OVERHANG_MM if at_head else train.length_mm - OVERHANG_MM)
        for low, high, track, plus in train.body.pieces:
            for mm, _, tag in self.rails.marks[track]:
                if tag is not None and abs(train.way * (low + mm if plus > 0 else high - mm) - at) <= WINDOW_MM:
                    return tag
        return None

    def read_foreign(self, name: Train, at_head: bool, tag: Tag) -> bool:
        """An antenna reads a copied or damaged tag: the number is right, what is written is not."""
        train = self.trains[name]
        before = train.board.unit
        if at_head:
            self.calls.head_reads(train.board, train.head_cab, tag, True, train)
        elif train.whole:
            self.calls.tail_reads(train.board, train.tail_cab, True, Read(tag, Record("copied")), train)
        train.demanded = self.calls.is_open(train.board)
        return train.board.unit != before

    def part(self, name: Train, coupling: int) -> bool:
        """A coupling breaks; what is behind it stays where it is."""
        train = self.trains[name]
        if not train.whole:
            return False
        left_mm = sum(train.cars_mm[:coupling])
        body = train.body
        if train.way > 0:
            left = Body(self.rails, body.low, body.low + left_mm, list(body.pieces))
            body.low = left.high
        else:
            left = Body(self.rails, body.high - left_mm, body.high, list(body.pieces))
            body.high = left.low
        left.take_up()
        train.rest.append(left)
        train.happenings = [each for each in train.happenings if each[2] not in ("tail", "rear")]
        return True

    def restart_board(self, name: Train, isolated_in: Epoch | None = None) -> bool:
        train = self.trains[name]
        self.calls.restart_board(train.board, train, isolated_in)
        train.demanded = False
        return True

    def ask_anew(self, name: Train) -> bool:
        """The driver asks to be located: the next challenge is answered, though one was."""
        self.trains[name].board.asks_anew = True
        return True

    def note_stopped(self, name: Train, run: Run) -> bool:
        train = self.trains[name]
        before = train.board.unit
        self.calls.note_stopped(train.board, run, train)
        return train.board.unit is not before

    # ---- points

    def throw(self, point: Point, position: Position) -> bool:
        """A point that is free to move does: thrown, or of itself."""
        if not self.calls.is_unlocked(self.terminals[point]) or self.lies[point] == position:
            return False
        self.lies[point] = position
        for train in self.trains.values():
            train.thrown += 1
            for body in (train.body, *train.rest):
                if point in body.points():
                    raise Hazard(POINT, f"{point} moves under {train.name}")
            laid = len(train.body.pieces)
            train.body.take_up()
            if len(train.body.pieces) != laid:
                train.look(self.draw)
            self.calls.follow(train.board, train)
        return True

    def lock(self, point: Point) -> bool:
        before = self.terminals[point]
        self.terminals[point] = self.calls.lock(before, self.lies[point])
        return self.terminals[point] != before

    def restart_terminal(self, point: Point) -> bool:
        self.terminals[point] = self.calls.restart_terminal(self.terminals[point])
        return True

    # ---- the centre and who works there

    def request(self, train: Train, route: Route, base: Run) -> bool:
        return self._centre(self.calls.request(self.centre, train, base.life, route, base))

    def withdraw(self, run: Run) -> bool:
        return self._centre(self.calls.withdraw(self.centre, run))

    def cancel(self, run: Run) -> bool:
        return self._centre(self.calls.cancel(self.centre, run))

    def open_first_loop(self, run: Run) -> bool:
        return self._centre(self.calls.open_first_loop(self.centre, run))

    def retire(self, run: Run) -> bool:
        return self._centre(self.calls.retire(self.centre, run))

    def recover_block(self, block: Block) -> bool:
        return self._centre(self.calls.recover_block(self.centre, block))

    def recover_point(self, point: Point) -> bool:
        return self._centre(self.calls.recover_point(self.centre, point))

    def restart_centre(self) -> bool:
        return self._centre(self.calls.restart_centre(self.centre))

    def _centre(self, centre: Any) -> bool:
        changed: bool = centre != self.centre
        if changed:
            self.centre = centre
        return changed

    # ---- two persons on the spot

    def isolate(self, train: Train) -> bool:
        """The procedure is opened; the first person isolates the unit of a train at rest, and scotches it."""
        if not self.trains[train].at_rest:
            return False
        self.centre = self.calls.open_procedure(self.centre, train)
        self.restart_board(train, self.centre.epoch)
        self.trains[train].wait_braked()
        self.trains[train].isolated = True
        return True

    def reconnect(self, train: Train) -> bool:
        """The unit is given back its train, in the life it was isolated in."""
        was, self.trains[train].isolated = self.trains[train].isolated, False
        return was

    def state(self, train: Train, blocks: frozenset[Block]) -> bool:
        """The first person states what its unit shows, and where it stands, rightly or not; he may correct himself."""
        if not self.trains[train].isolated:
            return False
        said = (train, (unit := self.trains[train].board.unit).life, unit.isolated_in, blocks)
        self.statements[train] = said
        return self._send(("statement", CENTRE, *said))

    def confirm(self, train: Train) -> bool:
        """The second person looks for himself where the train stands that the first has spoken of."""
        said = self.statements.get(train)
        there = self.trains[train]
        if said is None or not there.isolated or said[1] != there.board.unit.life:
            return False
        return self._send(("confirmed statement", CENTRE, *said[:3], there.blocks))

    # ---- the air

    def _send(self, message: Message | None) -> bool:
        if message is None or message in self.air:
            return False
        if len(self.air) >= LONGEST_AIR:
            self.air.pop(0)
        self.air.append(message)
        return True

    def says(self, event: Event) -> list[Message]:
        """The messages that an event would send, if its machine's state says so."""
        kind, *told = event
        found = getattr(self, f"_{kind}")(*told)
        return [message for message in found if message is not None]

    def centre_challenges(self, train: Train) -> bool:
        return self._send_all("centre_challenges", train)

    def _centre_challenges(self, train: Train) -> list[Message | None]:
        return [self.calls.challenge(self.centre, train)]

    def centre_says(self, run: Run) -> bool:
        return self._send_all("centre_says", run)

    def _centre_says(self, run: Run) -> list[Message | None]:
        return [self.calls.word_on(self.centre, run)] if run in self.centre.runs else []

    def centre_orders(self, run: Run, point: Point) -> bool:
        return self._send_all("centre_orders", run, point)

    def _centre_orders(self, run: Run, point: Point) -> list[Message | None]:
        return [self.calls.order(self.centre, run, point)]

    def centre_enquires(self, run: Run, point: Point) -> bool:
        return self._send_all("centre_enquires", run, point)

    def _centre_enquires(self, run: Run, point: Point) -> list[Message | None]:
        return [self.calls.enquiry(self.centre, run, point)]

    def train_says(self, name: Train, what: str, run: Run | None) -> bool:
        return self._send_all("train_says", name, what, run)

    def _train_says(self, name: Train, what: str, run: Run | None) -> list[Message | None]:
        board = self.trains[name].board
        if run is None:
            return [self.calls.answered(board, name, self.centre.epoch)]
        if run not in self.calls.orders(board):
            return []
        if what == "tail report":
            return [*self.calls.tail_reports(board, run)]
        says = {"echo": self.calls.echo, "given back": self.calls.given_back, "stopped": self.calls.stopped}
        return [says[what](board, run)]

    def point_says(self, point: Point, what: str) -> bool:
        return self._send_all("point_says", point, what)

    def _point_says(self, point: Point, what: str) -> list[Message | None]:
        machine = self.terminals[point]
        if what == "life":
            return [self.calls.terminal_life(machine, point)]
        return [self.calls.confirms(machine, point, self.lies[point])]

    def _send_all(self, *event: Any) -> bool:
        return True in [self._send(message) for message in self.says(event)]

    def lose(self, message: Message) -> bool:
        if message not in self.air:
            return False
        self.air.remove(message)
        return True

    def deliver(self, message: Message, again: bool) -> bool:
        """A message arrives; it may do so again.  A point's contacts may show nothing then."""
        if message not in self.air:
            return False
        if not again:
            self.air.remove(message)
        to = message[1]
        if to == CENTRE:
            return self._centre(self.calls.centre_hears(self.centre, message))
        if to in self.terminals:
            before = self.terminals[to]
            contacts = self.detection_holds or (self.bits >> 17) + len(self.air) & 3 > 0
            self.terminals[to] = self.calls.terminal_hears(before, message, self.lies[to], contacts)
            return self.terminals[to] != before
        return self._board_hears(self.trains[to], message)

    def keep_another(self, message: Message, number: int) -> bool:
        """A unit to which a list arrives keeps another."""
        if message not in self.air:
            return False
        kept = self.calls.another_list(message, number)
        return kept is not None and self._board_hears(self.trains[message[1]], kept)

    def _board_hears(self, train: OnRails, message: Message) -> bool:
        if train.isolated and message[0] == "challenge":
            return False
        before = train.board.unit
        onward = self.calls.board_hears(train.board, message, train)
        if train.board.unit is not before:
            train.demanded = self.calls.is_open(train.board)
            if message[0] == "standing run":
                train.isolated = False
        sent = [self._send(each) for each in onward]
        return True in sent or train.board.unit is not before
