"""A solver that says yes to everything is found out before anything it says is believed."""

from __future__ import annotations

import io
import json
import os
import subprocess
import sys
from pathlib import Path

import pytest
from lxml import etree
from rich.console import Console

from proofs import canaries, solvers
from proofs.junit import junit_xml
from proofs.matrix import print_matrix
from proofs.records import CanarySeen, Report
from tests.test_records import obligation

ROOT = Path(__file__).resolve().parent.parent.parent

FAKE_Z3 = """
import sys
from pathlib import Path

sys.path.remove(str(Path(__file__).parent.parent))
del sys.modules["z3"]
import z3

z3.Solver.check = lambda self, *assumptions: z3.unsat
sys.modules["z3"] = z3
"""
FAKE_CVC5 = """
import sys
from pathlib import Path

sys.path.remove(str(Path(__file__).parent.parent))
del sys.modules["cvc5"]
import cvc5


class Command:
    def __init__(self, command):
        self.command = command

    def isNull(self):
        return self.command.isNull()

    def invoke(self, solver, symbols):
        return "unsat" if "check-sat" in str(self.command) else self.command.invoke(solver, symbols)


class InputParser(cvc5.InputParser):
    def nextCommand(self):
        return Command(super().nextCommand())


cvc5.InputParser = InputParser
sys.modules["cvc5"] = cvc5
"""


@pytest.mark.parametrize(("solver", "package", "source"), [("z3", "z3", FAKE_Z3), ("cvc5", "cvc5", FAKE_CVC5)])
def test_a_fake_in_place_of_the_library_is_named(solver: str, package: str, source: str, tmp_path: Path) -> None:
    (tmp_path / package).mkdir()
    (tmp_path / package / "__init__.py").write_text(source, "utf-8")
    record = tmp_path / "prove.json"
    command = [sys.executable, str(ROOT / "heisoku.py"), "prove", "--solver", solver, "--jobs", "2"]
    ended = subprocess.run(
        [*command, "--only", "^(part|lock) locks_agree$", "--json", str(record)],
        capture_output=True,
        text=True,
        cwd=ROOT,
        env={**os.environ, "PYTHONPATH": str(tmp_path)},
        check=False,
    )
    assert ended.returncode == 3, ended.stderr
    named = [line for line in ended.stdout.splitlines() if line.startswith(solver) and "is believed" in line]
    assert len(named) == len(canaries.CANARIES)
    written = json.loads(record.read_text("utf-8"))
    assert {one["verdict"] for one in written["obligations"]} == {"proved"}, "it says unsat to everything"
    assert written["verdict"] == "undecided"
    assert not any(one["noticed"] for one in written["canaries"])


def test_both_solvers_notice_every_canary() -> None:
    seen = canaries.seen(("z3", "cvc5"))
    assert len(seen) == 2 * len(canaries.CANARIES)
    assert all(one["noticed"] for one in seen)
    assert {one["answer"] for one in seen if one["solver"] == "z3"} == {"sat"}
    scalar = [one for one in seen if one["solver"] == "cvc5" and "." in one["canary"].split(" ")[0]]
    assert len(scalar) >= 4
    assert {one["answer"] for one in scalar} == {"sat"}


def test_without_what_was_left_out_each_is_an_obligation_that_is_proved() -> None:
    """So the solver's answer depends on that one thing."""
    from proofs import run

    whole = [each for each in canaries.CANARIES if each.without or each.guard]
    assert len(whole) >= 5
    for canary in whole:
        part = run.parts(canary.row, canary.column)[canary.part]
        assert [solvers.ask(solver, part, 0).answer for solver in ("z3", "cvc5")] == ["unsat", "unsat"], canary.name


def test_one_missed_canary_spoils_the_verdict_the_matrix_and_junit() -> None:
    missed: CanarySeen = {
        "canary": "a row × a claim without a guard",
        "solver": "z3",
        "solver_version": "0",
        "answer": "unsat",
        "noticed": False,
    }
    report = Report([obligation()], 0.1, 0.2, [{**missed, "solver": "cvc5", "noticed": True}, missed])
    assert report.exit_code == 3
    text = io.StringIO()
    print_matrix(Console(file=text, width=160, color_system=None), report)
    assert "z3 0 answers unsat to what does not hold, a row × a claim without a guard" in text.getvalue()
    assert "cvc5 0 answers" not in text.getvalue()
    assert etree.fromstring(junit_xml(report)).get("failures") == "1"
