"""Conversations of centre, train and terminals; what got lost is sent again at the next try (T4, T8, T10)."""

from __future__ import annotations

from typing import Any

from fuzz.traffic.air import arrive, strikes
from fuzz.traffic.compiling import compiled
from fuzz.traffic.entries import both, entry
from fuzz.traffic.faults import number
from fuzz.traffic.motion import front_block
from fuzz.traffic.places import (
    BLOCK_WORDS,
    BLOCKS,
    CENTRE_CLAIMED_VALUE,
    CENTRE_RUNS,
    CENTRE_RUNS_PROVED,
    CENTRE_RUNS_STAGE,
    CENTRE_TERMINAL_LIFE,
    CENTRE_TERMINAL_LIFE_VALUE,
    CLOCK,
    DESTINATION,
    EVENT,
    LEG,
    LEGS,
    NEED,
    NEEDED,
    NEEDS,
    OVERLAP,
    RUNS_COUNT,
    RUNS_TRAIN,
    STUCK_UNTIL,
    TAG_LISTS,
    TERMINALS_LIFE,
    TERMINALS_UNLOCKED,
    TERMINALS_WANTED,
    TRACK_LIES_VALUE,
    UNITS_GIVEN_BACK,
    UNITS_LEFT,
    UNITS_LEFT_ENTERED_RECORD,
    UNITS_LEFT_ENTERED_TAG,
    UNITS_LEFT_LEFT_RECORD,
    UNITS_LEFT_LEFT_TAG,
    UNITS_ORDERS,
    UNITS_PERMITTED,
    UNITS_TAG_LIST,
)
from fuzz.traffic.senses import put_standing, put_stopped
from fuzz.traffic.steps import (
    list_of,
    put2,
    put3,
    put4,
    put5,
    route_of,
    take,
    take1,
    take2,
    take3,
    take_beyond,
)
from fuzz.traffic.tables import (
    DRIFT,
    GIVE_BACK,
    LOCK,
    NOTE_CONFIRMATION,
    NOTE_ECHO,
    NOTE_GIVEN_BACK,
    NOTE_STOPPED,
    NOTE_TERMINAL_LIFE,
    OBEY_ORDER,
    OPEN_FIRST_LOOP,
    RECALL,
    RELAY_CONFIRMATION,
    RELAY_ORDER,
    RELEASE_BLOCK,
    RELEASE_OVERLAP,
    RETIRE,
    SEND_CONFIRMATION,
    SEND_ECHO,
    SEND_OFFER,
    SEND_ORDER,
    SEND_PERMIT,
    SEND_RECALL,
    SEND_RETURN,
    SEND_STOP,
    SEND_TAIL_REPORT,
    SEND_TERMINAL_LIFE,
    TAKE_OFFER,
    TAKE_PERMIT,
)
from fuzz.traffic.words import below, bit, cell, get, get1, get2, get3, has, has1, of, of2, one_in, row

RESERVED, OFFERED, SET, STANDS, OVER = range(5)
"""Stages of a run at the centre, in the order of the kernel's ``Stage``."""
NO_RUN = -1
MIXED_UP = number("lists mixed up")
DOUBT = number("place not known")
STUCK, LATE_CONTACTS = number("point does not move"), number("late point detection")
NO_CONTACTS = number("no point detection")
FALSE_CONTACTS = number("false point detection")


@compiled
def stage(memory: Any, desk: Any, run: Any) -> Any:
    """How far the centre has come with a run; -1 where it does not have it."""
    if run < 0 or not has(memory, desk, CENTRE_RUNS, run):
        return -1
    return get1(memory, desk, CENTRE_RUNS_STAGE, run)


@compiled
def has_order(memory: Any, desk: Any, train: Any, run: Any) -> Any:
    """Whether a unit knows a run."""
    return has1(memory, desk, UNITS_ORDERS, train, run)


@compiled
def may_go(memory: Any, desk: Any, train: Any, run: Any) -> Any:
    """Whether a run is permitted and not given back."""
    return (
        has_order(memory, desk, train, run)
        and get2(memory, desk, UNITS_PERMITTED, train, run) == 1
        and get2(memory, desk, UNITS_GIVEN_BACK, train, run) == 0
    )


@compiled
def claimed_by(memory: Any, desk: Any, block: Any, run: Any) -> Any:
    """Whether the centre holds a block for a run."""
    return has1(memory, desk, CENTRE_CLAIMED_VALUE, block, run)


# ---- points


@entry
def hear(memory_at: Any, desk_at: Any, train: Any, point: Any) -> Any:
    """Hear which life a terminal is in, if the centre does not know; gives it."""
    memory, desk = both(memory_at, desk_at)
    life = get1(memory, desk, TERMINALS_LIFE, point)
    known = has(memory, desk, CENTRE_TERMINAL_LIFE, point)
    if not known or get1(memory, desk, CENTRE_TERMINAL_LIFE_VALUE, point) != life:
        take1(memory, desk, SEND_TERMINAL_LIFE, point)
        put2(memory, desk, point, life)
        arrive(memory, desk, NOTE_TERMINAL_LIFE, train)
    return life


