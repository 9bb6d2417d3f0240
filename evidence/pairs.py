"""Assumptions that would be broken unnoticed together: ``python -m evidence.pairs``.

An assumption whose monitor is a machine of the kernel is covered while that machine's own assumptions hold.  Broken
together with one of these, nothing in the kernel notices.  Where two machines watch, one broken assumption of each
would have to come together.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from itertools import product

from evidence.case import read_case
from proofs.assumptions import Assumption, asking, proofs_naming, read
from proofs.lints_on_board import OTHERS
from proofs.lints_on_board import asking as asking_on_board
from proofs.theories import THEORIES

MACHINE = re.compile(r"`(\w+)`")
CHOSEN = "none"
"""Bounds that are chosen, and what is surveyed, do not break by chance beside something else."""


@dataclass(frozen=True)
class Together:
    """``first`` breaks, and the machines that watch it are blind, since the ``others`` are broken too.

    ``rests``: how many transitions, or proofs, rest on the first.
    """

    first: str
    others: tuple[str, ...]
    rests: int


def together() -> list[Together]:
    """What would go unnoticed together: the fewest at once first, then those on which most rests."""
    known = read()
    chosen = {name for duty in read_case().duties if duty.rate == CHOSEN for name in duty.assumptions}
    found = []
    for one in known:
        watching = [name for name in dict.fromkeys(MACHINE.findall(one.monitor)) if name in THEORIES]
        blinding = [
            [
                f"{each.kind}.{each.name}"
                for each in known
                if each.kind == machine and f"{machine}.{each.name}" not in chosen
            ]
            for machine in watching
        ]
        if blinding:
            found += [Together(f"{one.kind}.{one.name}", others, rests_on(one)) for others in product(*blinding)]
    return sorted(found, key=lambda each: (len(each.others), -each.rests, each.first, each.others))


def unwatched() -> list[str]:
    """Assumptions that no machine of the kernel watches: one breach is enough, and something else must find it."""
    return [
        f"{one.kind}.{one.name}" for one in read() if not any(name in THEORIES for name in MACHINE.findall(one.monitor))
    ]


def rests_on(one: Assumption) -> int:
    """How many transitions ask an assumption, or how many proofs name it."""
    if one.kind == "world":
        return len(asking(one.name))
    if one.kind == "built_in":
        return len(one.stands_in)
    if one.kind in OTHERS and one.name not in OTHERS[one.kind].premises:
        return len(asking_on_board(OTHERS[one.kind], one.name))
    return len(proofs_naming(one.name, OTHERS[one.kind]) if one.kind in OTHERS else proofs_naming(one.name))


def main() -> None:
    """Print them."""
    found = together()
    for each in found:
        print(f"{each.first} (on which {each.rests} rest) with {' and '.join(each.others)}")
    print(f"{len(found)} together; {len(unwatched())} assumptions that no machine of the kernel watches")


if __name__ == "__main__":
    main()
