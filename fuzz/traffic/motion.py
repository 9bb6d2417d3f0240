"""Trains in motion: car by car, boundary by boundary, and what their antennas read (T2, T5, T6).

A train's trail is the blocks it is in, rear to front, with the boundaries between them, each by the tag on its rear
side.  Each car that still runs has the lowest and the highest place on the trail that it is in.
"""

from __future__ import annotations

from typing import Any

from fuzz.traffic.air import strikes
from fuzz.traffic.compiling import compiled
from fuzz.traffic.entries import both, entry
from fuzz.traffic.faults import number
from fuzz.traffic.places import (
    BOUNDARY,
    BY,
    CAB,
    CAR,
    CLAIMS,
    CLOCK,
    DEAD_HEAD,
    DEAD_TAIL,
    EVENT,
    FIRST,
    FOREIGN_RECORD,
    FOREIGN_TAG,
    HIGHEST,
    JOINTS,
    LEADING,
    LEADS,
    LENGTH,
    LINE,
    LOWEST,
    MOST_TRAIL,
    MOVING,
    NEIGHBOUR,
    NEIGHBOURS,
    PARTNER,
    PRESENT,
    RECORD,
    RECORDS,
    RUNS_COUNT,
    RUNS_TRAIN,
    TAGS,
    TRACK_FACING,
    TRACK_FACING_VALUE,
    TRACK_PARTED,
    TRACK_ROLLING,
    TRACK_UNREAD,
    TRAIL,
    UNITS_LEADING,
    WAY,
)
from fuzz.traffic.senses import LINE_WORDS, put_line
from fuzz.traffic.steps import (
    put3,
    put4,
    route_of,
    set_train,
    take,
    take1,
    take2,
    take3,
    take4,
    take_beyond,
    train_word,
)
from fuzz.traffic.tables import (
    CAR_FOLLOWS,
    CAR_LEAVES,
    CAR_MOVES,
    CHANGE_ENDS,
    COME_TO_REST,
    HEAD_MISSES,
    HEAD_READS,
    TAIL_READS,
    WINDOW_PASSES,
)
from fuzz.traffic.words import below, get, get1, has, has1, in_table, of, of2, one_in

MISSED_AT_HEAD, MISSED_AT_TAIL = number("missed tag at the head"), number("missed tag at the tail")
REPEATED, SWAPPED, FOREIGN = number("repeated tag"), number("swapped tags"), number("foreign tag")
CORRUPT, COPIED = number("corrupt record"), number("copied tag")
EARLY, LATE_TAG = number("early tag"), number("late tag")
AHEAD_OF_LEAVING, ELSEWHERE = number("read ahead of leaving"), number("led elsewhere")
HEALED = number("line healed falsely")
ROLLED_BACK, BACK_TO_FRONT = number("rolled back"), number("pair read back to front")
OF_ELSEWHERE, TOO_LATE = number("tag of elsewhere at the head"), number("overdue too late")
TRAIL_TO_SPARE = 4
LINE_AT, READ_AT = 3, 3 + LINE_WORDS
"""From which word on of a tail's read stands what the line says, and from which on tag and record."""


# ---- where a train is


@compiled
def car_at(desk: Any, train: Any, place: Any) -> Any:
    """The place in the train's list of the car that is the ``place``-th from the front of those that run."""
    first, count = train_word(desk, train, FIRST), train_word(desk, train, MOVING)
    return first + place if train_word(desk, train, LEADS) == 1 else first + count - 1 - place


@compiled
def front_block(desk: Any, train: Any) -> Any:
    """The block that the head is in."""
    return train_word(desk, train, TRAIL + train_word(desk, train, LENGTH) - 1)


@compiled
def rear_block(desk: Any, train: Any) -> Any:
    """The block that the tail is in."""
    return train_word(desk, train, TRAIL)


@compiled
def faces(memory: Any, desk: Any, train: Any, route: Any) -> Any:
    """Whether the car in front leads in the direction of a route."""
    return of2(desk, LEADING, route, train) == train_word(desk, train, LEADS)


@compiled
def front_cab(desk: Any, train: Any) -> Any:
    """The cab on the car in front."""
    return of(desk, CAB, of2(desk, CAR, train, car_at(desk, train, 0)))


