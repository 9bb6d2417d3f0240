"""The chain from the theorem down to nature as shapes: theories below what they guarantee, links as they are tied.

A box is a theory with what the chain asks of it; a line leads to it from each assumption that it discharges: double
where what is assumed is the function that is proved, single where both are proved of one state, dashed by name alone.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

from evidence.records.showing import Came, Shown
from evidence.report.goals import worst
from evidence.report.words import wrapped
from proofs.chain import THEOREM, Chain, Link, tie_said
from proofs.joints import BY_NAME, SAME_FUNCTION

WIDTH, INDENT, LEFT = 900, 46, 18
LINE, PAD, GAP = 15, 8, 12
CHARACTER = 6.3
"""A character's width, of text of 12 px."""


@dataclass(frozen=True)
class Node:
    """A theory: where it stands, its name, what is said of it, and what the record has of what is asked of it."""

    x: float
    y: float
    width: float
    height: float
    title: str
    lines: tuple[str, ...]
    came: Came


@dataclass(frozen=True)
class Tie:
    """A link: its path, how it is tied, and its text beside it, the assumptions first."""

    kind: str
    path: str
    x: float
    y: float
    lines: tuple[tuple[str, str], ...]


@dataclass
class ChainDrawing:
    """All shapes."""

    width: int = WIDTH
    height: float = 0
    nodes: list[Node] = field(default_factory=list)
    ties: list[Tie] = field(default_factory=list)
    spines: list[str] = field(default_factory=list)


KINDS = {SAME_FUNCTION: "function", BY_NAME: "name"}
"""How a link is drawn; one that is proved of one state is a ``state``."""


def drawn_chain(chain: Chain, shown: Mapping[str, Shown]) -> ChainDrawing:
    """Draw it."""
    drawing, met = ChainDrawing(), set[str]()
    y = 6.0
    for name in THEOREM:
        if name not in met:
            y = _theory(drawing, chain, shown, name, LEFT, y, met) + GAP
    drawing.height = y
    return drawing


def _theory(
    drawing: ChainDrawing, chain: Chain, shown: Mapping[str, Shown], name: str, x: float, y: float, met: set[str]
) -> float:
    """Draw a theory with all that it rests on, and give where that ends."""
    met.add(name)
    links = [link for link in chain.links[name] if link.rested_on]
    asked = [f"prove:{name}.{claim}" for claim in chain.asked[name]]
    came = worst(iter([shown[each].verdict if each in shown else "not shown" for each in asked]))
    nature = sum(not link.guaranteed for link in links)
    said = f"of its invariants {len(asked)} are asked; {nature} assumptions of nature, people and site"
    title = f"{name}: {came}"
    drawing.nodes.append(Node(x, y, WIDTH - x - LEFT, 2 * LINE + PAD, title, (said,), came))
    begins, y = y + 2 * LINE + PAD, y + 2 * LINE + PAD
    last = begins
    for joint in _grouped(links):
        y += GAP
        last = y + PAD
        guaranteeing = dict.fromkeys(each.partition(".")[0] for each in joint[0].guaranteed)
        y = _link(drawing, joint, x + INDENT / 2, y, [each for each in guaranteeing if each in met])
        for below in (each for each in guaranteeing if each not in met):
            y = _theory(drawing, chain, shown, below, x + INDENT, y + 4, met)
    if last > begins:
        drawing.spines.append(f"M{x + INDENT / 2:g} {begins:g}V{last:g}")
    return y


def _grouped(links: Sequence[Link]) -> list[list[Link]]:
    """Put together what is discharged by the same guarantees in the same way."""
    found: dict[tuple[tuple[str, ...], str], list[Link]] = {}
    for link in links:
        if link.guaranteed:
            found.setdefault((link.guaranteed, link.tie), []).append(link)
    return list(found.values())


def _link(drawing: ChainDrawing, joint: Sequence[Link], x: float, y: float, above: Sequence[str]) -> float:
    """Draw a link from the spine, and give where its text ends; ``above``: theories that are drawn already."""
    characters = int((WIDTH - x - INDENT - LEFT) / CHARACTER)
    assumed = ", ".join(link.assumption.partition(".")[2] for link in joint)
    guaranteed = f"by {', '.join(joint[0].guaranteed)}: {tie_said(joint[0].tie)}"
    guaranteed += f" ({' and '.join(above)} above)" if above else ""
    lines = [("assumed", each) for each in wrapped(f"assumes {assumed}", characters)]
    lines += [("guaranteed", each) for each in wrapped(guaranteed, characters)]
    kind = KINDS.get(joint[0].tie, "state")
    drawing.ties.append(Tie(kind, f"M{x:g} {y + PAD:g}H{x + INDENT - 6:g}", x + INDENT, y, tuple(lines)))
    return y + LINE * len(lines) + 4
