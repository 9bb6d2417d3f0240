"""The one file of this world that calls the kernel: a host of the computer on board, and no more."""

from __future__ import annotations

from dataclasses import replace

from kernel.onboard import antenna_spacing, braking, computer, limits, train_length
from kernel.onboard.ceiling import NONE as NO_CEILING
from kernel.onboard.ceiling import Ceiling
from kernel.onboard.odometry import Readings, is_located
from kernel.onboard.split import Acceleration
from kernel.onboard.split import Readings as TailReadings
from kernel.onboard.tag_reader import NO_FRAME, Frame, Level
from tests.independent.physics.declared import ANTENNA_MM, Type

PLAIN_TRACK = 1
"""The kind that is written in every tag of this world."""
SOUND = Level(mv=1_000, valid=True)
"""The level in the loop of every antenna of this world."""


def frames_of(number: int, silent: int) -> list[Frame]:
    """What an antenna hears as it passes a tag: silence for a gap, and two frames."""
    heard = Frame(valid=True, uid=number, block=0, distance_mm=0, kind=PLAIN_TRACK)
    return [*[NO_FRAME] * silent, heard, heard]


class Host:
    """A unit with its computer, as a train of a type has it; places are on the kilometrage of its front."""

    def __init__(self, kind: Type, least_mm: int, most_mm: int) -> None:
        """Put it into service at rest."""
        assert limits.are_lawful(kind.limits, kind.surveyed)
        self.limits = kind.limits
        self.ceiling = NO_CEILING
        self.computer = computer.put_into_service(self.limits, self.ceiling, least_mm, most_mm)
        self._inspect()
        self.awaited: int | None = None

    def keep_to(self, ceiling_mm_s: int) -> None:
        """Promise a ceiling of speed, if the computer says that it keeps to it."""
        self.computer = computer.keep_to(self.limits, self.computer, Ceiling(ceiling_mm_s))
        if self.computer.known.ceiling.most_mm_s <= ceiling_mm_s:
            self.ceiling = Ceiling(ceiling_mm_s)

    # ---- what it claims

    @property
    def located(self) -> bool:
        """Whether it claims its ranges."""
        return is_located(self.computer.known.motion)

    @property
    def front_mm(self) -> tuple[int, int]:
        """Where the front is."""
        motion = self.computer.known.motion
        return motion.front_least_mm, motion.front_most_mm

    @property
    def speed_mm_s(self) -> tuple[int, int]:
        """How fast it is."""
        motion = self.computer.known.motion
        return motion.speed_least_mm_s, motion.speed_most_mm_s

    @property
    def trusts_wheel(self) -> bool:
        """Whether the wheel is trusted."""
        return self.computer.known.motion.trusted

    @property
    def length_mm(self) -> int:
        """How long the train is at the most."""
        return train_length.length_mm(self.limits.length, self.computer.length)

    @property
    def braked(self) -> bool:
        """Whether the emergency brake is commanded."""
        return self.computer.brake.applied

    @property
    def end_mm(self) -> int:
        """The end of authority that it keeps."""
        return self.computer.brake.end_mm

    @property
    def overdue(self) -> bool:
        """Whether the awaited tag is."""
        return self.computer.known.window.passed

    @property
    def has_split(self) -> bool:
        """Whether it takes the train for split, by accelerations."""
        return self.computer.known.wholeness.split

    @property
    def false_tail(self) -> bool:
        """Whether it has found its tail to be another's."""
        return self.computer.spacing.broken

    @property
    def counts_tail(self) -> bool:
        """Whether a read of the tail's antenna counts, as far as the antennas say."""
        return antenna_spacing.is_healthy(self.computer.spacing)

    @property
    def why(self) -> str:
        """Why the train goes no farther until somebody has done something, so far as the unit says."""
        known = self.computer.known
        reasons = {
            "not located": not self.located,
            "a tag is overdue": self.overdue,
            "split": self.has_split,
            "a false tail": self.false_tail,
            "the tail is not heard": known.wholeness.lost,
            "motors or brake": known.watch.broken,
            "rolled back": known.movement.reversed,
        }
        return next((reason for reason, so in reasons.items() if so), "the brake is not released")

    @property
    def wants_staff(self) -> bool:
        """Whether it goes no farther."""
        known = self.computer.known
        return (
            not self.located
            or self.overdue
            or self.has_split
            or self.false_tail
            or known.wholeness.lost
            or known.watch.broken
            or known.movement.reversed
        )

    # ---- a cycle

    def decide(self, acknowledged: bool) -> None:
        """Begin a cycle."""
        self.computer = computer.decide(self.limits, self.computer, True, acknowledged)

    def sense(
        self,
        elapsed_ms: int,
        tachometer: tuple[bool, int, int],
        inertial: tuple[bool, int],
        tail: tuple[bool, int, int, int, int],
    ) -> None:
        """End it: speed and way by the tachometer, acceleration, and the tail's, if it has arrived, with its age."""
        arrived, head, left, right, age_ms = tail
        self.computer = computer.sense(
            self.limits,
            self.computer,
            Readings(elapsed_ms, *tachometer, *inertial),
            TailReadings(
                Acceleration(head, True), arrived, Acceleration(left, True), Acceleration(right, True), age_ms
            ),
        )

    # ---- tags

    def await_next(self, places_mm: list[int]) -> None:
        """Await the first tag, of a list in order, that the head certainly has not passed yet."""
        most_mm = self.front_mm[1] + self.limits.window.tolerance_mm
        ahead = [place for place in places_mm if place + ANTENNA_MM > most_mm]
        self.awaited = ahead[0] if ahead else None
        if not ahead:
            self.computer = computer.await_none(self.computer)
            return
        self.computer = computer.await_tag(self.limits, self.computer, ahead[0], PLAIN_TRACK)

    def head_reads(self, number: int, place_mm: int) -> bool:
        """The head reads a tag that the list has; whether it is where it should be."""
        in_window = computer.reads_in_window(self.limits, self.computer, place_mm)
        for frame in frames_of(number, self.limits.reader.gap_frames):
            self.computer = computer.note_head_frame(self.limits, self.computer, frame, SOUND)
        self.computer = computer.read_by_head(self.limits, self.computer, place_mm)
        return in_window

    def tail_reads(self, number: int) -> None:
        """The tail does."""
        for frame in frames_of(number, self.limits.reader.gap_frames):
            self.computer = computer.note_tail_frame(self.limits, self.computer, frame, SOUND)
        self.computer = computer.read_by_tail(self.limits, self.computer)

    def _inspect(self) -> None:
        """Staff finds train and antennas sound; the brake has held it for longer than the computer has counted yet."""
        counted_cycles = self.computer.known.watch.cycles
        self._count_brake(self.limits.train.brake.response_cycles)
        mended = computer.mend_tail(self.limits, computer.mend_head(self.limits, self.computer))
        self.computer = computer.inspect_brake(self.limits, computer.made_up(self.limits, mended))
        self._count_brake(counted_cycles)

    def _count_brake(self, cycles: int) -> None:
        """Let the brake have been on for so many cycles."""
        known = self.computer.known
        self.computer = replace(self.computer, known=replace(known, watch=replace(known.watch, cycles=cycles)))

    # ---- what is told

    def take_end(self, end_mm: int) -> None:
        """An end of authority."""
        brake, motion = self.computer.brake, self.computer.known.motion
        taken = braking.take_end(self.limits.train.brake, brake, motion.front_most_mm, motion.speed_most_mm_s, end_mm)
        self.computer = replace(self.computer, brake=taken)

    def may_be_located(self) -> bool:
        """Whether the brake has brought the train to rest."""
        return computer.is_braked_to_rest(self.limits, self.computer)

    def withhold(self) -> None:
        """The driver gives his authority back."""
        self.computer = computer.withhold_end(self.computer)

    def locate(self, least_mm: int, most_mm: int, whole: bool, inspected: bool) -> None:
        """Staff says where the train is, and, having walked along it, that it is whole, and mended."""
        self.computer = computer.locate(self.limits, self.computer, least_mm, most_mm)
        if whole:
            self.computer = computer.made_up(self.limits, self.computer)
        if inspected:
            way_mm = self.computer.known.motion.way_mm
            self.computer = computer.put_into_service(self.limits, self.ceiling, least_mm, most_mm)
            motion = replace(self.computer.known.motion, way_mm=way_mm, anchor_way_mm=way_mm)
            self.computer = replace(self.computer, known=replace(self.computer.known, motion=motion))
            self._inspect()
