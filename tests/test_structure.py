"""The rooms of the repository, and what each may contain (the table in README.md).

Every rule is a function from source text to offences, tried on a text that breaks it before it is
believed about the files that do not.
"""

from __future__ import annotations

import ast
import re
import sys
from collections.abc import Iterable, Iterator
from fnmatch import fnmatch
from functools import cache
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parent.parent
MAY_IMPORT = {
    "kernel": {"kernel"},
    "models": {"kernel", "models"},
    "proofs": {"kernel", "models", "proofs"},
    "fuzz": {"kernel", "models", "proofs", "fuzz"},
    "evidence": {"kernel", "models", "proofs", "fuzz", "evidence"},
}
ROOMS = {*MAY_IMPORT, "heisoku", "tests"}
KERNEL_LIBRARY = {"__future__", "collections.abc", "dataclasses", "enum", "typing"}
"""All of the standard library that a kernel file may import: types, and nothing that acts."""
PURE_FUNCTIONS = {"kernel/telegram.py": {"hashlib", "hmac", "zlib"}}
"""What single files import beside: functions of bytes to bytes, a keyed hash and a check sum."""
KERNEL_STATEMENTS_REFUSED = (
    ast.Try,
    ast.TryStar,
    ast.Raise,
    ast.While,
    ast.Lambda,
    ast.With,
    ast.Global,
    ast.Nonlocal,
    ast.Yield,
    ast.YieldFrom,
    ast.Await,
    ast.Delete,
    ast.AsyncFunctionDef,
)
KERNEL_NAMES_REFUSED = {
    *("print", "open", "input", "eval", "exec", "compile", "globals", "locals", "vars", "setattr", "delattr"),
    *("getattr", "__import__", "id", "hash", "object", "breakpoint", "exit", "quit", "float", "complex"),
}
NOT_INDEPENDENT = {*MAY_IMPORT, "heisoku", "heisoku_public", "heisoku_start"} - {"kernel"}
"""What a world that shares nothing with the proofs may not import, directly or by another file of tests."""
SAYS_IT_IS = "Nothing of models or proofs is in it"
"""So a file tells of itself that it is such a world."""
INDEPENDENT = ROOT / "tests" / "independent"
LINES_OF_A_FUNCTION = 60
LINES_OF_A_FILE = 500


def python_files(*folders: str) -> list[Path]:
    """The Python files of some folders, and of the top level where none is named."""
    found = [path for folder in folders for path in sorted((ROOT / folder).rglob("*.py"))]
    return found if folders else sorted(ROOT.glob("*.py"))


def all_files() -> list[Path]:
    return [*python_files(), *python_files(*MAY_IMPORT, "tests")]


def named(path: Path) -> str:
    return str(path.relative_to(ROOT))


def imports(source: str) -> Iterator[tuple[int, str]]:
    """Line and module of every import in a file, wherever in it."""
    for node in ast.walk(ast.parse(source)):
        if isinstance(node, ast.Import):
            yield from ((node.lineno, alias.name) for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            yield node.lineno, "." * node.level + (node.module or "")


def wrong_way_imports(room: str, source: str) -> list[str]:
    """Imports of a room that may not be imported from this one."""
    return [
        f"line {line}: {module}"
        for line, module in imports(source)
        if module.startswith(".") or (module.split(".")[0] in ROOMS and module.split(".")[0] not in MAY_IMPORT[room])
    ]


def listed_worlds(page: str) -> list[Path]:
    """The files of the worlds in the first column of a table, and of the folders that it names."""
    cells = [line.split("|")[1] for line in page.splitlines() if line.startswith("| `")]
    places = [(INDEPENDENT / name).resolve() for cell in cells for name in cell.split("`")[1::2]]
    return [path for place in places for path in (sorted(place.rglob("*.py")) if place.is_dir() else [place])]


@cache
def imported_files(path: Path) -> frozenset[Path]:
    """Files of tests that a file imports, each as a module or a name out of it."""
    names = set[str]()
    for node in ast.walk(ast.parse(path.read_text("utf-8"))):
        if isinstance(node, ast.Import):
            names |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom):
            names |= {str(node.module), *(f"{node.module}.{alias.name}" for alias in node.names)}
    paths = [ROOT / f"{name.replace('.', '/')}.py" for name in names if name.startswith("tests.")]
    return frozenset(each for each in paths if each.is_file())


