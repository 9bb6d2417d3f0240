"""What a campaign of days came to, as tables and as a record."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict

from rich.console import Console
from rich.table import Table

from models.days.campaign import Noticed, Outcome
from models.days.system import System


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


def print_beyond(out: Console, system: System, found: Mapping[str, Noticed]) -> None:
    """Print one fault beyond what is assumed after the other: what it broke, and what noticed it."""
    rows = Table(title="One fault beyond what is assumed, on every day", title_justify="left")
    left = ("fault", "breaks", "noticed by")
    for heading in ("fault", "breaks", "days it changed", "claim broken", "assumption held", "unnoticed", "noticed by"):
        rows.add_column(heading, justify="left" if heading in left else "right", overflow="fold")
    for name, one in found.items():
        by = ", ".join(f"{monitor} {days}" for monitor, days in one.noticed.items() if days)
        counts = (one.days, one.violated, one.unexplained, one.unnoticed)
        rows.add_row(name, system.beyond[name], *(f"{each:,}" for each in counts), by)
    out.print(rows)
    _plain(out, "noticed by: a monitor counted more than on the same day without the fault")


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


def record(seed: int, found: Outcome, beyond: Mapping[str, Noticed] | None = None) -> dict[str, object]:
    """Give a campaign as it is written to a file, with what came of faults beyond what is assumed."""
    system = found.system
    return {
        "system": system.name,
        "seed": seed,
        "days": found.days,
        "hours": found.hours,
        "violated": found.violated,
        "unexplained": found.unexplained,
        "bound": found.bound,
        "beyond": {name: asdict(one) for name, one in (beyond or {}).items()},
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
