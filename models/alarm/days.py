"""Whole days of a worker with a handset beside a line, with faults (A1 to A8)."""

from __future__ import annotations

from typing import Any

import numpy as np

from kernel.alarm.limits import is_lawful
from kernel.alarm.network import Opening
from kernel.maps import Map
from models.alarm.columns import ASSUMPTIONS, CLAIMS, COLUMNS, COUNTS, DRAWN, MONITORS, NUMBER, PRICES
from models.alarm.draws import HOURS, Drawn, another, drawn
from models.alarm.faults import BEYOND, FAULTS, KIND
from models.alarm.figures import joins, lines, openings, with_joins, written
from models.alarm.watch import ALARM_TONE, NOTHING, REGISTERED, trace, watch
from models.compiled import packed
from models.days.system import Numbers, System

HELD = [NUMBER[name] for name in (*CLAIMS, *ASSUMPTIONS)]
"""What is counted of the handset of another worker too."""
FIRST_FAULT = NUMBER[f"fault_{FAULTS[0].name}"]


def of_the_day(register: Any, began: Drawn) -> Any:
    """Give a register with the openings of the day, if it has any, and with the joins of its lines (A1)."""
    return with_joins(register._replace(openings=packed(openings(began), Map[Opening, int])), began)


def one_day(
    seed: int, day: int, beyond: tuple[str, ...] = (), register: Any = REGISTERED, sounds: Any = ALARM_TONE
) -> Numbers:
    """Simulate one day and give its row; ``beyond``: faults that break an assumption, by name.

    ``register`` and ``sounds`` are the handset's own: tests plant faults there.
    """
    out = np.zeros(len(COLUMNS), np.int64)
    began = drawn(seed, day, beyond)
    assert is_lawful(written(began), joins(began), lines(began))
    written_now, register_now = of_the_day(REGISTERED, began), of_the_day(register, began)
    watch(began, written_now, register_now, sounds, NOTHING, out, trace())
    if began.begin_s[KIND["two_workers"]] >= 0:
        others = np.zeros(len(COLUMNS), np.int64)
        watch(another(seed, day, began), written_now, register_now, sounds, NOTHING, others, trace())
        out[HELD] += others[HELD]
    out[FIRST_FAULT : FIRST_FAULT + len(FAULTS)] = began.begin_s >= 0
    return out


SYSTEM = System(
    name="alarm",
    claims=CLAIMS,
    assumptions=ASSUMPTIONS,
    monitors=MONITORS,
    faults=DRAWN,
    prices=PRICES,
    counts=COUNTS,
    hours=float(HOURS),
    one_day=one_day,
    beyond={fault.name: fault.breaks for fault in BEYOND},
)
"""The track worker's alarm on a local line (004)."""
