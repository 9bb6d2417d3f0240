"""What units know and tell, and what stations carry, in a simulated day (G1 to G6).

The kernel's own functions, compiled.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from models.compiled import compiled, packed
from models.tram import tally
from models.tram.given import (
    GPS_BEYOND,
    LEAVES_AT_ONCE,
    NEVER_LOST,
    SPEED_ERROR_MM_S,
    STOP_LIMITS,
    Given,
)
from models.tram.gps import BOUND_MM, PLAN
from models.tram.line import AT_STOP_MM
from models.tram.machines import MADE
from models.tram.radio import REACH_MM, SLOTS
from models.tram.state import (
    BOX,
    D_HOLDS,
    D_LOCATED,
    D_MADE,
    D_NOW,
    D_RECOVERS,
    D_STANDS,
    D_STOP,
    DWELL_S,
    FREE,
    G_BEHIND,
    G_MARK,
    G_TOLD,
    H_AGE,
    H_ANSWERED,
    H_KNOWN,
    K_ARRIVED,
    K_COMES,
    K_IS,
    K_LEAVES,
    K_LEFT,
    K_RECOVERY,
    K_SINCE,
    K_STANDS,
    K_STOP,
    K_TOLD,
    LEAVES,
    NEVER_MS,
    PLACE,
    SPEED,
    U_ASTRAY,
    U_FOLLOWED,
    U_LEAST,
    U_LEFT,
    U_MOST,
    U_RUN,
    U_STANDS,
    U_STOOD,
    U_STOP,
    Traffic,
)

FAR_MM = 10**12
LATEST_S = 300
"""What comes once more comes so much later at most."""
SLOW_FOR_S = 3_600
STOP = packed(STOP_LIMITS)
SLOT = packed(SLOTS)
Known, mark = MADE.dispatching.Known, MADE.dispatching.mark
Display, begun, located, older = MADE.display.Display, MADE.display.begun, MADE.display.located, MADE.display.older
Fix, Stopping, note_fix = MADE.stopping.Fix, MADE.stopping.Stopping, MADE.stopping.note_fix
stops_begun = MADE.stopping.begun
Heard, Answer = MADE.cycle.Heard, MADE.cycle.Answer
note_answer, age_heard, note_cycle, is_heard, slot_begins_ms = (
    MADE.cycle.note_answer,
    MADE.cycle.older,
    MADE.cycle.note_cycle,
    MADE.cycle.is_fresh,
    MADE.cycle.slot_begins_ms,
)


# ---- records from columns, and back


@compiled
def known_of(body: Any) -> Any:
    """What the centre knows of a tram."""
    return Known(
        body[K_LEAVES],
        body[K_SINCE],
        body[K_STOP],
        body[K_LEFT] == 1,
        body[K_STANDS] == 1,
        body[K_ARRIVED],
        body[K_TOLD],
        body[K_RECOVERY],
        body[K_COMES],
    )


@compiled
def keep_known(body: Any, known: Any) -> None:
    """Keep it."""
    body[K_IS] = 1
    body[K_LEAVES] = known.leaves_at
    body[K_SINCE] = known.since_ms
    body[K_STOP] = known.stop
    body[K_LEFT] = known.left
    body[K_STANDS] = known.stands
    body[K_ARRIVED] = known.arrived_ms
    body[K_TOLD] = known.told_ms
    body[K_RECOVERY] = known.recovery_to
    body[K_COMES] = known.comes_at


@compiled
def display_of(body: Any) -> Any:
    """What a driver is shown."""
    return Display(
        body[D_NOW],
        body[D_LOCATED] == 1,
        body[D_STOP],
        body[D_STANDS] == 1,
        body[D_HOLDS] == 1,
        body[D_RECOVERS] == 1,
        body[D_MADE],
    )


@compiled
def keep_display(body: Any, display: Any) -> None:
    """Keep it."""
    body[D_NOW] = display.now_ms
    body[D_LOCATED] = display.is_located
    body[D_STOP] = display.stop
    body[D_STANDS] = display.stands
    body[D_HOLDS] = display.holds
    body[D_RECOVERS] = display.recovers
    body[D_MADE] = display.made_ms


@compiled
def contradicts(traffic: Traffic, tram: int, other: int) -> bool:
    """As :func:`kernel.tram.centre.contradicts`."""
    return bool(traffic.shown[tram, other] == 1 and traffic.shown[other, tram] == 1)


@compiled
def is_behind(traffic: Traffic, tram: int, other: int) -> bool:
    """Tell whether the centre has a tram behind this one, and nothing that contradicts it."""
    return bool(traffic.shown[tram, other] == 1 and not contradicts(traffic, tram, other))


# ---- on board


@compiled
def stopping_of(day: Given, body: Any) -> Any:
    """What a unit tells, and has seen of the way that is set."""
    has_run = body[U_RUN] == 1 or day.plant == LEAVES_AT_ONCE
    return Stopping(
        body[U_STOP],
        body[U_LEFT] == 1,
        body[U_STANDS] == 1,
        body[U_FOLLOWED] == 1,
        body[U_LEAST],
        body[U_MOST],
        has_run,
    )


@compiled
def keep_stopping(body: Any, told: Any) -> None:
    """Keep it."""
    body[U_STOP], body[U_LEFT], body[U_STANDS] = told.stop, told.left, told.stands
    body[U_FOLLOWED], body[U_RUN] = told.is_followed, told.has_run
    body[U_LEAST], body[U_MOST] = told.least_mm, told.most_mm


@compiled
def start_unit(body: Any, stop: int, now_ms: int, is_astray: bool) -> None:
    """Start a unit: at the stop where a run begins, or anew; its driver sets the way that it is on, or the other."""
    keep_display(body, begun(now_ms))
    keep_stopping(body, stops_begun(stop))
    body[U_STOOD], body[U_ASTRAY] = body[PLACE], is_astray


@compiled
def begin_unit(day: Given, body: Any, stop: int, now_ms: int) -> None:
    """Start a unit at the stop where a run begins."""
    start_unit(body, stop, now_ms, False)
    body[H_KNOWN], body[H_AGE], body[H_ANSWERED] = 0, 0, 0
    body[G_MARK], body[G_TOLD], body[G_BEHIND] = 2 * stop, NEVER_MS, 0


@compiled
def fix_of(day: Given, traffic: Traffic, tram: int, now_s: int, rng: np.random.Generator) -> Any:
    """What GPS and the wheels say."""
    body, errors = traffic.trams[tram], traffic.errors_m[tram]
    errors[0] = KEEPS_SLOW * errors[0] + rng.normal() * DRAWS_SLOW
    errors[1] = KEEPS_MULTIPATH * errors[1] + rng.normal() * DRAWS_MULTIPATH
    off_mm = int(1_000 * (errors[0] + errors[1]))
    if rng.random() < REFLECTED:
        off_mm += int(REFLECTED_MM * rng.normal())
    if day.plant == GPS_BEYOND:
        off_mm = 6 * off_mm + 40_000
    place = body[PLACE]
    where = day.where
    has_place = (
        (abs(off_mm) <= BOUND_MM or day.plant == GPS_BEYOND)
        and not where.canyon_mm <= place < where.canyon_mm + day.canyon_mm
        and not where.outage_s <= now_s < where.outage_s + day.outage_s
    )
    has_speed = not (tram == where.speed_tram and where.speed_s <= now_s < where.speed_s + day.speed_lost_s)
    speed = body[SPEED] + int((2 * rng.random() - 1) * SPEED_ERROR_MM_S)
    traffic.row[tally.PLACE_BROKEN] += has_place and abs(off_mm) > BOUND_MM
    traffic.row[tally.SPEED_BROKEN] += has_speed and abs(speed - body[SPEED]) > SPEED_ERROR_MM_S
    return Fix(has_place or day.plant == NEVER_LOST, place + off_mm if has_place else 0, has_speed, speed)


REFLECTED, REFLECTED_MM = PLAN.reflected, 1_000 * PLAN.reflected_m
KEEPS_SLOW = float(np.exp(-1.0 / PLAN.slow_s))
KEEPS_MULTIPATH = float(np.exp(-1.0 / PLAN.multipath_s))
DRAWS_SLOW = PLAN.slow_m * float(np.sqrt(1 - KEEPS_SLOW**2))
DRAWS_MULTIPATH = PLAN.multipath_m * float(np.sqrt(1 - KEEPS_MULTIPATH**2))


@compiled
def stop_set_mm(day: Given, body: Any, stop: int) -> int:
    """Where a stop is along the way that a unit is set to."""
    last = len(day.stops_mm) - 1
    if stop > last:
        return FAR_MM
    return int(day.stops_mm[stop] if body[U_ASTRAY] == 0 else day.stops_mm[last] - day.stops_mm[last - stop])


@compiled
def see(day: Given, traffic: Traffic, tram: int, now_s: int, rng: np.random.Generator) -> None:
    """Let a unit take its fix, and what it shows grow older."""
    body = traffic.trams[tram]
    fix = fix_of(day, traffic, tram, now_s, rng)
    if body[U_ASTRAY] == 1 and fix.is_placed:
        fix = Fix(True, day.stops_mm[-1] - fix.place_mm, fix.has_speed, fix.speed_mm_s)
    before = stopping_of(day, body)
    here_mm, next_mm = stop_set_mm(day, body, before.stop), stop_set_mm(day, body, before.stop + 1)
    if day.plant == NEVER_LOST and not (fix.is_placed and fix.has_speed and fix.place_mm != 0):
        now = before
    else:
        now = note_fix(STOP, before, here_mm, next_mm, fix)
    is_known = fix.is_placed and fix.has_speed
    stood = before.stands and body[U_STOOD] == body[PLACE]
    traffic.row[tally.WANDERED] += stood and is_known and fix.speed_mm_s < 1_389 and not now.stands
    if now.stands and not before.stands:
        body[U_STOOD] = body[PLACE]
    keep_stopping(body, now)
    traffic.row[tally.PLACE_LOST] += not fix.is_placed
    display = display_of(body)
    aged = older(day.limits, display, 1_000)
    traffic.row[tally.ORDERS_LAPSED] += (display.holds or display.recovers) and not (aged.holds or aged.recovers)
    keep_display(body, located(aged, is_known, now.stop, now.stands))


# ---- stations


@compiled
def is_in_reach(day: Given, traffic: Traffic, tram: int, stop: int) -> bool:
    """Whether a tram hears the station of a stop."""
    return bool(abs(traffic.trams[tram, PLACE] - day.stops_mm[stop]) <= REACH_MM)


@compiled
def is_lost(day: Given, tram: int, stop: int, now_s: int, rng: np.random.Generator) -> bool:
    """Whether a frame between a station and a tram is lost, or damaged beyond its code."""
    where = day.where
    deaf = tram == where.deaf_tram and where.deaf_s <= now_s < where.deaf_s + day.tram_deaf_s
    drawn = rng.random()
    return bool(
        deaf or drawn < (max(day.station_deaf, where.frames_lost) if stop == where.station else where.frames_lost)
    )


@compiled
def slower_ms(day: Given, now_s: int) -> int:
    """How much longer the link to the centre takes now."""
    return day.slower_ms if day.where.slow_s <= now_s < day.where.slow_s + SLOW_FOR_S else 0


@compiled
def send(box: Any, first_ms: Any, tram: int, due_ms: int, message: tuple[int, ...]) -> None:
    """Put a message on its way; where all places are taken it is lost."""
    for place in range(BOX):
        if box[place, 0] == FREE:
            box[place, 0] = due_ms
            first_ms[tram] = min(first_ms[tram], due_ms)
            for part in range(len(message)):
                box[place, part + 1] = message[part]
            return


@compiled
def ask(day: Given, traffic: Traffic, there: Traffic, stop: int, now_s: int, rng: np.random.Generator) -> None:
    """Let a station ask the first two trams of this way that it reaches: up 1, up 2; down 1, down 2 (table 1).

    Whose unit is set to the other way is asked as one of that.
    """
    slot = most = 2 if day.is_back else 0
    for place in range(traffic.size[0]):
        tram = traffic.line[place]
        if traffic.trams[tram, U_ASTRAY] == 1:
            if is_in_reach(day, traffic, tram, stop):
                ask_one(day, traffic, there, tram, stop, 2 - most, now_s, rng)
        elif slot < most + 2 and is_in_reach(day, traffic, tram, stop):
            ask_one(day, traffic, traffic, tram, stop, slot, now_s, rng)
            slot += 1


@compiled
def number_told(day: Given, traffic: Traffic, tram: int, now_s: int) -> int:
    """The number that a tram tells: its own, or by a wrong setting that of the second tram behind it."""
    where = day.where
    if tram == where.number_tram and where.number_s <= now_s < where.number_s + day.number_told_s:
        for place in range(traffic.size[0] - 2):
            if traffic.line[place] == tram:
                return int(traffic.line[place + 2])
    return tram


@compiled
def ask_one(
    day: Given, traffic: Traffic, told: Traffic, tram: int, stop: int, slot: int, now_s: int, rng: np.random.Generator
) -> None:
    """Let a station ask a tram in a slot; what comes back goes to the centre, as told of the way that is set."""
    body = traffic.trams[tram]
    at_ms = slot_begins_ms(SLOT, slot) + 50
    sound = not is_lost(day, tram, stop, now_s, rng)
    heard = Heard(slot, body[H_KNOWN] == 1, body[H_AGE], body[H_ANSWERED] == 1)
    heard = age_heard(note_answer(SLOT, heard, Answer(sound, True, at_ms, 0)), 7_000)
    traffic.row[tally.FRAMES] += 1
    if sound:
        made_ms = 1_000 * now_s
        shown = day.wrong_destination > 0 and tram == day.where.destination_tram
        leaves_at = day.wrong_destination if shown else body[LEAVES]
        due_ms = made_ms + at_ms + 1_500 + int(rng.random() * 2_000) + slower_ms(day, now_s)
        message = (body[U_STOP], body[U_LEFT], body[U_STANDS], leaves_at, made_ms, tram)
        number = number_told(day, traffic, tram, now_s)
        send(told.reports[number], told.due_ms[0], number, due_ms, message)
        is_beyond = mark(body[U_STOP], body[U_LEFT] == 1) > true_mark(day, traffic.trams[number])
        traffic.row[tally.REPORT_BROKEN] += is_beyond and body[U_ASTRAY] == 0
        if rng.random() < day.repeats:
            again_ms = due_ms + int(1_000 * LATEST_S * rng.random())
            send(told.reports[number], told.due_ms[0], number, again_ms, message)
    ended = note_cycle(heard)
    traffic.row[tally.UNHEARD] += body[DWELL_S] != FREE and not is_heard(ended)
    body[H_KNOWN], body[H_AGE], body[H_ANSWERED] = ended.is_known, ended.age_ms, ended.in_this_cycle


@compiled
def true_mark(day: Given, body: Any) -> int:
    """The farthest mark that a tram has truly reached."""
    stop = 0
    last = len(day.stops_mm) - 1
    while stop < last and body[PLACE] >= day.stops_mm[stop + 1] - AT_STOP_MM - BOUND_MM:
        stop += 1
    return 2 * stop + (1 if body[PLACE] > day.stops_mm[stop] + AT_STOP_MM - BOUND_MM else 0)
