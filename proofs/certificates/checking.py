"""Has cvc5 write a proof of each part of an obligation, and has it checked."""

from __future__ import annotations

import gzip
import hashlib
import re
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from models.streams import write_whole
from proofs import canaries, run
from proofs.certificates.outside import Checker
from proofs.certificates.outside import checked as checked_outside
from proofs.certificates.outside import controls as controls_outside
from proofs.solvers import BUDGET, commanded, cvc5_questions
from proofs.workbench import Part

RULE = re.compile(rb":rule (\S+)")
SWITCHED_OFF = {"ite-simp": "false"}
"""What no proof is written with: cvc5 gives no reasons for conditions that it makes simpler."""


@dataclass(frozen=True)
class Certified:
    """What came of one obligation.

    ``parts``: so many proofs.  ``answer``: ``checked`` if cvc5's checker went through each of them, else what it said
    instead.  ``steps``: of all proofs; ``trusted``: those among them that give no reason.
    ``external``: what the external checker said, none if it was not asked.
    ``proofs``: a hash of each proof as cvc5 wrote it; ``size``: how many bytes all of them are.
    """

    row: str
    column: str
    parts: int
    answer: str
    steps: int
    trusted: int
    smt2_sha256: str
    external: str = ""
    proofs: tuple[str, ...] = ()
    size: int = 0


def certified(obligation: tuple[str, str], outside: Checker | None = None, keep: Path | None = None) -> Certified:
    """Prove an obligation, by its row and column, once more: every step written down and checked.

    ``outside``: the external checker, which goes through each proof too.  ``keep``: a folder for the proofs.
    """
    row, column = obligation
    asked = run.parts(row, column)
    digest, answers, written, told = run.digest_of(asked), set(), list[bytes](), list[str]()
    for number, part in enumerate(asked, 1):
        answer, proof, text = proved(part)
        answers.add(answer)
        written.append(proof.encode())
        if answer == "checked" and outside:
            told.append(checked_outside(text, proof, outside))
        if answer == "checked" and keep:
            write_whole(keep / row / f"{column}.{number}.cpc.gz", gzip.compress(written[-1], mtime=0))
    rules = [rule for proof in written for rule in RULE.findall(proof)]
    return Certified(
        row=row,
        column=column,
        parts=len(asked),
        answer=next(iter(sorted(answers - {"checked"})), "checked"),
        steps=len(rules),
        trusted=sum(b"trust" in rule for rule in rules),
        smt2_sha256=digest,
        external=next((each for each in told if each != "correct"), "correct") if told else "",
        proofs=tuple(hashlib.sha256(proof).hexdigest() for proof in written),
        size=sum(map(len, written)),
    )


def proved(part: Part) -> tuple[str, str, str]:
    """Give cvc5's answer to one part, its proof, and the text that it proves; ``checked`` if its checker went through.

    At a loss that text is the weaker question's (`proofs.products`), or the shorter one's (`proofs.shorter`).
    """
    said: tuple[str, str, str] | None = None
    for question in cvc5_questions(part):
        answer, proof = _once(question.text, question.options)
        if answer == "checked" or (answer == "sat" and question.is_whole):
            return answer, proof, question.text
        said = said or (answer, proof, question.text)
    assert said is not None, "the whole text is always asked"
    return said


def _once(text: str, more: Mapping[str, str]) -> tuple[str, str]:
    options = {"produce-proofs": "true", "check-proofs": "true", "proof-format-mode": "cpc", **more, **SWITCHED_OFF}
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


def controls(outside: Checker | None = None) -> list[tuple[str, bool]]:
    """What no checker may go through, and whether it was refused: what is no theorem, and proofs that are none."""
    refused = [(canary.name, proved(part)[0] != "checked") for canary, part in canaries.laid_out()]
    return refused + (controls_outside(outside) if outside else [])
