"""Code that numba compiles once for each version of its sources, kept for the next process."""

from __future__ import annotations

import fcntl
import hashlib
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from functools import cached_property
from pathlib import Path
from typing import Any

import llvmlite
import numba
from numba.core import config as settings
from numba.core.dispatcher import Dispatcher

from models.compiled.called import Inner
from models.kept_folder import kept_folder
from models.names_apart import name_apart

config: Any = settings


class Kept:
    """Keeps the code of some functions; ``name``: of what, ``sources``: every file that is compiled into it."""

    def __init__(self, name: str, sources: Iterable[Path]) -> None:
        self._name, self._sources = name, sorted(sources)

    @cached_property
    def folder(self) -> Path | None:
        """Where it is kept, none where nothing can be written; another source, another folder.

        numba looks only at the file of the function itself, not at those that it calls; so the hash of all of them
        names the folder, and nothing stale is ever found in it.
        """
        digest = hashlib.sha256(f"{self._name} {numba.__version__} {llvmlite.__version__}".encode())
        for source in self._sources:
            digest.update(source.read_bytes())
        return kept_folder(digest.hexdigest()[:24])

    @contextmanager
    def kept_in(self, part: str = "") -> Iterator[bool]:
        """Have numba keep what is compiled meanwhile in the folder, or a part of it; tells whether there is one."""
        before = config.CACHE_DIR
        config.CACHE_DIR = "" if self.folder is None else str(self.folder / part)
        try:
            yield self.folder is not None
        finally:
            config.CACHE_DIR = before

    @contextmanager
    def one_at_a_time(self) -> Iterator[None]:
        """Only one process compiles what is to be kept; others wait meanwhile, and then read it."""
        if self.folder is None:
            yield
            return
        with (self.folder / "lock").open("w") as lock:
            fcntl.flock(lock, fcntl.LOCK_EX)
            yield

    def compiled(self, function: Callable[..., Any]) -> Any:
        """Compile a function by numba, when it is first called."""
        outer: Any = numba.njit(function)
        if not isinstance(outer, Dispatcher):
            return outer
        made = Inner(outer)
        for each, called_from in ((made, ""), (outer, "python")):
            with self.kept_in(called_from) as kept:
                if kept:
                    each.enable_caching()
        return made


name_apart()
