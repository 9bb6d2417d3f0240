"""What is claimed of arrivals, openings and silence at a road, held against the truth of a day (X2 to X5, T14)."""

from __future__ import annotations

from typing import Any

from models.compiled import compiled
from models.crossing.ceilings import judge_ceiling
from models.crossing.columns import NUMBER
from models.crossing.end_points import stays_s
from models.crossing.records import SET, UNDER_WAY, Moment
from models.crossing.staff import OTHER_NAME
from models.crossing.traffic import NEVER, TRACKS

LATE_WARNING, SHORT_CLOSURE, LIFTED_BETWEEN, OPENED_BEFORE_REAR, UNWARNED_SILENCE, OPENED_UNSEEN, LATCHED = (
    NUMBER[name]
    for name in (
        "late_warning", "short_closure", "lifted_between", "opened_before_rear", "unwarned_silence", "opened_unseen",
        "latched",
    )
)  # fmt: skip
START_BROKEN, SILENCES, CONVENTIONAL = (NUMBER[name] for name in ("start_broken", "silences", "conventional"))
UNSEEN_CLOSED, LIKELY_LATE = NUMBER["unseen_s"], NUMBER["likely_late"]
OLD_CLOSED, BEYOND, OLD_BEYOND, NEEDLESS, HELD, OLD_SHORT = (
    NUMBER[name] for name in ("old_closed_s", "beyond_s", "old_beyond_s", "needless", "held", "old_short_openings")
)
IN_CONTACT, WARNINGS = NUMBER["in_contact"], NUMBER["warnings"]
LEAST_DOWN_S = 15


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
        was_let_go = run[train].is_back == 0 or run[train].starts_s >= 0
        out[START_BROKEN] += not was_let_go or run[train].struck_s < 0 or now - run[train].struck_s < line.start_cycles
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
def judge_end(run: Any, moment: Any, out: Any) -> None:
    """Hold the end of a day against what is claimed: a road stays closed for somebody (X4)."""
    is_anybody = False
    for train in range(len(run)):
        is_anybody = is_anybody or run[train].state == UNDER_WAY
    out[LATCHED] += moment.crossing.warns and not is_anybody
