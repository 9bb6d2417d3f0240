"""A train in contact that answers are given of, and that does its worst after each (X2, X4)."""

from __future__ import annotations

from dataclasses import replace

from kernel.crossing.arrival import Followed, Ranging, are_lawful
from kernel.crossing.crossing import Settings, have_one_warning_time
from models.crossing.arrival import Brought
from models.crossing.due import Answered, Way
from proofs.crossing.due import THEORY
from proofs.crossing.witnesses.contact import BOUNDS, LINE_UM, NOTHING
from proofs.onboard.witnesses.play import Play

UNKNOWN = Followed(0, 0, LINE_UM, 21, 0, 0, False)
"""Of a train of which nothing is known."""
SITE = Way(BOUNDS, Settings(100, 350, 50, 100, 200, 60, 200, 20, 372))


class Train(Play[Way, Answered]):
    """A train somewhere; what is followed is what it does."""

    def __init__(self, way_mm: int, speed_mm_s: int) -> None:
        """Begin."""
        way_um = 1_000 * way_mm
        worst = Followed(way_um, 0, LINE_UM, 0, 0, 0, False)
        super().__init__(THEORY, SITE, Answered(way_um, 100 * speed_mm_s, LINE_UM, Brought(0, 0), UNKNOWN, worst, 0, 0))

    def ranging(self) -> Ranging:
        """A ranging, exact but for rounding to the safe side."""
        return Ranging(True, self.system.way_um // 1_000, -(-self.system.pace_um // 100), 0)

    def followed(self) -> Followed:
        """What is known by it."""
        told = self.ranging()
        towards_mm_s = max(0, told.speed_mm_s)
        ceiling_um = self.system.followed.ceiling_um
        short_um = ceiling_um - 100 * towards_mm_s
        return Followed(1_000 * told.way_mm, short_um, ceiling_um, 0, told.way_mm, towards_mm_s, False)

    def answer(self) -> int:
        """Give the answer's cycles."""
        self.step("take_ranging", ranging=self.ranging())
        return self.step("answer").left_cycles

    def run(self, pace_um: int) -> None:
        """Come to a pace within a cycle, as far as can be."""
        before = self.system
        to_um = before.way_um - max(before.pace_um, pace_um)
        run = self.step("run_a_cycle", to_um=to_um, pace_um=pace_um)
        assert (run.way_um, run.pace_um, run.left_cycles) == (to_um, pace_um, before.left_cycles - 1)

    def faster(self) -> int:
        """The pace after gaining all that it can."""
        return min(self.system.pace_um + BOUNDS.gain_um, self.system.ceiling_um)

    def to_the_crossing(self) -> int:
        """Run at its worst until it is there; give what is left then."""
        while self.system.way_um > 0:
            self.run(self.faster())
        return self.step("arrive").sooner_cycles


def an_answer_secures_what_it_says_to_the_cycle() -> None:
    """At the line's speed, gaining all the way, and coming to it on the way (X2, X4)."""
    for speed_mm_s, begins_mm, opens_mm in ((30_000, 1_056_000, 1_656_000), (0, 607_500, 1_207_500)):
        assert Train(begins_mm, speed_mm_s).answer() == 0
        for way_mm, cycles in ((begins_mm + 1, 352), (opens_mm, 352), (opens_mm + 1, 552)):
            train = Train(way_mm, speed_mm_s)
            assert train.answer() == cycles
            assert train.system.worst == train.followed()
            assert train.to_the_crossing() <= 0
    train = Train(1_656_001, 30_000)
    train.answer()
    assert train.to_the_crossing() == -1


def each_answer_takes_the_place_of_the_one_before() -> None:
    """Nearer, while the train slows; and now secures nothing, and takes nothing away (X2)."""
    train = Train(1_700_000, 30_000)
    assert train.answer() == 552
    for _ in range(30):
        train.run(train.system.pace_um)
    assert train.answer() == 352
    for _ in range(250):
        train.run(max(0, train.system.pace_um - 10_000))
    held = train.system
    assert held.left_cycles == 102
    assert train.answer() == 352
    assert train.system.worst == train.followed() != held.worst
    for _ in range(21):
        train.run(train.faster())
    held = train.system
    assert held.followed.age_cycles == 21
    train.step("take_ranging", ranging=NOTHING)
    assert train.step("answer") == replace(held, followed=replace(held.followed, warns=True))


def an_answer_that_is_not_held_leaves_the_one_before() -> None:
    """It is taken all the same; and what is no answer secures nothing (X2)."""
    train = Train(1_700_000, 30_000)
    assert train.answer() == 552
    train.run(2_000_000)
    let_go = train.step("take_ranging", ranging=train.ranging())
    assert (let_go.left_cycles, let_go.followed) == (551, train.followed())
    for way_mm, speed_mm_s, silent in ((1_000_000, 30_000, 0), (1_700_000, 30_000, 21)):
        train = Train(way_mm, speed_mm_s)
        train.step("take_ranging", ranging=train.ranging() if not silent else NOTHING)
        train.step("answer")
        assert (train.system.left_cycles, train.system.followed.warns) == (0, True)


def the_worst_gains_until_the_lines_speed() -> None:
    """As the train itself may (X2)."""
    train = Train(2_000_000, 29_950)
    train.answer()
    for short_um, way_um in ((0, 2_000_000_000 - 3_000_000), (0, 2_000_000_000 - 6_000_000)):
        train.run(train.faster())
        assert (train.system.worst.short_um, train.system.worst.way_um) == (short_um, way_um)
    slow = Train(2_000_000, 29_800)
    slow.answer()
    for short_um, way_um in ((10_000, 2_990_000), (0, 5_990_000), (0, 8_990_000)):
        slow.run(slow.faster())
        assert (slow.system.worst.short_um, slow.system.worst.way_um) == (short_um, 2_000_000_000 - way_um)


def with_its_ceiling_an_answer_secures_what_it_says() -> None:
    """At 20 m/s that it has promised not to exceed: two thirds of the way (X2, X4)."""
    for begins_mm, cycles in ((704_000, 0), (704_001, 352), (1_104_000, 352), (1_104_001, 552)):
        train = Train(begins_mm, 20_000)
        train.step("keep_to", ceiling_um=2_000_000)
        train.step("take_ceiling", ceiling_um=2_000_000)
        assert train.answer() == cycles
        if cycles:
            assert train.to_the_crossing() <= 0


def only_who_is_far_even_so_may_go_faster() -> None:
    """With the ask's own answer, which secures no less than any before; then it does its worst (X2, X4)."""
    for way_mm, acknowledged in ((1_608_501, True), (1_608_500, False)):
        train = Train(way_mm, 20_000)
        train.step("keep_to", ceiling_um=2_000_000)
        train.step("take_ceiling", ceiling_um=2_000_000)
        assert train.answer() == 552
        for asked_um in (1_999_999, LINE_UM + 1):
            held = train.system
            assert train.step("acknowledge", asked_um=asked_um) == held
        train.run(2_000_000)
        train.step("take_ranging", ranging=train.ranging())
        held = train.system
        raised = train.step("acknowledge", asked_um=LINE_UM)
        assert (raised != held) == acknowledged
        if acknowledged:
            assert (raised.left_cycles, raised.ceiling_um) == (552, LINE_UM)
            assert raised.worst == raised.followed == train.followed()
            assert raised.followed.short_um == 1_000_000
        assert train.to_the_crossing() <= 0


def a_restart_forgets_the_ceiling_and_the_train_keeps_it() -> None:
    """And after it the crossing reckons with the line's speed until the promise is heard anew (X3)."""
    train = Train(1_100_000, 20_000)
    train.step("keep_to", ceiling_um=2_000_000)
    train.step("take_ceiling", ceiling_um=2_000_000)
    assert train.answer() == 352
    assert train.step("restart").followed == UNKNOWN
    held = train.system
    assert train.step("run_a_cycle", to_um=held.way_um, pace_um=2_000_001) == held
    assert train.answer() == 352
    assert train.system.followed.ceiling_um == LINE_UM
    train.run(2_000_000)
    near = Train(1_050_000, 20_000)
    near.step("keep_to", ceiling_um=2_000_000)
    assert near.answer() == 352
    assert near.step("take_ceiling", ceiling_um=1_999_999).followed.ceiling_um == LINE_UM
    assert near.step("take_ceiling", ceiling_um=2_000_000).followed.ceiling_um == 2_000_000


def what_nature_does_not_do_does_not_happen() -> None:
    """Each of the assumptions refuses its event, at its edge and not within (X2)."""
    train = Train(2_000_000, 20_000)
    start = train.system
    assert train.step("arrive") == start
    for way_mm, speed_mm_s, age_cycles in ((2_000_001, 20_000, 0), (2_000_000, 19_999, 0), (2_006_001, 20_000, 2)):
        told = Ranging(True, way_mm, speed_mm_s, age_cycles)
        assert train.step("take_ranging", ranging=told) == start
    for way_mm, speed_mm_s, age_cycles in ((2_000_000, 20_000, 0), (2_006_000, 19_800, 2)):
        within = Train(2_000_000, 20_000)
        told = Ranging(True, way_mm, speed_mm_s, age_cycles)
        within.step("take_ranging", ranging=told)
        assert within.step("answer").left_cycles == 552
    for to_um, pace_um in ((1_997_989_999, 2_000_000), (1_997_989_999, 2_010_000), (2_000_000_000, 2_010_001)):
        assert train.step("run_a_cycle", to_um=to_um, pace_um=pace_um) == start
    train.step("run_a_cycle", to_um=1_997_990_000, pace_um=2_000_000)
    assert (train.system.way_um, train.system.pace_um) == (1_997_990_000, 2_000_000), (
        "faster on the way than at its end"
    )
    fast = Train(2_000_000, 30_000)
    for to_um, pace_um in ((fast.system.way_um, 3_000_001), (fast.system.way_um - 3_000_001, 3_000_000)):
        assert fast.step("run_a_cycle", to_um=to_um, pace_um=pace_um) == fast.system
    assert fast.system.pace_um == 3_000_000


def another_warning_time_or_cycle_is_refused() -> None:
    """20 s reckoned for a crossing that is set for 35 s, and a cycle of half the length: no ranging, no answer (X5)."""
    for name, value in (("warning_cycles", 200), ("warning_cycles", 351), ("cycle_ms", 50), ("cycle_ms", 101)):
        train = Train(1_700_000, 30_000)
        bounds = replace(BOUNDS, **{name: value})
        assert not have_one_warning_time(bounds, SITE.settings)
        train.site = replace(SITE, bounds=bounds)
        start = train.system
        assert train.step("take_ranging", ranging=train.ranging()) == start
        assert train.step("answer") == start
        assert train.step("acknowledge", asked_um=LINE_UM) == start
    assert have_one_warning_time(BOUNDS, SITE.settings)


def bounds_that_mean_nothing_are_refused() -> None:
    """Trains that do not move or gain, cycles of no time, a ranging that is never late enough to be lost (X2)."""
    assert are_lawful(replace(BOUNDS, line_um=1, gain_um=1, cycle_ms=1, warning_cycles=0, silence_cycles=1))
    for name, value in (("line_um", 0), ("gain_um", 0), ("cycle_ms", 0), ("warning_cycles", -1), ("silence_cycles", 0)):
        bounds = replace(BOUNDS, **{name: value})
        assert not are_lawful(bounds)
        set_alike = replace(SITE.settings, cycle_ms=bounds.cycle_ms, warning_cycles=bounds.warning_cycles)
        assert not have_one_warning_time(bounds, set_alike)


WITNESSES = (
    bounds_that_mean_nothing_are_refused,
    another_warning_time_or_cycle_is_refused,
    an_answer_secures_what_it_says_to_the_cycle,
    each_answer_takes_the_place_of_the_one_before,
    an_answer_that_is_not_held_leaves_the_one_before,
    the_worst_gains_until_the_lines_speed,
    with_its_ceiling_an_answer_secures_what_it_says,
    only_who_is_far_even_so_may_go_faster,
    a_restart_forgets_the_ceiling_and_the_train_keeps_it,
    what_nature_does_not_do_does_not_happen,
)
