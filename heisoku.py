"""The command line: prove the kernel, check layouts against the proof's assumptions, draw them.

``from heisoku import load, check, prove, simulate`` is for other programs (:mod:`heisoku_public`).

Exit codes, everywhere: 0 holds, 1 does not hold, 2 bad input or usage, 3 undecided.
Findings go to standard output; progress and complaints to standard error.
"""

from __future__ import annotations

if __name__ == "__main__":
    from heisoku_start import main as start

    start()

from heisoku_start import stranger

if (whose := stranger()) is not None:
    raise ImportError(whose)

import os
import sys
import traceback
from collections.abc import Sequence
from enum import StrEnum
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer
from rich.console import Console

from evidence.manifest.command import manifest, verify
from evidence.report.command import report
from fuzz.campaign.command import fuzz
from fuzz.simulation.command import simulate as simulate_command
from heisoku_public import BadInput, check, load, prove, simulate
from models.commands import (
    EVERY_CORE,
    Jobs,
    Json,
    Seed,
    Version,
    bad_input_refused,
    complain,
    console,
    metres,
    print_line,
    progress,
    record_alone,
    refuse,
    writable,
)
from models.exit_codes import BAD_INPUT, DOES_NOT_HOLD, HOLDS, UNDECIDED, WORDS
from models.layouts.export.command import export
from models.layouts.measures import CLEARANCE_MM
from models.streams import outlet, write_whole
from proofs.certificates.command import certify
from proofs.command import prove as prove_command
from proofs.mutants.command import mutate
from proofs.records import about, write_json

if TYPE_CHECKING:
    from models.layouts import CheckResult, Imported

__all__ = ["BadInput", "app", "check", "load", "main", "prove", "run", "simulate"]

INTERRUPTED = 130

app = typer.Typer(
    add_completion=False,
    rich_markup_mode="markdown",
    help="A railway safety kernel without track circuits, proved once for every layout.\n\n"
    "Exit codes: 0 holds, 1 does not hold, 2 bad input or usage, 3 undecided.",
)


class Paper(StrEnum):
    """Which paper's figures to reproduce."""

    IC_TAGS = "000"
    INERTIAL_SENSORS = "001"
    TRAMS = "002"
    CROSSINGS = "003"
    TRACK_WORKERS = "004"


class Day(StrEnum):
    """Whose days to simulate."""

    CROSSING = "crossing"
    TRAM = "tram"
    ALARM = "alarm"


Layouts = Annotated[list[Path], typer.Argument(metavar="LAYOUT", help="Layout files.", show_default=False)]
Layout = Annotated[Path, typer.Argument(metavar="LAYOUT", help="A layout file.", show_default=False)]


@app.callback()
def options(version: Version = False) -> None:
    """Take what is said before a command."""
    record_alone(None)


app.command()(prove_command)


@app.command("check")
def check_command(
    layouts: Layouts,
    json: Json = None,
    clearance: Annotated[
        str, typer.Option(metavar="M", help="A boundary nearer to a point is foul, where the file does not say.")
    ] = f"{CLEARANCE_MM // 1_000} m",
    strict: Annotated[bool, typer.Option("--strict", help="Nothing may rest on what the file does not say.")] = False,
) -> None:
    """Check layouts against what the proof assumes of them; report every violation, not only the first.

    Each verdict is told with what it rests on beside the axioms; --strict makes a violation of what nobody declared.

    Examples:

    * `heisoku check layouts/passing_station.toml`
    * `heisoku check layouts/passing_station.toml --strict --clearance "30 m"`
    * `heisoku check layouts/*.toml --json out/check.json`
    """
    from models.layouts import BadInput, as_json, load
    from models.layouts import check as check_layout

    writable(json, given=layouts)
    clearance_mm = metres("--clearance", clearance)
    found: list[tuple[Imported, CheckResult] | BadInput] = []
    with progress("checking") as step:
        for done, path in enumerate(layouts):
            step(done, len(layouts), path.name)
            try:
                imported = load(path)
            except BadInput as bad:
                found.append(bad)
            else:
                found.append((imported, check_layout(imported, clearance_mm=clearance_mm, strict=strict)))

    out, worst, checked = console(), HOLDS, 0
    entries: list[dict[str, object]] = []
    for path, one in zip(layouts, found, strict=True):
        if isinstance(one, BadInput):
            complain(str(one))
            entries.append({"file": str(path), "verdict": "bad input", "text": str(one)})
            worst = BAD_INPUT
            continue
        entries.append({"file": str(path), **as_json(*one)})
        checked += sum(one[1].checked.values())
        worst = max(worst, one[1].exit_code)
        print_check(out, path, one[1])
    unread = sum(isinstance(one, BadInput) for one in found)
    aside = f", {unread} not read" if unread else ""
    rests = sum(one[1].defaults for one in found if not isinstance(one, BadInput))
    resting = f", resting on {rests:,} defaults" if rests and worst == HOLDS else ""
    print_line(
        out, f"{len(found) - unread} layouts, {checked} instances of axioms checked{aside}: {WORDS[worst]}{resting}"
    )
    if json:
        record = {"verdict": WORDS[worst], "layouts": entries, **about()}
        write_json(json, record)
    raise typer.Exit(worst)


