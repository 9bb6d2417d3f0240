"""How fast a simulated line runs: as `heisoku simulate`, beside the commit before, and as a campaign runs it."""

from __future__ import annotations

import re
import subprocess
import sys
import time
from collections.abc import Iterable
from io import BytesIO
from pathlib import Path
from tarfile import open as open_archive
from tempfile import TemporaryDirectory

from fuzz.simulation.lines import Line, simulated
from models.layouts import load
from models.simulation.faults import EVERY_FAULT
from tests.bench import Figure, percentile
from tests.layouts.stations import SHARED

ROOT = Path(__file__).resolve().parents[2]
NETWORK = SHARED / "osrd-small_infra.json"
PASSES, HOURS = 3, 0.25
SAMPLE = (ROOT / "layouts" / "passing_station.toml", 3)


def bench_simulate_beside_the_commit_before() -> Iterable[Figure]:
    """In turn, each in a process of its own, judged by every invariant, its record kept in memory as ever."""
    path, trains = _where()
    with TemporaryDirectory() as folder:
        before = _taken_out(Path(folder))
        places = {"this tree": ROOT} | ({"the commit before": before} if before else {})
        found: dict[str, list[float]] = {what: [] for what in places}
        for _ in range(PASSES):
            for what, place in places.items():
                found[what].append(_told(place, path, trains))
    for what, times in found.items():
        yield _figure(f"simulate {path.name}, {trains} trains, CPython, {what}", times)


def bench_lines_of_a_campaign() -> Iterable[Figure]:
    """The same line by compiled cycles and by CPython, judged alike; loading what was compiled is not counted."""
    path, trains = _where()
    imported, line = load(path), Line(1, trains, HOURS, EVERY_FAULT)
    simulated(Line(1, trains, 0.01, EVERY_FAULT), imported)
    for what, compiled in (("compiled", True), ("CPython", False)):
        times = []
        for _ in range(PASSES):
            began = time.perf_counter()
            simulated(line, imported, compiled)
            times.append(3_600 * HOURS / (time.perf_counter() - began))
        yield _figure(f"line of a campaign on {path.name}, {trains} trains, {what}", times)


def _where() -> tuple[Path, int]:
    """The real network, where it is there; else a sample."""
    return (NETWORK, 20) if NETWORK.is_file() else SAMPLE


def _figure(what: str, times: list[float]) -> Figure:
    return Figure(what, percentile(times, 50), percentile(times, 95), "times real time, a core", len(times))


def _taken_out(folder: Path) -> Path | None:
    """The commit before, if there is one."""
    asked = ["git", "-C", str(ROOT), "archive", "HEAD^"]
    archive = subprocess.run(asked, capture_output=True, check=False)
    if archive.returncode:
        return None
    with open_archive(fileobj=BytesIO(archive.stdout)) as files:
        files.extractall(folder, filter="data")
    return folder


def _told(place: Path, path: Path, trains: int) -> float:
    """What `heisoku simulate` prints of its speed, as times real time."""
    asked = [sys.executable, "heisoku.py", "simulate", str(path), "--trains", str(trains), "--hours", str(HOURS)]
    told = subprocess.run(asked, cwd=place, capture_output=True, text=True, check=True).stdout
    found = re.search(r"([\d,]+) a second: ", told)
    assert found, told
    return int(found[1].replace(",", "")) / trains
