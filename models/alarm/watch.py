"""One worker's day, second by second: what the handset is told, what it sounds, and the truth held against it.

The handset is the kernel's own, compiled: every message goes through its functions, every second gives its tone.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from kernel.alarm.distance import Direction
from kernel.alarm.tone import NO_FIGURE_MM, Tone, switched_on
from models.alarm.columns import NUMBER
from models.alarm.compiled import MADE
from models.alarm.coupling import couple_and_part, wait_to_part
from models.alarm.draws import SECONDS
from models.alarm.faults import KIND
from models.alarm.figures import BRANCH_MM, THERE_MM, break_mm, falls, figure_mm, junction_mm, place_mm
from models.alarm.gps import (
    BACKWARDS,
    TRAIN_M,
    TRAIN_MOST_M,
    VALID_M_S,
    WORKER_M,
    WORKER_MOST_M,
    in_tunnel,
    is_frozen,
    sees,
    stretch_mm,
    told_mm,
    wanders,
)
from models.alarm.line import BOUNDS, REGISTER, SHUNTER, TRAINS
from models.alarm.moving import COMES_AFTER_S, at_the_beginning, move, noise, switch_on
from models.alarm.network import FIX, LATEST_S, LISTED, SHOWN, SOON_S, is_late, send
from models.alarm.routes import is_of_the_branch
from models.alarm.serving import at_first, change_numbers, confirmed_empty, entries_that_come, serve
from models.alarm.truth import hold
from models.alarm.windows import is_of, is_on
from models.compiled import compiled, packed

ALARM_TONE, REGISTERED = MADE.tone.tone, packed(REGISTER)
NOTHING = packed(switched_on())
"""A handset that was just switched on."""
DOWN, UP, UNKNOWN = (packed(direction) for direction in (Direction.DOWN, Direction.UP, Direction.UNKNOWN))
FAULTY = packed(Tone.FAULT)
RING = 16
"""So many seconds of what was told are kept; no message arrives later."""
older, begun, has_whole_list = MADE.tone.older, MADE.tone.switched_on, MADE.tone.has_whole_list
summary, note_summary, note_entry = MADE.train_list.summary, MADE.train_list.note_summary, MADE.train_list.note_entry
note_fix, note_display = MADE.tone.note_fix, MADE.tone.note_display
note_worker, note_battery = MADE.tone.note_worker, MADE.tone.note_battery
TrainFix, WorkerFix, Display = MADE.tone.TrainFix, MADE.tone.WorkerFix, MADE.tone.Display
Summary = MADE.train_list.Summary
older_train, fix_of_the_unit = MADE.distance.older_train, MADE.distance.fix_of_the_unit
CLOCK, OWN_DRIFT, OWN_OUT = (KIND[name] for name in ("clock", "own_drift", "own_gps_out"))
TRAIN_SILENT, HANDSET_SILENT, DISPLAY_OUT = (KIND[name] for name in ("train_silent", "handset_silent", "display_out"))
ILL, BATTERY, RESTARTS = KIND["servers_ill"], KIND["battery"], KIND["handset_restarts"]
SERVER_RESTARTS = KIND["server_restarts"]
MESSAGES, JUMPED, TURNED = (NUMBER[name] for name in ("messages", "jumped", "turned"))
AGE_BROKEN, DISPLAY_BROKEN = NUMBER["age_broken"], NUMBER["display_broken"]
SPEED_MM_S, ERROR_MM, TURNING_MS = BOUNDS.train_mm_s, BOUNDS.train_error_mm, BOUNDS.turning_ms
SHOWN_OFF_MM = REGISTER.display_error_mm


class Trace(NamedTuple):
    """What is written down of a day, if it is asked for; arrays without rows where it is not.

    ``seconds``: tone, the worker's place in mm, the least distance in mm to a train that has not departed, its number.
    ``places``: every train's place in m, NaN while it is not on the line.
    ``own``: from ``first_s`` on, the handset's own place in mm and that fix's age, the list's age, servers, battery and
    whether the list is whole.
    ``told``: from ``first_s`` on, for each number known 1, then the last fix that fitted, place, age, direction, runs;
    the display, from, to, age; whether its fix jumped; and the newest one, as the other.
    """

    seconds: Any
    places: Any
    first_s: int
    own: Any
    told: Any


def trace(places: bool = False, first_s: int = 0, told_s: int = 0) -> Trace:
    """Make room for a trace; ``told_s``: for so many seconds what the handset was told."""
    return Trace(
        np.zeros((SECONDS, 4), np.int64),
        np.full((SECONDS if places else 0, TRAINS), np.nan),
        first_s,
        np.zeros((told_s, 6), np.int64),
        np.zeros((told_s, 2 * TRAINS, 13), np.int64),
    )


@compiled
def write_down(trains: Any, handset: Any, second: int, kept: Trace) -> None:
    """Write down a second, as far as it is asked for."""
    if kept.places.shape[0] > 0:
        for train in range(TRAINS):
            if trains.came_s[train] <= second < trains.left_s[train]:
                kept.places[second, train] = trains.place_m[train]
    row = second - kept.first_s
    if not 0 <= row < kept.own.shape[0]:
        return
    worker = handset.worker
    kept.own[row, 0], kept.own[row, 1], kept.own[row, 2] = worker.place_mm, worker.age_ms, handset.server_age_ms
    kept.own[row, 3], kept.own[row, 4] = handset.servers_well, handset.battery_well
    kept.own[row, 5] = has_whole_list(handset.listing)
    for train, known in handset.trains:
        fix, shown, told = known.fix, known.display, kept.told[row, train]
        told[0], told[1], told[2], told[3], told[4] = 1, fix.place_mm, fix.age_ms, fix.direction, fix.is_running
        told[5], told[6], told[7] = shown.from_mm, shown.to_mm, shown.age_ms
        newest = known.newest
        told[8], told[9], told[10] = known.jumped, newest.place_mm, newest.age_ms
        told[11], told[12] = newest.direction, newest.is_running


class Sent(NamedTuple):
    """What was so at each of the last seconds, a row for each train.

    ``age_ms``: how old its unit knew the place to be.
    ``number``: that it ran under.
    ``life_ms``, ``count``, ``whole``: what the server said of its list then; -1 in the place of a life: nothing.
    ``fix_s``, ``shown_s``, ``list_s``: in which second arrives what was sent then, first and again; -1 for never.
    """

    place_m: Any
    told_mm: Any
    age_ms: Any
    has_fix: Any
    direction: Any
    runs: Any
    error_m: Any
    number: Any
    life_ms: Any
    count: Any
    whole: Any
    fix_s: Any
    shown_s: Any
    list_s: Any


@compiled
def nothing_sent() -> Sent:
    """Give what was told before the day began."""
    return Sent(
        np.zeros((TRAINS, RING)),
        np.zeros((TRAINS, RING), np.int64),
        np.zeros((TRAINS, RING), np.int64),
        np.zeros((TRAINS, RING), np.bool_),
        np.zeros((TRAINS, RING), np.int64),
        np.zeros((TRAINS, RING), np.bool_),
        np.zeros(TRAINS),
        np.zeros((TRAINS, RING), np.int64),
        np.full(RING, -1),
        np.zeros(RING, np.int64),
        np.zeros(RING, np.bool_),
        np.full((TRAINS, RING, 2), -1),
        np.full((TRAINS, RING, 2), -1),
        np.full((RING, 2), -1),
    )


@compiled(forceinline=True)
def note_age(sent: Sent, train: int, second: int) -> None:
    """The unit knows how old the place is that its receiver told in this second, with its stamp (A1)."""
    now, before = second % RING, (second - 1) % RING
    direction, runs = sent.direction[train, now], sent.runs[train, now]
    held = older_train(TrainFix(sent.told_mm[train, before], sent.age_ms[train, before], direction, runs), 1_000)
    sent.age_ms[train, now] = fix_of_the_unit(held, TrainFix(sent.told_mm[train, now], 0, direction, runs)).age_ms


@compiled(forceinline=True)
def observe(day: Any, trains: Any, sent: Sent, numbers: Any, second: int) -> None:
    """Every unit takes a fix; it is sent every 2 s, the display every 3 s, the list every 2 s (A1)."""
    now = second % RING
    if second % 2 == 0:
        send(day, second, LISTED, sent.list_s)
    for index in range(trains.switched_on[TRAINS]):
        train = trains.switched_on[index]
        place, speed, heading = trains.place_m[train], trains.speed_m_s[train], trains.heading[train]
        sent.error_m[train] = wanders(sent.error_m[train], day.key, second, train, TRAIN_M, TRAIN_MOST_M)
        sent.place_m[train, now], sent.number[train, now] = place, numbers.now[train]
        sent.told_mm[train, now] = told_mm(day, train, place, sent.error_m[train], second)
        sent.has_fix[train, now] = sees(day, train, place, second)
        heading = -heading if is_of(day, BACKWARDS, train, second) else heading
        heading = -heading if falls(day, sent.told_mm[train, now]) else heading
        if (second + train) % 2 == 0:
            send(day, second, FIX + train, sent.fix_s[train])
        if (second + train) % 3 == 0:
            send(day, second, SHOWN + train, sent.shown_s[train])
        sent.runs[train, now] = speed >= VALID_M_S
        sent.direction[train, now] = (DOWN if heading > 0 else UP) if speed >= VALID_M_S else UNKNOWN
        if is_frozen(day, train, second):
            before = (second - 1) % RING
            sent.told_mm[train, now], sent.has_fix[train, now] = (
                sent.told_mm[train, before],
                sent.has_fix[train, before],
            )
            sent.direction[train, now], sent.runs[train, now] = sent.direction[train, before], sent.runs[train, before]
        note_age(sent, train, second)


@compiled(forceinline=True)
def fix_of(day: Any, sent: Sent, train: int, sent_s: int, second: int) -> Any:
    """Give a fix as it arrives; a wrong clock makes it younger (A1)."""
    at = sent_s % RING
    age_ms = 1_000 * (second - sent_s) + sent.age_ms[train, at]
    if is_of(day, CLOCK, train, sent_s):
        age_ms = max(0, age_ms - 1_000 * abs(day.size[CLOCK]))
    return TrainFix(sent.told_mm[train, at], age_ms, sent.direction[train, at], sent.runs[train, at])


@compiled(forceinline=True)
def shown_of(day: Any, trains: Any, sent: Sent, train: int, sent_s: int, second: int) -> Any:
    """Give a record of the display as it arrives: it follows a train within 2 s (A1).

    The stretch in which a branch leaves reaches on to it, whichever way a train there runs.
    """
    from_mm, to_mm = stretch_of(day, trains, sent, train, sent_s)
    break_at_mm, age_ms = break_mm(day), 1_000 * (second - sent_s)
    joint_mm, of_branch = junction_mm(day), is_of_the_branch(day, train)
    if max(0, from_mm) <= joint_mm < to_mm:
        one_mm, other_mm = BRANCH_MM, figure_mm(day, to_mm, True)
        return Display(from_mm, to_mm, age_ms, min(one_mm, other_mm), max(one_mm, other_mm))
    one_mm, other_mm = figure_mm(day, from_mm, of_branch), figure_mm(day, to_mm, of_branch)
    if max(0, from_mm) <= break_at_mm < to_mm:
        return Display(one_mm, break_at_mm, age_ms, min(THERE_MM, other_mm), max(THERE_MM, other_mm))
    return Display(min(one_mm, other_mm), max(one_mm, other_mm), age_ms, NO_FIGURE_MM, NO_FIGURE_MM)


@compiled(forceinline=True)
def stretch_of(day: Any, trains: Any, sent: Sent, train: int, sent_s: int) -> Any:
    """Give the stretch in which the display has a train."""
    behind_s = noise(day.key, sent_s, 4_000 + train) % 3
    behind_s = max(0, min(behind_s, sent_s - trains.came_s[train] + COMES_AFTER_S))
    return stretch_mm(day, train, sent.place_m[train, (sent_s - behind_s) % RING])


@compiled(forceinline=True)
def take_fix(
    register: Any, day: Any, trains: Any, handset: Any, sent: Sent, train: int, sent_s: int, second: int, out: Any
) -> Any:
    """A fix reaches the handset (A1)."""
    if not sent.has_fix[train, sent_s % RING] or is_of(day, TRAIN_SILENT, train, sent_s):
        return handset
    if is_on(day, SERVER_RESTARTS, sent_s):
        return handset
    fix = fix_of(day, sent, train, sent_s, second)
    out[MESSAGES] += 1
    ran_mm = 1_000 * abs(trains.place_m[train] - sent.place_m[train, sent_s % RING])
    if ran_mm > SPEED_MM_S * fix.age_ms / 1_000 + 1:
        out[AGE_BROKEN] += 1
    name = sent.number[train, sent_s % RING]
    for number, known in handset.trains:
        before = known.fix
        if number == name and before.age_ms <= 60_000:
            way_mm = abs(place_mm(day, before.place_mm) - place_mm(day, fix.place_mm))
            apart_ms = abs(before.age_ms - fix.age_ms)
            if way_mm > SPEED_MM_S * apart_ms // 1_000 + 2 * ERROR_MM:
                out[JUMPED] += 1
            both = before.is_running and fix.is_running
            counts_down = falls(day, before.place_mm) != falls(day, fix.place_mm)
            if both and (before.direction != fix.direction) != counts_down and apart_ms <= TURNING_MS:
                out[TURNED] += 1
    return note_fix(register, handset, name, fix, register.edition)


@compiled(forceinline=True)
def take_display(
    register: Any, day: Any, trains: Any, handset: Any, sent: Sent, train: int, sent_s: int, second: int, out: Any
) -> Any:
    """A record of the display reaches the handset; trains that shunt are not on it (A1, A5)."""
    if train == SHUNTER or is_on(day, DISPLAY_OUT, sent_s) or is_on(day, SERVER_RESTARTS, sent_s):
        return handset
    display = shown_of(day, trains, sent, train, sent_s, second)
    out[MESSAGES] += 1
    at_mm = 1_000 * sent.place_m[train, sent_s % RING]
    from_mm, to_mm = stretch_of(day, trains, sent, train, sent_s)
    if not from_mm - SHOWN_OFF_MM <= at_mm <= to_mm + SHOWN_OFF_MM:
        out[DISPLAY_BROKEN] += 1
    return note_display(register, handset, sent.number[train, sent_s % RING], display, register.edition)


@compiled(forceinline=True)
def has(handset: Any, train: int) -> bool:
    """Tell whether the handset's list has a train."""
    for number, _known in handset.trains:  # noqa: SIM110
        if number == train:
            return True
    return False


