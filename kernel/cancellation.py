"""Cancellation at the centre, with approach locking on the train (接近鎖錠; T9)."""

from __future__ import annotations

from dataclasses import replace

from kernel.centre import Centre
from kernel.claims import end_run
from kernel.layout import Layout
from kernel.names import Cause, Run, Stage
from kernel.refusal import Refusal


def withdraw(layout: Layout, centre: Centre, run: Run) -> Centre:
    """Take a run back before the train was told of it (T9)."""
    grant = centre.runs.get(run)
    if grant is None or grant.stage != Stage.RESERVED:
        return centre
    return end_run(layout, centre, run, grant, Cause.WITHDRAWN)


def leads_on(layout: Layout, centre: Centre, run: Run) -> bool:
    """Tell whether a later run of the train, not yet over, starts in what ``run`` covers (T9)."""
    return any(
        other.train == run.train
        and run.serial < other.serial
        and grant.stage != Stage.OVER
        and layout.start.get(other.route) in layout.covers[run.route]
        for other, grant in centre.runs.items()
    )


def cancel_refusal(layout: Layout, centre: Centre, run: Run) -> Refusal | None:
    """Say why the train cannot be asked for ``run`` (T9)."""
    grant = centre.runs.get(run)
    if grant is None:
        return Refusal.NO_SUCH_RUN
    if grant.stage != Stage.OFFERED and grant.stage != Stage.SET:
        return Refusal.WRONG_STAGE
    if leads_on(layout, centre, run):
        return Refusal.A_RUN_LEADS_ON
    return None


def cancel(layout: Layout, centre: Centre, run: Run) -> Centre:
    """Begin to ask the train for a run it has been told of; nothing is freed by asking (T9)."""
    grant = centre.runs.get(run)
    if grant is None or cancel_refusal(layout, centre, run) is not None:
        return centre
    return replace(centre, runs=centre.runs | {run: replace(grant, cancelling=True)})


def asks_back(centre: Centre, run: Run) -> bool:
    """Tell whether the centre asks the train to give ``run`` back (T9)."""
    grant = centre.runs.get(run)
    return grant is not None and grant.cancelling and (grant.stage == Stage.OFFERED or grant.stage == Stage.SET)


def note_given_back(layout: Layout, centre: Centre, run: Run) -> Centre:
    """Free the run: the train acknowledges that it stands short of it and will not enter (T9)."""
    grant = centre.runs.get(run)
    if grant is None or (grant.stage != Stage.OFFERED and grant.stage != Stage.SET):
        return centre
    return end_run(layout, centre, run, grant, Cause.CANCELLED)
