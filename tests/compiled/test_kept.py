"""Compiled code is read by the next process, and never for another content than it was compiled of."""

from __future__ import annotations

import json
import os
import pickle
import shutil
import subprocess
import sys
import time
from collections import namedtuple
from collections.abc import Callable
from pathlib import Path
from typing import Any, NamedTuple

import numba
import numpy as np
import pytest
from numba import types as known_types

from kernel.onboard.brake_watch import BrakeWatch
from models.compiled import compiled, packed, records
from models.compiled.contents import Unknown, digest_of, digest_of_types
from models.compiled.kept import UNUSED_S

types: Any = known_types
ROOT = Path(__file__).parents[2]
RUN = """
import json, sys
from dataclasses import astuple
from numba.core import event
from kernel.onboard import brake_watch as kernel
from kernel.onboard.braking import BrakeBounds
from models.compiled import compile_machines, packed, unpacked
from models.compiled.kept import Keeping

compiled = []
class Noted(event.Listener):
    def on_start(self, event):
        if isinstance(event.data["dispatcher"]._cache, Keeping):
            compiled.append(event.data["dispatcher"].py_func.__name__)
    def on_end(self, event):
        pass
event.register("numba:compile", Noted())

made = compile_machines([kernel]).brake_watch
bounds, watch = BrakeBounds(*range(1_003, 1_003 + len(BrakeBounds.__dataclass_fields__))), kernel.watching(9_999)
given = (bounds, watch, True, True, 5_000, 12_000)
found = unpacked(made.note_cycle(*map(packed, given)), kernel.BrakeWatch)
assert found == kernel.note_cycle(*given), (found, kernel.note_cycle(*given))
print(json.dumps([astuple(found), sorted(set(compiled))]))
"""
"""A machine, compiled: what it comes to, the same as in CPython, and the functions for which nothing was kept."""
ALL = ["divided_up", "larger", "next_limit_mm_s", "note_cycle", "smaller"]


class Limits(NamedTuple):
    """A record of this file."""

    least: int
    most: int


LOST: Any = namedtuple("LOST", "least")
LOST.__qualname__ = "Elsewhere"
"""Another, which nobody finds by its name."""


def started(script: str, cache: Path, root: Path = ROOT) -> subprocess.Popen[str]:
    """A process with its cache there, and the sources of that folder.

    It keeps no bytecode: Python knows bytecode by its source's size and second, and the sources change faster here.
    """
    given = [sys.executable, "-B", "-c", script]
    around = {"XDG_CACHE_HOME": str(cache), "PYTHONPATH": str(root), "PATH": ""}
    pipe = subprocess.PIPE
    return subprocess.Popen(given, cwd=root, env=around, stdout=pipe, stderr=pipe, text=True)


def answer(process: subprocess.Popen[str]) -> Any:
    """What it printed, once it has ended well and without a word beside."""
    out, err = process.communicate(timeout=300)
    assert (process.returncode, err) == (0, "")
    return json.loads(out)


def kept(cache: Path) -> dict[str, bytes]:
    """The files that are kept, by name."""
    return {path.name: path.read_bytes() for path in (cache / "heisoku" / "compiled").iterdir()}


# ---- between processes


def test_two_processes_compile_at_once_and_the_next_reads(tmp_path: Path) -> None:
    """Neither sees half of a file of the other; what both kept is whole.

    Whichever is ahead has kept a function before the other asks for it, so each function is compiled by one or both.
    """
    both = [started(RUN, tmp_path) for _ in range(2)]
    (found, names), (other, others) = map(answer, both)
    assert found == other
    assert sorted({*names, *others}) == ALL
    files = kept(tmp_path)
    assert len(files) == len(ALL)
    assert answer(started(RUN, tmp_path)) == [found, []]
    assert kept(tmp_path) == files


def test_a_changed_kernel_is_never_run_with_stale_code(tmp_path: Path) -> None:
    """Changed where it is called from: in another file, an operator and a constant.  What is as it was is read."""
    sources = tmp_path / "sources"
    for folder in ("kernel", "models/compiled", "models/subset"):
        shutil.copytree(ROOT / folder, sources / folder, ignore=shutil.ignore_patterns("__pycache__"))
    for name in ("models/__init__.py", "models/kept_folder.py", "models/names_apart.py"):
        shutil.copy(ROOT / name, sources / name)
    before, names = answer(started(RUN, tmp_path, sources))
    assert names == ALL
    path = sources / "kernel" / "onboard" / "arithmetic.py"
    source = path.read_text("utf-8")
    for old, new, again in (
        ("return -(-value // by)", "return 7 * value // by", ["divided_up", "next_limit_mm_s", "note_cycle"]),
        ("LONGEST_CYCLE_MS = 102", "LONGEST_CYCLE_MS = 902", ["next_limit_mm_s", "note_cycle"]),
    ):
        assert source.count(old) == 1
        path.write_text(source.replace(old, new), "utf-8")
        after, names = answer(started(RUN, tmp_path, sources))
        assert after != before, "the change changes nothing"
        assert names == again
    path.write_text(source, "utf-8")
    assert answer(started(RUN, tmp_path, sources)) == [before, []]


