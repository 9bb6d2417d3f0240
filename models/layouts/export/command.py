"""`heisoku export`: a layout's tag plan, route and control tables and conflicts, and the layout written back."""

from __future__ import annotations

import errno
import sys
from pathlib import Path
from typing import Annotated

import typer

from models.commands import bad_input_refused, console, keep_apart, refuse, tell
from models.exit_codes import DOES_NOT_HOLD
from models.streams import write_whole

NO_PLACE = (errno.EACCES, errno.EPERM, errno.EROFS, errno.ENOTDIR, errno.EEXIST)
"""A folder that another would do for; a disk that is full, say, decides nothing."""

Layout = Annotated[Path, typer.Argument(metavar="LAYOUT", help="A layout file.", show_default=False)]
Folder = Annotated[Path, typer.Option("--output", "-o", metavar="DIR", help="The folder.", show_default=False)]
Files = Annotated[
    list[str] | None,
    typer.Option("--file", metavar="NAME", help="Of all files this one; may be repeated.", show_default="all"),
]


def export(layout: Layout, output: Folder, file: Files = None) -> None:
    """Write what is planned for a layout: tags, routes, conflicts, the control table, and the layout itself.

    The tag plan holds every tag's record, as CSV and as the bytes to be written.  The layout is written back in the
    native format and in RailJSON, and read again before that.  What cannot be written is named, and is 1: ask for the
    other files by name.  A layout that does not hold is exported and is 1.

    Examples:
    * `heisoku export layouts/passing_station.toml -o out/export`
    * `heisoku export layouts/passing_station.toml -o out/export --file tag_plan.csv --file tag_records.bin`
    """
    from models.layouts import check, load
    from models.layouts.export.files import NAMES, written

    for name in file or ():
        if name not in NAMES:
            refuse(f"--file {name}: no export has that; name one of {', '.join(NAMES)}")
    if output.exists() and not output.is_dir():
        refuse(f"{output}: is no folder; name another")
    asked = [name for name in NAMES if not file or name in file]
    keep_apart(*(output / name for name in asked), given=(layout,))
    try:
        with bad_input_refused(), console(sys.stderr).status("exporting"):
            imported = load(layout)
            result = check(imported)
            files = [each for each in written(imported, result) if not file or each.name in file]
            output.mkdir(parents=True, exist_ok=True)
            for name in asked:
                (output / name).unlink(missing_ok=True)
            for each in files:
                if each.content is not None:
                    write_whole(output / each.name, each.content)
    except OSError as error:
        if error.errno not in NO_PLACE:
            raise
        refuse(f"{output}: cannot be written ({error.strerror}); name another folder")
    there = [each for each in files if each.content is not None and _is_there(output / each.name, each.content)]
    for each in files:
        tell(f"{output / each.name}: {'' if each.content is not None else 'not written: '}{each.says}")
    count = len(there)
    tell(f"{layout}: {count} files written, {len(asked) - count} not; the layout {result.verdict}")
    raise typer.Exit(result.exit_code if {each.name for each in there} == set(asked) else DOES_NOT_HOLD)


def _is_there(path: Path, content: bytes) -> bool:
    """Whether a file holds what was written into it."""
    return path.is_file() and path.read_bytes() == content
