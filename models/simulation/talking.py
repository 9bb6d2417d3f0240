"""What centre, trains and terminals say to each other: whatever their machines have to say, again until it is heard.

What a machine says, and what it makes of what its link delivers, is `kernel.machine`'s; how it is written and what is
believed is the links' (T4, T6, T8, T9, T10, T11).  What would change nothing at its receiver is not sent: so much of
the radio's time a line can spare.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import fields as fields_of
from operator import is_
from typing import Any

from kernel.link import Party
from kernel.machine.messages import (
    Challenge,
    Confirmation,
    Echo,
    GivenBack,
    Offer,
    Permit,
    PointEnquiry,
    PointOrder,
    Recall,
    Standing,
    StandingRun,
    Stopped,
    TailReport,
    TerminalTold,
    Tick,
    ToCentre,
    ToUnit,
)
from kernel.names import Run, Stage, Train
from kernel.standstill import Standstill, ThroughLine, is_held
from models.simulation.links import CENTRE, Links
from models.simulation.motors import Motors
from models.simulation.parts import Joined, in_parts
from models.simulation.wording import Fields, was_sent
from models.simulator.machines import (
    NOWHERE,
    Message,
    centre_says,
    contacts,
    is_news_to_centre,
    is_news_to_unit,
    pass_on,
    send,
    tell_centre,
    tell_terminal,
    tell_unit,
    terminal_says,
    terminals_near,
    unit_says,
)
from models.simulator.messages import place
from models.simulator.play import Play

MayAnswer = Callable[[Train], bool]
"""Whether a train is to tell where it stands."""
Held = Callable[[Train], tuple[Standstill, ThroughLine]]
"""Has a train held, and gives what is known of its standstill and of the way to its tail."""
AskedFor = Callable[[Run], tuple[Standstill, int, int] | None]
"""How a run's train stands, which end its brake holds, and where the block ends that the run starts in."""
Say = tuple[Party, Party, Message]
"""Who says what to whom."""

KINDS: Mapping[type, str] = {
    Challenge: "challenge",
    Offer: "offer",
    Permit: "permit",
    Recall: "recall",
    StandingRun: "standing run",
    PointOrder: "order",
    PointEnquiry: "enquiry",
    Echo: "echo",
    TailReport: "tail report",
    Stopped: "stop",
    GivenBack: "return",
    Standing: "standing",
    Confirmation: "confirmation",
    TerminalTold: "terminal's life",
}
"""How a message is called on the radio, from whoever says it first."""
ONWARD: Mapping[str, str] = {
    "order": "relayed order",
    "enquiry": "relayed enquiry",
    "confirmation": "relayed confirmation",
    "terminal's life": "relayed life",
}
"""How a unit calls what it passes on."""
READ = {kind: message for message, kind in KINDS.items()}
HEARD: Mapping[str, type] = {**READ, **{onward: READ[kind] for kind, onward in ONWARD.items()}}
"""The message that each kind is."""


