"""A step and what it came to, in words: for the table on a terminal and for the page."""

from __future__ import annotations

import inspect
from collections.abc import Mapping
from dataclasses import fields
from enum import Enum
from typing import Any

from fuzz.failures.replaying import UNDEFINED, Outcome, Replay
from kernel.names import Read, Run
from kernel.standstill import Standstill, ThroughLine
from models.world import assumptions
from proofs.catalogue import INVARIANTS, STEPS


def told(event: Mapping[str, Any]) -> str:
    """What an event says, on one line."""
    return ", ".join(f"{name.replace('_', ' ')} {value_in_words(value)}" for name, value in event.items())


def value_in_words(value: Any) -> str:
    """One value of an event."""
    if isinstance(value, Run):
        return f"#{value.serial} {value.train} “{value.route}”" + (f" life {value.life}" if value.life != 1 else "")
    if isinstance(value, Read):
        return f"{value.tag} “{value.record}”"
    if isinstance(value, Standstill | ThroughLine):
        return ", ".join(f"{field.name} {value_in_words(getattr(value, field.name))}" for field in fields(value))
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, Enum):
        return str(value.value)
    if isinstance(value, frozenset):
        return "{" + ", ".join(sorted(value)) + "}"
    return str(value)


def meaning(step: str) -> str:
    """What a transition is, in a sentence."""
    return (inspect.getdoc(STEPS[step]) or step).splitlines()[0]


def claim(name: str) -> str:
    """What an invariant says, in a sentence."""
    if name == UNDEFINED:
        return "No step and no invariant looks up what is not there."
    return (inspect.getdoc(INVARIANTS[name]) or name).splitlines()[0]


def assumption(name: str) -> str:
    """What an assumption about nature says, in a sentence."""
    return (inspect.getdoc(getattr(assumptions, name)) or name).splitlines()[0]


def comes_to(outcome: Outcome) -> str:
    """What a step came to: nothing is said of one that changed something and broke nothing."""
    said = []
    if outcome.broken:
        said.append(f"beyond {', '.join(outcome.broken)}")
    if outcome.raised:
        said.append(f"raised {outcome.raised}")
    elif outcome.refusal is not None:
        said.append(f"refused: {outcome.refusal.value}")
    elif not outcome.changed:
        said.append("nothing changes")
    if outcome.violated:
        said.append(f"VIOLATED {', '.join(outcome.violated)}")
    return "; ".join(said)


def headline(replay: Replay) -> str:
    """The verdict, in short where many things are violated."""
    if len(replay.violated) < 3:
        return verdict(replay)
    when = f"after step {replay.at_step}" if replay.at_step else "at the start"
    return f"reproduced: {len(replay.violated)} invariants violated {when}"


def verdict(replay: Replay) -> str:
    """What a replay came to, on one line."""
    if not replay.reproduced:
        return f"not reproduced: nothing is violated in {len(replay.outcomes)} steps"
    if replay.at_step == 0:
        return f"reproduced: {', '.join(replay.violated)} violated at the start"
    return f"reproduced: {', '.join(replay.violated)} violated after step {replay.at_step}"


def otherwise(replay: Replay) -> str:
    """What the trace says instead, where the replay came to something else; empty where it did not."""
    trace = replay.trace
    first = trace.violated[0] if trace.violated else None
    if replay.at_step == trace.at_step and (first in replay.violated or first is None):
        return ""
    if first is None:
        return "the trace says that nothing is violated" if replay.reproduced else ""
    return f"the trace says: {', '.join(trace.violated)} violated after step {trace.at_step}"
