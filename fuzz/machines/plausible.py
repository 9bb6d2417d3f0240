"""What may plausibly happen next in the interlocking's world, for each of its transitions, read off the state.

The lists are in an order that depends on nothing but the state, the likelier first, so that a drawn
number stands for the same event whenever the same things went before.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from typing import Any

from kernel.machine.centre import NO_ROUTE
from kernel.names import Epoch, Read, Record, Route, Run, Serial, Stage, Tag, TerminalLife, Train, UnitLife
from models.simulator.senses import AT_REST, BROKEN, INSIDE, NOT_HELD, WHOLE
from models.world.state import Site, System

Event = Mapping[str, Any]
Events = Iterator[dict[str, Any]]
Source = Callable[[Site, System], Events]

FOREIGN = Tag("foreign")
UNREAD = Record("never written")


def plausible(site: Site, system: System, step: str) -> list[dict[str, Any]]:
    """Every plausible event of a transition in this state; not each of them changes anything."""
    if step in MESSAGES:
        return list(_messages(site, system, step))
    return list(SOURCES[step](site, system))


def next_run(system: System, train: Train, life: UnitLife, route: Route = NO_ROUTE) -> Run:
    """The run with the next number that the centre has not granted."""
    return Run(Serial(system.centre.newest + 1), train, life, route)


# ---- messages: anything that was ever sent

MESSAGES: Mapping[str, tuple[str, tuple[str, ...]]] = {
    "note_confirmation": ("confirmations", ("run", "point", "position")),
    "note_echo": ("echoes", ("run",)),
    "release_block": ("tail_reports", ("run", "block", "left", "entered")),
    "release_overlap": ("stops", ("run",)),
    "note_given_back": ("returns", ("run",)),
    "note_standing": ("standings", ("train", "life", "epoch")),
    "note_terminal_life": ("terminal_lives", ("point", "life")),
    "adopt_point": ("confirmations", ("run", "point", "position")),
    "note_statement": ("statements", ("train", "life", "epoch")),
    "note_statement_confirmed": ("confirmed_statements", ("train", "life", "epoch")),
    "take_offer": ("offers", ("run",)),
    "take_permit": ("permits", ("run",)),
    "recall": ("recalls", ("run",)),
    "take_standing": ("standing_runs", ("run",)),
    "obey_order": ("relayed_orders", ("run", "point", "life")),
    "answer_enquiry": ("relayed_enquiries", ("run", "point", "life")),
    "relay_order": ("orders", ("run", "point", "life")),
    "relay_enquiry": ("enquiries", ("run", "point", "life")),
    "relay_confirmation": ("confirmed", ("run", "point", "position")),
}
"""For each transition in which a message arrives: which messages, and the names of what they carry."""


def _messages(site: Site, system: System, step: str) -> Events:
    kind, names = MESSAGES[step]
    for message in sorted(getattr(system.radio, kind), key=repr):
        event = dict(zip(names, message if len(names) > 1 else (message,), strict=True))
        if step == "obey_order":
            event |= {"detected": system.track.lies[event["point"]], "is_detected": True}
            yield event | {"is_detected": False}
        elif step == "take_offer":
            event["tag_list"] = site.layout.tag_list[event["run"].route]
        elif step in ("note_standing", "note_statement_confirmed"):
            event["run"] = next_run(system, event["train"], event["life"])
        yield event


# ---- the centre and its people


def _requests(site: Site, system: System) -> Events:
    layout = site.layout
    for base, grant in sorted(system.centre.runs.items()):
        if grant.stage in (Stage.SET, Stage.STANDING):
            for route in sorted(layout.routes):
                if base in system.centre.claimed.get(layout.start[route], ()):
                    yield {"run": next_run(system, base.train, base.life, route), "base": base}


def _given_back(site: Site, system: System) -> Events:
    """The train stands, or not, and its brake holds the end before a recalled run, or one beyond it."""
    for train in sorted(system.units):
        for run, order in sorted(system.units[train].orders.items()):
            if order.recalled:
                yield {"run": run, "at": AT_REST, "held_end_mm": 0, "start_end_mm": 0}
                yield {"run": run, "at": AT_REST, "held_end_mm": 1, "start_end_mm": 0}
                yield {"run": run, "at": NOT_HELD, "held_end_mm": 0, "start_end_mm": 0}


def _granted(site: Site, system: System) -> Events:
    for run in sorted(system.centre.runs):
        yield {"run": run}


def _at(*stages: Stage) -> Source:
    """The runs that the centre has brought so far; every run of its, if there are none."""

    def runs(site: Site, system: System) -> Events:
        granted = sorted(system.centre.runs.items())
        there = [run for run, grant in granted if grant.stage in stages]
        for run in there or [run for run, _ in granted]:
            yield {"run": run}

    return runs


def _epochs(site: Site, system: System) -> Events:
    yield {"epoch": Epoch(system.centre.epoch + 1)}


def _lost_blocks(site: Site, system: System) -> Events:
    for block in sorted(system.centre.lost_blocks):
        yield {"block": block}


def _lost_points(site: Site, system: System) -> Events:
    for point in sorted(system.centre.lost_points):
        yield {"point": point}


def _trains(site: Site, system: System) -> Events:
    for train in sorted(system.units):
        yield {"train": train}


def _challenges(site: Site, system: System) -> Events:
    yield {"epoch": system.centre.epoch}


# ---- points


def _orders(site: Site, system: System) -> Events:
    for run in sorted(system.centre.runs):
        for point in sorted(site.layout.needs.get(run.route, ())):
            yield {"run": run, "point": point, "life": system.terminals[point].life}


def _enquiries(site: Site, system: System) -> Events:
    for run in sorted(system.centre.runs):
        for point in sorted(system.centre.lost_points):
            yield {"run": run, "point": point, "life": system.terminals[point].life}


def _confirmations(site: Site, system: System) -> Events:
    for point, terminal in sorted(system.terminals.items()):
        if terminal.holds is not None:
            lies = system.track.lies[point]
            yield {"run": terminal.holds, "point": point, "position": lies, "detected": lies, "is_detected": True}


def _positions(site: Site, system: System) -> Events:
    known = {lies for needs in site.layout.needs.values() for lies in needs.values()}
    for point, terminal in sorted(system.terminals.items()):
        if terminal.unlocked:
            wanted = () if terminal.wanted is None else (terminal.wanted,)
            for position in (*wanted, *sorted(known - {terminal.wanted})):
                yield {"point": point, "position": position}


def _locks(site: Site, system: System) -> Events:
    for point in sorted(system.terminals):
        yield {"point": point, "detected": system.track.lies[point], "is_detected": True}


def _points(site: Site, system: System) -> Events:
    for point in sorted(system.terminals):
        yield {"point": point}


def _terminal_lives(site: Site, system: System) -> Events:
    for point, terminal in sorted(system.terminals.items()):
        yield {"point": point, "life": TerminalLife(terminal.life + 1)}


# ---- on board


def _known(system: System) -> list[Run]:
    """The runs that units know, the newest first."""
    return sorted((run for _, unit in system.units.items() for run in unit.orders), reverse=True)


def _ordered(site: Site, system: System) -> Events:
    for run in _known(system):
        yield {"run": run}


def _slips(site: Site, system: System) -> Events:
    """The runs in which a train may still slip into its overlap; any that a unit knows, if none."""
    for run in sorted(system.track.rolling - system.track.stood) or _known(system):
        yield {"run": run}


def _answers(site: Site, system: System) -> Events:
    for train, unit in sorted(system.units.items()):
        for epoch in sorted(system.radio.challenges, reverse=True):
            yield {
                "train": train,
                "epoch": epoch,
                "life": UnitLife(unit.life + 1),
                "blocks": stands_in(site, system, train),
                "at": AT_REST,
                "line": WHOLE,
            }


def _statements(site: Site, system: System) -> Events:
    for event in _answers(site, system):
        yield {name: event[name] for name in ("train", "epoch", "life", "blocks")}


def _corrections(site: Site, system: System) -> Events:
    """Where the train stands, unless that is what was stated; then nowhere, and every block but one of its."""
    for (train, life, epoch), stated in sorted(system.radio.statements.items(), key=lambda said: said[0]):
        there = stands_in(site, system, train)
        places = (there, frozenset(), *(there - {block} for block in sorted(there)))
        for blocks in dict.fromkeys(place for place in places if place != stated):
            yield {"train": train, "epoch": epoch, "life": life, "blocks": blocks}


def _statements_confirmed(site: Site, system: System) -> Events:
    """What was stated, and where the train stands."""
    for (train, life, epoch), stated in sorted(system.radio.statements.items(), key=lambda said: said[0]):
        for blocks in dict.fromkeys((stated, stands_in(site, system, train))):
            yield {"train": train, "epoch": epoch, "life": life, "blocks": blocks}


def stands_in(site: Site, system: System, train: Train) -> frozenset[Any]:
    """The blocks that a train is in."""
    at = system.track.at
    return frozenset(block for car in at if site.formation.train_of[car] == train for block in at[car])


def _unit_lives(site: Site, system: System) -> Events:
    for train, unit in sorted(system.units.items()):
        yield {"train": train, "life": UnitLife(unit.life + 1)}


def _standings(site: Site, system: System) -> Events:
    for train, unit in sorted(system.units.items()):
        if unit.answered is not None:
            yield {"train": train, "epoch": unit.answered}


def _stops(site: Site, system: System) -> Events:
    for event in _ordered(site, system):
        yield {**event, **INSIDE}


def _head_reads(site: Site, system: System) -> Events:
    """The expected tag of each run, in its window; then something foreign, then every other tag."""
    cab_of, train_of = site.formation.cab, site.formation.train_of
    for train, unit in sorted(system.units.items()):
        cabs = [cab_of[car] for car in sorted(train_of) if train_of[car] == train]
        expected = sorted({order.expected for _, order in unit.orders.items() if order.expected is not None})
        for tag in (*expected, FOREIGN, *sorted(site.layout.tag_in)):
            for cab in cabs:
                yield {"train": train, "cab": cab, "tag": tag, "in_window": True}


def _changes_of_ends(site: Site, system: System) -> Events:
    """The cab at the front of each run that a unit knows, the newest first; then every cab of the train."""
    cab_of, train_of = site.formation.cab, site.formation.train_of
    for train, unit in sorted(system.units.items()):
        fronts = [site.formation.front[run] for run in sorted(unit.orders, reverse=True)]
        cabs = [cab_of[car] for car in sorted(train_of) if train_of[car] == train]
        for cab in dict.fromkeys((*fronts, *cabs)):
            yield {"train": train, "cab": cab}


def _head_misses(site: Site, system: System) -> Events:
    """The tag that each run expects next, then any other at the ends of blocks that the unit thinks it is in."""
    for train, unit in sorted(system.units.items()):
        expected = sorted({order.expected for _, order in unit.orders.items() if order.expected is not None})
        there = [tag for tag in sorted(site.layout.tag_in) if site.layout.tag_in[tag] in unit.occupied]
        for tag in dict.fromkeys((*expected, *there)):
            yield {"train": train, "tag": tag}


def _tail_reads(site: Site, system: System) -> Events:
    """Both tags at the end of every block that a unit thinks it is in, as the last car of each of its runs."""
    for train, unit in sorted(system.units.items()):
        before = unit.tail_read
        tags = [site.layout.partner[before.tag]] if before is not None and before.tag in site.layout.partner else []
        tags += [tag for tag in sorted(site.layout.tag_in) if site.layout.tag_in[tag] in unit.occupied]
        for run in sorted(unit.orders, reverse=True):
            car = site.formation.last[run]
            told = {"run": run, "car": car, "cab": site.formation.cab[car]}
            for tag in tags:
                yield {**told, "line": BROKEN if train in system.track.parted else WHOLE, "read": _read(site, tag)}


def _read(site: Site, tag: Tag) -> Read:
    return Read(tag, site.records.record.get(tag, UNREAD))


def _tail_reports(site: Site, system: System) -> Events:
    """What tails have read; then the list handed back: every pair at the ends of blocks that a unit is in."""
    for _, unit in sorted(system.units.items()):
        for run, order in sorted(unit.orders.items()):
            for block, evidence in sorted(order.left.items()):
                yield {"run": run, "block": block, "left": evidence.left, "entered": evidence.entered}
    for _, unit in sorted(system.units.items()):
        for tag, block in sorted(site.layout.tag_in.items()):
            for run in sorted(unit.orders) if block in unit.occupied else ():
                partner = site.layout.partner[tag]
                yield {"run": run, "block": block, "left": _read(site, tag), "entered": _read(site, partner)}


# ---- nature


def _rolling(site: Site, system: System) -> Events:
    for run in sorted(system.track.rolling | system.track.slipping):
        yield {"run": run}


def _kept(site: Site, system: System) -> Events:
    """What each unit keeps of the routes that it was sent."""
    for train in sorted(system.units):
        for run, order in sorted(system.units[train].orders.items()):
            if order.tag_list is not None:
                yield {"run": run, "tag_list": order.tag_list}


def _moves(site: Site, system: System) -> Events:
    """Every car of a rolling train, the front first, into whatever follows a block that it is in."""
    at, leads = system.track.at, site.ground.leads
    for run in sorted(system.track.rolling, reverse=True):
        ahead = site.formation.ahead[run]
        for car in sorted((car for car in ahead if car in at), key=lambda car: len(ahead[car])):
            for block in sorted(at[car]):
                for target in sorted(leads.get(run.route, {}).get(block, {})):
                    yield {"run": run, "car": car, "block": block, "target": target}


def _follows(site: Site, system: System) -> Events:
    at, train_of = system.track.at, site.formation.train_of
    for car in sorted(at):
        for other in sorted(at):
            if train_of[car] == train_of[other]:
                for target in sorted(at[other] - at[car]):
                    yield {"car": car, "other": other, "target": target}


def _leaves(site: Site, system: System) -> Events:
    for car, blocks in sorted(system.track.at.items()):
        for block in sorted(blocks):
            if len(blocks) > 1:
                yield {"car": car, "block": block}


SOURCES: Mapping[str, Source] = {
    "request": _requests,
    "open_first_loop": _granted,
    "retire": _granted,
    "withdraw": _at(Stage.RESERVED),
    "cancel": _at(Stage.OFFERED, Stage.SET),
    "restart_centre": _epochs,
    "recover_block": _lost_blocks,
    "recover_point": _lost_points,
    "open_procedure": _trains,
    "head_reads": _head_reads,
    "window_passes": _trains,
    "tail_reads": _tail_reads,
    "note_stopped": _stops,
    "answer": _answers,
    "restart_unit": _unit_lives,
    "lock": _locks,
    "restart_terminal": _terminal_lives,
    "drift": _positions,
    "send_order": _orders,
    "send_enquiry": _enquiries,
    "send_confirmation": _confirmations,
    "send_offer": _granted,
    "send_echo": _kept,
    "send_permit": _granted,
    "send_recall": _granted,
    "give_back": _given_back,
    "send_return": _ordered,
    "send_tail_report": _tail_reports,
    "send_stop": _ordered,
    "send_challenge": _challenges,
    "send_standing": _standings,
    "send_standing_run": _granted,
    "send_terminal_life": _points,
    "start_rolling": _ordered,
    "overrun": _slips,
    "come_to_rest": _rolling,
    "change_ends": _changes_of_ends,
    "head_misses": _head_misses,
    "car_moves": _moves,
    "car_follows": _follows,
    "car_leaves": _leaves,
    "part": _trains,
    "take_over": _statements,
    "correct_statement": _corrections,
    "confirm_statement": _statements_confirmed,
}
"""For each transition that no message begins: where its plausible events are read off."""
