"""One trace: what is drawn for it, and then second after second until it ends."""

from __future__ import annotations

from typing import Any

from fuzz.traffic.air import clear_air, deliver
from fuzz.traffic.compiling import compiled
from fuzz.traffic.entries import both, entry
from fuzz.traffic.faults import BEYOND_ONE_IN
from fuzz.traffic.journey import AT_REST, LOST, wake
from fuzz.traffic.messages import NO_RUN
from fuzz.traffic.places import (
    ACCEPTED,
    BASE,
    BERTH,
    BERTHS,
    BLOCK_WORDS,
    BROKEN,
    BY,
    BY_START,
    CAR,
    CAR_COUNT,
    CARRIED,
    CARS,
    CAUSE,
    CENTRE_ACCOUNTED,
    CENTRE_CLAIMED_VALUE,
    CENTRE_LOST_BLOCKS,
    CENTRE_LOST_POINTS,
    CLOCK,
    COUNT,
    DECISIONS,
    DONE,
    DUE,
    ENDED,
    FAULT_IS,
    FINISHED,
    FOULS,
    LAST_FINISHED,
    LEADS,
    LEG,
    LEGS,
    LENGTH,
    MOST_SECONDS,
    MOVING,
    NOBODY,
    ON_LINE,
    ONWARD,
    PHASE,
    PLAIN,
    POINTS,
    PRESENT,
    PROGRESS_AT,
    QUANTILE,
    RANDOM,
    RECOVER_AT,
    RUN,
    STANDS_IN,
    START_AT,
    START_LIES,
    STATE_HASH,
    STEPS,
    STUCK_UNTIL,
    TRACK_AT,
    TRACK_AT_VALUE,
    TRACK_LIES_VALUE,
    TRAIL,
    TRAIN,
    TRAIN_WORDS,
    TRAINS,
    TROUBLE,
    TROUBLES,
    VIOLATED,
    WAITING,
    WAKE,
    WANTED,
    WEIGHTED,
)
from fuzz.traffic.steps import GOES_ON, NOBODY_ARRIVES, TIME_SPENT, TIMETABLE_ENDED, end, set_train, take1, train_word
from fuzz.traffic.tables import RECOVER_BLOCK, RECOVER_POINT
from fuzz.traffic.troubles import trouble
from fuzz.traffic.words import (
    GOLDEN,
    base,
    below,
    between,
    bit,
    chance,
    lowest,
    minus,
    mixed,
    of,
    of2,
    one_in,
    plus,
    row,
    times,
)

SPREAD_WORD, SPREAD_ADDRESS, SPREAD_BOTH = -7046029254386353131, -4417276706812531889, -8796714831421723037
"""As in the memory's own hash of a state."""
LOW_35, LOW_32 = (1 << 35) - 1, (1 << 32) - 1
BY_SECOND, IS_BEYOND = 1, 2
LONGEST_WAIT = 30
ROOM = 3
"""With so many places to begin in for each train, half of all traces have the whole fleet on the line."""
HOPELESS = 1800
"""When no train has arrived for so many seconds, they stand in one another's way, or one is lost for good."""
HEADER_OF_TRACE = (
    ENDED,
    STEPS,
    ACCEPTED,
    BROKEN,
    FINISHED,
    CLOCK,
    RECOVER_AT,
    STUCK_UNTIL,
    TROUBLES,
    LAST_FINISHED,
    PROGRESS_AT,
)


# ---- the start


@compiled
def in_hash(address: Any, word: Any) -> Any:
    """What a word adds to the hash of the state."""
    if word == 0:
        return 0
    value = plus(times(word, SPREAD_WORD), times(address, SPREAD_ADDRESS))
    value = times(value ^ ((value >> 29) & LOW_35), SPREAD_BOTH)
    return value ^ ((value >> 32) & LOW_32)


@compiled
def set_word(memory: Any, desk: Any, address: Any, word: Any) -> None:
    """Set a word of the state, and carry its hash on."""
    change = minus(in_hash(address, word), in_hash(address, memory[address]))
    memory[desk[STATE_HASH]] = plus(memory[desk[STATE_HASH]], change)
    memory[address] = word


