"""What each piece of evidence comes to by the records: shown, not so, or not shown; never silence."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import PurePath
from typing import Any, Literal

from evidence.catalogue import Evidence
from evidence.records.reading import Answer, Kept, Records
from proofs.theories import THEORIES, row_of
from proofs.theory import Theory

Came = Literal["holds", "does not hold", "not shown"]
SOLVERS = ("z3", "cvc5")
"""A proof counts if each of them gives it."""
WITNESSING = {True: "test_witnesses", False: "test_theories"}
"""The tests that play witnesses: of the interlocking, and of the theories beside it."""


@dataclass(frozen=True)
class Shown:
    """A piece of evidence, by the records: what it comes to, and the figures that say so in words.

    ``malformed``: its record does not have the form of such a record.
    """

    evidence: Evidence
    verdict: Came
    says: str
    malformed: bool = False


def shown(all_of_it: Mapping[str, Evidence], records: Records, commit: str | None) -> Mapping[str, Shown]:
    """Give what every piece of evidence comes to; a record of another commit shows nothing of this one."""
    return {name: _shown(each, records.get(each.record), commit) for name, each in all_of_it.items()}


def _shown(evidence: Evidence, record: Kept | None, commit: str | None) -> Shown:
    if record is None or record.problem:
        why = record.problem if record else "there is no such record"
        return Shown(evidence, "not shown", f"{evidence.record}: {why}; {evidence.command} makes it")
    if record.commit is not None and commit is not None and record.commit != commit:
        made = f"{evidence.record} is of commit {record.commit[:12]}, and this is {commit[:12]}"
        return Shown(evidence, "not shown", f"{made}; {evidence.command} makes it anew")
    kind, _, which = evidence.name.partition(":")
    try:
        verdict, says = JUDGES[kind](record, which)
    except (KeyError, TypeError, ValueError, AttributeError, IndexError) as error:
        return Shown(
            evidence, "not shown", f"{evidence.record} does not have the form of such a record: {error!r}", True
        )
    return Shown(evidence, verdict, says)


def cells_of(theory: Theory, column: str) -> list[tuple[str, str]]:
    """The obligations of one column of a theory's matrix, by row and column."""
    return [(row_of(theory, row), column) for row in theory.rows if column in theory.columns(row)]


def _proved(record: Kept, which: str) -> tuple[Came, str]:
    """A column of the matrix closes if both solvers prove each cell, and noticed each canary."""
    name, _, column = which.rpartition(".")
    asked = cells_of(THEORIES[name], column)
    answers = record.cells
    told = {cell: {verdict for each in answers.get(cell, {}).values() for verdict in each} for cell in asked}
    refuted = [row for (row, _), verdicts in told.items() if "refuted" in verdicts]
    if refuted:
        return "does not hold", f"refuted over {', '.join(refuted)}"
    earlier = [row for row, _ in asked if (row, column) in record.from_earlier]
    if earlier:
        return "not shown", f"answers over {_few(earlier)} were kept from earlier runs; prove without --kept"
    missed = [each for each in record.data["canaries"] if not each["noticed"]]
    if missed or not record.data["canaries"]:
        which = f"{missed[0]['solver']} missed {missed[0]['canary']}" if missed else "no canary was put to the solvers"
        return "not shown", f"no answer is believed: {which}"
    open_ones = [row for row, _ in asked if told[row, column] != {"proved"}]
    if open_ones or not asked:
        return "not shown", f"{len(asked) - len(open_ones)} of {len(asked)} obligations proved, not {_few(open_ones)}"
    alone = [row for row, _ in asked if set(SOLVERS) - set(answers[row, column])]
    if alone:
        return "not shown", f"proved by one solver alone over {_few(alone)}"
    return "holds", f"{len(asked)} of {len(asked)} obligations proved by each of {len(SOLVERS)} solvers"


def _few(names: Sequence[str], most: int = 4) -> str:
    more = f" and {len(names) - most} more" if len(names) > most else ""
    return ", ".join(names[:most]) + more


def _checked(record: Kept, which: str) -> tuple[Came, str]:
    entry = next(
        (each for each in record.data["layouts"] if PurePath(each["file"]) == PurePath("layouts", which)), None
    )
    if entry is None:
        return "not shown", f"check.json says nothing of {which}"
    if entry["verdict"] != "holds":
        return "does not hold", f"{len(entry.get('violations', ()))} violations of axioms"
    instances = sum(entry["checked"].values())
    if not instances:
        return "not shown", "no axiom was evaluated"
    rests = "; ".join(each["text"] for each in entry.get("rests", ()) if not each["declared"])
    resting = f"; rests on {rests}" if rests else ""
    return "holds", f"{instances:,} instances of {len(entry['checked'])} axioms, no violation{resting}"


def _ridden(record: Kept, which: str) -> tuple[Came, str]:
    one = next((each for each in record.data["campaigns"] if not each["beyond"]), None)
    if one is None or not one["rides"]:
        return "not shown", "no ride within the declared ranges"
    says = f"{one['rides']:,} rides, {one['violated']:,} with a claim broken"
    return ("holds" if one["violated"] == 0 else "does not hold"), says


