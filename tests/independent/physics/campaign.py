"""Rides by the thousand, and what came of them in sum.

python -m tests.independent.physics.campaign --rides 10000 --processes 2 [--beyond each] [--widths] [--write]
"""

from __future__ import annotations

import argparse
import sys
import time
from collections import Counter, defaultdict
from collections.abc import Callable, Iterable
from contextlib import nullcontext
from dataclasses import dataclass, field
from multiprocessing import get_context
from pathlib import Path

from tests.independent.physics.faults import BEYOND
from tests.independent.physics.planted_faults import WRONG
from tests.independent.physics.ride import Hazard, Outcome, Ride, Style

WAYS_M = (10, 50, 100, 200, 500, 1_000, 2_000)
STOPS = (0, 1, 2, 3, 5, 10, 20)
PAGE = Path(__file__).parents[3] / "docs" / "physics.md"
BEGINS, ENDS = "<!-- widths, as the command writes them -->\n", "<!-- end of widths -->\n"


def _lists() -> defaultdict[tuple[int, int], list[float]]:
    return defaultdict(list)


@dataclass
class Tally:
    """The sum of rides; ``found`` has what must not be, ``beyond`` what is so after a bound was broken."""

    rides: int = 0
    ran_mm: float = 0.0
    counts: Counter[str] = field(default_factory=Counter)
    found: list[tuple[int, Hazard]] = field(default_factory=list)
    beyond: Counter[str] = field(default_factory=Counter)
    worst: dict[str, float] = field(default_factory=dict)
    broken: int = 0
    noticed: int = 0
    widths: defaultdict[tuple[int, int], list[float]] = field(default_factory=_lists)

    def note(self, seed: int, out: Outcome) -> None:
        """Count a ride."""
        self.rides += 1
        self.ran_mm += out.ran_mm
        self.counts += out.counts
        self.broken += bool(out.broken)
        self.noticed += bool(out.broken) and out.counts["helped by staff"] > 0
        for hazard in out.hazards:
            if hazard.broken:
                self.beyond[hazard.kind] += 1
                self.worst[hazard.kind] = max(self.worst.get(hazard.kind, 0.0), hazard.by)
            else:
                self.found.append((seed, hazard))
        for way_mm, stops, width_mm in out.widths:
            self.widths[_up_to(WAYS_M, way_mm / 1_000), _up_to(STOPS, stops)].append(width_mm)

    def add(self, other: Tally) -> None:
        """Count another's with it."""
        self.rides += other.rides
        self.ran_mm += other.ran_mm
        self.counts += other.counts
        self.found += other.found
        self.beyond += other.beyond
        self.broken += other.broken
        self.noticed += other.noticed
        for kind, by in other.worst.items():
            self.worst[kind] = max(self.worst.get(kind, 0.0), by)
        for key, widths in other.widths.items():
            self.widths[key] += widths


def _up_to(steps: Iterable[int], value: float) -> int:
    """The first step that is no less; -1 beyond the last."""
    return next((step for step in steps if value <= step), -1)


def rides(
    seeds: Iterable[int],
    beyond: str | None = None,
    wrong: str | None = None,
    style: Style | None = None,
    enough: int = 10**9,
) -> Tally:
    """Ride these; stop when so many hazards are found."""
    tally = Tally()
    with WRONG[wrong].planted() if wrong else nullcontext():
        for seed in seeds:
            tally.note(seed, Ride(seed, beyond, style).run())
            if len(tally.found) >= enough:
                break
    return tally


def _part(task: tuple[Iterable[int], str | None]) -> Tally:
    return rides(*task)


def campaign(
    many: int,
    processes: int,
    beyond: str | None = None,
    first: int = 0,
    so_far: Callable[[Tally], object] = lambda tally: None,
) -> Tally:
    """So many rides, in several processes; ``so_far``: is told of the sum of the first rides, a few at a time."""
    parts = [(range(at, min(at + 25, first + many)), beyond) for at in range(first, first + many, 25)]
    whole = Tally()
    with get_context("spawn").Pool(processes) as pool:
        for tally in pool.imap(_part, parts):
            whole.add(tally)
            so_far(whole)
    return whole


