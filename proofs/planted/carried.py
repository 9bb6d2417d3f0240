"""A run set ahead whose end the brake is given though the nearer run is gone: refuted at the joint, and drawn in mm."""

from __future__ import annotations

from collections.abc import Mapping

from kernel.onboard.braking import Brake
from proofs.mutants import steps
from proofs.mutants.steps import Found
from proofs.mutated import Sources
from proofs.onboard.witnesses.on_lines import BLOCK_MM, OnLine
from proofs.onboard.witnesses.station import PERMITTED
from proofs.planted.fault import Fault
from proofs.witnesses.lines import LINES, Line, line_on
from proofs.witnesses.stations import T1

MILLISECONDS = 20_000
COVERED = (
    "kernel.onboard.authority_end.ends_mm: and-operand any((covers_the_head(begins_mm[over], block_ends_mm[over], "
    "front_least_mm, smaller(front_most_mm, end_mm)) for over in begins_mm if over in block_ends_mm))"
)
CARRIED = Fault(
    "a run set ahead carries the end over what is nobody's",
    "The nearer run was given back and freed, and the brake is given the end of the one that leads on from it.",
    "joint.ask_for_the_end",
    dropped=(COVERED,),
)
"""The guard by which there is no end where the head may be on track that no order covers."""


def refuted() -> Found | None:
    """Ask the solver for a step that breaks a claim of the joint, with the guard dropped."""
    return steps.search(CARRIED.transition, CARRIED.sources, MILLISECONDS)[0]


def asked(line: Line, sources: Sources | None = None) -> Found | None:
    """The attack on a layout: the train, of whose runs only the one set ahead is left, asks for its end."""
    station = OnLine(line)
    head_mm = BLOCK_MM * 3 // 5
    station.located(head_mm)
    station.lists(station.ahead, station.end_mm - BLOCK_MM)
    station.told({station.ahead: PERMITTED})
    brake = Brake(applied=False, end_mm=station.farther_mm)
    event = {"train": T1, "front_least_mm": head_mm - 1_000, "front_most_mm": head_mm + 1_000, "brake": brake}
    given = CARRIED.sources if sources is None else sources
    return steps.stepped(CARRIED.transition, station.site, station.system, event, given)


def drawn() -> Mapping[str, Found]:
    """What the solver finds, and the attack on each station made for it, by what the drawing is called."""
    found = {CARRIED.name: refuted()}
    found |= {f"{CARRIED.name}, on {name.replace('_', ' ')}": asked(line_on(name)) for name in LINES}
    return {name: each for name, each in found.items() if each is not None}
