"""How the driver's functions are compiled: once for each version of the sources here."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

from numba.extending import intrinsic

from fuzz.kept import Kept

HERE = Path(__file__).parent
KEPT = Kept("traffic", [*HERE.glob("*.py"), HERE.parents[1] / "proofs" / "transitions.py"])
compiled = KEPT.compiled


def built_in(function: Callable[..., Any]) -> Any:
    """Make a function that says itself how it is lowered one that compiled code can call."""
    return intrinsic(function)
