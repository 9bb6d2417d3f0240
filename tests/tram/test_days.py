"""Days of a tram line: reproducible, no claim broken; claims break where a guard or an assumption does (G2 to G6)."""

from __future__ import annotations

from dataclasses import replace
from functools import cache
from random import Random
from typing import Any

import numpy as np
import pytest

from kernel.tram import centre as dispatcher
from kernel.tram import cycle, dispatching, display, stopping
from kernel.tram.centre import Centre, Tram
from kernel.tram.dispatching import Known, Report
from models.compiled import packed, unpacked
from models.tram import given as plan
from models.tram import tally
from models.tram.days import SYSTEM, one_day
from models.tram.deciding import (
    confirm,
    hear_elsewhere,
    hear_report,
    may_take_up,
    restart_centre,
    take_off_by_hand,
    view_of,
)
from models.tram.faults import DRAWN_ALONE, FAULTS
from models.tram.given import LIMITS
from models.tram.machines import MADE
from models.tram.state import K_ELSEWHERE, K_IS, NEVER_MS, Traffic, begun
from models.tram.telling import keep_known, known_of
from tests.onboard.agree import agree_along_runs, agree_on_values, functions, states_of

NONE = frozenset[str]()
WITHIN = frozenset(name for name, fault in FAULTS.items() if not fault.breaks)
"""The faults that break no assumption."""


def column(rows: Any, name: str) -> int:
    """What a column sums up to."""
    return int(np.atleast_2d(rows)[:, SYSTEM.columns.index(name)].sum())


@cache
def ten_days() -> Any:
    """Ten days with drawn faults."""
    return SYSTEM.simulate(7, range(10))


def test_a_system_has_its_columns() -> None:
    assert SYSTEM.columns == tally.COLUMNS
    assert len(set(SYSTEM.columns)) == len(SYSTEM.columns) == ten_days().shape[1]
    assert SYSTEM.hours >= 16
    assert SYSTEM.simulate(7, range(0)).shape == (0, len(SYSTEM.columns))


def test_no_claim_and_no_assumption_is_broken_and_trams_run() -> None:
    for name in (*SYSTEM.claims, *SYSTEM.assumptions):
        assert column(ten_days(), name) == 0, name
    for name in (*SYSTEM.prices, *SYSTEM.counts):
        assert column(ten_days(), name) > 0, name
    assert column(ten_days(), "tram_s") > 10 * 16 * 3_600


def test_a_day_is_the_same_in_whatever_batch() -> None:
    assert (SYSTEM.simulate(7, range(3, 6)) == ten_days()[3:6]).all()
    assert (SYSTEM.simulate(7, range(9, 10)) == ten_days()[9:]).all()
    assert (SYSTEM.simulate(8, range(2)) != ten_days()[:2]).any()


def test_faults_are_drawn_by_their_chance() -> None:
    rows = SYSTEM.simulate(7, range(10))
    for name in FAULTS:
        assert set(rows[:, SYSTEM.columns.index(f"fault_{name}")]) <= {0, 1}
    assert sum(column(rows, f"fault_{name}") for name in FAULTS) > 10


@pytest.mark.parametrize(
    ("plant", "present", "broken"),
    [
        (plan.NOT_ADDRESSED, frozenset({"repeats"}), "wrong_tram"),
        (plan.NEVER_PRESENT, NONE, "recovery_occupied"),
        (plan.NEVER_PRESENT, NONE, "recovery_unknown"),
        (plan.NEVER_STALE, frozenset({"centre_slow"}), "order_by_guess"),
        (plan.NEVER_LOST, frozenset({"canyon", "gps_outage"}), "recovery_beyond"),
        (plan.GPS_BEYOND, NONE, "place_broken"),
        (plan.GPS_BEYOND, NONE, "reached_too_soon"),
        (plan.TAKES_UP_ANEW, frozenset({"asked_anew"}), "order_turned"),
        (plan.LEAVES_AT_ONCE, frozenset({"wrong_way"}), "reached_too_soon"),
        (plan.LEAVES_AT_ONCE, frozenset({"wrong_way"}), "recovery_occupied"),
    ],
)
def test_what_is_planted_is_reported(plant: int, present: frozenset[str], broken: str) -> None:
    """A guard gone, or a fault beyond its range; without it nothing is."""
    assert sum(column(one_day(3, number, present=present, plant=plant)[0], broken) for number in range(4)) > 0
    assert sum(column(one_day(3, number, present=present)[0], broken) for number in range(4)) == 0


