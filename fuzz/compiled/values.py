"""What the source text stands for: values that know how to be computed, tested, looped over and written.

Nothing is computed until it is used; computing has no effects, so using a value twice computes it twice.
"""

from __future__ import annotations

import itertools
from collections.abc import Callable, Hashable, Sequence
from dataclasses import dataclass, field
from typing import Any, TypeAlias

from llvmlite import ir

from fuzz.compiled.emitter import EITHER_WAY, I1, I64, Emitter
from proofs.lift.kinds import Scalar

Key = Hashable
Body = Callable[["Value"], None]


@dataclass(frozen=True)
class Num:
    """A word; two with one ``key`` are the same word."""

    key: Key
    emit: Callable[[Emitter], ir.Value] = field(compare=False, repr=False)


def constant(number: int) -> Num:
    """A known word."""
    return Num(("constant", number), lambda e: I64(number))


_SERIAL = itertools.count()


def known(value: ir.Value) -> Num:
    """A word that has been computed: the index of a loop."""
    return Num(("known", next(_SERIAL)), lambda e: value)


class Truth:
    """A condition."""

    def jump(self, e: Emitter, yes: ir.Block, no: ir.Block) -> None:
        """Go on at one block or the other."""
        raise NotImplementedError

    def word(self) -> Num:
        """1 or 0."""

        def emit(e: Emitter) -> ir.Value:
            yes, no, after = e.block(), e.block(), e.block()
            with e.in_sense(EITHER_WAY):
                self.jump(e, yes, no)
            for each in (yes, no):
                e.enter(each)
                e.build.branch(after)
            e.enter(after)
            phi = e.build.phi(I64)
            phi.add_incoming(I64(1), yes)
            phi.add_incoming(I64(0), no)
            return phi

        return Num(("truth", id(self), next(_SERIAL)), emit)

    def when(self, e: Emitter, then: Callable[[], None]) -> None:
        """Do something if it holds."""
        yes, after = e.block(), e.block()
        self.jump(e, yes, after)
        e.enter(yes)
        then()
        e.build.branch(after)
        e.enter(after)


class Fixed(Truth):
    """Always true, or never."""

    def __init__(self, holds: bool) -> None:
        self.holds = holds

    def jump(self, e: Emitter, yes: ir.Block, no: ir.Block) -> None:
        """Go where it always goes."""
        e.build.branch(yes if self.holds else no)


YES, NO = Fixed(True), Fixed(False)


@dataclass(frozen=True)
class Test(Truth):
    """A condition that is one comparison."""

    bit: Callable[[Emitter], ir.Value]

    def jump(self, e: Emitter, yes: ir.Block, no: ir.Block) -> None:
        """Compare."""
        e.build.cbranch(self.bit(e), yes, no)


@dataclass(frozen=True)
class Not(Truth):
    """The contrary."""

    of: Truth

    def jump(self, e: Emitter, yes: ir.Block, no: ir.Block) -> None:
        """The other way round."""
        with e.in_sense(-e.sense):
            self.of.jump(e, no, yes)


@dataclass(frozen=True)
class Both(Truth):
    """One, and then the other."""

    one: Truth
    other: Truth

    def jump(self, e: Emitter, yes: ir.Block, no: ir.Block) -> None:
        """The second is looked at only if the first holds."""
        further = e.block()
        self.one.jump(e, further, no)
        e.enter(further)
        self.other.jump(e, yes, no)


@dataclass(frozen=True)
class IfTrue(Truth):
    """One or the other, as a condition says."""

    condition: Truth
    one: Truth
    other: Truth

    def jump(self, e: Emitter, yes: ir.Block, no: ir.Block) -> None:
        """Only one of them is looked at."""
        first, second = e.block(), e.block()
        with e.in_sense(EITHER_WAY):
            self.condition.jump(e, first, second)
        e.enter(first)
        self.one.jump(e, yes, no)
        e.enter(second)
        self.other.jump(e, yes, no)


@dataclass(frozen=True)
class Exists(Truth):
    """Some turn of a loop has it: ``loops(e, found)`` jumps to ``found`` from within."""

    loops: Callable[[Emitter, ir.Block], None]

    def jump(self, e: Emitter, yes: ir.Block, no: ir.Block) -> None:
        """Leave the loop as soon as one is found."""
        self.loops(e, yes)
        e.build.branch(no)


