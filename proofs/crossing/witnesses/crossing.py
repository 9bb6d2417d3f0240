"""Trains on two tracks, with radio and without, close together, turning back and parting (X2 to X5)."""

from __future__ import annotations

from kernel.crossing import crossing as machine
from kernel.crossing.arrival import ArrivalBounds, Followed
from kernel.crossing.crossing import Crossing, CrossingTrack, Due, Settings
from models.crossing import crossing as world
from proofs.crossing.witnesses import restarts, starts
from proofs.crossing.witnesses.crossing_day import DOWN, ONE, SETTINGS, THREE, TWO, UP, Day
from proofs.onboard.witnesses.sixty_four_bits import Checked, with_ints

FAR, NEAR, NOW = Due.FAR, Due.NEAR, Due.NOW

# ---- trains in contact, and without


def a_train_in_contact_is_warned_of_when_it_is_due() -> None:
    """Not at its start point, and not while it is near: when its answer is now (X2, X4, X5)."""
    day = Day()
    day.come(ONE)
    day.strike(ONE)
    for due in (FAR, NEAR, NEAR):
        day.cycle((ONE, due))
        assert not day.warns()
        assert not day.system.bodies[ONE].has_asked
    assert day.system.bodies[ONE].left_cycles == 59
    for _ in range(18):
        day.cycle((ONE, NEAR))
    assert day.system.bodies[ONE].left_cycles == 41
    day.cycle((ONE, NOW))
    assert day.warns()
    assert day.system.bodies[ONE].has_asked
    assert day.until_it_can_arrive(ONE, (ONE, NOW)) == 40
    arrived = day.arrive(ONE)
    assert (arrived.warned_cycles, arrived.down_cycles) == (41, 26)
    day.cycle()
    assert day.warns()
    day.pass_by(ONE)
    assert day.warns()
    day.cycle()
    assert (day.warns(), day.system.lowered_cycles, day.system.opened_cycles) == (False, 0, 1)
    assert (day.system.are_down, day.system.down_cycles) == (False, 0)


def a_train_without_radio_is_warned_of_from_its_start_point() -> None:
    """At the line's speed it arrives the warning time later, and what a terminal may be silent (X3)."""
    day = Day()
    day.come(ONE, contact=False)
    day.cycle()
    day.strike(ONE)
    day.step("hear_strike", train=ONE)
    assert day.system.crossing.asks[ONE] is True
    day.step("make_contact", train=ONE)
    assert day.system.crossing.asks[ONE] is True
    day.cycle((ONE, FAR))
    assert day.warns()
    assert day.system.bodies[ONE].was_struck
    assert day.system.bodies[ONE].has_asked
    day.until_it_can_arrive(ONE)
    assert day.arrive(ONE).warned_cycles == 62
    day = Day()
    day.come_without_radio(ONE)
    day.until_it_can_arrive(ONE)
    assert day.arrive(ONE).warned_cycles == 44


def a_start_point_leaves_trains_in_contact_alone() -> None:
    """Even if its terminal tells of them (003, 2.3; X3)."""
    day = Day()
    day.come(ONE)
    day.cycle((ONE, FAR))
    day.strike(ONE)
    day.step("hear_strike", train=ONE)
    day.cycle((ONE, FAR))
    assert not day.warns()
    day.step("hear_strike", train=TWO)
    day.cycle((ONE, FAR), (TWO, FAR))
    assert day.warns()


def no_answer_is_as_good_as_now() -> None:
    """A train in contact whose reckoning did not come (X2, X3)."""
    day = Day()
    day.come(ONE)
    day.cycle((ONE, FAR))
    assert not day.warns()
    day.cycle()
    assert day.warns()
    assert machine.told({}, ONE) == NOW


def who_asked_goes_on_asking() -> None:
    """A train that stops short after it was warned of may start again (X4)."""
    day = Day()
    day.come(ONE)
    day.cycle((ONE, NOW))
    for _ in range(30):
        day.cycle((ONE, FAR))
        assert day.warns()
    assert day.system.crossing.asks[ONE]
    assert day.system.bodies[ONE].has_asked


