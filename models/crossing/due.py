"""A train in contact, and what the answers to when it is due secure of it (X2, X4).

The joint between reckoning and combining: what ``crossing`` takes of an answer is what is true of the train.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

from kernel.crossing import arrival
from kernel.crossing import crossing as machine
from kernel.crossing.arrival import ArrivalBounds, Followed, Ranging
from kernel.crossing.crossing import Due, Settings
from models.crossing.arrival import Brought, brought_by, is_the_one_before
from models.crossing.crossing import secured_cycles
from models.measures import UM_A_MM, greater, lesser


@dataclass(frozen=True)
class Way:
    """What does not change: the bounds that trains are held to, and what is written for the crossing (X2, X4)."""

    bounds: ArrivalBounds
    settings: Settings


@dataclass(frozen=True)
class Answered:
    """One moment of a train.

    ``way_um``, ``pace_um``: its head's way to the crossing, and how fast it comes nearer.
    ``ceiling_um``: it keeps to this, and raises it by the crossing's acknowledgement alone.
    ``brought``: history: what the last ranging told that counted, since the crossing started.
    ``followed``: what the crossing knows.
    ``worst``: history: what was known at the answer that is held; since then the worst that it allows.
    ``left_cycles``: within so many cycles it cannot arrive, by that answer.
    ``sooner_cycles``: history: how much of that was left when its head was last met at the crossing.
    """

    way_um: int
    pace_um: int
    ceiling_um: int
    brought: Brought
    followed: Followed
    worst: Followed
    left_cycles: int
    sooner_cycles: int


# ---- premises


def bounds_are_above_zero(site: Way) -> bool:
    """Trains move and gain speed, cycles last, and the road is opened for a while (X2, X4)."""
    return (
        site.bounds.line_um > 0
        and site.bounds.gain_um > 0
        and site.bounds.cycle_ms > 0
        and site.bounds.warning_cycles >= 0
        and site.settings.reopening_cycles >= 0
    )


# ---- assumptions


def the_ranging_bounds_the_train(site: Way, system: Answered, ranging: Ranging) -> bool:
    """By a ranging and its age the head is no nearer and no faster, as ``arrival`` proves of all that it takes (X1).

    It takes none that is the one before again, of a train that ran.
    """
    return (
        not ranging.valid
        or is_the_one_before(site.bounds, system.brought, ranging)
        or (
            UM_A_MM * ranging.way_mm - ranging.age_cycles * site.bounds.line_um <= system.way_um
            and system.pace_um <= site.settings.cycle_ms * ranging.speed_mm_s + ranging.age_cycles * site.bounds.gain_um
        )
    )


def the_train_gains_no_more(site: Way, system: Answered, to_um: int, pace_um: int) -> bool:
    """In one cycle the train gains no more than motors and descent give it, at its end and on its mean (X2)."""
    return greater(system.way_um - to_um, pace_um) - system.pace_um <= site.bounds.gain_um


def the_train_keeps_to_its_ceiling(system: Answered, to_um: int, pace_um: int) -> bool:
    """No train is faster than what it has promised; else than the line's speed, with what a driver may exceed it by.

    Neither at the end of a cycle nor on its mean.
    """
    return greater(system.way_um - to_um, pace_um) <= system.ceiling_um


def only_a_ceiling_that_is_kept_is_promised(system: Answered, ceiling_um: int) -> bool:
    """Who promises a ceiling is no faster than that already (X2)."""
    return system.pace_um <= ceiling_um


def the_crossing_holds_it_to_no_less(system: Answered, ceiling_um: int) -> bool:
    """The ceiling that the crossing has noted is no lower than the one that the train keeps to, as ``promise`` proves.

    Whatever was lost, late or repeated (X2).
    """
    return system.ceiling_um <= ceiling_um


def who_is_at_the_crossing_has_come_all_the_way(system: Answered) -> bool:
    """Nobody meets the train at the crossing while its head is before it (X2)."""
    return system.way_um <= 0


# ---- transitions


def take_ranging(site: Way, system: Answered, ranging: Ranging) -> Answered:
    """The ground unit takes a ranging, or none came; before bounds and settings are checked it takes none (X1, X5)."""
    if not machine.have_one_warning_time(site.bounds, site.settings):
        return system
    if not the_ranging_bounds_the_train(site, system, ranging):
        return system
    return replace(
        system,
        brought=brought_by(site.bounds, system.brought, ranging),
        followed=arrival.follow(site.bounds, system.followed, ranging),
    )


def keep_to(site: Way, system: Answered, ceiling_um: int) -> Answered:
    """The train promises a lower ceiling; whether the crossing hears of it is another matter (X2)."""
    if not only_a_ceiling_that_is_kept_is_promised(system, ceiling_um):
        return system
    return replace(system, ceiling_um=lesser(system.ceiling_um, ceiling_um))


def take_ceiling(site: Way, system: Answered, ceiling_um: int) -> Answered:
    """The crossing reckons with a ceiling that it has noted of the train (X2)."""
    if not the_crossing_holds_it_to_no_less(system, ceiling_um):
        return system
    return replace(system, followed=arrival.held_to(site.bounds, system.followed, ceiling_um))


def acknowledge(site: Way, system: Answered, asked_um: int) -> Answered:
    """It acknowledges an ask to go faster, if it is for it to be: from now on the train may keep to that (X2).

    With the answer by which that was decided, which is the one that is held.
    """
    if not machine.have_one_warning_time(site.bounds, site.settings):
        return system
    reopening_cycles = site.settings.reopening_cycles
    if not machine.may_go_faster(site.bounds, system.followed, asked_um, reopening_cycles):
        return system
    followed = arrival.held_to(site.bounds, system.followed, asked_um)
    return replace(
        system,
        ceiling_um=followed.ceiling_um,
        followed=followed,
        worst=followed,
        left_cycles=secured_cycles(site.settings.warning_cycles, reopening_cycles, Due.FAR),
    )


def restart(site: Way, system: Answered) -> Answered:
    """The crossing restarts, and has forgotten rangings and ceiling; what was promised is kept all the same (X3)."""
    return replace(system, brought=Brought(0, 0), followed=arrival.nothing_known(site.bounds))


def answer(site: Way, system: Answered) -> Answered:
    """It answers by what it knows of the train, and what that secures is held against it (X2, X4).

    Any answer may be the one that is held: those that are not did not happen here.  None is given before bounds
    and settings are checked: what is secured is by the crossing's own warning time (X5).
    """
    if not machine.have_one_warning_time(site.bounds, site.settings):
        return system
    due = machine.due(site.bounds, system.followed, site.settings.reopening_cycles)
    warning_cycles, reopening_cycles = site.settings.warning_cycles, site.settings.reopening_cycles
    if due == Due.NEAR:
        near_cycles = secured_cycles(warning_cycles, reopening_cycles, Due.NEAR)
        return replace(system, worst=system.followed, left_cycles=near_cycles)
    if due == Due.FAR:
        far_cycles = secured_cycles(warning_cycles, reopening_cycles, Due.FAR)
        return replace(system, worst=system.followed, left_cycles=far_cycles)
    return system


def run_a_cycle(site: Way, system: Answered, to_um: int, pace_um: int) -> Answered:
    """The train runs for a cycle as it likes (X2)."""
    if not the_train_gains_no_more(site, system, to_um, pace_um):
        return system
    if not the_train_keeps_to_its_ceiling(system, to_um, pace_um):
        return system
    run = replace(system, way_um=to_um, pace_um=pace_um, left_cycles=system.left_cycles - 1)
    run = replace(run, followed=arrival.aged(site.bounds, system.followed))
    worst_um = system.worst.ceiling_um
    if system.worst.short_um <= site.bounds.gain_um:
        return replace(run, worst=replace(system.worst, way_um=system.worst.way_um - worst_um, short_um=0))
    short_um = system.worst.short_um - site.bounds.gain_um
    way_um = system.worst.way_um - worst_um + short_um
    return replace(run, worst=replace(system.worst, way_um=way_um, short_um=short_um))


def arrive(site: Way, system: Answered) -> Answered:
    """The train is met at the crossing (X2)."""
    if not who_is_at_the_crossing_has_come_all_the_way(system):
        return system
    return replace(system, sooner_cycles=system.left_cycles)
