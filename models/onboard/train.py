"""One train from its sensors to its brake: what happens to it, and all that its computer makes of that (P7, T12).

Each world takes its own step, as it is proved there: had it refused one, its train would have stayed behind.
"""

from __future__ import annotations

from dataclasses import replace

from kernel.onboard import brake_demand, computer
from kernel.onboard import braking as brake_control
from kernel.onboard.antenna_spacing import is_healthy
from kernel.onboard.computer import Computer
from kernel.onboard.odometry import Readings, is_located, rear_least_mm
from kernel.onboard.split import Readings as TailReadings
from models.onboard import (
    antenna_spacing,
    brake_watch,
    braking,
    odometry,
    slowing,
    speed_limit,
    tag_window,
    train_length,
)
from models.onboard.antenna_spacing import Trailing
from models.onboard.braking import Approach
from models.onboard.speed_limit import Passage
from models.onboard.train_length import Formation
from models.onboard.train_nature import (
    Train,
    Whole,
    a_brake_that_has_responded_keeps_its_bound,
    a_cycle_begins_when_the_one_before_was_sensed,
    a_cycle_is_sensed_once,
    a_kind_hides_no_restriction,
    a_rolling_wheel_measures,
    a_tachometer_sticks_at_a_speed,
    a_tag_is_read_in_the_read_window,
    a_tag_lies_where_it_is_listed,
    a_train_whose_computer_is_off_is_held,
    a_wheel_that_keeps_pace_rolls,
    approach,
    braked,
    formation,
    leaving_the_creep_takes_a_jolt,
    length_nm,
    line,
    passage,
    profile,
    railway,
    running,
    stretch,
    tail_comes_over,
    the_head_is_no_faster_than_at_the_ends_of_a_cycle,
    the_inertial_sensor_keeps_its_bound,
    the_rest_of_the_cycle_follows_the_speed,
    the_tails_antenna_reads_in_its_window,
    the_train_gains_no_more,
    the_train_stands_where_it_is_said_to,
    the_train_stays_within_its_powers,
    the_way_follows_the_speed,
    track,
    watched,
    watched_over,
    way_nm,
    who_finds_the_train_whole_finds_its_antennas_as_preset,
    who_says_where_a_held_train_is_sees_it_stand,
)
from models.onboard.units import NM_A_MM

UNASSIGNED = 0
"""The kind of a tag whose record is not looked at."""


def run_a_cycle(
    site: Train, system: Whole, may_proceed: bool, acknowledged: bool, to_nm: int, speed_um_s: int
) -> Whole:
    """The computer decides on the brake, and the train runs for a cycle (T12)."""
    if not a_cycle_begins_when_the_one_before_was_sensed(system):
        return system
    if not the_head_is_no_faster_than_at_the_ends_of_a_cycle(system, to_nm, speed_um_s):
        return system
    if not the_train_gains_no_more(site, system, speed_um_s):
        return system
    decided = computer.decide(site.limits, system.computer, may_proceed, acknowledged)
    if not a_brake_that_has_responded_keeps_its_bound(site, system, decided.brake.applied, speed_um_s):
        return system
    at = system.computer.known.motion
    demanded = brake_demand.is_demanded(site.limits.train, decided.known, may_proceed)
    return replace(
        system,
        front_nm=to_nm,
        speed_um_s=speed_um_s,
        from_nm=system.front_nm,
        from_um_s=system.speed_um_s,
        runs=True,
        approach=braking.run_a_cycle(
            braked(site),
            approach(system),
            at.front_most_mm,
            at.speed_least_mm_s,
            at.speed_most_mm_s,
            demanded,
            acknowledged,
            to_nm,
            speed_um_s,
        ),
        expecting=tag_window.run_a_cycle(
            stretch(site),
            system.expecting,
            way_nm(system, system.front_nm),
            computer.way_to(system.computer, computer.place(system.computer)),
        ),
        watched=system.watched if decided.brake.applied else brake_watch.release(watched_over(site), watched(system)),
        trailing=antenna_spacing.run(track(site), system.trailing, system.front_nm),
        passing=speed_limit.run_on(
            profile(site),
            passage(system, system.front_nm),
            system.front_nm,
            system.speed_um_s,
            is_located(at),
            rear_least_mm(at, site.limits.train.length_mm),
            at.front_most_mm,
            at.speed_most_mm_s,
        ),
        computer=decided,
    )