# ---- the end of a warning


def arms_stay_down_for_a_train_that_is_near() -> None:
    """And are let up when all are far; who was near then arrives no sooner than opening and warning (X4, X5)."""
    day = Day()
    day.come(ONE)
    day.come(TWO, DOWN)
    day.cycle((ONE, NOW), (TWO, FAR))
    day.pass_by(ONE)
    for _ in range(20):
        day.cycle((TWO, NEAR))
        assert day.warns()
    assert day.system.are_down
    day.come(THREE, DOWN, contact=False)
    day.cycle((TWO, FAR))
    assert not day.warns()
    assert (day.system.bodies[TWO].was_known, day.system.bodies[THREE].was_known) == (True, False)
    day.strike(TWO)
    for _ in range(20):
        day.cycle((TWO, NEAR))
        assert not day.warns()
    day.cycle((TWO, NOW))
    day.until_it_can_arrive(TWO, (TWO, NOW))
    assert day.arrive(TWO).opened_cycles == 62


def a_train_that_comes_after_the_opening_was_not_known() -> None:
    """Nor is one that has gone: each opening looks anew (X4)."""
    day = Day()
    day.come(ONE)
    day.cycle((ONE, NOW))
    day.pass_by(ONE)
    day.come(TWO)
    day.cycle((TWO, FAR))
    assert day.system.bodies[TWO].was_known
    day.cycle((TWO, FAR), heard=())
    assert (day.system.bodies[TWO].was_known, day.system.opened_cycles) == (True, 2)


def a_train_that_turned_back_ends_its_warning_by_the_start_tag() -> None:
    """Its tail has read it from behind: out of the approach (X4, T14)."""
    day = Day()
    day.come(ONE)
    day.strike(ONE)
    day.cycle((ONE, NOW))
    before = day.system
    assert day.step("tell_gone", gone=ONE, number=day.number(ONE), is_whole=True) == before
    day.pass_by(ONE)
    day.cycle()
    assert not day.warns()


def who_turns_back_before_its_start_point_is_forgotten() -> None:
    """It has struck nothing; when it comes again it strikes, and a word of before ends no warning (X3, X4)."""
    day = Day()
    day.come(ONE)
    day.come(TWO)
    day.step("hear_strike", train=THREE)
    old, number = day.number(ONE), day.system.crossing.number
    day.cycle((ONE, NOW), (TWO, FAR))
    assert day.system.bodies[ONE].has_asked
    others = day.system.bodies[TWO]
    turned = day.step("tell_gone", gone=ONE, number=old, is_whole=True)
    assert (turned.bodies[ONE].came_at, turned.bodies[ONE].has_asked) == (number + 1, False)
    assert turned.bodies[TWO] == others
    assert not [known for known in (turned.told, turned.crossing.asks, turned.crossing.numbers) if ONE in known]
    day.strike(ONE)
    day.step("hear_strike", train=ONE)
    assert (day.number(ONE), day.system.crossing.asks[ONE]) == (number + 1, True)
    struck = day.system
    assert day.step("tell_gone", gone=ONE, number=old, is_whole=True) == struck, "late, and again"


def who_struck_nothing_and_is_told_gone_has_not_been_told_of() -> None:
    """A strike that was put down to a train before its start point is over as well, and counts no more (X3, X4)."""
    day = Day()
    day.come(ONE, contact=False)
    day.step("hear_strike", train=ONE)
    assert day.system.bodies[ONE].was_struck
    assert not day.step("tell_gone", gone=ONE, number=day.number(ONE), is_whole=True).bodies[ONE].was_struck


