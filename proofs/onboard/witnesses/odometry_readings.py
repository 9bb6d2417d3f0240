"""A train whose sensors fall silent or lie, that is told where it is, and whose clock goes wrong (P1, P7, T8)."""

from __future__ import annotations

from dataclasses import replace

from kernel.onboard import odometry as machine
from kernel.onboard.odometry import Loss, Readings
from models.onboard.units import NM_A_MM
from proofs.onboard.witnesses.rolling_stock import BOUNDS, Train, rolling

# ---- sensors that do not speak


def what_is_no_reading_of_the_tachometer_moves_nothing() -> None:
    """Invalid, out of range, or stuck: by inertia, and what was read before stays (P1)."""
    silent: tuple[dict[str, int | bool], ...] = (
        {"tachometer_valid": False},
        {"tachometer": 200_001},
        {"tachometer": -200_001},
        {"way_mm": 10**12 + 1},
        {"way_mm": -(10**12) - 1},
        {"tachometer": 20_000, "way_mm": 205_000, "sticks": True},
    )
    for what in silent:
        train = rolling(20_000)
        train.cycle(20_000, **what)  # type: ignore[arg-type]
        assert not train.trusted()
        assert train.motion.tachometer_mm_s == 20_000
        assert train.motion.way_mm == train.motion.anchor_way_mm == 205_000
        assert (train.motion.front_least_mm, train.motion.front_most_mm) == (301_934, 302_067)


def a_tachometer_that_jumps_does_not_speak() -> None:
    """Pulses go no farther in a cycle than at 200 m/s, either way; the next are compared with those (P1)."""
    for way_mm, speaks in ((225_000, True), (225_001, False), (185_000, True), (184_999, False)):
        train = rolling(20_000)
        readings = Readings(100, True, 20_000, way_mm, True, 0)
        assert machine.tachometer_speaks(BOUNDS, train.motion, readings) == speaks
        train.cycle(20_000, way_mm=way_mm, tachometer=20_000 if not speaks else 30_000, slips=speaks)
        assert not train.trusted()
        assert train.motion.way_mm == way_mm


def a_tachometer_that_repeats_itself_does_not_speak() -> None:
    """A speed without a pulse is that of one that is stuck; a standstill without a pulse is one (P1)."""
    train = rolling(20_000)
    for speed in range(19_990, 19_900, -10):
        train.cycle(speed, tachometer=20_000, way_mm=205_000, sticks=True)
        assert not train.trusted()
        assert train.motion.agreed_cycles == 0
    train = rolling()
    train.stand(3)
    assert train.trusted()


def a_slow_wheel_passes_cycles_without_a_pulse() -> None:
    """Up to a pulse a cycle; a millimetre a second faster it would have come (P1)."""
    motion = rolling(20_000).motion
    for sign in (1, -1):
        slow = replace(motion, tachometer_mm_s=sign * 300)
        for shown, speaks in ((300, True), (301, False)):
            readings = Readings(100, True, sign * shown, motion.way_mm, True, 0)
            assert machine.tachometer_speaks(BOUNDS, slow, readings) == speaks


def nothing_is_asked_of_a_wheel_that_is_not_heard_or_slips() -> None:
    """It may slip unseen while it is silent; and its pulses be too many, as long as it is heard to run away (P1)."""
    train = rolling(20_000)
    train.cycle(20_000, tachometer_valid=False, slips=True)
    assert train.system.slips
    train = Train()
    train.cycle(0, tachometer=2_000, way_mm=9_000, slips=True)
    assert train.motion.anchor_way_mm == 9_000


def a_silent_tachometer_does_not_agree() -> None:
    """Nor does a silent inertial sensor: the count begins anew (P1)."""
    for what in ({"tachometer_valid": False}, {"inertial_valid": False}, {"way_mm": 30_000}, {"inertial": 1_601}):
        train = Train()
        train.stand(9)
        train.cycle(0, **what)
        assert train.motion.agreed_cycles == 0


