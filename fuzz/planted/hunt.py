"""How soon a campaign finds planted faults: ``python -m fuzz.planted.hunt [--seed 4] [--count 30] [--runs 5]``.

Each fault is hunted by the targets of a campaign on a tiny station and the sample layouts, batch after batch in
turn, in two processes as on two cores, until a batch fails or its time is spent.  The time counts from the start
of the two processes: reading layouts and compiling the faulty kernel are in it.
"""

from __future__ import annotations

import argparse
import statistics
import sys
import time
from collections.abc import Iterable, Sequence
from multiprocessing import get_context
from pathlib import Path
from typing import Any

from fuzz.campaign.sought import Plantable
from fuzz.machines.places import TINY
from fuzz.planted.draw import COUNT, ROOT, SEED, Planted, drawn
from fuzz.targets.interlocking import Interlocking
from fuzz.targets.jolted import Jolted
from fuzz.targets.link import LinkRuns
from fuzz.targets.target import Batch, Target
from fuzz.targets.walks import Walks
from models.exit_codes import DOES_NOT_HOLD, HOLDS
from proofs.records import write_json

LAYOUTS = (TINY, *sorted((ROOT / "layouts").glob("*.toml")))
PROCESSES = 2
QUICK = 2
"""Walks, and jolted states on the tiny station or runs of the link, are ready within seconds."""
SECONDS = 60.0
RUNS = 5


def targets() -> list[Target]:
    """What a campaign on these layouts runs and a fault can be planted in, what is quick to start first."""
    on_layouts = ((Jolted(path), Interlocking(path)) for path in LAYOUTS)
    return [Walks(), LinkRuns(), *(target for pair in on_layouts for target in pair)]


def carriers(fault: Planted) -> list[Target]:
    """The targets with a fault in them."""
    carried = (each.with_fault(fault.theory, fault.name) for each in targets() if isinstance(each, Plantable))
    return [each for each in carried if each is not None]


def hunting(on: Sequence[Target], seed: int, first: int, found: Any, answers: Any) -> None:
    """One process: every other batch; each quick target, and the others together, get the same time."""
    lanes = [lane for lane in (*([each] for each in on[:QUICK]), list(on[QUICK:])) if lane]
    spent, done = [0.0] * len(lanes), [0] * len(lanes)
    while not found.is_set():
        at = min(range(len(lanes)), key=lambda lane: spent[lane])
        number = first + PROCESSES * done[at]
        target = lanes[at][number % len(lanes[at])]
        began = time.perf_counter()
        if target.run(Batch(target.name, number, seed, ())).failures:
            found.set()
            answers.put(target.name)
        spent[at] += time.perf_counter() - began
        done[at] += 1


def seconds_until_found(fault: Planted, seed: int, most: float = SECONDS) -> tuple[float, str] | None:
    """How long it took to find a fault, and which target did; none if it was not found in time."""
    context = get_context("spawn")
    found, answers = context.Event(), context.Queue()
    going = [
        context.Process(target=hunting, args=(carriers(fault), seed, first, found, answers), daemon=True)
        for first in range(PROCESSES)
    ]
    began = time.perf_counter()
    for process in going:
        process.start()
    hit = found.wait(most)
    spent = time.perf_counter() - began
    target = answers.get(timeout=most) if hit else ""
    for process in going:
        process.kill()
        process.join()
    return (spent, target) if hit else None


def main(given: Iterable[str] | None = None) -> int:
    """Hunt the faults drawn, and print how long each took."""
    parser = argparse.ArgumentParser(prog="python -m fuzz.planted.hunt", description=__doc__)
    parser.add_argument("--seed", type=int, default=SEED, help=f"of the draw; {SEED}")
    parser.add_argument("--count", type=int, default=COUNT, help=f"faults; {COUNT}")
    parser.add_argument("--runs", type=int, default=RUNS, help=f"with seeds 1, 2, ...; {RUNS}")
    parser.add_argument("--seconds", type=float, default=SECONDS, help=f"for each; {SECONDS:g}")
    parser.add_argument("--json", type=Path, help="write the record there")
    asked = parser.parse_args(None if given is None else list(given))
    rows: dict[str, list[tuple[float, str] | None]] = {}
    for at, fault in enumerate(drawn(asked.seed, asked.count), 1):
        found = [seconds_until_found(fault, run, asked.seconds) for run in range(1, asked.runs + 1)]
        rows[fault.name] = found
        times = " ".join("  -  " if each is None else f"{each[0]:5.1f}" for each in found)
        by = ", ".join(sorted({each[1] for each in found if each}))
        print(f"{at:3} {times} s  {fault.name}  ({by or 'not found'})", flush=True)
    every = [each[0] for found in rows.values() for each in found if each]
    missed = sum(each is None for found in rows.values() for each in found)
    if asked.json:
        write_json(asked.json, {"seed": asked.seed, "seconds": asked.seconds, "found": rows, "missed": missed})
    summary = f"median {statistics.median(every):.1f} s, worst {max(every):.1f} s" if every else "none found"
    print(f"{len(rows)} faults, {asked.runs} runs each: {summary}, {missed} not found in {asked.seconds:g} s")
    return DOES_NOT_HOLD if missed else HOLDS


if __name__ == "__main__":
    sys.exit(main())
