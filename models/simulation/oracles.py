"""What must be true of the simulated truth after every step: judged beside the kernel, and by none of its words.

Each oracle looks only where a step may have made it false, and counts how often it looked.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import Any

from kernel.names import Block, Car, Train
from models.simulation.oracles_on_board import in_range, inside
from models.simulation.posted import ONLY_WHAT_WAS_SENT, SILENCE
from models.simulation.road_oracles import CLOSED_IN_TIME, CLOSED_UNDER, OPENS_AGAIN
from models.simulation.vehicle import Vehicle
from models.world.state import Site, System

ORACLES: Mapping[str, str] = {
    "one_train_a_block": "no two trains are in a block, or in blocks that foul each other (T4, T9)",
    "no_point_moves_under_a_train": "no point moves while a car is in its block (T10)",
    "trains_stay_in_what_is_secured": "a car gets only into a block that is held for its train, or lost (T4, T8)",
    "nothing_is_released_around_a_train": "no block is freed that a car of its train is still in (T6, T7, T8)",
    "the_world_allows_what_happens": "whatever happens on the rails is a step of the world that the proofs are about",
    "range_contains_the_train": "the front is in the range that the odometry claims, the speed in its own (P1, P7)",
    "the_head_stays_inside_authority": "the head is not past the end of authority (T12)",
    "brakes_keep_their_bounds": "no train is faster than its brake control reckons with (T12)",
    ONLY_WHAT_WAS_SENT: "what a link delivers its peer has sent so, in this session, of late, in order and once (T11)",
    CLOSED_IN_TIME: "the road is warned and its arms are down for their times before a head comes onto it (X2, X3, X5)",
    CLOSED_UNDER: "the arms are down while a train is on the road (X4)",
    OPENS_AGAIN: "no road is kept closed for nobody, or for a train that is gone, for long (X4)",
    SILENCE: "a link that does not count as silent has delivered something of late (T8, T11)",
}


@dataclass(frozen=True)
class Violation:
    """Something that must be true is not."""

    oracle: str
    at_ms: int
    text: str


class Oracles:
    """Judges every step; ``checked`` counts for each oracle, ``found`` is what was broken."""

    def __init__(self, site: Site) -> None:
        self.site = site
        self.now_ms = 0
        self.checked: Counter[str] = Counter(dict.fromkeys(ORACLES, 0))
        self.found: list[Violation] = []
        self._before: System | None = None

    def after(self, step: str, event: Mapping[str, Any], system: System) -> None:
        """Judge a step of the world."""
        before, self._before = self._before, system
        if step in ("car_moves", "car_follows"):
            self._alone(system, event["car"], event["target"])
            self._secured(system, event["car"], event["target"])
        elif step == "drift":
            self._clear(system, event["point"])
        if before is not None and before.centre.claimed is not system.centre.claimed:
            self._released(before, system)

    def violated(self, oracle: str, text: str) -> None:
        """Note what was broken."""
        self.found.append(Violation(oracle, self.now_ms, text))

    def must(self, oracle: str, so: bool, text: str) -> None:
        """Count that an oracle was asked; note what was broken."""
        self.checked[oracle] += 1
        if not so:
            self.violated(oracle, text)

    def _train(self, car: Car) -> Train:
        return self.site.formation.train_of[car]

    def _within(self, system: System, block: Block) -> Iterable[Train]:
        return (self._train(car) for car, blocks in system.track.at.items() if block in blocks)

    def _alone(self, system: System, car: Car, block: Block) -> None:
        train = self._train(car)
        for near in (block, *sorted(self.site.layout.fouls.get(block, frozenset()))):
            others = {other for other in self._within(system, near) if other != train}
            self.must("one_train_a_block", not others, f"{train} comes into {block}; in {near} is {sorted(others)}")

    def _secured(self, system: System, car: Car, block: Block) -> None:
        train = self._train(car)
        held = any(run.train == train for run in system.centre.claimed.get(block, frozenset()))
        so = held or block in system.centre.lost_blocks
        self.must("trains_stay_in_what_is_secured", so, f"{train} gets into {block}, which is not held for it")

    def _clear(self, system: System, point: Any) -> None:
        block = self.site.layout.stands_in[point]
        there = sorted(set(self._within(system, block)))
        self.must("no_point_moves_under_a_train", not there, f"{point} moves, and in {block} is {there}")

    def _released(self, before: System, after: System) -> None:
        """What the centre no longer holds for a train, no car of it is in."""
        for block, runs in before.centre.claimed.items():
            now = after.centre.claimed.get(block, frozenset())
            if runs is now or runs <= now or block in after.centre.lost_blocks:
                continue
            gone = {run.train for run in runs} - {run.train for run in now}
            for train in sorted(gone):
                so = train not in set(self._within(after, block))
                self.must("nothing_is_released_around_a_train", so, f"{block} is released, and {train} is in it")

    def on_board(self, train: Train, vehicle: Vehicle) -> None:
        """Judge what a train's machines claim, at the end of a cycle."""
        motion, board, front_mm = vehicle.board.motion, vehicle.board, vehicle.front_mm
        if board.is_located:
            so = in_range(motion, front_mm, vehicle.speed_mm_s)
            claimed = f"{motion.front_least_mm} to {motion.front_most_mm} mm"
            self.must("range_contains_the_train", so, f"{train} is at {front_mm:.0f} mm, claimed is {claimed}")
        so = inside(board.brake.end_mm, bool(board.lists), front_mm)
        self.must("the_head_stays_inside_authority", so, f"{train} is past {board.brake.end_mm} mm")
        self.must("brakes_keep_their_bounds", not board.held.broken, f"{train} gains more, or brakes less")

    def judged_on_board(self, cycles: int, located: int) -> None:
        """Count so many cycles in which all of that was judged and true, so many of them of a located train."""
        self.checked["range_contains_the_train"] += located
        self.checked["the_head_stays_inside_authority"] += cycles
        self.checked["brakes_keep_their_bounds"] += cycles