def the_edges_of_the_ranges_are_readings() -> None:
    """200 m/s and 10**12 mm either way are, and the same way as before at rest (P1)."""
    motion = rolling(20_000).motion
    for sign in (1, -1):
        far = replace(motion, way_mm=sign * 10**12)
        assert machine.tachometer_speaks(BOUNDS, far, Readings(100, True, 0, sign * 10**12, True, 0))
        near = replace(motion, way_mm=sign * (10**12 - 1))
        assert machine.tachometer_speaks(BOUNDS, near, Readings(100, True, sign * 200_000, sign * 10**12, True, 0))
        assert not machine.tachometer_speaks(BOUNDS, near, Readings(100, True, sign * 200_001, sign * 10**12, True, 0))
        assert not machine.tachometer_speaks(BOUNDS, near, Readings(100, True, 0, sign * (10**12 + 1), True, 0))
    assert machine.inertial_speaks(BOUNDS, Readings(100, True, 0, 0, True, 1_600))
    assert machine.inertial_speaks(BOUNDS, Readings(100, True, 0, 0, True, -2_200))
    assert not machine.inertial_speaks(BOUNDS, Readings(100, True, 0, 0, True, 1_601))
    assert not machine.inertial_speaks(BOUNDS, Readings(100, True, 0, 0, True, -2_201))


# ---- fixes


def a_fix_narrows_the_range_and_counting_begins_there() -> None:
    """Of each end the inner one counts; the way since is counted from the fix (P3, P7)."""
    train = rolling(20_000)
    train.run_on(500)
    at_mm = 1_300_000
    train.fix(at_mm - 100_000, at_mm + 2_000)
    assert (train.motion.front_least_mm, train.motion.front_most_mm) == (at_mm - 10_031, at_mm + 2_000)
    train.fix(at_mm - 3_000, at_mm + 100_000)
    assert (train.motion.front_least_mm, train.motion.front_most_mm) == (at_mm - 3_000, at_mm + 2_000)
    train.run_on(50)
    assert train.motion.front_least_mm == at_mm + 100_000 - 3_000 - 1_000 - 31
    assert train.motion.front_most_mm == at_mm + 100_000 + 2_000 + 1_000 + 31


def a_fix_that_touches_the_range_is_taken() -> None:
    """One millimetre in common is no contradiction, at either end (P7)."""
    motion = rolling(20_000).motion
    wide = replace(motion, front_least_mm=290_000, front_most_mm=310_000)
    assert machine.note_fix(wide, 310_000, 320_000).front_least_mm == 310_000
    assert machine.is_located(machine.note_fix(wide, 310_000, 320_000))
    assert machine.note_fix(wide, 280_000, 290_000).front_most_mm == 290_000
    assert machine.is_located(machine.note_fix(wide, 280_000, 290_000))


def a_fix_outside_the_range_loses_it_for_good() -> None:
    """Some sensor or tag is worse than its bound: nothing is claimed any more, whatever comes (P7; ours)."""
    motion = rolling(20_000).motion
    wide = replace(motion, front_least_mm=290_000, front_most_mm=310_000)
    for least_mm, most_mm in ((310_001, 320_000), (280_000, 289_999)):
        lost = machine.note_fix(wide, least_mm, most_mm)
        assert lost == replace(wide, loss=Loss.CONTRADICTED)
        assert not machine.is_located(lost)
        assert machine.note_fix(lost, 295_000, 305_000) == lost
        assert machine.note_cycle(BOUNDS, lost, Readings(100, True, 20_000, 207_000, True, 0)) == lost


# ---- the processor's clock


def an_irregular_cycle_loses_the_range_for_good() -> None:
    """Twice the time, none, less, backward, or huge: no range is claimed any more (P1, P7; ours)."""
    for elapsed_ms in (200, 103, 97, 0, -100, 2**62):
        train = rolling(20_000)
        before = train.motion
        train.cycle(20_000, elapsed_ms=elapsed_ms)
        lost = train.motion
        assert lost == replace(before, loss=Loss.CYCLE_IRREGULAR)
        assert not machine.is_located(lost)
        train.run_on(3)
        assert train.motion == lost
        train.step("take_fix", least_mm=0, most_mm=10**9)
        assert train.motion == lost


