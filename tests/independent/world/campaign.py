"""Runs worlds by the thousand, keeps what went wrong as a seed and a list of events, and makes the list short.

python -m tests.independent.world.campaign --steps 50000000 --processes 2
"""

from __future__ import annotations

import argparse
import time
from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from multiprocessing import get_context

from tests.independent import files
from tests.independent.world.drawn import LAYOUTS, REAL, told
from tests.independent.world.hazards import Hazard
from tests.independent.world.kernel_calls import Calls
from tests.independent.world.planted_faults import KERNELS
from tests.independent.world.schedule import Schedule
from tests.independent.world.world import Event, World

STEPS_A_LIFE = 3_000
"""So many steps a world lasts; the next seed makes another."""
STUCK_AFTER = 600
"""A world in which no train has moved for so many steps is left for another."""
SEED_A_LAYOUT = 1_000_003


@dataclass
class Found:
    """A hazard, and all that it takes to see it again."""

    layout: str
    kernel: str
    seed: int
    trains: int
    kind: str
    text: str
    events: list[Event]


@dataclass
class Tally:
    """What was run."""

    steps: int = 0
    refused: int = 0
    worlds: int = 0
    stuck: int = 0
    moved_mm: int = 0
    kinds: Counter[str] = field(default_factory=Counter)
    refused_kinds: Counter[str] = field(default_factory=Counter)
    found: list[Found] = field(default_factory=list)

    def add(self, other: Tally) -> None:
        """Count another's with it."""
        self.steps += other.steps
        self.refused += other.refused
        self.worlds += other.worlds
        self.stuck += other.stuck
        self.moved_mm += other.moved_mm
        self.kinds += other.kinds
        self.refused_kinds += other.refused_kinds
        self.found += other.found


def layouts() -> list[str]:
    """Those drawn here, and the real ones that are there."""
    return [*LAYOUTS, *(name for name in REAL if (files.FOLDER / name).exists())]


def trains_of(seed: int) -> int:
    """How many trains a world has."""
    return (3, 1, 2, 1, 2)[seed % 5]


def live(
    layout: str, kernel: type[Calls], seed: int, steps: int, tally: Tally, habit: str | None = None
) -> Found | None:
    """Run one world, by one habit or by any; the hazard that it ended in."""
    trains = trains_of(seed)
    world = World(told(layout, trains), kernel, trains, seed)
    tally.worlds += 1
    if len(world.trains) < trains:
        return None
    schedule = Schedule(world, seed, habit)
    events: list[Event] = []
    found = None
    ran_at, ran_mm = 0, 0
    for step in range(steps):
        event = schedule.next()
        events.append(event)
        tally.steps += 1
        tally.kinds[event[0]] += 1
        try:
            if not world.happen(event):
                tally.refused += 1
                tally.refused_kinds[event[0]] += 1
        except Hazard as hazard:
            found = Found(layout, kernel.__name__, seed, trains, hazard.kind, str(hazard), events)
            tally.found.append(found)
            break
        if step % 100 == 0:
            run_mm = sum(abs(train.odometer_mm) for train in world.trains.values())
            ran_at, ran_mm = (step, run_mm) if run_mm != ran_mm else (ran_at, ran_mm)
            if step - ran_at > STUCK_AFTER:
                tally.stuck += 1
                break
    tally.moved_mm += sum(abs(train.odometer_mm) for train in world.trains.values())
    return found


def happens_again(found: Found, kernel: type[Calls], events: Iterable[Event]) -> str | None:
    """Run a list of events; the kind of hazard that it ends in."""
    world = World(told(found.layout, found.trains), kernel, found.trains, found.seed)
    world.missed_of_100 = 0
    Schedule(world, found.seed)
    try:
        for event in events:
            world.happen(event)
    except Hazard as hazard:
        return hazard.kind
    return None


def shrunk(found: Found, kernel: type[Calls]) -> list[Event]:
    """Leave out events as long as the same kind of hazard comes about."""
    events = found.events
    size = len(events) // 2
    while size >= 1:
        at, before = 0, len(events)
        while at < len(events):
            shorter = events[:at] + events[at + size :]
            if happens_again(found, kernel, shorter) == found.kind:
                events = shorter
            else:
                at += size
        if size > 1 or len(events) == before:
            size //= 2
    return events


def seeds(first: int) -> Iterator[int]:
    """One seed after the other."""
    while True:
        yield first
        first += 1


def campaign(
    layout: str, kernel: type[Calls], steps: int, first_seed: int, most_found: int = 1, habit: str | None = None
) -> Tally:
    """Worlds of one layout, of one habit or of any, until so many steps are run, or so many hazards found."""
    tally = Tally()
    for seed in seeds(first_seed):
        if tally.steps >= steps or len(tally.found) >= most_found:
            return tally
        live(layout, kernel, seed, min(STEPS_A_LIFE, steps - tally.steps), tally, habit)
    raise AssertionError


def _part(task: tuple[str, type[Calls], int, int, int, str | None]) -> tuple[str, Tally]:
    return task[0], campaign(*task)


def campaigns(
    names: Sequence[str],
    kernel: type[Calls],
    steps: int,
    first_seed: int,
    processes: int,
    most_found: int = 1,
    habit: str | None = None,
) -> dict[str, Tally]:
    """The same number of steps on each layout, in several processes."""
    parts = 4 * processes
    each = steps // len(names) // parts + 1
    tasks = [
        (name, kernel, each, first_seed + part * SEED_A_LAYOUT, most_found, habit)
        for part in range(parts)
        for name in names
    ]
    tallies = {name: Tally() for name in names}
    with get_context("spawn").Pool(processes) as pool:
        for name, tally in pool.imap_unordered(_part, tasks):
            tallies[name].add(tally)
    return tallies


def main() -> None:
    """Run a campaign over the present kernel and say what came of it."""
    parser = argparse.ArgumentParser(description="a world that shares nothing with the proof")
    parser.add_argument("--steps", type=int, default=1_000_000)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--kernel", choices=sorted(KERNELS), default=Calls.__name__)
    parser.add_argument("--processes", type=int, default=2)
    given = parser.parse_args()
    began = time.monotonic()
    tallies = campaigns(layouts(), KERNELS[given.kernel], given.steps, given.seed, given.processes)
    everything = Tally()
    for name, tally in tallies.items():
        print(f"{name}: {tally.steps} steps, {tally.worlds} worlds, refused {100 * tally.refused / tally.steps:.1f} %")
        for found in tally.found:
            print(f"  seed {found.seed}: {found.text}, after {len(found.events)} events")
        everything.add(tally)
    seconds = time.monotonic() - began
    print(f"{everything.steps} steps in {seconds:.0f} s, {everything.steps / seconds:.0f} a second")


if __name__ == "__main__":
    main()