# ---- ordinary days


@pytest.mark.parametrize(
    ("name", "noticed"),
    [
        ("asked_anew", "not_taken_up_anew"),
        ("wrong_destination", "beyond_destination"),
        ("centre_restart", "not_known_s"),
        ("late_at_terminus", "confirmed_anew"),
        ("wrong_way", "set_wrong"),
    ],
)
def test_what_an_ordinary_day_brings_is_noticed_and_breaks_no_claim(name: str, noticed: str) -> None:
    """Trams on the way are not taken up anew, wrong settings are seen, or tell of no stop that was left (G5, G6)."""
    rows = np.array([one_day(3, number, present=frozenset({name}))[0] for number in range(4)])
    without = np.array([one_day(3, number, present=NONE)[0] for number in range(4)])
    assert column(rows, noticed) > column(without, noticed) == 0
    for broken in (*SYSTEM.claims, *SYSTEM.assumptions):
        assert column(rows, broken) == 0, broken


def test_what_is_drawn_alone_changes_nothing_else_of_a_day() -> None:
    """Nor what is drawn apart of it; where its own things are is the same with it and without."""
    for number in range(3):
        days, backs = [], []
        for present in (NONE, *(frozenset({name}) for name in DRAWN_ALONE)):
            apart = np.random.default_rng((number, 2))
            days.append(plan.given(np.random.default_rng(number), apart, present=present)[0])
            backs.append(plan.other_way(days[-1], apart))
        assert {day.where for day in days} == {days[0].where}
        assert min(days[1].ahead_ms, days[2].asked_anew, days[3].number_told_s, days[4].wrong_way) > 0
        for each in (days, backs):
            rest = [day._replace(ahead_ms=0, asked_anew=0, number_told_s=0, wrong_way=0) for day in each]
            assert all(np.array_equal(one, first) for day in rest for one, first in zip(day, rest[0], strict=True))


def test_orders_of_the_future_are_refused_until_their_time_has_come() -> None:
    """A station's clock is ahead: that breaks an assumption, which is named; a copy may be taken late (G3, G6)."""
    assert SYSTEM.beyond["order_from_the_future"] == "the_frame_carries_the_order"
    ahead = frozenset({"order_from_the_future", "repeats", "centre_slow"})
    rows, planted, without = (
        np.array([one_day(3, number, present=present, plant=plant)[0] for number in range(4)])
        for present, plant in (
            (ahead, plan.NO_PLANT),
            (ahead, plan.TAKES_THE_FUTURE),
            (ahead - set(DRAWN_ALONE), plan.NO_PLANT),
        )
    )
    assert column(rows, "of_the_future") > column(without, "of_the_future") == 0
    assert column(rows, "frame_broken") > column(without, "frame_broken") == 0
    assert column(without, "order_stale") == 0
    for broken in (*SYSTEM.claims, *SYSTEM.assumptions):
        assert column(rows, broken) == 0 or broken in ("frame_broken", "order_stale"), broken
    assert column(planted, "order_stale") > column(rows, "order_stale")


def test_reports_that_contradict_each_other_are_counted_and_forbid_recovery() -> None:
    """A tram tells another one's number: that breaks an assumption, which is named; unheeded it is worse (G2, G6)."""
    other = ("number_of_another",)
    assert SYSTEM.beyond["number_of_another"] == "a_report_tells_where_it_is"
    heeded, unheeded = (
        one_day(3, 72, present=NONE, plant=plant, beyond=other)[0]
        for plant in (plan.NO_PLANT, plan.IGNORES_CONTRADICTION)
    )
    for row in (heeded, unheeded):
        assert column(row, "contradicted") == 1
        assert column(row, "report_broken") > 0
    assert column(unheeded, "recovery_unknown") > column(heeded, "recovery_unknown")
    assert column(one_day(3, 72, present=NONE)[0], "contradicted") == 0


