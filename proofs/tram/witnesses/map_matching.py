"""A tram on a line that bends, doubles back and has gaps in its table, and fixes of it that err (G1)."""

from __future__ import annotations

from dataclasses import replace

from kernel.tram.map_matching import Foot, Matched, MatchLimits, Point, Range, Stretch, matched, nothing_found
from models.tram.map_matching import Fixing, Survey, stretch_between
from proofs.onboard.witnesses.play import Play
from proofs.tram.map_matching import THEORY

SITE = Survey(MatchLimits(most_mm=20_000))
ERROR_MM = 15_000
EAST = stretch_between(Point(0, 0), Point(100_000, 0), 0, 100_000, ERROR_MM)
NORTH = stretch_between(Point(100_000, 0), Point(100_000, 50_000), 100_000, 150_000, ERROR_MM)
BACK = stretch_between(Point(100_000, 10_000), Point(0, 10_000), 110_000, 210_000, ERROR_MM)
ASKEW = stretch_between(Point(0, 0), Point(30_001, 40_000), 0, 50_100, ERROR_MM)


class Along(Play[Survey, Fixing]):
    """A tram on a line; it begins at the start of a stretch."""

    def __init__(self, own: Stretch = EAST, site: Survey = SITE) -> None:
        """Begin: no fix yet."""
        nowhere = Foot(own, False, False, 0, 0, 0, 0)
        super().__init__(
            THEORY,
            site,
            Fixing(own, 0, own.length_mm, False, nothing_found(own.start), nowhere, False, False, None),
        )

    def fix(self, own: Stretch, part_um: int, place: Point) -> None:
        """Run there, and take a fix."""
        self.step("run_on", own=own, part_um=part_um, length_mm=own.length_mm)
        assert (self.system.own, self.system.part_um, self.system.is_fixed) == (own, part_um, False)
        self.step("take_fix", place=place)
        assert (self.system.found, self.system.is_fixed) == (nothing_found(place), True)
        assert (self.system.is_new, self.system.own_taken, self.system.told_mm) == (False, False, None)

    def look(self, *line: Stretch) -> Range | None:
        """Look at stretches of the table; the range found."""
        before = self.system.found
        for stretch in line:
            self.step("look_at", stretch=stretch)
            assert self.system.is_new
            self.step("take_in")
        if before == nothing_found(before.place):
            assert matched(line, before.place) == self.system.found
        return self.system.found.within

    def told(self) -> int | None:
        """Tell of a place, if there is one."""
        self.step("tell")
        return self.system.told_mm


def a_tram_is_put_at_right_angles_onto_its_line() -> None:
    """14 m beside it and 15 m too far on; the place is the nearest, and the range reaches to the tram (3.1.1; G1)."""
    along = Along()
    along.fix(EAST, 40_000_000, Point(55_000, 14_000))
    assert along.told() is None
    assert along.look(EAST, NORTH) == Range(40_000, 70_001)
    assert along.told() == 55_000
    assert along.system.own_taken


def round_a_bend_it_may_be_on_either_stretch() -> None:
    """The range has a part of both; a place is told if neither end is farther from it than 20 m (G1)."""
    along = Along()
    along.fix(NORTH, 2_000_000, Point(98_000, 6_000))
    assert along.look(EAST, NORTH) == Range(83_000, 121_001)
    assert along.told() is None
    along.fix(NORTH, 2_000_000, Point(98_000, 3_000))
    assert along.look(EAST, NORTH) == Range(83_000, 118_001)
    assert along.told() == 103_000
    along.fix(EAST, 99_000_000, Point(99_000, 0))
    assert along.look(NORTH, EAST) == Range(84_000, 115_001)
    assert along.told() == 99_000
    along.fix(EAST, 99_000_000, Point(99_000, 0))
    assert along.look(EAST, NORTH) == Range(84_000, 115_001)
    assert along.told() == 99_000


def where_the_line_doubles_back_no_place_is_told() -> None:
    """The other track of a loop is 10 m beside: the range is of both, as far as one can be off (G1)."""
    along = Along()
    along.fix(EAST, 50_000_000, Point(50_000, 9_000))
    assert along.look(BACK) == Range(145_000, 175_001)
    assert along.system.found.nearest == Matched(160_000, Point(50_000, 10_000), 1_000_000)
    assert along.told() is None
    assert along.look(EAST) == Range(35_000, 175_001)
    assert along.told() is None
    assert along.system.own_taken


def on_a_stretch_askew_the_range_is_rounded_outwards() -> None:
    """Its kilometrage grows by other than its length, which is no whole number (G1)."""
    along = Along(ASKEW)
    assert ASKEW.length_mm == 50_001
    along.fix(ASKEW, 25_050_000, Point(15_000, 20_000))
    assert along.look(ASKEW) == Range(10_019, 40_080)
    assert along.told() == 25_049
    assert along.look(ASKEW) == Range(10_019, 40_080)


def beyond_its_error_a_line_is_not_found() -> None:
    """Of a fix that is farther from each stretch; the tram's own was not looked at yet (G1)."""
    along = Along()
    for place in (Point(40_000, 15_001), Point(40_000, -15_001), Point(-15_001, 0), Point(115_001, 0)):
        along.fix(stretch_between(Point(place.x_mm, place.y_mm), Point(0, 900_000), 0, 900_000, ERROR_MM), 0, place)
        assert along.look(EAST) is None
        assert along.system.found.nearest is None
        assert along.told() is None
    for place in (Point(40_000, 15_000), Point(40_000, -15_000), Point(-15_000, 0), Point(115_000, 0)):
        along.fix(stretch_between(Point(place.x_mm, place.y_mm), Point(0, 900_000), 0, 900_000, ERROR_MM), 0, place)
        assert along.look(EAST) is not None
        assert along.system.found.nearest is not None


