"""A train that passes a tag within a cycle: gaining, braking, rolling back, and with its range lost (T2, P7)."""

from __future__ import annotations

from dataclasses import replace

from kernel.onboard import odometry
from kernel.onboard import tag_fix as machine
from kernel.onboard.odometry import Loss, Motion
from kernel.onboard.tag_fix import Fix, TagLimits
from kernel.onboard.way import Way
from models.onboard.tag_fix import Antenna, Passing
from models.onboard.units import NM_A_MM, UM_A_MM
from proofs.onboard.tag_fix import THEORY
from proofs.onboard.witnesses.play import Play

LIMITS = TagLimits(antenna_mm=2_000, error_mm=300)
SITE = Antenna(LIMITS, laid_within_mm=43, read_within_mm=257)
NOTHING = Passing(False, 0, 0, Way(False, 0, 0), Fix(0, 0))
LISTED_MM = 500_000
FRONT_MM = LISTED_MM + LIMITS.antenna_mm
"""Where the front is while the antenna is over the tag."""


def motion(least_mm: int, most_mm: int, slowest_mm_s: int, fastest_mm_s: int, loss: Loss = Loss.NONE) -> Motion:
    """What the odometry knows at one end of the cycle."""
    begun = odometry.located(least_mm, most_mm, 0)
    return replace(begun, speed_least_mm_s=slowest_mm_s, speed_most_mm_s=fastest_mm_s, loss=loss)


class Reads(Play[Antenna, Passing]):
    """A train that reads the tag, first as fast as it was and then as fast as it is."""

    def __init__(self) -> None:
        """Begin."""
        super().__init__(THEORY, SITE, NOTHING)

    def read(
        self,
        from_mm_s: int,
        to_mm_s: int,
        ran_um: int,
        *,
        off_um: int = 0,
        laid_um: int = 0,
        before: Loss = Loss.NONE,
        after: Loss = Loss.NONE,
    ) -> Passing:
        """Read it, and run so far until the cycle ends; the front is known to a metre, the speed exactly."""
        lies_um = UM_A_MM * LISTED_MM + laid_um
        read_at_um = lies_um + UM_A_MM * LIMITS.antenna_mm + off_um
        front_um = read_at_um + ran_um
        here_mm = front_um // UM_A_MM
        self.step(
            "read_a_tag",
            before=motion(here_mm - 9_000, here_mm + 9_000, from_mm_s, from_mm_s, before),
            after=motion(here_mm - 1_000, here_mm + 1_000, to_mm_s, to_mm_s, after),
            from_nm=1_000 * read_at_um,
            from_um_s=UM_A_MM * from_mm_s,
            read_at_nm=1_000 * read_at_um,
            front_nm=1_000 * front_um,
            to_um_s=UM_A_MM * to_mm_s,
            place_mm=LISTED_MM,
            lies_nm=1_000 * lies_um,
        )
        return self.system


def a_tag_passed_at_speed_was_read_up_to_a_cycle_ago() -> None:
    """At 20 m/s the front may have got 2.04 m on since, in a cycle of 102 ms (T2, P7)."""
    for ran_um in (0, 2_040_000):
        read = Reads().read(20_000, 20_000, ran_um)
        assert read.front_nm == (FRONT_MM * UM_A_MM + ran_um) * 1_000
        assert read.fix == Fix(FRONT_MM - 300, FRONT_MM + 300 + 2_040)
        here_mm = read.front_nm // NM_A_MM
        assert read.place == Way(True, here_mm - 1_000 - 2_040, here_mm + 1_000)


def the_greater_speed_of_the_cycle_counts() -> None:
    """A train that brakes was faster before, one that gains is faster after (P7)."""
    for from_mm_s, to_mm_s in ((20_000, 19_400), (19_400, 20_000)):
        assert Reads().read(from_mm_s, to_mm_s, 2_040_000).fix.most_mm == FRONT_MM + 300 + 2_040


def a_part_of_a_millimetre_counts_as_one() -> None:
    """Ways are rounded up, forward and back (P7)."""
    assert Reads().read(1, 1, 100).fix == Fix(FRONT_MM - 300, FRONT_MM + 300 + 1)
    assert Reads().read(-1, -1, -100).fix == Fix(FRONT_MM - 300 - 1, FRONT_MM + 300)


def a_train_that_rolls_back_was_farther_on() -> None:
    """By what it may have rolled since; and it did not run forward (T5, P7)."""
    for from_mm_s, to_mm_s in ((-500, -200), (-200, -500)):
        read = Reads().read(from_mm_s, to_mm_s, -51_000)
        assert read.fix == Fix(FRONT_MM - 300 - 51, FRONT_MM + 300)
        here_mm = read.front_nm // NM_A_MM
        assert read.place == Way(True, here_mm - 1_000, here_mm + 1_000 + 51)