def test_who_tells_the_number_of_another_takes_its_orders() -> None:
    """And what it tells the other has not told: orders for that one are made by guess (G2, G6)."""
    told, without = (one_day(3, 8, present=NONE, beyond=beyond)[0] for beyond in (("number_of_another",), ()))
    for broken in ("wrong_tram", "order_by_guess"):
        assert column(told, broken) > column(without, broken) == 0


# ---- both directions, and a junction

TOO_SOON = frozenset({"both_ways", "wrong_way"})
BACK, LATE_TELEGRAMS = frozenset({"both_ways"}), frozenset({"both_ways", "repeats"})
JUNCTION = frozenset({"junction"})


def test_trams_turn_at_the_terminus_and_join_at_the_junction() -> None:
    """Each of this line comes back by the terminus, each of the other one by the junction; no claim breaks (G4, G5)."""
    for present, came in ((NONE, set()), (BACK, {"turned"}), (JUNCTION, {"turned", "joined"})):
        row = one_day(3, 0, present=present)[0]
        assert {name for name in ("turned", "joined") if column(row, name) > 40} == came
        assert column(row, "given_up") <= 2
        for name in (*SYSTEM.claims, *SYSTEM.assumptions):
            assert column(row, name) == 0, name


def test_with_every_fault_at_once_both_ways_hold() -> None:
    rows = np.array([one_day(3, number, present=WITHIN)[0] for number in range(4)])
    for name in (*SYSTEM.claims, *SYSTEM.assumptions):
        assert column(rows, name) == 0, name
    assert min(column(rows, "turned"), column(rows, "joined")) > 40


def test_trams_that_are_confirmed_and_set_too_soon_break_no_claim() -> None:
    """They tell of stops of the way back beside them, while they are still on this one (G2, G5)."""
    rows = np.array([one_day(3, number, present=TOO_SOON)[0] for number in range(4)])
    assert column(rows, "set_too_soon") > 0
    for name in (*SYSTEM.claims, *SYSTEM.assumptions):
        assert column(rows, name) == 0, name


@pytest.mark.parametrize(
    ("plant", "present", "broken"),
    [
        (plan.ANY_WORD_ENDS, LATE_TELEGRAMS, "recovery_occupied"),
        (plan.ANY_WORD_ENDS, LATE_TELEGRAMS, "recovery_unknown"),
        (plan.JOINS_UNASKED, JUNCTION, "recovery_occupied"),
    ],
)
def test_a_guard_of_turning_or_joining_is_missed(plant: int, present: frozenset[str], broken: str) -> None:
    """A word of the other way, told late, ends a run of this one; a tram joins before one that recovers (G5)."""
    assert sum(column(one_day(3, number, present=present, plant=plant)[0], broken) for number in range(4)) > 0
    assert sum(column(one_day(3, number, present=present)[0], broken) for number in range(4)) == 0


def test_a_day_without_turning_is_what_it_was() -> None:
    """What is drawn of turning and joining changes nothing else of a day."""
    sources = [np.random.default_rng(2) for _ in range(2)]
    sources[1].random(9)
    days = [plan.given(np.random.default_rng(1), apart, present=NONE) for apart in sources]
    assert all(np.array_equal(one, other) for one, other in zip(days[0][0][:5], days[1][0][:5], strict=True))
    assert days[0][0].where == days[1][0].where
    assert days[0][1] == days[1][1]


def test_the_other_way_is_the_same_line_from_its_other_end() -> None:
    """Its stops, its canyon and its deaf station lie at the same places."""
    for number in range(9):
        apart = np.random.default_rng(number)
        day, _ = plan.given(np.random.default_rng(number), apart, present=frozenset({"canyon", "station_deaf"}))
        back = plan.other_way(day, apart)
        line_mm = day.stops_mm[-1]
        assert (back.stops_mm + day.stops_mm[::-1] == line_mm).all()
        assert back.where.canyon_mm + back.canyon_mm == line_mm - day.where.canyon_mm
        assert back.stops_mm[back.where.station] == line_mm - day.stops_mm[day.where.station]
        assert (back.boards_a_second == day.boards_a_second[::-1]).all()


