"""What of a folder of records is not as its manifest says, each by its name."""

from __future__ import annotations

import gzip
import hashlib
import re
from collections.abc import Iterator, Mapping
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

from lxml import etree

from evidence.manifest.alike import moment
from evidence.manifest.finding import Finding
from evidence.manifest.forms import formed
from evidence.manifest.hashes import NAME, Manifest, files, hash_of, others, sources
from evidence.records.strict import content_of, parsed, tree
from proofs.junit import junit_xml
from proofs.records import Report, commit, versions
from proofs.run import kept

JUNIT = "prove.xml"
OBLIGATIONS = "obligations"
"""The folder of the texts that were put to the solvers, where they are kept."""
COMMIT_OF_REPORT = re.compile(r'<meta name="heisoku-commit" content="([^"]*)">')


def compared(folder: Path, manifest: Manifest) -> Iterator[Finding]:
    """Compare a folder with its manifest, the manifest with these sources, and the records with each other."""
    yield from _of_these_sources(manifest)
    there = files(folder)
    for name, what in others(folder).items():
        yield Finding("no file", name, f"is {what}, and no regular file: it is not opened")
    for name, digest in manifest.records.items():
        if name not in there:
            yield Finding("missing", name, "stands in the manifest and not in the folder")
        elif hash_of(folder / name) != digest:
            yield Finding("changed", name, "its bytes are not those that the manifest was made of")
    for name in there:
        if name not in manifest.records:
            yield Finding("foreign", name, "stands in the folder and not in the manifest")
    for name in there:
        if name.endswith(".json") and "/" not in name:
            yield from _of_one_commit(folder / name, manifest)
        if name.endswith(".html") and "/" not in name:
            yield from _reported(folder / name, manifest)
    yield from formed("prove.json", lambda: _obligations(folder))
    yield from formed(JUNIT, lambda: _junit(folder))


def _of_these_sources(manifest: Manifest) -> Iterator[Finding]:
    now = commit()
    if manifest.commit != now:
        yield Finding("other commit", NAME, f"is of commit {manifest.commit}, and this is {now}")
    if manifest.sources != sources():
        yield Finding("other sources", NAME, "is of other sources than those that stand here")
    if manifest.versions != versions():
        yield Finding("other versions", NAME, f"was made with {manifest.versions}, and this is {versions()}")
    when = moment(manifest.made_at)
    if manifest.made_at and (when is None or when > datetime.now(UTC)):
        yield Finding("other time", NAME, f"made at {manifest.made_at}, which is no time in UTC, or is to come")


def _of_one_commit(path: Path, manifest: Manifest) -> Iterator[Finding]:
    data = _data(path)
    if data is None:
        yield Finding("unreadable", path.name, "is no JSON object")
    elif "commit" in data and data["commit"] != manifest.commit:
        yield Finding(
            "other commit", path.name, f"is of commit {data['commit']}, and the manifest of {manifest.commit}"
        )


def _reported(path: Path, manifest: Manifest) -> Iterator[Finding]:
    """A report says in its head which commit it is of."""
    told = COMMIT_OF_REPORT.search(path.read_text("utf-8", "replace"))
    if told is None:
        yield Finding("unreadable", path.name, "does not say of which commit it is")
    elif told[1] != (manifest.commit or ""):
        yield _another(path, told[1], manifest)


def _another(path: Path, told: object, manifest: Manifest) -> Finding:
    return Finding("other commit", path.name, f"is of commit {told}, and the manifest of {manifest.commit}")


def _data(path: Path) -> Mapping[str, Any] | None:
    try:
        data = parsed(content_of(path))
    except (OSError, ValueError):
        return None
    return data if isinstance(data, dict) else None


def _obligations(folder: Path) -> Iterator[Finding]:
    """Every obligation of the proof's record has its text, of the hash recorded, and no text is of none."""
    texts = folder / OBLIGATIONS
    proved = _data(folder / "prove.json")
    if proved is None or not texts.is_dir():
        return
    wanted = {kept(texts, each["transition"], each["invariant"]): each["smt2_sha256"] for each in proved["obligations"]}
    for path, digest in wanted.items():
        where = path.relative_to(folder).as_posix()
        if not path.is_file():
            yield Finding("missing obligation", where, "prove.json tells of it, and its text is not there")
        elif _text_hash(path) != digest:
            yield Finding("changed obligation", where, "its text is not the one that prove.json tells of")
    for path in sorted(each for each in texts.rglob("*") if each.is_file() and each not in wanted):
        yield Finding("foreign obligation", path.relative_to(folder).as_posix(), "prove.json tells of none such")


def _junit(folder: Path) -> Iterator[Finding]:
    """The same run as JUnit XML is what would be written of prove.json, but for a time to more digits."""
    proved = _data(folder / "prove.json")
    if proved is None or not (folder / JUNIT).exists():
        return
    report = Report(proved["obligations"], 0.0, 0.0, proved["canaries"], proved["offences"])
    now, there = (_suites(content) for content in (junit_xml(report), content_of(folder / JUNIT)))
    if now != there:
        yield Finding("other cases", JUNIT, "is not what prove.json would be written as")


def _suites(content: bytes) -> bytes:
    """A JUnit document as it is compared: without how long its root took, which prove.json tells to more digits."""
    root = tree(content)
    root.attrib.pop("time", "")
    return etree.tostring(root, method="c14n")


def _text_hash(path: Path) -> str:
    try:
        return hashlib.sha256(gzip.decompress(path.read_bytes())).hexdigest()
    except (OSError, EOFError, ValueError):
        return ""
