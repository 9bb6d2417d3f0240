"""Days of a tram line, 16.5 hours each, with the truth beside the machines (G2 to G6)."""

from __future__ import annotations

import numpy as np

from kernel.tram.dispatching import DispatchLimits
from kernel.tram.limits import are_lawful, are_lawful_at_stops, are_told_apart
from models.compiled import compiled
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
from models.tram.given import LIMITS, NO_PLANT, STOP_LIMITS, Given, given, other_way
from models.tram.gps import BOUND_MM
from models.tram.line import (
    AWAY_S,
    CLOSE_S,
    DEPOT,
    FIRST_S,
    HOURS,
    LEAST_APART_MM,
    OPEN_S,
    STOPS,
    TAKEN_UP_S,
    TRAMS,
    Whole,
)
from models.tram.moving import (
    CLEAR_MM,
    RUN_OF_TURN,
    free_tram,
    is_free_at,
    move,
    place_beyond,
    take_off,
)
from models.tram.radio import CYCLE_S
from models.tram.state import (
    COMES_AT,
    CONFIRMED_S,
    DUE_S,
    K_IS,
    LEAVES,
    OFF_S,
    ON,
    TURN,
    Traffic,
    begun,
)
from models.tram.telling import ask, see
from models.tram.turning import (
    AWAITED_S,
    NO_RUN,
    ask_anew,
    begin_runs,
    come,
    destination,
    go_over,
    none_to_come,
    set_right,
    set_wrong,
    take_up_who_comes_back,
)
from models.tram.watching import watch

END_S = CLOSE_S + 2 * 3_600
"""By then the last tram has long left the way; the simulation ends with it."""
DEPOT_EACH_S = 1_800
ASKED_ANEW_EACH_S = 1_800
WRONG_WAY_EACH_S = 1_800
LATEST_BEGUN_S = 400
"""So late a run begins at most that is late at the terminus; ours."""
ELSEWHERE_S, ELSEWHERE_EACH_S = 60, 30
"""So long after it has left the way a tram is heard elsewhere, and so often; practice: the next stop's station."""
ASKED_AFTER_S = 600
"""So long after it was due off the way the dispatcher asks for a tram that is not heard; ours."""
RESTARTED_AFTER_S = 3_700
"""So long after a start the centre starts anew once more; ours."""
COMES_BACK_S = 3_600
"""So much longer a day is simulated on which trams come back; ours."""


@compiled
def take_up(day: Given, traffic: Traffic, there: Traffic, now_s: int, rng: np.random.Generator) -> None:
    """Tell the centre of the next run of the timetable; ``size[1]``: so many were.

    Where trams come back from the other way one is used again as soon as it has turned.
    """
    run = traffic.size[1]
    if run >= len(day.begins_s) or now_s < day.begins_s[run] - TAKEN_UP_S:
        return
    tram = free_tram(traffic, there, now_s, day.turns_s if day.turns_s > 0 else AWAY_S)
    if tram < 0 or not may_take_up(traffic, tram, 0):
        return
    body = traffic.trams[tram]
    body[TURN], body[LEAVES], body[OFF_S] = RUN_OF_TURN * (run + 1), day.leaves_at[run], AWAITED_S
    body[COMES_AT] = 0
    body[DUE_S] = day.begins_s[run] + (int(LATEST_BEGUN_S * rng.random()) if rng.random() < day.late_runs else 0)
    body[CONFIRMED_S] = now_s
    confirm(traffic, tram, 0, destination(day, traffic, tram), 1_000 * now_s)
    traffic.size[1] += 1


@compiled
def tell_from_elsewhere(day: Given, traffic: Traffic, there: Traffic, now_s: int, rng: np.random.Generator) -> None:
    """Let trams that are off the way tell so, each half minute; who cannot is taken off by a person (G5).

    Those on the other way are heard where they run.
    """
    where = day.where
    for tram in range(len(traffic.trams)):
        body = traffic.trams[tram]
        if body[ON] == 1 or body[OFF_S] == AWAITED_S or (now_s + tram) % ELSEWHERE_EACH_S != 0:
            continue
        deaf = tram == where.deaf_tram and where.deaf_s <= now_s < where.deaf_s + day.tram_deaf_s
        tells = there.trams[tram, ON] == 0 and not deaf and now_s - body[OFF_S] >= ELSEWHERE_S
        if tells and rng.random() >= where.frames_lost:
            hear_elsewhere(traffic, tram, True, 1_000 * now_s, 1_000 * now_s)
        if body[K_IS] == 1 and now_s - body[OFF_S] >= ASKED_AFTER_S:
            take_off_by_hand(traffic, tram, 1_000 * now_s)
            traffic.row[tally.TAKEN_OFF] += 1


