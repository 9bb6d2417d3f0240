"""One train and what its two readers deliver, whatever its host, an echo or a failed antenna makes of it (T1, T13)."""

from __future__ import annotations

from dataclasses import replace

from kernel.onboard import computer, tag_reader
from kernel.onboard.tag_reader import NO_FRAME, Level
from models.onboard.units import NM_A_MM
from proofs.onboard.witnesses.one_train import (
    AT_THE_HEAD,
    AT_THE_TAIL,
    LIMITS,
    Ride,
    approaching,
    heard,
    record,
)
from proofs.onboard.witnesses.rolling_stock import START_MM
from proofs.onboard.witnesses.tag_reader import SOUND

TAG_MM = START_MM + 100_000
FRONT_MM = TAG_MM + 4_000
TAG = record(TAG_MM)
LISTED = {"place_mm": TAG_MM, "in_curve": False, "at_turnout": False}


def nothing_is_read(ride: Ride) -> bool:
    """Tell whether a host that says what it likes changes nothing: no record is delivered."""
    before = ride.system
    ride.step("read_a_tag", **LISTED)
    ride.step("read_unlisted", in_curve=True, at_turnout=True)
    ride.step("read_by_the_tail")
    return ride.system == before


def one_frame_alone_is_no_read() -> None:
    """Nor is a host's word that there was one: before any frame, after one, or after the read was taken (T16)."""
    ride = approaching(TAG_MM)
    assert nothing_is_read(ride)
    ride.hears(TAG, front_mm=FRONT_MM, times=1)
    ride.hears(TAG, front_mm=FRONT_MM + LIMITS.antennas_mm, times=1, antenna=AT_THE_TAIL)
    assert nothing_is_read(ride)
    ride.hears(TAG, front_mm=FRONT_MM, times=1)
    ride.step("read_a_tag", **LISTED)
    assert ride.system.expecting.taken
    assert nothing_is_read(ride), "a record is taken once"
    ride.hears(TAG, front_mm=FRONT_MM, times=3)
    assert nothing_is_read(ride), "and a passing is delivered once"


def equal_frames_too_far_apart_are_no_read() -> None:
    """Three frame times may lie between two frames that agree, and no more (T16)."""
    for between, reads in ((2, True), (3, False), (4, False)):
        ride = approaching(TAG_MM)
        ride.hears(TAG, front_mm=FRONT_MM, times=1)
        ride.hears(NO_FRAME, front_mm=FRONT_MM, times=between)
        ride.hears(TAG, front_mm=FRONT_MM, times=1)
        assert nothing_is_read(ride) != reads


def what_is_read_is_what_is_delivered() -> None:
    """A number and a kind are the record's, whatever came last (T1)."""
    begun = approaching(TAG_MM).system.computer
    other = replace(TAG, uid=TAG_MM + 1, kind=5)
    delivered = heard(begun, TAG)
    read = computer.read_by_head(LIMITS, delivered, TAG_MM)
    assert read.spacing.reads.first.uid == TAG_MM
    assert not read.known.limit.at_turnout
    late = computer.note_head_frame(LIMITS, delivered, other, SOUND)
    assert computer.read_by_head(LIMITS, late, TAG_MM) == late, "and it is taken in its frame time"
    assert computer.read_unlisted(late) == late


