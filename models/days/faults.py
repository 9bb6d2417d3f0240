"""A fault of a day as data: how often, how long, how large, and where that is from.

Those within what is assumed are drawn each day by their chance.  Those beyond it are drawn only when named: they
break an assumption of the proofs, and the campaign has to see it.
"""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Fault:
    """One fault: for some time of a day, or of one train.

    ``chance``: of a day.  ``least_s`` to ``most_s``: how long.  ``least`` to ``most``: how large, in ``unit``.
    ``breaks``: the assumption that it breaks, none where the system has to live with it.
    """

    name: str
    says: str
    chance: float
    least_s: int
    most_s: int
    unit: str
    least: float
    most: float
    source: str
    breaks: str = ""
