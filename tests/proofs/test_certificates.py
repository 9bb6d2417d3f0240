"""A certificate is a proof that was gone through step by step; what is no theorem gets none."""

from __future__ import annotations

import gzip
import hashlib
import json
import random
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
import z3

from heisoku import run
from proofs import canaries, products
from proofs.certificates import checking, outside
from proofs.certificates.checking import Certified, certified, controls, proved
from proofs.certificates.command import exit_code, lines, record
from proofs.run import parts
from proofs.theories import THEORIES, columns, row_of
from proofs.workbench import Part

DRAWN = random.Random(7)
X, Y, Z = z3.Ints("x y z")


@pytest.mark.sampled(4)
@pytest.mark.parametrize("theory", THEORIES)
def test_an_obligation_of_each_theory_is_gone_through(theory: str) -> None:
    rows = [row_of(THEORIES[theory], name) for name in THEORIES[theory].steps]
    row = DRAWN.choice(rows)
    found = certified((row, DRAWN.choice([column for column in columns(row) if parts(row, column)])))
    assert (found.answer, found.trusted) == ("checked", 0)
    assert found.steps >= found.parts >= 1


def test_what_is_no_theorem_gets_none() -> None:
    found = controls()
    assert [name for name, refused in found if not refused] == []
    assert len(found) == len(canaries.CANARIES)
    canary, part = canaries.laid_out()[0]
    answer, proof, _text = proved(part)
    assert (answer != "checked", proof) == (True, ""), canary.name


@pytest.mark.parametrize(
    ("part", "is_left"),
    [
        (Part({"grows": [X >= 0, Y <= Z]}, [], X * Y <= X * Z), lambda text: products.PRODUCT in text),
        (Part({"x_is_positive": [X > 0, Z > X]}, [Z > 3], X > -1), lambda text: "declare-fun z" not in text),
    ],
    ids=["weaker", "shorter"],
)
def test_at_a_loss_a_weaker_question_is_gone_through(
    part: Part, is_left: Callable[[str], bool], monkeypatch: pytest.MonkeyPatch
) -> None:
    once = checking._once
    monkeypatch.setattr(checking, "_once", lambda text, *more: once(text, *more) if is_left(text) else ("unknown", ""))
    answer, proof, text = proved(part)
    assert answer == "checked"
    assert proof
    assert is_left(text)


def test_a_question_with_a_model_that_is_not_the_whole_shows_nothing(monkeypatch: pytest.MonkeyPatch) -> None:
    part = Part({"z_lies_between": [X < Z, Z < Y]}, [], X < Y)
    once = checking._once
    monkeypatch.setattr(checking, "_once", lambda text, *more: ("unknown", "") if "z_l" in text else once(text, *more))
    assert proved(part)[:2] == ("unknown", "")
    assert proved(Part({}, [], X < Y))[0] == "sat"


def one(**fields: object) -> Certified:
    return Certified(**{  # type: ignore[arg-type]
        "row": "split.run_a_cycle", "column": "split_is_latched", "parts": 1, "answer": "checked",
        "steps": 3, "trusted": 0, "smt2_sha256": "", **fields,
    })  # fmt: skip


REFUSED = [("a contradiction", True)]


@pytest.mark.parametrize(
    ("found", "refused", "code"),
    [
        ([one()], REFUSED, 0),
        ([one(external="correct")], REFUSED, 0),
        ([one(), one(answer="sat")], REFUSED, 1),
        ([one(), one(answer="unknown")], REFUSED, 3),
        ([one(trusted=1)], REFUSED, 3),
        ([one(external="not correct")], REFUSED, 3),
        ([one()], [("a contradiction", False)], 3),
        ([one()], [], 3),
        ([], REFUSED, 3),
    ],
)
def test_only_what_is_checked_with_every_control_refused_holds(
    found: list[Certified], refused: list[tuple[str, bool]], code: int
) -> None:
    told = record(found, 9, refused, None, 1.0)
    assert exit_code(told) == code
    assert told["verdict"] == {0: "holds", 1: "does not hold", 3: "undecided"}[code]
    assert lines(told)[-1].endswith(told["verdict"])


@pytest.fixture
def stub(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Path]:
    """A program in the external checker's place; what it says is written by the test."""
    checker, rules = tmp_path / outside.CHECKER, tmp_path / "Cpc.eo"
    rules.write_text("")
    checker.write_text("")
    checker.chmod(0o755)
    monkeypatch.setenv("PATH", str(tmp_path), prepend=":")
    monkeypatch.setenv(outside.RULES, str(rules))
    outside.installed.cache_clear()
    yield checker
    outside.installed.cache_clear()


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    ("says", "code"),
    [
        ("echo correct", 3),
        ('grep -q heisoku.any "$1" && { echo "not a proof"; exit 1; }; echo correct', 0),
        ("echo incomplete", 3),
        ("exit 1", 3),
    ],
    ids=["to everything", "to proofs alone", "to nothing", "it fails"],
)
def test_an_external_checker_that_passes_what_is_no_proof_is_named(
    stub: Path, tmp_path: Path, says: str, code: int, capsys: pytest.CaptureFixture[str]
) -> None:
    stub.write_text(f"#!/bin/sh\n{says}\n")
    kept = tmp_path / "certificates.json"
    assert run(["certify", "--only", "^split.init split_is_latched$", "--jobs", "1", "--json", str(kept)]) == code
    told = json.loads(kept.read_text())
    assert told["external"] == str(stub)
    named = "control: a proof of what is no theorem: went through" in capsys.readouterr().out
    assert named == (says == "echo correct")


