"""A day at a crossing, second by second: trains, rangings, terminals, the compiled machine, and the truth beside it.

In each cycle trains' start points are struck and terminals heard, rangings come, the crossing decides; then trains run,
arms move, and what was claimed of arrivals, openings and silence is held against the truth.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from models.compiled import compiled, packed
from models.crossing.ceilings import answer_ask, forget_promise, promises, take_promise
from models.crossing.columns import ASSUMPTIONS, CLAIMS, MONITORS, NUMBER
from models.crossing.end_points import has_left
from models.crossing.faults import KIND
from models.crossing.judging import judge_decision, judge_end, judge_trains, old_crossing
from models.crossing.made import MADE, NO_DUES, OPEN, STARTS
from models.crossing.motion import (
    COMES_UM,
    GOES_M,
    TURNS_BACK,
    allowed,
    keeps,
    move,
    signal_m,
    turns_beyond,
)
from models.crossing.radio import is_on, likely, ranging
from models.crossing.records import AWAY, SET, UNDER_WAY, Moment, bounds_of, line_of, road_of
from models.crossing.sites import Trial
from models.crossing.staff import UNLISTED, account, forget, has_no_power, let_go, prove_rear, somebody_comes_s
from models.crossing.start_points import hear, is_silent, note_read, strikes
from models.crossing.starting import SIGNALS, talk
from models.crossing.traffic import NEVER, SECONDS, TRACKS, Day, Records

counts, taken, aged_train = MADE.arrival.counts, MADE.arrival.taken, MADE.arrival.aged
follow, contradicts, decide = MADE.arrival.follow, MADE.arrival.contradicts, MADE.crossing.decide
begins_contact, has_turned_back = MADE.arrival.begins_contact, MADE.arrival.has_turned_back
nothing_known = MADE.arrival.nothing_known
note_contact, note_heard, note_empty = MADE.crossing.note_contact, MADE.crossing.note_heard, MADE.crossing.note_empty
look_of, note_missed, may_start = MADE.crossing.look_of, MADE.crossing.note_missed, MADE.crossing.may_start
due_of, aged, are_to_be_down = MADE.crossing.due, MADE.crossing.aged, MADE.crossing.arms_are_to_be_down
Followed, ArrivalBounds = MADE.arrival.Followed, MADE.arrival.ArrivalBounds

GAIN_BROKEN, ARMS_BROKEN = NUMBER["gain_broken"], NUMBER["arms_broken"]
LOST, CONTRADICTED, RANGINGS = (NUMBER[name] for name in ("lost", "contradicted", "rangings"))
CLOSED, TRAINS, ARRIVALS, SECONDS_COUNT = (NUMBER[name] for name in ("closed_s", "trains", "arrivals", "seconds"))
JUDGED = np.array([NUMBER[name] for name in (*CLAIMS, *ASSUMPTIONS, *MONITORS)])
"""What is counted at the second road as at the first."""
ARRIVALS_BESIDE, CLOSED_BESIDE = NUMBER["arrivals_beside"], NUMBER["closed_beside_s"]
SLOW_ARMS, CLOSE_ROADS = KIND["slow_arms"], KIND["close_roads"]
CLEAR_UM = 600_000_000
"""A train comes onto the line when the one before is so far."""
DRAIN_S = 1_200
"""After the last hour the trains under way run out."""


class Machines(NamedTuple):
    """The machines' own ways to decide, and their settings; tests plant faults there."""

    decides: Any = decide
    settings: Any = SET
    reads: Any = note_read
    hears: Any = has_left
    turns: Any = has_turned_back
    notes: Any = note_heard
    misses: Any = note_missed
    lets: Any = may_start
    signals: Any = packed(SIGNALS)


MACHINES = Machines()


def watched(trial: Trial, day: Day, out: Any, machines: Machines = MACHINES) -> Records:
    """Watch a day; counts go into ``out``."""
    line = line_of(trial)
    first = road_of(0, day, line, out)
    window = day.faults[CLOSE_ROADS]
    if window["begin_s"] == NEVER:
        live(day, day, first, first, 0, line, machines, packed(OPEN), STARTS, NO_DUES)
        return first.run
    trains = day.trains.copy()
    trains["promises"] = 0
    beside = np.zeros_like(out)
    second = road_of(1, day, line, beside)
    apart_um = round(1e6 * window["size"])
    there = day._replace(trains=trains)
    live(day, there, first, second, apart_um, line, machines, packed(OPEN), STARTS, NO_DUES)
    out[JUDGED] += beside[JUDGED]
    out[ARRIVALS_BESIDE] += beside[ARRIVALS]
    out[CLOSED_BESIDE] += beside[CLOSED]
    return first.run


