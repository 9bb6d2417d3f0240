"""One train as each world sees it, and what is assumed of nature: of odometry, brake, brake watch, tags and track (P7).

The worlds of odometry, brake control and brake watch see this train each in its own way; here there is one
front, one speed and one computer.  What they assume of each other's machines is not assumed here.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

from kernel.onboard.braking import Brake
from kernel.onboard.computer import Computer
from kernel.onboard.limits import Limits
from kernel.onboard.odometry import Readings
from kernel.onboard.tag_reader import Frame
from models.onboard import (
    antenna_spacing,
    brake_watch,
    braking,
    odometry,
    speed_limit,
    tag_fix,
    tag_reader,
    tag_window,
    train_length,
)
from models.onboard.antenna_above import Above
from models.onboard.antenna_spacing import Track, Trailing
from models.onboard.brake_watch import Watched
from models.onboard.braking import Approach
from models.onboard.ceiling import Keeping
from models.onboard.odometry import Line, Running
from models.onboard.speed_limit import Passage, Profile
from models.onboard.tag_fix import Antenna
from models.onboard.tag_window import Expecting, Stretch
from models.onboard.train_length import Formation, Railway
from models.onboard.units import LONGEST_MS, NM_A_MM, UM_A_MM, larger, smaller


@dataclass(frozen=True)
class Train:
    """What does not change.

    ``limits``: as written, and as the computer reckons with.
    ``jolt_mm_s2``, ``pace_cycles``, ``length_mm``: of wheel and train, as in :class:`models.onboard.odometry.Line`.
    ``laid_within_mm``, ``read_within_mm``: of tags, as in :class:`models.onboard.tag_fix.Antenna`.
    ``tag``, ``preset_within_mm``: as in :class:`models.onboard.antenna_spacing.Track`.
    """

    limits: Limits
    jolt_mm_s2: int
    pace_cycles: int
    length_mm: int
    laid_within_mm: int
    read_within_mm: int
    tag: int
    preset_within_mm: int


@dataclass(frozen=True)
class Whole:
    """One moment.

    ``front_nm``, ``speed_um_s``: where the front is, and how fast; ``from_nm``, ``from_um_s``: when the cycle began.
    ``in_curve``, ``at_turnout``: what the track is from the last tag on that the front has passed, read or not.
    ``runs``: the train has run for a cycle that its computer has yet to sense.
    ``running``, ``approach``, ``watched``, ``expecting``, ``trailing``, ``passing``, ``formation``: the train as
    odometry, brake control, brake watch, the window for the next tag, the antennas' spacing, the speed limit and the
    train's length are proved with it.
    ``awaited_mm``: history: where the list has the tag that its computer was told to await last.
    ``astern``: history: in the newest cycle the tail of a whole train, which ran at no more than twice the speed of its
    line, came over the tag that was awaited then, and which was not overdue.
    ``asked``: history: the brake when it was asked for an end last; ``held``: no end has freed it since it was
    located, or came to rest withheld.
    ``proceeds``: history: the orders let it proceed when its computer decided last.
    ``permitted``: history: the train as it keeps to what all of its track let it run when its brake was off last.
    ``head``, ``tail``: the antennas of head and tail, as the tag reader is proved with each.
    ``computer``: what its computer remembers.
    """

    front_nm: int
    speed_um_s: int
    from_nm: int
    from_um_s: int
    in_curve: bool
    at_turnout: bool
    runs: bool
    running: Running
    approach: Approach
    watched: Watched
    expecting: Expecting
    trailing: Trailing
    passing: Passage
    formation: Formation
    awaited_mm: int
    astern: bool
    asked: Brake
    held: bool
    proceeds: bool
    permitted: Keeping
    head: Above
    tail: Above
    computer: Computer


# ---- how each world sees the train


def line(site: Train) -> Line:
    """Give the site of the odometry's world."""
    return Line(
        bounds=site.limits.sensors,
        jolt_mm_s2=site.jolt_mm_s2,
        pace_cycles=site.pace_cycles,
        length_mm=site.length_mm,
        length_used_mm=site.limits.train.length_mm,
    )


def braked(site: Train) -> braking.Vehicle:
    """Give the site of the brake control's world."""
    return braking.Vehicle(bounds=site.limits.train.brake, table=site.limits.train.speeds)