def reached(path: Path) -> set[Path]:
    """A file of tests and all others of them that it imports, by way of each other too."""
    found, left = set[Path](), [path]
    while left:
        here = left.pop()
        if here not in found:
            found.add(here)
            left += imported_files(here)
    return found


def shared_imports(source: str) -> list[str]:
    """Imports into an independent world of what it is to be independent of."""
    return [f"line {line}: {module}" for line, module in imports(source) if module.split(".")[0] in NOT_INDEPENDENT]


@cache
def shared_imports_of(path: Path) -> list[str]:
    """The same of a file, read once for all worlds that reach it."""
    return shared_imports(path.read_text("utf-8"))


def acting_imports(source: str, pure: set[str] | None = None) -> list[str]:
    """Imports into a kernel file of anything but the kernel, the few modules of types, and what is said to be pure."""
    return [
        f"line {line}: {module}"
        for line, module in imports(source)
        if module.split(".")[0] != "kernel" and module not in KERNEL_LIBRARY | (pure or set())
    ]


def acting_constructs(source: str) -> list[str]:
    """Statements and names that a kernel file must do without."""
    offences = []
    for node in ast.walk(ast.parse(source)):
        if isinstance(node, KERNEL_STATEMENTS_REFUSED):
            offences.append(f"line {node.lineno}: {type(node).__name__}")
        elif isinstance(node, ast.Name) and node.id in KERNEL_NAMES_REFUSED:
            offences.append(f"line {node.lineno}: {node.id}")
        elif isinstance(node, ast.Constant) and isinstance(node.value, float | complex):
            offences.append(f"line {node.lineno}: a number that is no integer")
        elif isinstance(node, ast.BinOp | ast.AugAssign) and isinstance(node.op, ast.Div):
            offences.append(f"line {node.lineno}: a division that leaves the integers")
    return offences


def long_functions(source: str) -> list[str]:
    """Functions that do not fit a screen."""
    return [
        f"line {node.lineno}: {node.name} has {node.end_lineno - node.lineno + 1} lines"
        for node in ast.walk(ast.parse(source))
        if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef)
        and node.end_lineno is not None
        and node.end_lineno - node.lineno >= LINES_OF_A_FUNCTION
    ]


def asserting(sources: Iterable[str]) -> set[str]:
    """The names of all functions in which something is asserted, or in a function of these sources that they call."""
    functions = [
        node for source in sources for node in ast.walk(ast.parse(source)) if isinstance(node, ast.FunctionDef)
    ]
    called = {id(node): calls(node) for node in functions}
    found = {node.name for node in functions if any(can_fail(inner) for inner in ast.walk(node))}
    grown = True
    while grown:
        more = {node.name for node in functions if called[id(node)] & found} - found
        found |= more
        grown = bool(more)
    return found


def idle_tests(source: str, helpers: set[str]) -> list[str]:
    """Test functions in which nothing is asserted, nor in any helper that they call."""
    tree = ast.parse(source)
    able = asserting([source])
    imported = {
        alias.asname or alias.name
        for node in ast.walk(tree)
        if isinstance(node, ast.ImportFrom) and (node.module or "").split(".")[0] == "tests"
        for alias in node.names
    }
    return [
        f"line {node.lineno}: {node.name}"
        for node in ast.walk(tree)
        if isinstance(node, ast.FunctionDef)
        and is_test(node.name)
        and node.name not in able
        and not calls(node) & helpers & imported
    ]


def is_test(name: str) -> bool:
    return name.startswith("test_")


def calls(node: ast.AST) -> set[str]:
    """The names of all functions called in a piece of source."""
    called = [inner.func for inner in ast.walk(node) if isinstance(inner, ast.Call)]
    plain = {func.id for func in called if isinstance(func, ast.Name)}
    return plain | {func.attr for func in called if isinstance(func, ast.Attribute)}


