"""Which of the trains that truly split must be seen, and that one which is not would be told (P5)."""

from __future__ import annotations

import numpy as np
import pytest

from kernel.onboard.split import SplitLimits
from models.reproduce import splits
from models.reproduce.splits import AT_S, TAIL_M, Parted, Watch, due_cycles, parted
from models.rides.onboard import SPLIT_ERROR_MM_S2, UNSEEN_CYCLES
from models.rides.trace import traces_of
from models.sensors.faults import CYCLE_S, NEVER, SPLIT_LIMITS
from models.sensors.traces import Setup, Traces, traces
from models.sensors.track import line

SEED, RUNS, CYCLES = 402, 30, 2_600
AT = int(AT_S / CYCLE_S)


def made(split_at_s: float, **present: float) -> Traces:
    """Some trains that split then."""
    return traces(Setup(line(SEED), CYCLES, TAIL_M, present={"split_at_s": split_at_s, **present}), SEED, range(RUNS))


def found(limits: SplitLimits) -> Parted:
    return parted(limits, SEED, RUNS, CYCLES)


def test_all_that_must_be_seen_are_seen_in_time() -> None:
    seen = found(SPLIT_LIMITS)
    assert seen.running >= seen.due > 3
    assert seen.late == 0
    assert len(seen.times_s) >= seen.due


def test_a_machine_that_is_blind_or_slow_is_late(monkeypatch: pytest.MonkeyPatch) -> None:
    """Each train that must be seen counts, whether no flag comes, or one after the bound, or one before the split."""
    for flagged in (-1, AT - 1, CYCLES - 1):
        monkeypatch.setattr(splits, "watch", lambda *_, flagged=flagged: Watch(flagged, CYCLES))
        seen = found(SPLIT_LIMITS)
        assert seen.late == seen.due > 3, flagged


def test_only_a_great_and_lasting_difference_must_be_seen() -> None:
    """Of a whole train none; of a tail that brakes hard, not before the bound."""
    track = line(SEED)
    assert set(due_cycles(SPLIT_LIMITS, made(NEVER), track, AT)) == {-1}
    hard = np.array(due_cycles(SPLIT_LIMITS, made(AT_S, split_slows_m_s2=1.3), track, AT))
    assert np.sum(hard >= AT) > 3
    assert np.min(hard[hard >= 0]) >= AT + UNSEEN_CYCLES


def test_it_is_the_first_cycle_after_a_difference_that_lasted() -> None:
    """As rides count it, one cycle after the other."""
    track, trains = line(SEED), made(AT_S)
    rides = traces_of(trains, track)
    expected = []
    for ride in rides:
        streak, by = 0, -1
        for cycle in range(AT, CYCLES):
            slope = ride.slope_m_s2[cycle] - ride.tail_slope_m_s2[cycle]
            differs_mm_s2 = abs(ride.gain_m_s2[cycle] - ride.tail_gain_m_s2[cycle] + slope) * 1000
            streak = streak + 1 if differs_mm_s2 > SPLIT_LIMITS.threshold_mm_s2 + SPLIT_ERROR_MM_S2 else 0
            if streak > UNSEEN_CYCLES and by < 0:
                by = cycle
        expected.append(by)
    # Rides measure gravity under the rear, 20 m behind the sensor: a change of gradient comes a little later there.
    found_by = due_cycles(SPLIT_LIMITS, trains, track, AT)
    same = [abs(by - other) <= 2 for by, other in zip(found_by, expected, strict=True) if max(by, other) >= 0]
    assert len(same) > 5
    assert sum(same) >= 0.8 * len(same)
