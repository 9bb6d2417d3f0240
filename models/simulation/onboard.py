"""The machines on board of one train, a cycle at a time: where it is, the next tag, wholeness, the brake.

Each decision is a function of ``kernel.onboard``; here they are only fed, and their answers passed on.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field, replace
from functools import lru_cache

from kernel.maps import Map
from kernel.names import Block, Run, Tag, TagList
from kernel.onboard import (
    antenna_spacing,
    authority_end,
    brake_demand,
    brake_watch,
    braking,
    odometry,
    reverse_movement,
    speed_limit,
    split,
    tag_fix,
    tag_window,
)
from kernel.onboard.brake_demand import Known, TrainLimits
from kernel.onboard.odometry import Readings
from kernel.onboard.split import Readings as TailReadings
from kernel.onboard.tag_fix import TagLimits
from kernel.onboard.way import UNKNOWN, Way, between
from kernel.standstill import Standstill, ThroughLine, is_braked
from kernel.tag_list import TagLists
from kernel.tag_list_text import what_they_say
from kernel.unit import Unit
from models.concrete.rails import ANTENNA_MM
from models.rides.plan import PLAN, TAG_ERROR_MM
from models.simulation.ahead import Ahead

TAG_LIMITS = TagLimits(ANTENNA_MM, TAG_ERROR_MM)
LOCATED_WITHIN_MM = 2_000
"""To so much either way a train at rest is located anew, by the tag or the post beside it (ours)."""


@lru_cache(maxsize=4096)
def _said(tag_lists: frozenset[TagList]) -> TagLists:
    """What lists say, read once and not in each cycle."""
    return what_they_say(tag_lists)


@dataclass
class OnBoard:
    """What the machines on board remember.

    ``before``: what the odometry knew a cycle ago.
    ``from_mm``: between these places, by the plan, the head antenna was when the way to the next tag began.
    ``lists``: the lists of the runs that the unit was permitted.
    ``limit``: layouts do not say where curves are, so the track stays unknown, with the line's speed everywhere.
    """

    length_mm: int
    motion: odometry.Motion
    brake: braking.Brake
    watch: brake_watch.BrakeWatch
    spacing: antenna_spacing.Spacing
    split: split.Split
    before: odometry.Motion
    movement: reverse_movement.Movement = reverse_movement.LOCATED
    limit: speed_limit.SpeedLimit = speed_limit.UNKNOWN
    from_mm: tuple[int, int] = (0, 0)
    from_at: Way = UNKNOWN
    awaited: Tag | None = None
    window: tag_window.Window = tag_window.NONE_AWAITED
    lists: dict[Run, Ahead] = field(default_factory=dict)

    @property
    def place(self) -> Way:
        """Where the front is, as the machines tell one another."""
        return Way(odometry.is_located(self.motion), self.motion.front_least_mm, self.motion.front_most_mm)

    @property
    def place_of_read(self) -> Way:
        """Where the front was when an antenna read something within the cycle."""
        return tag_fix.place_of_read(self.before, self.motion)

    @property
    def intact(self) -> bool:
        """Whether the train is known to be whole."""
        return split.is_intact(PLAN.split, self.split)

    @property
    def known(self) -> Known:
        """What the machines on board know, by which the brake is demanded."""
        return Known(self.motion, self.watch, self.movement, self.limit, self.split, self.window)

    # ---- a cycle

    def cycle(self, readings: Readings, tail: TailReadings, demanded: bool) -> None:
        """Take what the sensors say at the end of a cycle; decide whether to brake in the next."""
        applied = self.brake.applied
        self.before = self.motion
        self.motion = odometry.note_cycle(PLAN.sensors, self.motion, readings)
        self.split = split.note_cycle(PLAN.split, self.split, tail)
        self.window = tag_window.note_cycle(PLAN.window, self.window, between(self.from_at, self.place))
        self.movement = reverse_movement.note_cycle(PLAN.reverse, self.movement, readings)
        slowest, fastest = self.motion.speed_least_mm_s, self.motion.speed_most_mm_s
        self.watch = brake_watch.note_cycle(PLAN.brake, self.watch, applied, self.place.known, slowest, fastest)
        self.supervise(demanded, False)

    def supervise(self, demanded: bool, acknowledged: bool) -> None:
        """Decide on the brake by all that is known on board; ``demanded``: no order lets the train proceed (T12)."""
        limits = TrainLimits(PLAN.brake, PLAN.speeds, self.length_mm)
        self.brake = brake_demand.decide(limits, self.brake, self.known, not demanded, acknowledged)

    # ---- tags

    def head_reads(self, number: int, tag: Tag, place_mm: int | None) -> bool:
        """The head reads a tag: is it in its window; a fix where the list has it (T5, P7, T13).

        One that lies beside the awaited one, which was missed, leaves that one's window as it is.
        """
        fits = tag_window.in_window(PLAN.window, self.window, between(self.from_at, self.place_of_read))
        if place_mm is None or not fits:
            return False
        fix = tag_fix.fix_of(TAG_LIMITS, self.before, self.motion, place_mm)
        self.motion = odometry.note_fix(self.motion, fix.least_mm, fix.most_mm)
        self.spacing = antenna_spacing.note_head_read(self.spacing, number, self.place_of_read)
        if self.awaited is None or self.awaited == tag:
            self.from_mm, self.from_at = (place_mm, place_mm), self.place_of_read
        return odometry.is_located(self.motion)

    def tail_reads(self, number: int, answers: bool) -> ThroughLine:
        """The tail reads a tag: what says whether it is the train's last antenna (T13, P5)."""
        self.spacing = antenna_spacing.note_tail_read(PLAN.spacing, self.spacing, number, self.place_of_read)
        return self.line(answers)

    def line(self, answers: bool) -> ThroughLine:
        """What is known of the way to the tail; ``answers``: its signal comes over the line (T3).

        The tail of a train that has rolled back too far may read a pair of tags in reverse: it counts no more (T2).
        """
        fits = antenna_spacing.is_healthy(self.spacing) and not self.movement.reversed
        return ThroughLine(answers, self.intact, fits)

    @property
    def standstill(self) -> Standstill:
        """What the odometry says of front and speed (P7)."""
        motion, place = self.motion, self.place
        return Standstill(
            known=place.known,
            front_least_mm=place.least_mm,
            front_most_mm=place.most_mm,
            speed_least_mm_s=motion.speed_least_mm_s,
            speed_most_mm_s=motion.speed_most_mm_s,
            standstill_mm_s=PLAN.brake.standstill_mm_s,
            braked_cycles=self.watch.cycles if self.brake.applied else 0,
            response_cycles=PLAN.brake.response_cycles,
        )

    # ---- what the unit was told

    def follow(self, unit: Unit) -> None:
        """Let the brake do what the orders of the unit ask, and await the next tag by them (T4, T5)."""
        runs = [run for run in self.lists if run in unit.orders]
        self.brake = self._asked(unit, runs)
        tags_mm: dict[Tag, int] = {}
        for run in runs:
            order = unit.orders[run]
            if order.permitted and not order.given_back and order.expected in self.lists[run].tags_mm:
                assert order.expected is not None
                tags_mm[order.expected] = self.lists[run].tags_mm[order.expected]
        self._await(tags_mm)

    def _asked(self, unit: Unit, runs: Iterable[Run]) -> braking.Brake:
        """What becomes of the brake by these runs' lists, and by where the front is (T12)."""
        begins_mm = {run: self.lists[run].begins_mm for run in runs}
        ends_mm: dict[Run, Map[Block, int]] = {run: self.lists[run].ends_mm for run in runs}
        (brake,) = authority_end.obey(
            _said(frozenset(kept for run in runs if (kept := unit.orders[run].tag_list) is not None)),
            unit,
            begins_mm,
            ends_mm,
            PLAN.brake,
            self.brake,
            self.motion,
        )
        return brake

    def _await(self, tags_mm: Mapping[Tag, int]) -> None:
        """Await the nearest of these tags; the way to it is from the last one, or from where the train stood."""
        awaited = min(tags_mm, key=lambda tag: tags_mm[tag], default=None)
        if awaited is None:
            self.awaited, self.window = None, tag_window.NONE_AWAITED
            return
        if awaited == self.awaited and self.window.expected:
            return
        least_mm, most_mm = tags_mm[awaited] - self.from_mm[1], tags_mm[awaited] - self.from_mm[0]
        self.awaited, self.window = awaited, tag_window.await_tag(max(0, least_mm), max(0, most_mm))

    # ---- at rest

    def locate(self, least_mm: int, most_mm: int) -> None:
        """Begin anew at a standstill, with the front in a range (P7, T8)."""
        self.motion = self.before = odometry.located(least_mm, most_mm, self.motion.way_mm)
        self.watch = replace(brake_watch.watching(0), cycles=self.watch.cycles)
        self.movement = reverse_movement.LOCATED
        self.brake = braking.stand_still(most_mm)
        self.spacing = antenna_spacing.preset(self.length_mm - 2 * ANTENNA_MM)
        self.awaited, self.window, self.lists = None, tag_window.NONE_AWAITED, {}
        self.begin_way()

    def begin_way(self) -> None:
        """The way to the next tag begins here, wherever the train stands within its range."""
        self.from_mm = (self.motion.front_least_mm - ANTENNA_MM, self.motion.front_most_mm - ANTENNA_MM)
        here = (self.motion.front_least_mm + self.motion.front_most_mm) // 2
        self.from_at = Way(odometry.is_located(self.motion), here, here)

    @property
    def takes_hold(self) -> bool:
        """Whether the brake is on, and has yet to respond."""
        return self.brake.applied and not is_braked(self.standstill)

    def hold(self) -> bool:
        """The driver puts the brake on, until an end of authority is taken; whether it holds the train yet (T8)."""
        self.brake = braking.withhold_end(self.brake)
        return is_braked(self.standstill)

    def made_up(self) -> None:
        """Staff has found the train whole (P5)."""
        self.split = split.made_up(PLAN.split)


def on_board(length_mm: int, front_mm: int) -> OnBoard:
    """The machines of a train that stands, located and found whole."""
    motion = odometry.located(front_mm - LOCATED_WITHIN_MM, front_mm + LOCATED_WITHIN_MM, 0)
    made = OnBoard(
        length_mm=length_mm,
        motion=motion,
        before=motion,
        brake=braking.stand_still(front_mm + LOCATED_WITHIN_MM),
        watch=brake_watch.watching(0),
        spacing=antenna_spacing.preset(length_mm - 2 * ANTENNA_MM),
        split=split.made_up(PLAN.split),
    )
    made.begin_way()
    return made