def can_fail(node: ast.AST) -> bool:
    """Whether this is an assertion about something, or an expected exception."""
    if isinstance(node, ast.Assert):
        test = node.test
        says_nothing = isinstance(test, ast.Constant | ast.Tuple) or (
            isinstance(test, ast.Compare)
            and isinstance(test.ops[0], ast.Eq | ast.Is)
            and ast.dump(test.left) == ast.dump(test.comparators[0])
            and not any(isinstance(inner, ast.Call) for inner in ast.walk(test))
        )
        return not says_nothing
    return (
        isinstance(node, ast.Call)
        and isinstance(node.func, ast.Attribute)
        and isinstance(node.func.value, ast.Name)
        and (node.func.value.id, node.func.attr) in {("pytest", "raises"), ("pytest", "fail"), ("pytest", "warns")}
    )


# ---- the rules have teeth


@pytest.mark.parametrize(
    ("room", "source"),
    [
        ("kernel", "import models.world"),
        ("kernel", "from proofs import lift"),
        ("models", "def f():\n    from proofs.run import prove_all"),
        ("models", "import heisoku"),
        ("proofs", "from tests.test_tags import read"),
        ("proofs", "from . import records"),
        ("evidence", "from tests.bench import Figure"),
        ("fuzz", "from evidence.case import read_case"),
    ],
)
def test_an_import_the_wrong_way_is_seen(room: str, source: str) -> None:
    assert len(wrong_way_imports(room, source)) == 1


@pytest.mark.parametrize("module", ["time", "random", "os", "sys", "math", "logging", "numpy", "z3", "collections"])
def test_an_import_that_acts_is_seen(module: str) -> None:
    assert acting_imports(f"import {module}") == [f"line 1: {module}"]
    assert acting_imports(f"from {module} import x") == [f"line 1: {module}"]


@pytest.mark.parametrize(
    "source",
    [
        "try:\n    x = 1\nfinally:\n    x = 2",
        "raise ValueError",
        "while x: x = f(x)",
        "f = lambda x: x",
        "print(x)",
        "open",
        "with f(): x = 1",
        "def f():\n    yield 1",
        "x = 0.5",
        "x = y / z",
        "x /= z",
        "getattr(x, 'y')",
    ],
)
def test_a_construct_that_acts_is_seen(source: str) -> None:
    assert acting_constructs(source) != []


def test_a_function_longer_than_a_screen_is_seen() -> None:
    body = "    x = 1\n"
    assert long_functions("def f():\n" + body * (LINES_OF_A_FUNCTION - 1)) == []
    assert len(long_functions("def f():\n" + body * LINES_OF_A_FUNCTION)) == 1


@pytest.mark.parametrize(
    ("body", "fails"),
    [
        ("f()", False),
        ("assert True", False),
        ("assert (f(), 'always true')", False),
        ("assert x == x", False),
        ("try:\n        f()\n    except ValueError:\n        pass", False),
        ("assert f() == f()", True),
        ("assert x == 1", True),
        ("helper(x)", True),
        ("with pytest.raises(ValueError):\n        f()", True),
    ],
)
def test_a_test_that_cannot_fail_is_seen(body: str, fails: bool) -> None:
    source = f"def test_it(x):\n    {body}\n\ndef helper(x):\n    assert x\n"
    assert (idle_tests(source, set()) == []) is fails


def test_a_helper_of_another_file_counts_only_if_it_asserts() -> None:
    source = "from tests.shared import helper\n\ndef test_it(x):\n    helper(x)\n"
    for body, fails in (("assert x", True), ("return x", False), ("deeper(x)", True)):
        helpers = asserting([f"def helper(x):\n    {body}\n", "def deeper(x):\n    assert x\n"])
        assert (idle_tests(source, helpers) == []) is fails
        assert idle_tests(source.replace("tests.", "other."), helpers) != []


# ---- the rules hold


@pytest.mark.parametrize("room", sorted(MAY_IMPORT))
def test_imports_go_one_way(room: str) -> None:
    offences = {named(path): wrong_way_imports(room, path.read_text("utf-8")) for path in python_files(room)}
    assert {path: lines for path, lines in offences.items() if lines} == {}


