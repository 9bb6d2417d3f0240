"""Runs of an antenna above tags: heard well, badly, wrongly, and out of order (T1, T16, T13)."""

from __future__ import annotations

from dataclasses import replace

from kernel.onboard import tag_reader as machine
from kernel.onboard.tag_reader import NO_FRAME, Frame, Level, ReaderLimits
from models.onboard.tag_reader import NOTHING, Antenna, Passing
from proofs.onboard.tag_reader import THEORY
from proofs.onboard.witnesses.play import Play

SITE = Antenna(limits=ReaderLimits(least_mv=800, most_mv=1_200, gap_frames=6))
JUST_STARTED = Passing(
    reader=machine.restarted(),
    slots=(NOTHING, NOTHING, NOTHING, NOTHING),
    sick=False,
    delivered=NO_FRAME,
    quiet_frames=0,
    parted=False,
    delivered_before=NO_FRAME,
    parted_before=False,
)
ONE = Frame(valid=True, uid=-7, block=3, distance_mm=400_000, kind=1)
OTHER = Frame(valid=True, uid=8, block=4, distance_mm=600_000, kind=5)
GARBLED = Frame(valid=True, uid=-7, block=3, distance_mm=400_001, kind=1)
SOUND = Level(mv=1_000, valid=True)


class Above(Play[Antenna, Passing]):
    """An antenna just mended, and what comes in each frame time."""

    def __init__(self) -> None:
        """Begin."""
        super().__init__(THEORY, SITE, JUST_STARTED)
        self.step("mend")
        assert self.system.reader == machine.mended()

    def hears(
        self, *frames: Frame, below: Frame | None = None, level: Level = SOUND, sick: bool = False
    ) -> list[Frame]:
        """Frames come one after another, true unless told otherwise; gives the records delivered."""
        delivered = []
        for frame in frames:
            slots = self.system.slots
            self.step("pass_a_frame_time", frame=frame, level=level, below=frame if below is None else below, sick=sick)
            assert self.system.slots[0].heard == frame, "the frame time passes"
            assert self.system.slots[1:] == slots[:3], "the frame time passes"
            if machine.delivers(self.system.reader):
                delivered.append(self.system.reader.held)
        return delivered


def two_frames_of_four() -> None:
    """A record is delivered with its second frame, next, or after one or two that did not come."""
    for between in range(3):
        above = Above()
        assert above.hears(ONE, *[NO_FRAME] * between) == []
        assert above.hears(ONE) == [ONE]
    above = Above()
    assert above.hears(ONE, NO_FRAME, NO_FRAME, NO_FRAME, ONE) == [], "the first is too old"
    assert above.hears(ONE) == [ONE]


def a_passing_is_one_delivery() -> None:
    """However many frames come of a tag, its record is delivered once; anew after another tag's, or a gap."""
    above = Above()
    assert above.hears(*[ONE] * 9) == [ONE]
    assert above.hears(*[NO_FRAME] * 5, ONE, ONE) == [], "five frame times are no gap"
    assert above.hears(*[NO_FRAME] * 6) == []
    assert above.system.reader.held == NO_FRAME
    assert above.hears(ONE, ONE) == [ONE]
    assert above.system.delivered == ONE
    assert (above.system.delivered_before, above.system.parted_before, above.system.parted) == (ONE, True, False)
    assert above.hears(OTHER, OTHER, ONE, ONE) == [OTHER, ONE]
    assert (above.system.delivered_before, above.system.parted_before) == (OTHER, False)
    assert above.hears(*[NO_FRAME] * 3, OTHER, *[NO_FRAME] * 5) == []
    assert above.system.reader.held == ONE, "a frame between begins the count of silence anew"
    above.hears(NO_FRAME, ONE, ONE)
    assert (above.system.delivered_before, above.system.parted_before) == (ONE, True)
    above.step("restart", sick=False)
    assert above.system == JUST_STARTED


def a_wrong_frame_delivers_nothing() -> None:
    """A frame that is wrong although its CRC is right is alone; the right ones around it are taken."""
    above = Above()
    assert above.hears(GARBLED, below=ONE) == []
    assert above.hears(ONE, ONE) == [ONE]
    for distance_mm in range(5):
        wrong = replace(GARBLED, distance_mm=distance_mm)
        assert above.hears(wrong, below=NO_FRAME) == [], "any number of them, each different"
    before = above.system
    above.step("pass_a_frame_time", frame=OTHER, level=SOUND, below=NO_FRAME, sick=False)
    assert above.system != before
    again = above.system
    above.step("pass_a_frame_time", frame=OTHER, level=SOUND, below=NO_FRAME, sick=False)
    assert above.system == again, "two equal ones are not both wrong"
    for between in range(3):
        above = Above()
        assert above.hears(OTHER, *[NO_FRAME] * between, below=NO_FRAME) == []
        assert above.hears(OTHER) == [OTHER], "one of the two is right"
        above = Above()
        assert above.hears(OTHER, *[NO_FRAME] * between) == []
        assert above.hears(OTHER, below=NO_FRAME) == [OTHER], "it was below just now"


