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


@dataclass(frozen=True)
class Told:
    """One step that was taken, and what it was told."""

    step: str
    event: Mapping[str, Any]


class BrokenClaim(AssertionError):
    """A claim of a theory is false, or a step not defined, after these steps."""

    def __init__(self, theory: str, violated: tuple[str, ...], taken: Sequence[Told]) -> None:
        super().__init__(f"{theory}: {', '.join(violated)} after {len(taken)} steps")
        self.theory = theory
        self.violated = violated
        self.taken = tuple(taken)


class Beside:
    """A run of a theory, from where a witness was before one of its steps."""

    def __init__(self, theory: str, sources: Sources, first: int) -> None:
        self.theory = THEORIES[theory]
        self.sources = sources
        self.calls = calls_of(theory)
        self.at = first % len(self.calls)
        self.site, self.system = self.calls[self.at].site, self.calls[self.at].before
        self.taken: list[Told] = []
        self.changed = 0

    def jolt(self, random: Random) -> bool:
        """Change integers of site and state, if all that is claimed and presumed still holds; tell whether it does."""
        site, system = shaken(self.site, random, ()), shaken(self.system, random, ())
        try:
            fits = all(claim(site) for claim in self.theory.premises.values()) and not self.false(site, system)
        except ERRORS:
            return False
        if fits:
            self.site, self.system = site, system
        return fits

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
        told = Told(call.step, {name: shaken(value, random, pool) for name, value in call.event.items()})
        self.taken.append(told)
        try:
            with running(self.sources):
                after = self.theory.steps[told.step](self.site, self.system, **told.event)
        except ERRORS as error:
            raise BrokenClaim(self.theory.name, (UNDEFINED,), self.taken) from error
        if after != self.system:
            self.system = after
            self.changed += 1
            false = self.false(self.site, self.system)
            if false:
                raise BrokenClaim(self.theory.name, false, self.taken)

    def false(self, site: Any, system: Any) -> tuple[str, ...]:
        """The claims that are false of a state."""
        return tuple(name for name, claim in self.theory.invariants.items() if not claim(site, system))


# ---- integers, here and there another


def shaken(value: Any, random: Random, pool: Sequence[int]) -> Any:
    """A value with few of its integers and truths changed, to near ones or to others of the same run."""
    if isinstance(value, bool):
        return value ^ (random.randrange(10) == 9)
    if isinstance(value, int):
        return _another(value, random, pool) if random.randrange(5) == 4 else value
    if isinstance(value, dict):
        return {key: shaken(each, random, pool) for key, each in value.items()}
    if isinstance(value, tuple) and not hasattr(value, "_fields"):
        return tuple(shaken(each, random, pool) for each in value)
    if is_dataclass(value) and not isinstance(value, type):
        return replace(value, **{part.name: shaken(getattr(value, part.name), random, pool) for part in fields(value)})
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
