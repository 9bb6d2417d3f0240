"""A report and a campaign are held against what they are made of, and are whole only as the Makefile makes them."""

from __future__ import annotations

import re
import shutil
from pathlib import Path

import pytest

from evidence.manifest import expected_pages
from evidence.manifest.expected import NAMES, lacking
from evidence.manifest.expected_campaign import BATCHES, WHOLE, fuzzed
from evidence.manifest.expected_runs import reproduced
from evidence.manifest.finding import Finding
from evidence.manifest.hashes import made
from evidence.records.reading import Kept, read
from evidence.report.gathering import gathered
from evidence.report.writing import page_of
from tests.evidence import genuine
from tests.evidence.samples import write

MAKEFILE = Path(__file__).resolve().parent.parent.parent / "Makefile"


def found(folder: Path) -> list[Finding]:
    return list(expected_pages.written(folder, read(folder, NAMES), made(folder)))


@pytest.mark.slow
def test_a_report_is_what_is_written_of_its_records_wherever_they_stand(tmp_path: Path) -> None:
    folder = write(tmp_path / "out")
    (folder / "report.html").write_text(page_of(gathered(folder)), "utf-8")
    assert found(folder) == []
    moved = tmp_path / "moved"
    shutil.copytree(folder, moved)
    assert found(moved) == []
    text = (moved / "report.html").read_text("utf-8")
    (moved / "report.html").write_text(text.replace("holds", "does hold", 1), "utf-8")
    assert [(each.kind, each.where) for each in found(moved)] == [("other report", "report.html")]


def test_a_report_by_hand_is_named(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    page = "<code>heisoku verify out</code> everything is as it is"
    called = []
    monkeypatch.setattr(expected_pages, "gathered", lambda folder, name: called.append(name))
    monkeypatch.setattr(expected_pages, "page_of", lambda book: page)
    (tmp_path / "report.html").write_text(page, "utf-8")
    assert found(tmp_path) == []
    (tmp_path / "report.html").write_text(page.replace("everything", "all"), "utf-8")
    assert [each.kind for each in found(tmp_path)] == ["other report"]
    assert called == ["out", "out"]


def test_a_whole_campaign_is_what_make_runs() -> None:
    text = MAKEFILE.read_text("utf-8")
    rule = re.search(r"fuzz layouts/\S+ \$\(foreach target,([^,]+),", text)
    least = re.search(r"^BATCHES \?= (\d+)$", text, re.MULTILINE)
    assert rule
    assert least
    assert tuple(rule[1].split()) == WHOLE
    assert int(least[1]) == BATCHES


def test_a_campaign_whose_targets_carry_no_canary_is_told_and_is_no_contradiction() -> None:
    told = genuine.fuzzed()
    told |= {"targets": {"link": told["targets"]["link"]}, "canaries": []}
    assert list(fuzzed(told)) == []
    kept = {"fuzz.json": Kept("fuzz.json", data=told), "prove.json": Kept("prove.json")}
    assert "fuzz.json: no canary was run, since its targets carry none: what it did not find it may not see" in lacking(
        kept
    )


def test_what_is_too_rare_to_be_compared_in_one_run_may_be_compared_in_many() -> None:
    told = genuine.reproduced("000")
    next(row for row in told["rows"] if row["agrees"] is None)["agrees"] = True
    assert [each.kind for each in reproduced("000.json", told)] == ["other row"]
    assert list(reproduced("000.json", {**told, "runs": 400})) == []
