"""A run of the whole system, step by step, each said beforehand to happen, to change just this, or to be refused.

Every step is looked up by name in a table, so that a mutated system plays the same scenario.
After each step every invariant and premise must hold; the axioms speak of no state and must hold at the start.
"""

from __future__ import annotations

import inspect
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

from kernel import cancellation, recovery, release, route_setting, supervision
from kernel.refusal import Refusal
from models.world.state import Site, System
from proofs import catalogue
from proofs.witnesses.changes import Changes, changes, still_to_come

Steps = Mapping[str, Callable[..., Any]]
"""Transitions by name, and the kernel functions that say why a transition is refused."""

WHY_REFUSED: Mapping[str, str] = {
    "request": "request_refusal",
    "open_first_loop": "open_first_loop_refusal",
    "note_echo": "echo_refusal",
    "cancel": "cancel_refusal",
    "release_block": "release_refusal",
    "retire": "retire_refusal",
    "note_standing": "standing_refusal",
    "recover_point": "recover_point_refusal",
    "note_statement_confirmed": "supervised_refusal",
}
"""For a transition that gives reasons, the function that gives them."""

REASONS: Steps = {
    "request_refusal": route_setting.request_refusal,
    "open_first_loop_refusal": route_setting.open_first_loop_refusal,
    "echo_refusal": route_setting.echo_refusal,
    "cancel_refusal": cancellation.cancel_refusal,
    "release_refusal": release.release_refusal,
    "retire_refusal": release.retire_refusal,
    "standing_refusal": recovery.standing_refusal,
    "recover_point_refusal": recovery.recover_point_refusal,
    "supervised_refusal": supervision.supervised_refusal,
}

STEPS: Steps = {**catalogue.STEPS, **REASONS}
"""The system as it is."""


START = "start"


class WitnessFailed(AssertionError):
    """The system did not do what the witness says."""


@dataclass(frozen=True)
class Taken:
    """One step: its name and event, whether it was accepted, whether its effect was said, the state after."""

    step: str
    event: Mapping[str, Any]
    accepted: bool
    effect_said: bool
    why: Refusal | None
    after: System


class Scenario:
    """A run that is being played; ``taken`` is what happened so far."""

    def __init__(self, steps: Steps, site: Site, system: System) -> None:
        self.steps: Steps = {**STEPS, **steps}
        self.site = site
        self.system = system
        self.taken: list[Taken] = []
        self._watch(START, {})

    def does(self, step: str, effect: Changes | None = None, /, **event: Any) -> None:
        """Take a step that must be accepted; ``effect``, where given, is all that it changes, and how."""
        after = self.steps[step](self.site, self.system, **event)
        changed = changes(self.system, after)
        if not changed:
            raise WitnessFailed(f"{self._told(step, event)} changed nothing")
        if effect is not None and changed != (stated := still_to_come(self.system, effect)):
            raise WitnessFailed(f"{self._told(step, event)} changed\n  {changed}\nand should change\n  {stated}")
        self.system = after
        self.taken.append(Taken(step, event, True, effect is not None, None, after))
        self._watch(step, event)

    def refuses(self, step: str, why: Refusal | None = None, /, **event: Any) -> None:
        """Try a step that must change nothing, for the reason ``why`` where it gives one."""
        after = self.steps[step](self.site, self.system, **event)
        changed = changes(self.system, after)
        if changed:
            raise WitnessFailed(f"{self._told(step, event)} should be refused and changed\n  {changed}")
        if why is not None and self.why_refused(step, event) is not why:
            raise WitnessFailed(f"{self._told(step, event)}: {self.why_refused(step, event)}, and should be {why}")
        self.taken.append(Taken(step, event, False, False, why, after))

    def why_refused(self, step: str, event: Mapping[str, Any]) -> Refusal | None:
        """Ask the kernel why it refuses this step."""
        asked = self.steps[WHY_REFUSED[step]]
        told = (event.get("train"), event.get("life"), event.get("epoch"))
        radio = self.system.radio
        said = radio.standings if step == "note_standing" else radio.confirmed_statements
        known = {
            "blocks": said.get(told, frozenset()),  # type: ignore[arg-type]
            "tag_list": self.system.radio.echoes.get(event.get("run")),  # type: ignore[arg-type]
            **event,
            "layout": self.site.layout,
            "records": self.site.records,
            "centre": self.system.centre,
        }
        answer = asked(**{name: known[name] for name in inspect.signature(asked).parameters})
        assert answer is None or isinstance(answer, Refusal)
        return answer

    def must(self, holds: bool, what: str) -> None:
        """Say something of the state now."""
        if not holds:
            raise WitnessFailed(f"after {len(self.taken)} steps it does not hold that {what}")

    def _watch(self, step: str, event: Mapping[str, Any]) -> None:
        """Every invariant and premise holds now; the axioms, which speak of no state, at the start."""
        broken = [name for name, claim in catalogue.INVARIANTS.items() if not claim(self.site, self.system)]
        broken += [name for name, premise in catalogue.PREMISES.items() if not premise(self.site)]
        if step == START:
            broken += [name for name, claim in catalogue.INITIAL.items() if not claim(self.site, self.system)]
            layout, ground = self.site.layout, self.site.ground
            broken += [name for name, axiom in catalogue.AXIOMS.items() if not axiom(layout, ground)]
        if broken:
            raise WitnessFailed(f"after {self._told(step, event)} these do not hold: {', '.join(broken)}")

    def _told(self, step: str, event: Mapping[str, Any]) -> str:
        """A step as an engineer would read it."""
        given = ", ".join(f"{name}={value!r}" for name, value in event.items())
        return f"step {len(self.taken) + 1}, {step}({given}),"
