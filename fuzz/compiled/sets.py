"""Sets and maps that the text builds: literals, unions, updates, comprehensions."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from llvmlite import ir

from fuzz.compiled.emitter import Emitter
from fuzz.compiled.values import (
    NO,
    Body,
    Exists,
    Map,
    Nothing,
    Set,
    Truth,
    Value,
    both,
    choose,
    either,
    equal,
    is_none,
    negation,
    some,
)


def contains(collection: Set, element: Value) -> Truth:
    """Whether a value is in a set; None is in nothing."""
    return both(negation(is_none(element)), collection.contains(some(element)))


class Literal(Set):
    """A set with these elements."""

    def __init__(self, elements: Sequence[Value]) -> None:
        self.elements = elements

    def contains(self, element: Value) -> Truth:
        """Equal to one of them."""
        found: Truth = NO
        for each in self.elements:
            found = either(found, equal(each, element))
        return found

    def each(self, e: Emitter, body: Body) -> None:
        """One after the other."""
        for element in self.elements:
            body(element)


class Union(Set):
    """What is in one or the other."""

    def __init__(self, one: Set, other: Set) -> None:
        self.one, self.other = one, other

    def contains(self, element: Value) -> Truth:
        """In one or the other."""
        return either(self.one.contains(element), self.other.contains(element))

    def each(self, e: Emitter, body: Body) -> None:
        """All of one, then all of the other."""
        self.one.each(e, body)
        self.other.each(e, body)


class Minus(Set):
    """What is in one and not in the other."""

    def __init__(self, one: Set, other: Set) -> None:
        self.one, self.other = one, other

    def contains(self, element: Value) -> Truth:
        """In one, not in the other."""
        return both(self.one.contains(element), negation(self.other.contains(element)))

    def each(self, e: Emitter, body: Body) -> None:
        """All of one that are not in the other."""
        self.one.each(e, lambda element: negation(self.other.contains(element)).when(e, lambda: body(element)))


class Meet(Set):
    """What is in both."""

    def __init__(self, one: Set, other: Set) -> None:
        self.one, self.other = one, other

    def contains(self, element: Value) -> Truth:
        """In both."""
        return both(self.one.contains(element), self.other.contains(element))

    def each(self, e: Emitter, body: Body) -> None:
        """All of one that are in the other."""
        self.one.each(e, lambda element: self.other.contains(element).when(e, lambda: body(element)))


class Entries(Map):
    """A map with these entries; of equal keys the last one counts."""

    def __init__(self, entries: Sequence[tuple[Value, Value]]) -> None:
        self.entries = entries

    def keys(self) -> Set:
        """Its keys."""
        return Literal([key for key, _ in self.entries])

    def get(self, key: Value) -> Value:
        """The value of the entry with this key."""
        if not self.entries:
            return Nothing()
        (_, found), *rest = self.entries
        for other, value in rest:
            found = choose(equal(other, key), value, found)
        return found


class Updated(Map):
    """A map with the entries of another put over it."""

    def __init__(self, base: Map, over: Map) -> None:
        self.base, self.over = base, over

    def keys(self) -> Set:
        """The keys of both."""
        return Union(self.over.keys(), Minus(self.base.keys(), self.over.keys()))

    def get(self, key: Value) -> Value:
        """The value that was put over, if there is one."""
        return choose(self.over.keys().contains(key), self.over.get(key), self.base.get(key))


Loops = Callable[[Emitter, Callable[[Value], None]], None]
"""Run through the turns of a comprehension, giving what each turn gives."""


class Comprehension(Set):
    """The elements that the turns of some loops give."""

    def __init__(self, loops: Loops, direct: Callable[[Value], Truth] | None) -> None:
        self.loops, self.direct = loops, direct

    def contains(self, element: Value) -> Truth:
        """Asked directly where the element names its own turn; else some turn gives it."""
        if self.direct is not None:
            return self.direct(element)

        def search(e: Emitter, found: ir.Block) -> None:
            def body(given: Value) -> None:
                other = e.block()
                equal(given, element).jump(e, found, other)
                e.enter(other)

            self.loops(e, body)

        return Exists(search)

    def each(self, e: Emitter, body: Body) -> None:
        """Every turn."""
        self.loops(e, body)


class MapComprehension(Map):
    """The entries that some loops give, each key in one turn that it names."""

    def __init__(self, keys: Comprehension, value: Callable[[Value], Value]) -> None:
        self._keys, self._value = keys, value

    def keys(self) -> Set:
        """Its keys."""
        return self._keys

    def get(self, key: Value) -> Value:
        """The value in the turn that the key names."""
        return self._value(key)


class ByRun(Map):
    """What a formation says of a run, looked up by the run's route and train."""

    def __init__(self, table: Map, key: Callable[[Value], Value]) -> None:
        self.table, self.key = table, key

    def keys(self) -> Set:
        """Asked whether it has a run, nothing else."""
        return _Mapped(self.table.keys(), self.key)

    def get(self, key: Value) -> Value:
        """The value of a run."""
        return self.table.get(self.key(key))


class _Mapped(Set):
    def __init__(self, keys: Set, key: Callable[[Value], Value]) -> None:
        self._keys, self._key = keys, key

    def contains(self, element: Value) -> Truth:
        return self._keys.contains(self._key(element))

    def each(self, e: Emitter, body: Body) -> None:
        raise TypeError("a formation's runs are not listed")
