"""The train of the witnesses: its limits, at rest, and how it is run (P7, T5, T12)."""

from __future__ import annotations

from dataclasses import replace

from kernel.onboard import computer, odometry, tag_reader
from kernel.onboard.antenna_spacing import SpacingLimits
from kernel.onboard.brake_demand import TrainLimits
from kernel.onboard.braking import BrakeBounds
from kernel.onboard.ceiling import NONE as NO_CEILING
from kernel.onboard.computer import Computer
from kernel.onboard.limits import Limits
from kernel.onboard.odometry import Readings
from kernel.onboard.reverse_movement import ReverseLimits
from kernel.onboard.speed_limit import UNKNOWN as NO_TRACK_KNOWN
from kernel.onboard.speed_limit import SpeedTable
from kernel.onboard.split import Acceleration, SplitLimits
from kernel.onboard.split import Readings as TailReadings
from kernel.onboard.tag_fix import TagLimits
from kernel.onboard.tag_kind import PLAIN
from kernel.onboard.tag_reader import NO_FRAME, Frame
from kernel.onboard.tag_window import WindowLimits
from kernel.onboard.train_length import UNMEASURED, LengthBounds
from kernel.standstill import is_held
from models.onboard.antenna_above import Above
from models.onboard.brake_watch import Watched
from models.onboard.braking import Approach
from models.onboard.ceiling import AT_REST as KEEPING_AT_REST
from models.onboard.slowing import at_rest as slowing_at_rest
from models.onboard.speed_limit import Passage
from models.onboard.train_nature import (
    Train,
    Whole,
)
from models.onboard.units import NM_A_MM
from proofs.onboard.train import THEORY
from proofs.onboard.witnesses.antenna_spacing import JUST_STARTED
from proofs.onboard.witnesses.play import Play
from proofs.onboard.witnesses.rolling_stock import AT_POWER_ON, BOUNDS, START_MM
from proofs.onboard.witnesses.tag_reader import JUST_STARTED as NOTHING_HEARD
from proofs.onboard.witnesses.tag_reader import SITE as READER
from proofs.onboard.witnesses.tag_reader import SOUND
from proofs.onboard.witnesses.tag_window import AT_REST as NOTHING_AWAITED
from proofs.onboard.witnesses.train_length import JUST_STARTED as NOTHING_MEASURED

BRAKE = BrakeBounds(
    gains_mm_s2=1_300, slows_mm_s2=700, response_cycles=3, standstill_mm_s=50, cut_cycles=1, falls_mm_s2=300
)
LIMITS = Limits(
    sensors=BOUNDS,
    train=TrainLimits(BRAKE, SpeedTable(40_000, 20_000, 15_000), 133_000),
    reverse=ReverseLimits(2_000),
    split=SplitLimits(500, 3_000, 500, 600, 1_000, 10_000),
    window=WindowLimits(2_000, 30_000, 30_000),
    tags=TagLimits(4_000, 700),
    spacing=SpacingLimits(2_000, 20_000),
    antennas_mm=112_000,
    length=LengthBounds(
        line_maximum_mm=133_000,
        last_vehicle_mm=20_000,
        front_overhang_mm=4_000,
        rear_overhang_mm=4_000,
        window_mm=1_000,
        width_mm=20_000,
    ),
    reader=READER.limits,
)
SITE = Train(
    LIMITS,
    jolt_mm_s2=1_181,
    pace_cycles=8,
    length_mm=120_000,
    laid_within_mm=200,
    read_within_mm=500,
    tag=START_MM + 100_000,
    preset_within_mm=500,
)
END_MM = START_MM + 400_000
LEVEL = Acceleration(0, True)
TAIL = TailReadings(LEVEL, True, LEVEL, LEVEL, 200)
SHOWN_MM = AT_POWER_ON.motion.way_mm
ABOVE_NOTHING = Above(NOTHING_HEARD, 0, 0, 0, 0, NO_FRAME, 0, False)
AT_THE_HEAD, AT_THE_TAIL = "pass_a_frame_time_at_the_head", "pass_a_frame_time_at_the_tail"


