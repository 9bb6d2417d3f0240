"""What commands have in common: lines that move no cursor, one line for what cannot be used, progress, options."""

from __future__ import annotations

import os
import re
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Annotated, NoReturn, TextIO

import typer
from rich.console import Console
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeElapsedColumn

from models.exit_codes import BAD_INPUT

COLUMNS_OF_A_FILE = 120
"""Columns to write where the output is not a terminal."""

Json = Annotated[Path | None, typer.Option("--json", metavar="F", help="Write the record there.", show_default=False)]
Jobs = Annotated[int, typer.Option(metavar="N", min=1, help="Processes to use.")]
Seed = Annotated[int, typer.Option(metavar="N", min=0, max=2**31 - 1, help="What everything is drawn from.")]
EVERY_CORE = os.cpu_count() or 1


def printable(text: str) -> str:
    """The text on one line, without control characters."""
    return "".join(char if char.isprintable() else " " for char in text)


def console(file: TextIO | None = None) -> Console:
    """Standard output, or another stream; 120 columns wide where it is not a terminal."""
    stream = file or sys.stdout
    return Console(file=stream, width=None if stream.isatty() else COLUMNS_OF_A_FILE)


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


def pattern(only: str | None) -> re.Pattern[str]:
    """What ``--only`` asks for; without it everything matches."""
    try:
        return re.compile(only or "")
    except re.error as error:
        refuse(f"--only {only}: not a pattern ({error}); give a part of a name")


def writable(*paths: Path | None) -> None:
    """Find out before the work, not after it, that a record cannot be written."""
    for path in paths:
        if path is None:
            continue
        try:
            path.parent.mkdir(parents=True, exist_ok=True)
        except OSError as error:
            refuse(f"{path}: cannot make the folder ({error.strerror}); name another file")
        if path.is_dir() or not os.access(path.parent, os.W_OK):
            refuse(f"{path}: cannot be written; name another file")


@contextmanager
def progress(what: str) -> Iterator[Callable[[int, int, str], None]]:
    """Give a function (done, total, name) that moves a bar on standard error; none unless it is a terminal."""
    bar = Progress(
        TextColumn(what),
        BarColumn(),
        MofNCompleteColumn(),
        TimeElapsedColumn(),
        TextColumn("{task.fields[name]}", markup=False),
        console=console(sys.stderr),
        disable=not sys.stderr.isatty(),
        transient=True,
    )
    with bar:
        task = bar.add_task(what, total=None, name="")
        yield lambda done, total, name: bar.update(task, completed=done, total=total, name=name)