@pytest.mark.parametrize("name", FAULTS)
def test_each_fault_makes_a_difference(name: str) -> None:
    others = [place for place, each in enumerate(SYSTEM.columns) if not each.startswith("fault_")]
    for number in range(20):
        without, with_it = (one_day(5, number, present=present)[0] for present in (NONE, frozenset({name})))
        assert column(with_it, f"fault_{name}") == 1
        if (without[others] != with_it[others]).any():
            return
    pytest.fail(f"{name} changes nothing")


def test_holding_evens_out_the_intervals() -> None:
    """The same days without a centre: trams bunch more (002, 3.2.1; G4)."""
    held, free = (
        np.mean([spread(one_day(5, number, limits, NONE)[2]) for number in range(4)])
        for limits in (LIMITS, plan.UNCONTROLLED)
    )
    assert held < free


def spread(log: Any) -> float:
    """The deviation of the intervals between departures, over their mean, at the stop before the branch."""
    left = log[:, 14]
    apart = np.diff(np.sort(left[left >= 0]))
    return float(np.std(apart) / np.mean(apart))


# ---- compiled, and arrays for maps, against the kernel in CPython

MACHINES = {"cycle": cycle, "dispatching": dispatching, "display": display, "stopping": stopping}


@pytest.mark.parametrize(
    ("machine", "name"), [(m, name) for m, module in MACHINES.items() for name in functions(module)]
)
def test_compiled_functions_agree_with_cpython(machine: str, name: str) -> None:
    seen = agree_on_values(MACHINES[machine], getattr(MADE, machine), name, 150)
    assert seen.total() == 150


@pytest.mark.parametrize("machine", ["cycle", "display", "stopping"])
def test_compiled_machines_agree_along_runs(machine: str) -> None:
    states = states_of(MACHINES[machine])
    assert states
    assert sum(agree_along_runs(MACHINES[machine], getattr(MADE, machine), state, 20, 20) for state in states) > 0


def drawn(chance: Random) -> tuple[Centre, Traffic, list[Tram]]:
    """The same knowledge of some trams in maps and in arrays."""
    count = chance.randrange(1, 6)
    traffic = begun(count, 10, 1, len(tally.COLUMNS), 0)
    now_ms = 1_000_000
    trams, left_ms = {}, {}
    for number in range(count):
        known = Known(
            leaves_at=chance.randrange(10),
            since_ms=now_ms - chance.choice((5, 300_000, 900_000)),
            stop=chance.randrange(4),
            left=chance.random() < 0.4,
            stands=chance.random() < 0.6,
            arrived_ms=now_ms - chance.randrange(100_000),
            told_ms=now_ms - chance.choice((0, 11_000, 11_001)),
            recovery_to=chance.randrange(6),
            comes_at=0 if chance.random() < 0.5 else 2,
        )
        trams[Tram(str(number))] = known
        keep_known(traffic.trams[number], packed(known))
        for stop in range(7):
            if chance.random() < 0.5:
                made_ms = now_ms - chance.choice((119_999, 120_000, 239_999, 240_000, 600_000, 600_001))
                left_ms[Tram(str(number)), stop] = made_ms
                traffic.left_ms[number, stop] = made_ms
    elsewhere_ms, shown = {}, set()
    for number in range(count):
        if chance.random() < 0.5:
            elsewhere_ms[Tram(str(number))] = traffic.trams[number, K_ELSEWHERE] = now_ms - 7
        if chance.random() < 0.2:
            del trams[Tram(str(number))]
            traffic.trams[number, K_IS] = 0
        for other in range(count):
            if other != number and chance.random() < 0.6:
                shown.add((Tram(str(number)), Tram(str(other))))
                traffic.shown[number, other] = 1
    traffic.known[:] = opens_ms, cleared = now_ms - chance.choice((0, 8_000)), chance.choice((-1, 3, 8, 11))
    everyone = [Tram(str(number)) for number in range(count)]
    return Centre(now_ms, opens_ms, cleared, trams, left_ms, frozenset(shown), elsewhere_ms), traffic, everyone


