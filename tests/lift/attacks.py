"""Functions that set out to be lifted otherwise than CPython runs them.

Each is a module of its own, as text: what it does would not pass ruff or mypy.  They are written down by what they
attack by: names, classes or values.  The function is ``f``.  One that is *refused* is refused at the line marked
``# here``; one that *needs* something has an obligation that fails for some arguments; any other agrees with CPython
for all.
"""

from __future__ import annotations

from tests.lift import attacks_by_classes, attacks_by_names, attacks_by_values

PREAMBLE = """\
from __future__ import annotations
import dataclasses
import enum
from collections import Counter, defaultdict
from collections.abc import Mapping
from dataclasses import KW_ONLY, InitVar, dataclass, field, replace
from enum import Enum, IntEnum
from types import MappingProxyType
from typing import ClassVar, NamedTuple, NewType
from tests.lift.harbour import Berth, Flag, Harbour, Ship, Slot, Tide, Visit
LIMIT = 3
"""


def texts() -> dict[str, tuple[str, str]]:
    """Return each attack by its name: what must come of it, and its module."""
    found = {}
    written = attacks_by_names.TEXTS + attacks_by_classes.TEXTS + attacks_by_values.TEXTS
    for part in written.split("\n## ")[1:]:
        head, body = part.split("\n", 1)
        name, _, verdict = head.partition(": ")
        assert verdict in ("", "refused", "needs"), head
        assert name not in found, name
        found[name] = (verdict or "agrees", PREAMBLE + body.rstrip() + "\n")
    return found
