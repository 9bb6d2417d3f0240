"""A train as it is, and the machines on board beside it: sample by sample over rails, tags and boundaries.

A train that stands, and whose odometry is sure of it, is left alone until it goes on: nothing changes.
"""

from __future__ import annotations

from collections.abc import Mapping
from random import Random

from kernel.names import Block, Run, Tag, Train
from kernel.standstill import Standstill, ThroughLine
from kernel.unit import Unit
from models.concrete.drive import Drive
from models.concrete.rails import Rails
from models.concrete.train import Happening, OnRails
from models.layouts.measures import TAG_MM, WINDOW_MM
from models.layouts.numbers import fields_of
from models.rides.plan import PLAN
from models.simulation.cycles import Given, Moving, Ran
from models.simulation.driver import is_barred, shown_mm_s
from models.simulation.faults import Chosen, happens
from models.simulation.onboard import OnBoard
from models.simulation.sensors import Sensors
from models.simulator.play import Play

NEAR_END_MM = 12_000
SETTLES_CYCLES = 100
"""If the odometry is not sure by then that the train stands, it is located anew."""


class Vehicle:
    """One train.

    ``run``: the newest one it may run under.  ``target_mm``: where the driver wants to stop, on the train's path.
    ``holds``: the driver keeps it where it is, or stops it.  ``restarted``: the unit has just begun a new life.
    """

    def __init__(self, on_rails: OnRails, board: OnBoard, sensors: Sensors) -> None:
        self.on_rails = on_rails
        self.board = board
        self.sensors = sensors
        self.run: Run | None = None
        self.target_mm = 0.0
        self.holds = True
        self.restarted = False
        self.line_broken_until_ms = 0
        self.moving = Moving()
        self.next_mm = 0.0
        self.at_rest_cycles = 0
        self._unit: Unit | None = None
        self._asked_at = (0, 0, 0)

    @property
    def speed_mm_s(self) -> float:
        """How fast it is."""
        return self.moving.speed_mm_s

    @property
    def pending_mm(self) -> float:
        """How far it has run since what lies on its way was looked at last."""
        return self.moving.pending_mm

    @property
    def way_mm(self) -> float:
        """How far it has run in all."""
        return self.moving.way_mm

    @property
    def front_mm(self) -> float:
        """Where its front is, on its path."""
        return self.on_rails.front_mm + self.pending_mm

    @property
    def stands(self) -> bool:
        """Whether it is at rest."""
        return self.speed_mm_s == 0.0

    def line_answers(self, now_ms: int) -> bool:
        """Whether the through line brings the tail's signal: not of a train that has lost cars."""
        return not self.on_rails.standing and now_ms >= self.line_broken_until_ms

    @property
    def settled(self) -> bool:
        """Whether it is at rest and its odometry sure of that."""
        motion = self.board.motion
        return self.stands and motion.trusted and motion.speed_most_mm_s <= PLAN.brake.standstill_mm_s

    @property
    def is_idle(self) -> bool:
        """Whether nothing on board changes any more: it rests, its brake has responded, and its tail was heard."""
        rests = self.settled and (self.holds or self.is_there)
        return rests and not self.board.takes_hold and (self.board.intact or bool(self.on_rails.standing))

    @property
    def is_there(self) -> bool:
        """Whether it is so near to where its driver wants to stop that it goes no nearer."""
        return self.target_mm - self.front_mm < NEAR_END_MM

    @property
    def is_barred(self) -> bool:
        """Whether the cab shows it that it may not go on."""
        return is_barred(shown_mm_s(PLAN.brake, self.board.motion, self.board.brake.end_mm, 0))

    # ---- cycles of 100 ms

    def cycles(self, line: Line, most: int) -> Ran:
        """Let its computer decide on the brake, the train move, and its sensors read: so often at most.

        Whatever else is to happen does, after the last of these cycles.
        """
        self.demanded(line.play)
        held, sensors = self.board.held, self.sensors
        ran = held.run(self.moving, sensors.kept, sensors.errors, self._given(), sensors.noise(most), most)
        self.moving = ran.moving
        sensors.ran(ran.cycles, ran.kept)
        if held.passed and not self.restarted:
            line.play.take("window_passes", train=self.on_rails.name)
        if self.pending_mm >= self.next_mm or (self.stands and self.pending_mm >= 1):
            self.advance(line)
        self.at_rest_cycles = self.at_rest_cycles + 1 if self.stands else 0
        return ran

    def _given(self) -> Given:
        """What stays as it is while cycles are run."""
        return Given(
            front_mm=self.on_rails.front_mm,
            next_mm=self.next_mm,
            target_mm=self.target_mm,
            holds=self.holds,
            runs=self.run is not None,
            listed=bool(self.board.lists),
            parted=bool(self.on_rails.standing),
            restarted=self.restarted,
        )

    def demanded(self, play: Play) -> bool:
        """Whether the unit wants the emergency brake: no run, or no end of authority that can be held (T5, T9)."""
        unit, board = play.system.units[self.on_rails.name], self.board
        place = (board.motion.front_least_mm, board.motion.front_most_mm, board.motion.speed_most_mm_s)
        if unit is not self._unit or (board.brake.withheld and board.lists and place != self._asked_at):
            self._unit, self._asked_at = unit, place
            board.follow(unit)
        return self.run is None or board.brake.withheld

    def look_again(self) -> None:
        """The orders are to be read anew in the next cycle."""
        self._unit = None

    def asked_for(self, run: Run, start: Block) -> tuple[Standstill, int, int] | None:
        """Wanted back, of a run that is listed: how the train stands, which end it holds, where the start block ends.

        Its driver puts the brake on at rest.
        """
        board = self.board
        if run not in board.lists:
            return None
        if self.stands:
            board.hold()
        return board.standstill, board.brake.end_mm, board.lists[run].ends_mm[start]

    def advance(self, line: Line) -> None:
        """Let happen what lies on the way that was run."""
        train, whole_mm = self.on_rails, int(self.pending_mm)
        if whole_mm > 0 and self.run is not None:
            before_mm = train.front_mm
            line.move(train, self.run, whole_mm)
            run_mm = train.front_mm - before_mm
            self.rolled(self.pending_mm - run_mm if run_mm == whole_mm else 0.0)
        train.look()
        self._forget()
        here = train.happenings(line.rails, train.path[-1].to_mm - train.front_mm)
        ends_mm = train.path[-1].to_mm - train.front_mm
        self.next_mm = float(min([ends_mm, *(each.after_mm for each in here[:1])]))

    def rolled(self, pending_mm: float) -> None:
        """What lies on its way has been looked at, but for so much."""
        self.moving = self.moving._replace(pending_mm=pending_mm)

    def _forget(self) -> None:
        """What lies far behind the train is of no use any more."""
        train = self.on_rails
        behind = sum(piece.to_mm < train.rear_mm - TAG_MM - WINDOW_MM for piece in train.path)
        if behind:
            del train.path[:behind]
            train.offsets = {
                (tag, at - behind, head): mm for (tag, at, head), mm in train.offsets.items() if at >= behind
            }


