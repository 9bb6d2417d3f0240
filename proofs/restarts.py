"""Writes ``kernel/restarts.py`` from the persistence table: ``python -m proofs.restarts`` (T8)."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import fields
from pathlib import Path

from kernel import persistence
from kernel.centre import Centre
from kernel.crossing.crossing import Crossing
from kernel.crossing.ranging_schedule import Schedule
from kernel.crossing.start_point import StartPoint
from kernel.persistence import Memory
from kernel.terminal import Terminal
from kernel.unit import Unit

HEAD = '''"""What each restart leaves.  Written by ``python -m proofs.restarts`` from ``kernel/persistence.py`` (T8)."""

from __future__ import annotations

from kernel.centre import Centre
from kernel.crossing.crossing import Crossing, CrossingTrack, Settings, Train
from kernel.crossing.ranging_schedule import ChannelSettings, Schedule
from kernel.crossing.start_point import StartPoint
from kernel.layout import Layout
from kernel.names import Epoch, TerminalLife, UnitLife
from kernel.terminal import Terminal
from kernel.unit import Unit
'''


def restart_source(
    name: str, before: str, state: type, parameters: str, why: str, table: Mapping[str, tuple[Memory, str]]
) -> str:
    """Give the source of one restart function; every field of ``state`` must stand in ``table``."""
    declared = [field.name for field in fields(state)]
    if set(declared) != set(table):
        missing = sorted(set(declared) ^ set(table))
        raise ValueError(f"persistence table of {state.__name__}: {', '.join(missing)} stand on one side only")
    lines = [
        f"def {name}({parameters}) -> {state.__name__}:",
        f'    """{why}"""',
        f"    return {state.__name__}(",
    ]
    for field in declared:
        memory, value = table[field]
        lines.append(f"        {field}={f'{before}.{field}' if memory is Memory.LASTING else value},")
    return "\n".join([*lines, "    )", ""])


def source() -> str:
    """Give the whole text of ``kernel/restarts.py``."""
    parts = [
        HEAD,
        restart_source(
            "restart_centre",
            "centre",
            Centre,
            "layout: Layout, centre: Centre, epoch: Epoch",
            "Begin a new epoch: every block and point is lost, nobody is accounted for (T8).",
            persistence.CENTRE,
        ),
        restart_source(
            "restart_unit",
            "unit",
            Unit,
            "unit: Unit, life: UnitLife",
            "Begin a new life: no authority, and no memory of where the train is (T8).",
            persistence.UNIT,
        ),
        restart_source(
            "restart_terminal",
            "terminal",
            Terminal,
            "terminal: Terminal, life: TerminalLife",
            "Begin a new life: the lock stays as it is, the lock id is gone (T8, T10).",
            persistence.TERMINAL,
        ),
        restart_source(
            "restart_crossing",
            "crossing",
            Crossing,
            "settings: Settings, tracks: frozenset[CrossingTrack], number: int",
            "Begin, or begin anew: warn, arms down, until each track is accounted for (X3, X5).",
            persistence.CROSSING,
        ),
        restart_source(
            "restart_ranging_schedule",
            "schedule",
            Schedule,
            "settings: ChannelSettings, number: int",
            "Begin, or begin anew: the channel is taken for a slot, and the next one has a new number (X1).",
            persistence.RANGING_SCHEDULE,
        ),
        restart_source(
            "restart_start_point",
            "point",
            StartPoint,
            "nobody: Train",
            "Begin, or begin anew: no read waits, and strikes may have been missed (X3, T14).",
            persistence.START_POINT,
        ),
    ]
    return "\n\n".join(parts)


def main() -> None:
    """Write the file in its place."""
    Path(__file__).parent.parent.joinpath("kernel", "restarts.py").write_text(source(), encoding="utf-8")


if __name__ == "__main__":
    main()
