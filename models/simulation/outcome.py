"""What a simulation has come to: where every train ended, what was broken, what stands in whose way."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Literal

from kernel.link import Outcome as Delivery
from kernel.names import Stage, Train
from models.simulation.beginning import Plan
from models.simulation.crossing_state import State
from models.simulation.faults import Chosen
from models.simulation.history import History
from models.simulation.links import CENTRE
from models.simulation.oracles import ORACLES, Violation
from models.simulation.phases import Phase
from models.simulation.service import Service
from models.simulation.simulation import Simulation
from models.simulation.waiting import deadlocked, explained

Ended = Literal["arrived", "stands", "runs", "waits", "stopped"]
"""Arrived at its last goal; stands till its next trip; is under way; waits for others; was stopped by a fault."""


@dataclass(frozen=True)
class Account:
    """Where a train ended: in words, with what it did till then."""

    train: Train
    ended: Ended
    text: str
    blocks: tuple[str, ...]
    trips_done: int
    trips: int
    way_mm: int


def account(sim: Simulation, service: Service) -> Account:
    """Say where a train ended, and why there."""
    ended, text = _state(sim, service)
    return Account(
        train=service.train,
        ended=ended,
        text=text,
        blocks=tuple(sorted(service.under)),
        trips_done=service.done,
        trips=len(service.trips),
        way_mm=round(service.vehicle.way_mm),
    )


def _state(sim: Simulation, service: Service) -> tuple[Ended, str]:
    if service.phase is Phase.OFF:
        return "stopped", "has parted, and was taken off the line"
    if service.phase is Phase.STATED:
        return "stopped", "has parted; two persons have stated where it stands"
    if service.phase is Phase.PARTED:
        return "stopped", "has parted; staff is under way"
    if service.phase is Phase.LOST:
        why = [each.text for each in sim.diary.events if each.who == service.train and each.kind in ("brake", "fault")]
        return "stopped", f"is to tell where it stands; last: {why[-1] if why else 'the beginning'}"
    if service.phase is Phase.RUNS:
        run = service.run
        return "runs", f"'{run.route if run else ''}' at {service.vehicle.speed_mm_s * 0.0036:.0f} km/h"
    if service.phase is Phase.WAITS and service.run is not None:
        return "waits", f"'{service.run.route}' is being set; {_unset(sim, service)}"
    return _standing(sim, service)


def _unset(sim: Simulation, service: Service) -> str:
    """What a run that is being set still lacks."""
    assert service.run is not None
    grant = sim.play.system.centre.runs.get(service.run)
    if grant is None or grant.stage != Stage.RESERVED:
        return "the first loop is not closed yet"
    unproved = sorted(frozenset(sim.play.site.layout.needs[service.run.route]) - grant.proved)
    return f"not proved: {', '.join(unproved) or 'nothing'}"


def _standing(sim: Simulation, service: Service) -> tuple[Ended, str]:
    if not service.trips:
        return "stands", "no place to go to has been free"
    if service.finished:
        return "arrived", "at its last goal"
    goal, begins_s = service.trips[service.done].goal, service.trips[service.done].begins_s
    if service.waits:
        way = service.waits[0]
        others = ", ".join(sorted(way.by)) or "nobody: lost since the restart"
        if not service.begun:
            return "waits", f"cannot make for {goal} past {others}, at {', '.join(way.where[:2])}"
        return "waits", f"wants '{way.route}': {way.refusal.value} ({others}, at {', '.join(way.where[:2])})"
    if service.no_way:
        return "stopped", f"no route leads from where it stands to {goal}"
    if service.begun:
        return "waits", f"makes for {goal}, and lets others pass first"
    if sim.now_s < begins_s:
        return "stands", f"until its next trip, at {begins_s // 60} min"
    return "waits", f"cannot make for {goal} without barring another's way"


@dataclass(frozen=True)
class Outcome:
    """The end of a simulation.

    ``judged``: how often each invariant of the proofs was asked beside the oracles.
    """

    plan: Plan
    sim: Simulation
    history: History
    accounts: tuple[Account, ...]
    deadlocks: tuple[str, ...]
    stuck: frozenset[Train]
    judged: Mapping[str, int]

    @property
    def broken(self) -> tuple[Violation, ...]:
        """Everything that must be true and was not."""
        return tuple(self.sim.oracles.found)

    @property
    def holds(self) -> bool:
        """Whether nothing was broken, and a timetable of so many trips came to its end."""
        return not self.broken and (self.plan.trips is None or self.sim.ended)

    @property
    def timetable_to_blame(self) -> bool:
        """Whether trains in deadlock are held up only where another stands, and by no lock that is left over."""
        sim, layout = self.sim, self.sim.play.site.layout
        taken = {block for service in sim.services.values() for block in service.under}
        return all(
            place in taken or place in layout.points
            for train in self.stuck
            for way in sim.waits[train]
            for place in way.where
        )

    @property
    def came(self) -> Mapping[str, int]:
        """How often each fault came that was chosen."""
        counted = self.sim.diary.faults + self.sim.line.seen + self.sim.air.seen + self.sim.motors.seen
        return {name: counted[name] for name in self.plan.chosen}

    @property
    def delivered(self) -> int:
        """How many telegrams were delivered."""
        return self.sim.links.outcomes[Delivery.DELIVERED.value]

    @property
    def refused(self) -> Mapping[str, int]:
        """How many telegrams were refused, by why, the most first."""
        counted = self.sim.links.outcomes.most_common()
        return {why: count for why, count in counted if why != Delivery.DELIVERED.value}

    @property
    def train_seconds(self) -> int:
        """Trains times simulated seconds."""
        return self.plan.trains * self.sim.now_s

    def record(self) -> dict[str, Any]:
        """As it is written to a file: the same for the same layout, options and seed."""
        sim = self.sim
        return {
            "verdict": "holds" if self.holds else "does not hold",
            "layout": self.plan.imported.name.rsplit("/", 1)[-1],
            "seed": self.plan.seed,
            "trains": self.plan.trains,
            "trips": self.plan.trips,
            "hours": self.plan.hours,
            "simulated_s": sim.now_s,
            "ended": sim.ended if self.plan.trips is not None else None,
            "faults": _faults(self.plan.chosen, self.came),
            "broken": [{"claim": each.oracle, "at_ms": each.at_ms, "text": each.text} for each in self.broken],
            "oracles": {name: {"says": says, "checked": sim.oracles.checked[name]} for name, says in ORACLES.items()},
            "invariants": dict(self.judged),
            "accounts": [vars(each) | {"blocks": list(each.blocks)} for each in self.accounts],
            "deadlocks": list(self.deadlocks),
            "steps": dict(sorted(sim.diary.steps.items())),
            "telegrams": _telegrams(sim),
            "crossings": {name: _road(sim, state) for name, state in sim.crossings.states.items()},
            "events": [vars(event) for event in sim.diary.events],
            "occupation": [vars(stay) for stay in self.history.stays],
        }


def _telegrams(sim: Simulation) -> dict[str, Any]:
    """What became of all that was sent, and for how long centre and units did not hear each other."""
    links = sim.links
    return {
        "sent": sim.air.sent,
        "lost": sim.air.lost,
        "mended": links.mended,
        "arrived": dict(sorted(links.outcomes.items())),
        "unheard_s": {
            train: {"by the centre": links.unheard_s[CENTRE, unit], "on board": links.unheard_s[unit, CENTRE]}
            for train, unit in links.addresses.unit.items()
        },
    }


def _road(sim: Simulation, state: State) -> dict[str, Any]:
    """How long a road was closed, each time from and to, how many trains came, and after how long at the least."""
    return {
        "closed_s": state.closed_in_all_s(sim.now_s),
        "trains": state.passed,
        "least_warning_s": state.least_s,
        "closings": state.closures(sim.now_s),
    }


def _faults(chosen: Chosen, came: Mapping[str, int]) -> dict[str, Any]:
    """Each fault as it was set, and how often it came."""
    return {
        name: {**vars(setting), "at_s": list(setting.at_s), "came": came.get(name, 0)}
        for name, setting in chosen.items()
    }


def outcome(sim: Simulation, history: History, judged: Mapping[str, int]) -> Outcome:
    """Sum a simulation up."""
    history.close(sim.now_s)
    return Outcome(
        plan=sim.plan,
        sim=sim,
        history=history,
        accounts=tuple(account(sim, service) for service in sim.services.values()),
        deadlocks=tuple(explained(sim.waits, sim.gone)),
        stuck=deadlocked(sim.waits, sim.gone),
        judged=judged,
    )
