"""The kernel's tram machines as machine code, for days of traffic; ``tests/tram`` holds them to CPython."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, TypeVar

from kernel.tram import cycle, dispatching, display, stopping
from models import compiled as machine_code

MADE = machine_code.compile_machines((cycle, dispatching, display, stopping))
"""Each function is compiled when it is first called."""

Code = TypeVar("Code", bound=Callable[..., Any])
UNCOUNTED: dict[str, Any] = {"_nrt": False}
"""Nothing is made anew in what calls the machines, so no references are counted, which takes most of the time."""


def compiled(function: Code) -> Code:
    """Compile a function that calls the machines."""
    return machine_code.compiled(function, **UNCOUNTED)
