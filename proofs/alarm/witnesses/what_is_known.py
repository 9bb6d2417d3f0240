"""When a train, the worker and the list count as known: one thing less, and the tone is not to be mild (A2, A4 to A6).

The claims' own words, case by case: were one of them weaker, a claim that rests on it would say less.
"""

from __future__ import annotations

from dataclasses import replace

from kernel.alarm.distance import NO_WORKER_FIX, UM_A_MM, TrainFix, WorkerFix
from kernel.alarm.sections import Reason
from kernel.alarm.tone import NO_DISPLAY, Display
from models.alarm.line import FRESH
from models.alarm.worksite import (
    NOBODY_NEAR,
    NOTHING_TOLD,
    OfList,
    OfTrain,
    Railway,
    Told,
    has_place,
    is_known,
    is_known_by_one,
    is_list_fresh,
    is_where_shown,
    shunts,
)
from proofs.alarm.witnesses.worksite import (
    ALARM,
    CAUTION,
    DOWN,
    FAULT,
    FIRST,
    KM,
    NORMAL,
    ON_HIS_LINE,
    OTHER,
    REGISTER,
    SIDING,
    SITE,
    STABLED,
    UNKNOWN,
    UP,
    WORKER_MM,
    YARD,
    Day,
)

IN_THE_YARD = TrainFix(40 * KM, 0, UNKNOWN, is_running=False)
IN_THE_TUNNEL = TrainFix(20 * KM, FRESH.fix_ms + 1, DOWN, is_running=True)
SHOWN = Display(19 * KM, 24 * KM, 0)
WHOLE = OfList(life_ms=1, taken=0, count=0, is_whole=True, named={})
ALL_TOLD = Told(WorkerFix(WORKER_MM, 0), 0, servers_well=True, battery_well=True, listing=WHOLE, trains={})


def of(fix: TrainFix = NOTHING_TOLD.fix, display: Display = NO_DISPLAY) -> OfTrain:
    """What was told of a train."""
    return replace(NOTHING_TOLD, fix=fix, display=display)


def a_train_shunts_where_it_is_written_and_not_shown() -> None:
    """In a yard, by its fix; one that the display shows is no train that shunts (004, 4.2; A5)."""
    assert shunts(SITE, of(IN_THE_YARD))
    assert not shunts(SITE, of(IN_THE_YARD, Display(39 * KM, 42 * KM, 0)))
    assert not shunts(SITE, of(replace(IN_THE_YARD, place_mm=42 * KM)))
    sections = {name: replace(section, reason=Reason.STABLING) for name, section in REGISTER.sections.items()}
    assert not shunts(Railway(replace(REGISTER, sections=sections)), of(IN_THE_YARD))
    assert YARD in sections


def a_train_in_a_tunnel_is_known_by_the_display() -> None:
    """If it was last seen going in, by a fix of this hour, and the display shows it now (A4)."""
    assert is_known_by_one(SITE, FIRST, of(IN_THE_TUNNEL, SHOWN))
    assert not is_known_by_one(SITE, FIRST, of(IN_THE_TUNNEL))
    assert not is_known_by_one(SITE, FIRST, of(IN_THE_TUNNEL, replace(SHOWN, age_ms=FRESH.display_ms + 1)))
    assert not is_known_by_one(SITE, FIRST, of(replace(IN_THE_TUNNEL, age_ms=3_600_001), SHOWN))


def a_stabled_train_is_known_by_the_display() -> None:
    """If the roster has it in a siding, and what the display shows lies in that (A6)."""
    there = Display(60 * KM, 61 * KM, 0)
    assert is_known_by_one(SITE, STABLED, of(display=there))
    assert not is_known_by_one(SITE, OTHER, of(display=there))
    assert not is_known_by_one(SITE, STABLED, of(display=replace(there, from_mm=60 * KM - 1)))
    assert not is_known_by_one(SITE, STABLED, of(display=replace(there, to_mm=61 * KM + 1)))
    assert not is_known_by_one(SITE, STABLED, of(display=replace(there, age_ms=FRESH.display_ms + 1)))
    sections = {SIDING: replace(REGISTER.sections[SIDING], reason=Reason.SHUNTING)}
    assert not is_known_by_one(Railway(replace(REGISTER, sections=sections)), STABLED, of(display=there))


