"""What is rarely seen is looked for more; and coverage's growth, in words and as a picture."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from fuzz.campaign.growth import Growth, draw, growing, in_words
from fuzz.campaign.guidance import FACTORS, LEAST, MOST, Guide
from fuzz.campaign.identity import BATCHES_A_ROUND
from fuzz.campaign.outcome import DONE, Outcome
from fuzz.campaign.session import Options, go_on
from fuzz.campaign.sketch import REGISTERS, estimate, merged, registers
from fuzz.campaign.store import Kept, Store
from fuzz.targets.target import Batch, Result
from models.exit_codes import HOLDS
from tests.fuzz.campaign.quick import FAMILIES, Quick

NAMES = ("common", "rare")


def kept(number: int, weights: tuple[float, ...], covered: list[int], pairs: list[int] | None = None) -> Kept:
    return Kept(number, weights, np.array(sorted(covered), np.int64), np.array(sorted(pairs or []), np.int64))


def test_a_family_that_leads_to_what_is_rare_is_drawn_more() -> None:
    guide = Guide(NAMES)
    assert guide.weights() == (1.0, 1.0)
    guide.note([kept(number, (4.0, 0.25), [1, 2, 3]) for number in range(0, 20, 2)])
    other = Guide(NAMES)
    for number in range(20):
        rare = number % 2 == 1
        other.note([kept(number, (0.25, 4.0) if rare else (4.0, 0.25), [1, 2, 100 + number] if rare else [1, 2])])
    common, rare_weight = other.weights()
    assert LEAST <= common < 1 < rare_weight <= MOST
    assert guide.weights() == (1.0, 1.0), "nothing tells them apart"


def test_pairs_count_as_tuples_do() -> None:
    guide = Guide(NAMES)
    for number in range(20):
        rare = number % 2 == 1
        guide.note([kept(number, (0.25, 4.0) if rare else (4.0, 0.25), [1], [number] if rare else [0])])
    common, rare_weight = guide.weights()
    assert common < 1 < rare_weight


def test_no_family_dies_out_and_without_families_there_are_no_weights() -> None:
    guide, none = Guide(NAMES), Guide(())
    for number in range(200):
        batch = kept(number, (0.0, 1.0), [number])
        guide.note([batch])
        none.note([batch])
    assert guide.weights()[0] >= LEAST
    assert none.weights() == ()
    assert none.of_batch(1, 7, ()) == ()


@given(st.lists(st.sets(st.integers(-(2**63), 2**63 - 1), max_size=5), max_size=40), st.integers(0, 40))
def test_weights_do_not_depend_on_how_batches_were_noted(found: list[set[int]], cut: int) -> None:
    batches = [kept(number, (1.0, float(number % 3)), list(ids), list(ids)) for number, ids in enumerate(found)]
    whole, parts = Guide(NAMES), Guide(NAMES)
    whole.note(batches)
    parts.note(batches[:cut])
    parts.weights()
    parts.note(batches[cut:])
    assert whole.weights() == parts.weights()
    assert all(LEAST <= weight <= MOST for weight in whole.weights())


def test_each_batch_varies_the_rounds_weights_by_its_own_factors() -> None:
    guide = Guide(NAMES)
    drawn = [guide.of_batch(1, number, (2.0, 3.0)) for number in range(100)]
    assert drawn == [guide.of_batch(1, number, (2.0, 3.0)) for number in range(100)]
    assert {one / 2.0 for one, _ in drawn} == {other / 3.0 for _, other in drawn} == set(FACTORS)
    assert drawn != [guide.of_batch(2, number, (2.0, 3.0)) for number in range(100)]
    assert len(set(drawn)) > 4


def test_a_campaign_steers_by_what_it_found(tmp_path: Path) -> None:
    rounds = 4
    assert go_on(Options(tmp_path, batches=rounds * BATCHES_A_ROUND), [Quick()]) == HOLDS
    with Store(tmp_path) as store:
        found = store.ask("SELECT round, weights FROM rounds ORDER BY round")
        assert [number for number, _ in found] == list(range(rounds))
        assert [weights for _, weights in found][:2] == ["[1.0, 1.0, 1.0]"] * 2, "the first results are too late"
        assert found[2][1] != "[1.0, 1.0, 1.0]"
        guide = Guide(FAMILIES)
        guide.note(store.kept(1, "quick", range(BATCHES_A_ROUND)))
        assert str(list(guide.weights())) == found[2][1]


# ---- growth


def filled(store: Store) -> None:
    """Ten batches of ten steps; each finds two new tuples but the last, which finds one, and one pair."""
    for number in range(10):
        batch = Batch("quick", number, 1, ())
        new = {2 * number: 1, 2 * number + 1: 1} if number < 9 else {100: 1}
        result = Result(batch, 1, 10, {}, {0: 3, **new}, {7: 1} if number == 9 else {}, b"", (), 0.1)
        store.add(Outcome(batch, result, DONE))


def test_growth_counts_what_each_batch_was_the_first_to_find(tmp_path: Path) -> None:
    with Store(tmp_path) as store:
        filled(store)
        growth = growing(store)
    assert growth["quick"].steps == list(range(10, 101, 10))
    assert growth["quick"].tuples == [2, 4, 6, 8, 10, 12, 14, 16, 18, 19]
    assert growth["quick"].pairs == [0] * 9 + [1]
    assert growth["quick"].last_tenth() == (1, 1)
    line = in_words("quick", growth["quick"])
    assert line == "quick: the last tenth of the steps added 1 of 19 tuples and 1 of 1 pairs"


def test_one_batch_is_all_there_is() -> None:
    assert Growth([50], [3], [4]).last_tenth() == (3, 4)


def test_the_picture_is_a_picture(tmp_path: Path) -> None:
    with Store(tmp_path) as store:
        filled(store)
        draw(tmp_path / "coverage.png", growing(store))
    from matplotlib.image import imread

    picture = imread(tmp_path / "coverage.png")
    assert picture.shape[0] > 300
    assert picture.std() > 0


# ---- distinct states


@pytest.mark.parametrize("states", [1, 100, 5_000, 300_000])
def test_distinct_states_are_estimated(states: int) -> None:
    found = sketch_of(range(states))
    assert abs(estimate(found) - states) <= max(2, 0.06 * states)
    assert merged(found, sketch_of(range(states // 2))) == found
    assert merged(b"", found) == merged(found, b"") == found
    assert estimate(b"") == 0


def sketch_of(states: range) -> bytes:
    """The registers of numbered states, each with a hash of 64 bits."""
    return registers(np.random.default_rng(1).integers(0, 2**64, len(states), np.uint64).tolist())


def test_a_register_keeps_the_most_leading_zeros_of_the_rest_and_one() -> None:
    found = registers([0, 5 << 52 | 1, 5 << 52 | 1 << 51, -1])
    assert (found[0], found[5], found[REGISTERS - 1]) == (53, 52, 1)
    assert sum(found) == 53 + 52 + 1
    assert merged(registers([0]), registers([-1])) == registers([0, -1])
