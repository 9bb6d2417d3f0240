"""How trams move in a simulated day: they begin runs, follow, stop, serve, wait and leave (G2, G4).

A driver heeds a hold and uses a recovery; there is no other train control.  Compiled.
"""

from __future__ import annotations

import numpy as np

from models.compiled import compiled
from models.tram import tally
from models.tram.given import Given
from models.tram.line import (
    AT_STOP_MM,
    BOARDS_S,
    BRAKES_MM_S2,
    GAINS_MM_S2,
    GAP_MM,
    LENGTH_MM,
    MOST_MM_S,
    OPENS_S,
    PEAK_BOARDS,
    RECOVERY_MM_S,
    RED_S,
    SIGNAL_AT,
    SIGNAL_S,
    SKIPPED,
)
from models.tram.state import (
    BROKEN_S,
    COMES_AT,
    D_HOLDS,
    D_RECOVERS,
    DWELL_S,
    FREE,
    LEAVES,
    NEXT,
    OFF_S,
    ON,
    PASSES,
    PLACE,
    SPEED,
    TURN,
    WAITS,
    Traffic,
)

FAR_MM = 10**12
CLEAR_MM = 120_000
"""So far around its place there must be no tram where one comes out of the depot."""
RUN_OF_TURN = 1_000
"""Turns of runs are so far apart that a tram from the depot fits between."""


@compiled
def obstacle_mm(day: Given, traffic: Traffic, place_in_line: int, now_s: int) -> int:
    """Where the tram has to stop at the latest: its stop, a red signal, the tram ahead."""
    tram = traffic.trams[traffic.line[place_in_line]]
    following = tram[NEXT]
    nearest = FAR_MM
    if tram[PASSES] == 0 or following >= tram[LEAVES]:
        nearest = day.stops_mm[following]
    if following > 0:
        before = day.stops_mm[following - 1]
        signal = before + int(SIGNAL_AT * (day.stops_mm[following] - before))
        brakes_mm = tram[SPEED] * tram[SPEED] // (2 * BRAKES_MM_S2)
        if (now_s + day.signal_s[following]) % SIGNAL_S < RED_S and tram[PLACE] + brakes_mm <= signal:
            nearest = min(nearest, signal)
    if place_in_line > 0:
        ahead = traffic.trams[traffic.line[place_in_line - 1]]
        nearest = min(nearest, ahead[PLACE] - LENGTH_MM - GAP_MM)
    return nearest


@compiled
def run(day: Given, traffic: Traffic, place_in_line: int, now_s: int) -> None:
    """Let a tram run for a second."""
    tram = traffic.trams[traffic.line[place_in_line]]
    if tram[BROKEN_S] > 0:
        tram[SPEED] = 0
        return
    left_mm = max(0, obstacle_mm(day, traffic, place_in_line, now_s) - tram[PLACE])
    most = RECOVERY_MM_S if tram[D_RECOVERS] == 1 else MOST_MM_S
    stops = int(np.sqrt(2.0 * BRAKES_MM_S2 * min(left_mm, 10**6)))
    tram[SPEED] = min(tram[SPEED] + GAINS_MM_S2, most, stops, left_mm)
    tram[PLACE] += tram[SPEED]


@compiled
def passengers(mean: float, rng: np.random.Generator) -> int:
    """How many came, where so many come in the mean, each by himself (Poisson)."""
    came, left = 0, np.exp(-min(mean, 500.0)) / max(rng.random(), 1e-300)
    while left < 1.0:
        came += 1
        left /= max(rng.random(), 1e-300)
    return came


