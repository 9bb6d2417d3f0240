"""The prover proves what holds, says so in full, and calls nothing else proved."""

from __future__ import annotations

import hashlib
import inspect
import json
import os
import re
import subprocess
import sys
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest
import z3
from lxml import etree

import heisoku
from kernel.names import Epoch, Run
from models.world.state import Site, System
from proofs import run, scripts, smtlib, solvers
from proofs.catalogue import AXIOMS, INITIAL, INVARIANTS, PREMISES, STEPS
from proofs.lift import OutsideSubset, UnboundedScope
from proofs.records import Obligation
from proofs.run import prove_all
from proofs.solvers import Reply
from proofs.theories import THEORIES, columns
from proofs.theory import EVERY_LOOKUP_IS_DEFINED
from proofs.workbench import Part, Workbench

TRIES = 4

ROOT = Path(__file__).resolve().parent.parent.parent
SAMPLE = (
    ("init", "reach_is_exclusive"),
    ("request", "locks_agree"),
    ("note_confirmation", "a_proved_point_stays"),
    ("release_block", "a_reachable_block_is_held"),
    ("restart_centre", "physical_occupancy_is_recorded"),
    ("send_permit", "reach_is_exclusive"),
    ("tail_reads", "a_reported_block_is_left_by_all_cars"),
    ("car_moves", "no_two_trains_in_a_block"),
    ("request", EVERY_LOOKUP_IS_DEFINED),
    ("reading", "no_open_flank"),
)
"""An obligation of each kind."""
ONLY_SAMPLE = "|".join(f"^{row} {column}$" for row, column in SAMPLE)
ROW = "send_permit"
"""A row to prove as a whole."""
FIELDS = {
    *(
        "transition",
        "invariant",
        "hypotheses",
        "axioms",
        "verdict",
        "solver",
        "seed",
        "rlimit",
        "seconds",
        "smt2_sha256",
    ),
    *("solver_version", "rlimit_spent", "source"),
}


@pytest.fixture
def fresh_bench() -> Iterator[None]:
    """Lift anew, before and after something was planted."""
    run.bench.cache_clear()
    run.source.cache_clear()
    yield
    run.bench.cache_clear()
    run.source.cache_clear()


def verdicts(obligations: Any) -> set[str]:
    return {obligation["verdict"] for obligation in obligations}


# ---- what holds is proved, and said in full


@pytest.fixture(scope="module")
def sample() -> list[Obligation]:
    """The sample, by both solvers."""
    return list(prove_all(solver="both", jobs=1, only=ONLY_SAMPLE).obligations)


def test_both_solvers_prove_the_sample(sample: list[Obligation]) -> None:
    asked = {(obligation["transition"], obligation["invariant"]) for obligation in sample}
    assert asked == set(SAMPLE)
    for solver in ("z3", "cvc5"):
        assert verdicts(one for one in sample if one["solver"] == solver) == {"proved"}
    assert len(sample) == 2 * len(SAMPLE)


def test_an_obligation_is_recorded_in_full(sample: list[Obligation]) -> None:
    for one in sample:
        assert set(one) == FIELDS
        assert 0 < one["rlimit_spent"] < one["rlimit"]
        assert one["seconds"] > 0
        assert re.fullmatch(r"[0-9a-f]{64}", one["smt2_sha256"])
        assert one["solver_version"] == solvers.version(one["solver"])
        first, last = one["source"]["lines"]
        lines = (ROOT / one["source"]["file"]).read_text("utf-8").splitlines()[first - 1 : last]
        named = one["transition"] if one["invariant"] == EVERY_LOOKUP_IS_DEFINED else one["invariant"]
        assert lines[0].startswith(f"def {named}(")
        assert lines[-1].startswith(" ")


def test_the_hypotheses_of_an_obligation_are_those_of_its_script_and_exist(sample: list[Obligation]) -> None:
    known = {*AXIOMS, *PREMISES, *INITIAL, *INVARIANTS}
    for one in sample:
        assert one["hypotheses"] == scripts.hypotheses(one["transition"], one["invariant"])
        assert set(one["hypotheses"]) <= known
    assert len({tuple(one["hypotheses"]) for one in sample}) > len(SAMPLE) // 2


