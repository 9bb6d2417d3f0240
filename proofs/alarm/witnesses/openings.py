"""Where kilometrage does not run on: the line's end, a line that joins, a break (A1, A3)."""

from __future__ import annotations

from dataclasses import replace

from kernel.alarm import tone as machine
from kernel.alarm.distance import GREATEST_AGE_MS, UM_A_MM, TrainFix
from kernel.alarm.sections import NoUse, Reason
from kernel.alarm.tone import Display
from models.alarm.line import BOUNDS, FRESH
from models.alarm.worksite import NOWHERE_NEAR
from proofs.alarm.witnesses.worksite import (
    ALARM,
    BRANCH,
    DOWN,
    FAULT,
    FIRST,
    KM,
    NORMAL,
    NOWHERE,
    OTHER,
    REGISTER,
    TUNNEL,
    UP,
    Day,
    handset,
    on_the_line,
    tone,
)

JOINT_MM = 90 * KM
REACH_MM = 3_000_000 + 60_000 + 27 * 12_000 + 15_000
"""3000 m, a train's length, its way while a display is fresh, and the error of the worker's own fix."""
AT_THE_JOINT = replace(on_the_line(UM_A_MM * JOINT_MM, UP, 2_000, 58_000), came_by=BRANCH, came_ms=7)
ELSEWHERE = TrainFix(12 * KM, 0, DOWN, is_running=True)
"""What the branch's own figures say of a train before the joint."""


def near_an_opening_no_tone_is_mild() -> None:
    """Either side of it, to the mm, though no train is on the list (A3)."""
    for side in (-1, 1):
        assert tone(worker_mm=JOINT_MM + side * REACH_MM) == FAULT
        assert tone(worker_mm=JOINT_MM + side * (REACH_MM + 1)) == NORMAL
    fresh = replace(FRESH, fix_ms=12_001)
    longer = handset(worker_mm=JOINT_MM - REACH_MM - 1)
    assert machine.tone(replace(REGISTER, fresh=fresh), longer) == FAULT
    assert machine.tone(replace(REGISTER, openings={}), handset(worker_mm=JOINT_MM)) == NORMAL


def a_train_on_a_branch_is_no_normal_tone() -> None:
    """It is on no list, and 500 m from a worker of the main line: the fault tone is all that there is (A3)."""
    for worker_mm, beyond_mm, within_3000, within_1500 in (
        (JOINT_MM - 400_000, 100_000, True, True),
        (JOINT_MM + 400_000, 1_100_000, True, True),
        (JOINT_MM - 400_000, 1_100_001, True, False),
        (JOINT_MM - 400_000, 2_600_000, True, False),
        (JOINT_MM - 400_000, 2_600_001, False, False),
        (JOINT_MM - 3 * KM - BOUNDS.length_mm, -BOUNDS.length_mm, True, False),
        (JOINT_MM - 3 * KM - BOUNDS.length_mm, -BOUNDS.length_mm - 1, False, False),
    ):
        day = Day(worker_mm=worker_mm)
        day.hear()
        assert day.tone_with(BRANCH, beyond_mm) == FAULT
        assert (day.heard.within_3000.by_an_opening, day.heard.within_1500.by_an_opening) == (within_3000, within_1500)
        day.tone_with(NOWHERE, beyond_mm)
        assert day.heard.within_3000 == NOWHERE_NEAR


