"""What goes wrong by the second: machines, trains, antennas, points and people (T3, T5, T8, T9, T10)."""

from __future__ import annotations

from typing import Any

from fuzz.traffic.adversary import MOST_EPOCHS, MOST_TERMINAL_LIVES, again, any_event, stale
from fuzz.traffic.compiling import compiled
from fuzz.traffic.entries import both, entry
from fuzz.traffic.faults import number
from fuzz.traffic.journey import AT_REST, RUNS, WAITS, begin_giving_back, lose_way
from fuzz.traffic.messages import NO_RUN, OFFERED, SET, ask_back, stage
from fuzz.traffic.motion import car_at, faces, front_block, rear_block, rest, shorten, turn
from fuzz.traffic.places import (
    BASE,
    BLOCKS,
    BOUNDARY,
    BY,
    CAR,
    CAR_COUNT,
    CAUSE,
    CENTRE_EPOCH,
    CENTRE_NEWEST,
    CLOCK,
    DEAD_HEAD,
    DEAD_TAIL,
    DRAWN,
    FIRST,
    FROM,
    FROM_ROUTE,
    HIGHEST,
    JOINTS,
    LAST_SERIAL,
    LEADS,
    LEG,
    LEGS,
    LENGTH,
    LINE,
    LOWEST,
    MOST_TRAIL,
    MOVING,
    ON_LINE,
    ONWARD,
    PHASE,
    POINTS,
    PRESENT,
    ROUTES,
    RUN,
    RUNS_COUNT,
    STANDING,
    TERMINALS_LIFE,
    TRACK_AT_VALUE,
    TRACK_PARTED,
    TRAIL,
    TRAINS,
    TROUBLE,
    TROUBLES,
    UNITS_LIFE,
    WAY,
)
from fuzz.traffic.standing import MOST_LIVES
from fuzz.traffic.steps import (
    intern,
    next_run,
    put2,
    put4,
    set_train,
    take1,
    take2,
    take3,
    take_beyond,
    take_granting,
    train_word,
)
from fuzz.traffic.tables import (
    CANCEL,
    CAR_FOLLOWS,
    CAR_LEAVES,
    CAR_MOVES,
    DRIFT,
    PART,
    REQUEST,
    RESTART_CENTRE,
    RESTART_TERMINAL,
    RESTART_UNIT,
    WINDOW_PASSES,
    WITHDRAW,
)
from fuzz.traffic.words import below, between, bit, chance, get, get1, has, of, of2, one_in, row

STALE, AGAIN, ANY = number("stale message"), number("plausible adversary"), number("random adversary")
UNIT, CENTRE, TERMINAL = number("unit restart"), number("centre restart"), number("terminal restart")
DEAD, OVERDUE, BROKEN_LINE = number("dead antenna"), number("overdue tag"), number("broken line")
SPLIT, COUPLING, HEALED = number("split"), number("coupling"), number("line healed falsely")
CHANGED_ENDS = number("change of ends on the line")
DRIFTS, CANCELLED, WITHDRAWN = number("point drifts"), number("cancellation"), number("withdrawal")
ABSURD, PASSED = number("absurd request"), number("passed end of authority")
WHOLE = (1 << 32) - 1


# ---- machines


@compiled
def unit_restarts(memory: Any, desk: Any, train: Any) -> None:
    """A unit restarts; a train that rolls comes to rest at once or a little later."""
    life = get1(memory, desk, UNITS_LIFE, train) + 1
    if life >= MOST_LIVES:
        return
    take2(memory, desk, RESTART_UNIT, train, life)
    if train_word(desk, train, PHASE) != RUNS or one_in(desk, 2):
        lose_way(memory, desk, train)


@entry
def centre_restarts(memory_at: Any, desk_at: Any) -> Any:
    """The centre restarts; every train has to tell where it stands, those that roll perhaps later."""
    memory, desk = both(memory_at, desk_at)
    epoch = get(memory, desk, CENTRE_EPOCH) + 1
    if epoch >= MOST_EPOCHS:
        return 0
    take1(memory, desk, RESTART_CENTRE, epoch)
    for train in range(desk[TRAINS]):
        set_train(desk, train, CAUSE, CENTRE)
        if train_word(desk, train, PHASE) != RUNS or one_in(desk, 2):
            lose_way(memory, desk, train)
    return 0


@compiled
def terminal_restarts(memory: Any, desk: Any) -> None:
    """A terminal restarts."""
    point = below(desk, desk[POINTS])
    life = get1(memory, desk, TERMINALS_LIFE, point) + 1
    if desk[POINTS] > 0 and life < MOST_TERMINAL_LIVES:
        take2(memory, desk, RESTART_TERMINAL, point, life)


