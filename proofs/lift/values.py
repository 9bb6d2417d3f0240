"""Values: what an expression of the subset is lifted to.

A scalar is a term.  Sets and maps are Python functions from key terms to terms or values.
A map is in normal form: the sets and maps inside the value of an absent key are empty.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass
from typing import Any, TypeAlias

from proofs.lift.kinds import Kind, RecordKind, Scalar, TupleKind, fields_of, scalars_of
from proofs.lift.terms import Term, Truth, address, and_, equal_terms, ite_, not_, or_, same


@dataclass(frozen=True, eq=False)
class Nothing:
    """The literal ``None``."""


@dataclass(frozen=True, eq=False)
class Absent:
    """What looking up an absent key gives: no claim is made about it."""


@dataclass(frozen=True, eq=False)
class Option:
    """``X | None``: the value counts only where ``is_none`` does not hold."""

    is_none: Truth
    value: Value


@dataclass(frozen=True, eq=False)
class Tuple:
    """A tuple of values."""

    items: tuple[Value, ...]


class Fields(Mapping[str, Any]):
    """The fields of a record, each made when it is first asked for."""

    def __init__(self, names: Iterable[str], make: Callable[[str], Value]) -> None:
        self._names = tuple(names)
        self._make = make
        self._made: dict[str, Value] = {}

    def __getitem__(self, name: str) -> Value:
        if name not in self._made:
            if name not in self._names:
                raise KeyError(name)
            self._made[name] = self._make(name)
        return self._made[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._names)

    def __len__(self) -> int:
        return len(self._names)


@dataclass(frozen=True, eq=False)
class Record:
    """A frozen dataclass: one value a field."""

    cls: type
    fields: Mapping[str, Value]


@dataclass(frozen=True, eq=False)
class Set:
    """A frozenset: ``member`` of the scalars of an element; ``listed`` if it was written as a display.

    ``element`` is None for an empty set of unknown kind.
    """

    element: Kind | None
    member: Callable[..., Truth]
    listed: tuple[Value, ...] | None = None


@dataclass(frozen=True, eq=False)
class Map:
    """A Mapping: its domain, and the value at a key; ``key`` is None for an empty map of unknown kind."""

    key: Kind | None
    has: Callable[..., Truth]
    get: Callable[..., Value]


Value: TypeAlias = Any
"""A term, Nothing, Absent, Option, Tuple, Record, Set or Map."""

NOTHING = Nothing()
ABSENT = Absent()
EMPTY_SET = Set(None, lambda *key: False, ())
EMPTY_MAP = Map(None, lambda *key: False, lambda *key: ABSENT)


class Mismatch(Exception):
    """Two values that do not go together; the lifter says where."""


def is_term(value: Value) -> bool:
    """Whether a value is a scalar."""
    return not isinstance(value, (Nothing, Absent, Option, Tuple, Record, Set, Map))


def is_none(value: Value) -> Truth:
    """Whether a value is ``None``."""
    return value.is_none if isinstance(value, Option) else isinstance(value, Nothing)


def some(value: Value) -> Value:
    """Return the value proper of an optional one."""
    if isinstance(value, Nothing):
        return ABSENT
    return value.value if isinstance(value, Option) else value


def flat(value: Value) -> tuple[Truth, tuple[Term, ...]]:
    """Return the scalars of a key, and whether none of them is ``None`` or absent."""
    if isinstance(value, (Nothing, Absent)):
        return False, ()
    if isinstance(value, Option):
        defined, terms = flat(value.value)
        return and_(not_(value.is_none), defined), terms
    if isinstance(value, (Tuple, Record)):
        parts = [flat(item) for item in items_of(value)]
        return and_(*(part[0] for part in parts)), tuple(term for part in parts for term in part[1])
    if is_term(value):
        return True, (value,)
    raise Mismatch("a set or a map cannot be a key")


def items_of(value: Tuple | Record) -> Iterable[Value]:
    """Return the values of a tuple or a record, in order."""
    return value.items if isinstance(value, Tuple) else value.fields.values()


def unflat(kind: Kind, terms: tuple[Term, ...]) -> Value:
    """Return the key of this kind that consists of these scalars."""
    match kind:
        case Scalar():
            return terms[0]
        case TupleKind(items):
            return Tuple(tuple(unflat(item, part) for item, part in zip(items, _split(items, terms), strict=True)))
        case RecordKind(cls):
            fields = fields_of(cls)
            parts = _split(fields.values(), terms)
            made = {name: unflat(fields[name], part) for name, part in zip(fields, parts, strict=True)}
            return Record(cls, made)
        case _:
            raise Mismatch(f"{kind} cannot be a key")


def _split(kinds: Iterable[Kind], terms: tuple[Term, ...]) -> Iterator[tuple[Term, ...]]:
    start = 0
    for kind in kinds:
        count = len(scalars_of(kind))
        yield terms[start : start + count]
        start += count


def equal_keys(left: tuple[Term, ...], right: tuple[Term, ...]) -> Truth:
    """Equality of two keys, scalar by scalar."""
    if len(left) != len(right):
        return False
    parts = []
    for one, other in zip(left, right, strict=True):
        parts.append(equal_scalars(one, other))
        if parts[-1] is False:
            return False
    return and_(*parts)


def equal_scalars(left: Term, right: Term) -> Truth:
    """Equality of two scalars, which must be of one sort."""
    if not same_sort(left, right):
        raise Mismatch(f"a {sort_name(left)} is compared with a {sort_name(right)}")
    return equal_terms(left, right)


def same_sort(left: Term, right: Term) -> bool:
    """Whether two scalars are of one sort."""
    if isinstance(left, bool) or isinstance(right, bool):
        return sort_name(left) == sort_name(right)
    return address(left.sort()) == address(right.sort())


def sort_name(term: Term) -> str:
    """Return the name of a term's sort."""
    return "Bool" if isinstance(term, bool) else str(term.sort())


