"""The hashes of all records, of the sources they were made from, and the commit: ``out/manifest.json``."""

from __future__ import annotations

import hashlib
import json
import stat
from collections.abc import Mapping
from dataclasses import asdict, dataclass
from datetime import UTC, datetime
from pathlib import Path

from evidence.records.strict import KINDS, content_of, is_other, parsed
from models.shipped import is_installed
from proofs.records import commit, versions
from proofs.repository import git

ROOT = Path(__file__).resolve().parent.parent.parent
ROOMS = ("kernel", "models", "proofs", "fuzz", "evidence")
NAME = "manifest.json"
FORMAT = "heisoku manifest 1"
NOT_RECORDS = frozenset({NAME, "lock", "mutants.json", "test.log"})
"""What else stands in the folder: the tools that pin packages, trials kept between runs of mutate, a log."""
ALWAYS = ("prove.json", "check.json")
"""Records without which there is nothing to bind."""


class ManifestError(Exception):
    """A manifest that cannot be used: one line that says why."""


@dataclass(frozen=True)
class Manifest:
    """The hashes of a folder of records.

    ``commit``: of the sources, with ``+`` behind it where files differed from it; ``sources``: a hash of all files
    that are not ignored, by their names and content; ``records``: the hash of each file by its place in the folder.
    ``made_at``: when it was made, in UTC; empty in one of an earlier version.
    """

    commit: str | None
    sources: str
    records: Mapping[str, str]
    versions: Mapping[str, str]
    made_at: str = ""

    def text(self) -> str:
        """As it is written."""
        return json.dumps({"format": FORMAT, **asdict(self)}, indent=1, sort_keys=True) + "\n"


def made(folder: Path) -> Manifest:
    """Hash everything in a folder, and the sources."""
    records = {name: hash_of(folder / name) for name in files(folder)}
    return Manifest(commit(), sources(), records, versions(), datetime.now(UTC).isoformat(timespec="seconds"))


def files(folder: Path) -> list[str]:
    """The files of a folder that are records, by their places in it."""
    return sorted(
        path.relative_to(folder).as_posix()
        for path in folder.rglob("*")
        if path.is_file() and not path.is_symlink() and path.relative_to(folder).parts[0] not in NOT_RECORDS
    )


def others(folder: Path) -> dict[str, str]:
    """What else stands in a folder of records, by its place in it: links, FIFOs, devices, each as what it is."""
    found = {path: is_other(path) for path in sorted(folder.rglob("*"))}
    return {
        path.relative_to(folder).as_posix(): what
        for path, what in found.items()
        if what and what != KINDS[stat.S_IFDIR] and path.relative_to(folder).parts[0] not in NOT_RECORDS - {NAME}
    }


def hash_of(path: Path) -> str:
    """The SHA-256 of a file."""
    with path.open("rb") as file:
        return hashlib.file_digest(file, "sha256").hexdigest()


def sources(root: Path = ROOT) -> str:
    """A hash of every file of the sources: those that git knows or would take; without git, all but what is made.

    In an installed copy: every file of the packages, which stand among those of others.
    """
    named = [] if root == ROOT and is_installed() else _named_by_git(root)
    whole = hashlib.sha256()
    for name in sorted(named or _found(root)):
        path = root / name
        content = path.read_bytes() if path.is_file() else b""
        whole.update(f"{name}\0{len(content)}\0".encode() + content)
    return whole.hexdigest()


def _named_by_git(root: Path) -> list[str]:
    words = ("ls-files", "-z", "--cached", "--others", "--exclude-standard", "--deduplicate")
    told = git(root, *words) or b""
    return [name for name in told.decode("utf-8", "surrogateescape").split("\0") if (root / name).is_file()]


def _found(root: Path) -> list[str]:
    ignored = {"out", "build", "__pycache__"}
    ours = [root / room for room in ROOMS] if root == ROOT and is_installed() else [root]
    return [
        path.relative_to(root).as_posix()
        for place in ours
        for path in place.rglob("*")
        if path.is_file()
        and not any(part in ignored or part.startswith(".") for part in path.relative_to(root).parts)
        and path.suffix != ".pyc"
    ]


def read_manifest(folder: Path) -> Manifest:
    """Read the manifest of a folder.

    Raises:
        ManifestError: there is none, or it is no manifest.
    """
    path = folder / NAME
    try:
        data = parsed(content_of(path))
        if data["format"] != FORMAT:
            raise ManifestError(f"{path}: is of the format {data['format']}; heisoku manifest {folder} makes it anew")
        records, with_versions = dict(data["records"]), dict(data["versions"])
        return Manifest(data["commit"], str(data["sources"]), records, with_versions, str(data.get("made_at", "")))
    except OSError as error:
        line = f"{path}: {error.strerror}; heisoku manifest {folder} makes it at the end of make assure"
        raise ManifestError(line) from error
    except (ValueError, KeyError, TypeError) as error:
        raise ManifestError(f"{path}: is no manifest; heisoku manifest {folder} makes it anew") from error
