"""The nouns of the kernel: identifiers, and the few words that a state can be.

Identifiers are opaque: two of them are equal or not.  Only the numbered ones
(``Serial``, ``UnitLife``, ``TerminalLife``, ``Epoch``) are ordered as well; the kernel
compares them; where a machine begins a life or numbers a run (`kernel.machine`) it takes the next one.
"""

from __future__ import annotations

from enum import Enum
from typing import NamedTuple, NewType

Block = NewType("Block", str)
"""Track between two neighbouring tag boundaries (ブロック); T1."""
Route = NewType("Route", str)
"""A start block, the blocks it covers up to its destination, and its overlap (進路); T4, T9."""
Point = NewType("Point", str)
"""A set of points (転てつ機) with one control terminal; T10."""
Position = NewType("Position", str)
"""How a point lies: ``normal``, ``reverse``, or one leg of a slip."""
Train = NewType("Train", str)
"""A formation with one on-board unit."""
Car = NewType("Car", str)
"""A vehicle; the cars of a train may part."""
Cab = NewType("Cab", str)
"""One end of a train with the antenna below it; which end is head depends on the direction (T2)."""
Tag = NewType("Tag", str)
"""The UID of an IC tag, its only key; T1."""
TagList = NewType("TagList", str)
"""All that a unit will use of a route, as the first loop carries it, written down; T4."""
Record = NewType("Record", str)
"""What stands in a tag beside its UID, known only to who has read it; T1, T6."""

Serial = NewType("Serial", int)
"""The number of a run: never reused, never wraps; T9 (ours)."""
UnitLife = NewType("UnitLife", int)
"""The time of an on-board unit from one restart to the next, counted in lasting memory; T8."""
TerminalLife = NewType("TerminalLife", int)
"""The time of a point terminal from one restart to the next; T8, T10."""
Epoch = NewType("Epoch", int)
"""The time of the centre from one restart to the next; T8."""


class Run(NamedTuple):
    """One grant of one route to one life of one train's unit; its lock id is the serial (T9, T10)."""

    serial: Serial
    train: Train
    life: UnitLife
    route: Route


class Read(NamedTuple):
    """What an antenna got from one tag: its UID and what is written in it (T1, T6)."""

    tag: Tag
    record: Record


class Stage(Enum):
    """How far the centre has come with a run (paper 000, 4.3, 4.4)."""

    RESERVED = "reserved"
    """Conflicting routes are inhibited, points are being proved (T4, T9)."""
    OFFERED = "offered"
    """Every point is proved; the tag list is with the train, its echo awaited (first loop, T4)."""
    SET = "set"
    """The echo matched; the train may be permitted to enter (T4)."""
    STANDING = "standing"
    """No route: a train that has told where it stands after a restart (T8)."""
    OVER = "over"
    """Every claim has ended, none by tail evidence alone (T8, T9)."""


class Cause(Enum):
    """Why a claim ended; every claim ends by exactly one (T8)."""

    TAIL_EVIDENCE = "tail evidence"
    """The tail has left the block, shown by what it read (third loop, T6, T7)."""
    STANDSTILL = "standstill"
    """The train stands in its destination and can no longer slip into the overlap (T9)."""
    CANCELLED = "cancelled"
    """The train has given the run back, standing short of it (approach locking, T9)."""
    WITHDRAWN = "withdrawn"
    """Taken back before the train was told (T9)."""
    RECOVERED = "recovered"
    """The train has told in a new life where it stands (T8)."""
    SUPERVISED = "supervised"
    """Two persons on the spot have told where the train stands (T8)."""


class Antenna(Enum):
    """Which of a train's two antennas, by the direction it runs in (T2)."""

    HEAD = "head"
    TAIL = "tail"
