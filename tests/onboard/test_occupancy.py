"""No two trains touch: along drawn places of heads and rears, and what is claimed can fail (T4, T9, T10)."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import pytest
from hypothesis import given
from hypothesis import strategies as st

from kernel.names import Block
from models.onboard.occupancy import Occupied
from proofs.onboard.occupancy import (
    no_millimetre_is_under_two_trains,
    no_point_under_a_train_may_move,
    no_two_trains_foul_each_other,
    what_is_covered_lies_in_a_block,
)
from proofs.onboard.witnesses.occupancy import (
    AT,
    FREE,
    LIES_IN,
    LOCKED,
    POINT,
    SITE,
    STATION,
    WITNESSES,
    Line,
    stretch,
)
from proofs.witnesses.stations import A1, A2, B1, ONE, T1, T2, THROAT

PLACES = st.integers(0, len(LIES_IN) - 1)


@pytest.mark.parametrize("witness", WITNESSES)
def test_witness(witness: Callable[[], None]) -> None:
    assert witness.__doc__
    witness()


@given(PLACES, PLACES, PLACES, PLACES)
def test_wherever_two_trains_are_they_are_there_only_if_they_do_not_touch(
    rear_mm: int, head_mm: int, other_rear_mm: int, other_head_mm: int
) -> None:
    """With each car in exactly the blocks that its train covers."""
    covers = {T1: stretch(rear_mm, head_mm), T2: stretch(other_rear_mm, other_head_mm)}
    blocks = {train: frozenset(LIES_IN[place] for place in places) for train, places in covers.items()}
    at: dict[object, frozenset[Block]] = {A1: blocks[T1], A2: blocks[T1], B1: blocks[T2]}
    line = Line()
    moved = line.moves(covers, at=at)  # type: ignore[arg-type]
    assert moved or blocks[T1] & blocks[T2] or any(STATION.layout.fouls.get(block) for block in blocks[T1])
    assert not moved or not covers[T1] & covers[T2]


def test_what_is_claimed_can_fail() -> None:
    apart = Occupied(dict(AT), {POINT: LOCKED}, {T1: stretch(2, 15), T2: stretch(16, 27)})
    touching = replace(apart, covers={T1: stretch(2, 15), T2: stretch(15, 27)})
    assert no_millimetre_is_under_two_trains(SITE, apart)
    assert not no_millimetre_is_under_two_trains(SITE, touching)
    assert no_point_under_a_train_may_move(SITE, apart)
    for terminals in ({POINT: FREE}, {}):
        assert not no_point_under_a_train_may_move(SITE, replace(apart, terminals=terminals))
    fouled = replace(SITE, site=replace(STATION, layout=replace(STATION.layout, fouls={THROAT: frozenset({ONE})})))
    assert no_two_trains_foul_each_other(SITE, replace(apart, covers={T1: stretch(2, 15), T2: stretch(20, 27)}))
    assert not no_two_trains_foul_each_other(fouled, replace(apart, covers={T1: stretch(2, 15), T2: stretch(20, 27)}))
    assert not what_is_covered_lies_in_a_block(SITE, replace(apart, covers={T1: stretch(39, 40)}))
