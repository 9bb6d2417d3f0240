"""Whatever a text is made of is in its digest: another text never has the same one."""

from __future__ import annotations

import ast
import random
import shutil
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

import models.sources
from proofs import contents, run, scripts
from proofs.lift import sources
from proofs.lift.sources import Code, definition_of
from proofs.planted.changes import Change, Planted, changes, planted
from proofs.theories import THEORIES, columns, row_of, theory_of
from proofs.theory import Theory
from proofs.workbench import Workbench

ROOT = Path(__file__).parents[2]
Cell = tuple[str, str]


@pytest.fixture
def tree(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Path]:
    """A copy of the sources, of which digests are made."""
    for name in models.sources.READ:
        shutil.copytree(ROOT / name, tmp_path / name, ignore=shutil.ignore_patterns("__pycache__"))
    for each in (contents, models.sources):
        monkeypatch.setattr(each, "ROOT", tmp_path)
    monkeypatch.setattr(scripts, "FOLDER", tmp_path / "proofs" / "scripts")
    forget()
    yield tmp_path
    forget()


def forget() -> None:
    for each in (contents.file_of, contents.module, contents._happening, contents._of):
        each.cache_clear()
    contents._of_everything.cache_clear()
    contents.whole.cache_clear()
    scripts.script.cache_clear()


def keys(*theories: str) -> dict[Cell, str | None]:
    """The digests of all obligations of theories, from the sources as they stand now."""
    forget()
    rows = [row_of(THEORIES[name], row) for name in theories for row in THEORIES[name].rows]
    return {(row, column): contents.key_of(row, column) for row in rows for column in columns(row)}


def edited(tree: Path, file: str, old: str, new: str) -> None:
    path = tree / file
    text = path.read_text("utf-8")
    assert text.count(old) == 1, (file, old)
    path.write_text(text.replace(old, new), "utf-8")


def others(before: dict[Cell, str | None], after: dict[Cell, str | None]) -> set[Cell]:
    assert set(before) == set(after)
    return {cell for cell, key in before.items() if key != after[cell]}


# ---- what is in it


def test_every_obligation_has_a_digest_of_its_own() -> None:
    found = [contents.key_of(row, column) for row in ("request", "braking.init") for column in columns(row)]
    assert None not in found
    assert len(set(found)) == len(found)


def lifted_by(made: Planted, theory: Theory) -> set[Cell]:
    """The obligations that are lifted from what a change makes another, by calls and by who reads a constant."""
    found = set()
    for name in theory.rows:
        row = row_of(theory, name)
        step = name in theory.steps and made.touches(theory.steps[name])
        for column in theory.columns(name):
            said = column in theory.read and made.touches(theory.read[column])
            if step or said or any(made.touches(theory.read[each]) for each in scripts.hypotheses(row, column)):
                found.add((row, column))
    return found


def drawn(count: int) -> list[Change]:
    """Changes of small theories, and one of the interlocking."""
    small = [each for each in changes().values() if not {"train", "interlocking"} & set(each.theories)]
    return [*random.Random(7).sample(small, count), changes()["wrong_epoch"]]


@pytest.mark.sampled(3)
@pytest.mark.parametrize("change", drawn(4), ids=lambda each: each.name)
def test_a_changed_kernel_changes_the_digest_of_whatever_is_lifted_from_it(change: Change, tree: Path) -> None:
    made, of = planted(change), change.theories
    before = keys(*of)
    edited(tree, change.file, change.old, change.new)
    now = others(before, keys(*of))
    wanted = {cell for name in of for cell in lifted_by(made, THEORIES[name])}
    assert wanted
    assert wanted <= now
    shutil.copy(ROOT / change.file, tree / change.file)
    assert keys(*of) == before


@pytest.mark.slow
def test_every_change_of_the_kernel_that_is_written_down_changes_the_digests_of_what_is_lifted_from_it() -> None:
    """By what stands in them, without an edit."""
    for change in changes().values():
        made = planted(change)
        lines = (ROOT / change.file).read_text("utf-8").splitlines()
        said = {
            each.said
            for group in contents.module(change.module).binding.values()
            for each in group
            if change.old in "\n".join(lines[each.node.lineno - 1 : each.node.end_lineno])
        }
        for theory in THEORIES.values():
            for function in (*theory.steps.values(), *theory.read.values()):
                there = contents.closure([(function.__module__, function.__name__)])
                assert not made.touches(function) or not said or said & there, (change.name, function)


