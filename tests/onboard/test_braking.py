"""The brake control at its edges, for drawn bounds and the worst motion, and in 64 bits (T12)."""

from __future__ import annotations

from collections.abc import Callable
from itertools import product
from random import Random

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from kernel.onboard import braking as machine
from kernel.onboard.braking import FARTHEST_MM, Brake, BrakeBounds
from models.onboard.braking import Vehicle
from models.onboard.units import NM_A_MM
from proofs.onboard.braking import THEORY
from proofs.onboard.witnesses.braking import BOUNDS, END_MM, TABLE, WITNESSES, running, standing
from proofs.onboard.witnesses.play import Play
from proofs.onboard.witnesses.sixty_four_bits import Checked, with_ints

HUGE = 2**62
VEHICLES = st.builds(
    lambda gains_mm_s2, slows_mm_s2, response_cycles, standstill_mm_s: BrakeBounds(
        gains_mm_s2, slows_mm_s2, response_cycles, standstill_mm_s, response_cycles, gains_mm_s2
    ),
    gains_mm_s2=st.integers(0, 2_000),
    slows_mm_s2=st.integers(200, 4_000),
    response_cycles=st.integers(1, 40),
    standstill_mm_s=st.integers(0, 100),
)
"""Motors pull until the brake responds: as for trains that promise no ceiling."""


@pytest.mark.parametrize("witness", WITNESSES)
def test_witness(witness: Callable[[], None]) -> None:
    assert witness.__doc__
    witness()


