"""The crossing's machines as machine code: the kernel's own source."""

from __future__ import annotations

from kernel.crossing import arrival, crossing
from kernel.crossing.arrival import Followed, Ranging
from kernel.crossing.crossing import Crossing, Due, Train
from kernel.maps import Map
from models.compiled import compile_machines, packed

MADE = compile_machines([arrival, crossing])
NOTHING = packed(Ranging(False, 0, 0, 0))
UNKNOWN = packed(Followed(0, 0, 10**6, 0, 0, False))
"""Of a train of which there is no ranging."""
OPEN = Crossing(asks={}, silent_cycles={}, warns=False, warned_cycles=0)
"""A crossing before anything is told."""
NO_DUES = packed({}, Map[Train, Due])
