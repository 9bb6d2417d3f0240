"""Trains that stop beyond the road, change ends and come back, by a starting signal there (X3 to X5).

Such a train promises to stand, and once it has been seen past the road and has changed ends it asks to start, until it
hears that it is let go.  What it tells comes some seconds late, in any order, or not at all; without a radio the
signal tells it in the train's place, by wire.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from kernel.crossing.crossing import Signal, Signals
from models.compiled import compiled
from models.crossing.columns import NUMBER
from models.crossing.end_points import stays_s
from models.crossing.made import MADE
from models.crossing.motion import NEAR_M, UNASKED, turns_beyond
from models.crossing.radio import LOSSY, RADIO_OUT, STRIDE, is_on
from models.crossing.staff import has_no_power
from models.crossing.traffic import NEVER, POOL

note_standing, note_start, Standing = MADE.crossing.note_standing, MADE.crossing.note_start, MADE.crossing.Standing
BESIDE: Any = 0
SIGNALS = Signals(frozenset({Signal(BESIDE)}))
"""The road's starting signals: one, which lies beyond it."""
LATEST_S = 3
"""What is told of a start is under way for so long at most (ours)."""
CAME_BACK, REAR_BROKEN = NUMBER["came_back"], NUMBER["rear_broken"]


@compiled
def chance_of(day: Any, train: int, sent_s: int, what: int) -> Any:
    """Give the noise of what a train tells in a second."""
    return day.uniform[(train * STRIDE + 7 * sent_s + what) % POOL]


@compiled
def lag_s(day: Any, train: int, sent_s: int) -> Any:
    """Give for how long it is under way."""
    return int((LATEST_S + 1) * chance_of(day, train, sent_s, 1))


@compiled
def is_lost(day: Any, line: Any, train: int, sent_s: int) -> Any:
    """Tell whether it gets lost."""
    if day.trains[train].radio == 0:
        return False
    loss = day.faults[LOSSY].size if is_on(day, LOSSY, sent_s) else line.loss
    return is_on(day, RADIO_OUT, sent_s) or chance_of(day, train, sent_s, 2) < loss


@compiled
def run_cycles(day: Any, line: Any, train: int) -> Any:
    """Give within how many cycles no train arrives from the signal: from a standstill, gaining all that it can."""
    length_um = line.length_um[day.trains[train].local]
    way_um = -day.trains[train].trick_um - length_um - 1e6 * (NEAR_M + 1)
    return int(np.floor(np.sqrt(2 * way_um / line.gain_um)))


@compiled
def turn(run: Any, line: Any, kind: Any, train: int, now: int, out: Any) -> None:
    """Let a train come back: its rear is its head now, and whoever proves its rear out does so anew."""
    way_um = -(run[train].way_um + line.length_um[kind])
    run[train].way_um = run[train].before_um = run[train].last_um = way_um
    run[train].is_back, run[train].pace_um = 1, 0
    run[train].started_s = run[train].old_s = now
    run[train].likely_s = run[train].arrived_s = run[train].go_s = NEVER
    run[train].inner_s = run[train].out_s = run[train].read_s = NEVER
    run[train].has_read = run[train].has_read_inner = run[train].has_read_outer = 0
    run[train].gone = run[train].cleared = run[train].contact = run[train].lost = run[train].is_other = 0
    run[train].held_mm_s = run[train].held_asked_mm_s = line.line_um[kind] // 1_000
    out[CAME_BACK] += 1


@compiled
def promise_to_stand(day: Any, run: Any, train: int, crossing: Any, signals: Any, out: Any) -> Any:
    """Hear that a train stands at the signal: it is gone by its own name (X4)."""
    if run[train].starts_s == NEVER and run[train].gone == 0:
        out[REAR_BROKEN] += stays_s(day, run, train) > 0
        run[train].gone, run[train].contact = 1, 0
        run[train].cleared = 1 - run[train].is_other
    return note_standing(signals, crossing, train, Standing(0, True))


@compiled
def hear_of_starts(day: Any, run: Any, line: Any, train: int, now: int, crossing: Any, signals: Any, out: Any) -> Any:
    """Hear what a train that stands beyond the road has told of itself (X3, X4)."""
    for under_way_s in range(LATEST_S + 1):
        sent_s = now - under_way_s
        has_started = run[train].started_s != NEVER and sent_s >= run[train].started_s
        if has_started or under_way_s >= run[train].stood_s:
            continue
        if lag_s(day, train, sent_s) != under_way_s or is_lost(day, line, train, sent_s):
            continue
        if run[train].starts_s != NEVER and sent_s >= run[train].starts_s:
            crossing = note_start(crossing, train, run_cycles(day, line, train))
        else:
            crossing = promise_to_stand(day, run, train, crossing, signals, out)
    return crossing


@compiled
def talk(day: Any, road: Any, line: Any, train: int, now: int, crossing: Any, machines: Any) -> Any:
    """Let a train that stands beyond the road promise, ask and be let go, and start once it hears so (X4, X5)."""
    run, out = road.run, road.out
    if not turns_beyond(day, train) or run[train].stood_s == 0:
        return crossing
    if run[train].is_back == 1:
        if now > run[train].started_s + LATEST_S or run[train].starts_s == NEVER:
            return crossing
        return hear_of_starts(day, run, line, train, now, crossing, machines.signals, out)
    has_changed_ends = run[train].stood_s > day.trains[train].trick_s
    if day.trains[train].trick == UNASKED:
        if has_changed_ends:
            run[train].asked_s = NEVER
            turn(run, line, day.trains[train].local, train, now, out)
        return crossing
    if has_changed_ends and run[train].cleared == 1 and run[train].starts_s == NEVER:
        run[train].asked_s = NEVER
        run[train].starts_s = now
    crossing = hear_of_starts(day, run, line, train, now, crossing, machines.signals, out)
    if 0 <= run[train].go_s <= now:
        is_heard = day.trains[train].radio == 0 or not day.on[RADIO_OUT]
        run[train].go_s = NEVER
        if is_heard:
            turn(run, line, day.trains[train].local, train, now, out)
            return crossing
    if run[train].go_s == NEVER and not has_no_power(day) and machines.lets(machines.settings, crossing, train):
        run[train].go_s = now + 1 + lag_s(day, train, now)
    return crossing
