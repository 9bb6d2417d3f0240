"""The server's list on ordinary days and under attack: restarts, cut and late lists, new numbers (A1, A2)."""

from __future__ import annotations

from dataclasses import replace

from kernel.alarm import train_list as machine
from kernel.alarm.distance import GREATEST_AGE_MS
from kernel.alarm.tone import NOTHING_KNOWN, Train, switched_on
from models.alarm.line import FRESH
from proofs.alarm.witnesses.worksite import ALARM, DOWN, FAULT, FIRST, KM, NORMAL, OTHER, UP, WORKER_MM, Day

NEW = Train("11D")
"""A number that a train takes on its way."""
NEVER_MS = GREATEST_AGE_MS + 1


def with_a_train(at_mm: int) -> Day:
    """A day with a train on the line, told of alike."""
    day = Day()
    day.hear()
    day.come(FIRST, at_mm)
    day.tell(FIRST, DOWN)
    return day


def a_server_that_restarts_knows_nothing_and_says_so() -> None:
    """Who hears the alarm goes on hearing it; else it is the fault tone until every train is entered again (A1, A3)."""
    for at_mm, before, after in ((WORKER_MM - KM, ALARM, ALARM), (WORKER_MM - 6 * KM, NORMAL, FAULT)):
        day = with_a_train(at_mm)
        assert day.tone() == before
        day.step("start_server", now_ms=5)
        day.step("send_summary")
        assert not day.system.lists.let_on[FIRST].is_entered
        assert (day.system.server.life_ms, day.system.server.count) == (5, 0)
        day.summary()
        assert day.tone() == after
        assert day.system.handset.trains[FIRST] != NOTHING_KNOWN
        kept = day.system
        assert day.step("confirm_the_list") == kept
        day.step("enter", train=FIRST)
        day.hear()
        assert day.system.handset.listing.life_ms == 5
        assert day.tone() == before


def who_left_while_the_server_was_down_is_forgotten() -> None:
    """When its list is whole again and read, and not before (A2)."""
    day = with_a_train(WORKER_MM - 6 * KM)
    day.step("leave", train=FIRST)
    assert FIRST not in day.system.lists.let_on
    day.step("start_server", now_ms=5)
    day.summary()
    assert set(day.system.handset.trains) == {FIRST}
    day.hear()
    assert FIRST not in day.system.handset.trains
    assert day.tone() == NORMAL


def no_two_lives_of_the_server_are_one() -> None:
    """It starts at a later time, each time (A1)."""
    day = Day()
    for now_ms in (0, -1):
        before = day.system
        assert day.step("start_server", now_ms=now_ms) == before
    assert day.step("start_server", now_ms=1).server == machine.started(1)


def a_confirmation_for_an_earlier_life_is_none() -> None:
    """It comes after one more restart, in which no train was entered (A1)."""
    day = with_a_train(WORKER_MM - 6 * KM)
    day.step("start_server", now_ms=5)
    day.step("enter", train=FIRST)
    before = day.system
    assert day.step("hear_confirmation", life_ms=5) == before
    day.step("confirm_the_list")
    day.step("start_server", now_ms=9)
    before = day.system
    assert day.step("hear_confirmation", life_ms=5) == before
    assert not day.system.server.is_whole
    day.step("enter", train=FIRST)
    day.step("confirm_the_list")
    assert day.step("hear_confirmation", life_ms=9).server.is_whole


def a_short_list_is_the_fault_tone() -> None:
    """One entry was lost on the way; no train is off the list by that, and the next one alone helps (A1, A2)."""
    day = Day()
    day.hear()
    for train in (FIRST, OTHER):
        day.step("enter", train=train)
    day.step("send_summary")
    day.summary()
    assert day.tone() == FAULT
    assert day.heard.unknown
    for number, taken in ((2, 0), (1, 1), (1, 1), (2, 2), (1, 2)):
        day.step("send_entry", number=number)
        day.step("hear_entry", life_ms=0, number=number)
        assert day.system.handset.listing.taken == taken
    assert day.system.handset.listing.named == {FIRST: 1, OTHER: 2}
    before = day.system
    assert day.step("send_entry", number=3) == before
    assert day.step("hear_entry", life_ms=0, number=3) == before
    assert day.step("hear_entry", life_ms=5, number=1) == before


def an_old_entry_takes_no_train_off() -> None:
    """A train has left and come again under its number; that it left comes late (A2)."""
    day = with_a_train(WORKER_MM - 6 * KM)
    day.go(FIRST)
    day.come(FIRST, WORKER_MM - KM)
    day.tell(FIRST, DOWN)
    assert day.system.server.count == 3
    assert day.system.server.entries[2].has_left
    day.step("hear_entry", life_ms=0, number=2)
    assert FIRST in day.system.handset.trains
    assert day.tone() == ALARM


