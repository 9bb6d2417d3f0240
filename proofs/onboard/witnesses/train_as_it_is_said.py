"""One train and what a person says of where its front is, who sees it stand, or saw it (P7, T8)."""

from __future__ import annotations

from dataclasses import replace

from models.onboard.units import NM_A_MM
from proofs.onboard.witnesses.one_train import BRAKE, END_MM, SITE, Ride


def a_train_that_is_said_to_be_beyond_a_board_keeps_its_trust() -> None:
    """The range is narrowed by what is said of a train at rest, and of no other place than where it is (P7, T8)."""
    ride = Ride()
    ride.start()
    ride.draw_up()
    front_mm = ride.system.front_nm // NM_A_MM
    before = ride.system
    ride.step("note_place", least_mm=front_mm + 1, most_mm=front_mm + 2_000)
    assert ride.system == before
    ride.step("note_place", least_mm=front_mm, most_mm=front_mm + 10**6)
    said = ride.system.computer
    assert said.known.motion.front_least_mm == front_mm
    assert said.known.motion.front_most_mm == before.computer.known.motion.front_most_mm
    assert said.known.motion.trusted == before.computer.known.motion.trusted
    assert said == replace(before.computer, known=replace(before.computer.known, motion=said.known.motion))
    ride.cycle(0)
    assert front_mm - ride.system.computer.known.motion.front_least_mm <= SITE.limits.sensors.pulse_mm + 1
    assert ride.system.computer.known.motion.trusted


def nothing_is_said_of_a_train_that_runs() -> None:
    """Nobody sees it stand, and what was said before a cycle counts before it is sensed (P7, T8)."""
    ride = Ride()
    ride.start()
    ride.run(100)
    at_mm = ride.system.front_nm // NM_A_MM
    under_way = ride.system
    ride.step("note_place", least_mm=at_mm - 1_000, most_mm=at_mm + 1_000)
    assert ride.system is under_way


def what_is_said_too_late_of_a_train_is_not_taken() -> None:
    """It was held when somebody saw it, and runs when he has said so; or it stands, and its brake is off (P7, T8)."""
    ride = Ride()
    ride.start()
    ride.draw_up()
    least_mm = ride.system.computer.known.motion.front_least_mm
    seen_mm = ride.system.front_nm // NM_A_MM
    ride.step("take_end", end_mm=END_MM)
    ride.cycle(0, acknowledged=True)
    for to_mm_s in (0, 3_000):
        ride.gather(to_mm_s)
        before = ride.system
        ride.step("note_place", least_mm=least_mm, most_mm=seen_mm + 1)
        assert ride.system == before
    ride.step("withhold_end")
    for _ in range(BRAKE.response_cycles):
        ride.cycle(3_000)
    before = ride.system
    ride.step("note_place", least_mm=least_mm, most_mm=seen_mm + 1)
    assert ride.system == before, "a brake that has responded does not hold it at rest yet"


def a_feature_narrows_the_range_of_a_train_that_runs() -> None:
    """A fix that contains the front is taken under way, and no other; nothing else is changed by it (P2, P3, P7)."""
    ride = Ride()
    ride.start()
    ride.run(100)
    running = ride.system
    ride.step("recognise_a_feature", least_mm=0, most_mm=10**9)
    assert ride.system is running, "within a cycle nothing is recognised: its readings are yet to come"
    ride.sense()
    before, front_mm = ride.system, ride.system.front_nm // NM_A_MM
    for least_mm, most_mm in ((front_mm + 1, front_mm + 1_000), (front_mm - 1_000, front_mm - 1)):
        ride.step("recognise_a_feature", least_mm=least_mm, most_mm=most_mm)
        assert ride.system == before, "the front is not there"
    ride.step("recognise_a_feature", least_mm=front_mm, most_mm=front_mm + 1)
    motion = replace(
        before.computer.known.motion,
        front_least_mm=front_mm,
        front_most_mm=front_mm + 1,
        anchor_least_mm=front_mm,
        anchor_most_mm=front_mm + 1,
        anchor_way_mm=before.computer.known.motion.way_mm,
    )
    assert ride.system.computer == replace(before.computer, known=replace(before.computer.known, motion=motion))
