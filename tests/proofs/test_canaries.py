"""A solver that says yes to everything is found out before anything it says is believed."""

from __future__ import annotations

import io
import json
import os
import subprocess
import sys
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest
from lxml import etree
from rich.console import Console

from proofs import canaries, canary_search, run, solvers
from proofs.junit import junit_xml
from proofs.matrix import print_matrix
from proofs.mutants.edits import named
from proofs.mutants.targets import theories_of
from proofs.reach import called_by
from proofs.records import CanarySeen, Report
from proofs.theories import THEORIES
from tests.test_records import obligation

ROOT = Path(__file__).resolve().parent.parent.parent

FAKE_Z3 = """
import sys
from pathlib import Path

HERE = str(Path(__file__).parent.parent)
sys.path.remove(HERE)
del sys.modules["z3"]
import z3

sys.path.insert(0, HERE)

z3.Solver.check = lambda self, *assumptions: z3.unsat
sys.modules["z3"] = z3
"""
FAKE_CVC5 = """
import sys
from pathlib import Path

HERE = str(Path(__file__).parent.parent)
sys.path.remove(HERE)
del sys.modules["cvc5"]
import cvc5

sys.path.insert(0, HERE)


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


LIES_IN_ONE_WORKER = """
import os
import sys
from multiprocessing import parent_process
from pathlib import Path

HERE = str(Path(__file__).parent.parent)
sys.path.remove(HERE)
del sys.modules["z3"]
import z3

sys.path.insert(0, HERE)
TRUE, LIAR = z3.Solver.check, Path(HERE, "liar")


def check(self, *assumptions):
    if parent_process() is not None:
        try:
            os.write(os.open(LIAR, os.O_CREAT | os.O_EXCL | os.O_WRONLY), str(os.getpid()).encode())
        except FileExistsError:
            pass
        if LIAR.read_text() == str(os.getpid()):
            return z3.unsat
    return TRUE(self, *assumptions)


z3.Solver.check = check
sys.modules["z3"] = z3
"""
"""The first worker to ask anything is lied to; no other process is."""


BEGIN = "import heisoku_start; heisoku_start.SOLVERS.clear(); heisoku_start.main()"
"""The program, but for what looks whose solvers' packages stand on the path."""


def proved_with(fake: str, package: str, place: Path, *options: str) -> tuple[int, list[str], dict[str, Any]]:
    """Prove with a package in front of the solver's; exit code, what is said to be missed, and the record.

    The program begins without what refuses such a package by name: what canaries notice of it is asked.
    """
    (place / package).mkdir()
    (place / package / "__init__.py").write_text(fake, "utf-8")
    record = place / "prove.json"
    ended = subprocess.run(
        [sys.executable, "-c", BEGIN, *("prove", "--jobs", "2", "--json", record), *options],
        capture_output=True,
        text=True,
        cwd=ROOT,
        env={**os.environ, "PYTHONPATH": str(place)},
        check=False,
    )
    assert record.exists(), ended.stderr
    lines = [line for line in ended.stdout.splitlines() if "is believed" in line]
    return ended.returncode, lines, json.loads(record.read_text("utf-8"))


@pytest.mark.sampled(2)
@pytest.mark.parametrize(("solver", "package", "source"), [("z3", "z3", FAKE_Z3), ("cvc5", "cvc5", FAKE_CVC5)])
def test_a_fake_in_place_of_the_library_is_named(solver: str, package: str, source: str, tmp_path: Path) -> None:
    only = "^(part|lock) locks_agree$"
    code, lines, written = proved_with(source, package, tmp_path, "--solver", solver, "--only", only)
    assert code == 3
    asked = {one["canary"] for one in written["canaries"]}
    assert asked == {each.name for each in canaries.of("interlocking")}
    assert len(lines) == len(written["canaries"]) == len(asked) * len({one["process"] for one in written["canaries"]})
    assert all(line.startswith(solver) for line in lines)
    assert {one["verdict"] for one in written["obligations"]} == {"proved"}, "it says unsat to everything"
    assert written["verdict"] == "undecided"
    assert not any(one["noticed"] for one in written["canaries"])


def test_a_solver_that_lies_in_one_worker_only_is_found(tmp_path: Path) -> None:
    code, lines, written = proved_with(LIES_IN_ONE_WORKER, "z3", tmp_path, "--only", "^(split|feature|odometry)\\.")
    liar = int((tmp_path / "liar").read_text("utf-8"))
    assert liar in {one["process"] for one in written["canaries"]}
    assert all(one["noticed"] == (one["process"] != liar) for one in written["canaries"])
    assert lines
    assert all(f"in process {liar} " in line for line in lines)
    assert (code, written["verdict"]) == (3, "undecided")


