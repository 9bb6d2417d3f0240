"""What the record of a campaign of faulty traffic must say by the sources: its canaries, and its verdict."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

from evidence.manifest.finding import Finding
from fuzz.campaign.session import OFFERED
from fuzz.campaign.sought import unsought
from fuzz.campaign.summary import comes_to
from fuzz.targets.target import Target
from models.exit_codes import UNDECIDED, WORDS

Told = Mapping[str, Any]
NAME = "fuzz.json"
CARRY_NONE = frozenset({"lines", "rides", "days"})
"""The targets that no fault is planted in; of the others it is asked what they carry."""


WHOLE = ("interlocking", "jolted", "lines", "walks", "link")
"""The targets of ``make fuzz``."""
BATCHES = 8
"""So many batches it runs of each, if it is not told how many."""


def of_a_part(told: Told) -> Iterator[str]:
    """What a campaign lacks of a whole one: targets, batches, canaries."""
    totals = told.get("targets")
    batches = dict.fromkeys(WHOLE, 0)
    for target, one in totals.items() if isinstance(totals, Mapping) else ():
        count = one.get("batches") if isinstance(one, Mapping) else None
        kind = target.partition(":")[0]
        batches[kind] = max(batches.get(kind, 0), count if isinstance(count, int) else 0)
    few = [f"{count} of {kind}" for kind, count in batches.items() if kind in WHOLE and count < BATCHES]
    if few:
        yield f"{NAME}: a part: of {BATCHES} batches of each target {', '.join(few)}"
    if not told.get("canaries"):
        yield f"{NAME}: no canary was run, since its targets carry none: what it did not find it may not see"


def fuzzed(told: Told) -> Iterator[Finding]:
    """Each seed sought every canary that its targets carry; the verdict is that of what stands there."""
    targets: list[Target] = []
    for target in told["targets"]:
        kind, _, layout = target.partition(":")
        if kind in OFFERED:
            targets += [] if kind in CARRY_NONE else OFFERED[kind]([Path(layout)])
        else:
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
    """What a campaign comes to by its record, as its command said by its store.

    One that was interrupted is undecided whatever stands in it.
    """
    totals = told["targets"].values()
    left = told["failures"] or told["left_out"]
    return comes_to(
        is_bad=bool(left) or any(one["failures"] or one["unfinished"] for one in totals),
        found_all=all(each["target"] for each in told["canaries"]),
        ran=any(one["steps"] for one in totals),
    )


def _canaries(told: Told, targets: list[Target]) -> Iterator[Finding]:
    wanted = Counter((each.kind, each.fault) for seed in told["seeds"] for each in unsought(targets, seed))
    there = Counter((each["kind"], each["fault"]) for each in told["canaries"])
    for kind, fault in wanted - there:
        yield Finding("missing canary", NAME, f"{kind}: {fault}: the sources plant it, and the record says nothing")
    for kind, fault in there - wanted:
        yield Finding("foreign canary", NAME, f"{kind}: {fault}: the sources plant none such by these seeds")
    for each in told["canaries"]:
        if each["target"] and (not each["batches"] or each["target"] not in told["targets"]):
            yield Finding("other canary", NAME, f"{each['fault']}: found in no batch, or by no target of the record")
