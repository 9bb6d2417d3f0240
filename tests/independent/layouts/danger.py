"""What is said of a layout file that is dangerous."""

from __future__ import annotations

from typing import NamedTuple

from models.layouts import BadInput, CheckResult, Imported, check

UNREAD = "not read"


class Danger(NamedTuple):
    """A file; what is wrong with it on the track; the rule, remark or refusal that says so, and of which elements."""

    text: str
    danger: str
    said: str
    elements: frozenset[str]

    def is_said(self, found: Imported | BadInput) -> bool:
        """Whether what became of the file says so: a refusal, which names no elements, or the verdict on it."""
        if isinstance(found, BadInput):
            return self.said in str(found) and not self.elements
        told = said_in(check(found))
        named = {str(element) for text, elements in told if self.said in text for element in elements}
        return any(self.said in text for text, _ in told) and self.elements <= named


def said_in(result: CheckResult) -> list[tuple[str, tuple[object, ...]]]:
    """Violations, with their rules, and remarks, each with its elements."""
    told: list[tuple[str, tuple[object, ...]]] = [
        (f"{each.axiom}: {each.text}", tuple(each.elements)) for each in result.violations
    ]
    return told + [(each.text, tuple(each.elements)) for each in result.remarks]


def danger_of(text: str, danger: str, said: str, *elements: str) -> Danger:
    """A danger, its elements one by one."""
    return Danger(text, danger, said, frozenset(elements))
