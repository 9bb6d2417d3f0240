"""A train in contact before a crossing, and its rangings: what the witnesses of ``arrival`` play with (X1, X2)."""

from __future__ import annotations

from kernel.crossing.arrival import UM_A_MM, ArrivalBounds, Followed, Ranging
from models.crossing.arrival import Brought, Coming, Crossing, LetGo, Taken
from proofs.crossing.arrival import THEORY
from proofs.onboard.witnesses.play import Play

BOUNDS = ArrivalBounds(
    line_um=3_000_000,
    gain_um=10_000,
    cycle_ms=100,
    warning_cycles=350,
    silence_cycles=20,
    way_spread_mm=1,
    speed_spread_mm_s=1,
)
"""30 m/s, 1 m/s², a cycle of 100 ms, 35 s of warning, and rangings that count for 2 s and err by rounding alone."""
SITE = Crossing(BOUNDS)
LINE_UM = BOUNDS.line_um
NOTHING = Ranging(valid=False, way_mm=0, speed_mm_s=0, age_cycles=0)


def contacted(way_mm: int = 2_000_000, speed_mm_s: int = 20_000) -> Coming:
    """A train that has just been ranged, exactly."""
    way_um, pace_um = UM_A_MM * way_mm, BOUNDS.cycle_ms * speed_mm_s
    known = Followed(way_um, LINE_UM - max(0, pace_um), LINE_UM, 0, way_mm, max(0, speed_mm_s), False)
    return Coming(
        way_um=way_um,
        pace_um=pace_um,
        ceiling_um=LINE_UM,
        ranged=Taken(way_um, pace_um, 0),
        arrived=False,
        decided=False,
        told=Ranging(True, way_mm, speed_mm_s, 0),
        brought=Brought(way_mm, max(0, speed_mm_s)),
        contradicted=False,
        worst=known,
        left_cycles=BOUNDS.warning_cycles + 1,
        silent_cycles=0,
        warned_cycles=0,
        followed=known,
        let_go=LetGo(False, 0, 0),
    )


class Train(Play[Crossing, Coming]):
    """A train in contact; ranged exactly and at once in each cycle, if not told otherwise."""

    def __init__(self, system: Coming | None = None) -> None:
        """Begin."""
        super().__init__(THEORY, SITE, contacted() if system is None else system)

    def promise(self, ceiling_um: int) -> None:
        """Promise a ceiling, which the crossing hears."""
        self.step("keep_to", ceiling_um=ceiling_um)
        self.step("take_ceiling", ceiling_um=ceiling_um)
        assert self.system.ceiling_um == self.system.followed.ceiling_um == ceiling_um

    def range(self) -> None:
        """Take a ranging."""
        self.step("take_ranging")
        assert self.system.ranged == Taken(self.system.way_um, self.system.pace_um, 0)

    def ranging(self) -> Ranging:
        """What the ranging under way says: exact but for rounding to the safe side."""
        ranged = self.system.ranged
        return Ranging(True, ranged.way_um // UM_A_MM, -(-ranged.pace_um // BOUNDS.cycle_ms), ranged.age_cycles)

    def decide(self, ranging: Ranging | None = None) -> None:
        """The crossing decides, by the ranging under way if not told otherwise."""
        self.step("decide", ranging=self.ranging() if ranging is None else ranging)
        assert self.system.decided

    def run(self, pace_um: int) -> None:
        """Come to a pace within a cycle, as far as can be."""
        before = self.system
        to_um = before.way_um - max(before.pace_um, pace_um)
        self.step("run_a_cycle", to_um=to_um, pace_um=pace_um)
        assert (self.system.way_um, self.system.pace_um, self.system.decided) == (to_um, pace_um, False)

    def cycle(self, pace_um: int, ranging: Ranging | None = None) -> None:
        """One ranging, one decision, one cycle."""
        if ranging is None:
            self.range()
        self.decide(ranging)
        self.run(pace_um)

    def faster(self) -> int:
        """The pace that it has after gaining all that it can."""
        return min(self.system.pace_um + BOUNDS.gain_um, self.system.ceiling_um)

    def warns(self) -> bool:
        """Whether it asks for the warning."""
        return self.system.followed.warns

    def to_the_crossing(self) -> int:
        """Run at its worst until it is there; give for how many cycles there was a warning before the last."""
        while self.system.way_um > 0:
            self.cycle(self.faster())
        self.step("arrive")
        assert self.system.arrived
        return self.system.warned_cycles - 1


def brought(way_mm: int, speed_mm_s: int) -> Train:
    """A train that was ranged in time, has come near, and has then that speed."""
    train = Train(contacted(1_060_000, 3_000))
    while train.system.way_um > UM_A_MM * way_mm:
        train.cycle(300_000)
        assert not train.warns()
    while train.system.pace_um < BOUNDS.cycle_ms * speed_mm_s:
        train.cycle(train.faster())
    train.cycle(BOUNDS.cycle_ms * speed_mm_s)
    return train
