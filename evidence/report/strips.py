"""Witnesses of the interlocking as strips of track: blocks in a row, trains on them, whom they are held for."""

from __future__ import annotations

import inspect
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cache

from evidence.report.words import first_sentence
from kernel.names import Block, Train
from models.world.state import Site, System
from proofs.drawing import run_of, step_in_words
from proofs.sketch import Plan, plan, signs
from proofs.witnesses.registry import WITNESSES
from proofs.witnesses.scenario import STEPS, Scenario, Taken

COLUMN, LANE, HEIGHT = 66, 25, 15
"""Pixels: from block to block, from lane to lane, and a block's height."""
COLOURS = 4
"""So many colours trains are told apart by; the page has them."""


@dataclass(frozen=True)
class Cell:
    """A block at one moment: where it is drawn, the colour of the train on it and of that it is held for, by number.

    ``points``: each as it lies, with whether its terminal is unlocked; ``told``: all of it in words.
    """

    block: str
    x: int
    y: int
    on: int | None
    held: int | None
    lost: bool
    points: tuple[tuple[str, bool], ...]
    told: str


@dataclass(frozen=True)
class Moment:
    """The track after some steps; ``first`` to ``last``: their numbers; steps that were refused are told as such."""

    first: int
    last: int
    steps: tuple[str, ...]
    cells: tuple[Cell, ...]


@dataclass(frozen=True)
class Strip:
    """A witness: every moment at which something on the track changed; ``trains``: in the order of their colours."""

    name: str
    says: str
    width: int
    height: int
    trains: tuple[str, ...]
    moments: tuple[Moment, ...]


@cache
def strips() -> Sequence[Strip]:
    """Every witness of the interlocking, played."""
    return [_strip(name, first_sentence(inspect.getdoc(one) or ""), one(STEPS)) for name, one in WITNESSES.items()]


def _strip(name: str, says: str, scenario: Scenario) -> Strip:
    site, taken = scenario.site, scenario.taken
    runs = (run_of(each.event) for each in taken)
    run = next((each for each in runs if each is not None and each.route in site.layout.routes), None)
    placed = plan(site, site.layout.blocks, run)
    trains = sorted(site.layout.fleet)
    moments = tuple(_moments(site, taken, placed, {train: place for place, train in enumerate(trains)}))
    return Strip(name, says, placed.columns * COLUMN, placed.lanes * LANE, tuple(trains), moments)


def _moments(site: Site, taken: Sequence[Taken], placed: Plan, order: Mapping[Train, int]) -> Iterator[Moment]:
    """The moments: steps that move, hold and throw nothing stand with the next that does."""
    steps: list[str] = []
    shown: tuple[Cell, ...] = ()
    first = 1
    for number, each in enumerate(taken, 1):
        steps.append(_in_words(each))
        cells = tuple(_cells(site, each.after, placed, order))
        seen = tuple(replace(cell, lost=False, told="") for cell in cells)
        if seen != shown or number == len(taken):
            yield Moment(first, number, tuple(steps), cells)
            steps, shown, first = [], seen, number + 1


def _in_words(taken: Taken) -> str:
    told = step_in_words(taken.step, taken.event)
    if taken.accepted:
        return told
    return f"refused: {told}" + (f": {taken.why.name.lower().replace('_', ' ')}" if taken.why is not None else "")


def _cells(site: Site, system: System, placed: Plan, order: Mapping[Train, int]) -> Iterator[Cell]:
    for block, sign in signs(site, system).items():
        if block not in placed.at:
            continue
        column, lane = placed.at[block]
        on = order.get(sign.trains[0]) if sign.trains else None
        holders = [order[run.train] for run in sorted(system.centre.claimed.get(block, ())) if run.train in order]
        points = tuple(_points(site, system, block))
        told = "; ".join(sign.lines())
        held = holders[0] if holders else None
        yield Cell(block, column * COLUMN + 2, lane * LANE + 2, on, held, sign.lost, points, told)


def _points(site: Site, system: System, block: Block) -> Iterator[tuple[str, bool]]:
    for point in sorted(site.layout.points_in.get(block, frozenset())):
        terminal = system.terminals.get(point)
        lies = system.track.lies.get(point)
        yield f"{point} {lies or '?'}", terminal is None or terminal.unlocked
