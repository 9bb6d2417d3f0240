"""What of the records can be made again, and whether it comes to the same: a random sample, drawn from a seed."""

from __future__ import annotations

import random
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any

from evidence.manifest.hashes import ROOT
from evidence.records.reading import Records
from fuzz.failures.command import Replayed, replay_file
from models.layouts import BadInput, as_json, check, load
from models.rides import report
from models.rides.campaign import ride_all
from models.rides.tally import outcome
from proofs import run, scripts
from proofs.mutants.plays import ERRORS, witnesses
from proofs.mutants.targets import mutants
from proofs.mutants.trial import tried
from proofs.theories import THEORIES
from proofs.witnesses.registry import WITNESSES
from proofs.witnesses.scenario import STEPS

RIDES_AT_MOST = 1_024
"""A longer campaign is not ridden again here: its record keeps sums, and they need all of it."""
OF_A_KIND_AT_MOST = {"mutant": 3, "ride": 1, "beyond": 2}
"""Of those that take seconds each."""


@dataclass(frozen=True)
class Result:
    """What came of making something again: whether it is as recorded, and in words."""

    same: bool
    says: str


@dataclass(frozen=True)
class Figure:
    """Something recorded that can be made again, and how."""

    kind: str
    what: str
    make: Callable[[], Result]


def figures(folder: Path, records: Records) -> Iterator[Figure]:
    """Everything in the records that can be made again within seconds; what a record lacks has no figures."""
    for each in _list(records, "prove.json", "obligations"):
        what = f"{each['transition']} × {each['invariant']} by {each['solver']}, seed {each['seed']}"
        yield Figure("obligation", what, partial(_prove, each))
    for theory in THEORIES:
        names = WITNESSES if theory == "interlocking" else witnesses(theory)
        yield from (Figure("witness", f"{theory}: {name}", partial(_play, theory, name)) for name in names)
    for each in _list(records, "check.json", "layouts"):
        yield Figure("layout", str(each["file"]), partial(_check, each))
    for kind in ("ride", "beyond"):
        for each in _list(records, f"{kind}.json", "campaigns"):
            if each["rides"] <= RIDES_AT_MOST:
                seed = records[f"{kind}.json"].data["seed"]
                what = f"{each['rides']} rides with seed {seed}, beyond: {each['beyond'] or 'nothing'}"
                yield Figure(kind, what, partial(_ride, seed, each))
    for each in _list(records, "mutate.json", "mutants"):
        yield Figure("mutant", each["mutant"], partial(_mutate, each))
    for each in _list(records, "fuzz.json", "failures"):
        yield Figure("trace", str(each["trace"]), partial(_replay, folder, each))


def _list(records: Records, name: str, key: str) -> Sequence[Mapping[str, Any]]:
    found = records[name].data.get(key) if name in records else None
    return [each for each in found if isinstance(each, dict)] if isinstance(found, list) else []


def drawn(pool: Sequence[Figure], seed: int, size: int) -> list[Figure]:
    """Draw so many, one of each kind in turn."""
    rng = random.Random(seed)
    kinds: dict[str, list[Figure]] = {}
    for figure in pool:
        kinds.setdefault(figure.kind, []).append(figure)
    for kind, of_it in kinds.items():
        kinds[kind] = rng.sample(of_it, min(len(of_it), size, OF_A_KIND_AT_MOST.get(kind, size)))
    found: list[Figure] = []
    while any(kinds.values()) and len(found) < size:
        found += [of_it.pop() for of_it in kinds.values() if of_it]
    return sorted(found[:size], key=lambda figure: (figure.kind, figure.what))


def made_again(figure: Figure) -> Result:
    """Make a figure again; a record that names what is not there is not the same."""
    try:
        return figure.make()
    except (KeyError, TypeError, ValueError, AttributeError, IndexError) as error:
        return Result(False, f"cannot be made from its record: {error!r}")


def _prove(told: Mapping[str, Any]) -> Result:
    """Lay the obligation out from the sources, and put it to the same solver."""
    row, column = told["transition"], told["invariant"]
    asked = run.parts(row, column)
    now = run.settle(row, column, told["solver"], told["seed"], asked, run.digest_of(asked))
    if now["smt2_sha256"] != told["smt2_sha256"]:
        return Result(False, "the sources give another text than the one recorded")
    if list(scripts.hypotheses(row, column)) != list(told["hypotheses"]):
        return Result(False, "its proof names other hypotheses")
    if now["verdict"] != told["verdict"]:
        return Result(False, f"recorded as {told['verdict']}, and now {now['verdict']}")
    return Result(True, f"{now['verdict']}, the same text")


def _play(theory: str, name: str) -> Result:
    try:
        if theory == "interlocking":
            WITNESSES[name](STEPS)
        else:
            witnesses(theory)[name]()
    except ERRORS as error:
        return Result(False, f"fails: {error}")
    return Result(True, "goes as it says")


def _check(told: Mapping[str, Any]) -> Result:
    path = Path(told["file"])
    try:
        imported = load(path if path.is_absolute() else ROOT / path)
    except BadInput as bad:
        return Result(told["verdict"] == "bad input", str(bad))
    now = as_json(imported, check(imported))
    differ = [key for key in now if key != "layout" and now[key] != told.get(key)]
    if differ:
        return Result(False, f"another {', '.join(differ)} than recorded")
    return Result(True, f"{told['verdict']}, {sum(told['checked'].values()):,} instances of axioms")


def _ride(seed: int, told: Mapping[str, Any]) -> Result:
    name = told["beyond"] or ""
    rows = ride_all(seed, told["rides"], 1, [name])[name]
    campaigns = report.record(seed, {name: outcome(rows)})["campaigns"]
    assert isinstance(campaigns, list)
    differ = [key for key, value in campaigns[0].items() if value != told.get(key)]
    if differ:
        return Result(False, f"another {', '.join(differ)} than recorded")
    return Result(True, f"{told['violated']} rides with a claim broken, {told['sums']['cycles']:,} cycles")


def _mutate(told: Mapping[str, Any]) -> Result:
    mutant = mutants().get(told["mutant"])
    if mutant is None:
        return Result(False, "there is no such mutant")
    now = tried(mutant)
    if now.outcome != told["outcome"]:
        return Result(False, f"recorded as {told['outcome']}, and now {now.outcome}")
    return Result(True, f"{now.outcome} {now.by}".strip())


def _replay(folder: Path, told: Mapping[str, Any]) -> Result:
    path = Path(told["trace"])
    try:
        found = replay_file(path if path.is_absolute() else folder.parent / path, False, lambda *_: None)
    except BadInput as bad:
        return Result(False, str(bad))
    again = found.found.reproduced if isinstance(found, Replayed) else bool(found.found.violated)
    return Result(again, "violated again" if again else "nothing is violated now")
