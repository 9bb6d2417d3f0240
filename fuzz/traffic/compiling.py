"""Compiles the driver once for each version of its sources, and keeps the code for the next process."""

from __future__ import annotations

import fcntl
import hashlib
import os
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import lru_cache
from pathlib import Path
from typing import Any

import llvmlite
import numba
from numba.core import config as settings
from numba.extending import intrinsic

config: Any = settings
HERE = Path(__file__).parent


@lru_cache(maxsize=1)
def folder() -> Path | None:
    """Where compiled code is kept, none where nothing can be written; another source, another folder.

    numba looks only at the file of the function itself, not at those that it calls; so the hash of all of them
    names the folder, and nothing stale is ever found in it.
    """
    digest = hashlib.sha256(f"{numba.__version__} {llvmlite.__version__}".encode())
    sources = [*HERE.glob("*.py"), HERE.parents[1] / "proofs" / "transitions.py"]
    for source in sorted(sources):
        digest.update(source.read_bytes())
    kept = Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache") / "heisoku" / digest.hexdigest()[:24]
    try:
        kept.mkdir(parents=True, exist_ok=True)
    except OSError:
        return None
    return kept if os.access(kept, os.W_OK) else None


@contextmanager
def kept_in() -> Iterator[bool]:
    """Have numba keep what is compiled meanwhile in our folder; tells whether there is one."""
    kept, before = folder(), config.CACHE_DIR
    config.CACHE_DIR = "" if kept is None else str(kept)
    try:
        yield kept is not None
    finally:
        config.CACHE_DIR = before


@contextmanager
def one_at_a_time() -> Iterator[None]:
    """Only one process compiles what is to be kept; others wait meanwhile, and then read it."""
    kept = folder()
    if kept is None:
        yield
        return
    with (kept / "lock").open("w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        yield


def compiled(function: Callable[..., Any]) -> Any:
    """Compile a function by numba, when it is first called."""
    with kept_in() as kept:
        return numba.njit(cache=kept)(function)


def built_in(function: Callable[..., Any]) -> Any:
    """Make a function that says itself how it is lowered one that compiled code can call."""
    return intrinsic(function)
