"""Forgeries of a folder of records, written down beforehand, each mended as far as it can be.

Whoever forges makes the manifest anew, with the hashes of what was forged; so no finding rests on it, but for
those of which the manifest is the point.
"""

from __future__ import annotations

import gzip
import hashlib
import json
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from proofs.run import kept

Told = dict[str, Any]


@dataclass(frozen=True)
class Forgery:
    """What is forged, how, and the finding that names it: its kind, and the record it stands in."""

    name: str
    forge: Callable[[Path], None]
    kind: str
    where: str


def edited(record: str, edit: Callable[[Told], object]) -> Callable[[Path], None]:
    """Edit a JSON record."""

    def forge(folder: Path) -> None:
        told = json.loads((folder / record).read_text("utf-8"))
        edit(told)
        (folder / record).write_text(json.dumps(told), "utf-8")

    return forge


def replaced(record: str, old: str, new: str) -> Callable[[Path], None]:
    """Replace some text of a record, once."""

    def forge(folder: Path) -> None:
        text = (folder / record).read_text("utf-8")
        assert old in text
        (folder / record).write_text(text.replace(old, new, 1), "utf-8")

    return forge


def set_to(*path: Any, value: Any) -> Callable[[Told], object]:
    """Set what stands at a place of a record."""

    def edit(told: Told) -> None:
        place: Any = told
        for step in path[:-1]:
            place = place[step]
        place[path[-1]] = value

    return edit


def dropped(key: str, which: Callable[[Told], bool]) -> Callable[[Told], object]:
    """Drop from a list in a record."""

    def edit(told: Told) -> None:
        before = len(told[key])
        told[key] = [each for each in told[key] if not which(each)]
        assert len(told[key]) < before

    return edit


def first_cell(told: Told) -> Told:
    """The first obligation that asks something."""
    found: Told = next(each for each in told["obligations"] if each["hypotheses"])
    return found


def a_false_assertion(folder: Path) -> None:
    """Put ``(assert false)`` into a text, and its hash wherever it is told."""
    proof = json.loads((folder / "prove.json").read_text("utf-8"))
    cell = first_cell(proof)
    digest, text = cell["smt2_sha256"], b"(set-logic ALL)\n(assert false)\n(check-sat)\n"
    path = kept(folder / "obligations", cell["transition"], cell["invariant"])
    path.parent.mkdir(parents=True)
    path.write_bytes(gzip.compress(text, mtime=0))
    for name in ("prove.json", "certificates.json"):
        content = (folder / name).read_text("utf-8")
        (folder / name).write_text(content.replace(digest, hashlib.sha256(text).hexdigest()), "utf-8")


def twice(told: Told) -> None:
    told["obligations"].append({**told["obligations"][0], "verdict": "proved"})


def undecided_within(told: Told) -> None:
    told["obligations"][0]["verdict"] = "undecided"


def of_one(told: Told) -> None:
    told["mutants"], told["of"], told["sample"] = told["mutants"][:1], 1, None


def a_hole_called_killed(told: Told) -> None:
    told["mutants"][0] |= {"outcome": "survived", "became": "killed", "class": ""}


def a_theory(name: str) -> Callable[[Told], bool]:
    return lambda each: each["transition"].startswith(f"{name}.")


def cored_by_another(told: Told) -> None:
    told["obligations"][0]["hypotheses"] = ["something_else"]


def a_contract_left_out(folder: Path) -> None:
    lines = (folder / "crosshair.txt").read_text("utf-8").splitlines()
    (folder / "crosshair.txt").write_text("\n".join(lines[:-1]), "utf-8")


def no_record(folder: Path) -> None:
    (folder / "fuzz.json").write_text("{}", "utf-8")


PROOF, CERTIFIED, MUTATED, CHECKED = "prove.json", "certificates.json", "mutate.json", "check.json"

