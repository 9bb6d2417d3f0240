"""Python beside logic: each invariant, and each word that invariants are said in, with links from one to the other."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cache
from typing import Any

from markupsafe import Markup, escape

from evidence.report.logic import called, heading, notation, words
from evidence.report.places import Place, place_of
from proofs.theories import THEORIES


@dataclass(frozen=True)
class Said:
    """A function in both writings; ``heading``: how it is called, ``logic``: its lines, words in it linked."""

    heading: str
    anchor: str
    place: Place
    logic: Markup


@cache
def said(function: Callable[..., Any]) -> Said:
    """A predicate as Python and as logic.

    Raises:
        Unread: there is no notation for something in it.
    """
    known = {each.__name__: anchor_of(each) for each in called(function)}
    lines = "\n".join(notation(function))
    return Said(heading(function), anchor_of(function), place_of(function.__name__, function), _linked(lines, known))


@cache
def vocabulary() -> list[Said]:
    """The words that the invariants of all theories are said in, by themselves or by way of others."""
    return [said(each) for each in words([one for theory in THEORIES.values() for one in theory.invariants.values()])]


def anchor_of(function: Callable[..., Any]) -> str:
    """Where a word stands in the report."""
    return f"word-{function.__module__}.{function.__name__}"


def _linked(text: str, known: Mapping[str, str]) -> Markup:
    """A text with these names linked."""
    if not known:
        return escape(text)
    parts = re.split(rf"(?<![\w.])({'|'.join(map(re.escape, known))})(?![\w.])", text)
    link = Markup('<a href="#{}">{}</a>')
    return Markup("").join(link.format(known[part], part) if place % 2 else part for place, part in enumerate(parts))
