"""Prints the report as PDF/A-3b: fonts within it, nothing loaded, readable in decades.

Where the machine has no font with Japanese characters, each run of them stands as its code points, and the report
says so; empty boxes would say nothing.
"""

from __future__ import annotations

import hashlib
import re
from functools import cache
from importlib import import_module
from typing import Any

VARIANT = "pdf/a-3b"
JAPANESE = re.compile(r"[⺀-鿿豈-﫿！-￯]+")
NEEDED = "閉鎖錠のブ"
"""Characters that a font must have to write the glossary."""
PLACE = "<!-- what is printed otherwise -->"
"""Where the page says what the PDF cannot show."""
NOTE = (
    '<p class="lacking">Printed where no font with Japanese characters was found: each Japanese word stands as the code'
    " points of its characters, as in ⟨9589 305D 304F⟩. The page report.html has them in writing; with a font"
    " (on Debian: fonts-noto-cjk or fonts-ipafont) so has this document.</p>"
)


class CannotPrint(RuntimeError):
    """The library, or one that it is built on, is not here; with what to do."""


def printed(page: str, *, japanese: bool | None = None) -> bytes:
    """Print a page as PDF/A-3b; the same page gives the same bytes.

    ``japanese``: whether a font with Japanese characters is there, where the caller knows.

    Raises:
        CannotPrint: WeasyPrint, or Pango below it, cannot be loaded.
    """
    shown = page if (has_japanese() if japanese is None else japanese) else by_code_points(page)
    identifier = hashlib.sha256(shown.encode()).digest()[:16]
    library = _library()
    # The report has everything within it: nothing may be loaded, by any protocol.
    fetcher = library.urls.URLFetcher(allowed_protocols=())
    document = library.HTML(string=shown, base_url=None, url_fetcher=fetcher)
    content: bytes = document.write_pdf(pdf_variant=VARIANT, pdf_identifier=identifier)
    return content


def by_code_points(page: str) -> str:
    """The page with every run of Japanese characters as its code points, and a note that says so."""
    written = JAPANESE.sub(lambda found: f"⟨{' '.join(f'{ord(char):04X}' for char in found[0])}⟩", page)
    return written.replace(PLACE, NOTE, 1)


@cache
def has_japanese() -> bool:
    """Whether this machine has a font with Japanese characters."""
    from matplotlib.font_manager import findSystemFonts
    from matplotlib.ft2font import FT2Font

    for path in sorted(findSystemFonts()):
        try:
            font = FT2Font(path)
        except RuntimeError:
            continue
        if all(font.get_char_index(ord(char)) for char in NEEDED):
            return True
    return False


def _library() -> Any:
    """WeasyPrint; loaded only where it is used, since Pango below it is a library of the system."""
    try:
        return import_module("weasyprint")
    except ImportError as error:
        raise CannotPrint(f"WeasyPrint is not installed ({error}); install what requirements.txt names") from None
    except OSError as error:
        line = str(error).splitlines()[0]
        raise CannotPrint(f"Pango is not installed ({line}); on Debian: apt-get install libpango-1.0-0") from None
