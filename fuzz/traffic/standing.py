"""A train tells where it stands, or two persons do, and the centre learns how points below it lie (T8)."""

from __future__ import annotations

from typing import Any

from fuzz.traffic.air import arrive, arrive_with_run, comes, strikes
from fuzz.traffic.compiling import compiled
from fuzz.traffic.entries import both, entry
from fuzz.traffic.faults import number
from fuzz.traffic.messages import NO_RUN, STANDS, claimed_by, confirm, has_order, hear, stage
from fuzz.traffic.places import (
    BLOCK_WORDS,
    BLOCKS,
    BY,
    CAR,
    CAR_COUNT,
    CENTRE_ACCOUNTED,
    CENTRE_ACCOUNTED_VALUE,
    CENTRE_EPOCH,
    CENTRE_LOST_POINTS,
    CENTRE_NEWEST,
    CLOCK,
    EVENT,
    LAST_SERIAL,
    LINE,
    POINTS,
    PRESENT,
    ROUTES,
    RUNS_COUNT,
    RUNS_LIFE,
    RUNS_TRAIN,
    STANDING,
    STANDS_IN,
    TELLING,
    TRACK_AT_VALUE,
    TRACK_LIES_VALUE,
    TRACK_PARTED,
    UNITS_ANSWERED,
    UNITS_LIFE,
)
from fuzz.traffic.senses import STANDSTILL_WORDS, put_line, put_standstill
from fuzz.traffic.steps import (
    NUMBERS_SPENT,
    end,
    intern,
    put3,
    put4,
    set_train,
    take,
    take1,
    take2,
    take_beyond,
    take_granting,
    train_word,
)
from fuzz.traffic.tables import (
    ADOPT_POINT,
    ANSWER,
    ANSWER_ENQUIRY,
    CONFIRM_STATEMENT,
    CORRECT_STATEMENT,
    NOTE_STANDING,
    NOTE_STATEMENT,
    NOTE_STATEMENT_CONFIRMED,
    OPEN_PROCEDURE,
    RELAY_ENQUIRY,
    RESTART_UNIT,
    SEND_CHALLENGE,
    SEND_ENQUIRY,
    SEND_STANDING,
    SEND_STANDING_RUN,
    TAKE_OVER,
    TAKE_STANDING,
)
from fuzz.traffic.words import below, get, get1, has, of, of2, one_in, row

SUPERVISED, WRONG = number("supervised procedure"), number("wrong statement")
FALSE_STANDSTILL, BOTH_ERR, ABSURD = number("false standstill"), number("both persons err"), number("absurd request")
MOST_LIVES = 31
"""A unit's lives stay below this."""
AFRESH, TOLD, STATED = range(3)
"""How far a train has come with telling where it stands."""


@compiled
def put_place(memory: Any, desk: Any, train: Any, at: Any) -> None:
    """Write the blocks that a train is in, as bits."""
    for word in range(desk[BLOCK_WORDS]):
        blocks = 0
        for place in range(of(desk, CAR_COUNT, train)):
            blocks |= memory[row(desk, TRACK_AT_VALUE, of2(desk, CAR, train, place)) + word]
        memory[at + word] = blocks


@compiled
def put_wrong_place(memory: Any, desk: Any, train: Any, at: Any) -> None:
    """Write blocks that a train is not in, or not only in: one is forgotten, or added, or they are of elsewhere."""
    put_place(memory, desk, train, at)
    if one_in(desk, 3):
        for word in range(desk[BLOCK_WORDS]):
            memory[at + word] = 0
    block = below(desk, desk[BLOCKS])
    memory[at + (block >> 6)] ^= 1 << (block & 63)


@compiled
def put_nowhere(memory: Any, desk: Any, at: Any) -> None:
    """Write no block: where two persons who err alike say that the train is gone."""
    for word in range(desk[BLOCK_WORDS]):
        memory[at + word] = 0


@compiled
def new_life(memory: Any, desk: Any, train: Any) -> Any:
    """The number of the unit's next life; the trace ends before they are spent."""
    life = get1(memory, desk, UNITS_LIFE, train) + 1
    if life >= MOST_LIVES:
        end(desk, NUMBERS_SPENT)
        return life - 1
    return life


