"""How a batch ended."""

from __future__ import annotations

from dataclasses import dataclass

from fuzz.targets.target import Batch, Result

DONE, HUNG, DIED, FAILED = "done", "hung", "died", "failed"


@dataclass(frozen=True)
class Outcome:
    """A batch, what it came to, and how it ended.

    ``status``: done; or hung (longer than it may), died (its process ended), failed (an exception), each more
    than once, and then there is no result.  ``words``: what is to be said of it.
    """

    batch: Batch
    result: Result | None
    status: str
    words: str = ""

    def __post_init__(self) -> None:
        assert (self.result is not None) == (self.status == DONE), self.status
        assert self.result is None or self.result.batch == self.batch, (self.result.batch, self.batch)