def both(*parts: Truth) -> Truth:
    """All of these, looked at in order."""
    left: Truth = YES
    for part in parts:
        if part is NO or left is NO:
            return NO
        left = part if left is YES else left if part is YES else Both(left, part)
    return left


def either(one: Truth, other: Truth) -> Truth:
    """One of these."""
    return negation(both(negation(one), negation(other)))


def negation(of: Truth) -> Truth:
    """The contrary."""
    if isinstance(of, Fixed):
        return NO if of.holds else YES
    return of.of if isinstance(of, Not) else Not(of)


def if_true(condition: Truth, one: Truth, other: Truth) -> Truth:
    """One or the other."""
    if isinstance(condition, Fixed):
        return one if condition.holds else other
    if isinstance(one, Fixed):
        return either(condition, other) if one.holds else both(negation(condition), other)
    return IfTrue(condition, one, other)


def same_words(one: Sequence[Num], other: Sequence[Num]) -> Truth:
    """Word by word the same."""
    parts = (
        YES if a.key == b.key else Test(lambda e, a=a, b=b: e.equal(a.emit(e), b.emit(e)))  # type: ignore[misc]
        for a, b in zip(one, other, strict=True)
    )
    return both(*parts)


def word_if(condition: Truth, one: Num, other: Num) -> Num:
    """One word or the other; only that one is computed."""
    if isinstance(condition, Fixed):
        return one if condition.holds else other
    if one.key == other.key:
        return one

    def emit(e: Emitter) -> ir.Value:
        yes, no, after = e.block(), e.block(), e.block()
        with e.in_sense(EITHER_WAY):
            condition.jump(e, yes, no)
        found = []
        for begin, num in ((yes, one), (no, other)):
            e.enter(begin)
            value = num.emit(e)
            found.append((value, e.build.block))
            e.build.branch(after)
        e.enter(after)
        phi = e.build.phi(I64)
        for value, block in found:
            phi.add_incoming(value, block)
        return phi

    return Num(("if", next(_SERIAL)), emit)


@dataclass(frozen=True)
class Word:
    """A scalar; ``none``: the first word where there is none."""

    kind: Scalar
    words: tuple[Num, ...]
    none: int | None = None


@dataclass(frozen=True)
class Nothing:
    """``None`` as it is written."""


@dataclass(frozen=True)
class Maybe:
    """A value that counts only where it is not missing."""

    missing: Truth
    value: Value


@dataclass(frozen=True)
class Items:
    """A tuple."""

    items: tuple[Value, ...]


Origin: TypeAlias = tuple[int, tuple[Key, ...]] | None
"""Which place of the state a value is the content of, by the place and the keys."""


class Record:
    """A record; ``choice``: it is one or the other of two."""

    def __init__(
        self,
        cls: type,
        get: Callable[[str], Value],
        origin: Origin = None,
        choice: tuple[Truth, Record, Record] | None = None,
    ) -> None:
        self.cls, self.get, self.origin, self.choice = cls, get, origin, choice


class Set:
    """A set: what is in it, and a loop over its elements, which may meet one twice."""

    origin: Origin = None

    def contains(self, element: Value) -> Truth:
        """Whether a value that is not None is in it."""
        raise NotImplementedError

    def each(self, e: Emitter, body: Body) -> None:
        """Do something for each."""
        raise NotImplementedError


class Map:
    """A map: its keys, and the value of a key that is there."""

    origin: Origin = None

    def keys(self) -> Set:
        """Its keys."""
        raise NotImplementedError

    def get(self, key: Value) -> Value:
        """The value of a key; anything if it is not there."""
        raise NotImplementedError


Value: TypeAlias = Truth | Word | Nothing | Maybe | Items | Record | Set | Map


def flat(value: Value) -> tuple[Num, ...]:
    """The words of an element or a key, which is not None."""
    value = some(value)
    if isinstance(value, Truth):
        return (value.word(),)
    if isinstance(value, Word):
        return value.words
    assert isinstance(value, Items), f"no key: {value}"
    return tuple(num for item in value.items for num in flat(item))


def truth_of(value: Value) -> Truth:
    """A value as a condition."""
    if isinstance(value, Truth):
        return value
    assert isinstance(value, Word), f"no condition: {value}"
    (num,) = value.words
    return Test(lambda e: e.build.trunc(num.emit(e), I1))


def is_none(value: Value) -> Truth:
    """Whether there is none."""
    match value:
        case Nothing():
            return YES
        case Maybe(missing, _):
            return missing
        case Word(_, words, none) if none is not None:
            return same_words(words[:1], (constant(none),))
    return NO


