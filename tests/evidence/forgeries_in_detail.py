"""Forgeries of what stands beside the answers: sums that contradict each other, words, command lines, pages."""

from __future__ import annotations

import gzip
import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

from evidence.manifest.hashes import NAME, made
from tests.evidence import genuine
from tests.evidence.forgeries import (
    CERTIFIED,
    CHECKED,
    MUTATED,
    PROOF,
    Forgery,
    Told,
    edited,
    first_cell,
    replaced,
    set_to,
)
from tests.evidence.forgeries_later import FUZZ, RIDE, TRAM

BEYOND, PAPER, CORED, JOINED = "beyond.json", "000.json", "cores.json", "joints.json"
PROVE = "heisoku prove --solver both --seeds 2"


def started(**other: Any) -> Callable[[Told], object]:
    """An earlier start of a campaign, made otherwise."""
    return lambda told: told["starts"].insert(0, {**told["starts"][0], **other})


def by_another_z3(told: Told) -> None:
    started(versions={**told["starts"][0]["versions"], "z3-solver": "1.0"})(told)


def broken_in_most(told: Told) -> None:
    one = told["campaigns"][0]
    name = next(iter(one["violations"]))
    one["violations"][name], one["sums"][name], one["most"][name] = 80, 80, 1
    one |= {"violated": 1, "unexplained": 0, "unnoticed": 1}


def broken_without_a_cause(told: Told) -> None:
    broken_in_most(told)
    told["campaigns"][0] |= {"violated": 80, "unexplained": 0, "unnoticed": 80}


def broken_on_days(violated: int) -> Callable[[Told], None]:
    def edit(told: Told) -> None:
        name = next(iter(told["columns"]["claims"]))
        told["columns"]["claims"][name] = {"all": 5, "most in a day": 1, "on days": 5}
        told["violated"] = violated

    return edit


def by_command(name: str, record: str, command: str) -> Forgery:
    """A record that says another command than the one that made it."""
    return Forgery(name, edited(record, set_to("command", value=command)), "other command", record)


def by_start(name: str, kind: str, edit: Callable[[Told], object]) -> Forgery:
    """A campaign one of whose starts is made otherwise."""
    return Forgery(name, edited(FUZZ, edit), kind, FUZZ)


def summed(name: str, record: str, edit: Callable[[Told], object]) -> Forgery:
    """A record whose figures do not go together."""
    return Forgery(name, edited(record, edit), "other sums", record)


SUMS = (
    summed("one ride with a claim broken, 80 of that claim", BEYOND, broken_in_most),
    summed("80 rides explained, and no assumption broken", BEYOND, broken_without_a_cause),
    summed("a bound of nothing", RIDE, set_to("campaigns", 0, "bound", value=1e-30)),
    summed("less than no long ride", RIDE, set_to("campaigns", 0, "long", value=-7)),
    summed("-3 unnoticed", RIDE, set_to("campaigns", 0, "unnoticed", value=-3)),
)
"""In what is summed up."""

DAYS = (
    summed("one day with a claim broken, five of that claim", TRAM, broken_on_days(1)),
    summed("five days explained, and no assumption broken", TRAM, broken_on_days(5)),
    summed("a bound of nothing on days", TRAM, set_to("bound", value=1e-30)),
    summed("hours without end", TRAM, set_to("hours", value=10**9)),
    by_command("days by a command of one day", TRAM, "heisoku days tram --days 1"),
    by_command("days by a command of others", TRAM, "heisoku days alarm --days 5"),
)
"""The same of days, which only a whole folder has."""

STARTS = (
    by_start("a start on another commit", "other commit", started(commit="f" * 40)),
    by_start("a start with another Z3", "other versions", by_another_z3),
    by_start("a start of another target", "other command", started(command="heisoku fuzz --target rides")),
    by_start("a start that is none", "other command", started(command="true")),
)
"""In what a campaign says of its starts."""

COMMANDS = (
    by_command("a whole proof by --only", PROOF, f"{PROVE} --only ^brake_watch"),
    by_command("both solvers by one", PROOF, "heisoku prove --solver=z3 --seeds 2"),
    by_command("two seeds by one", PROOF, "heisoku prove --solver both"),
    *(
        by_command(f"{record} by no command of ours", record, "rm -rf /")
        for record in (PROOF, CERTIFIED, MUTATED, CHECKED, PAPER, CORED, JOINED, RIDE, BEYOND)
    ),
    by_command("joints by mutants", JOINED, "heisoku mutate"),
    by_command("certificates by a sample", CERTIFIED, "heisoku certify --sample 5"),
    by_command("all layouts by one", CHECKED, "heisoku check layouts/ring.toml"),
    by_command("rides by another seed", RIDE, "heisoku ride --rides 100 --seed 2"),
    by_command("every fault by one", BEYOND, "heisoku ride --rides=100 --beyond lag_s"),
    by_command("a paper by another", PAPER, "heisoku reproduce 001 --runs 1"),
    Forgery(
        "a quotation without end", edited(PAPER, set_to("command", value="heisoku reproduce '000")), "unreadable", PAPER
    ),
)
"""In command lines."""

PAPERS = (
    summed("no run of a paper", PAPER, set_to("runs", value=0)),
    Forgery("invented parameters", edited(PAPER, set_to("parameters", value={"a": "b"})), "other parameters", PAPER),
    Forgery("no sensitivity", edited(PAPER, set_to("sensitivities", value=[])), "other parameters", PAPER),
    Forgery("no picture", edited(PAPER, set_to("pictures", value=[])), "other parameters", PAPER),
    Forgery("nothing counted in a paper", edited(PAPER, set_to("counts", value={})), "missing count", PAPER),
)
"""In papers."""


