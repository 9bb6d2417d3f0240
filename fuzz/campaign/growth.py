"""Is coverage still growing?  Tuples and pairs seen against steps taken, for each target, in words and as a picture."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import accumulate
from pathlib import Path

from fuzz.campaign.store import Store

INCHES = (9.0, 4.0)
DOTS_AN_INCH = 110


@dataclass(frozen=True)
class Growth:
    """One target's coverage after its batches, in the order of their numbers; each a running total."""

    steps: Sequence[int]
    tuples: Sequence[int]
    pairs: Sequence[int]

    def last_tenth(self) -> tuple[int, int]:
        """How many tuples the last tenth of the steps added, and how many pairs.

        A batch belongs to it that ends after nine tenths of the steps.
        """
        before = sum(steps * 10 <= self.steps[-1] * 9 for steps in self.steps)
        earlier = [counts[before - 1] if before else 0 for counts in (self.tuples, self.pairs)]
        return self.tuples[-1] - earlier[0], self.pairs[-1] - earlier[1]


def growing(store: Store) -> dict[str, Growth]:
    """Tell how each target's coverage grew; batches of one number but several seeds count as one."""
    found = {}
    for (target,) in store.ask("SELECT DISTINCT target FROM batches WHERE steps > 0 ORDER BY target"):
        sums = store.ask("SELECT number, SUM(steps) FROM batches WHERE target = ? GROUP BY number ORDER BY 1", target)
        numbers = [number for number, _ in sums]
        tuples, pairs = (
            dict(store.ask(f"SELECT first, COUNT(*) FROM {table} WHERE target = ? GROUP BY first", target))
            for table in ("covered", "pairs")
        )
        found[target] = Growth(
            steps=list(accumulate(steps for _, steps in sums)),
            tuples=list(accumulate(tuples.get(number, 0) for number in numbers)),
            pairs=list(accumulate(pairs.get(number, 0) for number in numbers)),
        )
    return found


def in_words(target: str, growth: Growth) -> str:
    """One line on whether it still grows."""
    tuples, pairs = growth.last_tenth()
    return (
        f"{target}: the last tenth of the steps added {tuples:,} of {growth.tuples[-1]:,} tuples"
        f" and {pairs:,} of {growth.pairs[-1]:,} pairs"
    )


def draw(path: Path, found: Mapping[str, Growth]) -> None:
    """Draw it, tuples on the left and pairs on the right, as PNG, whole or not at all.

    Raises:
        OSError: the file cannot be written.
    """
    from io import BytesIO

    from matplotlib.figure import Figure

    from models.streams import write_whole

    figure = Figure(figsize=INCHES, dpi=DOTS_AN_INCH, layout="constrained")
    for place, what in enumerate(("tuples", "pairs"), 1):
        axes = figure.add_subplot(1, 2, place)
        for target, growth in found.items():
            counts = growth.tuples if what == "tuples" else growth.pairs
            axes.plot([0, *growth.steps], [0, *counts], label=target)
        axes.set(xlabel="steps", ylabel=f"{what} seen", xlim=(0, None), ylim=(0, None))
        axes.grid(visible=True, alpha=0.3)
        if found:
            axes.legend(loc="lower right")
    picture = BytesIO()
    figure.savefig(picture, format="png")
    write_whole(path, picture.getvalue())
