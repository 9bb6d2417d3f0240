"""The columns in which a simulated day is kept: of each tram the truth, its unit, and what the centre knows of it.

Whole numbers; places in mm, speeds in mm/s, times in ms unless a name says s.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from models.tram.gps import Floats
from models.tram.line import Whole

TRUTH = (
    "ON",
    "TURN",
    "PLACE",
    "SPEED",
    "LEAVES",
    "NEXT",
    "DWELL_S",
    "PASSES",
    "BROKEN_S",
    "OFF_S",
    "WAITS",
    "DUE_S",
    "CONFIRMED_S",
    "COMES_AT",
)
UNIT = ("U_STOP", "U_LEFT", "U_STANDS", "U_STOOD", "D_LOCATED", "D_STOP", "D_STANDS", "D_HOLDS", "D_RECOVERS", "D_MADE")
UNIT_TIME = ("D_NOW", "H_KNOWN", "H_AGE", "H_ANSWERED")
UNIT_WAY = ("U_RUN", "U_FOLLOWED", "U_LEAST", "U_MOST", "U_ASTRAY", "U_RIGHT_S")
"""What a unit has seen of the way that is set, whether that is the other one, and when its driver notices."""
CENTRE = ("K_IS", "K_LEAVES", "K_SINCE", "K_STOP", "K_LEFT", "K_STANDS", "K_ARRIVED", "K_TOLD", "K_RECOVERY")
CENTRE_TOO = ("K_COMES", "K_ELSEWHERE")
GHOST = ("G_MARK", "G_TOLD", "G_BEHIND", "G_MADE")
"""What a tram has truly told, by whatever number: the farthest mark of this run, when it stood last; whether one behind
holds it.

And when the order that it shows was truly made."""
NAMES = (*TRUTH, *UNIT, *UNIT_TIME, *UNIT_WAY, *CENTRE, *CENTRE_TOO, *GHOST)

ON, TURN, PLACE, SPEED, LEAVES, NEXT, DWELL_S, PASSES, BROKEN_S, OFF_S, WAITS, DUE_S, CONFIRMED_S, COMES_AT = map(
    NAMES.index, TRUTH
)
U_STOP, U_LEFT, U_STANDS, U_STOOD, D_LOCATED, D_STOP, D_STANDS, D_HOLDS, D_RECOVERS, D_MADE = map(NAMES.index, UNIT)
D_NOW, H_KNOWN, H_AGE, H_ANSWERED = map(NAMES.index, UNIT_TIME)
U_RUN, U_FOLLOWED, U_LEAST, U_MOST, U_ASTRAY, U_RIGHT_S = map(NAMES.index, UNIT_WAY)
K_IS, K_LEAVES, K_SINCE, K_STOP, K_LEFT, K_STANDS, K_ARRIVED, K_TOLD, K_RECOVERY = map(NAMES.index, CENTRE)
K_COMES, K_ELSEWHERE = map(NAMES.index, CENTRE_TOO)
G_MARK, G_TOLD, G_BEHIND, G_MADE = map(NAMES.index, GHOST)

BOX = 8
"""So many messages to or from one tram are on their way at most; a later one is lost."""
FREE = -1
R_DUE, R_STOP, R_LEFT, R_STANDS, R_LEAVES, R_MADE, R_BY = range(7)
O_DUE, O_TRAM, O_STOP, O_HOLDS, O_RECOVERS, O_MADE, O_STRAY, O_TRULY = range(8)
NEVER_MS = -(10**9)
LATE_MS = 10**12


class Traffic(NamedTuple):
    """A day so far.

    ``trams``: a row for each vehicle number, the columns above.  ``line``: those on the way, the first in front,
    and ``size``: how many; then how many runs were taken up.
    ``known``: when the centre opens, in ms, and what it holds cleared.
    ``reports``, ``orders``: on their way, by tram; ``due_ms``: when the first of either is due.
    ``left_ms``: what the centre has noted of departures, ``truly_left_ms``: when they were, by tram and stop.
    ``shown``: whether one tram is shown ahead of another.
    ``served_s``: when each stop was served last.  ``errors_m``: of each tram's GPS.  ``row``: what is counted.
    ``log``: by run and stop, when it left, in s.
    """

    trams: Whole
    line: Whole
    size: Whole
    known: Whole
    reports: Whole
    orders: Whole
    due_ms: Whole
    left_ms: Whole
    truly_left_ms: Whole
    shown: Whole
    served_s: Whole
    errors_m: Floats
    row: Whole
    log: Whole


def begun(trams: int, stops: int, runs: int, columns: int, now_s: int) -> Traffic:
    """Give the morning: no tram is on the way, and nothing is known."""
    state = np.zeros((trams, len(NAMES)), np.int64)
    state[:, OFF_S] = NEVER_MS
    state[:, K_ELSEWHERE] = NEVER_MS
    state[:, COMES_AT] = FREE
    return Traffic(
        trams=state,
        line=np.zeros(trams, np.int64),
        size=np.zeros(2, np.int64),
        known=np.array([LATE_MS, FREE], np.int64),
        reports=np.full((trams, BOX, 7), FREE, np.int64),
        orders=np.full((trams, BOX, 8), FREE, np.int64),
        due_ms=np.full((2, trams), LATE_MS, np.int64),
        left_ms=np.full((trams, stops + 1), NEVER_MS, np.int64),
        truly_left_ms=np.full((trams, stops + 1), NEVER_MS, np.int64),
        shown=np.zeros((trams, trams), np.int64),
        served_s=np.full(stops, now_s - 300, np.int64),
        errors_m=np.zeros((trams, 2)),
        row=np.zeros(columns, np.int64),
        log=np.full((runs, stops), FREE, np.int64),
    )
