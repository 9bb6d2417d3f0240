"""Random objects of any type of the subset, over a small universe of identifiers."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, TypeAlias

from hypothesis import strategies as st

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
)

Universe: TypeAlias = Mapping[Any, Sequence[Any]]
LARGEST = 3
"""How many entries a drawn set or map has at most, and how large a drawn int is."""


def states_of(type_: Any, universe: Universe, largest: int = LARGEST) -> st.SearchStrategy[Any]:
    """Draw objects of a type: identifiers from the universe, sets and maps of up to ``largest`` entries."""
    return _of_kind(kind_of_type(type_), universe, largest)


def _of_kind(kind: Kind, universe: Universe, largest: int) -> st.SearchStrategy[Any]:
    match kind:
        case Scalar():
            return _of_scalar(kind, universe, largest)
        case OptionKind(inner):
            return st.none() | _of_kind(inner, universe, largest)
        case TupleKind(items):
            return st.tuples(*(_of_kind(item, universe, largest) for item in items))
        case RecordKind(cls):
            fields = {name: _of_kind(field, universe, largest) for name, field in fields_of(cls).items()}
            return st.builds(cls, **fields)
        case SetKind(element):
            return st.frozensets(_of_kind(element, universe, largest), max_size=largest)
        case MapKind(key, value):
            keys, values = _of_kind(key, universe, largest), _of_kind(value, universe, largest)
            return st.dictionaries(keys, values, max_size=largest)


def _of_scalar(scalar: Scalar, universe: Universe, largest: int) -> st.SearchStrategy[Any]:
    if scalar == BOOL:
        return st.booleans()
    if scalar == INT:
        return st.integers(-largest, largest)
    return st.sampled_from(list(scalar.source) if scalar.is_enum else list(universe[scalar.source]))
