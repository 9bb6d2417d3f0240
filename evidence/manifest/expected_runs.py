"""What records of layouts, papers, campaigns, tests and contracts must name by the sources."""

from __future__ import annotations

import ast
import subprocess
import sys
from collections.abc import Iterator, Mapping
from itertools import takewhile
from pathlib import PurePath
from typing import Any

from evidence.manifest import expected_sums, making
from evidence.manifest.finding import Finding, differences
from evidence.records.reading import Kept, Records
from models.days.systems import system_of
from models.exit_codes import WORDS
from models.layouts.measures import CLEARANCE_MM
from models.reproduce import PAPERS
from models.reproduce.tables import Reproduction
from models.rides.tally import ASSUMPTIONS, COLUMNS, MONITORS, VIOLATIONS
from models.sensors.faults import names as faults
from models.shipped import PACKAGES, is_installed, shipped

Told = Mapping[str, Any]
COLLECTING_S = 600
TESTS = PACKAGES / "tests"


def checked(told: Told) -> Iterator[Finding]:
    """Every sample layout stands there, and each layout comes to the same again."""
    name = "check.json"
    there = [str(each["file"]) for each in told["layouts"]]
    samples = [f"layouts/{path.name}" for path in sorted(shipped("layouts").glob("*.toml"))]
    yield from differences("layout", name, [each for each in there if each in samples], samples)
    for each in told["layouts"]:
        place = f"layouts/{PurePath(each['file']).name}"
        if place in samples and each["file"] != place:
            yield Finding("foreign layout", name, f"{each['file']}: has the name of {place}, and is another file")
        if place in samples and (each["clearance_mm"] != CLEARANCE_MM or each["strict"]):
            said = f"with {each['clearance_mm']} mm, strict: {each['strict']}"
            yield Finding("other check", name, f"{place}: checked {said}, and not with {CLEARANCE_MM} mm as it stands")
        result = making.check(each)
        if not result.same:
            yield Finding("other layout", name, f"{each['file']}: {result.says}")
    worst = max((list(WORDS.values()).index(each["verdict"]) for each in told["layouts"]), default=-1)
    if not there or told["verdict"] != list(WORDS.values())[worst]:
        yield Finding("other verdict", name, f"says {told['verdict']}, and what stands in it comes to another")


def reproduced(name: str, told: Told) -> Iterator[Finding]:
    """Each row of a paper stands there with its criterion; it holds if each that can be compared agrees."""
    paper = PurePath(name).stem
    now = making.reproduced(paper, told["seed"], 1)
    yield from differences("row", name, [each["what"] for each in told["rows"]], [row.what for row in now.rows])
    for each, row in zip(told["rows"], now.rows, strict=False):
        if (each["what"], each["where"], each["paper"], each["criterion"]) != (
            row.what,
            row.where,
            row.paper,
            row.criterion,
        ):
            yield Finding("other row", name, f"{each['what']}: another figure of the paper's, or another criterion")
        # Some of what is rare in one run, and is not compared there, is in many.
        if (each["agrees"] is None) != (row.agrees is None) and (each["agrees"] is None or told["runs"] == 1):
            yield Finding("other row", name, f"{each['what']}: compared or not, against the sources")
        if each["agrees"] is not None and not isinstance(each["agrees"], bool):
            yield Finding("other row", name, f"{each['what']}: agrees {each['agrees']!r}, which is neither yes nor no")
    yield from _as_laid_out(name, told, now)
    agrees = all(each["agrees"] for each in told["rows"] if each["agrees"] is not None)
    if (told["verdict"] == "holds") != agrees or told["paper"] != paper:
        yield Finding("other verdict", name, f"says {told['verdict']} of {told['paper']}, and its rows do not")


def _as_laid_out(name: str, told: Told, now: Reproduction) -> Iterator[Finding]:
    """What decides is what the sources say, whatever the number of runs; that many, and what they counted, is told."""
    if type(told["runs"]) is not int or told["runs"] < 1:
        yield Finding("other sums", name, f"of {told['runs']} runs")
    said = now.record()
    for key in ("parameters", "pictures", "numpy"):
        if told[key] != said[key]:
            yield Finding("other parameters", name, f"its {key} are not those of the sources")
    changed = [(each["result"], each["parameter"], each["value"]) for each in told["sensitivities"]]
    if changed != [(each.result, each.parameter, each.value) for each in now.sensitivities]:
        yield Finding("other parameters", name, "its sensitivities are of other results, or of other parameters")
    yield from differences("count", name, list(told["counts"]), list(now.counts))
    for what, count in told["counts"].items():
        if type(count) is not int or count < min(1, now.counts.get(what, 0)):
            yield Finding("other sums", name, f"{what}: {count}, and one run alone has {now.counts.get(what, 0)}")


