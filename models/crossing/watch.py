"""A day at a crossing, second by second: trains, rangings, terminals, the compiled machine, and the truth beside it.

In each cycle trains' start points are struck and terminals heard, rangings come, the crossing decides; then trains run,
arms move, and what was claimed of arrivals, openings and silence is held against the truth.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from models.compiled import compiled, packed
from models.crossing.ceilings import answer_ask, forget_promise, judge_ceiling, promises, take_promise
from models.crossing.columns import NUMBER
from models.crossing.faults import KIND
from models.crossing.made import MADE, NO_DUES, OPEN, START, UNKNOWN
from models.crossing.motion import (
    COMES_UM,
    GOES_M,
    TURNS_BACK,
    allowed,
    keeps,
    move,
    signal_m,
)
from models.crossing.radio import KEPT, is_on, likely, ranging
from models.crossing.sites import SETTINGS, Trial
from models.crossing.staff import OTHER_NAME, account, forget, has_no_power, prove_rear, stays_s
from models.crossing.start_points import hear, note_read, points_of, strikes
from models.crossing.traffic import NEVER, SECONDS, TRACKS, Day, Records

SET = packed(SETTINGS)
counts, taken, aged_train = MADE.arrival.counts, MADE.arrival.taken, MADE.arrival.aged
follow, contradicts, decide = MADE.arrival.follow, MADE.arrival.contradicts, MADE.crossing.decide
note_contact, note_heard, note_empty = MADE.crossing.note_contact, MADE.crossing.note_heard, MADE.crossing.note_empty
due_of, aged, are_to_be_down = MADE.crossing.due, MADE.crossing.aged, MADE.crossing.arms_are_to_be_down
Followed, ArrivalBounds = MADE.arrival.Followed, MADE.arrival.ArrivalBounds

LATE_WARNING, SHORT_CLOSURE, LIFTED_BETWEEN, OPENED_BEFORE_REAR, UNWARNED_SILENCE, OPENED_UNSEEN = (
    NUMBER[name]
    for name in (
        "late_warning", "short_closure", "lifted_between", "opened_before_rear", "unwarned_silence", "opened_unseen"
    )
)  # fmt: skip
GAIN_BROKEN, ARMS_BROKEN, START_BROKEN = (NUMBER[name] for name in ("gain_broken", "arms_broken", "start_broken"))
LOST, CONTRADICTED, SILENCES, CONVENTIONAL = (
    NUMBER[name] for name in ("lost", "contradicted", "silences", "conventional")
)
UNSEEN_CLOSED = NUMBER["unseen_s"]
CLOSED, OLD_CLOSED, BEYOND, OLD_BEYOND, NEEDLESS, HELD, OLD_SHORT = (
    NUMBER[name]
    for name in ("closed_s", "old_closed_s", "beyond_s", "old_beyond_s", "needless", "held", "old_short_openings")
)
LIKELY_LATE = NUMBER["likely_late"]
TRAINS, ARRIVALS, IN_CONTACT, WARNINGS, RANGINGS, SECONDS_COUNT = (
    NUMBER[name] for name in ("trains", "arrivals", "in_contact", "warnings", "rangings", "seconds")
)
TERMINAL, SLOW_ARMS = KIND["terminal"], KIND["slow_arms"]
LEAST_DOWN_S = 15
CLEAR_UM = 600_000_000
"""A train comes onto the line when the one before is so far."""
DRAIN_S = 1_200
"""After the last hour the trains under way run out."""
OWN = ("own_way_error_m", "own_speed_error_m_s", "ceiling_over_m_s")
WAITING, UNDER_WAY, AWAY = 0, 1, 2


LINE = np.dtype(
    [
        *((name, np.float64, (2,)) for name in ("limit_m_s",)),
        *((name, np.int64, (2,)) for name in ("length_um", "stops", "line_um", "start_um", "old_um")),
        *((name, np.int64) for name in ("gain_um", "silence_cycles", "way_spread_mm", "speed_spread_mm_s")),
        *((name, np.int64) for name in ("warning_cycles", "start_cycles")),
        *((name, np.float64) for name in ("station_m", "block_m", "way_sigma_m", "multipath_m", "speed_sigma_m_s")),
        *((name, np.float64) for name in ("way_error_m", "speed_error_m_s", "loss", "likely_m_s2")),
        *((name, np.float64) for name in OWN),
    ]
)
"""A trial's numbers as compiled code takes them; pairs are of express and local."""
RUN = np.dtype(
    [
        *((name, np.int64) for name in ("state", "way_um", "before_um", "last_um", "pace_um", "stage")),
        *((name, np.int64) for name in ("dwelt_s", "stood_s", "contact", "warns", "lost", "gone", "was_known", "name")),
        *((name, np.int64) for name in ("near_um", "short_um", "ceiling_um", "age_cycles")),
        *((name, np.int64) for name in ("asked_s", "likely_s", "old_s", "struck_s", "arrived_s", "out_s")),
        *((name, np.int64, (KEPT,)) for name in ("told_way_mm", "told_speed_mm_s", "told_s")),
        *((name, np.int64, (KEPT,)) for name in ("told_number", "told_ceiling_mm_s", "told_asked_mm_s")),
        *((name, np.int64) for name in ("held_number", "held_mm_s", "held_asked_mm_s", "asks", "hurries")),
        *((name, np.int64) for name in ("noted_number", "noted_mm_s", "noted_asked_mm_s", "heard_asking")),
        *((name, np.int64) for name in ("sent_number", "last_number", "brought_place")),
        *((name, np.int64) for name in ("read_s", "has_read", "told_late_s")),
        *((name, np.int64) for name in ("followed_way_mm", "followed_mm_s")),
        ("bias", np.float64),
    ]
)
"""What becomes of a train; times are -1 until then.

``near_um`` to ``followed_mm_s``, ``warns``: what is followed of it.  ``asked_s``: when the warning was first
asked for.  ``old_s``: when the old crossing's start point was struck; ``struck_s``: ours.
``name``: by which the strike is told, -1 if nothing is to be told.
``read_s``: when its head passed the start point's tag; ``has_read``: and read it; ``told_late_s``: it tells so late.
``likely_s``: when the paper's reckoning would have warned.
``arrived_s``, ``out_s``: head at the crossing; rear past it, or turned back.
"""


