"""Trains before a crossing: fast, slow, stopping, reversing, starting anew, and with a radio that fails (X1 to X3)."""

from __future__ import annotations

from dataclasses import replace

from kernel.crossing import arrival as machine
from kernel.crossing.arrival import FARTHEST_MM, UM_A_MM, ArrivalBounds, Followed, Ranging
from models.crossing.arrival import LetGo, cannot_both_be, is_of_this_line
from proofs.crossing.witnesses.contact import BOUNDS, LINE_UM, NOTHING, SITE, Train, brought, contacted
from proofs.onboard.witnesses.sixty_four_bits import Checked, with_ints

# ---- the moment


def at_the_lines_speed_the_warning_time_is_met_to_the_cycle() -> None:
    """At 30 m/s, from wherever: the time itself and the cycle until the next decision, no more (X2, X5)."""
    for way_mm in (2_000_000, 2_001_000, 2_002_999):
        train = Train(contacted(way_mm, 30_000))
        assert 350 <= train.to_the_crossing() <= 351


def gaining_all_the_way_the_warning_time_is_met_to_the_cycle() -> None:
    """From a stop 400 m before: it does not come to the line's speed; and from 1000 m, where it does (X2)."""
    for train in (brought(700_000, 0), brought(1_000_000, 5_000), Train(contacted(1_500_000, 10_000))):
        assert 350 <= train.to_the_crossing() <= 351


def a_slow_train_is_warned_of_later() -> None:
    """From 1056 m at 30 m/s, from 745 m at 5 m/s, from 608 m at a standstill: to the micrometre (X2)."""
    for speed_mm_s, begins_mm in ((30_000, 1_056_000), (5_000, 744_750), (0, 607_500)):
        pace_um = BOUNDS.cycle_ms * speed_mm_s
        at = Followed(UM_A_MM * begins_mm, LINE_UM - pace_um, LINE_UM, 0, 0, 0, False)
        assert worst_way_um(pace_um, 352) == at.way_um
        assert not machine.cannot_arrive(BOUNDS, at, 352)
        assert machine.cannot_arrive(BOUNDS, replace(at, way_um=at.way_um + 1), 352)
    for cycles in (1, 249, 250, 251):
        at = Followed(worst_way_um(500_000, cycles), 2_500_000, LINE_UM, 0, 0, 0, False)
        assert not machine.cannot_arrive(BOUNDS, at, cycles)
        assert machine.cannot_arrive(BOUNDS, replace(at, way_um=at.way_um + 1), cycles)


def worst_way_um(pace_um: int, cycles: int) -> int:
    """The way that a train makes at its worst, added up cycle by cycle."""
    way_um = 0
    for _ in range(cycles):
        pace_um = min(pace_um + BOUNDS.gain_um, BOUNDS.line_um)
        way_um += pace_um
    return way_um


def a_train_that_stops_short_asks_for_no_warning() -> None:
    """Standing at a station some 790 m before the crossing, for as long as it is ranged; then it starts (X2)."""
    train = Train(contacted(1_060_000, 5_000))
    while train.system.way_um > 800_000_000:
        train.cycle(500_000)
    while train.system.pace_um > 0:
        train.cycle(train.system.pace_um - 10_000)
    for _ in range(100):
        train.cycle(0)
        assert not train.warns()
    assert 350 <= train.to_the_crossing() <= 351


def a_train_that_reverses_may_turn_again() -> None:
    """Moving away it counts as standing, and one that turns is warned of in time (X2)."""
    train = brought(700_000, 0)
    for pace_um in (-10_000, -20_000, -500_000, -500_000):
        train.cycle(pace_um)
        assert not train.warns()
        assert train.system.followed.short_um <= BOUNDS.line_um - BOUNDS.gain_um
    train.range()
    train.decide()
    assert train.system.followed.short_um == BOUNDS.line_um
    train.run(-500_000)
    while train.system.pace_um < 0:
        train.cycle(train.system.pace_um + 10_000)
    assert train.to_the_crossing() >= 350


