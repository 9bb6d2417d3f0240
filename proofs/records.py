"""The records that a proof run leaves: one dictionary an obligation, and one file a run.

A record is what the evidence report and the matrix read; neither sees a solver.
"""

from __future__ import annotations

import base64
import hashlib
import json
import platform
import shlex
import sys
import sysconfig
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from datetime import UTC, datetime
from functools import cache
from importlib import metadata
from pathlib import Path
from typing import Literal, NotRequired, TypedDict

from models.exit_codes import DOES_NOT_HOLD, HOLDS, UNDECIDED
from models.shipped import is_installed
from models.streams import STANDARD_OUTPUT, write_whole
from proofs.repository import head

Verdict = Literal["proved", "refuted", "undecided"]

EXIT_CODE: Mapping[Verdict, int] = {"proved": HOLDS, "refuted": DOES_NOT_HOLD, "undecided": UNDECIDED}


SOLVERS = ("z3-solver", "cvc5")
"""The packages of the solvers."""


class About(TypedDict):
    """What every record says of how it was made.

    ``commit``: null outside a git checkout; ``command``: as it was given, quoted for a shell; ``solvers``: a hash of
    all files of each solver's package; ``platform``: as packages are built for it; ``made_at``: when, in UTC.
    """

    commit: str | None
    command: str
    versions: dict[str, str]
    solvers: dict[str, str]
    platform: str
    made_at: str


class Source(TypedDict):
    """Where the invariant of an obligation stands: file, first and last line."""

    file: str
    lines: tuple[int, int]


class Obligation(TypedDict):
    """One question put to one solver with one seed, and its answer.

    ``transition`` is ``init`` for the initial state; a theory beside the interlocking has its name in
    front, ``odometry.init``.  ``theory`` is written to the file.  ``hypotheses`` names the invariants that were
    assumed of the state before, ``axioms`` what holds of the symbols in it, whatever they stand for
    (:meth:`proofs.workbench.Workbench.always`).  ``rlimit`` is the budget, ``rlimit_spent`` what was used, both in
    the solver's own units.  ``smt2_sha256`` is the hash of the SMT-LIB text that was solved.
    ``kept``: when it was answered, where nobody was asked in this run: such an answer is no evidence.
    """

    transition: str
    invariant: str
    hypotheses: list[str]
    axioms: list[str]
    verdict: Verdict
    solver: str
    solver_version: str
    seed: int
    rlimit: int
    rlimit_spent: int
    seconds: float
    smt2_sha256: str
    source: Source
    theory: NotRequired[str]
    note: NotRequired[str]
    kept: NotRequired[str]


class CanarySeen(TypedDict):
    """One question whose answer is known (:mod:`proofs.canaries`), put to one solver, and what it answered.

    ``process``: the id of the process that asked; every one that answers obligations asks for itself.
    """

    canary: str
    solver: str
    solver_version: str
    process: int
    answer: str
    noticed: bool


class Record(About):
    """One proof run, as it is written to ``out/prove.json``."""

    verdict: Verdict
    obligations: list[Obligation]
    lifting_seconds: float
    wall_seconds: float
    canaries: list[CanarySeen]
    offences: list[str]


