"""Days of a tram line, 16.5 hours each, with the truth beside the machines (G2 to G6)."""

from __future__ import annotations

import numpy as np

from kernel.tram.dispatching import DispatchLimits
from models.days.system import Numbers, System
from models.tram import tally
from models.tram.deciding import (
    confirm,
    deliver_orders,
    deliver_reports,
    hear_elsewhere,
    may_take_up,
    restart_centre,
    take_off_by_hand,
)
from models.tram.faults import FAULTS
from models.tram.given import LIMITS, NO_PLANT, Given, given
from models.tram.line import (
    AT_STOP_MM,
    CLOSE_S,
    DEPOT,
    FIRST_S,
    HOURS,
    OPEN_S,
    STOPS,
    TAKEN_UP_S,
    TRAMS,
    Whole,
)
from models.tram.machines import compiled
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
    CONFIRMED_S,
    DUE_S,
    K_IS,
    LEAVES,
    NEXT,
    OFF_S,
    ON,
    PLACE,
    SPEED,
    TURN,
    WAITS,
    Traffic,
    begun,
)
from models.tram.telling import ask, begin_unit, see
from models.tram.watching import watch

END_S = CLOSE_S + 2 * 3_600
"""By then the last tram has long left the way; the simulation ends with it."""
DEPOT_EACH_S = 1_800
AWAITED_S = 10**9
"""`OFF_S` of a vehicle that was taken up for a run, and has not come yet."""
LATEST_BEGUN_S = 400
"""So late a run begins at most that is late at the terminus; ours."""
ELSEWHERE_S, ELSEWHERE_EACH_S = 60, 30
"""So long after it has left the way a tram is heard elsewhere, and so often; practice: the next stop's station."""
ASKED_AFTER_S = 600
"""So long after it was due off the way the dispatcher asks for a tram that is not heard; ours."""
RESTARTED_AFTER_S = 3_700
"""So long after a start the centre starts anew once more; ours."""
NO_RUN = 1
"""`TURN` of a tram from the depot, which is in no timetable."""


@compiled
def destination(day: Given, traffic: Traffic, tram: int) -> int:
    """Give where a tram is set to leave: not always where it does."""
    is_wrong = day.wrong_destination > 0 and tram == day.where.destination_tram
    return int(day.wrong_destination if is_wrong else traffic.trams[tram, LEAVES])


@compiled
def take_up(day: Given, traffic: Traffic, now_s: int, rng: np.random.Generator) -> None:
    """Tell the centre of the next run of the timetable; ``size[1]``: so many were."""
    run = traffic.size[1]
    if run >= len(day.begins_s) or now_s < day.begins_s[run] - TAKEN_UP_S:
        return
    tram = free_tram(traffic, now_s)
    if tram < 0 or not may_take_up(traffic, tram, 0):
        return
    body = traffic.trams[tram]
    body[TURN], body[LEAVES], body[OFF_S] = RUN_OF_TURN * (run + 1), day.leaves_at[run], AWAITED_S
    body[DUE_S] = day.begins_s[run] + (int(LATEST_BEGUN_S * rng.random()) if rng.random() < day.late_runs else 0)
    body[CONFIRMED_S] = now_s
    confirm(traffic, tram, 0, destination(day, traffic, tram), 1_000 * now_s)
    traffic.size[1] += 1


@compiled
def begin_runs(day: Given, traffic: Traffic, now_s: int, rng: np.random.Generator) -> None:
    """Let trams come that were taken up, in whatever order they are ready, if the first stop is free (G5).

    Whose confirmation has lapsed asks anew: a person takes the tram off, and it is confirmed once more.
    """
    for tram in range(len(traffic.trams)):
        body = traffic.trams[tram]
        if body[OFF_S] != AWAITED_S or now_s < body[DUE_S] or not is_free_at(traffic, 0, 2 * AT_STOP_MM):
            continue
        if 1_000 * (now_s - body[CONFIRMED_S]) > day.limits.coming_ms:
            take_off_by_hand(traffic, tram, 1_000 * now_s)
            hear_elsewhere(traffic, tram, 1_000 * now_s, 1_000 * now_s)
            if not confirm(traffic, tram, 0, destination(day, traffic, tram), 1_000 * now_s):
                continue
            body[CONFIRMED_S] = now_s
            traffic.row[tally.CONFIRMED_ANEW] += 1
        come(day, traffic, tram, traffic.size[0], 0, now_s, rng)
        body[OFF_S] = now_s


