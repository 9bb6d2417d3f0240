"""A track diagram of one moment, for whoever reads a counterexample: where each block goes on the page."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass

from kernel.names import Block, Point, Run, Train
from models.world.state import Site, System


@dataclass(frozen=True)
class Sign:
    """What is shown of one block at one moment; a line each, in words of the field."""

    block: Block
    cars: str
    trains: tuple[Train, ...]
    held: str
    points: tuple[str, ...]
    lost: bool
    in_danger: bool
    fouls: str

    @property
    def notes(self) -> list[str]:
        """What stands below the track."""
        lost = ["not recovered since the restart"] if self.lost else []
        fouls = [f"fouls {self.fouls}"] if self.fouls else []
        return [*lost, *(self.held.split(", ") if self.held else ["held for nobody"]), *self.points, *fouls]

    def lines(self) -> list[str]:
        """The sign as text."""
        return [str(self.block), self.cars or "empty", *self.notes]


def signs(site: Site, system: System) -> Mapping[Block, Sign]:
    """A sign for every block of the layout, and every other that a car is in or that is held."""
    taken = [block for block in system.centre.claimed if system.centre.claimed[block]]
    blocks = {*site.layout.blocks, *taken, *(block for _, there in system.track.at.items() for block in there)}
    return {block: _sign(site, system, block) for block in sorted(blocks)}


def _sign(site: Site, system: System, block: Block) -> Sign:
    cars = sorted(car for car, there in system.track.at.items() if block in there)
    trains = tuple(sorted({site.formation.train_of[car] for car in cars if car in site.formation.train_of}))
    holders = sorted(system.centre.claimed.get(block, frozenset()))
    beside = sorted(site.layout.fouls.get(block, frozenset()))
    forgotten = bool(trains) and not holders and block not in system.centre.lost_blocks
    return Sign(
        block,
        ", ".join(f"{car} of {site.formation.train_of.get(car, '?')}" for car in cars),
        trains,
        ", ".join(f"held for {in_words(run)}" for run in holders),
        tuple(_point(site, system, point) for point in sorted(site.layout.points_in.get(block, frozenset()))),
        block in system.centre.lost_blocks,
        forgotten or len(_trains(site, system, {block, *beside})) > 1,
        ", ".join(beside),
    )


def _trains(site: Site, system: System, blocks: set[Block]) -> set[Train]:
    """The trains that are in some blocks, or for which these are held."""
    held = {run.train for block in blocks for run in system.centre.claimed.get(block, frozenset())}
    there = {car for car, places in system.track.at.items() if places & blocks}
    return held | {site.formation.train_of[car] for car in there if car in site.formation.train_of}


def _point(site: Site, system: System, point: Point) -> str:
    terminal = system.terminals.get(point)
    state = "no terminal" if terminal is None else "UNLOCKED" if terminal.unlocked else "locked"
    holders = [f"#{run.serial}" for run in sorted(system.centre.locked.get(point, {}))]
    lost = ", lost" if point in system.centre.lost_points else ""
    locked_for = f", held for {' '.join(holders)}" if holders else ""
    return f"{point} lies {system.track.lies.get(point, '?')}, {state}{locked_for}{lost}"


def in_words(run: Run) -> str:
    """A run as an engineer writes it."""
    return f"#{run.serial} {run.train} “{run.route}”"


@dataclass(frozen=True)
class Plan:
    """Column and lane of every block, and which of them adjoin."""

    at: Mapping[Block, tuple[int, int]]
    joined: tuple[tuple[Block, Block], ...]

    @property
    def columns(self) -> int:
        """How wide it is."""
        return 1 + max((column for column, _ in self.at.values()), default=0)

    @property
    def lanes(self) -> int:
        """How high it is."""
        return 1 + max((lane for _, lane in self.at.values()), default=0)


def plan(site: Site, blocks: Iterable[Block], run: Run | None = None) -> Plan:
    """Put blocks in columns along the line and in lanes side by side; ``run`` goes to the right.

    Stretches of track without a join lie one below the other.
    """
    names = sorted(blocks)
    joined = tuple(
        (one, other) for one in names for other in sorted(site.ground.neighbours.get(one, frozenset())) if one < other
    )
    joined = tuple(pair for pair in joined if pair[1] in names)
    at: dict[Block, tuple[int, int]] = {}
    for part in _parts(names, joined):
        below = 1 + max((lane for _, lane in at.values()), default=-1)
        columns = _columns(part, joined)
        if run is not None and _goes_left(site, run, columns):
            columns = {block: max(columns.values()) - column for block, column in columns.items()}
        for block in sorted(part, key=lambda name: (columns[name], name)):
            wanted = _lane_wanted(block, joined, at, below)
            free = (lane for lane in (wanted, *range(below, below + len(names))))
            at[block] = (columns[block], next(lane for lane in free if (columns[block], lane) not in at.values()))
    return Plan(at, joined)


Pairs = tuple[tuple[Block, Block], ...]


def _near(block: Block, joined: Pairs) -> list[Block]:
    return [other if one == block else one for one, other in joined if block in (one, other)]


def _parts(names: list[Block], joined: Pairs) -> list[list[Block]]:
    """Stretches of track that are joined, the longest first."""
    found: list[list[Block]] = []
    for name in names:
        if not any(name in part for part in found):
            part = [name]
            for block in part:
                part += [other for other in _near(block, joined) if other not in part]
            found.append(part)
    return sorted(found, key=lambda part: -len(part))


def _columns(part: list[Block], joined: Pairs) -> dict[Block, int]:
    """Each block one column beyond the block it is reached from, starting at an end of the line."""
    first = min(part, key=lambda name: (len(_near(name, joined)) != 1, name))
    found = {first: 0}
    todo = [first]
    for block in todo:
        for other in _near(block, joined):
            if other not in found:
                found[other] = found[block] + 1
                todo.append(other)
    return found


def _goes_left(site: Site, run: Run, columns: Mapping[Block, int]) -> bool:
    """Whether most of a run's way leads to lower columns."""
    way = site.layout.way.get(run.route, {})
    steps = [columns[way[block]] - columns[block] for block in way if block in columns and way[block] in columns]
    return sum(steps) < 0


def _lane_wanted(block: Block, joined: Pairs, at: Mapping[Block, tuple[int, int]], below: int) -> int:
    """The lane of a neighbour that is placed already, if any."""
    return min((at[other][1] for other in _near(block, joined) if other in at), default=below)
