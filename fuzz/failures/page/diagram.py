"""The time–distance diagram: steps across, blocks along the line, each car a bar in the blocks it is in."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import groupby

from fuzz.failures.page.moments import held, systems
from fuzz.failures.page.ordering import rows
from fuzz.failures.replaying import Outcome, Replay
from fuzz.failures.trace import TRAFFIC
from kernel.names import Block, Car, Train
from models.world.state import System

COLOURS = ("#1f6fb2", "#d9822b", "#23875a", "#8a5aab", "#0f9bb5", "#8c6d31", "#c2569b", "#5b6770")
"""For trains; no red, which is kept for what is violated."""
WIDTH = 1_222
"""Pixels for names and all steps, if they fit: what a window of 1,280 has."""
COLUMN_LEAST, COLUMN_MOST = 5.0, 34.0
BAR, GAP = 4, 2
ROOMY, CLOSE = (22, 6), (14, 2)
"""A row's least height, and the room above and below its bars: for a few rows, and for many."""
FEW_ROWS = 24
TOP, BOTTOM, CHARACTER, LABEL_MOST = 46, 8, 6.7, 26


@dataclass(frozen=True)
class Stretch:
    """Something that lasts: from after step ``first`` up to step ``end``, in pixels and in words."""

    x: float
    y: float
    width: float
    height: float
    colour: str
    title: str
    kind: str


@dataclass(frozen=True)
class Label:
    """A row of the diagram: its block, the name as it fits, and where."""

    block: str
    text: str
    y: float
    height: float


@dataclass(frozen=True)
class Mark:
    """A step on the axis: its sign and what it says."""

    step: int
    x: float
    kind: str
    title: str


@dataclass(frozen=True)
class Diagram:
    """Everything that is drawn, in pixels.

    ``concerns``: for the start and each step the rows, by number, that it is about.
    """

    column: float
    left: float
    width: float
    height: float
    labels: tuple[Label, ...]
    held: tuple[Stretch, ...]
    cars: tuple[Stretch, ...]
    moves: tuple[Stretch, ...]
    marks: tuple[Mark, ...]
    ticks: tuple[tuple[int, float], ...]
    colours: Mapping[Train, str]
    concerns: tuple[tuple[int, ...], ...]
    left_out: int