def watched_over(site: Train) -> brake_watch.Vehicle:
    """Give the site of the brake watch's world."""
    return brake_watch.Vehicle(bounds=site.limits.train.brake)


def antenna(site: Train) -> Antenna:
    """Give the site of the world of tags."""
    return Antenna(limits=site.limits.tags, laid_within_mm=site.laid_within_mm, read_within_mm=site.read_within_mm)


def receiver(site: Train) -> tag_reader.Antenna:
    """Give the site of the tag reader's world, which is the same for both antennas."""
    return tag_reader.Antenna(limits=site.limits.reader)


def stretch(site: Train) -> Stretch:
    """Give the site of the world of the window: the way to a tag is counted from a place, so one tag's error counts."""
    return Stretch(limits=site.limits.window, laying_mm=site.laid_within_mm, read_mm=site.read_within_mm)


def track(site: Train) -> Track:
    """Give the site of the world of the two antennas."""
    return Track(
        limits=site.limits.spacing,
        tag=site.tag,
        antenna_mm=site.limits.tags.antenna_mm,
        read_within_mm=site.read_within_mm,
        preset_error_mm=site.preset_within_mm,
    )


def profile(site: Train) -> Profile:
    """Give the site of the world of the speed limit."""
    return Profile(table=site.limits.train.speeds, length_mm=site.length_mm)


def railway(site: Train) -> Railway:
    """Give the site of the world of the train's length: the line, for it, allows the length that is written of it."""
    return Railway(bounds=site.limits.length)


def length_nm(site: Train, apart_nm: int) -> int:
    """Give how long the train is to its unit, whose antennas are so far apart: with both overhangs (T3, P4)."""
    return apart_nm + NM_A_MM * (site.limits.length.front_overhang_mm + site.limits.length.rear_overhang_mm)


def running(system: Whole) -> Running:
    """Give the train as the odometry's world saw it before the newest cycle, or sees it after (P7)."""
    return replace(before(system), motion=system.computer.known.motion)


def before(system: Whole) -> Running:
    """Give how it ran then, whatever its computer says."""
    return replace(
        system.running,
        front_nm=system.from_nm if system.runs else system.front_nm,
        speed_um_s=system.from_um_s if system.runs else system.speed_um_s,
    )


def approach(system: Whole) -> Approach:
    """Give it as the brake control's world sees it; the ceiling there is what was promised last (X2, T12)."""
    seen = replace(system.approach.slowing, ahead=system.computer.known.ahead)
    return replace(coming(system), brake=system.computer.brake, slowing=seen)


def coming(system: Whole) -> Approach:
    """Give how it comes to its end of authority, whatever its computer does."""
    return replace(system.approach, head_nm=system.front_nm, speed_um_s=system.speed_um_s)


def watched(system: Whole) -> Watched:
    """Give it as the brake watch's world saw it before the newest cycle, or sees it after (T12)."""
    return replace(
        system.watched,
        speed_um_s=system.from_um_s if system.runs else system.speed_um_s,
        watch=system.computer.known.watch,
    )


def passage(system: Whole, front_nm: int) -> Passage:
    """Give it as the world of the speed limit sees it with its front there (T12)."""
    return replace(system.passing, front_nm=front_nm, speed_um_s=system.speed_um_s, limit=system.computer.known.limit)


def formation(system: Whole) -> Formation:
    """Give it as the world of the train's length sees it (P4)."""
    return replace(system.formation, state=system.computer.length)


def way_nm(system: Whole, front_nm: int) -> int:
    """Give how far the front is from where the way to the awaited tag is counted (T5)."""
    return front_nm - NM_A_MM * system.computer.from_mm


def fastest_cycle_nm(site: Train) -> int:
    """Give how far a train runs within the longest cycle at twice the speed of its line (T12)."""
    return 2 * LONGEST_MS * UM_A_MM * site.limits.train.speeds.line_mm_s


def tail_comes_over(site: Train, system: Whole) -> bool:
    """Tell whether the tail of a whole train may read the awaited tag in the newest cycle, at a lawful speed (T2)."""
    off_nm = NM_A_MM * (site.laid_within_mm + site.read_within_mm)
    tail_nm = system.front_nm - NM_A_MM * site.limits.tags.antenna_mm - system.trailing.apart_nm
    return (
        system.trailing.whole
        and tail_nm >= NM_A_MM * system.awaited_mm - off_nm
        and system.front_nm - system.from_nm <= fastest_cycle_nm(site)
    )


