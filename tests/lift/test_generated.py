"""Functions made by chance mean in logic what CPython makes of them: a sample here, 20,000 in ``make slow``."""

from __future__ import annotations

from pathlib import Path
from random import Random

import pytest

from proofs.lift import FiniteScope
from tests.lift.generated import function
from tests.lift.generated_types import HEAD
from tests.lift.harbour import UNIVERSE
from tests.lift.written import Compared, Disagreement, Draw, module_of

SAMPLE, ALL, CHUNK = 200, 20_000, 25
DRAWS = 2
"""How many arguments each function is tried on, concrete and as symbols."""


def compare(seed: int, folder: Path) -> int:
    """Compare one function; return for how many ways its obligations failed. What is written is never refused."""
    text = function(Random(seed), "f")
    compared = Compared(module_of(f"{HEAD}\n\n{text}", folder).f, FiniteScope.of_universe(UNIVERSE))
    draw = Draw(Random(seed), UNIVERSE)
    try:
        for _ in range(DRAWS):
            compared.check(tuple(draw.of_type(each) for each in compared.types))
    except Disagreement as difference:
        raise Disagreement(f"seed {seed}: {difference}\n{text}") from None
    return compared.failing


@pytest.mark.parametrize("first", range(0, SAMPLE, CHUNK))
def test_a_sample_agrees_with_python(first: int, tmp_path: Path) -> None:
    failing = [compare(seed, tmp_path) for seed in range(first, first + CHUNK)]
    assert sum(each == 0 for each in failing) > CHUNK // 3, "too few functions whose values were compared"


@pytest.mark.slow
@pytest.mark.parametrize("first", range(SAMPLE, ALL, CHUNK * 4))
def test_all_agree_with_python(first: int, tmp_path: Path) -> None:
    failing = [compare(seed, tmp_path) for seed in range(first, first + CHUNK * 4)]
    assert sum(each == 0 for each in failing) > CHUNK * 4 // 3, "too few functions whose values were compared"
