"""What centre, trains and terminals say to each other: whatever a machine sends in its state, again until it is heard.

The words are steps of the world; when they arrive is the radio's (T4, T6, T8, T9, T10, T11).
"""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import Any

from kernel.centre import Grant
from kernel.names import Block, Point, Run, Stage, Train
from models.simulation.agenda import Act
from models.simulation.air import Air
from models.simulation.motors import Motors
from models.simulator import messages
from models.simulator.play import Play

MayAnswer = Callable[[Train], bool]
"""Whether a train stands still, whole by its line, and is to tell where."""
StandsShort = Callable[[Run], bool]
"""Whether a train stands short of a run."""


class Talk:
    """The conversations of every train."""

    def __init__(self, play: Play, air: Air, motors: Motors, may_answer: MayAnswer, stands_short: StandsShort) -> None:
        self.play = play
        self.air = air
        self.motors = motors
        self.may_answer = may_answer
        self.stands_short = stands_short

    def with_train(self, train: Train) -> None:
        """Everything that is to be said now by and to one train."""
        self._standing(train)
        for run, grant in list(self.play.system.centre.runs.items()):
            if run.train == train and grant.stage != Stage.OVER:
                self._about(run, grant)

    def _carry(self, train: Train, step: str, **event: Any) -> None:
        """A telegram whose arrival is a step of the world; what it changes is answered at once."""

        def arrives() -> None:
            if self.play.take(step, **event):
                self.with_train(train)

        self.air.carry(train, arrives)

    # ---- routes

    def _about(self, run: Run, grant: Grant) -> None:
        play, order = self.play, self.play.system.units[run.train].orders.get(run)
        if grant.stage == Stage.RESERVED:
            self._prove_points(run, grant)
        elif grant.stage == Stage.OFFERED and order is None:
            play.take("send_offer", run=run)
            self._carry(run.train, "take_offer", run=run)
        elif grant.stage == Stage.OFFERED:
            play.take("send_echo", run=run)
            self._carry(run.train, "note_echo", run=run)
        elif grant.stage == Stage.SET and order is not None and not order.permitted and not grant.cancelling:
            play.take("send_permit", run=run)
            self._carry(run.train, "take_permit", run=run)
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
                self._confirm(run, point, "note_confirmation")
                continue
            self.play.take("send_order", run=run, point=point, life=terminal.life)
            event = {"run": run, "point": point, "life": terminal.life}
            obeys = partial(self.motors.obey, run, point, terminal.life)
            self.air.carry(run.train, self._relays("relay_order", event, obeys))
        if not unproved and self.play.take("open_first_loop", run=run):
            self.with_train(run.train)

    def _hear(self, train: Train, point: Point) -> bool:
        """Whether the centre knows the terminal's life; if not, the terminal tells it."""
        life = self.play.system.terminals[point].life
        if self.play.system.centre.terminal_life.get(point) == life:
            return True
        self.play.take("send_terminal_life", point=point)
        self._carry(train, "note_terminal_life", point=point, life=life)
        return False

    def _relays(self, step: str, event: dict[str, Any], arrives: Act) -> Act:
        """A train passes something on, and that arrives a little later."""

        def relays() -> None:
            self.play.take(step, **event)
            self.air.carry(event["run"].train, arrives)

        return relays

    def _confirm(self, run: Run, point: Point, then: str) -> None:
        """The terminal's word how its point lies, by way of the train to the centre."""
        lies = self.play.system.track.lies[point]
        event = {"run": run, "point": point, "position": lies}
        self.play.take("send_confirmation", **event, detected=lies)
        if (run, point, lies) not in self.play.system.radio.confirmed:
            return

        def arrives() -> None:
            if self.play.take(then, **event):
                self.with_train(run.train)

        self.air.carry(run.train, self._relays("relay_confirmation", event, arrives))

    def _recall(self, run: Run) -> None:
        """The centre wants the run back; the train gives it back if it stands short of it (T9)."""
        play = self.play
        play.take("send_recall", run=run)
        if self.stands_short(run):
            self.air.carry(run.train, lambda: self._gives_back(run))
        if play.system.units[run.train].orders.get(run) is not None:
            play.take("send_return", run=run)
            if run in play.system.radio.returns:
                self._carry(run.train, "note_given_back", run=run)

    def _gives_back(self, run: Run) -> None:
        if self.stands_short(run) and self.play.take("give_back", run=run, stands_short=True):
            self.with_train(run.train)

    def _report(self, run: Run) -> None:
        """Every block that the tail has left and the centre still holds, and that the train stands (T6, T7, T9)."""
        play, order = self.play, self.play.system.units[run.train].orders[run]
        for block, evidence in order.left.items():
            if run in play.system.centre.claimed.get(block, frozenset()):
                event = {"run": run, "block": block, "left": evidence.left, "entered": evidence.entered}
                play.take("send_tail_report", **event)
                if (run, block, evidence.left, evidence.entered) in play.system.radio.tail_reports:
                    self._carry(run.train, "release_block", **event)
        overlap = play.site.layout.overlap.get(run.route, frozenset())
        if order.stopped and any(run in play.system.centre.claimed.get(block, frozenset()) for block in overlap):
            play.take("send_stop", run=run)
            self._carry(run.train, "release_overlap", run=run)

    # ---- where trains stand

    def _standing(self, train: Train) -> None:
        """A train that is to tell where it stands is asked, answers, and is told so (T8)."""
        play, centre, unit = self.play, self.play.system.centre, self.play.system.units[train]
        if unit.answered != centre.epoch:
            if self.may_answer(train):
                play.take("send_challenge", epoch=centre.epoch)
                self.air.carry(train, lambda: self._answers(train))
        elif centre.accounted.get(train) != unit.life:
            play.take("send_standing", train=train, epoch=centre.epoch)
            self.air.carry(train, lambda: self._is_noted(train))
        elif (run := self.standing_run(train)) is not None and run not in unit.orders:
            play.take("send_standing_run", run=run)
            self._carry(train, "take_standing", run=run)

    def standing_run(self, train: Train) -> Run | None:
        """The run under which the centre holds a train that has told, in its present life, where it stands."""
        centre, life = self.play.system.centre, self.play.system.units[train].life
        for run, grant in centre.runs.items():
            if run.train == train and run.life == life and grant.stage == Stage.STANDING:
                return run
        return None

    def _answers(self, train: Train) -> None:
        play = self.play
        if not self.may_answer(train):
            return
        unit, epoch = play.system.units[train], play.system.centre.epoch
        life = type(unit.life)(unit.life + 1)
        event = {"train": train, "epoch": epoch, "life": life, "blocks": where(play, train)}
        if play.take("answer", **event, at_rest=True, healthy=True):
            self.with_train(train)

    def _is_noted(self, train: Train) -> None:
        play = self.play
        unit, epoch = play.system.units[train], play.system.centre.epoch
        run = messages.next_run(play, train, messages.NO_ROUTE)
        if play.take("note_standing", train=train, life=unit.life, epoch=epoch, run=run):
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
                self._confirm(run, point, "adopt_point")
                continue
            event = {"run": run, "point": point, "life": terminal.life}
            play.take("send_enquiry", **event)
            answers = partial(self.play.take, "answer_enquiry", **event)
            self.air.carry(run.train, self._relays("relay_enquiry", event, answers))


def where(play: Play, train: Train) -> frozenset[Block]:
    """The blocks a train is in: by the tags at both its ends, as it stands."""
    at, train_of = play.system.track.at, play.site.formation.train_of
    return frozenset(block for car in at if train_of[car] == train for block in at[car])
