"""What a campaign came to, at its end: as tables and lines, and as a record."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict

from rich.console import Console
from rich.table import Table

from fuzz.campaign.files import said
from fuzz.campaign.growth import draw, growing, in_words
from fuzz.campaign.sought import in_words as in_words_of_canaries
from fuzz.campaign.store import Store
from fuzz.campaign.view import table_of
from models.exit_codes import DOES_NOT_HOLD, HOLDS, UNDECIDED

STOOD = "standstill seconds: "
"""How a target's counts of standstill begin; the cause follows."""
LONGEST = 6
BROKEN, VIOLATED = "broken: ", "broken and violated: "
"""The same of traces in which an assumption was broken, and of those in which a claim was false as well."""
VERDICTS = {HOLDS: "holds", DOES_NOT_HOLD: "does not hold", UNDECIDED: "undecided"}


def verdict(store: Store) -> int:
    """The exit code: 1 with a failure or a batch left out, 3 if nothing ran or a canary was not found, else 0."""
    totals = store.totals().values()
    return comes_to(
        is_bad=any(one.failures or one.unfinished for one in totals),
        found_all=all(each.target for each in store.canaries()),
        ran=any(one.steps for one in totals),
    )


def comes_to(*, is_bad: bool, found_all: bool, ran: bool) -> int:
    """The exit code of a campaign with a failure or a batch left out, with every canary found, and of one that ran."""
    if is_bad:
        return DOES_NOT_HOLD
    return HOLDS if found_all and ran else UNDECIDED


def show(out: Console, store: Store, rates: Mapping[str, float], code: int) -> None:
    """Print what it came to, and draw how coverage grew into the folder.

    Raises:
        CampaignError: the picture cannot be written.
    """
    totals = store.totals()
    out.print(table_of(totals, rates, "What was run"))
    found = growing(store)
    picture = store.folder / "coverage.png"
    if found:
        with said(picture):
            draw(picture, found)
    for target, growth in found.items():
        plain(out, in_words(target, growth))
    if found:
        plain(out, f"drawn in {picture}")
    for target in totals:
        counts = store.counts(target)
        for line in (*standing(target, counts), *beyond(target, counts)):
            plain(out, line)
    for line in store.unfinished():
        plain(out, line)
    plain(out, in_words_of_canaries(store.canaries()))
    failures = store.failures()
    if failures:
        table = Table(title="Failures, by cause", title_justify="left")
        for heading in ("target", "violated", "times", "trace"):
            table.add_column(heading, justify="right" if heading == "times" else "left", overflow="fold")
        for target, invariant, _, times, path in failures:
            table.add_row(target, invariant, f"{times:,}", str(path))
        out.print(table)
        plain(out, f"heisoku replay {failures[0][4]} shows the first of them")
    batches, traces, steps, failed = (
        sum(getattr(one, what) for one in totals.values()) for what in ("batches", "traces", "steps", "failures")
    )
    seeds = store.seeds()
    plain(
        out,
        f"{batches:,} batches, {traces:,} traces, {steps:,} steps with seed{'s' * (len(seeds) > 1)}"
        f" {', '.join(map(str, seeds))}, {failed:,} failures of {len(failures):,} causes: {VERDICTS[code]}",
    )


def standing(target: str, counts: Mapping[str, int]) -> list[str]:
    """How long trains stood still, and for what, the longest first; nothing for a target that has no traffic."""
    stood = {
        name.removeprefix(STOOD): seconds for name, seconds in counts.items() if name.startswith(STOOD) and seconds
    }
    if not stood:
        return []
    whole = sum(stood.values())
    longest = sorted(stood, key=lambda name: (-stood[name], name))[:LONGEST]
    told = ", ".join(f"{100 * stood[name] / whole:.1f} % {name}" for name in longest)
    return [f"{target}: trains stood still for {whole / 3600:,.0f} h: {told}; the rest is in the record"]


def beyond(target: str, counts: Mapping[str, int]) -> list[str]:
    """In how many traces an assumption about nature was broken, by its name: no failures of the kernel."""
    broken, violated = counted(counts, BROKEN), counted(counts, VIOLATED)
    told = ", ".join(f"{name} {times} ({violated.get(name, 0)})" for name, times in broken.items())
    return [f"{target}: assumptions broken, and in brackets with a claim: {told}"] if broken else []


def counted(counts: Mapping[str, int], begins: str) -> dict[str, int]:
    """The counts whose names begin so and that are not 0, by what follows."""
    return {name.removeprefix(begins): count for name, count in counts.items() if name.startswith(begins) and count}


def record(store: Store, code: int) -> dict[str, object]:
    """Give a campaign as it is written to a file."""
    totals, growth = store.totals(), growing(store)
    return {
        "verdict": VERDICTS[code],
        "identity": store.identity(),
        "seeds": store.seeds(),
        "starts": store.starts(),
        "targets": {
            target: {
                **asdict(one),
                "counts": store.counts(target),
                "added by the last tenth of the steps": dict(
                    zip(("tuples", "pairs"), growth[target].last_tenth(), strict=True)
                )
                if target in growth
                else None,
            }
            for target, one in totals.items()
        },
        "left_out": store.unfinished(),
        "canaries": [asdict(each) for each in store.canaries()],
        "failures": [
            {"target": target, "violated": invariant, "cause": digest, "times": times, "trace": str(path)}
            for target, invariant, digest, times, path in store.failures()
        ],
    }


def plain(out: Console, line: str) -> None:
    """Print a line as it is."""
    out.print(line, markup=False, highlight=False, soft_wrap=True)