class Talk:
    """The conversations of every train."""

    def __init__(
        self, play: Play, links: Links, motors: Motors, may_answer: MayAnswer, held: Held, asked_for: AskedFor
    ) -> None:
        self.play = play
        self.links = links
        self.motors = motors
        self.may_answer = may_answer
        self.held = held
        self.asked_for = asked_for
        self._offered, self._echoed = Joined(), Joined()
        self._nothing_said: dict[Train, tuple[object, ...]] = {}
        self._unit, self._terminal = links.addresses.unit, links.addresses.terminal

    # ---- saying

    def with_train(self, train: Train) -> None:
        """Everything that is to be said now by and to one train, and by the terminals near it.

        Where nothing was to be said, nothing is until something changes of what was looked at.
        """
        looked_at, before = self._looked_at(train), self._nothing_said.get(train)
        if before is not None and all(map(is_, looked_at, before)):
            return
        said = self._to_unit(train)
        for each in said:
            self._say(*each)
        self._gives_back(train)
        answered = self._to_centre(train)
        for each in answered:
            self._say(*each)
        if said or answered or self._wanted_back(train):
            self._nothing_said.pop(train, None)
        else:
            self._nothing_said[train] = looked_at

    def _looked_at(self, train: Train) -> tuple[object, ...]:
        """All that decides on what is to be said by and to a train, but for runs that are wanted back."""
        system, is_tied = self.play.system, self.play.is_tied
        unit, terminals, lies = system.units[train], system.terminals, system.track.lies
        return system.centre, unit, terminals, lies, self.may_answer(train), is_tied

    def _to_unit(self, train: Train) -> list[Say]:
        """What terminals near a train and the centre have to say to its unit."""
        found = [
            (self._terminal[point], self._unit[train], told)
            for point in terminals_near(self.play, train)
            for told in terminal_says(self.play, point, contacts(self.play, point))
            if is_news_to_centre(self.play, told)
        ]
        return found + [
            (CENTRE, self._unit[train], said)
            for said in centre_says(self.play, train)
            if (self.may_answer(train) or not isinstance(said, Challenge)) and is_news_to_unit(self.play, train, said)
        ]

    def _to_centre(self, train: Train) -> list[Say]:
        """What a train's unit has to say to the centre."""
        says = unit_says(self.play, train)
        return [(self._unit[train], CENTRE, said) for said in says if is_news_to_centre(self.play, said)]

    def _say(self, me: Party, peer: Party, said: Any) -> None:
        """Send what a machine says."""
        send(self.play, said)
        if isinstance(said, Offer | Echo):
            for part in in_parts(said.run, said.tag_list):
                self._write(me, peer, KINDS[type(said)], part)
        else:
            self._write(me, peer, KINDS[type(said)], {each.name: getattr(said, each.name) for each in fields_of(said)})

    def _write(self, me: Party, peer: Party, kind: str, fields: Fields) -> None:
        """Write a message, if the world has it among those that were sent."""
        if was_sent(self.play.system.radio, kind, fields):
            self.links.say(me, peer, kind, **fields)

    # ---- hearing

    def hears(self, me: Party, peer: Party, kind: str, fields: Fields) -> None:
        """A machine acts on what its link has delivered; what that changes is answered at once.

        Of the two one is a unit, and what is said is about its own train; a terminal obeys for its own point.
        """
        addresses = self.links.addresses
        train = addresses.train[me if me in addresses.train else peer]
        if fields.get("train", train) != train or ("run" in fields and fields["run"].train != train):
            return
        if me in addresses.point and fields["point"] != addresses.point[me]:
            return
        told = self._read(kind, fields)
        if told is None:
            return
        if me in addresses.point:
            self._terminal_hears(told)
        elif me == CENTRE:
            if tell_centre(self.play, told):
                tell_centre(self.play, Tick())
                self.with_train(train)
        elif kind in ONWARD:
            self._passes_on(train, kind, fields, told)
        elif self._unit_hears(train, told):
            self.with_train(train)

    def _read(self, kind: str, fields: Fields) -> Any:
        """The message that fields say; a list only when it has come whole."""
        if kind in ("offer", "echo"):
            tag_list = (self._offered if kind == "offer" else self._echoed).take(**fields)
            return None if tag_list is None else HEARD[kind](fields["run"], tag_list)
        return HEARD[kind](**fields)

    def _unit_hears(self, train: Train, told: ToUnit) -> bool:
        if not isinstance(told, Challenge):
            return tell_unit(self.play, train, told, NOWHERE)
        if not self.may_answer(train):
            return False
        at, line = self.held(train)
        return tell_unit(self.play, train, told, place(self.play, train, at, line, asks_anew=False))

    def _passes_on(self, train: Train, kind: str, fields: Fields, told: ToUnit | ToCentre) -> None:
        """A unit passes on what a terminal says, or is to hear."""
        if pass_on(self.play, train, told):
            to = self._terminal[fields["point"]] if isinstance(told, PointOrder | PointEnquiry) else CENTRE
            self._write(self._unit[train], to, ONWARD[kind], fields)

    def _terminal_hears(self, told: PointOrder | PointEnquiry) -> None:
        if isinstance(told, PointOrder):
            self.motors.obey(told)
        else:
            tell_terminal(self.play, told.point, told, contacts(self.play, told.point))

    # ---- what the computer on board brings about

    def _wanted_back(self, train: Train) -> list[Run]:
        """Runs that a unit may still give back."""
        orders = self.play.system.units[train].orders
        return [run for run, order in orders.items() if order.recalled and not (order.given_back or order.begun)]

    def _gives_back(self, train: Train) -> None:
        """A unit asks its brake control for what is wanted back; what the brake keeps it out of it gives back (T9)."""
        for run in self._wanted_back(train):
            said = self.asked_for(run)
            if said is None:
                continue
            at, held_end_mm, start_end_mm = said
            if is_held(at) and held_end_mm <= start_end_mm:
                self.play.take("come_to_rest", run=run)
            self.play.take("give_back", run=run, at=at, held_end_mm=held_end_mm, start_end_mm=start_end_mm)

    def standing_run(self, train: Train) -> Run | None:
        """The run under which the centre holds a train that has told, in its present life, where it stands."""
        life = self.play.system.units[train].life
        for run, grant in self.play.system.centre.runs.items():
            if run.train == train and run.life == life and grant.stage == Stage.STANDING:
                return run
        return None
