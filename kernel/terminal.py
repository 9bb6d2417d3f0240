"""A point's control terminal: unlocks, throws and locks with the lock id, obeys none older (T10)."""

from __future__ import annotations

from dataclasses import dataclass, replace

from kernel.names import Position, Run, TerminalLife


@dataclass(frozen=True)
class Terminal:
    """All that a terminal decides from; ``life`` and the lock itself survive its restart (T8, T10).

    ``life``: counts the restarts of the terminal.
    ``holds``: the newest run it has obeyed in this life; its serial is the lock id.
    ``wanted``: how the point shall lie for that run; none after a restart.
    ``unlocked``: the point is free to move, and may drift.
    """

    life: TerminalLife
    holds: Run | None
    wanted: Position | None
    unlocked: bool


def obey(
    terminal: Terminal, run: Run, position: Position, life: TerminalLife, detected: Position, is_detected: bool
) -> Terminal:
    """Obey an order newer than the one held: unlock and throw, or only re-label if the point lies right (T10).

    ``detected``: how the point lies, by its own detector contacts; it says nothing unless ``is_detected``: the
    contacts show a position.  While they show none a locked point stays locked, and the order is obeyed when it
    comes again: it may lie right, with a train over it that another run led there.
    """
    if life != terminal.life:
        return terminal
    if terminal.holds is not None and run.serial <= terminal.holds.serial:
        return terminal
    if not terminal.unlocked and not is_detected:
        return terminal
    return replace(terminal, holds=run, wanted=position, unlocked=terminal.unlocked or detected != position)


def relabel(terminal: Terminal, run: Run, life: TerminalLife) -> Terminal:
    """Take the lock id of a train that stands over the point; nothing moves (T8, T10)."""
    if life != terminal.life:
        return terminal
    if terminal.holds is not None and run.serial <= terminal.holds.serial:
        return terminal
    return replace(terminal, holds=run, wanted=None)


def lock(terminal: Terminal, detected: Position, is_detected: bool) -> Terminal:
    """Lock the point once its contacts show that it lies as wanted (T10)."""
    if terminal.wanted is None or not is_detected or terminal.wanted != detected:
        return terminal
    return replace(terminal, unlocked=False)


def confirms(terminal: Terminal, run: Run, position: Position, detected: Position, is_detected: bool) -> bool:
    """Tell whether the terminal confirms that the point is locked for ``run`` and its contacts show it so (T10)."""
    return terminal.holds == run and not terminal.unlocked and is_detected and detected == position
