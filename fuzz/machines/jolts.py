"""States of the interlocking that no run need lead to, but in which all that is claimed holds.

The invariants are inductive: from any state in which all of them hold, on any layout that satisfies the
axioms, no step breaks one.  So a run may be jolted anywhere between two steps.  What breaks a claim then
is a counterexample to induction: of guards that hold against what the rest of the system never does.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from enum import Enum
from random import Random
from typing import Any

from fuzz.failures.replaying import ERRORS
from fuzz.machines.moves import EVERY, FOCUS, SERVED, Move, Moves
from fuzz.machines.plausible import UNREAD
from fuzz.machines.strange import VALUES, Pick, strange
from fuzz.machines.watched import Broken, Place, judged
from kernel.layout import Layout
from kernel.machine.centre import NO_ROUTE
from kernel.names import Record, Route, Serial
from models.world.state import Site, System
from proofs.catalogue import AXIOMS, PREMISES
from proofs.lift.kinds import Kind, MapKind, OptionKind, RecordKind, Scalar, SetKind, TupleKind, fields_of, kind_of_type
from proofs.mutated import Sources

ROUNDS = 40
TRIES = 6
"""So many changes are tried in a jolt; those after which something claimed is false are taken back."""
MOVES_BETWEEN = 8
"""So many moves between two jolts."""
MOVED = (Moves.goes_on, Moves.happens, Moves.goes_wrong, Moves.arrives, Moves.is_strange)
OF_LAYOUT = 8
"""One jolt in so many is of the layout and not of the state."""


class Jolted(Moves):
    """Moves in a play that is jolted now and then; ``landed`` counts the changes that were let stand."""

    landed = 0

    def jolt(self, pick: Pick) -> None:
        """Change the state, or the layout, in a few places, if all that is claimed and assumed still holds."""
        for _ in range(TRIES):
            site, system = self.play.site, self.play.system
            try:
                if pick(OF_LAYOUT) == OF_LAYOUT - 1:
                    layout = another(site.layout, kind_of_type(Layout), site, system, pick)
                    site = replace(site, layout=layout)
                else:
                    system = another(system, kind_of_type(System), site, system, pick)
                fits = self._fits(site, system)
            except ERRORS:
                continue
            if fits:
                self.play.site, self.play.system = site, system
                self.landed += 1

    def stumble(self, move: Move, pick: Pick) -> bool:
        """Make a move, if the state has what it reads; tell whether anything changed."""
        try:
            return move(self, pick)
        except Broken:
            raise
        except ERRORS:
            return False

    def _fits(self, site: Site, system: System) -> bool:
        if site is not self.play.site and not is_legal(site):
            return False
        return judged(site, system) == ()


def is_legal(site: Site) -> bool:
    """Whether the site satisfies every layout axiom and every premise."""
    return all(axiom(site.layout, site.ground) for axiom in AXIOMS.values()) and all(
        premise(site) for premise in PREMISES.values()
    )


def thinned(place: Place, random: Random) -> Place:
    """The same place on a layout that says less: one thing that it maps is left out, some of it or all.

    The axioms leave a layout free to say nothing of some things that every importer says; the proof holds for such
    layouts too.
    """
    name = random.choice(free_to_say_nothing_of(place))
    known = sorted(getattr(place.site.layout, name), key=repr)
    thin = _saying(place.site, name, random.sample(known, random.randrange(len(known))) if random.randrange(2) else ())
    return replace(place, site=thin) if _is_surely_legal(thin) else place


def free_to_say_nothing_of(place: Place) -> list[str]:
    """What of the things that a place's layout maps may be left out altogether."""
    layout = place.site.layout
    maps = [name for name, kind in fields_of(Layout).items() if isinstance(kind, MapKind) and getattr(layout, name)]
    return [name for name in maps if _is_surely_legal(_saying(place.site, name, ()))]


def _saying(site: Site, name: str, keys: Sequence[Any]) -> Site:
    """The same site; of one thing that its layout maps it says nothing but of these keys."""
    changes: dict[str, Any] = {name: {key: getattr(site.layout, name)[key] for key in keys}}
    return replace(site, layout=replace(site.layout, **changes))


def _is_surely_legal(site: Site) -> bool:
    """Whether it is legal, and no axiom looks up what it does not say."""
    try:
        return is_legal(site)
    except ERRORS:
        return False


def jolted_walk(place: Place, sources: Sources, random: Random) -> Jolted:
    """Some service, then jolts, and a few moves after each; the same for the same state of ``random``.

    Jolts stop service sooner than it brings a train on its way: what has never begun to roll cannot slip either.

    Raises:
        Broken: something claimed is false; its trace does not say what was jolted.
    """
    going = Jolted(place, sources, random.sample(EVERY, random.choice(FOCUS)))
    going.start_service()
    for _ in range(random.randrange(SERVED)):
        going.goes_on(random.randrange)
    for _ in range(ROUNDS):
        going.jolt(random.randrange)
        for _ in range(MOVES_BETWEEN):
            going.stumble(random.choice(MOVED), random.randrange)
    return going


# ---- a value with one thing in it changed


def another(value: Any, kind: Kind, site: Site, system: System, pick: Pick) -> Any:
    """A value of the same kind in which one thing is another."""
    match kind:
        case RecordKind(cls):
            parts = fields_of(cls)
            name = list(parts)[pick(len(parts))]
            return replace(value, **{name: another(getattr(value, name), parts[name], site, system, pick)})
        case MapKind(key, inner):
            return _another_map(value, key, inner, site, system, pick)
        case SetKind(element):
            return value ^ frozenset({made(element, site, system, pick)})
        case OptionKind(inner):
            return None if value is not None and pick(2) else made(inner, site, system, pick)
        case _:
            return made(kind, site, system, pick)


def _another_map(value: Any, key: Kind, inner: Kind, site: Site, system: System, pick: Pick) -> Any:
    """An entry less, one more, or one changed."""
    known = sorted(value, key=repr)
    choice = pick(4) if known else 3
    if choice == 3:
        return value | {made(key, site, system, pick): made(inner, site, system, pick)}
    at = known[pick(len(known))]
    if choice == 2:
        return {name: each for name, each in value.items() if name != at}
    return value | {at: another(value[at], inner, site, system, pick)}


def made(kind: Kind, site: Site, system: System, pick: Pick) -> Any:
    """Some value of a kind, sets and maps with one thing in them or none."""
    match kind:
        case RecordKind(cls):
            return cls(**{name: made(each, site, system, pick) for name, each in fields_of(cls).items()})
        case MapKind(key, inner):
            return {made(key, site, system, pick): made(inner, site, system, pick) for _ in range(pick(2))}
        case SetKind(element):
            return frozenset(made(element, site, system, pick) for _ in range(pick(2)))
        case OptionKind(inner):
            return made(inner, site, system, pick) if pick(2) else None
        case TupleKind(items):
            return tuple(made(each, site, system, pick) for each in items)
        case Scalar(source=source):
            return _scalar(source, site, system, pick)
    raise TypeError(kind)


def _scalar(source: Any, site: Site, system: System, pick: Pick) -> Any:
    if source in VALUES:
        return strange(site, system, source, pick)
    if isinstance(source, type) and issubclass(source, Enum):
        return list(source)[pick(len(source))]
    if source is Route:
        routes = (*sorted(site.layout.routes), NO_ROUTE)
        return routes[pick(len(routes))]
    if source is Record:
        return UNREAD
    assert source is Serial, source
    return Serial(system.centre.newest + pick(3))
