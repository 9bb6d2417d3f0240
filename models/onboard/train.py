"""One train from its sensors to its brake: what happens to it, and all that its computer makes of that (P7, T12).

Each world takes its own step, as it is proved there: had it refused one, its train would have stayed behind.
"""

from __future__ import annotations

from dataclasses import replace

from kernel.onboard import brake_demand, computer
from kernel.onboard import braking as brake_control
from kernel.onboard.ceiling import Ceiling
from kernel.onboard.computer import Computer
from kernel.onboard.odometry import Readings, is_located, rear_least_mm
from kernel.onboard.split import Readings as TailReadings
from kernel.standstill import is_held, moves
from models.onboard import (
    antenna_above,
    antenna_spacing,
    brake_watch,
    braking,
    odometry,
    slowing,
    speed_limit,
    tag_window,
    train_length,
)
from models.onboard import ceiling as ceilings
from models.onboard.antenna_spacing import Trailing
from models.onboard.ceiling import AT_REST as KEEPING_AT_REST
from models.onboard.ceiling import Keeping
from models.onboard.train_length import Formation
from models.onboard.train_nature import (
    Train,
    Whole,
    a_brake_that_has_responded_keeps_its_bound,
    a_cycle_begins_when_the_one_before_was_sensed,
    a_cycle_is_sensed_once,
    a_recognised_feature_is_where_it_is_registered,
    a_rolling_wheel_measures,
    a_tachometer_sticks_at_a_speed,
    a_train_whose_computer_is_off_is_held,
    a_wheel_that_keeps_pace_rolls,
    approach,
    braked,
    formation,
    leaving_the_creep_takes_a_jolt,
    length_nm,
    line,
    motors_that_are_cut_off_give_nothing,
    passage,
    profile,
    railway,
    receiver,
    running,
    stretch,
    tail_comes_over,
    the_head_is_no_faster_than_at_the_ends_of_a_cycle,
    the_inertial_sensor_keeps_its_bound,
    the_train_gains_no_more,
    the_train_stands_where_it_is_said_to,
    the_train_stays_within_its_powers,
    the_way_follows_the_speed,
    track,
    watched,
    watched_over,
    way_nm,
    what_the_tail_has_read_is_taken_at_once,
    who_finds_a_held_train_whole_finds_its_antennas_as_preset,
    who_locates_a_train_sees_it_stand,
    who_says_where_a_held_train_is_sees_it_stand,
)
from models.onboard.train_tags import come_to_listed
from models.onboard.units import larger, smaller


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
    if not motors_that_are_cut_off_give_nothing(site, system, decided.brake.applied, speed_um_s):
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
        proceeds=may_proceed,
        permitted=_permitted(site, system, decided),
        head=antenna_above.begin_a_cycle(receiver(site), system.head),
        tail=antenna_above.begin_a_cycle(receiver(site), system.tail),
        computer=decided,
    )


def _permitted(site: Train, system: Whole, decided: Computer) -> Keeping:
    """While its brake is off the train keeps to what its track permits now, and then to what that was (T12)."""
    if decided.brake.applied:
        return ceilings.held(system.permitted)
    now_mm_s = speed_limit.permitted_mm_s(profile(site), passage(system, system.front_nm))
    return ceilings.begun(site.limits.train.brake, now_mm_s)


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
        passing=come_to_listed(site, system.passing, sensed),
        computer=sensed,
    )


