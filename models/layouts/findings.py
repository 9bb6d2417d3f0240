"""What an importer notices about a layout that it can read."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

from models.layouts.results import Remark, RestKind, Violation


@dataclass
class Findings:
    """What is noticed while a file is imported; ``point_word`` is what its format calls a point."""

    point_word: str
    remarks: list[Remark] = field(default_factory=list)
    violations: list[Violation] = field(default_factory=list)

    def remark(self, elements: Sequence[str], text: str, rests: RestKind | None = None) -> None:
        """Note something that makes no layout wrong; ``rests``: a verdict rests on it."""
        self.remarks.append(Remark(tuple(elements), text, rests))

    def violation(self, rule: str, elements: Sequence[str], text: str) -> None:
        """Note something that does."""
        self.violations.append(Violation(rule, tuple(elements), text))
