"""One train's day: it tells where it stands, asks for a route, waits for points and loops, runs, arrives, goes on.

The model is ``models.simulator.journey``; here a train is words of the desk, and what it does next follows from them
and from the state.  ``BASE`` is the run it stands or moves under, ``RUN`` the one asked for or being run, ``ONWARD``
the one set ahead, each -1 for none; ``PATIENCE`` how often it still tries what it is trying; ``CAUSE`` why it stands.
"""

from __future__ import annotations

from typing import Any

from fuzz.traffic.air import strikes
from fuzz.traffic.asking import ask, holds_elsewhere, way_on
from fuzz.traffic.compiling import compiled
from fuzz.traffic.entries import both, entry
from fuzz.traffic.faults import number
from fuzz.traffic.messages import (
    NO_RUN,
    OVER,
    RESERVED,
    SET,
    STANDS,
    ask_back,
    close_loop,
    has_order,
    report,
    retire_what_is_over,
    stage,
    tell_stopped,
)
from fuzz.traffic.motion import (
    choose_ends,
    faces,
    find_overdue,
    follows,
    front_block,
    front_passes,
    has_missed,
    must_follow,
    rear_block,
    rest,
    turn,
)
from fuzz.traffic.places import (
    BASE,
    BY,
    BY_TIMETABLE,
    BY_TRAFFIC,
    CAUSE,
    CLOCK,
    DESTINATION,
    DONE,
    DRAWN,
    EVENT,
    FINISHED,
    LENGTH,
    ONWARD,
    PATIENCE,
    PHASE,
    PRESENT,
    RUN,
    STANDSTILL,
    TELLING,
    TRACK_ROLLING,
    UNITS_LOOP_OPEN,
    WAITING,
    WAKE,
    WANTED,
)
from fuzz.traffic.senses import put_standing, put_stopped
from fuzz.traffic.standing import AFRESH, accounted, adopt_points, tell
from fuzz.traffic.steps import route_of, set_train, take1, take_beyond, train_word
from fuzz.traffic.tables import (
    CANCEL,
    COME_TO_REST,
    GIVE_BACK,
    NOTE_GIVEN_BACK,
    NOTE_STOPPED,
    OVERRUN,
    RECALL,
    RELEASE_OVERLAP,
    SEND_RECALL,
    SEND_RETURN,
    SEND_STOP,
    START_ROLLING,
    WITHDRAW,
)
from fuzz.traffic.words import between, get1, has, of, one_in

LOST, AT_REST, WAITS, RUNS, GIVES_BACK, OFF = range(6)
"""What a train is doing; ``OFF``: it is in the register and not on the line."""
CANCELLED = number("cancellation")
SLIP, STOP = number("slip into the overlap"), number("stop on the line")
FALSELY_SHORT, FALSELY_WITHIN = number("falsely short of the run"), number("falsely within the destination")


@compiled
def later(desk: Any, train: Any, least: Any, most: Any) -> None:
    """The train does something again after so many seconds."""
    set_train(desk, train, WAKE, desk[CLOCK] + between(desk, least, most))


@entry
def lose_way(memory_at: Any, desk_at: Any, train: Any) -> Any:
    """The train comes to rest wherever it is and has to tell anew where it stands."""
    memory, desk = both(memory_at, desk_at)
    rest(memory, desk, train)
    find_overdue(memory, desk, train)
    if train_word(desk, train, CAUSE) == BY_TIMETABLE:
        set_train(desk, train, CAUSE, BY_TRAFFIC)
    set_train(desk, train, PHASE, LOST)
    for word in (BASE, RUN, ONWARD):
        set_train(desk, train, word, NO_RUN)
    set_train(desk, train, TELLING, AFRESH)
    set_train(desk, train, PATIENCE, 10)
    later(desk, train, 5, 5)
    return 0


@compiled
def stand(desk: Any, train: Any, least: Any, most: Any) -> None:
    """The train stands, and asks for a route after so many seconds."""
    set_train(desk, train, PHASE, AT_REST)
    set_train(desk, train, RUN, NO_RUN)
    set_train(desk, train, PATIENCE, 12)
    later(desk, train, least, most)


