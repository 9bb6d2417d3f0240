"""An invariant is asked again once something that it reads has changed: it reads nothing beside what is listed."""

from __future__ import annotations

from typing import Any

import pytest

from fuzz.simulation.judging import Judge, _part, reads
from models.world.state import System
from proofs.catalogue import INVARIANTS
from proofs.witnesses.long_day import two_trains_pass
from proofs.witnesses.scenario import STEPS, Scenario


class Seen:
    """A state that notes which of its parts are looked at."""

    def __init__(self, whole: Any, path: tuple[str, ...], paths: set[tuple[str, ...]]) -> None:
        self._of = whole, path, paths

    def __getattr__(self, name: str) -> Any:
        whole, path, paths = self._of
        part = getattr(whole, name)
        if path or not hasattr(part, "__dataclass_fields__"):
            paths.add((*path, name))
            return part
        return Seen(part, (name,), paths)


@pytest.fixture(scope="module")
def day() -> Scenario:
    return two_trains_pass(STEPS)


@pytest.mark.parametrize("name", INVARIANTS)
def test_an_invariant_reads_what_is_listed(day: Scenario, name: str) -> None:
    paths: set[tuple[str, ...]] = set()
    seen: Any = Seen(day.system, (), paths)
    assert INVARIANTS[name](day.site, seen)
    assert paths, "it reads something"
    listed = [_part(day.system, path) for path in reads()[name]]
    unlisted = {path for path in paths if not any(_part(day.system, path) is part for part in listed)}
    assert not {path for path in unlisted if not any(getattr(day.system, path[0]) is part for part in listed)}


def test_no_invariant_is_asked_twice_of_the_same_state(day: Scenario) -> None:
    class Now:
        now_s = 0
        play = day

    judge: Any = Judge()
    judge.look(Now)
    once = dict(judge.asked)
    assert set(once.values()) == {1}
    judge.look(Now)
    assert dict(judge.asked) == once
    assert isinstance(day.system, System)
