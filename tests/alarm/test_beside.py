"""Lines that lie side by side, where GPS takes one for the other: the register joins them all along (A1, A3)."""

from __future__ import annotations

from dataclasses import replace

from kernel.alarm import tone as machine
from kernel.alarm.distance import Direction, TrainFix, WorkerFix
from kernel.alarm.extents import End, Extent, Line
from kernel.alarm.least_ways import Equation, Join
from kernel.alarm.limits import is_lawful
from kernel.alarm.tone import Display, Handset, Known, Register, Tone, Train
from models.alarm.connections import connections
from tests.alarm.networks import KM
from tests.alarm.test_openings import ERROR_MM, LENGTH_MM, LIMITS_MM, READ, REGISTER, WORKER_ERROR_MM

BESIDE_MM, EVERY_MM = 500_000, 20_000
"""So far from their junction two lines lie so near each other that GPS takes one for the other; joined so often."""


def beside(every_mm: int) -> Register:
    """A line that leaves another at 5 km, with figures from 200 km on; joined there, and all along beside it."""
    places = {
        Join(f"{at_mm}"): Equation(5 * KM + at_mm, 200 * KM + at_mm) for at_mm in range(0, BESIDE_MM + 1, every_mm)
    }
    bounds = replace(
        REGISTER.bounds, train_error_mm=ERROR_MM + EVERY_MM // 2, worker_error_mm=WORKER_ERROR_MM + EVERY_MM // 2
    )
    written = replace(REGISTER, bounds=bounds)
    register = replace(written, ways=connections(written, places))
    lines = {
        Line("through"): Extent(-10 * KM, 20 * KM, End.BUFFER_STOP, End.BUFFER_STOP),
        Line("beside"): Extent(200 * KM, 220 * KM, End.JOIN, End.BUFFER_STOP),
    }
    assert is_lawful(register, places, lines)
    return register


def tones_beside(register: Register) -> list[tuple[Tone, int]]:
    """Either may be told on the other line than it is on; give tones, and how far they are apart along the track."""
    found = []
    for train_mm in range(0, BESIDE_MM + 1, 7_000):
        for worker_mm in range(-4 * KM, 5 * KM, 93_000):
            train = TrainFix(200 * KM + train_mm, 0, Direction.UNKNOWN, is_running=False)
            shown = Display(4 * KM, 6 * KM, 0, 200 * KM, 202 * KM)
            both = Known(train, shown, jumped=False, newest=train)
            other_mm = 195 * KM if 0 <= worker_mm <= BESIDE_MM else 0
            for told_mm in {5 * KM + worker_mm, 5 * KM + other_mm + worker_mm}:
                handset = Handset(WorkerFix(told_mm, 0), 0, True, True, READ, {Train("1D"): both})
                found.append((machine.tone(register, handset), abs(train_mm - worker_mm)))
    return found


def test_where_lines_lie_side_by_side_either_counts_as_the_other() -> None:
    """The register joins them all along: no mild tone nearer than its limit, whichever a fix is put on (A1, A3)."""
    found = tones_beside(beside(EVERY_MM))
    assert all(apart_mm - LENGTH_MM > LIMITS_MM.get(tone, -KM) for tone, apart_mm in found)
    assert {tone for tone, _ in found} == {Tone.ALARM, Tone.CAUTION, Tone.NORMAL}


def test_joined_at_their_junction_alone_they_do_not() -> None:
    """Else the test above would show nothing."""
    found = tones_beside(beside(BESIDE_MM + 1))
    assert any(apart_mm - LENGTH_MM <= LIMITS_MM.get(tone, -KM) for tone, apart_mm in found)