def a_train_that_comes_is_told_in_other_figures_until_it_is_told_anew() -> None:
    """It runs on for as long as they are fresh, and the normal tone sounds; then it is 3000 m away yet (A1, A3)."""
    day = Day(worker_mm=JOINT_MM - REACH_MM - 1)
    day.hear()
    day.let_on(FIRST)
    day.step("take_fix", train=FIRST, fix=ELSEWHERE, at_um=0, is_right=True)
    day.step("take_display", train=FIRST, display=Display(11 * KM, 13 * KM, 0), at_um=0)
    day.step("come_by", train=FIRST, body=AT_THE_JOINT)
    assert day.system.bodies == {FIRST: replace(AT_THE_JOINT, fix_is_right=False, passed_ms=0, came_ms=0)}
    assert day.tone() == NORMAL
    for elapsed_ms, expected in ((8_000, NORMAL), (2_000, NORMAL), (1, FAULT)):
        day.run(elapsed_ms, (FIRST, UP))
        day.hear()
        assert day.tone() == expected
        assert day.heard.within_3000 == NOWHERE_NEAR
    assert day.system.bodies[FIRST].came_ms == 10_001
    at_um = day.system.bodies[FIRST].antenna_um
    here = TrainFix(at_um // UM_A_MM, 0, UP, is_running=True)
    for age_ms, is_right in ((10_000, True), (10_001, False)):
        fix = replace(here, age_ms=age_ms)
        day.step("restart_handset")
        day.hear()
        day.step("take_fix", train=FIRST, fix=fix, at_um=at_um, is_right=True)
        assert day.system.told.trains[FIRST].fix == fix
        assert day.system.bodies[FIRST].fix_is_right == is_right
    day.run(GREATEST_AGE_MS)
    day.step("take_fix", train=FIRST, fix=replace(here, age_ms=GREATEST_AGE_MS), at_um=at_um, is_right=True)
    assert day.system.bodies[FIRST].came_ms == GREATEST_AGE_MS + 10_001
    assert day.system.bodies[FIRST].fix_is_right


def what_was_told_of_the_branch_may_say_anything() -> None:
    """Of a train that has just come: place, stretch and direction; of one that came before that, nothing wrong (A1)."""
    day = Day(worker_mm=50 * KM)
    day.hear()
    day.let_on(FIRST)
    day.step("come_by", train=FIRST, body=AT_THE_JOINT)
    day.step("take_fix", train=FIRST, fix=ELSEWHERE, at_um=0, is_right=True)
    shown = Display(11 * KM, 13 * KM, 0)
    day.step("take_display", train=FIRST, display=shown, at_um=0)
    assert day.system.told.trains[FIRST].display == shown
    day.run(1_000, (FIRST, UP))
    own, before = replace(shown, age_ms=999), replace(shown, age_ms=1_000)
    day.step("take_display", train=FIRST, display=own, at_um=day.system.bodies[FIRST].antenna_um)
    assert day.system.told.trains[FIRST].display == replace(shown, age_ms=1_000)
    day.step("take_display", train=FIRST, display=before, at_um=0)
    assert day.system.told.trains[FIRST].display == before
    day.run(11_000)
    assert day.system.bodies[FIRST].came_ms == 12_000
    day.step("take_display", train=FIRST, display=replace(shown, age_ms=12_000), at_um=0)
    day.run(1)
    assert day.system.bodies[FIRST].came_ms == 12_001
    kept = day.system
    for bad in (replace(shown, age_ms=12_000), shown):
        assert day.step("take_display", train=FIRST, display=bad, at_um=day.system.bodies[FIRST].antenna_um) == kept


def no_train_comes_but_by_an_opening() -> None:
    """At its place, after the list has named it; one that is made up on the line is new on the list (A1, A2)."""
    day = Day(worker_mm=50 * KM)
    day.hear()
    kept = day.system
    assert day.step("come_by", train=FIRST, body=AT_THE_JOINT) == kept
    day.let_on(FIRST)
    kept = day.system
    for bad in (
        replace(AT_THE_JOINT, antenna_um=AT_THE_JOINT.antenna_um + 1),
        replace(AT_THE_JOINT, came_by=NOWHERE),
        replace(AT_THE_JOINT, above_mm=60_001),
    ):
        assert day.step("come_by", train=FIRST, body=bad) == kept
    day.step("take_fix", train=FIRST, fix=ELSEWHERE, at_um=0, is_right=True)
    kept = day.system
    assert day.step("come", train=FIRST, body=AT_THE_JOINT) == kept
    day.step("come_by", train=FIRST, body=AT_THE_JOINT)
    assert set(day.system.bodies) == {FIRST}
    day.step("enter", train=OTHER)
    day.run(FRESH.server_ms)
    assert set(day.step("come_by", train=OTHER, body=AT_THE_JOINT).bodies) == {FIRST}
    day.run(1)
    day.step("come_by", train=OTHER, body=AT_THE_JOINT)
    assert set(day.system.bodies) == {FIRST, OTHER}


def an_old_fix_of_a_branch_hides_no_train() -> None:
    """Its unit dies there, at figures that a tunnel of this line has too; the display alone counts (A1, A4)."""
    tunnel = NoUse(Reason.WITHOUT_GPS, 9_600_000, 11 * KM, zone_mm=400_000)
    day = Day(16_200_000, replace(REGISTER, sections={TUNNEL: tunnel}, openings={BRANCH: 12 * KM}))
    day.hear()
    day.let_on(FIRST)
    day.step("take_fix", train=FIRST, fix=replace(ELSEWHERE, place_mm=10 * KM), at_um=0, is_right=True)
    day.run(14_000)
    at_um = UM_A_MM * 12 * KM
    day.step("come_by", train=FIRST, body=replace(AT_THE_JOINT, antenna_um=at_um, next_um=at_um, heading=DOWN))
    runs_on_unseen(day, Display(9_800_000, 20 * KM, 0))


def an_old_fix_from_before_a_break_hides_no_train() -> None:
    """Its unit dies in a tunnel, in which 12 km are followed by 14 km; the display alone counts (A1, A4)."""
    tunnel = NoUse(Reason.WITHOUT_GPS, 10_800_000, 14_600_000, zone_mm=400_000)
    day = Day(18 * KM, replace(REGISTER, sections={TUNNEL: tunnel}, openings={NOWHERE: 12 * KM, BRANCH: 14 * KM}))
    day.hear()
    day.come(FIRST, 11_200_000)
    day.step(
        "take_fix", train=FIRST, fix=replace(ELSEWHERE, place_mm=11_200_000), at_um=UM_A_MM * 11_200_000, is_right=True
    )
    day.run(29_630, (FIRST, DOWN))
    at_um = UM_A_MM * 14 * KM
    day.step("come_by", train=FIRST, body=replace(AT_THE_JOINT, antenna_um=at_um, next_um=at_um, heading=DOWN))
    runs_on_unseen(day, Display(9_800_000, 20 * KM, 0))


def runs_on_unseen(day: Day, shown: Display) -> None:
    """The display shows a train in each of 60 s, truly: the alarm, since it may be at the worker."""
    for second in range(60):
        day.run(1_000, (FIRST, DOWN))
        day.hear()
        day.step("take_display", train=FIRST, display=shown, at_um=day.system.bodies[FIRST].antenna_um)
        assert day.system.told.trains[FIRST].display == shown
        assert day.system.told.trains[FIRST].fix.age_ms > FRESH.fix_ms
        assert not day.system.bodies[FIRST].fix_is_right
        assert (second, day.tone()) == (second, ALARM)


WITNESSES = (
    near_an_opening_no_tone_is_mild,
    a_train_on_a_branch_is_no_normal_tone,
    a_train_that_comes_is_told_in_other_figures_until_it_is_told_anew,
    what_was_told_of_the_branch_may_say_anything,
    no_train_comes_but_by_an_opening,
    an_old_fix_of_a_branch_hides_no_train,
    an_old_fix_from_before_a_break_hides_no_train,
)
