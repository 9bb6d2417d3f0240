"""The page of every fault of the models: name, unit, declared range and what lies beyond it, from the models' data."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from models.alarm import faults as alarm
from models.crossing import faults as crossing
from models.days.faults import Fault
from models.sensors import faults as sensors
from models.simulation import faults as lines
from models.tram import faults as tram

WHERE: Sequence[tuple[str, str, str]] = (
    ("Reverse movement", "`rolls_back_m`: within up to 1.8 m, beyond it to 20", "rolls back at a start; `rolled back`"),
    ("Lost pulses", "`pulses_lost_at_s`: beyond", "`pulses lost`"),
    ("Extra pulses", "`pulses_extra_at_s`: beyond", "`pulses too many`"),
    ("A wheel diameter entered wrong", "`diameter_entered_mm`: beyond", "`wheel diameter entered wrong`"),
    ("Slow slide", "`slow_slide_at_s`: beyond", "`slow slide`, `slide held`"),
    ("Cross-talk of the neighbouring track's tags", "`crosstalk_at_s`: beyond", "`tag of elsewhere at the head`"),
    ("Both tags of a pair lost together", "`pair_lost_at_s`: within", "`pair of tags lost`"),
    (
        "An inertial sensor mounted in reverse",
        "`head_reversed`, `left_reversed`, `right_reversed`: beyond",
        "`inertial sensor mounted in reverse`",
    ),
    ("Frozen GPS with fresh time stamps", "days of the alarm, `gps_frozen`: within", ""),
)
"""A fault as an engineer calls it, where the rides or days have it, and what it is called elsewhere."""


INTRODUCTION = (
    "*Within* the declared ranges no claim may be broken. *Beyond* one of them an assumption of the proofs is:"
    " `heisoku ride --beyond NAME` and `heisoku days alarm --beyond NAME` (or `crossing`, or `tram`) count the claims"
    " that break, the assumptions that did not hold, and which monitor noticed. What they found of rides is told in"
    " [the world of physics](physics.md)."
)


def page() -> str:
    """Give the page."""
    return "\n".join(
        [
            "# Every fault of the models",
            "",
            "Written by `python -m proofs.pages` from the faults' data in `models`; do not edit.",
            "",
            INTRODUCTION,
            "",
            *table(
                ("what", "in rides and days", "in the world of physics, and in campaigns of the interlocking"), WHERE
            ),
            "",
            "## Trains with faulty sensors (`heisoku ride`)",
            "",
            "A range of one value, or a chance of 0, says that the fault never comes within what is declared.",
            "",
            *table(
                ("name", "unit", "declared", "beyond, to", "rides that have it", "bound", "from"), map(ranges, RIDES)
            ),
            "",
            "## Simulated lines (`heisoku simulate`, `heisoku fuzz --target lines`)",
            "",
            "All of them are within what is assumed.",
            "",
            *table(("name", "what", "how often", "size"), (each_line(fault) for fault in lines.FAULTS)),
            *(row for title, faults in DAYS for row in ["", f"## {title}", "", *table(OF_DAYS, map(of_days, faults))]),
            "",
            "## Days of the trams (`heisoku days tram`)",
            "",
            *table(
                ("name", "what", "chance a day", "size", "breaks", "from"),
                (
                    (
                        name,
                        fault.says,
                        f"{fault.chance:g}",
                        size(fault.least, fault.most, fault.unit),
                        f"`{fault.breaks}`" if fault.breaks else "",
                        fault.why,
                    )
                    for name, fault in tram.FAULTS.items()
                ),
            ),
            "",
        ]
    )


RIDES = sensors.FAULTS
OF_DAYS = ("name", "what", "chance a day", "lasts", "size", "breaks", "from")
DAYS = (
    ("Days of the crossing (`heisoku days crossing`)", crossing.FAULTS),
    ("Days of the track worker's alarm (`heisoku days alarm`)", alarm.FAULTS),
)


def ranges(fault: sensors.Fault) -> Sequence[str]:
    """A row of a sensor's fault."""
    beyond = "" if fault.beyond == fault.most else f"{fault.beyond:g}"
    return (
        fault.name,
        fault.unit,
        f"{fault.least:g}" if fault.least == fault.most else f"{fault.least:g} to {fault.most:g}",
        beyond,
        "all" if fault.chance == 1 else f"{fault.chance:g}",
        fault.bound,
        fault.source,
    )


def each_line(fault: lines.Fault) -> Sequence[str]:
    """A row of a line's fault."""
    return fault.name, fault.says, f"{fault.rate:g} a {fault.per}", size(fault.least, fault.most, fault.unit)


def of_days(fault: Fault) -> Sequence[str]:
    """A row of a fault of days."""
    return (
        fault.name,
        fault.says,
        f"{fault.chance:g}",
        size(fault.least_s, fault.most_s, "s"),
        size(fault.least, fault.most, fault.unit),
        f"`{fault.breaks}`" if fault.breaks else "",
        fault.source,
    )


def size(least: float, most: float, unit: str) -> str:
    """From the least to the most, or nothing where there is no size."""
    if least == most == 0:
        return ""
    return f"{least:g} {unit}" if least == most else f"{least:g} to {most:g} {unit}"


def table(headings: Sequence[str], rows: Iterable[Sequence[str]]) -> list[str]:
    """The lines of a table."""
    found = [f"| {' | '.join(row)} |" for row in rows]
    assert found, "a table of nothing"
    return [f"| {' | '.join(headings)} |", "|" + "---|" * len(headings), *found]
