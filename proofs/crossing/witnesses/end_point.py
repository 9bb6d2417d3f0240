"""Trains at an end point: out, back, pushed about, with missed tags, parted, and telegrams that come late (X4, T14)."""

from __future__ import annotations

from dataclasses import replace

from kernel.crossing import crossing as crossing_machine
from kernel.crossing import end_point as machine
from kernel.crossing.crossing import Crossing, Train
from kernel.crossing.end_point import EndPointSettings, TailRead
from kernel.names import Tag
from models.crossing.end_point import BETWEEN, INSIDE, OUT, AtEndPoint, Place, Told
from proofs.crossing.end_point import THEORY
from proofs.onboard.witnesses.play import Play
from proofs.onboard.witnesses.sixty_four_bits import Checked

INNER, OUTER = Tag("inner"), Tag("outer")
OTHER_INNER, OTHER_OUTER, START = Tag("inner, next road"), Tag("outer, next road"), Tag("start point")
SETTINGS = EndPointSettings(INNER, OUTER, apart_cycles=20, told_cycles=3, changes_cycles=60)


class End(Play[Place, AtEndPoint]):
    """An end point in service, and a train inside."""

    def __init__(self, settings: EndPointSettings = SETTINGS) -> None:
        """Begin."""
        nothing = Told(TailRead(START, START, 10, False), 20)
        start = AtEndPoint(False, 100, INSIDE, False, 0, 0, START, 10, START, 20, False, nothing, False, False)
        super().__init__(THEORY, Place(settings), start)
        self.step("put_into_service")
        assert self.system.in_service == machine.are_lawful(settings)

    def cycles(self, count: int) -> None:
        """Let cycles pass."""
        before = self.system
        for _ in range(count):
            self.step("run_a_cycle")
        assert self.system == replace(before, now=before.now + count)

    def go_out(self, cycles: int = 2, *, inner: bool = True, outer: bool = True) -> None:
        """Its rear runs out over both tags in so many cycles, and reads them."""
        before = self.system
        self.step("pass_inner_tag_out", is_read=inner)
        assert (self.system.end, self.system.inner_at) == (BETWEEN, before.now)
        assert self.system.last == (INNER if inner else before.last)
        self.cycles(cycles)
        self.step("pass_outer_tag_out", is_read=outer)
        assert (self.system.end, self.system.out_at) == (OUT, before.now + cycles)
        assert (self.system.last == OUTER) == outer

    def come_in(self, *, outer: bool = True, inner: bool = True) -> None:
        """It has changed ends, and its other end comes in as the tail."""
        self.step("come_back")
        assert self.system.end == INSIDE
        self.cycles(2)
        self.step("come_in_over_the_outer_tag", is_read=outer)
        assert (self.system.last_at == self.system.now) == outer
        self.cycles(2)
        self.step("come_in_over_the_inner_tag", is_read=inner)
        assert self.system.inner_at == self.system.now
        assert (self.system.last_at == self.system.now) == inner

    def tell(self, *, is_whole: bool = True) -> Told:
        """It tells what its tail has read."""
        system = self.system
        apart_cycles = system.last_at - system.before_at
        told = Told(TailRead(system.before, system.last, apart_cycles, is_whole), system.last_at)
        self.step("tell", told=told)
        assert (self.system.is_told, self.system.told) == (True, told)
        return told

    def hears(self, told: Told, late_cycles: int = 0) -> bool:
        """The terminal hears a telegram, that says to be so much older than it is; whether the train is gone by it."""
        age_cycles = self.system.now - told.read_at + late_cycles
        if told == self.system.told:
            self.step("hear", age_cycles=age_cycles)
        assert not self.system.wrong
        return machine.has_left(self.site.settings, told.read, age_cycles)


def a_train_that_leaves_is_told_gone() -> None:
    """As soon as its tail has read both tags; and again, to no harm, while what it told counts (X4, T14)."""
    end = End()
    end.go_out()
    told = end.tell()
    assert (told.read.before, told.read.last, told.read.apart_cycles) == (INNER, OUTER, 2)
    for _ in range(4):
        assert end.hears(told)
        end.cycles(1)
    assert not end.hears(told)


def it_alone_is_gone_by_it() -> None:
    """Of others that were warned of nothing is said; and nothing of it while it has not left (X4)."""
    mine, another = Train("mine"), Train("another")
    crossing = Crossing({mine: True, another: True}, {}, {}, {}, {mine: 1, another: 2}, {}, 2, True, 40)
    for last, left in ((OUTER, {another: True}), (INNER, {mine: True, another: True})):
        is_gone = machine.has_left(SETTINGS, TailRead(INNER, last, 2, True), 0)
        assert crossing_machine.note_gone(crossing, mine, 1, is_gone).asks == left


def who_stands_between_the_tags_is_not_gone() -> None:
    """Its rear may still be over the road; and a tail that has read one tag twice has read one tag (T2)."""
    end = End()
    end.step("pass_inner_tag_out", is_read=True)
    assert not end.hears(end.tell())
    end.step("come_back")
    assert end.system.end == INSIDE
    end.step("pass_inner_tag_out", is_read=True)
    assert (end.system.before, end.system.last) == (INNER, INNER)
    assert not end.hears(end.tell())


def who_comes_in_is_not_gone() -> None:
    """Its tail reads the outer tag first (T2)."""
    end = End()
    end.go_out()
    assert end.hears(end.tell())
    end.cycles(61)
    end.come_in()
    assert (end.system.before, end.system.last) == (OUTER, INNER)
    assert not end.hears(end.tell())


