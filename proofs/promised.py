"""The obligations of promises: over each transition no rank grows, and each link's own step makes it smaller.

The rank is the number of links still to go, and then the link's own, if it has one.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import partial
from typing import Any

import z3

from proofs.lift.terms import to_z3
from proofs.promise import Link, Promise
from proofs.ways import Way
from proofs.workbench import Part, Workbench


def parts(bench: Workbench, transition: str, name: str, hypotheses: list[str] | None) -> list[Part]:
    """Lay out what a promise asks of one transition; ``None`` means every hypothesis there is."""
    promise = bench.theory.promises[name]
    available = {**bench.assumed, **bench.invariants}
    chosen = available if hypotheses is None else {each: available[each] for each in hypotheses}
    return bench.asked(chosen, _asked(bench, promise, transition))


def _asked(bench: Workbench, promise: Promise, transition: str) -> Iterator[tuple[list[Any], Any]]:
    about = {name: bench.scope.constant(kind, f"about.{name}") for name, kind in promise.about.items()}
    for place, link in enumerate(promise.links):
        here = _is_at(bench, promise, link, bench.before, about)
        yield from _over(bench, transition, here, partial(_no_farther, bench, promise, place, about))
        if bench.theory.steps[transition] is link.by:
            yield from _helped(bench, promise, place, transition)
            if link.rank is not None:
                yield here, _measured(bench, link.rank, bench.before, about) >= 0


def _helped(bench: Workbench, promise: Promise, place: int, transition: str) -> Iterator[tuple[list[Any], Any]]:
    """What the link's own step comes to: nearer the goal by the rank, and so it does not refuse either."""
    link = promise.links[place]
    event = bench.event(transition)
    about = {
        name: event[name] if name in event else bench.scope.constant(kind, f"about.{name}")
        for name, kind in promise.about.items()
    }
    here = _is_at(bench, promise, link, bench.before, about)
    if link.provided is not None:
        here.append(_said(bench, link.provided, bench.before, {**event, **about}))
    yield from _over(bench, transition, here, partial(_nearer, bench, promise, place, about))
    for refusal in bench.refusals(transition):
        yield [*here, refusal], z3.Or(*_ahead(bench, promise, promise.links[place + 1 :], bench.before, about))


def _over(
    bench: Workbench, transition: str, here: list[Any], comes_to: Callable[[Any], Any]
) -> Iterator[tuple[list[Any], Any]]:
    """Ask of every way what it comes to; of ways that come to the same once, if none has symbols of its own."""
    asked = dict[tuple[int, int], tuple[list[Way], Any]]()
    for number, way in enumerate(bench.ways(transition)):
        goal = comes_to(way.after)
        asked.setdefault((goal.get_id(), number if way.definitions else -1), ([], goal))[0].append(way)
    for ways, goal in asked.values():
        definitions = [formula for way in ways for formula in way.definitions]
        for condition in bench.conditions(ways):
            yield [*here, condition, *definitions], goal


def _no_farther(bench: Workbench, promise: Promise, place: int, about: Mapping[str, Any], state: Any) -> Any:
    """The goal or another end, a later link, or this one with no more of its own rank than before."""
    link = promise.links[place]
    ended = [] if promise.unless is None else [_said(bench, promise.unless, state, about)]
    if link.rank is None:
        return z3.Or(*_ahead(bench, promise, promise.links[place:], state, about), *ended)
    was, left = _measured(bench, link.rank, bench.before, about), _measured(bench, link.rank, state, about)
    stays = z3.And(_said(bench, link.holds, state, about), left <= was)
    return z3.Or(*_ahead(bench, promise, promise.links[place + 1 :], state, about), *ended, stays)


def _nearer(bench: Workbench, promise: Promise, place: int, about: Mapping[str, Any], state: Any) -> Any:
    """The goal, a later link, or this one with less of its own rank; no other end."""
    link, ahead = promise.links[place], _ahead(bench, promise, promise.links[place + 1 :], state, about)
    if link.rank is None:
        return z3.Or(*ahead)
    was, left = _measured(bench, link.rank, bench.before, about), _measured(bench, link.rank, state, about)
    return z3.Or(*ahead, z3.And(_said(bench, link.holds, state, about), left < was))


def _is_at(bench: Workbench, promise: Promise, link: Link, state: Any, about: Mapping[str, Any]) -> list[Any]:
    ended = [z3.Not(_said(bench, end, state, about)) for end in promise.ends]
    return [_said(bench, link.holds, state, about), *ended]


def _ahead(
    bench: Workbench, promise: Promise, links: Sequence[Link], state: Any, about: Mapping[str, Any]
) -> list[Any]:
    """The goal, and each of these links."""
    return [_said(bench, predicate, state, about) for predicate in (promise.goal, *(link.holds for link in links))]


def _said(bench: Workbench, predicate: Callable[..., bool], state: Any, given: Mapping[str, Any]) -> Any:
    return to_z3(bench.told_of(predicate, state, given))


def _measured(bench: Workbench, rank: Callable[..., int], state: Any, given: Mapping[str, Any]) -> Any:
    return to_z3(bench.told_of(rank, state, given))