def _beyond(record: Kept, which: str) -> tuple[Came, str]:
    found = [each for each in record.data["campaigns"] if each["beyond"]]
    rides, violated, unexplained = (sum(each[what] for each in found) for what in ("rides", "violated", "unexplained"))
    if not rides:
        return "not shown", "no ride beyond a declared range"
    says = f"{rides:,} rides, {violated:,} with a claim broken, {unexplained:,} of them with every assumption kept"
    return ("holds" if unexplained == 0 else "does not hold"), says


def _lived(record: Kept, which: str) -> tuple[Came, str]:
    data = record.data
    if data["system"] != which or not data["days"]:
        return "not shown", f"no day of the {which}"
    says = f"{data['days']:,} days, {data['violated']:,} with a claim broken"
    return ("holds" if data["violated"] == 0 else "does not hold"), says


def _reproduced(record: Kept, which: str) -> tuple[Came, str]:
    rows = [row for row in record.data["rows"] if row["agrees"] is not None]
    if record.data["paper"] != which or not rows:
        return "not shown", "no figure that can be compared"
    agree = sum(row["agrees"] for row in rows)
    says = f"{agree} of {len(rows)} figures agree by their criteria"
    return ("holds" if agree == len(rows) and record.data["verdict"] == "holds" else "does not hold"), says


def _fuzzed(record: Kept, which: str) -> tuple[Came, str]:
    targets: Mapping[str, Any] = record.data["targets"]
    steps, traces = (sum(each[what] for each in targets.values()) for what in ("steps", "traces"))
    canaries = record.data["canaries"]
    missed = sum(not each["target"] for each in canaries)
    says = f"{traces:,} traces, {steps:,} steps, {len(record.data['failures']):,} causes of failure"
    says += f", {len(canaries) - missed} of {len(canaries)} canaries found"
    ended = any(each["failures"] or each["unfinished"] for each in targets.values()) or record.data["left_out"]
    if record.data["verdict"] == "does not hold" or record.data["failures"] or ended:
        return "does not hold", says
    if missed or not steps or record.data["verdict"] != "holds":
        return "not shown", says
    return "holds", says


def _mutated(record: Kept, which: str) -> tuple[Came, str]:
    data = record.data
    came = [each["became"] for each in data["mutants"]]
    says = ", ".join(f"{came.count(word):,} {word}" for word in ("killed", "classed", "hole")) + f" of {len(came):,}"
    if "hole" in came:
        return "does not hold", says
    if not came:
        return "not shown", "no mutant was tried"
    if len(came) < data["of"]:
        return "not shown", f"{says}; a sample of {data['of']:,}"
    return "holds", says


def _certified(record: Kept, which: str) -> tuple[Came, str]:
    data, found = record.data, record.data["obligations"]
    parts, steps, trusted = (sum(each[what] for each in found) for what in ("parts", "steps", "trusted"))
    checked = sum(each["answer"] == "checked" for each in found)
    says = (
        f"{checked:,} of {len(found):,} obligations, {parts:,} proofs of {steps:,} steps, {trusted:,} of them on trust"
    )
    passed_outside = sum(each["external"] == "correct" for each in found)
    says += f", {passed_outside:,} by {data['external']} too" if data["external"] else ", by no external checker"
    passed = [each["asked"] for each in data["controls"] if not each["refused"]]
    if any(each["answer"] == "sat" for each in found):
        return "does not hold", says
    if passed or not data["controls"]:
        return "not shown", f"no certificate is believed: {passed[0] if passed else 'no control'} went through"
    if len(found) < data["of"]:
        return "not shown", f"{says}; a sample of {data['of']:,}"
    outside = all(each["external"] in ("", "correct") for each in found)
    return ("holds" if outside and checked == len(found) and not trusted else "not shown"), says


def _confirmed(record: Kept, which: str) -> tuple[Came, str]:
    return judged(record.answers, "conditions", skipping=False)


def _tested(record: Kept, which: str) -> tuple[Came, str]:
    return judged(record.answers, "tests", skipping=True)


def _witnessed(record: Kept, which: str) -> tuple[Came, str]:
    home = WITNESSING[which == "interlocking"]
    mine = [
        each
        for each in record.answers
        if f".{home}::" in f".{each.name}" and (which == "interlocking" or each.name.endswith(f"[{which}]"))
    ]
    return judged(mine, "tests of its witnesses", skipping=False)


def judged(answers: Sequence[Answer], what: str, *, skipping: bool) -> tuple[Came, str]:
    """Judge a list of tests; ``skipping``: some of them may be skipped, which is said."""
    came = [each.came_to for each in answers]
    failed, skipped = came.count("failed"), came.count("skipped")
    says = f"{came.count('passed'):,} of {len(came):,} {what} passed" + (f", {skipped:,} skipped" if skipped else "")
    if failed:
        return "does not hold", says
    if not came.count("passed") or (skipped and not skipping) or skipped > came.count("passed"):
        return "not shown", says
    return "holds", says


JUDGES: Mapping[str, Callable[[Kept, str], tuple[Came, str]]] = {
    "prove": _proved,
    "witness": _witnessed,
    "check": _checked,
    "ride": _ridden,
    "beyond": _beyond,
    "days": _lived,
    "reproduce": _reproduced,
    "fuzz": _fuzzed,
    "mutate": _mutated,
    "certify": _certified,
    "crosshair": _confirmed,
    "test": _tested,
}
"""How each kind of evidence is judged."""