def who_turns_back_before_its_start_point_is_let_go() -> None:
    """Once it certainly moves away, its nearest is beyond the start point, and it is not warned of (X4)."""
    train = Train(contacted(1_200_000, 0))
    train.cycle(-10_000)
    train.range()
    assert train.step("turn_back", ranging=train.ranging(), start_mm=1_100_000).let_go == LetGo(False, 0, 0)
    train.decide()
    there, leaving = train.system, train.ranging()
    assert (leaving.speed_mm_s, there.followed.way_um, there.way_um) == (-100, 1_200_000_000, 1_200_000_000)
    for ranging in (NOTHING, replace(leaving, valid=False), replace(leaving, speed_mm_s=0)):
        assert train.step("turn_back", ranging=ranging, start_mm=1_199_999) == there
    assert train.step("turn_back", ranging=leaving, start_mm=1_200_000) == there
    for speed_mm_s in (-1, -100):
        train.system = there
        train.step("turn_back", ranging=replace(leaving, speed_mm_s=speed_mm_s), start_mm=1_199_999)
        assert train.system.let_go == LetGo(True, 1_200_000_000, 1_199_999)
    train.run(-10_000)
    assert train.system.let_go == LetGo(True, 1_200_000_000, 1_199_999), "of then, wherever it is now"


def contact_begins_with_nobody_who_runs_away() -> None:
    """Who stands, or may come nearer, is followed; who certainly runs away is not, nor anybody by no ranging (X1)."""
    stands = Ranging(True, 1_200_000, 0, 0)
    assert machine.begins_contact(BOUNDS, stands)
    assert not machine.begins_contact(BOUNDS, replace(stands, speed_mm_s=-1))
    assert not machine.begins_contact(BOUNDS, replace(stands, valid=False))


def who_was_warned_of_is_not_let_go_as_it_turns_back() -> None:
    """Its rear is proved out by its tail, or a person looks: nobody knows why it was warned of (X4)."""
    train = Train(contacted(9_000_000, 0))
    for _ in range(22):
        train.cycle(-10_000, NOTHING)
    assert train.warns()
    train.range()
    train.decide()
    held, leaving = train.system, train.ranging()
    assert held.followed.way_um > 8_000_000_000
    assert leaving.speed_mm_s < 0
    assert train.step("turn_back", ranging=leaving, start_mm=1_000_000) == held


def a_warning_once_begun_is_kept() -> None:
    """Though the train then stops (X2, X4)."""
    train = Train(contacted(1_100_000, 30_000))
    while not train.warns():
        train.cycle(3_000_000)
    for _ in range(50):
        train.cycle(0)
        assert train.warns()
    assert train.system.warned_cycles >= 50
    assert train.to_the_crossing() > 350


# ---- the radio


def lost_ranging_warns_at_once() -> None:
    """Two seconds after the last ranging, far from the crossing, and not before (X3)."""
    train = Train(contacted(9_000_000, 20_000))
    for silent in range(1, 23):
        train.cycle(2_000_000, NOTHING)
        assert train.system.silent_cycles == silent
        assert train.warns() == (silent == 22)
    assert train.system.warned_cycles == 1
    assert train.system.followed.age_cycles == 21
    lost = train.system.followed
    for _ in range(5):
        train.cycle(2_000_000, NOTHING)
        assert train.system.followed == lost


def without_rangings_the_worst_is_reckoned_with() -> None:
    """Within the two seconds that a ranging counts a train may come near enough: it is warned of in time (X2)."""
    train = Train(contacted(1_100_000, 30_000))
    while train.system.way_um > 0:
        train.cycle(3_000_000, NOTHING)
    train.step("arrive")
    assert 350 <= train.system.warned_cycles - 1 <= 351


