"""Good layout files made bad: bytes, encodings, numbers, names, elements, sizes and depths, entities.

A mutation is a function of the good file's text, its format and a source of chance; what it gives may still be a
layout.  The same number of the same seed is the same file.
"""

from __future__ import annotations

import json
import random
import re
import tomllib
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import yaml
from lxml import etree

from models.layouts.generate import as_toml

Chance = random.Random
FORMATS = ("toml", "json", "xml", "yaml")
NUMBER = re.compile(r"(?<![\w.])-?\d+(?:\.\d+)?(?![\w.])")
NAME = re.compile(r"(?<=[\"'])[^\"'\n<>&]{1,40}(?=[\"'])")
NUMBERS = (
    *("0", "-1", "-0", "0.0", "1e-300", "1e308", "1e309", "-1e400", "nan", "inf", "NaN", "Infinity", "-Infinity"),
    *("9" * 30, "9" * 5_000, "0." + "3" * 400, "268435455", "268435456", "4294967296", "9223372036854775808"),
    *("true", "null", "0x7f", "0o7", "1_000", "1,5", "١٢٣", "1979-05-27T07:32:00Z", '"7"', "[]", "{}"),
)
NAMES = (
    *("", " ", "\t", "x" * 300, "x" * 100_000, "a\u202eb", "\u200b", "\ufeff", "é" * 100, "\U0001f682", "a\x1bc"),
    *("../../etc/passwd", "__class__", "%s%n", "${x}", "a.b.c", "P1.tip.tip", ".", "#", "=", "\\", "\\u0000", "None"),
)
ENCODINGS = ("utf-16", "utf-16-le", "utf-32", "latin-1", "cp932", "utf-7", "cp037", "utf-8-sig", "euc_jp", "hz")
VALUES: tuple[Any, ...] = (None, True, -1, 0, 1e308, 10**400, "", "x", "P1", [], {}, [[]], {"id": "x"}, 1.5, "\x7f")
DEEP = 20_000
MANY = 3_000


@dataclass(frozen=True)
class Good:
    """A good file: its name, format and text."""

    name: str
    kind: str
    text: str


def mutated(good: Good, others: Sequence[Good], chance: Chance) -> tuple[str, bytes]:
    """One bad file: the name of what was done last, and the bytes."""
    text, done = good.text, ""
    for _ in range(chance.choice((1, 1, 1, 2, 3))):
        done = chance.choice(CHOICE)
        made = OF_TEXT[done](text, good.kind, chance, others)
        text = made if made is not None else text
    content = text.encode("utf-8", "surrogatepass")
    if chance.random() < 0.15:
        done = chance.choice(sorted(OF_BYTES))
        content = OF_BYTES[done](content, chance)
    return done, content


# ---- bytes


def flipped(content: bytes, chance: Chance) -> bytes:
    changed = bytearray(content)
    for _ in range(chance.randint(1, 8) if changed else 0):
        changed[chance.randrange(len(changed))] ^= 1 << chance.randrange(8)
    return bytes(changed)


def cut_short(content: bytes, chance: Chance) -> bytes:
    return content[: chance.randrange(len(content) + 1)]


def noise(content: bytes, chance: Chance) -> bytes:
    at = chance.randrange(len(content) + 1)
    return content[:at] + chance.randbytes(chance.randint(1, 300)) + content[at:]


def encoded(content: bytes, chance: Chance) -> bytes:
    return content.decode("utf-8", "replace").encode(chance.choice(ENCODINGS), "replace")


def marked(content: bytes, chance: Chance) -> bytes:
    marks = (b"\xef\xbb\xbf", b"\xff\xfe", b"\xfe\xff", b"\0", b"\x1a", b"\xc0\x80", b"\xed\xa0\x80", b"\x1f\x8b\x08")
    return chance.choice(marks) + content if chance.random() < 0.6 else content + chance.choice(marks)


def all_bytes(content: bytes, chance: Chance) -> bytes:
    return chance.randbytes(len(content) % 5_000)


# ---- text


def exchanged(text: str, kind: str, chance: Chance, others: Sequence[Good]) -> str:
    """A piece of the text put where another one was, or taken out, or told twice."""
    ends = sorted(chance.randrange(len(text) + 1) for _ in range(4))
    first, second = text[ends[0] : ends[1]][:2_000], text[ends[2] : ends[3]][:2_000]
    head, middle, tail = text[: ends[0]], text[ends[1] : ends[2]], text[ends[3] :]
    return chance.choice(
        (head + second + middle + first + tail, head + middle + tail, head + first * 2 + middle + second + tail)
    )


def lines_moved(text: str, kind: str, chance: Chance, others: Sequence[Good]) -> str:
    lines = text.splitlines(keepends=True)
    for _ in range(chance.randint(1, 5)):
        line = lines.pop(chance.randrange(len(lines))) if lines else ""
        if chance.random() < 0.7:
            lines.insert(chance.randrange(len(lines) + 1), line)
    return "".join(lines)


def line_ends(text: str, kind: str, chance: Chance, others: Sequence[Good]) -> str:
    return text.replace("\n", chance.choice(("\r\n", "\r", "\x85", "\u2028", "\v", " ")))