def what_is_not_valid_says_nothing() -> None:
    """Frames with a wrong CRC agree in vain."""
    above = Above()
    noise = Frame(valid=False, uid=8, block=4, distance_mm=600_000, kind=5)
    assert above.hears(noise, noise, noise, below=OTHER) == []


def a_sick_antenna_is_deaf_until_mended() -> None:
    """Transmitting too weakly, too strongly, or with no level measured, it delivers nothing; then it must be mended."""
    for level in (Level(799, True), Level(1_201, True), Level(1_000, False)):
        above = Above()
        above.hears(ONE)
        assert above.hears(GARBLED, GARBLED, below=ONE, level=level, sick=True) == []
        assert above.hears(ONE, ONE, ONE) == [], "latched, though its level is right again"
        assert above.system.sick
        above.step("restart", sick=True)
        assert above.system == replace(JUST_STARTED, sick=True)
        assert above.hears(ONE, ONE) == [], "nor does a restart mend it"
        above.hears(*[NO_FRAME] * 7)
        above.step("mend")
        assert above.system == replace(JUST_STARTED, reader=machine.mended())
        assert above.hears(ONE) == [], "what was heard before is forgotten"
        assert above.hears(ONE) == [ONE]


def the_limits_are_sound() -> None:
    """A level on the limit is right."""
    above = Above()
    assert above.hears(ONE, level=Level(800, True)) == []
    assert above.hears(ONE, level=Level(1_200, True)) == [ONE]


def a_sick_antenna_shows() -> None:
    """It is assumed that a sick antenna does not show a sound level."""
    above = Above()
    before = above.system
    above.step("pass_a_frame_time", frame=ONE, level=SOUND, below=NO_FRAME, sick=True)
    assert above.system == before


def a_record_is_taken_once() -> None:
    """It is delivered until it is taken, and the same passing delivers it no second time (T1, T16)."""
    above = Above()
    assert above.hears(ONE, ONE) == [ONE]
    above.step("take")
    assert not machine.delivers(above.system.reader)
    assert above.hears(ONE, ONE) == []


def a_cycle_counts_its_own_frames() -> None:
    """Two frames on both sides of a cycle's beginning are none; nor is a record that nobody took (T1, P7)."""
    above = Above()
    assert above.hears(ONE) == []
    above.step("begin_a_cycle")
    assert above.system.slots == JUST_STARTED.slots
    assert above.hears(ONE) == []
    assert above.hears(ONE) == [ONE]
    above.step("begin_a_cycle")
    assert not machine.delivers(above.system.reader)


def another_antenna_was_not_above_what_the_one_before_was() -> None:
    """What was heard stays heard; what was delivered is taken (T3, T13)."""
    above = Above()
    assert above.hears(ONE, ONE) == [ONE]
    above.step("be_another")
    assert [(slot.heard, slot.below) for slot in above.system.slots[:2]] == [(ONE, NO_FRAME), (ONE, NO_FRAME)]
    assert not machine.delivers(above.system.reader)


def a_train_that_begins_anew_has_heard_nothing() -> None:
    """A sound antenna stays sound, and one that has failed stays failed, until staff mends it (T13, P7)."""
    above = Above()
    above.hears(ONE)
    above.step("begin_anew")
    assert above.system == replace(JUST_STARTED, reader=machine.mended())
    assert above.hears(ONE) == []
    assert above.hears(ONE) == [ONE]
    above.hears(NO_FRAME, level=Level(799, True), sick=True)
    above.step("begin_anew")
    assert above.system == replace(JUST_STARTED, sick=True)


WITNESSES = (
    two_frames_of_four,
    a_passing_is_one_delivery,
    a_wrong_frame_delivers_nothing,
    what_is_not_valid_says_nothing,
    a_sick_antenna_is_deaf_until_mended,
    the_limits_are_sound,
    a_sick_antenna_shows,
    a_record_is_taken_once,
    a_cycle_counts_its_own_frames,
    another_antenna_was_not_above_what_the_one_before_was,
    a_train_that_begins_anew_has_heard_nothing,
)
