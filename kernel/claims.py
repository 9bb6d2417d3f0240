"""How claims of trains exclude each other, and how they end: block by block, each by one cause (T7, T8, T9)."""

from __future__ import annotations

from dataclasses import replace

from kernel.centre import NO_BLOCKS, NO_LOCKS, NO_RUNS, Centre, Grant
from kernel.layout import Layout
from kernel.names import Block, Cause, Point, Run, Stage, Train
from kernel.refusal import Refusal


def held_refusal(layout: Layout, centre: Centre, train: Train, blocks: frozenset[Block]) -> Refusal | None:
    """Say whether one of ``blocks``, or a block that fouls one of them, is held for another train (T9)."""
    if any(other.train != train for block in blocks for other in centre.claimed.get(block, NO_RUNS)):
        return Refusal.BLOCK_HELD_FOR_ANOTHER
    if any(
        other.train != train
        for block in blocks
        for beside in layout.fouls.get(block, NO_BLOCKS)
        for other in centre.claimed.get(beside, NO_RUNS)
    ):
        return Refusal.FOULING_BLOCK_HELD
    return None


def end_claims(
    layout: Layout,
    centre: Centre,
    run: Run,
    grant: Grant,
    blocks: frozenset[Block],
    points: frozenset[Point],
    stage: Stage,
    cause: Cause,
) -> Centre:
    """Free ``blocks`` and ``points`` from ``run``, note why, and leave it at ``stage`` (T7, T8)."""
    return replace(
        centre,
        runs=centre.runs
        | {
            run: replace(
                grant,
                stage=stage,
                ended=grant.ended | {block: cause for block in blocks if run in centre.claimed.get(block, NO_RUNS)},
            )
        },
        claimed=centre.claimed | {block: centre.claimed.get(block, NO_RUNS) - {run} for block in blocks},
        locked=centre.locked
        | {
            point: {other: lies for other, lies in centre.locked.get(point, NO_LOCKS).items() if other != run}
            for point in points
        },
    )


def end_run(layout: Layout, centre: Centre, run: Run, grant: Grant, cause: Cause) -> Centre:
    """Free everything a run of a route holds, at once (T8, T9)."""
    return end_claims(
        layout,
        centre,
        run,
        grant,
        layout.claims[run.route],
        frozenset(point for point in layout.needs[run.route]),
        Stage.OVER,
        cause,
    )