@app.command()
def draw(
    layout: Layout,
    output: Annotated[Path, typer.Option("--output", "-o", metavar="F.svg", help="The drawing.", show_default=False)],
    route: Annotated[str | None, typer.Option(metavar="R", help="Highlight it.", show_default="the longest")] = None,
) -> None:
    """Draw the track diagram of a layout: blocks, points, tags, and one route highlighted.

    Without --route it is the longest: the one that claims most blocks.

    Examples:

    * `heisoku draw layouts/passing_station.toml -o out/station.svg`
    * `heisoku draw layouts/passing_station.toml -o out/station.svg --route "W to 1"`
    """
    from models.layouts import draw as draw_layout
    from models.layouts import load

    writable(output, given=(layout,))
    with bad_input_refused():
        imported = load(layout)
        shown = imported.longest_route if route is None else route
        picture = draw_layout(imported, shown)
    write_whole(output, picture.encode())
    drawn = imported.layout
    counts = f"{len(drawn.blocks)} blocks, {len(drawn.points)} points, {len(drawn.tag_in)} tags drawn"
    which = "no route" if shown is None else f"{'route' if route is not None else 'longest route'} '{shown}'"
    print_line(console(), f"{output}: {counts}, {which} highlighted")


@app.command()
def reproduce(
    paper: Annotated[Paper, typer.Argument(help="The paper's number.", show_default=False)],
    json: Json = None,
    output: Annotated[
        Path | None,
        typer.Option("--output", "-o", metavar="DIR", help="Put pictures and tables there.", show_default=False),
    ] = None,
    seed: Seed = 1,
    runs: Annotated[
        int | None,
        typer.Option(
            metavar="N", min=1, max=10_000, help="Trains to run (001), passes at each speed (000).", show_default=False
        ),
    ] = None,
) -> None:
    """Set a paper's figures beside ours: sensor models, run through the kernel.

    It holds where every figure that can be compared agrees by the criterion printed beside it.

    Examples:

    * `heisoku reproduce 000 -o out/000`
    * `heisoku reproduce 001 --runs 2 --json out/001.json`
    """
    from models.reproduce import PAPERS
    from models.reproduce.pictures import png
    from models.reproduce.tables import show, table_as_text

    if output is not None and output.exists() and not output.is_dir():
        refuse(f"{output}: is not a folder; name another")
    if json and output and json.suffix == ".png" and json.resolve().parent == output.resolve():
        refuse(f"{json}: there the pictures go; name another file")
    writable(json, output / f"{paper.value}_tables.txt" if output else None)
    described = PAPERS[paper.value]
    runs = runs or described.runs
    with progress(f"paper {paper.value}") as step:
        found = described.reproduce(seed, runs, step)
    out = console()
    show(out, found)
    if output:
        write_whole(output / f"{paper.value}_tables.txt", table_as_text(found).encode())
        for picture in found.pictures:
            write_whole(output / f"{picture.name}.png", png(picture))
        print_line(out, f"{output}: {len(found.pictures)} pictures and the tables")
    if json:
        write_json(json, {**found.record(), "runs": runs, **about()})
    counts = ", ".join(f"{count:,} {what}" for what, count in found.counts.items())
    print_line(out, f"{counts}: {found.verdict}")
    raise typer.Exit(HOLDS if found.verdict == WORDS[HOLDS] else DOES_NOT_HOLD)


