"""What records of proofs, certificates, mutants and cores must say by the sources, but for what solvers answered."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence, Set
from typing import Any

from evidence.manifest.expected_commands import line_of
from evidence.manifest.finding import Finding, differences
from evidence.manifest.laying_out import Cell, LaidOut
from models.exit_codes import WORDS
from proofs import canaries, lints_apart
from proofs.certificates.command import chosen
from proofs.certificates.command import exit_code as certified_code
from proofs.certificates.outside import WRONG
from proofs.mutants import assumed, trying
from proofs.mutants import command as mutating
from proofs.mutants import joints as between
from proofs.mutants.classes import table
from proofs.mutants.guarantees import Use
from proofs.mutants.targets import mutants, theories_with
from proofs.records import Report
from proofs.run import NOTHING_TO_ASK
from proofs.solvers import BUDGET
from proofs.theories import is_transition, theory_of

Told = Mapping[str, Any]
PROOF = "prove.json"
CHECKED, NO_CERTIFICATE = "checked", "no certificate: "
ANSWERS = frozenset({CHECKED, "sat", "unknown"})
"""What comes of an obligation to be certified; or no certificate, and what was said instead."""
SURVIVED = "survived"
OUTCOMES = frozenset({mutating.COUNTEREXAMPLE, "witness", SURVIVED})
"""What comes of a mutant; a counterexample says what is false after it."""
KEPT = "--kept"
"""Made with it, a record has answers of earlier runs in it."""


def proved(told: Told, laid_out: Mapping[Cell, LaidOut]) -> Iterator[Finding]:
    """Each obligation of the sources stands there once a solver and seed, as it is laid out from them."""
    obligations: Sequence[Told] = told["obligations"]
    solvers = sorted({"z3", *(each["solver"] for each in obligations)})
    seeds = _seeds({each["seed"] for each in obligations}, len(obligations))
    wanted = [_asked(*cell, solver, seed) for cell in laid_out for solver in solvers for seed in seeds]
    there = [_asked(each["transition"], each["invariant"], each["solver"], each["seed"]) for each in obligations]
    yield from differences("obligation", PROOF, there, wanted)
    for each in obligations:
        now = laid_out.get((each["transition"], each["invariant"]))
        if now is not None:
            yield from _as_laid_out(each, now, told["versions"])
    if KEPT in line_of(told["command"]).options:
        yield Finding(
            "kept answer", PROOF, f"was made with {KEPT}: with answers of earlier runs, which are no evidence"
        )
    yield from _canaries(told["canaries"], solvers, told["versions"])
    for key in ("lifting_seconds", "wall_seconds"):
        if not told[key] >= 0:
            yield Finding("other figures", PROOF, f"says {key} {told[key]}, which no run comes to")
    offences = lints_apart.unlisted(lints_apart.offences(), lints_apart.listed())
    if list(told["offences"]) != offences:
        yield Finding("other offences", PROOF, f"says {told['offences']}, and the sources {offences}")
    verdict = Report(told["obligations"], 0.0, 0.0, told["canaries"], told["offences"]).verdict
    if "z3" not in {each["solver"] for each in obligations}:
        yield Finding("missing obligation", PROOF, "Z3 was asked nothing")
    if max((each["seed"] for each in obligations), default=0) > len(obligations):
        yield Finding("foreign obligation", PROOF, "tells of seeds beyond the number of its answers")
    if told["verdict"] != verdict:
        yield Finding("other verdict", PROOF, f"says {told['verdict']}, and what stands in it comes to {verdict}")


def _seeds(told: Set[int], answers: int) -> Sequence[int]:
    """Each seed up to the greatest, and the first in any case; of greater ones than there are answers, no more."""
    greatest = max(told, default=0)
    return range(1 + greatest) if greatest <= answers else sorted({0, *told})


def _asked(row: str, column: str, solver: str, seed: int) -> str:
    return f"{row} × {column} by {solver}, seed {seed}"


def _as_laid_out(each: Told, now: LaidOut, versions: Told) -> Iterator[Finding]:
    what = f"{each['transition']} × {each['invariant']} by {each['solver']}"
    if each["smt2_sha256"] != now.digest:
        yield Finding("other text", PROOF, f"{what}: the sources give another text than the one recorded")
    if list(each["hypotheses"]) != now.hypotheses or list(each["axioms"]) != now.axioms:
        yield Finding("other hypotheses", PROOF, f"{what}: it is laid out with others than those recorded")
    if (each["source"]["file"], *each["source"]["lines"]) != now.source:
        yield Finding("other source", PROOF, f"{what}: its claim stands at {':'.join(map(str, now.source[:2]))}")
    if each["rlimit"] != BUDGET[each["solver"]]:
        yield Finding("other budget", PROOF, f"{what}: asked with {each['rlimit']:,}, not {BUDGET[each['solver']]:,}")
    if each["solver_version"] != versions[_package(each)]:
        yield Finding("other version", PROOF, f"{what}: by version {each['solver_version']}, not the record's")
    if each["verdict"] not in ("proved", "refuted", "undecided"):
        yield Finding("other verdict", PROOF, f"{what}: {each['verdict']} is no verdict")
    if "kept" in each:
        yield Finding("kept answer", PROOF, f"{what}: nobody was asked, the answer is one of {each['kept']}")
    yield from _worded(each, now, what)


def _worded(each: Told, now: LaidOut, what: str) -> Iterator[Finding]:
    """Theory and note are those of the sources, and what was spent is what a run may spend."""
    if each["theory"] != theory_of(each["transition"])[0].name:
        yield Finding("other theory", PROOF, f"{what}: {each['theory']} has no such transition")
    if each.get("note") != (None if now.parts else NOTHING_TO_ASK):
        yield Finding("other note", PROOF, f"{what}: {each.get('note', 'nothing noted')}, and {now.parts} parts")
    budget = math.inf if each["verdict"] == "undecided" else each["rlimit"] * max(now.parts, 1)
    for key, most in (("seed", math.inf), ("rlimit_spent", budget), ("seconds", math.inf)):
        if not 0 <= each[key] <= most:
            yield Finding("other figures", PROOF, f"{what}: says {key} {each[key]:,}, which no run comes to")
    if now.parts and not each["rlimit_spent"] and each["seconds"] == 0:
        yield Finding("nothing spent", PROOF, f"{what}: an answer for which nothing was spent")


def _package(told: Told) -> str:
    """The package of the solver that answered."""
    return "z3-solver" if told["solver"] == "z3" else str(told["solver"])


def _canaries(seen: Sequence[Told], solvers: Sequence[str], versions: Told) -> Iterator[Finding]:
    """Each solver was asked each canary, of all theories; one is noticed if it is answered with ``sat``."""
    wanted = [f"{each.name} to {solver}" for solver in solvers for each in canaries.CANARIES]
    there = list(dict.fromkeys(f"{each['canary']} to {each['solver']}" for each in seen))
    yield from differences("canary", PROOF, there, wanted)
    for each in seen:
        if each["noticed"] != (each["answer"] == "sat"):
            yield Finding("other canary", PROOF, f"{each['canary']}: {each['answer']}, and said to be noticed or not")
        if each["solver_version"] != versions[_package(each)]:
            said = f"{each['solver']} {each['solver_version']}"
            yield Finding("other version", PROOF, f"{each['canary']}: asked of {said}, not the record's")


def certified(told: Told, laid_out: Mapping[Cell, LaidOut]) -> Iterator[Finding]:
    """Each obligation asked for has its entry, of the text that the sources give; each control stands there."""
    name, asked = "certificates.json", chosen(laid_out, told["only"], told["sample"])
    there = [f"{each['row']} × {each['column']}" for each in told["obligations"]]
    yield from differences("obligation", name, there, [" × ".join(cell) for cell in asked])
    yield from _of(name, told["of"], len(laid_out))
    for each in told["obligations"]:
        now = laid_out.get((each["row"], each["column"]))
        if now is not None and (each["smt2_sha256"], each["parts"]) != (now.digest, now.parts):
            what = f"{each['row']} × {each['column']}"
            yield Finding("other text", name, f"{what}: the sources give another text than the one certified")
        yield from _steps(name, each)
    controls = [each["asked"] for each in told["controls"]]
    wanted = [canary.name for canary in canaries.CANARIES]
    if told["external"]:
        wanted += WRONG
    yield from differences("control", name, controls, wanted)
    yield from _outside(name, told)
    yield from _verdict(name, told, certified_code(told))


def _steps(name: str, each: Told) -> Iterator[Finding]:
    """What was checked has a proof for each part, of a step at least; what asks nothing has none."""
    what = f"{each['row']} × {each['column']}"
    if each["answer"] not in ANSWERS and not str(each["answer"]).startswith(NO_CERTIFICATE):
        yield Finding("other answer", name, f"{what}: {each['answer']} is no answer")
    least = each["parts"] if each["answer"] == CHECKED else 0
    counts = [each[key] for key in ("steps", "trusted", "size")]
    if any(type(count) is not int for count in counts) or not (
        least <= each["steps"] <= each["size"] and 0 <= each["trusted"] <= each["steps"]
    ):
        yield Finding("other sums", name, f"{what}: steps, on trust, bytes {counts} in {each['parts']} parts")
    if len(each["proofs"]) != each["parts"]:
        yield Finding("other sums", name, f"{what}: {len(each['proofs'])} proofs of {each['parts']} parts")


def _outside(name: str, told: Told) -> Iterator[Finding]:
    """Where an external checker is named it said something of every proof, and without one nothing is said."""
    for each in told["obligations"]:
        if bool(told["external"]) != bool(each["external"]) and (each["parts"] or not told["external"]):
            what = f"{each['row']} × {each['column']}"
            says = each["external"] or "nothing"
            yield Finding("other checker", name, f"{what}: {says}, by the checker {told['external'] or 'that is none'}")
    if told["external"] and not dict(told.get("external_hashes") or {}).get("program"):
        yield Finding("other checker", name, f"{told['external']}: without a hash of the program that ran")


def mutated(told: Told, laid_out: Mapping[Cell, LaidOut]) -> Iterator[Finding]:
    """Each mutant asked for has its entry; what becomes of it follows from its outcome and from its class."""
    name, rows = "mutate.json", told["mutants"]
    there = [each["mutant"] for each in rows]
    yield from differences("mutant", name, there, trying.chosen(told["only"] or "", told["sample"]))
    yield from _of(name, told["of"], len(mutants()))
    for each in (row for row in rows if row["mutant"] in mutants()):
        kind, became = _became(each)
        if (each["class"], each["became"]) != (kind, became):
            says = f"{each['became']} {each['class']}".strip()
            yield Finding("other class", name, f"{each['mutant']}: {says}, and by the sources {became} {kind}".strip())
        yield from _tried(name, each)
    if told["kills"] != mutating.kills(rows):
        yield Finding("other sums", name, "its kills are not those of the mutants that stand in it")
    yield from _verdict(name, told, mutating.exit_code(told))


def _tried(name: str, row: Told) -> Iterator[Finding]:
    """A mutant was tried in the theories that have it; what noticed it is named, and nothing if nothing did."""
    theories = [theory.name for theory in theories_with(mutants()[row["mutant"]])]
    if row["theories"] != theories:
        yield Finding("other theory", name, f"{row['mutant']}: tried in {row['theories']}, and it is in {theories}")
    if row["outcome"] not in OUTCOMES:
        yield Finding("other outcome", name, f"{row['mutant']}: {row['outcome']} is no outcome")
    elif bool(row["by"]) == (row["outcome"] == SURVIVED) or not (
        row["finding"] or row["outcome"] != mutating.COUNTEREXAMPLE
    ):
        yield Finding("other outcome", name, f"{row['mutant']}: {row['outcome']} by {row['by'] or 'nothing'}")
    if row["why"] != (table()[row["mutant"]].why if row["class"] else ""):
        yield Finding("other class", name, f"{row['mutant']}: its reason is not that of the table")


def _became(row: Told) -> tuple[str, str]:
    """The class of a mutant and what becomes of it, by its outcome, by the table, and by what is said against it."""
    name, is_killed = row["mutant"], trying.killed(row["mutant"], row["outcome"])
    entry = table().get(name)
    kind = entry.kind if entry and not is_killed else ""
    if row["objection"] or trying.by_the_table(name, is_killed):
        return kind, mutating.HOLE
    return kind, mutating.CLASSED if kind else mutating.KILLED


def cored(told: Told, laid_out: Mapping[Cell, LaidOut]) -> Iterator[Finding]:
    """Each obligation that a transition keeps an invariant has its core, of hypotheses that its proof names."""
    name = "cores.json"
    asked = [cell for cell in laid_out if is_transition(cell[0]) and cell[1] in theory_of(cell[0])[0].invariants]
    there = [f"{each['transition']} × {each['invariant']}" for each in told["obligations"]]
    yield from differences("obligation", name, there, [" × ".join(cell) for cell in asked])
    for each in told["obligations"]:
        now = laid_out.get((each["transition"], each["invariant"]))
        if now is not None and not set(each["hypotheses"]) <= set(now.hypotheses):
            what = f"{each['transition']} × {each['invariant']}"
            yield Finding("other hypotheses", name, f"{what}: a core of what its proof does not assume")
        if not 0 <= each["open"] <= each["parts"] or (now is not None and not each["parts"] >= min(1, now.parts)):
            what = f"{each['transition']} × {each['invariant']}"
            yield Finding("other sums", name, f"{what}: {each['open']} open of {each['parts']} parts")
        for key in ("guards", "updates"):
            if not set(each[key]) <= set(told[key].get(each["transition"], ())):
                yield Finding("other sums", name, f"{each['transition']}: a core with {key} that it does not list")
    for key in ("guards", "updates"):
        rows = list(dict.fromkeys(row for row, _ in asked))
        yield from differences("transition", name, list(told[key]), rows)


def joined(told: Told, laid_out: Mapping[Cell, LaidOut]) -> Iterator[Finding]:
    """Each guarantee in use, and each assumption below the theorem, was tried."""
    name = "joints.json"
    there = [Use(each["row"], each["column"], each["guarantee"]).name for each in told["guarantees"]]
    there += [each["assumption"] for each in told["assumptions"]]
    yield from differences("joint", name, there, between.chosen(told["only"] or "", told["sample"]))
    counts = {"guarantees": len(between.uses()), "assumptions": len(assumed.names())}
    if told["of"] != counts:
        yield Finding("other sums", name, f"says that there are {told['of']}, and there are {counts}")
    if told["by_name"] != between.by_name():
        yield Finding("other joint", name, f"says that {told['by_name']} are tied by name alone")
    for each in told["guarantees"]:
        if each["became"] != between.became_of(each["without"], each["open_with"]):
            yield Finding("other joint", name, f"{each['guarantee']}: {each['became']}, and {each['without']} without")
    beside = assumed.beside_the_theorem()
    for each in told["assumptions"]:
        unneeded = between.BESIDE if each["assumption"] in beside else between.UNNEEDED
        if each["became"] not in (between.NEEDED, between.OPEN, unneeded):
            yield Finding("other joint", name, f"{each['assumption']}: {each['became']}, which it cannot be")
    yield from _verdict(name, told, between.exit_code(told))


def _of(name: str, told: int, there_are: int) -> Iterator[Finding]:
    if told != there_are:
        yield Finding("other sums", name, f"says that there are {told:,}, and there are {there_are:,}")


def _verdict(name: str, told: Told, code: int) -> Iterator[Finding]:
    if told["verdict"] != WORDS[code]:
        yield Finding("other verdict", name, f"says {told['verdict']}, and what stands in it comes to {WORDS[code]}")
