"""Trams that come onto a way: confirmed, awaited, and come; and those that go over from one way to the other (G5).

At the far terminus a tram turns and begins anew at the first stop of the other way.  Those of the other line turn off
at the junction, and come back there later: the stops from the junction to the near terminus are both lines'.  Whoever
comes at the junction is confirmed for that stop, as one from the depot is for its own.  Compiled.
"""

from __future__ import annotations

import numpy as np

from models.compiled import compiled
from models.tram import tally
from models.tram.deciding import confirm, forget, hear_elsewhere, take_off_by_hand
from models.tram.given import JOINS_UNASKED, TAKES_UP_ANEW, Given
from models.tram.line import AT_STOP_MM, BRANCH, JOINS, STOPS, TAKEN_UP_S
from models.tram.machines import MADE
from models.tram.moving import CLEAR_MM, is_free_at, place_beyond, put_on, serve
from models.tram.state import (
    COMES_AT,
    CONFIRMED_S,
    DUE_S,
    FREE,
    K_IS,
    LEAVES,
    NEXT,
    OFF_S,
    PLACE,
    SPEED,
    TURN,
    U_ASTRAY,
    U_RIGHT_S,
    WAITS,
    Traffic,
)
from models.tram.telling import begin_unit, keep_known, start_unit

coming = MADE.dispatching.coming
AWAITED_S = 10**9
"""`OFF_S` of a vehicle that was confirmed for a run, and has not come yet."""
NO_RUN = 1
"""`TURN` of a tram that is in no timetable: from the depot, or on its way back."""
LATER_S = 120
"""Turning and the other line take so much longer at most than is drawn for the day; ours."""
WRONG_FOR_S = 600
"""So long after it was set a driver notices a wrong way; ours."""
GIVES_UP_S = 1_800
"""So long after it was due a tram that is not confirmed goes to the depot; ours."""


@compiled
def destination(day: Given, traffic: Traffic, tram: int) -> int:
    """Give where a tram is set to leave: not always where it does."""
    is_wrong = day.wrong_destination > 0 and tram == day.where.destination_tram
    return int(day.wrong_destination if is_wrong else traffic.trams[tram, LEAVES])


@compiled
def none_to_come(traffic: Traffic) -> bool:
    """Whether no tram is still to come."""
    awaited = 0
    for tram in range(len(traffic.trams)):
        awaited += traffic.trams[tram, COMES_AT] != FREE
    return awaited == 0


