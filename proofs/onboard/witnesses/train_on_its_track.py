"""One train and what its computer knows of the track that it is on, by the tags that it reads (T1, T12)."""

from __future__ import annotations

from dataclasses import replace

from kernel.onboard import computer
from kernel.onboard.restriction_ahead import NONE_LISTED, Ahead
from kernel.onboard.speed_limit import UNKNOWN as NO_TRACK_KNOWN
from kernel.onboard.speed_limit import SpeedTable
from kernel.onboard.tag_kind import CURVE, PLAIN, TURNOUT
from models.onboard.ceiling import AT_REST as KEEPING_AT_REST
from models.onboard.ceiling import Keeping
from models.onboard.speed_limit import permitted_mm_s
from models.onboard.train_nature import profile
from models.onboard.units import NM_A_MM
from proofs.onboard.witnesses.one_train import (
    LIMITS,
    PLAIN_TRACK,
    SITE,
    Ride,
    approaching,
    at_rest,
    heard,
    record,
)
from proofs.onboard.witnesses.rolling_stock import START_MM


def the_track_is_what_the_tags_say_for_the_whole_train() -> None:
    """A tag lifts what restricts once the rear is past it, and one that is elsewhere, or of no list, nothing (T12)."""
    tag_mm = START_MM + 100_000
    ride = approaching(tag_mm)
    assert ride.system.computer.known.limit == NO_TRACK_KNOWN
    ride.reads(tag_mm)
    ride.step("await_none")
    limit = ride.system.computer.known.limit
    assert (limit.in_curve, limit.at_turnout) == (False, False)
    at_mm = computer.place_of_read(ride.system.computer).most_mm
    assert (limit.curve_until_mm, limit.turnout_until_mm) == (at_mm, at_mm)
    passed = ride.system
    ride.hears(record(tag_mm + 1), front_mm=tag_mm + 4_000)
    ride.step("read_unlisted", in_curve=True, at_turnout=True)
    assert ride.system.computer.known.limit == replace(limit, in_curve=True, at_turnout=True)
    ride.system = passed
    ride.reads(tag_mm + 40_000)
    assert ride.system == passed, "there is no such tag under it"
    other = computer.read_by_head(LIMITS, heard(passed.computer, record(1)), tag_mm + 40_000)
    assert other.known.limit == replace(limit, in_curve=True, at_turnout=True)
    assert other.spacing == passed.computer.spacing
    assert other.known.motion == passed.computer.known.motion
    while not ride.system.computer.brake.applied:
        ride.cycle(ride.system.speed_um_s // 1_000 + 100)
    assert 14_000 < ride.system.from_um_s // 1_000 <= 15_100, "faster than a turnout allows, its rear may be on one"


def a_tag_that_hides_a_curve_is_none_of_this_world() -> None:
    """Nobody writes one (T1, T12)."""
    tag_mm = START_MM + 100_000
    ride = approaching(tag_mm)
    before = ride.system
    ride.reads(tag_mm, in_curve=True)
    assert ride.system.passing == before.passing
    assert ride.system.computer.known == before.computer.known
    ride.system = before
    ride.reads(tag_mm, in_curve=True, kind=CURVE)
    assert ride.system.passing.in_curve
    assert ride.system.computer.known.limit.in_curve
    assert not ride.system.computer.known.limit.at_turnout


def a_listed_turnout_is_entered_no_faster_than_it_allows() -> None:
    """The brake comes on before it, though the driver goes on gathering speed, and stays on to a standstill (T12)."""
    ride = Ride()
    ride.start()
    tag_mm, turnout_mm = START_MM + 20_000, START_MM + 230_000
    plain = {"kind": PLAIN, "in_curve": False, "at_turnout": False}
    ride.step("await_tag", place_mm=tag_mm, uid=tag_mm, **plain)
    assert ride.system.computer.known.ahead == NONE_LISTED
    turnout = {"kind": TURNOUT, "in_curve": False, "at_turnout": True}
    ride.step("note_listed", place_mm=turnout_mm, uid=turnout_mm, **turnout | {"kind": PLAIN})
    ride.step("note_listed", place_mm=turnout_mm, uid=turnout_mm + 201, **turnout)
    assert ride.system.computer.known.ahead == NONE_LISTED, "no list hides it, nor has it elsewhere"
    ride.step("note_listed", place_mm=turnout_mm, uid=turnout_mm, **turnout)
    from_mm = turnout_mm - 700
    assert ride.system.computer.known.ahead == Ahead(NONE_LISTED.curve_mm, from_mm), "where it lies at the nearest"
    ride.gather(5_000)
    ride.until(tag_mm + 4_000)
    ride.reads(tag_mm)
    curve = {"kind": CURVE, "in_curve": True, "at_turnout": False}
    ride.step("await_tag", place_mm=turnout_mm, uid=turnout_mm, **turnout)
    ride.step("note_listed", place_mm=turnout_mm + 90_000, uid=turnout_mm + 90_000, **curve)
    assert ride.system.computer.known.ahead == Ahead(from_mm + 90_000, from_mm)
    while ride.system.front_nm < (from_mm - 25_000) * NM_A_MM:
        ride.cycle(min(14_000, ride.system.speed_um_s // 1_000 + 100))
    while not ride.system.computer.brake.applied:
        ride.cycle(ride.system.speed_um_s // 1_000 + 100)
    assert ride.system.speed_um_s < 15_000_000, "no faster than a turnout allows, but it might become so"
    assert ride.system.front_nm < from_mm * NM_A_MM
    ride.stop()


def run_until_it_brakes(ride: Ride, gains_mm_s: int) -> None:
    """Run on, faster by so much in each cycle, until the computer puts the brake on."""
    while not ride.system.computer.brake.applied:
        ride.cycle(ride.system.speed_um_s // 1_000 + gains_mm_s)


def is_overdue(ride: Ride) -> bool:
    """Tell whether a tag is overdue."""
    return ride.system.computer.known.window.passed


def a_curve_whose_tag_was_missed_is_not_forgotten() -> None:
    """Nor is it overdue no more once another is listed: the train is located anew, and keeps to any track (T5, T12)."""
    first_mm = START_MM + 100_000
    ride = approaching(first_mm)
    ride.reads(first_mm)
    curve_mm, next_mm = first_mm + 130_000, first_mm + 900_000
    curve = {"in_curve": True, "at_turnout": False}
    ride.step("await_tag", place_mm=curve_mm, uid=curve_mm, kind=CURVE, **curve)
    ride.step("miss_a_tag", **curve)
    before = ride.system.passing
    assert not before.in_curve, "the front is not there yet"
    ride.until(curve_mm + 4_000)
    assert ride.system.computer.known.limit.in_curve
    ride.step("miss_a_tag", **curve)
    assert ride.system.passing.in_curve
    run_until_it_brakes(ride, 0)
    assert is_overdue(ride)
    ride.stop()
    ride.stand_until_held()
    overdue = ride.system.computer
    assert ride.step("await_tag", place_mm=next_mm, uid=next_mm, **PLAIN_TRACK).computer == overdue
    assert ride.step("await_none").computer == overdue
    front_mm = ride.system.front_nm // NM_A_MM
    ride.step("locate_anew", least_mm=front_mm - 1_000, most_mm=front_mm + 1_000)
    ride.step("await_tag", place_mm=next_mm, uid=next_mm, **PLAIN_TRACK)
    assert not is_overdue(ride)
    assert ride.system.computer.known.ahead == NONE_LISTED
    ride.step("take_end", end_mm=next_mm)
    for _ in range(30):
        ride.cycle(0, acknowledged=True)
    run_until_it_brakes(ride, 100)
    speeds = LIMITS.train.speeds
    slowest_mm_s = min(speeds.curve_mm_s, speeds.turnout_mm_s)
    assert slowest_mm_s - 1_000 < ride.system.from_um_s // 1_000 <= slowest_mm_s
    assert ride.system.front_nm < next_mm * NM_A_MM


def a_restriction_is_entered_with_the_list_that_has_it() -> None:
    """Where the front is beyond it already, and where another tag before it was read (T12)."""
    first_mm = START_MM + 100_000
    ride = approaching(first_mm)
    curve, turnout = {"in_curve": True, "at_turnout": False}, {"in_curve": False, "at_turnout": True}
    ride.step("note_listed", place_mm=first_mm + 200, uid=first_mm + 200, kind=TURNOUT, **turnout)
    ride.reads(first_mm)
    limit = ride.system.computer.known.limit
    assert (limit.in_curve, limit.at_turnout) == (False, True), "this tag was read, and not the next"
    ride.step("note_listed", place_mm=first_mm + 100, uid=first_mm + 100, kind=CURVE, **curve)
    assert ride.system.computer.known.limit.in_curve


def what_is_listed_is_forgotten_with_the_tag_that_is_awaited() -> None:
    """And the brake lets a train run as fast as the line that awaits none (T4, T12)."""
    ride = Ride()
    ride.start()
    tag_mm = START_MM + 100_000
    curve = {"kind": CURVE, "in_curve": True, "at_turnout": False}
    ride.step("await_tag", place_mm=tag_mm, uid=tag_mm, **curve)
    assert ride.system.computer.known.ahead != NONE_LISTED
    ride.step("await_none")
    assert ride.system.computer.known.ahead == NONE_LISTED
    ride.step("await_tag", place_mm=tag_mm, uid=tag_mm, **curve | {"kind": PLAIN})
    assert not ride.system.computer.known.window.expected, "no list hides what is written in the tag"
    ride.step("await_tag", place_mm=tag_mm, uid=tag_mm, **curve)
    ride.step("withhold_end")
    for _ in range(5):
        ride.cycle(0, may_proceed=False)
    front_mm = ride.system.front_nm // NM_A_MM
    ride.step("locate_anew", least_mm=front_mm, most_mm=front_mm + 1_000)
    assert ride.system.computer.known.ahead == NONE_LISTED


def it_gains_until_its_brake_responds() -> None:
    """Whoever gathers speed at the limit is as much faster as motors and descent give until then, and no more (T12)."""
    ride = Ride()
    ride.start()
    run_until_it_brakes(ride, 100)
    assert ride.system.from_um_s == 14_900_000
    worst_um_s = 15_000_000 + 2 * 102 * 1_300 + 2 * 102 * 300
    assert ride.system.permitted == Keeping(cut_cycles=0, falling_cycles=2, worst_um_s=worst_um_s)
    for falling_cycles in (1, 0, 0):
        ride.cycle(ride.system.speed_um_s // 1_000 + (30 if ride.system.permitted.falling_cycles else -70))
        assert ride.system.permitted == Keeping(0, falling_cycles, worst_um_s)
    assert ride.system.speed_um_s == 14_990_000
    ride.stop()
    front_mm = ride.system.front_nm // NM_A_MM
    ride.stand_until_held()
    ride.step("locate_anew", least_mm=front_mm - 1_000, most_mm=front_mm + 1_000)
    assert ride.system.permitted == KEEPING_AT_REST


def the_smallest_is_permitted_from_head_to_rear() -> None:
    """A curve and a turnout restrict while a part of the train is in them, to their end and not beyond (T12)."""
    site, plain = profile(SITE), replace(at_rest().passing, front_nm=0, at_turnout=False)
    rear_nm = -site.length_mm * NM_A_MM
    beyond = replace(plain, left_curve_nm=rear_nm - 1, left_turnout_nm=rear_nm - 1)
    seen = {
        40: beyond,
        20: replace(beyond, in_curve=True),
        15: replace(beyond, at_turnout=True),
    }
    for permitted_m_s, passage in seen.items():
        assert permitted_mm_s(site, passage) == 1_000 * permitted_m_s
    assert permitted_mm_s(site, replace(beyond, left_curve_nm=rear_nm)) == 20_000
    assert permitted_mm_s(site, replace(beyond, left_turnout_nm=rear_nm)) == 15_000
    assert permitted_mm_s(site, replace(beyond, in_curve=True, at_turnout=True)) == 15_000
    slow = replace(site, table=SpeedTable(line_mm_s=10_000, curve_mm_s=12_000, turnout_mm_s=14_000))
    assert permitted_mm_s(slow, replace(beyond, in_curve=True, at_turnout=True)) == 10_000
    sharp = replace(site, table=SpeedTable(line_mm_s=40_000, curve_mm_s=12_000, turnout_mm_s=14_000))
    assert permitted_mm_s(sharp, replace(beyond, in_curve=True, at_turnout=True)) == 12_000


WITNESSES = (
    the_track_is_what_the_tags_say_for_the_whole_train,
    what_is_listed_is_forgotten_with_the_tag_that_is_awaited,
    a_curve_whose_tag_was_missed_is_not_forgotten,
    a_restriction_is_entered_with_the_list_that_has_it,
    a_listed_turnout_is_entered_no_faster_than_it_allows,
    a_tag_that_hides_a_curve_is_none_of_this_world,
    it_gains_until_its_brake_responds,
    the_smallest_is_permitted_from_head_to_rear,
)