def some(value: Value) -> Value:
    """The value that is there."""
    match value:
        case Maybe(_, inner):
            return inner
        case Word(kind, words, none) if none is not None:
            return Word(kind, words)
    return value


def equal(one: Value, other: Value) -> Truth:
    """Whether two values are equal."""
    if any(isinstance(each, Nothing | Maybe) or getattr(each, "none", None) is not None for each in (one, other)):
        if isinstance(one, Nothing) or isinstance(other, Nothing):
            return both(is_none(one), is_none(other))
        there = both(negation(is_none(one)), negation(is_none(other)), equal(some(one), some(other)))
        return either(both(is_none(one), is_none(other)), there)
    if isinstance(one, Truth | Word) and isinstance(other, Truth | Word):
        return same_words(flat(one), flat(other))
    if isinstance(one, Items) and isinstance(other, Items):
        return both(*(equal(a, b) for a, b in zip(one.items, other.items, strict=True)))
    if isinstance(one, Set) and isinstance(other, Set):
        return both(subset(one, other), subset(other, one))
    raise TypeError(f"no comparison of {one} and {other}")


def subset(one: Set, other: Set) -> Truth:
    """Whether all that is in one is in the other."""

    def loops(e: Emitter, found: ir.Block) -> None:
        def body(element: Value) -> None:
            further = e.block()
            negation(other.contains(element)).jump(e, found, further)
            e.enter(further)

        one.each(e, body)

    return negation(Exists(loops))


def choose(condition: Truth, one: Value, other: Value) -> Value:
    """One value or the other."""
    if isinstance(condition, Fixed):
        return one if condition.holds else other
    if one is other or (getattr(one, "origin", None) is not None and one.origin == getattr(other, "origin", None)):  # type: ignore[union-attr]
        return one
    if any(isinstance(each, Nothing | Maybe) for each in (one, other)):
        missing = if_true(condition, is_none(one), is_none(other))
        inner = [some(each) for each in (one, other) if not isinstance(each, Nothing)]
        if not inner:
            return one
        return Maybe(missing, choose(condition, inner[0], inner[-1]))
    if isinstance(one, Truth) or isinstance(other, Truth):
        return if_true(condition, truth_of(one), truth_of(other))
    if isinstance(one, Word) and isinstance(other, Word):
        none = one.none if one.none is not None else other.none
        words = (word_if(condition, a, b) for a, b in zip(one.words, other.words, strict=True))
        return Word(one.kind, tuple(words), none)
    if isinstance(one, Items) and isinstance(other, Items):
        return Items(tuple(choose(condition, a, b) for a, b in zip(one.items, other.items, strict=True)))
    if isinstance(one, Record) and isinstance(other, Record):
        first, second = one, other
        return Record(
            one.cls,
            lambda name: choose(condition, first.get(name), second.get(name)),
            choice=(condition, first, second),
        )
    if isinstance(one, Set) and isinstance(other, Set):
        return ChosenSet(condition, one, other)
    assert isinstance(one, Map), f"no choice of {one} and {other}"
    assert isinstance(other, Map), f"no choice of {one} and {other}"
    return ChosenMap(condition, one, other)


def with_fields(record: Record, changes: dict[str, Any]) -> Record:
    """``replace``: a record with some fields other."""
    return Record(record.cls, lambda name: changes[name] if name in changes else record.get(name))


class ChosenSet(Set):
    """One set or the other."""

    def __init__(self, condition: Truth, one: Set, other: Set) -> None:
        self.condition, self.one, self.other = condition, one, other

    def contains(self, element: Value) -> Truth:
        """Whether it is in the one that is chosen."""
        return if_true(self.condition, self.one.contains(element), self.other.contains(element))

    def each(self, e: Emitter, body: Body) -> None:
        """Loop over the one that is chosen."""
        self.condition.when(e, lambda: self.one.each(e, body))
        negation(self.condition).when(e, lambda: self.other.each(e, body))


class ChosenMap(Map):
    """One map or the other."""

    def __init__(self, condition: Truth, one: Map, other: Map) -> None:
        self.condition, self.one, self.other = condition, one, other

    def keys(self) -> Set:
        """The keys of the one that is chosen."""
        return ChosenSet(self.condition, self.one.keys(), self.other.keys())

    def get(self, key: Value) -> Value:
        """The value in the one that is chosen."""
        return choose(self.condition, self.one.get(key), self.other.get(key))
