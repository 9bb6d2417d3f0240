"""Where a train could go on to, and asking for it; and whether something is still held behind it (T9)."""

from __future__ import annotations

from typing import Any

from fuzz.traffic.compiling import compiled
from fuzz.traffic.entries import both, entry
from fuzz.traffic.messages import (
    NO_RUN,
)
from fuzz.traffic.motion import faces, front_block, rear_block
from fuzz.traffic.places import (
    BLOCKS,
    CENTRE_CLAIMED_VALUE,
    CLAIMS,
    FROM,
    FROM_ROUTE,
    LENGTH,
    RUNS_COUNT,
    RUNS_TRAIN,
    TRAIL,
    UNITS_LIFE,
)
from fuzz.traffic.steps import next_run, put2, take_granting, train_word
from fuzz.traffic.tables import (
    REQUEST,
)
from fuzz.traffic.words import below, get, get1, in_table, of, of2, row


@compiled
def on_trail(desk: Any, train: Any, block: Any) -> Any:
    """Whether a block is on the train's trail."""
    found = False
    for at in range(train_word(desk, train, LENGTH)):
        found = found or train_word(desk, train, TRAIL + at) == block
    return found


@compiled
def holds_elsewhere(memory: Any, desk: Any, train: Any) -> Any:
    """Whether the centre still holds for the train a block that it is not in: a tag was missed, or a word was lost."""
    own = 0
    for run in range(get(memory, desk, RUNS_COUNT)):
        if get1(memory, desk, RUNS_TRAIN, run) == train:
            own |= 1 << run
    for block in range(desk[BLOCKS]):
        if memory[row(desk, CENTRE_CLAIMED_VALUE, block)] & own != 0 and not on_trail(desk, train, block):
            return True
    return False


@compiled
def is_way_on(memory: Any, desk: Any, train: Any, route: Any, block: Any, ahead: Any) -> Any:
    """Whether a route begins for the train in this block at one of its ends and does not come back over it."""
    facing = faces(memory, desk, train, route)
    if ahead and not facing:
        return False
    if block != (front_block(desk, train) if facing else rear_block(desk, train)):
        return False
    for at in range(train_word(desk, train, LENGTH)):
        other = train_word(desk, train, TRAIL + at)
        if other != block and in_table(desk, CLAIMS, route, other):
            return False
    return True


@entry
def way_on(memory_at: Any, desk_at: Any, train: Any, block: Any, ahead: Any) -> Any:
    """Draw a route that begins in a block; -1 where there is none for the train."""
    memory, desk = both(memory_at, desk_at)
    count = of(desk, FROM, block)
    if count == 0:
        return -1
    first = below(desk, count)
    for at in range(count):
        route = of2(desk, FROM_ROUTE, block, (first + at) % count)
        if is_way_on(memory, desk, train, route, block, ahead):
            return route
    return -1


@entry
def ask(memory_at: Any, desk_at: Any, train: Any, route: Any, under: Any) -> Any:
    """Ask for a route; the run, or -1 where it is refused."""
    memory, desk = both(memory_at, desk_at)
    slots = get(memory, desk, RUNS_COUNT)
    run = next_run(memory, desk, train, get1(memory, desk, UNITS_LIFE, train), route)
    put2(memory, desk, run, under)
    return run if take_granting(memory, desk, REQUEST, slots) else NO_RUN
