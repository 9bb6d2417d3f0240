"""Reading a layout file, whatever it holds: bytes to text to plain data, and what can go wrong on the way.

The format is told by content.  Everything that is refused here is refused with a place in the file.
"""

from __future__ import annotations

import json
import re
import tomllib
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, Literal, NoReturn

from jsonschema import Draft202012Validator
from jsonschema.exceptions import ValidationError

from models.layouts.results import BadInput

Format = Literal["json", "toml", "xml", "yaml"]
DEEPEST_NESTING = 100
"""Levels of nesting that a layout file may have; none needs more than ten."""
LONGEST_NAME = 200
YAML_KEY = re.compile(r"""^(---|["']?[\w.-]+["']?\s*:(\s|$))""")


UNSEEN = re.compile(
    "[\u034f\u115f\u1160\u17b4\u17b5\u180b-\u180d\u180f\u2800\u3164\ufe00-\ufe0f\uffa0\U000e0100-\U000e01ef]"
)
"""Printable, and drawn as nothing: Default_Ignorable_Code_Point of Unicode, and the Braille cell without dots."""
HALF = re.compile("[\ud800-\udfff]")
"""Half of a character, which no text holds."""
ESCAPES = re.compile(r"\\(?:u[dD][89abAB][\da-fA-F]{2}\\u[dD][c-fC-F][\da-fA-F]{2}|(u[dD][89a-fA-F][\da-fA-F]{2})|.)")
"""What a backslash in JSON says: a character in two halves, one half alone, or anything else."""


DOTTED_KEY = re.compile(rf"""(?<![\w"'-])(?:(?>[\w-]+|"[^"\n]*"|'[^'\n]*')[ \t]*+\.[ \t]*+){{{DEEPEST_NESTING}}}""")
"""A key of so many parts; Python's parser takes time with the square of them."""


LARGEST_FILE = 1 << 30
"""In bytes, forty times what a network of 100,000 routes takes; a device has no end."""


def read_text(file: Path) -> str:
    """The file's text, which must be UTF-8, not empty, and of a size that layouts have."""
    try:
        with file.open("rb") as opened:
            content = opened.read(LARGEST_FILE + 1)
        if len(content) > LARGEST_FILE:
            what = f"holds more than {LARGEST_FILE:,} bytes"
            raise BadInput(str(file), "file", what, "give the path of a layout file")
    except OSError as error:
        what = error.strerror or "cannot be read"
        raise BadInput(str(file), "file", what, "give the path of a layout file") from error
    try:
        text = content.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        what = f"is not UTF-8 text (byte 0x{content[error.start]:02x})"
        raise BadInput(str(file), f"byte {error.start}", what, "save it as UTF-8") from error
    if not text.strip():
        raise BadInput(
            str(file), "file", "is empty", "give a layout in TOML, RailJSON, railML or an interlocking table"
        )
    if "\0" in text:
        raise BadInput(str(file), f"character {text.index(chr(0))}", "is not text (a zero byte)", "save it as UTF-8")
    return text


def format_of(file: str, text: str) -> Format:
    """JSON, XML, YAML or TOML, told by the first line that says anything."""
    significant = (line for line in text.splitlines() if line.strip() and not line.lstrip().startswith("#"))
    first = next(significant, "").lstrip()
    if first.startswith("<"):
        return "xml"
    if first.startswith(("{", "[[[", '["', "[{")) or first == "[":
        return "json"
    return "yaml" if YAML_KEY.match(first) or first.startswith(("- ", "&", "%YAML")) else "toml"