def test_a_shared_import_is_seen_through_another_file() -> None:
    for room in ("models.tram", "proofs", "fuzz.campaign", "evidence", "heisoku_public"):
        assert shared_imports(f"def f():\n    from {room} import x\n") == [f"line 2: {room}"]
    assert shared_imports("from kernel.tram import centre\nfrom tests.tram import street\n") == []
    through = reached(ROOT / "tests" / "tram" / "test_two_ways.py")
    assert {"two_ways.py", "street.py"} <= {path.name for path in through}


@pytest.mark.parametrize("path", listed_worlds((INDEPENDENT / "README.md").read_text("utf-8")), ids=named)
def test_independent_worlds_share_nothing_with_the_proofs(path: Path) -> None:
    offences = {named(each): shared_imports_of(each) for each in reached(path)}
    assert {each: lines for each, lines in offences.items() if lines} == {}


def test_who_says_that_it_is_independent_is_listed() -> None:
    listed = listed_worlds((INDEPENDENT / "README.md").read_text("utf-8"))
    told = {path: ast.get_docstring(ast.parse(path.read_text("utf-8"))) or "" for path in python_files("tests")}
    says_it = [path for path, text in told.items() if SAYS_IT_IS in text]
    assert len(says_it) > 5
    assert [named(path) for path in says_it if path not in {each for world in listed for each in reached(world)}] == []


def test_the_kernel_imports_types_and_nothing_that_acts() -> None:
    offences = {
        named(path): acting_imports(path.read_text("utf-8"), PURE_FUNCTIONS.get(named(path)))
        for path in python_files("kernel")
    }
    assert len(offences) > 1
    assert {path: lines for path, lines in offences.items() if lines} == {}
    assert all(module.split(".")[0] in sys.stdlib_module_names for module in KERNEL_LIBRARY)


def test_the_kernel_is_total_and_does_nothing() -> None:
    offences = {named(path): acting_constructs(path.read_text("utf-8")) for path in python_files("kernel")}
    assert len(offences) > 1
    assert {path: lines for path, lines in offences.items() if lines} == {}


def test_functions_fit_a_screen() -> None:
    offences = {named(path): long_functions(path.read_text("utf-8")) for path in all_files()}
    assert len(offences) > len(MAY_IMPORT)
    assert {path: lines for path, lines in offences.items() if lines} == {}


def test_files_can_be_read_in_one_sitting() -> None:
    lengths = {named(path): len(path.read_text("utf-8").splitlines()) for path in all_files()}
    assert {path: length for path, length in lengths.items() if length > LINES_OF_A_FILE} == {}


def test_every_folder_is_on_the_map() -> None:
    ignored = {line.rstrip("/") for line in (ROOT / ".gitignore").read_text("utf-8").splitlines()}
    found = {path.name for path in ROOT.iterdir() if path.is_dir() and not path.name.startswith(".")}
    kept = {name for name in found if not any(fnmatch(name, each) for each in ignored)}
    on_the_map = re.findall(r"^\| `(\w+)/` \|", (ROOT / "README.md").read_text("utf-8"), re.MULTILINE)
    assert kept == set(on_the_map)


def test_every_test_can_fail() -> None:
    helpers = asserting(path.read_text("utf-8") for path in python_files("tests"))
    files = [path for path in python_files("tests") if path.name.startswith("test_")]
    offences = {named(path): idle_tests(path.read_text("utf-8"), helpers) for path in files}
    assert named(Path(__file__)) in offences
    assert {path: lines for path, lines in offences.items() if lines} == {}


def test_every_file_of_tests_is_collected() -> None:
    """A file with tests in it and another name than pytest looks for would pass by never running."""
    unseen = [
        named(path)
        for path in python_files("tests")
        if not path.name.startswith("test_")
        and any(
            isinstance(node, ast.FunctionDef) and is_test(node.name)
            for node in ast.walk(ast.parse(path.read_text("utf-8")))
        )
    ]
    assert unseen == []


def test_required_files_pin_every_hash_and_name_no_index() -> None:
    for name in ("requirements.txt", "requirements-crosshair.txt"):
        lines = (ROOT / name).read_text("utf-8").splitlines()
        pins = [line for line in lines if line and line[0].isalnum()]
        assert all("==" in pin and pin.endswith("\\") for pin in pins)
        assert len(pins) > 5
        assert not [line for line in lines if "://" in line or line.startswith("-")]
