"""What can be done next in a watched play, each by a few drawn numbers: the rules of a state machine, and of a walk."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from random import Random
from typing import Any

from fuzz.failures.replaying import ERRORS
from fuzz.machines.places import place_on
from fuzz.machines.plausible import MESSAGES, plausible
from fuzz.machines.service import BEGINNING, IN_ORDER, next_steps
from fuzz.machines.strange import Pick, almost
from fuzz.machines.watched import Place, WatchedPlay
from kernel.names import Train
from proofs.catalogue import STEPS
from proofs.mutated import Sources, running

EVERY = tuple(STEPS)
ARRIVALS = tuple(sorted(MESSAGES))
RESTARTS = ("restart_unit", "restart_terminal", "restart_centre")
TROUBLES = (
    "head_reads",
    "window_passes",
    "overrun",
    "come_to_rest",
    "change_ends",
    "head_misses",
    "cancel",
    "withdraw",
    "note_stopped",
    "part",
    "open_procedure",
    "take_over",
    "correct_statement",
)
"""What people, brakes and antennas do beside ordinary service."""
SOONEST = 3
"""Of so many steps that a train's service could take next, any may be taken."""
MOST_STEPS = 2_000
"""After so many steps of service everything has been brought into service, or never will be."""


class Moves:
    """A play and what can be done in it.

    ``focus``: the transitions that happen out of turn, or with strange events; a few at a time meet more often.
    ``counted``: how many of each move; a move takes one step of the world, which may change nothing.
    """

    def __init__(self, place: Place, sources: Sources, focus: Sequence[str] = ()) -> None:
        self.play = WatchedPlay(place, sources)
        self.trains = tuple(sorted(place.trains))
        self.focus = tuple(focus) or EVERY
        self.counted: Counter[str] = Counter()

    def start_service(self) -> None:
        """Every train tells where it stands, and everything lost is found again."""
        for _ in range(MOST_STEPS):
            if not any(self._serve(train, _first, BEGINNING) for train in self.trains):
                return

    def goes_on(self, pick: Pick) -> bool:
        """One step of some train's ordinary service; tell whether there was any."""
        self.counted["goes_on"] += 1
        first = pick(len(self.trains))
        return any(self._serve(train, pick) for train in (*self.trains[first:], *self.trains[:first]))

    def _serve(self, train: Train, pick: Pick, only: tuple[str, ...] = IN_ORDER) -> bool:
        found: list[tuple[str, dict[str, Any]]] = []
        for step, events in next_steps(self.play.site, self.play.system, train, STEPS):
            if step not in only:
                break
            found.append((step, dict(events[pick(len(events))])))
            if len(found) == SOONEST or pick is _first:
                break
        if not found:
            return False
        # The first is taken twice as often: pick gives its first answer for two numbers.
        step, event = found[max(0, pick(len(found) + 1) - 1)]
        return self.play.take(step, **event)

    def arrives(self, pick: Pick) -> bool:
        """Some message that was ever sent arrives."""
        return self._any_of("arrives", ARRIVALS, pick)

    def goes_wrong(self, pick: Pick) -> bool:
        """People, brakes or antennas do something beside ordinary service."""
        return self._any_of("goes_wrong", TROUBLES, pick)

    def restarts(self, pick: Pick) -> bool:
        """A unit, a terminal or the centre restarts."""
        return self._any_of("restarts", RESTARTS, pick)

    def happens(self, pick: Pick) -> bool:
        """A transition out of turn, with any of its plausible events."""
        return self._any_of("happens", self.focus, pick)

    def is_strange(self, pick: Pick) -> bool:
        """A transition with an event that nobody expects."""
        self.counted["is_strange"] += 1
        step = self.focus[pick(len(self.focus))]
        return self.play.take(step, **almost(self.play.site, self.play.system, step, pick))

    def _any_of(self, move: str, steps: tuple[str, ...], pick: Pick) -> bool:
        """One of these transitions that has plausible events, and one of those; every other time one that counts."""
        self.counted[move] += 1
        first, counts = pick(len(steps)), pick(2)
        for step in (*steps[first:], *steps[:first]):
            events = plausible(self.play.site, self.play.system, step)
            if counts:
                events = self._that_count(step, events)
            if events:
                return self.play.take(step, **events[pick(len(events))])
        return False

    def _that_count(self, step: str, events: list[dict[str, Any]]) -> list[dict[str, Any]]:
        """The events that change something in the kernel that runs here, or of which the step is not defined."""
        with running(self.play.sources):
            return [event for event in events if self._counts(step, event)]

    def _counts(self, step: str, event: Mapping[str, Any]) -> bool:
        try:
            return bool(STEPS[step](self.play.site, self.play.system, **event) != self.play.system)
        except ERRORS:
            return True


def _first(many: int) -> int:
    return 0


Move = Callable[[Moves, Pick], bool]
WEIGHTS: Mapping[Move, int] = {
    Moves.goes_on: 60,
    Moves.arrives: 8,
    Moves.goes_wrong: 12,
    Moves.restarts: 2,
    Moves.happens: 12,
    Moves.is_strange: 12,
}
"""How often each move is made, service first."""
OFTEN = (0, 0, 1, 4)
"""How many times as often a kind of move may be made in a walk."""
SERVICE = (1, 4, 16)
"""The same of service."""
FOCUS = (4, 12, len(EVERY))
"""So many transitions may be in focus."""
IN_SERVICE = 0.8
"""How likely a walk begins with everybody accounted for."""


def walk(place: Place, sources: Sources, random: Random, moves: int) -> Moves:
    """Make so many moves by chance; the same for the same state of ``random``.

    Raises:
        Broken: something claimed is false.
    """
    going = Moves(place, sources, random.sample(EVERY, random.choice(FOCUS)))
    if random.random() < IN_SERVICE:
        going.start_service()
    often = [random.choice(SERVICE if move is Moves.goes_on else OFTEN) for move in WEIGHTS]
    weights = [weight * times for weight, times in zip(WEIGHTS.values(), often, strict=True)]
    for move in random.choices(list(WEIGHTS), weights, k=moves):
        move(going, random.randrange)
    return going


def questioned(place: Place, sources: Sources, random: Random) -> Moves:
    """Some service, and then every transition with events that nobody expects; the same for the same ``random``.

    Most of them are refused, which takes no time: so what looks up a thing that is not there is soon asked for it.

    Raises:
        Broken: something claimed is false, or a step is not defined.
    """
    going = Moves(place, sources)
    going.start_service()
    for _ in range(random.randrange(SERVED)):
        going.goes_on(random.randrange)
    for step in random.sample(EVERY, len(EVERY)) * QUESTIONS:
        going.counted["is_questioned"] += 1
        going.play.take(step, **almost(going.play.site, going.play.system, step, random.randrange))
    return going


SERVED = 80
"""So many steps of service, at most, go before the questions."""
QUESTIONS = 4
"""So often each transition is asked."""
TRAINS = (2, 3)
STARTS = 5
"""So many places to begin in are tried on each layout."""
MOVES = 300
"""So many moves make a walk."""


def numbered(number: int, sources: Sources, files: Sequence[Path]) -> Moves:
    """The walk of a number: on one of the layouts in turn, with two or three trains; the same for the same number.

    Raises:
        Broken: something claimed is false.
    """
    place = place_on(files[number % len(files)], TRAINS[number % 2], number // len(files) % STARTS)
    return walk(place, sources, Random(number), MOVES)
