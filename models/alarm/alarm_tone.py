"""A worker with a handset, and all trains of a line with what is told of them (A1 to A8).

Any number of trains; they run at once: each intends something, and when time passes all do it.  Reports of
either source come late, again, out of order or not at all.  A fix may be wrong, as long as the traffic
display contradicts it then: that is what there are two sources for.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

from kernel.alarm import tone as machine
from kernel.alarm.distance import GREATEST_AGE_MS, PAST_MM, UM_A_MM, Direction, TrainFix, WorkerFix, is_fix
from kernel.alarm.tone import (
    ALARM_MM,
    CAUTION_MM,
    NOTHING_KNOWN,
    Display,
    Handset,
    Known,
    NoUse,
    Register,
    Tone,
    Train,
)
from kernel.maps import Map
from kernel.onboard.arithmetic import larger, magnitude


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
    ``fix_is_right``: the fix that was told last was within its error.
    """

    antenna_um: int
    heading: Direction
    below_mm: int
    above_mm: int
    next_um: int
    next_heading: Direction
    fix_is_right: bool


@dataclass(frozen=True)
class Heard:
    """A history: a tone, and what was so when the worker heard it.

    ``within_3000``, ``within_1500``: some train was, and had not departed.
    ``matched_within_1500``: one of which both sources agreed, while the worker had a fix.
    ``unknown``: some train was not on the list, or not known as it should be, or the worker's place was not.
    ``beyond_a_tunnel``: one was on its way through a section without GPS, as far as the handset knew, and the worker,
    who had a fix, less than 1500 m beyond the end by which it would come out.
    ``not_to_be_used``: the worker was in a section that is not to be used, and had a fix.
    """

    tone: Tone
    within_3000: bool
    within_1500: bool
    matched_within_1500: bool
    unknown: bool
    beyond_a_tunnel: bool
    not_to_be_used: bool


@dataclass(frozen=True)
class Worksite:
    """One moment: where the worker is, every train of the line, what the handset knows, and what was heard last."""

    worker_um: int
    bodies: Map[Train, Body]
    handset: Handset
    heard: Heard


def gap_um(body: Body, worker_um: int) -> int:
    """Give how far a train's nearer end is from the worker; below 0 where it stands over him."""
    below_um = body.antenna_um - UM_A_MM * body.below_mm
    above_um = body.antenna_um + UM_A_MM * body.above_mm
    return larger(below_um - worker_um, worker_um - above_um)


def has_departed(body: Body, worker_um: int) -> bool:
    """Tell whether a train is past the worker by 100 m, from end to end, and ran last away from him (A3)."""
    away = Direction.DOWN if body.antenna_um > worker_um else Direction.UP
    return gap_um(body, worker_um) >= UM_A_MM * PAST_MM and body.heading == away


def approaches_within(body: Body, worker_um: int, limit_mm: int) -> bool:
    """Tell whether a train is that near, the limit included, and has not departed (A3)."""
    return gap_um(body, worker_um) <= UM_A_MM * limit_mm and not has_departed(body, worker_um)


def is_known(site: Railway, train: Train, handset: Handset) -> bool:
    """Tell whether a train is on the list, and known by both sources, or by one as registered (A2, A4 to A6)."""
    return train in handset.trains and (
        machine.is_matched(site.register, handset.trains[train])
        or machine.is_registered(site.register, train, handset.trains[train])
    )


def is_just_beyond(section: NoUse, fix: TrainFix, worker_um: int) -> bool:
    """Tell whether the worker is within 1500 m of an end by which a train may come out of a section (A4)."""
    down_um, up_um = worker_um - UM_A_MM * section.to_mm, UM_A_MM * section.from_mm - worker_um
    return (not machine.runs(fix, Direction.UP) and 0 <= down_um <= UM_A_MM * ALARM_MM) or (
        not machine.runs(fix, Direction.DOWN) and 0 <= up_um <= UM_A_MM * ALARM_MM
    )


def may_come_out_at(site: Railway, known: Known, worker_um: int) -> bool:
    """Tell whether a train, on the display, is on its way through a section towards the worker (A4)."""
    return (
        machine.has_display(site.register, known)
        and (machine.agree(site.register, known) or not machine.has_fix(site.register, known))
        and any(
            machine.is_put_forward(section, known.fix) and is_just_beyond(section, known.fix, worker_um)
            for _name, section in site.register.sections.items()
        )
    )


# ---- premises


