"""Centre, units and terminals of a world that is played: what they are told goes to their machines alone.

The world takes each input as the transition that the proof knows, and what comes of that must be what the machine of
`kernel.machine` makes of it; likewise nothing is sent that the machine does not say.  So whoever plays a world brings
inputs, chooses no step, numbers no run and counts no life.
"""

from __future__ import annotations

import inspect
from collections.abc import Mapping
from dataclasses import fields, replace
from functools import cache
from typing import Any

from kernel import standing
from kernel.machine import centre as centre_machine
from kernel.machine import point_terminal as terminal_machine
from kernel.machine import unit as unit_machine
from kernel.machine.messages import (
    Cancellation,
    Challenge,
    Confirmation,
    Echo,
    FirstStatement,
    FromTerminal,
    FromUnit,
    GivenBack,
    Isolation,
    Offer,
    Permit,
    PointEnquiry,
    PointOrder,
    Procedure,
    Recall,
    Request,
    SecondStatement,
    Standing,
    StandingRun,
    Stopped,
    TailReport,
    TerminalTold,
    Tick,
    ToCentre,
    ToTerminal,
    ToUnit,
    Withdrawal,
)
from kernel.machine.point_terminal import Contacts
from kernel.machine.unit import Place
from kernel.names import Block, Point, Position, Route, Run, Stage, Train
from models.simulator.play import WORLD, Play
from models.simulator.senses import AT_REST, WHOLE
from models.world.state import Radio

Message = ToUnit | ToCentre
AT_THE_CENTRE: Mapping[type, tuple[str, ...]] = {
    Echo: ("note_echo",),
    Confirmation: ("note_confirmation", "adopt_point"),
    TailReport: ("release_block",),
    Stopped: ("release_overlap",),
    GivenBack: ("note_given_back",),
    Standing: ("note_standing",),
    TerminalTold: ("note_terminal_life",),
    Request: ("request",),
    Withdrawal: ("withdraw",),
    Cancellation: ("cancel",),
    Procedure: ("open_procedure",),
    FirstStatement: ("note_statement",),
    SecondStatement: ("note_statement_confirmed",),
}
"""The transitions that an input of the centre is, of which at most one changes anything; a tick is a row of its own."""
OF_ITSELF: Mapping[str, tuple[str, str]] = {
    "complete": ("open_first_loop", "run"),
    "over": ("retire", "run"),
    "blocks": ("recover_block", "block"),
    "points": ("recover_point", "point"),
}
"""The transitions that a tick of the centre is, by what is due, and what each is told."""
ON_BOARD: Mapping[type, str] = {
    Challenge: "answer",
    Offer: "take_offer",
    Permit: "take_permit",
    Recall: "recall",
    StandingRun: "take_standing",
    Isolation: "take_over",
}
AT_A_POINT: Mapping[type, str] = {PointOrder: "obey_order", PointEnquiry: "answer_enquiry", Tick: "lock"}
SENT_BY: Mapping[type, str] = {
    Challenge: "send_challenge",
    Offer: "send_offer",
    Permit: "send_permit",
    Recall: "send_recall",
    StandingRun: "send_standing_run",
    PointOrder: "send_order",
    PointEnquiry: "send_enquiry",
    Echo: "send_echo",
    TailReport: "send_tail_report",
    Stopped: "send_stop",
    GivenBack: "send_return",
    Standing: "send_standing",
    Confirmation: "send_confirmation",
    TerminalTold: "send_terminal_life",
}
"""The transition by which a message is sent."""
PASSED_ON: Mapping[type, str] = {
    PointOrder: "relay_order",
    PointEnquiry: "relay_enquiry",
    Confirmation: "relay_confirmation",
}
"""The transition by which a unit passes a message on; a terminal's life goes through as it is."""


NOWHERE = Place(frozenset(), AT_REST, WHOLE, asks_anew=False)
"""What a unit is told with a message that does not ask where it stands."""


@cache
def _takes(row: str) -> frozenset[str]:
    return frozenset(list(inspect.signature(WORLD[row]).parameters)[2:])


def event(row: str, told: Any, **more: Any) -> Mapping[str, Any]:
    """Give what a transition is told by a message: those of its fields that the transition has a name for."""
    said = {each.name: getattr(told, each.name) for each in fields(told)} | more
    return {name: value for name, value in said.items() if name in _takes(row)}


