"""What is said of a layout file that is dangerous."""

from __future__ import annotations

from typing import NamedTuple

UNREAD = "not read"


class Danger(NamedTuple):
    """A file; what is wrong with it on the track; the rule, remark or refusal that says so, and of which elements."""

    text: str
    danger: str
    said: str
    elements: frozenset[str]


def danger_of(text: str, danger: str, said: str, *elements: str) -> Danger:
    """A danger, its elements one by one."""
    return Danger(text, danger, said, frozenset(elements))
