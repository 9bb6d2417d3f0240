"""A real Dask scheduler with real worker processes, for as long as a test wants them."""

from __future__ import annotations

import importlib.util
import os
import signal
import socket
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]

needs_dask = pytest.mark.skipif(importlib.util.find_spec("distributed") is None, reason="dask is not installed")


def dask(*words: str, sources: Path = ROOT) -> subprocess.Popen[bytes]:
    command = [sys.executable, "-m", "dask", *words]
    environment = {**os.environ, "PYTHONPATH": str(sources)}
    quiet = subprocess.DEVNULL
    return subprocess.Popen(command, cwd=sources, env=environment, stdout=quiet, stderr=quiet, start_new_session=True)


@contextmanager
def scheduled(
    folder: Path, workers: int = 2, sources: Path = ROOT
) -> Iterator[tuple[str, list[subprocess.Popen[bytes]]]]:
    """A scheduler with workers of one process each, on these sources; every process ends with it."""
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        address = f"tcp://127.0.0.1:{free.getsockname()[1]}"
    started = [dask("scheduler", "--host", address, "--no-dashboard", "--no-jupyter", "--no-show")]
    try:
        for number in range(workers):
            words = ["--nthreads", "1", "--no-dashboard", "--local-directory", str(folder / f"worker{number}")]
            started.append(dask("worker", address, "--name", f"worker{number}", *words, sources=sources))
        yield address, started
    finally:
        for process in started:
            os.killpg(process.pid, signal.SIGKILL)
            process.wait()
