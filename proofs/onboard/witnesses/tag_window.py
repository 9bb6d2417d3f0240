"""Runs of a train from tag to tag: in place, early, late, missing, without an odometer (T5)."""

from __future__ import annotations

from dataclasses import replace

from kernel.onboard import tag_window as machine
from kernel.onboard.tag_window import GREATEST_DISTANCE_MM, NONE_AWAITED, Verdict, WindowLimits
from kernel.onboard.way import GREATEST_MM, UNKNOWN, Way
from models.onboard.tag_window import Expecting, Stretch
from models.onboard.units import NM_A_MM
from proofs.onboard.tag_window import THEORY
from proofs.onboard.witnesses.play import Play

SITE = Stretch(
    limits=WindowLimits(tolerance_mm=1_513, width_mm=10_000, tail_width_mm=10_000), laying_mm=1_000, read_mm=513
)
AT_REST = Expecting(
    window=NONE_AWAITED,
    way_nm=0,
    late=False,
    missed=False,
    lost=False,
    taken=False,
    in_place=False,
    out_of_place=False,
)
PLANNED_MM = 500_000


class Between(Play[Stretch, Expecting]):
    """A train at a tag, with the next one planned."""

    def __init__(self, planned_mm: int = PLANNED_MM) -> None:
        """Begin."""
        super().__init__(THEORY, SITE, AT_REST)
        self.step("expect_a_tag", way_nm=0, least_mm=planned_mm, most_mm=planned_mm)
        assert self.system.window.expected

    def runs(self, way_mm: int, behind_mm: int = 0, ahead_mm: int = 0, way: Way | None = None) -> bool:
        """A cycle ends here; the odometry's range reaches behind and ahead.  Tells whether the tag is overdue."""
        told = Way(True, way_mm - behind_mm, way_mm + ahead_mm) if way is None else way
        self.step("run_a_cycle", way_nm=NM_A_MM * way_mm, way=told)
        assert self.system.way_nm == NM_A_MM * way_mm, "the cycle passes"
        return self.system.window.passed

    def reads(
        self, lies_mm: int, off_mm: int = 0, behind_mm: int = 0, ahead_mm: int = 0, way: Way | None = None
    ) -> Verdict:
        """A tag is read that lies here, off the middle of the windows."""
        way_mm = lies_mm + off_mm
        told = Way(True, way_mm - behind_mm, way_mm + ahead_mm) if way is None else way
        self.step("read_a_tag", way_nm=NM_A_MM * way_mm, way=told, lies_nm=NM_A_MM * lies_mm)
        assert self.system.way_nm == NM_A_MM * way_mm, "it is read"
        verdict = machine.judge(SITE.limits, self.system.window, told)
        assert self.system.taken == (verdict == Verdict.IN_WINDOW)
        return verdict

    def expects(self, planned_mm: int) -> None:
        """The tag was read; the next is so far away, and nothing is told of it yet."""
        self.step("expect_a_tag", way_nm=0, least_mm=planned_mm, most_mm=planned_mm)
        assert self.system == replace(
            AT_REST, window=machine.await_tag(planned_mm, planned_mm), taken=self.system.taken
        )


def a_tag_in_place() -> None:
    """To the edges of laying and read window, with the odometry at its worst, a tag is taken; the next is awaited."""
    for laid, off in ((1_000, 513), (-1_000, -513), (0, 0)):
        for behind, ahead in ((0, 0), (10_000, 0), (0, 10_000)):
            between = Between()
            assert not between.runs(200_000, behind, ahead)
            assert not between.runs(PLANNED_MM + laid + off, behind, ahead)
            assert between.reads(PLANNED_MM + laid, off, behind, ahead) == Verdict.IN_WINDOW
            assert between.system.in_place
            between.expects(300_000)


def a_tag_out_of_place() -> None:
    """A tag that comes too early or too late is not taken."""
    between = Between()
    assert between.reads(PLANNED_MM - 1_000 - 12_027, ahead_mm=10_000) == Verdict.EARLY
    assert between.system.out_of_place
    assert between.reads(PLANNED_MM - 1_514) == Verdict.EARLY
    assert between.reads(PLANNED_MM - 1_513) == Verdict.IN_WINDOW, "within what the errors allow"
    assert between.reads(PLANNED_MM + 1_513) == Verdict.IN_WINDOW
    assert between.reads(PLANNED_MM + 1_514) == Verdict.LATE
    assert between.reads(PLANNED_MM + 1_000 + 12_027, behind_mm=10_000) == Verdict.LATE
    assert between.system.out_of_place
    between.expects(300_000)


def a_missing_tag() -> None:
    """A tag that does not come is overdue once the train is surely past it, and stays so when the train rolls back."""
    between = Between()
    assert not between.runs(PLANNED_MM + 1_513)
    assert not between.runs(PLANNED_MM + 11_513, behind_mm=10_000)
    assert between.runs(PLANNED_MM + 11_514, behind_mm=10_000)
    assert between.system.missed
    assert between.runs(PLANNED_MM)
    assert between.system.missed
    between.expects(PLANNED_MM)