QUICK = (
    Forgery(
        "what a kernel with a fault gives, its refuted cell written as proved",
        edited(PROOF, lambda told: first_cell(told).update(smt2_sha256="1" * 64)),
        "other text",
        PROOF,
    ),
    Forgery("(assert false) in a text, its hash mended everywhere", a_false_assertion, "other text", PROOF),
    Forgery(
        "a theory dropped", edited(PROOF, dropped("obligations", a_theory("braking"))), "missing obligation", PROOF
    ),
    Forgery("no canaries", edited(PROOF, set_to("canaries", value=[])), "missing canary", PROOF),
    Forgery("one mutant, of 1", edited(MUTATED, of_one), "other sums", MUTATED),
    Forgery("a survivor called killed", edited(MUTATED, a_hole_called_killed), "other class", MUTATED),
    Forgery(
        "a record of tests of another commit",
        replaced("test.xml", '"commit": "', '"commit": "0'),
        "other commit",
        "test.xml",
    ),
    Forgery("a swapped commit", edited("ride.json", set_to("commit", value="f" * 40)), "other commit", "ride.json"),
    Forgery(
        "another solver of the same version",
        edited(PROOF, set_to("solvers", "z3-solver", value="2" * 64)),
        "other solvers",
        PROOF,
    ),
    Forgery(
        "an answer that was kept from an earlier run",
        edited(PROOF, lambda told: first_cell(told).update(kept="2026-01-01T00:00:00+00:00")),
        "kept answer",
        PROOF,
    ),
    Forgery(
        "answers kept from earlier runs, their marks taken off",
        edited(PROOF, set_to("command", value="heisoku prove --solver both --kept out/proofs.sqlite")),
        "kept answer",
        PROOF,
    ),
    Forgery("no command line", edited("check.json", lambda told: told.pop("command")), "unsaid", "check.json"),
)
"""A sample that needs little."""

