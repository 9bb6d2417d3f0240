"""One train's day: it stands, asks for a route, waits for points and loops, runs, arrives, reports, and goes on."""

from __future__ import annotations

from dataclasses import dataclass, field
from enum import Enum
from random import Random

from kernel.machine.messages import Cancellation, Request, Withdrawal
from kernel.names import Block, Route, Run, Stage
from models.simulator import messages
from models.simulator.machines import next_run, tell_centre
from models.simulator.play import Play
from models.simulator.senses import AT_REST
from models.simulator.train import OnTrack, front_passes, rear_must_follow, rear_passes


@dataclass(frozen=True)
class Chances:
    """How likely each trouble is: ``loss`` for each message, the others each second or each event."""

    loss: float = 0.2
    missed_tag: float = 0.0
    ahead: float = 0.3
    withdrawn: float = 0.01
    cancelled: float = 0.02
    late_rear: float = 0.3
    slips: float = 0.05


class Phase(Enum):
    """What a train is doing."""

    LOST = "has not told where it stands"
    STANDS = "stands and asks for a route"
    WAITS = "waits for points and loops"
    RUNS = "runs"


@dataclass
class Journey:
    """A train and what it is about.

    ``base``: the run it stands or moves under.  ``run``: the one asked for, or being run.
    ``onward``: the one set ahead.  ``seconds``: until it does anything again.  ``patience``: how
    often it still tries what it is trying.
    """

    train: OnTrack
    chances: Chances
    phase: Phase = Phase.LOST
    base: Run | None = None
    run: Run | None = None
    onward: Run | None = None
    seconds: int = 0
    patience: int = 0
    finished: int = 0
    wanted: list[Route] = field(default_factory=list)

    def second(self, play: Play, random: Random) -> None:
        """A second passes."""
        if self.seconds > 0:
            self.seconds -= 1
            return
        if self.phase is Phase.LOST:
            self._tell(play, random)
        elif self.phase is Phase.STANDS:
            self._ask(play, random)
        elif self.phase is Phase.WAITS:
            self._wait(play, random)
        else:
            self._run(play, random)

    def lose_way(self, play: Play) -> None:
        """The train comes to rest wherever it is and has to tell anew where it stands."""
        self._rest(play)
        self.phase, self.base, self.run, self.onward, self.seconds = Phase.LOST, None, None, None, 5

    def _rest(self, play: Play) -> None:
        for run in [run for run in play.system.track.rolling if run.train == self.train.train]:
            play.take("come_to_rest", run=run)

    def _tell(self, play: Play, random: Random) -> None:
        self.base = messages.tell(play, self.train.train, random)
        self.phase, self.seconds = (Phase.LOST if self.base is None else Phase.STANDS), 5

    def _ask(self, play: Play, random: Random) -> None:
        """Ask for some route from here; the train turns if that is its way."""
        assert self.base is not None
        if not self.wanted:
            self.wanted = self._routes(play)
            random.shuffle(self.wanted)
        if not self.wanted:
            self.seconds = 60
            return
        run = next_run(play, self.train.train, self.wanted.pop())
        if tell_centre(play, Request(run, self.base)):
            self.run, self.phase, self.patience, self.wanted = run, Phase.WAITS, 60, []
        else:
            self.seconds = random.randint(10, 30) if self.wanted else 60

    def _routes(self, play: Play) -> list[Route]:
        """The routes that begin where the car that would lead stands, and do not come back over the train."""
        assert self.base is not None
        layout, found = play.site.layout, []
        for route in sorted(layout.routes):
            run = self.base._replace(route=route)
            facing = self.train.faces(play, run)
            front = self.train.trail[-1] if facing else self.train.trail[0]
            if layout.start[route] == front and layout.claims[route] & frozenset(self.train.trail) == {front}:
                found.append(route)
        return found

    def _wait(self, play: Play, random: Random) -> None:
        """Points and loops; withdrawn or cancelled now and then, and when it takes too long."""
        assert self.run is not None
        self.patience -= 1
        grant = play.system.centre.runs.get(self.run)
        if grant is None:
            return
        tired = self.patience < 0 or random.random() < self.chances.withdrawn
        if tired and tell_centre(play, Withdrawal(self.run)):
            self.phase, self.run, self.seconds = Phase.STANDS, None, 10
            return
        messages.converse(play, self.train.train, random, self.chances.loss)
        if messages.is_permitted(play, self.run):
            self._depart(play, random)

    def _depart(self, play: Play, random: Random) -> None:
        assert self.run is not None
        if random.random() < self.chances.cancelled and self._give_back(play, self.run, random):
            self.phase, self.run, self.seconds = Phase.STANDS, None, 10
            return
        if not self.train.faces(play, self.run):
            self.train.turn(play)
        play.take("change_ends", train=self.train.train, cab=play.site.formation.front[self.run])
        play.take("start_rolling", run=self.run)
        self.phase, self.seconds = Phase.RUNS, random.randint(10, 30)

    def _give_back(self, play: Play, run: Run, random: Random) -> bool:
        """The signaller wants a run back before the train moves; its brake holds the end before the run."""
        tell_centre(play, Cancellation(run))
        messages.converse(play, run.train, random)
        play.take("give_back", run=run, at=AT_REST, held_end_mm=0, start_end_mm=0)
        messages.converse(play, run.train, random)
        grant = play.system.centre.runs.get(run)
        return grant is None or grant.stage == Stage.OVER

    def _run(self, play: Play, random: Random) -> None:
        """The next boundary: the rear may lag behind the front by one; the next route may be set ahead."""
        assert self.run is not None
        self.seconds = random.randint(5, 25)
        messages.converse(play, self.train.train, random, self.chances.loss)
        layout, front = play.site.layout, self.train.trail[-1]
        if self.onward is None and front == layout.destination[self.run.route] and random.random() < self.chances.ahead:
            self._ask_ahead(play, random)
        if rear_must_follow(self.train):
            self._rear_follows(play, random)
            return
        if front != layout.destination[self.run.route]:
            if not front_passes(play, self.train, self.run):
                self.lose_way(play)
                return
        elif self._prolonged(play, random):
            return
        elif len(self.train.trail) == 1 or (len(self.train.trail) == 2 and random.random() < self.chances.late_rear):
            self._arrive(play, random)
            return
        if len(self.train.trail) > 2 or random.random() >= self.chances.late_rear:
            self._rear_follows(play, random)

    def _rear_follows(self, play: Play, random: Random) -> None:
        assert self.run is not None
        healthy = self.train.train not in play.system.track.parted
        missed = random.random() < self.chances.missed_tag
        if healthy and len(self.train.trail) > 1:
            rear_passes(play, self.train, self.run, healthy, missed)

    def _ask_ahead(self, play: Play, random: Random) -> None:
        """Ask for a route on in the same direction while still moving."""
        assert self.run is not None
        layout = play.site.layout
        routes = [
            route
            for route in sorted(layout.routes)
            if layout.start[route] == layout.destination[self.run.route]
            and self.train.faces(play, self.run._replace(route=route))
            and not layout.covers[route] & {*self.train.trail, layout.start[self.run.route]}
        ]
        if routes:
            run = next_run(play, self.train.train, random.choice(routes))
            if tell_centre(play, Request(run, self.run)):
                self.onward, self.patience = run, 20

    def _prolonged(self, play: Play, random: Random) -> bool:
        """Whether the run set ahead is being waited for, or goes on now."""
        if self.onward is None:
            return False
        grant = play.system.centre.runs.get(self.onward)
        self.patience -= 1
        if grant is None or (self.patience < 0 and tell_centre(play, Withdrawal(self.onward))):
            self.onward = None
            return False
        self.seconds = 1
        messages.converse(play, self.train.train, random, self.chances.loss)
        if messages.is_permitted(play, self.onward):
            assert self.run is not None
            play.take("start_rolling", run=self.onward)
            self.base, self.run, self.onward = self.run, self.onward, None
        return True

    def _arrive(self, play: Play, random: Random) -> None:
        """Come to rest, slip perhaps, report, and stand under the run that was run."""
        assert self.run is not None
        if random.random() < self.chances.slips and play.take("overrun", run=self.run) and random.random() < 0.5:
            front_passes(play, self.train, self.run)
        self._rest(play)
        messages.converse(play, self.train.train, random)
        if self.train.trail[-1] == play.site.layout.destination[self.run.route]:
            messages.stop(play, self.run, random)
        self.base, self.run, self.phase = self.run, None, Phase.STANDS
        self.finished += 1
        self.seconds = random.randint(20, 60)
        beyond = self.train.trail[-1] != play.site.layout.destination[self.base.route]
        if beyond or (len(self.train.trail) == 1 and self._holds_what_it_left(play)):
            self.lose_way(play)

    def _holds_what_it_left(self, play: Play) -> bool:
        """Whether the centre still holds a block for this train that it is no longer in: a tag was missed."""
        at: frozenset[Block] = frozenset(self.train.trail)
        return any(
            block not in at and any(run.train == self.train.train for run in holders)
            for block, holders in play.system.centre.claimed.items()
        )
