"""How long a proof takes with answers kept: with nothing changed, and after changes of one line of the kernel each.

``python -m tests.bench_kept_proofs [--changes 30] [--seed 1] [--solver z3] [--jobs 2] [--made-up]``; ``make kept``.

Everything is proved first, which takes minutes.  ``--made-up`` writes answers that nobody gave instead, to texts that
nobody laid out: what a change touches is laid out and asked as ever, and finds no answer even where its text is as it
was, so that the changes take no less time than with true ones.

The changes are drawn from those that were written down for ``proofs.planted``: as a careless or a malicious maintainer
makes them, so that most of them refute something, which takes a solver longer than to prove it.  Each is made alone in
a copy of the sources, and proved with a copy of what was kept before any of them.
"""

from __future__ import annotations

import argparse
import json
import os
import random
import resource
import shutil
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from models.commands import EVERY_CORE
from proofs.planted.changes import Change, changes

ROOT = Path(__file__).resolve().parent.parent
COPIED = (
    "kernel",
    "models",
    "proofs",
    "fuzz",
    "evidence",
    "layouts",
    "docs",
    "heisoku.py",
    "heisoku_public.py",
    "heisoku_start.py",
)
MADE_UP = """
import sys
from dataclasses import asdict
from pathlib import Path
from proofs import contents, kept, run

store, solvers = kept.opened(Path(sys.argv[1])), sys.argv[2].split()
keys = {cell: contents.key_of(*cell) for cell in run.chosen(None)}
store.keep([kept.Entry(f"keys {contents.whole()}", {" ".join(cell): key for cell, key in keys.items()})])
answer = {"verdict": "proved", "rlimit_spent": 1, "seconds": 0.0, "kept": "made up"}
store.keep(kept.Entry(f"text {key}", asdict(kept.Laid(key, [], False))) for key in keys.values())
store.keep(kept.Entry(kept.answer_key(key, solver, 0), answer) for key in keys.values() for solver in solvers)
"""
"""Fills a file with answers that are none."""
SETTLED_S = 2.5
"""A source is older than this when it is proved, as one is that somebody has saved and looked at."""


@dataclass(frozen=True)
class Proved:
    """How one proof went: wall time, processor time of all its processes, answers, and those that were kept."""

    seconds: float
    processor_s: float
    code: int
    answers: int
    kept: int
    open: int

    def line(self) -> str:
        """In words."""
        return (
            f"{self.seconds:6.1f} s, {self.processor_s:6.1f} s of processors, exit {self.code}, "
            f"{self.answers:,} answers, {self.kept:,} kept, {self.open:,} not proved"
        )


def copied(to: Path) -> Path:
    """A copy of the sources."""
    for name in COPIED:
        if (ROOT / name).is_dir():
            shutil.copytree(ROOT / name, to / name, ignore=shutil.ignore_patterns("__pycache__"))
        else:
            shutil.copy(ROOT / name, to / name)
    return to


def around() -> dict[str, str]:
    """Bytecode is kept as Python keeps it by itself."""
    return {name: value for name, value in os.environ.items() if not name.startswith("PYTHON")}


def made_up(tree: Path, kept: Path, solver: str) -> None:
    """Fill a file with answers that are none."""
    solvers = "z3 cvc5" if solver == "both" else solver
    subprocess.run([sys.executable, "-c", MADE_UP, str(kept), solvers], cwd=tree, env=around(), check=True)


def proved(tree: Path, kept: Path, solver: str, jobs: int) -> Proved:
    """Prove in a copy, with what is kept there."""
    record = tree / "prove.json"
    given = ["prove", "--solver", solver, "--jobs", str(jobs), "--kept", str(kept), "--json", str(record)]
    words = [sys.executable, "heisoku_start.py", *given]
    before, began = resource.getrusage(resource.RUSAGE_CHILDREN), time.monotonic()
    ended = subprocess.run(words, cwd=tree, env=around(), capture_output=True, text=True, check=False)
    seconds, after = time.monotonic() - began, resource.getrusage(resource.RUSAGE_CHILDREN)
    if not record.is_file():
        raise SystemExit(f"nothing was proved: {ended.stderr[-500:]}")
    told = json.loads(record.read_text("utf-8"))["obligations"]
    record.unlink()
    return Proved(
        seconds,
        after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime,
        ended.returncode,
        len(told),
        sum("kept" in each for each in told),
        sum(each["verdict"] != "proved" for each in told),
    )


def with_change(tree: Path, change: Change, kept: Path, solver: str, jobs: int) -> Proved:
    """Make a change, prove, and take it back."""
    path, apart = tree / change.file, kept.with_name("changed.sqlite")
    source, written = path.read_text("utf-8"), path.stat()
    shutil.copy(kept, apart)
    path.write_text(source.replace(change.old, change.new), "utf-8")
    time.sleep(SETTLED_S)
    try:
        return proved(tree, apart, solver, jobs)
    finally:
        path.write_text(source, "utf-8")
        os.utime(path, ns=(written.st_atime_ns, written.st_mtime_ns))
        for each in kept.parent.glob("changed.sqlite*"):
            each.unlink()


def of_one_line() -> list[Change]:
    """The changes of one line of the kernel that are written down."""
    return [each for each in changes().values() if each.file.startswith("kernel/") and "\n" not in each.old + each.new]


def main(arguments: Sequence[str] | None = None) -> int:
    """Measure and print."""
    parser = argparse.ArgumentParser(prog="python -m tests.bench_kept_proofs", description=__doc__)
    parser.add_argument("--changes", type=int, default=30)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--solver", default="z3", choices=("z3", "cvc5", "both"))
    parser.add_argument("--jobs", type=int, default=EVERY_CORE)
    parser.add_argument(
        "--made-up", action="store_true", help="write answers that nobody gave, instead of proving first"
    )
    given = parser.parse_args(arguments)
    how = (given.solver, given.jobs)
    with tempfile.TemporaryDirectory(prefix="kept") as place:
        tree, kept = copied(Path(place) / "tree"), Path(place) / "proofs.sqlite"
        time.sleep(SETTLED_S)
        if given.made_up:
            made_up(tree, kept, given.solver)
        print(f"first:            {proved(tree, kept, *how).line()}", flush=True)
        print(f"nothing changed:  {proved(tree, kept, *how).line()}", flush=True)
        took = []
        pool = of_one_line()
        for change in random.Random(given.seed).sample(pool, given.changes):
            took.append(with_change(tree, change, kept, *how))
            print(f"{took[-1].line()}: {change.name}, {change.file}", flush=True)
    seconds, processor_s = [each.seconds for each in took], [each.processor_s for each in took]
    print(f"{len(took)} changes of one line, of {len(pool)}, seed {given.seed}")
    print(f"median {statistics.median(seconds):.1f} s, {statistics.median(processor_s):.1f} s of processors")
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
