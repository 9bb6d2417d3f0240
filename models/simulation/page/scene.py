"""What the page shows, as data for its script: tracks in pixels, and for every few seconds where the trains are."""

from __future__ import annotations

from typing import Any

from models.simulation.crossing_state import State
from models.simulation.history import EVERY_S
from models.simulation.kilometres import Kilometres
from models.simulation.outcome import Outcome
from models.simulation.phases import Phase

COLOURS = (
    *("#1f6fb2", "#d9822b", "#23875a", "#8a5aab", "#0f9bb5", "#8c6d31", "#c2569b", "#5b6770", "#3f51b5", "#7cb342"),
    *("#b8860b", "#00897b", "#6a1b9a", "#a1887f", "#2e7d32", "#ad1457", "#0277bd", "#9e9d24", "#4e342e", "#ef8354"),
)
"""For trains; no red, which is kept for what goes wrong."""
WIDTH, LEFT, TOP, LANE = 1_240, 14, 24, 30
PHASES = tuple(Phase)


def track_of(kilometres: Kilometres) -> dict[str, Any]:
    """Every segment as a line in pixels from its low end to its high one; and where boundaries and points are."""
    plan, segments = kilometres.plan, kilometres.rails.segments
    column = (WIDTH - 2 * LEFT) / max(plan.columns, 1)
    lines = []
    for index in range(len(segments.segments)):
        left, right = plan.line[index]
        (x, lane), (to_x, to_lane) = plan.at[left], plan.at[right]
        own: float = TOP + LANE * plan.lane[index]
        x, to_x = LEFT + column * x, LEFT + column * to_x
        bend = min(12.0, abs(to_x - x) / 3) * (1 if to_x > x else -1)
        ends_y: tuple[float, float] = (TOP + LANE * lane, TOP + LANE * to_lane)
        bends = [(x, ends_y[0]), (x + bend, own), (to_x - bend, own), (to_x, ends_y[1])]
        low, high = kilometres.ends[index]
        flat = bends if low <= high else bends[::-1]
        lines.append([round(number, 1) for point in flat for number in point])
    marks = [[round(LEFT + column * x, 1), TOP + LANE * lane, node[1]] for node, (x, lane) in plan.at.items()]
    points = [mark for mark, node in zip(marks, plan.at, strict=True) if node[0] == "junction"]
    ends = [mark for mark, node in zip(marks, plan.at, strict=True) if node[0] != "junction"]
    return {"lines": lines, "ends": ends, "points": points, "height": TOP + LANE * plan.lanes}


def scene(found: Outcome) -> dict[str, Any]:
    """Everything that the script shows."""
    history, sim = found.history, found.sim
    kilometres = history.kilometres
    blocks = sorted(sim.play.site.layout.blocks, key=lambda block: (kilometres.of_block(block), block))
    number = {block: at for at, block in enumerate(blocks)}
    trains = [account.train for account in found.accounts]
    who: dict[str, int] = {train: at for at, train in enumerate(trains)}
    used = {stay.block for stay in history.stays if stay.there or stay.who in who}
    return {
        "every": EVERY_S,
        "end": sim.now_s,
        "km": max((max(ends) for ends in kilometres.ends.values()), default=1) / 1e6,
        "phases": [phase.value for phase in PHASES],
        "track": track_of(kilometres),
        "blocks": blocks,
        "shown": [number[block] for block in blocks if block in used],
        "of": [number[kilometres.rails.block[index]] for index in range(len(kilometres.ends))],
        "trains": [_train(found, train, COLOURS[at % len(COLOURS)]) for at, train in enumerate(trains)],
        "stays": [
            [number[stay.block], who.get(stay.who, -1), int(stay.there), stay.from_s, stay.to_s]
            for stay in history.stays
        ],
        "roads": [_road(found, state) for state in sim.crossings.states.values()],
        "events": [[round(event.at_ms / 1_000), event.kind, event.who, event.text] for event in sim.diary.events],
    }


def _road(found: Outcome, state: State) -> dict[str, Any]:
    """One crossing: where its road meets the tracks, in the diagram and along the line, and when it was closed."""
    kilometres = found.history.kilometres
    places = []
    for index, at_mm in state.ways.road.places:
        share, place_mm = kilometres.of_place(index, at_mm)
        places.append([index, round(1_000 * share), round(place_mm / 1_000)])
    return {
        "name": state.name,
        "places": places,
        "closings": state.closures(found.sim.now_s),
    }


def _train(found: Outcome, train: Any, colour: str) -> dict[str, Any]:
    """One train: its samples as columns."""
    samples = found.history.samples.get(train, [])
    return {
        "name": train,
        "colour": colour,
        "segment": [each.segment for each in samples],
        "share": [round(1_000 * each.share) for each in samples],
        "m": [round(each.place_mm / 1_000) for each in samples],
        "kmh": [round(each.speed_mm_s * 0.0036) for each in samples],
        "phase": [PHASES.index(each.phase) for each in samples],
    }
