"""A train of 120 m over a turnout and through a curve, too fast or not (T12)."""

from __future__ import annotations

from kernel.onboard import speed_limit as machine
from kernel.onboard.speed_limit import UNKNOWN, SpeedLimit, SpeedTable
from models.onboard.speed_limit import Passage, Profile
from proofs.onboard.speed_limit import THEORY
from proofs.onboard.witnesses.play import Play

TABLE = SpeedTable(line_mm_s=36_000, curve_mm_s=25_000, turnout_mm_s=11_000)
SITE = Profile(table=TABLE, length_mm=120_000)
AT_START = Passage(
    front_mm=1_000_000,
    speed_mm_s=0,
    in_curve=False,
    at_turnout=True,
    left_curve_mm=950_000,
    left_turnout_mm=700_000,
    limit=UNKNOWN,
    brakes=True,
)


class Train(Play[Profile, Passage]):
    """A train that stands on a turnout, with its rear still in a curve; its unit has just started."""

    def __init__(self) -> None:
        """Begin."""
        super().__init__(THEORY, SITE, AT_START)

    def runs(self, to_mm: int, speed_mm_s: int, *, off_mm: int = 0, known: bool = True) -> bool:
        """Run to a place at a speed, both known to ``off_mm``; whether the unit brakes then."""
        self.step(
            "run_on",
            to_mm=to_mm,
            speed_mm_s=speed_mm_s,
            known=known,
            rear_least_mm=to_mm - SITE.length_mm - off_mm,
            front_most_mm=to_mm + off_mm,
            speed_most_mm_s=speed_mm_s + off_mm,
        )
        assert (self.system.front_mm, self.system.speed_mm_s) == (to_mm, speed_mm_s)
        return self.system.brakes

    def tag(
        self,
        *,
        curve: bool = False,
        turnout: bool = False,
        told: tuple[bool, bool] | None = None,
        off_mm: int = 0,
        known: bool = True,
    ) -> bool:
        """A tag at the front, and what lies behind it; ``told`` if that is not what it says."""
        told_curve, told_turnout = (curve, turnout) if told is None else told
        front_mm = self.system.front_mm
        self.step(
            "pass_tag",
            in_curve=curve,
            at_turnout=turnout,
            told_curve=told_curve,
            told_turnout=told_turnout,
            known=known,
            rear_least_mm=front_mm - SITE.length_mm - off_mm,
            front_most_mm=front_mm + off_mm,
            speed_most_mm_s=self.system.speed_mm_s + off_mm,
        )
        assert (self.system.in_curve, self.system.at_turnout) == (curve, turnout)
        noted = (told_curve, told_turnout) if known else (True, True)
        assert (self.system.limit.in_curve, self.system.limit.at_turnout) == noted
        return self.system.brakes


def free() -> Train:
    """A train on the plain line at 130 km/h, nothing that restricts under it."""
    train = Train()
    train.tag()
    assert not train.runs(1_120_001, 36_000)
    return train


def the_smallest_that_applies_is_permitted() -> None:
    """Line, curve, turnout, both; also where a table has it otherwise than one expects (T12)."""
    for (curve, turnout), speed in {
        (False, False): 36_000,
        (True, False): 25_000,
        (False, True): 11_000,
        (True, True): 11_000,
    }.items():
        assert machine.permitted_mm_s(TABLE, curve, turnout) == speed
    odd = SpeedTable(line_mm_s=10_000, curve_mm_s=20_000, turnout_mm_s=30_000)
    assert machine.permitted_mm_s(odd, in_curve=True, at_turnout=True) == 10_000
    odd = SpeedTable(line_mm_s=30_000, curve_mm_s=10_000, turnout_mm_s=20_000)
    assert machine.permitted_mm_s(odd, in_curve=True, at_turnout=True) == 10_000


def before_the_first_tag_everything_restricts() -> None:
    """And until the rear has passed it (T8, T12)."""
    train = Train()
    assert not train.runs(1_050_000, 11_000)
    assert train.runs(1_060_000, 11_001)
    assert not train.runs(1_060_000, 11_000)
    assert not train.tag()
    assert train.system.left_turnout_mm == 1_060_000
    assert train.runs(1_180_000, 11_001)
    assert not train.runs(1_180_001, 36_000)
    assert train.runs(1_180_001, 36_001)


def a_curve_ends_when_the_rear_has_left_it() -> None:
    """From the tag where it begins to the millimetre where the rear passes the one where it ends (T12)."""
    train = free()
    assert train.tag(curve=True)
    assert not train.runs(1_300_000, 25_000)
    assert train.runs(1_300_000, 25_001)
    assert train.tag()
    assert train.system.left_curve_mm == 1_300_000
    assert train.runs(1_420_000, 25_001)
    assert not train.runs(1_420_000, 25_000)
    assert not train.runs(1_420_001, 36_000)


def a_turnout_ends_when_the_rear_has_left_it() -> None:
    """The same, and a curve beyond it neither lifts it nor lengthens it (T12)."""
    train = free()
    train.tag(turnout=True)
    assert train.runs(1_150_000, 11_001)
    assert not train.runs(1_150_000, 11_000)
    assert not train.tag(curve=True)
    assert train.runs(1_270_000, 11_001)
    assert not train.runs(1_270_001, 25_000)
    assert train.runs(1_270_001, 25_001)


