"""Many days of a system: batches over as many processes as wanted, and what they come to."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np

from models.days.kept import KeptDays
from models.days.system import Numbers, System
from models.days.systems import system_of
from models.processes import spread

DAYS_A_BATCH = 25


@dataclass(frozen=True)
class Batch:
    """Some days of a system, by their numbers; ``beyond``: faults that each of them has."""

    system: str
    seed: int
    days: range
    beyond: tuple[str, ...] = ()


@dataclass(frozen=True)
class Outcome:
    """What a campaign of days came to.

    ``days``: so many.  ``sums``, ``most``, ``on_days``: of each column all, the most in a day, and on how many days.
    ``violated``: days with a claim broken; ``unexplained``: those on which every assumption held.
    """

    system: System
    days: int
    sums: Mapping[str, int]
    most: Mapping[str, int]
    on_days: Mapping[str, int]
    violated: int
    unexplained: int

    @property
    def holds(self) -> bool:
        """Tell whether nothing claimed was false on any day."""
        return self.violated == 0

    @property
    def bound(self) -> float:
        """The 95 % upper bound of the share of days with a claim broken, where none was seen: 3/n."""
        return 3 / self.days

    @property
    def hours(self) -> float:
        """Hours of traffic in all."""
        return self.days * self.system.hours

    @property
    def faults(self) -> int:
        """Faults in all."""
        return sum(self.sums[name] for name in self.system.faults)


def lived(batch: Batch) -> Numbers:
    """Simulate a batch; a row for each day, a column for each of the system's."""
    return system_of(batch.system).simulate(batch.seed, batch.days, *batch.beyond)


def live_all(
    name: str,
    seed: int,
    days: int,
    jobs: int,
    progress: Callable[[int, int, str], object] = lambda *_: None,
    kept: KeptDays | None = None,
    beyond: tuple[str, ...] = (),
) -> Numbers:
    """Simulate a campaign; a row for each day, in order.  Batches that are kept already are not simulated again.

    ``beyond``: faults that each day has; days with such are not kept.
    """
    assert not (kept and beyond), "days with a fault beyond what is assumed are not kept"
    batches = [range(first, min(first + DAYS_A_BATCH, days)) for first in range(0, days, DAYS_A_BATCH)]
    rows = {batch: found for batch in batches if kept and (found := kept.rows(batch)) is not None}
    todo = [Batch(name, seed, batch, beyond) for batch in batches if batch not in rows]
    done = sum(map(len, rows))
    for batch, found in zip(todo, spread(lived, todo, jobs), strict=True):
        rows[batch.days] = found
        if kept:
            kept.keep(batch.days, found)
        done += len(found)
        progress(done, days, name)
    return np.concatenate([rows[batch] for batch in batches])


@dataclass(frozen=True)
class Noticed:
    """What came of one fault beyond what is assumed, on days that are otherwise those of another campaign.

    ``days``: those on which it changed anything.  ``violated``: of them those with a claim broken; ``unexplained``:
    with every assumption held; ``unnoticed``: with no monitor that counted more than without the fault.
    ``noticed``: by how many days each monitor counted more.
    """

    days: int
    violated: int
    unexplained: int
    unnoticed: int
    noticed: Mapping[str, int]


def noticed(system: System, without: Numbers, rows: Numbers) -> Noticed:
    """Hold days with a fault against the same days without it."""
    place = {name: number for number, name in enumerate(system.columns)}
    drawn = [place[name] for name in system.faults]
    changed = np.delete(rows != without, drawn, axis=1).any(axis=1)
    claims, assumptions, monitors = (
        [place[name] for name in names] for names in (system.claims, system.assumptions, system.monitors)
    )
    violated, broken = ((rows[:, names] > 0).any(axis=1) & changed for names in (claims, assumptions))
    more = rows[:, monitors] > without[:, monitors]
    return Noticed(
        days=int(changed.sum()),
        violated=int(violated.sum()),
        unexplained=int((violated & ~broken).sum()),
        unnoticed=int((changed & ~more.any(axis=1)).sum()),
        noticed={name: int(more[:, number].sum()) for number, name in enumerate(system.monitors)},
    )


def outcome(system: System, rows: Numbers) -> Outcome:
    """Sum up a campaign."""
    columns = {name: rows[:, place] for place, name in enumerate(system.columns)}
    violated, broken = (
        np.any([columns[name] > 0 for name in names], axis=0) for names in (system.claims, system.assumptions)
    )
    return Outcome(
        system=system,
        days=len(rows),
        sums={name: int(column.sum()) for name, column in columns.items()},
        most={name: int(column.max()) for name, column in columns.items()},
        on_days={name: int((column > 0).sum()) for name, column in columns.items()},
        violated=int(violated.sum()),
        unexplained=int((violated & ~broken).sum()),
    )
