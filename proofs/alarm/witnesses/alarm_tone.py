"""A worker's day: trains that come, pass and go, tunnels, shunting, stabled trains, and sources that fail."""

from __future__ import annotations

from dataclasses import replace

from kernel.alarm import tone as machine
from kernel.alarm.distance import (
    GREATEST_AGE_MS,
    NO_TRAIN_FIX,
    UM_A_MM,
    TrainFix,
    WorkerFix,
    fix_of_the_unit,
    nearest_um,
)
from kernel.alarm.network import jumps
from kernel.alarm.tone import (
    NO_DISPLAY,
    NOTHING_KNOWN,
    Display,
    Tone,
)
from models.alarm.line import BOUNDS, FRESH
from models.alarm.worksite import Railway, gap_um, has_departed, may_be_within
from proofs.alarm.witnesses import joins, lists, one_decision, openings, what_is_known
from proofs.alarm.witnesses.worksite import (
    ALARM,
    CAUTION,
    DOWN,
    FAULT,
    FIRST,
    HUGE,
    KM,
    NORMAL,
    OFF_MM,
    OTHER,
    REGISTER,
    SITE,
    UNKNOWN,
    UP,
    WORKER_MM,
    Day,
    known,
    on_the_line,
)

# ---- days


def a_train_comes_passes_and_goes_with_another_behind_it() -> None:
    """The first departs, the second approaches: no tone is missed (004, 3.3; A3)."""
    day = Day()
    assert day.tone() == FAULT
    day.hear()
    assert day.tone() == NORMAL
    day.come(FIRST, 6 * KM)
    assert day.tone() == FAULT
    day.come(OTHER, 4 * KM)
    tones: list[tuple[Tone, Tone]] = []
    for _ in range(460):
        day.hear()
        day.tell(FIRST, DOWN)
        day.tell(OTHER, DOWN)
        day.run(1_000, (FIRST, DOWN), (OTHER, DOWN))
        alone = replace(day.system.handset, trains={FIRST: day.system.handset.trains[FIRST]})
        heard = (day.tone(), machine.tone(REGISTER, alone))
        if not tones or tones[-1] != heard:
            tones.append(heard)
    assert tones == [
        (NORMAL, NORMAL),
        (CAUTION, CAUTION),
        (ALARM, ALARM),
        (CAUTION, NORMAL),
        (ALARM, NORMAL),
        (NORMAL, NORMAL),
    ]
    day.go(FIRST)
    assert set(day.system.bodies) == {OTHER}
    assert set(day.system.handset.trains) == {OTHER}
    day.tell(OTHER, DOWN)
    assert day.tone() == NORMAL


def a_train_reaches_from_end_to_end() -> None:
    """The gap is to its nearer end; it has departed when all of it is past (A3)."""
    body = on_the_line(0, DOWN)
    assert gap_um(body, UM_A_MM * 500_000) == UM_A_MM * 498_000
    assert gap_um(body, -UM_A_MM * 500_000) == UM_A_MM * 442_000
    assert gap_um(body, 0) == -UM_A_MM * 2_000
    assert has_departed(body, -UM_A_MM * 158_000)
    assert not has_departed(body, -UM_A_MM * 157_999)
    assert not has_departed(replace(body, heading=UP), -UM_A_MM * 158_000)
    assert not has_departed(replace(body, heading=UNKNOWN), -UM_A_MM * 158_000)
    assert has_departed(replace(body, heading=UP), UM_A_MM * 102_000)
    assert not has_departed(replace(body, heading=UP), UM_A_MM * 101_999)


def a_wrong_fix_is_found() -> None:
    """GPS 7 km off: the display contradicts it, and the tone is the fault tone until it comes to the worker (A2)."""
    day = Day()
    day.hear()
    day.come(FIRST, WORKER_MM - 1_000_000)
    day.tell(FIRST, off_mm=-7 * KM)
    assert day.tone() == FAULT
    day.run(1_000)
    day.tell(FIRST)
    assert day.tone() == ALARM