class Line(Drive):
    """Trains on the rails whose antennas feed machines on board; what happens must be a step of the world."""

    def __init__(
        self, play: Play, rails: Rails, vehicles: Mapping[Train, Vehicle], random: Random, chosen: Chosen
    ) -> None:
        self.only: OnRails | None = None
        self.vehicles = vehicles
        self.chosen = chosen
        self.now_ms = 0
        self.numbers = {tag: number for number, tag in enumerate(sorted(play.site.layout.tag_in), start=1)}
        self.kinds = {tag: fields_of(record)[0] for tag, record in play.site.records.record.items()}
        super().__init__(play, rails, [each.on_rails for each in vehicles.values()], random)

    def compare(self) -> None:
        """Every car of the train that moves is in just the blocks that the abstract track says."""
        everybody = self.trains
        self.trains = everybody if self.only is None else [self.only]
        try:
            super().compare()
        finally:
            self.trains = everybody
        self.seen["compared"] += 1

    def move(self, train: OnRails, run: Run, mm: int) -> None:
        """A train moves so far between two samples; only it can have changed its blocks."""
        self.only = train
        super().move(train, run, mm)

    def happens(self, train: OnRails, run: Run, what: Happening) -> None:
        """One thing happens; what an antenna passes goes through the machines on board first."""
        if what.kind in ("enters", "leaves"):
            super().happens(train, run, what)
        elif what.kind == "head reads":
            self._head_passes(self.vehicles[train.name], what)
        elif not self._happens("tag_missed_tail"):
            self.tail_reads(train, run, what)

    def _head_passes(self, vehicle: Vehicle, what: Happening) -> None:
        """The head's antenna passes a tag; now and then another lies there, or it reads nothing."""
        assert what.tag is not None
        if self._happens("tag_foreign"):
            self._head_reads(vehicle, what, Tag("foreign"), None)
        if self._happens("tag_missed_head"):
            self.play.take("head_misses", train=vehicle.on_rails.name, tag=what.tag)
            return
        places = (ahead.tags_mm[what.tag] for ahead in vehicle.board.lists.values() if what.tag in ahead.tags_mm)
        self._head_reads(vehicle, what, what.tag, next(places, None))

    def _head_reads(self, vehicle: Vehicle, what: Happening, tag: Tag, place_mm: int | None) -> None:
        in_window = vehicle.board.head_reads(self.numbers.get(tag, 0), place_mm, self.kinds.get(tag, 0))
        self.head_reads(vehicle.on_rails, what, tag, in_window)
        vehicle.demanded(self.play)

    def reads_as_tail(self, train: OnRails, tag: Tag) -> ThroughLine:
        """Take a read by the last car's antenna; what line and machines say of the way to the train's tail."""
        vehicle = self.vehicles[train.name]
        return vehicle.board.tail_reads(self.numbers[tag], self.kinds.get(tag, 0), vehicle.line_answers(self.now_ms))

    def _happens(self, fault: str) -> bool:
        return happens(fault, self.chosen, self.random, self.seen)
