"""The report: what is not shown stands first, every figure has its evidence, every link leads somewhere."""

from __future__ import annotations

import base64
import json
import re
import shutil
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
import typer
from lxml import html

from evidence.case import read_case
from evidence.catalogue import catalogue
from evidence.report import gathering
from evidence.report.command import report
from evidence.report.gathering import Book, gathered
from evidence.report.writing import SECTIONS, page_of
from tests.evidence.samples import COMMIT, change, write
from tests.fuzz.failures.browser import CHROMIUM, Browser, browser

needs_chromium = pytest.mark.skipif(CHROMIUM is None, reason="there is no Chromium: apt-get install chromium")
DIGIT = re.compile(r"\d")
UNPROVED = 69
"""At least so many proofs of the case are of theories that the sample says nothing of."""


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return write(tmp_path_factory.mktemp("made") / "out")


@pytest.fixture(scope="module", autouse=True)
def of_one_commit() -> Iterator[None]:
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(gathering, "commit", lambda: COMMIT)
        patch.setattr(gathering, "sources", lambda: "s" * 64)
        yield


@pytest.fixture(scope="module")
def book(folder: Path) -> Book:
    return gathered(folder)


@pytest.fixture(scope="module")
def text(book: Book) -> str:
    return page_of(book)


@pytest.fixture(scope="module")
def page(text: str) -> Any:
    return html.fromstring(text)


def words(node: Any) -> str:
    return " ".join(node.text_content().split())


def test_it_loads_nothing_and_every_link_in_it_leads_somewhere(page: Any) -> None:
    ids = [each.get("id") for each in page.iter() if each.get("id")]
    assert len(ids) == len(set(ids))
    hrefs = [each.get("href") for each in page.iter() if each.get("href")]
    assert len(hrefs) > 500
    assert [href for href in hrefs if not href.startswith("#") and href != "data:,"] == []
    assert sorted({href[1:] for href in hrefs if href.startswith("#")} - set(ids)) == []
    assert [each for each in page.iter() if each.get("src")] == []
    assert [each.tag for each in page.iter("script", "link") if each.get("href") != "data:,"] == []


def test_what_is_not_shown_stands_before_everything_else(page: Any) -> None:
    headings = [each.get("id") for each in page.iter("h2")]
    assert headings == [anchor for anchor, _ in SECTIONS]
    lacking = [each for each in page.iter("div") if each.get("class", "").startswith("lacking")]
    told = " ".join(map(words, lacking))
    assert "prove.json" in told
    shown = catalogue().keys()
    bad = [
        name for name in shown if name.startswith("prove:") and not name.startswith(("prove:braking", "prove:split"))
    ]
    assert len(bad) >= UNPROVED
    assert [name for name in bad if name not in told] == []
    assert "prove:braking.head_stays_inside_authority" not in told


def test_everything_that_the_case_says_has_its_place(page: Any) -> None:
    case = read_case()
    ids = {each.get("id") for each in page.iter()}
    for numbered in (case.claims, case.hazards, case.limits):
        assert {each.number for each in numbered} <= ids
    assert {f"ev-{name}" for name in catalogue()} <= ids
    assert {label for claim in case.claims for label in claim.requirements} <= ids
    assumed = {f"as-{name}" for duty in case.duties for name in duty.assumptions}
    assert len(assumed) > 100
    assert assumed <= ids


def test_every_figure_has_its_evidence(page: Any) -> None:
    ids = {each.get("id") for each in page.iter()}
    told = {each.get("data-evidence") for each in page.iter() if each.get("data-evidence")}
    assert len(told) > 20
    assert {name for name in told if name != "evidence" and f"ev-{name}" not in ids} == set()
    assert all(each.get("data-evidence") for each in page.iter("data"))
    bare = [text for node in page.find("body/main").iter() for text in own_text(node) if DIGIT.search(text)]
    assert bare == []
    assert sum(each.get("data-evidence") == "evidence" for each in page.iter()) < len(told)


def own_text(node: Any) -> list[str]:
    """What stands in a node itself and belongs to no evidence: no words, names, code or heading."""
    if not isinstance(node.tag, str) or any(is_accounted_for(each) for each in (node, *node.iterancestors())):
        return []
    return [text for text in (node.text, *(child.tail for child in node)) if text]


