"""Malformed files by the thousand: `python -m tests.layouts.malformed --files 10000`.

Each is checked as by `heisoku check`, in a process with a limit of time and memory.  It must end with 0, 1 or 2 and
say what is wrong in one line; a traceback, a fault of the program's own (3), a hang or too much memory is a failure,
and its file is kept.
"""

from __future__ import annotations

import io
import json
import multiprocessing
import os
import random
import resource
import signal
import sys
import tempfile
import time
from collections import Counter
from collections.abc import Iterator, Sequence
from contextlib import redirect_stderr, redirect_stdout
from dataclasses import dataclass
from functools import cache
from multiprocessing.connection import Connection, wait
from pathlib import Path
from typing import Annotated, Any

import typer
from rich.console import Console
from rich.progress import track
from rich.table import Table

import heisoku
from models.exit_codes import BAD_INPUT, DOES_NOT_HOLD, HOLDS, UNDECIDED
from models.layouts import check, load
from models.layouts.generate import as_toml, network
from models.layouts.reading import format_of
from tests.layouts.mutations import Good, mutated
from tests.layouts.railml_2_made import railml_2_of
from tests.layouts.railml_made import railml_of
from tests.layouts.stations import REAL_FILES, SAMPLES, plain_station, railjson_of, table_rows

SECONDS = 20
"""A file that takes a processor longer hangs, and so does one that takes a clock so much longer."""
WAITS = 10
BYTES = 4 * 2**30
"""The address space that a process may take while it checks, beyond what it has as it begins."""
SMALL = 40_000
"""Good files of so many bytes are drawn more often than larger ones."""
SHARE = 25
"""So many files to a process before it takes the next ones."""

INTERLOCKING = """<assetsForIL>
  <tvdSection id="s1" partialRouteReleaseDelay="PT4S"><hasDemarcatingTraindetector ref="d"/>
    <hasDemarcatingTraindetector ref="f"/><hasDemarcatingTraindetector ref="g"/></tvdSection>
  <overlap id="o1"><activeForApproachRoute ref="a-d"/><hasTvdSection ref="s1"/></overlap>
  <overlap id="o2" length="150"><relatedToTrackAsset ref="f-normal"/></overlap>
  <conflictingRoute id="k"><refersToRoute ref="a-d"/><conflictsWithRoute ref="a-f"/></conflictingRoute>"""


@dataclass(frozen=True)
class Outcome:
    """What came of one file; ``code`` is the exit code, or the name of what ended its process."""

    number: int
    base: str
    mutation: str
    code: int | str
    said: str
    seconds: float

    @property
    def wrong(self) -> str | None:
        """What is wrong with it, if anything."""
        if self.code not in (HOLDS, DOES_NOT_HOLD, BAD_INPUT):
            return f"ended with {self.code}"
        if "Traceback" in self.said:
            return "a traceback"
        if self.code == BAD_INPUT and len(self.said.splitlines()) != 1:
            return f"{len(self.said.splitlines())} lines of complaint"
        return None


@cache
def good_files(of_others: bool = True) -> tuple[Good, ...]:
    """The layouts of the repository and of tests, and those of other makers where they are."""
    made = {
        "plain.json": json.dumps(railjson_of(plain_station())),
        "later.json": json.dumps(railjson_of(plain_station(), later=True), indent=1),
        "plain.railml": railml_of(railjson_of(plain_station())),
        "derived.railml": railml_of(railjson_of(plain_station()), "3.3", routes=False),
        "older.railml": railml_2_of(railjson_of(plain_station())),
        "interlocking.railml": railml_of(railjson_of(plain_station())).replace("<assetsForIL>", INTERLOCKING),
        "table.yml": "---\n" + json.dumps({"interlocking-table": table_rows()}, indent=1),
        "generated.toml": as_toml(network(20)),
    }
    files = [*SAMPLES, *(REAL_FILES if of_others else ())]
    texts = {**made, **{path.name: path.read_text("utf-8") for path in files}}
    return tuple(Good(name, format_of(name, text), text) for name, text in sorted(texts.items()))


def bad_file(goods: Sequence[Good], seed: int, number: int) -> tuple[str, str, bytes]:
    """One malformed file: the good one, what was done, the bytes; small good ones are drawn more often."""
    chance = random.Random(f"{seed} {number}")
    weights = [1 if len(good.text) > SMALL else 4 for good in goods]
    (good,) = chance.choices(goods, weights)
    done, content = mutated(good, goods, chance)
    return good.name, done, content


HANGS = (signal.SIGALRM, signal.SIGPROF)


