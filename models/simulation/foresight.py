"""A dispatcher's foresight: no train is sent where it would bar the way of one that could still get to its goal.

The kernel keeps trains apart and would let them face each other for ever; that is a matter of the timetable.  Before
a route is asked for, the trains are moved to their goals in thought, one after the other, each by routes that the
others leave free; whoever got there before must still get there with the route set (a banker's rule).
"""

from __future__ import annotations

from collections.abc import Hashable, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from random import Random

from kernel.layout import Layout
from kernel.names import Block, Route, Train
from kernel.refusal import Refusal
from models.simulation.timetable import SLACK, STARTS_S, STAYS_S, USUAL_MM_S, Trip, Ways
from models.simulation.waiting import Barred


@dataclass(frozen=True)
class Standing:
    """Where a train is, or will be when it has run what it was granted, and where it wants to; None: it stays.

    ``ways_on``: of one that lies over several blocks the routes that it can run; None: all that begin in its block.
    """

    blocks: frozenset[Block]
    goal: Block | None
    ways_on: frozenset[Route] | None = None


Board = Mapping[Train, Standing]
AGAIN_S = 120
REMEMBERED = 10_000
"""So many boards are remembered with what they came to: trains ask again and again while nobody has moved."""


class Foresight:
    """Which trains can still get to their goals."""

    def __init__(self, layout: Layout, ways: Ways) -> None:
        self.layout = layout
        self.ways = ways
        self._bit = {block: 1 << at for at, block in enumerate(sorted(layout.blocks))}
        self._needs = {route: self._mask(self._swept(route)) for route in layout.routes}
        self._to_reach = self._needed_by_all()
        self._masks: dict[frozenset[Block], int] = {}
        self._arriving: dict[Hashable, frozenset[Train]] = {}
        self._towards: dict[tuple[Block, Block], list[tuple[int, Block]]] = {}

    def _needed_by_all(self) -> dict[Block, int]:
        """What every route needs that ends in a block: the block itself, at the least."""
        found = dict[Block, int]()
        for route, needs in self._needs.items():
            end = self.layout.destination[route]
            found[end] = found.get(end, needs) & needs
        return found

    def _swept(self, route: Route) -> Iterable[Block]:
        for block in self.layout.claims[route]:
            yield block
            yield from self.layout.fouls.get(block, frozenset())

    def _mask(self, blocks: Iterable[Block]) -> int:
        found = 0
        for block in blocks:
            found |= self._bit[block]
        return found

    def _there(self, blocks: frozenset[Block]) -> int:
        if blocks not in self._masks:
            self._masks[blocks] = self._mask(blocks)
        return self._masks[blocks]

    def arriving(self, board: Board, first: Train) -> frozenset[Train]:
        """The trains that get to their goals, one after the other; one is moved before all others."""
        at = {train: self._there(each.blocks) for train, each in board.items()}
        asked = first, tuple(at.items()), tuple([(each.goal, each.ways_on) for each in board.values()])
        if asked not in self._arriving:
            if len(self._arriving) >= REMEMBERED:
                self._arriving.clear()
            self._arriving[asked] = self._reckoned(board, first, at)
        return self._arriving[asked]

    def _reckoned(self, board: Board, first: Train, at: dict[Train, int]) -> frozenset[Train]:
        order = sorted(board, key=lambda train: train != first)
        left = {train: board[train] for train in order if board[train].goal is not None}
        found: set[Train] = set()
        while True:
            free = next((train for train in left if self._gets_there(train, left[train], at)), None)
            if free is None:
                return frozenset(found)
            goal = left.pop(free).goal
            assert goal is not None
            at[free] = self._bit[goal]
            found.add(free)

    def _gets_there(self, train: Train, standing: Standing, at: Mapping[Train, int]) -> bool:
        """Whether routes that no other train bars lead to the goal."""
        goal, others = standing.goal, 0
        assert goal is not None
        for other, mask in at.items():
            others |= mask if other != train else 0
        if goal in standing.blocks:
            return True
        if self._to_reach.get(goal, 0) & others:
            return False
        todo, seen = list(standing.blocks), set(standing.blocks)
        if standing.ways_on is not None:
            todo = [self.layout.destination[route] for route in standing.ways_on if not self._needs[route] & others]
        while todo:
            block = todo.pop()
            if block == goal:
                return True
            seen.add(block)
            todo += [end for needs, end in self._onward(block, goal) if end not in seen and not needs & others]
        return False

    def _onward(self, block: Block, goal: Block) -> list[tuple[int, Block]]:
        """What the routes from a block towards a goal need, and where they end."""
        if (block, goal) not in self._towards:
            self._towards[block, goal] = [
                (self._needs[route], self.layout.destination[route]) for route in self.ways.towards(block, goal)
            ]
        return self._towards[block, goal]

    def lets(self, board: Board, train: Train, route: Route) -> bool:
        """Tell whether every train that gets to its goal now still does once this one has run a route."""
        run = Standing(frozenset({self.layout.destination[route]}), board[train].goal)
        return self.arriving(board, train) <= self.arriving({**board, train: run}, train)

    def lets_begin(self, board: Board, train: Train, goal: Block) -> bool:
        """Tell whether a train may make for a goal: it gets there, and so do all that did."""
        if goal not in board[train].blocks and self._to_reach.get(goal, 0) & self._never_freed(board, train):
            return False
        begun = self.arriving({**board, train: replace(board[train], goal=goal)}, train)
        return train in begun and self.arriving(board, train) <= begun

    def _never_freed(self, board: Board, train: Train) -> int:
        """The blocks of other trains that stay where they are."""
        found = 0
        for other, standing in board.items():
            if standing.goal is None and other != train:
                found |= self._there(standing.blocks)
        return found

    def barring(self, board: Board, train: Train, goal: Block) -> Barred | None:
        """Who stands on a train's shortest way to a goal, and where; None if nobody does."""
        block = next((each for each in sorted(board[train].blocks) if self.ways.towards(each, goal)), None)
        first, by, where = None, set[Train](), list[str]()
        while block is not None and block != goal:
            route = self.ways.towards(block, goal)[0]
            first = first or route
            for other, standing in sorted(board.items()):
                if other != train and self._there(standing.blocks) & self._needs[route]:
                    by.add(other)
                    where += sorted(standing.blocks)
            block = self.layout.destination[route]
        if first is None or not by:
            return None
        return Barred(first, Refusal.BLOCK_HELD_FOR_ANOTHER, frozenset(by), tuple(dict.fromkeys(where)))


