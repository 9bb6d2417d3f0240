"""What a step of the centre costs on 50,000 blocks, beside a station: the same traffic, in the host's maps."""

from __future__ import annotations

import os
import random
import statistics
import time
from collections import defaultdict
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import replace
from pathlib import Path

from kernel.centre import Centre
from kernel.layout import Layout, TagRecords
from kernel.machine import centre as centre_machine
from kernel.machine.messages import (
    Confirmation,
    Echo,
    Request,
    Standing,
    Stopped,
    TailReport,
    Tick,
    ToCentre,
)
from kernel.names import Block, Read, Route, Run, Tag, Train, UnitLife
from models.host.maps import hosted
from models.layouts import load
from models.layouts.generate import generate
from tests.bench import Figure, percentile

ROOT = Path(__file__).resolve().parents[1]
SHARED = Path(os.environ.get("HEISOKU_LAYOUTS", ROOT.parent / "shared" / "layouts"))
ROUTES = 100_000
RUNS = 1_500
Step = Callable[[Centre], Centre]


class Network:
    """A layout, and what is asked of it again and again."""

    def __init__(self, layout: Layout, records: TagRecords) -> None:
        self.layout, self.records = layout, records
        self.from_block: Mapping[Block, list[Route]] = defaultdict(list)
        for route in sorted(layout.routes):
            self.from_block[layout.start[route]].append(route)
        self.tags: Mapping[Block, list[Tag]] = defaultdict(list)
        for tag, block in layout.tag_in.items():
            self.tags[block].append(tag)

    def left_by(self, route: Route) -> Iterator[tuple[Block, Read, Read]]:
        """The blocks that a train leaves on a route, in order, and what its tail reads there."""
        layout, block = self.layout, self.layout.start[route]
        while block != layout.destination[route]:
            following = layout.way[route][block]
            for tag in self.tags[block]:
                other = layout.partner[tag]
                if layout.tag_in[other] == following:
                    yield block, self.read(tag), self.read(other)
                    break
            block = following

    def read(self, tag: Tag) -> Read:
        """What an antenna reads of a tag."""
        return Read(tag, self.records.record[tag])


class Day:
    """Trains that run route after route; the time of each step of the centre, by its name."""

    def __init__(self, network: Network, trains: int, seed: int, *, plain: bool = False) -> None:
        self.network, self.random = network, random.Random(seed)
        self.host: Step = (lambda centre: centre) if plain else hosted
        self.spent_us: dict[str, list[float]] = defaultdict(list)
        self.trains = [Train(f"T{number}") for number in range(trains)]
        layout = replace(network.layout, fleet=frozenset(self.trains))
        self.layout, self.lives, self.stands = layout, dict.fromkeys(self.trains, 0), dict[Train, Run]()
        self.centre = self.host(centre_machine.start(layout, centre_machine.NEVER_STARTED))

    def tell(self, told: ToCentre) -> bool:
        """Tell the centre something, and take its time; tell whether that changed anything."""
        before, began = self.centre, time.perf_counter_ns()
        self.centre = self.host(centre_machine.answer(self.layout, self.network.records, before, told))
        self.spent_us[type(told).__name__].append((time.perf_counter_ns() - began) / 1000)
        return self.centre is not before

    def stand(self, train: Train) -> None:
        """A train tells where it stands: in a block that routes begin in and that nobody holds."""
        free = sorted(self.network.from_block)
        while True:
            block = self.random.choice(free)
            if not self.centre.claimed.get(block) and not self.layout.points_in.get(block):
                break
        self.lives[train] += 1
        life = UnitLife(self.lives[train])
        run = centre_machine.next_run(self.centre, train, life, centre_machine.NO_ROUTE)
        assert self.tell(Standing(train, life, self.centre.epoch, frozenset({block})))
        self.stands[train] = run

    def run(self, train: Train) -> bool:
        """A train runs one route from where it stands; false if none can be set."""
        base = self.stands[train]
        here = [block for block, holders in self.centre.claimed.items() if base in holders]
        routes = [route for block in here for route in self.network.from_block.get(block, ())]
        for route in self.random.sample(routes, min(3, len(routes))):
            run = centre_machine.next_run(self.centre, train, base.life, route)
            if self.tell(Request(run, base)):
                self.ride(run, base)
                return True
        return False

    def ride(self, run: Run, base: Run) -> None:
        """The run from its first loop to the word that the train stands in its destination."""
        for point, lies in sorted(self.layout.needs[run.route].items()):
            self.tell(Confirmation(run, point, lies))
        self.tell(Tick())
        assert self.tell(Echo(run, self.layout.tag_list[run.route]))
        for block, left, entered in self.network.left_by(run.route):
            for of in (base, run):
                self.tell(TailReport(of, block, left, entered))
        self.tell(Stopped(run))
        self.tell(Tick())
        self.stands[run.train] = run

    def live(self, runs: int) -> int:
        """So many runs, the trains in turn; a train for which no route can be set tells anew where it stands."""
        for train in self.trains:
            self.stand(train)
        assert self.tell(Tick())
        done = 0
        while done < runs:
            train = self.random.choice(self.trains)
            if self.run(train):
                done += 1
            else:
                self.stand(train)
        return done


def figures(what: str, day: Day) -> Iterable[Figure]:
    """All steps of a day together, then each kind."""
    everything = [us for some in day.spent_us.values() for us in some]
    yield Figure(f"{what}: a step", statistics.median(everything), percentile(everything, 95), "µs", len(everything))
    for name, some in sorted(day.spent_us.items()):
        yield Figure(f"  {name}", statistics.median(some), percentile(some, 95), "µs", len(some))


def bench_a_large_network() -> Iterable[Figure]:
    """The same number of runs on both, and what a step costs on the one in terms of the other."""
    path = SHARED / "osrd-small_infra.json"
    if not path.is_file():
        path = ROOT / "layouts" / "junction.toml"
    small, large = load(path), generate(ROUTES)
    days = {}
    for imported in (small, large):
        network = Network(imported.layout, imported.records)
        trains = 8 if imported is large or path.suffix == ".json" else 2
        Day(network, trains, 1).live(50)
        days[imported.name] = day = Day(network, trains, 2)
        day.live(RUNS)
        yield from figures(f"{imported.name}, {len(imported.layout.blocks):,} blocks, {trains} trains", day)
    one, other = ([us for some in day.spent_us.values() for us in some] for day in days.values())
    of_medians = statistics.median(other) / statistics.median(one)
    yield Figure("the large over the small: medians", of_medians, of_medians, "times", RUNS)
    of_means = statistics.fmean(other) / statistics.fmean(one)
    yield Figure("the large over the small: means", of_means, of_means, "times", RUNS)