# ---- premises


def the_odometrys_bounds_fit(site: Train) -> bool:
    """What the odometry's proof asks of the written bounds (P1, P4)."""
    return (
        odometry.bounds_are_not_negative(line(site))
        and odometry.a_jolt_stands_out(line(site))
        and odometry.agreement_takes_longer_than_a_chance_pace(line(site))
        and odometry.the_length_used_is_no_less(line(site))
    )


def the_brakes_bounds_fit(site: Train) -> bool:
    """What the proofs of brake control and brake watch ask of the written bounds (T12)."""
    return (
        braking.the_brake_slows(braked(site))
        and braking.the_motors_are_cut_off_before_it_does(braked(site))
        and brake_watch.motors_do_not_slow(watched_over(site))
    )


def the_tags_bounds_fit(site: Train) -> bool:
    """What the proof of the tag's fix asks of the written bounds (T2)."""
    return tag_fix.the_error_covers_laying_and_read_window(antenna(site))


def the_windows_bounds_fit(site: Train) -> bool:
    """What the proof of the window asks of the written bounds (T5)."""
    return tag_window.nothing_is_negative(stretch(site)) and tag_window.the_tolerance_covers_laying_and_read_window(
        stretch(site)
    )


def the_spacings_bounds_fit(site: Train) -> bool:
    """What the proof of the antennas' spacing asks of the written bounds (T3)."""
    return antenna_spacing.the_tolerance_covers_preset_and_read_window(track(site))


def the_lengths_bounds_fit(site: Train) -> bool:
    """What the proof of the train's length asks of the written bounds, and of what reads tags (P4, T3)."""
    bounds = site.limits.length
    return (
        train_length.bounds_are_not_negative(railway(site))
        and train_length.vehicles_are_of_this_world(railway(site))
        and bounds.window_mm >= 2 * site.read_within_mm
        and bounds.front_overhang_mm == site.limits.tags.antenna_mm
        and bounds.rear_overhang_mm == bounds.front_overhang_mm
    )


def one_length_is_written_and_it_covers_the_antennas(site: Train) -> bool:
    """Antennas as far apart as written, overhangs and the error of presetting make no longer train (P4, T3)."""
    most_nm = length_nm(site, NM_A_MM * (site.limits.antennas_mm + site.preset_within_mm))
    return (
        most_nm <= NM_A_MM * site.limits.train.length_mm
        and site.limits.length.line_maximum_mm == site.limits.train.length_mm
    )


def the_antennas_lie_farther_apart_than_the_window_is_long(site: Train) -> bool:
    """A missed tag is found within less than the way between the antennas, even in a cycle at twice the speed (T2)."""
    found_mm = site.limits.window.tolerance_mm + site.limits.window.tail_width_mm
    errors_mm = site.laid_within_mm + site.read_within_mm + site.preset_within_mm
    return NM_A_MM * (found_mm + errors_mm) + fastest_cycle_nm(site) < NM_A_MM * site.limits.antennas_mm


# ---- assumptions


def a_cycle_begins_when_the_one_before_was_sensed(system: Whole) -> bool:
    """The computer's one task decides, lets the train run, and senses; what it is told comes in between (P7)."""
    return not system.runs


def a_cycle_is_sensed_once(system: Whole) -> bool:
    """And it senses what was run, once (P7)."""
    return system.runs


def the_head_is_no_faster_than_at_the_ends_of_a_cycle(system: Whole, to_nm: int, speed_um_s: int) -> bool:
    """In no cycle, whatever its clock says, the head gets farther than 102 ms at the greater of those speeds (P1)."""
    return braking.the_way_follows_the_speed(coming(system), to_nm, speed_um_s)


def the_train_gains_no_more(site: Train, system: Whole, speed_um_s: int) -> bool:
    """In a cycle it gains no more speed than the brake control reckons with (T12)."""
    return braking.the_train_gains_no_more(braked(site), coming(system), speed_um_s)


