"""One decision of the handset: every limit, every link, and each kind of train known to one source (A2 to A6, A8)."""

from __future__ import annotations

from dataclasses import replace
from itertools import product

from kernel.alarm import tone as machine
from kernel.alarm.distance import (
    GREATEST_AGE_MS,
    GREATEST_PLACE_MM,
    NO_TRAIN_FIX,
    UM_A_MM,
    AlarmBounds,
    TrainFix,
    WorkerFix,
)
from kernel.alarm.network import Connection
from kernel.alarm.sections import NoUse, Reason
from kernel.alarm.tone import NO_DISPLAY, NOTHING_KNOWN, Display, Freshness, Handset, Known, Register
from models.alarm import worksite as world
from models.alarm.line import FRESH
from proofs.alarm.witnesses.worksite import (
    ACROSS,
    ALARM,
    BRANCH,
    CAUTION,
    DOWN,
    FAULT,
    FIRST,
    HUGE,
    KM,
    NORMAL,
    OFF_MM,
    OTHER,
    READ,
    REGISTER,
    STABLED,
    TUNNEL,
    UNKNOWN,
    UP,
    WORKER_MM,
    YARD,
    handset,
    known,
    stabled,
    tone,
)
from proofs.onboard.witnesses.sixty_four_bits import Checked, with_ints


def limits_and_links_to_the_millisecond() -> None:
    """Each link has its freshness, and each loss is the fault tone (A1, A8)."""
    far = known(WORKER_MM - 6 * KM)
    well = handset(far)
    assert machine.tone(REGISTER, well) == NORMAL
    losses = (
        (replace(well, battery_well=False), FAULT),
        (replace(well, servers_well=False), FAULT),
        (replace(well, server_age_ms=8_000), NORMAL),
        (replace(well, server_age_ms=8_001), FAULT),
        (replace(well, server_age_ms=-1), FAULT),
        (replace(well, listing=replace(READ, is_whole=False)), FAULT),
        (replace(well, listing=replace(READ, count=1)), FAULT),
        (replace(well, listing=replace(READ, taken=1)), NORMAL),
        (replace(well, worker=WorkerFix(WORKER_MM, 5_000)), NORMAL),
        (replace(well, worker=WorkerFix(WORKER_MM, 5_001)), FAULT),
        (replace(well, worker=WorkerFix(WORKER_MM, -1)), FAULT),
        (replace(well, worker=WorkerFix(-HUGE, 0)), FAULT),
        (replace(well, trains={FIRST: replace(far, fix=replace(far.fix, age_ms=10_000))}), NORMAL),
        (replace(well, trains={FIRST: replace(far, fix=replace(far.fix, age_ms=10_001))}), FAULT),
        (replace(well, trains={FIRST: replace(far, fix=replace(far.fix, age_ms=-1))}), FAULT),
        (replace(well, trains={FIRST: replace(far, display=replace(far.display, age_ms=12_000))}), NORMAL),
        (replace(well, trains={FIRST: replace(far, display=replace(far.display, age_ms=12_001))}), FAULT),
        (replace(well, trains={FIRST: replace(far, display=replace(far.display, age_ms=-1))}), FAULT),
        (replace(well, trains={FIRST: replace(far, display=replace(far.display, from_mm=-HUGE))}), FAULT),
        (replace(well, trains={FIRST: replace(far, display=replace(far.display, to_mm=HUGE))}), FAULT),
        (replace(well, trains={FIRST: NOTHING_KNOWN}), FAULT),
        (replace(well, trains={FIRST: far, OTHER: NOTHING_KNOWN}), FAULT),
    )
    for lost, expected in losses:
        assert machine.tone(REGISTER, lost) == expected
    older = machine.older(handset(known(0)), 700)
    assert older == Handset(WorkerFix(WORKER_MM, 700), 700, True, True, READ, {FIRST: known(0, age_ms=700)})


