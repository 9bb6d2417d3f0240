"""Rides a ride of a campaign again: its line, its faults and its sensors follow from its numbers."""

from __future__ import annotations

from dataclasses import dataclass

from fuzz.failures.trace import RideTrace
from models.rides.campaign import RUNS_A_BATCH, Batch, ridden
from models.rides.tally import ASSUMPTIONS, COLUMNS, COUNTS, MONITORS, VIOLATIONS
from models.sensors.faults import names


@dataclass(frozen=True)
class Ridden:
    """A ride's tally: ``values`` by column; ``violated`` and ``broken`` by name, each with what it says."""

    trace: RideTrace
    values: dict[str, int]

    @property
    def violated(self) -> dict[str, str]:
        """The claims that were broken."""
        return {name: says for name, says in VIOLATIONS.items() if self.values[name]}

    @property
    def broken(self) -> dict[str, str]:
        """The assumptions that were broken."""
        return {name: says for name, says in ASSUMPTIONS.items() if self.values[name]}

    @property
    def noticed(self) -> dict[str, str]:
        """What the machines on board noticed."""
        return {name: says for name, says in MONITORS.items() if self.values[name]}

    @property
    def verdict(self) -> str:
        """What it came to, on one line."""
        beyond = f", with {', '.join(self.trace.beyond)} beyond the declared range" if self.trace.beyond else ""
        where = f"ride {self.trace.ride} of seed {self.trace.seed}{beyond}; {self.values['cycles']:,} cycles ridden"
        if self.violated:
            return f"reproduced: {', '.join(self.violated)} violated in {where}"
        return f"not reproduced: no claim is broken in {where}"

    @property
    def counts(self) -> dict[str, str]:
        """What is counted."""
        return dict(COUNTS)


def unknown_faults(trace: RideTrace) -> list[str]:
    """The faults of the trace that there are none of in this version."""
    return [name for name in trace.beyond if name not in names()]


def ride_again(trace: RideTrace) -> Ridden:
    """Ride it; it is the same in whatever company, so only those before it in its batch are ridden with it."""
    batch, row = divmod(trace.ride, RUNS_A_BATCH)
    tally = ridden(Batch(trace.seed, batch, row + 1, trace.beyond))[row]
    return Ridden(trace, dict(zip(COLUMNS, tally.tolist(), strict=True)))
