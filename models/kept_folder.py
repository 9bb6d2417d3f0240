"""Where what is worth keeping from one run for the next lies: the user's cache."""

from __future__ import annotations

import os
from pathlib import Path


def kept_folder(name: str) -> Path | None:
    """The folder of a name in the user's cache, made if it is not there; none where nothing can be written.

    Whatever lies there may be deleted at any time: it is only what takes a while to make anew.
    """
    try:
        cache = os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache"
        folder = Path(cache) / "heisoku" / name
        folder.mkdir(parents=True, exist_ok=True)
    except (OSError, RuntimeError):
        return None
    return folder if os.access(folder, os.W_OK) else None
