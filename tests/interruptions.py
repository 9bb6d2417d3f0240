"""Disturbs commands at random moments: ``python -m tests.interruptions --runs 500``; ``make interruptions``.

A command is interrupted, ended, or its pipe closed, its disk full.  It may then end as undecided, or with the verdict
that it gives undisturbed; never with another, never with a traceback, and never with a file that is half written.
"""

from __future__ import annotations

import argparse
import json
import os
import random
import resource
import shutil
import signal
import sqlite3
import subprocess
import sys
import tempfile
import time
from collections import Counter
from collections.abc import Callable, Iterator
from contextlib import closing
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

from lxml import etree

from fuzz.failures.trace import text_of
from models.exit_codes import UNDECIDED
from tests.fuzz.failures.samples import LAYOUTS, failing

ROOT = Path(__file__).resolve().parent.parent
PROGRAM = (sys.executable, str(ROOT / "heisoku_start.py"))
STATION = "layouts/passing_station.toml"
ENDS_AFTER_S = 120.0
"""A command that is interrupted or ended does end, and all its processes do, in this time; else it is a finding."""
TELLS_EVERY_S = 10.0
BEGUN_AFTER_S = 0.2
"""Before that Python itself begins, which tells of an interruption as it likes; it ends by the signal then."""
HEEDED_WITHIN_S = 10.0
"""A command that hears an interruption gives no verdict that it reaches later than this."""
GOES_ON = 4
"""A command that goes on has so many times as long as it takes undisturbed: others may use the machine by then."""

ENDED = (-signal.SIGINT, -signal.SIGTERM)
"""How a command ends that such a signal has ended."""

COMMANDS: tuple[tuple[str, ...], ...] = (
    ("check", STATION, "layouts/terminus.toml", "--json", "{out}/check.json"),
    ("check", STATION, "--clearance", "400 m", "--json", "{out}/check.json"),
    ("draw", STATION, "-o", "{out}/station.svg"),
    ("export", STATION, "-o", "{out}/station"),
    (
        *("prove", "--only", r"^brake_watch\.", "--solver", "both", "--jobs", "2"),
        *("--json", "{out}/prove.json", "--junit", "{out}/prove.xml"),
    ),
    ("prove", "--only", r"^display\.", "--jobs", "1", "--json", "{out}/prove.json"),
    (
        *("prove", "--only", r"^(display|brake_watch)\.", "--jobs", "2"),
        *("--kept", "{out}/proofs.sqlite", "--json", "{out}/prove.json"),
    ),
    ("certify", "--only", r"^brake_watch\.init ", "--jobs", "1", "--json", "{out}/certificates.json"),
    ("mutate", "--only", r"^kernel\.onboard\.split\.is_intact", "--jobs", "2", "--json", "{out}/mutate.json"),
    ("ride", "--rides", "2", "--jobs", "2", "--json", "{out}/ride.json"),
    ("days", "tram", "--days", "1", "--jobs", "1", "--json", "{out}/days.json", "--keep", "{out}/tram.days"),
    ("reproduce", "000", "--runs", "1", "-o", "{out}/000", "--json", "{out}/000.json"),
    ("simulate", STATION, "--json", "{out}/simulate.json"),
    ("fuzz", "--target", "link", "--batches", "1", "--out", "{out}/fuzz", "--json", "{out}/fuzz.json"),
    ("handset", "-o", "{out}/handset.html", "--minutes", "1"),
    ("manifest", "{out}/records"),
    ("verify", "{out}/records"),
    ("report", "--records", "{out}/empty", "-o", "{out}/report.html"),
    ("replay", "{out}/records/trace.json", "--html", "{out}/trace.html", "--json", "{out}/replay.json"),
    ("prove", "--only", "["),
)


@dataclass(frozen=True)
class Ended:
    """How a command ended: its code, what it printed last, how long it took."""

    code: int
    says: str
    seconds: float