@entry
def answers(memory_at: Any, desk_at: Any, train: Any) -> Any:
    """A challenge comes, and the unit answers it in a new life, after a restart if it has answered before."""
    memory, desk = both(memory_at, desk_at)
    epoch = get(memory, desk, CENTRE_EPOCH)
    take1(memory, desk, SEND_CHALLENGE, epoch)
    if get1(memory, desk, UNITS_ANSWERED, train) == epoch:
        take2(memory, desk, RESTART_UNIT, train, new_life(memory, desk, train))
    life, healthy = new_life(memory, desk, train), 1 if train_word(desk, train, LINE) <= desk[CLOCK] else 0
    if not comes(memory, desk, ANSWER, train):
        return False
    put3(memory, desk, train, epoch, life)
    words = desk[BLOCK_WORDS]
    put_standstill(memory, desk[EVENT] + 3 + words, 1)
    put_line(memory, desk[EVENT] + 3 + words + STANDSTILL_WORDS, healthy)
    if strikes(desk, FALSE_STANDSTILL, train):
        put_wrong_place(memory, desk, train, desk[EVENT] + 3)
        return take_beyond(memory, desk, ANSWER)
    put_place(memory, desk, train, desk[EVENT] + 3)
    return take(memory, desk, ANSWER)


@compiled
def corrects(memory: Any, desk: Any, train: Any, epoch: Any, life: Any) -> None:
    """The first person states where the train is after all; every other time the centre hears no more of it."""
    put3(memory, desk, train, epoch, life)
    put_place(memory, desk, train, desk[EVENT] + 3)
    take(memory, desk, CORRECT_STATEMENT)
    if one_in(desk, 2):
        put3(memory, desk, train, life, epoch)
        arrive(memory, desk, NOTE_STATEMENT, train)


@entry
def two_persons(memory_at: Any, desk_at: Any, train: Any) -> Any:
    """Two persons state where a train stands; tell whether the centre has taken their word."""
    memory, desk = both(memory_at, desk_at)
    epoch, life = get(memory, desk, CENTRE_EPOCH), new_life(memory, desk, train)
    take1(memory, desk, SEND_CHALLENGE, epoch)
    take1(memory, desk, OPEN_PROCEDURE, train)
    err = strikes(desk, BOTH_ERR, train)
    wrong = err or strikes(desk, WRONG, train)
    put3(memory, desk, train, epoch, life)
    if err:
        put_nowhere(memory, desk, desk[EVENT] + 3)
    elif wrong:
        put_wrong_place(memory, desk, train, desk[EVENT] + 3)
    else:
        put_place(memory, desk, train, desk[EVENT] + 3)
    take(memory, desk, TAKE_OVER)
    put3(memory, desk, train, life, epoch)
    arrive(memory, desk, NOTE_STATEMENT, train)
    if wrong and not err and one_in(desk, 2):
        corrects(memory, desk, train, epoch, life)
    put3(memory, desk, train, epoch, life)
    if err:
        put_nowhere(memory, desk, desk[EVENT] + 3)
        desk[BY] = BOTH_ERR
        take_beyond(memory, desk, CONFIRM_STATEMENT)
    else:
        put_place(memory, desk, train, desk[EVENT] + 3)
        take(memory, desk, CONFIRM_STATEMENT)
    put3(memory, desk, train, life, epoch)
    return arrive_with_run(memory, desk, NOTE_STATEMENT_CONFIRMED, train)


@compiled
def accounted(memory: Any, desk: Any, train: Any) -> Any:
    """Whether the centre has the train's word in this life."""
    return has(memory, desk, CENTRE_ACCOUNTED, train) and get1(memory, desk, CENTRE_ACCOUNTED_VALUE, train) == get1(
        memory, desk, UNITS_LIFE, train
    )


