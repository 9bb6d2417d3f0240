"""Traffic: trains on their journeys, second by second, and what goes wrong meanwhile (T5, T8, T10, T11)."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from random import Random

from kernel.names import Block, Car, Epoch, Tag, TerminalLife, Train, UnitLife
from models.layouts.results import Imported
from models.simulator import messages
from models.simulator.journey import Chances, Journey
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
            self._recover()
            for journey in self.journeys:
                journey.second(self.play, self.random)
            self._trouble()

    @property
    def finished(self) -> int:
        """How many runs have been run to their destination."""
        return sum(journey.finished for journey in self.journeys)

    def _recover(self) -> None:
        centre = self.play.system.centre
        everybody = all(train in centre.accounted for train in self.play.site.layout.fleet)
        if everybody and (centre.lost_blocks or centre.lost_points):
            messages.recover(self.play)

    def _trouble(self) -> None:
        """Each trouble comes or does not."""
        for name, chance in vars(self.troubles).items():
            if chance and self.random.random() < chance:
                getattr(self, f"_{name}")()

    def _some(self) -> Journey:
        return self.random.choice(self.journeys)

    def _centre_restarts(self) -> None:
        self.play.take("restart_centre", epoch=Epoch(self.play.system.centre.epoch + 1))
        for journey in self.journeys:
            journey.lose_way(self.play)

    def _unit_restarts(self) -> None:
        journey = self._some()
        train = journey.train.train
        self.play.take("restart_unit", train=train, life=UnitLife(self.play.system.units[train].life + 1))
        journey.lose_way(self.play)

    def _terminal_restarts(self) -> None:
        points = sorted(self.play.site.layout.points)
        if points:
            point = self.random.choice(points)
            life = TerminalLife(self.play.system.terminals[point].life + 1)
            self.play.take("restart_terminal", point=point, life=life)

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
        radio, random, take = self.play.system.radio, self.random, self.play.take
        kind = random.choice(sorted(ARRIVALS))
        sent = sorted(getattr(radio, kind), key=repr)
        if sent:
            message = random.choice(sent)
            step, names = ARRIVALS[kind]
            event = dict(zip(names, message if len(names) > 1 else (message,), strict=True))
            if step == "obey_order":
                event |= {"detected": self.play.system.track.lies[event["point"]], "is_detected": random.random() < 0.8}
            if step == "note_standing":
                run = messages.next_run(self.play, event["train"], messages.NO_ROUTE)
                event["run"] = run._replace(life=event["life"])
            if step == "take_offer":
                event["tag_list"] = self.play.site.layout.tag_list[event["run"].route]
            take(step, **event)


ARRIVALS: Mapping[str, tuple[str, tuple[str, ...]]] = {
    "relayed_orders": ("obey_order", ("run", "point", "life")),
    "relayed_enquiries": ("answer_enquiry", ("run", "point", "life")),
    "confirmations": ("note_confirmation", ("run", "point", "position")),
    "offers": ("take_offer", ("run",)),
    "echoes": ("note_echo", ("run",)),
    "permits": ("take_permit", ("run",)),
    "returns": ("note_given_back", ("run",)),
    "tail_reports": ("release_block", ("run", "block", "left", "entered")),
    "stops": ("release_overlap", ("run",)),
    "standings": ("note_standing", ("train", "life", "epoch")),
    "standing_runs": ("take_standing", ("run",)),
    "terminal_lives": ("note_terminal_life", ("point", "life")),
}
"""For each kind of message the transition in which it arrives, and the names of what it carries."""


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