# ---- trains under way


@compiled
def enter(day: Any, run: Any, line: Any, window: Any, ends: Any, track: int, now: int) -> None:
    """Let the next train onto its track, if it is time and the one before is far enough."""
    train = window[track, 1]
    if train >= ends[track] or day.trains[train].at_s > now:
        return
    speed_m_s = line.limit_m_s[day.trains[train].local] * day.trains[train].share
    if train > window[track, 0]:
        ahead = train - 1
        rear_um = run[ahead].way_um + line.length_um[day.trains[ahead].local]
        if run[ahead].state == UNDER_WAY:
            comes_back = day.trains[ahead].trick == TURNS_BACK or turns_beyond(day, ahead)
            if rear_um > COMES_UM - CLEAR_UM or comes_back:
                return
            speed_m_s = min(speed_m_s, allowed(COMES_UM / 1e6, signal_m(line.block_m, rear_um)))
    run[train].state = UNDER_WAY
    run[train].pace_um = round(1e6 * speed_m_s)
    run[train].last_um = run[train].way_um + run[train].pace_um
    run[train].before_um = run[train].last_um + run[train].pace_um
    window[track, 1] += 1


@compiled
def is_over(run: Any, train: int) -> Any:
    """Tell whether nobody has to see to a train any more."""
    return run[train].cleared == 1 and run[train].late_s == NEVER


@compiled
def run_trains(day: Any, run: Any, there: Any, line: Any, window: Any, track: int, out: Any) -> None:
    """Let all trains of a track run for a second; each sees the one ahead.

    ``there``: what becomes of them at the other road, if there is one.
    """
    ahead, goes_um = NEVER, round(-1e6 * (line.station_m + GOES_M))
    for train in range(window[track, 0], window[track, 1]):
        if run[train].state != UNDER_WAY:
            continue
        way_um, pace_um = run[train].way_um, run[train].pace_um
        move(day, run, line, train, ahead)
        run[train].before_um, run[train].last_um = run[train].last_um, way_um
        gained_um, now_um = run[train].pace_um - pace_um, run[train].pace_um
        if (
            gained_um > line.gain_um
            or now_um > line.line_um[day.trains[train].local]
            or way_um - run[train].way_um > max(pace_um, now_um)
            or (keeps(run, train) and now_um > 1_000 * run[train].held_mm_s)
        ):
            out[GAIN_BROKEN] += 1
        cleared = is_over(run, train) and is_over(there, train)
        leaves_um = -COMES_UM if run[train].is_back == 1 else goes_um
        if cleared and (run[train].way_um < leaves_um or run[train].way_um > COMES_UM):
            run[train].state = AWAY
        ahead = train
    while window[track, 0] < window[track, 1] and run[window[track, 0]].state == AWAY:
        window[track, 0] += 1


@compiled
def see_from_there(run: Any, there: Any, window: Any, track: int, apart_um: int) -> None:
    """Note where trains are as seen from the second road, which is so far beyond the first one on the first track."""
    shift_um = apart_um if track == 0 else -apart_um
    for train in range(window[track, 0], window[track, 1]):
        there[train].state, there[train].pace_um = run[train].state, run[train].pace_um
        there[train].way_um = run[train].way_um + shift_um
        there[train].before_um, there[train].last_um = run[train].before_um + shift_um, run[train].last_um + shift_um


# ---- what the crossing is told


@compiled
def followed_of(run: Any, train: int) -> Any:
    """Give what is followed of a train."""
    held = run[train]
    return Followed(
        held.near_um, held.short_um, held.ceiling_um, held.age_cycles, held.followed_way_mm, held.followed_mm_s,
        held.warns == 1,
    )  # fmt: skip


