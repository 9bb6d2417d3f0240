"""What commands have in common: lines that move no cursor, one line for what cannot be used, progress, options."""

from __future__ import annotations

import os
import re
import sys
import threading
import time
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager, suppress
from importlib import metadata
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, NoReturn, TextIO

import typer
from rich.console import Console
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeElapsedColumn

from models.exit_codes import BAD_INPUT, HOLDS
from models.streams import STANDARD_OUTPUT

if TYPE_CHECKING:
    from models.processes import Workers

COLUMNS_OF_A_FILE = 120
"""Columns to write where the output is not a terminal."""
SECONDS_A_LINE = 10.0
"""So often a line of progress is told where standard error is not a terminal."""


_record_is_told = [False]
"""Whether this command's record goes to standard output."""


def record_alone(json: Path | None) -> Path | None:
    """Remember whether the record goes to standard output; said of every command before it begins."""
    _record_is_told[0] = json == STANDARD_OUTPUT
    return json


Json = Annotated[
    Path | None,
    typer.Option(
        "--json",
        metavar="F",
        callback=record_alone,
        help="Write the record there; - is standard output.",
        show_default=False,
    ),
]
Jobs = Annotated[int, typer.Option(metavar="N", min=1, help="Processes to use.")]
Scheduler = Annotated[
    str | None, typer.Option(metavar="ADDRESS", help="Use the processes of this Dask scheduler.", show_default=False)
]
Seed = Annotated[int, typer.Option(metavar="N", min=0, max=2**31 - 1, help="What everything is drawn from.")]
EVERY_CORE = os.cpu_count() or 1


def tell_version(is_asked: bool) -> None:
    """Tell the version, and end."""
    if is_asked:
        tell(f"heisoku {metadata.version('heisoku')}")
        raise typer.Exit(HOLDS)


Version = Annotated[bool, typer.Option("--version", callback=tell_version, is_eager=True, help="Tell the version.")]


def printable(text: str) -> str:
    """The text on one line, without control characters."""
    return "".join(char if char.isprintable() else " " for char in text)


def console(file: TextIO | None = None) -> Console:
    """Standard output, or another stream; 120 columns wide where it is not a terminal.  No text of ours is markup.

    Where the record goes to standard output, findings go to standard error, and the record stands alone.
    """
    stream = file or (sys.stderr if _record_is_told[0] else sys.stdout)
    width = None if stream.isatty() else COLUMNS_OF_A_FILE
    return Console(file=stream, width=width, markup=False, emoji=False, highlight=False)


def print_line(out: Console, line: str) -> None:
    """One line, whatever stands in the names of a file: no markup, nothing that moves a cursor."""
    out.print(printable(line), markup=False, highlight=False, soft_wrap=True)


def tell(line: str) -> None:
    """One line on standard output."""
    print_line(console(), line)


def complain(line: str) -> None:
    """One line on standard error."""
    print(printable(line), file=sys.stderr)


def refuse(line: str) -> NoReturn:
    """End a command whose input cannot be used: one line for whoever gave it, and exit code 2."""
    complain(line)
    raise typer.Exit(BAD_INPUT)


@contextmanager
def bad_input_refused() -> Iterator[None]:
    """Tell of a file that cannot be used in one line."""
    from models.layouts.results import BadInput

    try:
        yield
    except BadInput as bad:
        refuse(str(bad))


@contextmanager
def workers(scheduler: str | None, jobs: int, same: Callable[[], str]) -> Iterator[Workers]:
    """Give who works for a command; a scheduler that cannot be used, or is gone meanwhile, is told of in one line.

    ``same``: gives what the processes of other machines and this one must agree on.
    """
    from models.scheduler import SchedulerError, scheduled

    if scheduler is None:
        yield jobs
        return
    try:
        with scheduled(scheduler, same) as others:
            yield others
    except SchedulerError as error:
        complain(str(error))
        raise typer.Exit(error.code) from error


