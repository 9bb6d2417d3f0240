"""The end points of a day: tags that tails pass, what is told of them, and who is told gone by it (X4, T14).

There is one beyond the road on each track, and one beyond each start point for trains that turn back.  Whatever a train
tells of its tail comes to the terminals of all of them; where two roads lie close together, to those of both.
"""

from __future__ import annotations

from typing import Any

from models.compiled import compiled
from models.crossing.faults import KIND
from models.crossing.made import MADE
from models.crossing.radio import RADIO_OUT, is_on
from models.crossing.sites import END_POINT
from models.crossing.traffic import NEVER, TRACKS

EndPointSettings, TailRead = MADE.end_point.EndPointSettings, MADE.end_point.TailRead
has_left, note_gone = MADE.end_point.has_left, MADE.crossing.note_gone
END_TAGS, PARTS = KIND["end_tags"], KIND["parts"]
APART_S, TOLD_S, CHANGES_S = END_POINT.apart_cycles, END_POINT.told_cycles, END_POINT.changes_cycles
BEYOND_ROAD, BEYOND_START = 0, 1
SIDES = 2
INNER_TAG_UM, OUTER_TAG_UM = 10_000_000, 15_000_000
"""So far beyond the road the tags lie (ours: a road of two lanes); as far from each other beyond a start point."""
BACK_UM = 20_000_000
"""Who has turned back is out so far beyond its start point; its tags lie before that (ours)."""


@compiled
def inner_of(road: Any, track: Any, side: Any) -> Any:
    """Give the name of an end point's inner tag; the outer one has the next number."""
    return 2 * ((road * TRACKS + track) * SIDES + side)


@compiled
def pass_end_tags(day: Any, run: Any, line: Any, train: int, now: int) -> None:
    """Let a rear pass the tags beyond the road, or those beyond its start point; the tail reads them or not.

    Who turns back before it has come to its start point is out at once, and passes no tag.  Who comes back over the
    road runs on to the tags beyond its start point.
    """
    kind = day.trains[train].local
    if run[train].pace_um < 0 and run[train].struck_s < 0 and run[train].out_s == NEVER:
        run[train].out_s = now
    rear_um = run[train].way_um + line.length_um[kind]
    if run[train].is_back == 1:
        rear_um += line.start_um[kind]
    back_um = run[train].way_um - line.start_um[kind] - BACK_UM
    is_back = run[train].pace_um < 0 and back_um > INNER_TAG_UM - OUTER_TAG_UM
    if run[train].out_s == NEVER and run[train].inner_s == NEVER and (rear_um <= -INNER_TAG_UM or is_back):
        run[train].inner_s = now
        run[train].has_read_inner = int(day.trains[train].radio == 1 and not day.on[END_TAGS])
    if run[train].out_s == NEVER and (rear_um <= -OUTER_TAG_UM or (is_back and back_um > 0)):
        run[train].out_s = now
        run[train].has_read_outer = int(day.trains[train].radio == 1 and not day.on[END_TAGS])
        run[train].side = BEYOND_START if is_back or run[train].is_back == 1 else BEYOND_ROAD


@compiled
def tells_of_its_tail(day: Any, run: Any, train: int) -> Any:
    """Tell whether a train tells now that its tail has read both tags; as long as that may count, and longer (T14)."""
    read_both = run[train].has_read_inner == 1 and run[train].has_read_outer == 1
    return read_both and run[train].out_s != NEVER and not day.on[RADIO_OUT]


@compiled
def hears_it_gone(day: Any, run: Any, road: Any, train: int, track: int, terminals: Any, now: int, hears: Any) -> Any:
    """Tell whether the terminals of a road take a train for gone, by what it tells of its tail at ``road``.

    ``terminals``: the road whose they are.  ``hears``: their way to judge it.  Trains always tell that they are whole:
    one that has parted and says so breaks what is assumed (``parts``).
    """
    if not tells_of_its_tail(day, run, train):
        return False
    inner = inner_of(road, track, run[train].side)
    read = TailRead(inner, inner + 1, run[train].out_s - run[train].inner_s, True)
    for side in range(SIDES):
        own = inner_of(terminals, track, side)
        if hears(EndPointSettings(own, own + 1, APART_S, TOLD_S, CHANGES_S), read, now - run[train].out_s):
            return True
    return False


@compiled
def stays_s(day: Any, run: Any, train: int) -> Any:
    """Give how long a part of a train stays behind."""
    return int(day.faults[PARTS].size) if run[train].out_s >= 0 and is_on(day, PARTS, run[train].out_s) else 0
