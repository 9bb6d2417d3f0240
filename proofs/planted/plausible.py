"""Functions of the planted protocols; :mod:`proofs.planted.protocols` says what is wrong with each."""

from __future__ import annotations

from dataclasses import replace

from kernel.centre import NO_RUNS, Centre
from kernel.claims import end_claims
from kernel.layout import Layout, TagRecords
from kernel.names import Block, Cause, Position, Read, Run, Stage, TerminalLife
from kernel.refusal import Refusal
from kernel.tag_list import TagLists
from kernel.terminal import Terminal
from kernel.unit import Unit


def reports_the_list(lists: TagLists, unit: Unit, run: Run, block: Block, left: Read, entered: Read) -> bool:
    """Report any block whose tags are on a list that came, read or not."""
    return run in unit.orders and any(
        order.tag_list is not None
        and order.tag_list in lists.tag_after
        and lists.tag_after[order.tag_list].get(left.tag) == entered.tag
        for _, order in unit.orders.items()
    )


def compares_uids_only(
    layout: Layout, records: TagRecords, centre: Centre, run: Run, block: Block, left: Read, entered: Read
) -> Refusal | None:
    """Take the report for evidence if its UIDs are those of the block."""
    grant = centre.runs.get(run)
    if grant is None:
        return Refusal.NO_SUCH_RUN
    if grant.stage != Stage.SET and grant.stage != Stage.STANDING:
        return Refusal.WRONG_STAGE
    if run not in centre.claimed.get(block, NO_RUNS):
        return Refusal.NOT_CLAIMED
    if layout.tag_in.get(left.tag) != block or layout.partner.get(left.tag) != entered.tag:
        return Refusal.NOT_THE_TAGS_OF_THE_BLOCK
    return None


def frees_the_start_as_well(layout: Layout, centre: Centre, run: Run) -> Centre:
    """Free overlap and start block once the train has told that its front stands in the destination."""
    grant = centre.runs.get(run)
    if grant is None or grant.stage != Stage.SET:
        return centre
    freed = end_claims(
        layout,
        centre,
        run,
        grant,
        layout.overlap[run.route],
        frozenset(
            point
            for point in layout.needs[run.route]
            if layout.released_with[run.route][point] in layout.overlap[run.route]
        ),
        Stage.SET,
        Cause.STANDSTILL,
    )
    start = layout.start[run.route]
    others = frozenset(other for other in freed.claimed.get(start, NO_RUNS) if other.train != run.train)
    return replace(freed, claimed=freed.claimed | {start: others})


def obeys_any_run(
    terminal: Terminal, run: Run, position: Position, life: TerminalLife, detected: Position, is_detected: bool
) -> Terminal:
    """Obey whatever order comes last, older or newer."""
    if life != terminal.life:
        return terminal
    return replace(terminal, holds=run, wanted=position, unlocked=terminal.unlocked or detected != position)