@compiled
def begin_giving_back(desk: Any, train: Any) -> None:
    """The train is asked for the run that it waits for, until it has given it back."""
    set_train(desk, train, PHASE, GIVES_BACK)
    set_train(desk, train, PATIENCE, 20)


@entry
def is_lost(memory_at: Any, desk_at: Any, train: Any) -> Any:
    """It tells where it stands until it has heard under which run."""
    memory, desk = both(memory_at, desk_at)
    rest(memory, desk, train)
    if train_word(desk, train, LENGTH) > 0 and one_in(desk, 4):
        choose_ends(memory, desk, train)
    run = tell(memory, desk, train)
    later(desk, train, 2, 6)
    if run == NO_RUN:
        return 0
    retire_what_is_over(memory, desk, train)
    set_train(desk, train, BASE, run)
    if train_word(desk, train, LENGTH) == 0:
        set_train(desk, train, PHASE, OFF)
        return 0
    known = adopt_points(memory, desk, train, run)
    set_train(desk, train, PATIENCE, train_word(desk, train, PATIENCE) - 1)
    if known or train_word(desk, train, PATIENCE) < 0:
        stand(desk, train, 2, 10)
    return 0


@entry
def is_at_rest(memory_at: Any, desk_at: Any, train: Any) -> Any:
    """Report what is left over, then ask for some route from here; the train turns if that is its way."""
    memory, desk = both(memory_at, desk_at)
    under = train_word(desk, train, BASE)
    held = stage(memory, desk, under)
    if (held not in (SET, STANDS)) or not accounted(memory, desk, train):
        lose_way(memory, desk, train)
        return 0
    report(memory, desk, train)
    tell_stopped(memory, desk, train, under)
    retire_what_is_over(memory, desk, train)
    later(desk, train, 5, 20)
    if holds_elsewhere(memory, desk, train):
        set_train(desk, train, PATIENCE, train_word(desk, train, PATIENCE) - 1)
        if train_word(desk, train, PATIENCE) < 0:
            lose_way(memory, desk, train)
            return 0
    if train_word(desk, train, DONE) >= train_word(desk, train, WANTED):
        later(desk, train, 60, 120)
        return 0
    block = front_block(desk, train) if one_in(desk, 2) else rear_block(desk, train)
    route = way_on(memory, desk, train, block, False)
    if route < 0:
        return 0
    run = ask(memory, desk, train, route, under)
    if run == NO_RUN:
        if train_word(desk, train, CAUSE) == BY_TIMETABLE:
            set_train(desk, train, CAUSE, BY_TRAFFIC)
        return 0
    set_train(desk, train, RUN, run)
    set_train(desk, train, PHASE, WAITS)
    set_train(desk, train, PATIENCE, 60)
    later(desk, train, 1, 2)
    return 0


@entry
def waits(memory_at: Any, desk_at: Any, train: Any) -> Any:
    """Points and loops; given up when it takes too long."""
    memory, desk = both(memory_at, desk_at)
    run = train_word(desk, train, RUN)
    held, patience = stage(memory, desk, run), train_word(desk, train, PATIENCE) - 1
    set_train(desk, train, PATIENCE, patience)
    if not accounted(memory, desk, train):
        lose_way(memory, desk, train)
    elif held < 0 or held == OVER:
        retire_what_is_over(memory, desk, train)
        stand(desk, train, 5, 15)
    elif patience < 0 and held == RESERVED:
        take1(memory, desk, WITHDRAW, run)
        retire_what_is_over(memory, desk, train)
        stand(desk, train, 5, 15)
    elif patience < 0:
        take1(memory, desk, CANCEL, run)
        begin_giving_back(desk, train)
    else:
        later(desk, train, 1, 4)
        if close_loop(memory, desk, train, run):
            depart(memory, desk, train, run)
    return 0


@entry
def gives_back(memory_at: Any, desk_at: Any, train: Any) -> Any:
    """The signaller wants the run back before the train moves."""
    memory, desk = both(memory_at, desk_at)
    run = train_word(desk, train, RUN)
    held, patience = stage(memory, desk, run), train_word(desk, train, PATIENCE) - 1
    set_train(desk, train, PATIENCE, patience)
    later(desk, train, 1, 5)
    if held < 0 or held == OVER:
        retire_what_is_over(memory, desk, train)
        stand(desk, train, 5, 15)
    elif patience < 0 or not accounted(memory, desk, train):
        lose_way(memory, desk, train)
    elif held == RESERVED:
        take1(memory, desk, WITHDRAW, run)
    else:
        ask_back(memory, desk, train, run, True)
    return 0