@compiled
def draw_fault(desk: Any, fault: Any) -> None:
    """A fault is in this trace, at a drawn rate."""
    if desk[PRESENT + fault] != 0:
        return
    desk[PRESENT + fault] = of2(desk, QUANTILE, fault, below(desk, 64))
    desk[CARRIED + fault] += 1
    if of(desk, FAULT_IS, fault) & BY_SECOND != 0:
        desk[TROUBLE + desk[TROUBLES]] = fault
        desk[TROUBLES] += 1


@compiled
def draw_one(desk: Any, beyond: Any) -> None:
    """One fault is in this trace, each as likely as its share in all traces."""
    total = 0
    for fault in range(COUNT):
        if (of(desk, FAULT_IS, fault) & IS_BEYOND != 0) == beyond:
            total += of(desk, WEIGHTED, fault) >> 8
    if total == 0:
        return
    left = below(desk, total)
    for fault in range(COUNT):
        if (of(desk, FAULT_IS, fault) & IS_BEYOND != 0) == beyond:
            left -= of(desk, WEIGHTED, fault) >> 8
            if left < 0:
                draw_fault(desk, fault)
                return


@entry
def draw_faults(memory_at: Any, desk_at: Any, beyond: Any) -> Any:
    """No fault in one trace of eight, one in two of them, several in the others; and one beyond, if so drawn."""
    _, desk = both(memory_at, desk_at)
    for fault in range(COUNT):
        desk[PRESENT + fault] = 0
    how = below(desk, 8)
    if how in (1, 2):
        draw_one(desk, False)
    elif how > 2:
        for fault in range(COUNT):
            if of(desk, FAULT_IS, fault) & IS_BEYOND == 0 and chance(desk, of(desk, WEIGHTED, fault)):
                draw_fault(desk, fault)
    if beyond and one_in(desk, BEYOND_ONE_IN):
        draw_one(desk, True)
    return 0


@entry
def draw_berth(memory_at: Any, desk_at: Any, taken: Any) -> Any:
    """Draw a block for a train to begin in: without points if one is free, not too close to another; -1 for none."""
    _, desk = both(memory_at, desk_at)
    plain, every = of(desk, PLAIN, 0), of(desk, BERTHS, 0)
    for low, high in ((0, plain), (plain, every)):
        count = high - low
        begin = below(desk, max(1, count))
        for at in range(count):
            block = of(desk, BERTH, low + (begin + at) % count)
            free = True
            for word in range(desk[BLOCK_WORDS]):
                free = free and desk[row(desk, FOULS, block) + word] & desk[taken + word] == 0
            if free:
                desk[taken + (block >> 6)] |= 1 << (block & 63)
                return block
    return -1


@compiled
def put_train(memory: Any, desk: Any, train: Any, block: Any) -> None:
    """A train stands in a block, all of it; -1: it is not on the line."""
    at = TRAIN + train * TRAIN_WORDS
    for word in range(TRAIN_WORDS):
        desk[at + word] = 0
    for word in (BASE, RUN, ONWARD):
        set_train(desk, train, word, NO_RUN)
    set_train(desk, train, PHASE, LOST)
    set_train(desk, train, CAUSE, BY_START)
    set_train(desk, train, WAKE, below(desk, 30))
    set_train(desk, train, WANTED, between(desk, 2, 20))
    set_train(desk, train, WAITING, 0)
    set_train(desk, train, LEADS, below(desk, 2))
    if block < 0:
        return
    set_train(desk, train, MOVING, of(desk, CAR_COUNT, train))
    set_train(desk, train, LENGTH, 1)
    set_train(desk, train, TRAIL, block)
    for place in range(of(desk, CAR_COUNT, train)):
        car = of2(desk, CAR, train, place)
        desk[row(desk, START_AT, car)] = block
        here = base(desk, TRACK_AT) + (car >> 6)
        set_word(memory, desk, here, memory[here] | 1 << (car & 63))
        set_word(memory, desk, row(desk, TRACK_AT_VALUE, car) + (block >> 6), 1 << (block & 63))


