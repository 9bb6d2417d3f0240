"""The obligations of promises: over each transition no rank grows, and each link's own step makes it smaller."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Any

import z3

from proofs.promise import Link, Promise
from proofs.transitions import event_types
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
        here = [*_is_at(bench, promise, link, bench.before, about)]
        for way in bench.ways(transition):
            ahead = _ahead(bench, promise, promise.links[place:], way.after, about)
            yield [*here, way.condition, *way.definitions], ahead
        if bench.theory.steps[transition] is link.by:
            yield from _helped(bench, promise, place, transition)


def _helped(bench: Workbench, promise: Promise, place: int, transition: str) -> Iterator[tuple[list[Any], Any]]:
    """What the link's own step comes to: a later link or the goal, and so it does not refuse either."""
    link = promise.links[place]
    event = bench.event(transition)
    about = {
        name: event[name] if name in event else bench.scope.constant(kind, f"about.{name}")
        for name, kind in promise.about.items()
    }
    here = [*_is_at(bench, promise, link, bench.before, about)]
    if link.provided is not None:
        here.append(_said(bench, link.provided, bench.before, {**event, **about}))
    for way in bench.ways(transition):
        yield (
            [*here, way.condition, *way.definitions],
            _ahead(bench, promise, promise.links[place + 1 :], way.after, about),
        )
    for refusal in bench.refusals(transition):
        yield [*here, refusal], _ahead(bench, promise, promise.links[place + 1 :], bench.before, about)


def _is_at(bench: Workbench, promise: Promise, link: Link, state: Any, about: Mapping[str, Any]) -> tuple[Any, Any]:
    return _said(bench, link.holds, state, about), z3.Not(_said(bench, promise.goal, state, about))


def _ahead(bench: Workbench, promise: Promise, links: Sequence[Link], state: Any, about: Mapping[str, Any]) -> Any:
    """The goal, or one of these links."""
    predicates = [promise.goal, *(link.holds for link in links)]
    return z3.Or(*(_said(bench, predicate, state, about) for predicate in predicates))


def _said(bench: Workbench, predicate: Callable[..., bool], state: Any, given: Mapping[str, Any]) -> Any:
    return bench.lifter.formula(predicate, bench.site, state, *(given[name] for name in event_types(predicate)))
