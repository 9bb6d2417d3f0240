"""How trains move before a crossing: stations, signals, the train ahead, and single trains that do the unexpected (X2).

The nearest that a position and a pace come to the kernel's bounds is those bounds themselves, in whole µm.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from models.compiled import compiled
from models.crossing.faults import KIND

COMES_UM = 2_600_000_000
"""Where trains come onto the line that is simulated."""
GOES_M = 400.0
"""So far beyond the second station they leave it."""
BRAKES_M_S2 = 0.8
"""A driver's braking, 2.9 km/h/s; harder by half where that is not enough (practice)."""
POWER_M_S = 11.0
"""Beyond 40 km/h traction falls with speed (practice)."""
SIGNAL_M = 10.0
"""A train stands so far before a signal."""
NEAR_M = 5.0
"""A train that has stopped stands so near to where it meant to."""
SLOW_M_S = 3.0
BACK_M_S = 5.0
STOPS_SHORT, TURNS_BACK, SPRINTS, STRONG = (KIND[name] for name in ("stops_short", "turns_back", "sprints", "strong"))
TURNS_BEYOND, UNASKED = KIND["turns_beyond"], KIND["unasked"]
BEFORE, BETWEEN, BEYOND = 0, 1, 2
"""The stage of a run: before the first station, between both, beyond the second."""


@compiled
def allowed(way_m: Any, target_m: Any) -> Any:
    """Give the greatest speed from which a train stops at a target."""
    left_m = way_m - target_m
    return 0.0 if left_m < 1.0 else np.sqrt(2 * BRAKES_M_S2 * (left_m - 0.5))


@compiled
def signal_m(block_m: Any, rear_um: Any) -> Any:
    """Give the place of the signal before the block in which the rear of the train ahead is."""
    return np.ceil(rear_um / 1e6 / block_m) * block_m + SIGNAL_M


@compiled
def aim(day: Any, run: Any, line: Any, train: int, ahead: int) -> Any:
    """Give the speed that a driver may have at most."""
    way_m, kind = run[train].way_um / 1e6, day.trains[train].local
    aim_m_s = line.limit_m_s[kind] * (1.0 if run[train].hurries == 1 else day.trains[train].share)
    if keeps(run, train):
        aim_m_s = min(aim_m_s, max(0.0, run[train].held_mm_s / 1e3 - line.ceiling_over_m_s))
    if ahead >= 0:
        signal = signal_m(line.block_m, run[ahead].way_um + line.length_um[day.trains[ahead].local])
        aim_m_s = min(aim_m_s, allowed(way_m, signal))
    if line.stops[kind] and run[train].stage == BEFORE:
        aim_m_s = min(aim_m_s, allowed(way_m, line.station_m))
    if line.stops[kind] and run[train].stage == BETWEEN:
        aim_m_s = min(aim_m_s, allowed(way_m, -line.station_m))
    trick, there_m = day.trains[train].trick, day.trains[train].trick_um / 1e6
    waits = trick in (STOPS_SHORT, TURNS_BACK) and run[train].stood_s <= day.trains[train].trick_s
    if (waits or turns_beyond(day, train)) and way_m > there_m - NEAR_M:
        aim_m_s = min(aim_m_s, allowed(way_m, there_m))
    if trick in (SPRINTS, STRONG) and way_m > there_m:
        aim_m_s = min(aim_m_s, max(SLOW_M_S, allowed(way_m, there_m)))
    return aim_m_s


@compiled
def turns_beyond(day: Any, train: int) -> Any:
    """Tell whether a train stops beyond the road and comes back."""
    return day.trains[train].trick in (TURNS_BEYOND, UNASKED)


@compiled
def keeps(run: Any, train: int) -> Any:
    """Tell whether a train keeps a promise: it has made one, and nobody has proved its rear past the road."""
    return run[train].held_number > 0 and run[train].gone == 0


