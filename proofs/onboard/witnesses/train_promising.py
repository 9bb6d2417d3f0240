"""One train that promises ceilings of speed, and the computer that keeps them (X2, T12)."""

from __future__ import annotations

from dataclasses import replace

from kernel.onboard import ceiling, limits
from kernel.onboard.ceiling import Ceiling
from kernel.onboard.odometry import Readings, is_located
from models.onboard.train_nature import motors_that_are_cut_off_give_nothing
from models.onboard.units import NM_A_MM
from proofs.onboard.witnesses.one_train import BRAKE, SITE, TAIL, Ride


def keeps_to(ride: Ride, ceiling_mm_s: int) -> bool:
    """The train is to keep to this; whether its computer does."""
    ride.step("keep_to", ceiling=Ceiling(ceiling_mm_s))
    return ride.system.computer.known.ceiling == Ceiling(ceiling_mm_s)


def a_train_that_has_promised_is_stopped_before_it_is_faster() -> None:
    """Its driver goes on gathering speed; it stays below, if no more is gained than was written (X2)."""
    ride = Ride()
    ride.start()
    ride.gather(6_000)
    assert not keeps_to(ride, 6_000), "that it could not keep"
    assert keeps_to(ride, 8_000)
    while not ride.system.computer.brake.applied:
        ride.cycle(ride.system.speed_um_s // 1_000 + 100)
    fastest_mm_s = ride.system.speed_um_s // 1_000
    assert 7_000 < fastest_mm_s < 8_000
    ride.stop()
    ride.cycle(0, acknowledged=True)
    assert not ride.system.computer.brake.applied


def a_train_that_is_let_go_runs_faster() -> None:
    """And one that runs below its ceiling is not braked (X2)."""
    ride = Ride()
    ride.start()
    assert keeps_to(ride, 8_000)
    ride.gather(6_500)
    for _ in range(20):
        ride.cycle(6_500)
    assert keeps_to(ride, 20_000)
    ride.gather(12_000)
    assert not ride.system.computer.brake.applied


def a_promise_outlives_a_position_that_was_lost_and_a_restart() -> None:
    """Who does not know its speed promises nothing lower, and may be let go (X2, P7, T8)."""
    ride = Ride()
    ride.start()
    assert keeps_to(ride, 8_000)
    ride.draw_up()
    ride.run(0, may_proceed=False)
    late = Readings(150, True, 0, ride.wheel_nm // NM_A_MM, True, 0)
    ride.step("sense_the_cycle", readings=late, tail=TAIL, gradient_mm_s2=0, slips=False, sticks=False)
    assert not is_located(ride.system.computer.known.motion)
    before = ride.system
    assert not keeps_to(ride, 7_000)
    assert ride.system == before
    assert keeps_to(ride, 9_000)
    front_mm = ride.system.front_nm // NM_A_MM
    ride.step("locate_anew", least_mm=front_mm - 1_000, most_mm=front_mm + 1_000)
    assert ride.system.computer.known.ceiling == Ceiling(9_000)
    ride.step("put_into_service", least_mm=front_mm - 1_000, most_mm=front_mm + 1_000)
    assert ride.system.computer.known.ceiling == Ceiling(9_000)


def a_ceiling_is_told_between_cycles() -> None:
    """Not while the train runs in one that is not sensed yet (P7)."""
    ride = Ride()
    ride.start()
    ride.run(100)
    before = ride.system
    assert not keeps_to(ride, 8_000)
    assert ride.system is before


def motors_are_cut_off_once_the_brake_was_on_for_so_long() -> None:
    """From then on the train gains on a descent alone; before, and with the brake off, motors may pull (T12)."""
    ride = Ride()
    ride.start()
    ride.gather(5_000)
    off = ride.system
    assert motors_that_are_cut_off_give_nothing(SITE, off, False, 10_000_000)
    assert motors_that_are_cut_off_give_nothing(SITE, off, True, 10_000_000), "it is commanded in this cycle"
    ride.cycle(5_000, may_proceed=False)
    cut, most_um_s = ride.system, ride.system.speed_um_s + 102 * BRAKE.falls_mm_s2
    assert cut.watched.cycles == BRAKE.cut_cycles
    assert motors_that_are_cut_off_give_nothing(SITE, cut, False, 10_000_000), "in the cycle in which it is let off"
    assert motors_that_are_cut_off_give_nothing(SITE, cut, True, most_um_s)
    assert not motors_that_are_cut_off_give_nothing(SITE, cut, True, most_um_s + 1)
    event = {"may_proceed": False, "acknowledged": False, "to_nm": cut.front_nm}
    assert ride.step("run_a_cycle", **event, speed_um_s=most_um_s + 1) is cut


def bounds_of_motors_that_are_no_bounds_are_refused() -> None:
    """No computer is put into service by them (T12)."""
    assert limits.is_brake_lawful(BRAKE)
    assert limits.is_brake_lawful(replace(BRAKE, cut_cycles=0, falls_mm_s2=0))
    assert limits.is_brake_lawful(replace(BRAKE, cut_cycles=BRAKE.response_cycles, falls_mm_s2=BRAKE.gains_mm_s2))
    for wrong in (
        replace(BRAKE, cut_cycles=BRAKE.response_cycles + 1),
        replace(BRAKE, cut_cycles=-1),
        replace(BRAKE, falls_mm_s2=BRAKE.gains_mm_s2 + 1),
        replace(BRAKE, falls_mm_s2=-1),
    ):
        assert not limits.is_brake_lawful(wrong)


def a_train_on_a_line_without_crossings_has_no_ceiling() -> None:
    """As fast as any speed that is one (X2)."""
    assert ceiling.is_kept(BRAKE, ceiling.NONE, 200_000)
    assert ceiling.take(BRAKE, Ceiling(8_000), ceiling.NONE, 0) == ceiling.NONE


WITNESSES = (
    a_train_that_has_promised_is_stopped_before_it_is_faster,
    a_train_that_is_let_go_runs_faster,
    a_promise_outlives_a_position_that_was_lost_and_a_restart,
    a_ceiling_is_told_between_cycles,
    motors_are_cut_off_once_the_brake_was_on_for_so_long,
    bounds_of_motors_that_are_no_bounds_are_refused,
    a_train_on_a_line_without_crossings_has_no_ceiling,
)
