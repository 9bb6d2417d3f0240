"""The content of a place, as a value; and a value written to a place."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from llvmlite import ir

from fuzz.compiled.emitter import AND_NOT, I64, OR, STORE, Emitter
from fuzz.compiled.places import Bits, Fields, Place, Rows, Table, Words, spread
from fuzz.compiled.sets import Minus, Union, Updated
from fuzz.compiled.values import (
    Body,
    ChosenMap,
    ChosenSet,
    Exists,
    Items,
    Map,
    Num,
    Origin,
    Record,
    Set,
    Test,
    Truth,
    Value,
    Word,
    constant,
    flat,
    is_none,
    known,
    negation,
    some,
    word_if,
)

Index = tuple[Num, ...]


def content(place: Place, at: Index) -> Value:
    """The value that stands at a place."""
    match place:
        case Words(kind, arrays, none):
            return Word(kind, tuple(_loaded(array, at) for array in arrays), none)
        case Fields(cls, places):
            return Record(cls, lambda name: content(places[name], at), _origin(place, at))
        case Bits():
            return BitsSet(place, at)
        case Rows():
            return RowsSet(place, at)
        case Table():
            return TableMap(place, at)


def _loaded(array: Any, at: Index) -> Num:
    key = ("load", array.name, *(num.key for num in at))
    return Num(key, lambda e: e.load(array, [num.emit(e) for num in at]))


def _origin(place: Place, at: Index) -> Origin:
    return id(place), tuple(num.key for num in at)


class BitsSet(Set):
    """A set of bits."""

    def __init__(self, place: Bits, at: Index) -> None:
        self.place, self.at, self.origin = place, at, _origin(place, at)

    def outer(self, e: Emitter, numbers: Sequence[ir.Value]) -> list[ir.Value]:
        """The axes before the words of an element's bits."""
        return [*(num.emit(e) for num in self.at), *(numbers[axis] for axis in self.place.order[:-1])]

    def index(self, e: Emitter, numbers: Sequence[ir.Value]) -> list[ir.Value]:
        """Where the word with an element's bit is."""
        last = numbers[self.place.order[-1]]
        word = I64(0) if self.place.array.shape[-1] == 1 else e.build.lshr(last, I64(6))
        return [*self.outer(e, numbers), word]

    def contains(self, element: Value) -> Truth:
        """Whether the bit is set."""
        words = flat(element)

        def bit(e: Emitter) -> ir.Value:
            numbers = [num.emit(e) for num in words]
            return e.has_bit(e.load_members(self.place.array, self.index(e, numbers)), numbers[self.place.order[-1]])

        return Test(bit)

    def each(self, e: Emitter, body: Body) -> None:
        """Loop over the outer axes, then over words, then over bits."""
        before = [num.emit(e) for num in self.at]
        axes = self.place.array.shape[len(before) :]

        def below(indices: list[ir.Value]) -> None:
            if len(indices) < len(axes):
                e.loop(axes[len(indices)], lambda index: below([*indices, index]))
                return
            word = e.load_members(self.place.array, [*before, *indices])
            first = e.build.shl(indices[-1], I64(6))
            e.each_bit(word, lambda bit: body(self.element([*indices[:-1], e.build.add(first, bit)])))

        below([])

    def element(self, numbers: list[ir.Value]) -> Value:
        """The element with these numbers along the axes."""
        by_axis = dict(zip(self.place.order, numbers, strict=True))
        parts = tuple(Word(kind, (known(by_axis[axis]),)) for axis, kind in enumerate(self.place.scalars))
        return parts[0] if len(parts) == 1 else Items(parts)


class RowsSet(Set):
    """A set that is a list."""

    def __init__(self, place: Rows, at: Index) -> None:
        assert not at, f"{place.array.name} is a list inside something"
        self.place, self.origin = place, _origin(place, at)

    def contains(self, element: Value) -> Truth:
        """Whether some row is the same."""
        words = flat(element)

        def loops(e: Emitter, found: ir.Block) -> None:
            numbers = [num.emit(e) for num in words]

            def body(row: ir.Value) -> None:
                other = e.block()
                for at, number in enumerate(numbers):
                    further = e.block()
                    e.build.cbranch(e.equal(e.load(self.place.array, [row, I64(at)]), number), further, other)
                    e.enter(further)
                e.build.branch(found)
                e.enter(other)

            e.loop_to(e.load(self.place.count, []), body)

        return Exists(loops)

    def each(self, e: Emitter, body: Body) -> None:
        """Loop over the rows."""
        e.loop_to(e.load(self.place.count, []), lambda row: body(self.element(row)))

    def element(self, row: ir.Value) -> Value:
        """What stands in a row."""
        parts: list[Word] = []
        at = 0
        for kind in self.place.scalars:
            width = len(spread(kind))
            nums = (_loaded(self.place.array, (known(row), constant(at + offset))) for offset in range(width))
            parts.append(Word(kind, tuple(nums)))
            at += width
        return Items(tuple(parts))


class TableMap(Map):
    """A map in the memory."""

    def __init__(self, place: Table, at: Index) -> None:
        self.place, self.at, self.origin = place, at, _origin(place, at)

    def keys(self) -> Set:
        """Its keys."""
        return BitsSet(self.place.keys, self.at)

    def below(self, key: Value) -> Index:
        """The axes of a key's value."""
        index = (*self.at, *flat(key))
        return index if self.place.node is None else (_loaded(self.place.node, index),)

    def get(self, key: Value) -> Value:
        """The value of a key."""
        return content(self.place.value, self.below(key))


