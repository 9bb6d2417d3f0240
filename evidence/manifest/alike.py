"""All records of a folder say the same of where they were made, and none is of later than the folder's manifest."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from datetime import UTC, datetime
from typing import Any

from evidence.manifest.finding import Finding
from evidence.records.reading import Kept

Said = Mapping[str, Any]
FIRST = "prove.json"
"""The record that others are held against, where there is one."""
ALIKE = {"platform": "platform", "solvers": "solvers", "python": "versions", "heisoku": "versions"}
"""What they say the same of, and the name of the finding if not."""


def ways(kept: Kept) -> list[Said]:
    """How a record says that it was made; a campaign says it of each of its starts."""
    starts = kept.data.get("starts")
    found = [each for each in starts if isinstance(each, Mapping)] if isinstance(starts, list) else []
    return found or [kept.about]


def alike(records: Mapping[str, Kept]) -> Iterator[Finding]:
    """Hold each record against one of them: platform, solvers, Python and heisoku."""
    there = {name: kept for name, kept in records.items() if not kept.problem and kept.about}
    if not there:
        return
    first = FIRST if FIRST in there else min(there)
    said = _of(there[first].about)
    for name, kept in there.items():
        for way in map(_of, ways(kept)):
            for key, kind in ALIKE.items():
                if way[key] is not None and said[key] is not None and way[key] != said[key]:
                    yield Finding(f"other {kind}", name, f"{key} {way[key]}, and {first} says {said[key]}")


def _of(way: Said) -> Said:
    versions = way.get("versions")
    told = versions if isinstance(versions, Mapping) else {}
    return {key: told.get(key) if kind == "versions" else way.get(key) for key, kind in ALIKE.items()}


def timed(kept: Kept, until: str) -> Iterator[Finding]:
    """A record says when it was made, and that is no later than its manifest, and no later than now."""
    latest = min(datetime.now(UTC), moment(until) or datetime.max.replace(tzinfo=UTC))
    for way in ways(kept):
        said = way.get("made_at")
        when = moment(said)
        if said and when is None:
            yield Finding("other time", kept.name, f"made at {said}, which is no time in UTC")
        elif when is not None and when > latest:
            yield Finding("other time", kept.name, f"made at {said}, which is after {latest.isoformat()}")


def moment(said: object) -> datetime | None:
    """A moment by its text; None if it is none, or of no zone."""
    try:
        found = datetime.fromisoformat(str(said))
    except ValueError:
        return None
    return found if found.tzinfo else None
