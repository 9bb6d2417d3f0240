"""Days of trains that turn, couple and part, of a line's end and of two workers; each shows what it is there for.

No claim is broken on them, and a handset that leaves out what the day is about is found wrong (A1 to A3).
"""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from kernel.alarm.network import Connection, Opening, Way
from kernel.alarm.tone import Freshness
from kernel.maps import Map
from models.alarm.columns import ASSUMPTIONS, CLAIMS, COLUMNS, NUMBER
from models.alarm.coupling import COUPLED, PARTED, STAYS_S, first_of
from models.alarm.days import SYSTEM, of_the_day, one_day
from models.alarm.draws import SECONDS, another, drawn
from models.alarm.faults import KIND
from models.alarm.figures import BRANCH_MM
from models.alarm.line import KM, LENGTH_MM, REGISTER, REGULAR
from models.alarm.moving import LENGTH_M
from models.alarm.truth import in_section
from models.alarm.watch import ALARM_TONE, NOTHING, REGISTERED, trace, watch
from models.compiled import packed
from tests.alarm.test_days import ALARM, CAUTION, NORMAL, SEED, spoiled, total

DAYS = ("turns_at_once", "coupled", "parted", "adjoined", "two_workers", "branches")
BOUNDS = REGISTER.bounds


def lived(began: Any, written: Any, register: Any, first_s: int = 0, told_s: int = 0) -> tuple[Any, Any]:
    """Let a day pass by a register, with a handset that has another one; give what was written down, and the row."""
    kept, row = trace(places=True, first_s=first_s, told_s=told_s), np.zeros(len(COLUMNS), np.int64)
    watch(began, of_the_day(written, began), of_the_day(register, began), ALARM_TONE, NOTHING, row, kept)
    return kept, row


def beside(began: Any, worker_m: float) -> Any:
    """Give the day with a worker who stands at a place."""
    return began._replace(worker_m=worker_m, walk_m=0.0)


@pytest.mark.sampled(2)
@pytest.mark.parametrize("day", DAYS)
def test_no_claim_is_broken_and_no_assumption(day: str) -> None:
    rows = SYSTEM.simulate(SEED, range(4), day)
    assert (rows[:, NUMBER[f"fault_{day}"]] == 1).all()
    assert total(rows, CLAIMS) == total(rows, ASSUMPTIONS) == 0


# ---- trains that turn at once


def turns(places: Any) -> list[int]:
    """Give the seconds in which a train came to a stand from which it ran back."""
    stands = np.flatnonzero((np.diff(places[:-1]) != 0) & (np.diff(places[1:]) == 0)) + 1
    return [int(at) for at in stands if (places[at + 60] - places[at]) * (places[at - 60] - places[at]) > 0]


def test_who_believes_a_direction_for_longer_than_a_train_takes_to_turn_is_wrong() -> None:
    """Its unit falls silent as the train comes to a stand; fixes are fresh for 90 s here, that they can be old (A3)."""
    old = packed(replace(REGISTER, fresh=Freshness(90_000, 12_000, 8_000, 5_000)))
    wrong = packed(
        replace(REGISTER, fresh=Freshness(90_000, 12_000, 8_000, 5_000), bounds=replace(BOUNDS, turning_ms=90_000))
    )
    silent, tried, right, broken = KIND["train_silent"], 0, 0, 0
    for day in range(4):
        began = drawn(SEED, day, ("turns_at_once",), sound=True)
        train = int(began.train[KIND["turns_at_once"]])
        places = lived(began, REGISTERED, REGISTERED)[0].places[:, train]
        for at in turns(places):
            worker_m = float(places[at] + np.sign(places[at - 60] - places[at]) * 2_500.0)
            if in_section(began, worker_m) or not 0 < worker_m < LENGTH_M:
                continue
            began.begin_s[silent], began.end_s[silent], began.train[silent] = at - 8, at + 80, train
            right += total(lived(beside(began, worker_m), old, old)[1], CLAIMS)
            broken += total(lived(beside(began, worker_m), old, wrong)[1], CLAIMS)
            tried += 1
            break
    assert tried > 1
    assert right == 0
    assert broken > 0


# ---- trains that couple and part


def length_m(began: Any, train: int) -> float:
    """How long a train is by itself."""
    return float(began.below_m[train] + began.above_m[train])