@app.command()
def ride(
    rides: Annotated[int, typer.Option(metavar="N", min=1, help="Trains to run over 10 km each.")] = 1_024,
    seed: Seed = 1,
    jobs: Jobs = EVERY_CORE,
    beyond: Annotated[
        list[str] | None,
        typer.Option(
            metavar="FAULT",
            help="A fault to draw from beyond its declared range, in a campaign of its own; `each` for one after"
            " the other.",
            show_default=False,
        ),
    ] = None,
    json: Json = None,
) -> None:
    """Run trains with faulty sensors through the machines on board, and hold what they claim against the truth.

    Within the declared ranges nothing claimed may be false.  Beyond one of them something may be, and then an
    assumption of the proofs must have been broken in that ride.

    Examples:

    * `heisoku ride --rides 64 --json out/ride.json`
    * `heisoku ride --rides 8 --beyond diameter_ppm`
    """
    from models.rides.campaign import ride_all
    from models.rides.report import print_beyond, print_outcome, record
    from models.rides.tally import outcome
    from models.sensors.faults import names

    writable(json)
    asked = list(names()) if beyond == ["each"] else list(beyond or ())
    unknown = [name for name in asked if name not in names()]
    if unknown:
        refuse(f"--beyond {unknown[0]}: there is no such fault; one of {', '.join(names())}, or each")
    out = console()
    with progress("rides") as step:
        rows = ride_all(seed, rides, jobs, asked or [""], step)
    found = {fault: outcome(each) for fault, each in rows.items()}
    if asked:
        print_beyond(out, found)
    else:
        print_outcome(out, found[""])
    if json:
        write_json(json, {**record(seed, found), **about()})
    holds = all(one.holds(bool(fault)) for fault, one in found.items())
    ridden = sum(one.rides for one in found.values())
    print_line(out, f"{ridden:,} rides with seed {seed}: {WORDS[HOLDS if holds else DOES_NOT_HOLD]}")
    raise typer.Exit(HOLDS if holds else DOES_NOT_HOLD)


@app.command()
def days(
    system: Annotated[Day, typer.Argument(help="Whose days.", show_default=False)],
    days: Annotated[int, typer.Option(metavar="N", min=1, help="Days to simulate.")] = 200,
    seed: Seed = 1,
    jobs: Jobs = EVERY_CORE,
    beyond: Annotated[
        list[str] | None,
        typer.Option(
            metavar="FAULT",
            help="A fault beyond what is assumed, on each of these days once more; `each` for one after the other.",
            show_default=False,
        ),
    ] = None,
    json: Json = None,
    keep: Annotated[
        Path | None, typer.Option(metavar="F", help="Keep days there, and go on from it.", show_default=False)
    ] = None,
) -> None:
    """Simulate whole days of a system with faults, and hold what its machines decide against the truth.

    No claim may be broken on any day.  What the safe side costs is told: needless warnings, alarms, holds.  Beyond
    what is assumed a claim may be broken, and then an assumption must have been, and what noticed it is told.

    Examples:

    * `heisoku days crossing --days 20`
    * `heisoku days alarm --days 2 --beyond gps_creeps`
    """
    from models.days.campaign import live_all, noticed, outcome
    from models.days.kept import KeptDays
    from models.days.report import print_beyond, print_outcome, record
    from models.days.systems import system_of

    writable(json, keep)
    out, whose = console(), system_of(system.value)
    asked = list(whose.beyond) if beyond == ["each"] else list(beyond or ())
    unknown = [name for name in asked if name not in whose.beyond]
    if unknown:
        refuse(f"--beyond {unknown[0]}: there is no such fault; one of {', '.join(whose.beyond) or 'none'}, or each")
    with bad_input_refused(), progress("days") as step:
        kept = KeptDays(keep, whose, seed) if keep else None
        rows = live_all(whose.name, seed, days, jobs, step, kept)
        with_each = {name: live_all(whose.name, seed, days, jobs, step, beyond=(name,)) for name in asked}
    found, came = outcome(whose, rows), {name: noticed(whose, rows, each) for name, each in with_each.items()}
    print_outcome(out, found)
    if asked:
        print_beyond(out, whose, came)
    if json:
        write_json(json, {**record(seed, found, came), **about()})
    holds = found.holds and all(one.unexplained == 0 for one in came.values())
    verdict = HOLDS if holds else DOES_NOT_HOLD
    if kept is not None and (before := kept.before(days)):
        print_line(out, f"{before:,} of them were not simulated now: an earlier run kept them in {keep}")
    print_line(out, f"{found.days:,} days of {system.value} with seed {seed}: {WORDS[verdict]}")
    raise typer.Exit(verdict)