class Moment(NamedTuple):
    """The crossing's state beside the machine: arms, openings, and the old crossing."""

    crossing: Any
    warned: int
    lowered: int
    down: int
    opened: int
    arrivals: int
    held: bool
    old_on: bool
    old_off_s: int


def line_of(trial: Trial) -> Any:
    """Give a trial's numbers."""
    line = np.zeros(1, LINE)[0]
    kinds = (trial.express, trial.local)
    line["limit_m_s"] = [kind.limit_m_s for kind in kinds]
    line["length_um"] = [kind.cars * 20_000_000 for kind in kinds]
    line["stops"] = [kind.stops for kind in kinds]
    line["line_um"] = [trial.bounds(kind).line_um for kind in kinds]
    line["start_um"] = [trial.start_um(kind) for kind in kinds]
    line["old_um"] = [trial.conventional_um(kind) for kind in kinds]
    for name in ("gain_um", "silence_cycles", "way_spread_mm", "speed_spread_mm_s"):
        line[name] = getattr(trial.bounds(kinds[0]), name)
    for name in ("warning_cycles", "start_cycles"):
        line[name] = getattr(trial.settings, name)
    for name in ("station_m", "block_m", "way_sigma_m", "multipath_m", "speed_sigma_m_s"):
        line[name] = getattr(trial, name)
    for name in ("way_error_m", "speed_error_m_s", "loss", "likely_m_s2", *OWN):
        line[name] = getattr(trial, name)
    return line


@compiled
def bounds_of(line: Any, kind: Any) -> Any:
    """Give what the kernel holds a kind of train to."""
    return ArrivalBounds(
        line.line_um[kind],
        line.gain_um,
        SET.cycle_ms,
        line.warning_cycles,
        line.silence_cycles,
        line.way_spread_mm,
        line.speed_spread_mm_s,
    )


