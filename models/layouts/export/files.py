"""Everything that an export writes, file by file."""

from __future__ import annotations

import csv
import json
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, fields, replace
from io import StringIO

from models.layouts.conflict_pairs import Conflicts
from models.layouts.export.control_table import Lies, Row, control_table
from models.layouts.export.page import page_of
from models.layouts.export.tag_plan import PlannedTag, as_bytes, tag_plan
from models.layouts.export.to_native import native_data
from models.layouts.export.to_railjson import left_out, railjson_data
from models.layouts.export.unsayable import Unsayable
from models.layouts.generate import as_toml
from models.layouts.loading import load_text
from models.layouts.results import CheckResult, Imported

MOST_IN_A_MATRIX = 500
"""Routes in a matrix of all with all; more are told as pairs only."""
MOST_ON_A_PAGE = 2_000
"""Routes, or tags, on a page that a browser still shows at once."""
NAMES = (
    *("layout.toml", "layout.json", "tag_plan.csv", "tag_records.bin", "route_table.csv", "control_table.csv"),
    *("conflicts.csv", "conflict_matrix.csv", "control_table.html"),
)


@dataclass(frozen=True)
class Written:
    """One file: its name, what is in it, and what is worth telling; no content where it cannot be written."""

    name: str
    content: bytes | None
    says: str


class ReadOtherwise(Exception):
    """A layout that was written is read as another one: a fault of this program."""


def written(imported: Imported, result: CheckResult) -> Iterator[Written]:
    """Every file of an export, one after the other.

    Raises:
        ReadOtherwise: a layout that was written back is read as another one.
    """
    conflicts = Conflicts(imported.layout)
    rows = list(control_table(imported, conflicts))
    yield _layout(imported, "layout.toml", lambda: as_toml(native_data(imported)))
    yield _layout(imported, "layout.json", lambda: json.dumps(railjson_data(imported), ensure_ascii=False, indent=1))
    try:
        plan: list[PlannedTag] = tag_plan(imported)
    except Unsayable as unsayable:
        plan = []
        yield Written("tag_plan.csv", None, str(unsayable))
        yield Written("tag_records.bin", None, str(unsayable))
    else:
        yield Written("tag_plan.csv", _csv(TAG_COLUMNS, map(_tag_cells, plan)), f"{len(plan):,} tags")
        yield Written("tag_records.bin", as_bytes(plan), f"{len(plan):,} records of 16 bytes")
    yield Written("route_table.csv", _csv(ROUTE_COLUMNS, map(_route_cells, rows)), f"{len(rows):,} routes")
    yield Written("control_table.csv", _csv(CONTROL_COLUMNS, map(_control_cells, rows)), f"{len(rows):,} routes")
    pairs = [(one, other, conflicts.why(one, other)) for one, other in conflicts.pairs()]
    cells = ([one, other, why.signs, why.words] for one, other, why in pairs)
    yield Written("conflicts.csv", _csv(("route", "other", "by", "what"), cells), f"{len(pairs):,} conflicts")
    if len(rows) <= MOST_IN_A_MATRIX:
        signs = {pair: why.signs for one, other, why in pairs for pair in ((one, other), (other, one))}
        names = [row.route for row in rows]
        lines = ([one, *(signs.get((one, other), "") for other in names)] for one in names)
        yield Written("conflict_matrix.csv", _csv(("", *names), lines), f"{len(rows)} × {len(rows)} routes")
    else:
        yield Written("conflict_matrix.csv", None, f"{len(rows):,} routes are too many for a matrix: see conflicts.csv")
    if len(rows) <= MOST_ON_A_PAGE:
        page = page_of(imported, result, rows, [(one, other, why.signs) for one, other, why in pairs], plan)
        yield Written("control_table.html", page.encode(), "control table, conflict matrix and tag plan")
    else:
        yield Written("control_table.html", None, f"{len(rows):,} routes are too many for a page: see the tables")


