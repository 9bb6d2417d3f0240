"""A worker with a handset, and all trains of a line with what is told of them (A1 to A8).

Any number of trains; they run at once: each intends something, and when time passes all do it.  Reports of
either source come late, again, out of order or not at all.  A fix may be wrong, as long as the traffic
display contradicts it then: that is what there are two sources for.

The worker's line is as far as its figures run on.  The other lines are any network whatever: of a train there it
matters only how far it is, along the track, from each place where it can come onto the line, and what is told of it.
The register's ways are no longer than those of the network; that is assumed of every report, and `alarm_network` says
why.  Where the register ends is an opening; of a train beyond it matters only to which opening its shortest way leads,
and how far it is from there.
"""

from __future__ import annotations

from dataclasses import replace

from kernel.alarm import tone as machine
from kernel.alarm import train_list
from kernel.alarm.distance import Direction, TrainFix, WorkerFix
from kernel.alarm.network import Opening, Way
from kernel.alarm.tone import Display, Train
from kernel.maps import Map
from models.alarm.along import is_beyond_within
from models.alarm.lists import a_train_comes_after_it_was_let_on, lists_after
from models.alarm.tone_assumptions import (
    a_train_fix_is_within_its_error,
    a_worker_fix_is_within_its_error,
    a_wrong_fix_is_contradicted,
    all_trains_keep_the_lines_speed,
    all_trains_run_as_they_head,
    no_train_is_longer_than_written,
    no_train_turns_as_time_passes,
    no_train_turns_sooner,
    sources_do_not_fail_together,
    the_display_shows_where_the_train_was,
    the_train_keeps_the_lines_speed,
    the_worker_keeps_a_walking_speed,
    trains_come_by_openings,
    trains_pass_in_where_connections_end,
    trains_pass_out_where_connections_end,
    what_a_fix_says_is_along_the_register,
    what_has_passed_a_join_was_shown_so,
    what_has_passed_a_join_was_told_so,
    what_is_made_up_is_new_on_the_list,
    what_the_display_says_is_along_the_register,
)
from models.alarm.worksite import (
    NOBODY_NEAR,
    NOWHERE_NEAR,
    Body,
    Heard,
    Near,
    Railway,
    Worksite,
    age_after_ms,
    comes_along,
    comes_over,
    has_fresh_fix,
    has_just_come,
    has_listed_fix,
    has_place,
    is_between_the_ends,
    is_in_a_stretch,
    is_known,
    is_known_by_one,
    is_list_fresh,
    is_listed,
    is_of_the_register,
    is_report,
    is_told_alike,
    may_be_within,
    may_come_out_at,
    told_after,
    with_battery,
    with_fix,
)

# ---- trains and the worker


def come(site: Railway, system: Worksite, train: Train, body: Body) -> Worksite:
    """A train is made up on the register's lines, anywhere (A2)."""
    if not a_train_comes_after_it_was_let_on(site, system, train) or not no_train_is_longer_than_written(site, body):
        return system
    if not what_is_made_up_is_new_on_the_list(system, train):
        return system
    made = replace(body, fix_is_right=True, passed_ms=3_600_001, came_ms=3_600_001)
    return replace(system, bodies=system.bodies | {train: made})


def come_by(site: Railway, system: Worksite, train: Train, body: Body) -> Worksite:
    """A train comes onto the register's lines by an opening; what was told until now was in foreign figures (A1, A2).

    One that passes a break of kilometrage that is not on the register comes so again, by the figure beyond it.
    """
    if not a_train_comes_after_it_was_let_on(site, system, train) or not no_train_is_longer_than_written(site, body):
        return system
    if not trains_come_by_openings(site, body):
        return system
    return replace(system, bodies=system.bodies | {train: replace(body, fix_is_right=False, passed_ms=0, came_ms=0)})


def pass_out(site: Railway, system: Worksite, train: Train, way: Way) -> Worksite:
    """A train passes from the worker's line to another one, where they join (A1)."""
    if train not in system.bodies:
        return system
    body = system.bodies[train]
    if not trains_pass_out_where_connections_end(site, body, way):
        return system
    out = replace(body, is_on=False, ways_um=body.ways_um | {way: 0}, passed_ms=0)
    return replace(system, bodies=system.bodies | {train: out})


