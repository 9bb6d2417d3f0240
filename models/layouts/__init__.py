"""Layouts: reading them, checking them against the axioms, and making large ones."""

from models.layouts.checker import as_json, check
from models.layouts.loading import load, load_text
from models.layouts.results import BadInput, CheckResult, Imported, Places, Remark, Violation

__all__ = [
    "BadInput",
    "CheckResult",
    "Imported",
    "Places",
    "Remark",
    "Violation",
    "as_json",
    "check",
    "load",
    "load_text",
]