def a_brake_that_has_responded_keeps_its_bound(site: Train, system: Whole, applied: bool, speed_um_s: int) -> bool:
    """A brake that has been commanded for as long as it takes to respond slows the train as is guaranteed (T12)."""
    return (
        not applied
        or system.watched.cycles < site.limits.train.brake.response_cycles
        or braking.the_brake_keeps_its_bound(braked(site), coming(system), speed_um_s)
    )


def motors_that_are_cut_off_give_nothing(site: Train, system: Whole, applied: bool, speed_um_s: int) -> bool:
    """Once the brake has been commanded for long enough to cut motors off, a train gains on a descent alone (T12)."""
    return (
        not applied
        or system.watched.cycles < site.limits.train.brake.cut_cycles
        or braking.motors_that_are_cut_off_give_nothing(braked(site), coming(system), speed_um_s)
    )


def the_way_follows_the_speed(system: Whole, readings: Readings) -> bool:
    """Within one cycle the train runs at speeds between those at its ends; in one of another length anywhere (P1)."""
    return odometry.the_way_follows_the_speed(before(system), readings, system.front_nm, system.speed_um_s)


def the_train_stays_within_its_powers(site: Train, system: Whole, readings: Readings) -> bool:
    """In a cycle it gains and loses no more speed than motors, brakes and the steepest gradient allow (P1)."""
    return odometry.the_train_stays_within_its_powers(line(site), before(system), readings, system.speed_um_s)


def the_inertial_sensor_keeps_its_bound(site: Train, system: Whole, readings: Readings, gradient_mm_s2: int) -> bool:
    """A valid reading is acceleration and gravity along the track, within the error; the line is no steeper (P1)."""
    return odometry.the_inertial_sensor_keeps_its_bound(
        line(site), before(system), readings, system.speed_um_s, gradient_mm_s2
    )


def a_tachometer_sticks_at_a_speed(site: Train, system: Whole, readings: Readings, sticks: bool) -> bool:
    """One that fails and calls itself valid repeats speed and pulses of the cycle before; none fails that slow (P1)."""
    return odometry.a_tachometer_sticks_at_a_speed(line(site), before(system), readings, sticks)


def a_rolling_wheel_measures(site: Train, system: Whole, readings: Readings, slips: bool, sticks: bool) -> bool:
    """Of a wheel that rolls, valid readings show speed and way within creep, diameter and a pulse (P1)."""
    told = odometry.is_told(before(system), readings, sticks)
    return odometry.a_rolling_wheel_measures(
        line(site), before(system), readings, system.front_nm, system.speed_um_s, told and not slips
    )


def leaving_the_creep_takes_a_jolt(site: Train, system: Whole, readings: Readings, slips: bool, sticks: bool) -> bool:
    """A wheel that begins to slip or slide changes its speed otherwise than the train, by the jolt at least (P1)."""
    told = odometry.is_told(before(system), readings, sticks)
    return odometry.leaving_the_creep_takes_a_jolt(line(site), before(system), readings, system.speed_um_s, slips, told)


def a_wheel_that_keeps_pace_rolls(site: Train, system: Whole, readings: Readings, slips: bool, sticks: bool) -> bool:
    """A wheel that has kept pace with its train for the written number of cycles on end does not slip (P1)."""
    told = odometry.is_told(before(system), readings, sticks)
    paced_cycles = odometry.paced_cycles_after(line(site), before(system), readings, system.speed_um_s, told)
    return odometry.a_wheel_that_keeps_pace_rolls(line(site), paced_cycles, slips)


def a_tag_lies_where_it_is_listed(site: Train, place_mm: int, uid: int) -> bool:
    """A tag, numbered by where it lies, is laid within the error of the place that the list has for it (T1)."""
    return tag_fix.a_tag_lies_where_it_is_listed(antenna(site), place_mm, NM_A_MM * uid)


def a_tag_is_below_within_the_read_window(site: Train, below: Frame, at_nm: int) -> bool:
    """An antenna is over a tag while it is no farther from it than its read window reaches (T2, T16).

    ``below``: the record of the tag below, numbered by where it lies; not valid where none is.
    """
    return not below.valid or tag_fix.a_tag_is_read_in_the_read_window(antenna(site), NM_A_MM * below.uid, at_nm)