def signs(text: str, kind: str, chance: Chance, others: Sequence[Good]) -> str:
    """Signs that a format is made of, put anywhere."""
    for _ in range(chance.randint(1, 5)):
        at = chance.randrange(len(text) + 1)
        put = chance.choice(
            (*'{}[]()<>&"=:,#!*%|-\\\0\x0c', "'''", '"""', "<!--", "]]>", "<?", "---\n", "\udc80", "&#0;")
        )
        text = text[:at] + put + text[at + chance.randrange(2) :]
    return text


def numbers(text: str, kind: str, chance: Chance, others: Sequence[Good]) -> str:
    return _replaced(text, NUMBER, chance, (*NUMBERS, str(chance.randrange(-(10**6), 10**10))))


def names(text: str, kind: str, chance: Chance, others: Sequence[Good]) -> str:
    known = [found.group() for found in NAME.finditer(text)]
    return _replaced(text, NAME, chance, (*NAMES, *known, *known))


def one_name_for_all(text: str, kind: str, chance: Chance, others: Sequence[Good]) -> str:
    known = sorted({found.group() for found in NAME.finditer(text)})
    if len(known) < 2:
        return text
    old, new = chance.sample(known, 2)
    return text.replace(f'"{old}"', f'"{new}"')


def _replaced(text: str, pattern: re.Pattern[str], chance: Chance, by: Sequence[str]) -> str:
    places = list(pattern.finditer(text))
    for found in sorted(chance.sample(places, min(len(places), chance.randint(1, 3))), key=lambda each: -each.start()):
        text = text[: found.start()] + chance.choice(by) + text[found.end() :]
    return text


def two_files(text: str, kind: str, chance: Chance, others: Sequence[Good]) -> str:
    other = chance.choice(others).text
    return text + other if chance.random() < 0.5 else text[: chance.randrange(len(text) + 1)] + other


# ---- elements


def elements(text: str, kind: str, chance: Chance, others: Sequence[Good]) -> str | None:
    """Elements dropped, doubled, moved, exchanged, of another type; the file still parses."""
    if kind == "xml":
        return _xml(text, chance)
    data = _read(text, kind)
    if data is None:
        return None
    for _ in range(chance.randint(1, 3)):
        data = changed(data, chance)
    return _written(data, kind)


