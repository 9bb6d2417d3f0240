"""A radio channel on which trains are ranged for crossings, the ground unit that gives out its slots, and time (X1).

Radios do what they like with an order: range once, again or never, as long as the order is fresh.  Trains come and go
at any moment, answers come at any later one, any number of times or never, and the ground unit may restart, or be
swapped for a spare one, in the middle of a slot.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

from kernel.crossing import ranging_schedule as machine
from kernel.crossing.arrival import ArrivalBounds
from kernel.crossing.ranging_schedule import ChannelSettings, Pair, Schedule
from kernel.maps import Map
from kernel.restarts import restart_ranging_schedule
from models.measures import greater, lesser


@dataclass(frozen=True)
class Channel:
    """What does not change (X1).

    ``settings``: what is written for the channel.  ``bounds``: by which one of its crossings reckons.
    ``over_ms``: so long after the tick at which its slot began a ranging is over, or never begins.
    """

    settings: ChannelSettings
    bounds: ArrivalBounds
    over_ms: int


@dataclass(frozen=True)
class Order:
    """An order as it was sent: to the radios of which pair, and how long ago its slot began."""

    pair: Pair
    since_ms: int


@dataclass(frozen=True)
class Wait:
    """A history of a registered pair.

    ``waited_ms``: since it was ordered last, or registered.
    ``most``: so many pairs were registered since then, at the most.
    ``held_cycles``: as old as it is told to be, at a decision, is the newest ranging of it whose slot is over; before
    the first, so many decisions have begun since it registered.
    ``held_ms``: and so old it is, or so long the pair is registered.
    """

    waited_ms: int
    most: int
    held_cycles: int
    held_ms: int


@dataclass(frozen=True)
class Told:
    """A history: the answer that counted last.

    ``pair``, ``age_cycles``: for whom, and how old it was told to be.
    ``of``, ``since_cycles``: of whom that ranging was, and how many decisions have begun since it was taken.
    """

    pair: Pair
    age_cycles: int
    of: Pair
    since_cycles: int


@dataclass(frozen=True)
class Ranging:
    """One moment of the channel.

    ``schedule``: what the ground unit knows.
    ``sent``: history: every order by its number.
    ``under_way``: the numbers of rangings that are on the channel now.
    ``taken``: history: how many decisions have begun since the first ranging by that number.
    ``phase_ms``: since the last decision of the crossings, up to a cycle.
    ``registered``: history: how many pairs have registered and not left.
    ``waits``: history of the registered ones.
    ``told``: history of answers.
    """

    schedule: Schedule
    sent: Map[int, Order]
    under_way: frozenset[int]
    taken: Map[int, int]
    phase_ms: int
    registered: int
    waits: Map[Pair, Wait]
    told: Told


# ---- premises


def a_slot_is_written_as_long_as_a_ranging_takes(site: Channel) -> bool:
    """The slot is as long as it takes from an order until its ranging is over for certain (X1)."""
    return site.over_ms <= site.settings.slot_ms


def decisions_take_time(site: Channel) -> bool:
    """Crossings decide in cycles that last (X2)."""
    return site.bounds.cycle_ms > 0


# ---- assumptions


def a_ranging_begins_by_a_fresh_order(site: Channel, system: Ranging, number: int) -> bool:
    """Radios range by an order of the ground unit alone, and not after its time (X1)."""
    return number in system.sent and system.sent[number].since_ms < site.over_ms


def rangings_under_way_end_in_time(site: Channel, system: Ranging, passed_ms: int) -> bool:
    """Before its time after the order has passed, a ranging is over (X1)."""
    return all(system.sent[number].since_ms + passed_ms < site.over_ms for number in system.under_way)


def ticks_come_in_time(site: Channel, passed_ms: int) -> bool:
    """From a tick or start of the ground unit to its next tick as much time passes as is written (X1)."""
    return passed_ms == site.settings.tick_ms


def a_decision_begins_each_cycle(site: Channel, system: Ranging) -> bool:
    """The crossings decide once in each cycle, and never sooner after one decision (X2)."""
    return system.phase_ms >= site.bounds.cycle_ms


def an_answer_has_the_number_of_its_order(system: Ranging, number: int) -> bool:
    """What is heard as an answer is of a ranging that was made, by the order of that number, or has no number (X1)."""
    return number == -1 or number in system.taken


def a_start_goes_on_from_the_last_number(system: Ranging, number: int) -> bool:
    """Who starts to give out slots has a number that is no lower than that of any order, and orders alone (X1)."""
    return number >= 0 and all(sent <= number for sent in system.sent)


# ---- transitions


def register(site: Channel, system: Ranging, pair: Pair) -> Ranging:
    """A pair asks for a place; before the settings are checked nobody is given one (X1)."""
    if not machine.are_in_time(site.settings, site.bounds):
        return system
    schedule = machine.register(site.settings, system.schedule, pair)
    if pair in system.schedule.turns or pair not in schedule.turns:
        return replace(system, schedule=schedule)
    registered = system.registered + 1
    waits = {other: replace(wait, most=greater(wait.most, registered)) for other, wait in system.waits.items()}
    return replace(system, schedule=schedule, registered=registered, waits=waits | {pair: Wait(0, registered, 0, 0)})


def leave(site: Channel, system: Ranging, gone: Pair) -> Ranging:
    """A pair is taken off: the train has passed, has turned back, or is not heard any more (X1)."""
    schedule = machine.leave(system.schedule, gone)
    if gone not in system.schedule.turns or gone in schedule.turns:
        return replace(system, schedule=schedule)
    waits = {pair: wait for pair, wait in system.waits.items() if pair != gone}
    return replace(system, schedule=schedule, registered=system.registered - 1, waits=waits)


def tick(site: Channel, system: Ranging, passed_ms: int) -> Ranging:
    """A tick of the ground unit: time has passed, and a slot may begin; with settings that are checked alone (X1)."""
    if not machine.are_in_time(site.settings, site.bounds):
        return system
    if not ticks_come_in_time(site, passed_ms) or not rangings_under_way_end_in_time(site, system, passed_ms):
        return system
    schedule = machine.next_tick(site.settings, system.schedule)
    return replace(
        system,
        schedule=schedule,
        sent={number: replace(sent, since_ms=sent.since_ms + passed_ms) for number, sent in system.sent.items()},
        phase_ms=lesser(system.phase_ms + passed_ms, site.bounds.cycle_ms),
        waits={pair: waited(site, system, schedule, pair, wait, passed_ms) for pair, wait in system.waits.items()},
    )


def waited(site: Channel, system: Ranging, schedule: Schedule, pair: Pair, wait: Wait, passed_ms: int) -> Wait:
    """Give the history of a pair after a tick: its last ranging is held once that slot is over, and it may be ordered.

    What is under way longer than a slot is over.
    """
    waited_ms = wait.waited_ms + passed_ms
    is_over = waited_ms >= site.settings.slot_ms and pair in system.schedule.turns
    held_cycles = system.schedule.turns[pair].age_cycles if is_over else wait.held_cycles
    held_ms = waited_ms if is_over else wait.held_ms + passed_ms
    if machine.is_ordered(site.settings, schedule, pair):
        return Wait(0, system.registered, held_cycles, held_ms)
    return replace(wait, waited_ms=waited_ms, held_cycles=held_cycles, held_ms=held_ms)


def decide(site: Channel, system: Ranging) -> Ranging:
    """A cycle of the crossings begins: all that was taken before is older by one (X1, X2)."""
    if not a_decision_begins_each_cycle(site, system):
        return system
    return replace(
        system,
        schedule=machine.next_cycle(system.schedule),
        taken={number: cycles + 1 for number, cycles in system.taken.items()},
        phase_ms=0,
        waits={pair: replace(wait, held_cycles=wait.held_cycles + 1) for pair, wait in system.waits.items()},
    )


def send_order(site: Channel, system: Ranging, pair: Pair) -> Ranging:
    """The ground unit sends what it orders, once or again (X1)."""
    if not machine.is_ordered(site.settings, system.schedule, pair):
        return system
    return replace(system, sent=system.sent | {system.schedule.number: Order(pair, 0)})


def begin_ranging(site: Channel, system: Ranging, number: int) -> Ranging:
    """Trackside and train radio begin to range by an order that they have heard, once or again (X1)."""
    if not a_ranging_begins_by_a_fresh_order(site, system, number):
        return system
    taken = system.taken | {number: system.taken.get(number, 0)}
    return replace(system, under_way=system.under_way | {number}, taken=taken)


def end_ranging(site: Channel, system: Ranging, number: int) -> Ranging:
    """A ranging is over (X1)."""
    return replace(system, under_way=system.under_way - {number})


def hear_answer(site: Channel, system: Ranging, pair: Pair, number: int) -> Ranging:
    """The ground unit hears an answer, now or later, once or again, and tells a crossing if it counts (X1)."""
    if not an_answer_has_the_number_of_its_order(system, number):
        return system
    if not machine.counts(system.schedule, pair, number):
        return system
    age_cycles = system.schedule.turns[pair].age_cycles
    return replace(system, told=Told(pair, age_cycles, system.sent[number].pair, system.taken[number]))


def restart(site: Channel, system: Ranging, number: int) -> Ranging:
    """The ground unit restarts, or a spare one takes over: all contact is made anew (X1).

    ``number``: what lasting memory has.
    """
    if not a_start_goes_on_from_the_last_number(system, number):
        return system
    started = restart_ranging_schedule(site.settings, number)
    return replace(system, schedule=started, registered=0, waits={})
