"""The kernel's tram machines as machine code, for days of traffic; ``tests/tram`` holds them to CPython."""

from __future__ import annotations

from kernel.tram import cycle, dispatching, display, stopping
from models.compiled import compile_machines

MADE = compile_machines((cycle, dispatching, display, stopping))
"""Each function is compiled when it is first called."""