@pytest.mark.parametrize(
    ("words", "says"),
    [
        (["--only", "("], "--only"),
        (["--only", "no such row"], "--only"),
        (["--json", "/"], "/"),
        (["--keep", "/dev/null"], "is not a folder"),
        (["--ethos", "/no/such/program"], "is no program"),
        (["--ethos", "/bin/sh", "--rules", "/no/such/file"], "Cpc.eo"),
        (["--rules", "/dev/null"], "--ethos"),
    ],
)
def test_what_cannot_be_asked_is_one_line_and_code_2(
    words: list[str], says: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(["certify", *words]) == 2
    told = capsys.readouterr().err
    assert told.count("\n") == 1
    assert says in told


def test_proofs_are_kept_as_files_and_their_hashes_stand_in_the_record(tmp_path: Path) -> None:
    words = ["certify", "--only", "^split.init ", "--jobs", "1", "--keep", str(tmp_path / "kept"), "--json"]
    assert run([*words, str(tmp_path / "F")]) == 0
    told = json.loads((tmp_path / "F").read_text("utf-8"))["obligations"]
    files = sorted((tmp_path / "kept").rglob("*.cpc.gz"))
    assert len(files) == sum(each["parts"] for each in told) > 3
    for each in told:
        names = [f"{each['column']}.{number}.cpc.gz" for number in range(1, each["parts"] + 1)]
        proofs = [gzip.decompress((tmp_path / "kept" / each["row"] / name).read_bytes()) for name in names]
        assert [hashlib.sha256(proof).hexdigest() for proof in proofs] == each["proofs"]
        assert sum(map(len, proofs)) == each["size"]
    before = {path: path.read_bytes() for path in files}
    assert run([*words, str(tmp_path / "F")]) == 0
    assert {path: path.read_bytes() for path in files} == before, "the same proof on every run"


# ---- what a checker of others is given

ASKED = """(set-logic ALL)
(declare-sort Train 0)
(declare-datatypes ((End 0)) (((head) (tail))))
(declare-fun |a b| () Bool)
(declare-fun c (Train) Bool)
(assert (! (and |a b| (exists ((t Train)) (! (c t) :pattern ((c t))))) :named one.1))
(assert (! |a b| :named |two (or so).1|))
(assert (not |a b|))
(check-sat)
"""


def test_a_question_goes_without_names_and_with_all_else() -> None:
    assert outside.question(ASKED) == ASKED.replace("(! (and", "(and").replace(" :named one.1)", "").replace(
        "(! |a b| :named |two (or so).1|)", "|a b|"
    )


SECOND = "(declare-sort Train 0)\n(declare-datatypes ((End 0)) (((head) (tail))))\n(declare-const |a b| Bool)\n"
STEPS = "(define @t1 () (not |a b|))\n(assume @p1 @t1)\n(assume @p2 |a b|)\n"
END = "(step @p3 false :rule contra :premises (@p2 @p1))\n"


def test_a_proof_goes_without_what_the_question_declares() -> None:
    assert outside.steps(ASKED, f"(\n{SECOND}{STEPS}{END})") == STEPS + END


@pytest.mark.parametrize(
    "proof",
    [
        STEPS + "(step @p3 |a b| :rule refl :args (|a b|))\n",
        STEPS + "(assume-push @p4 |a b|)\n" + END,
        STEPS + "(declare-const another Bool)\n" + END,
        STEPS + "(declare-rule mine () :conclusion false)\n" + END,
        STEPS + '(include "mine.eo")\n' + END,
        STEPS + "(define @list () |a b|)\n" + END,
        STEPS + "(define @t2 () true) (reset)\n" + END,
        STEPS + "(exit)\n" + END,
        STEPS + END + "(exit)\n",
        STEPS + "stray " + END,
        STEPS + ")" + END,
        STEPS + END + "(step @p4",
        "",
    ],
)
def test_a_proof_that_says_more_than_steps_is_refused(proof: str) -> None:
    with pytest.raises(outside.Refused):
        outside.steps(ASKED, f"(\n{SECOND}{proof})")


@pytest.fixture
def ethos() -> outside.Checker:
    """The real one."""
    outside.installed.cache_clear()
    found = outside.installed()
    if found is None:
        pytest.skip(f"no {outside.CHECKER} on the path, or {outside.RULES} does not name its rules")
    return found


def test_ethos_passes_what_cvc5_proves_and_no_control(ethos: outside.Checker) -> None:
    found = certified(("split.init", "split_is_latched"), ethos)
    assert (found.answer, found.external) == ("checked", "correct")
    assert [name for name, refused in outside.controls(ethos) if not refused] == []


def test_ethos_refuses_a_proof_of_which_a_step_is_left_out_or_another(ethos: outside.Checker) -> None:
    (part,) = parts("split.init", "split_is_latched")
    _, proof, text = proved(part)
    lines = proof.splitlines()
    where = [number for number, line in enumerate(lines) if line.startswith("(step ") and " false " not in line]
    assert len(where) > 20
    for number in where[:: len(where) // 10]:
        without = "\n".join(lines[:number] + lines[number + 1 :])
        assert outside.checked(text, without, ethos) != "correct", lines[number]
    assert "(not pre.found)" in text
    assert outside.checked(text.replace("(not pre.found)", "pre.found"), proof, ethos) != "correct"


@pytest.mark.slow
@pytest.mark.parametrize("theory", THEORIES)
def test_ethos_passes_a_proof_of_each_theory(theory: str, ethos: outside.Checker) -> None:
    row = row_of(THEORIES[theory], next(iter(THEORIES[theory].steps)))
    asked = [column for column in columns(row) if parts(row, column)]
    for column in asked[:2]:
        assert certified((row, column), ethos).external == "correct", f"{row} {column}"
