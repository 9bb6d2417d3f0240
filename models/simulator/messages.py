"""Conversations of centre, train and terminals, each message of which may get lost and is sent again (T4, T8, T10)."""

from __future__ import annotations

from random import Random

from kernel.names import Point, Route, Run, Serial, Stage, Train, UnitLife
from models.simulator.play import Play
from models.simulator.senses import AT_REST, INSIDE, WHOLE

NO_ROUTE = Route("standing")


def next_run(play: Play, train: Train, route: Route) -> Run:
    """A run with the next number, for the life of the train's unit."""
    return Run(Serial(play.system.centre.newest + 1), train, play.system.units[train].life, route)


def lay(play: Play, run: Run, point: Point, random: Random, loss: float) -> None:
    """Have a point laid and confirmed for a run, as far as messages come through."""
    hear(play, point)
    terminal = play.system.terminals[point]
    wanted = play.site.layout.needs[run.route][point]
    play.take("send_order", run=run, point=point, life=terminal.life)
    if random.random() < loss or (run, point, terminal.life) not in play.system.radio.orders:
        return
    play.take("relay_order", run=run, point=point, life=terminal.life)
    lies = play.system.track.lies[point]
    play.take("obey_order", run=run, point=point, life=terminal.life, detected=lies, is_detected=True)
    if play.system.terminals[point].unlocked and play.system.terminals[point].wanted == wanted:
        play.take("drift", point=point, position=wanted)
        play.take("lock", point=point, detected=wanted, is_detected=True)
    confirm(play, run, point)
    if random.random() >= loss:
        play.take("note_confirmation", run=run, point=point, position=wanted)


def hear(play: Play, point: Point) -> None:
    """Hear which life a terminal is in, if the centre does not know."""
    life = play.system.terminals[point].life
    if play.system.centre.terminal_life.get(point) != life:
        play.take("send_terminal_life", point=point)
        play.take("note_terminal_life", point=point, life=life)


def confirm(play: Play, run: Run, point: Point) -> None:
    """The terminal's word for a run goes out and on."""
    lies = play.system.track.lies[point]
    play.take("send_confirmation", run=run, point=point, position=lies, detected=lies, is_detected=True)
    if (run, point, lies) in play.system.radio.confirmed:
        play.take("relay_confirmation", run=run, point=point, position=lies)


def close_loop(play: Play, run: Run, random: Random, loss: float) -> bool:
    """First loop and permit, as far as messages come through; tell whether the train may go."""
    grant = play.system.centre.runs.get(run)
    if grant is None:
        return False
    if grant.stage == Stage.RESERVED:
        play.take("open_first_loop", run=run)
    kept = {"run": run, "tag_list": play.site.layout.tag_list[run.route]}
    for send, sent, receive, received in (
        ("send_offer", {"run": run}, "take_offer", kept),
        ("send_echo", kept, "note_echo", {"run": run}),
        ("send_permit", {"run": run}, "take_permit", {"run": run}),
    ):
        play.take(send, **sent)
        if random.random() >= loss:
            play.take(receive, **received)
    order = play.system.units[run.train].orders.get(run)
    return order is not None and order.permitted


def report(play: Play, train: Train, random: Random, loss: float) -> None:
    """Every block the tail has left and the centre still holds is reported, for every run it is held for."""
    for run, order in play.system.units[train].orders.items():
        if run not in play.system.centre.runs:
            continue
        for block, evidence in order.left.items():
            if run in play.system.centre.claimed.get(block, frozenset()):
                event = {"run": run, "block": block, "left": evidence.left, "entered": evidence.entered}
                play.take("send_tail_report", **event)
                if random.random() >= loss:
                    play.take("release_block", **event)


def stop(play: Play, run: Run) -> None:
    """The train tells that it stands in its destination, and the overlap is freed."""
    play.take("note_stopped", run=run, **INSIDE)
    play.take("send_stop", run=run)
    play.take("release_overlap", run=run)


def retire_what_is_over(play: Play, train: Train) -> None:
    """The centre forgets runs of a train that hold nothing."""
    held = {run for _, holders in play.system.centre.claimed.items() for run in holders}
    for run in [run for run in play.system.centre.runs if run.train == train and run not in held]:
        play.take("retire", run=run)


def tell(play: Play, train: Train) -> Run | None:
    """A train at rest tells where it stands, is taken at its word and told so; none while it cannot."""
    epoch, unit = play.system.centre.epoch, play.system.units[train]
    at, train_of = play.system.track.at, play.site.formation.train_of
    blocks = frozenset(block for car in at if train_of[car] == train for block in at[car])
    life = UnitLife(unit.life + 1)
    play.take("send_challenge", epoch=epoch)
    if train in play.system.track.parted:
        return state(play, train, life)
    play.take("answer", train=train, epoch=epoch, life=life, blocks=blocks, at=AT_REST, line=WHOLE)
    play.take("send_standing", train=train, epoch=epoch)
    run = next_run(play, train, NO_ROUTE)
    if not play.take("note_standing", train=train, life=life, epoch=epoch, run=run):
        return None
    return told(play, run)


def state(play: Play, train: Train, life: UnitLife) -> Run | None:
    """Two persons state where a train is whose unit cannot; the first begins with what he sees of it at once."""
    epoch, at, train_of = play.system.centre.epoch, play.system.track.at, play.site.formation.train_of
    blocks = frozenset(block for car in at if train_of[car] == train for block in at[car])
    play.take("open_procedure", train=train)
    play.take("take_over", train=train, epoch=epoch, life=life, blocks=frozenset())
    play.take("correct_statement", train=train, epoch=epoch, life=life, blocks=blocks)
    play.take("note_statement", train=train, life=life, epoch=epoch)
    play.take("confirm_statement", train=train, epoch=epoch, life=life, blocks=blocks)
    run = next_run(play, train, NO_ROUTE)
    if not play.take("note_statement_confirmed", train=train, life=life, epoch=epoch, run=run):
        return None
    return told(play, run)


def told(play: Play, run: Run) -> Run:
    """The train is told under which run it stands, and the points below it are adopted."""
    play.take("send_standing_run", run=run)
    play.take("take_standing", run=run)
    for block, holders in play.system.centre.claimed.items():
        for point in sorted(play.site.layout.points_in.get(block, frozenset())) if run in holders else ():
            adopt(play, run, point)
    return run


def adopt(play: Play, run: Run, point: Point) -> None:
    """The centre learns how a point below a standing train lies."""
    hear(play, point)
    life, lies = play.system.terminals[point].life, play.system.track.lies[point]
    play.take("send_enquiry", run=run, point=point, life=life)
    play.take("relay_enquiry", run=run, point=point, life=life)
    play.take("answer_enquiry", run=run, point=point, life=life)
    confirm(play, run, point)
    play.take("adopt_point", run=run, point=point, position=lies)


def recover(play: Play) -> None:
    """Everything that is lost and can be found again is."""
    for block in sorted(play.system.centre.lost_blocks):
        play.take("recover_block", block=block)
    for point in sorted(play.system.centre.lost_points):
        if not play.system.centre.claimed.get(play.site.layout.stands_in[point]):
            play.take("recover_point", point=point)
