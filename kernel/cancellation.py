"""Cancellation at the centre, with approach locking on the train (接近鎖錠; T9)."""

from __future__ import annotations

from dataclasses import replace

from kernel.centre import Centre
from kernel.claims import end_run
from kernel.layout import Layout
from kernel.names import Cause, Run, Stage


def withdraw(layout: Layout, centre: Centre, run: Run) -> Centre:
    """Take a run back before the train was told of it (T9)."""
    grant = centre.runs.get(run)
    if grant is None or grant.stage != Stage.RESERVED:
        return centre
    return end_run(layout, centre, run, grant, Cause.WITHDRAWN)


def cancel(centre: Centre, run: Run) -> Centre:
    """Begin to ask the train for a run it has been told of; nothing is freed by asking (T9)."""
    grant = centre.runs.get(run)
    if grant is None or (grant.stage != Stage.OFFERED and grant.stage != Stage.SET):
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
