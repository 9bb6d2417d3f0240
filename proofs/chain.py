"""The chain from the theorem down to nature, as the proofs' own dependencies have it: ``heisoku prove --whole``.

A theory's claims rest on its invariants and on what it assumes.  What another theory guarantees is followed there, by
the joints of :mod:`proofs.joints`; the rest is assumed of nature, people and sites, and each has its owner.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

from rich.console import Console
from rich.text import Text
from rich.tree import Tree

from proofs import assumptions, usage
from proofs.catalogue import INTERLOCKING
from proofs.joints import BY_NAME, SAME_FUNCTION, discharged
from proofs.lints_on_board import assumptions as asked_on_board
from proofs.matrix import by_theory
from proofs.records import Report, overall
from proofs.theories import THEORIES
from proofs.theory import Theory

THEOREM = ("occupancy", "train")
"""The theories whose claims are the theorem: of all trains on the line, and of each alone, both in millimetres."""


@dataclass(frozen=True)
class Link:
    """One assumption of a theory, as ``theory.name``.

    ``guaranteed``: the invariants that discharge it; none: it is of nature.  ``tie``: how they are tied to it.
    """

    assumption: str
    guaranteed: tuple[str, ...]
    tie: str


@dataclass(frozen=True)
class Chain:
    """What the theorem rests on: the links of each theory that it comes to, in the order in which it does."""

    links: Mapping[str, Sequence[Link]] = field(default_factory=dict)

    @property
    def nature(self) -> list[str]:
        """What is discharged by no proof."""
        return [link.assumption for links in self.links.values() for link in links if not link.guaranteed]

    def tied(self, tie: str) -> list[Link]:
        """Give the links that are tied in this way."""
        return [link for links in self.links.values() for link in links if link.guaranteed and link.tie == tie]


def assumed(theory: Theory) -> list[str]:
    """Give what a theory assumes: what its steps ask of nature, and those axioms and premises that its proofs use."""
    used = usage.needed(usage.book(theory), theory.claimed)
    of_site = [name for name in (*theory.axioms, *theory.premises) if name in used]
    if theory is not INTERLOCKING:
        return [*asked_on_board(theory), *of_site]
    asked = [each.name for each in assumptions.read() if each.kind in ("world", "built_in")]
    return [*asked, *of_site]


def chain() -> Chain:
    """Follow the theorem through every joint."""
    links: dict[str, list[Link]] = {}
    todo = list(THEOREM)
    while todo:
        name = todo.pop(0)
        if name in links:
            continue
        links[name] = [_link(f"{name}.{each}") for each in assumed(THEORIES[name])]
        todo += [_theory(claim) for link in links[name] for claim in link.guaranteed]
    return Chain(links)


def _link(assumption: str) -> Link:
    joint = discharged().get(assumption)
    return Link(assumption, () if joint is None else joint.guaranteed, "" if joint is None else joint.tie(assumption))


def _theory(name: str) -> str:
    return name.partition(".")[0]


def print_chain(console: Console, report: Report) -> None:
    """Print the chain as a tree, with what was proved of each theory in it, and how many links are tied how."""
    found, proved = chain(), _proved(report)
    root, shown = (
        Tree("no two trains touch, no point moves under one, and none is beyond the end of its authority"),
        set[str](),
    )
    for name in THEOREM:
        _grow(root, name, found, proved, shown)
    console.print(root)
    for line in counted(found):
        console.print(line, highlight=False, markup=False, soft_wrap=True)


def _proved(report: Report) -> Mapping[str, Text]:
    """Say of each theory how many of its obligations were proved, whatever was asked how often."""
    said = {}
    for name, answers in by_theory(report.obligations).items():
        cells: dict[tuple[str, str], list[str]] = {}
        for each in answers:
            cells.setdefault((each["transition"], each["invariant"]), []).append(each["verdict"])
        held = sum(set(each) == {"proved"} for each in cells.values())
        verdict = overall([each["verdict"] for each in answers])
        style = "green" if verdict == "proved" else "bold red"
        said[name] = Text(f"{held} of {len(cells)} obligations proved", style=style)
    return said


def _grow(tree: Tree, name: str, found: Chain, proved: Mapping[str, Text], shown: set[str]) -> None:
    """Grow the branch of a theory; one that was shown before is only named."""
    said = Text.assemble((name, "bold"), ": ", proved.get(name, Text("not asked", style="bold yellow")))
    if name in shown:
        tree.add(Text.assemble((name, "bold"), " (above)"))
        return
    shown.add(name)
    branch = tree.add(said)
    of_nature = [link for link in found.links[name] if not link.guaranteed]
    for link in found.links[name]:
        if link.guaranteed:
            joint = branch.add(Text(f"{_name(link)}: {', '.join(link.guaranteed)} ({tie_said(link.tie)})"))
            for theory in dict.fromkeys(map(_theory, link.guaranteed)):
                _grow(joint, theory, found, proved, shown)
    if of_nature:
        branch.add(Text(f"of nature, people and site: {', '.join(map(_name, of_nature))}", style="dim"))


def _name(link: Link) -> str:
    return link.assumption.partition(".")[2]


def tie_said(tie: str) -> str:
    """Say how an assumption is tied to its guarantee."""
    if tie == SAME_FUNCTION:
        return "what is assumed is the function that is proved"
    return "tied by name alone" if tie == BY_NAME else f"proved of one state in {tie}"


def counted(found: Chain) -> list[str]:
    """Say how many theories and links there are, how they are tied, and how much is left to nature."""
    ties = dict.fromkeys(link.tie for links in found.links.values() for link in links if link.guaranteed)
    return [
        f"{len(found.links)} theories, {sum(map(len, found.links.values()))} assumptions",
        *(f"{len(found.tied(tie))} discharged: {tie_said(tie)}" for tie in sorted(ties)),
        f"{len(found.nature)} of nature, people and site: docs/assumptions.md has each one's monitor and duty",
    ]
