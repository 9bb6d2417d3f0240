"""A train under way, and one machine after the other that finds it unsafe (T5, T12, P5)."""

from __future__ import annotations

from dataclasses import replace

from kernel.onboard import brake_watch, odometry, reverse_movement, split, tag_window
from kernel.onboard.brake_demand import Known, TrainLimits
from kernel.onboard.braking import Brake, BrakeBounds
from kernel.onboard.ceiling import NONE as NO_CEILING
from kernel.onboard.odometry import Loss
from kernel.onboard.restriction_ahead import NONE_LISTED
from kernel.onboard.speed_limit import SpeedLimit, SpeedTable
from kernel.onboard.split import SplitLimits
from models.onboard.brake_demand import Deciding, Train
from proofs.onboard.brake_demand import THEORY
from proofs.onboard.witnesses.play import Play

SITE = Train(
    TrainLimits(
        brake=BrakeBounds(
            gains_mm_s2=1_200, slows_mm_s2=700, response_cycles=15, standstill_mm_s=25, cut_cycles=15, falls_mm_s2=1_200
        ),
        speeds=SpeedTable(line_mm_s=36_000, curve_mm_s=25_000, turnout_mm_s=11_000),
        length_mm=120_000,
    )
)
MOTION = replace(odometry.located(998_000, 1_002_000, 0), trusted=True, speed_least_mm_s=19_800, speed_most_mm_s=20_200)
WELL = Known(
    motion=MOTION,
    watch=brake_watch.watching(20_200),
    movement=reverse_movement.LOCATED,
    limit=SpeedLimit(in_curve=False, at_turnout=False, curve_until_mm=0, turnout_until_mm=0),
    wholeness=split.made_up(SplitLimits(500, 3_000, 500, 600, 1_000, 10_000)),
    window=tag_window.NONE_AWAITED,
    ahead=NONE_LISTED,
    ceiling=NO_CEILING,
)
"""A train at 20 m/s of which nothing bad is known."""
AT_REST = replace(WELL, motion=replace(MOTION, speed_least_mm_s=-20, speed_most_mm_s=20))


class Unit(Play[Train, Deciding]):
    """A unit whose brake has been released at a standstill, its end of authority 4 km ahead."""

    def __init__(self) -> None:
        """Begin."""
        super().__init__(THEORY, SITE, Deciding(AT_REST, True, False, True, Brake(True, 5_000_000)))
        assert not self.decides(AT_REST, acknowledged=True)

    def decides(self, known: Known, *, may_proceed: bool = True, acknowledged: bool = False) -> bool:
        """Decide by this; whether it brakes then."""
        self.step("decide", known=known, may_proceed=may_proceed, acknowledged=acknowledged)
        return self.system.brake.applied


def each_of_them_gets_the_brake() -> None:
    """In the same cycle, and until the train stands and the driver has acknowledged it (T5, T12, P5)."""
    in_a_curve = replace(WELL.limit, curve_until_mm=998_000 - 120_000)
    for found in (
        replace(WELL, motion=replace(MOTION, loss=Loss.CONTRADICTED)),
        replace(WELL, motion=replace(MOTION, loss=Loss.CYCLE_IRREGULAR)),
        replace(WELL, watch=replace(WELL.watch, broken=True)),
        replace(WELL, movement=replace(WELL.movement, reversed=True)),
        replace(WELL, motion=replace(MOTION, speed_most_mm_s=36_001)),
        replace(WELL, motion=replace(MOTION, speed_most_mm_s=25_001), limit=in_a_curve),
        replace(WELL, wholeness=replace(WELL.wholeness, split=True)),
        replace(WELL, window=replace(WELL.window, passed=True)),
    ):
        unit = Unit()
        assert not unit.decides(WELL)
        assert unit.decides(found)
        assert unit.decides(WELL, acknowledged=True)
        assert unit.decides(AT_REST)
        assert not unit.decides(AT_REST, acknowledged=True)


def no_order_gets_the_brake() -> None:
    """Without an order, or with an open loop, at rest as well (T5)."""
    unit = Unit()
    assert unit.decides(WELL, may_proceed=False)
    assert unit.decides(AT_REST, may_proceed=False, acknowledged=True)
    assert not unit.decides(AT_REST, acknowledged=True)


def a_contradicting_fix_brakes() -> None:
    """From the reading of a tag that lies elsewhere to the brake, in one cycle (P7, T2)."""
    unit = Unit()
    fits = odometry.note_fix(MOTION, 1_000_000, 1_000_500)
    assert not unit.decides(replace(WELL, motion=fits))
    assert unit.decides(replace(WELL, motion=odometry.note_fix(MOTION, 1_002_001, 1_002_500)))


def the_range_counts_at_both_its_ends() -> None:
    """For the end of authority its farthest place and speed, for a restriction its rearmost (T12, P7)."""
    unit = Unit()
    until = replace(WELL.limit, turnout_until_mm=998_000 - 120_000 - 1)
    assert not unit.decides(replace(WELL, limit=until))
    assert unit.decides(replace(WELL, limit=replace(until, turnout_until_mm=998_000 - 120_000)))
    for front_most_mm, speed_most_mm_s in ((4_990_000, 20_200), (4_100_000, 35_900)):
        unit = Unit()
        far = replace(MOTION, front_most_mm=front_most_mm, speed_most_mm_s=speed_most_mm_s)
        assert unit.decides(replace(WELL, motion=far))
    unit = Unit()
    unit.decides(AT_REST, may_proceed=False)
    rolls_back = replace(MOTION, speed_least_mm_s=-26, speed_most_mm_s=0)
    assert unit.decides(replace(WELL, motion=rolls_back), acknowledged=True)


WITNESSES = (
    each_of_them_gets_the_brake,
    no_order_gets_the_brake,
    a_contradicting_fix_brakes,
    the_range_counts_at_both_its_ends,
)