@pytest.mark.sampled(3)
@pytest.mark.parametrize(
    ("file", "old", "new"),
    [
        ("kernel/onboard/arithmetic.py", "LONGEST_CYCLE_MS = 102", "LONGEST_CYCLE_MS = 103"),
        ("kernel/onboard/braking.py", "class Brake:", "class Brake:\n    again: int = 0"),
        (
            "kernel/onboard/braking.py",
            "from dataclasses import dataclass",
            "from dataclasses import dataclass\nprint()",
        ),
        ("models/onboard/braking.py", "def run_a_cycle(", "@again\ndef run_a_cycle("),
        ("proofs/scripts/braking/run_a_cycle.toml", '"the_brake_slows",', ""),
        ("proofs/lift/operators.py", "import ast", "import ast  # by hand"),
        ("models/onboard/assumptions.toml", "[", "# by hand\n["),
    ],
    ids=["a constant", "a field", "what happens at import", "a decorator", "a script", "the lifter", "data"],
)
def test_whatever_it_is_made_of_is_in_it(file: str, old: str, new: str, tree: Path) -> None:
    before = keys("braking")
    path = tree / file
    text = path.read_text("utf-8")
    assert old in text
    path.write_text(text.replace(old, new, 1), "utf-8")
    assert {row for row, _ in others(before, keys("braking"))} >= {"braking.run_a_cycle"}


def test_python_and_packages_are_in_it(monkeypatch: pytest.MonkeyPatch) -> None:
    before = keys("display")
    monkeypatch.setattr(contents, "solvers_hashed", lambda: {"z3-solver": "0", "cvc5": "1"})
    assert len(others(before, keys("display"))) == len(before)
    monkeypatch.undo()
    monkeypatch.setattr(sys, "version", "3.99")
    assert len(others(before, keys("display"))) == len(before)


def test_what_stands_beside_it_is_not() -> None:
    """A comment at the top, another machine: so that little is lifted again after a change."""
    ours = contents.closure([("models.onboard.braking", "run_a_cycle")])
    assert not [each for each in ours if each.startswith(("kernel.tram", "models.crossing", "kernel.centre"))]


def test_a_comment_between_definitions_changes_nothing(tree: Path) -> None:
    before = keys("braking")
    edited(tree, "kernel/onboard/braking.py", "FARTHEST_MM = 10**9\n", "# A comment.\n\nFARTHEST_MM = 10**9\n")
    assert keys("braking") == before


# ---- names


def named(places: list[tuple[str, str]]) -> set[str]:
    """What stands in a digest, without how it is written."""
    return {each.rpartition(": ")[0] if each.count(": ") == 2 else each for each in contents.closure(places)}


def test_a_name_is_followed_to_what_it_means(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Through modules, imports of imports, attributes; what is a function's own is no module's."""
    for name, text in SOURCES.items():
        path = tmp_path / name
        path.parent.mkdir(exist_ok=True)
        path.write_text(text, "utf-8")
    for each in (contents, models.sources):
        monkeypatch.setattr(each, "ROOT", tmp_path)
    forget()
    try:
        found = named([("kernel.a", "f")])
    finally:
        monkeypatch.undo()
        forget()
    assert found == {
        *("kernel.a: f", "kernel.a: K", "kernel.a: b is kernel.b"),
        *("kernel.b: ", "kernel.b: g", "kernel.b: H is kernel.c.H"),
        *("kernel.c: H", "kernel.c: T"),
    }


SOURCES = {
    "kernel/__init__.py": "",
    "kernel/a.py": "from kernel import b, c\ndef f(c):\n    return b.g(c.own) + K\nK = 1\n",
    "kernel/b.py": "from kernel.c import H\nprint()\ndef g(x):\n    return H + x\n\ndef unused():\n    pass\n",
    "kernel/c.py": "T = 2\nH = T\nown = 3\n",
}


@pytest.mark.parametrize(
    ("row", "column"),
    [
        ("release_block", "reach_is_exclusive"),
        ("recover_point", "locks_agree"),
        ("braking.run_a_cycle", "head_stays_inside_authority"),
        ("crossing.decide", "every_lookup_is_defined"),
        ("dispatching.take_up", "every_lookup_is_defined"),
    ],
)
def test_what_the_lifter_opens_is_in_the_digest(row: str, column: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """Of a step and a claim, each function whose source the lifter asks for."""
    theory, name = theory_of(row)
    bench = Workbench(theory, named=theory.quantified)
    assert [*bench.assumed, *bench.invariants]
    opened: list[Code] = []
    check = sources.check_names

    def noting(tree: ast.FunctionDef, function: Code) -> None:
        opened.append(function)
        check(tree, function)

    monkeypatch.setattr(sources, "check_names", noting)
    definition_of.cache_clear()
    run.laid_out(row, column, scripts.hypotheses(row, column), bench)
    said: list[Code] = [
        theory.site,
        theory.system,
        theory.steps[name],
        *([theory.read[column]] if column in theory.read else []),
    ]
    read = {f"{function.__module__}: {function.__name__}" for function in opened}
    assert len(read) > 2
    assert read <= named([(each.__module__, each.__name__) for each in said])
