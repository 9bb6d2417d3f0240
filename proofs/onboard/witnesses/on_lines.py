"""Attacks in millimetres, on every layout: a run given back too early, and one set ahead of it (T4, T9, T12)."""

from __future__ import annotations

import inspect
from collections.abc import Callable
from dataclasses import replace

from kernel import first_loop
from kernel.maps import Map
from kernel.names import Block, Route, Run, Serial, UnitLife
from kernel.onboard.braking import Brake
from models.onboard.joint import Survey
from proofs.onboard.witnesses.station import GIVEN_BACK, PERMITTED, RECALLED, Station, released
from proofs.witnesses.lines import LINES, Line, line_on
from proofs.witnesses.stations import A1, A2, B1, T1

BLOCK_MM = 100_000
"""How long every block is, since of the attacks none is about lengths; an interlocking table has none."""


class OnLine(Station):
    """A layout with its first train standing where the way out begins, lists of two runs in its kilometrage."""

    def __init__(self, line: Line) -> None:
        """Begin with nothing told."""
        home = frozenset({line.site.layout.start[line.out]})
        super().__init__(Survey(site=line.site), {A1: home, A2: home, B1: frozenset({line.elsewhere})})
        self.line = line
        self.out = Run(Serial(2), T1, UnitLife(0), line.out)
        self.ahead = Run(Serial(3), T1, UnitLife(0), line.on)
        self.end_mm = BLOCK_MM * len(line.blocks(line.out))
        self.farther_mm = self.end_mm + BLOCK_MM * (len(line.blocks(line.on)) - 1)

    def located(self, head_mm: int) -> None:
        """The head of the train is here, by its machines a metre farther at most."""
        block = self.line.blocks(self.line.out)[0]
        event = {"head_mm": head_mm, "block": block, "block_end_mm": BLOCK_MM, "front_most_mm": head_mm + 1_000}
        self.step("locate", train=T1, **event)

    def lists(self, run: Run, begins_mm: int) -> None:
        """The list of a run comes, for a train that will be in its start block from there on."""
        self.listed(run, begins_mm, self.ends_of(run.route, begins_mm))

    def ends_of(self, route: Route, begins_mm: int) -> Map[Block, int]:
        """Where each block of a route ends that begins there."""
        return {block: begins_mm + BLOCK_MM * (at + 1) for at, block in enumerate(self.line.blocks(route))}

    def does_not_pass(self) -> None:
        """The head does not come out of the block that it stands in."""
        target = self.line.blocks(self.line.out)[1]
        self.refuses("head_passes", train=T1, to_mm=BLOCK_MM + 1, block=target, block_end_mm=2 * BLOCK_MM)


def a_train_too_near_its_end_gives_nothing_back(line: Line) -> OnLine:
    """A metre before the end of its block a recalled train keeps the old end, brakes, and frees nothing (T9, T12).

    Nor does a driver who acknowledges at a standstill release that brake.
    """
    station = OnLine(line)
    station.located(BLOCK_MM - 1_000)
    station.lists(station.out, 0)
    station.told({station.out: PERMITTED})
    station.holds(station.end_mm)
    station.changes(first_loop.recall(station.unit(), station.out))
    for _ in range(3):
        brake = station.asks(error_mm=500)
        assert brake == Brake(applied=True, end_mm=station.end_mm, withheld=True)
        assert released(brake, BLOCK_MM - 500).applied
        assert not station.gives_back(station.out)
    assert station.order(station.out) == RECALLED
    return station


def a_train_whose_range_is_lost_gives_nothing_back(line: Line) -> OnLine:
    """Its clock has stalled: by where it was then it could stop short, and nobody knows where it is now (T9, P7)."""
    station = OnLine(line)
    station.located(BLOCK_MM * 3 // 5)
    station.lists(station.out, 0)
    station.told({station.out: PERMITTED})
    station.holds(station.end_mm)
    station.changes(first_loop.recall(station.unit(), station.out))
    brake = station.asks(known=False)
    assert brake == Brake(applied=True, end_mm=station.end_mm, withheld=True)
    assert not station.gives_back(station.out)
    assert station.order(station.out) == RECALLED
    return station


def a_run_set_ahead_carries_no_end_over_what_is_nobodys(line: Line) -> OnLine:
    """The nearer of two runs is gone: the end is that of the block, or there is none and the train brakes (T9)."""
    station = OnLine(line)
    station.located(BLOCK_MM * 3 // 5)
    station.lists(station.ahead, station.end_mm - BLOCK_MM)
    station.told({station.ahead: PERMITTED})
    station.holds(BLOCK_MM * 3 // 5 + 1_000, withheld=True)
    assert station.rolling() == frozenset()
    station.does_not_pass()
    station.lists(station.out, 0)
    for nearer in (GIVEN_BACK, replace(RECALLED, permitted=False)):
        station.told({station.out: nearer, station.ahead: PERMITTED})
        station.holds(BLOCK_MM)
        station.does_not_pass()
    station.told({station.out: PERMITTED, station.ahead: PERMITTED})
    station.holds(station.farther_mm)
    return station


ATTACKS: tuple[Callable[[Line], OnLine], ...] = (
    a_train_too_near_its_end_gives_nothing_back,
    a_train_whose_range_is_lost_gives_nothing_back,
    a_run_set_ahead_carries_no_end_over_what_is_nobodys,
)


def _witness(attack: Callable[[Line], OnLine], line: str) -> Callable[[], None]:
    """An attack on a station made for it, as a witness."""

    def witness() -> None:
        attack(line_on(line))

    witness.__name__ = f"on_{line}_{attack.__name__}"
    witness.__doc__ = inspect.getdoc(attack)
    return witness


WITNESSES: tuple[Callable[[], None], ...] = tuple(_witness(attack, line) for line in LINES for attack in ATTACKS)