@dataclass(frozen=True)
class Report:
    """What a proof run gives back; ``seconds`` of lifting are apart from those of the whole run.

    ``canaries``: what each solver answered to questions whose answer is known, in every process that worked.
    ``offences``: what assumptions and claims take from the kernel that they must not (:mod:`proofs.lints_apart`).
    ``said``: what went wrong with the file in which answers are kept, a line each.
    """

    obligations: Sequence[Obligation]
    lifting_seconds: float
    wall_seconds: float
    canaries: Sequence[CanarySeen] = ()
    offences: Sequence[str] = ()
    said: Sequence[str] = ()

    @property
    def kept(self) -> int:
        """How many answers are kept from earlier runs."""
        return sum("kept" in each for each in self.obligations)

    @property
    def verdict(self) -> Verdict:
        """The verdict on the whole run: with a missed canary, or an offence of the sources, nothing is decided."""
        believed = all(each["noticed"] for each in self.canaries) and not self.offences
        doubted: list[Verdict] = ["undecided"] * (not believed)
        return overall([*doubted, *(obligation["verdict"] for obligation in self.obligations)])

    @property
    def exit_code(self) -> int:
        """0 proved, 1 refuted, 3 undecided."""
        return EXIT_CODE[self.verdict]

    def record(self) -> Record:
        """The run as it is written to a file."""
        return {
            "verdict": self.verdict,
            "obligations": [{**each, "theory": theory_of(each["transition"])[0]} for each in self.obligations],
            "lifting_seconds": round(self.lifting_seconds, 3),
            "wall_seconds": round(self.wall_seconds, 3),
            "canaries": [*self.canaries],
            "offences": [*self.offences],
            **about(),
        }


def theory_of(transition: str) -> tuple[str, str]:
    """Give the theory that a recorded row belongs to, and the row's name within it."""
    theory, _, name = transition.rpartition(".")
    return theory or "interlocking", name


def overall(verdicts: Sequence[Verdict]) -> Verdict:
    """The worst verdict: refuted before undecided before proved.  Nothing asked is nothing proved."""
    if "refuted" in verdicts:
        return "refuted"
    if "undecided" in verdicts or not verdicts:
        return "undecided"
    return "proved"


def versions() -> dict[str, str]:
    """The versions of Python, of both solvers and of this project."""
    found = {"python": platform.python_version()}
    for name in ("z3-solver", "cvc5", "heisoku"):
        try:
            found[name] = metadata.version(name)
        except metadata.PackageNotFoundError:
            found[name] = "not installed"
    return found


@cache
def solvers_hashed() -> dict[str, str]:
    """A hash of each solver as it is installed: of all its files, by their names and content."""
    found = {}
    for name in SOLVERS:
        whole = hashlib.sha256()
        for file in sorted(_files_of(name), key=str):
            path = Path(str(file.locate()))
            content = path.read_bytes() if path.is_file() else b""
            whole.update(f"{file}\0{len(content)}\0".encode() + content)
        found[name] = whole.hexdigest()
    return found


def solvers_altered() -> list[str]:
    """Name the files of the solvers that are not as their packages' own lists say, or are not there."""
    altered = []
    for name in SOLVERS:
        for file in _files_of(name):
            path = Path(str(file.locate()))
            told = file.hash.value if file.hash else ""
            digest = hashlib.sha256(path.read_bytes()).digest() if path.is_file() else b""
            if base64.urlsafe_b64encode(digest).rstrip(b"=").decode() != told:
                altered.append(str(file))
    return sorted(altered)


def _files_of(name: str) -> list[metadata.PackagePath]:
    """The files of a package whose hash its list tells: all but what was made at its installation or since."""
    try:
        return [file for file in metadata.files(name) or () if file.hash is not None]
    except metadata.PackageNotFoundError:
        return []


def about() -> About:
    """What every record says of how it was made."""
    return {
        "commit": commit(),
        "command": shlex.join([Path(sys.argv[0]).name, *sys.argv[1:]]),
        "versions": versions(),
        "solvers": solvers_hashed(),
        "platform": sysconfig.get_platform(),
        "made_at": datetime.now(UTC).isoformat(timespec="seconds"),
    }


def commit() -> str | None:
    """The commit that the source is at, with ``+`` behind it if files differ from it; None if unknown.

    An installed copy has none: a repository that it happens to lie in is not its own.
    """
    if is_installed():
        return None
    return head(Path(__file__).resolve().parent)


def write_json(path: Path, record: Mapping[str, object]) -> None:
    """Write a record, whole or not at all, so that no reader ever finds half of one; to ``-``, standard output."""
    content = json.dumps(record, ensure_ascii=False, indent=1) + "\n"
    if path == STANDARD_OUTPUT:
        sys.stdout.write(content)
        sys.stdout.flush()
    else:
        write_whole(path, content.encode())
