"""What is counted of each ride, by name, and what it comes to over many."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from models.rides.plan import LEAST_WAY_M

Numbers = npt.NDArray[np.int64]
"""A row for each ride, a column for each of ``COLUMNS``."""

VIOLATIONS: Mapping[str, str] = {
    "front_outside": "the front was outside the range that was claimed (P7)",
    "rear_outside": "the rear was outside it (P7, P4)",
    "speed_outside": "the speed was outside its range (P1)",
    "length_short": "the length used was less than the true one (P4)",
    "split_unseen": "a difference beyond threshold and errors lasted beyond the bound, and the train was whole (P5)",
    "false_tail_accepted": "a tail's read counted although the tail was farther off than its spacing allows (T13)",
    "authority_passed": "the head passed the end of authority (T12)",
}
"""What must not be; each is counted in cycles, but those that happen once."""

ASSUMPTIONS: Mapping[str, str] = {
    "powers_broken": "`the_train_stays_within_its_powers`: more gain or loss of speed than motors and brakes have",
    "inertial_broken": "`the_inertial_sensor_keeps_its_bound`: a reading farther from the truth, or a steeper line",
    "wheel_broken": "`a_rolling_wheel_measures`: a trusted wheel shows another speed or way",
    "fix_broken": "the survey (P3): a tag or a curve lies, or is found, elsewhere; the range is off by as much",
    "tail_broken": "the errors that `split.threshold_mm_s2` covers: a tail sensor farther from the truth",
    "brake_broken": "`the_brake_keeps_its_bound`, `the_train_gains_no_more`: motors or brake beyond their bounds",
}
"""The proofs' assumptions, each held against the truth in every cycle: what no unit on board can do."""

MONITORS: Mapping[str, str] = {
    "contradicted": "a fix lay outside the range (P7)",
    "untrusted": "the wheel lost its trust (P1)",
    "split_found": "a split was flagged (P5)",
    "not_intact": "the train did not count as whole, once it had (P5, P6)",
    "tag_overdue": "a tag was overdue (T5)",
    "tag_outside_window": "a tag came outside its window (T5)",
    "spacing_broken": "head's and tail's reads did not fit (T13)",
    "length_contradicts": "a length above the line's greatest was measured, or another than before (P4)",
    "brake_accused": "the train was faster than motors and brake allow (T12)",
}
"""What the machines on board noticed."""

ALARMS = tuple(name for name in MONITORS if name not in {"untrusted", "not_intact"})
"""Those that say that something is wrong; a wheel slips and a telegram is missed on sound trains too."""

COUNTS: Mapping[str, str] = {
    "cycles": "cycles ridden",
    "way_mm": "way run",
    "faults": "faults that not every ride has",
    "tags_read": "tags delivered",
    "tags_missed": "tags passed with too few frames",
    "features_fixed": "curves that gave a fix",
    "features_failed": "curves that gave none",
    "lengths": "lengths measured",
    "parted": "trains that parted",
    "seen_after_cycles": "from a parting to the flag",
    "widest_mm": "widest range",
    "slip_cycles": "cycles without trust in the wheel",
    "false_splits": "splits flagged of trains that were whole",
    "approaches": "approaches to an end of authority with a driver who does not brake",
    "short_of_end_mm": "how far short of the end they stopped",
}

COLUMNS: tuple[str, ...] = (*VIOLATIONS, *ASSUMPTIONS, *MONITORS, *COUNTS)
"""Every column of a tally, in order; the names below are their places, for compiled code."""

(
    FRONT_OUTSIDE,
    REAR_OUTSIDE,
    SPEED_OUTSIDE,
    LENGTH_SHORT,
    SPLIT_UNSEEN,
    FALSE_TAIL_ACCEPTED,
    AUTHORITY_PASSED,
    POWERS_BROKEN,
    INERTIAL_BROKEN,
    WHEEL_BROKEN,
    FIX_BROKEN,
    TAIL_BROKEN,
    BRAKE_BROKEN,
    CONTRADICTED,
    UNTRUSTED,
    SPLIT_FOUND,
    NOT_INTACT,
    TAG_OVERDUE,
    TAG_OUTSIDE_WINDOW,
    SPACING_BROKEN,
    LENGTH_CONTRADICTS,
    BRAKE_ACCUSED,
    CYCLES,
    WAY_MM,
    FAULTS,
    TAGS_READ,
    TAGS_MISSED,
    FEATURES_FIXED,
    FEATURES_FAILED,
    LENGTHS,
    PARTED,
    SEEN_AFTER_CYCLES,
    WIDEST_MM,
    SLIP_CYCLES,
    FALSE_SPLITS,
    APPROACHES,
    SHORT_OF_END_MM,
) = range(len(COLUMNS))


@dataclass(frozen=True)
class Outcome:
    """What a campaign came to.

    ``rides``: so many; ``long``: those of 10 km and more.
    ``violations``, ``assumptions``, ``monitors``: for each name, in how many rides.
    ``violated``: rides with a violation; ``unexplained``: those in which every assumption held;
    ``unnoticed``: those in which no alarm was raised on board.
    ``sums``, ``most``: of each column.
    """

    rides: int
    long: int
    violations: Mapping[str, int]
    assumptions: Mapping[str, int]
    monitors: Mapping[str, int]
    violated: int
    unexplained: int
    unnoticed: int
    sums: Mapping[str, int]
    most: Mapping[str, int]

    def holds(self, beyond: bool) -> bool:
        """Tell whether nothing claimed was false; beyond a declared range, unless an assumption was broken."""
        return self.unexplained == 0 if beyond else self.violated == 0

    @property
    def bound(self) -> float:
        """The 95 % upper bound of the share of rides with a violation, where none was seen: 3/n."""
        return 3 / self.rides


def outcome(rows: Numbers) -> Outcome:
    """Sum up a campaign."""
    columns = {name: rows[:, place] for place, name in enumerate(COLUMNS)}
    violated, broken, noticed = (
        np.any([columns[name] > 0 for name in names], axis=0) for names in (VIOLATIONS, ASSUMPTIONS, ALARMS)
    )
    return Outcome(
        rides=len(rows),
        long=int((columns["way_mm"] >= LEAST_WAY_M * 1000).sum()),
        violations=in_rides(columns, VIOLATIONS),
        assumptions=in_rides(columns, ASSUMPTIONS),
        monitors=in_rides(columns, MONITORS),
        violated=int(violated.sum()),
        unexplained=int((violated & ~broken).sum()),
        unnoticed=int((violated & ~noticed).sum()),
        sums={name: int(column.sum()) for name, column in columns.items()},
        most={name: int(column.max()) for name, column in columns.items()},
    )


def in_rides(columns: Mapping[str, Numbers], names: Mapping[str, str]) -> dict[str, int]:
    """Count the rides that have each of these."""
    return {name: int((columns[name] > 0).sum()) for name in names}
