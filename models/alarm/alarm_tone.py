"""A worker with a handset, and all trains of a line with what is told of them (A1 to A8).

Any number of trains; they run at once: each intends something, and when time passes all do it.  Reports of
either source come late, again, out of order or not at all.  A fix may be wrong, as long as the traffic
display contradicts it then: that is what there are two sources for.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

from kernel.alarm import tone as machine
from kernel.alarm.distance import Direction, TrainFix, WorkerFix
from kernel.alarm.tone import Display, Handset, NoUse, Reason, Register, Tone, Train
from kernel.maps import Map
from models.measures import UM_A_MM, apart, greater


@dataclass(frozen=True)
class Railway:
    """What does not change: the register of the line (A1 to A6)."""

    register: Register


@dataclass(frozen=True)
class Body:
    """A train as it is.

    ``antenna_um``, ``heading``: where its antenna is, and which way it runs, or ran last if it stands.
    ``below_mm``, ``above_mm``: how far it reaches from there.
    ``next_um``, ``next_heading``: what it will have done when time has passed.
    ``fix_is_right``: the fix that was told last, of those that fitted, was within its error.
    """

    antenna_um: int
    heading: Direction
    below_mm: int
    above_mm: int
    next_um: int
    next_heading: Direction
    fix_is_right: bool


@dataclass(frozen=True)
class OfTrain:
    """What was told of a train since the list named it, as old as it truly is by the ages told (A1, A2).

    ``fix``: the last of its fixes that fitted the one before.  ``jumped``: the last one of all did not.
    """

    fix: TrainFix
    display: Display
    jumped: bool


NOTHING_TOLD = OfTrain(
    fix=TrainFix(place_mm=0, age_ms=3_600_001, direction=Direction.UNKNOWN, is_running=False),
    display=Display(from_mm=0, to_mm=0, age_ms=3_600_001),
    jumped=False,
)
"""Of a train that the list has just named."""


@dataclass(frozen=True)
class Told:
    """A history: all that was told to the handset, by itself and by the servers, the last of each (A1, A8)."""

    worker: WorkerFix
    list_age_ms: int
    servers_well: bool
    battery_well: bool
    trains: Map[Train, OfTrain]


@dataclass(frozen=True)
class Heard:
    """A history: a tone, and what was so when the worker heard it.

    ``within_3000``, ``within_1500``: some train was, and had not departed.
    ``matched_within_1500``: one of which both sources agreed, while the worker had a fix.
    ``unknown``: some train was not on the list, or not known as it should be, or the worker's place was not.
    ``astray``: of some train on the list the last fix jumped, or the last that fitted is too old, and the display alone
    is not enough for it.
    ``beyond_a_tunnel``: one was on its way through a section without GPS, as far as the handset knew, and the worker,
    who had a fix, less than 1500 m beyond the end by which it would come out.
    ``not_to_be_used``: the worker was in a section that is not to be used, and had a fix.
    """

    tone: Tone
    within_3000: bool
    within_1500: bool
    matched_within_1500: bool
    unknown: bool
    astray: bool
    beyond_a_tunnel: bool
    not_to_be_used: bool


@dataclass(frozen=True)
class Worksite:
    """One moment: the worker, every train of the line, what was told, what the handset knows, and what was heard."""

    worker_um: int
    bodies: Map[Train, Body]
    told: Told
    handset: Handset
    heard: Heard


def gap_um(body: Body, worker_um: int) -> int:
    """Give how far a train's nearer end is from the worker; below 0 where it stands over him."""
    below_um = body.antenna_um - UM_A_MM * body.below_mm
    above_um = body.antenna_um + UM_A_MM * body.above_mm
    return greater(below_um - worker_um, worker_um - above_um)


def has_departed(body: Body, worker_um: int) -> bool:
    """Tell whether a train is past by 100 m (004, 3.3), from end to end, and ran last away from the worker (A3)."""
    away = Direction.DOWN if body.antenna_um > worker_um else Direction.UP
    return gap_um(body, worker_um) >= UM_A_MM * 100_000 and body.heading == away


