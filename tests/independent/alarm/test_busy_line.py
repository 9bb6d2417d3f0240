"""With trains that turn, shunt, couple and part no tone is mild with one near; each rule and duty is needed (A1 to A8).

Nothing is judged but metres, and whether each train was told of: see tests/independent/alarm/busy_line.py.
"""

from __future__ import annotations

from collections import Counter
from dataclasses import replace
from functools import cache
from typing import Any

import pytest

from kernel.alarm import distance, tone
from kernel.alarm.distance import (
    AlarmBounds,
    Direction,
    TrainFix,
    WorkerFix,
    is_fix,
    nearest_um,
)
from kernel.alarm.tone import Known, Register, Tone
from tests.independent.alarm.busy_line import (
    BEFORE_SHUNTING,
    CUTTING,
    ONE_TELLS,
    RIGHT,
    Busy,
    Kind,
)
from tests.independent.alarm.office import ENTERS, REPORTS

FEW, SOME, MANY = range(20), range(60), range(1_000, 2_000)


@cache
def lived(seed: int) -> Busy:
    """Give a world after its time, in which everybody does his duty."""
    return Busy(seed).pass_time()


def broken_rules(seed: int, neglected: str = "", kind: Kind | None = None) -> set[str]:
    """Give which rules tones broke in a world."""
    return {rule for _tone, rules in Busy(seed, neglected, kind).pass_time().heard for rule in rules}


def test_no_tone_is_mild_with_a_train_near() -> None:
    assert [seed for seed in FEW if lived(seed).breaches()] == []


def test_the_worlds_have_what_is_to_be_tried() -> None:
    """Else the test above would show nothing."""
    counts = sum((lived(seed).counts for seed in FEW), Counter[str]())
    assert {name for name, least in LEAST.items() if counts[name] < least} == set()
    tones = Counter(sounds for seed in FEW for sounds, _rules in lived(seed).heard)
    assert min(tones[each] for each in Tone) > 500


LEAST = {
    "turned": 100,
    "coupled": 10,
    "parted": 20,
    "shunted": 40,
    "renumbered": 5,
    "stood between stations": 2_000,
    "seconds that a receiver hung under way": 500,
    "seconds that a receiver was off": 300,
    "units started": 100,
    "handsets started": 40,
    "servers started": 8,
}
"""How much of what the worlds of ``make test`` have at the least."""


def nothing(*_of: object) -> bool:
    return False


def always(*_of: object) -> bool:
    return True


def as_told(held: TrainFix, told: TrainFix) -> TrainFix:
    return told


def also_the_first(held: TrainFix, told: TrainFix) -> TrainFix:
    return replace(told, age_ms=held.age_ms) if told.place_mm == held.place_mm else told


def departs(bounds: AlarmBounds, train: TrainFix, worker: WorkerFix, of: frozenset[str]) -> bool:
    """Tell whether a train departs, by some of the kernel's conditions."""
    away = Direction.DOWN if train.place_mm > worker.place_mm else Direction.UP
    return (
        ("turning" not in of or train.age_ms <= bounds.turning_ms)
        and ("runs" not in of or train.is_running)
        and ("past" not in of or nearest_um(bounds, train, worker) >= 100_000_000)
        and ("way" not in of or train.direction == away)
    )


ALL = frozenset({"turning", "runs", "past", "way"})


def without(condition: str) -> Any:
    def without_it(bounds: AlarmBounds, train: TrainFix, worker: WorkerFix) -> bool:
        return departs(bounds, train, worker, ALL - {condition})

    return without_it


MATCHED = tone.is_matched


def or_shunting(register: Register, known: Known) -> bool:
    return MATCHED(register, known) or tone.is_registered(register, tone.Train(""), known)


def however_old(register: Register, known: Known) -> bool:
    return is_fix(known.fix.place_mm, known.fix.age_ms)


def however_old_the_place(register: Register, handset: tone.Handset) -> bool:
    return is_fix(handset.worker.place_mm, handset.worker.age_ms)


def without_age(bounds: AlarmBounds, fix: TrainFix) -> int:
    return 1_000 * bounds.train_error_mm


def of_no_length(bounds: AlarmBounds, train: TrainFix, worker: WorkerFix) -> int:
    return nearest_um(replace(bounds, length_mm=0), train, worker)


CALM, SILENT = Kind(30_000, 0.0003, 0.0005, 0.5), Kind(6_000, 0.0003, 0.0005, 0.3)
TURNS_SOON = Kind(2_000, 0.0003, 0.0005, 0.3)
HANGS, GOES_OFF = Kind(30_000, 0.003, 0.0005, 0.5), Kind(30_000, 0.0003, 0.005, 0.5)
PLANTED: dict[str, tuple[Kind, Any, str, Any]] = {
    "a place told again is new": (HANGS, distance, "fix_of_the_unit", as_told),
    "the first place after a start is a fix": (HANGS, distance, "fix_of_the_unit", also_the_first),
    "a direction holds as long as a fix is fresh": (TURNS_SOON, distance, "is_departing", without("turning")),
    "a train that stands departs": (CALM, distance, "is_departing", without("runs")),
    "past is past by the antenna": (CALM, distance, "is_departing", without("past")),
    "whoever runs departs": (CALM, distance, "is_departing", without("way")),
    "no fix jumps": (GOES_OFF, tone, "jumps", nothing),
    "sources always agree": (GOES_OFF, tone, "agree", always),
    "a train that shunts runs as it was told": (SILENT, tone, "is_matched", or_shunting),
    "a lost train is where it was": (CALM, tone, "shown_may_be_near", nothing),
    "a tunnel has no outer end": (CALM, tone, "may_be_on_its_way_through", nothing),
    "trains have no length": (CALM, distance, "nearest_um", of_no_length),
    "a fix is never too old": (SILENT, tone, "has_fix", however_old),
    "the worker's place is never too old": (CALM, tone, "has_worker", however_old_the_place),
    "a list is always whole": (CALM, tone, "has_whole_list", always),
    "a fix is of now": (SILENT, distance, "train_off_um", without_age),
    "no section is not to be used": (CALM, tone, "is_not_to_be_used", nothing),
}


@pytest.mark.sampled(4)
@pytest.mark.parametrize("fault", PLANTED)
def test_a_planted_fault_is_heard(fault: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """Each rule that is left out lets a mild tone through in some world, or takes an alarm away."""
    kind, module, name, instead = PLANTED[fault]
    monkeypatch.setattr(module, name, instead)
    assert any(broken_rules(seed, kind=kind) for seed in SOME)


HEARD = (ENTERS, REPORTS, BEFORE_SHUNTING, RIGHT, CUTTING)
"""That a list is confirmed too early is heard in the worlds of lists; of ends that are not changed no world tells."""


@pytest.mark.sampled(4)
@pytest.mark.parametrize("duty", HEARD)
def test_a_duty_that_is_neglected_is_heard(duty: str) -> None:
    """So the worlds are such that it matters."""
    assert any(broken_rules(seed, duty) for seed in SOME)


def test_a_coupled_unit_that_tells_on_is_heard_by_nobody() -> None:
    """Its antenna is on the same train, and no train is longer than is taken off."""
    assert [seed for seed in FEW if broken_rules(seed, ONE_TELLS)] == []


@pytest.mark.slow
def test_no_tone_is_mild_in_many_worlds() -> None:
    assert [seed for seed in MANY if broken_rules(seed)] == []