def a_tag_may_be_read_as_the_cycle_ends() -> None:
    """Then the train has not moved since, however fast it runs or rolls back (P7)."""
    for speed_mm_s in (20_000, -500):
        assert Reads().read(speed_mm_s, speed_mm_s, 0).front_nm == NM_A_MM * FRONT_MM


def laying_and_read_window_are_both_in_the_error() -> None:
    """A tag that is laid too far on, and read as soon as it can be, or too near, and read as late (T1, T2)."""
    for way in (1, -1):
        read = Reads().read(0, 0, 0, laid_um=way * 43_000, off_um=way * 257_000)
        assert read.front_nm == NM_A_MM * (FRONT_MM + way * 300)
        assert read.fix == Fix(FRONT_MM - 300, FRONT_MM + 300)


def a_train_that_has_lost_its_range_says_nothing_of_a_read() -> None:
    """Neither where it lost it within the cycle, nor where it has been located anew in it (P7)."""
    for before, after in ((Loss.NONE, Loss.CONTRADICTED), (Loss.CYCLE_IRREGULAR, Loss.NONE)):
        read = Reads().read(20_000, 20_000, 0, before=before, after=after)
        assert read.read_at_nm == NM_A_MM * FRONT_MM
        assert not read.place.known
        assert not read.located


def of_a_lost_range_nothing_is_promised() -> None:
    """The train may be anywhere, as fast as it likes (P7)."""
    reads = Reads()
    lost = motion(0, 0, 0, 0, Loss.CONTRADICTED)
    far_nm = NM_A_MM * FRONT_MM
    event = {"before": lost, "after": lost, "from_nm": far_nm, "from_um_s": 1, "read_at_nm": far_nm}
    reads.step("read_a_tag", **event, front_nm=far_nm, to_um_s=1, place_mm=LISTED_MM, lies_nm=NM_A_MM * LISTED_MM)
    assert reads.system.read_at_nm == far_nm


def what_nature_does_not_do_does_not_happen() -> None:
    """No range without its train, no leap, no tag out of its place, no read out of the window (P1, T1, T2)."""
    for refused in (
        Reads().read(20_000, 20_000, 2_040_001),
        Reads().read(20_000, 20_000, -1),
        Reads().read(-500, -500, 1),
        Reads().read(-500, -500, -51_001),
        Reads().read(0, 0, 0, laid_um=43_001),
        Reads().read(0, 0, 0, laid_um=-43_001),
        Reads().read(0, 0, 0, off_um=257_001),
        Reads().read(0, 0, 0, off_um=-257_001),
    ):
        assert refused == NOTHING
    here, at_nm = motion(FRONT_MM, FRONT_MM, 0, 0), NM_A_MM * FRONT_MM
    stands = {"before": here, "after": here, "from_nm": at_nm, "from_um_s": 0, "read_at_nm": at_nm, "front_nm": at_nm}
    event = {**stands, "to_um_s": 0, "place_mm": LISTED_MM, "lies_nm": NM_A_MM * LISTED_MM}
    for wrong in (
        {"before": motion(FRONT_MM, FRONT_MM, 1, 1)},
        {"before": motion(FRONT_MM + 1, FRONT_MM + 1, 0, 0)},
        {"after": motion(FRONT_MM - 1, FRONT_MM - 1, 0, 0)},
        {"after": motion(FRONT_MM, FRONT_MM, -1, -1)},
    ):
        assert Reads().step("read_a_tag", **{**event, **wrong}) == NOTHING
    assert Reads().step("read_a_tag", **event) != NOTHING


def the_fastest_train_runs_twenty_metres_and_a_half_in_a_cycle() -> None:
    """Either way, to 20.4 m, also at the far end of the line (P7)."""
    fast = motion(10**9, 10**9, -200_000, 200_000)
    fix = machine.fix_of(LIMITS, fast, fast, 10**9)
    assert fix == Fix(10**9 + 1_700 - 20_400, 10**9 + 2_300 + 20_400)


WITNESSES = (
    a_tag_passed_at_speed_was_read_up_to_a_cycle_ago,
    the_greater_speed_of_the_cycle_counts,
    a_part_of_a_millimetre_counts_as_one,
    a_train_that_rolls_back_was_farther_on,
    a_tag_may_be_read_as_the_cycle_ends,
    laying_and_read_window_are_both_in_the_error,
    a_train_that_has_lost_its_range_says_nothing_of_a_read,
    of_a_lost_range_nothing_is_promised,
    what_nature_does_not_do_does_not_happen,
    the_fastest_train_runs_twenty_metres_and_a_half_in_a_cycle,
)