def a_ranging_again_takes_the_place_of_the_worst() -> None:
    """Until then the train is held to gain speed, no more; the newer counts, and silence begins anew (X1, X2)."""
    train = Train(contacted(3_000_000, 20_000))
    for _ in range(15):
        train.cycle(2_000_000, NOTHING)
    assert train.system.followed.way_um == 3_000_000_000 - 15 * 2_000_000 - 120 * 10_000
    assert train.system.way_um == 3_000_000_000 - 15 * 2_000_000
    assert train.system.followed.short_um == 850_000
    train.range()
    train.decide()
    assert train.system.followed == Followed(train.system.way_um, 1_000_000, LINE_UM, 0, 2_970_000, 20_000, False)
    assert train.system.silent_cycles == 0


def a_late_ranging_is_shortened_by_its_age() -> None:
    """By the line's speed, and the train may have gained since; at any age that counts (X2)."""
    train = Train(contacted(3_002_000, 20_000))
    train.cycle(2_000_000)
    train.range()
    told = train.ranging()
    for _ in range(5):
        train.decide(NOTHING)
        train.run(2_000_000)
    train.decide(Ranging(True, told.way_mm, told.speed_mm_s, 5))
    held = train.system.followed
    assert held == Followed(3_000_000_000 - 5 * 3_000_000, 950_000, LINE_UM, 5, 3_000_000, 20_000, False)
    for age_cycles, counts in ((20, True), (21, False), (0, True), (-1, False)):
        assert machine.counts(BOUNDS, Ranging(True, 0, 0, age_cycles)) == counts
    assert machine.taken(BOUNDS, held, Ranging(True, 9_000, 29_950, 7)).short_um == 0


def a_radio_that_hangs_is_silent() -> None:
    """At 12 m/s, just out of reach of the warning, it tells one ranging as new for ever: that is lost (X1, X3)."""
    for way_mm, speed_mm_s in ((1_060_000, 12_000), (9_000_000, 2)):
        train = Train(contacted(way_mm, speed_mm_s))
        hung = train.ranging()
        for silent in range(1, 23):
            train.cycle(BOUNDS.cycle_ms * speed_mm_s, hung)
            assert train.system.silent_cycles == silent
            assert train.warns() or silent < 22
        assert train.warns()
        assert not train.system.contradicted
    train = Train(contacted(9_000_000, 12_000))
    told = train.ranging()
    for other in (replace(told, way_mm=8_999_999), replace(told, speed_mm_s=12_001)):
        assert machine.is_told_again(BOUNDS, train.system.followed, told)
        assert not machine.is_told_again(BOUNDS, train.system.followed, other)


def who_stands_is_where_it_was() -> None:
    """Slower than rangings err it may well be told the same again, and counts (X1)."""
    for speed_mm_s, is_again in ((2, True), (1, False), (0, False)):
        train = Train(contacted(2_000_000, speed_mm_s))
        assert machine.is_told_again(BOUNDS, train.system.followed, train.ranging()) == is_again
        for _ in range(0 if is_again else 100):
            train.cycle(0)
            assert (train.system.silent_cycles, train.warns()) == (0, False)
    rolls = Train(contacted(2_000_000, 0))
    for _ in range(100):
        rolls.cycle(-BOUNDS.cycle_ms)
        assert (rolls.system.silent_cycles, rolls.warns()) == (0, False)


