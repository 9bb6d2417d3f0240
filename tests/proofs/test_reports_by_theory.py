"""A run over several theories is reported by theory: matrix, totals, records, JUnit."""

from __future__ import annotations

import io

from lxml import etree
from rich.console import Console

from proofs.junit import junit_xml
from proofs.matrix import print_matrix
from proofs.records import Obligation, Report, Verdict, theory_of


def answer(transition: str, invariant: str, verdict: Verdict = "proved") -> Obligation:
    return {
        "transition": transition,
        "invariant": invariant,
        "hypotheses": [],
        "axioms": [],
        "verdict": verdict,
        "solver": "z3",
        "solver_version": "5.4.0",
        "seed": 0,
        "rlimit": 4_000_000,
        "rlimit_spent": 12,
        "seconds": 0.25,
        "smt2_sha256": "0" * 64,
        "source": {"file": "proofs/onboard/odometry.py", "lines": (10, 14)},
    }


REPORT = Report(
    [
        answer("request", "locks_agree"),
        answer("odometry.init", "range_contains_train"),
        answer("odometry.take_fix", "range_contains_train", "refuted"),
        answer("odometry.take_fix", "every_lookup_is_defined"),
    ],
    lifting_seconds=1.5,
    wall_seconds=2.0,
)


def matrix(report: Report) -> list[str]:
    out = io.StringIO()
    print_matrix(Console(file=out, width=120, color_system=None), report)
    return out.getvalue().splitlines()


def test_each_theory_has_a_matrix_of_its_own_and_all_have_one_total() -> None:
    lines = matrix(REPORT)
    assert lines.index("interlocking") < lines.index("odometry")
    rows = [line.split()[0] for line in lines if line.rstrip().endswith(("0.2", "0.5"))]
    assert rows == ["request", "init", "take_fix"]
    assert "odometry.take_fix × range_contains_train: refuted" in lines
    totals = lines[-5:]
    assert totals[0] == "interlocking: 1 rows × 1 columns: 1 obligations, 1 proved, 0 refuted, 0 undecided"
    assert totals[1] == "odometry: 2 rows × 2 columns: 3 obligations, 2 proved, 1 refuted, 0 undecided"
    assert totals[2] == "3 rows × 3 columns: 4 obligations, 3 proved, 1 refuted, 0 undecided"


def test_one_theory_alone_is_printed_as_ever() -> None:
    lines = matrix(Report([answer("request", "locks_agree")], 0.0, 0.0))
    assert "interlocking" not in lines
    assert "1 rows × 1 columns: 1 obligations, 1 proved, 0 refuted, 0 undecided" in lines


def test_a_record_says_which_theory_it_is_of() -> None:
    assert [each["theory"] for each in REPORT.record()["obligations"]] == ["interlocking", *["odometry"] * 3]
    assert theory_of("odometry.take_fix") == ("odometry", "take_fix")
    assert theory_of("request") == ("interlocking", "request")


def test_junit_has_a_suite_for_each_row_under_its_theory() -> None:
    root = etree.fromstring(junit_xml(REPORT))
    suites = [(suite.get("package"), suite.get("name")) for suite in root]
    assert suites == [("interlocking", "request"), ("odometry", "odometry.init"), ("odometry", "odometry.take_fix")]
