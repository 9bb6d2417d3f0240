"""The truth held against what a handset sounds, in every second of a day (A2 to A6, A8)."""

from __future__ import annotations

from typing import Any

import numpy as np

from kernel.alarm.distance import Direction
from kernel.alarm.tone import Tone
from models.alarm.columns import NUMBER
from models.alarm.compiled import MADE
from models.alarm.figures import falls, place_mm
from models.alarm.line import BOUNDS, REGISTER, TRAINS
from models.alarm.moving import gap_m, has_departed, stranger_m
from models.alarm.routes import NOWHERE_M, is_apart, is_on_the_branch
from models.compiled import compiled, packed

KERNEL = MADE.tone
has_fix, has_display, agree, is_matched = KERNEL.has_fix, KERNEL.has_display, KERNEL.agree, KERNEL.is_matched
is_shunting, is_registered, is_linked = KERNEL.is_shunting, KERNEL.is_registered, KERNEL.is_linked
has_worker, is_fix = KERNEL.has_worker, KERNEL.is_fix
ALARM, FAULT, CAUTION, NORMAL = (packed(each) for each in (Tone.ALARM, Tone.FAULT, Tone.CAUTION, Tone.NORMAL))
SECTIONS = tuple((each.from_mm, each.to_mm) for _name, each in REGISTER.sections.items())
ERROR_MM, OWN_ERROR_MM = BOUNDS.train_error_mm, BOUNDS.worker_error_mm
SPEED_MM_S, WALK_MM_S, LENGTH_MM = BOUNDS.train_mm_s, BOUNDS.worker_mm_s, BOUNDS.length_mm
TURNING_MS = BOUNDS.turning_ms
SERVER_MS = REGISTER.fresh.server_ms
DOWN, UP = packed(Direction.DOWN), packed(Direction.UP)
NORMAL_WITHIN_3000, NORMAL_WITHIN_100_PAST, CAUTION_WITHIN_1500 = (
    NUMBER["normal_within_3000_s"],
    NUMBER["normal_within_100_past_s"],
    NUMBER["caution_within_1500_s"],
)
MILD_UNKNOWN, MILD_IN_SECTION, WRONG_FIX_BELIEVED = (
    NUMBER["mild_unknown_s"],
    NUMBER["mild_in_section_s"],
    NUMBER["wrong_fix_believed_s"],
)
SPEED_BROKEN, OWN_FIX_BROKEN, WALK_BROKEN = (NUMBER["speed_broken"], NUMBER["own_fix_broken"], NUMBER["walk_broken"])
TURNING_BROKEN, UNNAMED, LENGTH_BROKEN = (NUMBER["turning_broken_s"], NUMBER["unnamed_s"], NUMBER["length_broken"])
MISMATCH, UNLINKED, ILL = (NUMBER["mismatch_s"], NUMBER["unlinked_s"], NUMBER["ill_s"])
SHORT, NOT_WHOLE = NUMBER["short_s"], NUMBER["not_whole_s"]
NO_OWN_FIX, BATTERY, NEEDLESS_ALARM = (NUMBER["no_own_fix_s"], NUMBER["battery_s"], NUMBER["needless_alarm_s"])
NEEDLESS_CAUTION, NEEDLESS_FAULT, NO_USE = (
    NUMBER["needless_caution_s"],
    NUMBER["needless_fault_s"],
    NUMBER["no_use_s"],
)
FAULT_TONES, SECONDS, NORMALS = (NUMBER["fault_tones"], NUMBER["seconds"], NUMBER["normal_s"])
CAUTIONS, ALARMS, FAULTS = (NUMBER["caution_s"], NUMBER["alarm_s"], NUMBER["fault_s"])
WITHIN_1500, WITHIN_3000, PASSED = (NUMBER["within_1500_s"], NUMBER["within_3000_s"], NUMBER["passed"])


@compiled(forceinline=True)
def in_section(day: Any, worker_m: float) -> bool:
    """Tell whether the worker is where the handset is not to be used (A4, A5, A6)."""
    for from_mm, to_mm in SECTIONS:
        if from_mm <= 1_000 * worker_m <= to_mm and not is_on_the_branch(day, worker_m):
            return True
    return False


@compiled(forceinline=True)
def nearest(day: Any, trains: Any, worker_m: float, second: int, departed_too: bool) -> Any:
    """Give the least distance of a train on the line to the worker, and which it is; -1 where there is none."""
    least, which = NOWHERE_M, -1
    for index in range(trains.switched_on[TRAINS]):
        train = trains.switched_on[index]
        if not trains.came_s[train] <= second < trains.left_s[train]:
            continue
        gap = gap_m(day, trains, train, worker_m)
        if gap < least and (departed_too or not has_departed(day, trains, train, gap, worker_m)):
            least, which = gap, train
    return least, which


@compiled(forceinline=True)
def hold_claims(heard: int, least_m: float, any_m: float, unknown: bool, no_use: bool, out: Any) -> None:
    """Hold the claims against the truth (A2 to A6, A8)."""
    mild = heard in (NORMAL, CAUTION)
    if heard == NORMAL and least_m <= 3_000:
        out[NORMAL_WITHIN_3000] += 1
    if heard == NORMAL and any_m < 100:
        out[NORMAL_WITHIN_100_PAST] += 1
    if heard == CAUTION and least_m <= 1_500:
        out[CAUTION_WITHIN_1500] += 1
    if mild and unknown:
        out[MILD_UNKNOWN] += 1
    if mild and no_use:
        out[MILD_IN_SECTION] += 1