def test_two_trains_that_have_coupled_are_near_by_their_nearest_part_and_one_number_goes() -> None:
    wrong = packed(
        replace(REGISTER, bounds=replace(BOUNDS, train_mm_s=0, length_mm=0, train_error_mm=0, worker_error_mm=0))
    )
    coupled = broken = 0
    for day in range(6):
        began = drawn(SEED, day, ("coupled",), sound=True)
        one = first_of(began, COUPLED)
        places = lived(began, REGISTERED, REGISTERED)[0].places
        ends, goes_on = (one + 1, one) if began.size[COUPLED] > 0 else (one, one + 1)
        last_s = int(np.flatnonzero(~np.isnan(places[:, ends]))[-1])
        at_m, on_m = places[last_s, ends], places[last_s + 1, goes_on]
        if at_m in (0.0, LENGTH_M):
            continue
        coupled += 1
        way = np.sign(at_m - on_m)
        ahead_m = began.above_m[goes_on] if way > 0 else began.below_m[goes_on]
        worker_m = float(on_m + way * (ahead_m + length_m(began, ends) + 1_490.0))
        kept, row = lived(beside(began, worker_m), REGISTERED, REGISTERED, last_s + 1, 60)
        stands = slice(last_s + 1, last_s + STAYS_S)
        assert (np.abs(kept.seconds[stands, 2] - 1_490_000) < 10).all(), "the part that was the other train is nearest"
        assert in_section(began, worker_m) or (kept.seconds[stands, 0] == ALARM).all()
        assert total(row, CLAIMS) == total(row, ASSUMPTIONS) == 0
        assert kept.told[0, ends, 0] == 1
        assert kept.told[-1, ends, 0] == 0
        assert (kept.told[:, goes_on, 0] == 1).all()
        heard = lived(beside(began, worker_m), REGISTERED, wrong)[0].seconds[stands, 0]
        broken += int(((heard == CAUTION) | (heard == NORMAL)).sum())
    assert coupled > 2
    assert broken > 0, "who reckons from antenna to antenna hears caution"


def test_the_rear_of_a_train_that_parts_is_a_train_of_its_own_that_was_entered_before() -> None:
    unlisted, parted, broken = KIND["unlisted"], 0, 0
    for day in range(6):
        began = drawn(SEED, day, ("parted",), sound=True)
        one = first_of(began, PARTED)
        places, back = lived(began, REGISTERED, REGISTERED)[0].places, -began.heading[one]
        came = np.flatnonzero(~np.isnan(places[:, one + 1]))
        if not came.size:
            continue
        parted, came_s = parted + 1, int(came[0])
        behind_m = began.below_m[one] if back < 0 else began.above_m[one]
        worker_m = float(places[came_s, one] + back * (behind_m + length_m(began, one + 1) + 1_490.0))
        kept, row = lived(beside(began, worker_m), REGISTERED, REGISTERED, came_s - 60, 61)
        assert abs(kept.seconds[came_s, 2] - 1_490_000) < 10
        assert in_section(began, worker_m) or (kept.seconds[came_s : came_s + STAYS_S, 0] == ALARM).all()
        assert total(row, CLAIMS) == total(row, ASSUMPTIONS) == 0
        assert kept.told[0, one + 1, 0] == 0
        assert (kept.told[-9:, one + 1, 0] == 1).all()
        assert places[came_s + 300, one + 1] != places[came_s, one + 1]
        began.begin_s[unlisted], began.end_s[unlisted], began.train[unlisted] = came_s - 20, came_s + 7_200, one + 1
        row = lived(began, REGISTERED, REGISTERED)[1]
        assert total(row, ASSUMPTIONS) > 0
        broken += total(row, ["mild_unknown_s"])
    assert parted > 2
    assert broken > 0, "a number that was taken off is missed"


# ---- the line's end


def test_beside_a_lines_end_a_register_that_has_the_next_line_is_of_use_and_one_without_it_is_not() -> None:
    """Of use: else every second of the day would be the fault tone or the alarm, as with an opening at the end (A1)."""
    rows, wrong = np.zeros((2, 4, len(COLUMNS)), np.int64)
    normal = 0
    for day in range(4):
        began = drawn(SEED, day, ("adjoined",), sound=True)
        written = of_the_day(REGISTERED, began)
        watch(began, written, written, ALARM_TONE, NOTHING, rows[day], trace())
        watch(began, written, REGISTERED, ALARM_TONE, NOTHING, wrong[day], trace())
        shut = written._replace(openings=packed({0: LENGTH_MM}, Map[Opening, int]))
        no_use = np.zeros(len(COLUMNS), np.int64)
        watch(began, written, shut, ALARM_TONE, NOTHING, no_use, trace())
        normal += total(no_use, ["normal_s"])
    assert total(rows, CLAIMS) == total(rows, ASSUMPTIONS) == 0
    assert total(rows, ["normal_s"]) > total(rows, ["seconds"]) / 2
    assert total(wrong, CLAIMS) > 0
    assert normal == 0


