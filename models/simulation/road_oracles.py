"""What must be true where a road crosses the line: judged by trains and arms, by no crossing's word (X2 to X5)."""

from __future__ import annotations

from collections.abc import Iterable

from kernel.names import Train
from models.crossing.sites import SETTINGS
from models.simulation.crossing_state import LONG_AGO_S, Seen, State
from models.simulation.posted import Must

AT_LEAST_QUIET_S = 900
"""Closed for nobody, though all is heard, a road is no longer than this; a fault may last 300 s."""
NOBODY = "nobody"
CLOSED_IN_TIME, CLOSED_UNDER, OPENS_AGAIN = (
    "the_road_is_closed_before_every_train",
    "the_road_is_closed_under_a_train",
    "the_road_opens_again",
)


def judge_train(must: Must, state: State, train: Train, before: Seen, now_s: int) -> None:
    """No head comes onto the road before it is closed for its time, and nobody is on it while it is not."""
    if not state.seen[train].under:
        return
    closed_s = -1 if state.closed_s is None else now_s - state.closed_s
    down_s = -1 if state.down_s is None else now_s - state.down_s
    if not before.under:
        state.passed += 1
        if state.closed_s != LONG_AGO_S:
            state.least_s = closed_s if state.least_s is None else min(state.least_s, closed_s)
        in_time = closed_s >= SETTINGS.warning_cycles and down_s >= SETTINGS.least_down_cycles
        told = f"{train} comes to {state.name}: it warns for {closed_s} s, arms are down for {down_s} s"
        must(CLOSED_IN_TIME, in_time, told)
    must(CLOSED_UNDER, down_s >= 0, f"{train} is on {state.name}, and its arms are not down")


def judge_opening(must: Must, state: State, kept_for: Iterable[str]) -> None:
    """The road opens again; ``kept_for``: trains it knows though they are gone, or ``NOBODY`` where it is closed."""
    state.quiet_s = {who: state.quiet_s.get(who, 0) + 1 for who in kept_for}
    who, longest_s = max(state.quiet_s.items(), key=lambda each: each[1], default=(NOBODY, 0))
    must(OPENS_AGAIN, longest_s < AT_LEAST_QUIET_S, f"{state.name} is kept for {who}, not coming for {longest_s} s")
