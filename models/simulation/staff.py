"""What the staff of a train at rest says of where its front is: by a tag or a post, or by the board of a block."""

from __future__ import annotations

from dataclasses import dataclass

from kernel.standstill import is_held
from models.concrete.rails import Rails
from models.simulation.ahead import block_begins_mm
from models.simulation.diary import STAFF, Diary
from models.simulation.onboard import LOCATED_WITHIN_MM
from models.simulation.vehicle import Vehicle

BEYOND_BOARD_MM = 100
"""By so much a front must be beyond the board at a boundary for the staff to say that it is (ours)."""


@dataclass(frozen=True)
class Staff:
    """The staff of one train."""

    vehicle: Vehicle
    rails: Rails
    diary: Diary

    def locates(self, told: str) -> bool:
        """Locate it, once it is held, by the tag or post beside it; it has not turned, so its lists stay."""
        vehicle, board = self.vehicle, self.vehicle.board
        if not board.hold():
            return False
        front_mm, lists = round(vehicle.front_mm), board.lists
        board.locate(front_mm - LOCATED_WITHIN_MM, front_mm + LOCATED_WITHIN_MM)
        board.lists = lists
        vehicle.at_rest_cycles = 0
        vehicle.look_again()
        self.diary.note(STAFF, vehicle.on_rails.name, told)
        return True

    def finds_whole(self) -> bool:
        """Walk along it, once it is held, and find it whole."""
        vehicle, board = self.vehicle, self.vehicle.board
        if not is_held(board.at_rest):
            board.hold()
            return False
        board.made_up()
        self.diary.note(STAFF, vehicle.on_rails.name, "is found whole by its staff")
        return True

    def names_its_block(self) -> bool:
        """Say that its front is beyond the board at which its block begins, and whether that is news.

        A front that was located to a few metres may, as far as the computer knows, still be in the block before, and
        then no end of authority is taken (T4).
        """
        board, train = self.vehicle.board, self.vehicle.on_rails
        beyond_mm = block_begins_mm(self.rails, train) + BEYOND_BOARD_MM
        if train.front_mm < beyond_mm or board.motion.front_least_mm >= beyond_mm or not is_held(board.at_rest):
            return False
        board.note_place(beyond_mm, board.motion.front_most_mm)
        self.vehicle.look_again()
        self.diary.note(STAFF, train.name, "is said to have its front beyond the board at which its block begins")
        return True