def sense_the_cycle(
    site: Train,
    system: Whole,
    readings: Readings,
    tail: TailReadings,
    gradient_mm_s2: int,
    slips: bool,
    sticks: bool,
) -> Whole:
    """At its end the sensors say what they say of it (P1, P7)."""
    if not a_cycle_is_sensed_once(system):
        return system
    if not the_way_follows_the_speed(system, readings):
        return system
    if not the_train_stays_within_its_powers(site, system, readings):
        return system
    if not the_inertial_sensor_keeps_its_bound(site, system, readings, gradient_mm_s2):
        return system
    if not a_tachometer_sticks_at_a_speed(site, system, readings, sticks):
        return system
    if not a_rolling_wheel_measures(site, system, readings, slips, sticks):
        return system
    if not leaving_the_creep_takes_a_jolt(site, system, readings, slips, sticks):
        return system
    if not a_wheel_that_keeps_pace_rolls(site, system, readings, slips, sticks):
        return system
    sensed = computer.sense(site.limits, system.computer, readings, tail)
    window = system.computer.known.window
    at = sensed.known.motion
    return replace(
        system,
        runs=False,
        astern=window.expected and not window.passed and tail_comes_over(site, system),
        running=odometry.run_a_cycle(
            line(site), running(system), readings, system.front_nm, system.speed_um_s, gradient_mm_s2, slips, sticks
        ),
        watched=brake_watch.run_a_cycle(
            watched_over(site),
            watched(system),
            system.computer.brake.applied,
            is_located(at),
            at.speed_least_mm_s,
            at.speed_most_mm_s,
            system.speed_um_s,
        ),
        computer=sensed,
    )


def read_a_tag(
    site: Train,
    system: Whole,
    uid: int,
    place_mm: int,
    kind: int,
    read_at_nm: int,
    in_curve: bool,
    at_turnout: bool,
) -> Whole:
    """In the newest cycle the head's antenna has read a tag that is listed at ``place_mm`` (T2, T5, P7, T12).

    From it on lies a curve, a turnout, both or neither.
    """
    if not a_cycle_begins_when_the_one_before_was_sensed(system):
        return system
    if not a_tag_lies_where_it_is_listed(site, place_mm, uid):
        return system
    if not a_tag_is_read_in_the_read_window(site, uid, read_at_nm):
        return system
    if not the_rest_of_the_cycle_follows_the_speed(system, read_at_nm):
        return system
    if not a_kind_hides_no_restriction(in_curve, at_turnout, kind):
        return system
    if place_mm == system.awaited_mm:
        expecting = tag_window.read_a_tag(
            stretch(site),
            system.expecting,
            way_nm(system, read_at_nm),
            computer.way_to(system.computer, computer.place_of_read(system.computer)),
            way_nm(system, NM_A_MM * (uid + site.limits.tags.antenna_mm)),
        )
    else:
        expecting = system.expecting
    told = computer.read_by_head(site.limits, system.computer, uid, place_mm, kind)
    counts = computer.reads_in_window(site.limits, system.computer, place_mm)
    passing = _past_a_tag(site, passage(system, read_at_nm), told, counts, kind, in_curve, at_turnout)
    seen = replace(system, expecting=expecting, passing=passing, computer=told)
    if not counts:
        return seen
    fix = computer.fix(site.limits, system.computer, place_mm)
    there = antenna_spacing.run(track(site), system.trailing, read_at_nm)
    return replace(
        seen,
        running=odometry.take_fix(line(site), running(system), fix.least_mm, fix.most_mm),
        trailing=antenna_spacing.head_reads(track(site), there, uid, computer.place_of_read(told)),
        formation=train_length.head_passes(
            railway(site), formation(system), read_at_nm, 0, computer.tag_passed(told, uid, computer.BY_HEAD_MS)
        ),
    )


def _past_a_tag(
    site: Train, there: Passage, told: Computer, counts: bool, kind: int, in_curve: bool, at_turnout: bool
) -> Passage:
    """The front was at a tag, with other track from it on; the computer knows where that was, if the read counts."""
    at = computer.place_of_read(told)
    return speed_limit.pass_tag(
        profile(site),
        there,
        in_curve,
        at_turnout,
        kind,
        at.known and counts,
        at.least_mm - site.limits.train.length_mm,
        at.most_mm,
        told.known.motion.speed_most_mm_s,
    )


def read_unlisted(site: Train, system: Whole, read_at_nm: int, in_curve: bool, at_turnout: bool) -> Whole:
    """In the newest cycle the head's antenna has read a tag of no list, whatever it says (T5, T12)."""
    if not a_cycle_begins_when_the_one_before_was_sensed(system):
        return system
    return replace(
        system,
        passing=speed_limit.pass_tag(
            profile(site), passage(system, read_at_nm), in_curve, at_turnout, UNASSIGNED, False, 0, 0, 0
        ),
        computer=computer.read_unlisted(system.computer),
    )


