"""Between Python objects and values of a finite scope."""

from __future__ import annotations

from collections.abc import Mapping
from itertools import product
from typing import Any

import z3

from proofs.lift.kinds import (
    BOOL,
    INT,
    Kind,
    MapKind,
    OptionKind,
    RecordKind,
    Scalar,
    SetKind,
    TupleKind,
    fields_of,
    kind_of_type,
    scalars_of,
)
from proofs.lift.scopes import FiniteScope
from proofs.lift.terms import Term, to_z3
from proofs.lift.values import (
    EMPTY_MAP,
    EMPTY_SET,
    NOTHING,
    Mismatch,
    Record,
    Tuple,
    Value,
    is_none,
    listed_map,
    listed_set,
    some,
    unflat,
)


def embed(scope: FiniteScope, value: Any, type_: Any) -> Value:
    """Return a Python object of a type as a value of a scope that has its identifiers."""
    return _embed(scope, value, kind_of_type(type_))


def _embed(scope: FiniteScope, value: Any, kind: Kind) -> Value:
    match kind:
        case Scalar():
            return scope.literal(kind, value)
        case OptionKind(inner):
            return NOTHING if value is None else _embed(scope, value, inner)
        case TupleKind(items):
            return Tuple(tuple(_embed(scope, item, part) for item, part in zip(value, items, strict=True)))
        case RecordKind(cls):
            return Record(
                cls, {name: _embed(scope, getattr(value, name), field) for name, field in fields_of(cls).items()}
            )
        case SetKind(element):
            items = tuple(_embed(scope, item, element) for item in value)
            return listed_set(element, items) if items else EMPTY_SET
        case MapKind(key, inner):
            entries = tuple((_embed(scope, k, key), _embed(scope, v, inner)) for k, v in value.items())
            return listed_map(key, entries) if entries else EMPTY_MAP


def concretise(model: Any, scope: FiniteScope, value: Value, type_: Any) -> Any:
    """Return a value as the Python object that a model makes of it; ``model`` may be None."""
    return _Reader(model, scope).read(value, kind_of_type(type_))


class _Reader:
    """Reads Python objects off a model."""

    def __init__(self, model: Any, scope: FiniteScope) -> None:
        self._model = model
        self._scope = scope

    def read(self, value: Value, kind: Kind) -> Any:
        """Return a value of a kind."""
        match kind:
            case Scalar():
                return self._scalar(value, kind)
            case OptionKind(inner):
                return None if self._holds(is_none(value)) else self.read(some(value), inner)
            case TupleKind(items):
                return tuple(self.read(item, part) for item, part in zip(value.items, items, strict=True))
            case RecordKind(cls):
                return cls(**{name: self.read(value.fields[name], part) for name, part in fields_of(cls).items()})
            case SetKind(element):
                return frozenset(
                    self.read(unflat(element, q), element) for q in self._keys(element) if self._holds(value.member(*q))
                )
            case MapKind(key, inner):
                present = [q for q in self._keys(key) if self._holds(value.has(*q))]
                return {self.read(unflat(key, q), key): self.read(value.get(*q), inner) for q in present}

    def _keys(self, kind: Kind) -> list[tuple[Term, ...]]:
        choices = [self._scope.values(scalar) for scalar in scalars_of(kind)]
        if None in choices:
            raise Mismatch(f"the values of {kind} cannot be listed")
        return list(product(*(choice for choice in choices if choice is not None)))

    def _evaluated(self, term: Term) -> Any:
        term = to_z3(term)
        return z3.simplify(term) if self._model is None else self._model.eval(term, model_completion=True)

    def _holds(self, truth: Any) -> bool:
        if isinstance(truth, bool):
            return truth
        found = self._evaluated(truth)
        if not z3.is_true(found) and not z3.is_false(found):
            raise Mismatch(f"undecided: {found}")
        return bool(z3.is_true(found))

    def _scalar(self, term: Term, scalar: Scalar) -> Any:
        if scalar == BOOL:
            return self._holds(term)
        found = self._evaluated(term)
        if scalar == INT:
            return found.as_long()
        listed = self._scope.values(scalar) or ()
        index = [one.get_id() for one in listed].index(found.get_id())
        if scalar.is_enum:
            return list(scalar.source)[index]
        universe = self._scope.listed(scalar)
        if universe is not None:
            return universe[index]
        if scalar.is_named_tuple:
            return self._named_tuple(scalar, found)
        return index if scalar.is_ordered else f"{scalar.name}{index}"

    def _named_tuple(self, scalar: Scalar, term: Term) -> Any:
        kinds: Mapping[str, Any] = fields_of(scalar.source)
        fields = {name: self._scope.field(scalar, name, term) for name in kinds}
        return scalar.source(**{name: self._scalar(field, kinds[name]) for name, field in fields.items()})
