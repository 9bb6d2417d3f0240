"""The start points of a day: tags that heads pass, what is told of them, strikes, and whose they are (X3, T14).

There is one for each track and kind of train.  Whatever a train tells of a tag comes to the terminals of all of them.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from kernel.restarts import restart_start_point
from models.compiled import compiled, packed
from models.crossing.columns import NUMBER
from models.crossing.faults import KIND
from models.crossing.made import MADE
from models.crossing.radio import RADIO_OUT, is_on
from models.crossing.sites import START_POINT
from models.crossing.staff import OTHER_NAME, has_no_power, number_of
from models.crossing.traffic import NEVER, TRACKS

StartPoint, StartPointSettings = MADE.start_point.StartPoint, MADE.start_point.StartPointSettings
note_read, note_strike, striker = MADE.start_point.note_read, MADE.start_point.note_strike, MADE.start_point.striker
aged_point, note_owed = MADE.start_point.aged, MADE.start_point.note_owed
note_struck = MADE.crossing.note_struck
NOBODY: Any = 0
RESTARTED = packed(restart_start_point(NOBODY))
START_TAGS, LATE_READS, UNSTRUCK, TERMINAL, LATE_WORDS, RESTARTS = (
    KIND[name] for name in ("start_tags", "late_reads", "unstruck", "terminal", "late_words", "terminal_restarts")
)
STRIKE_BROKEN, WRONG_STRIKER, UNREAD, OWED, MISSED = (
    NUMBER[name] for name in ("strike_broken", "wrong_striker", "unread", "owed", "missed")
)
TOLD_S, WAITS_S, CHANGES_S = START_POINT.told_cycles, START_POINT.waits_cycles, START_POINT.changes_cycles
KINDS = 2
OFTEN = 3
"""So often a terminal that has started tells so, until it hears that this was noted (ours)."""
TAG_UM = 30_000_000
"""The tag lies so far before the detector: less than the shortest train, and no stop lies between (ours)."""
POINT = np.dtype([(name, np.int64) for name in ("reader", "left_cycles", "struck_cycles", "owes", "told")])


def points_of() -> Any:
    """Give the terminals of a day; long before it nobody had struck, and what they owed was told."""
    points = np.zeros((TRACKS, KINDS), POINT)
    points["struck_cycles"] = CHANGES_S
    return points


@compiled
def point_of(points: Any, track: Any, kind: Any) -> Any:
    """Give what a terminal knows."""
    held = points[track, kind]
    return StartPoint(held.reader, held.left_cycles, held.struck_cycles, held.owes == 1)


@compiled
def keep_point(points: Any, track: Any, kind: Any, point: Any) -> None:
    """Keep what a terminal knows."""
    points[track, kind].reader = point.reader
    points[track, kind].left_cycles = point.left_cycles
    points[track, kind].struck_cycles = point.struck_cycles
    points[track, kind].owes = int(point.owes)


@compiled
def has_no_current(day: Any, track: int, now: int) -> Any:
    """Tell whether the terminals of a track have no power then."""
    return is_on(day, RESTARTS, now) and day.faults[RESTARTS].track_of == track


@compiled
def restart_points(day: Any, points: Any, track: int, now: int) -> None:
    """Let the terminals of a track begin anew as their power is back (X3, T14)."""
    window = day.faults[RESTARTS]
    if window.begin_s >= 0 and window.end_s == now and window.track_of == track:
        for kind in range(KINDS):
            keep_point(points, track, kind, RESTARTED)
            points[track, kind].told = 0


@compiled
def tag_of(track: Any, kind: Any) -> Any:
    """Give the name of a start point's tag."""
    return track * KINDS + kind


@compiled
def pass_tag(day: Any, run: Any, line: Any, train: int, now: int) -> None:
    """Let a head pass the tag; it is read if there is a radio to tell of it, and no dirt upon it (T14).

    Who has turned beyond the road passes it as it runs out.
    """
    kind = day.trains[train].local
    tag_um = line.start_um[kind] + TAG_UM
    if run[train].read_s == NEVER and run[train].way_um <= (-tag_um if run[train].is_back == 1 else tag_um):
        run[train].read_s = now
        run[train].has_read = int(day.trains[train].radio == 1 and not day.on[START_TAGS])
        run[train].told_late_s = int(day.faults[LATE_READS].size) if day.on[LATE_READS] else 0


@compiled
def is_told(day: Any, run: Any, train: int, now: int) -> Any:
    """Tell whether a read is heard now: at once; or late, and again as late as may be (T11)."""
    if run[train].has_read == 0 or day.on[RADIO_OUT]:
        return False
    age_s, late_s = now - run[train].read_s, run[train].told_late_s
    return age_s == late_s or (late_s > 0 and age_s == TOLD_S)


