"""The driver's own memory for one site: places of the state's arrays, and what the layout says as dense tables."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from fuzz.compiled.domains import FOREIGN, RUN_SLOTS
from fuzz.compiled.memory import Memory
from fuzz.traffic import places, tables
from fuzz.traffic.distributions import QUANTILES, WHOLE
from fuzz.traffic.driver import BY_SECOND, IS_BEYOND
from fuzz.traffic.faults import FAULTS
from fuzz.traffic.steps import LOG_HEAD, PAIR_BITS, REGISTER_BITS, STAGES
from kernel.machine.centre import NO_ROUTE
from kernel.names import Position, Route, Run, Serial, Train, UnitLife
from kernel.refusal import Refusal
from models.world.state import Site

Ints = npt.NDArray[np.int64]
BITS = 64
NONE = -1
MOST_EVENTS = 4096
"""A trace ends after so many steps that changed something; its log has that many rows."""


@dataclass(frozen=True)
class Desk:
    """A desk and where its tables are, by name."""

    words: Ints
    tables: Mapping[str, Ints]
    log_width: int

    def reset(self) -> None:
        """Nothing counted: what a batch begins with."""
        for name in ("hits", "pairs", "sketch"):
            self.tables[name][:] = 0
        self.words[places.DRAWN : places.DRAWN + 2 * places.COUNT] = 0
        self.words[places.STANDSTILL : places.STANDSTILL + places.CAUSES] = 0
        self.words[places.DECISIONS] = 0
        trains = self.words[places.TRAIN : places.TRAIN + (places.MOST_TRAINS + 1) * places.TRAIN_WORDS]
        trains[:] = 0

    def weigh(self, weights: Sequence[float]) -> None:
        """Set how many traces have each fault; ``weights`` multiply the declared shares, none leave them alone."""
        assert len(weights) in (0, len(FAULTS)), f"{len(weights)} weights for {len(FAULTS)} faults"
        assert all(weight >= 0 for weight in weights), weights
        for at, fault in enumerate(FAULTS):
            share = fault.present * (weights[at] if len(weights) else 1.0)
            self.tables["weighted"][at] = min(WHOLE, round(share * WHOLE))


def desk_for(memory: Memory) -> Desk:
    """Lay out the desk of a site."""
    assert len(memory.domains.names["Train"]) <= places.MOST_TRAINS, "too many trains"
    assert all(len(cars) <= places.MOST_CARS for cars in cars_of(memory.site).values()), "too long a train"
    made = {**_of_routes(memory), **_of_ground(memory), **_of_trains(memory), **_of_events(memory), **_of_faults()}
    block_words = _block_words(memory)
    width = LOG_HEAD + max(
        sum(4 if each == tables.IS_RUN else 1 for each in tables.word_types(kind, block_words))
        for kind in range(tables.KINDS)
    )
    made |= {
        "hits": np.zeros(tables.KINDS * STAGES * (len(Refusal) + 2), np.int64),
        "pairs": np.zeros(1 << PAIR_BITS, np.int64),
        "sketch": np.zeros(1 << REGISTER_BITS, np.int64),
        "log": np.zeros((MOST_EVENTS + 1, width), np.int64),
    }
    assert set(made) == set(places.TABLES), set(made) ^ set(places.TABLES)
    words = np.zeros(places.TABLES_FROM + sum(each.size for each in made.values()), np.int64)
    shown, at = {}, places.TABLES_FROM
    for number, name in enumerate(places.TABLES):
        table = made[name]
        _place(words, places.MOST_FIELDS + number, at, table.shape)
        shown[name] = words[at : at + table.size].reshape(table.shape)
        shown[name][:] = table
        at += table.size
    for number, name in enumerate(places.FIELDS):
        _place(words, number, memory.arrays[name].base, memory.arrays[name].shape)
    desk = Desk(words, shown, width)
    _header(memory, desk, block_words)
    desk.weigh(())
    return desk


def cars_of(site: Site) -> dict[str, list[str]]:
    """Every train's cars, in the order of the formation: the first leads in the routes that run along."""
    cars: dict[str, list[str]] = {str(train): [] for train in sorted(site.layout.fleet)}
    for car, train in site.formation.train_of.items():
        cars[train].append(car)
    return cars


def _block_words(memory: Memory) -> int:
    """How many words a set of blocks has."""
    return memory.arrays["units_occupied"].shape[-1]


def _place(words: Ints, number: int, at: int, shape: tuple[int, ...]) -> None:
    """Note where an array begins, and how far apart its rows are."""
    strides = [int(np.prod(shape[axis + 1 :])) for axis in range(min(3, len(shape)))]
    words[places.PLACES + 4 * number : places.PLACES + 4 * number + 1 + len(strides)] = [at, *strides]


