"""`heisoku check` on a network of 100,000 routes: its time and its memory, in a process of its own."""

from __future__ import annotations

import os
import resource
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from pathlib import Path

from models.layouts.conflict_pairs import Conflicts
from models.layouts.generate import as_toml, network
from models.layouts.native import import_native
from tests.bench import Figure

ROUTES = int(os.environ.get("HEISOKU_ROUTES", "100000"))
GIB = 2**30


def bench_check_of_a_large_network() -> Iterator[Figure]:
    """From the file to the verdict, as a user waits for it."""
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "network.toml"
        file.write_text(as_toml(network(ROUTES, seed=1)), "utf-8")
        begin = time.perf_counter()
        said = subprocess.run(
            [sys.executable, "-m", "heisoku", "check", str(file)], capture_output=True, text=True, check=True
        )
        seconds = time.perf_counter() - begin
    assert "holds" in said.stdout
    most_bytes = resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss * 1024
    yield Figure(f"check of {ROUTES:,} routes", seconds, seconds, "s", 1)
    yield Figure(f"memory of a check of {ROUTES:,} routes", most_bytes / GIB, most_bytes / GIB, "GiB", 1)


def bench_conflicts_of_a_large_network() -> Iterator[Figure]:
    """Every pair of routes that conflict, counted."""
    layout = import_native("network", network(ROUTES, seed=1), ()).layout
    begin = time.perf_counter()
    count = sum(1 for _ in Conflicts(layout).pairs())
    seconds = time.perf_counter() - begin
    yield Figure(f"{count:,} conflicts of {ROUTES:,} routes", seconds, seconds, "s", 1)
