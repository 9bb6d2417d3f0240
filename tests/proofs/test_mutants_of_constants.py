"""Numbers of the kernel with other values: every reader sees them, and what states its own number notices."""

from __future__ import annotations

import ast
from dataclasses import replace
from functools import cache
from unittest.mock import patch

import pytest

from fuzz.planted.killed import text_of
from kernel.alarm import distance, tone
from kernel.onboard import arithmetic, braking, odometry, split
from models.onboard import odometry as world
from proofs.lift.sources import definition_of
from proofs.mutants.classes import IMPLIED, Entry, objection
from proofs.mutants.constants import Constant, constants_of, reads
from proofs.mutants.edits import Mutant, mutants_of, others
from proofs.mutants.targets import mutants, rows_of, theories_with
from proofs.mutants.trial import tried
from proofs.theories import THEORIES


@cache
def of(name: str) -> Mutant:
    return mutants()[name]


CAUTION = "kernel.alarm.tone.CAUTION_MM: value 3000000 is 300000"
PAST = "kernel.alarm.distance.PAST_MM: value 100000 is 0"
CYCLE = "kernel.onboard.arithmetic.CYCLE_MS: value 100 is 10"


@pytest.mark.parametrize(
    ("value", "instead"),
    [
        (100, [101, 99, 1000, 10, 0, -100]),
        (1, [2, 0, 10, -1]),
        (0, [1, -1]),
        (-1, [0, -2, -10, 1]),
        (10, [11, 9, 100, 1, 0, -10]),
    ],
)
def test_a_number_becomes_one_more_one_less_ten_times_a_tenth_nothing_and_its_negative(
    value: int, instead: list[int]
) -> None:
    assert others(value) == instead


def test_every_number_in_a_function_is_changed_and_none_of_a_world() -> None:
    found = [each for each in mutants_of(braking.worst_um_s) if each.kind == "constant"]
    assert {each.text for each in found} >= {
        "1000 * speed_most_mm_s: 1000 is 1001",
        "1000 * speed_most_mm_s: 1000 is -1000",
        "bounds.response_cycles + 1: 1 is 0",
    }
    for each in found:
        assert ast.unparse(each.tree) != ast.unparse(definition_of(braking.worst_um_s))
    assert not [each for each in mutants_of(world.the_way_follows_the_speed) if each.kind == "constant"]


def test_a_number_of_a_module_is_changed_for_all_who_read_it_and_only_as_long_as_it_is_planted() -> None:
    mutant = of(CYCLE)
    assert {"odometry", "split"} <= {theory.name for theory in theories_with(mutant)}
    assert {"odometry.run_a_cycle", "split.run_a_cycle"} <= set(rows_of(mutant))
    before = cycle_times()
    with mutant.planted():
        assert cycle_times() == [10, 10, 10]
    assert cycle_times() == before == [100, 100, 100]
    with pytest.raises(KeyError):
        broken_off(mutant)
    assert cycle_times() == before


def cycle_times() -> list[int]:
    return [vars(module)["CYCLE_MS"] for module in (arithmetic, odometry, split)]


def broken_off(mutant: Mutant) -> None:
    with mutant.planted():
        raise KeyError


def test_what_is_reckoned_from_a_number_is_reckoned_anew() -> None:
    with of("kernel.alarm.distance.GREATEST_AGE_MS: value 3600000 is 0").planted():
        assert distance.NO_TRAIN_FIX.age_ms == 1
    assert distance.NO_TRAIN_FIX.age_ms == 3_600_001
    assert reads(distance.is_fix, "kernel.alarm.distance", "GREATEST_AGE_MS")
    assert not reads(distance.is_fix, "kernel.alarm.tone", "CAUTION_MM")


def test_numbers_and_truths_in_a_record_are_changed_one_by_one() -> None:
    from kernel.onboard import way

    with of("kernel.onboard.way.UNKNOWN: value Way(known=False, least_mm=0, most_mm=0): False is True").planted():
        assert replace(way.UNKNOWN, known=False) != way.UNKNOWN
    assert not way.UNKNOWN.known
    assert len({each.name for each in constants_of(way, [way.between])}) == len(constants_of(way, [way.between]))


def test_a_number_that_is_wrong_is_noticed() -> None:
    assert tried(of(PAST)).outcome == "counterexample"


def test_a_constant_that_a_claim_reads_is_never_implied() -> None:
    mutant = of(PAST)
    assert isinstance(mutant, Constant)
    found = objection(Entry(PAST, IMPLIED, "because"))
    assert found.endswith("reads it, and so becomes another with it")


def test_a_constant_that_makes_no_difference_is_proved_to_make_none() -> None:
    other = of("kernel.onboard.way.GREATEST_MM: value 1000000000 is 0")
    assert objection(Entry(other.name, IMPLIED, "because")).startswith("not proved to make no difference in ")
    same = replace(other, value=1_000_000_000)  # type: ignore[call-arg]
    with patch.dict(mutants(), {other.name: same}):
        assert objection(Entry(other.name, IMPLIED, "because")) == ""


def test_constants_of_modules_are_planted_in_no_function() -> None:
    killed = {"outcome": "counterexample", "by": "alarm_tone.listen"}
    assert "CAUTION_MM" not in text_of([{"mutant": CAUTION, **killed}])
    name = "kernel.alarm.distance.older_ms: constant GREATEST_AGE_MS + 1: 1 is 0"
    assert name in text_of([{"mutant": name, **killed}])


def test_every_integer_constant_that_a_step_reads_has_mutants() -> None:
    assert CAUTION in mutants()
    assert tone.CAUTION_MM == 3_000_000
    homes = {each.home for each in mutants().values() if isinstance(each, Constant)}
    assert {
        "kernel.crossing.crossing.LEAST_DOWN_MS",
        "kernel.tram.cycle.STALE_MS",
        "kernel.link.LAST_SEQUENCE",
    } <= homes
    assert THEORIES["alarm_tone"] in theories_with(of(CAUTION))