@entry
def depart(memory_at: Any, desk_at: Any, train: Any, run: Any) -> Any:
    """The driver chooses his end, turning if that is his way, and the train begins to roll."""
    memory, desk = both(memory_at, desk_at)
    if desk[PRESENT + CANCELLED] != 0 and one_in(desk, 8):
        desk[BY], desk[DRAWN + CANCELLED] = CANCELLED, desk[DRAWN + CANCELLED] + 1
        set_train(desk, train, CAUSE, CANCELLED)
        take1(memory, desk, CANCEL, run)
        begin_giving_back(desk, train)
        return 0
    if not faces(memory, desk, train, route_of(memory, desk, run)):
        turn(memory, desk, train)
    choose_ends(memory, desk, train)
    if not take1(memory, desk, START_ROLLING, run):
        take1(memory, desk, CANCEL, run)
        begin_giving_back(desk, train)
        return 0
    set_train(desk, train, CAUSE, BY_TRAFFIC)
    set_train(desk, train, PHASE, RUNS)
    later(desk, train, 5, 20)
    if strikes(desk, FALSELY_SHORT, train):
        take1(memory, desk, CANCEL, run)
        take1(memory, desk, SEND_RECALL, run)
        take1(memory, desk, RECALL, run)
        put_standing(memory, desk[EVENT], run, 1, 0, 0)
        desk[BY] = FALSELY_SHORT
        take_beyond(memory, desk, GIVE_BACK)
        take1(memory, desk, SEND_RETURN, run)
        take1(memory, desk, NOTE_GIVEN_BACK, run)
    return 0


@compiled
def goes_on(memory: Any, desk: Any, train: Any, run: Any) -> Any:
    """Whether a train that runs still has its authority and rolls; without it, it may get over one more boundary."""
    if has_missed(memory, desk, train) and one_in(desk, 2):
        find_overdue(memory, desk, train)
    closed = has_order(memory, desk, train, run) and get1(memory, desk, UNITS_LOOP_OPEN, train) == 0
    if closed and (has(memory, desk, TRACK_ROLLING, run) or take1(memory, desk, START_ROLLING, run)):
        return True
    if one_in(desk, 2):
        front_passes(memory, desk, train, run)
        follows(memory, desk, train, run)
    lose_way(memory, desk, train)
    return False


@entry
def runs(memory_at: Any, desk_at: Any, train: Any) -> Any:
    """The next boundary: the rear may lag behind the front by one; the next route may be set ahead."""
    memory, desk = both(memory_at, desk_at)
    run = train_word(desk, train, RUN)
    later(desk, train, 3, 15)
    report(memory, desk, train)
    if not goes_on(memory, desk, train, run):
        return 0
    if strikes(desk, STOP, train):
        take1(memory, desk, COME_TO_REST, run)
        later(desk, train, 20, 200)
        return 0
    destination = of(desk, DESTINATION, route_of(memory, desk, run))
    arrived = front_block(desk, train) == destination
    if arrived and train_word(desk, train, ONWARD) < 0 and one_in(desk, 3):
        ask_ahead(memory, desk, train, run, destination)
    if must_follow(memory, desk, train, run):
        if not follows(memory, desk, train, run):
            lose_way(memory, desk, train)
        return 0
    length = train_word(desk, train, LENGTH)
    if not arrived:
        if not front_passes(memory, desk, train, run):
            lose_way(memory, desk, train)
            return 0
    elif train_word(desk, train, ONWARD) >= 0:
        is_prolonged(memory, desk, train, run)
        return 0
    elif length == 1 or (length == 2 and one_in(desk, 3)):
        arrive_at_destination(memory, desk, train, run)
        return 0
    lags = train_word(desk, train, LENGTH) <= 2 and one_in(desk, 3)
    if not lags and not follows(memory, desk, train, run) and arrived:
        arrive_at_destination(memory, desk, train, run)
    return 0


