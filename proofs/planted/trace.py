"""A reachable trace: a scripted run from a restart, with the kernel as it is or with a fault in it."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any

from kernel.refusal import Refusal
from models.world.state import Site, System
from proofs.catalogue import INVARIANTS, SAFETY
from proofs.mutated import Sources, table_running
from proofs.witnesses.changes import Changes, changes
from proofs.witnesses.scenario import STEPS, WHY_REFUSED, Scenario


@dataclass(frozen=True)
class Move:
    """One step of a trace; ``broken`` are the claims that are false after it, of those that are watched."""

    transition: str
    event: Mapping[str, Any]
    before: System
    after: System
    broken: tuple[str, ...]


class Stopped(Exception):
    """The kernel did not go along with a step of the script."""

    def __init__(self, transition: str, why: Refusal | None) -> None:
        """Note which step, and the reason where the kernel gives one."""
        super().__init__(f"{transition}: {why.value if why else 'nothing happens'}")
        self.transition = transition
        self.why = why


class Violated(Exception):
    """The claim that the script is to break is broken."""


@dataclass
class Trace:
    """What a script came to."""

    site: Site
    moves: list[Move] = field(default_factory=list)
    stopped: Stopped | None = None

    @property
    def broken(self) -> tuple[str, ...]:
        """The claims that are false at the end."""
        return self.moves[-1].broken if self.moves else ()

    @property
    def label(self) -> str:
        """What kind of counterexample this is."""
        return f"reachable trace of {len(self.moves)} steps"


class Player(Scenario):
    """Plays a script to the step that the kernel refuses, or to the claim that breaks."""

    def __init__(self, sources: Sources, until: str, site: Site, system: System) -> None:
        """Prepare to play; ``until`` is the claim that is to break."""
        self.trace = Trace(site)
        self.until = until
        self.claims = {**SAFETY, until: INVARIANTS[until]}
        super().__init__(table_running(STEPS, sources), site, system)

    def does(self, step: str, effect: Changes | None = None, /, **event: Any) -> None:
        """Take a step, whatever its effect; end if it has none, or if it breaks the claim."""
        after = self.steps[step](self.site, self.system, **event)
        if not changes(self.system, after):
            raise Stopped(step, self.why_refused(step, event) if step in WHY_REFUSED else None)
        broken = tuple(name for name, claim in self.claims.items() if not claim(self.site, after))
        self.trace.moves.append(Move(step, event, self.system, after, broken))
        self.system = after
        if self.until in broken:
            raise Violated(self.until)

    def tries(self, step: str, /, **event: Any) -> None:
        """Take a step that the kernel may answer with nothing, and go on."""
        try:
            self.does(step, **event)
        except Stopped:
            return

    def _watch(self, step: str, event: Mapping[str, Any]) -> None:
        """What is watched is watched in :meth:`does`: the safety claims, and the claim that is to break."""


def play(script: Callable[[Player], None], player: Player) -> Trace:
    """Play a script to its end, one way or the other."""
    try:
        script(player)
    except Stopped as stopped:
        player.trace.stopped = stopped
    except Violated:
        pass
    return player.trace
