"""One train and its tags: what its antennas read, what is missed, and what the orders list (T1, T2, T5, T12).

Each world takes its own step, as it is proved there: had it refused one, its train would have stayed behind.
A host may ask for a record at any time.  What was delivered was read below the antenna, whatever the computer makes of
it; where nothing was, the computer alone has its say.
"""

from __future__ import annotations

from dataclasses import replace

from kernel.onboard import computer, restriction_ahead, tag_reader
from kernel.onboard.antenna_spacing import is_healthy
from kernel.onboard.computer import Computer
from models.onboard import antenna_above, antenna_spacing, braking, odometry, speed_limit, tag_window, train_length
from models.onboard.braking import Approach
from models.onboard.speed_limit import Passage
from models.onboard.train_nature import (
    Train,
    Whole,
    a_cycle_begins_when_the_one_before_was_sensed,
    a_kind_hides_no_restriction,
    a_tag_lies_where_it_is_listed,
    approach,
    braked,
    formation,
    line,
    passage,
    profile,
    railway,
    receiver,
    running,
    stretch,
    track,
    way_nm,
    what_lies_from_a_missed_tag_is_listed,
)
from models.onboard.units import NM_A_MM

UNASSIGNED = 0
"""The kind of a tag whose record is not looked at."""


def read_a_tag(site: Train, system: Whole, place_mm: int, in_curve: bool, at_turnout: bool) -> Whole:
    """The head's reader has delivered the record of a tag that is listed at ``place_mm`` (T2, T5, P7, T12).

    From that tag on lies a curve, a turnout, both or neither.
    """
    tag, read_at_nm = system.head.lay_below, system.head.read_at_nm
    if not a_cycle_begins_when_the_one_before_was_sensed(system):
        return system
    if not a_tag_lies_where_it_is_listed(site, place_mm, tag.uid):
        return system
    if not a_kind_hides_no_restriction(in_curve, at_turnout, tag.kind):
        return system
    told = computer.read_by_head(site.limits, system.computer, place_mm)
    if not tag_reader.delivers(system.computer.head):
        return replace(system, computer=told)
    if place_mm == system.awaited_mm:
        expecting = tag_window.read_a_tag(
            stretch(site),
            system.expecting,
            way_nm(system, read_at_nm),
            computer.way_to(system.computer, computer.place_of_read(system.computer)),
            way_nm(system, NM_A_MM * (tag.uid + site.limits.tags.antenna_mm)),
        )
    else:
        expecting = system.expecting
    counts = computer.reads_in_window(site.limits, system.computer, place_mm)
    there = _past_a_tag(site, passage(system, read_at_nm), told, counts, tag.kind, in_curve, at_turnout)
    seen = replace(
        system,
        in_curve=in_curve,
        at_turnout=at_turnout,
        expecting=expecting,
        passing=come_to_listed(site, there, told),
        head=antenna_above.take(receiver(site), system.head),
        computer=told,
    )
    if not counts:
        return seen
    fix = computer.fix(site.limits, system.computer, place_mm)
    apart = antenna_spacing.run(track(site), system.trailing, read_at_nm)
    return replace(
        seen,
        running=odometry.take_fix(line(site), running(system), fix.least_mm, fix.most_mm),
        trailing=antenna_spacing.head_reads(track(site), apart, tag.uid, computer.place_of_read(told)),
        formation=train_length.head_passes(
            railway(site), formation(system), read_at_nm, 0, computer.tag_passed(told, tag.uid, computer.BY_HEAD_MS)
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


def come_to_listed(site: Train, there: Passage, told: Computer) -> Passage:
    """The computer takes the listed restrictions where its front may be for entered (T12)."""
    front, ahead = computer.place(told), told.known.ahead
    return speed_limit.come_to_listed(
        profile(site),
        there,
        restriction_ahead.may_be_entered(ahead.curve_mm, front),
        restriction_ahead.may_be_entered(ahead.turnout_mm, front),
    )


def miss_a_tag(site: Train, system: Whole, in_curve: bool, at_turnout: bool) -> Whole:
    """In the newest cycle the front has come past a tag that the head's antenna has not read (T5, T12)."""
    if not a_cycle_begins_when_the_one_before_was_sensed(system):
        return system
    if not what_lies_from_a_missed_tag_is_listed(system, in_curve, at_turnout):
        return system
    at, motion = computer.place(system.computer), system.computer.known.motion
    return replace(
        system,
        in_curve=in_curve,
        at_turnout=at_turnout,
        passing=speed_limit.miss_a_tag(
            profile(site),
            passage(system, system.front_nm),
            in_curve,
            at_turnout,
            at.known,
            at.least_mm - site.limits.train.length_mm,
            at.most_mm,
            motion.speed_most_mm_s,
        ),
    )


def read_unlisted(site: Train, system: Whole, in_curve: bool, at_turnout: bool) -> Whole:
    """The head's reader has delivered the record of a tag of no list, whatever it says (T5, T12)."""
    if not a_cycle_begins_when_the_one_before_was_sensed(system):
        return system
    told = computer.read_unlisted(system.computer)
    if not tag_reader.delivers(system.computer.head):
        return replace(system, computer=told)
    there = speed_limit.pass_tag(
        profile(site), passage(system, system.head.read_at_nm), in_curve, at_turnout, UNASSIGNED, False, 0, 0, 0
    )
    return replace(
        system,
        in_curve=in_curve,
        at_turnout=at_turnout,
        passing=come_to_listed(site, there, told),
        head=antenna_above.take(receiver(site), system.head),
        computer=told,
    )


def read_by_the_tail(site: Train, system: Whole) -> Whole:
    """The reader of the antenna that speaks for the tail has delivered the record of a tag (T2, T13)."""
    if not a_cycle_begins_when_the_one_before_was_sensed(system):
        return system
    told = computer.read_by_tail(site.limits, system.computer)
    if not tag_reader.delivers(system.computer.tail):
        return replace(system, computer=told)
    uid, read_at_nm = system.tail.lay_below.uid, system.tail.read_at_nm
    there = antenna_spacing.run(track(site), system.trailing, read_at_nm)
    read = replace(
        system,
        trailing=antenna_spacing.tail_reads(track(site), there, uid, computer.place_of_read(system.computer)),
        tail=antenna_above.take(receiver(site), system.tail),
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
    if system.computer.known.window.passed:
        return replace(system, computer=told)
    window = told.known.window
    awaiting = replace(system, awaited_mm=place_mm, computer=told)
    return replace(
        awaiting,
        passing=come_to_listed(site, passage(system, system.front_nm), told),
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
    told = computer.note_listed(site.limits, system.computer, place_mm, kind)
    return replace(
        system,
        computer=told,
        passing=come_to_listed(site, passage(system, system.front_nm), told),
        approach=_listed(site, approach(system), place_mm, kind, uid, in_curve, at_turnout),
    )


def _listed(
    site: Train, there: Approach, place_mm: int, kind: int, uid: int, in_curve: bool, at_turnout: bool
) -> Approach:
    """What it says begins where it lies, whether its antenna reads it there or not (T1)."""
    from_mm = computer.begins_from_mm(site.limits, place_mm)
    return braking.list_tag(braked(site), there, in_curve, at_turnout, kind, from_mm, NM_A_MM * uid)


def await_none(site: Train, system: Whole) -> Whole:
    """No order says which tag comes next (T5)."""
    if not a_cycle_begins_when_the_one_before_was_sensed(system):
        return system
    told = computer.await_none(system.computer)
    if system.computer.known.window.passed:
        return replace(system, computer=told)
    return replace(
        system,
        expecting=tag_window.expect_none(stretch(site), system.expecting),
        approach=braking.list_none(braked(site), approach(system)),
        passing=come_to_listed(site, passage(system, system.front_nm), told),
        computer=told,
    )