def approaches_within(body: Body, worker_um: int, limit_mm: int) -> bool:
    """Tell whether a train is that near, the limit included, and has not departed (A3)."""
    return gap_um(body, worker_um) <= UM_A_MM * limit_mm and not has_departed(body, worker_um)


# ---- what was told, by the register of the line alone


def is_report(place_mm: int, age_ms: int) -> bool:
    """Tell whether a report can be of a line: within 1000 km of its origin, and an hour old at the most (ours; A1)."""
    return -1_000_000_000 <= place_mm <= 1_000_000_000 and 0 <= age_ms <= 3_600_000


def age_after_ms(age_ms: int, elapsed_ms: int) -> int:
    """Give an age after some time; more than an hour where it was, or where the clock goes back or leaps (ours; A1)."""
    return age_ms + elapsed_ms if 0 <= age_ms <= 3_600_000 and 0 <= elapsed_ms <= 3_600_000 else 3_600_001


def of_train_after(of: OfTrain, elapsed_ms: int) -> OfTrain:
    """Give what was told of a train after some time (A1)."""
    return replace(
        of,
        fix=replace(of.fix, age_ms=age_after_ms(of.fix.age_ms, elapsed_ms)),
        display=replace(of.display, age_ms=age_after_ms(of.display.age_ms, elapsed_ms)),
    )


def told_after(told: Told, elapsed_ms: int) -> Told:
    """Give what was told after some time (A1)."""
    return replace(
        told,
        worker=replace(told.worker, age_ms=age_after_ms(told.worker.age_ms, elapsed_ms)),
        list_age_ms=age_after_ms(told.list_age_ms, elapsed_ms),
        trains={train: of_train_after(of, elapsed_ms) for train, of in told.trains.items()},
    )


def fits(site: Railway, before: TrainFix, fix: TrainFix) -> bool:
    """Tell whether a train can have been near both places, as far as fixes err, within the line's speed (A1)."""
    if not is_report(before.place_mm, before.age_ms) or not is_report(fix.place_mm, fix.age_ms):
        return True
    bounds = site.register.bounds
    run_um = bounds.train_mm_s * apart(fix.age_ms, before.age_ms)
    return UM_A_MM * apart(fix.place_mm, before.place_mm) <= run_um + 2 * UM_A_MM * bounds.train_error_mm


def with_list(told: Told, age_ms: int, servers_well: bool) -> Told:
    """Give what was told after a list of the server (A1)."""
    return replace(told, list_age_ms=age_ms, servers_well=servers_well)


def with_battery(told: Told, battery_well: bool) -> Told:
    """Give what was told after a look at the battery (A8)."""
    return replace(told, battery_well=battery_well)


def with_fix(site: Railway, of: OfTrain, fix: TrainFix) -> OfTrain:
    """Give what was told of a train after one more fix (A1, A2)."""
    return replace(of, fix=fix, jumped=False) if fits(site, of.fix, fix) else replace(of, jumped=True)


def has_fresh_fix(site: Railway, of: OfTrain) -> bool:
    """Tell whether there is a fix, no older than is written (A1)."""
    return is_report(of.fix.place_mm, of.fix.age_ms) and of.fix.age_ms <= site.register.fresh.fix_ms


def is_in_a_stretch(display: Display) -> bool:
    """Tell whether the display shows a stretch of a line (A1)."""
    return is_report(display.from_mm, display.age_ms) and is_report(display.to_mm, display.age_ms)


def is_shown(site: Railway, of: OfTrain) -> bool:
    """Tell whether the display shows a train, no longer ago than is written (A1)."""
    return is_in_a_stretch(of.display) and of.display.age_ms <= site.register.fresh.display_ms


