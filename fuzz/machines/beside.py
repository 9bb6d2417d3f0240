"""Runs of every theory beside the interlocking: machines on board, and the radio link.

A run begins in a state of some witness and goes on as the witness did, integers changed here and there,
or with what any witness was once told.  It may begin in a state that no witness was in: integers of site
and state changed, if all that is claimed and presumed still holds.  What breaks a claim from there is a
counterexample to induction, which no run need lead to.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, fields, is_dataclass, replace
from random import Random
from typing import Any

from fuzz.failures.replaying import UNDEFINED
from proofs.catalogue import INTERLOCKING
from proofs.mutants.plays import Call, calls_of
from proofs.mutated import Sources, running
from proofs.theories import THEORIES

BESIDE = tuple(name for name in THEORIES if name != INTERLOCKING.name)
"""The theories beside the interlocking, by name."""
ERRORS = (KeyError, AttributeError, TypeError, ValueError, ZeroDivisionError, IndexError, AssertionError)
STEPS = 30
MANY = 10_000
"""So many of the witnesses' steps are told apart in a walk."""
NEAR = (1, -1, 2, -2, 10, -10, 100, -100, 1_000, -1_000)
"""By so much an integer is changed."""
SELDOM = 5
"""One integer in so many is another in what is shaken, and one truth in twice as many."""
MORE_SELDOM = (SELDOM, SELDOM, 4 * SELDOM, 4 * SELDOM, 16 * SELDOM, 16 * SELDOM, 16 * SELDOM, 16 * SELDOM)
"""The same in each try of a jolt: the fewer are changed, the likelier all that is claimed still holds."""


@dataclass(frozen=True)
class Told:
    """One step that was taken, and what it was told."""

    step: str
    event: Mapping[str, Any]


class BrokenClaim(AssertionError):
    """A claim of a theory is false, or a step not defined, after these steps; ``run``: what they were taken in."""

    def __init__(self, run: Beside, violated: tuple[str, ...]) -> None:
        super().__init__(f"{run.theory.name}: {', '.join(violated)} after {len(run.taken)} steps")
        self.run = run
        self.theory = run.theory.name
        self.violated = violated
        self.taken = tuple(run.taken)


class Beside:
    """A run of a theory, from where a witness was before one of its steps."""

    def __init__(self, theory: str, sources: Sources, first: int) -> None:
        self.theory = THEORIES[theory]
        self.sources = sources
        self.calls = calls_of(theory)
        self.at = first % len(self.calls)
        self.begin(self.calls[self.at].site, self.calls[self.at].before)

    def begin(self, site: Any, system: Any) -> None:
        """Begin here, with nothing taken yet."""
        self.site = site
        self.first = self.system = system
        self.taken: list[Told] = []
        self.changed = 0

    def jolt(self, random: Random) -> bool:
        """Change integers of site and state, if all that is claimed and presumed still holds; tell whether any are."""
        for seldom in MORE_SELDOM:
            site, system = shaken(self.site, random, (), seldom), shaken(self.system, random, (), seldom)
            if (site, system) != (self.site, self.system) and self._fits(site, system):
                self.begin(site, system)
                return True
        return False

    def _fits(self, site: Any, system: Any) -> bool:
        try:
            return all(claim(site) for claim in self.theory.premises.values()) and not self.false(site, system)
        except ERRORS:
            return False

    def goes_on(self, random: Random) -> None:
        """What the witness was told next, or nearly; from its end it goes on with the next witness's."""
        call = self.calls[self.at]
        self.at = (self.at + 1) % len(self.calls)
        self._take(call, random)

    def is_told(self, which: int, random: Random) -> None:
        """What some witness was told at some time, or nearly."""
        self._take(self.calls[which % len(self.calls)], random)

    def _take(self, call: Call, random: Random) -> None:
        pool = (*integers(self.site), *integers(self.system))
        self.take(Told(call.step, {name: shaken(value, random, pool) for name, value in call.event.items()}))

    def take(self, told: Told) -> None:
        """Take a step.

        Raises:
            BrokenClaim: a claim is false after it, or it is not defined.
        """
        self.taken.append(told)
        try:
            with running(self.sources):
                after = self.theory.steps[told.step](self.site, self.system, **told.event)
        except ERRORS as error:
            raise BrokenClaim(self, (UNDEFINED,)) from error
        if after != self.system:
            self.system = after
            self.changed += 1
            false = self.false(self.site, self.system)
            if false:
                raise BrokenClaim(self, false)

    def false(self, site: Any, system: Any) -> tuple[str, ...]:
        """The claims that are false of a state."""
        return tuple(name for name, claim in self.theory.invariants.items() if not claim(site, system))