@dataclass(frozen=True)
class Disturbance:
    """What is done to a command: by its name, to the process, or to what it is begun with."""

    name: str
    to_process: Callable[[subprocess.Popen[bytes]], None] | None = None
    limit: int | None = None
    full: bool = False


def interrupted(process: subprocess.Popen[bytes]) -> None:
    """As a terminal does it: whoever is in front hears it."""
    os.killpg(process.pid, signal.SIGINT)


def ended(process: subprocess.Popen[bytes]) -> None:
    """As whoever shuts a machine down."""
    process.terminate()


def closed(process: subprocess.Popen[bytes]) -> None:
    """As ``| head`` does it."""
    assert process.stdout is not None
    process.stdout.close()


def disturbances(rng: random.Random) -> list[Disturbance]:
    """All kinds; how much of a file may be written is drawn."""
    return [
        Disturbance("SIGINT", interrupted),
        Disturbance("SIGTERM", ended),
        Disturbance("closed pipe", closed),
        Disturbance("failing write", limit=rng.randrange(0, 4_000)),
        Disturbance("full disk", full=True),
    ]


def begun(words: tuple[str, ...], out: Path, how: Disturbance) -> subprocess.Popen[bytes]:
    """Begin a command in a group of its own; it hears interruptions though a shell runs this in the background."""
    if signal.getsignal(signal.SIGINT) == signal.SIG_IGN:
        signal.signal(signal.SIGINT, signal.default_int_handler)
    full = Path("/dev/full").open("wb") if how.full else None  # noqa: SIM115
    try:
        process = subprocess.Popen(
            [*PROGRAM, *(word.replace("{out}", str(out)) for word in words)],
            cwd=ROOT,
            stdin=subprocess.DEVNULL,
            stdout=full or subprocess.PIPE,
            stderr=subprocess.PIPE,
            start_new_session=True,
        )
    finally:
        if full:
            full.close()
    if how.limit is not None:
        resource.prlimit(process.pid, resource.RLIMIT_FSIZE, (how.limit, how.limit))
    return process


def folder() -> Path:
    """A folder to write into, with records to bind and a trace to replay."""
    out = Path(tempfile.mkdtemp(prefix="interrupted"))
    (out / "records").mkdir()
    (out / "empty").mkdir()
    trace = failing()
    (out / "records" / "trace.json").write_text(text_of(trace), "utf-8")
    shutil.copy(LAYOUTS["passing_station"], out / "records" / trace.layout.file)
    for name in ("prove.json", "check.json"):
        (out / "records" / name).write_text("{}", "utf-8")
    return out


@cache
def undisturbed(words: tuple[str, ...]) -> Ended:
    """How a command ends where nothing happens."""
    out, began = folder(), time.monotonic()
    process = begun(words, out, Disturbance("nothing"))
    told, _ = process.communicate(timeout=600)
    shutil.rmtree(out)
    return Ended(process.returncode, told.decode("utf-8", "replace"), time.monotonic() - began)


def wrong(words: tuple[str, ...], how: Disturbance, moment: float) -> tuple[int, list[str]]:
    """Disturb a command once: its exit code, and everything that is not as it should be."""
    usual, out = undisturbed(words), folder()
    process, told, complaints = begun(words, out, how), b"", b""
    disturbed_at = None
    try:
        process.wait(BEGUN_AFTER_S + moment * usual.seconds)
    except subprocess.TimeoutExpired:
        if how.to_process is not None:
            how.to_process(process)
            disturbed_at = time.monotonic()
    try:
        if process.stdout is not None and process.stdout.closed:
            process.stdout = None
        goes_on = how.to_process not in (interrupted, ended)
        told, complaints = process.communicate(timeout=ENDS_AFTER_S + goes_on * GOES_ON * usual.seconds)
    except subprocess.TimeoutExpired:
        os.killpg(process.pid, signal.SIGKILL)
        process.communicate()
        return process.returncode, ["it did not end"]
    found = list(_judged(process.returncode, (told or b"") + complaints, usual.code))
    if how.to_process in (interrupted, ended) and disturbed_at is not None:
        found += unheeded(process.returncode, time.monotonic() - disturbed_at)
    found += _left_running(process.pid)
    found += _damaged(out)
    shutil.rmtree(out)
    return process.returncode, found