def papers_of_a_part(records: Records) -> Iterator[str]:
    """Papers that were reproduced with fewer runs than are enough for their counts."""
    for paper, described in PAPERS.items():
        runs = records[f"{paper}.json"].data.get("runs") if f"{paper}.json" in records else None
        if isinstance(runs, int) and runs < described.runs:
            yield f"{paper}.json: a part, {runs} runs where {described.runs} are enough"


def ridden(name: str, told: Told) -> Iterator[Finding]:
    """Each fault beyond its range has its campaign, and each campaign counts what the sources count."""
    there = [each["beyond"] or "" for each in told["campaigns"]]
    yield from differences("campaign", name, there, [""] if name == "ride.json" else list(faults()))
    counted = {"violations": VIOLATIONS, "assumptions": ASSUMPTIONS, "monitors": MONITORS, "sums": COLUMNS}
    for each in told["campaigns"]:
        for key, wanted in counted.items():
            yield from differences("count", name, list(each[key]), list(wanted))
        if bool(each["violated"]) != any(each["violations"].values()) or each["violated"] > each["rides"]:
            yield Finding("other sums", name, f"{each['violated']} rides with a claim broken, and its counts say other")
    yield from expected_sums.ridden(name, told)


def lived(name: str, told: Told) -> Iterator[Finding]:
    """What is counted of a day is what the sources count."""
    system = system_of(PurePath(name).stem.removeprefix("days-"))
    groups = ("claims", "assumptions", "monitors", "faults", "prices", "counts")
    for group in groups:
        wanted: Mapping[str, str] = getattr(system, group)
        yield from differences("count", name, list(told["columns"].get(group, ())), list(wanted))
    if told["system"] != system.name:
        yield Finding("other system", name, f"is of the {told['system']}")
    broken = any(each["on days"] for each in told["columns"]["claims"].values())
    if bool(told["violated"]) != broken or told["violated"] > told["days"]:
        yield Finding("other sums", name, f"{told['violated']} days with a claim broken, and its counts say other")
    yield from expected_sums.lived(name, told, system)


# ---- lists of tests and contracts


def tested(record: Kept) -> Iterator[Finding]:
    """Each test that the sources have stands there by its name, and none else."""
    wanted = collected()
    if wanted is not None:
        yield from differences("test", record.name, [each.name for each in record.answers], wanted)
    skipped = sum(each.came_to == "skipped" for each in record.answers)
    if record.answers and 2 * skipped >= len(record.answers):
        yield Finding("skipped tests", record.name, f"{skipped:,} of {len(record.answers):,} were not run")


def collected() -> list[str] | None:
    """The tests of the sources that are not slow, by name as a record has them; None in a copy without tests."""
    if is_installed() or not TESTS.is_dir():
        return None
    words = (sys.executable, "-m", "pytest", "--collect-only", "-q", "-n0", "-m", "not slow", "-p", "no:cacheprovider")
    told = subprocess.run(
        [*words, "tests"], cwd=PACKAGES, capture_output=True, text=True, timeout=COLLECTING_S, check=False
    )
    return [in_a_record(line) for line in told.stdout.splitlines() if ".py::" in line]


def in_a_record(node: str) -> str:
    """How a record names a test: ``tests.test_cli::test_it[one]`` is what pytest calls ``tests/test_cli.py::...``."""
    path, _, rest = node.partition(".py::")
    head, bracket, given = rest.partition("[")
    *classes, test = head.split("::")
    return f"{'.'.join([path.replace('/', '.'), *classes])}::{test}{bracket}{given}"


def confirmed(record: Kept) -> Iterator[Finding]:
    """Each contract of the sources has its line, and no line is of none."""
    if is_installed() or not TESTS.is_dir():
        return
    wanted = contracts()
    there = []
    for each in record.answers:
        file, _, line = each.name.rpartition(":")
        own = file[file.rfind("tests/") :]
        at = (name for name, place in wanted.items() if place[0] == own and _in(line, *place[1:]))
        there.append(next(at, each.name))
    yield from differences("contract", record.name, there, list(wanted))


def _in(line: str, first: int, last: int) -> bool:
    return line.isdigit() and first <= int(line) <= last


def contracts() -> Mapping[str, tuple[str, int, int]]:
    """The functions that CrossHair takes for contracts, those that begin with an assertion, and where they stand."""
    found = {}
    for path in sorted([*TESTS.glob("contracts_*.py"), *TESTS.glob("*/contracts_*.py")]):
        own = path.relative_to(PACKAGES).as_posix()
        for each in ast.parse(path.read_text("utf-8")).body:
            if isinstance(each, ast.FunctionDef) and _assumes(each):
                found[f"{own}: {each.name}"] = own, each.lineno, each.end_lineno or each.lineno
    return found


def _assumes(function: ast.FunctionDef) -> bool:
    body = function.body[1:] if ast.get_docstring(function) else function.body
    return any(takewhile(lambda each: isinstance(each, ast.Assert), body[:-1]))
