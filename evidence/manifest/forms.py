"""A record that does not have the form of such a record is a finding, not a fault of what reads it."""

from __future__ import annotations

import re
import signal
from collections.abc import Callable, Iterable, Iterator
from typing import NoReturn

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


MATCHING_S = 3
"""A pattern that somebody meant is done with every name there is in a fraction of a second."""


def gone_through(pattern: str, names: Iterable[str]) -> None:
    """Match a record's pattern with names; one that backtracks for ever holds nobody up.

    Raises:
        ValueError: it is not done in time.
    """

    def over(_signal: int, _frame: object) -> NoReturn:
        raise ValueError(f"the pattern {pattern[:60]!r} is not done with the names in {MATCHING_S} s")

    matches, before = re.compile(pattern), signal.signal(signal.SIGALRM, over)
    signal.setitimer(signal.ITIMER_REAL, MATCHING_S)
    try:
        for name in names:
            matches.search(name)
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
        signal.signal(signal.SIGALRM, before)


def formed(name: str, judge: Callable[[], Iterator[Finding]]) -> list[Finding]:
    """What is found; a record that does not have the form of such a record is a finding."""
    try:
        return list(judge())
    except FORM as error:
        said = (str(error).splitlines() or [""])[0]
        return [Finding("unreadable", name, f"does not have the form of such a record: {type(error).__name__}: {said}")]
