"""Names that a reader takes for one another: by Unicode form, spaces, letters of another alphabet, or case."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Mapping
from unicodedata import normalize

from models.layouts.findings import Findings

DRAWN_ALIKE = (
    "АВЕЗКМНОРСТУХаеорсухіјѕԁԛԝЅІЈΑΒΕΖΗΙΚΜΝΟΡΤΥΧοανρһҺӏӀүҮԌԜѵѴѡҽЬбӠгϹϲϳͿϜϺυιɑɡΓΠΦΨΛκπτφψ",
    "ABE3KMHOPCTYXaeopcyxijsdqwSIJABEZHIKMNOPTYXoavphhlIyYGWvVweb63rCcjJFMuiagГПФѰЛкптфѱ",
)
"""Letters of Cyrillic, Greek and phonetic script, and the Latin ones, or Cyrillic ones, that they are drawn as."""
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
    return _put_for_one_another(name, PLAIN)


def _put_for_one_another(name: str, letters: Mapping[int, str | int]) -> str:
    """A name in one Unicode form, with other letters for some; an accent is no part of the letter that it is on."""
    if name.isascii():
        return " ".join(name.split()) if " " in name else name
    # First as they stand: taken apart, a lunate sigma, which is drawn as c, would be a plain one.
    apart = normalize("NFKD", name.translate(letters))
    return " ".join(normalize("NFC", apart.translate(letters)).split())


SMALL = {ord(odd.casefold()): drawn(plain.casefold()) for odd, plain in zip(*DRAWN_ALIKE, strict=True)} | PLAIN
"""The same, and letters whose capitals are drawn alike: н is read as h, since Н is drawn as H."""


def read(name: str) -> str:
    """A name as it is read aloud, or from a screen: without its case, letters that are read as digits as these.

    Not all letters go by their capitals: ν is drawn as v and Ν as N, υ as u and Υ as Y.
    """
    return _put_for_one_another(drawn(name).casefold(), SMALL).translate(DIGITS)


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