@compiled
def start_mm(line: Any, kind: Any) -> Any:
    """Give how far before the road a kind's start point lies, rounded to the safe side."""
    return -(-line.start_um[kind] // 1_000)


@compiled
def follow_train(
    day: Any, run: Any, line: Any, train: int, now: int, crossing: Any, dues: Any, machines: Any, out: Any
) -> Any:
    """Take a train's ranging, reckon, and answer when it is due; or let it go (X1, X2, X4)."""
    told = ranging(day, run, line, train, now, out)
    bounds = bounds_of(line, day.trains[train].local)
    valid = counts(bounds, told)
    out[RANGINGS] += valid
    if run[train].contact == 0:
        if not begins_contact(bounds, told) or told.way_mm <= 0:
            return crossing
        run[train].contact = 1
        crossing = note_contact(crossing, train)
        forget_promise(run, line, train, day.trains[train].local)
        known = taken(bounds, take_promise(bounds, run, train, nothing_known(bounds), told), told)
    else:
        held = take_promise(bounds, run, train, followed_of(run, train), told)
        out[CONTRADICTED] += run[train].arrived_s < 0 and contradicts(bounds, held, told)
        known = follow(bounds, held, told)
        if machines.turns(bounds, known, told, start_mm(line, day.trains[train].local)):
            return let_go(day, run, line, train, now, crossing, out)
    if known.age_cycles > bounds.silence_cycles and run[train].lost == 0:
        run[train].lost = 1
        out[LOST] += run[train].arrived_s < 0
    if run[train].likely_s < 0 and likely(day, run, line, train, told):
        run[train].likely_s = now
    known = answer_ask(bounds, run, train, known)
    dues.append((train, due_of(bounds, known, machines.settings.reopening_cycles)))
    later = aged_train(bounds, known)
    run[train].near_um, run[train].short_um, run[train].ceiling_um = later.way_um, later.short_um, later.ceiling_um
    run[train].followed_way_mm, run[train].followed_mm_s = later.told_way_mm, later.told_speed_mm_s
    run[train].age_cycles, run[train].warns = later.age_cycles, int(known.warns)
    return crossing


@compiled
def tell(
    day: Any,
    road: Any,
    other: Any,
    line: Any,
    window: Any,
    track: int,
    now: int,
    crossing: Any,
    dues: Any,
    machines: Any,
) -> Any:
    """Tell the crossing all of a track, once its start points have been struck (X1 to X4)."""
    run, out = road.run, road.out
    crossing = hear(day, road, window, track, now, crossing, machines.notes, machines.misses)
    for train in range(window[track, 0], window[track, 1]):
        if run[train].state != UNDER_WAY:
            continue
        crossing = prove_rear(day, road, other, line, train, track, now, crossing, machines.hears)
        crossing = talk(day, road, line, train, now, crossing, machines)
        in_reach = run[train].way_um <= day.trains[train].contact_um
        if run[train].gone == 0 and day.trains[train].radio == 1 and in_reach:
            if day.trains[train].promises == 1:
                promises(day, run, line, train, now, out)
            crossing = follow_train(day, run, line, train, now, crossing, dues, machines, out)
    return crossing


# ---- a cycle, and a day


@compiled
def end_cycle(day: Any, moment: Any, now: int, out: Any) -> Any:
    """Let a cycle pass for arms and terminals (X5)."""
    slow = int(day.faults[SLOW_ARMS].size) if day.on[SLOW_ARMS] else 0
    lowered = moment.lowered + 1 if are_to_be_down(SET, moment.crossing) else 0
    are_down = lowered >= day.arms_cycles + slow
    out[ARMS_BROKEN] += lowered >= SET.lowering_cycles and not are_down
    out[CLOSED] += moment.crossing.warns
    down = moment.down + 1 if are_down else 0
    return Moment(
        aged(moment.crossing), moment.warned + 1 if moment.crossing.warns else 0, lowered, down, moment.opened + 1,
        moment.arrivals, moment.held, moment.old_on, moment.old_off_s,
    )  # fmt: skip


@compiled
def decide_at(
    day: Any,
    road: Any,
    other: Any,
    line: Any,
    window: Any,
    moment: Any,
    now: int,
    machines: Any,
    start: Any,
    dues: Any,
) -> Any:
    """Let a cycle of a road's crossing pass: what it is told, what it decides, and its arms."""
    crossing, before = moment.crossing, moment.crossing
    dues.clear()
    for track in range(TRACKS):
        strikes(day, road.run, line, window, road.points, track, now, machines.reads, road.out)
        crossing = tell(day, road, other, line, window, track, now, crossing, dues, machines)
        road.unheard[track] = road.unheard[track] + 1 if is_silent(day, track, now) else 0
    if has_no_power(day):
        forget(day, road.run, window, now, road.out)
        dues.clear()
        crossing, road.unseen[:] = start, somebody_comes_s(day)
    crossing = account(day, road.run, window, road.unseen, now, crossing, road.out)
    crossing = machines.decides(machines.settings, crossing, dues)
    told = Moment(
        crossing, moment.warned, moment.lowered, moment.down, moment.opened, moment.arrivals, moment.held,
        moment.old_on, moment.old_off_s,
    )  # fmt: skip
    judged = judge_decision(road.run, before, told, window, road.unheard, road.unseen, now, road.out)
    return end_cycle(day, judged, now, road.out)


@compiled
def judge_at(day: Any, road: Any, line: Any, window: Any, moment: Any, now: int) -> Any:
    """Hold what has come to a road in a cycle against what is claimed of it."""
    arrivals = 0
    for track in range(TRACKS):
        arrivals += judge_trains(day, road.run, line, window, track, now, moment, road.out)
    old_on, off_s = old_crossing(road.run, window, moment, road.out)
    road.out[ARRIVALS] += arrivals
    return Moment(
        moment.crossing, moment.warned, moment.lowered, moment.down, moment.opened, moment.arrivals + arrivals,
        moment.held, old_on, off_s,
    )  # fmt: skip


@compiled
def windows_of(day: Any) -> Any:
    """Give for each track which trains are under way, none yet, and where its trains end."""
    window, ends = np.zeros((TRACKS, 2), np.int64), np.zeros(TRACKS, np.int64)
    for train in range(len(day.trains)):
        ends[day.trains[train].track :] += 1
    for track in range(TRACKS):
        window[track, :] = ends[track - 1] if track else 0
    return window, ends


@compiled
def left_out(day: Any, now: int) -> Any:
    """Give which of its starts the crossing has: with the settings of that day's beginning, or with new ones."""
    window = day.faults[UNLISTED]
    return 1 + window.track_of if 0 <= window.begin_s <= now else 0


@compiled
def live(
    day: Any,
    there: Any,
    first: Any,
    second: Any,
    apart_um: int,
    line: Any,
    machines: Any,
    crossing: Any,
    starts: Any,
    dues: Any,
) -> None:
    """Let a day pass; it begins with both tracks accounted for.

    ``second``: the road close to the first, or that one again if there is none; ``there``: the day as seen from it.
    """
    window, ends = windows_of(day)
    for track in range(TRACKS):
        crossing = note_heard(crossing, track, 0)
        crossing = note_empty(crossing, track, look_of(crossing, track))
    first.out[TRAINS] += len(day.trains)
    first.out[SECONDS_COUNT] += SECONDS
    moment = beside = Moment(crossing, 0, 0, 0, 10**6, 0, False, False, NEVER)
    for now in range(SECONDS + DRAIN_S):
        for fault in range(len(day.faults)):
            day.on[fault] = is_on(day, fault, now)
        for track in range(TRACKS):
            enter(day, first.run, line, window, ends, track, now)
            if apart_um > 0:
                see_from_there(first.run, second.run, window, track, apart_um)
        start = starts[left_out(day, now)]
        moment = decide_at(day, first, second, line, window, moment, now, machines, start, dues)
        if apart_um > 0:
            beside = decide_at(there, second, first, line, window, beside, now, machines, start, dues)
        begun = window.copy()
        for track in range(TRACKS):
            run_trains(day, first.run, second.run, line, window, track, first.out)
        moment = judge_at(day, first, line, window, moment, now)
        if apart_um > 0:
            for track in range(TRACKS):
                see_from_there(first.run, second.run, begun, track, apart_um)
            beside = judge_at(there, second, line, window, beside, now)
    judge_end(first.run, moment, first.out)
    if apart_um > 0:
        judge_end(second.run, beside, second.out)