@entry
def confirm(memory_at: Any, desk_at: Any, train: Any, run: Any, point: Any) -> Any:
    """The terminal's word for a run goes out and on to the centre."""
    memory, desk = both(memory_at, desk_at)
    lies = get1(memory, desk, TRACK_LIES_VALUE, point)
    put5(memory, desk, run, point, lies, lies, 1)
    take(memory, desk, SEND_CONFIRMATION)
    put3(memory, desk, run, point, lies)
    arrive(memory, desk, RELAY_CONFIRMATION, train)
    return 0


@compiled
def throw(memory: Any, desk: Any, train: Any, point: Any, wanted: Any) -> None:
    """The motor throws an unlocked point, and it is locked."""
    if get1(memory, desk, TERMINALS_UNLOCKED, point) == 0 or get1(memory, desk, TERMINALS_WANTED, point) != wanted:
        return
    if desk[CLOCK] < desk[STUCK_UNTIL] or strikes(desk, STUCK, train):
        leg = of2(desk, LEG, point, below(desk, of(desk, LEGS, point)))
        take2(memory, desk, DRIFT, point, leg)
        return
    take2(memory, desk, DRIFT, point, wanted)
    if not strikes(desk, LATE_CONTACTS, train):
        take3(memory, desk, LOCK, point, wanted, 1)


@compiled
def lay_falsely(memory: Any, desk: Any, train: Any, run: Any, point: Any, wanted: Any) -> None:
    """Contacts that lie: the point is taken for laid, locked and confirmed as it is."""
    put5(memory, desk, run, point, get1(memory, desk, TERMINALS_LIFE, point), wanted, 1)
    take_beyond(memory, desk, OBEY_ORDER)
    if get1(memory, desk, TERMINALS_UNLOCKED, point) == 1:
        put3(memory, desk, point, wanted, 1)
        take_beyond(memory, desk, LOCK)
    put5(memory, desk, run, point, wanted, wanted, 1)
    take_beyond(memory, desk, SEND_CONFIRMATION)
    put3(memory, desk, run, point, wanted)
    take(memory, desk, RELAY_CONFIRMATION)


@entry
def lay(memory_at: Any, desk_at: Any, train: Any, run: Any, point: Any) -> Any:
    """Have a point laid and confirmed for a run, as far as telegrams come through."""
    memory, desk = both(memory_at, desk_at)
    life, wanted = hear(memory, desk, train, point), of2(desk, NEED, route_of(memory, desk, run), point)
    take3(memory, desk, SEND_ORDER, run, point, life)
    put3(memory, desk, run, point, life)
    arrive(memory, desk, RELAY_ORDER, train)
    lies = get1(memory, desk, TRACK_LIES_VALUE, point)
    if lies != wanted and strikes(desk, FALSE_CONTACTS, train):
        lay_falsely(memory, desk, train, run, point, wanted)
    else:
        put5(memory, desk, run, point, life, lies, 0 if strikes(desk, NO_CONTACTS, train) else 1)
        arrive(memory, desk, OBEY_ORDER, train)
        throw(memory, desk, train, point, wanted)
        confirm(memory, desk, train, run, point)
    put3(memory, desk, run, point, wanted)
    arrive(memory, desk, NOTE_CONFIRMATION, train)
    return 0


@compiled
def lay_points(memory: Any, desk: Any, train: Any, run: Any) -> Any:
    """Lay every point of a run that is not proved; tell whether all are."""
    route, proved = route_of(memory, desk, run), True
    for at in range(of(desk, NEEDS, route)):
        point = of2(desk, NEEDED, route, at)
        if not has1(memory, desk, CENTRE_RUNS_PROVED, run, point):
            lay(memory, desk, train, run, point)
            proved = proved and has1(memory, desk, CENTRE_RUNS_PROVED, run, point)
    return proved


# ---- loops


@entry
def close_loop(memory_at: Any, desk_at: Any, train: Any, run: Any) -> Any:
    """Points, first loop and permit, as far as telegrams come through; tell whether the train may go."""
    memory, desk = both(memory_at, desk_at)
    if stage(memory, desk, run) == RESERVED and (lay_points(memory, desk, train, run) or one_in(desk, 8)):
        take1(memory, desk, OPEN_FIRST_LOOP, run)
    if stage(memory, desk, run) == OFFERED:
        take1(memory, desk, SEND_OFFER, run)
        mixed_up = strikes(desk, MIXED_UP, train)
        put2(memory, desk, run, below(desk, desk[TAG_LISTS]) if mixed_up else list_of(memory, desk, run))
        arrive(memory, desk, TAKE_OFFER, train)
        take2(memory, desk, SEND_ECHO, run, get2(memory, desk, UNITS_TAG_LIST, train, run))
        memory[desk[EVENT]] = run
        arrive(memory, desk, NOTE_ECHO, train)
    if stage(memory, desk, run) == SET:
        take1(memory, desk, SEND_PERMIT, run)
        memory[desk[EVENT]] = run
        arrive(memory, desk, TAKE_PERMIT, train)
    return may_go(memory, desk, train, run)


