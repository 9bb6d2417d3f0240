"""What a reproduction gives back: rows of figures, sensitivities, series for pictures, and all of it as a record."""

from __future__ import annotations

import io
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np
from rich.console import Console
from rich.table import Table


@dataclass(frozen=True)
class Row:
    """One figure: the paper's and ours, as text with units.

    ``agrees``: by the criterion in ``criterion``, which stands in the source and not in the run; None where there is
    nothing to compare with.
    """

    what: str
    where: str
    paper: str
    ours: str
    agrees: bool | None
    criterion: str


@dataclass(frozen=True)
class Sensitivity:
    """How one result changes with one decisive parameter at -20 %, as it is, and at +20 %."""

    result: str
    parameter: str
    value: str
    less: str
    base: str
    more: str


@dataclass(frozen=True)
class Picture:
    """One picture: a scatter or lines with names, axes with units, and marks of the paper's figures.

    ``lines`` and ``points``: by name, x and y.  ``levels`` and ``places``: marks by name: one horizontal
    line or several, one vertical line.
    ``bars``: by name, the values of a histogram over common ``edges``.
    """

    name: str
    title: str
    x: str
    y: str
    lines: Mapping[str, tuple[Sequence[float], Sequence[float]]] = field(default_factory=dict)
    points: Mapping[str, tuple[Sequence[float], Sequence[float]]] = field(default_factory=dict)
    bars: Mapping[str, Sequence[float]] = field(default_factory=dict)
    edges: Sequence[float] = ()
    levels: Mapping[str, Sequence[float]] = field(default_factory=dict)
    places: Mapping[str, float] = field(default_factory=dict)


@dataclass(frozen=True)
class Reproduction:
    """One paper, reproduced.

    ``parameters``: what decides, with its value and why.  ``counts``: what was run, and how often.
    """

    paper: str
    title: str
    seed: int
    rows: tuple[Row, ...]
    sensitivities: tuple[Sensitivity, ...]
    pictures: tuple[Picture, ...]
    parameters: Mapping[str, str]
    counts: Mapping[str, int]

    @property
    def verdict(self) -> str:
        """Whether every row that can be compared agrees by its criterion."""
        return "does not hold" if any(row.agrees is False for row in self.rows) else "holds"

    def record(self) -> dict[str, object]:
        """The reproduction as it is written to a file; pictures by name."""
        return {
            "paper": self.paper,
            "verdict": self.verdict,
            "seed": self.seed,
            "rows": [vars(row) for row in self.rows],
            "sensitivities": [vars(each) for each in self.sensitivities],
            "parameters": dict(self.parameters),
            "counts": dict(self.counts),
            "pictures": [picture.name for picture in self.pictures],
            "numpy": np.__version__,
        }


AGREES = {True: "agrees", False: "DIFFERS", None: "-"}


def show(out: Console, found: Reproduction) -> None:
    """Print the tables: figures, sensitivities, parameters."""
    figures = Table(title=f"Paper {found.paper}, {found.title}; seed {found.seed}", title_justify="left")
    for column in ("what", "paper's place", "paper", "ours", "", "criterion"):
        figures.add_column(column, overflow="fold")
    for row in found.rows:
        figures.add_row(row.what, row.where, row.paper, row.ours, AGREES[row.agrees], row.criterion)
    out.print(figures)
    changes = Table(title="Ours, with one parameter changed", title_justify="left")
    for column in ("result", "parameter", "is", "at -20 %", "as it is", "at +20 %"):
        changes.add_column(column, overflow="fold")
    for each in found.sensitivities:
        changes.add_row(each.result, each.parameter, each.value, each.less, each.base, each.more)
    out.print(changes)
    why = Table(title="What decides, and why it is so", title_justify="left")
    why.add_column("parameter")
    why.add_column("value and reason", overflow="fold")
    for name, reason in found.parameters.items():
        why.add_row(name, reason)
    out.print(why)


def table_as_text(found: Reproduction) -> str:
    """The same tables as plain text, 160 columns wide, for a file beside the pictures."""
    text = io.StringIO()
    show(Console(width=160, file=text), found)
    return text.getvalue()


def share(part: int, of: int) -> str:
    """So many of so many, in per cent."""
    return f"{part} of {of} ({100 * part / of:.1f} %)" if of else "none"


def wilson(part: int, of: int) -> tuple[float, float]:
    """The 95 % interval of a share (Wilson)."""
    if of == 0:
        return 0.0, 1.0
    z, p = 1.96, part / of
    middle, spread = p + z * z / (2 * of), z * float(np.sqrt(p * (1 - p) / of + z * z / (4 * of * of)))
    return (middle - spread) / (1 + z * z / of), (middle + spread) / (1 + z * z / of)