@compiled(forceinline=True)
def hold_train(register: Any, day: Any, trains: Any, train: int, known: Any, out: Any) -> None:
    """Hold the assumptions on what is known of a train against where it is (A2, A3)."""
    fix = known.fix
    off_mm = abs(1_000 * trains.place_m[train] - place_mm(day, fix.place_mm))
    wrong = has_fix(register, known) and off_mm > ERROR_MM + SPEED_MM_S * fix.age_ms / 1_000
    if wrong:
        believed = agree(register, known) if has_display(register, known) else is_shunting(register, known)
        if believed:
            out[WRONG_FIX_BELIEVED] += 1
    if is_matched(register, known) and fix.is_running and fix.age_ms <= TURNING_MS:
        down = (trains.heading[train] > 0) != falls(day, fix.place_mm)
        if fix.direction == (UP if down else DOWN):
            out[TURNING_BROKEN] += 1


@compiled(forceinline=True)
def hold_trains(register: Any, day: Any, trains: Any, now: Any, handset: Any, second: int, out: Any) -> bool:
    """Go through all trains; tell whether one on the line is unknown to the handset by its number of now (A2)."""
    unknown, named = False, 0
    for number, known in handset.trains:
        train = number % TRAINS
        if number == now[train] and trains.came_s[train] <= second < trains.left_s[train]:
            named += 1
            hold_train(register, day, trains, train, known, out)
            if known.jumped or (not is_matched(register, known) and not is_registered(register, number, known)):
                unknown = True
    there = 0
    for index in range(trains.switched_on[TRAINS]):
        train = trains.switched_on[index]
        if trains.came_s[train] <= second < trains.left_s[train]:
            there += 1
            if trains.below_m[train] + trains.above_m[train] > LENGTH_MM / 1_000:
                out[LENGTH_BROKEN] += 1
            if trains.speed_m_s[train] * 1_000 > SPEED_MM_S:
                out[SPEED_BROKEN] += 1
    if named < there and is_linked(register, handset):
        out[UNNAMED] += 1
    out[MISMATCH] += unknown
    return unknown or named < there


@compiled(forceinline=True)
def hold_handset(register: Any, day: Any, handset: Any, worker_m: float, out: Any) -> bool:
    """Hold what the handset knows of itself against the truth; tell whether something is missing (A8)."""
    fix = handset.worker
    if is_fix(fix.place_mm, fix.age_ms):
        off_mm = abs(1_000 * worker_m - place_mm(day, fix.place_mm))
        if off_mm > OWN_ERROR_MM + WALK_MM_S * fix.age_ms / 1_000 + 1:
            out[OWN_FIX_BROKEN] += 1
    if day.walk_m_s * 1_000 > WALK_MM_S:
        out[WALK_BROKEN] += 1
    out[UNLINKED] += not 0 <= handset.server_age_ms <= SERVER_MS
    out[SHORT] += handset.listing.taken < handset.listing.count
    out[NOT_WHOLE] += not handset.listing.is_whole
    out[ILL] += not handset.servers_well
    out[NO_OWN_FIX] += not has_worker(register, handset)
    out[BATTERY] += not handset.battery_well
    return not handset.battery_well or not has_worker(register, handset)


@compiled(forceinline=True)
def price(heard: int, before: int, least_m: float, no_use: bool, out: Any) -> None:
    """Count what it costs to be on the safe side."""
    out[NEEDLESS_ALARM] += heard == ALARM and least_m > 1_500
    out[NEEDLESS_CAUTION] += heard == CAUTION and least_m > 3_000
    out[NEEDLESS_FAULT] += heard == FAULT and least_m > 3_000 and not no_use
    out[NO_USE] += no_use
    out[FAULT_TONES] += heard == FAULT and before != FAULT
    out[SECONDS] += 1
    out[NORMALS] += heard == NORMAL
    out[CAUTIONS] += heard == CAUTION
    out[ALARMS] += heard == ALARM
    out[FAULTS] += heard == FAULT
    out[WITHIN_1500] += least_m <= 1_500
    out[WITHIN_3000] += least_m <= 3_000


@compiled(forceinline=True)
def hold(
    register: Any, day: Any, trains: Any, now: Any, sides: Any, handset: Any, heard: int, before: int,
    worker_m: float, second: int, out: Any, seconds: Any,
) -> None:  # fmt: skip
    """Hold one second against the truth, and write it down; ``now``: the number of each train."""
    least_m, which = nearest(day, trains, worker_m, second, False)
    any_m, _which = nearest(day, trains, worker_m, second, True)
    strange_m = stranger_m(day, worker_m, second)
    least_m, any_m = min(least_m, strange_m), min(any_m, strange_m)
    no_use = in_section(day, worker_m)
    unknown = hold_trains(register, day, trains, now, handset, second, out)
    unknown = hold_handset(register, day, handset, worker_m, out) or unknown
    hold_claims(heard, least_m, any_m, unknown, no_use, out)
    price(heard, before, least_m, no_use, out)
    for index in range(trains.switched_on[TRAINS]):
        train = trains.switched_on[index]
        side = 1.0 if trains.place_m[train] > worker_m and not is_apart(day, train, worker_m) else -1.0
        there = trains.came_s[train] <= second < trains.left_s[train]
        out[PASSED] += there and sides[train] == -side
        sides[train] = side if there else 0.0
    seconds[second, 0], seconds[second, 1] = heard, np.int64(1_000 * worker_m)
    seconds[second, 2], seconds[second, 3] = np.int64(1_000 * min(least_m, NOWHERE_M)), which
