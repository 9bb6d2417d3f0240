"""What the lifter says when it meets something it does not know."""

from __future__ import annotations


class OutsideSubset(Exception):
    """A construct outside the subset: where it is, what it is, and what to write instead."""

    def __init__(self, file: str, line: int, what: str, hint: str) -> None:
        super().__init__(file, line, what, hint)
        self.file = file
        self.line = line
        self.what = what
        self.hint = hint

    def __str__(self) -> str:
        return f"{self.file}:{self.line}: {self.what}\n    hint: {self.hint}"
