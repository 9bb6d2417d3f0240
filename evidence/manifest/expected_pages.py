"""The report and the papers' tables made anew from the records, and the proofs that were kept held against theirs.

Pictures and the report as PDF are compared with nothing, and told so, as is whatever else stands in the folder.
"""

from __future__ import annotations

import gzip
import hashlib
import re
from collections.abc import Iterator
from dataclasses import replace
from functools import partial
from itertools import groupby
from pathlib import Path, PurePosixPath

from jinja2 import TemplateError

from evidence.case import CaseError
from evidence.manifest import making
from evidence.manifest.comparing import JUNIT, OBLIGATIONS
from evidence.manifest.expected import NAMES
from evidence.manifest.finding import Finding
from evidence.manifest.forms import FORM, formed
from evidence.manifest.hashes import Manifest, files, sources
from evidence.records.reading import Records
from evidence.records.strict import content_of
from evidence.report.gathering import gathered
from evidence.report.logic import Unread
from evidence.report.writing import page_of
from models.days.systems import NAMES as SYSTEMS
from models.reproduce import PAPERS
from models.reproduce.tables import Row, Sensitivity, table_as_text
from proofs.records import commit

CERTIFIED = "certificates.json"
PAGE = ".html"
CALLED = re.compile(r"<code>heisoku verify ([\w.-]+)</code>")
"""What a report calls the folder it was made of."""
PROOF = re.compile(r"(?P<column>.+)\.(?P<number>\d+)\.cpc\.gz")
TOLD_BY_NAME = 6
"""So many files of a folder that nothing is compared with are named."""


def written(folder: Path, records: Records, known: Manifest) -> Iterator[Finding]:
    """Make each page, table and hash of a proof anew, and compare it with what stands there."""
    there = files(folder)
    pages = [name for name in there if _is_page(name)]
    if pages and (known.commit, known.sources) == (commit(), sources()):
        yield from _reports(folder, pages)
    for paper in PAPERS:
        if (name := tables_of(paper)) in there:
            yield from formed(name, partial(_tables, folder, records, paper, name))
    proofs = [name for name in there if PROOF.fullmatch(PurePosixPath(name).name)]
    if proofs:
        yield from formed(CERTIFIED, partial(_proofs, folder, records, proofs))


def _is_page(name: str) -> bool:
    return name.endswith(PAGE) and "/" not in name


def tables_of(paper: str) -> str:
    """Where the tables of a paper stand."""
    return f"{paper}/{paper}_tables.txt"


def _reports(folder: Path, pages: list[str]) -> Iterator[Finding]:
    """Each page is the report of these records; one of another commit is named as that already."""
    for name in pages:
        there = content_of(folder / name)
        called = CALLED.search(there.decode("utf-8", "replace"))
        try:
            now = page_of(gathered(folder, called[1] if called else "")).encode()
        except (*FORM, TemplateError, CaseError, Unread) as error:
            yield Finding("other report", name, f"cannot be made of these records: {error}")
            continue
        if now != there:
            pairs = zip(now.splitlines(), there.splitlines(), strict=False)
            line = next((number for number, (ours, its) in enumerate(pairs, 1) if ours != its), "the last")
            yield Finding("other report", name, f"is not what is written of these records, from line {line} on")


def _tables(folder: Path, records: Records, paper: str, name: str) -> Iterator[Finding]:
    """The tables beside the pictures say what the record says."""
    told = records[f"{paper}.json"].data
    if not told:
        yield Finding("other tables", name, f"there is no {paper}.json that they are of")
        return
    now = replace(
        making.reproduced(paper, told["seed"], 1),
        rows=tuple(Row(**row) for row in told["rows"]),
        sensitivities=tuple(Sensitivity(**each) for each in told["sensitivities"]),
        parameters=told["parameters"],
        counts=told["counts"],
    )
    if content_of(folder / name) != table_as_text(now).encode():
        yield Finding("other tables", name, f"are not what is written of {paper}.json")


def _proofs(folder: Path, records: Records, there: list[str]) -> Iterator[Finding]:
    """Each proof that was kept has its hash in the record of certificates."""
    obligations = records[CERTIFIED].data.get("obligations", ())
    known = {(each["row"], each["column"]): each["proofs"] for each in obligations}
    for name in there:
        place = PurePosixPath(name)
        named = PROOF.fullmatch(place.name)
        assert named
        hashes, number = known.get((place.parent.name, named["column"]), ()), int(named["number"])
        if not 1 <= number <= len(hashes):
            yield Finding("foreign proof", name, f"{CERTIFIED} tells of none such")
        elif _hash(folder / name) != hashes[number - 1]:
            yield Finding("other proof", name, f"is not the one that {CERTIFIED} tells of")


def _hash(path: Path) -> str:
    try:
        return hashlib.sha256(gzip.decompress(content_of(path))).hexdigest()
    except (OSError, EOFError, ValueError):
        return ""


def beside(folder: Path, records: Records) -> list[str]:
    """What stands in the folder and is compared with nothing but its hash, a line a folder; a record's name first."""
    there = {name for name, kept in records.items() if not kept.problem}
    compared = {*NAMES, JUNIT}
    compared |= {tables_of(paper) for paper in PAPERS if f"{paper}.json" in there}
    compared |= {f"{system}.days" for system in SYSTEMS if f"days-{system}.json" in there}
    left = [name for name in files(folder) if name not in compared and not _is_compared(name)]
    said = []
    for room, group in groupby(sorted(left, key=_room), _room):
        names = sorted(group, key=lambda name: (PurePosixPath(name).name not in NAMES, name))
        more = f" and {len(names) - TOLD_BY_NAME:,} more" if len(names) > TOLD_BY_NAME else ""
        said.append(f"{room}compared with nothing: {', '.join(names[:TOLD_BY_NAME])}{more}")
    return said


def _is_compared(name: str) -> bool:
    place = PurePosixPath(name)
    return _is_page(name) or place.parts[0] == OBLIGATIONS or bool(PROOF.fullmatch(place.name))


def _room(name: str) -> str:
    return f"{PurePosixPath(name).parts[0]}/: " if "/" in name else ""