def read_by_the_tail(site: Train, system: Whole, uid: int, read_at_nm: int) -> Whole:
    """In the newest cycle the antenna that speaks for the tail has read a tag (T2, T13)."""
    if not a_cycle_begins_when_the_one_before_was_sensed(system):
        return system
    if not the_tails_antenna_reads_in_its_window(site, system, uid, read_at_nm):
        return system
    if not the_rest_of_the_cycle_follows_the_speed(system, read_at_nm):
        return system
    there = antenna_spacing.run(track(site), system.trailing, read_at_nm)
    told = computer.read_by_tail(site.limits, system.computer, uid)
    read = replace(
        system,
        trailing=antenna_spacing.tail_reads(track(site), there, uid, computer.place_of_read(system.computer)),
        computer=told,
    )
    if not is_healthy(told.spacing):
        return read
    passed = computer.tag_passed(system.computer, uid, computer.BY_TAIL_MS)
    off_nm = read_at_nm - system.formation.front_nm - system.trailing.apart_nm
    seen_off_nm = off_nm if train_length.ends_pass_one_point(formation(system), passed) else 0
    return replace(
        read,
        formation=train_length.tail_passes(
            railway(site), formation(system), read_at_nm, 0, 0, 0, 0, seen_off_nm, passed
        ),
    )


def come_apart(site: Train, system: Whole, apart_nm: int) -> Whole:
    """From now on another antenna speaks for the tail, or the same one elsewhere (T3, P5)."""
    return replace(
        system,
        trailing=antenna_spacing.come_apart(track(site), system.trailing, apart_nm),
        formation=train_length.change_formation_untold(railway(site), formation(system), length_nm(site, apart_nm)),
    )


def take_end(site: Train, system: Whole, end_mm: int) -> Whole:
    """The orders give any end of authority at all; while no range is claimed none is taken (T4, T9)."""
    if not a_cycle_begins_when_the_one_before_was_sensed(system):
        return system
    at = system.computer.known.motion
    if not is_located(at):
        return withhold_end(site, system)
    brake = brake_control.take_end(
        site.limits.train.brake, system.computer.brake, at.front_most_mm, at.speed_most_mm_s, end_mm
    )
    return replace(
        system,
        approach=braking.take_end(
            braked(site), approach(system), at.front_most_mm, at.speed_least_mm_s, at.speed_most_mm_s, end_mm
        ),
        asked=system.computer.brake,
        held=system.held and brake.withheld,
        computer=replace(system.computer, brake=brake),
    )


def withhold_end(site: Train, system: Whole) -> Whole:
    """The orders give no end of authority, or the driver puts the brake on, at any moment (T4, T9)."""
    return replace(
        system,
        approach=braking.withhold_end(braked(site), approach(system)),
        asked=system.computer.brake,
        computer=computer.withhold_end(system.computer),
    )


def locate_anew(site: Train, system: Whole, least_mm: int, most_mm: int) -> Whole:
    """At rest somebody says where the front is, and the computer begins anew (P7, T8)."""
    if not a_cycle_begins_when_the_one_before_was_sensed(system):
        return system
    if not the_train_stands_where_it_is_said_to(system, least_mm, most_mm):
        return system
    located = computer.locate(site.limits, system.computer, least_mm, most_mm)
    if located == system.computer:
        return system
    turned = antenna_spacing.turn(track(site), system.trailing, system.front_nm)
    length = train_length.change_kilometrage(railway(site), formation(system))
    return _at_rest(site, replace(system, trailing=turned, formation=length, computer=located), least_mm, most_mm)


def note_place(site: Train, system: Whole, least_mm: int, most_mm: int) -> Whole:
    """Somebody says between which places the front is, late it may be, and the computer goes on (P7, T8)."""
    if not a_cycle_begins_when_the_one_before_was_sensed(system):
        return system
    if not who_says_where_a_held_train_is_sees_it_stand(site, system, least_mm, most_mm):
        return system
    said = computer.note_place(site.limits, system.computer, least_mm, most_mm)
    if said == system.computer:
        return system
    return replace(
        system,
        running=odometry.take_fix(line(site), running(system), least_mm, most_mm),
        computer=said,
    )


def put_into_service(site: Train, system: Whole, least_mm: int, most_mm: int) -> Whole:
    """At rest the computer begins, or begins again: the train is inspected, and somebody says where it is (P7, T8)."""
    if not a_cycle_begins_when_the_one_before_was_sensed(system):
        return system
    if not a_train_whose_computer_is_off_is_held(site, system):
        return system
    if not the_train_stands_where_it_is_said_to(system, least_mm, most_mm):
        return system
    if not who_finds_the_train_whole_finds_its_antennas_as_preset(site, system):
        return system
    begun = computer.put_into_service(site.limits, least_mm, most_mm)
    inspected = replace(
        system,
        watched=replace(system.watched, kept=True, too_fast=False),
        trailing=_preset(site, system),
        formation=_made_up(site, system),
        computer=begun,
    )
    return _at_rest(site, inspected, least_mm, most_mm)


