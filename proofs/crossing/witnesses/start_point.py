"""Trains at a start point: side by side, close behind, turning back, and a terminal without power (X3, T14)."""

from __future__ import annotations

from dataclasses import replace

from kernel.crossing import start_point as machine
from kernel.crossing.crossing import Train
from kernel.crossing.start_point import StartPoint, StartPointSettings
from kernel.names import Tag
from models.crossing import start_point as world
from models.crossing.start_point import AtStartPoint, Place, Told
from proofs.crossing.start_point import THEORY
from proofs.onboard.witnesses.play import Play
from proofs.onboard.witnesses.sixty_four_bits import Checked

HERE, BESIDE = Tag("of this track"), Tag("of the track beside")
HEARD, UNHEARD, THIRD = Train("with radio"), Train("without radio"), Train("a third")
NEW, NOBODY = Train("strike 1"), Train("nobody")
SETTINGS = StartPointSettings(HERE, told_cycles=2, waits_cycles=20, changes_cycles=60)


class Point(Play[Place, AtStartPoint]):
    """A start point in service, long after the last strike if not told otherwise."""

    def __init__(self, settings: StartPointSettings = SETTINGS, *, quiet: bool = True) -> None:
        """Begin."""
        nothing = Told(False, NOBODY, NOBODY, NOBODY)
        point = StartPoint(NOBODY, 0, 0, False)
        start = AtStartPoint(False, False, NOBODY, 0, False, 0, 0, nothing, point)
        super().__init__(THEORY, Place(settings), start)
        self.step("put_into_service", nobody=NOBODY)
        assert self.system.in_service == self.system.has_power == machine.are_lawful(settings)
        if quiet and self.system.in_service:
            self.step("tell_what_may_be_missed")
            self.cycles(10)

    def cycles(self, count: int) -> None:
        """Let cycles pass."""
        before = self.system
        for _ in range(count):
            self.step("run_a_cycle")
        assert self.system.passed_cycles == before.passed_cycles + count
        assert self.system.struck_cycles == before.struck_cycles + count
        assert self.system.point.struck_cycles == before.point.struck_cycles + count

    def come(self, train: Train, *, tells: bool = True) -> None:
        """A head passes the tag, and says so at once if not told otherwise."""
        self.step("pass_tag", train=train)
        assert (self.system.last, self.system.passed_cycles, self.system.is_before) == (train, 0, True)
        if tells:
            self.tell(train)

    def tell(self, train: Train, tag: Tag = HERE) -> bool:
        """The terminal hears a read; give whether it waits now."""
        self.step("hear_read", train=train, tag=tag)
        return self.system.point.left_cycles > 0 and self.system.point.reader == train

    def strike(self, train: Train) -> Train:
        """A train strikes; give the name by which that is told."""
        self.step("strike", train=train, new=NEW)
        assert (self.system.is_before, self.system.struck_cycles) == (False, 0)
        told = self.system.told
        assert (told.is_any, told.by, told.new) == (True, train, NEW)
        assert (self.system.point.left_cycles, self.system.point.struck_cycles) == (0, 0)
        return told.name


def a_train_that_told_of_the_tag_is_left_to_its_rangings() -> None:
    """Its strike is put down to it, whether it runs or creeps to the detector (X3, T14)."""
    for cycles in (0, 2, 19):
        point = Point()
        point.come(HEARD)
        point.cycles(cycles)
        assert point.system.point.left_cycles == 20 - cycles
        assert point.strike(HEARD) == HEARD
    point = Point()
    point.come(HEARD)
    point.cycles(20)
    assert point.system.point.left_cycles == 0
    assert point.strike(HEARD) == NEW


def who_tells_nothing_has_a_name_of_its_own() -> None:
    """For it the crossing warns (X3)."""
    point = Point()
    point.come(UNHEARD, tells=False)
    assert point.strike(UNHEARD) == NEW


def a_train_in_contact_on_the_track_beside_takes_no_strike_upon_itself() -> None:
    """Side by side, at the same distance: its read is of another tag, and here somebody else strikes (X3, T14)."""
    point = Point()
    point.come(UNHEARD, tells=False)
    assert not point.tell(HEARD, BESIDE)
    assert point.strike(UNHEARD) == NEW


