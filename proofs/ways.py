"""The ways that a transition changes the state, and several of them taken together."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from proofs.lift.terms import and_, not_, same, to_z3


@dataclass(frozen=True)
class Way:
    """One way that a transition changes the state: its condition, what it defines, the state after.

    ``tests``: what the condition consists of, in the order in which it is tested.
    """

    condition: Any
    definitions: list[Any]
    after: Any
    tests: tuple[Any, ...]


def together(ways: Sequence[Way]) -> list[Any]:
    """Give conditions, one of which holds when one of these ways is taken: none tests what makes no difference."""
    if len(ways) == 1:
        return [ways[0].condition]
    return [to_z3(and_(*tests)) for tests in _together([way.tests for way in ways])]


def _together(paths: Sequence[tuple[Any, ...]]) -> list[tuple[Any, ...]]:
    """Give paths that cover the same: where both answers to a test lead to the same paths it is left out."""
    if any(not path for path in paths):
        return [()]
    test = paths[0][0]
    passed = [path[1:] for path in paths if same(path[0], test)]
    failed = [path[1:] for path in paths if same(path[0], not_(test))]
    if len(passed) + len(failed) < len(paths):
        return list(paths)
    yes, no = _together(passed), _together(failed) if failed else []
    both = [path for path in yes if any(_same(path, other) for other in no)]
    apart = [
        *((test, *path) for path in yes if not any(_same(path, other) for other in both)),
        *((not_(test), *path) for path in no if not any(_same(path, other) for other in both)),
    ]
    return [*both, *apart]


def _same(path: tuple[Any, ...], other: tuple[Any, ...]) -> bool:
    return len(path) == len(other) and all(same(one, another) for one, another in zip(path, other, strict=True))
