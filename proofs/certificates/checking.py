"""Has cvc5 write a proof of each part of an obligation, and has it checked."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import tempfile
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from pathlib import Path

from proofs import canaries, run, smtlib
from proofs.solvers import BUDGET, at_a_loss, commanded
from proofs.workbench import Part

CHECKER = "ethos"
RULES = "HEISOKU_CPC"
"""The environment variable that says where ``Cpc.eo`` is: the rules of cvc5's proofs, for the external checker."""
CHECKS_FOR_S = 120
RULE = re.compile(r":rule (\S+)")
CONTRADICTION = (
    "(\n(assume @p1 (not heisoku.any))\n(assume @p2 heisoku.any)\n(step @p3 false :rule contra :premises (@p2 @p1))\n)"
)
"""No proof: it takes for granted what was not asserted."""


@dataclass(frozen=True)
class Certified:
    """What came of one obligation.

    ``parts``: so many proofs.  ``answer``: ``checked`` if cvc5's checker went through each of them, else what it said
    instead.  ``steps``: of all proofs; ``trusted``: those among them that give no reason.
    ``external``: what the external checker said, none if it was not asked.
    """

    row: str
    column: str
    parts: int
    answer: str
    steps: int
    trusted: int
    smt2_sha256: str
    external: str = ""


@cache
def external() -> tuple[str, str] | None:
    """The external checker and the rules it reads, None unless both are installed."""
    found, rules = shutil.which(CHECKER), os.environ.get(RULES, "")
    return (found, rules) if found and Path(rules).is_file() else None


def certified(obligation: tuple[str, str]) -> Certified:
    """Prove an obligation, by its row and column, once more: every step written down and checked."""
    row, column = obligation
    asked = run.parts(row, column)
    digest, answers, rules, told = run.digest_of(asked), set(), list[str](), list[str]()
    for part in asked:
        answer, proof = proved(part)
        answers.add(answer)
        rules += RULE.findall(proof)
        if answer == "checked" and external():
            told.append(checked_outside(smtlib.script(part), proof))
    answer = next(iter(sorted(answers - {"checked"})), "checked")
    outside = next((each for each in told if each != "correct"), "correct") if told else ""
    trusted = sum("trust" in rule for rule in rules)
    return Certified(row, column, len(asked), answer, len(rules), trusted, digest, outside)


def proved(part: Part) -> tuple[str, str]:
    """Give cvc5's answer to one part, and its proof; ``checked`` if its own checker went through it."""
    text = smtlib.script(part)
    answer, proof = _once(text)
    if answer == "checked" or answer == "sat":
        return answer, proof
    return _once(text, at_a_loss(text))


def _once(text: str, more: Mapping[str, str] | None = None) -> tuple[str, str]:
    options = {"produce-proofs": "true", "check-proofs": "true", "proof-format-mode": "cpc", **(more or {})}
    _, says = commanded(text + "(get-proof)\n", BUDGET["cvc5"], 0, options)
    said: list[str] = []
    try:
        for each in says:
            said.append(each)
            if each in ("sat", "unknown"):
                return each, ""
    except RuntimeError as error:
        return f"no certificate: {' '.join(str(error).split())[:200]}", ""
    answer, proof = [each for each in said if each][-2:]
    if answer != "unsat" or "(step " not in proof:
        return f"no certificate: {answer[:200]}", ""
    return "checked", proof


def checked_outside(text: str, proof: str) -> str:
    """Have the external checker go through a proof of a question: ``correct``, or what it says instead."""
    found = external()
    assert found is not None
    checker, rules = found
    with tempfile.TemporaryDirectory() as place:
        question, answer = Path(place) / "question.smt2", Path(place) / "proof.cpc"
        question.write_text(text, "utf-8")
        answer.write_text(f'(include "{rules}")\n(reference "{question}")\n{proof.strip()[1:-1]}', "utf-8")
        try:
            told = subprocess.run(
                [checker, str(answer)], capture_output=True, text=True, timeout=CHECKS_FOR_S, check=False
            )
        except (OSError, subprocess.TimeoutExpired) as error:
            return f"{type(error).__name__}"
    says = (told.stdout.strip() or told.stderr.strip() or f"exit {told.returncode}").splitlines()[-1]
    return "correct" if says == "correct" and told.returncode == 0 else says[:200]


def controls() -> list[tuple[str, bool]]:
    """What no checker may go through, and whether it was refused: what is no theorem, and a proof that is none."""
    refused = [(canary.name, proved(part)[0] != "checked") for canary, part in canaries.laid_out()]
    if external():
        question = "(set-logic ALL)\n(declare-const heisoku.any Bool)\n(assert (not heisoku.any))\n(check-sat)\n"
        refused.append(("a proof of what is no theorem", checked_outside(question, CONTRADICTION) != "correct"))
    return refused