@compiled(forceinline=True)
def say(day: Any, sent: Sent, server: Any, second: int) -> None:
    """The server says of its list how it is, unless it restarts (A1)."""
    now, said = second % RING, summary(server)
    sent.life_ms[now] = -1 if is_on(day, SERVER_RESTARTS, second) else said.life_ms
    sent.count[now], sent.whole[now] = said.count, said.is_whole


@compiled(forceinline=True)
def take_entry(
    register: Any, day: Any, trains: Any, handset: Any, sent: Sent, entry: Any, sent_s: int, second: int, out: Any
) -> Any:
    """An entry reaches the handset; what comes onto its list by it comes with its reports (A1, A2)."""
    was_there, train = has(handset, entry.train), entry.train % TRAINS
    handset = note_entry(handset, entry)
    if not was_there and has(handset, entry.train) and sent.number[train, sent_s % RING] == entry.train:
        handset = take_fix(register, day, trains, handset, sent, train, sent_s, second, out)
        handset = take_display(register, day, trains, handset, sent, train, sent_s, second, out)
    return handset


@compiled(forceinline=True)
def take_list(
    register: Any,
    day: Any,
    trains: Any,
    handset: Any,
    sent: Sent,
    server: Any,
    before: Any,
    sent_s: int,
    second: int,
    out: Any,
) -> Any:
    """A list reaches the handset: what the server said of it, and the entries that the handset has not (A1, A2).

    ``before``: the server's life before this one, whose list may come yet.
    """
    at = sent_s % RING
    life_ms = sent.life_ms[at]
    if life_ms < 0:
        return handset
    out[MESSAGES] += 1
    said = Summary(life_ms, sent.count[at], sent.whole[at], 1_000 * (second - sent_s))
    handset = note_summary(handset, said, not is_on(day, ILL, sent_s))
    written = server if server.life_ms == life_ms else before
    if handset.listing.life_ms != life_ms or written.life_ms != life_ms:
        return handset
    taken = handset.listing.taken
    for number in range(taken + 1, entries_that_come(day, sent_s, taken, sent.count[at]) + 1):
        for key, entry in written.entries:
            if key == number:
                handset = take_entry(register, day, trains, handset, sent, entry, sent_s, second, out)
    return handset