def test_what_is_damaged_is_compiled_over(tmp_path: Path) -> None:
    found, _ = answer(started(RUN, tmp_path))
    files = kept(tmp_path)
    folder = tmp_path / "heisoku" / "compiled"
    for number, (name, whole) in enumerate(sorted(files.items())):
        middle = len(whole) // 2
        flipped = whole[:middle] + bytes([whole[middle] ^ 1]) + whole[middle + 1 :]
        (folder / name).write_bytes([whole[:middle], flipped, b"", whole + b"\0", flipped][number])
    assert answer(started(RUN, tmp_path)) == [found, ALL]
    assert answer(started(RUN, tmp_path)) == [found, []]


def test_where_nothing_can_be_kept_it_is_compiled(tmp_path: Path) -> None:
    file = tmp_path / "file"
    file.write_text("no folder", "utf-8")
    found, names = answer(started(RUN, file / "cache"))
    assert found
    assert names == ALL
    assert [path.name for path in tmp_path.iterdir()] == ["file"]


NAMED_ALIKE = """
import json
from kernel.onboard.brake_watch import BrakeWatch
from models.compiled import compiled, packed, records
found = []
for by in BY:
    names = {"__name__": "models.compiled.machines"}
    again = "inner(value - 1) + inner(value - 2)"
    exec(f"def inner(value):\\n    return {again} if value > 2 else {by}", names)
    exec("def outer(value):\\n    return inner(value) + 1", names)
    names["inner"] = compiled(names["inner"])
    found.append(compiled(names["outer"])(5))
print(json.dumps(found))
"""


def test_what_is_read_is_not_taken_for_what_is_named_alike_here(tmp_path: Path) -> None:
    """Numba numbers functions from 1 on in every process, and the linker goes by such names alone."""
    assert answer(started(NAMED_ALIKE.replace("BY", "(3,)"), tmp_path)) == [16]
    assert answer(started(NAMED_ALIKE.replace("BY", "(3, 4, 3)"), tmp_path)) == [16, 21, 16]


WITHIN_TUPLES = """
import json
from numba.core import event
from models.compiled import compiled

again = []
class Noted(event.Listener):
    def on_start(self, event):
        again.append(event.data["dispatcher"].py_func.__name__)
    def on_end(self, event):
        pass
event.register("numba:compile", Noted())

def function(name, said, **around):
    names = {"__name__": "models.compiled.machines", **around}
    exec(f"def {name}(value, first=None, others=None):\\n    return {said}", names)
    return compiled(names[name])

first, second, third = (function(f"times_{by}", f"value * {by}") for by in (2, 3, 5))
chosen = function("chosen", "others[2][1]")
inner = function("inner", "first(value) + others[1](value)")
outer = function("outer", "inner(value, first, others) - chosen(value, first, others)(value) + MORE",
                 inner=inner, chosen=chosen)
print(json.dumps([outer(10, first, (7, second, (8, third))), sorted(set(again))]))
"""
"""Functions given as an argument, in a tuple and in a tuple within it; and those for which nothing was kept."""


def test_what_takes_functions_within_tuples_is_read(tmp_path: Path) -> None:
    """Each is the one in its place, also where it is what a function that was read gives to one compiled anew."""
    run = WITHIN_TUPLES.replace("MORE", "0")
    found, names = answer(started(run, tmp_path))
    assert found == 2 * 10 + 3 * 10 - 5 * 10
    assert names == ["chosen", "inner", "outer", "times_2", "times_3", "times_5"]
    files = kept(tmp_path)
    assert len(files) == len(names)
    assert answer(started(run, tmp_path)) == [found, []]
    assert kept(tmp_path) == files
    assert answer(started(WITHIN_TUPLES.replace("MORE", "1"), tmp_path)) == [found + 1, ["outer"]]


# ---- what a digest tells apart

BASE = "def f(x):\n    return g(x) + TABLE[0] + LIMITS.least if x < LIMIT else -1\n\ndef g(x):\n    return x * 3\n"
AROUND: dict[str, Any] = {"LIMIT": 10, "TABLE": np.array([1, 2]), "LIMITS": Limits(1, 2), "np": np}


