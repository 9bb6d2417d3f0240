"""Everything that the report shows, gathered from the safety case, the sources and the records."""

from __future__ import annotations

import tomllib
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

from evidence.case import Case, read_case
from evidence.catalogue import Evidence, catalogue
from evidence.manifest.hashes import ROOT, files, hash_of, sources
from evidence.pairs import Together, together, unwatched
from evidence.records.reading import Kept, Records, read
from evidence.records.showing import Came, Shown, shown
from evidence.report.chained import ChainDrawing, drawn_chain
from evidence.report.cored import RECORD as CORES
from evidence.report.cored import Cored, cored
from evidence.report.goals import WORST, Drawing, argued, drawn
from evidence.report.playing import Table, tables
from evidence.report.resting import Resting, resting
from evidence.report.saying import Said, vocabulary
from evidence.report.strips import Strip, strips
from evidence.report.tracing import PROOFS, Proved, Requirement, proofs_of, requirements
from evidence.report.words import titled_rows
from models.shipped import shipped
from proofs import assumptions
from proofs.assumptions import Assumption
from proofs.chain import Chain, chain
from proofs.records import commit, versions
from proofs.theories import THEORIES

DATA = ROOT / "evidence"
JOINTS = "joints.json"
"""What ``heisoku mutate --joints --json out/joints.json`` leaves."""
REPORTS = (".html", ".pdf")
PAIRS_AT_MOST = 40
"""So many pairs of assumptions are shown, of those on which most rests."""


@dataclass(frozen=True)
class Assumed:
    """An assumption with whose duty it is, and what rests on it."""

    full: str
    assumption: Assumption
    used: str


