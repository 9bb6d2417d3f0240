"""What history notes of a brake control that does wrong: that the brake went off when it must not (T12).

The control that is proved never does so; a faulty one is put in its place here, for a single step.
"""

from __future__ import annotations

from dataclasses import replace
from unittest.mock import patch

from kernel.onboard import braking as machine
from kernel.onboard.braking import Brake, BrakeBounds
from kernel.onboard.ceiling import NONE as NO_CEILING
from kernel.onboard.speed_limit import SpeedTable
from models.onboard import braking as world
from models.onboard import slowing
from models.onboard.braking import Approach, Vehicle
from models.onboard.ceiling import AT_REST

SITE = Vehicle(
    BrakeBounds(
        gains_mm_s2=1_200, slows_mm_s2=700, response_cycles=15, standstill_mm_s=25, cut_cycles=15, falls_mm_s2=1_200
    ),
    SpeedTable(line_mm_s=60_000, curve_mm_s=25_000, turnout_mm_s=12_000),
)
END_MM = 3_000_000
OFF = Brake(applied=False, end_mm=END_MM)
BRAKED = Approach(
    head_nm=0,
    speed_um_s=0,
    response_cycles=0,
    worst_um_s=0,
    reach_nm=0,
    left_nm=0,
    demanded=False,
    released_amiss=False,
    brake=Brake(applied=True, end_mm=END_MM),
    wanted=True,
    wanted_mm=END_MM,
    slowing=slowing.at_rest(SITE.bounds, 0, END_MM),
    ceiling=NO_CEILING,
    keeping=AT_REST,
)
"""A train at rest far before its end, its brake on."""


def released(system: Approach, *, demanded: bool = False, acknowledged: bool = True) -> Approach:
    """A cycle whose control gives the brake as off, right or wrong; the train keeps its speed."""
    um_s = system.speed_um_s
    mm_s = um_s // 1_000
    with patch.object(machine, "supervise", return_value=OFF):
        after = world.run_a_cycle(SITE, system, 0, mm_s, mm_s, demanded, acknowledged, 100 * um_s, um_s)
    assert after.brake == OFF
    return after


def taken(system: Approach, end_mm: int) -> Approach:
    """A new end is wanted of a train at rest, and the control that is proved takes it."""
    after = world.take_end(SITE, system, 0, 0, 0, end_mm)
    assert after.brake == replace(system.brake, end_mm=end_mm)
    return after


def moving(speed_mm_s: int) -> Approach:
    """A braked train that moves."""
    return replace(BRAKED, speed_um_s=1_000 * speed_mm_s)


def a_brake_that_goes_off_while_demanded_is_noted() -> None:
    """Even of a train that stands, acknowledged (T12)."""
    assert released(BRAKED, demanded=True).released_amiss
    assert not released(BRAKED).released_amiss
    assert not released(replace(BRAKED, brake=OFF), demanded=True).released_amiss, "it was off"


def a_brake_that_goes_off_unacknowledged_is_noted() -> None:
    """Though the train stands, and nobody demands the brake (T12)."""
    assert released(BRAKED, acknowledged=False).released_amiss
    assert not released(replace(BRAKED, brake=OFF), acknowledged=False).released_amiss, "it was off"


def a_brake_that_goes_off_while_the_train_moves_is_noted() -> None:
    """Forward or back, by anything above what counts as a standstill (T5, T12)."""
    for speed_mm_s in (26, -26, 20_000, -600):
        assert not world.stands(SITE, moving(speed_mm_s))
        assert released(moving(speed_mm_s)).released_amiss
    for speed_mm_s in (25, -25):
        assert world.stands(SITE, moving(speed_mm_s))
        assert not released(moving(speed_mm_s)).released_amiss


def a_brake_that_goes_off_as_an_end_is_taken_is_noted() -> None:
    """A nearer end or a farther one: none that is taken releases the brake (T4, T12)."""
    for end_mm in (END_MM - 1, END_MM, END_MM + 1):
        assert not taken(BRAKED, end_mm).released_amiss
        with patch.object(machine, "take_end", return_value=Brake(applied=False, end_mm=end_mm)):
            assert world.take_end(SITE, BRAKED, 0, 0, 0, end_mm).released_amiss
            assert not world.take_end(SITE, replace(BRAKED, brake=OFF), 0, 0, 0, end_mm).released_amiss, "it was off"


def a_brake_that_went_off_once_stays_noted() -> None:
    """However rightly it is released, or an end is taken, after that (T12)."""
    once = replace(BRAKED, released_amiss=True)
    assert released(once).released_amiss
    for end_mm in (END_MM - 1, END_MM, END_MM + 1):
        assert taken(once, end_mm).released_amiss


WITNESSES = (
    a_brake_that_goes_off_while_demanded_is_noted,
    a_brake_that_goes_off_unacknowledged_is_noted,
    a_brake_that_goes_off_while_the_train_moves_is_noted,
    a_brake_that_goes_off_as_an_end_is_taken_is_noted,
    a_brake_that_went_off_once_stays_noted,
)