def at_rest() -> Whole:
    """A train that stands where it was located, its brake holding it."""
    begun = computer.put_into_service(LIMITS, NO_CEILING, START_MM - 1_000, START_MM + 1_000)
    motion = odometry.located(START_MM - 1_000, START_MM + 1_000, SHOWN_MM)
    watch = replace(begun.known.watch, cycles=BRAKE.response_cycles)
    known = replace(begun.known, motion=motion, watch=watch)
    front_nm = AT_POWER_ON.front_nm
    return Whole(
        front_nm=front_nm,
        speed_um_s=0,
        from_nm=front_nm,
        from_um_s=0,
        in_curve=False,
        at_turnout=True,
        runs=False,
        running=AT_POWER_ON,
        approach=Approach(
            front_nm,
            0,
            0,
            0,
            front_nm,
            0,
            False,
            False,
            begun.brake,
            False,
            0,
            slowing_at_rest(SITE.limits.train.brake, front_nm, begun.brake.end_mm),
            NO_CEILING,
            KEEPING_AT_REST,
        ),
        watched=Watched(0, BRAKE.response_cycles, False, True, 0, False, watch),
        expecting=NOTHING_AWAITED,
        trailing=replace(JUST_STARTED, front_nm=front_nm, apart_nm=LIMITS.antennas_mm * NM_A_MM),
        passing=Passage(
            front_nm, 0, False, True, front_nm, front_nm - 50_000 * NM_A_MM, False, False, NO_TRACK_KNOWN, True
        ),
        formation=replace(NOTHING_MEASURED, length_nm=120_000 * NM_A_MM, state=UNMEASURED),
        awaited_mm=0,
        astern=False,
        asked=begun.brake,
        held=True,
        proceeds=False,
        permitted=KEEPING_AT_REST,
        head=ABOVE_NOTHING,
        tail=ABOVE_NOTHING,
        computer=replace(begun, known=known, before=odometry.past(motion), spacing=JUST_STARTED.spacing),
    )