def the_alarm_limit_is_within_an_hour(site: Railway) -> bool:
    """What counts as fresh is within the ranges of reports (A1)."""
    return site.register.fresh.server_ms <= GREATEST_AGE_MS


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
    return magnitude(to_um - from_um) <= site.register.bounds.train_mm_s * elapsed_ms


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
    return magnitude(to_um - from_um) <= site.register.bounds.worker_mm_s * elapsed_ms


def a_train_fix_is_within_its_error(site: Railway, fix: TrainFix, at_um: int) -> bool:
    """A right fix was within the error of where the antenna was (A1)."""
    return magnitude(at_um - UM_A_MM * fix.place_mm) <= UM_A_MM * site.register.bounds.train_error_mm


def a_worker_fix_is_within_its_error(site: Railway, fix: WorkerFix, at_um: int) -> bool:
    """A fix that is one was within the error of where the handset was; nothing contradicts a wrong one (A1)."""
    return magnitude(at_um - UM_A_MM * fix.place_mm) <= UM_A_MM * site.register.bounds.worker_error_mm


def a_wrong_fix_is_contradicted(site: Railway, known: Known, is_right: bool) -> bool:
    """No wrong fix agrees with a fresh display, nor puts a train that is not on the display where trains shunt (A2).

    So GPS does not err by less than the display can tell.  That is not true of nature: under a roof or in a cutting a
    fix is off by 100 m, and the display shows a stretch of some km.  It cannot be had for less: only these two sources
    tell of a train, so what both tell alike is believed, and a yard has one source alone.  The error as written has to
    be one that is measured on the line, and stretches where it is exceeded are registered.

    It says nothing of a wrong fix that agrees with no display, because there is none: then no tone is mild.
    """
    if is_right or not is_fix(known.fix.place_mm, known.fix.age_ms):
        return True
    if machine.has_display(site.register, known):
        return not machine.agree(site.register, known)
    return not machine.is_shunting(site.register, known)


def no_train_turns_sooner(site: Railway, known: Known, heading: Direction) -> bool:
    """A train on the display that was told to run one way does not run the other before it can have turned (A3).

    One that shunts, and so is not on the display, may turn at any time (A5).
    """
    fix = known.fix
    if not machine.is_matched(site.register, known) or not fix.is_running:
        return True
    if fix.age_ms > site.register.bounds.turning_ms:
        return True
    return fix.direction in (Direction.UNKNOWN, heading)


def the_display_shows_where_the_train_was(site: Railway, display: Display, at_um: int) -> bool:
    """The antenna was in the stretch that the display shows, within the error of its boundaries (A2)."""
    error_mm = site.register.display_error_mm
    return UM_A_MM * (display.from_mm - error_mm) <= at_um <= UM_A_MM * (display.to_mm + error_mm)


def sources_do_not_fail_together(site: Railway, system: Worksite, elapsed_ms: int) -> bool:
    """As time passes, no display falls silent while a wrong fix puts its train where trains shunt (A2, A5)."""
    return all(
        a_wrong_fix_is_contradicted(
            site, machine.older_known(system.handset.trains[train], elapsed_ms), body.fix_is_right
        )
        for train, body in system.bodies.items()
        if train in system.handset.trains
    )


def no_train_turns_as_time_passes(site: Railway, system: Worksite, elapsed_ms: int) -> bool:
    """None does what no train does (A3)."""
    return all(
        no_train_turns_sooner(site, machine.older_known(system.handset.trains[train], elapsed_ms), body.next_heading)
        for train, body in system.bodies.items()
        if train in system.handset.trains
    )


def the_list_is_whole(site: Railway, system: Worksite) -> bool:
    """A list of the server has every train that is on the line: each is on the display or has GPS (A1, A2)."""
    return all(train in system.handset.trains for train in system.bodies)


def the_list_names_it_before_it_comes(site: Railway, system: Worksite, train: Train) -> bool:
    """No train comes onto the line before the list has it, unless the list is not fresh (A1, A2)."""
    if train in system.handset.trains:
        return system.handset.trains[train] == NOTHING_KNOWN
    return not machine.is_linked(site.register, system.handset)


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
    if not all_trains_keep_the_lines_speed(site, system, elapsed_ms):
        return system
    if not all_trains_run_as_they_head(system):
        return system
    if not no_train_turns_as_time_passes(site, system, elapsed_ms):
        return system
    if not sources_do_not_fail_together(site, system, elapsed_ms):
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
        handset=machine.older(system.handset, elapsed_ms),
    )


# ---- what the handset is told


def hear_list(site: Railway, system: Worksite, age_ms: int, servers_well: bool) -> Worksite:
    """A list of the server arrives, after what it names and what it does not (A1)."""
    if not the_list_is_whole(site, system):
        return system
    return replace(system, handset=machine.note_list(system.handset, age_ms, servers_well))


