"""A promise: what comes about at last, if a few named steps are taken again and again (liveness).

An invariant says that nothing bad ever happens; a promise says that something good does.  It is a row of
links that ends in a goal.  Each link holds until a later one does, or the goal; and one step, with the event that
it is about, takes it there.  The number of links still to go is a rank: no step of the world makes it greater, each
link's own step makes it smaller, and at none the goal is reached.  Where one step does not take a link all the way,
as a cycle does not take a train to its end, the link has a whole number of its own, never below 0: no step makes it
greater while the link holds, and the link's own step makes it smaller, or leads on.  What may come in between and is
no goal has a name too, and no link's own step ends in it.  Fairness is all that is asked beside: each link's step is
taken at last, and again while its link holds, and not put off for ever.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from typing import Any

from proofs.transitions import event_types

Predicate = Callable[..., bool]
Measure = Callable[..., int]


@dataclass(frozen=True, eq=False)
class Link:
    """One stretch of the way to the goal.

    ``holds``: where the system is, a predicate of site, system and what the promise is about.
    ``by``: the transition that takes it further; its event's fields are what the promise is about, where they have
    the same names, and otherwise anything that ``provided`` allows, a predicate of all of them.
    ``rank``: how far it still is within the link, where that takes more than one step: a whole number of what
    ``holds`` is about, 0 or more.
    """

    holds: Predicate
    by: Callable[..., Any]
    provided: Predicate | None = None
    rank: Measure | None = None


@dataclass(frozen=True, eq=False)
class Promise:
    """From any of the ``links``, in their order, comes the ``goal``; the goal names what may come in between.

    ``unless``: what may come in between and is no goal: a link's own step never leads there.
    """

    links: tuple[Link, ...]
    goal: Predicate
    unless: Predicate | None = None

    @property
    def name(self) -> str:
        """The goal's."""
        return self.goal.__name__

    @property
    def about(self) -> Mapping[str, Any]:
        """What it is about, by name and type."""
        return {name: kind for each in (*self.predicates, *self.ranks) for name, kind in event_types(each).items()}

    @property
    def predicates(self) -> tuple[Predicate, ...]:
        """Everything that is asked of a state in it."""
        return (*self.ends, *(link.holds for link in self.links))

    @property
    def ends(self) -> tuple[Predicate, ...]:
        """The goal, and what else may end the way to it."""
        return (self.goal,) if self.unless is None else (self.goal, self.unless)

    @property
    def ranks(self) -> tuple[Measure, ...]:
        """Every number that is read in it."""
        return tuple(link.rank for link in self.links if link.rank is not None)


def by_goal(promises: Iterable[Promise]) -> dict[str, Promise]:
    """List promises by the names of their goals."""
    return {promise.name: promise for promise in promises}


def still_to_go(promise: Promise, site: Any, system: Any, about: Mapping[str, Any]) -> int | None:
    """Say how many links are still to go, none at the goal or another end; ``None`` where it says nothing of it."""
    if any(told(end, site, system, about) for end in promise.ends):
        return 0
    going = [
        len(promise.links) - place for place, link in enumerate(promise.links) if told(link.holds, site, system, about)
    ]
    return min(going, default=None)


def way_left(promise: Promise, site: Any, system: Any, about: Mapping[str, Any]) -> tuple[int, int] | None:
    """Say how many links are still to go, and how far it is within the first of them; ``None`` as above."""
    to_go = still_to_go(promise, site, system, about)
    if to_go is None:
        return None
    rank = promise.links[len(promise.links) - to_go].rank if to_go else None
    return to_go, 0 if rank is None else read(rank, site, system, about)


def told(predicate: Predicate, site: Any, system: Any, given: Mapping[str, Any]) -> bool:
    """Ask a predicate, in CPython, for those of the values that it is about."""
    return bool(read(predicate, site, system, given))


def read(function: Callable[..., Any], site: Any, system: Any, given: Mapping[str, Any]) -> Any:
    """Call it, in CPython, with those of the values that it is about."""
    return function(site, system, **{name: given[name] for name in event_types(function)})
