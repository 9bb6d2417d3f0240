"""`heisoku simulate`: trains on a layout in simulated time, with faults; where each of them ended, and why there."""

from __future__ import annotations

import time
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer
from rich.console import Console
from rich.table import Table

from models.commands import Json, Seed, bad_input_refused, console, print_line, progress, refuse, writable
from models.exit_codes import DOES_NOT_HOLD, HOLDS, WORDS
from models.simulation.bounds import LEAST_HOURS, MOST_HOURS
from models.streams import write_whole
from proofs.records import about, write_json

if TYPE_CHECKING:
    from models.simulation.beginning import Plan
    from models.simulation.each_fault import Row
    from models.simulation.outcome import Outcome

Layout = Annotated[Path, typer.Argument(metavar="LAYOUT", help="A layout file with its track.", show_default=False)]
Trains = Annotated[
    int | None,
    typer.Option(metavar="N", min=1, max=999, help="Trains.", show_default="half of what has room, 8 at most"),
]
Cars = Annotated[int, typer.Option(metavar="N", min=2, max=60, help="Cars of 20 m that each train has.")]
Hours = Annotated[float, typer.Option(metavar="H", min=LEAST_HOURS, max=MOST_HOURS, help="Simulated hours, at most.")]
Trips = Annotated[
    int | None,
    typer.Option(
        metavar="N", min=1, max=100, help="So many trips a train, to their end: without it 1.", show_default=False
    ),
]
Faults = Annotated[
    Path | None,
    typer.Option(metavar="FILE", help="Which faults come, and how often (TOML).", show_default="every fault"),
]
Roads = Annotated[
    Path | None,
    typer.Option("--crossings", metavar="FILE", help="Where roads cross the line (TOML).", show_default="none"),
]
EachFault = Annotated[bool, typer.Option("--each-fault", help="Try one fault after the other, and tell the way out.")]
Html = Annotated[Path | None, typer.Option("--html", metavar="F", help="Write the page there.", show_default=False)]


def simulate(
    layout: Layout,
    trains: Trains = None,
    cars: Cars = 3,
    hours: Hours = 1.0,
    trips: Trips = None,
    seed: Seed = 1,
    faults: Faults = None,
    crossings: Roads = None,
    each_fault: EachFault = False,
    html: Html = None,
    json: Json = None,
) -> None:
    """Run trains on a layout in simulated time: centre, units, sensors, radio, point terminals, and faults.

    Trains make random trips; with --trips a timetable that must come to its end.  It does not hold (1) where an
    invariant or an oracle of the truth is broken, or the timetable does not end.  A seed gives the same record.

    Examples:
    * `heisoku simulate layouts/passing_station.toml --hours 0.1 --html out/line.html`
    * `heisoku simulate layouts/passing_station.toml --trains 1 --trips 1 --json out/line.json`
    """
    from models.layouts import load
    from models.simulation.beginning import Plan, rails_of, usual_trains
    from models.simulation.each_fault import each
    from models.simulation.faults import EVERY_FAULT, read_faults
    from models.simulation.roads import read_roads

    writable(html, json, given=(layout, faults, crossings))
    with bad_input_refused():
        imported = load(layout)
        chosen = EVERY_FAULT if faults is None else read_faults(faults)
        roads = () if crossings is None else read_roads(crossings, rails_of(imported))
        plan = Plan(imported, seed, trains or usual_trains(imported, cars), hours, chosen, trips, roads, cars)
        if each_fault:
            if html is not None:
                refuse("--html: --each-fault has no page; leave one of them out")
            with progress("faults") as step:
                rows = each(plan, step)
            code = _told_each(rows, json)
        else:
            code = _told(plan, html, json)
    raise typer.Exit(code)


def _told(plan: Plan, html: Path | None, json: Path | None) -> int:
    """Run one simulation and tell of it."""
    from fuzz.simulation.judging import judged
    from models.simulation.page.writing import page_of

    began = time.perf_counter()
    with progress("simulated s") as step:
        found = judged(plan, lambda now: step(now.now_s, round(plan.hours * 3_600), ""))
    seconds = time.perf_counter() - began
    if html:
        write_whole(html, page_of(found).encode())
    if json:
        write_json(json, {**found.record(), **about()})
    _print(console(), found, seconds)
    return HOLDS if found.holds else DOES_NOT_HOLD