def a_word_of_the_run_before_ends_no_warning() -> None:
    """A train is told gone and comes once more under its name; then it is told gone again, or released, late (X4)."""
    day = Day()
    day.come(ONE)
    old = day.number(ONE)
    assert old == day.system.crossing.number == day.system.told[ONE]
    day.cycle((ONE, NOW))
    day.pass_by(ONE)
    assert day.number(ONE) == machine.NONE
    day.come(ONE, contact=False)
    day.strike(ONE)
    there = day.system
    assert day.step("tell_gone", gone=ONE, number=old, is_whole=True) == there
    day.step("hear_strike", train=ONE)
    assert day.number(ONE) == day.system.crossing.number == old + 1
    there = day.system
    assert day.step("tell_gone", gone=ONE, number=old, is_whole=True) == there
    assert day.step("release", gone=ONE, number=old) == there
    day.step("ask_to_start", train=ONE, run_cycles=9)
    assert day.number(ONE) == old + 1
    there = day.system
    assert day.step("tell_gone", gone=ONE, number=old, is_whole=True) == there
    assert day.step("release", gone=ONE, number=old) == there
    day.cycle()
    assert day.warns()
    day.pass_by(ONE)
    day.step("ask_to_start", train=TWO, run_cycles=9)
    assert day.number(TWO) == day.system.told[TWO] == old + 2


def a_part_left_behind_keeps_the_warning() -> None:
    """The rear read the tag, but the train is not whole; a person releases it after what is left was fetched (X4)."""
    day = Day()
    day.come(ONE)
    day.cycle((ONE, NOW))
    day.step("tell_gone", gone=ONE, number=day.number(ONE), is_whole=False)
    assert ONE in day.system.crossing.asks
    day.cycle((ONE, FAR))
    assert day.warns()
    before = day.system
    assert day.step("release", gone=ONE, number=day.number(ONE)) == before
    day.step("leave", gone=ONE)
    day.step("release", gone=ONE, number=day.number(ONE))
    assert ONE not in day.system.crossing.asks
    day.cycle()
    assert not day.warns()


def one_of_two_that_is_gone_leaves_the_other() -> None:
    """On another track (X4)."""
    day = Day()
    day.come(ONE)
    day.come(TWO, DOWN)
    day.cycle((ONE, NOW), (TWO, NOW))
    day.pass_by(ONE)
    assert TWO in day.system.bodies
    assert day.system.crossing.asks[TWO]
    day.cycle((TWO, NOW))
    assert day.warns()


# ---- terminals


def silence_of_a_start_point_warns() -> None:
    """In the third cycle here, and until it is heard again (X3, T14)."""
    day = Day()
    for silent in (1, 2):
        day.cycle(heard=(UP,))
        assert (day.system.crossing.silent_cycles, day.warns()) == ({UP: 1, DOWN: silent}, False)
    for _ in range(5):
        day.cycle(heard=(UP,))
        assert day.warns() == (day.system.unheard_cycles[DOWN] > 3)
    assert day.system.crossing.warned_cycles == 4
    day.cycle()
    assert not day.warns()


def who_came_in_silence_is_told_of_first() -> None:
    """The terminal is not heard before it has told; the warning time is kept to the cycle (X3)."""
    day = Day()
    day.come(ONE, DOWN, contact=False)
    day.strike(ONE)
    for _ in range(3):
        day.cycle(heard=(UP,))
    assert not day.warns()
    before = day.system
    assert day.step("hear_terminal", track=DOWN, age_cycles=0) == before
    day.cycle(heard=(UP,))
    assert day.warns()
    day.step("hear_strike", train=ONE)
    day.cycle()
    while day.system.bodies[ONE].left_cycles > 0:
        day.cycle()
    assert day.arrive(ONE).warned_cycles == 41