def run_of(day: Day, line: Any) -> Records:
    """Give a day's trains before anything happens."""
    run = np.zeros(len(day.trains), RUN)
    for name in ("asked_s", "likely_s", "old_s", "struck_s", "arrived_s", "out_s", "name", "told_s", "read_s"):
        run[name] = NEVER
    for name in ("way_um", "before_um", "last_um"):
        run[name] = COMES_UM
    for name in ("sent_number", "last_number"):
        run[name] = NEVER
    for name in ("held_mm_s", "held_asked_mm_s", "noted_mm_s", "noted_asked_mm_s"):
        run[name] = -(-line["line_um"][day.trains["local"]] // SETTINGS.cycle_ms)
    return run


def watched(
    trial: Trial, day: Day, out: Any, decides: Any = decide, settings: Any = SET, reads: Any = note_read
) -> Records:
    """Watch a day; counts go into ``out``.

    ``decides``, ``settings``, ``reads``: the machines' own, where tests plant faults.
    """
    line = line_of(trial)
    run = run_of(day, line)
    live(day, run, line, points_of(), decides, settings, reads, packed(OPEN), packed(START), NO_DUES, out)
    return run


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
            if rear_um > COMES_UM - CLEAR_UM or day.trains[ahead].trick == TURNS_BACK:
                return
            speed_m_s = min(speed_m_s, allowed(COMES_UM / 1e6, signal_m(line.block_m, rear_um)))
    run[train].state = UNDER_WAY
    run[train].pace_um = round(1e6 * speed_m_s)
    window[track, 1] += 1


@compiled
def run_trains(day: Any, run: Any, line: Any, window: Any, track: int, out: Any) -> None:
    """Let all trains of a track run for a second; each sees the one ahead."""
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
        if run[train].gone == 1 and (run[train].way_um < goes_um or run[train].way_um > COMES_UM):
            run[train].state = AWAY
        ahead = train
    while window[track, 0] < window[track, 1] and run[window[track, 0]].state == AWAY:
        window[track, 0] += 1


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
def follow_train(
    day: Any, run: Any, line: Any, train: int, now: int, crossing: Any, dues: Any, settings: Any, out: Any
) -> Any:
    """Take a train's ranging, reckon, and answer when it is due (X1, X2)."""
    told = ranging(day, run, line, train, now, out)
    bounds = bounds_of(line, day.trains[train].local)
    valid = counts(bounds, told)
    out[RANGINGS] += valid
    if run[train].contact == 0:
        if not valid or told.way_mm <= 0:
            return crossing
        run[train].contact = 1
        crossing = note_contact(crossing, train)
        forget_promise(run, line, train, day.trains[train].local)
        known = taken(bounds, take_promise(bounds, run, train, UNKNOWN, told), told)
    else:
        held = take_promise(bounds, run, train, followed_of(run, train), told)
        out[CONTRADICTED] += run[train].arrived_s < 0 and contradicts(bounds, held, told)
        known = follow(bounds, held, told)
    if known.age_cycles > bounds.silence_cycles and run[train].lost == 0:
        run[train].lost = 1
        out[LOST] += run[train].arrived_s < 0
    if run[train].likely_s < 0 and likely(day, run, line, train, told):
        run[train].likely_s = now
    known = answer_ask(bounds, run, train, known)
    dues.append((train, due_of(bounds, known, settings.reopening_cycles)))
    later = aged_train(bounds, known)
    run[train].near_um, run[train].short_um, run[train].ceiling_um = later.way_um, later.short_um, later.ceiling_um
    run[train].followed_way_mm, run[train].followed_mm_s = later.told_way_mm, later.told_speed_mm_s
    run[train].age_cycles, run[train].warns = later.age_cycles, int(known.warns)
    return crossing


@compiled
def tell(
    day: Any, run: Any, line: Any, window: Any, track: int, now: int, crossing: Any, dues: Any, settings: Any, out: Any
) -> Any:
    """Tell the crossing all of a track, once its start points have been struck (X1 to X4)."""
    crossing = hear(day, run, window, track, now, crossing)
    for train in range(window[track, 0], window[track, 1]):
        if run[train].state != UNDER_WAY:
            continue
        crossing = prove_rear(day, run, line, train, now, crossing, out)
        in_reach = run[train].contact == 1 or run[train].way_um <= day.trains[train].contact_um
        if run[train].gone == 0 and day.trains[train].radio == 1 and in_reach:
            if day.trains[train].promises == 1:
                promises(day, run, line, train, now, out)
            crossing = follow_train(day, run, line, train, now, crossing, dues, settings, out)
    return crossing


# ---- what is claimed, against the truth


@compiled
def note_asking(run: Any, crossing: Any, now: int) -> None:
    """Keep when each train first asked for the warning."""
    for name, asks in crossing.asks:
        train = name - OTHER_NAME if name >= OTHER_NAME else name
        if asks and run[train].asked_s < 0:
            run[train].asked_s = now


@compiled
def note_opening(run: Any, crossing: Any, window: Any) -> None:
    """Keep of which trains the crossing knew when it opened (X4)."""
    for track in range(TRACKS):
        for train in range(window[track, 0], window[track, 1]):
            run[train].was_known = 0
    for name, _ in crossing.asks:
        run[name - OTHER_NAME if name >= OTHER_NAME else name].was_known = 1


@compiled
def judge_trains(day: Any, run: Any, line: Any, window: Any, track: int, now: int, moment: Any, out: Any) -> int:
    """Hold arrivals and openings against what is claimed; give how many arrived (X2 to X5)."""
    arrivals = 0
    for train in range(window[track, 0], window[track, 1]):
        if run[train].state != UNDER_WAY:
            continue
        judge_ceiling(run, train, out)
        there = run[train].out_s < 0 or now < run[train].out_s + stays_s(day, run, train)
        if run[train].asked_s >= 0 and there and not moment.crossing.warns:
            out[OPENED_BEFORE_REAR] += 1
        if run[train].way_um > 0 or run[train].arrived_s >= 0:
            continue
        run[train].arrived_s = now
        arrivals += 1
        out[IN_CONTACT] += run[train].contact == 1 and run[train].lost == 0
        out[CONVENTIONAL] += run[train].contact == 0
        out[START_BROKEN] += run[train].struck_s < 0 or now - run[train].struck_s < line.start_cycles
        out[LATE_WARNING] += moment.warned <= line.warning_cycles
        out[SHORT_CLOSURE] += moment.down < LEAST_DOWN_S
        least_cycles = line.warning_cycles + SET.reopening_cycles
        out[LIFTED_BETWEEN] += run[train].was_known == 1 and moment.opened <= least_cycles
        if run[train].likely_s >= 0 and day.trains[train].radio == 1:
            out[LIKELY_LATE] += now - run[train].likely_s < line.warning_cycles
        if run[train].asked_s >= 0:
            out[BEYOND] += now - run[train].asked_s - line.warning_cycles
        out[OLD_BEYOND] += now - run[train].old_s - line.warning_cycles
    return arrivals


@compiled
def old_crossing(run: Any, window: Any, moment: Any, out: Any) -> Any:
    """Let the old crossing warn from its start points to the rears (003, 2.3)."""
    is_on_now = False
    for track in range(TRACKS):
        for train in range(window[track, 0], window[track, 1]):
            is_on_now = is_on_now or (run[train].old_s >= 0 and run[train].gone == 0)
    out[OLD_CLOSED] += is_on_now
    if is_on_now and not moment.old_on and 0 <= moment.old_off_s < SET.reopening_cycles:
        out[OLD_SHORT] += 1
    off_s = 0 if is_on_now else (moment.old_off_s + 1 if moment.old_off_s >= 0 else NEVER)
    return is_on_now, off_s


@compiled
def judge_decision(
    run: Any, before: Any, moment: Any, window: Any, unheard: Any, unseen: Any, now: int, out: Any
) -> Any:
    """Hold a decision against what is claimed, and count warnings and what kept them (X3, X4)."""
    crossing, silent = moment.crossing, False
    for track in range(TRACKS):
        silent = silent or unheard[track] > SET.silence_cycles
    out[UNWARNED_SILENCE] += silent and not crossing.warns
    is_unseen = unseen.any()
    out[OPENED_UNSEEN] += is_unseen and not crossing.warns
    out[UNSEEN_CLOSED] += is_unseen
    must = silent or is_unseen
    for _, asks in crossing.asks:
        must = must or asks
    out[SILENCES] += crossing.warns and not before.warns and silent
    out[WARNINGS] += crossing.warns and not before.warns
    note_asking(run, crossing, now)
    if before.warns and not crossing.warns:
        out[NEEDLESS] += moment.arrivals == 0
        note_opening(run, crossing, window)
        return Moment(crossing, 0, moment.lowered, moment.down, 0, 0, False, moment.old_on, moment.old_off_s)
    held = crossing.warns and not must
    out[HELD] += held and not moment.held
    return Moment(
        crossing, moment.warned, moment.lowered, moment.down, moment.opened, moment.arrivals, held, moment.old_on,
        moment.old_off_s,
    )  # fmt: skip


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
def live(
    day: Any,
    run: Any,
    line: Any,
    points: Any,
    decides: Any,
    settings: Any,
    reads: Any,
    crossing: Any,
    start: Any,
    dues: Any,
    out: Any,
) -> None:
    """Let a day pass; it begins with both tracks accounted for."""
    window, ends = np.zeros((TRACKS, 2), np.int64), np.zeros(TRACKS, np.int64)
    unheard, unseen = np.zeros(TRACKS, np.int64), np.zeros(TRACKS, np.int64)
    for train in range(len(day.trains)):
        ends[day.trains[train].track :] += 1
    for track in range(TRACKS):
        window[track, :] = ends[track - 1] if track else 0
        crossing = note_heard(note_empty(crossing, track), track)
    out[TRAINS] += len(day.trains)
    out[SECONDS_COUNT] += SECONDS
    moment = Moment(crossing, 0, 0, 0, 10**6, 0, False, False, NEVER)
    for now in range(SECONDS + DRAIN_S):
        crossing, before = moment.crossing, moment.crossing
        dues.clear()
        for fault in range(len(day.faults)):
            day.on[fault] = is_on(day, fault, now)
        for track in range(TRACKS):
            enter(day, run, line, window, ends, track, now)
            strikes(day, run, line, window, points, track, now, reads, out)
            crossing = tell(day, run, line, window, track, now, crossing, dues, settings, out)
            is_silent = day.on[TERMINAL] and day.faults[TERMINAL].track_of == track
            unheard[track] = unheard[track] + 1 if is_silent else 0
        if has_no_power(day):
            forget(day, run, window, now, out)
            dues.clear()
            crossing, unseen[:] = start, 1
        crossing = account(day, run, window, unseen, now, crossing, out)
        crossing = decides(settings, crossing, dues)
        told = Moment(
            crossing, moment.warned, moment.lowered, moment.down, moment.opened, moment.arrivals, moment.held,
            moment.old_on, moment.old_off_s,
        )  # fmt: skip
        moment = end_cycle(day, judge_decision(run, before, told, window, unheard, unseen, now, out), now, out)
        arrivals = 0
        for track in range(TRACKS):
            run_trains(day, run, line, window, track, out)
            arrivals += judge_trains(day, run, line, window, track, now, moment, out)
        old_on, off_s = old_crossing(run, window, moment, out)
        out[ARRIVALS] += arrivals
        moment = Moment(
            moment.crossing, moment.warned, moment.lowered, moment.down, moment.opened, moment.arrivals + arrivals,
            moment.held, old_on, off_s,
        )  # fmt: skip