@compiled
def ask_anew(day: Given, traffic: Traffic, now_ms: int) -> bool:
    """Ask to confirm one for the first stop that is on the way, in the middle of all; whether there was one (G5)."""
    if traffic.size[0] < 3:
        return False
    tram = traffic.line[traffic.size[0] // 2]
    if day.plant == TAKES_UP_ANEW:
        forget(traffic, tram, now_ms)
    is_anew = confirm(traffic, tram, 0, destination(day, traffic, tram), now_ms)
    traffic.row[tally.NOT_TAKEN_UP_ANEW] += not is_anew
    return True


@compiled
def set_wrong(day: Given, traffic: Traffic, there: Traffic, now_s: int) -> bool:
    """Start the unit of one that is on the way anew, set to the other way; whether there was one (G6).

    Where trams come back on that, it is set too soon: the tram was confirmed for its first stop, if it may be.
    """
    if traffic.size[0] == 0:
        return False
    tram = traffic.line[day.where.wrong_place % traffic.size[0]]
    if day.turns_s > 0 and confirm(there, tram, 0, STOPS - 1, 1_000 * now_s):
        there.trams[tram, CONFIRMED_S] = now_s
        traffic.row[tally.SET_TOO_SOON] += 1
    body = traffic.trams[tram]
    start_unit(body, 0, 1_000 * now_s, True)
    body[U_RIGHT_S] = now_s + WRONG_FOR_S
    traffic.row[tally.SET_WRONG] += 1
    return True


@compiled
def set_right(traffic: Traffic, there: Traffic, now_s: int) -> None:
    """Let drivers notice that the other way is set: the unit begins anew, at the first stop of this one (G6).

    Who was confirmed there is taken off: that has lapsed.
    """
    for place in range(traffic.size[0]):
        tram = traffic.line[place]
        body = traffic.trams[tram]
        if body[U_ASTRAY] == 1 and now_s >= body[U_RIGHT_S]:
            start_unit(body, 0, 1_000 * now_s, False)
            take_off_by_hand(there, tram, 1_000 * now_s)


# ---- onto a way


@compiled
def come(
    day: Given, traffic: Traffic, tram: int, place_in_line: int, stop: int, now_s: int, rng: np.random.Generator
) -> None:
    """Let a tram come onto the way at a stop, and serve it."""
    body = traffic.trams[tram]
    traffic.row[tally.UNANNOUNCED] += 1_000 * (now_s - body[CONFIRMED_S]) > day.limits.coming_ms
    body[PLACE], body[SPEED], body[NEXT], body[WAITS] = day.stops_mm[stop], 0, stop, 0
    body[COMES_AT] = FREE
    put_on(traffic, place_in_line, tram)
    begin_unit(day, body, stop, 1_000 * now_s)
    serve(day, traffic, tram, now_s, rng)


@compiled
def begin_runs(day: Given, traffic: Traffic, now_s: int, rng: np.random.Generator) -> None:
    """Let trams come that were confirmed, in whatever order they are ready, if their stop is free (G5).

    Whose confirmation has lapsed asks anew: a person takes the tram off, and it is confirmed once more.
    """
    for tram in range(len(traffic.trams)):
        body = traffic.trams[tram]
        stop = body[COMES_AT]
        if body[OFF_S] != AWAITED_S or now_s < body[DUE_S]:
            continue
        if not is_free_at(traffic, day.stops_mm[stop], CLEAR_MM if stop > 0 else 2 * AT_STOP_MM):
            continue
        if 1_000 * (now_s - body[CONFIRMED_S]) > day.limits.coming_ms:
            take_off_by_hand(traffic, tram, 1_000 * now_s)
            hear_elsewhere(traffic, tram, True, 1_000 * now_s, 1_000 * now_s)
            if not confirm(traffic, tram, stop, destination(day, traffic, tram), 1_000 * now_s):
                continue
            body[CONFIRMED_S] = now_s
            traffic.row[tally.CONFIRMED_ANEW] += 1
        traffic.row[tally.TURNED] += day.is_back and stop == 0
        traffic.row[tally.JOINED] += day.is_back and stop == JOINS
        come(day, traffic, tram, place_beyond(day, traffic, stop) if stop > 0 else traffic.size[0], stop, now_s, rng)
        body[OFF_S] = now_s


# ---- from one way to the other


@compiled
def go_over(day: Given, traffic: Traffic, there: Traffic, tram: int, now_s: int, rng: np.random.Generator) -> None:
    """Let a tram that has left a way make for the other one, from the terminus or by the other line; or be free.

    Who was confirmed there while it was on this one is awaited already.
    """
    if day.is_back:
        there.trams[tram, OFF_S] = now_s
        return
    left_at, stop, later_s = traffic.trams[tram, LEAVES], FREE, 0
    if left_at == STOPS - 1 and day.turns_s > 0:
        stop, later_s = 0, day.turns_s
    elif left_at == BRANCH and day.away_s > 0:
        stop, later_s = JOINS, day.away_s
    if stop != FREE:
        body = there.trams[tram]
        body[COMES_AT], body[TURN], body[LEAVES] = stop, NO_RUN, STOPS - 1
        body[DUE_S] = now_s + later_s + int(LATER_S * rng.random())
        if body[K_IS] == 1:
            body[OFF_S] = AWAITED_S
    else:
        take_off_by_hand(there, tram, 1_000 * now_s)


@compiled
def is_confirmed(day: Given, traffic: Traffic, tram: int, now_ms: int) -> bool:
    """Ask the centre to confirm a tram that comes back; whether it did."""
    stop = traffic.trams[tram, COMES_AT]
    if day.plant == JOINS_UNASKED and stop == JOINS and traffic.trams[tram, K_IS] == 0:
        keep_known(traffic.trams[tram], coming(now_ms, stop, destination(day, traffic, tram)))
        return True
    return bool(confirm(traffic, tram, stop, destination(day, traffic, tram), now_ms))


@compiled
def take_up_who_comes_back(day: Given, traffic: Traffic, there: Traffic, now_s: int) -> None:
    """Let the centre confirm those that come back; ``there``: the way that they left.

    At the terminus that is shortly before they are due; at the junction a tram asks when it stands before it.
    """
    for tram in range(len(traffic.trams)):
        body = traffic.trams[tram]
        asks_s = body[DUE_S] - (TAKEN_UP_S if body[COMES_AT] == 0 else 0)
        if body[COMES_AT] == FREE or body[OFF_S] == AWAITED_S or now_s < asks_s:
            continue
        if is_confirmed(day, traffic, tram, 1_000 * now_s):
            body[OFF_S] = AWAITED_S
            body[CONFIRMED_S] = now_s
        elif now_s > body[DUE_S] + GIVES_UP_S:
            body[COMES_AT], there.trams[tram, OFF_S] = FREE, now_s
            traffic.row[tally.GIVEN_UP] += 1
        else:
            traffic.row[tally.NOT_TAKEN_UP] += body[COMES_AT] > 0