MORE = (
    # ---- proofs
    Forgery(
        "one transition alone, as the whole",
        edited(PROOF, dropped("obligations", lambda each: each["transition"] != "braking.run_a_cycle")),
        "missing obligation",
        PROOF,
    ),
    Forgery(
        "one obligation left out", edited(PROOF, lambda told: told["obligations"].pop()), "missing obligation", PROOF
    ),
    Forgery(
        "one solver's answers to a theory left out",
        edited(PROOF, dropped("obligations", lambda each: a_theory("braking")(each) and each["solver"] == "cvc5")),
        "missing obligation",
        PROOF,
    ),
    Forgery(
        "one seed's answers to a theory left out",
        edited(PROOF, dropped("obligations", lambda each: a_theory("braking")(each) and each["seed"] == 1)),
        "missing obligation",
        PROOF,
    ),
    Forgery("an obligation twice, the second time proved", edited(PROOF, twice), "double obligation", PROOF),
    Forgery(
        "an obligation under another name",
        edited(PROOF, set_to("obligations", 0, "invariant", value="all_is_well")),
        "foreign obligation",
        PROOF,
    ),
    Forgery(
        "a hypothesis more than told",
        edited(PROOF, lambda told: first_cell(told)["hypotheses"].pop()),
        "other hypotheses",
        PROOF,
    ),
    Forgery(
        "an axiom that no symbol asks for",
        edited(PROOF, lambda told: first_cell(told)["axioms"].append("it is so")),
        "other hypotheses",
        PROOF,
    ),
    Forgery(
        "a claim that stands elsewhere",
        edited(PROOF, set_to("obligations", 0, "source", "lines", value=[1, 2])),
        "other source",
        PROOF,
    ),
    Forgery("a budget raised", edited(PROOF, set_to("obligations", 0, "rlimit", value=10**12)), "other budget", PROOF),
    Forgery(
        "one answer by another version",
        edited(PROOF, set_to("obligations", 0, "solver_version", value="9.9")),
        "other version",
        PROOF,
    ),
    Forgery(
        "a verdict that is none",
        edited(PROOF, set_to("obligations", 0, "verdict", value="PROVED")),
        "other verdict",
        PROOF,
    ),
    Forgery("proved, with an open obligation in it", edited(PROOF, undecided_within), "other verdict", PROOF),
    Forgery(
        "an answer for which nothing was spent",
        edited(PROOF, lambda told: first_cell(told).update(rlimit_spent=0, seconds=0)),
        "nothing spent",
        PROOF,
    ),
    Forgery(
        "canaries of cvc5 left out",
        edited(PROOF, dropped("canaries", lambda each: each["solver"] == "cvc5")),
        "missing canary",
        PROOF,
    ),
    Forgery(
        "a canary that was missed, said to be noticed",
        edited(PROOF, set_to("canaries", 0, "answer", value="unsat")),
        "other canary",
        PROOF,
    ),
    Forgery(
        "an offence that is none any more",
        edited(PROOF, set_to("offences", value=["a premise calls the kernel"])),
        "other offences",
        PROOF,
    ),
    Forgery(
        "proved by Z3, and by cvc5 as Z3 renamed: another platform's solver",
        edited(PROOF, set_to("versions", "cvc5", value="1.0")),
        "other versions",
        PROOF,
    ),
    # ---- certificates, mutants, cores, joints
    Forgery("certificates of one", edited(CERTIFIED, set_to("of", value=1)), "other sums", CERTIFIED),
    Forgery(
        "a certificate left out",
        edited(CERTIFIED, lambda told: told["obligations"].pop()),
        "missing obligation",
        CERTIFIED,
    ),
    Forgery(
        "a certificate of another text",
        edited(CERTIFIED, set_to("obligations", 0, "smt2_sha256", value="3" * 64)),
        "other text",
        CERTIFIED,
    ),
    Forgery("no controls", edited(CERTIFIED, set_to("controls", value=[])), "missing control", CERTIFIED),
    Forgery("a mutant left out", edited(MUTATED, lambda told: told["mutants"].pop()), "missing mutant", MUTATED),
    Forgery(
        "a sample of mutants called all",
        edited(MUTATED, dropped("mutants", lambda each: "kernel.onboard.split" in each["mutant"])),
        "missing mutant",
        MUTATED,
    ),
    Forgery(
        "kills that no mutant stands for",
        edited(MUTATED, lambda told: next(iter(told["kills"].values())).update(all_is_well=7)),
        "other sums",
        MUTATED,
    ),
    Forgery("a core of what is not assumed", edited("cores.json", cored_by_another), "other hypotheses", "cores.json"),
    Forgery(
        "a joint left out", edited("joints.json", lambda told: told["guarantees"].pop()), "missing joint", "joints.json"
    ),
    # ---- layouts, papers, campaigns
    Forgery("a layout left out", edited(CHECKED, lambda told: told["layouts"].pop()), "missing layout", CHECKED),
    Forgery(
        "a layout with a violation, said to hold",
        edited(CHECKED, set_to("layouts", 0, "checked", value={"a_destination_is_covered": 1})),
        "other layout",
        CHECKED,
    ),
    Forgery(
        "a row of a paper left out", edited("000.json", lambda told: told["rows"].pop()), "missing row", "000.json"
    ),
    Forgery(
        "a criterion made easier",
        edited("000.json", set_to("rows", 0, "criterion", value="any figure at all")),
        "other row",
        "000.json",
    ),
    Forgery(
        "a paper's figure changed to ours",
        edited("000.json", set_to("rows", 0, "paper", value="ours")),
        "other row",
        "000.json",
    ),
    Forgery(
        "a claim that rides do not count",
        edited("ride.json", lambda told: told["campaigns"][0]["violations"].popitem()),
        "missing count",
        "ride.json",
    ),
    Forgery(
        "a fault left out",
        edited("beyond.json", lambda told: told["campaigns"].pop()),
        "missing campaign",
        "beyond.json",
    ),
    Forgery(
        "a claim that days do not count",
        edited("days-tram.json", lambda told: told["columns"]["claims"].popitem()),
        "missing count",
        "days-tram.json",
    ),
    Forgery(
        "a campaign without canaries", edited("fuzz.json", set_to("canaries", value=[])), "missing canary", "fuzz.json"
    ),
    # ---- lists
    Forgery(
        "a test that failed left out",
        replaced("test.xml", '<testcase classname="tests.test_streams" name="test_nothing_of_ours_is_markup"/>', ""),
        "missing test",
        "test.xml",
    ),
    Forgery("a contract left out", a_contract_left_out, "missing contract", "crosshair.txt"),
    Forgery("a record that is no record", no_record, "unreadable", "fuzz.json"),
)
"""The rest."""
