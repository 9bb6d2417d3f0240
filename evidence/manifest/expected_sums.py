"""What the sums in records of rides and days must be by each other, and by how many there were."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping
from dataclasses import fields
from typing import Any

from evidence.manifest.finding import Finding
from models.days.campaign import Outcome as Lived
from models.days.system import System
from models.rides.plan import LEAST_WAY_M
from models.rides.tally import ALARMS, Outcome

Told = Mapping[str, Any]
MM_A_M = 1_000
MM_A_CYCLE = 10_000
"""More than a train runs in a cycle of a tenth of a second."""
SIGNED = frozenset({"short_of_end_mm"})
"""What may be less than nothing: a train beyond its end stops short of it by less than nothing."""
COUNTED = ("violations", "assumptions", "monitors")


def ridden(name: str, told: Told) -> Iterator[Finding]:
    """No count is of more rides than there were, and what is counted one by one goes together with what is in all."""
    for each in told["campaigns"]:
        rides = each["rides"]
        yield from _within(name, "rides", rides, None, least=1)
        yield from _counted(name, each, rides)
        yield from _summed(name, each, rides)
        if rides:
            now = Outcome(**{field.name: each[field.name] for field in fields(Outcome)})
            yield from _reckoned(name, each, {"bound": now.bound})


def _counted(name: str, each: Told, rides: int) -> Iterator[Finding]:
    """What is counted in rides is no more than there were, and in all of them at least as much."""
    yield from _within(name, "violated", each["violated"], rides)
    for key in COUNTED:
        for what, count in each[key].items():
            yield from _within(name, what, count, rides)
            if not count <= each["sums"][what] or bool(count) != bool(each["sums"][what]):
                yield Finding("other sums", name, f"{what}: in {count} rides, {each['sums'][what]} in all")
    yield from _explained(name, each, each["violations"].values(), each["assumptions"].values())
    for key, most in (("long", rides), ("unnoticed", each["violated"])):
        yield from _within(name, key, each[key], most)
    if each["violated"] - each["unnoticed"] > sum(each["monitors"][alarm] for alarm in ALARMS):
        yield Finding("other sums", name, f"{each['unnoticed']} unnoticed of {each['violated']}, without alarms")


def _summed(name: str, each: Told, rides: int) -> Iterator[Finding]:
    """What is summed up is no less than the most in a ride, no more than that in each, and a way that can be run."""
    sums, most = each["sums"], each["most"]
    for what, count in sums.items():
        if what not in SIGNED:
            yield from _within(name, what, count, None)
            if not most[what] <= count <= most[what] * rides:
                yield Finding("other sums", name, f"{what}: {count} in all of {rides}, with {most[what]} at most")
    if sums["cycles"] < rides or sums["way_mm"] > sums["cycles"] * MM_A_CYCLE:
        yield Finding("other sums", name, f"{sums['cycles']} cycles of {rides} rides over {sums['way_mm']} mm")
    if each["long"] * LEAST_WAY_M * MM_A_M > sums["way_mm"]:
        yield Finding("other sums", name, f"{each['long']} long rides over {sums['way_mm']} mm in all")


def lived(name: str, told: Told, system: System) -> Iterator[Finding]:
    """Nothing is counted on more days than there were, and what is counted goes together with what is in all."""
    days, columns = told["days"], told["columns"]
    yield from _within(name, "days", days, None, least=1)
    yield from _within(name, "violated", told["violated"], days)
    for group in columns.values():
        for what, each in group.items():
            on, most = each["on days"], each["most in a day"]
            yield from _within(name, what, on, days)
            if not max(on, most) <= each["all"] <= most * on:
                yield Finding("other sums", name, f"{what}: {each['all']} on {on} days, with {most} at most")
    on_days = {key: [each["on days"] for each in columns[key].values()] for key in ("claims", "assumptions")}
    yield from _explained(name, told, on_days["claims"], on_days["assumptions"])
    if days:
        now = Lived(system, days, {}, {}, {}, told["violated"], told["unexplained"])
        yield from _reckoned(name, told, {"bound": now.bound, "hours": now.hours})
    for fault, each in told["beyond"].items():
        if fault not in system.beyond:
            yield Finding("foreign count", name, f"{fault}: the sources have no such fault beyond what is assumed")
        yield from _within(name, fault, each["days"], days)
        for key, most in (("violated", each["days"]), ("unexplained", each["violated"]), ("unnoticed", each["days"])):
            yield from _within(name, f"{fault}: {key}", each[key], most)
        for monitor, count in each["noticed"].items():
            yield from _within(name, f"{fault}: {monitor}", count, each["days"])


def _explained(name: str, told: Told, claims: Collection[int], assumptions: Collection[int]) -> Iterator[Finding]:
    """Where a claim is broken it is one of them, and where that is explained one of the assumptions is broken."""
    violated, unexplained = told["violated"], told["unexplained"]
    yield from _within(name, "unexplained", unexplained, violated)
    if not max(claims, default=0) <= violated <= sum(claims):
        yield Finding("other sums", name, f"{violated} with a claim broken, and its claims {list(claims)}")
    if violated - unexplained > sum(assumptions):
        yield Finding("other sums", name, f"{violated} with a claim broken, {unexplained} of them without a cause")


def _reckoned(name: str, told: Told, now: Mapping[str, float]) -> Iterator[Finding]:
    for key, value in now.items():
        if told[key] != value:
            yield Finding("other sums", name, f"{key}: {told[key]}, and what stands in it comes to {value}")


def _within(name: str, what: str, count: int, most: int | None, least: int = 0) -> Iterator[Finding]:
    if type(count) is not int or count < least or (most is not None and count > most):
        yield Finding("other sums", name, f"{what}: {count}{'' if most is None else f' of {most}'}")
