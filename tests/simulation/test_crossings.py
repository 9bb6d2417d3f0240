"""Level crossings of a simulated line: closed in time before every train whatever fails, and opened again."""

from __future__ import annotations

import math
from dataclasses import replace
from pathlib import Path
from random import Random
from typing import Any

import networkx as nx
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from kernel import names
from kernel.crossing import arrival, crossing
from kernel.crossing.arrival import ArrivalBounds, Followed, Ranging
from kernel.crossing.crossing import Crossing, Due, Settings, Train
from kernel.maps import Map
from models.concrete.rails import Piece
from models.concrete.train import OnRails
from models.crossing.sites import SETTINGS
from models.layouts import BadInput
from models.layouts.track import HIGH, LOW
from models.simulation import crossings, road_oracles
from models.simulation.beginning import rails_of
from models.simulation.crossings import Crossings
from models.simulation.facing import onwards
from models.simulation.faults import NO_FAULT, Chosen, Setting
from models.simulation.road_oracles import CLOSED_IN_TIME, CLOSED_UNDER, OPENS_AGAIN
from models.simulation.roads import Ways, read_roads
from models.simulation.simulation import Simulation
from tests.simulation.lines import HARD, ROADS, SAMPLES, imported, plan, road, simulated

NEAR_THE_STAND = (road("passing_station", "Near Lane", ("east", 2_700)),)
"""So near before the place where trains turn that they would be there before the road was closed for its time."""
ROOMY = (road("passing_station", "Mill Road", ("west", 2_300)), road("passing_station", "Long Lane", ("east", 1_500)))
"""Where no train begins on the road."""


def line(chosen: Chosen, seed: int = 1, hours: float = 0.3, **more: Any) -> Simulation:
    sim = Simulation(plan("passing_station", seed=seed, hours=hours, chosen=chosen, **{"roads": ROOMY, **more}))
    sim.run()
    return sim


def broken(sim: Simulation) -> set[str]:
    return {each.oracle for each in sim.oracles.found}


# ---- what must be


@settings(max_examples=6, deadline=None)
@given(place=st.sampled_from(SAMPLES), seed=st.integers(0, 2**31 - 1))
def test_every_road_is_closed_in_time_whatever_fails(place: str, seed: int) -> None:
    often = {"start_point_silent": Setting(3, 1, 120), "crossing_radio_silent": Setting(6, 3, 300)}
    found = simulated(plan(place, seed, hours=0.2, chosen={**HARD, **often}, roads=ROADS[place]))
    assert found.holds, found.broken
    told = found.record()["crossings"]
    assert set(told) == {each.name for each in ROADS[place]}
    for each in told.values():
        assert each["closed_s"] == sum(to_s - from_s for from_s, to_s in each["closings"])
        assert each["least_warning_s"] is None or each["least_warning_s"] >= SETTINGS.warning_cycles
    assert found.sim.oracles.checked[CLOSED_IN_TIME] == sum(each["trains"] for each in told.values())


def test_without_faults_a_road_is_closed_for_trains_alone_and_not_much_longer_than_it_must() -> None:
    sim = line(NO_FAULT, seed=7, hours=0.6)
    assert not sim.oracles.found
    for state in sim.crossings.states.values():
        closings = state.closures(sim.now_s)
        assert state.passed >= 2
        lasts = state.closed_s is not None
        assert 0 < len(state.closings) <= state.passed
        assert not lasts or any(seen.under or math.isfinite(seen.ahead_mm) for seen in state.seen.values())
        assert sum(to_s - from_s for from_s, to_s in closings) < sim.now_s / 3
        assert state.least_s is not None
        assert SETTINGS.warning_cycles <= state.least_s <= SETTINGS.warning_cycles + 10
    assert sim.oracles.checked[CLOSED_UNDER] > sim.oracles.checked[CLOSED_IN_TIME] >= 4


def test_start_points_close_the_road_where_the_radio_is_dead() -> None:
    sim = line({"crossing_radio_silent": Setting(0, 9_999, 9_999, (0.0,) * 40)}, seed=3, hours=0.4)
    assert not sim.oracles.found
    assert sum(state.passed for state in sim.crossings.states.values()) >= 2
    assert not any(state.followed for state in sim.crossings.states.values())


def test_a_train_that_begins_on_the_road_has_it_closed() -> None:
    sim = line(NO_FAULT, hours=0.03, roads=ROADS["passing_station"])
    assert not sim.oracles.found
    state = sim.crossings.states["Mill Road"]
    assert any(seen.under for seen in state.seen.values())
    assert not state.closings
    assert sim.oracles.checked[CLOSED_UNDER] > 100


