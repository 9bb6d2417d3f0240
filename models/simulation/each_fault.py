"""One fault after the other, each in a simulation of its own: what stays locked after it, and how long.

A block is left locked while it is held for a train that is not in it and has it not ahead, though the train has left
the end of the part with which it is released (T7), or while it is lost since a restart.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence, Set
from dataclasses import dataclass, replace

from kernel.names import Block, Run
from models.simulation.beginning import Plan
from models.simulation.faults import FAULTS, NO_FAULT, Fault, Setting
from models.simulation.outcome import account
from models.simulation.phases import Phase
from models.simulation.service import Service
from models.simulation.simulation import Simulation

HOUR_S = 3_600.0
TIMES = {"hour": 2, "train hour": 12, "point hour": 12, "crossing hour": 12}
"""A fault is put in so many times, evenly from a tenth of the time to its half; the rest is for the way out."""
SHARE, LEAST_SHARE = 5.0, 0.01
"""A chance that is usually small is taken so many times as often, and a little more."""
EVERY_S = 5
SHORT_S = 30
"""What is released so soon was not left locked: that is how long reports may take."""
STUCK_S = 900
"""What stays locked for so long up to the end has found no way out."""


@dataclass(frozen=True)
class Row:
    """What a fault did.

    ``came``: so many times.  ``held``: what was left locked longest, ``longest_s`` so long.  ``at_the_end``: what
    still is, and trains that staff has yet to attend.  ``broken``: what must be true and was not.
    """

    fault: str
    came: int
    held: str
    longest_s: int
    at_the_end: str
    way_out: str
    broken: str
    holds: bool


def setting(fault: Fault, hours: float) -> Setting:
    """How a fault comes when it is tried alone."""
    if fault.is_share:
        return Setting(LEAST_SHARE + SHARE * fault.rate, fault.least, fault.most)
    many = TIMES[fault.per]
    at_s = tuple(round(hours * HOUR_S * (0.1 + 0.4 * turn / many), 1) for turn in range(many))
    return Setting(0.0, fault.least, fault.most, at_s)


def left_locked(sim: Simulation) -> Iterator[tuple[Block, str]]:
    """The blocks that are left locked now, and for whom."""
    layout, owned = sim.play.site.layout, dict[Run, Set[Block]]()
    for block, runs in sim.play.system.centre.claimed.items():
        for run in runs:
            if run not in owned:
                service = sim.services[run.train]
                owned[run] = service.under | _ahead(service, run)
            part_end = layout.released_after.get(run.route, {}).get(block)
            if block not in owned[run] and part_end not in owned[run]:
                yield block, run.train
    for block in sorted(sim.play.system.centre.lost_blocks):
        yield block, "the restart"


def _ahead(service: Service, run: Run) -> Set[Block]:
    """The blocks of a run that its train has ahead, from where it is, or all of it before it begins."""
    layout, found = service.play.site.layout, set[Block]()
    way = layout.way.get(run.route, {})
    todo = list(service.under & frozenset(way))
    if not todo and run in (service.run, service.onward):
        todo = [layout.start[run.route]]
    while todo:
        block = todo.pop()
        found.add(block)
        onward = way.get(block)
        if onward is not None and onward not in found:
            todo.append(onward)
    return found


def each(plan: Plan, progress: Callable[[int, int, str], object] = lambda done, of, name: None) -> list[Row]:
    """Try no fault, and every fault that was chosen, one after the other."""
    chosen = [fault for fault in FAULTS if fault.name in plan.chosen and (plan.roads or fault.per != "crossing hour")]
    rows = [_tried(replace(plan, chosen=NO_FAULT), "none", "nothing")]
    for done, fault in enumerate(chosen, start=1):
        progress(done, len(chosen), fault.name)
        alone = replace(plan, chosen={fault.name: setting(fault, plan.hours)})
        rows.append(_tried(alone, fault.name, fault.way_out))
    return rows


def _tried(plan: Plan, name: str, way_out: str) -> Row:
    sim, since, longest = Simulation(plan), dict[tuple[Block, str], int](), dict[tuple[Block, str], int]()

    def look(now: Simulation) -> None:
        if now.now_s % EVERY_S:
            return
        present = dict.fromkeys(left_locked(now))
        for gone in [key for key in since if key not in present]:
            del since[gone]
        for key in present:
            began = since.setdefault(key, now.now_s)
            longest[key] = max(longest.get(key, 0), now.now_s - began)

    sim.run(look)
    worst = max(longest, key=lambda key: (longest[key], key), default=None)
    kept = {key: seconds for key, seconds in longest.items() if seconds > SHORT_S}
    stuck = [key for key, began in since.items() if sim.now_s - began > STUCK_S]
    lost = [
        train for train, each in sim.services.items() if each.phase is Phase.LOST and sim.now_s - each.since_s > STUCK_S
    ]
    broken = "; ".join(f"{each.oracle}: {each.text}" for each in sim.oracles.found[:1])
    counted = sim.diary.faults + sim.line.seen + sim.air.seen + sim.motors.seen
    return Row(
        fault=name,
        came=counted[name],
        held=f"{len(kept)} blocks, longest {worst[0]} for {worst[1]}" if kept and worst else "nothing",
        longest_s=longest[worst] if kept and worst else 0,
        at_the_end=_at_the_end(sim, [key for key, began in since.items() if sim.now_s - began > SHORT_S]),
        way_out=way_out,
        broken=broken,
        holds=not broken and not stuck and not lost,
    )


def _at_the_end(sim: Simulation, left: Sequence[tuple[Block, str]]) -> str:
    """What is still locked, and which trains were stopped."""
    blocks = {block for block, _ in left}
    stopped = [train for train, service in sim.services.items() if account(sim, service).ended == "stopped"]
    told = [f"{len(blocks)} blocks locked"] * bool(blocks) + [f"stopped: {', '.join(stopped)}"] * bool(stopped)
    return "; ".join(told) or "nothing"
