"""What compiled code keeps of a day at a crossing: the line, its trains, its roads, and the moment."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from models.compiled import compiled, packed
from models.crossing.made import MADE
from models.crossing.motion import COMES_UM
from models.crossing.radio import KEPT
from models.crossing.sites import CAR_UM, SETTINGS, Trial
from models.crossing.start_points import points_of
from models.crossing.traffic import NEVER, TRACKS, Day, Records

ArrivalBounds = MADE.arrival.ArrivalBounds
SET = packed(SETTINGS)
OWN = ("own_way_error_m", "own_speed_error_m_s", "ceiling_over_m_s")
WAITING, UNDER_WAY, AWAY = 0, 1, 2
TIMES = (
    "asked_s", "likely_s", "old_s", "struck_s", "arrived_s", "inner_s", "out_s", "read_s", "starts_s", "go_s",
    "started_s", "late_s",
)  # fmt: skip
"""Of a train, -1 until then."""


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
        *((name, np.int64) for name in ("read_s", "has_read", "told_late_s", "is_other")),
        *((name, np.int64) for name in ("inner_s", "has_read_inner", "has_read_outer", "side", "cleared")),
        *((name, np.int64) for name in ("followed_way_mm", "followed_mm_s", "is_back")),
        *((name, np.int64) for name in ("starts_s", "go_s", "started_s", "late_s")),
        ("bias", np.float64),
    ]
)
"""What becomes of a train; times are -1 until then.

``near_um`` to ``followed_mm_s``, ``warns``: what is followed of it.  ``asked_s``: when the warning was first
asked for.  ``old_s``: when the old crossing's start point was struck; ``struck_s``: ours.
``name``: by which the strike is told, -1 if nothing is to be told; ``is_other``: that was not the train's own.
``read_s``: when its head passed the start point's tag; ``has_read``: and read it; ``told_late_s``: it tells so late.
``likely_s``: when the paper's reckoning would have warned.
``arrived_s``, ``out_s``: head at the crossing; rear past it, or turned back, over the outer tag of an end point.
``inner_s``: over the inner one; ``has_read_inner``, ``has_read_outer``: the tail read them; ``side``: where they lie.
``starts_s``: since when it asks to start at the signal beyond the road; ``go_s``: when it hears that it is let go.
``started_s``: when it did so; ``is_back``: since then ``way_um`` is to its new head, which comes from beyond.
``late_s``: when its strike was told after it was told gone by each name: only a person releases it then.
``gone``: told gone by its own name; ``cleared``: by each name that it had.
"""


class Road(NamedTuple):
    """One road over the line: its number, what becomes of trains as seen from it, its start points, and its counts.

    ``unheard``: for how long each start point's terminal is silent.
    ``unseen``: from when on a person looks at each track; 0 if one has seen it empty.
    """

    number: int
    run: Records
    points: Any
    unheard: Any
    unseen: Any
    out: Any


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
    line["length_um"] = [kind.cars * CAR_UM for kind in kinds]
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
    for name in (*TIMES, "name", "told_s"):
        run[name] = NEVER
    for name in ("way_um", "before_um", "last_um"):
        run[name] = COMES_UM
    for name in ("sent_number", "last_number"):
        run[name] = NEVER
    for name in ("held_mm_s", "held_asked_mm_s", "noted_mm_s", "noted_asked_mm_s"):
        run[name] = -(-line["line_um"][day.trains["local"]] // SETTINGS.cycle_ms)
    return run


def road_of(number: int, day: Day, line: Any, out: Any) -> Road:
    """Give a road as a day begins."""
    return Road(number, run_of(day, line), points_of(), np.zeros(TRACKS, np.int64), np.zeros(TRACKS, np.int64), out)
