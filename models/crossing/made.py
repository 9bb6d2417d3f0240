"""The crossing's machines as machine code: the kernel's own source."""

from __future__ import annotations

from typing import Any

from kernel.crossing import arrival, crossing, end_point, promise, start_point
from kernel.crossing.arrival import Ranging
from kernel.crossing.crossing import Crossing, CrossingTrack, Due, Train
from kernel.maps import Map
from kernel.restarts import restart_crossing
from models.compiled import compile_machines, packed
from models.crossing.sites import SETTINGS
from models.crossing.traffic import TRACKS

MADE = compile_machines([arrival, crossing, end_point, promise, start_point])
NOTHING = packed(Ranging(False, 0, 0, 0))
"""Of a train of which there is no ranging; the ceiling is to be told."""
OPEN = Crossing(
    asks={}, starts={}, silent_cycles={}, unaccounted={}, numbers={}, looks={}, number=0, warns=False, warned_cycles=0
)
"""A crossing before anything is told."""
NUMBERS: Any = range(TRACKS)
WHOLE = frozenset(map(CrossingTrack, NUMBERS))
STARTS = tuple(packed(restart_crossing(SETTINGS, WHOLE - {left_out}, number=1)) for left_out in (None, *NUMBERS))
"""A crossing whose power has come back: with all of its tracks, and with settings that leave each of them out."""
NO_DUES = packed({}, Map[Train, Due])
