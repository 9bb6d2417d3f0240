"""Events out of order: any telegram ever sent, any event that was taken once more, and any event at all."""

from __future__ import annotations

from typing import Any

from fuzz.traffic.air import with_run
from fuzz.traffic.compiling import compiled
from fuzz.traffic.entries import both, entry
from fuzz.traffic.places import (
    ACCEPTED,
    ARRIVALS,
    BLOCKS,
    CABS,
    CARS,
    CENTRE_EPOCH,
    CENTRE_NEWEST,
    EVENT,
    LOG,
    POINTS,
    POSITIONS,
    RADIO_TAIL_REPORTS,
    RADIO_TAIL_REPORTS_COUNT,
    RECORDS,
    ROUTES,
    RUNS_COUNT,
    TAG_LISTS,
    TAGS,
    TERMINALS_LIFE,
    TRACK_LIES_VALUE,
    TRAINS,
    TYPES,
    UNITS_LIFE,
    WORDS,
)
from fuzz.traffic.standing import MOST_LIVES
from fuzz.traffic.steps import LOG_HEAD, intern, list_of, take, take_granting
from fuzz.traffic.tables import (
    ANSWER,
    CAR_FOLLOWS,
    CAR_LEAVES,
    CAR_MOVES,
    IS_BLOCK,
    IS_BLOCKS,
    IS_CAB,
    IS_CAR,
    IS_EPOCH,
    IS_POINT,
    IS_POSITION,
    IS_RECORD,
    IS_RUN,
    IS_TAG,
    IS_TAG_LIST,
    IS_TERMINAL_LIFE,
    IS_TRAIN,
    IS_UNIT_LIFE,
    KINDS,
    NOTE_STANDING,
    NOTE_STATEMENT_CONFIRMED,
    OBEY_ORDER,
    RELEASE_BLOCK,
    RESTART_CENTRE,
    RESTART_TERMINAL,
    RESTART_UNIT,
    TAKE_OFFER,
    TAKE_OVER,
)
from fuzz.traffic.tables import (
    ARRIVALS as TELEGRAMS,
)
from fuzz.traffic.words import base, below, between, get, get1, lowest, minus, of, of2, one_in, row

KINDS_OF_TELEGRAM = len(TELEGRAMS)
MOST_EPOCHS, MOST_TERMINAL_LIVES = 15, 8
RECENT = 64
(A_KIND, AN_ARRAY, FIRST_SIZE, SECOND_SIZE, FIRST_WORD, SECOND_WORD, BIT_WORD) = range(7)


@compiled
def some_bit(desk: Any, word: Any) -> Any:
    """Draw one of the bits that are set; the word is not 0."""
    count, rest = 0, word
    while rest != 0:
        rest &= minus(rest, 1)
        count += 1
    for _ in range(below(desk, count)):
        word &= minus(word, 1)
    return lowest(word)


@compiled
def stale_report(memory: Any, desk: Any) -> None:
    """Some tail report ever sent arrives."""
    count = get(memory, desk, RADIO_TAIL_REPORTS_COUNT)
    if count == 0:
        return
    at = row(desk, RADIO_TAIL_REPORTS, below(desk, count))
    for word in range(of(desk, WORDS, RELEASE_BLOCK)):
        memory[desk[EVENT] + word] = memory[at + word]
    take(memory, desk, RELEASE_BLOCK)


@entry
def stale(memory_at: Any, desk_at: Any) -> Any:
    """Some telegram ever sent arrives, of any life and epoch."""
    memory, desk = both(memory_at, desk_at)
    if one_in(desk, KINDS_OF_TELEGRAM + 1):
        stale_report(memory, desk)
        return 0
    arrival = row(desk, ARRIVALS, below(desk, KINDS_OF_TELEGRAM))
    kind, array = desk[arrival + A_KIND], desk[arrival + AN_ARRAY]
    first_size, second_size = desk[arrival + FIRST_SIZE], desk[arrival + SECOND_SIZE]
    total, event = first_size * second_size, desk[EVENT]
    begin = below(desk, total)
    for at in range(total):
        cell = (begin + at) % total
        word = memory[base(desk, array) + cell]
        if word == 0:
            continue
        if desk[arrival + FIRST_WORD] >= 0:
            memory[event + desk[arrival + FIRST_WORD]] = cell // second_size
        if desk[arrival + SECOND_WORD] >= 0:
            memory[event + desk[arrival + SECOND_WORD]] = cell % second_size
        memory[event + desk[arrival + BIT_WORD]] = some_bit(desk, word)
        arrives_stale(memory, desk, kind)
        return 0
    return 0


@compiled
def arrives_stale(memory: Any, desk: Any, kind: Any) -> None:
    """What else the event says is as true as it can be."""
    event = desk[EVENT]
    if kind in (NOTE_STANDING, NOTE_STATEMENT_CONFIRMED):
        with_run(memory, desk, kind)
        return
    if kind == OBEY_ORDER:
        memory[event + 3] = get1(memory, desk, TRACK_LIES_VALUE, memory[event + 1])
    if kind == TAKE_OFFER:
        memory[event + 1] = list_of(memory, desk, memory[event])
    take(memory, desk, kind)


# ---- anything at all


@compiled
def some_run(memory: Any, desk: Any) -> Any:
    """Some run, old or new, or one that there has never been."""
    count = get(memory, desk, RUNS_COUNT)
    if count > 0 and not one_in(desk, 8):
        return below(desk, count) if one_in(desk, 2) else max(0, count - 1 - below(desk, 8))
    train = below(desk, desk[TRAINS])
    serial = get(memory, desk, CENTRE_NEWEST) + below(desk, 3)
    return intern(memory, desk, serial, train, get1(memory, desk, UNITS_LIFE, train), below(desk, desk[ROUTES]))