@entry
def ask_back(memory_at: Any, desk_at: Any, train: Any, run: Any, short: Any) -> Any:
    """The centre asks for a run that it wants back; the train gives it back if its brake holds the end before it."""
    memory, desk = both(memory_at, desk_at)
    take1(memory, desk, SEND_RECALL, run)
    memory[desk[EVENT]] = run
    arrive(memory, desk, RECALL, train)
    if not short or strikes(desk, DOUBT, train):
        put_standing(memory, desk[EVENT], run, 1, 1, 0)
    else:
        put_standing(memory, desk[EVENT], run, 0 if strikes(desk, DOUBT, train) else 1, 0, 0)
    take(memory, desk, GIVE_BACK)
    take1(memory, desk, SEND_RETURN, run)
    memory[desk[EVENT]] = run
    arrive(memory, desk, NOTE_GIVEN_BACK, train)
    return 0


@entry
def report(memory_at: Any, desk_at: Any, train: Any) -> Any:
    """Every block the tail has left and the centre still holds is reported, for every run it is held for."""
    memory, desk = both(memory_at, desk_at)
    for run in range(get(memory, desk, RUNS_COUNT)):
        if not has_order(memory, desk, train, run) or stage(memory, desk, run) < 0:
            continue
        left = cell(desk, UNITS_LEFT, train, run)
        for word in range(desk[BLOCK_WORDS]):
            if memory[left + word] == 0:
                continue
            for block in range(64 * word, min(64 * word + 64, desk[BLOCKS])):
                if bit(memory, left, block) and claimed_by(memory, desk, block, run):
                    put_report(memory, desk, train, run, block)
                    take(memory, desk, SEND_TAIL_REPORT)
                    put_report(memory, desk, train, run, block)
                    arrive(memory, desk, RELEASE_BLOCK, train)
    return 0


@compiled
def put_report(memory: Any, desk: Any, train: Any, run: Any, block: Any) -> None:
    """Write the report that the tail has left a block, with what it read."""
    put4(
        memory,
        desk,
        run,
        block,
        get3(memory, desk, UNITS_LEFT_LEFT_TAG, train, run, block),
        get3(memory, desk, UNITS_LEFT_LEFT_RECORD, train, run, block),
    )
    event = desk[EVENT]
    memory[event + 4] = get3(memory, desk, UNITS_LEFT_ENTERED_TAG, train, run, block)
    memory[event + 5] = get3(memory, desk, UNITS_LEFT_ENTERED_RECORD, train, run, block)


@compiled
def holds_overlap(memory: Any, desk: Any, run: Any) -> Any:
    """Whether the centre still holds a block of a run's overlap for it."""
    at = row(desk, OVERLAP, route_of(memory, desk, run))
    holds = False
    for block in range(desk[BLOCKS]):
        holds = holds or (bit(desk, at, block) and claimed_by(memory, desk, block, run))
    return holds


@entry
def tell_stopped(memory_at: Any, desk_at: Any, train: Any, run: Any) -> Any:
    """The train tells that it stands in its destination, and the overlap is freed."""
    memory, desk = both(memory_at, desk_at)
    if stage(memory, desk, run) != SET or front_block(desk, train) != of(
        desk, DESTINATION, route_of(memory, desk, run)
    ):
        return 0
    if not holds_overlap(memory, desk, run) and not one_in(desk, 8):
        return 0
    put_stopped(memory, desk[EVENT], run, 0 if strikes(desk, DOUBT, train) else 1)
    take(memory, desk, NOTE_STOPPED)
    take1(memory, desk, SEND_STOP, run)
    memory[desk[EVENT]] = run
    arrive(memory, desk, RELEASE_OVERLAP, train)
    return 0


@entry
def retire_what_is_over(memory_at: Any, desk_at: Any, train: Any) -> Any:
    """The centre forgets runs of a train that hold nothing."""
    memory, desk = both(memory_at, desk_at)
    held = 0
    for block in range(desk[BLOCKS]):
        held |= memory[row(desk, CENTRE_CLAIMED_VALUE, block)]
    for run in range(get(memory, desk, RUNS_COUNT)):
        known = stage(memory, desk, run) >= 0 and get1(memory, desk, RUNS_TRAIN, run) == train
        if known and (held >> run) & 1 == 0:
            take1(memory, desk, RETIRE, run)
    return 0
