"""What becomes of a train, second by second: it tells where it stands, asks for its routes, runs, arrives, and goes on.

The timetable asks and the kernel decides.  Here is also what staff does, lawfully, when a train has stopped.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from random import Random

from kernel.authority import may_proceed
from kernel.machine.messages import Cancellation, Request, Withdrawal
from kernel.names import Block, Route, Run, Stage, Train
from kernel.route_setting import request_refusal
from models.simulation.ahead import ahead, follows_the_way
from models.simulation.diary import BRAKE, TRAIN, Diary
from models.simulation.driver import margin_mm
from models.simulation.facing import Orders, exits, leads_back, leads_forward
from models.simulation.foresight import Board, Foresight, Standing, far
from models.simulation.onboard import LOCATED_WITHIN_MM
from models.simulation.parted import TAKEN_OFF_S, Parted
from models.simulation.phases import HAS_PARTED, Phase
from models.simulation.staff import Staff
from models.simulation.talking import Talk
from models.simulation.timetable import Trip, Ways
from models.simulation.vehicle import SETTLES_CYCLES, Line, Vehicle
from models.simulation.waiting import Barred, barred
from models.simulator.machines import next_run, restart_unit, tell_centre

ASKS_AHEAD_MM = 3_000_000
STAYS_S, AGAIN_S, PATIENCE_S, STAFF_S = (30, 90), 10, 240, (300, 900)
DIVERTED_S = 180
"""A train of random traffic that cannot make for its goal for so long gets another."""
WIDE_MM = 3 * LOCATED_WITHIN_MM
HELD_TOO_LONG_S = 60
"""A train at rest for which the centre still holds what it has left tells anew where it stands."""


@dataclass
class Office:
    """What the trains' services share: the diary, the dispatcher's foresight, and where all the trains are.

    ``diverts``: a train that cannot make for its goal for long gets another one; else its timetable stands.
    ``deadlocked``: the trains of which each way on is barred by one of them, or by one that will not move any more.
    ``orders``: which end of a train leads in each run.
    ``lets_depart``: whether the roads that are near ahead of a train are closed for it.
    """

    diary: Diary
    foresight: Foresight
    board: Callable[[], Board]
    diverts: bool
    deadlocked: Callable[[], frozenset[Train]]
    orders: Orders
    lets_depart: Callable[[Train], bool]


class Service:
    """One train and what it is about.

    ``base``: the run it stands or moves under.  ``run``: the one asked for, or being run.
    ``onward``: the one set ahead.  ``arrived``: the one at whose end it stands, until it has said so.
    ``done``: trips at their end; ``begun``: it makes for the next goal.
    ``waits``: the ways on that were refused when it asked last.
    """

    def __init__(self, vehicle: Vehicle, trips: list[Trip], line: Line, talk: Talk, ways: Ways, office: Office) -> None:
        self.office = office
        self.vehicle = vehicle
        self.train = vehicle.on_rails.name
        self.trips = trips
        self.line = line
        self.play = line.play
        self.talk = talk
        self.ways = ways
        self.diary = office.diary
        self.staff = Staff(vehicle, line.rails, office.diary)
        self.parted = Parted(vehicle, line, office.diary)
        self.random = Random(f"{line.random.random()} {self.train}")
        self.phase = Phase.LOST
        self.base: Run | None = None
        self.arrived: Run | None = None
        self.run: Run | None = None
        self.onward: Run | None = None
        self.done = 0
        self.begun = False
        self.ready_s = 0
        self.since_s = 0
        self.now_s = 0
        self.stopped_until_s = 0
        self.waits: tuple[Barred, ...] = ()
        self.no_way = self.waits_for_staff = False
        self.life_before = self.play.system.units[self.train].life
        self._acts = {
            Phase.LOST: self._tells,
            Phase.STANDS: self._stands,
            Phase.WAITS: self._waits,
            Phase.RUNS: self._runs,
            Phase.PARTED: self._is_attended,
            Phase.STATED: self._is_stated,
            Phase.OFF: self._is_stated,
        }

    # ---- a second

    def second(self, now_s: int) -> None:
        """A second has passed."""
        self.now_s = now_s
        vehicle = self.vehicle
        vehicle.holds = self.phase is not Phase.RUNS or now_s < self.stopped_until_s or self._is_challenged()
        if vehicle.stands and self._stopped_for_good():
            return
        self._acts[self.phase]()

    def become(self, phase: Phase, ready_s: int = 0) -> None:
        """Do something else from now on, not before so many seconds."""
        self.phase, self.since_s, self.ready_s = phase, self.now_s, self.now_s + ready_s
        self.waits = ()

    def _is_challenged(self) -> bool:
        """Whether the centre has restarted, and the train does not stand to answer yet."""
        return self.play.system.units[self.train].answered != self.play.system.centre.epoch

    def _stopped_for_good(self) -> bool:
        """A train at rest whose machines have lost something: staff sets them right first."""
        vehicle, board = self.vehicle, self.vehicle.board
        if vehicle.on_rails.standing and self.phase not in HAS_PARTED:
            self._rests()
            self.become(Phase.PARTED, self.random.randint(*STAFF_S))
            return True
        is_unsure = not board.place.known or (vehicle.at_rest_cycles > SETTLES_CYCLES and not vehicle.settled)
        if is_unsure and not self.staff.locates("is located anew at a standstill"):
            return True
        wholeness = board.computer.known.wholeness
        is_doubted = (wholeness.split or wholeness.lost) and not vehicle.on_rails.standing
        return is_doubted and not self.staff.finds_whole()

    def _rests(self) -> None:
        for run in [run for run in self.play.system.track.rolling if run.train == self.train]:
            self.play.take("come_to_rest", run=run)

    # ---- telling where it stands

    def lose_way(self, why: str) -> None:
        """Its authority is gone: it brakes, and tells at rest, in a new life, where it stands."""
        self.diary.note(BRAKE, self.train, why)
        self.base = self.run = self.onward = self.arrived = None
        self.life_before = self.play.system.units[self.train].life
        self.vehicle.board.hold()
        self.vehicle.look_again()
        self.become(Phase.LOST, 10)

    def may_answer(self) -> bool:
        """Whether its driver lets it answer: it has nothing that it still could run under."""
        return self.phase is Phase.LOST

    def _tells(self) -> None:
        vehicle = self.vehicle
        if not vehicle.stands or self.now_s < self.ready_s:
            return
        self._rests()
        unit, told = self.play.system.units[self.train], self.talk.standing_run(self.train)
        if told is not None and told in unit.orders and unit.life > self.life_before:
            vehicle.restarted = False
            self.base, self.run, self.onward = told, None, None
            self.staff.locates("is told under which run it stands")
            self.become(Phase.STANDS, 5)
        elif unit.answered == self.play.system.centre.epoch and unit.life == self.life_before:
            restart_unit(self.play, self.train)

    # ---- standing, asking

    def _stands(self) -> None:
        if self._is_challenged():
            self.lose_way("is asked by the restarted centre where it stands")
            return
        if self.arrived is not None and not self._tells_that_it_stands(self.arrived):
            return
        if self.begun and self.trips[self.done].goal in self.under:
            self.done, self.begun = self.done + 1, False
            self.diary.note(TRAIN, self.train, f"has arrived at {self.trips[self.done - 1].goal}")
        if self.now_s < self.ready_s:
            return
        self.ready_s = self.now_s + AGAIN_S
        if self.now_s - self.since_s > HELD_TOO_LONG_S and self._holds_what_it_left():
            self.lose_way("is held in blocks that it has left, and tells anew where it stands")
            return
        if self.finished or self.now_s < self.trips[self.done].begins_s:
            return
        self.begun = self.begun or self._begins()
        if self.begun:
            self._ask(self.base, self._routes(), "run")
            if self.train in self.office.deadlocked():
                self._is_diverted()

    def _begins(self) -> bool:
        """Make for the next goal, as soon as that bars nobody's way."""
        goal = self.trips[self.done].goal
        if goal in self.under:
            return True
        board, foresight = self.office.board(), self.office.foresight
        if not foresight.lets_begin(board, self.train, goal):
            bar = foresight.barring(board, self.train, goal)
            self.waits = () if bar is None else (bar,)
            return self._is_diverted()
        self.waits = ()
        self.diary.note(TRAIN, self.train, f"makes for {goal}")
        return True

    def _is_diverted(self) -> bool:
        """Make for another goal, if this one has been out of reach for long."""
        goal, begins_s = self.trips[self.done].goal, self.trips[self.done].begins_s
        if not self.office.diverts or self.now_s - max(self.since_s, begins_s) < DIVERTED_S:
            return False
        other = far(self.office.foresight, self.office.board(), self.train, self.ways.places, self.random)
        if other is None:
            return False
        self.diary.note(TRAIN, self.train, f"cannot make for {goal}, and is diverted")
        self.trips[self.done] = Trip(other, self.now_s)
        self.waits = ()
        self.diary.note(TRAIN, self.train, f"makes for {other}")
        return True

    @property
    def under(self) -> frozenset[Block]:
        """The blocks it is in."""
        at, rails = self.play.system.track.at, self.vehicle.on_rails
        return frozenset(block for car in (*rails.cars, *rails.standing) for block in at[car])

    @property
    def standing(self) -> Standing:
        """Where it is, or will be when it has run what it was granted, and where it makes for."""
        run = self.onward or self.run
        blocks = self.under if run is None else frozenset({self.play.site.layout.destination[run.route]})
        stays = not self.begun or self.phase in HAS_PARTED
        ways_on = self._ways_on() if run is None and len(blocks) > 1 else None
        return Standing(blocks, None if stays else self.trips[self.done].goal, ways_on)

    @property
    def finished(self) -> bool:
        """Whether all its trips are at their end."""
        return self.done >= len(self.trips)

    def _holds_what_it_left(self) -> bool:
        """Whether the centre holds blocks for it in which it is not, beside those of a route ahead."""
        at = self.under
        return any(
            block not in at and any(run.train == self.train for run in runs)
            for block, runs in self.play.system.centre.claimed.items()
        )

    def _routes(self) -> list[Route]:
        """The routes from where it stands that lead towards its goal, and not back over it."""
        goal = self.trips[self.done].goal
        if len(self.under) > 1:
            return self.ways.shortest_first(self._ways_on(), goal)
        return [route for start in self.under for route in self.ways.towards(start, goal) if route in self._ways_on()]

    def _ways_on(self) -> frozenset[Route]:
        """The routes that it can run from where it stands, as it stands or once it has changed ends."""
        layout, under = self.play.site.layout, self.under
        return frozenset(
            route
            for start in under
            for route in self.ways.from_block.get(start, ())
            if under & layout.claims[route] == {start} and (self._leads(route) or self._leads(route, back=True))
        )

    def _leads(self, route: Route, back: bool = False) -> bool:
        """Whether the train leads into a route as it stands, or once it has changed ends."""
        train, tag = self.vehicle.on_rails, self.play.site.layout.first_tag[route]
        front, rear = (self.play.system.track.at[train.cars[end]] for end in (0, -1))
        if self.play.site.layout.start[route] not in (rear if back else front) or (back and train.standing):
            return False
        return (leads_back if back else leads_forward)(self.line.rails, train, tag)

    def _ask(self, base: Run | None, routes: list[Route], what: str) -> None:
        """Ask for the first of some routes that the kernel grants; remember who bars the others."""
        assert base is not None
        layout, refused = self.play.site.layout, list[Barred]()
        self.no_way = not routes and what == "run"
        for route in routes:
            run = next_run(self.play, self.train, route)
            refusal = request_refusal(layout, self.play.system.centre, run, base)
            if refusal is None and not self.office.foresight.lets(self.office.board(), self.train, route):
                continue
            if refusal is None and tell_centre(self.play, Request(run, base)):
                self.office.orders.note(run, self.vehicle.on_rails, what == "onward" or self._leads(route))
                setattr(self, what, run)
                if what == "run":
                    self.become(Phase.WAITS)
                self.talk.with_train(self.train)
                return
            if refusal is not None:
                refused.append(barred(layout, self.play.system.centre, run, refusal))
        if what == "run":
            if refused and not self.waits:
                self.diary.note(TRAIN, self.train, f"waits: {refused[0].refusal.value}")
            self.waits = tuple(refused)

    # ---- waiting for its route

    def _waits(self) -> None:
        assert self.run is not None
        order = self.play.system.units[self.train].orders.get(self.run)
        grant = self.play.system.centre.runs.get(self.run)
        if self._is_challenged():
            self.lose_way("is asked by the restarted centre where it stands")
        elif grant is None or grant.stage == Stage.OVER:
            self.run = None
            self.become(Phase.STANDS, AGAIN_S)
        elif order is not None and order.recalled:
            self._faces(self.run)
        elif order is not None and order.permitted and not order.given_back:
            if not grant.cancelling:
                self._departs(self.run)
        elif self.now_s - self.since_s > PATIENCE_S:
            self._gives_up(self.run, grant.stage)

    def _gives_up(self, run: Run, stage: Stage) -> None:
        """The signaller takes a route back that does not come about."""
        self.since_s = self.now_s
        tell_centre(self.play, Withdrawal(run) if stage == Stage.RESERVED else Cancellation(run))

    def _departs(self, run: Run) -> None:
        vehicle, board = self.vehicle, self.vehicle.board
        if not vehicle.settled:
            return
        if not self._leads(run.route) and not self._turns():
            return
        if not self.office.lets_depart(self.train):
            return
        self._forgets()
        self._survey(run)
        vehicle.run = run
        vehicle.demanded(self.play)
        board.decide(vehicle.demanded(self.play), True)
        self.play.take("change_ends", train=self.train, cab=self.play.site.formation.front[run])
        self.play.take("start_rolling", run=run)
        vehicle.advance(self.line)
        self.become(Phase.RUNS)
        self._aims()

    def _faces(self, run: Run) -> None:
        """A run is wanted back before the train departs: only a train that faces it can say that it is short of it."""
        vehicle, order = self.vehicle, self.play.system.units[self.train].orders[run]
        if not vehicle.settled or order.given_back or run in vehicle.board.lists:
            return
        if not self._leads(run.route) and not self._turns():
            return
        self._survey(run)
        vehicle.demanded(self.play)

    def _forgets(self) -> None:
        """Of the lists only that of the run before the new one is of use."""
        board = self.vehicle.board
        board.lists = {each: listed for each, listed in board.lists.items() if each == self.base}

    def _turns(self) -> bool:
        """Change ends, once the brake holds the train: the range of the rear becomes that of the front."""
        train, board = self.vehicle.on_rails, self.vehicle.board
        if not board.hold():
            return False
        rear_mm, motion = train.rear_mm, board.motion
        self.vehicle.rolled(0.0)
        train.turn()
        top_mm = train.front_mm + rear_mm
        least_mm = top_mm - motion.front_most_mm + board.length_mm
        board.locate(least_mm, top_mm - motion.front_least_mm + board.length_mm)
        return True

    def _survey(self, *runs: Run) -> None:
        """Take the lists of runs that the unit has orders for, and that lead on as the train faces."""
        layout, unit, board = self.play.site.layout, self.play.system.units[self.train], self.vehicle.board
        for run in runs:
            order = unit.orders.get(run)
            if run.route not in layout.routes or order is None or order.given_back or run in board.lists:
                continue
            lies, kinds = self.play.system.track.lies, self.line.kinds
            surveyed = ahead(layout, self.line.rails, self.vehicle.on_rails, run, lies, kinds)
            if follows_the_way(layout, run, surveyed.ends_mm):
                board.lists[run] = surveyed
        self.vehicle.look_again()

    # ---- running

    def _aims(self) -> None:
        board = self.vehicle.board
        self.vehicle.target_mm = board.brake.end_mm - margin_mm(board.motion)

    def _runs(self) -> None:
        vehicle, run = self.vehicle, self.run
        assert run is not None
        self._prolongs()
        self._aims()
        if not vehicle.stands:
            if self.onward is None and vehicle.target_mm - vehicle.front_mm < ASKS_AHEAD_MM:
                self._asks_ahead()
            return
        if not may_proceed(self.play.system.units[self.train], vehicle.run or run):
            self._rests()
            self.lose_way("stands with an open loop")
        elif self._is_challenged():
            self._rests()
            self.lose_way("stops where the restarted centre asks where it stands")
        elif vehicle.settled and not vehicle.holds:
            self._goes_on(run)

    def _goes_on(self, run: Run) -> None:
        """At rest under authority: it goes on, or has arrived, or its range is too wide to go on with."""
        vehicle, board = self.vehicle, self.vehicle.board
        if board.brake.applied and not self.waits_for_staff:
            board.decide(vehicle.demanded(self.play), True)
        wide = board.motion.front_most_mm - board.motion.front_least_mm > WIDE_MM
        if board.brake.withheld and self.staff.names_its_block():
            return
        short = not vehicle.is_there and (board.brake.applied or vehicle.is_barred)
        if self.waits_for_staff or (wide and short):
            self.waits_for_staff = not self.staff.locates("cannot go on with so wide a range, and is located anew")
        elif self.onward is None and (vehicle.is_there or vehicle.is_barred):
            self._arrives(run)

    def _asks_ahead(self) -> None:
        """Ask for a route on in the same direction while still moving."""
        if self.run is None or self.finished or self._is_challenged() or self.now_s < self.ready_s:
            return
        layout, end = self.play.site.layout, self.play.site.layout.destination[self.run.route]
        if end == self.trips[self.done].goal or self.play.system.centre.runs.get(self.run) is None:
            return
        if self.run not in self.vehicle.board.lists:
            return
        ahead_of_it = exits(self.line.rails, self.vehicle.board.lists[self.run].arrives)
        routes = [
            route
            for route in self.ways.towards(end, self.trips[self.done].goal)
            if layout.first_tag[route] in ahead_of_it
            and not layout.covers[route] & (self.under | {layout.start[self.run.route]})
        ]
        self.ready_s = self.now_s + AGAIN_S
        self._ask(self.run, routes, "onward")

    def _prolongs(self) -> None:
        """The run set ahead goes on from this one once it is permitted; or it is given up."""
        if self.onward is None:
            return
        unit, grant = self.play.system.units[self.train], self.play.system.centre.runs.get(self.onward)
        order = unit.orders.get(self.onward)
        if order is not None and order.recalled:
            self._survey(self.onward)
        if may_proceed(unit, self.onward) and grant is not None and not grant.cancelling:
            self._survey(self.onward)
            self.vehicle.run = self.onward
            self.play.take("start_rolling", run=self.onward)
            self.base, self.run, self.onward = self.run, self.onward, None
            self.since_s = self.now_s
        elif grant is None or grant.stage == Stage.OVER:
            self.onward = None
        elif self.vehicle.stands and self.now_s - self.since_s > PATIENCE_S:
            self._gives_up(self.onward, grant.stage)

    def _arrives(self, run: Run) -> None:
        """It stands in its destination: its driver puts the brake on."""
        self._rests()
        self.base, self.run, self.arrived = run, None, run
        self.become(Phase.STANDS, self.random.randint(*STAYS_S))

    def _tells_that_it_stands(self, run: Run) -> bool:
        """Once the brake holds it, odometry and the list of the run say whether it is in the destination (T9)."""
        if not self.vehicle.board.hold():
            return False
        self.arrived = None
        board, destination = self.vehicle.board, self.play.site.layout.destination[run.route]
        bounds_mm = board.lists[run].bounds_mm(destination) if run in board.lists else None
        if bounds_mm is not None:
            begin_mm, end_mm = bounds_mm
            self.play.take("note_stopped", run=run, at=board.standstill, begin_mm=begin_mm, end_mm=end_mm)
        return True

    # ---- a train that has parted

    def _is_attended(self) -> None:
        """Two persons come and state where all of it stands (T8)."""
        if self.now_s >= self.ready_s and self.vehicle.stands:
            self._rests()
            self.parted.state(self.random)
            self.base = self.run = self.onward = None
            if self.under:
                self.become(Phase.STATED, self.random.randint(*TAKEN_OFF_S))
            else:
                self.become(Phase.OFF)

    def _is_stated(self) -> None:
        """After a restart of the centre they state it again; else its cars are taken off."""
        if self.train not in self.play.system.centre.accounted:
            self.become(Phase.PARTED, self.random.randint(*STAFF_S))
        elif self.phase is Phase.STATED and self.now_s >= self.ready_s:
            self.parted.take_off(self.random)
            self.become(Phase.OFF)
