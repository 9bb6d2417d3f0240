"""Forgeries that were once not named before anything was made again."""

from __future__ import annotations

import os
from collections.abc import Callable
from pathlib import Path

from tests.evidence.forgeries import CERTIFIED, CHECKED, MUTATED, PROOF, Forgery, edited, replaced, set_to


def in_utf_16(folder: Path) -> None:
    (folder / CHECKED).write_text((folder / CHECKED).read_text("utf-8"), "utf-16")


def nested_without_end(folder: Path) -> None:
    (folder / "joints.json").write_text("[" * 200_000, "utf-8")


def a_fifo(folder: Path) -> None:
    (folder / CHECKED).unlink()
    os.mkfifo(folder / CHECKED)


def a_link_to(target: str) -> Callable[[Path], None]:
    """Put a link in the place of a record; to another name of itself, if ``target`` is one beside it."""

    def forge(folder: Path) -> None:
        if not target.startswith("/"):
            (folder / CHECKED).rename(folder.parent / target)
        else:
            (folder / CHECKED).unlink()
        (folder / CHECKED).symlink_to(Path(target) if target.startswith("/") else folder.parent / target)

    return forge


def no_obligations_but_a_number(folder: Path) -> None:
    (folder / "obligations").mkdir()
    edited(PROOF, set_to("obligations", value=7))(folder)


READ = (
    Forgery(
        "a verdict twice, refuted first",
        replaced(PROOF, '{"verdict": "proved"', '{"verdict": "refuted", "verdict": "proved"'),
        "unreadable",
        PROOF,
    ),
    Forgery("seconds that are no number", replaced(PROOF, '"seconds": 0.01', '"seconds": NaN'), "unreadable", PROOF),
    Forgery("seconds without end", replaced(PROOF, '"seconds": 0.01', '"seconds": 1e999'), "unreadable", PROOF),
    Forgery("a record in UTF-16", in_utf_16, "unreadable", CHECKED),
    Forgery("brackets without end", nested_without_end, "unreadable", "joints.json"),
    Forgery("a pattern that is none", edited(MUTATED, set_to("only", value="(")), "unreadable", MUTATED),
    Forgery(
        "certificates by a pattern that is none", edited(CERTIFIED, set_to("only", value="[")), "unreadable", CERTIFIED
    ),
    Forgery("a FIFO for a record", a_fifo, "no file", CHECKED),
    Forgery("a device for a record", a_link_to("/dev/zero"), "no file", CHECKED),
    Forgery("a link for a record", a_link_to("elsewhere.json"), "no file", CHECKED),
    Forgery("a number for a list", no_obligations_but_a_number, "unreadable", PROOF),
    Forgery("versions that are a list", edited(CHECKED, set_to("versions", value=[1])), "unreadable", CHECKED),
)
"""In how a file is read."""

LATER = (*READ,)
"""All of them."""
