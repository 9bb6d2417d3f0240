"""What people on site and detectors tell a crossing: rears out of the approach, and tracks that are empty (X3, X4).

And what a failure of power takes from it: the crossing begins anew in each second without power, the ground unit too.
"""

from __future__ import annotations

from typing import Any

from kernel.crossing.crossing import NONE
from models.compiled import compiled
from models.crossing.columns import NUMBER
from models.crossing.end_points import hears_it_gone, pass_end_tags, stays_s
from models.crossing.faults import KIND
from models.crossing.made import MADE
from models.crossing.radio import is_on
from models.crossing.traffic import NEVER, TRACKS

note_gone, note_released, note_empty = (MADE.crossing.note_gone, MADE.crossing.note_released, MADE.crossing.note_empty)
number_of, look_of = MADE.crossing.number_of, MADE.crossing.look_of
REAR_BROKEN, ACCOUNT_BROKEN, TRACK_BROKEN, RELEASED, FORGOTTEN, ACCOUNTED, TURNED_BACK = (
    NUMBER[name]
    for name in (
        "rear_broken", "account_broken", "track_broken", "released", "forgotten", "accounted", "turned_back"
    )
)  # fmt: skip
END_DETECTOR = KIND["end_detector"]
POWER, UNLOOKED, UNLISTED = KIND["power"], KIND["unlooked"], KIND["unlisted"]
NOBODY_S = 10**9
"""Nobody comes."""
OTHER_NAME = 1_000_000
"""A strike that no ranging explains gets a name of its own: the train's number and this."""
END_DETECTOR_UM = 25_000_000
"""The rear is past the road here, and the end point's tags (ours: a road of two lanes)."""


# ---- rears


@compiled
def told_gone(run: Any, train: int, crossing: Any) -> Any:
    """Tell that a train is gone, by its own name; it is not followed any more (X4)."""
    run[train].gone, run[train].contact = 1, 0
    run[train].cleared = 1 - run[train].is_other
    return note_gone(crossing, train, number_of(crossing, train), True)


@compiled
def let_go(day: Any, run: Any, line: Any, train: int, now: int, crossing: Any, out: Any) -> Any:
    """Follow a train no more that has turned back before its start point, or runs out over it (X4).

    It tells that it is whole; one that has left a part inside breaks what is assumed.
    """
    if run[train].out_s == NEVER:
        run[train].out_s = now
    out[TURNED_BACK] += 1
    is_inside = run[train].way_um <= line.start_um[day.trains[train].local]
    leaves_a_part = run[train].struck_s >= 0 and stays_s(day, run, train) > 0
    out[REAR_BROKEN] += is_inside or leaves_a_part
    return told_gone(run, train, crossing)


@compiled
def prove_rear(
    day: Any, road: Any, other: Any, line: Any, train: int, track: int, now: int, crossing: Any, hears: Any
) -> Any:
    """Tell that a train's rear is out of the approach: by its tail's tags, the end detector, or a person (X4, T14).

    What it tells of its tail is of the train by its own name; all of its axles are counted by whatever name it has.
    What it tells of the other road's tags comes to this one's terminals too.
    """
    run, out = road.run, road.out
    if other.number != road.number and hears_it_gone(
        day, other.run, other.number, train, track, road.number, now, hears
    ):
        crossing = note_gone(crossing, train, number_of(crossing, train), True)
    if run[train].cleared == 1:
        return release_late(day, run, train, now, crossing, out)
    pass_end_tags(day, run, line, train, now)
    out_s = run[train].out_s
    if out_s < 0 or out_s == now:
        return crossing
    if run[train].gone == 0 and hears_it_gone(day, run, road.number, train, track, road.number, now, hears):
        out[REAR_BROKEN] += stays_s(day, run, train) > 0
        return told_gone(run, train, crossing)
    rear_um = run[train].way_um + line.length_um[day.trains[train].local]
    is_beyond_road = run[train].is_back == 0 and rear_um <= -END_DETECTOR_UM
    by_detector = is_beyond_road and not is_on(day, END_DETECTOR, out_s)
    is_known = run[train].contact == 1 or run[train].struck_s >= 0
    if is_known and not by_detector and now < out_s + day.trains[train].person_s:
        return crossing
    out[REAR_BROKEN] += run[train].gone == 0 and stays_s(day, run, train) > 0
    run[train].gone, run[train].cleared, run[train].contact = 1, 1, 0
    out[RELEASED] += is_known and not by_detector
    for name in (train, OTHER_NAME + train):
        number = number_of(crossing, name)
        crossing = note_gone(crossing, name, number, True) if by_detector else note_released(crossing, name, number)
    return crossing