def _layout(imported: Imported, name: str, text_of: Callable[[], str]) -> Written:
    """A layout written back, and read again before it is given."""
    try:
        text = text_of()
    except Unsayable as unsayable:
        return Written(name, None, str(unsayable))
    again = load_text(imported.name, text)
    other = _otherwise(imported, again)
    if other:
        raise ReadOtherwise(f"{name}: is read as another layout than {imported.name} ({', '.join(other)})")
    said = "read back the same"
    if again.kind != imported.kind:
        said = "read back with the same routes, blocks and points, in the words of another format"
    unread = sum(len(remark.elements) for remark in imported.remarks if remark.rests == "unread")
    if unread:
        said += f", but for {unread:,} elements that are not read"
    missing = list(left_out(imported)) if again.kind == "RailJSON" else []
    return Written(name, text.encode(), said + (f"; it has no words for {', '.join(missing)}" if missing else ""))


def _otherwise(imported: Imported, again: Imported) -> list[str]:
    """In what a layout differs from the one that was written; between formats, of what is not a format's word."""
    if imported.kind == again.kind:
        one, other = _as_read(imported), _as_read(again)
        told = [field.name for field in fields(one) if field.compare]
        return [name for name in told if getattr(one, name) != getattr(other, name)]
    ours, theirs = imported.layout, again.layout
    same = {
        "routes": ours.routes == theirs.routes,
        "points": ours.points == theirs.points,
        "blocks": len(ours.blocks) == len(theirs.blocks),
        "tags": len(ours.tag_in) == len(theirs.tag_in),
        "ways": {route: len(way) - len(ours.overlap[route]) for route, way in ours.way.items()}
        == {route: len(way) - len(theirs.overlap[route]) for route, way in theirs.way.items()},
    }
    return [what for what, is_same in same.items() if not is_same]


def _as_read(imported: Imported) -> Imported:
    """A layout without remarks on what was not read: that is not written back."""
    return replace(imported, remarks=tuple(remark for remark in imported.remarks if remark.rests != "unread"))


# ---- tables

TAG_COLUMNS = (
    *("tag", "uid", "boundary", "track", "boundary_at_mm", "block", "block_number", "kind_code", "kind"),
    *("distance_mm", "crc", "page_0", "page_1"),
)
ROUTE_COLUMNS = ("route", "entry", "exit", "start", "blocks", "overlap", "points", "tags_in_order")
CONTROL_COLUMNS = (
    *("route", "entry", "exit", "start", "blocks", "points", "traps", "spare", "flank", "overlap", "by_authority"),
    *("conflicting_routes", "released"),
)


def _csv(columns: Sequence[str], rows: Iterable[Sequence[object]]) -> bytes:
    text = StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(columns)
    writer.writerows(rows)
    return text.getvalue().encode()


def _tag_cells(tag: PlannedTag) -> list[object]:
    at_mm: object = tag.at_mm if tag.track is not None else ""
    record, pages = tag.record, tag.pages
    lies = [tag.tag, f"{record.uid:016x}", tag.boundary, tag.track or "", at_mm, tag.block, record.block]
    return [
        *lies,
        *(record.kind, tag.kind, record.distance_mm, f"{tag.crc:04x}", f"{pages.first:08x}", f"{pages.second:08x}"),
    ]


def _route_cells(row: Row) -> list[object]:
    lists = [row.covers, row.overlap, _lying(row.points + row.traps + row.spare), row.tags]
    return [row.route, row.entry, row.exit, row.start, *("; ".join(each) for each in lists)]


def _lying(points: Iterable[Lies]) -> list[str]:
    return [f"{point} {position}" for point, position in points]


def _control_cells(row: Row) -> list[object]:
    flank = [f"{point} {position} (shields {block})" for (point, position), block in row.flank]
    released = [" + ".join(blocks) for blocks in row.released]
    inside = [_lying(row.points), _lying(row.traps), _lying(row.spare)]
    authority = [f"{block} out of {target}" for block, target in row.authority]
    lists = [row.covers, *inside, flank, row.overlap, authority, row.conflicts, released]
    return [row.route, row.entry, row.exit, row.start, *("; ".join(each) for each in lists)]