@compiled
def some_name(desk: Any, kind: Any) -> Any:
    """Some identifier of a type that the site has so many of, a truth value, or 0 or 1 mm."""
    bound = 2
    if kind == IS_TRAIN:
        bound = desk[TRAINS]
    elif kind == IS_BLOCK:
        bound = desk[BLOCKS]
    elif kind == IS_POINT:
        bound = desk[POINTS]
    elif kind == IS_POSITION:
        bound = desk[POSITIONS]
    elif kind == IS_TAG:
        bound = desk[TAGS]
    elif kind == IS_RECORD:
        bound = desk[RECORDS]
    elif kind == IS_TAG_LIST:
        bound = desk[TAG_LISTS]
    elif kind == IS_CAR:
        bound = desk[CARS]
    elif kind == IS_CAB:
        bound = desk[CABS]
    return below(desk, bound)


@entry
def some_word(memory_at: Any, desk_at: Any, kind: Any, at: Any) -> Any:
    """Draw a word of this type; ``at``: which word of a set of blocks."""
    memory, desk = both(memory_at, desk_at)
    if kind == IS_RUN:
        return some_run(memory, desk)
    if kind == IS_EPOCH:
        return max(0, min(MOST_EPOCHS, get(memory, desk, CENTRE_EPOCH) + between(desk, -1, 1)))
    if kind == IS_UNIT_LIFE:
        life = get1(memory, desk, UNITS_LIFE, below(desk, desk[TRAINS]))
        return max(0, min(MOST_LIVES - 1, life + between(desk, -1, 1)))
    if kind == IS_TERMINAL_LIFE:
        return below(desk, MOST_TERMINAL_LIVES)
    if kind == IS_BLOCKS:
        block = below(desk, desk[BLOCKS])
        return 1 << (block & 63) if block >> 6 == at else 0
    return some_name(desk, kind)


@compiled
def put_words(memory: Any, desk: Any, kind: Any, only: Any) -> None:
    """Draw the words of an event; ``only``: this one, or -1 for all."""
    blocks = 0
    for at in range(of(desk, WORDS, kind)):
        is_what = of2(desk, TYPES, kind, at)
        if only < 0 or only == at:
            memory[desk[EVENT] + at] = some_word(memory, desk, is_what, blocks)
        if is_what == IS_BLOCKS:
            blocks += 1


@compiled
def may_be_any(memory: Any, desk: Any, kind: Any) -> Any:
    """Whether an event of this kind may be drawn; restarts are few and take the next number, cars run by themselves."""
    event = desk[EVENT]
    if kind in (CAR_MOVES, CAR_FOLLOWS, CAR_LEAVES):
        return False
    if kind == RESTART_CENTRE:
        memory[event] = get(memory, desk, CENTRE_EPOCH) + 1
        return memory[event] < MOST_EPOCHS and one_in(desk, 16)
    if kind in (ANSWER, TAKE_OVER, RESTART_UNIT):
        life = 1 if kind == RESTART_UNIT else 2
        memory[event + life] = get1(memory, desk, UNITS_LIFE, memory[event]) + 1
        return memory[event + life] < MOST_LIVES and one_in(desk, 8)
    if kind == RESTART_TERMINAL:
        memory[event + 1] = get1(memory, desk, TERMINALS_LIFE, memory[event]) + 1
        return memory[event + 1] < MOST_TERMINAL_LIVES and one_in(desk, 8)
    return True


@entry
def any_event(memory_at: Any, desk_at: Any) -> Any:
    """An event of any kind happens, with anything in it."""
    memory, desk = both(memory_at, desk_at)
    kind, slots = below(desk, KINDS), get(memory, desk, RUNS_COUNT)
    put_words(memory, desk, kind, -1)
    if may_be_any(memory, desk, kind):
        take_granting(memory, desk, kind, slots)
    else:
        memory[base(desk, RUNS_COUNT)] = slots
    return 0


@compiled
def read_log(memory: Any, desk: Any, at: Any) -> Any:
    """Write an event that was taken into the buffer again; gives its kind."""
    come = row(desk, LOG, at)
    kind, come = desk[come], come + LOG_HEAD
    for word in range(of(desk, WORDS, kind)):
        if of2(desk, TYPES, kind, word) == IS_RUN:
            memory[desk[EVENT] + word] = intern(
                memory, desk, desk[come], desk[come + 1], desk[come + 2], desk[come + 3]
            )
            come += 4
        else:
            memory[desk[EVENT] + word] = desk[come]
            come += 1
    return kind


@entry
def again(memory_at: Any, desk_at: Any) -> Any:
    """An event that was taken happens once more, as it was or with one word changed."""
    memory, desk = both(memory_at, desk_at)
    if desk[ACCEPTED] == 0:
        return 0
    slots, recent = get(memory, desk, RUNS_COUNT), min(RECENT, desk[ACCEPTED])
    at = desk[ACCEPTED] - 1 - below(desk, recent) if one_in(desk, 2) else below(desk, desk[ACCEPTED])
    kind = read_log(memory, desk, at)
    if one_in(desk, 2):
        put_words(memory, desk, kind, below(desk, of(desk, WORDS, kind)))
    if may_be_any(memory, desk, kind):
        take_granting(memory, desk, kind, slots)
    else:
        memory[base(desk, RUNS_COUNT)] = slots
    return 0
