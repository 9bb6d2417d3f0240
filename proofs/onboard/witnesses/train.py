"""One train that starts, runs, reads a tag and stops before its end, and what its computer is told (P7, T5, T12)."""

from __future__ import annotations

from dataclasses import replace

from kernel.onboard import brake_watch, braking, computer, odometry, split, tag_reader
from kernel.onboard.odometry import Loss, Readings
from kernel.onboard.reverse_movement import LOCATED, Movement
from kernel.onboard.speed_limit import UNKNOWN as NO_TRACK_KNOWN
from kernel.onboard.speed_limit import SpeedLimit
from kernel.onboard.split import Acceleration
from kernel.onboard.tag_reader import NO_FRAME
from kernel.onboard.tag_window import NONE_AWAITED, Window
from kernel.onboard.way import Way
from models.onboard.train_nature import (
    a_brake_that_has_responded_keeps_its_bound,
    a_rolling_wheel_measures,
    fastest_cycle_nm,
    tail_comes_over,
)
from models.onboard.units import NM_A_MM
from proofs.onboard.train import the_train_stands_held_by_its_brake
from proofs.onboard.witnesses import found_sound, train_on_its_track, train_promising, train_reading
from proofs.onboard.witnesses.one_train import (
    BRAKE,
    END_MM,
    LIMITS,
    PLAIN_TRACK,
    SHOWN_MM,
    SITE,
    TAIL,
    Ride,
    approaching,
    at_rest,
    heard,
    record,
)
from proofs.onboard.witnesses.rolling_stock import START_MM
from proofs.onboard.witnesses.train_as_it_is_said import (
    a_feature_narrows_the_range_of_a_train_that_runs,
    a_train_that_is_said_to_be_beyond_a_board_keeps_its_trust,
    nothing_is_said_of_a_train_that_runs,
    what_is_said_too_late_of_a_train_is_not_taken,
)
from proofs.onboard.witnesses.train_measured import (
    a_tail_does_not_count_once_its_train_is_another_than_written,
    a_train_is_measured_by_a_tag_that_both_antennas_read,
    no_length_is_measured_by_anothers_antenna,
    the_faster_end_of_a_cycle_counts_for_a_pass_and_none_runs_backwards,
)

# ---- it runs


def a_train_runs_up_to_its_end_and_is_stopped_before_it() -> None:
    """Nobody brakes it but its computer (T12)."""
    ride = Ride()
    ride.start()
    ride.gather(12_000)
    while not ride.system.computer.brake.applied:
        ride.cycle(12_000)
    ride.stop()
    left_mm = END_MM - ride.system.front_nm // NM_A_MM
    assert 0 <= left_mm < 60_000


