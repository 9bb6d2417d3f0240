"""The host's maps and sets do what ``dict`` and ``frozenset`` do, and the kernel decides on them as on these."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from kernel.centre import Centre
from models.host.maps import HostMap, HostSet, hosted
from models.layouts import load
from models.simulator.journey import Chances
from models.simulator.play import WORLD, Step
from models.simulator.traffic import Troubles, traffic_on
from models.world.state import Site, System

ROOT = Path(__file__).resolve().parents[2]
MAPS = ("accounted", "runs", "claimed", "locked", "terminal_life")
TROUBLES = Troubles(centre_restarts=0.001, unit_restarts=0.001, terminal_restarts=0.002, old_message=0.1)
SETS = ("lost_blocks", "lost_points")

entries = st.dictionaries(st.integers(0, 9), st.integers(0, 3))
some = st.frozensets(st.integers(0, 9))


@given(st.lists(entries), st.booleans())
def test_a_map_holds_what_a_dict_holds(added: list[dict[int, int]], sparse: bool) -> None:
    held: dict[int, int] = {}
    map_: HostMap[int, int] = HostMap({}, empty_is_absent=sparse)
    for each in added:
        before, copy = map_, dict(map_.items())
        map_, held = map_ | each, held | each
        assert dict(before.items()) == copy, "the old one stays"
    told = {key: value for key, value in held.items() if value or not sparse}
    assert map_ == told
    assert map_ == HostMap(told)
    assert (len(map_), sorted(map_), sorted(map_.items())) == (len(told), sorted(told), sorted(told.items()))
    for key in range(10):
        assert (key in map_) == (key in told)
        assert (map_.get(key), map_.get(key, 7)) == (told.get(key), told.get(key, 7))
        assert key not in told or map_[key] == told[key]
    assert map_ != HostMap(told | {10: 1})


@given(some, st.lists(st.tuples(st.booleans(), some)))
def test_a_set_holds_what_a_frozenset_holds(first: frozenset[int], changes: list[tuple[bool, frozenset[int]]]) -> None:
    held, set_ = first, HostSet(first)
    for adds, members in changes:
        before, copy = set_, frozenset(set_)
        held, set_ = (held | members, set_ | members) if adds else (held - members, set_ - members)
        assert frozenset(before) == copy, "the old one stays"
    assert set_ == held
    assert set_ == HostSet(held)
    assert (len(set_), sorted(set_)) == (len(held), sorted(held))
    assert all((member in set_) == (member in held) for member in range(10))
    assert set_ != HostSet(held | {10})


def plain(centre: Centre) -> Centre:
    """The state in dicts and frozensets; what is empty is not told where absent means none."""
    told: dict[str, Any] = {name: dict(getattr(centre, name).items()) for name in MAPS}
    for name in ("claimed", "locked"):
        told[name] = {key: value for key, value in told[name].items() if len(value)}
    told |= {name: frozenset(getattr(centre, name)) for name in SETS}
    return replace(centre, **told)


class Twin:
    """The same world with the centre's state on the host's maps; it takes each step that the first one tries."""

    def __init__(self, system: System) -> None:
        self.system = replace(system, centre=hosted(system.centre))
        self.changed_by: set[str] = set()

    def beside(self, name: str, step: Step) -> Step:
        """The step of the first; the twin has to come to the same by it."""

        def take(site: Site, system: System, **event: Any) -> System:
            after, twin = step(site, system, **event), step(site, self.system, **event)
            self.system = replace(twin, centre=hosted(twin.centre))
            assert plain(self.system.centre) == plain(after.centre), (name, event)
            assert replace(self.system, centre=after.centre) == after, (name, event)
            if after != system:
                self.changed_by.add(name)
            return after

        return take


@pytest.mark.parametrize("layout", sorted((ROOT / "layouts").glob("*.toml")), ids=lambda path: path.stem)
def test_the_kernel_decides_the_same_on_them(layout: Path) -> None:
    """Whatever is tried, with losses, restarts, cancellations and recoveries; the refused changes neither."""
    changed_by: set[str] = set()
    for seed in range(4, 8):
        moving = traffic_on(load(layout), seed, Chances(), TROUBLES, 3)
        twin = Twin(moving.play.system)
        moving.play.steps = {name: twin.beside(name, step) for name, step in WORLD.items()}
        moving.run(900)
        assert isinstance(twin.system.centre.claimed, HostMap)
        changed_by |= twin.changed_by
    assert changed_by >= {"request", "note_echo", "release_block", "retire", "restart_centre", "take_standing"}


def test_what_a_restart_makes_plain_is_moved_over_once() -> None:
    traffic = traffic_on(load(ROOT / "layouts" / "junction.toml"), 1, Chances(), Troubles(), 1)
    centre = hosted(traffic.play.system.centre)
    assert all(isinstance(getattr(centre, name), HostMap) for name in MAPS)
    assert all(isinstance(getattr(centre, name), HostSet) for name in SETS)
    assert hosted(centre) is centre