def pass_in(site: Railway, system: Worksite, train: Train, way: Way, at_um: int, heading: Direction) -> Worksite:
    """A train passes from another line onto the worker's, where they join (A1)."""
    if train not in system.bodies:
        return system
    body = system.bodies[train]
    if not trains_pass_in_where_connections_end(site, body, way, at_um):
        return system
    on = replace(body, is_on=True, antenna_um=at_um, heading=heading, passed_ms=0)
    return replace(system, bodies=system.bodies | {train: on})


def leave(site: Railway, system: Worksite, train: Train) -> Worksite:
    """A train leaves the register's lines; its dispatcher knows, whenever the server may."""
    return replace(
        system,
        bodies={other: body for other, body in system.bodies.items() if other != train},
        lists=replace(system.lists, let_on={other: of for other, of in system.lists.let_on.items() if other != train}),
    )


def renumber(site: Railway, system: Worksite, old: Train, new: Train) -> Worksite:
    """A train on the line changes its number; that it had the old one was told of it alone (A2)."""
    if old not in system.bodies or new in system.bodies:
        return system
    if not a_train_comes_after_it_was_let_on(site, system, new) or not what_is_made_up_is_new_on_the_list(system, new):
        return system
    body = replace(system.bodies[old], fix_is_right=True)
    others = {other: each for other, each in system.bodies.items() if other != old}
    let_on = {other: of for other, of in system.lists.let_on.items() if other != old}
    return replace(system, bodies=others | {new: body}, lists=replace(system.lists, let_on=let_on))


def couple_or_part(site: Railway, system: Worksite, train: Train, below_mm: int, above_mm: int) -> Worksite:
    """A train becomes longer or shorter; the other one leaves, or is made up, under its own number (A2)."""
    if train not in system.bodies:
        return system
    body = replace(system.bodies[train], below_mm=below_mm, above_mm=above_mm)
    if not no_train_is_longer_than_written(site, body):
        return system
    return replace(system, bodies=system.bodies | {train: body})


def intend(
    site: Railway, system: Worksite, train: Train, to_um: int, heading: Direction, ways_um: Map[Way, int]
) -> Worksite:
    """A driver intends something, anything at all; ``ways_um``: how far that will be from the line, by each way."""
    if train not in system.bodies:
        return system
    body = replace(system.bodies[train], next_um=to_um, next_heading=heading, next_ways_um=ways_um)
    return replace(system, bodies=system.bodies | {train: body})


def pass_time(site: Railway, system: Worksite, elapsed_ms: int, worker_to_um: int) -> Worksite:
    """Time passes: all trains do what they intended, the worker walks, and what is known grows old (A1, A3)."""
    if not all_trains_keep_the_lines_speed(site, system, elapsed_ms):
        return system
    if not all_trains_run_as_they_head(system):
        return system
    if not the_worker_keeps_a_walking_speed(site, system.worker_um, worker_to_um, elapsed_ms):
        return system
    later = replace(
        system,
        worker_um=worker_to_um,
        bodies={
            train: replace(
                body,
                antenna_um=body.next_um,
                heading=body.next_heading,
                ways_um=body.next_ways_um,
                passed_ms=age_after_ms(body.passed_ms, elapsed_ms),
                came_ms=age_after_ms(body.came_ms, elapsed_ms),
            )
            for train, body in system.bodies.items()
        },
        server=train_list.older_server(system.server, elapsed_ms),
        lists=lists_after(system.lists, elapsed_ms),
        told=told_after(system.told, elapsed_ms),
        handset=machine.older(system.handset, elapsed_ms),
    )
    if not no_train_turns_as_time_passes(site, later):
        return system
    if not sources_do_not_fail_together(site, later):
        return system
    return later


# ---- what the handset is told