@compiled
def stand(day: Any, run: Any, line: Any, train: int) -> None:
    """Count how long a train stands, and let it go on."""
    way_m, stage = run[train].way_um / 1e6, run[train].stage
    trick = day.trains[train].trick
    stands = trick in (STOPS_SHORT, TURNS_BACK) or turns_beyond(day, train)
    if stands and abs(way_m - day.trains[train].trick_um / 1e6) < NEAR_M:
        run[train].stood_s += 1
        return
    if not line.stops[day.trains[train].local] or stage == BEYOND:
        return
    station_m = line.station_m if stage == BEFORE else -line.station_m
    if abs(way_m - station_m) < NEAR_M:
        run[train].dwelt_s += 1
        if run[train].dwelt_s > day.trains[train].dwell_s[stage]:
            run[train].stage += 1
            run[train].dwelt_s = 0


@compiled
def sprints(day: Any, run: Any, train: int) -> bool:
    """Tell whether a train now gains all that it can, up to the greatest pace of its kind."""
    trick = day.trains[train].trick
    return trick in (SPRINTS, STRONG) and run[train].way_um <= day.trains[train].trick_um


@compiled
def come_back(run: Any, line: Any, train: int, kind: int) -> None:
    """Let a train that comes back gain all that it can, up to the greatest pace of its kind."""
    before_um = run[train].pace_um
    run[train].pace_um = min(before_um + line.gain_um, line.line_um[kind])
    if keeps(run, train):
        run[train].pace_um = min(run[train].pace_um, 1_000 * run[train].held_mm_s)
    run[train].way_um -= (before_um + run[train].pace_um) // 2


@compiled
def move(day: Any, run: Any, line: Any, train: int, ahead: int) -> None:
    """Move a train for a second."""
    kind, pace_um = day.trains[train].local, run[train].pace_um
    if day.trains[train].trick == TURNS_BACK and run[train].stood_s > day.trains[train].trick_s:
        run[train].pace_um = max(pace_um - 500_000, -round(1e6 * BACK_M_S))
        run[train].way_um -= run[train].pace_um
        return
    if run[train].is_back == 1:
        come_back(run, line, train, kind)
        return
    if sprints(day, run, train):
        gain_um = line.gain_um * (2 if day.trains[train].trick == STRONG else 1)
        clear_m_s: Any = 1e9
        if ahead >= 0:
            rear_um = run[ahead].way_um + line.length_um[day.trains[ahead].local]
            clear_m_s = allowed(run[train].way_um / 1e6, signal_m(line.block_m, rear_um))
        if clear_m_s * 1e6 > pace_um + gain_um:
            run[train].pace_um = min(pace_um + gain_um, line.line_um[kind])
            if keeps(run, train):
                run[train].pace_um = min(run[train].pace_um, 1_000 * run[train].held_mm_s)
            run[train].way_um -= run[train].pace_um
            return
    speed_m_s = pace_um / 1e6
    gain_m_s2 = day.trains[train].traction_m_s2 * min(1.0, POWER_M_S / max(speed_m_s, 0.1))
    aim_m_s = aim(day, run, line, train, ahead)
    new_m_s = max(min(speed_m_s + gain_m_s2, aim_m_s), speed_m_s - 1.5 * BRAKES_M_S2, 0.0)
    run[train].way_um -= round(1e6 * (speed_m_s + new_m_s) / 2)
    run[train].pace_um = round(1e6 * new_m_s)
    if new_m_s == 0.0:
        stand(day, run, line, train)


@compiled
def arrives_by_likely_reckoning(line: Any, kind: int, way_m: float, speed_m_s: float, seconds: int) -> Any:
    """Tell whether a train at full traction arrives within so many seconds: by position, speed and acceleration (2.4).

    That is how the paper's system reckons; it allows for no error, no delay, and no more than the limit.
    """
    if way_m > seconds * max(speed_m_s, line.limit_m_s[kind]):
        return False
    for _ in range(seconds):
        speed_m_s = max(0.0, speed_m_s)
        gain_m_s2 = line.likely_m_s2 * min(1.0, POWER_M_S / max(speed_m_s, 0.1))
        new_m_s = max(speed_m_s, min(speed_m_s + gain_m_s2, line.limit_m_s[kind]))
        way_m -= (speed_m_s + new_m_s) / 2
        speed_m_s = new_m_s
    return way_m <= 0.0
