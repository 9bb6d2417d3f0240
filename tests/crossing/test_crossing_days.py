"""Days at the crossing: no claim breaks, planted faults and broken assumptions are seen, and a day stays the same."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from kernel.crossing import crossing as machine
from kernel.crossing.crossing import Crossing, Due, Standing, Train
from models.compiled import compiled, packed, unpacked
from models.crossing.columns import ASSUMPTIONS, CLAIMS, COLUMNS, NUMBER
from models.crossing.days import SYSTEM, one_day
from models.crossing.faults import FAULTS, KIND
from models.crossing.made import MADE, NO_DUES
from models.crossing.records import SET
from models.crossing.sites import CURVED, SETTINGS, STRAIGHT, TRIALS
from models.crossing.starting import BESIDE, SIGNALS
from models.crossing.traffic import SECONDS, drawn, there_m
from models.crossing.watch import Machines, decide, look_of, note_heard, watched
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
    "unasked": "start_broken",
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
    """But who turns back does so before the road that it comes to first, and none comes back over both."""
    compared = 0
    for number in range(12):
        alone, two = (drawn(4, number, STRAIGHT, beyond=more) for more in ((), ("close_roads",)))
        if alone.faults[KIND["close_roads"]]["begin_s"] < 0:
            turns = (two.trains["trick"] == KIND["turns_back"]) & (two.trains["track"] == 1)
            turns |= alone.trains["trick"] == KIND["turns_beyond"]
            assert not (two.trains["trick"] == KIND["turns_beyond"]).any()
            assert (alone.trains[~turns] == two.trains[~turns]).all()
            compared += 1
    assert compared > 3
    assert [there_m("turns_back", track, 300.0, 400.0) for track in (0, 1)] == [300.0, 700.0]
    assert [there_m("stops_short", track, 300.0, 400.0) for track in (0, 1)] == [300.0, 300.0]


# ---- terminals that start, tracks that are left out, trains that come back


@compiled
def as_if_none_were_missed(crossing: Any, track: Any) -> Any:
    """That a terminal may have missed strikes is not heard."""
    return crossing


@compiled
def known_tracks_alone(crossing: Any, track: Any, age: Any) -> Any:
    """A terminal whose track the settings leave out is not heard."""
    return note_heard(crossing, track, age) if look_of(crossing, track) > 0 else crossing


@compiled
def at_once(settings: Any, crossing: Any, train: Any) -> Any:
    """Whoever asks to start is let go."""
    has_asked = False
    for asked, _ in crossing.starts:
        has_asked = has_asked or asked == train
    return has_asked


@compiled
def shut(settings: Any, crossing: Any, dues: Any) -> Any:
    """Once the road has been closed it stays so."""
    now = decide(settings, crossing, dues)
    warns = now.warns or crossing.warns
    return Made(
        now.asks, now.starts, now.silent_cycles, now.unaccounted, now.numbers, now.looks, now.number, warns,
        now.warned_cycles,
    )  # fmt: skip


def test_a_terminal_starts_between_tag_and_detector_and_as_trains_strike() -> None:
    """A train strikes as its terminal has no power, or has not told of it: it is warned of all the same (X3, T14).

    With words under way and without; a person opens the road once he has seen the track empty.
    """
    missed, broken = 0, set()
    for words_s in (0, LATE_S):
        day = drawn(5, 0, STRAIGHT, quiet=True)
        day.trains["radio"] = np.arange(len(day.trains)) % 2
        day.faults[KIND["late_words"]] = (0, 2 * SECONDS, 0, words_s)
        untouched = watched(STRAIGHT, day, np.zeros(len(COLUMNS), np.int64))
        for number, train in enumerate(np.flatnonzero(day.trains["track"] == 0)[10:60:5]):
            begins_s = int(untouched["struck_s"][train]) - 2 + number % 4
            day.faults[KIND["terminal_restarts"]] = (begins_s, begins_s + 1 + number % 3, 0, 60)
            sound, deaf = np.zeros((2, len(COLUMNS)), np.int64)
            run = watched(STRAIGHT, day, sound)
            assert counted(sound[None], CLAIMS) == counted(sound[None], ASSUMPTIONS) == {}
            assert (sound[NUMBER["owed"]], sound[NUMBER["accounted"]]) == (1, 1)
            assert (run["cleared"] == 1).all()
            missed += sound[NUMBER["missed"]]
            watched(STRAIGHT, day, deaf, Machines(misses=as_if_none_were_missed))
            broken |= set(counted(deaf[None], CLAIMS))
    assert missed > 5
    assert {"late_warning", "opened_before_rear", "opened_unseen"} <= broken


def test_days_on_which_a_terminal_starts() -> None:
    rows = days(6, beyond=("terminal_restarts",))
    assert counted(rows, CLAIMS) == counted(rows, ASSUMPTIONS) == {}
    assert (rows[:, NUMBER["owed"]] > 0).all()
    assert rows[:, NUMBER["missed"]].sum() > 0
    assert "opened_unseen" in counted(days(6, beyond=("terminal_restarts",), misses=as_if_none_were_missed), CLAIMS)


def test_a_track_that_settings_leave_out_is_closed_for() -> None:
    """Its terminal is heard, and a person is asked to look at it too; who hears it not opens the road (X3)."""
    rows = days(6, beyond=("unlisted",))
    assert counted(rows, CLAIMS) == counted(rows, ASSUMPTIONS) == {}
    assert (rows[:, NUMBER["accounted"]] >= 2).all()
    deaf = days(6, beyond=("unlisted",), notes=known_tracks_alone)
    assert "opened_unseen" in counted(deaf, CLAIMS)
    assert "track_broken" in counted(deaf, ASSUMPTIONS)


def test_who_comes_back_over_the_road_has_the_whole_warning() -> None:
    """And no road stays closed for it afterwards; let go as soon as it asks it comes too soon (X4, X5)."""
    rows = days(8, beyond=("turns_beyond",))
    assert counted(rows, CLAIMS) == counted(rows, ASSUMPTIONS) == {}
    came = rows[:, NUMBER["came_back"]]
    assert (came == rows[:, NUMBER["fault_turns_beyond"]]).all()
    assert came.sum() > 3
    broken = counted(days(8, beyond=("turns_beyond",), lets=at_once), CLAIMS)
    assert {"late_warning", "short_closure"} <= set(broken)
    assert "late_warning" in counted(days(8, beyond=("unasked",)), CLAIMS)


@pytest.mark.parametrize("trial", TRIALS)
def test_a_train_stands_beyond_an_open_road_and_comes_back(trial: Any) -> None:
    """On a quiet day, as near as 60 m, with a radio and without: no claim breaks, and all are told gone (X3, X5)."""
    for number, (size_m, radio) in enumerate(((60, 1), (60, 0), (400, 1), (900, 0))):
        day = drawn(5, 0, trial, quiet=True)
        train = 100 + number
        cars = (trial.local if day.trains["local"][train] else trial.express).cars
        day.trains["radio"][train], day.trains["trick"][train] = radio, KIND["turns_beyond"]
        day.trains["trick_um"][train], day.trains["trick_s"][train] = -1_000_000 * (size_m + 20 * cars), 300
        row = np.zeros(len(COLUMNS), np.int64)
        run = watched(trial, day, row)
        assert counted(row[None], CLAIMS) == counted(row[None], ASSUMPTIONS) == {}
        assert row[NUMBER["came_back"]] == row[NUMBER["arrivals"]] - len(day.trains) == run["is_back"][train] == 1
        assert run["starts_s"][train] < run["asked_s"][train] + 5
        assert run["started_s"][train] < run["arrived_s"][train]
        assert (run["cleared"] == 1).all()


def test_a_road_that_stays_closed_is_seen() -> None:
    assert "latched" in counted(days(2, decides=shut), CLAIMS)


def test_faults_drawn_apart_leave_the_days_trains_as_they_are() -> None:
    named = ("terminal_restarts", "unlisted", "turns_beyond", "unasked")
    others = [number for name, number in KIND.items() if name not in named]
    compared = 0
    for number in range(12):
        alone, more = (drawn(4, number, STRAIGHT, beyond=beyond) for beyond in ((), named))
        back = (alone.trains["trick"] == KIND["turns_beyond"]) | (more.trains["trick"] >= KIND["turns_beyond"])
        assert (alone.trains[~back] == more.trains[~back]).all()
        assert (alone.faults[others] == more.faults[others]).all()
        assert (alone.normal == more.normal).all()
        compared += int(back.sum())
    assert compared > 6


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


def told_alike(crossing: Crossing, track: Any, train: Any) -> tuple[Crossing, Any]:
    """What a crossing is told of terminals and starts, in CPython and compiled: the same comes of it (X3, X4)."""
    made, calls = packed(crossing), MADE.crossing
    crossing = machine.note_missed(machine.note_heard(crossing, track, 1), track)
    made = calls.note_missed(calls.note_heard(made, track, 1), track)
    assert unpacked(made, Crossing) == crossing
    crossing, made = machine.note_start(crossing, train, 20), calls.note_start(made, train, 20)
    for another in (train, Train(1)):  # type: ignore[arg-type]
        crossing = machine.note_standing(SIGNALS, crossing, another, Standing(BESIDE, True))
        made = calls.note_standing(packed(SIGNALS), made, another, packed(Standing(BESIDE, True)))
        assert machine.may_start(SETTINGS, crossing, another) == calls.may_start(SET, made, another)
    assert unpacked(made, Crossing) == crossing
    return crossing, made


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
        track, train = source.integers(3), Train(int(source.integers(4)))  # type: ignore[arg-type]
        crossing, made = told_alike(crossing, track=int(track), train=train)
        made = decide(SET, made, told)
        assert unpacked(made, Crossing) == machine.decide(SETTINGS, crossing, dues)
        assert unpacked(MADE.crossing.aged(made), Crossing) == machine.aged(machine.decide(SETTINGS, crossing, dues))
