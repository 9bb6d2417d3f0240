"""The importer changed in one decision at a time; each change must be noticed from the rails or by a plain walk.

Run ``python -m tests.independent.layouts.mutants [module ...]``: what is noticed is counted, the rest is listed.  The
files are the samples, the real layouts where their folder is, and stations and networks made up at random.  A
mutant under which every file is imported as before is not noticed; of the others every differing file is looked at.
Of a file that is dangerous it is noticed as well if its danger is no longer said, of one like it if it holds no more.
"""

from __future__ import annotations

import ast
import copy
import importlib
import itertools
import json
import random
import signal
import sys
import tomllib
import types
from collections import Counter
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

import yaml

from models.layouts import BadInput, CheckResult, Imported, check, load_text
from models.layouts.generate import as_toml
from tests.independent import files, raw_native, raw_railjson, raw_railml, raw_railml_2, raw_table
from tests.independent.compare import disagreements
from tests.independent.edits import NATIVE, RAILJSON, TABLE
from tests.independent.files import FOLDER, OTHERS, ROOT, SAMPLES
from tests.independent.layouts import railml_2_pieces, railml_pieces
from tests.independent.layouts.crafted import CRAFTED
from tests.independent.layouts.danger import Danger
from tests.independent.layouts.dangerous import DANGERS, OTHERS_THAT_HOLD
from tests.independent.layouts.dangerous_interlocking import INTERLOCKING_THAT_HOLDS
from tests.independent.layouts.dangerous_places import PLACES_THAT_HOLD
from tests.independent.layouts.dangerous_railml import RAILML_THAT_HOLD
from tests.independent.layouts.dangerous_routes import ROUTES_THAT_HOLD
from tests.independent.layouts.dangerous_tables import TABLES_THAT_HOLD
from tests.independent.layouts.dangerous_tracks import TRACKS_THAT_HOLD
from tests.independent.layouts.dangerous_ways import WAYS_THAT_HOLD
from tests.independent.layouts.driving import Driver
from tests.independent.layouts.rails import Survey
from tests.independent.layouts.stations import station
from tests.independent.layouts.survey import survey_text
from tests.independent.made_up import made_up
from tests.independent.raw_follows import differing_conflicts, differing_rests_of_routes, differing_strictly
from tests.independent.test_edited_layouts import NEVER, edited
from tests.layouts.railml_2_made import railml_2_of
from tests.layouts.railml_made import railml_of

PACKAGE = ROOT / "models" / "layouts"
MODULES = (
    *("alike", "assemble", "beside", "blocks", "clearance", "conflicts", "distances", "following", "geometry"),
    *("granting", "loops", "native", "numbers", "railjson", "rests", "standing", "table", "table_layout", "table_ways"),
    *("track", "checker", "conflict_pairs", "continuation", "sorts"),
    *("railml.declared", "railml.document", "railml.importing", "railml.marks", "railml.overlaps", "railml.routes"),
    *("railml.sections", "railml.switches", "railml.topology", "railml.unread", "railml.version_2"),
)
RAILML = ("gicsafe-1.railml", "gicsafe-2.railml", "gicsafe-5.railml")
WITHOUT_DANGER = (
    *(TABLES_THAT_HOLD, TRACKS_THAT_HOLD, RAILML_THAT_HOLD, INTERLOCKING_THAT_HOLDS, PLACES_THAT_HOLD),
    *(ROUTES_THAT_HOLD, WAYS_THAT_HOLD, OTHERS_THAT_HOLD),
)
"""Files that are like dangerous ones, and hold."""
STATIONS, MADE_UP, EDITED = 24, 60, 24
SECONDS = 300
"""Of processor time: all files take a minute, and a mutant that takes so much longer comes to no end."""


# ---- what is changed


@dataclass(frozen=True)
class Mutant:
    """One change: the module, the function, the line as it was, and what was done to it.

    ``nth``: of those in one function to which the same was done, in the order of a walk over its tree.
    """

    module: str
    function: str
    line: int
    what: str
    code: types.CodeType
    nth: int = 1

    @property
    def name(self) -> str:
        """What it is called in a list; lines move, so they are no part of it."""
        return f"{self.module}.{self.function}: {self.what}" + (f" ({self.nth})" if self.nth > 1 else "")