def test_trains_run_over_a_lines_end() -> None:
    began = drawn(SEED, 0, ("adjoined",), sound=True)
    places = lived(began, REGISTERED, REGISTERED)[0].places
    assert (np.nanmin(places[:, :REGULAR], axis=0) == 0.0).sum() > 20
    assert (np.nanmax(places[:, :REGULAR], axis=0) == LENGTH_M + 3_600.0).sum() > 20


# ---- a branch


def test_over_a_junction_that_the_register_has_trains_come_and_none_is_missed() -> None:
    """One without the ways misses them; one with ways that are too long does as well (A1)."""
    rows, missed, far = (np.zeros((4, len(COLUMNS)), np.int64) for _ in range(3))
    for day in range(4):
        began = drawn(SEED, day, ("branches",), sound=True)
        written = of_the_day(REGISTERED, began)
        joint_mm = 1_000 * abs(int(began.size[KIND["branches"]]))
        longer = {0: Connection(joint_mm, BRANCH_MM, KM), 1: Connection(BRANCH_MM, joint_mm, KM)}
        for register, row in (
            (written, rows[day]),
            (written._replace(ways=REGISTERED.ways), missed[day]),
            (written._replace(ways=packed(longer, Map[Way, Connection])), far[day]),
        ):
            watch(began, written, register, ALARM_TONE, NOTHING, row, trace())
    assert total(rows, CLAIMS) == total(rows, ASSUMPTIONS) == 0
    assert total(rows, ["normal_s"]) > total(rows, ["seconds"]) / 4
    assert total(missed, CLAIMS) > 0
    assert total(far, CLAIMS) > 0


def test_the_truth_counts_the_way_over_the_junction() -> None:
    """Of a train on the branch and a worker on the line, or the other way round, reckoned here from the trace."""
    for on_branch in (False, True):
        began = drawn(SEED, 1, ("branches",), sound=True)
        joint_m = abs(float(began.size[KIND["branches"]]))
        began = beside(began, joint_m + 1_000.0)._replace(on_branch=on_branch)
        kept = lived(began, REGISTERED, REGISTERED)[0]
        others = [train for train in range(REGULAR) if (train // 2 % 2 == 1) != on_branch]
        nearest, least_m = kept.seconds[:, 3], kept.seconds[:, 2] / 1_000
        beyond_m = kept.places[np.arange(SECONDS), nearest] - joint_m
        with np.errstate(invalid="ignore"):
            over = np.isin(nearest, others) & (beyond_m > 100.0)
        assert over.any()
        assert (np.abs(1_000.0 + beyond_m[over] - least_m[over]) <= 60.0).all()


# ---- two workers


def test_what_one_handset_sounds_is_wrong_for_another_one_by_the_same_trains() -> None:
    broken = 0
    for day in range(2):
        began = drawn(SEED, day, ("two_workers",), sound=True)
        other = another(SEED, day, began)
        (one, _row), (two, row) = (lived(each, REGISTERED, REGISTERED) for each in (began, other))
        assert np.array_equal(one.places, two.places, equal_nan=True)
        assert total(row, CLAIMS) == total(row, ASSUMPTIONS) == 0
        assert not np.array_equal(one.seconds[:, 0], two.seconds[:, 0])
        broken += int(((one.seconds[:, 0] == NORMAL) & (two.seconds[:, 2] <= 3_000_000)).sum())
    assert broken > 0


def test_another_workers_handset_is_held_to_the_claims_too() -> None:
    """One that sounds the normal tone for the fault tone is counted for both (A2)."""
    alone, both = (
        np.array([one_day(SEED, day, beyond, sounds=spoiled) for day in range(2)]) for beyond in ((), ("two_workers",))
    )
    assert total(both, CLAIMS) > total(alone, CLAIMS)
    assert total(both, ["seconds"]) == total(alone, ["seconds"])
