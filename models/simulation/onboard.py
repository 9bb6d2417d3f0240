"""The computer on board of one train, fed: readings, tags, the ends of its orders, and what staff tells it.

Each decision is a function of ``kernel.onboard``; here they are only fed, and their answers passed on.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass, field, replace
from functools import lru_cache

from kernel.maps import Map
from kernel.names import Block, Run, TagList
from kernel.onboard import authority_end, braking, odometry, split
from kernel.onboard import computer as computing
from kernel.onboard.brake_demand import TrainLimits
from kernel.onboard.ceiling import NONE as NO_CEILING
from kernel.onboard.computer import Computer
from kernel.onboard.limits import Limits, are_lawful
from kernel.onboard.tag_fix import TagLimits
from kernel.onboard.tag_reader import NO_FRAME, Frame, Level
from kernel.onboard.way import Way
from kernel.standstill import Standstill, ThroughLine
from kernel.tag_list import TagLists
from kernel.tag_list_text import what_they_say
from kernel.unit import Unit
from models.layouts.measures import ANTENNA_MM
from models.rides.plan import PLAN, SURVEYED, TAG_ERROR_MM
from models.simulation.ahead import Ahead
from models.simulation.cycles import Cycling, Held, Interpreted

Listed = tuple[int, int]
"""Where a list has a tag, and its kind."""
GOOD_LEVEL = Level(mv=1_000, valid=True)
"""What the detection loop of an antenna shows here: none of them fails."""
LOCATED_WITHIN_MM = 2_000
"""To so much either way a train at rest is located anew, by the tag or the post beside it (ours)."""


@lru_cache(maxsize=4096)
def _said(tag_lists: frozenset[TagList]) -> TagLists:
    """What lists say, read once and not in each cycle."""
    return what_they_say(tag_lists)


@dataclass
class OnBoard:
    """What the machines on board remember.

    ``held``: the computer, where its cycles run: where the train is, the awaited tag, wholeness and brake, by
    ``limits``.
    ``lists``: the lists of the runs that the unit was permitted.
    """

    length_mm: int
    limits: Limits
    held: Held
    lists: dict[Run, Ahead] = field(default_factory=dict)

    @property
    def computer(self) -> Computer:
        """All that the computer remembers."""
        return self.held.computer

    @computer.setter
    def computer(self, computer: Computer) -> None:
        self.held.computer = computer

    @property
    def motion(self) -> odometry.Motion:
        """What the odometry knows."""
        return self.held.motion

    @property
    def is_located(self) -> bool:
        """Whether the odometry claims where the front is."""
        return odometry.is_located(self.motion)

    @property
    def brake(self) -> braking.Brake:
        """What the brake control knows."""
        return self.held.brake

    @property
    def place(self) -> Way:
        """Where the front is, as the machines tell one another."""
        return computing.place(self.computer)

    @property
    def intact(self) -> bool:
        """Whether the train is known to be whole."""
        return split.is_intact(self.limits.split, self.computer.known.wholeness)

    # ---- the brake

    def decide(self, demanded: bool, acknowledged: bool) -> None:
        """Decide on the brake by all that is known on board; ``demanded``: no order lets the train proceed (T12)."""
        self.computer = computing.decide(self.limits, self.computer, not demanded, acknowledged)

    # ---- tags

    def head_reads(self, number: int, place_mm: int | None, kind: int) -> bool:
        """The head reads a tag: is it where the list has it, if it is listed at all (T5, P7, T12, T13)."""
        computer = _passes(computing.note_head_frame, self.limits, self.computer, number, kind)
        if place_mm is None:
            self.computer = computing.read_unlisted(computer)
            return False
        in_window = computing.reads_in_window(self.limits, computer, place_mm)
        self.computer = computing.read_by_head(self.limits, computer, place_mm)
        return in_window and self.place.known

    def tail_reads(self, number: int, kind: int, answers: bool) -> ThroughLine:
        """The tail reads a tag: what says whether it is the train's last antenna (T13, P5)."""
        computer = _passes(computing.note_tail_frame, self.limits, self.computer, number, kind)
        self.computer = computing.read_by_tail(self.limits, computer)
        return self.line(answers)

    def line(self, answers: bool) -> ThroughLine:
        """What is known of the way to the tail; ``answers``: its signal comes over the line (T3)."""
        return computing.through_line(self.limits, self.computer, answers)

    @property
    def standstill(self) -> Standstill:
        """What is told of front, speed and brake (P7)."""
        return computing.standstill(self.limits, self.computer)

    @property
    def at_rest(self) -> Standstill:
        """What is known of them to its staff (P7)."""
        return computing.at_rest(self.limits, self.computer)

    # ---- what the unit was told

    def follow(self, unit: Unit) -> None:
        """Let the brake do what the orders of the unit ask, await the next tag by them, and list others (T4, T5).

        The list of a run that was given back is dropped: its points may lie for another run from then on (T9).
        """
        self.lists = {
            run: listed
            for run, listed in self.lists.items()
            if run not in unit.orders or not unit.orders[run].given_back
        }
        runs = [run for run in self.lists if run in unit.orders]
        computer = replace(self.computer, brake=self._asked(unit, runs))
        awaited, listed = list[Listed](), list[Listed]()
        for run in runs:
            order, tags = unit.orders[run], self.lists[run].tags_mm
            if order.permitted:
                places = {tag: (place_mm, self.lists[run].kinds[tag]) for tag, place_mm in tags.items()}
                listed += places.values()
                awaited += [place for tag, place in places.items() if tag == order.expected]
        self.computer = self._awaiting(computer, min(awaited, default=None), listed)

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

    def _awaiting(self, computer: Computer, awaited: Listed | None, listed: Iterable[Listed]) -> Computer:
        """What becomes of the computer as it awaits the nearest of the tags that come next; others are listed too."""
        if awaited is None:
            computer, from_mm = computing.await_none(computer), self.motion.front_least_mm
        else:
            from_mm, kind = awaited
            if not computing.awaits(self.limits, computer, from_mm):
                computer = computing.await_tag(self.limits, computer, from_mm, kind)
        for place_mm, kind in listed:
            if place_mm > from_mm:
                computer = computing.note_listed(self.limits, computer, place_mm, kind)
        return computer

    # ---- at rest

    def locate(self, least_mm: int, most_mm: int) -> None:
        """Begin anew at a standstill, with the front in a range (P7, T8)."""
        self.computer = computing.locate(self.limits, self.computer, least_mm, most_mm)
        self.lists = {}

    def note_place(self, least_mm: int, most_mm: int) -> None:
        """Somebody says of the train at rest between which places its front is (P7, T8)."""
        self.computer = computing.note_place(self.limits, self.computer, least_mm, most_mm)

    @property
    def takes_hold(self) -> bool:
        """Whether the brake is on, and has yet to bring the train to rest."""
        return self.brake.applied and not computing.is_braked_to_rest(self.limits, self.computer)

    def hold(self) -> bool:
        """The driver puts the brake on, until an end of authority is taken; whether that has stopped it (T8)."""
        self.computer = computing.withhold_end(self.computer)
        return computing.is_braked_to_rest(self.limits, self.computer)

    def made_up(self) -> None:
        """Staff has found the train whole; of one that is not held at rest nobody's word is taken (P5)."""
        self.computer = computing.made_up(self.limits, self.computer)


