"""The joints between machines: what the proof of one guarantees and that of another assumes (``joints.toml``).

The tables of ``docs/contracts.md`` are written from them, and ``heisoku prove --whole`` follows them from the
theorem down to nature.
"""

from __future__ import annotations

import re
import tomllib
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from importlib.resources import files

from models.shipped import shipped

PAGE = shipped("docs/contracts.md")
HEAD = ("| link | guaranteed by | assumed in | what watches it at run time |", "|---|---|---|---|")
TABLE = re.compile(r"(<!-- joints: (\w+) -->\n).*?(<!-- end -->)", re.DOTALL)
BY_NAME = "by name"
"""Two names beside each other, each proved in its own world: that they say the same is read, not proved."""
SAME_FUNCTION = "the same function"
"""The function that one theory assumes, or what it says of the train, is what the other proves."""


@dataclass(frozen=True)
class Joint:
    """One row of the page.

    ``guaranteed``: invariants, ``assumed``: assumptions that they discharge, each as theory and name.
    ``tied``: how an assumption is tied to its guarantee: the theory in whose state both are, ``SAME_FUNCTION``, or else
    ``BY_NAME``.
    """

    part: str
    link: str
    guaranteed: tuple[str, ...]
    assumed: tuple[str, ...]
    tied: Mapping[str, str]
    remark: str
    watched: str

    def tie(self, assumption: str) -> str:
        """Give how one of its assumptions is tied."""
        return self.tied.get(assumption, BY_NAME)

    def row(self) -> str:
        """Give it as a row of a table."""
        assumed = " ".join(filter(None, (_listed(self.assumed), self.remark)))
        return f"| {self.link} | {_listed(self.guaranteed)} | {assumed} | {self.watched} |"


def _listed(names: tuple[str, ...]) -> str:
    return ", ".join(f"`{name}`" for name in names)


@cache
def joints() -> tuple[Joint, ...]:
    """Read the joints, in the order of the page."""
    data = tomllib.loads(files("proofs").joinpath("joints.toml").read_text("utf-8"))
    return tuple(
        Joint(
            each["part"],
            each["link"],
            tuple(each["guaranteed"]),
            tuple(each["assumed"]),
            each.get("tied", {}),
            each.get("remark", ""),
            each["watched"],
        )
        for each in data["joint"]
    )


@cache
def discharged() -> Mapping[str, Joint]:
    """Give the joint that discharges an assumption, by theory and name."""
    return {name: joint for joint in joints() for name in joint.assumed}


def page() -> str:
    """Give the page with its tables written anew; its prose stands in it."""

    def table(found: re.Match[str]) -> str:
        rows = [joint.row() for joint in joints() if joint.part == found[2]]
        return found[1] + "\n".join((*HEAD, *rows)) + "\n" + found[3]

    return TABLE.sub(table, PAGE.read_text("utf-8"))
