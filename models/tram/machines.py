"""The kernel's tram machines as machine code, for days of traffic; ``tests/tram`` holds them to CPython."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, TypeVar

from kernel.tram import cycle, dispatching, display, stopping
from models import compiled as machine_code

MADE = machine_code.compile_machines((cycle, dispatching, display, stopping))
"""Each function is compiled when it is first called."""

Code = TypeVar("Code", bound=Callable[..., Any])


def compiled(function: Code) -> Code:
    """Compile a function that calls the machines; nothing is made anew there."""
    return machine_code.compiled(function, **machine_code.UNCOUNTED)
