"""Writes the report: one file, nothing loaded from anywhere."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from evidence.report.gathering import PAIRS_AT_MOST, Book
from evidence.report.tracing import GROUPS, Proved, Requirement
from evidence.report.words import markdown, number
from models.whole_page import template_of

SECTIONS = (
    ("not-shown", "Not shown"),
    ("goals", "Goals"),
    ("chain", "Chain"),
    ("hazards", "Hazards"),
    ("evidence", "Evidence"),
    ("requirements", "Requirements"),
    ("invariants", "Proofs"),
    ("witnesses", "Witnesses"),
    ("assumptions", "Assumptions"),
    ("layouts", "Layouts"),
    ("campaigns", "Campaigns"),
    ("days", "Days"),
    ("papers", "Papers"),
    ("mutants", "Mutants"),
    ("tools", "Tools"),
    ("standards", "Standards"),
    ("versions", "Versions"),
    ("glossary", "Glossary"),
)
CLASSES = {"implied": "implied", "service": "for service", "second_line": "second line"}
RESTING_AT_MOST = 30
"""So many guards are listed below an invariant; all stand under their functions."""
MEASURED = ("days:", "reproduce:", "ride", "beyond", "fuzz")
"""Evidence that is measured, and not proved."""


def page_of(book: Book) -> str:
    """The report as HTML."""
    template = template_of("evidence.report", markdown=markdown, number=number, kills=kills, those=those)

    def measured(requirement: Requirement) -> Sequence[str]:
        """The measured evidence that the claims of a requirement rest on, but for claims that all of them serve."""
        own = [each for each in book.case.claims if requirement.label in each.requirements and each.number != "C1"]
        found = (name for claim in own for name in claim.evidence if name.startswith(MEASURED) and name in book.shown)
        return list(dict.fromkeys(found))

    return template.render(
        book=book,
        sections=SECTIONS,
        groups=GROUPS,
        classes=CLASSES,
        measured=measured,
        pairs_at_most=PAIRS_AT_MOST,
        resting_at_most=RESTING_AT_MOST,
    )


def those(names: Sequence[str], known: Mapping[str, Proved]) -> list[Proved]:
    """The invariants of these names; what holds at the start alone is none."""
    return [known[name] for name in names if name in known]


def kills(counts: Mapping[str, Sequence[tuple[str, int]]], theory: str, name: str) -> int | None:
    """How many mutants an invariant kills; None where nothing was tried."""
    return dict(counts.get(theory, ())).get(name)