def test_a_whole_row_is_proved_by_both_solvers() -> None:
    report = prove_all(solver="both", jobs=1, only=f"^{ROW} ")
    assert [one["invariant"] for one in report.obligations if one["solver"] == "z3"] == columns(ROW)
    assert [one["invariant"] for one in report.obligations if one["solver"] == "cvc5"] == columns(ROW)
    assert verdicts(report.obligations) == {"proved"}
    assert report.exit_code == 0


def test_every_seed_is_recorded() -> None:
    report = prove_all(solver="z3", jobs=1, seeds=3, only="^send_permit a_message_follows_its_stage$")
    assert [one["seed"] for one in report.obligations] == [0, 1, 2]
    assert len({one["smt2_sha256"] for one in report.obligations}) == 1
    assert report.exit_code == 0


def test_progress_is_told_to_the_end() -> None:
    told: list[tuple[int, int, str]] = []
    prove_all(jobs=1, only="^(part|send_challenge) locks_agree$", progress=lambda *what: told.append(what))
    assert told == [(1, 2, "send_challenge"), (2, 2, "part")]


def test_every_invariant_has_something_to_prove_over_every_transition() -> None:
    """A transition that could change nothing would prove everything."""
    bench = run.bench()
    assert [row for row in STEPS if not bench.ways(row)] == []
    assert [(row, "locks_agree") for row in STEPS if not run.parts(row, "locks_agree")] == []


# ---- the command line


def prove(*arguments: str) -> subprocess.CompletedProcess[str]:
    command = [sys.executable, str(ROOT / "heisoku.py"), "prove", *arguments]
    return subprocess.run(command, capture_output=True, text=True, cwd=ROOT, check=False)


def test_the_command_line_writes_the_record_and_junit(tmp_path: Path, sample: list[Obligation]) -> None:
    record, junit = tmp_path / "prove.json", tmp_path / "prove.xml"
    ended = prove("--only", ONLY_SAMPLE, "--jobs", "2", "--json", str(record), "--junit", str(junit))
    assert ended.returncode == 0, ended.stderr
    assert f"{len(SAMPLE)} proved, 0 refuted, 0 undecided" in ended.stdout
    written = json.loads(record.read_text("utf-8"))
    assert written["verdict"] == "proved"
    assert written["lifting_seconds"] > 0
    assert written["wall_seconds"] > 0
    told = {(one["transition"], one["invariant"]): one["smt2_sha256"] for one in written["obligations"]}
    here = {(one["transition"], one["invariant"]): one["smt2_sha256"] for one in sample}
    assert told == here, "another process writes the same texts"
    cases = list(etree.parse(str(junit)).iter("testcase"))
    assert len(cases) == len(SAMPLE)
    assert not any(len(case) for case in cases)


