"""Layouts: reading them, checking them against the axioms, and making large ones."""

from models.layouts.checker import as_json, check
from models.layouts.loading import load, load_text
from models.layouts.results import BadInput, CheckResult, Imported, Places, Remark, Violation


def draw(imported: Imported, route: str | None = None) -> str:
    """The track diagram of a layout as SVG, with a route highlighted if one is named.

    :raises BadInput: the layout has no such route.
    """
    from models.diagram import draw_svg  # which imports this package, and networkx

    return draw_svg(imported, route)


__all__ = [
    "BadInput",
    "CheckResult",
    "Imported",
    "Places",
    "Remark",
    "Violation",
    "as_json",
    "check",
    "draw",
    "load",
    "load_text",
]
