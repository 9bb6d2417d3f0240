"""A folder of records is bound to its commit, byte for byte; whatever is not as it was is named."""

from __future__ import annotations

import gzip
import hashlib
import json
from pathlib import Path

import pytest

from evidence.manifest import comparing, hashes
from evidence.manifest.comparing import compared
from evidence.manifest.finding import Finding
from evidence.manifest.hashes import ManifestError, made, read_manifest, sources
from proofs.run import kept
from tests.evidence.samples import COMMIT, change, write

TEXT = b"(check-sat)\n"


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Records with the text of each obligation kept, and a manifest; of a commit that stands still."""
    monkeypatch.setattr(hashes, "commit", lambda: COMMIT)
    monkeypatch.setattr(comparing, "commit", lambda: COMMIT)
    monkeypatch.setattr(hashes, "sources", lambda: "s" * 64)
    monkeypatch.setattr(comparing, "sources", lambda: "s" * 64)
    here = write(tmp_path / "out")
    record = json.loads((here / "prove.json").read_text("utf-8"))
    mine = [each for each in record["obligations"] if each["transition"].startswith("braking.")]
    for each in mine:
        each["smt2_sha256"] = hashlib.sha256(TEXT).hexdigest()
        path = kept(here / "obligations", each["transition"], each["invariant"])
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(gzip.compress(TEXT, mtime=0))
    (here / "prove.json").write_text(json.dumps({**record, "obligations": mine}), "utf-8")
    (here / "lock").mkdir()
    (here / "lock" / "pip").write_text("a tool", "utf-8")
    (here / "mutants.json").write_text("{}", "utf-8")
    (here / "report.html").write_text(f'<meta name="heisoku-commit" content="{COMMIT}">', "utf-8")
    bind(here)
    return here


def bind(here: Path) -> None:
    (here / "manifest.json").write_text(made(here).text(), "utf-8")


def findings(here: Path) -> list[Finding]:
    return list(compared(here, read_manifest(here)))


def kinds(here: Path) -> set[tuple[str, str]]:
    return {(each.kind, each.where) for each in findings(here)}


def test_nothing_is_found_where_nothing_changed(folder: Path) -> None:
    assert findings(folder) == []
    (folder / "mutants.json").write_text("{}\n", "utf-8")
    assert findings(folder) == [], "what mutate keeps between its runs is no record"


def test_any_changed_byte_is_named(folder: Path) -> None:
    for name in ("check.json", "ride.json", "test.xml", "report.html"):
        content = (folder / name).read_bytes()
        for place in (0, len(content) // 2, len(content) - 1):
            changed = bytes([content[place] ^ 1])
            (folder / name).write_bytes(content[:place] + changed + content[place + 1 :])
            assert ("changed", name) in kinds(folder)
        (folder / name).write_bytes(content)
    assert findings(folder) == []


def test_a_missing_and_a_foreign_record_are_named(folder: Path) -> None:
    (folder / "ride.json").rename(folder / "ride-2.json")
    assert kinds(folder) == {("missing", "ride.json"), ("foreign", "ride-2.json")}


def test_an_obligation_without_its_text_is_named_though_the_manifest_was_made_anew(folder: Path) -> None:
    text = kept(folder / "obligations", "braking.run_a_cycle", "head_stays_inside_authority")
    where = text.relative_to(folder).as_posix()
    content = text.read_bytes()
    text.unlink()
    assert kinds(folder) == {("missing", where), ("missing obligation", where)}
    bind(folder)
    assert kinds(folder) == {("missing obligation", where)}
    text.write_bytes(gzip.compress(TEXT + b"\n", mtime=0))
    bind(folder)
    assert kinds(folder) == {("changed obligation", where)}
    text.write_bytes(content[:-3])
    bind(folder)
    assert kinds(folder) == {("changed obligation", where)}
    text.write_bytes(content)
    other = text.with_name("another.smt2.gz")
    other.write_bytes(content)
    bind(folder)
    assert kinds(folder) == {("foreign obligation", other.relative_to(folder).as_posix())}


def test_a_record_and_a_report_of_another_commit_are_named(folder: Path) -> None:
    change(folder / "ride.json", commit="f" * 40)
    (folder / "report.html").write_text('<meta name="heisoku-commit" content="ffff">', "utf-8")
    bind(folder)
    assert kinds(folder) == {("other commit", "ride.json"), ("other commit", "report.html")}
    (folder / "report.html").write_text("<p>of nobody</p>", "utf-8")
    bind(folder)
    assert ("unreadable", "report.html") in kinds(folder)


def test_records_of_other_sources_are_named(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(comparing, "commit", lambda: "f" * 40)
    monkeypatch.setattr(comparing, "sources", lambda: "t" * 64)
    assert kinds(folder) == {("other commit", "manifest.json"), ("other sources", "manifest.json")}


def test_the_hash_of_sources_follows_names_and_content(tmp_path: Path) -> None:
    (tmp_path / "a.py").write_text("x", "utf-8")
    (tmp_path / "out").mkdir()
    first = sources(tmp_path)
    (tmp_path / "out" / "b.py").write_text("made", "utf-8")
    assert sources(tmp_path) == first
    (tmp_path / "a.py").write_text("y", "utf-8")
    second = sources(tmp_path)
    (tmp_path / "a.py").rename(tmp_path / "b.py")
    assert len({first, second, sources(tmp_path)}) == 3


@pytest.mark.parametrize("content", [None, "", "{}", "[]", '{"format": "another"}', '{"format": "heisoku manifest 1"}'])
def test_what_is_no_manifest_is_refused_in_one_line(content: str | None, tmp_path: Path) -> None:
    if content is not None:
        (tmp_path / "manifest.json").write_text(content, "utf-8")
    with pytest.raises(ManifestError) as refused:
        read_manifest(tmp_path)
    assert "manifest.json" in str(refused.value)
    assert len(str(refused.value).splitlines()) == 1