def test_a_start_point_that_is_not_heard_closes_the_road_until_it_is() -> None:
    sim = line({"start_point_silent": Setting(0, 60, 60, (30.0,))}, trains=1, hours=0.03)
    assert not sim.oracles.found
    closings = [each for state in sim.crossings.states.values() for each in state.closures(sim.now_s)]
    (from_s, to_s), *_ = closings
    assert 30 + SETTINGS.silence_cycles <= from_s <= 30 + SETTINGS.silence_cycles + 2
    assert 90 <= to_s <= 92


def test_a_train_in_contact_departs_where_no_start_point_is_heard() -> None:
    silent: Chosen = {"start_point_silent": Setting(0, 9_999, 9_999, (0.0,))}
    sim = line(silent, hours=0.4, roads=(road("passing_station", "Far Lane", ("east", 2_100)),))
    assert not sim.oracles.found
    assert sim.crossings.states["Far Lane"].passed >= 2


def test_a_train_that_cannot_say_that_it_is_gone_is_released_by_a_person(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(Crossings, "_is_whole", lambda _crossings, _vehicle: False)
    monkeypatch.setattr(crossings, "PERSON_S", (30, 60))
    sim = line(NO_FAULT, seed=3)
    assert not sim.oracles.found
    released = [event for event in sim.diary.events if "by a person who has seen" in event.text]
    assert len(released) >= 2
    assert any(state.closings for state in sim.crossings.states.values())


def test_a_train_that_begins_its_run_near_the_road_waits_until_it_is_closed() -> None:
    sim = line(NO_FAULT, hours=0.3, roads=NEAR_THE_STAND)
    assert not sim.oracles.found
    assert sim.crossings.states["Near Lane"].passed >= 2


def test_a_road_makes_no_difference_to_a_record_without_one() -> None:
    record = simulated(plan("passing_station")).record()
    assert record["crossings"] == {}
    assert record["oracles"][OPENS_AGAIN]["checked"] == 0


# ---- planted faults: an oracle sees each


DECIDE = crossing.decide


def never(settings: Settings, known: Crossing, dues: Map[Train, Due]) -> Crossing:
    """A crossing that warns of nobody."""
    return replace(DECIDE(settings, known, dues), warns=False, warned_cycles=0)


def for_ever(settings: Settings, known: Crossing, dues: Map[Train, Due]) -> Crossing:
    """A crossing that does not open."""
    return replace(DECIDE(settings, known, dues), warns=True)


@pytest.mark.parametrize(("decides", "sees"), [(never, {CLOSED_IN_TIME, CLOSED_UNDER}), (for_ever, {OPENS_AGAIN})])
def test_a_crossing_that_decides_wrongly_is_noticed(
    monkeypatch: pytest.MonkeyPatch, decides: Any, sees: set[str]
) -> None:
    monkeypatch.setattr("models.simulation.crossings.machine.decide", decides)
    monkeypatch.setattr(road_oracles, "AT_LEAST_QUIET_S", 120)
    assert broken(line(NO_FAULT, hours=0.5)) == sees


def test_a_train_that_is_gone_and_not_forgotten_is_noticed(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("models.simulation.crossings.machine.note_gone", lambda known, *_: known)
    monkeypatch.setattr(road_oracles, "AT_LEAST_QUIET_S", 120)
    assert broken(line(NO_FAULT, hours=0.5)) == {OPENS_AGAIN}


def test_a_train_that_is_believed_slower_than_it_is_is_noticed(monkeypatch: pytest.MonkeyPatch) -> None:
    slow = replace(crossings.BOUNDS, line_um=15_000_000, gain_um=100_000)
    monkeypatch.setattr(crossings, "BOUNDS", slow)
    monkeypatch.setattr(crossings, "START_MM", 100_000)
    assert CLOSED_IN_TIME in broken(line(NO_FAULT, hours=0.5))


def test_a_ranging_that_says_too_much_is_noticed(monkeypatch: pytest.MonkeyPatch) -> None:
    taken = arrival.taken

    def too_far(bounds: ArrivalBounds, followed: Followed, ranging: Ranging) -> Followed:
        return taken(bounds, followed, replace(ranging, way_mm=ranging.way_mm + 400_000))

    monkeypatch.setattr(crossings, "START_MM", 100_000)
    monkeypatch.setattr("models.simulation.crossings.arrival.taken", too_far)
    assert CLOSED_IN_TIME in broken(line(NO_FAULT, hours=0.5))


def test_a_train_that_is_told_gone_too_early_is_noticed(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(crossings, "END_MM", -60_000)
    assert CLOSED_UNDER in broken(line(NO_FAULT, hours=0.5))


def test_a_driver_who_does_not_wait_for_the_road_is_noticed(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(Crossings, "lets_depart", lambda _crossings, _train: True)
    assert CLOSED_IN_TIME in broken(line(NO_FAULT, hours=0.3, roads=NEAR_THE_STAND))


# ---- where roads are


@settings(max_examples=60, deadline=None)
@given(place=st.sampled_from(SAMPLES), seed=st.integers(0, 2**31 - 1))
def test_the_way_to_a_road_is_the_shortest_over_whichever_points(place: str, seed: int) -> None:
    rails, random = rails_of(imported(place)), Random(seed)
    ways = Ways(rails, random.choice(ROADS[place]))
    graph: nx.DiGraph[Any] = nx.DiGraph()
    for index in range(len(rails.segments.segments)):
        graph.add_nodes_from(((index, LOW), (index, HIGH)))
        for side in (LOW, HIGH):
            for onward in onwards(rails, (index, side)):
                graph.add_edge((index, side), onward, mm=rails.length_mm((index, side)))
    heading = random.choice([(i, side) for i in range(len(rails.segments.segments)) for side in (LOW, HIGH)])
    length_mm = rails.length_mm(heading)
    front_mm = random.randrange(length_mm)
    train = OnRails(names.Train("T01"), [], [Piece(heading, 0, length_mm)], front_mm, random)
    found: list[float] = [at - front_mm for at in ways.at_mm.get(heading, ()) if at > front_mm]
    for target, places in ways.at_mm.items():
        for onward in onwards(rails, heading):
            if nx.has_path(graph, onward, target):
                mm = nx.shortest_path_length(graph, onward, target, weight="mm")
                found.append(length_mm - front_mm + mm + min(places))
    assert ways.ahead_mm(train, front_mm) == min(found, default=math.inf)


def test_a_file_says_where_roads_are(tmp_path: Path) -> None:
    path = tmp_path / "roads.toml"
    path.write_text('["Mill Road"]\nplaces = [{ track = "west", at_m = 2000 }]\n')
    assert read_roads(path, rails_of(imported("passing_station"))) == ROADS["passing_station"][:1]
    path.write_text("")
    assert read_roads(path, rails_of(imported("passing_station"))) == ()


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ("[a]\nplaces = 1\n", "is not a table with a list"),
        ("a = 1\n", "is not a table with a list"),
        ("[a]\nplaces = []\n", "has no place"),
        ("[a]\nplaces = [1]\n", "has other keys"),
        ('[a]\nplaces = [{ track = "west" }]\n', "has other keys"),
        ('[a]\nplaces = [{ track = "wst", at_m = 1 }]\n', "'wst' is no track of the layout"),
        ("[a]\nplaces = [{ track = 3, at_m = 1 }]\n", "3 is no track of the layout"),
        ('[a]\nplaces = [{ track = "west", at_m = "1" }]\n', "'a.places.at_m': is not a number"),
        ('[a]\nplaces = [{ track = "west", at_m = nan }]\n', "'a.places.at_m': is not a number"),
        ('[a]\nplaces = [{ track = "west", at_m = true }]\n', "'a.places.at_m': is not a number"),
        ('[a]\nplaces = [{ track = "west", at_m = -1 }]\n', "'a.places.at_m': is not a number from 0"),
        ('[a]\nplaces = [{ track = "west", at_m = 1200 }]\n', "at 1200 m 'west' ends, or is cut"),
        ('[a]\nplaces = [{ track = "west", at_m = inf }]\n', "'a.places.at_m': is not a number from 0"),
        ("[a\n", "is not TOML"),
        ('[a]\nplaces = [{ track = "west", at_m = 1' + 400 * "0" + " }]\n", "'a.places.at_m': is not a number"),
        ("a = 1" + 5_000 * "0", "number: cannot be read"),
    ],
)
def test_what_is_wrong_in_a_file_is_told_in_one_line(tmp_path: Path, text: str, told: str) -> None:
    path = tmp_path / "roads.toml"
    path.write_text(text)
    with pytest.raises(BadInput) as bad:
        read_roads(path, rails_of(imported("passing_station")))
    assert told in str(bad.value)
    assert "\n" not in str(bad.value)
