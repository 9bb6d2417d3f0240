"""What is assumed of trains, the worker, their fixes and the two sources of the alarm tone (A1 to A3, A5)."""

from __future__ import annotations

from kernel.alarm.distance import Direction, TrainFix, WorkerFix
from kernel.alarm.network import Way
from kernel.alarm.tone import Display, Train
from models.alarm.along import far_um, is_along, is_at_a_join, is_by_figures, is_over
from models.alarm.worksite import (
    NOTHING_TOLD,
    Body,
    OfTrain,
    Railway,
    Worksite,
    has_another_part,
    has_fresh_fix,
    has_just_come,
    is_shown,
    is_told_alike,
    is_where_shown,
    shunts,
)
from models.measures import UM_A_MM, apart

# ---- premises


def the_alarm_limit_is_within_an_hour(site: Railway) -> bool:
    """What counts as fresh is within the ranges of reports (A1)."""
    return site.register.fresh.server_ms <= 3_600_000


def the_error_is_not_negative(site: Railway) -> bool:
    """The error of a train's fix is written as a way, not below zero (A1)."""
    return site.register.bounds.train_error_mm >= 0


def speed_and_freshness_are_not_negative(site: Railway) -> bool:
    """The line's greatest speed, and for how long a fix is fresh, are written as no less than zero (A1)."""
    return site.register.bounds.train_mm_s >= 0 and site.register.fresh.fix_ms >= 0


# ---- assumptions


def no_train_is_longer_than_written(site: Railway, body: Body) -> bool:
    """Both ends of a train are no farther from its antenna than the greatest length of the line (A1)."""
    length_mm = site.register.bounds.length_mm
    return 0 <= body.below_mm <= length_mm and 0 <= body.above_mm <= length_mm


def the_train_keeps_the_lines_speed(site: Railway, from_um: int, to_um: int, elapsed_ms: int) -> bool:
    """No train is faster than the line's greatest speed, of which the written bound has a margin for clocks (A1)."""
    return apart(to_um, from_um) <= site.register.bounds.train_mm_s * elapsed_ms


def all_trains_keep_the_lines_speed(site: Railway, system: Worksite, elapsed_ms: int) -> bool:
    """None is faster, while time passes, so none comes nearer by any way than it can have run (A1)."""
    return all(
        not body.is_on or the_train_keeps_the_lines_speed(site, body.antenna_um, body.next_um, elapsed_ms)
        for _train, body in system.bodies.items()
    ) and all(
        way in body.ways_um and next_um >= body.ways_um[way] - site.register.bounds.train_mm_s * elapsed_ms
        for _train, body in system.bodies.items()
        for way, next_um in body.next_ways_um.items()
    )


def all_trains_run_as_they_head(system: Worksite) -> bool:
    """A train gets nowhere but the way that it heads; one that turns takes a step each way (A3)."""
    return all(
        not body.is_on
        or (
            (body.next_heading != Direction.DOWN or body.next_um >= body.antenna_um)
            and (body.next_heading != Direction.UP or body.next_um <= body.antenna_um)
        )
        for _train, body in system.bodies.items()
    )


def the_worker_keeps_a_walking_speed(site: Railway, from_um: int, to_um: int, elapsed_ms: int) -> bool:
    """No worker moves along the line faster than is written (A1)."""
    return apart(to_um, from_um) <= site.register.bounds.worker_mm_s * elapsed_ms


def a_train_fix_is_within_its_error(site: Railway, fix: TrainFix, at_um: int) -> bool:
    """A right fix was within the error of where the antenna was (A1)."""
    return apart(at_um, UM_A_MM * fix.place_mm) <= UM_A_MM * site.register.bounds.train_error_mm


def a_worker_fix_is_within_its_error(site: Railway, fix: WorkerFix, at_um: int) -> bool:
    """A fix that is one was within the error of where the handset was; nothing contradicts a wrong one (A1)."""
    return apart(at_um, UM_A_MM * fix.place_mm) <= UM_A_MM * site.register.bounds.worker_error_mm


def a_wrong_fix_is_contradicted(site: Railway, of: OfTrain, body: Body, is_right: bool) -> bool:
    """A wrong fix that fits agrees with no display, both fresh, nor puts a train that is not on it into a yard (A2).

    So GPS does not err by less than the display can tell.  That is not true of nature: under a roof or in a cutting a
    fix is off by 100 m, and the display shows a stretch of some km.  It cannot be had for less: only these two sources
    tell of a train, so what both tell alike is believed, and a yard has one source alone.  The error as written has to
    be one that is measured on the line, and stretches where it is exceeded are registered.

    It says nothing of a wrong fix that agrees with no display, because there is none, nor of one that jumps from the
    one before: then no tone is mild.  Nor of a train that has just come, which may be told of in other figures.  Nor of
    a fix that is no longer fresh: that may be of a branch, or from before a break, for as long as the unit is dead.
    """
    if is_right or has_just_come(site, body) or not has_fresh_fix(site, of):
        return True
    if is_shown(site, of):
        return not is_where_shown(site, of)
    return not shunts(site, of)


def no_train_turns_sooner(site: Railway, of: OfTrain, body: Body) -> bool:
    """A train on the display that was told to run one way does not run the other before it can have turned (A3).

    One that shunts, and so is not on the display, may turn at any time (A5); one that has just come may have turned
    before; and one that has been where lines join may have come back round a loop.
    """
    fix = of.fix
    if has_just_come(site, body) or not is_told_alike(site, of) or not fix.is_running:
        return True
    if not body.is_on or fix.age_ms >= body.passed_ms:
        return True
    if fix.age_ms > site.register.bounds.turning_ms:
        return True
    return fix.direction in (Direction.UNKNOWN, body.heading)