def a_kind_hides_no_restriction(in_curve: bool, at_turnout: bool, kind: int) -> bool:
    """Whoever writes a tag writes what lies from it on: a curve, a turnout, or that either may (T1, T12)."""
    return speed_limit.a_kind_hides_no_restriction(in_curve, at_turnout, kind)


def what_lies_from_a_missed_tag_is_listed(system: Whole, in_curve: bool, at_turnout: bool) -> bool:
    """Lists tell of all curves and turnouts up to the end: of one whose tag is not read, too (T1, T5)."""
    listed = system.approach.slowing
    return (not in_curve or system.in_curve or listed.curve_nm <= system.front_nm) and (
        not at_turnout or system.at_turnout or listed.turnout_nm <= system.front_nm
    )


def a_tag_is_below_the_tail_within_its_window(site: Train, system: Whole, below: Frame, at_nm: int) -> bool:
    """So is the antenna that speaks for the tail, as far behind the head's as it is (T2, T16)."""
    seen = replace(system.trailing, front_nm=at_nm)
    return not below.valid or antenna_spacing.a_tag_is_read_in_the_read_window(
        track(site), antenna_spacing.tail_nm(track(site), seen), below.uid
    )


def what_the_tail_has_read_is_taken_at_once(system: Whole) -> bool:
    """The computer's one task takes what the tail's reader delivers before the train can come apart (T2, T13)."""
    return not system.tail.due


def who_finds_a_held_train_whole_finds_its_antennas_as_preset(site: Train, system: Whole) -> bool:
    """Staff looks at every car of a train that stands held, and measures from one antenna to the other (T3, P5)."""
    return not is_held_at_rest(site, system) or (
        antenna_spacing.the_preset_is_near(track(site), system.trailing, site.limits.antennas_mm)
        and antenna_spacing.the_antennas_lie_apart(track(site), system.trailing.apart_nm)
    )


def the_rest_of_the_cycle_follows_the_speed(system: Whole, read_at_nm: int) -> bool:
    """From where it was in a frame time the train runs on in the newest cycle no farther than its speeds allow (P1)."""
    return tag_fix.the_way_follows_the_speed(read_at_nm, system.front_nm, system.from_um_s, system.speed_um_s)


def a_recognised_feature_is_where_it_is_registered(system: Whole, least_mm: int, most_mm: int) -> bool:
    """A feature's fix contains the front (P3)."""
    return NM_A_MM * least_mm <= system.front_nm <= NM_A_MM * most_mm


def the_train_stands_where_it_is_said_to(system: Whole, least_mm: int, most_mm: int) -> bool:
    """Who locates a train anew sees it stand, and its front between the places that he names, in any order (P7, T8)."""
    from_mm, to_mm = smaller(least_mm, most_mm), larger(least_mm, most_mm)
    return odometry.the_train_stands_where_it_is_said_to(before(system), from_mm, to_mm)


def who_locates_a_train_sees_it_stand(site: Train, system: Whole, least_mm: int, most_mm: int) -> bool:
    """Who locates a train anew sees it stand, if it is slow or its brake weak; else he may err (P7, T8)."""
    is_fast = system.speed_um_s > UM_A_MM * site.limits.train.brake.standstill_mm_s
    return (is_fast and system.watched.kept) or the_train_stands_where_it_is_said_to(system, least_mm, most_mm)


def who_says_where_a_held_train_is_sees_it_stand(site: Train, system: Whole, least_mm: int, most_mm: int) -> bool:
    """Who says where the front of a held train is sees it stand there; else he may say what was so (P7, T8)."""
    return not is_held_at_rest(site, system) or the_train_stands_where_it_is_said_to(system, least_mm, most_mm)


def is_held_at_rest(site: Train, system: Whole) -> bool:
    """It is as slow as a standstill is, and its brake has been on for as long as it takes to respond (T8, T12)."""
    brake = site.limits.train.brake
    return system.watched.cycles >= brake.response_cycles and (
        -UM_A_MM * brake.standstill_mm_s <= system.speed_um_s <= UM_A_MM * brake.standstill_mm_s
    )


def a_train_whose_computer_is_off_is_held(site: Train, system: Whole) -> bool:
    """Without its computer the brake is on, and has been for as long as it takes to respond when that begins (T12)."""
    return system.watched.cycles >= site.limits.train.brake.response_cycles