def agree(centre: Centre, traffic: Traffic) -> bool:
    """Whether maps and arrays hold the same."""
    count = len(traffic.trams)
    for number in range(count):
        body, tram = traffic.trams[number], Tram(str(number))
        assert (body[K_IS] == 1) == (tram in centre.trams)
        assert tram not in centre.trams or unpacked(known_of(body), Known) == centre.trams[tram]
        assert body[K_ELSEWHERE] == centre.elsewhere_ms.get(tram, NEVER_MS)
        for place in range(7):
            assert traffic.left_ms[number, place] == centre.left_ms.get((tram, place), NEVER_MS)
        for other in range(count):
            assert (traffic.shown[number, other] == 1) == ((tram, Tram(str(other))) in centre.shown)
    return (centre.opens_ms, centre.cleared) == tuple(traffic.known)


def change(chance: Random, centre: Centre, traffic: Traffic, number: int) -> None:
    """Let one thing happen to both."""
    tram, stop, leaves_at = Tram(str(number)), chance.randrange(-1, 6), chance.randrange(9)
    made_ms = centre.now_ms - chance.randrange(-9, 9_000)
    report = Report(chance.randrange(5), chance.random() < 0.5, chance.random() < 0.7, 7, made_ms)
    kind = chance.randrange(5)
    if kind == 0:
        may = dispatcher.may_come(centre, tram, stop)
        assert may_take_up(traffic, number, stop) == may
        assert confirm(traffic, number, stop, leaves_at, centre.now_ms) == may
        after = dispatcher.note_coming(centre, tram, stop, leaves_at)
    elif kind == 1:
        hear_report(traffic, number, packed(report), centre.now_ms)
        after = dispatcher.note_report(centre, tram, report)
    elif kind == 2:
        hear_elsewhere(traffic, number, report.left, made_ms, centre.now_ms)
        after = dispatcher.note_elsewhere(centre, tram, report.left, made_ms)
    elif kind == 3:
        take_off_by_hand(traffic, number, centre.now_ms)
        after = dispatcher.note_taken_off(centre, tram)
    else:
        restart_centre(packed(LIMITS), traffic, centre.now_ms)
        after = dispatcher.restarted(LIMITS, centre, centre.now_ms)
    assert agree(after, traffic)


def test_arrays_say_what_maps_say() -> None:
    """The view that an order rests on, what is taken up, and what a report changes."""
    chance = Random(11)
    seen = []
    for _ in range(1_500):
        centre, traffic, trams = drawn(chance)
        number = chance.randrange(len(trams))
        tram = trams[number]
        own = centre.trams.get(tram)
        if own is not None:
            view = dispatcher.view(LIMITS, centre, tram, own)
            found = view_of(packed(LIMITS), traffic, number, packed(own), centre.now_ms)
            assert unpacked(found, dispatching.View) == view
            seen.append(view)
        assert agree(centre, traffic)
        change(chance, centre, traffic, number)
    for name in ("is_clear", "is_present", "ahead_is_far", "ahead_is_near", "behind_is_far"):
        assert {getattr(view, name) for view in seen} == {True, False}, name


def test_a_tram_that_is_not_known_counts_nowhere() -> None:
    _, traffic, trams = drawn(Random(1))
    own = Known(9, 0, 0, False, True, 0, 0, 0, -1)
    traffic.known[1] = 9
    for number in range(len(trams)):
        traffic.trams[number, K_IS] = 0
    view = view_of(packed(LIMITS), traffic, 0, packed(own), 1_000_000)
    assert unpacked(view, dispatching.View) == replace(
        dispatching.View(True, False, True, False, False), behind_is_far=False
    )
