"""Runs of a train over tags: whole, split with a cab that poses as the tail, stretched, miswired (T13, T3)."""

from __future__ import annotations

from dataclasses import replace

from kernel.onboard import antenna_spacing as machine
from kernel.onboard.antenna_spacing import SpacingLimits
from kernel.onboard.way import GREATEST_MM, UNKNOWN, Way
from models.onboard.antenna_spacing import Track, Trailing
from models.onboard.units import NM_A_MM
from proofs.onboard.antenna_spacing import THEORY
from proofs.onboard.witnesses.play import Play

TAGS = (0, 1_000, 30_000, 31_000, 60_000, 61_000, 90_000, 91_000)
"""Four boundaries, two tags at each; numbered by their places."""
APART_MM = 120_000
ANTENNA_MM = 4_000
SITE = Track(
    limits=SpacingLimits(tolerance_mm=1_013, width_mm=4_000),
    tag=0,
    antenna_mm=ANTENNA_MM,
    read_within_mm=256,
    preset_error_mm=500,
)


def front_nm(head_mm: int) -> int:
    """Give where the front is when the head's antenna is here."""
    return NM_A_MM * (head_mm + ANTENNA_MM)


JUST_STARTED = Trailing(
    spacing=machine.restarted(),
    front_nm=front_nm(-200_000),
    apart_nm=NM_A_MM * APART_MM,
    is_preset=False,
    whole=False,
    forward=False,
    head_newest=0,
    head_has_read=False,
    since=0,
    known=False,
    least_mm=0,
    most_mm=0,
    tail_has_read=False,
    tail_is_on=False,
    tail_came_after=False,
    tail_nm=0,
    caught=False,
)


