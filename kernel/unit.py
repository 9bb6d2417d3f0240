"""What an on-board unit remembers (車上装置); its machines are in the files beside this one."""

from __future__ import annotations

from dataclasses import dataclass

from kernel.maps import Map
from kernel.names import Block, Cab, Epoch, Read, Run, Tag, UnitLife


@dataclass(frozen=True)
class Evidence:
    """The two reads of the tail antenna that prove it has left a block, in their order (T2, T6)."""

    left: Read
    entered: Read


@dataclass(frozen=True)
class Order:
    """A run as the train knows it (T4, T5).

    ``permitted``: the route-complete message has come.
    ``recalled``: the centre has asked for it; no authority any more, unless the head has begun it (T9).
    ``given_back``: acknowledged as cancelled; never to be entered again (T9).
    ``loop_closed``: second loop; every tag so far was the expected one, in its window (T5).
    ``begun``: the head has read both tags at the end of the start block.
    ``stopped``: the train has told that it stands in the destination (T9).
    ``expected``: the tag that the head must read next; none after the last (T5).
    ``left``: blocks the tail has left during this run, with what it read (T2, T6).
    """

    permitted: bool
    recalled: bool
    given_back: bool
    loop_closed: bool
    begun: bool
    stopped: bool
    expected: Tag | None
    left: Map[Block, Evidence]


NO_ORDERS: Map[Run, Order] = {}
NO_EVIDENCE: Map[Block, Evidence] = {}


@dataclass(frozen=True)
class Unit:
    """All that a unit decides from; only ``life`` survives its restart (T8).

    ``life``: counts the restarts of the unit.
    ``answered``: the epoch of the centre whose challenge this life has answered.
    ``standing_in``: what it answered, the blocks it stood in.
    ``orders``: the runs told to this life.
    ``head_tag``, ``head_cab``: the tag the head read last, and which cab was the head (T5).
    ``tail_read``, ``tail_cab``: what the tail read last over a healthy through line, and which
    cab was the tail (T2).
    ``occupied``: the blocks the train is in, by its own tags (T2).
    """

    life: UnitLife
    answered: Epoch | None
    standing_in: frozenset[Block]
    orders: Map[Run, Order]
    head_tag: Tag | None
    head_cab: Cab | None
    tail_read: Read | None
    tail_cab: Cab | None
    occupied: frozenset[Block]
