"""One train that starts, runs, reads a tag and stops before its end, and what its computer is told (P7, T5, T12)."""

from __future__ import annotations

from dataclasses import replace

from kernel.onboard import braking, computer, odometry, split
from kernel.onboard.brake_demand import TrainLimits
from kernel.onboard.braking import BrakeBounds
from kernel.onboard.limits import Limits
from kernel.onboard.odometry import Readings
from kernel.onboard.reverse_movement import LOCATED, Movement, ReverseLimits
from kernel.onboard.speed_limit import UNKNOWN as NO_TRACK_KNOWN
from kernel.onboard.speed_limit import SpeedLimit, SpeedTable
from kernel.onboard.split import Acceleration, SplitLimits
from kernel.onboard.split import Readings as TailReadings
from kernel.onboard.tag_fix import TagLimits
from kernel.onboard.tag_window import NONE_AWAITED, Window, WindowLimits
from kernel.onboard.way import UNKNOWN, Way
from models.onboard.brake_watch import Watched
from models.onboard.braking import Approach
from models.onboard.train_nature import (
    Train,
    Whole,
    a_brake_that_has_responded_keeps_its_bound,
    a_rolling_wheel_measures,
)
from models.onboard.units import NM_A_MM
from proofs.onboard.train import THEORY, the_train_stands_held_by_its_brake
from proofs.onboard.witnesses.play import Play
from proofs.onboard.witnesses.rolling_stock import AT_POWER_ON, BOUNDS, START_MM

BRAKE = BrakeBounds(gains_mm_s2=1_300, slows_mm_s2=700, response_cycles=3, standstill_mm_s=50)
LIMITS = Limits(
    sensors=BOUNDS,
    train=TrainLimits(BRAKE, SpeedTable(40_000, 20_000, 15_000), 133_000),
    reverse=ReverseLimits(2_000),
    split=SplitLimits(500, 3_000, 500, 600, 1_000, 10_000),
    window=WindowLimits(2_000, 3_000),
    tags=TagLimits(4_000, 700),
)
SITE = Train(LIMITS, jolt_mm_s2=1_150, pace_cycles=8, length_mm=120_000, laid_within_mm=200, read_within_mm=500)
END_MM = START_MM + 400_000
LEVEL = Acceleration(0, True)
TAIL = TailReadings(LEVEL, True, LEVEL, LEVEL, 200)
SHOWN_MM = AT_POWER_ON.motion.way_mm


def at_rest() -> Whole:
    """A train that stands where it was located, its brake holding it."""
    begun = computer.put_into_service(LIMITS, START_MM - 1_000, START_MM + 1_000)
    motion = odometry.located(START_MM - 1_000, START_MM + 1_000, SHOWN_MM)
    watch = replace(begun.known.watch, cycles=BRAKE.response_cycles)
    known = replace(begun.known, motion=motion, watch=watch)
    front_nm = AT_POWER_ON.front_nm
    return Whole(
        front_nm=front_nm,
        speed_um_s=0,
        from_nm=front_nm,
        from_um_s=0,
        runs=False,
        running=AT_POWER_ON,
        approach=Approach(front_nm, 0, 0, 0, front_nm, 0, False, False, begun.brake, False, 0),
        watched=Watched(0, BRAKE.response_cycles, True, 0, False, watch),
        computer=replace(begun, known=known, before=odometry.past(motion)),
    )


