"""`heisoku report`: the safety case, the sources and the records on one page."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from collections.abc import Mapping
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING, Annotated, NoReturn

import typer
from rich.console import Console

from proofs.records import BAD_INPUT, DOES_NOT_HOLD, HOLDS, UNDECIDED, write_whole

if TYPE_CHECKING:
    from evidence.records.showing import Came

CHROMIUM = ("chromium", "chromium-browser", "google-chrome")
PRINTING = ("--headless=new", "--no-first-run", "--disable-gpu", "--disable-dev-shm-usage", "--no-pdf-header-footer")
SECONDS = 300


def report(
    output: Annotated[
        Path, typer.Option("--output", "-o", metavar="F.html", help="The report; .pdf prints it.", show_default=False)
    ],
    records: Annotated[Path, typer.Option(metavar="DIR", help="The folder of records.")] = Path("out"),
    strict: Annotated[
        bool, typer.Option("--strict", help="1 if something does not hold, 3 if something is not shown.")
    ] = False,
) -> None:
    """Write the evidence for an assessor: what is not shown first, then everything with its evidence.

    A PDF is printed by Chromium.  A report that is written ends with 0, whatever it says; --strict judges it.

    Examples:
    * `heisoku report -o out/report.html`
    """
    from jinja2 import UndefinedError

    from evidence.case import CaseError
    from evidence.report.gathering import gathered
    from evidence.report.writing import page_of

    if output.suffix not in (".html", ".pdf"):
        _refuse(f"{output}: is neither a page nor a PDF; name it report.html or report.pdf")
    if not records.is_dir():
        _refuse(f"--records {records}: is no folder; make assure makes it")
    try:
        output.parent.mkdir(parents=True, exist_ok=True)
        writable = os.access(output.parent, os.W_OK) and not output.is_dir()
    except OSError:
        writable = False
    if not writable:
        _refuse(f"{output}: cannot be written; name another file")
    try:
        book = gathered(records)
    except CaseError as error:
        _refuse(f"SAFETY_CASE.md: {error}")
    try:
        page = page_of(book).encode()
    except (UndefinedError, KeyError, TypeError, ValueError) as error:
        _refuse(f"{records}: a record does not have the form of such a record ({error}); make it anew")
    write_whole(output, page if output.suffix == ".html" else printed(page))
    counts = ", ".join(f"{count} {verdict}" for verdict, count in book.counted.items())
    line = f"{output}: {len(book.shown)} pieces of evidence: {counts}; {len(book.case.limits)} open points"
    Console(width=None if sys.stdout.isatty() else 120).print(line, markup=False, highlight=False, soft_wrap=True)
    raise typer.Exit(judged(book.counted) if strict else HOLDS)


def judged(counted: Mapping[Came, int]) -> int:
    """The exit code of a report that is judged: by the worst of its evidence."""
    if counted["does not hold"]:
        return DOES_NOT_HOLD
    return UNDECIDED if counted["not shown"] else HOLDS


def printed(page: bytes) -> bytes:
    """Print a page with Chromium."""
    chromium = next((found for name in CHROMIUM if (found := shutil.which(name))), None)
    if chromium is None:
        _refuse("there is no Chromium to print with; install it, or write the report as .html")
    with TemporaryDirectory(ignore_cleanup_errors=True) as place:
        source, target = Path(place) / "report.html", Path(place) / "report.pdf"
        source.write_bytes(page)
        # Chromium does not start for root inside its sandbox; the page is ours and loads nothing.
        more = ["--no-sandbox"] if os.geteuid() == 0 or os.environ.get("CI") else []
        command = [chromium, *PRINTING, *more, f"--user-data-dir={place}/profile", f"--print-to-pdf={target}"]
        subprocess.run([*command, source.as_uri()], capture_output=True, timeout=SECONDS, check=False)
        if not target.is_file():
            _refuse(f"{chromium} printed nothing; write the report as .html, and print that")
        return target.read_bytes()


def _refuse(line: str) -> NoReturn:
    print("".join(char if char.isprintable() else " " for char in line), file=sys.stderr)
    raise typer.Exit(BAD_INPUT)
