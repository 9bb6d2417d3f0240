"""Names that a reader takes for one another: by Unicode form, spaces, letters of another alphabet, or case."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable
from unicodedata import normalize

from models.layouts.findings import Findings

DRAWN_ALIKE = (
    "АВЕЗКМНОРСТУХаеорсухіјѕԁԛԝЅІЈΑΒΕΖΗΙΚΜΝΟΡΤΥΧοανρ",
    "ABE3KMHOPCTYXaeopcyxijsdqwSIJABEZHIKMNOPTYXoavp",
)
"""Cyrillic and Greek letters, and the Latin ones that they are drawn as."""
DRAWN_ALIKE_IN_JAPAN = (
    "‐‑‒–—―−ー一二力口工夕八卜才千へりべぺ〇",
    "---------ニカロエタハトオチヘリベペ○",
)
"""Dashes, the bar that makes a vowel long and the sign for one; signs and hiragana drawn as a katakana is."""
PLAIN = str.maketrans(*("".join(each) for each in zip(DRAWN_ALIKE, DRAWN_ALIKE_IN_JAPAN, strict=True)))
DIGITS = str.maketrans("oil", "011")
"""Letters that are read as digits, in lower case."""
LOOK_ALIKE = "no two names look the same"


def drawn(name: str) -> str:
    """A name as it is drawn: one Unicode form, no space at its ends or twice, one of the letters drawn alike."""
    if name.isascii():
        return " ".join(name.split()) if " " in name else name
    return " ".join(normalize("NFKC", name).translate(PLAIN).split())


def read(name: str) -> str:
    """A name as it is read aloud, or from a screen: without its case, letters that are read as digits as these."""
    return drawn(name).casefold().translate(DIGITS)


def say_what_is_alike(what: str, names: Iterable[str], findings: Findings) -> None:
    """Names drawn alike are a violation; those that differ in case, or in a letter for a digit, a remark."""
    by_read: dict[str, list[str]] = defaultdict(list)
    for name in names:
        by_read[read(name)].append(name)
    for alike in by_read.values():
        if len(alike) < 2:
            continue
        by_drawn: dict[str, list[str]] = defaultdict(list)
        for name in sorted(alike):
            by_drawn[drawn(name)].append(name)
        for same in by_drawn.values():
            if len(same) > 1:
                text = f"{what} {_told(same)} look the same: nobody can tell them apart"
                findings.violation(LOOK_ALIKE, same, text)
        if len(by_drawn) > 1:
            one_each = [same[0] for same in by_drawn.values()]
            findings.remark(one_each, f"{what} {_told(one_each)} differ in case, or in a letter for a digit, alone")


def _told(names: Iterable[str]) -> str:
    """The names with every character that is not plain written out."""
    return ", ".join(ascii(name) for name in names)
