"""Plays a run of the radio link again: what is sent and which threats strike follow from its numbers."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from fuzz.failures.replaying import sources_of
from fuzz.failures.trace import LinkTrace
from models.layouts import BadInput
from proofs.mutated import running


@dataclass(frozen=True)
class Played:
    """A run: its events, ``changed``: how many changed something, and the claims that are false after the last."""

    trace: LinkTrace
    events: tuple[tuple[str, Mapping[str, Any]], ...]
    changed: int
    violated: tuple[str, ...]

    @property
    def as_told(self) -> bool:
        """Whether it came to what the trace says."""
        when = self.trace.at_step in (None, len(self.events))
        return self.violated == self.trace.violated and (when or not self.violated)

    @property
    def verdict(self) -> str:
        """What it came to, on one line."""
        if self.violated:
            return f"reproduced: {', '.join(self.violated)} violated after step {len(self.events)}"
        return f"not reproduced: nothing is violated in {len(self.events)} steps"


def play_again(trace: LinkTrace) -> Played:
    """Play it.

    Raises:
        BadInput: the trace names a planted fault that is not known, or weights of other threats.
    """
    from fuzz.channel.threats import THREATS
    from fuzz.targets.link import played
    from fuzz.targets.target import Batch

    if trace.weights and len(trace.weights) != len(THREATS):
        what = f"has {len(trace.weights)} items; there are {len(THREATS)} threats"
        raise BadInput("trace", "weights", what, "replay it with the version that found it")
    with running({} if trace.planted is None else sources_of(trace.planted)):
        run = played(Batch("link", trace.batch, trace.seed, trace.weights), trace.run)
    return Played(trace, tuple(run.events), run.changed, tuple(run.violated))
