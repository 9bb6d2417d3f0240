"""Every construct of the subset means in logic what it means in CPython."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest

from tests.lift import harbour, harbour_steps
from tests.lift.differential import check_function
from tests.lift.harbour import UNIVERSE


@pytest.mark.sampled(3)
@pytest.mark.parametrize(
    "function", [*harbour.FUNCTIONS, *harbour_steps.FUNCTIONS], ids=lambda function: function.__name__
)
def test_lifted_and_run_agree(function: Callable[..., Any]) -> None:
    check_function(function, UNIVERSE)