@app.command()
def handset(
    output: Annotated[Path, typer.Option("--output", "-o", metavar="F.html", help="The page.", show_default=False)],
    day: Annotated[int, typer.Option(metavar="N", min=0, help="Of which day.")] = 0,
    minutes: Annotated[int, typer.Option(metavar="N", min=1, max=240, help="So many minutes of it.")] = 60,
    seed: Seed = 1,
) -> None:
    """Write a track worker's handset as one page, fed by a simulated day: tones, trains, both views.

    Examples:
    * `heisoku handset -o out/handset.html --minutes 10`
    """
    from models.alarm.page.writing import write

    writable(output)
    write(output, seed, day, length_s=60 * minutes)
    print_line(console(), f"{output}: {minutes} minutes of day {day} with seed {seed}")


for elsewhere in (certify, export, fuzz, mutate, manifest, report, simulate_command, verify):
    app.command()(elsewhere)


@app.command()
def replay(
    trace: Annotated[Path, typer.Argument(metavar="TRACE", help="A trace of a failure.", show_default=False)],
    html: Annotated[
        Path | None, typer.Option("--html", metavar="F", help="Write the run as a page there.", show_default=False)
    ] = None,
    json: Json = None,
) -> None:
    """Replay the trace of a failure in plain CPython, step by step, and judge every invariant after each.

    It does not hold (1) if something is violated again.  The page is one file: a time-distance diagram, the
    steps and the loops' states, to be stepped through with the keys left, right, Home, End, and f for the failure.

    Examples:

    * `heisoku replay out/night/traces/reach_is_exclusive-0123456789ab.json`
    * `heisoku replay trace.json --html out/trace.html --json out/replay.json`
    """
    from fuzz.failures.command import replay_file

    writable(html, json, given=(trace,))
    with bad_input_refused(), progress("replaying") as step:
        found = replay_file(trace, html is not None, step)
    raise typer.Exit(found.report(console(), html, json))


def print_check(out: Console, path: Path, result: CheckResult) -> None:
    """One layout: its verdict, every violation with the elements that cause it, what it rests on, every remark."""
    from models.layouts.checker import rest_line

    print_line(
        out, f"{path}: {result.verdict} ({sum(result.checked.values())} instances of {len(result.checked)} axioms)"
    )
    for violation in result.violations:
        print_line(out, f"  {violation.axiom}: {violation.text} [{', '.join(violation.elements)}]")
    for rest in result.rests:
        print_line(out, f"  rests on {rest_line(rest)}")
    for remark in result.remarks:
        print_line(out, f"  remark: {remark.text} [{', '.join(remark.elements)}]")


def main() -> None:
    """Run the command line; whatever happens, the exit code is one of the four."""
    out, _ = outlet(sys.stdout), outlet(sys.stderr)
    code = run(sys.argv[1:])
    sys.stdout.flush()
    if out is not None and out.lost is not None:
        complain(f"heisoku: standard output: {out.lost.strerror}; what was found is not told whole")
        code = UNDECIDED
    sys.exit(code)


def run(arguments: Sequence[str]) -> int:
    """Run one command and give its exit code.  An interruption or a fault of our own decides nothing: 3."""
    try:
        code = app(list(arguments), prog_name="heisoku", standalone_mode=False)
    except typer.TyperException as usage:
        complain(f"heisoku: {usage.format_message().rstrip('.')}; see heisoku --help")
        return BAD_INPUT
    except OSError as error:
        complain(f"heisoku: {error.filename or 'a file'}: {error.strerror or error}; nothing is decided")
        return UNDECIDED
    except KeyboardInterrupt:
        code = INTERRUPTED
    except Exception as fault:
        if os.environ.get("HEISOKU_TRACEBACK"):
            traceback.print_exc()
        complain(f"heisoku: a fault of its own, {type(fault).__name__}: {fault}; HEISOKU_TRACEBACK=1 shows where")
        return UNDECIDED
    if code == INTERRUPTED:
        complain("heisoku: interrupted; nothing is decided")
        return UNDECIDED
    return int(code or HOLDS)