def changes(node: ast.AST) -> Iterator[tuple[str, Callable[[], None]]]:
    """What can be changed at a place in the code: conditions turned round, conditions left out, bounds moved."""
    if isinstance(node, ast.If | ast.While | ast.IfExp | ast.match_case):
        field = "guard" if isinstance(node, ast.match_case) else "test"
        test = getattr(node, field)
        if test is not None:
            turned = ast.UnaryOp(ast.Not(), test)
            yield f"not ({ast.unparse(test)})", lambda: setattr(node, field, turned)
    if isinstance(node, ast.comprehension):
        for at, test in enumerate(node.ifs):
            yield f"for without if {ast.unparse(test)}", lambda at=at: node.ifs.pop(at)  # type: ignore[misc]
    if isinstance(node, ast.BoolOp):
        without = ast.Constant(isinstance(node.op, ast.And))
        for at, value in enumerate(node.values):
            what = f"{ast.unparse(node)} without {ast.unparse(value)}"
            yield what, lambda at=at: node.values.__setitem__(at, without)  # type: ignore[misc]
    bounds: dict[type[ast.cmpop], ast.cmpop] = {
        ast.Lt: ast.LtE(),
        ast.LtE: ast.Lt(),
        ast.Gt: ast.GtE(),
        ast.GtE: ast.Gt(),
    }
    if isinstance(node, ast.Compare):
        for at, sign in enumerate(node.ops):
            if type(sign) in bounds:
                other = bounds[type(sign)]
                yield f"{ast.unparse(node)} at its bound", lambda at=at, other=other: node.ops.__setitem__(at, other)  # type: ignore[misc]
    if isinstance(node, ast.Call) and isinstance(node.func, ast.Name) and node.func.id in ("min", "max"):
        name = node.func
        yield f"{ast.unparse(node)} the other way", lambda: setattr(name, "id", "max" if name.id == "min" else "min")


def mutants(module: str) -> Iterator[Mutant]:
    """Every change of one place in a module."""
    path = PACKAGE / (module.replace(".", "/") + ".py")
    tree = ast.parse(path.read_text(encoding="utf-8"))
    seen: Counter[tuple[str, str]] = Counter()
    for at, node in enumerate(ast.walk(tree)):
        for number, (what, _) in enumerate(changes(node)):
            copied = copy.deepcopy(tree)
            place = list(ast.walk(copied))[at]
            list(changes(place))[number][1]()
            line = getattr(node, "lineno", 0) or getattr(getattr(node, "target", node), "lineno", 0)
            function = _function_around(tree, node)
            if function is not None:
                compiled = compile(ast.fix_missing_locations(copied), str(path), "exec")
                said = " ".join(what.split())
                seen[function, said] += 1
                yield Mutant(module, function, line, said, _code_of(compiled, function), seen[function, said])


def _function_around(tree: ast.Module, wanted: ast.AST) -> str | None:
    """The function or method that a place is in; none for a module's own statements."""
    for outer in tree.body:
        inner = outer.body if isinstance(outer, ast.ClassDef) else [outer]
        for each in inner:
            if isinstance(each, ast.FunctionDef) and any(node is wanted for node in ast.walk(each)):
                return f"{outer.name}.{each.name}" if isinstance(outer, ast.ClassDef) else each.name
    return None


def _code_of(code: types.CodeType, function: str) -> types.CodeType:
    for name in function.split("."):
        code = next(each for each in code.co_consts if isinstance(each, types.CodeType) and each.co_name == name)
    return code


@contextmanager
def planted(mutant: Mutant) -> Iterator[None]:
    """The change in place, in the function that everybody who imported it has."""
    found: Any = importlib.import_module(f"models.layouts.{mutant.module}")
    for name in mutant.function.split("."):
        found = vars(found)[name]
    while not isinstance(found, types.FunctionType):
        found = (
            getattr(found, "__func__", None)
            or getattr(found, "func", None)
            or getattr(found, "fget", None)
            or found.__wrapped__
        )
    before = found.__code__
    found.__code__ = mutant.code
    try:
        yield
    finally:
        found.__code__ = before


# ---- who notices

Asked = Callable[[Imported, files.Enumerated], list[str]]
FOLLOWS: dict[str, Asked] = {
    "checker": differing_strictly,
    "conflict_pairs": differing_conflicts,
    "continuation": differing_rests_of_routes,
}
"""Of modules whose answers are in no import and no verdict, what is asked beside them."""


