"""The tag reader at its edges, from pages to records, and in drawn worlds (T1, T16, T13)."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from kernel.onboard import tag_reader as machine
from kernel.onboard.frames import frame
from kernel.onboard.tag_reader import NO_FRAME, Frame, Level, Reader
from kernel.tags import Pages, TagRecord, encode
from models.onboard.tag_reader import Slot
from proofs.onboard.tag_reader import THEORY
from proofs.onboard.witnesses.play import Play
from proofs.onboard.witnesses.tag_reader import JUST_STARTED, ONE, OTHER, SITE, SOUND, WITNESSES

LIMITS = SITE.limits
FRAMES = st.sampled_from((NO_FRAME, NO_FRAME, ONE, ONE, OTHER, replace(ONE, valid=False), replace(OTHER, kind=4)))
ANY_LEVEL = st.builds(Level, st.integers(700, 1_300) | st.sampled_from((2**62, -(2**62))), st.booleans())
SOUND_LEVELS = st.sampled_from((SOUND, Level(800, True), Level(1_200, True)))


def hear(reader: Reader, *frames: Frame, level: Level = SOUND) -> Reader:
    for each in frames:
        reader = machine.note_frame(LIMITS, reader, each, level)
    return reader


@pytest.mark.parametrize("witness", WITNESSES)
def test_witness(witness: Callable[[], None]) -> None:
    assert witness.__doc__
    witness()


@pytest.mark.parametrize("field", ["uid", "block", "distance_mm", "kind"])
def test_frames_that_differ_in_anything_do_not_agree(field: str) -> None:
    other = replace(ONE, **{field: getattr(ONE, field) + 1})
    assert not machine.delivers(hear(machine.mended(), ONE, other))


def test_a_level_of_any_size_is_judged() -> None:
    for mv in (2**62, -(2**62), 0, -1):
        assert hear(machine.mended(), ONE, ONE, level=Level(mv, True)) == machine.restarted()


def test_a_restarted_reader_hears_nothing() -> None:
    assert hear(machine.restarted(), ONE, ONE, ONE) == machine.restarted()


def test_a_stuck_receiver_delivers_its_frame_once() -> None:
    """The same frame for ever is one tag; the second loop then misses the next one (T5)."""
    reader = hear(machine.mended(), ONE, ONE)
    assert machine.delivers(reader)
    for _ in range(100):
        reader = hear(reader, ONE)
        assert not machine.delivers(reader)


def test_no_frame_for_long_is_counted_only_as_far_as_a_gap() -> None:
    assert hear(machine.mended(), *[NO_FRAME] * 50).quiet_frames == LIMITS.gap_frames


@given(
    uid=st.integers(0, 2**64 - 1),
    block=st.integers(0, 255),
    distance_mm=st.integers(0, 2**28 - 1),
    kind=st.integers(0, 15),
    flipped=st.integers(-1, 63),
)
@example(uid=2**64 - 1, block=255, distance_mm=2**28 - 1, kind=15, flipped=-1)
@example(uid=2**63, block=0, distance_mm=0, kind=0, flipped=0)
def test_pages_become_a_frame_or_none(uid: int, block: int, distance_mm: int, kind: int, flipped: int) -> None:
    """What was written is heard, in 64 bits with a sign; with a bit flipped nothing is."""
    pages = encode(TagRecord(uid, block, distance_mm, kind))
    assert isinstance(pages, Pages)
    if flipped < 0:
        heard = frame(uid, pages)
        assert heard == Frame(True, heard.uid, block, distance_mm, kind)
        assert heard.uid % 2**64 == uid
        assert -(2**63) <= heard.uid < 2**63
    else:
        both = (pages.first << 32 | pages.second) ^ 1 << flipped
        assert frame(uid, Pages(both >> 32, both & (1 << 32) - 1)) == NO_FRAME


@given(uid=st.integers(max_value=-1) | st.integers(min_value=2**64))
def test_a_number_that_no_tag_has_is_no_frame(uid: int) -> None:
    assert frame(uid, Pages(0, 0)) == NO_FRAME


def rarely(one_in: int) -> st.SearchStrategy[bool]:
    return st.integers(1, one_in).map(lambda drawn: drawn == one_in)


EVENTS = st.builds(
    lambda heard, other, wrong, level, any_level, sick, then: (
        heard,
        other if wrong else heard,
        any_level if sick else level,
        sick,
        then,
    ),
    heard=FRAMES,
    other=FRAMES,
    wrong=rarely(6),
    level=SOUND_LEVELS,
    any_level=ANY_LEVEL,
    sick=rarely(40),
    then=st.sampled_from((*[""] * 16, "take", "begin_a_cycle", "begin_anew", "be_another")),
)


def test_drawn_worlds_keep_what_is_claimed() -> None:
    seen = {"delivered": 0, "sick": 0, "wrong": 0}

    @given(runs=st.lists(st.lists(EVENTS, min_size=10, max_size=30), max_size=4), mended=st.booleans())
    @settings(max_examples=100, deadline=None, derandomize=True)
    def drawn_worlds(runs: list[list[tuple[Frame, Frame, Level, bool, str]]], mended: bool) -> None:
        play = Play(THEORY, SITE, JUST_STARTED)
        for run in runs:
            play.step("mend") if mended else play.step("restart", sick=play.system.sick)
            mended = True
            for heard, below, level, sick, then in run:
                play.step("pass_a_frame_time", frame=heard, level=level, below=below, sick=sick)
                seen["delivered"] += machine.delivers(play.system.reader)
                seen["sick"] += play.system.sick
                seen["wrong"] += heard.valid and play.system.slots[0] == Slot(heard, below) and heard != below
                if then:
                    play.step(then)
                    assert not machine.delivers(play.system.reader)

    drawn_worlds()
    assert all(count > 100 for count in seen.values()), seen
