"""Supervised release: two persons on the spot account for a train whose unit cannot (T8, ours).

The first isolates the unit, which begins a new life that no authority granted before reaches, and states
where the train stands; the second looks for himself and confirms the place.  Only if both say the
same, and only while the signaller keeps the procedure open, is it taken for the train's own word.

A life counts for the epoch of the centre in which it began, which the unit shows beside it.  A centre that has
restarted does not know which lives it has granted runs to: for its word the unit is isolated anew.
"""

from __future__ import annotations

from dataclasses import replace

from kernel.centre import Centre, Statement
from kernel.layout import Layout
from kernel.names import Block, Cause, Epoch, Run, Train, UnitLife
from kernel.recovery import account_for, standing_refusal
from kernel.refusal import Refusal


def open_procedure(layout: Layout, centre: Centre, train: Train) -> Centre:
    """Open the supervised procedure for a train; what was stated before counts no more (T8)."""
    if train not in layout.fleet:
        return centre
    return replace(
        centre,
        supervised=centre.supervised | {train},
        statements={other: said for other, said in centre.statements.items() if other != train},
    )


def note_statement(centre: Centre, train: Train, life: UnitLife, epoch: Epoch, blocks: frozenset[Block]) -> Centre:
    """Note what the first person states: life and epoch as the isolated unit shows them, and the place (T8)."""
    if train not in centre.supervised or epoch != centre.epoch:
        return centre
    return replace(centre, statements=centre.statements | {train: Statement(life=life, blocks=blocks)})


def supervised_refusal(
    layout: Layout,
    centre: Centre,
    train: Train,
    life: UnitLife,
    epoch: Epoch,
    blocks: frozenset[Block],
    run: Run,
) -> Refusal | None:
    """Say why the second person's confirmation does not account for the train (T8).

    ``blocks``: where the second person has seen it.
    """
    if train not in centre.supervised:
        return Refusal.PROCEDURE_NOT_OPEN
    said = centre.statements.get(train)
    if said is None or said.life != life:
        return Refusal.NO_STATEMENT
    if said.blocks != blocks:
        return Refusal.STATEMENTS_DIFFER
    return standing_refusal(layout, centre, train, life, epoch, blocks, run)


def note_statement_confirmed(
    layout: Layout,
    centre: Centre,
    train: Train,
    life: UnitLife,
    epoch: Epoch,
    blocks: frozenset[Block],
    run: Run,
) -> Centre:
    """Account for the train as stated: the second person has seen it in the same blocks; the procedure closes (T8)."""
    if supervised_refusal(layout, centre, train, life, epoch, blocks, run) is not None:
        return centre
    return replace(
        account_for(layout, centre, blocks, run, Cause.SUPERVISED),
        supervised=centre.supervised - {train},
        statements={other: words for other, words in centre.statements.items() if other != train},
    )