@pytest.mark.parametrize("theory", THEORIES)
def test_each_theory_has_a_canary_that_drops_a_guard_of_its_own_kernel(theory: str) -> None:
    own = [each for each in canaries.guards() if each.theory == theory]
    assert own
    assert set(own) <= set(canaries.of(theory))
    for canary in own:
        function = named(canary.dropped).function
        has_a_machine = any(
            each.__module__.startswith("kernel.")
            for step in THEORIES[theory].steps.values()
            for each in called_by(step)
        )
        assert function.__module__.startswith("kernel." if has_a_machine else "models.")
        assert THEORIES[theory] in theories_of(function)


def test_both_solvers_notice_every_canary() -> None:
    seen = canaries.seen(("z3", "cvc5"))
    assert len(seen) == 2 * len(canaries.CANARIES)
    assert {one["answer"] for one in seen} == {"sat"}
    assert all(one["noticed"] for one in seen)


def test_without_what_was_left_out_each_is_an_obligation_that_is_proved() -> None:
    """So the solver's answer depends on that one thing."""
    whole = [each for each in canaries.CANARIES if each.without or each.dropped]
    assert len(whole) == 3 + len(canaries.guards())
    for canary in whole:
        part = run.parts(canary.row, canary.column)[canary.part]
        assert [solvers.ask(solver, part, 0).answer for solver in ("z3", "cvc5")] == ["unsat", "unsat"], canary.name


CANARY = next(each for each in canaries.CANARIES if each.row == "restart_terminal")


@pytest.mark.parametrize("solver", ["z3", "cvc5"])
def test_an_unknown_notices_nothing(solver: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(canaries, "answered", lambda solver, part: "unknown")
    monkeypatch.setattr(canaries, "CANARIES", (CANARY,))
    monkeypatch.setattr(canaries, "_seen", canaries._seen.__wrapped__)
    (one,) = [each for each in canaries.seen((solver,)) if each["canary"] == CANARY.name]
    assert (one["answer"], one["noticed"]) == ("unknown", False)
    assert Report([obligation()], 0.1, 0.2, [one]).exit_code == 3


def test_a_canary_that_the_kernel_has_outgrown_notices_nothing(monkeypatch: pytest.MonkeyPatch) -> None:
    gone = replace(CANARY, without="", dropped="kernel.terminal.obey: guard that is no more")
    beyond = replace(CANARY, part=1_000)
    monkeypatch.setattr(canaries, "CANARIES", (gone, beyond))
    seen = canaries.seen(("z3",), "interlocking")
    assert len(seen) == 2
    assert not any(one["noticed"] for one in seen)
    assert all("proofs.canary_search" in one["answer"] for one in seen)


def test_a_theory_that_drops_no_guard_is_believed_nothing(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(canaries, "CANARIES", [each for each in canaries.CANARIES if each.theory != "brake_watch"])
    (missed,) = [each for each in canaries.seen(("z3",), "brake_watch") if not each["noticed"]]
    assert missed["canary"] == "brake_watch: a guard of its kernel"
    assert all(each["noticed"] for each in canaries.seen(("z3",), "tag_window"))


def test_the_search_keeps_what_serves_and_finds_another_for_what_does_not() -> None:
    brake_watch = next(each for each in canaries.guards() if each.theory == "brake_watch")
    assert canary_search.still_serves(brake_watch)
    whole = replace(brake_watch, dropped="", without="no such hypothesis")
    assert not canary_search.still_serves(whole), "it holds as it is"
    assert not canary_search.still_serves(replace(brake_watch, dropped=f"{brake_watch.dropped} no more"))
    assert canary_search.found(THEORIES["brake_watch"]) == brake_watch


def test_what_the_search_finds_serves_where_a_claim_asks_the_kernel_too() -> None:
    """A drop in what both the step and the claim ask is one in both."""
    found = canary_search.found(THEORIES["alarm_network"])
    assert found in canaries.guards()
    assert canary_search.still_serves(found)


def test_one_missed_canary_spoils_the_verdict_the_matrix_and_junit() -> None:
    missed: CanarySeen = {
        "canary": "a row × a claim without a guard",
        "solver": "z3",
        "solver_version": "0",
        "process": 7,
        "answer": "unsat",
        "noticed": False,
    }
    report = Report([obligation()], 0.1, 0.2, [{**missed, "solver": "cvc5", "noticed": True}, missed])
    assert report.exit_code == 3
    text = io.StringIO()
    print_matrix(Console(file=text, width=160, color_system=None), report)
    assert "z3 0 in process 7 answers unsat to what does not hold, a row × a claim without a guard" in text.getvalue()
    assert "cvc5 0 in process" not in text.getvalue()
    assert etree.fromstring(junit_xml(report)).get("failures") == "1"
