"""Whether this process has loaded the sources that stand there now.

A process that serves others may have been begun before somebody changed a file.  What it has loaded stays as it was,
and whatever it reads is new: a digest of the files then says that it is like everybody else, and it is not.  So this
module is the first that such a process loads, and looks at all sources before it loads another.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
READ = ("kernel", "models", "proofs", "fuzz")
"""The packages of which something follows, each of their modules or data."""

Stamps = dict[str, tuple[int, ...]]


def sources(rooms: Iterable[str]) -> Iterator[Path]:
    """Every source of packages, and their data."""
    for room in rooms:
        yield from (path for suffix in ("py", "toml") for path in sorted((ROOT / room).rglob(f"*.{suffix}")))


def stamps() -> Stamps:
    """When each source was last written and last changed in any way, in ns; which file it is, and how long.

    A copy that keeps the time of writing has another time of change, which nobody can choose.
    """
    seen = {str(path): path.stat() for path in sources(READ)}
    return {path: (each.st_mtime_ns, each.st_ctime_ns, each.st_ino, each.st_size) for path, each in seen.items()}


_FIRST = stamps()


def are_as_loaded() -> bool:
    """Tell whether no source has changed since this process loaded the first of them."""
    return stamps() == _FIRST