def a_lawful_cycle_keeps_the_range_and_the_wheel() -> None:
    """Two milliseconds of jitter either way: the wheel stays trusted, and the range is no wider for it (P1; ours).

    What the clock tells of a lawful cycle says no more: without a wheel the range grows as in any other.
    """
    train = rolling(20_000)
    for elapsed_ms in (98, 102, 99, 101, 100):
        train.cycle(20_000, elapsed_ms=elapsed_ms)
        assert machine.is_located(train.motion)
        assert train.motion.trusted
    braked = rolling(20_000)
    for elapsed_ms in (98, 102):
        train.cycle(20_000, inertial_valid=False, elapsed_ms=elapsed_ms)
        braked.cycle(20_000, inertial_valid=False)
        assert train.motion == braked.motion


def in_an_irregular_cycle_the_train_may_get_anywhere() -> None:
    """Which is why no range is claimed after it: one that lasted too long, or is told too short (P1)."""
    for elapsed_ms in (4_500, 97):
        train = rolling(20_000)
        far_nm = train.system.front_nm + 90_000 * NM_A_MM
        train.step(
            "run_a_cycle",
            readings=Readings(elapsed_ms, True, 20_000, 295_000, True, 0),
            to_nm=far_nm,
            speed_um_s=25_000_000,
            gradient_mm_s2=0,
            slips=True,
            sticks=False,
        )
        assert train.system.front_nm == far_nm
        assert train.motion.loss == Loss.CYCLE_IRREGULAR


def a_train_whose_range_is_lost_is_located_at_rest() -> None:
    """At a speed, or elsewhere than it is said to be, it is not; then it begins anew (P7, T8)."""
    train = rolling(100)
    train.cycle(100, elapsed_ms=200)
    at_mm = train.system.front_nm // NM_A_MM
    told = {"least_mm": at_mm - 2_000, "most_mm": at_mm + 2_000, "way_mm": 0}
    lost = train.system
    assert train.step("locate_anew", **told) == lost
    train.cycle(0)
    lost = train.system
    assert train.step("locate_anew", **{**told, "most_mm": at_mm - 1}) == lost
    train.step("locate_anew", **told)
    assert machine.is_located(train.motion)
    train.cycle(0)
    train.stand(10)
    assert train.trusted()


def a_fix_that_contradicts_the_range_loses_it() -> None:
    """A tag that was laid elsewhere: found where it lies outside the range, and the range is lost (P7)."""
    for off_mm in (200_000, -200_000):
        train = rolling(20_000)
        at_mm = train.system.front_nm // NM_A_MM
        train.step("take_fix", least_mm=at_mm + off_mm - 500, most_mm=at_mm + off_mm + 500)
        assert train.motion.loss == Loss.CONTRADICTED
        assert train.system.contradicted
        assert train.system.false_by_nm == 0


def a_false_fix_in_the_range_puts_it_off_by_as_much() -> None:
    """A tag a metre off is believed, as any other; the range is off by that, until a true one contradicts it (P7)."""
    for sign in (1, -1):
        train = rolling(20_000)
        train.run_on(500)
        at_mm = train.system.front_nm // NM_A_MM
        train.fix(*sorted((at_mm + sign * 1_000, at_mm + sign * 2_000)))
        assert (train.system.false_by_nm, train.system.contradicted) == (1_000 * NM_A_MM, False)
        off_mm = train.motion.front_least_mm - at_mm if sign > 0 else at_mm - train.motion.front_most_mm
        assert off_mm == 1_000
        train.fix(*sorted((at_mm + sign * 1_500, at_mm + sign * 1_400)))
        train.fix(*sorted((at_mm + sign * 1_000, at_mm + sign * 2_000)))
        assert train.system.false_by_nm == 1_400 * NM_A_MM
        train.run_on(1)
        assert train.system.false_by_nm == 1_400 * NM_A_MM
        train.step("take_fix", least_mm=at_mm + 2_000, most_mm=at_mm + 2_000)
        assert train.motion.loss == Loss.CONTRADICTED
        train.run_to(0)
        at_mm = train.system.front_nm // NM_A_MM
        train.step("locate_anew", least_mm=at_mm, most_mm=at_mm, way_mm=0)
        assert machine.is_located(train.motion)
        assert train.system.false_by_nm == 0