def is_where_shown(site: Railway, of: OfTrain) -> bool:
    """Tell whether the fix is in the stretch shown, or as near to it as is written (A2)."""
    tolerance_mm = site.register.tolerance_mm
    return of.display.from_mm - tolerance_mm <= of.fix.place_mm <= of.display.to_mm + tolerance_mm


def is_told_alike(site: Railway, of: OfTrain) -> bool:
    """Tell whether both sources tell freshly of a train, and alike (A2)."""
    return has_fresh_fix(site, of) and is_shown(site, of) and is_where_shown(site, of)


def is_in(section: NoUse, place_mm: int) -> bool:
    """Tell whether a place is in a section, its ends included (A4, A5)."""
    return section.from_mm <= place_mm <= section.to_mm


def shunts(site: Railway, of: OfTrain) -> bool:
    """Tell whether a train is not on the display, and its fix is where trains shunt (004, 4.2; A5)."""
    return not is_shown(site, of) and any(
        section.reason == Reason.SHUNTING and is_in(section, of.fix.place_mm)
        for _name, section in site.register.sections.items()
    )


def heads(fix: TrainFix, way: Direction) -> bool:
    """Tell whether a fix tells of a train that runs that way (A3)."""
    return fix.is_running and fix.direction == way


def is_on_its_way_through(section: NoUse, fix: TrainFix) -> bool:
    """Tell whether a train was last seen in a section without GPS, and not in zone B of it (004, 4.1; A4)."""
    is_leaving_down = heads(fix, Direction.DOWN) and fix.place_mm > section.to_mm - section.zone_mm
    is_leaving_up = heads(fix, Direction.UP) and fix.place_mm < section.from_mm + section.zone_mm
    return (
        section.reason == Reason.WITHOUT_GPS
        and is_in(section, fix.place_mm)
        and not is_leaving_down
        and not is_leaving_up
    )


def is_known_by_one(site: Railway, train: Train, of: OfTrain) -> bool:
    """Tell whether one source alone tells of a train where that is registered: shunting, tunnel, roster (A4 to A6)."""
    if has_fresh_fix(site, of):
        return shunts(site, of)
    is_lost = is_report(of.fix.place_mm, of.fix.age_ms) and any(
        is_on_its_way_through(section, of.fix) for _name, section in site.register.sections.items()
    )
    is_stabled = any(
        section.reason == Reason.STABLING
        and (train, name) in site.register.stabled
        and is_in(section, of.display.from_mm)
        and is_in(section, of.display.to_mm)
        for name, section in site.register.sections.items()
    )
    return is_shown(site, of) and (is_lost or is_stabled)


def is_known(site: Railway, train: Train, told: Told) -> bool:
    """Tell whether a train is on the list, and known by both sources, or by one as registered (A2, A4 to A6)."""
    return train in told.trains and (
        is_told_alike(site, told.trains[train]) or is_known_by_one(site, train, told.trains[train])
    )


def is_listed(told: Told, train: Train) -> bool:
    """Tell whether the list has a train (A2)."""
    return train in told.trains


def has_place(site: Railway, told: Told) -> bool:
    """Tell whether the worker's own place is told, no longer ago than is written (A8)."""
    worker = told.worker
    return is_report(worker.place_mm, worker.age_ms) and worker.age_ms <= site.register.fresh.worker_ms


def is_list_fresh(site: Railway, told: Told) -> bool:
    """Tell whether the list is no older than is written, and the servers said to be well (A1, A8)."""
    return 0 <= told.list_age_ms <= site.register.fresh.server_ms and told.servers_well


def is_just_beyond(section: NoUse, fix: TrainFix, worker_um: int) -> bool:
    """Tell whether the worker is within 1500 m (004, 3.3) of an end by which a train may come out of a section (A4)."""
    down_um, up_um = worker_um - UM_A_MM * section.to_mm, UM_A_MM * section.from_mm - worker_um
    return (not heads(fix, Direction.UP) and 0 <= down_um <= UM_A_MM * 1_500_000) or (
        not heads(fix, Direction.DOWN) and 0 <= up_um <= UM_A_MM * 1_500_000
    )


