"""A train that comes, passes and goes, seen through reports that are late, wrong or missing (A1, A3)."""

from __future__ import annotations

from kernel.alarm import distance as machine
from kernel.alarm.distance import (
    GREATEST_AGE_MS,
    GREATEST_PLACE_MM,
    NO_TRAIN_FIX,
    NO_WORKER_FIX,
    UM_A_MM,
    AlarmBounds,
    Direction,
    TrainFix,
    WorkerFix,
)
from models.alarm.alarm_distance import Line, Lookout, gap_um
from models.alarm.line import BOUNDS
from proofs.alarm.alarm_distance import THEORY
from proofs.onboard.witnesses.play import Play
from proofs.onboard.witnesses.sixty_four_bits import Checked, with_ints

DOWN, UP, UNKNOWN = Direction.DOWN, Direction.UP, Direction.UNKNOWN
SITE = Line(BOUNDS, below_mm=58_000, above_mm=2_000)
"""The antenna is at the front of a train that runs down."""
WORKER_MM = 5_000_000
OFF_MM = 60_000 + 20_000 + 15_000
"""Taken off with both fixes new: length and both errors."""
HUGE = 2**62


class Watch(Play[Line, Lookout]):
    """A worker who stands, and a train somewhere on the line."""

    def __init__(self, train_mm: int, site: Line = SITE, heading: Direction = DOWN) -> None:
        """Begin: nothing was told."""
        at_um = UM_A_MM * train_mm
        super().__init__(
            THEORY,
            site,
            Lookout(at_um, heading, UM_A_MM * WORKER_MM, NO_TRAIN_FIX, NO_TRAIN_FIX, NO_WORKER_FIX, 0, NO_TRAIN_FIX),
        )

    def run(self, elapsed_ms: int, heading: Direction, *, speed_mm_s: int = 27_000, walks_mm_s: int = 0) -> None:
        """Let time pass, the train running one way, or standing."""
        before, way = self.system, {DOWN: 1, UP: -1, UNKNOWN: 0}[heading]
        heading = before.heading if heading == UNKNOWN else heading
        to_um = before.antenna_um + way * speed_mm_s * elapsed_ms
        worker_to_um = before.worker_um + walks_mm_s * elapsed_ms
        self.step("run_on", elapsed_ms=elapsed_ms, to_um=to_um, heading=heading, worker_to_um=worker_to_um)
        assert (self.system.antenna_um, self.system.heading) == (to_um, heading)
        assert self.system.worker_um == worker_to_um

    def tell_train(
        self, age_ms: int = 0, heading: Direction = DOWN, *, off_mm: int = 0, ran_um: int = 0, running: bool = True
    ) -> TrainFix:
        """Bring a report of where the train was, some way before where it is, and by how much that is wrong."""
        at_um = self.system.antenna_um - ran_um
        fix = TrainFix(at_um // UM_A_MM + off_mm, age_ms, heading, running)
        self.step("take_train_fix", fix=fix, at_um=at_um)
        assert self.system.train == fix
        return fix

    def tell_worker(self, age_ms: int = 0, *, off_mm: int = 0) -> None:
        """Bring a fix of the worker."""
        at_um = self.system.worker_um
        fix = WorkerFix(at_um // UM_A_MM + off_mm, age_ms)
        self.step("take_worker_fix", fix=fix, at_um=at_um)
        assert self.system.worker == fix

    def nearest_um(self) -> int:
        """The least distance that the handset reckons."""
        return machine.nearest_um(BOUNDS, self.system.train, self.system.worker)

    def departs(self) -> bool:
        """Whether the train departs, as far as the handset knows."""
        return machine.is_departing(BOUNDS, self.system.train, self.system.worker)

    def within(self, limit_mm: int) -> bool:
        """Whether it may be that near."""
        return self.nearest_um() <= UM_A_MM * limit_mm and not self.departs()


def told(train_mm: int, heading: Direction = DOWN, running: bool = True) -> Watch:
    """Both fixes are new and right."""
    watch = Watch(train_mm, heading=UP if heading == UP else DOWN)
    watch.tell_worker()
    watch.tell_train(heading=heading, running=running)
    return watch


# ---- distance


def a_train_comes_passes_and_goes() -> None:
    """Reports each 2 s, 2 s old: it counts from 3000 m on until its rear is surely 100 m past (004, 3.3; A3)."""
    watch = Watch(WORKER_MM - 4_000_000)
    watch.tell_worker()
    seen: list[tuple[tuple[bool, bool, bool], int]] = []
    for _ in range(160):
        watch.run(1_000, DOWN)
        watch.tell_train(2_000, ran_um=2_000 * 27_000)
        watch.tell_worker(500)
        states = (watch.within(3_000_000), watch.within(1_500_000), watch.departs())
        if not seen or seen[-1][0] != states:
            seen.append((states, (watch.system.antenna_um // UM_A_MM - WORKER_MM) // 1_000))
    assert seen == [
        ((False, False, False), -3_973),
        ((True, False, False), -3_082),
        ((True, True, False), -1_570),
        ((False, False, True), 320),
    ]


def the_deductions_are_all_made() -> None:
    """Length, both errors, both ages: to the µm, on either side of the worker (A1)."""
    for side in (-1, 1):
        watch = told(WORKER_MM + side * 3_000_000)
        assert watch.nearest_um() == UM_A_MM * (3_000_000 - OFF_MM)
        watch.run(4_000, UNKNOWN)
        assert watch.nearest_um() == UM_A_MM * (3_000_000 - OFF_MM) - 4_000 * (27_000 + 2_000)
        watch.tell_worker(1_500)
        assert watch.nearest_um() == UM_A_MM * (3_000_000 - OFF_MM) - 4_000 * 27_000 - 1_500 * 2_000
        watch.tell_train(7_000, running=False)
        assert watch.nearest_um() == UM_A_MM * (3_000_000 - OFF_MM) - 7_000 * 27_000 - 1_500 * 2_000


def at_the_worst_the_train_is_as_near_as_reckoned() -> None:
    """Report wrong by its error, the train as fast as the line allows, the worker towards it, the antenna behind."""
    watch = Watch(WORKER_MM - 2_000_000, Line(BOUNDS, below_mm=0, above_mm=60_000))
    watch.tell_worker(off_mm=15_000)
    watch.tell_train(off_mm=-20_000)
    watch.run(10_000, DOWN, walks_mm_s=-2_000)
    assert watch.nearest_um() == gap_um(watch.site, watch.system.antenna_um, watch.system.worker_um)
    watch = Watch(WORKER_MM + 2_000_000, Line(BOUNDS, below_mm=60_000, above_mm=0), UP)
    watch.tell_worker(off_mm=-15_000)
    watch.tell_train(heading=UP, off_mm=20_000)
    watch.run(10_000, UP, walks_mm_s=2_000)
    assert watch.nearest_um() == gap_um(watch.site, watch.system.antenna_um, watch.system.worker_um)


def limits_are_included() -> None:
    """At 1500 m and 3000 m to the µm the train counts; one mm beyond it does not (A3)."""
    for limit_mm in (1_500_000, 3_000_000):
        watch = told(WORKER_MM - limit_mm - OFF_MM)
        assert watch.nearest_um() == UM_A_MM * limit_mm
        assert watch.within(limit_mm)
        assert not watch.within(limit_mm - 1)
        assert not told(WORKER_MM - limit_mm - OFF_MM - 1).within(limit_mm)


# ---- departing


def past_means_past_by_the_rear() -> None:
    """100 m to the mm, from the rear, on either side (004, 3.3; A3)."""
    way_mm = OFF_MM + 100_000
    for side, heading in ((1, DOWN), (-1, UP)):
        assert told(WORKER_MM + side * way_mm, heading).departs()
        assert not told(WORKER_MM + side * way_mm, heading).within(1_500_000)
        assert not told(WORKER_MM + side * (way_mm - 1), heading).departs()
        assert told(WORKER_MM + side * (way_mm - 1), heading).within(1_500_000)


def what_comes_stands_or_is_unknown_does_not_depart() -> None:
    """Only a known direction away, of a train that runs (A3)."""
    for side, back in ((1, UP), (-1, DOWN)):
        at_mm = WORKER_MM + side * 1_000_000
        for watch in (told(at_mm, back), told(at_mm, UNKNOWN)):
            assert not watch.departs()
            assert watch.within(1_500_000)
        assert not told(at_mm, DOWN if side == 1 else UP, running=False).departs()


def a_direction_counts_until_the_train_can_have_turned() -> None:
    """30 s here; then it approaches again, until the next report (A3)."""
    watch = told(WORKER_MM + 1_100_000)
    watch.run(30_000, DOWN, speed_mm_s=10_000)
    assert watch.departs()
    watch.run(1, UNKNOWN)
    assert not watch.departs()
    watch.run(40_000, UP)
    assert watch.within(1_500_000)
    watch.tell_train(heading=UP)
    assert watch.within(1_500_000)


# ---- no fix


def what_is_no_fix_is_at_the_worker() -> None:
    """Before the first report, and after one out of its ranges; the edges are fixes (A1, A8)."""
    watch = Watch(WORKER_MM - 9_000_000)
    assert watch.within(0)
    watch.tell_train()
    assert watch.within(0)
    watch = Watch(WORKER_MM - 9_000_000)
    watch.tell_worker()
    assert watch.within(0)
    watch.tell_train()
    assert not watch.within(3_000_000)
    good = watch.system.train
    watch.run(1, DOWN)
    edge = GREATEST_PLACE_MM
    for place_mm, age_ms in ((edge + 1, 0), (-edge - 1, 0), (0, -1), (0, GREATEST_AGE_MS + 1), (HUGE, -HUGE)):
        fix = TrainFix(place_mm, age_ms, UP, True)
        watch.step("take_train_fix", fix=fix, at_um=0)
        assert watch.system.train == fix
        assert watch.nearest_um() == 0
        assert watch.within(0)
        watch.step("take_worker_fix", fix=WorkerFix(place_mm, age_ms), at_um=0)
        assert watch.system.worker == WorkerFix(place_mm, age_ms)
        assert machine.nearest_um(BOUNDS, good, watch.system.worker) == 0
        watch.tell_worker()
    for place_mm, age_ms in ((edge, 0), (-edge, 0), (0, GREATEST_AGE_MS)):
        assert machine.is_fix(place_mm, age_ms)


def a_clock_that_goes_back_or_leaps_takes_the_fixes_away() -> None:
    """What is not an elapsed time to an hour makes every age too great; an hour is one (A1, A8)."""
    fix, own = TrainFix(0, 5, DOWN, True), WorkerFix(0, 5)
    for elapsed_ms in (-1, GREATEST_AGE_MS + 1, HUGE, -HUGE):
        assert machine.older_train(fix, elapsed_ms) == TrainFix(0, GREATEST_AGE_MS + 1, DOWN, True)
        assert machine.older_worker(own, elapsed_ms) == WorkerFix(0, GREATEST_AGE_MS + 1)
    assert machine.older_train(fix, GREATEST_AGE_MS).age_ms == GREATEST_AGE_MS + 5
    assert machine.older_train(fix, 0) == fix
    for age_ms in (-1, GREATEST_AGE_MS + 1, HUGE, -HUGE):
        assert machine.older_ms(age_ms, 0) == GREATEST_AGE_MS + 1
    assert machine.older_ms(GREATEST_AGE_MS, 0) == GREATEST_AGE_MS
    watch = told(WORKER_MM - 9_000_000)
    still = watch.system
    watch.site = Line(AlarmBounds(0, 0, 60_000, 20_000, 15_000, 30_000), 0, 0)
    watch.step("run_on", elapsed_ms=-1, to_um=still.antenna_um, heading=DOWN, worker_to_um=still.worker_um)
    assert watch.system.train.age_ms == watch.system.worker.age_ms == GREATEST_AGE_MS + 1 == 3_600_001


def every_number_fits_into_64_bits() -> None:
    """Whatever is told; bounds to 200 m/s, 1000 km (A1)."""
    bounds = with_ints(Checked, AlarmBounds(200_000, 200_000, 10**9, 10**9, 10**9, GREATEST_AGE_MS))
    for place_mm in (-HUGE, -GREATEST_PLACE_MM, 0, GREATEST_PLACE_MM, HUGE):
        for age_ms in (-HUGE, 0, GREATEST_AGE_MS, HUGE):
            for elapsed_ms in (-HUGE, 0, GREATEST_AGE_MS, HUGE):
                train = TrainFix(Checked(place_mm), Checked(age_ms), DOWN, True)
                worker = WorkerFix(Checked(-place_mm), Checked(age_ms))
                assert machine.is_departing(bounds, train, worker) is not None
                older = machine.older_train(train, Checked(elapsed_ms))
                assert (
                    machine.nearest_um(bounds, older, machine.older_worker(worker, Checked(elapsed_ms))) <= 2 * 10**12
                )


# ---- nature


def what_nature_does_not_do_does_not_happen() -> None:
    """Too fast, too wrong, turned too soon: such events are refused."""
    watch = told(WORKER_MM + 1_000_000)
    before = watch.system
    here_um = before.antenna_um
    run = {"elapsed_ms": 1_000, "to_um": here_um, "heading": DOWN, "worker_to_um": before.worker_um}
    for what in (
        {"to_um": here_um + 27_000_001},
        {"to_um": here_um - 27_000_001},
        {"worker_to_um": before.worker_um + 2_000_001},
        {"worker_to_um": before.worker_um - 2_000_001},
        {"heading": UP},
    ):
        assert watch.step("run_on", **{**run, **what}) == before
    place_mm = here_um // UM_A_MM
    fix = TrainFix(place_mm, 1_000, UNKNOWN, False)
    for bad, at_um in (
        (fix, here_um + 20_000_001),
        (fix, here_um - 20_000_001),
        (TrainFix(place_mm + 27_001, 1_000, UNKNOWN, False), here_um + 27_001_000),
        (TrainFix(place_mm, 0, UP, True), here_um),
    ):
        assert watch.step("take_train_fix", fix=bad, at_um=at_um) == before
    worker_mm = before.worker_um // UM_A_MM
    for own, at_um in (
        (WorkerFix(worker_mm, 0), before.worker_um + 1),
        (WorkerFix(worker_mm + 15_001, 0), before.worker_um),
        (WorkerFix(worker_mm - 15_001, 0), before.worker_um),
    ):
        assert watch.step("take_worker_fix", fix=own, at_um=at_um) == before
    watch = told(WORKER_MM + 1_000_000)
    watch.run(1_000, DOWN)
    before = watch.system
    for age_ms, taken in ((0, False), (30_000, False), (30_001, True)):
        fix = TrainFix(place_mm + 27_000, age_ms, UP, True)
        assert (watch.step("take_train_fix", fix=fix, at_um=before.antenna_um) != before) == taken
    watch.tell_train(heading=UP, running=False)
    before = watch.system
    here_um, own_um = before.antenna_um, before.worker_um
    for to_um, heading in ((here_um - 1, DOWN), (here_um + 1, UP)):
        assert watch.step("run_on", elapsed_ms=1, to_um=to_um, heading=heading, worker_to_um=own_um) == before
    watch.run(1, UP)
    watch.run(1, DOWN)


def what_is_no_report_never_becomes_one() -> None:
    """Not by growing old, as one of a time that is still to come would (A1)."""
    watch = Watch(WORKER_MM)
    fix = TrainFix(0, -10_000, DOWN, is_running=True)
    watch.step("take_train_fix", fix=fix, at_um=watch.system.antenna_um)
    watch.run(20_000, UP)
    assert watch.system.told == fix


def a_receiver_that_hangs_makes_no_new_fix() -> None:
    """Its place grows old, running or not, until it is none; the first place that is another is new (A1)."""
    day = Watch(1_000_000)
    day.step("receive", place_mm=1_000_001, direction=DOWN, is_running=True)
    for place_mm, running in ((1_000_000, True), (1_000_000, True), (1_000_000, False)):
        day.step("receive", place_mm=place_mm, direction=DOWN, is_running=running)
        age_ms = (day.system.antenna_um - UM_A_MM * 1_000_000) // 27_000
        assert day.system.unit == TrainFix(place_mm, age_ms, DOWN, running)
        day.run(1_000, DOWN)
    here_mm = day.system.antenna_um // UM_A_MM
    day.step("receive", place_mm=here_mm, direction=UP, is_running=False)
    assert day.system.unit == TrainFix(here_mm, 0, UP, is_running=False)
    before = day.system
    for off_mm in (-20_001, 20_001):
        assert day.step("receive", place_mm=here_mm + off_mm, direction=DOWN, is_running=True) == before
    day.run(GREATEST_AGE_MS + 1, UNKNOWN)
    day.step("receive", place_mm=here_mm, direction=DOWN, is_running=True)
    assert day.system.unit == TrainFix(here_mm, GREATEST_AGE_MS + 1, DOWN, is_running=True)
    for off_mm in (-20_000, 20_000):
        day.step("receive", place_mm=here_mm + off_mm, direction=DOWN, is_running=True)
        assert day.system.unit.age_ms == 0


def a_receiver_that_hangs_makes_none_through_a_start() -> None:
    """After each start its place is none, however often it is told; the first that is another counts at once (A1)."""
    day = Watch(1_000_000)
    day.step("receive", place_mm=1_000_000, direction=DOWN, is_running=True)
    day.step("receive", place_mm=1_000_001, direction=DOWN, is_running=True)
    assert day.system.unit == TrainFix(1_000_001, 0, DOWN, is_running=True)
    for _ in range(3):
        day.run(9_000, DOWN)
        day.step("restart")
        assert day.system.unit == NO_TRAIN_FIX
        for _ in range(2):
            day.step("receive", place_mm=1_000_001, direction=DOWN, is_running=True)
            assert day.system.unit == TrainFix(1_000_001, GREATEST_AGE_MS + 1, DOWN, is_running=True)
            day.run(1_000, DOWN)
    here_mm = day.system.antenna_um // UM_A_MM
    day.step("receive", place_mm=here_mm, direction=DOWN, is_running=True)
    assert day.system.unit == TrainFix(here_mm, 0, DOWN, is_running=True)
    assert not machine.is_fix(NO_TRAIN_FIX.place_mm, 0)
    assert not machine.is_fix(0, NO_TRAIN_FIX.age_ms)
    for edge_mm in (-GREATEST_PLACE_MM, GREATEST_PLACE_MM):
        assert machine.fix_of_the_unit(TrainFix(edge_mm, 5, DOWN, is_running=True), day.system.unit) == day.system.unit


WITNESSES = (
    a_receiver_that_hangs_makes_no_new_fix,
    a_receiver_that_hangs_makes_none_through_a_start,
    what_is_no_report_never_becomes_one,
    a_train_comes_passes_and_goes,
    the_deductions_are_all_made,
    at_the_worst_the_train_is_as_near_as_reckoned,
    limits_are_included,
    past_means_past_by_the_rear,
    what_comes_stands_or_is_unknown_does_not_depart,
    a_direction_counts_until_the_train_can_have_turned,
    what_is_no_fix_is_at_the_worker,
    a_clock_that_goes_back_or_leaps_takes_the_fixes_away,
    every_number_fits_into_64_bits,
    what_nature_does_not_do_does_not_happen,
)
