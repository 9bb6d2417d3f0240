"""A concrete train's day: routes are set for it, it drives, stops, slips, turns, parts, misses tags, restarts."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from random import Random

from kernel.machine.messages import Request, Tick, Withdrawal
from kernel.names import Block, Car, Route, Run, Train
from models.concrete.drive import Drive
from models.concrete.rails import Piece, Rails
from models.concrete.train import CAR_MM, OnRails
from models.layouts.results import Imported
from models.simulator import messages
from models.simulator.machines import next_run, tell_centre
from models.simulator.play import begin, site_of

MARGIN_MM = 4_000
"""How far from the end of its destination a train comes to rest at the latest, if it does not slip."""


def place(
    imported: Imported, formed: Mapping[Train, Sequence[Car]], where: Mapping[Train, Block], eastward: Route, seed: int
) -> Drive:
    """Concrete trains, each in one block, facing as a route named does; every one has told where it stands."""
    random, rails = Random(seed), Rails(imported)
    site = site_of(imported.layout, imported.ground, imported.records, formed)
    play = begin(site, formed, where)
    trains = []
    for name, cars in formed.items():
        heading = rails.start_of(where[name])
        length, train_mm = rails.length_mm(heading), CAR_MM * len(cars)
        front = random.randint(train_mm + 1, length - 1)
        facing = next_run(play, name, eastward)
        order = list(cars) if site.formation.last[facing] == cars[-1] else list(reversed(cars))
        trains.append(OnRails(name, order, [Piece(heading, 0, length)], front, random))
    return Drive(play, rails, trains, random)


class Journeys:
    """All trains of a drive, one after the other, each a route at a time."""

    def __init__(self, drive: Drive) -> None:
        self.drive = drive
        self.random = drive.random
        self.base: dict[Train, Run | None] = {train.name: None for train in drive.trains}

    def tell_all(self) -> None:
        """Every train that has no run tells where it stands; what is lost is found again."""
        for train in self.drive.trains:
            if self.base[train.name] is None:
                self.base[train.name] = messages.tell(self.drive.play, train.name, self.random)
        tell_centre(self.drive.play, Tick())

    def go(self, train: OnRails) -> bool:
        """One route for a train, if there is one for it now; tell whether it ran."""
        self.tell_all()
        base, play = self.base[train.name], self.drive.play
        routes = self.routes(train)
        self.random.shuffle(routes)
        for route in routes:
            run = next_run(play, train.name, route)
            assert base is not None
            if tell_centre(play, Request(run, base)):
                return self.set_and_run(train, run)
        return False

    def routes(self, train: OnRails) -> list[Route]:
        """The routes that begin where the train's end in their direction is, and do not come back over it."""
        layout, base = self.drive.play.site.layout, self.base[train.name]
        blocks = train.blocks(self.drive.rails)
        under = frozenset(block for found in blocks.values() for block in found)
        assert base is not None
        found = []
        for route in sorted(layout.routes):
            facing = self.faces(train, base._replace(route=route))
            car = train.cars[0] if facing else train.cars[-1]
            if train.standing and not facing:
                continue
            if blocks[car] & layout.claims[route] == {layout.start[route]} == under & layout.claims[route]:
                found.append(route)
        return found

    def faces(self, train: OnRails, run: Run) -> bool:
        """Whether the first car leads in the direction of a run."""
        ahead = self.drive.play.site.formation.ahead[run]
        return len(ahead[train.cars[0]]) <= len(ahead[train.cars[-1]]) and not (
            len(train.cars) == 1 and len(ahead[train.cars[0]]) > 0
        )

    def set_and_run(self, train: OnRails, run: Run) -> bool:
        """The route is set, the train turns if it must, and drives."""
        play = self.drive.play
        for _ in range(20):
            messages.converse(play, train.name, self.random, 0.1)
            if messages.is_permitted(play, run):
                break
        else:
            tell_centre(play, Withdrawal(run))
            return False
        if not self.faces(train, run):
            train.turn()
            self.drive.seen["turns"] += 1
        play.take("change_ends", train=train.name, cab=play.site.formation.front[run])
        self.drive_through(train, run)
        return True

    def drive_through(self, train: OnRails, run: Run) -> None:
        """Drive, sample by sample, to somewhere in the destination; stop now and then on the way."""
        play, drive = self.drive.play, self.drive
        destination = play.site.layout.destination[run.route]
        play.take("start_rolling", run=run)
        room = train.room_mm(drive.rails, destination, play.system.track.lies)
        left = room - self.random.randint(MARGIN_MM, MARGIN_MM + 60_000)
        speed = self.random.choice([8_000, 30_000, 120_000])
        while left > 0 and not play.system.units[train.name].loop_open:
            step = min(left, self.random.randint(1, speed))
            drive.move(train, run, step)
            left -= step
            if self.random.random() < 0.05 and not play.system.units[train.name].loop_open:
                self.stops_on_the_way(train, run)
            if self.random.random() < 0.2:
                messages.converse(play, train.name, self.random, 0.1)
        if play.system.units[train.name].loop_open:
            self.brakes(train, run)
            return
        if self.random.random() < 0.2 and play.site.layout.overlap[run.route]:
            self.slips(train, run)
            return
        self.arrives(train, run)

    def stops_on_the_way(self, train: OnRails, run: Run) -> None:
        """Stand for a while under authority."""
        self.rest(train)
        self.drive.seen["stops"] += 1
        self.drive.play.take("start_rolling", run=run)

    def rest(self, train: OnRails) -> None:
        """The train stands still."""
        for run in [run for run in self.drive.play.system.track.rolling if run.train == train.name]:
            self.drive.play.take("come_to_rest", run=run)

    def brakes(self, train: OnRails, run: Run) -> None:
        """The loop opened while it rolled: it comes to rest inside the authority it had, and restarts."""
        lies, destination = self.drive.play.system.track.lies, self.drive.play.site.layout.destination[run.route]
        room = train.room_mm(self.drive.rails, destination, lies)
        self.drive.move(train, run, max(0, min(room - MARGIN_MM, self.random.randint(0, 150_000))))
        self.rest(train)
        self.drive.seen["brakes"] += 1
        self.base[train.name] = None

    def slips(self, train: OnRails, run: Run) -> None:
        """Braking too late it slips into the overlap, and has to tell where it stands."""
        play, layout = self.drive.play, self.drive.play.site.layout
        play.take("overrun", run=run)
        last = next(block for block in layout.overlap[run.route] if block not in layout.way[run.route])
        room = train.room_mm(self.drive.rails, last, play.system.track.lies)
        self.drive.move(train, run, max(0, min(room - 1_000, self.random.randint(1, 60_000))))
        self.rest(train)
        self.drive.seen["slips"] += 1
        self.base[train.name] = None

    def arrives(self, train: OnRails, run: Run) -> None:
        """At rest in the destination: the overlap is freed, what was left is reported."""
        play = self.drive.play
        self.rest(train)
        messages.stop(play, run, self.random)
        for _ in range(3):
            messages.converse(play, train.name, self.random, 0.1)
        self.base[train.name] = run
        held = {b for b, runs in play.system.centre.claimed.items() if any(r.train == train.name for r in runs)}
        under = {b for blocks in train.blocks(self.drive.rails).values() for b in blocks}
        self.drive.seen["arrivals"] += 1
        if held - under and self.random.random() < 0.7:
            self.base[train.name] = None

    def parts(self, train: OnRails) -> None:
        """A coupling breaks: from now on the rear cars stand where they are."""
        if len(train.cars) > 1 and not train.standing:
            self.drive.play.take("part", train=train.name)
            train.part(self.drive.rails, self.random.randint(1, len(train.cars) - 1))
            self.drive.seen["parts"] += 1
