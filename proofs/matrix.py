"""The matrix of transitions and invariants, one for each theory, readable at 120 columns.

A row a transition, a mark an invariant.  The invariants stand in groups, one for each file they
are written in, so that a column is found without counting far.  What is not proved is spelled out
below the matrix; what is proved is only counted.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from pathlib import PurePath

from rich.console import Console
from rich.text import Text

from proofs.records import CanarySeen, Obligation, Report, Verdict, overall, theory_of

MARK: Mapping[Verdict, tuple[str, str]] = {
    "proved": (".", "green"),
    "refuted": ("X", "bold red"),
    "undecided": ("?", "bold yellow"),
}
SPELLED_OUT_AT_MOST = 50
NAMES_AT_MOST = 44

Cell = list[Obligation]
Cells = dict[tuple[str, str], Cell]


def print_matrix(console: Console, report: Report) -> None:
    """Print a matrix for each theory, what the columns are, every cell that is not proved, and the totals."""
    theories = by_theory(report.obligations)
    for theory, obligations in theories.items():
        if len(theories) > 1:
            console.print(Text(f"\n{theory}" if theory != next(iter(theories)) else theory, style="bold underline"))
        print_theory(console, obligations)
    cells = cells_of(report.obligations)
    spell_out(console, [cell for cell in cells.values() if verdict_of(cell) != "proved"])
    for line in totals(report, theories):
        console.print(line, highlight=False, markup=False, soft_wrap=True)


def by_theory(obligations: Iterable[Obligation]) -> dict[str, list[Obligation]]:
    """The answers of each theory, in order."""
    found: dict[str, list[Obligation]] = {}
    for obligation in obligations:
        found.setdefault(theory_of(obligation["transition"])[0], []).append(obligation)
    return found


def print_theory(console: Console, obligations: Sequence[Obligation]) -> None:
    """Print the matrix of one theory, and what its columns are."""
    cells, groups = cells_of(obligations), groups_of(obligations)
    transitions = list(dict.fromkeys(obligation["transition"] for obligation in obligations))
    name_width = min(NAMES_AT_MOST, max(len(theory_of(name)[1]) for name in transitions))
    show(console, heading(groups, name_width))
    for transition in transitions:
        show(console, row(transition, groups, cells, name_width))
    for letter, (group, invariants) in zip(letters(len(groups)), groups.items(), strict=True):
        console.print(Text(f"{letter} {group}: {', '.join(invariants)}", style="dim"))


def cells_of(obligations: Iterable[Obligation]) -> Cells:
    """The answers to each question: one for every solver and seed it was put to."""
    cells: Cells = {}
    for obligation in obligations:
        cells.setdefault((obligation["transition"], obligation["invariant"]), []).append(obligation)
    return cells


def groups_of(obligations: Iterable[Obligation]) -> dict[str, list[str]]:
    """The invariants by the file they stand in, in the order in which they were asked."""
    groups: dict[str, list[str]] = {}
    for obligation in obligations:
        members = groups.setdefault(PurePath(obligation["source"]["file"]).stem, [])
        if obligation["invariant"] not in members:
            members.append(obligation["invariant"])
    return groups


def verdict_of(cell: Cell) -> Verdict:
    """The worst answer that any solver gave at any seed."""
    return overall([obligation["verdict"] for obligation in cell])


def letters(count: int) -> list[str]:
    """``count`` short names for groups: A to Z, then A2 and so on."""
    return [chr(ord("A") + index % 26) + (str(index // 26 + 1) if index >= 26 else "") for index in range(count)]


def heading(groups: Mapping[str, Sequence[str]], name_width: int) -> Text:
    """The line above the matrix: each group's letter over its first column."""
    line = " " * name_width
    for letter, invariants in zip(letters(len(groups)), groups.values(), strict=True):
        line += "  " + letter.ljust(len(invariants))
    return Text(line + "  proved  seconds", style="bold")


def row(transition: str, groups: Mapping[str, Sequence[str]], cells: Cells, name_width: int) -> Text:
    """One transition: its name, its marks, how many are proved, and the seconds spent on it."""
    own = theory_of(transition)[1]
    short = own if len(own) <= name_width else own[: name_width - 1] + "~"
    line = Text(short.ljust(name_width))
    mine = [cell for (name, _), cell in cells.items() if name == transition]
    for invariants in groups.values():
        line.append("  ")
        for invariant in invariants:
            cell = cells.get((transition, invariant))
            mark, style = MARK[verdict_of(cell)] if cell else (" ", "")
            line.append(mark, style=style)
    proved = sum(verdict_of(cell) == "proved" for cell in mine)
    seconds = sum(obligation["seconds"] for cell in mine for obligation in cell)
    line.append(f"  {proved:>3}/{len(mine):<3} {seconds:7.1f}", style="" if proved == len(mine) else "bold red")
    return line


