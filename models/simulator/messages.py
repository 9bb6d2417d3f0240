"""Conversations of centre, train and terminals, each message of which may get lost and is said again (T4, T8, T10)."""

from __future__ import annotations

from random import Random

from kernel.machine.centre import NO_ROUTE
from kernel.machine.messages import (
    Challenge,
    FirstStatement,
    PointEnquiry,
    PointOrder,
    Procedure,
    SecondStatement,
    Tick,
    ToCentre,
)
from kernel.machine.unit import Place
from kernel.names import Block, Point, Run, Train
from kernel.standstill import Standstill, ThroughLine
from models.simulator.machines import (
    NOWHERE,
    centre_says,
    contacts,
    is_news_to_centre,
    is_news_to_unit,
    isolate,
    motor_runs_to,
    next_run,
    pass_on,
    send,
    tell_centre,
    tell_terminal,
    tell_unit,
    terminal_says,
    terminals_near,
    unit_says,
)
from models.simulator.play import Play
from models.simulator.senses import AT_REST, INSIDE, WHOLE


def converse(play: Play, train: Train, random: Random, loss: float = 0.0) -> None:
    """All that centre, unit and the terminals near a train have to say to one another, as far as it comes through."""
    tell_centre(play, Tick())
    for point in terminals_near(play, train):
        point_speaks(play, train, point, random, loss)
    for said in centre_says(play, train):
        if isinstance(said, Challenge) or not is_news_to_unit(play, train, said):
            continue
        send(play, said)
        if random.random() < loss or not pass_on(play, train, said):
            continue
        if isinstance(said, PointOrder | PointEnquiry):
            tell_terminal(play, said.point, said, contacts(play, said.point))
            throw(play, said.point)
            point_speaks(play, train, said.point, random, loss)
        else:
            tell_unit(play, train, said, NOWHERE)
    for answered in unit_says(play, train):
        reaches_centre(play, answered, random, loss)


def reaches_centre(play: Play, said: ToCentre, random: Random, loss: float) -> None:
    """A unit says something to the centre, if it is news."""
    if is_news_to_centre(play, said):
        send(play, said)
        if random.random() >= loss:
            tell_centre(play, said)


def throw(play: Play, point: Point) -> None:
    """The motor throws an unlocked point, and its terminal locks it."""
    wanted = motor_runs_to(play, point)
    if wanted is not None:
        play.take("drift", point=point, position=wanted)
        tell_terminal(play, point, Tick(), contacts(play, point))


def point_speaks(play: Play, train: Train, point: Point, random: Random, loss: float) -> None:
    """What a terminal tells goes by way of the train to the centre, if it is news."""
    for said in terminal_says(play, point, contacts(play, point)):
        if is_news_to_centre(play, said):
            send(play, said)
            pass_on(play, train, said)
            if random.random() >= loss:
                tell_centre(play, said)


def is_permitted(play: Play, run: Run) -> bool:
    """Whether the train may go by a run."""
    order = play.system.units[run.train].orders.get(run)
    return order is not None and order.permitted


def stop(play: Play, run: Run, random: Random) -> None:
    """The train finds that it stands in its destination, and tells."""
    play.take("note_stopped", run=run, **INSIDE)
    converse(play, run.train, random)


def tell(play: Play, train: Train, random: Random) -> Run | None:
    """A train at rest tells where it stands, is taken at its word and told so; none while it cannot."""
    if train in play.system.track.parted:
        return state(play, train, random)
    asked = Challenge(play.system.centre.epoch)
    send(play, asked)
    tell_unit(play, train, asked, place(play, train, AT_REST, WHOLE, asks_anew=True))
    return taken(play, train, random)


def taken(play: Play, train: Train, random: Random) -> Run | None:
    """The centre takes the word of a train, or of two persons: the run that it stands under then."""
    before = play.system.centre.newest
    run = next_run(play, train, NO_ROUTE)
    converse(play, train, random)
    if play.system.centre.newest == before:
        return None
    converse(play, train, random)
    return run


def state(play: Play, train: Train, random: Random) -> Run | None:
    """Two persons state where a train is whose unit cannot; the first begins with what he sees of it at once."""
    blocks, epoch = where(play, train), play.system.centre.epoch
    send(play, Challenge(epoch))
    tell_centre(play, Procedure(train))
    isolate(play, train, frozenset())
    life = play.system.units[train].life
    play.take("correct_statement", train=train, epoch=epoch, life=life, blocks=blocks)
    tell_centre(play, FirstStatement(train, life, epoch, blocks))
    play.take("confirm_statement", train=train, epoch=epoch, life=life, blocks=blocks)
    run = next_run(play, train, NO_ROUTE)
    if not tell_centre(play, SecondStatement(train, life, epoch, blocks)):
        return None
    converse(play, train, random)
    converse(play, train, random)
    return run


def place(play: Play, train: Train, at: Standstill, line: ThroughLine, *, asks_anew: bool) -> Place:
    """What the computer of a train knows of where it stands: the blocks by the tags at both ends, as it stands."""
    return Place(where(play, train), at, line, asks_anew)


def where(play: Play, train: Train) -> frozenset[Block]:
    """The blocks a train is in: by the tags at both its ends, as it stands."""
    at, train_of = play.system.track.at, play.site.formation.train_of
    return frozenset(block for car in at if train_of[car] == train for block in at[car])
