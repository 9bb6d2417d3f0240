"""What is shown of each moment of a run, and what of it changed from one to the next."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from fuzz.failures.replaying import Replay
from kernel.names import Block, Point, Route, Run, Stage, Train
from kernel.unit import Order
from models.world.state import Site, System

Moment = dict[str, dict[str, Any]]
"""What is shown: trains, points and runs, each by its name."""
FIRST_LOOP = ("reserved", "offered", "echoed", "permitted")


def systems(replay: Replay) -> list[System]:
    """The state at the start and after each step."""
    return [replay.start, *(outcome.after for outcome in replay.outcomes)]


def changes(replay: Replay) -> list[Moment]:
    """The moment at the start, and for each step what is shown otherwise after it; None for what is no more."""
    found: list[Moment] = []
    before: Moment = {"trains": {}, "points": {}, "runs": {}, "lost": {}}
    for system in systems(replay):
        now = moment(replay.site, system)
        found.append({room: _changed(before[room], now[room]) for room in now if before[room] != now[room]})
        before = now
    return found


def _changed(before: Mapping[str, Any], now: Mapping[str, Any]) -> dict[str, Any]:
    gone = {name: None for name in before if name not in now}
    return gone | {name: value for name, value in now.items() if before.get(name) != value}


def moment(site: Site, system: System) -> Moment:
    """What is shown of one state."""
    return {
        "trains": {train: _train(site, system, train) for train in sorted(site.layout.fleet)},
        "points": {point: _point(system, point) for point in sorted(site.layout.points)},
        "runs": {name_of(run): _run(site, system, run) for run in _runs(system)},
        "lost": {
            "blocks": sorted(system.centre.lost_blocks),
            "points": sorted(system.centre.lost_points),
        },
    }


def name_of(run: Run) -> str:
    """A run's key on the page."""
    return f"{run.serial} {run.train} {run.life} {run.route}"


def _runs(system: System) -> list[Run]:
    """The runs that the centre or a unit knows."""
    known = {run for _, unit in system.units.items() for run in unit.orders}
    return sorted(known | set(system.centre.runs))


def _train(site: Site, system: System, train: Train) -> dict[str, Any]:
    unit = system.units[train]
    cars = [car for car, of in site.formation.train_of.items() if of == train]
    accounted = system.centre.accounted.get(train)
    moving = [
        "slips" if run in system.track.slipping else "rolls"
        for run in sorted(system.track.rolling | system.track.slipping)
        if run.train == train
    ]
    return {
        "cars": {car: sorted(system.track.at.get(car, frozenset())) for car in cars},
        "life": unit.life,
        "does": moving[0] if moving else "stands",
        "parted": train in system.track.parted,
        "known": "accounted for" if accounted == unit.life else "lost" if accounted is None else f"in life {accounted}",
        "occupied": sorted(unit.occupied),
    }


def _point(system: System, point: Point) -> dict[str, Any]:
    terminal = system.terminals[point]
    return {
        "lies": system.track.lies[point],
        "locked": not terminal.unlocked,
        "wanted": terminal.wanted,
        "holds": None if terminal.holds is None else terminal.holds.serial,
        "for": [run.serial for run in sorted(system.centre.locked.get(point, {}))],
        "lost": point in system.centre.lost_points,
    }


def _run(site: Site, system: System, run: Run) -> dict[str, Any]:
    grant, unit = system.centre.runs.get(run), system.units.get(run.train)
    order = None if unit is None else unit.orders.get(run)
    return {
        "serial": run.serial,
        "train": run.train,
        "life": run.life,
        "route": run.route,
        "stage": "not known" if grant is None else str(grant.stage.value),
        "first": _first_loop(system, run, order) if run.route in site.layout.routes else [],
        "over": grant is None or grant.stage == Stage.OVER,
        "second": None if unit is None or order is None else {"closed": not unit.loop_open, "next": order.expected},
        "left": sorted(order.left) if order is not None else [],
        "reported": sorted({block for other, block, _, _ in system.radio.tail_reports if other == run}),
        "released": {} if grant is None else {block: str(cause.value) for block, cause in sorted(grant.ended.items())},
        "notes": _notes(system, run, order),
    }


def _first_loop(system: System, run: Run, order: Order | None) -> list[bool]:
    """How far the first loop is, or came, as ``FIRST_LOOP`` names it."""
    return [
        run in system.centre.runs or run in system.radio.offers,
        run in system.radio.offers,
        run in system.radio.echoes,
        order is not None and order.permitted,
    ]


def _notes(system: System, run: Run, order: Order | None) -> list[str]:
    grant = system.centre.runs.get(run)
    told = {
        "cancelling": grant is not None and grant.cancelling,
        "given back": order is not None and order.given_back and run in system.radio.offers,
        "begun": order is not None and order.begun and run in system.radio.offers,
        "stopped": order is not None and order.stopped and run in system.radio.offers,
    }
    return [note for note, so in told.items() if so]


def held(system: System, block: Block) -> Sequence[tuple[Train, Route]]:
    """The trains for which the centre holds a block, and the routes."""
    return [(run.train, run.route) for run in sorted(system.centre.claimed.get(block, frozenset()))]