def come_apart(site: Train, system: Whole, apart_nm: int) -> Whole:
    """From now on another antenna speaks for the tail, or the same one elsewhere (T3, P5)."""
    if not what_the_tail_has_read_is_taken_at_once(system):
        return system
    return replace(
        system,
        tail=antenna_above.be_another(receiver(site), system.tail),
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


def keep_to(site: Train, system: Whole, ceiling: Ceiling) -> Whole:
    """The train is to keep to any ceiling of speed at all: what it means to promise, or may do once let go (X2)."""
    if not a_cycle_begins_when_the_one_before_was_sensed(system):
        return system
    at, held = system.computer.known.motion, system.computer.known.ceiling
    if ceiling.most_mm_s >= held.most_mm_s:
        coming = braking.be_let_go(braked(site), approach(system), ceiling)
    elif is_located(at):
        coming = braking.keep_to(
            braked(site), approach(system), at.front_most_mm, at.speed_least_mm_s, at.speed_most_mm_s, ceiling
        )
    else:
        coming = approach(system)
    return replace(system, approach=coming, computer=computer.keep_to(site.limits, system.computer, ceiling))


def withhold_end(site: Train, system: Whole) -> Whole:
    """The orders give no end of authority, or the driver puts the brake on, at any moment (T4, T9)."""
    return replace(
        system,
        approach=braking.withhold_end(braked(site), approach(system)),
        asked=system.computer.brake,
        computer=computer.withhold_end(system.computer),
    )


def locate_anew(site: Train, system: Whole, least_mm: int, most_mm: int) -> Whole:
    """Somebody says where the front of a train at rest is, or too soon, and the computer begins anew (P7, T8).

    Of a train whose computer knows that it moves anything may be said.
    """
    if not a_cycle_begins_when_the_one_before_was_sensed(system):
        return system
    is_known_to_move = moves(computer.at_rest(site.limits, system.computer))
    if not is_known_to_move and not who_locates_a_train_sees_it_stand(site, system, least_mm, most_mm):
        return system
    located = computer.locate(site.limits, system.computer, least_mm, most_mm)
    if located == system.computer:
        return system
    turned = antenna_spacing.turn(track(site), system.trailing, system.front_nm)
    anew = replace(
        system,
        trailing=turned,
        formation=train_length.change_kilometrage(railway(site), formation(system)),
        head=antenna_above.turn(receiver(site), system.head, system.tail),
        tail=antenna_above.turn(receiver(site), system.tail, system.head),
        computer=located,
    )
    return _at_rest(site, anew, smaller(least_mm, most_mm), larger(least_mm, most_mm))


def come_to_rest(site: Train, system: Whole) -> Whole:
    """A withheld brake has brought the train to rest: nothing but an end that is taken lets it go on (T8, T12)."""
    if not a_cycle_begins_when_the_one_before_was_sensed(system):
        return system
    brake, holds = system.computer.brake, system.watched.cycles >= site.limits.train.brake.response_cycles
    return replace(system, held=brake.withheld and brake.applied and holds and system.speed_um_s <= 0)


def note_place(site: Train, system: Whole, least_mm: int, most_mm: int) -> Whole:
    """Somebody says between which places the front is, late it may be, and the computer goes on (P7, T8)."""
    if not a_cycle_begins_when_the_one_before_was_sensed(system):
        return system
    if not who_says_where_a_held_train_is_sees_it_stand(site, system, least_mm, most_mm):
        return system
    said = computer.note_place(site.limits, system.computer, least_mm, most_mm)
    if said == system.computer:
        return system
    return _fixed(site, system, said, smaller(least_mm, most_mm), larger(least_mm, most_mm))


def recognise_a_feature(site: Train, system: Whole, least_mm: int, most_mm: int) -> Whole:
    """A feature of the track has been recognised: its fix says where the front is, carried on to now (P2, P3, P7)."""
    if not a_cycle_begins_when_the_one_before_was_sensed(system):
        return system
    if not a_recognised_feature_is_where_it_is_registered(system, least_mm, most_mm):
        return system
    return _fixed(site, system, computer.note_fix(system.computer, least_mm, most_mm), least_mm, most_mm)


def _fixed(site: Train, system: Whole, told: Computer, least_mm: int, most_mm: int) -> Whole:
    """The computer has taken a fix of the train where it is."""
    running_on = odometry.take_fix(line(site), running(system), least_mm, most_mm)
    return replace(system, running=running_on, computer=told)


def put_into_service(site: Train, system: Whole, least_mm: int, most_mm: int) -> Whole:
    """At rest the computer begins, or begins again, and somebody says where it is; nothing is inspected (P7, T8)."""
    if not a_cycle_begins_when_the_one_before_was_sensed(system):
        return system
    if not a_train_whose_computer_is_off_is_held(site, system):
        return system
    if not the_train_stands_where_it_is_said_to(system, least_mm, most_mm):
        return system
    begun = computer.put_into_service(site.limits, system.computer.known.ceiling, least_mm, most_mm)
    there = antenna_spacing.turn(track(site), system.trailing, system.front_nm)
    started = replace(
        system,
        watched=replace(brake_watch.restart(watched_over(site), watched(system)), cycles=system.watched.cycles),
        trailing=antenna_spacing.restart(track(site), there),
        formation=train_length.restart(railway(site), formation(system)),
        head=antenna_above.restart(receiver(site), system.head),
        tail=antenna_above.restart(receiver(site), system.tail),
        computer=begun,
    )
    return _at_rest(site, started, smaller(least_mm, most_mm), larger(least_mm, most_mm))


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
            keeping=KEEPING_AT_REST,
        ),
        watched=replace(watched(system), allowed_mm_s=0),
        asked=system.computer.brake,
        held=True,
        permitted=KEEPING_AT_REST,
        expecting=tag_window.expect_none(stretch(site), system.expecting),
        passing=come_to_listed(
            site, speed_limit.locate_anew(profile(site), passage(system, system.front_nm)), system.computer
        ),
    )


def inspect_the_brake(site: Train, system: Whole) -> Whole:
    """The staff finds motors and brake sound; of a train that is not held its word is not taken (T12)."""
    if not a_cycle_begins_when_the_one_before_was_sensed(system):
        return system
    told = replace(system, computer=computer.inspect_brake(site.limits, system.computer))
    at = computer.at_rest(site.limits, system.computer)
    if not is_held(at):
        return told
    sound = brake_watch.inspect(watched_over(site), watched(system), at.speed_least_mm_s, at.speed_most_mm_s)
    return replace(told, watched=sound)


def find_whole(site: Train, system: Whole) -> Whole:
    """The staff has found the train whole, its antennas as is written; of one not held it may err (P5, T3)."""
    if not a_cycle_begins_when_the_one_before_was_sensed(system):
        return system
    if not who_finds_a_held_train_whole_finds_its_antennas_as_preset(site, system):
        return system
    told = replace(system, computer=computer.made_up(site.limits, system.computer))
    if not is_held(computer.at_rest(site.limits, system.computer)):
        return told
    return replace(told, trailing=_preset(site, system), formation=_made_up(site, system))


def _preset(site: Train, system: Whole) -> Trailing:
    """The antennas are preset where the train is."""
    there = antenna_spacing.turn(track(site), system.trailing, system.front_nm)
    return antenna_spacing.preset(track(site), there, site.limits.antennas_mm)


def _made_up(site: Train, system: Whole) -> Formation:
    """The train is as long as it is, and its unit begins to measure it anew."""
    there = formation(system)
    return train_length.change_formation(railway(site), there, length_nm(site, system.trailing.apart_nm))
