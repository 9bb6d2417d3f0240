"""What the sums in records of rides and days must be by each other, and by the command that made them."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from typing import Any

from evidence.manifest.finding import Finding
from models.rides.plan import LEAST_WAY_M

Told = Mapping[str, Any]
OPTION = r"(?:^|\s){name}[ =](\d+)(?=\s|$)"
RIDES, DAYS = ("--rides", 1_024), ("--days", 200)
"""The option that says how many, and how many there are without it."""
MM_A_M = 1_000
MM_A_CYCLE = 10_000
"""More than a train runs in a cycle of a tenth of a second."""
SIGNED = frozenset({"short_of_end_mm"})
"""What may be less than nothing: a train beyond its end stops short of it by less than nothing."""


def ridden(name: str, told: Told) -> Iterator[Finding]:
    """Each campaign is of as many rides as were asked for, and no count is of more than there were."""
    for each in told["campaigns"]:
        rides, sums = each["rides"], each["sums"]
        yield from _as_asked(name, told["command"], RIDES, rides)
        yield from _within(name, "violated", each["violated"], rides)
        yield from _within(name, "unexplained", each["unexplained"], each["violated"])
        for key in ("violations", "assumptions", "monitors"):
            for what, count in each[key].items():
                yield from _within(name, what, count, rides)
        for what, count in sums.items():
            if what not in SIGNED:
                yield from _within(name, what, count, None)
        if sums["cycles"] < rides or sums["way_mm"] > sums["cycles"] * MM_A_CYCLE:
            yield Finding("other sums", name, f"{sums['cycles']} cycles of {rides} rides over {sums['way_mm']} mm")
        for what, most in each.get("most", {}).items():
            if what not in SIGNED and not most <= sums[what] <= most * rides:
                yield Finding("other sums", name, f"{what}: {sums[what]} in all of {rides}, with {most} at most")
        if each.get("long", 0) * LEAST_WAY_M * MM_A_M > sums["way_mm"]:
            yield Finding("other sums", name, f"{each['long']} long rides over {sums['way_mm']} mm in all")


def lived(name: str, told: Told) -> Iterator[Finding]:
    """There are as many days as were asked for, and nothing is counted on more of them than there were."""
    days = told["days"]
    yield from _as_asked(name, told["command"], DAYS, days)
    yield from _within(name, "violated", told["violated"], days)
    yield from _within(name, "unexplained", told["unexplained"], told["violated"])
    for group in told["columns"].values():
        for what, each in group.items():
            on, most = each["on days"], each["most in a day"]
            yield from _within(name, what, on, days)
            if not max(on, most) <= each["all"] <= most * on:
                yield Finding("other sums", name, f"{what}: {each['all']} on {on} days, with {most} at most")


def _as_asked(name: str, command: str, option: tuple[str, int], count: int) -> Iterator[Finding]:
    said = re.findall(OPTION.format(name=option[0]), command)
    asked = int(said[-1]) if said else option[1]
    if type(count) is not int or count != asked or not count:
        yield Finding("other sums", name, f"is of {count}, and its command asks for {asked:,}: {command}")


def _within(name: str, what: str, count: int, most: int | None) -> Iterator[Finding]:
    if type(count) is not int or count < 0 or (most is not None and count > most):
        yield Finding("other sums", name, f"{what}: {count}{'' if most is None else f' of {most}'}")