def a_stretch_of_a_millimetre_is_one() -> None:
    """Also if its kilometrage grows by no more (G1)."""
    short = stretch_between(Point(0, 0), Point(1, 0), 0, 1, ERROR_MM)
    along = Along(short)
    along.fix(short, 0, Point(-14_999, 0))
    assert along.look(short) == Range(0, 2)
    assert along.system.found.nearest == Matched(0, Point(0, 0), 14_999**2)
    assert along.told() == 0
    along.fix(short, 1_000, Point(0, 0))
    assert along.look(short) == Range(0, 2)
    assert along.told() == 0
    along.fix(stretch_between(Point(-15_001, 0), Point(-90_000, 0), 0, 90_000, ERROR_MM), 0, Point(-15_001, 0))
    assert along.look(short) is None


def beside_an_end_it_may_be_there_and_no_place_is_near() -> None:
    """Off along the track and across it, each by no more than it errs: in all it is 20 m off (G1)."""
    along = Along()
    along.fix(EAST, 0, Point(-14_000, -14_000))
    assert along.look(EAST) == Range(0, 1_001)
    assert along.system.found.nearest is None
    assert along.told() is None


def in_a_street_canyon_no_place_is_told() -> None:
    """Fixes of a tram there err by 60 m, and its range says so; far from it the line has its places (G1)."""
    canyon = stretch_between(Point(100_000, 0), Point(300_000, 0), 100_000, 300_000, 60_000)
    beyond = stretch_between(Point(300_000, 0), Point(500_000, 0), 300_000, 500_000, ERROR_MM)
    along = Along()
    along.fix(canyon, 100_000_000, Point(260_000, 20_000))
    assert along.look(EAST, canyon, beyond) == Range(200_000, 300_001)
    assert along.told() is None
    for at_mm, told in ((350_000, None), (361_000, 361_000)):
        along.fix(beyond, 1_000 * (at_mm - 300_000), Point(at_mm, 0))
        along.look(EAST, canyon, beyond)
        assert along.told() == told


def what_is_no_stretch_spoils_the_table() -> None:
    """Without a length, with one that is written too short, or with a kilometrage that does not grow (G1)."""
    for wrong in (
        stretch_between(Point(0, 0), Point(0, 0), 0, 10_000, ERROR_MM),
        replace(EAST, length_mm=99_999),
        replace(EAST, length_mm=-100_000),
        replace(EAST, grows_mm=0),
    ):
        along = Along()
        along.fix(EAST, 40_000_000, Point(40_000, 0))
        along.look(wrong)
        assert not along.system.found.is_sound
        along.look(EAST)
        assert not along.system.found.is_sound
        assert along.told() is None
        assert along.system.own_taken


def a_place_is_told_as_far_as_it_is_known() -> None:
    """20 m to either side and no more, and what was told before does not stay (G1)."""
    for most_mm, told in ((15_001, 40_000), (15_000, None)):
        along = Along(site=Survey(MatchLimits(most_mm)))
        along.fix(EAST, 40_000_000, Point(40_000, 0))
        along.look(EAST)
        assert along.told() == told
    along = Along()
    along.fix(EAST, 40_000_000, Point(40_000, 0))
    along.look(EAST)
    assert along.told() == 40_000
    along.look(BACK)
    assert along.told() is None
    along.fix(EAST, 8_000_000, Point(3_000, 0))
    along.look(EAST)
    assert along.told() == 3_000
    assert along.system.found.within == Range(0, 18_001)


def what_nature_does_not_do() -> None:
    """Be beside the line, err by more than is written, or tell of a place before the whole table was looked at (G1)."""
    along = Along()
    before = along.system
    assert along.step("tell") == before
    for part_um, length_mm in ((-1, 100_000), (100_000_001, 100_000), (0, 99_999), (0, 100_001)):
        assert along.step("run_on", own=EAST, part_um=part_um, length_mm=length_mm) == before
    for place in (Point(15_001, 0), Point(-15_001, 0), Point(0, 15_001), Point(0, -15_001)):
        assert along.step("take_fix", place=place) == before
    along.fix(EAST, 0, Point(15_000, -15_000))
    along.look(NORTH)
    assert along.step("tell") == along.system


def what_was_looked_at_for_an_earlier_fix_is_not_of_the_next() -> None:
    """The foot of a fix that is taken in late widens the range alone (G1)."""
    along = Along()
    along.fix(EAST, 40_000_000, Point(40_000, 0))
    assert along.look(EAST) == Range(25_000, 55_001)
    assert along.told() == 40_000
    along.fix(EAST, 90_000_000, Point(90_000, 0))
    along.step("take_in")
    assert not along.system.own_taken
    assert along.look(EAST) == Range(25_000, 100_001)
    assert along.told() is None


WITNESSES = (
    a_tram_is_put_at_right_angles_onto_its_line,
    round_a_bend_it_may_be_on_either_stretch,
    where_the_line_doubles_back_no_place_is_told,
    on_a_stretch_askew_the_range_is_rounded_outwards,
    beyond_its_error_a_line_is_not_found,
    a_stretch_of_a_millimetre_is_one,
    beside_an_end_it_may_be_there_and_no_place_is_near,
    in_a_street_canyon_no_place_is_told,
    what_is_no_stretch_spoils_the_table,
    a_place_is_told_as_far_as_it_is_known,
    what_nature_does_not_do,
    what_was_looked_at_for_an_earlier_fix_is_not_of_the_next,
)