@compiled(forceinline=True)
def hear(
    register: Any, day: Any, trains: Any, handset: Any, sent: Sent, server: Any, before: Any, second: int, out: Any
) -> Any:
    """Take everything that arrives in this second, the oldest first (A1)."""
    late = is_late(day, second) or is_late(day, max(0, second - LATEST_S))
    for back in range(min(LATEST_S if late else SOON_S, second), 0, -1):
        sent_s = second - back
        at = sent_s % RING
        if sent.list_s[at, 0] == second or sent.list_s[at, 1] == second:
            handset = take_list(register, day, trains, handset, sent, server, before, sent_s, second, out)
        for index in range(trains.switched_on[TRAINS]):
            train = trains.switched_on[index]
            if sent.fix_s[train, at, 0] == second or sent.fix_s[train, at, 1] == second:
                handset = take_fix(register, day, trains, handset, sent, train, sent_s, second, out)
            if sent.shown_s[train, at, 0] == second or sent.shown_s[train, at, 1] == second:
                handset = take_display(register, day, trains, handset, sent, train, sent_s, second, out)
    return handset


@compiled(forceinline=True)
def own_fix(day: Any, handset: Any, worker_m: float, error_m: float, second: int) -> Any:
    """The handset takes its own fix, where it can, and looks at its battery (A1, A8)."""
    handset = note_battery(handset, not is_on(day, BATTERY, second))
    if in_tunnel(worker_m) or is_on(day, OWN_OUT, second):
        return handset
    off_m = error_m + (day.size[OWN_DRIFT] if is_on(day, OWN_DRIFT, second) else 0)
    told_at_mm = int(np.floor(1_000 * (worker_m + off_m) + 0.5))
    return note_worker(handset, WorkerFix(figure_mm(day, told_at_mm, day.on_branch), 0))