def made(source: str = BASE, options: dict[str, Any] | None = None, **around: Any) -> Any:
    """A function compiled that calls another, with names around it."""
    names = {"__name__": __name__} | AROUND | around
    exec(source, names)
    names["g"] = compiled(names["g"], **(options or {}))
    return compiled(names["f"])


def digest(function: Any) -> str:
    return digest_of(function, lambda *_: None)


CHANGES: dict[str, Callable[[], Any]] = {
    "an operator": lambda: made(BASE.replace("x <", "x <=")),
    "a constant": lambda: made(BASE.replace("-1", "-2")),
    "another name read": lambda: made(BASE.replace("LIMITS.least", "LIMITS.most")),
    "what is called": lambda: made(BASE.replace("x * 3", "x * 4")),
    "how what is called is compiled": lambda: made(options={"error_model": "numpy"}),
    "a number around": lambda: made(LIMIT=11),
    "its type": lambda: made(LIMIT=10.0),
    "an item of a table": lambda: made(TABLE=np.array([0, 2])),
    "a table's type": lambda: made(TABLE=np.array([1, 2], np.int32)),
    "a field of a record": lambda: made(LIMITS=Limits(0, 2)),
    "a default": lambda: made(BASE.replace("g(x):", "g(x, y=2):")),
    "a constant of a function within": lambda: made(BASE.replace("x * 3", "(lambda y: y * 4)(x)")),
    "a library's function": lambda: made(BASE.replace("x * 3", "np.sqrt(x)")),
}


@pytest.mark.parametrize("change", CHANGES)
def test_another_content_is_another_digest(change: str) -> None:
    assert digest(made()) == digest(made())
    assert digest(CHANGES[change]()) != digest(made())


def test_a_function_as_an_argument_is_told_by_what_it_is() -> None:
    functions = [made(source) for source in (BASE, BASE, BASE.replace("3", "4"))]
    of = [digest_of_types((types.Dispatcher(each), types.int64), lambda *_: None) for each in functions]
    assert of[0] == of[1] != of[2]
    assert digest_of_types((types.int64,), lambda *_: None) != digest_of_types((types.int32,), lambda *_: None)


@pytest.mark.parametrize(
    "around",
    [
        {"LIMIT": {1: 2}},
        {"LIMITS": LOST(1)},
        {"LIMIT": object()},
        {"TABLE": json},
    ],
)
def test_what_is_not_known_is_refused(around: dict[str, Any]) -> None:
    with pytest.raises(Unknown):
        digest(made(**around))


def test_a_record_is_found_by_the_name_of_what_it_stands_for() -> None:
    stands = records.tuple_class(BrakeWatch)
    assert pickle.loads(pickle.dumps(stands)) is stands
    assert type(pickle.loads(pickle.dumps(packed(BrakeWatch(1, 2, False))))) is stands
    for name in ("nothing", "no:such:Record", "kernel:onboard:brake_watch:note_cycle", "kernel:onboard:brake_watch:No"):
        assert not hasattr(records, name)


# ---- within a process


def test_what_was_compiled_before_a_change_is_not_kept_as_what_it_is_after(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Numba goes on using what it has compiled, whatever has become of the constants that were in it."""
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    source = "def g(x):\n    return x + LIMIT\ndef f(x):\n    return 2 * g(x)\ndef h(x):\n    return 3 * g(x)\n"
    f = made(source, LIMIT=5)
    names = f.py_func.__globals__
    h = names["h"] = compiled(names["h"])
    assert f(1) == 12
    assert len(kept(tmp_path)) == 2
    names["LIMIT"] = 6
    assert h(1) == 18, "with g as it was"
    assert len(kept(tmp_path)) == 2, "not kept as if with g as it is"
    names["LIMIT"] = 5
    assert f(1.0) == 12.0
    assert len(kept(tmp_path)) == 2, "nor is anything of what has once changed"
    fresh = made(source, LIMIT=6)
    assert fresh(1) == 14
    assert len(kept(tmp_path)) == 4


def test_one_who_calls_what_is_not_kept_is_not_kept(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    f = made()
    f.py_func.__globals__["g"] = numba.njit(f.py_func.__globals__["g"].py_func)
    assert f(1) == made()(1) == 5
    assert len(kept(tmp_path)) == 2, "of the other two"


def test_what_nobody_has_read_for_long_is_deleted(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    folder = tmp_path / "heisoku" / "compiled"
    folder.mkdir(parents=True)

    for name, old_s in (("old", UNUSED_S + 60), ("young", UNUSED_S - 60)):
        (folder / name).write_bytes(b"")
        os.utime(folder / name, (time.time() - old_s,) * 2)
    assert made()(1) == 5
    assert "young" in kept(tmp_path)
    assert "old" not in kept(tmp_path)