def far(foresight: Foresight, board: Board, train: Train, places: Sequence[Block], random: Random) -> Block | None:
    """Draw a place for which a train may make, of two that were drawn the farther; None if there is none."""
    ways, found = foresight.ways, list[tuple[int, Block]]()
    for place in random.sample(places, len(places)):
        away = [ways.left_mm(block, place) for block in sorted(board[train].blocks)]
        known = [mm for mm in away if mm]
        if known and place not in board[train].blocks and foresight.lets_begin(board, train, place):
            found.append((min(known), place))
        if len(found) == 2:
            break
    return max(found)[1] if found else None


def drawn(
    foresight: Foresight, berths: Mapping[Train, Block], random: Random, hours: float, trips: int | None = None
) -> dict[Train, list[Trip]]:
    """Draw for each train trips from place to place: as many as fit into some hours, or a number of them.

    Made one after the other, in the order of their times, each of them is possible.
    """
    places = foresight.ways.places
    board = {train: Standing(frozenset({block}), None) for train, block in berths.items()}
    found: dict[Train, list[Trip]] = {train: [] for train in berths}
    next_s = {train: random.randint(*STARTS_S) for train in berths}
    while next_s:
        train = min(next_s, key=lambda each: (next_s[each], each))
        begins_s = next_s[train]
        goal = far(foresight, board, train, places, random)
        if goal is None:
            next_s[train] += AGAIN_S
        else:
            found[train].append(Trip(goal, begins_s))
            away_mm = foresight.ways.left_mm(min(board[train].blocks), goal) or 0
            next_s[train] += round(SLACK * away_mm / USUAL_MM_S) + random.randint(*STAYS_S)
            board[train] = Standing(frozenset({goal}), None)
        over = len(found[train]) >= trips if trips is not None else False
        if over or next_s[train] >= hours * 3_600:
            del next_s[train]
    return found
