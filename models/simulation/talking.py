"""What centre, trains and terminals say to each other: whatever a machine sends in its state, again until it is heard.

The words are steps of the world, and so is what a machine does with what its link delivers; how they are written,
and what is believed, is the links' (T4, T6, T8, T9, T10, T11).
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any

from kernel.centre import Grant
from kernel.link import Party
from kernel.maps import Map
from kernel.names import Block, Epoch, Point, Run, Serial, Stage, Train
from kernel.standstill import Standstill, ThroughLine, is_held
from models.simulation.links import CENTRE, Links
from models.simulation.motors import Motors
from models.simulation.parts import Joined, in_parts
from models.simulation.wording import Fields, was_sent
from models.simulator.messages import NO_ROUTE
from models.simulator.play import Play

MayAnswer = Callable[[Train], bool]
"""Whether a train is to tell where it stands."""
Sensed = Callable[[Train], tuple[Standstill, ThroughLine]]
"""What odometry, line and the machines on board say of a train's standstill and of the way to its tail."""
AskedFor = Callable[[Run], tuple[Standstill, int, int] | None]
"""How a run's train stands, which end its brake holds, and where the block ends that the run starts in."""

STEPS: Mapping[str, str] = {
    "relayed life": "note_terminal_life",
    "permit": "take_permit",
    "return": "note_given_back",
    "tail report": "release_block",
    "stop": "release_overlap",
    "standing run": "take_standing",
}
"""What is done with a message that is a step of the world as it is, with the fields of the message."""


