"""The chain from the theorem down to nature, as the proofs' own dependencies have it: ``heisoku prove --whole``.

The claims that the theorem asks of a theory rest on some of its invariants, by the proof scripts, and these on axioms
and premises, by the scripts again, and on what its steps ask of nature, by the recorded unsat cores of their proofs;
what is said to stand beside the theorem is shown to by ``heisoku mutate --joints``.
What another theory guarantees is followed there, by the joints of :mod:`proofs.joints`; the rest is assumed of nature,
people and sites, and each has its owner.  Without a record of cores, all that the steps ask is told as rested on.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping, Sequence, Set
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from rich.console import Console
from rich.text import Text
from rich.tree import Tree

from models.shipped import is_installed
from proofs import assumptions, usage
from proofs.catalogue import INTERLOCKING
from proofs.joints import BY_NAME, SAME_FUNCTION, discharged
from proofs.lints_on_board import assumptions as asked_on_board
from proofs.matrix import by_theory
from proofs.reach import called_by
from proofs.records import Report, commit, overall
from proofs.theories import THEORIES, row_of, theory_of
from proofs.theory import Theory

CORES = (Path() if is_installed() else assumptions.ROOT) / "out" / "cores.json"
"""What ``python -m proofs.cores --json out/cores.json`` leaves; of another commit it tells nothing."""
THEOREM = ("occupancy", "train")
"""The theories whose claims are the theorem: of all trains on the line, and of each alone, both in millimetres."""
IN_WORDS = (
    "no two trains touch, no point moves under one, none is beyond the end of its authority, and none is faster than"
    " permitted by more than it gains until its brake responds"
)


@dataclass(frozen=True)
class Link:
    """One assumption of a theory, as ``theory.name``.

    ``guaranteed``: the invariants that discharge it; none: it is of nature.  ``tie``: how they are tied to it.
    ``rested_on``: some proof of the chain rests on it.
    """

    assumption: str
    guaranteed: tuple[str, ...]
    tie: str
    rested_on: bool = True


@dataclass(frozen=True)
class Chain:
    """What the theorem rests on: the links of each theory that it comes to, in the order in which it does.

    ``asked``: what the chain asks of each theory.  ``by_cores``: the theories of which cores
    on record tell what of nature their proofs rest on; of the others all that steps ask is told.
    """

    links: Mapping[str, Sequence[Link]] = field(default_factory=dict)
    asked: Mapping[str, Sequence[str]] = field(default_factory=dict)
    by_cores: Sequence[str] = ()

    @property
    def nature(self) -> list[str]:
        """What is discharged by no proof, and rested on by some."""
        return [link.assumption for link in self._all if not link.guaranteed and link.rested_on]

    @property
    def idle(self) -> list[str]:
        """What is assumed, and used by no proof of the chain."""
        return [link.assumption for link in self._all if not link.rested_on]

    @property
    def _all(self) -> list[Link]:
        return [link for links in self.links.values() for link in links]

    def tied(self, tie: str) -> list[Link]:
        """Give the links that are tied in this way."""
        return [link for link in self._all if link.rested_on and link.guaranteed and link.tie == tie]


Cores = Sequence[Mapping[str, Any]]
"""The obligations of a record of cores."""


def recorded() -> Cores:
    """Read the cores on record; none of another commit."""
    try:
        found = json.loads(CORES.read_text("utf-8"))
        obligations: Cores = found["obligations"] if found["commit"] == commit() else ()
    except (OSError, ValueError, KeyError, TypeError):
        return ()
    return obligations


def site_assumed(theory: Theory, below: frozenset[str]) -> list[str]:
    """Give the axioms and premises that are among what claims rest on."""
    return [name for name in (*theory.axioms, *theory.premises) if name in below]


def of_steps(theory: Theory) -> Mapping[str, Callable[..., Any] | None]:
    """Give what the steps of a theory ask of nature, by name; what is built into its world is no predicate."""
    if theory is not INTERLOCKING:
        return asked_on_board(theory)
    functions = assumptions.predicates()["world"]
    asked = [each.name for each in assumptions.read() if each.kind in ("world", "built_in")]
    return {name: functions.get(name) for name in asked}


def assumed(theory: Theory) -> list[str]:
    """Give what a theory assumes: what its steps ask of nature, and those axioms and premises that its proofs use."""
    used = usage.needed(usage.book(theory), theory.claimed)
    return [*of_steps(theory), *site_assumed(theory, used)]


def _used(theory: Theory, claims: frozenset[str], cores: Cores) -> frozenset[str] | None:
    """Give what steps ask that stands in a core of what claims rest on.

    None where cores cannot tell it: some obligation of theirs has none on record, or not of each of its parts.
    """
    below = usage.needed(usage.book(theory), claims)
    mine = [each for each in cores if theory_of(each["transition"])[0] is theory and each["invariant"] in below]
    asked = {(row_of(theory, step), name) for step in theory.steps for name in theory.invariants if name in below}
    if asked - {(each["transition"], each["invariant"]) for each in mine} or any(each["open"] for each in mine):
        return None
    guards = {guard for each in mine for guard in each["guards"]}
    return frozenset(name for name, asks in of_steps(theory).items() if asks is None or _stands_in(asks, guards))


def _stands_in(assumption: Callable[..., Any], guards: Set[str]) -> bool:
    """Tell whether a condition of a core is said in an assumption, or in what it is made of, or asks it by name."""
    said = {f"{each.__module__}.{each.__name__}" for each in (assumption, *called_by(assumption))}
    return any(guard.partition(": ")[0] in said or f"{assumption.__name__}(" in guard for guard in guards)


def chain(cores: Cores | None = None) -> Chain:
    """Follow the theorem through every joint; ``cores``: those on record, unless others are given."""
    told = recorded() if cores is None else cores
    asked: dict[str, dict[str, None]] = {name: dict.fromkeys(THEORIES[name].claimed) for name in THEOREM}
    links: dict[str, list[Link]] = {}
    known = -1
    while known < sum(map(len, asked.values())):
        known = sum(map(len, asked.values()))
        links = {name: _links(THEORIES[name], frozenset(claims), told) for name, claims in asked.items()}
        for link in (link for each in links.values() for link in each if link.rested_on):
            for claim in link.guaranteed:
                asked.setdefault(_theory(claim), {})[claim.partition(".")[2]] = None
    by_cores = [name for name, claims in asked.items() if _used(THEORIES[name], frozenset(claims), told) is not None]
    return Chain(links, {name: list(claims) for name, claims in asked.items()}, by_cores)


def _links(theory: Theory, claims: frozenset[str], cores: Cores) -> list[Link]:
    """Give the links of a theory of which these are asked."""
    below = usage.needed(usage.book(theory), claims)
    used = _used(theory, claims, cores)
    resting = {*site_assumed(theory, below), *(of_steps(theory) if used is None else used)}
    if theory is INTERLOCKING:
        resting -= assumptions.beside()
    return [_link(f"{theory.name}.{name}", name in resting) for name in assumed(theory)]


def _link(assumption: str, rested_on: bool) -> Link:
    joint = discharged().get(assumption)
    if joint is None:
        return Link(assumption, (), "", rested_on)
    return Link(assumption, joint.guaranteed, joint.tie(assumption), rested_on)


def _theory(name: str) -> str:
    return name.partition(".")[0]


def print_chain(console: Console, report: Report) -> None:
    """Print the chain as a tree, with what was proved of each theory in it, and how many links are tied how."""
    found, proved = chain(), _proved(report)
    root, shown = Tree(IN_WORDS), set[str]()
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
    of_nature = [link for link in found.links[name] if not link.guaranteed and link.rested_on]
    idle = [link for link in found.links[name] if not link.rested_on]
    for link in found.links[name]:
        if link.guaranteed and link.rested_on:
            joint = branch.add(Text(f"{_name(link)}: {', '.join(link.guaranteed)} ({tie_said(link.tie)})"))
            for theory in dict.fromkeys(map(_theory, link.guaranteed)):
                _grow(joint, theory, found, proved, shown)
    if of_nature:
        branch.add(Text(f"of nature, people and site: {', '.join(map(_name, of_nature))}", style="dim"))
    if idle:
        branch.add(Text(f"assumed and used by no proof of the chain: {', '.join(map(_name, idle))}", style="dim"))


def _name(link: Link) -> str:
    return link.assumption.partition(".")[2]


def tie_said(tie: str) -> str:
    """Say how an assumption is tied to its guarantee."""
    if tie == SAME_FUNCTION:
        return "what is assumed is the function that is proved"
    return "tied by name alone" if tie == BY_NAME else f"proved of one state in {tie}"


def counted(found: Chain) -> list[str]:
    """Say how many theories and links there are, how they are tied, and how much is left to nature."""
    ties = dict.fromkeys(
        link.tie for links in found.links.values() for link in links if link.guaranteed and link.rested_on
    )
    how = f"what steps ask of nature is told by the unsat cores on record in {len(found.by_cores)} theories"
    how += "" if len(found.by_cores) == len(found.links) else ", as all that they ask in the others"
    return [
        f"{len(found.links)} theories, {sum(map(len, found.links.values()))} assumptions",
        *(f"{len(found.tied(tie))} discharged: {tie_said(tie)}" for tie in sorted(ties)),
        f"{len(found.nature)} of nature, people and site: docs/assumptions.md has each one's monitor and duty",
        f"{len(found.idle)} assumed and used by no proof of the chain; {how}",
    ]
