"""Values that nobody expects, of every type that an event carries: of somebody else, of another life, of no layout."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any, get_args, get_origin

from fuzz.machines.plausible import FOREIGN, UNREAD, plausible, stands_in
from kernel.machine.centre import NO_ROUTE
from kernel.names import (
    Block,
    Cab,
    Car,
    Epoch,
    Point,
    Position,
    Read,
    Route,
    Run,
    Serial,
    Tag,
    TagList,
    TerminalLife,
    Train,
    UnitLife,
)
from kernel.standstill import Standstill, ThroughLine
from models.simulator.senses import AT_REST, BROKEN, NOT_HELD, RELEASABLE, ROLLING, WHOLE
from models.world.state import Site, System
from proofs.catalogue import STEPS
from proofs.transitions import event_types

Pick = Callable[[int], int]
"""Given how many there are, say which: 0 is the first."""
Value = Callable[[Site, System, Pick], Any]

FEW = 3


def almost(site: Site, system: System, step: str, pick: Pick) -> dict[str, Any]:
    """A plausible event with one thing strange in it; all of it where none is plausible."""
    kinds = event_types(STEPS[step])
    known = plausible(site, system, step)
    if not known:
        return {name: strange(site, system, kind, pick) for name, kind in kinds.items()}
    event = known[pick(len(known))]
    name = list(kinds)[pick(len(kinds))]
    return {**event, name: strange(site, system, kinds[name], pick)}


def strange(site: Site, system: System, kind: Any, pick: Pick) -> Any:
    """Some value of a type, known to the site or not."""
    if get_origin(kind) is frozenset:
        (inner,) = get_args(kind)
        train = _one(sorted(system.units), pick)
        return stands_in(site, system, train) ^ {strange(site, system, inner, pick)}
    return VALUES[kind](site, system, pick)


def _one(known: Any, pick: Pick) -> Any:
    return known[pick(len(known))]


def _run(site: Site, system: System, pick: Pick) -> Run:
    """A run that is known somewhere; or a new one of any train, life and route, with any number."""
    known: set[Run] = {*system.centre.runs, *system.radio.offers, *system.radio.standing_runs}
    runs = sorted(known.union(*(unit.orders for _, unit in system.units.items())))
    at = pick(len(runs) + FEW)
    if at < len(runs):
        return runs[at]
    train = _train(site, system, pick)
    unit = system.units.get(train)
    newest, least = system.centre.newest, 0 if unit is None else unit.life
    serial = (newest + 1, newest, 0, site.layout.last_serial, site.layout.last_serial - 1)[pick(5)]
    routes = (*sorted(site.layout.routes), NO_ROUTE, Route("nowhere"))
    return Run(Serial(serial), train, UnitLife(max(0, least + pick(FEW) - 1)), _one(routes, pick))


def _block(site: Site, system: System, pick: Pick) -> Block:
    return Block(_one((*sorted(site.layout.blocks), "nowhere"), pick))


def _point(site: Site, system: System, pick: Pick) -> Point:
    return Point(_one((*sorted(site.layout.points), "no point"), pick))


def _position(site: Site, system: System, pick: Pick) -> Position:
    return Position(
        _one((*sorted({lies for _, lies in system.track.lies.items()}), "reverse", "normal", "neither"), pick)
    )


def _train(site: Site, system: System, pick: Pick) -> Train:
    return Train(_one((*sorted(site.layout.fleet), "stranger"), pick))


def _car(site: Site, system: System, pick: Pick) -> Car:
    return Car(_one((*sorted(site.formation.train_of), "no car"), pick))


def _cab(site: Site, system: System, pick: Pick) -> Cab:
    return Cab(_one((*sorted(cab for _, cab in site.formation.cab.items()), "no cab"), pick))


def _tag(site: Site, system: System, pick: Pick) -> Tag:
    return Tag(_one((*sorted(site.layout.tag_in), FOREIGN), pick))


def _tag_list(site: Site, system: System, pick: Pick) -> TagList:
    """The list of any route, or of none."""
    return TagList(_one((*sorted(tag_list for _, tag_list in site.layout.tag_list.items()), "no list"), pick))


def _read(site: Site, system: System, pick: Pick) -> Read:
    """A tag as it is written, or a copy of its UID with another record."""
    tag = _tag(site, system, pick)
    written = site.records.record.get(tag, UNREAD)
    return Read(tag, UNREAD if pick(FEW) else written)


def _epoch(site: Site, system: System, pick: Pick) -> Epoch:
    return Epoch(max(0, system.centre.epoch + pick(FEW) - 1))


def _unit_life(site: Site, system: System, pick: Pick) -> UnitLife:
    unit = system.units[_one(sorted(system.units), pick)]
    return UnitLife(max(0, unit.life + pick(FEW) - 1))


def _terminal_life(site: Site, system: System, pick: Pick) -> TerminalLife:
    return TerminalLife(pick(FEW))


VALUES: Mapping[Any, Value] = {
    Run: _run,
    Block: _block,
    Point: _point,
    Position: _position,
    Train: _train,
    Car: _car,
    Cab: _cab,
    Tag: _tag,
    TagList: _tag_list,
    Read: _read,
    Epoch: _epoch,
    UnitLife: _unit_life,
    TerminalLife: _terminal_life,
    Standstill: lambda site, system, pick: _one((AT_REST, ROLLING, NOT_HELD, RELEASABLE), pick),
    ThroughLine: lambda site, system, pick: _one((WHOLE, BROKEN), pick),
    bool: lambda site, system, pick: bool(pick(2)),
    int: lambda site, system, pick: pick(2),
}
"""For every type of an event but sets: how to come by a value."""
