"""How many samples of all sensors are made a second, beside a loop over single samples (P1, P5, T16).

The loop is the models' equations once more, written for one run and one cycle at a time, from the same random
numbers.  A test holds the two to each other; the ratio is measured here.
"""

from __future__ import annotations

import math
import time
from collections.abc import Iterable
from dataclasses import dataclass, field

import numpy as np

from kernel.onboard.arithmetic import GREATEST_SPEED_MM_S
from kernel.onboard.odometry import GREATEST_WAY_MM
from kernel.onboard.split import GREATEST_ACCELERATION_MM_S2
from models.sensors import clock, dynamics, imu, tachometer, transmission
from models.sensors.adhesion import BRAKED_M_S2, FULL_M_S2, SLIDES_FROM_M_S
from models.sensors.draws import CYCLES_A_STEP, NOISES, WALKS, choose
from models.sensors.faults import CYCLE_S, GRAVITY_M_S2, NOISE_MOST, WALK_MOST_M_S2
from models.sensors.traces import GREATEST_RATE_URAD_S, RUNS_A_STEP, Setup, traces
from models.sensors.track import GRID_M, line
from tests.bench import Figure

LOOP_CYCLES = 2_000
BATCHES = 5


@dataclass
class Sample:
    """One cycle of one run: the truth, and what the unit is told; None where there is no reading."""

    head_m: float
    speed_m_s: float
    gain_m_s2: float
    wheel_mm_s: int | None
    way_mm: int | None
    force_mm_s2: int | None
    yaw_urad_s: int | None
    pitch_urad_s: int | None
    left_mm_s2: int | None
    right_mm_s2: int | None
    tail_yaw_urad_s: int | None
    source: int
    age_ms: int


def edge(value: float, per_unit: float, least: int, most: int) -> int | None:
    """A float as an integer within its range, or none."""
    scaled = value * per_unit
    return round(scaled) if least <= scaled <= most else None


@dataclass
class Hold:
    """A tachometer that falls silent, or sticks, for some cycles, and goes on counting from there."""

    first: int
    end: int
    silent: bool
    way_m: float = 0.0
    speed: float = 0.0
    lost_m: float = 0.0

    def of(self, cycle: int, way_m: float, speed: float, valid: bool) -> tuple[float, float, bool]:
        """What it says, of what it should."""
        if cycle < self.first:
            self.way_m, self.speed = way_m, speed
        elif cycle < self.end:
            self.lost_m = way_m - self.way_m
            return self.way_m, 0.0 if self.silent else self.speed, not self.silent
        return way_m - self.lost_m, speed, valid