def write(e: Emitter, place: Place, at: Index, value: Value) -> None:
    """Log what makes the content of a place this value; what stays as it is costs nothing."""
    value = value if isinstance(place, Words) else some(value)
    origin = getattr(value, "origin", None)
    if origin is not None and origin == _origin(place, at):
        return
    match place:
        case Words():
            _write_words(e, place, at, value)
        case Fields(_, places):
            assert isinstance(value, Record)
            if value.choice is not None:
                _by_choice(e, value.choice, place, at)
                return
            for name, each in places.items():
                write(e, each, at, value.get(name))
        case Bits():
            assert isinstance(value, Set)
            _write_bits(e, place, at, value)
        case Rows():
            assert isinstance(value, Set)
            _write_rows(e, place, value)
        case Table():
            assert isinstance(value, Map)
            _write_table(e, place, at, value)


def _by_choice(e: Emitter, choice: tuple[Truth, Any, Any], place: Place, at: Index) -> None:
    condition, one, other = choice
    condition.when(e, lambda: write(e, place, at, one))
    negation(condition).when(e, lambda: write(e, place, at, other))


def _write_words(e: Emitter, place: Words, at: Index, value: Value) -> None:
    if place.none is not None:
        missing, inner = is_none(value), some(value)
        words = [constant(place.none), *[constant(0)] * (len(place.arrays) - 1)]
        if isinstance(inner, Word | Truth):
            words = [word_if(missing, one, other) for one, other in zip(words, flat(inner), strict=True)]
    else:
        words = list(flat(some(value)))
    for array, num in zip(place.arrays, words, strict=True):
        if num.key != _loaded(array, at).key:
            e.write(array, [each.emit(e) for each in at], STORE, num.emit(e))


def _write_bits(e: Emitter, place: Bits, at: Index, value: Set) -> None:
    here = BitsSet(place, at)
    if isinstance(value, ChosenSet):
        _by_choice(e, (value.condition, value.one, value.other), place, at)
    elif isinstance(value, Union | Minus) and value.one.origin == here.origin:
        does = OR if isinstance(value, Union) else AND_NOT
        value.other.each(e, lambda element: _write_bit(e, here, element, does))
    else:
        _clear_words(e, place.array, at)
        value.each(e, lambda element: _write_bit(e, here, element, OR))


def _write_bit(e: Emitter, here: BitsSet, element: Value, does: int) -> None:
    numbers = [num.emit(e) for num in flat(element)]
    e.write(here.place.array, here.index(e, numbers), does, e.bit(numbers[here.place.order[-1]]))


def _clear_words(e: Emitter, array: Any, at: Index) -> None:
    """Write zero over what an array has below some axes."""
    before = [num.emit(e) for num in at]
    axes = array.shape[len(before) :]

    def below(indices: list[ir.Value]) -> None:
        if len(indices) == len(axes):
            e.write(array, [*before, *indices], STORE, I64(0))
            return
        e.loop(axes[len(indices)], lambda index: below([*indices, index]))

    below([])


def _write_rows(e: Emitter, place: Rows, value: Set) -> None:
    here = RowsSet(place, ())
    assert isinstance(value, Union), f"{place.array.name} only grows"
    assert value.one.origin == here.origin, f"{place.array.name} only grows"

    def append(element: Value) -> None:
        def then() -> None:
            row = e.load(place.count, [])
            for at, num in enumerate(flat(element)):
                e.write(place.array, [row, I64(at)], STORE, num.emit(e))
            e.write(place.count, [I64(0)], STORE, e.build.add(row, I64(1)))

        negation(here.contains(element)).when(e, then)

    value.other.each(e, append)


def _write_table(e: Emitter, place: Table, at: Index, value: Map) -> None:
    here = TableMap(place, at)
    if isinstance(value, ChosenMap):
        _by_choice(e, (value.condition, value.one, value.other), place, at)
        return
    if isinstance(value, Updated) and value.base.origin == here.origin:
        value = value.over
    else:
        gone = value

        def drop(key: Value) -> None:
            negation(gone.keys().contains(key)).when(e, lambda: _clear_entry(e, here, key))

        here.keys().each(e, drop)
    put = value
    put.keys().each(e, lambda key: _put(e, here, key, put.get(key)))


def _put(e: Emitter, here: TableMap, key: Value, value: Value) -> None:
    keys = here.keys()
    assert isinstance(keys, BitsSet)
    _write_bit(e, keys, key, OR)
    write(e, here.place.value, here.below(key), value)


def _clear_entry(e: Emitter, here: TableMap, key: Value) -> None:
    """Take a key out of a map: what is absent is zero throughout."""
    keys = here.keys()
    assert isinstance(keys, BitsSet)
    _write_bit(e, keys, key, AND_NOT)
    _clear(e, here.place.value, here.below(key))


def _clear(e: Emitter, place: Place, at: Index) -> None:
    match place:
        case Words(_, arrays, _):
            for array in arrays:
                e.write(array, [num.emit(e) for num in at], STORE, I64(0))
        case Fields(_, places):
            for each in places.values():
                _clear(e, each, at)
        case Bits(_, _, array):
            _clear_words(e, array, at)
        case Table():
            here = TableMap(place, at)
            here.keys().each(e, lambda key: _clear_entry(e, here, key))
        case Rows():
            raise TypeError(f"{place.array.name} only grows")
