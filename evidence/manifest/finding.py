"""One thing that is not as it should be in a folder of records."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import groupby

OF_A_KIND = 8
"""So many of one kind in one record are told one by one."""


@dataclass(frozen=True)
class Finding:
    """What kind, of which file, and in words."""

    kind: str
    where: str
    says: str

    @property
    def line(self) -> str:
        """In one line."""
        return f"{self.kind}: {self.where}: {self.says}"


def lines(found: Sequence[Finding]) -> Iterator[str]:
    """What to print: of many of one kind in one record the first few, and how many more there are."""
    ordered = sorted(found, key=lambda each: (each.where, each.kind))
    for (where, kind), group in groupby(ordered, lambda each: (each.where, each.kind)):
        alike = list(group)
        yield from (each.line for each in alike[:OF_A_KIND])
        if len(alike) > OF_A_KIND:
            yield f"{kind}: {where}: and {len(alike) - OF_A_KIND:,} more"


def differences(kind: str, where: str, told: Sequence[str], wanted: Sequence[str]) -> Iterator[Finding]:
    """Compare what a record names with what the sources say must be there; each stands there once."""
    known, there = set(wanted), set(told)
    for name in dict.fromkeys(wanted):
        if name not in there:
            yield Finding(f"missing {kind}", where, f"{name}: the sources ask for it, and the record says nothing")
    for name in there - known:
        yield Finding(f"foreign {kind}", where, f"{name}: the record tells of it, and the sources have none such")
    for name in {name for name in there if told.count(name) > 1} if len(told) > len(there) else ():
        yield Finding(f"double {kind}", where, f"{name}: the record tells of it twice")