def hear_named(site: Railway, system: Worksite, train: Train) -> Worksite:
    """The list names a train, on the line or not (A2)."""
    return replace(system, handset=machine.note_named(system.handset, train))


def hear_gone(site: Railway, system: Worksite, train: Train) -> Worksite:
    """The list has a train no more (A2)."""
    if not only_what_has_left_is_off_the_list(site, system, train):
        return system
    return replace(system, handset=machine.note_gone(system.handset, train))


def take_fix(site: Railway, system: Worksite, train: Train, fix: TrainFix, at_um: int, is_right: bool) -> Worksite:
    """GPS tells of a train; ``at_um``: where its antenna really was; ``is_right``: within the error (A1, A2)."""
    handset = machine.note_fix(system.handset, train, fix)
    if train not in system.bodies or train not in handset.trains:
        return replace(system, handset=handset)
    body = system.bodies[train]
    if not no_train_turns_sooner(site, handset.trains[train], body.heading):
        return system
    if not a_wrong_fix_is_contradicted(site, handset.trains[train], is_right):
        return system
    if (
        is_right
        and is_fix(fix.place_mm, fix.age_ms)
        and not (
            a_train_fix_is_within_its_error(site, fix, at_um)
            and the_train_keeps_the_lines_speed(site, at_um, body.antenna_um, fix.age_ms)
        )
    ):
        return system
    return replace(system, bodies=system.bodies | {train: replace(body, fix_is_right=is_right)}, handset=handset)


def take_display(site: Railway, system: Worksite, train: Train, display: Display, at_um: int) -> Worksite:
    """The display tells of a train; ``at_um``: where its antenna really was (A1, A2)."""
    handset = machine.note_display(system.handset, train, display)
    if train not in system.bodies or train not in handset.trains:
        return replace(system, handset=handset)
    body = system.bodies[train]
    if not no_train_turns_sooner(site, handset.trains[train], body.heading):
        return system
    if not a_wrong_fix_is_contradicted(site, handset.trains[train], body.fix_is_right):
        return system
    if machine.is_display(display) and not (
        the_display_shows_where_the_train_was(site, display, at_um)
        and the_train_keeps_the_lines_speed(site, at_um, body.antenna_um, display.age_ms)
    ):
        return system
    return replace(system, handset=handset)


def take_worker_fix(site: Railway, system: Worksite, fix: WorkerFix, at_um: int) -> Worksite:
    """The handset takes a fix of its own; ``at_um``: where it really was (A1, A8)."""
    if is_fix(fix.place_mm, fix.age_ms) and not (
        a_worker_fix_is_within_its_error(site, fix, at_um)
        and the_worker_keeps_a_walking_speed(site, at_um, system.worker_um, fix.age_ms)
    ):
        return system
    return replace(system, handset=machine.note_worker(system.handset, fix))


def look_at_the_battery(site: Railway, system: Worksite, battery_well: bool) -> Worksite:
    """The handset looks at its battery (A8)."""
    return replace(system, handset=machine.note_battery(system.handset, battery_well))


def listen(site: Railway, system: Worksite) -> Worksite:
    """The worker hears the tone, at any moment; what is so then goes into history (A3)."""
    handset, worker_um = system.handset, system.worker_um
    has_fix = is_fix(handset.worker.place_mm, handset.worker.age_ms)
    return replace(
        system,
        heard=Heard(
            tone=machine.tone(site.register, handset),
            within_3000=any(approaches_within(body, worker_um, CAUTION_MM) for _train, body in system.bodies.items()),
            within_1500=any(approaches_within(body, worker_um, ALARM_MM) for _train, body in system.bodies.items()),
            matched_within_1500=has_fix
            and any(
                train in handset.trains
                and machine.is_matched(site.register, handset.trains[train])
                and approaches_within(body, worker_um, ALARM_MM)
                for train, body in system.bodies.items()
            ),
            unknown=not handset.battery_well
            or not machine.has_worker(site.register, handset)
            or any(not is_known(site, train, handset) for train in system.bodies),
            beyond_a_tunnel=has_fix
            and any(
                train in handset.trains and may_come_out_at(site, handset.trains[train], worker_um)
                for train in system.bodies
            ),
            not_to_be_used=has_fix
            and any(
                UM_A_MM * section.from_mm <= worker_um <= UM_A_MM * section.to_mm
                for _name, section in site.register.sections.items()
            ),
        ),
    )