def the_display_shows_where_the_train_was(site: Railway, display: Display, at_um: int) -> bool:
    """The antenna was in the stretch that the display shows, within the error of its boundaries (A2)."""
    error_um = UM_A_MM * site.register.display_error_mm
    return is_by_figures(display.from_mm, display.to_mm, at_um, error_um) or (
        has_another_part(display) and is_by_figures(display.other_from_mm, display.other_to_mm, at_um, error_um)
    )


def sources_do_not_fail_together(site: Railway, later: Worksite) -> bool:
    """When time has passed, no display is silent while a wrong and fresh fix puts a train into a yard (A2, A5)."""
    return all(
        a_wrong_fix_is_contradicted(site, later.told.trains[train], body, body.fix_is_right)
        for train, body in later.bodies.items()
        if train in later.told.trains
    )


def no_train_turns_as_time_passes(site: Railway, later: Worksite) -> bool:
    """When time has passed, none has done what no train does (A3)."""
    return all(
        no_train_turns_sooner(site, later.told.trains[train], body)
        for train, body in later.bodies.items()
        if train in later.told.trains
    )


def what_is_made_up_is_new_on_the_list(system: Worksite, train: Train) -> bool:
    """Of a train that is made up on the line nothing was told before, under its name (A2)."""
    return train not in system.told.trains or system.told.trains[train] == NOTHING_TOLD


def what_a_fix_says_is_along_the_register(site: Railway, body: Body, fix: TrainFix) -> bool:
    """Whatever way there is from a train to the line, no way on the register from where it was told is longer (A1).

    But by its error, and what it has run since.  A train that was told on the line, and has passed a join since, or is
    where lines join, need not have come from there over a connection.
    """
    register, place_mm, run_um = site.register, fix.place_mm, site.register.bounds.train_mm_s * fix.age_ms
    off_um = UM_A_MM * register.bounds.train_error_mm + run_um
    is_at = is_at_a_join(register, place_mm, off_um)
    return all(
        way_um + run_um > far_um(register)
        or is_over(register, place_mm, place_mm, UM_A_MM * register.ways[way].to_mm, way_um + off_um)
        or (is_at and is_by_figures(place_mm, place_mm, UM_A_MM * register.ways[way].to_mm, way_um + off_um))
        for way, way_um in body.ways_um.items()
        if way in register.ways
    )


def what_has_passed_a_join_was_told_so(site: Railway, body: Body, fix: TrainFix) -> bool:
    """A train on the line that was told elsewhere, or has passed a join since, is where that lets it be (A1)."""
    register, place_mm, run_um = site.register, fix.place_mm, site.register.bounds.train_mm_s * fix.age_ms
    off_um = UM_A_MM * register.bounds.train_error_mm + run_um
    return (
        run_um > far_um(register)
        or is_over(register, place_mm, place_mm, body.antenna_um, off_um)
        or (is_at_a_join(register, place_mm, off_um) and is_by_figures(place_mm, place_mm, body.antenna_um, off_um))
    )


def what_has_passed_a_join_was_shown_so(site: Railway, body: Body, display: Display) -> bool:
    """So is one that the display showed (A1)."""
    run_um = site.register.bounds.train_mm_s * display.age_ms
    return run_um > far_um(site.register) or is_shown_within(
        site, display, body.antenna_um, UM_A_MM * site.register.display_error_mm + run_um
    )


def what_the_display_says_is_along_the_register(site: Railway, body: Body, display: Display) -> bool:
    """Nor is any way longer from the stretch that the display shows (A1)."""
    register, run_um = site.register, site.register.bounds.train_mm_s * display.age_ms
    off_um = UM_A_MM * register.display_error_mm + run_um
    return all(
        way_um + run_um > far_um(register)
        or is_shown_within(site, display, UM_A_MM * register.ways[way].to_mm, way_um + off_um)
        for way, way_um in body.ways_um.items()
        if way in register.ways
    )


def is_shown_within(site: Railway, display: Display, place_um: int, within_um: int) -> bool:
    """Tell whether the stretch shown, or its part on another line, is that near a place along the register (A1)."""
    return is_along(site.register, display.from_mm, display.to_mm, place_um, within_um) or (
        has_another_part(display)
        and is_along(site.register, display.other_from_mm, display.other_to_mm, place_um, within_um)
    )


def trains_come_by_openings(site: Railway, body: Body) -> bool:
    """A train that is not made up on the register's lines comes onto them where an opening is registered (A1)."""
    register = site.register
    if body.came_by not in register.openings:
        return False
    place_mm = register.openings[body.came_by]
    return (not body.is_on or body.antenna_um == UM_A_MM * place_mm) and all(
        way_um > far_um(register) or is_over(register, place_mm, place_mm, UM_A_MM * register.ways[way].to_mm, way_um)
        for way, way_um in body.ways_um.items()
        if way in register.ways
    )


def trains_pass_out_where_connections_end(site: Railway, body: Body, way: Way) -> bool:
    """A train gets from the worker's line to another of the register where a connection ends (A1)."""
    ways = site.register.ways
    return body.is_on and way in ways and body.antenna_um == UM_A_MM * ways[way].to_mm


def trains_pass_in_where_connections_end(site: Railway, body: Body, way: Way, at_um: int) -> bool:
    """And from there onto the worker's line, once nothing of the way to that place is left (A1)."""
    ways = site.register.ways
    return (
        not body.is_on
        and way in ways
        and at_um == UM_A_MM * ways[way].to_mm
        and way in body.ways_um
        and body.ways_um[way] <= 0
    )
