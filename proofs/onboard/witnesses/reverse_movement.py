"""A train that starts on an ascent, rolls back a little, or goes on rolling back (T5, T12)."""

from __future__ import annotations

from kernel.onboard import reverse_movement as machine
from kernel.onboard.odometry import Readings
from kernel.onboard.reverse_movement import Movement, ReverseLimits
from models.onboard.reverse_movement import Rolling, Wheel
from models.onboard.units import NM_A_MM
from proofs.onboard.reverse_movement import THEORY
from proofs.onboard.witnesses.play import Play

LIMITS = ReverseLimits(roll_back_mm=2_000)
SITE = Wheel(limits=LIMITS, pulse_mm=30)
START_MM = 50_000
"""What the pulses are when the train has been located; its front is at the origin."""


class Train(Play[Wheel, Rolling]):
    """A train at rest; its wheel shows what is so, if not told otherwise."""

    def __init__(self) -> None:
        """Begin."""
        super().__init__(THEORY, SITE, Rolling(0, False, 0, START_MM, False, machine.LOCATED))

    def move(
        self,
        to_mm: int,
        *,
        way_mm: int | None = None,
        counts: bool = True,
        valid: bool = True,
        speed_mm_s: int = 0,
    ) -> bool:
        """Get to a place in a cycle; whether the watch has found reverse movement then."""
        shown_mm = START_MM + to_mm if way_mm is None else way_mm
        readings = Readings(100, valid, speed_mm_s, shown_mm, True, 0)
        self.step("run_a_cycle", readings=readings, to_nm=to_mm * NM_A_MM, counts=counts)
        assert self.system.front_nm == to_mm * NM_A_MM
        return self.system.movement.reversed

    def too_far_back(self) -> bool:
        """Whether it has rolled back beyond the limit, by as little as its wheel may show."""
        return self.system.rolled_back


def a_little_is_allowed() -> None:
    """To the millimetre, from the farthest place, wherever that was (T5)."""
    for farthest_mm in (0, 90_000):
        train = Train()
        for to_mm in (0, farthest_mm, farthest_mm - 500, farthest_mm, farthest_mm - 2_000):
            assert not train.move(to_mm)
        assert train.move(farthest_mm - 2_001)


def a_train_that_goes_on_rolling_back_is_found() -> None:
    """And it stays found when it runs forward again, until it is located anew (T5, T8)."""
    train = Train()
    train.move(0)
    for to_mm in range(-100, -2_100, -100):
        assert not train.move(to_mm)
    assert train.move(-2_100)
    assert not train.too_far_back()
    assert train.move(-2_200)
    assert train.too_far_back()
    assert train.move(90_000)
    train.step("locate_anew")
    assert train.system.movement == machine.LOCATED
    assert not train.move(0)
    assert not train.move(-2_000)


def a_wheel_off_by_a_twentieth_finds_it_all_the_same() -> None:
    """Creep, diameter and a pulse hide so much and no more: 2130 mm of 2000 (T5)."""
    train = Train()
    train.move(0)
    assert not train.move(-2_130, way_mm=START_MM - 2_000)
    assert not train.too_far_back()
    assert train.move(-2_132, way_mm=START_MM - 2_002)
    assert train.too_far_back()


def what_is_not_read_says_nothing() -> None:
    """An invalid reading, or one that no train gives, neither finds reverse movement nor moves the farthest (T5)."""
    train = Train()
    train.move(0)
    for what in ({"valid": False, "way_mm": 0}, {"way_mm": 10**12 + 1}, {"way_mm": 0, "speed_mm_s": -200_001}):
        assert not train.move(0, counts=False, **what)  # type: ignore[arg-type]
        assert train.system.movement == Movement(START_MM, False)


def after_a_slip_it_is_reckoned_from_there() -> None:
    """What a wheel that slid did not count is not known; what it counts from then on is (T5)."""
    train = Train()
    train.move(0)
    assert not train.move(-5_000, counts=False, way_mm=START_MM)
    assert not train.move(-5_000, way_mm=START_MM)
    assert train.system.furthest_nm == -5_000 * NM_A_MM
    assert train.move(-7_500, way_mm=START_MM - 2_500)
    assert train.too_far_back()


def a_train_is_watched_from_where_it_was_farthest() -> None:
    """Not from where its wheel began to count (T5)."""
    train = Train()
    for to_mm in (0, 50_000, 90_000, 89_000):
        train.move(to_mm)
    assert train.system.furthest_nm == 90_000 * NM_A_MM
    assert train.system.furthest_way_mm == START_MM + 90_000
    assert train.move(87_800)
    assert train.too_far_back()


def a_train_that_rolled_back_stays_noted() -> None:
    """When it runs forward again, until it is located anew (T5, T8)."""
    train = Train()
    train.move(0)
    train.move(-2_200)
    for to_mm in (-2_200, 0, 90_000):
        train.move(to_mm)
        assert train.too_far_back()
    train.step("locate_anew")
    assert not train.too_far_back()


def a_tachometer_that_does_not_tell_of_its_wheel_may_show_anything() -> None:
    """It may call itself invalid, or give more than a train can run; the train moves all the same (P1)."""
    train = Train()
    for to_mm in (0, 500, 200):
        train.move(to_mm)
    train.move(-700, counts=False, valid=False, way_mm=START_MM + 800)
    assert train.system.furthest_nm == -700 * NM_A_MM, "from where it was farthest before nothing is measured"
    assert train.system.furthest_way_mm == START_MM + 800
    train.move(900, counts=False, speed_mm_s=200_001)
    train.move(-1_200, counts=False, way_mm=-(10**12) - 1)


def a_wheel_that_counts_again_may_show_any_way() -> None:
    """What it slid is in its pulses, be it much or little: only from there on they measure (P1)."""
    for way_mm in (START_MM + 9_000, START_MM - 9_000):
        train = Train()
        train.move(0)
        train.move(-500, counts=False)
        train.move(-1_000, way_mm=way_mm)
        assert train.system.furthest_nm == -1_000 * NM_A_MM
        assert train.system.furthest_way_mm == way_mm


def what_nature_does_not_do_does_not_happen() -> None:
    """A wheel that counts, and is invalid, gross, or shows another way: such events are refused."""
    train = Train()
    train.move(0)
    before = train.system
    for valid, way_mm, speed_mm_s in (
        (False, START_MM - 1_000, 0),
        (True, START_MM - 1_000, 200_001),
        (True, START_MM - 1_000, -200_001),
        (True, 10**12 + 1, 0),
        (True, START_MM - 900, 0),
        (True, START_MM - 1_090, 0),
    ):
        readings = Readings(100, valid, speed_mm_s, way_mm, True, 0)
        event = {"readings": readings, "to_nm": -1_000 * NM_A_MM, "counts": True}
        assert train.step("run_a_cycle", **event) == before


WITNESSES = (
    a_little_is_allowed,
    a_train_that_goes_on_rolling_back_is_found,
    a_wheel_off_by_a_twentieth_finds_it_all_the_same,
    what_is_not_read_says_nothing,
    after_a_slip_it_is_reckoned_from_there,
    a_train_is_watched_from_where_it_was_farthest,
    a_train_that_rolled_back_stays_noted,
    a_tachometer_that_does_not_tell_of_its_wheel_may_show_anything,
    a_wheel_that_counts_again_may_show_any_way,
    what_nature_does_not_do_does_not_happen,
)