def a_fix_that_jumps_is_a_fault_until_one_fits() -> None:
    """Where the display shows the train, and off by more than it runs: not taken, and no tone is mild (A1, A2)."""
    day = Day()
    day.hear()
    day.come(FIRST, WORKER_MM - 6 * KM)
    day.tell(FIRST, DOWN)
    assert day.tone() == NORMAL
    day.run(1_000)
    held = day.system.handset.trains[FIRST].fix
    for off_mm, tone in ((67_000, NORMAL), (67_001, FAULT), (-1 * KM, FAULT), (4 * KM, FAULT), (5 * KM, ALARM)):
        fix = replace(held, place_mm=held.place_mm + off_mm, age_ms=0)
        at_um = day.system.bodies[FIRST].antenna_um
        is_jump = jumps(BOUNDS, {}, held, fix)
        assert is_jump == (tone != NORMAL)
        if is_jump:
            told = day.step("take_fix", train=FIRST, fix=fix, at_um=at_um, is_right=False).handset.trains[FIRST]
            assert (told.fix, told.jumped, told.newest) == (held, True, fix)
            assert day.tone() == tone
            assert day.heard.astray
            assert day.heard.jumped_within_1500 == (tone == ALARM)
    day.run(1_000, (FIRST, DOWN))
    assert day.system.handset.trains[FIRST].newest.age_ms == 1_000
    day.tell(FIRST, DOWN)
    assert not day.system.handset.trains[FIRST].jumped
    assert day.tone() == NORMAL


def a_report_leaves_open_how_near_a_train_is() -> None:
    """By length, both errors, and both ages at the greatest speeds: to the millimetre, either way (A1)."""
    for train_ms, worker_ms, off_mm in ((0, 0, 0), (1_000, 0, BOUNDS.train_mm_s), (0, 1_000, BOUNDS.worker_mm_s)):
        worker = WorkerFix(place_mm=WORKER_MM, age_ms=worker_ms)
        for side in (-1, 1):
            for beyond_mm in (0, 1):
                place_mm = WORKER_MM + side * (1_500_000 + OFF_MM + off_mm + beyond_mm)
                fix = known(place_mm, age_ms=train_ms).fix
                assert may_be_within(SITE, fix, worker, 1_500_000) == (beyond_mm == 0)
    nowhere = known(WORKER_MM, age_ms=GREATEST_AGE_MS + 1).fix
    assert not may_be_within(SITE, nowhere, WorkerFix(place_mm=WORKER_MM, age_ms=0), 1_500_000)


def a_right_fix_after_a_wrong_one_still_alarms() -> None:
    """Which of the two is wrong the handset cannot know: the nearer counts, and both with time (A2, A3)."""
    day = Day()
    day.hear()
    day.come(FIRST, WORKER_MM - 1_000_000)
    day.tell(FIRST, off_mm=-7 * KM)
    assert day.tone() == FAULT
    day.run(1_000)
    assert day.tell(FIRST).jumped
    assert day.tone() == ALARM
    day.run(300_000)
    day.hear()
    assert not day.tell(FIRST).jumped
    assert day.tone() == ALARM


def a_fix_too_old_is_a_fault() -> None:
    """Though the display shows the train, and it is far; and where none counts nothing jumps (A1, A2)."""
    day = Day()
    day.hear()
    day.come(FIRST, WORKER_MM - 8 * KM)
    day.tell(FIRST, DOWN)
    for elapsed_ms, tone in ((10_000, NORMAL), (1, FAULT)):
        day.run(elapsed_ms)
        day.hear()
        assert day.tone() == tone
        assert day.heard.astray == (tone == FAULT)
    assert not jumps(BOUNDS, {}, known(0, age_ms=GREATEST_AGE_MS + 1).fix, known(5 * KM).fix)


def what_is_no_fix_hides_no_jump() -> None:
    """A unit that starts tells none, and then a place 2 km off: that is held against the last fix before (A1, A2)."""
    day = Day()
    day.hear()
    day.come(FIRST, WORKER_MM - 6 * KM)
    day.tell(FIRST, DOWN)
    day.run(1_000, (FIRST, DOWN))
    place_mm = day.system.bodies[FIRST].antenna_um // UM_A_MM - 2 * KM
    started = fix_of_the_unit(NO_TRAIN_FIX, TrainFix(place_mm, 0, DOWN, True))
    before = day.system
    assert day.step("take_fix", train=FIRST, fix=started, at_um=0, is_right=False) == before
    day.step("take_fix", train=FIRST, fix=replace(started, place_mm=place_mm + 1, age_ms=0), at_um=0, is_right=False)
    assert day.system.handset.trains[FIRST].jumped
    assert day.tone() == FAULT
    day.tell(FIRST, DOWN)
    assert day.tone() == NORMAL


