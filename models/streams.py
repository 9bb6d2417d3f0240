"""Standard output and standard error that may be closed, or full, without a verdict that was never reached."""

from __future__ import annotations

import os
import sys
from io import BufferedWriter, FileIO, TextIOWrapper
from pathlib import Path
from typing import Any, TextIO

STANDARD_OUTPUT = Path("-")
"""What ``--json -`` names: the record goes to standard output, and findings to standard error."""


class Outlet(FileIO):
    """A stream of the system.  ``lost``: why what was written did not arrive, none if all did.

    Nobody need read to the end: a closed pipe takes the rest in silence, and the command comes to its verdict.
    """

    lost: OSError | None = None

    def write(self, content: Any, /) -> int:
        """Write; what cannot be written is dropped, and it is remembered why."""
        try:
            return super().write(content) or 0
        except OSError as error:
            if not isinstance(error, BrokenPipeError):
                self.lost = error
            nowhere = os.open(os.devnull, os.O_WRONLY)
            os.dup2(nowhere, self.fileno())
            os.close(nowhere)
            return memoryview(content).nbytes


def is_told_at_once(stream: TextIOWrapper) -> bool:
    """Whether a line is written when it ends, and not with many others: of complaints, and where Python is told so."""
    return stream is sys.stderr or stream.line_buffering or stream.write_through


def outlet(stream: TextIO) -> Outlet | None:
    """The same stream through an outlet, in place of a stream of Python's; none where it is no stream of the system."""
    if not isinstance(stream, TextIOWrapper):
        return None
    stream.flush()
    raw = Outlet(stream.fileno(), "wb", closefd=False)
    text = TextIOWrapper(
        BufferedWriter(raw), encoding=stream.encoding, errors="replace", line_buffering=is_told_at_once(stream)
    )
    if stream is sys.stdout:
        sys.stdout = text
    else:
        sys.stderr = text
    return raw


def write_whole(path: Path, content: bytes) -> None:
    """Write a file beside its place and move it there, making its folder where that is missing.

    What is no file, a pipe or a device, is written into, not replaced; a link stays, and what it names is written.

    Raises:
        OSError: it cannot be written; what stood there before stands there still.
    """
    if path.exists() and not path.is_file():
        with path.open("wb") as open_end:
            open_end.write(content)
        return
    path = path.resolve()
    path.parent.mkdir(parents=True, exist_ok=True)
    beside = path.with_name(f".{path.name}.{os.getpid()}")
    try:
        beside.write_bytes(content)
        beside.replace(path)
    except OSError as error:
        raise OSError(error.errno, f"cannot be written ({error.strerror})", str(path)) from error
    finally:
        beside.unlink(missing_ok=True)
