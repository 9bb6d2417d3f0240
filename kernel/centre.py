"""What the centre remembers (管理装置); its machines are in the files beside this one."""

from __future__ import annotations

from dataclasses import dataclass

from kernel.maps import Map, Members
from kernel.names import (
    Block,
    Cause,
    Epoch,
    Point,
    Position,
    Run,
    Serial,
    Stage,
    Tag,
    TerminalLife,
    Train,
    UnitLife,
)

NO_RUNS: frozenset[Run] = frozenset()
NO_BLOCKS: frozenset[Block] = frozenset()
NO_POINTS: frozenset[Point] = frozenset()
NO_TAGS: Map[Tag, Tag] = {}
NO_LOCKS: Map[Run, Position] = {}
NOTHING_ENDED: Map[Block, Cause] = {}


@dataclass(frozen=True)
class Grant:
    """One run, as the centre sees it (T4, T9).

    ``proved``: points whose lying and lock the terminal confirmed for this run (T10).
    ``cancelling``: the train has been asked to give the run back (T9).
    ``ended``: the claims that are no more, and the one cause of each (T8).
    """

    stage: Stage
    proved: frozenset[Point]
    cancelling: bool
    ended: Map[Block, Cause]


@dataclass(frozen=True)
class Statement:
    """What the first of two persons has said of a train that stands (T8, ours).

    ``life``: the number its unit shows since it was isolated.
    ``blocks``: where the train stands, all of it.
    """

    life: UnitLife
    blocks: frozenset[Block]


@dataclass(frozen=True)
class Centre:
    """All that the centre decides from.

    ``epoch``: counts the restarts of the centre (T8).
    ``newest``: the newest serial ever granted; survives every restart (T10).
    ``accounted``: the life in which each train has told where it stands in this epoch (T8).
    ``runs``: every run that it has granted and not forgotten (T4, T9).
    ``claimed``: for each block the runs it is held for; absent means none (T4).
    ``locked``: for each point the runs it is locked for, and how it must lie (T10).
    ``lost_blocks``, ``lost_points``: held since the last restart for whatever may be there (T8).
    ``terminal_life``: the life each point terminal was last heard in (T10).
    ``supervised``: trains for which the supervised procedure is open (T8).
    ``statements``: what the first person has said of them.
    """

    epoch: Epoch
    newest: Serial
    accounted: Map[Train, UnitLife]
    runs: Map[Run, Grant]
    claimed: Map[Block, frozenset[Run]]
    locked: Map[Point, Map[Run, Position]]
    lost_blocks: Members[Block]
    lost_points: Members[Point]
    terminal_life: Map[Point, TerminalLife]
    supervised: frozenset[Train]
    statements: Map[Train, Statement]