def figures_of_another_edition_say_nothing() -> None:
    """Track was moved, and the server has the new register first: the fault tone, until the handset has it too (A1)."""
    day, far = Day(), known(WORKER_MM - 9 * KM, UP)
    day.hear()
    day.come(FIRST, WORKER_MM - 6 * KM)
    day.run(1_000, (FIRST, DOWN))
    day.tell(FIRST, DOWN)
    assert day.tone() == NORMAL
    before = day.system
    for edition in (REGISTER.edition - 1, REGISTER.edition, REGISTER.edition + 1):
        assert day.step("take_fix_of_another_edition", train=FIRST, fix=far.fix, edition=edition) == before
        shown = day.step("take_display_of_another_edition", train=FIRST, display=far.display, edition=edition)
        assert shown == before
    day.run(FRESH.fix_ms + 1, (FIRST, DOWN))
    day.hear()
    day.step("take_fix_of_another_edition", train=FIRST, fix=far.fix, edition=REGISTER.edition + 1)
    assert day.tone() == FAULT


def a_list_that_is_not_heard_is_the_fault_tone() -> None:
    """A train that is entered meanwhile may come when the list is too old; the next one has it (A1, A8)."""
    day = Day()
    day.hear()
    day.step("enter", train=FIRST)
    day.run(8_000)
    day.locate()
    assert day.tone() == NORMAL
    at_um = UM_A_MM * WORKER_MM
    body = on_the_line(at_um, DOWN)
    before = day.system
    assert day.step("come", train=FIRST, body=body) == before
    day.run(1)
    day.locate()
    assert day.tone() == FAULT
    day.step("come", train=FIRST, body=body)
    assert FIRST in day.system.bodies
    assert FIRST not in day.system.handset.trains
    day.hear()
    assert FIRST in day.system.handset.trains
    assert day.tone() == FAULT
    day.hear(well=False)
    day.step("look_at_the_battery", battery_well=False)
    assert not day.system.handset.battery_well


# ---- nature


def what_is_not_on_the_list_stays_unknown() -> None:
    """Reports of it change nothing (A2)."""
    day = Day()
    day.hear()
    before = day.system
    assert day.step("take_fix", train=FIRST, fix=known(0).fix, at_um=0, is_right=True) == before
    assert day.step("take_display", train=FIRST, display=known(0).display, at_um=0) == before
    assert day.intend(FIRST, 0, DOWN) == before
    day.name(FIRST)
    day.step("take_fix", train=FIRST, fix=known(5).fix, at_um=0, is_right=True)
    day.step("take_display", train=FIRST, display=known(5).display, at_um=0)
    assert day.system.handset.trains == {FIRST: replace(known(5), newest=known(5).fix)}
    day.go(FIRST)
    day.name(FIRST)
    assert day.system.handset.trains == {FIRST: NOTHING_KNOWN}


