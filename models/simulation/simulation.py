"""A line with its trains, second by second: the agenda, the conversations, the trains, and what goes wrong."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from random import Random
from typing import Any

from kernel.link import Party
from kernel.machine.messages import Cancellation, Tick
from kernel.names import Block, Car, Point, Run, Stage, Train
from kernel.onboard.arithmetic import CYCLE_MS
from kernel.standstill import Standstill, ThroughLine
from models.concrete.drive import NatureRefusedError
from models.concrete.rails import Piece
from models.concrete.train import CAR_MM, OnRails
from models.simulation.agenda import Agenda
from models.simulation.air import Air
from models.simulation.beginning import Plan, begun, rails_of
from models.simulation.crossings import Crossings
from models.simulation.cycles import Cycling, Interpreted
from models.simulation.diary import Diary
from models.simulation.facing import Orders
from models.simulation.faults import BY_NAME
from models.simulation.foresight import Board, Foresight
from models.simulation.links import LIFE_SIGN_S, LIMITS, Addresses, Links
from models.simulation.motors import Motors
from models.simulation.occurrences import Occurrence, occurrences
from models.simulation.onboard import on_board
from models.simulation.oracles import Oracles
from models.simulation.phases import HAS_PARTED, Phase
from models.simulation.posted import Post
from models.simulation.roads import Ways as WaysToRoad
from models.simulation.sensors import sensors
from models.simulation.service import Office, Service
from models.simulation.talking import Talk
from models.simulation.timetable import Ways
from models.simulation.vehicle import Line, Vehicle
from models.simulation.waiting import Waits, deadlocked
from models.simulation.wording import RANGING, Fields, Wording
from models.simulator.machines import restart_centre, restart_terminal, restart_unit, tell_centre
from models.simulator.play import Watcher, begin, site_of
from models.world.state import System

SECOND_MS, CYCLES = 1_000, 1_000 // CYCLE_MS
TALKS_S = 2
"""What is not heard is said again after so long."""


class Simulation:
    """The line, its trains, and everything that is written down of them."""

    def __init__(self, plan: Plan, watch: Watcher | None = None, cycling: Cycling = Interpreted) -> None:
        self.plan, self.cycling = plan, cycling
        self.random = Random(f"{plan.seed} line")
        self.rails = rails_of(plan.imported)
        self.diary = Diary()
        self.agenda = Agenda()
        self.now_s = 0
        names = [Train(f"T{number:02}") for number in range(1, plan.trains + 1)]
        cars = {train: tuple(Car(f"{train}.{number}") for number in range(1, plan.cars + 1)) for train in names}
        orders = Orders(cars)
        made = site_of(plan.imported.layout, plan.imported.ground, plan.imported.records, cars)
        site = replace(made, formation=orders.formation())
        self.ways = Ways(site.layout, self.rails)
        foresight = Foresight(site.layout, self.ways)
        where, trips = begun(plan, names, self.rails, foresight)
        self.oracles = Oracles(site)
        self.air = Air(self.agenda, Random(f"{plan.seed} radio"), plan.chosen)
        self.addresses = Addresses(names, site.layout.points, (road.name for road in plan.roads))
        self.post = Post(LIMITS, self.oracles.must)
        self.links = Links(self.air, self.addresses, Wording(site), self.post, self.diary, plan.seed)
        self.watchers: list[Watcher] = [
            *(self.oracles.after, self.diary.after, self._restarts, self.links.after),
            *([watch] if watch else []),
        ]
        self.play = begin(site, cars, where, self._watch)
        self.motors = Motors(self.play, self.agenda, Random(f"{plan.seed} motors"), plan.chosen)
        self.talk = Talk(self.play, self.links, self.motors, self._may_answer, self._held, self._asked_for)
        self.vehicles = {train: self._vehicle(train, cars[train], where[train]) for train in names}
        self.line = Line(self.play, self.rails, self.vehicles, Random(f"{plan.seed} tags"), plan.chosen)
        roads = [WaysToRoad(self.rails, road) for road in plan.roads]
        self.crossings = Crossings(roads, self.links, self.vehicles, self.diary, self.oracles.must, plan.seed)
        self.links.acts = self._hears
        office = Office(
            diary=self.diary,
            foresight=foresight,
            board=self._board,
            diverts=plan.trips is None,
            deadlocked=lambda: deadlocked(self.waits, self.gone),
            orders=orders,
            lets_depart=self.crossings.lets_depart,
        )
        self.services = {
            train: Service(self.vehicles[train], trips[train], self.line, self.talk, self.ways, office)
            for train in names
        }
        self.coming = occurrences(
            plan.chosen, plan.seed, plan.hours, names, sorted(site.layout.points), list(self.crossings.states)
        )

    # ---- the beginning

    def _vehicle(self, train: Train, cars: Sequence[Car], block: Block) -> Vehicle:
        """A train in the middle of a block."""
        heading = self.rails.start_of(block)
        length_mm = self.rails.length_mm(heading)
        front_mm = (length_mm + CAR_MM * len(cars)) // 2
        on_rails = OnRails(train, list(cars), [Piece(heading, 0, length_mm)], front_mm, self.random)
        made = sensors(Random(f"{self.plan.seed} sensors of {train}"))
        return Vehicle(on_rails, on_board(CAR_MM * len(cars), front_mm, self.cycling), made)

    def _board(self) -> Board:
        return {train: service.standing for train, service in self.services.items()}

    def _watch(self, step: str, event: Mapping[str, Any], system: System) -> None:
        for watcher in self.watchers:
            watcher(step, event, system)

    def _restarts(self, step: str, event: Mapping[str, Any], system: System) -> None:
        """What is to be judged by must know of every restart, and not from the links."""
        party = self.addresses.restarted(step, event)
        if party is not None:
            self.post.restarted(party)

    def _hears(self, me: Party, peer: Party, kind: str, fields: Fields) -> None:
        """A machine acts on what its link has delivered."""
        if kind == RANGING:
            self.crossings.hears(me, peer, fields)
        else:
            self.talk.hears(me, peer, kind, fields)

    def _may_answer(self, train: Train) -> bool:
        return self.services[train].may_answer()

    def _held(self, train: Train) -> tuple[Standstill, ThroughLine]:
        """The driver puts the brake on, so that no end taken before releases it, and the sensors say how it stands."""
        vehicle = self.services[train].vehicle
        vehicle.board.hold()
        vehicle.look_again()
        return vehicle.board.standstill, vehicle.board.line(vehicle.line_answers(self.line.now_ms))

    def _asked_for(self, run: Run) -> tuple[Standstill, int, int] | None:
        return self.vehicles[run.train].asked_for(run, self.play.site.layout.start[run.route])

    # ---- a second

    def run(self, each_second: Callable[[Simulation], object] = lambda now: None) -> None:
        """Let all the time pass, or until every trip is at its end, or something is broken."""
        try:
            while self.now_s < self.plan.hours * 3_600 and not self.oracles.found and not self.ended:
                self.second()
                each_second(self)
        except NatureRefusedError as refused:
            self.oracles.violated("the_world_allows_what_happens", str(refused))

    def second(self) -> None:
        """A second passes."""
        begins_ms, self.now_s = self.now_s * SECOND_MS, self.now_s + 1
        self._set_clock(begins_ms)
        self.agenda.go_to(begins_ms)
        self._goes_wrong(begins_ms)
        tell_centre(self.play, Tick())
        for place, (train, service) in enumerate(self.services.items()):
            service.second(self.now_s)
            if (self.now_s + place) % TALKS_S == 0:
                self.talk.with_train(train)
            if (self.now_s + place) % LIFE_SIGN_S == 0:
                self.links.look(train)
        self.crossings.decide(self.now_s - 1)
        for vehicle in self.vehicles.values():
            self._second_of(vehicle)
        self.crossings.end_second(self.now_s - 1)

    def _set_clock(self, now_ms: int) -> None:
        self.diary.now_ms = self.oracles.now_ms = self.line.now_ms = now_ms

    def _second_of(self, vehicle: Vehicle) -> None:
        left = CYCLES
        while left and not vehicle.is_idle:
            ran = vehicle.cycles(self.line, left)
            self.oracles.judged_on_board(ran.cycles - 1, ran.located)
            self.oracles.on_board(vehicle.on_rails.name, vehicle)
            left -= ran.cycles

    # ---- what goes wrong

    def _goes_wrong(self, now_ms: int) -> None:
        while self.coming and self.coming[0].at_ms <= now_ms:
            each = self.coming.pop(0)
            says = BY_NAME[each.fault].says
            lasts = f", for {each.lasts_ms // 1_000} s" if each.lasts_ms else ""
            if getattr(self, f"_{each.fault}")(each):
                self.diary.fault(each.fault, each.who or "centre", f"{says}{lasts}")

    def _radio_outage(self, each: Occurrence) -> bool:
        self.air.silence(self.addresses.unit[Train(each.who)], each.lasts_ms)
        return True

    def _start_point_silent(self, each: Occurrence) -> bool:
        self.crossings.silence_terminal(each.who, each.lasts_ms)
        return True

    def _crossing_radio_silent(self, each: Occurrence) -> bool:
        self.air.silence(self.addresses.road[each.who], each.lasts_ms)
        return True

    def _wheel_slip(self, each: Occurrence) -> bool:
        vehicle = self.vehicles[Train(each.who)]
        return vehicle.sensors.slip(each.lasts_ms, vehicle.speed_mm_s, vehicle.moving.gained_mm_s2 < 0)

    def _tachometer_silent(self, each: Occurrence) -> bool:
        vehicle = self.vehicles[Train(each.who)]
        vehicle.sensors.silence_tachometer(0 if vehicle.stands else each.lasts_ms)
        return not vehicle.stands

    def _inertial_silent(self, each: Occurrence) -> bool:
        vehicle = self.vehicles[Train(each.who)]
        vehicle.sensors.silence_inertial(0 if vehicle.stands else each.lasts_ms)
        return not vehicle.stands

    def _line_broken(self, each: Occurrence) -> bool:
        vehicle = self.vehicles[Train(each.who)]
        vehicle.line_broken_until_ms = self.line.now_ms + each.lasts_ms
        return True

    def _unit_restart(self, each: Occurrence) -> bool:
        train = Train(each.who)
        service = self.services[train]
        if service.phase in HAS_PARTED:
            return False
        restart_unit(self.play, train)
        self.vehicles[train].restarted = True
        service.lose_way("has lost its authority and brakes")
        return True

    def _centre_restart(self, each: Occurrence) -> bool:
        return restart_centre(self.play)

    def _terminal_restart(self, each: Occurrence) -> bool:
        return restart_terminal(self.play, Point(each.who))

    def _point_stuck(self, each: Occurrence) -> bool:
        self.motors.stick(Point(each.who), each.lasts_ms)
        return True

    def _train_parts(self, each: Occurrence) -> bool:
        """Only a train that moves parts; where it stands, its couplings bear nothing."""
        vehicle, train = self.vehicles[Train(each.who)], Train(each.who)
        if vehicle.stands or vehicle.on_rails.standing:
            return False
        vehicle.advance(self.line)
        self.play.take("part", train=train)
        vehicle.on_rails.part(self.rails, self.random.randint(1, self.plan.cars - 1))
        vehicle.advance(self.line)
        return True

    def _stop_on_line(self, each: Occurrence) -> bool:
        service = self.services[Train(each.who)]
        service.stopped_until_s = self.now_s + each.lasts_ms // SECOND_MS
        return service.phase is Phase.RUNS

    def _route_cancelled(self, each: Occurrence) -> bool:
        service = self.services[Train(each.who)]
        run = service.onward or service.run
        grant = None if run is None else self.play.system.centre.runs.get(run)
        if run is None or grant is None or grant.stage not in (Stage.OFFERED, Stage.SET):
            return False
        return tell_centre(self.play, Cancellation(run))

    # ---- what it has come to

    @property
    def ended(self) -> bool:
        """Whether a timetable of so many trips is at its end."""
        return self.plan.trips is not None and all(
            each.finished or each.phase in (Phase.STATED, Phase.OFF) for each in self.services.values()
        )

    @property
    def waits(self) -> Waits:
        """The ways on of each train that waits for one."""
        return {train: each.waits for train, each in self.services.items() if each.waits}

    @property
    def gone(self) -> frozenset[Train]:
        """Trains that will not move for long: parted, at the end of their trips, or without any way on."""
        return frozenset(
            train
            for train, each in self.services.items()
            if each.phase in HAS_PARTED or (each.phase is Phase.STANDS and each.finished) or each.no_way
        )