@entry
def of_machines(memory_at: Any, desk_at: Any, fault: Any, train: Any) -> Any:
    """Restarts and points; tell whether it was one of these."""
    memory, desk = both(memory_at, desk_at)
    if fault == UNIT:
        set_train(desk, train, CAUSE, fault)
        unit_restarts(memory, desk, train)
    elif fault == CENTRE:
        centre_restarts(memory, desk)
    elif fault == TERMINAL:
        terminal_restarts(memory, desk)
    elif fault == DRIFTS:
        point = below(desk, desk[POINTS])
        take2(memory, desk, DRIFT, point, of2(desk, LEG, point, below(desk, of(desk, LEGS, point))))
    else:
        return False
    return True


# ---- trains


@entry
def splits(memory_at: Any, desk_at: Any, train: Any) -> Any:
    """A coupling breaks; the cars behind it stay where they are."""
    memory, desk = both(memory_at, desk_at)
    moving = train_word(desk, train, MOVING)
    if has(memory, desk, TRACK_PARTED, train) or moving < 2:
        return 0
    take1(memory, desk, PART, train)
    kept = 1 + below(desk, moving - 1)
    if train_word(desk, train, LEADS) == 0:
        set_train(desk, train, FIRST, train_word(desk, train, FIRST) + moving - kept)
    set_train(desk, train, MOVING, kept)
    shorten(desk, train)
    if one_in(desk, 2):
        lose_way(memory, desk, train)
    return 0


@compiled
def fetches(memory: Any, desk: Any, train: Any, car: Any) -> None:
    """A car left behind comes up to the last one that runs, and stands in its block."""
    last, target = car_at(desk, train, train_word(desk, train, MOVING) - 1), rear_block(desk, train)
    name = of2(desk, CAR, train, car)
    take3(memory, desk, CAR_FOLLOWS, name, of2(desk, CAR, train, last), target)
    at = row(desk, TRACK_AT_VALUE, name)
    if not bit(memory, at, target):
        return
    for block in range(desk[BLOCKS]):
        if block != target and bit(memory, at, block):
            take2(memory, desk, CAR_LEAVES, name, block)
    desk[DRAWN + COUPLING] += 1
    set_train(desk, train, LOWEST + car, 0)
    set_train(desk, train, HIGHEST + car, 0)
    if car < train_word(desk, train, FIRST):
        set_train(desk, train, FIRST, car)
    set_train(desk, train, MOVING, train_word(desk, train, MOVING) + 1)


@entry
def couples(memory_at: Any, desk_at: Any, train: Any) -> Any:
    """A train that runs has the next car left behind it again."""
    memory, desk = both(memory_at, desk_at)
    first, moving = train_word(desk, train, FIRST), train_word(desk, train, MOVING)
    if train_word(desk, train, PHASE) != RUNS:
        return 0
    if train_word(desk, train, LEADS) == 1 and first + moving < of(desk, CAR_COUNT, train):
        fetches(memory, desk, train, first + moving)
    elif train_word(desk, train, LEADS) == 0 and first > 0:
        fetches(memory, desk, train, first - 1)
    return 0


@entry
def passes_authority(memory_at: Any, desk_at: Any, train: Any) -> Any:
    """A train at rest moves on, into the next block of some route that begins where it stands."""
    memory, desk = both(memory_at, desk_at)
    block, length, car = front_block(desk, train), train_word(desk, train, LENGTH), car_at(desk, train, 0)
    count = of(desk, FROM, block)
    whole = train_word(desk, train, LOWEST + car) == train_word(desk, train, HIGHEST + car)
    if count == 0 or train_word(desk, train, PHASE) != AT_REST or length >= MOST_TRAIL - 4 or not whole:
        return 0
    route, slots = of2(desk, FROM_ROUTE, block, below(desk, count)), get(memory, desk, RUNS_COUNT)
    target, tag = of2(desk, WAY, route, block), of2(desk, BOUNDARY, route, block)
    if tag < 0 or target < 0 or not faces(memory, desk, train, route):
        return 0
    run = next_run(memory, desk, train, get1(memory, desk, UNITS_LIFE, train), route)
    put4(memory, desk, run, of2(desk, CAR, train, car), block, target)
    if not take_beyond(memory, desk, CAR_MOVES):
        memory[row(desk, RUNS_COUNT, 0)] = slots
        return 0
    set_train(desk, train, TRAIL + length, target)
    set_train(desk, train, JOINTS + length - 1, tag)
    set_train(desk, train, LENGTH, length + 1)
    set_train(desk, train, HIGHEST + car, length)
    return 0


@entry
def changes_ends(memory_at: Any, desk_at: Any, train: Any) -> Any:
    """The driver stops where he is and changes ends; he goes back to the first and on, or asks for another way."""
    memory, desk = both(memory_at, desk_at)
    phase = train_word(desk, train, PHASE)
    if phase not in (AT_REST, WAITS, RUNS):
        return 0
    rest(memory, desk, train)
    turn(memory, desk, train)
    if one_in(desk, 2):
        turn(memory, desk, train)
    elif phase == RUNS:
        lose_way(memory, desk, train)
    return 0


