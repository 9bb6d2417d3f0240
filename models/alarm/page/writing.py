"""Writes the handset's page: everything in one file, nothing loaded from anywhere (A7)."""

from __future__ import annotations

from pathlib import Path

from models.alarm.line import TUNNELS_MM, ZONE_MM
from models.alarm.page.scene import Shown, line_data, moment, shown
from models.streams import write_whole
from models.whole_page import script_data, template_of

LINE = "Yamabe line"
"""Made up."""
WORKER_M = (TUNNELS_MM[0][1] + ZONE_MM) / 1_000 + 1_000.0
"""Where every tone is heard within the hour: 1 km beyond a tunnel."""
FIRST_S, LENGTH_S = 0, 3_600


def page_of(scene: Shown, title: str = LINE) -> str:
    """Give the page of some minutes as HTML."""
    moments = [moment(scene, row) for row in range(len(scene.kept.own))]
    data = script_data({"line": line_data(), "moments": moments})
    return template_of("models.alarm.page").render(title=title, last=len(moments) - 1, data=data)


def write(
    path: Path,
    seed: int,
    day: int = 0,
    worker_m: float | None = WORKER_M,
    first_s: int = FIRST_S,
    length_s: int = LENGTH_S,
) -> None:
    """Write the page of ``length_s`` seconds of a day, from ``first_s`` on, for a worker at a place.

    Raises:
        OSError: the file cannot be written.
    """
    write_whole(path, page_of(shown(seed, day, worker_m, first_s, length_s)).encode())
