"""What a campaign of rides came to, as a table and as a record."""

from __future__ import annotations

from collections.abc import Mapping

from rich.console import Console
from rich.table import Table

from models.rides.plan import LEAST_WAY_M, PLAN
from models.rides.tally import ASSUMPTIONS, COUNTS, MONITORS, VIOLATIONS, Outcome
from models.sensors.faults import FAULTS


def print_outcome(out: Console, found: Outcome) -> None:
    """Print a campaign within the declared ranges."""
    cycles, way_km = found.sums["cycles"], found.sums["way_mm"] / 1e6
    print_plain(
        out,
        f"{found.rides:,} rides, {found.long:,} of {LEAST_WAY_M / 1000:.0f} km and more, the others ended by a split"
        f" or by stops; {cycles:,} cycles, {way_km:,.0f} km;"
        f" {found.sums['faults'] / found.rides:.2f} faults a ride beside errors that every ride has",
    )
    rows = Table(title="What must not be", title_justify="left")
    for heading in ("claim broken", "rides", "95 % bound"):
        rows.add_column(heading)
    for name, what in VIOLATIONS.items():
        count = found.violations[name]
        rows.add_row(what, f"{count:,}", f"{found.bound:.1e} a ride" if count == 0 else "")
    out.print(rows)
    counted(out, "Assumptions of the proofs, held against the truth", ASSUMPTIONS, found.assumptions)
    counted(out, "What the monitors on board noticed", MONITORS, found.monitors)
    means = Table(title="Beside that", title_justify="left")
    for heading in ("what", "all", "a ride", "most"):
        means.add_column(heading, justify="left" if heading == "what" else "right")
    for name, what in COUNTS.items():
        total = found.sums[name]
        means.add_row(f"{what} ({name})", f"{total:,}", f"{total / found.rides:,.2f}", f"{found.most[name]:,}")
    out.print(means)


def counted(out: Console, title: str, names: Mapping[str, str], counts: Mapping[str, int]) -> None:
    """Print in how many rides each of some things was seen."""
    rows = Table(title=title, title_justify="left")
    rows.add_column("what")
    rows.add_column("rides", justify="right")
    for name, what in names.items():
        rows.add_row(what, f"{counts[name]:,}")
    out.print(rows)


def print_beyond(out: Console, found: Mapping[str, Outcome]) -> None:
    """Print campaigns with one fault beyond its declared range each: claims broken, and whose fault it was."""
    rows = Table(title="One fault beyond its declared range, in every ride", title_justify="left")
    left = ("fault", "assumptions broken", "noticed by")
    for heading in ("fault", "rides", "claim broken", "assumption held", "no alarm", *left[1:]):
        rows.add_column(heading, justify="left" if heading in left else "right")
    for name, one in found.items():
        broken, noticed = (
            ", ".join(f"{each} {count}" for each, count in counts.items() if count)
            for counts in (one.assumptions, one.monitors)
        )
        counts = (one.rides, one.violated, one.unexplained, one.unnoticed)
        rows.add_row(name, *(f"{each:,}" for each in counts), broken, noticed)
    out.print(rows)
    print_plain(out, "assumption held: a claim was broken and no assumption was, which would be the kernel's fault")
    print_plain(
        out,
        "no alarm: a claim was broken, and no monitor said so by the end of the ride (a wheel not trusted is none)",
    )
    print_plain(out, "noticed by: in how many rides each monitor spoke, also of what else those rides have")


def print_plain(out: Console, line: str) -> None:
    """Print a line as it is."""
    out.print(line, markup=False, highlight=False, soft_wrap=True)


def record(seed: int, found: Mapping[str, Outcome]) -> dict[str, object]:
    """Give campaigns as they are written to a file."""
    return {
        "seed": seed,
        "plan": repr(PLAN),
        "faults": {
            each.name: {"unit": each.unit, "least": each.least, "most": each.most, "chance": each.chance}
            for each in FAULTS
        },
        "campaigns": [
            {
                "beyond": name or None,
                "rides": one.rides,
                "long": one.long,
                "violations": dict(one.violations),
                "assumptions": dict(one.assumptions),
                "monitors": dict(one.monitors),
                "violated": one.violated,
                "unexplained": one.unexplained,
                "unnoticed": one.unnoticed,
                "bound": one.bound,
                "sums": dict(one.sums),
                "most": dict(one.most),
            }
            for name, one in found.items()
        ],
    }
