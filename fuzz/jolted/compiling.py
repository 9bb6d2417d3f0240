"""Compiles what jolts once for each version of its sources, and keeps the code for the next process."""

from __future__ import annotations

import hashlib
import os
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import lru_cache
from pathlib import Path
from typing import Any, TypeVar, cast

import llvmlite
import numba
from numba.core import config as settings

config: Any = settings
F = TypeVar("F", bound=Callable[..., Any])
HERE = Path(__file__).parent


@lru_cache(maxsize=1)
def folder() -> Path | None:
    """Where compiled code is kept, none where nothing can be written; another source, another folder.

    The hash of all that is compiled in names the folder: of this package, and of the driver's words and calls.
    """
    digest = hashlib.sha256(f"jolted {numba.__version__} {llvmlite.__version__}".encode())
    for source in sorted([*HERE.glob("*.py"), *(HERE.parent / "traffic").glob("*.py")]):
        digest.update(source.read_bytes())
    kept = Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache") / "heisoku" / digest.hexdigest()[:24]
    try:
        kept.mkdir(parents=True, exist_ok=True)
    except OSError:
        return None
    return kept if os.access(kept, os.W_OK) else None


@contextmanager
def _kept_in() -> Iterator[bool]:
    """Have numba keep what is declared meanwhile in our folder; tells whether there is one."""
    kept, before = folder(), config.CACHE_DIR
    config.CACHE_DIR = "" if kept is None else str(kept)
    try:
        yield kept is not None
    finally:
        config.CACHE_DIR = before


def compiled(function: F) -> F:
    """Compile a function by numba, when it is first called."""
    with _kept_in() as kept:
        made: Any = numba.njit(cache=kept)(function)
    return cast(F, made)
