"""Planted faults, drawn by a stated seed: ``python -m fuzz.planted.draw [--seed S] [--count 30]``.

Each is a single drop in the kernel that a counterexample kills (``killed.toml``): at least one in each
machine that has any, and in each of the three loops; the rest by chance.
"""

from __future__ import annotations

import argparse
import ast
import sys
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path
from random import Random

from fuzz.planted.killed import killed, module_of, rows
from models.exit_codes import BAD_INPUT, HOLDS
from proofs.lift.sources import definition_of, file_of
from proofs.mutants.edits import Mutant, by_name, named
from proofs.mutated import Sources
from proofs.theories import THEORIES, theory_of

ROOT = Path(__file__).resolve().parents[2]
SEED = 4
COUNT = 30

LOOPS: Mapping[str, tuple[str, ...]] = {
    "first": ("kernel.first_loop", "kernel.route_setting"),
    "second": ("kernel.second_loop",),
    "third": ("kernel.tail_evidence", "kernel.release"),
}
"""The machines of each of the three loops (T4, T5, T6)."""

WORDS: Mapping[str, str] = {
    "guard": "`{}` is not asked",
    "and-operand": "`{}` is not asked, though all of it must hold",
    "or-operand": "`{}` no longer counts, though one of it is enough",
    "condition": "`{}` is taken for true",
    "choice": "`{}` is not asked: it is so",
    "filter": "`{}` filters nothing",
    "update": "`{}` is not written, or written the other way round",
    "union": "`{}` is left out of the union",
    "difference": "`{}` is not taken away",
    "part": "`{}` is not asked",
    "limit": "`{}` is taken without its limit",
    "sign": "`{}` keeps its sign",
    "rounding": "`{}` is rounded down",
    "term": "`{}` is left out of the sum",
    "constant": "another number: `{}`",
}
"""What a drop does, by its kind."""


@dataclass(frozen=True)
class Planted:
    """A fault planted in the kernel.

    ``name``: the mutant's.  ``file``, ``line``: where the drop is.  ``words``: what is dropped.
    ``row``: the step in which a counterexample shows it.
    """

    name: str
    file: str
    line: int
    words: str
    row: str

    @property
    def machine(self) -> str:
        """The module of the kernel it is in."""
        return module_of(self.name)

    @property
    def theory(self) -> str:
        """The theory in which a counterexample shows it: ``interlocking``, or a machine on board, or the link."""
        return self.row if self.row in THEORIES else theory_of(self.row)[0].name

    @property
    def loop(self) -> str:
        """Which of the three loops it is in; nothing for none."""
        return next((loop for loop, machines in LOOPS.items() if self.machine in machines), "")


def planted(name: str) -> Sources:
    """The kernel's functions with this fault, for CPython and for the compiled engine; ``KeyError`` if unknown."""
    return named(name).sources


def name_of(sources: Sources) -> str | None:
    """The name of the mutant that these sources are; none if they are no single one."""
    for function, tree in sources.items():
        for each in by_name(function).values() if len(sources) == 1 else ():
            if each.tree is tree or ast.unparse(each.tree) == ast.unparse(tree):
                return each.name
    return None


def described(name: str) -> Planted:
    """Everything that is said of a planted fault."""
    found = named(name)
    file = Path(file_of(found.function)).resolve()
    return Planted(
        name=name,
        file=file.relative_to(ROOT).as_posix(),
        line=line_of(found),
        words=f"in {found.function.__name__}: {WORDS[found.kind].format(found.text)}",
        row=rows().get(name, ""),
    )


def line_of(found: Mutant) -> int:
    """The line of the drop: the first at which the mutant's tree is another than the function's own."""
    own = definition_of(found.function)
    return _first_change(own, found.tree, own.lineno) or own.lineno


def _first_change(own: object, other: object, line: int) -> int | None:
    """Give the line of the first difference of two trees; none where they are alike."""
    if isinstance(own, ast.AST) and isinstance(other, ast.AST):
        line = getattr(own, "lineno", line)
        if type(own) is not type(other):
            return line
        pairs = [(getattr(own, field, None), getattr(other, field, None)) for field in own._fields]
    elif isinstance(own, list) and isinstance(other, list):
        pairs = list(zip(own, other, strict=False))
        if len(own) > len(other):
            pairs.append((own[len(other)], None))
    else:
        return None if own == other else getattr(own, "lineno", line)
    for one, two in pairs:
        changed = _first_change(one, two, line)
        if changed is not None:
            return changed
    return None


def drawn(seed: int = SEED, count: int = COUNT) -> tuple[Planted, ...]:
    """So many planted faults: one of every machine, and the rest by chance; the same for the same seed.

    ``ValueError`` if there are more machines than faults asked for, or fewer drops.
    """
    known = {machine: sorted(drops) for machine, drops in killed().items()}
    whole = sorted(rows())
    if not len(known) <= count <= len(whole):
        raise ValueError(f"a draw has {len(known)} faults at least, one for each machine, and {len(whole)} at most")
    random = Random(f"planted faults {seed}")
    names = [random.choice(known[machine]) for machine in sorted(known)]
    names += random.sample([name for name in whole if name not in names], count - len(names))
    return tuple(map(described, names))


def main(given: Iterable[str] | None = None) -> int:
    """Print a draw."""
    parser = argparse.ArgumentParser(prog="python -m fuzz.planted.draw", description=__doc__)
    parser.add_argument("--seed", type=int, default=SEED, metavar="S", help=f"of the draw; {SEED}")
    parser.add_argument("--count", type=int, default=COUNT, metavar="N", help=f"how many faults; {COUNT}")
    asked = parser.parse_args(None if given is None else list(given))
    try:
        faults = drawn(asked.seed, asked.count)
    except ValueError as error:
        print(f"--count {asked.count}: {error}", file=sys.stderr)
        return BAD_INPUT
    except KeyError as error:
        print(f"killed.toml: no mutant {error}; write it anew with python -m fuzz.planted.killed", file=sys.stderr)
        return BAD_INPUT
    for number, fault in enumerate(faults, 1):
        print(f"{number:3} {fault.name}\n    {fault.file}:{fault.line}: {fault.words}\n    shown by {fault.row}")
    machines, loops = {fault.machine for fault in faults}, {fault.loop for fault in faults} - {""}
    print(f"{len(faults)} faults of {len(rows())} by seed {asked.seed}: {len(machines)} machines, {len(loops)} loops")
    return HOLDS


if __name__ == "__main__":
    raise SystemExit(main())
