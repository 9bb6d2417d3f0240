"""One train and the length that its computer measures by the tags that both its antennas read (P4, T3)."""

from __future__ import annotations

from dataclasses import replace
from functools import cache

from kernel.onboard import computer, train_length
from kernel.onboard.computer import Computer
from models.onboard.units import NM_A_MM
from proofs.onboard.witnesses.one_train import LIMITS, SITE, Ride, approaching
from proofs.onboard.witnesses.rolling_stock import START_MM

TAG_MM = START_MM + 100_000


def _past_the_tag(apart_mm: int) -> Ride:
    """Give a train whose head has read a tag, and whose tail's antenna is over it, so far behind the head's."""
    ride = approaching(TAG_MM)
    ride.reads(TAG_MM)
    ride.step("await_none")
    assert ride.system.formation.head_passed
    ride.step("come_apart", apart_nm=apart_mm * NM_A_MM)
    ride.until(TAG_MM + 4_000 + apart_mm)
    ride.tail_reads(TAG_MM, front_mm=TAG_MM + 4_000 + apart_mm)
    return ride


@cache
def _measured() -> Computer:
    """Give the computer of a whole train that has just been measured."""
    return _past_the_tag(LIMITS.antennas_mm).system.computer


def a_train_is_measured_by_a_tag_that_both_antennas_read() -> None:
    """Its length is in what was measured, which no other place forgets, but the next inspection does (P4, T3)."""
    ride = _past_the_tag(LIMITS.antennas_mm)
    length = ride.system.computer.length
    assert length.measured
    assert length.least_mm <= SITE.length_mm <= length.most_mm < LIMITS.train.length_mm
    assert ride.system.formation.measured_nm == SITE.length_mm * NM_A_MM
    assert ride.fits()
    ride.draw_up()
    front_mm = ride.system.front_nm // NM_A_MM
    ride.step("locate_anew", least_mm=front_mm - 2_000, most_mm=front_mm + 2_000)
    assert ride.system.computer.length == replace(length, head_passed=False)
    ride.step("find_whole")
    assert ride.system.computer.length == train_length.UNMEASURED


def no_length_is_measured_by_anothers_antenna() -> None:
    """The rear cab of what remains is not the train's end (P4, T13)."""
    ride = _past_the_tag(40_000)
    assert ride.is_caught()
    assert not ride.system.computer.length.measured
    assert ride.system.formation.untold
    assert ride.system.formation.length_nm == 48_000 * NM_A_MM


def a_tail_does_not_count_once_its_train_is_another_than_written() -> None:
    """Longer than is written with all errors taken off, or measured as another than before: it is not whole (P4)."""
    here = _measured()
    for least_mm, is_intact in ((LIMITS.train.length_mm, True), (LIMITS.train.length_mm + 1, False)):
        measured = replace(here.length, least_mm=least_mm)
        assert computer.through_line(LIMITS, replace(here, length=measured), True).is_intact == is_intact
    contradicted = replace(here, length=replace(here.length, contradicted=True))
    assert not computer.through_line(LIMITS, contradicted, True).is_intact


def the_faster_end_of_a_cycle_counts_for_a_pass_and_none_runs_backwards() -> None:
    """A read lies between two states of the odometry; the tail's counts as later than the head's (P4)."""
    here = _measured()
    for before_mm_s, now_mm_s, most_mm_s in ((9_000, 4_000, 9_000), (4_000, 9_000, 9_000), (-2, -1, 0)):
        before = replace(here.before, speed_most_mm_s=before_mm_s)
        motion = replace(here.known.motion, speed_most_mm_s=now_mm_s)
        at = replace(here, before=before, known=replace(here.known, motion=motion))
        assert computer.tag_passed(at, 7, computer.BY_HEAD_MS).speed_most_mm_s == most_mm_s
    by_head, by_tail = (computer.tag_passed(here, 7, each) for each in (computer.BY_HEAD_MS, computer.BY_TAIL_MS))
    assert by_head.time_ms < by_tail.time_ms
    assert replace(by_head, time_ms=by_tail.time_ms) == by_tail
    assert (by_tail.point, by_tail.kind) == (7, train_length.PointKind.TAG)
