"""All that the sources say must stand in a folder of records, compared with what stands there; no solver is asked."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from functools import partial
from typing import Any

from evidence.catalogue import catalogue
from evidence.manifest import expected_campaign, making
from evidence.manifest import expected_proofs as proofs
from evidence.manifest import expected_runs as runs
from evidence.manifest.alike import alike, timed, ways
from evidence.manifest.expected_commands import commanded
from evidence.manifest.finding import Finding
from evidence.manifest.forms import formed, gone_through
from evidence.manifest.hashes import ALWAYS
from evidence.manifest.laying_out import Cell, LaidOut
from evidence.records.reading import Kept, Records
from models.processes import spread
from models.reproduce import PAPERS
from proofs.mutants import joints
from proofs.mutants.plays import witnesses
from proofs.mutants.targets import mutants
from proofs.records import About, about, solvers_altered
from proofs.theories import THEORIES
from proofs.witnesses.registry import WITNESSES

BOUND = ("prove.json", "certificates.json", "mutate.json", "cores.json", "joints.json")
NAMES = frozenset({*BOUND, *(each.record for each in catalogue().values())})
"""Every record that is compared."""
ABOUT = ("commit", "command", "versions", "solvers", "platform", "made_at")


def by_proofs(records: Records, laid_out: Mapping[Cell, LaidOut]) -> Iterator[Finding]:
    """Compare records of proofs with every obligation, laid out anew."""
    judges = {
        "prove.json": proofs.proved,
        "certificates.json": proofs.certified,
        "mutate.json": proofs.mutated,
        "cores.json": proofs.cored,
        "joints.json": proofs.joined,
    }
    for name, judge in judges.items():
        if _is_there(records, name):
            yield from formed(name, partial(_by_pattern, judge, records[name].data, laid_out))


def _by_pattern(
    judge: Callable[[Mapping[str, Any], Mapping[Cell, LaidOut]], Iterator[Finding]],
    told: Mapping[str, Any],
    laid_out: Mapping[Cell, LaidOut],
) -> Iterator[Finding]:
    """Compare a record with what its pattern asks for, if that can be found out."""
    if told.get("only"):
        gone_through(told["only"], [*map(" ".join, laid_out), *mutants(), *joints.names()])
    yield from judge(told, laid_out)


def by_runs(records: Records) -> Iterator[Finding]:
    """Compare every other record with what the sources name."""
    judges: dict[str, Callable[[Kept], Iterator[Finding]]] = {
        "check.json": lambda kept: runs.checked(kept.data),
        "fuzz.json": lambda kept: expected_campaign.fuzzed(kept.data),
        "test.xml": runs.tested,
        "crosshair.txt": runs.confirmed,
    }
    judges |= dict.fromkeys(("ride.json", "beyond.json"), lambda kept: runs.ridden(kept.name, kept.data))
    judges |= dict.fromkeys(
        (name for name in NAMES if name.startswith("days-")), lambda kept: runs.lived(kept.name, kept.data)
    )
    judges |= dict.fromkeys((f"{paper}.json" for paper in PAPERS), lambda kept: runs.reproduced(kept.name, kept.data))
    for name, judge in judges.items():
        if _is_there(records, name):
            yield from formed(name, partial(judge, records[name]))


def _is_there(records: Records, name: str) -> bool:
    return name in records and not records[name].problem


def lacking(records: Records) -> list[str]:
    """Records that are not there, and those that are of a part: what the folder does not show."""
    said = [f"{name}: {kept.problem}" for name, kept in sorted(records.items()) if kept.problem]
    for name, kept in records.items():
        part = [f"--{key} {kept.data[key]}" for key in ("only", "sample") if kept.data.get(key) is not None]
        if part:
            said.append(f"{name}: a part, made with {' '.join(part)}")
    said += runs.papers_of_a_part(records)
    if _is_there(records, expected_campaign.NAME):
        said += expected_campaign.of_a_part(records[expected_campaign.NAME].data)
    for name, kept in records.items():
        skipped = sum(each.came_to == "skipped" for each in kept.answers)
        if skipped:
            said.append(f"{name}: {skipped:,} of {len(kept.answers):,} were skipped")
    told = records["prove.json"].data.get("obligations")
    asked = {str(each.get("solver")) for each in told if isinstance(each, dict)} if isinstance(told, list) else set()
    said += [f"prove.json: {solver} was not asked" for solver in ("z3", "cvc5") if asked and solver not in asked]
    return said


def bare(records: Records) -> list[str]:
    """The records without which nothing is shown, and that are not there."""
    return [name for name in ALWAYS if not _is_there(records, name)]


def told(records: Records, commit: str | None, until: str = "") -> Iterator[Finding]:
    """Each record says how it was made, all of them the same, and none later than ``until``."""
    now = about()
    for name, kept in records.items():
        if kept.unfit:
            yield Finding("unreadable", name, kept.problem)
        elif not kept.problem:
            yield from formed(name, partial(_told, kept, now, commit))
            yield from formed(name, partial(timed, kept, until))
    yield from alike(records)
    for file in solvers_altered():
        yield Finding("altered solver", file, "is not as its package says: install the solvers again")


def _told(kept: Kept, now: About, commit: str | None) -> Iterator[Finding]:
    """Of each way in which a record says that it was made; a campaign says so of each of its starts."""
    for said in ways(kept):
        yield from _said(kept.name, said, now, commit)
        if said.get("command"):
            yield from commanded(kept.name, said["command"], kept.data)


def _said(name: str, said: Mapping[str, Any], now: About, commit: str | None) -> Iterator[Finding]:
    for key in ABOUT:
        if not said.get(key) and (key != "commit" or commit):
            yield Finding("unsaid", name, f"does not say its {key}")
    if said.get("commit", commit) != commit:
        yield Finding("other commit", name, f"is of commit {said['commit']}, and the manifest of {commit}")
    if said.get("versions") and said["versions"] != now["versions"]:
        there, here = _in_words(said["versions"]), _in_words(now["versions"])
        yield Finding("other versions", name, f"is of {there}, and this is {here}")
    elif said.get("platform") == now["platform"] and said.get("solvers") != now["solvers"]:
        yield Finding("other solvers", name, "is by solvers of these versions whose files are not those here")


def _in_words(versions: Any) -> str:
    return ", ".join(f"{name} {version}" for name, version in dict(versions).items())


def plays() -> list[tuple[str, str]]:
    """Every witness, by its theory and name."""
    names = {theory: WITNESSES if theory == "interlocking" else witnesses(theory) for theory in THEORIES}
    return [(theory, name) for theory, of_it in names.items() for name in of_it]


def played(jobs: int) -> Iterator[Finding]:
    """Play every witness."""
    for (theory, name), result in zip(plays(), spread(_play, plays(), jobs), strict=True):
        if not result.same:
            yield Finding("witness", theory, f"{name}: {result.says}")


def _play(which: tuple[str, str]) -> making.Result:
    return making.play(*which)
