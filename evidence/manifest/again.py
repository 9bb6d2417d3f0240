"""What of the records can be made again, and whether it comes to the same: a random sample, drawn from a seed."""

from __future__ import annotations

import random
from collections import Counter
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any

from evidence.manifest import making
from evidence.manifest.forms import FORM
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
NOBODY = "never asked of Z3 with seed 0"
"""What stands for the verdict on an obligation that the record has no answer of Z3's own to."""
OF_A_KIND_AT_MOST = {"mutant": 3, "ride": 1, "beyond": 2, "days": 2, "day": 4, "paper": 3}
"""Of those that take seconds each."""


@dataclass(frozen=True)
class Figure:
    """Something recorded that can be made again, and how."""

    kind: str
    what: str
    make: Callable[[], Result]


def figures(folder: Path, records: Records) -> Iterator[Figure]:
    """Everything in the records that can be made again within seconds; what a record lacks has no figures.

    Of a record of another form there is one, which cannot be made.
    """
    parts = {
        "proofs": _proofs(records),
        "rides": _rides(records),
        "layouts, papers and traces": _others(folder, records),
    }
    parts |= {f"days of the {system}": _days(folder, records, system) for system in SYSTEMS}
    for what, part in parts.items():
        try:
            yield from part
        except FORM as error:
            yield Figure("unreadable", what, partial(_unreadable, error))


def _unreadable(error: Exception) -> Result:
    return Result(False, f"cannot be made from its record: {error!r}")


def _others(folder: Path, records: Records) -> Iterator[Figure]:
    for each in _list(records, "check.json", "layouts"):
        yield Figure("layout", str(each["file"]), partial(making.check, each))
    for paper in PAPERS:
        if rows := _list(records, f"{paper}.json", "rows"):
            made = partial(making.reproduce, paper, records[f"{paper}.json"].data)
            yield Figure("paper", f"{paper}: all of its {len(rows)} rows", made)
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


def rarely(pool: Sequence[Figure], chosen: Sequence[Figure]) -> str:
    """In words: of which kinds how many were drawn of how many, where it is not all of them."""
    there, taken = Counter(each.kind for each in pool), Counter(each.kind for each in chosen)
    return ", ".join(f"{taken[kind]:,} of {of:,} {kind}" for kind, of in there.items() if taken[kind] < of)


def never(folder: Path, records: Records) -> list[str]:
    """Records whose sums are too large to be made again here, so that nothing shows that they were made up."""
    said = []
    for name in ("ride.json", "beyond.json"):
        told = [each.get("rides") for each in _list(records, name, "campaigns")]
        rides = max((each for each in told if isinstance(each, int)), default=0)
        if rides > RIDES_AT_MOST:
            said.append(f"{name}: {rides:,} rides")
    for system in SYSTEMS:
        name = f"days-{system}.json"
        days = records[name].data.get("days", 0) if name in records else 0
        if isinstance(days, int) and days > DAYS_AT_MOST and not (folder / f"{system}.days").is_file():
            said.append(f"{name}: {days:,} days")
    return said


def asked_again(records: Records, jobs: int, progress: Callable[[int, int, str], object]) -> Iterator[Result]:
    """Put every obligation on record to Z3 once, with its first seed, and compare with Z3's own answer on record.

    What another solver or another seed says is another matter: where Z3 proves, cvc5 may well be undecided.
    """
    cells: dict[tuple[str, str], str] = {}
    for each in _list(records, "prove.json", "obligations"):
        cell = str(each.get("transition")), str(each.get("invariant"))
        cells.setdefault(cell, NOBODY)
        if (each.get("solver"), each.get("seed")) == ("z3", 0):
            cells[cell] = str(each.get("verdict"))
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
    except FORM as error:
        return _unreadable(error)
