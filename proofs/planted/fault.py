"""A fault: its story, and the functions that take the place of the kernel's."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from proofs.lift.sources import Code, definition_of
from proofs.mutants.edits import named
from proofs.mutated import Sources


@dataclass(frozen=True)
class Fault:
    """One protocol with a fault.

    ``story``: what is wrong with it, in a line.
    ``transition``: the step that shows it in a small world.
    ``instead``: for each function the one that takes its place.  The names in that one are looked
    up in the module of the function replaced.
    ``without``: the layout axioms and premises that are not given.
    ``dropped``: guards that are dropped, each by its name as ``heisoku mutate --only`` knows it.
    """

    name: str
    story: str
    transition: str
    instead: Mapping[Code, Code] = field(default_factory=dict)
    without: frozenset[str] = frozenset()
    dropped: tuple[str, ...] = ()

    @property
    def sources(self) -> Sources:
        """The replacements as syntax trees."""
        own = {function: definition_of(other) for function, other in self.instead.items()}
        return {**own, **{function: tree for name in self.dropped for function, tree in named(name).sources.items()}}