class Talk:
    """The conversations of every train."""

    def __init__(
        self, play: Play, links: Links, motors: Motors, may_answer: MayAnswer, sensed: Sensed, asked_for: AskedFor
    ) -> None:
        self.play = play
        self.links = links
        self.motors = motors
        self.may_answer = may_answer
        self.sensed = sensed
        self.asked_for = asked_for
        self._offered, self._echoed = Joined(), Joined()
        self._sorted_out: Map[Run, Grant] = {}
        self._by_train: dict[Train, list[tuple[Run, Grant]]] = {}
        self._unit, self._terminal = links.addresses.unit, links.addresses.terminal
        self._acts: Mapping[str, Callable[[Train, Fields], object]] = {
            "order": lambda train, fields: self._relays("relay_order", "relayed order", train, fields),
            "enquiry": lambda train, fields: self._relays("relay_enquiry", "relayed enquiry", train, fields),
            "relayed order": lambda _, fields: self.motors.obey(fields["run"], fields["point"], fields["life"]),
            "relayed enquiry": lambda _, fields: self.play.take("answer_enquiry", **fields),
            "confirmation": self._relays_confirmation,
            "relayed confirmation": self._is_confirmed,
            "terminal's life": lambda train, fields: self._say(self._unit[train], CENTRE, "relayed life", fields),
            "offer": self._is_offered,
            "echo": self._is_echoed,
            "recall": self._is_recalled,
            "challenge": self._answers,
            "standing": self._is_noted,
        }

    def with_train(self, train: Train) -> None:
        """Everything that is to be said now by and to one train."""
        self._standing(train)
        for run, grant in self._runs_of(train):
            if grant.stage != Stage.OVER:
                self._about(run, grant)

    def _runs_of(self, train: Train) -> Sequence[tuple[Run, Grant]]:
        """The runs that the centre has of a train; sorted out once for all trains, until it has others."""
        runs = self.play.system.centre.runs
        if runs is not self._sorted_out:
            self._sorted_out, self._by_train = runs, {}
            for run, grant in runs.items():
                self._by_train.setdefault(run.train, []).append((run, grant))
        return self._by_train.get(train, ())

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
        if kind not in STEPS:
            self._acts[kind](train, fields)
        elif self.play.take(STEPS[kind], **fields):
            self.with_train(train)

    def _say(self, me: Party, peer: Party, kind: str, fields: Fields) -> None:
        """Send a message, if the world has it among those that were sent."""
        if was_sent(self.play.system.radio, kind, fields):
            self.links.say(me, peer, kind, **fields)

    def _to_unit(self, train: Train, kind: str, /, **fields: Any) -> None:
        self._say(CENTRE, self._unit[train], kind, fields)

    def _to_centre(self, train: Train, kind: str, /, **fields: Any) -> None:
        self._say(self._unit[train], CENTRE, kind, fields)

    # ---- routes

    def _about(self, run: Run, grant: Grant) -> None:
        play, order = self.play, self.play.system.units[run.train].orders.get(run)
        if grant.stage == Stage.RESERVED:
            self._prove_points(run, grant)
        elif grant.stage == Stage.OFFERED and order is None:
            play.take("send_offer", run=run)
            for part in in_parts(run, play.site.layout.tag_list[run.route]):
                self._to_unit(run.train, "offer", **part)
        elif grant.stage == Stage.OFFERED and order is not None and order.tag_list is not None:
            play.take("send_echo", run=run, tag_list=order.tag_list)
            for part in in_parts(run, order.tag_list):
                self._to_centre(run.train, "echo", **part)
        elif grant.stage == Stage.SET and order is not None and not order.permitted and not grant.cancelling:
            play.take("send_permit", run=run)
            self._to_unit(run.train, "permit", run=run)
        elif grant.stage == Stage.STANDING:
            self._adopt_points(run)
        if grant.cancelling:
            self._recall(run)
        if order is not None:
            self._report(run)

    def _prove_points(self, run: Run, grant: Grant) -> None:
        """Points are ordered one by one, by way of the train, and confirmed the same way (T10)."""
        unproved = sorted(frozenset(self.play.site.layout.needs[run.route]) - grant.proved)
        for point in unproved:
            terminal = self.play.system.terminals[point]
            if not self._hear(run.train, point):
                continue
            if terminal.holds == run and not terminal.unlocked:
                self._confirm(run, point)
                continue
            event = {"run": run, "point": point, "life": terminal.life}
            self.play.take("send_order", **event)
            self._to_unit(run.train, "order", **event)
        if not unproved and self.play.take("open_first_loop", run=run):
            self.with_train(run.train)

    def _hear(self, train: Train, point: Point) -> bool:
        """Whether the centre knows the terminal's life; if not, the terminal tells it, by way of the train."""
        life = self.play.system.terminals[point].life
        if self.play.system.centre.terminal_life.get(point) == life:
            return True
        self.play.take("send_terminal_life", point=point)
        fields = {"point": point, "life": life}
        self._say(self._terminal[point], self._unit[train], "terminal's life", fields)
        return False

    def _relays(self, step: str, kind: str, train: Train, fields: Fields) -> None:
        """A train passes something on to a terminal."""
        self.play.take(step, **fields)
        self._say(self._unit[train], self._terminal[fields["point"]], kind, fields)

    def _confirm(self, run: Run, point: Point) -> None:
        """The terminal's word how its point lies, by way of the train to the centre."""
        lies = self.play.system.track.lies[point]
        event = {"run": run, "point": point, "position": lies}
        self.play.take("send_confirmation", **event, detected=lies, is_detected=True)
        self._say(self._terminal[point], self._unit[run.train], "confirmation", event)

    def _relays_confirmation(self, train: Train, fields: Fields) -> None:
        self.play.take("relay_confirmation", **fields)
        self._to_centre(train, "relayed confirmation", **fields)

    def _is_confirmed(self, train: Train, fields: Fields) -> None:
        """The centre hears how a point lies for a run: one that is being set, or one that stands over it."""
        grant = self.play.system.centre.runs.get(fields["run"])
        stands = grant is not None and grant.stage == Stage.STANDING
        if self.play.take("adopt_point" if stands else "note_confirmation", **fields):
            self.with_train(train)

    def _recall(self, run: Run) -> None:
        """The centre wants the run back; the train gives it back at rest, its brake holding the end before it (T9)."""
        play, order = self.play, self.play.system.units[run.train].orders.get(run)
        play.take("send_recall", run=run)
        if order is None:
            return
        if not order.recalled and not order.begun:
            self._to_unit(run.train, "recall", run=run)
        elif not order.given_back:
            self._gives_back(run)
        if play.take("send_return", run=run) or run in play.system.radio.returns:
            self._to_centre(run.train, "return", run=run)

    def _gives_back(self, run: Run) -> None:
        """The unit asks its brake control; what the brake lets the train into no more it does not roll into."""
        said = self.asked_for(run)
        if said is None:
            return
        at, held_end_mm, start_end_mm = said
        if is_held(at) and held_end_mm <= start_end_mm:
            self.play.take("come_to_rest", run=run)
        self.play.take("give_back", run=run, at=at, held_end_mm=held_end_mm, start_end_mm=start_end_mm)

    def _is_offered(self, train: Train, fields: Fields) -> None:
        """The unit keeps the list as it came; where it comes in parts, once it has them all (T4)."""
        tag_list = self._offered.take(**fields)
        if tag_list is not None and self.play.take("take_offer", run=fields["run"], tag_list=tag_list):
            self.with_train(train)

    def _is_echoed(self, train: Train, fields: Fields) -> None:
        """The centre compares what came back; the world has it if it was sent (T4)."""
        tag_list = self._echoed.take(**fields)
        if tag_list is None or tag_list != self.play.system.radio.echoes.get(fields["run"]):
            return
        if self.play.take("note_echo", run=fields["run"]):
            self.with_train(train)

    def _is_recalled(self, train: Train, fields: Fields) -> None:
        if self.play.take("recall", **fields):
            self.with_train(train)

    def _report(self, run: Run) -> None:
        """Every block that the tail has left and the centre still holds, and that the train stands (T6, T7, T9)."""
        play, order = self.play, self.play.system.units[run.train].orders[run]
        for block, evidence in order.left.items():
            if run in play.system.centre.claimed.get(block, frozenset()):
                event = {"run": run, "block": block, "left": evidence.left, "entered": evidence.entered}
                play.take("send_tail_report", **event)
                self._to_centre(run.train, "tail report", **event)
        overlap = play.site.layout.overlap.get(run.route, frozenset())
        if order.stopped and any(run in play.system.centre.claimed.get(block, frozenset()) for block in overlap):
            play.take("send_stop", run=run)
            self._to_centre(run.train, "stop", run=run)

    # ---- where trains stand

    def _standing(self, train: Train) -> None:
        """A train that is to tell where it stands is asked, answers, and is told so (T8)."""
        play, centre, unit = self.play, self.play.system.centre, self.play.system.units[train]
        if unit.answered != centre.epoch:
            if self.may_answer(train):
                play.take("send_challenge", epoch=centre.epoch)
                self._to_unit(train, "challenge", epoch=centre.epoch)
        elif centre.accounted.get(train) != unit.life:
            play.take("send_standing", train=train, epoch=centre.epoch)
            said = {"life": unit.life, "epoch": centre.epoch, "blocks": unit.standing_in}
            self._to_centre(train, "standing", train=train, **said)
        elif (run := self.standing_run(train)) is not None and run not in unit.orders:
            play.take("send_standing_run", run=run)
            self._to_unit(train, "standing run", run=run)

    def standing_run(self, train: Train) -> Run | None:
        """The run under which the centre holds a train that has told, in its present life, where it stands."""
        life = self.play.system.units[train].life
        for run, grant in self._runs_of(train):
            if run.life == life and grant.stage == Stage.STANDING:
                return run
        return None

    def _answers(self, train: Train, fields: Fields) -> None:
        play = self.play
        if not self.may_answer(train):
            return
        unit, (at, line) = play.system.units[train], self.sensed(train)
        event = {"train": train, "life": type(unit.life)(unit.life + 1), "blocks": where(play, train)}
        if play.take("answer", **event, epoch=fields["epoch"], at=at, line=line):
            self.with_train(train)

    def _is_noted(self, train: Train, fields: Fields) -> None:
        """The centre takes a train's word, and gives it a run to stand under; the world has it if it was sent."""
        play, life, epoch = self.play, fields["life"], Epoch(fields["epoch"])
        if not was_sent(play.system.radio, "standing", fields):
            return
        run = Run(Serial(play.system.centre.newest + 1), train, life, NO_ROUTE)
        if play.take("note_standing", train=train, life=life, epoch=epoch, run=run):
            self.with_train(train)

    def _adopt_points(self, run: Run) -> None:
        """The centre learns how the points below a standing train lie."""
        play, centre = self.play, self.play.system.centre
        for point in sorted(centre.lost_points):
            if run not in centre.claimed.get(play.site.layout.stands_in[point], frozenset()):
                continue
            if not self._hear(run.train, point):
                continue
            terminal = play.system.terminals[point]
            if terminal.holds == run:
                self._confirm(run, point)
                continue
            event = {"run": run, "point": point, "life": terminal.life}
            play.take("send_enquiry", **event)
            self._to_unit(run.train, "enquiry", **event)


def where(play: Play, train: Train) -> frozenset[Block]:
    """The blocks a train is in: by the tags at both its ends, as it stands."""
    at, train_of = play.system.track.at, play.site.formation.train_of
    return frozenset(block for car in at if train_of[car] == train for block in at[car])
