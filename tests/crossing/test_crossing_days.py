"""Days at the crossing: no claim breaks, planted faults and broken assumptions are seen, and a day stays the same."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from kernel.crossing import crossing as machine
from kernel.crossing.crossing import Crossing, Due, Train
from models.compiled import compiled, packed, unpacked
from models.crossing.columns import ASSUMPTIONS, CLAIMS, COLUMNS, NUMBER
from models.crossing.days import SYSTEM, one_day
from models.crossing.faults import FAULTS, KIND
from models.crossing.made import MADE, NO_DUES
from models.crossing.records import SET
from models.crossing.sites import CURVED, SETTINGS, STRAIGHT, TRIALS
from models.crossing.traffic import SECONDS, drawn, there_m
from models.crossing.watch import Machines, decide, watched
from models.days.system import Numbers

BROKEN_BY = {fault.name: fault.breaks for fault in FAULTS if fault.breaks}
COLUMN_OF = {
    "reflection": "ranging_broken",
    "stale": "age_broken",
    "unstruck": "strike_broken",
    "parts": "rear_broken",
    "slow_arms": "arms_broken",
    "strong": "gain_broken",
    "unlooked": "account_broken",
}


def counted(rows: Numbers, names: Mapping[str, str]) -> dict[str, int]:
    """Sums of some columns that are not 0."""
    sums = {name: int(rows[:, NUMBER[name]].sum()) for name in names}
    return {name: value for name, value in sums.items() if value}


def days(count: int, **planted: Any) -> Numbers:
    return np.array([one_day(5, day, **planted) for day in range(count)])


def test_no_claim_breaks_and_no_assumption_does() -> None:
    rows = SYSTEM.simulate(5, range(12))
    assert counted(rows, CLAIMS) == {}
    assert counted(rows, ASSUMPTIONS) == {}
    assert (rows[:, NUMBER["arrivals"]] > 400).all()
    assert rows[:, NUMBER["held"]].sum() > 50
    assert rows[:, NUMBER["in_contact"]].sum() > 0.7 * rows[:, NUMBER["arrivals"]].sum()
    assert (rows[:, NUMBER["seconds"]] == SECONDS).all()
    assert SYSTEM.columns == COLUMNS


def test_a_day_is_the_same_in_whatever_batch() -> None:
    whole = SYSTEM.simulate(7, range(4))
    assert (np.concatenate([SYSTEM.simulate(7, range(1)), SYSTEM.simulate(7, range(1, 4))]) == whole).all()
    assert (SYSTEM.simulate(8, range(4)) != whole).any()


@pytest.mark.sampled(3)
@pytest.mark.parametrize("name", BROKEN_BY)
def test_a_broken_assumption_is_named(name: str) -> None:
    """And no other is, but those that follow from it."""
    rows = days(6, beyond=(name,))
    broken = counted(rows, ASSUMPTIONS)
    assert COLUMN_OF[name] in broken
    assert set(broken) <= {COLUMN_OF[name], "strike_broken", "start_broken"}


def test_broken_assumptions_break_claims() -> None:
    """With wrong rangings it warns or opens wrongly, what stays behind is opened for, slow arms close late."""
    claims = {name: set(counted(days(10, beyond=(name,)), CLAIMS)) for name in ("reflection", "parts", "slow_arms")}
    assert claims["reflection"] & {"late_warning", "lifted_between"}
    assert "opened_before_rear" in claims["parts"]
    assert "short_closure" in claims["slow_arms"]


# ---- planted faults


@pytest.mark.sampled(2)
@pytest.mark.parametrize(
    ("change", "claim"),
    [({"reopening_cycles": 0}, "lifted_between"), ({"silence_cycles": 10**6}, "unwarned_silence")],
)
def test_a_dropped_guard_is_seen(change: dict[str, int], claim: str) -> None:
    """Nobody is near any more; silence warns no more."""
    assert claim in counted(days(20, settings=packed(replace(SETTINGS, **change))), CLAIMS)


Made = MADE.crossing.Crossing


@compiled
def known(crossing: Any, asks: Any, silent: Any) -> Any:
    """What a crossing knows, with other askers and silences."""
    return Made(
        asks,
        crossing.starts,
        silent,
        crossing.unaccounted,
        crossing.numbers,
        crossing.looks,
        crossing.number,
        crossing.warns,
        crossing.warned_cycles,
    )


@compiled
def careless(settings: Any, crossing: Any, dues: Any) -> Any:
    """Who has no answer is taken to be far, and whoever asked is forgotten."""
    asks, told = crossing.asks.copy(), dues.copy()
    for place, (name, _) in enumerate(crossing.asks):
        asks[place] = (name, False)
        told.append((name, 0))
    forgot = known(crossing, asks, crossing.silent_cycles)
    return decide(settings, forgot, told)


def test_a_machine_that_forgets_is_seen() -> None:
    broken = counted(days(2, decides=careless), CLAIMS)
    assert "late_warning" in broken
    assert "short_closure" in broken


Point = MADE.start_point.StartPoint


@compiled
def believing(settings: Any, point: Any, train: Any, tag: Any) -> Any:
    """Whatever is told of any tag waits for the next strike, whoever has struck since."""
    return Point(train, settings.waits_cycles, point.struck_cycles, point.owes)


def test_a_strike_put_down_to_another_train_is_seen() -> None:
    """On days on which trains without radio run beside others, or close behind; with the machine itself there is none.

    A train that nobody warns of finds the road open.
    """
    named = ("beside", "late_reads")
    rows = days(4, beyond=named)
    assert counted(rows, CLAIMS) == {}
    assert rows[:, NUMBER["fault_beside"]].all()
    assert rows[:, NUMBER["unread"]].sum() > 0
    broken = counted(days(4, beyond=named, reads=believing), CLAIMS)
    assert {"wrong_striker", "late_warning"} <= set(broken)


LATE_S = 2


@compiled
def as_of_now(settings: Any, crossing: Any, dues: Any) -> Any:
    """Words that are under way count as ones of now."""
    silent = crossing.silent_cycles.copy()
    for place, (track, cycles) in enumerate(crossing.silent_cycles):
        silent[place] = (track, cycles - LATE_S)
    now = decide(settings, known(crossing, crossing.asks, silent), dues)
    return known(now, now.asks, crossing.silent_cycles)


def test_silence_counts_from_when_a_terminal_spoke() -> None:
    """Its words are under way all day, nobody has a radio, and it fails as a train strikes (X3).

    That train is warned of in time; the others as long after their strikes as words take.
    """
    day = drawn(5, 0, STRAIGHT, quiet=True)
    day.trains["radio"] = 0
    day.faults[KIND["late_words"]] = (0, 2 * SECONDS, 0, LATE_S)
    ours = np.flatnonzero(day.trains["track"] == 0)
    untouched = watched(STRAIGHT, day, np.zeros(len(COLUMNS), np.int64))
    told_s = untouched["asked_s"] - untouched["struck_s"]
    assert (told_s[ours] == LATE_S).all()
    assert (np.delete(told_s, ours) == 0).all()
    found = []
    for train in ours[10:40:5]:
        fails_s = int(untouched["struck_s"][train])
        day.faults[KIND["terminal"]] = (fails_s, fails_s + 60, 0, 0)
        sound, broken = np.zeros((2, len(COLUMNS)), np.int64)
        watched(STRAIGHT, day, sound)
        assert counted(sound[None], CLAIMS) == counted(sound[None], ASSUMPTIONS) == {}
        watched(STRAIGHT, day, broken, Machines(decides=as_of_now))
        found.append((sound[NUMBER["silences"]], broken[NUMBER["unwarned_silence"]]))
    assert sum(silences for silences, _ in found) > 0
    assert sum(unwarned for _, unwarned in found) > 0


def test_trains_run_side_by_side_and_close_behind() -> None:
    """One of each two has a radio and the other one none (X3)."""
    for name in ("beside", "close_behind"):
        day = drawn(2, 0, STRAIGHT, beyond=(name,))
        window = day.faults[KIND[name]]
        within = day.trains[(day.trains["at_s"] >= window["begin_s"]) & (day.trains["at_s"] < window["end_s"])]
        assert 0.3 < within["radio"].mean() < 0.8
        pairs = {(int(at_s), int(radio)) for at_s, radio in zip(within["at_s"], within["radio"], strict=True)}
        assert sum((at_s, 1) in pairs and (at_s, 0) in pairs for at_s, _ in pairs) > 12


@compiled
def of_any_tag(settings: Any, read: Any, age: Any) -> Any:
    """Whichever two tags a tail has read, its train is gone."""
    return read.is_whole


@compiled
def wherever_it_is(bounds: Any, followed: Any, ranging: Any, start_mm: Any) -> Any:
    """Whoever runs away is let go."""
    return ranging.valid and ranging.speed_mm_s < 0


def test_who_turns_back_before_its_start_point_is_let_go() -> None:
    """And nobody inside it: whoever lets such a train go takes a train for gone that is not."""
    named = ("turns_back",)
    rows = days(8, beyond=named)
    assert counted(rows, CLAIMS) == counted(rows, ASSUMPTIONS) == {}
    assert rows[:, NUMBER["turned_back"]].sum() > 1
    assert counted(days(8, beyond=named, turns=wherever_it_is), ASSUMPTIONS).keys() == {"rear_broken"}


def test_two_roads_close_together() -> None:
    """Each train comes to both; what is told of the tags beyond the one opens the other for nobody (X4, T14).

    Without looking at the tags the second road opens, or stays open, before a train that has passed the first one.
    """
    rows = days(4, beyond=("close_roads",))
    assert counted(rows, CLAIMS) == counted(rows, ASSUMPTIONS) == {}
    assert rows[:, NUMBER["fault_close_roads"]].all()
    assert (rows[:, NUMBER["arrivals_beside"]] == rows[:, NUMBER["arrivals"]]).all()
    assert (rows[:, NUMBER["closed_beside_s"]] > 0.3 * rows[:, NUMBER["closed_s"]]).all()
    broken = counted(days(4, beyond=("close_roads",), hears=of_any_tag), CLAIMS)
    assert {"late_warning", "short_closure", "opened_before_rear"} <= set(broken)


def test_a_second_road_changes_nothing_of_the_days_trains() -> None:
    """But who turns back does so before the road that it comes to first."""
    compared = 0
    for number in range(12):
        alone, two = (drawn(4, number, STRAIGHT, beyond=more) for more in ((), ("close_roads",)))
        if alone.faults[KIND["close_roads"]]["begin_s"] < 0:
            turns = (two.trains["trick"] == KIND["turns_back"]) & (two.trains["track"] == 1)
            assert (alone.trains[~turns] == two.trains[~turns]).all()
            compared += 1
    assert compared > 3
    assert [there_m("turns_back", track, 300.0, 400.0) for track in (0, 1)] == [300.0, 700.0]
    assert [there_m("stops_short", track, 300.0, 400.0) for track in (0, 1)] == [300.0, 300.0]


# ---- what the days are made of


@pytest.mark.parametrize("trial", TRIALS)
def test_runs_are_of_this_world(trial: Any) -> None:
    """Trains pass in order of time, arrive after they have struck, and are past after they have arrived."""
    run = watched(trial, drawn(3, 0, trial, quiet=True), np.zeros(len(COLUMNS), np.int64))
    assert (run["arrived_s"] > run["struck_s"]).all()
    assert (run["out_s"] > run["arrived_s"]).all()
    assert (run["asked_s"] < run["arrived_s"]).all()
    assert (run["old_s"] < run["arrived_s"]).all()
    warned_s = run["arrived_s"] - run["asked_s"]
    assert warned_s.min() >= SETTINGS.warning_cycles


def test_a_day_of_many_trains() -> None:
    for trial in (STRAIGHT, CURVED):
        day = drawn(1, 0, trial)
        assert len(day.trains) == 2 * sum(trial.trains)
        assert set(day.trains["track"]) == {0, 1}
        assert (np.diff(day.trains["at_s"][day.trains["track"] == 0]) >= 0).all()
    with pytest.raises(KeyError):
        drawn(1, 0, STRAIGHT, beyond=("flood",))


def test_quiet_days_have_no_fault() -> None:
    day = drawn(1, 0, CURVED, quiet=True)
    assert (day.faults["begin_s"] == -1).all()
    assert (day.trains["radio"] == 1).all()


# ---- the compiled machine


def test_cpython_and_compiled_decide_alike() -> None:
    """On drawn states and answers (X2 to X4)."""
    source = np.random.default_rng(1)
    for _ in range(300):
        asks = {Train(number): bool(source.integers(2)) for number in range(source.integers(4))}  # type: ignore[arg-type]
        silent = {number: int(source.integers(5)) for number in range(2)}
        warns = bool(source.integers(2))
        unaccounted = {number: bool(source.integers(8) == 0) for number in range(2)}
        numbers = {train: int(source.integers(9)) for train in asks}
        looks = {number: int(source.integers(9)) for number in range(2)}
        starts = {train: int(source.integers(50)) for train in asks if source.integers(2)}
        warned_cycles = int(source.integers(100)) if warns else 0
        crossing = Crossing(asks, starts, silent, unaccounted, numbers, looks, 9, warns, warned_cycles)  # type: ignore[arg-type]
        dues = {train: Due(int(source.integers(3))) for train in asks if source.random() < 0.8}
        told = NO_DUES.copy()
        for train, due in dues.items():
            told.append((int(train), due.value))
        made = decide(SET, packed(crossing), told)
        assert unpacked(made, Crossing) == machine.decide(SETTINGS, crossing, dues)
        assert unpacked(MADE.crossing.aged(made), Crossing) == machine.aged(machine.decide(SETTINGS, crossing, dues))
