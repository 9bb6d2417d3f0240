"""Scopes: what the identifiers range over.

Unbounded: any number of them, with quantifiers.  Finite: a few named ones, with every
quantifier written out, for counterexamples that can be read and replayed.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Iterator, Mapping, Sequence
from itertools import product
from typing import Any, NamedTuple

import z3

from proofs.lift.components import Component, Function, Keys, components, grow
from proofs.lift.kinds import (
    BOOL,
    INT,
    Kind,
    RecordKind,
    Scalar,
    TupleKind,
    check_class,
    fields_of,
    kind_of_type,
    scalars_of,
)
from proofs.lift.terms import (
    Term,
    Truth,
    address,
    and_,
    enumeration,
    equal_terms,
    function_of,
    implies_,
    is_constant,
    ite_,
    not_,
    or_,
    same,
    to_z3,
)
from proofs.lift.values import Absent, Mismatch, Option, Record, Tuple, Value, is_term, name_of


class Named(NamedTuple):
    """A formula and what to call it."""

    name: str
    formula: Any


class Scope(ABC):
    """Owner of the sorts, the symbols and the quantifiers of one lifting."""

    def __init__(self) -> None:
        self._depth = 0
        self._functions: dict[tuple[str, Keys, Scalar], Function] = {}
        self._sorts: dict[Scalar, Any] = {}
        self._scalars: dict[int, Scalar] = {}
        self.sort(BOOL)
        self.sort(INT)
        self._normal_forms: dict[tuple[str, Keys], Named] = {}

    # Sorts -----------------------------------------------------------------------------

    def sort(self, scalar: Scalar) -> Any:
        """Return the Z3 sort of a scalar."""
        if scalar not in self._sorts:
            if any(other.name == scalar.name for other in self._sorts):
                raise Mismatch(f"{scalar.name} is the name of two types")
            self._sorts[scalar] = self._sort(scalar)
            self._scalars[address(self._sorts[scalar])] = scalar
        return self._sorts[scalar]

    def _sort(self, scalar: Scalar) -> Any:
        if scalar == BOOL:
            return z3.BoolSort()
        if scalar == INT:
            return z3.IntSort()
        return enumeration(*_members(scalar))[0] if scalar.is_enum else self._identifiers(scalar)

    def scalar_of(self, term: Term) -> Scalar:
        """Return the type that a term is of."""
        return BOOL if isinstance(term, bool) else self._scalars[address(term.sort())]

    def kind_of(self, value: Value) -> Kind:
        """Return the kind of a value that is to be a key."""
        if isinstance(value, Option):
            return self.kind_of(value.value)
        if isinstance(value, Tuple):
            return TupleKind(tuple(self.kind_of(item) for item in value.items))
        if isinstance(value, Record):
            return self._record_key(value.cls)
        if is_term(value):
            return self.scalar_of(value)
        raise Mismatch(f"a {name_of(value)} cannot be an element or a key")

    def _record_key(self, cls: type) -> RecordKind:
        kind = RecordKind(cls)
        try:
            scalars_of(kind)
        except TypeError:
            raise Mismatch(f"a {cls.__name__} has a field that cannot be part of a key") from None
        return kind

    def member(self, member: Any) -> Term:
        """Return the term of an Enum member."""
        check_class(type(member))
        scalar = Scalar(type(member))
        self.sort(scalar)
        return enumeration(*_members(scalar))[1][list(scalar.source).index(member)]

    @abstractmethod
    def _identifiers(self, scalar: Scalar) -> Any:
        """Return the sort of an identifier type."""

    @abstractmethod
    def before(self, scalar: Scalar, left: Term, right: Term) -> Truth:
        """The order of a numbered identifier."""

    @abstractmethod
    def field(self, scalar: Scalar, name: str, term: Term) -> Term:
        """Return a field of a NamedTuple."""

    def values(self, scalar: Scalar) -> Sequence[Term] | None:
        """Return every value of a scalar, None if they cannot be listed."""
        if scalar == BOOL:
            return (False, True)
        return tuple(self.member(member) for member in scalar.source) if scalar.is_enum else None

    # Quantifiers -----------------------------------------------------------------------

    @abstractmethod
    def open(self, kinds: Keys, names: Sequence[str]) -> Iterator[tuple[list[Term], tuple[Term, ...]]]:
        """Go through the cases that a quantifier over these sorts has: its binders, and its terms.

        Unbounded there is one case, of bound constants; finite there is one for every choice.
        """

    def open_symbolic(self, kinds: Keys, names: Sequence[str]) -> Iterator[tuple[list[Term], tuple[Term, ...]]]:
        """Give the one case of bound constants, named by how deep they lie."""
        terms = tuple(
            z3.Const(f"{name}!{self._depth + index}", self.sort(kind))
            for index, (kind, name) in enumerate(zip(kinds, names, strict=True))
        )
        self._depth += len(kinds)
        try:
            yield list(terms), terms
        finally:
            self._depth -= len(kinds)

    def forall(self, binders: list[Term], body: Truth) -> Truth:
        """Close a formula universally."""
        return body if isinstance(body, bool) or not binders else z3.ForAll(binders, body)

    def exists(self, binders: list[Term], body: Truth) -> Truth:
        """Close a formula existentially."""
        return body if isinstance(body, bool) or not binders else z3.Exists(binders, body)

    def for_every(self, kinds: Keys, body: Callable[..., Truth]) -> Truth:
        """State the body for every choice of terms."""
        cases = self.open(kinds, [kind.name.lower() for kind in kinds])
        return and_(*(self.forall(binders, body(*terms)) for binders, terms in cases))

    # Symbols ---------------------------------------------------------------------------

    def declare(self, path: str, keys: Keys, result: Scalar) -> Function:
        """Return the function of logic of this name and these sorts."""
        place = (path, keys, result)
        if place not in self._functions:
            self._functions[place] = function_of(path, [self.sort(key) for key in keys], self.sort(result))
        return self._functions[place]

    def fresh(self, type_: Any, prefix: str) -> Value:
        """Return an arbitrary value of a type, its symbols named by the prefix and the field."""
        kind = kind_of_type(type_)
        for part in components(kind, prefix):
            if part.within is not None:
                self._normal_forms.setdefault((part.path, part.keys), self._normal_form(part, *part.within))
        return grow(kind, prefix, (), self.declare)()

    constant = fresh

    def _normal_form(self, part: Component, domain: str, width: int) -> Named:
        inner, outer = self.declare(part.path, part.keys, BOOL), self.declare(domain, part.keys[:width], BOOL)
        formula = self.for_every(part.keys, lambda *keys: implies_(inner(*keys), outer(*keys[:width])))
        return Named(f"{part.path} is empty outside {domain}", to_z3(formula))

    def axioms(self) -> list[Named]:
        """Return what holds of the sorts and symbols used so far."""
        return list(self._normal_forms.values())

    # Two-vocabulary form ---------------------------------------------------------------

    def name(self, value: Value, prefix: str, relative_to: Value | None = None) -> tuple[Value, list[Named]]:
        """Give each component of a record that changed a symbol of its own, and define it.

        Unchanged components keep the symbols they had in ``relative_to``.
        """
        if not isinstance(value, Record):
            raise Mismatch("only a record can be named")
        definitions: list[Named] = []
        return self._name(RecordKind(value.cls), value, prefix, relative_to, definitions), definitions

    def _name(self, kind: Kind, value: Value, path: str, old: Value | None, definitions: list[Named]) -> Value:
        if same(value, old):
            return old
        if isinstance(kind, RecordKind):
            fields = {
                name: self._name(
                    field, value.fields[name], f"{path}.{name}", old.fields[name] if old else None, definitions
                )
                for name, field in fields_of(kind.cls).items()
            }
            return Record(kind.cls, fields)
        parts = {part.path: part for part in components(kind, path)}

        def declare(name: str, keys: Keys, result: Scalar) -> Function:
            part = parts[name]
            if old is not None and self._is_unchanged(part, value, old):
                return lambda *terms: part.read(old, *terms)
            function = self.declare(name, keys, result)
            formula = self.for_every(keys, lambda *terms: _defined(function(*terms), part.read(value, *terms)))
            if formula is not True:
                definitions.append(Named(name, to_z3(formula)))
            return function

        return grow(kind, path, (), declare)()

    def _is_unchanged(self, part: Component, value: Value, old: Value) -> bool:
        for _, terms in self.open_symbolic(part.keys, [key.name.lower() for key in part.keys]):
            new = part.read(value, *terms)
            return isinstance(new, Absent) or same(new, part.read(old, *terms))
        return False


def _members(scalar: Scalar) -> tuple[str, tuple[str, ...]]:
    return scalar.name, tuple(f"{scalar.name}.{member.name}" for member in scalar.source)


def _defined(term: Term, body: Value) -> Truth:
    return True if isinstance(body, Absent) else equal_terms(term, body)


class UnboundedScope(Scope):
    """Uninterpreted sorts of any size."""

    def _identifiers(self, scalar: Scalar) -> Any:
        if not scalar.is_identifier:
            raise Mismatch(f"{scalar.name} is no identifier")
        return z3.DeclareSort(scalar.name)

    def open(self, kinds: Keys, names: Sequence[str]) -> Iterator[tuple[list[Term], tuple[Term, ...]]]:
        """Give the one case of bound constants."""
        return self.open_symbolic(kinds, names)

    def before(self, scalar: Scalar, left: Term, right: Term) -> Truth:
        """An uninterpreted relation; the axioms say that it is a strict total order."""
        return (
            False if same(left, right) else self.declare(f"before_{scalar.name}", (scalar, scalar), BOOL)(left, right)
        )

    def field(self, scalar: Scalar, name: str, term: Term) -> Term:
        """An uninterpreted function."""
        return self.declare(f"{scalar.name}.{name}", (scalar,), _field(scalar, name))(term)

    def axioms(self) -> list[Named]:
        """Return the normal forms, and the orders of the numbered identifiers."""
        named = super().axioms()
        for scalar in [scalar for scalar in self._scalars.values() if scalar.is_ordered]:
            before = self.declare(f"before_{scalar.name}", (scalar, scalar), BOOL)
            for law, count, body in _ORDER:
                formula = self.for_every(
                    (scalar,) * count, lambda *terms, body=body, before=before: body(before, *terms)
                )
                named.append(Named(f"before_{scalar.name} is {law}", formula))
        return named


_ORDER: list[tuple[str, int, Callable[..., Truth]]] = [
    ("irreflexive", 1, lambda before, a: not_(before(a, a))),
    ("transitive", 3, lambda before, a, b, c: implies_(and_(before(a, b), before(b, c)), before(a, c))),
    ("total", 2, lambda before, a, b: or_(before(a, b), before(b, a), equal_terms(a, b))),
]


def _field(scalar: Scalar, name: str) -> Scalar:
    kind = fields_of(scalar.source).get(name)
    if not isinstance(kind, Scalar):
        raise Mismatch(f"{scalar.name} has no field {name}")
    return kind


class FiniteScope(Scope):
    """Each identifier type has a few named values; quantifiers are written out."""

    def __init__(self, sizes: Mapping[Any, int], universe: Mapping[Any, Sequence[Any]] | None = None) -> None:
        super().__init__()
        self._sizes = dict(sizes)
        self._universe = dict(universe or {})
        if any(size < 1 for size in self._sizes.values()):
            raise ValueError("every identifier type needs at least one value")
        for source in self._sizes:
            self.sort(Scalar(source))

    @classmethod
    def of_universe(cls, universe: Mapping[Any, Sequence[Any]]) -> FiniteScope:
        """Return the scope whose identifiers are exactly these Python values."""
        listed = {
            source: sorted(values) if Scalar(source).is_ordered else list(values) for source, values in universe.items()
        }
        return cls({source: len(values) for source, values in listed.items()}, listed)

    def _identifiers(self, scalar: Scalar) -> Any:
        return enumeration(*self._names(scalar))[0]

    def _names(self, scalar: Scalar) -> tuple[str, tuple[str, ...]]:
        if scalar.source not in self._sizes:
            raise Mismatch(f"the finite scope says nothing of {scalar.name}: give its size")
        size = self._sizes[scalar.source]
        return f"{scalar.name}.{size}", tuple(f"{scalar.name}_{index}" for index in range(size))

    def values(self, scalar: Scalar) -> Sequence[Term] | None:
        """Return every value of a scalar; None for ``int``."""
        return enumeration(*self._names(scalar))[1] if scalar.is_identifier else super().values(scalar)

    def individual(self, scalar: Scalar, value: Any) -> Term:
        """Return the term of a Python value of the universe."""
        listed = self._universe.get(scalar.source, ())
        if value not in listed:
            raise Mismatch(f"{value!r} is not in the universe of {scalar.name}")
        return enumeration(*self._names(scalar))[1][list(listed).index(value)]

    def listed(self, scalar: Scalar) -> Sequence[Any] | None:
        """Return the Python values of an identifier type, if the scope was made of them."""
        return self._universe.get(scalar.source)

    def open(self, kinds: Keys, names: Sequence[str]) -> Iterator[tuple[list[Term], tuple[Term, ...]]]:
        """Go through every choice of values; there are no binders."""
        choices = [self.values(kind) for kind in kinds]
        for kind, choice in zip(kinds, choices, strict=True):
            if choice is None:
                raise Mismatch(f"a quantifier over {kind.name} cannot be written out")
        for terms in product(*(choice for choice in choices if choice is not None)):
            yield [], terms

    def before(self, scalar: Scalar, left: Term, right: Term) -> Truth:
        """The order of the list."""
        listed = self.values(scalar) or ()
        below = [equal_terms(left, value) for value in listed]
        return or_(*(and_(equal_terms(right, value), or_(*below[:index])) for index, value in enumerate(listed)))

    def field(self, scalar: Scalar, name: str, term: Term) -> Term:
        """The field as the universe has it, else a free function."""
        result, listed = _field(scalar, name), self._universe.get(scalar.source)
        if listed is None:
            return self.declare(f"{scalar.name}.{name}", (scalar,), result)(term)
        found: Term = None
        for value, one in zip(reversed(listed), reversed(self.values(scalar) or ()), strict=True):
            here = self.literal(result, getattr(value, name))
            found = here if found is None else ite_(equal_terms(term, one), here, found)
        return found

    def literal(self, scalar: Scalar, value: Any) -> Term:
        """Return the term of a concrete scalar."""
        if scalar == BOOL:
            return bool(value)
        if scalar == INT:
            return z3.IntVal(value)
        return self.member(value) if scalar.is_enum else self.individual(scalar, value)

    def axioms(self) -> list[Named]:
        """Return the normal forms, and that NamedTuples with equal fields are equal."""
        named = super().axioms()
        for scalar in [scalar for scalar in self._scalars.values() if scalar.is_named_tuple]:
            if scalar.source not in self._universe:
                formula = self.for_every((scalar, scalar), lambda a, b, scalar=scalar: self._extensional(scalar, a, b))
                named.append(Named(f"{scalar.name} is its fields", to_z3(formula)))
        return named

    def _extensional(self, scalar: Scalar, left: Term, right: Term) -> Truth:
        if is_constant(left) and left.get_id() >= right.get_id():
            return True
        names = fields_of(scalar.source)
        alike = and_(*(equal_terms(self.field(scalar, n, left), self.field(scalar, n, right)) for n in names))
        return implies_(alike, equal_terms(left, right))
