"""The names that loops bind, as their source text has them."""

from __future__ import annotations

import ast
from collections.abc import Sequence


def target_names(generators: Sequence[ast.comprehension]) -> set[str]:
    """Every name that some loops bind."""
    return {node.id for each in generators for node in ast.walk(each.target) if isinstance(node, ast.Name)}


def key_names(generator: ast.comprehension) -> set[str]:
    """The names that tell one turn of a loop from another: of keys with values, the key's."""
    target = generator.target
    pairs = isinstance(generator.iter, ast.Call) and isinstance(generator.iter.func, ast.Attribute)
    if pairs and generator.iter.func.attr == "items" and isinstance(target, ast.Tuple):  # type: ignore[attr-defined]
        target = target.elts[0]
    return {node.id for node in ast.walk(target) if isinstance(node, ast.Name)}
