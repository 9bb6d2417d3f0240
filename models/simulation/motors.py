"""Point machines: an unlocked point is thrown for some seconds, and locked where it lies as wanted (T10)."""

from __future__ import annotations

from collections import Counter
from random import Random

from kernel.machine.messages import PointOrder, Tick
from kernel.names import Point
from models.simulation.agenda import Agenda
from models.simulation.faults import Chosen, happens
from models.simulator.machines import contacts, motor_runs_to, tell_terminal
from models.simulator.play import Play

LEAST_MS, MOST_MS = 3_000, 6_000
"""From one position to the other (ours)."""


class Motors:
    """Every point's motor and terminal."""

    def __init__(self, play: Play, agenda: Agenda, random: Random, chosen: Chosen) -> None:
        self.play = play
        self.agenda = agenda
        self.random = random
        self.chosen = chosen
        self.seen: Counter[str] = Counter()
        self._thrown: set[Point] = set()
        self._stuck_until_ms: dict[Point, int] = {}

    def stick(self, point: Point, ms: int) -> None:
        """A point does not move for so long."""
        self._stuck_until_ms[point] = self.agenda.now_ms + ms

    def obey(self, order: PointOrder) -> None:
        """An order arrives at the terminal; it throws the point if it has to."""
        is_detected = not happens("point_undetected", self.chosen, self.random, self.seen)
        tell_terminal(self.play, order.point, order, contacts(self.play, order.point, is_detected))
        self._throw(order.point)

    def _throw(self, point: Point) -> None:
        if motor_runs_to(self.play, point) is None or point in self._thrown:
            return
        stuck_ms = max(0, self._stuck_until_ms.get(point, 0) - self.agenda.now_ms)
        self._thrown.add(point)
        self.agenda.after(stuck_ms + self.random.randint(LEAST_MS, MOST_MS), lambda: self._arrives(point))

    def _arrives(self, point: Point) -> None:
        """The motor has run: the point lies as wanted, if anything still is."""
        self._thrown.discard(point)
        wanted = motor_runs_to(self.play, point)
        if wanted is None:
            return
        self.play.take("drift", point=point, position=wanted)
        tell_terminal(self.play, point, Tick(), contacts(self.play, point))