def table(tally: Tally) -> str:
    """How wide the range is, in m, at the most and in the middle, by the way and the stops since the last fix."""
    names = {-1: "more"}
    lines = ["| way \\ stops | " + " | ".join(names.get(stop, f"{stop}") for stop in (*STOPS, -1)) + " |"]
    lines.append("|" + "---|" * (len(STOPS) + 2))
    for way in (*WAYS_M, -1):
        cells = []
        for stop in (*STOPS, -1):
            found = sorted(tally.widths.get((way, stop), []))
            cells.append(f"{found[len(found) // 2] / 1e3:.1f}; {found[-1] / 1e3:.0f} ({len(found)})" if found else "")
        lines.append(f"| {names.get(way, f'{way} m')} | " + " | ".join(cells) + " |")
    return "\n".join(lines)


def written(page: str, tally: Tally, first: int) -> str:
    """The page with this table of widths in the place of the one it has, and the command that made it."""
    before, _, rest = page.partition(BEGINS)
    _, _, after = rest.partition(ENDS)
    assert after, "the page has no place for the table"
    command = f"python -m tests.independent.physics.campaign --rides {tally.rides} --first {first} --write"
    said = f"{tally.rides:,} rides, {tally.ran_mm / 1e6:,.0f} km, {len(tally.found)} claims broken: `{command}`"
    return f"{before}{BEGINS}{said}\n\n{table(tally)}\n{ENDS}{after}"


def shown(name: str, tally: Tally) -> str:
    """What came of it, in a few lines."""
    worst = {kind: f"{many} (at most {tally.worst[kind] / 1e3:.1f} m or m/s)" for kind, many in tally.beyond.items()}
    lines = [
        f"{name}: {tally.rides} rides, {tally.ran_mm / 1e6:.0f} km, {tally.counts['cycles']} cycles",
        f"  claims broken within the bounds: {len(tally.found)}; beyond them: {worst}",
        f"  rides with a bound broken: {tally.broken}, of which staff was called in {tally.noticed}",
    ]
    lines += [f"  {key}: {many}" for key, many in sorted(tally.counts.items())]
    lines += [f"  seed {seed}: {hazard}" for seed, hazard in tally.found[:20]]
    return "\n".join(lines)


def main() -> int:
    """Run from the command line; 1 if a claim was broken within the bounds."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--rides", type=int, default=1_000)
    parser.add_argument("--first", type=int, default=0, help="seed of the first ride")
    parser.add_argument("--processes", type=int, default=2)
    parser.add_argument("--beyond", choices=["each", *BEYOND], help="a fault beyond its bound in every ride")
    parser.add_argument("--widths", action="store_true", help="the table of widths")
    parser.add_argument("--write", action="store_true", help="write that table, within the bounds, to docs/physics.md")
    given = parser.parse_args()
    kinds: list[str | None] = list(BEYOND) if given.beyond == "each" else [given.beyond]
    found = 0
    for kind in kinds:
        begun = time.monotonic()

        def told(tally: Tally) -> None:
            if tally.rides % 500 == 0 or tally.rides == given.rides:
                print(f"{tally.rides} rides, {len(tally.found)} claims broken", file=sys.stderr, flush=True)
                if given.write and not given.beyond:
                    page = PAGE.read_text(encoding="utf-8")
                    PAGE.write_text(written(page, tally, given.first), encoding="utf-8", newline="\n")

        tally = campaign(given.rides, given.processes, kind, given.first, told)
        found += len(tally.found)
        print(shown(kind or "within the bounds", tally))
        print(f"  {time.monotonic() - begun:.0f} s")
        if given.widths:
            print(table(tally))
    return 1 if found else 0


if __name__ == "__main__":
    raise SystemExit(main())
