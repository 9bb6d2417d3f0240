"""The papers' figures beside ours: the sensor models run through the kernel's machines (P8, T16).

A figure of the paper is the paper's; one of ours comes from a seed and the parameters written beside it, each
justified where it stands.  None is fitted to a paper's answer, but those called *calibrated*.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from models.reproduce import paper_000, paper_001, paper_002, paper_003, paper_004
from models.reproduce.tables import Reproduction


@dataclass(frozen=True)
class Paper:
    """How a paper is reproduced: from a seed, a number of runs, and a function that is told of progress.

    ``runs``: how many are enough for the paper's counts.
    """

    reproduce: Callable[[int, int, Callable[[int, int, str], None]], Reproduction]
    runs: int


PAPERS = {
    "000": Paper(paper_000.reproduce, 400),
    "001": Paper(paper_001.reproduce, 260),
    "002": Paper(paper_002.reproduce, 20),
    "003": Paper(paper_003.reproduce, 10),
    "004": Paper(paper_004.reproduce, 20),
}
"""By the paper's number."""