@pytest.mark.parametrize("pattern", ["no such name", "("])
def test_a_pattern_of_no_use_is_bad_usage(pattern: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert heisoku.run(["prove", "--jobs", "1", "--only", pattern]) == 2
    error = capsys.readouterr().err
    assert len(error.splitlines()) == 1
    assert pattern in error


def test_what_is_not_proved_fails_the_command(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    record = tmp_path / "prove.json"
    for answer, code in (("sat", 1), ("unknown", 3)):
        monkeypatch.setattr(solvers, "ask", lambda solver, part, seed, answer=answer: Reply(answer, 1, 0.0))
        assert heisoku.run(["prove", "--jobs", "1", "--only", "^part locks_agree$", "--json", str(record)]) == code
        assert json.loads(record.read_text("utf-8"))["verdict"] in {"refuted", "undecided"}


# ---- what does not hold is not proved


def test_a_script_without_a_needed_hypothesis_proves_nothing(monkeypatch: pytest.MonkeyPatch) -> None:
    """For each obligation of the sample that names hypotheses: at least one of them is needed."""
    hypotheses = scripts.hypotheses
    for row, column in SAMPLE:
        assert any(
            is_needed(monkeypatch, row, column, [name for name in hypotheses(row, column) if name != dropped])
            for dropped in hypotheses(row, column)
        ), f"{row} {column}"


def is_needed(monkeypatch: pytest.MonkeyPatch, row: str, column: str, others: list[str]) -> bool:
    """Tell whether an obligation is not proved of these hypotheses alone."""
    monkeypatch.setattr(scripts, "hypotheses", lambda r, c: others)
    report = prove_all(jobs=1, only=f"^{row} {column}$")
    assert (report.exit_code == 0) == (report.verdict == "proved")
    return report.verdict != "proved"


def test_an_invariant_that_does_not_hold_is_not_proved(monkeypatch: pytest.MonkeyPatch, fresh_bench: None) -> None:
    monkeypatch.setitem(INVARIANTS, nobody_is_ever_permitted.__name__, nobody_is_ever_permitted)
    report = prove_all(solver="both", jobs=1, only="^(send_permit|send_echo) nobody_is_ever_permitted$")
    told = {(one["transition"], one["solver"]): one["verdict"] for one in report.obligations}
    assert told["send_echo", "z3"] == told["send_echo", "cvc5"] == "proved"
    assert told["send_permit", "z3"] != "proved"
    assert told["send_permit", "cvc5"] != "proved"
    assert report.exit_code in (1, 3)


def nobody_is_ever_permitted(site: Site, system: System) -> bool:
    """Not so."""
    return not any(True for _ in system.radio.permits)


def permit_whatever_was_echoed(site: Site, system: System, run: Run) -> System:
    """A centre that does not look whether the run is still set."""
    if run not in system.radio.echoes:
        return system
    return replace(system, radio=replace(system.radio, permits=system.radio.permits | {run}))


def restart_into_an_empty_line(site: Site, system: System, epoch: Epoch) -> System:
    """A centre that comes back with every block unoccupied."""
    return replace(system, centre=replace(system.centre, epoch=epoch, runs={}, claimed={}, lost_blocks=frozenset()))


@pytest.mark.parametrize(
    ("row", "wrong", "broken"),
    [
        ("send_permit", permit_whatever_was_echoed, "a_reachable_block_is_held"),
        ("restart_centre", restart_into_an_empty_line, "physical_occupancy_is_recorded"),
    ],
)
def test_a_transition_that_does_wrong_is_not_proved(
    row: str, wrong: Any, broken: str, monkeypatch: pytest.MonkeyPatch, fresh_bench: None
) -> None:
    monkeypatch.setitem(STEPS, row, wrong)
    monkeypatch.setitem(solvers.BUDGET, "z3", 1_000_000)
    report = prove_all(jobs=1, only=f"^{row} {broken}$")
    assert [one["verdict"] == "proved" for one in report.obligations] == [False]
    assert report.exit_code in (1, 3)


@pytest.mark.parametrize("solver", ["z3", "cvc5"])
def test_a_solver_that_runs_out_of_its_budget_has_decided_nothing(solver: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(solvers.BUDGET, solver, 1)
    report = prove_all(solver=solver, jobs=1, only="^send_permit (reach_is_exclusive|no_open_flank)$")
    assert verdicts(report.obligations) == {"undecided"}
    assert {one["rlimit"] for one in report.obligations} == {1}
    assert report.exit_code == 3


@pytest.mark.parametrize(
    ("answers", "verdict"),
    [
        (["sat"], "refuted"),
        (["unknown"], "undecided"),
        ([""], "undecided"),
        (["unsat", "sat", "unknown"], "refuted"),
        (["unsat", "unknown"], "undecided"),
        (["unsat"], "proved"),
    ],
)
def test_only_unsat_of_every_part_counts_as_proved(
    answers: list[Any], verdict: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    given = iter(answers)
    monkeypatch.setattr(solvers, "ask", lambda solver, part, seed: Reply(next(given), 1, 0.0))
    parts = run.parts("car_moves", "a_held_block_is_closed_to_others")[:1] * len(answers)
    monkeypatch.setattr(run, "parts", lambda row, column: parts)
    report = prove_all(jobs=1, only="^car_moves a_held_block_is_closed_to_others$")
    assert report.verdict == verdict


def test_cvc5_that_says_anything_but_unsat_has_not_proved() -> None:
    assert solvers.ask_cvc5("(set-logic ALL)\n(assert false)\n(check-sat)\n", 0)[0] == "unsat"
    assert solvers.ask_cvc5("(set-logic ALL)\n(assert true)\n(check-sat)\n", 0)[0] == "sat"
    assert solvers.ask_cvc5("(set-logic ALL)\n(assert false)\n", 0)[0] == "unknown"


def test_what_cannot_be_lifted_is_an_error_and_no_proof(monkeypatch: pytest.MonkeyPatch, fresh_bench: None) -> None:
    def counts(site: Site, system: System) -> bool:
        return len([run for run in system.radio.permits]) == 0  # noqa: C416

    monkeypatch.setitem(INVARIANTS, "counts", counts)
    with pytest.raises(OutsideSubset, match=r"test_prover\.py:\d+"):
        prove_all(jobs=1, only="^part counts$")


# ---- the texts


TEXTS = """
import hashlib, sys
from proofs import run, smtlib
from proofs.theories import columns
first, *cells = sys.argv[1:]
if first == "others":
    for row in ("request", "car_moves", "note_standing"):
        for column in columns(row)[::7]:
            "".join(smtlib.script(part) for part in run.parts(row, column))
for cell in cells:
    row, column = cell.split()
    text = "".join(smtlib.script(part) for part in run.parts(row, column))
    print(cell, hashlib.sha256(text.encode()).hexdigest())
"""


def texts_of_another_process(first: str, seed: str) -> dict[str, str]:
    ended = subprocess.run(
        [sys.executable, "-c", TEXTS, first, *(f"{row} {column}" for row, column in SAMPLE)],
        capture_output=True,
        text=True,
        cwd=ROOT,
        env={**os.environ, "PYTHONHASHSEED": seed, "PYTHONPATH": str(ROOT)},
        check=True,
    )
    return dict(line.rsplit(" ", 1) for line in ended.stdout.splitlines())


def test_the_text_is_the_same_in_every_process_whatever_was_lifted_before(sample: list[Obligation]) -> None:
    here = {f"{one['transition']} {one['invariant']}": one["smt2_sha256"] for one in sample}
    assert texts_of_another_process("nothing", "1") == here
    assert texts_of_another_process("others", "2") == here


def test_the_text_asserts_what_the_record_names() -> None:
    """Each hypothesis under its name, the orders of numbered identifiers, and the negated goal."""
    for row, column in SAMPLE:
        named = set(scripts.hypotheses(row, column))
        parts = run.parts(row, column)
        assert parts
        for part in parts:
            text = smtlib.script(part)
            written = {re.sub(r"\.\d+$", "", name) for name in re.findall(r":named \|?([^|)]+)\|?\)", text)}
            orders = {name for name in written if name.startswith("before_") or " is empty outside " in name}
            assert written - orders == named - orders
            assert text.count("(assert (not ") >= 1
            assert text.count("(check-sat)") == 1


def test_the_text_is_what_z3_was_asked() -> None:
    """Read back it is as unsatisfiable, without its goal it is not."""
    row, column = "send_permit", "a_message_follows_its_stage"
    for part in run.parts(row, column):
        text = smtlib.script(part)
        again = z3.Solver()
        again.from_string(text.replace("(check-sat)", ""))
        assert again.check() == z3.unsat
        head, goal = text.rsplit("(assert (not ", 1)
        assert "(check-sat)" in goal
        assert len(again.assertions()) == head.count("(assert ") + 1


def test_the_hash_is_of_the_text(sample: list[Obligation]) -> None:
    for one in sample:
        parts = run.parts(one["transition"], one["invariant"])
        text = "".join(smtlib.script(part) for part in parts)
        assert hashlib.sha256(text.encode()).hexdigest() == one["smt2_sha256"]


# ---- both encodings


@pytest.mark.sampled(2)
@pytest.mark.parametrize("named", [True, False], ids=["two vocabularies", "substituted"])
def test_both_forms_of_a_transition_prove_the_sample(named: bool) -> None:
    bench = Workbench(scope=UnboundedScope(), named=named)
    for row, column in SAMPLE:
        if row not in STEPS or column == EVERY_LOOKUP_IS_DEFINED:
            continue
        parts = bench.parts(row, column, scripts.hypotheses(row, column))
        assert parts
        assert any(part.given[1:] for part in parts) is named, "definitions of the state after"
        for part in parts:
            assert solvers.ask("z3", part, 0).answer == "unsat"
            assert solvers.ask("cvc5", part, 0).answer == "unsat"


@pytest.mark.parametrize("column", ["the_computer_has_the_proved_spacing", "the_front_stays_before_the_end"])
def test_every_way_is_asked_of_or_leaves_what_is_supposed(column: str) -> None:
    row = "take_end"
    bench = Workbench(THEORIES["train"], named=False)
    names = scripts.hypotheses(f"train.{row}", column)
    parts = bench.parts(row, column, names)
    asked = {(*(each.get_id() for each in part.given), part.goal.get_id()) for part in parts}
    supposed = {formula.get_id() for part in parts for formulas in part.hypotheses.values() for formula in formulas}
    whole = [(way, goal) for way in bench.ways(row) for goal in bench.claim(way.after, column)]
    assert {goal.get_id() for _, goal in whole} == {goal for *_, goal in asked}
    for way, goal in whole:
        given = [part.given for part in parts if part.goal.get_id() == goal.get_id()]
        if goal.get_id() in supposed:
            assert given == [[]]
        else:
            others = z3.Solver()
            others.add(way.condition, *(z3.Not(z3.And(each)) for each in given))
            assert others.check() == z3.unsat, "a way of which it is not asked"
    assert len(parts) == len(asked) <= len(whole)
    assert bool([goal for _, goal in whole if goal.get_id() in supposed]) is (column in names)
    assert {solvers.ask(solver, part, 0).answer for part in parts for solver in ("z3", "cvc5")} == {"unsat"}


def test_a_planted_function_is_what_it_seems() -> None:
    """Planted transitions have the signature of those they stand for."""
    for row, wrong in (("send_permit", permit_whatever_was_echoed), ("restart_centre", restart_into_an_empty_line)):
        assert list(inspect.signature(wrong).parameters) == list(inspect.signature(STEPS[row]).parameters)


def test_what_an_obligation_spends_does_not_depend_on_what_was_done_before() -> None:
    """Z3 counts on while terms are made and other questions are asked; that is not this question's cost."""
    part = run.parts("send_permit", "reach_is_exclusive")[0]
    first = solvers.ask("z3", part, 0)
    z3.simplify(z3.And(*(z3.Int(f"left.{index}") * 3 + 2 > z3.Int(f"right.{index}") for index in range(20_000))))
    again = solvers.ask("z3", part, 0)
    assert first.answer == again.answer == "unsat"
    assert 0 < again.spent < 3 * first.spent, "the terms made between would count four times as much"


def test_a_cell_in_which_nothing_is_asked_says_so_and_only_a_look_up_may_be_one() -> None:
    """Nothing asked is nothing proved: of a claim that is to be kept it decides nothing."""
    empty = run.settle("cycle.receive", EVERY_LOOKUP_IS_DEFINED, "z3", 0, [], "")
    assert (empty["verdict"], empty["note"]) == ("proved", run.NOTHING_TO_ASK)
    kept = run.settle("split.run_a_cycle", "split_is_latched", "z3", 0, [], "")
    assert (kept["verdict"], kept["note"]) == ("undecided", run.NOTHING_TO_ASK)


def test_how_many_cells_ask_nothing_is_told(capsys: pytest.CaptureFixture[str]) -> None:
    assert heisoku.run(["prove", "--only", "^cycle.receive ", "--jobs", "1"]) == 0
    assert "in 1 of them nothing is looked up, so nothing was asked" in capsys.readouterr().out


def test_what_z3_leaves_unknown_is_asked_again_and_then_by_its_text(monkeypatch: pytest.MonkeyPatch) -> None:
    """Twice in its context, the first time with less of the budget, then in two more; the last is the text's alone."""
    x = z3.Int("x")
    part = Part({"x_is_positive": [x > 0]}, [], x > -1)
    asked: list[tuple[z3.Context, str]] = []
    shares: list[int] = []

    def at_a_loss(solver: z3.Solver, seed: int, share: int = 1) -> tuple[str, int]:
        asked.append((solver.ctx, solver.to_smt2()))
        shares.append(share)
        return ("unknown", 5) if len(asked) < TRIES else (str(solver.check()), 3)

    monkeypatch.setattr(solvers, "_ask_z3_once", at_a_loss)
    assert solvers.first_answer(solvers.z3_tries(part, 7)) == ("unsat", 5)
    assert len({str(context.ref()) for context, _ in asked}) == TRIES - 1
    assert shares == [solvers.FIRST, *[1] * (TRIES - 1)]
    assert "(> x 0)" in asked[-1][1]
