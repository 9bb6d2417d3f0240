"""Traffic: trains on their journeys, second by second, and what goes wrong meanwhile (T5, T8, T10, T11)."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from random import Random
from typing import Any

from kernel.machine.messages import (
    Confirmation,
    Echo,
    GivenBack,
    Offer,
    Permit,
    PointEnquiry,
    PointOrder,
    Standing,
    StandingRun,
    Stopped,
    TailReport,
    TerminalTold,
    Tick,
)
from kernel.names import Block, Car, Tag, Train
from models.layouts.results import Imported
from models.simulator.journey import Chances, Journey
from models.simulator.machines import (
    NOWHERE,
    contacts,
    restart_centre,
    restart_terminal,
    restart_unit,
    tell_centre,
    tell_terminal,
    tell_unit,
)
from models.simulator.play import Play, Watcher, begin, berths, site_of, two_cars_each
from models.simulator.train import OnTrack
from models.world.state import Site


@dataclass(frozen=True)
class Troubles:
    """How likely each is in a second."""

    centre_restarts: float = 0.0
    unit_restarts: float = 0.0
    terminal_restarts: float = 0.0
    foreign_tag: float = 0.0
    overdue_tag: float = 0.0
    old_message: float = 0.0
    parts: float = 0.0


class Traffic:
    """Some trains of a layout's fleet and their journeys."""

    def __init__(self, play: Play, trains: Sequence[OnTrack], random: Random, chances: Chances, troubles: Troubles):
        self.play = play
        self.random = random
        self.troubles = troubles
        self.journeys = [Journey(train, chances) for train in trains]

    def run(self, seconds: int) -> None:
        """Let so many seconds pass."""
        for _ in range(seconds):
            tell_centre(self.play, Tick())
            for journey in self.journeys:
                journey.second(self.play, self.random)
            self._trouble()

    @property
    def finished(self) -> int:
        """How many runs have been run to their destination."""
        return sum(journey.finished for journey in self.journeys)

    def _trouble(self) -> None:
        """Each trouble comes or does not."""
        for name, chance in vars(self.troubles).items():
            if chance and self.random.random() < chance:
                getattr(self, f"_{name}")()

    def _some(self) -> Journey:
        return self.random.choice(self.journeys)

    def _centre_restarts(self) -> None:
        restart_centre(self.play)
        for journey in self.journeys:
            journey.lose_way(self.play)

    def _unit_restarts(self) -> None:
        journey = self._some()
        restart_unit(self.play, journey.train.train)
        journey.lose_way(self.play)

    def _terminal_restarts(self) -> None:
        points = sorted(self.play.site.layout.points)
        if points:
            restart_terminal(self.play, self.random.choice(points))

    def _foreign_tag(self) -> None:
        journey = self._some()
        cab = journey.train.cab(self.play, journey.train.front)
        self.play.take("head_reads", train=journey.train.train, cab=cab, tag=Tag("foreign"), in_window=True)
        journey.lose_way(self.play)

    def _overdue_tag(self) -> None:
        journey = self._some()
        tag = self.random.choice(sorted(self.play.site.layout.tag_in))
        self.play.take("head_misses", train=journey.train.train, tag=tag)
        self.play.take("window_passes", train=journey.train.train)
        journey.lose_way(self.play)

    def _parts(self) -> None:
        journey = self._some()
        self.play.take("part", train=journey.train.train)
        journey.lose_way(self.play)

    def _old_message(self) -> None:
        """Some message that was ever sent arrives once more."""
        play, random = self.play, self.random
        kind = random.choice(sorted(ARRIVALS))
        sent = sorted(getattr(play.system.radio, kind), key=repr)
        if not sent:
            return
        said = ARRIVALS[kind](play, random.choice(sent))
        if isinstance(said, PointOrder | PointEnquiry):
            tell_terminal(play, said.point, said, contacts(play, said.point, random.random() < 0.8))
        elif isinstance(said, Offer | Permit | StandingRun):
            tell_unit(play, said.run.train, said, NOWHERE)
        else:
            tell_centre(play, said)


ARRIVALS: Mapping[str, Callable[[Play, Any], Any]] = {
    "relayed_orders": lambda play, sent: PointOrder(
        sent[0], sent[1], play.site.layout.needs[sent[0].route][sent[1]], sent[2]
    ),
    "relayed_enquiries": lambda _, sent: PointEnquiry(*sent),
    "confirmations": lambda _, sent: Confirmation(*sent),
    "offers": lambda play, sent: Offer(sent, play.site.layout.tag_list[sent.route]),
    "echoes": lambda play, sent: Echo(sent, play.system.radio.echoes[sent]),
    "permits": lambda _, sent: Permit(sent),
    "returns": lambda _, sent: GivenBack(sent),
    "tail_reports": lambda _, sent: TailReport(*sent),
    "stops": lambda _, sent: Stopped(sent),
    "standings": lambda play, sent: Standing(sent[0], sent[1], sent[2], play.system.radio.standings[sent]),
    "standing_runs": lambda _, sent: StandingRun(sent),
    "terminal_lives": lambda _, sent: TerminalTold(*sent),
}
"""For each set of messages sent the message that arrives."""


def traffic_on(
    imported: Imported,
    seed: int,
    chances: Chances | None = None,
    troubles: Troubles | None = None,
    trains: int = 8,
    watch: Watcher | None = None,
) -> Traffic:
    """Traffic on a layout file, everything just started; the fleet is as many trains as can stand apart."""
    random = Random(seed)
    fleet = sorted(imported.layout.fleet)[:trains]
    where = dict(zip(fleet, berths(imported.layout, random, len(fleet)), strict=False))
    site = site_of(imported.layout, imported.ground, imported.records, two_cars_each(sorted(where)))
    return traffic_at(site, where, random, chances, troubles, watch)


def traffic_at(
    site: Site,
    where: Mapping[Train, Block],
    random: Random,
    chances: Chances | None = None,
    troubles: Troubles | None = None,
    watch: Watcher | None = None,
) -> Traffic:
    """Traffic at a site whose trains have two cars each, every train in one block."""
    cars = two_cars_each(sorted(where))
    play = begin(site, cars, where, watch)
    return Traffic(play, _standing(cars, where), random, chances or Chances(), troubles or Troubles())


def _standing(cars: Mapping[Train, Sequence[Car]], where: Mapping[Train, Block]) -> list[OnTrack]:
    """The trains, each in its block, the first car leading."""
    return [OnTrack(train, cars[train][0], cars[train][-1], [block]) for train, block in where.items()]
