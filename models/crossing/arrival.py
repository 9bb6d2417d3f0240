"""A train that runs towards a crossing, and the rangings of it (X1, X2).

The crossing as a point, and the train's head as one.  Ways to it and paces towards it in µm; negative
paces lead away from it.  Stopping short, reversing and speeding up are all within the bounds of its motion.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

from kernel.crossing import arrival
from kernel.crossing import crossing as machine
from kernel.crossing.arrival import ArrivalBounds, Followed, Ranging
from models.measures import UM_A_MM, apart, greater, lesser


@dataclass(frozen=True)
class Crossing:
    """What does not change: the bounds that trains before this crossing are held to (X2)."""

    bounds: ArrivalBounds


@dataclass(frozen=True)
class Taken:
    """What was really so when a ranging was taken, and how long ago that was.

    ``way_um``, ``pace_um``: the head's way to the crossing then, and how fast it came nearer.
    """

    way_um: int
    pace_um: int
    age_cycles: int


@dataclass(frozen=True)
class Brought:
    """A history: what the last ranging told that counted.

    ``way_mm``: how near the head was at the most; ``towards_mm_s``: how fast it came nearer at the most, or none.
    """

    way_mm: int
    towards_mm_s: int


@dataclass(frozen=True)
class LetGo:
    """A history: when the train was last taken for one that has turned back before its start point.

    ``is_any``: it was.  ``way_um``: its head's way to the crossing then.  ``start_mm``: that of its start point.
    """

    is_any: bool
    way_um: int
    start_mm: int


@dataclass(frozen=True)
class Coming:
    """One moment of a train that is in contact.

    ``way_um``, ``pace_um``: its head's way to the crossing, and how fast it comes nearer.
    ``ceiling_um``: it keeps to this, and raises it by the crossing's acknowledgement alone.
    ``ranged``: where the train was, and how fast, when the ranging that is under way was taken, or the last one.
    ``arrived``: its head has been seen at the crossing, or beyond.
    ``decided``: the crossing has decided for the cycle that begins.
    ``told``: history: the ranging that the radio brought last of those that count, as old as it truly is made to be.
    ``brought``: history: what it told.
    ``contradicted``: history: two rangings that counted, one after the other, cannot both have been of this train.
    ``worst``: history: what was known at the last decision not to warn; since then the worst that it allows.
    ``left_cycles``: history: within so many cycles it cannot arrive, by that decision.
    ``silent_cycles``: history: for how many decisions the radio has brought nothing, or what it had brought before.
    ``warned_cycles``: history: how long the warning has lasted.
    ``followed``: what the crossing knows.
    ``let_go``: history: as what turned back it was let go.
    """

    way_um: int
    pace_um: int
    ceiling_um: int
    ranged: Taken
    arrived: bool
    decided: bool
    told: Ranging
    brought: Brought
    contradicted: bool
    worst: Followed
    left_cycles: int
    silent_cycles: int
    warned_cycles: int
    followed: Followed
    let_go: LetGo


# ---- what rangings tell, one beside the other


def is_of_this_line(bounds: ArrivalBounds, ranging: Ranging) -> bool:
    """Tell whether a ranging came, is within 100 km and 200 m/s, and no older than rangings count (ours; X1)."""
    return (
        ranging.valid
        and -100_000_000 <= ranging.way_mm <= 100_000_000
        and ranging.speed_mm_s <= 200_000
        and 0 <= ranging.age_cycles <= bounds.silence_cycles
    )


def towards_mm_s(ranging: Ranging) -> int:
    """Give how fast a ranging has the train come nearer; one that moves away does not."""
    return greater(0, ranging.speed_mm_s)


def is_the_one_before(bounds: ArrivalBounds, brought: Brought, ranging: Ranging) -> bool:
    """Tell whether a ranging has the train where, and as fast as, the one before; and faster than rangings err."""
    return (
        ranging.way_mm == brought.way_mm
        and ranging.speed_mm_s == brought.towards_mm_s
        and ranging.speed_mm_s > bounds.speed_spread_mm_s
    )


def brought_by(bounds: ArrivalBounds, brought: Brought, ranging: Ranging) -> Brought:
    """Give what the last ranging that counted told, after one more."""
    if not is_of_this_line(bounds, ranging):
        return brought
    return Brought(ranging.way_mm, towards_mm_s(ranging))


def cannot_both_be(site: Crossing, one: Ranging, other: Ranging) -> bool:
    """Tell whether the train would be too fast for the line, or have gained too much, for both to be within errors."""
    between_cycles = apart(one.age_cycles, other.age_cycles)
    faster_mm_s = towards_mm_s(other) - towards_mm_s(one)
    gained_mm_s = faster_mm_s if other.age_cycles <= one.age_cycles else -faster_mm_s
    return (
        UM_A_MM * apart(one.way_mm, other.way_mm)
        > UM_A_MM * site.bounds.way_spread_mm + between_cycles * site.bounds.line_um
        or site.bounds.cycle_ms * gained_mm_s
        > site.bounds.cycle_ms * site.bounds.speed_spread_mm_s + between_cycles * site.bounds.gain_um
    )


# ---- premises


def bounds_are_above_zero(site: Crossing) -> bool:
    """Trains move and gain speed, cycles last, and a ranging may be late (X2)."""
    return (
        site.bounds.line_um > 0
        and site.bounds.gain_um > 0
        and site.bounds.cycle_ms > 0
        and site.bounds.warning_cycles >= 0
        and site.bounds.silence_cycles > 0
    )


# ---- assumptions


def the_ranging_bounds_the_train(site: Crossing, system: Coming, ranging: Ranging) -> bool:
    """When it was taken, the head was no nearer and no faster than the ranging says with its errors (X1).

    What the radio delivers, if anything, is the ranging that was ordered last.  It may come at any later moment,
    any number of times, or never.  Or the radio hangs, and brings the one before again, of a train that ran.
    """
    return (
        not ranging.valid
        or is_the_one_before(site.bounds, system.brought, ranging)
        or (
            UM_A_MM * ranging.way_mm <= system.ranged.way_um
            and system.ranged.pace_um <= site.bounds.cycle_ms * ranging.speed_mm_s
        )
    )


def a_ranging_is_no_older_than_it_says(site: Crossing, system: Coming, ranging: Ranging) -> bool:
    """The age that is told is not less than the time since it was taken, but of the one before told again (X1)."""
    return (
        not ranging.valid
        or is_the_one_before(site.bounds, system.brought, ranging)
        or ranging.age_cycles >= system.ranged.age_cycles
    )


def a_decision_begins_each_cycle(system: Coming) -> bool:
    """The crossing decides once before each cycle, never later: its computer keeps the time (X2)."""
    return not system.decided


def the_train_gains_no_more(site: Crossing, system: Coming, to_um: int, pace_um: int) -> bool:
    """In one cycle the train gains no more than motors and descent give it, at its end and on its mean (X2)."""
    return greater(system.way_um - to_um, pace_um) - system.pace_um <= site.bounds.gain_um


def the_train_keeps_to_its_ceiling(system: Coming, to_um: int, pace_um: int) -> bool:
    """No train is faster than what it has promised; else than the line's speed, with what a driver may exceed it by.

    Neither at the end of a cycle nor on its mean.
    """
    return greater(system.way_um - to_um, pace_um) <= system.ceiling_um


def only_a_ceiling_that_is_kept_is_promised(system: Coming, ceiling_um: int) -> bool:
    """Who promises a ceiling is no faster than that already (X2)."""
    return system.pace_um <= ceiling_um


def the_crossing_holds_it_to_no_less(system: Coming, ceiling_um: int) -> bool:
    """The ceiling that the crossing has noted is no lower than the one that the train keeps to, as ``promise`` proves.

    Whatever was lost, late or repeated (X2).
    """
    return system.ceiling_um <= ceiling_um


def who_is_at_the_crossing_has_come_all_the_way(system: Coming) -> bool:
    """Nobody meets the train at the crossing while its head is before it (X2)."""
    return system.way_um <= 0


# ---- transitions


def take_ranging(site: Crossing, system: Coming) -> Coming:
    """The ground unit orders a ranging, and it is taken; the one before is given up (X1)."""
    return replace(system, ranged=Taken(system.way_um, system.pace_um, 0))


def decide(site: Crossing, system: Coming, ranging: Ranging) -> Coming:
    """The crossing decides by what the radio delivers, if it delivers anything (X1, X2, X3)."""
    if not a_decision_begins_each_cycle(system) or not a_ranging_is_no_older_than_it_says(site, system, ranging):
        return system
    if not the_ranging_bounds_the_train(site, system, ranging):
        return system
    followed = arrival.follow(site.bounds, system.followed, ranging)
    is_another = not is_the_one_before(site.bounds, system.brought, ranging)
    silent_cycles = 0 if ranging.valid and is_another else system.silent_cycles + 1
    told = ranging if is_another and is_of_this_line(site.bounds, ranging) else system.told
    contradicted = system.contradicted or (
        is_another
        and is_of_this_line(site.bounds, ranging)
        and is_of_this_line(site.bounds, system.told)
        and cannot_both_be(site, system.told, ranging)
    )
    if followed.warns:
        return replace(
            system,
            decided=True,
            told=told,
            brought=brought_by(site.bounds, system.brought, ranging),
            contradicted=contradicted,
            silent_cycles=silent_cycles,
            followed=followed,
        )
    return replace(
        system,
        decided=True,
        told=told,
        brought=brought_by(site.bounds, system.brought, ranging),
        contradicted=contradicted,
        worst=followed,
        left_cycles=site.bounds.warning_cycles + 2,
        silent_cycles=silent_cycles,
        followed=followed,
    )


def keep_to(site: Crossing, system: Coming, ceiling_um: int) -> Coming:
    """The train promises a lower ceiling; whether the crossing hears of it is another matter (X2)."""
    if not only_a_ceiling_that_is_kept_is_promised(system, ceiling_um):
        return system
    return replace(system, ceiling_um=lesser(system.ceiling_um, ceiling_um))


def take_ceiling(site: Crossing, system: Coming, ceiling_um: int) -> Coming:
    """The crossing reckons with a ceiling that it has noted of the train (X2)."""
    if not the_crossing_holds_it_to_no_less(system, ceiling_um):
        return system
    return replace(system, followed=arrival.held_to(site.bounds, system.followed, ceiling_um))


def acknowledge(site: Crossing, system: Coming, asked_um: int) -> Coming:
    """Once it has decided, it acknowledges an ask to go faster, if it is for it to be: the train may keep to that (X2).

    Here for the warning alone: without a least opening of the road in mind. What was left by the decision not to
    warn is left by this one, of the same moment.
    """
    if a_decision_begins_each_cycle(system):
        return system
    if not machine.may_go_faster(site.bounds, system.followed, asked_um, 0):
        return system
    followed = arrival.held_to(site.bounds, system.followed, asked_um)
    return replace(system, ceiling_um=followed.ceiling_um, followed=followed, worst=followed)


def turn_back(site: Crossing, system: Coming, ranging: Ranging, start_mm: int) -> Coming:
    """Once it has decided, it lets a train go that runs away and is before its start point (X4)."""
    if a_decision_begins_each_cycle(system):
        return system
    if not arrival.has_turned_back(site.bounds, system.followed, ranging, start_mm):
        return system
    return replace(system, let_go=LetGo(True, system.way_um, start_mm))


def run_a_cycle(site: Crossing, system: Coming, to_um: int, pace_um: int) -> Coming:
    """The train runs for a cycle as it likes: on, slower, back, or as hard as it can (X2)."""
    if a_decision_begins_each_cycle(system):
        return system
    if not the_train_gains_no_more(site, system, to_um, pace_um):
        return system
    if not the_train_keeps_to_its_ceiling(system, to_um, pace_um):
        return system
    run = replace(
        system,
        way_um=to_um,
        pace_um=pace_um,
        ranged=replace(system.ranged, age_cycles=system.ranged.age_cycles + 1),
        decided=False,
        told=replace(system.told, age_cycles=system.told.age_cycles + 1),
        left_cycles=system.left_cycles - 1,
        warned_cycles=system.warned_cycles + 1 if system.followed.warns else 0,
        followed=arrival.aged(site.bounds, system.followed),
    )
    worst_um = system.worst.ceiling_um
    if system.worst.short_um <= site.bounds.gain_um:
        return replace(run, worst=replace(system.worst, way_um=system.worst.way_um - worst_um, short_um=0))
    short_um = system.worst.short_um - site.bounds.gain_um
    way_um = system.worst.way_um - worst_um + short_um
    return replace(run, worst=replace(system.worst, way_um=way_um, short_um=short_um))


def arrive(site: Crossing, system: Coming) -> Coming:
    """The train is met at the crossing (X2)."""
    if not who_is_at_the_crossing_has_come_all_the_way(system):
        return system
    return replace(system, arrived=True)
