"""Registers that are loaded or refused, and walks from line to line (A1)."""

from __future__ import annotations

from dataclasses import replace

from kernel.alarm.distance import UM_A_MM
from kernel.alarm.least_ways import Equation, Join, far_um, has_least_ways
from kernel.alarm.network import Connection, Way
from models.alarm.alarm_network import Tracks, Walk
from models.alarm.along import told_far_um as far_by_the_requirement_um
from models.alarm.line import REGISTER as LINE
from proofs.alarm.alarm_network import THEORY
from proofs.onboard.witnesses.play import Play

KM = 1_000_000
WEST, EAST = Join("west"), Join("east")
JOINS = {WEST: Equation(10 * KM, 100 * KM), EAST: Equation(102 * KM, 14 * KM)}
"""A loop of 2 km leaves a line at 10 km and comes back at 14 km."""
WAYS = {
    Way("in at west"): Connection(100 * KM, 10 * KM, 0),
    Way("out at west"): Connection(10 * KM, 100 * KM, 0),
    Way("in at east"): Connection(102 * KM, 14 * KM, 0),
    Way("out at east"): Connection(14 * KM, 102 * KM, 0),
    Way("round to west"): Connection(14 * KM, 10 * KM, 2 * KM),
    Way("round to east"): Connection(10 * KM, 14 * KM, 2 * KM),
}
REGISTER = replace(LINE, ways=WAYS)
SITE = Tracks(LINE, JOINS)


class Walking(Play[Tracks, Walk]):
    """A walk, before it begins."""

    def __init__(self) -> None:
        """Begin with nothing loaded."""
        super().__init__(THEORY, SITE, Walk({}, False, False, 0, 0, 0))


def round_the_loop_and_back() -> None:
    """In at the west, over the loop, out at the east, on along the line: never nearer than the register has it."""
    walk = Walking()
    assert walk.step("load", ways=WAYS).is_accepted
    walk.step("begin", join=WEST, is_turned=False)
    assert walk.system == Walk(WAYS, True, True, 10 * KM, UM_A_MM * 100 * KM, 0)
    before = walk.system
    assert walk.step("cross", join=EAST, is_turned=False) == before
    walk.step("walk_on", to_um=UM_A_MM * 102 * KM)
    walk.step("cross", join=EAST, is_turned=False)
    assert walk.system == Walk(WAYS, True, True, 10 * KM, UM_A_MM * 14 * KM, UM_A_MM * 2 * KM)
    walk.step("walk_on", to_um=UM_A_MM * 13 * KM)
    assert walk.system.walked_um == UM_A_MM * 3 * KM
    walk.step("walk_on", to_um=UM_A_MM * 10 * KM)
    assert walk.system.walked_um > far_um(REGISTER)
    walk.step("begin", join=WEST, is_turned=False)
    walk.step("cross", join=WEST, is_turned=True)
    assert walk.system == Walk(WAYS, True, False, 10 * KM, UM_A_MM * 10 * KM, 0)
    walk.step("begin", join=EAST, is_turned=True)
    assert (walk.system.start_mm, walk.system.at_um) == (14 * KM, UM_A_MM * 102 * KM)
    assert walk.step("begin", join=Join("nowhere"), is_turned=True).start_mm == 14 * KM


def what_is_missing_or_too_long_is_refused() -> None:
    """Each connection that another does not make up for, to the mm (A1)."""
    assert has_least_ways(REGISTER, JOINS)
    assert has_least_ways(REGISTER, {})
    for way, connection in WAYS.items():
        longer = replace(connection, between_mm=connection.between_mm + 1)
        fewer = {other: each for other, each in WAYS.items() if other != way}
        for ways in (WAYS | {way: longer}, fewer):
            assert not has_least_ways(replace(REGISTER, ways=ways), JOINS), way
            walk = Walking()
            before = walk.system
            assert walk.step("load", ways=ways) == before
        shorter = replace(connection, between_mm=connection.between_mm - 1)
        assert shorter not in WAYS.values()


def what_is_far_need_not_be_written() -> None:
    """3000 m, a train's length, what it and the worker run while they are told, and what they are told too far (A1)."""
    alone_mm = 3_060_000 + 15_000 + 2 * 5_000
    far_mm = alone_mm + 27 * 12_000 + 100_000
    assert far_um(REGISTER) == far_by_the_requirement_um(REGISTER) == UM_A_MM * far_mm
    for other, more_mm in (
        (replace(REGISTER, fresh=replace(REGISTER.fresh, fix_ms=20_000)), 27 * 8_000),
        (replace(REGISTER, bounds=replace(REGISTER.bounds, train_error_mm=130_000)), 30_000),
        (replace(REGISTER, bounds=replace(REGISTER.bounds, worker_error_mm=15_001)), 1),
        (replace(REGISTER, fresh=replace(REGISTER.fresh, worker_ms=5_001)), 2),
    ):
        assert far_um(other) == far_by_the_requirement_um(other) == UM_A_MM * (far_mm + more_mm)
    joins = {WEST: Equation(10 * KM, 100 * KM), EAST: Equation(100 * KM + far_mm, 200 * KM)}
    ways = {
        Way("in"): Connection(100 * KM, 10 * KM, 0),
        Way("out"): Connection(10 * KM, 100 * KM, 0),
        Way("in beyond"): Connection(200 * KM, 100 * KM + far_mm, 0),
        Way("out beyond"): Connection(100 * KM + far_mm, 200 * KM, 0),
    }
    assert not has_least_ways(replace(REGISTER, ways=ways), joins)
    farther = joins | {EAST: Equation(100 * KM + far_mm + 1, 200 * KM)}
    beyond = {
        Way("in beyond"): Connection(200 * KM, 100 * KM + far_mm + 1, 0),
        Way("out beyond"): Connection(100 * KM + far_mm + 1, 200 * KM, 0),
    }
    assert has_least_ways(replace(REGISTER, ways=ways | beyond), farther)


WITNESSES = (round_the_loop_and_back, what_is_missing_or_too_long_is_refused, what_is_far_need_not_be_written)
