"""Whole days of a worker with a handset beside a line, with faults (A1 to A8)."""

from __future__ import annotations

from typing import Any

import numpy as np

from models.alarm.columns import ASSUMPTIONS, CLAIMS, COLUMNS, COUNTS, DRAWN, MONITORS, NUMBER, PRICES
from models.alarm.draws import HOURS, drawn
from models.alarm.faults import BEYOND, FAULTS
from models.alarm.watch import ALARM_TONE, NOTHING, REGISTERED, trace, watch
from models.days.system import Numbers, System

FIRST_FAULT = NUMBER[f"fault_{FAULTS[0].name}"]


def one_day(
    seed: int, day: int, beyond: tuple[str, ...] = (), register: Any = REGISTERED, sounds: Any = ALARM_TONE
) -> Numbers:
    """Simulate one day and give its row; ``beyond``: faults that break an assumption, by name.

    ``register`` and ``sounds`` are the handset's own: tests plant faults there.
    """
    out = np.zeros(len(COLUMNS), np.int64)
    began = drawn(seed, day, beyond)
    watch(began, REGISTERED, register, sounds, NOTHING, out, trace())
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