def a_ranging_that_contradicts_the_one_before_warns_now() -> None:
    """Off by more than the line's speed lets a train run, nearer or farther; or faster than it can have got (X1)."""
    for way_mm, speed_mm_s in ((2_996_998, 20_000), (3_003_002, 20_000), (3_000_000, 20_102)):
        train = Train(contacted(3_000_000, 20_000))
        train.decide()
        train.run(0)
        told = Ranging(True, way_mm, speed_mm_s, 0)
        assert machine.contradicts(BOUNDS, train.system.followed, told)
        assert machine.follow(BOUNDS, train.system.followed, told).warns
        for nearer in (-1, 1):
            fits = replace(told, way_mm=way_mm + nearer, speed_mm_s=min(speed_mm_s, 20_101))
            assert machine.contradicts(BOUNDS, train.system.followed, fits) == (
                fits.way_mm > 3_003_001 or fits.way_mm < 2_996_999
            )
    train = Train(contacted(3_000_000, 20_000))
    train.decide()
    train.run(2_000_000)
    train.range()
    train.decide(Ranging(True, 2_000_000, 20_000, 0))
    assert (train.system.contradicted, train.warns()) == (True, True)
    for _ in range(3):
        train.run(2_000_000)
        train.range()
        train.decide()
        assert (train.system.contradicted, train.warns()) == (True, True)


def an_older_ranging_is_held_against_the_one_before_as_well() -> None:
    """Repeated by the radio it fits; told otherwise it does not, whichever of them came first (X1)."""
    train = Train(contacted(3_000_000, 20_000))
    for _ in range(3):
        train.cycle(train.faster())
    held = replace(train.system.followed, age_cycles=1)
    early = Ranging(True, 3_000_000, 20_000, 4)
    assert not machine.contradicts(BOUNDS, held, early)
    assert machine.contradicts(BOUNDS, held, replace(early, way_mm=3_013_026))
    assert machine.contradicts(BOUNDS, held, replace(early, speed_mm_s=held.told_speed_mm_s - 302))
    assert not machine.contradicts(BOUNDS, held, replace(early, speed_mm_s=held.told_speed_mm_s - 301))
    assert not machine.contradicts(BOUNDS, held, replace(early, speed_mm_s=30_000))


def what_does_not_count_contradicts_nothing() -> None:
    """Nothing told, out of range, too old, or after silence: that warns by itself (X1, X3)."""
    held = contacted(3_000_000, 20_000).followed
    odd = Ranging(True, 1_000_000, 20_000, 0)
    assert machine.contradicts(BOUNDS, held, odd)
    for told in (replace(odd, valid=False), replace(odd, way_mm=FARTHEST_MM + 1), replace(odd, age_cycles=21)):
        assert not machine.contradicts(BOUNDS, held, told)
    assert machine.contradicts(BOUNDS, replace(held, age_cycles=20), odd)
    assert not machine.contradicts(BOUNDS, replace(held, age_cycles=21), odd)


def what_is_out_of_range_does_not_count() -> None:
    """Beyond 100 km and beyond 200 m/s it is no ranging of a train; the edges are (X1)."""
    held = contacted().followed
    for way_mm, speed_mm_s, counts in (
        (FARTHEST_MM, 200_000, True),
        (FARTHEST_MM + 1, 0, False),
        (-FARTHEST_MM, -(2**62), True),
        (-FARTHEST_MM - 1, 0, False),
        (0, 200_001, False),
    ):
        ranging = Ranging(True, way_mm, speed_mm_s, 0)
        assert machine.counts(BOUNDS, ranging) == counts
        assert (machine.taken(BOUNDS, held, ranging) == held) != counts
    assert not machine.counts(BOUNDS, NOTHING)


def every_number_fits_into_64_bits() -> None:
    """Up to 200 m/s, 4 m/s², a cycle of a second and two minutes of warning (X2)."""
    bounds = with_ints(Checked, ArrivalBounds(200_000_000, 4_000_000, 1_000, 120, 10, FARTHEST_MM, 200_000))
    for way_mm in (-FARTHEST_MM, 0, FARTHEST_MM, 2**62):
        for speed_mm_s in (-(2**62), 0, 200_000, 2**62):
            ranging = Ranging(True, Checked(way_mm), Checked(speed_mm_s), Checked(10))
            for ceiling_um in (0, 200_000_000, 2**62):
                held = with_ints(Checked, Followed(0, 200_000_000, 200_000_000, 0, -FARTHEST_MM, 0, False))
                held = machine.held_to(bounds, held, Checked(ceiling_um))
                assert machine.aged(bounds, machine.follow(bounds, held, ranging)).age_cycles <= 11


