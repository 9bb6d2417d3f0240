"""What ends a campaign before its time, in one line for whoever started it."""

from __future__ import annotations

from models.exit_codes import BAD_INPUT


class CampaignError(Exception):
    """One line: what is wrong, where, and what to do.  What was finished before stays in the store."""

    def __init__(self, line: str, code: int = BAD_INPUT) -> None:
        super().__init__(line)
        self.code = code