@dataclass(frozen=True)
class Book:
    """What the report is made of; each part is gathered when it is first shown.

    ``called``: the folder's name, as the report says it.
    """

    folder: Path
    called: str
    case: Case
    evidence: Mapping[str, Evidence]
    records: Records
    shown: Mapping[str, Shown]
    commit: str | None

    @cached_property
    def anchors(self) -> frozenset[str]:
        """What a figure can name as its evidence: a piece of it, or a record."""
        return frozenset({*self.evidence, *self.records})

    @cached_property
    def came(self) -> Mapping[str, Came]:
        """What each claim comes to."""
        return argued(self.case, self.shown)

    @cached_property
    def lacking(self) -> Mapping[str, list[Shown]]:
        """Evidence that does not hold or is not shown, by its record; what does not hold first."""
        bad = [each for each in self.shown.values() if each.verdict != "holds"]
        found: dict[str, list[Shown]] = {}
        for each in sorted(bad, key=lambda each: WORST.index(each.verdict)):
            found.setdefault(each.evidence.record, []).append(each)
        return found

    @cached_property
    def counted(self) -> Mapping[Came, int]:
        """How many pieces of evidence come to what."""
        count = Counter(each.verdict for each in self.shown.values())
        return {verdict: count[verdict] for verdict in WORST}

    @cached_property
    def drawing(self) -> Drawing:
        """The goal structure."""
        return drawn(self.case, self.shown)

    @cached_property
    def chain(self) -> Chain:
        """What the theorem rests on, by the cores on record if they are of this commit."""
        return chain(self.of(CORES).get("obligations", ()) if self.cored else ())

    @cached_property
    def chain_drawing(self) -> ChainDrawing:
        """The same as shapes."""
        return drawn_chain(self.chain, self.shown)

    @cached_property
    def requirements(self) -> list[Requirement]:
        """Every requirement."""
        return requirements(self.case)

    @cached_property
    def proofs(self) -> Mapping[str, Proved]:
        """Every invariant."""
        return proofs_of(self.records.get(PROOFS), self.evidence)

    @cached_property
    def by_theory(self) -> Mapping[str, list[Proved]]:
        """The invariants of each theory."""
        found: dict[str, list[Proved]] = {}
        for each in self.proofs.values():
            found.setdefault(each.theory, []).append(each)
        return found

    @cached_property
    def vocabulary(self) -> list[Said]:
        """The words that invariants are said in."""
        return vocabulary()

    @cached_property
    def strips(self) -> Sequence[Strip]:
        """The witnesses of the interlocking."""
        return strips()

    @cached_property
    def tables(self) -> Mapping[str, Sequence[Table]]:
        """The witnesses of the theories beside it."""
        return {name: tables(name) for name in THEORIES if name != "interlocking"}

    @cached_property
    def claimed_by(self) -> Mapping[str, list[str]]:
        """The claims that name each piece of evidence."""
        found: dict[str, list[str]] = {}
        for claim in self.case.claims:
            for name in claim.evidence:
                found.setdefault(name, []).append(claim.number)
        return found

    @cached_property
    def assumed(self) -> Mapping[str, Assumed]:
        """Every assumption by its full name."""
        return {
            f"{one.kind}.{one.name}": Assumed(f"{one.kind}.{one.name}", one, assumptions.used(one))
            for one in assumptions.read()
        }

    @cached_property
    def homeless(self) -> list[str]:
        """Assumptions that stand in no duty of the case."""
        named = {name for duty in self.case.duties for name in duty.assumptions}
        return [name for name in self.assumed if name not in named]

    @cached_property
    def pairs(self) -> Sequence[Together]:
        """Assumptions that would be broken unnoticed together, those on which most rests first."""
        return together()

    @cached_property
    def unwatched(self) -> Sequence[str]:
        """Assumptions that no machine watches."""
        return unwatched()

    def of(self, name: str) -> Mapping[str, Any]:
        """What stands in a record; nothing where it is missing or cannot be read."""
        record = self.records.get(name)
        return record.data if record is not None and not record.problem else {}

    def rows(self, name: str, key: str) -> list[Mapping[str, Any]]:
        """A list in a record."""
        found = self.of(name).get(key)
        return [each for each in found if isinstance(each, dict)] if isinstance(found, list) else []

    @cached_property
    def resting(self) -> Resting:
        """Which invariants rest on which guards and updates, by the record of mutants."""
        return resting(self.rows("mutate.json", "mutants"))

    @cached_property
    def cored(self) -> Cored | None:
        """What the proofs rest on by their unsat cores; None where there is no record of this commit."""
        record = self.records[CORES]
        return cored(record.data) if record.data and record.commit == self.commit else None

    @cached_property
    def joints(self) -> Mapping[str, Any]:
        """Whether each joint between machines is needed and right; nothing where there is no record of this commit."""
        record = self.records[JOINTS]
        return record.data if record.commit == self.commit else {}

    @cached_property
    def mutants(self) -> Mapping[str, Any]:
        """What mutation came to: counts by theory, what kills nothing, and all that is not simply killed."""
        rows = sorted(self.rows("mutate.json", "mutants"), key=lambda row: str(row["mutant"]))
        theories: dict[str, Counter[str]] = {}
        for row in rows:
            for theory in row["theories"] or ("said only",):
                theories.setdefault(theory, Counter())[row["became"]] += 1
        kills = self.of("mutate.json").get("kills", {})
        return {
            "of": self.of("mutate.json").get("of", 0),
            "seconds": self.of("mutate.json").get("seconds", 0),
            "tried": len(rows),
            "became": Counter(row["became"] for row in rows),
            "by": Counter(row["outcome"] for row in rows if row["became"] == "killed"),
            "theories": theories,
            "kills": {
                theory: sorted(counts.items(), key=lambda item: (-item[1], item[0])) for theory, counts in kills.items()
            },
            "idle": {theory: [name for name, count in counts.items() if not count] for theory, counts in kills.items()},
            "classed": [row for row in rows if row["became"] == "classed"],
            "holes": [row for row in rows if row["became"] == "hole"],
        }

    @cached_property
    def tools(self) -> list[Mapping[str, Any]]:
        """The tools and their classes."""
        found: list[Mapping[str, Any]] = tomllib.loads((DATA / "tools.toml").read_text("utf-8"))["tool"]
        return found

    @cached_property
    def standards(self) -> list[Mapping[str, Any]]:
        """What standards and practice ask for."""
        found: list[Mapping[str, Any]] = tomllib.loads((DATA / "standards.toml").read_text("utf-8"))["standard"]
        return found

    @cached_property
    def glossary(self) -> Mapping[str, list[list[str]]]:
        """The glossary, by its sections."""
        found: dict[str, list[list[str]]] = {}
        page = shipped("docs/glossary.md").read_text("utf-8")
        for title, cells in titled_rows(page.splitlines(), 4):
            found.setdefault(title, []).append(cells)
        return found

    @cached_property
    def hashes(self) -> Mapping[str, str]:
        """The hash of every file of the folder, but of reports and of single obligations."""
        return {
            name: hash_of(self.folder / name)
            for name in files(self.folder)
            if not name.endswith(REPORTS) and not name.startswith("obligations/")
        }

    @cached_property
    def sources(self) -> str:
        """The hash of the sources."""
        return sources()

    @cached_property
    def made_with(self) -> list[tuple[str, Kept]]:
        """The records, each with what it says it was made with."""
        return [(name, record) for name, record in self.records.items()]

    @property
    def versions(self) -> Mapping[str, str]:
        """The versions that this report was made with."""
        return versions()


def gathered(folder: Path, called: str = "") -> Book:
    """Read the case and the records of a folder; ``called``: what to call it, if it was moved since."""
    known, now = catalogue(), commit()
    records = dict(read(folder, frozenset({CORES, JOINTS, *(each.record for each in known.values())})))
    found = shown(known, records, now)
    for each in found.values():
        if each.malformed:
            name = each.evidence.record
            records[name] = Kept(
                name, problem="it does not have the form of such a record", sha256=records[name].sha256
            )
    return Book(folder, called or folder.name, read_case(), known, records, found, now)
