"""What the proofs rest on by their unsat cores, both ways: invariants on guards and updates, and back."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from proofs.theories import theory_of

RECORD = "cores.json"
"""What ``python -m proofs.cores --json out/cores.json`` leaves."""


@dataclass(frozen=True)
class Used:
    """What the proofs of one invariant rest on: by each guard, or update, the transitions over which they do."""

    guards: Mapping[str, Sequence[str]]
    updates: Mapping[str, Sequence[str]]


@dataclass(frozen=True)
class Cored:
    """The cores of all proofs.

    ``by_guard``: the invariants that rest on each guard, with in how many cores.  ``idle``: guards in no core, with
    the transitions that they are of.  ``idle_updates``: the same of updates.  ``missing``: parts of obligations for
    which there is no core.
    """

    obligations: int
    missing: int
    unnamed: int
    minimal: bool
    by_invariant: Mapping[str, Used]
    by_guard: Mapping[str, Mapping[str, int]]
    idle: Mapping[str, Sequence[str]]
    idle_updates: Mapping[str, Sequence[str]]


def cored(data: Mapping[str, Any]) -> Cored:
    """Read the record; names in order, so that the order of the record does not matter."""
    by_invariant: dict[str, dict[str, dict[str, list[str]]]] = {}
    by_guard: dict[str, dict[str, int]] = {}
    seen: set[tuple[str, str]] = set()
    for each in sorted(data["obligations"], key=lambda one: (one["transition"], one["invariant"])):
        row = each["transition"]
        full = f"{theory_of(row)[0].name}.{each['invariant']}"
        mine = by_invariant.setdefault(full, {"guards": {}, "updates": {}})
        for kind in ("guards", "updates"):
            for name in each[kind]:
                mine[kind].setdefault(name, []).append(row)
                seen.add((row, name))
        for guard in each["guards"]:
            counts = by_guard.setdefault(guard, {})
            counts[full] = counts.get(full, 0) + 1
    return Cored(
        len(data["obligations"]),
        sum(each["open"] for each in data["obligations"]),
        data["unnamed"],
        data["minimal"],
        {name: Used(_sorted(used["guards"]), _sorted(used["updates"])) for name, used in by_invariant.items()},
        _sorted({guard: _sorted(counts) for guard, counts in by_guard.items()}),
        _idle(data["guards"], {name for _, name in seen}),
        _idle_in_row(data["updates"], seen),
    )


def _sorted(found: Mapping[str, Any]) -> dict[str, Any]:
    return dict(sorted(found.items()))


def _idle(known: Mapping[str, Sequence[str]], used: set[str]) -> dict[str, Sequence[str]]:
    """What stands in no core of any transition, with the transitions that it is of."""
    found: dict[str, list[str]] = {}
    for row in sorted(known):
        for name in known[row]:
            if name not in used:
                found.setdefault(name, []).append(row)
    return _sorted(found)


def _idle_in_row(known: Mapping[str, Sequence[str]], used: set[tuple[str, str]]) -> dict[str, Sequence[str]]:
    """What each transition defines anew that stands in no core of its own."""
    found = {row: [name for name in known[row] if (row, name) not in used] for row in sorted(known)}
    return {row: names for row, names in found.items() if names}