def an_old_list_counts_no_longer_than_it_is_fresh() -> None:
    """From before a restart, heard late: a train that is entered since comes when it is too old (A1)."""
    day = Day()
    day.hear()
    day.step("start_server", now_ms=5)
    day.step("enter", train=FIRST)
    day.run(FRESH.server_ms)
    said = {"life_ms": 0, "count": 0, "is_whole": True, "servers_well": True}
    before = day.system
    assert day.step("hear_summary", age_ms=FRESH.server_ms - 1, **said) == before
    day.step("hear_summary", age_ms=FRESH.server_ms, **said)
    day.locate()
    assert day.tone() == NORMAL
    day.run(1)
    assert day.tone() == FAULT
    day.summary()
    before = day.system
    assert day.step("hear_summary", age_ms=FRESH.server_ms + 1, **said).handset == before.handset
    assert day.step("hear_summary", age_ms=9, **{**said, "life_ms": 4}) == before
    assert day.step("hear_summary", age_ms=9, **{**said, "count": 1}) == before
    assert day.step("hear_summary", age_ms=-1, **{**said, "is_whole": False}) == before


def a_server_that_runs_on_beside_its_spare_is_heard_no_more() -> None:
    """Its list was confirmed while empty, and it goes on saying so, as new; trains are entered elsewhere (A1)."""
    day = Day()
    day.hear()
    day.step("start_server", now_ms=5)
    day.come(FIRST, WORKER_MM - KM)
    day.tell(FIRST, DOWN)
    assert day.tone() == ALARM
    before = day.system
    for life_ms in (0, 4):
        assert day.step("hear_summary", life_ms=life_ms, count=0, is_whole=True, age_ms=0, servers_well=True) == before
    assert day.tone() == ALARM


def a_train_that_changes_its_number_is_never_gone() -> None:
    """The new one is entered first; the old one stays until it is accounted for, and is a fault meanwhile (A2)."""
    day = with_a_train(WORKER_MM - 6 * KM)
    day.step("enter", train=NEW)
    before = day.system
    assert day.step("renumber", old=FIRST, new=NEW) == before
    day.let_on(OTHER)
    assert day.step("renumber", old=FIRST, new=FIRST) == day.system
    assert day.step("renumber", old=OTHER, new=NEW) == day.system
    body = day.system.bodies[FIRST]
    day.step("renumber", old=FIRST, new=NEW)
    assert day.system.bodies == {NEW: body}
    assert FIRST not in day.system.lists.let_on
    day.tell(NEW, DOWN)
    assert day.tone() == FAULT
    for train in (FIRST, OTHER):
        day.go(train)
    day.tell(NEW, DOWN)
    assert day.tone() == NORMAL
    assert set(day.system.handset.trains) == {NEW}


def a_new_number_begins_with_nothing_told() -> None:
    """Another train stays what it is, and a fix that was wrong was one of the old number (A2)."""
    day = with_a_train(WORKER_MM - 6 * KM)
    day.come(OTHER, WORKER_MM - 20 * KM)
    day.let_on(NEW)
    day.tell(FIRST, off_mm=-7 * KM)
    day.run(600_000)
    day.tell(FIRST, off_mm=-7 * KM)
    assert not day.system.bodies[FIRST].fix_is_right
    day.step("renumber", old=FIRST, new=NEW)
    assert set(day.system.bodies) == {OTHER, NEW}
    assert day.system.bodies[NEW].fix_is_right


def trains_are_coupled_and_parted() -> None:
    """One becomes longer and the other leaves; one becomes shorter and the other is made up (A2)."""
    day = with_a_train(WORKER_MM - 6 * KM)
    day.come(OTHER, WORKER_MM - 6 * KM)
    day.step("couple_or_part", train=FIRST, below_mm=60_000, above_mm=3_000)
    assert (day.system.bodies[FIRST].below_mm, day.system.bodies[FIRST].above_mm) == (60_000, 3_000)
    assert set(day.system.bodies) == {FIRST, OTHER}
    for below_mm, above_mm in ((60_001, 0), (0, 60_001), (-1, 0)):
        before = day.system
        assert day.step("couple_or_part", train=FIRST, below_mm=below_mm, above_mm=above_mm) == before
    day.go(OTHER)
    assert day.step("couple_or_part", train=OTHER, below_mm=1, above_mm=1) == day.system
    day.step("couple_or_part", train=FIRST, below_mm=30_000, above_mm=3_000)
    day.come(NEW, WORKER_MM - 6 * KM - 40_000, UP)
    for train, way in ((FIRST, DOWN), (NEW, UP)):
        day.tell(train, way)
    assert day.tone() == NORMAL


def one_wrong_report_takes_no_train_off() -> None:
    """Reported to have left, but told of since: that makes the report void, however long it is silent later (A2)."""
    day = with_a_train(WORKER_MM - 6 * KM)
    for _ in range(4):
        day.step("report_left", train=FIRST)
        day.run(5_000)
        day.step("hear_of", train=FIRST)
        day.step("strike_off", train=FIRST)
        assert FIRST in day.system.server.trains
    day.step("enter", train=FIRST)
    assert day.system.server.count == 1
    day.run(6_000)
    day.step("strike_off", train=FIRST)
    assert day.system.server.trains[FIRST].left_ms == NEVER_MS
    day.step("leave", train=FIRST)
    day.step("report_left", train=FIRST)
    for elapsed_ms, is_listed in ((5_999, True), (1, False)):
        day.run(elapsed_ms)
        day.step("strike_off", train=FIRST)
        assert (FIRST in day.system.server.trains) == is_listed
    before = day.system
    assert day.step("report_left", train=FIRST) == before
    assert day.step("strike_off", train=FIRST) == before