def outcomes(goods: Sequence[Good], seed: int, numbers: Sequence[int], jobs: int) -> Iterator[Outcome]:
    """Check malformed files in processes of their own; one that is ended costs the file it was at."""
    check(load(SAMPLES[0]))  # so that every process has the axioms compiled
    context = multiprocessing.get_context("fork")
    todo = [list(numbers[at : at + SHARE]) for at in range(0, len(numbers), SHARE)]
    running: dict[Connection, tuple[Any, list[int]]] = {}
    try:
        while todo or running:
            while todo and len(running) < jobs:
                share = todo.pop(0)
                ours, theirs = context.Pipe(duplex=False)
                process = context.Process(target=_work, args=(goods, seed, share, theirs), daemon=True)
                process.start()
                theirs.close()
                running[ours] = process, share
            for ready in wait(list(running)):
                assert isinstance(ready, Connection)
                process, share = running[ready]
                try:
                    found: Outcome = ready.recv()
                except EOFError:
                    del running[ready]
                    process.join()
                    if share:
                        yield _ended(goods, seed, share.pop(0), process.exitcode or 0)
                        todo += [share] if share else []
                else:
                    assert share.pop(0) == found.number
                    yield found
    finally:
        for process, _ in running.values():
            process.kill()


def _ended(goods: Sequence[Good], seed: int, number: int, exit_code: int) -> Outcome:
    """What a process tells by having been ended."""
    base, done, _ = bad_file(goods, seed, number)
    by = signal.Signals(-exit_code).name if exit_code < 0 else f"exit {exit_code}"
    return Outcome(number, base, done, "a hang" if -exit_code in HANGS else by, "", SECONDS)


def _mapped_bytes() -> int:
    """The address space of this process: after a fork, all that its parent has mapped, whatever that is."""
    pages = Path("/proc/self/statm").read_text("ascii").split()[0]
    return int(pages) * resource.getpagesize()


def _work(goods: Sequence[Good], seed: int, numbers: Sequence[int], results: Connection) -> None:
    """Check one file after the other, until one of them ends the process."""
    most = _mapped_bytes() + BYTES
    resource.setrlimit(resource.RLIMIT_AS, (most, most))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    for each in HANGS:
        signal.signal(each, signal.SIG_DFL)
    with tempfile.TemporaryDirectory() as folder:
        for number in numbers:
            base, done, content = bad_file(goods, seed, number)
            file = Path(folder) / f"file{Path(base).suffix}"
            file.write_bytes(content)
            signal.setitimer(signal.ITIMER_PROF, SECONDS)
            signal.alarm(SECONDS * WAITS)
            begin = time.process_time()
            code, said = checked(file)
            signal.setitimer(signal.ITIMER_PROF, 0)
            signal.alarm(0)
            results.send(Outcome(number, base, done, code, said, time.process_time() - begin))
    results.close()


def checked(file: Path) -> tuple[int, str]:
    """The exit code of `heisoku check` and what it says on standard error."""
    said = io.StringIO()
    with redirect_stdout(io.StringIO()), redirect_stderr(said):
        code = heisoku.run(["check", str(file)])
    return code, said.getvalue()


def main(
    files: Annotated[int, typer.Option(metavar="N", min=1, help="Malformed files to check.")] = 10_000,
    seed: Annotated[int, typer.Option(metavar="N", min=0, help="What they are drawn from.")] = 1,
    first: Annotated[int, typer.Option(metavar="N", min=0, help="Number of the first.")] = 0,
    jobs: Annotated[int, typer.Option(metavar="N", min=1, help="Processes to use.")] = os.cpu_count() or 1,
    keep: Annotated[Path, typer.Option(metavar="DIR", help="Keep what fails there.")] = Path("out/malformed"),
) -> None:
    """Check malformed files, count exit codes and mutations, and keep every file that is not refused as it should."""
    goods, out = good_files(), Console(width=None if sys.stdout.isatty() else 120)
    found: list[Outcome] = []
    numbers = range(first, first + files)
    running = outcomes(goods, seed, numbers, jobs)
    for each in track(running, total=files, console=Console(stderr=True), disable=not sys.stderr.isatty()):
        found.append(each)
        if each.wrong:
            keep.mkdir(parents=True, exist_ok=True)
            kept = keep / f"{seed}-{each.number}-{each.base}"
            kept.write_bytes(bad_file(goods, seed, each.number)[2])
            out.print(f"{kept}: {each.mutation}: {each.wrong}: {each.said.strip()[:300]}", markup=False)
    _tell(out, found)
    wrong = sum(each.wrong is not None for each in found)
    slowest = max(found, key=lambda each: each.seconds)
    out.print(f"{len(goods)} good files; slowest: number {slowest.number}, {slowest.seconds:.1f} s", highlight=False)
    out.print(f"{len(found):,} malformed files with seed {seed}, {wrong} wrong", highlight=False)
    raise typer.Exit(DOES_NOT_HOLD if wrong else HOLDS if len(found) == files else UNDECIDED)


def _tell(out: Console, found: Sequence[Outcome]) -> None:
    codes = sorted({str(each.code) for each in found})
    table = Table("mutation", *(f"exit {code}" for code in codes), title="What came of malformed files")
    counted = Counter((each.mutation, str(each.code)) for each in found)
    for mutation in sorted({each.mutation for each in found}):
        table.add_row(mutation, *(f"{counted[mutation, code]:,}" for code in codes))
    table.add_section()
    table.add_row("all", *(f"{sum(counted[m, c] for m, c in counted if c == code):,}" for code in codes))
    out.print(table)


if __name__ == "__main__":
    command = typer.Typer(add_completion=False, pretty_exceptions_enable=False)
    command.command()(main)
    command()