# ---- nature


def what_nature_does_not_do_does_not_happen() -> None:
    """Backward, too far, too fast, a sensor or wheel beyond its bound, a slip without a jolt."""
    train = rolling(20_000)
    before = train.system
    far_nm = before.front_nm + 2_000 * NM_A_MM
    good = Readings(100, True, 20_000, 207_000, True, 0)
    event = {"readings": good, "to_nm": far_nm, "speed_um_s": 20_000_000, "gradient_mm_s2": 0}
    event |= {"slips": False, "sticks": False}
    refused: tuple[dict[str, object], ...] = (
        {"to_nm": far_nm + 40 * NM_A_MM + 1},
        {"to_nm": far_nm - 40 * NM_A_MM - 1},
        {"speed_um_s": 20_000_000 + 122_401, "to_nm": far_nm + 100, "readings": replace(good, inertial_valid=False)},
        {"speed_um_s": 20_000_000 - 183_601, "to_nm": far_nm - 100, "readings": replace(good, inertial_valid=False)},
        {"readings": replace(good, inertial_mm_s2=51)},
        {"readings": replace(good, inertial_mm_s2=-51)},
        {"gradient_mm_s2": 351, "readings": replace(good, inertial_mm_s2=351)},
        {"gradient_mm_s2": -351, "readings": replace(good, inertial_mm_s2=-351)},
        {"readings": replace(good, tachometer_mm_s=20_300)},
        {"readings": replace(good, tachometer_mm_s=19_700)},
        {"readings": replace(good, way_mm=207_060)},
        {"readings": replace(good, way_mm=206_940)},
        {"slips": True, "readings": replace(good, tachometer_mm_s=20_115)},
        {"slips": True, "readings": replace(good, tachometer_mm_s=19_885)},
    )
    for what in refused:
        assert train.step("run_a_cycle", **{**event, **what}) == before
    for stuck in (good, replace(good, way_mm=205_000, tachometer_mm_s=19_999), replace(good, tachometer_mm_s=0)):
        assert train.step("run_a_cycle", **{**event, "sticks": True, "readings": stuck}) == before
    after = train.step("run_a_cycle", **{**event, "slips": True, "readings": replace(good, tachometer_mm_s=20_116)})
    assert after.slips
    assert not after.motion.trusted


def a_wheel_does_not_slip_for_long_at_the_trains_own_pace() -> None:
    """Ten cycles that agree at a speed the train may have are not slipped through (P1)."""
    train = Train()
    train.stand(9)
    before = train.system
    readings = Readings(100, True, 0, 5_000, True, 0)
    event = {"readings": readings, "to_nm": before.front_nm, "speed_um_s": 0, "gradient_mm_s2": 0}
    event |= {"sticks": False}
    assert train.step("run_a_cycle", **event, slips=True) == before
    assert train.step("run_a_cycle", **event, slips=False).motion.trusted


WITNESSES = (
    a_tachometer_that_jumps_does_not_speak,
    what_is_no_reading_of_the_tachometer_moves_nothing,
    a_tachometer_that_repeats_itself_does_not_speak,
    a_slow_wheel_passes_cycles_without_a_pulse,
    nothing_is_asked_of_a_wheel_that_is_not_heard_or_slips,
    a_silent_tachometer_does_not_agree,
    the_edges_of_the_ranges_are_readings,
    a_fix_narrows_the_range_and_counting_begins_there,
    a_fix_that_touches_the_range_is_taken,
    a_fix_outside_the_range_loses_it_for_good,
    an_irregular_cycle_loses_the_range_for_good,
    in_an_irregular_cycle_the_train_may_get_anywhere,
    a_train_whose_range_is_lost_is_located_at_rest,
    a_fix_that_contradicts_the_range_loses_it,
    a_false_fix_in_the_range_puts_it_off_by_as_much,
    what_nature_does_not_do_does_not_happen,
    a_wheel_does_not_slip_for_long_at_the_trains_own_pace,
)