def take_fix(site: Railway, system: Worksite, train: Train, fix: TrainFix, at_um: int, is_right: bool) -> Worksite:
    """GPS tells of a train; ``at_um``: where its antenna really was; ``is_right``: within the error (A1, A2).

    A fix that jumps from the one before may say anything; so may what is no report.
    """
    handset = machine.note_fix(site.register, system.handset, train, fix, site.register.edition)
    if not is_listed(system.told, train):
        return replace(system, handset=handset)
    of = with_fix(site, system.told.trains[train], fix)
    told = replace(system.told, trains=system.told.trains | {train: of})
    if train not in system.bodies:
        return replace(system, told=told, handset=handset)
    body = system.bodies[train]
    is_of_now = is_right and is_of_the_register(body, fix.age_ms)
    is_taken = is_report(fix.place_mm, fix.age_ms) and not of.jumped
    is_taken_right = is_of_now if is_taken else body.fix_is_right
    if not no_train_turns_sooner(site, of, body):
        return system
    if not a_wrong_fix_is_contradicted(site, of, body, is_taken_right):
        return system
    counts = is_taken and is_of_now
    if counts and not what_a_fix_says_is_along_the_register(site, body, fix):
        return system
    if (
        counts
        and body.is_on
        and not (
            fix.age_ms < body.passed_ms
            and a_train_fix_is_within_its_error(site, fix, at_um)
            and the_train_keeps_the_lines_speed(site, at_um, body.antenna_um, fix.age_ms)
        )
        and not what_has_passed_a_join_was_told_so(site, body, fix)
    ):
        return system
    bodies = system.bodies | {train: replace(body, fix_is_right=is_taken_right)}
    return replace(system, bodies=bodies, told=told, handset=handset)


def take_display(site: Railway, system: Worksite, train: Train, display: Display, at_um: int) -> Worksite:
    """The display tells of a train; ``at_um``: where its antenna really was (A1, A2)."""
    handset = machine.note_display(site.register, system.handset, train, display, site.register.edition)
    if not is_listed(system.told, train):
        return replace(system, handset=handset)
    of = replace(system.told.trains[train], display=display)
    told = replace(system.told, trains=system.told.trains | {train: of})
    if train not in system.bodies:
        return replace(system, told=told, handset=handset)
    body = system.bodies[train]
    if not no_train_turns_sooner(site, of, body):
        return system
    if not a_wrong_fix_is_contradicted(site, of, body, body.fix_is_right):
        return system
    counts = is_in_a_stretch(display) and is_of_the_register(body, display.age_ms)
    if counts and not what_the_display_says_is_along_the_register(site, body, display):
        return system
    if (
        counts
        and body.is_on
        and not (
            the_display_shows_where_the_train_was(site, display, at_um)
            and the_train_keeps_the_lines_speed(site, at_um, body.antenna_um, display.age_ms)
        )
        and not what_has_passed_a_join_was_shown_so(site, body, display)
    ):
        return system
    return replace(system, told=told, handset=handset)


def take_fix_of_another_edition(site: Railway, system: Worksite, train: Train, fix: TrainFix, edition: int) -> Worksite:
    """GPS tells of a train in the figures of another edition of the register, which may be of any place (A1).

    Track was moved: the server has the new register and the handset not yet, or the other way round.
    """
    if edition == site.register.edition:
        return system
    return replace(system, handset=machine.note_fix(site.register, system.handset, train, fix, edition))


def take_display_of_another_edition(
    site: Railway, system: Worksite, train: Train, display: Display, edition: int
) -> Worksite:
    """So does the display (A1)."""
    if edition == site.register.edition:
        return system
    return replace(system, handset=machine.note_display(site.register, system.handset, train, display, edition))


def take_worker_fix(site: Railway, system: Worksite, fix: WorkerFix, at_um: int) -> Worksite:
    """The handset takes a fix of its own; ``at_um``: where it really was (A1, A8)."""
    counts = is_report(fix.place_mm, fix.age_ms)
    if counts and not (
        a_worker_fix_is_within_its_error(site, fix, at_um)
        and the_worker_keeps_a_walking_speed(site, at_um, system.worker_um, fix.age_ms)
    ):
        return system
    return replace(system, told=replace(system.told, worker=fix), handset=machine.note_worker(system.handset, fix))


def look_at_the_battery(site: Railway, system: Worksite, battery_well: bool) -> Worksite:
    """The handset looks at its battery (A8)."""
    return replace(
        system,
        told=with_battery(system.told, battery_well),
        handset=machine.note_battery(system.handset, battery_well),
    )


