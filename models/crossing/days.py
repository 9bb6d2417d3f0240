"""Whole days at the two crossings of the field trials, with faults (X1 to X5, T14)."""

from __future__ import annotations

from typing import Any

import numpy as np

from models.crossing.columns import ASSUMPTIONS, CLAIMS, COLUMNS, COUNTS, DRAWN, MONITORS, NUMBER, PRICES
from models.crossing.faults import FAULTS
from models.crossing.sites import HOURS, TRIALS, lawful
from models.crossing.traffic import NEVER, drawn
from models.crossing.watch import Machines, watched
from models.days.system import Numbers, System

FIRST_FAULT = NUMBER[f"fault_{FAULTS[0].name}"]


def one_day(
    seed: int,
    day: int,
    beyond: tuple[str, ...] = (),
    **planted: Any,
) -> Numbers:
    """Simulate one day and give its row; even days at the first crossing, odd ones at the second.

    ``beyond``: faults that break an assumption, by name.  ``planted``: in the place of one of the machines
    (:class:`models.crossing.watch.Machines`); tests plant faults there, and the truth is held against what is right.
    """
    assert lawful()
    out = np.zeros(len(COLUMNS), np.int64)
    trial = TRIALS[day % len(TRIALS)]
    began = drawn(seed, day, trial, beyond)
    watched(trial, began, out, Machines(**planted))
    out[FIRST_FAULT : FIRST_FAULT + len(FAULTS)] = began.faults["begin_s"] != NEVER
    return out


SYSTEM = System(
    name="crossing",
    claims=CLAIMS,
    assumptions=ASSUMPTIONS,
    monitors=MONITORS,
    faults=DRAWN,
    prices=PRICES,
    counts=COUNTS,
    hours=float(len(HOURS)),
    one_day=one_day,
    beyond={fault.name: fault.breaks for fault in FAULTS if fault.breaks},
)
"""Constant warning time by radio ranging (003)."""
