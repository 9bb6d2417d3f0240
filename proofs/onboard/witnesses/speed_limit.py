"""A train of 120 m over a turnout and through a curve, too fast or not (T12)."""

from __future__ import annotations

from kernel.onboard import speed_limit as machine
from kernel.onboard.speed_limit import UNKNOWN, SpeedLimit, SpeedTable
from kernel.onboard.tag_kind import is_curve, is_turnout
from models.onboard.speed_limit import Passage, Profile
from models.onboard.units import NM_A_MM, UM_A_MM
from proofs.onboard.speed_limit import THEORY
from proofs.onboard.witnesses.play import Play

TABLE = SpeedTable(line_mm_s=36_000, curve_mm_s=25_000, turnout_mm_s=11_000)
KINDS = {(False, False): 1, (True, False): 3, (False, True): 5, (True, True): 0}
"""What is written where a curve begins, or a turnout; no code is for both."""
SITE = Profile(table=TABLE, length_mm=120_000)
AT_START = Passage(
    front_nm=1_000_000 * NM_A_MM,
    speed_um_s=0,
    in_curve=False,
    at_turnout=True,
    left_curve_nm=950_000 * NM_A_MM,
    left_turnout_nm=700_000 * NM_A_MM,
    curve_listed=False,
    turnout_listed=False,
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
            to_nm=to_mm * NM_A_MM,
            speed_um_s=speed_mm_s * UM_A_MM,
            known=known,
            rear_least_mm=to_mm - SITE.length_mm - off_mm,
            front_most_mm=to_mm + off_mm,
            speed_most_mm_s=speed_mm_s + off_mm,
        )
        assert (self.system.front_nm, self.system.speed_um_s) == (to_mm * NM_A_MM, speed_mm_s * UM_A_MM)
        return self.system.brakes

    def misses(self, *, curve: bool = False, turnout: bool = False) -> bool:
        """Pass a tag at the front unread, and what lies behind it; whether such a world can be."""
        before = self.system
        front_mm = self.system.front_nm // NM_A_MM
        self.step(
            "miss_a_tag",
            in_curve=curve,
            at_turnout=turnout,
            known=True,
            rear_least_mm=front_mm - SITE.length_mm,
            front_most_mm=front_mm,
            speed_most_mm_s=self.system.speed_um_s // UM_A_MM,
        )
        assert self.system.limit == before.limit
        return (self.system.in_curve, self.system.at_turnout) == (curve, turnout)

    def tag(
        self,
        *,
        curve: bool = False,
        turnout: bool = False,
        kind: int | None = None,
        off_mm: int = 0,
        known: bool = True,
    ) -> bool:
        """A tag at the front, and what lies behind it; ``kind`` if that is not what it says."""
        told = KINDS[curve, turnout] if kind is None else kind
        front_mm = self.system.front_nm // NM_A_MM
        self.step(
            "pass_tag",
            in_curve=curve,
            at_turnout=turnout,
            kind=told,
            known=known,
            rear_least_mm=front_mm - SITE.length_mm - off_mm,
            front_most_mm=front_mm + off_mm,
            speed_most_mm_s=self.system.speed_um_s // UM_A_MM + off_mm,
        )
        assert (self.system.in_curve, self.system.at_turnout) == (curve, turnout)
        noted = (is_curve(told), is_turnout(told)) if known else (True, True)
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


def each_kind_says_what_lies_from_it_on() -> None:
    """Curves are 3 and 4, turnouts 5 and 6, the others of 1 to 9 neither; what is not assigned is both (T1, T12)."""
    both = dict.fromkeys((-3, -1, 0, 10, 15, 16, 90), (True, True))
    neither = dict.fromkeys((1, 2, 7, 8, 9), (False, False))
    told = {3: (True, False), 4: (True, False), 5: (False, True), 6: (False, True), **both, **neither}
    clear = SpeedLimit(in_curve=False, at_turnout=False, curve_until_mm=7, turnout_until_mm=8)
    for kind, (curve, turnout) in told.items():
        assert machine.note_tag(clear, kind, True, 9) == SpeedLimit(curve, turnout, 7, 8), kind


def before_the_first_tag_everything_restricts() -> None:
    """And until the rear has passed it (T8, T12)."""
    train = Train()
    assert not train.runs(1_050_000, 11_000)
    assert train.runs(1_060_000, 11_001)
    assert not train.runs(1_060_000, 11_000)
    assert not train.tag()
    assert train.system.left_turnout_nm == 1_060_000 * NM_A_MM
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
    assert train.system.left_curve_nm == 1_300_000 * NM_A_MM
    assert train.runs(1_420_000, 25_001)
    assert not train.runs(1_420_000, 25_000)
    assert not train.runs(1_420_001, 36_000)


