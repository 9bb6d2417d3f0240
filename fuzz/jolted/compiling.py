"""How what jolts is compiled: once for each version of the sources here, and of the driver's words and calls."""

from __future__ import annotations

from pathlib import Path

from fuzz.kept import Kept

HERE = Path(__file__).parent
KEPT = Kept("jolted", [*HERE.glob("*.py"), *(HERE.parent / "traffic").glob("*.py")])
compiled = KEPT.compiled