def parse_json(file: str, text: str) -> Any:
    """JSON without the liberties that Python takes: no NaN, no key twice, no bottomless nesting."""

    def refuse(constant: str) -> NoReturn:
        raise BadInput(file, f"number {constant}", "is not a number", "give finite positions and lengths in metres")

    def once(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
        found = dict(pairs)
        if len(found) < len(pairs):
            keys = [key for key, _ in pairs]
            twice = next(key for key in keys if keys.count(key) > 1)
            raise BadInput(file, f"key '{twice}'", "stands twice in one object", "keep one of the two")
        return found

    half = next((escape for escape in ESCAPES.finditer(text) if escape[1]), None)
    if half is not None:
        line, column = text.count("\n", 0, half.start()) + 1, half.start() - text.rfind("\n", 0, half.start())
        place, what = f"line {line} column {column}", f"holds {half[0]}, which is half of a character"
        raise BadInput(file, place, what, "give the other half, or take this one out")
    try:
        return json.loads(text, parse_constant=refuse, object_pairs_hook=once)
    except json.JSONDecodeError as error:
        place = f"line {error.lineno} column {error.colno}"
        raise BadInput(file, place, f"is not JSON: {error.msg}", "check that the file is complete") from error
    except RecursionError as error:
        raise too_deep(file) from error
    except ValueError as error:
        raise BadInput(file, "number", f"cannot be read: {error}", "give positions and lengths in metres") from error


def parse_toml(file: str, text: str, described: str = "layouts/README.md") -> Any:
    """TOML, with the line of an error; ``described``: the page that says what stands in such a file."""
    if DOTTED_KEY.search(text):
        raise too_deep(file)
    try:
        return tomllib.loads(text)
    except tomllib.TOMLDecodeError as error:
        found = re.search(r"\(at (line \d+, column \d+|end of document)\)", str(error))
        place = found.group(1) if found else "file"
        what = "is not TOML: " + re.sub(r" \(at .*\)$", "", str(error))
        raise BadInput(file, place, what, f"see {described} for the format") from error
    except RecursionError as error:
        raise too_deep(file) from error
    except ValueError as error:
        raise BadInput(file, "number", f"cannot be read: {error}", f"see {described} for the format") from error


def too_deep(file: str) -> BadInput:
    """The error for a file nested beyond all reason."""
    return BadInput(file, "nesting", f"is deeper than {DEEPEST_NESTING} levels", "no layout needs that: check the file")


def validate(file: str, data: Any, validator: Draft202012Validator) -> None:
    """Hold data to a schema; the first thing that does not fit is told with its place."""
    error = next(iter(validator.iter_errors(data)), None)
    if error is not None:
        place, what = _explain(error)
        raise BadInput(file, place, what, "see layouts/README.md for the formats")


def _explain(error: ValidationError) -> tuple[str, str]:
    """The place of a schema error and a sentence that does not repeat the whole file."""
    while error.context:
        error = max(error.context, key=lambda inner: len(inner.absolute_path))
    place = path_text(list(error.absolute_path)) or "top level"
    value: Any = error.instance
    rule, schema = error.validator, error.schema
    wanted: Any = error.validator_value
    assert isinstance(schema, Mapping)
    if rule == "required":
        missing = next(name for name in wanted if name not in value)
        return place, f"has no '{missing}'"
    if rule == "type":
        return place, f"is {_kind(value)}, not {_or(wanted)}"
    if rule == "enum":
        return place, f"is {_short(value)}, not one of {', '.join(map(str, wanted))}"
    if rule == "additionalProperties":
        known = schema.get("properties", {})
        unknown = next((key for key in value if key not in known), "?")
        return place, f"has an unknown entry '{unknown}'"
    return place, f"{_short(value)} is not allowed here ({rule} {_short(wanted)})"


def _kind(value: Any) -> str:
    names = {dict: "an object", list: "a list", str: "a text", bool: "true or false", type(None): "null"}
    return names.get(type(value), f"the number {_short(value)}")


def _or(kinds: str | Sequence[str]) -> str:
    return kinds if isinstance(kinds, str) else " or ".join(kinds)


def _short(value: Any) -> str:
    text = repr(value)
    return text if len(text) <= 60 else text[:59] + "…"


def path_text(steps: Sequence[object]) -> str:
    """A place in nested data, as ``routes[3].entry_point.id``."""
    text = ""
    for step in steps:
        text += f"[{step}]" if isinstance(step, int) else f".{step}" if text else str(step)
    return text


def identifier(file: str, place: str, name: str) -> str:
    """A name that can be printed on one line, and of which every character is seen."""
    if not name or len(name) > LONGEST_NAME or not name.isprintable():
        raise BadInput(file, place, f"{_short(name)} is not usable as a name", "use 1 to 200 printable characters")
    unseen = UNSEEN.search(name)
    if unseen is not None:
        what = f"{_short(name)} is not usable as a name: it holds U+{ord(unseen[0]):04X}, which nobody sees"
        raise BadInput(file, place, what, "take that character out")
    return name


def escaped(name: str) -> str:
    """A name in which the marks that join names do not occur, different for different names."""
    return name.replace("%", "%25").replace("@", "%40").replace("|", "%7C")


def by_name(file: str, place: str, items: Sequence[Mapping[str, Any]]) -> dict[str, Mapping[str, Any]]:
    """The items of a list by their ``id``, none of which may stand twice."""
    found: dict[str, Mapping[str, Any]] = {}
    first: dict[str, int] = {}
    for index, item in enumerate(items):
        name = identifier(file, f"{place}[{index}].id", item["id"])
        if name in found:
            raise BadInput(file, f"{place}[{index}]", f"id '{name}' is taken by {place}[{first[name]}]", "rename one")
        found[name], first[name] = item, index
    return found
