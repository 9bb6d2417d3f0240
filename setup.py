"""Lays the files that belong to no package into what is installed (models/shipped.py); all else: pyproject.toml."""

from __future__ import annotations

import shutil
from pathlib import Path

from setuptools import setup
from setuptools.command.build_py import build_py

SHIPPED = ("layouts/*.toml", "layouts/*.json", "docs/*.md", "SAFETY_CASE.md")


class WithPages(build_py):  # type: ignore[misc]
    """Build the packages, and beside them what they read from the top of the repository."""

    def run(self) -> None:
        """Build; an editable installation reads all of it where it stands."""
        super().run()
        if self.editable_mode:
            return
        top = Path(__file__).parent
        for source in (path for pattern in SHIPPED for path in sorted(top.glob(pattern))):
            target = Path(self.build_lib, "models", "shipped", source.relative_to(top))
            target.parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(source, target)


setup(cmdclass={"build_py": WithPages})
