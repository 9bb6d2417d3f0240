"""Print the measured figures (`make bench`).  No test depends on any of them.

A file ``tests/**/bench_*.py`` holds functions ``bench_*`` that return :class:`Figure`; each is run in turn.
"""

from __future__ import annotations

import importlib
import platform
import statistics
import sys
import time
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path

from rich.console import Console
from rich.table import Table

TESTS = Path(__file__).resolve().parent


@dataclass(frozen=True)
class Figure:
    """One line of the table: what was measured, the value at the median and at the 95th percentile, the count."""

    what: str
    median: float
    p95: float
    unit: str
    samples: int


def timed(what: str, work: Sequence[Callable[[], object]]) -> Figure:
    """Run each piece of work once and take the time of each, in microseconds."""
    assert work, f"nothing to time: {what}"
    spent = []
    for piece in work:
        begin = time.perf_counter_ns()
        piece()
        spent.append((time.perf_counter_ns() - begin) / 1000)
    return Figure(what, statistics.median(spent), percentile(spent, 95), "µs", len(spent))


def percentile(values: Iterable[float], percent: int) -> float:
    """The smallest value that at least ``percent`` of the values do not exceed."""
    ordered = sorted(values)
    return ordered[max(0, -(-len(ordered) * percent // 100) - 1)]


def benches() -> list[Callable[[], Figure | Iterable[Figure]]]:
    """Every function ``bench_*`` of every file ``bench_*.py``."""
    found = []
    for path in sorted(TESTS.rglob("bench_*.py")):
        name = ".".join(path.relative_to(TESTS.parent).with_suffix("").parts)
        module = importlib.import_module(name)
        found += [bench for each, bench in vars(module).items() if each.startswith("bench_")]
    return found


def main() -> int:
    """Run all and print one table."""
    table = Table(title=f"Python {platform.python_version()}, {platform.machine()}, {platform.system()}")
    for column in ("what", "median", "p95", "unit", "samples"):
        table.add_column(column, justify="left" if column in {"what", "unit"} else "right")
    functions = benches()
    for bench in functions:
        figures = bench()
        for figure in [figures] if isinstance(figures, Figure) else figures:
            table.add_row(
                figure.what, f"{figure.median:,.1f}", f"{figure.p95:,.1f}", figure.unit, f"{figure.samples:,}"
            )
    Console(width=None if sys.stdout.isatty() else 120).print(table)
    return 0 if functions else 1


if __name__ == "__main__":
    sys.exit(main())
