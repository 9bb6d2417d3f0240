"""All that centre, units and point terminals are told, and all that they say: a closed set (T4, T6, T8, T9, T10).

A message carries what its receiver acts on.  What a unit passes on between centre and terminal it passes on as it is.
"""

from __future__ import annotations

from dataclasses import dataclass

from kernel.names import Block, Epoch, Point, Position, Read, Run, TagList, TerminalLife, Train, UnitLife

# ---- centre to unit


@dataclass(frozen=True)
class Challenge:
    """Where do you stand (T8)?"""

    epoch: Epoch


@dataclass(frozen=True)
class Offer:
    """The tag list of a run (first loop; T4)."""

    run: Run
    tag_list: TagList


@dataclass(frozen=True)
class Permit:
    """The route is complete: enter (T4)."""

    run: Run


@dataclass(frozen=True)
class Recall:
    """Give the run back (T9)."""

    run: Run


@dataclass(frozen=True)
class StandingRun:
    """The run under which the centre holds what the train has told (T8)."""

    run: Run


@dataclass(frozen=True)
class PointOrder:
    """Lay ``point`` in ``position`` and lock it for ``run``; on to the terminal of that life (T10)."""

    run: Run
    point: Point
    position: Position
    life: TerminalLife


@dataclass(frozen=True)
class PointEnquiry:
    """Tell how ``point`` lies below the train of ``run``; on to the terminal of that life (T8, T10)."""

    run: Run
    point: Point
    life: TerminalLife


# ---- unit to centre


@dataclass(frozen=True)
class Echo:
    """The list that the unit keeps for a run (first loop; T4)."""

    run: Run
    tag_list: TagList


@dataclass(frozen=True)
class TailReport:
    """The tail has left ``block``, and read this (third loop; T6, T7)."""

    run: Run
    block: Block
    left: Read
    entered: Read


@dataclass(frozen=True)
class Stopped:
    """The train stands in the destination of the run (T9)."""

    run: Run


@dataclass(frozen=True)
class GivenBack:
    """The run is given back, and will not be entered (T9)."""

    run: Run


@dataclass(frozen=True)
class Standing:
    """Where the train stands, as it answered the challenge of ``epoch`` at the beginning of this life (T8)."""

    train: Train
    life: UnitLife
    epoch: Epoch
    blocks: frozenset[Block]


# ---- terminal, by way of a unit, to centre


@dataclass(frozen=True)
class Confirmation:
    """The point is locked for ``run`` and lies so (T10)."""

    run: Run
    point: Point
    position: Position


@dataclass(frozen=True)
class TerminalTold:
    """The life that a terminal is in (T10)."""

    point: Point
    life: TerminalLife


# ---- people to centre


@dataclass(frozen=True)
class Request:
    """A route is wanted for a train that stands, or will stand, under ``base`` (T9).

    ``run``: numbered as the next one by whoever asks (:func:`kernel.machine.centre.next_run`): what is asked twice is
    granted once.
    """

    run: Run
    base: Run


@dataclass(frozen=True)
class Withdrawal:
    """A run is not wanted any more; its train has not been told of it (T9)."""

    run: Run


@dataclass(frozen=True)
class Cancellation:
    """A run is wanted back of which its train has been told (T9)."""

    run: Run


@dataclass(frozen=True)
class Procedure:
    """The signaller opens the supervised procedure for a train (T8)."""

    train: Train


@dataclass(frozen=True)
class FirstStatement:
    """What the first person reads off the isolated unit, and where he sees the train (T8)."""

    train: Train
    life: UnitLife
    epoch: Epoch
    blocks: frozenset[Block]


@dataclass(frozen=True)
class SecondStatement:
    """What the second person reads off the isolated unit, and where he sees the train (T8)."""

    train: Train
    life: UnitLife
    epoch: Epoch
    blocks: frozenset[Block]


# ---- people to unit


@dataclass(frozen=True)
class Isolation:
    """The first person isolates the unit, in the epoch that the signaller names (T8)."""

    epoch: Epoch


# ---- a clock


@dataclass(frozen=True)
class Tick:
    """The clock of a machine ticks: what is to be done of itself is done now."""


ToUnit = Challenge | Offer | Permit | Recall | StandingRun | PointOrder | PointEnquiry
FromUnit = Echo | TailReport | Stopped | GivenBack | Standing
FromTerminal = Confirmation | TerminalTold
ToTerminal = PointOrder | PointEnquiry
FromPeople = Request | Withdrawal | Cancellation | Procedure | FirstStatement | SecondStatement
ToCentre = FromUnit | FromTerminal | FromPeople | Tick
