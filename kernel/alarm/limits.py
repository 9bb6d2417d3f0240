"""Whether what is written for a line and its handsets may be used: asked before a handset is handed out (A1)."""

from __future__ import annotations

from kernel.alarm.tone import Register

GREATEST_SERVER_MS = 3_600_000
"""A list counts as fresh for an hour at most (ours)."""


def is_lawful(register: Register) -> bool:
    """Tell whether a register may be used; if not, no handset is given out with it (A1).

    Neither the line's greatest speed nor the error of a train's fix is below zero, nor the time for which a fix is
    fresh; the server's list is fresh for an hour at most.
    """
    return (
        register.bounds.train_mm_s >= 0
        and register.bounds.train_error_mm >= 0
        and register.fresh.fix_ms >= 0
        and register.fresh.server_ms <= GREATEST_SERVER_MS
    )