class World:
    """A train with its bounds, the control asked in each cycle with a range that contains it."""

    def __init__(self, bounds: BrakeBounds, end_mm: int) -> None:
        self.bounds = bounds
        self.play = Play(THEORY, Vehicle(bounds, TABLE), standing(end_mm=end_mm, bounds=bounds))

    def cycle(
        self, speed_um_s: int, *, wide_mm: int = 0, demanded: bool = False, acknowledged: bool = False, way: int = 100
    ) -> None:
        """Run to a speed, by so many hundredths of the greatest way."""
        before = self.play.system
        self.play.step(
            "run_a_cycle",
            front_most_mm=-(-before.head_nm // NM_A_MM) + wide_mm,
            speed_least_mm_s=before.speed_um_s // 1_000 - wide_mm // 10,
            speed_most_mm_s=-(-before.speed_um_s // 1_000) + wide_mm // 10,
            demanded=demanded,
            acknowledged=acknowledged,
            to_nm=before.head_nm + 102 * way * max(before.speed_um_s, speed_um_s) // 100,
            speed_um_s=speed_um_s,
        )

    def fastest(self, most_um_s: int) -> int:
        """The greatest speed that nature lets the train have at the end of the cycle, up to a limit while unbraked."""
        system = self.play.system
        if system.brake.applied and system.response_cycles == 0:
            return max(0, system.speed_um_s - 98 * self.bounds.slows_mm_s2)
        gained = system.speed_um_s + 102 * self.bounds.gains_mm_s2
        return gained if system.brake.applied else max(system.speed_um_s, min(most_um_s, gained))


@settings(max_examples=25, deadline=None)
@given(VEHICLES, st.integers(1_000, 60_000), st.integers(10_000, 6_000_000))
def test_at_the_worst_no_train_passes_the_end_and_none_stops_far_before_it(
    bounds: BrakeBounds, speed_mm_s: int, end_mm: int
) -> None:
    """Short of it by the way of 0.3 s at most, and what is left because the train gains its speed little by little."""
    world = World(bounds, end_mm)
    world.cycle(0, acknowledged=True)
    fastest = worst = 0
    for _ in range(3_000):
        system = world.play.system
        if system.brake.applied and system.speed_um_s == 0 and fastest > 0:
            break
        worst = max(worst, system.worst_um_s)
        speed_um_s = world.fastest(1_000 * speed_mm_s)
        world.cycle(speed_um_s)
        assert world.play.system.head_nm <= NM_A_MM * end_mm
        fastest = max(fastest, speed_um_s)
    system = world.play.system
    if fastest > 0 and system.brake.applied and system.speed_um_s == 0:
        gain_um_s, cycles = 102 * bounds.gains_mm_s2 + 1_000, bounds.response_cycles + 3
        slows_mm_s2 = bounds.slows_mm_s2 * 98 // 102
        ramp_nm = 102 * gain_um_s * cycles * cycles // 2 + 2 * (worst + gain_um_s) * gain_um_s // slows_mm_s2
        rounded_nm = worst * worst // (2 * slows_mm_s2 * slows_mm_s2)
        assert NM_A_MM * end_mm - system.head_nm <= 306 * worst + ramp_nm + rounded_nm + 2 * NM_A_MM


@settings(max_examples=25, deadline=None)
@given(VEHICLES, st.integers(0, 2**32))
def test_the_head_stays_inside_in_drawn_worlds(bounds: BrakeBounds, seed: int) -> None:
    """Speeds up and down, wide ranges, demands, acknowledgements, ends that come nearer and go farther."""
    chance = Random(seed)
    world = World(bounds, chance.randrange(1_000_000))
    released = 0
    for _ in range(500):
        before = world.play.system
        if chance.random() < 0.05:
            head_mm = -(-before.head_nm // NM_A_MM)
            end_mm = chance.choice(
                (head_mm, head_mm + chance.randrange(3_000_000), -HUGE, HUGE, before.brake.end_mm + 1)
            )
            speed_mm_s = -(-before.speed_um_s // 1_000)
            world.play.step(
                "take_end", front_most_mm=head_mm, speed_least_mm_s=0, speed_most_mm_s=speed_mm_s, end_mm=end_mm
            )
            continue
        most = world.fastest(40_000_000)
        world.cycle(
            chance.choice((most, most, most, chance.randrange(most + 1))),
            wide_mm=chance.choice((0, 0, 1_000)),
            demanded=chance.random() < 0.01,
            acknowledged=chance.random() < 0.5,
            way=chance.choice((100, 100, 50, 0)),
        )
        released += before.brake.applied and not world.play.system.brake.applied
    assert world.play.system.head_nm >= 0


@given(VEHICLES, st.integers(0, 200_000), st.integers(-(10**9), 10**9), st.integers(0, 10**9))
def test_more_way_less_speed_and_a_better_brake_are_never_worse(
    bounds: BrakeBounds, speed_mm_s: int, front_mm: int, way_mm: int
) -> None:
    end_mm = front_mm + way_mm
    if machine.stops_before(bounds, front_mm, speed_mm_s, end_mm):
        assert machine.stops_before(bounds, front_mm, speed_mm_s, end_mm + 1)
        assert machine.stops_before(bounds, front_mm - 1, speed_mm_s, end_mm)
        assert machine.stops_before(bounds, front_mm, speed_mm_s // 2, end_mm)
        better = BrakeBounds(bounds.gains_mm_s2, bounds.slows_mm_s2 + 1, bounds.response_cycles - 1, 0, 0, 0)
        assert machine.stops_before(better, front_mm, speed_mm_s, end_mm)


@pytest.mark.parametrize("speed_mm_s", [-1, -HUGE, 200_001, HUGE])
def test_what_is_no_speed_brakes(speed_mm_s: int) -> None:
    off = Brake(applied=False, end_mm=FARTHEST_MM)
    assert machine.supervise(BOUNDS, off, 0, 0, speed_mm_s, False, True).applied


def test_a_stuck_front_is_not_this_machines_to_find() -> None:
    """The same range again, while the train runs on, contradicts the odometry's theorem: none may rely on it."""
    train = running(36_000)
    at_mm = train.system.head_nm // NM_A_MM
    train.cycle(36_000_000)
    before = train.system
    assert machine.supervise(BOUNDS, before.brake, at_mm, 36_000, 36_000, False, False) == before.brake
    stuck = {
        "front_most_mm": at_mm,
        "speed_least_mm_s": 36_000,
        "speed_most_mm_s": 36_000,
        "demanded": False,
        "acknowledged": False,
    }
    assert train.step("run_a_cycle", **stuck, to_nm=before.head_nm, speed_um_s=0) == before


def test_the_same_end_again_changes_nothing() -> None:
    train = running(20_000)
    at_mm = train.system.head_nm // NM_A_MM
    for _ in range(3):
        before = train.system
        assert (
            train.step("take_end", front_most_mm=at_mm, speed_least_mm_s=0, speed_most_mm_s=20_000, end_mm=END_MM)
            == before
        )


# ---- 64 bits

GREATEST_BOUNDS = BrakeBounds(
    gains_mm_s2=4_000, slows_mm_s2=4_000, response_cycles=600, standstill_mm_s=200_000, cut_cycles=5, falls_mm_s2=200
)
EDGES_MM = (-(10**12), -(10**9), -1, 0, 10**9, 10**12)


@pytest.mark.parametrize("bounds", [GREATEST_BOUNDS, BOUNDS, BrakeBounds(0, 1, 1, 0, 0, 0)])
def test_every_number_fits_into_64_bits(bounds: BrakeBounds) -> None:
    """Speeds to 200 m/s, decelerations to 4 m/s², a minute of response, places within a million kilometres."""
    checked = with_ints(Checked, bounds)
    for front_mm, end_mm, taken_mm, speed_mm_s in product(EDGES_MM, EDGES_MM, EDGES_MM, (0, 1, 200_000)):
        for applied in (True, False):
            brake = Brake(applied=applied, end_mm=end_mm)
            place = (Checked(front_mm), Checked(speed_mm_s))
            range_of = (Checked(front_mm), Checked(-speed_mm_s), Checked(speed_mm_s))
            after = machine.supervise(checked, with_ints(Checked, brake), *range_of, False, True)
            assert after == machine.supervise(bounds, brake, front_mm, -speed_mm_s, speed_mm_s, False, True)
            after = machine.take_end(checked, with_ints(Checked, brake), *place, Checked(taken_mm))
            assert after == machine.take_end(bounds, brake, front_mm, speed_mm_s, taken_mm)


def test_the_check_of_64_bits_finds_what_does_not_fit() -> None:
    """Beyond the declared decelerations the product is too large."""
    with pytest.raises(AssertionError, match="does not fit"):
        machine.stops_before(BrakeBounds(0, 10_000, 1, 0, 0, 0), 0, Checked(0), Checked(FARTHEST_MM))