@entry
def told_absurdly(memory_at: Any, desk_at: Any, train: Any, epoch: Any) -> Any:
    """The centre would note the train's word under a run that cannot be: with a route, an old or the last number."""
    memory, desk = both(memory_at, desk_at)
    life, slots = get1(memory, desk, UNITS_LIFE, train), get(memory, desk, RUNS_COUNT)
    serial, route, kind = get(memory, desk, CENTRE_NEWEST) + 1, desk[STANDING], below(desk, 3)
    if kind == 0:
        route = below(desk, desk[ROUTES])
    elif kind == 1:
        serial = below(desk, serial)
    else:
        serial = desk[LAST_SERIAL]
    put4(memory, desk, train, life, epoch, intern(memory, desk, serial, train, life, route))
    desk[BY] = ABSURD
    take_granting(memory, desk, NOTE_STANDING, slots)
    return 0


@entry
def tell(memory_at: Any, desk_at: Any, train: Any) -> Any:
    """A train at rest tells where it stands; gives the run it is told to stand under, -1 as long as there is none."""
    memory, desk = both(memory_at, desk_at)
    epoch, telling = get(memory, desk, CENTRE_EPOCH), train_word(desk, train, TELLING)
    if telling == TOLD and get1(memory, desk, UNITS_ANSWERED, train) != epoch:
        telling = AFRESH
    if telling == AFRESH:
        if has(memory, desk, TRACK_PARTED, train) or strikes(desk, SUPERVISED, train):
            telling = STATED if two_persons(memory, desk, train) else AFRESH
        else:
            telling = TOLD if answers(memory, desk, train) else AFRESH
    if telling == TOLD and not accounted(memory, desk, train):
        take2(memory, desk, SEND_STANDING, train, epoch)
        if desk[PRESENT + ABSURD] != 0 and one_in(desk, 4):
            told_absurdly(memory, desk, train, epoch)
        put3(memory, desk, train, get1(memory, desk, UNITS_LIFE, train), epoch)
        arrive_with_run(memory, desk, NOTE_STANDING, train)
    set_train(desk, train, TELLING, telling)
    if telling == AFRESH:
        return NO_RUN
    if not accounted(memory, desk, train):
        set_train(desk, train, TELLING, AFRESH if telling == STATED else telling)
        return NO_RUN
    return told(memory, desk, train)


@compiled
def told(memory: Any, desk: Any, train: Any) -> Any:
    """The train is told under which run it stands; that run, once it knows it, or -1."""
    life = get1(memory, desk, UNITS_LIFE, train)
    for run in range(get(memory, desk, RUNS_COUNT)):
        if stage(memory, desk, run) == STANDS and get1(memory, desk, RUNS_TRAIN, run) == train:
            if memory[row(desk, RUNS_LIFE, run)] != life:
                continue
            if not has_order(memory, desk, train, run):
                take1(memory, desk, SEND_STANDING_RUN, run)
                memory[desk[EVENT]] = run
                arrive(memory, desk, TAKE_STANDING, train)
            return run if has_order(memory, desk, train, run) else NO_RUN
    return NO_RUN


@entry
def adopt_points(memory_at: Any, desk_at: Any, train: Any, run: Any) -> Any:
    """The centre learns how points below a standing train lie; tell whether it knows all of them."""
    memory, desk = both(memory_at, desk_at)
    all_known = True
    for point in range(desk[POINTS]):
        if not has(memory, desk, CENTRE_LOST_POINTS, point):
            continue
        if not claimed_by(memory, desk, of(desk, STANDS_IN, point), run):
            continue
        life = hear(memory, desk, train, point)
        put3(memory, desk, run, point, life)
        take(memory, desk, SEND_ENQUIRY)
        put3(memory, desk, run, point, life)
        arrive(memory, desk, RELAY_ENQUIRY, train)
        put3(memory, desk, run, point, life)
        arrive(memory, desk, ANSWER_ENQUIRY, train)
        confirm(memory, desk, train, run, point)
        put3(memory, desk, run, point, get1(memory, desk, TRACK_LIES_VALUE, point))
        arrive(memory, desk, ADOPT_POINT, train)
        all_known = all_known and not has(memory, desk, CENTRE_LOST_POINTS, point)
    return all_known