def _at_rest(site: Train, system: Whole, least_mm: int, most_mm: int) -> Whole:
    """Each world begins anew with its computer: the train stands, held, with its front in this range."""
    return replace(
        system,
        running=odometry.locate_anew(
            line(site), running(system), least_mm, most_mm, system.computer.known.motion.way_mm
        ),
        approach=replace(
            approach(system),
            response_cycles=0,
            worst_um_s=0,
            reach_nm=system.front_nm,
            left_nm=0,
            demanded=False,
            wanted=False,
            slowing=slowing.at_rest(braked(site).bounds, system.front_nm, system.computer.brake.end_mm),
        ),
        watched=replace(watched(system), allowed_mm_s=0),
        asked=system.computer.brake,
        held=True,
        expecting=tag_window.expect_none(stretch(site), system.expecting),
        passing=speed_limit.locate_anew(profile(site), passage(system, system.front_nm)),
    )


def await_tag(
    site: Train, system: Whole, place_mm: int, kind: int, uid: int, in_curve: bool, at_turnout: bool
) -> Whole:
    """The orders say which tag comes next, where it is listed, and what lies from it on (T5, T12)."""
    if not a_cycle_begins_when_the_one_before_was_sensed(system):
        return system
    if not a_tag_lies_where_it_is_listed(site, place_mm, uid):
        return system
    if not a_kind_hides_no_restriction(in_curve, at_turnout, kind):
        return system
    told = computer.await_tag(site.limits, system.computer, place_mm, kind)
    window = told.known.window
    awaiting = replace(system, awaited_mm=place_mm, computer=told)
    return replace(
        awaiting,
        expecting=tag_window.expect_a_tag(
            stretch(site), system.expecting, way_nm(awaiting, system.front_nm), window.least_mm, window.most_mm
        ),
        approach=_listed(
            site, braking.list_none(braked(site), approach(system)), place_mm, kind, uid, in_curve, at_turnout
        ),
    )


def note_listed(
    site: Train, system: Whole, place_mm: int, kind: int, uid: int, in_curve: bool, at_turnout: bool
) -> Whole:
    """The list has a further tag ahead, and what lies from it on (T1, T12)."""
    if not a_cycle_begins_when_the_one_before_was_sensed(system):
        return system
    if not a_tag_lies_where_it_is_listed(site, place_mm, uid):
        return system
    if not a_kind_hides_no_restriction(in_curve, at_turnout, kind):
        return system
    return replace(
        system,
        computer=computer.note_listed(site.limits, system.computer, place_mm, kind),
        approach=_listed(site, approach(system), place_mm, kind, uid, in_curve, at_turnout),
    )


def _listed(
    site: Train, there: Approach, place_mm: int, kind: int, uid: int, in_curve: bool, at_turnout: bool
) -> Approach:
    """The head reads it no earlier than at the near end of its read window (T2)."""
    from_mm, read_from_mm = computer.read_from_mm(site.limits, place_mm), uid - site.read_within_mm
    read_from_nm = NM_A_MM * (read_from_mm + site.limits.tags.antenna_mm)
    return braking.list_tag(braked(site), there, in_curve, at_turnout, kind, from_mm, read_from_nm)


def await_none(site: Train, system: Whole) -> Whole:
    """No order says which tag comes next (T5)."""
    if not a_cycle_begins_when_the_one_before_was_sensed(system):
        return system
    return replace(
        system,
        expecting=tag_window.expect_none(stretch(site), system.expecting),
        approach=braking.list_none(braked(site), approach(system)),
        computer=computer.await_none(system.computer),
    )


def find_whole(site: Train, system: Whole) -> Whole:
    """The staff has found the train whole, and its antennas as far apart as is written (P5, T3)."""
    if not a_cycle_begins_when_the_one_before_was_sensed(system):
        return system
    if not who_finds_the_train_whole_finds_its_antennas_as_preset(site, system):
        return system
    return replace(
        system,
        trailing=_preset(site, system),
        formation=_made_up(site, system),
        computer=computer.made_up(site.limits, system.computer),
    )


def _preset(site: Train, system: Whole) -> Trailing:
    """The antennas are preset where the train is."""
    there = antenna_spacing.turn(track(site), system.trailing, system.front_nm)
    return antenna_spacing.preset(track(site), there, site.limits.antennas_mm)


def _made_up(site: Train, system: Whole) -> Formation:
    """The train is as long as it is, and its unit begins to measure it anew."""
    there = formation(system)
    return train_length.change_formation(railway(site), there, length_nm(site, system.trailing.apart_nm))