def _header(memory: Memory, desk: Desk, block_words: int) -> None:
    """Write what the header says of a site, and the limits of a trace."""
    names = memory.domains.names
    values = {
        places.EVENT: memory.event.base,
        places.BROKEN_NOW: memory.arrays["broken"].base,
        places.STATE_HASH: memory.arrays["state_hash"].base,
        places.TRAINS: len(names["Train"]),
        places.BLOCK_WORDS: block_words,
        places.BLOCKS: len(names["Block"]),
        places.ROUTES: len(names["Route"]),
        places.POINTS: len(names.get("Point", ())),
        places.TAGS: len(names["Tag"]),
        places.RECORDS: len(names["Record"]),
        places.TAG_LISTS: len(names["TagList"]),
        places.CARS: len(names["Car"]),
        places.CABS: len(names["Cab"]),
        places.POSITIONS: len(names["Position"]),
        places.FOREIGN_TAG: memory.domains.numbers["Tag"][FOREIGN],
        places.FOREIGN_RECORD: memory.domains.numbers["Record"][FOREIGN],
        places.STANDING: memory.domains.numbers["Route"][NO_ROUTE],
        places.LAST_SERIAL: memory.site.layout.last_serial,
        places.REFUSALS: len(Refusal),
        places.LOG_WIDTH: desk.log_width,
        places.MOST_STEPS: 60_000,
        places.MOST_ACCEPTED: MOST_EVENTS,
        places.MOST_SECONDS: 6 * 3600,
    }
    for at, value in values.items():
        desk.words[at] = value