@compiled
def ask_ahead(memory: Any, desk: Any, train: Any, run: Any, destination: Any) -> None:
    """Ask for a route on in the same direction while still moving."""
    route = way_on(memory, desk, train, destination, True)
    if route >= 0:
        onward = ask(memory, desk, train, route, run)
        set_train(desk, train, ONWARD, onward)
        set_train(desk, train, PATIENCE, 20)


@entry
def is_prolonged(memory_at: Any, desk_at: Any, train: Any, run: Any) -> Any:
    """The run set ahead is waited for, or goes on now, or is given up."""
    memory, desk = both(memory_at, desk_at)
    onward, patience = train_word(desk, train, ONWARD), train_word(desk, train, PATIENCE) - 1
    held = stage(memory, desk, onward)
    set_train(desk, train, PATIENCE, patience)
    later(desk, train, 1, 3)
    if held < 0 or held == OVER:
        set_train(desk, train, ONWARD, NO_RUN)
    elif patience < -20:
        lose_way(memory, desk, train)
    elif patience < 0 and held == RESERVED:
        take1(memory, desk, WITHDRAW, onward)
    elif patience < 0:
        take1(memory, desk, CANCEL, onward)
        ask_back(memory, desk, train, onward, True)
    elif close_loop(memory, desk, train, onward) and take1(memory, desk, START_ROLLING, onward):
        set_train(desk, train, BASE, run)
        set_train(desk, train, RUN, onward)
        set_train(desk, train, ONWARD, NO_RUN)
        set_train(desk, train, DONE, train_word(desk, train, DONE) + 1)
        desk[FINISHED] += 1
    return 0


@compiled
def slips(memory: Any, desk: Any, train: Any, run: Any) -> None:
    """The train brakes too late, and gets into its overlap perhaps."""
    if not take1(memory, desk, OVERRUN, run):
        return
    if strikes(desk, FALSELY_WITHIN, train):
        put_stopped(memory, desk[EVENT], run, 1)
        take_beyond(memory, desk, NOTE_STOPPED)
        take1(memory, desk, SEND_STOP, run)
        take1(memory, desk, RELEASE_OVERLAP, run)
    if one_in(desk, 2):
        front_passes(memory, desk, train, run)


@entry
def arrive_at_destination(memory_at: Any, desk_at: Any, train: Any, run: Any) -> Any:
    """Come to rest, slip perhaps, report, and stand under the run that was run."""
    memory, desk = both(memory_at, desk_at)
    if strikes(desk, SLIP, train):
        slips(memory, desk, train, run)
    rest(memory, desk, train)
    report(memory, desk, train)
    tell_stopped(memory, desk, train, run)
    retire_what_is_over(memory, desk, train)
    set_train(desk, train, BASE, run)
    set_train(desk, train, CAUSE, BY_TIMETABLE)
    set_train(desk, train, DONE, train_word(desk, train, DONE) + 1)
    desk[FINISHED] += 1
    stand(desk, train, 20, 60)
    if front_block(desk, train) != of(desk, DESTINATION, route_of(memory, desk, run)):
        set_train(desk, train, CAUSE, SLIP)
        lose_way(memory, desk, train)
    return 0


@entry
def wake(memory_at: Any, desk_at: Any, train: Any) -> Any:
    """A train does what is next."""
    memory, desk = both(memory_at, desk_at)
    phase = train_word(desk, train, PHASE)
    if phase != RUNS and phase != OFF:
        desk[STANDSTILL + train_word(desk, train, CAUSE)] += desk[CLOCK] - train_word(desk, train, WAITING)
    set_train(desk, train, WAITING, desk[CLOCK])
    if phase == LOST:
        is_lost(memory, desk, train)
    elif phase == AT_REST:
        is_at_rest(memory, desk, train)
    elif phase == WAITS:
        waits(memory, desk, train)
    elif phase == RUNS:
        runs(memory, desk, train)
    elif phase == GIVES_BACK:
        gives_back(memory, desk, train)
    else:
        later(desk, train, 30, 60)
        if not accounted(memory, desk, train):
            lose_way(memory, desk, train)
    return 0