# ---- fewer steps


def shortened(broken: BrokenClaim) -> BrokenClaim:
    """Begin where some witness was, if fewer of the last steps will then do; leave out every step that may go.

    The same claim, the first of those that are false, breaks as well.
    """
    run, steps = broken.run, broken.taken
    for many in range(1, len(steps)):
        begun = (_again(run, call.site, call.before, steps[-many:]) for call in run.calls)
        fewer = next((each for each in begun if _breaks_the_same(each, broken)), None)
        if fewer is not None:
            broken = fewer
            break
    at = len(broken.taken) - 1
    while at > 0:
        at -= 1
        fewer = _again(broken.run, broken.run.site, broken.run.first, broken.taken[:at] + broken.taken[at + 1 :])
        if fewer is not None and _breaks_the_same(fewer, broken):
            broken, at = fewer, len(fewer.taken) - 1
    return broken


def _breaks_the_same(one: BrokenClaim | None, other: BrokenClaim) -> bool:
    return one is not None and one.violated[0] == other.violated[0]


def _again(run: Beside, site: Any, first: Any, steps: Sequence[Told]) -> BrokenClaim | None:
    """What these steps break from there; none if nothing."""
    again = Beside(run.theory.name, run.sources, run.at)
    again.begin(site, first)
    try:
        for told in steps:
            again.take(told)
    except BrokenClaim as broken:
        return broken
    return None


# ---- integers, here and there another


def shaken(value: Any, random: Random, pool: Sequence[int], seldom: int = SELDOM) -> Any:
    """A value with few of its integers and truths changed, to near ones or to others of the same run."""
    if isinstance(value, bool):
        return value ^ (random.randrange(2 * seldom) == 2 * seldom - 1)
    if isinstance(value, int):
        return _another(value, random, pool) if random.randrange(seldom) == seldom - 1 else value
    if isinstance(value, dict):
        return {key: shaken(each, random, pool, seldom) for key, each in value.items()}
    if isinstance(value, tuple) and not hasattr(value, "_fields"):
        return tuple(shaken(each, random, pool, seldom) for each in value)
    if is_dataclass(value) and not isinstance(value, type):
        parts = {part.name: shaken(getattr(value, part.name), random, pool, seldom) for part in fields(value)}
        return replace(value, **parts)
    return value


def _another(value: int, random: Random, pool: Sequence[int]) -> int:
    if pool and random.randrange(2):
        return pool[random.randrange(len(pool))] + random.randrange(3) - 1
    return value + NEAR[random.randrange(len(NEAR))]


def integers(value: Any) -> Iterator[int]:
    """Every integer in a value."""
    if isinstance(value, bool):
        return
    if isinstance(value, int):
        yield value
    elif isinstance(value, dict):
        for each in value.values():
            yield from integers(each)
    elif isinstance(value, tuple):
        for each in value:
            yield from integers(each)
    elif is_dataclass(value) and not isinstance(value, type):
        for part in fields(value):
            yield from integers(getattr(value, part.name))


def walk(theory: str, sources: Sources, random: Random, moves: int = STEPS) -> Beside:
    """Make so many moves by chance; the same for the same state of ``random``.

    Raises:
        BrokenClaim: a claim is false.
    """
    run = Beside(theory, sources, random.randrange(MANY))
    if random.randrange(2):
        run.jolt(random)
    moved: Sequence[Callable[[], None]] = (
        lambda: run.goes_on(random),
        lambda: run.is_told(random.randrange(MANY), random),
    )
    for _ in range(moves):
        moved[random.randrange(4) == 3]()
    return run