@compiled
def release_late(day: Any, run: Any, train: int, now: int, crossing: Any, out: Any) -> Any:
    """Let a person release a train whose strike was told once it was gone: no rear of it comes any more (X4)."""
    if run[train].late_s == NEVER or now < run[train].late_s + day.trains[train].person_s:
        return crossing
    run[train].late_s = NEVER
    out[RELEASED] += 1
    for name in (train, OTHER_NAME + train):
        crossing = note_released(crossing, name, number_of(crossing, name))
    return crossing


# ---- power, and who looks at the tracks after it


@compiled
def has_no_power(day: Any) -> Any:
    """Tell whether the crossing has no power now."""
    return day.on[POWER] or day.on[UNLOOKED] or day.on[UNLISTED]


@compiled
def somebody_comes_s(day: Any) -> Any:
    """Give when a person comes who looks at the tracks, since power has failed now."""
    come_s = 0
    for fault in (POWER, UNLISTED):
        if day.on[fault]:
            come_s = max(come_s, day.faults[fault].end_s + int(day.faults[fault].size))
    return NOBODY_S if come_s == 0 else come_s


@compiled
def is_inside(day: Any, run: Any, train: int, now: int) -> Any:
    """Tell whether a train, or a part of it, is between its start point and where its rear is past the road.

    Or on its way back, since it has been let go.
    """
    if run[train].go_s >= 0:
        return True
    is_there = run[train].out_s < 0 or now < run[train].out_s + stays_s(day, run, train)
    return run[train].struck_s >= 0 and is_there


@compiled
def forget(day: Any, run: Any, window: Any, now: int, out: Any) -> None:
    """Take from the ground unit whom it follows, and from terminals what they had to tell (X3)."""
    begins = False
    for fault in (POWER, UNLOOKED, UNLISTED):
        begins = begins or day.faults[fault].begin_s == now
    for track in range(TRACKS):
        for train in range(window[track, 0], window[track, 1]):
            run[train].contact, run[train].warns, run[train].name = 0, 0, NEVER
            if run[train].struck_s < 0:
                run[train].asked_s = NEVER
            out[FORGOTTEN] += begins and is_inside(day, run, train, now)


@compiled
def account(day: Any, run: Any, window: Any, unseen: Any, now: int, crossing: Any, out: Any) -> Any:
    """Let a person who has come account for each track that he sees to be empty; or for one unseen, which none may."""
    for track in range(TRACKS):
        is_empty = True
        for train in range(window[track, 0], window[track, 1]):
            is_empty = is_empty and not is_inside(day, run, train, now)
        unlooked = day.faults[UNLOOKED]
        looks = now >= unseen[track] and is_empty
        says = unlooked.begin_s >= 0 and now >= unlooked.end_s
        is_asked = look_of(crossing, track) != NONE
        out[TRACK_BROKEN] += not is_asked and not crossing.warns
        if unseen[track] and is_asked and (looks or says):
            crossing = note_empty(crossing, track, look_of(crossing, track))
            out[ACCOUNTED] += 1
            out[ACCOUNT_BROKEN] += not is_empty
            unseen[track] = 0
    return crossing