def a_fix_is_where_it_is_shown_in_either_part_of_a_stretch() -> None:
    """To the tolerance, at both ends of each; between them it is nowhere that is shown (A1, A2)."""
    shown = Display(19 * KM, 20 * KM, 0, 40 * KM, 41 * KM)
    off_mm = REGISTER.tolerance_mm
    for least_mm, most_mm in ((19 * KM, 20 * KM), (40 * KM, 41 * KM)):
        for place_mm in (least_mm - off_mm, least_mm, most_mm, most_mm + off_mm):
            assert is_where_shown(SITE, of(replace(IN_THE_TUNNEL, place_mm=place_mm), shown))
        for place_mm in (least_mm - off_mm - 1, most_mm + off_mm + 1):
            assert not is_where_shown(SITE, of(replace(IN_THE_TUNNEL, place_mm=place_mm), shown))
    assert not is_where_shown(SITE, of(replace(IN_THE_TUNNEL, place_mm=40 * KM), SHOWN))


def what_the_list_does_not_name_is_not_known() -> None:
    """Whatever else is told of it (A2)."""
    shunting = of(IN_THE_YARD)
    assert is_known(SITE, FIRST, replace(ALL_TOLD, trains={FIRST: shunting}))
    assert not is_known(SITE, FIRST, replace(ALL_TOLD, trains={}))


def a_worker_without_a_fresh_fix_has_no_place() -> None:
    """Nor one whose fix is of no line (A8)."""
    assert has_place(SITE, ALL_TOLD)
    assert not has_place(SITE, replace(ALL_TOLD, worker=WorkerFix(WORKER_MM, FRESH.worker_ms + 1)))
    assert not has_place(SITE, replace(ALL_TOLD, worker=WorkerFix(WORKER_MM, -1)))
    assert not has_place(SITE, replace(ALL_TOLD, worker=WorkerFix(10**9 + 1, 0)))


def a_list_is_fresh_if_the_servers_are_well_and_it_is_not_old() -> None:
    """Nor of a time that is still to come (A1, A8)."""
    assert is_list_fresh(SITE, replace(ALL_TOLD, list_age_ms=FRESH.server_ms))
    assert not is_list_fresh(SITE, replace(ALL_TOLD, list_age_ms=FRESH.server_ms + 1))
    assert not is_list_fresh(SITE, replace(ALL_TOLD, list_age_ms=-1))
    assert not is_list_fresh(SITE, replace(ALL_TOLD, servers_well=False))
    assert not is_list_fresh(SITE, replace(ALL_TOLD, listing=replace(WHOLE, is_whole=False)))
    assert not is_list_fresh(SITE, replace(ALL_TOLD, listing=replace(WHOLE, count=1)))
    assert is_list_fresh(SITE, replace(ALL_TOLD, listing=replace(WHOLE, taken=1)))


def an_old_list_is_heard_as_unknown() -> None:
    """Though the worker's place and all trains are known (A1, A8)."""
    day = Day()
    day.hear()
    assert day.tone() == NORMAL
    assert not day.heard.unknown
    day = Day()
    day.hear(age_ms=FRESH.server_ms + 1)
    assert day.tone() == FAULT
    assert day.heard.unknown


def a_fix_that_jumps_may_say_anything_by_any_error() -> None:
    """Also of a source that is right otherwise: nothing is promised of where it was (A1)."""
    day = Day()
    day.hear()
    day.come(FIRST, WORKER_MM)
    day.tell(FIRST, DOWN)
    fix = TrainFix(WORKER_MM + 90 * KM, 0, DOWN, is_running=True)
    day.step("take_fix", train=FIRST, fix=fix, at_um=0, is_right=True)
    assert day.system.told.trains[FIRST].newest == fix
    assert day.system.handset.trains[FIRST].jumped