def listen(site: Railway, system: Worksite, opening: Opening, beyond_um: int) -> Worksite:
    """The worker hears the tone, at any moment; what is so then goes into history (A3).

    ``opening``, ``beyond_um``: where a train is then that is not on the register's lines, if one is: to which opening
    its way leads, and how far from there.
    """
    told, worker_um = system.told, system.worker_um
    has_fix = is_report(told.worker.place_mm, told.worker.age_ms)
    return replace(
        system,
        heard=replace(
            NOBODY_NEAR,
            tone=machine.tone(site.register, system.handset),
            within_3000=beyond(site, system, opening, beyond_um, 3_000_000),
            within_1500=beyond(site, system, opening, beyond_um, 1_500_000),
            unknown=not told.battery_well
            or not has_place(site, told)
            or not is_list_fresh(site, told)
            or any(not is_known(site, train, told) for train in system.bodies),
            astray=any(
                of.jumped or (not has_fresh_fix(site, of) and not is_known_by_one(site, train, of))
                for train, of in told.trains.items()
            ),
            beyond_a_tunnel=has_fix
            and any(
                train in told.trains and may_come_out_at(site, told.trains[train], worker_um) for train in system.bodies
            ),
            not_to_be_used=has_fix
            and any(is_between_the_ends(section, worker_um) for _name, section in site.register.sections.items()),
            jumped_within_1500=has_fix
            and any(
                of.jumped and may_be_within(site, of.newest, told.worker, 1_500_000)
                for _train, of in told.trains.items()
            ),
        ),
    )


def listen_for_one_that_came(site: Railway, system: Worksite, train: Train, way: Way) -> Worksite:
    """The worker hears the tone; where a train is that has just come by an opening goes into history (A3).

    ``way``: by which it may come over other lines.
    """
    if train not in system.bodies:
        return system
    came = has_just_come(site, system.bodies[train])
    return replace(system, heard=heard_of(site, system, train, way) if came else system.heard)


def listen_for_one_with_a_fix(site: Railway, system: Worksite, train: Train, way: Way) -> Worksite:
    """The worker hears the tone; where another train is, of which GPS tells freshly, goes into history (A3)."""
    if train not in system.bodies:
        return system
    came, has_a_fix = has_just_come(site, system.bodies[train]), has_listed_fix(site, system.told, train)
    return replace(system, heard=heard_of(site, system, train, way) if has_a_fix and not came else system.heard)


def listen_for_one_without_a_fix(site: Railway, system: Worksite, train: Train, way: Way) -> Worksite:
    """The worker hears the tone; where another train is, of which GPS does not, goes into history (A3)."""
    if train not in system.bodies:
        return system
    came, has_a_fix = has_just_come(site, system.bodies[train]), has_listed_fix(site, system.told, train)
    return replace(system, heard=system.heard if has_a_fix or came else heard_of(site, system, train, way))


def heard_of(site: Railway, system: Worksite, train: Train, way: Way) -> Heard:
    """Give the tone that the worker hears, and where a train of the register's lines is then (A3)."""
    told, body, near_1500 = system.told, system.bodies[train], near(site, system, train, way, 1_500_000)
    is_matched = (
        is_report(told.worker.place_mm, told.worker.age_ms)
        and is_listed(told, train)
        and not has_just_come(site, body)
        and is_told_alike(site, told.trains[train])
    )
    return replace(
        NOBODY_NEAR,
        tone=machine.tone(site.register, system.handset),
        within_3000=near(site, system, train, way, 3_000_000),
        within_1500=near_1500,
        matched_within_1500=near_1500 if is_matched else NOWHERE_NEAR,
    )


def near(site: Railway, system: Worksite, train: Train, way: Way, limit_mm: int) -> Near:
    """Tell by which ways a train of the register's lines is that near the worker (A3)."""
    body, worker_um = system.bodies[train], system.worker_um
    return Near(
        along_his_line=comes_along(body, worker_um, limit_mm),
        over_other_lines=comes_over(site, body, way, worker_um, limit_mm),
        by_an_opening=False,
    )


def beyond(site: Railway, system: Worksite, opening: Opening, beyond_um: int, limit_mm: int) -> Near:
    """Tell whether a train that is not on the register's lines is that near the worker (A3)."""
    return replace(
        NOWHERE_NEAR,
        by_an_opening=is_beyond_within(site.register, opening, beyond_um, system.worker_um, limit_mm),
    )
