"""Runs a walk, or a batch of jolted states, again: what they do follows from their numbers."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from random import Random

from fuzz.failures.replaying import sources_of
from fuzz.failures.trace import BatchTrace
from models.layouts import BadInput


@dataclass(frozen=True)
class Again:
    """What a run came to: the claims that are false, and how many steps it took to find that, or nothing."""

    trace: BatchTrace
    steps: int
    violated: tuple[str, ...]

    @property
    def verdict(self) -> str:
        """What it came to, on one line."""
        if self.violated:
            return f"reproduced: {', '.join(self.violated)} violated, {self.steps:,} steps taken"
        return f"not reproduced: nothing is violated in {self.steps:,} steps"


def run_again(trace: BatchTrace, path: Path) -> Again:
    """Run it; ``path``: the trace's file, from whose folder its layout is named.

    Raises:
        BadInput: what the trace names is not there, or not known.
    """
    return _walked(trace, path) if trace.target == "walks" else _jolted(trace, path)


def _walked(trace: BatchTrace, path: Path) -> Again:
    from fuzz.targets.walks import walked
    from proofs.theories import THEORIES

    if trace.theory not in THEORIES:
        what = f"there is no theory '{trace.theory}'"
        raise BadInput(str(path), "theory", what, "replay it with the version that found it")
    sources = {} if trace.planted is None else sources_of(trace.planted)
    steps, failure = walked(trace.theory, sources, Random(f"{trace.seed} {trace.batch} {trace.walk}"))
    return Again(trace, len(steps), () if failure is None else _names(failure["violated"]))


def _jolted(trace: BatchTrace, path: Path) -> Again:
    import json

    from fuzz.targets.jolted import Jolted
    from fuzz.targets.target import Batch

    layout = path.parent / trace.layout
    if not layout.is_file():
        what = f"the layout {layout} is not there"
        raise BadInput(str(path), "layout.file", what, "put it there, from the campaign's folder")
    if trace.planted is not None:
        sources_of(trace.planted)
    target = Jolted(layout, trace.planted)
    result = target.run(Batch(target.name, trace.batch, trace.seed, ()))
    found = [_names(json.loads(text)["violated"]) for text in result.failures]
    same = [each for each in found if each == trace.violated]
    return Again(trace, result.steps, (same or found or [()])[0])


def _names(violated: object) -> tuple[str, ...]:
    assert isinstance(violated, list | tuple)
    return tuple(map(str, violated))
