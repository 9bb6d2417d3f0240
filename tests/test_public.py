"""What other programs call: its examples run, and it says what the commands say."""

from __future__ import annotations

import doctest
import inspect
import json
import math
import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

import heisoku
import heisoku_public
from heisoku import BadInput, check, load, prove, simulate
from models.simulation.faults import Setting

ROOT = Path(__file__).resolve().parent.parent
STATION = "layouts/passing_station.toml"


@pytest.fixture(autouse=True)
def _at_the_top(monkeypatch: pytest.MonkeyPatch) -> None:
    """Examples name layouts as they lie in the repository."""
    monkeypatch.chdir(ROOT)


@pytest.mark.parametrize("called", [load, check, prove, simulate], ids=lambda called: called.__name__)
def test_an_example_says_what_it_promises(called: Callable[..., object]) -> None:
    (example,) = doctest.DocTestFinder().find(called, called.__name__, globs=vars(heisoku_public).copy())
    assert len(example.examples) >= 1
    said: list[str] = []
    ended = doctest.DocTestRunner().run(example, out=said.append)
    assert (ended.failed, ended.attempted) == (0, len(example.examples)), "".join(said)


def test_the_example_of_the_readme_runs() -> None:
    (text,) = re.findall(r"```python\n(.*?)```", (ROOT / "README.md").read_text("utf-8"), re.DOTALL)
    made: dict[str, Any] = {}
    exec(compile(text, "README.md", "exec"), made)
    assert made["report"].verdict == "proved"


def test_everything_is_typed_and_described() -> None:
    for name in set(heisoku_public.__all__) - {"BadInput"}:
        called = getattr(heisoku, name)
        assert called is getattr(heisoku_public, name)
        signature = inspect.signature(called)
        assert signature.return_annotation is not inspect.Signature.empty
        assert all(each.annotation is not inspect.Parameter.empty for each in signature.parameters.values())
        described = inspect.getdoc(called) or ""
        if len(signature.parameters) > 1:
            assert [each for each in signature.parameters if f"    {each}: " not in described] == []


def test_a_check_is_the_command_s(tmp_path: Path) -> None:
    for more, given in (
        ((), {}),
        (("--strict",), {"strict": True}),
        (("--clearance", "400 m"), {"clearance_mm": 400_000}),
    ):
        code = heisoku.run(["check", STATION, *more, "--json", str(tmp_path / "F")])
        (told,) = json.loads((tmp_path / "F").read_text("utf-8"))["layouts"]
        found = check(load(STATION), **given)
        assert (found.verdict, found.exit_code, dict(found.checked)) == (told["verdict"], code, told["checked"])
        assert len(found.violations) == len(told["violations"])


def test_a_simulation_is_the_command_s(tmp_path: Path) -> None:
    words = ["simulate", STATION, "--hours", "0.05", "--seed", "7", "--json", str(tmp_path / "F")]
    assert heisoku.run(words) == 0
    told = json.loads((tmp_path / "F").read_text("utf-8"))
    found = json.loads(json.dumps(simulate(load(STATION), hours=0.05, seed=7).record()))
    assert {name: told[name] for name in found} == found


def test_a_proof_is_the_command_s(tmp_path: Path) -> None:
    only = r"^display\.init "
    assert heisoku.run(["prove", "--jobs", "1", "--only", only, "--json", str(tmp_path / "F")]) == 0
    told = json.loads((tmp_path / "F").read_text("utf-8"))
    found = prove(only).record()
    what = ("transition", "invariant", "verdict", "smt2_sha256", "hypotheses", "axioms")
    assert [[each[name] for name in what] for each in json.loads(json.dumps(found["obligations"]))] == [
        [each[name] for name in what] for each in told["obligations"]
    ]


def test_what_cannot_be_used_is_said_and_ends_nothing(tmp_path: Path) -> None:
    with pytest.raises(BadInput, match=r"none\.toml: file: No such file"):
        load(tmp_path / "none.toml")
    with pytest.raises(ValueError, match="not a pattern"):
        prove("(")
    with pytest.raises(ValueError, match="is named so"):
        prove("no such row")
    with pytest.raises(ValueError, match="z3, cvc5 or both"):
        prove("^split", solver="cvc4")  # type: ignore[arg-type]
    station = load(STATION)
    with pytest.raises(BadInput, match="trains can stand apart"):
        simulate(station, trains=99)
    for wrong in ({"trains": 0}, {"trips": 0}, {"cars": 1}):
        with pytest.raises(ValueError, match="more than none"):
            simulate(station, **wrong)  # type: ignore[arg-type]
    for hours in (0, 1e-9, math.nan, math.inf):
        with pytest.raises(ValueError, match=r"0\.01 to 240\.0"):
            simulate(station, hours=hours)
    with pytest.raises(ValueError, match="there is no 'antena'"):
        simulate(station, faults={"antena": Setting(1.0, 1, 1)})
    for clearance_mm in (-30_000, math.nan, 20_000.0, True):
        with pytest.raises(ValueError, match="whole millimetres"):
            check(station, clearance_mm=clearance_mm)  # type: ignore[arg-type]