def is_accounted_for(node: Any) -> bool:
    """A figure with its evidence, or what people said: sentences of case and sources, ids, code, headings."""
    classes = set(node.get("class", "").split())
    named = node.tag in {"a", "code", "pre", "time", "th", "h3", "h4", "title"}
    return bool(node.get("data-evidence") or classes & {"said", "ev", "id"} or named)


def test_a_requirement_is_traced_to_lines_proofs_and_witnesses(page: Any) -> None:
    told = words(page.get_element_by_id("P5"))
    assert "kernel/onboard/split.py:" in told
    assert "split.split_is_latched holds" in told
    assert "3.4, 4.3.3; ours" in told
    assert re.search(r"\d+ of \d+ proved by both solvers", told)
    proof = page.get_element_by_id("inv-split.split_is_latched")
    python, logic = proof.iter("pre")
    assert "def split_is_latched(" in words(python)
    assert words(logic) == "found → demands_emergency_brake(state) ∧ ¬is_intact(limits, state)"
    assert {each.get("href") for each in logic.iter("a")} == {
        "#word-kernel.onboard.split.demands_emergency_brake",
        "#word-kernel.onboard.split.is_intact",
    }
    assert "5 of 5 obligations by both solvers at 1 seed" in words(proof)


def test_tools_and_standards_name_evidence_that_there_is(book: Book, text: str) -> None:
    assert {each["class"] for each in book.tools} == {"T1", "T2", "T3", "platform"}
    assert {name for each in book.tools for name in each["evidence"]} <= catalogue().keys()
    assert all(each["hides"] and each["detects"] for each in book.tools)
    asked = [row["part"] for each in book.standards for row in each["row"]]
    assert len(asked) > 25
    for practice in ("進路鎖錠", "接近鎖錠", "保留鎖錠", "てっ査鎖錠"):
        assert any(practice in part for part in asked)
    assert "no such evidence" not in text


def test_a_goal_is_no_better_than_the_worst_below_it(book: Book, page: Any) -> None:
    assert book.came["C11"] == "holds"
    assert book.came["C2"] == "not shown"
    assert book.came["C1"] == "not shown"
    drawn = book.drawing
    assert [each.link for each in drawn.goals] == [f"#{each.number}" for each in book.case.claims]
    assert len(drawn.defeaters) == sum(bool(each.defeaters.strip("– ")) for each in book.case.claims)
    named = ", ".join(each.names for each in drawn.circles).split(", ")
    assert sorted(named) == sorted(name for each in book.case.claims for name in each.evidence)


def test_two_runs_are_the_same_but_for_times(folder: Path, text: str, tmp_path: Path) -> None:
    assert page_of(gathered(folder)) == text
    again = tmp_path / "out"
    shutil.copytree(folder, again)
    record = json.loads((again / "prove.json").read_text("utf-8"))
    for each in record["obligations"]:
        each["seconds"] *= 2
    change(again / "prove.json", obligations=record["obligations"], wall_seconds=99.0)
    record["obligations"].reverse()
    change(again / "prove.json", obligations=record["obligations"])
    mutants = json.loads((again / "mutate.json").read_text("utf-8"))["mutants"]
    change(again / "mutate.json", seconds=99.0, mutants=[{**each, "seconds": 9.9} for each in reversed(mutants)])
    other = page_of(gathered(again))
    assert other != text
    without = re.compile(r"<time>.*?</time>")
    assert without.sub("", other) == without.sub("", text)


@pytest.mark.parametrize("content", [None, b"{}", b"[]", b"{"])
def test_a_record_that_is_missing_or_damaged_is_named_and_the_rest_shown(
    content: bytes | None, folder: Path, tmp_path: Path
) -> None:
    names = sorted({each.record for each in catalogue().values()})
    for name in names:
        here = tmp_path / name
        shutil.copytree(folder, here)
        if content is None:
            (here / name).unlink()
        else:
            (here / name).write_bytes(content)
        assert name in gathered(here).lacking
    page = html.fromstring(page_of(gathered(tmp_path / names[-1])))
    told = " ".join(words(each) for each in page.iter("div") if "lacking" in each.get("class", ""))
    assert f"not shown : {names[-1]}" in told or f"not shown: {names[-1]}" in told