@entry
def of_trains(memory_at: Any, desk_at: Any, fault: Any, train: Any) -> Any:
    """Couplings, antennas, odometers; tell whether it was one of these."""
    memory, desk = both(memory_at, desk_at)
    if fault == OVERDUE:
        set_train(desk, train, CAUSE, fault)
        take1(memory, desk, WINDOW_PASSES, train)
    elif fault == DEAD:
        set_train(desk, train, DEAD_HEAD if one_in(desk, 2) else DEAD_TAIL, desk[CLOCK] + between(desk, 60, 600))
    elif fault == BROKEN_LINE:
        set_train(desk, train, LINE, desk[CLOCK] + between(desk, 60, 600))
    elif fault in (SPLIT, HEALED):
        set_train(desk, train, CAUSE, fault)
        splits(memory, desk, train)
    elif fault == CHANGED_ENDS:
        set_train(desk, train, CAUSE, fault)
        changes_ends(memory, desk, train)
    elif fault == COUPLING:
        couples(memory, desk, train)
    elif fault == PASSED:
        passes_authority(memory, desk, train)
    else:
        return False
    return True


# ---- people


@compiled
def cancels(memory: Any, desk: Any, train: Any) -> None:
    """The signaller wants back what a train waits for or runs under."""
    run = train_word(desk, train, ONWARD if one_in(desk, 2) else RUN)
    held = stage(memory, desk, run)
    if held not in (OFFERED, SET) or not take1(memory, desk, CANCEL, run):
        return
    if train_word(desk, train, PHASE) == WAITS:
        set_train(desk, train, CAUSE, CANCELLED)
        begin_giving_back(desk, train)
    else:
        ask_back(memory, desk, train, run, run == train_word(desk, train, ONWARD))


@compiled
def asks_absurdly(memory: Any, desk: Any, train: Any) -> None:
    """Somebody asks for a run that cannot be, or for any at all."""
    under, life = train_word(desk, train, BASE), get1(memory, desk, UNITS_LIFE, train)
    serial, route = get(memory, desk, CENTRE_NEWEST) + 1, below(desk, desk[ROUTES])
    slots, kind = get(memory, desk, RUNS_COUNT), below(desk, 6)
    start = FROM_ROUTE
    if under != NO_RUN and of(desk, FROM, front_block(desk, train)) > 0:
        route = of2(desk, start, front_block(desk, train), below(desk, of(desk, FROM, front_block(desk, train))))
    if kind == 0:
        route = desk[STANDING]
    elif kind == 1:
        serial = below(desk, serial)
    elif kind == 2:
        under = train_word(desk, below(desk, desk[TRAINS]), BASE)
    elif kind == 3:
        serial = desk[LAST_SERIAL]
    elif kind == 4:
        life = max(0, life - 1)
    else:
        route = below(desk, desk[ROUTES])
    run = intern(memory, desk, serial, train, life, route)
    put2(memory, desk, run, max(0, under))
    if take_granting(memory, desk, REQUEST, slots) and not one_in(desk, 4):
        take1(memory, desk, WITHDRAW, run)


@entry
def of_people(memory_at: Any, desk_at: Any, fault: Any, train: Any) -> Any:
    """Signallers; tell whether it was one of these."""
    memory, desk = both(memory_at, desk_at)
    if fault == CANCELLED:
        cancels(memory, desk, train)
    elif fault == WITHDRAWN:
        run = train_word(desk, train, ONWARD if one_in(desk, 2) else RUN)
        if run != NO_RUN:
            set_train(desk, train, CAUSE, fault)
            take1(memory, desk, WITHDRAW, run)
    elif fault == ABSURD:
        asks_absurdly(memory, desk, train)
    else:
        return False
    return True


@entry
def strike(memory_at: Any, desk_at: Any, fault: Any) -> Any:
    """Something goes wrong."""
    memory, desk = both(memory_at, desk_at)
    desk[DRAWN + fault] += 1 if fault != COUPLING else 0
    desk[BY] = fault
    train = below(desk, desk[ON_LINE])
    if fault == STALE:
        stale(memory, desk)
    elif fault == AGAIN:
        again(memory, desk)
    elif fault == ANY:
        any_event(memory, desk)
    elif not of_machines(memory, desk, fault, train) and not of_trains(memory, desk, fault, train):
        of_people(memory, desk, fault, train)
    desk[BY] = -1
    return 0


@entry
def trouble(memory_at: Any, desk_at: Any, seconds: Any) -> Any:
    """Each of the trace's faults that come by the second comes or does not, in so many seconds."""
    memory, desk = both(memory_at, desk_at)
    for at in range(desk[TROUBLES]):
        fault = desk[TROUBLE + at]
        if chance(desk, min(WHOLE, desk[PRESENT + fault] * seconds)):
            strike(memory, desk, fault)
    return 0
