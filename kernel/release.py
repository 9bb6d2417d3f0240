"""Release at the centre: third loop, part by part; overlap; and the end of a run (T6, T7, T9)."""

from __future__ import annotations

from dataclasses import replace

from kernel.centre import NO_POINTS, NO_RUNS, Centre
from kernel.claims import end_claims
from kernel.layout import Layout, TagRecords
from kernel.names import Block, Cause, Read, Run, Stage
from kernel.refusal import Refusal


def release_refusal(
    layout: Layout, records: TagRecords, centre: Centre, run: Run, block: Block, left: Read, entered: Read
) -> Refusal | None:
    """Say why ``block`` is not released on the report that the tail read ``left`` and then ``entered`` (T6, T7).

    The first loop has told the train the tags' UIDs, so the report must carry what only a
    reading gives: the records.  Both tags must be the pair at the end of this very block.
    """
    grant = centre.runs.get(run)
    if grant is None:
        return Refusal.NO_SUCH_RUN
    if grant.stage != Stage.SET and grant.stage != Stage.STANDING:
        return Refusal.WRONG_STAGE
    if run not in centre.claimed.get(block, NO_RUNS):
        return Refusal.NOT_CLAIMED
    if layout.tag_in.get(left.tag) != block or layout.partner.get(left.tag) != entered.tag:
        return Refusal.NOT_THE_TAGS_OF_THE_BLOCK
    if records.record.get(left.tag) != left.record or records.record.get(entered.tag) != entered.record:
        return Refusal.RECORD_DIFFERS
    return None


def release(
    layout: Layout, records: TagRecords, centre: Centre, run: Run, block: Block, left: Read, entered: Read
) -> Centre:
    """Free one block, and the points released with it, on tail evidence of this run (third loop; T6, T7)."""
    grant = centre.runs.get(run)
    if grant is None or release_refusal(layout, records, centre, run, block, left, entered) is not None:
        return centre
    points = (
        layout.points_in.get(block, NO_POINTS)
        if grant.stage == Stage.STANDING
        else frozenset(point for point in layout.needs[run.route] if layout.released_with[run.route][point] == block)
    )
    return end_claims(layout, centre, run, grant, frozenset({block}), points, grant.stage, Cause.TAIL_EVIDENCE)


def release_overlap(layout: Layout, centre: Centre, run: Run) -> Centre:
    """Free the overlap once the train has told that it stands in its destination (過走余裕; T9)."""
    grant = centre.runs.get(run)
    if grant is None or grant.stage != Stage.SET:
        return centre
    return end_claims(
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


def retire_refusal(centre: Centre, run: Run) -> Refusal | None:
    """Say why the centre cannot forget ``run`` (T8)."""
    if run not in centre.runs:
        return Refusal.NO_SUCH_RUN
    if any(run in holders for _, holders in centre.claimed.items()):
        return Refusal.STILL_CLAIMED
    return None


def retire(centre: Centre, run: Run) -> Centre:
    """Forget a run that holds nothing any more; what ended it has been journalled by then (T8)."""
    if retire_refusal(centre, run) is not None:
        return centre
    return replace(centre, runs={other: grant for other, grant in centre.runs.items() if other != run})
