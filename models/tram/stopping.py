"""A tram that runs, stands and creeps, and fixes of it that are wrong by so much, or not there (G2).

Its driver may have set another way than it is on, beside which it runs, now and then; a wrong setting is routine.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

from kernel.tram import stopping as machine
from kernel.tram.limits import are_lawful_at_stops
from kernel.tram.stopping import Fix, StopLimits, Stopping
from models.measures import apart


@dataclass(frozen=True)
class Street:
    """What does not change.

    ``first_mm``: where the first stop is.  ``error_mm``: so much a place by map matching errs at most.
    ``speed_error_mm_s``: so much a speed.
    """

    limits: StopLimits
    first_mm: int
    error_mm: int
    speed_error_mm_s: int


@dataclass(frozen=True)
class Ride:
    """One moment.

    ``at_mm``: where the tram is.  ``here``: how many stops its unit has come to, by the places in its table;
    ``here_mm``, ``next_mm``: where the last of them is, and the next one.
    ``is_astray``: it is on another way than its unit is set to, and ``at_mm`` is where it is beside that one.
    Histories: ``has_place``: the last fix since the start had one.
    ``fixed_at_mm``, ``speed_mm_s``: where it was at the last fix, and how fast.
    ``stood_at_mm``: where it was when it began to stand.  ``wandered``: a fix made it run that still stood there.
    ``fell_back``: one put it farther back that was on the way that is set.
    ``turned_mm``: where it turned off the way, if it is not on it.  ``was_lost``: there, or since, its fix had no
    place, or it was set or put back; ``has_begun``: and since that it has told that it had not left a stop.
    ``farthest_mm``: where it was farthest at a fix with a place, since it told that it left the stop that it tells of;
    until then where it was at the last one.
    ``is_unset``: it has come onto the way, and its unit still tells of a run before that it has left a stop.
    """

    at_mm: int
    here: int
    here_mm: int
    next_mm: int
    is_astray: bool
    stopping: Stopping
    has_place: bool
    fixed_at_mm: int
    speed_mm_s: int
    stood_at_mm: int
    wandered: bool
    fell_back: bool
    turned_mm: int
    was_lost: bool
    has_begun: bool
    farthest_mm: int
    is_unset: bool


def trams_do_not_run_backwards(system: Ride, way_mm: int) -> bool:
    """No tram runs against its way (G2)."""
    return system.is_astray or way_mm >= 0


def nobody_runs_along_a_way_that_he_is_not_on(system: Ride, way_mm: int) -> bool:
    """Beside another way than its own a tram runs against that one, as on the other track of a street (G2, ours)."""
    return not system.is_astray or way_mm <= 0


def who_comes_round_to_a_way_had_no_place_there(system: Ride) -> bool:
    """A tram that comes round to another part of a way that it is not on has had a fix without a place (G2, ours)."""
    return system.is_astray and not system.has_place


def a_place_is_within_its_error(site: Street, system: Ride, fix: Fix) -> bool:
    """Map matching errs by no more than is written (G1, G7)."""
    return not fix.is_placed or apart(fix.place_mm, system.at_mm) <= site.error_mm


def a_speed_is_within_its_error(site: Street, fix: Fix, speed_mm_s: int) -> bool:
    """So does the speed that the unit takes from the wheels (2.3.1)."""
    return not fix.has_speed or apart(fix.speed_mm_s, speed_mm_s) <= site.speed_error_mm_s


def fell(before: Stopping, now: Stopping) -> bool:
    """Tell whether a unit tells less of the way than it did: an earlier stop, or one that it had left (G2)."""
    return now.stop < before.stop or (now.stop == before.stop and before.left and not now.left)


def is_put_back(site: Street, system: Ride, fix: Fix) -> bool:
    """Tell whether a place is before the stop that is told, or back from where the unit was told since it left it (G2).

    Each by more than errors make of it: a place is held for both of them, and a stop was reached from so near.
    """
    told, held_mm, near_mm = system.stopping, site.limits.held_mm, site.limits.near_mm
    is_back = told.left and told.most_mm - fix.place_mm > held_mm - near_mm
    return fix.is_placed and (is_back or fix.place_mm < system.here_mm - held_mm)


def the_table_has_the_stops(system: Ride, here_mm: int, next_mm: int) -> bool:
    """The unit's table says where the stops are (G1)."""
    return here_mm == system.here_mm and next_mm == system.next_mm


def it_begins_at_a_stop_that_it_has_come_to(site: Street, at_mm: int, is_astray: bool, here_mm: int) -> bool:
    """A unit begins at a stop that the tram is near, or beyond: that of its run, or the first of the way (G2)."""
    return is_astray or at_mm >= here_mm - site.limits.near_mm - site.error_mm