def a_read_that_comes_late_or_again_waits_for_no_other_train() -> None:
    """Close behind comes one without radio; of the two one strike each is told (X3, T14)."""
    point = Point()
    point.come(HEARD)
    assert point.strike(HEARD) == HEARD
    point.cycles(1)
    assert not point.tell(HEARD)
    point.come(UNHEARD, tells=False)
    point.cycles(1)
    assert not point.tell(HEARD)
    assert point.strike(UNHEARD) == NEW
    point = Point()
    point.come(HEARD, tells=False)
    assert point.strike(HEARD) == NEW
    point.come(UNHEARD, tells=False)
    assert not point.tell(HEARD)
    assert point.strike(UNHEARD) == NEW


def the_next_train_is_heard_again() -> None:
    """Once the strike before is older than whatever is told (T14)."""
    for cycles, name in ((2, NEW), (3, HEARD)):
        point = Point()
        point.come(UNHEARD, tells=False)
        point.strike(UNHEARD)
        point.cycles(cycles)
        point.come(HEARD)
        assert point.strike(HEARD) == name


def who_turns_back_before_the_detector_takes_no_strike_upon_itself() -> None:
    """It has read the tag and goes back; before another train can be there its read has stopped waiting (X3)."""
    point = Point()
    point.come(HEARD)
    for _ in range(2):
        point.cycles(1)
        assert point.tell(HEARD)
    before = point.system
    assert point.step("pass_tag", train=UNHEARD) == before
    point.cycles(58)
    before = point.system
    assert point.step("pass_tag", train=UNHEARD) == before
    point.cycles(1)
    point.come(UNHEARD, tells=False)
    before = point.system
    assert point.step("strike", train=HEARD, new=NEW) == before
    assert point.strike(UNHEARD) == NEW


def who_comes_to_the_tag_anew_tells_anew() -> None:
    """It had gone back a little (T14)."""
    point = Point()
    point.come(HEARD)
    point.cycles(30)
    point.come(HEARD)
    assert point.strike(HEARD) == HEARD


def a_strike_without_power_is_told_of_when_power_is_back() -> None:
    """The terminal does not know of it, and tells so all the same; what is told to it late does not count (X3)."""
    point = Point()
    point.come(HEARD)
    point.step("lose_power")
    before = point.system
    assert point.step("hear_read", train=HEARD, tag=HERE) == before
    assert point.step("strike", train=HEARD, new=NEW) == before
    point.step("strike_without_power", train=HEARD)
    assert (point.system.missed, point.system.is_before, point.system.told.is_any) == (1, False, False)
    assert point.system.struck_cycles == 0
    unheard = point.system
    assert point.step("tell_what_may_be_missed") == unheard
    point.cycles(1)
    point.step("restart", nobody=NOBODY)
    assert (point.system.missed, point.system.point) == (1, StartPoint(NOBODY, 0, 0, True))
    assert not point.tell(HEARD)
    point.come(UNHEARD, tells=False)
    assert point.strike(UNHEARD) == NEW
    assert point.system.point.owes
    told = point.step("tell_what_may_be_missed")
    assert (told.missed, told.point.owes) == (0, False)
    assert point.step("tell_what_may_be_missed") == told


def several_strikes_are_missed_without_power() -> None:
    """One word for all of them: nobody can say how many there were (X3)."""
    point = Point()
    point.step("lose_power")
    for number, train in enumerate((UNHEARD, THIRD), start=1):
        point.come(train, tells=False)
        point.step("strike_without_power", train=train)
        assert point.system.missed == number
        point.cycles(30)
    point.step("restart", nobody=NOBODY)
    assert (point.system.missed, point.system.point.owes) == (2, True)
    assert point.step("tell_what_may_be_missed").missed == 0


def a_start_owes_word_of_strikes() -> None:
    """Even one that missed none (X3)."""
    point = Point(quiet=False)
    assert (point.system.point.owes, point.system.missed) == (True, 0)
    point.step("tell_what_may_be_missed")
    assert not point.system.point.owes


