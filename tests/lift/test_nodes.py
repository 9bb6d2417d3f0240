"""Every node of the running Python's syntax is accepted or refused, and a function shows it."""

from __future__ import annotations

import ast
import warnings
from pathlib import Path
from random import Random
from typing import Any

import pytest

from proofs.lift import OutsideSubset
from tests.lift.attacks import PREAMBLE
from tests.lift.differential import QuantifiedScope
from tests.lift.harbour import UNIVERSE
from tests.lift.nodes import ABSTRACT, ACCEPTED, OBSOLETE, OTHER_MODES, REFUSED
from tests.lift.written import Compared, Draw, module_of

DRAWS = 20


def node(name: str) -> Any:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", DeprecationWarning)
        return getattr(ast, name, None)


def every_node() -> set[str]:
    public = (name for name in dir(ast) if not name.startswith("_"))
    return {name for name in public if isinstance(node(name), type) and issubclass(node(name), ast.AST)}


def named(table: dict[str, str]) -> list[str]:
    return [name for names in table for name in names.split()]


def here(table: dict[str, str]) -> list[str]:
    """The texts that the running Python can parse: it has their nodes."""
    return [names for names in table if all(node(name) is not None for name in names.split())]


def test_each_node_is_in_the_table_once() -> None:
    listed = [*named(ACCEPTED), *named(REFUSED), *OTHER_MODES, *OBSOLETE, *ABSTRACT]
    assert sorted(set(listed)) == sorted(listed)
    assert every_node() - set(listed) == set(), "say whether the lifter accepts it, and show it"


@pytest.mark.parametrize("names", [*ACCEPTED, *here(REFUSED)])
def test_each_text_has_its_nodes(names: str) -> None:
    tree = ast.parse({**ACCEPTED, **REFUSED}[names])
    assert set(names.split()) <= {type(each).__name__ for each in ast.walk(tree)}


@pytest.mark.parametrize("names", ACCEPTED)
def test_accepted_and_agrees_with_python(names: str, tmp_path: Path) -> None:
    module = module_of(f"{PREAMBLE}{ACCEPTED[names]}\n", tmp_path)
    compared = Compared(module.f, QuantifiedScope.of_universe(UNIVERSE))
    draw = Draw(Random(names), UNIVERSE)
    for _ in range(DRAWS):
        compared.check(tuple(draw.of_type(each) for each in compared.types))
    assert compared.failing < DRAWS * 2


@pytest.mark.parametrize("names", here(REFUSED))
def test_refused_with_file_line_and_hint(names: str, tmp_path: Path) -> None:
    text = f"{PREAMBLE}{REFUSED[names]}\n"
    module = module_of(text, tmp_path)
    with pytest.raises(OutsideSubset) as refusal:
        Compared(module.f, QuantifiedScope.of_universe(UNIVERSE))
    assert refusal.value.file == module.__file__
    assert "# here" in text.splitlines()[refusal.value.line - 1]
    assert refusal.value.hint


@pytest.mark.parametrize("name", OTHER_MODES)
def test_other_modes_are_not_those_of_a_file(name: str) -> None:
    text, mode = OTHER_MODES[name]
    parse: Any = ast.parse
    assert name in {type(each).__name__ for each in ast.walk(parse(text, **mode))}
    if "mode" not in mode:
        assert name not in {type(each).__name__ for each in ast.walk(ast.parse(text))}


@pytest.mark.parametrize("name", sorted(every_node() & OBSOLETE))
def test_what_no_parser_makes_says_so_itself(name: str) -> None:
    assert (node(name).__doc__ or "").startswith("Deprecated AST node class")


@pytest.mark.parametrize("name", sorted(every_node() & ABSTRACT))
def test_what_is_abstract_has_nodes_of_its_kind(name: str) -> None:
    assert {each.__name__ for each in node(name).__subclasses__()} & every_node()