def restart(site: Street, system: Ride, at_mm: int, is_astray: bool, here: int, here_mm: int, next_mm: int) -> Ride:
    """The unit starts anew, or a spare one takes its place, wherever the tram is; its driver sets a way (G2).

    Along that way it is at ``at_mm``, on it or beside it.
    """
    if not it_begins_at_a_stop_that_it_has_come_to(site, at_mm, is_astray, here_mm):
        return system
    return replace(
        system,
        at_mm=at_mm,
        is_astray=is_astray,
        here=here,
        here_mm=here_mm,
        next_mm=next_mm,
        stopping=machine.begun(here),
        has_place=False,
        was_lost=True,
        has_begun=True,
        is_unset=False,
    )


def run_on(site: Street, system: Ride, way_mm: int) -> Ride:
    """The tram moves, or does not."""
    if not trams_do_not_run_backwards(system, way_mm):
        return system
    if not nobody_runs_along_a_way_that_he_is_not_on(system, way_mm):
        return system
    return replace(system, at_mm=system.at_mm + way_mm)


def come_round(site: Street, system: Ride, at_mm: int) -> Ride:
    """A tram that is not on the way that is set comes beside another part of it (G2)."""
    if not who_comes_round_to_a_way_had_no_place_there(system):
        return system
    return replace(system, at_mm=at_mm)


def turn_onto(site: Street, system: Ride) -> Ride:
    """A tram comes onto the way that was set before it was there; its unit does not begin anew (G2).

    Or was not set since it turned off, wherever it comes back: it goes on to tell of the run before.
    """
    is_unset = system.is_astray and system.stopping.left
    reached_mm = site.first_mm if is_unset else system.here_mm
    if not it_begins_at_a_stop_that_it_has_come_to(site, system.at_mm, False, reached_mm):
        return system
    return replace(system, is_astray=False, is_unset=system.is_unset or is_unset)


def turn_off(site: Street, system: Ride) -> Ride:
    """A tram turns off the way, and nobody sets another one (G2)."""
    was_off = system.is_astray
    return replace(
        system,
        is_astray=True,
        turned_mm=system.turned_mm if was_off else system.at_mm,
        was_lost=system.was_lost if was_off else not system.has_place,
        has_begun=was_off and system.has_begun,
    )


def take_fix(
    site: Street, system: Ride, fix: Fix, speed_mm_s: int, here_mm: int, next_mm: int, further_mm: int
) -> Ride:
    """The unit takes a fix; ``further_mm``: the stop after the next one, or the second of the way, wherever (G2).

    With limits that do not pass their check for what places err it is not put to use, and takes none.

    5 km/h, below which a fix tells of one that stands, are the paper's (002, 3.1.2), rounded up to whole mm/s.
    """
    if not are_lawful_at_stops(site.limits, site.error_mm):
        return system
    if not a_place_is_within_its_error(site, system, fix) or not a_speed_is_within_its_error(site, fix, speed_mm_s):
        return system
    if not the_table_has_the_stops(system, here_mm, next_mm):
        return system
    before = system.stopping
    now = machine.note_fix(site.limits, before, here_mm, next_mm, fix)
    begins_anew = is_put_back(site, system, fix)
    has_come = now.stop > before.stop and not begins_anew
    stop_mm = site.first_mm if begins_anew else system.here_mm
    was_farther = before.left and not has_come and not begins_anew and system.at_mm < system.farthest_mm
    is_still = before.stands and system.at_mm == system.stood_at_mm
    is_told = fix.is_placed and fix.has_speed and fix.speed_mm_s < 1_389
    was_lost = system.was_lost or not fix.is_placed or begins_anew
    begins = now.stands and (has_come or not before.stands)
    return replace(
        system,
        here=0 if begins_anew else system.here + 1 if has_come else system.here,
        here_mm=system.next_mm if has_come else stop_mm,
        next_mm=further_mm if has_come or begins_anew else system.next_mm,
        stopping=now,
        has_place=fix.is_placed,
        fixed_at_mm=system.at_mm,
        speed_mm_s=speed_mm_s,
        stood_at_mm=system.at_mm if begins else system.stood_at_mm,
        wandered=system.wandered or (is_still and is_told and not (now.stands and not has_come)),
        fell_back=system.fell_back or (not system.is_astray and not system.is_unset and fell(before, now)),
        was_lost=was_lost,
        has_begun=system.has_begun or (was_lost and not now.left),
        farthest_mm=system.at_mm if fix.is_placed and not was_farther else system.farthest_mm,
        is_unset=system.is_unset and now.left and not has_come,
    )