def settings_are_checked() -> None:
    """A read may wait as long as no other train can be there, and no longer (X3)."""
    assert Point(StartPointSettings(HERE, 2, 58, 60)).system.in_service
    refused = Point(StartPointSettings(HERE, 2, 59, 60))
    before = refused.system
    assert not before.in_service
    assert refused.step("restart", nobody=NOBODY) == before
    assert refused.step("pass_tag", train=HEARD) == before
    assert refused.step("strike", train=HEARD, new=NEW) == before
    point = Point()
    point.come(HEARD)
    there = point.system
    assert point.step("strike_without_power", train=HEARD) == there


def what_nature_does_not_do_does_not_happen() -> None:
    """Nobody tells of a tag that he did not pass, or long ago (T11, T14)."""
    point = Point()
    before = point.system
    assert point.step("hear_read", train=HEARD, tag=HERE) == before
    point.come(UNHEARD, tells=False)
    there = point.system
    assert point.step("hear_read", train=HEARD, tag=HERE) == there
    point.cycles(3)
    there = point.system
    assert point.step("hear_read", train=UNHEARD, tag=HERE) == there


def every_number_fits_into_64_bits() -> None:
    """Cycles of a day, of a millisecond (X3)."""
    settings = StartPointSettings(HERE, Checked(2), Checked(20), Checked(60))
    most = Checked(10**8)
    point = machine.note_read(settings, StartPoint(NOBODY, Checked(0), most, False), HEARD, HERE)
    assert machine.aged(point) == StartPoint(HEARD, 19, 10**8 + 1, False)
    assert machine.are_lawful(settings)


def a_train_strikes_once_and_a_read_waits_no_longer_than_nothing() -> None:
    """Who has struck is beyond the detector (X3)."""
    point = Point()
    point.come(HEARD)
    point.strike(HEARD)
    before = point.system
    assert point.step("strike", train=HEARD, new=THIRD) is before
    assert machine.aged(StartPoint(NOBODY, 0, 0, False)).left_cycles == 0


def what_trains_may_tell_of_a_tag() -> None:
    """Of another track anything; of this one who passed it last, or anybody while a telegram may be late (T14)."""
    point = Point()
    point.come(HEARD, tells=False)
    site, system = point.site, point.system
    assert world.a_read_is_told_in_time(site, system, HEARD, HERE)
    assert world.a_read_is_told_in_time(site, system, THIRD, BESIDE)
    assert not world.a_read_is_told_in_time(site, system, THIRD, HERE)
    point.strike(HEARD)
    point.cycles(2)
    assert world.a_read_is_told_in_time(site, point.system, THIRD, HERE)
    point.cycles(1)
    assert not world.a_read_is_told_in_time(site, point.system, THIRD, HERE)


def without_power_a_terminal_hears_and_tells_nothing() -> None:
    """Nor does anybody strike who has not passed the tag (X3)."""
    point = Point(quiet=False)
    point.cycles(10)
    point.step("pass_tag", train=HEARD)
    point.step("lose_power")
    before = point.system
    assert before.point.owes
    assert point.step("hear_read", train=HEARD, tag=HERE) is before
    assert point.step("tell_what_may_be_missed") is before
    assert point.step("strike_without_power", train=UNHEARD) is before


def what_is_not_owed_is_not_told() -> None:
    """A terminal that owes nothing has missed nothing; of one that has, history would not be rid of it so (X3)."""
    point = Point()
    lost = replace(point.system, missed=1)
    assert not lost.point.owes
    assert world.tell_what_may_be_missed(point.site, lost) is lost


WITNESSES = (
    a_train_that_told_of_the_tag_is_left_to_its_rangings,
    who_tells_nothing_has_a_name_of_its_own,
    a_train_in_contact_on_the_track_beside_takes_no_strike_upon_itself,
    a_read_that_comes_late_or_again_waits_for_no_other_train,
    the_next_train_is_heard_again,
    who_turns_back_before_the_detector_takes_no_strike_upon_itself,
    who_comes_to_the_tag_anew_tells_anew,
    a_strike_without_power_is_told_of_when_power_is_back,
    several_strikes_are_missed_without_power,
    a_start_owes_word_of_strikes,
    settings_are_checked,
    what_nature_does_not_do_does_not_happen,
    every_number_fits_into_64_bits,
    a_train_strikes_once_and_a_read_waits_no_longer_than_nothing,
    what_trains_may_tell_of_a_tag,
    without_power_a_terminal_hears_and_tells_nothing,
    what_is_not_owed_is_not_told,
)