@dataclass
class OneRun:
    """One run of one train, cycle by cycle, with every fault that it has."""

    setup: Setup
    source_of_chance: np.random.Generator
    values: dict[str, float]
    reads: list[list[float]]
    head_m: float = 0.0
    regarded_m: float = 0.0
    speed: float = 0.0
    gain: float = 0.0
    stays: int = 0
    wheel: float = 0.0
    pulses: tachometer.Pulses = field(default_factory=tachometer.Pulses)
    gains: list[float] = field(default_factory=list)
    walks: dict[str, float] = field(default_factory=dict)
    arrivals: dict[int, int] = field(default_factory=dict)
    source: int = -1
    sent_ahead_ms: list[float] = field(default_factory=list)
    speeds: list[float] = field(default_factory=list)
    tail_speed: float = 0.0
    gap_m: float = 0.0
    slips_from: int = -1
    stuck: tuple[float, float, float] | None = None
    frames: list[tuple[int, int]] = field(default_factory=list)
    back_m_s: list[float] | None = None
    back_m: float = 0.0
    held_gain: float | None = None
    slides_from: int = -1
    lost_boundary: int = -1

    def __post_init__(self) -> None:
        self.head_m = self.regarded_m = self.setup.length_m + dynamics.START_M
        self.allowed = self.setup.track.allowed_m_s.tolist()
        self.curvature = self.setup.track.curvature_per_m.tolist()
        self.vertical = self.setup.track.vertical_per_m.tolist()
        self.gradient = self.setup.track.gradient.tolist()
        self.tags = self.setup.track.tags_m.tolist()
        self._draw()
        value = self.values
        self.holds = [
            Hold(first, first + max(1, int(value[f"tachometer_{name}_s"] / CYCLE_S)), name == "silent")
            for name in ("silent", "stuck")
            for first in [max(1, int(value[f"tachometer_{name}_at_s"] / CYCLE_S))]
        ]

    def _draw(self) -> None:
        """Draw number by number what the arrays draw at once: the same stream."""
        cycles, normal = self.setup.cycles, self.source_of_chance.standard_normal
        steps = range(-(-cycles // CYCLES_A_STEP))
        self.steps = {name: [float(normal(dtype=np.float32)) for _ in steps] for name in WALKS}
        octets = self.source_of_chance.bytes(2 * cycles)
        self.sendings = [octets[2 * cycle] + 256 * octets[2 * cycle + 1] for cycle in range(cycles)]
        octets = self.source_of_chance.bytes(2 * cycles)
        self.jitter = [[(octet + 128) % 256 - 128 for octet in part] for part in (octets[:cycles], octets[cycles:])]
        self.noise = {name: [float(normal(dtype=np.float32)) for _ in range(cycles)] for name in NOISES}

    def step(self, cycle: int) -> Sample:
        """One cycle: everything moves, and everything is measured."""
        value = self.values
        self._move(cycle)
        self._read_tags(cycle)
        tail_gain = self._tail(cycle)
        wheel_mm_s, way_mm = self._tachometer(cycle)
        head_slope = self._slope(self.head_m) + self.gain
        tail_m = self.head_m - self.setup.length_m - self.gap_m
        tail_slope = self._slope(tail_m) + tail_gain
        yaw = self._turn(cycle, "yaw", self._at(self.curvature, self.head_m))
        pitch = self._turn(cycle, "pitch", self._at(self.vertical, self.head_m))
        tail_yaw = self._turn(cycle, "tail_yaw", self._at(self.curvature, tail_m))
        if cycle == max(1, int(value["split_at_s"] / CYCLE_S)):
            tail_slope -= value["split_shock_m_s2"]
        force, left, right = (
            self._force(cycle, place, slope)
            for place, slope in (("head", head_slope), ("left", tail_slope), ("right", tail_slope))
        )
        force, yaw, pitch = self._failed(cycle, force, yaw, pitch)
        here_ms, there_ms = self._clock(cycle, 0, 1), self._clock(cycle, 1, -1)
        age_ms = self._receive(cycle, here_ms, there_ms)
        most = GREATEST_ACCELERATION_MM_S2
        forces = [edge(each, 1000, -most, most) for each in (force, left, right)]
        rates = [edge(each, 1e6, -GREATEST_RATE_URAD_S, GREATEST_RATE_URAD_S) for each in (yaw, pitch, tail_yaw)]
        return Sample(
            self.head_m, self.speed, self.gain, wheel_mm_s, way_mm, forces[0], rates[0], rates[1], forces[1],
            forces[2], rates[2], self.source, age_ms,
        )  # fmt: skip

    def _move(self, cycle: int) -> None:
        value, speed = self.values, self.speed
        if self.back_m_s:
            self._roll(self.back_m_s)
            return
        if self.held_gain is not None:
            self.gain, self.held_gain = self.held_gain, None
        before = self.stays, self.regarded_m
        ahead = max(self.head_m + self.back_m + dynamics.LOOK_S * speed, self.regarded_m)
        allowed = value["driver_share"] * self.allowed[int(min(ahead * (1 / GRID_M), len(self.allowed) - 1))]
        if self.stays > 0 or (speed < dynamics.STANDS_M_S and allowed < dynamics.STANDS_M_S):
            self.stays += 1
        over = speed - allowed
        if over > 0 or self.stays > 0:
            wanted = -min(value["braking_m_s2"], FULL_M_S2)
        else:
            wanted = 0.0 if over > -dynamics.COAST_M_S else min(value["traction_m_s2"], FULL_M_S2)
        jerk = dynamics.JERK_M_S3 * CYCLE_S
        after = max(speed + (self.gain + min(max(wanted - self.gain, -jerk), jerk)) * CYCLE_S, 0.0)
        if after > speed == 0 and self.back_m_s is None and cycle > int(value["rolls_back_at_s"] / CYCLE_S):
            self.stays, self.regarded_m = before
            self.held_gain, self.back_m_s = self.gain, dynamics.back_m_s(value["rolls_back_m"]).tolist()
            self._roll(self.back_m_s)
            return
        self._run(after)
        if self.stays > value["dwell_s"] / CYCLE_S:
            self.stays = 0
            self.regarded_m = self.head_m + self.back_m + dynamics.AWAY_M

    def _run(self, after: float) -> None:
        self.gain = (after - self.speed) / CYCLE_S
        self.head_m += 0.5 * CYCLE_S * (self.speed + after)
        self.speed = after

    def _roll(self, back_m_s: list[float]) -> None:
        """Roll back for a cycle; the driver goes on afterwards as if he had not."""
        before_m = self.head_m
        self._run(back_m_s.pop(0))
        self.back_m += before_m - self.head_m

    def _tail(self, cycle: int) -> float:
        """The tail's acceleration: the head's a lag ago, or its own once it has come off."""
        value, before = self.values, self.tail_speed
        lag, first = round(value["lag_s"] / CYCLE_S), max(1, int(value["split_at_s"] / CYCLE_S))
        self.gains.append(self.gain)
        self.speeds.append(self.speed)
        if cycle < first:
            self.tail_speed = self.speed
            return self.gains[cycle - lag] if cycle >= lag else 0.0
        slowed = value["split_slows_m_s2"] * (cycle - first + 1) * CYCLE_S
        self.tail_speed = max(self.speeds[first - 1] - slowed, 0.0)
        self.gap_m += (self.speed - self.tail_speed + self.speeds[cycle - 1] - before) / 2 * CYCLE_S
        return (self.tail_speed - before) / CYCLE_S

    def _read_tags(self, cycle: int) -> None:
        """Read the tags that the head passes."""
        value, reader = self.values, self.setup.reader
        while len(self.frames) < len(self.tags) and self.head_m >= self.tags[len(self.frames)]:
            phase, chance = self.reads[len(self.frames)]
            there_ms = reader.window_mm * value["window_share"] / max(self.speed, 1e-3)
            count = min(max(math.floor((there_ms - phase * reader.asks_ms) / reader.frame_ms + 1e-9), 0), 1_000)
            drawn, bad, errors = min(count, 30), 0, value["frame_errors"]
            term = reached = (1 - errors) ** drawn
            while bad < drawn and chance >= reached:
                bad += 1
                term *= (drawn - bad + 1) / bad * errors / (1 - errors)
                reached += term
            boundary = int(self.setup.track.boundary_of[len(self.frames)])
            first = len(self.frames) % 2 == 0 and cycle * CYCLE_S > value["pair_lost_at_s"]
            self.lost_boundary = boundary if first and self.lost_boundary < 0 else self.lost_boundary
            self.frames.append((cycle, 0 if boundary == self.lost_boundary else count - bad))

    def _failed(self, cycle: int, force: float, yaw: float, pitch: float) -> tuple[float, float, float]:
        """The head's inertial unit with its spike, stuck, or without a number."""
        value = self.values
        if cycle == int(value["spike_at_s"] / CYCLE_S):
            force += value["spike_m_s2"]
        if cycle >= int(value["inertial_stuck_at_s"] / CYCLE_S):
            self.stuck = self.stuck or (force, yaw, pitch)
            force, yaw, pitch = self.stuck
        first = int(value["inertial_nan_at_s"] / CYCLE_S)
        if first <= cycle < first + max(1, int(value["inertial_nan_s"] / CYCLE_S)):
            return math.nan, math.nan, math.nan
        return force, yaw, pitch

    def _clock(self, cycle: int, place: int, sign: int) -> float:
        """How far a clock is ahead, in ms."""
        value, first = self.values, int(self.values["clock_out_at_s"] / CYCLE_S)
        ahead_ms = self.jitter[place][cycle] * value["clock_jitter_ms"] / clock.JITTER_STEPS
        ahead_ms += sign * value["clock_offset_ms"]
        if first <= cycle < first + int(value["clock_out_s"] / CYCLE_S):
            ahead_ms += sign * value["clock_drift_ppm"] * 1e-3 * (cycle - first + 1) * CYCLE_S
        return ahead_ms

    def _slip(self, cycle: int) -> float:
        """How much faster the wheel is by a slip; a slide waits until the train is fast enough."""
        value, jolt = self.values, self.values["slip_jolt_m_s2"] * CYCLE_S
        most, waits = value["slip_speed_m_s"], self.speed <= SLIDES_FROM_M_S
        if self.slips_from < 0 and cycle >= int(value["slip_at_s"] / CYCLE_S) and not (most < 0 and waits):
            self.slips_from = cycle
        count, lasts = cycle - self.slips_from + 1, max(2, int(value["slip_lasts_s"] / CYCLE_S))
        if self.slips_from < 0 or count > lasts:
            return 0.0
        swing = max(2, round(abs(most) / jolt))
        return math.copysign(min(swing - abs(count % (2 * swing) - swing), lasts - count) * jolt, most)

    def _tachometer(self, cycle: int) -> tuple[int | None, int | None]:
        value, before = self.values, self.wheel
        creep = self.gain * value["creep_ppm"] * 1e-6 / FULL_M_S2
        self.wheel = self.speed * (1 + creep) + self._slip(cycle) - self._slow_slide(cycle)
        if self.speed >= 0:
            self.wheel = max(0.0, self.wheel)
        diameter = 1 + value["diameter_ppm"] * 1e-6 + value["diameter_entered_mm"] / tachometer.WHEEL_MM
        pulses = (before + self.wheel) * 0.5 / (tachometer.PULSE_M * diameter) * CYCLE_S * self._counts(cycle)
        last, self.pulses = self.pulses, tachometer.counted(self.pulses, pulses)
        speed, way_m, valid = tachometer.shown_m_s(last, self.pulses), self.pulses.came * tachometer.PULSE_M, True
        for hold in self.holds:
            way_m, speed, valid = hold.of(cycle, way_m, speed, valid)
        if not valid:
            return None, None
        most = GREATEST_SPEED_MM_S
        return edge(speed, 1000, -most, most), edge(way_m, 1000, -GREATEST_WAY_MM, GREATEST_WAY_MM)

    def _counts(self, cycle: int) -> float:
        """Which share of the pulses is counted."""
        value, share = self.values, 1.0
        for name, sign in (("lost", -1), ("extra", 1)):
            first = int(value[f"pulses_{name}_at_s"] / CYCLE_S)
            if first <= cycle < first + int(value[f"pulses_{name}_s"] / CYCLE_S):
                share *= 1 + sign * value[f"pulses_{name}_share"]
        return share

    def _slow_slide(self, cycle: int) -> float:
        """How much slower the wheel is by a slide that begins without a jolt, under the brake."""
        value, braked = self.values, self.gain < -BRAKED_M_S2 and self.speed > SLIDES_FROM_M_S
        if self.slides_from < 0 and cycle >= int(value["slow_slide_at_s"] / CYCLE_S) and braked:
            self.slides_from = cycle
        if self.slides_from < 0:
            return 0.0
        since_s = (cycle - self.slides_from + 1) * CYCLE_S
        away = value["slow_slide_m_s2"] * min(since_s, max(value["slow_slide_s"] - since_s, 0.0))
        return min(away, value["slow_slide_share"] * self.speed)

    def _at(self, values: list[float], place_m: float) -> float:
        scaled = min(max(place_m / GRID_M, 0), len(values) - 1.001)
        index = int(scaled)
        return values[index] + (scaled - index) * (values[index + 1] - values[index])

    def _slope(self, place_m: float) -> float:
        gradient = self._at(self.gradient, place_m)
        return GRAVITY_M_S2 * gradient / math.sqrt(1 + gradient * gradient)

    def _white(self, cycle: int, channel: str, deviation: float) -> float:
        return deviation * min(max(self.noise[channel][cycle], -NOISE_MOST), NOISE_MOST)

    def _drift(self, cycle: int, channel: str, step: float, most: float) -> float:
        if cycle % CYCLES_A_STEP == 0:
            self.walks[channel] = self.walks.get(channel, 0.0) + self.steps[channel][cycle // CYCLES_A_STEP]
        return min(max(self.walks[channel] * step, -most), most)

    def _force(self, cycle: int, place: str, true_m_s2: float) -> float:
        value = self.values
        shown = true_m_s2 * (1 + value[f"{place}_scale_ppm"] * 1e-6)
        shown = -shown if value[f"{place}_reversed"] else shown
        shown += value[f"{place}_bias_m_s2"] + GRAVITY_M_S2 * value[f"{place}_mounting_rad"]
        shown += self._drift(cycle, place, value[f"{place}_walk_m_s2"], WALK_MOST_M_S2)
        return shown + self._white(cycle, place, value[f"{place}_noise_m_s2"])

    def _turn(self, cycle: int, channel: str, curvature: float) -> float:
        value = self.values
        speed = self.tail_speed if channel == "tail_yaw" else self.speed
        shown = speed * curvature * (1 + value["gyro_scale_ppm"] * 1e-6)
        shown = -shown if channel == "pitch" and value["head_reversed"] else shown
        shown += -value["gyro_bias_rad_s"] if channel == "tail_yaw" else value["gyro_bias_rad_s"]
        shown += self._drift(cycle, channel, value["gyro_walk_rad_s"], imu.WALK_MOST_RAD_S)
        sway = self.noise[channel][cycle]
        if cycle >= imu.SWAY_CYCLES:
            sway = (sway - self.noise[channel][cycle - imu.SWAY_CYCLES]) * imu.HALF_POWER
        return shown + value["gyro_noise_rad_s"] * min(max(sway, -NOISE_MOST), NOISE_MOST)

    def _receive(self, cycle: int, here_ms: float, there_ms: float) -> int:
        loss, random = self.values["loss"], self.sendings[cycle]
        arrival = cycle + max(1, round(self.values["delay_s"] / CYCLE_S))
        for power in range(1, transmission.SENDINGS):
            arrival += random < int(65_536 * loss**power)
        first = int(self.values["radio_out_at_s"] / CYCLE_S)
        out = first <= arrival < first + int(self.values["radio_out_s"] / CYCLE_S)
        if not out and random >= int(65_536 * loss**transmission.SENDINGS):
            self.arrivals[arrival] = cycle
        self.sent_ahead_ms.append(there_ms)
        self.source = max(self.source, self.arrivals.pop(cycle, -1))
        if self.source < 0:
            return 0
        return round((cycle - self.source) * 100 + here_ms - self.sent_ahead_ms[self.source])


def looped(setup: Setup, seed: int, run: int) -> tuple[list[Sample], list[tuple[int, int]]]:
    """One run by the loop: its samples, and of each tag passed the cycle and the frames."""
    chosen = choose(seed, [run], len(setup.track.tags_m), setup.beyond, setup.present)
    values = {name: float(value[0]) for name, value in chosen.values.items()}
    one = OneRun(setup, chosen.sources[0], values, chosen.reads[0].tolist())
    return [one.step(cycle) for cycle in range(setup.cycles)], one.frames


def bench_sensors() -> Iterable[Figure]:
    """Samples of all sensors a second of processor time: arrays, loop, and the ratio of the medians."""
    track = line(1)
    whole = Setup(track, 4_000)
    rates = []
    for batch in range(BATCHES):
        begin = time.process_time()
        traces(whole, 1, range(batch * RUNS_A_STEP, (batch + 1) * RUNS_A_STEP))
        rates.append(RUNS_A_STEP * whole.cycles / (time.process_time() - begin))
    small, singles = Setup(track, LOOP_CYCLES), []
    for run in range(BATCHES):
        begin = time.process_time()
        looped(small, 1, run)
        singles.append(LOOP_CYCLES / (time.process_time() - begin))
    rates.sort()
    singles.sort()
    middle = BATCHES // 2
    yield Figure("samples of all sensors, arrays", rates[middle], rates[-1], "1/s", BATCHES * RUNS_A_STEP * 4_000)
    yield Figure("samples of all sensors, loop", singles[middle], singles[-1], "1/s", BATCHES * LOOP_CYCLES)
    ratio = [many / one for many, one in zip(rates, singles, strict=True)]
    yield Figure("arrays over loop", rates[middle] / singles[middle], max(ratio), "times", BATCHES)
