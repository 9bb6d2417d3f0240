"""The state of the whole: centre, units, terminals, the radio between them, and the track as it is."""

from __future__ import annotations

from dataclasses import dataclass

from kernel.centre import Centre
from kernel.layout import Layout, TagRecords
from kernel.maps import Map
from kernel.names import (
    Block,
    Cab,
    Car,
    Epoch,
    Point,
    Position,
    Read,
    Run,
    Tag,
    TagList,
    TerminalLife,
    Train,
    UnitLife,
)
from kernel.tag_list import TagLists, TagPlan
from kernel.terminal import Terminal
from kernel.unit import Unit
from models.ground import Ground

NO_CARS: frozenset[Car] = frozenset()


@dataclass(frozen=True)
class Formation:
    """Which cars make a train, and their order in each run.

    ``train_of``: the train a car belongs to, whether or not it still hangs on it.
    ``front``: the cab that leads a train that runs as in a run.
    ``last``: the last car in the direction of a run.
    ``ahead``: for a run and a car, the cars ahead of it.
    ``cab``: the cab that a car carries; no two cars of a train carry the same.
    ``carried_by``: the car that carries a cab.
    """

    train_of: Map[Car, Train]
    front: Map[Run, Cab]
    last: Map[Run, Car]
    ahead: Map[Run, Map[Car, frozenset[Car]]]
    cab: Map[Car, Cab]
    carried_by: Map[Cab, Car]


@dataclass(frozen=True)
class Site:
    """What does not change: the layout as the centre has it, what is on board, what is written in tags, ground, trains.

    ``lists``: what tag lists say, right or wrong.  ``plan``: the line's tags as the units know them.
    """

    layout: Layout
    lists: TagLists
    plan: TagPlan
    records: TagRecords
    ground: Ground
    formation: Formation


@dataclass(frozen=True)
class Radio:
    """Every message ever sent.  Any of them may arrive, any number of times, at any moment, or never (T11).

    ``orders``, ``enquiries``: centre to train, for a point terminal; ``relayed_…``: on to the terminal.
    ``confirmed``: terminal to train; ``confirmations``: on to the centre.
    ``offers``, ``permits``, ``recalls``: centre to train; ``echoes``, with the list that the train keeps, and
    ``returns``: back.
    ``tail_reports``, ``stops``: train to centre (third loop, standstill).
    ``challenges``: centre to all; ``standings``: the answers, one a life and epoch.
    ``standing_runs``: centre to train, under which run it stands.
    ``terminal_lives``: terminal to centre.
    ``statements``, ``confirmed_statements``: the two persons of the supervised procedure.
    """

    orders: frozenset[tuple[Run, Point, TerminalLife]]
    relayed_orders: frozenset[tuple[Run, Point, TerminalLife]]
    enquiries: frozenset[tuple[Run, Point, TerminalLife]]
    relayed_enquiries: frozenset[tuple[Run, Point, TerminalLife]]
    confirmed: frozenset[tuple[Run, Point, Position]]
    confirmations: frozenset[tuple[Run, Point, Position]]
    offers: frozenset[Run]
    echoes: Map[Run, TagList]
    permits: frozenset[Run]
    recalls: frozenset[Run]
    returns: frozenset[Run]
    tail_reports: frozenset[tuple[Run, Block, Read, Read]]
    stops: frozenset[Run]
    challenges: frozenset[Epoch]
    standings: Map[tuple[Train, UnitLife, Epoch], frozenset[Block]]
    standing_runs: frozenset[Run]
    terminal_lives: frozenset[tuple[Point, TerminalLife]]
    statements: Map[tuple[Train, UnitLife, Epoch], frozenset[Block]]
    confirmed_statements: Map[tuple[Train, UnitLife, Epoch], frozenset[Block]]


@dataclass(frozen=True)
class Track:
    """What is really there.

    ``at``: the blocks each car is in.
    ``under``: history: the run under which a car came into a block it has been in.
    ``run_into``: history: runs under which some car has moved.
    ``begun``: history: runs at whose start the head has read both tags, one right after the other.
    ``entered``: history: for each run the blocks that the head has been in since it began.
    ``gone``: history: for each run the blocks that the train has gone out of while it was permitted.
    ``behind``: history: for each run the blocks that its tail has been seen to leave, by what is written in their tags.
    ``rolling``: runs in which the train can no longer stop before the blocks they cover.
    ``slipping``: runs in which the train can no longer stop inside the destination.
    ``stood``: history: runs under which the train was held in its destination.
    ``leavable``: the blocks of a run that the train may get out of before its brake stops it.
    ``first_erred``, ``second_erred``: history: the lives and epochs in which the first, or the second, of the two
    persons of the supervised procedure has named a place that the train was not in, or not at rest in.
    ``facing``: the cab that leads each train, as its driver has chosen.
    ``last_read``: the tag that each train's head has read last since the ends were changed.
    ``passed``: the tags that a train's last antenna has passed since the ends were changed and
    since its head passed that boundary.
    ``unread``: tags that a train's head has passed without reading them, and that its unit awaits yet: not overdue,
    and no other was read, nor have the ends been changed, nor has another life begun.
    ``astray``: history: the lives in which a train read a tag that was not to come, or missed one (T5).
    ``lies``: how each point lies.
    ``parted``: trains that have lost some of their cars.
    """

    at: Map[Car, frozenset[Block]]
    under: Map[Car, Map[Block, Run]]
    run_into: frozenset[Run]
    begun: frozenset[Run]
    entered: frozenset[tuple[Run, Block]]
    gone: frozenset[tuple[Run, Block]]
    behind: frozenset[tuple[Run, Block]]
    rolling: frozenset[Run]
    slipping: frozenset[Run]
    stood: frozenset[Run]
    leavable: frozenset[tuple[Run, Block]]
    first_erred: frozenset[tuple[Train, UnitLife, Epoch]]
    second_erred: frozenset[tuple[Train, UnitLife, Epoch]]
    facing: Map[Train, Cab]
    last_read: Map[Train, Tag]
    passed: frozenset[tuple[Train, Tag]]
    unread: frozenset[tuple[Train, Tag]]
    astray: frozenset[tuple[Train, UnitLife]]
    lies: Map[Point, Position]
    parted: frozenset[Train]


@dataclass(frozen=True)
class System:
    """One moment of the whole system."""

    centre: Centre
    units: Map[Train, Unit]
    terminals: Map[Point, Terminal]
    radio: Radio
    track: Track
