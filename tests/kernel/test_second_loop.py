"""The second loop: a wrong, missing, late or early tag takes every authority away (T5)."""

from __future__ import annotations

from dataclasses import replace

import pytest

from kernel.authority import may_leave, may_proceed
from kernel.change_of_ends import change_ends
from kernel.first_loop import take_offer, take_permit, take_standing
from kernel.names import Cab, Route, Run, Serial, Tag, UnitLife
from kernel.second_loop import note_head_read, note_window_passed
from kernel.unit import Unit
from tests.world.small_site import T1, P, W, small_site, small_start, tag

SITE = small_site()
STANDING, RUN = Run(Serial(1), T1, UnitLife(1), Route("standing")), Run(Serial(2), T1, UnitLife(1), Route("W-P"))
LIST = SITE.layout.tag_list[RUN.route]
OUT, IN = tag("wp", W), tag("wp", P)
HEAD, OTHER = Cab("head"), Cab("other")


def offered() -> Unit:
    """A unit in W, its driver at the head, told under which run it stands, with the list of tags to P."""
    unit = change_ends(SITE.lists, small_start(small_site()).units[T1], HEAD)
    return take_offer(SITE.lists, take_standing(unit, STANDING), RUN, LIST)


def permitted() -> Unit:
    """A unit in W, with a permit to P."""
    unit = take_permit(offered(), RUN)
    assert may_proceed(unit, RUN)
    return replace(unit, occupied=frozenset({W}))


def reads(unit: Unit, *tags: Tag, cab: Cab = HEAD) -> Unit:
    for each in tags:
        unit = note_head_read(SITE.plan, SITE.lists, unit, cab, each, True)
    return unit


def test_the_expected_tags_in_order_keep_the_loop_closed_and_begin_the_run() -> None:
    """And the block entered is occupied, the one left as well until the tail has been there (T2, T5)."""
    unit = reads(permitted(), OUT)
    assert may_proceed(unit, RUN)
    assert not unit.orders[RUN].begun
    unit = reads(unit, IN)
    assert may_proceed(unit, RUN)
    assert unit.orders[RUN].begun
    assert unit.orders[RUN].expected is None
    assert unit.occupied == {W, P}


@pytest.mark.parametrize("wrong", [(IN,), (OUT, tag("wq", W)), (Tag("foreign"),), (OUT, IN, tag("pe", P))])
def test_a_wrong_or_missing_tag_opens_the_loop_and_frees_nothing(wrong: tuple[Tag, ...]) -> None:
    """Left out, of another route, of another line, or beyond the last (T5, T8)."""
    before = permitted()
    unit = reads(before, *wrong)
    assert not may_proceed(unit, RUN)
    assert not may_leave(SITE.lists, unit, RUN, W)
    assert unit.occupied >= before.occupied


def test_an_early_or_late_tag_opens_the_loop() -> None:
    """Right, but not within its window of running distance (T5)."""
    unit = note_head_read(SITE.plan, SITE.lists, permitted(), HEAD, OUT, False)
    assert not may_proceed(unit, RUN)


def test_a_tag_that_does_not_come_opens_the_loop() -> None:
    """By running distance it is overdue (T5)."""
    assert not may_proceed(note_window_passed(permitted()), RUN)


def test_the_same_tag_read_again_at_once_is_one_reading() -> None:
    """By the same cab; another that leads reads it anew, as the first of its run (T5)."""
    unit = reads(permitted(), OUT)
    assert may_proceed(reads(unit, OUT), RUN)
    turned = change_ends(SITE.lists, unit, OTHER)
    assert (turned.orders[RUN].expected, turned.orders[RUN].led_by) == (OUT, None)
    assert reads(turned, OUT, cab=OTHER).orders[RUN].expected == IN


def test_a_run_that_has_begun_goes_on_after_a_change_of_ends_where_it_was() -> None:
    """Only what has not begun is read from its first tag again (T5)."""
    unit = reads(permitted(), OUT, IN)
    turned = change_ends(SITE.lists, unit, OTHER)
    assert turned.orders == unit.orders
    assert turned.head_tag is None


def test_what_a_cab_reads_that_does_not_lead_is_the_tails() -> None:
    """It neither begins a run nor opens the loop; before the driver has chosen, no cab leads (T2, T5)."""
    unit = permitted()
    assert reads(unit, OUT, IN, cab=OTHER) == unit
    unit = replace(unit, leading=None)
    assert reads(unit, OUT, IN) == unit


def test_a_run_is_led_by_one_cab_throughout() -> None:
    """Whoever changes ends between the two tags reads the second unexpected (T2, T5)."""
    unit = change_ends(SITE.lists, reads(permitted(), OUT), OTHER)
    assert may_proceed(unit, RUN)
    assert not may_proceed(reads(unit, IN, cab=OTHER), RUN)


def test_an_open_loop_stays_open() -> None:
    """Reading on as if nothing had been does not close it (T5)."""
    unit = reads(note_window_passed(permitted()), OUT, IN)
    assert not may_proceed(unit, RUN)
    assert not may_proceed(take_permit(unit, RUN), RUN)
    assert not may_proceed(take_offer(SITE.lists, unit, RUN, LIST), RUN)


def test_nothing_is_expected_before_the_permit() -> None:
    """The list alone lets nobody pass a tag (T4, T5)."""
    assert not may_proceed(reads(offered(), OUT), RUN)
    assert not may_proceed(take_permit(reads(offered(), OUT), RUN), RUN)
