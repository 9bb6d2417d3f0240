"""What a record's command line asks for is what stands in the record, and the command is one that writes it."""

from __future__ import annotations

import shlex
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import PurePath
from typing import Any

from evidence.manifest.finding import Finding
from models.days.systems import system_of
from models.reproduce import PAPERS
from models.sensors.faults import names as faults

Said = Mapping[str, Any]
HEISOKU = frozenset({"heisoku", "heisoku_start"})
"""The names that its command line is begun by."""
PYTEST = frozenset({"pytest", "__main__"})
CORES = frozenset({"cores"})
FLAGS = frozenset({"--joints", "--strict", "--whole", "--merge"})
"""The options that no value follows."""
NO_VALUE = ""
RIDES, DAYS, SEEDS, SEED = 1_024, 200, 1, 1
"""How many there are, and what they are drawn from, where a command line does not say."""
SOLVERS = {"z3": ["z3"], "cvc5": ["cvc5"], "both": ["cvc5", "z3"]}


@dataclass(frozen=True)
class Line:
    """A command line: the program's name, words that are no options, and the values of each option."""

    program: str
    words: tuple[str, ...]
    options: Mapping[str, Sequence[str]]

    def said(self, option: str) -> str | None:
        """The last value of an option; None if it is not given."""
        return self.options[option][-1] if option in self.options else None

    def number(self, option: str, otherwise: int) -> int:
        """The same as a number; another one where it is not given."""
        said = self.said(option)
        return otherwise if said is None else int(said)


def line_of(command: str) -> Line:
    """Read a command line as a shell does.

    Raises:
        ValueError: it ends within a quotation, or is empty.
    """
    program, *rest = shlex.split(command) or [""]
    words: list[str] = []
    options: dict[str, list[str]] = {}
    while rest:
        word = rest.pop(0)
        if not word.startswith("-") or word == "-":
            words.append(word)
            continue
        name, equals, value = word.partition("=")
        if not word.startswith("--"):
            name, equals, value = word[:2], word[2:], word[2:]
        if not equals and name not in FLAGS:
            value = rest.pop(0) if rest else NO_VALUE
        options.setdefault(name, []).append(value)
    return Line(PurePath(program).stem, tuple(words), options)


Held = Iterator[tuple[str, object, object]]
"""Of each option: its name, what it asks for, and what stands in the record."""


def _proved(line: Line, told: Said) -> Held:
    obligations = told["obligations"]
    solver = line.said("--solver") or "z3"
    yield "--solver", SOLVERS.get(solver, solver), sorted({each["solver"] for each in obligations})
    yield "--seeds", line.number("--seeds", SEEDS), 1 + max((each["seed"] for each in obligations), default=0)
    yield "--only", line.said("--only"), None


def _part(line: Line, told: Said) -> Held:
    yield "--only", line.said("--only"), told["only"]
    yield "--sample", None if (said := line.said("--sample")) is None else int(said), told["sample"]
    yield "--ethos", "--ethos" in line.options and not told.get("external"), False


def _cored(line: Line, told: Said) -> Held:
    yield "--only", line.said("--only") or None, None


def _checked(line: Line, told: Said) -> Held:
    yield "LAYOUT", [str(PurePath(each)) for each in line.words[1:]], [each["file"] for each in told["layouts"]]
    strict = "--strict" in line.options
    yield "--strict", strict, all(each.get("strict", strict) for each in told["layouts"]) and strict


def _ridden(line: Line, told: Said) -> Held:
    named = list(line.options.get("--beyond", ()))
    yield "--seed", line.number("--seed", SEED), told["seed"]
    yield "--beyond", _each(named, list(faults())) or [None], [each["beyond"] for each in told["campaigns"]]
    for each in told["campaigns"]:
        yield "--rides", line.number("--rides", RIDES), each["rides"]


def _lived(line: Line, told: Said) -> Held:
    named = list(line.options.get("--beyond", ()))
    yield "SYSTEM", list(line.words[1:]), [told["system"]]
    yield "--seed", line.number("--seed", SEED), told["seed"]
    yield "--days", line.number("--days", DAYS), told["days"]
    yield "--beyond", _each(named, list(system_of(told["system"]).beyond)), list(told["beyond"])


def _each(named: list[str], every: list[str]) -> list[str]:
    return every if named == ["each"] else named


def _reproduced(line: Line, told: Said) -> Held:
    yield "PAPER", list(line.words[1:]), [told["paper"]]
    yield "--seed", line.number("--seed", SEED), told["seed"]
    yield "--runs", line.number("--runs", PAPERS[told["paper"]].runs), told["runs"]


def _fuzzed(line: Line, told: Said) -> Held:
    """Of one start: a campaign is gone on with by the same targets, and what was put together has all of them."""
    asked, there = line.options.get("--target", ()), {each.partition(":")[0] for each in told["targets"]}
    yield "--target", sorted(there - set(asked)) if asked else [], []
    if line.said("--seed") is not None:
        yield "--seed", line.number("--seed", SEED) in told["seeds"], True


def _nothing(line: Line, told: Said) -> Held:
    yield from ()


@dataclass(frozen=True)
class Writer:
    """Who writes a record: programs, the command, whether with ``--joints``, and what its options ask for."""

    programs: frozenset[str]
    command: str
    held: Callable[[Line, Said], Held]
    joints: bool = False


WRITERS = {
    "prove.json": Writer(HEISOKU, "prove", _proved),
    "certificates.json": Writer(HEISOKU, "certify", _part),
    "mutate.json": Writer(HEISOKU, "mutate", _part),
    "joints.json": Writer(HEISOKU, "mutate", _part, joints=True),
    "cores.json": Writer(CORES, "", _cored),
    "check.json": Writer(HEISOKU, "check", _checked),
    "ride.json": Writer(HEISOKU, "ride", _ridden),
    "beyond.json": Writer(HEISOKU, "ride", _ridden),
    "fuzz.json": Writer(HEISOKU, "fuzz", _fuzzed),
    "test.xml": Writer(PYTEST, "", _nothing),
    "crosshair.txt": Writer(frozenset({"make"}), "crosshair", _nothing),
} | {f"{paper}.json": Writer(HEISOKU, "reproduce", _reproduced) for paper in PAPERS}
DAYS_BEGIN = "days-"
"""How the names of records of days begin."""


def commanded(name: str, command: str, told: Said) -> Iterator[Finding]:
    """Hold a command line against the record that it is said to have written."""
    writer = Writer(HEISOKU, "days", _lived) if name.startswith(DAYS_BEGIN) else WRITERS[name]
    line = line_of(command)
    is_its = line.program in writer.programs and (not writer.command or line.words[:1] == (writer.command,))
    if not is_its or ("--joints" in line.options) != writer.joints:
        yield Finding("other command", name, f"{command}: is no command that writes this record")
        return
    for option, asked, there in writer.held(line, told):
        if asked != there:
            yield Finding("other command", name, f"{command}: asks for {option} {asked}, and it is of {there}")