def none_awaited() -> None:
    """After the last tag nothing is overdue, and whatever is read is not in its window."""
    between = Between()
    assert between.runs(PLANNED_MM + 2_000)
    between.step("expect_none")
    assert between.system.window == NONE_AWAITED
    assert not between.runs(10 * PLANNED_MM)
    assert between.reads(0) == Verdict.UNKNOWN
    assert between.system.out_of_place


def the_odometer_is_lost() -> None:
    """Without a range, or with one that cannot be, the tag is overdue at once, and none is in its window."""
    for way_mm, way in (
        (1_000, UNKNOWN),
        (GREATEST_MM + 1, Way(True, GREATEST_MM - 5_000, GREATEST_MM + 1)),
        (-GREATEST_MM - 1, Way(True, -GREATEST_MM - 1, -GREATEST_MM + 5_000)),
        (1_000, Way(False, PLANNED_MM, PLANNED_MM)),
        (1_000, Way(False, 0, 10**6)),
    ):
        between = Between()
        assert between.reads(way_mm, way=way) == Verdict.UNKNOWN
        assert between.runs(way_mm, way=way)
        assert between.system.lost
        between.expects(PLANNED_MM)
    assert machine.judge(SITE.limits, machine.await_tag(5, 5), Way(True, 6, 5)) == Verdict.UNKNOWN, "crossed limits"
    edge = Way(True, -GREATEST_MM, GREATEST_MM)
    widest = WindowLimits(tolerance_mm=0, width_mm=2 * GREATEST_MM, tail_width_mm=0)
    assert machine.judge(widest, machine.await_tag(5, 5), edge) == Verdict.IN_WINDOW


def the_way_is_known_badly() -> None:
    """A range as wide as is written is held against the plan; a wider one is not, and the tag is overdue (T5)."""
    between = Between()
    assert not between.runs(PLANNED_MM, behind_mm=10_000)
    assert between.reads(PLANNED_MM, behind_mm=10_000) == Verdict.IN_WINDOW
    assert between.reads(PLANNED_MM, behind_mm=10_001) == Verdict.UNKNOWN
    assert between.runs(PLANNED_MM, behind_mm=10_001)
    assert between.system.lost


def no_such_plan() -> None:
    """A distance that no record can hold is no plan: the loop opens; the longest that one can hold is."""
    for planned_mm in (-1, GREATEST_DISTANCE_MM + 1):
        between = Between(planned_mm)
        assert between.reads(planned_mm) == Verdict.UNKNOWN
        assert between.runs(0)
    for planned_mm in (0, GREATEST_DISTANCE_MM):
        assert Between(planned_mm).reads(planned_mm) == Verdict.IN_WINDOW


def somewhere_in_a_block() -> None:
    """A train that begins to run anywhere in a block awaits the next tag from here to the block's end."""
    for lies_mm, verdict in (
        (0, Verdict.IN_WINDOW),
        (PLANNED_MM, Verdict.IN_WINDOW),
        (200_000 - 1_513, Verdict.IN_WINDOW),
        (200_000 - 1_514, Verdict.EARLY),
        (PLANNED_MM + 1_513, Verdict.IN_WINDOW),
        (PLANNED_MM + 1_514, Verdict.LATE),
    ):
        between = Between()
        between.step("expect_a_tag", way_nm=0, least_mm=0 if lies_mm == 0 else 200_000, most_mm=PLANNED_MM)
        assert between.reads(lies_mm) == verdict
        assert between.runs(lies_mm) == (verdict == Verdict.LATE)
    between = Between()
    between.step("expect_a_tag", way_nm=0, least_mm=PLANNED_MM, most_mm=PLANNED_MM - 1)
    assert between.reads(PLANNED_MM) == Verdict.UNKNOWN, "crossed limits are no plan"


def what_nature_does_not_do() -> None:
    """A tag outside the read window, and a range that does not contain the way, are not reckoned with."""
    between = Between()
    before = between.system
    between.step("read_a_tag", way_nm=514 * NM_A_MM, way=Way(True, 514, 514), lies_nm=0)
    between.step("read_a_tag", way_nm=0, way=Way(True, 1, 1), lies_nm=0)
    between.step("run_a_cycle", way_nm=2 * NM_A_MM, way=Way(True, 1, 1))
    between.step("run_a_cycle", way_nm=0, way=Way(True, 1, 1))
    assert between.system == before


WITNESSES = (
    a_tag_in_place,
    a_tag_out_of_place,
    a_missing_tag,
    none_awaited,
    the_odometer_is_lost,
    the_way_is_known_badly,
    no_such_plan,
    somewhere_in_a_block,
    what_nature_does_not_do,
)
