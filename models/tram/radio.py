"""The two links of a station: low-power radio to the trams that stand at it, packets to the centre (G3, G6)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from kernel.tram.cycle import CYCLE_MS, CycleLimits

Floats = npt.NDArray[np.float64]

CYCLE_S = CYCLE_MS // 1_000
REACH_MM = 100_000
"""How far from its stop a station is heard.  Practice: 10 mW at 400 MHz in a street, less than is possible."""
SLOTS = CycleLimits(request_ms=1_200, slot_ms=700, answer_ms=600)
"""About 4 s with four trams (002, 2.3.4)."""
BYTES_A_TRANSFER = 152
"""002, table 2: 263,720 bytes in 1,735 transfers."""
TESTS = (60, 164, 133, 158, 186, 294, 27, 210, 208, 295)
"""002, table 2: transfers by test."""


@dataclass(frozen=True)
class CentreLink:
    """The packet link, in s: what table 2 calls the time of a transfer, request and answer.

    ``least_s`` and what is added, with mean ``more_s``: *calibrated* to the mean of table 2, 4.7 s.
    ``busy``: how much longer a whole test takes at most when the network is busy: from the range of table 2.
    ``most_s``: 002, 5.2.
    """

    least_s: float = 4.3
    more_s: float = 0.38
    busy_s: float = 0.2
    most_s: float = 7.0


LINK = CentreLink()


def transfers_s(chance: np.random.Generator, link: CentreLink, count: int) -> Floats:
    """Give how long each transfer of a test takes; the network repeats what is lost, none is lost to us."""
    busy_s = chance.uniform(0.0, link.busy_s)
    return np.minimum(link.least_s + busy_s + chance.exponential(link.more_s, count), link.most_s)