# ---- ceilings


def by_its_ceiling_the_warning_time_is_met_to_the_cycle() -> None:
    """A train at 20 m/s that promises no more is warned of 352 m nearer; one that stands and promises 0 never (X2)."""
    for way_mm in (1_000_000, 1_001_000):
        train = Train(contacted(2_000_000, 20_000))
        train.promise(2_000_000)
        while train.system.way_um > UM_A_MM * way_mm:
            train.cycle(2_000_000)
        assert not train.warns()
        assert 350 <= train.to_the_crossing() <= 351
    stands = Train(contacted(1_060_000, 3_000))
    while stands.system.pace_um > 0:
        stands.cycle(stands.system.pace_um - 10_000)
    stands.promise(0)
    for _ in range(1_000):
        stands.cycle(0)
        assert not stands.warns()


def who_promises_nothing_is_held_to_the_lines_speed() -> None:
    """And so is one whose promise is not heard: what it keeps to is its own matter (X2)."""
    for promises in (True, False):
        train = Train(contacted(1_060_000, 20_000))
        if promises:
            train.step("keep_to", ceiling_um=2_000_000)
            assert train.system.ceiling_um == 2_000_000
        train.cycle(2_000_000)
        assert train.system.followed.ceiling_um == LINE_UM
        for _ in range(160):
            train.cycle(2_000_000)
        assert train.warns()
        assert train.system.way_um > 704 * 2_000_000 // 2


def to_go_faster_takes_an_acknowledgement() -> None:
    """It is given where the train needs no warning even so, and after the decision; then the train does its worst."""
    far = Train(contacted(1_300_000, 20_000))
    far.promise(2_000_000)
    held = far.system
    assert far.step("run_a_cycle", to_um=held.way_um, pace_um=2_010_000) == held
    assert far.step("acknowledge", asked_um=LINE_UM) == held
    far.range()
    far.decide()
    assert far.step("run_a_cycle", to_um=held.way_um, pace_um=2_010_000) == far.system
    for asked_um in (1_999_999, LINE_UM + 1):
        held = far.system
        assert far.step("acknowledge", asked_um=asked_um) == held
    raised = far.step("acknowledge", asked_um=LINE_UM)
    assert raised.ceiling_um == raised.followed.ceiling_um == raised.worst.ceiling_um == LINE_UM
    assert (raised.followed.short_um, raised.worst.short_um) == (1_000_000, 1_000_000)
    far.run(2_010_000)
    assert 350 <= far.to_the_crossing() <= 351
    near = Train(contacted(1_060_000, 5_000))
    near.promise(500_000)
    while near.system.way_um > 600_000_000:
        near.cycle(500_000)
    near.range()
    near.decide()
    held = near.system
    assert not near.warns()
    assert near.step("acknowledge", asked_um=LINE_UM) == held


def no_ceiling_is_promised_that_is_not_kept() -> None:
    """Nor does the crossing reckon with less than the train keeps to (X2)."""
    train = Train(contacted(2_000_000, 20_000))
    start = train.system
    assert train.step("keep_to", ceiling_um=1_999_999) == start
    assert train.step("take_ceiling", ceiling_um=LINE_UM - 1) == start
    assert train.step("keep_to", ceiling_um=2_500_000).ceiling_um == 2_500_000
    assert train.step("keep_to", ceiling_um=2_600_000).ceiling_um == 2_500_000
    assert train.step("take_ceiling", ceiling_um=2_499_999).followed.ceiling_um == LINE_UM
    assert train.step("take_ceiling", ceiling_um=2_500_000).followed.ceiling_um == 2_500_000
    assert train.system.followed.short_um == 500_000
    assert train.step("take_ceiling", ceiling_um=LINE_UM + 1).followed.ceiling_um == LINE_UM


# ---- nature