def what_is_no_report_may_say_anything() -> None:
    """Garbage of GPS changes nothing, of the display it shows none; directions count of trains that run (A1, A2)."""
    day = Day()
    day.hear()
    day.come(FIRST, WORKER_MM - 5 * KM)
    day.run(1_000, (FIRST, DOWN))
    day.tell(FIRST, DOWN)
    for age_ms in (-1, GREATEST_AGE_MS + 1):
        fix = TrainFix(7, age_ms, UP, True)
        agrees = replace(fix, place_mm=day.system.bodies[FIRST].antenna_um // UM_A_MM)
        before = day.system
        for told in (fix, agrees, replace(fix, place_mm=HUGE), replace(agrees, place_mm=10**9 + 1, age_ms=0)):
            for right in (True, False):
                assert day.step("take_fix", train=FIRST, fix=told, at_um=0, is_right=right) == before
        assert day.tone() == NORMAL
        assert nearest_um(BOUNDS, fix, WorkerFix(7, 0)) == 0
        shown = Display(7, 7, age_ms)
        day.step("take_display", train=FIRST, display=shown, at_um=0)
        assert day.system.handset.trains[FIRST].display == shown
        day.tell(FIRST, DOWN)
        own = WorkerFix(7, age_ms)
        day.step("take_worker_fix", fix=own, at_um=0)
        assert day.system.handset.worker == own
        day.hear()
    fix = day.system.handset.trains[FIRST].fix
    for told in (replace(fix, direction=UP, is_running=False), replace(fix, direction=UNKNOWN)):
        day.step("take_fix", train=FIRST, fix=told, at_um=day.system.bodies[FIRST].antenna_um, is_right=True)
        assert day.system.handset.trains[FIRST].fix == told
    day.step("take_display", train=FIRST, display=NO_DISPLAY, at_um=0)
    told = replace(fix, direction=UP)
    day.step("take_fix", train=FIRST, fix=told, at_um=day.system.bodies[FIRST].antenna_um, is_right=True)
    assert day.system.handset.trains[FIRST].fix == told


def what_nature_does_not_do_does_not_happen() -> None:
    """Too fast, too long, too wrong, turned too soon, off the list: such events are refused."""
    day = Day()
    day.hear()
    day.come(FIRST, WORKER_MM - 5 * KM)
    day.run(1_000, (FIRST, DOWN))
    day.tell(FIRST, DOWN)
    before = day.system
    body, here_mm = before.bodies[FIRST], before.bodies[FIRST].antenna_um // UM_A_MM
    told = before.handset.trains[FIRST]
    assert day.step("come", train=FIRST, body=replace(body, antenna_um=0)) == before
    fix, at_um = told.fix, body.antenna_um
    for bad, really_um in (
        (replace(fix, direction=UP), at_um),
        (replace(fix, place_mm=here_mm + 20_001), at_um),
        (replace(fix, place_mm=here_mm - 20_001), at_um),
        (fix, at_um + 1),
        (fix, at_um - 1),
    ):
        assert day.step("take_fix", train=FIRST, fix=bad, at_um=really_um, is_right=True) == before
    assert day.step("take_fix", train=FIRST, fix=fix, at_um=0, is_right=False) == before
    shown = told.display
    for display, really_um in (
        (replace(shown, from_mm=here_mm + 10_001), at_um),
        (replace(shown, to_mm=here_mm - 10_001), at_um),
        (shown, at_um + 1),
        (shown, at_um - 1),
    ):
        assert day.step("take_display", train=FIRST, display=display, at_um=really_um) == before
    day.step("take_display", train=FIRST, display=replace(shown, to_mm=here_mm - 10_000), at_um=at_um)
    day.step("take_display", train=FIRST, display=shown, at_um=at_um)
    assert day.system == before
    own = WorkerFix(WORKER_MM, 0)
    for worker, really_um in (
        (replace(own, place_mm=WORKER_MM + 15_001), before.worker_um),
        (replace(own, place_mm=WORKER_MM - 15_001), before.worker_um),
        (own, before.worker_um + 1),
    ):
        assert day.step("take_worker_fix", fix=worker, at_um=really_um) == before
    for to_um in (before.worker_um + 2_000_001, before.worker_um - 2_000_001):
        assert day.step("pass_time", elapsed_ms=1_000, worker_to_um=to_um) == before
    day.run(1_000, walks_mm_s=-2_000)
    for to_um, heading in ((at_um + 27_000_001, DOWN), (at_um - 27_000_001, DOWN), (at_um, UP), (at_um, UNKNOWN)):
        day.intend(FIRST, to_um, heading)
        before = day.system
        assert day.step("pass_time", elapsed_ms=1_000, worker_to_um=before.worker_um) == before
    day.intend(FIRST, at_um, DOWN)
    day.run(8_000)


def a_wrong_fix_puts_no_train_where_trains_shunt() -> None:
    """Far off and in the yard it is contradicted by the display, which stays there while the fix is fresh (A2, A5)."""
    day = Day(worker_mm=50 * KM)
    day.hear()
    day.come(FIRST, 34 * KM)
    day.tell(FIRST, off_mm=6 * KM)
    assert day.tone() == FAULT
    day.run(5_000)
    fix = day.system.handset.trains[FIRST].fix
    day.step("take_fix", train=FIRST, fix=replace(fix, age_ms=0), at_um=0, is_right=False)
    before = day.system
    assert day.step("pass_time", elapsed_ms=7_001, worker_to_um=before.worker_um) == before
    day.run(7_000)
    before = day.system
    assert day.step("take_display", train=FIRST, display=NO_DISPLAY, at_um=0) == before
    day.run(3_001)
    day.step("take_display", train=FIRST, display=NO_DISPLAY, at_um=0)
    assert day.system.told.trains[FIRST].display == NO_DISPLAY
    day = Day(worker_mm=50 * KM)
    day.hear()
    day.come(FIRST, 34 * KM)
    day.tell(FIRST, off_mm=4 * KM)
    day.step("take_display", train=FIRST, display=NO_DISPLAY, at_um=0)
    assert day.system.handset.trains[FIRST].display == NO_DISPLAY
    assert day.tone() == FAULT
    day.run(100_000)
    before = day.system
    assert day.step("take_fix", train=FIRST, fix=fix, at_um=before.worker_um, is_right=False) == before


def a_train_runs_as_it_heads() -> None:
    """Backwards it gets nowhere, either way; nor does it while another train does as it should (A3)."""
    day = Day()
    day.hear()
    day.come(OTHER, WORKER_MM, UP)
    day.come(FIRST, WORKER_MM)
    here_um = day.system.bodies[FIRST].antenna_um
    for to_um, heading in ((here_um - 1, DOWN), (here_um + 1, UP)):
        day.intend(FIRST, to_um, heading)
        before = day.system
        assert day.step("pass_time", elapsed_ms=1, worker_to_um=before.worker_um) == before
    day.run(1, (FIRST, UP))
    day.run(1, (FIRST, DOWN), (OTHER, UP))


def no_train_longer_than_written_comes() -> None:
    """Nor one whose antenna is outside of it (A1)."""
    day = Day()
    day.let_on(FIRST)
    before = day.system
    body = on_the_line(0, UNKNOWN, 60_000, 60_000)
    for below_mm, above_mm in ((60_001, 0), (0, 60_001), (-1, 0), (0, -1)):
        bad = replace(body, below_mm=below_mm, above_mm=above_mm)
        assert day.step("come", train=FIRST, body=bad) == before
    day.step("come", train=FIRST, body=body)
    assert day.system.bodies == {FIRST: body}


def a_train_turns_when_it_can() -> None:
    """After its report is too old for that, or while it shunts (A3, A5)."""
    day = Day(worker_mm=50 * KM)
    day.hear()
    day.come(FIRST, 40 * KM)
    day.run(1_000, (FIRST, DOWN))
    day.tell(FIRST, DOWN, display=False)
    assert day.tone() == NORMAL
    day.run(1_000, (FIRST, UP))
    day = Day()
    day.site = Railway(replace(REGISTER, fresh=replace(FRESH, fix_ms=60_000, display_ms=60_000)))
    day.hear()
    day.come(FIRST, WORKER_MM + 5 * KM)
    day.run(1_000, (FIRST, DOWN))
    day.tell(FIRST, DOWN)
    day.run(30_000, (FIRST, DOWN))
    day.run(1, (FIRST, UP))


WITNESSES = (
    a_train_comes_passes_and_goes_with_another_behind_it,
    a_train_reaches_from_end_to_end,
    a_wrong_fix_is_found,
    a_fix_that_jumps_is_a_fault_until_one_fits,
    a_report_leaves_open_how_near_a_train_is,
    a_right_fix_after_a_wrong_one_still_alarms,
    a_fix_too_old_is_a_fault,
    what_is_no_fix_hides_no_jump,
    figures_of_another_edition_say_nothing,
    a_list_that_is_not_heard_is_the_fault_tone,
    what_is_not_on_the_list_stays_unknown,
    what_is_no_report_may_say_anything,
    what_nature_does_not_do_does_not_happen,
    a_wrong_fix_puts_no_train_where_trains_shunt,
    a_train_runs_as_it_heads,
    no_train_longer_than_written_comes,
    a_train_turns_when_it_can,
    *one_decision.WITNESSES,
    *what_is_known.WITNESSES,
    *openings.WITNESSES,
    *joins.WITNESSES,
    *lists.WITNESSES,
)