def the_limits_are_included() -> None:
    """1500 m and 3000 m to the mm, and 100 m past (004, 3.3; A3)."""
    for limit_mm, inside, outside in ((1_500_000, ALARM, CAUTION), (3_000_000, CAUTION, NORMAL)):
        for side in (-1, 1):
            assert tone(known(WORKER_MM + side * (limit_mm + OFF_MM))) == inside
            assert tone(known(WORKER_MM + side * (limit_mm + OFF_MM + 1))) == outside
    assert tone(known(WORKER_MM + OFF_MM + 100_000, DOWN)) == NORMAL
    assert tone(known(WORKER_MM + OFF_MM + 99_999, DOWN)) == ALARM
    assert tone(known(WORKER_MM + KM, DOWN), known(WORKER_MM - KM, DOWN)) == ALARM
    assert tone(known(WORKER_MM + KM, DOWN), known(WORKER_MM - 2 * KM, DOWN)) == CAUTION


def a_direction_counts_until_a_train_may_have_turned() -> None:
    """A fix may be fresh for longer than a train takes to turn; then it tells a place, and no direction (A3)."""
    register = replace(REGISTER, bounds=replace(REGISTER.bounds, turning_ms=5_000))
    for age_ms, expected in ((5_000, NORMAL), (5_001, ALARM)):
        past = known(WORKER_MM + KM, DOWN, age_ms=age_ms)
        assert machine.has_fix(register, past)
        assert machine.tone(register, handset(past)) == expected