def a_tag_narrows_where_it_is() -> None:
    """By where it lies, and by how far the train has run since it was read, within the cycle (P7, T2)."""
    ride = Ride()
    ride.start()
    ride.gather(10_000)
    ride.cycle(10_000)
    wide = ride.system.computer.known.motion
    read_at_nm = ride.system.front_nm - 500 * NM_A_MM
    uid = read_at_nm // NM_A_MM - 4_000 - 300
    ride.reads(uid, place_mm=uid + 100, front_mm=read_at_nm // NM_A_MM)
    narrow = ride.system.computer.known.motion
    assert narrow.front_most_mm - narrow.front_least_mm < wide.front_most_mm - wide.front_least_mm
    ride.cycle(10_000)


def an_awaited_tag_is_taken_where_it_lies() -> None:
    """And not one that is listed elsewhere than where the train is (T5)."""
    tag_mm = START_MM + 100_000
    ride = approaching(tag_mm)
    untold = ride.system
    ride.reads(tag_mm, place_mm=tag_mm + 100)
    assert ride.system.computer.spacing.reads.first.uid == tag_mm, "one beside it that is listed here fixes the train"
    assert ride.system.expecting == untold.expecting, "and is not the awaited one"
    ride.system = untold
    ride.reads(tag_mm)
    assert ride.system.expecting.taken
    assert ride.system.expecting.in_place


def an_awaited_tag_is_refused_by_a_train_that_did_not_know_where_it_was() -> None:
    """What the odometry claimed when the cycle began counts as well (T5, P7)."""
    tag_mm = START_MM + 100_000
    ride = approaching(tag_mm)
    past = replace(ride.system.computer, before=odometry.past(ride.system.computer.before))
    ride.system = replace(ride.system, computer=past)
    ride.reads(tag_mm)
    assert not ride.system.expecting.taken
    assert ride.system.expecting.way_nm == (tag_mm + 4_000 - past.from_mm) * NM_A_MM
    assert replace(ride.system.computer, head=past.head) == past


def an_awaited_tag_that_does_not_come_brakes_the_train() -> None:
    """Once the train is surely past it (T5)."""
    tag_mm = START_MM + 100_000
    ride = approaching(tag_mm)
    while not ride.system.computer.known.window.passed:
        ride.cycle(5_000)
    assert ride.system.computer.brake.applied
    assert 2_000 < ride.system.front_nm // NM_A_MM - tag_mm - 4_000 < 10_000


def a_tag_listed_elsewhere_says_nothing() -> None:
    """A read is put down to no place where the train certainly is not (T5, P7)."""
    tag_mm = START_MM + 100_000
    ride = approaching(tag_mm)
    before = ride.system.computer
    limit = SpeedLimit(in_curve=False, at_turnout=False, curve_until_mm=9, turnout_until_mm=9)
    on_plain_track = replace(before, known=replace(before.known, limit=limit))
    delivered = heard(on_plain_track, record(1))
    told = computer.read_by_head(LIMITS, delivered, tag_mm + 20_000)
    unlisted = replace(on_plain_track.known, limit=replace(limit, in_curve=True, at_turnout=True))
    assert told == computer.read_unlisted(delivered), "and anything may lie from it on"
    assert told == replace(delivered, known=unlisted, head=tag_reader.taken(delivered.head))
    assert computer.read_by_head(LIMITS, delivered, tag_mm).spacing != before.spacing


def a_fix_that_contradicts_leaves_the_track_unknown() -> None:
    """A tag in its window whose place is none that the front may have: its kind ends no restriction (P7, T8, T12)."""
    before = approaching(START_MM + 100_000).system.computer
    beyond_mm = before.known.motion.front_most_mm - LIMITS.tags.antenna_mm + 1_500
    told = computer.read_by_head(LIMITS, heard(before, record(1)), beyond_mm)
    assert told.known.motion.loss is Loss.CONTRADICTED
    assert told.known.limit.in_curve
    assert told.known.limit.at_turnout
    assert told.known.limit == before.known.limit, "nor does one end where the front is not"


def a_tail_that_follows_as_preset_counts() -> None:
    """By where the front was when head and tail read the same tag; the line must answer, and nothing roll back (T3)."""
    tag_mm = START_MM + 100_000
    ride = approaching(tag_mm)
    ride.reads(tag_mm)
    ride.step("await_none")
    assert not ride.fits()
    ride.until(tag_mm + 4_000 + LIMITS.antennas_mm)
    ride.tail_reads(tag_mm, front_mm=tag_mm + 4_000 + LIMITS.antennas_mm)
    assert ride.fits()
    here = ride.system.computer
    assert not computer.through_line(LIMITS, here, False).answers
    assert computer.through_line(LIMITS, here, True).is_intact
    parted = replace(here, known=replace(here.known, wholeness=replace(here.known.wholeness, split=True)))
    assert not computer.through_line(LIMITS, parted, True).is_intact
    rolled = replace(here, known=replace(here.known, movement=replace(here.known.movement, reversed=True)))
    assert not computer.through_line(LIMITS, rolled, True).fits
    read = ride.system
    ride.tail_reads(tag_mm + 2_000, front_mm=ride.system.front_nm // NM_A_MM)
    assert ride.system == read, "there is no such tag under it"


def a_tail_comes_over_a_tag_by_what_tags_and_reads_may_err() -> None:
    """Tags lie within 200 mm of their places here, and are read within 500 mm: to the millimetre (T2)."""
    system = approaching(START_MM + 100_000).system
    over_nm = NM_A_MM * (system.awaited_mm + LIMITS.tags.antenna_mm - 700) + system.trailing.apart_nm
    for off_nm, comes in ((0, True), (-1, False)):
        at_nm = over_nm + off_nm
        assert tail_comes_over(SITE, replace(system, front_nm=at_nm, from_nm=at_nm)) is comes
    far_nm = over_nm + fastest_cycle_nm(SITE)
    for from_nm, comes in ((over_nm, True), (over_nm - 1, False)):
        assert tail_comes_over(SITE, replace(system, front_nm=far_nm, from_nm=from_nm)) is comes


def a_tail_that_is_shaken_brakes_the_train() -> None:
    """It has parted, as far as anybody on board can tell (P5)."""
    ride = Ride()
    ride.start()
    ride.run(100)
    ride.sense(tail=replace(TAIL, left=Acceleration(-20_000, True), right=Acceleration(-20_000, True)))
    assert ride.system.computer.known.wholeness.split
    ride.cycle(200)
    assert ride.system.computer.brake.applied


def a_train_that_rolls_back_is_braked() -> None:
    """Once its wheel has shown more than is allowed (T5)."""
    ride = Ride()
    ride.start()
    for _ in range(40):
        ride.cycle(max(ride.system.speed_um_s // 1_000 - 50, -1_000))
    assert ride.system.computer.known.movement.reversed
    assert ride.system.computer.brake.applied


def a_rear_that_was_left_behind_is_no_tail() -> None:
    """Nor is it one again before staff has found the train whole (T3, T13)."""
    tag_mm = START_MM + 100_000
    ride = approaching(tag_mm)
    ride.reads(tag_mm)
    ride.step("await_none")
    ride.step("come_apart", apart_nm=40_000 * NM_A_MM)
    ride.until(tag_mm + 44_000)
    ride.tail_reads(tag_mm, front_mm=tag_mm + 44_000)
    assert ride.is_caught()
    ride.draw_up()
    front_mm = ride.system.front_nm // NM_A_MM
    ride.step("locate_anew", least_mm=front_mm - 2_000, most_mm=front_mm + 2_000)
    assert ride.is_caught()
    ride.step("find_whole")
    assert ride.is_caught(), "it is not"
    ride.step("come_apart", apart_nm=LIMITS.antennas_mm * NM_A_MM)
    ride.step("find_whole")
    assert not ride.is_caught()
    assert ride.system.trailing.whole


def a_tag_read_elsewhere_is_none_of_this_world() -> None:
    """One that lies off its place, is read from afar, or before the newest cycle (T1, T2, T16)."""
    ride = Ride()
    ride.start()
    ride.gather(10_000)
    ride.cycle(10_000)
    front_nm = ride.system.front_nm
    for off_mm, afar_mm, late_mm in ((201, 0, 0), (0, 501, 0), (0, 0, 1_100)):
        uid = front_nm // NM_A_MM - 4_000 - afar_mm - late_mm
        before = ride.system
        ride.reads(uid, place_mm=uid + off_mm, front_mm=front_nm // NM_A_MM - late_mm)
        assert replace(ride.system, head=before.head, computer=before.computer) == before
        assert ride.system.computer.known == before.computer.known
        ride.system = before


def an_order_that_stops_it_brakes_it() -> None:
    """From the cycle on in which it is so (T5)."""
    ride = Ride()
    ride.start()
    ride.gather(10_000)
    ride.cycle(10_000, may_proceed=False)
    assert ride.system.computer.brake.applied
    ride.stop()


def an_end_is_withheld_at_any_moment() -> None:
    """While a cycle is run, too: the driver puts the brake on when he likes (T4, T9)."""
    ride = Ride()
    ride.start()
    ride.gather(5_000)
    ride.run(5_000)
    ride.step("withhold_end")
    assert ride.system.computer.brake.applied
    assert ride.system.computer.brake.withheld
    ride.sense()
    ride.stop()


def a_cycle_is_run_and_sensed_in_turn() -> None:
    """What is told comes between cycles; none is begun before the one before was sensed, and none sensed twice (P7)."""
    ride = Ride()
    ride.start()
    sensed = ride.system
    shown = Readings(100, True, 0, SHOWN_MM, True, 0)
    ride.step("sense_the_cycle", readings=shown, tail=TAIL, gradient_mm_s2=0, slips=False, sticks=False)
    assert ride.system is sensed
    ride.run(100)
    under_way = ride.system
    front_nm = under_way.front_nm
    at_mm = front_nm // NM_A_MM
    ride.step("run_a_cycle", may_proceed=True, acknowledged=False, to_nm=front_nm, speed_um_s=0)
    ride.step("take_end", end_mm=END_MM + 1)
    ride.reads(at_mm - 4_000)
    ride.step("read_unlisted", in_curve=True, at_turnout=True)
    ride.tail_reads(at_mm - 116_000, front_mm=at_mm)
    ride.step("await_tag", place_mm=at_mm, uid=at_mm, **PLAIN_TRACK)
    ride.step("await_none")
    ride.step("find_whole")
    ride.step("locate_anew", least_mm=at_mm - 1, most_mm=at_mm + 1)
    assert ride.system is under_way


# ---- it is located anew


def a_train_located_anew_begins_as_at_the_start() -> None:
    """Once its brake holds it; what it awaited, how far it had rolled, and which end it held, are over (P7, T8)."""
    ride = Ride()
    ride.start()
    ride.draw_up()
    known = replace(
        ride.system.computer.known,
        watch=replace(ride.system.computer.known.watch, limit_mm_s=9),
        movement=Movement(furthest_mm=9, reversed=False),
        limit=SpeedLimit(in_curve=False, at_turnout=False, curve_until_mm=9, turnout_until_mm=9),
        window=Window(expected=True, least_mm=1, most_mm=2, passed=False),
    )
    ride.system = replace(
        ride.system,
        approach=replace(ride.system.approach, wanted=True),
        watched=replace(ride.system.watched, allowed_mm_s=9),
        expecting=replace(ride.system.expecting, window=known.window),
        computer=replace(ride.system.computer, known=known, from_mm=9),
    )
    front_mm = ride.system.front_nm // NM_A_MM
    ride.step("locate_anew", least_mm=front_mm - 2_000, most_mm=front_mm + 2_000)
    anew = ride.system.computer
    assert computer.place(anew) == Way(True, front_mm - 2_000, front_mm + 2_000)
    assert anew.brake == braking.stand_still(front_mm + 2_000)
    assert anew.from_mm == 0
    assert anew.known.movement == LOCATED
    assert anew.known.limit == NO_TRACK_KNOWN
    assert anew.known.window == NONE_AWAITED
    assert anew.before == odometry.past(anew.known.motion)
    assert not ride.system.approach.wanted
    assert the_train_stands_held_by_its_brake(SITE, ride.system)


def a_tag_told_after_the_train_was_located_anew_says_nothing() -> None:
    """It was read before, and nobody knows how far the train has run since; the next one counts (P7, T2)."""
    ride = Ride()
    ride.start()
    ride.draw_up()
    front_nm = ride.system.front_nm
    front_mm = front_nm // NM_A_MM
    ride.step("locate_anew", least_mm=front_mm - 2_000, most_mm=front_mm + 2_000)
    located = ride.system
    ride.reads(front_mm - 4_000)
    assert replace(ride.system.computer, head=located.computer.head) == located.computer
    ride.cycle(0)
    ride.hears(NO_FRAME, front_mm=front_mm, times=LIMITS.reader.gap_frames)
    ride.reads(front_mm - 4_000)
    narrowed = ride.system.computer.known.motion
    assert narrowed.front_most_mm - narrowed.front_least_mm < 4_000


def a_train_whose_brake_has_yet_to_hold_it_is_not_located() -> None:
    """Nor one that somebody sees elsewhere than it is, or that runs (P7, T8)."""
    ride = Ride()
    ride.start()
    front_mm = ride.system.front_nm // NM_A_MM
    ride.step("locate_anew", least_mm=front_mm - 2_000, most_mm=front_mm + 2_000)
    ride.step("withhold_end")
    for _ in range(BRAKE.response_cycles):
        released = ride.system
        ride.step("locate_anew", least_mm=front_mm - 2_000, most_mm=front_mm + 2_000)
        assert ride.system == released
        ride.cycle(0)
    held = ride.system
    ride.step("locate_anew", least_mm=front_mm + 1, most_mm=front_mm + 2_000)
    assert ride.system == held
    ride.step("locate_anew", least_mm=front_mm, most_mm=front_mm + 2_000)
    assert ride.system != held


# ---- what the computer is told


def a_computer_put_into_service_knows_where_it_stands_and_no_more() -> None:
    """At rest, its brake on, no tag awaited, and not that it is whole; whatever was known before (P5, P7, T8)."""
    ride = Ride()
    ride.start()
    front_mm = ride.system.front_nm // NM_A_MM
    least_mm, most_mm = front_mm - 2_000, front_mm + 2_000
    released = ride.system
    ride.step("put_into_service", least_mm=least_mm, most_mm=most_mm)
    assert ride.system == released
    ride.gather(3_000)
    ride.step("withhold_end")
    ride.stop()
    front_mm = ride.system.front_nm // NM_A_MM
    least_mm, most_mm = front_mm - 2_000, front_mm + 2_000
    ride.system = replace(ride.system, watched=replace(ride.system.watched, kept=False))
    ride.step("put_into_service", least_mm=front_mm + 1, most_mm=most_mm)
    assert not ride.system.watched.kept
    ride.step("put_into_service", least_mm=least_mm, most_mm=most_mm)
    assert the_train_stands_held_by_its_brake(SITE, ride.system)
    begun = ride.system.computer
    assert begun.known.motion == odometry.located(least_mm, most_mm, 0)
    assert begun.before == odometry.past(begun.known.motion)
    assert begun.known.watch == brake_watch.restarted()
    assert begun.known.movement == LOCATED
    assert begun.known.wholeness == split.restarted(LIMITS.split)
    assert begun.known.window == NONE_AWAITED
    assert begun.brake == braking.stand_still(most_mm)
    assert begun.from_mm == 0
    ride.cycle(0)


def a_brake_that_is_put_on_again_waits_for_its_response() -> None:
    """Released when a cycle begins and put on again before it ends, it holds nobody yet (T12)."""
    ride = Ride()
    for _ in range(20):
        ride.cycle(0)
    ride.step("take_end", end_mm=END_MM)
    assert computer.standstill(LIMITS, ride.system.computer).braked_cycles == BRAKE.response_cycles
    ride.run(0, acknowledged=True)
    assert not ride.system.computer.brake.applied
    ride.step("withhold_end")
    assert computer.standstill(LIMITS, ride.system.computer).braked_cycles == 0
    ride.sense()
    assert computer.standstill(LIMITS, ride.system.computer).braked_cycles == 1


def a_computer_is_told_of_tags_and_of_its_train() -> None:
    """Which tag it awaits from where, that it awaits none, and that staff has found the train whole (T5, P5)."""
    ride = Ride()
    ride.step("await_tag", place_mm=START_MM + 100_000, uid=START_MM + 100_000, **PLAIN_TRACK)
    told = ride.system.computer
    assert told.from_mm == START_MM - 1_000 - 2_000, "behind the train, by its range and the tolerance"
    assert told.known.window == Window(expected=True, least_mm=107_000, most_mm=107_000, passed=False)
    assert computer.awaits(LIMITS, told, START_MM + 100_000)
    assert not computer.awaits(LIMITS, told, START_MM + 100_001)
    ride.step("await_none")
    assert ride.system.computer.known.window == NONE_AWAITED
    assert not computer.awaits(LIMITS, ride.system.computer, ride.system.computer.from_mm - 4_000)
    known = ride.system.computer.known
    parted = replace(known, wholeness=replace(known.wholeness, split=True))
    ride.system = replace(ride.system, computer=replace(ride.system.computer, known=parted))
    ride.step("find_whole")
    assert ride.system.computer.known.wholeness == split.made_up(LIMITS.split)


# ---- what is asked of nature


def a_brake_is_asked_for_nothing_before_it_has_responded() -> None:
    """Then, and while it is commanded, for what is guaranteed (T12)."""
    runs = replace(at_rest(), speed_um_s=10_000_000)
    new = replace(runs, watched=replace(runs.watched, cycles=BRAKE.response_cycles - 1))
    assert a_brake_that_has_responded_keeps_its_bound(SITE, runs, False, 10_000_000)
    assert a_brake_that_has_responded_keeps_its_bound(SITE, new, True, 10_000_000)
    assert a_brake_that_has_responded_keeps_its_bound(SITE, runs, True, 9_931_400)
    assert not a_brake_that_has_responded_keeps_its_bound(SITE, runs, True, 9_931_401)


def a_wheel_that_slips_or_is_not_read_shows_what_it_likes() -> None:
    """One that rolls, and is read, shows how fast the train is (P1)."""
    runs = replace(at_rest(), speed_um_s=10_000_000)
    wrong = Readings(100, True, 12_000, SHOWN_MM + 1_000, True, 0)
    assert not a_rolling_wheel_measures(SITE, runs, wrong, False, False)
    assert a_rolling_wheel_measures(SITE, runs, wrong, True, False)
    assert a_rolling_wheel_measures(SITE, runs, replace(wrong, tachometer_valid=False), False, False)
    assert a_rolling_wheel_measures(SITE, runs, replace(wrong, tachometer_mm_s=10_010), False, False)


WITNESSES = (
    a_train_runs_up_to_its_end_and_is_stopped_before_it,
    a_tag_narrows_where_it_is,
    an_awaited_tag_is_taken_where_it_lies,
    an_awaited_tag_is_refused_by_a_train_that_did_not_know_where_it_was,
    an_awaited_tag_that_does_not_come_brakes_the_train,
    a_tag_listed_elsewhere_says_nothing,
    *train_on_its_track.WITNESSES,
    a_fix_that_contradicts_leaves_the_track_unknown,
    a_tail_that_follows_as_preset_counts,
    a_tail_comes_over_a_tag_by_what_tags_and_reads_may_err,
    a_tail_that_is_shaken_brakes_the_train,
    a_train_that_rolls_back_is_braked,
    a_rear_that_was_left_behind_is_no_tail,
    a_tag_read_elsewhere_is_none_of_this_world,
    an_order_that_stops_it_brakes_it,
    an_end_is_withheld_at_any_moment,
    a_cycle_is_run_and_sensed_in_turn,
    a_train_located_anew_begins_as_at_the_start,
    a_tag_told_after_the_train_was_located_anew_says_nothing,
    a_train_whose_brake_has_yet_to_hold_it_is_not_located,
    a_train_that_is_said_to_be_beyond_a_board_keeps_its_trust,
    nothing_is_said_of_a_train_that_runs,
    a_feature_narrows_the_range_of_a_train_that_runs,
    what_is_said_too_late_of_a_train_is_not_taken,
    *found_sound.WITNESSES,
    a_computer_put_into_service_knows_where_it_stands_and_no_more,
    a_brake_that_is_put_on_again_waits_for_its_response,
    a_computer_is_told_of_tags_and_of_its_train,
    a_brake_is_asked_for_nothing_before_it_has_responded,
    a_wheel_that_slips_or_is_not_read_shows_what_it_likes,
    a_train_is_measured_by_a_tag_that_both_antennas_read,
    no_length_is_measured_by_anothers_antenna,
    a_tail_does_not_count_once_its_train_is_another_than_written,
    the_faster_end_of_a_cycle_counts_for_a_pass_and_none_runs_backwards,
    *train_promising.WITNESSES,
    *train_reading.WITNESSES,
)