def what_the_worker_hears_goes_into_history() -> None:
    """The truth beside the tone, at each distance (A3)."""
    day = Day()
    day.hear()
    day.come(FIRST, WORKER_MM - 1_400_000)
    day.tell(FIRST, DOWN)
    assert day.tone() == ALARM
    assert day.heard == replace(
        NOBODY_NEAR, tone=ALARM, within_3000=ON_HIS_LINE, within_1500=ON_HIS_LINE, matched_within_1500=ON_HIS_LINE
    )
    day = Day()
    day.hear()
    day.come(FIRST, WORKER_MM - 2_900_000)
    day.tell(FIRST)
    assert day.tone() == CAUTION
    assert day.heard == replace(NOBODY_NEAR, tone=CAUTION, within_3000=ON_HIS_LINE)
    day.step("take_worker_fix", fix=NO_WORKER_FIX, at_um=0)
    assert day.tone() == FAULT
    assert day.heard == replace(NOBODY_NEAR, tone=FAULT, within_3000=ON_HIS_LINE, unknown=True)
    day = Day(worker_mm=40 * KM)
    day.hear()
    assert day.tone() == FAULT
    assert day.heard == replace(NOBODY_NEAR, tone=FAULT, not_to_be_used=True)
    day.come(FIRST, 40 * KM)
    assert day.tone() == FAULT
    assert day.heard == replace(
        NOBODY_NEAR,
        tone=FAULT,
        within_3000=ON_HIS_LINE,
        within_1500=ON_HIS_LINE,
        unknown=True,
        astray=True,
        not_to_be_used=True,
    )
    day.step("take_worker_fix", fix=NO_WORKER_FIX, at_um=0)
    assert day.tone() == FAULT
    assert day.heard == replace(
        NOBODY_NEAR, tone=FAULT, within_3000=ON_HIS_LINE, within_1500=ON_HIS_LINE, unknown=True, astray=True
    )
    day = Day()
    day.hear()
    day.step("look_at_the_battery", battery_well=False)
    assert day.tone() == FAULT
    assert day.heard == replace(NOBODY_NEAR, tone=FAULT, unknown=True)


def a_tunnel_goes_into_history_by_its_outer_end() -> None:
    """From zone A on, and while the train is lost, whatever stretch the display shows then (A4)."""
    for way, entry_mm, worker_mm in ((DOWN, 20 * KM, 24 * KM), (UP, 23 * KM, 19 * KM)):
        for far in (False, True):
            day = Day(worker_mm=worker_mm + (6 * KM if far else 0))
            day.hear()
            day.come(FIRST, entry_mm, way)
            day.tell(FIRST, way)
            assert day.tone() == (NORMAL if far else ALARM)
            assert day.heard == replace(NOBODY_NEAR, tone=day.tone(), beyond_a_tunnel=not far)
        day = Day(worker_mm=worker_mm)
        day.hear()
        day.come(FIRST, entry_mm, way)
        day.tell(FIRST, way)
        for _ in range(4):
            day.run(10_000, (FIRST, way))
        at_um = day.system.bodies[FIRST].antenna_um
        at_mm = at_um // UM_A_MM
        day.step("take_display", train=FIRST, display=Display(at_mm, at_mm, 0), at_um=at_um)
        day.hear()
        assert day.tone() == ALARM
        assert day.heard.beyond_a_tunnel
        day.step("take_worker_fix", fix=NO_WORKER_FIX, at_um=0)
        assert day.tone() == FAULT
        assert not day.heard.beyond_a_tunnel


WITNESSES = (
    what_the_worker_hears_goes_into_history,
    a_tunnel_goes_into_history_by_its_outer_end,
    a_train_shunts_where_it_is_written_and_not_shown,
    a_train_in_a_tunnel_is_known_by_the_display,
    a_stabled_train_is_known_by_the_display,
    a_fix_is_where_it_is_shown_in_either_part_of_a_stretch,
    what_the_list_does_not_name_is_not_known,
    a_worker_without_a_fresh_fix_has_no_place,
    a_list_is_fresh_if_the_servers_are_well_and_it_is_not_old,
    an_old_list_is_heard_as_unknown,
    a_fix_that_jumps_may_say_anything_by_any_error,
)
