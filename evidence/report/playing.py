"""Witnesses as they are played, for the page: what each step was, and what it changed.

They are played anew from the sources; whether they go as they say is what the record of tests tells.
"""

from __future__ import annotations

import functools
import inspect
from collections import deque
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cache
from typing import Any
from unittest.mock import patch

from evidence.report.words import first_sentence, shortened
from proofs.drawing import rows, step_in_words
from proofs.mutants.plays import witnesses
from proofs.theories import THEORIES

PLAYED = 1_500
"""A witness of plain arithmetic may take thousands of steps, alike; so many are played."""
FIRST, LAST = 12, 60
"""So many steps are kept of the beginning, and of the end."""
ABOVE, BELOW = 4, 10
"""So many rows are shown of them."""
WORDS = 150
"""Characters of a cell."""


@dataclass(frozen=True)
class Call:
    """One step as it was taken."""

    name: str
    event: Mapping[str, Any]
    before: Any
    after: Any


@dataclass(frozen=True)
class Step:
    """Steps of one name in a row that changed the same fields: how many, the last event, and each field's change."""

    name: str
    times: int
    told: str
    changed: tuple[tuple[str, str, str], ...]


@dataclass(frozen=True)
class Table:
    """A witness as a table: how it begins, so many steps between, and how it ends, or where it is broken off."""

    name: str
    says: str
    begins: tuple[Step, ...]
    between: int
    ends: tuple[Step, ...]
    broken_off: bool


class _Enough(Exception):
    """So many steps are all that is played."""


class _Notes:
    """The first steps and the last, and how many there were."""

    def __init__(self) -> None:
        self.first: list[Call] = []
        self.last: deque[Call] = deque(maxlen=LAST)
        self.count = 0

    def note(self, call: Call) -> None:
        """Keep a step."""
        if self.count >= PLAYED:
            raise _Enough
        self.count += 1
        (self.first if len(self.first) < FIRST else self.last).append(call)


@cache
def tables(theory: str) -> Sequence[Table]:
    """Every witness of a theory beside the interlocking, as a table."""
    return [_table(theory, name, witness) for name, witness in witnesses(theory).items()]


def _table(theory: str, name: str, witness: Callable[[], Any]) -> Table:
    notes, known, broken_off = _Notes(), THEORIES[theory].steps, False
    with patch.dict(known, {step: _noting(step, function, notes) for step, function in known.items()}):
        try:
            witness()
        except _Enough:
            broken_off = True
    says = first_sentence(inspect.getdoc(witness) or "")
    if notes.count <= FIRST + LAST:
        steps = _merged([_step(each) for each in (*notes.first, *notes.last)])
        if len(steps) <= ABOVE + BELOW:
            return Table(name, says, tuple(steps), 0, (), broken_off)
        begins, ends = steps[:ABOVE], steps[-BELOW:]
    else:
        begins = _merged([_step(each) for each in notes.first])[:ABOVE]
        ends = _merged([_step(each) for each in notes.last])[-BELOW:]
    between = notes.count - sum(each.times for each in (*begins, *ends))
    return Table(name, says, tuple(begins), between, tuple(ends), broken_off)


def _noting(name: str, function: Callable[..., Any], notes: _Notes) -> Callable[..., Any]:
    names = list(inspect.signature(function).parameters)

    @functools.wraps(function)
    def run(*values: Any, **named: Any) -> Any:
        after = function(*values, **named)
        told = {**dict(zip(names, values, strict=False)), **named}
        event = {key: value for key, value in told.items() if key not in ("site", "system")}
        notes.note(Call(name, event, told["system"], after))
        return after

    return run


def _step(call: Call) -> Step:
    changed = tuple(
        (row.what, shortened(row.before, WORDS), shortened(row.after, WORDS)) for row in rows(call.before, call.after)
    )
    told = step_in_words(call.name, call.event).removeprefix(call.name).strip()
    return Step(call.name, 1, shortened(told.removeprefix("(").removesuffix(")"), WORDS), changed)


def _merged(noted: Sequence[Step]) -> list[Step]:
    """Steps alike in a row as one: from the value before the first to that after the last."""
    found: list[Step] = []
    for step in noted:
        last = found[-1] if found else None
        if last and last.name == step.name and [row[0] for row in last.changed] == [row[0] for row in step.changed]:
            joined = zip(last.changed, step.changed, strict=True)
            changed = tuple((what, before, after) for (what, before, _), (_, _, after) in joined)
            found[-1] = replace(step, times=last.times + 1, changed=changed)
        else:
            found.append(step)
    return found