def what_nobody_took_is_not_taken_in_the_next_cycle() -> None:
    """By then the train has run on; nor do frames of two cycles make one record (T1, P7)."""
    ride = approaching(TAG_MM)
    ride.hears(TAG, front_mm=FRONT_MM)
    ride.hears(TAG, front_mm=FRONT_MM + LIMITS.antennas_mm, antenna=AT_THE_TAIL)
    ride.cycle(5_000)
    assert nothing_is_read(ride)
    ride = approaching(TAG_MM)
    ride.hears(TAG, front_mm=FRONT_MM, times=1)
    ride.cycle(5_000)
    ride.hears(TAG, front_mm=ride.system.from_nm // NM_A_MM + 1, times=1)
    assert ride.system.computer.head.newest == TAG
    assert nothing_is_read(ride)


def an_antenna_that_failed_is_deaf_through_everything_but_mending() -> None:
    """A restart, a train found whole and one located anew, with or without a change of ends, mend nothing (T13, T8)."""
    ride = Ride()
    ride.start()
    ride.draw_up()
    front_mm = ride.system.front_nm // NM_A_MM
    here = {"least_mm": front_mm - 2_000, "most_mm": front_mm + 2_000}
    sound = ride.system
    for failed, other in ((AT_THE_HEAD, "tail"), (AT_THE_TAIL, "head")):
        ride.system = sound
        faint = {"frame": NO_FRAME, "level": Level(0, True), "below": NO_FRAME, "at_nm": front_mm * NM_A_MM}
        ride.step(failed, sick=True, **faint)
        assert getattr(ride.system.computer, other).healthy
        ride.step("find_whole")
        assert getattr(ride.system.computer, other).healthy
        ride.step("locate_anew", **here)
        assert ride.system.head.passing.sick
        assert ride.system.tail.passing.sick
        assert ride.system.computer.head == ride.system.computer.tail == tag_reader.restarted()
    ride.system = sound
    ride.step("locate_anew", **here)
    assert ride.system.computer.head == ride.system.computer.tail == tag_reader.mended()
    ride.step("put_into_service", **here)
    assert ride.system.computer.head == ride.system.computer.tail == tag_reader.restarted()
    begun = ride.system
    ride.step("mend_the_heads_antenna")
    ride.step("mend_the_tails_antenna")
    assert ride.system == begun, "its computer has yet to know that the brake holds it"
    ride.stand_until_held()
    ride.step("mend_the_heads_antenna")
    assert ride.system.computer.head == tag_reader.mended()
    assert ride.system.computer.tail == tag_reader.restarted()
    ride.step("mend_the_tails_antenna")
    assert ride.system.computer.tail == tag_reader.mended()


def a_tag_is_put_down_to_the_frame_time_in_which_it_was_below() -> None:
    """An echo comes later: the train has run on, and what was below was below before (T1, T2)."""
    ride = approaching(TAG_MM)
    event = {"frame": TAG, "level": SOUND, "sick": False}
    for between in range(3):
        ride = approaching(TAG_MM)
        ride.step(AT_THE_HEAD, **event, below=TAG, at_nm=(FRONT_MM - 20) * NM_A_MM)
        ride.hears(NO_FRAME, front_mm=FRONT_MM - 10, times=between)
        ride.step(AT_THE_HEAD, **event, below=NO_FRAME, at_nm=FRONT_MM * NM_A_MM)
        assert ride.system.head.read_at_nm == (FRONT_MM - 20) * NM_A_MM
        assert ride.system.head.lay_below == TAG
    ride = approaching(TAG_MM)
    ride.step(AT_THE_HEAD, **event, below=TAG, at_nm=(FRONT_MM - 20) * NM_A_MM)
    ride.step(AT_THE_HEAD, **event, below=TAG, at_nm=FRONT_MM * NM_A_MM)
    assert ride.system.head.read_at_nm == FRONT_MM * NM_A_MM


def nature_brings_no_frame_that_is_none_of_it() -> None:
    """A sick antenna shows, no tag is below from afar, and two equal frames are not both wrong (T13, T16)."""
    ride = approaching(TAG_MM)
    before = ride.system
    there = {"frame": TAG, "level": SOUND, "below": TAG, "sick": False, "at_nm": FRONT_MM * NM_A_MM}
    for antenna, run_mm in ((AT_THE_HEAD, 0), (AT_THE_TAIL, LIMITS.antennas_mm)):
        afar_nm = (FRONT_MM + run_mm + 501) * NM_A_MM
        for wrong in ({"sick": True}, {"at_nm": afar_nm}, {"at_nm": 0, "below": NO_FRAME}):
            ride.step(antenna, **there | wrong)
            assert ride.system == before
        ride.step(antenna, **there | {"below": NO_FRAME})
        once = ride.system
        assert once != before
        ride.step(antenna, **there | {"below": NO_FRAME})
        assert ride.system == once
        ride.system = before


def a_train_comes_apart_when_its_tails_read_is_taken() -> None:
    """What another antenna heard is not what this one was above (T3, T13)."""
    ride = approaching(TAG_MM)
    ride.reads(TAG_MM)
    ride.step("await_none")
    tail_mm = FRONT_MM + LIMITS.antennas_mm
    ride.until(tail_mm)
    ride.hears(TAG, front_mm=tail_mm, antenna=AT_THE_TAIL)
    due = ride.system
    ride.step("come_apart", apart_nm=40_000 * NM_A_MM)
    assert ride.system is due
    ride.step("read_by_the_tail")
    ride.step("come_apart", apart_nm=40_000 * NM_A_MM)
    assert ride.system.trailing.apart_nm == 40_000 * NM_A_MM
    assert not any(slot.below.valid for slot in ride.system.tail.passing.slots)


WITNESSES = (
    one_frame_alone_is_no_read,
    equal_frames_too_far_apart_are_no_read,
    what_is_read_is_what_is_delivered,
    what_nobody_took_is_not_taken_in_the_next_cycle,
    an_antenna_that_failed_is_deaf_through_everything_but_mending,
    a_tag_is_put_down_to_the_frame_time_in_which_it_was_below,
    nature_brings_no_frame_that_is_none_of_it,
    a_train_comes_apart_when_its_tails_read_is_taken,
)
