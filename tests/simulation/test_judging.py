"""An invariant is asked again once something that it reads has changed: it reads nothing beside what is listed."""

from __future__ import annotations

from dataclasses import replace
from operator import attrgetter
from types import SimpleNamespace
from typing import Any

import pytest

from fuzz.simulation import judging
from fuzz.simulation.judging import Judge, parts_of, reads
from models.world.state import Site, System
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
    listed = parts_of(name)(day.system)
    unlisted = {path for path in paths if not any(attrgetter(".".join(path))(day.system) is part for part in listed)}
    assert not {path for path in unlisted if not any(getattr(day.system, path[0]) is part for part in listed)}


def test_an_answer_stands_until_something_that_it_reads_is_another(
    day: Scenario, monkeypatch: pytest.MonkeyPatch
) -> None:
    class Now:
        now_s = 0
        play: Any = day

    worked_out: list[str] = []

    def holds(name: str, site: Site, system: System) -> bool:
        worked_out.append(name)
        return bool(INVARIANTS[name](site, system))

    monkeypatch.setattr(judging, "holds", holds)
    judge: Any = Judge()
    judge.look(Now)
    assert sorted(worked_out) == sorted(INVARIANTS)
    judge.look(Now)
    assert sorted(worked_out) == sorted(INVARIANTS)
    assert set(judge.asked.values()) == {2}
    track = day.system.track
    Now.play = SimpleNamespace(
        site=day.site, system=replace(day.system, track=replace(track, at=dict(track.at.items())))
    )
    judge.look(Now)
    again = worked_out[len(INVARIANTS) :]
    assert set(again) == {name for name, paths in reads().items() if ("track", "at") in paths}
