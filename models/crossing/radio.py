"""Rangings of a train as the radio brings them: noise, multipath, loss, delay and repetition (X1)."""

from __future__ import annotations

from typing import Any

import numpy as np

from models.compiled import compiled
from models.crossing.columns import NUMBER
from models.crossing.faults import KIND
from models.crossing.made import MADE, NOTHING
from models.crossing.motion import arrives_by_likely_reckoning
from models.crossing.traffic import POOL

Ranging = MADE.arrival.Ranging
RADIO_OUT, LOSSY, MULTIPATH, LATE, REPEATED = (
    KIND[name] for name in ("radio_out", "lossy", "multipath", "late", "repeated")
)
REFLECTION, STALE = KIND["reflection"], KIND["stale"]
RANGING_BROKEN, AGE_BROKEN = NUMBER["ranging_broken"], NUMBER["age_broken"]
KEPT = 16
"""So many rangings are kept, to be told late."""
NOISE_MOST = 4.0
"""Noise is cut at so many deviations: what lies beyond is given up as no ranging (ours)."""
STEADY = 0.95
"""Multipath changes with the way: from one second to the next it keeps so much (ours)."""
STRIDE = 7_919
"""Each train's noise begins so far from the one's before."""


@compiled
def is_on(day: Any, fault: int, now: int) -> Any:
    """Tell whether a fault is there now."""
    return day.faults[fault].begin_s >= 0 and day.faults[fault].begin_s <= now < day.faults[fault].end_s


@compiled
def cut(value: float) -> float:
    """Cut noise."""
    return max(-NOISE_MOST, min(NOISE_MOST, value))


@compiled
def errors(day: Any, line: Any, train: int) -> Any:
    """Give the bounds of what is told of a train: of rangings, or of its own range if it tells that."""
    if day.trains[train].promises == 1:
        return line.own_way_error_m, line.own_speed_error_m_s
    return line.way_error_m, line.speed_error_m_s


@compiled
def measure(day: Any, run: Any, line: Any, train: int, now: int, out: Any) -> None:
    """Take a ranging of a train, or its own range, with its errors, and keep it; what is told of it is its bound."""
    place = (train * STRIDE + 3 * now) % (POOL - 3)
    run[train].bias = STEADY * run[train].bias + np.sqrt(1 - STEADY**2) * 0.6 * day.normal[place]
    bias = max(-1.0, min(1.0, run[train].bias))
    if day.on[MULTIPATH]:
        bias = 1.0 if day.faults[MULTIPATH].size > 0 else -1.0
    off_m = line.multipath_m * bias + line.way_sigma_m * cut(day.normal[place + 1])
    if day.on[REFLECTION]:
        off_m += day.faults[REFLECTION].size
    way_um, before_um = run[train].way_um, run[train].before_um
    speed_m_s = (before_um - way_um) / 2e6 + line.speed_sigma_m_s * cut(day.normal[place + 2])
    if day.trains[train].promises == 1:
        off_m = line.own_way_error_m * bias
        speed_m_s = run[train].pace_um / 1e6 + line.own_speed_error_m_s * cut(day.normal[place + 2]) / NOISE_MOST
    way_error_m, speed_error_m_s = errors(day, line, train)
    way_mm = int(np.floor(way_um / 1e3 + 1e3 * (off_m - way_error_m)))
    speed_mm_s = int(np.ceil(1e3 * (speed_m_s + speed_error_m_s)))
    if way_mm * 1_000 > way_um or run[train].pace_um > 1_000 * speed_mm_s:
        out[RANGING_BROKEN] += 1
    run[train].told_way_mm[now % KEPT] = way_mm
    run[train].told_speed_mm_s[now % KEPT] = speed_mm_s
    run[train].told_s[now % KEPT] = now


@compiled
def ranging(day: Any, run: Any, line: Any, train: int, now: int, out: Any) -> Any:
    """Give what the radio brings of a train in this cycle."""
    measure(day, run, line, train, now, out)
    chance = day.uniform[(train * STRIDE + now) % POOL]
    loss = day.faults[LOSSY].size if day.on[LOSSY] else line.loss
    if day.on[RADIO_OUT] or chance < loss:
        return NOTHING
    age = 0
    if day.on[LATE] or (day.on[REPEATED] and chance > 0.5):
        age = int(np.ceil(day.faults[LATE if day.on[LATE] else REPEATED].size))
    if day.on[STALE]:
        age = int(day.faults[STALE].size)
    place = (now - age) % KEPT
    if now - age < 0 or run[train].told_s[place] != now - age:
        return NOTHING
    run[train].brought_place = place
    told_age = 0 if day.on[STALE] else age
    if told_age < age:
        out[AGE_BROKEN] += 1
    return Ranging(True, run[train].told_way_mm[place], run[train].told_speed_mm_s[place], told_age)


@compiled
def likely(day: Any, run: Any, line: Any, train: int, told: Any) -> Any:
    """Tell whether the paper's reckoning warns now: its ranging has no bounds taken off; or it is lost (003, 2.3)."""
    if not told.valid:
        return run[train].lost == 1
    way_error_m, speed_error_m_s = errors(day, line, train)
    way_m = told.way_mm / 1e3 + way_error_m
    speed_m_s = told.speed_mm_s / 1e3 - speed_error_m_s
    return arrives_by_likely_reckoning(line, day.trains[train].local, way_m, speed_m_s, line.warning_cycles)