def may_come_out_at(site: Railway, of: OfTrain, worker_um: int) -> bool:
    """Tell whether a train, on the display, is on its way through a section towards the worker (A4)."""
    return (
        is_shown(site, of)
        and (is_where_shown(site, of) or not has_fresh_fix(site, of))
        and any(
            is_on_its_way_through(section, of.fix) and is_just_beyond(section, of.fix, worker_um)
            for _name, section in site.register.sections.items()
        )
    )


# ---- premises


def the_alarm_limit_is_within_an_hour(site: Railway) -> bool:
    """What counts as fresh is within the ranges of reports (A1)."""
    return site.register.fresh.server_ms <= 3_600_000


def the_error_is_not_negative(site: Railway) -> bool:
    """The error of a train's fix is written as a way, not below zero (A1)."""
    return site.register.bounds.train_error_mm >= 0


# ---- assumptions


def no_train_is_longer_than_written(site: Railway, body: Body) -> bool:
    """Both ends of a train are no farther from its antenna than the greatest length of the line (A1)."""
    length_mm = site.register.bounds.length_mm
    return 0 <= body.below_mm <= length_mm and 0 <= body.above_mm <= length_mm


def the_train_keeps_the_lines_speed(site: Railway, from_um: int, to_um: int, elapsed_ms: int) -> bool:
    """No train is faster than the line's greatest speed, of which the written bound has a margin for clocks (A1)."""
    return apart(to_um, from_um) <= site.register.bounds.train_mm_s * elapsed_ms


def all_trains_keep_the_lines_speed(site: Railway, system: Worksite, elapsed_ms: int) -> bool:
    """None is faster, while time passes (A1)."""
    return all(
        the_train_keeps_the_lines_speed(site, body.antenna_um, body.next_um, elapsed_ms)
        for _train, body in system.bodies.items()
    )