class Drawing:
    """A diagram in the making."""

    def __init__(self, replay: Replay) -> None:
        self.replay = replay
        self.moments = systems(replay)
        self.blocks = rows(replay.site, self._touched())
        self.trains = sorted(replay.trace.trains)
        self.colour = {train: COLOURS[at % len(COLOURS)] for at, train in enumerate(self.trains)}
        longest = max((len(block) for block in self.blocks), default=0)
        self.left = round(18 + CHARACTER * min(longest, LABEL_MOST))
        self.column = min(COLUMN_MOST, max(COLUMN_LEAST, (WIDTH - self.left) / len(self.moments)))
        self.stays = {block: self._stays(block) for block in self.blocks}
        self.lanes = {block: self._lanes(block) for block in self.blocks}
        self.top: dict[Block, float] = {}
        self.high: dict[Block, float] = {}
        y, (least, pad) = float(TOP), ROOMY if len(self.blocks) <= FEW_ROWS else CLOSE
        for block in self.blocks:
            lanes = max(self.lanes[block].values(), default=0) + 1
            self.top[block] = y
            self.high[block] = max(least, 2 * pad + (BAR + GAP) * lanes - GAP)
            y += self.high[block]
        self.height = y + BOTTOM

    def drawn(self) -> Diagram:
        """Everything."""
        labels = [Label(block, _short(block), self.top[block], self.high[block]) for block in self.blocks]
        cars = [(train, car) for train in self.trains for car in self.replay.trace.trains[train]]
        return Diagram(
            column=self.column,
            left=self.left,
            width=self.left + self.column * len(self.moments) + 8,
            height=self.height,
            labels=tuple(labels),
            held=tuple(stretch for block in self.blocks for stretch in self._held(block)),
            cars=tuple(stretch for block in self.blocks for stretch in self._cars(block)),
            moves=tuple(move for train, car in cars for move in self._moves(train, car)),
            marks=tuple(self._mark(outcome) for outcome in self.replay.outcomes),
            ticks=tuple(self._ticks()),
            colours={**self.colour},
            concerns=((), *(tuple(self._concerns(outcome)) for outcome in self.replay.outcomes)),
            left_out=len(self.replay.site.layout.blocks - frozenset(self.blocks)),
        )

    def _touched(self) -> set[Block]:
        """The blocks that cars are in, that are held, or that a step names."""
        found: set[Block] = set()
        for system in self.moments:
            found.update(*(blocks for _, blocks in system.track.at.items()))
            found.update(block for block, runs in system.centre.claimed.items() if runs)
        return found

    def _concerns(self, outcome: Outcome) -> Iterator[int]:
        """The rows of the blocks that a step names, of its point's, or of those that its train is in."""
        event, site = outcome.event.event, self.replay.site
        named = {event.get("block"), event.get("target")}
        if "point" in event:
            named.add(site.layout.stands_in.get(event["point"]))
        train = event.get("train")
        if "run" in event:
            train = event["run"].train
        elif "car" in event:
            train = site.formation.train_of.get(event["car"])
        if not named & set(self.blocks):
            cars = self.replay.trace.trains.get(train, ()) if train else ()
            named = {block for each in cars for block in outcome.after.track.at.get(each, frozenset())}
        yield from (row for row, block in enumerate(self.blocks) if block in named)

    def x(self, step: int) -> float:
        """Where the state after a step begins."""
        return round(self.left + self.column * step, 2)

    # ---- cars

    def _stays(self, block: Block) -> dict[tuple[Train, Car], list[tuple[int, int]]]:
        """For each car, from and up to which states it is in a block."""
        found = {}
        for train, cars in sorted(self.replay.trace.trains.items()):
            for car in cars:
                there = [block in system.track.at.get(car, frozenset()) for system in self.moments]
                if any(there):
                    found[train, car] = list(_stretches(there))
        return found

    def _lanes(self, block: Block) -> dict[tuple[Train, Car], int]:
        """A lane for each car; trains that are never there together share theirs."""
        stays, lanes, after = self.stays[block], dict[tuple[Train, Car], int](), 0
        together = any(
            first < other_end and other_first < end
            for one, stretches in stays.items()
            for other, others in stays.items()
            if one[0] < other[0]
            for first, end in stretches
            for other_first, other_end in others
        )
        for _, cars in groupby(stays, key=lambda car: car[0]):
            listed = list(cars)
            lanes |= {car: (after if together else 0) + at for at, car in enumerate(listed)}
            after += len(listed)
        return lanes

    def _bar_y(self, block: Block, train: Train, car: Car) -> float:
        lanes = self.lanes[block]
        used = (BAR + GAP) * (max(lanes.values()) + 1) - GAP
        return self.top[block] + (self.high[block] - used) / 2 + (BAR + GAP) * lanes[train, car]

    def _cars(self, block: Block) -> Iterator[Stretch]:
        for (train, car), stretches in self.stays[block].items():
            for first, end in stretches:
                title = f"{car} of {train} in {block}, {_span(first, end, len(self.moments))}"
                yield Stretch(
                    self.x(first),
                    self._bar_y(block, train, car),
                    round(self.column * (end - first), 2),
                    BAR,
                    self.colour[train],
                    title,
                    "car",
                )

    def _moves(self, train: Train, car: Car) -> Iterator[Stretch]:
        """A thin line from the block that a car was in to the one it comes into."""
        for step in range(1, len(self.moments)):
            before, after = (self._rows_of(self.moments[at], car) for at in (step - 1, step))
            for block in sorted(after - before):
                near = min(before, key=lambda other: abs(self.top[other] - self.top[block]), default=None)
                if near is not None:
                    ends = sorted(self._bar_y(each, train, car) for each in (near, block))
                    height = ends[1] - ends[0] + BAR
                    yield Stretch(self.x(step) - 0.75, ends[0], 1.5, height, self.colour[train], "", "move")

    def _rows_of(self, system: System, car: Car) -> frozenset[Block]:
        return system.track.at.get(car, frozenset()) & frozenset(self.top)

    # ---- what is held

    def _held(self, block: Block) -> Iterator[Stretch]:
        """What the centre holds a block for; hatched where it is lost since a restart."""
        lost = [block in system.centre.lost_blocks for system in self.moments]
        for first, end in _stretches(lost):
            title = f"{block} not recovered since the restart, {_span(first, end, len(self.moments))}"
            yield self._band(block, first, end, 0, 1, "url(#lost)", title, "lost")
        holders = [held(system, block) for system in self.moments]
        at = 0
        for those, group in groupby(holders):
            end = at + len(list(group))
            trains = list(dict.fromkeys(train for train, _ in those))
            for place, train in enumerate(trains):
                routes = ", ".join(f"“{route}”" for other, route in those if other == train)
                title = f"{block} held for {train} ({routes}), {_span(at, end, len(self.moments))}"
                colour = self.colour.get(train, COLOURS[-1])
                yield self._band(block, at, end, place, len(trains), colour, title, "held")
            at = end

    def _band(
        self, block: Block, first: int, end: int, place: int, of: int, colour: str, title: str, kind: str
    ) -> Stretch:
        height = (self.high[block] - 2) / of
        y = self.top[block] + 1 + height * place
        return Stretch(self.x(first), round(y, 2), round(self.column * (end - first), 2), height, colour, title, kind)

    # ---- the axis

    def _mark(self, outcome: Outcome) -> Mark:
        kind = "step"
        if outcome.violated:
            kind = "violation"
        elif outcome.event.beyond:
            kind = "beyond"
        elif outcome.event.by != TRAFFIC:
            kind = "fault"
        elif not outcome.changed:
            kind = "refused"
        x = self.x(outcome.number) + self.column / 2
        return Mark(outcome.number, round(x, 2), kind, f"{outcome.number} {outcome.event.step}")

    def _ticks(self) -> Iterator[tuple[int, float]]:
        """A number every so many steps, so that none touches the next."""
        every = next(size for size in (1, 2, 5, 10, 20, 50, 100, 200, 500, 10**6) if size * self.column >= 30)
        for step in range(0, len(self.moments), every):
            yield step, round(self.x(step) + self.column / 2, 2)


def _stretches(so: Sequence[bool]) -> Iterator[tuple[int, int]]:
    """From and up to where something is so, again and again."""
    at = 0
    for value, group in groupby(so):
        end = at + len(list(group))
        if value:
            yield at, end
        at = end


def _span(first: int, end: int, of: int) -> str:
    since = "from the start" if first == 0 else f"from step {first}"
    return f"{since} on" if end == of else f"{since} to step {end}"


def _short(name: str) -> str:
    return name if len(name) <= LABEL_MOST else name[: LABEL_MOST - 1] + "…"
