"""A checker of others, ethos, goes through cvc5's proofs: what it is given of them, and what no checker may pass.

It reads the rules of cvc5's proofs, ``Cpc.eo`` and the files beside it, the question and the proof.  The question goes
without the names of its hypotheses, and the proof without declaring again what the question declares: both are
refused otherwise.  A proof may also bring rules of its own, end the reading, or prove something other than *false*,
and be correct; so nothing but definitions, assumptions and steps may stand in it, and its last step is *false*.
"""

from __future__ import annotations

import hashlib
import os
import re
import shutil
import subprocess
import tempfile
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache
from pathlib import Path

CHECKER = "ethos"
RULES = "HEISOKU_CPC"
"""The environment variable that says where ``Cpc.eo`` is, where no option does."""
CHECKS_FOR_S = 120
NAMED = re.compile(r"^\(assert \(! (.*) :named (?:[\w.!]+|\|[^|]*\|)\)\)$", re.MULTILINE)
DECLARED = re.compile(r"\(declare-(?:fun|const|sort) (\|[^|]*\||[^\s()]+)")
DATATYPE = re.compile(r"\(declare-datatypes \(\((\|[^|]*\||[^\s()]+) ")
TOKEN = re.compile(r'"[^"]*"|\|[^|]*\||;[^\n]*|[()]')
ALLOWED = re.compile(r"\((?:define @t\d+ |assume @p\d+ |assume-push @p\d+ |step @p\d+ |step-pop @p\d+ )")
FALSE = re.compile(r"\(step @p\d+ false ")


@dataclass(frozen=True)
class Checker:
    """The external checker: its program, and the file of rules that it reads first."""

    program: str
    rules: str

    def hashes(self) -> dict[str, str]:
        """A hash of the program, and one of all files of rules by their names and content."""
        rules, whole = Path(self.rules).resolve().parent, hashlib.sha256()
        for path in sorted(rules.rglob("*.eo")):
            content = path.read_bytes()
            whole.update(f"{path.relative_to(rules).as_posix()}\0{len(content)}\0".encode() + content)
        program = hashlib.sha256(Path(self.program).read_bytes()).hexdigest()
        return {"program": program, "rules": whole.hexdigest()}


class Refused(Exception):
    """A proof says what no proof of ours says."""


@cache
def installed() -> Checker | None:
    """The external checker that is on the path, with the rules that the environment names; none unless both are."""
    found, rules = shutil.which(CHECKER), os.environ.get(RULES, "")
    return Checker(found, rules) if found and Path(rules).is_file() else None


def commands(text: str) -> Iterator[str]:
    """Give the commands of a text, one after the other.

    Raises:
        Refused: something stands between them, or one does not end.
    """
    depth, start = 0, 0
    for found in TOKEN.finditer(text):
        if found[0] == "(":
            if not depth:
                if text[start : found.start()].strip():
                    raise Refused("something stands between its commands")
                start = found.start()
            depth += 1
        elif found[0] == ")":
            depth -= 1
            if depth < 0:
                raise Refused("a parenthesis is closed that none opened")
            if not depth:
                yield text[start : found.end()]
                start = found.end()
    if depth or text[start:].strip():
        raise Refused("a command does not end")


def declared(command: str) -> str | None:
    """The name that a command declares; none if it declares nothing."""
    found = DECLARED.match(command) or DATATYPE.match(command)
    return found[1].strip("|") if found else None


def question(text: str) -> str:
    """The text of a question without the names of its hypotheses."""
    return NAMED.sub(r"(assert \1)", text)


def steps(text: str, proof: str) -> str:
    """A proof as it is given to the checker, without what the question declares.

    Raises:
        Refused: it says what no proof may say, or its last step is not *false*.
    """
    there = {declared(each) for each in commands(text)} - {None}
    kept, depth, last = list[str](), 0, ""
    for each in commands(proof.strip()[1:-1]):
        if declared(each) in there:
            continue
        if not ALLOWED.match(each):
            raise Refused(f"nobody may say in a proof: {' '.join(each.split())[:80]}")
        depth += each.startswith("(assume-push ") - each.startswith("(step-pop ")
        kept.append(each)
        last = each
    if depth or not FALSE.match(last):
        raise Refused("its last step is not false, of what was asked alone")
    return "\n".join(kept) + "\n"


def checked(text: str, proof: str, by: Checker) -> str:
    """Have the external checker go through a proof of a question: ``correct``, or what was said instead."""
    try:
        given = steps(text, proof)
    except Refused as refused:
        return f"refused: {refused}"
    with tempfile.TemporaryDirectory() as place:
        asked, answer = Path(place) / "question.smt2", Path(place) / "proof.cpc"
        asked.write_text(question(text), "utf-8")
        answer.write_text(f'(include "{Path(by.rules).resolve()}")\n(reference "{asked}")\n{given}', "utf-8")
        try:
            told = subprocess.run(
                [by.program, str(answer)], capture_output=True, text=True, timeout=CHECKS_FOR_S, check=False
            )
        except (OSError, subprocess.TimeoutExpired) as error:
            return f"{type(error).__name__}"
    says = (told.stdout.strip() or told.stderr.strip() or f"exit {told.returncode}").splitlines()[-1]
    return "correct" if says == "correct" and told.returncode == 0 else says[:200]


# ---- what no checker may pass

QUESTION = "(set-logic ALL)\n(declare-const heisoku.any Bool)\n(assert (not heisoku.any))\n(check-sat)\n"
ASSUMED = "(assume @p1 (not heisoku.any))\n"
WRONG = {
    "a proof of what is no theorem": f"{ASSUMED}(assume @p2 heisoku.any)\n"
    "(step @p3 false :rule contra :premises (@p2 @p1))\n",
    "a step that does not follow": f"{ASSUMED}(step @p2 false :rule contra :premises (@p1 @p1))\n",
    "a proof with a rule of its own": f"{ASSUMED}(declare-rule so_it_is () :conclusion false)\n"
    "(step @p2 false :rule so_it_is)\n",
    "a proof of something else": f"{ASSUMED}(step @p2 (= heisoku.any heisoku.any) :rule refl :args (heisoku.any))\n",
}
"""By their names, what are no proofs that nothing but *false* follows; each is put to the checker in every run."""


def controls(by: Checker) -> list[tuple[str, bool]]:
    """What is no proof, each by its name, and whether it was refused."""
    return [(name, checked(QUESTION, f"(\n{proof})", by) != "correct") for name, proof in WRONG.items()]
