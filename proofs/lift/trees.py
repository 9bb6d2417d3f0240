"""Trees of cases: a function's result, split by the conditions that its early returns test."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TypeAlias

from proofs.lift.terms import Truth, not_, same
from proofs.lift.values import Record, Tuple, Value, choose


@dataclass(frozen=True, eq=False)
class Leaf:
    """One case."""

    value: Value


@dataclass(frozen=True, eq=False)
class Choice:
    """``yes`` where the condition holds, else ``no``."""

    condition: Truth
    yes: Tree
    no: Tree


Tree: TypeAlias = Leaf | Choice


def merge(tree: Tree) -> Value:
    """Return the one value that a tree of cases amounts to."""
    return tree.value if isinstance(tree, Leaf) else choose(tree.condition, merge(tree.yes), merge(tree.no))


def settle(tree: Tree) -> Tree:
    """Keep cases apart only where records are at stake."""
    return tree if isinstance(tree, Leaf) or _holds_record(tree) else Leaf(merge(tree))


def _holds_record(tree: Tree) -> bool:
    if isinstance(tree, Choice):
        return _holds_record(tree.yes) or _holds_record(tree.no)
    items = tree.value.items if isinstance(tree.value, Tuple) else (tree.value,)
    return any(isinstance(item, Record) for item in items)


def leaves(tree: Tree, path: tuple[Truth, ...] = ()) -> list[tuple[tuple[Truth, ...], Value]]:
    """List the cases with what is tested on the way to each, leaving out those that cannot be."""
    if isinstance(tree, Leaf):
        return [(path, tree.value)]
    found = [] if tree.condition is False else leaves(tree.yes, (*path, tree.condition))
    return found if tree.condition is True else found + leaves(tree.no, (*path, not_(tree.condition)))


def combine(
    trees: Sequence[Tree], build: Callable[[tuple[Value, ...]], Value], met: tuple[tuple[Truth, bool], ...] = ()
) -> Tree:
    """Build a value of the cases of several trees, each condition decided once."""
    for index, tree in enumerate(trees):
        if isinstance(tree, Choice):
            yes = [*trees[:index], tree.yes, *trees[index + 1 :]]
            no = [*trees[:index], tree.no, *trees[index + 1 :]]
            for condition, holds in met:
                if same(condition, tree.condition):
                    return combine(yes if holds else no, build, met)
            return Choice(
                tree.condition,
                combine(yes, build, (*met, (tree.condition, True))),
                combine(no, build, (*met, (tree.condition, False))),
            )
    return Leaf(build(tuple(tree.value for tree in trees if isinstance(tree, Leaf))))