def pattern(only: str | None) -> re.Pattern[str]:
    """What ``--only`` asks for; without it everything matches."""
    try:
        return re.compile(only or "")
    except re.error as error:
        refuse(f"--only {only}: not a pattern ({error}); give a part of a name")


def metres(option: str, text: str) -> int:
    """A distance given in metres, with or without the unit, in mm."""
    try:
        distance_mm = round(1_000 * float(text.strip().removesuffix("m")))
    except (ValueError, OverflowError):
        distance_mm = -1
    if distance_mm < 0:
        refuse(f"{option} {text}: is no distance; give metres, as in '20 m'")
    return distance_mm


def keep_apart(*paths: Path | None, given: Iterable[Path | None] = ()) -> None:
    """Refuse what would be written in the place of a file that the command reads (``given``), or twice into one."""
    taken = {_place(path): "is read by this command" for path in given if path is not None}
    for path in paths:
        if path is not None and path != STANDARD_OUTPUT:
            place = _place(path)
            if not place.exists() or place.is_file():
                if place in taken:
                    refuse(f"{path}: {taken[place]}; write elsewhere")
                taken[place] = "is to be written twice"


def _place(path: Path) -> Path:
    """Where a path leads to; refuse one that leads nowhere, as links in a circle and names that are too long do."""
    try:
        place = path.resolve()
        with suppress(FileNotFoundError, NotADirectoryError, PermissionError):
            place.stat()
    except RuntimeError:
        refuse(f"{path}: links lead back to it; name another file")
    except OSError as error:
        refuse(f"{path}: {error.strerror}; name another file")
    return place


def writable(*paths: Path | None, given: Iterable[Path | None] = ()) -> None:
    """Find out before the work, not after it, that a record cannot be written, or would take a file's place.

    ``given``: the files that the command reads.
    """
    keep_apart(*paths, given=given)
    for path in paths:
        if path is None or path == STANDARD_OUTPUT:
            continue
        if path.exists() and not path.is_file() and not path.is_dir():
            if not os.access(path, os.W_OK):
                refuse(f"{path}: cannot be written; name another file")
            continue
        place = _place(path)
        try:
            place.parent.mkdir(parents=True, exist_ok=True)
        except OSError as error:
            refuse(f"{path}: cannot make the folder ({error.strerror}); name another file")
        if place.is_dir() or not os.access(place.parent, os.W_OK):
            refuse(f"{path}: cannot be written; name another file")


@contextmanager
def progress(what: str) -> Iterator[Callable[[int, int, str], None]]:
    """Give a function (done, total, name) that moves a bar on standard error; off a terminal a line now and then."""
    if not sys.stderr.isatty():
        with _in_lines(what) as step:
            yield step
        return
    bar = Progress(
        TextColumn(what, markup=False),
        BarColumn(),
        MofNCompleteColumn(),
        TimeElapsedColumn(),
        TextColumn("{task.fields[name]}", markup=False),
        console=console(sys.stderr),
        transient=True,
    )
    with bar:
        task = bar.add_task(what, total=None, name="")
        yield lambda done, total, name: bar.update(task, completed=done, total=total, name=name)


@contextmanager
def _in_lines(what: str) -> Iterator[Callable[[int, int, str], None]]:
    """Give a function that is told how far the work is, and tell it in a line every ten seconds."""
    came, ended = ["begun"], threading.Event()

    def step(done: int, total: int, name: str) -> None:
        came[0] = f"{done:,} of {total:,} {name}".rstrip()

    def tell_now_and_then() -> None:
        began = time.monotonic()
        while not ended.wait(SECONDS_A_LINE):
            complain(f"{what}: {came[0]}, after {time.monotonic() - began:.0f} s")

    teller = threading.Thread(target=tell_now_and_then, daemon=True)
    teller.start()
    try:
        yield step
    finally:
        ended.set()
        teller.join()
