"""The truth held against what the machines decide, in a simulated day (G2 to G6)."""

from __future__ import annotations

from typing import Any

from models.compiled import compiled
from models.tram import tally
from models.tram.given import Given
from models.tram.gps import BOUND_MM
from models.tram.line import AT_STOP_MM
from models.tram.machines import MADE
from models.tram.state import (
    D_HOLDS,
    D_NOW,
    D_RECOVERS,
    D_STANDS,
    D_STOP,
    DWELL_S,
    FREE,
    G_BEHIND,
    G_MADE,
    G_MARK,
    G_TOLD,
    K_IS,
    LEAVES,
    NEXT,
    ON,
    PLACE,
    U_ASTRAY,
    U_LEFT,
    U_STOP,
    WAITS,
    Traffic,
)
from models.tram.telling import is_behind

FRESH_MS = 11_000
ORDER_MS = 18_000
"""Written out once more, so that a machine with other limits is found out."""
mark = MADE.dispatching.mark


@compiled
def left_mm(day: Given, stop: int) -> int:
    """So far on a tram has left a stop, in truth: `stopping.what_was_left_is_behind`."""
    return int(day.stops_mm[min(stop, len(day.stops_mm) - 1)] + AT_STOP_MM - BOUND_MM)


@compiled
def is_occupied(day: Given, traffic: Traffic, tram: int, stop: int) -> bool:
    """Whether a tram is ahead of this one up to the next stop, or at it, wherever it is bound for."""
    at_mm, until_mm = traffic.trams[tram, PLACE], left_mm(day, stop + 1)
    for place in range(traffic.size[0]):
        other = traffic.line[place]
        body = traffic.trams[other]
        if other != tram and at_mm < body[PLACE] <= until_mm:
            return True
    return False


@compiled
def is_truly_near(day: Given, traffic: Traffic, tram: int, stop: int, now_ms: int, limit_ms: int) -> bool:
    """Whether another tram has left this stop less long ago."""
    for other in range(len(traffic.trams)):
        if other != tram and now_ms - traffic.truly_left_ms[other, stop] < limit_ms:
            return True
    return False


@compiled
def judge(day: Given, traffic: Traffic, tram: int, own: Any, order: Any, now_ms: int) -> None:
    """Hold an order, as it is made, against what was truly told; and count what it costs (G4 to G6).

    A tram that has left the way meanwhile does not hear it.
    """
    row, body = traffic.row, traffic.trams[tram]
    row[tally.ORDERS] += 1
    row[tally.ORDERS_TO_HOLD] += order.holds
    row[tally.ORDERS_TO_RECOVER] += order.recovers
    row[tally.ORDER_BY_GUESS] += (order.holds or order.recovers) and now_ms - body[G_TOLD] > FRESH_MS
    if order.recovers and body[ON] == 1:
        for place in range(traffic.size[0]):
            other = traffic.line[place]
            ahead = traffic.trams[other]
            if other != tram and ahead[PLACE] > body[PLACE]:
                had_told = ahead[K_IS] == 0 or ahead[G_MARK] > mark(order.stop + 1, False)
                row[tally.RECOVERY_UNKNOWN] += not had_told or ahead[PLACE] <= left_mm(day, order.stop + 1)
    stands = body[DWELL_S] != FREE and body[NEXT] == order.stop and order.stop < body[LEAVES]
    if stands and not order.holds and not is_occupied(day, traffic, tram, order.stop):
        is_near = is_truly_near(day, traffic, tram, order.stop, now_ms, day.limits.recovery_ms)
        row[tally.RECOVERIES_DUE] += not is_near
        row[tally.RECOVERIES_NOT_GIVEN] += not is_near and not order.recovers


@compiled
def watch_orders(day: Given, traffic: Traffic, tram: int, now_ms: int) -> None:
    """What a driver is shown in this second (G4 to G6)."""
    row, body = traffic.row, traffic.trams[tram]
    holds, recovers, stop = body[D_HOLDS] == 1, body[D_RECOVERS] == 1, body[D_STOP]
    row[tally.HOLD_AND_RECOVERY] += holds and recovers
    counts = now_ms - body[G_MADE] <= ORDER_MS
    row[tally.ORDER_STALE] += body[D_STANDS] == 1 and (holds or recovers) and not counts
    if recovers:
        row[tally.RECOVERY_S] += body[DWELL_S] == FREE
        row[tally.RECOVERY_OCCUPIED] += is_occupied(day, traffic, tram, stop)
        following = min(stop + 1, len(day.stops_mm) - 1)
        row[tally.RECOVERY_BEYOND] += body[PLACE] > day.stops_mm[following] + AT_STOP_MM + BOUND_MM + 15_000
    if body[WAITS] == 1:
        at = body[NEXT]
        row[tally.HELD_S] += 1
        near = is_truly_near(day, traffic, tram, at, now_ms, day.limits.ahead_hold_ms)
        row[tally.NEEDLESS_S] += not near and not is_occupied(day, traffic, tram, at) and body[G_BEHIND] == 0


@compiled
def watch(day: Given, traffic: Traffic, now_ms: int) -> None:
    """Look at all trams on the way, as they are in this second (G2 to G6)."""
    row = traffic.row
    for place in range(traffic.size[0]):
        tram = traffic.line[place]
        body = traffic.trams[tram]
        row[tally.TRAM_S] += 1
        row[tally.NOT_KNOWN_S] += body[K_IS] == 0
        row[tally.CLOCK_BROKEN] += body[D_NOW] != now_ms
        stop_mm = day.stops_mm[body[U_STOP]]
        has_left = body[U_LEFT] == 1 and (body[PLACE] <= stop_mm + AT_STOP_MM - BOUND_MM or body[U_ASTRAY] == 1)
        is_before = body[PLACE] < stop_mm - AT_STOP_MM - BOUND_MM and body[U_ASTRAY] == 0
        row[tally.REACHED_TOO_SOON] += has_left or is_before
        watch_orders(day, traffic, tram, now_ms)
        if place > 0:
            leader = traffic.line[place - 1]
            ahead = traffic.trams[leader]
            row[tally.OVERTAKEN] += ahead[PLACE] <= body[PLACE]
            are_known = ahead[K_IS] == 1 and body[K_IS] == 1
            row[tally.ORDER_TURNED] += are_known and is_behind(traffic, tram, leader)
