"""Days of a tram line, 16.5 hours each, with the truth beside the machines (G2 to G6)."""

from __future__ import annotations

import numpy as np

from kernel.tram.dispatching import DispatchLimits
from models.days.system import Numbers, System
from models.tram import tally
from models.tram.deciding import deliver_orders, deliver_reports, may_take_up
from models.tram.faults import FAULTS
from models.tram.given import LIMITS, NO_PLANT, Given, given
from models.tram.line import AT_STOP_MM, CLOSE_S, DEPOT, HOURS, OPEN_S, STOPS, TAKEN_UP_S, TRAMS, Whole
from models.tram.machines import MADE, compiled
from models.tram.moving import (
    CLEAR_MM,
    RUN_OF_TURN,
    depot_place,
    free_tram,
    is_free_at,
    move,
    put_on,
    serve,
    take_off,
)
from models.tram.radio import CYCLE_S
from models.tram.state import (
    K_TURN,
    LEAVES,
    NEXT,
    OFF_S,
    PLACE,
    SPEED,
    TURN,
    WAITS,
    Traffic,
    begun,
)
from models.tram.telling import ask, begin_unit, keep_known, see
from models.tram.watching import watch

END_S = CLOSE_S + 2 * 3_600
"""By then the last tram has long left the way; the simulation ends with it."""
DEPOT_EACH_S = 1_800
AWAITED_S = 10**9
"""`OFF_S` of a vehicle that was taken up for a run, and has not come yet."""
coming = MADE.dispatching.coming


@compiled
def take_up(day: Given, traffic: Traffic, now_s: int) -> None:
    """Tell the centre of the next run of the timetable; ``size[2]``: so many were."""
    run = traffic.size[2]
    if run >= len(day.begins_s) or now_s < day.begins_s[run] - TAKEN_UP_S:
        return
    tram = free_tram(traffic, now_s)
    turn = RUN_OF_TURN * (run + 1)
    if tram < 0 or not may_take_up(traffic, tram, turn, 0, day.leaves_at[run]):
        return
    body = traffic.trams[tram]
    body[TURN], body[LEAVES], body[OFF_S] = turn, day.leaves_at[run], AWAITED_S
    keep_known(body, coming(1_000 * now_s, turn, 0, body[LEAVES]))
    traffic.size[2] += 1


@compiled
def begin_runs(day: Given, traffic: Traffic, now_s: int, rng: np.random.Generator) -> None:
    """Let the next run begin that was taken up, in time, if the first stop is free; ``size[1]``: so many have."""
    run = traffic.size[1]
    if run >= traffic.size[2] or now_s < day.begins_s[run] or not is_free_at(traffic, 0, 2 * AT_STOP_MM):
        return
    for tram in range(len(traffic.trams)):
        body = traffic.trams[tram]
        if body[TURN] == RUN_OF_TURN * (run + 1) and body[OFF_S] == AWAITED_S:
            come(day, traffic, tram, traffic.size[0], 0, now_s, rng)
    traffic.size[1] += 1


@compiled
def come(
    day: Given, traffic: Traffic, tram: int, place_in_line: int, stop: int, now_s: int, rng: np.random.Generator
) -> None:
    """Let a tram come onto the way at a stop, and serve it."""
    body = traffic.trams[tram]
    body[PLACE], body[SPEED], body[NEXT], body[WAITS] = day.stops_mm[stop], 0, stop, 0
    put_on(traffic, place_in_line, tram)
    begin_unit(day, body, stop, 1_000 * now_s)
    serve(day, traffic, tram, now_s, rng)


@compiled
def come_from_the_depot(day: Given, traffic: Traffic, now_s: int, rng: np.random.Generator) -> bool:
    """Take up a tram at the depot's stop and let it come, if it may; whether it did (G5)."""
    tram = free_tram(traffic, now_s)
    place = depot_place(day, traffic)
    if tram < 0 or place == 0 or place == traffic.size[0]:
        return False
    if not is_free_at(traffic, day.stops_mm[DEPOT], CLEAR_MM):
        return False
    ahead = traffic.trams[traffic.line[place - 1], K_TURN]
    behind = traffic.trams[traffic.line[place], K_TURN]
    turn, leaves_at = (ahead + behind) // 2, STOPS - 1
    if not ahead < turn < behind:
        return False
    if not may_take_up(traffic, tram, turn, DEPOT, leaves_at):
        traffic.row[tally.NOT_TAKEN_UP] += 1
        return False
    body = traffic.trams[tram]
    body[TURN], body[LEAVES] = turn, leaves_at
    keep_known(body, coming(1_000 * now_s, turn, DEPOT, leaves_at))
    come(day, traffic, tram, place, DEPOT, now_s, rng)
    return True


@compiled
def second(day: Given, traffic: Traffic, now_s: int, rng: np.random.Generator) -> None:
    """Let a second pass: trams move, units see, stations ask, the centre decides, orders arrive."""
    place = 0
    while place < traffic.size[0]:
        if move(day, traffic, place, now_s, rng):
            take_off(traffic, place, now_s)
        else:
            place += 1
    for place in range(traffic.size[0]):
        see(day, traffic, traffic.line[place], now_s, rng)
    for stop in range(now_s % CYCLE_S, STOPS, CYCLE_S):
        ask(day, traffic, stop, now_s, rng)
    for tram in range(len(traffic.trams)):
        if traffic.due_ms[0, tram] <= 1_000 * now_s:
            deliver_reports(day, traffic, tram, 1_000 * now_s, rng)
        if traffic.due_ms[1, tram] <= 1_000 * now_s:
            deliver_orders(day, traffic, tram, now_s, rng)
    watch(day, traffic, 1_000 * now_s)


@compiled
def run_day(day: Given, traffic: Traffic, rng: np.random.Generator) -> None:
    """Run a day from the first tram to the last."""
    from_depot, depot_s = day.from_depot, day.where.depot_s
    for now_s in range(OPEN_S - TAKEN_UP_S, END_S):
        take_up(day, traffic, now_s)
        second(day, traffic, now_s, rng)
        begin_runs(day, traffic, now_s, rng)
        if from_depot > 0 and now_s >= depot_s and come_from_the_depot(day, traffic, now_s, rng):
            from_depot -= 1
            depot_s = now_s + DEPOT_EACH_S
        if traffic.size[0] == 0 and traffic.size[1] >= len(day.begins_s):
            return


def one_day(
    seed: int,
    number: int,
    limits: DispatchLimits = LIMITS,
    present: frozenset[str] | None = None,
    plant: int = NO_PLANT,
) -> tuple[Numbers, Given, Whole]:
    """Simulate a day: its row, what it was given, and when each run left each stop."""
    chance = np.random.default_rng((seed, number))
    day, drawn = given(chance, limits, present, plant)
    traffic = begun(TRAMS, STOPS, len(day.begins_s), len(tally.COLUMNS), OPEN_S)
    for place, name in enumerate(FAULTS):
        traffic.row[tally.COLUMNS.index("fault_canyon") + place] = drawn[name] > 0
    run_day(day, traffic, np.random.default_rng((seed, number, 1)))
    return traffic.row, day, traffic.log


SYSTEM = System(
    name="tram",
    claims=tally.CLAIMS,
    assumptions=tally.ASSUMPTIONS,
    monitors=tally.MONITORS,
    faults={f"fault_{name}": fault.says for name, fault in FAULTS.items()},
    prices=tally.PRICES,
    counts=tally.COUNTS,
    hours=HOURS,
    one_day=lambda seed, number: one_day(seed, number)[0],
)
"""One way of a tram line with a centre, stations and units (G2 to G6)."""