@compiled
def serve(day: Given, traffic: Traffic, tram: int, now_s: int, rng: np.random.Generator) -> None:
    """Begin to serve the stop: who waits since it was served last boards."""
    stop = traffic.trams[tram, NEXT]
    more = PEAK_BOARDS if day.is_peak[now_s // 3_600] == 1 else 1.0
    waited_s = min(max(0, now_s - traffic.served_s[stop]), day.patience_s)
    waiting = passengers(day.boards_a_second[stop] * more * waited_s, rng)
    traffic.served_s[stop] = now_s
    traffic.trams[tram, DWELL_S] = OPENS_S + int(BOARDS_S * waiting)


@compiled
def go_on(day: Given, traffic: Traffic, tram: int, now_s: int, rng: np.random.Generator) -> None:
    """Make for the next stop."""
    body = traffic.trams[tram]
    stop = body[NEXT]
    run_of = body[TURN] // RUN_OF_TURN - 1
    if body[TURN] % RUN_OF_TURN == 0 and run_of < len(traffic.log):
        traffic.log[run_of, stop] = now_s
    traffic.truly_left_ms[tram, stop] = 1_000 * now_s
    traffic.row[tally.DEPARTURES] += 1
    body[DWELL_S] = FREE
    body[NEXT] = stop + 1
    is_peak = day.is_peak[now_s // 3_600] == 1
    body[PASSES] = 1 if not is_peak and rng.random() < SKIPPED else 0


@compiled
def dwell(day: Given, traffic: Traffic, tram: int, now_s: int, rng: np.random.Generator) -> bool:
    """Let a tram stand for a second; whether it leaves the way then."""
    body = traffic.trams[tram]
    traffic.row[tally.STOOD_S] += 1
    if body[DWELL_S] > 0:
        body[DWELL_S] -= 1
        return False
    if body[NEXT] >= body[LEAVES]:
        return True
    heedless = day.is_heedless and tram == day.where.heedless_tram
    if body[D_HOLDS] == 1 and not heedless:
        body[WAITS] = 1
        return False
    body[WAITS] = 0
    go_on(day, traffic, tram, now_s, rng)
    return False


@compiled
def move(day: Given, traffic: Traffic, place_in_line: int, now_s: int, rng: np.random.Generator) -> bool:
    """Let a tram do what it does in a second; whether it leaves the way."""
    tram = traffic.line[place_in_line]
    body = traffic.trams[tram]
    if day.broken_s > 0 and now_s == day.where.broken_s and place_in_line == day.where.broken_tram % traffic.size[0]:
        body[BROKEN_S] = day.broken_s
    body[BROKEN_S] = max(0, body[BROKEN_S] - 1)
    if body[DWELL_S] != FREE:
        return bool(body[BROKEN_S] == 0 and dwell(day, traffic, tram, now_s, rng))
    run(day, traffic, place_in_line, now_s)
    stop_mm = day.stops_mm[body[NEXT]]
    serves = body[PASSES] == 0 or body[NEXT] >= body[LEAVES]
    if serves and body[SPEED] == 0 and body[BROKEN_S] == 0 and stop_mm - body[PLACE] <= AT_STOP_MM - 10_000:
        serve(day, traffic, tram, now_s, rng)
    elif not serves and body[PLACE] > stop_mm:
        go_on(day, traffic, tram, now_s, rng)
    return False


@compiled
def take_off(traffic: Traffic, place_in_line: int, now_s: int) -> None:
    """Take a tram off the way."""
    tram = traffic.line[place_in_line]
    traffic.trams[tram, ON] = 0
    traffic.trams[tram, OFF_S] = now_s
    for place in range(place_in_line, traffic.size[0] - 1):
        traffic.line[place] = traffic.line[place + 1]
    traffic.size[0] -= 1


@compiled
def put_on(traffic: Traffic, place_in_line: int, tram: int) -> None:
    """Put a tram onto the way, behind so many."""
    for place in range(traffic.size[0], place_in_line, -1):
        traffic.line[place] = traffic.line[place - 1]
    traffic.line[place_in_line] = tram
    traffic.size[0] += 1
    traffic.trams[tram, ON] = 1
    traffic.row[tally.RUNS] += 1


@compiled
def free_tram(traffic: Traffic, there: Traffic, now_s: int, away_s: int) -> int:
    """Give a vehicle that has been away long enough, the one that has been longest; -1 if there is none.

    ``there``: the other way, on which it is not, nor to come.
    """
    found = -1
    for tram in range(len(traffic.trams)):
        body, beyond = traffic.trams[tram], there.trams[tram]
        if body[ON] == 1 or body[OFF_S] > now_s - away_s or beyond[ON] == 1 or beyond[COMES_AT] != FREE:
            continue
        if found < 0 or body[OFF_S] < traffic.trams[found, OFF_S]:
            found = tram
    return found


@compiled
def is_free_at(traffic: Traffic, place_mm: int, clear_mm: int) -> bool:
    """Whether no tram is near a place."""
    for place in range(traffic.size[0]):
        if abs(traffic.trams[traffic.line[place], PLACE] - place_mm) < clear_mm:
            return False
    return True


@compiled
def place_beyond(day: Given, traffic: Traffic, stop: int) -> int:
    """How many trams on the way are beyond a stop."""
    beyond = 0
    while beyond < traffic.size[0] and traffic.trams[traffic.line[beyond], PLACE] > day.stops_mm[stop]:
        beyond += 1
    return beyond