def tags_that_were_missed_on_the_way_out_and_in_show_nobody_out() -> None:
    """The inner one was read as it left, and the outer one as it came in: in that order, and too far apart (T2)."""
    end = End()
    end.go_out(outer=False)
    assert not end.hears(end.tell())
    end.cycles(61)
    end.step("come_back")
    end.cycles(2)
    end.step("come_in_over_the_outer_tag", is_read=True)
    told = end.tell()
    assert (told.read.before, told.read.last, told.read.apart_cycles) == (INNER, OUTER, 65)
    assert not end.hears(told)


def who_has_come_back_is_not_gone_by_what_it_told_before() -> None:
    """It reads nothing as it comes in, and tells once more, or a telegram of before comes again (T11)."""
    end = End()
    end.go_out()
    told = end.tell()
    assert end.hears(told)
    end.cycles(61)
    end.come_in(outer=False, inner=False)
    assert not end.hears(told)
    assert not end.hears(end.tell())


def a_part_that_stays_behind_is_not_gone() -> None:
    """The through line is broken, and the train tells it (P5, T13)."""
    end = End()
    end.step("part")
    assert end.system.left_behind
    end.go_out()
    before = end.system
    whole = Told(TailRead(INNER, OUTER, 2, True), before.last_at)
    assert end.step("tell", told=whole) is before
    assert not end.hears(end.tell(is_whole=False))


def the_tags_of_the_next_road_say_nothing_of_this_one() -> None:
    """Two roads lie close together; the train has passed the other one, and comes to this one (T1, X4)."""
    end = End()
    for tag in (OTHER_INNER, OTHER_OUTER):
        end.step("read_elsewhere", tag=tag)
        end.cycles(2)
        assert end.system.last == tag
        assert not end.hears(end.tell())
    for pair in ((OTHER_INNER, OUTER), (INNER, OTHER_OUTER)):
        assert not machine.has_left(SETTINGS, TailRead(*pair, 2, True), 0)


def a_rear_that_creeps_out_is_not_told_gone() -> None:
    """From tag to tag it took longer than is written; then a detector or a person tells: that is the price (X4)."""
    for cycles, gone in ((20, True), (21, False)):
        end = End()
        end.go_out(cycles)
        assert end.hears(end.tell()) == gone


def what_is_told_too_old_does_not_count() -> None:
    """By its age, which is not made less on its way (T11)."""
    end = End()
    end.go_out()
    told = end.tell()
    assert end.hears(told, late_cycles=3)
    assert not end.hears(told, late_cycles=4)


def a_time_below_zero_tells_nothing() -> None:
    """The clock of a host, or of a train, has gone back (X4)."""
    for apart_cycles, age_cycles, left in ((0, 0, True), (-1, 0, False), (0, -1, False)):
        assert machine.has_left(SETTINGS, TailRead(INNER, OUTER, apart_cycles, True), age_cycles) is left


def settings_are_checked() -> None:
    """Neither what is told nor the way from tag to tag lasts longer than changing ends; two tags are two (X4)."""
    for change in ({"told_cycles": 61}, {"apart_cycles": 61}, {"outer": INNER}):
        refused = End(replace(SETTINGS, **change))
        before = refused.system
        assert not before.in_service
        for step in ("pass_inner_tag_out", "come_in_over_the_outer_tag", "come_in_over_the_inner_tag"):
            assert refused.step(step, is_read=True) is before
        between = refused.system = replace(before, end=BETWEEN)
        assert refused.step("pass_outer_tag_out", is_read=True) is between
        assert refused.step("come_back") is between
    for change in ({"told_cycles": 60}, {"apart_cycles": 60}):
        assert machine.are_lawful(replace(SETTINGS, **change))  # type: ignore[arg-type]


def what_nature_does_not_do_does_not_happen() -> None:
    """Nobody is back at once, reads backwards, parts outside, or tells what he did not read; nothing grows younger."""
    end = End()
    inside = end.system
    assert end.step("pass_outer_tag_out", is_read=True) is inside
    assert end.step("read_elsewhere", tag=INNER) is inside
    assert end.step("read_elsewhere", tag=OUTER) is inside
    false = Told(TailRead(INNER, OUTER, 2, True), inside.now)
    assert end.step("tell", told=false) is inside
    assert end.step("hear", age_cycles=90) is inside
    end.go_out()
    end.tell()
    end.cycles(60)
    there = end.system
    for step in ("pass_inner_tag_out", "come_in_over_the_outer_tag", "come_in_over_the_inner_tag"):
        assert end.step(step, is_read=True) is there
    assert end.step("come_back") is there
    assert end.step("part") is there
    assert end.step("hear", age_cycles=59) is there
    end.cycles(1)
    end.step("come_back")
    end.step("come_in_over_the_inner_tag", is_read=False)
    back = end.system
    assert end.step("come_in_over_the_outer_tag", is_read=True) is back


def every_number_fits_into_64_bits() -> None:
    """Cycles of a day, of a millisecond (X4)."""
    most = Checked(10**8)
    settings = EndPointSettings(INNER, OUTER, most, most, most)
    assert machine.are_lawful(settings)
    assert machine.has_left(settings, TailRead(INNER, OUTER, most, True), most)


WITNESSES = (
    a_train_that_leaves_is_told_gone,
    it_alone_is_gone_by_it,
    who_stands_between_the_tags_is_not_gone,
    who_comes_in_is_not_gone,
    tags_that_were_missed_on_the_way_out_and_in_show_nobody_out,
    who_has_come_back_is_not_gone_by_what_it_told_before,
    a_part_that_stays_behind_is_not_gone,
    the_tags_of_the_next_road_say_nothing_of_this_one,
    a_rear_that_creeps_out_is_not_told_gone,
    what_is_told_too_old_does_not_count,
    a_time_below_zero_tells_nothing,
    settings_are_checked,
    what_nature_does_not_do_does_not_happen,
    every_number_fits_into_64_bits,
)