def what_a_list_has_counts_without_its_tag() -> None:
    """From where the front may be there, until the rear has passed the next tag that is read (T5, T12)."""
    for curve, turnout, speed in ((True, False, 25_000), (False, True, 11_000)):
        train = free()
        assert not train.misses(curve=curve, turnout=turnout), "no list has it"
        train.step("come_to_listed", curve=curve, turnout=turnout)
        assert train.runs(1_200_000, speed + 1)
        assert not train.runs(1_200_000, speed)
        assert not train.misses(curve=turnout, turnout=curve), "the list has the other"
        assert train.misses(curve=curve, turnout=turnout)
        assert train.misses(), "and the plain track after it may be missed too"
        here_nm = 1_200_000 * NM_A_MM
        left = train.system.left_curve_nm == here_nm, train.system.left_turnout_nm == here_nm
        assert left == (curve, turnout), "where the front left it"
        train.runs(1_190_000, speed)
        assert train.misses()
        back_nm = 1_190_000 * NM_A_MM
        left = train.system.left_curve_nm == back_nm, train.system.left_turnout_nm == back_nm
        assert left == (curve, turnout), "what is behind a front that has rolled back was left there"
        assert train.runs(1_300_000, speed + 1)
        assert not train.runs(1_300_000, speed)
        train.tag()
        assert train.runs(1_420_000, speed + 1)
        assert not train.runs(1_420_001, 36_000)
        assert not train.misses(curve=curve, turnout=turnout), "what was listed before that tag was read"


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
    assert (train.system.limit.in_curve, train.system.limit.at_turnout) == (True, True)
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
    assert train.tag(kind=0)
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
    """A range that does not contain the train, a tag that hides a restriction: such events are refused."""
    train = free()
    before = train.system
    event = {"known": True, "rear_least_mm": 1_000_001, "front_most_mm": 1_120_001, "speed_most_mm_s": 36_000}
    run = {"to_nm": 1_120_001 * NM_A_MM, "speed_um_s": 36_000 * UM_A_MM, **event}
    pass_by = {"in_curve": False, "at_turnout": False, "kind": 1, **event}
    for what in (
        {"rear_least_mm": 1_000_002},
        {"front_most_mm": 1_120_000},
        {"speed_most_mm_s": 35_999},
    ):
        assert train.step("run_on", **{**run, **what}) == before
        assert train.step("pass_tag", **{**pass_by, **what}) == before
    hides = [("in_curve", kind) for kind in (1, 2, 5, 6, 7, 8, 9)] + [
        ("at_turnout", kind) for kind in (1, 2, 3, 4, 7, 8, 9)
    ]
    for what_lies_there, kind in hides:
        assert train.step("pass_tag", **{**pass_by, what_lies_there: True, "kind": kind}) == before
    for what_lies_there, kind in (
        ("in_curve", 3),
        ("in_curve", 4),
        ("at_turnout", 5),
        ("at_turnout", 6),
        ("in_curve", 10),
    ):
        assert train.step("pass_tag", **{**pass_by, what_lies_there: True, "kind": kind}) != before
        train.system = before


def a_train_that_has_rolled_back_is_on_the_track_behind() -> None:
    """It reads the tag before the curve's end again; what it had left lies ahead of it (T12, T5)."""
    train = free()
    train.tag(curve=True)
    train.runs(1_300_000, 20_000)
    train.tag()
    assert train.system.left_curve_nm == 1_300_000 * NM_A_MM
    assert train.runs(1_299_000, 25_001), "a curve is behind its head, and it is in it"
    train.tag(curve=True)
    assert train.system.left_curve_nm == 1_299_000 * NM_A_MM
    train.runs(1_301_000, 20_000)
    train.tag()
    assert train.runs(1_421_000, 25_001)
    assert not train.runs(1_421_001, 36_000)


WITNESSES = (
    the_smallest_that_applies_is_permitted,
    each_kind_says_what_lies_from_it_on,
    before_the_first_tag_everything_restricts,
    a_curve_ends_when_the_rear_has_left_it,
    a_turnout_ends_when_the_rear_has_left_it,
    what_a_list_has_counts_without_its_tag,
    short_plain_stretches_do_not_lengthen_a_restriction,
    the_last_end_of_two_counts,
    the_range_counts_and_not_the_point,
    without_a_range_everything_restricts,
    located_anew_it_knows_nothing_of_the_track,
    what_cannot_be_read_is_the_worst_case,
    what_is_no_speed_brakes,
    what_nature_does_not_do_does_not_happen,
    a_train_that_has_rolled_back_is_on_the_track_behind,
)