def _judged(code: int, said: bytes, usual: int) -> Iterator[str]:
    if code >= 0 and code not in (usual, UNDECIDED):
        yield f"exit {code}, undisturbed {usual}"
    if code < 0 and code not in ENDED:
        yield f"ended by signal {-code}"
    if b"Traceback" in said or b"Exception ignored" in said:
        yield said.decode("utf-8", "replace")[-600:]


def unheeded(code: int, seconds: float) -> list[str]:
    """A verdict long after it should have ended."""
    heeded = code in (UNDECIDED, *ENDED) or seconds <= HEEDED_WITHIN_S
    return [] if heeded else [f"went on for {seconds:.0f} s, to exit {code}"]


def _left_running(group: int) -> list[str]:
    """Its processes have ended, or do at once."""
    until = time.monotonic() + ENDS_AFTER_S / 4
    while time.monotonic() < until:
        try:
            os.killpg(group, 0)
        except ProcessLookupError:
            return []
        time.sleep(0.1)
    os.killpg(group, signal.SIGKILL)
    return ["a process of it ran on"]


def _damaged(out: Path) -> Iterator[str]:
    """Whatever stands there under the name of a record is whole; what is written beside its place is none yet."""
    for path in (path for path in out.rglob("*") if path.is_file() and not path.name.startswith(".")):
        try:
            if path.suffix == ".json":
                json.loads(path.read_bytes())
            elif path.suffix == ".sqlite":
                with closing(sqlite3.connect(path)) as kept:
                    yield from (line for (line,) in kept.execute("PRAGMA integrity_check") if line != "ok")
            elif path.suffix in (".xml", ".svg"):
                etree.fromstring(path.read_bytes())
            elif path.suffix == ".html" and not path.read_bytes().rstrip().endswith(b"</html>"):
                yield f"{path.name}: is cut off"
        except (ValueError, sqlite3.Error, etree.XMLSyntaxError) as error:
            yield f"{path.name}: {error}"


def drawn(seed: int, runs: int, kind: str | None = None) -> Iterator[tuple[tuple[str, ...], Disturbance, float]]:
    """Commands, each with a disturbance, of one kind alone if it is named, and when it comes, by its usual time."""
    rng = random.Random(seed)
    for number in range(runs):
        offered = [each for each in disturbances(rng) if kind in (None, each.name)]
        yield COMMANDS[number % len(COMMANDS)], rng.choice(offered), rng.random()


def main(arguments: list[str] | None = None) -> int:
    """Disturb as often as asked; 1 if anything is wrong."""
    parser = argparse.ArgumentParser(prog="python -m tests.interruptions", description=__doc__)
    parser.add_argument("--runs", type=int, default=500)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--kind", choices=[each.name for each in disturbances(random.Random(0))])
    given = parser.parse_args(arguments)
    came: Counter[Any] = Counter()
    bad, told = 0, time.monotonic()
    for words, how, moment in drawn(given.seed, given.runs, given.kind):
        if time.monotonic() - told > TELLS_EVERY_S:
            told = time.monotonic()
            print(f"{came.total()} of {given.runs} disturbed", file=sys.stderr, flush=True)
        code, found = wrong(words, how, moment)
        came[how.name, code] += 1
        bad += bool(found)
        for line in found:
            print(f"{' '.join(words)}: {how.name} at {moment:.0%}: {line}", flush=True)
    for (name, code), count in sorted(came.items()):
        print(f"{name}: exit {code}: {count}")
    print(f"{came.total()} disturbances of {len(COMMANDS)} commands with seed {given.seed}, {bad} wrong")
    return 1 if bad else 0


if __name__ == "__main__":
    raise SystemExit(main())
