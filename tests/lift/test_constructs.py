"""Every construct of the subset means in logic what it means in CPython."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest

from tests.lift.differential import check_function
from tests.lift.harbour import FUNCTIONS, UNIVERSE


@pytest.mark.parametrize("function", FUNCTIONS, ids=lambda function: function.__name__)
def test_lifted_and_run_agree(function: Callable[..., Any]) -> None:
    check_function(function, UNIVERSE)
