"""The leaves of a packed state: one for each scalar, each set and each map's keys.

A leaf has axes, each of a type; an index has a number for each of them.  A set's own elements are axes too, the
one in the bits of a word is its bit axis.  ``above`` a leaf are the keys of the map it is in: the index of the
keys is the beginning of its own.
"""

from __future__ import annotations

from dataclasses import dataclass

from fuzz.compiled.memory import Memory
from fuzz.compiled.places import Array, Bits, Fields, Place, Rows, Table, Words, spread
from proofs.lift.kinds import Scalar

TYPES = (
    *("Run", "Train", "Epoch", "UnitLife", "TerminalLife", "Block", "Point", "Position", "Tag", "Record"),
    *("Car", "Cab", "bool", "Stage", "Cause", "Serial", "Route", "int", "TagList"),
)
(RUN, TRAIN, EPOCH, UNIT_LIFE, TERMINAL_LIFE, BLOCK, POINT, POSITION, TAG, RECORD) = range(10)
(CAR, CAB, BOOL, STAGE, CAUSE, SERIAL, ROUTE, NUMBER, TAG_LIST) = range(10, 19)
BLOCKS = len(TYPES)
"""A word of a set of blocks in an event."""
REPORT_TYPES = (RUN, BLOCK, TAG, RECORD, TAG, RECORD)
"""The words of a report of a tail."""
NOTHING = -1


@dataclass
class Leaf:
    """A scalar, a set, or the keys of a map.

    ``axis_of``: for each dimension of the array, which axis of the index it is; the last of a set is ``bit``.
    ``value``: a scalar's type, ``none``: its first word where there is none; ``other``: its second word.
    """

    array: Array
    types: tuple[int, ...]
    axis_of: tuple[int, ...]
    bit: int
    above: int
    value: int = NOTHING
    none: int = NOTHING
    other: Array | None = None
    other_value: int = NOTHING
    is_keys: bool = False


def leaves_of(memory: Memory) -> list[Leaf]:
    """Every leaf of a state, in the order of the memory."""
    found: list[Leaf] = []
    _collect(memory, memory.state, (), NOTHING, found)
    return found


def type_of(scalar: Scalar) -> int:
    """The number of a type."""
    return TYPES.index(scalar.name)


def _collect(memory: Memory, place: Place, at: tuple[int, ...], above: int, found: list[Leaf]) -> None:
    """Note the leaves of a place below these axes."""
    match place:
        case Words(kind, arrays, none):
            values = [type_of(part) for _, part in spread(kind)]
            assert len(arrays) <= 2, arrays
            leaf = Leaf(arrays[0], at, tuple(range(len(at))), NOTHING, above, values[0])
            leaf.none = NOTHING if none is None else none
            if len(arrays) == 2:
                leaf.other, leaf.other_value = arrays[1], values[1]
            found.append(leaf)
        case Fields(_, places):
            for each in places.values():
                _collect(memory, each, at, above, found)
        case Bits():
            found.append(_bits(place, at, above))
        case Table(keys, value, node):
            assert node is None, keys.array.name
            leaf = _bits(keys, at, above)
            leaf.is_keys = True
            found.append(leaf)
            _collect(memory, value, leaf.types, len(found) - 1, found)
        case Rows(_, array, _):
            # The reports of tails are the one list; they have words of their own in the tables.
            assert array.name == "radio_tail_reports", array.name


def _bits(bits: Bits, at: tuple[int, ...], above: int) -> Leaf:
    types = (*at, *(type_of(scalar) for scalar in bits.scalars))
    axis_of = (*range(len(at)), *(len(at) + axis for axis in bits.order))
    return Leaf(bits.array, types, axis_of, axis_of[-1], above)


def is_below(leaves: list[Leaf], at: int, keys: int) -> bool:
    """Whether a leaf is in what a map says of a key."""
    above = leaves[at].above
    while above not in (NOTHING, keys):
        above = leaves[above].above
    return above == keys


def is_beside(leaves: list[Leaf], at: int, keys: int) -> bool:
    """A scalar, one for each key."""
    return leaves[at].above == keys and leaves[at].value != NOTHING
