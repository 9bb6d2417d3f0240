"""What an on-board unit remembers (車上装置); its machines are in the files beside this one."""

from __future__ import annotations

from dataclasses import dataclass

from kernel.maps import Map
from kernel.names import Block, Cab, Epoch, Read, Run, Tag, TagList, UnitLife


@dataclass(frozen=True)
class Evidence:
    """The two reads of the tail antenna that prove it has left a block, in their order (T2, T6)."""

    left: Read
    entered: Read


@dataclass(frozen=True)
class Order:
    """A run as the train knows it (T4, T5).

    ``tag_list``: all that the train knows of the route, as the first loop brought it; none for the run that it
    stands under (T4, T8).
    ``permitted``: the route-complete message has come.
    ``recalled``: the centre has asked for it; no authority any more, unless the head has begun it (T9).
    ``given_back``: acknowledged as cancelled; never to be entered again (T9).
    ``begun``: the head has read both tags at the end of the start block.
    ``stopped``: the train is held in the destination, and tells so; it moves under this run no more (T9).
    ``expected``: the tag that the head must read next; none after the last (T5).
    ``entered``: the blocks beyond the start that the head has entered, by its own tags (T2).
    ``led_by``: the cab that led when the head read its first tag under this run (T2).
    ``left``: blocks the tail has left during this run, with what it read (T2, T6).
    """

    tag_list: TagList | None
    permitted: bool
    recalled: bool
    given_back: bool
    begun: bool
    stopped: bool
    expected: Tag | None
    entered: frozenset[Block]
    led_by: Cab | None
    left: Map[Block, Evidence]


NO_BLOCKS: frozenset[Block] = frozenset()
NO_ORDERS: Map[Run, Order] = {}
NO_EVIDENCE: Map[Block, Evidence] = {}


@dataclass(frozen=True)
class Unit:
    """All that a unit decides from; only ``life`` survives its restart (T8).

    ``life``: counts the restarts of the unit.
    ``answered``: the epoch of the centre whose challenge this life has answered.
    ``standing_in``: what it answered, the blocks it stood in.
    ``isolated_in``: the epoch in which this life began by isolating the unit; it shows this beside ``life``.
    ``orders``: the runs told to this life.
    ``loop_open``: second loop; a tag came that was not the expected one, or not in its place (T5).
    ``leading``: the cab at the head, by the driver's choice of direction; none until he has chosen (T2).
    ``head_tag``: the tag the head read last since the ends were changed (T5).
    ``tail_read``: what the tail read last over a healthy through line, since the ends were changed (T2).
    ``occupied``: the blocks the train is in, by its own tags (T2).
    """

    life: UnitLife
    answered: Epoch | None
    standing_in: frozenset[Block]
    isolated_in: Epoch | None
    orders: Map[Run, Order]
    loop_open: bool
    leading: Cab | None
    head_tag: Tag | None
    tail_read: Read | None
    occupied: frozenset[Block]
