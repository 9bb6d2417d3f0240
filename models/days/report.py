"""What a campaign of days came to, as tables and as a record."""

from __future__ import annotations

from collections.abc import Mapping

from rich.console import Console
from rich.table import Table

from models.days.campaign import Outcome


def print_outcome(out: Console, found: Outcome) -> None:
    """Print a campaign."""
    system = found.system
    _plain(
        out,
        f"{found.days:,} days of {system.hours:g} h, {found.hours:,.0f} h of traffic; {found.faults:,} faults,"
        f" {found.faults / found.days:.2f} a day",
    )
    claims = Table(title="What must not be", title_justify="left")
    for heading in ("claim broken", "days", "95 % bound"):
        claims.add_column(heading)
    for name, what in system.claims.items():
        days = found.on_days[name]
        claims.add_row(what, f"{days:,}", f"{found.bound:.1e} a day" if days == 0 else "")
    out.print(claims)
    for title, names in (
        ("Assumptions of the proofs, held against the truth: how often broken", system.assumptions),
        ("What the machines noticed", system.monitors),
        ("Faults", system.faults),
        ("The price of the safe side", system.prices),
        ("Beside that", system.counts),
    ):
        _sums(out, title, names, found)


def _sums(out: Console, title: str, names: Mapping[str, str], found: Outcome) -> None:
    rows = Table(title=title, title_justify="left")
    for heading in ("what", "all", "an hour", "most in a day", "on days"):
        rows.add_column(heading, justify="left" if heading == "what" else "right")
    for name, what in names.items():
        total = found.sums[name]
        rows.add_row(
            what, f"{total:,}", f"{total / found.hours:,.3g}", f"{found.most[name]:,}", f"{found.on_days[name]:,}"
        )
    out.print(rows)


def _plain(out: Console, line: str) -> None:
    out.print(line, markup=False, highlight=False, soft_wrap=True)


def record(seed: int, found: Outcome) -> dict[str, object]:
    """Give a campaign as it is written to a file."""
    system = found.system
    return {
        "system": system.name,
        "seed": seed,
        "days": found.days,
        "hours": found.hours,
        "violated": found.violated,
        "unexplained": found.unexplained,
        "bound": found.bound,
        "columns": {
            group: {
                name: {
                    "what": what,
                    "all": found.sums[name],
                    "most in a day": found.most[name],
                    "on days": found.on_days[name],
                }
                for name, what in getattr(system, group).items()
            }
            for group in ("claims", "assumptions", "monitors", "faults", "prices", "counts")
        },
    }
