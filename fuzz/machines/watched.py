"""A play that is watched: every invariant after every step that changed something, and what led there as a trace."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from fuzz.failures.replaying import ERRORS, UNDEFINED, holds
from fuzz.failures.trace import LayoutFile, Trace, layout_file, recorded
from fuzz.planted.draw import name_of
from kernel.names import Block, Car, Point, Position, Train
from models.simulator.play import Play
from models.world.start import start
from models.world.state import Site, System
from proofs.catalogue import INVARIANTS, STEPS
from proofs.mutated import Sources, running


@dataclass(frozen=True)
class Place:
    """Where a play begins: the layout's file, the site made of it, where cars stand and how points lie."""

    file: Path
    site: Site
    trains: Mapping[Train, tuple[Car, ...]]
    at: Mapping[Car, frozenset[Block]]
    lies: Mapping[Point, Position]

    def named(self, beside: Path) -> LayoutFile:
        """The layout file as a trace in the folder ``beside`` names it."""
        return layout_file(self.file, beside)


class Broken(AssertionError):
    """Something claimed is false; ``trace`` says what led there."""

    def __init__(self, trace: Trace) -> None:
        super().__init__(f"{', '.join(trace.violated)} after {len(trace.events)} steps")
        self.trace = trace


class WatchedPlay(Play):
    """A play of the world with a fault planted in the kernel, judged by the invariants as they are.

    The fault runs while a step is taken and not while it is judged: some invariants ask the kernel.
    """

    def __init__(self, place: Place, sources: Sources, beside: Path = Path()) -> None:
        super().__init__(place.site, start(place.site, place.at, place.lies), steps=STEPS)
        self.place = place
        self.sources = sources
        self.beside = beside
        self.taken: list[tuple[str, Mapping[str, Any]]] = []

    def take(self, step: str, **event: Any) -> bool:
        """Try a step; tell whether it changed anything.

        Raises:
            Broken: the step is not defined, or an invariant is false after it.
        """
        try:
            with running(self.sources):
                changed = super().take(step, **event)
        except ERRORS as error:
            self.taken.append((step, event))
            raise Broken(self.trace((UNDEFINED,))) from error
        if changed:
            self.taken.append((step, event))
            false = judged(self.site, self.system)
            if false:
                raise Broken(self.trace(false))
        return changed

    def trace(self, violated: tuple[str, ...] = ()) -> Trace:
        """What has been taken so far, as a trace."""
        place = self.place
        trace = recorded(place.named(self.beside), place.trains, place.at, place.lies, self.taken)
        return replace(trace, violated=violated, at_step=len(self.taken) if violated else None, planted=self.planted)

    @property
    def planted(self) -> str | None:
        """The name of the planted fault; none where the kernel is as it is."""
        return name_of(self.sources) if self.sources else None


def judged(site: Site, system: System) -> tuple[str, ...]:
    """The invariants that are false now; one that cannot be told is false."""
    return tuple(name for name in INVARIANTS if not holds(name, site, system))
