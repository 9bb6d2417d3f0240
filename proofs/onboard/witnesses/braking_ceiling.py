"""Trains that keep to a ceiling of speed, at the worst that motors, descent and brake may do (X2, T12)."""

from __future__ import annotations

from dataclasses import replace

from kernel.onboard import ceiling as machine
from kernel.onboard.ceiling import Ceiling
from proofs.onboard.witnesses import braking_ahead
from proofs.onboard.witnesses.braking_ahead import Train
from proofs.onboard.witnesses.sixty_four_bits import Checked, with_ints

BOUNDS = replace(braking_ahead.BOUNDS, cut_cycles=5, falls_mm_s2=200)
GAINED_UM_S = 102 * (6 * 1_200 + 10 * 200)
"""By full power for the cycle of the decision and five until the motors are cut off, then on the descent alone."""
KEEPS_MM_S = 20_000


def keep_to(train: Train, ceiling_mm_s: int, speed_mm_s: int) -> bool:
    """The train is to keep to this; whether it does."""
    head_mm = train.head_mm()
    train.step(
        "keep_to",
        front_most_mm=head_mm + 1,
        speed_least_mm_s=min(speed_mm_s, train.system.speed_um_s // 1_000),
        speed_most_mm_s=speed_mm_s,
        ceiling=Ceiling(ceiling_mm_s),
    )
    return train.system.ceiling.most_mm_s == ceiling_mm_s


def running(speed_mm_s: int) -> Train:
    """A train that has got to a speed, with nothing listed ahead."""
    train = Train(bounds=BOUNDS)
    train.release()
    while train.system.speed_um_s < 1_000 * speed_mm_s:
        train.cycle(min(train.system.speed_um_s + 102 * 1_200, 1_000 * speed_mm_s))
    return train


def worst_cycle(train: Train) -> None:
    """As fast as it can: full power until the motors are cut off, the steepest descent until the brake responds."""
    keeping, speed_um_s = train.system.keeping, train.system.speed_um_s
    if not train.brakes() or keeping.cut_cycles > 0:
        train.cycle(speed_um_s + 102 * 1_200)
    elif keeping.falling_cycles > 0:
        train.cycle(speed_um_s + 102 * 200)
    else:
        train.cycle(max(0, speed_um_s - 98 * 700))


def at_its_worst_a_train_comes_close_to_its_ceiling_and_no_farther() -> None:
    """It is braked a little sooner than has to be, by what a cycle gives, and never exceeds what it promised (X2)."""
    train = running(15_000)
    assert keep_to(train, KEEPS_MM_S, 15_000)
    fastest_um_s = 0
    while not train.brakes():
        worst_cycle(train)
    while train.system.speed_um_s > 0:
        fastest_um_s = max(fastest_um_s, train.system.speed_um_s)
        worst_cycle(train)
    assert 1_000 * KEEPS_MM_S - 3 * 102 * 1_200 <= fastest_um_s <= 1_000 * KEEPS_MM_S


def to_the_micrometre_a_ceiling_is_kept_or_not() -> None:
    """The margin counts, and a speed below 0 is none (X2, T12)."""
    least_mm_s = 15_000 + -(-GAINED_UM_S // 1_000)
    assert machine.gained_um_s(BOUNDS) == GAINED_UM_S
    assert machine.is_kept(BOUNDS, Ceiling(least_mm_s), 15_000)
    assert not machine.is_kept(BOUNDS, Ceiling(least_mm_s - 1), 15_000)
    assert not machine.is_kept(BOUNDS, Ceiling(least_mm_s), -1)
    assert machine.is_kept(BOUNDS, machine.NONE, 200_000)
    assert not machine.is_kept(BOUNDS, machine.NONE, 200_001), "nor is a speed beyond 200 m/s one"
    assert machine.is_kept(replace(BOUNDS, gains_mm_s2=0, falls_mm_s2=0), Ceiling(0), 0)


def a_ceiling_that_cannot_be_kept_any_more_is_not_taken() -> None:
    """Who asks for it keeps to the one before; it is taken once the train has slowed (X2)."""
    train = running(15_000)
    least_mm_s = 15_000 + -(-GAINED_UM_S // 1_000)
    assert not keep_to(train, least_mm_s - 1, 15_000)
    assert train.system.ceiling.most_mm_s == machine.NONE.most_mm_s
    assert keep_to(train, least_mm_s, 15_000)
    train.cycle(14_900_000)
    assert keep_to(train, least_mm_s - 100, 14_900)


def a_train_that_is_let_go_may_run_faster_at_once() -> None:
    """Whatever is known of its speed; nothing is reckoned anew, and a train that brakes goes on braking (X2)."""
    train = running(15_000)
    assert keep_to(train, KEEPS_MM_S, 15_000)
    while not train.brakes():
        worst_cycle(train)
    before = train.system
    train.step("be_let_go", ceiling=Ceiling(KEEPS_MM_S - 1))
    assert train.system == before, "that is a lower one"
    train.step("be_let_go", ceiling=Ceiling(30_000))
    assert train.system == replace(before, ceiling=Ceiling(30_000))
    assert keep_to(train, 40_000, -(-before.speed_um_s // 1_000)), "and so may who knows its range"
    assert train.system == replace(before, ceiling=Ceiling(40_000))
    assert not keep_to(train, 30_000, 0), "of which a lower one has to be true"


def a_train_that_runs_well_below_its_ceiling_is_not_braked() -> None:
    """By what it may gain, and no more (X2)."""
    train = running(15_000)
    assert keep_to(train, 15_000 + -(-GAINED_UM_S // 1_000), 15_000)
    for _ in range(200):
        train.cycle(15_000_000)
        assert not train.brakes()


def a_lower_ceiling_begins_the_reckoning_anew() -> None:
    """A train whose brake has been on for a while takes its response anew: it may be let off in between (X2, T12)."""
    train = running(15_000)
    assert keep_to(train, KEEPS_MM_S, 15_000)
    while not train.brakes():
        worst_cycle(train)
    while train.system.speed_um_s > 15_000_000:
        worst_cycle(train)
    assert train.system.keeping.falling_cycles == 0
    speed_mm_s = -(-train.system.speed_um_s // 1_000)
    assert keep_to(train, KEEPS_MM_S - 100, speed_mm_s)
    assert (train.system.keeping.cut_cycles, train.system.keeping.falling_cycles) == (5, 10)
    assert train.system.keeping.worst_um_s == 1_000 * speed_mm_s + GAINED_UM_S


def motors_that_are_cut_off_pull_no_more() -> None:
    """Nor is a train of this world any faster on its descent than was written (T12)."""
    train = running(15_000)
    assert keep_to(train, KEEPS_MM_S, 15_000)
    while not train.brakes() or train.system.keeping.cut_cycles > 0:
        worst_cycle(train)
    held, speed_um_s = train.system, train.system.speed_um_s
    told = {
        "front_most_mm": train.head_mm() + 1,
        "speed_least_mm_s": speed_um_s // 1_000,
        "speed_most_mm_s": -(-speed_um_s // 1_000),
        "demanded": False,
        "acknowledged": False,
        "to_nm": held.head_nm + 102 * speed_um_s,
    }
    assert train.step("run_a_cycle", **told, speed_um_s=speed_um_s + 102 * 200 + 1) == held
    assert train.step("run_a_cycle", **told, speed_um_s=speed_um_s + 102 * 200) != held


def a_train_that_rolls_back_with_its_motors_cut_off_is_stopped_at_once() -> None:
    """What it gains by that is no motor's (T12)."""
    train = Train(bounds=BOUNDS)
    train.system = replace(train.system, speed_um_s=-1_000_000)
    still = {"demanded": False, "acknowledged": False, "to_nm": train.system.head_nm, "speed_um_s": 0}
    train.step("run_a_cycle", front_most_mm=0, speed_least_mm_s=-1_000, speed_most_mm_s=-1_000, **still)
    assert train.system.speed_um_s == 0


def every_number_fits_into_64_bits() -> None:
    """Whatever the speed and the ceiling (T12)."""
    checked = with_ints(Checked, BOUNDS)
    for speed_mm_s in (0, 200_000, -200_000):
        for ceiling_mm_s in (0, 60_000, 2**62, -(2**62)):
            answer = machine.is_kept(checked, Ceiling(Checked(ceiling_mm_s)), Checked(speed_mm_s))
            assert answer == machine.is_kept(BOUNDS, Ceiling(ceiling_mm_s), speed_mm_s)


WITNESSES = (
    at_its_worst_a_train_comes_close_to_its_ceiling_and_no_farther,
    to_the_micrometre_a_ceiling_is_kept_or_not,
    a_ceiling_that_cannot_be_kept_any_more_is_not_taken,
    a_train_that_is_let_go_may_run_faster_at_once,
    a_train_that_runs_well_below_its_ceiling_is_not_braked,
    a_lower_ceiling_begins_the_reckoning_anew,
    motors_that_are_cut_off_pull_no_more,
    a_train_that_rolls_back_with_its_motors_cut_off_is_stopped_at_once,
    every_number_fits_into_64_bits,
)
