"""What git says of the source: of this repository, whatever others the environment names."""

from __future__ import annotations

import os
import subprocess
from pathlib import Path

WAITS_S = 60


def git(root: Path, *words: str) -> bytes | None:
    """What a command of git prints in a folder; none if there is no git, or no repository.

    ``GIT_DIR`` and its kin are left out: they would name another repository than the folder's own.
    """
    environment = {name: value for name, value in os.environ.items() if not name.startswith("GIT_")}
    asked = ["git", "-C", str(root), *words]
    try:
        return subprocess.run(asked, capture_output=True, check=True, timeout=WAITS_S, env=environment).stdout
    except (OSError, subprocess.SubprocessError):
        return None


def head(root: Path) -> str | None:
    """The commit that a folder is at, with ``+`` behind it if files differ from it; none if unknown.

    New files count, whatever is set; so does a file that git was told to take for unchanged, since nobody knows.
    """
    commit = git(root, "rev-parse", "HEAD")
    changed = git(root, "status", "--porcelain", "--untracked-files=all")
    marked = git(root, "ls-files", "-v")
    if commit is None or changed is None or marked is None:
        return None
    unseen = [line for line in marked.decode("utf-8", "replace").splitlines() if line[:1].islower() or line[:1] == "S"]
    return commit.decode().strip() + ("+" if changed.strip() or unseen else "")
