"""Where the files stand that belong to no package: layouts, pages, the safety case."""

from __future__ import annotations

from pathlib import Path

PACKAGES = Path(__file__).resolve().parent.parent
"""The folder of all packages: the top of a checkout, or where they were installed."""
INSTALLED = PACKAGES / "models" / "shipped"
"""Where ``setup.py`` lays these files in what is installed; in a checkout there is no such folder."""


def is_installed() -> bool:
    """Tell whether this is an installed copy: its folder is shared with other people's packages."""
    return INSTALLED.is_dir()


def shipped(name: str) -> Path:
    """The place of a file or folder named as from the top of the repository, ``docs/glossary.md``."""
    return (INSTALLED if is_installed() else PACKAGES) / name
