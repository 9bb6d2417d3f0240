"""Planted faults: what is known of them is true of the code as it is, and a draw is what it says."""

from __future__ import annotations

import ast
import json
from pathlib import Path

import pytest

from fuzz.planted import draw, killed, reachable
from proofs.lift.sources import definition_of
from proofs.mutants.edits import named

SOME = 40


def test_every_fault_on_record_is_still_a_mutant() -> None:
    for name in killed.rows():
        assert named(name).name == name


def test_no_fault_on_record_stands_with_the_survivors() -> None:
    from proofs.mutants.classes import SERVICE, table

    assert [name for name in killed.rows() if name in table() and table()[name].kind != SERVICE] == []


def test_a_draw_has_every_machine_and_every_loop() -> None:
    faults = draw.drawn(seed=11)
    assert len(faults) == len({fault.name for fault in faults}) == draw.COUNT
    assert {fault.machine for fault in faults} == set(killed.killed())
    assert {fault.loop for fault in faults} >= set(draw.LOOPS)


def test_a_draw_follows_from_its_seed() -> None:
    assert draw.drawn(seed=1) == draw.drawn(seed=1)
    assert draw.drawn(seed=1) != draw.drawn(seed=2)


@pytest.mark.parametrize("count", [0, 5, 10_000])
def test_a_draw_that_cannot_be_is_refused(count: int, capsys: pytest.CaptureFixture[str]) -> None:
    assert draw.main(["--count", str(count)]) == 2
    said = capsys.readouterr()
    assert said.err.count("\n") == 1
    assert f"--count {count}" in said.err


def test_a_fault_is_where_it_is_said_to_be() -> None:
    """The line given is the first in which the function with the fault reads otherwise."""
    for fault in draw.drawn(seed=3):
        mutant = named(fault.name)
        own = definition_of(mutant.function)
        assert own.end_lineno is not None
        assert own.lineno < fault.line <= own.end_lineno
        assert mutant.function.__name__ in fault.words
        line = (draw.ROOT / fault.file).read_text(encoding="utf-8").splitlines()[fault.line - 1]
        assert line.strip()
        if mutant.kind == "guard":
            assert line.split()[0] == "if"


def test_the_sources_of_a_fault_are_another_body_of_its_function() -> None:
    for fault in draw.drawn(seed=5):
        ((function, tree),) = draw.planted(fault.name).items()
        assert f"{function.__module__}.{function.__name__}" == fault.name.partition(": ")[0]
        assert ast.unparse(tree) != ast.unparse(definition_of(function))
        assert draw.name_of(draw.planted(fault.name)) == fault.name


@pytest.mark.parametrize("name", ["", "kernel.nowhere.at_all: guard x", "kernel.release.release: guard of nothing"])
def test_an_unknown_fault_is_no_fault(name: str) -> None:
    with pytest.raises(KeyError):
        draw.planted(name)


def test_a_draw_is_printed(capsys: pytest.CaptureFixture[str]) -> None:
    assert draw.main(["--seed", "9"]) == 0
    said = capsys.readouterr().out
    assert f"{draw.COUNT} faults of {len(killed.rows())} by seed 9" in said
    for fault in draw.drawn(seed=9):
        assert f"{fault.file}:{fault.line}: " in said


def test_the_record_is_made_from_the_trials(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    trials = [
        {"mutant": 'kernel.release.release: guard if "x": y', "outcome": "counterexample", "by": "release_block"},
        {"mutant": "kernel.release.release: update z", "outcome": "witness", "by": "some witness"},
        {"mutant": "models.world.radio.send_stop: guard if w", "outcome": "counterexample", "by": "send_stop"},
    ]
    source, out = tmp_path / "mutants.json", tmp_path / "killed.toml"
    source.write_text(json.dumps({"mutants": trials}), encoding="utf-8")
    assert killed.main([str(source), "--out", str(out)]) == 0
    assert killed.killed(out) == {"kernel.release": {'kernel.release.release: guard if "x": y': "release_block"}}
    assert "1 drops of 1 machines, from 3 trials" in capsys.readouterr().out


@pytest.mark.parametrize("text", ["", "[]", '{"mutants": 3}', "\x00"])
def test_a_record_that_is_none_is_refused(text: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    source, out = tmp_path / "mutants.json", tmp_path / "killed.toml"
    source.write_text(text, encoding="utf-8")
    assert killed.main([str(source), "--out", str(out)]) == 2
    assert capsys.readouterr().err.count("\n") == 1
    assert not out.exists()


def test_a_walk_on_record_finds_its_fault() -> None:
    """The walk of that number breaks that claim with the fault, and nothing without it."""
    known = reachable.reachable()
    walks = sorted((shown, theory, name) for theory, found in known.items() for name, shown in found.items())
    assert walks
    for shown, theory, name in walks[:: max(1, len(walks) // SOME)]:
        if shown.walk < SOME:
            broken = reachable.broken_by(theory, draw.planted(name), shown.walk)
            assert broken is not None, name
            assert reachable.violated_by(broken)[0] == shown.violated
            assert reachable.broken_by(theory, {}, shown.walk) is None


def test_every_fault_on_record_as_reachable_is_one_that_is_killed() -> None:
    for theory, found in reachable.reachable().items():
        for name in found:
            assert name in killed.rows()
            assert draw.described(name).theory == theory