@dataclass
class File:
    """A file, what it is imported as, and what is known of it without the importer."""

    name: str
    text: str

    @cached_property
    def before(self) -> Imported | None:
        found = imported_or_refused(self)
        return None if isinstance(found, BadInput) else found

    @cached_property
    def loads(self) -> bool:
        return loads(self)

    @property
    def is_of_use(self) -> bool:
        """Whether anything can be noticed by it; what it is without a mutant is known from here on."""
        return self.loads or self.danger is not None or self.must_hold

    @property
    def danger(self) -> Danger | None:
        """What must be said of it, if it is dangerous."""
        found = DANGERS.get(self.name)
        return found if found is not None and found.text == self.text else None

    @property
    def must_hold(self) -> bool:
        """Whether it is like a file that is dangerous, without its danger."""
        return any(each.get(self.name) == self.text for each in WITHOUT_DANGER)

    @cached_property
    def verdict(self) -> CheckResult | None:
        return check(self.before) if self.before is not None else None

    @cached_property
    def survey(self) -> Survey:
        return survey_text(self.name, self.text)

    @cached_property
    def walked(self) -> files.Enumerated | None:
        match Path(self.name).suffix:
            case ".json":
                return raw_railjson.enumerate_data(json.loads(self.text))
            case ".toml":
                return raw_native.enumerate_data(tomllib.loads(self.text))
            case ".yml":
                return raw_table.enumerate_data(yaml.safe_load(self.text))
        return None if self.as_railjson is None else raw_railjson.enumerate_data(self.as_railjson)

    @cached_property
    def as_railjson(self) -> dict[str, Any] | None:
        """The data of railML 2 as RailJSON has it."""
        is_2 = self.name.endswith(".railml") and raw_railml.is_version_2(self.text)
        return raw_railml_2.data_of(self.text) if is_2 else None

    @cached_property
    def unlike(self) -> list[str]:
        return [] if self.before is None else self.disagree(self.before)

    def disagree(self, imported: Imported) -> list[str]:
        """What is seen otherwise without the importer."""
        result = check(imported)
        unlike = railml_pieces.differing(imported, result, self.text) if self.name.endswith(".railml") else []
        unlike += [] if self.as_railjson is None else railml_2_pieces.differing(imported, self.as_railjson)
        return unlike + ([] if self.walked is None else disagreements(imported, result, self.walked))

    def follows(self, ask: Asked) -> list[str]:
        """What follows otherwise from the import than from the walk."""
        return [] if self.before is None or self.walked is None else ask(self.before, self.walked)

    @cached_property
    def hazards(self) -> int:
        if self.before is None:
            return 0
        return len(Driver.of(self.survey, self.before).drive().hazards)

    def noticed(self, imported: Imported) -> str | None:
        """Who notices that a file was imported otherwise."""
        if self.disagree(imported) != self.unlike:
            return "walk"
        if len(Driver.of(self.survey, imported).drive().hazards) > self.hazards:
            return "rails"
        return None


def imported_or_refused(file: File) -> Imported | BadInput:
    """What a file is imported as, or why it is refused as no layout."""
    try:
        return load_text(file.name, file.text)
    except BadInput as refusal:
        return refusal


