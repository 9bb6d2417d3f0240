"""The text of each obligation is kept where it is asked for, and is the text that was solved."""

from __future__ import annotations

import gzip
import hashlib
from pathlib import Path

from proofs.run import kept, prove_all
from proofs.solvers import ask_cvc5


def test_every_obligation_of_a_run_is_kept_as_it_was_solved(tmp_path: Path) -> None:
    report = prove_all(solver="z3", jobs=1, only=r"^speed_limit\.run_on ", keep=tmp_path)
    assert len(report.obligations) > 1
    wanted, asked = set(), 0
    for each in report.obligations:
        path = kept(tmp_path, each["transition"], each["invariant"])
        text = gzip.decompress(path.read_bytes())
        assert hashlib.sha256(text).hexdigest() == each["smt2_sha256"]
        questions = text.decode().split("(set-logic ALL)")[1:]
        assert [ask_cvc5(f"(set-logic ALL){question}", 0)[0] for question in questions] == ["unsat"] * len(questions)
        asked += len(questions)
        wanted.add(path)
    assert asked
    assert {path for path in tmp_path.rglob("*") if path.is_file()} == wanted
    before = {path: path.read_bytes() for path in wanted}
    prove_all(solver="z3", jobs=1, only=r"^speed_limit\.run_on ", keep=tmp_path)
    assert {path: path.read_bytes() for path in wanted} == before, "the same bytes on every run"