class Ride(Play[Train, Whole]):
    """A train whose wheel rolls and whose sensors show what is so."""

    def __init__(self) -> None:
        """Begin at rest."""
        super().__init__(THEORY, SITE, at_rest())
        self.wheel_nm = SHOWN_MM * NM_A_MM

    def run(self, speed_mm_s: int, *, acknowledged: bool = False, may_proceed: bool = True) -> None:
        """Begin a cycle, and run evenly to a speed in it."""
        from_um_s, speed_um_s = self.system.speed_um_s, 1_000 * speed_mm_s
        self.wheel_nm += 50 * (from_um_s + speed_um_s)
        to_nm = self.system.front_nm + 50 * (from_um_s + speed_um_s)
        event = {"may_proceed": may_proceed, "acknowledged": acknowledged, "to_nm": to_nm, "speed_um_s": speed_um_s}
        self.step("run_a_cycle", **event)
        assert self.system.runs
        assert (self.system.front_nm, self.system.speed_um_s) == (to_nm, speed_um_s)

    def sense(self) -> None:
        """End it, with what the sensors show."""
        now = self.system
        shown, felt = now.speed_um_s // 1_000, (now.speed_um_s - now.from_um_s) // 100
        readings = Readings(100, True, shown, self.wheel_nm // NM_A_MM, True, felt)
        self.step("sense_the_cycle", readings=readings, tail=TAIL, gradient_mm_s2=0, slips=False, sticks=False)
        assert not self.system.runs

    def cycle(self, speed_mm_s: int, *, acknowledged: bool = False, may_proceed: bool = True) -> None:
        """Begin it and end it."""
        self.run(speed_mm_s, acknowledged=acknowledged, may_proceed=may_proceed)
        self.sense()

    def start(self) -> None:
        """Stand until its wheel is trusted, take an end and release the brake."""
        for _ in range(20):
            self.cycle(0)
        self.step("take_end", end_mm=END_MM)
        self.cycle(0, acknowledged=True)
        assert not self.system.computer.brake.applied

    def gather(self, to_mm_s: int) -> None:
        """Gather speed."""
        while self.system.speed_um_s < 1_000 * to_mm_s:
            self.cycle(self.system.speed_um_s // 1_000 + 100)

    def stop(self) -> None:
        """Let the brake stop it, as little as is guaranteed, once it has responded."""
        while self.system.speed_um_s:
            responded = self.system.watched.cycles >= BRAKE.response_cycles
            speed_mm_s = self.system.speed_um_s // 1_000
            self.cycle(max(0, speed_mm_s - 70) if responded else speed_mm_s)
            assert self.system.computer.brake.applied

    def draw_up(self) -> None:
        """Run a little and let the driver stop it, until its brake holds it."""
        self.gather(3_000)
        self.step("withhold_end")
        self.stop()
        for _ in range(5):
            self.cycle(0, may_proceed=False)


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
    lies_nm = read_at_nm - (4_000 + 300) * NM_A_MM
    place_mm = lies_nm // NM_A_MM + 100
    ride.step("read_a_tag", place_mm=place_mm, lies_nm=lies_nm, read_at_nm=read_at_nm)
    narrow = ride.system.computer.known.motion
    assert narrow.front_most_mm - narrow.front_least_mm < wide.front_most_mm - wide.front_least_mm
    ride.cycle(10_000)


def a_tag_read_elsewhere_is_none_of_this_world() -> None:
    """One that lies off its place, is read from afar, or before the newest cycle (T1, T2, T16)."""
    ride = Ride()
    ride.start()
    ride.gather(10_000)
    ride.cycle(10_000)
    front_nm = ride.system.front_nm
    lies_nm = front_nm - 4_000 * NM_A_MM
    for off_mm, afar_mm, late_mm in ((201, 0, 0), (0, 501, 0), (0, 0, 1_100)):
        read_at_nm = front_nm - late_mm * NM_A_MM
        lies_here_nm = lies_nm - (afar_mm + late_mm) * NM_A_MM
        before = ride.system
        ride.step("read_a_tag", place_mm=lies_here_nm // NM_A_MM + off_mm, lies_nm=lies_here_nm, read_at_nm=read_at_nm)
        assert ride.system == before


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
    ride.step("read_a_tag", place_mm=at_mm - 4_000, lies_nm=front_nm - 4_000 * NM_A_MM, read_at_nm=front_nm)
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
    way = Way(True, 1, 2)
    ride.system = replace(
        ride.system,
        approach=replace(ride.system.approach, wanted=True),
        watched=replace(ride.system.watched, allowed_mm_s=9),
        computer=replace(ride.system.computer, known=known, way_began=way),
    )
    front_mm = ride.system.front_nm // NM_A_MM
    ride.step("locate_anew", least_mm=front_mm - 2_000, most_mm=front_mm + 2_000)
    anew = ride.system.computer
    assert computer.place(anew) == Way(True, front_mm - 2_000, front_mm + 2_000)
    assert anew.brake == braking.stand_still(front_mm + 2_000)
    assert anew.way_began == UNKNOWN
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
    tag = {
        "place_mm": front_mm - 4_000,
        "lies_nm": front_nm - 4_000 * NM_A_MM,
        "read_at_nm": front_nm,
    }
    ride.step("locate_anew", least_mm=front_mm - 2_000, most_mm=front_mm + 2_000)
    located = ride.system
    ride.step("read_a_tag", **tag)
    assert ride.system == located
    ride.cycle(0)
    ride.step("read_a_tag", **tag)
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
    """At rest, found whole, its brake on, no tag awaited; whatever was known before its restart (P5, P7, T8)."""
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
    ride.system = replace(ride.system, watched=replace(ride.system.watched, kept=False, too_fast=True))
    ride.step("put_into_service", least_mm=front_mm + 1, most_mm=most_mm)
    assert not ride.system.watched.kept
    ride.step("put_into_service", least_mm=least_mm, most_mm=most_mm)
    assert the_train_stands_held_by_its_brake(SITE, ride.system)
    begun = ride.system.computer
    assert begun.known.motion == odometry.located(least_mm, most_mm, 0)
    assert begun.before == odometry.past(begun.known.motion)
    assert (begun.known.watch.limit_mm_s, begun.known.watch.cycles, begun.known.watch.broken) == (0, 0, False)
    assert begun.known.movement == LOCATED
    assert begun.known.wholeness == split.made_up(LIMITS.split)
    assert begun.known.window == NONE_AWAITED
    assert begun.brake == braking.stand_still(most_mm)
    assert begun.way_began == UNKNOWN
    ride.cycle(0)


def a_released_brake_counts_no_cycle() -> None:
    """However long the watch says that it was on (T12)."""
    held = at_rest().computer
    assert computer.standstill(LIMITS, held).braked_cycles == BRAKE.response_cycles
    released = replace(held, brake=replace(held.brake, applied=False))
    assert computer.standstill(LIMITS, released).braked_cycles == 0


def a_computer_is_told_of_tags_and_of_its_train() -> None:
    """Which tag it awaits from where, that it awaits none, and that staff has found the train whole (T5, P5)."""
    ride = Ride()
    way = Way(True, 5, 6)
    ride.step("await_tag", at=way, least_mm=100, most_mm=200)
    assert ride.system.computer.way_began == way
    assert ride.system.computer.known.window == Window(expected=True, least_mm=100, most_mm=200, passed=False)
    ride.step("await_none")
    assert ride.system.computer.known.window == NONE_AWAITED
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
    assert a_brake_that_has_responded_keeps_its_bound(SITE, runs, True, 9_930_000)
    assert not a_brake_that_has_responded_keeps_its_bound(SITE, runs, True, 9_930_001)


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
    a_tag_read_elsewhere_is_none_of_this_world,
    an_order_that_stops_it_brakes_it,
    an_end_is_withheld_at_any_moment,
    a_cycle_is_run_and_sensed_in_turn,
    a_train_located_anew_begins_as_at_the_start,
    a_tag_told_after_the_train_was_located_anew_says_nothing,
    a_train_whose_brake_has_yet_to_hold_it_is_not_located,
    a_computer_put_into_service_knows_where_it_stands_and_no_more,
    a_released_brake_counts_no_cycle,
    a_computer_is_told_of_tags_and_of_its_train,
    a_brake_is_asked_for_nothing_before_it_has_responded,
    a_wheel_that_slips_or_is_not_read_shows_what_it_likes,
)