def a_report_of_more_than_an_hour_ago_is_none() -> None:
    """So that it has to be made anew (A2)."""
    for first_ms, is_listed in ((GREATEST_AGE_MS, False), (GREATEST_AGE_MS + 1, True)):
        day = Day()
        day.name(FIRST)
        day.step("report_left", train=FIRST)
        day.run(GREATEST_AGE_MS)
        day.run(first_ms - GREATEST_AGE_MS)
        day.step("strike_off", train=FIRST)
        assert (FIRST in day.system.server.trains) == is_listed


def who_is_not_on_the_line_is_reported_gone() -> None:
    """Nature takes no train off that neither source told of while it was there (A2)."""
    day = with_a_train(WORKER_MM - 6 * KM)
    day.step("report_left", train=FIRST)
    day.run(6_000)
    before = day.system
    assert day.step("strike_off", train=FIRST) == before
    assert day.step("withdraw", train=FIRST) == before


def who_is_told_of_comes_onto_the_list() -> None:
    """Though nobody has entered it (A2)."""
    day = Day()
    day.step("hear_of", train=FIRST)
    assert day.system.server.trains == {FIRST: machine.Listed(1, NEVER_MS)}
    assert machine.summary(day.system.server) == machine.Summary(0, 1, is_whole=False, age_ms=0)
    day.hear()
    assert day.system.handset.trains == {FIRST: NOTHING_KNOWN}
    assert day.tone() == FAULT


def a_train_let_on_before_a_restart_is_not_left_out() -> None:
    """It was entered in the life before, and is on its way: nobody confirms before it is entered again (A1, A2)."""
    day = Day()
    day.hear()
    day.step("enter", train=FIRST)
    day.step("start_server", now_ms=5)
    before = day.system
    assert day.step("confirm_the_list") == before
    day.run(FRESH.server_ms + 1)
    day.step("enter", train=FIRST)
    assert day.system.lists.let_on[FIRST].age_ms == FRESH.server_ms + 1
    assert day.step("confirm_the_list").lists.confirmed == {0, 5}
    day.step("start_server", now_ms=6)
    day.step("withdraw", train=FIRST)
    assert 6 in day.step("confirm_the_list").lists.confirmed


def a_handset_that_restarts_reads_the_list_anew() -> None:
    """Until then it knows no train, and the tone is the fault tone (A8)."""
    day = with_a_train(WORKER_MM - 6 * KM)
    assert day.tone() == NORMAL
    day.step("restart_handset")
    assert day.system.handset.listing == switched_on().listing
    assert day.tone() == FAULT
    day.step("look_at_the_battery", battery_well=True)
    day.step("hear_entry", life_ms=0, number=1)
    assert day.system.handset.listing == switched_on().listing
    day.step("send_summary")
    day.summary()
    assert day.tone() == FAULT
    day.hear()
    assert day.system.handset.trains == {FIRST: NOTHING_KNOWN}
    day.tell(FIRST, DOWN)
    assert day.tone() == NORMAL


def a_report_that_is_made_again_counts_from_the_first() -> None:
    """Else an interlocking that repeats it would never be heard (A2)."""
    server = machine.note_left(machine.enter(machine.started(0), FIRST), FIRST)
    later = machine.older_server(server, 7)
    assert later == replace(server, trains={FIRST: machine.Listed(1, 7)})
    assert machine.note_left(later, FIRST) == later
    assert machine.note_left(later, OTHER) == later
    day = Day()
    day.name(FIRST)
    for elapsed_ms in (3_000, 3_000):
        day.step("report_left", train=FIRST)
        day.run(elapsed_ms)
    day.step("strike_off", train=FIRST)
    assert FIRST not in day.system.server.trains


WITNESSES = (
    a_server_that_restarts_knows_nothing_and_says_so,
    who_left_while_the_server_was_down_is_forgotten,
    no_two_lives_of_the_server_are_one,
    a_confirmation_for_an_earlier_life_is_none,
    a_short_list_is_the_fault_tone,
    an_old_entry_takes_no_train_off,
    an_old_list_counts_no_longer_than_it_is_fresh,
    a_server_that_runs_on_beside_its_spare_is_heard_no_more,
    a_train_that_changes_its_number_is_never_gone,
    a_new_number_begins_with_nothing_told,
    trains_are_coupled_and_parted,
    one_wrong_report_takes_no_train_off,
    a_report_of_more_than_an_hour_ago_is_none,
    who_is_not_on_the_line_is_reported_gone,
    who_is_told_of_comes_onto_the_list,
    a_train_let_on_before_a_restart_is_not_left_out,
    a_handset_that_restarts_reads_the_list_anew,
    a_report_that_is_made_again_counts_from_the_first,
)