def the_order_is_alarm_fault_caution_normal() -> None:
    """An alarm through any fault, a fault through caution (A3, A8)."""
    for lost in ({"battery_well": False}, {"servers_well": False}, {"worker": WorkerFix(WORKER_MM, 60_000)}):
        assert machine.tone(REGISTER, replace(handset(known(WORKER_MM - KM)), **lost)) == ALARM
        assert machine.tone(REGISTER, replace(handset(known(WORKER_MM - 2 * KM - KM // 2)), **lost)) == FAULT
    assert tone(known(WORKER_MM - KM), NOTHING_KNOWN) == ALARM
    assert tone(NOTHING_KNOWN, known(WORKER_MM - KM)) == ALARM
    assert tone(known(WORKER_MM - 2 * KM), NOTHING_KNOWN) == FAULT


# ---- both sources, and one


def sources_must_agree() -> None:
    """The fix in the stretch that the display shows, to the tolerance (A2)."""
    at_mm = WORKER_MM - 8 * KM
    for off_mm, expected in ((50_000, NORMAL), (50_001, FAULT)):
        assert (
            tone(Known(known(at_mm).fix, Display(at_mm + off_mm, at_mm + KM, 0), jumped=False, newest=NO_TRAIN_FIX))
            == expected
        )
        assert (
            tone(Known(known(at_mm).fix, Display(at_mm - KM, at_mm - off_mm, 0), jumped=False, newest=NO_TRAIN_FIX))
            == expected
        )
    near = known(WORKER_MM - KM, DOWN).fix
    assert tone(Known(near, Display(0, KM, 0), jumped=False, newest=NO_TRAIN_FIX)) == ALARM
    past = known(WORKER_MM + KM, DOWN).fix
    assert tone(Known(past, Display(0, KM, 0), jumped=False, newest=NO_TRAIN_FIX)) == ALARM
    assert tone(Known(past, NO_DISPLAY, jumped=False, newest=NO_TRAIN_FIX)) == ALARM
    assert (
        tone(Known(replace(past, place_mm=WORKER_MM + 4 * KM), NO_DISPLAY, jumped=False, newest=NO_TRAIN_FIX)) == FAULT
    )
    assert tone(Known(NO_TRAIN_FIX, Display(WORKER_MM, WORKER_MM, 0), jumped=False, newest=NO_TRAIN_FIX)) == ALARM
    assert tone(Known(NO_TRAIN_FIX, Display(50 * KM, 51 * KM, 0), jumped=False, newest=NO_TRAIN_FIX)) == FAULT


def a_shunting_train_counts_both_ways() -> None:
    """GPS alone, in the yard: no fault, and the alarm on both sides, whichever way it runs (004, 4.2; A5)."""
    for place_mm in (40 * KM, 40 * KM + KM // 2, 41 * KM):
        for heading in (UP, DOWN, UNKNOWN):
            shunts = known(place_mm, heading, shown=False)
            assert tone(shunts) == NORMAL
            for side in (-1, 1):
                assert tone(shunts, worker_mm=place_mm + side * (1_500_000 + OFF_MM)) == ALARM
                assert tone(shunts, worker_mm=place_mm + side * (1_500_000 + OFF_MM + 1)) == CAUTION
                assert tone(shunts, worker_mm=place_mm + side * (3_000_000 + OFF_MM + 1)) == NORMAL
    for place_mm in (40 * KM - 1, 41 * KM + 1, 20 * KM + KM, 60 * KM + KM // 2):
        assert tone(known(place_mm, shown=False)) == FAULT
    assert tone(known(40 * KM, age_ms=10_001, shown=False)) == FAULT
    assert tone(Known(known(40 * KM).fix, Display(0, KM, 0), jumped=False, newest=NO_TRAIN_FIX)) == FAULT


def a_stabled_train_counts_by_the_display() -> None:
    """On the roster, in its section: no fault, and the alarm on both sides of the stretch (004, 4.3; A6)."""
    stretch = Display(60 * KM, 61 * KM, 0)
    assert stabled(stretch) == NORMAL
    off_mm = 60_000 + 15_000 + 10_000
    for limit_mm, inside, outside in ((1_500_000, ALARM, CAUTION), (3_000_000, CAUTION, NORMAL)):
        assert stabled(stretch, worker_mm=60 * KM - limit_mm - off_mm) == inside
        assert stabled(stretch, worker_mm=60 * KM - limit_mm - off_mm - 1) == outside
        assert stabled(stretch, worker_mm=61 * KM + limit_mm + off_mm) == inside
        assert stabled(stretch, worker_mm=61 * KM + limit_mm + off_mm + 1) == outside
        aged = replace(stretch, age_ms=10_000)
        assert stabled(aged, worker_mm=60 * KM - limit_mm - off_mm - 270_000) == inside
        assert stabled(aged, worker_mm=60 * KM - limit_mm - off_mm - 270_001) == outside
    part, last = Display(60 * KM + 400_000, 60 * KM + 600_000, 0), TrainFix(60 * KM + 500_000, 60_000, UNKNOWN, False)
    assert stabled(part, last, worker_mm=60 * KM + 600_000 + 3_000_000 + off_mm + 1) == NORMAL
    assert stabled(stretch, worker_mm=24 * KM) == NORMAL
    assert stabled(stretch, name=FIRST) == FAULT
    assert stabled(replace(stretch, from_mm=60 * KM - 1)) == FAULT
    assert stabled(replace(stretch, to_mm=61 * KM + 1)) == FAULT
    assert stabled(replace(stretch, age_ms=12_001)) == FAULT
    assert stabled(Display(40 * KM, 41 * KM, 0)) == FAULT
    roster = frozenset({(STABLED, YARD), (STABLED, TUNNEL)})
    for name in (YARD, TUNNEL):
        section = REGISTER.sections[name]
        shown = Known(NO_TRAIN_FIX, Display(section.from_mm, section.to_mm, 0), jumped=False, newest=NO_TRAIN_FIX)
        lone = replace(handset(worker_mm=50 * KM), trains={STABLED: shown})
        assert machine.tone(replace(REGISTER, stabled=roster), lone) == FAULT


def a_lost_train_counts_from_its_last_fix_to_the_outer_end() -> None:
    """At the end nearest the worker, at once, and by the display, however far its last fix is (004, 4.1; A4)."""
    stretch, ends_mm = Display(19 * KM, 24 * KM, 0), 60_000 + 15_000
    for way, at_mm, outer_mm, side in ((DOWN, 21 * KM, 23 * KM, 1), (UP, 22 * KM, 20 * KM, -1)):
        lost = TrainFix(at_mm, 10_001, way, True)
        for limit_mm, inside, outside in ((1_500_000, ALARM, CAUTION), (3_000_000, CAUTION, NORMAL)):
            beyond_mm, here = outer_mm + side * (limit_mm + ends_mm), Display(at_mm, at_mm, 0)
            assert stabled(here, lost, worker_mm=beyond_mm) == inside
            assert stabled(here, lost, worker_mm=beyond_mm + side) == outside
            behind_mm = at_mm - side * (limit_mm + ends_mm + 20_000)
            agreed = Display(at_mm, at_mm, 10_000)
            assert stabled(agreed, lost, worker_mm=behind_mm) == (inside if limit_mm > 1_500_000 else ALARM)
        far = Display(40 * KM, 41 * KM, 0)
        for told in (lost, replace(lost, is_running=False), replace(lost, direction=UNKNOWN)):
            assert stabled(far, told, worker_mm=outer_mm + side * (1_500_000 + ends_mm)) == ALARM
            turned = told if told == lost else None
            entry_mm = (20 * KM if side == 1 else 23 * KM) - side * (3_000_000 + ends_mm)
            assert stabled(far, told, worker_mm=entry_mm) == (NORMAL if turned else CAUTION)
            assert stabled(far, told, worker_mm=entry_mm - side) == NORMAL
        near_mm = at_mm - side * (3_000_000 + ends_mm + 20_000)
        assert stabled(far, lost, worker_mm=near_mm) == CAUTION
        assert stabled(far, lost, worker_mm=near_mm - side) == NORMAL
    lost = TrainFix(20 * KM, 10_001, DOWN, True)
    assert stabled(stretch, lost, worker_mm=19 * KM - 3_000_000 - ends_mm - 10_000) == CAUTION
    assert stabled(stretch, lost, worker_mm=19 * KM - 3_000_000 - ends_mm - 10_001) == NORMAL
    old = replace(lost, age_ms=GREATEST_AGE_MS)
    assert stabled(stretch, old, worker_mm=24 * KM + 3_000_000 + ends_mm + 10_000) == CAUTION
    assert stabled(stretch, old, worker_mm=24 * KM + 3_000_000 + ends_mm + 10_001) == NORMAL
    assert stabled(Display(30 * KM, 31 * KM, 0), lost) == NORMAL
    assert stabled(Display(30 * KM, 31 * KM, 0), lost, worker_mm=32 * KM) == ALARM


def a_lost_train_is_registered_until_it_is_seen_in_zone_b() -> None:
    """Within the section, not by the way out; else the fault tone (004, 4.1; A4)."""
    stretch = Display(19 * KM, 24 * KM, 0)
    lost = TrainFix(20 * KM, 10_001, DOWN, True)
    for way, place_mm, expected in (
        (DOWN, 20 * KM - 1, FAULT),
        (DOWN, 20 * KM, NORMAL),
        (DOWN, 23 * KM - 400_000, NORMAL),
        (DOWN, 23 * KM - 399_999, FAULT),
        (UP, 23 * KM, NORMAL),
        (UP, 20 * KM + 400_000, NORMAL),
        (UP, 20 * KM + 399_999, FAULT),
        (UP, 23 * KM + 1, FAULT),
        (UNKNOWN, 23 * KM, NORMAL),
        (UNKNOWN, 20 * KM, NORMAL),
        (UNKNOWN, 40 * KM, FAULT),
    ):
        told = replace(lost, place_mm=place_mm, direction=way)
        assert stabled(stretch, told, worker_mm=50 * KM) == expected
    for way, place_mm in ((DOWN, 23 * KM), (UP, 20 * KM)):
        stood = replace(lost, place_mm=place_mm, direction=way, is_running=False)
        assert stabled(stretch, stood, worker_mm=50 * KM) == NORMAL
    assert stabled(stretch, replace(lost, age_ms=GREATEST_AGE_MS + 1)) == FAULT
    assert stabled(stretch, replace(lost, age_ms=0)) == NORMAL
    assert stabled(NO_DISPLAY, lost, worker_mm=50 * KM) == FAULT


def from_zone_a_on_a_train_counts_at_the_outer_end() -> None:
    """Though GPS still sees it; seen in zone B it counts where it is; who it left behind hears no alarm (A4)."""
    ends_mm = 60_000 + 15_000
    for way, entry_mm, outer_mm, side in ((DOWN, 20 * KM, 23 * KM, 1), (UP, 23 * KM, 20 * KM, -1)):
        beyond_mm = outer_mm + side * (3_000_000 + ends_mm)
        assert tone(known(entry_mm - side, way), worker_mm=beyond_mm) == NORMAL
        assert tone(known(entry_mm, way), worker_mm=beyond_mm) == CAUTION
        assert tone(known(entry_mm, way), worker_mm=beyond_mm + side) == NORMAL
        assert tone(known(entry_mm, way), worker_mm=beyond_mm - side * 1_500_000) == ALARM
        assert tone(known(entry_mm, way), worker_mm=entry_mm - side * (OFF_MM + 100_000)) == NORMAL
        last_mm = outer_mm - side * 400_000
        for limit_mm, inside, outside in ((1_500_000, ALARM, CAUTION), (3_000_000, CAUTION, NORMAL)):
            worker_mm = outer_mm + side * (limit_mm + ends_mm)
            assert tone(known(last_mm, way), worker_mm=worker_mm) == inside
            assert tone(known(last_mm + side, way), worker_mm=worker_mm) == outside
    yard = Known(known(40 * KM, DOWN).fix, Display(40 * KM, 41 * KM, 0), jumped=False, newest=NO_TRAIN_FIX)
    assert tone(yard, worker_mm=44 * KM) == NORMAL


def no_use_means_no_normal_tone() -> None:
    """In such a section, or where GPS cannot tell, the handset is not to be used (A4, A5, A6)."""
    for section in [section for _name, section in REGISTER.sections.items()]:
        for worker_mm in (section.from_mm - 15_000, section.from_mm, section.to_mm, section.to_mm + 15_000):
            assert tone(worker_mm=worker_mm) == FAULT
        for worker_mm in (section.from_mm - 15_001, section.to_mm + 15_001):
            assert tone(worker_mm=worker_mm) == NORMAL
            aged = replace(handset(), worker=WorkerFix(worker_mm, 1))
            assert machine.tone(REGISTER, aged) == FAULT
    edge = handset(known(GREATEST_PLACE_MM - 2 * KM), worker_mm=-GREATEST_PLACE_MM)
    assert machine.tone(REGISTER, edge) == NORMAL


def what_is_written_or_shown_backwards_is_a_fault() -> None:
    """A section, wherever the worker is; a stretch in running order shows no train (A2, A4 to A6)."""
    for name in (TUNNEL, YARD):
        section = REGISTER.sections[name]
        backwards = replace(section, from_mm=section.to_mm, to_mm=section.from_mm)
        middle_um = UM_A_MM * (section.from_mm + section.to_mm) // 2
        assert world.is_between_the_ends(section, middle_um)
        assert world.is_between_the_ends(backwards, middle_um)
        for worker_mm in (WORKER_MM, (section.from_mm + section.to_mm) // 2):
            assert machine.tone(replace(REGISTER, sections={YARD: backwards}), handset(worker_mm=worker_mm)) == FAULT
    point = NoUse(Reason.STABLING, 60 * KM, 60 * KM, zone_mm=0)
    assert machine.tone(replace(REGISTER, sections={YARD: point}), handset()) == NORMAL
    up = known(30 * KM, UP)
    assert tone(up) == NORMAL
    assert tone(replace(up, display=Display(32 * KM, 28 * KM, 0))) == FAULT
    assert tone(replace(up, display=Display(30 * KM, 30 * KM, 0))) == NORMAL
    lost = TrainFix(22 * KM, 10_001, UP, True)
    assert stabled(Display(24 * KM, 19 * KM, 0), lost, worker_mm=28 * KM) == FAULT
    assert stabled(Display(19 * KM, 24 * KM, 0), lost, worker_mm=28 * KM) == NORMAL


def sources_agree_while_both_are_fresh() -> None:
    """A fix that has grown too old agrees with nothing, wherever the display shows its train (A2)."""
    fix, site = TrainFix(30 * KM, FRESH.fix_ms, UP, True), world.Railway(REGISTER)
    of = world.OfTrain(fix, Display(28 * KM, 32 * KM, 0), jumped=False, newest=fix)
    assert world.is_told_alike(site, of)
    assert not world.is_told_alike(site, replace(of, fix=replace(fix, age_ms=FRESH.fix_ms + 1)))


def every_number_fits_into_64_bits() -> None:
    """Whatever is told; what is written is within 1000 km, 200 m/s and an hour (A1)."""
    bounds = AlarmBounds(200_000, 200_000, 10**9, 10**9, 10**9, GREATEST_AGE_MS)
    fresh = Freshness(GREATEST_AGE_MS, GREATEST_AGE_MS, GREATEST_AGE_MS, GREATEST_AGE_MS)
    edge = Checked(GREATEST_PLACE_MM)
    register = Register(
        with_ints(Checked, bounds),
        with_ints(Checked, fresh),
        display_error_mm=edge,
        tolerance_mm=edge,
        sections={name: NoUse(reason, -edge, edge, edge) for name, reason in zip((TUNNEL, YARD), Reason, strict=False)},
        stabled=frozenset(),
        ways={ACROSS: Connection(edge, -edge, edge)},
        openings={BRANCH: -edge},
        edition=edge,
    )
    numbers = [Checked(number) for number in (-HUGE, -GREATEST_PLACE_MM, 0, GREATEST_AGE_MS, GREATEST_PLACE_MM, HUGE)]
    for place_mm, age_ms, shown_mm, own_mm in product(numbers, numbers, numbers, numbers):
        told = Known(
            TrainFix(place_mm, age_ms, DOWN, True),
            Display(shown_mm, place_mm, own_mm),
            jumped=False,
            newest=NO_TRAIN_FIX,
        )
        given = Handset(WorkerFix(own_mm, age_ms), shown_mm, True, True, READ, {FIRST: told})
        for elapsed_ms in numbers:
            older = machine.older(given, elapsed_ms)
            assert machine.tone(register, older) in (ALARM, FAULT)
            assert older.trains[FIRST] == machine.older_known(told, elapsed_ms)


WITNESSES = (
    limits_and_links_to_the_millisecond,
    the_limits_are_included,
    a_direction_counts_until_a_train_may_have_turned,
    the_order_is_alarm_fault_caution_normal,
    sources_must_agree,
    a_shunting_train_counts_both_ways,
    a_stabled_train_counts_by_the_display,
    a_lost_train_counts_from_its_last_fix_to_the_outer_end,
    a_lost_train_is_registered_until_it_is_seen_in_zone_b,
    from_zone_a_on_a_train_counts_at_the_outer_end,
    no_use_means_no_normal_tone,
    what_is_written_or_shown_backwards_is_a_fault,
    sources_agree_while_both_are_fresh,
    every_number_fits_into_64_bits,
)
