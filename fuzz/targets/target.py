"""What a target is: a batch of work goes in, what it came to comes out, and nothing else has a say in it."""

from __future__ import annotations

import hashlib
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Protocol

from models.shipped import shipped

ROOT = Path(__file__).resolve().parents[2]
SOURCES = (".py", ".toml")


@dataclass(frozen=True)
class Batch:
    """A unit of work; everything that it does follows from these and from the code.

    ``target``: the target's name.  ``seed``: of the campaign.
    ``weights``: how often each named family is drawn, 1 as declared; none: all as declared.
    """

    target: str
    number: int
    seed: int
    weights: tuple[float, ...]


@dataclass(frozen=True)
class Result:
    """What a batch came to.

    ``traces``: runs made.  ``steps``: taken in all of them.
    ``counts``: by name, to be summed over batches.
    ``covered``, ``pairs``: hits by the id of a tuple, of a pair of tuples; ids fit 64 bits with a sign.
    ``sketch``: HyperLogLog registers of the distinct states, ``fuzz.campaign.sketch``; empty for none.
    ``failures``: traces as JSON texts.  ``seconds``: what it took.
    """

    batch: Batch
    traces: int
    steps: int
    counts: Mapping[str, int]
    covered: Mapping[int, int]
    pairs: Mapping[int, int]
    sketch: bytes
    failures: tuple[str, ...]
    seconds: float


class Target(Protocol):
    """What can be run.  It goes to other processes by pickle; what is costly to make it makes where it runs."""

    @property
    def name(self) -> str:
        """What batches and traces call it."""
        ...

    def identity(self) -> Mapping[str, str]:
        """What must not change under a running campaign: digests of files, ranges, the size of a batch."""
        ...

    def describe(self, tuple_id: int) -> str:
        """Say a tuple in words."""
        ...

    def families(self) -> tuple[str, ...]:
        """Name what a batch's weights are for, in their order."""
        ...

    def run(self, batch: Batch) -> Result:
        """Do the work: the same for the same batch, wherever and whenever."""
        ...


def digest_of_sources(*folders: str) -> str:
    """Digest the sources and data in some folders of this project, or in single files: SHA-256 as hex.

    Raises:
        OSError: a file cannot be read.
    """
    found = hashlib.sha256()
    for folder in folders:
        place = ROOT / folder if (ROOT / folder).exists() else shipped(folder)
        files = [place] if place.is_file() else sorted(path for path in place.rglob("*") if path.suffix in SOURCES)
        assert files, f"{folder}: no sources"
        for path in files:
            name = Path(folder, path.relative_to(place))
            found.update(f"{name}\0".encode() + hashlib.sha256(path.read_bytes()).digest())
    return found.hexdigest()