def what_nature_does_not_do_does_not_happen() -> None:
    """Each of the assumptions refuses its event, at its edge and not within (X1, X2)."""
    train = Train(contacted(2_000_000, 20_000))
    start = train.system
    ranging = train.ranging()
    assert ranging == Ranging(True, 2_000_000, 20_000, 0)
    train.step("run_a_cycle", to_um=start.way_um - 2_000_000, pace_um=2_000_000)
    assert train.step("arrive") == start
    train.decide(NOTHING)
    held = train.system
    assert train.step("decide", ranging=ranging) == held
    for event in (
        {"to_um": start.way_um - 2_010_001, "pace_um": 2_000_000},
        {"to_um": start.way_um, "pace_um": 2_010_001},
    ):
        assert train.step("run_a_cycle", **event) == held
    train.step("run_a_cycle", to_um=start.way_um - 2_010_000, pace_um=2_000_000)
    assert train.system.way_um == start.way_um - 2_010_000, "faster on the way than at its end"
    train.range()
    train.decide(NOTHING)
    train.run(2_010_000)
    held, ranging = train.system, train.ranging()
    for other in (
        Ranging(True, ranging.way_mm + 1, ranging.speed_mm_s, 1),
        Ranging(True, ranging.way_mm, ranging.speed_mm_s - 1, 1),
        Ranging(True, ranging.way_mm, ranging.speed_mm_s, 0),
    ):
        assert train.step("decide", ranging=other) == held
    fast = Train(contacted(2_000_000, 30_000))
    fast.decide()
    held = fast.system
    for to_um, pace_um in ((held.way_um, 3_000_001), (held.way_um - 3_000_001, 3_000_000)):
        assert fast.step("run_a_cycle", to_um=to_um, pace_um=pace_um) == held


def what_contradicts_is_too_far_or_gains_too_much() -> None:
    """Between two rangings of this line: each by itself is enough; one of a time to come is none (X1, X2)."""
    one = Ranging(True, 2_000_000, 20_000, 0)
    for other, both in (
        (one, True),
        (replace(one, way_mm=2_000_001), True),
        (replace(one, way_mm=2_000_002), False),
        (replace(one, speed_mm_s=20_001), True),
        (replace(one, speed_mm_s=20_002), False),
    ):
        assert cannot_both_be(SITE, one, other) is not both
    assert is_of_this_line(BOUNDS, one)
    assert not is_of_this_line(BOUNDS, replace(one, age_cycles=-1))


WITNESSES = (
    what_contradicts_is_too_far_or_gains_too_much,
    at_the_lines_speed_the_warning_time_is_met_to_the_cycle,
    gaining_all_the_way_the_warning_time_is_met_to_the_cycle,
    a_slow_train_is_warned_of_later,
    a_train_that_stops_short_asks_for_no_warning,
    a_train_that_reverses_may_turn_again,
    who_turns_back_before_its_start_point_is_let_go,
    contact_begins_with_nobody_who_runs_away,
    who_was_warned_of_is_not_let_go_as_it_turns_back,
    a_warning_once_begun_is_kept,
    lost_ranging_warns_at_once,
    without_rangings_the_worst_is_reckoned_with,
    a_ranging_again_takes_the_place_of_the_worst,
    a_late_ranging_is_shortened_by_its_age,
    a_radio_that_hangs_is_silent,
    who_stands_is_where_it_was,
    a_ranging_that_contradicts_the_one_before_warns_now,
    an_older_ranging_is_held_against_the_one_before_as_well,
    what_does_not_count_contradicts_nothing,
    what_is_out_of_range_does_not_count,
    every_number_fits_into_64_bits,
    by_its_ceiling_the_warning_time_is_met_to_the_cycle,
    who_promises_nothing_is_held_to_the_lines_speed,
    to_go_faster_takes_an_acknowledgement,
    no_ceiling_is_promised_that_is_not_kept,
    what_nature_does_not_do_does_not_happen,
)
