"""Trains on the rails of a passing place, a millimetre from each other and not nearer (T4, T9, T10)."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

from kernel.maps import Map
from kernel.names import Block, Car, Point, TerminalLife, Train
from kernel.terminal import Terminal
from models.onboard.occupancy import Occupied, Place, Rails
from proofs.onboard.occupancy import THEORY
from proofs.onboard.witnesses.play import Play
from proofs.witnesses.stations import A1, A2, B1, EAST, ONE, PASSING_PLACE, T1, T2, THROAT, WEST, site_of

STATION = site_of(PASSING_PLACE)
EACH_MM = 10
"""How long each block is; 10 mm are as good as 100 m."""
IN_ORDER = (WEST, THROAT, ONE, EAST)


def place(mm: int) -> Place:
    """Give the millimetre of rail with this number, from the west."""
    return Place(str(mm))


LIES_IN = {place(EACH_MM * number + mm): block for number, block in enumerate(IN_ORDER) for mm in range(EACH_MM)}
POINT = min(STATION.layout.points_in[THROAT])
SITE = Rails(STATION, LIES_IN, {POINT: frozenset({place(14), place(15)})})
LOCKED, FREE = Terminal(TerminalLife(0), None, None, False), Terminal(TerminalLife(0), None, None, True)
AT: Mapping[Car, frozenset[Block]] = {
    A1: frozenset({WEST, THROAT}),
    A2: frozenset({WEST}),
    B1: frozenset({ONE}),
}
"""The first train stands over the end of the west, its head in the throat; another stands on track one."""


def stretch(first_mm: int, last_mm: int) -> frozenset[Place]:
    """Give the millimetres from one to another, both among them."""
    return frozenset(place(mm) for mm in range(first_mm, last_mm + 1))


class Line(Play[Rails, Occupied]):
    """The passing place with no train on it."""

    def __init__(self, site: Rails = SITE) -> None:
        """Begin."""
        super().__init__(THEORY, site, Occupied({}, {}, {}))

    def moves(
        self,
        covers: Mapping[Train, frozenset[Place]],
        at: Mapping[Car, frozenset[Block]] = AT,
        terminals: Map[Point, Terminal] | None = None,
    ) -> bool:
        """Let trains get there; whether they do."""
        locked = {point: LOCKED for points in STATION.layout.points_in.values() for point in points}
        before = self.system
        self.step("trains_move", at=at, terminals=locked if terminals is None else terminals, covers=covers)
        return self.system != before


def trains_in_blocks_of_their_own_do_not_touch() -> None:
    """Up to the last millimetre of the block before the other's (T4)."""
    line = Line()
    assert line.moves({T1: stretch(2, 19), T2: stretch(20, 27)})
    assert not line.system.covers[T1] & line.system.covers[T2]


def a_train_covers_nothing_where_no_car_of_it_is() -> None:
    """Nor what is no rail of the line (T1)."""
    for covers in ({T1: stretch(2, 20)}, {T2: stretch(19, 21)}, {T2: stretch(20, 40)}, {T1: stretch(-1, 3)}):
        assert not Line().moves(covers)


def what_the_interlocking_excludes_does_not_happen() -> None:
    """Two trains in a block, or in blocks that foul each other, or a point that is free under one (T9, T10)."""
    covers = {T1: stretch(2, 19), T2: stretch(20, 27)}
    both = {**AT, B1: frozenset({THROAT, ONE})}
    assert not Line().moves({T1: stretch(2, 15), T2: stretch(16, 27)}, at=both)
    layout = replace(STATION.layout, fouls={THROAT: frozenset({ONE}), ONE: frozenset({THROAT})})
    assert not Line(replace(SITE, site=replace(STATION, layout=layout))).moves(covers)
    clear = replace(STATION.layout, fouls={THROAT: frozenset({EAST}), EAST: frozenset({THROAT})})
    assert Line(replace(SITE, site=replace(STATION, layout=clear))).moves(covers)
    free = {point: FREE for points in STATION.layout.points_in.values() for point in points}
    assert not Line().moves(covers, terminals=free)
    assert not Line().moves(covers, terminals={})
    assert Line().moves({T2: stretch(20, 27)}, at={B1: frozenset({ONE})}, terminals=free)


WITNESSES = (
    trains_in_blocks_of_their_own_do_not_touch,
    a_train_covers_nothing_where_no_car_of_it_is,
    what_the_interlocking_excludes_does_not_happen,
)