def _bits(numbers: Iterable[int], words: int) -> list[int]:
    """A set of numbers as words of bits."""
    row = [0] * words
    for number in numbers:
        row[number // BITS] |= 1 << (number % BITS)
    return [word - (1 << BITS) if word >> (BITS - 1) else word for word in row]


def _lists(rows: Sequence[Sequence[int]]) -> tuple[Ints, Ints]:
    """Lists of different lengths: how long each is, and all of them in one table."""
    counts = np.array([len(row) for row in rows], np.int64)
    table = np.full((len(rows), max(1, int(counts.max(initial=1)))), NONE, np.int64)
    for at, row in enumerate(rows):
        table[at, : len(row)] = row
    return counts, table


def _of_routes(memory: Memory) -> dict[str, Ints]:
    """Where each route leads, what it claims, and which points it needs."""
    layout, number = memory.site.layout, memory.domains.numbers
    names: Mapping[str, Any] = memory.domains.names
    routes, blocks, points = names["Route"], names["Block"], names.get("Point", ())
    words = _block_words(memory)
    made = {
        "way": np.full((len(routes), len(blocks)), NONE, np.int64),
        "boundary": np.full((len(routes), len(blocks)), NONE, np.int64),
        "start": np.full(len(routes), NONE, np.int64),
        "destination": np.full(len(routes), NONE, np.int64),
        "claims": np.zeros((len(routes), words), np.int64),
        "overlap": np.zeros((len(routes), words), np.int64),
        "need": np.full((len(routes), max(1, len(points))), NONE, np.int64),
    }
    needed: list[list[int]] = [[] for _ in routes]
    start: list[list[int]] = [[] for _ in blocks]
    for at, route in ((at, Route(name)) for at, name in enumerate(routes) if name in layout.routes):
        made["start"][at] = number["Block"][layout.start[route]]
        made["destination"][at] = number["Block"][layout.destination[route]]
        made["claims"][at] = _bits((number["Block"][block] for block in layout.claims[route]), words)
        made["overlap"][at] = _bits((number["Block"][block] for block in layout.overlap[route]), words)
        start[made["start"][at]].append(at)
        for block, target in layout.way[route].items():
            made["way"][at, number["Block"][block]] = number["Block"][target]
            tag = _boundary(memory, route, block)
            made["boundary"][at, number["Block"][block]] = NONE if tag is None else number["Tag"][tag]
        for point, position in sorted(layout.needs[route].items()):
            made["need"][at, number["Point"][point]] = number["Position"][position]
            needed[at].append(number["Point"][point])
    made["needs"], made["needed"] = _lists(needed)
    made["from"], made["from_route"] = _lists(start)
    return made


def _boundary(memory: Memory, route: Route, block: Any) -> Any:
    """The tag on a route at the end of a block; none where its list ends before."""
    layout = memory.site.layout
    tag = layout.first_tag.get(route)
    while tag is not None:
        if layout.tag_in[tag] == block and layout.tag_in[layout.partner[tag]] == layout.way[route].get(block):
            return tag
        tag = layout.tag_after[route].get(tag)
    return None


def _of_ground(memory: Memory) -> dict[str, Ints]:
    """Tags, points, neighbours, and where trains may begin."""
    site, number = memory.site, memory.domains.numbers
    names: Mapping[str, Any] = memory.domains.names
    layout, blocks, tags, points = site.layout, names["Block"], names["Tag"], names.get("Point", ())
    words = _block_words(memory)
    legs: list[list[int]] = [_legs(memory, point) for point in points]
    starts = sorted({layout.start[route] for route in layout.routes})
    plain = [number["Block"][block] for block in starts if not layout.points_in.get(block)]
    others = [number["Block"][block] for block in starts if layout.points_in.get(block)]
    made = {
        "partner": np.array([number["Tag"].get(layout.partner.get(tag, ""), NONE) for tag in tags], np.int64),
        "tag_in": np.array([number["Block"].get(layout.tag_in.get(tag, ""), NONE) for tag in tags], np.int64),
        "record": np.array(
            [number["Record"][site.records.record.get(tag, FOREIGN)] for tag in tags],
            np.int64,
        ),
        "stands_in": np.array([number["Block"][layout.stands_in[point]] for point in points] or [NONE], np.int64),
        "fouls": np.array(
            [
                _bits({at, *(number["Block"][each] for each in layout.fouls.get(block, ()))}, words)
                for at, block in enumerate(blocks)
            ],
            np.int64,
        ),
        "berths": np.array([len(starts)], np.int64),
        "berth": np.array(plain + others, np.int64),
        "plain": np.array([len(plain)], np.int64),
        "start_lies": np.zeros(max(1, len(points)), np.int64),
    }
    made["legs"], made["leg"] = _lists(legs or [[]])
    neighbours = [[number["Block"][each] for each in sorted(site.ground.neighbours.get(block, ()))] for block in blocks]
    made["neighbours"], made["neighbour"] = _lists([row or [at] for at, row in enumerate(neighbours)])
    return made


def _legs(memory: Memory, point: Any) -> list[int]:
    """Every position that a point can lie in, by routes and track; the first needed one first."""
    site, found = memory.site, dict[Position, None]()
    for route in sorted(site.layout.routes):
        if point in site.layout.needs[route]:
            found.setdefault(site.layout.needs[route][point])
    for ways in site.ground.leads.values():
        for targets in ways.values():
            for demands in targets.values():
                if point in demands:
                    found.setdefault(demands[point])
    found.setdefault(Position("normal")) if not found else None
    return [memory.domains.numbers["Position"][position] for position in found]


def _of_trains(memory: Memory) -> dict[str, Ints]:
    """The cars of each train, and which leads in which route."""
    site, number = memory.site, memory.domains.numbers
    names: Mapping[str, Any] = memory.domains.names
    listed = cars_of(site)
    cars = [[number["Car"][car] for car in listed[train]] for train in names["Train"]]
    leading = np.zeros((len(names["Route"]), len(cars)), np.int64)
    for at, route in enumerate(names["Route"]):
        for place, train in enumerate(names["Train"]):
            last = site.formation.last[Run(Serial(0), Train(train), UnitLife(0), Route(route))]
            leading[at, place] = int(listed[train][-1] == last)
    made = {
        "leading": leading,
        "cab": np.array([number["Cab"][site.formation.cab[car]] for car in names["Car"]], np.int64),
        "train_of": np.array([number["Train"][site.formation.train_of[car]] for car in names["Car"]], np.int64),
        "start_at": np.full(len(names["Car"]), NONE, np.int64),
    }
    made["car_count"], made["car"] = _lists(cars)
    return made


def _of_events(memory: Memory) -> dict[str, Ints]:
    """What the words of each kind of event are, and where telegrams arrive from."""
    types = [tables.word_types(kind, _block_words(memory)) for kind in range(tables.KINDS)]
    made = dict(zip(("words", "types"), _lists(types), strict=True))
    made["run_at"] = np.array([row.index(tables.IS_RUN) if tables.IS_RUN in row else NONE for row in types], np.int64)
    by = [next((at for at, each in enumerate(row) if each in _TRAINS), NONE) for row in types]
    made["train_at"] = np.array(by, np.int64)
    made["train_by"] = np.array([row[at] if at >= 0 else NONE for row, at in zip(types, by, strict=True)], np.int64)
    rows = []
    for name, array, axes, bit in tables.ARRIVALS:
        shape = memory.arrays[array].shape
        assert shape[-1] == 1, f"{array}: its bits take more than a word"
        assert RUN_SLOTS <= BITS
        sizes = (*shape[:-1], 1, 1)[:2]
        words = (*axes, NONE, NONE)[:2]
        rows.append([tables.NUMBERS[name], places.FIELDS.index(array), *sizes, *words, bit, 0])
    made["arrivals"] = np.array(rows, np.int64)
    return made


_TRAINS = (tables.IS_RUN, tables.IS_TRAIN, tables.IS_CAR)


def _of_faults() -> dict[str, Ints]:
    """How often each fault comes, and of which sort it is."""
    assert all(len(fault.rate.chances()) == QUANTILES for fault in FAULTS)
    sort = [(BY_SECOND if fault.per == "second" else 0) | (IS_BEYOND if fault.beyond else 0) for fault in FAULTS]
    return {
        "quantile": np.array([fault.rate.chances() for fault in FAULTS], np.int64),
        "weighted": np.zeros(len(FAULTS), np.int64),
        "fault_is": np.array(sort, np.int64),
    }
