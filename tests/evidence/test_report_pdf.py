"""The report as PDF/A: it says what it is, has its fonts within it, and says what it cannot write."""

from __future__ import annotations

import re
import zlib
from importlib import import_module
from pathlib import Path
from typing import Any

import pytest
import typer

from evidence.report import command, printing
from evidence.report.printing import NOTE, PLACE, CannotPrint, by_code_points, printed

PAGE = f"""<!DOCTYPE html><html lang="en"><head><title>evidence</title><style>
h2 {{ break-before: page }} @page {{ size: A4 }}</style></head><body><h1>Evidence</h1>{PLACE}
<p>∀ car ∈ track.at: ¬moves</p>
<h2 id="glossary">Glossary</h2><table><tr><td lang="ja">閉そく</td><td>block</td></tr></table></body></html>"""


def printer() -> bool:
    try:
        import_module("weasyprint")
    except (ImportError, OSError):
        return False
    return True


needs_printer = pytest.mark.skipif(not printer(), reason="WeasyPrint needs Pango: apt-get install libpango-1.0-0")


@pytest.fixture(scope="module")
def document() -> bytes:
    return printed(PAGE, japanese=False)


def streams(document: bytes) -> list[bytes]:
    """Everything that is compressed in it, unpacked."""
    found = []
    for start in re.finditer(rb"stream\r?\n", document):
        try:
            found.append(zlib.decompressobj().decompress(document[start.end() :]))
        except zlib.error:
            continue
    return found


@needs_printer
def test_it_says_that_it_is_of_the_profile(document: bytes) -> None:
    assert document.startswith(b"%PDF-1.7")
    (told,) = (each for each in streams(document) if b"pdfaid" in each)
    assert b'pdfaid:part="3"' in told
    assert b'pdfaid:conformance="B"' in told
    assert b'<rdf:li xml:lang="x-default">evidence</rdf:li>' in told


@needs_printer
def test_it_has_pages_with_text_and_every_font_within_it(document: bytes) -> None:
    whole = b"\n".join([document, *streams(document)])
    assert len(re.findall(rb"/Type\s*/Page\b", whole)) == 2
    fonts = re.findall(rb"/Type\s*/FontDescriptor", whole)
    assert fonts
    assert len(re.findall(rb"/FontFile[23]?\b", whole)) == len(fonts)
    assert whole.count(b"/ToUnicode") >= 1
    assert b"/OutputIntents" in whole
    assert re.search(rb"\bBT\b.*\b(Tj|TJ)\b", whole, re.DOTALL)


@needs_printer
def test_the_same_page_gives_the_same_bytes(document: bytes) -> None:
    assert printed(PAGE, japanese=False) == document
    assert printed(PAGE.replace("block", "train"), japanese=False) != document


@needs_printer
def test_nothing_is_loaded(tmp_path: Path, caplog: pytest.LogCaptureFixture) -> None:
    picture = tmp_path / "picture.svg"
    picture.write_text('<svg xmlns="http://www.w3.org/2000/svg"><text>secret</text></svg>', "utf-8")
    printed(PAGE.replace("<h1>", f'<img src="{picture.as_uri()}"><h1>'), japanese=False)
    assert f"Failed to load image at '{picture.as_uri()}'" in caplog.text


def test_without_a_font_japanese_stands_as_code_points_and_the_page_says_so() -> None:
    page = by_code_points(PAGE)
    assert "⟨9589 305D 304F⟩" in page
    assert "閉" not in page
    assert NOTE in page
    assert "∀ car ∈ track.at" in page


def test_every_page_has_the_place_for_that_note() -> None:
    assert PLACE in (Path(printing.__file__).with_name("page.html.jinja")).read_text("utf-8")


def test_a_font_counts_only_if_it_has_the_characters(monkeypatch: pytest.MonkeyPatch) -> None:
    from matplotlib import font_manager

    own = str(Path(font_manager.__file__).with_name("mpl-data") / "fonts" / "ttf" / "DejaVuSans.ttf")
    monkeypatch.setattr(font_manager, "findSystemFonts", lambda: [own, __file__])
    assert not printing.has_japanese.__wrapped__()
    monkeypatch.setattr(printing, "NEEDED", "abc")
    assert printing.has_japanese.__wrapped__()


@pytest.mark.parametrize("error", [ImportError("no weasyprint"), OSError("cannot load library 'libpango-1.0-0'")])
def test_where_it_cannot_print_one_line_says_why(
    error: Exception, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    def missing(name: str) -> Any:
        raise error

    monkeypatch.setattr(printing, "import_module", missing)
    with pytest.raises(CannotPrint, match=re.escape(str(error))):
        printed(PAGE, japanese=True)
    with pytest.raises(typer.Exit) as ended:
        command._write(tmp_path / "report.pdf", PAGE)
    assert ended.value.exit_code == 2
    assert len(capsys.readouterr().err.splitlines()) == 1
    assert list(tmp_path.iterdir()) == []