@entry
def begin(memory_at: Any, desk_at: Any, seed: Any, batch: Any, trace: Any, beyond: Any) -> Any:
    """Draw a trace: its faults, its trains and where they stand, and how points lie."""
    memory, desk = both(memory_at, desk_at)
    desk[RANDOM] = mixed(plus(mixed(plus(mixed(plus(seed, GOLDEN)), batch + 1)), trace + 1))
    for word in HEADER_OF_TRACE:
        desk[word] = 0
    desk[BY], desk[VIOLATED] = -1, -1
    clear_air(desk)
    draw_faults(memory, desk, beyond)
    for car in range(desk[CARS]):
        desk[row(desk, START_AT, car)] = -1
    taken = TRAIN + NOBODY * TRAIN_WORDS
    for word in range(TRAIN_WORDS):
        desk[taken + word] = 0
    room, online = of(desk, BERTHS, 0) >= ROOM * desk[TRAINS], 0
    wanted = desk[TRAINS] if room and one_in(desk, 2) else between(desk, 1, desk[TRAINS])
    for train in range(desk[TRAINS]):
        block = draw_berth(memory, desk, taken) if train < wanted and train == online else -1
        online += 1 if block >= 0 else 0
        put_train(memory, desk, train, block)
    for word in range(TRAIN_WORDS):
        desk[taken + word] = 0
    desk[ON_LINE] = online
    anyhow = one_in(desk, 2)
    for point in range(desk[POINTS]):
        leg = of2(desk, LEG, point, below(desk, of(desk, LEGS, point)) if anyhow else 0)
        desk[row(desk, START_LIES, point)] = leg
        set_word(memory, desk, row(desk, TRACK_LIES_VALUE, point), leg)
    return 0


# ---- second after second


@compiled
def everybody_told(memory: Any, desk: Any) -> Any:
    """Whether every train of the register has told where it stands."""
    told = True
    for train in range(desk[TRAINS]):
        told = told and bit(memory, base(desk, CENTRE_ACCOUNTED), train)
    return told


@entry
def recover(memory_at: Any, desk_at: Any) -> Any:
    """Everything that is lost and can be found again is, now and then before its time."""
    memory, desk = both(memory_at, desk_at)
    desk[RECOVER_AT] = desk[CLOCK] + between(desk, 5, 20)
    if not everybody_told(memory, desk) and not one_in(desk, 8):
        return 0
    for word in range(desk[BLOCK_WORDS]):
        lost = memory[base(desk, CENTRE_LOST_BLOCKS) + word]
        while lost != 0 and desk[ENDED] == GOES_ON:
            take1(memory, desk, RECOVER_BLOCK, 64 * word + lowest(lost))
            lost &= minus(lost, 1)
    for point in range(desk[POINTS]):
        if bit(memory, base(desk, CENTRE_LOST_POINTS), point):
            held = memory[row(desk, CENTRE_CLAIMED_VALUE, of(desk, STANDS_IN, point))] != 0
            if not held or one_in(desk, 8):
                take1(memory, desk, RECOVER_POINT, point)
    return 0


@compiled
def all_done(desk: Any) -> Any:
    """Whether every train has run what it was to run."""
    for train in range(desk[ON_LINE]):
        if train_word(desk, train, PHASE) != AT_REST:
            return False
        if train_word(desk, train, DONE) < train_word(desk, train, WANTED):
            return False
    return True


@compiled
def run_trace(memory: Any, desk: Any, seed: Any, batch: Any, trace: Any, beyond: Any) -> None:
    """Run a trace to its end; the memory holds the state in which everything has just started, and nobody anywhere.

    Everything follows from the three numbers and from the desk's weights and limits.
    """
    begin(memory, desk, seed, batch, trace, beyond)
    while desk[ENDED] == GOES_ON:
        deliver(memory, desk)
        if desk[RECOVER_AT] <= desk[CLOCK]:
            recover(memory, desk)
        soonest = min(desk[DUE], desk[CLOCK] + LONGEST_WAIT)
        for train in range(desk[TRAINS]):
            if train_word(desk, train, WAKE) <= desk[CLOCK]:
                desk[DECISIONS] += 1
                wake(memory, desk, train)
            soonest = min(soonest, train_word(desk, train, WAKE))
        seconds = max(1, soonest - desk[CLOCK])
        trouble(memory, desk, seconds)
        desk[CLOCK] += seconds
        if desk[CLOCK] >= desk[MOST_SECONDS]:
            end(desk, TIME_SPENT)
        if desk[FINISHED] > desk[LAST_FINISHED]:
            desk[LAST_FINISHED], desk[PROGRESS_AT] = desk[FINISHED], desk[CLOCK]
        if desk[CLOCK] - desk[PROGRESS_AT] > HOPELESS:
            end(desk, NOBODY_ARRIVES)
        if all_done(desk):
            end(desk, TIMETABLE_ENDED)