@compiled
def choose_ends(memory: Any, desk: Any, train: Any) -> None:
    """The driver of a train at rest takes the cab in front, unless his unit knows that it leads."""
    cab = front_cab(desk, train)
    faced = has(memory, desk, TRACK_FACING, train) and get1(memory, desk, TRACK_FACING_VALUE, train) == cab
    if not faced or get1(memory, desk, UNITS_LEADING, train) != cab:
        take2(memory, desk, CHANGE_ENDS, train, cab)


@entry
def turn(memory_at: Any, desk_at: Any, train: Any) -> Any:
    """Change ends: the other cab leads."""
    memory, desk = both(memory_at, desk_at)
    length = train_word(desk, train, LENGTH)
    for at in range(length // 2):
        low, high = train_word(desk, train, TRAIL + at), train_word(desk, train, TRAIL + length - 1 - at)
        set_train(desk, train, TRAIL + at, high)
        set_train(desk, train, TRAIL + length - 1 - at, low)
    for at in range((length - 1) // 2):
        low, high = train_word(desk, train, JOINTS + at), train_word(desk, train, JOINTS + length - 2 - at)
        set_train(desk, train, JOINTS + at, high)
        set_train(desk, train, JOINTS + length - 2 - at, low)
    for at in range(length - 1):
        set_train(desk, train, JOINTS + at, of(desk, PARTNER, train_word(desk, train, JOINTS + at)))
    for place in range(train_word(desk, train, MOVING)):
        car = car_at(desk, train, place)
        low, high = train_word(desk, train, LOWEST + car), train_word(desk, train, HIGHEST + car)
        set_train(desk, train, LOWEST + car, length - 1 - high)
        set_train(desk, train, HIGHEST + car, length - 1 - low)
    set_train(desk, train, LEADS, 1 - train_word(desk, train, LEADS))
    choose_ends(memory, desk, train)
    return 0


@compiled
def shorten(desk: Any, train: Any) -> None:
    """Forget the blocks behind the last car that runs."""
    while True:
        for place in range(train_word(desk, train, MOVING)):
            if train_word(desk, train, LOWEST + car_at(desk, train, place)) == 0:
                return
        length = train_word(desk, train, LENGTH)
        for at in range(length - 1):
            set_train(desk, train, TRAIL + at, train_word(desk, train, TRAIL + at + 1))
            set_train(desk, train, JOINTS + at, train_word(desk, train, JOINTS + at + 1))
        set_train(desk, train, LENGTH, length - 1)
        for place in range(train_word(desk, train, MOVING)):
            car = car_at(desk, train, place)
            set_train(desk, train, LOWEST + car, train_word(desk, train, LOWEST + car) - 1)
            set_train(desk, train, HIGHEST + car, train_word(desk, train, HIGHEST + car) - 1)


@entry
def rest(memory_at: Any, desk_at: Any, train: Any) -> Any:
    """The train comes to rest in whatever run it rolls."""
    memory, desk = both(memory_at, desk_at)
    for run in range(get(memory, desk, RUNS_COUNT)):
        if has(memory, desk, TRACK_ROLLING, run) and get1(memory, desk, RUNS_TRAIN, run) == train:
            memory[desk[EVENT]] = run
            take(memory, desk, COME_TO_REST)
    return 0


# ---- what antennas read


@entry
def head_reads(memory_at: Any, desk_at: Any, train: Any, tag: Any) -> Any:
    """The head antenna passes a tag."""
    memory, desk = both(memory_at, desk_at)
    missed = train_word(desk, train, DEAD_HEAD) > desk[CLOCK] or strikes(desk, MISSED_AT_HEAD, train)
    if missed or strikes(desk, TOO_LATE, train):
        take2(memory, desk, HEAD_MISSES, train, tag)
        return 0
    cab = front_cab(desk, train)
    if strikes(desk, FOREIGN, train):
        take4(memory, desk, HEAD_READS, train, cab, desk[FOREIGN_TAG], 1)
    if strikes(desk, OF_ELSEWHERE, train):
        take2(memory, desk, HEAD_MISSES, train, tag)
        put4(memory, desk, train, cab, below(desk, desk[TAGS]), 1)
        desk[BY] = OF_ELSEWHERE
        take_beyond(memory, desk, HEAD_READS)
        return 0
    window = 1
    if strikes(desk, EARLY, train) or strikes(desk, LATE_TAG, train):
        window = 0
    take4(memory, desk, HEAD_READS, train, cab, tag, window)
    if strikes(desk, REPEATED, train):
        take4(memory, desk, HEAD_READS, train, cab, tag, window)
    return 0


@compiled
def put_tail_read(memory: Any, desk: Any, train: Any, run: Any, tag: Any, record: Any) -> None:
    """Write what the tail reads over a line that is as healthy as it really is."""
    car = of2(desk, CAR, train, car_at(desk, train, train_word(desk, train, MOVING) - 1))
    healthy = train_word(desk, train, LINE) <= desk[CLOCK] and not has(memory, desk, TRACK_PARTED, train)
    put3(memory, desk, run, car, of(desk, CAB, car))
    put_line(memory, desk[EVENT] + LINE_AT, 1 if healthy else 0)
    memory[desk[EVENT] + READ_AT], memory[desk[EVENT] + READ_AT + 1] = tag, record


@compiled
def has_missed(memory: Any, desk: Any, train: Any) -> Any:
    """Whether the head has passed a tag unread that is not overdue yet."""
    missed = False
    for tag in range(desk[TAGS]):
        missed = missed or has1(memory, desk, TRACK_UNREAD, train, tag)
    return missed


@compiled
def follows_a_miss(memory: Any, desk: Any, train: Any, tag: Any) -> Any:
    """Whether the head has passed unread, not overdue yet, a tag whose partner is this one."""
    follows = False
    for missed in range(desk[TAGS]):
        is_before = of(desk, PARTNER, missed) == tag
        follows = follows or (is_before and has1(memory, desk, TRACK_UNREAD, train, missed))
    return follows


@compiled
def take_tail_read(memory: Any, desk: Any, train: Any) -> None:
    """The tail reads what is in the buffer, unless that lies where the head missed a tag that is not overdue yet."""
    tag = memory[desk[EVENT] + READ_AT]
    if has1(memory, desk, TRACK_UNREAD, train, tag) or follows_a_miss(memory, desk, train, tag):
        desk[BY] = TOO_LATE
        take_beyond(memory, desk, TAIL_READS)
    else:
        take(memory, desk, TAIL_READS)


@entry
def tail_reads(memory_at: Any, desk_at: Any, train: Any, run: Any, tag: Any) -> Any:
    """The tail antenna passes a tag."""
    memory, desk = both(memory_at, desk_at)
    if train_word(desk, train, DEAD_TAIL) > desk[CLOCK] or strikes(desk, MISSED_AT_TAIL, train):
        return 0
    if strikes(desk, FOREIGN, train):
        put_tail_read(memory, desk, train, run, desk[FOREIGN_TAG], desk[FOREIGN_RECORD])
        take_tail_read(memory, desk, train)
    read, record = tag, of(desk, RECORD, tag)
    if strikes(desk, CORRUPT, train):
        record = desk[FOREIGN_RECORD]
    elif strikes(desk, COPIED, train):
        if one_in(desk, 2):
            read = below(desk, desk[TAGS])
        else:
            record = below(desk, desk[RECORDS])
    put_tail_read(memory, desk, train, run, read, record)
    if has(memory, desk, TRACK_PARTED, train) and desk[PRESENT + HEALED] != 0:
        put_line(memory, desk[EVENT] + LINE_AT, 1)
        desk[BY] = HEALED
        take_beyond(memory, desk, TAIL_READS)
        return 0
    take_tail_read(memory, desk, train)
    if strikes(desk, REPEATED, train):
        put_tail_read(memory, desk, train, run, read, record)
        take_tail_read(memory, desk, train)
    return 0


@compiled
def find_overdue(memory: Any, desk: Any, train: Any) -> None:
    """What the head has missed is overdue now."""
    if has_missed(memory, desk, train):
        take1(memory, desk, WINDOW_PASSES, train)


@entry
def tail_passes(memory_at: Any, desk_at: Any, train: Any, run: Any, tag: Any) -> Any:
    """The tail antenna passes both tags of a boundary."""
    memory, desk = both(memory_at, desk_at)
    other = of(desk, PARTNER, tag)
    if desk[PRESENT + TOO_LATE] == 0:
        find_overdue(memory, desk, train)
    if strikes(desk, SWAPPED, train):
        tag, other = other, tag
    tail_reads(memory, desk, train, run, tag)
    tail_reads(memory, desk, train, run, other)
    return 0


# ---- over a boundary


@compiled
def hangs_back(desk: Any, train: Any, car: Any) -> Any:
    """Whether the car behind has yet to come into the block that this one is last in, so that this one stays there."""
    first, behind = train_word(desk, train, FIRST), car + (1 if train_word(desk, train, LEADS) == 1 else -1)
    if behind < first or behind >= first + train_word(desk, train, MOVING):
        return False
    return train_word(desk, train, HIGHEST + behind) < train_word(desk, train, LOWEST + car)


@compiled
def leaves(memory: Any, desk: Any, train: Any, car: Any) -> Any:
    """The last axle of a car that is astride a boundary goes over; tell whether the car is in one block now."""
    low, high = train_word(desk, train, LOWEST + car), train_word(desk, train, HIGHEST + car)
    if low < high:
        if hangs_back(desk, train, car):
            return False
        if not take2(memory, desk, CAR_LEAVES, of2(desk, CAR, train, car), train_word(desk, train, TRAIL + low)):
            return False
        set_train(desk, train, LOWEST + car, high)
    return True


@compiled
def in_one_block(memory: Any, desk: Any, train: Any, run: Any, place: Any) -> Any:
    """Whatever of a car still hangs back over a boundary goes over; the last one's antenna reads there."""
    car = car_at(desk, train, place)
    low = train_word(desk, train, LOWEST + car)
    if low == train_word(desk, train, HIGHEST + car):
        return True
    if place < train_word(desk, train, MOVING) - 1:
        return leaves(memory, desk, train, car)
    last_leaves(memory, desk, train, run, low)
    return train_word(desk, train, LOWEST + car) == train_word(desk, train, HIGHEST + car)


@compiled
def reads_back_to_front(memory: Any, desk: Any, train: Any, last: Any) -> None:
    """The head reads the pair that it has passed, the farther tag first, whoever leads a run that begins so."""
    for tag in (last, of(desk, PARTNER, last)):
        put4(memory, desk, train, front_cab(desk, train), tag, 1)
        desk[BY] = BACK_TO_FRONT
        take_beyond(memory, desk, HEAD_READS)


@compiled
def rolls_back(memory: Any, desk: Any, train: Any, run: Any, behind: Any) -> Any:
    """The last car is back in the block at place ``behind`` of the trail, which it had left; tell whether it is."""
    car = car_at(desk, train, train_word(desk, train, MOVING) - 1)
    here, left = train_word(desk, train, TRAIL + behind + 1), train_word(desk, train, TRAIL + behind)
    put4(memory, desk, run, of2(desk, CAR, train, car), here, left)
    desk[BY] = ROLLED_BACK
    if not take_beyond(memory, desk, CAR_MOVES):
        return False
    set_train(desk, train, LOWEST + car, behind)
    return True


@entry
def front_passes(memory_at: Any, desk_at: Any, train: Any, run: Any) -> Any:
    """The head reads the pair at the end of its block and the front car goes over; tell whether it did."""
    memory, desk = both(memory_at, desk_at)
    if not in_one_block(memory, desk, train, run, 0):
        return False
    route, block, length = route_of(memory, desk, run), front_block(desk, train), train_word(desk, train, LENGTH)
    car = car_at(desk, train, 0)
    tag, target = of2(desk, BOUNDARY, route, block), of2(desk, WAY, route, block)
    if tag < 0 or target < 0 or length >= MOST_TRAIL - TRAIL_TO_SPARE:
        return False
    last = of(desk, PARTNER, tag)
    swapped, misread = strikes(desk, SWAPPED, train), strikes(desk, BACK_TO_FRONT, train)
    if not swapped and not misread:
        head_reads(memory, desk, train, tag)
    name = of2(desk, CAR, train, car)
    if strikes(desk, ELSEWHERE, train):
        led = of2(desk, NEIGHBOUR, block, below(desk, of(desk, NEIGHBOURS, block)))
        put4(memory, desk, run, name, block, led)
        take_beyond(memory, desk, CAR_MOVES)
        return False
    if not take4(memory, desk, CAR_MOVES, run, name, block, target):
        return False
    set_train(desk, train, TRAIL + length, target)
    set_train(desk, train, JOINTS + length - 1, tag)
    set_train(desk, train, LENGTH, length + 1)
    set_train(desk, train, HIGHEST + car, length)
    if misread:
        reads_back_to_front(memory, desk, train, last)
    else:
        head_reads(memory, desk, train, last)
    if swapped and not misread:
        head_reads(memory, desk, train, tag)
    if not one_in(desk, 4):
        leaves(memory, desk, train, car)
    if train_word(desk, train, MOVING) == 1:
        last_leaves(memory, desk, train, run, length - 1)
    return True


@entry
def last_leaves(memory_at: Any, desk_at: Any, train: Any, run: Any, behind: Any) -> Any:
    """The last car has gone over the boundary before place ``behind`` + 1: its antenna reads the pair there."""
    memory, desk = both(memory_at, desk_at)
    car = car_at(desk, train, train_word(desk, train, MOVING) - 1)
    joint = train_word(desk, train, JOINTS + behind)
    if strikes(desk, AHEAD_OF_LEAVING, train):
        find_overdue(memory, desk, train)
        put_tail_read(memory, desk, train, run, joint, of(desk, RECORD, joint))
        take(memory, desk, TAIL_READS)
        other = of(desk, PARTNER, joint)
        put_tail_read(memory, desk, train, run, other, of(desk, RECORD, other))
        take_beyond(memory, desk, TAIL_READS)
        return 0
    if leaves(memory, desk, train, car):
        tail_passes(memory, desk, train, run, joint)
        if not strikes(desk, ROLLED_BACK, train) or not rolls_back(memory, desk, train, run, behind):
            shorten(desk, train)
    return 0


@entry
def drawn_on(memory_at: Any, desk_at: Any, train: Any, run: Any, place: Any, high: Any) -> Any:
    """A car goes on after the car ahead of it; or under a run that the train rolls in, where no head has been noted."""
    memory, desk = both(memory_at, desk_at)
    car = of2(desk, CAR, train, car_at(desk, train, place))
    ahead = of2(desk, CAR, train, car_at(desk, train, place - 1))
    block, target = train_word(desk, train, TRAIL + high), train_word(desk, train, TRAIL + high + 1)
    if take3(memory, desk, CAR_FOLLOWS, car, ahead, target):
        return True
    for back in range(get(memory, desk, RUNS_COUNT) + 1):
        under = run if back == 0 else back - 1
        if back > 0 and (not has(memory, desk, TRACK_ROLLING, under) or get1(memory, desk, RUNS_TRAIN, under) != train):
            continue
        route = route_of(memory, desk, under)
        leads = in_table(desk, CLAIMS, route, block) and of2(desk, WAY, route, block) == target
        if leads and take4(memory, desk, CAR_MOVES, under, car, block, target):
            return True
    return False


@entry
def follows(memory_at: Any, desk_at: Any, train: Any, run: Any) -> Any:
    """Each car behind the first goes on by a block, if the one ahead of it has; tell whether any did."""
    memory, desk = both(memory_at, desk_at)
    moved, moving = False, train_word(desk, train, MOVING)
    for place in range(1, moving):
        car, ahead = car_at(desk, train, place), car_at(desk, train, place - 1)
        if not in_one_block(memory, desk, train, run, place):
            return moved
        high = train_word(desk, train, HIGHEST + car)
        if high >= train_word(desk, train, HIGHEST + ahead):
            continue
        if train_word(desk, train, LOWEST + ahead) <= high and not leaves(memory, desk, train, ahead):
            return moved
        if not drawn_on(memory, desk, train, run, place, high):
            return moved
        set_train(desk, train, HIGHEST + car, high + 1)
        moved = True
        if place == moving - 1:
            last_leaves(memory, desk, train, run, high)
        elif not one_in(desk, 4):
            leaves(memory, desk, train, car)
    return moved


@compiled
def must_follow(memory: Any, desk: Any, train: Any, run: Any) -> Any:
    """Whether the front may not go on before the rear has: it hangs far back, or off the route."""
    length, car = train_word(desk, train, LENGTH), car_at(desk, train, 0)
    astride = train_word(desk, train, LOWEST + car) < train_word(desk, train, HIGHEST + car)
    if length > 3 or (astride and hangs_back(desk, train, car)):
        return True
    return length > 1 and not in_table(desk, CLAIMS, route_of(memory, desk, run), rear_block(desk, train))