def corpus() -> Iterator[File]:
    """The files, those that take least first."""
    for name in SAMPLES:
        yield File(name, files.path_of(name).read_text(encoding="utf-8"))
    yield from itertools.starmap(
        File,
        (
            *(each for group in (CRAFTED, *WITHOUT_DANGER) for each in group.items()),
            *(*dangerous(), *railml_pieces.files(), *railml_2_pieces.files()),
        ),
    )
    for number in range(EDITED):
        what, data = edited("junction.toml", NATIVE, random.Random(number))
        yield File(f"{what}.toml", as_toml(data))
    for number in range(STATIONS):
        yield File(f"station {number}.json", json.dumps(station(random.Random(number))))
    for number in range(4 * STATIONS):
        data = station(random.Random(number))
        if all(switch["switch_type"] == "point_switch" for switch in data["switches"]):
            yield File(f"station {number}.railml", railml_of(data))
            yield File(f"station {number} in railML 2.railml", railml_2_of(data))
    for number in range(MADE_UP):
        made = made_up(random.Random(number))
        if made is not None:
            yield File(f"made up {number}.json", json.dumps(made))
    if FOLDER.is_dir():
        for name in (*RAILML, *OTHERS):
            yield File(name, (FOLDER / name).read_text(encoding="utf-8"))
        for number in range(EDITED):
            what, data = edited("osrd-tiny_infra.json", RAILJSON, random.Random(number))
            yield File(f"{what}.json", json.dumps(data))
        for number in range(EDITED // 4):
            what, data = edited("swtbahn-lite.yml", TABLE, random.Random(number))
            yield File(f"{what}.yml", yaml.safe_dump(data, sort_keys=False))


def dangerous() -> Iterator[tuple[str, str]]:
    """The files that are dangerous, by name and text."""
    return ((name, danger.text) for name, danger in DANGERS.items())


def says_a_danger(verdict: CheckResult) -> bool:
    """Whether a verdict on a file without a danger remarks on what is one."""
    return any(danger.said in each.text for danger in DANGERS.values() for each in verdict.remarks)


def reads(module: str, file: File) -> bool:
    """Whether a module has a part in importing a file."""
    kinds = {"railjson": ".json", "native": ".toml"}
    kinds |= dict.fromkeys(("conflicts", "table", "table_layout", "table_ways"), ".yml")
    if module in ("checker", "conflict_pairs", "sorts"):
        return True
    kind = kinds.get(module, ".railml" if module.startswith("railml") else "")
    return file.name.endswith(kind) if kind else not file.name.endswith(".yml")


def loads(file: File) -> bool:
    """Whether importer and survey can both read a file, or the plain walk too says that a route comes nowhere."""
    try:
        if file.before is None and file.name.endswith(".railml"):
            return raw_railml.broken(file.text) is not None
        if file.before is None and file.name.endswith(".json") and raw_railjson.broken(json.loads(file.text)):
            return True
        if file.before is None:
            return file.walked is not None and any(found.rule == NEVER for found in file.walked.violations)
        return file.verdict is not None and file.hazards + len(file.unlike) >= 0
    except (NotImplementedError, KeyError, ValueError, IndexError, AssertionError):
        return False


class OutOfTime(BaseException):
    """A mutant that does not come to an end."""


def _out_of_time(*_: object) -> None:
    raise OutOfTime


def who_notices(mutant: Mutant, known: list[File]) -> str | None:
    """Who notices a mutant first: a good file refused, the plain walk, or trains on the rails."""
    same, ask = True, FOLLOWS.get(mutant.module)
    signal.signal(signal.SIGVTALRM, _out_of_time)
    signal.setitimer(signal.ITIMER_VIRTUAL, SECONDS)
    try:
        with planted(mutant):
            for file in known:
                try:
                    found = imported_or_refused(file)
                    imported = None if isinstance(found, BadInput) else found
                    verdict = None if imported is None else check(imported)
                    if file.danger is not None and not file.danger.is_said(found):
                        return "danger"
                    follows = None if ask is None or not file.loads or file.unlike else file.follows(ask)
                except Exception:  # whatever it is: a file that is a layout is refused
                    return "refused"
                if file.must_hold and (verdict is None or verdict.verdict != "holds"):
                    return "refused"
                if file.must_hold and verdict is not None and says_a_danger(verdict):
                    return "danger"
                if not file.loads:
                    continue
                if follows:
                    return "walk"
                if (imported is None) != (file.before is None):
                    return "refused" if imported is None else "walk"
                if imported is not None and (imported != file.before or verdict != file.verdict):
                    same = False
                    by = file.noticed(imported)
                    if by is not None:
                        return by
    except OutOfTime:
        return "no end"
    finally:
        signal.setitimer(signal.ITIMER_VIRTUAL, 0)
    return None if same else ""


def main() -> int:
    """Count who notices what; list what nobody does."""
    known = [file for file in corpus() if file.is_of_use]
    print(f"{len(known)} files")
    left = 0
    for module in sys.argv[1:] or MODULES:
        found: dict[str, int] = {}
        concerned = [file for file in known if reads(module, file)]
        for mutant in mutants(module):
            by = who_notices(mutant, concerned)
            found[by or "nobody"] = found.get(by or "nobody", 0) + 1
            if not by:
                left += 1
                print(f"  {'same' if by is None else 'OTHER'} {mutant.name} (line {mutant.line})", flush=True)
        print(module, found, flush=True)
    return 1 if left else 0


if __name__ == "__main__":
    sys.exit(main())
