"""The control table, the conflict matrix and the plan of tags on one page, to be read and printed."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from itertools import groupby
from pathlib import Path

from kernel.names import Route
from models.layouts.checker import rest_line
from models.layouts.export.control_table import Row
from models.layouts.export.tag_plan import PlannedTag
from models.layouts.results import CheckResult, Imported
from models.whole_page import template_of

MOST_IN_THE_MATRIX = 120
"""Routes whose matrix is still read at a glance; of more the control table names the conflicts."""
MOST_TAGS = 2_000


def page_of(
    imported: Imported,
    result: CheckResult,
    rows: Sequence[Row],
    pairs: Iterable[tuple[Route, Route, str]],
    plan: Sequence[PlannedTag],
) -> str:
    """The page as HTML; everything is in it, and nothing is loaded."""
    number = {row.route: at for at, row in enumerate(rows, 1)}
    signs = {
        pair: sign
        for one, other, sign in pairs
        for pair in ((number[one], number[other]), (number[other], number[one]))
    }
    layout, told, file = imported.layout, imported.told, Path(imported.name).name
    return template_of("models.layouts.export").render(
        title=(told.title if told is not None else None) or file,
        file=file,
        kind=imported.kind,
        holds=result.exit_code == 0,
        violations=result.violations,
        rests=[(rest.declared, rest_line(rest)) for rest in result.rests],
        counts={
            "routes": len(rows),
            "blocks": len(layout.blocks),
            "points": len(layout.points),
            "tags": len(layout.tag_in),
            "conflicts": len(signs) // 2,
        },
        rows=[(number[row.route], row, list(ranges(number[each] for each in row.conflicts))) for row in rows],
        matrix=signs if len(rows) <= MOST_IN_THE_MATRIX else None,
        tags=plan if len(plan) <= MOST_TAGS else [],
    )


def ranges(numbers: Iterable[int]) -> Iterator[str]:
    """Numbers in order, three and more in a row as one range."""
    for _, group in groupby(enumerate(sorted(numbers)), key=lambda each: each[1] - each[0]):
        run = [number for _, number in group]
        yield from [f"{run[0]}–{run[-1]}"] if len(run) > 2 else map(str, run)
