"""What the record of a campaign of faulty traffic must say by the sources: its canaries, and its verdict."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path
from typing import Any

from evidence.manifest.finding import Finding
from fuzz.campaign.sought import unsought
from fuzz.targets.interlocking import Interlocking
from fuzz.targets.jolted import Jolted
from fuzz.targets.link import LinkRuns
from fuzz.targets.target import Target
from fuzz.targets.walks import Walks
from models.exit_codes import DOES_NOT_HOLD, HOLDS, UNDECIDED, WORDS

Told = Mapping[str, Any]
NAME = "fuzz.json"
CARRY: Mapping[str, Callable[[str], Target]] = {
    "interlocking": lambda layout: Interlocking(Path(layout)),
    "jolted": lambda layout: Jolted(Path(layout)),
    "walks": lambda _: Walks(),
    "link": lambda _: LinkRuns(),
}
"""The targets that a fault can be planted in, by the first part of their names."""
CARRY_NONE = frozenset({"lines", "rides", "days"})


def fuzzed(told: Told) -> Iterator[Finding]:
    """Each seed sought every canary that its targets carry; the verdict is that of what stands there."""
    targets = []
    for target in told["targets"]:
        kind, _, layout = target.partition(":")
        if kind in CARRY:
            targets.append(CARRY[kind](layout))
        elif kind not in CARRY_NONE:
            yield Finding("foreign target", NAME, f"{target}: there is no such target")
    if sorted(told["seeds"]) != sorted({each["seed"] for each in told["starts"]}):
        yield Finding("other sums", NAME, f"says seeds {told['seeds']}, and its starts say others")
    yield from _canaries(told, targets)
    for target, one in told["targets"].items():
        for key in ("batches", "unfinished", "traces", "steps", "failures"):
            if type(one[key]) is not int or one[key] < 0:
                yield Finding("other sums", NAME, f"{target}: {key} {one[key]!r}")
        if bool(one["failures"]) != any(each["target"] == target for each in told["failures"]):
            yield Finding("other sums", NAME, f"{target}: {one['failures']} failures, and those told are others")
    if bool(told["left_out"]) != any(one["unfinished"] for one in told["targets"].values()):
        yield Finding("other sums", NAME, f"{len(told['left_out'])} batches left out, and its targets say others")
    verdict = WORDS[verdict_of(told)]
    if told["verdict"] not in (verdict, WORDS[UNDECIDED]):
        yield Finding("other verdict", NAME, f"says {told['verdict']}, and what stands in it comes to {verdict}")


def verdict_of(told: Told) -> int:
    """What a campaign comes to by its record, as :func:`fuzz.campaign.summary.verdict` says by its store.

    One that was interrupted is undecided whatever stands in it.
    """
    totals = told["targets"].values()
    if told["failures"] or told["left_out"] or any(one["failures"] or one["unfinished"] for one in totals):
        return DOES_NOT_HOLD
    found_all = all(each["target"] for each in told["canaries"])
    return HOLDS if found_all and any(one["steps"] for one in totals) else UNDECIDED


def _canaries(told: Told, targets: list[Target]) -> Iterator[Finding]:
    wanted = Counter((each.kind, each.fault) for seed in told["seeds"] for each in unsought(targets, seed))
    there = Counter((each["kind"], each["fault"]) for each in told["canaries"])
    if not there:
        yield Finding("missing canary", NAME, "no canary was sought: nothing that was not found counts")
    for kind, fault in wanted - there:
        yield Finding("missing canary", NAME, f"{kind}: {fault}: the sources plant it, and the record says nothing")
    for kind, fault in there - wanted:
        yield Finding("foreign canary", NAME, f"{kind}: {fault}: the sources plant none such by these seeds")
    for each in told["canaries"]:
        if each["target"] and (not each["batches"] or each["target"] not in told["targets"]):
            yield Finding("other canary", NAME, f"{each['fault']}: found in no batch, or by no target of the record")
