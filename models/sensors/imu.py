"""Inertial sensors: specific force along the track, yaw rate and pitch rate (P1, P2, P5).

A sensor at rest on a gradient shows g sin θ; mounted askew it shows a share of g for ever.  Bias, a drift
that walks within bounds, white noise that is cut, a scale error; one spike; a stuck value; no number.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from models.sensors.draws import CYCLES_A_STEP, NOISES, WALKS, Draws, Singles
from models.sensors.faults import CYCLE_S, GRAVITY_M_S2, NOISE_MOST, WALK_MOST_M_S2, Floats

WALK_MOST_RAD_S = 0.0003
"""A gyro's drift goes no farther (ours, typical bias stability over ten minutes: 60 degrees/h)."""
SWAY_CYCLES = 5
"""Half a period of a body's sway: bodies sway at about 1 Hz on their suspension."""
HALF_POWER = 0.5**0.5
TOP = np.float32(NOISE_MOST)


@dataclass(frozen=True)
class Inertial:
    """What one vehicle's sensor says, shape (runs, cycles); not a number where it gives none."""

    force_m_s2: Singles
    yaw_rad_s: Singles
    pitch_rad_s: Singles


def drift(draws: Draws, channel: str, step: Floats, most: float, cycles: int) -> Singles:
    """A random walk with a step each second, cut at ``most``; every cycle of a second alike."""
    walked = np.cumsum(draws.walk[:, WALKS.index(channel)], axis=1)
    walked *= step.astype(np.float32)[:, None]
    np.clip(walked, -np.float32(most), np.float32(most), out=walked)
    return np.repeat(walked, CYCLES_A_STEP, axis=1)[:, :cycles]


def white(draws: Draws, channel: str, deviation: Floats) -> Singles:
    """White noise of a standard deviation, cut at four of them."""
    noise = np.clip(draws.noise[:, NOISES.index(channel)], -TOP, TOP)
    noise *= deviation.astype(np.float32)[:, None]
    return noise


def sway(draws: Draws, channel: str, deviation: Floats) -> Singles:
    """A body's sway as an angular rate: noise less itself half a period ago, cut at four deviations.

    Not white: a body turns only so far against the track, so its rate must average out.
    """
    noise = draws.noise[:, NOISES.index(channel)].copy()
    noise[:, SWAY_CYCLES:] -= draws.noise[:, NOISES.index(channel), :-SWAY_CYCLES]
    noise[:, SWAY_CYCLES:] *= np.float32(HALF_POWER)
    np.clip(noise, -TOP, TOP, out=noise)
    noise *= deviation.astype(np.float32)[:, None]
    return noise


def force(true_m_s2: Singles, draws: Draws, place: str) -> Singles:
    """Specific force along the track by the accelerometer at a place: ``head``, ``left`` or ``right`` (P1, P5).

    ``true_m_s2``: acceleration and gravity along the track together.  Mounted in reverse it shows both the other way.
    """
    values = draws.values
    scale = (1 + values[f"{place}_scale_ppm"] * 1e-6).astype(np.float32)
    constant = values[f"{place}_bias_m_s2"] + GRAVITY_M_S2 * values[f"{place}_mounting_rad"]
    shown = true_m_s2 * np.where(values[f"{place}_reversed"] != 0, -scale, scale)[:, None]
    shown += constant.astype(np.float32)[:, None]
    shown += drift(draws, place, values[f"{place}_walk_m_s2"], WALK_MOST_M_S2, shown.shape[1])
    shown += white(draws, place, values[f"{place}_noise_m_s2"])
    return shown


def turn(speed: Singles, curvature: Singles, draws: Draws, channel: str) -> Singles:
    """Angular rate by the gyro: speed times curvature, with its errors (P2); pitch is the other way in reverse.

    The tail's gyro has the drawn bias in the opposite direction: together the worst.
    """
    values = draws.values
    scale = (1 + values["gyro_scale_ppm"] * 1e-6).astype(np.float32)
    if channel == "pitch":
        np.negative(scale, out=scale, where=values["head_reversed"] != 0)
    shown = speed * curvature
    shown *= scale[:, None]
    bias = -values["gyro_bias_rad_s"] if channel == "tail_yaw" else values["gyro_bias_rad_s"]
    shown += bias.astype(np.float32)[:, None]
    shown += drift(draws, channel, values["gyro_walk_rad_s"], WALK_MOST_RAD_S, shown.shape[1])
    shown += sway(draws, channel, values["gyro_noise_rad_s"])
    return shown


def fail(sensor: Inertial, values: Mapping[str, Floats]) -> None:
    """Put the faults of one unit into its three channels, in place: spike, stuck, no number (P1)."""
    cycles = sensor.force_m_s2.shape[1]
    channels = (sensor.force_m_s2, sensor.yaw_rad_s, sensor.pitch_rad_s)
    for row in np.flatnonzero(values["spike_at_s"] < cycles * CYCLE_S):
        sensor.force_m_s2[row, int(values["spike_at_s"][row] / CYCLE_S)] += np.float32(values["spike_m_s2"][row])
    for row in np.flatnonzero(values["inertial_stuck_at_s"] < cycles * CYCLE_S):
        first = int(values["inertial_stuck_at_s"][row] / CYCLE_S)
        for channel in channels:
            channel[row, first:] = channel[row, first]
    for row in np.flatnonzero(values["inertial_nan_at_s"] < cycles * CYCLE_S):
        first = int(values["inertial_nan_at_s"][row] / CYCLE_S)
        end = first + max(1, int(values["inertial_nan_s"][row] / CYCLE_S))
        for channel in channels:
            channel[row, first:end] = np.nan