@compiled
def come_from_the_depot(day: Given, traffic: Traffic, there: Traffic, now_s: int, rng: np.random.Generator) -> bool:
    """Take up a tram at the depot's stop and let it come, if it may; whether it did (G5)."""
    tram = free_tram(traffic, there, now_s, AWAY_S)
    place = place_beyond(day, traffic, DEPOT)
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
def second(day: Given, traffic: Traffic, there: Traffic, now_s: int, rng: np.random.Generator) -> None:
    """Let a second pass on a way: trams move, units see, stations ask, the centre decides, orders arrive.

    ``there``: the other way.
    """
    place = 0
    while place < traffic.size[0]:
        if move(day, traffic, place, now_s, rng):
            tram = traffic.line[place]
            take_off(traffic, place, now_s)
            go_over(day, traffic, there, tram, now_s, rng)
        else:
            place += 1
    for place in range(traffic.size[0]):
        see(day, traffic, traffic.line[place], now_s, rng)
    for stop in range(now_s % CYCLE_S, STOPS, CYCLE_S):
        ask(day, traffic, there, stop, now_s, rng)
    for tram in range(len(traffic.trams)):
        if traffic.due_ms[0, tram] <= 1_000 * now_s:
            deliver_reports(day, traffic, there, tram, 1_000 * now_s, rng)
        if traffic.due_ms[1, tram] <= 1_000 * now_s:
            deliver_orders(day, traffic, tram, now_s, rng)
    tell_from_elsewhere(day, traffic, there, now_s, rng)
    watch(day, traffic, 1_000 * now_s)


@compiled
def restart_everything(day: Given, traffic: Traffic, there: Traffic, now_s: int) -> None:
    """Start the centre anew, which decides for both ways."""
    restart_centre(day.limits, traffic, 1_000 * now_s)
    restart_centre(day.limits, there, 1_000 * now_s)


@compiled
def second_there(day: Given, traffic: Traffic, there: Traffic, now_s: int, rng: np.random.Generator) -> None:
    """Let a second pass on the other way, for those that come back."""
    take_up_who_comes_back(day, there, traffic, now_s)
    second(day, there, traffic, now_s, rng)
    begin_runs(day, there, now_s, rng)


@compiled
def run_day(day: Given, back: Given, traffic: Traffic, there: Traffic, rng: np.random.Generator) -> None:
    """Run a day from the first tram to the last; ``back``, ``there``: the other way, if trams come back on it."""
    from_depot, depot_s = day.from_depot, day.where.depot_s
    restart_s, restarts = day.where.restart_s, day.restarts
    asked_anew, anew_s = day.asked_anew, day.where.anew_s
    wrong_way, wrong_s = day.wrong_way, day.where.wrong_s
    come_back = day.turns_s > 0 or day.away_s > 0
    restart_everything(day, traffic, there, FIRST_S)
    for now_s in range(FIRST_S, END_S + COMES_BACK_S if come_back else END_S):
        if restarts > 0 and now_s >= restart_s:
            restart_everything(day, traffic, there, now_s)
            restarts, restart_s = restarts - 1, now_s + RESTARTED_AFTER_S
        take_up(day, traffic, there, now_s, rng)
        second(day, traffic, there, now_s, rng)
        begin_runs(day, traffic, now_s, rng)
        if come_back or day.wrong_way > 0:
            second_there(back, traffic, there, now_s, rng)
        if from_depot > 0 and now_s >= depot_s and come_from_the_depot(day, traffic, there, now_s, rng):
            from_depot -= 1
            depot_s = now_s + DEPOT_EACH_S
        if asked_anew > 0 and now_s >= anew_s and ask_anew(day, traffic, 1_000 * now_s):
            asked_anew -= 1
            anew_s = now_s + ASKED_ANEW_EACH_S
        if wrong_way > 0 and now_s >= wrong_s and set_wrong(day, traffic, there, now_s):
            wrong_way -= 1
            wrong_s = now_s + WRONG_WAY_EACH_S
        set_right(traffic, there, now_s)
        are_away = traffic.size[0] == 0 and there.size[0] == 0
        if are_away and traffic.size[1] >= len(day.begins_s) and none_to_come(traffic) and none_to_come(there):
            return


def one_day(
    seed: int,
    number: int,
    limits: DispatchLimits = LIMITS,
    present: frozenset[str] | None = None,
    plant: int = NO_PLANT,
    beyond: tuple[str, ...] = (),
) -> tuple[Numbers, Given, Whole]:
    """Simulate a day: its row, what it was given, and when each run left each stop; ``beyond``: faults besides."""
    assert are_lawful(limits)
    assert are_lawful_at_stops(STOP_LIMITS, BOUND_MM)
    assert are_told_apart(STOP_LIMITS, BOUND_MM, LEAST_APART_MM)
    chance, apart = np.random.default_rng((seed, number)), np.random.default_rng((seed, number, 2))
    day, drawn = given(chance, apart, limits, present, plant, frozenset(beyond))
    back = other_way(day, apart)
    traffic = begun(TRAMS, STOPS, len(day.begins_s), len(tally.COLUMNS), OPEN_S)
    there = begun(TRAMS, STOPS, 0, len(tally.COLUMNS), OPEN_S)._replace(row=traffic.row)
    for place, name in enumerate(FAULTS):
        traffic.row[tally.COLUMNS.index("fault_canyon") + place] = drawn[name] > 0
    run_day(day, back, traffic, there, np.random.default_rng((seed, number, 1)))
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
    one_day=lambda seed, number, beyond=(): one_day(seed, number, beyond=beyond)[0],
    beyond={name: fault.breaks for name, fault in FAULTS.items() if fault.breaks},
)
"""A tram line, one way or both, with a centre, stations and units (G2 to G6)."""
