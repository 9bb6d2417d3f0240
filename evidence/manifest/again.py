"""What of the records can be made again, and whether it comes to the same: a random sample, drawn from a seed."""

from __future__ import annotations

import random
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any

from evidence.manifest import making
from evidence.manifest.making import Result
from evidence.records.reading import Records
from models.days.systems import NAMES as SYSTEMS
from models.layouts import BadInput
from models.processes import spread
from models.reproduce import PAPERS
from proofs.mutants.plays import witnesses
from proofs.theories import THEORIES
from proofs.witnesses.registry import WITNESSES

RIDES_AT_MOST = 1_024
"""A longer campaign is not ridden again here: its record keeps sums, and they need all of it."""
DAYS_AT_MOST = 60
"""The same of days, where none of them is kept by itself."""
OF_A_KIND_AT_MOST = {"mutant": 3, "ride": 1, "beyond": 2, "days": 2, "day": 4, "paper": 3}
"""Of those that take seconds each."""


@dataclass(frozen=True)
class Figure:
    """Something recorded that can be made again, and how."""

    kind: str
    what: str
    make: Callable[[], Result]


def figures(folder: Path, records: Records) -> Iterator[Figure]:
    """Everything in the records that can be made again within seconds; what a record lacks has no figures."""
    yield from _proofs(records)
    for each in _list(records, "check.json", "layouts"):
        yield Figure("layout", str(each["file"]), partial(making.check, each))
    yield from _rides(records)
    for system in SYSTEMS:
        yield from _days(folder, records, system)
    for paper in PAPERS:
        for number, row in enumerate(_list(records, f"{paper}.json", "rows")):
            made = partial(making.reproduce, paper, records[f"{paper}.json"].data, number)
            yield Figure("paper", f"{paper}: {row['what']}", made)
    for each in _list(records, "fuzz.json", "failures"):
        yield Figure("trace", str(each["trace"]), partial(making.replay, folder, each))


def _proofs(records: Records) -> Iterator[Figure]:
    for each in _list(records, "prove.json", "obligations"):
        what = f"{each['transition']} × {each['invariant']} by {each['solver']}, seed {each['seed']}"
        yield Figure("obligation", what, partial(making.prove, each))
    for each in _list(records, "certificates.json", "obligations"):
        yield Figure("certificate", f"{each['row']} × {each['column']}", partial(making.certify, each))
    for theory in THEORIES:
        names = WITNESSES if theory == "interlocking" else witnesses(theory)
        yield from (Figure("witness", f"{theory}: {name}", partial(making.play, theory, name)) for name in names)
    for each in _list(records, "mutate.json", "mutants"):
        yield Figure("mutant", each["mutant"], partial(making.mutate, each))


def _rides(records: Records) -> Iterator[Figure]:
    for kind in ("ride", "beyond"):
        for each in _list(records, f"{kind}.json", "campaigns"):
            if each["rides"] <= RIDES_AT_MOST:
                seed = records[f"{kind}.json"].data["seed"]
                what = f"{each['rides']} rides with seed {seed}, beyond: {each['beyond'] or 'nothing'}"
                yield Figure(kind, what, partial(making.ride, seed, each))


def _list(records: Records, name: str, key: str) -> Sequence[Mapping[str, Any]]:
    found = records[name].data.get(key) if name in records else None
    return [each for each in found if isinstance(each, dict)] if isinstance(found, list) else []


def _days(folder: Path, records: Records, system: str) -> Iterator[Figure]:
    """Single days where each is kept, and the sums of all."""
    name = f"days-{system}.json"
    told = records[name].data if name in records else {}
    if not told.get("days"):
        return
    kept = folder / f"{system}.days"
    what, seed = f"{told['days']:,} days of the {system}, seed {told['seed']}", told["seed"]
    if kept.is_file():
        yield Figure("days", what, partial(making.sums, told, kept))
        for day in range(told["days"]):
            yield Figure("day", f"day {day:,} of the {system}, seed {seed}", partial(making.live, told, kept, day))
    elif told["days"] <= DAYS_AT_MOST:
        yield Figure("days", what, partial(making.sums, told, None))


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


def asked_again(records: Records, jobs: int, progress: Callable[[int, int, str], object]) -> Iterator[Result]:
    """Put every obligation on record to Z3 once, which any record of what is not proved differs from."""
    told = _list(records, "prove.json", "obligations")
    cells = {(str(each["transition"]), str(each["invariant"])): str(each["verdict"]) for each in told}
    for each in told:
        if each["verdict"] != "refuted":
            cells[each["transition"], each["invariant"]] = each["verdict"]
    todo = list(cells.items())
    chunks = [todo[start : start + 20] for start in range(0, len(todo), 20)]
    for done, results in enumerate(spread(making.ask_again, chunks, jobs), 1):
        progress(done, len(chunks), chunks[done - 1][0][0][0])
        yield from results


def made_again(figure: Figure) -> Result:
    """Make a figure again; a record that names what is not there is not the same."""
    try:
        return figure.make()
    except BadInput as bad:
        return Result(False, str(bad))
    except (KeyError, TypeError, ValueError, AttributeError, IndexError, FileNotFoundError) as error:
        return Result(False, f"cannot be made from its record: {error!r}")
