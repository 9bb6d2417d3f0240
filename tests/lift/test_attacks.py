"""Functions that set out to be lifted wrongly are refused, or lifted rightly."""

from __future__ import annotations

from pathlib import Path
from random import Random

import pytest

from proofs.lift import OutsideSubset
from tests.lift.attacks import texts
from tests.lift.differential import QuantifiedScope
from tests.lift.harbour import UNIVERSE
from tests.lift.written import Compared, Draw, module_of

ATTACKS = texts()
DRAWS = 30


@pytest.mark.parametrize("name", [name for name, (verdict, _) in ATTACKS.items() if verdict == "refused"])
def test_refused_with_file_line_and_hint(name: str, tmp_path: Path) -> None:
    text = ATTACKS[name][1]
    marked = [line for line, each in enumerate(text.splitlines(), 1) if "# here" in each]
    module = module_of(text, tmp_path)
    with pytest.raises(OutsideSubset) as refusal:
        Compared(module.f, QuantifiedScope.of_universe(UNIVERSE))
    assert refusal.value.file == module.__file__
    assert [refusal.value.line] == marked
    assert refusal.value.hint


@pytest.mark.sampled(3)
@pytest.mark.parametrize("name", [name for name, (verdict, _) in ATTACKS.items() if verdict != "refused"])
def test_means_in_logic_what_it_means_in_python(name: str, tmp_path: Path) -> None:
    verdict, text = ATTACKS[name]
    compared = Compared(module_of(text, tmp_path).f, QuantifiedScope.of_universe(UNIVERSE))
    draw = Draw(Random(name), UNIVERSE)
    for _ in range(DRAWS):
        compared.check(tuple(draw.of_type(each) for each in compared.types))
    assert (compared.failing > 0) == (verdict == "needs")
