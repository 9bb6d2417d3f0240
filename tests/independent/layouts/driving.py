"""Pairs of trains on surveyed rails, granted and released by the kernel from what the importer made of the file.

Of the imported layout this knows what the kernel is told and where its tags lie.  A train is what it may stand on:
rails behind it as far as its length, rails ahead as far as its route goes.  Wherever the kernel holds its way for
one train and lets another one stand or run, the rails of the two are put beside each other.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace
from typing import NamedTuple

from kernel.centre import Centre
from kernel.claims import held_refusal
from kernel.layout import Layout, TagRecords
from kernel.machine import centre as machine
from kernel.machine.messages import Confirmation, Echo, Permit, Request, Standing, Stopped, TailReport, Tick, ToCentre
from kernel.names import Block, Epoch, Point, Position, Read, Route, Run, Serial, Tag, Train, UnitLife
from kernel.route_setting import request_refusal
from models.layouts import Imported
from tests.independent.layouts.rails import Back, Line, Stretch, Survey, Swept, run, ways_back
from tests.independent.raw_graph import Place
from tests.independent.raw_points import far_end, turned

LENGTHS_MM = (20_000, 150_000, 600_000)
ONE, OTHER = Train("T1"), Train("T2")
LIFE = UnitLife(1)
EMPTY = Centre(
    epoch=Epoch(1),
    newest=Serial(0),
    accounted={},
    runs={},
    claimed={},
    locked={},
    lost_blocks=frozenset(),
    lost_points=frozenset(),
    terminal_life={},
    supervised=frozenset(),
    statements={},
)


class Hazard(NamedTuple):
    """What should not be: its kind, the routes, and where."""

    kind: str
    routes: tuple[str, ...]
    where: str


@dataclass
class Found:
    """What was driven, and what was wrong with it."""

    hazards: list[Hazard] = field(default_factory=list)
    counts: Counter[str] = field(default_factory=Counter)

    def kinds(self) -> Counter[str]:
        return Counter(hazard.kind for hazard in self.hazards)


@dataclass(frozen=True)
class Stand:
    """A train standing before a route: its rails, and the blocks that it has told by its tags."""

    swept: Swept
    blocks: frozenset[Block]


@dataclass(frozen=True)
class Step:
    """A run so far: what the centre holds for it, and the rails that the train may still stand on."""

    centre: Centre
    rest: Swept
    route: Run


@dataclass
class Driver:
    """Drives the routes of one imported layout over the rails of its file."""

    survey: Survey
    layout: Layout
    records: TagRecords
    places: dict[Tag, tuple[str, int] | None]
    found: Found = field(default_factory=Found)

    @staticmethod
    def of(survey: Survey, imported: Imported) -> Driver:
        """What the kernel is told, and the places of the tags on the rails."""
        layout = replace(imported.layout, fleet=frozenset({ONE, OTHER}))
        places = {tag: survey.marks.get(imported.places.tags[tag][0]) for tag in layout.tag_in}
        return Driver(survey, layout, imported.records, places)

    def hazard(self, kind: str, where: str, *routes: str) -> None:
        hazard = Hazard(kind, routes, where)
        if hazard not in self.found.hazards:
            self.found.hazards.append(hazard)

    # ---- one train

    def drive(self) -> Found:
        """Every route alone, and every two of them."""
        alone = {}
        for name in sorted(self.layout.routes):
            line = self.survey.lines.get(name)
            if line is None:
                self.hazard("no such route on the rails", "", name)
                continue
            steps = self.alone(name, line)
            if steps is not None:
                alone[name] = (self.stands(name, line), steps)
        self.found.counts["routes"] += len(alone)
        for one, (_, steps) in alone.items():
            for other, (stands, others) in alone.items():
                self.pair(one, steps, other, stands, others)
                if self.layout.destination[one] == self.layout.start[other]:
                    self.go_on(one, steps[-1], other)
        return self.found

    def go_on(self, one: Route, arrived: Step, other: Route) -> None:
        """A train that has come by one route is granted another, then or at start-up: it leaves as that begins.

        At start-up no point of its block lies against the track that it stands on (`trains_start_apart`).
        """
        network, line, onward = self.survey.network, self.survey.lines[one], self.survey.lines[other]
        start = self.layout.start[other]
        lie = {
            Point(p): Position(at) for p, at in line.positions.items() if self.layout.stands_in.get(Point(p)) == start
        }
        again = self.standing(EMPTY, ONE, frozenset({start}), other, lie)
        came, told = (
            self.granted(centre, other, base) is not None for centre, base in ((arrived.centre, arrived.route), again)
        )
        self.found.counts["granted on arrival"] += came
        self.found.counts["granted at start-up"] += told
        needs = {str(point): str(at) for point, at in self.layout.needs[other].items()}
        here = run(network, line.entry, line.positions, line.last).at
        assert here is not None
        goal = self.first_boundary(other, onward)
        ways = []
        for place in (here, here._replace(heading=-here.heading)):
            gone = run(network, place, needs, onward.until)
            ways.append("" if goal in [place, *gone.places[:1]] else gone.wrong or "over another boundary")
        if (came or told) and all(ways):
            self.hazard(f"led elsewhere {'on arrival' if came else 'at start-up'}", "; ".join(ways), one, other)

    def first_boundary(self, name: Route, line: Line) -> Place:
        """Where a route leaves its start, and which way."""
        if (line.entry.track, line.entry.mm) in self.survey.marks.values():
            return line.entry
        way = run(self.survey.network, line.entry, line.positions, line.until)
        return way.places[0]

    def alone(self, name: Route, line: Line) -> list[Step] | None:
        """A run from its start to its end: held points lead it there, and are held until it has passed them."""
        network, layout = self.survey.network, self.layout
        needs = {str(point): str(at) for point, at in layout.needs[name].items()}
        way = run(network, line.entry, needs, line.until)
        if way.wrong is not None:
            self.hazard("led elsewhere", way.wrong, name)
            return None
        marks = [(line.entry.track, line.entry.mm), *(place for place, _ in way.marks)]
        from_end = layout.tag_in and marks[0] not in self.survey.marks.values()
        last = way.names.index(line.last) if line.last in way.names else len(way.names) - 1
        crossed = marks[1 if from_end else 0 : last + 1]
        tags = self.tags(name)
        pairs = list(zip(tags[::2], tags[1::2], strict=False))
        known = all(self.places[tag] is not None for tag in tags)
        if len(tags) != 2 * len(crossed) or (known and [self.places[t] for t in tags[::2]] != crossed):
            self.hazard("the tags of a route are not those that it passes", "", name)
            return None
        self.leave_start(name, line, needs, from_end=bool(from_end))
        behind = [way.stretches, *(way.behind(at) for at in range(len(way.marks)))][1 if from_end else 0 :]
        at_point = [passing.junction for passing, _ in way.passed]
        ahead = [
            [p for p, (_, after) in zip(at_point, way.passed, strict=True) if after > len(way.stretches) - len(rails)]
            for rails in behind
        ]
        before = [back.stretches for back in ways_back(network, line.entry)] if not from_end else []
        whole = self.survey.swept([*way.stretches, *(each for stretches in before for each in stretches)])
        return list(self.steps(name, pairs, whole, list(zip(behind, ahead, strict=True)), needs))

    def tags(self, name: Route) -> list[Tag]:
        found = [self.layout.first_tag[name]]
        while found[-1] in self.layout.tag_after[name] and len(found) < len(self.layout.tag_in) + 1:
            found.append(self.layout.tag_after[name][found[-1]])
        return found

    def leave_start(self, name: Route, line: Line, needs: dict[str, str], *, from_end: bool) -> None:
        """On whatever track of its start block a train stands: if it is granted the route, it leaves as that begins.

        No point of the block lies against the track that it stands on; all between it and the boundary are held.
        """
        network = self.survey.network
        mouth = line.entry if from_end else turned(line.entry)
        for way in network.ways(network.block_of[network.piece_ahead(mouth)]):
            passed = {p.junction: p.position for p in way.passed if network.junctions[p.junction].moves}
            lie = {Point(point): Position(at) for point, at in passed.items()}
            centre, base = self.standing(EMPTY, ONE, frozenset({self.layout.start[name]}), name, lie)
            if self.granted(centre, name, base) is None:
                continue
            self.found.counts["tracks of start blocks"] += 1
            where = f"from {way.mouth.track} to {way.out or 'where track ends'}"
            if mouth not in (way.mouth, turned(far_end(network, way))):
                self.hazard("led elsewhere from its start", where, name)
            elif not passed.keys() <= needs.keys():
                self.hazard(
                    "a point before the entry is not held", f"{min(passed.keys() - needs.keys())}, {where}", name
                )

    def steps(
        self,
        name: Route,
        pairs: list[tuple[Tag, Tag]],
        whole: Swept,
        behind: list[tuple[list[Stretch], list[str]]],
        needs: dict[str, str],
    ) -> Iterator[Step]:
        """The run as the tail passes boundary after boundary, and as it comes to rest."""
        layout = self.layout
        centre, base = self.standing(EMPTY, ONE, frozenset({layout.start[name]}), name)
        granted = self.granted(centre, name, base)
        if granted is None:
            self.hazard("a route is never granted", str(self.refusal), name)
            return
        centre, route = granted
        yield Step(centre, whole, route)
        left_at = {layout.tag_in[left]: (left, entered) for left, entered in pairs}
        left: set[Block] = set()
        for at, (before, _) in enumerate(pairs):
            left.add(layout.tag_in[before])
            for block in sorted(left):
                if layout.released_after[name].get(block, block) in left:
                    over = [Read(tag, self.records.record[tag]) for tag in left_at[block]]
                    for each in (base, route):
                        centre = self.tell(centre, TailReport(each, block, *over))
            rails, points = behind[at]
            for point in points:
                if any(held.get(route) != needs[point] for known, held in centre.locked.items() if known == point):
                    self.hazard("a point is free before the train has passed it", point, name)
            yield Step(centre, self.survey.swept(rails), route)
        last = self.tell(centre, Stopped(route))
        if layout.overlap[name]:
            yield Step(last, self.survey.swept(self.arrived(name, behind[len(pairs) - 1][0])), route)

    def arrived(self, name: Route, rails: list[Stretch]) -> list[Stretch]:
        """The rails of the destination alone."""
        line, network = self.survey.lines[name], self.survey.network
        at = network.cut(line.last)
        found = []
        for stretch in rails:
            found.append(stretch)
            if stretch[0] == at[0] and at[1] in stretch[1:]:
                return found
        return found

    # ---- the kernel

    def tell(self, centre: Centre, *told: ToCentre) -> Centre:
        """What becomes of the centre by what it is told, one after the other."""
        for each in told:
            centre = machine.answer(self.layout, self.records, centre, each)
        return centre

    def standing(
        self,
        centre: Centre,
        train: Train,
        blocks: frozenset[Block],
        route: Route,
        lie: Mapping[Point, Position] = {},
    ) -> tuple[Centre, Run]:
        """A train that has told after a restart that it stands in these blocks.

        Points there are told to lie as a route needs, but for those that are known to lie otherwise.
        """
        base = machine.next_run(centre, train, LIFE, machine.NO_ROUTE)
        lies = [
            Confirmation(base, point, lie.get(point, position)) for point, position in self.layout.needs[route].items()
        ]
        return self.tell(centre, Standing(train, LIFE, centre.epoch, blocks), *lies), base

    def granted(self, centre: Centre, name: Route, base: Run) -> tuple[Centre, Run] | None:
        """A route requested, its points proved, offered, echoed and set; nothing if the kernel refuses it."""
        layout, route = self.layout, machine.next_run(centre, base.train, LIFE, name)
        self.refusal = request_refusal(layout, centre, route, base)
        if self.refusal is not None:
            return None
        proved = [Confirmation(route, point, position) for point, position in layout.needs[name].items()]
        echo = Echo(route, layout.tag_list[name])
        centre = self.tell(centre, Request(route, base), *proved, Tick(), echo)
        return (centre, route) if Permit(route) in machine.says_of(layout, centre, route) else None

    # ---- two trains

    def stands(self, name: Route, line: Line) -> list[Stand]:
        """A train of each length before a route, at the entry or anywhere back to the boundary behind."""
        network, start = self.survey.network, self.layout.start[name]
        if (line.entry.track, line.entry.mm) not in self.survey.marks.values():
            first = run(network, line.entry, line.positions, line.until)
            rails = first.stretches[: first.marks[0][1]]
            return [Stand(self.survey.swept(rails), frozenset({start}))]
        backs = ways_back(network, line.entry)
        rails = [stretch for back in backs for stretch in back.stretches]
        found = [Stand(self.survey.swept(rails), frozenset({start}))]
        for back in backs:
            room_mm = sum(high - low for _, low, high in back.stretches)
            for length_mm in LENGTHS_MM:
                longer = self.farther(back, length_mm - room_mm, start)
                if longer is not None:
                    found.append(longer)
        return found

    def farther(self, back: Back, more_mm: int, start: Block) -> Stand | None:
        """A train that reaches over the boundary behind its start, into one more block."""
        tags = [tag for tag, at in self.places.items() if at == (back.at.track, back.at.mm)]
        behind = {self.layout.tag_in[tag] for tag in tags} - {start}
        if more_mm <= 0 or len(behind) != 1:
            return None
        place = Place(back.at.track, back.at.mm, back.at.heading)
        for farther in ways_back(self.survey.network, place):
            if sum(high - low for _, low, high in farther.stretches) >= more_mm:
                rails = [*back.stretches, *farther.stretches[:1]]
                track, low, high = rails[-1]
                from_low = place.heading < 0
                rails[-1] = (
                    (track, low, min(high, low + more_mm)) if from_low else (track, max(low, high - more_mm), high)
                )
                return Stand(self.survey.swept(rails), frozenset({start, *behind}))
        return None

    def pair(self, one: Route, steps: list[Step], other: Route, stands: list[Stand], others: list[Step]) -> None:
        """One train runs; wherever the kernel lets the other one stand and then run, they stay clear."""
        layout = self.layout
        for step in steps:
            for stand in stands:
                if held_refusal(layout, step.centre, OTHER, stand.blocks) is not None:
                    continue
                self.found.counts["stands"] += 1
                self.look(step.rest, stand.swept, one, other)
                centre, base = self.standing(step.centre, OTHER, stand.blocks, other)
                if self.granted(centre, other, base) is not None:
                    self.found.counts["pairs"] += 1
                    if step is steps[0] and frozenset((one, other)) in self.survey.declared:
                        self.hazard("a declared conflict is not kept", "", *sorted((one, other)))
                    self.look(step.rest, others[0].rest, one, other)

    def look(self, one: Swept, other: Swept, first: str, second: str) -> None:
        where = self.survey.gauge(one, other)
        if where is not None:
            kind = "foul of each other" if where.startswith("foul") else "on the same rails"
            self.hazard(kind, where, first, second)
