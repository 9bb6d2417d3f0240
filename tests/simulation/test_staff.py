"""What staff says of a train at rest: that its front is just within its block, and that the train is whole."""

from __future__ import annotations

from dataclasses import replace
from random import Random

import pytest

from kernel.names import Block, Car, Route, Run, Serial, Train, UnitLife
from kernel.onboard import computer
from kernel.onboard.tag_kind import PLAIN
from kernel.unit import NO_BLOCKS, NO_EVIDENCE, Order, Unit
from models.concrete.rails import Piece
from models.concrete.train import CAR_MM, OnRails
from models.layouts.blocks import opposite
from models.layouts.track import Heading
from models.simulation.ahead import ahead
from models.simulation.beginning import rails_of
from models.simulation.diary import Diary
from models.simulation.facing import exits
from models.simulation.onboard import on_board
from models.simulation.sensors import sensors
from models.simulation.staff import BEYOND_BOARD_MM, Staff
from models.simulation.vehicle import Vehicle
from tests.simulation.lines import imported

ROUTE, CARS = Route("1 to 2"), 12


class Stand:
    """A train on the ring whose front is so far within stand 1, and its rear in the blocks before it."""

    def __init__(self, within_mm: int) -> None:
        place = imported("ring")
        layout, rails = place.layout, rails_of(place)
        start = rails.start_of(Block("stand 1"))
        heading = start if layout.first_tag[ROUTE] in exits(rails, start) else opposite(start)
        back, before = opposite(heading), list[Heading]()
        while len(before) < 4:
            onward = rails.onward(back, {})
            assert onward is not None
            back = onward
            before.insert(0, opposite(back))
        path, at_mm = list[Piece](), 0
        for each in (*before, heading):
            path.append(Piece(each, at_mm, at_mm + rails.length_mm(each)))
            at_mm = path[-1].to_mm
        self.begins_mm, self.front_mm = path[-1].from_mm, path[-1].from_mm + within_mm
        cars = [Car(f"T01.{number}") for number in range(CARS)]
        train = OnRails(Train("T01"), cars, path, self.front_mm, Random(1))
        self.vehicle = Vehicle(train, on_board(CAR_MM * CARS, self.front_mm), sensors(Random(1)))
        run = Run(Serial(2), train.name, UnitLife(1), ROUTE)
        self.order = Order(
            layout.tag_list[ROUTE],
            True,
            False,
            False,
            False,
            False,
            layout.first_tag[ROUTE],
            NO_BLOCKS,
            None,
            NO_EVIDENCE,
        )
        self.unit = Unit(UnitLife(1), None, NO_BLOCKS, None, {run: self.order}, False, None, None, None, NO_BLOCKS)
        self.vehicle.board.lists[run] = ahead(layout, rails, train, run, {}, dict.fromkeys(layout.tag_in, PLAIN))
        self.end_mm = self.vehicle.board.lists[run].ends_mm[layout.destination[ROUTE]]
        self.staff = Staff(self.vehicle, rails, Diary())
        self.rest()

    def is_withheld(self) -> bool:
        """Whether it has no end of authority."""
        return self.vehicle.board.brake.withheld

    def rest(self) -> None:
        """The wheel agrees for long enough while the train stands."""
        for _ in range(40):
            board = self.vehicle.board
            board.decide(True, False)
            read = self.vehicle.sensors.read(0.0, 0.0, 0.0)
            board.computer = computer.sense(board.limits, board.computer, *read)
        self.vehicle.board.follow(self.unit)


@pytest.mark.parametrize("within_mm", [BEYOND_BOARD_MM, 665, 2_500])
def test_a_train_just_within_its_block_gets_its_end_once_staff_has_named_that(within_mm: int) -> None:
    stand = Stand(within_mm)
    board = stand.vehicle.board
    assert board.motion.trusted
    assert board.motion.front_least_mm < stand.begins_mm
    assert stand.is_withheld()
    assert stand.staff.names_its_block()
    assert stand.begins_mm <= board.motion.front_least_mm <= stand.front_mm
    assert not stand.staff.names_its_block()
    stand.rest()
    assert board.motion.trusted
    assert not stand.is_withheld()
    assert board.brake.end_mm == stand.end_mm


def test_staff_does_not_say_what_it_cannot_see() -> None:
    """A front at the board is in one block or in the other."""
    stand = Stand(BEYOND_BOARD_MM - 1)
    known = stand.vehicle.board.computer
    assert not stand.staff.names_its_block()
    assert stand.vehicle.board.computer == known
    assert stand.is_withheld()


def test_a_train_is_braked_before_staff_finds_it_whole() -> None:
    """Nobody walks along a train that may start; once it is held the split that was latched is over."""
    stand = Stand(BEYOND_BOARD_MM)
    board = stand.vehicle.board
    known = board.computer.known
    doubted = replace(known, wholeness=replace(known.wholeness, lost=True), watch=replace(known.watch, cycles=0))
    board.computer = replace(board.computer, known=doubted)
    board.made_up()
    assert board.computer.known.wholeness.lost
    assert not stand.staff.finds_whole()
    assert board.computer.known.wholeness.lost
    assert stand.is_withheld()
    stand.rest()
    assert stand.staff.finds_whole()
    assert not board.computer.known.wholeness.lost