def spell_out(console: Console, bad: Sequence[Cell]) -> None:
    """Say of each cell that is not proved what was asked, of whom, and where the invariant stands."""
    for cell in bad[:SPELLED_OUT_AT_MOST]:
        first = cell[0]
        verdict = verdict_of(cell)
        begin, end = first["source"]["lines"]
        console.print()
        console.print(Text(f"{first['transition']} × {first['invariant']}: {verdict}", style=MARK[verdict][1]))
        console.print(f"  invariant at {first['source']['file']}:{begin}-{end}", highlight=False, markup=False)
        console.print(f"  hypotheses: {', '.join(first['hypotheses']) or 'none'}", highlight=False, markup=False)
        for answer in cell:
            console.print(
                f"  {answer['solver']} {answer['solver_version']} seed {answer['seed']}: {answer['verdict']},"
                f" rlimit {answer['rlimit_spent']:,} of {answer['rlimit']:,}, {answer['seconds']:.1f} s"
                + (f"; {answer['note']}" if "note" in answer else ""),
                highlight=False,
                markup=False,
            )
    if len(bad) > SPELLED_OUT_AT_MOST:
        console.print(f"... and {len(bad) - SPELLED_OUT_AT_MOST} more; --json F writes all of them", highlight=False)


def totals(report: Report, theories: Mapping[str, Sequence[Obligation]]) -> list[str]:
    """How many things were checked, with what result, and how long it took: of each theory, and over all."""
    cells = cells_of(report.obligations)
    solvers = sorted({f"{obligation['solver']} {obligation['solver_version']}" for obligation in report.obligations})
    seeds = {obligation["seed"] for obligation in report.obligations}
    lines = [
        "",
        *(f"{theory}: {counted(obligations)}" for theory, obligations in theories.items() if len(theories) > 1),
        counted(report.obligations),
        *_empty(cells),
        f"{len(report.obligations)} answers from {' and '.join(solvers) or 'no solver'} at {len(seeds)} seeds",
        *on_kept(report),
        *on_canaries(report.canaries),
        *(f"{offence}: what rests on it is not proved" for offence in report.offences),
        f"lifting {report.lifting_seconds:.1f} s, wall {report.wall_seconds:.1f} s",
    ]
    split = sum(len({answer["verdict"] for answer in cell}) > 1 for cell in cells.values())
    if split:
        lines.insert(-1, f"{split} obligations on which solvers or seeds differ")
    return lines


def _empty(cells: Cells) -> list[str]:
    """How many cells there are in which nothing was asked."""
    empty = sum(all("note" in answer for answer in cell) for cell in cells.values())
    return [f"in {empty} of them nothing is looked up, so nothing was asked"] * bool(empty)


def on_kept(report: Report) -> list[str]:
    """How many answers nobody was asked for in this run."""
    line = f"{len(report.obligations):,} answers, {report.kept:,} of them kept from earlier runs, which are no evidence"
    return [line] * bool(report.kept)


def on_canaries(seen: Sequence[CanarySeen]) -> list[str]:
    """Whether each solver saw what does not hold; whatever it says is worth nothing where it did not."""
    missed = [each for each in seen if not each["noticed"]]
    if not missed:
        processes = len({each["process"] for each in seen})
        count = len({each["canary"] for each in seen})
        return [f"{count} canaries put to the solvers in {processes} processes, none missed"] * bool(seen)
    return [
        f"{each['solver']} {each['solver_version']} in process {each['process']} answers {each['answer']}"
        f" to what does not hold, {each['canary']}: nothing that it proved is believed"
        for each in missed
    ]


def counted(obligations: Sequence[Obligation]) -> str:
    """How many rows, columns and obligations there are, and what became of them."""
    cells = cells_of(obligations)
    verdicts = [verdict_of(cell) for cell in cells.values()]
    rows = len({transition for transition, _ in cells})
    columns = len({(theory_of(transition)[0], invariant) for transition, invariant in cells})
    return f"{rows} rows × {columns} columns: {len(cells)} obligations, " + ", ".join(
        f"{verdicts.count(verdict)} {verdict}" for verdict in MARK
    )


def show(console: Console, line: Text) -> None:
    """Print a line of the matrix unbroken, however narrow the terminal is."""
    console.print(line, soft_wrap=True)
