"""What each restart leaves.  Written by ``python -m proofs.restarts`` from ``kernel/persistence.py`` (T8)."""

from __future__ import annotations

from kernel.centre import Centre
from kernel.crossing.crossing import Crossing, CrossingTrack, Settings, Train
from kernel.crossing.ranging_schedule import ChannelSettings, Schedule
from kernel.crossing.start_point import StartPoint
from kernel.layout import Layout
from kernel.names import Epoch, TerminalLife, UnitLife
from kernel.terminal import Terminal
from kernel.unit import Unit


def restart_centre(layout: Layout, centre: Centre, epoch: Epoch) -> Centre:
    """Begin a new epoch: every block and point is lost, nobody is accounted for (T8)."""
    return Centre(
        epoch=epoch,
        newest=centre.newest,
        accounted={},
        runs={},
        claimed={},
        locked={},
        lost_blocks=layout.blocks,
        lost_points=layout.points,
        terminal_life={},
        supervised=frozenset(),
        statements={},
    )


def restart_unit(unit: Unit, life: UnitLife) -> Unit:
    """Begin a new life: no authority, and no memory of where the train is (T8)."""
    return Unit(
        life=life,
        answered=None,
        standing_in=frozenset(),
        isolated_in=None,
        orders={},
        loop_open=False,
        leading=None,
        head_tag=None,
        tail_read=None,
        occupied=frozenset(),
    )


def restart_terminal(terminal: Terminal, life: TerminalLife) -> Terminal:
    """Begin a new life: the lock stays as it is, the lock id is gone (T8, T10)."""
    return Terminal(
        life=life,
        holds=None,
        wanted=None,
        unlocked=terminal.unlocked,
    )


def restart_crossing(settings: Settings, tracks: frozenset[CrossingTrack], number: int) -> Crossing:
    """Begin, or begin anew: warn, arms down, until each track is accounted for (X3, X5)."""
    return Crossing(
        asks={},
        starts={},
        silent_cycles={track: settings.silence_cycles + 1 for track in tracks},
        unaccounted={track: True for track in tracks},
        numbers={},
        looks={track: number for track in tracks},
        number=number,
        warns=True,
        warned_cycles=settings.bell_cycles,
    )


def restart_ranging_schedule(settings: ChannelSettings, number: int) -> Schedule:
    """Begin, or begin anew: the channel is taken for a slot, and the next one has a new number (X1)."""
    return Schedule(
        turns={},
        pairs=0,
        number=number,
        taken_ms=settings.slot_ms,
    )


def restart_start_point(nobody: Train) -> StartPoint:
    """Begin, or begin anew: no read waits, and strikes may have been missed (X3, T14)."""
    return StartPoint(
        reader=nobody,
        left_cycles=0,
        struck_cycles=0,
        owes=True,
    )
