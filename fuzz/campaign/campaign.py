"""One campaign: batches out to the processes, what they came to into the store, until it is enough."""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

from fuzz.campaign.guidance import Guide
from fuzz.campaign.identity import BATCHES_A_ROUND, difference, of_target
from fuzz.campaign.outcome import DONE, Outcome
from fuzz.campaign.pool import Workers
from fuzz.campaign.problems import CampaignError
from fuzz.campaign.store import Store
from fuzz.targets.target import Batch, Target
from models.exit_codes import UNDECIDED

TOLD_EVERY_S = 0.5
BATCHES_AT_ONCE = 256
"""So many are read together: a long campaign need not be in memory as a whole to be gone on with."""
FAILED_IN_A_ROW = 8
"""So many batches without a result, and none with one between, end a campaign: no night is to be lost with them."""


@dataclass(frozen=True)
class Plan:
    """How long a campaign goes on: ``batches`` of each target, ``seconds`` of this run, or what is reached first."""

    seed: int
    batches: int | None = None
    seconds: float | None = None

    def __post_init__(self) -> None:
        assert self.batches is not None or self.seconds is not None, "a campaign without end"


class Course:
    """One target's way through its batches: which is next, with which weights.

    A round begins when all rounds but the one before it are over, and its weights follow from those.
    """

    def __init__(self, store: Store, target: Target, plan: Plan, identity: Mapping[str, str]) -> None:
        self.target, self.busy_seconds, self.under_way = target, 0.0, 0
        self._store, self._seed, self._limit = store, plan.seed, plan.batches
        self._over = store.numbers(plan.seed, target.name)
        self._guide = Guide(target.families())
        self._next, self._all_below, self._known = 0, 0, 0
        self._round, self._weights = -1, tuple[float, ...]()
        prefix = f"{target.name}/"
        self._identity = {
            thing.removeprefix(prefix): value for thing, value in identity.items() if thing.startswith(prefix)
        }

    def next_batch(self) -> Batch | None:
        """The next batch, or None while none can begin or when all have.

        Raises:
            CampaignError: what the target is made from changed.
        """
        while self._next in self._over:
            self._next += 1
        while self._all_below in self._over:
            self._all_below += 1
        number, rounds = self._next, self._next // BATCHES_A_ROUND
        if self._limit is not None and number >= self._limit:
            return None
        if self._all_below < (rounds - 1) * BATCHES_A_ROUND:
            return None
        if rounds > self._round:
            self._begin(rounds)
        self._next += 1
        self.under_way += 1
        weights = self._guide.of_batch(self._seed, number, self._weights)
        return Batch(self.target.name, number, self._seed, weights)

    def note(self, outcome: Outcome) -> None:
        """Note that a batch is over."""
        self.under_way -= 1
        self.busy_seconds += outcome.result.seconds if outcome.result else 0.0
        self._over.add(outcome.batch.number)

    def hold(self) -> None:
        """Make sure that the target is still made from the same.

        Raises:
            CampaignError: it is not; names the first thing that changed.
        """
        differs = difference(self._identity, of_target(self.target))
        if differs:
            line = f"{self.target.name}: changed under the running campaign: {differs}"
            raise CampaignError(f"{line}; put it back to go on, or begin another (what was finished is kept)")

    def _begin(self, number: int) -> None:
        self.hold()
        known = max(0, (number - 1) * BATCHES_A_ROUND)
        for start in range(self._known, known, BATCHES_AT_ONCE):
            some = range(start, min(start + BATCHES_AT_ONCE, known))
            self._guide.note(self._store.kept(self._seed, self.target.name, some))
        self._known, self._round, self._weights = known, number, self._guide.weights()
        self._store.note_round(self._seed, self.target.name, number, self._weights)


def run(
    store: Store,
    targets: Sequence[Target],
    plan: Plan,
    workers: Workers,
    tell: Callable[[], object] = lambda: None,
    stopped: Callable[[], bool] = lambda: False,
) -> None:
    """Run a campaign on; each batch is in the store as soon as it is over.

    ``tell`` is called twice a second; once ``stopped`` says so, it ends, and batches under way are dropped.

    Raises:
        CampaignError: it cannot go on; what was finished is kept.
    """
    identity = store.identity()
    courses = {target.name: Course(store, target, plan, identity) for target in targets}
    until = None if plan.seconds is None else time.monotonic() + plan.seconds
    failed, told = 0, 0.0
    while not stopped() and (until is None or time.monotonic() < until):
        hand_out(list(courses.values()), workers)
        if not any(course.under_way for course in courses.values()):
            break
        patience = TOLD_EVERY_S if until is None else min(TOLD_EVERY_S, max(0.0, until - time.monotonic()))
        for outcome in workers.wait(patience):
            store.add(outcome)
            courses[outcome.batch.target].note(outcome)
            failed = 0 if outcome.status == DONE else failed + 1
            if failed >= FAILED_IN_A_ROW:
                line = f"{failed} batches in a row came to nothing, the last: {outcome.words}"
                raise CampaignError(f"{line}; mend that and begin again", UNDECIDED)
        if time.monotonic() - told >= TOLD_EVERY_S:
            told = time.monotonic()
            tell()
    for course in courses.values():
        course.hold()


def hand_out(courses: Sequence[Course], workers: Workers) -> None:
    """Hand batches out until enough are under way; the target that was worked on least comes first."""
    wanted = workers.wanted() - sum(course.under_way for course in courses)
    while wanted > 0:
        for course in sorted(courses, key=lambda each: (each.busy_seconds, each.under_way)):
            batch = course.next_batch()
            if batch:
                workers.submit(batch)
                wanted -= 1
                break
        else:
            return
