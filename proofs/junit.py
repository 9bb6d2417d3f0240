"""A proof run as JUnit XML, which every CI system shows: a suite a transition, a case an obligation.

The package of a suite is its theory.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from lxml import etree

from models.streams import write_whole
from proofs.records import Obligation, Report, theory_of


def junit_xml(report: Report) -> bytes:
    """The report as a JUnit document.  Undecided counts as a failure, and so does a run that asked nothing."""
    root = etree.Element("testsuites", name="heisoku prove", time=f"{report.wall_seconds:.3f}")
    by_transition: dict[str, list[Obligation]] = {}
    for obligation in report.obligations:
        by_transition.setdefault(obligation["transition"], []).append(obligation)
    for transition, obligations in by_transition.items():
        add_suite(root, transition, obligations)
    if not report.obligations:
        suite = etree.SubElement(root, "testsuite", name="heisoku prove", tests="1", failures="1")
        case = etree.SubElement(suite, "testcase", classname="heisoku", name="something is proved")
        etree.SubElement(case, "failure", type="undecided", message="no obligation was put to a solver")
    missed = [each for each in report.canaries if not each["noticed"]]
    add_doubts(
        root,
        "canaries",
        [(f"{each['canary']} [{each['solver']}]", f"{each['solver']} answers {each['answer']}") for each in missed],
    )
    add_doubts(root, "sources", [(offence, "what rests on it is not proved") for offence in report.offences])
    count(root)
    return etree.tostring(root, encoding="utf-8", xml_declaration=True, pretty_print=True)


def add_doubts(root: etree._Element, name: str, doubts: Sequence[tuple[str, str]]) -> None:
    """Add a suite of what leaves everything undecided, each with what is wrong; none if nothing does."""
    if not doubts:
        return
    count = str(len(doubts))
    suite = etree.SubElement(root, "testsuite", name=name, tests=count, failures=count)
    for what, wrong in doubts:
        case = etree.SubElement(suite, "testcase", classname=name, name=clean(what))
        etree.SubElement(case, "failure", type="undecided", message=clean(wrong))


def add_suite(root: etree._Element, transition: str, obligations: Sequence[Obligation]) -> None:
    """Add the suite of one transition."""
    suite = etree.SubElement(
        root,
        "testsuite",
        package=clean(theory_of(transition)[0]),
        name=clean(transition),
        tests=str(len(obligations)),
        failures=str(sum(obligation["verdict"] != "proved" for obligation in obligations)),
        time=f"{sum(obligation['seconds'] for obligation in obligations):.3f}",
    )
    for obligation in obligations:
        add_case(suite, obligation)


def add_case(suite: etree._Element, obligation: Obligation) -> None:
    """Add one obligation; where it is not proved, the failure says what was asked and where it stands."""
    first, last = obligation["source"]["lines"]
    case = etree.SubElement(
        suite,
        "testcase",
        classname=clean(obligation["transition"]),
        name=clean(f"{obligation['invariant']} [{obligation['solver']} seed {obligation['seed']}]"),
        file=clean(obligation["source"]["file"]),
        line=str(first),
        time=f"{obligation['seconds']:.3f}",
    )
    if "kept" in obligation:
        told = etree.SubElement(case, "system-out")
        told.text = f"no evidence: answered at {obligation['kept']}, and kept from that run"
    if obligation["verdict"] == "proved":
        return
    failure = etree.SubElement(
        case,
        "failure",
        type=obligation["verdict"],
        message=clean(f"{obligation['transition']} × {obligation['invariant']}: {obligation['verdict']}"),
    )
    failure.text = clean(
        f"{obligation['source']['file']}:{first}-{last}\n"
        f"hypotheses: {', '.join(obligation['hypotheses']) or 'none'}\n"
        f"{obligation['solver']} {obligation['solver_version']}, seed {obligation['seed']}, "
        f"rlimit {obligation['rlimit_spent']} of {obligation['rlimit']}\n"
        f"SMT-LIB sha256 {obligation['smt2_sha256']}\n"
        f"{obligation.get('note', '')}"
    )


def count(root: etree._Element) -> None:
    """Put the totals of all suites on the root."""
    for attribute in ("tests", "failures"):
        root.set(attribute, str(sum(int(suite.get(attribute, "0")) for suite in root)))


def clean(text: str) -> str:
    """The text without the characters that XML has no place for."""
    return "".join(
        char
        if char in "\t\n\r" or "\x20" <= char <= "\ud7ff" or "\ue000" <= char <= "\ufffd" or char > "\uffff"
        else "�"
        for char in text
    )


def write_junit(path: Path, report: Report) -> None:
    """Write the report as JUnit XML, whole or not at all."""
    write_whole(path, junit_xml(report))
