"""Writes the page: everything in one file, nothing loaded from anywhere."""

from __future__ import annotations

from typing import Any

from fuzz.failures.page.diagram import TOP, Diagram, Drawing
from fuzz.failures.page.moments import FIRST_LOOP, changes
from fuzz.failures.replaying import Outcome, Replay
from fuzz.failures.trace import TRAFFIC
from fuzz.failures.words import assumption, claim, comes_to, headline, meaning, otherwise, told
from models.whole_page import script_data, template_of


def page_of(replay: Replay, name: str) -> str:
    """The page of a replay as HTML; ``name`` is that of the trace's file."""
    drawn = Drawing(replay).drawn()
    return template_of("fuzz.failures.page").render(
        name=name,
        trace=replay.trace,
        headline=headline(replay),
        otherwise=otherwise(replay),
        reproduced=replay.reproduced,
        claims=[(each, claim(each)) for each in replay.violated],
        broken=[(each, assumption(each)) for each in replay.broken],
        drawn=drawn,
        top=TOP,
        steps=[_step(outcome) for outcome in replay.outcomes],
        failure=replay.at_step,
        last=len(replay.outcomes),
        data=script_data(_data(replay, drawn)),
    )


def _step(outcome: Outcome) -> dict[str, Any]:
    """One entry of the list of steps."""
    kinds = {
        "violation": bool(outcome.violated),
        "beyond": outcome.event.beyond,
        "fault": outcome.event.by != TRAFFIC,
        "refused": not outcome.changed and not outcome.violated,
    }
    return {
        "number": outcome.number,
        "step": outcome.event.step,
        "by": outcome.event.by,
        "told": told(outcome.event.event),
        "comes_to": comes_to(outcome),
        "kinds": " ".join(kind for kind, so in kinds.items() if so),
    }


def _data(replay: Replay, drawn: Diagram) -> dict[str, Any]:
    """What the page's script shows."""
    return {
        "last": len(replay.outcomes),
        "failure": replay.at_step,
        "loop": FIRST_LOOP,
        "changes": changes(replay),
        "meanings": {step: meaning(step) for step in sorted({outcome.event.step for outcome in replay.outcomes})},
        "colours": drawn.colours,
        "concerns": drawn.concerns,
    }