def all_trains_run_as_they_head(system: Worksite) -> bool:
    """A train gets nowhere but the way that it heads; one that turns takes a step each way (A3)."""
    return all(
        (body.next_heading != Direction.DOWN or body.next_um >= body.antenna_um)
        and (body.next_heading != Direction.UP or body.next_um <= body.antenna_um)
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


def a_wrong_fix_is_contradicted(site: Railway, of: OfTrain, is_right: bool) -> bool:
    """A wrong fix that fits agrees with no fresh display, nor puts a train that is not on it where trains shunt (A2).

    So GPS does not err by less than the display can tell.  That is not true of nature: under a roof or in a cutting a
    fix is off by 100 m, and the display shows a stretch of some km.  It cannot be had for less: only these two sources
    tell of a train, so what both tell alike is believed, and a yard has one source alone.  The error as written has to
    be one that is measured on the line, and stretches where it is exceeded are registered.

    It says nothing of a wrong fix that agrees with no display, because there is none, nor of one that jumps from the
    one before: then no tone is mild.
    """
    if is_right or not is_report(of.fix.place_mm, of.fix.age_ms):
        return True
    if is_shown(site, of):
        return not is_where_shown(site, of)
    return not shunts(site, of)


def no_train_turns_sooner(site: Railway, of: OfTrain, heading: Direction) -> bool:
    """A train on the display that was told to run one way does not run the other before it can have turned (A3).

    One that shunts, and so is not on the display, may turn at any time (A5).
    """
    fix = of.fix
    if not is_told_alike(site, of) or not fix.is_running:
        return True
    if fix.age_ms > site.register.bounds.turning_ms:
        return True
    return fix.direction in (Direction.UNKNOWN, heading)


def the_display_shows_where_the_train_was(site: Railway, display: Display, at_um: int) -> bool:
    """The antenna was in the stretch that the display shows, within the error of its boundaries (A2)."""
    error_mm = site.register.display_error_mm
    return UM_A_MM * (display.from_mm - error_mm) <= at_um <= UM_A_MM * (display.to_mm + error_mm)


def sources_do_not_fail_together(site: Railway, system: Worksite, told: Told) -> bool:
    """As time passes, no display falls silent while a wrong fix puts its train where trains shunt (A2, A5)."""
    return all(
        a_wrong_fix_is_contradicted(site, told.trains[train], body.fix_is_right)
        for train, body in system.bodies.items()
        if train in told.trains
    )


def no_train_turns_as_time_passes(site: Railway, system: Worksite, told: Told) -> bool:
    """None does what no train does (A3)."""
    return all(
        no_train_turns_sooner(site, told.trains[train], body.next_heading)
        for train, body in system.bodies.items()
        if train in told.trains
    )


def the_list_is_whole(site: Railway, system: Worksite) -> bool:
    """A list of the server has every train that is on the line: each is on the display or has GPS (A1, A2)."""
    return all(train in system.told.trains for train in system.bodies)


def the_list_names_it_before_it_comes(site: Railway, system: Worksite, train: Train) -> bool:
    """No train comes onto the line, nor its reports, before the list has it, unless the list is not fresh (A1, A2)."""
    if train in system.told.trains:
        return system.told.trains[train] == NOTHING_TOLD
    return not is_list_fresh(site, system.told)


def only_what_has_left_is_off_the_list(site: Railway, system: Worksite, train: Train) -> bool:
    """The server takes no train off its list that is on the line (A2)."""
    return train not in system.bodies


# ---- trains and the worker


def come(site: Railway, system: Worksite, train: Train, body: Body) -> Worksite:
    """A train comes onto the line, or is made up there (A2)."""
    if not the_list_names_it_before_it_comes(site, system, train) or not no_train_is_longer_than_written(site, body):
        return system
    return replace(system, bodies=system.bodies | {train: replace(body, fix_is_right=True)})


def leave(site: Railway, system: Worksite, train: Train) -> Worksite:
    """A train leaves the line."""
    return replace(system, bodies={other: body for other, body in system.bodies.items() if other != train})


def intend(site: Railway, system: Worksite, train: Train, to_um: int, heading: Direction) -> Worksite:
    """A driver intends something, anything at all."""
    if train not in system.bodies:
        return system
    body = replace(system.bodies[train], next_um=to_um, next_heading=heading)
    return replace(system, bodies=system.bodies | {train: body})


def pass_time(site: Railway, system: Worksite, elapsed_ms: int, worker_to_um: int) -> Worksite:
    """Time passes: all trains do what they intended, the worker walks, and what is known grows old (A1, A3)."""
    told = told_after(system.told, elapsed_ms)
    if not all_trains_keep_the_lines_speed(site, system, elapsed_ms):
        return system
    if not all_trains_run_as_they_head(system):
        return system
    if not no_train_turns_as_time_passes(site, system, told):
        return system
    if not sources_do_not_fail_together(site, system, told):
        return system
    if not the_worker_keeps_a_walking_speed(site, system.worker_um, worker_to_um, elapsed_ms):
        return system
    return replace(
        system,
        worker_um=worker_to_um,
        bodies={
            train: replace(body, antenna_um=body.next_um, heading=body.next_heading)
            for train, body in system.bodies.items()
        },
        told=told,
        handset=machine.older(system.handset, elapsed_ms),
    )


# ---- what the handset is told


def hear_list(site: Railway, system: Worksite, age_ms: int, servers_well: bool) -> Worksite:
    """A list of the server arrives, after what it names and what it does not (A1)."""
    if not the_list_is_whole(site, system):
        return system
    return replace(
        system,
        told=with_list(system.told, age_ms, servers_well),
        handset=machine.note_list(system.handset, age_ms, servers_well),
    )


def hear_named(site: Railway, system: Worksite, train: Train) -> Worksite:
    """The list names a train, on the line or not; what was told of it before is of another run (A2)."""
    return replace(
        system,
        told=replace(system.told, trains=system.told.trains | {train: NOTHING_TOLD}),
        handset=machine.note_named(system.handset, train),
    )


def hear_gone(site: Railway, system: Worksite, train: Train) -> Worksite:
    """The list has a train no more (A2)."""
    if not only_what_has_left_is_off_the_list(site, system, train):
        return system
    trains = {other: of for other, of in system.told.trains.items() if other != train}
    return replace(system, told=replace(system.told, trains=trains), handset=machine.note_gone(system.handset, train))


def take_fix(site: Railway, system: Worksite, train: Train, fix: TrainFix, at_um: int, is_right: bool) -> Worksite:
    """GPS tells of a train; ``at_um``: where its antenna really was; ``is_right``: within the error (A1, A2).

    A fix that jumps from the one before may say anything.
    """
    handset = machine.note_fix(site.register.bounds, system.handset, train, fix)
    if not is_listed(system.told, train):
        return replace(system, handset=handset)
    of = with_fix(site, system.told.trains[train], fix)
    told = replace(system.told, trains=system.told.trains | {train: of})
    if train not in system.bodies:
        return replace(system, told=told, handset=handset)
    body = system.bodies[train]
    is_taken_right = body.fix_is_right if of.jumped else is_right
    if not no_train_turns_sooner(site, of, body.heading):
        return system
    if not a_wrong_fix_is_contradicted(site, of, is_taken_right):
        return system
    counts = is_right and not of.jumped and is_report(fix.place_mm, fix.age_ms)
    if counts and not (
        a_train_fix_is_within_its_error(site, fix, at_um)
        and the_train_keeps_the_lines_speed(site, at_um, body.antenna_um, fix.age_ms)
    ):
        return system
    bodies = system.bodies | {train: replace(body, fix_is_right=is_taken_right)}
    return replace(system, bodies=bodies, told=told, handset=handset)


def take_display(site: Railway, system: Worksite, train: Train, display: Display, at_um: int) -> Worksite:
    """The display tells of a train; ``at_um``: where its antenna really was (A1, A2)."""
    handset = machine.note_display(system.handset, train, display)
    if not is_listed(system.told, train):
        return replace(system, handset=handset)
    of = replace(system.told.trains[train], display=display)
    told = replace(system.told, trains=system.told.trains | {train: of})
    if train not in system.bodies:
        return replace(system, told=told, handset=handset)
    body = system.bodies[train]
    if not no_train_turns_sooner(site, of, body.heading):
        return system
    if not a_wrong_fix_is_contradicted(site, of, body.fix_is_right):
        return system
    counts = is_in_a_stretch(display)
    if counts and not (
        the_display_shows_where_the_train_was(site, display, at_um)
        and the_train_keeps_the_lines_speed(site, at_um, body.antenna_um, display.age_ms)
    ):
        return system
    return replace(system, told=told, handset=handset)


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


def listen(site: Railway, system: Worksite) -> Worksite:
    """The worker hears the tone, at any moment; what is so then goes into history (A3).

    3000 m, 1500 m and 100 m are the paper's (004, 3.3).
    """
    told, worker_um = system.told, system.worker_um
    has_fix = is_report(told.worker.place_mm, told.worker.age_ms)
    return replace(
        system,
        heard=Heard(
            tone=machine.tone(site.register, system.handset),
            within_3000=any(approaches_within(body, worker_um, 3_000_000) for _train, body in system.bodies.items()),
            within_1500=any(approaches_within(body, worker_um, 1_500_000) for _train, body in system.bodies.items()),
            matched_within_1500=has_fix
            and any(
                train in told.trains
                and is_told_alike(site, told.trains[train])
                and approaches_within(body, worker_um, 1_500_000)
                for train, body in system.bodies.items()
            ),
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
            and any(
                UM_A_MM * section.from_mm <= worker_um <= UM_A_MM * section.to_mm
                for _name, section in site.register.sections.items()
            ),
        ),
    )