def has_arrived(radio: Radio, told: Any) -> bool:
    """Tell whether a message is among those that were sent to its last receiver; what people ask always is."""
    match told:
        case Echo(run, tag_list):
            return radio.echoes.get(run) == tag_list
        case Confirmation(run, point, position):
            return (run, point, position) in radio.confirmations
        case TailReport(run, block, left, entered):
            return (run, block, left, entered) in radio.tail_reports
        case Stopped(run):
            return run in radio.stops
        case GivenBack(run):
            return run in radio.returns
        case Standing(train, life, epoch, blocks):
            return radio.standings.get((train, life, epoch)) == blocks
        case TerminalTold(point, life):
            return (point, life) in radio.terminal_lives
        case FirstStatement(train, life, epoch, blocks):
            return radio.statements.get((train, life, epoch)) == blocks
        case SecondStatement(train, life, epoch, blocks):
            return radio.confirmed_statements.get((train, life, epoch)) == blocks
        case _:
            return True


# ---- the centre


def next_run(play: Play, train: Train, route: Route) -> Run:
    """A run with the next number, for the life of the train's unit."""
    return centre_machine.next_run(play.system.centre, train, play.system.units[train].life, route)


def tell_centre(play: Play, told: ToCentre) -> bool:
    """Let the centre hear something, if it was sent; tell whether that changed anything."""
    before, site = play.system.centre, play.site
    if not has_arrived(play.system.radio, told):
        return False
    rows: list[tuple[str, Mapping[str, Any]]] = []
    if isinstance(told, Tick):
        due = centre_machine.due(site.layout, before)
        rows = [(row, {name: each}) for what, (row, name) in OF_ITSELF.items() for each in getattr(due, what)]
    elif isinstance(told, Standing | SecondStatement):
        run = centre_machine.next_run(before, told.train, told.life, centre_machine.NO_ROUTE)
        rows = [(row, event(row, told, run=run)) for row in AT_THE_CENTRE[type(told)]]
    else:
        rows = [(row, event(row, told)) for row in AT_THE_CENTRE[type(told)]]
    changed = [play.take(row, **heard) for row, heard in rows]
    if play.is_tied:
        assert play.system.centre == centre_machine.answer(site.layout, site.records, before, told), told
    return any(changed)


def restart_centre(play: Play) -> bool:
    """The centre restarts with what its lasting memory holds."""
    begun = centre_machine.start(play.site.layout, centre_machine.to_write(play.system.centre))
    changed = play.take("restart_centre", epoch=begun.epoch)
    assert play.system.centre == begun or not play.is_tied
    return changed


def centre_says(play: Play, train: Train) -> tuple[ToUnit, ...]:
    """What the centre has to say to a train's unit; its lasting memory writes at once."""
    centre = play.system.centre
    return centre_machine.says(play.site.layout, centre, centre_machine.to_write(centre), train)


# ---- a unit


def tell_unit(play: Play, train: Train, told: ToUnit | Isolation, place: Place) -> bool:
    """Let a unit hear something, if it was sent; tell whether that changed anything.

    Of the list that it keeps nothing is assumed: it may be another than was sent.
    """
    before, row = play.system.units[train], ON_BOARD.get(type(told))
    if row is None:
        return False
    after = unit_machine.answer(play.site.lists, before, told, place)
    if play.is_tied and after == before:
        return False
    life = unit_machine.next_life(before)
    changed = play.take(row, **event(row, told, train=train, life=life, **vars(place)))
    assert not changed or not play.is_tied or play.system.units[train] == after, told
    return changed


def isolate(play: Play, train: Train, stated: frozenset[Block]) -> bool:
    """The first person isolates a unit, and states at once where he sees the train."""
    return tell_unit(play, train, Isolation(play.system.centre.epoch), replace(NOWHERE, blocks=stated))


def restart_unit(play: Play, train: Train) -> bool:
    """A unit restarts with the count of lives that its lasting memory holds."""
    begun = unit_machine.start(play.system.units[train].life)
    changed = play.take("restart_unit", train=train, life=begun.life)
    assert play.system.units[train] == begun or not play.is_tied
    return changed