def test_a_folder_without_records_shows_nothing_and_says_what_is_missing(tmp_path: Path) -> None:
    book = gathered(tmp_path)
    page = page_of(book)
    assert {each.verdict for each in book.shown.values()} == {"not shown"}
    assert all(each.record in page for each in catalogue().values())


# ---- the command


def run(*arguments: str) -> int:
    app = typer.Typer()
    app.command()(report)
    app.command("idle")(lambda: None)
    return int(app(["report", *arguments], standalone_mode=False) or 0)


def test_the_command_tells_the_worst_and_ends_with_its_code_where_it_is_strict(
    folder: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    target = tmp_path / "new" / "report.html"
    assert run("-o", str(target), "--records", str(folder), "--strict") == 3
    assert "pieces of evidence: 0 does not hold" in capsys.readouterr().out
    assert f'<meta name="heisoku-commit" content="{COMMIT}">' in target.read_text("utf-8")
    worse = tmp_path / "out"
    shutil.copytree(folder, worse)
    change(worse / "days-tram.json", violated=1)
    assert run("-o", str(target), "--records", str(worse), "--strict") == 1
    assert run("-o", str(target), "--records", str(worse)) == 0
    assert "1 does not hold" in capsys.readouterr().out


@pytest.mark.parametrize(
    "given", [("-o", "report.txt"), ("-o", "report.html", "--records", "nowhere"), ("-o", "/dev/null/report.html")]
)
def test_bad_usage_is_one_line_and_code_2(
    given: tuple[str, ...], tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "out").mkdir()
    assert run(*given) == 2
    assert len(capsys.readouterr().err.splitlines()) == 1
    assert list(tmp_path.iterdir()) == [tmp_path / "out"]


# ---- in a browser


@pytest.fixture(scope="module")
def tab() -> Iterator[Browser]:
    with browser() as opened:
        yield opened


@pytest.fixture(scope="module")
def written(text: str, tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("page") / "report.html"
    path.write_text(text, "utf-8")
    return path


@needs_chromium
@pytest.mark.parametrize("width", [1420, 390])
def test_it_is_read_on_a_screen_without_a_complaint(width: int, tab: Browser, written: Path) -> None:
    tab.size(width, 900)
    tab.open(written)
    assert tab.complaints == []
    assert tab.asked == [written.resolve().as_uri()]
    assert tab.value("document.documentElement.scrollWidth") <= width
    assert tab.value("document.querySelector('h2').id") == "not-shown"


@needs_chromium
def test_what_is_drawn_fits_its_boxes(tab: Browser, written: Path) -> None:
    tab.size(1420, 900)
    tab.open(written)
    out = tab.value(
        "[...document.querySelectorAll('svg.goals g.goal, svg.goals g.defeater')].filter((g) => {"
        " const r = g.querySelector('rect').getBBox();"
        " return [...g.querySelectorAll('text')].some((t) => { const b = t.getBBox();"
        " return b.x < r.x || b.x + b.width > r.x + r.width || b.y < r.y || b.y + b.height > r.y + r.height; });"
        "}).map((g) => g.textContent)"
    )
    assert out == []
    assert tab.value("document.querySelectorAll('svg.goals g.goal').length") == len(read_case().claims)


@needs_chromium
def test_on_paper_everything_is_unfolded(tab: Browser, written: Path) -> None:
    tab.size(1000, 900)
    tab.open(written)
    hidden = "[...document.querySelectorAll('details pre')].filter((each) => !each.checkVisibility()).length"
    assert tab.value(hidden) > 100
    tab.call("Emulation.setEmulatedMedia", media="print")
    assert tab.value(hidden) == 0
    assert tab.value("getComputedStyle(document.querySelector('nav')).display") == "none"
    tab.call("Emulation.setEmulatedMedia", media="")


@needs_chromium
def test_it_prints(tab: Browser, written: Path) -> None:
    tab.open(written)
    content = base64.b64decode(tab.call("Page.printToPDF")["data"])
    assert content.startswith(b"%PDF-")
    assert len(re.findall(rb"/Type\s*/Page\b", content)) > 50
