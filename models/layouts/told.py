"""What a file tells of a layout beside its track: its routes as stated, its fleet, what fouls and what is held off."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

from kernel.names import Block

Pairs = frozenset[tuple[Block, Block]]


@dataclass(frozen=True)
class Wanted:
    """A route as a file states it.

    ``side``: the side of the entry mark that the route runs to (``LOW`` or ``HIGH``); ``LOW`` without track.
    ``positions``: for each point, the position it must lie in.  ``release``: the detectors up to
    which it is released in parts.  ``overlap``: the mark at which the overlap ends.  ``flank``:
    points held off the path, with their positions.
    """

    name: str
    place: str
    entry: str
    side: int
    exit: str
    positions: Mapping[str, str]
    release: tuple[str, ...] = ()
    overlap: str | None = None
    flank: Mapping[str, str] = field(default_factory=dict)


@dataclass(frozen=True)
class Told:
    """What a file tells beside its track.

    ``name``: the file; ``kind``: its format; ``title``: what the layout is called, if anything.
    ``trains``: the fleet in the file's order.  ``routes``: every route as stated, also one that is left out.
    ``held``: block pairs (from, into) that train protection alone keeps apart; none: every pair
    that no point keeps apart.  ``clear_mm``: for a leg (point, port), from the point to where the leg is clear of
    the other.  ``joints``: where a file joins ends of track by one name alone, the names that it lists as joints;
    none: it says of all its joints what they join.  ``laid_at_start``: points that staff lay, before the system first
    starts, for the track that a train stands on.  ``longest_train_mm``: no train of the fleet is longer.
    """

    name: str
    kind: str
    trains: Sequence[str]
    routes: tuple[Wanted, ...]
    fouls: Mapping[Block, frozenset[Block]] = field(default_factory=dict)
    held: Pairs | None = None
    title: str | None = None
    clear_mm: Mapping[tuple[str, str], int] = field(default_factory=dict)
    joints: frozenset[str] | None = None
    laid_at_start: frozenset[str] = frozenset()
    longest_train_mm: int | None = None