@compiled
def tell_from_elsewhere(day: Given, traffic: Traffic, now_s: int, rng: np.random.Generator) -> None:
    """Let trams that are off the way tell so, each half minute; who cannot is taken off by a person (G5)."""
    where = day.where
    for tram in range(len(traffic.trams)):
        body = traffic.trams[tram]
        if body[ON] == 1 or body[OFF_S] == AWAITED_S or (now_s + tram) % ELSEWHERE_EACH_S != 0:
            continue
        deaf = tram == where.deaf_tram and where.deaf_s <= now_s < where.deaf_s + day.tram_deaf_s
        if not deaf and now_s - body[OFF_S] >= ELSEWHERE_S and rng.random() >= where.frames_lost:
            hear_elsewhere(traffic, tram, 1_000 * now_s, 1_000 * now_s)
        if body[K_IS] == 1 and now_s - body[OFF_S] >= ASKED_AFTER_S:
            take_off_by_hand(traffic, tram, 1_000 * now_s)
            traffic.row[tally.TAKEN_OFF] += 1


@compiled
def come(
    day: Given, traffic: Traffic, tram: int, place_in_line: int, stop: int, now_s: int, rng: np.random.Generator
) -> None:
    """Let a tram come onto the way at a stop, and serve it."""
    body = traffic.trams[tram]
    traffic.row[tally.UNANNOUNCED] += 1_000 * (now_s - body[CONFIRMED_S]) > day.limits.coming_ms
    body[PLACE], body[SPEED], body[NEXT], body[WAITS] = day.stops_mm[stop], 0, stop, 0
    put_on(traffic, place_in_line, tram)
    begin_unit(day, body, stop, 1_000 * now_s)
    serve(day, traffic, tram, now_s, rng)


@compiled
def come_from_the_depot(day: Given, traffic: Traffic, now_s: int, rng: np.random.Generator) -> bool:
    """Take up a tram at the depot's stop and let it come, if it may; whether it did (G5)."""
    tram = free_tram(traffic, now_s)
    place = depot_place(day, traffic)
    if tram < 0:
        return False
    if not is_free_at(traffic, day.stops_mm[DEPOT], CLEAR_MM):
        return False
    body = traffic.trams[tram]
    body[TURN], body[LEAVES] = NO_RUN, STOPS - 1
    if not confirm(traffic, tram, DEPOT, destination(day, traffic, tram), 1_000 * now_s):
        traffic.row[tally.NOT_TAKEN_UP] += 1
        return False
    body[CONFIRMED_S] = now_s
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
    tell_from_elsewhere(day, traffic, now_s, rng)
    watch(day, traffic, 1_000 * now_s)


@compiled
def none_awaited(traffic: Traffic) -> bool:
    """Whether no tram is still to come."""
    awaited = 0
    for tram in range(len(traffic.trams)):
        awaited += traffic.trams[tram, OFF_S] == AWAITED_S
    return awaited == 0


@compiled
def run_day(day: Given, traffic: Traffic, rng: np.random.Generator) -> None:
    """Run a day from the first tram to the last."""
    from_depot, depot_s = day.from_depot, day.where.depot_s
    restart_s, restarts = day.where.restart_s, day.restarts
    restart_centre(day.limits, traffic, 1_000 * FIRST_S)
    for now_s in range(FIRST_S, END_S):
        if restarts > 0 and now_s >= restart_s:
            restart_centre(day.limits, traffic, 1_000 * now_s)
            restarts, restart_s = restarts - 1, now_s + RESTARTED_AFTER_S
        take_up(day, traffic, now_s, rng)
        second(day, traffic, now_s, rng)
        begin_runs(day, traffic, now_s, rng)
        if from_depot > 0 and now_s >= depot_s and come_from_the_depot(day, traffic, now_s, rng):
            from_depot -= 1
            depot_s = now_s + DEPOT_EACH_S
        if traffic.size[0] == 0 and traffic.size[1] >= len(day.begins_s) and none_awaited(traffic):
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
