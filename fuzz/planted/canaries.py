"""Canaries: a few planted faults that every campaign runs as well; one that does not find them has shown nothing.

One of each kind is drawn by the campaign's seed: in each of the three loops, at a point, after a restart,
and on board.  A canary that no run can find would silence every
campaign, so only faults that plain runs in CPython have found stand to be drawn (``reachable.toml``).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from random import Random

from fuzz.failures.replaying import UNDEFINED
from fuzz.planted.draw import Planted, described, planted
from fuzz.planted.reachable import reachable
from proofs.mutated import Sources

NOTHING_SHOWN = "its result is worth nothing"
"""What is said of a campaign that does not find a canary."""
MOST_SECONDS = 60.0
"""So long a canary may live."""

SOON = 16
"""A canary is a fault that one of so many walks finds, by a claim that is false: compiled code raises nothing."""


@dataclass(frozen=True)
class Kind:
    """A kind of canary: the machines or functions it may be in, and what it shows that the campaign can see."""

    name: str
    functions: tuple[str, ...]
    why: str


KINDS = (
    Kind("first loop", ("kernel.first_loop", "kernel.route_setting"), "a route is set or taken as it must not be"),
    Kind(
        "second loop",
        ("kernel.second_loop", "kernel.authority.may_proceed: condition"),
        "a train goes on whatever it read",
    ),
    Kind("third loop", ("kernel.tail_evidence", "kernel.release"), "a block is freed without its tail's evidence"),
    Kind("points", ("kernel.terminal",), "a point moves, or is confirmed, as it must not"),
    Kind("restart", ("kernel.restarts", "kernel.recovery"), "what was forgotten is not held as lost"),
    Kind("on board", ("kernel.onboard",), "a machine on board reckons wrongly"),
)
"""The kinds of canaries, in order."""


@dataclass(frozen=True)
class Canary:
    """A planted fault that a campaign must find.

    ``kind``, ``why``: what it stands for.  ``fault``: where it is and what is dropped.
    """

    kind: str
    why: str
    fault: Planted

    @property
    def name(self) -> str:
        """The mutant's name."""
        return self.fault.name

    @property
    def sources(self) -> Sources:
        """The kernel's functions with the fault."""
        return planted(self.name)


@cache
def findable() -> Mapping[Kind, tuple[str, ...]]:
    """The faults that may be drawn as canaries, by kind."""
    soon = sorted(
        name
        for walks in reachable().values()
        for name, shown in walks.items()
        if shown.walk < SOON and shown.violated != UNDEFINED
    )
    return {kind: tuple(name for name in soon if _is_of(kind, name)) for kind in KINDS}


def _is_of(kind: Kind, name: str) -> bool:
    return name.startswith(kind.functions)


def canaries(seed: int) -> tuple[Canary, ...]:
    """One canary of each kind, drawn by a seed; the same for the same seed."""
    random = Random(f"canaries {seed}")
    return tuple(Canary(kind.name, kind.why, described(random.choice(names))) for kind, names in findable().items())