class Train(Play[Track, Trailing]):
    """A train just made up and preset."""

    def __init__(self, preset_mm: int = APART_MM, tag: int = 0) -> None:
        """Begin; history looks at one tag."""
        super().__init__(THEORY, replace(SITE, tag=tag), JUST_STARTED)
        self.step("preset", preset_mm=preset_mm)
        assert self.system.whole
        assert self.system.spacing == machine.preset(preset_mm)
        assert not self.healthy, "not before a check"

    @property
    def healthy(self) -> bool:
        """Whether the tail's reads count."""
        return machine.is_healthy(self.system.spacing)

    def _at(self, to_mm: int, behind_mm: int, ahead_mm: int) -> Way:
        if front_nm(to_mm) != self.system.front_nm:
            self.step("run", to_nm=front_nm(to_mm))
        assert self.system.front_nm == front_nm(to_mm), "the train runs"
        return Way(True, to_mm + ANTENNA_MM - behind_mm, to_mm + ANTENNA_MM + ahead_mm)

    def head(self, tag: int, off_mm: int = 0, behind_mm: int = 0, ahead_mm: int = 0, at: Way | None = None) -> None:
        """The head comes to a tag and reads it, off the middle; the odometry's range reaches so far."""
        told = self._at(tag + off_mm, behind_mm, ahead_mm)
        self.step("head_reads", uid=tag, at=told if at is None else at)
        assert self.system.spacing.reads.first.uid == tag, "it is read"

    def tail(self, tag: int, off_mm: int = 0, behind_mm: int = 0, ahead_mm: int = 0, at: Way | None = None) -> bool:
        """The antenna for the tail comes to a tag and reads it; tells whether its read counts."""
        told = self._at(tag + self.system.apart_nm // NM_A_MM + off_mm, behind_mm, ahead_mm)
        self.step("tail_reads", uid=tag, at=told if at is None else at)
        assert self.system.spacing.tail_read, "it is read"
        assert self.system.spacing.tail_uid == tag, "it is read"
        return self.healthy


def a_whole_train_over_eight_tags() -> None:
    """The head reads eight tags before the tail comes to the first; every read of the tail counts."""
    train = Train()
    for tag in TAGS:
        train.head(tag)
    for tag in TAGS:
        assert train.tail(tag)
    assert train.system.head_has_read
    assert not train.system.caught


def the_worst_of_all_errors() -> None:
    """Reads at the ends of the windows, the preset off by its error, the odometry at its worst: never accused."""
    for off, preset_mm in ((256, APART_MM - 500), (-256, APART_MM + 500)):
        for behind, ahead in ((0, 0), (2_000, 0), (0, 2_000), (1_000, 1_000)):
            train = Train(preset_mm)
            train.head(0, -off, ahead, behind)
            assert train.tail(0, off, behind, ahead)


def a_cab_poses_as_the_tail() -> None:
    """After a split the rear cab of what remains reads the tags: it is found at its first, before it counts."""
    train = Train(tag=90_000)
    for tag in TAGS:
        train.head(tag)
    assert train.tail(0)
    train.step("come_apart", apart_nm=NM_A_MM * 60_000)
    assert not train.system.whole
    train.step("run", to_nm=front_nm(149_000))
    assert not train.tail(90_000)
    assert train.system.caught
    assert train.system.spacing.broken
    train.step("come_apart", apart_nm=NM_A_MM * APART_MM)
    assert not train.tail(91_000), "latched, though it fits again"
    train.head(299_000)
    assert train.system.caught
    assert train.system.since == 2
    train.step("restart")
    train.head(300_000)
    assert not train.tail(300_000), "nor does a restart mend it"
    train.step("preset", preset_mm=APART_MM)
    train.head(500_000)
    assert not train.healthy
    assert train.tail(500_000)


def a_stretched_train() -> None:
    """A tail that falls back is found as well, once it is beyond what the errors hide."""
    train = Train()
    train.head(0)
    train.step("come_apart", apart_nm=NM_A_MM * (APART_MM + 1_013))
    assert train.tail(0), "within the tolerance"
    for apart_mm in (APART_MM + 1_014, APART_MM - 1_014):
        train = Train()
        train.head(0)
        train.step("come_apart", apart_nm=NM_A_MM * apart_mm)
        assert not train.tail(0)
        assert train.system.spacing.broken
    train = Train()
    train.head(0, behind_mm=2_000)
    train.step("come_apart", apart_nm=NM_A_MM * (APART_MM + 1_013 + 513 + 4_001))
    assert not train.tail(0, behind_mm=2_000)
    assert train.system.caught


def the_tail_came_first() -> None:
    """With the antennas miswired, the head reads a tag that the tail has read before: latched."""
    train = Train()
    train.step("come_apart", apart_nm=NM_A_MM * -APART_MM)
    train.step("run", to_nm=front_nm(-120_000))
    assert not train.tail(0)
    assert not train.system.spacing.broken, "there was nothing to hold it against"
    train.head(0)
    assert train.system.caught
    assert train.system.spacing.broken


def nothing_to_hold_it_against() -> None:
    """A tag that the head has not read, or a place not known, makes the line not healthy until the next check."""
    for at in (UNKNOWN, Way(False, 0, 10**6), Way(True, GREATEST_MM + 1, GREATEST_MM + 1)):
        train = Train()
        train.head(0)
        train.head(1_000)
        assert train.tail(0)
        if at.known:
            train.step("tail_reads", uid=1_000, at=at)
            assert train.healthy, "no odometer says so"
        else:
            assert not train.tail(1_000, at=at)
            assert not train.system.spacing.broken
            assert train.tail(1_000)
    train = Train()
    train.head(0)
    assert train.tail(0)
    assert not train.tail(30_000)
    train = Train()
    train.head(0, at=UNKNOWN)
    assert not train.tail(0)
    assert not train.system.spacing.broken


def a_way_known_badly() -> None:
    """A way as wide as is written is compared; by a wider one a false tail is not found, and does not count (T13)."""
    train = Train()
    train.head(0, behind_mm=1_000, ahead_mm=1_000)
    assert train.tail(0, behind_mm=2_000)
    for apart_mm in (APART_MM, 60_000):
        train = Train()
        train.head(0, behind_mm=1_000, ahead_mm=1_000)
        train.step("come_apart", apart_nm=NM_A_MM * apart_mm)
        assert not train.tail(0, behind_mm=1_000, ahead_mm=1_001)
        assert not train.system.spacing.broken
        assert not train.system.caught
        assert train.tail(0) == (apart_mm == APART_MM)


def a_ninth_tag_pushes_out_the_first() -> None:
    """A false tail is found by a tag that is among the head's last eight, and by an older one not; nor does it count.

    Two tags that the head reads in turn are as many reads.
    """
    for others, found in ((7, True), (8, False)):
        train = Train(tag=-199_000)
        train.head(-199_000)
        for number in range(others):
            train.head(-198_000 + 1_000 * number)
        train.step("come_apart", apart_nm=NM_A_MM * 60_000)
        assert not train.tail(-199_000)
        assert train.system.spacing.broken == found
        assert train.system.caught == found


def a_place_beyond_the_range() -> None:
    """A range that cannot be is none."""
    limits = SITE.limits
    far = GREATEST_MM + 1
    for then, now in (
        (Way(True, far - APART_MM, far - APART_MM), Way(True, far, far)),
        (Way(True, -far, -far), Way(True, -far + APART_MM, -far + APART_MM)),
        (Way(True, 5, 4), Way(True, APART_MM, APART_MM)),
        (Way(True, 0, 0), Way(True, APART_MM + 1, APART_MM)),
    ):
        spacing = machine.note_tail_read(limits, machine.note_head_read(machine.preset(APART_MM), 7, then), 7, now)
        assert not machine.is_healthy(spacing)
        assert not spacing.broken


def a_train_that_stands_on_a_tag() -> None:
    """The head reads the same tag again and again: that is one read, and pushes out none."""
    train = Train()
    train.head(0)
    for _ in range(9):
        train.head(1_000)
    assert train.tail(0)


def a_train_turns() -> None:
    """After a change of ends nothing counts until the tags are read anew; the distance stays as preset (T3)."""
    train = Train()
    train.head(0)
    assert train.tail(0)
    before = train.system
    train.step("turn", front_nm=front_nm(0))
    preset = replace(JUST_STARTED, spacing=machine.preset(APART_MM), is_preset=True, whole=True, forward=True)
    assert train.system == replace(preset, front_nm=front_nm(0), tail_nm=before.tail_nm)
    assert not train.tail(0), "what the head read before the change counts no more"
    train.head(30_000 + APART_MM)
    assert train.tail(30_000 + APART_MM)


def a_false_tail_stays_one_when_the_train_turns() -> None:
    """What was found of the antennas is put right by staff alone (T3, T13)."""
    train = Train()
    train.head(0)
    train.step("come_apart", apart_nm=NM_A_MM * (APART_MM - 100_000))
    assert not train.tail(0)
    assert train.system.caught
    train.step("turn", front_nm=front_nm(0))
    assert train.system.caught
    train.step("come_apart", apart_nm=NM_A_MM * APART_MM)
    train.head(30_000)
    assert not train.tail(30_000)
    train.step("preset", preset_mm=APART_MM)
    train.head(300_000)
    assert train.tail(300_000)


def a_train_that_rolls_back_may_be_accused() -> None:
    """Its head comes by a tag that its tail read, and could not compare; it is on the safe side, and no more (T13)."""
    train = Train()
    train.head(0)
    assert not train.tail(0, at=UNKNOWN)
    train.head(0)
    assert train.system.whole
    assert not train.system.forward
    assert train.system.spacing.broken


def on_a_loop_the_head_comes_round_to_what_its_tail_has_read() -> None:
    """What the tail held against the head's first read of it accuses nobody at the second, lap after lap (T13)."""
    spacing = machine.preset(420_000)
    boundaries = (0, 6_000, 200_000, 206_000, 400_000, 406_000)
    reads = [(600_000 * lap + at + off, off, at) for lap in range(4) for at in boundaries for off in (0, 420_000)]
    for front_mm, off_mm, uid in sorted(reads):
        at = Way(True, front_mm - 50, front_mm + 50)
        if off_mm == 0:
            spacing = machine.note_head_read(spacing, uid, at)
        else:
            spacing = machine.note_tail_read(SITE.limits, spacing, uid, at)
            assert machine.is_healthy(spacing)
        assert not spacing.broken


def history_begins_anew_with_the_train() -> None:
    """After a restart or a preset, whatever tags were read before, and however many (T3, T8)."""
    train = Train()
    for tag in TAGS:
        train.head(tag)
    assert train.system.since == len(TAGS) - 1
    assert train.system.head_newest == TAGS[-1]
    before = train.system
    begun = replace(JUST_STARTED, forward=True, front_nm=front_nm(TAGS[-1]))
    assert train.step("restart") == begun
    train.system = before
    preset = replace(begun, spacing=machine.preset(APART_MM), is_preset=True, whole=True, forward=True)
    assert train.step("preset", preset_mm=APART_MM) == preset


def what_nature_does_not_do() -> None:
    """No tag is read outside the window, no range leaves the train out, no preset is far off."""
    train = Train()
    before = train.system
    train.step("head_reads", uid=0, at=UNKNOWN)
    train.step("tail_reads", uid=0, at=UNKNOWN)
    train.step("head_reads", uid=-200_000, at=Way(True, -195_999, 4_000))
    train.step("head_reads", uid=-50_000, at=Way(True, -197_000, -196_001))
    train.step("tail_reads", uid=-320_000, at=Way(True, -195_999, 4_000))
    train.step("preset", preset_mm=APART_MM + 501)
    assert train.system == before
    train.step("come_apart", apart_nm=NM_A_MM * 512)
    before = train.system
    train.step("preset", preset_mm=512)
    assert train.system == before, "the antennas lie farther apart than a window"


WITNESSES = (
    a_whole_train_over_eight_tags,
    the_worst_of_all_errors,
    a_cab_poses_as_the_tail,
    a_stretched_train,
    the_tail_came_first,
    nothing_to_hold_it_against,
    a_way_known_badly,
    a_ninth_tag_pushes_out_the_first,
    a_place_beyond_the_range,
    a_train_that_stands_on_a_tag,
    a_train_turns,
    a_false_tail_stays_one_when_the_train_turns,
    a_train_that_rolls_back_may_be_accused,
    on_a_loop_the_head_comes_round_to_what_its_tail_has_read,
    history_begins_anew_with_the_train,
    what_nature_does_not_do,
)