@compiled(forceinline=True)
def walked(day: Any, second: int) -> float:
    """Give where the worker is: he walks to and fro."""
    if day.walk_m == 0.0:
        return float(day.worker_m)
    way = (day.walk_m_s * second) % (4.0 * day.walk_m)
    return float(day.worker_m - day.walk_m + (way if way <= 2.0 * day.walk_m else 4.0 * day.walk_m - way))


@compiled
def watch(day: Any, written: Any, register: Any, sounds: Any, handset: Any, out: Any, kept: Trace) -> None:
    """Let a day pass.

    ``written``: the line's register, by which the truth is held; ``register``: the handset's, the same unless a fault
    is planted there.  ``sounds``: the function that gives the tone.  ``out``: the row of the day.
    ``kept``: what is written down.
    """
    trains = at_the_beginning(day)
    wait_to_part(day, trains)
    sent = nothing_sent()
    error_m, before, sides = 0.0, FAULTY, np.zeros(TRAINS)
    numbers, server = at_first(), confirmed_empty()
    former = server
    for second in range(SECONDS):
        switch_on(trains, second)
        move(day, trains, second)
        couple_and_part(day, trains, second)
        worker_m = walked(day, second)
        change_numbers(day, trains, numbers, second)
        observe(day, trains, sent, numbers, second)
        served = serve(day, trains, sent, numbers, server, second, out)
        if served.life_ms != server.life_ms:
            former = server
        server = served
        say(day, sent, server, second)
        handset = begun() if is_on(day, RESTARTS, second) else older(handset, 1_000)
        if not is_on(day, HANDSET_SILENT, second):
            handset = hear(written, day, trains, handset, sent, server, former, second, out)
        error_m = wanders(error_m, day.key, second, TRAINS + day.handset, WORKER_M, WORKER_MOST_M)
        handset = own_fix(day, handset, worker_m, error_m, second)
        heard = sounds(register, handset)
        hold(written, day, trains, numbers.now, sides, handset, heard, before, worker_m, second, out, kept.seconds)
        before = heard
        write_down(trains, handset, second, kept)
