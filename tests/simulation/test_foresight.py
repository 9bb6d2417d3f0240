"""What a dispatcher foresees of a train that a fault has stopped over several blocks."""

from __future__ import annotations

from collections import Counter
from dataclasses import replace
from random import Random

import pytest

from kernel.names import Block, Car, Route, Train
from models.simulation.beginning import rails_of
from models.simulation.foresight import Foresight, Standing
from models.simulation.timetable import Ways
from models.simulator.play import site_of
from tests.simulation.lines import imported

STOPPED, OTHER = Train("T01"), Train("T02")
OVER_A1 = frozenset(map(Block, ("B:A0+A1", "stand 1")))


def foresight() -> Foresight:
    place = imported("figure_of_eight")
    site = site_of(place.layout, place.ground, place.records, {STOPPED: (Car("T01.1"),)})
    return Foresight(site.layout, Ways(site.layout, rails_of(place)))


@pytest.mark.parametrize(
    ("ways_on", "gets_there"),
    [({"1 to 2"}, False), ({"1 to 2", "1 back to 4 from B:A0+A1"}, True), (set(), False)],
)
def test_only_the_ways_that_a_train_can_run_count(ways_on: set[str], gets_there: bool) -> None:
    """Past stand 2 it cannot; routes lead from under it to stand 3 over stand 4 too, if it can run them."""
    goal = Block("stand 3")
    board = {
        STOPPED: Standing(OVER_A1, None, frozenset(map(Route, ways_on))),
        OTHER: Standing(frozenset({Block("stand 2")}), None),
    }
    assert foresight().lets_begin(board, STOPPED, goal) is gets_there


def test_a_board_is_not_taken_for_one_on_which_the_train_has_other_ways() -> None:
    """What a board came to is remembered."""
    seen, goal = foresight(), Block("stand 3")
    for ways_on, gets_there in (({"1 to 2"}, False), ({"1 to 2", "1 back to 4 from B:A0+A1"}, True)):
        board = {
            STOPPED: Standing(OVER_A1, None, frozenset(map(Route, ways_on))),
            OTHER: Standing(frozenset({Block("stand 2")}), None),
        }
        assert seen.lets_begin(board, STOPPED, goal) is gets_there


def test_of_the_ways_on_the_shortest_comes_first() -> None:
    ways = foresight().ways
    on = [Route("1 to 2"), Route("1 back to 4 from B:A0+A1")]
    assert ways.shortest_first(on, Block("stand 4")) == list(reversed(on))
    assert ways.shortest_first(on, Block("stand 2")) == on


def test_what_is_seen_at_once_is_what_all_trains_moved_in_thought_come_to() -> None:
    """Of a goal that only a train that stays could free, nobody has to be moved to see that it is out of reach."""
    seen, random, found = foresight(), Random("boards"), Counter[tuple[bool, bool]]()
    blocks = sorted(seen.layout.blocks)
    goals = sorted(set(seen.layout.destination.values()))
    for _ in range(400):
        standing = random.sample(blocks, 4)
        board = {
            Train(f"T{number:02}"): Standing(frozenset({block}), random.choice([None, *goals]))
            for number, block in enumerate(standing, start=1)
        }
        goal = random.choice(goals)
        begun = seen.arriving({**board, STOPPED: replace(board[STOPPED], goal=goal)}, STOPPED)
        lets = STOPPED in begun and seen.arriving(board, STOPPED) <= begun
        assert seen.lets_begin(board, STOPPED, goal) is lets
        found[lets, bool(seen._to_reach[goal] & seen._never_freed(board, STOPPED))] += 1
    assert found[True, False] > 20
    assert found[False, True] > 20


def test_a_route_is_found_wherever_one_leads() -> None:
    """As a search over the routes alone finds it, on boards with three other trains."""
    seen, random, found = foresight(), Random("routes"), Counter[bool]()
    blocks = sorted(seen.layout.blocks)
    goals = sorted(set(seen.layout.destination.values()))
    for _ in range(400):
        at = {Train(f"T{number:02}"): block for number, block in enumerate(random.sample(blocks, 4), start=1)}
        goal = random.choice(goals)
        others = sum({seen._bit[block] for train, block in at.items() if train != STOPPED})
        todo, reached = [at[STOPPED]], {at[STOPPED]}
        while todo:
            block = todo.pop()
            for route in seen.ways.towards(block, goal):
                end = seen.layout.destination[route]
                if end not in reached and not seen._needs[route] & others:
                    reached.add(end)
                    todo.append(end)
        standing = Standing(frozenset({at[STOPPED]}), goal)
        bits = {train: seen._bit[block] for train, block in at.items()}
        assert seen._gets_there(STOPPED, standing, bits) is (goal in reached)
        found[goal in reached] += 1
    assert min(found[True], found[False]) > 20