def a_word_counts_from_when_its_terminal_spoke() -> None:
    """Under way while a train strikes and the terminal fails; a newer one was heard; of no age; of a new track (X3)."""
    day = Day()
    day.come(ONE, DOWN, contact=False)
    for _ in range(2):
        day.cycle(heard=(UP,))
    day.strike(ONE)
    day.cycle(heard=(UP,))
    before = day.system
    assert (before.unheard_cycles[DOWN], before.bodies[ONE].inside_cycles) == (3, 1)
    for age_cycles in (-1, 0, 1, 3, 50):
        assert day.step("hear_terminal", track=DOWN, age_cycles=age_cycles) == before
    day.step("hear_terminal", track=DOWN, age_cycles=2)
    assert day.system.crossing.silent_cycles[DOWN] == day.system.unheard_cycles[DOWN] == 2
    assert not day.warns()
    day.step("hear_terminal", track=restarts.SIDING, age_cycles=7)
    assert day.system.crossing.silent_cycles[restarts.SIDING] == day.system.unheard_cycles[restarts.SIDING] == 7
    assert day.system.crossing.unaccounted[restarts.SIDING]
    day.step("hear_strike", train=ONE)
    heard = day.system
    assert day.step("hear_terminal", track=DOWN, age_cycles=-1) == heard
    day.step("hear_terminal", track=DOWN, age_cycles=1)
    assert day.system.crossing.silent_cycles[DOWN] == day.system.unheard_cycles[DOWN] == 1
    day.cycle(heard=(UP,))
    assert day.system.crossing.silent_cycles[DOWN] == day.system.unheard_cycles[DOWN] == 2
    assert day.warns()


# ---- arms


def lamps_and_bells_come_first() -> None:
    """Five cycles here; then arms fall, and rise when the warning ends (X5)."""
    day = Day()
    day.come(ONE)
    for cycles in range(1, 20):
        day.cycle((ONE, NOW))
        assert day.system.crossing.warned_cycles == cycles
        assert day.system.lowered_cycles == max(0, cycles - 5)
        assert day.system.are_down == (cycles >= 15)
        assert day.system.down_cycles == max(0, cycles - 15)
    day.cycle((ONE, NOW))
    before = day.system
    day.step("decide", dues={})
    decided = day.system
    assert day.step("run_a_cycle", are_down=False) == decided
    assert before.bodies == decided.bodies


def settings_are_checked() -> None:
    """Each at its edge (X5)."""
    assert Day(SETTINGS).system.in_service
    fastest = Settings(1, 15_002, 1, 1, 15_000, 0, 1, 0, 15_004)
    assert Day(fastest).system.in_service
    for name, value in (
        ("cycle_ms", 0),
        ("warning_cycles", 15_001),
        ("bell_cycles", 0),
        ("bell_cycles", 2),
        ("lowering_cycles", 0),
        ("lowering_cycles", 2),
        ("least_down_cycles", 14_999),
        ("least_down_cycles", 15_001),
        ("lifting_cycles", -1),
        ("lifting_cycles", 1),
        ("reopening_cycles", 0),
        ("silence_cycles", -1),
        ("silence_cycles", 1),
        ("start_cycles", 15_003),
    ):
        day = Day(Settings(**{**vars(fastest), name: value}))
        assert not day.system.in_service
        start = day.system
        assert day.step("come", train=ONE, track=UP, left_cycles=0) == start
        assert day.step("decide", dues={}) == start
        assert day.restart() == start


def a_train_is_far_by_the_longer_time() -> None:
    """At 30 m/s: 2 s later for each second that the road would be open (X2, X4)."""
    bounds = ArrivalBounds(
        line_um=30_000_000,
        gain_um=1_000_000,
        cycle_ms=1_000,
        warning_cycles=40,
        silence_cycles=3,
        way_spread_mm=1,
        speed_spread_mm_s=1,
    )
    for cycles, due in ((42, NOW), (43, NEAR), (62, NEAR), (63, FAR)):
        assert machine.due(bounds, Followed(30_000_000 * cycles, 0, 30_000_000, 0, 0, 0, False), 20) == due
    assert machine.due(bounds, Followed(30_000_000 * 63, 0, 30_000_000, 0, 0, 0, True), 20) == NOW
    assert machine.due(bounds, Followed(30_000_000 * 63, 0, 30_000_000, 4, 0, 0, False), 20) == NOW


