"""A record that does not have the form of such a record is a finding, not a fault of what reads it."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator

from evidence.manifest.finding import Finding
from models.layouts import BadInput

FORM = (
    KeyError,
    TypeError,
    ValueError,
    AttributeError,
    IndexError,
    ArithmeticError,
    RecursionError,
    MemoryError,
    OSError,
    re.error,
    BadInput,
)
"""What goes wrong with a record of another form: a pattern that is none, a number without bounds, a list for a name."""


def formed(name: str, judge: Callable[[], Iterator[Finding]]) -> list[Finding]:
    """What is found; a record that does not have the form of such a record is a finding."""
    try:
        return list(judge())
    except FORM as error:
        said = (str(error).splitlines() or [""])[0]
        return [Finding("unreadable", name, f"does not have the form of such a record: {type(error).__name__}: {said}")]