def _told_each(rows: list[Row], json: Path | None) -> int:
    """Print the table of single faults."""
    out = console()
    table = Table(title="What each fault leaves locked, and the lawful way out", title_justify="left")
    for heading in ("fault", "came", "held without a train in it", "at most", "in the end", "way out"):
        table.add_column(heading)
    for row in rows:
        table.add_row(row.fault, f"{row.came}", row.held, f"{row.longest_s:,} s", row.at_the_end, row.way_out)
    out.print(table)
    holds = all(row.holds for row in rows)
    verdict = WORDS[HOLDS if holds else DOES_NOT_HOLD]
    if json:
        record = {"verdict": verdict, "faults": [vars(row) for row in rows]}
        write_json(json, {**record, **about()})
    for row in rows:
        if not row.holds:
            print_line(out, f"{row.fault}: {row.broken or 'a train does not run again, and no staff is about it'}")
    print_line(out, f"{len(rows)} faults, each in a simulation of its own: {verdict}")
    return HOLDS if holds else DOES_NOT_HOLD


def _print(out: Console, found: Outcome, seconds: float) -> None:
    """Print what it has come to: every train, what was broken, who stands in whose way, how fast it was."""
    sim = found.sim
    table = Table(title="Where every train ended", title_justify="left")
    for heading in ("train", "trips", "km", "ended", "how"):
        table.add_column(heading)
    for each in found.accounts:
        km = f"{each.way_mm / 1e6:.1f}"
        table.add_row(
            each.train, f"{each.trips_done} of {each.trips}", km, each.ended, f"{each.text}; in {each.blocks[0]}"
        )
    out.print(table)
    for violation in found.broken:
        print_line(out, f"broken at {violation.at_ms / 1_000:.1f} s: {violation.oracle}: {violation.text}")
    for deadlock in found.deadlocks:
        whose = ", of the timetable and not of the kernel" if found.timetable_to_blame else ""
        print_line(out, f"deadlock{whose}: {deadlock}")
    came = ", ".join(f"{name} {count}" for name, count in sorted(found.came.items()) if count)
    print_line(out, f"faults: {came or 'none'}")
    refused = "; ".join(f"{count:,} {why}" for why, count in found.refused.items())
    print_line(
        out,
        f"telegrams: {sim.air.sent:,} sent, {sim.air.lost:,} lost on the way, {found.delivered:,} delivered, "
        f"{sim.links.mended:,} mended; refused: {refused or 'none'}",
    )
    for name, state in sim.crossings.states.items():
        closings = state.closures(sim.now_s)
        longest_s = max((to_s - from_s for from_s, to_s in closings), default=0)
        closed_s = state.closed_in_all_s(sim.now_s)
        least = f", none sooner than {state.least_s} s after it was closed" if state.least_s is not None else ""
        print_line(
            out,
            f"crossing '{name}': closed {len(closings)} times for {closed_s:,} of {sim.now_s:,} s, "
            f"{longest_s:,} s at the longest; {state.passed} trains{least}",
        )
    asked, looked = sum(found.judged.values()), sum(sim.oracles.checked.values())
    print_line(out, f"checked: {len(found.judged)} invariants {asked:,} times, {looked:,} times the truth by oracles")
    speed = f"{found.train_seconds:,} train seconds in {seconds:.1f} s: {found.train_seconds / seconds:,.0f} a second"
    if found.plan.trips is not None:
        print_line(out, f"the timetable {'has come to its end' if sim.ended else 'has not come to its end'}")
    verdict = WORDS[HOLDS if found.holds else DOES_NOT_HOLD]
    print_line(out, f"{found.plan.trains} trains, {sim.now_s:,} s with seed {found.plan.seed}; {speed}: {verdict}")
