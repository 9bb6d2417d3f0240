"""Text as HTML: the little Markdown that tables and docstrings use, and numbers."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence

from markupsafe import Markup, escape

CODE = re.compile(r"``?([^`]+)``?")
STRONG = re.compile(r"\*\*([^*]+)\*\*")
EMPHASIS = re.compile(r"(?<![*\w])\*([^*\n]+)\*(?![*\w])")
LINK = re.compile(r"\[([^\]]+)\]\([^)]+\)")
ROLE = re.compile(r":\w+:`([^`]+)`")


def markdown(text: str) -> Markup:
    """A sentence or a few as HTML: code, emphasis, and of links their words; marked as said by people, not counted."""
    plain = ROLE.sub(r"`\1`", LINK.sub(r"\1", text.replace("\\|", "|")))
    parts = []
    last = 0
    for found in CODE.finditer(plain):
        parts += [_emphasised(plain[last : found.start()]), Markup("<code>{}</code>").format(found[1])]
        last = found.end()
    whole = Markup("").join([*parts, _emphasised(plain[last:])])
    return Markup('<span class="said">{}</span>').format(whole) if whole else whole


def _emphasised(text: str) -> Markup:
    marked = EMPHASIS.sub(r"<em>\1</em>", STRONG.sub(r"<strong>\1</strong>", str(escape(text))))
    return Markup(marked)


def number(value: object) -> str:
    """A number as it is read: thousands apart; a small share by its power of ten."""
    if isinstance(value, bool) or not isinstance(value, int | float):
        return str(value)
    if isinstance(value, int):
        return f"{value:,}"
    return f"{value:.1e}" if 0 < abs(value) < 0.001 else f"{value:,.4g}"


def first_sentence(text: str) -> str:
    """The first paragraph of a docstring, on one line."""
    return " ".join(text.strip().split("\n\n")[0].split())


def shortened(text: str, most: int) -> str:
    """A text of at most so many characters; where it is cut stands an ellipsis."""
    return text if len(text) <= most else f"{text[: most - 1].rstrip()}…"


def wrapped(text: str, columns: int, most: int = 99) -> list[str]:
    """Cut a text into lines of so many columns; a Japanese character counts as two."""
    lines, line, wide = [], "", 0
    for word in text.split():
        width = width_of(word)
        if line and wide + 1 + width > columns:
            lines.append(line)
            line, wide = word, width
        else:
            line, wide = (f"{line} {word}", wide + 1 + width) if line else (word, width)
    lines += [line] * bool(line)
    return lines if len(lines) <= most else [*lines[: most - 1], f"{lines[most - 1]} …"]


def width_of(text: str) -> int:
    """How many columns a text takes."""
    return sum(2 if char >= "⺀" else 1 for char in text)


def rows_of(page: str, columns: int, section: str = "") -> list[list[str]]:
    """The rows of every table of a Markdown page that have so many columns, or of one of its sections."""
    return [cells for title, cells in titled_rows(page.splitlines(), columns) if not section or title == section]


def titled_rows(lines: Iterable[str], columns: int) -> Sequence[tuple[str, list[str]]]:
    """The rows of all tables with so many columns, each with the heading that it stands under, without theirs."""
    title, found, heading = "", [], True
    for line in lines:
        if line.startswith("#"):
            title = line.lstrip("# ").strip()
        if not line.startswith("|"):
            heading = True
            continue
        cells = [cell.strip() for cell in re.split(r"(?<!\\)\|", line.strip().strip("|"))]
        rule = all(set(cell) <= set("-: ") and cell for cell in cells)
        if not heading and not rule and len(cells) == columns:
            found.append((title, cells))
        heading = heading and not rule
    return found
