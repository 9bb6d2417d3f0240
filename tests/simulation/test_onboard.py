"""What the machines on board of a simulated train say of it where it has rolled back."""

from __future__ import annotations

from dataclasses import replace
from random import Random

from kernel.onboard.arithmetic import CYCLE_MS
from models.concrete.rails import TAG_MM, WINDOW_MM
from models.rides.plan import PLAN
from models.simulation.onboard import OnBoard, on_board
from models.simulation.sensors import Sensors

ROLLS_MM_S = 3_500
"""Faster than this no train rolls back within some metres of an ascent that it can stand on."""


def test_a_tail_that_has_rolled_back_too_far_counts_no_more() -> None:
    board = on_board(120_000, 500_000)
    board.spacing = replace(board.spacing, checked=True)
    assert board.line(True).fits
    board.movement = replace(board.movement, reversed=True)
    assert not board.line(True).fits


def test_the_tags_of_a_boundary_lie_farther_apart_than_a_train_rolls_back_unnoticed() -> None:
    assert PLAN.reverse.roll_back_mm + ROLLS_MM_S * CYCLE_MS // 1000 < 2 * TAG_MM - WINDOW_MM


def standing(board: OnBoard, cycles: int) -> None:
    """So many cycles pass at rest."""
    sensors = Sensors(Random(1), 0.0, 0.0, 0.0)
    for _ in range(cycles):
        head = sensors.read(0.0, 0.0)
        board.cycle(head, sensors.tail(head, 0.0), True)


def test_a_brake_holds_the_train_once_it_has_been_on_for_its_response() -> None:
    board = on_board(120_000, 500_000)
    standing(board, PLAN.brake.response_cycles - 1)
    assert not board.hold()
    standing(board, 1)
    assert board.hold()


def test_a_brake_that_is_released_has_been_on_for_no_cycle() -> None:
    board = on_board(120_000, 500_000)
    standing(board, PLAN.brake.response_cycles + 1)
    assert board.standstill.braked_cycles > 0
    board.brake = replace(board.brake, applied=False)
    assert board.standstill.braked_cycles == 0
