"""`heisoku export`: a layout's tag plan, route and control tables and conflicts, and the layout written back."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Annotated, NoReturn

import typer
from rich.console import Console

BAD_INPUT = 2

Layout = Annotated[Path, typer.Argument(metavar="LAYOUT", help="A layout file.", show_default=False)]
Folder = Annotated[Path, typer.Option("--output", "-o", metavar="DIR", help="The folder.", show_default=False)]


def export(layout: Layout, output: Folder) -> None:
    """Write what is planned for a layout: tags, routes, conflicts, the control table, and the layout itself.

    The tag plan holds every tag's record, as CSV and as the bytes to be written.  The layout is written back in the
    native format and in RailJSON, and read again before that.  What cannot be written is named.  A layout that does
    not hold is exported and is 1.

    Examples:
    * `heisoku export layouts/passing_station.toml -o out/export`
    """
    from models.layouts import BadInput, check, load
    from models.layouts.export.files import NAMES, written

    if output.exists() and not output.is_dir():
        _refuse(f"{output}: is no folder; name another")
    try:
        with Console(stderr=True).status("exporting"):
            imported = load(layout)
            result = check(imported)
            files = list(written(imported, result))
            output.mkdir(parents=True, exist_ok=True)
            for name in NAMES:
                (output / name).unlink(missing_ok=True)
            for each in files:
                if each.content is not None:
                    (output / each.name).write_bytes(each.content)
    except BadInput as bad:
        _refuse(str(bad))
    except OSError as error:
        _refuse(f"{output}: cannot be written ({error.strerror}); name another folder")
    for each in files:
        _line(f"{output / each.name}: {'' if each.content is not None else 'not written: '}{each.says}")
    count = sum(each.content is not None for each in files)
    _line(f"{layout}: {count} files written, {len(files) - count} not; the layout {result.verdict}")
    raise typer.Exit(result.exit_code)


def _refuse(line: str) -> NoReturn:
    print(_printable(line), file=sys.stderr)
    raise typer.Exit(BAD_INPUT)


def _line(text: str) -> None:
    width = None if sys.stdout.isatty() else 120
    Console(width=width).print(_printable(text), markup=False, highlight=False, soft_wrap=True)


def _printable(text: str) -> str:
    return "".join(char if char.isprintable() else " " for char in text)