def short_plain_stretches_do_not_lengthen_a_restriction() -> None:
    """Tags of the plain line behind a turnout, closer than the train is long: it ends where it did (T12)."""
    train = free()
    train.tag(turnout=True)
    train.runs(1_150_000, 11_000)
    for place_mm in (1_150_000, 1_200_000, 1_250_000):
        train.runs(place_mm, 11_000)
        train.tag()
    assert train.runs(1_270_000, 12_000)
    assert not train.runs(1_270_001, 36_000)


def the_last_end_of_two_counts() -> None:
    """Two curves under one train: the restriction ends with the second (T12)."""
    train = free()
    for place_mm, curve in ((1_130_000, True), (1_140_000, False), (1_150_000, True), (1_160_000, False)):
        train.runs(place_mm, 25_000)
        train.tag(curve=curve)
    assert train.runs(1_280_000, 25_001)
    assert not train.runs(1_280_001, 36_000)


def the_range_counts_and_not_the_point() -> None:
    """The rear at the least, the end at the most, the speed at the most (T12, P1, P7)."""
    train = free()
    train.tag(curve=True)
    train.runs(1_300_000, 20_000)
    train.tag(off_mm=500)
    assert train.system.limit.curve_until_mm == 1_300_500
    assert train.runs(1_421_000, 24_501, off_mm=500)
    assert train.runs(1_421_000, 24_501, off_mm=500)
    assert not train.runs(1_421_001, 24_501, off_mm=500)
    assert train.runs(1_430_000, 35_501, off_mm=500)


def without_a_range_everything_restricts() -> None:
    """The train brakes at any speed; and where a restriction ended then is not known, until the next tag (T8)."""
    train = free()
    assert train.runs(1_200_000, 0, known=False, off_mm=-500)
    assert not train.runs(1_200_000, 36_000)
    assert train.tag(known=False, off_mm=-9_000_000)
    assert train.system.limit == UNKNOWN
    assert train.runs(1_400_000, 11_001)
    train.tag()
    assert train.runs(1_520_000, 11_001)
    assert not train.runs(1_520_001, 36_000)


def located_anew_it_knows_nothing_of_the_track() -> None:
    """As at power-on (T8)."""
    train = free()
    assert train.step("locate_anew").brakes
    assert train.system.limit == UNKNOWN
    assert train.runs(1_300_000, 11_001)


def what_cannot_be_read_is_the_worst_case() -> None:
    """A tag without a meaning restricts as curve and turnout, until the rear has passed the next (T12)."""
    train = free()
    assert train.tag(told=(True, True))
    assert train.runs(1_200_000, 11_001)
    assert not train.runs(1_200_000, 11_000)
    train.tag()
    assert train.runs(1_320_000, 11_001)
    assert not train.runs(1_320_001, 36_000)


def what_is_no_speed_brakes() -> None:
    """A negative one, and whatever a table without speeds permits (T12)."""
    clear = SpeedLimit(in_curve=False, at_turnout=False, curve_until_mm=0, turnout_until_mm=0)
    for speed_mm_s, brakes in ((-1, True), (0, False), (36_000, False), (36_001, True), (2**62, True)):
        assert machine.is_overspeed(TABLE, clear, True, 1, speed_mm_s) == brakes
    assert machine.is_overspeed(SpeedTable(-1, -1, -1), clear, True, 1, 0)


def what_nature_does_not_do_does_not_happen() -> None:
    """Backward, a range that does not contain the train, a tag that hides a restriction: such events are refused."""
    train = free()
    before = train.system
    event = {"known": True, "rear_least_mm": 1_000_001, "front_most_mm": 1_120_001, "speed_most_mm_s": 36_000}
    run = {"to_mm": 1_120_001, "speed_mm_s": 36_000, **event}
    pass_by = {"in_curve": False, "at_turnout": False, "told_curve": False, "told_turnout": False, **event}
    for what in (
        {"to_mm": 1_120_000, "rear_least_mm": 0},
        {"rear_least_mm": 1_000_002},
        {"front_most_mm": 1_120_000},
        {"speed_most_mm_s": 35_999},
    ):
        assert train.step("run_on", **{**run, **what}) == before
        if "to_mm" not in what:
            assert train.step("pass_tag", **{**pass_by, **what}) == before
    for hidden in ({"in_curve": True}, {"at_turnout": True}, {"in_curve": True, "told_turnout": True}):
        assert train.step("pass_tag", **{**pass_by, **hidden}) == before


WITNESSES = (
    the_smallest_that_applies_is_permitted,
    before_the_first_tag_everything_restricts,
    a_curve_ends_when_the_rear_has_left_it,
    a_turnout_ends_when_the_rear_has_left_it,
    short_plain_stretches_do_not_lengthen_a_restriction,
    the_last_end_of_two_counts,
    the_range_counts_and_not_the_point,
    without_a_range_everything_restricts,
    located_anew_it_knows_nothing_of_the_track,
    what_cannot_be_read_is_the_worst_case,
    what_is_no_speed_brakes,
    what_nature_does_not_do_does_not_happen,
)