def many(text: str, kind: str, chance: Chance, others: Sequence[Good]) -> str | None:
    """One element told very often, under the same name or under new ones."""
    if kind == "xml":
        root = _root(text)
        if root is None:
            return None
        one = chance.choice([each for each in root.iter("{*}*") if each is not root])
        for number in range(MANY // max(1, len(list(one.iter())))):
            copy = etree.fromstring(etree.tostring(one))
            if chance.random() < 0.95 and "id" in copy.attrib:
                copy.set("id", f"{copy.get('id')}-{number}")
            one.addnext(copy)
        return etree.tostring(root, encoding="unicode")
    data = _read(text, kind)
    tables = [value for value in _values(data) if isinstance(value, dict | list) and value]
    if not tables:
        return None
    table = chance.choice(tables)
    if isinstance(table, list):
        table += [_renamed(chance.choice(table), number) for number in range(MANY)]
    else:
        key = chance.choice(list(table))
        table.update({f"{key} {number}": table[key] for number in range(MANY)})
    return _written(data, kind)


def deep(text: str, kind: str, chance: Chance, others: Sequence[Good]) -> str:
    """Nesting without end, at a place where it may stand."""
    depth = chance.choice((50, 500, DEEP))
    if kind == "xml":
        put = "<tvdSections>" * depth + chance.choice(("", "</tvdSections>" * depth))
        at = chance.choice([found.start() for found in re.finditer(r"<\w", text)] or [0])
        return text[:at] + put + text[at:]
    opening, closing = chance.choice(
        (("[", "]"), ('{"a":', "}"), ("{a = ", "}"), ("- ", ""), ("a.", "a = 1"), ("(", ")"))
    )
    put = opening * depth + chance.choice(("", "1", closing * depth))
    at = chance.choice([found.end() for found in re.finditer(r"[:=,\n]\s", text)] or [0])
    return text[:at] + put + text[at:]


def long(text: str, kind: str, chance: Chance, others: Sequence[Good]) -> str:
    """Something very long: blanks, a comment, a name, a number, a list."""
    size = chance.choice((10_000, 300_000))
    put = chance.choice((" ", "\n", "#", "a", "9", "[],", "<a/>", "&amp;", "\\n", '"', "1e", "𝕏")) * size
    at = chance.randrange(len(text) + 1)
    return text[:at] + put + text[at:]


def entities(text: str, kind: str, chance: Chance, others: Sequence[Good]) -> str:
    """Entities and aliases that multiply, refer to themselves, or to files elsewhere."""
    lol = "".join(f'<!ENTITY l{n + 1} "{f"&l{n};" * 10}">' for n in range(12))
    blown = f'<!ENTITY l0 "{"lol" * 3}">{lol}'
    declared, used = chance.choice(
        (
            (blown, "&l12;"),
            (f'<!ENTITY q "{"q" * 50_000}">', "&q;" * 2_000),
            ('<!ENTITY x SYSTEM "file:///etc/passwd">', "&x;"),
            ('<!ENTITY x SYSTEM "file:///dev/zero">', "&x;"),
            ('<!ENTITY x SYSTEM "http://192.0.2.1/x">', "&x;"),
            ('<!ENTITY % p SYSTEM "file:///dev/zero">%p;', ""),
            ('<!ENTITY a "&b;"><!ENTITY b "&a;">', "&a;"),
        )
    )
    if kind == "xml":
        body = text[text.index("?>") + 2 :] if text.startswith("<?") and "?>" in text else text
        places = [found.end() for found in re.finditer(r'="|>', body)] or [0]
        at = chance.choice(places)
        return f'<?xml version="1.0"?><!DOCTYPE railML [{declared}]>{body[:at]}{used}{body[at:]}'
    aliases = "a0: &a0 [x, x]\n" + "".join(f"a{n + 1}: &a{n + 1} [{f'*a{n}, ' * 9}]\n" for n in range(12))
    return aliases + text if chance.random() < 0.5 else text + "\n" + aliases + "<<: *a12\n"


def changed(value: Any, chance: Chance) -> Any:
    """A value with one place in it exchanged, dropped, doubled or moved."""
    if not (isinstance(value, dict | list) and value and chance.random() < 0.85):
        return chance.choice(VALUES)
    keys: list[Any] = list(value) if isinstance(value, dict) else list(range(len(value)))
    key, made = chance.choice(keys), value.copy()
    match chance.randrange(7):
        case 0:
            del made[key]
        case 1 if isinstance(made, list):
            made.append(made[key])
        case 1 if isinstance(made, dict):
            made[str(chance.choice(NAMES))] = made[key]
        case 2:
            made[key] = made[chance.choice(keys)]
        case 3 if isinstance(made, list):
            chance.shuffle(made)
        case _:
            made[key] = changed(value[key], chance)
    return made


def _xml(text: str, chance: Chance) -> str | None:
    root = _root(text)
    if root is None:
        return None
    for _ in range(chance.randint(1, 4)):
        every = list(root.iter("{*}*"))
        if len(every) < 2:
            break
        one, other = chance.choice(every[1:]), chance.choice(every)
        match chance.randrange(7):
            case 0:
                one.getparent().remove(one)
            case 1:
                other.append(etree.fromstring(etree.tostring(one)))
            case 2 if one is not other and one not in other.iterancestors():
                other.append(one)
            case 3 if one.attrib:
                del one.attrib[chance.choice(list(one.attrib))]
            case 4:
                one.tag = chance.choice([each.tag for each in every])
            case 5:
                one[:] = sorted(one, key=lambda _: chance.random())
            case _ if one.attrib:
                values = [value for each in every for value in each.attrib.values()]
                odd = [each for each in (*NUMBERS, *NAMES) if each.isprintable()]
                one.set(chance.choice(list(one.attrib)), chance.choice([*values, *odd]))
    return etree.tostring(root, encoding="unicode")


def _root(text: str) -> Any:
    try:
        return etree.fromstring(text.encode("utf-8", "replace"), etree.XMLParser(resolve_entities=False))
    except etree.XMLSyntaxError:
        return None


def _read(text: str, kind: str) -> Any:
    if kind == "yaml" and "*a" in text:
        return None  # aliases that multiply, of an earlier mutation
    try:
        return PARSERS[kind](text)
    except (ValueError, RecursionError, yaml.YAMLError):
        return None


def _written(data: Any, kind: str) -> str:
    text = json.dumps(data, indent=1, default=str)
    if kind == "yaml":
        return f"---\n{text}"
    return as_toml(json.loads(text)) if kind == "toml" and isinstance(data, Mapping) else text


def _values(value: Any) -> list[Any]:
    inside = value.values() if isinstance(value, dict) else value if isinstance(value, list) else ()
    return [value, *(each for inner in inside for each in _values(inner))]


def _renamed(value: Any, number: int) -> Any:
    return {**value, "id": f"{value['id']}-{number}"} if isinstance(value, dict) and "id" in value else value


PARSERS: Mapping[str, Callable[[str], Any]] = {"toml": tomllib.loads, "json": json.loads, "yaml": yaml.safe_load}
OF_BYTES: Mapping[str, Callable[[bytes, Chance], bytes]] = {
    each.__name__: each for each in (flipped, cut_short, noise, encoded, marked, all_bytes)
}
OF_TEXT: Mapping[str, Callable[[str, str, Chance, Sequence[Good]], str | None]] = {
    each.__name__: each
    for each in (
        *(exchanged, lines_moved, line_ends, signs, numbers, names, one_name_for_all, two_files),
        *(elements, many, deep, long, entities),
    )
}
PARSED_STILL = ("elements", "numbers", "names", "one_name_for_all", "many")
CHOICE = (*sorted(OF_TEXT), *PARSED_STILL * 3)
"""What leaves a file that can be parsed is drawn more often: it gets farther."""
