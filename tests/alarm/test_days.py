"""Days of the alarm: the same in any batch, no claim broken, and a planted fault or a broken assumption is seen."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from kernel.alarm.tone import Tone
from models.alarm.columns import ASSUMPTIONS, CLAIMS, COLUMNS, NUMBER
from models.alarm.days import SYSTEM, of_the_day, one_day
from models.alarm.draws import HOURS, SECONDS, drawn
from models.alarm.faults import BEYOND, FAULTS, KIND, WITHIN
from models.alarm.line import REGISTER, REGULAR
from models.alarm.watch import ALARM_TONE, NOTHING, REGISTERED, trace, watch
from models.compiled import compiled, packed
from models.days.campaign import noticed

FAULT, CAUTION, NORMAL, ALARM = (packed(each) for each in (Tone.FAULT, Tone.CAUTION, Tone.NORMAL, Tone.ALARM))
SEED = 5


def total(rows: Any, names: Any) -> int:
    """The sum of some columns over some days."""
    return int(sum(rows[..., NUMBER[name]].sum() for name in names))


def test_columns_are_the_systems() -> None:
    assert SYSTEM.columns == COLUMNS
    assert len(set(COLUMNS)) == len(COLUMNS)
    assert SYSTEM.hours >= 16
    assert all(fault.least_s <= fault.most_s and fault.least <= fault.most and fault.source for fault in FAULTS)
    assert sum(fault.chance for fault in WITHIN) > 2
    assert all(fault.chance == 0 and fault.breaks for fault in BEYOND)


def test_days_in_two_batches_are_those_of_one_and_no_claim_is_broken() -> None:
    whole = SYSTEM.simulate(SEED, range(7, 13))
    assert np.array_equal(
        whole, np.concatenate([SYSTEM.simulate(SEED, range(7, 9)), SYSTEM.simulate(SEED, range(9, 13))])
    )
    assert not np.array_equal(whole[0], whole[1])
    assert not np.array_equal(whole[0], SYSTEM.simulate(SEED + 1, range(7, 8))[0])
    assert SYSTEM.simulate(SEED, range(0)).shape == (0, len(COLUMNS))
    assert total(whole, CLAIMS) == 0
    assert total(whole, ASSUMPTIONS) == 0
    assert (whole[:, NUMBER["seconds"]] == SECONDS).all()
    assert SECONDS == HOURS * 3_600
    tones = ("normal_s", "caution_s", "alarm_s", "fault_s")
    assert total(whole, tones) == total(whole, ["seconds"])
    assert all(total(whole, [name]) > 0 for name in (*tones, "passed", "messages", "mismatch_s", "unlinked_s"))
    assert total(whole, [f"fault_{fault.name}" for fault in FAULTS]) > len(whole)


def test_who_is_near_a_train_hears_the_alarm() -> None:
    """Reckoned here from the trace: within 1500 m and not departed is alarm or fault, each second of a day."""
    began, kept = drawn(SEED, 1, worker_m=18_000.0), trace(places=True)
    out = np.zeros(len(COLUMNS), np.int64)
    watch(began, REGISTERED, REGISTERED, ALARM_TONE, NOTHING, out, kept)
    places = kept.places[:, :REGULAR]
    with np.errstate(invalid="ignore"):
        ahead = (began.heading[:REGULAR] > 0) == (places < 18_000.0)
        near = (np.abs(places - 18_000.0) <= 1_500.0) & ahead & (np.diff(places, axis=0, append=0) != 0)
    assert near.any()
    heard = kept.seconds[near.any(axis=1), 0]
    assert set(np.unique(heard)) <= {ALARM, FAULT}
    assert (heard == ALARM).mean() > 0.9


# ---- what the campaign has to see


BOUNDS = REGISTER.bounds
PLANTED = {
    "a report's age is left out": replace(BOUNDS, train_mm_s=0),
    "the length is left out": replace(BOUNDS, length_mm=0, train_error_mm=0, worker_error_mm=0),
}


@pytest.mark.sampled(2)
@pytest.mark.parametrize("fault", PLANTED)
def test_a_deduction_left_out_breaks_a_claim(fault: str) -> None:
    register = packed(replace(REGISTER, bounds=PLANTED[fault]))
    rows = np.array([one_day(SEED, day, register=register) for day in range(12)])
    assert total(rows, CLAIMS) > 0
    assert total(rows, ASSUMPTIONS) == 0


@compiled
def spoiled(register: Any, handset: Any) -> int:
    """Sound the normal tone for the fault tone, and caution for alarm: each breaks claims of its own."""
    heard = ALARM_TONE(register, handset)
    if heard == FAULT:
        return int(NORMAL)
    return int(CAUTION if heard == ALARM else heard)


def test_dropped_guards_break_their_claims() -> None:
    rows = np.array([one_day(SEED, day, sounds=spoiled) for day in range(8)])
    for claim in ("mild_unknown_s", "mild_in_section_s", "normal_within_3000_s", "caution_within_1500_s"):
        assert total(rows, [claim]) > 0
    assert total(rows, ASSUMPTIONS) == 0


@pytest.mark.sampled(3)
@pytest.mark.parametrize("fault", [fault.name for fault in BEYOND])
def test_a_fault_beyond_what_is_assumed_is_counted_against_its_assumption(fault: str) -> None:
    rows = np.array([one_day(SEED, day, beyond=(fault,)) for day in range(6)])
    assert (rows[:, NUMBER[f"fault_{fault}"]] == 1).all()
    assert total(rows, ASSUMPTIONS) > 0


def test_a_frozen_gps_tells_a_place_that_grows_old_in_the_unit() -> None:
    kind, seconds = KIND["gps_frozen"], 0
    for day in range(3):
        plain, began = (drawn(SEED, day, beyond, sound=True) for beyond in ((), ("gps_frozen",)))
        assert all(np.array_equal(one, other) for one, other in zip(began[1:9], plain[1:9], strict=True)), "same day"
        train, first, lasts = began.train[kind], began.begin_s[kind], began.end_s[kind] - began.begin_s[kind]
        frozen = trace(places=True, first_s=first, told_s=lasts)
        watch(began, REGISTERED, REGISTERED, ALARM_TONE, NOTHING, np.zeros(len(COLUMNS), np.int64), frozen)
        told = frozen.told[20:, train]
        runs = np.abs(np.diff(frozen.places[first + 19 : first + lasts, train])) > 5
        stays = (told[1:, 1] == told[:-1, 1]) & (told[1:, 0] == 1) & runs[1:]
        assert (told[1:, 2] - told[:-1, 2] == 1_000)[stays].all(), "each second a second older"
        seconds += int((stays & (told[1:, 2] > REGISTER.fresh.fix_ms)).sum())
    assert seconds > 60, "a train ran on, and its place was too old to count"


def test_a_frozen_gps_breaks_no_claim_and_is_a_fault() -> None:
    """No assumption either: a place that is too old is no fix, and its train not known as it should be (A1)."""
    without, rows = (SYSTEM.simulate(SEED, range(6), *beyond) for beyond in ((), ("gps_frozen",)))
    assert total(rows, CLAIMS) == total(rows, ASSUMPTIONS) == 0
    assert total(rows, ["mismatch_s"]) > total(without, ["mismatch_s"])


def test_over_a_break_that_the_register_has_little_is_lost() -> None:
    """Trains and worker pass from the one figure to the other; no claim is broken, and no fix is a jump (A1)."""
    without, rows = (SYSTEM.simulate(SEED, range(6), *beyond) for beyond in ((), ("broken",)))
    assert total(rows, CLAIMS) == total(rows, ASSUMPTIONS) == 0
    assert total(rows, ["fault_broken"]) == len(rows)
    assert total(rows, ["jumped", "turned"]) == total(without, ["jumped", "turned"])
    assert total(rows, ["mismatch_s"]) - total(without, ["mismatch_s"]) < REGULAR * len(rows), "a second for each train"
    assert total(rows, ["normal_s"]) > 0.97 * total(without, ["normal_s"])


def test_a_break_that_no_register_has_breaks_claims() -> None:
    """Else the test above would show nothing."""
    rows = np.zeros((6, len(COLUMNS)), np.int64)
    for day, row in enumerate(rows):
        began = drawn(SEED, day, ("broken",))
        watch(began, of_the_day(REGISTERED, began), REGISTERED, ALARM_TONE, NOTHING, row, trace())
    assert total(rows, CLAIMS) > 0


def test_what_notices_a_gps_that_creeps_off_is_counted() -> None:
    without, rows = (SYSTEM.simulate(SEED, range(6), *beyond) for beyond in ((), ("gps_creeps",)))
    found = noticed(SYSTEM, without, rows)
    assert found.days > 3
    assert set(found.noticed) == set(SYSTEM.monitors)
    assert found.unexplained == 0
    assert noticed(SYSTEM, without, without).days == 0


def test_a_broken_assumption_breaks_a_claim() -> None:
    """The worker's own fix is what nothing contradicts; a drift of his breaks what he hears."""
    rows = np.array([one_day(SEED, day, beyond=("own_drift", "unlisted")) for day in range(12)])
    assert total(rows, ["own_fix_broken"]) > 0
    assert total(rows, CLAIMS) > 0