def listed_set(element: Kind | None, values: tuple[Value, ...]) -> Set:
    """The set of the listed values."""
    keys = [flat(value) for value in values]
    return Set(element, lambda *q: or_(*(and_(d, equal_keys(key, q)) for d, key in keys)), values)


def listed_map(key: Kind | None, entries: tuple[tuple[Value, Value], ...]) -> Map:
    """The map with the listed entries; of two with the same key the later counts."""
    keyed = [(*flat(one), value) for one, value in entries]

    def has(*q: Term) -> Truth:
        return or_(*(and_(defined, equal_keys(terms, q)) for defined, terms, _ in keyed))

    def get(*q: Term) -> Value:
        found: Value = ABSENT
        for defined, terms, value in keyed:
            found = overlay(and_(defined, equal_keys(terms, q)), value, found)
        return found

    return Map(key, has, get)


def overlay(present: Truth, value: Value, below: Value) -> Value:
    """``value`` where it is present, else what is below it, which may be absent; in normal form."""
    if present is False:
        return below
    return restrict(value, present) if isinstance(below, Absent) else choose(present, value, below)


def restrict(value: Value, present: Truth) -> Value:
    """Empty the sets and maps of a map's value where its key is not present: the normal form."""
    if present is True or is_term(value):
        return value
    match value:
        case Option():
            return Option(value.is_none, restrict(value.value, present))
        case Tuple():
            return Tuple(tuple(restrict(item, present) for item in value.items))
        case Record():
            return Record(value.cls, Fields(value.fields, lambda name: restrict(value.fields[name], present)))
        case Set():
            return Set(value.element, lambda *q: and_(present, value.member(*q)))
        case Map():
            return Map(value.key, lambda *q: and_(present, value.has(*q)), lambda *q: restrict(value.get(*q), present))
        case _:
            return value


def choose(condition: Truth, yes: Value, no: Value) -> Value:
    """``yes if condition else no``; what is the same in both is kept as it is."""
    if condition is True or same(yes, no) or isinstance(no, Absent):
        return yes
    if condition is False or isinstance(yes, Absent):
        return no
    if isinstance(yes, (Nothing, Option)) or isinstance(no, (Nothing, Option)):
        return Option(ite_(condition, is_none(yes), is_none(no)), choose(condition, some(yes), some(no)))
    match yes, no:
        case Tuple(), Tuple() if len(yes.items) == len(no.items):
            return Tuple(tuple(choose(condition, one, other) for one, other in zip(yes.items, no.items, strict=True)))
        case Record(), Record() if yes.cls is no.cls:
            return Record(
                yes.cls, Fields(yes.fields, lambda name: choose(condition, yes.fields[name], no.fields[name]))
            )
        case Set(), Set():
            return Set(yes.element or no.element, lambda *q: ite_(condition, yes.member(*q), no.member(*q)))
        case Map(), Map():
            return Map(
                yes.key or no.key,
                lambda *q: ite_(condition, yes.has(*q), no.has(*q)),
                lambda *q: _choose_at_key(condition, yes.get(*q), no.get(*q)),
            )
    if is_term(yes) and is_term(no) and same_sort(yes, no):
        return ite_(condition, yes, no)
    raise Mismatch(f"{name_of(yes)} or {name_of(no)}: two branches of different types")


def _choose_at_key(condition: Truth, yes: Value, no: Value) -> Value:
    """Choose between the values of two maps at a key, which may be absent from one; in normal form."""
    if isinstance(no, Absent):
        return restrict(yes, condition)
    return restrict(no, not_(condition)) if isinstance(yes, Absent) else choose(condition, yes, no)


def name_of(value: Value) -> str:
    """Return what to call a value in a message."""
    if is_term(value):
        return sort_name(value)
    return value.cls.__name__ if isinstance(value, Record) else type(value).__name__.lower()
