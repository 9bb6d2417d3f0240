"""The guard that stops each attack, dropped: the same attack then ends badly on every layout that it fits."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import partial
from typing import Any

from kernel.refusal import Refusal
from models.world.state import Site, System
from proofs.mutated import Sources
from proofs.planted import weakenings
from proofs.planted.fault import Fault
from proofs.planted.trace import Player, Trace, play
from proofs.witnesses import on_lines
from proofs.witnesses.lines import LINES, Line, line_on
from proofs.witnesses.on_lines import ATTACKS, Attack, Script

OCCUPANCY = "physical_occupancy_is_recorded"


class Attacker(Player):
    """Plays an attack on: what the true kernel refuses is tried, and whatever comes of it is gone on from."""

    def refuses(self, step: str, why: Refusal | None = None, /, **event: Any) -> None:
        """Try what should be refused."""
        self.tries(step, **event)

    def must(self, holds: bool, what: str) -> None:
        """Nothing is expected of a system that is under attack."""


@dataclass(frozen=True)
class Unguarded:
    """An attack on a kernel without the guard that stops it.

    ``broken``: the safety claim that breaks in the end.
    """

    fault: Fault
    script: Script
    broken: str

    @property
    def attack(self) -> Attack:
        """The attack, as its witnesses play it."""
        return ATTACKS[self.script.__name__]

    def trace(self, line: Line, sources: Sources | None = None) -> Trace:
        """Play the attack on a layout, with the guard dropped or with these functions replaced."""
        given = self.fault.sources if sources is None else sources
        player = self._player(given, line.site, self.attack.stands(line))
        return play(partial(self._goes_on, line), player)

    def _player(self, sources: Sources, site: Site, system: System) -> Player:
        return Attacker(sources, self.broken, site, system)

    def _goes_on(self, line: Line, player: Player) -> None:
        self.script(player, line)

    def drawn(self) -> Mapping[str, Trace]:
        """The attack on each station made for it, by what the drawing is called."""
        return {f"{self.fault.name}, on {name.replace('_', ' ')}": self.trace(line_on(name)) for name in LINES}


UNGUARDED: tuple[Unguarded, ...] = (
    Unguarded(weakenings.BLOCK_AHEAD, on_lines.the_tail_frees_no_block_ahead, OCCUPANCY),
    Unguarded(weakenings.LAP_BEFORE, on_lines.a_read_from_the_lap_before_pairs_with_nothing, OCCUPANCY),
    Unguarded(weakenings.TURNED_ASTRIDE, on_lines.a_read_from_before_two_turns_pairs_with_nothing, OCCUPANCY),
    Unguarded(weakenings.GIVEN_BACK_TOO_EARLY, on_lines.a_train_that_rolls_in_gives_nothing_back, OCCUPANCY),
    Unguarded(weakenings.NOTHING_COMPARED, on_lines.a_train_with_another_list_gets_no_permit, "a_set_run_was_offered"),
    Unguarded(weakenings.LIFE_CONFIRMED, on_lines.two_persons_who_name_two_places_account_for_nothing, OCCUPANCY),
)
"""The attacks that end with a train where nothing is held for it, or with a list that is not the centre's.

One more is at home in millimetres (:mod:`proofs.planted.carried`).  A way back that is permitted before the
arrival frees nothing without its guard either: it opens the loop, and the train brakes.
"""
