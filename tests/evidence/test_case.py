"""The safety case: every claim rests on evidence, all evidence is claimed, every assumption is stated once."""

from __future__ import annotations

import re
from collections import Counter
from pathlib import Path

import pytest

from evidence.case import CASE, Case, CaseError, read_case
from evidence.catalogue import catalogue
from models.shipped import shipped
from proofs.assumptions import read
from proofs.theories import THEORIES

REQUIREMENTS = shipped("docs/requirements.md")
LABELLED = re.compile(r"^\| ([TPXGA]\d+) \|", re.MULTILINE)


def faults(case: Case) -> list[str]:
    """Everything that is wrong with a safety case, each by name."""
    claims = {claim.number: claim for claim in case.claims}
    rests: list[tuple[str, tuple[str, ...]]] = [(each.number, each.claims) for each in case.claims]
    rests += [(each.number, each.claims) for each in case.hazards]
    known = catalogue()
    found = [f"{claim.number} rests on nothing" for claim in case.claims if not claim.claims and not claim.evidence]
    found += [
        f"{who} names {number}, which is no claim"
        for who, numbers in rests
        for number in numbers
        if number not in claims
    ]
    found += [
        f"{claim.number} names the evidence {name}, which no command produces"
        for claim in case.claims
        for name in claim.evidence
        if name not in known
    ]
    used = {name for claim in case.claims for name in claim.evidence}
    found += [f"{name}: evidence that no claim uses" for name in known if name not in used]
    found += [f"{hazard.number} is answered by no claim" for hazard in case.hazards if not hazard.claims]
    answered = {number for _, numbers in rests for number in numbers}
    found += [f"{number} answers no hazard" for number in claims if number not in answered and number != "C1"]
    stated = Counter(name for duty in case.duties for name in duty.assumptions)
    assumed = {f"{each.kind}.{each.name}" for each in read()}
    found += [f"{name}: an assumption that is not stated" for name in sorted(assumed) if not stated[name]]
    found += [f"{name}: stated {count} times" for name, count in stated.items() if count > 1]
    found += [f"{name}: stated, and no assumption" for name in stated if name not in assumed]
    labels = set(LABELLED.findall(REQUIREMENTS.read_text("utf-8")))
    claimed = {label for claim in case.claims for label in claim.requirements}
    found += [f"{label}: a requirement that no claim names" for label in sorted(labels - claimed)]
    found += [f"{label}: no requirement" for label in sorted(claimed - labels)]
    numbers = Counter(
        [each.number for each in case.claims]
        + [each.number for each in case.hazards]
        + [each.number for each in case.limits]
    )
    found += [f"{number} stands {count} times" for number, count in numbers.items() if count > 1]
    return found + circles(case)


def circles(case: Case) -> list[str]:
    """Claims that rest on themselves."""
    below = {claim.number: set(claim.claims) for claim in case.claims}
    for _ in below:
        below = {number: rests.union(*(below.get(each, set()) for each in rests)) for number, rests in below.items()}
    return [f"{number} rests on itself" for number, rests in below.items() if number in rests]


def test_the_safety_case_holds_together() -> None:
    assert faults(read_case()) == []


def test_every_safety_invariant_and_every_promise_is_claimed() -> None:
    named = {name for claim in read_case().claims for name in claim.evidence}
    wanted = {f"prove:{theory}.{name}" for theory, each in THEORIES.items() for name in each.claimed}
    assert wanted <= named
    assert len(wanted) > 60


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("| `mutate` |", "| |", "C13 rests on nothing"),
        ("| `mutate` |", "| `wishes` |", "C13 names the evidence wishes, which no command produces"),
        ("`prove:interlocking.no_open_flank`", "", "prove:interlocking.no_open_flank: evidence that no claim uses"),
        ("| C13 | The", "| C97 | The", "H12 names C13, which is no claim"),
        ("`world.detection_is_true` `", "`", "world.detection_is_true: an assumption that is not stated"),
        ("## 5.", "| C99 | All is well | T1 | `test` | – |\n\n## 5.", "C99 answers no hazard"),
        ("T9 T15 | `prove", "T9 | `prove", "T15: a requirement that no claim names"),
        ("| T1 | `mutate` |", "| T1 | C1 |", "C13 rests on itself"),
        ("| C13 | The", "| C12 | The", "C12 stands 2 times"),
    ],
)
def test_what_is_changed_in_it_is_noticed_by_name(old: str, new: str, said: str, tmp_path: Path) -> None:
    text = CASE.read_text("utf-8")
    assert old in text
    changed = tmp_path / "SAFETY_CASE.md"
    if new.startswith("| C99"):
        where = text.index("\n\n## 5.")
        changed.write_text(text[:where] + "\n" + new.split("\n", maxsplit=1)[0] + text[where:], "utf-8")
    else:
        changed.write_text(text.replace(old, new, 1), "utf-8")
    assert said in faults(read_case(changed))


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [("| L1 |", "| L1 | again |", "3 columns"), ("### Claims", "### Clams", "no table under the heading 'Claims'")],
)
def test_a_table_that_is_not_one_is_named(old: str, new: str, said: str, tmp_path: Path) -> None:
    changed = tmp_path / "SAFETY_CASE.md"
    changed.write_text(CASE.read_text("utf-8").replace(old, new, 1), "utf-8")
    with pytest.raises(CaseError, match=said):
        read_case(changed)