def every_number_fits_into_64_bits() -> None:
    """Cycles of a day, of a millisecond (X5)."""
    settings = with_ints(Checked, SETTINGS)
    most = Checked(10**8)
    crossing = Crossing(
        asks={ONE: True},
        starts={},
        silent_cycles={UP: most},
        unaccounted={},
        numbers={ONE: most},
        looks={},
        number=most,
        warns=True,
        warned_cycles=most,
    )
    crossing = machine.aged(machine.decide(settings, crossing, {}))
    assert (crossing.warned_cycles, crossing.silent_cycles[UP]) == (10**8 + 1, 10**8 + 1)
    assert machine.are_lawful(settings)


# ---- nature


def what_nature_does_not_do_does_not_happen() -> None:
    """Each of the assumptions refuses its event (X2 to X5)."""
    day = Day()
    before = day.system
    assert day.step("come", train=ONE, track=CrossingTrack("siding"), left_cycles=0) == before
    for idle in ("pass_start_point", "arrive"):
        assert day.step(idle, train=ONE) == before
    assert day.step("run_a_cycle", are_down=False) == before
    day.step("hear_strike", train=THREE)
    known = day.system
    assert day.step("come", train=THREE, track=UP, left_cycles=0) == known
    day.come(ONE)
    there = day.system
    assert day.step("come", train=ONE, track=DOWN, left_cycles=0) == there
    assert day.step("arrive", train=ONE) == there
    day.come(TWO, contact=False)
    there = day.system
    assert day.step("come", train=TWO, track=DOWN, left_cycles=1) == there
    day.strike(ONE)
    assert TWO in day.system.bodies
    day.cycle((ONE, NEAR), (THREE, FAR))
    inside = day.system
    assert day.step("pass_start_point", train=ONE) == inside
    assert day.step("arrive", train=ONE) == inside
    day.step("decide", dues={ONE: FAR})
    decided = day.system
    assert day.step("decide", dues={ONE: NOW}) == decided
    assert [world.secured_cycles(40, 20, due) for due in (NEAR, FAR)] == [42, 62]


def a_train_that_was_struck_stays_so() -> None:
    """Whatever other train a terminal tells of after it (X3, T14)."""
    day = Day()
    for train in (ONE, TWO):
        day.come(train, contact=False)
        day.strike(train)
    for train in (ONE, TWO):
        day.step("hear_strike", train=train)
    assert day.system.bodies[ONE].was_struck
    assert day.system.bodies[TWO].was_struck


WITNESSES = (
    a_train_that_was_struck_stays_so,
    a_train_in_contact_is_warned_of_when_it_is_due,
    a_train_without_radio_is_warned_of_from_its_start_point,
    a_start_point_leaves_trains_in_contact_alone,
    no_answer_is_as_good_as_now,
    who_asked_goes_on_asking,
    arms_stay_down_for_a_train_that_is_near,
    a_train_that_comes_after_the_opening_was_not_known,
    a_train_that_turned_back_ends_its_warning_by_the_start_tag,
    who_turns_back_before_its_start_point_is_forgotten,
    who_struck_nothing_and_is_told_gone_has_not_been_told_of,
    a_word_of_the_run_before_ends_no_warning,
    a_part_left_behind_keeps_the_warning,
    one_of_two_that_is_gone_leaves_the_other,
    silence_of_a_start_point_warns,
    who_came_in_silence_is_told_of_first,
    a_word_counts_from_when_its_terminal_spoke,
    lamps_and_bells_come_first,
    settings_are_checked,
    a_train_is_far_by_the_longer_time,
    every_number_fits_into_64_bits,
    what_nature_does_not_do_does_not_happen,
    *restarts.WITNESSES,
    *starts.WITNESSES,
)
