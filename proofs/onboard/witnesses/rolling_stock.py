"""The train of the odometry's witnesses: what moves it, and what its sensors show (P1, P7)."""

from __future__ import annotations

from kernel.onboard import odometry as machine
from kernel.onboard.odometry import Motion, Readings, SensorBounds
from models.onboard.odometry import Line, Running
from models.onboard.units import NM_A_MM
from proofs.onboard.odometry import THEORY
from proofs.onboard.witnesses.play import Play

BOUNDS = SensorBounds(
    scale_ppm=10_000,
    pulse_mm=30,
    tachometer_mm_s=20,
    inertial_mm_s2=50,
    gradient_mm_s2=350,
    gradient_rate_mm_s2=5,
    slip_mm_s2=400,
    accelerates_mm_s2=1_200,
    brakes_mm_s2=1_800,
    agreement_cycles=10,
    pace_mm_s=5_000,
    locked_mm_s=2_500,
)
SITE = Line(bounds=BOUNDS, jolt_mm_s2=1_181, pace_cycles=8, length_mm=120_000, length_used_mm=133_000)
START_MM = 100_000
AT_POWER_ON = Running(
    front_nm=START_MM * NM_A_MM,
    speed_um_s=0,
    slips=False,
    told=False,
    shown_mm_s=0,
    shown_way_mm=5_000,
    paced_cycles=0,
    anchor_nm=START_MM * NM_A_MM,
    anchor_way_mm=5_000,
    counted=False,
    contradicted=False,
    false_by_nm=0,
    motion=machine.located(START_MM - 1_000, START_MM + 1_000, 5_000),
)


class Train(Play[Line, Running]):
    """A train on its line, told where it is to a metre; its wheel shows what is so, if not told otherwise."""

    def __init__(self, system: Running = AT_POWER_ON) -> None:
        """Begin."""
        super().__init__(THEORY, SITE, system)
        self.wheel_nm = system.motion.way_mm * NM_A_MM

    @property
    def motion(self) -> Motion:
        """What the odometry knows."""
        return self.system.motion

    def trusted(self) -> bool:
        """Whether the wheel is."""
        return self.motion.trusted

    def cycle(
        self,
        speed_mm_s: int,
        *,
        tachometer: int | None = None,
        way_mm: int | None = None,
        inertial: int | None = None,
        gradient: int = 0,
        tachometer_valid: bool = True,
        inertial_valid: bool = True,
        elapsed_ms: int = 100,
        slips: bool = False,
        sticks: bool = False,
    ) -> None:
        """Run to a speed in one cycle, evenly; ``tachometer`` is what the wheel shows, its way goes with it."""
        before, speed_um_s = self.system, 1_000 * speed_mm_s
        shown = speed_mm_s if tachometer is None else tachometer
        rolled_nm = 50 * (before.speed_um_s + speed_um_s)
        self.wheel_nm += rolled_nm if tachometer is None else 100_000 * tachometer
        readings = Readings(
            elapsed_ms=elapsed_ms,
            tachometer_valid=tachometer_valid,
            tachometer_mm_s=shown,
            way_mm=self.wheel_nm // NM_A_MM if way_mm is None else way_mm,
            inertial_valid=inertial_valid,
            inertial_mm_s2=(speed_um_s - before.speed_um_s) // 100 + gradient if inertial is None else inertial,
        )
        self.step(
            "run_a_cycle",
            readings=readings,
            to_nm=before.front_nm + rolled_nm,
            speed_um_s=speed_um_s,
            gradient_mm_s2=gradient,
            slips=slips,
            sticks=sticks,
        )
        assert self.system.front_nm == before.front_nm + rolled_nm
        assert self.system.speed_um_s == speed_um_s

    def stand(self, cycles: int) -> None:
        """Stand still."""
        for _ in range(cycles):
            self.cycle(0)

    def run_to(self, speed_mm_s: int, by_mm_s2: int = 1_000) -> None:
        """Gain or lose speed, by so much, rolling."""
        now = self.system.speed_um_s // 1_000
        step = by_mm_s2 // 10 if speed_mm_s > now else -by_mm_s2 // 10
        for speed in range(now + step, speed_mm_s + step, step):
            self.cycle(speed)

    def run_on(self, cycles: int) -> None:
        """Keep the speed."""
        for _ in range(cycles):
            self.cycle(self.system.speed_um_s // 1_000)

    def fix(self, least_mm: int, most_mm: int) -> None:
        """A tag or a feature says where the front is."""
        before = self.motion
        self.step("take_fix", least_mm=least_mm, most_mm=most_mm)
        assert self.system.anchor_nm == self.system.front_nm
        assert self.motion.anchor_way_mm == before.way_mm

    def width_mm(self) -> int:
        """How wide the range is."""
        return self.motion.front_most_mm - self.motion.front_least_mm


def rolling(speed_mm_s: int = 0) -> Train:
    """A train whose wheel is trusted, at a speed, its place fixed to the millimetre."""
    train = Train()
    train.stand(10)
    train.run_to(speed_mm_s)
    assert train.trusted()
    exact_mm = train.system.front_nm // NM_A_MM
    train.fix(exact_mm, exact_mm)
    return train