class Ride(Play[Train, Whole]):
    """A train whose wheel rolls and whose sensors show what is so."""

    def __init__(self) -> None:
        """Begin at rest."""
        super().__init__(THEORY, SITE, at_rest())
        self.step("inspect_the_brake")
        self.step("find_whole")
        self.step("mend_the_heads_antenna")
        self.step("mend_the_tails_antenna")
        self.wheel_nm = SHOWN_MM * NM_A_MM

    # ---- what its antennas hear

    def hears(self, tag: Frame, *, front_mm: int, times: int = 2, antenna: str = AT_THE_HEAD) -> None:
        """So many frames of the tag that is below an antenna come, the front being there."""
        for _ in range(times):
            event = {"frame": tag, "level": SOUND, "below": tag, "sick": False, "at_nm": front_mm * NM_A_MM}
            self.step(antenna, **event)

    def reads(
        self,
        tag_mm: int,
        *,
        place_mm: int | None = None,
        front_mm: int | None = None,
        kind: int = PLAIN,
        in_curve: bool = False,
        at_turnout: bool = False,
    ) -> None:
        """The head reads the tag that lies here, just over it, and listed just there, unless told otherwise."""
        self.hears(record(tag_mm, kind), front_mm=tag_mm + 4_000 if front_mm is None else front_mm)
        listed_mm = tag_mm if place_mm is None else place_mm
        self.step("read_a_tag", place_mm=listed_mm, in_curve=in_curve, at_turnout=at_turnout)

    def tail_reads(self, tag_mm: int, *, front_mm: int) -> None:
        """The antenna that speaks for the tail reads the tag that lies here."""
        self.hears(record(tag_mm), front_mm=front_mm, antenna=AT_THE_TAIL)
        self.step("read_by_the_tail")

    # ---- how it runs

    def run(self, speed_mm_s: int, *, acknowledged: bool = False, may_proceed: bool = True) -> None:
        """Begin a cycle, and run evenly to a speed in it."""
        from_um_s, speed_um_s = self.system.speed_um_s, 1_000 * speed_mm_s
        self.wheel_nm += 50 * (from_um_s + speed_um_s)
        to_nm = self.system.front_nm + 50 * (from_um_s + speed_um_s)
        event = {"may_proceed": may_proceed, "acknowledged": acknowledged, "to_nm": to_nm, "speed_um_s": speed_um_s}
        self.step("run_a_cycle", **event)
        assert self.system.runs
        assert self.system.proceeds == may_proceed
        assert (self.system.front_nm, self.system.speed_um_s) == (to_nm, speed_um_s)

    def sense(self, tail: TailReadings = TAIL) -> None:
        """End it, with what the sensors show."""
        now = self.system
        shown, felt = now.speed_um_s // 1_000, (now.speed_um_s - now.from_um_s) // 100
        readings = Readings(100, True, shown, self.wheel_nm // NM_A_MM, True, felt)
        self.step("sense_the_cycle", readings=readings, tail=tail, gradient_mm_s2=0, slips=False, sticks=False)
        assert not self.system.runs

    def cycle(self, speed_mm_s: int, *, acknowledged: bool = False, may_proceed: bool = True) -> None:
        """Begin it and end it."""
        self.run(speed_mm_s, acknowledged=acknowledged, may_proceed=may_proceed)
        self.sense()

    def start(self) -> None:
        """Stand until its wheel is trusted, take an end and release the brake."""
        for _ in range(20):
            self.cycle(0)
        self.step("take_end", end_mm=END_MM)
        self.cycle(0, acknowledged=True)
        assert not self.system.computer.brake.applied

    def gather(self, to_mm_s: int) -> None:
        """Gather speed."""
        while self.system.speed_um_s < 1_000 * to_mm_s:
            self.cycle(self.system.speed_um_s // 1_000 + 100)

    def until(self, front_mm: int) -> None:
        """Run until the front is here, or just beyond."""
        while self.system.front_nm < front_mm * NM_A_MM:
            self.cycle(5_000)

    def is_caught(self) -> bool:
        """Tell whether a false tail was found."""
        return self.system.computer.spacing.broken

    def fits(self) -> bool:
        """Tell whether the tail's reads count."""
        return computer.through_line(LIMITS, self.system.computer, True).fits

    def stand_until_held(self) -> None:
        """Stand, until the computer knows that its brake holds the train at rest."""
        while not is_held(computer.at_rest(LIMITS, self.system.computer)):
            self.cycle(0, may_proceed=False)

    def stop(self) -> None:
        """Let the brake stop it, as little as is guaranteed, once it has responded."""
        while self.system.speed_um_s:
            responded = self.system.watched.cycles >= BRAKE.response_cycles
            speed_mm_s = self.system.speed_um_s // 1_000
            self.cycle(max(0, speed_mm_s - 70) if responded else speed_mm_s)
            assert self.system.computer.brake.applied

    def draw_up(self) -> None:
        """Run a little and let the driver stop it, until its brake holds it."""
        self.gather(3_000)
        self.step("withhold_end")
        self.stop()
        for _ in range(5):
            self.cycle(0, may_proceed=False)


PLAIN_TRACK: dict[str, int] = {"kind": PLAIN, "in_curve": False, "at_turnout": False}
"""What a tag says, and what lies from it on."""


def approaching(tag_mm: int) -> Ride:
    """A train that awaits a tag, and runs until its front is where the antenna reads it."""
    ride = Ride()
    ride.start()
    ride.gather(5_000)
    ride.step("await_tag", place_mm=tag_mm, uid=tag_mm, **PLAIN_TRACK)
    ride.until(tag_mm + 4_000)
    assert not ride.system.computer.known.window.passed
    return ride


def record(tag_mm: int, kind: int = PLAIN) -> Frame:
    """Give the record of a tag that lies here."""
    return Frame(valid=True, uid=tag_mm, block=1, distance_mm=0, kind=kind)


def heard(told: Computer, tag: Frame) -> Computer:
    """Give a computer whose head's reader delivers this record."""
    sound = replace(told, head=tag_reader.mended())
    once = computer.note_head_frame(LIMITS, sound, tag, SOUND)
    return computer.note_head_frame(LIMITS, once, tag, SOUND)
