"""`heisoku report`: the safety case, the sources and the records on one page."""

from __future__ import annotations

import sys
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from models.commands import console, refuse, tell, writable
from models.exit_codes import DOES_NOT_HOLD, HOLDS, UNDECIDED
from models.streams import write_whole

if TYPE_CHECKING:
    from evidence.records.showing import Came


def report(
    output: Annotated[
        list[Path],
        typer.Option("--output", "-o", metavar="F.html|F.pdf", help="The report; may be repeated.", show_default=False),
    ],
    records: Annotated[Path, typer.Option(metavar="DIR", help="The folder of records.")] = Path("out"),
    strict: Annotated[
        bool, typer.Option("--strict", help="1 if something does not hold, 3 if something is not shown.")
    ] = False,
) -> None:
    """Write the evidence for an assessor: what is not shown first, then everything with its evidence.

    A PDF is PDF/A-3b, and takes a minute.  A report that is written ends with 0, whatever it says; --strict judges it.

    Examples:
    * `heisoku report -o out/report.html`
    """
    from jinja2 import UndefinedError

    from evidence.case import CaseError
    from evidence.report.gathering import gathered
    from evidence.report.logic import Unread
    from evidence.report.writing import page_of

    for target in output:
        _check(target)
    if not records.is_dir():
        refuse(f"--records {records}: is no folder; make assure makes it")
    try:
        book = gathered(records)
    except CaseError as error:
        refuse(f"SAFETY_CASE.md: {error}")
    try:
        page = page_of(book)
    except Unread as error:
        refuse(f"the report cannot say an invariant as logic: {error}")
    except (UndefinedError, KeyError, TypeError, ValueError) as error:
        refuse(f"{records}: a record does not have the form of such a record ({error}); make it anew")
    for target in output:
        _write(target, page)
    counts = ", ".join(f"{count} {verdict}" for verdict, count in book.counted.items())
    told = f"{len(book.shown)} pieces of evidence: {counts}; {len(book.case.limits)} open points"
    tell(f"{', '.join(map(str, output))}: {told}")
    raise typer.Exit(judged(book.counted) if strict else HOLDS)


def _check(target: Path) -> None:
    """Refuse what cannot be written, before anything is gathered."""
    if target.suffix not in (".html", ".pdf"):
        refuse(f"{target}: is neither a page nor a PDF; name it report.html or report.pdf")
    writable(target)


def _write(target: Path, page: str) -> None:
    """Write the page, or print it."""
    from evidence.report.printing import CannotPrint, printed

    if target.suffix == ".html":
        write_whole(target, page.encode())
        return
    try:
        with console(sys.stderr).status(f"printing {target}"):
            write_whole(target, printed(page))
    except CannotPrint as error:
        refuse(f"{target}: {error}; or write the report as .html")


def judged(counted: Mapping[Came, int]) -> int:
    """The exit code of a report that is judged: by the worst of its evidence."""
    if counted["does not hold"]:
        return DOES_NOT_HOLD
    return UNDECIDED if counted["not shown"] else HOLDS