def without_steps(told: Told) -> None:
    for each in told["obligations"]:
        each["steps"] = 0


def steps_taken_back(told: Told) -> None:
    next(each for each in told["obligations"] if each["parts"])["steps"] = -(10**9)


def of_another_theory(told: Told) -> None:
    told["mutants"][0]["theories"] = ["braking", "brake_watch"]


def killed_by_nothing(told: Told) -> None:
    for each in told["mutants"]:
        each["finding"] = ""


def unheard_of(told: Told) -> None:
    next(each for each in told["mutants"] if each["class"])["outcome"] = "quite unheard of"


def for_no_reason(told: Told) -> None:
    next(each for each in told["mutants"] if each["class"])["why"] = "no reason"


WORDS = (
    summed("certificates without a step", CERTIFIED, without_steps),
    summed("certificates of less than no step", CERTIFIED, steps_taken_back),
    Forgery(
        "a certificate's answer that is none",
        edited(CERTIFIED, set_to("obligations", 0, "answer", value="certainly")),
        "other answer",
        CERTIFIED,
    ),
    summed("-1 parts open", CORED, set_to("obligations", 0, "open", value=-1)),
    summed("a guard in no list", CORED, set_to("obligations", 0, "guards", value=["x"])),
    Forgery(
        "guards of an invented step", edited(CORED, set_to("guards", value={"x": ["y"]})), "foreign transition", CORED
    ),
    summed("joints of one", JOINED, set_to("of", "guarantees", value=1)),
    Forgery("a fine joint", edited(JOINED, set_to("guarantees", 0, "became", value="fine")), "other joint", JOINED),
    Forgery("joints tied by an invented name", edited(JOINED, set_to("by_name", value=["x"])), "other joint", JOINED),
    Forgery("a mutant in other theories", edited(MUTATED, of_another_theory), "other theory", MUTATED),
    Forgery("mutants killed by nothing", edited(MUTATED, killed_by_nothing), "other outcome", MUTATED),
    Forgery("an outcome that is none", edited(MUTATED, unheard_of), "other outcome", MUTATED),
    Forgery("a class for no reason", edited(MUTATED, for_no_reason), "other class", MUTATED),
    Forgery(
        "a canary of another version",
        edited(PROOF, set_to("canaries", 0, "solver_version", value="99")),
        "other version",
        PROOF,
    ),
    Forgery("a made-up theory", edited(PROOF, set_to("obligations", 0, "theory", value="any")), "other theory", PROOF),
    Forgery("an invented note", edited(PROOF, lambda told: first_cell(told).update(note="so")), "other note", PROOF),
    Forgery("lifted before it began", edited(PROOF, set_to("lifting_seconds", value=-5)), "other figures", PROOF),
)
"""In words and figures beside the answers."""


def a_table_by_hand(folder: Path) -> None:
    (folder / TABLES).write_text("all agrees", "utf-8")


def a_proof_of_another(folder: Path) -> None:
    (folder / genuine.A_PROOF).write_bytes(gzip.compress(genuine.PROOF + b"\n", mtime=0))


def a_proof_more(folder: Path) -> None:
    (folder / FOREIGN_PROOF).write_bytes(gzip.compress(genuine.PROOF, mtime=0))


TABLES, FOREIGN_PROOF = genuine.TABLES, "proofs/braking.init/all_is_well.1.cpc.gz"
PAGES = (
    Forgery("a figure changed in a table", replaced(TABLES, "18.5 ms", "18.4 ms"), "other tables", TABLES),
    Forgery("tables by hand", a_table_by_hand, "other tables", TABLES),
    Forgery("a proof of another step", a_proof_of_another, "other proof", genuine.A_PROOF),
    Forgery("a proof of nothing", a_proof_more, "foreign proof", FOREIGN_PROOF),
)
"""In what is written of the records."""

DETAIL = (*SUMS, *STARTS, *COMMANDS, *PAPERS, *WORDS, *PAGES)
"""All of them that a sample of records has."""


def with_targets(told: Told) -> None:
    told["targets"] = {"walks": {**told["targets"]["walks"], "batches": 1, "traces": 1, "steps": 1}}


def a_record_below(folder: Path) -> None:
    (folder / "sub").mkdir()
    (folder / "sub" / PROOF).write_text('{"verdict": "proved"}', "utf-8")


def a_pdf(folder: Path) -> None:
    (folder / "report.pdf").write_bytes(b"%PDF-1.7")


AS_A_PART = (
    ("walks alone, one step of them", edited(FUZZ, with_targets), "8 batches of each target 0 of interlocking"),
    ("a record in a folder of its own", a_record_below, "sub/: compared with nothing: sub/prove.json"),
    ("a report as PDF", a_pdf, "compared with nothing: report.pdf"),
)
"""What is no contradiction, and is told as a part, or as compared with nothing: with what is then said."""


def of_another_version(folder: Path) -> None:
    _in_the_manifest(folder, versions={"z3-solver": "99"})


def to_come(folder: Path) -> None:
    _in_the_manifest(folder, made_at="2999-01-01T00:00:00+00:00")


def _in_the_manifest(folder: Path, **other: object) -> None:
    told = json.loads(made(folder).text())
    (folder / NAME).write_text(json.dumps({**told, **other}), "utf-8")


MANIFESTS = (
    Forgery("a manifest of another version", of_another_version, "other versions", NAME),
    Forgery("a manifest to come", to_come, "other time", NAME),
)
"""In the manifest itself."""