@compiled
def strikes(
    day: Any, run: Any, line: Any, window: Any, points: Any, track: int, now: int, reads: Any, out: Any
) -> None:
    """Let trains pass tags and strike detectors; the terminals say whose each strike is (X3, T14).

    ``reads``: the terminals' way to take what is told of a tag.
    """
    restart_points(day, points, track, now)
    for kind in range(KINDS):
        keep_point(points, track, kind, aged_point(point_of(points, track, kind)))
    for train in range(window[track, 0], window[track, 1]):
        kind = day.trains[train].local
        if run[train].old_s < 0 and run[train].way_um <= line.old_um[kind]:
            run[train].old_s = now
        pass_tag(day, run, line, train, now)
        if is_told(day, run, train, now):
            hear_read(day, points, train, tag_of(track, kind), now, reads)
        if run[train].struck_s < 0 and run[train].way_um <= line.start_um[kind]:
            run[train].struck_s = now
            strike(day, run, points, track, train, now, out)


@compiled
def hear_read(day: Any, points: Any, train: int, tag: Any, now: int, reads: Any) -> None:
    """Let the terminals of all start points hear what a train tells, but those without power (T14)."""
    for track in range(TRACKS):
        if has_no_current(day, track, now):
            continue
        for kind in range(KINDS):
            settings = StartPointSettings(tag_of(track, kind), TOLD_S, WAITS_S, CHANGES_S)
            keep_point(points, track, kind, reads(settings, point_of(points, track, kind), train, tag))


@compiled
def strike(day: Any, run: Any, points: Any, track: int, train: int, now: int, out: Any) -> None:
    """Let a train strike a detector, and its terminal name the strike; without power it notes none."""
    if has_no_current(day, track, now):
        out[MISSED] += 1
        return
    if day.on[UNSTRUCK] and track == day.faults[UNSTRUCK].track_of:
        out[STRIKE_BROKEN] += 1
        return
    kind = day.trains[train].local
    point = point_of(points, track, kind)
    run[train].name = striker(point, OTHER_NAME + train)
    run[train].is_other = int(run[train].name != train)
    keep_point(points, track, kind, note_strike(point))
    out[WRONG_STRIKER] += run[train].name != train and run[train].name != OTHER_NAME + train
    out[UNREAD] += run[train].contact == 1 and run[train].name != train


@compiled
def is_silent(day: Any, track: int, now: int) -> Any:
    """Tell whether the terminals of a track say nothing then."""
    is_broken = is_on(day, TERMINAL, now) and day.faults[TERMINAL].track_of == track
    return is_broken or has_no_current(day, track, now)


@compiled
def under_way_s(day: Any, track: int) -> Any:
    """Give for how long the words of a track's terminals are under way."""
    is_late = day.on[LATE_WORDS] and day.faults[LATE_WORDS].track_of == track
    return int(day.faults[LATE_WORDS].size) if is_late else 0


@compiled
def hear(day: Any, road: Any, window: Any, track: int, now: int, crossing: Any, notes: Any, misses: Any) -> Any:
    """Hear a start point's terminal: first what it had to tell as it spoke, and then that it was there (X3, T14).

    ``notes``, ``misses``: the crossing's ways to take that it was there, and that it may have missed strikes.
    """
    run = road.run
    age_s = under_way_s(day, track)
    spoke_s = now - age_s
    if is_silent(day, track, spoke_s):
        return crossing
    if road.points[track, 0].owes == 1 and spoke_s >= day.faults[RESTARTS].end_s and not has_no_power(day):
        crossing = hear_what_is_missed(day, road, window, track, now, crossing, misses)
    for train in range(window[track, 0], window[track, 1]):
        if run[train].name >= 0 and run[train].struck_s <= spoke_s:
            crossing = note_struck(crossing, run[train].name)
            run[train].name = NEVER
            if run[train].cleared == 1:
                run[train].late_s = now
    return notes(crossing, track, age_s)


@compiled
def hear_what_is_missed(day: Any, road: Any, window: Any, track: int, now: int, crossing: Any, misses: Any) -> Any:
    """Hear that a terminal has started: strikes that it had not told of are lost, and a person is asked to look.

    It says so again until it hears that this was noted.  Who was missed has asked for the warning from now on (X3, X4).
    """
    run, out, restarts = road.run, road.out, day.faults[RESTARTS]
    crossing = misses(crossing, track)
    road.unseen[track] = max(road.unseen[track], restarts.end_s + int(restarts.size))
    out[OWED] += road.points[track, 0].told == 0
    for train in range(window[track, 0], window[track, 1]):
        if run[train].struck_s < 0 or run[train].struck_s >= restarts.end_s:
            continue
        out[MISSED] += run[train].name >= 0
        run[train].name = NEVER
        is_known = number_of(crossing, train) > 0 or number_of(crossing, OTHER_NAME + train) > 0
        if run[train].out_s < 0 and run[train].asked_s < 0 and not is_known:
            run[train].asked_s = now
    for kind in range(KINDS):
        road.points[track, kind].told += 1
        if road.points[track, kind].told == OFTEN:
            keep_point(road.points, track, kind, note_owed(point_of(road.points, track, kind)))
    return crossing