def unit_says(play: Play, train: Train) -> tuple[FromUnit, ...]:
    """What a unit has to say to the centre; of runs that the centre has forgotten nothing is news, and is left out."""
    unit, known = play.system.units[train], play.system.centre.runs
    return unit_machine.says(play.site.lists, unit, unit.life, train, [run for run in unit.orders if run in known])


# ---- a terminal


def contacts(play: Play, point: Point, is_made: bool = True) -> Contacts:
    """What the contacts of a point show: how it lies, or nothing."""
    return Contacts(play.system.track.lies[point], is_made)


def tell_terminal(play: Play, point: Point, told: ToTerminal | Tick, shown: Contacts) -> bool:
    """Let a terminal hear something, if it was sent, or its clock tick; tell whether that changed anything."""
    row, before = AT_A_POINT[type(told)], play.system.terminals[point]
    said = {"point": point, "detected": shown.position, "is_detected": shown.is_made}
    changed = play.take(row, **event(row, told, **said))
    if changed and play.is_tied:
        assert play.system.terminals[point] == terminal_machine.answer(before, told, shown), told
    return changed


def restart_terminal(play: Play, point: Point) -> bool:
    """A terminal restarts with what its lasting memory holds."""
    begun = terminal_machine.start(terminal_machine.to_write(play.system.terminals[point]))
    changed = play.take("restart_terminal", point=point, life=begun.life)
    assert play.system.terminals[point] == begun or not play.is_tied
    return changed


def terminal_says(play: Play, point: Point, shown: Contacts) -> tuple[FromTerminal, ...]:
    """What a terminal has to say by way of a train; its lasting memory writes at once."""
    terminal = play.system.terminals[point]
    return terminal_machine.says(terminal, terminal_machine.to_write(terminal), point, shown)


def motor_runs_to(play: Play, point: Point) -> Position | None:
    """Where a point's motor runs to, if it runs; the terminal's lasting memory writes at once."""
    terminal = play.system.terminals[point]
    return terminal_machine.throws_to(terminal, terminal_machine.to_write(terminal))


# ---- what is said, and whether it is news


def send(play: Play, said: Message) -> None:
    """Send what a machine says."""
    row, more = SENT_BY[type(said)], dict[str, Any]()
    if isinstance(said, Confirmation):
        shown = contacts(play, said.point)
        more = {"detected": shown.position, "is_detected": shown.is_made}
    play.take(row, **event(row, said, **more))


def pass_on(play: Play, train: Train, said: Message) -> bool:
    """Let a unit pass on what has come for a terminal, or from one; tell whether it does."""
    unit, row = play.system.units[train], PASSED_ON.get(type(said))
    if isinstance(said, PointOrder | PointEnquiry) and not unit_machine.passes_on(
        play.site.plan, play.site.lists, unit, said
    ):
        return False
    if row is not None:
        play.take(row, **event(row, said))
    return True


def is_news_to_centre(play: Play, said: ToCentre) -> bool:
    """Whether something would change anything at the centre; what would not need not be said again."""
    centre = play.system.centre
    after = centre_machine.answer(play.site.layout, play.site.records, centre, said)
    return not play.is_tied or (after is not centre and after != centre)


def is_news_to_unit(play: Play, train: Train, said: ToUnit) -> bool:
    """The same of what the centre says to a unit, for itself or for a terminal."""
    if not play.is_tied:
        return True
    if isinstance(said, Challenge):
        return not standing.tells_standing(play.system.units[train], said.epoch)
    if isinstance(said, PointOrder | PointEnquiry):
        terminal = play.system.terminals[said.point]
        return terminal_machine.answer(terminal, said, contacts(play, said.point)) != terminal
    unit = play.system.units[train]
    return unit_machine.answer(play.site.lists, unit, said, NOWHERE) != unit


def terminals_near(play: Play, train: Train) -> list[Point]:
    """The points that are being laid for a train, or are lost below it: it is near, and hears their terminals."""
    layout, centre = play.site.layout, play.system.centre
    stages = [(run, grant.stage) for run, grant in centre.runs.items() if run.train == train]
    laid = {point for run, stage in stages if stage == Stage.RESERVED for point in layout.needs[run.route]}
    stands = [run for run, stage in stages if stage == Stage.STANDING]
    below = (
        point
        for point in centre.lost_points
        if any(run in centre.claimed.get(layout.stands_in[point], ()) for run in stands)
    )
    return sorted(laid.union(below))
