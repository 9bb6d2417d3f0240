"""CPython has the last word: the state is unpacked, the step taken there, every invariant of the true kernel asked."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any

from fuzz.compiled.memory import ALL_PARTS, HEADER, Ints, Memory
from fuzz.compiled.native import Native, event_places
from fuzz.compiled.places import Array, Bits, Fields, Place, Words, spread
from fuzz.failures.replaying import ERRORS, UNDEFINED
from fuzz.jolted.searching import Find
from models.world.state import Site, System
from proofs.catalogue import INVARIANTS
from proofs.lift.kinds import Scalar
from proofs.mutated import Sources, running
from proofs.transitions import TRANSITIONS, event_types

AGREES = "the_engine_agrees_with_cpython"
"""What is violated where the compiled engine and CPython say different things; no name of an invariant."""
NAMES = tuple(INVARIANTS)


@dataclass(frozen=True)
class Confirmed:
    """What CPython says of an event in a state.

    ``violated``: the invariants that are false then, or ``AGREES``, or ``UNDEFINED``; none of a sample.
    ``why``: in what the two differ.  ``undefined``: the state before has a look-up of what is not there, so
    it is no state in which every invariant holds, and shows nothing.
    """

    violated: tuple[str, ...]
    before: System
    event: Mapping[str, Any]
    why: str = ""
    undefined: bool = False


def confirmed(native: Native, sources: Sources, find: Find, thorough: bool = True) -> Confirmed:
    """Take an event in CPython, with a planted fault running, and compare what came of it.

    ``thorough``: a sample's invariants are compared too, before and after.
    """
    words, before, event = unpacked(native, find)
    thorough = thorough or find.judged is not None
    site = native.memory.site
    if thorough:
        unfit = _unfit(site, before, event)
        if unfit is not None:
            return unfit
    changed = native.call("step", words, find.kind)
    try:
        with running(sources):
            after = TRANSITIONS[find.kind](site, before, **event)
    except ERRORS:
        unfit = None if thorough else _unfit(site, before, event)
        return unfit or Confirmed((UNDEFINED,), before, event)
    if (after != before) != bool(changed) or native.memory.unpack(words) != after:
        return Confirmed((AGREES,), before, event, "another state after the event")
    return _judged(native, find, words, before, event, after) if thorough else Confirmed((), before, event)


def unpacked(native: Native, find: Find) -> tuple[Ints, System, dict[str, Any]]:
    """A memory with the state and the event, and both as CPython has them."""
    laid = native.memory
    words = laid.new()
    words[: len(find.words)] = find.words
    return words, laid.unpack(words), event_in(laid, words, find.kind)


def _unfit(site: Site, before: System, event: Mapping[str, Any]) -> Confirmed | None:
    """Whether the state before is one in which every invariant holds; what is said if not."""
    false, raised = asked(site, before)
    if false:
        return Confirmed((AGREES,), before, event, f"before the event {', '.join(false)} is false")
    return Confirmed((), before, event, undefined=True) if raised else None


def _judged(
    native: Native, find: Find, words: Ints, before: System, event: Mapping[str, Any], after: System
) -> Confirmed:
    """Compare what both say of the invariants after the event."""
    false, raised = asked(native.memory.site, after)
    if find.judged is None:
        words[[HEADER.index("grown"), HEADER.index("shrunk")]] = ALL_PARTS
        number = native.call("judge", words)
        said = (NAMES[number],) if number >= 0 else ()
    else:
        said = (NAMES[find.judged],)
    if set(said) - {*false, *raised} or (false and not said):
        what = f"CPython finds {', '.join(false) or 'nothing'} false then, the engine {', '.join(said) or 'nothing'}"
        return Confirmed((AGREES,), before, event, what)
    return Confirmed(tuple(name for name in NAMES if name in {*false, *raised}), before, event)


def asked(site: Site, system: System) -> tuple[tuple[str, ...], tuple[str, ...]]:
    """The invariants that are false, and those that look up what is not there."""
    false, raised = [], []
    for name, holds in INVARIANTS.items():
        try:
            if not holds(site, system):
                false.append(name)
        except ERRORS:
            raised.append(name)
    return tuple(false), tuple(raised)


def event_in(laid: Memory, words: Ints, kind: int) -> dict[str, Any]:
    """The event in the buffer."""
    runs = laid.runs_in(words)

    def scalar(of: Scalar, numbers: list[int]) -> Any:
        if len(numbers) == 1:
            return runs[numbers[0]] if of.name == "Run" else laid.domains.name(of, numbers[0])
        parts = zip(spread(of), numbers, strict=True)
        return of.source(*(laid.domains.name(part, number) for (_, part), number in parts))

    event: dict[str, Any] = {}
    for name, place in event_places(laid, kind).items():
        match place:
            case Words(of, arrays, _):
                event[name] = scalar(of, [int(words[array.base]) for array in arrays])
            case Fields(record, below):
                event[name] = record(
                    **{
                        each: scalar(of, [int(words[array.base]) for array in arrays])
                        for each, of, arrays in _words_of(below)
                    }
                )
            case Bits((of,), _, array):
                event[name] = frozenset(scalar(of, [number]) for number in _members(words, array))
    assert event.keys() == event_types(TRANSITIONS[kind]).keys(), event
    return event


def _words_of(below: Mapping[str, Place]) -> Iterator[tuple[str, Scalar, tuple[Array, ...]]]:
    """The fields of a record of scalars, and where each one's words are."""
    for name, place in below.items():
        assert isinstance(place, Words)
        yield name, place.kind, place.arrays


def _members(words: Ints, array: Array) -> list[int]:
    return [bit for bit in range(64 * array.size) if int(words[array.base + bit // 64]) >> (bit % 64) & 1]
