"""One train at rest: what staff finds of it, and what holds it there (P5, T12, T13)."""

from __future__ import annotations

from dataclasses import replace

from kernel.onboard import antenna_spacing, computer, split, tag_reader
from kernel.onboard.odometry import Loss
from kernel.onboard.split import Acceleration
from kernel.onboard.tag_reader import NO_FRAME, Level
from kernel.standstill import is_held
from models.onboard.units import NM_A_MM
from proofs.onboard.witnesses.one_train import AT_THE_HEAD, AT_THE_TAIL, BRAKE, END_MM, LIMITS, TAIL, Ride

SHAKEN = replace(TAIL, left=Acceleration(-20_000, True), right=Acceleration(-20_000, True))
"""What the tail shows where a train comes apart."""


def a_train_that_is_not_held_is_not_found_whole() -> None:
    """A split that was seen brakes it until it stands, whatever is said; so does an antenna that failed stay deaf."""
    ride = Ride()
    ride.start()
    ride.gather(5_000)
    ride.run(5_000)
    ride.sense(tail=SHAKEN)
    at = {"frame": NO_FRAME, "level": Level(0, True), "below": NO_FRAME, "sick": True, "at_nm": ride.system.front_nm}
    ride.step(AT_THE_HEAD, **at)
    ride.step(AT_THE_TAIL, **at)
    said(ride, is_taken=False)
    while ride.system.speed_um_s:
        responded = ride.system.watched.cycles >= BRAKE.response_cycles
        ride.cycle(max(0, ride.system.speed_um_s // 1_000 - 70) if responded else 5_000)
        assert ride.system.computer.brake.applied
        if not is_held(computer.at_rest(LIMITS, ride.system.computer)):
            said(ride, is_taken=False)
    ride.stand_until_held()
    assert has_split(ride)
    said(ride, is_taken=True)
    assert not has_split(ride)
    assert ride.system.computer.head == ride.system.computer.tail == tag_reader.mended()


def has_split(ride: Ride) -> bool:
    """Tell whether its computer takes it for split."""
    return ride.system.computer.known.wholeness.split


def counts_as_broken(ride: Ride) -> bool:
    """Tell whether its computer takes a bound of motors or brake for broken."""
    return ride.system.computer.known.watch.broken


def is_braked(ride: Ride) -> bool:
    """Tell whether its brake is on."""
    return ride.system.computer.brake.applied


def said(ride: Ride, *, is_taken: bool) -> None:
    """Somebody says that the train is whole, and that motors and brake and both antennas are sound."""
    for word in ("find_whole", "inspect_the_brake", "mend_the_heads_antenna", "mend_the_tails_antenna"):
        before = ride.system
        ride.step(word)
        assert (ride.system != before) is is_taken


def a_split_is_not_forgotten_when_the_computer_is_switched_off_and_on() -> None:
    """It counts as split, and its brake stays on, however long its tail is heard, until staff has found it whole."""
    ride = Ride()
    ride.start()
    ride.run(100)
    ride.sense(tail=SHAKEN)
    ride.step("withhold_end")
    ride.stop()
    ride.stand_until_held()
    front_mm = ride.system.front_nm // NM_A_MM
    ride.step("put_into_service", least_mm=front_mm - 1_000, most_mm=front_mm + 1_000)
    assert ride.system.computer.spacing == antenna_spacing.restarted()
    ride.stand_until_held()
    ride.step("take_end", end_mm=END_MM)
    for _ in range(2 * split.SAMPLES):
        ride.cycle(0, acknowledged=True)
    assert has_split(ride)
    assert is_braked(ride)
    ride.step("inspect_the_brake")
    ride.step("find_whole")
    assert not has_split(ride)
    assert ride.system.computer.spacing == antenna_spacing.preset(LIMITS.antennas_mm)
    ride.cycle(0, acknowledged=True)
    assert not is_braked(ride)
    assert not computer.through_line(LIMITS, ride.system.computer, True).is_intact
    for _ in range(split.SAMPLES):
        ride.cycle(0)
    assert computer.through_line(LIMITS, ride.system.computer, True).is_intact


def a_broken_bound_is_not_forgotten_when_the_computer_is_switched_off_and_on() -> None:
    """Its brake stays on, whatever the orders let it do, until staff has inspected motors and brake (T8, T12)."""
    ride = Ride()
    ride.start()
    ride.gather(2_000)
    ride.step("withhold_end")
    ride.stop()
    ride.stand_until_held()
    front_mm = ride.system.front_nm // NM_A_MM
    ride.step("put_into_service", least_mm=front_mm - 1_000, most_mm=front_mm + 1_000)
    ride.stand_until_held()
    for word in ("find_whole", "mend_the_heads_antenna", "mend_the_tails_antenna"):
        ride.step(word)
    ride.step("take_end", end_mm=END_MM)
    for _ in range(2 * split.SAMPLES):
        ride.cycle(0, acknowledged=True)
    assert counts_as_broken(ride)
    assert is_braked(ride)
    assert computer.standstill(LIMITS, ride.system.computer).braked_cycles == 0, "a weak brake holds nobody"
    ride.run(0, may_proceed=False)
    running = ride.system
    assert ride.step("inspect_the_brake") == running, "nobody inspects a train within a cycle"
    ride.sense()
    ride.step("inspect_the_brake")
    assert not counts_as_broken(ride)
    ride.cycle(0, acknowledged=True)
    assert not is_braked(ride)


def nobody_locates_a_train_that_is_known_to_move() -> None:
    """Forward or back, and whatever its brake is reckoned to have done; one whose speed is not known may stand (T8)."""
    ride = Ride()
    ride.stand_until_held()
    here, slow_mm_s = ride.system.computer, BRAKE.standstill_mm_s
    for least_mm_s, most_mm_s, loss, is_located in (
        (slow_mm_s + 1, 9_000, Loss.NONE, False),
        (-9_000, -slow_mm_s - 1, Loss.NONE, False),
        (slow_mm_s, 9_000, Loss.NONE, True),
        (-9_000, -slow_mm_s, Loss.NONE, True),
        (slow_mm_s + 1, 9_000, Loss.CONTRADICTED, True),
    ):
        motion = replace(here.known.motion, speed_least_mm_s=least_mm_s, speed_most_mm_s=most_mm_s, loss=loss)
        told = replace(here, known=replace(here.known, motion=motion))
        assert (computer.locate(LIMITS, told, 0, 1_000) != told) is is_located


def the_order_in_which_two_places_are_named_says_nothing() -> None:
    """Where kilometrage falls the farther one is named first (P7, T8)."""
    ride = Ride()
    ride.stand_until_held()
    front_mm = ride.system.front_nm // NM_A_MM
    for word, within_mm in (("note_place", 500), ("locate_anew", 700), ("put_into_service", 900)):
        ride.step(word, least_mm=front_mm + within_mm, most_mm=front_mm - within_mm)
        motion = ride.system.computer.known.motion
        assert (motion.front_least_mm, motion.front_most_mm) == (front_mm - within_mm, front_mm + within_mm)


def a_train_that_came_to_rest_withheld_stays_until_it_takes_an_end() -> None:
    """No sooner than its brake holds it, nor of a brake that an acknowledgement releases (T8, T12)."""
    ride = Ride()
    ride.start()
    ride.step("withhold_end")
    for _ in range(BRAKE.response_cycles - 1):
        ride.cycle(0, may_proceed=False)
    ride.step("come_to_rest")
    assert not stays(ride), "its brake has yet to respond"
    ride.cycle(0, may_proceed=False)
    ride.step("take_end", end_mm=END_MM)
    ride.step("come_to_rest")
    assert not stays(ride), "an acknowledgement releases it"
    ride.step("withhold_end")
    ride.step("come_to_rest")
    assert stays(ride)
    ride.cycle(0, acknowledged=True)
    assert ride.system.computer.brake.applied
    ride.step("take_end", end_mm=END_MM)
    assert not stays(ride)


def stays(ride: Ride) -> bool:
    """Tell whether no end has freed it."""
    return ride.system.held


WITNESSES = (
    a_train_that_is_not_held_is_not_found_whole,
    a_split_is_not_forgotten_when_the_computer_is_switched_off_and_on,
    a_broken_bound_is_not_forgotten_when_the_computer_is_switched_off_and_on,
    nobody_locates_a_train_that_is_known_to_move,
    the_order_in_which_two_places_are_named_says_nothing,
    a_train_that_came_to_rest_withheld_stays_until_it_takes_an_end,
)
