"""Nothing stands for ever: from wherever a world is left, lawful steps alone free what is held and let trains run."""

from __future__ import annotations

import pytest

from tests.independent.world.campaign import layouts, trains_of
from tests.independent.world.drawn import LAYOUTS, told
from tests.independent.world.kernel_calls import Calls
from tests.independent.world.planted_faults import STANDS_FOR_EVER
from tests.independent.world.settled import Settled, left_whole, settle
from tests.independent.world.world import World

SEEDS = range(1, 9)
MANY_SEEDS = range(1, 151)
LEAST_STEPS, MOST_STEPS = 200, 1_500


def settled_from(layout: str, kernel: type[Calls], seed: int) -> Settled | None:
    """What came of settling one world; none where it was not left whole."""
    trains = trains_of(seed)
    world, settled = World(told(layout, trains), kernel, trains, seed), Settled()
    steps = LEAST_STEPS + seed * 97 % (MOST_STEPS - LEAST_STEPS)
    if len(world.trains) < trains or not left_whole(world, steps, seed):
        return None
    settle(world, settled)
    return settled


def settled_from_all(layout: str, seeds: range) -> list[Settled]:
    """The worlds that were left whole, settled."""
    return [each for seed in seeds if (each := settled_from(layout, Calls, seed)) is not None]


@pytest.mark.parametrize("layout", layouts())
def test_whatever_stands_still_can_go_again(layout: str) -> None:
    """Trains run again, too: the search is not empty."""
    assert sum(each.ran for each in settled_from_all(layout, SEEDS)) > 0


def test_worlds_are_left_with_blocks_held_to_no_purpose() -> None:
    assert sum(each.held_before for layout in LAYOUTS for each in settled_from_all(layout, SEEDS)) > 0


@pytest.mark.slow
@pytest.mark.parametrize("layout", layouts())
def test_whatever_stands_still_can_go_again_in_many_worlds(layout: str) -> None:
    found = settled_from_all(layout, MANY_SEEDS)
    assert len(found) > len(MANY_SEEDS) / 2
    assert sum(each.ran for each in found) > 0


@pytest.mark.parametrize("kernel", STANDS_FOR_EVER)
def test_a_kernel_that_leaves_a_train_standing_is_found(kernel: type[Calls]) -> None:
    with pytest.raises(AssertionError):
        assert [settled_from("wye", kernel, seed) for seed in SEEDS]