def _passes(
    note_frame: Callable[[Limits, Computer, Frame, Level], Computer],
    limits: Limits,
    computer: Computer,
    number: int,
    kind: int,
) -> Computer:
    """An antenna passes a tag, after a gap: two frames that say the same, with which its record is delivered (T16)."""
    frame = Frame(valid=True, uid=number, block=0, distance_mm=0, kind=kind)
    for heard in (*[NO_FRAME] * limits.reader.gap_frames, frame, frame):
        computer = note_frame(limits, computer, heard, GOOD_LEVEL)
    return computer


def on_board(length_mm: int, front_mm: int, cycling: Cycling = Interpreted) -> OnBoard:
    """The machines of a train that stands, located and found whole with sound antennas, and what runs their cycles."""
    written_mm = length_mm + SURVEYED.preset_within_mm
    limits = Limits(
        sensors=PLAN.sensors,
        train=TrainLimits(PLAN.brake, PLAN.speeds, written_mm),
        reverse=PLAN.reverse,
        split=PLAN.split,
        window=PLAN.window,
        tags=TagLimits(ANTENNA_MM, TAG_ERROR_MM),
        spacing=PLAN.spacing,
        antennas_mm=length_mm - 2 * ANTENNA_MM,
        length=replace(
            PLAN.length, line_maximum_mm=written_mm, front_overhang_mm=ANTENNA_MM, rear_overhang_mm=ANTENNA_MM
        ),
        reader=PLAN.reader,
    )
    least_mm, most_mm = front_mm - LOCATED_WITHIN_MM, front_mm + LOCATED_WITHIN_MM
    assert are_lawful(limits, SURVEYED), "the plan's limits fit what it says was surveyed"
    begun = computing.put_into_service(limits, NO_CEILING, least_mm, most_mm)
    return OnBoard(length_mm, limits, cycling(limits, _inspected(limits, begun)))


def _inspected(limits: Limits, begun: Computer) -> Computer:
    """Staff has found train, brake and antennas sound; it was held for longer than is counted yet (P5, T12, T13)."""
    watch = begun.known.watch
    held = replace(begun, known=replace(begun.known, watch=replace(watch, cycles=limits.train.brake.response_cycles)))
    told = computing.made_up(limits, computing.mend_tail(limits, computing.mend_head(limits, held)))
    sound = computing.inspect_brake(limits, told).known
    return replace(told, known=replace(sound, watch=replace(sound.watch, cycles=watch.cycles)))
