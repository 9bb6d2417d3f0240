"""CrossHair confirms every contract over all paths; what does not hold, or claims nothing, is noticed.

CrossHair runs the bytecode itself on symbolic integers, so it shares nothing with the lifter.
"""

from __future__ import annotations

import ast
import re
import subprocess
import sys
from collections.abc import Sequence
from importlib.util import find_spec
from itertools import takewhile
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
FILES = sorted([*ROOT.glob("tests/contracts_*.py"), *ROOT.glob("tests/*/contracts_*.py")])
"""Those that `make crosshair` checks."""
CONFIRMED = "Confirmed over all paths."
OF_A_TYPE = "assert isinstance("
"""How a contract begins that assumes nothing: CrossHair asks for an assertion to begin with."""
LINE = re.compile(r"^(?P<file>.+?\.py):(?P<line>\d+): (?P<kind>\w+): (?P<text>.*)$")

Place = tuple[str, str]
"""The name of a file and of a contract in it."""

installed = pytest.mark.skipif(
    find_spec("crosshair") is None, reason="CrossHair is not installed: `make crosshair` installs it and checks"
)


def functions(path: Path) -> list[ast.FunctionDef]:
    """The functions of a file."""
    return [each for each in ast.parse(path.read_text("utf-8")).body if isinstance(each, ast.FunctionDef)]


def assumptions(function: ast.FunctionDef) -> list[ast.stmt]:
    """The assertions that CrossHair takes for granted: the leading ones, but never the last statement."""
    body = function.body[1:] if ast.get_docstring(function) else function.body
    return list(takewhile(lambda each: isinstance(each, ast.Assert), body[:-1]))


def contracts(*files: Path) -> set[Place]:
    """The functions that CrossHair takes for contracts."""
    return {(path.name, each.name) for path in files for each in functions(path) if assumptions(each)}


def verdicts(files: Sequence[Path]) -> dict[Place, str]:
    """What CrossHair says of every contract; each is given a minute, as `make crosshair` does."""
    check = (sys.executable, "-m", "crosshair", "check")
    options = ("--analysis_kind=asserts", "--report_all", "--per_condition_timeout=60")
    told = subprocess.run(
        [*check, *options, *map(str, files)], cwd=ROOT, capture_output=True, text=True, timeout=1_800, check=False
    )
    lines = told.stdout.splitlines()
    found = [match for line in lines if (match := LINE.match(line))]
    assert found, f"nothing said: {told.stderr}"
    assert len(found) == len(lines), f"not understood: {told.stdout}{told.stderr}"
    written = {path.name: functions(path) for path in files}
    said: dict[Place, str] = {}
    for match in found:
        name, line = Path(match["file"]).name, int(match["line"])
        at = next(each.name for each in written[name] if each.lineno <= line <= (each.end_lineno or 0))
        assert (name, at) not in said, f"said twice: {match[0]}"
        said[name, at] = match["text"]
    return said


def turned(path: Path, place: Path) -> Path:
    """Write a file that claims what each contract assumes, one after another, and in the end that nothing is left.

    CrossHair confirms what cannot be begun, and takes for granted a claim that stands among the
    assumptions; both show here, as something that is confirmed.
    """
    tree = ast.parse(path.read_text("utf-8"))
    body: list[ast.stmt] = []
    for each in tree.body:
        if not isinstance(each, ast.FunctionDef) or not assumptions(each):
            body.append(each)
            continue
        for number, claim in enumerate([*assumptions(each), ast.Assert(ast.Constant(False))]):
            if ast.unparse(claim).startswith(OF_A_TYPE):
                continue
            assumed = [ast.Assert(ast.Constant(True)), *assumptions(each)[:number]]
            contract = ast.parse(f"def {each.name}_{number}() -> None: pass").body[0]
            assert isinstance(contract, ast.FunctionDef)
            contract.args, contract.body = each.args, [*assumed, ast.Pass(), claim]
            body.append(contract)
    tree.body = body
    written = place / path.name
    written.write_text(ast.unparse(ast.fix_missing_locations(tree)), "utf-8")
    return written


def test_a_function_of_a_contract_file_is_a_contract_or_gives_something() -> None:
    for path in FILES:
        nothing = {(path.name, each.name) for each in functions(path) if each.returns and is_none(each.returns)}
        assert contracts(path) == nothing
        assert nothing


def is_none(written: ast.expr) -> bool:
    return isinstance(written, ast.Constant) and written.value is None


@installed
def test_every_contract_is_confirmed_over_all_paths() -> None:
    assert verdicts(FILES) == dict.fromkeys(contracts(*FILES), CONFIRMED)


@installed
def test_every_assumption_leaves_something_out_and_something_in(tmp_path: Path) -> None:
    files = [turned(path, tmp_path) for path in FILES]
    said = verdicts(files)
    assert set(said) == contracts(*files)
    assert [at for at, text in said.items() if not text.startswith("AssertionError")] == []


PLANTED = """
from kernel.onboard.arithmetic import larger

def holds(one: int, other: int) -> None:
    assert one < other
    assert larger(one, other) == other

def holds_not(one: int, other: int) -> None:
    assert one < other
    assert larger(one, other) == one

def cannot_be_begun(one: int, other: int) -> None:
    assert one < other
    assert other < one
    assert larger(one, other) == 0

def assumes_its_claim(one: int, other: int) -> None:
    assert one < other
    assert larger(one, other) == other
    assert larger(other, one) == other
"""


@installed
def test_what_does_not_hold_or_claims_nothing_is_noticed(tmp_path: Path) -> None:
    path = tmp_path / "contracts_planted.py"
    path.write_text(PLANTED, "utf-8")
    said = verdicts([path])
    assert {name for (_, name), text in said.items() if text != CONFIRMED} == {"holds_not"}
    place = tmp_path / "turned"
    place.mkdir()
    said = verdicts([turned(path, place)])
    assert {name for (_, name), text in said.items() if not text.startswith("AssertionError")} == {
        "cannot_be_begun_2",
        "assumes_its_claim_1",
    }
